"""Continuation: the linkage followed step by step from its given pose, on one branch, up to where it cannot go on.

Each step is predicted from the last two knots (Hermite) and corrected by Newton. A step that is not certain to stay on
its branch is halved; where even the finest is not, the linkage is at a limit: a limit position (dead centre), or a
change point (such as a parallelogram with all links in line), from which several motions lead on and the lengths say
not which.

Most steps need no halving. So the knots are first guessed all at once, by construction or by a sketch, and the steps
between them put to the same test together; from where one is not certain, the path is walked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from graphplan.cycle.linkage import SETTLED, Array, Closure, Linkage, distance, given, settle
from graphplan.cycle.travel import TURN, afford, travel_unit

Progress = Callable[[float], None]
"""Is told how much of the path is followed, from 0 to 1."""

Drawn = Callable[[Array], Array | None]
"""Gives the poses at some travels by construction, nan where one cannot be drawn; None where none ever can."""

_LONGEST = 1 / 48
"""The longest step, of a turn: 7.5 degrees."""

_BEGINNING = np.array([1 / 8, 1 / 4, 1 / 2])
"""Where the first step is divided: the tangent in one knot does not lead so far as the cubic through two."""

_KNOT = 1024
"""Bytes for each link in a step, as measured on long travels."""

_FINEST = 2.0**-36
"""The finest step, of the longest. Near a limit a pose changes with its root, so half of these digits stand there."""

_SLACK = 16
"""How many finest steps a limit may lie beyond the last knot: a step is only taken where several fit before it."""

_SKETCHED = 1 / 4
"""The largest correction of a sketched pose, of the step: beyond it the sketch ends."""

_EASY = 1 / 512
"""Where the prediction missed by less, of the step, the next step is twice as long."""

_SINGULAR = -22 * math.log(2)
"""The smallest determinant of a part, of that in the given pose: below it, rounding may choose the branch."""

_ACROSS = 2.0**-12
"""The step, of the longest, that leads straight through a change point, and nowhere beyond a limit position.

It tells the change point to as small a part of itself: rounding weighs there as much.
"""


@dataclass(frozen=True)
class Knots:
    """n poses on the path and how they change with the travel, both (n, 2, links), and the parts' determinants there.

    `senses` are the determinants' signs, `sizes` the logarithms of their sizes; both have the shape (n, parts).
    """

    travel: Array
    pose: Array
    rate: Array
    senses: Array
    sizes: Array

    def __getitem__(self, some: slice | Array) -> Knots:
        """Some of them."""
        return Knots(self.travel[some], self.pose[some], self.rate[some], self.senses[some], self.sizes[some])


def joined(knots: Sequence[Knots]) -> Knots:
    """Several runs of knots as one."""
    return Knots(*(np.concatenate([getattr(run, each.name) for run in knots]) for each in fields(Knots)))


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

    knots: Knots
    lower: Limit | None = None
    upper: Limit | None = None

    @property
    def senses(self) -> Array:
        """The signs of the parts' determinants, the same in all poses."""
        return self.knots.senses[0]

    def predicted(self, travel: Array) -> tuple[Array, Array]:
        """The poses at these travels by interpolation, and the length of the step between the knots beside each."""
        i = np.clip(np.searchsorted(self.knots.travel, travel), 1, len(self.knots.travel) - 1)
        before, after = self.knots[i - 1], self.knots[i]
        return hermite(before, after, travel), distance(before.pose, after.pose)

    def nearest(self, travel: Array) -> Array:
        """The poses of the knots nearest to these travels."""
        return self.knots.pose[np.argmin(np.abs(self.knots.travel - travel[:, None]), axis=1)]


