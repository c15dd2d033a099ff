"""The sheet of a synthesis: the construction with the mechanism that it finds, and in a column beside it what is given,
found and drawn, step by step.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

from graphplan.kernel.passes import Drawing, Values
from graphplan.mechanism.model import Scene
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.frames.frame import sheet_code
from graphplan.sheet.frames.title import GUIDED, TASK
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.free_room import FreeRoom
from graphplan.sheet.layout.paper import Arrangement, sheet_size
from graphplan.sheet.layout.scales import Scales, ratio
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import LetterSizes, name_runs
from graphplan.sheet.lettering.letters import place_letters
from graphplan.sheet.panels import GAP_MM, Blank, PanelFigure, PanelPage, PanelSheet, Words, column, fit_view
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.view import View, clip_item, view
from graphplan.synthesis.exports import asked_lengths
from graphplan.synthesis.figure import TOOTH, WHOLE, SynthesisFigure, extent, wheel_outlines
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.sketch import PLAN, Synthesis
from graphplan.synthesis.stroke import ratio_of
from graphplan.words.tongue import tongue

PLAN_MARGIN_MM = 10.0
SHEET = said("Synthesis sheet")
POSITIONS_TOLD = 24  # rows of a table at most
LENGTH_LETTERS = {"offset": "e", "crank": "OA", "rod": "AB"}
TYPES = {"crank-rocker": said("crank-rocker"), "double-crank": said("double crank"),
         "rocker-crank": said("rocker-crank"), "double-rocker": said("double rocker"),
         "triple-rocker": said("triple rocker"), "change point": said("at a change point"),
         "slider-crank": said("slider-crank"), "slotted lever": said("slotted lever")}
DEFECTS = {"branch": said("branch defect: the angle at {0} changes its sense between the positions", "B"),
           "circuit": said("circuit defect: the positions are on two circuits"),
           "order": said("order defect: the crank does not come to the positions in order")}


def length_letters(name: str) -> str:
    """Letter of a length on paper, by the names of its ends as on the figure."""
    return LENGTH_LETTERS.get(name, re.sub(r"(?<=[A-Z])(\d)", r"_\1", name.replace(" ", "")))


def lengths_text(lengths: Mapping[str, float], length: Said, count: int = 6) -> Said:
    """Lengths by their letters, of so many digits, and after the last one their unit."""
    return arrange("{0} {1}", join(arrange("{0} = {1}", length_letters(name), digits(size, count))
                                   for name, size in lengths.items()), length)


@dataclass(frozen=True)
class SynthesisOnPaper:
    """One synthesis on one paper; as a task only what is given, with boxes to fill in, on the scale of the solution,
    guided with the steps in words and boxes to tick."""

    paper: str
    synthesis: Synthesis
    check: dict[str, float]
    document: Said = SHEET

    @cached_property
    def page(self) -> PanelPage:
        """The page, with title, source and sheet of the task."""
        task = self.synthesis.task
        scene = Scene.without_mechanism(task, tongue(task.sheet.language).title(task.title))
        return PanelPage(self.paper, scene, column((1.0, PLAN)))

    @cached_property
    def view(self) -> View:
        """The figure in the middle of its panel, at a round scale, or below the detail of a mesh."""
        return self._low_view if self.detail else self._middle_view

    @cached_property
    def _middle_view(self) -> View:
        return fit_view(extent(self.synthesis), self.page.room(PLAN), PLAN_MARGIN_MM)

    @cached_property
    def _low_view(self) -> View:
        box, rect, scale = extent(self.synthesis), self.page.room(PLAN), self._middle_view.scale
        foot = rect._replace(top=rect.bottom + box.height * scale + 2 * PLAN_MARGIN_MM)
        return replace(view(box, foot, 1 / scale), rect=rect)

    @cached_property
    def detail(self) -> list[Item]:
        """The mesh of wheels enlarged, where it is small and there is room above them."""
        if self.synthesis.task.kind != "gear":
            return []
        figure = self._figure_in(self._low_view)
        return mesh_detail(self.synthesis, figure.view, [*figure.plate.items(), *figure.mechanism()],
                           self.page.letters)

    def _figure_in(self, window: View) -> SynthesisFigure:
        return SynthesisFigure(self.synthesis, window, self.page.scene, self.page.letters)

    @property
    def scales(self) -> Scales:
        task = self.synthesis.task
        return Scales(1 / self.view.scale, 1.0, task.units.length, {}, convention=task.sheet.convention)

    @property
    def sheet(self) -> PanelSheet:
        """The sheet."""
        values, figure, words = self.synthesis.values, self._figure_in(self.view), SynthesisWords(self.synthesis)
        program, task = values.drawing.program, self.document in (TASK, GUIDED)  # whether it is for students
        shown = PanelFigure(
            self.view.rect, plate=figure.plate, strokes=figure.given_strokes(), given=True,
            is_named=lambda mark: not mark.number, heading=said("Construction")) if task else PanelFigure(
            self.view.rect, plate=figure.plate, strokes=[*figure.mechanism(), *self.detail],
            is_named=partial(figure.has_letter, enlarged=bool(self.detail)))
        return PanelSheet(
            self.page, self.document, said("A mechanism found in {0} steps.", len(program) - program.givens), values,
            ratio(self.scales.k_s, self.synthesis.task.units.length), {PLAN: shown}, self.scales,
            given=[*words.given_words()], found=[words.boxes] if task else [*words.found_words(self.check)],
            found_heading=said("To find") if task else said("Found"),
            steps="ticked" if self.document == GUIDED else "" if task else "told")

    # ---- as drawings by hand are laid on it ------------------------------------------------------------------------

    @cached_property
    def composition(self) -> Composition:
        """The construction where it lies on this sheet."""
        page, (wide, high) = self.page, sheet_size(self.paper)
        rect = page.panels[PLAN]
        column = page.column._replace(left=rect.right + GAP_MM)
        arrangement = Arrangement(self.paper, wide, high, page.space, {MECHANISM: rect}, (column,), page.title)
        return Composition(arrangement, self.scales, {MECHANISM: self.view},
                           Plans(self.construction(self.synthesis.values), page.tongue))

    def construction(self, values: Values) -> Construction:
        """A drawing of the task as that of a mechanism's plan."""
        steps = tuple(step.but(panel=MECHANISM) for step in values.drawing.program.steps)
        program = replace(values.drawing.program, steps=steps)
        return Plans.of_values(Values(Drawing(program), values.numbers), self.page.scene).drawing

    @property
    def code(self) -> int:
        """Checksum of the task and of where its figure lies, by which a scan is recognized."""
        frame = self.page.scene.sheet.frame
        return sheet_code(f"{self.synthesis.task.text}\n{self.paper}, {frame}, {self.scales.k_s:.6g}")


