"""Marks where nobody would put them: whatever coincides, is in a row or in one spot, a judgement comes out."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from face import ran
from hand_drawings import Drawing, retraced
from judged_drawings import written

Marks = list[tuple[tuple[str, str], complex]]
Moved = Callable[[random.Random, Marks, tuple[str, str], complex], complex]


def first_of(marks: Marks, plan: str) -> complex:
    return next(z for (home, _), z in marks if home == plan)


MOVED: dict[str, Moved] = {
    "all in one spot": lambda chance, marks, key, z: 50 + 50j,
    "anywhere": lambda chance, marks, key, z: complex(chance.uniform(0, 200), chance.uniform(0, 200)),
    "in a row": lambda chance, marks, key, z: z.real + 10j,
    "a plan in one spot": lambda chance, marks, key, z: z if key[0] == "mechanism" else first_of(marks, key[0]),
    "some on each other": lambda chance, marks, key, z: z if chance.random() < 0.7 else chance.choice(marks)[1],
    "vectors of no length": lambda chance, marks, key, z: z if chance.random() < 0.7 else first_of(marks, key[0]),
}


@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "slider-crank", "jaanimets-11", "triad"])
def test_no_place_of_a_mark_stops_the_judge(name: str, tmp_path: Path) -> None:
    """A judgement with a verdict for every step, or a refusal in one line."""
    drawing = retraced(name, 1)
    steps = len(ran("steps", name, "--json").json["steps"])
    for number, (way, move) in enumerate(MOVED.items()):
        chance, marks = random.Random(number), [*drawing.board.marks.items()]
        moved = {key: move(chance, marks, key, z) for key, z in marks}
        spoilt: Drawing = replace(drawing, board=replace(drawing.board, marks=moved))
        done = ran("verify", name, written(spoilt, "csv", tmp_path), "--json", "-q")
        if done.status:
            assert "fewer than two of its points" in done.err, way
            assert done.err.count("\n") == 1
        else:
            assert len(done.json["steps"]) > steps / 3, way


def test_noise_is_no_drawing(tmp_path: Path) -> None:
    """In spots without letters that lie anywhere no mechanism is seen, however many there are."""
    chance = random.Random(1)
    dots = "".join(f'<circle cx="{chance.uniform(0, 300):.1f}" cy="{chance.uniform(0, 200):.1f}" r=".5"/>'
                   for _ in range(60))
    (path := tmp_path / "x.svg").write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="300mm" height="200mm" '
                                            f'viewBox="0 0 300 200">{dots}</svg>')
    done = ran("verify", "four-bar", path, "-q")
    assert (done.status, done.err.count("\n")) == (2, 1)
    assert "fewer than two of its points" in done.err
