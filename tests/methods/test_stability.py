"""Accuracy where methods fail: near every special pose of the atlas, and with the auxiliary point anywhere."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest

from graphplan.accuracy.tolerances import EPSILON
from graphplan.bench.problem import (
    AUXILIARY,
    DEGENERACIES,
    FALSE,
    LEVER,
    ORTHOGONAL,
    POLAR,
    POLES,
    POLYGONS,
    TRIAL,
    Degeneracy,
    Results,
    largest_error,
)
from graphplan.bench.stability import (
    COMPUTED,
    DRAWN,
    MAX_LOST_ROUNDINGS,
    SHEET,
    SOLVE,
    ProbedPose,
    as_drawn,
    samples,
)
from graphplan.check.arithmetics import Exact
from graphplan.check.report import reference_solution
from graphplan.check.trusted import report
from graphplan.design.decide import construct
from graphplan.design.hand import Pencil
from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Floats
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load
from graphplan.methods.design import OPEN, Design
from graphplan.solver import solve

SWEEPS = {one.name: one for one in DEGENERACIES}
DISTANCES = 1e-3, 1e-11, 1e-13
MAX_LOST_DRAWN = 10 * MAX_LOST_ROUNDINGS  # of what is drawn in floats, each mark from those before it
MIN_DRAWN = 1e-11  # distance down to which a sheet is as good as its pose: marks nearer than 1e-13 of a plan are one
TO_THE_LAST = "short coupler", "short crank", "parallel bars", "joints coincide", "slide locks"
EACH = pytest.mark.parametrize("degeneracy", DEGENERACIES, ids=lambda degeneracy: str(degeneracy.name))


def error(results: Results, scene: Scene) -> float:
    """The largest error beside what fractions say."""
    return largest_error(results, reference_solution(scene, Exact()).truth(results))


@EACH
def test_a_special_pose_is_special_and_no_pose_near_it(degeneracy: Degeneracy) -> None:
    """At d = 0 the mechanism is singular, where it is said to be, and never on the way there."""
    for d in (1.0, 1e-16):
        reference_solution(degeneracy.scene_at(d), Exact())
    if degeneracy.singular:
        with pytest.raises(SingularPose):
            report(degeneracy.scene_at(0.0), exact=True)
    else:
        reference_solution(degeneracy.scene_at(0.0), Exact())


@EACH
def test_the_answer_is_as_good_as_the_mechanism_allows(degeneracy: Degeneracy) -> None:
    """Towards each special pose `solve` loses no more than the mechanism, and to the last keeps nine digits; value
    rules in floats lose no more, either, nor the sheet in the form that it chooses, each mark made from those before,
    more than ten times as much."""
    for d in DISTANCES:
        pose = ProbedPose(degeneracy.scene_at(d), Pencil())
        found, most = report(pose.scene, alone=True), MAX_LOST_ROUNDINGS * EPSILON * pose.condition
        assert error(found.results, pose.scene) <= min(1e-9, most)
        assert pose.floats is None or error(found.drawing.read(Floats()), pose.scene) <= most
        if d >= MIN_DRAWN or degeneracy.name in TO_THE_LAST:
            assert error(as_drawn(found.drawing), pose.scene) <= MAX_LOST_DRAWN * EPSILON * pose.condition


# Where each way fails, as it is drawn in floats: at which distance it is off by more than 1e-8, a thousand times what
# the mechanism's condition costs where that is regular; and the ways that lose nothing there.
FAILURES: dict[str, tuple[float, tuple[str, ...], tuple[str, ...]]] = {
    "parallel bars": (1e-9, (AUXILIARY,), (TRIAL, SHEET)),
    "joints coincide": (1e-9, (TRIAL,), (AUXILIARY, SHEET)),
    "pole at infinity": (1e-9, (POLES,), (FALSE, SHEET)),
    "short crank": (1e-10, (), (ORTHOGONAL, POLAR, SHEET)),
    "short coupler": (1e-15, (), (ORTHOGONAL, POLAR, SHEET)),
    "C on QR": (1e-10, (AUXILIARY, TRIAL, SHEET), ()),
    "triad": (1e-10, (AUXILIARY, TRIAL, SHEET), ()),
    "class IV": (1e-10, (POLES, FALSE, SHEET), ()),
    "slide locks": (1e-10, (ORTHOGONAL, POLAR, SHEET), ()),
    "dead centre against the drive": (1e-10, (POLYGONS, LEVER, SHEET), ()),
    "dead centre with the drive": (1e-10, (), (POLYGONS, LEVER, SHEET)),
    "parallel bars, loaded": (1e-9, (AUXILIARY,), (TRIAL, SHEET)),
    "lever without arm": (1e-10, (POLYGONS, LEVER, SHEET), ()),
}


@EACH
def test_every_way_fails_somewhere(degeneracy: Degeneracy) -> None:
    """Each way of drawing loses half its digits somewhere, and `solve` none; where one serves, the sheet has it."""
    d, fail, serve = FAILURES[degeneracy.name]
    found = {(row.way, row.how): row for row in samples(degeneracy, distances=(d,))}
    for way in fail:
        assert (found[way, DRAWN].error or 0.0) > 1e-8
    for way in serve:
        row = found[way, DRAWN]
        assert row.error is not None
        assert row.error <= MAX_LOST_DRAWN * EPSILON * row.condition
    assert {*fail, *serve} == {*degeneracy.compared_ways, SHEET}
    assert (found[SOLVE, COMPUTED].error or 0.0) <= 1e-13


def test_no_way_fails_nowhere() -> None:
    """Of every way that the atlas shows there is a pose in which it fails."""
    shown = {way for degeneracy in DEGENERACIES for way in degeneracy.compared_ways}
    assert {way for _, fail, _ in FAILURES.values() for way in fail} == {*shown, SHEET}


@pytest.mark.parametrize(("name", "d", "wishes"), [
    ("dead centre against the drive", 1e-8, OPEN),
    ("dead centre against the drive", 1e-4, Design(strict=True)), ("C on QR", 1e-6, Design("polar")),
    ("slide locks", 1e-6, OPEN), ("short coupler", 1e-14, OPEN)])
def test_small_vectors_beside_large_plans_are_drawn(name: str, d: float, wishes: Design) -> None:
    """What is drawn near a special pose loses digits as the pose does: no small vector is left out of a large plan."""
    scene = SWEEPS[name].scene_at(d)
    assert error(as_drawn(construct(scene, wishes)), scene) <= MAX_LOST_DRAWN * EPSILON * solve(scene).condition


@pytest.mark.parametrize("d", [10**-6.5, 10**-10.5, 10**-13.5])
def test_a_ring_that_closes_by_rounding_alone_is_not_drawn(d: float) -> None:
    """A way whose trials agree in fractions has numbers in floats, as rounding makes them differ: another is drawn."""
    scene = SWEEPS["pole at infinity"].scene_at(d)
    assert error(as_drawn(construct(scene)), scene) <= MAX_LOST_DRAWN * EPSILON * solve(scene).condition


@pytest.mark.parametrize("d", [1e-6, 1e-11, 1e-13])
def test_forces_are_found_where_floats_hold_the_pose_for_singular(d: float) -> None:
    """Of a loaded triad a hair from its singular pose all is told, and drawn as well as floats can."""
    found = report(scene := replace(SWEEPS["triad"], scene="triad-loaded").scene_at(d))
    assert found.arithmetic != "floats"
    assert error(found.results, scene) <= MAX_LOST_ROUNDINGS * EPSILON


def posed(**moved: complex) -> Scene:
    """Rosenauer's basic case with some of its points elsewhere."""
    scene = load("rosenauer-basic")
    return replace(scene, points=scene.points | {p: (Fraction(z.real), Fraction(z.imag)) for p, z in moved.items()})


