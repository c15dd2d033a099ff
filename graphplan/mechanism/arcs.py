"""Arcs and lines: the rules that put a point with compasses, rule and protractor.

Every rule reckons in fractions, or in any numbers that reckon with them, and gives x, y and whether they are exact.
Roots and angles it takes from the reckoning `sharp`; an irrational root is good to far more than a float's digits, so a
point is rounded once, at the end. `rounded` says that some centre is itself a rounded point.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from graphplan.mechanism.directions import Misfit, Where, vector
from graphplan.mechanism.numerals import Reckoning, shown

_TANGENT = Fraction(1, 10**12)
"""Where centres are rounded, arcs whose half-chord squared is below zero by this part of a radius squared do touch."""

Put = tuple[Any, Any, bool]


def _given(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    return *data["at"], True


def _polar(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    (x, y), (c, s, exact) = at(data["from"]), sharp.heading(data["angle"])
    return x + data["distance"] * c, y + data["distance"] * s, exact


def _compass(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    (a, p), (b, q) = data["distances"].items()
    (ax, ay), (bx, by) = at(a), at(b)
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    if square == 0:
        raise Misfit(f"the compass centres {a} and {b} coincide", "centres that lie apart")
    along = (p * p - q * q + square) / (2 * square)
    across, exact = _half_chord(p * p / square - along * along, p * p / square, rounded, sharp)
    if across is None:
        apart = shown(float(sharp.root(square)[0]))
        raise Misfit(
            f"compass arcs around {a} (radius {shown(p)}) and {b} (radius {shown(q)}) do not meet, "
            f"the centres are {apart} apart",
            f"radii {'whose sum is at least' if (p + q) ** 2 < square else 'that differ by at most'} {apart}",
        )
    turned = across if data["side"] == "left" else -across
    return ax + along * dx - turned * dy, ay + along * dy + turned * dx, exact


def _arc_line(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    ((centre, radius),) = data["distances"].items()
    through, direction = data["on"]["through"], data["on"]["direction"]
    (cx, cy), (tx, ty) = at(centre), at(through) if isinstance(through, str) else through
    ux, uy, straight = vector(direction, at, sharp)
    square = ux * ux + uy * uy
    foot = (ux * (cx - tx) + uy * (cy - ty)) / square
    gap = (ux * (cy - ty) - uy * (cx - tx)) ** 2 / square
    half, exact = _half_chord((radius**2 - gap) / square, radius**2 / square, rounded, sharp)
    if half is None:
        gap_shown = shown(float(sharp.root(gap)[0]))
        raise Misfit(
            f"the arc around {centre} (radius {shown(radius)}) does not meet the line, which is {gap_shown} away",
            f"a radius of at least {gap_shown}",
        )
    step = foot + (half if data["pick"] == "right" else -half)
    return tx + step * ux, ty + step * uy, exact and straight


def _on_line(data: dict[str, Any], at: Where, rounded: bool, sharp: Reckoning) -> Put:
    first = data["on"].split()[0]
    (x, y), (ux, uy, _) = at(first), vector(data["on"], at, sharp)
    length, exact = sharp.root(ux * ux + uy * uy)
    return x + data["distance"] * ux / length, y + data["distance"] * uy / length, exact or not data["distance"]


def _half_chord(square: Any, radius_square: Any, rounded: bool, sharp: Reckoning) -> tuple[Any, bool]:
    """Half the chord that two curves cut out, from its square, and whether it is exact; none where they do not meet."""
    if square >= 0:
        return sharp.root(square)
    return (Fraction(0) if rounded and square >= -_TANGENT * radius_square else None), False


RULES: dict[str, Callable[[dict[str, Any], Where, bool, Reckoning], Put]] = {
    "given": _given,
    "polar": _polar,
    "compass": _compass,
    "arc-line": _arc_line,
    "on-line": _on_line,
}
