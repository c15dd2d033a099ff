"""The construction as one HTML page of JSXGraph elements: the pose can be dragged, the steps shown one after another.

Elements have the elements that they depend on as parents; where JSXGraph has none of the kind, or would have to choose
a side, a point is where its formula says. Openings are functions, which nothing shows.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from importlib.resources import files

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, Movement
from graphplan.kernel.tape.written import JAVASCRIPT
from graphplan.output.exports.formula import formula
from graphplan.output.exports.walk import BACK, FRONT, Elements, at_home, identifiers, parameters
from graphplan.phrases import said
from graphplan.sheet.lettering.lettering import name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polygon, Spot
from graphplan.sheet.plates.drawn_step import DrawnStep, Stroke, StruckArc
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import Plate, Plates

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
NATIVE = {  # an element, and its parents
    Movement.RULED: ("line", "{0}", "{1}"),
    Movement.PARALLEL: ("line", "{1}", "() => by({1}, {0}, 100, 0)"),
    Movement.PERPENDICULAR: ("line", "{1}", "() => by({1}, {0}, 0, 100)"),
    Movement.MET: ("intersection", "{0}", "{1}", "0"),
    Movement.HALVED: ("midpoint", "{0}", "{1}"),
    Movement.STRUCK: ("circle", "{0}", "() => {k!r} * {1}()"),
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


def jsxgraph(plates: Plates, script: str | None = None) -> str:
    """The construction as an HTML page: with the text of the library inside where it is given, else with its name."""
    library = f"<script>\n{_inside(script)}\n</script>" if script else f'<script src="{LIBRARY}"></script>'
    sentences = [drawn.sentence for drawn in plates.drawn if drawn.number]
    box, margin, say = plates.box, MARGIN * plates.box.width, plates.plans.tongue
    corners = [box.left - margin, box.top + margin, box.right + margin, box.bottom - margin]
    parts = {name: escape(say(word)) if name in TITLES else _json(say(word)) for name, word in WORDS.items()}
    parts |= {"language": say.code, "title": escape(plates.scene.title), "source": escape(plates.scene.source),
              "library": library, "box": _json(corners), "sentences": _json(sentences), "steps": str(len(sentences)),
              "elements": "\n".join(f"  {line};" for line in _JsxGraphWriter(plates).elements())}  # fmt: skip
    page = files("graphplan.output").joinpath("jsxgraph.html").read_text("utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda word: parts[word[1]], page)


def _inside(script: str) -> str:
    """A script that does not seem to end where it speaks of the end of scripts."""
    return re.sub("</(?=script)", r"<\\/", script, flags=re.IGNORECASE)


def _json(value: object) -> str:
    """Data in a script: what would end the script, or begin a comment, is spelled otherwise."""
    return re.sub("<(?=[/!])", r"\\u003c", json.dumps(value, ensure_ascii=False))


def _letters(name: str) -> str:
    """A mark's name in HTML."""
    return "".join(f"<sub>{escape(run.text)}</sub>" if run.level else escape(run.text) for run in name_runs(name))


