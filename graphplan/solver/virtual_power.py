"""The balances from the power equation alone: the third opinion, which knows no reactions.

In any motion that the pairs allow they do no work, so loads and balances together have no power. Each drive in turn
gives one such motion, even of a mechanism at rest, and so one equation for the balances.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from graphplan.mechanism.model import Balance, Force, Moment, Number, Pair, Scene
from graphplan.mechanism.pairs.pair import Rate
from graphplan.mechanism.plane import times
from graphplan.solver.elimination import Elimination
from graphplan.solver.equations import bound, held, require_fractions
from graphplan.solver.rates import Rates, solve, solved
from graphplan.solver.statics import Load, acting, asked, not_held, weights


def power(scene: Scene, exact: bool = False) -> tuple[Pair | Number, ...]:
    """The scene's balances, each a moment (force * m) or a force, from the powers of its loads.

    Fails as `reactions` does.
    """
    rates, units = solve(scene, exact), [unit(balance) for balance in asked(scene).balances]
    loads, motions = acting(scene, rates), list(virtual(rates, exact))
    system = Elimination([dict(enumerate(powers(rates, units, motion))) for motion in motions], len(units))
    right = [-sum(powers(rates, loads, motion)) for motion in motions]
    if exact:
        require_fractions(scene, right)
    rows, values = held(scene), system.solve(right)
    if values is None or system.free or rows.ready(exact).free:
        raise not_held(rows, exact)
    found: Iterable[Number] = values if exact else map(float, values)
    return tuple(times(v, one.value) if isinstance(one, Force) else v for v, one in zip(found, units, strict=True))


def virtual(rates: Rates, exact: bool) -> Iterator[dict[str, Rate]]:
    """For each drive the velocities of every link while this drive alone moves, at a unit rate."""
    equations, zero = rates.equations, Fraction(0) if exact else 0.0
    linear, first = equations.ready(exact), bound(equations.scene)
    for drive in range(first, first + len(equations.scene.drives)):
        right = [Fraction(i == drive) for i in range(len(equations.facts))]
        yield equations.rates(solved(equations, linear, right), zero)


def unit(balance: Balance) -> Load:
    """The balance with a moment of 1, or with its direction as its force."""
    if balance.direction is None:
        return Moment(balance.link, Fraction(1))
    return Force(balance.link, balance.at, balance.direction)


def powers(rates: Rates, loads: Iterable[Load], motion: dict[str, Rate]) -> Iterator[Number]:
    """The power of each load in a motion, in force * length/s."""
    for load in loads:
        yield sum(a * b for a, b in zip(weights(rates.equations, load), motion[load.on], strict=True))
