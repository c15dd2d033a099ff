"""Facts of a sheet: what is given, what is found, in symbols with values and units.

Sheets, tasks and keys say the same facts. Lengths are those of the links, whatever the pose was given by: coordinates
say where a mechanism lies, lengths and angles what it is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from graphplan.mechanism.load_values import spring_laws, spring_numbers
from graphplan.mechanism.loads import FORWARD, RETURN, ZERO, LoadTable
from graphplan.mechanism.model import FRAME, Drive, Force, Friction, Gear, Scene, Wedge
from graphplan.mechanism.order import changing_loads, named_forces, named_moments
from graphplan.mechanism.units import Dimension
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.panels import balance_letter, link_index, pole_letter, slide_named
from graphplan.methods.results import Fact, facts, pair_forces
from graphplan.phrases import Said, arrange, coordinates, digits, join, said, unit
from graphplan.sheet.plates.annotations import rate_letters
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.sheet.words.lengths import magnitude
from graphplan.sheet.words.rows import Deviation, Deviations, largest_size

RESULTS = said("Found")
DIGITS = 4  # of the angle of a result
MOVING = (kinds.VELOCITY, kinds.ACCELERATION, kinds.SLIDE_VELOCITY, kinds.SLIDE_ACCELERATION, kinds.OMEGA, kinds.ALPHA,
          kinds.SCREW)  # kinds that bear the letter of their dimension


def found_facts(drawing: Construction, values: Mapping[str, Mapping[str, Any]],
                pencil: Deviations | None = None) -> tuple[SaidFact, ...]:
    """Every result that is asked for, vectors by size and direction; `values` are the readings by kind and name."""
    return tuple(_ResultFacts(drawing, values, pencil or Deviations()).facts())


def drawing_facts(drawing: Construction, values: Mapping[str, Mapping[str, Any]],
                  pencil: Deviations) -> tuple[tuple[SaidFact, ...], tuple[SaidFact, ...]]:
    """Given facts and results of a drawing."""
    return given_facts(drawing.mechanism), found_facts(drawing, values, pencil)


def drawing_remarks(drawing: Construction, pencil: Deviations) -> Iterator[Said]:
    """Remarks on the pose and on what is missing, and what the letters of reactions mean."""
    yield from (*([pencil.remark] if pencil.remark else []), *drawing.missing)
    if any(reading.kind in kinds.WITH_FRICTION for reading in drawing.readings):
        force = said("R_ij: the force of link i on link j")
        yield force if drawing.scene.frame_name != FRAME else join((force, said("0: the frame")), "; ")


@dataclass(frozen=True)
class _ResultFacts:
    """The results of a construction, as facts."""

    drawing: Construction
    values: Mapping[str, Mapping[str, Any]]
    pencil: Deviations

    @property
    def scene(self) -> Scene:
        return self.drawing.scene

    def facts(self) -> Iterator[SaidFact]:
        """Yield the facts: motion first, then places, then forces; without those that the scene gives, except for the
        turning of a link that several drives prescribe, or one of another link."""
        turning = {drive.link for drive in self.scene.drives if drive.on == FRAME}
        prescribed = {(reading.kind, reading.of) for reading in self.drawing.readings if reading.given is not None
                      and (reading.of in turning or not reading.kind.turning)}
        for fact in facts(self.values):
            if not ((fact.kind, fact.of) in prescribed or self._is_superseded(fact) or self._is_of_its_point(fact)):
                yield from self._in_words(fact)
        extreme = self.scene.assembly.extreme if self.scene.assembly else None
        if extreme and extreme.time_ratio:
            yield SaidFact(RESULTS, "K", digits(extreme.time_ratio), arrange(""))

    def _in_words(self, fact: Fact) -> Iterator[SaidFact]:
        """Yield a fact in words; no words if sheets show it otherwise."""
        kind, of, loads = fact.kind, fact.of, self.scene.loads
        if kind in MOVING:
            yield self._quantity(fact, self._motion_symbol(fact))
        elif kind in (kinds.POLE, kinds.POLE_HEADING, *kinds.PATHS):
            yield from self._of_places(fact)
        elif kind in kinds.REACTIONS or kind in kinds.WITH_FRICTION.values():
            yield from [] if kind.single else [self._quantity(fact, self._reaction_symbols[of])]
        elif kind.way and loads:
            yield self._quantity(fact, balance_letter(loads.named_balances[of]))

    @property
    def _largest(self) -> dict[Dimension, float]:
        """The size of the largest vector of each dimension; rounding is negligible relative to it."""
        largest = dict[Dimension, float]()
        for name, results in self.values.items():
            kind = kinds.kind_of(name)
            if not kind.single:
                largest[kind.dimension] = max(largest.get(kind.dimension, 0.0), largest_size(results))
        return largest

    def _is_superseded(self, fact: Fact) -> bool:
        """Whether another kind says the same of the same thing, and better: with friction, and not by the lever."""
        kind = fact.kind
        if kind in kinds.WITH_FRICTION:
            return fact.of in self.values.get(kinds.WITH_FRICTION[kind], {})
        ways = [kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER]
        return bool(kind.way) and any(
            fact.of in self.values.get(better, {}) for better in kinds.KINDS.values()
            if better.way in ways[:ways.index(kind.way)] and better.single == kind.single)

    def _is_of_its_point(self, fact: Fact) -> bool:
        """Whether a slide moves along the frame, so that its point tells the same: v_P, not v (5 along frame)."""
        of_point = {kinds.SLIDE_VELOCITY: kinds.VELOCITY, kinds.SLIDE_ACCELERATION: kinds.ACCELERATION}.get(fact.kind)
        return of_point is not None and any(
            slide.name == fact.of and slide.along == FRAME and slide.at in self.values.get(of_point, {})
            for slide in self.scene.slides)

    def _quantity(self, fact: Fact, symbol: Said | str) -> SaidFact:
        """A number with its sign, or a vector by its size and the angle at which it points."""
        kind, value, deviation = fact.kind, fact.value, self._deviation(fact)
        measure = unit(kind.dimension.sheet_unit(self.scene.units))
        if kind.single:
            return SaidFact(RESULTS, symbol, digits(value), measure, kind, fact.of, _relative(deviation, value))
        size = magnitude(*value)
        least = max(self._largest[kind.dimension], deviation.value if deviation else 0.0)
        size = size if size > ZERO_TOL * least else 0.0
        tail = arrange("{0} ∠ {1}°", measure, direction_angle(*value, count=DIGITS)) if size else measure
        return SaidFact(RESULTS, symbol, digits(size), tail, kind, fact.of, _relative(deviation, size))

    def _deviation(self, fact: Fact) -> Deviation | None:
        """Drawing error of a result."""
        return self.pencil.results.get(fact.kind, {}).get(fact.of)

    def _motion_symbol(self, fact: Fact) -> Said | str:
        """v_B, omega_3; of a slide its pair in brackets."""
        letter = fact.kind.dimension.letter
        if fact.kind.pair:
            slide = next(slide for slide in self.scene.slides if slide.name == fact.of)
            return arrange("{0} ({1})", letter, slide_named(slide))
        return f"{letter}_{fact.of}"

    @property
    def _reaction_symbols(self) -> dict[str, Said | str]:
        """R_12 and where it acts, by the name of the reaction in results."""
        return {force.name: said("{0} at {1}", force.letter, force.point) if force.sort in ("at", "slide")
                else force.letter for force in pair_forces(self.scene)}

    def _of_places(self, fact: Fact) -> Iterator[SaidFact]:
        """Poles by their places, paths by their radii of curvature, inflection circles by their diameters."""
        kind, of, value = fact.kind, fact.of, fact.value
        length, point = unit(self.scene.units.length), of.partition(" ")[0]

        def state(symbol: str, value: Said, measure: Said = length, size: Any = None) -> SaidFact:
            return SaidFact(RESULTS, symbol, value, measure, kind, of, _relative(self._deviation(fact), size))

        def distance(symbol: str, start: tuple[Any, Any]) -> SaidFact:
            size = magnitude(value[0] - start[0], value[1] - start[1])
            return state(symbol, digits(size), size=size)

        if kind == kinds.POLE:
            yield state(pole_letter(self.scene.link_pair(of)), coordinates(value))
        elif kind == kinds.POLE_HEADING:
            angle = direction_angle(*value, count=DIGITS, turn=180)
            yield state(pole_letter(self.scene.link_pair(of)), said("at infinity, towards {0}°", angle), unit(""))
        elif kind == kinds.CENTRE:
            yield distance(f"rho_{point}", point_place(self.scene, point))
        elif kind == kinds.CUSP:
            yield state(f"rho_{point}", digits(0.0))
        elif kind == kinds.STRAIGHT:
            yield state(f"rho_{point}", said("infinite"), unit(""))
        elif kind == kinds.ACCELERATION_CENTRE:
            yield state(f"Q_{of}", coordinates(value))
        elif kind == kinds.INFLECTION and of in self.values.get(kinds.MOTION_POLE, {}):
            yield distance(f"d_{of}", self.values[kinds.MOTION_POLE][of])


def _relative(deviation: Deviation | None, size: Any) -> float | None:
    """Relative error of a drawn result; None if it is unknown, or the result is zero."""
    if deviation is None or not isinstance(size, float | int) or not size:
        return None
    return deviation.value / abs(size)


GIVEN_DIGITS = 6  # significant ones of what the scene says
LENGTH_DIGITS = 5  # of a distance or an angle between points: finer than any pencil
ANGLE_PLACES = 9  # of degrees: what is less is rounding
MIN_TOLD_ERROR = 0.01  # of a result: what a pencil is off by is told from there on
MAX_TABLE_ROWS = 40  # of a load that are told one by one: more are a curve
LENGTHS, FRAME_LENGTHS, DRIVES, WHEELS, MASSES, LOADS = (
    said("Links"), said("Frame"), said("Drive"), said("Wheels and profiles"), said("Masses"), said("Loads"))


class SaidFact(NamedTuple):
    """One quantity: its symbol and its value in the scene's units, all in words; `topic` is what it is told under.

    Of a result `kind` and `of` are its name, `relative` how far off the pencil draws it, beside its own size.
    """

    topic: Said
    symbol: Said | str
    value: Said
    unit: Said
    kind: str = ""
    of: str = ""
    relative: float | None = None

    @property
    def quantity(self) -> Said:
        """The fact with its unit."""
        return join((self.symbol, "=", self.value, *([self.unit] if self.unit else [])), " ")

    @property
    def text(self) -> Said:
        """The fact, with its error where that is worth telling."""
        if self.relative is None or self.relative <= MIN_TOLD_ERROR:
            return self.quantity
        percent = Deviation(100 * self.relative).text if self.relative < 1 else ">99"
        return arrange("{0} ± {1} %", self.quantity, percent)


def topic_texts(facts: Sequence[SaidFact]) -> Iterator[Said]:
    """The facts as paragraphs, each with its topic."""
    return (arrange("{0}: {1}", topic, text) for topic, text in topics(facts))


def topics(facts: Sequence[SaidFact]) -> Iterator[tuple[Said, Said]]:
    """The facts topic by topic, those of one unit in a row with the unit behind the last."""
    for topic in dict.fromkeys(fact.topic for fact in facts):
        of_topic = [fact for fact in facts if fact.topic == topic]
        texts = [join((fact.symbol, "=", fact.value), " ") if follower and fact.unit and follower.unit == fact.unit
                 else fact.text for fact, follower in zip(of_topic, [*of_topic[1:], None], strict=True)]
        yield topic, join(texts)


def dimensions(scene: Scene) -> tuple[SaidFact, ...]:
    """Dimensions that place a mechanism in its pose: the sides of its links, its frame, and the positions of its
    drives."""
    return (*(fact for _, _, fact in link_lengths(scene)), *_frame_dimensions(scene), *_guides(scene),
            *(fact for drive in scene.drives for fact in _drive_pose(scene, drive)))


def given_facts(scene: Scene) -> tuple[SaidFact, ...]:
    """Everything that is given of a mechanism in its pose: dimensions, drives, wheels, masses and loads."""
    return (*(fact for _, _, fact in link_lengths(scene)), *_frame_dimensions(scene), *_guides(scene),
            *_drives(scene), *_wheels(scene), *_masses(scene), *_loads(scene))


def machine_facts(scene: Scene) -> tuple[SaidFact, ...]:
    """Given facts of a machine over its cycle: masses and loads, with the laws of changing ones."""
    return (*_masses(scene), *_loads(scene, over_cycle=True))


def link_lengths(scene: Scene) -> Iterator[tuple[str, str, SaidFact]]:
    """The distances of each moving link's points, enough of them to draw it: between which points, and the fact."""
    for link, names in scene.links.items():
        if link != FRAME:
            base, *further = _apart(scene, names)
            for place, name in enumerate(further):
                for start in (base, *further[:place])[:2]:
                    yield start, name, _length(scene, LENGTHS, start + name, _distance(scene, start, name))


