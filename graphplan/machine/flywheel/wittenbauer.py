"""Wittenbauer's energy-mass diagram: the flywheel that an unevenness asks for, or the unevenness with a flywheel.

Over the cycle the points (I, E) run through a closed curve. A ray from the origin, where both are nothing, has the
slope omega^2/2. Two tangents of the slopes of the largest and the least speed meet in the origin; how far this lies
left of the axis I = 0 is the flywheel's inertia. They cut this axis, or a parallel to it, in m and n, and
I_s = mn/(delta omega^2).

Source: Ozols 1974, 13-6, 15-1 and 15-2 with (13.37) to (13.39), (15.7) and (15.10) to (15.15); in the print of (15.15)
delta is missing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from graphplan.errors import Refused
from graphplan.machine.flywheel.energy import SteadyCycle
from graphplan.machine.tolerances import EVENNESS_TOL, SPEED_TOL

MOST = 200  # steps towards the origin's energy


class Touch(NamedTuple):
    """A tangent of the energy-mass curve: its slope in J/(kg m^2), where it cuts the axis I = 0 in J, the travel at
    which it touches, and inertia and energy there."""

    slope: float
    cut: float
    travel: float
    inertia: float
    energy: float


@dataclass(frozen=True)
class Flywheel:
    """A flywheel on the first drive, and the speeds with it: the `upper` and the `lower` tangent meet in the origin.

    `inertia` is beside that of the machine, in kg m^2; `origin` is the energy there, in J.
    """

    inertia: float
    upper: Touch
    lower: Touch
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
        """What the tangents cut off of a parallel to the axis of energies at an inertia, in J."""
        return (self.upper.cut - self.lower.cut) + (self.upper.slope - self.lower.slope) * at


def touch(cycle: SteadyCycle, slope: float, above: bool) -> Touch:
    """The tangent of a slope to the energy-mass curve, from above or from below."""
    over = cycle.energy + cycle.inertia * -slope
    rate = cycle.whole + cycle.slope * -slope
    travel, cut = over.extremes(rate)[above]
    return Touch(slope, cut, travel, float(cycle.inertia.at(travel)), float(cycle.energy.at(travel)))


def sized(cycle: SteadyCycle, unevenness: float, what: str = "flywheel") -> Flywheel:
    """The flywheel with which the speed varies as little as is asked for.

    Fails with `Refused` where the machine needs none.
    """
    upper, lower = _tangents(cycle, unevenness)
    inertia = needed(cycle, unevenness)
    if not inertia:
        own = turning(cycle, 0.0).unevenness
        if own <= EVENNESS_TOL:
            raise Refused(f"{what}: unevenness {unevenness:g}", "the machine needs no flywheel: it runs evenly",
                          "masses or loads that change its speed")
        raise Refused(f"{what}: unevenness {unevenness:g}", "the machine needs no flywheel for it: its own unevenness "
                      f"is {own:.4g}", f"an unevenness below {own:.4g}")
    return Flywheel(inertia, upper, lower, upper.cut - upper.slope * inertia)


def needed(cycle: SteadyCycle, unevenness: float) -> float:
    """The flywheel's inertia with which the speed varies so little at most; 0 where the machine needs none."""
    upper, lower = _tangents(cycle, unevenness)
    inertia = (upper.cut - lower.cut) / (upper.slope - lower.slope)
    return inertia if inertia > EVENNESS_TOL * cycle.mean_inertia else 0.0


def _tangents(cycle: SteadyCycle, unevenness: float) -> tuple[Touch, Touch]:
    """The tangents of the largest and the least speed of an unevenness."""
    upper, lower = (touch(cycle, ((1 + way * unevenness / 2) * cycle.speed) ** 2 / 2, way > 0) for way in (1, -1))
    return upper, lower


def turning(cycle: SteadyCycle, inertia: float, what: str = "flywheel") -> Flywheel:
    """The speeds with a given flywheel, whose mean (omega_max + omega_min)/2 is that of the cycle.

    Fails with `Refused` where the machine would stand still before the cycle is over.
    """
    upper = lower = touch(cycle, cycle.speed**2 / 2, above=True)
    for _ in range(MOST):
        before = upper.slope
        upper, lower = touch(cycle, upper.slope, above=True), touch(cycle, lower.slope, above=False)
        fast, slow = _speeds(cycle.speed, upper, lower, inertia)
        if not 0 < slow <= fast * (1 + EVENNESS_TOL):
            raise Refused(f"{what}: inertia {inertia:g}", f"the machine makes no full turn at a mean speed of "
                          f"{cycle.speed:g}", "a heavier flywheel, or a higher speed")
        upper, lower = upper._replace(slope=fast**2 / 2), lower._replace(slope=slow**2 / 2)
        if abs(upper.slope - before) <= SPEED_TOL * before:
            break
    upper, lower = _through(upper), _through(lower)
    return Flywheel(inertia, upper, lower, upper.cut - upper.slope * inertia)


def _speeds(mean: float, upper: Touch, lower: Touch, flywheel: float) -> tuple[float, float]:
    """The speeds of this mean at two points of the cycle, their kinetic energies as far apart as the curve has them."""
    one, two = upper.inertia + flywheel, lower.inertia + flywheel
    apart = 4 * mean**2 * two + 2 * (upper.energy - lower.energy)
    under = (4 * mean * two) ** 2 + 4 * (one - two) * apart
    divisor = 4 * mean * two + math.sqrt(max(under, 0.0))
    fast = 2 * apart / divisor if divisor > 0 else math.inf
    return fast, 2 * mean - fast


def by_mean_energy(cycle: SteadyCycle, inertia: float, what: str = "flywheel") -> Flywheel:
    """The speeds with a given flywheel, the middle of the energies being that of the mean inertia at the mean speed.

    So (15.7) finds the origin; the mean of the two speeds is then not quite that of the cycle.
    """
    (_, least), (_, most) = cycle.energy.extremes(cycle.whole)
    origin = (least + most) / 2 - (cycle.mean_inertia + inertia) * cycle.speed**2 / 2
    if least <= origin:
        raise Refused(f"{what}: inertia {inertia:g}", "the energy at the mean speed is less than its change",
                      "a heavier flywheel, or a higher speed")
    upper, lower = (_from_origin(cycle, inertia, origin, above) for above in (True, False))
    return Flywheel(inertia, upper, lower, origin)


def _from_origin(cycle: SteadyCycle, inertia: float, origin: float, above: bool) -> Touch:
    """The tangent from the origin: the slope is drawn, and drawn again to where that tangent touched."""
    slope = cycle.speed**2 / 2
    for _ in range(MOST):
        found = touch(cycle, slope, above)
        before, slope = slope, (found.energy - origin) / (found.inertia + inertia)
        if abs(slope - before) <= SPEED_TOL * slope:
            break
    return _through(found._replace(slope=slope))


def _through(one: Touch) -> Touch:
    """The same tangent, cutting the axis where its slope has it."""
    return one._replace(cut=one.energy - one.slope * one.inertia)
