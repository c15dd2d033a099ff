"""The loads of a machine reduced to its drive: in a unit motion, and by slides that are pressed.

Only ratios of velocities count where masses and forces are reduced, so the first drive goes at a rate of one and the
others in pace, whatever their rates are; a scene that stands still is moved so, too (Ozols 1974, 13-2).

The construction of the given pose serves in every pose of the motion. Where it cannot be drawn in another pose, or
relies on points that coincide in its own alone, those by other forms follow, and those that are recorded in other
poses.

A slide is pressed at both edges where its reaction lies beyond the length on which it bears: where the couple by half
the length is larger than the force perpendicular to the guide. Then its force passes where the friction angles of both
edges meet, which changes the couple in turn; so each pose is drawn as the last round says, until nothing changes (Ozols
1974, 12-2, figs. 12-6 and 12-7; methods A37 and A38).

A load's moment on the first drive is its arm times its value: the arm is the moment of a unit of it about the pole of
Zhukovsky's lever. Tables over travel or a slide's position say the value in each pose; those over a speed leave it open
until the speed is known.

A load by a table breaks at travels where it has a corner or jumps, or changes the stroke. Those over travel are as they
are written. Those over a slide's position are where the slide passes its places, and at its dead points: found between
samples of the motion by Newton's method, kept between the ends of a bracket.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.loads import guide_direction, slide_position
from graphplan.cycle.pose import in_pose
from graphplan.cycle.turn import RangeOfMotion, Turn
from graphplan.design.decide import construct
from graphplan.errors import GraphplanError, Refused
from graphplan.kernel.numbers.arrays import distinct_values
from graphplan.machines.tolerances import BREAK_DISTANCE, BREAK_TOL, DEAD_POINT_TOL, EDGE_TOL, TABLE_TOL
from graphplan.mechanism.loads import SPEED, TRAVEL, LoadTable
from graphplan.mechanism.model import FRAME, Find, Force, Loads, Moment, Number, Scene, Slide
from graphplan.mechanism.order import named_forces, named_moments
from graphplan.mechanism.sections import METHODS
from graphplan.mechanism.travel import TURN, sense
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.phrases import said

OTHER_POSES = (0.11, 0.43, 0.79)  # of the range: poses in which constructions are recorded where no other serves

Draw = Callable[[Scene, str], Construction]
Results = dict[str, dict[str, Array]]


class Recordings:
    """The constructions of a scene over its motion, each drawn when it is first needed, by a method if one is named."""

    def __init__(self, scene: Scene, motion: RangeOfMotion, draw: Draw, compiled: bool = False):
        self.scene, self.motion, self.draw, self.compiled = scene, motion, draw, compiled
        self._drawn: dict[object, Construction | None] = {}

    def evaluate(self, turn: Turn, wanted: Collection[str] | None = None, gaps: bool = False,
                 **given: Mapping[str, Array]) -> Results:
        """The results of the wanted kinds, or of all, in the poses of a turn; with `gaps` nan if there are no results.

        Else it fails with `Refused` if no construction is valid in a pose.
        """
        results, why = Results(), ""
        remaining = np.arange(len(turn.travel))
        for drawing in self.constructions():
            only = None if wanted is None else [kind for kind in drawing.kinds if kind in wanted]
            if only is not None and not only:
                return results
            try:
                poses = self._poses(drawing, turn, remaining, only, given)
            except Refused as refused:
                why = str(refused)
                continue
            for kind, named in poses.results.items():
                for name, z in named.items():
                    row = results.setdefault(kind, {}).setdefault(name, np.full(len(turn.travel), np.nan, z.dtype))
                    row[remaining] = z
            torn = np.any([~np.isfinite(z) for named in poses.results.values() for z in named.values()], axis=0)
            remaining, why = remaining[torn], next(iter(poses.faults.values()), why)
            if not remaining.size:
                return results
        if gaps and results:
            return results
        raise Refused("the cycle", why, "a span of travels in which the mechanism has velocities")

    def _poses(self, drawing: Construction, turn: Turn, left: Array, only: Collection[str] | None,
               given: Mapping[str, Mapping[str, Array]]) -> Any:
        """Evaluate a construction in the poses that `left` selects."""
        points, guides, *more = ({name: z[left] for name, z in values.items()}
                                 for values in (turn.points, turn.guides, *given.values()))
        return drawing.evaluate(points, guides, only=only, compiled=self.compiled,
                                **dict(zip(given, more, strict=True)))  # type: ignore[arg-type]

    def constructions(self) -> Iterator[Construction]:
        """The construction in the given pose; then by other forms, and as it is recorded in other poses."""
        for method in ("", *METHODS):
            yield from self.draw_once(method, partial(self.draw, self.scene, method))
        low, high = (float(self.motion.path.travel[end]) for end in (0, -1))
        for share in OTHER_POSES:
            turn = self.motion.turn(np.array([low + share * (high - low)]))
            if not turn.faults:
                yield from self.draw_once(share, partial(self.draw, in_pose(self.scene, turn, 0), ""))

    def draw_once(self, key: object, draw: Callable[[], Construction]) -> Iterator[Construction]:
        """Yield a construction, if there is one; the reason why the given pose has no construction is reported."""
        if key not in self._drawn:
            try:
                self._drawn[key] = draw()
            except GraphplanError:
                if key == "":
                    raise
                self._drawn[key] = None
        if drawn_pose := self._drawn[key]:
            yield drawn_pose


VELOCITIES = kinds.VELOCITY, kinds.OMEGA, kinds.SLIDE_VELOCITY
ACCELERATIONS = kinds.ACCELERATION, kinds.ALPHA, kinds.SLIDE_ACCELERATION


@dataclass(frozen=True, eq=False)
class UnitRates:
    """Rates over n poses, by kind and name, in metres and radians for a unit of travel (a radian, or a metre of a
    sliding drive): complex arrays of shape (n,) for points and slides, real ones for links. What is fixed has 0."""

    found: Mapping[str, Mapping[str, Array]]

    def rate(self, kind: str, name: str) -> Any:
        """The rates of one thing."""
        return self.found.get(kind, {}).get(name, 0.0)


class UnitMotion:
    """The scene's motion as far as `motion` goes, at a unit rate in the sense in which its first drive moves.

    `sense` is that sense, 1 or -1; travels are in radians or scene lengths. `unit` is the size of a unit
    of travel in SI: 1 of radians where the drive `turns`, else the `metres` of a length. `period` is the travel after
    which all is back, 0 where that is never. `find` is what is asked of the motion.
    """

    def __init__(self, scene: Scene, motion: RangeOfMotion, find: Find, compiled: bool = False):
        self.motion, self.compiled = motion, compiled
        first = scene.drives[0]
        self.sense = sense(first)
        self.period = float(motion.path.travel[-1]) if motion.goes_round else 0.0
        self.metres = float(METRES[scene.units.length])
        self.turns = not first.slides
        self.unit = 1.0 if self.turns else self.metres
        self.scene = replace(at_unit_rate(scene), loads=None, find=find)
        self.recordings = Recordings(self.scene, motion, construct_by, compiled)

    def turn(self, travel: Array) -> Turn:
        """Poses at these travels, of a closed motion at any; fails with `Refused` if a pose is not reached."""
        if self.period:
            travel = np.mod(travel, self.period)
        turn = self.motion.turn(travel, self.compiled)
        if turn.faults:
            why = next(iter(turn.faults.values()))
            raise Refused("the cycle", why, "a span of travels that the mechanism reaches")
        return turn

    def in_scene_units(self, travel: Array) -> Array:
        """Travels as scenes tell them: in degrees, or in lengths."""
        return np.degrees(travel) if self.turns else travel

    def velocities(self, turn: Turn) -> UnitRates:
        """The velocities in the poses of a turn."""
        return self._rates(turn, VELOCITIES)

    def accelerations(self, turn: Turn) -> UnitRates:
        """The accelerations in the poses of a turn, at a constant rate of the drive."""
        return self._rates(turn, ACCELERATIONS)

    def _rates(self, turn: Turn, wanted: tuple[kinds.ResultKind, ...]) -> UnitRates:
        """The rates of some kinds in the poses of a turn."""
        rates = self.recordings.evaluate(turn, wanted)
        return UnitRates({kind: {name: z * self._scale(kind) for name, z in named.items()}
                          for kind, named in rates.items()})

    def _scale(self, kind: str) -> float:
        """Factor from a rate by lengths and seconds to one by metres and units of travel."""
        dimension = kinds.kind_of(kind).dimension
        return self.metres**dimension.length * self.unit**dimension.time


def construct_by(scene: Scene, method: str) -> Construction:
    return construct(scene, Design(method=method))


def at_unit_rate(scene: Scene) -> Scene:
    """The scene with its first drive at a rate of one in its sense, or in the positive one from rest; others in pace.
    """
    first = scene.drives[0]
    unit = abs(Fraction(first.rate)) or Fraction(1)
    first_drive, *other_drives = scene.drives
    start = first_drive.driven_at(Fraction(first_drive.rate) / unit or Fraction(1), Fraction(0))
    return scene.with_drives((start,
                              *(drive.driven_at(Fraction(drive.rate) / unit, Fraction(0)) for drive in other_drives)))


def moving_points(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Points that are not on the frame, each once."""
    return tuple(name for name in dict.fromkeys(names) if FRAME not in scene.links_of[name])


