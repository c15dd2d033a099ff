"""The overlay: a student's drawing over the true one on the sheet of the construction, and what there is to say of it.

Every plan of the student's sheet is laid on the same plan of ours. Verdicts are told apart by colour, by width and
dashes, and points by their shape too, so that no eye for colours is needed (colours after M. Okabe and K. Ito).
What is wrong first stands in a box, where it covers least of its plan, with a leader to its mark.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely
from shapely import Geometry, LineString, Point, STRtree

from graphplan.kernel.elementary import foot
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.numbers import Floats
from graphplan.marking.files.drawing import circle_through
from graphplan.marking.judge.findings import VERDICT_TITLE, LegendRow, Remarks, complaint, opinion, step_name
from graphplan.marking.judge.score import Score
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, UNCLEAR, WRONG, Judgement, Verdict
from graphplan.marking.traces import Trace
from graphplan.sheet.frames.frame import BORDER
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.layout.layout import layout, title_items
from graphplan.sheet.layout.paper import paginate_tightly
from graphplan.sheet.lettering.label_candidates import Array, Wish
from graphplan.sheet.lettering.lettering import CAPS, SIZE, TextRun, sentence_runs, width, wrap
from graphplan.sheet.lettering.letters import place_letters
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Sheet, Spot, Text, lies_in
from graphplan.sheet.plates.pens import LETTERS, PAPER, Pen
from graphplan.sheet.plates.plate import DrawnStep
from graphplan.sheet.plates.symbols import offset, unit_vector
from graphplan.sheet.plates.view import View, clip_item, clip_segment, interpolate
from graphplan.sheet.words.rows import LEADING, Placed, row_items
from graphplan.sheet.words.texts import RESULTS

LAYER = "student"
BLUE, GREEN, RED, GOLD, PLUM, DARK = "#0072b2", "#00785a", "#d04a00", "#8f6a00", "#8a5a7a", "#333333"
PENS: dict[str | None, Pen] = {RIGHT: Pen(0.3, BLUE), FOLLOWS: Pen(0.35, GREEN, (2.2, 0.9)), WRONG: Pen(0.7, RED),
                               UNCLEAR: Pen(0.5, GOLD, (0.8, 0.8))}
SPARE_PEN = Pen(0.3, PLUM, (0.3, 0.8))
TOLERANCE_PEN = Pen(0.13, DARK)
WANTED_PEN = Pen(0.3, RED, (1.2, 0.8))  # where a wrong mark should be
HALF_SIZES_MM: dict[str | None, float] = {RIGHT: 0.45, FOLLOWS: 0.6, WRONG: 1.3, UNCLEAR: 3.2}  # half of a mark, in mm
WANTED_LINE_MM = 12.0  # mm of a line past the mark that it should have been, each way
ELLIPSE_CORNERS = 36  # of an ellipse
DIAMETER_SHARE = 0.99  # of a diameter: spots farther apart are opposite each other
FAINT_COLOUR, LETTER_COLOUR, TINT_COLOUR = "#a6a6a6", "#7a7a7a", "#efefef"
MAX_TRUE_WIDTH_MM = 0.18  # mm: the widest stroke of the true drawing
OUTER_LAYERS = ("paper", BORDER, "text")  # the layers of what is not on a plan
SAMPLE_LIFT_MM = 1.2  # mm from the base line of the legend's words up to its samples
CALLOUT_PEN = Pen(0.35, RED)
# mm: of the lettering; about it in its box; between the places that are tried
MAX_WORDS_MM, BOX_PAD_MM, BOX_PITCH_MM = 62.0, 1.5, 2.0
MIN_BOX_GAP_MM, PRICE_PER_MM = 6.0, 0.25  # mm between the box and its mark; the price of every further one
CALLOUT_RING_MM = 2.4  # mm about the mark


def overlay(judgement: Judgement, score: Score) -> list[Sheet]:
    """The sheet with both drawings and the remarks, and pages of further remarks where there are very many."""
    composition = judgement.composition
    arrangement, tongue = composition.arrangement, composition.plans.tongue
    solution = layout(composition)
    apart = (*arrangement.columns, arrangement.title)
    around = [item for item in solution.items if item.layer in OUTER_LAYERS and not lies_in(item, apart)]
    empty = [item for item in around if not lies_in(item, arrangement.panels.values())]
    over = [faint_item(item) for item in solution.items if item.layer not in (*OUTER_LAYERS, RESULTS, *FACTS)]
    student = StudentStrokes(judgement)
    over += student.items()
    over += [item for panel, view in composition.views.items()
             for item in plan_remarks(student, panel, view.rect, over)]
    words = arrangement.set(lambda wide: Remarks(composition.plans).lines(wide, judgement, score))
    about, pages = replace(solution, description=tongue(opinion(judgement))), paginate_tightly(words, arrangement)
    sheets = []
    for number, page in enumerate(pages, 1):
        block = title_items(composition, VERDICT_TITLE, number, len(pages))
        items = [*(around + over if number == 1 else empty), *block, *_remarks(page)]
        sheets.append(replace(about, items=tuple(items), panels=solution.panels if number == 1 else {}))
    return sheets


def faint_item(item: Item) -> Item:
    """An item of the true drawing: thin and grey."""
    pen = item.pen
    if isinstance(item, Text):
        return replace(item, pen=Pen(0.0, LETTER_COLOUR, fill=LETTER_COLOUR))
    fill = pen.fill if pen.fill in ("none", PAPER) else FAINT_COLOUR if pen.width else TINT_COLOUR
    return replace(item, pen=Pen(min(pen.width, MAX_TRUE_WIDTH_MM), FAINT_COLOUR, pen.dash, fill))


def plan_remarks(student: StudentStrokes, panel: str, rect: Rect, items: Sequence[Item]) -> Iterator[Item]:
    """On one plan, in its rectangle: the first wrong step called out, the others by their numbers."""
    judgement, obstacles = student.judgement, list(items)
    program = judgement.drawing.drawn
    letters = judgement.composition.arrangement.letters
    wrong = [(verdict, student.verdict_spot(verdict)) for verdict in judgement.verdicts
             if verdict.state == WRONG and student.panel(verdict) == panel]
    for verdict, at in wrong:
        if verdict is judgement.first_wrong:
            names = tuple(step.name for step in program.steps if step.name)
            sentence = judgement.composition.plans.tongue(complaint(judgement, verdict))
            obstacles += (boxed := [*callout(sentence, names, at, obstacles, rect, CALLOUT_PEN, letters.text)])
            yield from boxed
    wishes = [Wish((TextRun(step_name(program, verdict.at_fault).short),), (at,), HALF_SIZES_MM[WRONG], True,
                   Pen(0.0, RED, fill=RED),
                   bold=True) for verdict, at in wrong if verdict is not judgement.first_wrong]
    yield from place_letters(wishes, obstacles, [at for _, at in wrong], rect, letters)


def _remarks(page: Sequence[Placed]) -> Iterator[Item]:
    """Rows as items, those of the legend with their samples."""
    for row, x, y in page:
        yield from row_items([(row, x, y)])
        if isinstance(row, LegendRow):
            yield from legend_sample(row.state, (x + row.cells[0].x / 2 - 0.5, y + SAMPLE_LIFT_MM - 0.3))


def callout(sentence: str, names: tuple[str, ...], spot: Spot, items: Sequence[Item], rect: Rect,
            pen: Pen, size: float = SIZE) -> Iterator[Item]:
    """The box with its leader, in letters of a size; `items` are what it should not cover."""
    box, words = boxed_words(sentence, names, spot, items, rect, pen, size)
    nearest = min(max(spot[0], box.left), box.right), min(max(spot[1], box.bottom), box.top)
    leader = offset(spot, unit_vector(spot, nearest), CALLOUT_RING_MM)
    yield Circle(pen.with_fill("none"), LAYER, None, spot, CALLOUT_RING_MM)
    yield Polyline(pen, LAYER, None, (leader, nearest))
    yield from words


def boxed_words(sentence: str, names: tuple[str, ...], spot: Spot, items: Sequence[Item], rect: Rect,
                pen: Pen, size: float = SIZE) -> tuple[Rect, list[Item]]:
    """A box near a spot, and the box with its words."""
    room = min(MAX_WORDS_MM, rect.width - 4 * BOX_PAD_MM)
    lines = wrap(sentence_runs(sentence, names), size, room)
    wide = max(width(line, size) for line in lines) + 2 * BOX_PAD_MM
    high = size * (CAPS + LEADING * (len(lines) - 1)) + 2 * BOX_PAD_MM
    box = _box(wide, high, spot, items, rect)
    words = (Text(LETTERS, LAYER, None, (box.left + BOX_PAD_MM, box.top - BOX_PAD_MM - size * (CAPS + LEADING * i)),
                  runs, size)
             for i, runs in enumerate(lines))
    return box, [Polygon(pen.with_fill(PAPER), LAYER, None, box.corners), *words]


def _box(wide: float, high: float, spot: Spot, items: Sequence[Item], rect: Rect) -> Rect:
    """The cheapest of many places on the panel: the fewer strokes and letters it covers, and the nearer, the better."""
    boxes = _grid(wide, high, rect)
    gaps = np.hypot(*np.maximum(np.maximum(boxes[:, :2] - spot, spot - boxes[:, 2:]), 0.0).T)
    if (gaps >= MIN_BOX_GAP_MM).any():
        boxes, gaps = boxes[gaps >= MIN_BOX_GAP_MM], gaps[gaps >= MIN_BOX_GAP_MM]
    touched, _ = STRtree([_ink_outline(item) for item in items]).query(shapely.box(*boxes.T), "intersects")
    cost = np.bincount(touched, minlength=len(boxes)) + PRICE_PER_MM * gaps
    left, bottom, right, top = map(float, boxes[int(np.argmin(cost))])
    return Rect(left, bottom, right, top)


def _grid(wide: float, high: float, rect: Rect) -> Array:
    """Boxes of this size all over a panel; one, at its corner, where it is hardly larger."""
    lefts = np.arange(rect.left + BOX_PAD_MM,
                      max(rect.right - BOX_PAD_MM - wide, rect.left + BOX_PAD_MM) + BOX_PITCH_MM / 2, BOX_PITCH_MM)
    lows = np.arange(rect.bottom + BOX_PAD_MM,
                     max(rect.top - BOX_PAD_MM - high, rect.bottom + BOX_PAD_MM) + BOX_PITCH_MM / 2, BOX_PITCH_MM)
    x, y = (coordinates.ravel() for coordinates in np.meshgrid(lefts, lows))
    return np.stack([x, y, x + wide, y + high], axis=1)


def _ink_outline(item: Item) -> Geometry:
    """Outline of an item's ink; of lettering its box."""
    match item:
        case Polyline(spots=spots) | Polygon(spots=spots):
            return LineString(spots)
        case Arc():
            return LineString(item.spots())
        case Arrow(start=start, end=end):
            return LineString((start, end))
        case Circle(centre=centre, radius=radius):
            return Point(centre).buffer(radius)
        case Text(box=rect):
            return shapely.box(rect.left, rect.bottom, rect.right, rect.top)
    return LineString()


