"""Numbers and results as students write them: their values, how finely they are written, their quantities and units.

A number that is written 12.5 was anything from 12.45 to 12.55. What all numbers of a table have in common tells more:
where every one ends in a half or in an even digit, the scale was read so coarsely. Units are as students write them,
`mm/s²`, `m s^-1`, `kN·m`, `rpm`, and in the letters of the languages that graphplan speaks, `мм/с`; here they become
the scene's own.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from functools import cache
from typing import Any, Self

from graphplan.marking.files import measures
from graphplan.marking.files.safe import number
from graphplan.marking.traces import SUBSCRIPTS, StudentNumber
from graphplan.mechanism.model import Units
from graphplan.mechanism.units import INERTIA, KILOGRAMS, METRES, MOMENT, NEWTONS, Dimension
from graphplan.methods.kinds import CYCLE, KINDS
from graphplan.phrases import UNITS
from graphplan.words import LANGUAGES
from graphplan.words.tongue import catalogue

# ---- numbers --------------------------------------------------------------------------------------------------------


TIMES_POWER = re.compile(r"\s*[·×x*⋅]\s*10\s*\^?\s*\(?([+-]?\d{1,3})\)?$")
RAISED_NUMERALS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺−", "0123456789-+-")


class WrittenNumber(float):
    """A number that knows what one of its last digit is."""

    unit: float

    def __new__(cls, value: float, unit: float) -> Self:
        self = super().__new__(cls, value)
        self.unit = unit
        return self


def parse_number(text: str) -> WrittenNumber:
    """The number that a text says, as 12.5, 12,5, 1.25e1 or 1,25·10^1 do; of a comma that no decimal point follows
    only where three digits do not make it one between thousands.

    Fails with `ValueError` where it is none.
    """
    bare = text.strip().translate(RAISED_NUMERALS)
    if power := TIMES_POWER.search(bare):
        bare = f"{bare[:power.start()]}e{int(power[1])}"
    if re.fullmatch(r"[+-]?\d+,(\d{1,2}|\d{4,})([eE][+-]?\d+)?", bare):
        bare = bare.replace(",", ".")
    value = number(bare)
    exponent = Decimal(bare).as_tuple().exponent
    assert isinstance(exponent, int)
    return WrittenNumber(value, 10.0 ** max(min(exponent, 99), -99))


def toml_float(text: str) -> float:
    """A number of a TOML file, which knows how finely it was written."""
    value = float(text)
    return parse_number(text.replace("_", "")) if math.isfinite(value) else value


def last_digit_unit(value: float) -> float:
    """Unit of the last written digit (1 for integers)."""
    return value.unit if isinstance(value, WrittenNumber) else 1.0


def rounding_deviation(values: Sequence[float]) -> float:
    """The standard deviation with which numbers that were read alike were rounded as they were written down."""
    if not values:
        return 0.0
    unit = min(map(last_digit_unit, values))
    steps = [round(value / unit) for value in values] if len(values) >= measures.MIN_COMMON_NUMBERS and unit > 0 else []
    return unit * next((many for many in measures.COARSER_STEPS if steps and not any(step % many for step in steps)),
                       1) / measures.UNIFORM_WIDTH_SIGMAS


# ---- results --------------------------------------------------------------------------------------------------------


QUANTITY_ALIASES = {"angular velocity": "omega", "angular acceleration": "alpha", "ω": "omega", "α": "alpha",
                    "ε": "alpha"}
SYMBOL_LETTERS = {"v": "velocity", "a": "acceleration", "ω": "omega", "omega": "omega", "w": "omega", "α": "alpha",
                  "alpha": "alpha", "ε": "alpha", "epsilon": "alpha"}
LONGEST_FIRST = "|".join(sorted(SYMBOL_LETTERS, key=len, reverse=True))
SYMBOL = re.compile(rf"({LONGEST_FIRST})[\s_]*[({{]?\s*([^\W_][\w'’]*)\s*[)}}]?")
AT_TRAVEL = re.compile(r"(.+?) at ([-+]?\d+(?:[.,]\d+)?)\s*°?")  # a quantity at a travel of the drive
QUANTITIES = {**KINDS, **CYCLE}


def student_number(quantity: str, of: str, value: Sequence[float], unit: str, rounding: float = 0.0, *,
                   sized: bool = False) -> StudentNumber:
    """One result, checked; it may be written as a symbol, such as v_A or ω2; of a vector it may be the size alone.

    Fails with `ValueError` where there is no such quantity, or its unit or number of components is another.
    """
    kind, of = _name_quantity(quantity, of)
    if kind not in QUANTITIES:
        raise ValueError(f"{quantity!r} is not a quantity")
    if sized and value[0] < 0:
        raise ValueError("a size is negative")
    if not sized and len(value) != (1 if QUANTITIES[kind].single else 2):
        raise ValueError(f"{kind} is {'one number' if QUANTITIES[kind].single else 'a vector'}")
    if any(abs(component) > measures.MAX_RESULT for component in value):
        raise ValueError("a number is too large")
    if unit:
        unit_factor(unit, QUANTITIES[kind].dimension, Units())
    return StudentNumber(kind, " ".join(of.split()), tuple(value), unit, rounding)


def _name_quantity(quantity: str, of: str) -> tuple[str, str]:
    """The kind of a quantity and what it is of, whether it is written as words or as a symbol."""
    name = " ".join(quantity.translate(SUBSCRIPTS).casefold().split())
    if (at := AT_TRAVEL.fullmatch(name)) and at[1] in CYCLE:
        name, of = at[1], at[2].replace(",", ".")
    kind = SYMBOL_LETTERS.get(QUANTITY_ALIASES.get(name, name), QUANTITY_ALIASES.get(name, name))
    if kind in QUANTITIES:
        return kind, of
    symbol = SYMBOL.fullmatch(" ".join(quantity.translate(SUBSCRIPTS).split())) if not of.strip() else None
    return (SYMBOL_LETTERS[symbol[1]], symbol[2]) if symbol else (kind, of)


def polar_vector(size: float, angle: float) -> tuple[float, float]:
    """A vector by its size and its angle from +x, in degrees."""
    return size * math.cos(math.radians(angle)), size * math.sin(math.radians(angle))


def entry_hint(quantity: str, of: str = "") -> str:
    """Remedy for an entry of this quantity."""
    kind, _ = _name_quantity(quantity, of)
    if kind not in QUANTITIES:
        return f"one of {', '.join(QUANTITIES)}"
    columns = "value" if QUANTITIES[kind].single else "x and y, or size and angle"
    return f"{columns}, in a unit such as {example_unit(QUANTITIES[kind].dimension)}"


def in_scene_units(number: StudentNumber, units: Units) -> tuple[float, ...]:
    """A result in the scene's units; one without a unit is in them already. Units were checked as `entry` was made."""
    unit_size = scene_unit(number, units)
    return tuple([unit_size * component for component in number.value])


