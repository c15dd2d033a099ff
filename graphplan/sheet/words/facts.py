"""What is given of a mechanism, and what its construction has found: one list of facts in the field's letters.

Sheets, tasks and keys say the same facts. Lengths are those of the links, whatever the pose was given by: coordinates
say where a mechanism lies, lengths and angles what it is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from graphplan.mechanism.model import FRAME, Drive, Gear, Scene
from graphplan.mechanism.order import named_forces, named_moments
from graphplan.mechanism.springs import spring_laws, spring_numbers
from graphplan.mechanism.units import Dimension
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ResultKind
from graphplan.methods.panels import JointForce, pole_letter, slide_named
from graphplan.phrases import Said, arrange, coordinates, digits, join, said, unit
from graphplan.sheet.plates.annotations import rate_letters
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.sheet.words.lengths import magnitude
from graphplan.sheet.words.rows import Deviation, Deviations, largest_size

GIVEN_DIGITS = 6  # significant ones of what the scene says
LENGTH_DIGITS = 5  # of a distance or an angle between points: finer than any pencil
MIN_TOLD_ERROR = 0.01  # of a result: what a pencil is off by is told from there on
LENGTHS, FRAME_LENGTHS, DRIVES, WHEELS, MASSES, LOADS = (
    said("Links"), said("Frame"), said("Drive"), said("Wheels and profiles"), said("Masses"), said("Loads"))


class Fact(NamedTuple):
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


def topics(facts: Sequence[Fact]) -> Iterator[tuple[Said, Said]]:
    """The facts topic by topic, those of one unit in a row with the unit behind the last."""
    for topic in dict.fromkeys(fact.topic for fact in facts):
        of_topic = [fact for fact in facts if fact.topic == topic]
        texts = [join((fact.symbol, "=", fact.value), " ") if follower and fact.unit and follower.unit == fact.unit
                 else fact.text for fact, follower in zip(of_topic, [*of_topic[1:], None], strict=True)]
        yield topic, join(texts)


# ---- given -----------------------------------------------------------------------------------------------------------


def dimensions(scene: Scene) -> tuple[Fact, ...]:
    """What places a mechanism in its pose: the sides of its links, its frame, and where its drives stand."""
    return (*_link_lengths(scene), *_frame_dimensions(scene), *_guides(scene),
            *(fact for drive in scene.drives for fact in _drive_pose(scene, drive)))


def given_facts(scene: Scene) -> tuple[Fact, ...]:
    """Everything that is given of a mechanism in its pose: dimensions, drives, wheels, masses and loads."""
    return (*_link_lengths(scene), *_frame_dimensions(scene), *_guides(scene), *_drives(scene), *_wheels(scene),
            *_masses(scene), *_loads(scene))


def _link_lengths(scene: Scene) -> Iterator[Fact]:
    """The distances of each moving link's points: enough of them to draw it."""
    for link, names in scene.links.items():
        if link != FRAME:
            base, *further = _apart(scene, names)
            for place, name in enumerate(further):
                for start in (base, *further[:place])[:2]:
                    yield _length(scene, LENGTHS, start + name, _distance(scene, start, name))


def _frame_dimensions(scene: Scene) -> Iterator[Fact]:
    """Where the frame's points lie from the first, along x and y; and where points that a scene drives lie."""
    named = [*_apart(scene, scene.links.get(FRAME, ())), *(name for name in scene.motions)]
    for name in named[1:]:
        (x, y), (u, v) = _place(scene, name), _place(scene, named[0])
        yield Fact(FRAME_LENGTHS, named[0] + name, coordinates((_clean(x - u, scene), _clean(y - v, scene)),
                                                               LENGTH_DIGITS), _length_unit(scene))


def _guides(scene: Scene) -> Iterator[Fact]:
    """Which way the guides of the frame run, and how far they pass the first of its points."""
    base = next(iter(scene.links.get(FRAME, ())), None)
    for slide in scene.slides:
        if slide.along != FRAME:
            continue
        dx, dy = map(float, slide.direction)
        yield Fact(FRAME_LENGTHS, said("guide at {0}", slide.at), _degrees(dx, dy), unit(""))
        if base is not None:
            (x, y), (u, v) = _place(scene, slide.at), _place(scene, base)
            if offset := _clean(((x - u) * dy - (y - v) * dx) / math.hypot(dx, dy), scene):
                yield _length(scene, FRAME_LENGTHS, f"e_{slide.at}", abs(offset))


