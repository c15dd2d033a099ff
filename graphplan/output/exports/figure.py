"""The drawn construction as dependent objects on one plane, in mm of paper: what exports of the steps walk over.

Every plan stands where it stands on the sheet, at its own scale: a point (x, y) of a plan falls at its origin and
scale times (x, y) from there.
"""

from __future__ import annotations

import math
import string
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from graphplan.kernel.kinds import LINE, OPENING, POINT, TABLE
from graphplan.kernel.program import Panel, Step
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import sentence as spoken
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates import clip, pens
from graphplan.sheet.plates.display import Arc, Polygon, Polyline, Rect, Spot
from graphplan.sheet.plates.linkage import Linkage
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import ALONE, BEYOND, FLATTEST, LOCUS_BEYOND, STRIKE, WIDEST
from graphplan.sheet.plates.symbols import hull, straight
from graphplan.sheet.plates.view import View
from graphplan.words.tongue import ENGLISH, Tongue

SAFE = string.ascii_letters + string.digits
SYMBOLS = "ground", "blocks", "drive"  # the layers of the mechanism that are no marks


@dataclass(frozen=True)
class Plan:
    """One panel: what is said of it, its mm per unit, where its origin falls and what of the paper it has."""

    name: str
    caption: str
    scale: float
    origin: Spot
    rect: Rect

    def __call__(self, spot: Spot) -> Spot:
        """Where a point of the plan falls, in mm."""
        return self.origin[0] + self.scale * spot[0], self.origin[1] + self.scale * spot[1]


@dataclass(frozen=True, eq=False)
class Object:
    """One drawn step, or a point of the pose that no step reads: what it makes, from which objects.

    `id` is a safe identifier, unique and the same in every run; `number` is 0 for the pose, `index` negative where no
    step reads it; `value` has the shape of its kind (kernel/kinds.py), in the units of its plan.
    """

    index: int
    number: int
    id: str
    step: Step
    plan: Plan
    args: tuple[Object, ...] = field(repr=False)
    value: tuple[float, ...]
    sentence: str

    @property
    def name(self) -> str:
        """The letter as in the program, or nothing."""
        return self.step.name

    @property
    def kind(self) -> str:
        """The kind of mark."""
        return self.step.op.gives

    @property
    def why(self) -> str:
        """The law or purpose."""
        return self.step.why

    @property
    def at(self) -> Spot:
        """Where a point falls, or a circle's centre, in mm."""
        return self.plan((self.value[0], self.value[1]))

    @property
    def radius(self) -> float:
        """Of a circle or an opening, in mm."""
        return math.sqrt(self.value[-1]) * self.plan.scale

    @property
    def root(self) -> Object | None:
        """The mark of its own plan that a point is laid off from, if it is: a stroke joins the two."""
        place = self.step.root
        found = next((arg for arg in self.args if arg.index == place), None)
        return found if found is not None and found.plan is self.plan else None

    @property
    def struck(self) -> float:
        """How far a circle is drawn to both sides of a crossing, in degrees."""
        return min(WIDEST, max(FLATTEST, math.degrees(STRIKE / self.radius))) if self.radius else WIDEST

    @property
    def line(self) -> tuple[float, float, float]:
        """A line by its equation a x + b y + c = 0 in mm, running along (b, -a)."""
        a, b, c = self.value
        return a, b, c * self.plan.scale - a * self.plan.origin[0] - b * self.plan.origin[1]

    @property
    def free(self) -> bool:
        """Whether it stands where it is put: a point of the pose, or the beginning of a plan."""
        return self.kind == POINT and not self.args

    @property
    def auxiliary(self) -> bool:
        """Whether nothing of it is shown: an opening, or a point without a letter."""
        return self.kind == OPENING or (self.kind == POINT and not self.name)

    @property
    def pen(self) -> Pen:
        """What it is drawn with, as on the sheet."""
        if self.kind == POINT:
            return pens.ORIGIN if self.step.op.name == "begin" else pens.PAIR if self.number == 0 else pens.DOT
        if self.kind == LINE:
            return pens.LOCUS if self.name else pens.THIN
        return pens.ARC

    def factor(self, other: Object) -> float:
        """How many mm here are one mm on the plan of another object: by it a length is carried over."""
        return self.plan.scale / other.plan.scale


