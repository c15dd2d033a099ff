"""Other ways to the flywheel, beside Wittenbauer's diagram: each with what it finds and what it neglects.

Area vectors, Gutjahr's curves, the power method and, where the scene has a motor whose moment depends on its speed, the
motor's characteristic. What each gives is its own, also where that is no flywheel at all.

Source: Ozols 1974, 15-2 with (15.17) to (15.20) and (15.23) to (15.25), figs. 15-4 to 15-7. In the print of (15.20) the
two speeds have changed places.

The flywheel that a scene asks for: its steady cycle, the wheel, what other methods find, and its drawing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any, NamedTuple

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals, distinct_values
from graphplan.machines.flywheel.drawing import FlywheelDrawing, draw_flywheel
from graphplan.machines.flywheel.steady_cycle import (
    FlywheelSpeeds,
    SteadyCycle,
    by_mean_energy,
    reduced_rows,
    size_flywheel,
    steady_cycle,
    turn_with,
)
from graphplan.machines.integrals import Piecewise
from graphplan.machines.reduced.reduction import Reduction, reduction
from graphplan.machines.tolerances import AREA_TOL, MOTOR_TOL
from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import TURN, printed_travels
from graphplan.mechanism.units import KILOGRAMS
from graphplan.phrases import Said, digits, said

Speeds = Callable[[float], float]  # the moment of a motor at a speed
NEGLECTS_NOTHING = said("no simplification")


@dataclass(frozen=True)
class MethodResult:
    """A flywheel as one method finds it, in kg m^2; the energy A that it stores, in J; and what is neglected."""

    name: str
    inertia: float
    stored: float
    neglects: Said
    figures: dict[str, object] = field(default_factory=dict)


def methods(cycle: SteadyCycle, unevenness: float, motor: Speeds | None = None) -> list[MethodResult]:
    """Results of the other methods for an unevenness; `motor` gives the moment of a motor at a speed."""
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
    edges = [float(at) for at in distinct_values(np.where(nodes >= last, first, nodes))]
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
    """Merge neighbouring areas of one sign; areas below the limit are left out."""
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
                        said("takes the motor's moment as linear between its two levels, and the mean of the inertia"),
                        {"moment_at_omega_max": levels[0], "moment_at_omega_min": levels[1], "work": (start, end)})


def nearest_travel(cycle: SteadyCycle, places: Reals, to: float) -> float:
    """The nearest of some travels on the round of the cycle; the travel itself without any."""
    around = [abs((at - to + cycle.span / 2) % cycle.span - cycle.span / 2) for at in places]
    return float(places[int(np.argmin(around))]) if around else to


def energy_divisor(cycle: SteadyCycle, unevenness: float) -> float:
    """Divisor of an energy: delta omega^2."""
    return unevenness * cycle.speed**2


PLANS_PER_TURN, MAX_PLANS = 24, 120  # of a turn, and of many turns, where nothing is said


@dataclass(frozen=True, eq=False)
class FlywheelResult:
    """The flywheel of a scene. `unevenness` is that asked for, or that with the inertia that is `given`; `check` tells
    by how much the second opinions differ."""

    reduction: Reduction
    cycle: SteadyCycle
    wheel: FlywheelSpeeds
    unevenness: float
    given: bool
    methods: tuple[MethodResult, ...]
    positions: int
    check: Mapping[str, float] = field(default_factory=dict)

    @property
    def scene(self) -> Scene:
        return self.reduction.scene

    @property
    def notes(self) -> Iterator[Said]:
        """Yield the remarks: the closing of the cycle, and what is taken as constant."""
        cycle = self.cycle
        if cycle.factor != 1:
            yield said("the loads that change are multiplied by {0}, so that the cycle closes", digits(cycle.factor, 6))
        if self.reduction.reduce_at(self.travels[:1]).speed_loads:
            yield said("loads over a speed are taken as they are at the mean speed")

    @property
    def travels(self) -> Reals:
        """The travels of the plans, in radians, the end of the cycle included."""
        return np.linspace(*self.cycle.ends, self.positions + 1)

    @property
    def travels_in_degrees(self) -> Any:
        """The travels in degrees."""
        return self.in_degrees(self.travels)

    @cached_property
    def plans(self) -> dict[str, Reals]:
        """Quantities at each plan."""
        return self.values_at(self.travels)

    def values_at(self, travels: Reals) -> dict[str, Reals]:
        """Quantities at some travels: inertia, moment of the loads, whole moment, energy and speed."""
        cycle = self.cycle
        names, (inertia, _, *moments) = reduced_rows(self.reduction, travels, cycle.speed)
        moment = sum((row * (cycle.factor if name in cycle.changing else 1.0)
                      for name, row in zip(names, moments, strict=True)), np.zeros(len(travels)))
        return {"inertia": inertia, "moment": moment, "whole": moment + cycle.closing,
                "energy": cycle.energy.at(travels) - cycle.energy.at(cycle.ends[0]), "omega": self.omega(travels)}

    def in_degrees(self, travel: Any) -> Any:
        """Travels in degrees."""
        return printed_travels(self.scene, travel)

    def omega(self, travel: Any) -> Any:
        """The drive's speed at travels, with the flywheel, in rad/s (m/s)."""
        stored = self.cycle.energy.at(travel) - self.wheel.origin
        return np.sqrt(2 * stored / (self.cycle.inertia.at(travel) + self.wheel.inertia))

    @property
    def without_flywheel(self) -> FlywheelSpeeds | None:
        """The speeds without a flywheel; None if the machine then does not turn."""
        return speeds_if_it_turns(turn_with, self.cycle)

    @property
    def by_mean_energy(self) -> FlywheelSpeeds | None:
        """The speeds without a flywheel, the origin found by the mean energy, as the textbook has it."""
        return speeds_if_it_turns(by_mean_energy, self.cycle)

    @cached_property
    def drawing(self) -> FlywheelDrawing:
        """The drawing with as many plans."""
        return draw_flywheel(self.cycle, self.wheel, self.positions)

    @property
    def strip_error(self) -> float:
        """Error of the drawn flywheel, or of the unevenness with a given one, by the width of the strips."""
        return self.drawing.strip_error * self.drawing.change(self.given)

    @property
    def drawn_result(self) -> float:
        """The drawn flywheel, in kg m^2 (kg), or the drawn unevenness with a given one."""
        return self.drawing.unevenness if self.given else self.drawing.inertia


