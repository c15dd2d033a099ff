"""Schema: what a scene file may say, as JSON Schema: for editors, and for the comments of a new scene.

This is the table of every key with the words for it. What only the whole scene tells, such as names that nothing bears
or drives that are too many, is left to the loader.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from graphplan.mechanism.model import FRAME
from graphplan.mechanism.presentation import CODES, CONVENTIONS, FRAMES, PAPERS, RATIO
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS

DRAFT = "https://json-schema.org/draft/2020-12/schema"

Fragment = dict[str, Any]

TEXT: Fragment = {"type": "string"}
NUMBER: Fragment = {"type": "number"}
ABOVE_0: Fragment = {"type": "number", "exclusiveMinimum": 0}
FROM_0: Fragment = {"type": "number", "minimum": 0}
PAIR: Fragment = {"type": "array", "items": NUMBER, "minItems": 2, "maxItems": 2}
NAME = r"[^\s,]+"
POINT: Fragment = {"type": "string", "pattern": f"^{NAME}$"}
POINTS: Fragment = {"type": "string", "pattern": rf"^\s*{NAME}(\s+{NAME})*\s*$"}
TWO_POINTS: Fragment = {"type": "string", "pattern": rf"^\s*{NAME}\s+{NAME}\s*$"}
LINK: Fragment = {"type": "string", "pattern": r"\S"}
TWO_LINKS: Fragment = {"type": "array", "items": LINK, "minItems": 2, "maxItems": 2}
DIRECTION: Fragment = {"anyOf": [PAIR, NUMBER, TWO_POINTS]}


def told(says: str, fragment: Fragment) -> Fragment:
    """A fragment with its description."""
    return {"description": says, **fragment}


def table(keys: dict[str, Fragment], required: Collection[str] | None = None) -> Fragment:
    """A table of these keys and no others; without `required` all of them must be there."""
    return {"type": "object", "properties": keys, "required": [*(keys if required is None else required)],
            "additionalProperties": False}


def named(entry: Fragment, names: Fragment) -> Fragment:
    """A table whose keys are names of the scene's own."""
    return {"type": "object", "propertyNames": names, "additionalProperties": entry}


def listed(entry: Fragment) -> Fragment:
    """A list, or an array of tables."""
    return {"type": "array", "items": entry}


def _distances(number: int) -> Fragment:
    """Distances from so many points."""
    return {**named(ABOVE_0, POINT), "minProperties": number, "maxProperties": number}


def _points() -> Fragment:
    """The ways to place a point."""
    line = table({
        "through": told("a point of the line, [x, y] or its name", {"anyOf": [PAIR, POINT]}),
        "direction": told("the line's direction: a vector, an angle in degrees, or two points", DIRECTION),
    })
    polar = table({
        "from": told("the point to measure from", POINT),
        "distance": told("the distance from that point", ABOVE_0),
        "angle": told("the direction in degrees from +x, counter-clockwise", NUMBER),
    })
    compass = table({
        "distances": told("the distances from two points: two arcs", _distances(2)),
        "side": told("the side of the ray from the first to the second centre", {"enum": ["left", "right"]}),
    })
    arc_line = table({
        "distances": told("the distance from one point: an arc", _distances(1)),
        "on": told("the line that the arc meets", line),
        "pick": told("the intersection further along the line's direction (right) or back (left)",
                     {"enum": ["left", "right"]}),
    })
    on_line = table({
        "on": told("the two points of the line", TWO_POINTS),
        "distance": told("how far from the first point towards the second", NUMBER),
    })
    places = [told("coordinates [x, y]", PAIR), told("polar: from a point, by distance and angle", polar),
              told("compass: where two arcs meet", compass), told("where an arc meets a line", arc_line),
              told("on the line of two points", on_line)]
    return {**named({"anyOf": places}, POINT), "minProperties": 1}


def _units() -> Fragment:
    """The units, of which the first of each is the default."""
    return table({
        "length": told("the unit of lengths", {"enum": [*METRES], "default": "mm"}),
        "force": told("the unit of forces; moments are force * m", {"enum": [*NEWTONS], "default": "N"}),
        "mass": told("the unit of masses; inertia is mass * m^2", {"enum": [*KILOGRAMS], "default": "kg"}),
    }, required=())


def _slide() -> Fragment:
    return table({
        "link": told("the sliding link", LINK),
        "along": told("the link with the guide", LINK),
        "at": told("a point of the sliding link on the guide line", POINT),
        "direction": told("the guide's direction: a vector, an angle in degrees, or two points", DIRECTION),
    })


def _drive() -> Fragment:
    """A turning drive, by omega or by rpm, or a sliding actuator."""
    turning = table({
        "link": told("the driven link", LINK),
        "omega": told("its angular velocity in rad/s, counter-clockwise positive", NUMBER),
        "rpm": told("its angular velocity in turns a minute, instead of omega", NUMBER),
        "alpha": told("its angular acceleration in rad/s^2", {**NUMBER, "default": 0}),
        "relative_to": told("the link that it turns relative to", {**LINK, "default": FRAME}),
    }, required=["link"])
    sliding = table({
        "slide": told("the sliding link and the link with the guide", TWO_LINKS),
        "speed": told("the speed along the direction, in length/s", NUMBER),
        "acceleration": told("the acceleration along the direction, in length/s^2", {**NUMBER, "default": 0}),
    }, required=["slide", "speed"])
    either = {"oneOf": [{"required": ["omega"]}, {"required": ["rpm"]}]}
    return {"anyOf": [{**turning, **either}, sliding]}