def _frame_dimensions(scene: Scene) -> Iterator[SaidFact]:
    """Yield the places of the frame's points from the first, along x and y; and those of points that a scene drives."""
    named = [*_apart(scene, scene.links.get(FRAME, ())), *(name for name in scene.motions)]
    for name in named[1:]:
        (x, y), (u, v) = point_place(scene, name), point_place(scene, named[0])
        yield SaidFact(FRAME_LENGTHS, named[0] + name, coordinates((_clean(x - u, scene), _clean(y - v, scene)),
                                                               LENGTH_DIGITS), _length_unit(scene))


def _guides(scene: Scene) -> Iterator[SaidFact]:
    """Yield the directions of the frame's guides, and their distances from the first of its points."""
    base = next(iter(scene.links.get(FRAME, ())), None)
    for slide in scene.slides:
        if slide.along != FRAME:
            continue
        dx, dy = map(float, slide.direction)
        yield SaidFact(FRAME_LENGTHS, said("guide at {0}", slide.at), _degrees(dx, dy), unit(""))
        if base is not None:
            (x, y), (u, v) = point_place(scene, slide.at), point_place(scene, base)
            if offset := _clean(((x - u) * dy - (y - v) * dx) / math.hypot(dx, dy), scene):
                yield _length(scene, FRAME_LENGTHS, f"e_{slide.at}", abs(offset))


