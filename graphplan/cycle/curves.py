"""What a diagram shows: a quantity and its rates over the drive's motion, as the plans of many positions give them.

Its three diagrams share an abscissa; their scales are round values, which imply the distances of the poles.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from graphplan.cycle.tolerances import RATE_TOL, TIME_TOL
from graphplan.errors import Refused
from graphplan.sheet.layout.scales import round_up

Reals = npt.NDArray[np.float64]
Places = npt.NDArray[np.int_]
QUANTITIES = ("s", "v", "a")


@dataclass(frozen=True, eq=False)
class KinematicCurve:
    """One quantity s with its rates v and a, at n positions of the drive; nan where a position cannot be drawn.

    `travel` is the drive's, in radians or in the lengths that `travel_unit` names; `time` grows. `closed` says that the
    last position is the first one again, a period later. `unit` is that of s: a length, or rad for a link's angle,
    which must then be unwrapped.
    """

    name: str
    unit: str
    travel: Reals
    time: Reals
    s: Reals
    v: Reals
    a: Reals
    closed: bool = False
    travel_unit: str = "rad"

    def __post_init__(self) -> None:
        shapes = {np.shape(array) for array in (self.travel, self.time, self.s, self.v, self.a)}
        if len(shapes) > 1 or len(next(iter(shapes))) != 1:
            raise Refused(self._label, f"its arrays have the shapes {sorted(shapes)}", "give five of one shape (n,)")
        if len(self.time) < 3 or not (np.diff(self.time) > 0).all():
            raise Refused(self._label, "its times do not increase from position to position", "give three or more")
        if not self.is_known.any():
            raise Refused(self._label, "no position of the range can be drawn", "choose another range")

    @property
    def _label(self) -> str:
        return f"diagram of {self.name}"

    @property
    def is_known(self) -> npt.NDArray[np.bool_]:
        """Where the position, the velocity and the acceleration are all known."""
        return np.isfinite(self.s) & np.isfinite(self.v) & np.isfinite(self.a)

    @property
    def letters(self) -> dict[str, str]:
        """What s, v and a are called: psi, omega and alpha where the quantity is an angle."""
        angle = self.unit == "rad"
        return dict(zip(QUANTITIES, ("psi", "omega", "alpha") if angle else QUANTITIES, strict=True))

    @property
    def units(self) -> dict[str, str]:
        """The units of s, v and a."""
        return dict(zip(QUANTITIES, (self.unit, f"{self.unit}/s", f"{self.unit}/s²"), strict=True))

    def values(self, quantity: str) -> Reals:
        """The values of s, v or a; nan where any of them is unknown."""
        array: Reals = {"s": self.s, "v": self.v, "a": self.a}[quantity]
        return np.where(self.is_known, array, np.nan)

    def stretches(self, places: Places) -> list[Places]:
        """The places in stretches of two or more between which no position is unknown: a gap is never bridged."""
        gaps, is_known = np.cumsum(~self.is_known), self.is_known
        known_places = places[is_known[places]]
        stretches = np.split(known_places, np.flatnonzero(np.diff(gaps[known_places])) + 1)
        return [stretch for stretch in stretches if len(stretch) > 1]

    def values_at(self, quantity: str, times: Reals) -> Reals:
        """The values of s, v or a at other times: the cubic through the four positions about each; nan in gaps.

        It errs by the fourth order of the positions' distance, where the graphical methods err by the second.
        """
        values = np.full(np.shape(times), np.nan)
        slack = TIME_TOL * (self.time[-1] - self.time[0])
        for stretch in self.stretches(np.arange(len(self.time))):
            t, y = self.time[stretch], self.values(quantity)[stretch]
            inside = (times >= t[0] - slack) & (times <= t[-1] + slack)
            values[inside] = _interpolate_cubic(t, y, times[inside])
        return values


def curve_over_travel(name: str, unit: str, travel: Reals, rate: float, s: Reals, v: Reals, a: Reals, *,
                      period: float | None = None, travel_unit: str = "rad") -> KinematicCurve:
    """The curve of positions that a drive passes at a constant rate.

    `travel` counts in the sense in which the drive moves; positions that run back are taken in reverse. Where `period`
    is given it closes: the first position, so much travel later, is added at the end. Angles need not be unwrapped.
    """
    arrays = [np.asarray(array, dtype=float) for array in (travel, s, v, a)]
    if arrays[0][0] > arrays[0][-1]:
        arrays = [array[::-1] for array in arrays]
    if period is not None:
        arrays = [np.append(array, array[0] + over) for array, over in zip(arrays, (period, 0, 0, 0), strict=True)]
    travel, s, v, a = arrays
    time = (travel - travel[0]) / abs(rate)
    return KinematicCurve(name, unit, travel, time, _unwrap(s) if unit == "rad" else s, v, a, period is not None,
                          travel_unit)


def _unwrap(angles: Reals) -> Reals:
    """Angles without jumps of a whole turn, also from one side of a gap to the other."""
    finite, unwrapped = np.isfinite(angles), angles.copy()
    unwrapped[finite] = np.unwrap(angles[finite])
    return unwrapped


def _interpolate_cubic(t: Reals, y: Reals, times: Reals) -> Reals:
    """Lagrange's interpolation through the four samples about each time, or through all where there are fewer."""
    count = min(4, len(t))
    first = np.clip(np.searchsorted(t, times, side="right") - 2, 0, len(t) - count)
    nodes = [(t[first + k], y[first + k]) for k in range(count)]
    total = np.zeros(len(times))
    for k, (node, value) in enumerate(nodes):
        other_nodes = [other_node for i, (other_node, _) in enumerate(nodes) if i != k]
        total += value * np.prod([(times - other_node) / (node - other_node) for other_node in other_nodes], axis=0)
    return total


