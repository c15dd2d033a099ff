"""The overlay: a student's drawing over the true one on the sheet of the construction, and what there is to say of it.

What is wrong first stands in a box, where it covers least of its plan, with a leader to its mark.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import shapely
from shapely import Geometry, LineString, Point, STRtree

from graphplan.marking.judge.findings import called, complaint, opinion
from graphplan.marking.judge.remarks import VERDICT, LegendRow, Remarks
from graphplan.marking.judge.score import Score
from graphplan.marking.judge.student_strokes import RED, SIZES, StudentStrokes, sample
from graphplan.marking.judge.verdict import WRONG, Judgement, Verdict
from graphplan.sheet.frames.frame import BORDER
from graphplan.sheet.layout.layout import layout, titled
from graphplan.sheet.layout.paper import packed
from graphplan.sheet.lettering.label_candidates import SMALL, Array, Wish
from graphplan.sheet.lettering.labels import placed
from graphplan.sheet.lettering.lettering import CAPS, SIZE, Run, Runs, sentence_runs, width, wrap
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Sheet, Spot, Text, within
from graphplan.sheet.plates.pens import LETTERS, PAPER, Pen
from graphplan.sheet.words.rows import LEADING, Placed, lettered
from graphplan.sheet.words.texts import RESULTS

FAINT, LETTERED, TINTED = "#a6a6a6", "#7a7a7a", "#efefef"
THIN = 0.18  # mm: the widest stroke of the true drawing
BESIDE = ("paper", BORDER, "text")  # the layers of what is not on a plan
LIFT = 1.2  # mm from the base line of the legend's words up to its samples
CALLED = Pen(0.35, RED)


def overlay(judgement: Judgement, score: Score) -> list[Sheet]:
    """The sheet with both drawings and the remarks, and pages of further remarks where there are very many."""
    composition = judgement.composition
    arrangement, tongue = composition.arrangement, composition.plans.tongue
    solution = layout(judgement.drawing, composition=composition)
    apart = (*arrangement.columns, arrangement.title)
    around = [item for item in solution.items if item.layer in BESIDE and not within(item, apart)]
    empty = [item for item in around if not within(item, arrangement.panels.values())]
    over = [faint(item) for item in solution.items if item.layer not in (*BESIDE, RESULTS)]
    over += StudentStrokes(judgement).items()
    over += [item for panel in composition.views for item in _told(judgement, panel, over)]
    words = Remarks(composition.plans).lines(arrangement.columns[0].width, judgement, score)
    about, pages = replace(solution, description=tongue(opinion(judgement))), packed(words, arrangement)
    sheets = []
    for number, page in enumerate(pages, 1):
        block = titled(composition, VERDICT, number, len(pages))
        items = [*(around + over if number == 1 else empty), *block, *_remarks(page)]
        sheets.append(replace(about, items=tuple(items), panels=solution.panels if number == 1 else {}))
    return sheets


def faint(item: Item) -> Item:
    """An item of the true drawing: thin and grey."""
    pen = item.pen
    if isinstance(item, Text):
        return replace(item, pen=Pen(0.0, LETTERED, fill=LETTERED))
    fill = pen.fill if pen.fill in ("none", PAPER) else FAINT if pen.width else TINTED
    return replace(item, pen=Pen(min(pen.width, THIN), FAINT, pen.dash, fill))


def _told(judgement: Judgement, panel: str, items: Sequence[Item]) -> Iterator[Item]:
    """On one plan: the first wrong step called out, the others by their numbers."""
    student, first, drawn = StudentStrokes(judgement), judgement.first, judgement.drawing.drawn
    rect = judgement.composition.views[panel].rect
    wrong = [verdict for verdict in judgement.judged if verdict.state == WRONG and verdict.trace is not None
             and student.home(verdict) == panel and panel in judgement.frames]
    here = list(items)
    if first in wrong:
        assert first is not None
        names = tuple(step.name for step in drawn.steps if step.name)
        sentence = judgement.composition.plans.tongue(complaint(judgement, first))
        here += (boxed := [*callout(sentence, names, student.at(first), here, rect, CALLED)])
        yield from boxed
    wishes = [_numbered(judgement, verdict, student) for verdict in wrong if verdict is not first]
    yield from placed(wishes, here, [student.at(verdict) for verdict in wrong], rect)


def _numbered(judgement: Judgement, verdict: Verdict, student: StudentStrokes) -> Wish:
    """A wrong mark's number, or of what is given its letter."""
    runs = (Run(called(judgement.drawing.drawn, verdict.step).short),)
    return Wish(runs, (student.at(verdict),), SIZES[WRONG], SMALL, Pen(0.0, RED, fill=RED), bold=True)


