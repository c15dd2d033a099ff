"""The result table filled in by a student: vectors by components or by size and angle, single numbers, units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from graphplan.marking.tables.table_rows import TableRow, rows
from graphplan.marking.tables.written_units import example, factor
from graphplan.marking.traces import Number, Submission
from graphplan.mechanism.model import Units
from graphplan.methods.kinds import KINDS

ALSO = {"angular velocity": "omega", "angular acceleration": "alpha", "ω": "omega", "α": "alpha", "ε": "alpha"}
LARGEST = 1e60  # beyond it squares leave the range of a float


def read_results(path: Path) -> Submission:
    """The numbers of a table with the columns quantity, of and unit, and x and y, size and angle, or value."""
    return Submission(path.name, numbers=tuple([found for row in rows(path) if (found := _number(row))]))


def _number(row: TableRow) -> Number | None:
    """What a row says; None where it is not filled in."""
    x, polar, value = row.numbers("x", "y"), row.numbers("size", "angle"), row.numbers("value")
    given = [found for found in (x, polar and turned(*polar), value) if found]
    if not given:
        return None
    if len(given) > 1:
        raise row.fault("the result is given twice", "x and y, or size and angle, or value")
    try:
        return entry(row["quantity"], row["of"], given[0], row["unit"])
    except ValueError as error:
        raise row.fault(str(error), _do(row["quantity"])) from None


def entry(quantity: str, of: str, value: Sequence[float], unit: str) -> Number:
    """One result, checked.

    Fails with `ValueError` where there is no such quantity, or its unit or number of components is another.
    """
    name = " ".join(quantity.casefold().split())
    kind = ALSO.get(name, name)
    if kind not in KINDS:
        raise ValueError(f"{quantity!r} is no quantity")
    if len(value) != (1 if KINDS[kind].single else 2):
        raise ValueError(f"{kind} is {'one number' if KINDS[kind].single else 'a vector'}")
    if any(abs(part) > LARGEST for part in value):
        raise ValueError("a number is too large")
    if unit:
        factor(unit, KINDS[kind].dimension, Units())
    return Number(kind, " ".join(of.split()), tuple(value), unit)


def turned(size: float, angle: float) -> tuple[float, float]:
    """A vector by its size and its angle from +x, in degrees."""
    return size * math.cos(math.radians(angle)), size * math.sin(math.radians(angle))


def _do(quantity: str) -> str:
    """What would be right for this quantity."""
    name = quantity.casefold()
    kind = ALSO.get(name, name)
    if kind not in KINDS:
        return f"one of {', '.join(KINDS)}"
    parts = "value" if KINDS[kind].single else "x and y, or size and angle"
    return f"{parts}, in a unit such as {example(KINDS[kind].dimension)}"


def in_scene_units(number: Number, units: Units) -> tuple[float, ...]:
    """A result in the scene's units; one without a unit is in them already. Units were checked as `entry` was made."""
    if not number.unit:
        return number.value
    one = factor(number.unit, KINDS[number.kind].dimension, units)
    return tuple([one * part for part in number.value])
