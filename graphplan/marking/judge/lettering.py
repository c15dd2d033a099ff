"""Which letters name which marks: by how near they stand, and by where the construction has its marks.

A letter belongs to a mark near it. Where several are near, the construction tells which of them is where the named mark
should be: so far as its plan is known to lie, which the letters themselves tell by agreeing on a frame. Every letter of
the sheet is weighed against every other. That a mark is not where it should be speaks against it only so much: else a
letter could not name a mistaken one.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from statistics import median
from typing import Any, NamedTuple

import numpy as np
import shapely
from shapely import Point, Polygon, STRtree

from graphplan.design.hand import Pencil
from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.kernel.program import Program
from graphplan.marking.files.drawing import circle_through
from graphplan.marking.judge import measures
from graphplan.marking.judge.mistakes import vector_letters
from graphplan.marking.judge.student_sheet import SharedMarks, distance_apart, measured_spots, plain_value
from graphplan.marking.traces import (
    Lettering,
    PlanFrame,
    Submission,
    Trace,
    bare_name,
    can_name_line,
    first_spots,
    spell,
)
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.plans import Plans

Wish = dict[int, float]  # what letters may name, and what that costs


@dataclass(frozen=True)
class LetteredWord:
    """Letters, and the steps that they may speak of, by the kind of thing that those make."""

    word: Lettering
    names: list[str]
    steps: Mapping[str, int]
    wish: Wish  # by nearness alone


def name_marks(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil) -> Submission:
    """A drawing with its letters at the marks that they name; a thing of several names is several traces."""
    return Letters(drawing, composition, submission, pencil).named_submission() if submission.letters else submission


class Letters:
    """The letters of one drawing beside its construction; `within` is how far marks may be off a frame, in mm."""

    def __init__(self, drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil,
                 within: float = 0.0):
        self.drawing, self.submission = drawing, submission
        self.within = within or measures.AGREED_SIGMAS * pencil.point
        self.multiples = composition.scales.multiples
        self.hidden = {mark.index for plate in composition.plates for mark in plate.hidden_marks} if (
            composition.plans.drawing is drawing) else set[int]()  # but their letters stand on the task's sheet
        self.task = composition.views[MECHANISM].scale if MECHANISM in composition.views else 1.0
        self.plan_of_step: Sequence[Any] = Plans(drawing).plan_of_step
        self.traces: Sequence[Trace] = submission.traces
        self.ends: set[int] = set()  # of the traces, those where lines end
        self.alone: dict[int, Lettering] = {}  # and those of which there is nothing but letters
        names = LabelTable(drawing, self.plan_of_step)
        self.sure = labelled_steps(drawing, self.plan_of_step, self.traces)
        steps = _spoken_steps(names, [word.names[0] for word in submission.letters if word.names], self.sure)
        other_names = {*(spell(arrow.label) for arrow in drawing.arrows), *map(spell, drawing.scene.links)}
        words = [(word, name, steps[name]) for word in submission.letters if word.names and (
            (name := word.names[0]) not in other_names or steps[name])]
        self._add_undotted([word for word, _, steps in words if POINT in steps])
        self._add_tips([word for word, _, steps in words if POINT in steps])
        self.words = [LetteredWord(word, word.names, steps, self._naming_costs(word, name, steps))
                      for word, name, steps in words]
        place = None if self.alone else usual_place([(one.word, one.wish) for one in self.words], self.traces)
        if place:
            self.words = [replace(one, wish={mark: cost + self._stray_cost(place, one.word, mark)
                                             for mark, cost in one.wish.items()}) for one in self.words]

    # ---- what is near ----------------------------------------------------------------------------------------------

    @cached_property
    def _figures(self) -> STRtree:
        return STRtree([trace.figure for trace in self.traces])

    def _add_tips(self, words: Sequence[Lettering]) -> None:
        """Add the tips of arrows about the letters of points without a dot, as most corners of force polygons, and the
        ends of their leaders, if no mark is there."""
        spots = [Point(*spot) for spot in dict.fromkeys(self.submission.tips)]
        dots = STRtree([trace.figure for trace in self.traces if trace.kind == POINT])
        tree = STRtree(spots)
        near = {int(place) for word in words for place in tree.query(word.box, "dwithin", _letter_reach(word))}
        ends = [Point(*spot) for spot in dict.fromkeys(word.leads for word in words if word.leads)]
        tips = [spots[place] for place in sorted(near)
                if not len(dots.query(spots[place], "dwithin", measures.END_NEAR_MM))]
        tips += [end for end in ends if not any(len(marks.query(end, "dwithin", measures.LEADER_END_MM))
                                                for marks in (dots, STRtree(tips)))]
        self.tips = range(len(self.traces), len(self.traces) + len(tips))
        self.traces = (*self.traces, *(Trace(POINT, ((tip.x, tip.y),)) for tip in tips))

    def _add_undotted(self, words: Sequence[Lettering]) -> None:
        """Add where strokes cross about the letters of points, if most of those can have no dot."""
        points = sum(trace.kind == POINT for trace in self.traces)
        if 2 * points < len(words):
            figures = self._figures
            met = [stroke_meetings(word.box, _letter_reach(word), self.submission.traces, figures)
                   for word in words[:measures.MAX_UNDOTTED_LETTERS]]
            crossed, ends = (list(dict.fromkeys(spot for meeting in met for spot in meeting[k])) for k in (0, 1))
            self.traces = (*self.traces, *crossed, *ends)
            self.ends.update(range(len(self.traces) - len(ends), len(self.traces)))
            self.alone = dict(enumerate(words, len(self.traces)))
            self.traces = (*self.traces, *map(_letters_as_mark, words))
            del self._figures

    def _naming_costs(self, word: Lettering, name: str, steps: Mapping[str, int]) -> Wish:
        """Marks that letters may name, with the price of their distance: those of points name points, Greek ones lines.
        A leader that ends in a mark names it. Where their leader ends in a mark, it is that."""
        anchor = _anchor(word)
        places = self._figures.query(anchor, "dwithin", measures.ASIDE_MM if word.leads else _letter_reach(word))
        gaps = shapely.distance(self._figures.geometries[places], anchor)
        named = LINE in steps or (not steps and can_name_line(name))
        nearest = np.argsort(gaps, kind="stable")[:measures.MAX_CROWD]
        costs, marks_of_leader = list[tuple[float, int]](), Wish()
        for gap, place in zip(gaps[nearest].tolist(), places[nearest].tolist(), strict=True):
            trace = self.traces[place]
            can_be_named = named if trace.kind == LINE else trace.kind == POINT and (POINT in steps or not steps)
            if can_be_named and (trace.beside or not trace.label) and self.alone.get(place, word) is word:
                costs.append((gap / (measures.LETTER_GAP_SIZES * word.size)
                              + measures.LINE_END_COST * (place in self.ends or place in self.tips), place))
                if word.leads and gap < measures.LEADER_END_MM:
                    marks_of_leader[place] = gap
        if marks_of_leader:
            return marks_of_leader
        nearest_first = [(cost, place)
                         for cost, place in sorted(costs) if place not in self.alone][:measures.LETTER_CHOICES]
        return {place: cost for cost, place in nearest_first} | {
            place: measures.LETTERS_ALONE_COST for _, place in costs if place in self.alone}

    def _stray_cost(self, place: LetterPlace, word: Lettering, mark: int) -> float:
        """Price of letters that do not stand where the others do from their marks."""
        is_point = self.traces[mark].kind == POINT and not word.leads
        return place.cost(word, complex(*self.traces[mark].spots[0])) if is_point else 0.0

    # ---- where they should be --------------------------------------------------------------------------------------

    @cached_property
    def frames(self) -> dict[str, PlanFrame]:
        """Frames of plans, as far as letters agree."""
        frames = dict(self.submission.frames)
        if MECHANISM not in frames and self.mechanism:
            frames[MECHANISM] = self.mechanism
        if MECHANISM in frames:
            unit = frames[MECHANISM].unit
            for panel in dict.fromkeys(self.plan_of_step):
                tied = unit * float(self.multiples.get(panel, 1))
                if panel not in frames and (
                        frame := agreed_frame(self._plan_candidates(panel), (tied,), self.within, abs(tied),
                                              not self.ends)):
                    frames[panel] = frame
        return frames

    @cached_property
    def mechanism(self) -> PlanFrame | None:
        """Frame of the mechanism, by its given points or else by all that are lettered."""
        given_candidates = self._plan_candidates(MECHANISM, self.drawing.drawn.givens)
        # where strokes cross beside two letters, some two always do
        few = self.ends and len(given_candidates) < measures.MIN_WITNESSES
        return (None if few else agreed_frame(given_candidates, (), self.within, self.task)) or agreed_frame(
            self._plan_candidates(MECHANISM), (), self.within, self.task)

    def _plan_candidates(self, panel: str, before: int | None = None) -> list[Candidates]:
        """The lettered points of a plan: where each truly is, and the points on the sheet that it may be."""
        points = {step: [(complex(*self.traces[place].spots[0]), 0.0)] for step, place in self.sure.items()
                  if self.traces[place].kind == POINT}
        for word in self.words:
            if (step := word.steps.get(POINT)) is not None:
                points[step] = [(complex(*self.traces[place].spots[0]), cost) for place, cost in word.wish.items()
                                if self.traces[place].kind == POINT and place not in self.alone]
        return [Candidates(complex(*plain_value(self.drawing.values[step])[:2]), spots)
                for step, spots in points.items()
                if spots and self.plan_of_step[step] == panel and (before is None or step < before)]

    def _distance_off(self, step: int, trace: Trace) -> float:
        """Distance of a trace from a step's true value, in mm; infinite if the frame of its plan is unknown."""
        frame = self.frames.get(self.plan_of_step[step])
        if frame is None:
            return math.inf
        spots = np.array([frame.to_plan(complex(*spot)) for spot in measured_spots(trace)])
        return float(distance_apart(trace.kind, plain_value(self.drawing.values[step]), spots)) * abs(frame.unit)

    @cached_property
    def _true_spots(self) -> Sequence[complex | None]:
        """True places of the steps' points on the sheet; None if the frame of a plan is unknown."""
        return SharedMarks(self.drawing, self.plan_of_step, self.frames).spots

    @cached_property
    def _claimed_points(self) -> dict[int, int]:
        """The points that are where a step should make one, which no letters name; by place."""
        named = {step for word in self.words for step in word.steps.values()}
        claims = {}
        for step in self.drawing.drawn.steps:
            at = self._true_spots[step.index]
            if step.index not in named and at is not None:
                for place in self._figures.query(Point(at.real, at.imag), "dwithin", self.within / 2):
                    if self.traces[place].kind == POINT:
                        claims[int(place)] = step.index
        return claims

    @cached_property
    def _stray_dots(self) -> set[int]:
        """The dots that are where no step makes a mark, where all plans are known to lie: only letters say whose they
        are."""
        spots = [self._true_spots[step.index] for step in self.drawing.drawn.steps if step.op.gives == POINT]
        return set() if None in spots else {
            place for place, trace in enumerate(self.submission.traces) if trace.kind == POINT
            and np.abs(np.array(spots) - complex(*trace.spots[0])).min(initial=np.inf) > measures.ASIDE_MM}

    @cached_property
    def _sharers(self) -> Counter[int]:
        """Number of other lettered steps with the same mark, on printed plans."""
        printed_marks = SharedMarks(self.drawing, self.plan_of_step, self.submission.frames)
        lettered = {step for word in self.words if (step := word.steps.get(POINT)) is not None}
        return Counter(step for pair in combinations(lettered, 2) if printed_marks.are_one(*pair) for step in pair)

    # ---- who names what --------------------------------------------------------------------------------------------

    def named_submission(self) -> Submission:
        """The drawing with the names of its marks."""
        assignment = assign_labels([self._weigh(word) for word in self.words], measures.NAMELESS_COST,
                                   measures.WRONG_NAME_COST)
        astray = self._dots_astray(assignment)
        names: dict[int, list[tuple[str, bool]]] = {}
        for order, (word, place) in enumerate(zip(self.words, assignment, strict=True)):
            is_extra = assignment.count(place) > 1 and not self.hidden.isdisjoint(word.steps.values())
            is_other = place in astray.values() and order not in astray
            place = astray.get(order, place)
            if place is not None and not (is_extra or is_other):
                beside = order not in astray and not self._is_certain(word, place, assignment)
                names.setdefault(place, []).extend((name, beside) for name in word.names)
        first = [replace(trace, label=names[place][0][0], beside=names[place][0][1]) if place in names else trace
                 for place, trace in enumerate(self.traces) if place < len(self.submission.traces) or place in names]
        more = [replace(self.traces[place], label=name, beside=beside) for place, several in names.items()
                for name, beside in several[1:]]
        return replace(self.submission, traces=(*first, *more))

    def _dots_astray(self, assignment: Sequence[int | None]) -> dict[int, int]:
        """The dots that were set astray, by the letters whose they are: those stand where their mark should be, but
        alone of all on their plan have no dot there, and about it is but one dot that is no mark."""
        dots = {place for place, trace in enumerate(self.submission.traces) if trace.kind == POINT} - self._stray_dots
        spots = first_spots([self.traces[place] for place in dots])
        astray: dict[int, int] = {}
        for panel in dict.fromkeys(self.plan_of_step):
            marks = {order: at for order, at in self._letters_in_place.items()
                     if self.plan_of_step[self.words[order].steps[POINT]] == panel}
            lone = [order for order, at in marks.items()
                    if assignment[order] not in dots and not (np.abs(spots - at) < measures.ASIDE_MM).any()]
            if len(lone) == 1 and len(marks) >= measures.MIN_WITNESSES:
                lettered = {place for order, place in enumerate(assignment) if place is not None and order != lone[0]
                            and self._names_point(order) and self.words[order].wish[place] < measures.CLEAR_COST}
                near = [place for place in self._stray_dots - lettered
                        if abs(complex(*self.traces[place].spots[0]) - marks[lone[0]]) < measures.ASTRAY_DOT_MM]
                astray |= {lone[0]: near[0]} if len(near) == 1 else {}
        return astray

    def _names_point(self, order: int) -> bool:
        """Whether a word is a point's name, no number that may be of anything."""
        return POINT in self.words[order].steps and not self.words[order].names[0].isdigit()

    @property
    def _letters_in_place(self) -> dict[int, complex]:
        """The letters of points that stand where their marks should be, each with that spot."""
        spots = {order: self._true_spots[word.steps[POINT]] for order, word in enumerate(self.words)
                 if self._names_point(order)}
        return {order: at for order, at in spots.items() if at is not None and _anchor(self.words[order].word).distance(
            Point(at.real, at.imag)) < _letter_reach(self.words[order].word)}

    def _weigh(self, one: LetteredWord) -> Wish:
        """Marks that letters may name, with prices by distance and by the construction."""
        costs = {}
        for place, cost in one.wish.items():
            trace = self.traces[place]
            off = self._distance_off(one.steps[trace.kind], trace) if trace.kind in one.steps else math.inf
            if place >= len(self.submission.traces) and not self._may_mean(one, place, off):
                continue
            claimed = one.steps and place in self._claimed_points and off > measures.ASIDE_MM
            stray_number = one.names[0].isdigit() and place in self._stray_dots
            leaves_dot = place in self.tips and not self._stray_dots.isdisjoint(one.wish)
            costs[place] = (cost + _astray_cost(off) + measures.CLEAR_COST * bool(claimed)
                            + measures.LEFT_DOT_COST * leaves_dot
                            + measures.WRONG_NAME_COST * (not one.steps or stray_number))
            if off < measures.DIFFERENT_MM:
                costs[place] -= measures.WRONG_NAME_COST * self._sharers[one.steps[trace.kind]]
        return costs

    def _may_mean(self, one: LetteredWord, place: int, off: float) -> bool:
        """Whether letters may mean a place without a dot: where the mark should be; or a crossing, if they do not stand
        there. Letters alone are a mark about where they stand; numbers only where that should be."""
        step = one.steps.get(POINT)
        if step is None or place in self.alone:
            return step is not None and (off < _letter_reach(one.word) or not one.names[0].isdigit())
        at = self._true_spots[step]
        if off < measures.ASIDE_MM or at is None:
            return off < measures.ASIDE_MM or place not in self.ends
        return place not in self.ends and one.word.box.distance(Point(at.real, at.imag)) > _letter_reach(one.word)

    def _undotted_cost(self, one: LetteredWord) -> float:
        """Price of letters that name a mark without a dot, and leave one beside them."""
        at = self._true_spots[one.steps[POINT]]
        gap = math.inf if at is None else float(_anchor(one.word).distance(Point(at.real, at.imag)))
        return gap / (measures.LETTER_GAP_SIZES * one.word.size) + measures.LINE_END_COST + measures.LEFT_DOT_COST

    def _is_certain(self, one: LetteredWord, place: int, found: Sequence[int | None]) -> bool:
        """Whether letters are certainly those of a point: no other is nearly as near, nor has it other letters; a
        number may be one of the student's own."""
        if self.traces[place].kind != POINT or POINT not in one.steps or found.count(place) > 1 or (
                place >= len(self.submission.traces)):
            return False
        off = self._distance_off(one.steps[POINT], self.traces[place])
        if one.names[0].isdigit() and off > 2 * measures.ASIDE_MM:
            return False
        if place in self._stray_dots and self._stray_dots.isdisjoint(one.wish.keys() - {place}):
            return one.wish[place] + _astray_cost(off) < self._undotted_cost(one)
        least = min((cost for rival, cost in one.wish.items() if rival != place and self.traces[rival].kind == POINT),
                    default=math.inf)
        return (one.wish[place] < measures.CLEAR_COST and least - one.wish[place] > measures.CLEAR_COST
                and place not in self._claimed_points)


