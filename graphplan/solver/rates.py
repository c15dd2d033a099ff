"""The one linear system for the rates of every moving link, as sparse rows over the scene's own numbers.

Three unknowns a link: the velocity (x, y) of its base, a point of it, and its angular velocity. Coordinates enter as
differences only, so the rows do not depend on where the origin is. Velocities and accelerations share the rows and
differ in the right-hand side. Transposed, with the forces that hold the pairs as unknowns, they are the equilibrium
of every link. What the rows state comes from the scene's pairs, whichever they are. Nothing here tests a number: the
same rows can be filled with arrays of poses. One scene's are made ready in floats or in fractions.

In a mechanism of many links a joint of three links or more has a pin of its own, two unknowns more: so in which order
links determine each other does not hang on which of them carries the pin.

The velocities and accelerations that follow from it are the second opinion on every construction.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, partial
from itertools import chain
from typing import TYPE_CHECKING, Any

from graphplan.errors import Refused, SingularPose, by_name
from graphplan.mechanism.equations import PIN, Elimination, transpose
from graphplan.mechanism.model import FRAME, Number, Pair, Scene, Slide
from graphplan.mechanism.numbers import dot, is_exact, minus, times
from graphplan.mechanism.pairs.pair import Along, KinematicPair, PairSide, PairSides, Rate, Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.solver.linear import MAX_BLOCK

if TYPE_CHECKING:
    from graphplan.solver.floating import Floating

Row = dict[int, Number]


def reach(square: Any) -> Number:
    """The root of the square of a direction's length: a fraction where it has a rational one, else a float."""
    if isinstance(square, float):
        return math.sqrt(square)
    root = Fraction(math.isqrt(square.numerator), math.isqrt(square.denominator))
    return root if root * root == square else math.sqrt(square)


@dataclass(frozen=True)
class Equations:
    """Linear equations of the rates: `rows` times the unknowns equal `velocities`, and `accelerations(...)`.

    `root` gives the root of a squared length in other numbers than fractions and floats.
    """

    scene: Scene
    facts: tuple[Statement, ...]
    root: Callable[[Any], Any] = reach

    @cached_property
    def columns(self) -> dict[str, int]:
        """The first of the three columns of each moving link."""
        return {link: 3 * k for k, link in enumerate(self.scene.moving)}

    @property
    def pins(self) -> dict[str, int]:
        """The first of the two columns of each pin that has its own, by its point."""
        points = dict.fromkeys(fact.at for fact in self.facts if fact.on == PIN)
        return {point: 3 * len(self.columns) + 2 * k for k, point in enumerate(points)}

    @property
    def scales(self) -> list[float]:
        """Scales that make the unknowns comparable: a turning counts by its effect at the mechanism's reach."""
        return [1.0, 1.0, self.reach] * len(self.columns) + [1.0, 1.0] * len(self.pins)

    @property
    def width(self) -> int:
        """The number of unknowns."""
        return 3 * len(self.columns) + 2 * len(self.pins)

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """Coefficients of each statement by column; the frame has no column."""
        return tuple(self._row(fact) for fact in self.facts)

    def _row(self, fact: Statement) -> Row:
        row: Row = {}
        first_arm, second_arm = (self.arm(*end) for end in fact.ends)
        for (link, point), weights in zip(fact.ends, fact.weights((first_arm, second_arm), self.root), strict=True):
            if link != FRAME:
                column = self.columns[link] if link != PIN else self.pins[point]
                row |= {column + k: weight for k, weight in enumerate(weights if link != PIN else weights[:2])
                        if type(weight) is not int or weight}
        return row

    def arm(self, link: str, point: str) -> Pair:
        """The vector from the link's base to `point`; zero for the fixed frame, and for a pin."""
        if not point or link in (FRAME, PIN):
            return 0, 0
        if (link, point) not in self._arms:
            self._arms[link, point] = minus(self.scene.points[point], self.scene.points[self.bases[link]])
        return self._arms[link, point]

    @cached_property
    def _arms(self) -> dict[tuple[str, str], Pair]:
        """The vectors that are known already."""
        return {}

    @cached_property
    def bases(self) -> dict[str, str]:
        """The point of each moving link from which its arms are measured: the first one that is not rounded."""
        places = self.scene.points
        return {link: next((p for p in self.scene.links[link] if is_exact(places[p])), self.scene.links[link][0])
                for link in self.scene.moving}

    @property
    def arms(self) -> Iterable[Pair]:
        """Every arm that a statement has."""
        return (self.arm(*end) for fact in self.facts for end in fact.ends)

    @cached_property
    def reach(self) -> float:
        """The characteristic length: the longest coordinate of an arm, or 1 where every arm vanishes."""
        return max((abs(float(coordinate)) for arm in self.arms for coordinate in arm), default=0.0) or 1.0

    @property
    def prescribed_rates(self) -> list[Pair]:
        """The velocity and the acceleration that each statement prescribes, times the length of its guide's direction.
        """
        return [times(self.root(dot(fact.direction, fact.direction)), (fact.rate, fact.change))
                if isinstance(fact, Along) and fact.way == "along" else (fact.rate, fact.change) for fact in self.facts]

    @property
    def velocities(self) -> list[Number]:
        """The right-hand side for the velocities."""
        return [rate for rate, _ in self.prescribed_rates]

    def accelerations(self, rates: dict[str, Rate]) -> list[Number]:
        """The right-hand side for the accelerations, from the velocities of every link."""
        sides = {fact.ends: self.sides(*fact.ends, rates) for fact in self.facts}  # a joint's two facts have one
        return [change + fact.left_over(sides[fact.ends])
                for fact, (_, change) in zip(self.facts, self.prescribed_rates, strict=True)]

    def sides(self, first: tuple[str, str], second: tuple[str, str], rates: dict[str, Rate]) -> PairSides:
        """Two links, each at a point, with these rates."""
        return PairSides(self.side(*first, rates), self.side(*second, rates))

    def side(self, link: str, point: str, rates: dict[str, Rate]) -> PairSide:
        """The side of a statement at a point of a link, with the link's rates."""
        return PairSide(self.arm(link, point), rates[link])

    def rates(self, values: Sequence[Number], zero: Number) -> dict[str, Rate]:
        """The solved unknowns link by link, the resting frame among them; a pin, which no arm reaches, has rates of
        zero."""
        moving = {link: Rate(*values[k : k + 3]) for link, k in self.columns.items()}
        return moving | dict.fromkeys((FRAME, PIN), Rate(zero, zero, zero))

    def ready(self, exact: bool, forces: bool = False) -> Floating | Elimination:
        """The system made ready for any right-hand sides: three columns a link, one row a fact.

        For the forces that hold the facts: one column a fact, the equilibrium conditions of each link as rows.
        """
        if exact:
            require_fractions(self.scene, chain(*(row.values() for row in self.rows), *self.prescribed_rates))
            return (Elimination(transpose(self.rows, self.width), len(self.facts)) if forces
                    else Elimination(self.rows, self.width))
        from graphplan.solver.floating import Floating  # numpy is imported there: fractions do without it

        return Floating(self.rows, self.scales, forces)


