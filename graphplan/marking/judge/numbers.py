"""The numbers of a result table judged: by what the student's own drawing says, and by the truth.

What is read off a drawing is as uncertain as its marks, and as the reading of lengths; so a number has its own
tolerance, in its own unit.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.accuracy.first_order import readings
from graphplan.errors import Refused
from graphplan.kernel.numbers.floats import Floats
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.student_sheet import PointResidual, Residual, plain
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, WRONG, NumberVerdict
from graphplan.marking.tables.results import in_scene_units
from graphplan.marking.traces import Number
from graphplan.methods.recorded import Reading
from graphplan.phrases import Said, said
from graphplan.sheet.layout.scales import digits

READ = 2.0  # the error of a length read on paper, beside that of a pricked point: both its ends are read
ROUNDED = 1e-3  # the part of a number that may be lost by rounding it
FACTORS = (10.0, 0.1, 100.0, 0.01, 1000.0, 0.001, 2.0, 0.5, 9.81, 1 / 9.81, math.tau, 1 / math.tau, 60.0 / math.tau,
           math.tau / 60.0, 180.0 / math.pi, math.pi / 180.0)  # powers of ten, halves, and units that are confused
Key = tuple[str, str]


@dataclass(frozen=True)
class Expected:
    """What a number should be: its parts with their errors, and the standard deviation of reading one of them."""

    parts: tuple[Any, ...]
    reading: float

    def residual(self, matching: Matching, value: Sequence[float]) -> Residual:
        """How far a value is from it, in its own unit."""
        partials = np.array([matching.sheet.domain.partials(part) for part in self.parts])
        steady = np.array(plain(self.parts))
        rounded = ROUNDED * float(np.max(np.abs(steady)))
        covariance = partials @ partials.T + (self.reading**2 + rounded**2) * np.eye(len(steady))
        return (PointResidual if len(steady) == 2 else Residual)(np.array(value) - steady, covariance)


def judged(matching: Matching, numbers: Sequence[Number]) -> Iterator[NumberVerdict]:
    """What is said of every number of a table. Fails with `Refused` where one is not asked for, or told twice."""
    own, true = _expected(matching, matching.own), _expected(matching, matching.sheet.drawing.values)
    told: set[Key] = set()
    for number in numbers:
        key = number.kind, number.of
        if key not in own:
            alike = [of for kind, of in own if kind == number.kind] or list(dict.fromkeys(kind for kind, _ in own))
            raise Refused(f"{number.kind} of {number.of}", "the scene asks for no such result",
                          f"one of {', '.join(alike)}")
        if key in told:
            raise Refused(f"{number.kind} of {number.of}", "it is told twice", "tell it once")
        told.add(key)
        yield _judged(matching, number, own, {key: plain(expected.parts) for key, expected in true.items()})


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
    home = matching.sheet.plan_of_step[matching.sheet.drawing.drawn.wanted[reading.marks[-1]]]
    length = READ * matching.sheet.pencil.point / matching.sheet.mm(home)
    shaken = [_difference(matching, reading, marks, shift) for shift in ((length, 0.0), (0.0, length))]
    return math.hypot(*shaken) / math.sqrt(1 if reading.kind.single else 2)


def _difference(matching: Matching, reading: Reading, marks: Sequence[Any], shift: tuple[float, float]) -> float:
    """How much a reading changes as its last mark is shifted."""
    def value(last: tuple[float, float]) -> Any:
        found = matching.sheet.drawing.value(reading, [*marks[:-1], last], Floats())
        return complex(*found) if isinstance(found, tuple) else found

    x, y = marks[-1]
    return float(abs(value((x + shift[0], y + shift[1])) - value((x, y))))


def _judged(matching: Matching, number: Number, own: Mapping[Key, Expected], true: Mapping[Key, tuple[float, ...]]
            ) -> NumberVerdict:
    """The verdict on one number: right by the student's own drawing, after a slip if that is astray itself."""
    value, key, chance = in_scene_units(number, matching.sheet.drawing.scene.units), (number.kind, number.of), \
        matching.rules.chance
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
        if own[which].residual(matching, undone).fits(matching.rules.chance):
            return kind, told
    return None


def _mistakes(value: Sequence[float], key: Key, own: Mapping[Key, Expected]
              ) -> Iterator[tuple[str, Said, tuple[float, ...], Key]]:
    """What a number becomes as each mistake is undone, and which number it should then be."""
    yield "reversed", said("the sign is reversed"), tuple(-part for part in value), key
    if len(value) == 2:
        x, y = value
        yield "turned the wrong way", said("the vector is a quarter turn off"), (y, -x), key
        yield "turned the wrong way", said("the vector is a quarter turn off"), (-y, x), key
        yield "exchanged coordinates", said("x and y are exchanged"), (y, x), key
        yield "exchanged coordinates", said("x has the wrong sign"), (-x, y), key
        yield "exchanged coordinates", said("y has the wrong sign"), (x, -y), key
    for factor in FACTORS:
        told = said("the number is {0} times as large as it should be", digits(factor, 3))
        yield "wrong scale", told, tuple(part / factor for part in value), key
    for kind, of in own:
        if kind == key[0] and of != key[1]:
            yield "another's number", said("this is the number of {0}", of), tuple(value), (kind, of)
