"""Continuation: the linkage followed step by step from its given pose, on one branch, up to where it cannot go on.

Each step is predicted from the last two knots (Hermite) and corrected by Newton. A step that is not certain to stay on
its branch is halved; where even the finest is not, the linkage is at a limit: a limit position (dead centre), or a
change point (such as a parallelogram with all links in line), from which several motions lead on and the lengths say
not which.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphplan.cycle.closure import Closure, Correction, given
from graphplan.cycle.linkage import Array, Linkage
from graphplan.cycle.newton import distance, settle
from graphplan.cycle.travel import TURN
from graphplan.mechanism.model import SlidingDrive

Progress = Callable[[float], None]
"""Is told how much of the path is followed, from 0 to 1."""

_LONGEST = 1 / 48
"""The longest step, of a turn: 7.5 degrees."""

_FINEST = 2.0**-36
"""The finest step, of the longest. Near a limit a pose changes with its root, so half of these digits stand there."""

_SLACK = 16
"""How many finest steps a limit may lie beyond the last knot: a step is only taken where several fit before it."""

_EASY = 1 / 512
"""Where the prediction missed by less, of the step, the next step is twice as long."""

_SINGULAR = -22 * math.log(2)
"""The smallest determinant of a part, of that in the given pose: below it, rounding may choose the branch."""

_ACROSS = 2.0**-12
"""The step, of the longest, that leads straight through a change point, and nowhere beyond a limit position.

It tells the change point to as small a part of itself: rounding weighs there as much.
"""


@dataclass(frozen=True)
class Knot:
    """One pose on the path and how it changes with the travel, both (1, 2, links), and the parts' determinants there.

    `senses` are the determinants' signs, `sizes` the logarithms of their sizes; both have the shape (1, parts).
    """

    travel: float
    pose: Array
    rate: Array
    senses: Array
    sizes: Array


@dataclass(frozen=True)
class Limit:
    """Where the linkage cannot be followed on: the travel, and to within what; the part that stops it; which kind."""

    travel: float
    slack: float
    part: tuple[str, ...]
    change: bool

    @property
    def kind(self) -> str:
        """What such a pose is called."""
        return "change point" if self.change else "limit position"


@dataclass(frozen=True)
class Path:
    """The knots in order of travel, the given pose among them, and the limits at the ends, if any."""

    knots: tuple[Knot, ...]
    lower: Limit | None
    upper: Limit | None

    @property
    def senses(self) -> Array:
        """The signs of the parts' determinants, the same in all poses."""
        return self.knots[0].senses

    @cached_property
    def _table(self) -> tuple[Array, Array, Array]:
        return (np.array([knot.travel for knot in self.knots]), np.concatenate([knot.pose for knot in self.knots]),
                np.concatenate([knot.rate for knot in self.knots]))

    def predicted(self, travel: Array) -> tuple[Array, Array]:
        """The poses at these travels by interpolation, and the length of the step between the knots beside each."""
        at, pose, rate = self._table
        i = np.clip(np.searchsorted(at, travel), 1, len(at) - 1)
        ends = (at[i - 1], pose[i - 1], rate[i - 1]), (at[i], pose[i], rate[i])
        return cubic(*ends, travel), distance(pose[i - 1], pose[i])

    def nearest(self, travel: Array) -> Array:
        """The poses of the knots nearest to these travels."""
        at, pose, _ = self._table
        return pose[np.argmin(np.abs(at - travel[:, None]), axis=1)]


