"""A drawing judged: laid on the construction, gone through step by step, and its first wrong step explained; by the
construction that it follows, of all those that lead to what was asked."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from graphplan.accuracy.pencil import Pencil
from graphplan.accuracy.preference import Constructing, forms
from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE
from graphplan.marking.judge.evidence import Evidence, ImageSearch, wobbly
from graphplan.marking.judge.labels import labelled, sure
from graphplan.marking.judge.lettering import lettered
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.register import Register
from graphplan.marking.judge.search import Search
from graphplan.marking.judge.student_sheet import Fit, StudentSheet
from graphplan.marking.judge.verdict import MISSING, WRONG, Judgement
from graphplan.marking.judge.verdicts import judged, verdicts
from graphplan.marking.traces import PlanFrame, Submission, Trace
from graphplan.methods.construct import construct as unchecked
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.layout.composition import Composition

STUMP = 10.0  # mm: a shorter line of a picture may be a piece of an arc or of a letter, unless it is sought there
NOWHERE, RIVALS = 1e6, 2  # mm: as far off as no sheet is; how many frames of a plan are looked at closely
LITTLE = -10.0  # what may speak against a frame in which no mistake is looked for
MOST = 4  # mistakes that are looked for
ALARM = 0.002  # how often a faultless drawing may be called wrong


def judge(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil) -> Judgement:
    """What is said of a drawing, by the marks on it; `composition` is the sheet that the task was set on.

    Fails with `Refused` where the mechanism is not to be found on it, or a hand without errors has no tolerance.
    """
    if not all(size > 0 for size in pencil.model.values()):
        raise Refused(f"--pencil {pencil.told}", "a hand without errors has no tolerance", "sizes above 0")
    return Judge(drawing, composition, submission, pencil).judgement()


class Judge:
    """One drawing beside its construction."""

    def __init__(self, drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil):
        self.drawing, self.composition, self.pencil = drawing, composition, pencil
        self.submission = submission = lettered(drawing, composition, submission, pencil)
        plan_of_step = StudentSheet(drawing, {}, pencil).plan_of_step
        self.hidden = {drawn.index for plate in composition.plates for drawn in plate.hidden}
        self.sought: dict[tuple[Any, ...], Trace | None] = {}  # what was found in a picture by seeking it
        self.traces = [wobbly(trace) for trace in submission.traces] if submission.page else list(submission.traces)
        self.labels = labelled(drawing.drawn, plan_of_step, submission.traces)
        taken = {place for place in self.labels.values() if sure(submission.traces[place])}
        self.unlabelled = [place for place, trace in enumerate(submission.traces) if place not in taken and not (
            submission.page and trace.kind == LINE and math.dist(*trace.spots[:2]) < STUMP)]

    def judgement(self) -> Judgement:
        """The verdicts of the frames that fit best, the wrong ones explained."""
        fits = self._frames()
        matching = self.matching(fits, MOST)
        needed = matching.used | matching.over
        spare = [trace for place, trace in enumerate(self.submission.traces) if place not in needed]
        numbers = tuple(judged(matching, self.submission.numbers)) if self.submission.numbers else ()
        return Judgement(
            self.submission.name, self.drawing, self.composition, {panel: fit.frame for panel, fit in fits.items()},
            tuple(verdicts(matching)), tuple(spare), numbers)

    # ---- frames ----------------------------------------------------------------------------------------------------

    def _frames(self) -> dict[str, Fit]:
        """Where every plan lies, plan by plan: as on the task's sheet, unless another frame explains more."""
        if not self.submission.traces:  # numbers alone: as on the task's sheet
            return {panel: Fit(PlanFrame(complex(*view.origin), view.scale))
                    for panel, view in self.composition.views.items()}
        register = Register(self.drawing, self.composition, self.submission, self.pencil, self.labels)
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
        for panel in [panel for panel in register.panels[1:] if panel not in self.submission.frames]:
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
        if sum(min(match.weight, 0.0) for match in _on(ways[0][0], panel)) > LITTLE:
            return ways[0][1]
        return max((fit for _, fit in ways[:RIVALS]), key=lambda fit: self.matching({**fits, panel: fit}, 1).weight)

    def _alone(self, mechanism: Fit, panels: Sequence[str]) -> Matching:
        """The way through with the mechanism alone; the other plans are as good as nowhere."""
        nowhere = Fit(PlanFrame(complex(NOWHERE), 1.0))
        return self.matching({panel: mechanism if panel == MECHANISM else nowhere for panel in panels})

    def _label(self, found: Mapping[int, int]) -> None:
        """Take loose traces for what they were found to be."""
        self.labels |= found
        self.unlabelled = [place for place in self.unlabelled if place not in found.values()]

    # ---- the way through -------------------------------------------------------------------------------------------

    def matching(self, fits: Mapping[str, Fit], mistakes: int = 0) -> Matching:
        """The way through the construction, with the mistakes, not more than so many, that make it likelier."""
        matching = self._start(fits)
        found = Search(matching.fork()).found(mistakes) if mistakes and self.unlabelled else {}
        return matching.until(len(matching.steps), found)

    def _start(self, fits: Mapping[str, Fit]) -> Matching:
        """Before the first step, in these frames."""
        sheet = StudentSheet(self.drawing, fits, self.pencil, self.hidden)
        what = sheet, self.submission, self.traces, self.unlabelled
        evidence = ImageSearch(*what, self.composition.arrangement.panels, self.sought) if self.submission.page \
            else Evidence(*what)
        return Matching(evidence, self.labels, ALARM / len(self.drawing.drawn))


def _on(matching: Matching, panel: str) -> Iterator[Match]:
    """What the steps of a plan were taken for."""
    return (match for match in matching.matches if matching.sheet.plan_of_step[match.step.index] == panel)


def _wrong(matching: Matching, panel: str) -> int:
    """How many steps of a plan are wrong on the way through."""
    return sum(match.state == WRONG for match in _on(matching, panel))


STYLES = ("orthogonal", "polar")
WRONGED = 3  # a wrong step speaks against a construction as much as so many that are missing or not asked for


def judge_any_method(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil,
                 plan: str = "", inertia: str = "couple", construct: Constructing = unchecked) -> Judgement:
    """What is said of a drawing by the construction of its task, or by another that it follows better.

    Others are tried only where a mark is wrong or missing: in the other forms of loci and rings, and unless `plan`
    names one, on the other plans. Fails as :func:`judge` does.
    """
    best = judge(drawing, composition, submission, pencil)
    lacking = any(verdict.state in (WRONG, MISSING) for verdict in best.verdicts)
    for other, sheet in _others(drawing, pencil, plan, inertia, construct) if lacking else ():
        try:
            found = judge(other, sheet, submission, pencil)
        except Refused:
            continue
        best = found if _amiss(found) < _amiss(best) else best
    return best


def _others(drawing: Construction, pencil: Pencil, plan: str, inertia: str, construct: Constructing
            ) -> Iterator[tuple[Construction, Composition]]:
    """All other constructions of a scene, on their sheets."""
    for style in (plan,) if plan else STYLES:
        for form in forms(drawing.scene, pencil, plan=style, strict=drawing.strict, inertia=inertia,
                          construct=construct):
            if form.drafted and form.drafted.drawing.drawn.steps != drawing.drawn.steps:
                yield form.drafted.drawing, form.drafted.composition


def _amiss(judgement: Judgement) -> int:
    """How much speaks against a construction: wrong steps, traces that it does not need, marks that are missing."""
    states = [verdict.state for verdict in judgement.verdicts]
    return WRONGED * states.count(WRONG) + len(judgement.spare) + states.count(MISSING)
