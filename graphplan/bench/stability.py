"""The atlas of special poses: how far off each way is on the way there, on the machine and on the drawing board.

A way is *drawn* where every mark is made from those before it by the rule of its own movement, crossings and all: an
auxiliary point far away costs digits. The *value rule* computes the same compounds without their inner marks. Both, and
the *solver*, take floats; `solve` takes what proves nine digits, and its answer is the product's. A *pencil* draws with
expected errors of first order, each plan as large as its paper allows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, cycle, groupby, pairwise
from typing import Any

import numpy as np

from graphplan.accuracy.expected import first_order
from graphplan.accuracy.tolerances import EPSILON, MIN_ERROR
from graphplan.bench.problem import (
    DEGENERACIES,
    FALSE,
    ORTHOGONAL,
    POLAR,
    POLES,
    WAYS,
    Degeneracy,
    Results,
    largest_error,
)
from graphplan.bench.rows import group_rows
from graphplan.check.arithmetics import Exact
from graphplan.check.compared import UNBOUNDED
from graphplan.check.report import ReferenceSolution, reference_solution
from graphplan.check.trusted import report
from graphplan.design.cost import readings
from graphplan.design.decide import construct
from graphplan.design.hand import Pencil, hand
from graphplan.errors import GraphplanError, Refused
from graphplan.kernel.kinds import POINT, Movement, plain
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import evaluate
from graphplan.mechanism.model import Scene
from graphplan.methods.construction import Construction
from graphplan.methods.design import OPEN, Design
from graphplan.methods.kinds import VELOCITY
from graphplan.output import diagrams
from graphplan.phrases import join
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.plates.plans import Plans
from graphplan.solver import reactions, solve

DISTANCES = (*(10.0 ** (-k / 2) for k in range(33)), 0.0)  # 1, 0.3, 0.1, ... 1e-16, and the special pose itself
PLAN_WIDTH_MM = 250.0  # mm: how large each plan is drawn by pencil

SHEET, VALUE, SOLVER, SOLVE = "the pose's own", "value rule", "solver", "solve"
DRAWN, PENCIL, COMPUTED = "drawn in floats", "drawn by pencil", "computed"


@dataclass(frozen=True)
class Sample:
    """One way at one distance: the largest error of any number relative to the largest of its kind, or the reason why
    it fails.

    `how` it is found is one of DRAWN, PENCIL, COMPUTED; `told` says of the pose's own way in which form it is drawn,
    and of `solve` in which arithmetic. `condition` is that of the mechanism in floats, infinite where these hold it for
    singular.
    """

    degeneracy: str
    way: str
    how: str
    distance: float
    condition: float
    error: float | None
    told: str = ""


def samples(*degeneracies: Degeneracy, distances: Sequence[float] = DISTANCES,
            pencil: Pencil | None = None) -> Iterator[Sample]:
    """Every way at every distance from special poses."""
    for degeneracy in degeneracies:
        for d in distances:
            pose = ProbedPose(degeneracy.scene_at(d), pencil or Pencil())
            choices = {SHEET: OPEN, **{name: WAYS[name] for name in degeneracy.compared_ways}}
            for name, how, error, remark in pose.measure(choices):
                yield Sample(degeneracy.name, name, how, d, pose.condition, error, remark)


Found = tuple[float | None, str]  # an error, and what is told of it; or none, and why
SINGULAR = "the pose is singular"


class ProbedPose:
    """A scene in one pose: what is true of it, and what the solver says in floats; neither where it is singular."""

    def __init__(self, scene: Scene, pencil: Pencil):
        self.scene, self.pencil = scene, pencil
        self.truth = _or_none(lambda: reference_solution(scene, Exact()))
        self.floats = _or_none(lambda: _in_floats(scene))

    @property
    def condition(self) -> float:
        """The condition of the mechanism: of its rates, and of its reactions where there are loads."""
        solution = self.floats
        return max(solution.rates.condition, solution.reactions.condition if solution.reactions
                   else 1.0) if solution else math.inf

    def measure(self, ways: Mapping[str, Design]) -> Iterator[tuple[str, str, float | None, str]]:
        """Each way with how it is found, its error, and what is told of it."""
        for name, choices in ways.items():
            for how, (error, remark) in self._drawing_errors(name, choices).items():
                if how != COMPUTED:
                    yield name, how, error, remark
                elif name == SHEET:
                    yield VALUE, how, error, remark
        yield SOLVER, COMPUTED, *self._error_of(lambda: (self._solver_results(), 0, ""))
        yield SOLVE, COMPUTED, *self._error_of(self._answer)

    def _drawing_errors(self, way: str, choices: Design) -> dict[str, Found]:
        """One way as it is drawn in floats and by pencil, and by its value rules."""
        try:
            drawing = construct(self.scene, choices)
            form = form_of(drawing)
        except GraphplanError as refusal:
            return dict.fromkeys((DRAWN, PENCIL, COMPUTED), (None, refusal.lines[0]))
        if refused := why_not_drawn_so(drawing, way):
            return dict.fromkeys((DRAWN, PENCIL), (None, refused))
        return {DRAWN: self._error_of(lambda: (as_drawn(drawing), drawing.rounds, form)),
                PENCIL: by_pencil(drawing, self.pencil) if self.truth else (None, SINGULAR),
                COMPUTED: self._error_of(lambda: (drawing.read(Floats()), drawing.rounds, form))}

    def _error_of(self, read: Callable[[], tuple[Results, int, str]]) -> Found:
        """The error of what is read, after so many rounds of friction, and what is told of it."""
        if self.truth is None:
            return None, SINGULAR
        try:
            results, rounds, remark = read()
            bounded = {kind: named for kind, named in results.items() if kind not in UNBOUNDED}
            return largest_error(bounded, self.truth.truth(bounded, rounds)), remark
        except GraphplanError as refusal:
            return None, refusal.lines[0]
        except (ValueError, OverflowError):  # of what is not a number, or beyond all
            return None, "beyond floats"

    def _solver_results(self) -> Results:
        """The solver's results in floats."""
        if self.floats is None:
            raise Refused(self.scene.name, "the pose is singular in floats", "fractions")
        return self.floats.truth({})

    def _answer(self) -> tuple[Results, int, str]:
        """Results of `solve`, and the arithmetic in which they are found."""
        answer = report(self.scene, alone=True)
        return answer.results, answer.drawing.rounds, answer.arithmetic


