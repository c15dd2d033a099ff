"""The steady cycle of a machine, and Wittenbauer's energy-mass diagram: the flywheel that an unevenness asks for.

Over a cycle that closes all loads together do no work, so what is missing is found: a constant moment on the drive, or
a factor of the loads that change. The integral of the whole moment is the change of kinetic energy E(phi).

Over the cycle the points (I, E) run through a closed curve. A ray from the origin, where both are nothing, has the
slope omega^2/2. Two tangents of the slopes of the largest and the least speed meet in the origin; how far this lies
left of the axis I = 0 is the flywheel's inertia. They cut this axis, or a parallel to it, in m and n, and
I_s = mn/(delta omega^2).

Source: Ozols 1974, 13-6 (kinetic energy), 15-1 and 15-2 with (15.9) (the missing moment), (13.37) to (13.39), (15.7)
and (15.10) to (15.15); in the print of (15.15) delta is missing.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals
from graphplan.machines.integrals import Piecewise, fit_piecewise
from graphplan.machines.tolerances import CANCELLED_WORK_TOL, EVENNESS_TOL, MACHINE_SHARE, SPEED_TOL, WORK_TOL

if TYPE_CHECKING:
    from graphplan.machines.reduced.reduction import Reduction

DRIVE, LOAD = "drive", "load"
WEIGHT = "G_"  # what the names of weights begin with
SIZE_SAMPLES = 25  # travels that tell how large inertia and moments are


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

    @property
    def moment(self) -> Piecewise:
        """The moment of all loads, without the closing moment."""
        return sum_of_functions(self.loads.values(), self.inertia)

    @property
    def closed_moment(self) -> Piecewise:
        """The moment of all loads and of the drive: its integral over the cycle is zero."""
        moment_scale = sum(float(np.abs(load.terms).max()) for load in self.loads.values())
        return (self.moment + self.closing).without_rounding(moment_scale)

    @property
    def energy(self) -> Piecewise:
        """The kinetic energy beyond that at the beginning of the cycle, in J."""
        return self.closed_moment.integral()

    @property
    def ends(self) -> tuple[float, float]:
        """Start and end of the cycle."""
        return float(self.inertia.edges[0]), float(self.inertia.edges[-1])

    @property
    def span(self) -> float:
        """The travel of one cycle."""
        return self.ends[1] - self.ends[0]

    @property
    def mean_inertia(self) -> float:
        """The mean of the inertia over the travel."""
        return float(self.inertia.total_integral) / self.span

    def work(self, name: str) -> float:
        """The work of a load over the cycle, in J."""
        return float(self.loads[name].total_integral)


def steady_cycle(reduction: Reduction, speed: float, closes: str = DRIVE, changing: Collection[str] = (),
                 what: str = "flywheel") -> SteadyCycle:
    """The steady cycle of a machine at a mean speed, in rad/s.

    Reads what closes it, the `drive` or the `load`, and the names of the loads that change. Loads over a speed have the
    moment of the mean speed. Fails with `Refused` where no cycle closes, or the loads that change can't close it.
    """
    if not reduction.closed:
        low, high = (math.degrees(end) for end in reduction.ends)
        raise Refused(what, f"the cycle does not close: its first drive goes from {low:.4g}° to {high:.4g}°",
                      "a first drive that makes full turns")
    inertia, slope, loads = reduced_curves(reduction, speed)
    works = {name: float(moment.total_integral) for name, moment in loads.items()}
    closing, factor, span = 0.0, 1.0, float(inertia.edges[-1] - inertia.edges[0])
    work_scale = max(sum(map(work_to_and_fro, loads.values())), reduction.machine_size.moment * span)
    require_idle_weights(works, work_scale, what)
    if closes == LOAD:
        factor = closing_factor(loads, works, changing, work_scale, what)
        loads = {name: moment * factor if name in changing else moment for name, moment in loads.items()}
    else:
        done = sum(works.values())
        closing = -done / span if abs(done) > CANCELLED_WORK_TOL * work_scale else 0.0
    first, last = reduction.ends
    corners = np.array([at for at in reduction.breaks if first < at < last])
    return SteadyCycle(speed, inertia, slope, loads, closing, factor, tuple(changing), corners)


def reduced_curves(reduction: Reduction, speed: float) -> tuple[Piecewise, Piecewise, dict[str, Piecewise]]:
    """Inertia, its slope and the moments of the loads by name, all of the same panels."""
    first, last = reduction.ends
    inside = first + (last - first) * (np.arange(SIZE_SAMPLES) + 0.5) / SIZE_SAMPLES
    names, rows = reduced_rows(reduction, inside, speed)
    sizes = np.abs(rows).max(axis=1)
    sizes[1] = max(sizes[1], sizes[0])
    sizes[2:] = max(np.abs(rows[2:]).sum(axis=0).max(initial=0.0), MACHINE_SHARE * reduction.machine_size.moment)
    edges = [first, *(at for at in reduction.breaks if first < at < last), last]
    inertia, slope, *moments = fit_piecewise(lambda travel: reduced_rows(reduction, travel, speed)[1], edges, sizes)
    return inertia, slope, dict(zip(names, moments, strict=True))


def reduced_rows(reduction: Reduction, travel: Reals, speed: float) -> tuple[list[str], Reals]:
    """The names of the loads; and inertia, slope and the moments of the loads at a mean speed, as rows."""
    reduced = reduction.reduce_at(travel)
    loads = {**reduced.by, **{load.name: load.moment(speed) for load in reduced.speed_loads}}
    return [*loads], np.array([reduced.inertia, reduced.slope, *loads.values()])


def require_idle_weights(works: Mapping[str, float], size: float, what: str) -> None:
    """Refuse weights that do work over a cycle, beside the size of all work."""
    for name, work in works.items():
        if name.startswith(WEIGHT) and abs(work) > WORK_TOL * size:
            raise Refused(what, f"the weight {name} does the work {work:.3g} over a turn, so that the machine "
                          "does not come back to where it began", "a drive of which one turn is a whole cycle")


def work_to_and_fro(moment: Piecewise) -> float:
    """The work that a moment does, whichever way, as its panels tell."""
    return float(np.abs(moment.terms[..., 0]) @ np.diff(moment.edges))


def closing_factor(loads: Mapping[str, Piecewise], works: Mapping[str, float], changing: Collection[str], size: float,
                   what: str) -> float:
    """Return the factor of the changing loads with which the work over the cycle is zero.

    `works` are in J; `size`, the work of all loads in J, decides what counts as zero. Fails with `Refused` where the
    changing loads, or the others, do no work.
    """
    if not [name for name in loads if name in changing]:
        raise Refused(f'{what}: closes = "load"', "no load changes", 'a load with `over`, or closes = "drive"')
    done = sum(works[name] for name in changing)
    constant_work = sum(work for name, work in works.items() if name not in changing)
    if abs(done) <= WORK_TOL * size or abs(constant_work) <= WORK_TOL * size:
        which = "that change" if abs(done) <= WORK_TOL * size else "that do not change"
        raise Refused(f'{what}: closes = "load"', f"the loads {which} do no work over the cycle",
                      'closes = "drive", or other loads')
    return -constant_work / done


def sum_of_functions(functions: Collection[Piecewise], like: Piecewise) -> Piecewise:
    """The sum of functions of the same panels as another."""
    total = like * 0.0
    for function in functions:
        total += function
    return total


# ---- Wittenbauer's diagram ------------------------------------------------------------------------------------------


MAX_ORIGIN_ROUNDS = 200  # steps towards the origin's energy


class Tangency(NamedTuple):
    """A tangent of the energy-mass curve: its slope in J/(kg m^2), where it cuts the axis I = 0 in J, the travel at
    which it touches, and inertia and energy there."""

    slope: float
    cut: float
    travel: float
    inertia: float
    energy: float


@dataclass(frozen=True)
class FlywheelSpeeds:
    """A flywheel on the first drive, and the speeds with it: the `upper` and the `lower` tangent meet in the origin.

    `inertia` is beside that of the machine, in kg m^2; `origin` is the energy there, in J.
    """

    inertia: float
    upper: Tangency
    lower: Tangency
    origin: float

    @property
    def omega_max(self) -> float:
        return math.sqrt(2 * self.upper.slope)

    @property
    def omega_min(self) -> float:
        return math.sqrt(2 * self.lower.slope)

    @property
    def unevenness(self) -> float:
        """The degree of unevenness: the range of the speeds by the mean of the largest and the least."""
        return abs(self.omega_max - self.omega_min) / ((self.omega_max + self.omega_min) / 2)

    def intercept(self, at: float = 0.0) -> float:
        """Length that the tangents cut off a parallel to the axis of energies at an inertia, in J."""
        return (self.upper.cut - self.lower.cut) + (self.upper.slope - self.lower.slope) * at


def tangent(cycle: SteadyCycle, slope: float, above: bool) -> Tangency:
    """The tangent of a slope to the energy-mass curve, from above or from below."""
    over = cycle.energy + cycle.inertia * -slope
    rate = cycle.closed_moment + cycle.slope * -slope
    travel, cut = over.extremes(rate)[above]
    return Tangency(slope, cut, travel, float(cycle.inertia.at(travel)), float(cycle.energy.at(travel)))


def size_flywheel(cycle: SteadyCycle, unevenness: float, what: str = "flywheel") -> FlywheelSpeeds:
    """The flywheel with which the speed varies as little as is asked for.

    Fails with `Refused` where the machine needs none.
    """
    upper, lower = _tangents(cycle, unevenness)
    inertia = needed_inertia(cycle, unevenness)
    if not inertia:
        own_unevenness = turn_with(cycle, 0.0).unevenness
        if own_unevenness <= EVENNESS_TOL:
            raise Refused(f"{what}: unevenness {unevenness:g}", "the machine needs no flywheel: it runs evenly",
                          "masses or loads that change its speed")
        raise Refused(f"{what}: unevenness {unevenness:g}", "the machine needs no flywheel for it: its own unevenness "
                      f"is {own_unevenness:.4g}", f"an unevenness below {own_unevenness:.4g}")
    return FlywheelSpeeds(inertia, upper, lower, upper.cut - upper.slope * inertia)


def needed_inertia(cycle: SteadyCycle, unevenness: float) -> float:
    """The flywheel's inertia for this largest unevenness; 0 if the machine needs no flywheel."""
    upper, lower = _tangents(cycle, unevenness)
    inertia = (upper.cut - lower.cut) / (upper.slope - lower.slope)
    return inertia if inertia > EVENNESS_TOL * cycle.mean_inertia else 0.0


