"""What loads give of power at a unit rate of the first drive: constant ones, and those of tables, over the cycle.

A load's moment on the first drive is its arm times its value: the arm is the moment of a unit of it about the pole of
Zhukovsky's lever. Tables over travel or a slide's position say the value in each pose; those over a speed leave it open
until the speed is known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.loads import guide_direction, slide_position
from graphplan.cycle.turn import Turn
from graphplan.machine.reduced.unit_motion import Rates, UnitMotion
from graphplan.machine.tolerances import DEAD_POINT_TOL
from graphplan.mechanism.loads import SPEED, LoadTable
from graphplan.mechanism.model import FRAME, Force, Loads, Moment, Scene, Slide
from graphplan.mechanism.order import named_forces, named_moments
from graphplan.mechanism.units import KILOGRAMS, NEWTONS
from graphplan.methods import kinds


@dataclass(frozen=True, eq=False)
class SpeedLoad:
    """A load over a speed in n poses: it has the moment arm * law(rate * omega).

    `rate` is the speed in question, in the unit of its `table`, for each rad/s (m/s) of the drive; `arm` the moment, in
    N m (N), for each unit of what the table gives. Both are arrays of shape (n,).
    """

    name: str
    arm: Array
    rate: Array
    table: LoadTable

    @property
    def law(self) -> Callable[[Array], Array]:
        """The load by the speed."""
        return self.table.at

    def moment(self, omega: Any) -> Any:
        """Its moment where the drive has this rate, in rad/s or m/s."""
        return self.arm * self.law(self.rate * omega)


@dataclass(frozen=True)
class Acting:
    """A load on a link, in SI: a force at a point, else a moment; `table` has the values of one that changes.

    `value` is that of a constant load, and of a table the SI value of one of its units: of a force along its direction,
    unless that goes `through` two points.
    """

    name: str
    link: str
    at: str
    value: complex
    table: LoadTable | None = None
    through: tuple[str, str] | None = None

    def arm(self, rates: Rates, turn: Turn) -> Any:
        """Its power for a unit of travel and a unit of its value: of a force the moment about the pole of the lever
        that it has at the end of the orthogonal velocity of its point, which is turned clockwise."""
        if not self.at:
            return self.value.real * rates.of(kinds.OMEGA, self.link)
        orthogonal = -1j * rates.of(kinds.VELOCITY, self.at)
        return (np.conj(orthogonal) * self.unit(turn)).imag

    def unit(self, turn: Turn) -> Any:
        """A unit of it in the poses of a turn: of a force a vector, of a moment a real number."""
        if not self.at:
            return self.value.real
        if not self.through:
            return self.value
        line = turn.points[self.through[1]] - turn.points[self.through[0]]
        return self.value * line / np.abs(line)


def acting(scene: Scene, loads: Loads) -> Iterator[Acting]:
    """The loads on moving links, in newtons and metres, by their names."""
    newton, kilogram = float(NEWTONS[scene.units.force]), float(KILOGRAMS[scene.units.mass])
    for name, force in named_forces(loads).items():
        if force.on != FRAME:
            value = newton * complex(*map(float, force.value))
            if force.table is None:
                yield Acting(name, force.on, force.at, value)
            elif force.through:
                yield Acting(name, force.on, force.at, complex(newton), force.table, force.through)
            elif force.direction:
                along = complex(*map(float, force.direction))
                yield Acting(name, force.on, force.at, newton * along / abs(along), force.table)
    for name, moment in named_moments(loads).items():
        if moment.on != FRAME:
            value = complex(newton * (1.0 if moment.table else float(moment.value)))
            yield Acting(name, moment.on, "", value, moment.table)
    gravity = complex(*map(float, loads.gravity))
    for link, mass in loads.masses.items():
        if mass.mass and gravity and link != FRAME:
            yield Acting(f"G_{link}", link, mass.centre, kilogram * float(mass.mass) * gravity)


def loads_with(loads: Loads, values: Mapping[str, complex]) -> Loads:
    """The loads with these values in the place of tables, by name, in the scene's units; tables that have none are left
    out."""
    forces, moments = list[Force](), list[Moment]()
    for name, force in named_forces(loads).items():
        if force.table and name in values:
            vector = values[name]
            forces.append(Force(force.on, force.at, (vector.real, vector.imag)))
        elif not force.table:
            forces.append(force)
    for name, moment in named_moments(loads).items():
        if not moment.table or name in values:
            moments.append(Moment(moment.on, values[name].real if moment.table else moment.value))
    return replace(loads, forces=tuple(forces), moments=tuple(moments))


class LoadValues:
    """What the tables of a scene's loads say in poses of its motion.

    `slides` are those that tables are over, by name.
    """

    def __init__(self, scene: Scene, loads: list[Acting]):
        self.scene, self.tabled = scene, [load for load in loads if load.table]
        names = {load.table.slide for load in self.tabled if load.table}
        self.slides = {slide.name: slide for slide in scene.slides if slide.name in names}

    def values(self, motion: UnitMotion, turn: Turn, rates: Rates, travel: Array, side: int) -> dict[str, Array]:
        """The values of the loads by tables over travel or a position; at a jump the limits from one side, -1 or 1."""
        return {load.name: self._value(load.table, motion, turn, rates, travel, side)
                for load in self.tabled if load.table and not load.table.over_speed}

    def in_units(self, values: Mapping[str, Array], turn: Turn) -> dict[str, Array]:
        """Values of tables as the loads that they are, in the scene's units: vectors, and real numbers of moments."""
        newton = float(NEWTONS[self.scene.units.force])
        return {load.name: values[load.name] * load.unit(turn) / newton for load in self.tabled if load.name in values}

    def _value(self, table: LoadTable, motion: UnitMotion, turn: Turn, rates: Rates, travel: Array,
               side: int) -> Array:
        if not table.slide:
            return table.at(motion.told(travel), 1, side > 0)
        slide = self.slides[table.slide]
        return table.at(self.place(slide, turn), self._sense(slide, motion, turn, rates, side), side > 0)

    def over_speed(self, motion: UnitMotion, turn: Turn, rates: Rates) -> Iterator[SpeedLoad]:
        """The loads over speeds."""
        zero = np.zeros(turn.travel.shape)
        for load in self.tabled:
            if load.table and load.table.over_speed:
                rate: Any = 1.0 if load.table.over == SPEED else self.speed(
                    self.slides[load.table.slide], turn, rates)
                length = 1.0 if load.table.over == SPEED and motion.turns else motion.metres
                yield SpeedLoad(load.name, load.arm(rates, turn) + zero, rate / length + zero, load.table)

    def place(self, slide: Slide, turn: Turn) -> Array:
        """Where a slide stands along its guide, in scene lengths."""
        return slide_position(self.scene, slide, turn.points, self.along(slide, turn))

    def speed(self, slide: Slide, turn: Turn, rates: Rates, kind: str = kinds.SLIDE_VELOCITY) -> Array:
        """How fast a slide moves along its guide, in metres for a unit of travel; or how that changes."""
        return (np.conj(self.along(slide, turn)) * rates.of(kind, slide.name)).real + np.zeros(turn.travel.shape)

    def along(self, slide: Slide, turn: Turn) -> Any:
        """The direction of a guide, a unit vector."""
        return guide_direction(slide, turn.points, turn.guides)

    def _sense(self, slide: Slide, motion: UnitMotion, turn: Turn, rates: Rates, side: int) -> Array:
        """The stroke: the sense in which a slide moves, at a dead point that on one side of it."""
        speed = self.speed(slide, turn, rates)
        dead = np.abs(speed) <= DEAD_POINT_TOL * (motion.metres * self.scene.extent if motion.turns else 1.0)
        if dead.any():
            changes = self.speed(slide, turn, motion.accelerations(turn), kinds.SLIDE_ACCELERATION)
            speed = np.where(dead, side * changes, speed)
        return np.where(speed < 0, -1.0, 1.0)
