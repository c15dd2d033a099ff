"""The construction as a GeoGebra file: free points of the pose, everything else by commands that depend on them.

A step is written by GeoGebra's own commands where its marks allow it, else by its formula. Crossings of circles are
laid off to the side that is declared, so they stay on it when points are dragged: GeoGebra numbers its intersections,
but not by side. Only what GeoGebra 4.0 and its successors share is used. In the construction protocol the caption of
each object is its sentence; every plan begins with a breakpoint.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Mapping, Sequence
from itertools import pairwise
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, Movement
from graphplan.kernel.tape.written import Language, operations
from graphplan.output.exports.formula import formula
from graphplan.output.exports.walk import BACK, FRONT, Elements, at_home, parameters, turned_back
from graphplan.sheet.lettering.lettering import name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Polygon, Spot
from graphplan.sheet.plates.drawn_step import DrawnStep, Stroke, StruckArc
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import Plate, Plates

DEEPEST = 3  # operations within each other: GeoGebra 4.0 takes twice as long to read each one more
CENTRES = "Vector[{centre0}, {centre1}]"
APART = "Distance[{centre0}, {centre1}]"
ALONG = f"({APART}^2 + {{radius0}}^2 - {{radius1}}^2) / (2 * {APART})"  # on the line of centres, to the chord

# The command of each movement, and its inputs: {k} is what lengths from another plan are multiplied by, {sign} that of
# the side declared, {dx} and {dy} are in mm; {centre0} and {radius0} are those of the circle {0}.
COMMANDS = {
    Movement.RULED: ("Line", "{0}", "{1}"),
    Movement.GUIDED: ("Line", "{0}", "Vector[({dx}, {dy})]"),
    Movement.PARALLEL: ("Line", "{1}", "{0}"),
    Movement.PERPENDICULAR: ("OrthogonalLine", "{1}", "{0}"),
    Movement.BISECTED: ("LineBisector", "{0}", "{1}"),
    Movement.MET: ("Intersect", "{0}", "{1}"),
    Movement.OPENED: ("Distance", "{0}", "{1}"),
    Movement.STRUCK: ("Circle", "{0}", "{k} * {1}"),
    Movement.HALVED: ("Midpoint", "{0}", "{1}"),
    Movement.DROPPED: ("Intersect", "{0}", "OrthogonalLine[{1}, {0}]"),
    Movement.LAID_OFF: ("Translate", "{2}", "{k} * Vector[{0}, {1}]"),
    Movement.TURNED: ("Translate", "{2}", "{k} * OrthogonalVector[Vector[{0}, {1}]]"),
    Movement.LAID_BY_COMPONENTS: ("Translate", "{0}", "Vector[({dx}, {dy})]"),
    Movement.CUT: ("Translate", "Intersect[{0}, OrthogonalLine[{centre1}, {0}]]",
                   "{sign}sqrt({radius1}^2 - Distance[{centre1}, {0}]^2) * UnitVector[{0}]"),
    Movement.ARCS_MET: ("Translate", f"Translate[{{centre0}}, {ALONG} * UnitVector[{CENTRES}]]",
                        f"{{sign}}sqrt({{radius0}}^2 - ({ALONG})^2) * UnitOrthogonalVector[{CENTRES}]"),
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


def written(drawn: DrawnStep, labels: Mapping[DrawnStep, str]) -> tuple[Terms, str, list[str]]:
    """The numbers that a mark needs, by label, and its command with its inputs; without a name an expression."""
    movement = drawn.step.op.movement
    if movement in COMMANDS and at_home(drawn):
        name, *inputs = COMMANDS[movement]
        told = {name: number(value) for name, value in parameters(drawn).items()}
        for place, arg in enumerate(drawn.args):
            if arg.kind == CIRCLE:
                told[f"centre{place}"], told[f"radius{place}"] = _circle(arg, labels)
        told["sign"] = "-" if turned_back(drawn) else ""
        return (), name, [text.format(*(labels[arg] for arg in drawn.args), **told) for text in inputs]
    read = [_coordinates(arg, labels) for arg in drawn.args]
    found = formula(drawn, read, LANGUAGE, f"number{drawn.index}n", DEEPEST)
    name, texts = RESULTS[drawn.kind]
    return found.terms, name, [text.format(*found.results) for text in texts]


def _circle(circle: DrawnStep, labels: Mapping[DrawnStep, str]) -> tuple[str, str]:
    """The centre and the radius of a circle: the marks that it was struck with, where they are as large here."""
    if circle.step.op.movement is Movement.STRUCK and at_home(circle):
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


# ---- the file --------------------------------------------------------------------------------------------------------

WIDE, HIGH = 1400, 900  # pixels of the drawing pad
TYPES = {POINT: "point", LINE: "line", OPENING: "numeric", CIRCLE: "conic"}
RESERVED = {"x", "y", "z", "e", "i", "π"}  # letters that mean something else in GeoGebra
OWN = {"segment": "stroke", "vector": "vector", "conicpart": "arc", "polygon": "link"}  # so begin labels made here
TAKEN = ("number", "side", "caption", *OWN.values(), *TYPES)
LABEL = re.compile(r"[^\W\d_][^\W_]*'*(_\{[^\W_]+\})?'*")
SOLID, DASHED = 0, 15  # GeoGebra's types of line
LINKS, CURVES, VECTORS, POINTS = 0, 2, 5, 8  # its layers
NAME, CAPTION = 0, 3  # what it shows as a label
STAMP = (1980, 1, 1, 0, 0, 0)  # of the files in the archive: a construction has no date
SCENE = "scene.toml"  # what GeoGebra does not look at, and `import` reads: the scene


def geogebra(plates: Plates) -> bytes:
    """The construction as a .ggb file, the same bytes in every run."""
    root = _GeoGebraWriter(plates).document()
    indent(root, " ")
    packed = io.BytesIO()
    text = '<?xml version="1.0" encoding="utf-8"?>\n' + tostring(root, encoding="unicode") + "\n"
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, member in (("geogebra.xml", text), (SCENE, plates.scene.text)):
            entry = zipfile.ZipInfo(name, STAMP)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, member)
    return packed.getvalue()


def letters(name: str) -> str:
    """A mark's name as GeoGebra sets it: primes, Greek letters, a subscript in braces."""
    return "".join(f"_{{{run.text}}}" if run.level else run.text for run in name_runs(name)).replace("′", "'").replace(
        "″", "''")


