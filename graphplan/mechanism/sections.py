"""Sections: the tables of a scene besides points, pairs and sheet: links, units, motions, questions, loads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import combinations, permutations
from math import pi
from typing import Any

from graphplan.errors import by_name
from graphplan.mechanism import model
from graphplan.mechanism.directions import GUIDE
from graphplan.mechanism.fields import Either, Field, Kind, Named, Names, Row, Rows, Table, on_link
from graphplan.mechanism.items import Item
from graphplan.mechanism.load_fields import DIRECTION, EITHER, TABLE, table
from graphplan.mechanism.model import FRAME, Contact, Drive, Gear, Number, Pair, Slide
from graphplan.mechanism.numerals import shown
from graphplan.mechanism.pairs.gear import LOADS as LOADS
from graphplan.mechanism.pairs.sliding import has_slide
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.mechanism.values import (
    AMOUNT,
    FLAG,
    LINK,
    NAME,
    NUMBER,
    POINT,
    TWO_LINKS,
    VECTOR,
    asked,
    choice,
    moving,
)

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
), lambda row: model.Units(**row.values))


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
), lambda row: model.Motion(**row.values)), POINT, _moved)


def _still(point: object, item: Item, names: Names) -> bool:
    """Whether a point that is asked for has no motion, as no link has it; that is a fault."""
    lonely = point in names.points and point not in names.held and item.faults.none_in("links")
    if lonely:
        item.fault(f"no link has the point {point}, so it has no motion", "a point of a link")
    return lonely


def _frame(name: object, item: Item, names: Names) -> bool:
    """Whether it is the frame of which something is asked; that is a fault."""
    if name == FRAME:
        item.fault("the frame stands still", "a moving link")
    return name == FRAME


def _slides(names: Names) -> tuple[str, ...]:
    return tuple(pair.name for pair in names.pairs if isinstance(pair, Slide))


def _pairs(names: Names) -> Iterator[str]:
    """The joints, the slides, the gears and the contacts."""
    yield from (p for p in names.points if names.held[p] > 1)
    yield from dict.fromkeys(pair.name for pair in names.pairs if isinstance(pair, Slide | Gear | Contact))


def _links(names: Names) -> tuple[str, ...]:
    """All links, the ground last, be it a link or not."""
    return (*sorted(names.moving, key=by_name), FRAME)


def _traced(names: Names) -> tuple[str, ...]:
    """The moving points on each of their links, such as M on 2."""
    return tuple(f"{point} on {link}" for link in _links(names)[:-1]
                 for point in sorted(names.links[link], key=by_name) if point in names.movable)


def _untraced(name: object, item: Item, names: Names) -> bool:
    """Whether a point on a link that is asked for has no path; that is a fault."""
    point, on, link = name.partition(" on ") if isinstance(name, str) else ("", "", "")
    if not on or point not in names.points or link not in names.bodies:
        return False
    if link == FRAME or point in names.links.get(FRAME, ()):
        item.fault(f"{point} is a point of the frame, which stands still", "a moving point of a link, such as M on 2")
    elif point not in names.links[link]:
        instead = "one of " + ", ".join(sorted(names.links[link], key=by_name))
        item.fault(f"{point} is no point of link {link}", instead)
    else:
        return False
    return True


def _turning(names: Names) -> tuple[str, ...]:
    """The links that can turn: no chain of slides ties them to the frame."""
    still, pairs = {FRAME}, [pair.links for pair in names.pairs if isinstance(pair, Slide) and pair.turns_alike]
    while more := {link for links in pairs if still & {*links} for link in links} - still:
        still |= more
    return tuple(link for link in _links(names) if link not in still)


def _unturned(link: object, item: Item, names: Names) -> bool:
    """Whether a link that is asked for never turns; that is a fault."""
    if link in names.moving and link not in _turning(names):
        item.fault(f"link {link} only slides and never turns, so it has no inflection circle", "a link that turns")
        return True
    return _frame(link, item, names)


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
    Field("poles", 'the pairs of links (such as "2 frame", of link 2 relative to the frame) whose instant centres are '
          'asked for, or "all"',
          asked("pair of links", '["2 frame", "2 3"]', lambda names: [*map(" ".join, permutations(_links(names), 2))],
                lambda names: tuple(map(" ".join, combinations(_links(names), 2))), many="pairs of links",
                after=("links",)), default=[]),
    Field("reactions", 'the joints, slides (such as "3 along 2"), gears and contacts (such as "2 3") whose reactions '
          'are asked for, or "all"',
          asked("joint, slide, gear or contact", '["A", "3 along 2"]', lambda names: [*_pairs(names)],
                lambda names: None, many="joints, slides, gears and contacts",
                after=("slides", "gears", "contacts", "links", "points"))),
    Field("curvature", 'the points on links (such as "M on 2") the centres of curvature of whose paths are asked for, '
          'or "all"',
          asked("point on a link", '["M on 2"]', _traced, many="points on links", after=("links", "points"),
                wrong=_untraced), default=[]),
    Field("inflection", 'the links whose inflection circles are asked for, or "all"',
          asked("link", '["2"]', _turning, entry=LINK, after=("links", "slides"), wrong=_unturned), default=[]),
), lambda row: model.Find(**row.values))


# --- masses, forces, moments ---------------------------------------------------------------------------------------


def _weighed(link: str, item: Item, names: Names) -> None:
    """A fault where a link can have no mass."""
    if link == FRAME:
        item.fault("the frame is given a mass", "a moving link")
    elif link not in names.links:
        item.faults.unknown(item.where, "link", link, names.links)


MASSES = Named(Table("a mass", (
    Field("mass", "its mass", AMOUNT, "a mass, such as mass = 10"),
    Field("inertia", "its inertia about the centre of mass, in mass * m^2", AMOUNT, default=0),
    Field("centre", "its centre of mass, a point of that link", POINT, 'a point of the link, such as centre = "S"'),
), lambda row: model.Mass(**row.values) if on_link(row, row.item.key) else None), LINK, _weighed)

_LOADED = moving("a load on the frame moves nothing")
_STILL: Pair = (Fraction(0), Fraction(0))


def _force(row: Row) -> model.Force | None:
    """A force; of one with a table the value is filled in once the whole scene is read."""
    changing, found = "over" in row.items, table(row)
    if not on_link(row, row["on"]) or (changing and found is None):
        return None
    if "direction" in row.items and not changing:
        return row.items["direction"].fault("a constant force has its direction in its value", "value, or over")
    if not changing:
        return model.Force(row["on"], row["at"], row["value"])
    if "direction" not in row.items:
        return row.item.fault("direction is missing", "the direction of positive values, such as direction = [1, 0]")
    vector, through, _ = row["direction"]
    return model.Force(row["on"], row["at"], _STILL, found, vector, through)


def _moment(row: Row) -> model.Moment | None:
    """A moment; of one with a table the value is filled in once the whole scene is read."""
    changing, found = "over" in row.items, table(row)
    if changing and found is None:
        return None
    return model.Moment(row["on"], row.values.get("value", Fraction(0)), found)


FORCES = Rows(Table("a force", (
    Field("on", "the loaded link", _LOADED, 'the loaded link, such as on = "2"'),
    Field("at", "a point of that link", POINT, 'a point of that link, such as at = "C"'),
    Field("value", "the components of the force", VECTOR),
    DIRECTION, *TABLE,
), _force, either=EITHER, remedy="two components, such as value = [-150, 0], or over and a table"))
MOMENTS = Rows(Table("a moment", (
    Field("on", "the loaded link", _LOADED, 'the loaded link, such as on = "3"'),
    Field("value", "the moment in force * m, counter-clockwise positive", NUMBER),
    *TABLE,
), _moment, either=EITHER, remedy="a moment, such as value = 12.0, or over and a table"))


# --- the machine over its cycle ------------------------------------------------------------------------------------


def _speed(row: Row) -> Number | None:
    """The speed of the first drive that a table gives, in rad/s or turns a minute; none where it gives none."""
    first = next((pair for pair in row.names.pairs if isinstance(pair, Drive)), None)
    if "rpm" not in row.items or first is None:
        return row.values.get("speed")
    if first.slides:
        return row.items["rpm"].fault("the first drive slides", "speed, in length/s")
    return float(row["rpm"] / 30 * Fraction(pi))


def _flywheel(row: Row) -> model.Flywheel | None:
    uneven = row.values.get("unevenness")
    if uneven is not None and not 0 < uneven < 2:
        return row.items["unevenness"].fault(f"an unevenness of {shown(uneven)}", "more than 0 and less than 2")
    if ("unevenness" in row.items) == ("inertia" in row.items):
        return row.item.fault("unevenness and inertia are both given" if uneven is not None else
                              "unevenness is missing", "unevenness, or inertia where the unevenness is asked for")
    speed = _speed(row)
    if speed is None:
        return None
    if speed <= 0:
        return row.item.fault(f"a mean speed of {shown(speed)}", "a speed above 0; which way it runs its drive says")
    return model.Flywheel(speed, uneven, row.values.get("inertia"), row["closes"])


FLYWHEEL = Table("a flywheel", (
    Field("speed", "the mean speed of the first drive, in rad/s (in length/s where it slides)", NUMBER),
    Field("rpm", "the same in turns a minute, instead of speed", NUMBER),
    Field("unevenness", "(omega_max - omega_min) / mean, the mean being half their sum", NUMBER),
    Field("inertia", "of a flywheel that is given, in mass * m^2, where the unevenness is asked for", AMOUNT),
    Field("closes", "what closes the cycle: a constant moment on the drive, or a constant factor of the loads that "
          "change", choice("drive", "load"), default="drive"),
), _flywheel, either=("speed", "rpm"), remedy="either speed in rad/s or rpm")


def _run(row: Row) -> model.Run | None:
    if "speed" in row.items and "rpm" in row.items:
        return row.item.fault("speed and rpm are both given", "either speed in rad/s or rpm")
    if row.values.get("travel") == 0:
        return row.items["travel"].fault("a travel of 0 goes nowhere", "degrees or lengths, such as travel = 720")
    return model.Run(_speed(row), row.values.get("travel"), row["stops"])


RUN = Table("a run", (
    Field("speed", "the first drive's speed at its beginning, in rad/s (in length/s where it slides); without it that "
          "of the drive", NUMBER),
    Field("rpm", "the same in turns a minute, instead of speed", NUMBER),
    Field("travel", "how far it is followed, in degrees of the first drive (in lengths where it slides); without it "
          "one turn", NUMBER),
    Field("stops", "true: followed until the machine comes to rest", FLAG, default=False),
), _run)


# --- balance and friction ------------------------------------------------------------------------------------------


def _balance(row: Row) -> model.Balance | None:
    vector, _, written = row["direction"]
    return model.Balance(row["on"], row["at"], vector, written) if on_link(row, row["on"]) else None


_BALANCED = moving("a balance on the frame, which does not move, keeps no motion")
BALANCE = Rows(Either((Table("a moment", (
    Field("link", "the link on which a moment keeps the motion", _BALANCED,
          'the link on which a moment acts, such as link = "1"'),
), lambda row: model.Balance(**row.values)), Table("a force along a line", (
    Field("at", "the point of that link where the force acts", POINT,
          'the point where a force acts, such as at = "B"'),
    Field("on", "the link on which a force keeps the motion", _BALANCED,
          'the link on which it acts, such as on = "1"'),
    Field("direction", "the force's direction: a vector, an angle in degrees, or two points", GUIDE,
          "the force's direction: a vector, an angle in degrees, or two points"),
), _balance))), single=True)


def _journal(row: Row) -> model.Friction | None:
    at = row["at"]
    if row.names.held[at] < 2 and row.item.faults.none_in("links"):
        return row.items["at"].fault(f"{at} is no joint of two links", "a joint")
    return model.Friction(at, None, row["radius"], row["coefficient"])


def _rubbing(row: Row) -> model.Friction | None:
    slide = has_slide(row, "a joint and its radius")
    return model.Friction("", slide.links, Fraction(0), row["coefficient"]) if slide else None


def _sliding(row: Row) -> model.Friction | None:
    item, links = row.items["contact"], row["contact"]
    known = [pair for pair in row.names.pairs if isinstance(pair, Contact)]
    found = next((pair for pair in known if {*pair.links} == {*links}), None)
    if found is None:
        instead = ", ".join('contact = ["{}", "{}"]'.format(*pair.links) for pair in known) or "[[contacts]] with it"
        return item.fault("no contact of links {} and {}".format(*links), instead) if item.faults.none_in(
            "links", "contacts") else None
    if found.rolling:
        return item.fault(f"the contact {found.name} rolls: nothing slides in it", "a contact that slides")
    return model.Friction("", None, Fraction(0), row["coefficient"], found.links)


def _rubbed(friction: model.Friction) -> tuple[object, str]:
    """The pair that has the friction."""
    if friction.contact:
        return friction.contact, "friction of contact {} {}".format(*friction.contact)
    if friction.slide is None:
        return friction.at, f"friction of joint {friction.at}"
    return friction.slide, "friction of slide {} along {}".format(*friction.slide)


_COEFFICIENT = Field("coefficient", "the coefficient of friction", AMOUNT,
                     "the coefficient of friction, such as coefficient = 0.1")
FRICTION = Rows(Either((Table("friction in a journal", (
    Field("at", "the joint", POINT, 'a joint, such as at = "B", or slide = ["3", "2"]'),
    Field("radius", "the journal's radius", AMOUNT, "the journal's radius"),
    _COEFFICIENT,
), _journal), Table("friction in a slide", (
    Field("slide", "the sliding link and the link with the guide", TWO_LINKS, 'a slide, such as slide = ["3", "2"]'),
    _COEFFICIENT,
), _rubbing), Table("friction in a contact", (
    Field("contact", "the two links that touch", TWO_LINKS, 'two links that touch, such as contact = ["2", "3"]'),
    _COEFFICIENT,
), _sliding))), once=_rubbed, remedy="one for each joint, slide or contact")

def loads(read: Mapping[str, Any]) -> model.Loads | None:
    """The loads of a scene, from what is read of its tables; None where it has none of them."""
    if read.keys().isdisjoint(LOADS):
        return None
    return model.Loads(read.get("gravity", _STILL), read.get("masses", {}),
                       *(read.get(table, ()) for table in ("forces", "moments", "balance", "friction")))
