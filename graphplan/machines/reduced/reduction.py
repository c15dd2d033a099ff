"""Reduction to the first drive: the inertia and the moment that stand for all masses and loads, over the cycle.

A mechanism with one freedom moves as one link would that has the reduced inertia, sum(m v^2 + I omega^2) with the
velocities at a unit rate, and on which the reduced moment acts, which has the power of all loads: the moment of the
forces about the pole of Zhukovsky's lever (Ozols 1974, 13-2 and 13-3; methods A1 to A3). Only ratios of velocities
count: one construction with orthogonal velocities of any size, recorded in one pose, serves all. How the inertia
changes comes of the accelerations at a constant unit rate: dI/dphi = 2 sum(m v.a + I omega alpha).

Of a drive that slides it is a reduced mass and force. Travels count upwards in the sense in which the first drive
moves, and a reduced moment is positive that way.

Rounding is no measure of itself: the moment of a weight that moves across gravity is some 1e-16 of what the weight
could do, and the work of that moment, over a cycle, is as much of itself as it happens to be. So the size of the
machine is known beside them: its inertia and the moments that its loads could have.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.pose import in_pose
from graphplan.cycle.travel import check_drives, travels
from graphplan.cycle.turn import RangeOfMotion, whole_motion
from graphplan.errors import Refused
from graphplan.machines.reduced.force_drawings import lever_drawing
from graphplan.machines.reduced.friction import M_F, CycleLosses, FrictionOverCycle, cycle_losses
from graphplan.machines.reduced.reduced_loads import (
    ACCELERATIONS,
    VELOCITIES,
    LoadValues,
    SpeedLoad,
    UnitMotion,
    UnitRates,
    common_period,
    load_breaks,
    loads_on_links,
    loads_with,
    moving_points,
    sort_breaks,
)
from graphplan.mechanism.model import FRAME, Find, Force, Mass, Moment, Scene
from graphplan.mechanism.travel import TURN, travel_text
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.phrases import said


@dataclass(frozen=True, eq=False)
class Reduced:
    """Reduction of a scene in n poses: arrays of shape (n,), in SI.

    `travel` of the first drive, in radians or scene lengths; `inertia` in kg m^2 and `moment` in N m, of all loads that
    do not depend on speed, positive in the sense of motion; of a sliding drive kg and N. `by` has each load's own
    moment by its letter on sheets: forces P_3 and P_3', moments M_4, weights G_3, and M_F of friction. Those over a
    speed are `speed_loads`, apart.
    """

    travel: Array
    inertia: Array
    moment: Array
    by: dict[str, Array]
    speed_loads: tuple[SpeedLoad, ...]
    _accelerated: Callable[[], Array] = field(repr=False)

    @property
    def slope(self) -> Array:
        """Slope of the inertia: dI/dphi in kg m^2, or by a metre of a sliding drive in kg/m."""
        return self._accelerated()


class Reduction:
    """The reduced inertia and moment of a scene over its cycle, which is `closed` or goes between two `ends`.

    `breaks` are the travels between which inertia and moment are smooth; `unit` and `sense` are those of
    :class:`UnitMotion`.
    """

    def __init__(self, scene: Scene, motion: RangeOfMotion, ends: tuple[float, float], compiled: bool = False):
        assert scene.loads is not None
        self.scene, self.loads = scene, scene.loads
        self.acting = [*loads_on_links(scene, scene.loads)]
        self.values = LoadValues(scene, self.acting)
        self.masses = {link: mass for link, mass in self.loads.masses.items()
                       if link != FRAME and (mass.mass or mass.inertia)}
        self.motion = UnitMotion(scene, motion, self.quantities_needed(), compiled)
        self.sense, self.unit = self.motion.sense, self.motion.unit
        self.closed = bool(self.motion.period)
        if self.closed:
            ends = 0.0, common_period(self.motion.period, [load.table for load in self.acting if load.table])
        self.ends = ends
        rubs = scene.loads.screws or any(friction.coefficient for friction in scene.loads.frictions)
        self.friction = FrictionOverCycle(scene, self.motion, ends) if rubs else None
        breaks = load_breaks(self.values, self.motion, ends)
        self.breaks = sort_breaks([*breaks, *self.friction.edges.tolist()], ends) if self.friction else breaks

    @property
    def machine_size(self) -> MachineSize:
        """Sizes of inertia and moment, relative to which a number is zero."""
        return machine_size(self.scene)

    @property
    def changing(self) -> tuple[str, ...]:
        """The names of the loads that change over the cycle."""
        return tuple(load.name for load in self.acting if load.table)

    def quantities_needed(self) -> Find:
        """Requests of the motion: the points of forces and masses, and the links of moments and inertias."""
        points = moving_points(self.scene, (load.at for load in self.acting if load.at))
        centres = moving_points(self.scene, (mass.centre for mass in self.masses.values() if mass.mass))
        turning = {load.link for load in self.acting if not load.at}
        turning |= {link for link, mass in self.masses.items() if mass.inertia}
        links = tuple(link for link in self.scene.moving if link in turning)
        return Find(tuple(dict.fromkeys((*points, *centres))), centres, (), links, tuple(self.values.slides))

    def reduce_at(self, travel: Any, side: int = 1) -> Reduced:
        """Inertia and moment at some travels, real numbers of shape (n,); of a closed cycle at any.

        At a break it is the limit from one `side`, -1 or 1. Fails with `Refused` where a pose is not reached, or a
        table does not cover it.
        """
        travel = np.atleast_1d(np.asarray(travel, dtype=float))
        zero, turn = np.zeros(travel.shape), self.motion.turn(travel)
        rates = self.motion.velocities(turn)
        values = self.values.values(self.motion, turn, rates, travel, side)
        by = {load.name: load.arm(rates, turn) * values.get(load.name, 1.0) + zero for load in self.acting
              if not (load.table and load.table.over_speed)}
        if self.friction:
            by[M_F] = self.friction.friction_at(travel, side).moment
        return Reduced(travel, self.power_sum(rates, rates, VELOCITIES) + zero, sum(by.values(), zero), by,
                       tuple(self.values.over_speed(self.motion, turn, rates)),
                       lambda: self._slope(rates, self.motion.accelerations(turn)) + zero)

    def _slope(self, velocities: UnitRates, accelerations: UnitRates) -> Any:
        return 2 * self.power_sum(velocities, accelerations, ACCELERATIONS)

    def power_sum(self, velocities: UnitRates, others: UnitRates, of: tuple[kinds.ResultKind, ...]) -> Any:
        """Over all masses m v.w + I omega epsilon, of velocities and other vectors and rates."""
        total: Any = 0.0
        unit = float(KILOGRAMS[self.scene.units.mass])
        for link, mass in self.masses.items():
            v, w = velocities.rate(kinds.VELOCITY, mass.centre), others.rate(of[0], mass.centre)
            total = total + unit * float(mass.mass) * (np.conj(v) * w).real
            if mass.inertia:
                turning = velocities.rate(kinds.OMEGA, link) * others.rate(of[1], link)
                total = total + unit * float(mass.inertia) * turning
        return total

    @cached_property
    def losses(self) -> CycleLosses:
        """Losses by friction over the cycle; fails with `Refused` if the scene has no friction."""
        if self.friction is None:
            raise Refused("friction", said("the scene has no friction"), "[[friction]] in a joint or a slide")

        def moments(travel: Array) -> dict[str, Array]:
            return {name: moment for name, moment in self.reduce_at(travel).by.items() if name != M_F}

        return cycle_losses(self.friction, moments, self.breaks)

    def drawing(self, travel: float = 0.0) -> Construction:
        """The lever in the pose at a travel, drawn step by step; it balances with the opposite of the reduced moment.
        """
        turn = self.motion.turn(np.array([float(travel)]))
        rates = self.motion.velocities(turn)
        values = self.values.values(self.motion, turn, rates, np.array([float(travel)]), 1)
        load_values = {name: complex(value[0]) for name, value in self.values.in_units(values, turn).items()}
        return lever_drawing(in_pose(self.motion.scene, turn, 0), loads_with(self.loads, load_values))

    def scale_loads(self, factor: float) -> Reduction:
        """The machine with its changing loads multiplied by a factor; springs stay as they are."""
        if factor == 1:
            return self
        forces = tuple(replace(load, table=load.table.times(factor)) if load.table and not load.table.span else load
                       for load in self.loads.forces)
        moments = tuple(replace(load, table=load.table and load.table.times(factor)) for load in self.loads.moments)
        scene = replace(self.scene, loads=replace(self.loads, forces=forces, moments=moments))
        return Reduction(scene, self.motion.motion, self.ends, self.motion.compiled)

    def projections(self, travel: Any) -> dict[str, Array]:
        """The moments of the weights by another form: each weight by the projection of the orthogonal velocity of its
        centre of mass across it, which is horizontal (Ozols 1974, 13-3; method A3)."""
        travel = np.atleast_1d(np.asarray(travel, dtype=float))
        rates = self.motion.velocities(self.motion.turn(travel))
        gravity = complex(*map(float, self.loads.gravity))
        across = 1j * gravity / abs(gravity) if gravity else 0j
        unit = float(KILOGRAMS[self.scene.units.mass]) * abs(gravity)

        def weight_moment(mass: Mass) -> Array:
            orthogonal = 1j * rates.rate(kinds.VELOCITY, mass.centre)
            return unit * float(mass.mass) * (np.conj(across) * orthogonal).real + np.zeros(travel.shape)

        return {f"G_{link}": weight_moment(mass) for link, mass in self.masses.items() if mass.mass and gravity}


def reduction(scene: Scene, span: tuple[float, float] | None = None, *, compiled: bool = False) -> Reduction:
    """The reduction of a scene's masses and loads to its first drive, over its cycle.

    Without a `span` it is a full turn, or with gears as many turns as it takes until all is back; a span of travel, in
    degrees or lengths of a drive that slides, counts in the sense in which the drive moves. `compiled`: positions and
    plans by machine code. Fails with `Refused` where there is nothing to reduce, nothing drives the scene, or it does
    not come so far.
    """
    check_drives(scene)
    loads = scene.loads
    if loads is None or not (loads.masses or loads.forces or loads.moments):
        raise Refused("reduction", said("the scene has neither masses nor loads"),
                      "give it [masses], [[forces]] or [[moments]]")
    if span is None:
        motion = motion_all_round(scene)
        return Reduction(scene, motion, (0.0, float(motion.path.travel[-1])), compiled)
    low, high = sorted(float(end) for end in travels(scene, 2, span))
    if low == high:
        raise Refused("the cycle", said("the span has no length"), "two different travels")
    motion = RangeOfMotion(scene, min(0.0, low), max(0.0, high), closed=False)
    require_reached(scene, motion, low, high)
    return Reduction(scene, motion, (low, high), compiled)


def motion_all_round(scene: Scene) -> RangeOfMotion:
    """The motion all the way round; fails with `Refused` where there is no such."""
    if scene.drives[0].slides:
        raise Refused("the cycle", said("the first drive slides, and no turn closes its travel"), "a span of lengths")
    motion = whole_motion(scene)
    if not motion.goes_round:
        require_reached(scene, motion, 0.0, math.inf)
        turns = f"{motion.path.travel[-1] / TURN:.0f}"
        raise Refused("the cycle", said("links are not back after turns of the drive: {0}", turns),
                      "a span of degrees")
    return motion


def require_reached(scene: Scene, motion: RangeOfMotion, low: float, high: float) -> None:
    """Fail with `Refused` where a limit lies between the given pose and one of these travels, and say where it is."""
    for limit, beyond in ((motion.path.lower, -low), (motion.path.upper, high)):
        if limit and beyond >= abs(limit.travel):
            raise Refused("the cycle", said("the mechanism stops at a {0} at {1}", limit.kind,
                                            travel_text(scene, limit.travel, 10)), "a span that ends before")


# ---- the size of a machine ------------------------------------------------------------------------------------------


class MachineSize(NamedTuple):
    """The reduced inertia (kg m^2) and moment (N m) if all masses and loads moved as fast as the mechanism's reach, and
    the inertia's change by a unit of travel; of a sliding drive in kg and N."""

    inertia: float
    moment: float
    slope: float


def machine_size(scene: Scene) -> MachineSize:
    """The size of a scene's machine."""
    loads, units, turns = scene.loads, scene.units, not scene.drives[0].slides
    assert loads is not None
    metres = float(METRES[units.length])
    unit = 1.0 if turns else metres  # of travel, in SI
    arm = scene.extent * metres if turns else 1.0
    masses = [float(m.mass) * arm**2 + float(m.inertia) / unit**2 for m in loads.masses.values()]
    weights = [float(m.mass) * math.hypot(*map(float, loads.gravity)) * arm for m in loads.masses.values()]
    forces = [_largest(load) * arm for load in loads.forces] + [_largest(load) / unit for load in loads.moments]
    kilogram, newton = float(KILOGRAMS[units.mass]), float(NEWTONS[units.force])
    inertia = kilogram * sum(masses)
    return MachineSize(inertia, kilogram * sum(weights) + newton * sum(forces), inertia / unit)


def _largest(load: Force | Moment) -> float:
    """The largest value of a load: of a table that of its rows."""
    size_of_load = math.hypot(*map(float, load.value)) if isinstance(load, Force) else abs(float(load.value))
    rows = load.table.rows if load.table else ()
    return max([size_of_load, *(abs(float(value)) for _, value in rows)])
