"""Sums and products as they are spoken: every number in so many digits that what is printed holds as it is printed.

A ruler reads tenths of a millimetre. What is read off is told in tenths, and comes to what these tenths come to. A
length that is worked out is right to a tenth: where tenths do not give it, hundredths or thousandths are told. Given
quantities and scales are told in full. Each number of a sum is of a kind, by a letter:

    m  mm that are multiplied        M  mm that are squared        d  mm by which it is divided
    f  a figure that multiplies      F  one that is squared        g  one that divides      a  one that is added

Before them a sign says what the product of mm is taken from or added to 1, or Σ that mm are multiplied two and two and
added; the kind of the result is the last letter: m of a length that is worked out, f of what is read off.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from graphplan.phrases import Said, Unknown, decimals, digits
from graphplan.sheet.tolerances import FIGURE_TOL

# By level: decimals of mm, decimals of a result in mm, figures of another result, figures of what is not a length.
LEVELS = ((1, 1, 4, 4), (2, 1, 4, 5), (3, 1, 4, 6), (2, 1, 4, 6), (1, 1, 4, 5))
PRINTED_LEVEL, READ_LEVEL = 3, 4  # from which on a result is what the printed numbers come to; of what is read
MAX_PRINT_ERROR = 0.499  # of the last printed digit: how far off what the printed numbers come to may be
MOST_FIGURES = 6  # all of a figure is printed where so many do
LENGTH_KINDS, FORMS = "mMd", "+-Σ"


@dataclass(frozen=True)
class Sum:
    """The numbers of a sum, the result last, with their kinds."""

    kinds: str
    numbers: tuple[float, ...]

    @cached_property
    def level(self) -> int | Unknown:
        """The first level at which it holds as printed; else the level that prints what its numbers give."""
        unknown = next((number for number in self.numbers if isinstance(number, Unknown)), None)
        if unknown is None:
            return holding(self.kinds, self.numbers)
        level: Unknown = unknown.level(self.kinds, self.numbers)
        return level

    def __getitem__(self, place: int) -> Said:
        """A number as it is printed; -1 is the result."""
        last = place % len(self.numbers) == len(self.numbers) - 1
        return self._number_text(place, self.result if last else self.numbers[place])

    def unsigned_text(self, place: int) -> Said:
        """A number as it is printed, without its sign."""
        return self._number_text(place, abs(self.numbers[place]))

    def _number_text(self, place: int, number: float) -> Said:
        kind, result = self.kinds.lstrip(FORMS)[place], place % len(self.numbers) == len(self.numbers) - 1
        if isinstance(self.level, Unknown):
            return self.level.printed_number(number, ("r" if kind in LENGTH_KINDS else "v") if result else kind)
        _, of_result, _, figures = LEVELS[self.level]
        if kind in LENGTH_KINDS:
            return decimals(number, of_result if result else decimals_of(number, kind, self.level))
        return digits(number, result_figures(number, self.level) if result else figures_of(number, figures))

    @cached_property
    def result(self) -> float:
        """The result that is printed, before it is rounded."""
        if isinstance(self.level, Unknown):
            result: float = self.level.result(self.kinds, self.numbers)
            return result
        return result_at(self.level, self.kinds, self.numbers)

    @property
    def value(self) -> float:
        """The result as printed; an unknown where it is not known yet."""
        number = self.result
        return number if isinstance(self.level, Unknown) else round_as_printed(number, self.kinds[-1], self.level,
                                                                               result=True)


def result_at(level: int, kinds: str, numbers: Sequence[float]) -> float:
    """The result at a level: exact, or evaluated from the printed numbers."""
    if level < PRINTED_LEVEL:
        return numbers[-1]
    form, number_kinds = (kinds[0], kinds[1:]) if kinds[0] in FORMS else ("", kinds)
    value = _value(form, number_kinds,
                   [round_as_printed(number, kind, level)
                    for number, kind in zip(numbers[:-1], number_kinds, strict=False)])
    return value if math.isfinite(value) else numbers[-1]


def holding(kinds: str, numbers: Sequence[float]) -> int:
    """The first level of digits at which a sum holds as printed; else the level that prints what its numbers give."""
    if kinds[-1] not in LENGTH_KINDS:
        return READ_LEVEL
    form, kinds = (kinds[0], kinds[1:]) if kinds[0] in FORMS else ("", kinds)
    for level in range(PRINTED_LEVEL):
        printed = [round_as_printed(number, kind, level) for number, kind in zip(numbers[:-1], kinds[:-1], strict=True)]
        result = round_as_printed(numbers[-1], kinds[-1], level, result=True)
        value = _value(form, kinds, printed)
        if abs(value - result) <= MAX_PRINT_ERROR * 10.0 ** -LEVELS[level][1]:
            return level
    return PRINTED_LEVEL


def _value(form: str, kinds: str, numbers: Sequence[float]) -> float:
    """Evaluate a sum with its printed numbers."""
    lengths = [(number, kind) for number, kind in zip(numbers, kinds, strict=False) if kind in LENGTH_KINDS]
    value = 1.0
    if form == "Σ":
        value = sum(lengths[k][0] * lengths[k + 1][0] for k in range(0, len(lengths), 2))
    else:
        for number, kind in lengths:
            value = _apply(value, number, {"m": "f", "M": "F", "d": "g"}[kind])
    value = {"-": 1.0 - value, "+": 1.0 + value}.get(form, value)
    for number, kind in zip(numbers, kinds, strict=False):
        value = value if kind in LENGTH_KINDS else _apply(value, number, kind)
    return value


def _apply(value: float, number: float, kind: str) -> float:
    """A value multiplied or divided by a number, or with it added."""
    if kind == "g":
        return value / number if number else math.nan
    return value + number if kind == "a" else value * number if kind == "f" else value * number * number


def round_as_printed(number: float, kind: str, level: int, *, result: bool = False) -> float:
    """A number as it is printed at a level."""
    _, of_result, _, figures = LEVELS[level]
    if kind in LENGTH_KINDS:
        return float(f"{number:.{of_result if result else decimals_of(number, kind, level)}f}")
    return float(f"{number:.{result_figures(number, level) if result else figures_of(number, figures)}g}")


def decimals_of(number: float, kind: str, level: int) -> int:
    """Decimals of a number of mm: more where a factor or divisor would be printed as zero."""
    count = LEVELS[level][0]
    keeps_figures = level == PRINTED_LEVEL or (kind == "d" and level == READ_LEVEL)
    return 1 - _power(number) if keeps_figures and 0 < abs(number) < 0.5 * 10.0**-count else count


def result_figures(number: float, level: int) -> int:
    """Significant figures of a result: never fewer than its whole digits, up to seven."""
    power = _power(number)
    return LEVELS[level][2] if power <= 2 else max(4, min(power + 1, 7))


def _power(number: float) -> int:
    """The power of ten of the first figure."""
    return int(f"{number:e}".partition("e")[2])


def figures_of(number: float, figures: int) -> int:
    """Significant figures of a number: `figures`, or more where it is exact in so many."""
    for count in range(figures, MOST_FIGURES + 1):
        if abs(float(f"{number:.{count}g}") - number) <= FIGURE_TOL * abs(number):
            return count
    return figures
