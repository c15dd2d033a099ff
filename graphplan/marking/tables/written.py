"""Numbers as they are written: their values, and how finely, which bounds how finely they were read.

A number that is written 12.5 was anything from 12.45 to 12.55. What all numbers of a table have in common tells more:
where every one ends in a half or in an even digit, the scale was read so coarsely.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from decimal import Decimal
from typing import Self

from graphplan.marking.files.safe import number

POWER = re.compile(r"\s*[·×x*⋅]\s*10\s*\^?\s*\(?([+-]?\d{1,3})\)?$")
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺−", "0123456789-+-")
ENOUGH, COARSER = 12, (5, 2)  # so many numbers that are multiples of these, in units of the last digit, are so by plan
UNIFORM = math.sqrt(12.0)  # the width of a uniform distribution over its standard deviation


class Written(float):
    """A number that knows what one of its last digit is."""

    unit: float

    def __new__(cls, value: float, unit: float) -> Self:
        self = super().__new__(cls, value)
        self.unit = unit
        return self


def written(text: str) -> Written:
    """The number that a text says, as 12.5, 12,5, 1.25e1 or 1,25·10^1 do; of a comma that no decimal point follows
    only where three digits do not make it one between thousands.

    Fails with `ValueError` where it is none.
    """
    bare = text.strip().translate(RAISED)
    if power := POWER.search(bare):
        bare = f"{bare[:power.start()]}e{int(power[1])}"
    if re.fullmatch(r"[+-]?\d+,(\d{1,2}|\d{4,})([eE][+-]?\d+)?", bare):
        bare = bare.replace(",", ".")
    value = number(bare)
    exponent = Decimal(bare).as_tuple().exponent
    assert isinstance(exponent, int)
    return Written(value, 10.0 ** max(min(exponent, 99), -99))


def toml_float(text: str) -> float:
    """A number of a TOML file, which knows how finely it was written."""
    value = float(text)
    return written(text.replace("_", "")) if math.isfinite(value) else value


def unit_of(value: float) -> float:
    """Unit of the last written digit (1 for integers)."""
    return value.unit if isinstance(value, Written) else 1.0


def rounding(values: Sequence[float]) -> float:
    """The standard deviation with which numbers that were read alike were rounded as they were written down."""
    if not values:
        return 0.0
    unit = min(map(unit_of, values))
    steps = [round(value / unit) for value in values] if len(values) >= ENOUGH and unit > 0 else []
    return unit * next((many for many in COARSER if steps and not any(step % many for step in steps)), 1) / UNIFORM
