"""Numbers that were handed in, judged: those of a result table, and those of a machine over its cycle.

Numbers of a table are judged by what the student's own drawing says, and by the truth: what is read off a drawing is as
uncertain as its marks, and as the reading of lengths; so a number has its own tolerance, in its own unit. No drawing of
one pose has those of a cycle: they are judged beside what is expected of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from graphplan.design.cost import reading_errors, readings
from graphplan.design.hand import variances
from graphplan.errors import ConstructionError
from graphplan.kernel.numbers import Floats
from graphplan.marking.files.quantities import in_scene_units, scene_unit
from graphplan.marking.judge import measures
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.mistakes import exchanged_coordinates
from graphplan.marking.judge.student_sheet import PointResidual, Residual, plain_value, squares_bound
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, WRONG, Judgement, NumberVerdict
from graphplan.marking.tolerances import FIGURE_TOL
from graphplan.marking.traces import StudentNumber, bare_name
from graphplan.mechanism.model import Units
from graphplan.mechanism.units import HEADING, LENGTH, PLACE
from graphplan.methods.kinds import CYCLE
from graphplan.methods.recorded import Reading, components
from graphplan.phrases import Said, digits, said

Key = tuple[str, str]


@dataclass(frozen=True)
class ExpectedNumber:
    """Expected number: its parts with their errors, and the standard deviation of reading one of them."""

    parts: tuple[Any, ...]
    reading: float

    def with_rounding(self, rounding: float) -> ExpectedNumber:
        """The number with the rounding of its written form."""
        return ExpectedNumber(self.parts, math.hypot(self.reading, rounding))

    def residual(self, matching: Matching, value: Sequence[float]) -> Residual:
        """Residual of a value, in its own unit; a vector's size alone is compared with the vector's size."""
        partials = np.array([matching.sheet.domain.partials(component) for component in self.parts])
        steady = np.array(plain_value(self.parts))
        rounded = FIGURE_TOL * float(np.max(np.abs(steady)))
        covariance = partials @ partials.T + (self.reading**2 + rounded**2) * np.eye(len(steady))
        if len(value) < len(steady):
            size = float(np.hypot(*steady))
            along = steady / size if size else np.array([1.0, 0.0])
            return Residual(np.array(value) - size, np.array([[along @ covariance @ along]]))
        return (PointResidual if len(steady) == 2 else Residual)(np.array(value) - steady, covariance)


@dataclass(frozen=True)
class TrueResult:
    """A result as it truly is, in its parts, and how far off what is drawn, or written down, may be and is right."""

    parts: tuple[float, ...]
    allowed: float

    def gap(self, value: Sequence[float]) -> float:
        """How far a value is off; one of a vector's size alone is compared with the size."""
        if len(value) < len(self.parts):
            return abs(value[0] - math.hypot(*self.parts))
        return math.dist(value, self.parts)

    def has(self, value: Sequence[float], error: float = 0.0) -> bool:
        """Whether a value is right, read with this standard deviation."""
        return self.gap(value) <= math.hypot(self.allowed, measures.RESULT_SIGMAS * error)


def true_results(matching: Matching) -> dict[Key, TrueResult]:
    """Every result of the task, with what the pencil allows of it: three standard deviations, of a result that is no
    place and no direction at least three percent of itself."""
    drawing = matching.sheet.drawing
    errors = {(error.reading.kind, error.reading.of): error.off for error in reading_errors(drawing,
                                                                                           matching.sheet.hand)}
    results = dict[Key, TrueResult]()
    for reading, _, value in readings(drawing, drawing.values, Floats()):
        parts = tuple(map(float, components(value)))
        share = 0.0 if reading.kind.dimension in (LENGTH, PLACE, HEADING) else measures.RESULT_SHARE
        off = errors.get((reading.kind, reading.of), 0.0)
        allowed = measures.RESULT_SIGMAS * off if math.isfinite(off) else 0.0
        results[reading.kind, reading.of] = TrueResult(parts, max(allowed, share * math.hypot(*parts)))
    return results


def results_drawn_right(matching: Matching, true: Mapping[Key, TrueResult], deviating: Collection[str],
                        misnamed: Collection[int]) -> frozenset[Key]:
    """The results that the student's own marks show as they truly are, as far as those were read; none of a deviating
    plan, which shows them at another scale or in another direction, nor of misnamed marks, by their steps."""
    right, sheet = set[Key](), matching.sheet
    for reading, _, value in _own_readings(matching):
        marks = {sheet.drawing.drawn.wanted[position] for position in reading.marks}
        homes = {sheet.plan_of_step[mark] for mark in marks}
        error = math.sqrt(float(np.sum(variances(sheet.domain, value))))
        key, drawn = (reading.kind, reading.of), [float(plain_value([part])[0]) for part in components(value)]
        is_shown = homes.isdisjoint(deviating) and marks.isdisjoint(misnamed)
        if is_shown and true[key].has(drawn, error if math.isfinite(error) else 0.0):
            right.add(key)
    return frozenset(right)


