"""How links lie that drives have moved on from a given pose."""

from __future__ import annotations

from fractions import Fraction

from graphplan.mechanism.model import Scene
from graphplan.mechanism.numerals import Reckoning
from graphplan.mechanism.pairs.pair import Attitude
from graphplan.mechanism.plane import Number, Pair


def moved_on(given: Scene, shifts: tuple[Fraction, ...], by: Reckoning) -> tuple[Pair, ...]:
    """How each drive of a scene moves its link by so many degrees or lengths, counter-clockwise or along its direction:
    the cosine and sine of a turn, or the vector of a shift."""
    found: list[Pair] = []
    for drive, shift in zip(given.drives, shifts, strict=True):
        if not drive.slides:
            found.append(by.heading(shift)[:2])
            continue
        x, y = given.driven_slide(drive).direction
        square = x * x + y * y
        part = shift / by.root(Fraction(square) if isinstance(square, float) else square)[0]
        found.append((x * part, y * part))
    return tuple(found)


STILL = Attitude(0, 0, 1, 0)


def turned_about(at: Pair, cos: Number, sin: Number) -> Attitude:
    """A turn about a point."""
    x, y = at
    return Attitude(x - cos * x + sin * y, y - sin * x - cos * y, cos, sin)


def following(first: Attitude, then: Attitude) -> Attitude:
    """One after the other."""
    x, y = then.at((first.x, first.y))
    return Attitude(x, y, then.cos * first.cos - then.sin * first.sin,
                    then.sin * first.cos + then.cos * first.sin)


def undone(attitude: Attitude, at: Pair) -> Pair:
    """The point that an attitude brings to a place."""
    x, y = at[0] - attitude.x, at[1] - attitude.y
    return attitude.cos * x + attitude.sin * y, attitude.cos * y - attitude.sin * x
