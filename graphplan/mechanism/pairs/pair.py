"""What a kinematic pair is: links that it joins, and what it states of their motion relative to each other.

A pair states that one link turns on another in a given way, or that a point of one moves on the other with a given
component along a direction: nothing else is ever stated of links. Each statement has three readings, written apart:

- `residual`: what it leaves in any other pose of the links, over any numbers. Mobility, structure, special geometry and
  the closure of the cycle rest on it.
- `weights`: the row of the velocities, and transposed that of the forces.
- `left_over`: what the velocities add to the accelerations, from centripetal and Coriolis terms.

A test differentiates the first and compares it with the others.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from graphplan.mechanism.plane import Number, Pair, dot, less, plus, times, turned

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene

FRAME = "frame"


POINT, LINE, TURNING = "point", "line", "turning"
"""What a pair passes on to those who draw: the end of a point that the links share; a line along the guide on which the
end of its point in one link's plane lies, as seen from the other; that the links turn alike."""


class Condition(NamedTuple):
    """One condition of a kinematic pair: of `link` at the joint `on`, or of the slide of `link` along the link `on`.

    A joint keeps its two links together in the `way` x and in the way y; a slide keeps the sliding link on the guide
    (across) and from turning relative to it (turn).
    """

    link: str
    on: str
    way: str

    @property
    def pair(self) -> str:
        """The pair's name in results, such as `3 at B` or `3 along 2`."""
        return f"{self.link} {'at' if self.way in ('x', 'y') else 'along'} {self.on}"


class Attitude(NamedTuple):
    """How a link lies: where its origin is, and the cosine and the sine of its turn; in any numbers."""

    x: Any
    y: Any
    cos: Any
    sin: Any

    def turned(self, vector: Any) -> Any:
        """Where a vector fixed to the link points."""
        return self.cos * vector[0] - self.sin * vector[1], self.sin * vector[0] + self.cos * vector[1]

    def at(self, arm: Any) -> Any:
        """Where the link's point at `arm` from its origin is."""
        return plus((self.x, self.y), self.turned(arm))


class Rate(NamedTuple):
    """Of one link: the velocity (x, y) of its base and its turning; or, once more derived, their rates."""

    x: Number
    y: Number
    turn: Number

    def at(self, arm: Pair) -> Pair:
        """The part linear in the rates of the motion of the link's point at `arm` from its base."""
        return plus((self.x, self.y), times(self.turn, turned(arm)))


class Side(NamedTuple):
    """One link as a statement sees it: the arm from the link's base to the statement's point, and the link's rates."""

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
    rate: Number = 0
    change: Number = 0
    way: str = "turn"
    at: ClassVar[str] = ""

    @property
    def condition(self) -> Condition:
        """The statement by its name."""
        return Condition(self.link, self.on, self.way)

    def residual(self, pose: dict[str, Attitude], arms: tuple[Any, Any]) -> Any:
        """The sine of the angle by which one link has turned on the other."""
        link, on = pose[self.link], pose[self.on]
        return link.sin * on.cos - link.cos * on.sin

    def weights(self, arm: Pair) -> Rate:
        """How much each rate of a link counts."""
        return Rate(0, 0, 1)

    def left_over(self, more: Pair) -> Number:
        """Angular accelerations add up as angular velocities do."""
        return 0


@dataclass(frozen=True)
class Along:
    """The point `at` of `link` moves relative to `on` with a given component along `direction`, which is fixed to `on`.

    `rate` and `change` are the components of velocity and acceleration. A direction in which nothing moves may as well
    be fixed to another link, `to`. A force of friction that holds the point passes it at a `lever`.
    """

    link: str
    on: str
    at: str
    direction: Pair
    way: str
    rate: Number = 0
    change: Number = 0
    to: str = ""
    lever: Number = 0

    @property
    def condition(self) -> Condition:
        """The statement by its name."""
        return Condition(self.link, self.at if self.way in ("x", "y") else self.on, self.way)

    def residual(self, pose: dict[str, Attitude], arms: tuple[Any, Any]) -> Any:
        """How far the point has gone from its place on the other link, of which `arms` are its places in the two."""
        apart = less(pose[self.link].at(arms[0]), pose[self.on].at(arms[1]))
        return dot(pose[self.to or self.on].turned(self.direction), apart)

    def weights(self, arm: Pair) -> Rate:
        """How much each rate of a link counts."""
        return Rate(*self.direction, dot(self.direction, turned(arm)) + self.lever)

    def left_over(self, more: Pair) -> Number:
        """What the velocities add to `change` on the right-hand side of the accelerations, from the links' surplus."""
        return dot(self.direction, more)


Statement = Turning | Along


class KinematicPair:
    """A pair of links, or what drives one.

    `letter` is what structure calls it; `binds` how many of the freedoms of two links it takes, and what it `passes` on
    to the planner. A pair that takes only one acts as a link of its own between the two: its letters are those of the
    lower pairs that this has with either.
    """

    letter: ClassVar[str] = ""
    binds: ClassVar[int] = 2
    passes: ClassVar[tuple[str, ...]] = ()
    at: str

    @property
    def links(self) -> tuple[str, ...]:
        """The links that it joins; the first carries the pin, or moves on the other."""
        raise NotImplementedError

    def states(self, scene: Scene) -> Iterator[Statement]:
        """What it states, in the numbers of a scene."""
        raise NotImplementedError