@dataclass(frozen=True, eq=False)
class StudentMark:
    """A student's mark of a step on our sheet, with the `growth` that it has there: its spots, and the step as it
    should be after the student's own earlier marks."""

    verdict: Verdict
    trace: Trace
    spots: tuple[Spot, ...]
    expected_step: DrawnStep
    growth: float

    @property
    def label_spot(self) -> Spot:
        """Place of a verdict's label on paper: at the mark, or the middle of its stroke within the panel."""
        spots, rect = self.spots, self.expected_step.view.rect
        inside = clip_segment(rect, spots[0], spots[-1]) if self.trace.kind == LINE else None
        if inside:
            return interpolate(spots[0], spots[-1], sum(inside) / 2)
        x, y = spots[len(spots) // 2]
        return min(max(x, rect.left), rect.right), min(max(y, rect.bottom), rect.top)

    def items(self) -> Iterator[Item]:
        """Yield the drawn mark, over its right place if it is wrong."""
        if self.verdict.state == WRONG and all(map(math.isfinite, self.expected_step.value)):
            yield self._wanted_item()
        yield from _trace_items(self.trace, self.spots, self.verdict.state, self.verdict.step)

    def _wanted_item(self) -> Item:
        """Right place of a wrong mark."""
        step, wanted, spot = self.verdict.step, self.expected_step, self.label_spot
        if wanted.kind == POINT:
            return Polyline(WANTED_PEN, LAYER, step, (spot, wanted.spot))
        if wanted.kind == LINE:
            at, long = foot(Floats(), wanted.line, spot), max(WANTED_LINE_MM, math.dist(*self.spots[:2]) / 2)
            return Polyline(WANTED_PEN, LAYER, step,
                            (offset(at, wanted.direction, -long), offset(at, wanted.direction, long)))
        middle = _angle(wanted.spot, spot)
        wide = math.degrees(WANTED_LINE_MM / wanted.radius) if wanted.radius > WANTED_LINE_MM / math.pi else 180.0
        return Arc(WANTED_PEN, LAYER, step, wanted.spot, wanted.radius, middle - wide, middle + wide)

    def tolerance(self) -> Iterator[Item]:
        """The ellipse about where a point should be; it is as much larger as our sheet is than the student's.

        A mark that goes on rightly from where a wrong one should have been has none of its own.
        """
        ellipse, grown = self.verdict.ellipse, self.growth
        far = math.dist(self.expected_step.spot, self.spots[0]) if ellipse else math.inf
        if not ellipse or not math.isfinite(far) or (self.verdict.state != WRONG and far > grown * ellipse.major):
            return
        angle = math.radians(ellipse.angle)
        direction = math.cos(angle), math.sin(angle)
        around = [math.tau * i / ELLIPSE_CORNERS for i in range(ELLIPSE_CORNERS)]
        spots = [offset(self.expected_step.spot, direction, grown * ellipse.major * math.cos(t),
                        grown * ellipse.minor * math.sin(t))
                 for t in around]
        yield Polygon(TOLERANCE_PEN, LAYER, self.verdict.step, tuple(spots))


@dataclass(frozen=True)
class StudentStrokes:
    """A judged drawing, as it is laid over its construction."""

    judgement: Judgement

    @cached_property
    def marks(self) -> list[StudentMark]:
        """The student's marks of the steps that can be seen."""
        frames, marks = self.judgement.frames, []
        for verdict, step in zip(self.judgement.verdicts, self.judgement.composition.plates.steps, strict=True):
            if verdict.trace and step.panel in frames:
                marks.append(StudentMark(
                    verdict, verdict.trace, self.spots(verdict.trace, step.panel),
                    replace(step, value=verdict.expected),
                    step.view.scale / abs(frames[step.panel].unit)))
        return marks

    def items(self) -> Iterator[Item]:
        """Yield the spare marks, then the marks, wrong ones over the others, then tolerances, cut off at the panel's
        edge."""
        for trace in self.judgement.spare:
            if panel := self._panel_of(trace):
                spare = _trace_items(trace, self.spots(trace, panel), None)
                yield from _clip_items(spare, self.judgement.composition.views[panel])
        for mark in sorted(self.marks, key=lambda mark: mark.verdict.state == WRONG):
            yield from _clip_items(mark.items(), mark.expected_step.view)
        for mark in self.marks:
            yield from _clip_items(mark.tolerance(), mark.expected_step.view)
        for verdict in self.judgement.verdicts:
            if verdict.state == UNCLEAR and verdict.trace is None:
                yield from _point_items(self.expected_spot(verdict), UNCLEAR, verdict.step)

    def panel(self, verdict: Verdict) -> str:
        """The plan of a step."""
        return self.judgement.composition.plates.steps[verdict.step].panel

    def verdict_spot(self, verdict: Verdict) -> Spot:
        """Place of a verdict on paper: at the mark, or at its right place."""
        return next((mark.label_spot for mark in self.marks if mark.verdict is verdict),
                    None) or self.expected_spot(verdict)

    def expected_spot(self, verdict: Verdict) -> Spot:
        """Right place of an invisible mark: a point, or the middle of the marks on a line or an arc, or the foot on it
        from the middle of its panel; an opening is anywhere."""
        plates = self.judgement.composition.plates
        expected_step = replace(plates.steps[verdict.step], value=verdict.expected)
        rect = expected_step.view.rect
        on = ([expected_step.spot] if expected_step.kind == POINT
              else [mark.spot for mark in plates[expected_step.panel].marks(expected_step)])
        middle = (rect.left + rect.right) / 2, (rect.bottom + rect.top) / 2
        if not on:
            on = [foot(Floats(), expected_step.line, middle) if expected_step.kind == LINE else
                  expected_step.spot if expected_step.kind == CIRCLE else middle]
        x, y = np.mean(on, axis=0)
        return min(max(float(x), rect.left), rect.right), min(max(float(y), rect.bottom), rect.top)

    def spots(self, trace: Trace, panel: str) -> tuple[Spot, ...]:
        """A trace on paper, where its plan is known to lie."""
        frame, window = self.judgement.frames[panel], self.judgement.composition.views[panel]
        plan_points = (frame.to_plan(complex(*spot)) for spot in trace.spots)
        return tuple(window((z.real, z.imag)) for z in plan_points)

    def _panel_of(self, trace: Trace) -> str | None:
        """The plan that a trace lies on: the one it is said to lie on, else the first whose panel holds it."""
        if trace.panel in self.judgement.frames:
            return trace.panel
        views = self.judgement.composition.views
        return next((panel for panel in self.judgement.frames
                     if any(map(views[panel].rect.holds, self.spots(trace, panel)))), None)


def _clip_items(items: Iterable[Item], view: View) -> Iterator[Item]:
    """Yield the parts of items on a panel; a circle if its centre is inside."""
    for item in items:
        if not isinstance(item, Circle) or view.rect.holds(item.centre):
            yield from clip_item(item, view.rect)


def legend_sample(state: str | None, spot: Spot) -> Iterator[Item]:
    """Sample of a verdict's marks, for a legend: a stroke with a point on it; without a verdict that of spare marks."""
    x, y = spot
    yield Polyline(PENS.get(state, SPARE_PEN), LAYER, None, ((x - 4.0, y), (x + 4.0, y)))
    if state == UNCLEAR:  # its ring is wider than a row is high
        yield Circle(PENS[UNCLEAR].with_fill("none"), LAYER, None, spot, HALF_SIZES_MM[WRONG])
    else:
        yield from _point_items(spot, state, None)


def _trace_items(trace: Trace, spots: Sequence[Spot], state: str | None, step: int | None = None) -> Iterator[Item]:
    """A trace as it was drawn: a point by its shape, a stroke from end to end, an arc as far as it goes."""
    if trace.kind == POINT:
        yield from _point_items(spots[0], state, step)
    elif trace.kind == CIRCLE:
        yield _arc(spots, PENS.get(state, SPARE_PEN), step)
    else:
        yield Polyline(PENS.get(state, SPARE_PEN), LAYER, step, tuple(spots[:2]))


def _point_items(spot: Spot, state: str | None, step: int | None) -> Iterator[Item]:
    """A ring; a square if it is right after a mistake, a cross if it is wrong; a wide ring where it cannot be told."""
    (x, y), pen, half_size = spot, PENS.get(state, SPARE_PEN), HALF_SIZES_MM.get(state, 0.6)
    firm = Pen(min(pen.width, 0.5), pen.colour, fill=PAPER)
    corners = Rect(x - half_size, y - half_size, x + half_size, y + half_size).corners
    if state == WRONG:
        yield from (Polyline(firm.with_fill("none"), LAYER, step, ends) for ends in (corners[::2], corners[1::2]))
    elif state == FOLLOWS:
        yield Polygon(firm, LAYER, step, corners)
    elif state == UNCLEAR:
        yield Circle(pen.with_fill("none"), LAYER, step, spot, half_size)
    else:
        yield Circle(firm, LAYER, step, spot, half_size)


def _arc(spots: Sequence[Spot], pen: Pen, step: int | None) -> Item:
    """The arc through the first, the middle and the last spot; a whole circle where the four are a quarter apart."""
    first, middle, last = spots[0], spots[len(spots) // 2], spots[-1]
    arc_circle = circle_through(first, middle, last)
    if arc_circle is None:
        return Polyline(pen, LAYER, step, tuple(spots))
    centre, radius = arc_circle
    across = [math.dist(spots[i], spots[i + 2]) for i in (0, 1)] if len(spots) == 4 else [0.0]
    if min(across) > DIAMETER_SHARE * 2 * radius:
        return Arc(pen, LAYER, step, centre, radius, 0.0, 360.0)
    start, between, end = (_angle(centre, spot) for spot in (first, middle, last))
    if (between - start) % 360.0 > (end - start) % 360.0:
        start, end = end, start
    return Arc(pen, LAYER, step, centre, radius, start, start + (end - start) % 360.0)


def _angle(centre: Spot, spot: Spot) -> float:
    return math.degrees(math.atan2(spot[1] - centre[1], spot[0] - centre[0]))
