"""A linkage followed step by step along its closure curve: what its type, its defects and its travel are in motion.

The angle of OA and that of BC, or the place of the slide, are followed together over the curve on which AB has its
length, through dead points too, as a mechanism moves that is pushed at whichever link turns it on.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

STEP = 0.004  # of the size of the linkage
MAX_STEPS = 20_000
SAME_TURN = 1e-6  # radians
ROUNDS = 4  # of Newton at each step


@dataclass(frozen=True)
class Visit:
    """A position that is passed: which, how far OA has turned, and whether beyond a dead point."""

    position: int
    turned: float
    beyond: bool

    def is_at(self, other: Visit) -> bool:
        """Whether both are one."""
        return self.position == other.position and abs(self.turned - other.turned) < SAME_TURN


class Trace:
    """The curve of a linkage from its first position, one way: `visits` until it closes, windings, and dead points."""

    def __init__(self, linkage: Any, way: int):
        self.linkage, self.b = linkage, linkage.sides["A B"]
        self.size = max(linkage.sides.values())
        self.goals = [self._state(k) for k in range(len(linkage.A))]
        self.visits: list[Visit] = []
        self.angles: list[tuple[float, float]] = []  # how far OA has turned, and the transmission angle
        self._follow(way)
        self.at_last = self._transmission(*self.goals[-1])

    def _state(self, k: int) -> tuple[float, float]:
        """The place along the circle of A and along the circle or guide of B."""
        A, B = self.linkage.A[k] - self.linkage.O, self.linkage.B[k]
        if self.linkage.C is None:
            return cmath.phase(A) * abs(A), ((B - self.linkage.B[0]) / self.linkage.guide).real
        return cmath.phase(A) * abs(A), cmath.phase(B - self.linkage.C) * abs(B - self.linkage.C)

    def _points(self, p: float, q: float) -> tuple[complex, complex, complex, complex]:
        """A and B, and which way each goes."""
        a = self.linkage.sides["O A"]
        u = cmath.exp(1j * p / a)
        if self.linkage.C is None:
            return self.linkage.O + a * u, self.linkage.B[0] + q * self.linkage.guide, 1j * u, self.linkage.guide
        c = self.linkage.sides["B C"]
        v = cmath.exp(1j * q / c)
        return self.linkage.O + a * u, self.linkage.C + c * v, 1j * u, 1j * v

    def _gradient(self, p: float, q: float) -> tuple[float, float, float]:
        """By how much AB is too long, and how that grows with both places."""
        A, B, dA, dB = self._points(p, q)
        rod = B - A
        return ((abs(rod) - self.b), -(rod.conjugate() * dA).real / abs(rod), (rod.conjugate() * dB).real / abs(rod))

    def _gap(self, k: int, p: float, q: float) -> tuple[float, float]:
        """From a place to a position, the shorter way round."""
        a, c = self.linkage.sides["O A"], self.linkage.sides.get("B C")
        u, v = self.goals[k][0] - p, self.goals[k][1] - q
        return math.remainder(u, 2 * math.pi * a), v if c is None else math.remainder(v, 2 * math.pi * c)

    def _transmission(self, p: float, q: float) -> float:
        A, B, _, dB = self._points(p, q)
        return math.degrees(math.asin(min(1.0, abs(((B - A) / abs(B - A) * dB.conjugate()).real))))

    def _follow(self, way: int) -> None:
        p, q = self.goals[0]
        start, (_, fp, fq) = (p, q), self._gradient(p, q)
        heading, h = (way * abs(fq), -way * fp * math.copysign(1, fq)), STEP * self.size
        a, turned, coupler = self.linkage.sides["O A"], 0.0, 0.0
        side, dead = math.copysign(1, fq), False
        self.angles.append((0.0, self._transmission(p, q)))
        for count in range(MAX_STEPS):
            _, fp, fq = self._gradient(p, q)
            tangent = (-fq / math.hypot(fp, fq), fp / math.hypot(fp, fq))
            if tangent[0] * heading[0] + tangent[1] * heading[1] < 0:
                tangent = -tangent[0], -tangent[1]
            heading = tangent
            for k in range(len(self.goals)):
                u, v = self._gap(k, p, q)
                ahead = u * tangent[0] + v * tangent[1]
                if math.hypot(u, v) < 1.5 * h and 0 <= ahead < h and (count > 2 or k):
                    visit = Visit(k, (turned + u) / a, dead)
                    if not (self.visits and self.visits[-1].is_at(visit)):  # a long step sees it once more
                        self.visits.append(visit)
            if count > 2 and self.visits and self.visits[-1].position == 0:
                break
            A, B, *_ = self._points(p, q)
            x, y = p + h * tangent[0], q + h * tangent[1]
            for _ in range(ROUNDS):
                f, gp, gq = self._gradient(x, y)
                square = gp * gp + gq * gq
                x, y = x - f * gp / square, y - f * gq / square
            turned += x - p
            after, before = self._points(x, y), (A, B)
            coupler += cmath.phase((after[1] - after[0]) / (before[1] - before[0]))
            p, q = x, y
            dead = dead or math.copysign(1, self._gradient(p, q)[2]) != side
            if not dead:
                self.angles.append((turned / a, self._transmission(p, q)))
        self.windings = round(turned / a / 2 / math.pi), round((q - start[1]) / self.linkage.sides.get(
            "B C", math.inf) / 2 / math.pi), round(coupler / 2 / math.pi)


def traced_type(trace: Trace) -> str:
    """The type by which links have gone right round."""
    if trace.linkage.C is None:
        return "slider-crank"
    return {(True, False): "crank-rocker", (True, True): "double-crank", (False, True): "rocker-crank"}.get(
        (bool(trace.windings[0]), bool(trace.windings[1])), "double-rocker" if trace.windings[2] else "triple-rocker")


def traced_defects(traces: Sequence[Trace]) -> tuple[set[str], tuple[float, float, float] | None]:
    """The defects, and without these how far OA turns to the last position, the least transmission angle, and by how
    much that changes in a step at most."""
    forth, count = traces[0], len(traces[0].goals)
    sides = {math.copysign(1, forth._gradient(*goal)[2]) for goal in forth.goals}
    visited = {0, *(visit.position for visit in forth.visits)}
    defects = ({"branch"} if len(sides) > 1 else set()) | ({"circuit"} if len(visited) < count else set())
    ways = []
    for trace in traces:
        run = []
        for visit in trace.visits:
            run.append(visit)
            if visit.position == count - 1:
                break
        if [visit.position for visit in run] == [*range(1, count)] and not run[-1].beyond:
            ways.append((abs(run[-1].turned), trace))
    if not defects and not ways:
        return {"order"}, None
    if defects:
        return defects, None
    turn, trace = min(ways, key=lambda way: way[0])
    way = [angle for turned, angle in trace.angles if abs(turned) <= turn] + [trace.at_last]
    widest = max(abs(high - low) for low, high in pairwise(way))
    return set(), (math.degrees(turn), min(way), widest)
