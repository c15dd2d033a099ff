"""Reactions with friction: a journal's force touches its friction circle, a slide's leans by its friction angle.

Which way a force leans depends on the force itself. So each round takes the directions of the forces from the last and
solves for all their sizes at once, which is Newton's method: it stands after a few rounds, or there is no equilibrium
and the mechanism locks itself. Friction grows in a few steps: at its full size at once, where it is near to locking,
the rounds may miss the equilibrium. In floats only.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from graphplan.errors import SingularPose
from graphplan.mechanism.model import Number, Pair, Scene, Slide
from graphplan.mechanism.units import metre
from graphplan.solver.efficiency import delivered, efficiency
from graphplan.solver.equations import Equations
from graphplan.solver.facts import Along, Fact, Rate, Turning, X, Y, held
from graphplan.solver.loads import asked
from graphplan.solver.plane import dot, plus, times, turned
from graphplan.solver.rubbing import Rubbing, rubbing
from graphplan.solver.statics import Reactions, equilibrium, reactions

GROWING = (0.25, 0.5, 0.75, 1.0)
ROUNDS = 20
STANDS = 1e-14  # times the condition of the system: how close two rounds are at the end


@dataclass(frozen=True)
class Frictional(Reactions):
    """Reactions with friction; a slide's force has its friction in it.

    `couples`: by point and link, the friction's couple on that link, in force * m; the link that carries the pin has
    its opposite. `drags`: by slide, the friction's force on the sliding link. `efficiency`: from the powers of the
    balances; None at rest.
    """

    couples: dict[tuple[str, str], Number]
    drags: dict[str, Pair]
    efficiency: float | None


@dataclass(frozen=True)
class Touching(Along):
    """A component of a journal's force: its line of action touches the friction circle, at an arm of `lever`."""

    lever: Number = 0

    def weights(self, arm: Pair) -> Rate:
        """How much the force counts in the equilibrium of a link."""
        x, y, turn = super().weights(arm)
        return Rate(x, y, turn + self.lever)


def with_friction(scene: Scene) -> Frictional:
    """The reactions and balances of the scene with the friction of its journals and slides.

    Fails as `reactions` does, and with `SingularPose` where the mechanism locks itself.
    """
    plain = last = reactions(scene)
    against = rubbing(scene, plain.rates)
    for share in GROWING:
        last = settled(last, against.part(share))
    return finished(plain, last, against)


def settled(last: Reactions, against: Rubbing) -> Reactions:
    """The reactions that lean as they themselves say, from reactions that do nearly so."""
    scene, close = last.equations.scene, STANDS * last.condition
    for _ in range(ROUNDS):
        try:
            now = equilibrium(Equations(scene, tuple(leaning(last, against))), last.rates, exact=False)
        except SingularPose:
            break
        if stands(now, last, close):
            return now
        last = now
    raise locked(scene)


def leaning(last: Reactions, against: Rubbing) -> Iterator[Fact]:
    """The supports of the scene, each pair's turned aside by friction as its last force says."""
    scene = last.equations.scene
    for (point, link), force in last.joints.items():
        pin, size = scene.links_of[point][0], math.hypot(*force) or 1.0
        for axis in X, Y:
            lever = against.journals[point, link] * dot(axis, force) / size
            yield Touching(link, pin, point, axis, 0, 0, lever=lever)
    for slide in scene.slides:
        across, (force, _) = turned(slide.direction), last.slides[slide.name]
        lean = against.guides[slide.name] * math.copysign(1.0, dot(across, force))
        yield Turning(slide.link, slide.along, 0, 0)
        yield Along(slide.link, slide.along, slide.at, plus(across, times(lean, slide.direction)), 0, 0)
    yield from map(held, asked(scene).balances)


def stands(now: Reactions, last: Reactions, close: float) -> bool:
    """Whether a round has left the forces as they were, as close as asked beside the largest."""
    forces = [*now.joints.values(), *(force for force, _ in now.slides.values())]
    before = [*last.joints.values(), *(force for force, _ in last.slides.values())]
    change = max((math.dist(a, b) for a, b in zip(forces, before, strict=True)), default=0.0)
    return change <= close * max((math.hypot(*force) for force in forces), default=0.0)


def locked(scene: Scene) -> SingularPose:
    """The error that no balance keeps the motion up, with the links that rub."""
    rubbed = {link for f in asked(scene).frictions for link in f.slide or scene.links_of[f.at]}
    why = "self-locking: with this friction no balance keeps up the motion"
    return SingularPose(why, tuple(link for link in scene.moving if link in rubbed))


def finished(plain: Reactions, last: Reactions, against: Rubbing) -> Frictional:
    """The last round's forces with what friction is in them."""
    scene = plain.equations.scene
    couples = {name: math.hypot(*force) * against.journals[name] for name, force in last.joints.items()}
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
    return times(against.guides[slide.name] * math.hypot(*normal) / math.hypot(*slide.direction), slide.direction)
