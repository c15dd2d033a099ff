"""Drawings in SVG, of Inkscape, GeoGebra or graphplan itself: points, lines and circles in mm, with their letters.

What hides is not seen, and what is no drawing on a sheet of graphplan's own - paper, words, letters - is left out. The
sheet's scene and sentences are not looked at. svgelements reads transforms and paths, as matrices and segments; it
takes much for granted, so what it would pass over in silence is refused here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path as File
from typing import Any
from xml.etree.ElementTree import Element

from svgelements import Circle, Close, Ellipse, Line, Matrix, Move, Path, Polygon, Polyline, Rect, SimpleLine

from graphplan.errors import Refused
from graphplan.kernel.kinds import POINT
from graphplan.marking.files import measures
from graphplan.marking.files.drawing import LAYERS_NOT_DRAWN, DrawingReader, dot_or_circle, sharp_corners, word_at
from graphplan.marking.files.paths import chains, traces_of_chain
from graphplan.marking.files.safe import Budget, contents, on_paper, tree
from graphplan.marking.files.svg_view import (
    NUMBERS,
    PHYSICAL_UNITS,
    Look,
    Looks,
    Viewport,
    fit_view_box,
    inherit_look,
    length,
    paper,
    spot,
    transform,
    view_box,
)
from graphplan.marking.traces import Frames, Lettering, Submission, Trace
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.plates.display import ENLARGED
from graphplan.sheet.plates.pens import LEADER

PATH = re.compile(r"\s*(?:[Mm][-+\d.,eE\s]*[\d.](?:[MmZzLlHhVvCcSsQqTtAa]|[-+\d.,eE\s])*)?")


def segments(data: str) -> Path:
    """Path data as segments.

    Fails with `ValueError` where they are none.
    """
    try:
        if PATH.fullmatch(data):
            return Path(data)
    except (ValueError, TypeError, AttributeError, ArithmeticError):
        pass
    raise ValueError(f"{data.strip()[:20]!r} is not a path")


ANCHOR_SHARES = {"middle": 0.5, "end": 1.0}
FONT_SIZE_PX = "16"  # px, unless it is said


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
    lines = [_begin_line(element, view, look, 0j)]
    lines[0].add(element.text, False)
    for span in element:
        if span.tag == "tspan":
            _add_span(span, lines, view, look, looks, False)
        lines[-1].add(span.tail, lines[-1].drop > 0)
    for line in lines:
        if line.letters:
            font_size = line.size * abs(onto.determinant) ** 0.5
            yield word_at("".join(line.letters), spot(onto, line.at), font_size, line.anchor)


def _add_span(span: Element, lines: list[_Line], view: Viewport, look: Look, looks: Looks, low: bool) -> None:
    """A span: it goes on in the line, lower or not, or begins another at its own place."""
    span_look = looks.look_of(span)
    look = inherit_look(span_look, look)
    if span.get("x") is not None:
        lines.append(_begin_line(span, view, look, lines[-1].at))
    else:
        lines[-1].drop += length(_first_length(span.get("dy")), view.high)
    line = lines[-1]
    low = low or line.drop > measures.MIN_SUBSCRIPT_DROP_SIZES * line.size or (
        span_look.get("baseline-shift", "").startswith(("sub", "-")))
    line.add(span.text, low)
    for inner in span:
        if inner.tag == "tspan":
            _add_span(inner, lines, view, look, looks, low)
        lines[-1].add(inner.tail, low)


def _begin_line(element: Element, view: Viewport, look: Look, otherwise: complex) -> _Line:
    """The line that begins with an element."""
    x = length(_first_length(element.get("x")), view.wide, otherwise.real)
    at = complex(x, length(_first_length(element.get("y")), view.high, otherwise.imag))
    return _Line(at, length(look.get("font-size", FONT_SIZE_PX)), ANCHOR_SHARES.get(look.get("text-anchor", ""), 0.0))


def _first_length(written: str | None) -> str | None:
    """The first of several lengths: letters may have one each."""
    return written.replace(",", " ").split()[0] if written and written.strip(" ,") else None


GROUP_TAGS = {"svg", "g", "a", "switch"}
READ_TAGS = {*GROUP_TAGS, "use", "text", "circle", "ellipse", "line", "polyline", "polygon", "rect", "path"}
LEADER_STYLE = LEADER.colour, f"{LEADER.width}"
CLASSES_NOT_DRAWN = {name if name in FACTS else f"layer-{name}" for name in LAYERS_NOT_DRAWN}
DETAILS_CLASS = f"layer-{ENLARGED}"
SHAPES: dict[str, tuple[Any, tuple[str, ...]]] = {  # with the lengths that say where they lie
    "circle": (Circle, ("cx", "cy", "r")), "ellipse": (Ellipse, ("cx", "cy", "rx", "ry")),
    "line": (SimpleLine, ("x1", "y1", "x2", "y2")), "rect": (Rect, ("x", "y", "width", "height")),
}  # fmt: skip
MARKERS = {"marker-start": 0, "marker-end": -1}  # with the place of the end of a stroke at which each is set
CHAIN_SHAPES: dict[str, Any] = {"polyline": Polyline, "polygon": Polygon}


def read_svg(path: File, frames: Frames, size: tuple[float, float] | None = None) -> Submission:
    """The things drawn in an SVG file; on graphplan's own sheet of this size plans lie where its frames say."""
    root = tree(path, contents(path, measures.MAX_SVG_BYTES))
    if root.tag != "svg":
        raise Refused(f"{path}", f"this is XML of another kind ({root.tag[:20]})", "give an SVG drawing")
    return _SvgReader(path, root).submission(frames, size)


