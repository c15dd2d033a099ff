"""Times within one run: everything that is compared takes turns, so that what else the machine does hits all alike."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from statistics import quantiles
from time import perf_counter
from typing import TypeVar

from graphplan.accuracy.tolerances import TIMER_TICK

ROUNDS = 5
LONG_ENOUGH = 2e-3  # seconds: shorter runs are repeated within one measurement

Key = TypeVar("Key")
Quartiles = tuple[float, float, float]  # the middle one is the median


def ratios(runs: Mapping[Key, tuple[Callable[[], object], int]], unit: Key,
           rounds: int = ROUNDS, least: float = LONG_ENOUGH,
           told: Callable[[int], None] = lambda done: None) -> dict[Key, Quartiles]:
    """The time of each run for one of the things that it does, over that of the run `unit` in the same round.

    Reads each run with how many things it does.
    """
    times = alternated({name: run for name, (run, _) in runs.items()}, rounds, least, told)
    count = runs[unit][1]
    return {name: spread([count * a / (runs[name][1] * b) for a, b in zip(values, times[unit], strict=True)])
            for name, values in times.items()}


def alternated(runs: Mapping[Key, Callable[[], object]], rounds: int = ROUNDS,
               least: float = LONG_ENOUGH, told: Callable[[int], None] = lambda done: None) -> dict[Key, list[float]]:
    """The seconds of each run in each round, each measured over `least` seconds at least; `told` hears of each round.

    Every run is called beforehand, to warm up and to find how often.
    """
    repeats = {name: math.ceil(least / max(_warm(run, least), TIMER_TICK)) for name, run in runs.items()}
    found: dict[Key, list[float]] = {name: [] for name in runs}
    for done in range(rounds):
        told(done)
        for name, run in runs.items():
            found[name].append(spent(run, repeats[name]))
    return found


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
