"""Reactions with friction: a journal's force touches its friction circle, a slide's leans by its friction angle.

Which way a force leans depends on the force itself. So each round takes the directions of the forces from the last and
solves for all their sizes at once, which is Newton's method: it stands after a few rounds, or there is no equilibrium
and the mechanism locks itself. Friction grows in a few steps: at its full size at once, where it is near to locking,
the rounds may miss the equilibrium. The size of a journal's force is a root: fractions have friction of slides alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from graphplan.errors import SingularPose
from graphplan.mechanism.model import Number, Pair, Scene, Slide
from graphplan.mechanism.pairs.pair import Along, Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.plane import dot, plus, times, turned
from graphplan.mechanism.units import metre
from graphplan.solver.efficiency import delivered, efficiency
from graphplan.solver.equations import Equations
from graphplan.solver.loads import asked
from graphplan.solver.rubbing import Rubbing, rubbing, sign
from graphplan.solver.statics import Reactions, equilibrium, reactions

GROWING = tuple(Fraction(share, 4) for share in (1, 2, 3, 4))
ROUNDS = 20
STANDS = 1e-14  # times the condition of the system: how close two rounds are at the end
NOTHING = 8 * 2.0**-52  # times the condition, of the largest force: a smaller one has no direction


@dataclass(frozen=True)
class Frictional(Reactions):
    """Reactions with friction; a slide's force has its friction in it.

    `couples`: by point and link, the friction's couple on that link, in force * m; the link that carries the pin has
    its opposite. `drags`: by slide, the friction's force on the sliding link. `efficiency`: from the powers of the
    balances; None at rest.
    """

    couples: dict[tuple[str, str], Number]
    drags: dict[str, Pair]
    efficiency: Number | None


def with_friction(scene: Scene, rounds: int = 0, exact: bool = False) -> Frictional:
    """The reactions and balances of the scene with the friction of its journals and slides.

    With `rounds` as so many rounds from those without friction have it, else as they stand; with `exact` as fractions,
    where nothing but slides rubs. Fails as `reactions` does, and with `SingularPose` where the mechanism locks itself.
    """
    plain = last = reactions(scene, exact)
    against = rubbing(scene, plain.rates)
    if rounds:
        for _ in range(rounds):
            last = further(last, against, exact)
    else:
        for share in GROWING:
            last = settled(last, against.part(share), exact)
    return finished(plain, last, against)


def settled(last: Reactions, against: Rubbing, exact: bool) -> Reactions:
    """The reactions that lean as they themselves say, from reactions that do nearly so."""
    close = STANDS * last.condition
    for _ in range(ROUNDS):
        now = further(last, against, exact)
        if stands(now, last, close):
            return now
        last = now
    raise locked(last.equations.scene)


def further(last: Reactions, against: Rubbing, exact: bool) -> Reactions:
    """The reactions that lean as the last ones say."""
    scene = last.equations.scene
    try:
        return equilibrium(Equations(scene, tuple(_leant(last, against))), last.rates, exact)
    except SingularPose:
        raise locked(scene) from None


def _leant(last: Reactions, against: Rubbing) -> Iterator[Statement]:
    """The supports of the scene, each pair's turned aside by friction as its last force says; none by no force."""
    least = NOTHING * last.condition * largest(last)

    def arm(joint: Revolute, link: str, force: Pair) -> Number:
        circle = against.journals[joint.at, link]
        size = math.hypot(*force) if circle else 0
        return circle / size if size > least else 0

    def lean(slide: Slide, pressure: Number) -> Number:
        return against.guides[slide.name] * sign(float(pressure), least * math.hypot(*slide.direction))

    return leaning(last, arm, lean)


def leaning(last: Reactions, arm: Callable[[Revolute, str, Pair], Number],
            lean: Callable[[Slide, Number], Number]) -> Iterator[Statement]:
    """The supports of the scene, with friction.

    A journal's line of action touches the friction circle: `arm` is its radius by the last force on a link. A slide's
    force leans by so much, from its last component across the guide.
    """
    scene = last.equations.scene
    for joint in scene.revolutes:
        for part in joint.states(scene):
            force = last.joints[joint.at, part.link]
            yield replace(part, lever=arm(joint, part.link, force) * dot(part.direction, force))
    for slide in scene.slides:
        for fact in slide.states(scene):
            if isinstance(fact, Along):
                by = lean(slide, dot(fact.direction, last.slides[slide.name][0]))
                yield replace(fact, direction=plus(fact.direction, times(by, slide.direction)))
            else:
                yield fact
    for balance in asked(scene).balances:
        yield from balance.states(scene)


def largest(found: Reactions) -> float:
    """The largest of the forces, and of the moments at the mechanism's reach: what is nothing beside it is nothing."""
    arm = found.equations.reach / metre(found.equations.scene.units)
    forces = [*found.joints.values(), *(force for force, _ in found.slides.values())]
    moments = [moment for _, moment in found.slides.values()]
    for balance in found.balances:
        (forces if isinstance(balance, tuple) else moments).append(balance)  # type: ignore[arg-type]
    return max((*(math.hypot(*force) for force in forces), *(abs(float(m)) / arm for m in moments)), default=0.0)


def stands(now: Reactions, last: Reactions, close: float) -> bool:
    """Whether a round has left the forces as they were, as close as asked beside the largest."""
    forces = [*now.joints.values(), *(force for force, _ in now.slides.values())]
    before = [*last.joints.values(), *(force for force, _ in last.slides.values())]
    change = max((math.dist(a, b) for a, b in zip(forces, before, strict=True)), default=0.0)
    return change <= close * largest(now)


def locked(scene: Scene) -> SingularPose:
    """The error that no balance keeps the motion up, with the links that rub."""
    rubbed = {link for f in asked(scene).frictions for link in f.slide or scene.links_of[f.at]}
    why = "self-locking: with this friction no balance keeps up the motion"
    return SingularPose(why, tuple(link for link in scene.moving if link in rubbed))


def finished(plain: Reactions, last: Reactions, against: Rubbing) -> Frictional:
    """The last round's forces with what friction is in them."""
    scene = plain.equations.scene
    couples = {name: circle * math.hypot(*last.joints[name]) if circle else circle
               for name, circle in against.journals.items()}
    drags = {s.name: drag(s, last.slides[s.name][0], against) for s in scene.slides}
    return Frictional(
        joints=last.joints,
        slides={name: (plus(force, drags[name]), moment) for name, (force, moment) in last.slides.items()},
        balances=last.balances,
        rates=last.rates,
        equations=last.equations,
        couples={name: couple / metre(scene.units) for name, couple in couples.items()},
        drags=drags,
        efficiency=efficiency(delivered(plain), delivered(last)),
    )


def drag(slide: Slide, normal: Pair, against: Rubbing) -> Pair:
    """The friction of a slide, along its guide."""
    across = turned(slide.direction)
    size = dot(across, normal) / dot(across, across)
    return times(against.guides[slide.name] * max(size, -size), slide.direction)
