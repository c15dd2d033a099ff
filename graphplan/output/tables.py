"""Results over many poses as columns, and comma-separated text of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import printed_travels
from graphplan.mechanism.units import LENGTH
from graphplan.methods.results import axes, facts
from graphplan.phrases import Said

ROWS = 4096  # written in one call

Results = Mapping[str, Mapping[str, Any]]
Columns = Sequence[tuple[str, Any]]  # headings with arrays of shape (n,)


def text(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str]) -> str:
    """Comma-separated text: a heading, then one line for each pose; what there is not is left empty, and says why.

    Numbers have as many digits as tell them apart.
    """
    columns = [*pose_columns(scene, travel, points, results)]
    return csv_head(columns) + csv_rows(columns, faults)


def csv_head(columns: Columns) -> str:
    """The heading of comma-separated text."""
    return ",".join(map(_csv_cell, ("pose", *(heading for heading, _ in columns), "fault"))) + "\n"


def csv_rows(columns: Columns, faults: Mapping[int, str], first: int = 0) -> str:
    """A line for each pose, from the first one's place on, by which faults are told.

    Python writes a list of lists in one call, much faster than numbers one by one.
    """
    lines = list[str]()
    for start in range(0, len(columns[0][1]), ROWS):
        rows = np.stack([column[start : start + ROWS] for _, column in columns], axis=1) + 0.0  # a zero has no sign
        numbers = str(rows.tolist())[2:-2].replace(", ", ",").replace("nan", "").split("],[")
        lines += [f"{pose},{row},{_csv_cell(faults.get(pose, ''))}" for pose, row in enumerate(numbers, first + start)]
    return "\n".join([*lines, ""])


def csv_text(headings: Iterable[str], rows: Iterable[Iterable[str | float]]) -> str:
    """Comma-separated text of headings and rows; numbers have as many digits as tell them apart, nan is left empty."""
    return "\n".join([*(",".join(map(_csv_cell, row)) for row in (headings, *rows)), ""])


class TableColumn(NamedTuple):
    """A column of numbers: its name in files, its letter and its unit on sheets, and its values."""

    name: str
    letter: Said | str
    unit: str
    values: Any


def column_csv(columns: Iterable[TableColumn]) -> str:
    """Comma-separated text of columns, their units in plain signs."""
    names, _, units, values = zip(*columns, strict=True)
    heads = (f"{name} [{plain_unit(measure)}]" if measure else name for name, measure in zip(names, units, strict=True))
    return csv_text(heads, np.stack(values, 1).tolist())


def plain_unit(words: str) -> str:
    """A unit as files have it: kg*m^2 for kg m²."""
    return words.replace(" ", "*").replace("²", "^2").replace("°", "deg")


def _csv_cell(cell: str | float) -> str:
    """A cell as comma-separated text has it."""
    if isinstance(cell, float):
        return "" if math.isnan(cell) else repr(cell + 0.0)  # a zero has no sign
    return '"' + cell.replace('"', '""') + '"' if any(mark in cell for mark in ',"\n\r') else cell


def printed_travel(scene: Scene, travel: Any) -> tuple[str, Any]:
    """The drive's travel, and its unit."""
    return LENGTH.unit(scene.units) if scene.drives[0].slides else "deg", printed_travels(scene, travel)


def pose_columns(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results) -> Iterator[tuple[str, Any]]:
    """Each column with its heading, such as `A.vx [mm/s]`."""
    long, (unit, gone) = LENGTH.unit(scene.units), printed_travel(scene, travel)
    yield f"travel [{unit}]", gone
    for name, z in points.items():
        yield from ((f"{name}.{axis} [{long}]", coordinate) for axis, coordinate in axes(z).items())
    for fact in facts(results):
        yield from ((f"{heading} [{fact.unit(scene.units)}]", column) for heading, column in fact.columns.items())
