"""What a kinematic pair is: links that it joins, and what it states of their motion relative to each other.

A pair states that one link turns on another in a given way, that a point of one moves on the other with a given
component along a direction or on an arc, or that the two roll on each other: nothing else is ever stated of links.
Each statement has three readings, written apart:

- `residual`: what it leaves in any other pose of the links, over any numbers. Mobility, structure, special geometry and
  the closure of the cycle rest on it.
- `weights`: the row of the velocities, and transposed that of the forces.
- `left_over`: what the velocities add to the accelerations, from centripetal and Coriolis terms.

A test differentiates the first and compares it with the others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar, NamedTuple, Protocol

from graphplan.mechanism.numbers import Number, Pair, dot, is_exact, minus, plus, quarter_turn, times

TOUCHING, ROLLING = "touching", "rolling"
"""The ways in which higher pairs bind."""

Root = Callable[[Any], Any]
"""Gives the root of a squared length in the numbers at hand."""

POINT, LINE, TURNING = "point", "line", "turning"
"""What a pair passes on to those who draw: the end of a point that the links share; a line along the guide on which the
end of its point in one link's plane lies, as seen from the other; that the links turn alike."""


class Condition(NamedTuple):
    """One condition of a kinematic pair: of `link` at the joint `on`, or of the slide of `link` along the link `on`.

    A joint keeps its two links together in the `way` x and in the way y; a slide keeps the sliding link on the guide
    (across) and from turning relative to it (turn). A contact keeps two profiles touching, a gear two links rolling:
    such a pair has its own `name`.
    """

    link: str
    on: str
    way: str
    name: str = ""

    @property
    def pair(self) -> str:
        """The pair's name in results, such as `3 at B`, `3 along 2` or, of gears and contacts, `2 3`."""
        return self.name or f"{self.link} {'at' if self.way in ('x', 'y') else 'along'} {self.on}"


class LinkAttitude(NamedTuple):
    """Position of a link: its origin, and the cosine and the sine of its turn; in any numbers."""

    x: Any
    y: Any
    cos: Any
    sin: Any

    def turn_vector(self, vector: Any) -> Any:
        """Turn a vector that is fixed to the link."""
        return self.cos * vector[0] - self.sin * vector[1], self.sin * vector[0] + self.cos * vector[1]

    def place_of(self, arm: Any) -> Any:
        """Place of the link's point at `arm` from its origin."""
        return plus((self.x, self.y), self.turn_vector(arm))


class Rate(NamedTuple):
    """Of one link: the velocity (x, y) of its base and its turning; or, once more derived, their rates."""

    x: Number
    y: Number
    turn: Number

    def velocity_at(self, arm: Pair) -> Pair:
        """The part linear in the rates of the motion of the link's point at `arm` from its base."""
        return plus((self.x, self.y), times(self.turn, quarter_turn(arm)))


class PairSide(NamedTuple):
    """One link as a statement sees it: the arm from the link's base to the statement's point, and the link's rates."""

    arm: Pair
    rate: Rate

    @property
    def velocity(self) -> Pair:
        """The velocity of the point, or what is linear in the rates of its acceleration."""
        return self.rate.velocity_at(self.arm)

    @property
    def centripetal(self) -> Pair:
        """omega^2 r."""
        return times(self.rate.turn * self.rate.turn, self.arm)


@dataclass(frozen=True)
class PairSides:
    """The two links of a statement."""

    link: PairSide
    on: PairSide

    @property
    def slip(self) -> Pair:
        """The velocity of a point of `link` relative to the coincident point of `on`, in length/s."""
        return minus(self.link.velocity, self.on.velocity)

    @property
    def surplus(self) -> Pair:
        """Nonlinear part of a relative acceleration: centripetal and Coriolis terms, in length/s^2.

        a_rel = (a + alpha x r - omega^2 r) of `link` - the same of `on` - 2 omega_on x v_rel.
        """
        return plus(self.inwards, times(2 * self.on.rate.turn, quarter_turn(self.slip)))

    @property
    def inwards(self) -> Pair:
        """The difference of the centripetal terms."""
        return minus(self.link.centripetal, self.on.centripetal)


Arms = tuple[Pair, Pair]
"""From the bases of the two links of a statement, the arms to its points."""


def angle(x: Any, y: Any) -> Any:
    """By how much a vector has turned that lay along x, in floats or as a power series."""
    return x.angle(y) if hasattr(x, "angle") else math.atan2(y, x)


