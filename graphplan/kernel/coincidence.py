"""Lines of the drawn pose that fall on one another: where one lies already no pencil draws a second.

A line is as true as the points that it passes through, and its direction as the points that set it lie far apart.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from graphplan.kernel.incidence import direction_source, incident
from graphplan.kernel.kinds import CIRCLE, Movement
from graphplan.kernel.program import Panel, Step
from graphplan.kernel.tolerances import COINCIDENCE_TOL


class LyingLine(NamedTuple):
    """A line on a plan: its step, its equation with a unit normal, the largest number that it was made from, and how
    many times worse than to rounding its direction is known."""

    step: int
    plan: Panel
    normal: tuple[float, float]
    offset: float
    reach: float
    swing: float

    def holds(self, point: tuple[float, float], reach: float) -> bool:
        """Whether a point, made from numbers as large as `reach`, lies on it."""
        (a, b), (x, y) = self.normal, point
        return abs(a * x + b * y + self.offset) <= COINCIDENCE_TOL * self.swing * max(self.reach, reach)

    def is_parallel(self, other: LyingLine) -> bool:
        """Whether another line has its direction."""
        (a, b), (c, d) = self.normal, other.normal
        return abs(a * d - b * c) <= COINCIDENCE_TOL * (self.swing + other.swing)


@dataclass
class LyingLines:
    """The lines that are drawn, in drawing order; `values` and `reach` are those of all steps by now.

    They are kept by plan, by about their direction, and by about their distance from the origin, a `pitch` apart; those
    that are known too badly for that by plan and direction alone.
    """

    values: Sequence[Any]
    reach: Sequence[float]
    pitch: float = 0.0
    lines: list[LyingLine] = field(default_factory=list)
    fell: bool = False  # whether a line has fallen on another
    _drawers: dict[tuple[str, float], dict[int | None, list[LyingLine]]] = field(default_factory=dict)
    _swings: dict[int, float] = field(default_factory=dict)

    def enter_line(self, step: Step, apart: bool = False) -> int | None:
        """Enter a line that is drawn; if one lies there already its step is given instead, but where lines are drawn
        apart."""
        line = self._lying(step)
        ends = [(self.values[place][:2], self.reach[place]) for place in map(step.args.__getitem__, incident(step.op))]
        old = None if apart or not ends else min(
            (old.step for old in self._neighbours(line, max(max(math.hypot(*end), reach) for end, reach in ends))
             if old.is_parallel(line) and all(old.holds(*end) for end in ends)), default=None)
        if old is None:
            self.lay([line])
        else:
            self.fell = True
        return old

    def _neighbours(self, line: LyingLine, far: float) -> Iterator[LyingLine]:
        """The lines that may be one with a line whose ends are so far."""
        part, spread = line.normal[0] * line.normal[0], 4 * COINCIDENCE_TOL * line.swing
        for direction in {round(part - spread, 3), round(part + spread, 3)}:
            shelves = self._drawers.get((line.plan, direction), {})
            if self._is_sharp(line, far):
                place = abs(line.offset) / self.pitch
                for shelf in {None, round(place - 0.5), round(place + 0.5)}:
                    yield from shelves.get(shelf, ())
            else:
                for lines in shelves.values():
                    yield from lines

    def _is_sharp(self, line: LyingLine, far: float) -> bool:
        """Whether a line is known well enough for a shelf of its own, with ends so far."""
        return 4 * COINCIDENCE_TOL * line.swing * max(line.reach, far) < self.pitch / 4

    def _shelf(self, line: LyingLine) -> list[LyingLine]:
        """Where a line is kept."""
        distance = abs(line.offset)
        place = round(distance / self.pitch) if self._is_sharp(line, distance) else None
        drawer = self._drawers.setdefault((line.plan, round(line.normal[0] * line.normal[0], 3)), {})
        return drawer.setdefault(place, [])

    def lay(self, lines: Sequence[LyingLine]) -> None:
        """Enter lines that were drawn before, or one that is drawn now."""
        self.lines += lines
        for line in lines:
            self._swings[line.step] = line.swing
            self._shelf(line).append(line)

    def _lying(self, step: Step) -> LyingLine:
        a, b, c = self.values[step.index]
        n = math.hypot(a, b)
        base, _ = direction_source(step.op)
        swing = 1.0
        if step.op.movement is Movement.RULED:
            swing = max(1.0, *(self.reach[arg] / n for arg in step.args))
        elif base is not None:
            swing = self._swings[step.args[base]]
        return LyingLine(step.index, step.panel, (a / n, b / n), c / n, self.reach[step.index], swing)

    def since(self, length: int) -> list[LyingLine]:
        """The lines of the steps after the first `length`."""
        return self.lines[bisect_left(self.lines, length, key=lambda line: line.step):]

    def rewind(self, length: int) -> None:
        """Take back the lines of all steps after the first `length`."""
        while self.lines and self.lines[-1].step >= length:
            self._shelf(self.lines.pop()).pop()


def runs_against(one: Any, two: Any) -> bool:
    """Whether two lines run opposite ways."""
    return bool(sum(p * q for p, q in zip(one, two, strict=True)) < 0)


def line_gap(one: Any, two: Any, reach: float) -> float:
    """How far apart two lines run within `reach` of the origin."""
    n, m = math.hypot(one[0], one[1]), math.hypot(two[0], two[1])
    foot = -one[0] / n * one[2] / n, -one[1] / n * one[2] / n
    gap = abs(two[0] * foot[0] + two[1] * foot[1] + two[2]) / m
    return float(gap + reach * abs(one[0] * two[1] - one[1] * two[0]) / n / m)


def crossing(step: Step, values: Sequence[Any]) -> float:
    """The sine of the angle under which the two curves of a crossing meet."""
    X = complex(*values[step.index])
    one, two = (_normal(kind, values[arg], X) for kind, arg in zip(step.op.reads, step.args, strict=True))
    return abs((one.conjugate() * two).imag)


def _normal(kind: str, curve: Any, X: complex) -> complex:
    """The unit normal of a line, or of a circle at X."""
    normal = X - complex(*curve[:2]) if kind == CIRCLE else complex(*curve[:2])
    return normal / (abs(normal) or 1.0)