def _own_readings(matching: Matching) -> Iterator[tuple[Reading, list[Any], Any]]:
    """Yield each reading of the student's own marks with these and its value, but for what they do not give, as a rate
    over a length of nothing."""
    drawing = matching.sheet.drawing
    for reading in drawing.readings:
        marks = [matching.own[drawing.drawn.wanted[position]] for position in reading.marks]
        with suppress(ZeroDivisionError, ConstructionError):
            yield reading, marks, drawing.value(reading, marks, matching.sheet.domain)


def judge_numbers(matching: Matching, numbers: Sequence[StudentNumber], true: Mapping[Key, TrueResult]
                  ) -> tuple[tuple[NumberVerdict, ...], tuple[StudentNumber, ...]]:
    """Judge every number of a table, each result once: a repeated one is reported beside the first; and list the
    numbers that are not asked for."""
    if not numbers:
        return (), ()
    own_numbers = _expected_numbers(matching)
    written: dict[Key | None, list[StudentNumber]] = {}
    for number in numbers:
        written.setdefault(_asked_key(number, own_numbers), []).append(number)
    unasked = tuple(written.pop(None, ()))
    return tuple(replace(judge_number(matching, first, key, own_numbers, true[key]), again=tuple(again))
                 for key, (first, *again) in written.items() if key), unasked


def _asked_key(number: StudentNumber, own: Mapping[Key, ExpectedNumber]) -> Key | None:
    """The result that a number is: the one of its name, or the only one of whose name it is another spelling; None if
    it is not asked for."""
    key = number.kind, number.of
    alike = [(kind, of) for kind, of in own if kind == number.kind and bare_name(of) == bare_name(number.of)]
    return key if key in own else alike[0] if len(alike) == 1 else None


def _expected_numbers(matching: Matching) -> dict[Key, ExpectedNumber]:
    """Every number that a drawing says; what it does not say, as it truly is."""
    drawing, numbers = matching.sheet.drawing, dict[Key, ExpectedNumber]()
    own_readings = {(row[0].kind, row[0].of): row for row in _own_readings(matching)}
    for true_reading in readings(drawing, drawing.values, matching.sheet.domain):
        reading, marks, value = own_readings.get((true_reading[0].kind, true_reading[0].of), true_reading)
        components = value if isinstance(value, tuple) else (value,)
        error = _reading_error(matching, reading, [plain_value(mark) for mark in marks])
        numbers[reading.kind, reading.of] = ExpectedNumber(components, error)
    return numbers


def _reading_error(matching: Matching, reading: Reading, marks: Sequence[Any]) -> float:
    """The standard deviation of reading one part of a number off its last mark; 0 for a given one."""
    if not marks:
        return 0.0
    if reading.kind.dimension == HEADING:
        return math.radians(matching.sheet.pencil.angle)
    home = matching.sheet.plan_of_step[matching.sheet.drawing.drawn.wanted[reading.marks[-1]]]
    length = measures.LENGTH_READING_ERRORS * matching.sheet.pencil.point / matching.sheet.mm(home)
    shaken = [_reading_change(matching, reading, marks, shift) for shift in ((length, 0.0), (0.0, length))]
    return math.hypot(*shaken) / math.sqrt(1 if reading.kind.single else 2)


def _reading_change(matching: Matching, reading: Reading, marks: Sequence[Any], shift: tuple[float, float]) -> float:
    """Change of a reading when its last mark is shifted."""
    def value(last: tuple[float, ...]) -> Any:
        result = matching.sheet.drawing.value(reading, [*marks[:-1], last], Floats())
        return complex(*result) if isinstance(result, tuple) else result

    x, y, *offset = marks[-1]
    line = offset and (x, y, offset[0] - x * shift[0] - y * shift[1])
    shifted = line or (x + shift[0], y + shift[1])
    return float(abs(value(shifted) - value(marks[-1])))