def _drives(scene: Scene) -> Iterator[SaidFact]:
    """The pose of each drive and its rates, and the given motions of points."""
    for drive in scene.drives:
        yield from _drive_pose(scene, drive)
        per = (scene.units.length if drive.slides else "rad") + "/s"
        if drive.rpm is not None:
            yield SaidFact(DRIVES, "n", given_number(drive.rpm), unit("1/min"))
        velocity, acceleration = zip(rate_letters(drive), drive.rates, (per, per + "²"), strict=True)
        for letter, rate, symbol in (velocity, acceleration) if drive.rates[1] else (velocity,):
            yield SaidFact(DRIVES, letter, given_number(rate), unit(symbol))
    for name, motion in scene.motions.items():
        for letter, vector, per in (("v", motion.velocity, "/s"), ("a", motion.acceleration, "/s²")):
            yield SaidFact(DRIVES, f"{letter}_{name}", coordinates(map(float, vector), GIVEN_DIGITS),
                       unit(scene.units.length + per))


def _drive_pose(scene: Scene, drive: Drive) -> Iterator[SaidFact]:
    """The angle at which a driving link stands, or how far a sliding one has gone from the guide's first point."""
    if drive.slides:
        names = _apart(scene, scene.links.get(drive.link, ()))
        start = next((name for name in scene.links.get(drive.on, ()) if name not in names), None)
        slide = next((slide for slide in scene.slides if {slide.link, slide.along} == {drive.link, drive.on}), None)
        if start and slide and start != slide.at:
            yield _length(scene, DRIVES, start + slide.at, _distance(scene, start, slide.at))
        return
    yield from (fact for _, _, fact in _drive_angle(scene, drive))


