"""A drawing judged: laid on the construction, gone through step by step, and its first wrong step explained."""

from __future__ import annotations

import cmath
import math
import statistics
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from itertools import chain, combinations
from typing import Any, NamedTuple

import numpy as np

from graphplan.design.hand import Pencil, SeenPencil
from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE, OPENING, POINT, Movement
from graphplan.kernel.passes import steps_behind
from graphplan.marking.judge import measures
from graphplan.marking.judge.designs import OtherDesigns, find_orphans, unmirror
from graphplan.marking.judge.evidence import Evidence, ImageSearch, unexplained_traces, with_wobble
from graphplan.marking.judge.frames import FrameFinder, SheetReading, departures, mirror_submission, to_mm
from graphplan.marking.judge.lettering import is_sure, labelled_steps, name_marks
from graphplan.marking.judge.matching import Matching, count_wrong, matches_on
from graphplan.marking.judge.numbers import judge_numbers, results_drawn_right, true_results
from graphplan.marking.judge.search import Search, likelihood, wrong_arrow
from graphplan.marking.judge.student_sheet import Fit, SharedMarks, StudentSheet
from graphplan.marking.judge.verdict import WRONG, FaultCount, Judgement
from graphplan.marking.judge.verdicts import verdicts
from graphplan.marking.judge.whole_plans import (
    WholePlan,
    are_surely_lettered,
    deviating_plans,
    exchanged_pairs,
    has_given_scale,
    with_exchanged,
    with_whole_plans,
)
from graphplan.marking.tolerances import VARIANCE_FLOOR
from graphplan.marking.traces import PlanFrame, Submission, Trace, bare_name
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM, VELOCITY_PLAN
from graphplan.phrases import Said, digits, join, said
from graphplan.phrases import unit as unit_of
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.plans import Plans


def judge(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil) -> Judgement:
    """Judge a drawing by its marks; `composition` is the sheet of the task.

    Fails with `Refused` where the mechanism is not to be found on it, or a size of an error is 0.
    """
    refuse_exact_pencil(pencil)
    submission, unit = to_mm(drawing, composition, submission, pencil)
    return Judge(SheetReading(drawing, composition, submission, unit),
                 assumed_pencil(pencil, submission)).with_seen_pencil.final_judgement


def refuse_exact_pencil(pencil: Pencil) -> None:
    """Refuse a pencil that never errs in something: no drawing can be judged by it."""
    if not all(pencil_error > 0 for pencil_error in pencil.model.values()):
        raise Refused(f"--pencil {pencil.description}", "a size is 0", "give sizes greater than 0")