# ---- scales ----------------------------------------------------------------------------------------------------------


AXIS_LENGTH_MM, ORDINATE_HEIGHT_MM = 150.0, 60.0  # the room for the axis of time, and for ordinates
MIN_POLE_MM, MAX_POLE_MM = 5.0, 40.0  # a pole nearer than this, in mm, tells no slopes apart; a farther one has no room


class AxisScale(NamedTuple):
    """What one mm of an axis stands for, and the value in its origin."""

    unit: float
    datum: float = 0.0

    def mm(self, value: Any) -> Any:
        """Where values stand, in mm from the origin."""
        return (np.asarray(value, dtype=float) - self.datum) / self.unit

    def value(self, mm: Any) -> Any:
        """What stands at so many mm."""
        return self.datum + np.asarray(mm, dtype=float) * self.unit

    def span(self, ends: tuple[float, float]) -> tuple[float, float]:
        """The values at both ends of a stretch of mm."""
        return self.datum + ends[0] * self.unit, self.datum + ends[1] * self.unit

    def in_units(self, size: float) -> AxisScale:
        """The same scale in units of another size."""
        return AxisScale(self.unit / size, self.datum / size)


class Frame(NamedTuple):
    """One diagram: its origin, the scales of what lies level and of what stands upright, and how far both go from the
    origin, to the left and right and down and up, in mm."""

    origin: tuple[float, float]
    x: AxisScale
    y: AxisScale
    level: tuple[float, float]
    upright: tuple[float, float]

    def position(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Where values of both axes stand, in mm of the drawing."""
        return self.origin[0] + self.x.mm(x), self.origin[1] + self.y.mm(y)


class DiagramScales(NamedTuple):
    """The scales of time, in s, and of s, v and a, and the distances of the poles of v and a in mm."""

    time: AxisScale
    ordinates: dict[str, AxisScale]
    poles: dict[str, Fraction]


def diagram_scales(curve: KinematicCurve, places: Places) -> DiagramScales:
    """The largest round scales for which each diagram has room, the ordinates of s counted from the first position.

    The ordinates at `places` decide. A rate may grow beyond all bounds between them, where the reach ends, or even at
    them: the pole is then as near as it may be, and the largest ordinates are off the paper.
    """
    datum = float(curve.s[curve.is_known][0])
    mu_t = round_scale(float(curve.time[-1] - curve.time[0]) / AXIS_LENGTH_MM)
    spans = ordinate_spans(curve, places[curve.is_known[places]])
    mu, poles = {"s": round_scale(spans["s"] / ORDINATE_HEIGHT_MM)}, dict[str, Fraction]()
    for quantity, rate in pairwise(QUANTITIES):
        slope = mu[quantity] / mu_t
        least = min(max(spans[rate] / ORDINATE_HEIGHT_MM, float(slope) / MAX_POLE_MM), float(slope) / MIN_POLE_MM)
        mu[rate] = _rate_scale(least, slope)
        poles[rate] = slope / mu[rate]
    ordinates = {quantity: AxisScale(float(unit), datum if quantity == "s" else 0.0) for quantity, unit in mu.items()}
    return DiagramScales(AxisScale(float(mu_t), float(curve.time[0])), ordinates, poles)


def ordinate_spans(curve: KinematicCurve, places: Places) -> dict[str, float]:
    """How far the ordinates of s, v and a range, that of the axis included for the rates; a rate that rounding alone
    makes has no size, and nothing has where no place is known."""
    if not len(places):
        return dict.fromkeys(QUANTITIES, 0.0)
    period, spans = float(curve.time[-1] - curve.time[0]), {"s": float(np.ptp(curve.s[places]))}
    magnitude = float(np.abs(curve.s[places]).max())
    for rate in QUANTITIES[1:]:
        values = curve.values(rate)[places]
        span = float(max(values.max(), 0) - min(values.min(), 0))
        spans[rate] = span if span * period > RATE_TOL * magnitude else 0.0
        magnitude = max(span, magnitude / period)
    return spans


def _rate_scale(least: float, slope: Fraction) -> Fraction:
    """The first of three round scales whose pole stands on a half of a millimetre, else the first."""
    candidates = [round_scale(least)]
    while len(candidates) < 3:
        candidates.append(round_scale(float(candidates[-1]) * 1.01))
    return next((mu for mu in candidates if (2 * slope / mu).denominator == 1), candidates[0])


def round_scale(least: float) -> Fraction:
    """The smallest round scale that is not below `least`."""
    return round_up(least)
