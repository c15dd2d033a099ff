"""The construction as a GeoGebra file: a mechanism that moves, and everything that is drawn depends on it.

Pins and drives are free (`ggb_linkage`); plans begin where one puts them. Each drawn step ends with its sentence and a
breakpoint, and the navigation bar walks from one to the next. Plans and stages have a check box each; letters stand
where the sheet has them, values beside their vectors. The scene itself is a member of the archive.
"""

from __future__ import annotations

import io
import math
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from textwrap import wrap
from typing import Any
from xml.etree.ElementTree import Element, indent, tostring

import numpy as np

from graphplan.accuracy.reach import FailingCompound, ReachablePoses, best_construction, corrected_values
from graphplan.cycle.relations import WrittenRelations, relations
from graphplan.exports.geogebra_commands import (
    CURVES,
    HIGH,
    LINKS,
    POINTS,
    ROW,
    SLIDER,
    VECTORS,
    WIDE,
    GeoGebraLinkage,
    Objects,
    command_of,
    empty,
    empty_document,
    formula_command,
    labels,
    letters,
    number,
    quote_text,
    set_runs,
    show_caption,
    spot,
)
from graphplan.exports.walk import Elements, Letter, Riding, corners
from graphplan.kernel.kinds import LINE, OPENING, POINT
from graphplan.kernel.passes import Compound
from graphplan.kernel.program import Panel
from graphplan.mechanism.written_scene import with_pose
from graphplan.phrases import join, said, unit
from graphplan.sheet.layout.scales import ACCELERATIONS, VELOCITIES, Scales
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Polygon, Spot
from graphplan.sheet.plates.pens import FORCES, Pen
from graphplan.sheet.plates.plate import DrawnStep, Plate, Plates, Stroke, StruckArc

ROWS = 130  # pixels: the upper margin with the sliders
BOX, BOX_MARGIN, CHARACTER = 24, 60, 7.2  # pixels from one check box to the next, beside a caption, and of a character
CAPTION_HEIGHT = 18  # pixels
MAX_LINE = 150  # characters of a sentence
TYPES = {POINT: "point", LINE: "line", OPENING: "numeric", "circle": "conic"}
STAMP = (1980, 1, 1, 0, 0, 0)  # of the files in the archive: a construction has no date
UNASSEMBLED = said("In this pose the linkage cannot be assembled: turn the drive back, or drag the pins back.")
SCENE = "scene.toml"  # what GeoGebra does not look at, and `import` reads: the scene


def geogebra(plates: Plates) -> bytes:
    """The construction as a .ggb file, the same bytes in every run.

    Where the pose's own forms fail in other poses, marks are by the rule; where that is not enough, the construction is
    one that is drawn in another pose.
    """
    drawing, wrong = best_construction(plates.plans.drawing) if plates.scene.links else (plates.plans.drawing, {})
    plates_there = plates if drawing is plates.plans.drawing else Plates(
        replace(plates.plans, drawing=drawing), plates.views, plates.letters)
    if {*plates_there.plans.panels} != {*plates.plans.panels}:
        plates_there, wrong = plates, {}
    root = _GeoGebraWriter(plates_there, plates, wrong).document()
    indent(root, " ")
    document = '<?xml version="1.0" encoding="utf-8"?>\n' + tostring(root, encoding="unicode") + "\n"
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in (("geogebra.xml", document), (SCENE, with_pose(plates.scene.text, plates.scene))):
            entry = zipfile.ZipInfo(name, STAMP)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, text)
    return packed.getvalue()


def scales(plates: Plates) -> Scales:
    """The scales of what is drawn, by its windows."""
    drawing, units = plates.plans.drawing, plates.scene.units
    first, *other_panels = plates.plans.panels
    first_scale = plates.views[first].scale
    multiples = {str(panel): Fraction(plates.views[panel].scale / first_scale) for panel in other_panels}
    return Scales(1 / first_scale, drawing.kappa, units.length, multiples, float(drawing.phi), units.force,
                  plates.scene.sheet.convention)