FORCE, MOMENT = (kinds.WITH_FRICTION[kind] for kind in (kinds.SLIDE_REACTION, kinds.SLIDE_MOMENT))
PRESSED_ROUNDS = 8


class PressedRecordings(Recordings):
    """The constructions of a scene over its motion, drawn as its slides are pressed in each pose: `by_state` those in
    which some are pressed at both edges, by the side of each slide."""

    def __init__(self, scene: Scene, motion: RangeOfMotion, draw: Draw, compiled: bool = False):
        super().__init__(scene, motion, draw, compiled)
        self.by_state: dict[tuple[int, ...], Recordings] = {}

    def evaluate(self, turn: Turn, wanted: Collection[str] | None = None, gaps: bool = False,
                 **given: Mapping[str, Array]) -> Results:
        """The results in the poses of a turn, as :meth:`Recordings.evaluate` gives them.

        Fails with `Refused` where it cannot be decided which edges press.
        """
        sleeves = [*pressable_slides(self.scene)]
        results = super().evaluate(turn, wanted, gaps, **given)
        if not sleeves:
            return results
        drawn = np.zeros((len(sleeves), len(turn.travel)), dtype=int)
        for _ in range(PRESSED_ROUNDS):
            sides = np.array([self._sides(slide, length, results, turn, before)
                              for (slide, length), before in zip(sleeves, drawn, strict=True)])
            changed = np.flatnonzero((sides != drawn).any(axis=0))
            if not changed.size:
                return results
            for state in np.unique(sides[:, changed], axis=1).T.tolist():
                here = changed[np.all(np.equal(sides[:, changed].T, state), axis=1)]
                self._redraw(state, here, results, turn, wanted, gaps, given)
            drawn = sides
        raise Refused("friction", said("it cannot be decided which edges of its slides press"),
                      "[[friction]] without length")

    def _redraw(self, state: list[int], here: Array, results: Results, turn: Turn, wanted: Collection[str] | None,
                gaps: bool, given: Mapping[str, Mapping[str, Array]]) -> None:
        """Take the results of some poses from the constructions of a state."""
        names = [slide.name for slide, _ in pressable_slides(self.scene)]
        assert self.scene.loads is not None
        loads = replace(self.scene.loads, pressed={name: side for name, side in zip(names, state, strict=True) if side})
        recordings = self.by_state.setdefault(tuple(state), Recordings(replace(self.scene, loads=loads), self.motion,
                                                                      self.draw, self.compiled))
        part = replace(turn, travel=turn.travel[here], points={name: z[here] for name, z in turn.points.items()},
                       guides={name: z[here] for name, z in turn.guides.items()}, faults={})
        more = {name: {key: z[here] for key, z in values.items()} for name, values in given.items()}
        for kind, named in recordings.evaluate(part, wanted, gaps, **more).items():
            for name, z in named.items():
                results[kind][name][here] = z

    def _sides(self, slide: Slide, length: Number, results: Results, turn: Turn, before: Array) -> Array:
        """On which side of the guide the friction angles meet, in each pose; 0 where one side bears the slide. Where
        the reaction passes through an edge itself both are the same, and it stays as it was `before`."""
        couple, normal = couple_and_normal(self.scene, slide, length, results, turn)
        back = np.conj(guide_direction(slide, turn.points, turn.guides))
        slip = (back * results[kinds.SLIDE_VELOCITY][slide.name]).real
        edge = np.abs(normal) * np.where(before, 1 - EDGE_TOL, 1 + EDGE_TOL)
        return np.where(np.abs(couple) > edge, np.sign(slip * couple), 0).astype(int)


