"""A linkage as another program draws it, and tidied alike for all: what coincides is one, what is held is frame.

Points have the keys that the file knows them by; a link is the points that it holds rigidly together.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations

from graphplan.importing.tolerances import ANGLE_TOL, DECIMAL_TOL, DIRECTION_TOL, LINE_TOL, PLACE_TOL, THOUSANDTH
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.units import METRES, Units

Way = tuple[str, str] | complex
"""The direction of a guide: from one point to another, or a vector."""

MAX_LINKS, MAX_POINTS = 300, 1500  # links, and points that they have together
MAX_DISTANCE = 1e9  # from the origin


@dataclass(frozen=True)
class SketchGuide:
    """A link that slides along another, its point `at` on the guide line.

    Or two links that roll on each other about the two points `way`, the first `at`; their `gear` is as TOML writes it:
    `teeth = [1, 2]`, `belt = "open"`.
    """

    link: str
    along: str
    at: str
    way: Way
    gear: tuple[str, ...] = ()


@dataclass(frozen=True)
class Slot:
    """A pin that slides in a slot of a link, and turns in it."""

    at: str
    along: str
    way: Way


@dataclass(frozen=True)
class SketchDrive:
    """A drive: the rate as TOML writes it (`rpm = 15`), of a link, or of the link that holds two points; `on` another.

    One that `slides` drives the guide of its two links. `told` says where the rate is from, or that it is a guess.
    """

    link: str | tuple[str, str]
    rate: str
    told: str = ""
    on: str = FRAME
    slides: bool = False


@dataclass(frozen=True)
class SketchMass:
    """A link's mass, its inertia about the centre of mass, and that point."""

    mass: float
    inertia: float
    centre: str


@dataclass(frozen=True)
class SketchForce:
    """A constant force on a point of a link; one that turns with the link points to another point of it."""

    link: str
    at: str
    value: complex
    towards: str = ""


@dataclass
class LinkageSketch:
    """A linkage as it was read, in `notes` what could not be determined, in `left_out` how much of what a scene has no
    place for, in `contents` what was read."""

    program: str
    title: str = ""
    length: str = ""
    places: dict[str, complex] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=dict)
    called: dict[str, str] = field(default_factory=dict)
    fixed: dict[str, None] = field(default_factory=dict)
    guides: list[SketchGuide] = field(default_factory=list)
    slots: list[Slot] = field(default_factory=list)
    drives: list[SketchDrive] = field(default_factory=list)
    masses: dict[str, SketchMass] = field(default_factory=dict)
    forces: list[SketchForce] = field(default_factory=list)
    gravity: bool = False
    units: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)
    contents: Counter[str] = field(default_factory=Counter)

    def point(self, key: str, at: complex, name: str = "") -> str:
        """Put a point; its key.

        Fails with `ValueError` where it lies too far away.
        """
        if not abs(at) < MAX_DISTANCE:
            raise ValueError(f"a point lies at {at.real:g}, {at.imag:g}")
        self.places[key], self.names[key] = at, name
        return key

    def link(self, points: Iterable[str], key: str = "", name: str = "") -> str:
        """Add a link; return its key, which is made if it is empty or taken.

        Fails with `ValueError` if there are too many.
        """
        number = len(self.links)
        if number == MAX_LINKS:
            raise ValueError(f"it has more than {MAX_LINKS} links")
        while not key or key in self.links or key == FRAME:
            key, number = f"link {number}", number + 1
        self.links[key], self.called[key] = [], name
        self.hold(key, *points)
        return key

    def hold(self, link: str, *points: str) -> None:
        """Give a link further points; fails with `ValueError` where there are too many."""
        if sum(map(len, self.links.values())) + len(points) > MAX_POINTS:
            raise ValueError(f"its links have more than {MAX_POINTS} points")
        self.links[link] = [*dict.fromkeys([*self.links[link], *points])]

    def spot(self, link: str, at: complex, name: str) -> str:
        """The point of a link at a place; a new one if the link has no point there."""
        key = next((key for key in self.links[link] if abs(self.places[key] - at) <= PLACE_TOL * self.extent), "")
        if not key:
            key = self.point(f"{name} of {link}", at, name)
            self.hold(link, key)
        return key

    def heading(self, angle: float, whose: str, length: float = 0.0) -> complex:
        """The direction of an angle in radians; one that three decimals rounded, its own or those of the ends of a
        `length`, has the multiple of 15 degrees that it plainly is."""
        plain = math.radians(15 * round(math.degrees(angle) / 15))
        missed = abs(angle - plain)
        rounded = length * missed <= THOUSANDTH if length else abs(angle - round(plain, 3)) <= DECIMAL_TOL
        if DIRECTION_TOL < missed <= ANGLE_TOL and rounded:
            self.note(f"{whose} at {math.degrees(angle):.7g} degrees is plainly at {math.degrees(plain):.7g}")
            angle = plain
        return complex(round(math.cos(angle), 14), round(math.sin(angle), 14))

    def note(self, told: str) -> None:
        """Note what could not be determined, once."""
        if told not in self.notes:
            self.notes.append(told)

    @property
    def bodies(self) -> dict[str, list[str]]:
        """The links with their points, the frame among them."""
        return {**self.links, FRAME: [*self.fixed]}

    def holders(self, point: str) -> list[str]:
        """The bodies that have a point."""
        return [key for key, points in self.bodies.items() if point in points]

    @cached_property
    def extent(self) -> float:
        """The larger of width and height; 1 of a single point."""
        xs, ys = [at.real for at in self.places.values()], [at.imag for at in self.places.values()]
        return max(max(xs) - min(xs), max(ys) - min(ys)) if xs and max(xs) - min(xs) + max(ys) - min(ys) else 1.0

    def vector(self, way: Way) -> complex:
        """The direction of a guide as a vector."""
        return self.places[way[1]] - self.places[way[0]] if isinstance(way, tuple) else way

    @property
    def freedoms(self) -> int:
        """Chebyshev's count of its mobility."""
        counts = Counter(point for points in self.bodies.values() for point in points)
        joints = 2 * sum(count - 1 for count in counts.values())
        return 3 * len(self.links) - joints - sum(2 - bool(guide.gear) for guide in self.guides)