def _tangents(cycle: SteadyCycle, unevenness: float) -> tuple[Tangency, Tangency]:
    """The tangents of the largest and the least speed of an unevenness."""
    upper, lower = (tangent(cycle, ((1 + sense * unevenness / 2) * cycle.speed) ** 2 / 2, sense > 0)
                    for sense in (1, -1))
    return upper, lower


def turn_with(cycle: SteadyCycle, inertia: float, what: str = "flywheel") -> FlywheelSpeeds:
    """The speeds with a given flywheel, whose mean (omega_max + omega_min)/2 is that of the cycle.

    Fails with `Refused` where the machine would stand still before the cycle is over.
    """
    upper = lower = tangent(cycle, cycle.speed**2 / 2, above=True)
    for _ in range(MAX_ORIGIN_ROUNDS):
        before = upper.slope
        upper, lower = tangent(cycle, upper.slope, above=True), tangent(cycle, lower.slope, above=False)
        fast, slow = _speeds(cycle.speed, upper, lower, inertia)
        if not 0 < slow <= fast * (1 + EVENNESS_TOL):
            raise Refused(f"{what}: inertia {inertia:g}", f"the machine makes no full turn at a mean speed of "
                          f"{cycle.speed:g}", "a heavier flywheel, or a higher speed")
        upper, lower = upper._replace(slope=fast**2 / 2), lower._replace(slope=slow**2 / 2)
        if abs(upper.slope - before) <= SPEED_TOL * before:
            break
    upper, lower = through_touch(upper), through_touch(lower)
    return FlywheelSpeeds(inertia, upper, lower, upper.cut - upper.slope * inertia)


