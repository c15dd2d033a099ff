"""The construction as a GeoGebra file: free points of the pose, everything else by commands that depend on them.

A step is written by GeoGebra's own commands where its marks allow it (geogebra_commands.py), else by its formula. Only
what GeoGebra 4.0 and its successors share is used. In the construction protocol the caption of each object is its
sentence; every plan begins with a breakpoint.
"""

from __future__ import annotations

import io
import re
import zipfile
from functools import cached_property
from itertools import pairwise
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.output.exports.figure import Arrow, Figure, Link, Object, Plan, Symbol
from graphplan.output.exports.geogebra_commands import number, written
from graphplan.sheet.lettering.lettering import name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.pens import Pen

WIDE, HIGH = 1400, 900  # pixels of the drawing pad
TYPES = {POINT: "point", LINE: "line", OPENING: "numeric", CIRCLE: "conic"}
RESERVED = {"x", "y", "z", "e", "i", "π"}  # letters that mean something else in GeoGebra
OWN = ("number", "arc", "stroke", "laid", "vector", "link", "side", "caption", *TYPES)  # so begin labels made here
LABEL = re.compile(r"[^\W\d_][^\W_]*'*(_\{[^\W_]+\})?'*")
SOLID, DASHED = 0, 15  # GeoGebra's types of line
LINKS, CURVES, VECTORS, POINTS = 0, 2, 5, 8  # its layers
NAME, CAPTION = 0, 3  # what it shows as a label
STAMP = (1980, 1, 1, 0, 0, 0)  # of the file in the archive: a construction has no date


def geogebra(figure: Figure) -> bytes:
    """The figure as a .ggb file, the same bytes in every run."""
    root = _Writer(figure).document()
    indent(root, " ")
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        entry = zipfile.ZipInfo("geogebra.xml", STAMP)
        entry.compress_type = zipfile.ZIP_DEFLATED
        archive.writestr(entry, '<?xml version="1.0" encoding="utf-8"?>\n' + tostring(root, encoding="unicode") + "\n")
    return packed.getvalue()


def letters(name: str) -> str:
    """A mark's name as GeoGebra sets it: primes, Greek letters, a subscript in braces."""
    return "".join(f"_{{{run.text}}}" if run.level else run.text for run in name_runs(name)).replace("′", "'").replace(
        "″", "''")


def labels(figure: Figure) -> dict[Object, str]:
    """The label of every object: its letters where GeoGebra allows them, else its kind and place."""
    found: dict[Object, str] = {}
    taken = set(RESERVED)
    for place, object in enumerate(figure.objects):
        letter = letters(object.name)
        fits = LABEL.fullmatch(letter) and not letter.startswith(OWN) and letter not in taken
        found[object] = letter if fits else f"{object.kind}_{{{place}}}"
        taken.add(found[object])
    return found


