"""Friction as a scene writes it: in journals, slides and contacts, the losses of teeth, the resistance to rolling."""

from __future__ import annotations

import math
from fractions import Fraction

from graphplan.mechanism.fields import Either, Field, Kind, Rows, SceneNames, Table, TableRow
from graphplan.mechanism.items import SceneItem
from graphplan.mechanism.loads import Screw
from graphplan.mechanism.model import Contact, Friction, Number, Wedge
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.pairs.gear import Gear
from graphplan.mechanism.pairs.sliding import has_slide
from graphplan.mechanism.values import AMOUNT, DISTANCE, POINT, TWO_LINKS

RATIONAL_HALF_SINES = {Fraction(60): Fraction(1, 2), Fraction(180): Fraction(1)}  # by the whole angle, in degrees
EXAMPLES = {"coefficient": "0.1", "rolling": "0.5, the arm of the resistance"}


def _journal(row: TableRow) -> Friction | None:
    at = row["at"]
    if row.names.link_counts[at] < 2 and row.item.faults.none_in("links"):
        return row.items["at"].fault(f"{at} is not a joint of two links", "a joint")
    return Friction(at, None, row["radius"], row["coefficient"])


def _rubbing(row: TableRow) -> Friction | None:
    slide, coefficient, degrees = has_slide(row, "a joint and its radius"), row["coefficient"], row.values.get("wedge")
    length = row.values.get("length") or Fraction(0)
    if slide is None:
        return None
    if degrees is None:
        return Friction("", slide.links, Fraction(0), coefficient, length=length)
    return Friction("", slide.links, Fraction(0), coefficient / _half_sine(row, degrees),
                    wedge=Wedge(degrees, coefficient), length=length)


def _half_sine(row: TableRow, degrees: Fraction) -> Number:
    """The sine of half the angle of a wedge; of the rational ones there are but two."""
    if degrees in RATIONAL_HALF_SINES:
        return RATIONAL_HALF_SINES[degrees]
    row.names.irrational.append(f"{row.items['wedge'].where}: the sine of half the angle")
    return math.sin(math.radians(degrees / 2))


def _sliding(row: TableRow) -> Friction | None:
    item, links = row.items["contact"], row["contact"]
    contacts = [pair for pair in row.names.pairs if isinstance(pair, Contact)]
    contact = next((pair for pair in contacts if {*pair.links} == {*links}), None)
    if contact is None:
        instead = ", ".join('contact = ["{}", "{}"]'.format(*pair.links) for pair in contacts) or "[[contacts]] with it"
        return item.fault("no contact of links {} and {}".format(*links), instead) if item.faults.none_in(
            "links", "contacts") else None
    wanted, amiss, motion = ("rolling", "coefficient", "rolls: nothing slides in it") if contact.rolling else (
        "coefficient", "rolling", "slides: it does not roll")
    if row.values.get(amiss) is not None or row.values.get(wanted) is None:
        return item.fault(f"the contact {contact.name} {motion}", f"{wanted} = {EXAMPLES[wanted]}")
    return Friction("", None, Fraction(0), row[wanted], contact.links, rolling=contact.rolling)


def _tooth_friction(row: TableRow) -> Friction | None:
    links, loss = row["gear"], 1 - row["efficiency"]
    gears = [pair for pair in row.names.pairs if isinstance(pair, Gear) and not pair.belt]
    gear = next((pair for pair in gears if {*pair.links} == {*links}), None)
    if gear is None:
        instead = ", ".join('gear = ["{}", "{}"]'.format(*pair.links) for pair in gears) or "[[gears]] with it"
        return row.items["gear"].fault("no teeth between links {} and {}".format(*links),
                                       instead) if row.item.faults.none_in("links", "gears") else None
    least = -gear.factors[0] / gear.factors[1] if gear.internal else 0
    if row["efficiency"] <= least:
        return row.items["efficiency"].fault(
            f"no force between a ring and a wheel nearly as large passes on {number_text(row['efficiency'])}",
            f"an efficiency above {number_text(least)}, the ratio of their sizes")
    return Friction("", None, Fraction(0), loss, gear=gear.links)


def _belt_friction(row: TableRow) -> None:
    """The belt holds by friction from now on: nothing is lost in it."""
    links, groove = row["belt"], row.values.get("wedge")
    belts = [pair for pair in row.names.pairs if isinstance(pair, Gear) and pair.belt and pair.radii and not pair.grip]
    belt = next((pair for pair in belts if {*pair.links} == {*links}), None)
    if belt is None:
        instead = ", ".join('belt = ["{}", "{}"]'.format(*pair.links) for pair in belts) or "one in [[gears]]"
        if row.item.faults.none_in("links", "gears"):
            row.items["belt"].fault("no other belt with radii between links {} and {}".format(*links), instead)
        return
    coefficient = row["coefficient"]
    wedge = None if groove is None else Wedge(groove, coefficient)
    reduced = coefficient if groove is None else coefficient / _half_sine(row, groove)
    if not reduced:
        row.items["coefficient"].fault("a belt without friction passes on nothing", "a number above 0, such as 0.3")
    elif all(centre in row.names.places for centre in belt.centres):
        row.names.irrational.append(f"{row.item.where}: the pull of the belt")
        friction = Friction("", None, Fraction(0), reduced, links, wedge)
        holding = belt.gripping(friction, row.names.places)
        row.names.pairs = tuple(holding if pair is belt else pair for pair in row.names.pairs)