class Judge:
    """One reading of a drawing, judged by its construction."""

    def __init__(self, reading: SheetReading, hand: SeenPencil):
        self.hand, pencil = hand, hand.pencil
        self.reading, self.drawing, self.pencil = reading, reading.drawing, pencil
        self.named = name_marks(self.drawing, reading.task, reading.submission, pencil)
        self.submission = blur_marks(self.named, hand)
        plan_of_step = StudentSheet(self.drawing, {}, pencil).plan_of_step
        self.search_cache: dict[tuple[Any, ...], Trace | None] = {}  # what was found in a picture by seeking it
        traces = self.submission.traces
        self.traces = [with_wobble(trace) for trace in traces] if self.submission.page else list(traces)
        self.labels = labelled_steps(self.drawing, plan_of_step, traces)
        printed_marks = SharedMarks(self.drawing, plan_of_step, self.submission.frames)
        self.labels |= printed_marks.labels_of_others(self.submission, self.labels)
        self.printed_panels: frozenset[str] = frozenset()  # the plans of the printed sheet on which it is drawn
        self.orphaned_marks = find_orphans(self.drawing, self.submission)
        certain = (place for place in self.labels.values()
                   if is_sure(traces[place]) or not (self.has_nameless_marks or traces[place].kind != POINT))
        points = (place for place, trace in enumerate(traces) if trace.label in self.drawing.scene.points)
        taken = {*self.orphaned_marks, *certain, *points}
        self.unlabelled = [place for place, trace in enumerate(traces) if place not in taken and not (
            self.submission.page and trace.kind == LINE and math.dist(*trace.spots[:2]) < measures.LONE_LINE_MM)]

    @property
    def has_nameless_marks(self) -> bool:
        """Whether most marks have no letters, so that later marks identify them. If most have, only those can be wrong:
        strokes have no stated meaning."""
        lettered = [bool(trace.label) and not trace.crossed for trace in self.traces if trace.kind == POINT]
        return bool(self.submission.page) or 2 * sum(lettered) <= len(lettered)

    @cached_property
    def fits(self) -> dict[str, Fit]:
        """Frames of all plans."""
        return self._find_frames()

    @cached_property
    def likeliest(self) -> Matching:
        """The way through in the frames that fit best, with the mistakes that make it likelier, letters that marks have
        of each other being put right."""
        matching = self.matching(self.fits, measures.MAX_MISTAKES)
        pairs = list(exchanged_pairs(matching))
        self._exchanged = [pair for pair in pairs if are_surely_lettered(matching, pair)]
        if pairs:
            self.labels |= {step: self.labels[partner] for pair in pairs for step, partner in (pair, pair[::-1])}
            matching = self.matching(self.fits, measures.MAX_MISTAKES)
        return self._with_wrong_arrows(matching)

    def _with_wrong_arrows(self, matching: Matching) -> Matching:
        """The way on which vectors go the wrong way that only arrows show."""
        mistake = wrong_arrow(matching, self.submission)
        return self._with_wrong_arrows(self._taking(matching, {mistake.step.index: mistake})) if mistake else matching

    def _taking(self, matching: Matching, taken: Mapping[int, Any]) -> Matching:
        """The same way, but for what some steps are taken for."""
        rival = self._start_matching(self.fits)
        rival.odds = matching.odds
        return rival.match_until(len(matching.steps), {**matching.taken, **taken})

    @property
    def with_seen_pencil(self) -> Judge:
        """Judge with the pencil that the drawing shows: pictures' traces have their own blur, and a program draws finer
        than any pencil."""
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
            spare = unexplained_traces(spare, [matching.traces[place] for place in needed])
        true = true_results(matching)
        numbers, unasked = judge_numbers(matching, self.submission.numbers, true)
        verdict_list = with_whole_plans(with_exchanged(verdicts(matching, numbers), self._exchanged, matching),
                                        self.deviating_plans, matching)
        return Judgement(
            self.submission.name, self.drawing, self.reading.composition,
            {panel: fit.frame for panel, fit in self.fits.items()}, tuple(verdict_list), tuple(spare), numbers,
            join(self._reading_words()), self.hand if self.hand.marks else None, unasked, self.submission.left_out,
            [step.op for step in self.drawing.drawn.steps] == [
                step.op for step in self.reading.task.plans.drawing.drawn.steps],
            drawn_right=results_drawn_right(matching, true,
                                            {plan.panel for plan in self.deviating_plans if plan.kind},
                                            {*chain.from_iterable(self._exchanged)}))

    @property
    def final_judgement(self) -> Judgement:
        """The judgement that is reported: of a picture, only a sure mistake is called wrong."""
        return self.judgement.without_doubtful_mistakes if self.submission.page else self.judgement

    @property
    def deviating_plans(self) -> list[WholePlan]:
        """The plans that lie otherwise than they should."""
        panels = [panel for panel in Plans(self.drawing).panels if panel != MECHANISM]
        return list(deviating_plans(self.reading, panels, self.fits))

    @property
    def _unused_numbers(self) -> int:
        """Number of points whose numbers the reading leaves out and that are no marks of the construction."""
        traces = self.likeliest.traces
        needed = {traces[place].spots for place in self.likeliest.used | self.likeliest.over}
        return sum(traces[place].kind == POINT and traces[place].spots not in needed
                   for place in self.reading.numbered)

    @property
    def _departures(self) -> float:
        """The number of mistakes that it counts for that plans depart from printed scales."""
        fits = [fit for panel, fit in self.fits.items()
                if panel != MECHANISM and not fit.tied and panel in self.printed_panels]
        return departures(fits, self.reading.departs if MECHANISM in self.printed_panels else 0, is_printed=True)

    @property
    def faults(self) -> FaultCount:
        """Faults of the reading; as wrong count departures from printed scales and points whose numbers are left out,
        too."""
        count = self.judgement.fault_count
        return count._replace(wrong=count.wrong + self._departures + self._unused_numbers)

    @property
    def has_faults(self) -> bool:
        """Whether something is wrong or missing, or cannot be judged."""
        return bool(self.orphaned_marks or self.faults.wrong or self.faults.missing)

    def explains_more(self, rival: Judge) -> bool:
        """Whether it leaves fewer faults than a rival, and of no sort more, or else is likelier; not where it calls no
        mark wrong, but leaves some out."""
        if self._unused_numbers and not self.judgement.fault_count.wrong:
            return False
        pairs = list(zip(self.faults, rival.faults, strict=True))
        has_fewer, has_more = any(mine < its for mine, its in pairs), any(mine > its for mine, its in pairs)
        return self.weight > rival.weight if has_fewer == has_more else has_fewer

    @property
    def weight(self) -> float:
        """Weight of this reading, with its mistakes as they are."""
        judgement = self.judgement
        wrong = [verdict.kind for verdict in judgement.verdicts if verdict.state == WRONG]
        numbers = sum(measures.NUMBER_ODDS if number.state != WRONG else -measures.NUMBER_ODDS
                      for number in judgement.numbers)
        return (self._prior + likelihood(self.likeliest) + numbers
                + measures.DEPARTURE_ODDS * judgement.fault_count.strange_letters
                + measures.KNOWN_MISTAKE_ODDS * self._departures
                + measures.UNNAMED_MISTAKE_ODDS * self._unused_numbers
                + sum(measures.KNOWN_MISTAKE_ODDS if kind else measures.UNNAMED_MISTAKE_ODDS for kind in wrong))

    @cached_property
    def first_look_weight(self) -> float:
        """Weight of this reading without a search for mistakes: every wrong mark may be one."""
        matching = self.matching(self.fits)
        return self._prior + likelihood(matching) + measures.KNOWN_MISTAKE_ODDS * count_wrong(matching.matches)

    @property
    def _prior(self) -> float:
        """Prior weight of the reading, and of plans with a scale and a direction of their own."""
        frame = self.fits[MECHANISM].frame
        free = [fit for panel, fit in self.fits.items()
                if panel != MECHANISM and not fit.tied and panel not in self.submission.frames]
        turned = sum(abs(cmath.phase(fit.frame.unit / frame.unit)) > measures.SAME_FRAME_SHARE + 3 * fit.turn
                     for fit in free)
        return measures.DEPARTURE_ODDS * (len(self.reading.remarks) + len(free) + turned)

    @property
    def hidden_steps(self) -> set[int]:
        """Steps that need not be drawn, and those that the task's own sheet does not show; another construction is not
        laid out for it."""
        task = self.reading.task
        if self.reading.asked is not None:
            steps = self.drawing.drawn.steps
            return {*range(len(steps))} - steps_behind(steps, self.reading.asked | self.labels.keys())
        if self.drawing is not task.plans.drawing:
            return set()
        hidden, steps = {mark.index for plate in task.plates for mark in plate.hidden_marks}, self.drawing.drawn.steps
        all_read, shown_read = ({arg for step in steps if step.index not in left_out for arg in step.args}
                                for left_out in (set(), hidden))
        return hidden | {index for index in all_read - shown_read if steps[index].op.gives == OPENING}

    def _reading_words(self) -> Iterator[Said]:
        """Yield the interpretation of the drawing, and its scale."""
        yield from self.reading.remarks
        yield from (plan.text for plan in self.deviating_plans if not plan.kind and plan.panel != self.reading.scaled)
        if self.reading.scaled in self.fits:
            scene, unit = self.drawing.scene, self.fits[self.reading.scaled].frame.unit
            speed = abs(1 / (self.drawing.kappa * unit))
            yield said("k_v = {0} {1} per mm", digits(speed, 3), unit_of(f"{scene.units.length}/s"))

    # ---- frames ----------------------------------------------------------------------------------------------------

    def _find_frames(self) -> dict[str, Fit]:
        """Find the frame of every plan: as on the task's sheet, unless another frame explains more."""
        if not self.submission.traces:  # numbers alone: as on the task's sheet
            return {panel: Fit(PlanFrame(complex(*view.origin), view.scale))
                    for panel, view in self.reading.composition.views.items()}
        blurred_reading = replace(self.reading, submission=self.submission)
        register = FrameFinder(blurred_reading, with_measured_points(self.pencil, self.submission), self.labels)
        if self.submission.frames.keys() >= set(register.panels):
            return {panel: Fit(self.submission.frames[panel]) for panel in register.panels}
        mechanism = register.mechanism()
        if self.unlabelled:
            register.expect_after(self._match_mechanism(mechanism, register.panels))
        expected = {panel: register.expected_fits(panel, mechanism) for panel in register.panels[1:]}
        fits = {MECHANISM: mechanism} | {panel: panel_fits[0] for panel, panel_fits in expected.items()}
        for panel, panel_fits in expected.items():
            if len(panel_fits) > 1:
                fits[panel] = self._likeliest_fit(fits, panel, panel_fits)
        if begun := register.find_origins(fits):
            self._take_labels(begun)
            fits |= {panel: register.expected_fits(panel, mechanism)[0] for panel in register.panels[1:]}
        return self._with_rivals(fits, register)

    def _with_rivals(self, fits: dict[str, Fit], register: FrameFinder) -> dict[str, Fit]:
        """The frames of the plans that explain their own steps best; of those of the printed sheet the ones with which
        all of the drawing needs fewest mistakes, and that they are others counts as mistakes as well."""
        best = self._fit_plans(fits, register, register.panels[1:])
        self.printed_panels = frozenset(panel for panel in register.printed_panels(fits)
                                        if panel == MECHANISM or not has_given_scale(self.reading, panel))
        least = self._mistakes_in(best, fits)
        panels = [panel for panel, fit in best.items()
                  if fit is not fits[panel] and panel in self.printed_panels][:measures.MAX_OWN_FRAMES]
        free = {*register.panels[1:]} - {*panels}
        for freed in chain.from_iterable(combinations(panels, count) for count in range(len(panels))):
            tried = self._fit_plans(fits, register, {*free, *freed})
            if (wrong := self._mistakes_in(tried, fits)) <= least:
                least, best = wrong, tried
        return best

    def _mistakes_in(self, fits: Mapping[str, Fit], expected: Mapping[str, Fit]) -> float:
        """Count of marks that are wrong in these frames, and of mistakes that these are beside the expected ones."""
        wrong = count_wrong(self._start_matching(fits).match_until(len(self.drawing.drawn.steps)).matches)
        departing = {panel: fit for panel, fit in fits.items() if fit is not expected[panel]}
        return wrong + departures(departing.values(), is_printed=not self.printed_panels.isdisjoint(departing))

    def _fit_plans(self, fits: dict[str, Fit], register: FrameFinder, freed: Collection[str]) -> dict[str, Fit]:
        """The frames of the plans, of the freed ones those that explain their own steps best, one after the other."""
        plan_of_step, fits = register.plan_of_step, {**fits}
        start = self._start_matching(fits)
        for panel in [panel for panel in register.panels[1:] if panel in freed and panel not in self.submission.frames]:
            end = len(plan_of_step) - plan_of_step[::-1].index(panel)
            start = start.fork(self._start_matching(fits)).match_until(plan_of_step.index(panel))
            matching = start.fork().match_until(end)
            least = float(count_wrong(matches_on(matching, panel)))
            for fit, weight in register.rival_fits(panel, matching) if least else ():
                rival = start.fork(self._start_matching({**fits, panel: fit})).match_until(end)
                if (wrong := count_wrong(matches_on(rival, panel)) + weight) < least:
                    least, fits[panel] = wrong, fit
        return fits

    def _likeliest_fit(self, fits: Mapping[str, Fit], panel: str, found: Sequence[Fit]) -> Fit:
        """The frame of a plan in which a drawing is likeliest, with the likeliest mistakes if it needs any."""
        matchings = [(self.matching({**fits, panel: fit}), fit) for fit in found]
        matchings.sort(key=lambda way: -way[0].weight)
        if sum(min(match.weight, 0.0) for match in matches_on(matchings[0][0], panel)) > measures.MIN_PLAN_ODDS:
            return matchings[0][1]
        return max((fit for _, fit in matchings[:measures.FRAMES_LOOKED_AT]),
                   key=lambda fit: self.matching({**fits, panel: fit}, 1).weight)

    def _match_mechanism(self, mechanism: Fit, panels: Sequence[str]) -> Matching:
        """Match the mechanism alone, with the other plans out of reach."""
        nowhere = Fit(PlanFrame(complex(measures.NOWHERE_MM), 1.0))
        return self.matching({panel: mechanism if panel == MECHANISM else nowhere for panel in panels})

    def _take_labels(self, found: Mapping[int, int]) -> None:
        """Take unlabelled traces for what they were found to be."""
        self.labels |= found
        self.unlabelled = [place for place in self.unlabelled if place not in found.values()]

    # ---- the way through -------------------------------------------------------------------------------------------

    def matching(self, fits: Mapping[str, Fit], mistakes: int = 0) -> Matching:
        """The way through the construction, with the mistakes, not more than so many, that make it likelier."""
        matching = self._start_matching(fits)
        search = Search(matching.fork())
        mistakes_found = search.find_mistakes(mistakes) if mistakes and self.has_nameless_marks else {}
        matching.odds = search.odds
        return matching.match_until(len(matching.steps), mistakes_found)

    def _start_matching(self, fits: Mapping[str, Fit]) -> Matching:
        """Before the first step, in these frames."""
        task_multiple = float(self.reading.composition.scales.multiples.get(VELOCITY_PLAN, 1))
        own_scale = (abs(fits[VELOCITY_PLAN].frame.unit / fits[MECHANISM].frame.unit) / task_multiple
                     if VELOCITY_PLAN in fits else 1.0)
        sheet = StudentSheet(self.drawing, fits, self.pencil, self.hidden_steps, max(1.0, own_scale))
        sources = sheet, self.submission, self.traces, self.unlabelled
        evidence = (ImageSearch(*sources, self.reading.composition.arrangement.panels, self.search_cache)
                    if self.submission.page else Evidence(*sources, self.has_nameless_marks))
        return Matching(evidence, self.labels, measures.FALSE_ALARM_CHANCE / max(1, len(self.drawing.drawn)))


