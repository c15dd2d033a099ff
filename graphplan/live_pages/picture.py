"""What the live page needs to know to draw a construction on its sheet anew, in any pose.

All of it is told by marks: lines by the marks on them, vectors by their ends, symbols by the points and links that they
go with, letters by what they stand at. Where these lie, JavaScript works out as `sheet/plates` does (plates.js,
mechanism.js, letters.js), with the same measures, which are told as well; it writes what changed (picture.js).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from importlib.resources import files
from typing import Any

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Slide
from graphplan.methods.panels import MECHANISM
from graphplan.output.svg import ink_group, look
from graphplan.phrases import said
from graphplan.sheet import tolerances
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import CaptionHead, caption, caption_heads
from graphplan.sheet.layout.measures import MARGIN_MM
from graphplan.sheet.layout.paper import room, room_for_marks, unit_lengths
from graphplan.sheet.layout.scales import SERIES, round_up
from graphplan.sheet.lettering import label_candidates, letters, prices
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import (
    ADVANCE,
    CAPS,
    DEPTH,
    DROP,
    LetterSizes,
    Runs,
    name_runs,
    script_size,
    sentence_runs,
    width,
)
from graphplan.sheet.lettering.letters import PlateLetters
from graphplan.sheet.plates import display, drawn_mechanism, machine, pens, symbols
from graphplan.sheet.plates import plate as strokes
from graphplan.sheet.plates.display import Arc, Item, Polygon, Polyline, Rect, Sheet, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import Figure, FixedGuide, Rail
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import corner
from graphplan.sheet.plates.plate import DrawnStep, Plate, Stroke
from graphplan.sheet.words.protocol import protocol_of
from graphplan.words.tongue import Tongue

Data = dict[str, Any]  # of JSON
SCRIPTS = "plates.js", "mechanism.js", "letters.js", "picture.js"
MEASURES: dict[Any, tuple[str, ...]] = {  # of what is drawn: mm, degrees, prices
    strokes: ("ALONE", "CLOSE", "SHORT", "STRIKE", "FLATTEST", "WIDEST", "GIVEN_HEAD", "BREAK_HEAD",
              "BREAK"),
    machine: ("SPRING_END", "SPRING_WIDTH"),
    symbols: ("RADIUS", "HIGH", "GUIDE", "HATCH", "PITCH", "NEAR"), drawn_mechanism: ("RAIL",),
    tolerances: ("SHORT_STROKE",),
    display: ("SLIM", "BARB", "WALL"), pens: ("PAPER", "OPEN", "WHITE"),
    letters: ("ALONG", "MIDDLE", "NEAR_HEAD", "SAME_BREAK"),
    label_candidates: ("LED", "LEADER", "BALLOON", "AIR", "TASTE", "EDGE"),
    prices: ("FAULT", "MISTAKEN_TIMES", "TOUCH", "BESIDE", "STRANGER", "MIN_SURFACE_MM", "CLASH"),
}  # fmt: skip
SCALE_STEPS = [Fraction(10) ** power * times for power in range(-1, 7) for times in SERIES]  # times as coarse
TOGETHER = letters.SAME_PLACE_MM  # mm: marks that lie so near to each other have their letters together
PENS = {  # by what they draw
    "arc": pens.ARC, "pair": pens.PAIR, "tracer": pens.DOT, "break": pens.THIN.with_fill(pens.GREY),
    "leader": pens.LEADER, "balloon": pens.BALLOON, "letters": pens.LETTERS, "faint": pens.FAINT,
    "ground": pens.GROUND, "hatch": pens.HATCH, "produced": pens.PRODUCED, "bar": pens.BAR,
    "machine": pens.MACHINE, "hollow": pens.HOLLOW,
    "path": pens.PATH,
}  # fmt: skip


def scripts() -> str:
    """The JavaScript that draws: it gives the classes `Picture` and `View`, and what makes elements."""
    texts = (files(__package__).joinpath(name).read_text("utf-8") for name in SCRIPTS)
    names = "{Picture, View, made}"
    return "\n".join(['"use strict";', f"const {names} = (() => {{", *texts, f"return {names};", "})();", ""])


def scale_steps(composition: Composition, panel: Panel) -> list[Fraction]:
    """How many times as coarse the scale of a plan may be, by steps at which all its scales are round; that of the
    mechanism plan stands."""
    plans, scale = composition.plans, Fraction(composition.scales.lengths_per_mm(panel))
    if panel == plans.panels[0]:
        return [Fraction(1)]
    lengths = unit_lengths(plans, panel)
    return sorted({round_up(float(times * scale), lengths) / scale for times in SCALE_STEPS})


def captions_by_step(composition: Composition, page: Sheet) -> list[list[str]]:
    """The caption of each plan on its sheet as SVG, at each of the scales that it may have."""
    scales, written = composition.scales, dict[Text, str]()

    def caption_text(panel: Panel, head: CaptionHead, times: Fraction) -> str:
        multiples = {name: much / times if name == panel else much for name, much in scales.multiples.items()}
        lines = [*caption(composition, panel, head, replace(scales, multiples=multiples))]
        for line in lines:
            if line not in written:
                group = ink_group(page, "text", [line]).tostring()
                written[line] = group[group.index(">") + 1 : group.rindex("<")]
        return "".join(written[line] for line in lines)

    return [[caption_text(panel, head, times) for times in scale_steps(composition, panel)]
            for panel, head in caption_heads(composition).items()]


class PictureData:
    """One construction on its sheet, as data for JSON; y runs up, and pens and points are told by their places in lists
    that the data have."""

    def __init__(self, composition: Composition):
        self.composition, self.plates = composition, composition.plates
        self.titles = protocol_of(composition.plans, composition.scales).sentences
        self.pens: dict[Pen, int] = {}
        self.scene, self.program = self.plates.scene, composition.plans.drawing.drawn
        self.points = list(self.scene.points)
        self.panels = list(self.plates.plans.panels)
        self.mechanism = self.plates[MECHANISM].drawn_mechanism
        self.letters = {plate.panel: PlateLetters(plate) for plate in self.plates}

    def picture_in(self, tongue: Tongue) -> Data:
        """Everything that moves."""
        steps = zip(self.drawn_picture["steps"], self.step_words(tongue), strict=True)
        return {**self.drawn_picture, "steps": [{**step, **words} for step, words in steps]}

    def step_words(self, tongue: Tongue) -> list[Data]:
        """What is said of each step in a language."""
        return [self._step_words(index, tongue) for index in range(len(self.plates.steps))]

    @cached_property
    def drawn_picture(self) -> Data:
        """Data that are equal in all languages."""
        arrangement, plans = self.composition.arrangement, self.plates.plans
        picture = {
            "width": arrangement.width, "height": arrangement.height, "measures": _measures(self.plates.letters),
            "panels": [self._panel(one) for one in self.plates],
            "points": [[name, *plans.place(name)] for name in self.points],
            "slides": [self._slide(slide) for slide in self.scene.slides],
            "links": [list(map(self.points.index, self.scene.links[link])) for link in self.scene.moving],
            "steps": [self._step(mark) for mark in self.plates.steps],
            "vectors": [self._vector(plate, stroke) for plate in self.plates for stroke in plate.wanted_vectors],
            "parts": [*self._springs(), *map(self._part_data, self.mechanism.figures())],
            "pairs": list(map(self.points.index, self.mechanism.pairs)),
            "joints": [self._lettering(sentence_runs(name, (name,))) for name in self.points],
            "numbers": [self._link_number(wish) for wish in self.mechanism.wishes()],
            "uses": {name: self.pen(pen) for name, pen in PENS.items()},
        }  # fmt: skip
        return picture | {"pens": [{"look": _attributes(pen), "colour": pen.colour, "width": pen.width,
                                    "tip": pen.tip} for pen in self.pens]}  # fmt: skip

    def pen(self, pen: Pen) -> int:
        """The place of a pen."""
        return self.pens.setdefault(pen, len(self.pens))

    # ---- steps -----------------------------------------------------------------------------------------------------

    def _panel(self, plate: Plate) -> Data:
        """A plan's window, the room for its marks, those that must be in it, how far these are off its sides, at most
        a margin, and how many times as coarse its scale may be."""
        rect, view, plans = plate.view.rect, plate.view, plate.plans
        core = plans.extent(plate.panel).core
        (left, low), (right, high) = view((core.left, core.bottom)), view((core.right, core.top))
        core_marks = list(plans.ends(plate.panel)) or plans.points(plate.panel)
        off = left - rect.left, low - rect.bottom, rect.right - right, rect.top - high
        panel = self.composition.arrangement.panels[plate.panel]
        return {"name": plate.panel, "rect": _corners(rect), "scale": view.scale, "origin": view.origin,
                "core": core_marks, "room": _corners(room_for_marks(room(panel))),
                "free": [max(0.0, min(MARGIN_MM, side)) for side in off],
                "twin": self.panels.index(plans.twins[plate.panel]),
                "scales": [*map(float, scale_steps(self.composition, plate.panel))]}

    def _slide(self, slide: Slide) -> Data:
        """A sliding pair: its guide's direction, or the points that give it."""
        through = slide.through and list(map(self.points.index, slide.through))
        return {"name": slide.name, "through": through, "direction": tuple(map(float, slide.direction))}

    def _step(self, drawn: DrawnStep) -> Data:
        """Data of a step's strokes, by marks."""
        plate = self.plates[drawn.panel]
        step: Data = {"number": drawn.number, "kind": drawn.kind, "panel": self.panels.index(drawn.panel),
                      "spoken": self.letters[drawn.panel].is_mentioned(drawn) and drawn.name not in self.scene.points}
        if drawn.name:
            step |= {"name": drawn.name, "letter": self._lettering(name_runs(drawn.name), corner(drawn.step))}
        if drawn.kind in (LINE, CIRCLE):
            step["marks"] = [mark.index for mark in plate.marks(drawn)]
        if drawn.kind == LINE:
            beyond, pen = plate.line_pen(drawn)
            step |= {"beyond": beyond, "pen": self.pen(pen)}
        if halves := [arc for arc in plate.arcs(drawn) if arc.pen is pens.NORMAL]:  # all of a circle that is wanted
            step["whole"] = [halves[0].mark.index, self.pen(pens.NORMAL)]
        elif drawn.kind == CIRCLE and (end := self.plates.plans.diameter(drawn.step)) is not None \
                and self.plates.steps[end].panel == drawn.panel:
            step["diameter"] = end
        if drawn.kind == POINT and (dot := plate.dotting(drawn)):
            step["dot"] = [self.pen(dot), plate.dot_radius(drawn)]
        if corners := self.plates.plans.similar_triangles.get(drawn.index):
            step |= {"corners": corners, "side": self.pen(pens.SIDE)}
        if drawn.kind == POINT and drawn.root:
            given_pen = plate.given_pen(drawn)
            step |= {"root": drawn.root.index, "pen": self.pen(plate.laid_pen(drawn)),
                     "given": None if given_pen is None else self.pen(given_pen)}
        return step

    def _step_words(self, index: int, tongue: Tongue) -> Data:
        """Words of a step in a language."""
        if index not in self._marks_on_strokes:
            return {"title": tongue(self.titles[index])}
        name = self.program.text(index)
        runs = sentence_runs(tongue(said("to {0}", name)), (name,))
        return {"title": tongue(self.titles[index]), "text": name,
                "to": self._lettering(runs, size=self.plates.letters.text)}

    @cached_property
    def _marks_on_strokes(self) -> set[int]:
        """The marks on lines, and between which points are laid off: to these strokes go where they break off."""
        lines = ((plate, line) for plate in self.plates for line in plate.steps if line.kind == LINE)
        on_lines = {mark.index for plate, line in lines for mark in plate.marks(line)}
        laid_off = {mark.index for drawn in self.plates.steps if drawn.root for mark in (drawn.root, drawn)}
        return on_lines | laid_off

    def _vector(self, plate: Plate, stroke: Stroke) -> Data:
        """A vector that is asked for."""
        return {"of": stroke.of.index, "panel": self.panels.index(plate.panel), "start": stroke.start.index,
                "end": stroke.end.index, "pen": self.pen(stroke.pen), "head": pens.HEADS[stroke.kind],
                "least": plate.shortest(stroke.kind), "force": stroke.kind in pens.FORCES,
                "label": stroke.name, "letter": stroke.letter,
                "runs": self._lettering(name_runs(stroke.letter))}  # fmt: skip

    # ---- the mechanism ---------------------------------------------------------------------------------------------

    def _springs(self) -> Iterator[Data]:
        """The springs: the coils that they have in the given pose stay."""
        for ends in machine.spring_ends(self.scene):
            coils = machine.coil_count(*(self.mechanism.spots[name] for name in ends))
            yield {"spring": list(map(self.points.index, ends)), "coils": coils}

    def _part_data(self, part: Figure | FixedGuide | Rail) -> Data:
        """A part of the mechanism's picture, and what it moves with."""
        if isinstance(part, Figure):
            return {"frame": self._frame(part), "items": [self._item(item, part) for item in part.items]}
        slide, seat = self.scene.slides.index(part.slide), self.points.index(part.seat)
        if isinstance(part, FixedGuide):
            return {"ground": slide, "block": seat, "side": part.side}
        return {"rail": slide, "block": seat, "end": self.points.index(part.end)}

    def _frame(self, part: Figure) -> Data | None:
        """The reference of a figure's turning: two points of a link, a slide's guide, or None."""
        if part.slide:
            return {"slide": self.scene.slides.index(part.slide)}
        return self._turning(part.link) if part.link else None

    def _turning(self, link: str) -> Data | None:
        """The two points of a link that are farthest apart."""
        names, spots = self.scene.links[link], self.mechanism.spots
        pairs = [(p, q) for i, p in enumerate(names) for q in names[i + 1 :]]
        widest_pair = max(pairs, key=lambda pair: math.dist(spots[pair[0]], spots[pair[1]]), default=None)
        apart = widest_pair and math.dist(spots[widest_pair[0]], spots[widest_pair[1]]) > symbols.NEAR
        return {"points": list(map(self.points.index, widest_pair))} if widest_pair and apart else None

    def _item(self, item: Item, part: Figure) -> Data:
        """A stroke, figure or arc of a symbol."""
        fields = {"layer": item.layer, "pen": self.pen(item.pen)}
        if isinstance(item, Arc):
            return fields | {"spots": [self._spot_by_point(item.centre, part.at)],
                             "arc": [item.radius, item.start, item.end]}
        assert isinstance(item, Polyline | Polygon)
        return fields | {"spots": [self._spot_by_point(spot, part.at) for spot in item.spots],
                         "closed": isinstance(item, Polygon)}

    def _spot_by_point(self, spot: Spot, at: Sequence[str]) -> tuple[int, float, float]:
        """A spot by the nearest of some points, and how far off it is."""
        point = min(at, key=lambda name: math.dist(self.mechanism.spots[name], spot))
        x, y = self.mechanism.spots[point]
        return self.points.index(point), _fine(spot[0] - x), _fine(spot[1] - y)

    # ---- letters ---------------------------------------------------------------------------------------------------

    def _lettering(self, runs: Runs, bold: bool = False, size: float | None = None) -> Data:
        """A letter as runs, with its length in mm and how far it reaches below the line."""
        high = size or self.plates.letters.mark
        return {"runs": runs, "wide": _fine(width(runs, high, bold)), "bold": bold,
                "depth": DROP + 0.15 if any(run.level < 0 for run in runs) else DEPTH}

    def _link_number(self, wish: Wish) -> Data:
        """The number of a link, and where it may stand."""
        link = wish.label.removeprefix("link ")
        spots = [self._spot_by_point(spot, self.scene.links[link]) for spot in wish.spots]
        return {"label": wish.label, "letter": self._lettering(wish.runs, size=wish.letter_size), "clear": wish.clear,
                "free": wish.free, "frame": self._turning(link), "spots": spots, "balloon": wish.balloon}

def _measures(sizes: LetterSizes) -> Data:
    """The measures by name, and those of letters."""
    measures = {name: getattr(module, name) for module, names in MEASURES.items() for name in names}
    return measures | {"TOGETHER": TOGETHER, "MARGIN": MARGIN_MM, "CAPS": CAPS, "DEPTH": DEPTH, "DROP": DROP,
                       "LETTER": sizes.mark, "TEXT": sizes.text, "ADVANCE": {char: ADVANCE[char] for char in "0, ≡"},
                       "LOWERED": {letter_size: script_size(letter_size) for letter_size in vars(sizes).values()}}


def _corners(rect: Rect) -> tuple[float, float, float, float]:
    return rect.left, rect.bottom, rect.right, rect.top


def _fine(length: float) -> float:
    return round(length, 5) + 0.0


def _attributes(pen: Pen) -> dict[str, str]:
    """Style of a pen, as attributes of SVG."""
    return {name.replace("_", "-"): str(value) for name, value in look(pen).items()}
