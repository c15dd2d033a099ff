"""The machine's board: time for a pose against error, of every form in every arithmetic, against the analytic solver.

Times are told in poses that LAPACK solves in the same run, many at once; errors are the largest in some sampled poses,
relative to the largest value of their kind, measured against what is true of these very binary numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from graphplan.accuracy.preference import by_method, different, form_name
from graphplan.bench.problem import ARITHMETICS, COMPILED, FORTY, FRACTIONS, LAPACK, SOLVERS, TWENTY, Problem, TimedRun
from graphplan.bench.rows import front, group_rows, median, ratios, stairs
from graphplan.design.decide import construct
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import MOTION_PLANS
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.methods.panels import motion_plans
from graphplan.output import diagrams

MOTION, FORCES = "motion", "motion and forces"
ALL_FORMS = 1000
Drawn = Construction | GraphplanError
Key = tuple[str, str, str]  # form, plan and arithmetic
Rivals = Mapping[str, Callable[[Problem], TimedRun]]


@dataclass(frozen=True)
class MachineMeasure:
    """One form in one arithmetic: the time for a pose in LAPACK's, between quartiles, and the largest error; or the
    reason why it fails. The solver and other programs have no form and no plan. The solver and other programs have no
    form and no plan."""

    scene: str
    asked: str
    form: str
    plan: str
    arithmetic: str
    time: float | None
    low: float | None
    high: float | None
    error: float | None
    why: str = ""


def measures(scene: Scene, compiled: int = ALL_FORMS) -> Iterator[MachineMeasure]:
    """Every form of a scene in every arithmetic, and the solver; of a scene with loads its forces, too.

    Numba compiles so many forms of each, the pose's own first; of the others it is said that they are left out.
    """
    for question in (MOTION, FORCES) if scene.loads is not None else (MOTION,):
        problem = Problem(scene, forces=question == FORCES)
        yield from measure_runs(problem, question, SOLVERS, forms(problem.scene), compiled)


def measure_runs(problem: Problem, asked: str, others: Rivals, drawn: Iterable[tuple[str, str, Drawn]],
                 compiled: int) -> Iterator[MachineMeasure]:
    """Measure programs without forms, and every form in every arithmetic, in turn; LAPACK is among the others."""
    runs, errors = dict[Key, TimedRun](), dict[Key, float]()
    for key, make in _candidate_runs(problem, others, drawn, compiled):
        try:
            run = make()
            errors[key], runs[key] = problem.error(run, run.call()), run
        except GraphplanError as refusal:
            yield MachineMeasure(problem.scene.name, asked, *key, None, None, None, None, refusal.lines[0])
    times = ratios({key: (run.call, run.count) for key, run in runs.items()}, ("", "", LAPACK))
    for key, (low, middle, high) in times.items():
        yield MachineMeasure(problem.scene.name, asked, *key, middle, low, high, errors[key])


def _candidate_runs(problem: Problem, others: Rivals, drawn: Iterable[tuple[str, str, Drawn]],
                    compiled: int) -> Iterator[tuple[Key, Callable[[], TimedRun]]]:
    """Everything that is measured: what has no form, then every form."""
    for name, solver in others.items():
        yield ("", "", name), partial(solver, problem)
    for k, (form, plan, drawing) in enumerate(drawn):
        for name, arithmetic in ARITHMETICS.items():
            left_out = name == COMPILED and k >= compiled
            yield (form, plan, name), partial(_run_of_form, partial(arithmetic, problem), drawing, left_out)


def _run_of_form(arithmetic: Callable[[Construction], TimedRun], drawn: Drawn, left_out: bool) -> TimedRun:
    """An arithmetic at work on a form; fails where the form is refused, and where it takes too long."""
    if isinstance(drawn, GraphplanError):
        raise drawn
    if left_out:
        raise Refused(COMPILED, "compiling takes seconds for each form", "name the scene with --scenes")
    return arithmetic(drawn)


def _by_method(scene: Scene, plan: str, method: str) -> Construction:
    return construct(scene, Design(plan, method))


def forms(scene: Scene) -> Iterator[tuple[str, str, Drawn]]:
    """Yield the programs of all methods, on both kinds of plan, by the methods' names; or the reason why one fails."""
    for plan in motion_plans(scene):
        for names, result in different(by_method(partial(_by_method, scene, plan)), lambda drawing: drawing.program):
            yield form_name(names), plan, result


