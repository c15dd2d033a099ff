"""The machine's board: time for a pose against error, of every form in every arithmetic, against the analytic solver.

Times are told in poses that LAPACK solves in the same run, many at once; errors are the largest in some sampled poses,
relative to the largest value of their kind, measured against what is true of these very binary numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from graphplan.accuracy.preference import by_method, different, form_name
from graphplan.bench.picture import (
    Axis,
    Chart,
    ChartSeries,
    Look,
    Place,
    SubChart,
    front,
    group_rows,
    median,
    ratios,
    stairs,
)
from graphplan.bench.problem import ARITHMETICS, COMPILED, FORTY, FRACTIONS, LAPACK, SOLVERS, TWENTY, Problem, TimedRun
from graphplan.design.decide import construct
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import MOTION_PLANS
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.methods.panels import motion_plans
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, INK, RED

MOTION, FORCES = "motion", "motion and forces"
ALL_FORMS = 1000
Drawn = Construction | GraphplanError
Key = tuple[str, str, str]  # form, plan and arithmetic
Rivals = Mapping[str, Callable[[Problem], TimedRun]]


@dataclass(frozen=True)
class MachineMeasure:
    """One form in one arithmetic: the time for a pose in LAPACK's, between quartiles, and the largest error; or why
    there is none. The solver and other programs have no form and no plan."""

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
    """What has no form, and every form in every arithmetic, taking turns; LAPACK is among the others."""
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
    """The programs to which all methods lead, on both kinds of plan, by the methods' names; or why there is none."""
    for plan in motion_plans(scene):
        for names, result in different(by_method(partial(_by_method, scene, plan)), lambda drawing: drawing.program):
            yield form_name(names), plan, result


# ---- the pictures -----------------------------------------------------------------------------------------------

MARKERS = dict(zip((*ARITHMETICS, *SOLVERS), (
    "circle", "square", "star", "plus", "diamond", "down", "left", "right", "crossed"), strict=True))
COLOURS = {"": GREY, "pose's own": INK, "every method": INK, "auxiliary": BLUE, "trial": RED, "poles": GREEN}
PROVEN = {TWENTY: 1e-20, FORTY: 1e-40}
EXACT = FRACTIONS
TIME = Axis("time for a pose; LAPACK's is 1", reference=1.0)
ERROR = Axis("largest error, relative", before=tuple((name, name) for name in (EXACT, FORTY, TWENTY)), pitch=8.0,
             shows=(1e-16, 1e-12))
OWN, SOLVERS_OWN = Look(INK, "circle", marker_mm=2.6), Look(GREY, "square", marker_mm=2.6)
RIVAL, FRONT = Look(RED, "diamond", hollow=True, marker_mm=3.0), Look(GREY, width=0.35)
REMARKS = (
    "Further left is faster, lower is more accurate; nothing of the construction and the solver lies left of and below "
    "the line. Each mark is a median over all packaged scenes with its quartiles. Times are relative to LAPACK, which "
    "solves the equations of the same scene for many poses at once in the same run; errors are the largest of any "
    "number in five poses, relative to the largest of its kind, against fractions."
)
DETAILS = (
    "Each mark is one form in one arithmetic; the solver's are grey. Times are medians within one run, 1 being the "
    "time that LAPACK takes for a pose of the same scene, many at once; errors as in the chart of the medians."
)


def picture(rows: Sequence[MachineMeasure]) -> Chart:
    """The chart of the medians over the scenes: of the motion, and of the motion and forces of scenes with loads."""
    panels = [SubChart(f"{question.capitalize()}, {len(group_rows(of, 'scene'))} scenes", TIME, ERROR,
                       tuple(_medians(of)))
              for question, of in group_rows(rows, "asked").items()]
    key = (("the construction", OWN), ("the analytic solver", SOLVERS_OWN), *_rival_key(
        rows, "; in brackets the scenes of the bench that they are measured in"), ("front of these two", FRONT))
    return Chart("The machine: time against error", REMARKS, tuple(panels), 2, (165.0, 120.0), key)


