"""Circles by spots of their rims, lines by their ends, and chains of spots recognized as either."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from shapely import STRtree

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.tolerances import BULGE_TOL, COLLINEAR_TOL
from graphplan.marking.traces import Spot, Trace

DOT, SMALL = 1.5, 100  # mm: no compass strikes so small a circle, a pair's symbol has 1.2; nor so small a part of all
RING = 4  # spots of a whole circle
HALVED, SQUARED = 0.05, 0.7  # of their length that strokes of a cross may miss their middles; the sine of their angle
NEAR = 0.01  # how far spots may lie off a line or circle that they are to show, beside its size
FAR_CLOSER = 10  # times: where an arc is so much closer to spots than a line, they show no line
ROUND = 12  # straight pieces at least that show a circle
SHORT = 0.5  # mm: a straight piece shorter than this shows no line
SHARP = math.radians(45)  # the corner of an outline that is as sharp as a tip


def ring(centre: Spot, radius: float) -> tuple[Spot, ...]:
    """Four spots of a circle's rim."""
    (x, y), r = centre, radius
    return (x + r, y), (x, y + r), (x - r, y), (x, y - r)


def bow(centre: Spot, radius: float, start: float, end: float) -> tuple[Spot, ...]:
    """Both ends and the middle of an arc, counter-clockwise between two angles in degrees; four spots of a circle."""
    sweep = (end - start) % 360 or 360.0
    if sweep == 360:
        return ring(centre, radius)
    z = complex(*centre)
    spots = [z + cmath.rect(radius, math.radians(start + part * sweep)) for part in (0.0, 0.5, 1.0)]
    return tuple([(spot.real, spot.imag) for spot in spots])


def full(centre: Spot, radius: float) -> Trace:
    """A circle."""
    return Trace(CIRCLE, ring(centre, radius))


def dotted(traces: Sequence[Trace]) -> list[Trace]:
    """The things with points for what stands for them: circles and crosses that are small beside all."""
    size = extent([spot for trace in traces for spot in trace.spots] or [(0.0, 0.0)])
    most = min(DOT, size / SMALL)
    return _uncrossed([dot(trace, most) for trace in traces], most)


def dot(trace: Trace, radius: float = DOT) -> Trace:
    """A circle, or the point that a small one stands for."""
    if trace.kind != CIRCLE or len(trace.spots) != RING:
        return trace
    found = circle(*trace.spots[:3])
    return Trace(POINT, (found[0],)) if found and found[1] < radius else trace


def _uncrossed(traces: Sequence[Trace], most: float) -> list[Trace]:
    """With a point for every two short strokes that halve each other."""
    short = [trace for trace in traces if trace.kind == LINE and math.dist(*trace.spots) < 3 * most]
    found, crosses = dict[Trace, Trace | None](), STRtree([trace.figure.centroid for trace in short])
    for one in short:
        for place in crosses.query(one.figure.centroid, "dwithin", HALVED * one.figure.length):
            other = short[place]
            ways = [complex(*trace.spots[1]) - complex(*trace.spots[0]) for trace in (one, other)]
            across = abs((ways[0].conjugate() * ways[1]).imag)
            if one not in found and other not in found and across > SQUARED * max(abs(way) for way in ways) ** 2:
                at = one.figure.centroid
                found |= {one: Trace(POINT, ((at.x, at.y),)), other: None}
    return [kept for trace in traces if (kept := found.get(trace, trace))]


def pieces(spots: Sequence[Spot], short: float = 0.0) -> Iterator[Trace]:
    """A chain of straight pieces: one line where it is straight, a circle where it is as round, else line by line;
    what is not longer than `short` shows none."""
    if len(spots) > 2 and (far := extent(spots)) > short and _bulge(spots) <= NEAR * far:
        yield Trace(LINE, (spots[0], spots[-1]))
    elif len(spots) > ROUND and (found := curved(spots)):
        yield found
    else:
        for start, end in pairwise(spots):
            if math.dist(start, end) > short:
                yield Trace(LINE, (start, end))


def curved(spots: Sequence[Spot]) -> Trace | None:
    """The line, circle, arc or dot that a smooth curve through these spots is; None where it is another.

    A flat arc is as good as straight; it is an arc where it lies closer to its circle by far.
    """
    count, far = len(spots) - 1, extent(spots)
    closed = math.dist(spots[0], spots[-1]) < NEAR * far
    parts = [spots[count * i // 4] for i in range(4)] if closed else [spots[0], spots[count // 2], spots[-1]]
    found = circle(*parts[:3])
    off = max(abs(math.dist(spot, found[0]) - found[1]) for spot in spots) if found else math.inf
    bulge = _bulge(spots)
    if bulge <= NEAR * far and not BULGE_TOL * far < bulge > FAR_CLOSER * off:
        return Trace(LINE, (spots[0], spots[-1])) if far > SHORT else None
    if found is None or off > NEAR * found[1]:
        return None
    return Trace(CIRCLE, tuple(parts))


def tips(corners: Sequence[Spot]) -> Iterator[Spot]:
    """The sharp corners of an outline, as the tip of an arrow's head is."""
    spots = [complex(*corner) for corner in corners]
    for before, here, after in zip([*spots[-1:], *spots], spots, [*spots[1:], *spots[:1]], strict=False):
        ways = (before - here) * (after - here).conjugate()
        if ways and abs(cmath.phase(ways)) < SHARP:
            yield here.real, here.imag


def circle(first: Spot, second: Spot, third: Spot) -> tuple[Spot, float] | None:
    """Centre and radius of the circle through three spots; None where they lie on a line."""
    a, b, c = (complex(*spot) for spot in (first, second, third))
    u, v = b - a, c - a
    across = 2 * (u.conjugate() * v).imag
    if abs(across) <= COLLINEAR_TOL * abs(u) * abs(v):
        return None
    z = a + 1j * (v * abs(u) ** 2 - u * abs(v) ** 2) / -across
    return (z.real, z.imag), abs(z - a)


def reach(at: complex, along: complex, spots: Iterable[Spot]) -> tuple[Spot, Spot] | None:
    """As much of an endless line as lies beside these spots; None where that is nothing."""
    if not along:
        return None
    along /= abs(along)
    steps = [((complex(*spot) - at) * along.conjugate()).real for spot in spots]
    if not steps or min(steps) == max(steps):
        return None
    start, end = at + min(steps) * along, at + max(steps) * along
    return (start.real, start.imag), (end.real, end.imag)


def aside(line: Sequence[Spot], spot: Spot) -> float:
    """How far a spot lies off an endless line through two others."""
    a, b = complex(*line[0]), complex(*line[1])
    return abs(((complex(*spot) - a) * (b - a).conjugate()).imag) / abs(b - a) if a != b else math.dist(line[0], spot)


def extent(spots: Iterable[Spot]) -> float:
    """The diagonal of what spots cover."""
    xs, ys = zip(*spots, strict=True)
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys))


def _bulge(spots: Sequence[Spot]) -> float:
    """How far spots lie off the stretch from the first to the last."""
    a, b = complex(*spots[0]), complex(*spots[-1])
    if a == b:
        return extent(spots)
    along = (b - a) / abs(b - a)
    offs = [(complex(*spot) - a) * along.conjugate() for spot in spots]
    return max(max(abs(off.imag), -off.real, off.real - abs(b - a)) for off in offs)