@dataclass(frozen=True)
class SynthesisWords:
    """The words of one sheet."""

    synthesis: Synthesis

    @property
    def boxes(self) -> Blank:
        """Boxes for what a task asks for."""
        return Blank([["", ""], *([length_letters(name), "?"] for name in asked_lengths(self.synthesis))])

    @property
    def _length(self) -> Said:
        return unit(self.synthesis.task.units.length)

    def given_words(self) -> Iterator[Words]:
        """The data of the task."""
        request = self.synthesis.task.request
        match self.synthesis.task.kind:
            case "guidance":
                yield from self._given_positions(request)
            case "function":
                yield from self._given_pairs(request)
            case "stroke":
                yield from self._given_stroke(request)
            case "cognates" | "dwell":
                yield said("The path of {0} on link {1} of {2}", request.point, request.link, request.scene)
                if request.span != (0.0, 0.0):
                    yield said("From {0} to {1} of the travel", *map(digits, request.span))
                if request.pivot:
                    yield self._point_text("E", complex(*request.pivot))
            case "geneva":
                yield said("{0} slots, centres {1} {2} apart", request.slots, digits(request.centres), self._length)
            case "conjugate":
                if not request.translating:
                    yield said("Centres {0} {1} apart", digits(request.centres), self._length)
                if not request.law:
                    yield arrange("{0} = {1}", "ds/dφ" if request.translating else "omega_2/omega_1",
                                  digits(request.ratio))
                yield from self._given_profile(request.profile)
                yield arrange("φ: {0}° … {1}°", *map(digits, request.span))
            case "gear":
                yield said("Module {0} {1}, {2} and {3} teeth, pressure angle {4}°", digits(request.module),
                           self._length, *request.teeth, digits(request.pressure_angle))
                shifts = [wheel.shift for wheel in GearPair(request, self.synthesis.task.name).wheels]
                yield join([arrange("{0} = {1}", name, digits(size, 4)) for name, size in zip(
                    ("x_1", "x_2", "h_a/m", "c/m"), (*shifts, request.addendum, request.clearance), strict=True)])

    def _given_profile(self, profile: Mapping[str, Any]) -> Iterator[Said]:
        """The profile of body 2 by its points, and of a circle its radius."""
        points = profile["line"] if "line" in profile else [profile.get("circle", profile.get("point"))]
        radius = [arrange("r = {0} {1}", digits(profile["radius"]), self._length)] if "radius" in profile else []
        yield join([*(self._point_text(name, complex(*point)) for name, point in zip(
            "QR" if "line" in profile else "B", points, strict=True)), *radius])

    def _given_positions(self, request: Any) -> Iterator[Words]:
        yield [["", "x", "y", "φ, °"], *([str(k), *map(digits, row)] for k, row in enumerate(request.positions, 1))]
        for names, points in (("AB", request.moving), ("OC", request.fixed)):
            if points and isinstance(points[0], tuple):
                yield join([self._point_text(name, complex(*point)) for name, point in zip(names, points, strict=True)])
            elif points:
                yield join([arrange("{0}: u = {1}", name, digits(point.u)) for name, point in
                            zip(names, points, strict=True)])
        if request.turns:
            yield said("{0} turns by {1}°, {2} by {3}°", "OA", digits(request.turns[0]), "CB", digits(request.turns[1]))
        if request.driver:
            yield said("A crank swings OA, time ratio K = {0}", digits(request.driver))

    def _point_text(self, name: str, z: complex) -> Said:
        return arrange("{0} ({1}; {2})", name, digits(z.real), digits(z.imag))

    def _given_pairs(self, request: Any) -> Iterator[Words]:
        values, head = (request.rocker["angles"], "ψ, °") if request.rocker else (
            request.slide["at"], arrange("s, {0}", self._length))
        yield [["", "φ, °", head], *([str(k), digits(phi), digits(value)]
                                       for k, (phi, value) in enumerate(zip(request.input, values, strict=True), 1))]
        if request.rocker:
            yield self._point_text("C", complex(*request.rocker["pivot"]))
        if request.crank:
            yield arrange("{0} = {1} {2}", "OA", digits(request.crank), self._length)

    def _given_stroke(self, request: Any) -> Iterator[Words]:
        yield said("Time ratio K = {0}: the dead positions are {1}° apart", digits(ratio_of(request.angle)),
                   digits(request.angle))
        sizes = [(said("stroke"), request.stroke), (said("rocker"), request.rocker and request.rocker["length"]),
                 (said("ground"), request.lever or (request.ground if isinstance(request.ground, float) else None))]
        for words, size in sizes:
            if size:
                yield arrange("{0:capital}: {1} {2}", words, digits(size), self._length)
        if request.rocker:
            yield said("Swing: {0}°", digits(request.rocker["swing"]))
        if request.given[0] in LENGTH_LETTERS:
            yield lengths_text(dict([request.given]), self._length)

    def found_words(self, check: Mapping[str, float]) -> Iterator[Words]:
        """The results, and the differences of the independent check."""
        if self.synthesis.linkages:
            yield from self._linkage_words()
        else:
            yield from self._other_words()
        yield said("The independent check differs by: {0}", join(digits(gap, 2) for gap in check.values()))

    def _linkage_words(self) -> Iterator[Words]:
        synthesis, linkage = self.synthesis, self.synthesis.linkage
        if len(synthesis.linkages) > 1:
            yield said("Solution {0} of {1}", synthesis.chosen + 1, len(synthesis.linkages))
        yield lengths_text(asked_lengths(synthesis), self._length)
        yield arrange("{0:capital}", TYPES[linkage.type])
        for defect in linkage.defects:
            yield arrange("{0:capital}", DEFECTS[defect])
        if linkage.travel and len(linkage.travel) > 1:
            yield said("The crank turns by {0}°", join(digits(turn, 5) for turn in linkage.travel[1:]))
        least, at = linkage.transmission
        yield said("Least transmission angle: {0}° at {1}°", digits(least, 4), digits(at, 4))
        if crank := linkage.further.get("driver"):
            yield lengths_text(crank["lengths"], self._length)
            yield said("Least transmission angle of the driving crank: {0}°", digits(crank["transmission"]["least"], 4))
        if "structural_error" in synthesis.results:
            error = synthesis.results["structural_error"]
            yield said("Structural error: {0} at {1}°", digits(error["largest"], 3), digits(error["at"]))
        yield from self._circle_points()

    def _circle_points(self) -> Iterator[Words]:
        rows = self.synthesis.results.get("circle_points", ())
        if rows:
            yield [["u", "z", "x", "y", "r"], *([digits(value, 5) for value in (
                row["u"], row["z"], *row["centre"], row["radius"])] for row in rows[:POSITIONS_TOLD])]

    def _other_words(self) -> Iterator[Words]:
        kind, results = self.synthesis.task.kind, self.synthesis.results
        yield from self._circle_points()
        if kind == "dwell":
            if "radius" in results:
                yield arrange("{0}; r = {1} {2}", self._point_text("D", complex(*results["centre"])),
                              digits(results["radius"], 6), self._length)
                yield said("The output turns by {0}° while it dwells, by {1}° in all",
                           digits(results["output"]["dwell"], 3), digits(results["output"]["swing"], 4))
            yield said("Largest deviation: {0} {1}", digits(results["deviation"], 3), self._length)
        elif kind == "geneva":
            yield arrange("OS = {0} {2}, CS = {1} {2}", digits(results["crank"], 6), digits(results["wheel"], 6),
                          self._length)
            yield said("Working angle {0}°, idle angle {1}°, ratio {2}", digits(results["working"]),
                       digits(results["idle"]), digits(results["ratio"], 4))
            yield said("Largest speed {0}, acceleration {1} at entry, {2} at {3}°", digits(results["omega"], 4),
                       *(digits(results["alpha"][key], 4) for key in ("entry", "largest", "crank_at")))
        elif kind == "conjugate":
            yield [["φ, °", "x", "y"], *([digits(value, 5) for value in (phi, x, y)]
                                           for phi, *_, x, y in results["contacts"])]
            for cusp in results["cusps"]:
                yield said("Cusp at {0}°", digits(cusp[0], 4))
        elif kind == "gear":
            yield from self._gear_words(results)

    def _gear_words(self, results: Mapping[str, Any]) -> Iterator[Words]:
        rows: list[list[Said | str]] = [["", "r", "r_b", "r_a", "r_f", "s"]]
        for k, wheel in enumerate(results["wheels"], 1):
            rows.append([str(k), *(digits(wheel[key], 5) for key in ("pitch", "base", "tip", "root", "thickness"))])
        yield rows
        yield said("Centres {0} {1} apart", digits(results["centres"], 6), self._length)
        yield said("Working pressure angle {0}°, contact ratio {1}", digits(results["working_angle"], 5),
                   digits(results["contact_ratio"], 4))
        for defect in results["defects"]:
            word, _, wheel = defect.partition(" ")
            yield arrange("{0:capital}", {"undercut": said("wheel {0} is undercut", wheel), "interference": said(
                "interference at wheel {0}", wheel), "contact": said("the contact ratio is below 1")}[word])