@dataclass(frozen=True)
class _Place:
    """State of an element: its map to paper, its view, its style, its depth, whether it is drawn."""

    onto: Matrix
    view: Viewport
    look: Look
    depth: int = 0
    is_drawn: bool = True


class _SvgReader(DrawingReader):
    """Walks one document, and gathers what is drawn and written."""

    def __init__(self, path: File, root: Element):
        super().__init__(path)
        self.named = {name: element for element in root.iter() if (name := element.get("id"))}
        self.looks = Looks(root)
        self.budget = Budget(path, measures.MAX_ELEMENTS, "elements")
        self.things = Budget(path, measures.MAX_TRACES, "things drawn")
        self.letters = Budget(path, measures.MAX_LETTERS, "letters of attributes and words")
        self.millimetres = measures.STATED_UNIT_ODDS if PHYSICAL_UNITS.search(root.get("width", "")) else 0.0
        self.own = any(element.get("class") == "layer-paper" for element in root)
        try:
            onto, view, self.size = paper(root)
            place = _Place(onto, view, inherit_look(self.looks.look_of(root), {}))
            for child in root:
                self._element(child, place)
        except (ValueError, OverflowError) as error:
            raise Refused(f"{path}", str(error), "save the drawing anew") from None

    def _element(self, element: Element, place: _Place) -> None:
        """One element and all in it."""
        self.budget.spend()
        if element.tag not in READ_TAGS:
            return
        self.letters.spend(sum(map(len, element.attrib.values())))
        look = self.looks.look_of(element)
        if look.get("display", "").strip() == "none":
            return
        if place.depth > measures.MAX_XML_DEPTH:
            raise Refused(f"{self.path}", f"copies are nested more than {measures.MAX_XML_DEPTH} deep",
                          "ungroup the drawing")
        onto = transform(element.get("transform")) * place.onto
        if not on_paper(onto.a, onto.b, onto.c, onto.d, onto.e, onto.f):
            raise ValueError("a transform leads off the paper")
        if (name := element.get("class")) == DETAILS_CLASS:
            return  # what lies on a plan once more
        is_drawn = place.is_drawn and name not in CLASSES_NOT_DRAWN
        inner_place = _Place(onto, place.view, inherit_look(look, place.look), place.depth + 1, is_drawn)
        if element.tag in GROUP_TAGS:
            self._group(element, inner_place)
        elif element.tag == "use":
            self._copy(element, inner_place)
        elif inner_place.look.get("visibility") in ("hidden", "collapse"):
            return
        elif element.tag == "text":  # letters beside marks stand on layers of a sheet that are no drawing
            self.budget.spend(sum(1 for _ in element.iter()))
            self.letters.spend(sum(map(len, element.itertext())))
            self.words += words(element, inner_place.onto, inner_place.view, inner_place.look, self.looks)
        elif is_drawn:
            self._shape(element, inner_place)

    def _group(self, element: Element, place: _Place) -> None:
        if element.tag == "svg":
            view = Viewport(*(place.view(element, key, place.view.side_length(key)) for key in ("width", "height")))
            box = view_box(element)
            onto = fit_view_box(element, *view) * _shift_matrix(element, place.view) * place.onto
            place = replace(place, onto=onto, view=Viewport(*box[2:]) if box else view)
        for child in element:
            self._element(child, place)

    def _copy(self, element: Element, place: _Place) -> None:
        """Another element of the same file, here."""
        target = self.named.get(element.get("href", "").removeprefix("#"))
        if target is None:
            return
        read = self._group if target.tag == "symbol" else self._element
        read(target, replace(place, onto=_shift_matrix(element, place.view) * place.onto))

    def _shape(self, element: Element, place: _Place) -> None:
        """A shape's traces; without a stroke it is no more than a dot. Numerals for too many are not read at all."""
        Budget(self.things.path, measures.MAX_TRACES,
               "things drawn").spend(len(NUMBERS.findall(element.get("d", ""))) // measures.MAX_COMMAND_NUMERALS)
        stroked = place.look.get("stroke", "none").strip() not in ("none", "transparent")
        if not stroked:
            corners = _corners(element)
            self.things.spend(len(corners))
            self.tips += sharp_corners([spot(place.onto, corner) for corner in corners])
        leads = self.own and (element.get("stroke"), element.get("stroke-width")) == LEADER_STYLE
        traces = list(map(dot_or_circle, _traces(element, place.onto, place.view)))
        self.things.spend(len(traces))
        (self.leaders if leads else self.traces).extend(trace for trace in traces if stroked or trace.kind == POINT)
        if traces and stroked:
            self.tips += [traces[place_of_end].spots[place_of_end] for key, place_of_end in MARKERS.items()
                          if self._is_arrow_head(place.look.get(key, ""))]

    def _is_arrow_head(self, reference: str) -> bool:
        """Whether the marker that is set at the end of a stroke has a sharp corner, as no dot has."""
        target = self.named.get(reference.strip().removeprefix("url(").rstrip(")").strip("'\"").removeprefix("#"))
        return target is not None and target.tag == "marker" and any(
            any(sharp_corners([(corner.x, corner.y) for corner in _corners(shape)]))
            for shape in target)


def _corners(element: Element) -> Sequence[Any]:
    """The corners of a polygon, or of a path that is as simple as an arrow's head."""
    if element.tag == "polygon":
        return Polygon(points=element.get("points", "")).points  # type: ignore[no-any-return]
    if element.tag != "path" or len(NUMBERS.findall(data := element.get("d", ""))) > 2 * measures.MAX_HEAD_SPOTS:
        return ()
    pieces = list(segments(data))
    is_outline = all(isinstance(piece, Move | Line | Close) for piece in pieces)
    return list(dict.fromkeys(piece.end for piece in pieces if piece.end)) if is_outline else ()


def _shift_matrix(element: Element, view: Viewport) -> Matrix:
    """By how much an element moves what is in it."""
    return Matrix(1, 0, 0, 1, view(element, "x"), view(element, "y"))


def _traces(element: Element, onto: Matrix, view: Viewport) -> Iterator[Trace]:
    """Yield the traces of a shape on paper; a shape as small as a dot is a point."""
    if element.tag == "path":
        shape = segments(element.get("d", ""))
    elif element.tag in CHAIN_SHAPES:
        shape = CHAIN_SHAPES[element.tag](points=element.get("points", ""))
    else:
        shape_type, keys = SHAPES[element.tag]
        sizes = {key: view(element, key) for key in keys}
        radii = [sizes[key] for key in ("r", "rx", "ry") if key in sizes]
        if radii and 0 < max(radii) * abs(onto.determinant) ** 0.5 < measures.MAX_DOT_RADIUS_MM:
            yield Trace(POINT, (spot(onto, complex(sizes["cx"], sizes["cy"])),))
            return
        shape = shape_type(**sizes | ({"rx": radii[0] or radii[1], "ry": radii[1] or radii[0]} if "rx" in sizes
                                      else {}))
    for smooth, spots in chains(Path(shape), onto):
        yield from traces_of_chain(smooth, spots)
