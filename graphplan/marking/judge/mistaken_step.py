"""One mistake: a step that is drawn in the place of another, with another operation, other marks read, a vector turned,
too long or elsewhere; so its rule gives what it makes, in any domain of numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import CIRCLE, LINE
from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.program import Step
from graphplan.phrases import Said


@dataclass(frozen=True)
class Mistake:
    """A step as it is drawn by mistake: its kind, how it is told, and the step; what is laid off, from its root or
    from the mark `start`, or the radius, is multiplied by `factor`, and by the distance of the first two marks of
    `radii` over that of the others; a point, or a line through the first of them, is mirrored in the line of two marks;
    a point is turned by a `half_turn` about the middle of two; or what is laid off from `start` is so from `other`,
    another mark, or one that this step makes later.
    """

    kind: str
    text: Said
    step: Step
    factor: complex = 1.0
    mirror: tuple[int, int] | None = None
    start: int | None = None
    radii: tuple[int, int, int, int] | None = None
    half_turn: tuple[int, int] | None = None
    other: int | Step | None = None

    @property
    def reads(self) -> tuple[int, ...]:
        """All marks that it is made of."""
        other_marks = self.other.args if isinstance(self.other, Step) else (self.other,)
        mark_groups = self.step.args, self.mirror, (self.start,), self.radii, self.half_turn, other_marks
        return tuple(mark for marks in mark_groups for mark in marks or () if mark is not None)

    def value(self, domain: Domain, values: list[Any] | dict[int, Any]) -> Any:
        """What it makes of these marks; fails as the step's rule does."""
        result = _made_by(self.step, domain, values)
        if self.other is not None and self.start is not None:
            start = values[self.start]
            root = _made_by(self.other, domain, values) if isinstance(self.other, Step) else values[self.other]
            return root[0] + result[0] - start[0], root[1] + result[1] - start[1]
        if self.half_turn:
            P, Q = (values[mark] for mark in self.half_turn)
            return P[0] + Q[0] - result[0], P[1] + Q[1] - result[1]
        if self.mirror:
            return (_mirror_line if self.step.op.gives == LINE else _mirror_point)(
                domain, result, *(values[arg] for arg in self.mirror))
        if self.factor == 1.0 and not self.radii:
            return result
        if self.step.op.gives == CIRCLE:
            return *result[:2], result[2] * abs(self.factor) ** 2
        root = self.step.root if self.start is None else self.start
        assert root is not None, f"{self.step.op.name} lays nothing off"
        start = values[root]
        ratio = _distance_ratio(domain, *(values[mark] for mark in self.radii)) if self.radii else 1.0
        dx, dy, c, s = result[0] - start[0], result[1] - start[1], self.factor.real * ratio, self.factor.imag * ratio
        return start[0] + c * dx - s * dy, start[1] + s * dx + c * dy


def value_of(step: Step, values: list[Any] | dict[int, Any], mistake: Mistake | None
             ) -> tuple[float, ...] | None:
    """What a step makes of plain values, or a mistake at it; None where it cannot be drawn."""
    try:
        result: tuple[float, ...] = mistake.value(Floats(), values) if mistake else _made_by(step, Floats(), values)
    except Undrawable:
        return None
    return result if all(map(math.isfinite, result)) else None


def _made_by(step: Step, domain: Domain, values: list[Any] | dict[int, Any]) -> Any:
    """What a step makes of these marks; fails as its rule does."""
    return step.op.rule(domain, *[values[arg] for arg in step.args], **step.params)


def _mirror_point(domain: Domain, point: Any, P: Any, Q: Any) -> Any:
    """A point on the other side of the line PQ."""
    u, w = (Q[0] - P[0], Q[1] - P[1]), (point[0] - P[0], point[1] - P[1])
    square = domain.nonzero(u[0] * u[0] + u[1] * u[1], 1.0, "points-coincide", "the two points coincide")
    along = (u[0] * w[0] + u[1] * w[1]) / square
    return P[0] + 2 * along * u[0] - w[0], P[1] + 2 * along * u[1] - w[1]


def _mirror_line(domain: Domain, line: Any, P: Any, Q: Any) -> Any:
    """A line through P on the other side of the line PQ."""
    away = P[0] + line[1], P[1] - line[0]
    x, y = _mirror_point(domain, away, P, Q)
    a, b = P[1] - y, x - P[0]
    return a, b, -(a * P[0] + b * P[1])


def _distance_ratio(domain: Domain, P: Any, Q: Any, R: Any, S: Any) -> Any:
    """The distance PQ over the distance RS."""
    first_square, second_square = ((B[0] - A[0]) * (B[0] - A[0]) + (B[1] - A[1]) * (B[1] - A[1])
                                   for A, B in ((P, Q), (R, S)))
    return domain.sqrt(first_square / domain.nonzero(second_square, 1.0, "points-coincide", "the two points coincide"),
                       "", "")
