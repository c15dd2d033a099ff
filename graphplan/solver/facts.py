"""What a scene states about rates: how one link turns on another, and how one of its points moves on it.

Revolute pairs, slides, drives and given motions are all made of these two kinds of facts, so no later part of the
solver knows which mechanism it solves. A fact about accelerations has the same linear part as the one about
velocities; what is left over, from centripetal and Coriolis accelerations, is known once the velocities are.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from graphplan.mechanism.model import FRAME, Balance, Number, Pair, Scene, Slide, TurningDrive
from graphplan.solver.plane import dot, less, plus, times, turned

X: Pair = (1, 0)
Y: Pair = (0, 1)


class Rate(NamedTuple):
    """Of one link: the velocity (x, y) of its base and its turning; or, once more derived, their rates."""

    x: Number
    y: Number
    turn: Number

    def at(self, arm: Pair) -> Pair:
        """The part linear in the rates of the motion of the link's point at `arm` from its base."""
        return plus((self.x, self.y), times(self.turn, turned(arm)))


class Side(NamedTuple):
    """One link as a fact sees it: the arm from the link's base to the fact's point, and the link's rates."""

    arm: Pair
    rate: Rate


def slip(link: Side, on: Side) -> Pair:
    """The velocity of a point of `link` relative to the coincident point of `on`, in length/s."""
    return less(link.rate.at(link.arm), on.rate.at(on.arm))


def surplus(link: Side, on: Side) -> Pair:
    """What the linear part of a relative acceleration exceeds it by: centripetal and Coriolis terms, in length/s^2.

    a_rel = (a + alpha x r - omega^2 r) of `link` - the same of `on` - 2 omega_on x v_rel.
    """
    inwards, coriolis = centripetal(link), times(2 * on.rate.turn, turned(slip(link, on)))
    return plus(less(inwards, centripetal(on)), coriolis)


def centripetal(side: Side) -> Pair:
    """omega^2 r of one link."""
    return times(side.rate.turn * side.rate.turn, side.arm)


@dataclass(frozen=True)
class Turning:
    """The angular velocity of `link` relative to `on` is `rate` (rad/s), and its rate is `change` (rad/s^2)."""

    link: str
    on: str
    rate: Number
    change: Number
    at: str | None = None

    def weights(self, arm: Pair) -> Rate:
        """How much each rate of a link counts in this fact."""
        return Rate(0, 0, 1)

    def left_over(self, link: Side, on: Side) -> Number:
        """Angular accelerations add up as angular velocities do."""
        return 0


@dataclass(frozen=True)
class Along:
    """The point `at` of `link` moves relative to `on` with a given component along `direction`, which is fixed to `on`.

    `rate` and `change` are the components of velocity and acceleration, times the length of `direction`.
    """

    link: str
    on: str
    at: str
    direction: Pair
    rate: Number
    change: Number

    def weights(self, arm: Pair) -> Rate:
        """How much each rate of a link counts in this fact."""
        return Rate(*self.direction, dot(self.direction, turned(arm)))

    def left_over(self, link: Side, on: Side) -> Number:
        """What the velocities add to `change` on the right-hand side of the accelerations."""
        return dot(self.direction, surplus(link, on))


Fact = Turning | Along
Length = Callable[[Slide], Number]


def facts(scene: Scene, length: Length | None = None) -> tuple[Fact, ...]:
    """Every fact that the scene states, in its order: joints, slides, drives, given motions.

    `length` gives the length of a slide's direction in other numbers than fractions and floats.
    """
    return (*pairs(scene), *drives(scene, length or reach), *motions(scene))


def supports(scene: Scene) -> tuple[Fact, ...]:
    """What holds the links against forces: the pairs, and the balances in the place of the drives."""
    return (*pairs(scene), *map(held, scene.loads.balances if scene.loads else ()))


def pairs(scene: Scene) -> tuple[Fact, ...]:
    """Two facts for each revolute pair, then two for each slide."""
    return (*joints(scene), *slides(scene))


def joints(scene: Scene) -> Iterator[Fact]:
    """A joint of k links is k - 1 pairs, each with the link named first, which carries the pin."""
    for point in scene.joints:
        pin, *others = scene.links_of[point]
        for link in others:
            yield Along(link, pin, point, X, 0, 0)
            yield Along(link, pin, point, Y, 0, 0)


def slides(scene: Scene) -> Iterator[Fact]:
    """A link that slides along another neither turns on it nor moves across the guide."""
    for slide in scene.slides:
        yield Turning(slide.link, slide.along, 0, 0)
        yield Along(slide.link, slide.along, slide.at, turned(slide.direction), 0, 0)


def drives(scene: Scene, length: Length) -> Iterator[Fact]:
    """What the drives prescribe; an actuator's speed is counted along its slide's direction."""
    for drive in scene.drives:
        if isinstance(drive, TurningDrive):
            yield Turning(drive.link, drive.relative_to, drive.omega, drive.alpha)
        else:
            slide = next(s for s in scene.slides if (s.link, s.along) == (drive.link, drive.along))
            rate, change = times(length(slide), (drive.speed, drive.acceleration))
            yield Along(slide.link, slide.along, slide.at, slide.direction, rate, change)


def motions(scene: Scene) -> Iterator[Fact]:
    """The given motions of points; its joints pass a point's motion on, so one link that names it suffices."""
    for point, motion in scene.motions.items():
        link = scene.links_of[point][0]
        for axis in X, Y:
            yield Along(link, FRAME, point, axis, dot(axis, motion.velocity), dot(axis, motion.acceleration))


def held(balance: Balance) -> Fact:
    """What would stand still if a balance were a support of the frame: a turning, or a motion along its direction."""
    if balance.direction is None:
        return Turning(balance.link, FRAME, 0, 0)
    return Along(balance.link, FRAME, balance.at, balance.direction, 0, 0)


def reach(slide: Slide) -> Number:
    """The length of the slide's direction: a fraction where it has a rational one, else a float."""
    square = dot(slide.direction, slide.direction)
    if isinstance(square, float):
        return math.sqrt(square)
    root = Fraction(math.isqrt(square.numerator), math.isqrt(square.denominator))
    return root if root * root == square else math.hypot(*slide.direction)