def pressable_slides(scene: Scene) -> Iterator[tuple[Slide, Number]]:
    """The slides that bear on a length, each with it."""
    lengths = {frozenset(friction.links): friction.length for friction in scene.loads.frictions
               if friction.length and friction.coefficient} if scene.loads else {}
    for slide in scene.slides:
        if length := lengths.get(frozenset(slide.links)):
            yield slide, length


def couple_and_normal(scene: Scene, slide: Slide, length: Number, found: Results, turn: Turn) -> tuple[Array, Array]:
    """The couple of a slide by half the length on which it bears, and its force perpendicular to the guide, in forces
    of the scene."""
    back = np.conj(guide_direction(slide, turn.points, turn.guides))
    couple = found[MOMENT][slide.name] * 2 / (float(length) * float(METRES[scene.units.length]))
    return couple, (back * found[FORCE][slide.name]).imag


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
        return self.table.values_at

    def moment(self, omega: Any) -> Any:
        """Moment at this rate of the drive, in rad/s or m/s."""
        return self.arm * self.law(self.rate * omega)


@dataclass(frozen=True)
class LoadOnLink:
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

    def arm(self, rates: UnitRates, turn: Turn) -> Any:
        """Power for a unit of travel and a unit of its value: of a force the moment about the pole of the lever at the
        end of the orthogonal velocity of its point, which is turned clockwise."""
        if not self.at:
            return self.value.real * rates.rate(kinds.OMEGA, self.link)
        orthogonal = -1j * rates.rate(kinds.VELOCITY, self.at)
        return (np.conj(orthogonal) * self.unit(turn)).imag

    def unit(self, turn: Turn) -> Any:
        """A unit of it in the poses of a turn: of a force a vector, of a moment a real number."""
        if not self.at:
            return self.value.real
        if not self.through:
            return self.value
        line = turn.points[self.through[1]] - turn.points[self.through[0]]
        return self.value * line / np.abs(line)