# ---- the pictures ---------------------------------------------------------------------------------------------------

MARKERS = dict(zip((*ARITHMETICS, *SOLVERS), ("o", "s", "*", "P", "D", "v", "<", ">", "X"), strict=True))
COLOURS = {"": diagrams.GREY, "pose's own": diagrams.BLACK, "every method": diagrams.BLACK,
           "auxiliary": diagrams.BLUE, "trial": diagrams.VERMILION, "poles": diagrams.GREEN}
PROVEN = {TWENTY: 1e-20, FORTY: 1e-40}
# where exact and proven results stand on the axis, below all floats
RAILS = {10.0 ** -18: TWENTY, 10.0 ** -19: FORTY, 10.0 ** -20: FRACTIONS}
LEVELS = {name: level for level, name in RAILS.items()}
FLOATS_END, ERRORS = 10.0 ** -17.5, (1e-16, 1e-12)  # below which the rails are; errors that are shown in any case
TIME, ERROR = "time for a pose; LAPACK's is 1", "largest error, relative"
RIVAL: dict[str, Any] = {"color": diagrams.VERMILION, "marker": "D", "markerfacecolor": "white",
                         "markersize": 3.0 * diagrams.MM}
REMARKS = (
    "Further left is faster, lower is more accurate; nothing of the construction and the solver lies left of and below "
    "the line. Each mark is a median over all packaged scenes with its quartiles. Times are relative to LAPACK, which "
    "solves the equations of the same scene for many poses at once in the same run; errors are the largest of any "
    "number in five poses, relative to the largest of its kind, against fractions."
)
DETAILS = (
    "Each mark is one form in one arithmetic; the solver's are grey. Times are medians within one run, 1 being the "
    "time that LAPACK takes for a pose of the same scene, many at once; errors as in the chart of the medians; below "
    "the line 20 and 40 proven digits and fractions."
)


@diagrams.in_style
def picture(rows: Sequence[MachineMeasure]) -> diagrams.Figure:
    """Return the chart of the medians over the scenes: of the motion, and of motion and forces of scenes with loads."""
    questions = group_rows(rows, "asked")
    headings = [diagrams.Heading(f"{question.capitalize()}, {len(group_rows(of, 'scene'))} scenes")
                for question, of in questions.items()]
    figure, panels = diagrams.page("The machine: time against error", REMARKS, headings, (150.0, 115.0), 2,
                          diagrams.Margins(left=40.0, foot=9.0))
    for axes, of in zip(panels, questions.values(), strict=True):
        _set_axes(axes, of, readings=8)
        axes.set(xlabel=TIME, ylabel=ERROR)
        _draw_medians(axes, of)
    diagrams.foot_legend(figure, [
        diagrams.look("the construction", **DRAWING), diagrams.look("the analytic solver", **SOLVER_LOOK),
        *([diagrams.look(label="other programs, in brackets the scenes that they are measured in", **RIVAL)]
          if _rival_names(rows) else []),
        diagrams.look(label="front of the first two", color=diagrams.GREY, linestyle="-")], 4)
    return figure


DRAWING: dict[str, Any] = {"color": diagrams.BLACK, "marker": "o"}
SOLVER_LOOK: dict[str, Any] = {"color": diagrams.GREY, "marker": "s"}


def _set_axes(axes: diagrams.Axes, rows: Sequence[MachineMeasure], readings: int, names: bool = True) -> None:
    """Set the scales of a panel, with the rails of what is proven under those of floats."""
    measured = [row for row in rows if row.time is not None and row.error is not None]
    times, errors = [row.time or 1.0 for row in measured], [row.error for row in measured if row.error]
    diagrams.logarithmic(axes.xaxis, min([*times, 1.0]), max([*times, 1.0]), readings=readings)
    highest = max([ERRORS[1], *(error for error in errors if error < 1)])
    rails = RAILS if names else dict.fromkeys(RAILS, "")
    diagrams.logarithmic(axes.yaxis, ERRORS[0], highest, rails, readings)
    axes.axhline(FLOATS_END, color=diagrams.GREY, linewidth=0.25 * diagrams.MM)


