"""Measuring: runs that take turns, ratios within each round, and the table of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from statistics import median, quantiles
from types import ModuleType
from typing import Literal

from graphplan.bench.machine import MOTION, MachineMeasure
from graphplan.bench.problem import LAPACK
from graphplan.bench.rows import alternate_runs, spread
from graphplan.bench.rows import table as csv

ROUNDS = 9
LONG_ENOUGH = 0.02  # seconds: shorter runs are repeated within one measurement
PEERS = {"casadi", "jax", "kimech", "numba", "pylinkage"}

Times = dict[str, list[float]]


def peer(name: str) -> ModuleType | None:
    """A rival's module, or None where what it compares with is not installed."""
    try:
        return import_module(name)
    except ModuleNotFoundError as fault:
        if fault.name in PEERS:
            return None
        raise


def alternate(runs: Mapping[str, Callable[[], object]], rounds: int = ROUNDS) -> Times:
    """The seconds of each run in each round; they take turns, so that what else the machine does hits all alike."""
    return alternate_runs(runs, rounds, LONG_ENOUGH)


@dataclass(frozen=True)
class Target:
    """What is aimed at: to be at least so many times as fast as the rival, or to take at most so many times as long."""

    bound: Literal["at least", "at most"]
    value: float

    def ratios(self, ours: Iterable[float], rival: Iterable[float]) -> list[float]:
        """The ratio of each round, in the sense of the target."""
        pairs = zip(ours, rival, strict=True)
        return [b / a if self.bound == "at least" else a / b for a, b in pairs]

    def verdict(self, ratio: float) -> str:
        """Whether a ratio meets the target, in a word."""
        return "yes" if (ratio >= self.value if self.bound == "at least" else ratio <= self.value) else "no"

    def __str__(self) -> str:
        return f"{'≥' if self.bound == 'at least' else '≤'} {figures(self.value)}"


@dataclass(frozen=True)
class Row:
    """One line of the table."""

    figure: str
    rival: str
    target: str = ""
    ratio: str = ""
    spread: str = ""
    met: str = ""
    times: str = ""
    errors: str = ""


HEADS = Row("figure", "against", "target", "ratio", "quartiles", "met", "ours, rival", "errors of ours, rival")


@dataclass(frozen=True)
class Measured:
    """The times of all runs of a problem, round by round, and their largest errors."""

    times: Times
    errors: dict[str, float]

    def beside(self, scene: str, names: Mapping[str, str]) -> Iterator[MachineMeasure]:
        """Some runs of a scene's motion as rows of the chart of the machine, each by the name that it has there."""
        for run, name in names.items():
            if run in self.times:
                low, middle, high = spread([a / b for a, b in zip(self.times[run], self.times[LAPACK], strict=True)])
                yield MachineMeasure(scene, MOTION, "", "", name, middle, low, high, self.errors[run])


def compared(figure: str, rival: str, target: Target, times: Times, *, ours: str = "ours", over: int = 1,
             errors: Mapping[str, float] | None = None) -> Row:
    """The row of one of our runs against a rival's; times are told for each of `over` poses."""
    for name in ours, rival:
        if name not in times:
            return Row(figure, rival, str(target), f"{name}: not here")
    ratios = target.ratios(times[ours], times[rival])
    low, middle, high = quantiles(ratios, n=4)
    spent = ", ".join(duration(median(times[name]) / over) for name in (ours, rival))
    wrong = ", ".join(f"{errors[name]:.1e}" for name in (ours, rival) if name in errors) if errors else ""
    met = target.verdict(middle)
    return Row(figure, rival, str(target), figures(middle), f"{figures(low)} to {figures(high)}", met, spent, wrong)


def figures(number: float) -> str:
    """A number in three figures, or all those before the point."""
    return f"{number:,.0f}" if number >= 100 else f"{number:.3g}"


def rivals(rows: Iterable[MachineMeasure]) -> str:
    """Other programs as rows of the chart of the machine, as they were measured."""
    return csv(MachineMeasure, [*rows])


def duration(seconds: float) -> str:
    """Seconds in the unit that suits them."""
    factor, unit = next((pair for pair in ((1, "s"), (1e3, "ms"), (1e6, "us")) if seconds * pair[0] >= 1), (1e9, "ns"))
    return f"{seconds * factor:.3g} {unit}"


def table(rows: Iterable[Row]) -> str:
    """The rows as a table in Markdown."""
    cells = [list(vars(row).values()) for row in (HEADS, *rows)]
    widths = [max(len(line[k]) for line in cells) for k in range(len(cells[0]))]
    lines = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)) + " |"
             for line in cells]
    return "\n".join([lines[0], "|" + "|".join("-" * (width + 2) for width in widths) + "|", *lines[1:]]) + "\n"
