"""Growth: the time of each stage of the work, and the number of steps, from four links to a thousand.

The chains are a crank and dyads, each between a pivot of the frame and the joint of the dyad before. All rockers are of
one length and stand aslant by turns to the right and to the left, so that all turn equally fast: velocities neither die
away along the chain nor grow.

Times are told in single poses of the four-link chain that the analytic solver solves in the same round.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from graphplan.accuracy.survey.picture import Axis, Chart, Look, Series, SubChart
from graphplan.accuracy.survey.timing import ROUNDS, ratios
from graphplan.mechanism.model import FRAME, Find, Pair, Scene, TurningDrive, Units
from graphplan.methods.construct import construct
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner
from graphplan.sheet.plates.pens import BLUE, BROWN, GREEN, INK, RED
from graphplan.solver import poses, solve

LINKS = (4, 10, 20, 50, 100, 200, 500, 1000)
POSES = 1000  # evaluated at once
LONG = 50  # links from which an exponent is fitted: below, what is done once for any mechanism counts as well
STAGES = ("planning", "construction", "first replay", "pose in blocks", "pose by replay")
UNIT = "four links solved"
ACROSS, UP, PITCH = 3, 4, 10  # of a rocker; from one pivot to the next


def chain(dyads: int) -> Scene:
    """A crank and so many dyads: twice as many links, and the crank and the frame. All joints are asked for."""
    points: dict[str, Pair] = {}
    links: dict[str, tuple[str, ...]] = {}
    for k in range(dyads + 1):
        across = -ACROSS if k % 2 else ACROSS
        points[f"R{k}"] = Fraction(PITCH * k), Fraction(0)
        points[f"P{k}"] = Fraction(PITCH * k + across), Fraction(UP)
        if k:
            links[f"{2 * k}"] = f"P{k - 1}", f"P{k}"
        links[f"{2 * k + 1}"] = f"R{k}", f"P{k}"
    links[FRAME] = tuple(f"R{k}" for k in range(dyads + 1))
    joints = tuple(f"P{k}" for k in range(dyads + 1))
    return Scene(
        title=f"Chain of {2 * dyads + 2} links", source="", name=f"chain of {2 * dyads + 2} links", units=Units(),
        points=points, placements={}, links=links, motions={}, find=Find(joints, joints),
        written=(TurningDrive("1", FRAME, Fraction(1), Fraction(0)),),
    )


@dataclass(frozen=True)
class Stage:
    """One stage for a chain of so many links: its time, between quartiles, and the steps of the program."""

    links: int
    steps: int
    stage: str
    time: float
    low: float
    high: float


def stages(links: Sequence[int] = LINKS, rounds: int = ROUNDS) -> Iterator[Stage]:
    """Every stage of every chain; an even number of links each, four at least."""
    four = poses.posed(chain(1), {}, {})
    for count in links:
        runs, steps = _runs(chain(count // 2 - 1))
        times = ratios({**runs, UNIT: (lambda: solve(four), 1)}, UNIT, rounds)
        for stage in runs:
            low, middle, high = times[stage]
            yield Stage(count, steps, stage, middle, low, high)


def _runs(scene: Scene) -> tuple[dict[str, tuple[Callable[[], Any], int]], int]:
    """What is done in each stage, for how many poses, and the steps of the program.

    A replay is written down at its first pose: a copy of the construction has none yet.
    """
    drawing = construct(scene)
    places = {name: complex(*map(float, at)) for name, at in scene.points.items()}
    many = {name: np.full(POSES, z) for name, z in places.items()}
    drawing.evaluate(many)
    drawing.replay(places)
    done: tuple[tuple[Callable[[], Any], int], ...] = (
        (lambda: Planner(Network(scene), "").plan(), 1), (lambda: construct(scene), 1),
        (lambda: replace(drawing).replay(places), 1), (lambda: drawing.evaluate(many), POSES),
        (lambda: drawing.replay(places), 1))
    return dict(zip(STAGES, done, strict=True)), len(drawing.program) - drawing.program.givens


def exponent(rows: Sequence[Stage], stage: str) -> float:
    """The power of the number of links with which the time of a stage grows, fitted where chains are long."""
    long = [row for row in rows if row.stage == stage and row.links >= LONG]
    return float(np.polyfit(np.log([row.links for row in long]), np.log([row.time for row in long]), 1)[0])


LOOKS = {stage: Look(colour, marker, size=1.8, width=0.25, dash=dash) for stage, (colour, marker, dash) in zip(STAGES, (
    (INK, "circle", ()), (BLUE, "square", (2.4, 0.8)), (RED, "up", (0.6, 0.8)),
    (GREEN, "diamond", (2.4, 0.6, 0.4, 0.6)), (BROWN, "down", (3.2, 1.2))), strict=True)}
STEPS = Look(INK, "circle", hollow=True, size=1.8, width=0.25)
REMARKS = (
    "A crank and a chain of dyads. Times are medians within one run, in the time that the analytic solver takes "
    "for one pose of the four-link chain, with the quartiles; a first replay writes the replay down. The "
    f"exponents are those of powers fitted from {LONG} links."
)


def picture(rows: Sequence[Stage]) -> Chart:
    """The chart of these stages."""
    times = SubChart("time", Axis("links"), Axis("time, in single poses of four links solved"), tuple(
        Series(look, tuple((row.links, row.time) for row in rows if row.stage == stage),
               tuple(((row.links, row.low), (row.links, row.high)) for row in rows if row.stage == stage))
        for stage, look in LOOKS.items()))
    counts = sorted({(row.links, row.steps) for row in rows})
    steps = SubChart("size of the program", Axis("links"), Axis("steps"), (Series(STEPS, tuple(counts)),))
    return Chart("Growth with the number of links", REMARKS, (times, steps), 2, (120.0, 90.0),
                 (*((_told(rows, stage), look) for stage, look in LOOKS.items()), (_steps(counts), STEPS)))


def _told(rows: Sequence[Stage], stage: str) -> str:
    """A stage with its exponent, where there are chains enough for one."""
    if len({row.links for row in rows if row.links >= LONG}) < 2:
        return stage
    return f"{stage}: n^{exponent(rows, stage):.2f}"


def _steps(counts: Sequence[tuple[int, int]]) -> str:
    """The steps as a straight line over the links."""
    if len(counts) < 2:
        return "steps"
    links, steps = zip(*counts, strict=True)
    slope, rest = np.polyfit(links, steps, 1)
    return f"steps: {slope:.4g} n {'+' if rest > 0 else '−'} {abs(rest):.4g}"