@dataclass(frozen=True)
class Arrow:
    """A vector that the construction asks for: its marks, its kind (pens.VECTORS), the point it is of, its letter."""

    start: Object
    end: Object
    kind: str
    point: str
    label: str


@dataclass(frozen=True)
class Link:
    """A moving link: its name, and its points in the order of the scene."""

    name: str
    points: tuple[Object, ...]

    @property
    def corners(self) -> tuple[Object, ...]:
        """The ends of a bar, or the corners of a plate, counter-clockwise; one point alone has neither."""
        places = {point.at: point for point in reversed(self.points)}
        spots = (min(places), max(places)) if straight(list(places)) else hull(list(places))
        return tuple(places[spot] for spot in dict.fromkeys(spots))

    @property
    def ribs(self) -> tuple[tuple[Object, Object], ...]:
        """For each point inside a plate the corner that is next to it, and the point."""
        corners = self.corners
        inner = [point for point in self.points if point.at not in {corner.at for corner in corners}]
        return tuple((min(corners, key=lambda corner: math.dist(corner.at, point.at)), point)
                     for point in inner if len(corners) > 2)


@dataclass(frozen=True)
class Symbol:
    """A stroke of the mechanism's symbols as it lies, in mm: of the ground, of a block, or the sense of a drive.

    `closed` says that its ends are joined; what it encloses is filled where the pen says so.
    """

    layer: str
    pen: Pen
    spots: tuple[Spot, ...]
    closed: bool


@dataclass(frozen=True)
class Figure:
    """A construction as objects: the plans, then the objects, each after those that it depends on.

    The points of the pose come first, those among them last that only the links need. `marks` are the points on each
    line and arc, on its own plan; `symbols` are decoration, on which nothing depends; captions and sentences are in the
    `tongue`, as is what a target adds to them.
    """

    title: str
    source: str
    plans: tuple[Plan, ...]
    objects: tuple[Object, ...]
    arrows: tuple[Arrow, ...]
    links: tuple[Link, ...]
    marks: Mapping[Object, tuple[Object, ...]] = field(repr=False)
    symbols: tuple[Symbol, ...] = ()
    tongue: Tongue = ENGLISH

    @property
    def steps(self) -> tuple[Object, ...]:
        """The objects that are drawn, in the order of the protocol: all but the pose."""
        return tuple(object for object in self.objects if object.number)

    @property
    def box(self) -> Rect:
        """The paper that the plans take up."""
        rects = [plan.rect for plan in self.plans]
        return Rect(min(r.left for r in rects), min(r.bottom for r in rects),
                    max(r.right for r in rects), max(r.top for r in rects))

    def drawn_symbols(self, plan: Plan, *layers: str) -> list[Symbol]:
        """The symbols of some layers; they stand on the mechanism's plan, which is the first."""
        return [symbol for symbol in self.symbols if symbol.layer in layers and plan is self.plans[0]]

    def stretch(self, line: Object) -> tuple[Object, Object, float] | None:
        """How much of a line is drawn: between which marks, the way it runs, and how many mm beyond them."""
        a, b, _ = line.value
        marks = sorted(self.marks[line], key=lambda mark: b * mark.at[0] - a * mark.at[1])
        if not marks:
            return None
        if line.step.op.name == "line" and len(marks) == 2:
            return marks[0], marks[-1], 0.0
        beyond = LOCUS_BEYOND if line.name else BEYOND
        return marks[0], marks[-1], ALONE if math.dist(marks[0].at, marks[-1].at) < 1.0 else beyond

    @property
    def firsts(self) -> dict[str, Object]:
        """The first object that is drawn on each plan."""
        return {object.plan.name: object for object in reversed(self.steps)}


def figure(drawing: Construction, composition: Composition, tongue: Tongue = ENGLISH) -> Figure:
    """A construction as objects, each plan where the composition of its sheet puts it."""
    found = _Figures(Plans(drawing, tongue), composition)
    objects = found.objects
    arrows = tuple(Arrow(objects[v.start], objects[v.end], v.kind, v.point, v.label)
                   for panel in found.plans for v in found.seen.vectors(panel))
    links = tuple(Link(name, tuple(found.pose[point] for point in drawing.scene.links[name]))
                  for name in drawing.scene.moving)
    plans, ordered = tuple(found.plans.values()), tuple(found.ordered())
    symbols = tuple(found.symbols())
    title, source = drawing.scene.title, drawing.scene.source
    return Figure(title, source, plans, ordered, arrows, links, found.marks, symbols, tongue)


