"""Drawings in SVG, of Inkscape, GeoGebra or graphplan itself: points, lines and circles in mm, with their letters.

What hides is not seen, and what is no drawing on a sheet of graphplan's own - paper, words, letters - is left out. The
sheet's scene and sentences are not looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from xml.etree.ElementTree import Element

from graphplan.errors import Refused
from graphplan.kernel.kinds import POINT
from graphplan.marking.files.curves import DOT, curved, full, pieces
from graphplan.marking.files.drawing import NO_DRAWING, drawing, same_paper
from graphplan.marking.files.labels import Lettering
from graphplan.marking.files.safe import DEEPEST, MB, TRACES, Budget, contents, on_paper, tree
from graphplan.marking.files.svg_looks import Look, Looks, inherited
from graphplan.marking.files.svg_paths import chains
from graphplan.marking.files.svg_space import (
    MM,
    NUMBERS,
    Affine,
    Window,
    fitted,
    paper,
    paper_size,
    transform,
    view_box,
    window,
)
from graphplan.marking.files.svg_words import words
from graphplan.marking.traces import Frames, Spot, Submission, Trace

LARGEST = 16 * MB
VISITS, LETTERS = 30_000, 400_000  # elements, and letters of attributes and words; those of copies among them
GROUPS = {"svg", "g", "a", "switch"}
READ = {*GROUPS, "use", "text", "circle", "ellipse", "line", "polyline", "polygon", "rect", "path"}
NOT_DRAWN = {f"layer-{name}" for name in NO_DRAWING}


def read_svg(path: Path, frames: Frames, size: tuple[float, float] | None = None) -> Submission:
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

    onto: Affine
    window: Window
    look: Look
    depth: int = 0
    drawn: bool = True


class _SvgReader:
    """Walks one document."""

    def __init__(self, path: Path, root: Element):
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
            wide, high = paper_size(self.root.attrib)
            self.size = wide * MM["px"], high * MM["px"]
            place = _Place(paper(self.root.attrib), window(self.root.attrib), inherited(self.looks.of(self.root), {}))
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
        onto = place.onto.after(transform(element.get("transform", "")))
        if not on_paper(*map(abs, onto)):
            raise ValueError("a transform leads off the paper")
        drawn = place.drawn and element.get("class") not in NOT_DRAWN
        here = _Place(onto, place.window, inherited(look, place.look), place.depth + 1, drawn)
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
            self.words += words(element, place.onto, place.window, place.look, self.looks)
        elif place.drawn:
            self._shape(element, place)

    def _group(self, element: Element, place: _Place) -> None:
        if element.tag == "svg":
            view = Window(*(place.window(element, key, place.window.part(key)) for key in ("width", "height")))
            shift, box = _shift(element, place.window), view_box(element.attrib)
            if box:
                shift = shift.after(fitted(box, *view, element.get("preserveAspectRatio", "")))
                view = Window(*box[2:])
            place = replace(place, onto=place.onto.after(shift), window=view)
        for child in element:
            self._element(child, place)

    def _copy(self, element: Element, place: _Place) -> None:
        """Another element of the same file, here."""
        target = self.named.get(element.get("href", "").removeprefix("#"))
        if target is None:
            return
        there = replace(place, onto=place.onto.after(_shift(element, place.window)))
        if target.tag == "symbol":
            self._group(target, there)
        else:
            self._element(target, there)

    def _shape(self, element: Element, place: _Place) -> None:
        """A shape's traces; without a stroke it is no more than a dot."""
        stroked = place.look.get("stroke", "none").strip() not in ("none", "transparent")
        for trace in _traces(element, place.onto, place.window):
            self.things.spend()
            if stroked or trace.kind == POINT:
                self.traces.append(trace)


def _shift(element: Element, window: Window) -> Affine:
    """By how much an element moves what is in it."""
    return Affine(1.0, 0j, complex(window(element, "x"), window(element, "y")))


def _traces(element: Element, onto: Affine, window: Window) -> Iterator[Trace]:
    """What a shape shows on paper."""
    match element.tag:
        case "circle" | "ellipse":
            yield from _round(element, onto, window)
        case "line":
            ends = [complex(window(element, f"x{i}"), window(element, f"y{i}")) for i in (1, 2)]
            yield from pieces([onto(end) for end in ends])
        case "polyline" | "polygon":
            numbers = [float(number) for number in NUMBERS.findall(element.get("points", ""))]
            spots = [onto(complex(x, y)) for x, y in zip(numbers[::2], numbers[1::2], strict=False)]
            yield from pieces([*spots, spots[0]] if element.tag == "polygon" and spots else spots)
        case "rect":
            x, y, w, h = (window(element, key) for key in ("x", "y", "width", "height"))
            corners = [onto(complex(*corner)) for corner in ((x, y), (x + w, y), (x + w, y + h), (x, y + h), (x, y))]
            yield from pieces(corners)
        case "path":
            for chain in chains(element.get("d", "")):
                chained = [onto(spot) for spot in chain.spots]
                yield from pieces(chained) if not chain.smooth else [one] if (one := curved(chained)) else []


def _round(element: Element, onto: Affine, window: Window) -> Iterator[Trace]:
    """A circle, or an ellipse that is one on paper."""
    both = window(element, "r")
    centre = complex(window(element, "cx"), window(element, "cy"))
    radii = [window(element, key, both) for key in ("rx", "ry")]
    rx, ry = (radii[0] or radii[1], radii[1] or radii[0]) if element.tag == "ellipse" else (both, both)
    if rx <= 0 or ry <= 0:
        return
    if onto.even and rx == ry:
        yield full(onto(centre), rx * onto.size)
    elif found := curved(_ellipse(centre, rx, ry, onto)):
        yield found
    elif max(rx, ry) * onto.size < DOT:
        yield Trace(POINT, (onto(centre),))


def _ellipse(centre: complex, rx: float, ry: float, onto: Affine) -> list[Spot]:
    bows = f"M{centre.real - rx} {centre.imag}a{rx} {ry} 0 1 0 {2 * rx} 0a{rx} {ry} 0 1 0 {-2 * rx} 0"
    return [onto(spot) for chain in chains(bows) for spot in chain.spots]