class Continuation:
    """The path of a linkage from the given pose, either way."""

    def __init__(self, linkage: Linkage, lower: float, upper: float, progress: Progress | None = None):
        self.linkage, self.closure = linkage, Closure(linkage, linkage.parts)
        self.lower, self.upper, self.progress = lower, upper, progress or (lambda done: None)
        self.longest = _LONGEST * min(
            (upper - lower if isinstance(drive, SlidingDrive) else TURN) / abs(pace)
            for drive, pace in zip(linkage.scene.drives, linkage.paces, strict=True) if pace
        )
        self.finest = _FINEST * self.longest

    def path(self, closed: bool) -> Path:
        """As far as it leads, from `lower` to `upper`; round the other way too, where the cycle is closed."""
        pose = given(self.linkage)
        with np.errstate(all="ignore"):  # a singular given pose leads nowhere
            start = self._knot(0.0, pose, self.closure.correction(pose, np.zeros(1)))
            up, upper = self._walk(start, self.upper, 0.0)
            down, lower = self._walk(start, upper.travel - TURN if closed and upper else self.lower, 0.5)
        self.progress(1.0)
        return Path((*reversed(down), start, *up), lower, upper)

    def _knot(self, travel: float, pose: Array, correction: Correction) -> Knot:
        """The knot to which a correction has led."""
        return Knot(travel, pose, self.closure.rate(pose, correction), *self.closure.determinants(correction))

    def _walk(self, start: Knot, goal: float, done: float) -> tuple[list[Knot], Limit | None]:
        """The knots after the start, up to the goal or to the limit before it."""
        knots, step = [start], math.copysign(self.longest, goal)
        while (last := knots[-1]).travel != goal:
            left = goal - last.travel
            step = left if abs(left) <= abs(step) + self.finest else step
            travel = goal if step == left else last.travel + step
            predicted = _predicted(knots[-2:], travel)
            knot = self._corrected(last, predicted, travel)
            if knot is None or not _regular(knot, start):
                step /= 2
                if abs(step) < self.finest:
                    return self._stopped(knots, math.copysign(_ACROSS * self.longest, step))
                continue
            knots.append(knot)
            easy = distance(knot.pose, predicted)[0] <= _EASY * distance(predicted, last.pose)[0]
            step = 2 * step if easy and 2 * abs(step) <= self.longest else step
            self.progress(done + float(travel / goal) / 2)
        return knots[1:], None

    def _corrected(self, last: Knot, predicted: Array, travel: float) -> Knot | None:
        """The knot at this travel, if Newton's method is to be trusted there."""
        at = np.array([travel])
        pose, correction, trusted = settle(self.closure, predicted, at, distance(predicted, last.pose))
        return self._knot(travel, pose, correction) if trusted[0] else None

    def _stopped(self, knots: list[Knot], step: float) -> tuple[list[Knot], Limit]:
        """The knots after the first, up to a limit: one more where the motion leads straight through a change point.

        There a determinant goes through zero, as a straight line does on so short a way.
        """
        start, last = knots[0], knots[-1]
        beyond = self._corrected(last, _predicted([last], last.travel + step), last.travel + step)
        if beyond is None or np.array_equal(beyond.senses, last.senses):
            i = int(np.argmin(last.sizes - start.sizes))
            return knots[1:], Limit(last.travel, _SLACK * self.finest, self.linkage.parts[i], False)
        i = int(np.argmax(beyond.senses != last.senses))
        travel = last.travel + step / (1 + math.exp(beyond.sizes[0, i] - last.sizes[0, i]))
        there = replace(last, travel=travel, pose=hermite(last, beyond, np.array([travel])))
        return [*knots[1:], there], Limit(travel, _ACROSS * abs(step), self.linkage.parts[i], True)


def _predicted(knots: list[Knot], travel: float) -> Array:
    """The pose at this travel, from the last knot or two."""
    last = knots[-1]
    if len(knots) == 1:
        return _normal(last.pose + (travel - last.travel) * last.rate)
    pose = hermite(knots[0], last, np.array([travel]))
    pose[:, :, 0] = last.pose[:, :, 0]  # of the frame, which nothing corrects, the rounding would grow
    return pose


def _regular(knot: Knot, start: Knot) -> bool:
    """Whether a knot is on the branch of the given pose, and not too near to where another meets it."""
    return np.array_equal(knot.senses, start.senses) and bool(np.all(knot.sizes - start.sizes >= _SINGULAR))


def hermite(one: Knot, two: Knot, travel: Array) -> Array:
    """The poses at these travels on the cubics through two knots, between them or beyond."""
    return cubic((one.travel, one.pose, one.rate), (two.travel, two.pose, two.rate), travel)


def cubic(one: tuple[Array, Array, Array], two: tuple[Array, Array, Array], travel: Array) -> Array:
    """The poses at these travels on the cubics through two knots (travel, pose, rate): between them or beyond."""
    (at, pose, rate), (until, goal, arriving) = one, two
    step = np.broadcast_to(until - at, travel.shape)[:, None, None]
    x = ((travel - at) / (until - at))[:, None, None]
    return _normal((1 - x) ** 2 * ((1 + 2 * x) * pose + x * step * rate)
                   + x**2 * ((3 - 2 * x) * goal - (1 - x) * step * arriving))


def _normal(pose: Array) -> Array:
    """The same poses with turns of size 1."""
    pose[:, 1] /= np.abs(pose[:, 1])
    return pose