@dataclass(frozen=True)
class _Figures:
    """The making of a figure."""

    seen: Plans
    composition: Composition

    @cached_property
    def plans(self) -> dict[str, Plan]:
        return {panel: self._plan(panel, self.composition.views[panel]) for panel in self.seen.panels}

    def _plan(self, panel: Panel, view: View) -> Plan:
        told = self.seen.tongue(panel.caption(self.seen.kinds(panel)))
        return Plan(panel, told, view.scale, view.origin, view.rect)

    @cached_property
    def objects(self) -> list[Object]:
        """The steps of the drawn program."""
        drawing = self.seen.drawing
        found: list[Object] = []
        sentences = map(self.seen.tongue, drawing.sentences())
        told = zip(drawing.drawn.steps, drawing.values, sentences, self.seen.plan_of_step, strict=True)
        for step, value, sentence, home in told:
            number = max(0, drawing.drawn.number(step.index))
            args = tuple(found[arg] for arg in step.args)
            name = _unique(step, {object.id for object in found})
            found.append(Object(step.index, number, name, step, self.plans[home], args, _floats(value), sentence))
        return found

    @cached_property
    def pose(self) -> dict[str, Object]:
        """Every point of the scene."""
        found = {object.name: object for object in self.objects if object.step.op.name == "given"}
        for name in self.seen.drawing.scene.points:
            if name not in found:
                taken = {object.id for object in (*self.objects, *found.values())}
                found[name] = self._bystander(name, min((0, *(object.index for object in found.values()))) - 1, taken)
        return found

    def _bystander(self, name: str, index: int, taken: set[str]) -> Object:
        """A point of the pose that no step reads; its index is negative, and its own."""
        spot = self.seen.place(name)
        step = Step(index, name, TABLE["given"], (), {"x": spot[0], "y": spot[1]}, MECHANISM)
        told = spoken("given", step.op.sentence, (), {"out": name, "x": f"{spot[0]:g}", "y": f"{spot[1]:g}"})
        return Object(index, 0, _unique(step, taken), step, self.plans[MECHANISM], (), spot, self.seen.tongue(told))

    def symbols(self) -> Iterator[Symbol]:
        """The ground, the blocks and the sense of the drives, as on the sheet."""
        window = self.composition.views[MECHANISM]
        for item in Linkage(self.seen.drawing.scene, window).items():
            cuts = clip.clipped(item, window.rect) if item.layer in SYMBOLS else ()
            for cut in cuts:
                if isinstance(cut, Polyline | Polygon):
                    yield Symbol(cut.layer, cut.pen, cut.spots, isinstance(cut, Polygon))
                elif isinstance(cut, Arc):
                    yield Symbol(cut.layer, cut.pen, cut.spots(), False)

    @property
    def marks(self) -> dict[Object, tuple[Object, ...]]:
        """The points on each line and arc; those on another plan are not seen there."""
        on = ((self.objects[curve], [self.objects[mark] for mark in found])
              for curve, found in self.seen.marks_on.items())
        return {curve: tuple(mark for mark in found if mark.plan is curve.plan) for curve, found in on}

    def ordered(self) -> Iterator[Object]:
        """The pose, all of it, then the steps."""
        givens = self.seen.drawing.drawn.givens
        yield from self.objects[:givens]
        yield from (point for point in self.pose.values() if point.index < 0)
        yield from self.objects[givens:]


def _unique(step: Step, taken: set[str]) -> str:
    """The letters and digits of a mark's name, else the initial of its kind and its place; never one that is taken."""
    letters = "".join(char for char in step.name if char in SAFE)
    found = letters if letters[:1].isalpha() else f"{step.op.gives[0].upper()}{step.index}"
    while found in taken:
        found += f"n{abs(step.index)}"
    return found


def _floats(value: Any) -> tuple[float, ...]:
    return tuple(float(part) for part in value)