def _remarks(page: Sequence[Placed]) -> Iterator[Item]:
    """Rows as items, those of the legend with their samples."""
    for row, x, y in page:
        yield from lettered([(row, x, y)])
        if isinstance(row, LegendRow):
            yield from sample(row.state, (x + row.cells[0].x / 2 - 0.5, y + LIFT - 0.3))


LAYER = "student"
WIDEST, PAD, PITCH = 62.0, 1.5, 2.0  # mm: of the lettering; about it in its box; between the places that are tried
CLEAR, FAR = 6.0, 0.25  # mm between the box and its mark; the price of every further one
RING = 2.4  # mm about the mark


def callout(sentence: str, names: tuple[str, ...], spot: Spot, items: Sequence[Item], rect: Rect,
            pen: Pen) -> Iterator[Item]:
    """The box with its leader; `items` are what it should not cover."""
    room = min(WIDEST, rect.width - 4 * PAD)
    lines = wrap(sentence_runs(sentence, names), SIZE, room)
    wide = max(width(line, SIZE) for line in lines) + 2 * PAD
    high = SIZE * (CAPS + LEADING * (len(lines) - 1)) + 2 * PAD
    box = _box(wide, high, spot, items, rect)
    nearest = min(max(spot[0], box.left), box.right), min(max(spot[1], box.bottom), box.top)
    yield Circle(pen.filled("none"), LAYER, None, spot, RING)
    yield Polyline(pen, LAYER, None, (_towards(spot, nearest), nearest))
    yield Polygon(pen.filled(PAPER), LAYER, None, box.corners)
    yield from _lettered(lines, box)


def _lettered(lines: Sequence[Runs], box: Rect) -> Iterator[Text]:
    """The lines of the sentence, from the top of the box."""
    for i, runs in enumerate(lines):
        y = box.top - PAD - SIZE * (CAPS + LEADING * i)
        yield Text(LETTERS, LAYER, None, (box.left + PAD, y), runs, SIZE)


def _towards(spot: Spot, other: Spot) -> Spot:
    """Where the leader leaves the ring about its mark."""
    way = complex(other[0] - spot[0], other[1] - spot[1])
    start = complex(*spot) + RING * way / (abs(way) or 1.0)
    return start.real, start.imag


def _box(wide: float, high: float, spot: Spot, items: Sequence[Item], rect: Rect) -> Rect:
    """The cheapest of many places on the panel: the fewer strokes and letters it covers, and the nearer, the better."""
    boxes = _grid(wide, high, rect)
    gaps = np.hypot(*np.maximum(np.maximum(boxes[:, :2] - spot, spot - boxes[:, 2:]), 0.0).T)
    if (gaps >= CLEAR).any():
        boxes, gaps = boxes[gaps >= CLEAR], gaps[gaps >= CLEAR]
    touched, _ = STRtree([_outline(item) for item in items]).query(shapely.box(*boxes.T), "intersects")
    cost = np.bincount(touched, minlength=len(boxes)) + FAR * gaps
    left, bottom, right, top = map(float, boxes[int(np.argmin(cost))])
    return Rect(left, bottom, right, top)


def _grid(wide: float, high: float, rect: Rect) -> Array:
    """Boxes of this size all over a panel; one, at its corner, where it is hardly larger."""
    lefts = np.arange(rect.left + PAD, max(rect.right - PAD - wide, rect.left + PAD) + PITCH / 2, PITCH)
    lows = np.arange(rect.bottom + PAD, max(rect.top - PAD - high, rect.bottom + PAD) + PITCH / 2, PITCH)
    x, y = (part.ravel() for part in np.meshgrid(lefts, lows))
    return np.stack([x, y, x + wide, y + high], axis=1)


def _outline(item: Item) -> Geometry:
    """Where an item has ink; lettering is as solid as its box."""
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
