"""Vectors of a link's figure: as parameters of what is drawn from them, and beside each other."""

from __future__ import annotations

import math
from collections.abc import Sequence

from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Mark
from graphplan.mechanism.model import Number, Pair
from graphplan.methods.tolerances import PARALLEL_TOL
from graphplan.phrases import digits


def figure(v: Pair, u: Pair) -> dict[str, Number]:
    """A vector of a link's figure beside another, as parameters."""
    return {"dx": v[0], "dy": v[1], "ux": u[0], "uy": u[1]}


def angle(v: Pair) -> Angle:
    """The direction of a vector, spoken in degrees from the x-axis."""
    x, y = map(float, v)
    return Angle(digits(round(math.degrees(math.atan2(y, x)), 6), 6), *v)


def runs_along(v: Pair, u: Pair) -> bool:
    """Whether a vector runs along another, or has no length."""
    (x, y), (a, b) = map(float, v), map(float, u)
    return abs(a * y - b * x) <= PARALLEL_TOL * (abs(a) + abs(b)) * (abs(x) + abs(y))


def same_place(one: Pair, other: Pair) -> bool:
    """Whether two places of a figure are one."""
    pairs = zip(map(float, one), map(float, other), strict=True)
    return all(abs(p - q) <= PARALLEL_TOL * (abs(p) + abs(q)) for p, q in pairs)


def widest(drawn: Sequence[tuple[Pair, Mark]]) -> tuple[tuple[Pair, Mark], tuple[Pair, Mark]] | None:
    """The two of some marks that lie furthest apart; none where all lie in one place."""
    pairs = [(one, two) for k, one in enumerate(drawn) for two in drawn[k + 1:] if not same_place(one[0], two[0])]
    return max(pairs, key=lambda ends: math.dist(*([float(part) for part in place] for place, _ in ends)), default=None)