def tidy(sketch: LinkageSketch) -> LinkageSketch:
    """The sketch itself, with links that are rigid together as one, pins in slots as blocks, and no loose pieces."""
    _join(sketch)
    _rigid(sketch)
    _slide(sketch)
    _find_driven(sketch)
    _drop_loose_pieces(sketch)
    slides = {(guide.link, guide.along) for guide in sketch.guides}
    sketch.drives = [drive for drive in sketch.drives if {str(drive.link), drive.on} <= {*sketch.links, FRAME}
                     and drive.link != FRAME and (not drive.slides or (drive.link, drive.on) in slides)]
    drop_loads(sketch)
    used = {point for points in sketch.bodies.values() for point in points}
    used |= {point for guide in sketch.guides if isinstance(guide.way, tuple) for point in guide.way}
    sketch.places = {key: at for key, at in sketch.places.items() if key in used}
    return sketch


def drop_loads(sketch: LinkageSketch) -> None:
    """Leave out masses and forces of links that are no more."""
    before = len(sketch.masses) + len(sketch.forces)
    sketch.masses = {key: mass for key, mass in sketch.masses.items() if key in sketch.links}
    sketch.forces = [force for force in sketch.forces if force.link in sketch.links]
    sketch.left_out["loads of links that are no more"] += before - len(sketch.masses) - len(sketch.forces)


def _join(sketch: LinkageSketch) -> None:
    """Points of one link that coincide are one."""
    for points in [*sketch.links.values()]:
        for first, second in combinations([*points], 2):
            if first != second and abs(sketch.places[first] - sketch.places[second]) <= PLACE_TOL * sketch.extent:
                _replace_point(sketch, second, first)


def _replace_point(sketch: LinkageSketch, old: str, new: str) -> None:
    def with_new(way: Way) -> Way:
        return (new if way[0] == old else way[0], new if way[1] == old else way[1]) if isinstance(way, tuple) else way

    for key, points in sketch.links.items():
        sketch.links[key] = [*dict.fromkeys(new if point == old else point for point in points)]
    if old in sketch.fixed:
        del sketch.fixed[old]
        sketch.fixed[new] = None
    sketch.masses = {key: replace(mass, centre=new if mass.centre == old else mass.centre)
                     for key, mass in sketch.masses.items()}
    sketch.forces = [replace(force, at=new if force.at == old else force.at,
                             towards=new if force.towards == old else force.towards) for force in sketch.forces]
    sketch.guides = [replace(guide, at=new if guide.at == old else guide.at, way=with_new(guide.way))
                     for guide in sketch.guides]
    sketch.slots = [replace(slot, at=new if slot.at == old else slot.at, way=with_new(slot.way))
                    for slot in sketch.slots]


def _rigid(sketch: LinkageSketch) -> None:
    """Bodies that share two points are one, and so are three of which each two share another point."""
    while together := next(_found_rigid(sketch), None):
        into = FRAME if FRAME in together else together[0]
        for body in together:
            if body != into:
                absorb(sketch, body, into)


