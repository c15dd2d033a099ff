"""Other ways to the flywheel, beside Wittenbauer's diagram: each with what it finds and what it neglects.

Area vectors, Gutjahr's curves, the power method and, where the scene has a motor whose moment depends on its speed, the
motor's characteristic. What each gives is its own, also where that is no flywheel at all.

Source: Ozols 1974, 15-2 with (15.17) to (15.20) and (15.23) to (15.25), figs. 15-4 to 15-7. In the print of (15.20) the
two speeds have changed places.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from graphplan.machine.flywheel.steady_cycle import SteadyCycle
from graphplan.machine.integrals import Piecewise, Reals
from graphplan.machine.tolerances import AREA_TOL
from graphplan.phrases import Said, said

Speeds = Callable[[float], float]  # the moment of a motor at a speed
NEGLECTS_NOTHING = said("neglects nothing")


@dataclass(frozen=True)
class MethodResult:
    """A flywheel as one method finds it, in kg m^2; the energy A that it stores, in J; and what is neglected."""

    name: str
    inertia: float
    stored: float
    neglects: Said
    figures: dict[str, object] = field(default_factory=dict)


def methods(cycle: SteadyCycle, unevenness: float, motor: Speeds | None = None) -> list[MethodResult]:
    """What each of the other methods finds for an unevenness; `motor` gives the moment of a motor at a speed."""
    comparisons = [gutjahr(cycle, unevenness), area_vectors(cycle, unevenness), power(cycle, unevenness)]
    return comparisons if motor is None else [*comparisons, characteristic(cycle, unevenness, motor)]


# ---- areas between nodes ---------------------------------------------------------------------------------------------


class Area(NamedTuple):
    """An area of the moment's diagram between two nodes, in J, positive where energy is stored."""

    start: float
    end: float
    work: float


def areas(cycle: SteadyCycle) -> list[Area]:
    """The areas between the nodes of the whole moment, from the first node on and once around."""
    nodes = cycle.closed_moment.roots()
    if not len(nodes):
        return []
    (first, last), energy = cycle.ends, cycle.energy
    edges = [float(at) for at in np.unique(np.where(nodes >= last, first, nodes))]
    edges.append(edges[0] + cycle.span)
    areas_between = [Area(low, high, work_between(energy, low, high)) for low, high in pairwise(edges)]
    return [*merge_areas(areas_between, AREA_TOL * sum(abs(area.work) for area in areas_between))]


def work_between(energy: Piecewise, low: float, high: float) -> float:
    """The work from one travel to another, which may be beyond the end of the cycle."""
    first, last = energy.edges[0], energy.edges[-1]
    if high <= last:
        return float(energy.at(high, -1) - energy.at(low))
    return float(energy.at(last, -1) - energy.at(low) + energy.at(high - last + first, -1))


def merge_areas(found: list[Area], nothing: float) -> Iterator[Area]:
    """Areas without those that are nothing; neighbours of one sign are one."""
    last = None
    for area in found:
        if abs(area.work) <= nothing:
            continue
        if last is not None and (last.work > 0) == (area.work > 0):
            last = Area(last.start, area.end, last.work + area.work)
            continue
        if last is not None:
            yield last
        last = area
    if last is not None:
        yield last


def area_vectors(cycle: SteadyCycle, unevenness: float) -> MethodResult:
    """The largest surplus A by the areas laid one after the other: the distance of the outermost levels."""
    areas_of_cycle = areas(cycle)
    levels = [0.0, *accumulate(area.work for area in areas_of_cycle)]
    stored = max(levels) - min(levels)
    nodes = [*(area.start for area in areas_of_cycle), *(area.end for area in areas_of_cycle[-1:])]
    low, high = (nodes[int(best(levels))] if nodes else 0.0 for best in (np.argmin, np.argmax))
    return MethodResult("area vectors", stored / energy_divisor(cycle, unevenness), stored,
                        said("takes the reduced inertia as constant, and leaves it out"),
                        {"areas": areas_of_cycle, "least_at": low, "most_at": high})


# ---- Gutjahr ---------------------------------------------------------------------------------------------------------


