"""The elements of a GeoGebra file: objects by their commands and expressions, and how each is shown."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, fromstring

from graphplan.output.exports.ggb_commands import letters, number
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.pens import Pen

WIDE, HIGH = 1280, 800  # pixels: the drawing pad
SOLID, DASHED = 0, 15  # GeoGebra's types of line
LINKS, CURVES, VECTORS, POINTS = 0, 2, 5, 8  # its layers
NAME, NAME_AND_VALUE, CAPTION = 0, 1, 3  # what it shows as a label
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
        """A label that nothing else has."""
        self.count += 1
        return f"{begins}_{{{self.count}}}"

    def command(self, name: str, inputs: Sequence[str], outputs: Sequence[str]) -> None:
        command = SubElement(self.construction, "command", {"name": name})
        SubElement(command, "input", {f"a{i}": text for i, text in enumerate(inputs)})
        SubElement(command, "output", {f"a{i}": text for i, text in enumerate(outputs)})

    def expression(self, label: str, text: str, **kind: object) -> None:
        empty(self.construction, "expression", label=label, exp=text, **kind)

    def numeric(self, label: str, text: str, kind: str = "numeric", **of_type: object) -> str:
        """A number, or an object of another kind, that nobody sees."""
        self.expression(label, text, **of_type)
        self.element(kind, label, False, False, pens.THIN, CURVES)
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
    """An element with nothing but attributes."""
    return SubElement(parent, name, {key: _xml_value(value) for key, value in attributes.items()})


def _xml_value(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)
