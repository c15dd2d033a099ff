"""Drives: pairs of which a coordinate is prescribed, and points that move as they are told."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar

from graphplan.mechanism.pairs.pair import FRAME, Along, KinematicPair, Statement, Turning
from graphplan.mechanism.plane import Number, Pair, X, Y, dot

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene


class Drive(KinematicPair):
    """A drive between two links, of the first on the second: whether it `slides`, and otherwise turns."""

    binds = 1
    slides: ClassVar[bool]

    @property
    def links(self) -> tuple[str, str]:
        """The driven link, and the one on which it is driven."""
        raise NotImplementedError

    @property
    def rates(self) -> tuple[Number, Number]:
        """What it prescribes: a velocity and an acceleration, of turning or of sliding."""
        raise NotImplementedError

    @property
    def rate(self) -> Number:
        """The velocity alone."""
        return self.rates[0]

    @property
    def change(self) -> Number:
        """The acceleration alone."""
        return self.rates[1]

    def driven_at(self, rate: Any, change: Any) -> Drive:
        """The same drive with other rates."""
        raise NotImplementedError


@dataclass(frozen=True)
class TurningDrive(Drive):
    """A prescribed angular velocity (rad/s) and acceleration (rad/s^2) of `link` relative to `relative_to`.

    `rpm` is the angular velocity in turns a minute, where the scene writes it so.
    """

    letter = "T"
    slides = False
    link: str
    relative_to: str
    omega: Number
    alpha: Number
    rpm: Number | None = field(default=None, compare=False)

    @property
    def links(self) -> tuple[str, str]:
        """The driven link, and the one on which it is driven."""
        return self.link, self.relative_to

    @property
    def rates(self) -> tuple[Number, Number]:
        """The angular velocity and acceleration."""
        return self.omega, self.alpha

    def driven_at(self, rate: Any, change: Any) -> Drive:
        """The same drive, turning otherwise."""
        return replace(self, omega=rate, alpha=change, rpm=None)

    def states(self, scene: Scene) -> Iterator[Statement]:
        """How the link turns on the other."""
        yield Turning(*self.links, *self.rates)


@dataclass(frozen=True)
class SlidingDrive(Drive):
    """A prescribed speed and acceleration of `link` along its guide on `along`, positive along the direction."""

    slides = True
    link: str
    along: str
    speed: Number
    acceleration: Number

    @property
    def links(self) -> tuple[str, str]:
        """The driven link, and that of the guide."""
        return self.link, self.along

    @property
    def rates(self) -> tuple[Number, Number]:
        """The speed and the acceleration."""
        return self.speed, self.acceleration

    def driven_at(self, rate: Any, change: Any) -> Drive:
        """The same drive, sliding otherwise."""
        return replace(self, speed=rate, acceleration=change)

    def states(self, scene: Scene) -> Iterator[Statement]:
        """How the point of its slide runs along the guide."""
        slide = scene.driven_slide(self)
        yield Along(*self.links, slide.at, slide.direction, "along", *self.rates)


@dataclass(frozen=True)
class Motion:
    """The given motion of one point of an open chain."""

    velocity: Pair
    acceleration: Pair


@dataclass(frozen=True)
class DrivenPoint(KinematicPair):
    """A point with a given motion: its joints pass it on, so it is told of the first link that has the point."""

    at: str
    link: str
    motion: Motion

    @property
    def links(self) -> tuple[str, str]:
        """The link that is told of it; it moves over the frame."""
        return self.link, FRAME

    def states(self, scene: Scene) -> Iterator[Statement]:
        """How the point moves along x and y."""
        for axis, way in ((X, "x"), (Y, "y")):
            rates = dot(axis, self.motion.velocity), dot(axis, self.motion.acceleration)
            yield Along(self.link, FRAME, self.at, axis, way, *rates)
