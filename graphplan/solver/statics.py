"""The reactions and the balances of a scene from one linear system: the equilibrium of every moving link.

Gears and contacts push along their normals, flanks that are inclined by the pressure angle also radially, which does no
work (Ozols 1974, 11-2). Besides each other, given forces and moments, weights and inertia forces act on the links.
The rows of the rates state what a pair forbids; a pair's forces are what holds those facts. So the same rows, with the
balances instead of the drives, are the system for the forces when they are transposed.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.equations import Elimination
from graphplan.mechanism.model import (
    FRAME,
    Balance,
    Contact,
    Force,
    Gear,
    Loads,
    Mass,
    Moment,
    Number,
    Pair,
    Scene,
    Slide,
)
from graphplan.mechanism.numbers import minus, plus, quarter_turn, times
from graphplan.mechanism.pairs.pair import Along, Rate, Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.units import inertia, metre, weight
from graphplan.solver.rates import (
    Equations,
    Rates,
    Solution,
    bound,
    bound_by,
    force_equations,
    moved_by,
    require_fractions,
    solve,
    solve_uniquely,
)

NO_ARMS = (0, 0), (0, 0)
Sizes = Mapping[str, Sequence[Any]]


def held_at(equations: Equations, fact: Statement) -> Rate:
    """The force on the statement's link that is one time what holds it, and its moment about the statement's point."""
    return fact.weights(NO_ARMS, equations.root)[0]


def first_held(equations: Equations, pair: Gear | Contact) -> Pair:
    """The direction, with its length, of what a gear or a contact holds first."""
    x, y, _ = held_at(equations, next(pair.states(equations.scene)))
    return x, y


def force(equations: Equations, pair: Gear | Contact, sizes: Sequence[Any]) -> Pair:
    """The force on the first link from the second, of a gear at the pitch point; without the friction of sliding."""
    total: Any = (0, 0)
    for fact, size in zip(pair.states(equations.scene), sizes, strict=True):
        x, y, _ = held_at(equations, fact)
        total = plus(total, times(size if fact.link == pair.links[0] else -size, (x, y)))
    return plus(total, push(equations, pair, sizes[0])) if isinstance(pair, Gear) else total


def push(equations: Equations, gear: Gear, size: Any) -> Pair:
    """The radial force on the first wheel, off its mate, from its circumferential force."""
    return times(abs(size), radial(equations, gear))


def radial(equations: Equations, gear: Gear) -> Pair:
    """The radial force on the first wheel that goes with one time what holds the gear."""
    x, y, lever = held_at(equations, next(gear.states(equations.scene)))
    line = gear.line(equations.scene.points) if gear.grip else (0, 0)
    return gear.radial((x, y), lever, line)


def pushes(equations: Equations, sizes: Sizes) -> Iterator[Force]:
    """The radial forces on both wheels of all gears; they act along the line of centres, on which the first lies."""
    for gear in equations.scene.gears:
        if (gear.tangent or gear.grip) and gear.name in sizes:
            off = push(equations, gear, sizes[gear.name][0])
            for link, value in zip(gear.links, (off, times(-1, off)), strict=True):
                yield Force(link, gear.centres[0], value)


def leaning_statements(equations: Equations, pair: Gear | Contact, lean: Number,
                       crossing: Number = 1) -> Iterator[Statement]:
    """Statements that hold the links of a gear or a contact by a force that leans by `lean` from its first direction;
    for a gear as a multiple of its radial force.

    That of a gear has so many times the arm of the pitch point.
    """
    first, *others = pair.states(equations.scene)
    x, y, lever = held_at(equations, first)
    aside = radial(equations, pair) if isinstance(pair, Gear) else quarter_turn((x, y))
    direction = plus((x, y), times(lean, aside))
    if isinstance(pair, Gear):
        yield Along(first.link, first.on, first.at, direction, first.way, lever=crossing * lever)
    elif pair.rolling:
        yield first
    else:
        yield Along(first.link, first.on, pair.at, direction, first.way)
    yield from others


Load = Force | Moment


@dataclass(frozen=True)
class Reactions(Solution):
    """Reactions in one pose, in the scene's force and force * m; floats or fractions.

    `joints`: by point and link, the force on that link from the one that carries the pin, which the scene names first.
    `slides`: by name, the force on the sliding link from its guide, at the point `at`, and the moment about it.
    `higher`: by the name of a gear or contact, its force as so many times the directions of what holds its links.
    `balances`: a moment or a force for each balance of the scene. `rates`: the motion that all this keeps up.
    Pairs that special geometry leaves statically indeterminate are left out.
    """

    joints: dict[tuple[str, str], Pair]
    slides: dict[str, tuple[Pair, Number]]
    higher: dict[str, tuple[Number, ...]]
    balances: tuple[Pair | Number, ...]
    rates: Rates


def reactions(scene: Scene, exact: bool = False) -> Reactions:
    """The forces in every joint and slide of the scene, and its balances; with `exact` as fractions.

    Fails with `Refused` where the scene has no loads or fractions are asked of an irrational one, and with
    `SingularPose`, which names the links, where its motion or its forces are not determined.
    """
    tangential = equilibrium(force_equations(scene), solve(scene, exact), exact)
    separating = tuple(pushes(tangential.equations, tangential.higher))
    return equilibrium(tangential.equations, tangential.rates, exact, separating) if separating else tangential


def equilibrium(equations: Equations, rates: Rates, exact: bool, more: tuple[Force, ...] = ()) -> Reactions:
    """Solve for the reactions that keep each link in equilibrium with its loads and `more`."""
    right = [-value for value in resultants(equations, (*acting(equations.scene, rates), *more))]
    if exact:
        require_fractions(equations.scene, right)
    linear = equations.ready(exact, forces=True)
    values, free = linear.solve(right), linear.free
    if values is None or (free and not equations.scene.redundant) or free & balance_unknowns(equations):
        raise not_held(equations, exact)
    return read(equations, values, free, rates)


def repeating(equations: Equations) -> frozenset[int]:
    """The unknowns of the pairs that the scene knows to be statically indeterminate."""
    names, count = set(equations.scene.indeterminate_pairs), bound(equations.scene)
    return frozenset(i for i, fact in enumerate(equations.facts[:count]) if fact.condition.pair in names)


def balance_unknowns(equations: Equations) -> frozenset[int]:
    """The unknowns that are balances."""
    return frozenset(range(bound(equations.scene), len(equations.facts)))


def not_held(equations: Equations, exact: bool) -> SingularPose:
    """The error that says which links the balances do not hold."""
    play = equations.ready(exact).free
    if not play:
        twice = bound_by(equations, equations.ready(exact, forces=True).free)
        return SingularPose("statically indeterminate: more unknown reactions than equilibrium equations", twice)
    single = len(balance_unknowns(equations)) == 1
    balance, does = ("the balance", "it does") if single else ("the balances", "they do")
    why = f"{balance} cannot hold the motion in this pose: these links can move while {does} no work"
    return SingularPose(why, moved_by(equations, play))


def read(equations: Equations, values: Iterable[Number], free: Container[int], rates: Rates) -> Reactions:
    """Name the unknowns: two for each pair, in the order of the facts, then one for each balance.

    A pair with an unknown that equilibrium leaves free is left out.
    """
    scene, unknown = equations.scene, (None if i in free else value for i, value in enumerate(values))
    unit, slides, balances = metre(scene.units), dict[str, tuple[Pair, Number]](), list[Pair | Number]()
    higher = dict[str, tuple[Number, ...]]()
    linked = [(fact.at, fact.link) for fact in equations.facts if fact.way == "x"]
    joints = {joint: (next(unknown), next(unknown)) for joint in linked}
    for pair in scene.binding:
        reaction: dict[str, Any] = {} if isinstance(pair, Revolute) else {
            fact.way: next(unknown) for fact in pair.states(scene)}
        if any(value is None for value in reaction.values()):
            continue
        if isinstance(pair, Slide):
            across = reaction["across"]
            slides[pair.name] = times(across, quarter_turn(pair.direction)), scale_number(1 / unit,
                                                                                          reaction.get("turn",
                                                                                                       0 * across))
        elif isinstance(pair, Gear | Contact):
            higher[pair.name] = tuple(reaction.values())
    for balance, value in zip(required_loads(scene).balances, unknown, strict=True):
        if value is not None:
            balances.append(scale_number(1 / unit, value) if balance.direction is None
                            else times(value, balance.direction))
    determinate_joints = {(at, link): (x, y) for (at, link), (x, y) in joints.items()
                          if x is not None and y is not None and link != scene.links_of[at][0]}
    return Reactions(equations, determinate_joints, slides, higher, tuple(balances), rates)


# --- what acts on the links besides each other -----------------------------------------------------------------------


def required_loads(scene: Scene) -> Loads:
    """The loads of the scene; fails with `Refused` if it has no load."""
    if scene.loads is None:
        raise Refused("reactions", "the scene has no loads", "give it [[forces]], [[moments]] or [masses]")
    return scene.loads


def acting(scene: Scene, rates: Rates) -> tuple[Load, ...]:
    """Every load on a link, in the scene's units of force and force * m."""
    loads = required_loads(scene)
    mass_loads = (load for link, mass in loads.masses.items() for load in inertia_loads(scene, link, mass, rates))
    return (*loads.forces, *loads.moments, *mass_loads)


