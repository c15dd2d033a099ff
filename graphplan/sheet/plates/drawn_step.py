"""What is drawn of a step: where it lies on the page, and its strokes and arcs as far as they are drawn.

Strokes and arcs are told by their marks. So the sheet knows where they lie, in mm of the page with x to the right and y
up, and what keeps a construction alive can move them with the marks.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property

from graphplan.kernel.kinds import LINE, OPENING, POINT
from graphplan.kernel.program import Panel, Step
from graphplan.methods.construction import DrawnVector
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Item, Polyline, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.view import View

LAYER = "construction"
ON_LINE_MM = 0.1  # off a stroke, up to which a mark lies along it


@dataclass(frozen=True, eq=False)
class DrawnStep:
    """A drawn step, or a point of the pose that no step reads: what it makes, from which others, on which plan.

    `number` is 0 for the pose, `index` negative where no step reads it; `value` has the shape of its kind
    (kernel/kinds.py), in the units of its plan; all else is in mm of the page.
    """

    step: Step
    number: int
    panel: Panel
    view: View
    args: tuple[DrawnStep, ...] = field(repr=False)
    value: tuple[float, ...]
    say: Callable[[], str] = field(repr=False)

    @property
    def sentence(self) -> str:
        """How it is spoken of; not put in words before somebody asks."""
        return self.say()

    @property
    def index(self) -> int:
        return self.step.index

    @property
    def name(self) -> str:
        """The letter as in the program, or nothing."""
        return self.step.name

    @property
    def kind(self) -> str:
        """The kind of mark."""
        return self.step.op.gives

    @cached_property
    def spot(self) -> Spot:
        """Where a point lies, or a circle's centre."""
        return self.view((self.value[0], self.value[1]))

    @property
    def radius(self) -> float:
        """The radius of a circle or an opening, mm."""
        return math.sqrt(max(self.value[-1], 0.0)) * self.view.scale

    @property
    def line(self) -> tuple[float, float, float]:
        """A line by its equation a x + b y + c = 0, running along (b, -a)."""
        a, b, c = self.value
        return a, b, c * self.view.scale - a * self.view.origin[0] - b * self.view.origin[1]

    @property
    def direction(self) -> Spot:
        """The direction of a line, as a vector 1 mm long."""
        a, b, _ = self.value
        length = math.hypot(a, b) or 1.0
        return b / length, -a / length

    def paper(self, height: float) -> tuple[float, ...]:
        """Its place in mm of a page so high, from the upper left corner, y down: a point x, y; a line a, b, c with
        a x + b y + c = 0, (a, b) one mm long; an opening its length; a circle x, y of its centre and its radius."""
        if self.kind == OPENING:
            return (self.radius,)
        if self.kind == LINE:
            (a, b, c), (u, v) = self.line, self.direction
            return v + 0.0, u + 0.0, -(c + b * height) / math.hypot(a, b)  # and no -0
        x, y = self.spot
        return (x, height - y) if self.kind == POINT else (x, height - y, self.radius)

    @property
    def free(self) -> bool:
        """Whether it is chosen freely: a point of the pose, or the beginning of a plan."""
        return self.step.op.free

    @property
    def root(self) -> DrawnStep | None:
        """The mark that a point is laid off from, if it is: a stroke joins the two."""
        return None if self.step.op.root is None else self.args[self.step.op.root]

    def factor(self, other: DrawnStep) -> float:
        """How many mm here are one mm on the plan of another: by it a length is carried over."""
        return self.view.scale / other.view.scale


@dataclass(frozen=True)
class Stroke:
    """A straight stroke, or a vector where it has a head, from `low` to `high` on the way from one mark to another.

    They are parts of that way; where the marks do not tell it they are mm the way that the line runs, `in_mm`.
    """

    of: DrawnStep
    start: DrawnStep
    end: DrawnStep
    low: float = 0.0
    high: float = 1.0
    pen: Pen = pens.THIN
    in_mm: bool = False
    head: float = 0.0
    layer: str = LAYER
    vector: DrawnVector | None = None

    @cached_property
    def ends(self) -> tuple[Spot, Spot]:
        """Where it begins and ends."""
        (x, y), (u, v) = self.start.spot, self.end.spot
        dx, dy = self.of.direction if self.in_mm else (u - x, v - y)
        return (x + self.low * dx, y + self.low * dy), (x + self.high * dx, y + self.high * dy)

    def fractions_along(self, spots: Iterable[Spot]) -> list[float]:
        """How far along it, in its lengths, those of some spots are that lie on its line."""
        (start, end), long = self.ends, self.length
        ux, uy = (end[0] - start[0]) / long, (end[1] - start[1]) / long
        arms = [(x - start[0], y - start[1]) for x, y in spots]
        return [(x * ux + y * uy) / long for x, y in arms if abs(x * uy - y * ux) < ON_LINE_MM]

    @property
    def kind(self) -> str:
        """The kind of vector, if it is one that is asked for."""
        return self.vector.kind if self.vector else ""

    @property
    def letter(self) -> str:
        """The letter of a vector, if it has one that its end does not bear: v_A of the mechanism plan ends in v_a."""
        label = self.vector.label if self.vector else ""
        return "" if label.lower() == self.end.name.lower() else label

    @property
    def name(self) -> str:
        """The name of a vector that is asked for, such as `velocity A`."""
        return f"{self.kind} {self.vector.point}" if self.vector else ""

    @cached_property
    def length(self) -> float:
        return math.dist(*self.ends)

    def sub_stroke(self, low: float, high: float) -> Stroke:
        """A part of it, by fractions of its length."""
        long = self.high - self.low
        return replace(self, low=self.low + low * long, high=self.low + high * long)

    @property
    def item(self) -> Item:
        """The stroke as it lies."""
        if not self.head:
            return Polyline(self.pen, self.layer, self.of.index, self.ends)
        return Arrow(self.pen, self.layer, self.of.index, *self.ends, self.head, self.name)


@dataclass(frozen=True)
class StruckArc:
    """An arc of a circle: so many degrees before and after the ray from its centre to a mark on it."""

    of: DrawnStep
    mark: DrawnStep
    before: float
    after: float
    pen: Pen = pens.ARC

    @property
    def half(self) -> bool:
        """Whether it is the half circle over a diameter."""
        return self.before == 0.0 or self.after == 0.0

    @property
    def item(self) -> Arc:
        """The arc as it lies."""
        (x, y), (u, v) = self.of.spot, self.mark.spot
        middle = math.degrees(math.atan2(v - y, u - x))
        return Arc(self.pen, LAYER, self.of.index, self.of.spot, self.of.radius, middle - self.before,
                   middle + self.after)  # fmt: skip
