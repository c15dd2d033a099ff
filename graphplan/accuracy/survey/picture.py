"""What a chart is made of: panels with axes, marks and lines that know no mechanics; and its rows as a table."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any, TypeVar

T = TypeVar("T")
Place = float | str  # a number on an axis, or the name of one of its rails
Spot = tuple[Place, Place]
Rails = tuple[tuple[str, str], ...]  # lines beside the numbers of an axis, by name, with their labels, possibly empty


@dataclass(frozen=True)
class Look:
    """How marks and lines look: a marker of a size in mm, filled or hollow, and a line of a width in mm, dashed in mm;
    an area is a stretch of a rail, filled with the colour or hollow."""

    colour: str
    marker: str = ""
    hollow: bool = False
    size: float = 1.6
    width: float = 0.0
    dash: tuple[float, ...] = ()
    area: bool = False


@dataclass(frozen=True)
class Series:
    """Spots of one look, and for each of them the corners of its spread, where it is told."""

    look: Look
    spots: tuple[Spot, ...]
    spreads: tuple[tuple[Spot, Spot], ...] = ()


@dataclass(frozen=True)
class Axis:
    """A quantity: its label, whether its scale is logarithmic, whether it falls along the axis, the step from
    reading to reading (of 0 it is free), and its rails before and after the numbers, the outermost first."""

    label: str
    log: bool = True
    falling: bool = False
    step: float = 0.0
    before: Rails = ()
    after: Rails = ()


@dataclass(frozen=True)
class SubChart:
    """One pair of axes and what is drawn on it."""

    title: str
    x: Axis
    y: Axis
    series: tuple[Series, ...]


@dataclass(frozen=True)
class Chart:
    """Panels of one size in mm, in rows of so many at most, under a title and remarks, and what each look means."""

    title: str
    remarks: str
    panels: tuple[SubChart, ...]
    columns: int
    size: tuple[float, float]
    key: tuple[tuple[str, Look], ...]


def grouped(rows: Iterable[T], field: str) -> dict[str, list[T]]:
    """Rows by what a field of them says, in the order in which it is first said."""
    found: dict[str, list[T]] = {}
    for row in rows:
        found.setdefault(getattr(row, field), []).append(row)
    return found


def table(kind: type, rows: Iterable[Any]) -> str:
    """Rows of one dataclass; numbers in as many digits as tell them apart, what there is not is left empty."""
    names = [field.name for field in fields(kind)]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(getattr(row, name)) for name in names] for row in rows)
    return file.getvalue()


def _cell(value: Any) -> str:
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)
