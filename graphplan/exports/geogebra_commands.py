"""GeoGebra's commands for the steps of a construction, and for the linkage that its points move in.

Crossings of circles are laid off to the side that is declared, so they stay on it when points are dragged: GeoGebra
numbers its intersections, but not by side. Only what GeoGebra 4.0 and its successors share is used.

A slider has the drive's travel, in its own sense. A handle is a point of a circle that the slider turns: both together
are how far the drive has gone. The orbit begins where the slider has the crank pin, so that the handle stays on it.
The elements of the file are objects by their commands and expressions, and how each is shown.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import chain
from xml.etree.ElementTree import Element, SubElement, fromstring

from graphplan.cycle.relations import KNOT_SPANS, Relations
from graphplan.cycle.relations import WrittenRelations as WrittenRelations
from graphplan.exports.code import formula
from graphplan.exports.walk import parameters, turned_back
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, Movement
from graphplan.kernel.tape.record import Language, operations
from graphplan.mechanism.model import FRAME, Drive
from graphplan.mechanism.travel import sense
from graphplan.phrases import digits
from graphplan.sheet.lettering.lettering import Runs, name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import DrawnStep, Plates

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
    """Formula of a rule as a command; of a line, reversed if it is drawn `against` its rule."""
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


WIDE, HIGH = 1280, 800  # pixels: the drawing pad
SOLID, DASHED = 0, 15  # GeoGebra's types of line
LINKS, CURVES, VECTORS, POINTS = 0, 2, 5, 8  # its layers
NAME, CAPTION = 0, 3  # what it shows as a label
OWN = {"segment": "stroke", "vector": "vector", "conicpart": "arc", "polygon": "link"}  # so begin labels made here


HEAD = """\
<geogebra format="4.0">
 <gui>
  <show algebraView="false" spreadsheetView="false" auxiliaryObjects="false" algebraInput="false"/>
  <labelingStyle val="3"/>
  <consProtColumns col0="true" col1="true" col2="true" col3="true" col4="true" col5="true" col6="true" col7="true"/>
  <consProtocol useColors="true" addIcons="false" showOnlyBreakpoints="true"/>
  <consProtNavigationBar show="true" playButton="true" playDelay="2.0" protButton="true"/>
 </gui>
 <euclidianView>
  <size width="{width}" height="{height}"/>
  <coordSystem xZero="{x}" yZero="{y}" scale="{size}" yscale="{size}"/>
  <evSettings axes="false" grid="false" gridIsBold="false" pointCapturing="0" rightAngleStyle="1"/>
  <bgColor r="255" g="255" b="255"/>
  <axis id="0" show="false" label="" unitLabel="" tickStyle="1" showNumbers="false"/>
  <axis id="1" show="false" label="" unitLabel="" tickStyle="1" showNumbers="false"/>
 </euclidianView>
 <kernel><continuous val="false"/><significantfigures val="4"/><angleUnit val="degree"/></kernel>
