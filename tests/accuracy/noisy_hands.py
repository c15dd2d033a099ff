"""Many noisy hands that draw one construction: how its results scatter, with everything of second order."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphplan.design.cost import readings
from graphplan.design.hand import Hand
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.methods.construction import Construction
from graphplan.methods.recorded import components

HANDS = 4000  # the scatter is then known to about one part in a hundred
SEED = 1939


@dataclass(frozen=True)
class Spread:
    """The mean of a result, its components if it is a vector, and its standard deviation."""

    mean: tuple[float, ...]
    deviation: float


@dataclass(frozen=True)
class Scatter:
    """Scatter of every result, by kind and name, and the share of the hands that could not draw one of them."""

    results: Mapping[str, Mapping[str, Spread]]
    missed: float


def sample_hands(drawing: Construction, hand: Hand, hands: int = HANDS) -> Scatter:
    """Scatter of the results of many hands."""
    normal = np.random.default_rng(SEED).normal
    results: dict[str, dict[str, Spread]] = {}
    missed = np.zeros(hands, dtype=bool)
    with np.errstate(all="ignore"):
        domain = Arrays()
        values = hand.draw(domain, lambda step: [normal(0.0, deviation, hands) for deviation in hand.slips[step]],
                           lambda step: [np.full(hands, np.nan) for _ in hand.values[step]])
        for reading, _, value in readings(drawing, values, domain):
            if not reading.marks:
                continue  # it is given, not drawn
            samples = np.broadcast_arrays(*components(value), missed)[:-1]
            missed = missed | np.isnan(samples).any(axis=0)
            mean, variance = np.nanmean(samples, axis=1), np.nanvar(samples, axis=1)
            spread = Spread(tuple(mean.tolist()), float(variance.sum() ** 0.5))
            results.setdefault(reading.kind, {})[reading.of] = spread
    return Scatter(results, float(missed.mean()))
