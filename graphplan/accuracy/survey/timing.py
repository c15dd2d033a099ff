"""Times within one run: everything that is compared takes turns, so that what else the machine does hits all alike."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from statistics import quantiles
from time import perf_counter
from typing import TypeVar

ROUNDS = 5
LONG_ENOUGH = 2e-3  # seconds: shorter runs are repeated within one measurement

Key = TypeVar("Key")
Quartiles = tuple[float, float, float]  # the middle one is the median


def ratios(runs: Mapping[Key, tuple[Callable[[], object], int]], unit: Key,
           rounds: int = ROUNDS) -> dict[Key, Quartiles]:
    """The time of each run for one of the things that it does, over that of the run `unit` in the same round.

    Reads each run with how many things it does; every run is called once beforehand, to warm up.
    """
    repeats = {name: math.ceil(LONG_ENOUGH / max(_warm(run), 1e-9)) for name, (run, _) in runs.items()}
    found: dict[Key, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        times = {name: spent(run, repeats[name]) / count for name, (run, count) in runs.items()}
        for name, time in times.items():
            found[name].append(time / times[unit])
    return {name: spread(values) for name, values in found.items()}


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


def _warm(run: Callable[[], object]) -> float:
    run()
    return spent(run)
