"""Numbers exactly as they are written, their square roots, directions from angles, and vectors of the plane.

The vectors are over any numbers that know + - * : floats, fractions, residues, power series, arrays.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass, replace
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from math import cos, isqrt, radians, sin
from typing import Any, NamedTuple

Number = Fraction | float
Pair = tuple[Number, Number]

X: Pair = (1, 0)
Y: Pair = (0, 1)


def plus(a: Pair, b: Pair) -> Pair:
    """The sum of two vectors."""
    return a[0] + b[0], a[1] + b[1]


def minus(a: Pair, b: Pair) -> Pair:
    """The vector from b to a."""
    return a[0] - b[0], a[1] - b[1]


def times(factor: Number, a: Pair) -> Pair:
    """The vector a, `factor` times as long."""
    return factor * a[0], factor * a[1]


def quarter_turn(a: Pair) -> Pair:
    """The vector a, turned counter-clockwise by a quarter."""
    return -a[1], a[0]


def dot(a: Pair, b: Pair) -> Number:
    """The scalar product of a and b."""
    return a[0] * b[0] + a[1] * b[1]


MAX_NUMERAL_LENGTH = 100
"""The longest numeral that is read: no drawing needs more, and exact arithmetic on more may never end."""

MAX_DECADES = 60
"""Numbers beyond 10^±60 are refused: their fourth powers would leave the range of a float."""

ROOT_BITS = 200
"""Bits of an irrational square root: nearly four times a float's, so that one rounding at the end is all there is."""


@dataclass(frozen=True)
class Unusable:
    """A numeral that is not a usable number: nan, inf, or of an absurd size."""

    text: str


def decimal(text: str) -> Fraction | Unusable:
    """The exact value of a TOML float; 0.1 is one tenth."""
    try:
        number = Decimal(text[: MAX_NUMERAL_LENGTH + 1])
    except InvalidOperation:
        return Unusable(text[:20])
    usable = len(text) <= MAX_NUMERAL_LENGTH and number.is_finite() and (number == 0
                                                                         or abs(number.adjusted()) < MAX_DECADES)
    return Fraction(number) if usable else Unusable(text[:20])


def integer(value: int) -> Fraction | Unusable:
    """The value of a TOML integer, if it is of a usable size."""
    if value.bit_length() > MAX_DECADES * 10 // 3:
        return Unusable("an integer that is too large")
    return Fraction(value)


def root(square: Fraction, bits: int = ROOT_BITS) -> tuple[Fraction, bool]:
    """The square root, and whether it is exact; an irrational one is good to so many bits."""
    product = square.numerator * square.denominator
    whole = isqrt(product)
    if whole * whole == product:
        return Fraction(whole, square.denominator), True
    return Fraction(isqrt(product << 2 * bits), square.denominator << bits), False


def square_root(square: Any) -> Any:
    """The square root: of a fraction or a float a fraction that is as good as `root` has it."""
    return root(Fraction(square))[0] if isinstance(square, Fraction | float) else square**0.5


def map_numbers(thing: Any, number: Callable[[Any], Any]) -> Any:
    """A copy in which `number` is applied to every float and fraction, at any depth."""
    if isinstance(thing, Fraction | float):
        return number(thing)
    if isinstance(thing, tuple):
        return tuple(map_numbers(member, number) for member in thing)
    if isinstance(thing, dict):
        return {name: map_numbers(member, number) for name, member in thing.items()}
    if is_dataclass(thing) and not isinstance(thing, type):
        return replace(thing, **{member.name: map_numbers(getattr(thing, member.name), number)
                                 for member in fields(thing)})
    return thing


Circular = Callable[[Fraction], tuple[Fraction, Fraction]]


def _float_heading(degrees: Fraction) -> tuple[Fraction, Fraction]:
    angle = radians(float(degrees))
    return Fraction(cos(angle)), Fraction(sin(angle))


def heading(degrees: Fraction, circular: Circular = _float_heading) -> tuple[Fraction, Fraction, bool]:
    """Cosine and sine of an angle, and whether they are exact: so at the multiples of 90 degrees."""
    quarter, remainder = divmod(degrees + 45, 90)
    c, s = circular(remainder - 45)  # within an eighth of a turn, where both functions are at their best
    c, s = ((c, s), (-s, c), (-c, -s), (s, -c))[quarter % 4]
    return c, s, remainder == 45


class Reckoning(NamedTuple):
    """Square root and direction of an angle as placements take them; each also says whether it is exact."""

    root: Callable[[Any], tuple[Any, bool]]
    heading: Callable[[Fraction], tuple[Any, Any, bool]]


FLOAT_RECKONING = Reckoning(root, heading)
"""Roots to some 60 digits, cosines and sines to a float's."""


def number_text(number: Fraction | float) -> str:
    """A number for an error line: as an integer where it is one, otherwise to six digits."""
    return str(number) if isinstance(number, Fraction) and number.denominator == 1 else f"{float(number):.6g}"


def distinct_texts(one: Fraction | float, other: Fraction | float) -> tuple[str, str]:
    """Two different numbers for an error line, to as many digits as show the difference."""
    for digits in (6, 9, 12, 15, 17):
        texts = f"{float(one):.{digits}g}", f"{float(other):.{digits}g}"
        if texts[0] != texts[1]:
            break
    return texts


def exactly(point: Pair) -> tuple[Fraction, Fraction]:
    """A point's coordinates as fractions: a float is taken as the binary fraction that it is."""
    return Fraction(point[0]), Fraction(point[1])


def is_exact(*points: Pair) -> bool:
    """Whether all these are given by fractions."""
    return all(isinstance(x, Fraction) for point in points for x in point)
