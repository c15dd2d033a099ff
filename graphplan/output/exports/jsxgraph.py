"""The construction as one HTML page of JSXGraph elements: the linkage can be moved, the steps shown one after another.

Elements have the elements that they depend on as parents; where JSXGraph has none of the kind, or would have to choose
a side, a point is where its formula says. Openings are functions, which nothing shows. The points of the mechanism go
where the linkage takes them, which is followed by the program of the live page; its symbols ride on links. Where
another construction draws what this one cannot, both are there, and that is shown which serves in the pose.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from html import escape
from importlib.resources import files
from typing import Any

from graphplan.accuracy.reach import constructions
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, Movement
from graphplan.kernel.stages import staged
from graphplan.kernel.tape.written import JAVASCRIPT
from graphplan.methods.forces.changing import drawn_components
from graphplan.methods.kinds import ACCELERATION, VELOCITY
from graphplan.methods.panels import MECHANISM
from graphplan.output.exports.formula import formula
from graphplan.output.exports.walk import BACK, FRONT, Elements, Letter, corners, identifiers, parameters
from graphplan.output.live.motion import motion
from graphplan.output.live.motion import script as followed
from graphplan.phrases import arranged, said, unit
from graphplan.sheet.lettering.lettering import SIZE, Runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polygon, Spot
from graphplan.sheet.plates.drawn_mechanism import Figure, Guide, Rail
from graphplan.sheet.plates.drawn_step import DrawnStep, Stroke, StruckArc
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import Plate, Plates
from graphplan.sheet.plates.symbols import NEAR

LIBRARY = "jsxgraphcore.js"  # what the page looks for beside itself
TITLES = {
    "back": said("Previous step"), "next": said("Next step"), "step": said("Step"), "travel": said("Turn of the drive"),
    "play": said("Play"), "plans": said("Plans"), "stages": said("Stages"), "values": said("Values at vectors"),
    "reset": said("The given pose"),
}  # fmt: skip
WORDS = {
    "play": said("Play"), "pause": said("Pause"), "begin": said("The mechanism as it is given; nothing is drawn yet."),
    "drag": said("Drag a joint: the linkage follows. Go through the steps with the slider."),
    "undrawn": said("The construction cannot be drawn here"),
    "missing": said("JSXGraph is missing: this page needs the file {0} beside it. Take it from {1}, or export the page "
                    "again with --library {0}, which puts it inside.", LIBRARY, "https://jsxgraph.org"),
}  # fmt: skip
THICK = 3.0  # pixels for a mm of a pen's width
LINKS, CURVES, VECTORS, LETTERS, POINTS = 2, 4, 6, 8, 9  # JSXGraph's layers
PATH = "path "  # the label of what says whose path a curve is: it would be another where pins are dragged
LEVELS = {1: "sup", -1: "sub"}
MARGIN = 0.02  # of the paper, around it
NATIVE = {  # an element, and its parents
    Movement.RULED: ("line", "{0}", "{1}"),
    Movement.PARALLEL: ("line", "{1}", "() => by({1}, {0}, 100, 0)"),
    Movement.PERPENDICULAR: ("line", "{1}", "() => by({1}, {0}, 0, 100)"),
    Movement.MET: ("intersection", "{0}", "{1}", "0"),
    Movement.HALVED: ("midpoint", "{0}", "{1}"),
    Movement.STRUCK: ("circle", "{0}", "() => {k!r} * {1}()"),
    Movement.GUIDED: ("line", "{0}", "() => beside({0}, {slide}, {way})"),
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
    drawn, say = ways(plates), plates.plans.tongue
    own = f"<script>\n{_inside(script)}\n</script>" if script else f'<script src="{LIBRARY}"></script>'
    writers = [_JsxGraphWriter(one) for one in drawn]
    data, tapes = motion([one.plans.drawing for one in drawn]) if plates.scene.points else (None, "null")
    parts = {name: escape(say(word)) for name, word in TITLES.items()}
    parts |= {
        "language": say.code, "title": escape(plates.scene.title), "source": escape(plates.scene.source),
        "library": own, "scene": plates.scene.text.replace("</", "<\\/") if plates.scene.points else "",
        "script": _inside(followed()), "tapes": tapes, "data": _json(data), "page": _json(_page(drawn)),
        "words": _json({name: say(word) for name, word in WORDS.items()}),
        "common": _statements(writers[0].common()),
        "programs": ",\n".join(f"  (M, seen) => {{\n{_statements(writer.elements())}\n  }}" for writer in writers),
    }  # fmt: skip
    page = files("graphplan.output").joinpath("jsxgraph.html").read_text("utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda word: parts[word[1]], page)


def ways(plates: Plates) -> list[Plates]:
    """The construction, and in its windows those that draw what it cannot."""
    if not plates.scene.points:
        return [plates]
    others = (Plates(replace(plates.plans, drawing=one), plates.views, plates.letters)
              for one in constructions(plates.plans.drawing)[1:])
    return [plates, *(one for one in others if {*one.plans.panels} == {*plates.plans.panels})]


def _page(ways: Sequence[Plates]) -> Look:
    """What the script is to know: the paper, the window of the mechanism, and of each construction its steps."""
    plates, say = ways[0], ways[0].plans.tongue
    box, margin, window = plates.box, MARGIN * plates.box.width, plates.views[MECHANISM]
    drive = next(iter(plates.scene.drives), None)
    return {
        "box": [box.left - margin, box.top + margin, box.right + margin, box.bottom - margin],
        "scale": window.scale, "origin": [*window.origin],
        "unit": say(arranged(" {0}", unit(plates.scene.units.length))) if drive and drive.slides else "°",
        "plans": [say(arranged("{0:capital}", plate.panel.words)) for plate in plates],
        "programs": [_told(one) for one in ways],
    }  # fmt: skip


def _told(plates: Plates) -> Look:
    """The sentences of a construction, and its stages by their titles."""
    say = plates.plans.tongue
    return {"sentences": [drawn.sentence for drawn in plates.drawn if drawn.number],
            "stages": [say(arranged("{0:capital}", stage.title)) for stage, _ in _stages(plates)]}


def _stages(plates: Plates) -> list[Any]:
    return staged(plates.plans.drawing.drawn.steps) if plates.scene.points else []


def _inside(text: str) -> str:
    """Text that does not seem to end where it speaks of the end of scripts."""
    return re.sub("</(?=script)", r"<\\/", text, flags=re.IGNORECASE)


def _json(value: object) -> str:
    """Data in a script: what would end the script, or begin a comment, is spelled otherwise."""
    return re.sub("<(?=[/!])", r"\\u003c", json.dumps(value, ensure_ascii=False))


def _statements(lines: Iterable[str]) -> str:
    return "\n".join(f"    {line};" for line in lines)


def _html(runs: Runs) -> str:
    """Lettering in HTML."""
    return "".join(f"<{LEVELS[run.level]}>{escape(run.text)}</{LEVELS[run.level]}>" if run.level else escape(run.text)
                   for run in runs)


class _JsxGraphWriter(Elements):
    """Writes one construction as statements, element by element."""

    part, along = "() => part({0}, {1}, {part})", "() => by({0}, {2}, {part}, 0)"

    def named(self) -> Mapping[DrawnStep, str]:
        """Marks are properties in the script, since names may be words of the language."""
        return {drawn: f"M.{name}" for drawn, name in identifiers(self.plates.drawn).items()}

    def common(self) -> Iterator[str]:
        """What all constructions share: captions, and the mechanism with its letters."""
        scene = self.plates.scene
        yield from map(self._caption, self.plates)
        if not scene.points:
            return
        mechanism = self.plates[MECHANISM].drawn_mechanism
        circles = {item.centre: item for item in mechanism.items()
                   if isinstance(item, Circle) and item.layer == FRONT[-1]}
        for name in scene.points:
            at, circle = mechanism.spots[name], circles.get(mechanism.spots[name])
            look: Look = {"size": circle.radius if circle else 0.3, "strokeColor": pens.INK,
                          "fillColor": circle.pen.fill if circle else pens.INK}
            yield f"joint({_json(name)}, {at[0]!r}, {at[1]!r}, {_json(look)})"
        for part in mechanism.parts():
            for item in part.items:
                yield self._shape(item, *_carried(part))
        for plate in self.plates:
            for letter in self.letters(plate):
                if letter.text.step is None and not letter.text.label.startswith(PATH):
                    yield f"shown({self.panels.index(plate.panel)}, {self._letter(letter)})"

    def elements(self) -> Iterator[str]:
        """The marks, then what is drawn of each and its letters; seen from its step on."""
        yield from map(self._mark, self.plates.drawn)
        for one in (one for drawn in self.plates.drawn for one in self.due.get(drawn, ())):
            yield self._seen(one.of, self._arc(one) if isinstance(one, StruckArc) else self._stroke(one))
            if isinstance(one, Stroke) and one.vector and (value := self._value(one)):
                yield value
        for plate in self.plates:
            for letter in self.letters(plate):
                if letter.text.step is not None:
                    yield self._seen(self.plates.steps[letter.text.step], self._letter(letter))

    def _seen(self, drawn: DrawnStep, made: str, more: str = "") -> str:
        """An element that is seen from a step on, with its plan and its stage."""
        place = self.panels.index(drawn.panel), self.stage.get(drawn.index, -1)
        return f"seen({drawn.number}, {place[0]}, {place[1]}, {made}{more})"

    @cached_property
    def panels(self) -> list[str]:
        """The plans, by place."""
        return [plate.panel for plate in self.plates]

    @cached_property
    def stage(self) -> dict[int, int]:
        """The stage of each step."""
        return {step.index: k for k, (_, steps) in enumerate(_stages(self.plates)) for step in steps}

    # ---- marks -------------------------------------------------------------------------------------------------

    def _mark(self, drawn: DrawnStep) -> str:
        """One mark, with what it depends on; curves are not seen but by their strokes, nor what leaves the paper."""
        own, movement = self.names[drawn], drawn.step.op.movement
        native, called = NATIVE.get(movement), [self.names[arg] for arg in drawn.args]
        pen = self.plates[drawn.panel].dot(drawn) if drawn.kind == POINT else None
        if not drawn.number and drawn.name in self.plates.scene.points:
            return f"{own} = J[{_json(drawn.name)}]"
        if drawn.free:
            element, parents = "point", [repr(part) for part in drawn.at]
        elif native:
            element, parents = native[0], [text.format(*called, **self._told(drawn)) for text in native[1:]]
        else:
            element, parents = self._formulated(drawn)
        if not element:
            return f"{own} = {parents[0]}"
        made = _create(element, parents, self._dot(drawn, pen) if pen or drawn.free else HIDDEN)
        return f"{own} = {self._seen(drawn, made) if pen or drawn.free else made}"

    def _told(self, drawn: DrawnStep) -> dict[str, object]:
        """What a native element reads besides marks."""
        guide = {"slide": _json(" along ".join(drawn.step.links)), "way": _json([*drawn.along])} \
            if drawn.step.op.movement is Movement.GUIDED else {}
        return {**parameters(drawn), **guide}

    def _dot(self, drawn: DrawnStep, pen: Pen | None) -> Look:
        size = self.plates[drawn.panel].size(drawn)
        return {"withLabel": False, "name": drawn.name, "size": size, "sizeUnit": "user", "strokeColor": pens.INK,
                "fillColor": pen.fill if pen else pens.INK, "strokeWidth": 1, "layer": POINTS, "fixed": not drawn.free,
                "highlight": drawn.free}

    def _formulated(self, drawn: DrawnStep) -> tuple[str, list[str]]:
        """An element where its formula says, with its parents."""
        read = [[text.format(self.names[arg]) for text in COORDINATES[arg.kind]] for arg in drawn.args]
        found = formula(drawn, read, JAVASCRIPT, "t", given=self._loaded(drawn))
        terms = "".join(f"const {name} = {text}; " for name, text in found.terms)
        element, texts = RESULTS[drawn.kind]
        return element, [f"() => {{ {terms}return {text.format(*found.results)}; }}" for text in texts]

    def _loaded(self, drawn: DrawnStep) -> dict[str, tuple[str, float]]:
        """The components of a load that changes, as the page tells them, and how long each is drawn."""
        quantity, drawing = drawn.step.quantity, self.plates.plans.drawing
        if not quantity or not quantity.changing:
            return {}
        return {part: (f"load({_json(quantity.written)}, {k})", times) for k, (part, times) in enumerate(
            drawn_components(drawing.scene, drawing.phi, quantity.written).items())}

    # ---- what is seen of them ----------------------------------------------------------------------------------

    def _stroke(self, stroke: Stroke) -> str:
        element, layer = ("arrow", VECTORS) if stroke.head else ("segment", CURVES)
        head: Look = {"lastArrow": {"type": 1, "size": 5}} if stroke.head else {}
        return _create(element, self.ends(stroke), _look(stroke.pen, layer) | head)

    def _arc(self, arc: StruckArc) -> str:
        """As much of a circle as serves its mark."""
        mark, centre = self.names[arc.mark], f"{self.names[arc.of]}.center"
        ends = [f"() => turned({mark}, {centre}, {turn!r})" for turn in (-arc.before, arc.after)]
        hidden: Look = {"radiusPoint": HIDDEN, "anglePoint": HIDDEN}
        return _create("arc", [centre, *ends], _look(pens.ARC, CURVES) | hidden)

    def _value(self, stroke: Stroke) -> str:
        """What a velocity or an acceleration is, beside the middle of its vector."""
        scene, vector = self.plates.scene, stroke.vector
        if not vector or vector.kind not in (VELOCITY, ACCELERATION):
            return ""
        written = unit(f"{scene.units.length}/{'s' if vector.kind == VELOCITY else 's²'}")
        ends = ", ".join(self.names[end] for end in (stroke.start, stroke.end))
        made = f"value({ends}, {_json(vector.kind)}, {_json(vector.point)}, {_json(' ' + self.say(written))}, " \
               f"{_json(stroke.pen.colour)})"
        return self._seen(stroke.of, made, ", true")

    def _shape(self, item: Item, points: Sequence[str], link: str) -> str:
        """A shape of the mechanism: on its joints, or where it rides."""
        closed, layer = isinstance(item, Polygon), LINKS + (item.layer in FRONT) - (item.layer in BACK[:2])
        filled: Look = {"fillColor": item.pen.fill, "fillOpacity": 1} if closed and item.pen.fill != "none" else {}
        spots = [self._rides(spot, points, link) for spot in corners(item)]
        return f"shape({_json([*spots, spots[0]] if closed else spots)}, {_json(_look(item.pen, layer) | filled)})"

    def _rides(self, spot: Spot, points: Sequence[str], link: str) -> list[Any]:
        """A spot by the nearest of some points, the link with which it turns and how far it is off."""
        places = {name: self.plates.pose[name].at for name in points}
        point = min(points, key=lambda name: math.dist(places[name], spot))
        x, y = places[point]
        off = [] if math.dist((x, y), spot) < NEAR else [round(spot[0] - x, 4), round(spot[1] - y, 4)]
        return [point, link, *off] if off else [point]

    def _letter(self, letter: Letter) -> str:
        """Lettering beside its mark, or on its link; with a ring and the stroke that ties it to where it belongs."""
        text, mark, (dx, dy) = letter.text, letter.mark, letter.off
        link = text.label.removeprefix("link ") if text.label.startswith("link ") else ""
        if vector := self._lettered(letter):
            (x, y), (u, v) = vector.ends
            x, y, u, v = mark.at[0] + dx - x, mark.at[1] + dy - y, u - x, v - y
            along, across = (x * u + y * v) / (u * u + v * v), (y * u - x * v) / vector.length
            at = f"() => off({', '.join(self.ends(vector))}, {along:.3f}, {across:.3f})"
        elif not mark.number and mark.name in self.plates.scene.points:
            at = f"() => spot({_json([mark.name, link, round(dx, 3), round(dy, 3)])})"
        elif mark.kind == POINT:
            at = f"() => beyond({self.names[mark]}, {dx:.3f}, {dy:.3f})"
        else:
            at = f"() => [{mark.at[0] + dx:.3f}, {mark.at[1] + dy:.3f}]"
        look = {"strokeColor": text.pen.colour, "layer": LETTERS}
        return f"letter({at}, {_json(_html(text.runs))}, {text.size:g}, {_json(look)}, {_json(bool(letter.ringed))})"

    def _lettered(self, letter: Letter) -> Stroke | None:
        """The vector that lettering stands beside, where that is not the letter of its end."""
        return next((one for one in self.vectors.get(letter.text.step, ()) if one.letter != one.end.name
                     and one.letter in letter.text.label.split()), None)

    @cached_property
    def vectors(self) -> dict[int | None, list[Stroke]]:
        """The vectors by the steps that draw them."""
        found: dict[int | None, list[Stroke]] = {}
        for plate in self.plates:
            for vector in plate.vectors:
                found.setdefault(vector.of.index, []).append(vector)
        return found

    def _caption(self, plate: Plate) -> str:
        """What a plan is, at the top of its window."""
        at = f"() => [{plate.view.rect.left!r}, {plate.view.rect.top!r}]"
        look: Look = {"anchorX": "left", "anchorY": "top", "cssStyle": "font-weight: bold"}
        made = f"letter({at}, {_json(escape(plate.caption))}, {SIZE}, {_json(look)}, false)"
        return f"shown({self.panels.index(plate.panel)}, {made})"


def _carried(part: Figure | Guide | Rail) -> tuple[Sequence[str], str]:
    """The points with which a part of the mechanism goes, and the link with which it turns, if any."""
    if isinstance(part, Figure):
        return part.at, part.slide.along if part.slide else part.link
    return ((part.seat, part.end) if isinstance(part, Rail) else (part.seat,)), part.slide.along


def _create(element: str, parents: Sequence[str], look: Look) -> str:
    return f"board.create({_json(element)}, [{', '.join(parents)}], {_json(look)})"


def _look(pen: Pen, layer: int) -> Look:
    return {"name": "", "withLabel": False, "strokeColor": pen.colour if pen.width else "none", "layer": layer,
            "fixed": True, "strokeWidth": round(max(0.7, THICK * pen.width), 2), "highlight": False,
            "dash": 2 if pen.dash else 0}