def judge_any_design(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil,
                     plan: str = "") -> Judgement:
    """Return the judgement of a drawing by the design of the task, or by the one that explains it best.

    Others are thought of only where a mark is wrong or missing; other plans, where `plan` asks for none. Fails as
    :func:`judge` does.
    """
    refuse_exact_pencil(pencil)
    best = first = Judge(unmirror(drawing, composition, submission, pencil),
                         assumed_pencil(pencil, submission)).with_seen_pencil
    if first.has_faults:
        others = OtherDesigns(first.reading, replace(first.named, letters=()), first.fits[MECHANISM].frame, pencil,
                              plan)
        for rival in sorted(_judges(others.readings(), first.hand), key=lambda rival: -rival.first_look_weight):
            if rival.first_look_weight + measures.CLOSER_LOOK_ODDS > best.weight and rival.explains_more(best):
                best = rival
    return (best if best is first else best.with_seen_pencil).final_judgement


def _judges(readings: Iterable[SheetReading], hand: SeenPencil) -> Iterator[Judge]:
    """The judges of those readings in which the mechanism is found."""
    for reading in readings:
        with suppress(Refused):
            rival = Judge(reading, hand)
            if rival.fits:
                yield rival


# ---- tasks of which several drawings are right ----------------------------------------------------------------------