def inertia_loads(scene: Scene, link: str, mass: Mass, rates: Rates) -> Iterator[Load]:
    """By d'Alembert: weight and inertia force m g - m a_S at the centre of mass S, and the couple -I alpha."""
    weigh, (x, y) = times(weight(scene.units), required_loads(scene).gravity), rates.acceleration[mass.centre]
    resist = scale_number(inertia(scene.units), x), scale_number(inertia(scene.units), y)
    yield Force(link, mass.centre, times(mass.mass, minus(weigh, resist)))
    yield Moment(link, scale_number(-weight(scene.units), mass.inertia * rates.alpha[link]))


def scale_number(factor: Fraction, number: Any) -> Any:
    """A number times a factor of units: an array times a float, as it would multiply fractions one by one."""
    return (float(factor) if hasattr(number, "dtype") else factor) * number


def resultants(equations: Equations, loads: tuple[Load, ...]) -> list[Number]:
    """Of each moving link: its forces (x, y) added up and, in force * length, the moments about its base."""
    sums: list[Number] = [0] * equations.width
    for load in (load for load in loads if load.on != FRAME):
        k = equations.columns[load.on]
        sums[k : k + 3] = [a + b for a, b in zip(sums[k : k + 3], weights(equations, load), strict=True)]
    return sums