def drive_angles(scene: Scene) -> Iterator[tuple[str, str, SaidFact]]:
    """The angles of the driving links that turn: each one's pin, its end, and the fact."""
    return (angle for drive in scene.drives if not drive.slides for angle in _drive_angle(scene, drive))


def _drive_angle(scene: Scene, drive: Drive) -> Iterator[tuple[str, str, SaidFact]]:
    """The angle of a driving link from the x-axis, where a pin and an end of it show one."""
    names = _apart(scene, scene.links.get(drive.link, ()))
    pins = [name for name in names if drive.on in scene.links_of[name]]
    ends = [name for name in names if name not in pins]
    if pins and ends:
        (x, y), (u, v) = point_place(scene, pins[0]), point_place(scene, ends[0])
        yield pins[0], ends[0], SaidFact(DRIVES, f"phi_{drive.link}", _degrees(u - x, v - y), unit(""))


def _wheels(scene: Scene) -> Iterator[SaidFact]:
    """Teeth or radii of gears, those of a link's second wheel with a prime; radii of curvature of profiles that touch.
    """
    wheels = dict[str, SaidFact]()
    for size in (size for gear in scene.gears for size in _gear(scene, gear)):
        symbol = str(size.symbol)
        while wheels.setdefault(symbol, size).value != size.value:
            symbol += "'"
            size = size._replace(symbol=symbol)
    yield from wheels.values()
    for contact in scene.contacts:
        for link, centre in zip(contact.links, contact.centres, strict=True):
            if centre and (radius := _distance(scene, centre, contact.at)) > 0:
                yield _length(scene, WHEELS, f"rho_{link_index((link,))}", radius)


