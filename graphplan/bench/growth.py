"""Growth: the time of each stage of the work from four links to two thousand, and the number of steps.

The chains are a crank and dyads, each between a pivot of the frame and the rocker of the dyad before, which has two
equal arms. Each second four-bar is the one before it, turned by half a turn and driven from its other side: so all
rockers turn as the first two do, the chain travels as far as they, and velocities neither die away along it nor grow.

Times are told in single poses of the four-link chain that the analytic solver solves in the same round; all chains take
turns. A stage that takes too long for one chain is not tried on longer ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from graphplan.bench.picture import TIMING_ROUNDS, Axis, Chart, ChartSeries, Look, SubChart, ratios, spent
from graphplan.check.trusted import report
from graphplan.cycle import follow
from graphplan.design.decide import construct
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import FRAME, Find, Pair, Scene, TurningDrive, Units
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.plates.pens import BLUE, BROWN, GREEN, INK, RED, VIOLET
from graphplan.solver import poses, solve

LINKS = (4, 10, 20, 50, 100, 200, 500, 1000, 2000)
POSES = 1000  # evaluated at once
POSITIONS, TRAVEL = 36, (0.0, 20.0)  # that are followed, and how far, in degrees
# links from which an exponent is fitted: below, what is done once for any mechanism counts as well
MIN_FITTED_LINKS = 50
MIN_SECONDS, MAX_SECONDS = 0.02, 10.0  # of a measurement, and that a stage may take
CONSTRUCT, SOLVE, CHECK, FOLLOW, DRAW, EVALUATE = STAGES = (
    "construct", "solve", "check", "follow, a pose", "draw", "evaluate, a pose of many")
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
    """One stage for a chain of so many links: its time, between quartiles, and the steps of the program; or why there
    is no time."""

    links: int
    steps: int
    stage: str
    time: float | None
    low: float | None = None
    high: float | None = None
    why: str = ""


def stages(links: Sequence[int] = LINKS, rounds: int = TIMING_ROUNDS,
           tell: Callable[[str], None] = lambda said: None) -> Iterator[StageTime]:
    """Every stage of every chain, an even number of links each, four at least; all take turns. What is under way is
    told."""
    four, steps = poses.scene_in_poses(chain(1), {}, {}), dict[int, int]()
    runs: dict[tuple[int, str], tuple[Callable[[], object], int]] = {(0, ""): (lambda: solve(four), 1)}
    left_out = dict[str, str]()
    for count in links:
        tell(f"{count} links")
        drawing = construct(chain(count // 2 - 1))
        steps[count] = len(drawing.program) - drawing.program.givens
        for stage, run in _runs(drawing).items():
            if stage not in left_out and not (why := _hindrance(run[0])):
                runs[count, stage] = run
            else:
                left_out.setdefault(stage, why)
                yield StageTime(count, steps[count], stage, None, why=left_out[stage])
    times = ratios(runs, (0, ""), rounds, MIN_SECONDS, lambda done: tell(f"round {done + 1} of {rounds}"))
    for (count, stage), (low, middle, high) in times.items():
        if count:
            yield StageTime(count, steps[count], stage, middle, low, high)


def _hindrance(run: Callable[[], object]) -> str:
    """Why a stage cannot be measured; nothing where it can."""
    try:
        time = spent(run)
    except GraphplanError as refusal:
        return refusal.lines[0]
    return f"longer than {MAX_SECONDS:g} s" if time > MAX_SECONDS else ""


def _runs(drawing: Construction) -> dict[str, tuple[Callable[[], object], int]]:
    """What is done in each stage, and for how many poses."""
    scene = drawing.scene
    many = {name: np.full(POSES, complex(*map(float, at))) for name, at in scene.points.items()}
    return {
        CONSTRUCT: (lambda: construct(scene), 1), SOLVE: (lambda: solve(scene), 1), CHECK: (lambda: report(scene), 1),
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


_STROKES = ((INK, "circle", ()), (BLUE, "square", (2.4, 0.8)), (RED, "up", (0.6, 0.8)),
            (GREEN, "diamond", (2.4, 0.6, 0.4, 0.6)), (BROWN, "down", (3.2, 1.2)), (VIOLET, "plus", (1.2, 0.5)))
LOOKS = {stage: Look(colour, marker, marker_mm=2.2, width=0.3, dash=dash)
         for stage, (colour, marker, dash) in zip(STAGES, _STROKES, strict=True)}
SIZE = Axis("links", shows=(LINKS[0], 20 * LINKS[-1]))  # words stand behind the lines
TIME = Axis("time; 1 is one pose of four links solved", reference=1.0)
REMARKS = (
    "A crank and a chain of dyads; a program has {steps} steps. Times are medians and quartiles within one run, "
    "relative to the time that the analytic solver takes for one pose of four links; the powers of the number n of "
    f"links are fitted from {MIN_FITTED_LINKS} links."
)


def picture(rows: Sequence[StageTime]) -> Chart:
    """The chart of these stages."""
    lines = tuple(_line(rows, stage, look) for stage, look in LOOKS.items())
    remarks = REMARKS.format(steps=_steps(sorted({(row.links, row.steps) for row in rows})))
    return Chart("Growth with the number of links", remarks, (SubChart("", SIZE, TIME, lines),), 1, (240.0, 140.0), ())


def _line(rows: Sequence[StageTime], stage: str, look: Look) -> ChartSeries:
    """A stage's times with their quartiles, its exponent at the end of the line, and why it ends there."""
    timed = [row for row in rows if row.stage == stage and row.time]
    why = next((row.why for row in rows if row.stage == stage and row.why), "")
    power = exponent(rows, stage)
    label = stage if power is None else f"{stage}: n^{power:.2f}"
    return ChartSeries(look, tuple((row.links, row.time) for row in timed if row.time),
                       tuple(((row.links, row.low), (row.links, row.high)) for row in timed if row.low and row.high),
                       label=f"{label} ({why.split(': ')[-1].split(';')[0]})" if why else label)


def _steps(counts: Sequence[tuple[int, int]]) -> str:
    """The steps as a straight line over the links."""
    if len(counts) < 2:
        return str(counts[0][1]) if counts else "no"
    links, steps = np.array(counts, float).T
    slope, intercept = np.polyfit(links, steps, 1)
    return f"{slope:.4g} n {'+' if intercept > 0 else '−'} {abs(intercept):.4g}"