def flywheel(scene: Scene, positions: int | None = None, *, what: str = "flywheel") -> FlywheelResult:
    """The flywheel that a scene's table asks for, drawn with so many plans of the cycle, or with 24 of each turn.

    Fails with `Refused` where there is no such table, the cycle does not close, or no flywheel is needed.
    """
    wish = scene.flywheel
    if wish is None:
        raise Refused(what, "the unevenness is missing",
                      "a table [flywheel] with speed and unevenness")
    try:
        reduced = reduction(scene)
    except Refused as fault:
        raise Refused(what, f"the cycle does not close: {fault.why}", "a first drive that makes full turns") from None
    cycle = steady_cycle(reduced, float(wish.speed), wish.closes, reduced.changing, what)
    if wish.inertia is not None:
        wheel = turn_with(cycle, float(wish.inertia) * float(KILOGRAMS[scene.units.mass]), what)
        unevenness = wheel.unevenness
    else:
        unevenness = float(wish.unevenness or 0)
        wheel = size_flywheel(cycle, unevenness, what)
    comparisons = tuple(methods(cycle, unevenness, motor(reduced))) if unevenness > 0 else ()
    plans = positions or min(PLANS_PER_TURN * max(1, round(cycle.span / TURN)), MAX_PLANS)
    return FlywheelResult(reduced, cycle, wheel, unevenness, wish.inertia is not None, comparisons, plans)


def motor(reduced: Reduction) -> Speeds | None:
    """The moment at a speed of the loads over the drive's speed, at any travel; None without such loads."""
    first, last = reduced.ends
    loads = [load for load in reduced.reduce_at(np.linspace(first, last, 7)[:-1]).speed_loads
             if all(np.ptp(rate) <= MOTOR_TOL * np.abs(rate).max() for rate in (load.arm, load.rate))]
    return (lambda omega: math.fsum(float(np.ravel(load.moment(omega))[0]) for load in loads)) if loads else None


def speeds_if_it_turns(find: Any, cycle: SteadyCycle) -> FlywheelSpeeds | None:
    try:
        speeds: FlywheelSpeeds = find(cycle, 0.0)
    except Refused:
        return None
    return speeds
