"""Sections: the tables of a scene besides its points and loads: links, slides, drives, motions and questions."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import pi

from graphplan.mechanism.directions import GUIDE
from graphplan.mechanism.fields import (
    BODY,
    LINK,
    NAME,
    NUMBER,
    POINT,
    TWO_LINKS,
    VECTOR,
    Either,
    Field,
    Kind,
    Named,
    Names,
    Row,
    Rows,
    Table,
    asked,
    moving,
    on_link,
)
from graphplan.mechanism.items import Item
from graphplan.mechanism.model import FRAME, Drive, Find, Motion, Pair, Slide, SlidingDrive, TurningDrive
from graphplan.mechanism.numerals import exactly, is_exact, root

# --- links ---------------------------------------------------------------------------------------------------------


def _link(item: Item, names: Names) -> tuple[str, ...]:
    """The points of a link; none of a faulty one."""
    named = item.points(names.points)
    if named == ():
        item.fault("a link without points", 'its points, such as "A B"')
    if not item.key.strip() or not item.key.isprintable():
        item.fault("a link without a readable name", 'a name, such as 1 = "A B"')
    return named or ()


LINKS = Named(Kind("points", _link, {"type": "string", "pattern": rf"^\s*{NAME}(\s+{NAME})*\s*$"}), LINK, least=1)


# --- slides --------------------------------------------------------------------------------------------------------


def _slide(row: Row) -> Slide | None:
    """A sliding pair; the direction's length stays as written."""
    link, along = row["link"], row["along"]
    if link == along:
        row.item.fault(f"link {link} slides along itself", "two different links")
        return None
    return Slide(link, along, row["at"], *row["direction"]) if on_link(row, link, "the sliding link") else None


SLIDES = Rows(Table("a sliding pair", (
    Field("link", "the sliding link", LINK, 'the sliding link, such as link = "3"'),
    Field("along", "the link with the guide", LINK, 'the link with the guide, such as along = "2"'),
    Field("at", "a point of the sliding link on the guide line", POINT,
          'a point of the sliding link on the guide line, such as at = "B"'),
    Field("direction", "the guide's direction: a vector, an angle in degrees, or two points", GUIDE,
          'the guide\'s direction: a vector, an angle in degrees, or two points "O A"'),
), _slide), remedy="one slide between two links", once=lambda slide: (
    frozenset((slide.link, slide.along)), f"slide between links {slide.link} and {slide.along}"))


def has_slide(row: Row, otherwise: str, few: str = "") -> Slide | None:
    """The slide that the key `slide` of a row names; a fault where there is none, unless slides have their own."""
    item, (link, along) = row.items["slide"], row["slide"]
    guides = {(slide.link, slide.along): slide for slide in row.names.slides}
    if (link, along) in guides or not item.faults.none_in("slides", "links"):
        return guides.get((link, along))
    known = [f'slide = ["{one}", "{other}"]' for one, other in sorted(guides)]
    instead = few + ", ".join(known) if known else otherwise
    meant = f'perhaps slide = ["{along}", "{link}"]' if (along, link) in guides else instead
    item.fault(f"no slide of link {link} along link {along}", meant)
    return None


# --- drives --------------------------------------------------------------------------------------------------------


def _turning(row: Row) -> TurningDrive | None:
    link, base, rpm = row["link"], row["relative_to"], row.values.get("rpm")
    if link == base:
        row.item.fault(f"link {link} is driven relative to itself", "another link, or no relative_to for the frame")
        return None
    if rpm:
        row.names.irrational.append(f"{row.items['rpm'].where}: rpm (2 pi/60)")
    omega = row["omega"] if rpm is None else float(rpm / 30 * Fraction(pi)) if rpm else rpm
    return TurningDrive(link, base, omega, row["alpha"], rpm)


def _sliding(row: Row) -> SlidingDrive | None:
    slide = has_slide(row, "[[slides]] with it", "one of ")
    if slide is None:
        return None
    if (row["speed"] or row["acceleration"]) and not _length_is_rational(slide.direction):
        row.names.irrational.append(f"{row.item.where}: actuator along a direction of irrational length")
    return SlidingDrive(slide.link, slide.along, row["speed"], row["acceleration"])