def judge_number(matching: Matching, number: StudentNumber, key: Key, own: Mapping[Key, ExpectedNumber],
                 true: TrueResult) -> NumberVerdict:
    """The verdict on one number: right by the truth; what the student's own drawing says follows from that."""
    units, chance = matching.sheet.drawing.scene.units, matching.chance
    value, rounding = in_scene_units(number, units), number.rounding * scene_unit(number, units)
    own = {other_key: expected_number.with_rounding(rounding) for other_key, expected_number in own.items()}
    residual = own[key].residual(matching, value)
    told = true.parts if len(value) == len(true.parts) else (math.hypot(*true.parts),)
    if true.has(value, own[key].reading):
        return NumberVerdict(number, RIGHT, true.gap(value), true.allowed, told)
    tolerance = residual.tolerance(chance) if residual.covariance.any() else 0.0  # none of a zero that is given
    if residual.fits(chance):
        return NumberVerdict(number, FOLLOWS, residual.distance, tolerance, told)
    reason = _explain_number(matching, value, key, own)
    return NumberVerdict(number, WRONG, residual.distance, tolerance, told, reason[1] if reason else None,
                         reason[0] if reason else "")


def _explain_number(matching: Matching, value: Sequence[float], key: Key, own: Mapping[Key, ExpectedNumber]
            ) -> tuple[str, Said] | None:
    """The mistake that makes a number out of the right one."""
    for kind, explanation, undone, which in _number_mistakes(value, key, own):
        if own[which].residual(matching, undone).fits(matching.chance):
            return kind, explanation
    return None


def _number_mistakes(value: Sequence[float], key: Key, own: Mapping[Key, ExpectedNumber]
              ) -> Iterator[tuple[str, Said, tuple[float, ...], Key]]:
    """Yield the number after each mistake is undone, and the result that it should then be."""
    yield "reversed", said("the sign is reversed"), tuple(-component for component in value), key
    if len(value) == 2:
        x, y = value
        for turned in ((y, -x), (-y, x)):
            yield "turned the wrong way", said("the vector is a quarter turn off"), turned, key
        for explanation, exchanged in exchanged_coordinates(x, y):
            yield "exchanged coordinates", explanation, exchanged, key
    for factor in measures.NUMBER_FACTORS:
        explanation = said("the number is {0} times as large as it should be", digits(factor, 3))
        yield "wrong scale", explanation, tuple(component / factor for component in value), key
    for kind, of in own:
        if kind == key[0] and of != key[1]:
            yield "another's number", said("this is the number of {0}", of), tuple(value), (kind, of)


# ---- over the cycle -------------------------------------------------------------------------------------------------


class ExpectedCycleNumber(NamedTuple):
    """Expected number, the standard deviation of the pencil's result, and the error of a drawing with so many plans: in
    the scene's units."""

    value: float
    deviation: float
    off: float = 0.0


Expecting = Callable[[str, str], ExpectedCycleNumber | None]  # by kind, and by travel in degrees where it has one


def with_cycle_numbers(judgement: Judgement, expecting: Expecting) -> Judgement:
    """The judgement with the verdicts on numbers over the cycle, once on each; others are not asked for."""
    units = judgement.drawing.scene.units
    verdicts, unasked = dict[tuple[str, str], NumberVerdict](), list[StudentNumber]()
    for number in judgement.unasked:
        expected = expecting(number.kind, number.of) if number.kind in CYCLE else None
        key = number.kind, number.of
        if expected is None:
            unasked.append(number)
        elif key in verdicts:
            verdicts[key] = replace(verdicts[key], again=(*verdicts[key].again, number))
        else:
            verdicts[key] = judge_cycle_number(number, expected, units)
    return replace(judgement, numbers=(*judgement.numbers, *verdicts.values()), unasked=tuple(unasked))


def judge_cycle_number(number: StudentNumber, expected: ExpectedCycleNumber, units: Units) -> NumberVerdict:
    """The verdict on one number, with the slip that makes a wrong one right."""
    value, = in_scene_units(number, units)
    deviation = math.hypot(expected.deviation, number.rounding * scene_unit(number, units))
    allowed = expected.off + math.sqrt(squares_bound(1, measures.FALSE_ALARM_CHANCE)) * deviation

    def error_of(tried: float) -> float:
        return abs(tried - expected.value)

    slips: list[tuple[str, Said, float]] = [("reversed", said("the sign is reversed"), -value)]
    slips += [("wrong scale", said("the number is {0} times as large as it should be", digits(factor, 3)),
               value / factor) for factor in measures.NUMBER_FACTORS]
    right = error_of(value) <= allowed
    kind, explanation, _ = next((slip for slip in slips if not right and error_of(slip[2]) <= allowed), ("", None, 0.0))
    return NumberVerdict(number, RIGHT if right else WRONG, error_of(value), allowed, (expected.value,), explanation,
                         kind)
