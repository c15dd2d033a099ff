"""Plans that are wrong as a whole: reversed, turned, or drawn at another scale than the one that is given.

A plan has the direction of the mechanism, and where the task gives its scale, that too. Where all of its vectors differ
from that by the same turn and factor, that is one mistake, and is told at the first of its marks; the others follow.
Two marks that bear each other's letters are one mistake too, and none about mechanics.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from graphplan.kernel.kinds import POINT
from graphplan.kernel.program import Panel
from graphplan.marking.judge import measures
from graphplan.marking.judge.frames import SheetReading, frame_stretch, frame_turn
from graphplan.marking.judge.lettering import is_sure
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.student_sheet import Fit, plain_value
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, WRONG, Verdict
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Phrase, Said, digits, phrase, said

REVERSED_PLAN, TURNED_PLAN, RESCALED_PLAN = "plan reversed", "plan turned", "plan of another scale"
KIND_WORDS: Mapping[str, Phrase] = {
    REVERSED_PLAN: phrase("a whole plan reversed"), TURNED_PLAN: phrase("a whole plan turned"),
    RESCALED_PLAN: phrase("a whole plan at another scale than the given one"),
}


@dataclass(frozen=True)
class WholePlan:
    """A plan with a wrong position: the mistake's kind, empty for another scale if no scale is given; its words; and
    the unit that the plan should have."""

    panel: str
    kind: str
    text: Said
    unit: complex


def deviating_plans(reading: SheetReading, panels: Iterable[Panel], fits: Mapping[str, Fit]) -> Iterator[WholePlan]:
    """The plans that are turned or scaled otherwise than the mechanism and the task say."""
    for panel in panels:
        unit = fits[MECHANISM].frame.unit * float(reading.composition.scales.multiples.get(panel, 1))
        turn, ratio = frame_turn(fits[panel], unit), frame_stretch(fits[panel], unit)
        if turn and math.pi - abs(turn) < measures.MAX_TURN_ERROR_RAD:
            yield WholePlan(panel, REVERSED_PLAN, said("all of the {0} is reversed", panel.words), unit)
        elif turn:
            text = said("all of the {0} is turned by {1}°", panel.words, digits(math.degrees(turn), 2))
            yield WholePlan(panel, TURNED_PLAN, text, unit)
        elif ratio != 1.0:
            text = said("all of the {0} is drawn {1} times as large as on the task's sheet", panel.words,
                        digits(ratio, 2 if round(ratio, 1) != 1.0 else 3))
            yield WholePlan(panel, RESCALED_PLAN if has_given_scale(reading, panel) else "", text, unit)


def has_given_scale(reading: SheetReading, panel: str) -> bool:
    """Whether the task gives the scale of a plan other than the mechanism's, in the scene."""
    sheet = reading.task.plans.drawing.scene.sheet
    return sheet.kappa is not None and (
        panel in sheet.multiples or reading.composition.scales.multiples.get(panel, 1) == 1)


def with_whole_plans(verdicts: Iterable[Verdict], plans: Iterable[WholePlan], matching: Matching) -> Iterator[Verdict]:
    """The verdicts on a drawing with those plans that are wrong as a whole: the first of the marks that show it is
    wrong, what is right beside it follows."""
    wrong = {plan.panel: plan for plan in plans if plan.kind}
    told = {first.step.index: (plan, first) for plan in wrong.values()
            if (first := _first_mark(matching, plan.panel))}
    for verdict in verdicts:
        if verdict.step in told and verdict.state in (RIGHT, FOLLOWS):
            yield _verdict_of(verdict, *told[verdict.step], matching)
        elif verdict.state == RIGHT and matching.sheet.plan_of_step[verdict.step] in wrong:
            yield replace(verdict, state=FOLLOWS)
        else:
            yield verdict


def _first_mark(matching: Matching, panel: str) -> Match | None:
    """The first mark of a plan, after its beginning, that shows how it lies."""
    marks = [match for match in matching.matches if matching.sheet.plan_of_step[match.step.index] == panel
             and match.step.op.gives == POINT and match.place is not None and not match.step.op.free]
    begun = _beginning(matching, panel)
    return next((match for match in marks if abs(complex(*plain_value(match.expected)) - begun)
                 * matching.sheet.mm(panel) > measures.MIN_VECTOR_MM), None)


