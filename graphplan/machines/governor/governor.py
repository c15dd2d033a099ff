"""Governors: the force that holds the balls on their circle, its characteristic, how it is drawn, and friction.

At a unit rate of the first drive the powers of all weights, loads and springs sum up to the reduced moment M, the
moment about the pole of Zhukovsky's lever. Balls at r from the axis, which move outwards at r', hold them in balance
with a centrifugal force C r' = -M. Over r that is the characteristic: a ray from the origin has
tan psi = C/r = m omega^2, so a position is stable where C/r grows with r, and a governor whose characteristic is a ray
itself is isochronous.

The ray of a given speed meets the characteristic in the positions of equilibrium. The balls are points: the centrifugal
forces of arms are neglected. With friction there are two characteristics more, C'' at which the balls move outwards and
C' at which they move inwards: between the places where the ray of a speed meets them friction holds the governor.

Without friction a force C on the balls holds a position. With it they move outwards only at C'' > C and inwards only at
C' < C; between the speeds omega'' and omega' of both the sleeve stands still, and nu = (omega'' - omega')/omega is
the degree of insensitivity. C'' and C' are those at which the force polygons with friction circles and leaning guides
give a drive that moves the governor outwards or inwards nothing to do: sought by secants, all positions at once.

Rays from the origin cut off c tan psi on an upright at the distance c, which says the speeds. With friction there are
the rays of one position on both other characteristics, and the places between which friction holds the governor.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 15-5, (15.32) to (15.35), figs. 15-14 to 15-16;
method A21.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.errors import Refused
from graphplan.kernel.passes import PlanScale, Values, record_drawing
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machines.motion.drawing import fine_scale
from graphplan.machines.reduced.force_drawings import rubbed_drawing
from graphplan.machines.reduced.friction import FRICTION_ROUNDS, FrictionOverCycle, weights_alone, with_rounds
from graphplan.machines.reduced.reduced_loads import PressedRecordings, refine_zeros
from graphplan.machines.reduced.reduction import Reduction, reduction
from graphplan.machines.tolerances import BALANCE_TOL, EVENNESS_TOL, ON_LINE_TOL
from graphplan.mechanism.model import Force, Governor, LoadTable, Scene
from graphplan.mechanism.order import named_forces
from graphplan.mechanism.travel import travel_text
from graphplan.mechanism.units import KILOGRAMS, NEWTONS
from graphplan.methods import kinds
from graphplan.phrases import said
from graphplan.sheet.diagrams import AxisScale, Frame

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
        """Outward speed of the balls for a unit of travel, in metres."""
        motion, centre = self.reduction.motion, self.reduction.loads.masses[self.governor.balls[0]].centre
        rates = motion.velocities(motion.turn(travel))
        return np.sign(self.distance(travel)[0]) * self.across(rates.rate(kinds.VELOCITY, centre))

    def across(self, z: Array) -> Array:
        """Component of a vector across the axis."""
        return (z * np.conj(self.right)).real

    @property
    def right(self) -> complex:
        """The unit vector perpendicular to the axis, to its right."""
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

    @property
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
        """Extrema of C/r over r: there a governor changes between stable and unstable."""
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

    @property
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

    @property
    def insensitivity(self) -> Array:
        """The degree of insensitivity in the drawn positions: the range of speeds in which friction holds it, by the
        speed without friction."""
        outwards, inwards = self.band_speeds(self.drawn_states, self.drawn_band)
        return np.asarray((outwards - inwards) / self.drawn_states.omega)

    @property
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
        """End of a stretch that has the sample k, on one side."""
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


SECANT_ROUNDS = 12
FIRST_STEP = 0.02  # of C, to a second value beside it


class FrictionBand(NamedTuple):
    """The forces on all balls in N, or the speeds in rad/s, at which they move outwards and inwards: arrays of shape
    (n,)."""

    outwards: Array
    inwards: Array


@dataclass(frozen=True, eq=False)
class GovernorFriction:
    """The friction of a governor: that of its pairs while it moves in the sense of its first drive, and against it.

    `shares` has what each ball bears of C by the name of its force, and `across` the unit vectors along which.
    """

    rubbing: FrictionOverCycle
    backwards: PressedRecordings
    shares: Mapping[str, float]
    across: Mapping[str, complex]

    @property
    def scenes(self) -> tuple[Scene, Scene]:
        """The scene as it moves in the sense of the first drive, and against it."""
        return self.rubbing.scene, self.backwards.scene

    def other_loads(self, travel: Array) -> dict[str, Array]:
        """The loads that change but those on the balls, at some travels."""
        turn = self.rubbing.motion.turn(travel)
        return self.rubbing.loads(travel, turn, self.rubbing.motion.velocities(turn))

    def acting(self, others: dict[str, Array], C: Array) -> dict[str, Array]:
        """Add to other loads a force C, in N, shared by all balls; loads by name, in the scene's units."""
        newton = float(NEWTONS[self.rubbing.scene.units.force])
        return others | {name: C * share / newton * self.across[name] for name, share in self.shares.items()}

    def force(self, travel: Array, C: Array, along: bool) -> Array:
        """The force on all balls at some travels at which they move `along` with the first drive, or against it, where
        C holds them without friction. Fails with `Refused` where friction locks the governor at any force."""
        turn, recordings = self.rubbing.motion.turn(travel), self.rubbing.recordings if along else self.backwards
        others = self.other_loads(travel)

        def moment(force: Array) -> Array:
            found = recordings.evaluate(turn, loads=self.acting(others, force))
            return self.rubbing.drive_moment(found, turn, kinds.RUBBED)

        before, force = C, C * (1 + FIRST_STEP)
        moment_before, largest = moment(before), np.zeros(C.shape)
        for _ in range(SECANT_ROUNDS):
            value = moment(force)
            largest = np.maximum(largest, np.maximum(abs(value), abs(moment_before)))
            with np.errstate(all="ignore"):
                step = value * (force - before) / (value - moment_before)
            step = np.where(np.isfinite(step), step, 0.0)
            before, moment_before, force = force, value, force - step
            if np.all(abs(step) <= BALANCE_TOL**2 * abs(C)):
                break
        if locked := np.flatnonzero(~(abs(step) <= BALANCE_TOL * abs(C))).tolist():
            at = travel_text(self.rubbing.scene, float(travel[locked[0]]))
            raise Refused("friction", said("the mechanism locks itself at a travel of {0}", at), "less friction")
        return force