def _in_floats(scene: Scene) -> ReferenceSolution:
    if scene.loads is None:
        return ReferenceSolution(scene, solve(scene))
    forces = reactions(scene)
    return ReferenceSolution(scene, forces.rates, forces, lambda rounds: forces)


def _or_none(find: Callable[[], ReferenceSolution]) -> ReferenceSolution | None:
    try:
        return find()
    except GraphplanError:
        return None


def form_of(drawing: Construction) -> str:
    """The form of a construction that its pose decides: that of its loci, of its forces, or of its plans."""
    method = drawing.method
    if drawing.ways or any(step.choice and step.choice.compound.weighed for step in drawing.drawn.steps):
        return method[VELOCITY][0]
    return join(method["force"]) if "force" in method else ORTHOGONAL if drawing.turned else POLAR


def as_drawn(drawing: Construction) -> Results:
    """Results read off the drawing, each mark made in floats from those before it."""
    results: dict[str, dict[str, Any]] = {}
    for reading, _, value in readings(drawing, evaluate(drawing.drawn, Floats()), Floats()):
        results.setdefault(reading.kind, {})[reading.of] = value
    return results


def why_not_drawn_so(drawing: Construction, way: str) -> str:
    """Why a construction is not drawn in the way that is asked for, if it is not: it is the next best one."""
    if way in (POLES, FALSE) and not any(way in form for form in drawing.ways):
        return f"no {way}: {join(drawing.ways)}"
    wishes = drawing.design
    for step in drawing.drawn.steps:
        wished_form = wishes.form_on(step.panel)
        if step.choice and wished_form in {*map(plain, step.choice.compound.forms)} - {plain(step.choice.best.form)}:
            return f"no {wished_form} at step {drawing.drawn.number(step.index)}: {step.choice.best.form}"
    return ""