def weights(equations: Equations, load: Load) -> Rate:
    """A load's force (x, y) and, in force * length, its moment about its link's base: what each rate gives of power."""
    if isinstance(load, Moment):
        return Rate(0, 0, scale_number(metre(equations.scene.units), load.value))
    arm, fact = equations.arm(load.on, load.at), Along(load.on, FRAME, load.at, load.value, "held")
    return fact.weights((arm, arm), equations.root)[0]


# --- the balances from the power equation alone: the third opinion, which knows no reactions --------------------------
#
# In any motion that the pairs allow they do no work, so loads and balances together have no power. Each drive in turn
# gives one such motion, even of a mechanism at rest, and so one equation for the balances.


def power(scene: Scene, exact: bool = False) -> tuple[Pair | Number, ...]:
    """The scene's balances, each a moment (force * m) or a force, from the powers of its loads.

    Fails as `reactions` does.
    """
    rates, balances = solve(scene, exact), required_loads(scene).balances
    loads, motions = acting(scene, rates), list(virtual(rates, exact))
    system = Elimination([{k: sum(powers(rates, unit(balance), motion)) for k, balance in enumerate(balances)}
                          for motion in motions], len(balances))
    right = [-sum(powers(rates, loads, motion)) for motion in motions]
    if exact:
        require_fractions(scene, right)
    rows, values = force_equations(scene), system.solve(right)
    if values is None or system.free or rows.ready(exact).free:
        raise not_held(rows, exact)
    sizes: Iterable[Number] = values if exact else map(float, values)
    return tuple(v if one.direction is None else times(v, one.direction)
                 for v, one in zip(sizes, balances, strict=True))


def virtual(rates: Rates, exact: bool) -> Iterator[dict[str, Rate]]:
    """For each drive the velocities of every link while this drive alone moves, at a unit rate."""
    equations, zero = rates.equations, Fraction(0) if exact else 0.0
    linear, first = equations.ready(exact), bound(equations.scene)
    for drive in range(first, first + len(equations.scene.drives)):
        right = [Fraction(i == drive) for i in range(len(equations.facts))]
        yield equations.rates(solve_uniquely(equations, linear, right), zero)


def unit(balance: Balance) -> tuple[Load, ...]:
    """The balance with a moment of 1, or with its direction as its force, and its counterpart on another moving link.
    """
    if balance.direction is None:
        return tuple(Moment(link, Fraction(sign)) for link, sign in zip(balance.links, (1, -1), strict=True)
                     if link != FRAME)
    return tuple(Force(link, balance.at, times(sign, balance.direction))
                 for link, sign in zip(balance.links, (1, -1), strict=True) if link != FRAME)


def powers(rates: Rates, loads: Iterable[Load], motion: dict[str, Rate]) -> Iterator[Number]:
    """The power of each load in a motion, in force * length/s."""
    for load in loads:
        yield sum(a * b for a, b in zip(weights(rates.equations, load), motion[load.on], strict=True))
