"""Growth: the time of each stage of the work from four links to two thousand, and the number of steps.

The chains are a crank and dyads, each between a pivot of the frame and the rocker of the dyad before, which has two
equal arms. Each second four-bar is the one before it, turned by half a turn and driven from its other side: so all
rockers turn as the first two do, the chain travels as far as they, and velocities neither die away along it nor grow.

Times are told in single poses of the four-link chain that the analytic solver solves in the same run; all chains take
turns. A stage that takes too long for one chain is not tried on longer ones.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import groupby, zip_longest

import numpy as np

from graphplan.bench.rows import TIMING_ROUNDS, alternate_runs, spent
from graphplan.check.trusted import report
from graphplan.cycle import follow
from graphplan.design.decide import candidates, construct, general_construction
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import FRAME, Find, Pair, Scene, TurningDrive, Units
from graphplan.methods.construction import Construction
from graphplan.output import diagrams
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout
from graphplan.solver import poses, solve

LINKS = (4, 10, 20, 50, 100, 200, 500, 1000, 2000)
POSES = 1000  # evaluated at once
POSITIONS, TRAVEL = 36, (0.0, 20.0)  # that are followed, and how far, in degrees
# links from which an exponent is fitted: below, what is done once for any mechanism counts as well
MIN_FITTED_LINKS = 50
MIN_SECONDS, MAX_SECONDS = 0.02, 10.0  # of a measurement, and that a stage may take
CONSTRUCT, PROGRAM, SOLVE, CHECK, FOLLOW, DRAW, EVALUATE = STAGES = (
    "choose and construct", "construct", "solve", "check", "follow, a pose", "draw", "evaluate, a pose of many")
UNIT = "four links solved"
ROCKER_X, ROCKER_Y, PIVOT_PITCH = 1, 5, 10  # of a rocker's arm; from one pivot to the next


def chain(dyads: int) -> Scene:
    """A crank and so many dyads: twice as many links, and the crank and the frame. All joints are asked for."""
    points: dict[str, Pair] = {}
    links: dict[str, tuple[str, ...]] = {}
    for k in range(dyads + 1):
        pivot, (x, y) = Fraction(PIVOT_PITCH * k), (ROCKER_X, ROCKER_Y if k % 2 == 0 else -ROCKER_Y)
        points[f"R{k}"] = pivot, Fraction(0)
        if k:
            points[f"S{k}"] = pivot - x, Fraction(-y)
            links[f"{2 * k}"] = f"P{k - 1}", f"S{k}"
        points[f"P{k}"] = pivot + x, Fraction(y)
        links[f"{2 * k + 1}"] = tuple(name for name in (f"R{k}", f"S{k}", f"P{k}") if name in points)
    links[FRAME] = tuple(f"R{k}" for k in range(dyads + 1))
    joints = tuple(name for name in points if name not in links[FRAME])
    return Scene(
        title=f"Chain of {2 * dyads + 2} links", source="", name=f"chain of {2 * dyads + 2} links", units=Units(),
        points=points, placements={}, links=links, motions={}, find=Find(joints, joints),
        written=(TurningDrive("1", FRAME, Fraction(1), Fraction(0)),),
    )


@dataclass(frozen=True)
class StageTime:
    """One stage for a chain of so many links: its time, from the fastest round to the median, and the steps of the
    program; or why there is no time. `weighed` is how many designs are drawn and weighed until one is chosen."""

    links: int
    steps: int
    stage: str
    time: float | None
    low: float | None = None
    high: float | None = None
    why: str = ""
    weighed: int = 0


def stages(links: Sequence[int] = LINKS, rounds: int = TIMING_ROUNDS,
           tell: Callable[[str], None] = lambda said: None) -> Iterator[StageTime]:
    """Every stage of every chain, an even number of links each, four at least; all take turns. What is under way is
    told."""
    four, steps, weighed = poses.scene_in_poses(chain(1), {}, {}), dict[int, int](), dict[int, int]()
    runs: dict[tuple[int, str], tuple[Callable[[], object], int]] = {(0, ""): (lambda: solve(four), 1)}
    left_out = dict[str, str]()
    for count in links:
        tell(f"{count} links")
        drawing = construct(chain(count // 2 - 1))
        weighed[count] = sum(bool(candidate.cost.amounts) for candidate in candidates(drawing.scene))
        steps[count] = len(drawing.program) - drawing.program.givens
        for stage, run in _runs(drawing).items():
            if stage not in left_out and not (why := _hindrance(run[0])):
                runs[count, stage] = run
            else:
                left_out.setdefault(stage, why)
                yield StageTime(count, steps[count], stage, None, why=left_out[stage], weighed=weighed[count])
    seconds = alternate_runs({key: run for key, (run, _) in runs.items()}, rounds, MIN_SECONDS,
                             lambda done: tell(f"round {done + 1} of {rounds}"))
    unit = min(seconds.pop((0, "")))
    for (count, stage), times in seconds.items():
        fastest, middle = (time / unit / runs[count, stage][1] for time in (min(times), statistics.median(times)))
        yield StageTime(count, steps[count], stage, fastest, fastest, middle, weighed=weighed[count])


def _hindrance(run: Callable[[], object]) -> str:
    """Reason why a stage cannot be measured; empty if it can."""
    try:
        time = spent(run)
    except GraphplanError as refusal:
        return refusal.lines[0]
    return f"longer than {MAX_SECONDS:g} s" if time > MAX_SECONDS else ""


def _runs(drawing: Construction) -> dict[str, tuple[Callable[[], object], int]]:
    """Functions of each stage, and their numbers of poses."""
    scene = drawing.scene
    many = {name: np.full(POSES, complex(*map(float, at))) for name, at in scene.points.items()}
    return {
        CONSTRUCT: (lambda: construct(scene), 1), PROGRAM: (lambda: general_construction(scene), 1),
        SOLVE: (lambda: solve(scene), 1), CHECK: (lambda: report(scene), 1),
        FOLLOW: (lambda: follow(scene, POSITIONS, TRAVEL), POSITIONS),
        DRAW: (lambda: layout(compose(replace(drawing))), 1),
        EVALUATE: (lambda: drawing.evaluate(many), POSES)}


def exponent(rows: Sequence[StageTime], stage: str) -> float | None:
    """The power of the number of links with which the time of a stage grows, fitted where chains are long, three at
    least."""
    long = [(row.links, row.time) for row in rows if row.stage == stage and row.links >= MIN_FITTED_LINKS and row.time]
    if len(long) < 3:
        return None
    links, times = np.log(np.array(long, float)).T
    return float(np.polyfit(links, times, 1)[0])


LOOKS = {stage: {"color": colour, "marker": marker, "linestyle": dash} for stage, colour, marker, dash in zip(
    STAGES, diagrams.COLOURS, diagrams.MARKERS, diagrams.DASHES, strict=False)}
REMARKS = (
    "A crank and a chain of dyads; a program has {steps} steps. Times are the fastest of the rounds of one run, with "
    "a bar to the median, relative to what the analytic solver takes for one pose of four links; the powers of the "
    f"number n of links are fitted from {MIN_FITTED_LINKS} links. Choosing a design, and with it the check, jumps "
    "where the number of designs that are weighed does (see the foot); constructing a given one does not."
)


@diagrams.in_style
def picture(rows: Sequence[StageTime]) -> diagrams.Figure:
    """Return the chart of these stages."""
    remarks = REMARKS.format(steps=_steps(sorted({(row.links, row.steps) for row in rows})))
    figure, [axes] = diagrams.page("Growth with the number of links", remarks, [diagrams.Heading("")],
                                   (200.0, 130.0), 1, diagrams.Margins(left=26.0, right=88.0))
    timed = [row for row in rows if row.time]
    labels = [_draw_stage(axes, stage, [row for row in rows if row.stage == stage]) for stage in STAGES]
    links, times = [row.links for row in timed] or [1, 10], [row.time or 1.0 for row in timed] or [1.0]
    diagrams.ratio_axis(axes.xaxis, min(links), max(links), readings=12)
    diagrams.logarithmic(axes.yaxis, min(times), max(times))
    axes.set(xlabel="links", ylabel="time; 1 is one pose of four links solved")
    _draw_weighed(axes, rows)
    diagrams.end_labels(axes, [label for label in labels if label])
    return figure


def _draw_stage(axes: diagrams.Axes, stage: str, rows: Sequence[StageTime]) -> diagrams.SeriesLabel | None:
    """Draw a stage's times up to the medians; return its name with its exponent, and why its line ends there."""
    timed = [row for row in rows if row.time]
    why = next((row.why for row in rows if row.why), "")
    power = exponent(rows, stage)
    axes.plot([row.links for row in timed], [row.time or 0.0 for row in timed], gid=stage, **LOOKS[stage])
    for row in timed:
        if row.low and row.high:  # other work on the machine only adds to a time
            axes.plot([row.links] * 2, [row.low, row.high], color=LOOKS[stage]["color"])
    words = (stage if power is None else f"{stage}: n^{power:.2f}") + (
        f" ({why.split(': ')[-1].split(';')[0]})" if why else "")
    if not timed:
        return None
    return diagrams.SeriesLabel(timed[-1].links, timed[-1].time or 0.0, words, str(LOOKS[stage]["color"]))