class RightDrawing(NamedTuple):
    """A drawing that is right: the steps whose marks are `asked` for, and whether it is right `mirrored` too."""

    drawing: Construction
    asked: frozenset[int]
    mirrored: bool = False


def judge_any_drawing(drawings: Callable[[Iterable[str], Mapping[str, complex]], Iterable[RightDrawing]],
                      composition: Composition, submission: Submission, pencil: Pencil) -> Judgement:
    """Judge a drawing by the right drawing that it most likely means. Fails as :func:`judge` does."""
    best: Judge | None = None
    refusal, places = None, dict[str, complex]()
    names = [*(trace.label for trace in submission.traces), *(word.text for word in submission.letters)]
    for right in drawings(map(bare_name, names), places):
        for side in (submission, mirror_submission(submission))[:1 + (right.mirrored and not submission.page)]:
            try:
                sheet, remarks = to_mm(right.drawing, composition, side, pencil)
                reading = SheetReading(right.drawing, composition, sheet, remarks, asked=right.asked)
                rival = Judge(reading, assumed_pencil(pencil, sheet)).with_seen_pencil
            except Refused as fault:
                refusal = refusal or fault
                continue
            if best is None or rival.weight > best.weight:
                best = rival
                places.update(_lettered_places(best))
            if not best.has_faults:
                return best.final_judgement
    if best is None:
        assert refusal is not None
        raise refusal
    return best.final_judgement