def _drives(scene: Scene) -> Iterator[Fact]:
    """The pose of each drive and its rates, and the given motions of points."""
    for drive in scene.drives:
        yield from _drive_pose(scene, drive)
        per = (scene.units.length if drive.slides else "rad") + "/s"
        if drive.rpm is not None:
            yield Fact(DRIVES, "n", given_number(drive.rpm), unit("1/min"))
        velocity, acceleration = zip(rate_letters(drive), drive.rates, (per, per + "²"), strict=True)
        for letter, rate, symbol in (velocity, acceleration) if drive.rates[1] else (velocity,):
            yield Fact(DRIVES, letter, given_number(rate), unit(symbol))
    for name, motion in scene.motions.items():
        for letter, vector, per in (("v", motion.velocity, "/s"), ("a", motion.acceleration, "/s²")):
            yield Fact(DRIVES, f"{letter}_{name}", coordinates(map(float, vector), GIVEN_DIGITS),
                       unit(scene.units.length + per))


def _drive_pose(scene: Scene, drive: Drive) -> Iterator[Fact]:
    """The angle at which a driving link stands, or how far a sliding one has gone from the guide's first point."""
    names = _apart(scene, scene.links.get(drive.link, ()))
    if drive.slides:
        start = next((name for name in scene.links.get(drive.on, ()) if name not in names), None)
        slide = next((slide for slide in scene.slides if {slide.link, slide.along} == {drive.link, drive.on}), None)
        if start and slide and start != slide.at:
            yield _length(scene, DRIVES, start + slide.at, _distance(scene, start, slide.at))
        return
    pins = [name for name in names if drive.on in scene.links_of[name]]
    ends = [name for name in names if name not in pins]
    if pins and ends:
        (x, y), (u, v) = _place(scene, pins[0]), _place(scene, ends[0])
        yield Fact(DRIVES, f"phi_{drive.link}", _degrees(u - x, v - y), unit(""))


def _wheels(scene: Scene) -> Iterator[Fact]:
    """Teeth or radii of gears, radii of curvature of profiles that touch."""
    yield from dict.fromkeys(size for gear in scene.gears for size in _gear(scene, gear))
    for contact in scene.contacts:
        for link, centre in zip(contact.links, contact.centres, strict=True):
            if centre and (radius := _distance(scene, centre, contact.at)) > 0:
                yield _length(scene, WHEELS, f"rho_{_index(link)}", radius)


def _gear(scene: Scene, gear: Gear) -> Iterator[Fact]:
    sizes, letter = (gear.teeth, "z") if gear.teeth else (gear.radii or (gear.radius,), "r")
    for link, size in zip(gear.links, sizes, strict=False):
        symbol = unit("") if gear.teeth else _length_unit(scene)
        yield Fact(WHEELS, f"{letter}_{_index(link)}", given_number(size), symbol)


def _masses(scene: Scene) -> Iterator[Fact]:
    """Masses, and moments of inertia about the mass centres."""
    names = scene.units
    for link, body in scene.loads.masses.items() if scene.loads else ():
        if body.mass:
            yield Fact(MASSES, f"m_{link}", given_number(body.mass), unit(names.mass))
        if body.inertia:
            yield Fact(MASSES, f"J_{link}", given_number(body.inertia), unit(f"{names.mass}·m²"))
    if scene.loads and any(scene.loads.gravity):
        yield Fact(MASSES, "g", coordinates(map(float, scene.loads.gravity), GIVEN_DIGITS), unit("m/s²"))


def _loads(scene: Scene) -> Iterator[Fact]:
    """Forces and moments by their letters, and friction."""
    if scene.loads is None:
        return
    for letter, force in named_forces(scene.loads).items():
        at = said("{0} at {1}", letter, force.at)
        yield Fact(LOADS, at, coordinates(map(float, force.value), GIVEN_DIGITS), unit(scene.units.force))
    units = scene.units
    for law in spring_laws(scene.loads.forces):
        stiffness, free = spring_numbers(law)
        name = "".join(law.span or ())
        yield Fact(LOADS, f"c_{name}", given_number(stiffness), unit(f"{units.force}/{units.length}"))
        yield _length(scene, LOADS, f"l_0{name}", float(free))
    for letter, moment in named_moments(scene.loads).items():
        yield Fact(LOADS, letter, given_number(moment.value), unit(f"{scene.units.force}·m"))
    for friction in scene.loads.frictions:
        place = friction.slide or friction.links or friction.at
        yield Fact(LOADS, arrange("mu_{0}", " ".join(place) if isinstance(place, tuple) else place),
                   given_number(friction.coefficient), unit(""))
        if not friction.slide and not friction.links and friction.radius:
            yield _length(scene, LOADS, f"r_{friction.at}", float(friction.radius))


