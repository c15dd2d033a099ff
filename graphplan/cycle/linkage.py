"""The linkage in complex numbers: what is rigid, what binds it in any pose, and the order in which links are placed.

A link in another pose is its given figure turned and shifted: the point given at z lies at base + turn (z - origin),
where `turn` is a complex number of size 1. In the given pose every base is its origin and every turn is 1. Lengths are
counted in reaches of the linkage, so that they weigh as angles do.

A contact keeps the centres of its profiles at their distance, or the centre of one on a parallel to the other, which is
straight. Gears turn relative to their line of centres, which is a link, or an arm that is thought in: it is pinned in
one centre, and the other lies on its line.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import Any, ClassVar

from graphplan.mechanism.model import FRAME, Contact, Gear, Number, Pair, Scene, Slide
from graphplan.mechanism.numbers import X, minus, quarter_turn, times
from graphplan.mechanism.pairs.pair import ROLLING, TOUCHING, Along, Condition, KinematicPair, Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.structure import structure

Array = Any
"""A numpy array; its shape and kind stand where it is made."""


class Linkage:
    """A scene's links, their bonds, and its parts (driving links and groups) in the order of motion transfer.

    Its `links` are those of the scene and the arms that are thought in for gears, `members` those of each part.
    `paces` are the travels of the drives for a unit of the first one's. `origins` are where the bases of links were
    given: a first point, until the group of a link says better.
    """

    def __init__(self, scene: Scene, paces: tuple[float, ...]):
        self.scene, self.paces = scene, paces
        self.places = {name: number(*at) for name, at in scene.points.items()}
        self.parts = tuple(group.links for group in structure(scene).parts)
        links = [FRAME, *(link for group in self.parts for link in group)]
        place = {FRAME: -1} | {link: i for i, group in enumerate(self.parts) for link in group}
        self.lines = LinesOfCentres(scene, {link: i for i, link in enumerate(links)}, place)
        self.members = {group: (*group, *(name for name, gear in self.lines.arms.items()
                                          if max(place[gear.link], place[gear.on]) == i))
                        for i, group in enumerate(self.parts)}
        self.links = (FRAME, *(link for group in self.parts for link in self.members[group]))
        self.order = {link: i for i, link in enumerate(self.links)}
        self.origins = {link: self.places[points[0]] if points else 0j
                        for link in self.links for points in [scene.links.get(link, ())]}
        self.origins |= {name: self.places[gear.at] for name, gear in self.lines.arms.items()}

    @cached_property
    def reach(self) -> float:
        """The characteristic length: the largest distance of a point from the first one."""
        first = next(iter(self.places.values()))
        return max(abs(place - first) for place in self.places.values()) or 1.0

    @cached_property
    def bonds(self) -> dict[str, tuple[Bond, ...]]:
        """For each link what ties it to links placed before it, or with it; a drive with its pace."""
        bonds_of: dict[str, list[Bond]] = {link: [] for link in self.links}
        bonds = [bond for pair in self.scene.binding for bond in pair_bonds(self.scene, self._pin_on_first_link(pair))
                 if bond.condition not in self.scene.redundant]
        bonds += [bond for name in self.lines.arms for bond in self.lines.bonds(name, self.places)]
        bonds += [replace(bond, rate=pace) for drive, pace in zip(self.scene.drives, self.paces, strict=True)
                  for bond in drive.states(self.scene)]
        for bond in bonds:
            bonds_of[max(self.tied_links(bond), key=self.order.__getitem__)].append(bond)
        return {link: tuple(bonds) for link, bonds in bonds_of.items()}

    def tied_links(self, bond: Bond) -> tuple[str, ...]:
        """The links that a bond ties, that of its direction and the line of centres among them."""
        more = self.lines.carriers[bond.arm] if isinstance(bond, GearBond) else getattr(bond, "to", "")
        return (bond.link, bond.on, more) if more else (bond.link, bond.on)

    @property
    def counts_angles(self) -> bool:
        """Whether it must be known how far links have turned in all."""
        return any(isinstance(bond, GearBond | RackBond) for bonds in self.bonds.values() for bond in bonds)

    def _pin_on_first_link(self, pair: KinematicPair) -> KinematicPair:
        """A joint's pin is on the link that is placed first; a link that it holds in one way alone has its own axis."""
        if not isinstance(pair, Revolute):
            return pair
        half = {c.link for c in self.scene.redundant if c.on == pair.at and c.way in ("x", "y")}
        links = sorted(pair.links, key=lambda link: (link in half, self.order[link]))
        return Revolute(pair.at, tuple(links), {link: self._joint_axis(link) for link in half})

    def _joint_axis(self, link: str) -> Pair:
        """The way x of the link's joints in the given pose; it turns with the link."""
        x, y = self.scene.across_link(link, {name: (z.real, z.imag) for name, z in self.places.items()})
        return x / math.hypot(x, y), y / math.hypot(x, y)

    def is_special(self, part: tuple[str, ...]) -> bool:
        """Whether a pair of a part is redundant by special geometry, wholly or in a condition."""
        near = {*part, *(point for link in part for point in self.points(link))}
        return any({condition.link, condition.on} & near for condition in self.scene.redundant)

    def points(self, link: str) -> tuple[str, ...]:
        """The points of a link; an open chain may have no frame."""
        return self.scene.links.get(link, ())

    def carriers(self, part: tuple[str, ...]) -> tuple[str, ...]:
        """The links placed before a part that it is tied to, but for the frame."""
        bonds = [bond for link in self.members[part] for bond in self.bonds[link]]
        ends = {end for bond in bonds for end in self.tied_links(bond)}
        places = {self.order[end] for end in ends - {FRAME}}
        return tuple(self.links[i] for i in sorted(places) if i < self.order[part[0]])

    def pairs(self, link: str, others: tuple[str, ...]) -> tuple[KinematicPair, ...]:
        """The pairs of a link with some others, but for drives."""
        return tuple(pair for pair in self._pairs[link] if {*pair.links} & {*others} - {link})

    @cached_property
    def _pairs(self) -> dict[str, list[KinematicPair]]:
        """The pairs of each link, but for drives."""
        pairs_of: dict[str, list[KinematicPair]] = {link: [] for link in self.links}
        for pair in self.scene.binding:
            for link in pair.links:
                pairs_of[link].append(pair)
        return pairs_of


