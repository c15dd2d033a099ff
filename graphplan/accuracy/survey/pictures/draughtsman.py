"""The draughtsman's board as a picture: operations against pencil error, a small picture a scene."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from graphplan.accuracy.survey.draughtsman import STRICT, Draft
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Series, SubChart, grouped
from graphplan.sheet.plates.pens import BLUE, GREY, INK, RED

MARKERS = {"pose's own": "circle", "every method": "plus", "auxiliary": "square", "trial": "up",
           "poles": "diamond"}
COLOURS = {"orthogonal": BLUE, "polar": RED}
OPERATIONS, ERROR = Axis("drawing operations"), Axis("pencil error, %")
FRONT = Look(INK, width=0.25)
REMARKS = (
    "Each mark is one form of a scene's construction: the operations of drawing it, and the expected error of its "
    "worst result beside the largest of its kind, to first order, all on sheets of size {paper} with {pencil}. "
    "The line is the front: no form takes fewer operations without a larger error. In brackets how many forms are "
    "not drawn; the table beside the chart says why."
)


def picture(rows: Sequence[Draft], pencil: str) -> Chart:
    """The chart of these drafts, drawn with a pencil."""
    panels = tuple(_panel(scene, of) for scene, of in grouped(rows, "scene").items())
    remarks = REMARKS.format(paper=rows[0].paper if rows else "", pencil=pencil)
    return Chart("The draughtsman: operations against pencil error", remarks, panels,
                 6, (44.0, 36.0), tuple(_key()))


def _panel(scene: str, rows: Sequence[Draft]) -> SubChart:
    """One scene: its front, from the worst error that is drawn to the most operations, and every form."""
    missing = sum(row.operations is None for row in rows)
    best = sorted({_spot(row) for row in rows if row.front})
    there = [row for row in rows if row.operations is not None and row.error]
    marks = [Series(look(row), (_spot(row),)) for row in there]
    if best:
        most, worst = (max(ends) for ends in zip(*map(_spot, there), strict=True))
        best = [(best[0][0], worst), *best, (most, best[-1][1])]
    stairs = [corner for (a, b), (c, d) in pairwise(best) for corner in ((a, b), (c, b), (c, d))]
    return SubChart(f"{scene} ({missing} not drawn)" if missing else scene, OPERATIONS, ERROR,
                 (Series(FRONT, tuple(dict.fromkeys(stairs))), *marks))


def _spot(row: Draft) -> tuple[float, float]:
    return float(row.operations or 0), 100 * (row.error or 0.0)


def look(row: Draft) -> Look:
    """A form's look: the method by the marker, the plan by the colour, strict forms hollow."""
    return Look(COLOURS[row.plan], MARKERS[row.form.split(", ")[0]], hollow=row.tools == STRICT, size=2.0)


def _key() -> Iterable[tuple[str, Look]]:
    yield from ((name, Look(GREY, marker, size=2.0)) for name, marker in MARKERS.items())
    yield from ((f"{plan} plans", Look(colour, area=True)) for plan, colour in COLOURS.items())
    yield "filled: with set squares", Look(GREY, "circle", size=2.0)
    yield "hollow: strictly, with compasses and straightedge", Look(GREY, "circle", hollow=True, size=2.0)
    yield "front", FRONT