def _index(link: str) -> str:
    """A link as a letter's index: the frame is 0."""
    return "0" if link == FRAME else link


def _apart(scene: Scene, names: Sequence[str]) -> list[str]:
    """The points of a link, of those that lie together the first."""
    chosen: list[str] = []
    for name in names:
        if all(_distance(scene, name, other) > ZERO_TOL * scene.extent for other in chosen):
            chosen.append(name)
    return chosen


def _place(scene: Scene, name: str) -> tuple[float, float]:
    x, y = scene.points[name]
    return float(x), float(y)


def _distance(scene: Scene, start: str, end: str) -> float:
    return math.dist(_place(scene, start), _place(scene, end))


def _clean(length: float, scene: Scene) -> float:
    """A length, or nothing where it is rounding beside the mechanism."""
    return length if abs(length) > ZERO_TOL * scene.extent else 0.0


def _length(scene: Scene, topic: Said, symbol: str, length: float) -> Fact:
    return Fact(topic, symbol, digits(length, LENGTH_DIGITS), _length_unit(scene))


def _length_unit(scene: Scene) -> Said:
    return unit(scene.units.length)


def given_number(value: Any) -> Said:
    """A number as the scene gives it."""
    return digits(float(value), GIVEN_DIGITS)


def _degrees(x: float, y: float) -> Said:
    """The angle of a direction from the x-axis."""
    return arrange("{0}°", digits(round(math.degrees(math.atan2(y, x)), 3) % 360, LENGTH_DIGITS))


# ---- found -----------------------------------------------------------------------------------------------------------

RESULTS = said("Found")
AS_FACTS = {  # the letter of each kind of vector and of each kind of number
    kinds.VELOCITY: "v", kinds.ACCELERATION: "a", kinds.SLIDE_VELOCITY: "v", kinds.SLIDE_ACCELERATION: "a",
    kinds.OMEGA: "omega", kinds.ALPHA: "alpha",
}  # fmt: skip


def found_facts(drawing: Construction, values: Mapping[str, Mapping[str, Any]],
                pencil: Deviations | None = None) -> tuple[Fact, ...]:
    """Every result that is asked for, vectors by size and direction; `values` are the readings by kind and name."""
    return tuple(_ResultFacts(drawing, values, pencil or Deviations()).facts())


