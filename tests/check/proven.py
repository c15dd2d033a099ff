"""Proven bounds against the truth, which fractions tell."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from graphplan.check.report import Report, rates_by_kind
from graphplan.mechanism.model import Scene
from graphplan.solver import reactions, solve


def lies(found: Report, scene: Scene) -> list[str]:
    """The printed numbers that are further off than their bound, and those of which fewer than nine digits hold."""
    return list(_lies(found, scene))


def _lies(found: Report, scene: Scene) -> Iterator[str]:
    truth = rates_by_kind(solve(scene, exact=True), found.results)
    if scene.loads is not None:
        from graphplan.check.forces import force_truth

        truth |= force_truth(scene, found.results, reactions(scene, exact=True))
    for part, named in found.numbers.items():
        for name, vector in named.items():
            true = truth[part][name]
            for number, exact in zip(vector, true if isinstance(true, tuple) else (true,), strict=True):
                if abs(Fraction(number.value) - exact) > Fraction(number.bound):
                    yield f"{part} of {name}: {number} where {float(exact)} is right"
                if not number.holds:
                    yield f"{part} of {name}: {number} has no nine digits"