def _medians(rows: Sequence[MachineMeasure]) -> Iterator[ChartSeries]:
    """The front, and each arithmetic by its median over the scenes: of the form that the pose chooses for itself."""
    chosen = [row for row in rows if row.time is not None and row.plan in ("", MOTION_PLANS[0])
              and row.form.split(", ")[0] in ("", "pose's own", "every method")]
    several = group_rows(chosen, "arithmetic")
    medians = {name: median([(row.time, row.error) for row in of if row.time is not None and row.error is not None])
               for name, of in several.items()}
    middles = [middle for name, (middle, _, _) in medians.items() if name in {*ARITHMETICS, *SOLVERS}]  # of all scenes
    best = stairs(front(middles), (max(x for x, _ in middles), max(y for _, y in middles)))
    ends = {middle: name for name, (middle, _, _) in medians.items()}
    levels = {y: _level(y, ends[x, y]) for x, y in front(middles)}
    yield ChartSeries(FRONT, tuple((x, levels.get(y, y)) for x, y in best), through=True)
    for name, (middle, low, high) in medians.items():
        spot, *corners = ((x, _level(y, name)) for x, y in (middle, low, high))
        look = OWN if name in ARITHMETICS else SOLVERS_OWN if name in SOLVERS else RIVAL
        label = "" if isinstance(spot[1], str) else f"{name} ({len(several[name])})" if look is RIVAL else name
        yield ChartSeries(look, (spot,), ((corners[0], corners[1]),), label=label)


def details(rows: Sequence[MachineMeasure]) -> Chart:
    """The chart of every form in every scene."""
    close = replace(ERROR, pitch=4.0)
    panels = tuple(SubChart(f"{scene}, {question}", TIME, close, tuple(_marks(of)))
                   for question, every in group_rows(rows, "asked").items()
                   for scene, of in group_rows(every, "scene").items())
    title = "The machine: time against error, scene by scene"
    return Chart(title, DETAILS, panels, 6, (44.0, 44.0), (*_key(), *_rival_key(rows)))


def _marks(rows: Iterable[MachineMeasure]) -> Iterator[ChartSeries]:
    for row in rows:
        if row.time is not None and row.error is not None:
            yield ChartSeries(look(row), ((row.time, _level(row.error, row.arithmetic)),))


def _level(error: float, arithmetic: str) -> Place:
    """An error as a number, or the rail of the digits that are proven of it: all that its arithmetic promises."""
    rail = arithmetic if arithmetic in PROVEN else next((name for name, most in PROVEN.items() if error < most), "")
    return EXACT if error == 0 else rail if rail and error < PROVEN[rail] else error


def look(row: MachineMeasure) -> Look:
    """A measure's look: its arithmetic by the marker, its method by the colour, all but orthogonal plans hollow."""
    if row.arithmetic not in MARKERS:
        return RIVAL
    hollow = row.plan not in ("", MOTION_PLANS[0])
    return Look(COLOURS[row.form.split(", ")[0]], MARKERS[row.arithmetic], hollow=hollow, marker_mm=2.2)


def _key() -> Iterable[tuple[str, Look]]:
    yield from ((name, Look(GREY if name in SOLVERS else INK, marker, marker_mm=2.2))
                for name, marker in MARKERS.items())
    yield "form of the pose or of every method", Look(INK, area=True)
    yield from ((name, Look(COLOURS[name], area=True)) for name in ("auxiliary", "trial", "poles"))
    yield "hollow: polar plans, velocity triangles", Look(INK, "circle", hollow=True, marker_mm=2.2)


def _rival_key(rows: Iterable[MachineMeasure], more: str = "") -> Iterable[tuple[str, Look]]:
    """What the marks of other programs are, by their names, where there are any."""
    names = dict.fromkeys(row.arithmetic for row in rows if row.arithmetic not in MARKERS and row.time is not None)
    return ((f"other programs ({'; '.join(names)}){more}", RIVAL),) if names else ()