def _draw_medians(axes: diagrams.Axes, rows: Sequence[MachineMeasure]) -> None:
    """Draw the front, and each arithmetic by its median over the scenes: of the form that the pose chooses itself."""
    chosen = [row for row in rows if row.time is not None and row.error is not None
              and row.plan in ("", MOTION_PLANS[0]) and row.form.split(", ")[0] in ("", "pose's own", "every method")]
    several, labels = group_rows(chosen, "arithmetic"), list[diagrams.SeriesLabel]()
    medians = {name: median([(row.time or 0.0, _level(row)) for row in of]) for name, of in several.items()}
    ours = [middle for name, (middle, _, _) in medians.items() if name in {*ARITHMETICS, *SOLVERS}]
    if ours:
        ends = max(x for x, _ in ours), max(y for _, y in ours)
        axes.plot(*zip(*stairs(front(ours), ends), strict=True), color=diagrams.GREY, gid="front")
    for name, ((x, y), (left, low), (right, high)) in medians.items():
        style = RIVAL if name not in MARKERS else SOLVER_LOOK if name in SOLVERS else DRAWING
        axes.plot([left, right], [y, y], color=style["color"])
        axes.plot([x, x], [low, high], color=style["color"])
        axes.plot([x], [y], linestyle="none", gid=name, **style)
        if y > FLOATS_END:
            words = f"{name} ({len(several[name])})" if style is RIVAL else name
            labels.append(diagrams.SeriesLabel(x, y, words, str(style["color"])))
    diagrams.place_labels(axes, labels)


@diagrams.in_style
def details(rows: Sequence[MachineMeasure]) -> diagrams.Figure:
    """Return the chart of every form in every scene."""
    panels_of = {f"{scene}, {question}": of for question, every in group_rows(rows, "asked").items()
                 for scene, of in group_rows(every, "scene").items()}
    figure, panels = diagrams.page(
        "The machine: time against error, scene by scene", DETAILS, [*map(diagrams.Heading, panels_of)], (56.0, 44.0),
        6, diagrams.Margins(left=17.0, right=5.0, below=10.0, foot=20.0))
    for axes, of in zip(panels, panels_of.values(), strict=True):
        _set_axes(axes, of, readings=4, names=False)
        for row in of:
            if row.time is not None and row.error is not None:
                axes.plot([row.time], [_level(row)], linestyle="none", **_row_look(row))
    shapes = [diagrams.look(label=name, color=diagrams.GREY if name in SOLVERS else diagrams.BLACK, marker=marker)
              for name, marker in MARKERS.items()]
    hues = {"form of the pose or of every method": diagrams.BLACK,
            **{name: COLOURS[name] for name in ("auxiliary", "trial", "poles")}}
    names = _rival_names(rows)
    diagrams.foot_legend(figure, [
        *shapes, *(diagrams.swatch(label, colour) for label, colour in hues.items()),
        diagrams.look("hollow: polar plans, velocity triangles", **DRAWING, markerfacecolor="white"),
        *([diagrams.look(f"other programs ({'; '.join(names)})", **RIVAL)] if names else [])], 5)
    return figure


def _level(row: MachineMeasure) -> float:
    """Return where an error stands: on the rail of the digits that its arithmetic proves of it, or as it is."""
    error = row.error or 0.0
    if error == 0:
        return LEVELS[FRACTIONS]
    rail = row.arithmetic if row.arithmetic in PROVEN else next(
        (name for name, most in PROVEN.items() if error < most), "")
    return LEVELS[rail] if rail and error < PROVEN[rail] else error


def _row_look(row: MachineMeasure) -> dict[str, Any]:
    """Return a measure's look: its arithmetic by the marker, its method by the colour, other plans hollow."""
    if row.arithmetic not in MARKERS:
        return RIVAL
    colour = COLOURS[row.form.split(", ")[0]]
    filling = colour if row.plan in ("", MOTION_PLANS[0]) else "white"
    return {"color": colour, "marker": MARKERS[row.arithmetic], "markerfacecolor": filling}


def _rival_names(rows: Iterable[MachineMeasure]) -> list[str]:
    """Return the names of other programs that were measured."""
    return [*dict.fromkeys(row.arithmetic for row in rows if row.arithmetic not in MARKERS and row.time is not None)]
