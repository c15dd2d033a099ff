"""Which pairs stand still in a pose: friction has no sense there, and rounding shall not give it one.

It is decided once, from the motion alone, for construction and solver alike: by fractions where the scene is rational,
else between the narrowest bounds that can be had.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from graphplan.check.arithmetics import FLOATS, Bounds, bounded_rates, enclosed, enclosures
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import Scene
from graphplan.solver import Rates, solve

DIGITS = 120  # of the enclosures in which what overlaps nothing stands still


def with_resting_pairs(scene: Scene) -> Scene:
    """The scene with the names of its pairs that stand still, where some pair could rub; of a singular pose as it is.
    """
    if scene.loads is None or not scene.loads.frictions:
        return scene
    with suppress(GraphplanError, ArithmeticError):
        return replace(scene, loads=replace(scene.loads, resting=_resting(scene)))
    return scene


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
