"""The velocities and accelerations of a scene from one linear system: the second opinion on every construction."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

from graphplan.errors import SingularPose
from graphplan.mechanism.equations import Elimination
from graphplan.mechanism.model import FRAME, Number, Pair, Scene, Slide
from graphplan.mechanism.numbers import dot, minus, times
from graphplan.mechanism.pairs.pair import PairSides, Rate
from graphplan.solver.equations import Equations, Solution, motion_equations

if TYPE_CHECKING:
    from graphplan.solver.floating import Floating


@dataclass(frozen=True)
class Rates(Solution):
    """What moves how in one pose: true vectors in scene units, rad and s; floats, or fractions where asked for.

    `velocity` and `acceleration`: (x, y) of every point of a link. `omega` and `alpha`: of every moving link.
    `slide_velocity` and `slide_acceleration`: of a slide's point `at` relative to the guide, by the slide's name.
    """

    velocity: dict[str, Pair]
    acceleration: dict[str, Pair]
    omega: dict[str, Number]
    alpha: dict[str, Number]
    slide_velocity: dict[str, Pair]
    slide_acceleration: dict[str, Pair]


def solve(scene: Scene, exact: bool = False) -> Rates:
    """The rates of every point, link and slide of the scene, in scene units, rad and s; with `exact` as fractions.

    Fails with `Refused` where fractions are asked of an irrational scene, and with `SingularPose`, which names the
    links, where the motion is not determined or is impossible.
    """
    equations = motion_equations(scene)
    return motion(equations, partial(solve_uniquely, equations, equations.ready(exact)), Fraction(0) if exact else 0.0)


def motion(equations: Equations, solve: Callable[[Sequence[Number]], Sequence[Number]], zero: Number) -> Rates:
    """The rates by two solutions of the same rows, for the velocities and then for the accelerations."""
    first = equations.rates(solve(equations.velocities), zero)
    second = equations.rates(solve(equations.accelerations(first)), zero)
    return read(equations, first, second)


def solve_uniquely(equations: Equations, linear: Floating | Elimination, right: Sequence[Number]) -> Sequence[Number]:
    """The unknowns for one right-hand side; fails with `SingularPose` unless there is exactly one solution."""
    free, values = linear.free, linear.solve(right)
    if values is not None and not free:
        return values
    links = moved_by(equations, free) if free else bound_by(equations, linear.conflict(right))
    raise SingularPose(reason(equations.scene, possible=values is not None, play=bool(free)), links)


def moved_by(equations: Equations, columns: frozenset[int]) -> tuple[str, ...]:
    """The links that undetermined columns move, in the scene's order."""
    return tuple(link for link, k in equations.columns.items() if not columns.isdisjoint((k, k + 1, k + 2)))


def bound_by(equations: Equations, rows: frozenset[int]) -> tuple[str, ...]:
    """The moving links that contradicting rows speak of, in the scene's order."""
    named = {link for i in rows for link in (equations.facts[i].link, equations.facts[i].on)}
    return tuple(link for link in equations.columns if link in named)


def reason(scene: Scene, possible: bool, play: bool) -> str:
    """Why a pose is singular, in words: whether the prescribed motion is possible, and whether anything has play."""
    if not scene.drives and not scene.motions:
        return "nothing drives the mechanism: these links can move freely"
    single = len(scene.drives) == 1 and not scene.motions
    input_motion = "the drive" if single else "the given motions" if scene.motions else "the drives"
    still, do_not = ("stands still", "does not") if single else ("stand still", "do not")
    if possible:
        return f"{input_motion} {do_not} determine the motion: these links can move while {input_motion} {still}"
    cause = (f"these links move only while {input_motion} {still}" if play
             else "it asks these links for two motions at once")
    return f"the prescribed motion is impossible here: {cause}"


def read(equations: Equations, first: dict[str, Rate], second: dict[str, Rate]) -> Rates:
    """What the rates of the links, once and twice derived, say about points, links and slides."""
    carriers = {p: FRAME if FRAME in links else links[0] for p, links in equations.scene.links_of.items() if links}
    slides = equations.scene.slides

    def sides(slide: Slide, rates: dict[str, Rate]) -> PairSides:
        return equations.sides((slide.link, slide.at), (slide.along, slide.at), rates)

    return Rates(
        equations,
        velocity={p: first[link].velocity_at(equations.arm(link, p)) for p, link in carriers.items()},
        acceleration={p: minus(second[link].velocity_at(equations.arm(link, p)),
                               equations.side(link, p, first).centripetal)
                      for p, link in carriers.items()},
        omega={link: first[link].turn for link in equations.columns},
        alpha={link: second[link].turn for link in equations.columns},
        slide_velocity={s.name: component_along(s, sides(s, first).slip) for s in slides},
        slide_acceleration={s.name: component_along(s, minus(sides(s, second).slip, sides(s, first).surplus))
                            for s in slides},
    )


def component_along(slide: Slide, vector: Pair) -> Pair:
    """The part of a vector along the slide's direction: all of it, but for rounding."""
    return times(dot(vector, slide.direction) / dot(slide.direction, slide.direction), slide.direction)