def _gear(scene: Scene, gear: Gear) -> Iterator[SaidFact]:
    sizes, letter = (gear.teeth, "z") if gear.teeth else (gear.radii or (gear.radius,), "r")
    for link, size in zip(gear.links, sizes, strict=False):
        symbol = unit("") if gear.teeth else _length_unit(scene)
        yield SaidFact(WHEELS, f"{letter}_{link_index((link,))}", given_number(size), symbol)


def _masses(scene: Scene) -> Iterator[SaidFact]:
    """Masses, and moments of inertia about the mass centres."""
    names = scene.units
    for link, body in scene.loads.masses.items() if scene.loads else ():
        if body.mass:
            yield SaidFact(MASSES, f"m_{link}", given_number(body.mass), unit(names.mass))
        if body.inertia:
            yield SaidFact(MASSES, f"J_{link}", given_number(body.inertia), unit(f"{names.mass}·m²"))
    if scene.loads and any(scene.loads.gravity):
        yield SaidFact(MASSES, "g", coordinates(map(float, scene.loads.gravity), GIVEN_DIGITS), unit("m/s²"))


def _loads(scene: Scene, over_cycle: bool = False) -> Iterator[SaidFact]:
    """Forces and moments by their letters, springs and friction; over a cycle loads that change by their laws."""
    if scene.loads is None:
        return
    units, laws = scene.units, changing_loads(scene.loads) if over_cycle else {}
    for law in spring_laws(scene.loads.forces):
        stiffness, free = spring_numbers(law)
        name = "".join(law.span or ())
        yield SaidFact(LOADS, f"c_{name}", given_number(stiffness), unit(f"{units.force}/{units.length}"))
        yield _length(scene, LOADS, f"l_0{name}", float(free))
    for letter, force in named_forces(scene.loads).items():
        if pull := spring_pull(force):
            yield SaidFact(LOADS, letter, pull, unit(""))
        elif letter not in laws:
            at = said("{0} at {1}", letter, force.at)
            yield SaidFact(LOADS, at, coordinates(map(float, force.value), GIVEN_DIGITS), unit(units.force))
    moments = named_moments(scene.loads)
    for letter, moment in moments.items():
        if letter not in laws:
            yield SaidFact(LOADS, letter, given_number(moment.value), unit(f"{units.force}·m"))
    for letter, load in laws.items():
        if load.table and not load.table.span:
            measure = f"{units.force}·m" if letter in moments else units.force
            yield SaidFact(LOADS, letter, _law(load.table, unit(measure)), unit(""))
    belts = [gear.grip for gear in scene.gears if gear.grip]
    for friction in (*scene.loads.frictions, *(grip.friction for grip in belts)):
        place = friction.slide or friction.links or friction.at
        index = link_index(place) if isinstance(place, tuple) else place
        wedge = friction.wedge
        if friction.gear:
            gear = said("efficiency of {0}", " ".join(place))
            yield SaidFact(LOADS, gear, given_number(1 - friction.coefficient), unit(""))
            continue
        if friction.rolling:
            yield SaidFact(LOADS, arrange("k_{0}", index), given_number(friction.coefficient), _length_unit(scene))
            continue
        yield SaidFact(LOADS, arrange("mu_{0}", index), given_number((wedge or friction).coefficient), unit(""))
        if wedge:
            yield SaidFact(LOADS, "mu'", reduced_coefficient(wedge, friction), unit(""))
        if friction.length:
            yield _length(scene, LOADS, "l", float(friction.length))
        if not friction.slide and not friction.links and friction.radius:
            yield _length(scene, LOADS, f"r_{friction.at}", float(friction.radius))
    for screw in scene.loads.screws:
        for letter, length in (("h", screw.lead), ("r", screw.radius)):
            yield _length(scene, LOADS, letter, float(length))
        yield SaidFact(LOADS, "mu'" if screw.thread else "mu", given_number(screw.coefficient), unit(""))
    for grip in belts:
        yield SaidFact(LOADS, "S_1/S_2", digits(grip.ratio), unit(""))


