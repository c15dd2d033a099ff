"""The draughtsman's board: drawing operations against the expected pencil error, of every form of a scene.

All forms are drawn on sheets of one size, as a larger one would make any of them more accurate. A form is on the front
where no other takes fewer operations without a larger error.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from graphplan.accuracy.preference import constructions, forms, strict_constructions
from graphplan.bench.picture import Axis, Chart, ChartSeries, Look, SubChart, front, group_rows, median, stairs
from graphplan.design.hand import Pencil
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import MOTION_PLANS
from graphplan.methods.design import Design
from graphplan.methods.panels import motion_plans
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, INK, RED

PAPER = "A1"
SQUARES, STRICT = "set squares", "compasses and straightedge"
LONG_REASON = "with loads this takes many seconds a form; name the scene with --scenes"


@dataclass(frozen=True)
class Draft:
    """One form on its sheet: operations, the worst result's error relative to the largest of its kind, and whether it
    is on the front; or why it is not drawn."""

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
    rows = list(_draft_rows(scene, pencil, long))
    best = front([(row.operations, row.error) for row in rows if row.operations is not None and row.error])
    return [replace(row, front=(row.operations, row.error) in best) for row in rows]


def _draft_rows(scene: Scene, pencil: Pencil, long: bool) -> Iterator[Draft]:
    drawn_on = {plan: constructions(scene, Design(plan)) for plan in motion_plans(scene)}
    for tools in (SQUARES, STRICT):
        for plan, drawn in drawn_on.items():
            if tools == STRICT and scene.loads is not None and not long:
                yield Draft(scene.name, "every method", plan, tools, PAPER, None, None, why=LONG_REASON)
                continue
            for form in forms(strict_constructions(drawn) if tools == STRICT else drawn, pencil, paper=PAPER):
                draft, place = form.drafted, (scene.name, form.name, plan, tools, PAPER)
                if draft is None:
                    yield Draft(*place, None, None, why=str(form.refusal))
                else:
                    yield Draft(*place, draft.operations, draft.error or None,
                                why="" if draft.error else "every result is nothing")


MARKERS = {"pose's own": "circle", "every method": "plus", "auxiliary": "square", "trial": "up", "poles": "diamond"}
COLOURS = dict(zip(MOTION_PLANS, (BLUE, RED, GREEN), strict=True))
OPERATIONS, ERROR = Axis("drawing operations"), Axis("pencil error, %")
TIMES_OPERATIONS = Axis("drawing operations; 1 is the pose's own form, set squares, orthogonal plans",
                        shows=(0.85, 4.5), reference=1.0)
TIMES_ERROR = Axis("pencil error of the worst result; 1 is that of the pose's own form", shows=(0.5,), reference=1.0)
FRONT = Look(INK, width=0.25)
MODEL = (
    "The pencil error is that of the worst result relative to the largest of its kind, to first order, all on sheets "
    "of size {paper} with {pencil}."
)
REMARKS = (
    "Further left is quicker, lower is more accurate; no way of drawing that all scenes have lies left of and below "
    "the line. Each mark is a way of drawing: medians and quartiles over the {scenes} packaged scenes, or as many as "
    "have it, in brackets, relative to the form chosen for the pose. " + MODEL
)
DETAILS = (
    "Each mark is one form of a scene's construction. The line is the front: no form takes fewer operations without a "
    "larger error. In brackets: how many forms cannot be drawn; the chart's table says why. " + MODEL
)
Place = tuple[float, float]  # in operations and error


def picture(rows: Sequence[Draft], pencil: str) -> Chart:
    """The chart of the medians over the scenes, drawn with a pencil."""
    scenes = group_rows(rows, "scene")
    spots_by_way: dict[tuple[str, str, str], list[Place]] = {}
    for of in scenes.values():
        for combination, place in _relative_to_own(of):
            spots_by_way.setdefault(combination, []).append(place)
    ways_by_spot: dict[tuple[int, tuple[tuple[float, float], ...]], list[tuple[str, str, str]]] = {}
    for combination, places in spots_by_way.items():
        ways_by_spot.setdefault((len(places), median(places)), []).append(combination)
    most = max((count for count, _ in ways_by_spot), default=0)
    series = [ChartSeries(form_look(*alike[0]), (place[0],), ((place[1], place[2]),),
                          label=_ways_text(alike) + (f" ({count})" if count < most else ""))
              for (count, place), alike in ways_by_spot.items()]
    best = front([middle for count, (middle, *_) in ways_by_spot if count == most])
    middles = [middle for _, (middle, *_) in ways_by_spot]
    panel = SubChart("", TIMES_OPERATIONS, TIMES_ERROR, (
        ChartSeries(FRONT, tuple(stairs(best, _ends(middles)))), *series))
    title, remarks = "The draughtsman: operations against pencil error", REMARKS.format(
        paper=PAPER, pencil=pencil, scenes=len(scenes))
    return Chart(title, remarks, (panel,), 1, (240.0, 140.0), tuple(_key()))


def _relative_to_own(rows: Sequence[Draft]) -> Iterator[tuple[tuple[str, str, str], Place]]:
    """Each way to draw one scene, method, plan and tools, relative to the pose's own form; methods that lead to one
    form have it in common, but where all do it is the pose's own alone."""
    spots = {(name, row.plan, row.tools): _spot(row) for row in rows if row.error
             for name in ("pose's own" if row.form == "every method" else row.form).split(", ")}
    if own_spot := spots.get(("pose's own", MOTION_PLANS[0], SQUARES)):
        yield from ((drawing_way, (x / own_spot[0], y / own_spot[1])) for drawing_way, (x, y) in spots.items())


