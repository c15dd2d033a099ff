"""Results are judged by the truth, and scales are those that are printed: whatever follows from a mistake is no right
result, a first vector laid off wrong is named, and nothing that was removed is credited."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import drawing_pictures as pictures
import pytest
from face import ran
from hand_drawings import task_of
from judged_drawings import Judged, judged

SCALES = {"velocity": "velocity plan", "acceleration": "acceleration plan"}


def points(scene: str, factor: complex = 1.0) -> str:
    """The points of a scene's own polar sheet, the velocities so many times as long, as by a first vector wrong."""
    rows = ["mark,x,y,panel"]
    steps = ran("steps", scene, "--plan", "polar", "--json").json["steps"]
    pole = next(complex(*step["paper"]) for step in steps if step["plan"] == SCALES["velocity"])
    for step in steps:
        if step["kind"] == "point" and not str(step["makes"]).removeprefix("point ").isdigit():
            z = complex(*step["paper"])
            z = pole + factor * (z - pole) if step["plan"] == SCALES["velocity"] else z
            if step["plan"] != SCALES["acceleration"]:
                name = str(step["makes"]).removeprefix("point ")
                rows.append(f"{name},{z.real:.2f},{250 - z.imag:.2f},{step['plan']}")
    return "\n".join(rows) + "\n"


def verdict(folder: Path, text: str) -> dict[str, Any]:
    (path := folder / "points.csv").write_text(text)
    found: dict[str, Any] = ran("verify", "four-bar", path, "--plan", "polar", "--json", "-q").json
    return found


@pytest.mark.parametrize("factor", [0.9, 0.95, 1.06, 1.2, -1.0])
def test_a_first_vector_laid_off_wrong_is_named(factor: float, tmp_path: Path) -> None:
    """It is no scale of the student's own, and no velocity that follows from it is a right result."""
    found = verdict(tmp_path, points("four-bar", factor))
    assert found["first_wrong"]["mark"] == "a"
    velocities = {row["of"]: row["verdict"] for row in found["results"] if row["kind"] == "velocity"}
    assert velocities["A"] == "wrong"
    assert {velocities[of] for of in ("B", "M")} == {"follows"}


def test_what_follows_counts_as_method_and_not_as_result(tmp_path: Path) -> None:
    """Of the score the method has it, the results have not."""
    right, wrong = (verdict(tmp_path, points("four-bar", factor)) for factor in (1.0, 0.9))
    drawn = [row["verdict"] for row in right["results"] if row["kind"] == "velocity"]
    assert drawn == ["right"] * len(drawn)
    assert wrong["score"]["results"] < right["score"]["results"]
    assert wrong["score"]["method"] > wrong["score"]["results"] + 20


def test_a_removed_end_of_a_scan_is_not_credited(tmp_path: Path) -> None:
    """It is to be looked at, though all that rests on it is right."""
    drawing, paper = pictures.on_printed_task(task_of("four-bar, polar", 50), 50, None)
    board, end = drawing.board, drawing.board.marks["first", "b"]
    board = replace(board, marks={key: z for key, z in board.marks.items() if z != end},
                    strokes=[stroke for stroke in board.strokes if end not in stroke])
    scan = pictures.scan(paper, pictures.pencilled(board), 50, dpi=120.0)
    cv2.imwrite(str(path := tmp_path / "picture.png"), scan)
    one: Judged = judged(replace(drawing, board=board), path)
    assert one.data
    verdicts = {(row["kind"], row["of"]): row["verdict"] for row in one.data["results"]}
    assert verdicts["velocity", "B"] == "unsure"
    assert one.score < 97.0


def test_a_number_of_the_task_names_its_own_mark(tmp_path: Path) -> None:
    """A wrong mark that bears the number of its step is wrong, whatever else is right: no other order is thought of."""
    steps = ran("steps", "four-bar", "--plan", "polar", "--json").json["steps"]
    step = next(step for step in steps if step["makes"] == "m")
    wrong = complex(*step["paper"]) + 6
    rows = [row for row in points("four-bar").splitlines() if not row.startswith("m,")]
    rows.append(f"{step['number']},{wrong.real:.2f},{250 - wrong.imag:.2f},{step['plan']}")
    found = verdict(tmp_path, "\n".join(rows))
    assert found["reading"] == ""
    assert found["first_wrong"]["step"] == step["number"]