# ---- the mesh of two wheels enlarged, where it is too small for its letters ------------------------------------------

DETAIL, ACTION, PATH_OF_CONTACT = "details", Pen(0.25), Pen(0.6, pens.RED)
SMALL_MM, ENLARGEMENTS = 60.0, (5, 4, 3, 2)  # of a line of action that is enlarged; so many times, as there is room
MARGIN_MM, CAPTION_MM, DOT_MM = 14.0, 5.0, 0.5  # about the line of action; below the detail; of a mark


def mesh_detail(synthesis: Synthesis, figure: View, items: Sequence[Item], letters: LetterSizes) -> list[Item]:
    """The detail of a figure on which these items lie; empty if the mesh is large enough, or there is no room."""
    box = bounding_box([*synthesis.results["line"].values()])
    if max(box.width, box.height) * figure.scale > SMALL_MM:
        return []
    room = FreeRoom(figure.rect, items)
    for scale in (times * figure.scale for times in ENLARGEMENTS):
        wide, high = (length * scale + 2 * MARGIN_MM for length in (box.width, box.height))
        if window := room.window(wide, high + CAPTION_MM, is_first=True):
            caption = tongue(synthesis.task.sheet.language)(ratio(1 / scale, synthesis.task.units.length))
            return [Text(pens.LETTERS, DETAIL, None, (window.left, window.bottom), name_runs(caption), letters.text),
                    *_mesh(synthesis, view(box, window.inset(0.0, CAPTION_MM, 0.0, 0.0), 1 / scale), letters)]
    return []


