"""Drawings in SVG, of Inkscape, GeoGebra or graphplan itself: points, lines and circles in mm, with their letters.

What hides is not seen, and what is no drawing on a sheet of graphplan's own - paper, words, letters - is left out. The
sheet's scene and sentences are not looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path as File
from typing import Any
from xml.etree.ElementTree import Element

from svgelements import Circle, Ellipse, Matrix, Path, Polygon, Polyline, Rect, SimpleLine

from graphplan.errors import Refused
from graphplan.kernel.kinds import POINT
from graphplan.marking.files.curves import DOT, curved, pieces
from graphplan.marking.files.drawing import NO_DRAWING, Lettering, drawing, lettering, same_paper
from graphplan.marking.files.safe import DEEPEST, MB, TRACES, Budget, contents, on_paper, tree
from graphplan.marking.files.svg_space import (
    Look,
    Looks,
    Viewport,
    chains,
    fitted,
    inherited,
    length,
    paper,
    path,
    spot,
    transform,
    view_box,
)
from graphplan.marking.traces import Frames, Submission, Trace

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


LARGEST = 16 * MB
VISITS, LETTERS = 30_000, 400_000  # elements, and letters of attributes and words; those of copies among them
GROUPS = {"svg", "g", "a", "switch"}
READ = {*GROUPS, "use", "text", "circle", "ellipse", "line", "polyline", "polygon", "rect", "path"}
NOT_DRAWN = {f"layer-{name}" for name in NO_DRAWING}
SHAPES: dict[str, tuple[Any, tuple[str, ...]]] = {  # with the lengths that say where they lie
    "circle": (Circle, ("cx", "cy", "r")), "ellipse": (Ellipse, ("cx", "cy", "rx", "ry")),
    "line": (SimpleLine, ("x1", "y1", "x2", "y2")), "rect": (Rect, ("x", "y", "width", "height")),
}  # fmt: skip
CHAINS: dict[str, Any] = {"polyline": Polyline, "polygon": Polygon}


def read_svg(path: File, frames: Frames, size: tuple[float, float] | None = None) -> Submission:
    """The things drawn in an SVG file; on graphplan's own sheet of this size plans lie where its frames say."""
    root = tree(path, contents(path, LARGEST))
    if root.tag != "svg":
        raise Refused(f"{path}", f"this is XML of another kind ({root.tag[:20]})", "give an SVG drawing")
    reader = _SvgReader(path, root)
    reader.read()
    return drawing(path, reader.traces, reader.words, frames if reader.own and same_paper(reader.size, size) else {})


@dataclass(frozen=True)
class _Place:
    """Where an element stands: its map to paper, its view, how things look, how deep it is, whether it is drawn."""

    onto: Matrix
    view: Viewport
    look: Look
    depth: int = 0
    drawn: bool = True


class _SvgReader:
    """Walks one document."""

    def __init__(self, path: File, root: Element):
        self.path, self.root = path, root
        self.traces: list[Trace] = []
        self.words: list[Lettering] = []
        self.named = {name: element for element in root.iter() if (name := element.get("id"))}
        self.looks = Looks(root)
        self.budget, self.things = Budget(path, VISITS, "elements"), Budget(path, TRACES, "things drawn")
        self.letters = Budget(path, LETTERS, "letters of attributes and words")
        self.size: tuple[float, float] = (0.0, 0.0)
        self.own = any(element.get("class") == "layer-paper" for element in root)

    def read(self) -> None:
        """Gather what is drawn and written."""
        try:
            onto, view, self.size = paper(self.root)
            place = _Place(onto, view, inherited(self.looks.of(self.root), {}))
            for child in self.root:
                self._element(child, place)
        except (ValueError, OverflowError) as error:
            raise Refused(f"{self.path}", str(error), "save the drawing anew") from None

    def _element(self, element: Element, place: _Place) -> None:
        """One element and all in it."""
        self.budget.spend()
        if element.tag not in READ:
            return
        self.letters.spend(sum(map(len, element.attrib.values())))
        look = self.looks.of(element)
        if look.get("display", "").strip() == "none":
            return
        if place.depth > DEEPEST:
            raise Refused(f"{self.path}", f"copies are nested more than {DEEPEST} deep", "ungroup the drawing")
        onto = transform(element.get("transform")) * place.onto
        if not on_paper(onto.a, onto.b, onto.c, onto.d, onto.e, onto.f):
            raise ValueError("a transform leads off the paper")
        drawn = place.drawn and element.get("class") not in NOT_DRAWN
        here = _Place(onto, place.view, inherited(look, place.look), place.depth + 1, drawn)
        if element.tag in GROUPS:
            self._group(element, here)
        elif element.tag == "use":
            self._copy(element, here)
        elif here.look.get("visibility") not in ("hidden", "collapse"):
            self._seen(element, here)

    def _seen(self, element: Element, place: _Place) -> None:
        """What is to be seen of an element; letters beside marks stand on layers of a sheet that are no drawing."""
        if element.tag == "text":
            self.budget.spend(sum(1 for _ in element.iter()))
            self.letters.spend(sum(map(len, element.itertext())))
            self.words += words(element, place.onto, place.view, place.look, self.looks)
        elif place.drawn:
            self._shape(element, place)

    def _group(self, element: Element, place: _Place) -> None:
        if element.tag == "svg":
            view = Viewport(*(place.view(element, key, place.view.part(key)) for key in ("width", "height")))
            box = view_box(element)
            onto = fitted(element, *view) * _shift(element, place.view) * place.onto
            place = replace(place, onto=onto, view=Viewport(*box[2:]) if box else view)
        for child in element:
            self._element(child, place)

    def _copy(self, element: Element, place: _Place) -> None:
        """Another element of the same file, here."""
        target = self.named.get(element.get("href", "").removeprefix("#"))
        if target is None:
            return
        there = replace(place, onto=_shift(element, place.view) * place.onto)
        if target.tag == "symbol":
            self._group(target, there)
        else:
            self._element(target, there)

    def _shape(self, element: Element, place: _Place) -> None:
        """A shape's traces; without a stroke it is no more than a dot."""
        stroked = place.look.get("stroke", "none").strip() not in ("none", "transparent")
        for trace in _traces(element, place.onto, place.view):
            self.things.spend()
            if stroked or trace.kind == POINT:
                self.traces.append(trace)


def _shift(element: Element, view: Viewport) -> Matrix:
    """By how much an element moves what is in it."""
    return Matrix(1, 0, 0, 1, view(element, "x"), view(element, "y"))


def _traces(element: Element, onto: Matrix, view: Viewport) -> Iterator[Trace]:
    """What a shape shows on paper; one as small as a dot shows where it is."""
    if element.tag == "path":
        shape = path(element.get("d", ""))
    elif element.tag in CHAINS:
        shape = CHAINS[element.tag](points=element.get("points", ""))
    else:
        made, keys = SHAPES[element.tag]
        sizes = {key: view(element, key) for key in keys}
        radii = [sizes[key] for key in ("r", "rx", "ry") if key in sizes]
        if radii and 0 < max(radii) * abs(onto.determinant) ** 0.5 < DOT:
            yield Trace(POINT, (spot(onto, complex(sizes["cx"], sizes["cy"])),))
            return
        shape = made(**sizes | ({"rx": radii[0] or radii[1], "ry": radii[1] or radii[0]} if "rx" in sizes else {}))
    for smooth, spots in chains(Path(shape), onto):
        if not smooth:
            yield from pieces(spots)
        elif one := curved(spots):
            yield one
