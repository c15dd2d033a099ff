"""The linkage in complex numbers: what is rigid, what binds it in any pose, and the order in which links are placed.

A link in another pose is its given figure turned and shifted: the point given at z lies at base + turn (z - origin),
where `turn` is a complex number of size 1. In the given pose every base is its origin and every turn is 1. Lengths are
counted in reaches of the linkage, so that they weigh as angles do.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property
from typing import Any

from graphplan.cycle.higher import Bond, Geared, LinesOfCentres, Racked, stated
from graphplan.mechanism.model import FRAME, Number, Pair, Scene, Slide
from graphplan.mechanism.pairs.pair import Along, KinematicPair
from graphplan.mechanism.pairs.revolute import Revolute, across
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
        self.parts = tuple(part.links for part in structure(scene).parts)
        links = [FRAME, *(link for part in self.parts for link in part)]
        place = {FRAME: -1} | {link: i for i, part in enumerate(self.parts) for link in part}
        self.lines = LinesOfCentres(scene, {link: i for i, link in enumerate(links)}, place)
        self.members = {part: (*part, *(name for name, gear in self.lines.arms.items()
                                        if max(place[gear.link], place[gear.on]) == i))
                        for i, part in enumerate(self.parts)}
        self.links = (FRAME, *(link for part in self.parts for link in self.members[part]))
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
        found: dict[str, list[Bond]] = {link: [] for link in self.links}
        bonds = [bond for pair in self.scene.binding for bond in stated(self.scene, self._placed(pair))
                 if bond.condition not in self.scene.redundant]
        bonds += [bond for name in self.lines.arms for bond in self.lines.bonds(name, self.places)]
        bonds += [replace(bond, rate=pace) for drive, pace in zip(self.scene.drives, self.paces, strict=True)
                  for bond in drive.states(self.scene)]
        for bond in bonds:
            found[max(self.tied(bond), key=self.order.__getitem__)].append(bond)
        return {link: tuple(bonds) for link, bonds in found.items()}

    def tied(self, bond: Bond) -> tuple[str, ...]:
        """The links that a bond ties, that of its direction and the line of centres among them."""
        more = self.lines.carriers[bond.arm] if isinstance(bond, Geared) else getattr(bond, "to", "")
        return (bond.link, bond.on, more) if more else (bond.link, bond.on)

    @property
    def counted(self) -> bool:
        """Whether it must be known how far links have turned in all."""
        return any(isinstance(bond, Geared | Racked) for bonds in self.bonds.values() for bond in bonds)

    def _placed(self, pair: KinematicPair) -> KinematicPair:
        """A joint's pin is on the link that is placed first; a link that it holds in one way alone has its own axis."""
        if not isinstance(pair, Revolute):
            return pair
        half = {c.link for c in self.scene.redundant if c.on == pair.at and c.way in ("x", "y")}
        links = sorted(pair.links, key=lambda link: (link in half, self.order[link]))
        return Revolute(pair.at, tuple(links), {link: self._across(link) for link in half})

    def _across(self, link: str) -> Pair:
        """The way x of the link's joints in the given pose; it turns with the link."""
        x, y = across(self.scene, link, {name: (z.real, z.imag) for name, z in self.places.items()})
        return x / math.hypot(x, y), y / math.hypot(x, y)

    def special(self, part: tuple[str, ...]) -> bool:
        """Whether a pair of a part is redundant by special geometry, wholly or in a condition."""
        near = {*part, *(point for link in part for point in self.points(link))}
        return any({condition.link, condition.on} & near for condition in self.scene.redundant)

    def points(self, link: str) -> tuple[str, ...]:
        """The points of a link; an open chain may have no frame."""
        return self.scene.links.get(link, ())

    def carriers(self, part: tuple[str, ...]) -> tuple[str, ...]:
        """The links placed before a part that it is tied to, but for the frame."""
        bonds = [bond for link in self.members[part] for bond in self.bonds[link]]
        ends = {end for bond in bonds for end in self.tied(bond)}
        placed = {self.order[end] for end in ends - {FRAME}}
        return tuple(self.links[i] for i in sorted(placed) if i < self.order[part[0]])

    def pairs(self, link: str, others: tuple[str, ...]) -> tuple[KinematicPair, ...]:
        """The pairs of a link with some others, but for drives."""
        return tuple(pair for pair in self._pairs[link] if {*pair.links} & {*others} - {link})

    @cached_property
    def _pairs(self) -> dict[str, list[KinematicPair]]:
        """The pairs of each link, but for drives."""
        found: dict[str, list[KinematicPair]] = {link: [] for link in self.links}
        for pair in self.scene.binding:
            for link in pair.links:
                found[link].append(pair)
        return found


def number(x: Number, y: Number) -> complex:
    """A pair of scene numbers as one complex number."""
    return complex(float(x), float(y))


def direction(of: Slide | Along | Racked) -> complex:
    """A direction in the given pose, of length 1."""
    along = number(*of.direction)
    return along / abs(along)


def grounded(scene: Scene) -> Scene:
    """The scene with the points whose motion is given as pins of its frame: how its links lie does not ask for more."""
    if not scene.motions:
        return scene
    return replace(scene, motions={}, links={**scene.links, FRAME: (*scene.links.get(FRAME, ()), *scene.motions)})
