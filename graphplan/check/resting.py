"""What is decided before friction is drawn: which pairs stand still, and whether the mechanism locks itself.

Friction has no sense where a pair stands still, and rounding shall not give it one. So it is decided once, from the
motion alone, for construction and solver alike: by fractions where the scene is rational, else between the narrowest
bounds that can be had.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from graphplan.check.arithmetics import FLOATS, Bounds, bounded_rates, enclosed, enclosures
from graphplan.errors import GraphplanError, SingularPose
from graphplan.mechanism.model import Scene
from graphplan.solver import Rates, solve

ROOTS = "fractions do not hold friction in journals: the size of a reaction is a root; leave out --exact"
REPEATING = "statically indeterminate: friction depends on forces that equilibrium does not tell"
DIGITS = 120  # of the enclosures in which what overlaps nothing stands still


def decided(scene: Scene, exact: bool = False) -> tuple[Scene, str]:
    """The scene with the names of its pairs that stand still, where some could rub. Where its forces with friction
    cannot be had, the scene without its friction, and the reason."""
    loads = scene.loads
    if loads is None or not loads.frictions or not any(drive.rate for drive in scene.drives):
        return scene, ""
    from graphplan.solver.friction import with_friction

    smooth = replace(scene, loads=replace(loads, frictions=()))
    if exact and any(friction.at and friction.coefficient * friction.radius for friction in loads.frictions):
        return smooth, ROOTS if _journals_bear(smooth, {friction.at for friction in loads.frictions}) else ""
    if scene.repeating:
        return smooth, REPEATING
    with suppress(GraphplanError, ArithmeticError):
        scene = replace(scene, loads=replace(loads, resting=_resting(scene)))
    try:
        with_friction(scene, loads.rounds, exact)
    except SingularPose as singular:
        return smooth, singular.why
    return scene, ""


def _journals_bear(smooth: Scene, journals: set[str]) -> bool:
    """Whether any of these joints bears a force without friction; where none does, friction makes none."""
    from graphplan.solver.statics import reactions

    try:
        borne = reactions(smooth, exact=True)
    except SingularPose:
        return True
    return any(any(force) for (point, _), force in borne.joints.items() if point in journals)


def _resting(scene: Scene) -> frozenset[str]:
    """The names of the pairs that stand still."""
    from graphplan.solver.friction import resting

    if not scene.irrational:
        return resting(solve(scene, exact=True), lambda speed: not speed)
    by = enclosures(DIGITS * 10 // 3) if find_spec("flint") else FLOATS
    with by.working():
        return resting(_rates(scene, by), _overlaps_nothing(by))


def _rates(scene: Scene, by: Bounds) -> Rates:
    return bounded_rates(enclosed(scene, by), by)


def _overlaps_nothing(by: Bounds) -> Callable[[Any], bool]:
    """Whether a number between bounds may be nothing."""
    return lambda speed: by.lift(speed).overlaps(by.lift(0))