def _lettered_places(judge: Judge) -> dict[str, complex]:
    """Places of lettered points on the mechanism's plan, by bare letters."""
    steps, frame = judge.drawing.drawn.steps, judge.fits[MECHANISM].frame
    return {bare_name(steps[step].name): frame.to_plan(complex(*judge.traces[place].spots[0]))
            for step, place in judge.labels.items() if steps[step].op.gives == POINT}


# ---- the pencil that a drawing shows --------------------------------------------------------------------------------

# The pencil that a drawing shows: how unsteady the hand is that drew it, and how finely its marks were read. Every
# step whose mark is there is a sample of both: what it is off beside the student's own earlier marks comes from the
# hand at this step and from the reading of all these marks, each carried through the scales of its plan and through
# what is laid off. A vector that is drawn five times as long shows errors of reading five times as large; so the two
# can be told apart. Samples are normal, but for some that are mistakes and lie anywhere. What is stated, and what is
# usual, is the prior: a drawing of few marks is judged by it. The spread of what is left of both is in the sizes that
# are given.


SCALES_TRIED, READINGS_TRIED, SHARES_TRIED = (np.geomspace(*tried) for tried in (
    measures.HAND_SCALES, measures.READINGS_MM, measures.STATED_SHARES))
Sample = tuple[Any, Any, Any]  # how far off, the covariance from the hand, and from reading


