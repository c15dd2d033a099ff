"""Kinematic diagrams of one quantity: its curves from the plans, its rates found graphically, and how far these err."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphplan.cycle.curves import Curve, DiagramScales, Places, Reals, diagram_scales, sizes
from graphplan.cycle.diagram_program import INTEGRATED, Found, Ray, Spot, constructed
from graphplan.cycle.tolerances import ORDINATE_TOL
from graphplan.errors import Refused
from graphplan.kernel.program import Program

NARROWEST = 300  # strips of half a millimetre: no ray can be drawn in a narrower one
MOST, FEWEST = 24, 8  # strips of a division: more rays cannot be told apart, fewer show no curve


@dataclass(frozen=True)
class Error:
    """How far a graphical curve is from the plans: its largest and root mean square error, as parts of the largest
    ordinate of the plans at the same abscissas, and the order in the width of the strips; none where rounding is all or
    strips cannot be halved."""

    found: Found
    largest: float
    rms: float
    order: float | None


@dataclass(frozen=True, eq=False)
class Diagram:
    """The diagrams of a curve as they are constructed.

    `places` are the positions that divide the abscissa; `traces` are the rays of each curve found, stretch by stretch,
    in mm from the origin of the diagram that a spot stands in; `program` draws them.
    """

    curve: Curve
    scales: DiagramScales
    places: Places
    program: Program
    traces: Mapping[Found, list[list[Ray[Spot]]]]
    errors: tuple[Error, ...]

    def points(self, found: Found) -> list[list[Spot]]:
        """The points of a curve that was found, stretch by stretch, in mm; an integral's begins with its given one."""
        starts = [[rays[0].start] if found.method == INTEGRATED else [] for rays in self.traces[found]]
        return [start + part for start, part in zip(starts, _spots(found, self.traces[found]), strict=True)]


def diagram(curve: Curve, strips: int | None = None) -> Diagram:
    """The diagrams of a curve, its abscissa divided in so many strips; without it in 24, 12, or as positions allow."""
    places = _divided(curve, strips)
    scales = diagram_scales(curve, places)
    program, traces = constructed(curve, scales, places)
    misses, halved = _misses(curve, scales, traces), _halved(curve, scales, places)
    errors = tuple(_error(found, miss, halved) for found, miss in misses.items())
    return Diagram(curve, scales, places, program, traces, errors)


def _divided(curve: Curve, strips: int | None) -> Places:
    """The places that divide the abscissa: evenly if some whole number of strips does, else as nearly as can be."""
    positions = len(curve.time) - 1
    if strips is not None and not 2 <= strips <= min(positions, NARROWEST):
        raise Refused(f"{strips} strips", f"{curve.name} is known at {positions + 1} positions",
                      f"from 2 to {min(positions, NARROWEST)} strips")
    even = (count for count in (MOST, MOST // 2, *range(MOST - 1, FEWEST - 1, -1)) if positions % count == 0)
    count = strips or (positions if positions <= MOST else next(even, MOST))
    return _evenly(positions, count)


def _evenly(positions: int, count: int) -> Places:
    places: Places = np.rint(np.arange(count + 1) * (positions / count)).astype(int)
    return places


def _spots(found: Found, stretches: list[list[Ray[Spot]]]) -> list[list[Spot]]:
    """What was found with each ray: the ordinate, or the end of the chord."""
    return [[ray.end if found.method == INTEGRATED else ray.ordinate for ray in rays] for rays in stretches]


class _Misses(NamedTuple):
    """How far points are from the plans, and the largest of the plans' ordinates there, in mm."""

    by: Reals
    largest: float

    @property
    def rms(self) -> float:
        return float(np.sqrt(np.mean(self.by**2)))


def _misses(curve: Curve, scales: DiagramScales, traces: Mapping[Found, list[list[Ray[Spot]]]]) -> dict[Found, _Misses]:
    """How far each curve found is from the plans; a quantity that stands still is left out."""
    misses, spans = dict[Found, _Misses](), sizes(curve, np.flatnonzero(curve.known))
    for found, stretches in traces.items():
        if spans[found.quantity]:
            x, y = np.array([spot for part in _spots(found, stretches) for spot in part]).T
            plans = scales.y(found.quantity, curve.at(found.quantity, scales.time(x)))
            misses[found] = _Misses(y - plans, float(np.abs(plans).max()))
    return misses


def _halved(curve: Curve, scales: DiagramScales, places: Places) -> tuple[dict[Found, _Misses], float]:
    """The misses with strips half as wide where the positions allow, else twice as wide, and the ratio of the widths;
    nothing where neither divides evenly."""
    positions, count = len(curve.time) - 1, len(places) - 1
    if positions % (2 * count) == 0:
        other, ratio = 2 * count, 0.5
    elif positions % count == 0 and count % 2 == 0 and count >= FEWEST:
        other, ratio = count // 2, 2.0
    else:
        return {}, 1.0
    return _misses(curve, scales, constructed(curve, scales, _evenly(positions, other))[1]), ratio


def _error(found: Found, miss: _Misses, halved: tuple[dict[Found, _Misses], float]) -> Error:
    """The error of one curve found; its order is the power of the strips' width with which it goes."""
    (others, ratio), order = halved, None
    if found in others and min(miss.rms, others[found].rms) > ORDINATE_TOL * miss.largest:
        order = math.log(others[found].rms / miss.rms, ratio)
    return Error(found, float(np.abs(miss.by).max()) / miss.largest, miss.rms / miss.largest, order)