def _ways_text(alike: Sequence[tuple[str, str, str]]) -> str:
    """The ways to draw that stand at one place: the methods by plan and tools."""
    methods: dict[str, list[str]] = {}
    for method, plan, tools in alike:
        methods.setdefault(f"{plan}{', strict' if tools == STRICT else ''}", []).append(method)
    return "; ".join(f"{', '.join(named)}: {how}" for how, named in methods.items())


def _ends(places: Sequence[Place]) -> Place:
    """The most operations and the largest error."""
    x, y = (max(values) for values in zip(*places, strict=True))
    return x, y


def details(rows: Sequence[Draft], pencil: str) -> Chart:
    """The chart of every form of every scene."""
    panels = tuple(_panel(scene, of) for scene, of in group_rows(rows, "scene").items())
    remarks = DETAILS.format(paper=PAPER, pencil=pencil)
    title = "The draughtsman: operations against pencil error, scene by scene"
    return Chart(title, remarks, panels, 6, (44.0, 36.0), tuple(_key()))


def _panel(scene: str, rows: Sequence[Draft]) -> SubChart:
    """One scene: its front, from the worst error that is drawn to the most operations, and every form."""
    missing = sum(row.operations is None for row in rows)
    drawn_rows = [row for row in rows if row.operations is not None and row.error]
    line = stairs(sorted({_spot(row) for row in rows if row.front}),
                  _ends(list(map(_spot, drawn_rows)))) if drawn_rows else []
    return SubChart(f"{scene} ({missing} not drawn)" if missing else scene, OPERATIONS, ERROR,
                    (ChartSeries(FRONT, tuple(line)), *(ChartSeries(look(row), (_spot(row),)) for row in drawn_rows)))


def _spot(row: Draft) -> Place:
    return float(row.operations or 0), 100 * (row.error or 0.0)


def look(row: Draft) -> Look:
    """A form's look: the method by the marker, the plan by the colour, strict forms hollow."""
    return form_look(row.form.split(", ")[0], row.plan, row.tools)


def form_look(method: str, plan: str, tools: str) -> Look:
    return Look(COLOURS[plan], MARKERS[method], hollow=tools == STRICT, marker_mm=2.0)


def _key() -> Iterable[tuple[str, Look]]:
    yield from ((name, Look(GREY, marker, marker_mm=2.0)) for name, marker in MARKERS.items())
    yield from ((f"velocity {plan}" if plan == "triangles" else f"{plan} plans", Look(colour, area=True))
                for plan, colour in COLOURS.items())
    yield "filled: with set squares", Look(GREY, "circle", marker_mm=2.0)
    yield "hollow: strictly, with compasses and straightedge", Look(GREY, "circle", hollow=True, marker_mm=2.0)
    yield "front", FRONT
