"""Measurements and their charts: times within one run, rows as tables, and panels with axes that know no mechanics.

Here, too, is what several charts read of their rows: medians, and the front that nothing beats.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from statistics import quantiles
from time import perf_counter
from typing import Any, TypeVar

from graphplan.accuracy.tolerances import TIMER_TICK

T = TypeVar("T")
Place = float | str  # a number on an axis, or the name of one of its rails
Spot = tuple[Place, Place]
Rails = tuple[tuple[str, str], ...]  # lines next to the numbers of an axis, by name, with their labels, possibly empty


@dataclass(frozen=True)
class Look:
    """How marks and lines look: a marker of a size in mm, filled or hollow, and a line of a width in mm, dashed in mm;
    an area is a stretch of a rail, filled with the colour or hollow."""

    colour: str
    marker: str = ""
    hollow: bool = False
    marker_mm: float = 1.6
    width: float = 0.0
    dash: tuple[float, ...] = ()
    area: bool = False


@dataclass(frozen=True)
class ChartSeries:
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
    case, the number to which all others are relative, which has a reading in any case, and readings on its other side.
    """

    label: str
    log: bool = True
    falling: bool = False
    before: Rails = ()
    after: Rails = ()
    pitch: float = 0.0
    shows: tuple[float, ...] = ()
    reference: float | None = None
    beside: tuple[tuple[float, str], ...] = ()


@dataclass(frozen=True)
class SubChart:
    """One pair of axes and what is drawn on it."""

    title: str
    x: Axis
    y: Axis
    series: tuple[ChartSeries, ...]


@dataclass(frozen=True)
class Chart:
    """Panels of one size in mm, in rows of so many at most, under a title and remarks, and what each look means."""

    title: str
    remarks: str
    panels: tuple[SubChart, ...]
    columns: int
    panel_mm: tuple[float, float]
    key: tuple[tuple[str, Look], ...]


def group_rows(rows: Iterable[T], field: str) -> dict[str, list[T]]:
    """Rows by what a field of them says, in the order in which it is first said."""
    groups: dict[str, list[T]] = {}
    for row in rows:
        groups.setdefault(getattr(row, field), []).append(row)
    return groups


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
    (lower_x, x, right), (low, y, high) = (spread(list(values)) for values in zip(*places, strict=True))
    return (x, y), (lower_x, low), (right, high)


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
    types = {field.name: str(field.type) for field in fields(kind)}  # type: ignore[arg-type]

    def value(name: str, cell: str) -> Any:
        return cell if types[name] == "str" else float(cell) if cell else None

    return [kind(**{name: value(name, line[name]) for name in types}) for line in csv.DictReader(io.StringIO(text))]


def _cell(value: Any) -> str:
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)


# ---- times within one run: all that is compared takes turns, so that other work hits all alike -----------------------


TIMING_ROUNDS = 5
MIN_SECONDS = 2e-3  # seconds: shorter runs are repeated within one measurement

Key = TypeVar("Key")
Quartiles = tuple[float, float, float]  # the middle one is the median


def ratios(runs: Mapping[Key, tuple[Callable[[], object], int]], unit: Key,
           rounds: int = TIMING_ROUNDS, least: float = MIN_SECONDS,
           told: Callable[[int], None] = lambda done: None) -> dict[Key, Quartiles]:
    """The time of each run for one of the things that it does, over that of the run `unit` in the same round.

    Reads each run with how many things it does.
    """
    times = alternate_runs({name: run for name, (run, _) in runs.items()}, rounds, least, told)
    count = runs[unit][1]
    return {name: spread([count * a / (runs[name][1] * b) for a, b in zip(values, times[unit], strict=True)])
            for name, values in times.items()}


def alternate_runs(runs: Mapping[Key, Callable[[], object]], rounds: int,
                   least: float,
                   told: Callable[[int], None] = lambda done: None) -> dict[Key, list[float]]:
    """The seconds of each run in each round, each measured over `least` seconds at least; `told` hears of each round.

    Every run is called beforehand, to warm up and to find how often.
    """
    repeats = {name: math.ceil(least / max(_warm(run, least), TIMER_TICK)) for name, run in runs.items()}
    times: dict[Key, list[float]] = {name: [] for name in runs}
    for done in range(rounds):
        told(done)
        for name, run in runs.items():
            times[name].append(spent(run, repeats[name]))
    return times


def spread(values: list[float]) -> Quartiles:
    """The quartiles of some numbers."""
    low, middle, high = quantiles(values, n=4, method="inclusive") if len(values) > 1 else values * 3
    return low, middle, high


def spent(run: Callable[[], object], repeats: int = 1) -> float:
    """The seconds of one call, as a mean over some."""
    start = perf_counter()
    for _ in range(repeats):
        run()
    return (perf_counter() - start) / repeats


def _warm(run: Callable[[], object], least: float) -> float:
    """The seconds of a call: of the second one where the first was short."""
    first = spent(run)
    return spent(run) if first < 10 * least else first
