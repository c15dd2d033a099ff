"""From the matching of a drawing to what is said of it: every step and number with how far it is off, and may be.

Of a wrong step what was probably done there, or at one before it that is not to be seen itself. Numbers of a
result table are judged by what the student's own drawing says, and by the truth: what is read off a drawing is as
uncertain as its marks, and as the reading of lengths; so a number has its own tolerance, in its own unit.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphplan.accuracy.first_order import readings
from graphplan.accuracy.hand import Errors
from graphplan.errors import Undrawable
from graphplan.kernel.kinds import LINE, POINT, Movement
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Step
from graphplan.kernel.stages import Known
from graphplan.marking.judge import measures
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.mistakes import MISTAKES, Mistake, exchanges, mistakes
from graphplan.marking.judge.states import States
from graphplan.marking.judge.student_sheet import PointResidual, Residual, apart, bound, plain
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, UNSURE, WRONG, Ellipse, NumberVerdict, Verdict
from graphplan.marking.spelling import bare
from graphplan.marking.tables.results import in_scene_units, scene_unit
from graphplan.marking.tolerances import FIGURE_TOL
from graphplan.marking.traces import Number
from graphplan.mechanism.units import HEADING
from graphplan.methods.recorded import Reading
from graphplan.phrases import Said, digits, said

Key = tuple[str, str]


@dataclass(frozen=True)
class Suspect:
    """A mistake at a step that would lead to a wrong mark, and what it adds to the sum of squares."""

    mistake: Mistake
    source: Step
    rank: float = 0.0


def explained(matching: Matching, match: Match) -> Suspect | None:
    """The mistake that explains a wrong trace best, if one does."""
    step = match.step
    assert match.place is not None
    spots = matching.sheet.spots(step.index, matching.traces[match.place])
    best, least = None, math.inf
    for suspect in _closest(matching, step, np.array([complex(*plain(spot)) for spot in spots])):
        made = _carried(matching, step, matching.own, suspect, matching.sheet.domain, matching.sheet.errors)
        if made is None:
            continue
        residual = matching.sheet.residual(step, made, spots, matching.own)
        if residual.fits(matching.chance) and residual.square + suspect.rank < least:
            best, least = suspect, residual.square + suspect.rank
    return best


def _closest(matching: Matching, step: Step, spots: Any) -> list[Suspect]:
    """The mistakes that lead nearest to what was drawn."""
    floats, hand = [plain(value) for value in matching.own[:step.index]], matching.sheet.hand
    found: list[tuple[float, int, Suspect]] = []
    for suspect in _suspects(matching, step):
        made = _carried(matching, step, floats, suspect, Floats(), lambda index: [0.0] * len(hand.slips[index]))
        if made is not None and all(map(math.isfinite, made)):
            found.append((apart(step.op.gives, made, spots), len(found), suspect))
    return [suspect for _, _, suspect in sorted(found)[:measures.MISTAKES_LOOKED_AT]]


def _suspects(matching: Matching, step: Step) -> Iterator[Suspect]:
    """Every mistake at the step, and at those before that cannot be seen."""
    order = {kind: place for place, kind in enumerate(MISTAKES)}
    for far, source in enumerate(_unseen(matching, step)):
        for mistake in mistakes(matching.sheet.drawing.drawn, source, matching.sheet.plan_of_step):
            yield Suspect(mistake, source,
                          measures.STEP_BACK_SQUARES * far + measures.TABLE_ROW_SQUARES * order[mistake.kind])


def _unseen(matching: Matching, step: Step) -> list[Step]:
    """The step and those before it on whose marks it rests without their being seen, the last first."""
    found, front = {step.index}, [step.index]
    while front:
        for arg in matching.steps[front.pop()].args:
            if arg not in found and matching.matches[arg].place is None and not matching.steps[arg].op.free:
                found.add(arg)
                front.append(arg)
    return [matching.steps[index] for index in sorted(found, reverse=True)]


def _carried(matching: Matching, step: Step, values: Sequence[Any], suspect: Suspect, domain: Domain,
             errors: Errors) -> Any:
    """What the step becomes where a slip was made, and all that is unseen follows from it; None where nothing does."""
    drawn, source, hand = list(values), suspect.source.index, matching.sheet.hand
    try:
        wrong = suspect.mistake.value(domain, values)
        drawn[source:source + 1] = [hand.add_slips(suspect.source, wrong, errors(source))]
        follows = {source}
        for between in matching.steps[source + 1:step.index + 1]:
            unseen = between.index == step.index or matching.matches[between.index].place is None
            if unseen and not follows.isdisjoint(between.args):
                drawn[between.index:between.index + 1] = [hand.draw_step(between, domain, drawn, errors)]
                follows.add(between.index)
    except Undrawable:
        return None
    return drawn[step.index] if step.index in follows else None


def verdicts(matching: Matching, numbers: Iterable[NumberVerdict] = ()) -> Iterator[Verdict]:
    """What is said of every step."""
    states = States(matching, numbers)
    for match in matching.matches:
        state, confidence = states.of(match)
        found = replace(_verdict(matching, match, state), confidence=confidence)
        yield replace(found, trace=states.beside(match)) if state == UNSURE and not found.trace else found


def _verdict(matching: Matching, match: Match, state: str) -> Verdict:
    """The verdict on a trace, or on a mark that is not to be seen, but from which all that follows is: of those only a
    point is somewhere."""
    step, sheet, seen, chance = match.step, matching.sheet, match.place is not None, matching.chance
    reason = explained(matching, match) if state == WRONG and seen and not match.mistake else None
    mistake = reason.mistake if reason else match.mistake
    turned = off_locus(matching, match) if state == WRONG and seen and mistake is None else None
    guilty = reason.source.index if reason else step.index if state == WRONG else None
    if mistake and mistake.mirror and step.op.gives == POINT:  # wrong from the first of its lines on that is unseen
        guilty = next((line for line in sorted(mistake.step.args) if matching.matches[line].place is None), guilty)
    found = Verdict(step.index, state, own=plain(match.expected), mistake=mistake.told if mistake else turned,
                    kind=mistake.kind if mistake else "", guilty=guilty)
    if not seen and (not mistake or step.op.gives != POINT):
        return replace(found, off=math.inf, tolerance=math.inf, astray=math.inf) if mistake else found
    trace, true = None if match.place is None else matching.traces[match.place], sheet.drawing.values
    spots = sheet.spots(step.index, trace) if trace else [(x, y) for x, y in [plain(matching.own[step.index])]]
    residual = match.residual or sheet.residual(step, match.expected, spots, matching.own)
    return replace(found, off=residual.size, tolerance=residual.tolerance(chance), trace=trace,
                   astray=sheet.residual(step, true[step.index], spots, true).size,
                   ellipse=_ellipse(residual, step, chance) if trace else None)


def off_locus(matching: Matching, match: Match) -> Said | None:
    """Which vector has not the direction that it should, of a mark that lies on one of its two loci alone; None where
    it lies on both or none, or where no stage says whose direction a locus is."""
    step, sheet, program = match.step, matching.sheet, matching.sheet.drawing.drawn
    lines = [program.steps[arg] for arg in step.args if program.steps[arg].op.gives == LINE]
    if not step.op.crossing or len(lines) != 2 or match.place is None or match.residual is None or step.stage is None:
        return None
    spot, = sheet.spots(step.index, matching.traces[match.place])
    at = np.array([complex(*plain(spot))])
    allowed = match.residual.tolerance(matching.chance) / sheet.mm(sheet.plan_of_step[step.index])
    off = [line for line in lines if apart(LINE, plain(matching.own[line.index]), at) > allowed]
    if len(off) != 1:
        return None
    side = program.text((off[0] if off[0].op.movement is Movement.RULED else program.steps[off[0].args[0]]).index)
    vector = next((name for name, known in step.stage(()).vectors.items() if known is Known.DIRECTION
                   and name.rpartition("_")[2] in (side, side[::-1])), None)
    return said("{0} is not perpendicular to {1}", vector, side) if vector else None


def _ellipse(residual: Residual, step: Step, chance: float) -> Ellipse | None:
    """The tolerance of a point, if it has any two ways."""
    if step.op.gives != POINT or len(residual.off) < 2 or step.op.movement is Movement.BEGUN:
        return None
    variances, axes = np.linalg.eigh(residual.covariance)
    minor, major = (math.sqrt(max(variance, 0.0) * bound(2, chance)) for variance in variances)
    return Ellipse(major, minor, math.degrees(math.atan2(axes[1, 1], axes[0, 1])))


# ---- numbers -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Expected:
    """What a number should be: its parts with their errors, and the standard deviation of reading one of them."""

    parts: tuple[Any, ...]
    reading: float

    def rounded(self, rounding: float) -> Expected:
        """The same as it was written down."""
        return Expected(self.parts, math.hypot(self.reading, rounding))

    def residual(self, matching: Matching, value: Sequence[float]) -> Residual:
        """How far a value is from it, in its own unit."""
        partials = np.array([matching.sheet.domain.partials(part) for part in self.parts])
        steady = np.array(plain(self.parts))
        rounded = FIGURE_TOL * float(np.max(np.abs(steady)))
        covariance = partials @ partials.T + (self.reading**2 + rounded**2) * np.eye(len(steady))
        return (PointResidual if len(steady) == 2 else Residual)(np.array(value) - steady, covariance)


def judged(matching: Matching, numbers: Sequence[Number]) -> tuple[tuple[NumberVerdict, ...], tuple[Number, ...]]:
    """What is said of every number of a table, once of each: one that is written again is told beside the first; and
    the numbers that are not asked for."""
    if not numbers:
        return (), ()
    own, true = _expected(matching, matching.own), _expected(matching, matching.sheet.drawing.values)
    plainly = {key: plain(expected.parts) for key, expected in true.items()}
    written: dict[Key | None, list[Number]] = {}
    for number in numbers:
        written.setdefault(_asked(number, own), []).append(number)
    unasked = tuple(written.pop(None, ()))
    return tuple(replace(_judged(matching, first, key, own, plainly), again=tuple(again))
                 for key, (first, *again) in written.items() if key), unasked


def _asked(number: Number, own: Mapping[Key, Expected]) -> Key | None:
    """Which result a number is: the one of its name, or the only one of whose name it is another spelling; None where
    it is not asked for."""
    key = number.kind, number.of
    alike = [(kind, of) for kind, of in own if kind == number.kind and bare(of) == bare(number.of)]
    return key if key in own else alike[0] if len(alike) == 1 else None


def _expected(matching: Matching, values: Sequence[Any]) -> dict[Key, Expected]:
    """Every number that a drawing says."""
    drawing, found = matching.sheet.drawing, dict[Key, Expected]()
    for reading, marks, value in readings(drawing, values, matching.sheet.domain):
        parts = value if isinstance(value, tuple) else (value,)
        found[reading.kind, reading.of] = Expected(parts, _read(matching, reading, [plain(mark) for mark in marks]))
    return found


def _read(matching: Matching, reading: Reading, marks: Sequence[Any]) -> float:
    """The standard deviation of reading one part of a number off its last mark; nothing of what is given."""
    if not marks:
        return 0.0
    if reading.kind.dimension == HEADING:
        return math.radians(matching.sheet.pencil.angle)
    home = matching.sheet.plan_of_step[matching.sheet.drawing.drawn.wanted[reading.marks[-1]]]
    length = measures.LENGTH_READING_ERRORS * matching.sheet.pencil.point / matching.sheet.mm(home)
    shaken = [_difference(matching, reading, marks, shift) for shift in ((length, 0.0), (0.0, length))]
    return math.hypot(*shaken) / math.sqrt(1 if reading.kind.single else 2)


def _difference(matching: Matching, reading: Reading, marks: Sequence[Any], shift: tuple[float, float]) -> float:
    """How much a reading changes as its last mark is shifted."""
    def value(last: tuple[float, ...]) -> Any:
        found = matching.sheet.drawing.value(reading, [*marks[:-1], last], Floats())
        return complex(*found) if isinstance(found, tuple) else found

    x, y, *rest = marks[-1]
    line = rest and (x, y, rest[0] - x * shift[0] - y * shift[1])
    shifted = line or (x + shift[0], y + shift[1])
    return float(abs(value(shifted) - value(marks[-1])))


def _judged(matching: Matching, number: Number, key: Key, own: Mapping[Key, Expected],
            true: Mapping[Key, tuple[float, ...]]) -> NumberVerdict:
    """The verdict on one number: right by the student's own drawing, after a mistake if that is astray."""
    units, chance = matching.sheet.drawing.scene.units, matching.chance
    value, rounding = in_scene_units(number, units), number.rounding * scene_unit(number, units)
    own = {other: one.rounded(rounding) for other, one in own.items()}
    expected, truth = own[key], true[key]
    residual = expected.residual(matching, value)
    straight = Expected(truth, expected.reading).residual(matching, plain(expected.parts))
    astray = matching.erred and not Residual(straight.off, residual.covariance).fits(chance)
    right = residual.fits(chance)
    reason = None if right else _reason(matching, value, key, own)
    tolerance = residual.tolerance(chance) if residual.covariance.any() else 0.0  # none of a zero that is given
    return NumberVerdict(number, (FOLLOWS if astray else RIGHT) if right else WRONG, residual.size, tolerance, truth,
                         reason[1] if reason else None, reason[0] if reason else "")


