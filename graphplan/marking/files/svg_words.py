"""Texts of an SVG file as they stand on paper: their lines, subscripts among them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element

from svgelements import Matrix

from graphplan.marking.files.labels import Lettering, lettering
from graphplan.marking.files.svg_space import Look, Looks, Viewport, inherited, length, spot

ANCHORS = {"middle": 0.5, "end": 1.0}
SIZE = "16"  # px, unless it is said


@dataclass
class _Line:
    """A line of letters while it is read; `drop` is how far the pen is below its base, in user units."""

    at: complex
    size: float
    anchor: float
    drop: float = 0.0
    low: bool = False
    letters: list[str] = field(default_factory=list)

    def add(self, text: str | None, low: bool) -> None:
        """Letters on the base line, or set lower."""
        letters = " ".join((text or "").split())
        if letters:
            self.letters += ["_"] * (low and not self.low and bool(self.letters)) + [letters]
            self.low = low


def words(element: Element, onto: Matrix, view: Viewport, look: Look, looks: Looks) -> Iterator[Lettering]:
    """The lines of a text element; `look` is what it has inherited, and its own."""
    size, anchor = length(look.get("font-size", SIZE)), ANCHORS.get(look.get("text-anchor", ""), 0.0)
    line = _Line(_at(element, view, 0j), size, anchor)
    line.add(element.text, False)
    lines = [line]
    for span in element:
        if span.tag == "tspan":
            _spanned(span, lines, view, look, looks, False)
        lines[-1].add(span.tail, lines[-1].drop > 0)
    for line in lines:
        if line.letters:
            size = line.size * abs(onto.determinant) ** 0.5
            yield lettering("".join(line.letters), spot(onto, line.at), size, line.anchor)


def _spanned(span: Element, lines: list[_Line], view: Viewport, look: Look, looks: Looks,
             low: bool) -> None:
    """A span: it goes on in the line, lower or not, or begins another at its own place."""
    own = looks.of(span)
    look = inherited(own, look)
    size = length(look.get("font-size", SIZE))
    if span.get("x") is not None:
        anchor = ANCHORS.get(look.get("text-anchor", ""), 0.0)
        lines.append(_Line(_at(span, view, lines[-1].at), size, anchor))
    else:
        lines[-1].drop += length(_first(span.get("dy")), view.high)
    line = lines[-1]
    low = low or line.drop > 0.05 * line.size or own.get("baseline-shift", "").startswith(("sub", "-"))
    line.add(span.text, low)
    for inner in span:
        if inner.tag == "tspan":
            _spanned(inner, lines, view, look, looks, low)
        lines[-1].add(inner.tail, low)


def _at(element: Element, view: Viewport, otherwise: complex) -> complex:
    x = length(_first(element.get("x")), view.wide, otherwise.real)
    return complex(x, length(_first(element.get("y")), view.high, otherwise.imag))


def _first(written: str | None) -> str | None:
    """The first of several lengths: letters may have one each."""
    return written.replace(",", " ").split()[0] if written and written.strip(" ,") else None
