"""Claims about constructions: in every form and plan they are the solver's, and they can be drawn well."""

from __future__ import annotations

import math
import re

from claim import claim
from face import Got, ran

import graphplan as gp

FORMS: list[dict[str, str]] = [*({"method": method} for method in ("trial", "auxiliary", "poles")), {"plan": "polar"}]
FORCE_PLANS = "both", "polar", "lever", "polygons"
ROUNDED = 1e-12
FLATTEST = 15  # degrees


def largest(found: gp.Results) -> float:
    """The largest difference from the solver."""
    return max(map(float, found.check.values()), default=0.0)


@claim(cheap=True)
def construction_and_solver_agree(got: Got) -> None:
    """To 1e-12 in floats, and to the last digit in fractions where the scene is rational."""
    assert max(map(float, got.solved["check"].values()), default=0.0) <= ROUNDED
    assert got.scene.irrational or largest(gp.solve(got.scene, exact=True)) == 0


@claim()
def every_form_agrees(got: Got) -> None:
    """So they do by every method and on polar plans."""
    for how in FORMS:
        assert largest(gp.solve(got.scene, **how)) <= ROUNDED, how
        assert got.scene.irrational or largest(gp.solve(got.scene, exact=True, **how)) == 0, how


@claim(having=lambda scene: scene.loads)
def every_plan_of_forces_agrees(got: Got) -> None:
    """Lever, force plans, solver and power balance give the same forces."""
    for plan in FORCE_PLANS:
        assert gp.solve(got.scene, plan=plan).check["force"] <= ROUNDED, plan


@claim()
def lines_cross_well(got: Got) -> None:
    """No two lines that fix a mark on the sheet cross below 15 degrees."""
    drawing = got.drawing
    for step in drawing.drawn.steps:
        if step.op.name == "meet":
            (a, b, _), (c, d, _) = (drawing.values[arg] for arg in step.args)
            sine = abs(a * d - b * c) / math.hypot(a, b) / math.hypot(c, d)
            assert math.degrees(math.asin(min(1.0, sine))) >= FLATTEST, drawing.drawn.sentence(step.index)


@claim()
def auxiliary_points_lie_near_the_mechanism(got: Got) -> None:
    """Where an auxiliary point or a pole is drawn, it is no further off than the mechanism is large."""
    own = [complex(*map(float, place)) for place in got.scene.points.values()]
    extent = max(abs(p - q) for p in own for q in own)
    drawing = got.drawing
    for step, value in zip(drawing.drawn.steps, drawing.values, strict=True):
        if step.panel == "mechanism" and step.name[:1] in ("Q", "R", "S") and len(value) == 2:
            assert min(abs(complex(*value) - p) for p in own) <= extent


@claim(cheap=True)
def each_link_is_driven_or_in_a_group(got: Got) -> None:
    """Every moving link is named once among the driving links and the groups of the structure."""
    lines = ran("check", got.name, "--json").json["structure"]
    named = [link for line in lines if (found := re.search(r"links? ([^():]+)", line.partition(": ")[2] or line))
             for link in found[1].split()]
    assert sorted(named) == sorted(got.scene.moving)


@claim(cheap=True)
def a_scene_says_what_it_is(got: Got) -> None:
    """It has a title, and says where it comes from."""
    assert got.scene.title
    assert got.scene.source


@claim()
def tables_say_what_json_says(got: Got) -> None:
    """A table of the pose has of each point, link and slide the numbers that JSON has."""
    table = got.drawing.evaluate({}).table()
    for name, point in got.solved["points"].items():
        for key, letter in (("velocity", "v"), ("acceleration", "a")):
            for axis, number in zip("xy", point.get(key) or (), strict=False):
                column = table.get(f"{name}.{letter}{axis}")
                assert column is None or math.isclose(column[0], number, rel_tol=1e-9, abs_tol=1e-9 * got.scene.extent)
    for link, rates in got.solved["links"].items():
        for key, number in rates.items():
            assert math.isclose(table[f"{link}.{key}"][0], number, rel_tol=1e-9, abs_tol=1e-9), (link, key)