def _mesh(synthesis: Synthesis, detail: View, letters: LetterSizes) -> list[Item]:
    """Teeth, circles, the line of action, and on it the path of contact, with letters."""
    gears, line = GearPair(synthesis.task.request, synthesis.task.name), synthesis.results["line"]
    strokes: list[Item] = [Polyline(TOOTH, DETAIL, None, tuple(detail((z.real, z.imag)) for z in (*teeth, teeth[0])))
                           for teeth in wheel_outlines(gears)]
    for centre, wheel in zip((0.0, gears.centres), gears.wheels, strict=True):
        strokes += [Circle(WHOLE[f"{name} circle"], DETAIL, None, detail((centre, 0.0)),
                           getattr(wheel, name) * detail.scale) for name in ("pitch", "base", "tip")]
    strokes += [Polyline(pen, DETAIL, None, tuple(detail(line[end]) for end in ends))
                for pen, ends in ((ACTION, ("N1", "N2")), (PATH_OF_CONTACT, "AB"))]
    spots = {"_".join(name): detail(at) for name, at in line.items()}
    ink = [piece for stroke in strokes for piece in clip_item(stroke, detail.rect)]
    ink += [Circle(pens.DOT, DETAIL, None, at, DOT_MM) for at in spots.values()]
    names = [Wish(name_runs(name), (at,), DOT_MM + 0.3, layer=DETAIL) for name, at in spots.items()]
    corners = detail.rect.corners
    return [*ink, Polyline(pens.ARC, DETAIL, None, (*corners, corners[0])),
            *place_letters(names, ink, [*spots.values()], detail.rect, letters)]
