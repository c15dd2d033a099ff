"""A centrifugal governor: the force that its balls need in each position, its speeds, stability and irregularity.

At a unit rate of the first drive the powers of all weights, loads and springs sum up to the reduced moment M, the
moment about the pole of Zhukovsky's lever. Balls at r from the axis, which move outwards at r', hold them in balance
with a centrifugal force C r' = -M. Over r that is the characteristic: a ray from the origin has
tan psi = C/r = m omega^2, so a position is stable where C/r grows with r, and a governor whose characteristic is a ray
itself is isochronous.

The ray of a given speed meets the characteristic in the positions of equilibrium. The balls are points: the centrifugal
forces of arms are neglected. With friction there are two characteristics more, C'' at which the balls move outwards and
C' at which they move inwards: between the places where the ray of a speed meets them friction holds the governor.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 15-5, (15.32) to (15.35); method A21.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.errors import Refused
from graphplan.machines.governor.friction import FrictionBand, GovernorFriction, governor_friction
from graphplan.machines.reduced.reduced_loads import refine_zeros
from graphplan.machines.reduced.reduction import Reduction, reduction
from graphplan.machines.tolerances import EVENNESS_TOL, ON_LINE_TOL
from graphplan.mechanism.model import Governor, Scene
from graphplan.mechanism.units import KILOGRAMS
from graphplan.methods import kinds
from graphplan.phrases import said

SAMPLES = 181  # of the range, between which a place is sought
ZOOMS, DIVISIONS = 20, 8  # how often what is between two of them is divided anew, and in how many parts


class GovernorStates(NamedTuple):
    """A governor in n positions, arrays in SI: travel of the first drive, r of the balls, the force C on all of them,
    and the square of the spindle's speed."""

    travel: Array
    r: Array
    C: Array
    omega2: Array

    @property
    def omega(self) -> Array:
        """The speeds in rad/s, nan where no speed holds the position."""
        return np.sqrt(np.where(self.omega2 >= 0, self.omega2, np.nan))