def _astray_cost(off: float) -> float:
    """Price of a mark's distance from its right place, in mm."""
    return measures.WRONG_NAME_COST / (1 + (measures.ASIDE_MM / off) ** 2) if off else 0.0


def _letters_as_mark(word: Lettering) -> Trace:
    """A mark that has no ink of its own, about where its letters stand."""
    at = word.box.centroid
    return Trace(POINT, ((at.x, at.y),), blur=math.hypot(measures.LETTERS_ALONE_MM, word.long / 4), crossed=True)


def _anchor(word: Lettering) -> Any:
    """Part of a label beside its mark: the letters, or the end of their leader."""
    return Point(*word.leads) if word.leads else word.box


def _letter_reach(word: Lettering) -> float:
    """Largest distance of a mark from its letters, in mm."""
    return max(measures.REACH_MM, measures.LETTER_REACH_SIZES * word.size)


def _spoken_steps(names: LabelTable, called: Sequence[str], sure: Container[int]) -> dict[str, dict[str, int]]:
    """Steps that letters may name, by kind; read as loosely as necessary, if no name fits better."""
    steps_by_name: dict[str, dict[str, int]] = {name: {} for name in called}
    looseness_of_step: dict[int, int] = {}
    for loosely in range(measures.MAX_LOOSENESS + 1):
        for name, steps in steps_by_name.items():
            for kind in (POINT,) if name.isdigit() else (POINT, LINE):
                step = names.step(kind, "", name, loosely)
                if step is not None and step not in sure and kind not in steps and looseness_of_step.setdefault(
                        step, loosely) == loosely:
                    steps[kind] = step
    return steps_by_name