def governor_friction(scene: Scene, smooth: Reduction, balls: Mapping[str, tuple[str, complex, float]]
                      ) -> GovernorFriction:
    """The friction of a scene whose `smooth` reduction is without friction; `balls` have by their links the centre, the
    direction away from the axis and the share of the force."""
    loads = scene.loads
    assert loads is not None
    low, high = map(float, smooth.motion.in_scene_units(np.array(smooth.ends)))
    table = LoadTable("travel", ((low, 1), (high, 1)))
    forces = {link: Force(link, centre, (away.real, away.imag), table, (away.real, away.imag))
              for link, (centre, away, _) in balls.items()}
    loads = weights_alone(scene, loads)
    loaded = replace(scene, flywheel=None, loads=replace(loads, forces=(*loads.forces, *forces.values())))
    rubbing = FrictionOverCycle(loaded, smooth.motion, smooth.ends)
    assert loaded.loads is not None
    names = {force.on: name for name, force in named_forces(loaded.loads).items() if force in forces.values()}
    opposite = rubbing.scene.with_drives(drive.driven_at(-drive.rate, 0) for drive in rubbing.scene.drives)
    return GovernorFriction(rubbing, PressedRecordings(with_rounds(opposite, FRICTION_ROUNDS), smooth.motion.motion,
                                                       rubbed_drawing),
                            {names[link]: share for link, (_, _, share) in balls.items()},
                            {names[link]: away for link, (_, away, _) in balls.items()})


GOVERNOR = Panel("governor", said("Characteristic of the governor"))
WALL_SHARE, TOP_SHARE = 0.9, 0.95  # of the largest r, where rays are cut; of the height, what is used


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
        return self.speeds("rays")

    @property
    def band(self) -> Array:
        """The speeds at which the balls move outwards and inwards in the middle position, as they are drawn."""
        return self.speeds("band")

    def speeds(self, role: str) -> Array:
        """The speeds that rays cut off on the upright."""
        heights = np.array([y for _, y in self.values.values_of_role(role)]) - self.frame.origin[1]
        return np.sqrt(heights * self.frame.y.unit / (self.frame.x.unit * self.result.mass * self.c))

    @property
    def r(self) -> Array:
        """The distances of the balls in the positions of equilibrium, as they are drawn, in metres."""
        return self.distances("equilibria")

    @property
    def held_between(self) -> Array:
        """The drawn distances between which friction holds the governor, in metres."""
        return np.sort(self.distances("held"))

    def distances(self, role: str) -> Array:
        """The distances of the balls at some places on the axis of r."""
        return np.array([self.frame.x.value(x - self.frame.origin[0]) for x, _ in self.values.values_of_role(role)])