class _Writer:
    """Writes one figure, object by object."""

    def __init__(self, figure: Figure):
        self.figure, self.labels = figure, labels(figure)
        self.firsts = set(figure.firsts.values())
        self.construction = Element("construction", {"title": figure.title, "author": "", "date": ""})

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
        self._write()
        root.append(self.construction)
        return root

    def _view(self, view: Element) -> None:
        """All plans, with no axes and one scale."""
        box = self.figure.box
        scale = min(WIDE / box.width, HIGH / box.height) * 0.94
        (x, y), middle = box.centre, (WIDE / 2, HIGH / 2)
        _empty(view, "size", width=WIDE, height=HIGH)
        _empty(view, "coordSystem", xZero=middle[0] - x * scale, yZero=middle[1] + y * scale, scale=scale, yscale=scale)
        _empty(view, "evSettings", axes=False, grid=False, gridIsBold=False, pointCapturing=0, rightAngleStyle=1)
        _empty(view, "bgColor", r=255, g=255, b=255)
        for axis in (0, 1):
            _empty(view, "axis", id=axis, show=False, label="", unitLabel="", tickStyle=1, showNumbers=False)

    def _write(self) -> None:
        """The pose and its links, then step by step; vectors and strokes as soon as their marks are there."""
        figure = self.figure
        pose = [object for object in figure.objects if not object.number]
        for object in pose:
            self._object(object)
        for place, symbol in enumerate(figure.symbols):
            self._symbol(symbol, place)
        for link in figure.links:
            self._link(link)
        for plan in figure.plans:
            self._caption(plan)
        for object in pose:
            self._after(object)
        for object in figure.steps:
            self._object(object)
            self._after(object)

    def _after(self, object: Object) -> None:
        """What can be drawn once a mark is there."""
        for curve, place in self._waiting.get(object, ()):
            self._stroke(curve, place)
        if object.root and not any(object is arrow.end for arrow in self.figure.arrows):
            self._laid_off(object.root, object)
        for arrow in self.figure.arrows:
            if object is max(arrow.start, arrow.end, key=lambda mark: mark.index):
                self._vector(arrow)

    @cached_property
    def _waiting(self) -> dict[Object, list[tuple[Object, Object]]]:
        """For each mark the lines whose last it is, and the circles that it lies on, each with itself."""
        found: dict[Object, list[tuple[Object, Object]]] = {}
        for curve, marks in self.figure.marks.items():
            last = marks if curve.kind == CIRCLE else sorted(marks, key=lambda mark: mark.index)[-1:]
            for mark in last:
                found.setdefault(max(mark, curve, key=lambda one: one.index), []).append((curve, mark))
        return found

    # ---- objects -----------------------------------------------------------------------------------------------

    def _object(self, object: Object) -> None:
        label = self.labels[object]
        if not object.free:
            self._made(object, label)
        lettered = object.kind == POINT and not object.auxiliary
        shown = lettered or (object.kind == POINT and object.plan.rect.holds(object.at))
        element = self._element(TYPES[object.kind], label, shown, lettered, object.pen,
                                POINTS if object.kind == POINT else CURVES)
        if object.kind == POINT:
            _empty(element, "coords", x=object.at[0], y=object.at[1], z=1.0)
            _empty(element, "pointSize", val=3 if object.name else 1)
            _empty(element, "pointStyle", val=0)
        if object.kind == OPENING:
            _empty(element, "value", val=object.radius)
        if lettered and label != letters(object.name):
            self._lettered(element, object.name)
        else:
            _empty(element, "caption", val=object.sentence)
        if object in self.firsts:
            _empty(element, "breakpoint", val=True)

    def _made(self, object: Object, label: str) -> None:
        """The command or expression by which it depends on others."""
        made = written(object, self.labels)
        for term, text in made.terms:
            _empty(self.construction, "expression", label=term, exp=text)
            self._element("numeric", term, False, False, object.pen, CURVES)
        if made.name:
            self._command(made.name, made.inputs, [label])
        else:
            _empty(self.construction, "expression", label=label, exp=made.inputs[0], type=TYPES[object.kind])

    def _command(self, name: str, inputs: list[str], outputs: list[str]) -> None:
        command = SubElement(self.construction, "command", {"name": name})
        SubElement(command, "input", {f"a{i}": text for i, text in enumerate(inputs)})
        SubElement(command, "output", {f"a{i}": text for i, text in enumerate(outputs)})

    def _element(self, type: str, label: str, shown: bool, lettered: bool, pen: Pen, layer: int) -> Element:
        element = SubElement(self.construction, "element", {"type": type, "label": label})
        _empty(element, "show", object=shown, label=lettered)
        r, g, b = (int(pen.colour[i : i + 2], 16) for i in (1, 3, 5))
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

    def _stroke(self, curve: Object, mark: Object) -> None:
        """As much of a line or a circle as serves its marks."""
        name = self.labels[curve]
        if curve.kind == CIRCLE:
            at, label, turn = self.labels[mark], f"arc_{{{curve.index},{mark.index}}}", number(curve.struck)
            ends = [f"Rotate[{at}, {sign}{turn}°, Center[{name}]]" for sign in ("-", "")]
            self._command("CircleArc", [f"Center[{name}]", *ends], [label])
            self._element("conicpart", label, True, False, curve.pen, CURVES)
        elif stretch := self.figure.stretch(curve):
            start, end, beyond = self.labels[stretch[0]], self.labels[stretch[1]], stretch[2]
            along, label = f"{number(beyond)} * UnitVector[{name}]", f"stroke_{{{curve.index}}}"
            ends = [f"Translate[{start}, -{along}]", f"Translate[{end}, {along}]"] if beyond else [start, end]
            self._command("Segment", ends, [label])
            self._lettered(self._element("segment", label, True, bool(curve.name), curve.pen, CURVES), curve.name)

    def _laid_off(self, root: Object, object: Object) -> None:
        """The stroke along which a point was laid off."""
        label = f"laid_{{{object.index}}}"
        self._command("Segment", [self.labels[root], self.labels[object]], [label])
        self._element("segment", label, True, False, pens.THIN, CURVES)

    def _vector(self, arrow: Arrow) -> None:
        label = f"vector_{{{arrow.start.index},{arrow.end.index},{self.figure.arrows.index(arrow)}}}"
        self._command("Vector", [self.labels[arrow.start], self.labels[arrow.end]], [label])
        said = bool(arrow.label) and arrow.label != arrow.end.name
        element = self._element("vector", label, True, said, pens.VECTORS[arrow.kind], VECTORS)
        self._lettered(element, arrow.label)

    def _link(self, link: Link) -> None:
        """A bar, or the plate of three points and more."""
        corners, place = [self.labels[point] for point in link.corners], self.figure.links.index(link)
        if len(corners) > 2:
            sides = [f"side_{{{place},{i}}}" for i in range(len(corners))]
            self._command("Polygon", corners, [f"link_{{{place}}}", *sides])
            for type, label in (("polygon", f"link_{{{place}}}"), *(("segment", side) for side in sides)):
                self._element(type, label, True, False, pens.LINK, LINKS)
        bars = [(self.labels[corner], self.labels[inner]) for corner, inner in link.ribs]
        for i, ends in enumerate([(corners[0], corners[1])] if len(corners) == 2 else bars):
            self._command("Segment", list(ends), [f"link_{{{place},{i}}}"])
            self._element("segment", f"link_{{{place},{i}}}", True, False, pens.LINK, LINKS)

    def _symbol(self, symbol: Symbol, place: int) -> None:
        """A symbol of the mechanism as it lies; nothing is filled."""
        spots = [f"({number(round(x, 3))}, {number(round(y, 3))})" for x, y in symbol.spots]
        for i, ends in enumerate(pairwise([*spots, spots[0]] if symbol.closed else spots)):
            self._command("Segment", list(ends), [f"symbol_{{{place},{i}}}"])
            self._element("segment", f"symbol_{{{place},{i}}}", True, False, symbol.pen, LINKS)

    def _caption(self, plan: Plan) -> None:
        """What a plan is, at the top of its window."""
        label = f"caption_{{{self.figure.plans.index(plan)}}}"
        _empty(self.construction, "expression", label=label, exp=f'"{plan.caption}"')
        element = self._element("text", label, True, False, pens.LETTERS, POINTS)
        _empty(element, "font", serif=False, size=0, style=1)
        _empty(element, "startPoint", x=plan.rect.left, y=plan.rect.top, z=1.0)


def _empty(parent: Element, name: str, **attributes: object) -> None:
    """An element with nothing but attributes."""
    SubElement(parent, name, {key: _said(value) for key, value in attributes.items()})


def _said(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)
