"""Proven decimals: enclosures as numerals of which every digit is right."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction

from graphplan.kernel.numbers.enclosures import Enclosure, Undecided

OPEN = "the bounds of a number do not close, as where a pair with friction may stand still"

SPARE = 12  # digits beyond the last that are known before it is rounded: it is off by half a unit and 10^-12 at most


def decimal(value: Enclosure, digits: int, size: Fraction) -> str:
    """A number to so many significant digits: its own, or those of `size` where it is next to nothing beside that.

    Fails with `Undecided` where the enclosure is too wide.
    """
    error, middle = value.error * 10**SPARE, value.middle
    least = _exponent(size) + 1 - digits
    place = _exponent(abs(middle)) + 1 - digits if middle else least
    if error > _ten(place):
        place = least
        if error > _ten(place) or abs(middle) > _ten(place):
            raise Undecided(OPEN)
    number = round(middle / _ten(place))
    if abs(number) == 10**digits:
        number, place = number // 10, place + 1
    return _numeral(number, place)


def upwards(bound: Fraction) -> str:
    """An upper bound to two digits, rounded up."""
    place = _exponent(bound) - 1 if bound else 0
    return _numeral(math.ceil(bound / _ten(place)), place)


def _numeral(number: int, place: int) -> str:
    """`number` times 10^`place` in digits."""
    sign, figures, _ = Decimal(number).as_tuple()
    return str(Decimal((sign, figures, place))).lower() if number else "0"


def _ten(power: int) -> Fraction:
    return Fraction(10) ** power


def _exponent(size: Fraction) -> int:
    """The power of ten of the first digit."""
    bits = size.numerator.bit_length() - size.denominator.bit_length()
    exponent = math.floor((bits - 1) * math.log10(2))
    while _ten(exponent + 1) <= size:
        exponent += 1
    return exponent