def turning(link: LinkAttitude, on: LinkAttitude) -> Any:
    """The angle by which a link has turned on another."""
    return angle(link.cos * on.cos + link.sin * on.sin, link.sin * on.cos - link.cos * on.sin)


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
    def ends(self) -> tuple[tuple[str, str], tuple[str, str]]:
        """Each link, with no point."""
        return (self.link, ""), (self.on, "")

    @property
    def condition(self) -> Condition:
        """The statement by its name."""
        return Condition(self.link, self.on, self.way)

    def residual(self, pose: dict[str, LinkAttitude], arms: tuple[Any, Any]) -> Any:
        """The sine of the angle by which one link has turned on the other."""
        link, on = pose[self.link], pose[self.on]
        return link.sin * on.cos - link.cos * on.sin

    def weights(self, arms: Arms, root: Root) -> tuple[Rate, Rate]:
        """The coefficient of each rate of the two links."""
        return Rate(0, 0, 1), Rate(0, 0, -1)

    def left_over(self, sides: PairSides) -> Number:
        """Angular accelerations add up as angular velocities do."""
        return 0


@dataclass(frozen=True)
class Along:
    """The point `at` of `link` moves relative to `on` with a given component along `direction`, which is fixed to `on`.

    `rate` and `change` are the components of velocity and acceleration. A direction in which nothing moves may as well
    be fixed to another link, `to`. What the point does may hang on the turning of `link` on `on`, too, by a `lever`:
    a wheel rolls on a straight line, a force of friction that holds the point passes it.
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
    name: str = ""

    @property
    def ends(self) -> tuple[tuple[str, str], tuple[str, str]]:
        """Each link with the point."""
        return (self.link, self.at), (self.on, self.at)

    @property
    def condition(self) -> Condition:
        """The statement by its name."""
        return Condition(self.link, self.at if self.way in ("x", "y") else self.on, self.way, self.name)

    def residual(self, pose: dict[str, LinkAttitude], arms: tuple[Any, Any]) -> Any:
        """Distance of the point from its place on the other link; `arms` are its places in the two links."""
        gone = dot(pose[self.to or self.on].turn_vector(self.direction), self._displacement(pose, arms))
        return gone + self.lever * turning(pose[self.link], pose[self.on]) if self.lever else gone

    def _displacement(self, pose: dict[str, LinkAttitude], arms: tuple[Any, Any]) -> Any:
        """From the place on the other link to the point."""
        return minus(pose[self.link].place_of(arms[0]), pose[self.on].place_of(arms[1]))

    def weights(self, arms: Arms, root: Root) -> tuple[Rate, Rate]:
        """The coefficient of each rate of the two links."""
        link_turn, on_turn = (dot(self.direction, quarter_turn(arm)) + self.lever for arm in arms)
        (x, y) = self.direction
        return Rate(x, y, link_turn), Rate(-x, -y, -on_turn)

    def left_over(self, sides: PairSides) -> Number:
        """The part of the accelerations' right-hand side that velocities add to `change`, from the links' surplus."""
        return dot(self.direction, sides.surplus)


@dataclass(frozen=True)
class OnRack(Along):
    """The point `at` of `link` moves along `direction` as far as a wheel of this `radius` about it rolls on `on`.

    The wheel is on the left of its pitch line, which is fixed to `on`.
    """

    radius: Number = 0

    def residual(self, pose: dict[str, LinkAttitude], arms: tuple[Any, Any]) -> Any:
        """Distance that the wheel's centre has gone beyond the length that the wheel has rolled."""
        return self.with_lever(lambda square: square ** type(square)(0.5)).residual(pose, arms)

    def weights(self, arms: Arms, root: Root) -> tuple[Rate, Rate]:
        """The coefficient of each rate of the two links."""
        return self.with_lever(root).weights(arms, root)

    def with_lever(self, root: Root) -> Along:
        """Return the statement with its lever: the radius, as the direction has any length."""
        return Along(self.link, self.on, self.at, self.direction, self.way,
                     lever=self.radius * root(dot(self.direction, self.direction)))


