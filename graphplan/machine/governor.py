"""A centrifugal governor: the force that its balls need in each position, its speeds, stability and irregularity.

At a unit rate of the first drive the powers of all weights, loads and springs sum up to the reduced moment M, the
moment about the pole of Zhukovsky's lever. Balls at r from the axis, which move outwards at r', hold them in balance
with a centrifugal force C r' = -M. Over r that is the characteristic: a ray from the origin has
tan psi = C/r = m omega^2, so a position is stable where C/r grows with r, and a governor whose characteristic is a ray
itself is isochronous.

Drawn, the rays of the positions cut off c tan psi on an upright at the distance c; the ray of a given speed meets the
characteristic in the positions of equilibrium. The balls are points: the centrifugal forces of arms are neglected.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 15-5, (15.32) to (15.35); method A21.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphplan.cycle.curves import AxisScale, Frame
from graphplan.cycle.linkage import Array
from graphplan.errors import Refused
from graphplan.kernel.drawing import PlanScale, Values, record_drawing
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machine.motion.diagram_layout import fine_scale
from graphplan.machine.reduced.reduction import Reduction, reduction
from graphplan.machine.tolerances import EVENNESS_TOL, ON_LINE_TOL
from graphplan.mechanism.governor import Governor
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import KILOGRAMS
from graphplan.methods import kinds
from graphplan.phrases import said

GOVERNOR = Panel("governor", said("Characteristic of the governor"))
SAMPLES = 181  # of the range, between which a place is sought
ZOOMS, DIVISIONS = 20, 8  # how often what is between two of them is divided anew, and in how many parts
WALL_SHARE, TOP_SHARE = 0.9, 0.95  # of the largest r, where rays are cut; of the height, what is used


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
    """A governor over its range: its `reduction`, the `mass` of all balls in kg, and the number of its positions."""

    scene: Scene
    governor: Governor
    reduction: Reduction
    mass: float
    positions: int

    def distance(self, travel: Array) -> Array:
        """The distances of all balls from the axis in metres, shape (balls, n); to the left of the axis below 0."""
        motion, loads = self.reduction.motion, self.reduction.loads
        points = motion.turn(travel).points
        return motion.metres * np.array([self.across(points[loads.masses[ball].centre] - points[self.governor.axis[0]])
                                         for ball in self.governor.balls])

    def across(self, z: Array) -> Array:
        """What a vector runs across the axis."""
        start, end = (complex(*map(float, self.scene.points[point])) for point in self.governor.axis)
        return (z * np.conj((end - start) / abs(end - start) / 1j)).real

    def states(self, travel: Array) -> GovernorStates:
        """The governor at some travels of its first drive.

        Fails with `Refused` where the balls are on the axis, or not all at one distance.
        """
        reduced, motion = self.reduction.reduce_at(travel), self.reduction.motion
        rates, distances = motion.velocities(motion.turn(reduced.travel)), self.distance(reduced.travel)
        r = abs(distances[0])
        reach = float(np.max(r))
        if np.max(abs(abs(distances) - r)) > ON_LINE_TOL * reach:
            raise self.refuse(said("the balls are not at one distance from the axis"),
                              "balls that revolve at one distance")
        centre = self.reduction.loads.masses[self.governor.balls[0]].centre
        outwards = np.sign(distances[0]) * self.across(rates.rate(kinds.VELOCITY, centre))
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

    Fails with `Refused` where the scene has none, its balls have no mass, or it has friction or loads over a speed.
    """
    governor = scene.governor
    where = f"{scene.name}: governor"
    if governor is None:
        raise Refused(where, said("the scene has no governor"), "a table [governor]")
    masses = scene.loads.masses if scene.loads else {}
    if light := [ball for ball in governor.balls if ball not in masses or not masses[ball].mass]:
        raise Refused(where, said("link {0} has no mass", light[0]), f"[masses.{light[0]}]")
    low, high = map(float, governor.between)
    result = reduction(scene, (low, high))
    if result.friction or any(load.table and load.table.over_speed for load in result.acting):
        raise Refused(where, said("friction and loads over a speed are not taken into account"), "a scene without them")
    mass = sum(float(masses[ball].mass) for ball in governor.balls) * float(KILOGRAMS[scene.units.mass])
    return GovernorResult(scene, governor, result, mass, positions)