def _length_is_rational(direction: Pair) -> bool:
    x, y = exactly(direction)
    return is_exact(direction) and root(x * x + y * y)[1]


def _driven(drive: Drive) -> tuple[frozenset[str], str]:
    """The two links that a drive is between."""
    return frozenset(drive.links), "drive between links {} and {}".format(*drive.links)


DRIVES = Rows(Either((Table("a turning drive", (
    Field("link", "the driven link", moving("the frame is driven"), 'the driven link, such as link = "1"'),
    Field("omega", "its angular velocity in rad/s, counter-clockwise positive", NUMBER),
    Field("rpm", "its angular velocity in turns a minute, instead of omega", NUMBER),
    Field("alpha", "its angular acceleration in rad/s^2", NUMBER, default=0),
    Field("relative_to", "the link that it turns relative to", BODY, default=FRAME),
), _turning, either=("omega", "rpm"), remedy="either omega in rad/s or rpm"), Table("a sliding actuator", (
    Field("slide", "the sliding link and the link with the guide", TWO_LINKS,
          'the sliding link and the guide\'s, such as slide = ["3", "2"]'),
    Field("speed", "the speed along the direction, in length/s", NUMBER, "a length per second, such as speed = 0.5"),
    Field("acceleration", "the acceleration along the direction, in length/s^2", NUMBER, default=0),
), _sliding))), remedy="one drive between two links", once=_driven)


# --- motions and questions -----------------------------------------------------------------------------------------


def _moved(point: str, item: Item, names: Names) -> None:
    """A fault where a point cannot have a given motion."""
    if point not in names.points:
        item.faults.unknown(item.where, "point", point, names.points)
    elif point in names.links.get(FRAME, ()):
        item.fault(f"{point} is a point of the frame, which stands still", "a point of moving links only")
    elif point not in names.held and item.faults.none_in("links"):
        item.fault(f"no link has the point {point}", "a point of a link")


MOTIONS = Named(Table("a motion", (
    Field("velocity", "its velocity, in length/s", VECTOR, "two components, such as velocity = [10, 5]"),
    Field("acceleration", "its acceleration, in length/s^2", VECTOR, default=[0, 0]),
), lambda row: Motion(**row.values)), POINT, _moved)


def _still(point: object, item: Item, names: Names) -> bool:
    """Whether a point that is asked for has no motion, as no link has it; that is a fault."""
    lonely = point in names.points and point not in names.held and item.faults.none_in("links")
    if lonely:
        item.fault(f"no link has the point {point}, so it has no motion", "a point of a link")
    return lonely


def _frame(name: object, item: Item, names: Names) -> bool:
    """Whether it is the frame of which something is asked; that is a fault."""
    if name == FRAME:
        item.fault("the frame stands still", f"a moving {item.key.removesuffix('s')}")
    return name == FRAME


def _slides(names: Names) -> tuple[str, ...]:
    return tuple(slide.name for slide in names.slides)


def _pairs(names: Names) -> Iterator[str]:
    """The joints and the slides."""
    yield from (p for p in names.points if sum(p in points for points in names.links.values()) > 1)
    yield from _slides(names)


_POINTS = asked("point", '["A", "C"]', lambda names: names.points, lambda names: names.movable,
                entry=POINT, wrong=_still)
FIND = Table("what is asked for", (
    Field("velocity", 'the points whose velocities are asked for, or "all"', _POINTS, default=[]),
    Field("acceleration", 'the points whose accelerations are asked for, or "all"', _POINTS, default=[]),
    Field("links", 'the links whose angular velocities and accelerations are asked for, or "all"; without it those '
          "of which two points are asked for",
          asked("link", '["2", "3"]', lambda names: names.moving, entry=LINK, after=("links",), wrong=_frame)),
    Field("slides", 'the slides (such as "3 along 2") whose velocities and accelerations are asked for, or "all"; '
          "without it those whose point is asked for",
          asked("slide", '["3 along 2"]', _slides, after=("links", "slides"), wrong=_frame)),
    Field("reactions", 'the joints and slides (such as "3 along 2") whose reactions are asked for, or "all"',
          asked("joint or slide", '["A", "3 along 2"]', lambda names: [*_pairs(names)], lambda names: None,
                many="joints and slides", after=("slides", "links", "points"))),
), lambda row: Find(**row.values))