def loads_on_links(scene: Scene, loads: Loads) -> Iterator[LoadOnLink]:
    """The loads on moving links, in newtons and metres, by their names."""
    newton, kilogram = float(NEWTONS[scene.units.force]), float(KILOGRAMS[scene.units.mass])
    for name, force in named_forces(loads).items():
        if force.on != FRAME:
            value = newton * complex(*map(float, force.value))
            if force.table is None:
                yield LoadOnLink(name, force.on, force.at, value)
            elif force.through:
                yield LoadOnLink(name, force.on, force.at, complex(newton), force.table, force.through)
            elif force.direction:
                along = complex(*map(float, force.direction))
                yield LoadOnLink(name, force.on, force.at, newton * along / abs(along), force.table)
    for name, moment in named_moments(loads).items():
        if moment.on != FRAME:
            value = complex(newton * (1.0 if moment.table else float(moment.value)))
            yield LoadOnLink(name, moment.on, "", value, moment.table)
    gravity = complex(*map(float, loads.gravity))
    for link, mass in loads.masses.items():
        if mass.mass and gravity and link != FRAME:
            yield LoadOnLink(f"G_{link}", link, mass.centre, kilogram * float(mass.mass) * gravity)


def loads_with(loads: Loads, values: Mapping[str, complex]) -> Loads:
    """The loads with these values instead of tables, by name, in the scene's units; tables without a value are
    left out."""
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
    """Values of the tables of a scene's loads in poses of its motion.

    `slides` are those that tables are over, by name.
    """

    def __init__(self, scene: Scene, loads: list[LoadOnLink]):
        self.scene, self.tabled = scene, [load for load in loads if load.table]
        names = {load.table.slide for load in self.tabled if load.table}
        self.slides = {slide.name: slide for slide in scene.slides if slide.name in names}

    def values(self, motion: UnitMotion, turn: Turn, rates: UnitRates, travel: Array, side: int) -> dict[str, Array]:
        """The values of the loads by tables over travel or a position; at a jump the limits from one side, -1 or 1."""
        return {load.name: self._value(load.table, motion, turn, rates, travel, side)
                for load in self.tabled if load.table and not load.table.over_speed}

    def in_units(self, values: Mapping[str, Array], turn: Turn) -> dict[str, Array]:
        """Values of tables as the loads that they are, in the scene's units: vectors, and real numbers of moments."""
        newton = float(NEWTONS[self.scene.units.force])
        return {load.name: values[load.name] * load.unit(turn) / newton for load in self.tabled if load.name in values}

    def _value(self, table: LoadTable, motion: UnitMotion, turn: Turn, rates: UnitRates, travel: Array,
               side: int) -> Array:
        if table.span:
            A, B = (turn.points[point] for point in table.span)
            return table.values_at(np.abs(B - A) + 0 * travel)
        if not table.slide:
            return table.values_at(motion.in_scene_units(travel), 1, side > 0)
        slide = self.slides[table.slide]
        return table.values_at(self.place(slide, turn), self._sense(slide, motion, turn, rates, side), side > 0)

    def over_speed(self, motion: UnitMotion, turn: Turn, rates: UnitRates) -> Iterator[SpeedLoad]:
        """The loads over speeds."""
        zero = np.zeros(turn.travel.shape)
        for load in self.tabled:
            if load.table and load.table.over_speed:
                rate: Any = 1.0 if load.table.over == SPEED else self.speed(
                    self.slides[load.table.slide], turn, rates)
                length = 1.0 if load.table.over == SPEED and motion.turns else motion.metres
                yield SpeedLoad(load.name, load.arm(rates, turn) + zero, rate / length + zero, load.table)

    def place(self, slide: Slide, turn: Turn) -> Array:
        """Position of a slide along its guide, in scene lengths."""
        return slide_position(self.scene, slide, turn.points, self.guide_direction(slide, turn))

    def speed(self, slide: Slide, turn: Turn, rates: UnitRates, kind: str = kinds.SLIDE_VELOCITY) -> Array:
        """Speed of a slide along its guide, in metres for a unit of travel; or its rate."""
        return (np.conj(self.guide_direction(slide, turn)) * rates.rate(kind,
                                                                        slide.name)).real + np.zeros(turn.travel.shape)

    def guide_direction(self, slide: Slide, turn: Turn) -> Any:
        """The direction of a guide, a unit vector."""
        return guide_direction(slide, turn.points, turn.guides)

    def _sense(self, slide: Slide, motion: UnitMotion, turn: Turn, rates: UnitRates, side: int) -> Array:
        """The stroke: the sense in which a slide moves, at a dead point that on one side of it."""
        speed = self.speed(slide, turn, rates)
        dead = np.abs(speed) <= DEAD_POINT_TOL * (motion.metres * self.scene.extent if motion.turns else 1.0)
        if dead.any():
            changes = self.speed(slide, turn, motion.accelerations(turn), kinds.SLIDE_ACCELERATION)
            speed = np.where(dead, side * changes, speed)
        return np.where(speed < 0, -1.0, 1.0)