@pytest.mark.parametrize("seed", range(16))
def test_the_auxiliary_point_may_lie_anywhere(seed: int) -> None:
    """Wherever Q lies, the results are as good as the mechanism allows."""
    random = Random(seed)
    A, B = (complex(*map(float, load("rosenauer-basic").points[name])) for name in "AB")
    angle = random.uniform(0, 2 * math.pi)
    Q = (A + B) / 2 + 10.0 ** random.uniform(-2, 6) * complex(math.cos(angle), math.sin(angle))
    share = 100 / max(abs(Q - A), abs(Q - B), 200)
    found = report(scene := posed(K=A + share * (Q - A), L=B + share * (Q - B)))
    assert error(found.results, scene) <= MAX_LOST_ROUNDINGS * EPSILON * found.rates.condition


def test_the_sheet_leaves_the_auxiliary_point_where_it_leaves_the_sheet() -> None:
    """With parallel bars the trial figure is drawn, and the protocol says why."""
    bars = SWEEPS["parallel bars"]
    assert any("trial figure" in way for way in report(bars.scene_at(0.0)).drawing.method["velocity"])
    assert any("off the sheet" in form for form in report(bars.scene_at(1e-3)).drawing.forms)


def test_a_link_too_short_for_its_vectors_is_drawn_on_polar_plans() -> None:
    """With a crank of a hundred-thousandth the default is a polar plan, and says why; a plan that is named stays."""
    short = SWEEPS["short crank"].scene_at(1e-5)
    drawing = report(short).drawing
    assert not drawing.turned
    assert any("polar plans, as links differ so much in length" in note for note in drawing.notes)
    assert report(short, Design("orthogonal")).drawing.turned