class Continuation:
    """The path of a linkage from the given pose, either way."""

    def __init__(self, linkage: Linkage, lower: float, upper: float, drawn: Drawn, progress: Progress | None = None):
        self.linkage, self.closure, self.drawn = linkage, Closure(linkage, linkage.parts), drawn
        self.lower, self.upper, self.progress = lower, upper, progress or (lambda done: None)
        self.longest = _LONGEST * min((upper - lower if drive.slides else TURN) / abs(pace) for drive, pace
                                      in zip(linkage.scene.drives, linkage.paces, strict=True) if pace)
        self.finest = _FINEST * self.longest
        if self.longest:
            unit, name = travel_unit(linkage.scene)
            afford("the cycle", (upper - lower) / unit, name, _KNOT * len(linkage.links) * unit / self.longest)

    def path(self, closed: bool) -> Path:
        """As far as it leads, from `lower` to `upper`; round the other way too, where the cycle is closed."""
        pose = given(self.linkage)
        with np.errstate(all="ignore"):  # a singular given pose leads nowhere
            start = self._knots(np.zeros(1), pose)
            up, upper = self._led(start, self.upper, 0.0)
            down, lower = self._led(start, upper.travel - TURN if closed and upper else self.lower, 0.5)
        self.progress(1.0)
        return Path(joined([down[:0:-1], up]), lower, upper)

    def _knots(self, travel: Array, pose: Array, jacobian: Array | None = None) -> Knots:
        """These poses as knots; `jacobian` where it is known already."""
        jacobian = self.closure.equations(pose, travel)[1] if jacobian is None else jacobian
        return Knots(travel, pose, self.closure.rate(pose, jacobian), *self.closure.determinants(jacobian))

    def _led(self, start: Knots, goal: float, done: float) -> tuple[Knots, Limit | None]:
        """The knots from the start up to the goal, or to the limit before it."""
        begun = self._at_once(start, goal) if goal else start
        return (begun, None) if begun.travel[-1] == goal else self._walk(begun, goal, done)

    # ---- all at once ------------------------------------------------------------------------------------------

    def _at_once(self, start: Knots, goal: float) -> Knots:
        """Knots from the start towards the goal, guessed, as far as every step between them is certain."""
        travel = _divided(goal, self.longest)
        pose = self.drawn(travel)
        pose = self._sketched(start, travel) if pose is None else pose
        known = _first(~np.isnan(pose).any(axis=(1, 2)))
        knots = joined([start, self._knots(travel[:known], pose[:known])])
        return knots[: 1 + _first(self._certain(knots) & _regular(knots, start)[1:])]

    def _certain(self, knots: Knots) -> Array:
        """Whether each knot but the first is where a step of the walk leads, from those before it."""
        one, two, end = knots[:-2], knots[1:-1], knots[1:]
        predicted = np.concatenate([_ahead(knots[:1], end.travel[:1]), _onward(one, two, end.travel[1:])])
        step = distance(predicted, knots.pose[:-1])
        pose, _, trusted = settle(self.closure, predicted, end.travel, step)
        return trusted & (distance(pose, end.pose) <= SETTLED * step)

    def _sketched(self, start: Knots, travel: Array) -> Array:
        """A guess of the poses at these travels: a walk of steps twice as long, once corrected, and what lies between.

        It may give out before the last of them.
        """
        knots = [start]
        for at in _divided(travel[-1], 2 * self.longest)[:, None]:
            predicted = _predicted(knots, at)
            correction, jacobian = self.closure.correction(predicted, at)
            if not np.abs(correction).max() <= _SKETCHED * distance(predicted, knots[-1].pose)[0]:
                break
            knots.append(self._knots(at, self.closure.corrected(predicted, correction), jacobian))
        if len(knots) == 1:
            return start.pose[:0]
        travel = travel[np.abs(travel) <= np.abs(knots[-1].travel)]
        pose, step = Path(joined(knots if travel[-1] > 0 else knots[::-1])).predicted(travel)
        return settle(self.closure, pose, travel, step)[0]

    # ---- step by step -----------------------------------------------------------------------------------------

    def _walk(self, begun: Knots, goal: float, done: float) -> tuple[Knots, Limit | None]:
        """The knots up to the goal, or to the limit before it, from those with which the path begins."""
        start, knots = begun[:1], [begun[i:i + 1] for i in range(len(begun.travel))]
        at, step = float(begun.travel[-1]), math.copysign(self.longest, goal)
        while at != goal:
            left = goal - at
            step = left if abs(left) <= abs(step) + self.finest else step
            travel = np.array([goal if step == left else at + step])
            predicted = _predicted(knots, travel)
            knot = self._corrected(knots[-1], predicted, travel)
            if knot is None or not _regular(knot, start)[0]:
                step /= 2
                if abs(step) < self.finest:
                    return self._stopped(knots, math.copysign(_ACROSS * self.longest, step))
                continue
            easy = distance(knot.pose, predicted)[0] <= _EASY * distance(predicted, knots[-1].pose)[0]
            step = 2 * step if easy and 2 * abs(step) <= self.longest else step
            knots.append(knot)
            at = float(travel[0])
            self.progress(done + at / goal / 2)
        return joined(knots), None

    def _corrected(self, last: Knots, predicted: Array, travel: Array) -> Knots | None:
        """The knot at this travel, if Newton's method is to be trusted there."""
        pose, jacobian, trusted = settle(self.closure, predicted, travel, distance(predicted, last.pose))
        return self._knots(travel, pose, jacobian) if trusted[0] else None

    def _stopped(self, knots: list[Knots], step: float) -> tuple[Knots, Limit]:
        """The knots up to a limit: one more where the motion leads straight through a change point.

        There a determinant goes through zero, as a straight line does on so short a way.
        """
        start, last = knots[0], knots[-1]
        beyond = self._corrected(last, _ahead(last, last.travel + step), last.travel + step)
        if beyond is None or np.array_equal(beyond.senses, last.senses):
            i = int(np.argmin(last.sizes - start.sizes))
            limit = Limit(float(last.travel[0]), _SLACK * self.finest, self.linkage.parts[i], False)
            return joined(knots), limit
        i = int(np.argmax(beyond.senses != last.senses))
        travel = last.travel + step / (1 + math.exp(beyond.sizes[0, i] - last.sizes[0, i]))
        there = replace(last, travel=travel, pose=hermite(last, beyond, travel))
        return joined([*knots, there]), Limit(float(travel[0]), _ACROSS * abs(step), self.linkage.parts[i], True)