SAMPLES_PER_TURN = 360  # of the motion in each turn, between which a slide changes its sense once at most
SAMPLE_SHIFT = 0.38  # of the way between two samples
MAX_NEWTON_ROUNDS = 60

Function = Callable[[Array], tuple[Array, Array]]


def load_breaks(loads: LoadValues, motion: UnitMotion, ends: tuple[float, float]) -> tuple[float, ...]:
    """The travels between two ends at which the tables of loads have corners, jump or change strokes, in order."""
    tables = [load.table for load in loads.tabled if load.table]
    travels = [travel for table in tables if table.over == TRAVEL for travel in travel_breaks(table, motion, ends)]
    for name, slide in loads.slides.items():
        over = [table for table in tables if table.slide == name]
        travels += slide_breaks(loads, motion, slide, over, ends)
    return sort_breaks(travels, ends)


def sort_breaks(found: Iterable[float], ends: tuple[float, float]) -> tuple[float, ...]:
    """Travels between two ends in order, those that are next to each other once; those beyond the end are those of the
    next round."""
    low, high = ends
    found = (low + (travel - low) % (high - low) if travel > high else travel for travel in found)
    close, breaks = BREAK_DISTANCE * (high - low), [low]
    for travel in sorted(found):
        if travel - breaks[-1] > close and high - travel > close:
            breaks.append(travel)
    return tuple(breaks[1:])


