"""How drawings by another hand are judged: right ones are right, a slip is found, and a plan that is all wrong."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from blackboard import MAKERS, Drawing, mistaken, right, wrong_as_a_whole
from shared.tiers import sample

from graphplan.commands import main

SEEDS = sample(range(2), range(40))
FORMS = "csv", "svg"
FALSE_ALARMS = 0.02
PLACES = {"csv": 0.95, "svg": 0.9}


def verified(drawing: Drawing, form: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> dict[str, Any]:
    task, student = folder / "task.toml", folder / f"student.{form}"
    task.write_text(drawing.task.scene)
    student.write_text(getattr(drawing, form))
    options = ["--plan", "polar"] if drawing.task.plan == "polar" else []
    assert main(["verify", str(task), str(student), "--json", "-q", *options]) == 0
    return json.loads(capsys.readouterr().out)  # type: ignore[no-any-return]


def drawings(make: Callable[[str, int], Drawing]) -> Iterator[Drawing]:
    for name in MAKERS:
        for seed in SEEDS:
            try:
                yield make(name, seed)
            except LookupError:  # no task of this seed can be set
                continue


@pytest.mark.parametrize("form", FORMS)
def test_a_right_drawing_is_right(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """At its own scales and places, with marks of its own: at most two of a hundred are called wrong."""
    found = [verified(drawing, form, tmp_path, capsys)["first_wrong"] for drawing in drawings(right)]
    assert sum(one is not None for one in found) <= FALSE_ALARMS * len(found)


@pytest.mark.parametrize("form", FORMS)
def test_the_place_of_a_mistake_is_named(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The mark at which it was made, or its vector, or the mark that shows it."""
    named, made = 0, list(drawings(mistaken))
    for drawing in made:
        first = verified(drawing, form, tmp_path, capsys)["first_wrong"]
        words = "|".join(map(str, (first["guilty"]["mark"], first["seen"]["mark"], first["mistake"]))) if first else ""
        named += bool(drawing.answers.search(words))
    assert named >= PLACES[form] * len(made)


@pytest.mark.parametrize("form", FORMS)
def test_a_plan_that_is_wrong_as_a_whole_is_always_told(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
                                                        ) -> None:
    """As a mistake, or where it is but at another scale as the reading."""
    for drawing in drawings(wrong_as_a_whole):
        found = verified(drawing, form, tmp_path, capsys)
        if drawing.whole.endswith("scale"):
            assert "times as large" in found["reading"] or "k_v" in found["reading"]
        else:
            assert found["first_wrong"], drawing.whole