@dataclass(frozen=True)
class Solution:
    """Solution of linear equations."""

    equations: Equations = field(repr=False, compare=False)

    @cached_property
    def condition(self) -> float:
        """The 2-norm condition of the system, its rows and columns equilibrated, free of units: 1 is best."""
        from graphplan.solver.floating import Floating

        return Floating(self.equations.rows, self.equations.scales).condition


def require_fractions(scene: Scene, used: Iterable[Number]) -> None:
    """Fails with `Refused` where the scene is irrational, or a number in use is rounded."""
    if scene.irrational or any(isinstance(number, float) for number in used):
        reasons = sorted(scene.irrational, key=by_name)
        why = "; ".join(reasons) or "a coordinate, a drive, a given motion or a load is not a fraction"
        raise Refused("exact numbers", why, "ask for floats, without --exact")


def motion_equations(scene: Scene, root: Callable[[Any], Any] = reach) -> Equations:
    """The equations of the motion: what all pairs state, drives and given motions among them."""
    return Equations(scene, tuple(_statements(scene, scene.pairs)), root)


def force_equations(scene: Scene) -> Equations:
    """The equations of what holds the links against forces: the pairs, and the balances instead of the drives."""
    balances = scene.loads.balances if scene.loads else ()
    return Equations(scene,
                     (*_statements(scene, scene.binding),
                      *(fact for balance in balances for fact in balance.states(scene))))


def bound(scene: Scene) -> int:
    """Number of statements that the pairs make without their drives: the first ones of either system."""
    return sum(1 for _ in _statements(scene, scene.binding))


def _statements(scene: Scene, pairs: Iterable[KinematicPair]) -> Iterator[Statement]:
    """Yield the statements of pairs; in large mechanisms joints of many links have a pin of their own."""
    large = 3 * len(scene.moving) > MAX_BLOCK
    for pair in pairs:
        if large and isinstance(pair, Revolute) and len(pair.pinned) > 2:
            yield from replace(pair, pinned=(PIN, *pair.pinned)).states(scene)
        else:
            yield from pair.states(scene)


@dataclass(frozen=True)
class Rates(Solution):
    """Motion in one pose: true vectors in scene units, rad and s; floats, or fractions where asked for.

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
        return "the mechanism has no drive: these links can move freely"
    single = len(scene.drives) == 1 and not scene.motions
    input_motion = "the drive" if single else "the given motions" if scene.motions else "the drives"
    still, do_not = ("stands still", "does not") if single else ("stand still", "do not")
    if possible:
        return f"{input_motion} {do_not} determine the motion: these links can move while {input_motion} {still}"
    cause = (f"these links move only while {input_motion} {still}" if play
             else "it asks these links for two motions at once")
    return f"the prescribed motion is impossible here: {cause}"


def read(equations: Equations, first: dict[str, Rate], second: dict[str, Rate]) -> Rates:
    """Rates of points, links and slides, from the links' first and second derivatives."""
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