</geogebra>"""


class Objects:
    """The objects of one construction, in order; `shown_if` is the condition of what is entered now."""

    def __init__(self, title: str):
        self.construction, self.count, self.shown_if = Element("construction", title=title, author="", date=""), 0, ""

    def label(self, begins: str) -> str:
        """A label that no other object has."""
        self.count += 1
        return f"{begins}_{{{self.count}}}"

    def command(self, name: str, inputs: Sequence[str], outputs: Sequence[str]) -> None:
        command = SubElement(self.construction, "command", {"name": name})
        SubElement(command, "input", {f"a{i}": text for i, text in enumerate(inputs)})
        SubElement(command, "output", {f"a{i}": text for i, text in enumerate(outputs)})

    def expression(self, label: str, text: str, **kind: object) -> None:
        empty(self.construction, "expression", label=label, exp=text, **kind)

    def numeric(self, label: str, text: str, kind: str = "numeric", **of_type: object) -> str:
        """Add a hidden number, or a hidden object of another kind."""
        self.expression(label, text, **of_type)
        self.element(kind, label, False, False, pens.THIN, CURVES)
        return label

    def add_shape(self, kind: str, command: str, inputs: Sequence[str], pen: Pen, layer: int,
                  letter: str = "") -> Element:
        """Add the visible shape of marks, by its command."""
        label = self.label(OWN[kind])
        sides = [f"side_{{{self.count},{i}}}" for i in range(len(inputs))] if kind == "polygon" else []
        self.command(command, inputs, [label, *sides])
        element = self.element(kind, label, True, bool(letter), pen, layer)
        for side in sides:
            self.element("segment", side, False, False, pen, layer)
        if letter:
            show_caption(element, letters(letter))
        return element

    def text(self, begins: str, written: str, pen: Pen = pens.LETTERS, size: int = 0, **place: object) -> Element:
        """A text, by its expression, at a `startPoint` that an expression gives; or it stays where it is in pixels."""
        label = self.label(begins)
        self.expression(label, written)
        element = self.element("text", label, True, False, pen, POINTS)
        empty(element, "font", serif=False, sizeM=1.0, size=size, style=int(begins == "caption"))
        empty(element, "startPoint" if "exp" in place else "absoluteScreenLocation", **place)
        return element

    def check_box(self, label: str, caption: str, x: int, y: int) -> None:
        """A box that is checked."""
        element = self.element("boolean", label, True, True, pens.LETTERS, POINTS)
        empty(element, "value", val=True)
        show_caption(element, caption)
        empty(element, "labelOffset", x=x, y=y)
        empty(element, "checkbox", fixed=True)

    def element(self, type: str, label: str, shown: bool, lettered: bool, pen: Pen, layer: int) -> Element:
        element = SubElement(self.construction, "element", {"type": type, "label": label})
        empty(element, "show", object=shown, label=lettered)
        if shown and self.shown_if:
            empty(element, "condition", showObject=self.shown_if)
        r, g, b = pens.rgb(pen.colour)
        empty(element, "objColor", r=r, g=g, b=b, alpha=0.1 if type == "polygon" else 0.0)
        empty(element, "layer", val=layer)
        empty(element, "labelMode", val=NAME)
        if type not in ("point", "numeric", "text", "boolean"):
            empty(element, "lineStyle", thickness=max(1, round(pen.width * 8)), type=DASHED if pen.dash else SOLID)
        if not lettered and type != "vector":
            empty(element, "auxiliary", val=True)
        return element


def show_caption(element: Element, caption: str) -> None:
    """Show a caption as the label of an object that is called otherwise."""
    for mode_element in element.iter("labelMode"):
        mode_element.set("val", str(CAPTION))
    empty(element, "caption", val=caption)


def empty_document(x: float, y: float, size: float) -> Element:
    """A file without objects; where the origin is on its drawing pad, and so many pixels for a mm."""
    return fromstring(HEAD.format(width=WIDE, height=HIGH, x=x, y=y, size=size))


def quote_text(words: str) -> str:
    """Words as a text of GeoGebra, which has no way to say its quotation mark."""
    return '"' + words.replace('"', "”") + '"'


def spot(x: float, y: float) -> str:
    """A place in mm."""
    return f"({number(round(x, 6))}, {number(round(y, 6))})"


def empty(parent: Element, name: str, **attributes: object) -> Element:
    """Add an element with attributes alone."""
    return SubElement(parent, name, {key: _xml_value(value) for key, value in attributes.items()})


def _xml_value(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)


SLIDER, ROW = 260, 36  # pixels: how long a slider is, and from one to the next
ROUND = 359.99  # degrees of an orbit: a whole circle has no beginning
WHOLE_TURN = 359.0  # degrees of travel from which a slider runs round and round
LAST_TURN = 359.995  # degrees: an angle beyond it is a rounded 0


def slider(k: int) -> str:
    """The label of a drive's slider."""
    return f"drive_{{{k + 1}}}"


def in_sense(drive: Drive, text: str) -> str:
    """A travel as the drive's own coordinate, or that as the travel."""
    return text if sense(drive) > 0 else f"(-({text}))"


def handle(k: int) -> str:
    """The label of a drive's handle."""
    return f"handle_{{{k + 1}}}"


