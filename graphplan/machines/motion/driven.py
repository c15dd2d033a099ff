"""A machine as its first drive feels it: its inertia and the moment of its loads, as curves over the travel.

What is constructed in many poses is taken as polynomials between the breaks of the loads: from then on nothing is
constructed any more. A load over a speed keeps apart what hangs on the travel, its arm and the speed that it measures,
and its law.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals, distinct_values
from graphplan.machines.integrals import Piecewise, fit_piecewise
from graphplan.machines.reduced.reduction import Reduction
from graphplan.machines.tolerances import INERTIA_TOL, MACHINE_SHARE
from graphplan.mechanism.travel import travel_text, travel_unit

SIZE_SAMPLES = 48  # places of the cycle that show how large moments and inertias are


class SpeedLaw(NamedTuple):
    """A load over a speed: its moment is arm * law(rate * omega), arm and rate changing with the travel."""

    name: str
    arm: Piecewise
    rate: Piecewise
    law: Callable[[Reals], Reals]


@dataclass(frozen=True, eq=False)
class DrivenMachine:
    """A machine of one degree of freedom as its first drive feels it, in SI units.

    `reduced` are inertia, its slope and the moment of all loads that hang on the travel alone, positive where they
    drive; a machine that is `closed` is the same a turn later. `wheel` is the inertia of a flywheel, `closing` a
    constant moment on the drive. Travel is told in a `measure`, degrees or lengths of a drive that slides, of the SI
    size `degree`; `pace` is that of the unit of speeds, 1 rad/s or such a length/s.
    """

    reduced: tuple[Piecewise, Piecewise, Piecewise]
    closed: bool
    laws: tuple[SpeedLaw, ...] = ()
    wheel: float = 0.0
    closing: float = 0.0
    degree: float = math.radians(1.0)
    pace: float = 1.0
    measure: str = "degrees"

    def travel_text(self, travel: float) -> str:
        """A travel in words."""
        return f"{travel / self.degree:.6g} {self.measure}"

    @property
    def begin(self) -> float:
        return float(self.reduced[0].edges[0])

    @property
    def period(self) -> float:
        """The travel of a cycle, or of the whole span."""
        return float(np.ptp(self.reduced[0].edges))

    def inertia(self, travel: Reals) -> Reals:
        return self.wheel + self.curve(self.reduced[0], travel)

    def slope(self, travel: Reals) -> Reals:
        """The derivative of the inertia."""
        return self.curve(self.reduced[1], travel)

    def moment(self, travel: Reals, rate: Reals, side: int = 1) -> Reals:
        """The moment of all loads, at a break that from the right, or from the left with `side` -1."""
        return self.moments(travel, side)(rate)

    def moments(self, travel: Reals, side: int = 1) -> Callable[[Reals], Reals]:
        """The moment of all loads at these travels, as a function of the rates there."""
        fixed = self.closing + self.curve(self.reduced[2], travel, side)
        laws = [(law, self.curve(law.arm, travel, side), self.curve(law.rate, travel, side)) for law in self.laws]
        return lambda rate: sum((arm * law.law(speed * rate) for law, arm, speed in laws), fixed)

    def curve(self, curve: Piecewise, travel: Reals, side: int = 1) -> Reals:
        """A curve of the machine at any travels."""
        if self.closed:
            turns = np.floor if side > 0 else turns_below
            travel = travel - self.period * turns((travel - self.begin) / self.period)
        return curve.at(travel, side)

    def edges(self, start: float, end: float) -> list[float]:
        """The travels between which all is smooth, from one travel to another."""
        inner = self.reduced[0].edges
        first, last = (math.floor((x - self.begin) / self.period) if self.closed else 0 for x in (start, end))
        edges = distinct_values([inner + turn * self.period for turn in range(first, last + 1)])
        return [start, *(float(x) for x in edges if start < x < end), end]


def turns_below(turns: Reals) -> Reals:
    return np.ceil(turns) - 1


def driven_machine(reduction: Reduction, wheel: float = 0.0, closing: float = 0.0) -> DrivenMachine:
    """The machine of a reduction, with a flywheel and a moment on the drive; a sliding drive's travel in metres.

    Fails with `Refused` where a pose is not reached or has no velocities.
    """
    def rows(travel: Reals) -> Reals:
        reduced = reduction.reduce_at(travel)
        speeds = [curve for load in reduced.speed_loads for curve in (load.arm, load.rate)]
        return np.array([reduced.inertia, reduced.slope, reduced.moment, *speeds])

    unit, name = travel_unit(reduction.scene)
    first, last = reduction.ends
    sample = reduction.reduce_at(np.linspace(first, last, SIZE_SAMPLES + 2)[1:-1])
    sizes = np.zeros(3 + 2 * len(sample.speed_loads))
    sizes[1] = abs(sample.inertia).max()
    sizes[2] = max(sum(abs(moment).max() for moment in sample.by.values()),
                   MACHINE_SHARE * reduction.machine_size.moment)
    edges = [first, *(float(x) for x in reduction.breaks if first < x < last), last]
    curves = [replace(curve, edges=curve.edges * reduction.unit) for curve in fit_piecewise(rows, edges, sizes)]
    require_inertia(curves[0], reduction)
    arms = zip(sample.speed_loads, curves[3::2], curves[4::2], strict=True)
    laws = tuple(SpeedLaw(load.name, arm, rate, load.law) for load, arm, rate in arms)
    return DrivenMachine((curves[0], curves[1], curves[2]), reduction.closed, laws, wheel, closing,
                         reduction.unit * unit,
                         reduction.unit, name)


def require_inertia(inertia: Piecewise, reduction: Reduction) -> None:
    """Refuse a machine that has no inertia somewhere: its speed there would have no end."""
    low, high = inertia.edges[:-1, None], inertia.edges[1:, None]
    travel = (low + (high - low) * np.linspace(0, 1, 9)).ravel()
    values = inertia.at(travel)
    least = int(np.argmin(values))
    if not values[least] > INERTIA_TOL * values.max():
        place = travel_text(reduction.scene, float(travel[least] / reduction.unit))
        raise Refused("the machine", f"its reduced inertia is zero at {place}",
                      "[masses] with the inertia of the first drive's link")
