"""Directions: of guides and lines, given by a vector, by an angle in degrees, or by two points."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from graphplan.mechanism.fields import Kind, Names
from graphplan.mechanism.items import Item, Vector
from graphplan.mechanism.numerals import TO_A_FLOAT, Reckoning, exactly, is_exact
from graphplan.mechanism.plane import Pair
from graphplan.mechanism.values import NAME, NUMBER, VECTOR

Direction = Vector | Fraction | str
"""A direction as written: a vector, an angle in degrees, or two points such as "O A"."""

Written = Direction | None
"""A direction as the scene writes it, if it does."""

Where = Callable[[str], tuple[Any, Any]]
"""Gives a named point's coordinates, in fractions or in any numbers that compute with them."""

_EIGHTHS = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))
"""A direction may have any length, so the multiples of 45 degrees are exact."""


class Misfit(Exception):
    """Raised by a geometric rule whose figure cannot be drawn: what is wrong, and what would be right."""

    def __init__(self, what: str, instead: str):
        self.what, self.instead = what, instead
        super().__init__(what)


def _direction(item: Item, names: Names) -> Direction | None:
    """A direction in one of its three spellings."""
    if isinstance(item.value, list):
        components = item.vector()
        if components is not None and not any(components):
            return item.fault("the direction is zero", "a vector that is not [0, 0]")
        return components
    if isinstance(item.value, str):
        if not {*item.value.split()} <= {*names.points} and (told := item.slip()):
            return item.fault(*told)
        return item.two_points(names.points, "O A")
    return item.number()


def _guide(item: Item, names: Names) -> tuple[Pair, tuple[str, ...] | None, Written] | None:
    """A guide's direction in this pose, the two points that give it, if points do, and the direction as written."""
    direction = _direction(item, names)
    if direction is None:
        return None
    through = points_of(direction)
    if any(name not in names.placed for name in through):
        return (Fraction(1), Fraction(0)), through, direction  # the point has its own fault; look for more
    try:
        x, y, exact = vector(direction, lambda name: exactly(names.placed[name]))
    except Misfit as misfit:
        return item.fault(misfit.what, misfit.instead)
    if not exact:
        names.irrational.append(f"{item.where}: angle")
    rational = exact and is_exact(*(names.placed[name] for name in through))
    return (x, y) if rational else (float(x), float(y)), through or None, direction


TWO_POINTS = Kind("two points", lambda item, names: item.two_points(names.points, "A B"),
                  {"type": "string", "pattern": rf"^\s*{NAME}\s+{NAME}\s*$"})
DIRECTION = Kind("direction", _direction, {"anyOf": [VECTOR.schema, NUMBER.schema, TWO_POINTS.schema]})
GUIDE = Kind("direction", _guide, DIRECTION.schema)


def points_of(direction: object) -> tuple[str, ...]:
    """The points that give a direction, if points do."""
    return tuple(direction.split()) if isinstance(direction, str) else ()


def vector(direction: Direction, at: Where, by: Reckoning = TO_A_FLOAT) -> tuple[Any, Any, bool]:
    """The direction as a vector, and whether it is exact (provided that its points are)."""
    if isinstance(direction, tuple):
        return *direction, True
    if isinstance(direction, Fraction):
        if direction % 45 == 0:
            x, y = _EIGHTHS[int(direction / 45) % 8]
            return Fraction(x), Fraction(y), True
        return by.heading(direction)
    (x0, y0), (x1, y1) = (at(name) for name in points_of(direction))
    if (x0, y0) == (x1, y1):
        raise Misfit(f"the points {direction} coincide and give no direction", "two points that lie apart")
    return x1 - x0, y1 - y0, True
