"""Steps as GeoGebra writes them: by its own commands where their marks allow it, else by their formula.

Crossings of circles are laid off to the side that is declared, so they stay on it when points are dragged: GeoGebra
numbers its intersections, but not by side. Only what GeoGebra 4.0 and its successors share is used.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from graphplan.exports.formula import formula
from graphplan.exports.walk import parameters, turned_back
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, Movement
from graphplan.kernel.tape.written import Language, operations
from graphplan.sheet.lettering.lettering import Runs, name_runs
from graphplan.sheet.plates.drawn_step import DrawnStep
from graphplan.sheet.plates.plate import Plates

Terms = Sequence[tuple[str, str]]

MAX_NESTING = 3  # operations within each other: GeoGebra 4.0 takes twice as long to read each one more
CENTRES = "Vector[{centre0}, {centre1}]"
CENTRE_DISTANCE = "Distance[{centre0}, {centre1}]"
# On the line of centres, to the chord.
ALONG = f"({CENTRE_DISTANCE}^2 + {{radius0}}^2 - {{radius1}}^2) / (2 * {CENTRE_DISTANCE})"

# The command of each movement, and its inputs: {k} is what lengths from another plan are multiplied by, {sign} that of
# the side declared, {dx} and {dy} are in mm; {centre0} and {radius0} are those of the circle {0}.
COMMANDS = {
    Movement.RULED: "Line; {0}; {1}",
    Movement.GUIDED: "Line; {0}; Vector[({dx}, {dy})]",
    Movement.PARALLEL: "Line; {1}; {0}",
    Movement.PERPENDICULAR: "OrthogonalLine; {1}; {0}",
    Movement.BISECTED: "LineBisector; {0}; {1}",
    Movement.MET: "Intersect; {0}; {1}",
    Movement.OPENED: "Distance; {0}; {1}",
    Movement.STRUCK: "Circle; {0}; {k} * {1}",
    Movement.HALVED: "Midpoint; {0}; {1}",
    Movement.DROPPED: "Intersect; {0}; OrthogonalLine[{1}, {0}]",
    Movement.LAID_OFF: "Translate; {2}; {k} * Vector[{0}, {1}]",
    Movement.TURNED: "Translate; {2}; {k} * OrthogonalVector[Vector[{0}, {1}]]",
    Movement.LAID_BY_COMPONENTS: "Translate; {0}; Vector[({dx}, {dy})]",
    Movement.CUT: "Translate; Intersect[{0}, OrthogonalLine[{centre1}, {0}]]; "
                  "{sign}sqrt({radius1}^2 - Distance[{centre1}, {0}]^2) * UnitVector[{0}]",
    Movement.ARCS_MET: f"Translate; Translate[{{centre0}}, {ALONG} * UnitVector[{CENTRES}]]; "
                       f"{{sign}}sqrt({{radius0}}^2 - ({ALONG})^2) * UnitOrthogonalVector[{CENTRES}]",
}  # fmt: skip


def number(value: float) -> str:
    """A number as GeoGebra reads it: in its eyes a small e is a letter."""
    text = repr(float(value)).upper()
    return f"({text})" if value < 0 else text


LANGUAGE = Language(number, operations("sqrt({})", "abs({})", "If[abs({0}) <= {2} * ({1}), 0, sgn({0})]"))
PLACE = ("x({0})", "y({0})")
LINES = ("x(Intersect[{0}, OrthogonalLine[(0, 0), {0}]])", "y(Intersect[{0}, OrthogonalLine[(0, 0), {0}]])",
         "x(Direction[{0}])", "y(Direction[{0}])")
RESULTS = {
    POINT: ("", ("({0}, {1})",)),
    LINE: ("Line", ("({0}, {1})", "Vector[({2}, {3})]")),
    OPENING: ("", ("{0}",)),
    CIRCLE: ("Circle", ("({0}, {1})", "{2}")),
}


def command_of(drawn: DrawnStep, labels: Mapping[DrawnStep, str],
               guides: Mapping[str, tuple[str, str]]) -> tuple[Terms, str, list[str]]:
    """The numbers that a mark needs, by label, and its command with its inputs; without a name an expression.

    `guides` say where those guides point that ride on links.
    """
    movement = drawn.step.op.movement
    if movement in COMMANDS:
        name, *inputs = COMMANDS[movement].split("; ")
        numbers = {name: number(value) for name, value in parameters(drawn).items()}
        for place, arg in enumerate(drawn.args):
            if arg.kind == CIRCLE:
                numbers[f"centre{place}"], numbers[f"radius{place}"] = _circle(arg, labels)
        numbers["sign"] = "-" if turned_back(drawn) else ""
        if movement is Movement.GUIDED and (guide := guides.get(" along ".join(drawn.step.links))):
            numbers["dx"], numbers["dy"] = guide
        return (), name, [text.format(*(labels[arg] for arg in drawn.args), **numbers) for text in inputs]
    return formula_command(drawn, labels)


def formula_command(drawn: DrawnStep, labels: Mapping[DrawnStep, str], against: bool = False) -> tuple[Terms, str,
                                                                                                       list[str]]:
    """The same by the formula of the rule; of a line, turned round where it is drawn `against` its rule."""
    read = [_coordinates(arg, labels) for arg in drawn.args]
    expression = formula(drawn, read, LANGUAGE, f"number{drawn.index}n", MAX_NESTING)
    name, texts = RESULTS[drawn.kind]
    results = [f"(-{text})" if against and place > 1 else text for place, text in enumerate(expression.results)]
    return expression.terms, name, [text.format(*results) for text in texts]


def _circle(circle: DrawnStep, labels: Mapping[DrawnStep, str]) -> tuple[str, str]:
    """The centre and the radius of a circle: the marks that it was struck with, where they are as large here."""
    if circle.step.op.movement is Movement.STRUCK:
        centre, opening = (labels[arg] for arg in circle.args)
        factor = parameters(circle)["k"]
        return centre, opening if factor == 1 else f"({number(factor)} * {opening})"
    return f"Center[{labels[circle]}]", f"Radius[{labels[circle]}]"


def _coordinates(drawn: DrawnStep, labels: Mapping[DrawnStep, str]) -> list[str]:
    """An operand of a formula by its coordinates."""
    if drawn.kind == CIRCLE:
        centre, radius = _circle(drawn, labels)
        return [*(text.format(centre) for text in PLACE), radius]
    return [text.format(labels[drawn]) for text in {POINT: PLACE, LINE: LINES, OPENING: ("{0}",)}[drawn.kind]]


# ---- labels ----------------------------------------------------------------------------------------------------------

RESERVED = {*"xyzeiπ"}  # letters that mean something else in GeoGebra
TAKEN = re.compile(  # so begin labels made here
    "number|side|caption|stroke|vector|arc|link|point|line|numeric|opening|circle|drive|"
    "handle|orbit|travel|place|state|knot|turn|plan|stage|step|value|scale|pin")
LABEL = re.compile(r"[^\W\d_][^\W_]*'*(_\{[^\W_]+\})?'*")


RAISED = str.maketrans("nrtC", "ⁿʳᵗᶜ")  # superscripts


def letters(name: str) -> str:
    """A mark's name as GeoGebra sets it: primes, Greek letters, a subscript in braces."""
    return set_runs(name_runs(name))


def set_runs(runs: Runs) -> str:
    """Runs of text as GeoGebra sets them."""
    levels = {-1: "_{{{}}}", 0: "{}", 1: "{}"}
    texts = (levels[run.level].format(run.text.translate(RAISED) if run.level > 0 else run.text) for run in runs)
    return "".join(texts).replace("′", "'").replace("″", "''")


def labels(plates: Plates) -> dict[DrawnStep, str]:
    """The label of every mark: its letters where GeoGebra allows them, else its kind and place."""
    names: dict[DrawnStep, str] = {}
    taken = set(RESERVED)
    for place, mark in enumerate(plates.all_marks):
        letter = letters(mark.name)
        fits = "^" not in mark.name and LABEL.fullmatch(letter) and not TAKEN.match(letter) and letter not in taken
        names[mark] = letter if fits else f"{mark.kind}_{{{place}}}"
        taken.add(names[mark])
    return names