def by_pencil(drawing: Construction, pencil: Pencil, plan_mm: float = PLAN_WIDTH_MM) -> Found:
    """The expected error of a drawing by pencil, relative to the largest of its kind.

    Each plan is drawn so many mm wide, with all its marks. None where points that a line is drawn through fall together
    on paper, or the error is as large as what is drawn.
    """
    program, values, plans = drawing.drawn, drawing.values, Plans(drawing).plan_of_step
    points: dict[str, list[complex]] = {}
    for step in program.steps:
        if step.op.gives == POINT:
            points.setdefault(plans[step.index], []).append(complex(*values[step.index]))
    units = {plan: max(np.ptp(np.real(at)), np.ptp(np.imag(at))) / plan_mm or 1.0 for plan, at in points.items()}
    lines = [step.args for step in program.steps if step.op.movement is Movement.RULED]
    point_marks = {step.name: step.index for step in program.steps[: program.givens]}
    lines += [(point_marks[P], point_marks[R]) for joints in drawing.scene.links.values()
              for P, R in combinations(joints, 2) if P in point_marks and R in point_marks]
    for P, R in lines:
        if 0 < math.dist(values[P], values[R]) < pencil.point * units[plans[R]]:
            return None, f"{program.text(P)} and {program.text(R)} fall together on paper"
    results = first_order(drawing, hand(drawing, units.__getitem__, pencil), Scales(1.0, 1.0, "mm", {}))
    error = max((result.relative or (result.deviation.value and math.inf) for result in results), default=0.0)
    return (error, "") if error < 1 else (None, "the error is as large as what is drawn")


# ---- the picture ----------------------------------------------------------------------------------------------------

MAX_LOST_ROUNDINGS = 100  # roundings of the mechanism's own condition that the default may lose
NOTABLE_RATIO = 30.0  # times: by so much is a way worse than another
D_ZERO, D_END = 10.0 ** -19, 10.0 ** -20  # where d = 0 stands on the axis of distances, and where that axis ends
NOT_DRAWN = 1e3, 1e6  # where the marks of the two ways stand that are not drawn
# under the errors: the sheet's form and solve's arithmetic
STRIPS = {SHEET: (10.0 ** -21, 10.0 ** -18), SOLVE: (10.0 ** -24, 10.0 ** -21)}
TOP, BOTTOM = 10.0 ** 8, 10.0 ** -24  # the ends of the axis of errors
ERRORS = {10.0 ** k: diagrams.power(10.0 ** k) for k in range(-16, 1, 4)}
SECTIONS = {"not drawn": math.sqrt(NOT_DRAWN[0] * NOT_DRAWN[1]), "sheet": 10**-19.5, SOLVE: 10**-22.5}
ON_PAPER = {1.0: "100 mm", 1e-2: "1 mm", 1e-4: "10 µm", 1e-8: "1 nm"}  # an error of a vector 100 mm long
FAR = {10.0 ** -k: diagrams.power(10.0 ** -k) for k in range(0, 16, 3)}
PAIR: tuple[dict[str, Any], ...] = (
    {"color": diagrams.BLUE, "marker": "o"},
    {"color": diagrams.VERMILION, "marker": "^", "markerfacecolor": "white"})