def assumed_pencil(stated: Pencil, submission: Submission) -> SeenPencil:
    """The stated pencil, and the usual reading error unless a precision is stated."""
    return SeenPencil(stated, 1.0, measures.RULER_MM if submission.measured and not submission.stated else 0.0)


def seen_pencil(matching: Matching, now: SeenPencil, submission: Submission) -> SeenPencil | None:
    """The pencil that a drawing shows, from a way through it that was judged by another; None where too few marks tell
    it."""
    samples = list(_pencil_samples(matching))
    if len(samples) < measures.MIN_WITNESSES:
        return None
    rounding = max(0.0, min((trace.blur**2 for trace in submission.traces), default=0.0))
    read, stated_shares, reading_ratios = np.zeros(1), np.ones(1), np.ones(1)
    odds = -np.log(SCALES_TRIED)[:, None] ** 2 / (2 * measures.HAND_SCALE_SIGMA**2)
    if submission.measured and submission.stated:
        stated_shares, reading_ratios = SHARES_TRIED, (SHARES_TRIED / now.share_shown) ** 2
        odds = odds - np.log(SHARES_TRIED)[None, :] ** 2 / (2 * measures.STATED_SHARE_SIGMA**2)
    if now.reading:
        read, reading_ratios = READINGS_TRIED, (READINGS_TRIED**2 + rounding) / (now.reading**2 + rounding)
        odds = odds - np.log(READINGS_TRIED / measures.RULER_MM)[None, :] ** 2 / (2 * measures.READING_SIGMA**2)
    for width in (1, 2, 3):
        odds = odds + _sample_likelihood([sample for sample in samples if len(sample[0]) == width],
                                         SCALES_TRIED / now.scale,
                                         reading_ratios)
    weights = np.exp(odds - odds.max())
    weights /= weights.sum()
    scale, reading, share = (math.sqrt(float(np.sum(weights * tried_sizes**2)))
                             for tried_sizes in (SCALES_TRIED[:, None], read[None, :], stated_shares[None, :]))
    return SeenPencil(now.stated, scale, reading, len(samples), share)


