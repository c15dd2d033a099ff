"""Gears and contacts as the closure of a cycle has them: by centres and lengths that stay, and by angles in all.

A contact keeps the centres of its profiles at their distance, or the centre of one on a parallel to the other, which is
straight. Gears turn relative to their line of centres, which is a link, or an arm that is thought in: it is pinned in
one centre, and the other lies on its line.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Any, ClassVar

from graphplan.mechanism.model import FRAME, Contact, Gear, Scene
from graphplan.mechanism.pairs.pair import ROLLING, TOUCHING, Along, Condition, KinematicPair, Statement
from graphplan.mechanism.plane import Pair, X, less, times, turned


@dataclass(frozen=True)
class Higher:
    """What a gear or a contact of this name keeps of the point `at` of `link`, relative to the link `on`."""

    way: ClassVar[str] = ROLLING
    name: str
    link: str
    on: str
    at: str

    @property
    def condition(self) -> Condition:
        """The statement by its name."""
        return Condition(self.link, self.on, self.way, self.name)


@dataclass(frozen=True)
class Apart(Higher):
    """The point and the point `other` of the other link keep their distance."""

    way = TOUCHING
    other: str


@dataclass(frozen=True)
class Racked(Higher):
    """The point moves along a direction fixed to the other link by as much as its link turns there by a lever."""

    direction: Pair
    lever: float


@dataclass(frozen=True)
class Geared(Higher):
    """Two links turn on the line of the centres, the point and `other`, so that the sum of the angles, by `factors`, is
    nothing."""

    other: str
    factors: tuple[float, float]

    @property
    def arm(self) -> str:
        """The name of the line of centres; no link has one with a blank."""
        return f"{self.link} {self.on} {self.at} {self.other}"


Bond = Statement | Higher


def stated(scene: Scene, pair: KinematicPair) -> Iterator[Bond]:
    """What a pair keeps, in the numbers of a scene."""
    if isinstance(pair, Gear):
        yield _gear(pair)
    elif isinstance(pair, Contact):
        yield from _contact(scene, pair)
    else:
        yield from pair.states(scene)


def _gear(gear: Gear) -> Bond:
    """A pair of gears, or a gear on a rack: on its right, it rolls back along the line where it turns on."""
    if gear.direction is not None:
        return Racked(gear.name, *gear.links, gear.centres[0], gear.direction, float(gear.radius))
    (link, on), (at, other), (k1, k2) = gear.links, gear.centres, gear.factors
    return Geared(gear.name, link, on, at, other, (float(k1), float(k2)))


def _contact(scene: Scene, contact: Contact) -> Iterator[Bond]:
    """A contact; where it rolls the radii are the distances of its point from the centres, along the normal."""
    link, on, centre = contact.curved
    if contact.direction is not None:
        yield Along(link, on, centre, turned(contact.direction), TOUCHING, name=contact.name)
        if contact.rolling:
            arm = less(scene.points[contact.at], scene.points[centre])
            (x, y), (u, v) = (map(float, pair) for pair in (contact.direction, arm))
            yield Racked(contact.name, link, on, centre, contact.direction, (y * u - x * v) / math.hypot(x, y))
        return
    other = contact.centres[1] or ""
    yield Apart(contact.name, link, on, centre, other)
    if contact.rolling:
        part = share(scene, contact)
        yield Geared(contact.name, link, on, centre, other, (part, 1.0 - part))


def touching(scene: Scene, contact: Contact, points: Mapping[str, Any], turn: Any) -> Any:
    """Where two profiles touch when points, complex numbers, are elsewhere, and a straight one has turned so."""
    centre, other = contact.curved[2], contact.centres[1] or ""
    if contact.direction is None:
        return points[centre] + share(scene, contact) * (points[other] - points[centre])
    at, seat = (complex(*map(float, scene.points[name])) for name in (contact.at, centre))
    return points[centre] + (at - seat) * turn


def share(scene: Scene, contact: Contact) -> float:
    """By which part of the way from the first centre to the second two arcs touch."""
    at, one, other = (complex(*map(float, scene.points[name or ""])) for name in (contact.at, *contact.centres))
    return ((at - one) / (other - one)).real


class LinesOfCentres:
    """The lines of centres of a scene's gears: for each the link that it is, or the arm that is thought in.

    A link serves that holds both centres and is placed no later than the gears, by its place in `order`; `part` tells
    which links are placed together.
    """

    def __init__(self, scene: Scene, order: Mapping[str, int], part: Mapping[str, int]):
        self.carriers: dict[str, str] = {}
        self.arms: dict[str, Geared] = {}
        bonds = chain.from_iterable(stated(scene, pair) for pair in (*scene.gears, *scene.contacts))
        for bond in bonds:
            if isinstance(bond, Geared) and bond.condition not in scene.redundant:
                last = max(part[bond.link], part[bond.on])
                both = [link for link in scene.links_of[bond.at] if link in scene.links_of[bond.other]
                        and part[link] <= last]
                self.carriers[bond.arm] = min(both, key=order.__getitem__, default=bond.arm)
                if not both:
                    self.arms[bond.arm] = bond

    def bonds(self, name: str, places: Mapping[str, complex]) -> Iterator[Along]:
        """What holds an arm: the pin in one centre, and the other on its line."""
        gear = self.arms[name]
        line = places[gear.other] - places[gear.at]
        across = turned(times(1 / abs(line), (line.real, line.imag)))
        yield Along(name, gear.link, gear.at, X, "x", to=FRAME)
        yield Along(name, gear.link, gear.at, turned(X), "y", to=FRAME)
        yield Along(gear.on, name, gear.other, across, "across")