def draw_governor(result: GovernorResult, width: float = 250.0, height: float = 180.0) -> GovernorDrawing:
    """The characteristic with the rays of its positions, and where that of the spindle's speed meets it; with friction
    the rays of both other characteristics in one position, and between which places friction holds the governor."""
    states, omega = result.drawn_states, max(result.extremes[1], result.spindle_speed)
    wall = WALL_SHARE * float(states.r[-1])
    bands = dict(zip(("''", "'"), result.drawn_band, strict=True)) if result.friction else {}
    top = max(float(C.max()) for C in (states.C, *bands.values()))
    k_r = fine_scale(float(states.r[-1]) / (TOP_SHARE * width))
    k_C = fine_scale(max(top, result.mass * omega**2 * wall) / (TOP_SHARE * height))
    frame = Frame((0.0, 0.0), AxisScale(k_r), AxisScale(k_C), (0.0, width), (0.0, height))
    board, c, middle = Board(), wall / k_r, result.drawn_middle
    crossings = {prime: result.drawn_crossings(C) for prime, C in bands.items()}
    crossings[""] = [] if result.is_isochronous else result.drawn_crossings(states.C)  # that is a ray itself

    def points_at(prime: str, C: Array, places: Iterable[int]) -> dict[int, Mark]:
        """The given points of a characteristic at some of the positions."""
        return {k: board.given(x=float(x), y=float(y), name=f"C_{k + 1}{prime}") for k in sorted({*places})
                for x, y in [frame.position(states.r[k], C[k])]}

    with board.on(GOVERNOR):
        O = board.given(x=0.0, y=0.0, name="O")
        points = {"": points_at("", states.C, range(len(states.r)))}
        points |= {prime: points_at(prime, C, [middle, *(k + end for k in crossings[prime] for end in (0, 1))])
                   for prime, C in bands.items()}
    with board.on(GOVERNOR, stage=Stage(said("Speeds"), said("rays with tan psi = C/r = m omega² cut off c tan psi"))):
        axis = board.guide(O, dx=1, dy=0, why=said("the axis of r"))
        foot = board.lay_along(axis, O, length=c, name="W", why=said("the length c sets the scale"))
        upright = board.perpendicular(axis, foot, why=said("on it the rays cut off c tan psi"))
        rays = [board.meet(board.line(O, point, why=said("the ray of this position")), upright, name=f"T_{k + 1}")
                for k, point in points[""].items()]
    cut = result.mass * result.spindle_speed**2 * k_r * c / k_C
    with board.on(GOVERNOR, stage=Stage(said("Equilibrium"), said("the ray of a speed meets the characteristic"))):
        T = board.lay_along(upright, foot, length=cut, name="T", why=said("it is c tan psi = c k_r/k_C m omega²"))
        ray = board.line(O, T, why=said("the ray of the speed"))
        equilibria = [_equilibrium(board, axis, ray, points[""], k) for k in crossings[""]]
    band, ends = list[Mark](), list[Mark]()
    if bands:
        law = said("C'' moves the balls outwards, C' inwards: between their speeds friction holds them")
        with board.on(GOVERNOR, stage=Stage(said("Insensitivity"), law)):
            band = [board.meet(board.line(O, points[prime][middle], why=said("the ray of this position with friction")),
                               upright, name=f"T_{middle + 1}{prime}") for prime in bands]
            ends = [_equilibrium(board, axis, ray, points[prime], k, prime) for prime in bands
                    for k in crossings[prime]]
    marks = {"origin": [O], "points": [*points[""].values()], "rays": rays, "speed": [T, ray],
             "equilibria": equilibria, "band": band, "held": ends}
    return GovernorDrawing(result, frame, c, record_drawing(board, marks, {GOVERNOR: PlanScale(on_paper=True)}
                                                            ).mark_values())


def _equilibrium(board: Board, axis: Mark, ray: Mark, points: Mapping[int, Mark], k: int, prime: str = "") -> Mark:
    """Intersection of the ray with a characteristic between two positions, carried down to the axis of r."""
    chord = board.line(points[k], points[k + 1], why=said("the chord of the characteristic"))
    why = said("from here on friction holds it") if prime else said("the position of equilibrium")
    E = board.meet(ray, chord, name=f"E_{k + 1}{prime}", why=why)
    upright = board.perpendicular(axis, E, why=said("down to the axis"))
    return board.meet(axis, upright, name=f"R_{k + 1}{prime}")