def _changes(values: Array) -> list[int]:
    """The places behind which a value is another."""
    return np.flatnonzero(values[1:] != values[:-1]).tolist()


# ---- drawing --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class GovernorDrawing:
    """The recorded construction of a governor in its diagram; speeds are read on the upright at `c` mm."""

    result: GovernorResult
    frame: Frame
    c: float
    values: Values

    @property
    def omega(self) -> Array:
        """The speeds at the positions, as they are drawn."""
        heights = np.array([y for _, y in self.values.values_of_role("rays")]) - self.frame.origin[1]
        return np.sqrt(heights * self.frame.y.unit / (self.frame.x.unit * self.result.mass * self.c))

    @property
    def r(self) -> Array:
        """The distances of the balls in the positions of equilibrium, as they are drawn, in metres."""
        return np.array([self.frame.x.value(x - self.frame.origin[0])
                         for x, _ in self.values.values_of_role("equilibria")])


def draw_governor(result: GovernorResult, width: float = 250.0, height: float = 180.0) -> GovernorDrawing:
    """The characteristic with the rays of its positions, and where that of the spindle's speed meets it."""
    states, omega = result.drawn_states, max(result.extremes[1], result.spindle_speed)
    wall = WALL_SHARE * float(states.r[-1])
    k_r = fine_scale(float(states.r[-1]) / (TOP_SHARE * width))
    k_C = fine_scale(max(float(states.C.max()), result.mass * omega**2 * wall) / (TOP_SHARE * height))
    frame = Frame((0.0, 0.0), AxisScale(k_r), AxisScale(k_C), (0.0, width), (0.0, height))
    board, c = Board(), wall / k_r
    with board.on(GOVERNOR):
        O = board.given(x=0.0, y=0.0, name="O")
        points = [board.given(x=float(x), y=float(y), name=f"C_{k}")
                  for k, (x, y) in enumerate(zip(*frame.position(states.r, states.C), strict=True), 1)]
    with board.on(GOVERNOR, stage=Stage(said("Speeds"), said("rays with tan psi = C/r = m omega² cut off c tan psi"))):
        axis = board.guide(O, dx=1, dy=0, why=said("the axis of r"))
        foot = board.lay_along(axis, O, length=c, name="W", why=said("the length c sets the scale"))
        upright = board.perpendicular(axis, foot, why=said("on it the rays cut off c tan psi"))
        rays = [board.meet(board.line(O, point, why=said("the ray of this position")), upright, name=f"T_{k}")
                for k, point in enumerate(points, 1)]
    cut = result.mass * result.spindle_speed**2 * k_r * c / k_C
    with board.on(GOVERNOR, stage=Stage(said("Equilibrium"), said("the ray of a speed meets the characteristic"))):
        T = board.lay_along(upright, foot, length=cut, name="T", why=said("it is c tan psi = c k_r/k_C m omega²"))
        ray = board.line(O, T, why=said("the ray of the speed"))
        above = states.omega2 > result.spindle_speed**2
        equilibria = [_equilibrium(board, axis, ray, points[k : k + 2], k) for k in _changes(above)
                      if not result.is_isochronous]
    marks = {"origin": [O], "points": points, "rays": rays, "speed": [T, ray], "equilibria": equilibria}
    return GovernorDrawing(result, frame, c, record_drawing(board, marks, {GOVERNOR: PlanScale(on_paper=True)}
                                                            ).mark_values())


def _equilibrium(board: Board, axis: Mark, ray: Mark, ends: list[Mark], k: int) -> Mark:
    """Where the ray meets the characteristic between two positions, carried down to the axis of r."""
    chord = board.line(*ends, why=said("the chord of the characteristic"))
    E = board.meet(ray, chord, name=f"E_{k + 1}", why=said("the position of equilibrium"))
    upright = board.perpendicular(axis, E, why=said("down to the axis"))
    return board.meet(axis, upright, name=f"R_{k + 1}")
