"""Which letters name which marks: by how near they stand, and by where the construction has its marks.

A letter belongs to a mark near it. Where several are near, the construction tells which of them is where the named mark
should be: so far as its plan is known to lie, which the letters themselves tell by agreeing on a frame. Every letter of
the sheet is weighed against every other. That a mark is not where it should be speaks against it only so much: else a
letter could not name a mistaken one.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np
import shapely
from shapely import Point, STRtree

from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import LINE, POINT
from graphplan.marking.judge import measures
from graphplan.marking.judge.agreed_frame import Candidates, agreed_frame
from graphplan.marking.judge.labels import LabelTable, assign_labels, labelled_steps, stroke_meetings
from graphplan.marking.judge.letter_places import LetterPlace, usual_place
from graphplan.marking.judge.shared_marks import SharedMarks
from graphplan.marking.judge.student_sheet import distance_apart, measured_spots, plain_value
from graphplan.marking.traces import Lettering, PlanFrame, Submission, Trace, can_name_line, first_spots, spell
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
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
        self.within = within or measures.LETTER_FRAME_SIGMAS * pencil.point
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
        """Add the tips of arrows about the letters of points that have no dot, as most corners of force polygons, and
        where their leaders end, if nothing is there."""
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
        """What letters may name, and what their distance costs: those of points name points, Greek ones lines. Where
        their leader ends in a mark, it is that."""
        anchor = _anchor(word)
        places = self._figures.query(anchor, "dwithin", measures.LEADER_TIP_MM if word.leads else _letter_reach(word))
        gaps = shapely.distance(self._figures.geometries[places], anchor)
        named = LINE in steps or (not steps and can_name_line(name))
        nearest = np.argsort(gaps, kind="stable")[:measures.THINGS_NEAR_LETTER]
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
        """What it costs that letters do not stand where the others do from their marks."""
        is_point = self.traces[mark].kind == POINT and not word.leads
        return place.cost(word, complex(*self.traces[mark].spots[0])) if is_point else 0.0

    # ---- where they should be --------------------------------------------------------------------------------------

    @cached_property
    def frames(self) -> dict[str, PlanFrame]:
        """Where plans lie, as far as letters agree."""
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
        """Where the mechanism lies, by its given points or else by all that are lettered."""
        given_candidates = self._plan_candidates(MECHANISM, self.drawing.drawn.givens)
        # where strokes cross beside two letters, some two always do
        few = self.ends and len(given_candidates) < measures.MIN_GIVEN_POINTS
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
        """How far a trace is from what a step truly makes, in mm; infinite where its plan is not known to lie."""
        frame = self.frames.get(self.plan_of_step[step])
        if frame is None:
            return math.inf
        spots = np.array([frame.to_plan(complex(*spot)) for spot in measured_spots(trace)])
        return float(distance_apart(trace.kind, plain_value(self.drawing.values[step]), spots)) * abs(frame.unit)

    @cached_property
    def _true_spots(self) -> Sequence[complex | None]:
        """Where the mark of each step that makes a point is on the sheet; None where its plan is not known to lie."""
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
            and np.abs(np.array(spots) - complex(*trace.spots[0])).min(initial=np.inf) > measures.HALF_COST_MM}

    @cached_property
    def _sharers(self) -> Counter[int]:
        """How many others with letters make the very mark of a step with letters, on plans that were printed."""
        printed_marks = SharedMarks(self.drawing, self.plan_of_step, self.submission.frames)
        lettered = {step for word in self.words if (step := word.steps.get(POINT)) is not None}
        return Counter(step for pair in combinations(lettered, 2) if printed_marks.are_one(*pair) for step in pair)

    # ---- who names what --------------------------------------------------------------------------------------------

    def named_submission(self) -> Submission:
        """The drawing with the names of its marks."""
        assignment = assign_labels([self._weigh(word) for word in self.words], measures.NAMELESS_COST,
                                   measures.SECOND_NAME_COST)
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
                    if assignment[order] not in dots and not (np.abs(spots - at) < measures.HALF_COST_MM).any()]
            if len(lone) == 1 and len(marks) >= measures.MIN_DOTTED_MARKS:
                lettered = {place for order, place in enumerate(assignment) if place is not None and order != lone[0]
                            and self._names_point(order) and self.words[order].wish[place] < measures.CLEAR_COST}
                near = [place for place in self._stray_dots - lettered
                        if abs(complex(*self.traces[place].spots[0]) - marks[lone[0]]) < measures.ASTRAY_DOT_MM]
                astray |= {lone[0]: near[0]} if len(near) == 1 else {}
        return astray

    def _names_point(self, order: int) -> bool:
        """Whether a word is a point's name, no number that may be of anything."""
        return POINT in self.words[order].steps and not self.words[order].names[0].isdigit()

    @cached_property
    def _letters_in_place(self) -> dict[int, complex]:
        """The letters of points that stand where their marks should be, each with that spot."""
        spots = {order: self._true_spots[word.steps[POINT]] for order, word in enumerate(self.words)
                 if self._names_point(order)}
        return {order: at for order, at in spots.items() if at is not None and _anchor(self.words[order].word).distance(
            Point(at.real, at.imag)) < _letter_reach(self.words[order].word)}

    def _weigh(self, one: LetteredWord) -> Wish:
        """What letters may name, and what it costs by nearness and by where the construction has it."""
        costs = {}
        for place, cost in one.wish.items():
            trace = self.traces[place]
            off = self._distance_off(one.steps[trace.kind], trace) if trace.kind in one.steps else math.inf
            if place >= len(self.submission.traces) and not self._may_mean(one, place, off):
                continue
            claimed = one.steps and place in self._claimed_points and off > measures.HALF_COST_MM
            stray_number = one.names[0].isdigit() and place in self._stray_dots
            leaves_dot = place in self.tips and not self._stray_dots.isdisjoint(one.wish)
            costs[place] = (cost + _astray_cost(off) + measures.CLAIMED_COST * bool(claimed)
                            + measures.LEFT_DOT_COST * leaves_dot
                            + measures.FOREIGN_COST * (not one.steps or stray_number))
            if off < measures.DIFFERENT_MM:
                costs[place] -= measures.SECOND_NAME_COST * self._sharers[one.steps[trace.kind]]
        return costs

    def _may_mean(self, one: LetteredWord, place: int, off: float) -> bool:
        """Whether letters may mean a place without a dot: where the mark should be; or a crossing, if they do not stand
        there. Letters alone are a mark about where they stand; numbers only where that should be."""
        step = one.steps.get(POINT)
        if step is None or place in self.alone:
            return step is not None and (off < _letter_reach(one.word) or not one.names[0].isdigit())
        at = self._true_spots[step]
        if off < measures.HALF_COST_MM or at is None:
            return off < measures.HALF_COST_MM or place not in self.ends
        return place not in self.ends and one.word.box.distance(Point(at.real, at.imag)) > _letter_reach(one.word)

    def _undotted_cost(self, one: LetteredWord) -> float:
        """What it would cost that letters mean where their mark should be, without a dot, and leave one beside them."""
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
        if one.names[0].isdigit() and off > 2 * measures.HALF_COST_MM:
            return False
        if place in self._stray_dots and self._stray_dots.isdisjoint(one.wish.keys() - {place}):
            return one.wish[place] + _astray_cost(off) < self._undotted_cost(one)
        least = min((cost for rival, cost in one.wish.items() if rival != place and self.traces[rival].kind == POINT),
                    default=math.inf)
        return (one.wish[place] < measures.CLEAR_COST and least - one.wish[place] > measures.CLEAR_COST
                and place not in self._claimed_points)


def _astray_cost(off: float) -> float:
    """What it costs that a mark is so many mm from where it should be."""
    return measures.MISPLACED_COST / (1 + (measures.HALF_COST_MM / off) ** 2) if off else 0.0


def _letters_as_mark(word: Lettering) -> Trace:
    """A mark that has no ink of its own, about where its letters stand."""
    at = word.box.centroid
    return Trace(POINT, ((at.x, at.y),), blur=math.hypot(measures.LETTERS_ALONE_MM, word.long / 4), crossed=True)


def _anchor(word: Lettering) -> Any:
    """What stands beside the mark: the letters, or the end of their leader."""
    return Point(*word.leads) if word.leads else word.box


def _letter_reach(word: Lettering) -> float:
    """How far off a mark may be from its letters, in mm."""
    return max(measures.LETTER_REACH_MM, measures.LETTER_REACH_SIZES * word.size)


def _spoken_steps(names: LabelTable, called: Sequence[str], sure: Container[int]) -> dict[str, dict[str, int]]:
    """The steps that letters may speak of, by kind; as loosely as they must be read, if none says it better."""
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
