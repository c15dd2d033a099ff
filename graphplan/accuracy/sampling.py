"""Many hands draw the same construction: how far their results scatter, with nothing left out of second order.

Where all crossings are good the scatter is what the first order says. Where curves cross too flat for the pencil, some
hands do not get them to meet, and the others scatter less or more: the ratio to what is expected, and the part of the
hands that miss, tell how far the first order may be trusted.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphplan.accuracy.first_order import readings
from graphplan.accuracy.hand import Hand
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.methods.construction import Construction

HANDS = 4000  # the scatter is then known to about one part in a hundred
SEED = 1939


@dataclass(frozen=True)
class Spread:
    """The mean of a result, its components if it is a vector, and its standard deviation."""

    mean: tuple[float, ...]
    deviation: float


@dataclass(frozen=True)
class Scatter:
    """How every result spreads, by kind and name, and the part of the hands that could not draw one of them."""

    results: Mapping[str, Mapping[str, Spread]]
    missed: float


def sampled(drawing: Construction, hand: Hand, hands: int = HANDS, seed: int = SEED) -> Scatter:
    """How far the results of many hands scatter."""
    normal = np.random.default_rng(seed).normal
    results: dict[str, dict[str, Spread]] = {}
    missed = np.zeros(hands, dtype=bool)
    with np.errstate(all="ignore"):
        domain = Arrays()
        values = hand.draw(domain, lambda step: [normal(0.0, size, hands) for size in hand.slips[step]])
        for reading, _, value in readings(drawing, values, domain):
            if not reading.marks:
                continue  # it is given, not drawn
            parts = np.broadcast_arrays(*(value if isinstance(value, tuple) else (value,)), missed)[:-1]
            missed = missed | np.isnan(parts).any(axis=0)
            mean, variance = np.nanmean(parts, axis=1), np.nanvar(parts, axis=1)
            spread = Spread(tuple(mean.tolist()), float(variance.sum() ** 0.5))
            results.setdefault(reading.kind, {})[reading.of] = spread
    return Scatter(results, float(missed.mean()))
