"""Loads as a scene writes them: masses, forces, moments, what balances them, friction, and the table [governor].

Those that change have rows in the scene, or in a file of two columns beside it.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import pi
from typing import Any

from graphplan.mechanism.fields import (
    AMOUNT,
    DISTANCE,
    GUIDE,
    LINK,
    NUMBER,
    POINT,
    TWO_LINKS,
    VECTOR,
    Either,
    Field,
    Kind,
    Named,
    Rows,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    choice,
    describe,
    is_on_link,
    moving,
    name_list,
    suggestion,
)
from graphplan.mechanism.load_values import TWO_POINTS, spring_forces
from graphplan.mechanism.loads import (
    BOTH,
    FORWARD,
    HOLD,
    RETURN,
    SPEED,
    SPEED_OF,
    STROKE_OF,
    TRAVEL,
    ZERO,
    LoadTable,
    Screw,
)
from graphplan.mechanism.model import (
    FRAME,
    Balance,
    Contact,
    Drive,
    Force,
    Friction,
    Governor,
    Loads,
    Mass,
    Moment,
    Number,
    Pair,
    Slide,
    Wedge,
)
from graphplan.mechanism.numbers import decimal, number_text
from graphplan.mechanism.pairs.gear import LOADS, Gear
from graphplan.mechanism.pairs.sliding import has_slide

MAX_ROWS = 100_000  # rows of a table
MAX_BYTES = 8_000_000  # bytes of a file
ROWS_EXAMPLE = "values = [[0, 0], [30, -1200], [360, 0]]"
VALUE_OR_OVER = "value", "over"
COLUMNS = "lines of a place and a value, with a comma, a semicolon, a tab or blanks between them"
Pairs = tuple[tuple[Fraction, Fraction], ...]


def _read_over(item: SceneItem, names: SceneNames) -> str | None:
    name = item.text("what the load changes with", 'over = "travel", or a slide such as over = "3 along frame"')
    slides = [pair.name for pair in names.pairs if isinstance(pair, Slide)]
    choices = [TRAVEL, *slides, SPEED, *(of + slide for of in (SPEED_OF, STROKE_OF) for slide in slides)]
    if name is None or name in choices or not item.faults.none_in("slides"):
        return name
    return item.fault(f"there is no slide {name}", suggestion(name, choices, "slide"))


def _read_values(item: SceneItem, names: SceneNames) -> Pairs | None:
    if not isinstance(item.value, list):
        return item.fault(f"{describe(item.value)} where rows are wanted", ROWS_EXAMPLE)
    if len(item.value) > MAX_ROWS:
        return item.fault(f"{len(item.value)} rows", f"at most {MAX_ROWS}")
    rows = [item.with_value(row).vector() for row in item.value]
    return None if None in rows else tuple(row for row in rows if row)


def _read_powers(item: SceneItem, names: SceneNames) -> tuple[Fraction, ...] | None:
    if not isinstance(item.value, list) or not 1 <= len(item.value) <= 3:
        return item.fault(f"{describe(item.value)} where up to three numbers are wanted",
                          "powers = [c0, c1, c2] of the load c0 + c1 v + c2 v |v|")
    coefficients = [item.with_value(value).number() for value in item.value]
    return None if None in coefficients else tuple(c for c in coefficients if c is not None)


def _read_file(item: SceneItem, names: SceneNames) -> Pairs | None:
    name = item.text("the name of a file", 'the name of a file beside the scene, such as file = "indicator.csv"')
    if name is None:
        return None
    if os.path.isabs(name) or ".." in name.replace("\\", "/").split("/") or not name.endswith((".csv", ".txt")):
        return item.fault(f"{describe(name)} is not the name of a table beside the scene",
                          "a file .csv or .txt in its folder")
    try:
        with open(os.path.join(names.folder, name), "rb") as file:
            text = file.read(MAX_BYTES + 1).decode("utf-8-sig")
    except (OSError, ValueError) as error:  # ValueError: no UTF-8, or a path that no file system has
        why = getattr(error, "strerror", None) or "it is no text in UTF-8"
        return item.fault(f"{name} cannot be read ({why})", "a readable file beside the scene")
    if len(text) > MAX_BYTES:
        return item.fault(f"{name} is larger than {MAX_BYTES // 10**6} MB", f"a table of at most {MAX_ROWS} rows")
    rows = _columns(item.with_value(name), text)
    if rows is not None:
        names.files[name] = rows
    return rows


def _columns(item: SceneItem, text: str) -> Pairs | None:
    """The two columns of a text; a line of words at its top is its head."""
    lines = [(number, line.partition("#")[0].strip()) for number, line in enumerate(text.splitlines(), 1)]
    lines = [(number, line) for number, line in lines if line]
    split = _split([line for _, line in lines])
    rows: list[tuple[Fraction, Fraction]] = []
    for number, line in lines:
        row = [_numeral(cell) for cell in split(line)]
        if len(row) == 2 and row[0] is not None and row[1] is not None:
            rows.append((row[0], row[1]))
        elif rows or number > lines[0][0] or any(cell is not None for cell in row):
            return item.fault(f"{item.value}, line {number}: {describe(line)} is not a place and a value", COLUMNS)
        if len(rows) > MAX_ROWS:
            return item.fault(f"{item.value} has more than {MAX_ROWS} rows", f"at most {MAX_ROWS}")
    return tuple(rows)


def _split(lines: list[str]) -> Any:
    """Return the function that splits a line into cells: at commas, unless these are decimal ones and blanks, tabs or
    semicolons separate the cells."""
    for mark in ";\t":
        if any(mark in line for line in lines):
            return lambda line: line.split(mark)
    if all(line.count(",") == 1 and not re.search(r"\d\s+[\d+-]", line) for line in lines):
        return lambda line: line.split(",")
    return str.split


def _numeral(cell: str) -> Fraction | None:
    number = decimal(cell.strip().replace(",", ".")) if re.search(r"\d", cell) else None
    return number if isinstance(number, Fraction) else None


OVER = Field("over", 'what the load changes with: "travel" (degrees or lengths of the first drive from this pose), a '
             'slide such as "3 along frame" (its position, once around), "speed" (of the first drive), "speed of '
             '3 along frame", or "stroke of 3 along frame" (from 0 to 1 between its end positions, along its '
             'direction)', Kind("travel · slide · speed · stroke", _read_over, {"type": "string"}))
TABLE = (
    OVER,
    Field("values", "the rows of the load: place and value, straight between them; two rows at one place are a jump",
          Kind("list of rows", _read_values,
               {"type": "array", "items": VECTOR.schema, "minItems": 2, "maxItems": MAX_ROWS})),
    Field("file", "the same rows in a file .csv or .txt beside the scene, in two columns",
          Kind("file name", _read_file, {"type": "string", "pattern": r"\.(csv|txt)$"})),
    Field("powers", "of a load over a speed v instead of rows: [c0, c1, c2] of c0 + c1 v + c2 v |v|",
          Kind("one to three numbers", _read_powers, {"type": "array", "items": NUMBER.schema, "minItems": 1,
                                                      "maxItems": 3})),
    Field("during", "of a load over a stroke: on which way it acts, forward being along the slide's direction",
          choice(FORWARD, RETURN, BOTH)),
    Field("beyond", "the load outside its rows: that of the nearest end, or none", choice(HOLD, ZERO)),
)
DIRECTION = Field("direction", "of a force with over: the direction in which it is positive, fixed in the plane, or by "
                  "two points with which it turns", GUIDE)


def table(row: TableRow) -> LoadTable | None:
    """The table of a load, checked; None where the load is constant, or the table has a fault."""
    over, sources = row.values.get("over"), [key for key in ("values", "file", "powers") if key in row.items]
    if over is None:
        for key in [*sources, *(key for key in ("during", "beyond") if key in row.items)][:1]:
            row.items[key].fault(f"{key} needs the key over", 'over = "travel"')
        return None
    if len(sources) != 1:
        problem = f"{' and '.join(sources)} are both given" if sources else "values is missing"
        return row.item.fault(problem, f"one of values, file or powers, such as {ROWS_EXAMPLE}")
    if over == "travel" and not any(isinstance(pair, Drive) for pair in row.names.pairs):
        return row.items["over"].fault("the scene has no drive", "a slide, or a scene with a [[drive]]")
    item, where = row.items[sources[0]], row.item.where
    if sources == ["powers"]:
        load_table = LoadTable(over, powers=row["powers"], where=where)
        return load_table if load_table.over_speed else item.fault(
            "powers are of a speed, and the load is over a position", 'values, or over = "speed"')
    rows: Pairs = row[sources[0]]
    file = str(item.value) if sources == ["file"] else ""
    load_table = LoadTable(over, rows, where=where, beyond=row.values.get("beyond", HOLD),
                           during=row.values.get("during", ""))
    if load_table.during and not over.startswith(STROKE_OF):
        return row.items["during"].fault("the load is not over a stroke", 'over = "stroke of ..."')
    if load_table.over_position and len(rows) > 3 and rows[0] == rows[-1]:  # it may say that it goes around
        load_table = replace(load_table, rows=rows[:-1] if rows[0][0] == rows[-2][0] else rows)
    faults = list(_out_of_order(load_table))
    for problem, instead in faults[:1]:
        item.fault(f"{file}: {problem}" if file else problem, instead)
    return None if faults else replace(load_table, period=_period(load_table, row.names))


def _out_of_order(table: LoadTable) -> Iterator[tuple[str, str]]:
    """Yield each fault in the order of a table's rows, with its remedy."""
    places = [place for place, _ in table.rows]
    if len(places) < 2 or len({*places}) < 2:
        yield "a table of fewer than two places", f"at least two rows, such as {ROWS_EXAMPLE}"
        return
    around = [*places, *places[:2]] if table.over_position else places
    for three in zip(around, around[1:], around[2:], strict=False):
        if len({*three}) == 1:
            yield f"three rows at one place, {number_text(three[0])}", "at most two, for a jump"
    steps = [b - a for a, b in pairwise(places)]
    if table.over.startswith(STROKE_OF) and not all(0 <= place <= 1 for place in places):
        yield "places outside a stroke, which goes from 0 to 1", "places from 0 to 1"
    if not table.over_position:
        for i, step in enumerate(steps, 1):
            if step < 0:
                yield f"row {i + 1} goes back to {number_text(places[i])}", "rows in the order of their places"
        return
    senses = [step > 0 for step in steps if step]
    turns = sum(a != b for a, b in pairwise(senses))
    if turns != 1:
        problem = "the rows do not come back" if not turns else f"the rows turn back {turns} times"
        yield (f"{problem}: over a slide's position they go once around",
               "first the outward stroke's rows, then the return's")