class _GeoGebraWriter(Elements):
    """Writes one construction, mark by mark."""

    part, along = "Translate[{0}, {part} * Vector[{0}, {1}]]", "Translate[{0}, {part} * UnitVector[{2}]]"
    number = staticmethod(number)

    def __init__(self, plates: Plates, given: Plates, wrong: Mapping[int, FailingCompound]):
        """Reads the plates of the construction, those of the given pose, and the compounds that are by their rule."""
        super().__init__(plates)
        self.given, self.wrong = given, wrong
        self.joints = {point.spot: point for point in reversed(given.pose.values())}
        self.objects, box = Objects(self.title), plates.box
        self.box_top = 100 + ROW * len(plates.scene.drives)  # pixels: where the check boxes begin
        self.column = BOX_MARGIN + CHARACTER * max(map(len, self._box_captions.values()))  # pixels: the left margin
        self.size = min((WIDE - self.column) / box.width, (HIGH - ROWS) / box.height) * 0.97  # pixels for a mm
        self.by_name = {name: self.names[mark] for name, mark in plates.pose.items()}
        self.placed, self.ways, self.entered = WrittenRelations((), {}, {}, {}), dict[str, Spot](), set[str]()

    def mark_names(self) -> Mapping[DrawnStep, str]:
        return labels(self.plates)

    # ---- the document ------------------------------------------------------------------------------------------

    def document(self) -> Element:
        box, size = self.plates.box, self.size
        root = empty_document(self.column - box.left * size, ROWS + box.top * size, size)
        self.write()
        root.append(self.objects.construction)
        return root

    def write(self) -> None:
        """The linkage and what is drawn of it, then step by step; strokes as soon as their marks are there."""
        for row, (label, caption) in enumerate(self._box_captions.items()):
            self.objects.check_box(label, caption, 10, self.box_top + BOX * row)
        self._pose()
        for plate in self.given:
            self._mechanism(plate)
            self._caption(plate)
        begun = said("The given mechanism, before the first step.")
        changing = dict.fromkeys(step.quantity.written for step in self.plates.plans.drawing.drawn.steps
                                 if step.quantity and step.quantity.changing)
        remark = said("Loads that change over the cycle have the values of the given pose here: {0}.",
                      join([*changing], ", "))
        self._write_sentence(join((begun, remark), " ") if changing else begun, 0)
        for mark in self.plates.pose.values():
            self._due(mark)
        for mark in self.plates.all_marks:
            if mark.number:
                self._step(mark)

    def _step(self, drawn: DrawnStep) -> None:
        """A drawn step, with what is seen as soon as it is there, and its sentence."""
        self.objects.shown_if = self._condition(drawn)
        self._mark(drawn)
        self._due(drawn)
        self.objects.shown_if = ""
        self._write_sentence(drawn.sentence, drawn.number)

    def _typeset(self, words: str) -> str:
        """Words with the names of marks in letters."""
        return set_runs(sentence_runs(words, tuple(mark.name for mark in self.plates.all_marks if mark.name)))

    def _due(self, drawn: DrawnStep) -> None:
        for stroke in self.due.get(drawn, ()):
            self._arc(stroke) if isinstance(stroke, StruckArc) else self._stroke(stroke)

    def _write_sentence(self, sentence: str, number: int) -> None:
        """The sentence of a step, seen until the next step is drawn; the navigation bar stops here."""
        last = max(mark.number for mark in self.plates.all_marks)
        self.objects.shown_if = f"ConstructionStep[] < ConstructionStep[step_{{{number + 1}}}]" if number < last else ""
        text = "\n".join(wrap(self._typeset(f"{number}.  {sentence}" if number else self.say(sentence)), MAX_LINE))
        element = self.objects.text("step", quote_text(text), size=2, x=20,
                                    y=60 + ROW * len(self.plates.scene.drives))
        element.set("label", f"step_{{{number}}}")
        self.objects.construction[-2].set("label", f"step_{{{number}}}")
        empty(element, "breakpoint", val=True)
        self.objects.shown_if = ""

    # ---- check boxes -------------------------------------------------------------------------------------------

    @cached_property
    def _stage(self) -> dict[int, str]:
        """The title of the stage of each step that has one."""
        program = self.plates.plans.drawing.drawn
        return {step.index: self.say(stage.title) for stage, steps in program.stages for step in steps}

    @property
    def _plan_box(self) -> dict[Panel, str]:
        """The check box of each plan."""
        return {panel: f"plan_{{{i}}}" for i, panel in enumerate(self.plates.plans.panels)}

    @property
    def _stage_box(self) -> dict[str, str]:
        """The check box of each stage, by its title; where they are many some that follow each other share one."""
        titles = [*dict.fromkeys(self._stage.values())]
        rows = (HIGH - self.box_top) // BOX - len(self._plan_box)
        share = max(1, math.ceil(len(titles) / max(rows, 1)))
        return {title: f"stage_{{{i // share}}}" for i, title in enumerate(titles)}

    @property
    def _box_captions(self) -> dict[str, str]:
        """The check boxes and what they say."""
        captions = {self._plan_box[plate.panel]: plate.caption for plate in self.plates}
        boxes = [*self._stage_box.values()]
        for title, box in self._stage_box.items():
            captions.setdefault(box, self._typeset(title if boxes.count(box) == 1 else f"{title} …"))
        return captions

    def _condition(self, drawn: DrawnStep) -> str:
        """On what it depends whether a step is seen."""
        boxes = [self._plan_box[drawn.panel]]
        if drawn.index in self._stage:
            boxes.append(self._stage_box[self._stage[drawn.index]])
        return " ∧ ".join(boxes)

    # ---- marks -------------------------------------------------------------------------------------------------

    def _pose(self) -> None:
        """The linkage; where it cannot be followed, its points as they are given."""
        positions = relations(self.given.scene, next(iter(self.given)).view)
        if positions:
            self.ways = positions.slide_ranges
            self.placed = GeoGebraLinkage(positions, self.objects, self.by_name).enter(self._pose_point)
        for name in self.plates.pose:
            if name not in self.entered:
                self._pose_point(name, self.placed.points.get(name, ()), is_fixed=not positions)
        if positions:
            self._warn(*positions.free)

    def _warn(self, *free: str) -> None:
        """Add a warning that is visible if the linkage cannot be assembled: then points that are not free are
        undefined."""
        carried = self.placed.points.keys() - {*free}
        self.objects.shown_if = " ∨ ".join(f"¬Defined[{self.by_name[name]}]" for name in self.plates.pose
                                           if name in carried)
        if carried:
            self.objects.text("caption", quote_text(self.say(UNASSEMBLED)), Pen(0.0, pens.RED), x=SLIDER + 60, y=40)
        self.objects.shown_if = ""

    def _pose_point(self, name: str, coordinates: tuple[str, ...], is_fixed: bool = False) -> None:
        """A point of the pose at these coordinates, held there, or free or fixed where it is given."""
        self.entered.add(name)
        mark = self.plates.pose[name]
        if coordinates:
            self.objects.expression(self.names[mark], "({}, {})".format(*coordinates), type="point")
        element = self._point(mark, self.given.pose[name].spot)
        if coordinates or is_fixed:
            empty(element, "fixed", val=True)

    def _point(self, drawn: DrawnStep, at: Spot | None = None) -> Element:
        """A mark's element, at its place in the given pose."""
        label, point = self.names[drawn], drawn.kind == POINT
        letter = self._letters.get(drawn)
        is_visible = bool(letter) or (point and drawn.view.rect.holds(drawn.spot))
        pen = pens.ARC if not point else pens.PAIR if not drawn.number else pens.ORIGIN if drawn.free else pens.DOT
        element = self.objects.element(TYPES[drawn.kind], label, is_visible, bool(letter), pen, POINTS if point
                                       else CURVES)
        if point:
            x, y = at or self._given_spot(drawn)
            empty(element, "coords", x=x, y=y, z=1.0)
            empty(element, "pointSize", val=3 if drawn.name else 1)
            empty(element, "pointStyle", val=0)
        if drawn.kind == OPENING:
            empty(element, "value", val=drawn.radius)
        if letter and label != letters(drawn.name):
            show_caption(element, letters(drawn.name))
        else:
            empty(element, "caption", val=self._typeset(drawn.sentence))
        if letter:
            size = 3 if drawn.name else 1
            x, y = letter.off[0] * self.size, letter.off[1] * self.size
            wide = letter.text.box.width * self.size
            empty(element, "labelOffset", x=round(x - wide / 2 - 4), y=round(size - y))
        return element

    @cached_property
    def _letters(self) -> dict[DrawnStep, Letter]:
        """The letters of points, by point."""
        letters = {letter.mark: letter for plate in reversed([*self.plates])
                   for letter in reversed([*self.letters(plate)])}
        return {mark: letters.get(mark) or Letter.above_right(mark) for mark in self.plates.all_marks
                if mark.name and mark.kind == POINT}

    def _given_spot(self, drawn: DrawnStep) -> Spot:
        """Place of a mark in the given pose, for readers that take a file as it stands."""
        if self.plates is self.given or not drawn.number:
            return drawn.spot
        x, y = (float(np.ravel(coordinate)[0]) for coordinate in self._in_given_pose[drawn.index][:2])
        return drawn.view((x, y)) if math.isfinite(x) and math.isfinite(y) else drawn.spot

    @cached_property
    def _in_given_pose(self) -> list[Any]:
        """The values of the drawn steps in the given pose, where they are drawn in another one."""
        scene = self.given.scene
        points = {name: np.array([complex(float(x), float(y))]) for name, (x, y) in scene.points.items()}
        guides = {slide.name: np.array([complex(*map(float, slide.direction))]) for slide in scene.slides
                  if slide.through is None}
        return corrected_values(self.plates.plans.drawing, ReachablePoses(points, guides), self.wrong)

    def _mark(self, drawn: DrawnStep) -> None:
        if drawn in self.plates.pose.values():  # a point of the scene that a step lays off is there already
            return
        if not drawn.free:
            wrong = self.wrong.get(drawn.index)
            if wrong:
                terms, name, inputs = formula_command(self._compound_mark(drawn, wrong.compound), self.names,
                                                      wrong.against)
            else:
                terms, name, inputs = command_of(drawn, self.names, self.placed.guides)
            for term, text in terms:
                self.objects.numeric(term, text)
            if name:
                self.objects.command(name, inputs, [self.names[drawn]])
            else:
                self.objects.expression(self.names[drawn], inputs[0], type=TYPES[drawn.kind])
        self._point(drawn)

    def _compound_mark(self, drawn: DrawnStep, compound: Compound) -> DrawnStep:
        """The mark of a compound as one step from what the compound reads."""
        step = compound.step
        return replace(drawn, step=step, args=tuple(self.plates.steps[arg] for arg in step.args))

    # ---- what is seen of them ----------------------------------------------------------------------------------

    def _stroke(self, stroke: Stroke) -> None:
        """A stroke or a vector between its marks, or parts of the way; a vector that is asked for with its value."""
        letter = (stroke.letter or stroke.of.name) if stroke in self.lettered_strokes and not stroke.vector else ""
        kind, layer = ("vector", VECTORS) if stroke.head else ("segment", CURVES)
        self.objects.add_shape(kind, kind.capitalize(), self.ends(stroke), stroke.pen, layer, letter)
        if stroke.vector and stroke.vector.label:
            self._value(stroke, f"vector_{{{self.objects.count}}}")

    def _value(self, stroke: Stroke, label: str) -> None:
        """Add the size of a vector, beside its middle, in the scene's units."""
        assert stroke.vector is not None
        kind, panel, units = stroke.vector.kind, stroke.vector.panel, self.plates.scene.units
        panel_scales = scales(self.plates)
        if kind in VELOCITIES:
            each, of = panel_scales.speed(panel), f"{units.length}/s"
        elif kind in ACCELERATIONS:
            each, of = panel_scales.acceleration(panel), f"{units.length}/s²"
        elif kind in FORCES:
            each, of = panel_scales.force(panel), units.force
        else:
            return
        beginning, written_unit = quote_text(f"{letters(stroke.vector.label)} = "), quote_text(" " + self.say(unit(of)))
        text = f"{beginning} + ({number(each)} * Length[{label}]) + {written_unit}"
        start, end = (self.names[mark] for mark in (stroke.start, stroke.end))
        self.objects.text("value", text, stroke.pen, number=0, exp=f"Midpoint[{start}, {end}]")

    def _arc(self, arc: StruckArc) -> None:
        """Add the arc of a circle around its mark."""
        centre, mark = f"Center[{self.names[arc.of]}]", self.names[arc.mark]
        turns = (f"Rotate[{mark}, {number(turn)}°, {centre}]" for turn in (-arc.before, arc.after))
        self.objects.add_shape("conicpart", "CircleArc", [centre, *turns], pens.ARC, CURVES)

    def _mechanism(self, plate: Plate) -> None:
        """The paths of points as they lie, and the mechanism, which rides on its points and links."""
        self.objects.shown_if = self._plan_box[plate.panel]
        for item, carrier in self.riding(plate, self.ways):
            if not isinstance(item, Circle) and item.pen != pens.HOLLOW:
                self._shape(pens.LINK if item.pen == pens.BAR else item.pen, corners(item), isinstance(item, Polygon),
                            carrier)
        self.objects.shown_if = ""

    def _shape(self, pen: Pen, spots: Sequence[Spot], closed: bool, part: Riding) -> None:
        """A shape of the mechanism; only plates are filled."""
        places = [self._riding(spot, part) for spot in spots]
        if pen == pens.PLATE:
            self.objects.add_shape("polygon", "Polygon", places, pens.LINK, LINKS)
            return
        for ends in pairwise([*places, *places[:closed]]):
            self.objects.add_shape("segment", "Segment", ends, pen, LINKS)

    def _riding(self, at: Spot, part: Riding) -> str:
        """A corner on its joint, else carried by what it rides on; or as it lies."""
        if at in self.joints and part.points:
            return self.by_name[self.joints[at].name]
        if not part.points:
            return spot(*at)
        point = min(part.points, key=lambda name: math.dist(self.given.pose[name].spot, at))
        carrier, name = self.given.pose[point], self.by_name[point]
        x, y = (number(round(coordinate - carrier_coordinate, 6))
                for coordinate, carrier_coordinate in zip(at, carrier.spot, strict=True))
        if part.link not in self.placed.turns:
            return f"{name} + ({x}, {y})"
        cos, sin = self.placed.turns[part.link]
        return f"{name} + ({cos} * {x} - {sin} * {y}, {sin} * {x} + {cos} * {y})"

    def _caption(self, plate: Plate) -> None:
        """Add the caption of a plan, at the top of its window, and its scales."""
        rect = plate.view.rect
        self.objects.text("caption", quote_text(plate.caption), number=0, exp=spot(rect.left, rect.top))
        texts = scales(self.plates).scale_texts(plate.panel, self.plates.plans.kinds(plate.panel))
        if texts:
            below = rect.top - CAPTION_HEIGHT / self.size
            self.objects.text("scale", quote_text(self._typeset(self.say(join(texts, ",  ")))), number=0,
                              exp=spot(rect.left, below))
