"""What was drawn, taken apart: the line with the most crests first, then of what is left, again and again.

Each crest votes for the lines through it in about its own direction (P. Hough); crests in a row are fitted by least
squares, with gaps no wider than a pencil leaves. Crests that bend are carried on as a circle's rim; what is neither
straight nor round, such as letters, is left."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from graphplan.kernel.kinds import CIRCLE, LINE
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Flags, Places, Sizes, Spots
from graphplan.marking.scans.pencil_pixels import PencilInk, Ridges
from graphplan.marking.traces import Trace


@dataclass(frozen=True)
class CrestStretch:
    """From where to where something was drawn, in mm along it, and the share of it that is seen."""

    start: float
    end: float
    seen_share: float

    @property
    def long(self) -> float:
        return self.end - self.start


def crest_stretches(along: Sizes, hidden: Callable[[Sizes], Flags]
              ) -> Iterator[CrestStretch]:
    """The stretches that crests at these places make; where print hides a line, it may well go on."""
    low = float(along.min())
    count = int((float(along.max()) - low) / measures.STROKE_CELL_MM) + 1
    is_drawn = np.zeros(count, bool)
    is_drawn[np.minimum(((along - low) / measures.STROKE_CELL_MM).astype(int), count - 1)] = True
    open_ = ~hidden(np.asarray(low + (np.arange(count) + 0.5) * measures.STROKE_CELL_MM, np.float64)) | is_drawn
    counted = np.cumsum(open_)  # so much of it could have been seen
    marked = np.flatnonzero(is_drawn)
    breaks = np.flatnonzero(np.diff(counted[marked]) > measures.MAX_GAP_MM / measures.STROKE_CELL_MM + 1)
    for first, last in zip([0, *(breaks + 1)], [*breaks, len(marked) - 1], strict=True):
        start, end = int(marked[first]), int(marked[last])
        share = (last - first + 1) / max(1, int(open_[start : end + 1].sum()))
        yield CrestStretch(low + start * measures.STROKE_CELL_MM, low + (end + 1) * measures.STROKE_CELL_MM, share)


@dataclass(frozen=True)
class CrestRow:
    """Crests in a row: a spot amid them, their direction and the normal to its left, and of each crest, how far along
    and off it is."""

    at: Spots
    direction: Spots
    normal: Spots
    which: Places
    along: Sizes
    off: Sizes

    def spots(self, along: Sizes, off: Sizes | float = 0.0) -> Spots:
        """Spots so far along the row and off it."""
        return np.asarray(self.at + np.multiply.outer(along, self.direction)
                          + np.multiply.outer(off + np.zeros(len(along)), self.normal))

    def drawn_stretches(self, ink: PencilInk) -> Iterator[CrestStretch]:
        """The stretches of it that were drawn."""
        return crest_stretches(self.along, lambda along: ink.are_hidden_or_dark(self.spots(along)))

    def in_stretch(self, stretch: CrestStretch) -> Flags:
        """Which of its crests a run has."""
        return (stretch.start <= self.along) & (self.along <= stretch.end)


def crest_row(found: Ridges, at: Spots, normal: Spots, which: Places) -> CrestRow:
    """Some crests beside a line through a spot, by its normal."""
    direction, out = np.array([normal[1], -normal[0]]), found.spots[which] - at
    return CrestRow(at, direction, normal, which, out @ direction, out @ normal)


def crests_near_line(found: Ridges, left: Places, angle: float, shift: float) -> CrestRow | None:
    """The crests, of those that are left, near the line whose normal has this angle, so many mm from the origin."""
    normal = np.array([math.cos(angle), math.sin(angle)])
    at, which = normal * shift, left
    for reach in measures.ROW_REACHES_MM:
        near = np.abs((found.spots[which] - at) @ normal) < reach
        near &= np.abs(found.normals[which] @ normal) > measures.MIN_NORMAL_COSINE
        if near.sum() < measures.MIN_CRESTS:
            return None
        chosen = which[near]
        if which is left:  # a line turns by no more than a few times its width
            which = left[np.abs((found.spots[left] - at) @ normal) < 4 * reach]
        at = found.spots[chosen].mean(axis=0)
        spread = found.spots[chosen] - at
        normal = np.linalg.eigh(spread.T @ spread)[1][:, 0]
    return crest_row(found, at, normal, chosen)


def line_trace(crests: CrestRow, stretch: CrestStretch) -> Trace:
    """A run of a row as its two ends; it is as unsure as its crests are rough, the less the longer it is."""
    on = crests.in_stretch(stretch)
    slope, level = np.polyfit(crests.along[on], crests.off[on], 1)
    ends = np.array([stretch.start, stretch.end])
    (x, y), (u, v) = crests.spots(ends, slope * ends + level).tolist()
    rough = float(np.std(crests.off[on] - slope * crests.along[on] - level))
    return Trace(LINE, ((x, y), (u, v)), blur=rough / math.sqrt(max(1.0, stretch.long)))


def is_bent(crests: CrestRow, stretch: CrestStretch) -> bool:
    """Whether the crests of a run follow a bow rather than a line."""
    on = crests.in_stretch(stretch)
    along, off = crests.along[on] - crests.along[on].mean(), crests.off[on]
    bow = np.polyfit(along, off, 2)
    sag = abs(bow[0]) * (stretch.long / 2) ** 2
    straight, bent = (np.std(off - np.polyval(fit, along)) for fit in (np.polyfit(along, off, 1), bow))
    return bool(sag > measures.MIN_SAG_MM and bent < measures.BOW_RATIO * straight)


@dataclass(frozen=True)
class Rim:
    """A circle, and its run, in mm along it from the side `zero`, an angle; with its crests and how rough they are."""

    centre: Spots
    radius: float
    zero: float
    stretch: CrestStretch
    which: Places
    rough: float

    def trace(self) -> Trace:
        """The rim as spots of it, as far as it was drawn."""
        count = max(measures.MIN_RIM_SPOTS,
                    math.ceil(math.degrees(self.stretch.long / self.radius) / measures.RIM_SPOTS_DEGREES))
        spots = rim_spots(self.centre, self.radius, self.zero, np.linspace(self.stretch.start, self.stretch.end, count))
        blur = self.rough / math.sqrt(max(1.0, self.stretch.long))
        return Trace(CIRCLE, tuple((float(x), float(y)) for x, y in spots), blur=blur)


def rim_spots(centre: Spots, radius: float, zero: float, along: Sizes) -> Spots:
    """Spots of a circle, so many mm along it from the side `zero`."""
    turns = zero + along / radius
    return np.asarray(centre + radius * np.column_stack([np.cos(turns), np.sin(turns)]))


def angles_from(out: Spots, zero: float) -> Sizes:
    """Angles of spots about a centre, from the side `zero`."""
    return np.asarray((np.arctan2(out[:, 1], out[:, 0]) - zero + math.pi) % (2 * math.pi) - math.pi)


def grow_rim(found: Ridges, left: Places, seed: Places, ink: PencilInk) -> Rim | None:
    """The circle that some crests begin and others, of those that are left, carry on; None where they make none."""
    rim, chosen = None, seed
    for _ in range(measures.RIM_ROUNDS):
        centre, radius = fit_circle(found.spots[chosen])
        if not measures.MIN_RIM_RADIUS_MM < radius < measures.MAX_RIM_RADIUS_MM:
            return None
        middle = found.spots[seed].mean(axis=0) - centre
        larger = _crests_on_circle(found, left, centre, radius, math.atan2(middle[1], middle[0]), ink)
        if larger is None or (rim is not None and len(larger.which) <= len(rim.which)):
            break
        rim, chosen = larger, larger.which
    return (rim if rim and rim.rough < measures.MAX_RIM_ROUGHNESS_MM
            and rim.stretch.seen_share > measures.MIN_STROKE_SHARE
            else None)


def fit_circle(spots: Spots) -> tuple[Spots, float]:
    """The centre and the radius of the circle of least squares (I. Kåsa, 1976)."""
    middle = spots.mean(axis=0)
    x, y = (spots - middle).T
    (u, v, w), *_ = np.linalg.lstsq(np.column_stack([2 * x, 2 * y, np.ones(len(x))]), x**2 + y**2, rcond=None)
    return middle + np.array([u, v]), math.sqrt(max(w + u**2 + v**2, 0.0))


def _crests_on_circle(found: Ridges, left: Places, centre: Spots, radius: float, zero: float,
                      ink: PencilInk) -> Rim | None:
    """The run of crests on a circle that has this side of it."""
    out = found.spots[left] - centre
    far = np.hypot(out[:, 0], out[:, 1])
    square = np.abs((out * found.normals[left]).sum(axis=1)) > measures.MIN_NORMAL_COSINE * far
    near = (np.abs(far - radius) < measures.RIM_REACH_MM) & square
    if not near.any():
        return None
    along = angles_from(out[near], zero) * radius
    stretches = crest_stretches(along, lambda at: ink.are_hidden_or_dark(rim_spots(centre, radius, zero, at)))
    central = [stretch for stretch in stretches if stretch.start <= 1.0 and stretch.end >= -1.0]
    if not central:
        return None
    stretch = max(central, key=lambda stretch: stretch.long)
    on = (stretch.start <= along) & (along <= stretch.end)
    return Rim(centre, radius, zero, stretch, left[near][on], float(np.std(far[near][on] - radius)))


class Vote:
    """Hough's accumulator: angles of normals by distances from the origin."""

    def __init__(self, found: Ridges):
        self.count = round(math.pi / measures.VOTE_TURN_RAD)
        self.reach = int(np.hypot(*np.abs(found.spots).max(axis=0, initial=1.0)) / measures.VOTE_SHIFT_MM) + 2
        angle = np.arctan2(found.normals[:, 1], found.normals[:, 0])
        unsure = np.arange(-measures.NORMAL_CELLS, measures.NORMAL_CELLS + 1)
        cells = np.rint(angle / measures.VOTE_TURN_RAD).astype(int)[:, None] + unsure
        turn = cells % self.count * measures.VOTE_TURN_RAD
        shift = found.spots[:, :1] * np.cos(turn) + found.spots[:, 1:] * np.sin(turn)
        level = np.rint(shift / measures.VOTE_SHIFT_MM).astype(int) + self.reach
        self.cells = cells % self.count * (2 * self.reach + 1) + level
        self.weight = np.minimum(found.strength, measures.MAX_CREST_VOTES)
        self.votes = self._count(np.arange(len(found)))
        self.best = 0

    def peak(self) -> tuple[float, float] | None:
        """The angle and the distance that most crests vote for; None where there are too few."""
        self.best = int(self.votes.argmax())
        if self.votes[self.best] < measures.MIN_LINE_MM * measures.VOTES_PER_MM:
            return None
        turn, level = divmod(self.best, 2 * self.reach + 1)
        return turn * measures.VOTE_TURN_RAD, (level - self.reach) * measures.VOTE_SHIFT_MM

    def remove(self, which: Places) -> None:
        """Take crests away."""
        self.votes -= self._count(which)

    def forget(self) -> None:
        """Do not look here again."""
        turn, level = divmod(self.best, 2 * self.reach + 1)
        for i in (-1, 0, 1):
            cell = (turn + i) % self.count * (2 * self.reach + 1) + level
            self.votes[max(0, cell - 1) : cell + 2] = measures.SILENCED_VOTES

    def _count(self, which: Places) -> Sizes:
        cells = self.cells[which]
        weight = np.repeat(self.weight[which], cells.shape[1])
        votes = np.bincount(cells.ravel(), weight, self.count * (2 * self.reach + 1))
        return np.asarray(votes, np.float64)