def _sample_likelihood(samples: Sequence[Sample], scales: Any, reads: Any) -> Any:
    """The logarithm of how likely these samples are, by every scale of the hand and every part of reading."""
    if not samples:
        return 0.0
    off, hand, reading = (np.array(column) for column in zip(*samples, strict=True))
    wide = off.shape[1]
    covariance = (scales**2)[:, None, None, None, None] * hand + reads[:, None, None, None] * reading[None]
    covariance = covariance + VARIANCE_FLOOR * np.eye(wide)
    squares = np.einsum("...i,...i", off, np.linalg.solve(covariance, np.broadcast_to(
        off[..., None], (*covariance.shape[:-1], 1)))[..., 0])
    density = np.exp(-squares / 2) / np.sqrt((2 * math.pi) ** wide * np.linalg.det(covariance))
    return np.sum(np.log((1 - measures.MISTAKE_SHARE) * density
                         + measures.MISTAKE_SHARE / measures.MISTAKE_SPREAD_MM**wide), axis=-1)


def _pencil_samples(matching: Matching) -> Iterator[Sample]:
    """Yield the distances of the marks, with the variance that the hand and the reading of a unit each add."""
    sheet, sampled_places = matching.sheet, set[int]()
    for match in matching.matches:
        residual = match.residual
        if (residual is None or match.place is None or match.place in sampled_places
            or match.step.op.movement is Movement.BEGUN):
            continue
        if residual.covariance.max() > measures.MISTAKE_SPREAD_MM**2:  # it may be anywhere
            continue
        sampled_places.add(match.place)
        partials = residual.partials
        read = partials[:, sheet.reading_errors[:partials.shape[1]]]
        reading = read @ read.T
        yield residual.off, residual.covariance - reading, reading


def with_measured_points(pencil: Pencil, submission: Submission) -> Pencil:
    """The pencil with points as far off as they are when they have been measured."""
    blurs = [trace.blur for trace in submission.traces] if submission.measured else []
    return replace(pencil, point=math.hypot(pencil.point, statistics.median(blurs))) if blurs else pencil


def blur_marks(submission: Submission, hand: SeenPencil) -> Submission:
    """The marks of a drawing as finely as they were read, beside how they were rounded."""
    if not hand.reading and hand.share_shown == 1.0:
        return submission
    return replace(submission, traces=tuple(
        replace(trace, blur=math.hypot(hand.share_shown * trace.blur, hand.reading)) for trace in submission.traces))
