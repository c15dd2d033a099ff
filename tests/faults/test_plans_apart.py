"""Scenes that once mixed two plans: a perpendicular was dropped from a point of one plan on a line of another."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import pytest

from graphplan.commands import main

HERE = Path(__file__).parent
CRANK, SHIFT = HERE / "cross-plan-slotted-crank.toml", HERE / "cross-plan-shift.toml"


def told(capsys: pytest.CaptureFixture[str], scene: Path, plan: str) -> dict[str, Any]:
    """What `steps --json` says of a scene."""
    assert main(["steps", str(scene), "--json", "--plan", plan]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def drawn(capsys: pytest.CaptureFixture[str], scene: Path, plan: str) -> dict[str, float]:
    """The vectors of results that are drawn, by name, in mm."""
    assert main(["draw", str(scene), "-o", "-", "--plan", plan]) == 0
    found = {}
    for group in re.findall(r'<g class="vector"[^>]*>', capsys.readouterr().out):
        ends = [[*map(float, part.split())] for part in re.findall(r'data-(?:from|to)="([^"]*)"', group)]
        name = re.search(r'data-vector="([^"]*)"', group)
        found[name[1] if name else ""] = math.dist(*ends)
    return found


def test_the_slotted_crank_ends_on_the_n_plan(capsys: pytest.CaptureFixture[str]) -> None:
    """a_P4, 300.56 mm/s^2, is 75.1 mm long from p4 to P4_1: both lie on the N-plan, and so does P2_1."""
    marks = {step["makes"]: step for step in told(capsys, CRANK, "orthogonal")["steps"]}
    assert {marks[name]["plan"] for name in ("p4", "P4_1", "P2_1")} == {"N-plan"}
    assert math.dist(marks["p4"]["paper"], marks["P4_1"]["paper"]) == pytest.approx(75.14, abs=5e-3)
    assert drawn(capsys, CRANK, "orthogonal")["acceleration P4"] == pytest.approx(75.14, abs=2e-2)


@pytest.mark.parametrize("scene", [CRANK, SHIFT], ids=["crank", "shift"])
@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_every_acceleration_is_drawn(scene: Path, plan: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Each acceleration that was asked for is a vector on the sheet, as long as its scale makes the number."""
    vectors = drawn(capsys, scene, plan)
    assert main(["solve", str(scene), "--plan", plan]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    sizes = {name: math.hypot(*point["acceleration"]) for name, point in points.items()}
    factors = {round(vectors[f"acceleration {name}"] / size, 4) for name, size in sizes.items() if size}
    assert max(factors) - min(factors) <= 2e-3 * max(factors)
    assert len(sizes) > 1


@pytest.mark.parametrize("scene", [CRANK, SHIFT], ids=["crank", "shift"])
@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_a_foot_lies_where_its_line_lies(scene: Path, plan: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A point that is marked on a line, and the line, are on one plan."""
    found = told(capsys, scene, plan)
    plans = {step["makes"]: step["plan"] for step in found["steps"]} | {
        f"{kind} {step['number']}": step["plan"] for step in found["steps"] for kind in ("point", "line")}
    met = [step for step in found["steps"] if step["operation"] in ("foot", "meet")]
    assert met
    for step in met:
        assert {plans.get(name, step["plan"]) for name in step["reads"]} == {step["plan"]}, step["sentence"]
