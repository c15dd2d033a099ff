"""A drawing judged: laid on the construction, gone through step by step, and its first wrong step explained; by the
construction that it follows, of all those that lead to what was asked."""

from __future__ import annotations

import cmath
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from typing import Any

from graphplan.accuracy.hand import Pencil, SeenPencil
from graphplan.accuracy.preference import Constructing
from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE, POINT
from graphplan.marking.judge import measures
from graphplan.marking.judge.conventions import Proposer, orphans, seen_right_way
from graphplan.marking.judge.evidence import Evidence, ImageSearch, unexplained, wobbly
from graphplan.marking.judge.exchanged import exchanged, told
from graphplan.marking.judge.labels import labelled, sure
from graphplan.marking.judge.lettering import lettered
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.readings import Reading
from graphplan.marking.judge.register import Register
from graphplan.marking.judge.search import Search
from graphplan.marking.judge.seen_pencil import as_measured, assumed, blurred, seen_pencil
from graphplan.marking.judge.student_sheet import Fit, StudentSheet
from graphplan.marking.judge.units import in_mm
from graphplan.marking.judge.verdict import FOLLOWS, MISSING, RIGHT, WRONG, Judgement
from graphplan.marking.judge.verdicts import judged, verdicts
from graphplan.marking.spelling import mark
from graphplan.marking.traces import PlanFrame, Submission, Trace
from graphplan.methods.construct import construct as unchecked
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said, digits, join, said
from graphplan.phrases import unit as unit_of
from graphplan.sheet.layout.composition import Composition


def judge(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil) -> Judgement:
    """What is said of a drawing, by the marks on it; `composition` is the sheet that the task was set on.

    Fails with `Refused` where the mechanism is not to be found on it, or a size of an error is 0.
    """
    submission, unit = in_mm(drawing, composition, submission, pencil)
    return Judge(Reading(drawing, composition, submission, unit), assumed(pencil, submission)).steadied.judgement


