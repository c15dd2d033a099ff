"""Controls: what a finished plan shows though nothing was drawn by it.

The lines from a link's points to the ends of their orthogonal velocities meet in its pole. Where no pole was marked two
of them show it, and the others must pass through it (N. Rosenauer, Acta Universitatis Latviensis, Mech. II, No. 14
(1939), step 6; No. 16).
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any, NamedTuple

from graphplan.kernel.kinds import POINT
from graphplan.kernel.program import Program
from graphplan.mechanism.model import Scene
from graphplan.methods.panels import MECHANISM
from graphplan.methods.tolerances import CONTROL_TOL

SHARP = 0.2  # the sine under which two lines cross well enough to show a pole
Line = tuple[Any, Any, Any]


class Control(NamedTuple):
    """Three points of a link, and as marks of the drawn program each of them with the end of its orthogonal velocity.

    The first two lines cross in the pole of the link, through which the third must pass.
    """

    link: str
    points: tuple[str, ...]
    marks: tuple[tuple[int, int], ...]

    def drawn_deviation(self, values: Sequence[Any]) -> Any:
        """How far the pole is drawn off the third line, times the length of its drawn velocity."""
        return _crossing_deviation(*(_line_through(values[start], values[end]) for start, end in self.marks))

    def true_deviation(self, points: Mapping[str, Any], velocities: Mapping[str, Any]) -> Any:
        """The same of true velocities, each square to the line through its point."""
        lines = [(v[0], v[1], -v[0] * x - v[1] * y) for name in self.points
                 for v, (x, y) in [(velocities[name], points[name])]]
        return _crossing_deviation(*lines)


def controls(scene: Scene, program: Program, values: Sequence[Any], ends: Mapping[str, tuple[int, int]],
             shown: Callable[[tuple[float, float]], bool]) -> Iterator[Control]:
    """The controls of a drawn program: those whose pole counts as `shown` on the sheet and is not marked there.

    `ends` are the marks of points with the ends of their orthogonal velocities.
    """
    size = float(scene.extent)
    marks = sorted(values[step.index] for step in program.steps if step.op.gives == POINT and step.panel == MECHANISM)
    for link in scene.moving:
        drawn = {ends[name]: name for name in scene.links[link] if name in ends}
        lines = {(start, end): _line_through(values[start], values[end]) for start, end in drawn
                 if math.dist(values[start], values[end]) > CONTROL_TOL * size}
        pair = max(combinations(lines, 2), key=lambda two: _sine(*map(lines.__getitem__, two)), default=None)
        if pair is None or _sine(*(lines[one] for one in pair)) < SHARP:
            continue
        pole = _meet(*(lines[one] for one in pair))
        if shown(pole) and not _is_marked(pole, marks, CONTROL_TOL * size):
            for other in lines:
                if other not in pair:
                    three = (*pair, other)
                    yield Control(link, tuple(drawn[one] for one in three), three)


def _is_marked(place: tuple[float, float], marks: Sequence[tuple[float, float]], gap: float) -> bool:
    """Whether one of the marks, which are sorted, is no further from a place than a gap."""
    x, _ = place
    first, last = bisect_left(marks, (x - gap,)), bisect_right(marks, (x + gap, math.inf))
    return any(math.dist(place, mark) <= gap for mark in marks[first:last])


def _line_through(P: Any, Q: Any) -> Line:
    """The line through two points."""
    return P[1] - Q[1], Q[0] - P[0], P[0] * Q[1] - Q[0] * P[1]


def _meet(one: Line, two: Line) -> tuple[float, float]:
    (a, b, c), (d, e, f) = one, two
    return (b * f - e * c) / (a * e - b * d), (d * c - a * f) / (a * e - b * d)


def _sine(one: Line, two: Line) -> float:
    (a, b, _), (d, e, _) = one, two
    return float(abs(a * e - b * d) / math.hypot(a, b) / math.hypot(d, e))


def _crossing_deviation(one: Line, two: Line, three: Line) -> Any:
    """How far the crossing of two lines is off a third, times the length of its normal; nothing in three that meet."""
    (a, b, c), (d, e, f), (g, h, i) = one, two, three
    return (g * (b * f - e * c) + h * (d * c - a * f)) / (a * e - b * d) + i