TINTS = "#f2f2f2", "#dcdcdc", "#c8c8c8", "#b4b4b4"
CONDITION: dict[str, Any] = {"color": "#bdbdbd", "linewidth": 1.1 * diagrams.MM}
LOOKS: dict[str, dict[str, Any]] = {
    VALUE: {"color": diagrams.GREEN, "marker": "D", "markersize": 1.3 * diagrams.MM, "markerfacecolor": "white"},
    SOLVER: {"color": diagrams.PURPLE, "marker": "P", "markersize": 1.5 * diagrams.MM, "linestyle": diagrams.DASHES[2]},
    SOLVE: {"color": diagrams.BLACK, "linewidth": 0.7 * diagrams.MM},
}
DOTTED: dict[str, Any] = {"linestyle": diagrams.DASHES[5], "linewidth": 0.5 * diagrams.MM}
REMARKS = (
    "Each panel approaches a special pose, d = 0 at the right; its words say what fails and why. Upwards: the largest "
    "error of any number, relative to the largest of its kind; on the right the same in mm of paper, for a vector 100 "
    "mm long. Lines with marks: two ways of drawing, every mark computed in floats from the marks before it. Dotted: "
    "both of them, and the form chosen for the pose, drawn with {pencil}, to first order on plans 250 mm across, where "
    "the error is below 1. Below: the form in which the sheet of the pose is drawn, and the arithmetic in which solve "
    "answers: floats, proven digits or fractions (p/q); white: the pose is singular. Condition: that of the mechanism, "
    "times 2.2e-16, the error that floats may have."
)


@diagrams.in_style
def picture(rows: Sequence[Sample], pencil: str = "") -> diagrams.Figure:
    """Return the atlas of these samples, drawn by this pencil."""
    sweeps = {sweep.name: sweep for sweep in DEGENERACIES}
    samples_of = group_rows(rows, "degeneracy")
    headings = [diagrams.Heading(name, sweeps[name].words) for name in samples_of]
    remarks = REMARKS.format(pencil=pencil or Pencil().description)
    figure, panels = diagrams.page("Where methods fail, and which works there", remarks, headings, (98.0, 88.0), 4,
                          diagrams.Margins(left=24.0, right=22.0, foot=8.0))
    for axes, (name, of) in zip(panels, samples_of.items(), strict=True):
        _Panel(axes, sweeps[name], of).draw()
    diagrams.foot_legend(figure, [
        *(diagrams.look(**{"label": f"{way}, in floats" if way != SOLVE else "answer of solve", "linestyle": "-"}
                        | style) for way, style in LOOKS.items()),
        diagrams.look(label="form chosen for the pose, by pencil", color=diagrams.BLACK, **DOTTED),
        diagrams.look(label="the two ways, by pencil", color=diagrams.BLUE, **DOTTED),
        diagrams.look(label="condition", linestyle="-", **CONDITION)], 6)
    return figure