class Judge:
    """One reading of a drawing, judged by its construction."""

    def __init__(self, reading: Reading, hand: SeenPencil):
        self.hand, pencil = hand, hand.pencil
        if not all(size > 0 for size in pencil.model.values()):
            raise Refused(f"--pencil {pencil.description}", "a size is 0", "give sizes greater than 0")
        self.reading, self.drawing, self.pencil = reading, reading.drawing, pencil
        self.named = lettered(self.drawing, reading.task, reading.submission, pencil)
        self.submission = blurred(self.named, hand)
        plan_of_step = StudentSheet(self.drawing, {}, pencil).plan_of_step
        self.sought: dict[tuple[Any, ...], Trace | None] = {}  # what was found in a picture by seeking it
        traces = self.submission.traces
        self.traces = [wobbly(trace) for trace in traces] if self.submission.page else list(traces)
        self.labels = labelled(self.drawing.drawn, plan_of_step, traces)
        self.orphans = orphans(self.drawing, self.submission)
        taken = {*self.orphans, *(place for place in self.labels.values() if sure(traces[place]))}
        self.unlabelled = [place for place, trace in enumerate(traces) if place not in taken and not (
            self.submission.page and trace.kind == LINE and math.dist(*trace.spots[:2]) < measures.MIN_PICTURE_LINE_MM)]

    @cached_property
    def fits(self) -> dict[str, Fit]:
        """Where every plan lies."""
        return self._frames()

    @cached_property
    def likeliest(self) -> Matching:
        """The way through in the frames that fit best, with the mistakes that make it likelier, letters that marks have
        of each other being put right."""
        matching = self.matching(self.fits, measures.MAX_MISTAKES)
        self._exchanged = list(exchanged(matching))
        if self._exchanged:
            self.labels |= {step: self.labels[other] for pair in self._exchanged
                            for step, other in (pair, pair[::-1])}
            matching = self.matching(self.fits, measures.MAX_MISTAKES)
        return matching

    @property
    def steadied(self) -> Judge:
        """The same reading, judged by the pencil that the drawing shows: pictures' traces have their own blur, and what
        a program draws is finer than any pencil."""
        if self.submission.page:
            return self
        hand = seen_pencil(self.likeliest, self.hand, self.reading.submission)
        return Judge(self.reading,
                     hand) if hand and (self.submission.measured or hand.scale > measures.MIN_PENCIL_RATIO) else self

    @cached_property
    def judgement(self) -> Judgement:
        """The verdicts of the frames that fit best, the wrong ones explained."""
        matching = self.likeliest
        needed = matching.used | matching.over
        spare = [trace for place, trace in enumerate(self.submission.traces) if place not in needed]
        if self.submission.page:
            spare = unexplained(spare, [matching.traces[place] for place in needed])
        numbers, unasked = judged(matching, self.submission.numbers)
        found = told(verdicts(matching, numbers), self._exchanged, matching)
        return Judgement(
            self.submission.name, self.drawing, self.reading.composition,
            {panel: fit.frame for panel, fit in self.fits.items()}, tuple(found), tuple(spare), numbers,
            join(self._told()), self.hand if self.hand.marks else None, unasked, self.submission.left_out)

    @property
    def lacks(self) -> bool:
        """Whether something is wrong or missing, or cannot be judged."""
        return bool(self.orphans) or any(verdict.state in (WRONG, MISSING) for verdict in self.judgement.verdicts)

    @property
    def unexplained(self) -> bool:
        """Whether more than a single wrong mark speaks against the construction."""
        states = Counter(verdict.state for verdict in self.judgement.verdicts)
        return self.lacks and bool(states[MISSING] or self.judgement.spare or states[WRONG] > 1)

    @property
    def weight(self) -> float:
        """What speaks for this reading, the mistakes in it being what they are."""
        found = self.judgement
        wrong = [verdict.kind for verdict in found.verdicts if verdict.state == WRONG]
        numbers = sum(measures.NUMBER_ODDS if number.state != WRONG else -measures.NUMBER_ODDS
                      for number in found.numbers)
        strange = sum(trace.kind == POINT and bool(mark(trace.label)) for trace in found.spare)
        return (self._prior + likelihood(self.likeliest) + numbers + measures.TORN_ODDS * torn(self.likeliest)
                + measures.STRANGE_LETTER_ODDS * strange
                + sum(measures.KNOWN_MISTAKE_ODDS if kind else measures.UNNAMED_MISTAKE_ODDS for kind in wrong))

    @property
    def glance(self) -> float:
        """What may speak for it, as far as that is seen without looking for mistakes: every wrong mark may be one."""
        matching = self.matching(self.fits)
        wrong = sum(match.state == WRONG for match in matching.matches)
        return self._prior + likelihood(matching) + measures.KNOWN_MISTAKE_ODDS * wrong

    @property
    def _prior(self) -> float:
        """How unlikely the reading is by itself, and plans of a scale and of a direction of their own."""
        frame = self.fits[MECHANISM].frame
        free = [fit for panel, fit in self.fits.items()
                if panel != MECHANISM and not fit.tied and panel not in self.submission.frames]
        turned = sum(abs(cmath.phase(fit.frame.unit / frame.unit)) > measures.SAME_DIRECTION_SINE + 3 * fit.turn
                     for fit in free)
        return self.reading.prior + measures.OWN_FRAME_ODDS * (len(free) + turned)

    @cached_property
    def hidden(self) -> set[int]:
        """The steps that the task's own sheet does not show; another construction is not laid out for it."""
        task = self.reading.task
        return {drawn.index for plate in task.plates
                for drawn in plate.hidden_marks} if self.drawing is task.plans.drawing \
            else set()

    def _told(self) -> Iterator[Said]:
        """How the drawing was interpreted, and its scale."""
        yield from self.reading.told
        if self.reading.scaled:
            scene, unit = self.drawing.scene, self.fits[self.reading.scaled].frame.unit
            speed = abs(1 / (self.drawing.kappa * unit))
            yield said("k_v = {0} {1} per mm", digits(speed, 3), unit_of(f"{scene.units.length}/s"))

    # ---- frames ----------------------------------------------------------------------------------------------------

    def _frames(self) -> dict[str, Fit]:
        """Where every plan lies, plan by plan: as on the task's sheet, unless another frame explains more."""
        if not self.submission.traces:  # numbers alone: as on the task's sheet
            return {panel: Fit(PlanFrame(complex(*view.origin), view.scale))
                    for panel, view in self.reading.composition.views.items()}
        seen = replace(self.reading, submission=self.submission)
        register = Register(seen, as_measured(self.pencil, self.submission), self.labels)
        if self.submission.frames.keys() >= set(register.panels):
            return {panel: Fit(self.submission.frames[panel]) for panel in register.panels}
        mechanism = register.mechanism()
        if self.unlabelled:
            register.follow(self._alone(mechanism, register.panels))
        expected = {panel: register.expected(panel, mechanism) for panel in register.panels[1:]}
        fits = {MECHANISM: mechanism} | {panel: found[0] for panel, found in expected.items()}
        for panel, found in expected.items():
            if len(found) > 1:
                fits[panel] = self._likeliest(fits, panel, found)
        if begun := register.begins(fits):
            self._label(begun)
            fits |= {panel: register.expected(panel, mechanism)[0] for panel in register.panels[1:]}
        return self._relaid(fits, register)

    def _relaid(self, fits: dict[str, Fit], register: Register) -> dict[str, Fit]:
        """The frames of the plans whose steps are wrong in the expected ones, as rivals have it that explain them."""
        plan_of_step, start = register.plan_of_step, self._start(fits)
        known = self.submission.frames.keys() | self.reading.fits.keys()
        for panel in [panel for panel in register.panels[1:] if panel not in known]:
            end = len(plan_of_step) - plan_of_step[::-1].index(panel)
            start = start.fork(self._start(fits)).until(plan_of_step.index(panel))
            matching = start.fork().until(end)
            wrong, best = float(_wrong(matching, panel)), fits[panel]
            for fit, weight in register.rivals(panel, matching) if wrong else ():
                other = start.fork(self._start({**fits, panel: fit})).until(end)
                if _wrong(other, panel) + weight < wrong:
                    wrong, best = _wrong(other, panel) + weight, fit
            fits[panel] = best
        return fits

    def _likeliest(self, fits: Mapping[str, Fit], panel: str, found: Sequence[Fit]) -> Fit:
        """The frame of a plan in which a drawing is likeliest, with the likeliest mistakes if it needs any."""
        ways = [(self.matching({**fits, panel: fit}), fit) for fit in found]
        ways.sort(key=lambda way: -way[0].weight)
        if sum(min(match.weight, 0.0) for match in _on(ways[0][0], panel)) > measures.MIN_PLAN_ODDS:
            return ways[0][1]
        return max((fit for _, fit in ways[:measures.FRAMES_LOOKED_AT]),
                   key=lambda fit: self.matching({**fits, panel: fit}, 1).weight)

    def _alone(self, mechanism: Fit, panels: Sequence[str]) -> Matching:
        """The way through with the mechanism alone; the other plans are as good as nowhere."""
        nowhere = Fit(PlanFrame(complex(measures.NOWHERE_MM), 1.0))
        return self.matching({panel: mechanism if panel == MECHANISM else nowhere for panel in panels})

    def _label(self, found: Mapping[int, int]) -> None:
        """Take loose traces for what they were found to be."""
        self.labels |= found
        self.unlabelled = [place for place in self.unlabelled if place not in found.values()]

    # ---- the way through -------------------------------------------------------------------------------------------

    def matching(self, fits: Mapping[str, Fit], mistakes: int = 0) -> Matching:
        """The way through the construction, with the mistakes, not more than so many, that make it likelier."""
        matching = self._start(fits)
        search = Search(matching.fork())
        found = search.found(mistakes) if mistakes and self.unlabelled else {}
        matching.odds = search.odds
        return matching.until(len(matching.steps), found)

    def _start(self, fits: Mapping[str, Fit]) -> Matching:
        """Before the first step, in these frames."""
        sheet = StudentSheet(self.drawing, fits, self.pencil, self.hidden)
        what = sheet, self.submission, self.traces, self.unlabelled
        panels = self.reading.composition.arrangement.panels if self.submission.page else {}
        evidence = ImageSearch(*what, panels, self.sought) if self.submission.page else Evidence(*what)
        return Matching(evidence, self.labels, measures.FALSE_ALARM_CHANCE / max(1, len(self.drawing.drawn)))