@dataclass(frozen=True, eq=False)
class GovernorResult:
    """A governor over its range: its `reduction` without friction, the `mass` of all balls in kg, the number of its
    positions, and the friction of its pairs, if they have any."""

    scene: Scene
    governor: Governor
    reduction: Reduction
    mass: float
    positions: int
    friction: GovernorFriction | None = None

    def distance(self, travel: Array) -> Array:
        """The distances of all balls from the axis in metres, shape (balls, n); to the left of the axis below 0."""
        motion, loads = self.reduction.motion, self.reduction.loads
        points = motion.turn(travel).points
        return motion.metres * np.array([self.across(points[loads.masses[ball].centre] - points[self.governor.axis[0]])
                                         for ball in self.governor.balls])

    def outward_rate(self, travel: Array) -> Array:
        """How fast the balls move outwards for a unit of travel, in metres."""
        motion, centre = self.reduction.motion, self.reduction.loads.masses[self.governor.balls[0]].centre
        rates = motion.velocities(motion.turn(travel))
        return np.sign(self.distance(travel)[0]) * self.across(rates.rate(kinds.VELOCITY, centre))

    def across(self, z: Array) -> Array:
        """What a vector runs across the axis."""
        return (z * np.conj(self.right)).real

    @property
    def right(self) -> complex:
        """The unit vector square to the axis, to its right."""
        start, end = (complex(*map(float, self.scene.points[point])) for point in self.governor.axis)
        return (end - start) / abs(end - start) / 1j

    def states(self, travel: Array) -> GovernorStates:
        """The governor at some travels of its first drive.

        Fails with `Refused` where the balls are on the axis, or not all at one distance.
        """
        reduced, distances = self.reduction.reduce_at(travel), self.distance(travel)
        r = abs(distances[0])
        reach = float(np.max(r))
        if np.max(abs(abs(distances) - r)) > ON_LINE_TOL * reach:
            raise self.refuse(said("the balls are not at one distance from the axis"),
                              "balls that revolve at one distance")
        outwards = self.outward_rate(travel)
        if np.min(r) <= ON_LINE_TOL * reach or np.min(outwards) * np.max(outwards) <= 0:
            raise self.refuse(said("the balls do not move outwards all the way, or stand on the axis"),
                              "a narrower range")
        C = -reduced.moment / outwards
        return GovernorStates(reduced.travel, r, C, C / (self.mass * r))

    def refuse(self, why: str, do: str) -> Refused:
        return Refused(f"{self.scene.name}: governor", why, do)

    # ---- what follows --------------------------------------------------------------------------------------------

    def spaced_states(self, count: int) -> GovernorStates:
        """The governor in so many positions over its range, from the inmost outwards."""
        states = self.states(np.linspace(*self.reduction.ends, count))
        return states if states.r[-1] > states.r[0] else GovernorStates(*(values[::-1] for values in states))

    @cached_property
    def curve(self) -> GovernorStates:
        """The characteristic in many positions, from the inmost outwards."""
        return self.spaced_states(SAMPLES)

    @cached_property
    def drawn_states(self) -> GovernorStates:
        """The positions that are drawn and tabled."""
        return self.spaced_states(self.positions)

    @cached_property
    def extremes(self) -> tuple[float, float]:
        """The least and the largest speed over the range, in rad/s; fails with `Refused` where no speed holds it."""
        squares = [*self.curve.omega2, *(float(state.omega2[0]) for state in self.turning_places)]
        if not min(squares) > 0:
            raise self.refuse(said("no speed holds it in a part of its range"), "a narrower range, or other loads")
        return math.sqrt(min(squares)), math.sqrt(max(squares))

    @property
    def mean(self) -> float:
        """The mean speed, half the sum of the least and the largest."""
        return sum(self.extremes) / 2

    @property
    def irregularity(self) -> float:
        """The degree of irregularity: the range of the speeds by their mean; zero where that is rounding."""
        return 0.0 if self.is_isochronous else (self.extremes[1] - self.extremes[0]) / self.mean

    @property
    def is_isochronous(self) -> bool:
        """Whether one speed holds all positions, but for rounding."""
        return bool(np.ptp(self.curve.omega2) <= EVENNESS_TOL * np.max(abs(self.curve.omega2)))

    @cached_property
    def turning_places(self) -> list[GovernorStates]:
        """Where C/r has an extremum over r: there a governor that is stable on one side is not on the other."""
        if self.is_isochronous:
            return []
        senses = np.sign(np.diff(self.curve.omega2))
        return [self._zoom(k, k + 2, partial(operator.mul, -senses[k])) for k in _changes(senses)]

    @property
    def unstable_stretches(self) -> list[tuple[float, float]]:
        """The stretches of travel, from the inmost outwards, in which C/r does not grow with r."""
        edges = [self.curve.travel[0], *(state.travel[0] for state in self.turning_places), self.curve.travel[-1]]
        squares = self.states(np.array(edges)).omega2
        return [(float(low), float(high)) for (low, high), (one, two) in zip(pairwise(edges), pairwise(squares),
                                                                             strict=True)
                if one > two and not self.is_isochronous]

    @property
    def spindle_speed(self) -> float:
        """The speed of the spindle: the given one, else the mean."""
        return self.mean if self.governor.speed is None else float(self.governor.speed)

    @cached_property
    def equilibria(self) -> list[tuple[GovernorStates, bool]]:
        """The positions in which the spindle's speed holds the governor, and whether each is stable."""
        if self.is_isochronous:
            return []
        above, square = self.curve.omega2 > self.spindle_speed**2, self.spindle_speed**2
        return [(self._zoom(k, k + 1, lambda omega2: abs(omega2 - square)), not above[k])
                for k in _changes(above)]

    # ---- with friction -------------------------------------------------------------------------------------------

    def band(self, states: GovernorStates) -> FrictionBand:
        """The forces at which the balls move outwards and inwards in some positions."""
        return FrictionBand(self.force(states, outwards=True), self.force(states, outwards=False))

    def force(self, states: GovernorStates, outwards: bool) -> Array:
        """The force at which the balls move outwards, or inwards, in some positions."""
        assert self.friction
        return self.friction.force(states.travel, states.C,
                                   outwards is bool(self.curve.travel[-1] > self.curve.travel[0]))

    def drawn_crossings(self, C: Array) -> list[int]:
        """The drawn positions behind which the ray of the spindle's speed crosses a characteristic."""
        return _changes(self.mass * self.spindle_speed**2 * self.drawn_states.r < C)

    @cached_property
    def drawn_middle(self) -> int:
        """The drawn position that is next to the first of equilibrium, or in the middle."""
        near = float(self.equilibria[0][0].r[0]) if self.equilibria else float(np.mean(self.drawn_states.r))
        return int(np.argmin(abs(self.drawn_states.r - near)))

    @cached_property
    def drawn_band(self) -> FrictionBand:
        """The band of the positions that are drawn."""
        return self.band(self.drawn_states)

    @cached_property
    def curve_band(self) -> FrictionBand:
        """The band of the characteristic."""
        return self.band(self.curve)

    def band_speeds(self, states: GovernorStates, band: FrictionBand) -> FrictionBand:
        """The speeds at which the balls move outwards and inwards, in rad/s; 0 where they stay out at rest."""
        return FrictionBand(*(np.sqrt(np.maximum(C, 0.0) / (self.mass * states.r)) for C in band))

    @cached_property
    def insensitivity(self) -> Array:
        """The degree of insensitivity in the drawn positions: the range of speeds in which friction holds it, by the
        speed without friction."""
        outwards, inwards = self.band_speeds(self.drawn_states, self.drawn_band)
        return np.asarray((outwards - inwards) / self.drawn_states.omega)

    @cached_property
    def irregularity_with_friction(self) -> float:
        """The range of the speeds with friction by the mean speed without."""
        outwards, inwards = self.band_speeds(self.curve, self.curve_band)
        return float(np.max(outwards) - np.min(inwards)) / self.mean

    @cached_property
    def held_stretches(self) -> list[tuple[GovernorStates, GovernorStates]]:
        """The stretches of positions, from the inmost outwards, in which friction holds the governor at the spindle's
        speed: their ends."""
        C = self.mass * self.spindle_speed**2 * self.curve.r
        inside = (self.curve_band.inwards <= C) & (self.curve_band.outwards >= C)
        edges = [0, *(k + 1 for k in _changes(inside)), len(inside)]
        return [(self._edge(start, -1), self._edge(end - 1, 1)) for start, end in pairwise(edges) if inside[start]]

    def _edge(self, k: int, way: int) -> GovernorStates:
        """Where a stretch that has the sample k ends, next to it on one side."""
        beyond = k + way
        if not 0 <= beyond < len(self.curve.r):
            return self.states(self.curve.travel[k : k + 1])
        square = self.mass * self.spindle_speed**2
        side = int(bool(square * self.curve.r[beyond] < self.curve_band.inwards[beyond]))

        def excess(travel: Array) -> tuple[Array, Array]:
            states = self.states(travel)
            return self.force(states, outwards=not side) - square * states.r, np.full(travel.shape, np.nan)

        ends = [self.curve.travel[[place]] for place in (k, beyond)]
        values = [self.curve_band[side][[place]] - square * self.curve.r[[place]] for place in (k, beyond)]
        return self.states(np.array(refine_zeros(excess, *ends, *values)))

    def _zoom(self, low: int, high: int, cost: Callable[[Array], Array]) -> GovernorStates:
        """The place between two samples where a function of omega^2 is least."""
        ends = float(self.curve.travel[low]), float(self.curve.travel[high])
        for _ in range(ZOOMS):
            states = self.states(np.linspace(*ends, DIVISIONS + 1))
            start = min(max(int(np.argmin(cost(states.omega2))) - 1, 0), DIVISIONS - 2)
            ends = float(states.travel[start]), float(states.travel[start + 2])
        return self.states(np.array([sum(ends) / 2]))


