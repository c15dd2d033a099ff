"""Printed numbers beside those that are right: fractions of the solver, which is another way than what is drawn."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import graphplan as gp

RATES = "velocity", "acceleration", "omega", "alpha"
Value = Any  # a number, or a vector as a complex number or a pair
Compared = tuple[str, str, Value, Value]


def compared(scene: gp.Scene, found: gp.Results) -> Iterator[Compared]:
    """Each printed number with its kind, its name, and what the solver makes of it in fractions."""
    rates = gp.analytic.solve(scene, exact=True)
    for kind in RATES:
        for name, value in getattr(found, kind).items():
            yield kind, name, value, getattr(rates, kind)[name]
    if scene.loads is not None:
        held = gp.analytic.reactions(scene, exact=True)
        for (point, link), value in held.joints.items():
            if (name := f"{link} at {point}") in found.reactions:
                yield "reaction", name, found.reactions[name], value
        for number, value in enumerate(held.balances):
            yield "balance", str(number), found.balances[number], value


def parts(value: Value) -> list[Fraction]:
    """A number alone, or both of a vector, exactly."""
    if isinstance(value, complex):
        return [Fraction(value.real), Fraction(value.imag)]
    return [*map(Fraction, value)] if isinstance(value, tuple) else [Fraction(value)]


def wrong(scene: gp.Scene, found: gp.Results, share: float, cancel: tuple[str, ...] = (),
          alone: bool = False) -> list[Compared]:
    """The numbers that are off by more than a share of their vector, or of the largest of a kind that cancels; `alone`
    of themselves, but that what has none of the twelve digits of the largest of its kind may be 0."""
    numbers = [*compared(scene, found)]
    assert numbers
    largest: dict[str, Fraction] = {}
    for kind, *_, right in numbers:
        largest[kind] = max(largest.get(kind, Fraction(0)), *map(abs, parts(right)))

    def off(kind: str, value: Value, right: Value) -> bool:
        whole = largest[kind] if kind in cancel else max(map(abs, parts(right)))
        return any(abs(one - true) > Fraction(share) * (abs(true) if alone else whole)
                   and not (alone and one == 0 and abs(true) * 10**11 <= largest[kind])
                   for one, true in zip(parts(value), parts(right), strict=True))

    return [(kind, name, value, right) for kind, name, value, right in numbers if off(kind, value, right)]