def _found_rigid(sketch: LinkageSketch) -> Iterator[tuple[str, ...]]:
    bodies = {key: {*points} for key, points in sketch.bodies.items()}
    at: dict[str, list[str]] = {}
    for key, points in bodies.items():
        for point in points:
            at.setdefault(point, []).append(key)
    shared: dict[tuple[str, str], set[str]] = {}
    for point, keys in at.items():
        for pair in combinations(sorted(keys), 2):
            shared.setdefault(pair, set()).add(point)
    yield from (pair for pair, points in shared.items() if len(points) > 1)
    beside: dict[str, set[str]] = {}
    for first, second in shared:
        beside.setdefault(first, set()).add(second)
        beside.setdefault(second, set()).add(first)
    for first, second in sorted(shared):
        for third in sorted(beside[first] & beside[second]):
            if third > second and len(shared[first, second] | shared[first, third] | shared[second, third]) == 3:
                yield first, second, third


def absorb(sketch: LinkageSketch, link: str, into: str) -> None:
    """Give the points of a link, and all that is said of it, to another."""
    points = sketch.links.pop(link)
    name = sketch.called.pop(link)
    if into == FRAME:
        sketch.fixed |= dict.fromkeys(points)
    else:
        sketch.links[into] = [*dict.fromkeys([*sketch.links[into], *points])]
        sketch.called[into] = sketch.called[into] or name

    def key_now(key: str) -> str:
        return into if key == link else key

    if mass := sketch.masses.pop(link, None):
        _add_mass(sketch, into, mass)
    sketch.forces = [replace(force, link=key_now(force.link)) for force in sketch.forces]
    if loads := [force for force in sketch.forces if force.link == FRAME]:
        sketch.left_out["forces on the frame"] += len(loads)
        sketch.forces = [force for force in sketch.forces if force.link != FRAME]
    guides = [replace(guide, link=key_now(guide.link), along=key_now(guide.along)) for guide in sketch.guides]
    sketch.guides = [guide for guide in guides if guide.link != guide.along]
    sketch.slots = [replace(slot, along=key_now(slot.along)) for slot in sketch.slots]
    sketch.drives = [replace(drive, link=drive.link if isinstance(drive.link, tuple) else key_now(drive.link),
                             on=key_now(drive.on))
                     for drive in sketch.drives]
    sketch.drives = [drive for drive in sketch.drives if drive.link not in (FRAME, drive.on)]


def _add_mass(sketch: LinkageSketch, link: str, mass: SketchMass) -> None:
    """Give a link a further mass, with that which it has, about the centre of both."""
    if link == FRAME:
        sketch.left_out["masses on the frame"] += 1
        return
    masses = [mass, *([sketch.masses[link]] if link in sketch.masses else [])]
    total, metre = sum(mass.mass for mass in masses), float(METRES[sketch.length or Units.length])
    centre = sketch.places[mass.centre]
    centre += sum(mass.mass * (sketch.places[mass.centre] - centre) for mass in masses) / (total or 1.0)
    inertia = sum(mass.inertia + mass.mass * (metre * abs(sketch.places[mass.centre] - centre)) ** 2 for mass in masses)
    sketch.masses[link] = SketchMass(total, inertia, sketch.spot(link, centre, f"S_{sketch.called[link]}"))


def _slide(sketch: LinkageSketch) -> None:
    """A pin in a slot carries a block; two pins of a link in one slot let it slide alone."""
    slots = [replace(slot, way=_plain(sketch, slot) if slot.along == FRAME else slot.way)
             for slot in sketch.slots if slot.at not in sketch.bodies[slot.along]
             and abs(sketch.vector(slot.way)) > PLACE_TOL * sketch.extent]
    sketch.left_out["slots of no length, or of a point of their own link"] += len(sketch.slots) - len(slots)
    sketch.guides = [guide for guide in sketch.guides if abs(sketch.vector(guide.way)) > PLACE_TOL * sketch.extent]
    while slots:
        slot = slots.pop(0)
        holders = [key for key in sketch.holders(slot.at) if key != slot.along]
        twin = next(((candidate, key) for candidate in slots for key in holders if candidate.along == slot.along
                     and key in sketch.holders(candidate.at) and _on_one_line(sketch, slot, candidate)), None)
        if twin:
            slots.remove(twin[0])
            sketch.guides.append(_guide(sketch, twin[1], slot))
            continue
        block = next((key for key in holders if sketch.links.get(key) == [slot.at] and not _slides(sketch, key)), "")
        if len(holders) == (block != ""):
            sketch.note(f"{sketch.names[slot.at] or 'a pin'} slides in a slot, but no link has it: left out")
            continue
        block = block or sketch.link([slot.at])
        sketch.guides.append(SketchGuide(block, slot.along, slot.at, slot.way))
    sketch.slots = []
    for link in [key for key, points in sketch.links.items() if len(points) == 1 and not _slides(sketch, key)]:
        del sketch.links[link], sketch.called[link]  # it only turns about its point


