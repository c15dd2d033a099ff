"""The draughtsman's board: drawing operations against the expected pencil error, of every form of a scene.

All forms are drawn on sheets of one size, as a larger one would make any of them more accurate. A form is on the front
where no other takes fewer operations without a larger error.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from graphplan.accuracy.pencil import Pencil
from graphplan.accuracy.preference import forms
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Series, SubChart, grouped
from graphplan.mechanism.model import Scene
from graphplan.methods.styles import MOTION_PLANS
from graphplan.sheet.plates.pens import BLUE, GREY, INK, RED

PAPER = "A1"
SQUARES, STRICT = "set squares", "compasses and straightedge"
LONG = "with loads this takes many seconds a form; name the scene with --scenes"


@dataclass(frozen=True)
class Draft:
    """One form on its sheet: operations, the worst result's error beside the largest of its kind, and whether it is on
    the front; or why it is not drawn."""

    scene: str
    form: str
    plan: str
    tools: str
    paper: str
    operations: int | None
    error: float | None
    front: bool = False
    why: str = ""


def drafts(scene: Scene, pencil: Pencil, long: bool = True) -> list[Draft]:
    """Every form of a scene, those on the front marked; without `long` loaded scenes are not drawn strictly."""
    found = list(_drawn(scene, pencil, long))
    best = front([(one.operations, one.error) for one in found if one.operations is not None and one.error])
    return [replace(one, front=(one.operations, one.error) in best) for one in found]


def _drawn(scene: Scene, pencil: Pencil, long: bool) -> Iterator[Draft]:
    for tools in (SQUARES, STRICT):
        for plan in MOTION_PLANS:
            if tools == STRICT and scene.loads is not None and not long:
                yield Draft(scene.name, "every method", plan, tools, PAPER, None, None, why=LONG)
                continue
            for form in forms(scene, pencil, plan=plan, strict=tools == STRICT, paper=PAPER):
                one, place = form.drafted, (scene.name, form.name, plan, tools, PAPER)
                if one is None:
                    yield Draft(*place, None, None, why=str(form.refusal))
                else:
                    yield Draft(*place, one.operations, one.error or None,
                                why="" if one.error else "every result is nothing")


def front(places: Sequence[tuple[int, float]]) -> list[tuple[int, float]]:
    """The places that no other beats in one coordinate without losing in the other (Pareto), by the first one."""
    best: list[tuple[int, float]] = []
    for place in sorted(set(places)):
        if not best or place[1] < best[-1][1]:
            best.append(place)
    return best


MARKERS = {"pose's own": "circle", "every method": "plus", "auxiliary": "square", "trial": "up", "poles": "diamond"}
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
    remarks = REMARKS.format(paper=PAPER, pencil=pencil)
    return Chart("The draughtsman: operations against pencil error", remarks, panels, 6, (44.0, 36.0), tuple(_key()))


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