def labels(plates: Plates) -> dict[DrawnStep, str]:
    """The label of every mark: its letters where GeoGebra allows them, else its kind and place."""
    found: dict[DrawnStep, str] = {}
    taken = set(RESERVED)
    for place, drawn in enumerate(plates.drawn):
        letter = letters(drawn.name)
        fits = LABEL.fullmatch(letter) and not letter.startswith(TAKEN) and letter not in taken
        found[drawn] = letter if fits else f"{drawn.kind}_{{{place}}}"
        taken.add(found[drawn])
    return found


class _GeoGebraWriter(Elements):
    """Writes one construction, mark by mark."""

    part, along = "Translate[{0}, {part} * Vector[{0}, {1}]]", "Translate[{0}, {part} * UnitVector[{2}]]"
    number = staticmethod(number)

    def named(self) -> Mapping[DrawnStep, str]:
        return labels(self.plates)

    # ---- the document ------------------------------------------------------------------------------------------

    def document(self) -> Element:
        root = Element("geogebra", {"format": "4.0"})
        gui = SubElement(root, "gui")
        _empty(gui, "show", algebraView=False, spreadsheetView=False, auxiliaryObjects=False, algebraInput=False)
        _empty(gui, "labelingStyle", val=3)
        _empty(gui, "consProtColumns", **{f"col{i}": True for i in range(8)})
        _empty(gui, "consProtocol", useColors=True, addIcons=False, showOnlyBreakpoints=False)
        _empty(gui, "consProtNavigationBar", show=True, playButton=True, playDelay=2.0, protButton=True)
        self._view(SubElement(root, "euclidianView"))
        kernel = SubElement(root, "kernel")
        _empty(kernel, "continuous", val=False)
        _empty(kernel, "decimals", val=4)
        _empty(kernel, "angleUnit", val="degree")
        self.write()
        root.append(self.construction)
        return root

    def _view(self, view: Element) -> None:
        """All plans, with no axes and one scale."""
        box = self.plates.box
        scale = min(WIDE / box.width, HIGH / box.height) * 0.94
        (x, y), middle = box.centre, (WIDE / 2, HIGH / 2)
        _empty(view, "size", width=WIDE, height=HIGH)
        _empty(view, "coordSystem", xZero=middle[0] - x * scale, yZero=middle[1] + y * scale, scale=scale, yscale=scale)
        _empty(view, "evSettings", axes=False, grid=False, gridIsBold=False, pointCapturing=0, rightAngleStyle=1)
        _empty(view, "bgColor", r=255, g=255, b=255)
        for axis in (0, 1):
            _empty(view, "axis", id=axis, show=False, label="", unitLabel="", tickStyle=1, showNumbers=False)

    def write(self) -> None:
        """The pose and its links, then step by step; vectors and strokes as soon as their marks are there."""
        self.construction, self.count = Element("construction", {"title": self.title, "author": "", "date": ""}), 0
        pose = [drawn for drawn in self.plates.drawn if not drawn.number]
        for drawn in pose:
            self._mark(drawn)
        for plate in self.plates:
            for item, spots in self.mechanism(plate, *BACK, *FRONT):
                if not isinstance(item, Circle) and item.pen != pens.HOLLOW:
                    self._shape(pens.LINK if item.pen == pens.BAR else item.pen, spots, isinstance(item, Polygon))
            self._caption(plate)
        for drawn in [*pose, *self.plates.drawn[len(pose):]]:
            if drawn.number:
                self._mark(drawn)
            for one in self.due.get(drawn, ()):
                self._arc(one) if isinstance(one, StruckArc) else self._stroke(one)

    # ---- marks -------------------------------------------------------------------------------------------------

    def _mark(self, drawn: DrawnStep) -> None:
        label, point = self.names[drawn], drawn.kind == POINT
        if not drawn.free:
            self._made(drawn, label)
        lettered = point and bool(drawn.name)
        shown = lettered or (point and drawn.view.rect.holds(drawn.at))
        pen = pens.ARC if not point else pens.PAIR if not drawn.number else pens.ORIGIN if drawn.free else pens.DOT
        element = self._element(TYPES[drawn.kind], label, shown, lettered, pen, POINTS if point else CURVES)
        if point:
            _empty(element, "coords", x=drawn.at[0], y=drawn.at[1], z=1.0)
            _empty(element, "pointSize", val=3 if drawn.name else 1)
            _empty(element, "pointStyle", val=0)
        if drawn.kind == OPENING:
            _empty(element, "value", val=drawn.radius)
        if lettered and label != letters(drawn.name):
            self._lettered(element, drawn.name)
        else:
            _empty(element, "caption", val=drawn.sentence)
        if drawn in self.plates.firsts:
            _empty(element, "breakpoint", val=True)

    def _made(self, drawn: DrawnStep, label: str) -> None:
        """The command or expression by which it depends on others."""
        terms, name, inputs = written(drawn, self.names)
        for term, text in terms:
            _empty(self.construction, "expression", label=term, exp=text)
            self._element("numeric", term, False, False, pens.THIN, CURVES)
        if name:
            self._command(name, inputs, [label])
        else:
            _empty(self.construction, "expression", label=label, exp=inputs[0], type=TYPES[drawn.kind])

    def _command(self, name: str, inputs: Sequence[str], outputs: Sequence[str]) -> None:
        command = SubElement(self.construction, "command", {"name": name})
        SubElement(command, "input", {f"a{i}": text for i, text in enumerate(inputs)})
        SubElement(command, "output", {f"a{i}": text for i, text in enumerate(outputs)})

    def _drawn(self, kind: str, command: str, inputs: Sequence[str], pen: Pen, layer: int, letter: str = "") -> None:
        """What is seen of marks: a shape by its command."""
        self.count += 1
        label = f"{OWN[kind]}_{{{self.count}}}"
        sides = [f"side_{{{self.count},{i}}}" for i in range(len(inputs))] if kind == "polygon" else []
        self._command(command, inputs, [label, *sides])
        element = self._element(kind, label, True, bool(letter), pen, layer)
        for side in sides:
            self._element("segment", side, False, False, pen, layer)
        if letter:
            self._lettered(element, letter)

    def _element(self, type: str, label: str, shown: bool, lettered: bool, pen: Pen, layer: int) -> Element:
        element = SubElement(self.construction, "element", {"type": type, "label": label})
        _empty(element, "show", object=shown, label=lettered)
        r, g, b = pens.rgb(pen.colour)
        _empty(element, "objColor", r=r, g=g, b=b, alpha=0.1 if type == "polygon" else 0.0)
        _empty(element, "layer", val=layer)
        _empty(element, "labelMode", val=NAME)
        if type not in ("point", "numeric"):
            _empty(element, "lineStyle", thickness=max(1, round(pen.width * 8)), type=DASHED if pen.dash else SOLID)
        if not lettered and type != "vector":
            _empty(element, "auxiliary", val=True)
        return element

    def _lettered(self, element: Element, name: str) -> None:
        """Show a name as the label of an object that is called otherwise."""
        for mode in element.iter("labelMode"):
            mode.set("val", str(CAPTION))
        _empty(element, "caption", val=letters(name))

    # ---- what is seen of them ----------------------------------------------------------------------------------

    def _stroke(self, stroke: Stroke) -> None:
        """A stroke or a vector between its marks, or parts of the way."""
        letter = (stroke.letter or stroke.of.name) if stroke in self.lettered else ""
        kind, layer = ("vector", VECTORS) if stroke.head else ("segment", CURVES)
        self._drawn(kind, kind.capitalize(), self.ends(stroke), stroke.pen, layer, letter)

    def _arc(self, arc: StruckArc) -> None:
        """As much of a circle as serves its mark."""
        centre, mark = f"Center[{self.names[arc.of]}]", self.names[arc.mark]
        turns = (f"Rotate[{mark}, {number(turn)}°, {centre}]" for turn in (-arc.before, arc.after))
        self._drawn("conicpart", "CircleArc", [centre, *turns], pens.ARC, CURVES)

    def _shape(self, pen: Pen, spots: Sequence[Spot], closed: bool) -> None:
        """A shape of the mechanism, on its joints or as it lies; only plates are filled."""
        places = [self.names[self.joints[spot]] if spot in self.joints else
                  f"({number(round(spot[0], 3))}, {number(round(spot[1], 3))})" for spot in spots]
        if pen == pens.PLATE:
            self._drawn("polygon", "Polygon", places, pens.LINK, LINKS)
            return
        for ends in pairwise([*places, *places[:closed]]):
            self._drawn("segment", "Segment", ends, pen, LINKS)

    def _caption(self, plate: Plate) -> None:
        """What a plan is, at the top of its window."""
        self.count += 1
        label, rect = f"caption_{{{self.count}}}", plate.view.rect
        _empty(self.construction, "expression", label=label, exp=f'"{plate.caption}"')
        element = self._element("text", label, True, False, pens.LETTERS, POINTS)
        _empty(element, "font", serif=False, size=0, style=1)
        _empty(element, "startPoint", x=rect.left, y=rect.top, z=1.0)


def _empty(parent: Element, name: str, **attributes: object) -> None:
    """An element with nothing but attributes."""
    SubElement(parent, name, {key: _said(value) for key, value in attributes.items()})


def _said(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)


Terms = Sequence[tuple[str, str]]
