"""The scales of three diagrams that share an abscissa, in round values, and the distances of the poles they imply."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice, pairwise

import numpy as np
import numpy.typing as npt

from graphplan.cycle.curves import QUANTITIES, Curve, Places, Reals
from graphplan.sheet.layout.scales import round_up

LENGTH, HEIGHT = 150.0, 60.0  # the room for the axis of time and for each diagram's ordinates, in mm
NEAREST, FARTHEST = 5.0, 40.0  # a pole nearer than this, in mm, tells no slopes apart; a farther one has no room
NOTHING = 2.0**-30  # rates below this part of what the motion would need to show are rounding alone


@dataclass(frozen=True)
class DiagramScales:
    """Seconds for one mm, units of s, v and a for one mm, and the distances of the poles of v and a in mm.

    `begin` and `datum` are the time and the value of s that stand in the origin.
    """

    mu_t: Fraction
    mu: dict[str, Fraction]
    poles: dict[str, Fraction]
    begin: float
    datum: float

    def x(self, times: npt.ArrayLike) -> Reals:
        """Times on paper, in mm."""
        return (np.asarray(times, dtype=float) - self.begin) / float(self.mu_t)

    def y(self, quantity: str, values: npt.ArrayLike) -> Reals:
        """Values of s, v or a on paper, in mm."""
        return (np.asarray(values, dtype=float) - self._datum(quantity)) / float(self.mu[quantity])

    def time(self, x: npt.ArrayLike) -> Reals:
        """The times that stand at these abscissas."""
        return self.begin + np.asarray(x, dtype=float) * float(self.mu_t)

    def value(self, quantity: str, y: npt.ArrayLike) -> Reals:
        """The values of s, v or a that these ordinates show."""
        return self._datum(quantity) + np.asarray(y, dtype=float) * float(self.mu[quantity])

    def _datum(self, quantity: str) -> float:
        return self.datum if quantity == "s" else 0.0


def diagram_scales(curve: Curve, places: Places) -> DiagramScales:
    """The largest round scales for which each diagram has room, the ordinates of s counted from the first position.

    The ordinates at `places` decide. A rate may grow beyond all bounds between them, where the reach ends, or even at
    them: the pole is then as near as it may be, and the largest ordinates are off the paper.
    """
    datum = float(curve.s[curve.known][0])
    mu_t = Fraction(str(round_up(float(curve.time[-1] - curve.time[0]) / LENGTH)))
    spans = sizes(curve, places[curve.known[places]])
    mu, poles = {"s": Fraction(str(round_up(spans["s"] / HEIGHT)))}, dict[str, Fraction]()
    for quantity, rate in pairwise(QUANTITIES):
        slope = mu[quantity] / mu_t
        least = min(max(spans[rate] / HEIGHT, float(slope) / FARTHEST), float(slope) / NEAREST)
        mu[rate] = _rate_scale(least, slope)
        poles[rate] = slope / mu[rate]
    return DiagramScales(mu_t, mu, poles, float(curve.time[0]), datum)


def sizes(curve: Curve, places: Places) -> dict[str, float]:
    """How far the ordinates of s, v and a range, that of the axis included for the rates; a rate that rounding alone
    makes has no size, and nothing has where no place is known."""
    if not len(places):
        return dict.fromkeys(QUANTITIES, 0.0)
    period, found = float(curve.time[-1] - curve.time[0]), {"s": float(np.ptp(curve.s[places]))}
    magnitude = float(np.abs(curve.s[places]).max())
    for rate in QUANTITIES[1:]:
        values = curve.values(rate)[places]
        span = float(max(values.max(), 0) - min(values.min(), 0))
        found[rate] = span if span * period > NOTHING * magnitude else 0.0
        magnitude = max(span, magnitude / period)
    return found


def _rate_scale(least: float, slope: Fraction) -> Fraction:
    """The first of three round scales whose pole stands on a half of a millimetre, else the first."""
    candidates = list(islice(_round_scales(least), 3))
    return next((mu for mu in candidates if (2 * slope / mu).denominator == 1), candidates[0])


def _round_scales(least: float) -> Iterator[Fraction]:
    while True:
        scale = round_up(least)
        yield Fraction(str(scale))
        least = scale * 1.01
