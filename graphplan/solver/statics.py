"""The reactions and the balances of a scene from one linear system: the equilibrium of every moving link.

The rows of the rates state what a pair forbids; a pair's forces are what holds those facts. So the same rows, with the
balances in the place of the drives, are the system for the forces when they are transposed.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from graphplan.errors import SingularPose
from graphplan.mechanism.model import Balance, Number, Pair, Scene, Slide
from graphplan.mechanism.plane import times, turned
from graphplan.mechanism.units import metre
from graphplan.solver.equations import Equations, bound, held
from graphplan.solver.linear import condition, for_forces, for_rates, require_fractions
from graphplan.solver.loads import acting, asked, resultants
from graphplan.solver.rates import Rates, bound_by, moved_by, solve


@dataclass(frozen=True)
class Reactions:
    """What the links do to each other in one pose, in the scene's force and force * m; floats or fractions.

    `joints`: by point and link, the force on that link from the one that carries the pin, which the scene names first.
    `slides`: by name, the force on the sliding link from its guide, at the point `at`, and the moment about it.
    `balances`: a moment or a force for each balance of the scene. `rates`: the motion that all this keeps up.
    Pairs that special geometry leaves statically indeterminate are left out.
    """

    joints: dict[tuple[str, str], Pair]
    slides: dict[str, tuple[Pair, Number]]
    balances: tuple[Pair | Number, ...]
    rates: Rates
    equations: Equations = field(repr=False, compare=False)

    @cached_property
    def condition(self) -> float:
        """The 2-norm condition of the system, its rows and columns equilibrated, free of units: 1 is best."""
        return condition(self.equations)


def reactions(scene: Scene, exact: bool = False) -> Reactions:
    """The forces in every joint and slide of the scene, and its balances; with `exact` as fractions.

    Fails with `Refused` where the scene has no loads or fractions are asked of an irrational one, and with
    `SingularPose`, which names the links, where its motion or its forces are not determined.
    """
    return equilibrium(held(scene), solve(scene, exact), exact)


def equilibrium(equations: Equations, rates: Rates, exact: bool) -> Reactions:
    """What must hold the facts, so that on each link, with the loads, forces and moments add up to nothing."""
    right = [-value for value in resultants(equations, acting(equations.scene, rates))]
    if exact:
        require_fractions(equations.scene, right)
    linear = for_forces(equations, exact)
    values, free = linear.solve(right), linear.free
    if values is None or (free and not equations.scene.redundant) or free & balanced(equations):
        raise not_held(equations, exact)
    return read(equations, without(values, free), rates)


def without(values: Iterable[Number], free: Container[int]) -> list[Number | None]:
    """The unknowns, None in the place of those that are free."""
    return [None if i in free else value for i, value in enumerate(values)]


def repeating(equations: Equations) -> frozenset[int]:
    """The unknowns of the pairs that the scene knows to be statically indeterminate."""
    names, count = set(equations.scene.indeterminate_pairs), bound(equations.scene)
    return frozenset(i for i, fact in enumerate(equations.facts[:count]) if fact.condition.pair in names)


def balanced(equations: Equations) -> frozenset[int]:
    """The unknowns that are balances."""
    return frozenset(range(bound(equations.scene), len(equations.facts)))


def not_held(equations: Equations, exact: bool) -> SingularPose:
    """The error that says which links the balances do not hold."""
    play = for_rates(equations, exact).free
    if not play:
        twice = bound_by(equations, for_forces(equations, exact).free)
        return SingularPose("statically indeterminate: more holds these links than their equilibrium can tell", twice)
    one = len(balanced(equations)) == 1
    balance, does = ("the balance", "it does") if one else ("the balances", "they do")
    why = f"{balance} cannot hold the motion in this pose: these links can move while {does} no work"
    return SingularPose(why, moved_by(equations, play))


def read(equations: Equations, values: Sequence[Number | None], rates: Rates) -> Reactions:
    """What the unknowns are: two for each pair, in the order of the facts, then one for each balance.

    A pair with an unknown that equilibrium cannot tell, None, is left out.
    """
    scene, unknown = equations.scene, iter(values)
    joints = {(joint.at, k): (next(unknown), next(unknown)) for joint in scene.revolutes for k in joint.links[1:]}
    slides = [(s, {fact.way: next(unknown) for fact in s.states(scene)}) for s in scene.slides]
    balances = zip(asked(scene).balances, unknown, strict=True)
    return Reactions(
        joints={name: (x, y) for name, (x, y) in joints.items() if x is not None and y is not None},
        slides={s.name: sliding(scene, s, found) for s, found in slides
                if all(value is not None for value in found.values())},
        balances=tuple(balancing(scene, balance, value) for balance, value in balances if value is not None),
        rates=rates,
        equations=equations,
    )


def sliding(scene: Scene, slide: Slide, found: dict[str, Any]) -> tuple[Pair, Number]:
    """A slide's force, across its guide, and its moment."""
    across = found["across"]
    return times(across, turned(slide.direction)), found.get("turn", 0 * across) / metre(scene.units)


def balancing(scene: Scene, balance: Balance, value: Number) -> Pair | Number:
    """A balance's moment, or its force along its direction."""
    return value / metre(scene.units) if balance.direction is None else times(value, balance.direction)
