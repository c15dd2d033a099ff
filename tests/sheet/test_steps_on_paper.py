"""The steps as data lie where the sheet has them, and stand in stages that say why."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import pairwise

import pytest
from sheets import SCENES, composition_of, drawing_of, sheet_of

from graphplan.kernel.kinds import POINT
from graphplan.output.svg import svg
from graphplan.output.text import steps

NS = "{http://www.w3.org/2000/svg}"
OFF = 0.01  # mm
DRAWN = [(name, "orthogonal") for name in SCENES] + [(name, "polar") for name in SCENES[::6]]


def numbers(*words: str | None) -> list[float]:
    return [float(number) for word in words for number in (word or "").split()]


@pytest.mark.parametrize(("name", "plan"), DRAWN)
def test_marks_are_told_where_they_are_drawn(name: str, plan: str) -> None:
    """The `paper` of every mark is the middle of its circle, and that of a result's vector where it begins and ends."""
    told = steps(composition_of(name, plan=plan))["steps"]
    marks = {step["number"]: step["paper"] for step in told if step["kind"] == POINT and step["number"]}
    ink = ET.fromstring(svg(sheet_of(name, plan=plan)).encode())
    circles = [(int(group.get("data-step", 0)), numbers(circle.get("cx"), circle.get("cy")))
               for group in ink.findall(f"{NS}g[@class='step']") for circle in group.findall(f"{NS}circle")]
    assert len(circles) > 3
    assert [found for found in circles if found[1] != pytest.approx(marks[found[0]], abs=OFF)] == []
    ends: dict[str, list[list[float]]] = {}
    for vector in drawing_of(name, plan).arrows:
        ends.setdefault(f"{vector.kind} {vector.point}", []).append([*told[vector.start]["paper"],
                                                                     *told[vector.end]["paper"]])
    for one in ink.iter(f"{NS}g"):
        if label := one.get("data-vector"):
            drawn = numbers(one.get("data-from"), one.get("data-to"))
            assert any(drawn == pytest.approx(place, abs=OFF) for place in ends[label]), label


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_every_step_stands_in_a_stage(name: str, plan: str) -> None:
    """What is drawn is a part of one stage, which has a law; each stage differs from the one before."""
    program = drawing_of(name, plan).drawn
    assert [step for _, steps in program.stages for step in steps] == [*program.steps[program.givens :]]
    assert all(stage.title and stage.law for stage, _ in program.stages)
    assert not [one.title for (one, _), (two, _) in pairwise(program.stages) if one == two]