@dataclass(frozen=True)
class Touching(Along):
    """Two profiles touch on the normal through the point `at`, which is the centre of curvature of that of `link`.

    `direction` is along the normal: from the centre of the other profile, or across this where it is `straight`. `arm`
    is the vector from where they touch to `at`.
    """

    arm: Pair = (0, 0)
    straight: bool = False

    @property
    def share(self) -> Number:
        """The arm as a part of the direction.

        Parallel curves touch alike, so that where it is irrational any number near it will do.
        """
        share = dot(self.arm, self.direction) / dot(self.direction, self.direction)
        return Fraction(share) if isinstance(share, float) and is_exact(self.direction) else share

    def residual(self, pose: dict[str, LinkAttitude], arms: tuple[Any, Any]) -> Any:
        """Distance of the centre from the curve parallel to the other profile: from a line, or half the growth of the
        squared distance from its centre."""
        gone, radius = self._displacement(pose, arms), pose[self.on].turn_vector(self.direction)
        return dot(radius, gone) if self.straight else dot(radius, gone) + dot(gone, gone) / 2

    def left_over(self, sides: PairSides) -> Number:
        """From n (v_1 - v_2) = 0 where they touch, derived once more as that point runs along both profiles.

        With u_1 and u_2 its speeds along them: u_1 - u_2 is what slides, and both normals are one and turn alike,
        omega_1 + u_1 / rho_1 = omega_2 + u_2 / rho_2. Lengths along the tangent count as parts of that of `direction`.
        """
        normal, to = self.direction, times(-self.share, self.direction)
        square = dot(normal, normal)
        touching = PairSides(*(PairSide(plus(side.arm, to), side.rate) for side in (sides.link, sides.on)))
        link_turn, on_turn = touching.link.rate.turn, touching.on.rate.turn
        slides = dot(quarter_turn(normal), touching.slip) / square
        turns = on_turn if self.straight else slides + self.share * link_turn + (1 - self.share) * on_turn
        along = self.share * (turns - link_turn)
        turning_terms = on_turn * (along - slides) - link_turn * along - turns * slides
        return dot(normal, touching.inwards) + square * turning_terms


@dataclass(frozen=True)
class Rolling:
    """Two links roll on each other as seen from the line of their centres, `at` in `link` and `far` in `on`.

    k_1 (omega_link - omega_line) + k_2 (omega_on - omega_line) = 0, where `factors` are k_1 and k_2 and `line` is the
    vector from the one centre to the other. Other pairs hold these apart.
    """

    link: str
    on: str
    at: str
    far: str
    line: Pair
    factors: Pair
    name: str
    way: str = ROLLING
    rate: Number = 0
    change: Number = 0

    @property
    def ends(self) -> tuple[tuple[str, str], tuple[str, str]]:
        """Each link with its centre."""
        return (self.link, self.at), (self.on, self.far)

    @property
    def condition(self) -> Condition:
        """The statement by its name."""
        return Condition(self.link, self.on, self.way, self.name)

    def residual(self, pose: dict[str, LinkAttitude], arms: tuple[Any, Any]) -> Any:
        """The angles by which the links have turned on the line of centres, times the factors and its squared length.
        """
        link, on, still = pose[self.link], pose[self.on], self.line
        line = minus(on.place_of(arms[1]), link.place_of(arms[0]))
        whole = angle(dot(still, line), dot(quarter_turn(still), line))
        link_angle, on_angle = angle(link.cos, link.sin), angle(on.cos, on.sin)
        k1, k2 = self.factors
        return dot(still, still) * (k1 * (link_angle - whole) + k2 * (on_angle - whole))

    def weights(self, arms: Arms, root: Root) -> tuple[Rate, Rate]:
        """The coefficient of each rate of the two links: omega_line is the centres' relative velocity across the
        line."""
        square, across = dot(self.line, self.line), times(self.factors[0] + self.factors[1], quarter_turn(self.line))
        link_turn, on_turn = (dot(across, quarter_turn(arm)) for arm in arms)
        return (Rate(*across, self.factors[0] * square + link_turn), Rate(-across[0], -across[1],
                                                                          self.factors[1] * square - on_turn))

    def left_over(self, sides: PairSides) -> Number:
        """The centripetal terms of the centres across the line: its own is along it."""
        return dot(times(self.factors[0] + self.factors[1], quarter_turn(self.line)), sides.inwards)


Statement = Turning | Along | Rolling


class GivenPose(Protocol):
    """The part of a scene that pairs read."""

    @property
    def points(self) -> Mapping[str, Pair]:
        """Places of the points."""

    def driven_slide(self, drive: Any) -> Any:
        """The slide in which a sliding drive works."""


class KinematicPair:
    """A pair of links, or what drives one.

    `letter` is what structure calls it; `binds` how many of the freedoms of two links it takes, and what it `passes` on
    to the planner. A pair that takes only one acts as a link of its own between the two: its letters are those of the
    lower pairs that this has with either.
    """

    passes: ClassVar[tuple[str, ...]] = ()
    at: str

    @property
    def letter(self) -> str:
        """The pair's letter in the structural formula."""
        return ""

    @property
    def binds(self) -> int:
        """Number of freedoms that the pair removes."""
        return 2

    @property
    def links(self) -> tuple[str, ...]:
        """The links that it joins; the first carries the pin, or moves on the other."""
        raise NotImplementedError

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """Yield the pair's statements, in the numbers of a scene."""
        raise NotImplementedError


FRAME = "frame"


class FrameName(str):
    """The name of a fixed link that the scene calls otherwise, such as 1: written so, and equal to FRAME."""

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        return str.__eq__(self if isinstance(other, FrameName) else FRAME, other) is True

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(FRAME)