def spring_pull(force: Force) -> Said | None:
    """The formula of a spring's pull by the distance of its ends; None for another force."""
    span = force.table.span if force.table else None
    return arrange("c_{0} ({0} − l_0{0})", "".join(span)) if span else None


def reduced_coefficient(wedge: Wedge, friction: Friction) -> Said:
    """The coefficient of friction in a wedge, with its formula."""
    return arrange("mu / sin {0}° = {1}", given_number(wedge.degrees / 2), given_number(friction.coefficient))


def _law(table: LoadTable, measure: Said) -> Said:
    """A load by its place or speed, with its unit: its powers, its rows, or how many these are."""
    if table.powers:
        powers = [(c, power) for c, power in zip(table.powers, ("", " v", " v |v|"), strict=False) if c]
        terms = [arrange("{0}{1}{2}", (" + " if k else "", " − " if k else "−")[c < 0], given_number(abs(c)), power)
                 for k, (c, power) in enumerate(powers)]
        return arrange("{0} {1} (v: {2})", join(terms or [given_number(0)], ""), measure, table.over)
    over, given_rows = table.written or (table.over, table.rows)
    limits = [said("zero beyond them")] if table.beyond == ZERO else []
    if table.during in (FORWARD, RETURN):
        limits.append(said("on the forward stroke alone") if table.during == FORWARD else
                      said("on the return stroke alone"))
    law = join((said("a load over {0}, in {1} rows", over, len(given_rows)), *limits))
    rows = join([arrange("({0}; {1})", *map(given_number, row)) for row in given_rows])
    return arrange("{0}: {1} {2}", law, rows, measure) if len(given_rows) <= MAX_TABLE_ROWS else join((law, measure))


def _apart(scene: Scene, names: Sequence[str]) -> list[str]:
    """The points of a link, of those that lie together the first."""
    chosen: list[str] = []
    for name in names:
        if all(_distance(scene, name, other) > ZERO_TOL * scene.extent for other in chosen):
            chosen.append(name)
    return chosen


def point_place(scene: Scene, name: str) -> tuple[float, float]:
    """Place of a point, as floats."""
    x, y = scene.points[name]
    return float(x), float(y)


def _distance(scene: Scene, start: str, end: str) -> float:
    return math.dist(point_place(scene, start), point_place(scene, end))


def _clean(length: float, scene: Scene) -> float:
    """A length, or zero if it is rounding relative to the mechanism."""
    return length if abs(length) > ZERO_TOL * scene.extent else 0.0


def _length(scene: Scene, topic: Said, symbol: str, length: float) -> SaidFact:
    return SaidFact(topic, symbol, digits(length, LENGTH_DIGITS), _length_unit(scene))


def _length_unit(scene: Scene) -> Said:
    return unit(scene.units.length)


def given_number(value: Any) -> Said:
    """A number as the scene gives it."""
    return digits(float(value), GIVEN_DIGITS)


def direction_angle(x: float, y: float, *, count: int = LENGTH_DIGITS, turn: int = 360) -> Said:
    """The angle of a direction from the x-axis, below a turn, without rounding errors."""
    angle = round(math.degrees(math.atan2(y, x)), ANGLE_PLACES) % turn
    return digits(float(f"{angle:.{count}g}") % turn, count)


def _degrees(x: float, y: float) -> Said:
    """The angle of a direction with its unit."""
    return arrange("{0}°", direction_angle(x, y))