def _speeds(mean: float, upper: Tangency, lower: Tangency, flywheel: float) -> tuple[float, float]:
    """The speeds of this mean at two points of the cycle, their kinetic energies as far apart as the curve has them."""
    upper_inertia, two = upper.inertia + flywheel, lower.inertia + flywheel
    apart = 4 * mean**2 * two + 2 * (upper.energy - lower.energy)
    under = (4 * mean * two) ** 2 + 4 * (upper_inertia - two) * apart
    divisor = 4 * mean * two + math.sqrt(max(under, 0.0))
    fast = 2 * apart / divisor if divisor > 0 else math.inf
    return fast, 2 * mean - fast


def by_mean_energy(cycle: SteadyCycle, inertia: float, what: str = "flywheel") -> FlywheelSpeeds:
    """The speeds with a given flywheel, the middle of the energies being that of the mean inertia at the mean speed.

    So (15.7) finds the origin; the mean of the two speeds is then not quite that of the cycle.
    """
    (_, least), (_, most) = cycle.energy.extremes(cycle.closed_moment)
    origin = (least + most) / 2 - (cycle.mean_inertia + inertia) * cycle.speed**2 / 2
    if least <= origin:
        raise Refused(f"{what}: inertia {inertia:g}", "the energy at the mean speed is less than its change",
                      "a heavier flywheel, or a higher speed")
    upper, lower = (tangent_from_origin(cycle, inertia, origin, above) for above in (True, False))
    return FlywheelSpeeds(inertia, upper, lower, origin)


def tangent_from_origin(cycle: SteadyCycle, inertia: float, origin: float, above: bool) -> Tangency:
    """The tangent from the origin: the slope is drawn, and drawn again to where that tangent touched."""
    slope = cycle.speed**2 / 2
    for _ in range(MAX_ORIGIN_ROUNDS):
        touch = tangent(cycle, slope, above)
        before, slope = slope, (touch.energy - origin) / (touch.inertia + inertia)
        if abs(slope - before) <= SPEED_TOL * slope:
            break
    return through_touch(touch._replace(slope=slope))


def through_touch(one: Tangency) -> Tangency:
    """The tangent with the intersection that its slope gives."""
    return one._replace(cut=one.energy - one.slope * one.inertia)
