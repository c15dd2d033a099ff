"""Where strokes of a drawing cross or end near letters: there a mark may be meant that has no dot."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from itertools import combinations

from shapely import Polygon, STRtree

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files.curves import circle
from graphplan.marking.judge import measures
from graphplan.marking.traces import Trace


def meetings(box: Polygon, reach: float, traces: Sequence[Trace], figures: STRtree) -> tuple[list[Trace], list[Trace]]:
    """Points where strokes cross about a box of letters, as sure as these are drawn; and where lines end."""
    strokes = [traces[place] for place in figures.query(box, "dwithin", reach)
               if traces[place].kind != POINT][:measures.STROKES_NEAR_LETTER]
    left, bottom, right, top = box.bounds

    def near(z: complex) -> bool:
        return math.hypot(max(left - z.real, 0.0, z.real - right), max(bottom - z.imag, 0.0, z.imag - top)) < reach

    found: list[complex] = []
    crossed, ends = list[Trace](), list[Trace]()
    for one, other in combinations(strokes, 2):
        for z, sine in _crossings(one, other):
            if near(z) and all(abs(z - before) > measures.SAME_CROSSING_MM for before in found):
                found.append(z)
                crossed.append(Trace(POINT, ((z.real, z.imag),), blur=measures.CROSSING_BLUR_MM / sine, crossed=True))
    for z in (complex(*spot) for one in strokes if one.kind == LINE for spot in one.spots):
        if near(z) and all(abs(z - before) > measures.SAME_CROSSING_MM for before in found):
            found.append(z)
            ends.append(Trace(POINT, ((z.real, z.imag),), crossed=True))
    return crossed, ends


def _crossings(one: Trace, other: Trace) -> Iterator[tuple[complex, float]]:
    """Where two strokes, lines as long as they are drawn, cross, and the sine of the angle."""
    if one.kind == other.kind == LINE:
        a, b, c, d = (complex(*spot) for spot in (*one.spots, *other.spots))
        u, v = b - a, d - c
        sine = (u.conjugate() * v).imag
        if abs(sine) > measures.MIN_CROSSING_SINE * abs(u) * abs(v):
            s, t = ((c - a).conjugate() * v).imag / sine, ((c - a).conjugate() * u).imag / sine
            if all(-measures.SAME_CROSSING_MM <= part * abs(way) <= abs(way) + measures.SAME_CROSSING_MM
                   for part, way in ((s, u), (t, v))):
                yield a + s * u, abs(sine) / (abs(u) * abs(v))
    elif CIRCLE in (one.kind, other.kind):
        line, arc = (one, other) if other.kind == CIRCLE else (other, one)
        found = circle(*arc.spots[:3])
        if found is None:
            return
        centre, radius = complex(*found[0]), found[1]
        if line.kind == LINE:
            a, b = (complex(*spot) for spot in line.spots)
            way = (b - a) / abs(b - a)
            foot = a + ((centre - a) * way.conjugate()).real * way
            half = radius**2 - abs(foot - centre) ** 2
            ends = [foot + sign * math.sqrt(half) * way for sign in (1, -1)] if half > 0 else []
            sine = max(measures.MIN_CROSSING_SINE, math.sqrt(max(half, 0.0)) / radius)
            yield from ((z, sine) for z in ends if -measures.SAME_CROSSING_MM <= ((z - a) * way.conjugate()).real
                        <= abs(b - a) + measures.SAME_CROSSING_MM)
        elif (second := circle(*line.spots[:3])) is not None:
            apart = complex(*second[0]) - centre
            if not 0 < abs(radius - second[1]) < abs(apart) < radius + second[1]:
                return
            along = (abs(apart) ** 2 + radius**2 - second[1] ** 2) / (2 * abs(apart))
            turn = math.acos(min(1.0, max(-1.0, along / radius)))
            sine = max(measures.MIN_CROSSING_SINE, math.sin(turn) * abs(apart) / second[1])
            yield from ((centre + cmath.rect(radius, cmath.phase(apart) + sign * turn), sine) for sign in (1, -1))