class _Panel:
    """One way to a special pose: what it must cost, each way's error, and below what serves."""

    def __init__(self, axes: diagrams.Axes, sweep: Degeneracy, rows: Sequence[Sample]):
        self.axes, self.ways = axes, sweep.compared_ways
        self.rows = {(row.way, row.how, row.distance): row for row in rows}
        self.distances = sorted({row.distance for row in rows}, reverse=True)
        self.errors = {(way, how): {d: max(error, MIN_ERROR) for d in self.distances
                                    if (row := self.rows.get((way, how, d))) and (error := row.error) is not None}
                       for way, how in {(row.way, row.how): 0 for row in rows}}

    def draw(self) -> None:
        """Draw all of it, with the names of the two ways last, where there is room."""
        self._set_axes()
        condition = {d: EPSILON * row.condition for (_, _, d), row in self.rows.items()
                     if d and row.condition < math.inf}
        self.axes.plot([*condition], [*condition.values()], **CONDITION)
        self._line(SHEET, PENCIL, color=diagrams.BLACK, **DOTTED)
        for level, way, style in zip(NOT_DRAWN, self.ways, PAIR, strict=True):
            self._line(way, PENCIL, color=style["color"], **DOTTED)
            self._line(way, DRAWN, **style)
            missing = [d or D_ZERO for d in self.distances if d not in self.errors[way, DRAWN]]
            self.axes.plot(missing, [level] * len(missing), linestyle="none", gid=f"{way}, not drawn", **style)
        for way, style in LOOKS.items():
            self._line(way, COMPUTED, **style)
        self._strip(SOLVE, {d: _arithmetic(self.rows[SOLVE, COMPUTED, d]) for d in self.distances})
        self._strip(SHEET, {d: "" if (row := self.rows[SHEET, DRAWN, d]).error is None else row.told
                            for d in self.distances})
        diagrams.place_labels(self.axes, [label for place in (0, 1) for label in self._way_label(place)])

    def _set_axes(self) -> None:
        axes, ticks = self.axes, {**ERRORS, **{place: name for name, place in SECTIONS.items()}}
        axes.set(xscale="log", yscale="log", xlim=(3.0, D_END), ylim=(BOTTOM, TOP), xlabel="distance d from the pose")
        diagrams.set_readings(axes.xaxis, {**FAR, D_ZERO: "0"})
        diagrams.set_readings(axes.yaxis, ticks)
        axes.axvline(math.sqrt(D_ZERO * min(d for d in self.distances if d)), color=diagrams.GREY)
        for level in (NOT_DRAWN[0] / 30, STRIPS[SHEET][1]):
            axes.axhline(level, color=diagrams.GREY)
        for error, words in ON_PAPER.items():
            axes.annotate(words, (1.0, error), (1.5 * diagrams.MM, 0.0), xycoords=("axes fraction", "data"),
                          textcoords="offset points", va="center", annotation_clip=False)

    def _line(self, way: str, how: str, **style: Any) -> None:
        """Draw the error of a way, with a gap where there is none between."""
        errors = self.errors[way, how]
        far = [d for d in self.distances if d]
        self.axes.plot(far, [errors.get(d, math.nan) for d in far], gid=f"{way}, {how}", **style)
        if 0.0 in errors:
            self.axes.plot([D_ZERO], [errors[0.0]], **{"marker": "_", **style})

    def _way_label(self, place: int) -> Iterator[diagrams.SeriesLabel]:
        """Yield the name of a way: halfway where it is worse than the other, else towards its end."""
        way, rival = self.ways[place], self.errors[self.ways[1 - place], DRAWN]
        mine = self.errors[way, DRAWN]
        apart = [d for d in mine if d and mine[d] > NOTABLE_RATIO * rival.get(d, math.inf)]
        distances = apart or [d for d in mine if d]
        if distances:
            at = distances[len(distances) // 2 if apart else (len(distances) - 1) * (1 + place) // 3]
            yield diagrams.SeriesLabel(at, mine[at], way, str(PAIR[place]["color"]))

    def _strip(self, strip: str, told: Mapping[float, str]) -> None:
        """Draw what serves from where to where, in words on tints; white where the pose is singular."""
        tints = dict(zip(dict.fromkeys(filter(None, told.values())), cycle(TINTS)))
        far = [d for d in self.distances if d]
        ends = [*far[:1], *(math.sqrt(here * beyond) for here, beyond in pairwise(far)), *far[-1:]]
        bars = [(told[far[places[0]]], (ends[places[0]], ends[places[-1] + 1]))
                for places in (list(of) for _, of in groupby(range(len(far)), key=lambda k: told[far[k]]))]
        if 0.0 in told:
            bars.append((told[0.0], (D_ZERO * 4, D_ZERO / 4)))
        for words, across in bars:
            diagrams.stretch(self.axes, across, STRIPS[strip], words or "no",
                             facecolor=tints[words] if words else "white", edgecolor=diagrams.GREY,
                             linewidth=0.13 * diagrams.MM, gid=f"{strip}: {words or 'no'}")


def _arithmetic(row: Sample) -> str:
    """Return the arithmetic of an answer in short; empty where it is refused."""
    if row.error is None:
        return ""
    return "p/q" if row.told == "fractions" else row.told.removeprefix("enclosures of ")
