"""One walk over what is drawn, for targets that keep the construction alive: every mark from those that it depends on.

Every plan stands where it stands on the sheet; strokes, arcs, dots and letters depend on marks.
"""

from __future__ import annotations

import math
import string
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import NamedTuple

from graphplan.kernel.kinds import LINE, Movement
from graphplan.mechanism.model import FRAME
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.lettering.letters import letter_plates
from graphplan.sheet.plates import pens, symbols
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import Figure, FixedGuide, Rail
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import DrawnStep, Plate, Plates, Stroke, StruckArc

SAFE = string.ascii_letters + string.digits
REACH = 20.0  # mm: how far apart the two ends of a line stand that no two marks give


def identifiers(drawn: Iterable[DrawnStep]) -> dict[DrawnStep, str]:
    """For every mark the letters and digits of its name, else the initial of its kind and its place; each but once."""
    names: dict[DrawnStep, str] = {}
    taken: set[str] = set()
    for mark in drawn:
        letters = "".join(char for char in mark.name if char in SAFE)
        name = letters if letters[:1].isalpha() else f"{mark.kind[0].upper()}{mark.index}"
        while name in taken:
            name += f"n{abs(mark.index)}"
        names[mark] = name
        taken.add(name)
    return names


def heading(line: DrawnStep) -> Spot:
    """Vector between the ends of a line, in mm: of its own two points, or of the line that it follows."""
    movement, args = line.step.op.movement, line.args
    if movement in (Movement.RULED, Movement.BISECTED):
        (x, y), (u, v) = args[0].spot, args[1].spot
        return (u - x, v - y) if movement is Movement.RULED else (y - v, u - x)
    if movement in (Movement.PARALLEL, Movement.PERPENDICULAR):
        dx, dy = heading(args[0])
        return (dx, dy) if movement is Movement.PARALLEL else (-dy, dx)
    return REACH * line.direction[0], REACH * line.direction[1]


def parameters(drawn: DrawnStep) -> dict[str, float]:
    """The numbers of a command: what is given, in mm, and {k}, by which lengths from another plan are multiplied."""
    params, afar = drawn.step.params, drawn.step.op.afar
    factor = drawn.factor(drawn.args[afar[0][0]]) if afar else 1.0
    lengths = {name: drawn.view.scale * float(params[name]) for name in params if name in ("dx", "dy")}
    return {**lengths, "k": factor * float(params.get("ratio", 1))}


def turned_back(drawn: DrawnStep) -> bool:
    """Whether of two crossings that to the right or back is meant."""
    return "right" in drawn.step.params.values() or "back" in drawn.step.params.values()


class Riding(NamedTuple):
    """On which points a part of the mechanism rides, each of its spots on the nearest one; it turns with the link.

    Without a link it does not turn, without a point it stays.
    """

    points: tuple[str, ...] = ()
    link: str = ""


def _riding(part: Figure | FixedGuide | Rail) -> Riding:
    """The object that carries a part of the mechanism."""
    slide = part.slide
    link = "" if slide is None else slide.link if slide.link != FRAME else slide.along
    if isinstance(part, Figure):
        return Riding(part.at, part.link or link)
    if isinstance(part, Rail):
        return Riding((part.seat, part.end), link)
    return Riding() if part.slide.along == FRAME else Riding((part.seat,), link)


class Letter:
    """Lettering that stands off a mark: the middle of its base line so many mm from it, right and up.

    `leader` is the stroke that ties it to where it belongs, `ringed` the middle of the circle that it stands in.
    """

    def __init__(self, mark: DrawnStep, text: Text, *before: Item):
        self.mark, self.text = mark, text
        self.off = self._from_mark((text.box.centre[0], text.at[1]))
        self.leader = [self._from_mark(spot) for item in before if isinstance(item, Polyline) for spot in item.spots]
        self.ringed = next((self._from_mark(item.centre) for item in before if isinstance(item, Circle)), None)

    @classmethod
    def above_right(cls, mark: DrawnStep) -> Letter:
        """A mark's own name above its right, if the sheet has no letter for it."""
        at = mark.spot[0] + 1.0, mark.spot[1] + 1.0
        return cls(mark, Text(pens.LETTERS, "letters", None, at, sentence_runs(mark.name), 2.5))

    def spot_off(self, off: Spot) -> Spot:
        """The spot so far off its mark."""
        return self.mark.spot[0] + off[0], self.mark.spot[1] + off[1]

    def _from_mark(self, spot: Spot) -> Spot:
        return spot[0] - self.mark.spot[0], spot[1] - self.mark.spot[1]


