"""Where plans lie on paper on which nothing is printed: the frame in which most dots are marks of a plan.

That a plan has the direction of the mechanism and the task's scale is likeliest; another scale must be borne out by
more marks, and a turn by most. A mistake moves its mark and all that follow: what comes first tells most, and lines
that run on as they should from marks that are off speak for a frame as well.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, permutations

import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans import measures
from graphplan.marking.tolerances import MIN_DIVISOR
from graphplan.marking.traces import PlanFrame

Spots = NDArray[np.complex128]
IsDrawn = Callable[[complex, complex], bool]


def find_plans(dots: Spots, crossings: Spots, marks: Sequence[complex], unit: complex,
               is_drawn: IsDrawn) -> list[PlanFrame]:
    """The frame of a plan of which the first of some marks is the beginning, and those next that are drawn from fewest
    others, where it is usually scaled and turned by a unit, and after it a rival, if one is about as good; none where
    few dots speak for any. `is_drawn` says whether a line is between two spots: marks without one count little. Where
    lines cross there may be a dot that is not seen. No plan is turned slightly: then its marks are off."""
    page, plan = _SpotsSeen(dots, crossings), np.array(marks, np.complex128)
    usual = (page.spots[:, None] - unit * plan).ravel(), np.full(len(page.spots) * len(plan), unit)
    weighed = list[tuple[float, PlanFrame, dict[int, complex]]]()
    own_origins, own_units = _own_frames(dots, plan, unit, is_drawn)
    is_upright = np.isclose(np.angle(own_units / unit), 0.0)
    upright, turned = ((own_origins[which], own_units[which]) for which in (is_upright, ~is_upright))
    for origins, units in (usual, upright, turned):
        for frame in page.best_frames(origins, units, plan):
            for _ in range(measures.PLAN_FITS):
                frame = _fit_frame(frame, unit, page, plan, is_drawn)
            near = page.marks_near(frame, plan)
            support = _support(near, is_drawn, abs(frame.unit)) + _carried_support(
                near, dots, frame.unit * plan, is_drawn)
            spots = {mark.order: mark.spot for mark in near}
            weighed.append((support - _unlikelihood(frame.unit / unit), frame, spots))
    weighed.sort(key=lambda one: -one[0])
    if not weighed or weighed[0][0] < measures.MIN_PLAN_DOTS:
        return []
    best, frame, spots = weighed[0]
    rivals = (rival for score, rival, own_spots in weighed if score > best - measures.CLEAR_PLAN_DOTS
              and 2 * len(own_spots.items() & spots.items()) <= len(own_spots))
    return [frame, *islice(rivals, 1)]


class _SpotsSeen:
    """The spots of a page that may be marks, and what each speaks for that."""

    def __init__(self, dots: Spots, crossings: Spots):
        self.spots = np.concatenate([dots, crossings])
        self.worth = np.repeat([1.0, measures.CROSSING_DOTS], [len(dots), len(crossings)])

    def best_frames(self, origins: Spots, units: Spots, marks: Spots) -> Iterator[PlanFrame]:
        """The likeliest of some frames: those for which most dots speak, which count less the further off they are."""
        scores = np.zeros(len(origins))
        for first in range(0, len(origins), measures.FRAMES_AT_ONCE):
            piece = slice(first, first + measures.FRAMES_AT_ONCE)
            for order, mark in enumerate(marks):
                nearness = self._nearness(order, (origins[piece] + units[piece] * mark)[:, None])
                scores[piece] += nearness.max(axis=1, initial=0)
        for k in np.argsort(-scores)[:measures.PLANS_WEIGHED]:
            yield PlanFrame(complex(origins[k]), complex(units[k]))

    def _nearness(self, order: int, at: complex | Spots) -> NDArray[np.float64]:
        """What each spot is worth as a mark that is to be there: later ones may be further off."""
        reach = measures.MARK_NEAR_MM + measures.SLIP_PER_MARK_MM * order
        return self.worth * np.clip(1 - (np.abs(self.spots - at) / reach) ** 2, 0, None)

    def marks_near(self, frame: PlanFrame, marks: Spots) -> list[_MarkSeen]:
        """The marks that have a spot where a frame has them."""
        marks_seen = []
        for order, mark in enumerate(marks.tolist()):
            nearness = self._nearness(order, frame.to_sheet(mark))
            if nearness.max(initial=0.0):
                best = int(nearness.argmax())
                is_dot = bool(self.worth[best] == 1.0)
                marks_seen.append(_MarkSeen(order, mark, complex(self.spots[best]), is_dot, float(nearness[best])))
        return marks_seen


@dataclass(frozen=True)
class _MarkSeen:
    """A mark of a plan, its place in their order, and the spot near it: whether that is a dot, and how near, 0..1."""

    order: int
    mark: complex
    spot: complex
    is_dot: bool
    nearness: float


def _own_frames(dots: Spots, marks: Spots, unit: complex, is_drawn: IsDrawn) -> tuple[Spots, Spots]:
    """The frames, by their origins and units, in which two dots with a line between are any two marks, which have not
    quite another scale."""
    pairs = [(dot, end) for dot, end in permutations(dots.tolist(), 2) if abs(dot - end) > measures.MIN_TELLING_MM
             and is_drawn(*sorted((dot, end), key=abs))]
    between = [(mark, end) for mark, end in permutations(marks.tolist(), 2)
               if abs(mark - end) * abs(unit) > measures.MIN_TELLING_MM]
    starts, ends = np.array(pairs, np.complex128).reshape(-1, 2).T[:, :, None]
    mark, second = np.array(between, np.complex128).reshape(-1, 2).T[:, None, :]
    ratios = _upright((ends - starts) / (second - mark) / unit)
    wide = np.abs(ratios)
    is_likely = (wide > 1 / measures.MAX_SCALE_RATIO) & (wide < measures.MAX_SCALE_RATIO)
    units = ratios[is_likely] * unit
    return (np.broadcast_to(starts, ratios.shape)[is_likely]
            - units * np.broadcast_to(mark, ratios.shape)[is_likely]), units


def _upright(ratios: Spots) -> Spots:
    """Turns of plans against the mechanism, but slight ones, which nobody means."""
    return np.where(np.abs(np.angle(ratios)) < measures.MIN_PLAN_TURN_RAD, np.abs(ratios), ratios)


def _unlikelihood(ratio: complex) -> float:
    """How many dots must speak for a plan that is so many times as large as usual, and turned."""
    if not np.isclose(np.angle(ratio), 0.0):
        return measures.TURNED_PLAN_DOTS
    return measures.OWN_SCALE_DOTS * min(1.0, abs(math.log(abs(ratio))) / measures.OTHER_SCALE_LOG)


def _support(seen: Sequence[_MarkSeen], is_drawn: IsDrawn, unit: float) -> float:
    """How many dots speak for a frame: those at which lines of the plan end, those of its beginning most, and of these
    the first, with which its scale was chosen."""
    ends = set(_line_ends(seen, is_drawn))
    begun = [mark for mark in seen if mark.order == 0]
    vectors = [end for end in seen if begun and end.is_dot and is_drawn(begun[0].spot, end.spot)
               and abs(end.mark - begun[0].mark) * unit > measures.MIN_TELLING_MM]
    firsts = sum(end.nearness for end in vectors if end.order == 1)
    return measures.FIRST_VECTOR_DOTS * firsts + measures.VECTOR_DOTS * len(vectors) + sum(
        one.nearness * (1.0 if one in ends else measures.LONE_DOTS) for one in seen)


def _carried_support(seen: Sequence[_MarkSeen], dots: Spots, vectors: Spots, is_drawn: IsDrawn) -> float:
    """How many dots speak for a frame that are not where it has marks, but to which lines run from other marks as they
    should: after a mistake, what follows rightly from it. `vectors` are those to the marks."""
    spots, lines = {mark.order: mark.spot for mark in seen}, 0
    for order, vector in enumerate(vectors.tolist()):
        if order in spots:
            continue
        free = dots[~np.isin(dots, list(spots.values()))]
        counts = np.zeros(len(free), int)
        for start, spot in spots.items():
            along = (free - spot) * np.conj(vector - vectors[start]) / max(abs(vector - vectors[start]), MIN_DIVISOR)
            is_on = (np.abs(along.real) > measures.MIN_TELLING_MM) & (
                np.abs(along.imag) < measures.LINE_OFF_MM + measures.LINE_OFF_SLOPE * np.abs(along.real))
            for k in np.flatnonzero(is_on):
                counts[k] += is_drawn(*sorted((complex(free[k]), spot), key=abs))
        if counts.any():
            spots[order] = complex(free[counts.argmax()])
            lines += min(2, int(counts.max()))
    return measures.CARRIED_DOTS * lines


def _line_ends(seen: Sequence[_MarkSeen], is_drawn: IsDrawn) -> list[_MarkSeen]:
    """The marks between which and another a line is drawn."""
    return [one for one in seen if any(abs(one.spot - two.spot) > measures.MIN_LINK_MM and is_drawn(one.spot, two.spot)
                                       for two in seen)]


def _fit_frame(frame: PlanFrame, usual: complex, page: _SpotsSeen, marks: Spots, is_drawn: IsDrawn) -> PlanFrame:
    """A frame where its dots have it: upright, unless it is clearly turned, and with the usual scale, if it has about
    that. The marks that come first tell it best, as what goes before shakes the others, and crossings worse than dots;
    those at which no line ends are chance dots."""
    near = page.marks_near(frame, marks)
    if len(ends := _line_ends(near, is_drawn)) > 1:
        near = ends
    if min(len({one.spot for one in near}), len({one.mark for one in near})) < 2:
        return frame
    plan, sheet = np.array([one.mark for one in near]), np.array([one.spot for one in near])
    weights = np.array([one.nearness / ((measures.DOT_ERROR_MM if one.is_dot else measures.CROSSING_ERROR_MM) ** 2
                                        + (measures.SLIP_PER_MARK_MM * one.order) ** 2) for one in near])
    ratio = PlanFrame.least_squares(plan, sheet, weights).unit / usual
    unsure = 1 / float(np.sqrt((weights * np.abs(sheet - np.average(sheet, weights=weights)) ** 2).sum()))
    if abs(np.angle(ratio)) < measures.MIN_PLAN_TURN_RAD:
        ratio = ratio.real
    unit = complex(usual * (1.0 if abs(ratio - 1) < unsure else ratio))
    return PlanFrame(complex(np.average(sheet - unit * plan, weights=weights)), unit)