def find_strokes(found: Ridges, ink: PencilInk) -> list[Trace]:
    """The lines and rims among crests, the longest lines first; what is taken is no longer there."""
    vote, is_left, traces = Vote(found), np.ones(len(found), bool), list[Trace]()
    for _ in range(measures.MAX_LINES):
        peak = vote.peak()
        if peak is None:
            break
        crests = crests_near_line(found, np.flatnonzero(is_left), *peak)
        for stretch in crests.drawn_stretches(ink) if crests else ():
            assert crests
            crests_taken = crests.which[crests.in_stretch(stretch)]
            crests_taken = crests_taken[is_left[crests_taken]]
            if (stretch.long >= measures.MIN_LINE_MM and stretch.seen_share >= measures.MIN_STROKE_SHARE
                and len(crests_taken) >= measures.MIN_CRESTS):
                rim = grow_rim(found, np.flatnonzero(is_left), crests_taken, ink) if is_bent(crests, stretch) else None
                if rim and rim.stretch.long < measures.RIM_RATIO * stretch.long:
                    rim = None  # a hand that wobbles bends lines, too, but no further than they go
                traces.append(rim.trace() if rim else line_trace(crests, stretch))
                taken = rim.which if rim else crests_taken
                is_left[taken] = False
                vote.remove(taken)
        vote.forget()
    return traces
