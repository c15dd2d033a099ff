"""Accuracy where methods fail: near every special pose of the survey, and with the auxiliary point anywhere."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import pytest

from graphplan.accuracy.first_order import readings
from graphplan.accuracy.survey.degeneracies import DEGENERACIES, Degeneracy
from graphplan.accuracy.survey.stability import error_of, exact, samples
from graphplan.check.trusted import report
from graphplan.kernel.numbers.floats import Floats
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load
from graphplan.methods.construct import construct
from graphplan.solver import solve

MOST = 100  # roundings of the mechanism's own condition
BY_NAME = {one.name: one for one in DEGENERACIES}
DISTANCES = (1.0, 3e-1, 3e-2, 3e-3, 3e-4, 1e-5, 1e-7, 1e-9, 1e-12, 1e-15, 0.0)


@pytest.mark.parametrize("degeneracy", [one for one in DEGENERACIES if one.name != "lever without arm"],
                         ids=lambda degeneracy: str(degeneracy.name))
def test_the_default_is_as_good_as_the_mechanism_allows(degeneracy: Degeneracy) -> None:
    """Towards each special pose the default choice loses no more than the mechanism, or says that it is singular."""
    for sample in samples(degeneracy, distances=DISTANCES):
        if sample.method == "chosen by the pose":
            assert sample.roundings is None or sample.roundings <= MOST
            assert sample.error is not None or "singular" in sample.why


def test_parallel_bars_have_no_auxiliary_point_and_lose_nothing() -> None:
    """With the bars turned parallel by degrees down to nothing, naming a form changes the drawing and no number."""
    bars = DEGENERACIES[0]
    for sample in samples(bars, distances=tuple(10.0**-k for k in range(17))):
        assert sample.roundings is not None
        assert sample.roundings <= MOST


@pytest.mark.parametrize(("name", "d", "how"), [
    ("dead centre against the drive", 1e-8, {}), ("dead centre against the drive", 1e-4, {"strict": True}),
    ("C on QR", 1e-6, {"plan": "polar"}), ("slide locks", 1e-6, {})])
def test_small_vectors_beside_large_plans_are_drawn(name: str, d: float, how: dict[str, Any]) -> None:
    """What is drawn near a special pose loses digits as the pose does: no small vector is left out of a large plan."""
    scene = BY_NAME[name].at(d)
    drawing, drawn = construct(scene, **how), dict[str, dict[str, Any]]()
    for reading, _, value in readings(drawing, drawing.values, Floats()):
        drawn.setdefault(reading.kind, {})[reading.of] = value
    assert error_of(drawn, exact(scene)) <= 10 * MOST * 2.0**-52 * solve(scene).condition


@pytest.mark.parametrize("d", [1e-6, 1e-13])
def test_forces_are_found_where_floats_hold_the_pose_for_singular(d: float) -> None:
    """Of a loaded triad a hair from its singular pose all is told, and drawn as well as floats can."""
    found = report(scene := replace(BY_NAME["triad"], scene="triad-loaded").at(d))
    assert found.arithmetic != "floats"
    assert error_of(found.results, exact(scene)) <= MOST * 2.0**-52


def posed(**moved: complex) -> Scene:
    """Rosenauer's basic case with some of its points elsewhere."""
    scene = load("rosenauer-basic")
    return replace(scene, points=scene.points | {p: (Fraction(z.real), Fraction(z.imag)) for p, z in moved.items()})


@pytest.mark.parametrize("seed", range(60))
def test_the_auxiliary_point_may_lie_anywhere(seed: int) -> None:
    """Wherever Q lies, the results are as good as the mechanism allows."""
    random = Random(seed)
    A, B = (complex(*map(float, load("rosenauer-basic").points[name])) for name in "AB")
    angle = random.uniform(0, 2 * math.pi)
    Q = (A + B) / 2 + 10.0 ** random.uniform(-2, 6) * complex(math.cos(angle), math.sin(angle))
    share = 100 / max(abs(Q - A), abs(Q - B), 200)
    found = report(scene := posed(K=A + share * (Q - A), L=B + share * (Q - B)))
    assert error_of(found.results, exact(scene)) <= MOST * 2.0**-52 * found.rates.condition


def test_the_sheet_leaves_the_auxiliary_point_where_it_leaves_the_sheet() -> None:
    """With parallel bars the trial figure is drawn, and the protocol says why."""
    bars = DEGENERACIES[0]
    assert "trial figure" in report(bars.at(0.0)).drawing.method["velocity"][0]
    assert any("off the sheet" in form for form in report(bars.at(1e-3)).drawing.forms)


def test_a_link_too_short_for_its_vectors_is_drawn_on_polar_plans() -> None:
    """With a crank of a hundred-thousandth the default is a polar plan, and says why; a plan that is named stays."""
    short = BY_NAME["short crank"].at(1e-5)
    drawing = report(short).drawing
    assert not drawing.turned
    assert any("polar plans, as links differ so much in length" in note for note in drawing.notes)
    assert report(short, plan="orthogonal").drawing.turned