def _period(table: LoadTable, names: SceneNames) -> Fraction:
    """The period of a table over the travel of a turning drive, in degrees: whole turns, or 0 if the table covers no
    whole turns."""
    first = next((pair for pair in names.pairs if isinstance(pair, Drive)), None)
    span = Fraction(table.rows[-1][0]) - Fraction(table.rows[0][0])
    return span if table.over == TRAVEL and first and not first.slides and span % 360 == 0 else Fraction(0)


def _check_mass(link: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where a link can have no mass."""
    if link == FRAME:
        item.fault("the frame is given a mass", "a moving link")
    elif link not in names.links:
        item.faults.unknown(item.where, "link", link, names.links)


def _mass(row: TableRow) -> Mass | None:
    return Mass(**row.values) if is_on_link(row, "centre", row["centre"], row.item.key) else None


MASSES = Named(Table("a mass", (
    Field("mass", "its mass", AMOUNT, "a mass, such as mass = 10"),
    Field("inertia", "its inertia about the centre of mass, in mass * m^2", AMOUNT, default=0),
    Field("centre", "its centre of mass, a point of that link", POINT, 'a point of the link, such as centre = "S"'),
), _mass), LINK, _check_mass)

_LOADED = moving("a load on the frame has no effect")
_STILL: Pair = (Fraction(0), Fraction(0))


def _force(row: TableRow) -> Force | None:
    """A force; of one with a table the value is filled in once the whole scene is read."""
    changing, load_table = "over" in row.items, table(row)
    if not is_on_link(row, "at", row["at"], row["on"]) or (changing and load_table is None):
        return None
    if "direction" in row.items and not changing:
        return row.items["direction"].fault("a constant force has its direction in its value", "value, or over")
    if not changing:
        return Force(row["on"], row["at"], row["value"])
    if "direction" not in row.items:
        return row.item.fault("direction is missing", "the direction of positive values, such as direction = [1, 0]")
    vector, through, _ = row["direction"]
    return Force(row["on"], row["at"], _STILL, load_table, vector, through)


def _moment(row: TableRow) -> Moment | None:
    """A moment; of one with a table the value is filled in once the whole scene is read."""
    changing, load_table = "over" in row.items, table(row)
    if changing and load_table is None:
        return None
    return Moment(row["on"], row.values.get("value", Fraction(0)), load_table)


FORCES = Rows(Table("a force", (
    Field("on", "the loaded link", _LOADED, 'the loaded link, such as on = "2"'),
    Field("at", "a point of that link", POINT, 'a point of that link, such as at = "C"'),
    Field("value", "the components of the force", VECTOR),
    DIRECTION, *TABLE,
), _force, either=VALUE_OR_OVER, remedy="two components, such as value = [-150, 0], or over and a table"))
MOMENTS = Rows(Table("a moment", (
    Field("on", "the loaded link", _LOADED, 'the loaded link, such as on = "3"'),
    Field("value", "the moment in force * m, counter-clockwise positive", NUMBER),
    *TABLE,
), _moment, either=VALUE_OR_OVER, remedy="a moment, such as value = 12.0, or over and a table"))


def _balance(row: TableRow) -> Balance | None:
    vector, _, written = row["direction"]
    return Balance(row["on"], row["at"], vector, written) if is_on_link(row, "at", row["at"], row["on"]) else None


_BALANCED = moving("a balance on the frame, which does not move, keeps no motion")
BALANCE = Rows(Either((Table("a moment", (
    Field("link", "the link on which a moment keeps the motion", _BALANCED,
          'the link on which a moment acts, such as link = "1"'),
), lambda row: Balance(**row.values)), Table("a force along a line", (
    Field("at", "the point of that link where the force acts", POINT,
          'the point where a force acts, such as at = "B"'),
    Field("on", "the link on which a force keeps the motion", _BALANCED,
          'the link on which it acts, such as on = "1"'),
    Field("direction", "the force's direction: a vector, an angle in degrees, or two points", GUIDE,
          "the force's direction: a vector, an angle in degrees, or two points"),
), _balance))), single=True)


def loads_of(read: Mapping[str, Any]) -> Loads | None:
    """Make the loads of a scene from its tables; None if it has no load."""
    if read.keys().isdisjoint(LOADS):
        return None
    forces = *read.get("forces", ()), *spring_forces(read.get("springs", ()))
    losses = read.get("friction", ())
    return Loads(read.get("gravity", _STILL), read.get("masses", {}), forces, read.get("moments", ()),
                 read.get("balance", ()), tuple(loss for loss in losses if not isinstance(loss, Screw)),
                 screws=tuple(loss for loss in losses if isinstance(loss, Screw)))


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
    """Let a belt hold by friction, without a loss in it."""
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
        row.items["coefficient"].fault("a belt without friction transmits no moment", "a number above 0, such as 0.3")
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
    return row.items["lead"].fault("the lead angle and the friction angle are 90 degrees or more: the screw cannot be "
                                   "driven", "a lead that is small beside the radius")


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


def _governor(row: TableRow) -> Any:
    axis, (low, high) = row["axis"], row["between"]
    if not row["balls"]:
        return row.items["balls"].fault("no link", 'the links that carry the balls, such as ["1"]')
    if None in axis:
        return None
    if len({*axis}) < 2 or not {*axis} <= {*row.names.links.get(FRAME, ())}:
        return row.items["axis"].fault(f"{axis[0]}, {axis[1]}", "two points of the frame")
    if not low < high:
        return row.items["between"].fault("the range has no length", "such as between = [-15, 15]")
    if "speed" in row.items and "rpm" in row.items:
        return row.item.fault("speed and rpm are both given", "either speed in rad/s or rpm")
    speed = float(row["rpm"] / 30 * Fraction(pi)) if "rpm" in row.items else row.values.get("speed")
    if speed is not None and speed <= 0:
        return row.item.fault("a speed that is not above 0", "such as rpm = 300")
    return Governor(row["balls"], axis, (low, high), speed)


GOVERNOR = Table("a centrifugal governor", (
    Field("balls", "the links whose masses revolve, all at one distance from the axis",
          name_list("link", '["1"]', lambda names: names.moving, entry=LINK), 'balls = ["1"]'),
    Field("axis", "two points of the frame on the spindle's axis", TWO_POINTS, 'such as axis = ["O", "Z"]'),
    Field("between", "its range: two travels of the first drive from the given pose, in degrees (in lengths where it "
          "slides)", VECTOR, "such as between = [-15, 15]"),
    Field("speed", "the speed of the spindle, in rad/s; without it the mean of those of the range", NUMBER),
    Field("rpm", "the same in turns a minute, instead of speed", NUMBER),
), _governor)