def travel_breaks(table: LoadTable, motion: UnitMotion, ends: tuple[float, float]) -> Iterator[float]:
    """The places of a table over travel, and as it repeats."""
    unit = math.radians(1.0) if motion.turns else 1.0
    for place in table.corners:
        if not table.period:
            yield float(place) * unit
            continue
        first, period = float(place) * unit, float(table.period) * unit
        for turn in range(math.floor((ends[0] - first) / period), math.ceil((ends[1] - first) / period) + 1):
            yield first + turn * period


def sample_travels(motion: UnitMotion, ends: tuple[float, float]) -> Array:
    """Travels between which a pair changes its sense once at most: of a closed cycle all round, the last equal to the
    first, and all off round places, where a pair may stand still."""
    turns = (ends[1] - ends[0]) / TURN if motion.turns else 1.0
    count = max(2, math.ceil(SAMPLES_PER_TURN * turns))
    return np.linspace(*ends, count + 1) + (SAMPLE_SHIFT * (ends[1] - ends[0]) / count if motion.period else 0.0)


def slide_breaks(loads: LoadValues, motion: UnitMotion, slide: Slide, tables: list[LoadTable],
                 ends: tuple[float, float]) -> list[float]:
    """Dead points of a slide, and its passages of places of tables over its position."""
    travel = sample_travels(motion, ends)

    def place(travel: Array) -> tuple[Array, Array]:
        turn = motion.turn(travel)
        return loads.place(slide, turn), loads.speed(slide, turn, motion.velocities(turn)) * motion.unit / motion.metres

    def speed(travel: Array) -> tuple[Array, Array]:
        turn = motion.turn(travel)
        change = loads.speed(slide, turn, motion.accelerations(turn), kinds.SLIDE_ACCELERATION)
        return loads.speed(slide, turn, motion.velocities(turn)), change * motion.unit

    dead = find_zeros(speed, travel, speed(travel)[0])
    strokes = distinct_values(np.concatenate([travel, dead]))
    places, turned = place(strokes)[0], place(np.array(dead))[0] if dead else np.zeros(0)
    zeros = list(dead)
    for table in tables:
        for corner in table.corners if table.over_position else ():
            if not np.any(np.abs(turned - float(corner)) <= TABLE_TOL * float(table.length)):
                zeros += find_zeros(partial(distance_beyond, place, float(corner)), strokes, places - float(corner))
    return zeros


def distance_beyond(place: Function, corner: float, travel: Array) -> tuple[Array, Array]:
    """Distance of a slide beyond a place, and its rate."""
    value, slope = place(travel)
    return value - corner, slope


def find_zeros(function: Function, travel: Array, values: Array) -> list[float]:
    """Zeros of a function with values and slopes: one between samples of different signs, and samples that are zero."""
    exact, crossed = travel[:-1][values[:-1] == 0], np.flatnonzero(values[:-1] * values[1:] < 0)
    return [*map(float, exact), *refine_zeros(function, travel[crossed], travel[crossed + 1], values[crossed],
                                              values[crossed + 1])]


def refine_zeros(function: Function, low: Array, high: Array, before: Array, after: Array) -> list[float]:
    """Refine the zeros of a function, one between each `low` and `high`, where it has values of different signs.

    By Newton's method, or with slopes that are nan by secants; a step that leaves the bracket is one to its middle.
    """
    rising, last, value_before = after > 0, low, before
    at = low + (high - low) * (before / (before - after))
    for _ in range(MAX_NEWTON_ROUNDS if low.size else 0):
        value, slope = function(at)
        below = (value < 0) == rising
        low, high = np.where(below, at, low), np.where(below, high, at)
        with np.errstate(all="ignore"):
            step = at - value / np.where(np.isfinite(slope), slope, (value - value_before) / (at - last))
        new = np.where((step >= low) & (step <= high), step, np.where(value == 0, at, (low + high) / 2))
        movement, last, value_before, at = np.abs(new - at), at, value, new
        if np.all(movement <= BREAK_TOL * np.maximum(1.0, np.abs(at))):
            break
    return [*map(float, at)]


def common_period(period: float, tables: list[LoadTable]) -> float:
    """The travel, in radians, after which both the mechanism and the tables over travel are back."""
    turns = [Fraction(table.period) / 360 for table in tables if table.period]
    return math.lcm(round(period / TURN), *map(int, turns)) * TURN