# ---- where letters stand --------------------------------------------------------------------------------------------

# Where the letters of a drawing stand from their marks: programs, and tidy hands, set all of them alike, so that
# where marks lie close together each letter's own is told by that.


REFERENCES: tuple[Callable[[Lettering], complex], ...] = (  # by which letters are set: the beginning or the middle
    lambda word: complex(*word.at), lambda word: complex(*word.at) + word.long / 2)


@dataclass(frozen=True)
class LetterPlace:
    """Usual place of letters from their marks, in mm, by a point of theirs, and its spread."""

    reference: Callable[[Lettering], complex]
    offset: complex
    spread: float

    def departure(self, word: Lettering, mark: complex) -> float:
        """Distance of letters from their usual place at a mark, in mm."""
        return abs(self.reference(word) - mark - self.offset)

    def cost(self, word: Lettering, mark: complex) -> float:
        """Price of letters at a mark: larger with their distance from the usual place."""
        ratio = self.departure(word, mark) / (measures.LETTER_GAP_SIZES * word.size)
        return measures.STRAY_LETTER_COST * ratio**2 / (1 + ratio**2)


def usual_place(words: Sequence[tuple[Lettering, Wish]], traces: Sequence[Trace]) -> LetterPlace | None:
    """The place in which nearly all letters with a single mark near stand; None if there is no such place, or too few
    letters."""
    own_marks = [(word, mark) for word, wish in words if not word.leads
                 and (mark := _only_mark(wish, traces)) is not None]
    if len(own_marks) < measures.MIN_PLACED_LETTERS:
        return None
    places = []
    for reference in REFERENCES:
        offsets = [reference(word) - mark for word, mark in own_marks]
        middle = complex(median(z.real for z in offsets), median(z.imag for z in offsets))
        gaps = sorted(abs(z - middle) / word.size for z, (word, _) in zip(offsets, own_marks, strict=True))
        places.append(LetterPlace(reference, middle, gaps[int(measures.PLACED_SHARE * (len(gaps) - 1))]))
    best = min(places, key=lambda place: place.spread)
    return best if best.spread < measures.LETTER_GAP_SIZES / 2 else None