def _reason(matching: Matching, value: Sequence[float], key: Key, own: Mapping[Key, Expected]
            ) -> tuple[str, Said] | None:
    """The mistake that makes a number out of the right one."""
    for kind, told, undone, which in _mistakes(value, key, own):
        if own[which].residual(matching, undone).fits(matching.chance):
            return kind, told
    return None


def _mistakes(value: Sequence[float], key: Key, own: Mapping[Key, Expected]
              ) -> Iterator[tuple[str, Said, tuple[float, ...], Key]]:
    """What a number becomes as each mistake is undone, and which number it should then be."""
    yield "reversed", said("the sign is reversed"), tuple(-part for part in value), key
    if len(value) == 2:
        x, y = value
        for turned in ((y, -x), (-y, x)):
            yield "turned the wrong way", said("the vector is a quarter turn off"), turned, key
        for told, exchanged in exchanges(x, y):
            yield "exchanged coordinates", told, exchanged, key
    for factor in measures.NUMBER_FACTORS:
        told = said("the number is {0} times as large as it should be", digits(factor, 3))
        yield "wrong scale", told, tuple(part / factor for part in value), key
    for kind, of in own:
        if kind == key[0] and of != key[1]:
            yield "another's number", said("this is the number of {0}", of), tuple(value), (kind, of)
