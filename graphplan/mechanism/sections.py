"""Sections: the tables of a scene besides its points, each read into the model."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from math import pi

from graphplan.errors import by_name
from graphplan.mechanism.directions import Misfit, points_of, read_direction, vector
from graphplan.mechanism.items import Item, Vector, described
from graphplan.mechanism.model import (
    FRAME,
    Drive,
    Motion,
    Number,
    Pair,
    Slide,
    SlidingDrive,
    TurningDrive,
    Units,
    Written,
)
from graphplan.mechanism.numerals import root
from graphplan.mechanism.placements import exactly, is_exact

_UNITS = {
    "length": ("mm", "cm", "m", "in", "ft"),
    "force": ("N", "kN", "kgf", "lbf"),
    "mass": ("kg", "g", "t", "lb"),
}


@dataclass
class Names:
    """What the other tables may speak of: point names, the links with their points, coordinates where known."""

    points: Collection[str]
    placed: dict[str, Pair]
    links: dict[str, tuple[str, ...]]
    irrational: list[str] = field(default_factory=list)

    @property
    def bodies(self) -> tuple[str, ...]:
        """The names of all links; the fixed ground may be spoken of where no link is it."""
        return (*self.links, *([FRAME] if FRAME not in self.links else []))


def read_units(item: Item) -> Units:
    """The units of the scene."""
    fields = item.fields(_UNITS, {}) or {}
    units = {key: entry.choice(_UNITS[key]) for key, entry in fields.items()}
    return Units(**{key: unit for key, unit in units.items() if unit is not None})


def read_links(item: Item, points: Collection[str]) -> dict[str, tuple[str, ...]]:
    """The links with their points; of a faulty one only the name."""
    links: dict[str, tuple[str, ...]] = {}
    for name, entry in (item.table() or {}).items():
        named = entry.points(points)
        if named == ():
            entry.fault("a link without points", 'its points, such as "A B"')
        if not name.strip() or not name.isprintable():
            entry.fault("a link without a readable name", 'a name, such as 1 = "A B"')
        links[name] = named or ()
    return links


# --- slides --------------------------------------------------------------------------------------------------------


def read_slides(item: Item, names: Names) -> tuple[Slide, ...]:
    """The sliding pairs; the direction's length stays as written."""
    slides: list[Slide] = []
    for row in item.rows():
        slide = _read_slide(row, names)
        if slide and any({slide.link, slide.along} == {other.link, other.along} for other in slides):
            row.fault(f"a second slide between links {slide.link} and {slide.along}", "one slide between two links")
        elif slide:
            slides.append(slide)
    return tuple(slides)


def _read_slide(row: Item, names: Names) -> Slide | None:
    wanted = {
        "link": 'the sliding link, such as link = "3"',
        "along": 'the link with the guide, such as along = "2"',
        "at": 'a point of the sliding link on the guide line, such as at = "B"',
        "direction": 'the guide\'s direction: a vector, an angle in degrees, or two points "O A"',
    }
    fields = row.fields(wanted, wanted)
    if fields is None:
        return None
    link, along = (fields[key].name_of("link", names.links) for key in ("link", "along"))
    at = fields["at"].name_of("point", names.points)
    guide = read_guide(fields["direction"], names)
    if link is None or along is None or at is None or guide is None:
        return None
    if link == along:
        row.fault(f"link {link} slides along itself", "two different links")
        return None
    if at not in names.links[link]:
        if names.links[link]:
            own = ", ".join(sorted(names.links[link], key=by_name))
            fields["at"].fault(f"{at} is no point of the sliding link {link}", f"one of {own}")
        return None
    return Slide(link, along, at, *guide)