def _only_mark(wish: Wish, traces: Sequence[Trace]) -> complex | None:
    """Place of the mark that is clearly nearest to letters."""
    costs = sorted((cost, place) for place, cost in wish.items() if traces[place].kind == POINT)
    if not costs or (len(costs) > 1 and costs[1][0] - costs[0][0] < measures.CLEAR_COST):
        return None
    return complex(*traces[costs[0][1]].spots[0])


# ---- the frame on which letters agree -------------------------------------------------------------------------------

# The frame of a plan on which most lettered marks agree, where each letter may be that of several spots.


class Candidates(NamedTuple):
    """A mark of a plan, and the spots on the sheet that may be it, with what speaks against each."""

    at: complex
    spots: list[tuple[complex, float]]


def agreed_frame(marks: Sequence[Candidates], units: Sequence[complex], within: float, usual: float,
                 any_unit: bool = True
           ) -> PlanFrame | None:
    """The frame on which most marks agree, by one of their spots each; None where no two do.

    It has one of some `units`, or where it may have `any_unit`, another that more agree on; of equals that is taken
    which is nearer to the `usual` scale, and upright.
    """
    if not marks:
        return None
    owner = np.concatenate([np.full(len(mark.spots), k) for k, mark in enumerate(marks)])
    at = np.array([mark.at for mark in marks])
    spots = np.array([spot for mark in marks for spot, _ in mark.spots])
    costs = np.array([cost for mark in marks for _, cost in mark.spots])
    starts = np.flatnonzero(np.diff(owner, prepend=-1))

    weights = 1.0 - measures.SPOT_COST_SHARE * np.clip(costs, 0.0, measures.MAX_SPOT_COST)

    def score(unit: Any, origin: Any) -> Any:
        """Number of marks with a spot in each frame."""
        off = np.abs(origin[:, None] + unit[:, None] * at[owner][None, :] - spots[None, :]) / within
        votes_per_spot = np.clip(1.0 - off**2, 0.0, None) * weights
        return np.maximum.reduceat(votes_per_spot, starts, axis=1).sum(axis=1)

    tied, free = _propose_frames(at, owner, spots, units)
    best: tuple[float, complex, complex] | None = None
    for unit, origin in (tied, free) if any_unit else (tied,):
        if len(unit):
            taste = measures.RESCALED_VOTES * np.abs(np.log(np.abs(unit) / usual)) + measures.TURNED_VOTES * np.abs(
                np.angle(unit))
            votes = score(unit, origin) - taste
            top = int(votes.argmax())
            if (best is None or votes[top] > measures.OTHER_FRAME_LETTERS
                + (1 + measures.OTHER_FRAME_SHARE * len(spots) / len(marks)) * best[0]):
                best = float(votes[top]), complex(unit[top]), complex(origin[top])
    if best is None or best[0] < min(measures.MIN_FRAME_VOTES, len(marks)) - 0.5:
        return None
    return _refine_frame(at, owner, spots, best[1], best[2], within)


