"""Drives: pairs of which a coordinate is prescribed, and points with a given motion."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import pi
from typing import Any, ClassVar

from graphplan.mechanism.fields import BODY, NUMBER, TWO_LINKS, Either, Field, Rows, Table, TableRow, moving
from graphplan.mechanism.numbers import Number, Pair, X, Y, dot, exactly, is_exact, root
from graphplan.mechanism.pairs.pair import FRAME, Along, GivenPose, KinematicPair, Statement, Turning
from graphplan.mechanism.pairs.sliding import has_slide


@dataclass(frozen=True)
class Drive(KinematicPair):
    """A drive of `link` on the link `on`: the velocity that it prescribes, `rate`, and how that changes.

    It turns (rad/s), or it `slides` along the guide of a slide, in lengths. `rpm` is the angular velocity in turns a
    minute, where the scene writes it so.
    """

    binds = 1
    slides: ClassVar[bool]
    link: str
    on: str
    rate: Number
    change: Number
    rpm: Number | None = field(default=None, compare=False)

    @property
    def links(self) -> tuple[str, str]:
        """The driven link, and the one on which it is driven."""
        return self.link, self.on

    @property
    def rates(self) -> tuple[Number, Number]:
        """The velocity and its change."""
        return self.rate, self.change

    def driven_at(self, rate: Any, change: Any) -> Drive:
        """Return the drive with other rates."""
        return replace(self, rate=rate, change=change, rpm=None)


class TurningDrive(Drive):
    """A prescribed angular velocity and acceleration of one link relative to another, counter-clockwise positive."""

    letter, slides = "T", False

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """State the turning of the link relative to the other."""
        yield Turning(*self.links, *self.rates)


class SlidingDrive(Drive):
    """A prescribed speed and acceleration of a link along its guide, positive along the direction."""

    slides = True

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """State the motion of the slide's point along the guide."""
        slide = scene.driven_slide(self)
        yield Along(*self.links, slide.at, slide.direction, "along", *self.rates)


@dataclass(frozen=True)
class Motion:
    """The given motion of one point of an open chain."""

    velocity: Pair
    acceleration: Pair


@dataclass(frozen=True)
class DrivenPoint(KinematicPair):
    """A point with a given motion: its joints pass it on, so it is stated of the first link that has the point."""

    at: str
    link: str
    motion: Motion

    @property
    def links(self) -> tuple[str, str]:
        """The link that has the point, and the frame."""
        return self.link, FRAME

    def states(self, scene: GivenPose) -> Iterator[Statement]:
        """State the motion of the point along x and y."""
        for axis, name in ((X, "x"), (Y, "y")):
            rates = dot(axis, self.motion.velocity), dot(axis, self.motion.acceleration)
            yield Along(self.link, FRAME, self.at, axis, name, *rates)


def _read_turning(row: TableRow) -> TurningDrive | None:
    link, base, rpm = row["link"], row["relative_to"], row.values.get("rpm")
    if link == base:
        instead = "another link, or no relative_to for the frame"
        return row.item.fault(f"link {link} is driven relative to itself", instead)
    if rpm:
        row.names.irrational.append(f"{row.items['rpm'].where}: rpm (2 pi/60)")
    omega = row["omega"] if rpm is None else float(rpm / 30 * Fraction(pi)) if rpm else rpm
    return TurningDrive(link, base, omega, row["alpha"], rpm)


def _read_sliding(row: TableRow) -> SlidingDrive | None:
    slide = has_slide(row, "[[slides]] with it", "one of ")
    if slide is None:
        return None
    if (row["speed"] or row["acceleration"]) and not _length_is_rational(slide.direction):
        row.names.irrational.append(f"{row.item.where}: actuator along a direction of irrational length")
    return SlidingDrive(slide.link, slide.along, row["speed"], row["acceleration"])


def _length_is_rational(direction: Pair) -> bool:
    x, y = exactly(direction)
    return is_exact(direction) and root(x * x + y * y)[1]


def _driven_links(drive: Drive) -> tuple[frozenset[str], str]:
    """The two links that a drive is between."""
    return frozenset(drive.links), "drive between links {} and {}".format(*drive.links)


FIELD = Field("drive", "what drives it: one entry for each degree of freedom", Rows(Either((Table("a turning drive", (
    Field("link", "the driven link", moving("the frame is driven"), 'the driven link, such as link = "1"'),
    Field("omega", "its angular velocity in rad/s, counter-clockwise positive", NUMBER),
    Field("rpm", "its angular velocity in turns a minute, instead of omega", NUMBER),
    Field("alpha", "its angular acceleration in rad/s^2", NUMBER, default=0),
    Field("relative_to", "the link that it turns relative to", BODY, default=FRAME),
), _read_turning, either=("omega", "rpm"), remedy="either omega in rad/s or rpm"), Table("a sliding actuator", (
    Field("slide", "the sliding link and the link with the guide", TWO_LINKS,
          'the sliding link and the guide\'s, such as slide = ["3", "2"]'),
    Field("speed", "the speed along the direction, in length/s", NUMBER, "a length per second, such as speed = 0.5"),
    Field("acceleration", "the acceleration along the direction, in length/s^2", NUMBER, default=0),
), _read_sliding))), remedy="one drive between two links", once=_driven_links))