def read_guide(item: Item, names: Names) -> tuple[Pair, tuple[str, str] | None, Written] | None:
    """A guide's direction in this pose, the two points that give it, if points do, and the direction as written."""
    direction = read_direction(item, names.points)
    if direction is None:
        return None
    through = points_of(direction)
    if any(name not in names.placed for name in through):
        place = Fraction(1), Fraction(0)  # the point has its own fault; look for more
        return place, (through[0], through[1]), direction
    try:
        x, y, exact = vector(direction, lambda name: exactly(names.placed[name]))
    except Misfit as misfit:
        item.fault(misfit.what, misfit.instead)
        return None
    if not exact:
        names.irrational.append(f"{item.where}: angle")
    rational = exact and is_exact(*(names.placed[name] for name in through))
    pair: Pair = (x, y) if rational else (float(x), float(y))
    return pair, (through[0], through[1]) if through else None, direction


# --- drives --------------------------------------------------------------------------------------------------------


def read_drives(item: Item, names: Names, slides: Iterable[Slide]) -> tuple[Drive, ...]:
    """The drives, turning and sliding."""
    guides = {(slide.link, slide.along): slide for slide in slides}
    drives: dict[frozenset[str], Drive] = {}
    for row in item.rows():
        sliding = isinstance(row.value, dict) and row.value.keys() & {"slide", "speed", "acceleration"}
        drive = _read_sliding(row, names, guides) if sliding else _read_turning(row, names)
        if drive is None:
            continue
        other = drive.along if isinstance(drive, SlidingDrive) else drive.relative_to
        if frozenset((drive.link, other)) in drives:
            row.fault(f"a second drive between links {drive.link} and {other}", "one drive between two links")
        drives[frozenset((drive.link, other))] = drive
    return tuple(drives.values())


def _read_turning(row: Item, names: Names) -> TurningDrive | None:
    wanted = {"link": 'the driven link, such as link = "1"'}
    fields = row.fields(("link", "omega", "rpm", "alpha", "relative_to"), wanted)
    if fields is None:
        return None
    link = fields["link"].name_of("link", names.links)
    base = fields["relative_to"].name_of("link", names.bodies) if "relative_to" in fields else FRAME
    omega, alpha = _read_speed(row, fields, names), Fraction(0)
    if "alpha" in fields:
        alpha = fields["alpha"].number() or alpha
    if link == FRAME:
        fields["link"].fault("the frame is driven", "a moving link")
    elif link is not None and link == base:
        row.fault(f"link {link} is driven relative to itself", "another link, or no relative_to for the frame")
    elif link is not None and base is not None and omega is not None:
        return TurningDrive(link, base, omega, alpha, fields["rpm"].number() if "rpm" in fields else None)
    return None


def _read_speed(row: Item, fields: dict[str, Item], names: Names) -> Number | None:
    """The angular velocity, from omega or from rpm."""
    if ("omega" in fields) == ("rpm" in fields):
        told = "omega and rpm are both given" if "omega" in fields else "omega is missing"
        row.fault(told, "either omega in rad/s or rpm")
        return None
    if "omega" in fields:
        return fields["omega"].number()
    turns = fields["rpm"].number()
    if not turns:
        return turns
    names.irrational.append(f"{fields['rpm'].where}: rpm (2 pi/60)")
    return float(turns / 30 * Fraction(pi))


def _read_sliding(row: Item, names: Names, guides: dict[tuple[str, str], Slide]) -> SlidingDrive | None:
    wanted = {
        "slide": 'the sliding link and the guide\'s, such as slide = ["3", "2"]',
        "speed": "a length per second, such as speed = 0.5",
    }
    fields = row.fields(("slide", "speed", "acceleration"), wanted)
    if fields is None:
        return None
    pair = read_pair(fields["slide"], names)
    speed, acceleration = fields["speed"].number(), Fraction(0)
    if "acceleration" in fields:
        acceleration = fields["acceleration"].number() or acceleration
    if pair is None or speed is None:
        return None
    slide = guides.get(pair)
    if slide is None and not row.faults.none_in("slides", "links"):
        return None  # the slide may be among those that have faults
    if slide is None:
        known = [f'slide = ["{link}", "{along}"]' for link, along in sorted(guides)]
        meant = [f'slide = ["{link}", "{along}"]' for link, along in guides if (along, link) == pair]
        instead = "perhaps " + meant[0] if meant else "one of " + ", ".join(known) if known else "[[slides]] with it"
        fields["slide"].fault(f"no slide of link {pair[0]} along link {pair[1]}", instead)
        return None
    if (speed or acceleration) and not (is_exact(slide.direction) and _length_is_rational(slide.direction)):
        names.irrational.append(f"{row.where}: actuator along a direction of irrational length")
    return SlidingDrive(*pair, speed, acceleration)


