"""The steps as data lie where the sheet has them, and stand in stages that say why."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from sheets import SCENES, composition_of, drawing_of, sheet_of

import graphplan as gp
from graphplan.commands import main
from graphplan.kernel.kinds import POINT
from graphplan.output.svg import svg
from graphplan.output.text import steps

NS = "{http://www.w3.org/2000/svg}"
OFF = 0.01  # mm
DRAWN = [(name, "orthogonal") for name in SCENES] + [(name, "polar") for name in SCENES[::6]]


def numbers(*words: str | None) -> list[float]:
    return [float(number) for word in words for number in (word or "").split()]


def misplaced(drawn: str, told: list[dict[str, Any]]) -> tuple[list[int], int]:
    """The steps whose circles an SVG has elsewhere than they are told, and how many circles there are."""
    marks = {step["number"]: step["paper"] for step in told if step["kind"] == POINT and step["number"]}
    circles = [(int(group.get("data-step", 0)), numbers(circle.get("cx"), circle.get("cy")))
               for group in ET.fromstring(drawn.encode()).findall(f"{NS}g[@class='step']")
               for circle in group.findall(f"{NS}circle")]
    return [step for step, at in circles if at != pytest.approx(marks[step], abs=OFF)], len(circles)


@pytest.mark.parametrize(("name", "plan"), DRAWN)
def test_marks_are_told_where_they_are_drawn(name: str, plan: str) -> None:
    """The `paper` of every mark is the middle of its circle, and that of a result's vector where it begins and ends."""
    told, drawn = steps(composition_of(name, plan=plan))["steps"], svg(sheet_of(name, plan=plan))
    wrong, seen = misplaced(drawn, told)
    assert (wrong, seen > 3) == ([], True)
    ends: dict[str, list[list[float]]] = {}
    for vector in drawing_of(name, plan).arrows:
        ends.setdefault(f"{vector.kind} {vector.point}", []).append([*told[vector.start]["paper"],
                                                                     *told[vector.end]["paper"]])
    for one in ET.fromstring(drawn.encode()).iter(f"{NS}g"):
        if label := one.get("data-vector"):
            lies = numbers(one.get("data-from"), one.get("data-to"))
            assert any(lies == pytest.approx(place, abs=OFF) for place in ends[label]), label


@pytest.mark.parametrize("how", ["", "--paper A2 --set sheet.frame=gost --language de --plan polar",
                                 "--strict --prefer quick",
                                 "--set sheet.curves=all --set sheet.positions=4"])
def test_steps_speak_of_the_sheet_that_the_same_options_draw(how: str, tmp_path: Path,
                                                             capsys: pytest.CaptureFixture[str]) -> None:
    """`steps --json` takes the options of `draw` that change the sheet, and tells where that has each mark; both speak
    the scene's language where none is named."""
    scene, sheet = tmp_path / "scene.toml", tmp_path / "sheet.svg"
    scene.write_text(gp.load("five-bar").text + '\n[sheet]\nlanguage = "lv"\n', encoding="utf-8")
    assert main(["draw", str(scene), "-o", str(sheet), *how.split()]) == 0
    assert main(["steps", str(scene), "--json", *how.split()]) == 0
    told = json.loads(capsys.readouterr().out)
    wrong, seen = misplaced(sheet.read_text(encoding="utf-8"), told["steps"])
    assert (wrong, seen > 3) == ([], True)
    assert {"Velocity", "Acceleration", "Locus"}.isdisjoint(stage["title"].split()[0] for stage in told["stages"])


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_every_step_stands_in_a_stage(name: str, plan: str) -> None:
    """What is drawn is a part of one stage, which has a law; each stage differs from the one before."""
    program = drawing_of(name, plan).drawn
    assert [step for _, steps in program.stages for step in steps] == [*program.steps[program.givens :]]
    assert all(stage.title and stage.law for stage, _ in program.stages)
    assert not [one.title for (one, _), (two, _) in pairwise(program.stages) if one == two]
