"""Drawing steps as commands of GeoGebra, and as expressions where it has none.

Crossings of circles are laid off to the side that is declared, so they stay on it when points are dragged: GeoGebra
numbers its intersections, but not by side.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.output.exports.figure import Object
from graphplan.output.exports.formula import Language, formula, operations


class Command(NamedTuple):
    """A command of the operands {0}, {1}, ...; those that may lie on another plan than the result are `afar`.

    {k} is what lengths from afar are multiplied by, {sign} that of the side declared, {dx} and {dy} are in mm;
    {centre0} and {radius0} are those of the circle {0}.
    """

    name: str
    inputs: tuple[str, ...]
    afar: tuple[int, ...] = ()


def _laid(vector: str) -> Command:
    """A vector laid off from the third operand."""
    return Command("Translate", ("{2}", vector), (0, 1))


class Written(NamedTuple):
    """The numbers that an object needs, by label, and its command; without a name its one input is an expression."""

    terms: Sequence[tuple[str, str]]
    name: str
    inputs: list[str]


DEEPEST = 3  # operations within each other: GeoGebra 4.0 takes twice as long to read each one more
CENTRES = "Vector[{centre0}, {centre1}]"
APART = "Distance[{centre0}, {centre1}]"
ALONG = f"({APART}^2 + {{radius0}}^2 - {{radius1}}^2) / (2 * {APART})"  # on the line of centres, to the chord

COMMANDS = {
    "line": Command("Line", ("{0}", "{1}")),
    "guide": Command("Line", ("{0}", "Vector[({dx}, {dy})]")),
    "parallel": Command("Line", ("{1}", "{0}"), (0,)),
    "perpendicular": Command("OrthogonalLine", ("{1}", "{0}"), (0,)),
    "bisector": Command("LineBisector", ("{0}", "{1}")),
    "meet": Command("Intersect", ("{0}", "{1}")),
    "opening": Command("Distance", ("{0}", "{1}")),
    "circle": Command("Circle", ("{0}", "{k} * {1}"), (1,)),
    "midpoint": Command("Midpoint", ("{0}", "{1}")),
    "foot": Command("Intersect", ("{0}", "OrthogonalLine[{1}, {0}]")),
    "transfer": _laid("{k} * Vector[{0}, {1}]"),
    "step_off": _laid("{k} * Vector[{0}, {1}]"),
    "quarter": _laid("{k} * OrthogonalVector[Vector[{0}, {1}]]"),
    "step_across": _laid("{k} * OrthogonalVector[Vector[{0}, {1}]]"),
    "lay_off": Command("Translate", ("{0}", "Vector[({dx}, {dy})]")),
    "line_meets_circle": Command("Translate", (
        "Intersect[{0}, OrthogonalLine[{centre1}, {0}]]",
        "{sign}sqrt({radius1}^2 - Distance[{centre1}, {0}]^2) * UnitVector[{0}]")),
    "circles_meet": Command("Translate", (
        f"Translate[{{centre0}}, {ALONG} * UnitVector[{CENTRES}]]",
        f"{{sign}}sqrt({{radius0}}^2 - ({ALONG})^2) * UnitOrthogonalVector[{CENTRES}]")),
}


def number(value: float) -> str:
    """A number as GeoGebra reads it: in its eyes a small e is a letter."""
    text = repr(float(value)).upper()
    return f"({text})" if value < 0 else text


LANGUAGE = Language(number, operations("sqrt({})", "abs({})", "If[abs({0}) <= {2} * ({1}), 0, sgn({0})]"))
POINTS = ("x({0})", "y({0})")
LINES = ("x(Intersect[{0}, OrthogonalLine[(0, 0), {0}]])", "y(Intersect[{0}, OrthogonalLine[(0, 0), {0}]])",
         "x(Direction[{0}])", "y(Direction[{0}])")
RESULTS = {
    POINT: ("", ("({0}, {1})",)),
    LINE: ("Line", ("({0}, {1})", "Vector[({2}, {3})]")),
    OPENING: ("", ("{0}",)),
    CIRCLE: ("Circle", ("({0}, {1})", "{2}")),
}


def written(object: Object, labels: Mapping[Object, str]) -> Written:
    """What makes an object in GeoGebra."""
    command = COMMANDS.get(object.step.op.name)
    if command is not None and _stands(object, command.afar):
        named = [labels[arg] for arg in object.args]
        sizes = _sizes(object, command.afar) | _circles(object, labels)
        return Written((), command.name, [text.format(*named, **sizes) for text in command.inputs])
    read = [_coordinates(arg, labels) for arg in object.args]
    found = formula(object, read, LANGUAGE, f"number{object.index}n", DEEPEST)
    name, texts = RESULTS[object.kind]
    return Written(found.terms, name, [text.format(*found.results) for text in texts])


def _stands(object: Object, afar: Sequence[int]) -> bool:
    """Whether all operands lie on the object's plan, those from afar together on any."""
    near = {arg.plan.name for place, arg in enumerate(object.args) if place not in afar}
    return near <= {object.plan.name} and len({object.args[place].plan.name for place in afar}) < 2


def _sizes(object: Object, afar: Sequence[int]) -> dict[str, str]:
    """The numbers of a command: what is given, in mm, and how lengths are carried over."""
    params, scale = object.step.params, object.plan.scale
    factor = object.factor(object.args[afar[0]]) if afar else 1.0
    sizes: dict[str, str] = {name: number(scale * float(params[name])) for name in {"dx", "dy"} & params.keys()}
    sizes["k"] = number(factor * float(params.get("ratio", 1)))
    sizes["sign"] = "-" if params.get("side") == "right" or params.get("way") == "back" else ""
    return sizes


def _circles(object: Object, labels: Mapping[Object, str]) -> dict[str, str]:
    """The centres and radii of the circles that an object reads."""
    found = {}
    for place, arg in enumerate(object.args):
        if arg.kind == CIRCLE:
            found[f"centre{place}"], found[f"radius{place}"] = _circle(arg, labels)
    return found


def _circle(circle: Object, labels: Mapping[Object, str]) -> tuple[str, str]:
    """The centre and the radius of a circle: the marks that it was struck with, where they are as large here."""
    if circle.step.op.name == "circle" and _stands(circle, (1,)):
        centre, opening = circle.args
        factor = circle.factor(opening)
        return labels[centre], labels[opening] if factor == 1 else f"({number(factor)} * {labels[opening]})"
    return f"Center[{labels[circle]}]", f"Radius[{labels[circle]}]"


def _coordinates(object: Object, labels: Mapping[Object, str]) -> list[str]:
    """An operand of a formula by its coordinates."""
    if object.kind == CIRCLE:
        centre, radius = _circle(object, labels)
        return [*(text.format(centre) for text in POINTS), radius]
    return [text.format(labels[object]) for text in {POINT: POINTS, LINE: LINES, OPENING: ("{0}",)}[object.kind]]
