"""The forces of gears and contacts, as so many times the directions of what holds their links.

A contact pushes along the common normal of its profiles; one that rolls bears along their tangent, too. Gears hold each
other by a circumferential force at the pitch point, square to the line of centres. Flanks that are inclined by the
pressure angle also push the wheels apart, whichever drives: a radial component, which does no work as the centres are
held apart. So the circumferential forces are the same without it (Ozols 1974, 11-2).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from graphplan.mechanism.model import Contact, Force, Gear, Number, Pair
from graphplan.mechanism.numbers import plus, quarter_turn, times
from graphplan.mechanism.pairs.pair import Along, Rate, Statement
from graphplan.solver.equations import Equations

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
    return times(gear.tangent * abs(size), quarter_turn(first_held(equations, gear)))


def pushes(equations: Equations, sizes: Sizes) -> Iterator[Force]:
    """The radial forces on both wheels of all gears; they act along the line of centres, on which the first lies."""
    for gear in equations.scene.gears:
        if gear.tangent and gear.name in sizes:
            off = push(equations, gear, sizes[gear.name][0])
            for link, value in zip(gear.links, (off, times(-1, off)), strict=True):
                yield Force(link, gear.centres[0], value)


def leaning_statements(equations: Equations, pair: Gear | Contact, lean: Number) -> Iterator[Statement]:
    """What holds the links of a gear or a contact by a force that leans by so much from its first direction."""
    first, *others = pair.states(equations.scene)
    x, y, lever = held_at(equations, first)
    direction = plus((x, y), times(lean, quarter_turn((x, y))))
    if isinstance(pair, Gear):
        yield Along(first.link, first.on, first.at, direction, first.way, lever=lever)
    elif pair.rolling:
        yield first
    else:
        yield Along(first.link, first.on, pair.at, direction, first.way)
    yield from others
