"""The drawing as it comes out on paper: what coincides, how far a claim is from being met, what a step looks like.

A line is as true as the points that it passes through, and its direction as the points that set it lie far apart.

What centres of curvature must satisfy: the laws of Euler and Savary, tested on numbers.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import repeat
from typing import Any, NamedTuple

from graphplan.kernel.elementary import direction_source, incident
from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.kernel.program import EVERYWHERE, Panel, Step, Window
from graphplan.kernel.tolerances import COINCIDENCE_TOL, ULP


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
        """The list in which a line is stored."""
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
    """Largest distance between two lines within `reach` of the origin."""
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


@dataclass
class DrawnPoints:
    """The points among some steps by their places, in drawing order; steps and values may grow and be taken back."""

    steps: Sequence[Step]
    values: Sequence[Any]
    windows: Mapping[str, Window]
    _known: int = field(default=0, init=False)  # how many of the steps are looked at
    _groups: dict[tuple[str, bool] | int, list[int]] = field(default_factory=dict, init=False)  # by plan, by line
    _entries: list[tuple[int, list[int]]] = field(default_factory=list, init=False)

    def on_plan(self, plan: str, on_sheet: bool) -> Sequence[int]:
        """The points of a plan that lie on its sheet, or off it."""
        self._look_on()
        return self._groups.get((plan, on_sheet), ())

    def on_curve(self, curve: int) -> Sequence[int]:
        """The points that were marked on a line or a circle, by its place."""
        self._look_on()
        return self._groups.get(curve, ())

    def furthest(self, here: tuple[float, float], places: Sequence[int]) -> int:
        """The point that lies furthest from a place; of equals the first."""
        ways = [*map(math.dist, repeat(here), map(self.values.__getitem__, places))]
        return places[ways.index(max(ways))]

    def rewind(self, length: int) -> None:
        """Forget all steps after the first `length`."""
        if length < self._known:
            self._known = length
            while self._entries and self._entries[-1][0] >= length:
                self._entries.pop()[1].pop()

    def _look_on(self) -> None:
        """Look at the steps that are new."""
        for step in self.steps[self._known:]:
            if step.op.gives == POINT:
                on_sheet = self.windows.get(step.panel, EVERYWHERE).holds(self.values[step.index])
                for key in ((step.panel, on_sheet), *{step.args[place] for place in step.op.claim_operands("on")}):
                    group = self._groups.setdefault(key, [])
                    group.append(step.index)
                    self._entries.append((step.index, group))
        self._known = len(self.steps)


Vector = tuple[int, int]


class Drawn:
    """One step in numbers: its operands by place, -1 being what it made. Points and vectors are complex numbers.

    Lengths count beside the `size` of what the step was made from, and that as no less than `least`.
    """

    def __init__(self, step: Step, values: Sequence[Any], least: float = 0.0):
        self.kinds = (*step.op.reads, step.op.gives)
        self.numbers = [tuple(map(float, values[index])) for index in (*step.args, step.index)]
        self.params = step.params
        self.size = max(least, *map(_extent, self.kinds, self.numbers)) or 1.0

    def __getitem__(self, k: int) -> complex:
        """The point, or the centre of the circle, at a place."""
        return complex(*self.numbers[k][:2])

    def vector(self, ends: Vector) -> complex:
        return self[ends[1]] - self[ends[0]]

    def direction(self, k: int) -> complex:
        """The unit vector along which a line runs."""
        a, b, _ = self.numbers[k]
        return complex(b, -a) / math.hypot(a, b)

    def distance_off(self, k: int, X: complex) -> float:
        """Distance of a point to the left of a line, or outside a circle."""
        a, b, c = self.numbers[k]
        if self.kinds[k] == CIRCLE:
            return abs(X - complex(a, b)) - math.sqrt(c)
        return (a * X.real + b * X.imag + c) / math.hypot(a, b)

    def radius(self, k: int) -> float:
        """The radius of a circle, or the distance in the compasses."""
        return math.sqrt(self.numbers[k][-1])

    def number(self, name: str) -> float:
        return float(self.params.get(name, 0))

    def turn_to_image(self, u: complex) -> complex:
        """A vector of the link as its image runs."""
        return u if self.params["turn"] == "parallel" else 1j * u


def roundings(kind: str, numbers: tuple[float, ...], extent: float) -> list[float]:
    """Largest rounding errors of the numbers of a thing in a figure of this extent."""
    if kind == LINE:
        across = math.hypot(*numbers[:2])
        return [ULP * across, ULP * across, ULP * max(abs(numbers[2]), across * extent)]
    far = [ULP * max(abs(number), extent) for number in numbers]
    return far if kind == POINT else [*far[:-1], ULP * max(numbers[-1], extent * extent)]


def _extent(kind: str, numbers: tuple[float, ...]) -> float:
    """Distance of a thing from the origin, or its size."""
    if kind == LINE:
        return abs(numbers[2]) / math.hypot(numbers[0], numbers[1])
    if kind == POINT:
        return math.hypot(*numbers)
    return math.hypot(*numbers[:-1]) + math.sqrt(numbers[-1])


def unit(u: complex) -> complex:
    return u / (abs(u) or 1.0)


def dot(u: complex, v: complex) -> float:
    return (u.conjugate() * v).real


def cross(u: complex, v: complex) -> float:
    return (u.conjugate() * v).imag


def sideways(u: complex, v: complex) -> float:
    """Component of u perpendicular to v; the length of u if v is zero."""
    return cross(unit(v), u) if v else abs(u)


def component_along(u: complex, v: complex) -> float:
    """Component of u along v."""
    return dot(unit(v), u)


def short(length: float, ahead: bool) -> float:
    """By how much a length is not ahead, or not back, where it should be."""
    return max(0.0, -length if ahead else length)


def cross3(u: Sequence[float], v: Sequence[float]) -> tuple[float, float, float]:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def _third_error(d: Drawn, K: int, A: int, m: int, w: int) -> float:
    """The length mw is the mean proportional of KA and what is laid off."""
    KA, mean, drawn_length = abs(d[A] - d[K]), abs(d[w] - d[m]), abs(d[-1] - d[K])
    return (drawn_length * KA - mean * mean) / KA / (d.size + drawn_length)


def _curvature_error(d: Drawn, P: int, M: int, W: int) -> float:
    """Residual of PM^2 = MW * MC, W being the foot of the inflection pole on the ray."""
    ray = unit(d[P] - d[M])
    mean, foot, radius = abs(d[P] - d[M]), dot(ray, d[W] - d[M]), dot(ray, d[-1] - d[M])
    return (mean * mean - foot * radius) / d.size / (d.size + abs(radius))


def _conjugate_error(d: Drawn, P: int, A: int, A0: int, B: int, B0: int, M: int) -> float:
    """On each ray lay off 1/PX - 1/PX_0 from the pole: the ends lie on one line, the inverse of the inflection circle.
    """
    rows = []
    for X, X0 in ((A, A0), (B, B0)):
        near, ray = abs(d[X] - d[P]), unit(d[X] - d[P])
        gap = dot(ray, d[X0] - d[X])
        row = ray.real * gap, ray.imag * gap, near * (near + gap) / d.size
        rows.append((row[0] / math.hypot(*row), row[1] / math.hypot(*row), row[2] / math.hypot(*row)))
    x, y, w = cross3(*rows)  # of the line through the two ends; the flatter the rays cross, the less it tells
    near, ray = abs(d[M] - d[P]), unit(d[M] - d[P])
    far, across = dot(ray, d[-1] - d[P]), x * ray.real + y * ray.imag
    return (far * (across + w * near / d.size) - near * across) / (d.size + abs(far))


CURVATURE_CLAIMS: dict[str, tuple[Callable[..., float], str]] = {
    "third": (_third_error, "the length from {2} to {3} is no mean proportional"),
    "curved": (_curvature_error, "not the centre of curvature that the inflection pole {2} gives {1}"),
    "conjugate": (_conjugate_error, "no centre of curvature of {5} by Euler and Savary"),
}