def _screw(row: TableRow) -> Screw | None:
    slide, thread, coefficient = has_slide(row, "a slide", key="screw"), row.values.get("thread"), row["coefficient"]
    if slide is None:
        return None
    wedge = None if thread is None else Wedge(thread, coefficient)
    reduced = coefficient if thread is None else coefficient / math.cos(math.radians(thread / 2))
    row.names.irrational.append(f"{row.item.where}: the angle of the thread")
    screw = Screw(slide.links, row["lead"], row["radius"], reduced, wedge)
    if screw.slope * float(reduced) < 1:
        return screw
    return row.items["lead"].fault("the lead angle and the friction angle are 90 degrees or more: nothing drives it",
                                   "a lead that is small beside the radius")


def _read_efficiency(item: SceneItem, names: SceneNames) -> Fraction | None:
    efficiency = item.number()
    if efficiency is None or 0 < efficiency <= 1:
        return efficiency
    return item.fault(f"an efficiency of {number_text(efficiency)}", "a number above 0 and up to 1, such as 0.98")


def _read_wedge(item: SceneItem, names: SceneNames) -> Fraction | None:
    degrees = item.number()
    if degrees is None or 0 < degrees <= 180:
        return degrees
    return item.fault(f"a wedge of {number_text(degrees)} degrees", "an angle above 0 and up to 180, which is flat")


def _friction_pair(friction: Friction | Screw) -> tuple[object, str]:
    """The pair that has the friction."""
    if isinstance(friction, Screw):
        return friction, "screw of slide {} along {}".format(*friction.links)
    if friction.contact:
        return friction.contact, "friction of contact {} {}".format(*friction.contact)
    if friction.gear:
        return friction.gear, "losses of gear {} {}".format(*friction.gear)
    if friction.slide is None:
        return friction.at, f"friction of joint {friction.at}"
    return friction.slide, "friction of slide {} along {}".format(*friction.slide)


_COEFFICIENT = Field("coefficient", "the coefficient of friction", AMOUNT,
                     "the coefficient of friction, such as coefficient = 0.1")
_WEDGE = Kind("degrees", _read_wedge, {"type": "number", "exclusiveMinimum": 0, "maximum": 180})
FRICTION = Rows(Either((Table("friction in a journal", (
    Field("at", "the joint", POINT, 'a joint, such as at = "B", or slide = ["3", "2"]'),
    Field("radius", "the journal's radius", AMOUNT, "the journal's radius"),
    _COEFFICIENT,
), _journal), Table("friction in a slide", (
    Field("slide", "the sliding link and the link with the guide", TWO_LINKS, 'a slide, such as slide = ["3", "2"]'),
    _COEFFICIENT,
    Field("wedge", "of a guide in the form of a V: its angle, by which the coefficient becomes f' = f / sin(angle / 2)",
          _WEDGE),
    Field("length", "of a sleeve or a block that is pressed at its edges: how long it bears, half on each side of its "
          "point", DISTANCE),
), _rubbing), Table("friction in a contact", (
    Field("contact", "the two links that touch", TWO_LINKS, 'two links that touch, such as contact = ["2", "3"]'),
    Field("coefficient", "of a contact that slides: the coefficient of friction", AMOUNT, default=None),
    Field("rolling", "of a contact that rolls: the resistance to rolling, as the arm by which the normal force lies "
          "beside the point of contact", AMOUNT, default=None),
), _sliding), Table("losses of teeth", (
    Field("gear", "the two links whose teeth mesh", TWO_LINKS, 'two links whose teeth mesh, such as gear = ["1", "2"]'),
    Field("efficiency", "how much of the power the teeth pass on, whichever wheel drives",
          Kind("share", _read_efficiency, {"type": "number", "exclusiveMinimum": 0, "maximum": 1}),
          "how much of the power the teeth pass on, such as efficiency = 0.98"),
), _tooth_friction), Table("friction of a belt", (
    Field("belt", "the two links whose pulleys the belt runs on", TWO_LINKS, 'two links, such as belt = ["1", "2"]'),
    _COEFFICIENT,
    Field("wedge", "of a belt in a groove: its angle, by which the coefficient becomes f' = f / sin(angle / 2)",
          _WEDGE),
), _belt_friction), Table("a screw that moves a slide", (
    Field("screw", "the sliding link and the link with the guide, along the screw's axis", TWO_LINKS,
          'a slide, such as screw = ["3", "2"]'),
    Field("lead", "how far a turn leads the sliding link on", DISTANCE, "the lead, such as lead = 5"),
    Field("radius", "the mean radius of the thread", DISTANCE, "the mean radius of the thread"),
    _COEFFICIENT,
    Field("thread", "of an angular thread: its angle, by which the coefficient becomes f' = f / cos(angle / 2)",
          _WEDGE),
), _screw))), once=_friction_pair, remedy="one for each joint, slide or contact")
