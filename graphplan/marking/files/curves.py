"""Circles by spots of their rims, lines by their ends, and chains of spots recognized as either."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.traces import Spot, Trace

DOT = 1.5  # mm: no compass strikes so small a circle, a pair's symbol has 1.2
NEAR = 0.01  # how far spots may lie off a line or circle that they are to show, beside its size
FLAT, FAR_CLOSER = 1e-6, 10  # what bulges less is straight; so many times closer an arc is no line
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
    """A circle, or the point that a small one stands for."""
    return Trace(POINT, (centre,)) if radius < DOT else Trace(CIRCLE, ring(centre, radius))


def pieces(spots: Sequence[Spot]) -> Iterator[Trace]:
    """A chain of straight pieces: one line where it is straight, a circle where it is as round, else line by line."""
    if len(spots) > 2 and (far := _size(spots)) > SHORT and _bulge(spots) <= NEAR * far:
        yield Trace(LINE, (spots[0], spots[-1]))
    elif len(spots) > ROUND and (found := curved(spots)):
        yield found
    else:
        for start, end in pairwise(spots):
            if math.dist(start, end) > SHORT:
                yield Trace(LINE, (start, end))


def curved(spots: Sequence[Spot]) -> Trace | None:
    """The line, circle, arc or dot that a smooth curve through these spots is; None where it is another.

    A flat arc is as good as straight; it is an arc where it lies closer to its circle by far.
    """
    count, far = len(spots) - 1, _size(spots)
    closed = math.dist(spots[0], spots[-1]) < NEAR * far
    parts = [spots[count * i // 4] for i in range(4)] if closed else [spots[0], spots[count // 2], spots[-1]]
    found = circle(*parts[:3])
    off = max(abs(math.dist(spot, found[0]) - found[1]) for spot in spots) if found else math.inf
    bulge = _bulge(spots)
    if bulge <= NEAR * far and not FLAT * far < bulge > FAR_CLOSER * off:
        return Trace(LINE, (spots[0], spots[-1])) if far > SHORT else None
    if found is None or off > NEAR * found[1]:
        return None
    return full(*found) if closed and found[1] < DOT else Trace(CIRCLE, tuple(parts))


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
    if abs(across) <= 1e-12 * abs(u) * abs(v):
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


def _size(spots: Iterable[Spot]) -> float:
    """The diagonal of what spots cover."""
    xs, ys = zip(*spots, strict=True)
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys))


def _bulge(spots: Sequence[Spot]) -> float:
    """How far spots lie off the stretch from the first to the last."""
    a, b = complex(*spots[0]), complex(*spots[-1])
    if a == b:
        return _size(spots)
    along = (b - a) / abs(b - a)
    offs = [(complex(*spot) - a) * along.conjugate() for spot in spots]
    return max(max(abs(off.imag), -off.real, off.real - abs(b - a)) for off in offs)