def _plain(sketch: LinkageSketch, slot: Slot) -> complex:
    """The direction of a slot on the frame, without what its ends were rounded by."""
    vector = sketch.vector(slot.way)
    plain = sketch.heading(cmath.phase(vector), f"the guide of {sketch.names[slot.at] or 'a pin'}", abs(vector))
    return _level(vector) if abs(vector / (abs(vector) or 1.0) - plain) <= DIRECTION_TOL else plain


def _level(way: complex) -> complex:
    """A direction, of length 1 where it is level or upright."""
    return way if way.real and way.imag else way / abs(way)


def _slides(sketch: LinkageSketch, link: str) -> bool:
    return any(link in (guide.link, guide.along) for guide in sketch.guides)


def _guide(sketch: LinkageSketch, link: str, slot: Slot) -> SketchGuide:
    """The guide of a link that slides alone; of the frame's pins it is the other link that slides."""
    if link != FRAME:
        return SketchGuide(link, slot.along, slot.at, slot.way)
    ends = slot.way if isinstance(slot.way, tuple) else ()
    at = next((point for point in ends if point in sketch.links[slot.along]), "")
    if not at:
        at = sketch.point(f"{slot.at} on {slot.along}", sketch.places[slot.at], sketch.names[slot.at])
        sketch.hold(slot.along, at)
    return SketchGuide(slot.along, FRAME, at, slot.way)


def _on_one_line(sketch: LinkageSketch, slot: Slot, other: Slot) -> bool:
    ahead, extent = sketch.vector(slot.way), sketch.extent
    across = [sketch.vector(other.way), sketch.places[other.at] - sketch.places[slot.at]]
    return slot.at != other.at and all(abs((ahead.conjugate() * vector).imag) <= LINE_TOL * abs(ahead) * extent
                                       for vector in across)


def _find_driven(sketch: LinkageSketch) -> None:
    """The links that drives mean by two of their points."""
    drives: list[SketchDrive] = []
    for drive in sketch.drives:
        link: str | tuple[str, str] = drive.link
        if isinstance(link, tuple):
            pair = link
            link = next((key for key, points in sketch.links.items() if {*pair} <= {*points}), "")
        if link and link not in (earlier.link for earlier in drives if earlier.on == drive.on):
            drives.append(replace(drive, link=link))
    sketch.drives = drives


def _drop_loose_pieces(sketch: LinkageSketch) -> None:
    """Leave out unconnected pieces: the piece with the frame stays, or else the largest."""
    bodies = {key: points for key, points in sketch.bodies.items() if key != FRAME or points}
    beside: dict[str, set[str]] = {key: set() for key in bodies}
    at: dict[str, list[str]] = {}
    for key, points in bodies.items():
        for point in points:
            at.setdefault(point, []).append(key)
    pairs = [*at.values(), *([guide.link, guide.along] for guide in sketch.guides)]
    for keys in pairs:
        for key in keys:
            beside.setdefault(key, set()).update(keys)
    pieces: list[set[str]] = []
    for key in beside:
        if not any(key in piece for piece in pieces):
            piece, new = {key}, [key]
            while new:
                new += (further := beside[new.pop()] - piece)
                piece |= further
            pieces.append(piece)
    if not pieces:
        return
    largest = next((piece for piece in pieces if FRAME in piece and len(piece) > 1), None) or max(pieces, key=len)
    lone = [key for key in sketch.links if key not in largest]
    for key in lone:
        points = sketch.links.pop(key)
        if len(points) > 1:
            named = " ".join(sketch.names[point] or "({0.real:g}, {0.imag:g})".format(sketch.places[point])
                             for point in points)
            sketch.note(f"a link without connection to others was left out: {sketch.called[key] or named}")
    sketch.guides = [guide for guide in sketch.guides if guide.link in largest and guide.along in largest]
    if FRAME not in largest:
        sketch.fixed = {}
    else:
        points_on_links = {point for points in sketch.links.values() for point in points}
        points_of_guides = {point for guide in sketch.guides if isinstance(guide.way, tuple) for point in guide.way}
        sketch.fixed = {point: None for point in sketch.fixed if point in points_on_links | points_of_guides} or dict(
            [*sketch.fixed.items()][:1])
