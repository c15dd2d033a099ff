"""The draughtsman's board: drawing operations against the expected pencil error, of every form of a scene.

All forms are drawn on sheets of one size, as a larger one would make any of them more accurate. A form is on the front
where no other takes fewer operations without a larger error.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from graphplan.accuracy.preference import constructions, forms, strict_constructions
from graphplan.bench.rows import front, group_rows, median, stairs
from graphplan.design.hand import Pencil
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import METHODS, MOTION_PLANS
from graphplan.methods.design import Design
from graphplan.methods.panels import motion_plans
from graphplan.output import diagrams

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


PLAN, METHOD, TOOLS = "plan", "method", "tools"
OWN = "pose's own"
MARKERS = {OWN: "o", "every method": "P", "auxiliary": "s", "trial": "^", "poles": "D"}
COLOURS = dict(zip(MOTION_PLANS, (diagrams.BLUE, diagrams.VERMILION, diagrams.GREEN), strict=True))
OPERATIONS, ERROR = "drawing operations", "pencil error of the worst result, %"
MODEL = (
    "The pencil error is that of the worst result relative to the largest of its kind, to first order, all on sheets "
    "of size {paper} with {pencil}."
)
REMARKS = (
    "Further left is quicker, lower is more accurate. Each panel asks one question of the scenes in which it is one, "
    "relative to the form that is chosen for the pose, on orthogonal plans, with set squares (1, 1). A small mark is a "
    "scene, a large one the median, with its quartiles. " + MODEL
)
DETAILS = (
    "Each mark is one form of a scene's construction. The line is the front: no form takes fewer operations without a "
    "larger error. In brackets: how many forms cannot be drawn; the chart's table says why. " + MODEL
)
QUESTIONS = {
    METHOD: diagrams.Heading(
        "Which method?", "Scenes whose methods lead to different drawings; a method is shown where it is another "
        "drawing than the pose's own."),
    PLAN: diagrams.Heading("Which plans?", "Scenes that have plans of both kinds, the method left to the pose."),
    TOOLS: diagrams.Heading(
        "Which tools?", "Compasses and straightedge alone, relative to set squares, on the same plans."),
}
ANSWERS = {  # the look of each answer
    "auxiliary": (diagrams.BLUE, "s"), "trial": (diagrams.VERMILION, "^"), "poles": (diagrams.GREEN, "D"),
    "polar plans": (diagrams.VERMILION, "v"), "velocity triangles": (diagrams.GREEN, "*"),
    "strict, orthogonal plans": (diagrams.BLUE, "P"), "strict, polar plans": (diagrams.VERMILION, "X"),
    "strict, triangles plans": (diagrams.GREEN, "d"),
}
Place = tuple[float, float]  # in operations and error


@diagrams.in_style
def picture(rows: Sequence[Draft], pencil: str) -> diagrams.Figure:
    """Return the chart of what a choice of method, plans or tools costs, over the scenes that have it."""
    scenes, remarks = [*group_rows(rows, "scene").values()], REMARKS.format(paper=PAPER, pencil=pencil)
    figure, panels = diagrams.page("The draughtsman: operations against pencil error", remarks, [*QUESTIONS.values()],
                                   (104.0, 104.0), 3, diagrams.Margins(left=24.0))
    for axes, question in zip(panels, QUESTIONS, strict=True):
        answers: dict[str, list[Place]] = {}
        for of in scenes:
            for answer, place in relative_places(of, question):
                answers.setdefault(answer, []).append(place)
        _draw_answers(axes, answers, SQUARES if question == TOOLS else OWN)
        axes.set(xlabel=f"{OPERATIONS}, relative", ylabel="pencil error, relative")
    return figure


def relative_places(rows: Sequence[Draft], question: str) -> Iterator[tuple[str, Place]]:
    """Yield each answer that a scene has to a question, relative to its form chosen for the pose, on orthogonal plans,
    with set squares; of tools relative to the same plans. A scene that has no choice answers nothing."""
    row_of = {(name, row.plan, row.tools): row for row in rows if row.error for name in _methods(row)}
    reference = row_of.get((OWN, MOTION_PLANS[0], SQUARES))
    if reference is None:
        return
    for (method, plan, tools), row in row_of.items():
        if question == METHOD and (plan, tools) == (MOTION_PLANS[0], SQUARES) and row is not reference:
            yield method, _relative(row, reference)
        elif question == PLAN and method == OWN and tools == SQUARES and plan != MOTION_PLANS[0]:
            yield f"velocity {plan}" if plan == MOTION_PLANS[2] else f"{plan} plans", _relative(row, reference)
        elif question == TOOLS and (method, tools) == (OWN, STRICT) and (OWN, plan, SQUARES) in row_of:
            yield f"strict, {plan} plans", _relative(row, row_of[OWN, plan, SQUARES])


def _methods(row: Draft) -> list[str]:
    """Return the methods that lead to a form."""
    return [OWN, *METHODS] if row.form == "every method" else row.form.split(", ")


def _relative(row: Draft, reference: Draft) -> Place:
    (x, y), (u, v) = _spot(row), _spot(reference)
    return x / u, y / v


def _draw_answers(axes: diagrams.Axes, answers: Mapping[str, Sequence[Place]], reference: str) -> None:
    """Draw the scenes of each answer and their median, beside the form that all are relative to."""
    places = [(1.0, 1.0), *(place for of in answers.values() for place in of)]
    for axis, numbers in zip((axes.xaxis, axes.yaxis), zip(*places, strict=True), strict=True):
        diagrams.ratio_axis(axis, min(numbers), max(numbers))
    axes.axvline(1.0, color=diagrams.GREY)
    axes.axhline(1.0, color=diagrams.GREY)
    labels = list[diagrams.SeriesLabel]()
    for answer, of in answers.items():
        colour, marker = ANSWERS[answer]
        axes.plot(*zip(*of, strict=True), linestyle="none", color=colour, marker=marker, markersize=1.3 * diagrams.MM,
                  markerfacecolor="white", gid=f"scenes: {answer}")
        (x, y), (left, low), (right, high) = median(of)
        axes.plot([left, right], [y, y], color=colour)
        axes.plot([x, x], [low, high], color=colour)
        axes.plot([x], [y], linestyle="none", color=colour, marker=marker, markersize=3.2 * diagrams.MM, gid=answer)
        labels.append(diagrams.SeriesLabel(x, y, f"{answer} ({len(of)} scene{'s' * (len(of) > 1)})", colour))
    axes.plot([1.0], [1.0], linestyle="none", color=diagrams.BLACK, marker="o", markersize=2.4 * diagrams.MM)
    diagrams.place_labels(axes, [*labels, diagrams.SeriesLabel(1.0, 1.0, reference)])


@diagrams.in_style
def details(rows: Sequence[Draft], pencil: str) -> diagrams.Figure:
    """Return the chart of every form of every scene."""
    scenes = group_rows(rows, "scene")
    missing = {scene: sum(row.operations is None for row in of) for scene, of in scenes.items()}
    headings = [diagrams.Heading(f"{scene} ({missing[scene]} not drawn)" if missing[scene] else scene)
                for scene in scenes]
    figure, panels = diagrams.page("The draughtsman: operations against pencil error, scene by scene",
                          f"{OPERATIONS.capitalize()} to the right, {ERROR} upwards. "
                          + DETAILS.format(paper=PAPER, pencil=pencil), headings, (56.0, 40.0), 6,
                          diagrams.Margins(left=17.0, right=5.0, below=10.0, foot=14.0))
    for axes, of in zip(panels, scenes.values(), strict=True):
        _draw_forms(axes, [row for row in of if row.operations is not None and row.error])
    plans = [diagrams.swatch(f"velocity {plan}" if plan == MOTION_PLANS[2] else f"{plan} plans", colour)
             for plan, colour in COLOURS.items()]
    diagrams.foot_legend(figure, [
        *(diagrams.look(label=name, color=diagrams.GREY, marker=marker) for name, marker in MARKERS.items()), *plans,
        diagrams.look(label="filled: with set squares", color=diagrams.GREY, marker="o"),
        diagrams.look(label=f"hollow: {STRICT}", color=diagrams.GREY, marker="o", markerfacecolor="white"),
        diagrams.look(label="front", color=diagrams.BLACK, linestyle="-")], 6)
    return figure


def _draw_forms(axes: diagrams.Axes, rows: Sequence[Draft]) -> None:
    """Draw one scene: its front, from the worst error that is drawn to the most operations, and every form."""
    if not rows:
        axes.set(xticks=[], yticks=[])
        return
    spots = [*map(_spot, rows)]
    for axis, numbers in zip((axes.xaxis, axes.yaxis), zip(*spots, strict=True), strict=True):
        diagrams.ratio_axis(axis, min(numbers), max(numbers), readings=4)
    best = stairs(sorted({_spot(row) for row in rows if row.front}), tuple(map(max, zip(*spots, strict=True))))
    axes.plot(*zip(*best, strict=True), color=diagrams.BLACK, linewidth=0.25 * diagrams.MM)
    for row in rows:
        colour = COLOURS[row.plan]
        axes.plot(*_spot(row), linestyle="none", color=colour, marker=MARKERS[row.form.split(", ")[0]],
                  markerfacecolor="white" if row.tools == STRICT else colour)


def _spot(row: Draft) -> Place:
    return float(row.operations or 0), 100 * (row.error or 0.0)
