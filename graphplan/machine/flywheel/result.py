"""The flywheel that a scene asks for: its steady cycle, the wheel, what other methods find, and its drawing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.machine.flywheel.drawing import FlywheelDrawing, draw_flywheel
from graphplan.machine.flywheel.other_methods import MethodResult, Speeds, methods
from graphplan.machine.flywheel.steady_cycle import (
    FlywheelSpeeds,
    SteadyCycle,
    by_mean_energy,
    reduced_rows,
    size_flywheel,
    steady_cycle,
    turn_with,
)
from graphplan.machine.integrals import Reals
from graphplan.machine.reduced.reduction import Reduction, reduction
from graphplan.machine.tolerances import MOTOR_TOL
from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import TURN, printed_travels
from graphplan.mechanism.units import KILOGRAMS
from graphplan.phrases import Said, digits, said

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
        """What is to be said of it: how the cycle closes, and what is taken as constant."""
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
        """The same in degrees."""
        return self.in_degrees(self.travels)

    @cached_property
    def plans(self) -> dict[str, Reals]:
        """What there is at each plan."""
        return self.values_at(self.travels)

    def values_at(self, travels: Reals) -> dict[str, Reals]:
        """What there is at some travels: inertia, moment of the loads, whole moment, energy and speed."""
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
        """The speeds without a flywheel; none where the machine then does not come round."""
        return speeds_if_it_turns(turn_with, self.cycle)

    @property
    def by_mean_energy(self) -> FlywheelSpeeds | None:
        """The speeds without a flywheel, the origin found by the mean energy, as the textbook has it."""
        return speeds_if_it_turns(by_mean_energy, self.cycle)

    @cached_property
    def drawing(self) -> FlywheelDrawing:
        """The drawing with as many plans."""
        return draw_flywheel(self.cycle, self.wheel, self.positions)

    @cached_property
    def strip_error(self) -> float:
        """How far the drawn flywheel, or the unevenness with a given one, may be off by the width of the strips."""
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
                      "a table [flywheel] with speed and unevenness, or --speed and --unevenness")
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
    """The moment at a speed of the loads over the drive's speed, whatever the travel; none where there are none."""
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