def _divided(goal: float, step: float) -> Array:
    """The ends of equal steps up to the goal, none longer than this one; the first is reached by halves of halves."""
    ends = np.linspace(0, goal, math.ceil(abs(goal) / step) + 1)[1:]
    return np.concatenate([ends[0] * _BEGINNING, ends])


def _predicted(knots: Sequence[Knots], travel: Array) -> Array:
    """The pose at this travel, from the last knot or two."""
    return _ahead(knots[0], travel) if len(knots) == 1 else _onward(knots[-2], knots[-1], travel)


def _ahead(last: Knots, travel: Array) -> Array:
    """The pose at this travel on the tangent in a knot."""
    return _normal(last.pose + (travel - last.travel)[:, None, None] * last.rate)


def _onward(one: Knots, last: Knots, travel: Array) -> Array:
    """The pose at each of these travels on the cubic through the two knots before."""
    pose = hermite(one, last, travel)
    pose[:, :, 0] = last.pose[:, :, 0]  # of the frame, which nothing corrects, the rounding would grow
    return pose


def _regular(knots: Knots, start: Knots) -> Array:
    """Whether each knot is on the branch of the given pose, and not too near to where another meets it."""
    return np.all((knots.senses == start.senses) & (knots.sizes - start.sizes >= _SINGULAR), axis=1)


def _first(fine: Array) -> int:
    """How many of the first are fine."""
    return int(np.argmin([*fine, False]))


def hermite(one: Knots, two: Knots, travel: Array) -> Array:
    """The poses at these travels on the cubics through two knots each, between them or beyond."""
    step = np.broadcast_to(two.travel - one.travel, travel.shape)[:, None, None]
    x = ((travel - one.travel) / (two.travel - one.travel))[:, None, None]
    return _normal((1 - x) ** 2 * ((1 + 2 * x) * one.pose + x * step * one.rate)
                   + x**2 * ((3 - 2 * x) * two.pose - (1 - x) * step * two.rate))


def _normal(pose: Array) -> Array:
    """The same poses with turns of size 1."""
    pose[:, 1] /= np.abs(pose[:, 1])
    return pose
