"""What a chart is made of: panels with axes, marks and lines that know no mechanics; and its rows as a table.

Here, too, is what several charts read of their rows: medians, and the front that nothing beats.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Any, TypeVar

from graphplan.accuracy.survey.timing import spread

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
    """Spots of one look, and for each of them the corners of its spread, where it is told; the words that stand at its
    last spot, or in an area. The line of a series `through` goes over rails as over numbers, else it ends there."""

    look: Look
    spots: tuple[Spot, ...]
    spreads: tuple[tuple[Spot, Spot], ...] = ()
    label: str = ""
    through: bool = False


@dataclass(frozen=True)
class Axis:
    """A quantity: its label, whether its scale is logarithmic, whether it falls along the axis, its rails before and
    after the numbers, the outermost first, how many mm apart these are (of 0 it is free), numbers that are shown in any
    case, and readings on its other side."""

    label: str
    log: bool = True
    falling: bool = False
    before: Rails = ()
    after: Rails = ()
    pitch: float = 0.0
    shows: tuple[float, ...] = ()
    beside: tuple[tuple[float, str], ...] = ()


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


def front(places: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
    """The places that no other beats in one coordinate without losing in the other (Pareto), by the first one."""
    best: list[tuple[float, float]] = []
    for place in sorted(set(places)):
        if not best or place[1] < best[-1][1]:
            best.append(place)
    return best


def stairs(best: Sequence[tuple[float, float]], end: tuple[float, float]) -> list[tuple[float, float]]:
    """The line below and to the left of which there is nothing: along a front, from and to the ends of what there is.
    """
    if not best:
        return []
    corners = [(best[0][0], end[1]), *best, (end[0], best[-1][1])]
    return list(dict.fromkeys(spot for (a, b), (c, d) in pairwise(corners) for spot in ((a, b), (c, b), (c, d))))


def median(places: Iterable[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    """The medians of both coordinates, the lower quartiles and the upper ones."""
    (left, x, right), (low, y, high) = (spread(list(values)) for values in zip(*places, strict=True))
    return (x, y), (left, low), (right, high)


def table(kind: type, rows: Iterable[Any]) -> str:
    """Rows of one dataclass; numbers in as many digits as tell them apart, what there is not is left empty."""
    names = [field.name for field in fields(kind)]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(getattr(row, name)) for name in names] for row in rows)
    return file.getvalue()


def read(kind: type[T], text: str) -> list[T]:
    """The rows of a table of one dataclass, whose fields are text or numbers; fails with `ValueError` or `KeyError`."""
    known = {field.name: str(field.type) for field in fields(kind)}  # type: ignore[arg-type]

    def value(name: str, cell: str) -> Any:
        return cell if known[name] == "str" else float(cell) if cell else None

    return [kind(**{name: value(name, line[name]) for name in known}) for line in csv.DictReader(io.StringIO(text))]


def _cell(value: Any) -> str:
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)
