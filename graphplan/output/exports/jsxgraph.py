"""The construction as one HTML page of JSXGraph elements: the pose can be dragged, the steps shown one after another.

Elements have the elements that they depend on as parents; where JSXGraph has none of the kind, or would have to choose
a side, a point is where its formula says. Openings are functions, which nothing shows.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from html import escape

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.output.exports.figure import Arrow, Figure, Link, Object, Plan, Symbol
from graphplan.output.exports.formula import Language, formula, operations
from graphplan.output.exports.jsxgraph_page import page
from graphplan.phrases import said
from graphplan.sheet.lettering.lettering import name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.pens import Pen

LIBRARY = "jsxgraphcore.js"  # what the page looks for beside itself
TITLES = {"back": said("Previous step"), "next": said("Next step"), "step": said("Step")}
WORDS = {
    **TITLES, "begin": said("The mechanism as it is given; nothing is drawn yet."),
    "drag": said("Drag a point of the pose; go through the steps with the slider."),
    "missing": said("JSXGraph is missing: this page needs the file {0} beside it. Take it from {1}, or export the page "
                    "again with --library {0}, which puts it inside.", LIBRARY, "https://jsxgraph.org"),
}  # fmt: skip
THICK = 3.0  # pixels for a mm of a pen's width
LINKS, CURVES, VECTORS, POINTS = 2, 4, 6, 9  # JSXGraph's layers
MARGIN = 0.02  # of the paper, around it
JAVASCRIPT = Language(repr, operations(
    "Math.sqrt({})", "Math.abs({})", "(Math.abs({0}) <= {2} * {1} ? 0 : Math.sign({0}))"))
NATIVE: dict[str, tuple[str, tuple[str, ...], tuple[int, ...]]] = {  # by parents; those that may lie on any plan
    "line": ("line", ("{0}", "{1}"), ()),
    "parallel": ("line", ("{1}", "() => by({1}, {0}, 100, 0)"), (0,)),
    "perpendicular": ("line", ("{1}", "() => by({1}, {0}, 0, 100)"), (0,)),
    "meet": ("intersection", ("{0}", "{1}", "0"), ()),
    "midpoint": ("midpoint", ("{0}", "{1}"), ()),
    "circle": ("circle", ("{0}", "() => {k} * {1}()"), (1,)),
}
Look = dict[str, object]  # attributes of an element
HIDDEN: Look = {"visible": False, "name": "", "withLabel": False}
COORDINATES = {
    POINT: ("{0}.X()", "{0}.Y()"),
    LINE: ("{0}.point1.X()", "{0}.point1.Y()", "{0}.stdform[2]", "(-{0}.stdform[1])"),
    OPENING: ("{0}()",),
    CIRCLE: ("{0}.center.X()", "{0}.center.Y()", "{0}.Radius()"),
}
RESULTS = {
    POINT: ("point", ("[{0}, {1}]",)),
    LINE: ("line", ("[{0}, {1}]", "[{0} + {2}, {1} + {3}]")),
    OPENING: ("", ("{0}",)),
    CIRCLE: ("circle", ("[{0}, {1}]", "{2}")),
}


def jsxgraph(figure: Figure, script: str | None = None) -> str:
    """The figure as an HTML page: with the text of the library inside where it is given, else with its name."""
    library = f"<script>\n{_inside(script)}\n</script>" if script else f'<script src="{LIBRARY}"></script>'
    sentences = [object.sentence for object in figure.steps]
    return page(
        language=figure.tongue.code, title=escape(figure.title), source=escape(figure.source), library=library,
        box=_json(_box(figure)), sentences=_json(sentences), steps=str(len(sentences)),
        elements="\n".join(f"  {line}" for line in _Writer(figure).lines()),
        **_words(figure))


def _words(figure: Figure) -> dict[str, str]:
    """What the page says beside the steps: in its elements, and as data in its script."""
    spoken = {name: figure.tongue(word) for name, word in WORDS.items()}
    return {name: escape(text) if name in TITLES else _json(text) for name, text in spoken.items()}


def _inside(script: str) -> str:
    """A script that does not seem to end where it speaks of the end of scripts."""
    return re.sub("</(?=script)", r"<\\/", script, flags=re.IGNORECASE)


def _json(value: object) -> str:
    """Data in a script: what would end the script, or begin a comment, is spelled otherwise."""
    return re.sub("<(?=[/!])", r"\\u003c", json.dumps(value, ensure_ascii=False))


def _box(figure: Figure) -> list[float]:
    """Left, top, right, bottom of the board."""
    box, margin = figure.box, MARGIN * figure.box.width
    return [box.left - margin, box.top + margin, box.right + margin, box.bottom - margin]


def _letters(name: str) -> str:
    """A mark's name in HTML."""
    return "".join(f"<sub>{escape(run.text)}</sub>" if run.level else escape(run.text) for run in name_runs(name))