def number(x: Number, y: Number) -> complex:
    """A pair of scene numbers as one complex number."""
    return complex(float(x), float(y))


def unit_direction(of: Slide | Along | RackBond) -> complex:
    """A direction in the given pose, of length 1."""
    along = number(*of.direction)
    return along / abs(along)


def pin_given_motions(scene: Scene) -> Scene:
    """The scene with the points whose motion is given as pins of its frame: how its links lie does not ask for more."""
    if not scene.motions:
        return scene
    return replace(scene, motions={}, links={**scene.links, FRAME: (*scene.links.get(FRAME, ()), *scene.motions)})


# ---- gears and contacts: centres and lengths that stay, and angles in all --------------------------------------------


@dataclass(frozen=True)
class HigherBond:
    """Condition of a gear or a contact on the point `at` of `link`, relative to the link `on`."""

    way: ClassVar[str] = ROLLING
    name: str
    link: str
    on: str
    at: str

    @property
    def condition(self) -> Condition:
        """The condition of this bond, as statements of kinematic pairs name theirs."""
        return Condition(self.link, self.on, self.way, self.name)


@dataclass(frozen=True)
class CentreDistance(HigherBond):
    """The point and the point `other` of the other link keep their distance."""

    way = TOUCHING
    far_centre: str


@dataclass(frozen=True)
class RackBond(HigherBond):
    """The point moves along a direction fixed to the other link by as much as its link turns there by a lever."""

    direction: Pair
    lever: float


@dataclass(frozen=True)
class GearBond(HigherBond):
    """Two links that turn on the line of the centres, the point and `other`, so that the sum of the angles, weighted by
    `factors`, is zero."""

    far_centre: str
    factors: tuple[float, float]

    @property
    def arm(self) -> str:
        """The name of the line of centres; no link has one with a blank."""
        return f"{self.link} {self.on} {self.at} {self.far_centre}"


Bond = Statement | HigherBond