def read_pair(item: Item, names: Names) -> tuple[str, str] | None:
    if not isinstance(item.value, list) or len(item.value) != 2:
        item.fault(f"{described(item.value)} where two links are wanted", 'two links such as ["3", "2"]')
        return None
    one, other = (Item(name, item.where, item.faults).name_of("link", names.links) for name in item.value)
    return None if one is None or other is None else (one, other)


def _length_is_rational(direction: Pair) -> bool:
    x, y = exactly(direction)
    return root(x * x + y * y)[1]


# --- motions and questions -----------------------------------------------------------------------------------------


def read_motions(item: Item, names: Names) -> dict[str, Motion]:
    """The given motions of points."""
    held = {point for link, points in names.links.items() if link != FRAME for point in points}
    motions: dict[str, Motion] = {}
    for point, entry in (item.table() or {}).items():
        fields = entry.fields(("velocity", "acceleration"), {"velocity": "two components, such as velocity = [10, 5]"})
        if point not in names.points:
            item.faults.unknown(entry.where, "point", point, names.points)
        elif point in names.links.get(FRAME, ()):
            entry.fault(f"{point} is a point of the frame, which stands still", "a point of moving links only")
        elif point not in held and entry.faults.none_in("links"):
            entry.fault(f"no link has the point {point}", "a point of a link")
        if fields is not None:
            rest: Vector | None = (Fraction(0), Fraction(0))
            velocity = fields["velocity"].vector()
            acceleration = fields["acceleration"].vector() if "acceleration" in fields else rest
            if velocity is not None and acceleration is not None:
                motions[point] = Motion(velocity, acceleration)
    return motions


def read_question(item: Item, names: Names) -> tuple[str, ...]:
    """The points of which something is asked; "all" are the points of all moving links."""
    fixed = set(names.links.get(FRAME, ()))
    movable = {point for points in names.links.values() for point in points} - fixed
    if item.value == "all":
        return tuple(point for point in names.points if point in movable)
    if not isinstance(item.value, list):
        item.fault(f"{described(item.value)} where a list of points is wanted", 'a list such as ["A", "C"], or "all"')
        return ()
    asked: dict[str, None] = {}
    for entry in item.value:
        point = Item(entry, item.where, item.faults).name_of("point", names.points)
        if point is not None and point not in movable | fixed and item.faults.none_in("links"):
            item.fault(f"no link has the point {point}, so it has no motion", "a point of a link")
        elif point is not None:
            asked[point] = None
    return tuple(asked)


def moving_links(names: Names) -> tuple[str, ...]:
    """The links that are not the frame."""
    return tuple(link for link in names.links if link != FRAME)


def read_asked(item: Item, kind: str, known: Collection[str], *tables: str) -> tuple[str, ...]:
    """The links or slides of which something is asked; "all" are all of them."""
    if not item.faults.none_in("links", *tables):
        return ()  # what is meant may be among those that have faults
    if item.value == "all":
        return tuple(known)
    if not isinstance(item.value, list):
        such = {"link": '["2", "3"]', "slide": '["3 along 2"]'}[kind]
        item.fault(f"{described(item.value)} where a list of {kind}s is wanted", f'a list such as {such}, or "all"')
        return ()
    asked: dict[str, None] = {}
    for entry in item.value:
        if entry == FRAME:
            item.fault("the frame stands still", f"a moving {kind}")
        elif (name := Item(entry, item.where, item.faults).name_of(kind, known)) is not None:
            asked[name] = None
    return tuple(asked)