class GeoGebraLinkage:
    """Enters a linkage among the objects; `labels` say what the points of the scene are called."""

    def __init__(self, relations: Relations, objects: Objects, labels: Mapping[str, str]):
        self.relations, self.objects, self.labels = relations, objects, labels
        self.scene, self.places = relations.scene, relations.places

    def enter(self, pin: Callable[[str, tuple[str, ...]], None]) -> WrittenRelations:
        """Enter the pins of the frame, by a function that takes one with its coordinates (a free one has no
        coordinates), the drives and the numbers of all else; return the expressions of the points."""
        inputs: dict[str, str] = {}
        for name in self.relations.free:
            pin(name, ())
            inputs |= {f"x {name}": f"x({self.labels[name]})", f"y {name}": f"y({self.labels[name]})"}
        for name, coordinates in self.relations.write_fixed_pins(LANGUAGE, inputs).items():
            pin(name, coordinates)
        for k, drive in enumerate(self.scene.drives):
            inputs |= dict(self._drive_inputs(k, drive))
        inputs |= dict(self._states())
        return self._numbers(self.relations.write(LANGUAGE, inputs, "place", MAX_NESTING))

    def _numbers(self, found: WrittenRelations) -> WrittenRelations:
        """The terms, and the turns of links by a label each."""
        for label, text in found.terms:
            self.objects.numeric(label, text)
        turns = {link: (self.objects.numeric(self.objects.label("turn"), cos),
                        self.objects.numeric(self.objects.label("turn"), sin))
                 for link, (cos, sin) in found.turns.items()}
        return found._replace(turns=turns)

    # ---- drives ----------------------------------------------------------------------------------------------------

    def _drive_inputs(self, k: int, drive: Drive) -> Iterator[tuple[str, str]]:
        """The inputs that a drive gives: its slider's and its handle's shift together."""
        scale, gone = self.relations.view.scale, in_sense(drive, slider(k))
        self._slider(k, drive)
        if drive.slides:
            yield f"shift {k}", self.objects.numeric(f"travel_{{{k + 1}}}", f"{number(scale)} * {gone}")
            return
        turned = self._handle(k, drive)
        shift = self.objects.numeric(f"travel_{{{k + 1}}}", f"{gone} + {turned}" if turned else gone)
        for function in ("cos", "sin"):
            yield f"{function} {k}", self.objects.numeric(f"{function}travel_{{{k + 1}}}".replace("travel", "drive"),
                                                          f"{function}({shift}°)")
        if f"shift {k}" in self.relations.used_inputs:  # where it is counted how far links have turned in all
            within = in_sense(drive, self._round(in_sense(drive, shift), k))  # not in °: GeoGebra takes off whole turns
            yield f"shift {k}", self.objects.numeric(f"turned_{{{k + 1}}}", f"({within}) * {number(math.radians(1))}")

    def _limits(self, k: int, drive: Drive) -> tuple[float, float]:
        """From where to where the slider goes, in degrees or scene lengths."""
        if k or self.scene.drives[0].slides != drive.slides:
            return (-360.0, 360.0) if not drive.slides else (-self.scene.extent, self.scene.extent)
        low, high = self.relations.limits
        unit = self.relations.view.scale if drive.slides else math.radians(1.0)
        return low / unit, high / unit

    def _slider(self, k: int, drive: Drive) -> None:
        element = self.objects.element("numeric", slider(k), True, True, pens.LETTERS, POINTS)
        low, high = self._limits(k, drive)
        empty(element, "value", val=0.0)
        sign, unit = ("s", f" {self.scene.units.length}") if drive.slides else ("φ", "°")
        show_caption(element, f"{sign}_{{{drive.link}}} = %v{unit}")
        empty(element, "slider", min=low, max=high, absoluteScreenLocation=True, width=SLIDER, x=20, y=40 + ROW * k,
              fixed=True, horizontal=True, showAlgebra=True)
        whole = high - low > WHOLE_TURN and not drive.slides
        empty(element, "animation", step=float(digits((high - low) / 360, 1)), speed=1.0, type=1 if whole else 0,
              playing=False)

    def _handle(self, k: int, drive: Drive) -> str:
        """Angle by which the handle has turned the drive, in degrees; empty without a handle."""
        points, frame = self.scene.links[drive.link], self.scene.links.get(FRAME, ())
        pivots = [point for point in points if drive.on == FRAME and point in frame]
        pins = [point for point in points if point not in frame]
        if not pivots or not pins:
            return ""
        arm, pivot = self.places[pins[0]] - self.places[pivots[0]], self.labels[pivots[0]]
        x, y, angle = number(arm.real), number(arm.imag), f"{in_sense(drive, slider(k))}°"
        begin = self.objects.numeric(self.objects.label("pin"), f"{pivot} + ({x} * cos({angle}) - {y} * sin({angle}), "
                                     f"{x} * sin({angle}) + {y} * cos({angle}))", "point", type="point")
        orbit = f"orbit_{{{k + 1}}}"
        self.objects.command("CircleArc", [pivot, begin, f"Rotate[{begin}, {ROUND}°, {pivot}]"], [orbit])
        self.objects.element("conicpart", orbit, False, False, pens.THIN, CURVES)
        self.objects.command("Point", [orbit], [handle(k)])
        element = self.objects.element("point", handle(k), True, False, pens.PAIR, POINTS)
        at = self.places[pins[0]]
        empty(element, "coords", x=at.real, y=at.imag, z=1.0)
        empty(element, "pointSize", val=6)
        empty(element, "pointStyle", val=2)
        turned = self.objects.numeric(self.objects.label("turn"), f"Angle[{begin}, {pivot}, {handle(k)}] / (1°)")
        return f"{turned} - 360 * floor({turned} / {LAST_TURN})"

    def _round(self, travel: str, k: int) -> str:
        """The first drive's travel, in degrees, within the round that the knots tell; any other travel as it is."""
        knots = self.relations.knots
        if k or knots is None or self.scene.drives[0].slides:
            return travel
        period = 360 * max(1, round((knots.high - knots.low) / math.tau))
        low = math.degrees((knots.low + knots.high) / 2) - period / 2
        return f"({travel} - {period} * floor(({travel} - {number(low)}) / {period}))"

    # ---- where Newton's steps begin --------------------------------------------------------------------------------

    def _states(self) -> Iterator[tuple[str, str]]:
        """The inputs of states: straight between the knots around the first drive's travel."""
        knots, used_inputs = self.relations.knots, self.relations.used_inputs
        states = sorted({int(name.split()[-1]) for name in used_inputs if "state" in name})
        if knots is None:
            yield from chain.from_iterable(((f"cos state {i}", "1"), (f"sin state {i}", "0"), (f"state {i}", "0"))
                                           for i in states)
            return
        travel = self._round(in_sense(self.scene.drives[0], "travel_{1}"), 0)
        unit = 1.0 if self.scene.drives[0].slides else math.radians(1.0)
        share = f"({travel} - {number(knots.low / unit)}) / {number((knots.high - knots.low) / unit)}"
        done = self.objects.numeric("knot_{1}", f"Min[1, Max[0, {share}]]")
        far = self.objects.numeric("knot_{2}", f"{number(KNOT_SPANS / math.pi)} * acos(1 - 2 * {done})")
        k = self.objects.numeric("knot_{3}", f"Min[{KNOT_SPANS}, floor({far}) + 1]")
        for i in states:
            values = f"knots_{{{i}}}"
            numbers = ", ".join(number(round(state, 7)) for state in knots.states[i])
            self.objects.numeric(values, f"{{{numbers}}}", "list")
            before, after = (f"Element[{values}, {place}]" for place in (k, f"{k} + 1"))
            state = self.objects.numeric(f"state_{{{i}}}", f"{before} + ({far} - {k} + 1) * ({after} - {before})")
            for name, text in ((f"cos state {i}", f"cos({state})"), (f"sin state {i}", f"sin({state})")):
                if name in used_inputs:
                    yield name, self.objects.numeric(f"{name[:3]}state_{{{i}}}".replace("state", "knot"), text)
            yield f"state {i}", state
