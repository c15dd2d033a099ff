"""The table [cylinders]: equal cylinders in line, each as the slider-crank of the scene, on one shaft."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from graphplan.mechanism.fields import Field, Kind, SceneNames, Table, TableRow
from graphplan.mechanism.items import SceneItem
from graphplan.mechanism.values import NUMBER

MAX_CYLINDERS = 64


@dataclass(frozen=True)
class Cylinders:
    """Equal cylinders in line: the `angles` of their cranks in degrees, counted from the crank of the scene, and their
    `places` along the shaft, in the scene's lengths."""

    angles: tuple[Fraction, ...]
    places: tuple[Fraction, ...]


def _numbers(item: SceneItem, names: SceneNames) -> tuple[Fraction, ...] | None:
    values = item.value if isinstance(item.value, list) else []
    if not 1 <= len(values) <= MAX_CYLINDERS:
        return item.fault("not a list of numbers, one for each cylinder", f"1 to {MAX_CYLINDERS}, such as [0, 180]")
    numbers = tuple(item.with_value(value).number() for value in values)
    return None if None in numbers else numbers  # type: ignore[return-value]


def _cylinders(row: TableRow) -> Any:
    angles, places = row["angles"], row["places"]
    if len(angles) != len(places):
        return row.items["places"].fault(f"{len(places)} places of {len(angles)} cranks", "a place for each crank")
    return Cylinders(angles, places)


NUMBERS = Kind("list of numbers", _numbers, {"type": "array", "items": NUMBER.schema, "minItems": 1,
                                             "maxItems": MAX_CYLINDERS})
CYLINDERS = Table("equal cylinders in line", (
    Field("angles", "the angles of their cranks in degrees, from the crank of the scene", NUMBERS,
          "an angle for each cylinder, such as angles = [0, 180, 180, 0]"),
    Field("places", "their places along the shaft, in the scene's lengths", NUMBERS,
          "a place for each cylinder, such as places = [0, 100, 200, 300]"),
), _cylinders)