def _propose_frames(at: Any, owner: Any, spots: Any, units: Sequence[complex]
                    ) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
    """Units and origins of frames: with the expected unit through every spot, and any through two of two marks."""
    tied = np.repeat(np.array(units, dtype=complex), len(spots))
    origins = np.tile(spots, len(units)) - tied * np.tile(at[owner], len(units))
    near = np.flatnonzero(np.concatenate([np.arange(count) < measures.CANDIDATES for count in np.bincount(owner)]))
    near = near[:: max(1, len(near) // measures.MAX_FRAME_SPOTS)]
    pairs = sorted(((i, j) for i, j in combinations(near.tolist(), 2) if at[owner[i]] != at[owner[j]]
                    and spots[i] != spots[j]),
                   key=lambda ij: -abs(at[owner[ij[0]]] - at[owner[ij[1]]]))[:measures.MAX_FRAMES]
    i, j = np.array(pairs, dtype=int).reshape(-1, 2).T
    free = (spots[j] - spots[i]) / (at[owner[j]] - at[owner[i]])
    return (tied, origins), (free, spots[i] - free * at[owner[i]])


def _refine_frame(at: Any, owner: Any, spots: Any, unit: complex, origin: complex, within: float) -> PlanFrame:
    """The frame of least squares through the spots that a frame holds, of each mark the nearest; marks that lie close
    together do not turn or stretch it."""
    off = np.abs(origin + unit * at[owner] - spots)
    nearest = [place for place in np.lexsort((off, owner)) if off[place] < within]
    held_places = [place for k, place in enumerate(nearest) if not k or owner[place] != owner[nearest[k - 1]]]
    marks, held_spots = at[owner[held_places]], spots[held_places]
    if float(np.var(marks)) * abs(unit) ** 2 > within**2:
        return PlanFrame.least_squares(marks, held_spots)
    return PlanFrame(complex(np.mean(held_spots - unit * marks)), unit)


# ---- labels ---------------------------------------------------------------------------------------------------------

# Letters and marks: which step a label speaks of, which letters and marks belong together at the least cost, and
# where strokes cross or end near letters, so that a mark may be meant that has no dot.


def labelled_steps(drawing: Construction, plan_of_step: Sequence[str], traces: Sequence[Trace]) -> dict[int, int]:
    """For each step that a trace is labelled as, the place of that trace; of several that which says it best, or first.

    A number beside a line may be that of a link, or of the line next to it: unless the plan is named it tells nothing.
    """
    names, places, used_places = LabelTable(drawing, plan_of_step), dict[int, int](), set[int]()
    for loosely in range(measures.MAX_LOOSENESS + 1):
        named: list[tuple[bool, int, int]] = []
        for place, trace in enumerate(traces):
            numbered = trace.kind != POINT and not trace.panel and trace.label.isdigit()
            step = names.step(trace.kind, trace.panel, trace.label, loosely) if trace.label and not numbered else None
            if step is not None and drawing.drawn.steps[step].op.gives == trace.kind and place not in used_places:
                named.append((spell(trace.label) != spell(drawing.drawn.steps[step].name), place, step))
        for _, place, step in sorted(named):  # c is no C where there is one
            used_places.add(places.setdefault(step, place))
    return places


def is_sure(trace: Trace) -> bool:
    """Whether a label is certainly that of its trace: beside a mark of a drawing may stand the letter of another."""
    return bool(trace.panel) or (trace.kind == POINT and not trace.beside)


class LabelTable:
    """Possible names of a construction's marks."""

    def __init__(self, drawing: Construction, plan_of_step: Sequence[str]):
        self._steps = _label_table(drawing.drawn, plan_of_step, vector_letters(drawing))

    def step(self, kind: str, panel: str, label: str, loosely: int) -> int | None:
        """The step that makes a thing of this kind and label, by the label as it stands, or more loosely read: without
        the subscript's mark, and in small letters."""
        read = spell(label.replace(" ", ""))
        text = (read, read.replace("_", ""), read.replace("_", "").casefold())[loosely]
        return self._steps.get((kind, panel, text), self._steps.get((kind, "", text)))


def _label_table(program: Program, plan_of_step: Sequence[str], also: Mapping[str, int]
                 ) -> dict[tuple[str, str, str], int]:
    """All that a mark may be called, by its kind and plan or on any plan: what is clearer comes first, what textbooks
    call it `also` comes last."""
    table: dict[tuple[str, str, str], int] = {}
    loosely: dict[tuple[str, str, str], set[int]] = {}
    for step in program.steps:
        kind, text = step.op.gives, program.text(step.index)
        letters = [spell(step.name), "" if isinstance(text, Said) else spell(text)]
        number = str(program.number(step.index))
        for panel in (plan_of_step[step.index], ""):
            for letter in filter(None, letters):
                table.setdefault((kind, panel, letter), step.index)
                for less in (letter.replace("_", ""), letter.replace("_", "").casefold()):
                    loosely.setdefault((kind, panel, less), set()).add(step.index)
            for called in (number, f"#{number}", f"{kind}{number}") if step.op.movement is not Movement.GIVEN else ():
                loosely.setdefault((kind, panel, called), set()).add(step.index)
    for spelling, steps in loosely.items():
        if len(steps) == 1:  # what may be said of two is said of neither
            table.setdefault(spelling, *steps)
    for name, index in also.items():
        for panel in (plan_of_step[index], ""):
            for spelled in (spell(name), bare_name(name), bare_name(name).casefold()):
                table.setdefault((POINT, panel, spelled), index)
    return table


# ---- pairing --------------------------------------------------------------------------------------------------------


Costs = Mapping[int, float]  # of a letter's candidates


def assign_labels(wishes: Sequence[Costs], nothing: float, shared: float) -> list[int | None]:
    """The candidate of each letter, None if no candidate is worth it, with the least total cost: the first price is
    that of a letter that names no candidate, `shared` that of a candidate's second letter, of its third twice as
    much."""
    chosen: list[int | None] = [None] * len(wishes)
    for crowd in _letter_crowds(wishes):
        if len(crowd) > measures.MAX_CROWD:
            for letter in crowd:
                best = min(wishes[letter], key=wishes[letter].__getitem__)
                chosen[letter] = best if wishes[letter][best] < nothing else None
            continue
        named = sorted({candidate for letter in crowd for candidate in wishes[letter]})
        copies = min(3, len(crowd))
        table = [[wishes[letter].get(candidate, math.inf) + shared * copy for copy in range(copies)
                  for candidate in named]
                 + [nothing] * len(crowd) for letter in crowd]
        for letter, column in zip(crowd, cheapest_columns(table), strict=True):
            chosen[letter] = named[column % len(named)] if column < copies * len(named) else None
    return chosen


def _letter_crowds(wishes: Sequence[Costs]) -> Iterator[list[int]]:
    """Yield groups of letters with candidates; different groups share no candidate."""
    group = list(range(len(wishes)))

    def root(letter: int) -> int:
        while group[letter] != letter:
            group[letter] = letter = group[group[letter]]
        return letter

    first: dict[int, int] = {}
    for letter, costs in enumerate(wishes):
        for candidate in costs:
            group[root(letter)] = root(first.setdefault(candidate, letter))
    crowds: dict[int, list[int]] = {}
    for letter, costs in enumerate(wishes):
        if costs:
            crowds.setdefault(root(letter), []).append(letter)
    yield from crowds.values()


def cheapest_columns(table: Sequence[Sequence[float]]) -> list[int]:
    """The column of each row, no two the same, at the least sum: by shortest augmenting paths (Jonker and Volgenant,
    Computing 38, 1987). There are at least as many columns as rows, and some way of finite cost."""
    rows, columns = len(table), len(table[0]) if table else 0
    price, spare = [0.0] * columns, [0.0] * rows  # of the dual problem
    holder: list[int] = [-1] * columns
    for row in range(rows):
        least, before = [math.inf] * columns, [-1] * columns
        done = [False] * columns
        current, column, far = row, -1, 0.0
        while True:
            for candidate in range(columns):
                if not done[candidate]:
                    length = far + table[current][candidate] - spare[current] - price[candidate]
                    if length < least[candidate]:
                        least[candidate], before[candidate] = length, column
            column = min((candidate for candidate in range(columns) if not done[candidate]), key=least.__getitem__)
            far, done[column] = least[column], True
            if holder[column] < 0:
                break
            current = holder[column]
        spare[row] += far
        for candidate in range(columns):
            if done[candidate] and candidate != column:
                spare[holder[candidate]] += far - least[candidate]
                price[candidate] -= far - least[candidate]
        while column >= 0:
            last = before[column]
            holder[column] = holder[last] if last >= 0 else row
            column = last
    assignment = [-1] * rows
    for column, row in enumerate(holder):
        if row >= 0:
            assignment[row] = column
    return assignment


# ---- crossings ------------------------------------------------------------------------------------------------------


def stroke_meetings(box: Polygon, reach: float, traces: Sequence[Trace], figures: STRtree
                    ) -> tuple[list[Trace], list[Trace]]:
    """Points where strokes cross about a box of letters, as sure as these are drawn; and where lines end."""
    strokes = [traces[place] for place in figures.query(box, "dwithin", reach)
               if traces[place].kind != POINT][:measures.MANY_CANDIDATES]
    left, bottom, right, top = box.bounds

    spots_found: list[complex] = []

    def new_points(spots: Iterable[tuple[complex, float]]) -> list[Trace]:
        """New points among some spots, each with its blur, about the box."""
        points = []
        for z, blur in spots:
            gap = math.hypot(max(left - z.real, 0.0, z.real - right), max(bottom - z.imag, 0.0, z.imag - top))
            if gap < reach and all(abs(z - before) > measures.SAME_CROSSING_MM for before in spots_found):
                spots_found.append(z)
                points.append(Trace(POINT, ((z.real, z.imag),), blur=blur, crossed=True))
        return points

    crossings = ((z, measures.CROSSING_BLUR_MM / sine) for first, second in combinations(strokes, 2)
                 for z, sine in _stroke_crossings(first, second))
    ends = ((complex(*spot), 0.0) for stroke in strokes if stroke.kind == LINE for spot in stroke.spots)
    return new_points(crossings), new_points(ends)


def _stroke_crossings(one: Trace, other: Trace) -> Iterator[tuple[complex, float]]:
    """Yield the crossings of two strokes, lines as long as they are drawn, and the sine of the angle."""
    if one.kind == other.kind == LINE:
        a, b, c, d = (complex(*spot) for spot in (*one.spots, *other.spots))
        u, v = b - a, d - c
        sine = (u.conjugate() * v).imag
        if abs(sine) > measures.MIN_CROSSING_SINE * abs(u) * abs(v):
            s, t = ((c - a).conjugate() * v).imag / sine, ((c - a).conjugate() * u).imag / sine
            if all(-measures.SAME_CROSSING_MM <= ratio * abs(vector) <= abs(vector) + measures.SAME_CROSSING_MM
                   for ratio, vector in ((s, u), (t, v))):
                yield a + s * u, abs(sine) / (abs(u) * abs(v))
    elif CIRCLE in (one.kind, other.kind):
        line, arc = (one, other) if other.kind == CIRCLE else (other, one)
        arc_circle = circle_through(*arc.spots[:3])
        if arc_circle is None:
            return
        centre, radius = complex(*arc_circle[0]), arc_circle[1]
        if line.kind == LINE:
            a, b = (complex(*spot) for spot in line.spots)
            vector = (b - a) / abs(b - a)
            foot = a + ((centre - a) * vector.conjugate()).real * vector
            half = radius**2 - abs(foot - centre) ** 2
            ends = [foot + sign * math.sqrt(half) * vector for sign in (1, -1)] if half > 0 else []
            sine = max(measures.MIN_CROSSING_SINE, math.sqrt(max(half, 0.0)) / radius)
            yield from ((z, sine) for z in ends if -measures.SAME_CROSSING_MM <= ((z - a) * vector.conjugate()).real
                        <= abs(b - a) + measures.SAME_CROSSING_MM)
        elif (second := circle_through(*line.spots[:3])) is not None:
            apart = complex(*second[0]) - centre
            if not 0 < abs(radius - second[1]) < abs(apart) < radius + second[1]:
                return
            along = (abs(apart) ** 2 + radius**2 - second[1] ** 2) / (2 * abs(apart))
            turn = math.acos(min(1.0, max(-1.0, along / radius)))
            sine = max(measures.MIN_CROSSING_SINE, math.sin(turn) * abs(apart) / second[1])
            yield from ((centre + cmath.rect(radius, cmath.phase(apart) + sign * turn), sine) for sign in (1, -1))
