"""Sections: the tables of a scene besides its points, pairs and loads: links, units, motions and questions."""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.mechanism.fields import (
    LINK,
    NAME,
    POINT,
    VECTOR,
    Field,
    Kind,
    Named,
    Names,
    Table,
    asked,
    choice,
)
from graphplan.mechanism.items import Item
from graphplan.mechanism.model import FRAME, Find, Motion, Slide, Units
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS

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


UNITS = Table("the units", (
    Field("length", "the unit of lengths", choice(*METRES), default="mm"),
    Field("force", "the unit of forces; moments are force * m", choice(*NEWTONS), default="N"),
    Field("mass", "the unit of masses; inertia is mass * m^2", choice(*KILOGRAMS), default="kg"),
), lambda row: Units(**row.values))


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
    return tuple(pair.name for pair in names.pairs if isinstance(pair, Slide))


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