def _beginning(matching: Matching, panel: str) -> complex:
    """Beginning of a plan."""
    free: Collection[Match] = [match for match in matching.matches if match.step.op.free
                               and matching.sheet.plan_of_step[match.step.index] == panel]
    return complex(*plain_value(next(iter(free)).expected)[:2]) if free else 0j


def _verdict_of(verdict: Verdict, plan: WholePlan, match: Match, matching: Matching) -> Verdict:
    """The verdict on the mark that shows how a plan lies: it should be where the plan's own direction and scale have
    it."""
    frame, begun = matching.sheet.fits[plan.panel].frame, _beginning(matching, plan.panel)
    at = complex(*plain_value(match.expected))
    should = begun + (at - begun) * plan.unit / frame.unit
    off = abs(should - at) * abs(frame.unit)
    return replace(verdict, state=WRONG, off=off, astray=off, expected=(should.real, should.imag), ellipse=None,
                   mistake=plan.text, kind=plan.kind, guilty=verdict.step)


# ---- exchanged letters -----------------------------------------------------------------------------------------------

EXCHANGED_KIND, EXCHANGED_WORDS = "exchanged letters", phrase("letters of two marks exchanged")
Pair = tuple[int, int]


def exchanged_pairs(matching: Matching) -> Iterator[Pair]:
    """The steps whose marks bear each other's letters: one is wrong, and either is where the other should be."""
    paired = set[int]()
    for match in matching.matches:
        step, labels = match.step.index, matching.labels
        if match.state != WRONG or match.step.op.gives != POINT or labels.get(step) != match.place:
            continue
        for rival in labels:
            if paired.isdisjoint((step, rival)) and rival != step and all(
                    _bears_letters_of(matching, *pair) for pair in ((step, rival), (rival, step))):
                paired |= {step, rival}
                yield min(step, rival), max(step, rival)


def are_surely_lettered(matching: Matching, pair: Pair) -> bool:
    """Whether the letters of two marks are certainly theirs: of marks close together either may be meant by both."""
    one, other = (matching.traces[matching.labels[step]] for step in pair)
    return math.dist(one.spots[0], other.spots[0]) > 2 * measures.REACH_MM or (is_sure(one) and is_sure(other))


def _bears_letters_of(matching: Matching, index: int, other: int) -> bool:
    """Whether the mark that bears the letters of another step, on the same plan, is where one should be."""
    step, homes = matching.steps[index], matching.sheet.plan_of_step
    if matching.steps[other].op.gives != step.op.gives or homes[index] != homes[other]:
        return False
    spots = matching.sheet.spots(index, matching.traces[matching.labels[other]])
    return matching.sheet.residual(step, matching.mended[index], spots, matching.mended).fits(matching.chance)


def with_exchanged(verdicts: Iterable[Verdict], pairs: Iterable[Pair], matching: Matching) -> Iterator[Verdict]:
    """The verdicts on a drawing that was judged with letters put right: the first of each pair is wrong for all that.
    """
    first, second = dict(pairs), {other: one for one, other in pairs}
    for verdict in verdicts:
        index = verdict.step
        if index in first and verdict.trace:
            step, other = matching.steps[index], first[index]
            trace, name = matching.traces[matching.labels[other]], matching.sheet.drawing.drawn.text
            spots = matching.sheet.spots(index, trace)
            off = matching.sheet.residual(step, matching.mended[index], spots, matching.mended)
            yield replace(verdict, state=WRONG, off=off.distance, tolerance=off.tolerance(matching.chance), trace=trace,
                          kind=EXCHANGED_KIND, guilty=index,
                          mistake=said("the letters of {0} and {1} are exchanged", name(index), name(other)))
        elif index in second and verdict.state == RIGHT:
            yield replace(verdict, state=FOLLOWS)
        else:
            yield verdict