def find_governor(scene: Scene, positions: int) -> GovernorResult:
    """The governor of a scene, in so many positions.

    Fails with `Refused` where the scene has none, its balls have no mass, or it has a screw or loads over a speed.
    """
    governor = scene.governor
    where = f"{scene.name}: governor"
    if governor is None:
        raise Refused(where, said("the scene has no governor"), "a table [governor]")
    loads = scene.loads
    masses = loads.masses if loads else {}
    if light := [ball for ball in governor.balls if ball not in masses or not masses[ball].mass]:
        raise Refused(where, said("link {0} has no mass", light[0]), f"[masses.{light[0]}]")
    assert loads is not None
    low, high = map(float, governor.between)
    smooth = reduction(replace(scene, loads=replace(loads, frictions=(), screws=())), (low, high))
    if loads.screws or any(load.table and load.table.over_speed for load in smooth.acting):
        raise Refused(where, said("screws and loads over a speed are not taken into account"), "a scene without them")
    mass = sum(float(masses[ball].mass) for ball in governor.balls)
    result = GovernorResult(scene, governor, smooth, mass * float(KILOGRAMS[scene.units.mass]), positions)
    if not any(friction.coefficient for friction in loads.frictions):
        return result
    away = np.sign(result.distance(np.zeros(1))[:, 0]) * result.right
    balls = {ball: (masses[ball].centre, complex(side), float(masses[ball].mass) / mass)
             for ball, side in zip(governor.balls, away, strict=True)}
    return replace(result, friction=governor_friction(scene, smooth, balls))


def _changes(values: Array) -> list[int]:
    """The places behind which a value is another."""
    return np.flatnonzero(values[1:] != values[:-1]).tolist()