@dataclass(frozen=True)
class _ResultFacts:
    """The results of a construction, as facts."""

    drawing: Construction
    values: Mapping[str, Mapping[str, Any]]
    pencil: Deviations

    @property
    def scene(self) -> Scene:
        return self.drawing.scene

    def facts(self) -> Iterator[Fact]:
        """Motion first, then places, then forces; what the scene gives is none of them."""
        prescribed = {(reading.kind, reading.of) for reading in self.drawing.readings if reading.given is not None}
        for name, results in self.values.items():
            kind = kinds.kind_of(name)
            for of, value in results.items():
                if (kind, of) in prescribed or self._is_superseded(kind, of):
                    continue
                if kind in AS_FACTS:
                    yield self._quantity(kind, of, self._motion_symbol(kind, of), value)
                elif kind in (kinds.POLE, kinds.POLE_HEADING, *kinds.PATHS):
                    yield from self._of_places(kind, of, value)
                elif kind in kinds.REACTIONS or kind in kinds.WITH_FRICTION.values():
                    if not kind.single:
                        yield self._quantity(kind, of, self._reaction_symbols[of], value)
                elif kind.way and self.scene.loads:
                    link = self.scene.loads.named_balances[of].link
                    yield self._quantity(kind, of, f"{'T' if kind.single else 'F'}_{link}", value)
        extreme = self.scene.assembly.extreme if self.scene.assembly else None
        if extreme and extreme.time_ratio:
            yield Fact(RESULTS, "K", digits(extreme.time_ratio), arrange(""))

    @cached_property
    def _largest(self) -> dict[Dimension, float]:
        """The size of the largest vector of each dimension, beside which rounding is nothing."""
        largest = dict[Dimension, float]()
        for name, results in self.values.items():
            kind = kinds.kind_of(name)
            if not kind.single:
                largest[kind.dimension] = max(largest.get(kind.dimension, 0.0), largest_size(results))
        return largest

    def _is_superseded(self, kind: ResultKind, of: str) -> bool:
        """Whether another kind says the same of the same thing, and better: with friction, and not by the lever."""
        if kind in kinds.WITH_FRICTION:
            return of in self.values.get(kinds.WITH_FRICTION[kind], {})
        ways = [kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER]
        return bool(kind.way) and any(
            of in self.values.get(better, {}) for better in kinds.KINDS.values()
            if better.way in ways[:ways.index(kind.way)] and better.single == kind.single)

    def _quantity(self, kind: ResultKind, of: str, symbol: Said | str, value: Any) -> Fact:
        """A number with its sign, or a vector by its size and the angle at which it points."""
        symbol_of_unit = unit(kind.dimension.unit(self.scene.units).replace("^2", "²").replace("*", "·"))
        deviation = self.pencil.results.get(kind, {}).get(of)
        if kind.single:
            return Fact(RESULTS, symbol, digits(value), symbol_of_unit, kind, of, _relative(deviation, value))
        size = magnitude(*value)
        size = size if size > ZERO_TOL * self._largest[kind.dimension] else 0.0
        tail = arrange("{0} ∠ {1}°", symbol_of_unit, digits(math.degrees(math.atan2(value[1], value[0])) % 360)) \
            if size else symbol_of_unit
        return Fact(RESULTS, symbol, digits(size), tail, kind, of, _relative(deviation, size))

    def _motion_symbol(self, kind: ResultKind, of: str) -> Said | str:
        """v_B, omega_3; of a slide its pair in brackets."""
        if kind.pair:
            slide = next(slide for slide in self.scene.slides if slide.name == of)
            return arrange("{0} ({1})", AS_FACTS[kind], slide_named(slide))
        return f"{AS_FACTS[kind]}_{of}"

    @cached_property
    def _reaction_symbols(self) -> dict[str, Said | str]:
        """R_12 and where it acts, by the name of the reaction in results: the force on the first-named link."""
        from graphplan.methods.forces.free_bodies import pair_letter  # most scenes have no loads
        from graphplan.methods.forces.groups import pairs

        scene = self.scene
        joints = {JointForce(point, link).name: said("{0} at {1}", pair_letter(pin, link), point)
                  for point, link, pin in pairs(scene)}
        slides = {slide.name: said("{0} at {1}", pair_letter(slide.along, slide.link), slide.at)
                  for slide in scene.slides}
        contacts = {pair.name: pair_letter(*pair.links[::-1]) for pair in scene.contacts}
        return {**joints, **slides, **contacts, **{gear.name: pair_letter(*gear.links[::-1]) for gear in scene.gears}}

    def _of_places(self, kind: ResultKind, of: str, value: Any) -> Iterator[Fact]:
        """Poles by their places, paths by their radii of curvature, inflection circles by their diameters."""
        length = unit(self.scene.units.length)
        deviation = self.pencil.results.get(kind, {}).get(of)
        if kind in (kinds.POLE, kinds.POLE_HEADING):
            letter = pole_letter(self.scene.link_pair(of))
            if kind == kinds.POLE:
                yield Fact(RESULTS, letter, coordinates(value), length, kind, of)
            else:
                angle = digits(math.degrees(math.atan2(value[1], value[0])) % 180)
                yield Fact(RESULTS, letter, said("at infinity, towards {0}°", angle), unit(""), kind, of)
        elif kind == kinds.CENTRE:
            x, y = _place(self.scene, of.partition(" ")[0])
            radius = magnitude(value[0] - x, value[1] - y)
            yield Fact(RESULTS, f"rho_{of.partition(' ')[0]}", digits(radius), length, kind, of,
                       _relative(deviation, radius))
        elif kind in (kinds.STRAIGHT, kinds.CUSP):
            yield Fact(RESULTS, f"rho_{of.partition(' ')[0]}", digits(0.0) if kind == kinds.CUSP else said("infinite"),
                       length if kind == kinds.CUSP else unit(""), kind, of)
        elif kind == kinds.ACCELERATION_CENTRE:
            yield Fact(RESULTS, f"Q_{of}", coordinates(value), length, kind, of)
        elif kind == kinds.INFLECTION and of in self.values.get(kinds.MOTION_POLE, {}):
            u, v = self.values[kinds.MOTION_POLE][of]
            diameter = magnitude(value[0] - u, value[1] - v)
            yield Fact(RESULTS, f"d_{of}", digits(diameter), length, kind, of, _relative(deviation, diameter))


def _relative(deviation: Deviation | None, size: Any) -> float | None:
    """How far off a result is drawn beside its own size; None where that is not told, or the result is nothing."""
    if deviation is None or not isinstance(size, float | int) or not size:
        return None
    return deviation.value / abs(size)