def _draw_weighed(axes: diagrams.Axes, rows: Sequence[StageTime]) -> None:
    """Write at the foot of the chart how many designs are weighed for chains of which lengths."""
    weighed = sorted({row.links: row.weighed for row in rows}.items())
    stretches = [(count, [links for links, _ in of]) for count, of in groupby(weighed, key=lambda pair: pair[1])]
    for (count, links), following in zip_longest(stretches, stretches[1:]):
        words = f"{count} design{'s' * (count != 1)}\nweighed" if count else "none weighed:\ntoo long for a sheet"
        axes.annotate(words, (math.sqrt(links[0] * links[-1]), 0.015), color=diagrams.GREY,
                      ha="center", xycoords=("data", "axes fraction"))
        if following:
            axes.axvline(math.sqrt(links[-1] * following[1][0]), color=diagrams.GREY, linestyle=diagrams.DASHES[5])


def _steps(counts: Sequence[tuple[int, int]]) -> str:
    """Return the steps as a straight line over the links."""
    if len(counts) < 2:
        return str(counts[0][1]) if counts else "no"
    links, steps = np.array(counts, float).T
    slope, intercept = np.polyfit(links, steps, 1)
    return f"{slope:.4g} n {'+' if intercept > 0 else '−'} {abs(intercept):.4g}"