def scene_unit(number: StudentNumber, units: Units) -> float:
    """Factor from a result's unit to the scene's units."""
    return unit_factor(number.unit, QUANTITIES[number.kind].dimension, units) if number.unit else 1.0


UNITS_BY_POWERS: dict[tuple[int, int, int], Mapping[str, Any]] = {  # of length, time and force
    (1, 0, 0): {**METRES, "km": 1000, "dm": 0.1}, (-1, 2, 1): KILOGRAMS,
    (0, 0, 1): {**NEWTONS, "kp": NEWTONS["kgf"], "MN": 1e6, "daN": 10},
    (0, 1, 0): {"s": 1, "sec": 1, "ms": 1e-3, "min": 60, "h": 3600}, (0, -1, 0): {"rpm": math.pi / 30},
    (0, 0, 0): {"rad": 1, "1": 1, "deg": math.pi / 180, "°": math.pi / 180, "rev": 2 * math.pi},
}  # fmt: skip
UNIT_BASES = {name: (float(size), powers) for powers, known in UNITS_BY_POWERS.items() for name, size in known.items()}
TEN_BASE, FORCE_UNITS = "10", (*NEWTONS, "kp", "MN", "daN")
RAISED_DIGITS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")
UNIT_FACTOR = re.compile(r"(1|°|[^\W\d_]+)(?:\^?\(?([+-]?[0-9])\)?)?")
POWER_OF_TEN = re.compile(r"10\^?\(?([+-]?[0-9]{1,2})\)?")


def unit_factor(written: str, dimension: Dimension, units: Units) -> float:
    """Factor from a written unit to the scene's units of this dimension.

    Fails with `ValueError` if it is unknown, or of another dimension.
    """
    product, powers = 1.0, [0, 0, 0]
    for name, power in _unit_factors(written):
        if name == TEN_BASE:
            product *= 10.0**power
            continue
        unit_size, bases = UNIT_BASES[name]
        product *= unit_size**power
        powers = [total + power * base for total, base in zip(powers, bases, strict=True)]
    if tuple(powers) != dimension[:3]:
        raise ValueError(f"{written!r} is not a unit such as {example_unit(dimension)}")
    if dimension == INERTIA:
        return product / float(KILOGRAMS[units.mass])
    force = float(NEWTONS[units.force]) ** dimension.force  # the scene's; its moments are in forces times metres
    return product / (force if dimension == MOMENT else force * float(METRES[units.length]) ** dimension.length)


def _unit_factors(written: str) -> list[tuple[str, int]]:
    """The factors of a unit with their powers; all that stands after a slash divides."""
    if len(written) > measures.MAX_UNIT_CHARS:
        raise ValueError(f"{written[:measures.MAX_UNIT_CHARS]!r}... is not a known unit")
    factors = []
    for place, numerator_or_denominator in enumerate(written.translate(RAISED_DIGITS).split("/")):
        for piece in re.split(r"[\s·*⋅×.]+", numerator_or_denominator.strip(" ()·*⋅×.")):
            sign = -1 if place else 1
            if tens := POWER_OF_TEN.fullmatch(piece):
                factors.append((TEN_BASE, int(tens[1]) * sign))
                continue
            fits = UNIT_FACTOR.fullmatch(piece)
            names = _unit_names(fits[1]) if fits else []
            if not (fits and names):
                raise ValueError(f"{written!r} is not a known unit")
            factors += [(name, 1 * sign) for name in names[:-1]] + [(names[-1], int(fits[2] or 1) * sign)]
    return factors


def _unit_names(written: str) -> list[str]:
    """The unit, or the two of a force and a length that are written in one, as in Nm."""
    name = written if written in UNIT_BASES else _foreign_units().get(written)
    if name:
        return [name]
    for place in range(1, len(written)):
        names = [piece if piece in UNIT_BASES else _foreign_units().get(piece)
                 for piece in (written[:place], written[place:])]
        if names[0] in FORCE_UNITS and names[1] in METRES:
            return [piece for piece in names if piece]
    return []


@cache
def _foreign_units() -> dict[str, str]:
    """The units by what the catalogues call them, such as mm by мм."""
    tables = (catalogue(code)[UNITS] for code in LANGUAGES if code != "en")
    return {str(foreign): unit for table in tables for unit, foreign in table.items()}


def example_unit(dimension: Dimension) -> str:
    """Such a unit, as a student may write it."""
    return dimension.unit(Units()).replace("*", "·")
