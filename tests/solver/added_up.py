"""What acts on each link, added up without the solver; and loads at random."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from random import Random

from graphplan.mechanism.model import Balance, Force, Loads, Mass, Moment, Number, Pair, Scene, Units
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.solver import Frictional, Reactions

Push = tuple[str, Pair, Number]


def pushes(found: Reactions, link: str) -> Iterator[Push]:
    """What the pairs, with their friction, and the balances do to a link: a point, a force there, a moment."""
    scene, couples = found.equations.scene, found.couples if isinstance(found, Frictional) else {}
    for (p, other), value in found.joints.items():
        for sign in (other == link) * [1] + (scene.links_of[p][0] == link) * [-1]:
            yield p, (sign * value[0], sign * value[1]), sign * couples.get((p, other), 0)
    for s in scene.slides:
        value, couple = found.slides[s.name]
        for sign in (s.link == link) * [1] + (s.along == link) * [-1]:
            yield s.at, (sign * value[0], sign * value[1]), sign * couple
    for balance, held in zip(scene.loads.balances, found.balances, strict=True):
        if balance.link == link:
            yield (balance.at, held, 0) if balance.direction else (scene.links[link][0], (0, 0), held)


def burdens(found: Reactions, link: str) -> Iterator[Push]:
    """What the loads do to a link, inertia among them, in N and N m."""
    scene, unit = found.equations.scene, NEWTONS[found.equations.scene.units.force]
    given, first = scene.loads, scene.links[link][0]
    yield from ((f.at, (unit * f.value[0], unit * f.value[1]), 0) for f in given.forces if f.on == link)
    yield from ((first, (0, 0), unit * m.value) for m in given.moments if m.on == link)
    if link in given.masses:
        body, kilograms = given.masses[link], KILOGRAMS[scene.units.mass]
        a_x, a_y = (METRES[scene.units.length] * a for a in found.rates.acceleration[body.centre])
        inertia = body.mass * (given.gravity[0] - a_x), body.mass * (given.gravity[1] - a_y)
        couple = -kilograms * body.inertia * found.rates.alpha[link]
        yield body.centre, (kilograms * inertia[0], kilograms * inertia[1]), couple


def left_over(found: Reactions, link: str) -> tuple[Number, Number, Number]:
    """The sums of all forces on a link and of their moments about the origin, in N and N m."""
    scene = found.equations.scene
    unit, metre = NEWTONS[scene.units.force], METRES[scene.units.length]
    acting = [(p, (unit * x, unit * y), unit * m) for p, (x, y), m in pushes(found, link)]
    acting += burdens(found, link)
    turning = (m + metre * (scene.points[p][0] * y - scene.points[p][1] * x) for p, (x, y), m in acting)
    return sum(x for _, (x, _), _ in acting), sum(y for _, (_, y), _ in acting), sum(turning)


def numbers(found: Reactions) -> Iterator[Number]:
    """Every number of an answer, always in the same order."""
    yield from (x for value in found.joints.values() for x in value)
    yield from (x for value, couple in found.slides.values() for x in (*value, couple))
    yield from (x for held in found.balances for x in (held if isinstance(held, tuple) else (held,)))


def loaded(scene: Scene, random: Random) -> Scene:
    """The scene in any units with loads of every kind on every link, balanced at the crank."""

    def any_number() -> Fraction:
        return Fraction(random.randint(-50, 50), random.randint(1, 7))

    def on(link: str) -> str:
        return random.choice(scene.links[link])

    given = Loads(
        gravity=(any_number(), any_number()),
        masses={link: Mass(abs(any_number()), abs(any_number()), on(link)) for link in scene.moving},
        forces=tuple(Force(link, on(link), (any_number(), any_number())) for link in scene.moving),
        moments=tuple(Moment(link, any_number()) for link in scene.moving),
        balances=(Balance(scene.drives[0].link),),
    )
    units = Units(random.choice(list(METRES)), random.choice(list(NEWTONS)), random.choice(list(KILOGRAMS)))
    return replace(scene, loads=given, units=units)
