"""The origin about which a program is evaluated: a place within its figure, where that lies far off zero.

A line is known by its distance from the origin. Where two lines cross far off, twice as many digits would cancel as the
coordinates have in front of the figure's extent; about a place within it none do.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.kernel.numbers import Domain

MAX_OFFSET = 100
"""So many extents of a figure its points may lie off zero: up to four digits of what is drawn there cancel."""


@dataclass(frozen=True)
class Origin:
    """A place far off zero."""

    x: Fraction
    y: Fraction

    def relative_coordinates(self, domain: Domain, x: Any, y: Any) -> dict[str, Any]:
        """The coordinates of a given point from this place."""
        return {"x": domain.lift(x) - domain.lift(self.x), "y": domain.lift(y) - domain.lift(self.y)}

    def absolute_marks(self, domain: Domain, kinds: Iterable[str], values: Iterable[Any]) -> list[Any]:
        """Marks that are drawn about this place, as they lie about zero; those of no kind stay as they are."""
        x, y = domain.lift(self.x), domain.lift(self.y)
        return [_shift_mark(kind, value, x, y) for kind, value in zip(kinds, values, strict=True)]

    def point(self, domain: Domain, value: Any) -> Any:
        """A point that is told from this place, as it lies about zero."""
        return _shift_mark(POINT, value, domain.lift(self.x), domain.lift(self.y))


def _shift_mark(kind: str, value: Any, x: Any, y: Any) -> Any:
    if kind in (POINT, CIRCLE):
        return value[0] + x, value[1] + y, *value[2:]
    return (value[0], value[1], value[2] - (value[0] * x + value[1] * y)) if kind == LINE else value


def origin(points: Collection[tuple[Any, Any]]) -> Origin | None:
    """A round place within these points, where they lie far off zero; None where they do not."""
    axes = [[Fraction(float(coordinate)) for coordinate in axis] for axis in zip(*points, strict=True)]
    extent = max((max(axis) - min(axis) for axis in axes), default=Fraction(0))
    if not extent or max(abs(coordinate) for axis in axes for coordinate in axis) < MAX_OFFSET * extent:
        return None
    unit = Fraction(2) ** (extent.numerator.bit_length() - extent.denominator.bit_length())
    x, y = (round((max(axis) + min(axis)) / 2 / unit) * unit for axis in axes)
    return Origin(x, y)


def on_pose(steps: Sequence[Any]) -> Iterator[str]:
    """The kind of each mark that lies on the plan of the pose's points; of others, which begin at zero, nothing."""
    return (step.op.gives if step.panel == steps[0].panel else "" for step in steps)


def shift_steps(steps: Sequence[Any], x: Any, y: Any) -> tuple[Any, ...]:
    """The same steps with the points of the pose moved by a vector."""
    return tuple(step.but(params={"x": step.params["x"] + x, "y": step.params["y"] + y})
                 if step.op.movement is Movement.GIVEN else step for step in steps)
