"""Scenes that were once wrong: each number by floats is that by fractions, and no plan is mixed with another.

What is right of each stands in `cases/once-wrong`, `cases/once-refused` and `cases/decided`.
"""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from face import ran

CASES = Path(__file__).parents[1] / "cases"
ONCE_WRONG = sorted(path for path in (CASES / "once-wrong").glob("[0-9]*.toml"))
CRANK, SHIFT = (CASES / "once-wrong" / f"cross-plan-{name}.toml" for name in ("slotted-crank", "shift"))
KINDS = "points", "links", "slides", "balance", "reactions"


def leaves(data: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Each number or text of results, with its path."""
    if isinstance(data, dict | list):
        for key, part in data.items() if isinstance(data, dict) else enumerate(data):
            yield from leaves(part, (*path, key))
    elif data is not None:
        yield path, data


@pytest.mark.parametrize("path", ONCE_WRONG, ids=lambda path: path.stem)
def test_results_are_right_to_nine_digits(path: Path) -> None:
    """Without a word about arithmetic each result has nine digits of the exact one."""
    found, compared = ran("solve", path).json, 0
    exact = ran("solve", path, "--exact").json
    for place, text in leaves({kind: exact[kind] for kind in KINDS if kind in exact}):
        value = found
        for key in place:
            value = value[key]
        if isinstance(value, float):
            assert value == pytest.approx(float(Fraction(text)), rel=1e-9, abs=1e-9), place
            compared += 1
    assert compared


@pytest.mark.parametrize("name", ["friction-drawn-wrong", "friction-flint-exit1"])
def test_friction_is_the_same_whatever_is_installed(name: str) -> None:
    """Without the library of enclosures each number is the same, to rounding."""
    path = CASES / "once-refused" / f"{name}.toml"
    code = ("import runpy, sys\nsys.modules['flint'] = None\n"
            f"sys.argv = ['graphplan', 'solve', {str(path)!r}]\nrunpy.run_module('graphplan', run_name='__main__')")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    without, whole = json.loads(done.stdout), ran("solve", path).json
    for kind in ("balance", "without_friction"):
        alone, both = (dict(leaves(data[kind])) for data in (without, whole))
        assert alone.keys() == both.keys()
        for place, value in both.items():
            assert alone[place] == (pytest.approx(value, rel=1e-12, abs=1e-13) if isinstance(value, float) else value)


# ---- plans apart -----------------------------------------------------------------------------------------------------

both_scenes = pytest.mark.parametrize("scene", [CRANK, SHIFT], ids=["crank", "shift"])
both_plans = pytest.mark.parametrize("plan", ["orthogonal", "polar"])


def drawn(scene: Path, plan: str) -> dict[str, float]:
    """The vectors of results that are drawn, by name, in mm."""
    found = {}
    for group in re.findall(r'<g class="vector"[^>]*>', ran("draw", scene, "-o", "-", "--plan", plan).out):
        ends = [[*map(float, part.split())] for part in re.findall(r'data-(?:from|to)="([^"]*)"', group)]
        name = re.search(r'data-vector="([^"]*)"', group)
        found[name[1] if name else ""] = math.dist(*ends)
    return found


def test_the_slotted_crank_ends_on_the_n_plan() -> None:
    """a_P4, 300.56 mm/s^2, is 75.1 mm long from p4 to P4_1: both lie on the N-plan, and so does P2_1."""
    marks = {step["makes"]: step for step in ran("steps", CRANK, "--json", "--plan", "orthogonal").json["steps"]}
    assert {marks[name]["plan"] for name in ("p4", "P4_1", "P2_1")} == {"N-plan"}
    assert math.dist(marks["p4"]["paper"], marks["P4_1"]["paper"]) == pytest.approx(75.14, abs=5e-3)
    assert drawn(CRANK, "orthogonal")["acceleration P4"] == pytest.approx(75.14, abs=2e-2)


@both_scenes
@both_plans
def test_every_acceleration_is_drawn(scene: Path, plan: str) -> None:
    """Each acceleration that was asked for is a vector on the sheet, as long as its scale makes the number."""
    vectors, points = drawn(scene, plan), ran("solve", scene, "--plan", plan).json["points"]
    sizes = {name: math.hypot(*point["acceleration"]) for name, point in points.items()}
    factors = {round(vectors[f"acceleration {name}"] / size, 4) for name, size in sizes.items() if size}
    assert max(factors) - min(factors) <= 2e-3 * max(factors)
    assert len(sizes) > 1


@both_scenes
@both_plans
def test_a_foot_lies_where_its_line_lies(scene: Path, plan: str) -> None:
    """A point that is marked on a line, and the line, are on one plan."""
    steps = ran("steps", scene, "--json", "--plan", plan).json["steps"]
    plans = {step["makes"]: step["plan"] for step in steps} | {
        f"{kind} {step['number']}": step["plan"] for step in steps for kind in ("point", "line")}
    met = [step for step in steps if step["operation"] in ("foot", "meet")]
    assert met
    for step in met:
        assert {plans.get(name, step["plan"]) for name in step["reads"]} == {step["plan"]}, step["sentence"]
