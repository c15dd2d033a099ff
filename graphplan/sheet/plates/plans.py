"""What is drawn where: which plan a mark lies on, which marks lie on a line or an arc, and how large a plan is.

All of it is read from the drawn program and its values; nothing here knows paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, reduce
from typing import Any

from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel, Step
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import PLACE
from graphplan.methods.construction import Construction, DrawnOut, DrawnVector, ForceArrow
from graphplan.methods.design import Design
from graphplan.methods.panels import MECHANISM, OF_RATES, SHEET_EXTENTS, ForcePlan, LeverPlan
from graphplan.sheet.plates.display import Rect, Spot
from graphplan.sheet.plates.pens import FORCES
from graphplan.sheet.plates.symbols import offset, reach, turn
from graphplan.sheet.plates.traced_motion import TracedMotion
from graphplan.sheet.tolerances import EXTENT_TOL
from graphplan.words.tongue import ENGLISH, Tongue

CARRYING = Movement.LAID_OFF, Movement.TURNED, Movement.STRUCK


def corner(step: Step) -> bool:
    """Whether a mark is a corner of a force polygon: those have numerals, apart from the numbers of steps."""
    return isinstance(step.panel, ForcePlan) and bool(step.name) and set(step.name) <= set("IVXLC'")


@dataclass(frozen=True)
class Extent:
    """The size of what a plan shows: `core` must be on paper, `extra` should be if it does not cost too much.

    `nice` is room for half circles, and for what is shown of the motion, taken where it costs nothing; `longest` is
    the longest vector or radius.
    """

    core: Rect
    extra: tuple[Spot, ...]
    nice: tuple[Spot, ...] = ()
    longest: float = 0.0


@dataclass(frozen=True)
class Plans:
    """A construction seen plan by plan, and the tongue in which its sheet speaks.

    A construction is a drawing of a mechanism with readings; what is drawn of anything else is seen so by
    :meth:`of_values`. Where it is `numbered`, every mark bears the number of its step, lettered marks too; where it is
    `unfolded`, all movements of compounds are told. `motion` is what the mechanism plan shows of it, if anything;
    `drawn` what was drawn of it so far, by its windows on the sheet; `swept` are corners of what plans are to have room
    for in other poses; `told` is what was told of drawings so far, whatever else is said of these plans. Scales that
    are not `scales_told` need not be round.
    """

    drawing: Construction
    tongue: Tongue = ENGLISH
    numbered: bool = False
    unfolded: bool = False
    scales_told: bool = True
    motion: TracedMotion | None = None
    swept: Mapping[str, Sequence[Spot]] = field(default_factory=dict, compare=False, repr=False)
    drawn: dict[Any, Any] = field(default_factory=dict, init=False, compare=False, repr=False)
    told: dict[Any, Any] = field(default_factory=dict, compare=False, repr=False)

    @classmethod
    def of_values(cls, values: Values, scene: Scene, vectors: Sequence[ForceArrow] = ()) -> Plans:
        """Any drawing with the values of its marks, titled as a scene and in its units, but of no mechanism; `vectors`
        lie between its wanted marks."""
        marks = DrawnOut(values.drawing, values.numbers, values.domain)
        drawing = Construction(values.drawing.program, scene=Scene.without_mechanism(scene), design=Design("polar"),
                               readings=(), turned=False, force_arrows=tuple(vectors), posed=marks)
        return cls(drawing)

    @property
    def plan_of_step(self) -> list[Panel]:
        """The plan of every step."""
        return self.drawing.plan_of_step

    @cached_property
    def panels(self) -> list[Panel]:
        """The plans in drawing order, the mechanism's first, if there is one."""
        panels = dict.fromkeys(self.plan_of_step)
        mechanism = next((panel for panel in panels if panel == MECHANISM), MECHANISM)
        return list(dict.fromkeys([*([mechanism] if self.drawing.scene.points else ()), *panels]))

    @cached_property
    def sentences(self) -> list[str]:
        """Sentences of all drawn steps, in the language of the sheet."""
        return [*map(self.tongue, self.drawing.sentences())]

    def sentence(self, index: int) -> str:
        """Sentence of the drawn step at this place."""
        return self.sentences[index]

    @cached_property
    def twins(self) -> dict[str, Panel]:
        """For each plan the one at whose scale it is drawn."""
        return {panel: panel.twin for panel in self.panels}

    @property
    def carry_overs(self) -> list[tuple[Panel, Panel]]:
        """The plans from which lengths are carried over to others, with those, in drawing order."""
        plan, carried = self.plan_of_step, dict[tuple[Panel, Panel], None]()
        for step in self.drawing.drawn.steps:
            if step.op.afar and step.op.movement in CARRYING and not step.quantity:
                carried[plan[step.args[step.op.afar[0][0]]], plan[step.index]] = None
        return [(source, target) for source, target in carried if source != target]

    @cached_property
    def marks_on(self) -> dict[int, tuple[int, ...]]:
        """For each line and each arc, the marks that lie on it by construction."""
        steps = self.drawing.drawn.steps
        marks_of: dict[int, list[int]] = {step.index: [] for step in steps if step.op.gives in (LINE, CIRCLE)}
        for step in steps:
            for place in step.op.claim_operands("on"):
                pair = step.index, step.args[place]
                curve, mark = pair if steps[pair[1]].op.gives == POINT else pair[::-1]
                if curve in marks_of and steps[mark].op.gives == POINT:
                    marks_of[curve].append(mark)
        return {curve: tuple(dict.fromkeys(marks)) for curve, marks in marks_of.items()}

    @cached_property
    def read_by_number(self) -> set[int]:
        """The marks that are spoken of by number: those that later steps read, but of what is drawn within a compound,
        where that is told as one step, only what its words name."""
        program = self.drawing.drawn
        compounds = () if self.unfolded else self.drawing.compounds
        whole = {step.index: compound.step.index for compound in compounds for step in compound.movements}
        read = {arg for step in program.steps for arg in step.args
                if arg not in whole or whole[arg] != whole.get(step.index)}
        read.update(mark for compound in compounds for mark in compound.marks_in_words)
        return {mark for mark in read if program.text(mark).endswith(f" {program.number(mark)}")}

    @cached_property
    def similar_triangles(self) -> dict[int, tuple[int, ...]]:
        """The marks that make a triangle similar to a link's, each with the other two corners."""
        return {compound.step.index: compound.step.args[-2:] for compound in self.drawing.compounds
                if compound.step.op.claim_operands("shaped")}

    def points(self, panel: str) -> list[int]:
        """The points that lie on a plan, by step."""
        steps = self.drawing.drawn.steps
        return [i for i, home in enumerate(self.plan_of_step) if home == panel and steps[i].op.gives == POINT]

    def spot(self, index: int) -> Spot:
        """Place of a point on its plan."""
        x, y = self.drawing.values[index][:2]
        return float(x), float(y)

    def place(self, name: str) -> Spot:
        """Place of a point of the mechanism."""
        x, y = self.drawing.scene.points[name]
        return float(x), float(y)

    def vectors(self, panel: str) -> list[DrawnVector]:
        """The vectors drawn on a plan."""
        return [vector for vector in self.drawing.arrows if self.plan_of_step[vector.end] == panel]

    @property
    def lengths(self) -> list[tuple[str, Panel, float]]:
        """The vectors that are drawn: each with its kind, its plan, and its length there."""
        return [(vector.kind, panel, math.dist(self.spot(vector.start), self.spot(vector.end)))
                for panel in self.panels for vector in self.vectors(panel)]

    def kinds(self, panel: str) -> set[str]:
        """The kinds of vector of a plan, which has their scales: those drawn on it, and those that it is made of.

        A plan of rates is made of them even where only those of links are asked for; a lever is made of velocities, and
        bears only those of its scene.
        """
        made_of = {OF_RATES[panel]} if panel in OF_RATES else set()
        if panel == LeverPlan.of_part() and self._moves:
            made_of = {"velocity"}
        return made_of | {vector.kind for vector in self.vectors(panel)}

    @property
    def _moves(self) -> bool:
        """Whether the scene has one drive, and it moves: else a lever has assumed velocities."""
        drives = self.drawing.scene.drives
        return len(drives) == 1 and bool(drives[0].rate)

    def diameter(self, step: Step) -> int | None:
        """One end of a half circle's diameter: of an arc struck about the middle of two points through one of them."""
        centre, opening = (self.drawing.drawn.steps[arg] for arg in step.args)
        if centre.op.movement is Movement.HALVED and opening.op.spans and centre.index in opening.args:
            return next((arg for arg in opening.args if arg in centre.args), None)
        return None

    def apexes(self, panel: str) -> dict[int, Spot]:
        """The highest points of the half circles on a plan, by step."""
        apexes = {}
        for step in self.drawing.drawn.steps:
            if step.op.gives == CIRCLE and self.plan_of_step[step.index] == panel:
                end, crossings = self.diameter(step), self.marks_on[step.index]
                if end is not None and crossings:
                    apexes[step.index] = _apex(self.spot(step.args[0]), self.spot(end), self.spot(crossings[0]))
        return apexes

    @cached_property
    def point_counts(self) -> dict[str, int]:
        """Number of points of each plan."""
        return {panel: len(self.points(panel)) for panel in self.panels}

    @cached_property
    def extents(self) -> dict[str, Extent]:
        """Extent of each plan."""
        return {panel: self.extent(panel) for panel in self.panels}

    def extent(self, panel: str) -> Extent:
        """Extent of a plan: the mechanism and the vectors are its core, auxiliary marks are included if possible."""
        ends = [self.spot(i) for i in self.ends(panel)]
        marks = [self.spot(i) for i in self.points(panel)]
        scene = self.drawing.scene
        core = [*ends, *map(self.place, scene.points), *reach(scene)] if panel == MECHANISM else ends or marks
        core = [*core, *self.swept.get(panel, ())]
        box = bounding_box([spot for spot in core if all(map(math.isfinite, spot))] or [(0.0, 0.0)])
        nice, tiny = list(self.apexes(panel).values()), EXTENT_TOL * scene.extent
        if max(box.width, box.height) < tiny:
            box = bounding_box([(box.left, box.bottom)])
        if panel == MECHANISM:
            box = self._with_asked(box)
        if self.motion and panel == MECHANISM:
            nice += [*self.motion.path_ends, *self.motion.position_ends, *self.motion.centrode_ends]
        extra = sorted((_distance_outside(box, spot), spot) for spot in marks if all(map(math.isfinite, spot)))
        return Extent(box, tuple(spot for far, spot in extra if far > tiny), tuple(nice), self._longest(panel))

    def _longest(self, panel: str) -> float:
        """The longest vector that is laid off on a plan or taken from it, or the largest radius of an arc."""
        lengths, plan = [0.0], self.plan_of_step
        for step in self.drawing.drawn.steps:
            if step.op.gives == CIRCLE and plan[step.index] == panel:
                lengths.append(math.sqrt(float(self.drawing.values[step.index][2])))
            ends = [(step.root, step.index)] if step.root is not None and step.op.gives == POINT else []
            ends += [(step.args[0], step.args[1])] if step.op.movement in CARRYING[:2] else []
            lengths += [math.dist(self.spot(p), self.spot(q)) for p, q in ends if plan[p] == plan[q] == panel]
        return max(filter(math.isfinite, lengths))

    def _with_asked(self, box: Rect) -> Rect:
        """The box with the places and paths that are asked for, as far as sheets hold them and no scale is given."""
        drawing, sheet = self.drawing, self.drawing.scene.sheet
        if sheet.k_s or sheet.k_v or sheet.k_a or sheet.k_F:
            return box
        marks = {drawing.drawn.wanted[place] for reading in drawing.readings if reading.kind.dimension == PLACE
                 for place in reading.marks}
        places = [(self.spot(mark),) for mark in self.points(MECHANISM) if mark in marks]
        paths, most = [self.motion.path_ends] if self.motion else [], SHEET_EXTENTS * drawing.scene.extent
        spots = [spot for near in (*places, *paths) if all(math.dist(spot, box.centre) <= most for spot in near)
                 for spot in near]
        return reduce(extend_box, spots, box)

    def ends(self, panel: str) -> Iterator[int]:
        """The marks between which vectors are drawn: those asked for, those given; of forces all that have letters."""
        program, forces = self.drawing.drawn, self.kinds(panel) & FORCES
        for vector in self.vectors(panel):
            yield from (vector.start, vector.end)
        for step in (program.steps[index] for index in self.points(panel)):
            if step.root is not None and program.given_vector(step):
                yield from (step.root, step.index)
            elif forces and panel != MECHANISM and step.name:
                yield step.index


def _apex(centre: Spot, end: Spot, crossing: Spot) -> Spot:
    """The point of a half circle that is farthest from its diameter, on the side of the crossing."""
    return offset(centre, (end[0] - centre[0], end[1] - centre[1]), 0.0, 1.0 if turn(centre, end, crossing) >= 0
                  else -1.0)


def bounding_box(spots: Sequence[Spot]) -> Rect:
    """The box around some spots."""
    xs, ys = [x for x, _ in spots], [y for _, y in spots]
    return Rect(min(xs), min(ys), max(xs), max(ys))


def _distance_outside(box: Rect, spot: Spot) -> float:
    """Distance of a spot from a box."""
    x, y = spot
    return max(box.left - x, x - box.right, box.bottom - y, y - box.top, 0.0)


def extend_box(box: Rect, spot: Spot) -> Rect:
    """The box made large enough to hold a spot."""
    x, y = spot
    return Rect(min(box.left, x), min(box.bottom, y), max(box.right, x), max(box.top, y))