def _motion() -> Fragment:
    return named(table({
        "velocity": told("its velocity, in length/s", PAIR),
        "acceleration": told("its acceleration, in length/s^2", {**PAIR, "default": [0, 0]}),
    }, required=["velocity"]), POINT)


def _find() -> Fragment:
    def names(what: Fragment) -> Fragment:
        return {"anyOf": [{"const": "all"}, listed(what)]}

    return table({
        "velocity": told('the points whose velocities are asked for, or "all"', names(POINT)),
        "acceleration": told('the points whose accelerations are asked for, or "all"', names(POINT)),
        "links": told('the links whose angular velocities and accelerations are asked for, or "all"; without it those '
                      "of which two points are asked for", names(LINK)),
        "slides": told('the slides (such as "3 along 2") whose velocities and accelerations are asked for, or "all"; '
                       "without it those whose point is asked for", names(TEXT)),
        "reactions": told('the joints and slides (such as "3 along 2") whose reactions are asked for, or "all"',
                          names(TEXT)),
    }, required=())


def _masses() -> Fragment:
    return named(table({
        "mass": told("its mass", FROM_0),
        "inertia": told("its inertia about the centre of mass, in mass * m^2", {**FROM_0, "default": 0}),
        "centre": told("its centre of mass, a point of that link", POINT),
    }, required=["mass", "centre"]), LINK)


def _force() -> Fragment:
    return table({"on": told("the loaded link", LINK), "at": told("a point of that link", POINT),
                  "value": told("the components of the force", PAIR)})


def _moment() -> Fragment:
    return table({"on": told("the loaded link", LINK),
                  "value": told("the moment in force * m, counter-clockwise positive", NUMBER)})


def _balance() -> Fragment:
    """A balance, or one for each drive."""
    moment = table({"link": told("the link on which a moment keeps the motion", LINK)})
    force = table({
        "on": told("the link on which a force keeps the motion", LINK),
        "at": told("the point of that link where the force acts", POINT),
        "direction": told("the force's direction: a vector, an angle in degrees, or two points", DIRECTION),
    })
    return {"anyOf": [moment, force, listed({"anyOf": [moment, force]})]}


def _friction() -> Fragment:
    """Friction in a journal or in a slide."""
    coefficient = {"coefficient": told("the coefficient of friction", FROM_0)}
    journal = table({"at": told("the joint", POINT), "radius": told("the journal's radius", FROM_0), **coefficient})
    sliding = table({"slide": told("the sliding link and the link with the guide", TWO_LINKS), **coefficient})
    return {"anyOf": [journal, sliding]}


def _sheet() -> Fragment:
    """How the sheet should look, what its title block says, and the scales that are not left to graphplan."""
    return table({
        "paper": told("the sheet; without it the smallest that will do", {"enum": [*PAPERS]}),
        "frame": told("frame and title block after ISO 5457 and ISO 7200, or after GOST 2.301 and GOST 2.104",
                      {"enum": [*FRAMES], "default": "iso"}),
        "language": told("the language of all words on the sheet", {"enum": [*CODES], "default": "en"}),
        "convention": told("scales as real per drawn (k_v, mm/s per mm) or drawn per real (mu_v, mm per mm/s)",
                           {"enum": [*CONVENTIONS], "default": "real"}),
        "owner": told("the legal owner, for the title block", TEXT),
        "number": told("the identification number", TEXT),
        "date": told("the date of issue", TEXT),
        "drawn_by": told("who drew it", {**TEXT, "default": "graphplan"}),
        "approved_by": told("who approved it", TEXT),
        "scale": told("the scale of the mechanism plan, a ratio of paper to scene",
                      {"type": "string", "pattern": f"^{RATIO}$"}),
        "k_s": told("the same as lengths of the scene for a mm of paper", ABOVE_0),
        "k_v": told("the speed, in length/s, for a mm of paper", ABOVE_0),
        "k_a": told("the acceleration, in length/s^2, for a mm of paper", ABOVE_0),
        "k_F": told("the force for a mm of paper", ABOVE_0),
        "multiples": told("how many times as large as by these scales other plans are drawn, by their names",
                          named(ABOVE_0, TEXT)),
    }, required=())


def scene() -> Fragment:
    """The JSON Schema of a scene file."""
    tables = table({
        "title": told("what the mechanism is", TEXT),
        "source": told("where it comes from: author, title, year, figure", TEXT),
        "gravity": told("the acceleration of gravity in m/s^2, where forces are asked for",
                        {**PAIR, "default": [0, 0]}),
        "units": told("the units of the scene and of its results", _units()),
        "points": told("every named point, in this pose of the mechanism", _points()),
        "links": told("a link is the list of its points; a point that several links name is a revolute joint there",
                      {**named(POINTS, LINK), "minProperties": 1}),
        "slides": told("a sliding pair: one link slides along another", listed(_slide())),
        "drive": told("what drives it: one entry for each degree of freedom", listed(_drive())),
        "motion": told("the given motion of a point, for open chains", _motion()),
        "find": told("what is asked for; without it the velocity and acceleration of every joint, and the "
                     "rates of every link", _find()),
        "sheet": told("how the sheet should look; the command line has the last word", _sheet()),
        "masses": told("the mass of a link", _masses()),
        "forces": told("a force on a link", listed(_force())),
        "moments": told("a moment on a link", listed(_moment())),
        "balance": told("the unknown that keeps the motion, one for each drive: a moment, or a force along a line",
                        _balance()),
        "friction": told("friction in a joint or in a slide", listed(_friction())),
    }, required=["points", "links"])
    return {"$schema": DRAFT, "title": "graphplan scene",
            "description": "A planar mechanism in one pose, what drives it, what loads it and what is asked of it.",
            **tables}
