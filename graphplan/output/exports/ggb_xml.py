"""The elements of a GeoGebra file: objects by their commands and expressions, and how each is shown."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement

from graphplan.output.exports.ggb_commands import letters, number
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.pens import Pen

WIDE, HIGH = 1280, 800  # pixels: the drawing pad
SOLID, DASHED = 0, 15  # GeoGebra's types of line
LINKS, CURVES, VECTORS, POINTS = 0, 2, 5, 8  # its layers
NAME, NAME_AND_VALUE, CAPTION = 0, 1, 3  # what it shows as a label
OWN = {"segment": "stroke", "vector": "vector", "conicpart": "arc", "polygon": "link"}  # so begin labels made here


class Objects:
    """The objects of one construction, in order; `shown_if` is the condition of what is entered now."""

    def __init__(self, title: str):
        self.construction, self.count, self.shown_if = Element("construction", title=title, author="", date=""), 0, ""

    def label(self, begins: str) -> str:
        """A label that nothing else has."""
        self.count += 1
        return f"{begins}_{{{self.count}}}"

    def command(self, name: str, inputs: Sequence[str], outputs: Sequence[str]) -> None:
        command = SubElement(self.construction, "command", {"name": name})
        SubElement(command, "input", {f"a{i}": text for i, text in enumerate(inputs)})
        SubElement(command, "output", {f"a{i}": text for i, text in enumerate(outputs)})

    def expression(self, label: str, text: str, **kind: object) -> None:
        empty(self.construction, "expression", label=label, exp=text, **kind)

    def numeric(self, label: str, text: str) -> str:
        """A number that nobody sees."""
        self.expression(label, text)
        self.element("numeric", label, False, False, pens.THIN, CURVES)
        return label

    def add_hidden_point(self, label: str, text: str) -> str:
        """A point that nobody sees."""
        self.expression(label, text, type="point")
        self.element("point", label, False, False, pens.THIN, CURVES)
        return label

    def add_shape(self, kind: str, command: str, inputs: Sequence[str], pen: Pen, layer: int,
                  letter: str = "") -> Element:
        """What is seen of marks: a shape by its command."""
        label = self.label(OWN[kind])
        sides = [f"side_{{{self.count},{i}}}" for i in range(len(inputs))] if kind == "polygon" else []
        self.command(command, inputs, [label, *sides])
        element = self.element(kind, label, True, bool(letter), pen, layer)
        for side in sides:
            self.element("segment", side, False, False, pen, layer)
        if letter:
            show_caption(element, letters(letter))
        return element

    def text(self, begins: str, exp: str, at: str, pen: Pen = pens.LETTERS, bold: bool = False) -> Element:
        """A text, by its expression, at a point that an expression gives."""
        label = self.label(begins)
        self.expression(label, exp)
        element = self.element("text", label, True, False, pen, POINTS)
        empty(element, "font", serif=False, sizeM=1.0, size=0, style=int(bold))
        empty(element, "startPoint", number=0, exp=at)
        return element

    def on_screen(self, begins: str, exp: str, x: int, y: int) -> Element:
        """A text that stays where it is on the screen, in pixels."""
        label = self.label(begins)
        self.expression(label, exp)
        element = self.element("text", label, True, False, pens.LETTERS, POINTS)
        empty(element, "font", serif=False, sizeM=1.0, size=2, style=0)
        empty(element, "absoluteScreenLocation", x=x, y=y)
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


def show_caption(element: Element, caption: str, mode: int = CAPTION) -> None:
    """Show a caption as the label of an object that is called otherwise."""
    for mode_element in element.iter("labelMode"):
        mode_element.set("val", str(mode))
    empty(element, "caption", val=caption)


def enter_view(document: Element, x: float, y: float, size: float) -> None:
    """The drawing pad, without axes: where its origin is, and so many pixels for a mm."""
    view = SubElement(document, "euclidianView")
    empty(view, "size", width=WIDE, height=HIGH)
    empty(view, "coordSystem", xZero=x, yZero=y, scale=size, yscale=size)
    empty(view, "evSettings", axes=False, grid=False, gridIsBold=False, pointCapturing=0, rightAngleStyle=1)
    empty(view, "bgColor", r=255, g=255, b=255)
    for axis in (0, 1):
        empty(view, "axis", id=axis, show=False, label="", unitLabel="", tickStyle=1, showNumbers=False)


def quote_text(words: str) -> str:
    """Words as a text of GeoGebra, which has no way to say its quotation mark."""
    return '"' + words.replace('"', "”") + '"'


def spot(x: float, y: float) -> str:
    """A place in mm."""
    return f"({number(round(x, 6))}, {number(round(y, 6))})"


def empty(parent: Element, name: str, **attributes: object) -> Element:
    """An element with nothing but attributes."""
    return SubElement(parent, name, {key: _xml_value(value) for key, value in attributes.items()})


def _xml_value(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)