class _JsxGraphWriter(Elements):
    """Writes one construction as statements, element by element."""

    part, along = "() => part({0}, {1}, {part})", "() => by({0}, {2}, {part}, 0)"

    def named(self) -> Mapping[DrawnStep, str]:
        """Marks are properties in the script, since names may be words of the language."""
        return {drawn: f"M.{name}" for drawn, name in identifiers(self.plates.drawn).items()}

    def elements(self) -> Iterator[str]:
        """The captions and the marks, then the links and what is drawn of each mark; seen from its step on."""
        yield from map(self._caption, self.plates)
        yield from map(self._mark, self.plates.drawn)
        for plate in self.plates:
            for item, spots in self.mechanism(plate, *BACK, *FRONT):
                if not isinstance(item, Circle):
                    yield _seen(0, self._shape(item, spots))
        for one in (one for drawn in self.plates.drawn for one in self.due.get(drawn, ())):
            yield _seen(one.of.number, self._arc(one) if isinstance(one, StruckArc) else self._stroke(one))

    # ---- marks -------------------------------------------------------------------------------------------------

    def _mark(self, drawn: DrawnStep) -> str:
        """One mark, with what it depends on; curves are not seen but by their strokes, nor what leaves the paper."""
        native, called = NATIVE.get(drawn.step.op.movement), [self.names[arg] for arg in drawn.args]
        shown = drawn.kind == POINT and (drawn.name or drawn.view.rect.holds(drawn.at))
        if drawn.free:
            element, parents = "point", [repr(part) for part in drawn.at]
        elif native and at_home(drawn):
            element, parents = native[0], [text.format(*called, **parameters(drawn)) for text in native[1:]]
        else:
            element, parents = self._formulated(drawn)
        if not element:
            return f"{self.names[drawn]} = {parents[0]}"
        made = _create(element, parents, _point_look(drawn) if shown else HIDDEN)
        return f"{self.names[drawn]} = {_seen(drawn.number, made) if shown else made}"

    def _formulated(self, drawn: DrawnStep) -> tuple[str, list[str]]:
        """An element where its formula says, with its parents."""
        read = [[text.format(self.names[arg]) for text in COORDINATES[arg.kind]] for arg in drawn.args]
        found = formula(drawn, read, JAVASCRIPT, "t")
        terms = "".join(f"const {name} = {text}; " for name, text in found.terms)
        element, texts = RESULTS[drawn.kind]
        return element, [f"() => {{ {terms}return {text.format(*found.results)}; }}" for text in texts]

    # ---- what is seen of them ----------------------------------------------------------------------------------

    def _stroke(self, stroke: Stroke) -> str:
        letter = (stroke.letter or stroke.of.name) if stroke in self.lettered else ""
        element, layer = ("arrow", VECTORS) if stroke.head else ("segment", CURVES)
        return _create(element, self.ends(stroke), _look(stroke.pen, layer, letter))

    def _arc(self, arc: StruckArc) -> str:
        """As much of a circle as serves its mark."""
        mark, centre = self.names[arc.mark], f"{self.names[arc.of]}.center"
        ends = [f"() => turned({mark}, {centre}, {turn!r})" for turn in (-arc.before, arc.after)]
        hidden: Look = {"radiusPoint": HIDDEN, "anglePoint": HIDDEN}
        return _create("arc", [centre, *ends], _look(pens.ARC, CURVES) | hidden)

    def _shape(self, item: Item, spots: Sequence[Spot]) -> str:
        """A shape of the mechanism, on its joints or as it lies."""
        closed, layer = isinstance(item, Polygon), LINKS + (item.layer in FRONT) - (item.layer in BACK[:2])
        filled: Look = {"fillColor": item.pen.fill, "fillOpacity": 1} if closed else {}
        joints = [self.names[self.joints[spot]] for spot in spots if spot in self.joints]
        if len(joints) < len(spots):
            chain = [*spots, spots[0]] if closed else spots
            parents = [_json([round(spot[axis], 3) for spot in chain]) for axis in (0, 1)]
            return _create("curve", parents, _look(item.pen, layer) | filled)
        if closed:
            return _create("polygon", joints, HIDDEN | {"visible": True, **filled, "layer": layer, "borders": HIDDEN,
                                                        "vertices": {"visible": True}})
        return _create("polygonalchain", joints, _look(item.pen, layer) | {"borders": _look(item.pen, layer)})

    def _caption(self, plate: Plate) -> str:
        """What a plan is, at the top of its window."""
        parents = [repr(plate.view.rect.left), repr(plate.view.rect.top), _json(plate.caption)]
        look: Look = {"fontSize": 13, "fixed": True, "anchorY": "top", "cssStyle": "font-weight: bold"}
        return _create("text", parents, look)


def _point_look(drawn: DrawnStep) -> Look:
    filled = pens.INK if drawn.number else pens.PAPER
    return {"name": _letters(drawn.name), "withLabel": bool(drawn.name), "size": 2 if drawn.name else 0.7,
            "strokeColor": pens.INK, "fillColor": filled, "layer": POINTS, "fixed": not drawn.free,
            "label": {"offset": [5, 8]}}


def _create(element: str, parents: Sequence[str], look: Look) -> str:
    return f"board.create({_json(element)}, [{', '.join(parents)}], {_json(look)})"


def _seen(number: int, made: str) -> str:
    """An element that is seen from a step on."""
    return f"seen({number}, {made})"


def _look(pen: Pen, layer: int, name: str = "") -> Look:
    return {"name": _letters(name), "withLabel": bool(name), "strokeColor": pen.colour, "layer": layer, "fixed": True,
            "strokeWidth": round(max(0.7, THICK * pen.width), 2), "dash": 2 if pen.dash else 0, "highlight": False,
            "label": {"position": "0.5fr right", "distance": 0.6, "strokeColor": pen.colour}}