def pair_bonds(scene: Scene, pair: KinematicPair) -> Iterator[Bond]:
    """Yield the conditions of a pair, in the numbers of a scene."""
    if isinstance(pair, Gear):
        yield _gear_bond(pair)
    elif isinstance(pair, Contact):
        yield from _contact_bonds(scene, pair)
    else:
        yield from pair.states(scene)


def _gear_bond(gear: Gear) -> Bond:
    """A pair of gears, or a gear on a rack: on its right, it rolls back along the line where it turns on."""
    if gear.direction is not None:
        return RackBond(gear.name, *gear.links, gear.centres[0], gear.direction, float(gear.radius))
    (link, on), (at, far_centre), (k1, k2) = gear.links, gear.centres, gear.factors
    return GearBond(gear.name, link, on, at, far_centre, (float(k1), float(k2)))


def _contact_bonds(scene: Scene, contact: Contact) -> Iterator[Bond]:
    """A contact; where it rolls the radii are the distances of its point from the centres, along the normal."""
    link, on, centre = contact.curved_side
    if contact.direction is not None:
        yield Along(link, on, centre, quarter_turn(contact.direction), TOUCHING, name=contact.name)
        if contact.rolling:
            arm = minus(scene.points[contact.at], scene.points[centre])
            (x, y), (u, v) = (map(float, pair) for pair in (contact.direction, arm))
            yield RackBond(contact.name, link, on, centre, contact.direction, (y * u - x * v) / math.hypot(x, y))
        return
    far_centre = contact.centres[1] or ""
    yield CentreDistance(contact.name, link, on, centre, far_centre)
    if contact.rolling:
        fraction = contact_fraction(scene, contact)
        yield GearBond(contact.name, link, on, centre, far_centre, (fraction, 1.0 - fraction))


def contact_point(scene: Scene, contact: Contact, points: Mapping[str, Any], turn: Any) -> Any:
    """Contact point of two profiles for other places of the points, complex numbers, and another turn of a straight
    profile."""
    centre, far_centre = contact.curved_side[2], contact.centres[1] or ""
    if contact.direction is None:
        return points[centre] + contact_fraction(scene, contact) * (points[far_centre] - points[centre])
    at, seat = (complex(*map(float, scene.points[name])) for name in (contact.at, centre))
    return points[centre] + (at - seat) * turn


def contact_fraction(scene: Scene, contact: Contact) -> float:
    """Position of the point of contact of two arcs on their line of centres: 0 at the first centre, 1 at the second."""
    at, first, second = (complex(*map(float, scene.points[name or ""])) for name in (contact.at, *contact.centres))
    return ((at - first) / (second - first)).real


class LinesOfCentres:
    """The lines of centres of a scene's gears: for each the link that it is, or the arm that is thought in.

    A link serves that holds both centres and is placed no later than the gears, by its place in `order`; `part` tells
    which links are placed together.
    """

    def __init__(self, scene: Scene, order: Mapping[str, int], part: Mapping[str, int]):
        self.carriers: dict[str, str] = {}
        self.arms: dict[str, GearBond] = {}
        bonds = chain.from_iterable(pair_bonds(scene, pair) for pair in (*scene.gears, *scene.contacts))
        for bond in bonds:
            if isinstance(bond, GearBond) and bond.condition not in scene.redundant:
                last = max(part[bond.link], part[bond.on])
                holders = [link for link in scene.links_of[bond.at] if link in scene.links_of[bond.far_centre]
                           and part[link] <= last]
                self.carriers[bond.arm] = min(holders, key=order.__getitem__, default=bond.arm)
                if not holders:
                    self.arms[bond.arm] = bond

    def bonds(self, name: str, places: Mapping[str, complex]) -> Iterator[Along]:
        """Yield the conditions on an arm: the pin in one centre, and the other on its line."""
        gear = self.arms[name]
        line = places[gear.far_centre] - places[gear.at]
        across = quarter_turn(times(1 / abs(line), (line.real, line.imag)))
        yield Along(name, gear.link, gear.at, X, "x", to=FRAME)
        yield Along(name, gear.link, gear.at, quarter_turn(X), "y", to=FRAME)
        yield Along(gear.on, name, gear.far_centre, across, "across")