def _on(matching: Matching, panel: str) -> Iterator[Match]:
    """What the steps of a plan were taken for."""
    return (match for match in matching.matches if matching.sheet.plan_of_step[match.step.index] == panel)


def _wrong(matching: Matching, panel: str) -> int:
    """How many steps of a plan are wrong on the way through."""
    return sum(match.state == WRONG for match in _on(matching, panel))


def likelihood(matching: Matching) -> float:
    """What the marks of a drawing speak for the construction beside which they were matched.

    A mark that might as well be elsewhere tells less. What is missing of a plan was left out together: each mark more
    tells less than the one before.
    """
    found, left_out = 0.0, Counter[str]()
    for match in matching.matches:
        if match.place is None and match.weight < 0 and match.mistake is None:
            left_out[matching.sheet.plan_of_step[match.step.index]] += 1
            continue
        vague = match.residual.vague(measures.SHARP_MM) if match.residual and match.state != WRONG else 0.0
        found += max(match.weight - vague, min(match.weight, 0.0))
    return found - sum(measures.MISSED_MARK_COST * (1 + math.log(count)) for count in left_out.values())


def torn(matching: Matching) -> bool:
    """Whether some marks follow from a wrong one, and others from where that should be: nobody draws from both."""
    rest: set[int] = set()
    for match in matching.matches:
        if match.state == WRONG or not rest.isdisjoint(match.step.args):
            rest.add(match.step.index)
    states = {match.state for match in matching.matches if match.place is not None and match.step.index in rest}
    return states >= {RIGHT, FOLLOWS}


