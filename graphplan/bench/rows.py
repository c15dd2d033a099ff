"""Data of charts: rows as tables, times within one run, medians, and the front that nothing beats."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields
from itertools import pairwise
from statistics import quantiles
from time import perf_counter
from typing import Any, TypeVar

from graphplan.accuracy.tolerances import TIMER_TICK

T = TypeVar("T")


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
    """The line along a front, below and to the left of which there is no spot, from and to the ends of the spots."""
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