class _Writer:
    """Writes one figure as statements, element by element."""

    def __init__(self, figure: Figure):
        self.figure = figure

    def lines(self) -> Iterator[str]:
        """The pose and its links, then step by step with the strokes and vectors that belong to each."""
        for plan in self.figure.plans:
            yield self._caption(plan)
        for object in self.figure.objects:
            yield self._object(object)
        for link in self.figure.links:
            yield from self._link(link)
        for symbol in self.figure.symbols:
            yield self._symbol(symbol)
        for object in self.figure.objects:
            yield from self._strokes(object)
        for arrow in self.figure.arrows:
            yield self._vector(arrow)

    # ---- objects -----------------------------------------------------------------------------------------------

    def _object(self, object: Object) -> str:
        """One mark, with what it depends on."""
        if object.free:
            return self._mark(object, "point", [repr(part) for part in object.at])
        element, texts, afar = NATIVE.get(object.step.op.name, ("", (), ()))
        if element and all(arg.plan is object.plan for place, arg in enumerate(object.args) if place not in afar):
            called, k = [_called(arg) for arg in object.args], object.factor(object.args[-1])
            return self._mark(object, element, [text.format(*called, k=repr(k)) for text in texts])
        return self._formulated(object)

    def _formulated(self, object: Object) -> str:
        """A mark where its formula says."""
        read = [[text.format(_called(arg)) for text in COORDINATES[arg.kind]] for arg in object.args]
        found = formula(object, read, JAVASCRIPT, "t")
        terms = "".join(f"const {name} = {text}; " for name, text in found.terms)
        element, texts = RESULTS[object.kind]
        parents = [f"() => {{ {terms}return {text.format(*found.results)}; }}" for text in texts]
        return self._mark(object, element, parents) if element else f"{_called(object)} = {parents[0]};"

    def _mark(self, object: Object, element: str, parents: Sequence[str]) -> str:
        """The statement that makes a mark; curves are not seen but by their strokes, nor what leaves the paper."""
        shown = object.kind == POINT and (object.name or object.plan.rect.holds(object.at))
        look = self._point_look(object) if shown else HIDDEN
        made = _create(element, parents, look)
        return f"{_called(object)} = {_seen(object.number, made) if shown else made};"

    def _point_look(self, object: Object) -> Look:
        filled = pens.INK if object.number else pens.PAPER
        return {"name": _letters(object.name), "withLabel": not object.auxiliary, "size": 2 if object.name else 0.7,
                "strokeColor": pens.INK, "fillColor": filled, "layer": POINTS, "fixed": not object.free,
                "label": {"offset": [5, 8]}}

    # ---- what is seen of them ----------------------------------------------------------------------------------

    def _strokes(self, object: Object) -> Iterator[str]:
        """As much of a line or a circle as serves its marks, and the stroke along which a point was laid off."""
        here, vectors = _called(object), [arrow.end for arrow in self.figure.arrows]
        if object.kind == POINT and object.root and object not in vectors:
            yield self._stroke(object, "segment", [_called(object.root), here], _look(pens.THIN, CURVES))
        elif object.kind == LINE and (stretch := self.figure.stretch(object)):
            start, end, beyond = _called(stretch[0]), _called(stretch[1]), stretch[2]
            ends = [f"() => by({start}, {here}, {-beyond!r}, 0)", f"() => by({end}, {here}, {beyond!r}, 0)"]
            yield self._stroke(object, "segment", ends, _look(object.pen, CURVES, object.name))
        elif object.kind == CIRCLE:
            for mark in map(_called, self.figure.marks[object]):
                ends = [f"() => turned({mark}, {here}.center, {turn!r})" for turn in (-object.struck, object.struck)]
                hidden: Look = {"radiusPoint": HIDDEN, "anglePoint": HIDDEN}
                yield self._stroke(object, "arc", [f"{here}.center", *ends], _look(object.pen, CURVES) | hidden)

    def _stroke(self, object: Object, element: str, parents: Sequence[str], look: Look) -> str:
        return _seen(object.number, _create(element, parents, look)) + ";"

    def _vector(self, arrow: Arrow) -> str:
        label = "" if arrow.label == arrow.end.name else arrow.label
        look = _look(pens.VECTORS[arrow.kind], VECTORS, label)
        made = _create("arrow", [_called(arrow.start), _called(arrow.end)], look)
        return _seen(max(arrow.start.number, arrow.end.number), made) + ";"

    def _link(self, link: Link) -> Iterator[str]:
        """A bar, or the plate of three points and more."""
        corners = [_called(point) for point in link.corners]
        bars = [(_called(corner), _called(inner)) for corner, inner in link.ribs]
        for ends in [(corners[0], corners[1])] if len(corners) == 2 else bars:
            yield _seen(0, _create("segment", ends, _look(pens.LINK, LINKS))) + ";"
        if len(corners) > 2:
            look = {**HIDDEN, "visible": True, "fillColor": pens.TINT, "fillOpacity": 1, "layer": LINKS - 1,
                    "borders": _look(pens.LINK, LINKS), "vertices": {"visible": True}}
            yield _seen(0, _create("polygon", corners, look)) + ";"

    def _symbol(self, symbol: Symbol) -> str:
        """A symbol of the mechanism as it lies."""
        spots = [*symbol.spots, symbol.spots[0]] if symbol.closed else symbol.spots
        look = _look(symbol.pen, LINKS - 1 if symbol.layer == "ground" else LINKS + 1)
        if symbol.closed:
            look |= {"fillColor": symbol.pen.fill, "fillOpacity": 1}
        parents = [_json([round(spot[axis], 3) for spot in spots]) for axis in (0, 1)]
        return _seen(0, _create("curve", parents, look)) + ";"

    def _caption(self, plan: Plan) -> str:
        """What a plan is, at the top of its window."""
        parents = [repr(plan.rect.left), repr(plan.rect.top), _json(plan.caption)]
        look: Look = {"fontSize": 13, "fixed": True, "anchorY": "top", "cssStyle": "font-weight: bold"}
        return _create("text", parents, look) + ";"


def _called(object: Object) -> str:
    """An object in the script of the page: a property, since names may be words of the language."""
    return f"M.{object.id}"


def _create(element: str, parents: Sequence[str], look: Look) -> str:
    return f"board.create({_json(element)}, [{', '.join(parents)}], {_json(look)})"


def _seen(number: int, made: str) -> str:
    """An element that is seen from a step on."""
    return f"seen({number}, {made})"


def _look(pen: Pen, layer: int, name: str = "") -> Look:
    return {"name": _letters(name), "withLabel": bool(name), "strokeColor": pen.colour, "layer": layer, "fixed": True,
            "strokeWidth": round(max(0.7, THICK * pen.width), 2), "dash": 2 if pen.dash else 0, "highlight": False,
            "label": {"position": "0.5fr right", "distance": 0.6, "strokeColor": pen.colour}}