def gutjahr(cycle: SteadyCycle, unevenness: float) -> MethodResult:
    """The flywheel by the curves of E - I omega^2/2, drawn with the largest and with the least speed.

    The first has its maximum where the speed is largest, the second its minimum where it is least.
    """
    (_, least), _ = cycle.inertia.extremes(cycle.slope)
    square, ends = cycle.speed**2 / 2, list[tuple[float, float]]()
    for sense in (1, -1):
        squared = (1 + sense * unevenness / 2) ** 2 * square
        curve, rate = cycle.energy + (cycle.inertia + -least) * -squared, cycle.closed_moment + cycle.slope * -squared
        ends.append(curve.extremes(rate)[sense > 0])
    (fast, most), (slow, lowest) = ends
    inertia = (most - lowest) / energy_divisor(cycle, unevenness) - least
    return MethodResult("gutjahr", inertia, most - lowest, NEGLECTS_NOTHING,
                        {"omega_max_at": fast, "omega_min_at": slow, "least_inertia": least})


# ---- work and idling -------------------------------------------------------------------------------------------------


class Rectangles(NamedTuple):
    """A load in two steps of power, the mean of both and the surplus of the first: W and J."""

    mean: float
    surplus: float


def rectangles(work: float, work_time: float, idle: float, idle_time: float) -> Rectangles:
    """The motor's mean power and what must be stored, from the powers of work and of idling and their times."""
    mean = (work * work_time + idle * idle_time) / (work_time + idle_time)
    return Rectangles(mean, (work - mean) * work_time)


def power(cycle: SteadyCycle, unevenness: float) -> MethodResult:
    """The flywheel by the powers of one working stroke and of all the rest, at the mean speed.

    The stroke is the longest run of travel over which energy is taken from the flywheel.
    """
    taken = min(areas(cycle), key=lambda area: area.work, default=Area(0.0, cycle.span, 0.0))
    span, drive = taken.end - taken.start, cycle.closing * cycle.speed
    strokes = [(-work / length * cycle.speed if length else 0.0, length / cycle.speed)
               for work, length in ((taken.work, span), (-taken.work, cycle.span - span))]
    (work, work_time), (idle, idle_time) = strokes
    wheel = rectangles(work + drive, work_time, idle + drive, idle_time)
    inertia = wheel.surplus / energy_divisor(cycle, unevenness) - cycle.mean_inertia
    return MethodResult("power", inertia, wheel.surplus,
                        said("takes one working stroke and idling, each of constant power, and the mean of the "
                             "inertia"),
                        {"work": work + drive, "work_time": work_time, "idle": idle + drive, "idle_time": idle_time,
                         "mean": wheel.mean})


# ---- the motor's characteristic --------------------------------------------------------------------------------------


def characteristic(cycle: SteadyCycle, unevenness: float, motor: Speeds) -> MethodResult:
    """The flywheel where a motor gives way: the larger of the areas between its moment and that of the load.

    Where the load has the motor's moment of the largest speed work begins, and it ends where it has that of the least;
    between these places the motor's moment runs straight, and straight back while the machine idles.
    """
    net_moment, (first, _) = cycle.closed_moment + -motor(cycle.speed), cycle.ends
    levels = [motor((1 + sense * unevenness / 2) * cycle.speed) for sense in (1, -1)]
    (slow, _), (fast, _) = cycle.energy.extremes(cycle.closed_moment)
    start, end = (nearest_travel(cycle, (net_moment + level).roots(), at)
                  for level, at in zip(levels, (fast, slow), strict=True))
    load, middle, worked = net_moment.integral(), sum(levels) / 2, (end - start) % cycle.span
    works = [work_between(load, low, low + length) + middle * length
             for low, length in ((start, worked), (first + (end - first) % cycle.span, cycle.span - worked))]
    stored = max(map(abs, works))
    return MethodResult("characteristic", stored / energy_divisor(cycle, unevenness) - cycle.mean_inertia, stored,
                        said("lets the motor's moment run straight between its two levels, and takes the mean of the "
                             "inertia"),
                        {"moment_at_omega_max": levels[0], "moment_at_omega_min": levels[1], "work": (start, end)})


def nearest_travel(cycle: SteadyCycle, places: Reals, to: float) -> float:
    """The nearest of some travels on the round of the cycle; the travel itself where there is none."""
    around = [abs((at - to + cycle.span / 2) % cycle.span - cycle.span / 2) for at in places]
    return float(places[int(np.argmin(around))]) if around else to


def energy_divisor(cycle: SteadyCycle, unevenness: float) -> float:
    """What divides an energy: delta omega^2."""
    return unevenness * cycle.speed**2
