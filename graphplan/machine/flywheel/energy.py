"""The steady cycle of a machine: the moment that closes it, and the energy that is stored over its travel.

Over a cycle that closes all loads together do no work, so what is missing is found: a constant moment on the drive, or
a factor of the loads that change. The integral of the whole moment is the change of kinetic energy E(phi).

Source: Ozols 1974, 13-6 (kinetic energy), 15-2 with (15.9) (the missing moment).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from graphplan.errors import Refused
from graphplan.machine.integrals import Piecewise, Reals, settled
from graphplan.machine.tolerances import CANCELLED_WORK_TOL, MACHINE_SHARE, WORK_TOL

if TYPE_CHECKING:
    from graphplan.machine.reduced.reduction import Reduction

DRIVE, LOAD = "drive", "load"
WEIGHT = "G_"  # what the names of weights begin with
SAMPLES = 25  # travels that tell how large inertia and moments are


@dataclass(frozen=True, eq=False)
class SteadyCycle:
    """One cycle of a machine at a mean speed, which returns to its beginning.

    `inertia` in kg m^2 and its `slope` by travel, the moments of the `loads` by their names, all together in `moment`;
    the `closing` moment on the drive, and the `factor` of the `changing` loads, which the moments contain. Between the
    `corners` all is smooth. Travel is in radians.
    """

    speed: float
    inertia: Piecewise
    slope: Piecewise
    loads: Mapping[str, Piecewise]
    closing: float
    factor: float
    changing: tuple[str, ...]
    corners: Reals

    @cached_property
    def moment(self) -> Piecewise:
        """The moment of all loads, without the closing moment."""
        return _sum(self.loads.values(), self.inertia)

    @cached_property
    def whole(self) -> Piecewise:
        """The moment of all loads and of the drive: its integral over the cycle is nothing."""
        size = sum(float(np.abs(load.terms).max()) for load in self.loads.values())
        return (self.moment + self.closing).beside(size)

    @cached_property
    def energy(self) -> Piecewise:
        """The kinetic energy beyond that at the beginning of the cycle, in J."""
        return self.whole.integral()

    @property
    def ends(self) -> tuple[float, float]:
        """Where the cycle begins and ends."""
        return float(self.inertia.edges[0]), float(self.inertia.edges[-1])

    @property
    def span(self) -> float:
        """The travel of one cycle."""
        return self.ends[1] - self.ends[0]

    @property
    def mean_inertia(self) -> float:
        """The mean of the inertia over the travel."""
        return float(self.inertia.whole) / self.span

    def work(self, name: str) -> float:
        """The work of a load over the cycle, in J."""
        return float(self.loads[name].whole)


def steady(reduction: Reduction, speed: float, closes: str = DRIVE, changing: Collection[str] = (),
           what: str = "flywheel") -> SteadyCycle:
    """The steady cycle of a machine at a mean speed, in rad/s.

    Reads what closes it, the `drive` or the `load`, and the names of the loads that change. Loads over a speed have the
    moment of the mean speed. Fails with `Refused` where no cycle closes, or the loads that change can't close it.
    """
    if not reduction.closed:
        low, high = (math.degrees(end) for end in reduction.ends)
        raise Refused(what, f"the cycle does not close: its first drive goes from {low:.4g}° to {high:.4g}°",
                      "a first drive that makes full turns")
    inertia, slope, loads = _reduced(reduction, speed)
    works = {name: float(moment.whole) for name, moment in loads.items()}
    closing, factor, span = 0.0, 1.0, float(inertia.edges[-1] - inertia.edges[0])
    size = max(sum(map(_to_and_fro, loads.values())), reduction.size.moment * span)
    _weights(works, size, what)
    if closes == LOAD:
        factor = _factor(loads, works, changing, size, what)
        loads = {name: moment * factor if name in changing else moment for name, moment in loads.items()}
    else:
        done = sum(works.values())
        closing = -done / span if abs(done) > CANCELLED_WORK_TOL * size else 0.0
    first, last = reduction.ends
    corners = np.array([at for at in reduction.breaks if first < at < last])
    return SteadyCycle(speed, inertia, slope, loads, closing, factor, tuple(changing), corners)


def _reduced(reduction: Reduction, speed: float) -> tuple[Piecewise, Piecewise, dict[str, Piecewise]]:
    """Inertia, its slope and the moments of the loads by name, all of the same panels."""
    first, last = reduction.ends
    inside = first + (last - first) * (np.arange(SAMPLES) + 0.5) / SAMPLES
    names, rows = reduced_rows(reduction, inside, speed)
    sizes = np.abs(rows).max(axis=1)
    sizes[1] = max(sizes[1], sizes[0])
    sizes[2:] = max(np.abs(rows[2:]).sum(axis=0).max(initial=0.0), MACHINE_SHARE * reduction.size.moment)
    edges = [first, *(at for at in reduction.breaks if first < at < last), last]
    inertia, slope, *moments = settled(lambda travel: reduced_rows(reduction, travel, speed)[1], edges, sizes)
    return inertia, slope, dict(zip(names, moments, strict=True))


def reduced_rows(reduction: Reduction, travel: Reals, speed: float) -> tuple[list[str], Reals]:
    """The names of the loads; and inertia, slope and the moments of the loads at a mean speed, as rows."""
    reduced = reduction.at(travel)
    loads = {**reduced.by, **{load.name: load.moment(speed) for load in reduced.speed_loads}}
    return [*loads], np.array([reduced.inertia, reduced.slope, *loads.values()])


def _weights(works: Mapping[str, float], size: float, what: str) -> None:
    """Refuse weights that do work over a cycle, beside the size of all work."""
    for name, work in works.items():
        if name.startswith(WEIGHT) and abs(work) > WORK_TOL * size:
            raise Refused(what, f"the weight {name} does the work {work:.3g} over a turn, so that the machine "
                          "does not come back to where it began", "a drive of which one turn is a whole cycle")


def _to_and_fro(moment: Piecewise) -> float:
    """The work that a moment does, whichever way, as its panels tell."""
    return float(np.abs(moment.terms[..., 0]) @ np.diff(moment.edges))


def _factor(loads: Mapping[str, Piecewise], works: Mapping[str, float], changing: Collection[str], size: float,
            what: str) -> float:
    """By what the loads that change are multiplied so that the cycle closes; `size` is that of all work."""
    if not [name for name in loads if name in changing]:
        raise Refused(f'{what}: closes = "load"', "no load changes", 'a load with `over`, or closes = "drive"')
    done = sum(works[name] for name in changing)
    rest = sum(work for name, work in works.items() if name not in changing)
    if abs(done) <= WORK_TOL * size or abs(rest) <= WORK_TOL * size:
        which = "that change" if abs(done) <= WORK_TOL * size else "that do not change"
        raise Refused(f'{what}: closes = "load"', f"the loads {which} do no work over the cycle",
                      'closes = "drive", or other loads')
    return -rest / done


def _sum(functions: Collection[Piecewise], like: Piecewise) -> Piecewise:
    """The sum of functions of the same panels as another."""
    found = like * 0.0
    for function in functions:
        found += function
    return found
