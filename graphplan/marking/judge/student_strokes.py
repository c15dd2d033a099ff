"""The student's own marks as strokes on the sheet of the construction, each by its verdict, with its tolerance.

Every plan of the student's sheet is laid on the same plan of ours. Verdicts are told apart by colour, by width and
dashes, and points by their shape too, so that no eye for colours is needed (colours after M. Okabe and K. Ito).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from graphplan.kernel.elementary import foot
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.numbers.floats import Floats
from graphplan.marking.files.curves import circle
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, WRONG, Judgement, Verdict
from graphplan.marking.traces import Trace
from graphplan.sheet.plates import clip
from graphplan.sheet.plates.display import Arc, Circle, Item, Polygon, Polyline, Spot
from graphplan.sheet.plates.pens import PAPER, Pen
from graphplan.sheet.plates.view import View

LAYER = "student"
BLUE, GREEN, RED, PLUM, DARK = "#0072b2", "#00785a", "#d04a00", "#8a5a7a", "#333333"
PENS: dict[str | None, Pen] = {RIGHT: Pen(0.3, BLUE), FOLLOWS: Pen(0.35, GREEN, (2.2, 0.9)), WRONG: Pen(0.7, RED)}
SPARE = Pen(0.3, PLUM, (0.3, 0.8))
ALLOWED = Pen(0.13, DARK)
WANTED = Pen(0.3, RED, (1.2, 0.8))  # where a wrong mark should be
SIZES: dict[str | None, float] = {RIGHT: 0.45, FOLLOWS: 0.6, WRONG: 1.3}  # half of a mark, in mm
REACH = 12.0  # mm of a line past the mark that it should have been, each way
CORNERS = 36  # of an ellipse
WHOLE = 0.99  # of a diameter: spots farther apart are opposite each other


@dataclass(frozen=True)
class StudentStrokes:
    """A judged drawing, as it is laid over its construction."""

    judgement: Judgement

    @property
    def views(self) -> Mapping[str, View]:
        """The windows of the plans."""
        return self.judgement.composition.views

    def items(self) -> Iterator[Item]:
        """What is spare, then the marks, wrong ones over the others, then tolerances, cut off at the panel's edge."""
        for trace in self.judgement.spare:
            if panel := self._under(trace):
                yield from self._clipped(_drawn(trace, self.spots(trace, panel), None), panel)
        for verdict in sorted(self.judgement.verdicts, key=lambda verdict: verdict.state == WRONG):
            yield from self._mark(verdict)
        for verdict in self.judgement.verdicts:
            yield from self._tolerance(verdict)

    def home(self, verdict: Verdict) -> str:
        """The plan that a step is drawn on."""
        return self.judgement.composition.plans.plan_of_step[verdict.step]

    def spots(self, trace: Trace, panel: str) -> tuple[Spot, ...]:
        """A trace on paper, where its plan is known to lie."""
        frame, window = self.judgement.frames[panel], self.views[panel]
        found = (frame.back(complex(*spot)) for spot in trace.spots)
        return tuple(window((z.real, z.imag)) for z in found)

    def at(self, verdict: Verdict) -> Spot:
        """Where on paper a verdict is to be told: at the mark, or the middle of its stroke within the panel."""
        assert verdict.trace is not None
        panel = self.home(verdict)
        spots, rect = self.spots(verdict.trace, panel), self.views[panel].rect
        inside = clip.segment(rect, spots[0], spots[-1]) if verdict.trace.kind == LINE else None
        if inside:
            return clip.between(spots[0], spots[-1], sum(inside) / 2)
        x, y = spots[len(spots) // 2]
        return min(max(x, rect.left), rect.right), min(max(y, rect.bottom), rect.top)

    def _under(self, trace: Trace) -> str | None:
        """The plan that a trace lies on: the one it is said to lie on, else the first whose panel holds it."""
        if trace.panel in self.judgement.frames:
            return trace.panel
        return next((panel for panel in self.judgement.frames
                     if any(map(self.views[panel].rect.holds, self.spots(trace, panel)))), None)

    def _clipped(self, items: Iterator[Item], panel: str) -> Iterator[Item]:
        rect = self.views[panel].rect
        for item in items:  # what is left whole is there if it lies on the panel
            if not isinstance(item, Circle) or rect.holds(item.centre):
                yield from clip.clipped(item, rect)

    def _mark(self, verdict: Verdict) -> Iterator[Item]:
        """What was drawn, and where it should be if it is wrong."""
        panel = self.home(verdict)
        if verdict.trace is None or panel not in self.judgement.frames:
            return
        if verdict.state == WRONG:
            yield from self._clipped(self._wanted(verdict, panel), panel)
        yield from self._clipped(_drawn(verdict.trace, self.spots(verdict.trace, panel), verdict.state, verdict.step),
                                 panel)

    def _wanted(self, verdict: Verdict, panel: str) -> Iterator[Item]:
        """Where a wrong mark should be, after the student's own earlier ones."""
        assert verdict.trace is not None
        window, here = self.views[panel], self.at(verdict)
        if not all(map(math.isfinite, verdict.own)):
            return
        if verdict.trace.kind == POINT:
            there = window((verdict.own[0], verdict.own[1]))
            yield Polyline(WANTED, LAYER, verdict.step, (here, there))
        elif verdict.trace.kind == LINE:
            a, b, _ = verdict.own
            at = [(here[i] - window.origin[i]) / window.scale for i in (0, 1)]
            (x, y), size = window(foot(Floats(), verdict.own, at)), math.hypot(a, b)
            long = max(REACH, math.dist(*self.spots(verdict.trace, panel)[:2]) / 2) / size
            yield Polyline(WANTED, LAYER, verdict.step, ((x - long * b, y + long * a), (x + long * b, y - long * a)))
        else:
            x, y, r2 = verdict.own
            centre, radius = window((x, y)), math.sqrt(max(r2, 0.0)) * window.scale
            middle = _angle(centre, here)
            wide = math.degrees(REACH / radius) if radius > REACH / math.pi else 180.0
            yield Arc(WANTED, LAYER, verdict.step, centre, radius, middle - wide, middle + wide)

    def _tolerance(self, verdict: Verdict) -> Iterator[Item]:
        """The ellipse about where a point should be; it is as much larger as our sheet is than the student's.

        A mark that goes on rightly from where a wrong one should have been has none of its own.
        """
        panel, ellipse, trace = self.home(verdict), verdict.ellipse, verdict.trace
        if ellipse is None or trace is None or panel not in self.judgement.frames:
            return
        window = self.views[panel]
        grown = window.scale / abs(self.judgement.frames[panel].unit)
        x, y = window((verdict.own[0], verdict.own[1]))
        off = math.dist((x, y), self.spots(trace, panel)[0])
        if not math.isfinite(off) or (verdict.state != WRONG and off > grown * ellipse.major):
            return
        turn = complex(math.cos(math.radians(ellipse.angle)), math.sin(math.radians(ellipse.angle)))
        around = [math.tau * i / CORNERS for i in range(CORNERS)]
        rim = [turn * grown * complex(ellipse.major * math.cos(t), ellipse.minor * math.sin(t)) for t in around]
        spots = tuple((x + z.real, y + z.imag) for z in rim)
        yield from self._clipped(iter([Polygon(ALLOWED, LAYER, verdict.step, spots)]), panel)


def sample(state: str | None, spot: Spot) -> Iterator[Item]:
    """How marks of a verdict look, for a legend: a stroke with a point on it; what is spare without a verdict."""
    x, y = spot
    yield Polyline(PENS.get(state, SPARE), LAYER, None, ((x - 4.0, y), (x + 4.0, y)))
    yield from _point(spot, state, None)


def _drawn(trace: Trace, spots: Sequence[Spot], state: str | None, step: int | None = None) -> Iterator[Item]:
    """A trace as it was drawn: a point by its shape, a stroke from end to end, an arc as far as it goes."""
    if trace.kind == POINT:
        yield from _point(spots[0], state, step)
    elif trace.kind == CIRCLE:
        yield _arc(spots, PENS.get(state, SPARE), step)
    else:
        yield Polyline(PENS.get(state, SPARE), LAYER, step, tuple(spots[:2]))


def _point(spot: Spot, state: str | None, step: int | None) -> Iterator[Item]:
    """A ring, a square if it is right after a slip, a cross if it is wrong."""
    (x, y), pen, size = spot, PENS.get(state, SPARE), SIZES.get(state, 0.6)
    firm = Pen(min(pen.width, 0.5), pen.colour, fill=PAPER)
    corners = (x - size, y - size), (x + size, y - size), (x + size, y + size), (x - size, y + size)
    if state == WRONG:
        yield Polyline(firm.filled("none"), LAYER, step, (corners[0], corners[2]))
        yield Polyline(firm.filled("none"), LAYER, step, (corners[1], corners[3]))
    elif state == FOLLOWS:
        yield Polygon(firm, LAYER, step, corners)
    else:
        yield Circle(firm, LAYER, step, spot, size)


def _arc(spots: Sequence[Spot], pen: Pen, step: int | None) -> Item:
    """The arc through the first, the middle and the last spot; a whole circle where the four are a quarter apart."""
    first, middle, last = spots[0], spots[len(spots) // 2], spots[-1]
    found = circle(first, middle, last)
    if found is None:
        return Polyline(pen, LAYER, step, tuple(spots))
    centre, radius = found
    across = [math.dist(spots[i], spots[i + 2]) for i in (0, 1)] if len(spots) == 4 else [0.0]
    if min(across) > WHOLE * 2 * radius:
        return Arc(pen, LAYER, step, centre, radius, 0.0, 360.0)
    start, between, end = (_angle(centre, spot) for spot in (first, middle, last))
    if (between - start) % 360.0 > (end - start) % 360.0:
        start, end = end, start
    return Arc(pen, LAYER, step, centre, radius, start, start + (end - start) % 360.0)


def _angle(centre: Spot, spot: Spot) -> float:
    return math.degrees(math.atan2(spot[1] - centre[1], spot[0] - centre[0]))
