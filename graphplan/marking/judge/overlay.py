"""The overlay: a student's drawing over the true one on the sheet of the construction, and what there is to say of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from graphplan.marking.judge.callout import callout
from graphplan.marking.judge.findings import called, complaint, judged, opinion
from graphplan.marking.judge.remarks import VERDICT, LegendRow, Remarks
from graphplan.marking.judge.score import Score
from graphplan.marking.judge.student_strokes import RED, SIZES, StudentStrokes, sample
from graphplan.marking.judge.verdict import WRONG, Judgement, Verdict
from graphplan.sheet.frames.frame import BORDER
from graphplan.sheet.layout.layout import layout, titled
from graphplan.sheet.layout.pages import packed
from graphplan.sheet.lettering.label_candidates import SMALL, Wish
from graphplan.sheet.lettering.labels import placed
from graphplan.sheet.lettering.lettering import Run
from graphplan.sheet.plates.display import Item, Polygon, Polyline, Rect, Sheet, Text
from graphplan.sheet.plates.pens import PAPER, Pen
from graphplan.sheet.words.rows import Placed, lettered
from graphplan.sheet.words.texts import RESULTS

FAINT, LETTERED, TINTED = "#a6a6a6", "#7a7a7a", "#efefef"
THIN = 0.18  # mm: the widest stroke of the true drawing
BESIDE = ("paper", BORDER, "text")  # the layers of what is not on a plan
EDGE = 0.01  # mm by which what is on an edge may be beyond it
LIFT = 1.2  # mm from the base line of the legend's words up to its samples
CALLED = Pen(0.35, RED)


def overlay(judgement: Judgement, score: Score) -> list[Sheet]:
    """The sheet with both drawings and the remarks, and pages of further remarks where there are very many."""
    composition = judgement.composition
    arrangement, tongue = composition.arrangement, composition.plans.tongue
    solution = layout(judgement.drawing, composition=composition)
    apart = (*arrangement.columns, arrangement.title)
    around = [item for item in solution.items if item.layer in BESIDE and not _within(item, apart)]
    empty = [item for item in around if not _within(item, arrangement.panels.values())]
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


def _within(item: Item, rects: Iterable[Rect]) -> bool:
    """Whether an item beside the plans, a stroke or lettering, lies in one of the rectangles."""
    assert isinstance(item, Text | Polyline | Polygon)
    spots = (item.at,) if isinstance(item, Text) else item.spots
    return any(all(rect.holds(spot, EDGE) for spot in spots) for rect in rects)


def _told(judgement: Judgement, panel: str, items: Sequence[Item]) -> Iterator[Item]:
    """On one plan: the first wrong step called out, the others by their numbers."""
    student, first, drawn = StudentStrokes(judgement), judgement.first, judgement.drawing.drawn
    rect = judgement.composition.views[panel].rect
    wrong = [verdict for verdict in judged(judgement) if verdict.state == WRONG and verdict.trace is not None
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