class Walk:
    """Walks over one construction."""

    def __init__(self, plates: Plates):
        self.plates, self.say = plates, plates.plans.tongue
        self.title, self.source = plates.scene.title, plates.scene.source
        self.names = self.mark_names()
        self.joints: Mapping[Spot, DrawnStep] = {point.spot: point for point in reversed(plates.pose.values())}
        self.lines: list[str] = []

    def mark_names(self) -> Mapping[DrawnStep, str]:
        """Names of the marks in the target."""
        return identifiers(self.plates.all_marks)

    # ---- the mechanism and the letters -----------------------------------------------------------------------------

    def riding(self, plate: Plate, ways: Mapping[str, Spot]) -> Iterator[tuple[Item, Riding]]:
        """Yield the items of the mechanism on its plan, whole, each with its carrier; paths of points have no carrier.

        Guides of the frame are as long as the `ways` of their slides.
        """
        if plate.panel != MECHANISM:
            return
        motion = self.plates.plans.motion
        if motion:
            yield from ((item, Riding()) for item in motion.path_items(plate.view))
            for centrode in motion.centrodes:
                riding = Riding(tuple(name for name, _ in centrode.given[:1]), centrode.on)
                yield from ((item, riding) for item in centrode.items(plate.view, self.plates.scene))
        mechanism = plate.drawn_mechanism
        for figure in mechanism.figures():
            riding = _riding(figure)
            if isinstance(figure, FixedGuide) and figure.slide.along == FRAME:
                at, along = mechanism.seat(figure.slide), mechanism.direction(figure.slide)
                items: Iterable[Item] = symbols.guideway(at, along, figure.side,
                                                         ways.get(figure.slide.name, (0.0, 0.0)))
            else:
                items = figure.items
            yield from ((item, riding) for item in items)

    def plan_items(self, plate: Plate) -> list[Item]:
        """Items of a plan on the sheet."""
        return letter_plates(self.plates)[plate.panel].items

    def letters(self, plate: Plate) -> Iterator[Letter]:
        """The letters of a plan where the sheet has them, each off the mark that it hangs on."""
        before: list[Item] = []  # its leader and its ring
        for item in self.plan_items(plate):
            if isinstance(item, Text):
                yield Letter(self._mark_of_lettering(plate, item), item, *before)
            before = [*before, item] if item.layer == "letters" and not isinstance(item, Text) else []

    def _mark_of_lettering(self, plate: Plate, text: Text) -> DrawnStep:
        """The mark that lettering hangs on: its own, its vector's end, or the next of its line or of the pose."""
        if text.step is None:
            pose = self.plates.pose
            name = text.label.partition(",")[0]
            return pose[name] if name in pose else min(pose.values(), key=lambda mark: math.dist(mark.spot, text.at))
        own_mark = self.plates.steps[text.step]
        if own_mark.kind == LINE:
            return min(plate.marks(own_mark), key=lambda mark: math.dist(mark.spot, text.at))
        ends = (vector.end for vector in plate.vectors if vector.of is own_mark and vector.letter in text.label.split())
        return next(ends, own_mark)


class Elements(Walk):
    """Writes elements that depend on each other; a stroke hangs on its marks as soon as the last of them is there."""

    part, along = "", ""  # {part} of the way from {0} to {1}; so many mm from {0} along the line {2}

    @cached_property
    def due(self) -> dict[DrawnStep, list[Stroke | StruckArc]]:
        """The strokes and arcs by the last of the marks that they hang on."""
        due_strokes: dict[DrawnStep, list[Stroke | StruckArc]] = {}
        for plate in self.plates:
            strokes = [*(stroke for drawn in plate.steps for stroke in plate.strokes(drawn)), *plate.vectors]
            arcs = (arc for drawn in plate.steps for arc in plate.arcs(drawn) if plate.is_on_panel(arc.mark))
            hung: list[tuple[Stroke | StruckArc, tuple[DrawnStep, ...]]]
            hung = [*((stroke, (stroke.of, stroke.start, stroke.end)) for stroke in strokes),
                    *((arc, (arc.of, arc.mark)) for arc in arcs)]  # fmt: skip
            for stroke_or_arc, marks in hung:
                due_strokes.setdefault(max(marks, key=lambda mark: mark.index), []).append(stroke_or_arc)
        return due_strokes

    def ends(self, stroke: Stroke) -> list[str]:
        """Start and end of a stroke: its marks, or expressions of them."""
        return [self._end(stroke, share) for share in (stroke.low, stroke.high)]

    def _end(self, stroke: Stroke, part: float) -> str:
        marks = [self.names[stroke.start], self.names[stroke.end]]
        if stroke.in_mm:
            return self.along.format(*marks, self.names[stroke.of], part=self.number(part))
        return marks[int(part)] if part in (0.0, 1.0) else self.part.format(*marks, part=self.number(part))

    def number(self, value: float) -> str:
        """A number in the target."""
        return repr(value)

    @property
    def lettered_strokes(self) -> set[Stroke]:
        """Strokes with a letter: the first stroke of each line that has one, and vectors that their ends do not
        name."""
        strokes = {stroke.of: stroke for ones in reversed(self.due.values()) for stroke in reversed(ones)
                   if isinstance(stroke, Stroke) and stroke.of.kind == LINE and stroke.of.name and not stroke.head}
        vectors = (one for ones in self.due.values() for one in ones if isinstance(one, Stroke) and one.vector)
        return {*strokes.values(), *(one for one in vectors if one.letter)}


def corners(item: Item) -> tuple[Spot, ...]:
    """The spots of an item of the mechanism: its corners, a chain along an arc, or the middle of a circle."""
    if isinstance(item, Polyline | Polygon):
        return item.spots
    return item.spots() if isinstance(item, Arc) else (item.centre,) if isinstance(item, Circle) else ()


def extent(items: Iterable[Item]) -> Rect:
    """The box about some items, with a margin of a millimetre; at the origin without items."""
    spots: list[Spot] = []
    for item in items:
        match item:
            case Text():
                spots += item.box.corners
            case Arrow():
                spots += [item.start, item.end]
            case Circle(centre=(x, y), radius=r):
                spots += [(x - r, y - r), (x + r, y + r)]
            case _:
                spots += corners(item)
    return bounding_box(spots or [(0.0, 0.0)]).inset(-1.0, -1.0, -1.0, -1.0)