def judge_any_method(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil,
                     plan: str = "", inertia: str = "couple", construct: Constructing = unchecked) -> Judgement:
    """What is said of a drawing as the task has it, or as it is likelier meant.

    Other readings are thought of only where a mark is wrong or missing: velocities of another scale or sense, and
    unless `plan` names one, other plans; other forms of each. Fails as :func:`judge` does.
    """
    best = first = Judge(seen_right_way(drawing, composition, submission, pencil), assumed(pencil, submission)).steadied
    if best.lacks:
        seen = replace(best.named, letters=())
        proposer = Proposer(best.reading, seen, best.fits[MECHANISM].frame, pencil, plan, inertia, construct)
        if best.orphans and (own := proposer.with_all_ends()):
            best = Judge(own, best.hand)
        task, best = best, _likelier(best, proposer.proposed())
        if best.unexplained:
            readings = [best.reading] if best is task else [best.reading, task.reading]
            best = _likelier(best, (form for reading in readings for form in proposer.forms(reading)))
    return (best if best is first else best.steadied).judgement


def _likelier(best: Judge, readings: Iterable[Reading]) -> Judge:
    """The likeliest of some readings; only those that promise something at a glance are looked at closely."""
    others: list[tuple[float, int, Judge]] = []
    for reading in readings:
        with suppress(Refused):
            other = Judge(reading, best.hand)
            others.append((other.glance, len(others), other))
    for glance, _, other in sorted(others, reverse=True, key=lambda one: one[:2])[:measures.READINGS_LOOKED_AT]:
        if glance + measures.CLOSER_LOOK_ODDS > best.weight and other.weight > best.weight:
            best = other
    return best
