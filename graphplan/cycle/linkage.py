"""The linkage in complex numbers: what of it is rigid, what binds it, and in which order its links are placed.

A link in another pose is its given figure turned and shifted: the point given at z lies at base + turn (z - origin),
where `turn` is a complex number of size 1. In the given pose every base is its origin and every turn is 1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.mechanism.fine import across
from graphplan.mechanism.model import FRAME, Condition, Drive, Number, Scene, Slide, SlidingDrive
from graphplan.mechanism.structure import structure

Array = Any
"""A numpy array; its shape and kind stand where it is made."""


@dataclass(frozen=True)
class Gliding:
    """A point of `link`, given at `place`, leaves its place on `on` along `direction` by `rate` a unit of travel.

    The direction has length 1 and is fixed to `to`.
    """

    link: str
    on: str
    to: str
    place: complex
    direction: complex
    rate: float = 0.0


@dataclass(frozen=True)
class Turning:
    """The link `link` turns on `on` by `rate` a unit of travel."""

    link: str
    on: str
    rate: float = 0.0


Bond = Gliding | Turning


class Linkage:
    """A scene's links, their bonds, and its parts (driving links and groups) in the order of motion transfer.

    `paces` are the travels of the drives for a unit of the first one's.
    """

    def __init__(self, scene: Scene, paces: tuple[float, ...]):
        self.scene, self.paces = scene, paces
        self.places = {name: number(*at) for name, at in scene.points.items()}
        self.parts = tuple(part.links for part in structure(scene).parts)
        self.links = (FRAME, *(link for part in self.parts for link in part))
        self.order = {link: i for i, link in enumerate(self.links)}
        self.origins = {link: self.places[points[0]] if points else 0j
                        for link in self.links for points in [scene.links.get(link, ())]}

    @cached_property
    def reach(self) -> float:
        """The characteristic length: the largest distance of a point from the first one."""
        first = next(iter(self.places.values()))
        return max(abs(place - first) for place in self.places.values()) or 1.0

    @cached_property
    def bonds(self) -> dict[str, tuple[Bond, ...]]:
        """For each link the bonds that tie it to links placed before it, or with it."""
        found: dict[str, list[Bond]] = {link: [] for link in self.links}
        for bond in (*self._pins(), *self._slides(), *self._drives()):
            found[max(bond.link, bond.on, key=self.order.__getitem__)].append(bond)
        return {link: tuple(bonds) for link, bonds in found.items()}

    def _pins(self) -> Iterator[Bond]:
        """Each joint of k links is k - 1 pins, on the link that is placed first: nothing moves there, either way."""
        for point in self.scene.joints:
            held = {link: self._held(link, point, "x", "y") for link in self.scene.links_of[point]}
            first, *others = sorted(held, key=lambda link: (len(held[link]) < 2, self.order[link]))
            for link in others:
                to, across = (FRAME, 1 + 0j) if len(held[link]) == 2 else (link, self._across(link))
                for way in held[link]:
                    yield Gliding(link, first, to, self.places[point], across if way == "x" else 1j * across)

    def _slides(self) -> Iterator[Bond]:
        for slide in self.scene.slides:
            held = self._held(slide.link, slide.along, "turn", "across")
            if "turn" in held:
                yield Turning(slide.link, slide.along)
            if "across" in held:
                across = 1j * direction(slide)
                yield Gliding(slide.link, slide.along, slide.along, self.places[slide.at], across)

    def _held(self, link: str, on: str, *ways: str) -> list[str]:
        """Those of these ways in which a pair holds a link, but for what special geometry makes redundant."""
        return [way for way in ways if Condition(link, on, way) not in self.scene.redundant]

    def _across(self, link: str) -> complex:
        """The way x of the link's joints in the given pose; it turns with the link."""
        way = complex(*across(self.scene, link, {name: (z.real, z.imag) for name, z in self.places.items()}))
        return way / abs(way)

    def special(self, part: tuple[str, ...]) -> bool:
        """Whether a pair of a part is redundant by special geometry, wholly or in a condition."""
        near = {*part, *(point for link in part for point in self.points(link))}
        return any({condition.link, condition.on} & near for condition in self.scene.redundant)

    def _drives(self) -> Iterator[Bond]:
        for drive, pace in zip(self.scene.drives, self.paces, strict=True):
            if isinstance(drive, SlidingDrive):
                slide = self.driven(drive)
                place = self.places[slide.at]
                yield Gliding(slide.link, slide.along, slide.along, place, direction(slide), pace)
            else:
                yield Turning(drive.link, drive.relative_to, pace)

    def driven(self, drive: SlidingDrive) -> Slide:
        """The slide in which a sliding drive works."""
        return next(slide for slide in self.scene.slides if (slide.link, slide.along) == (drive.link, drive.along))

    def points(self, link: str) -> tuple[str, ...]:
        """The points of a link; an open chain may have no frame."""
        return self.scene.links.get(link, ())

    def carriers(self, part: tuple[str, ...]) -> tuple[str, ...]:
        """The links that are placed before a part."""
        return self.links[: self.order[part[0]]]

    def joints(self, link: str, links: tuple[str, ...]) -> tuple[str, ...]:
        """The points that a link shares with some of these links."""
        return tuple(p for p in self.points(link) if any(other in links for other in self.scene.links_of[p]))

    def slides(self, link: str, links: tuple[str, ...]) -> tuple[tuple[Slide, str], ...]:
        """The slides between a link and some of these links, each with the other link."""
        pairs = [(slide, slide.along if slide.link == link else slide.link)
                 for slide in self.scene.slides if link in (slide.link, slide.along)]
        return tuple((slide, other) for slide, other in pairs if other in links)

    def drives(self, part: tuple[str, ...]) -> tuple[tuple[Drive, float], ...]:
        """The drives that work on the links of a part, from links placed before it or with it; each with its pace."""
        known = (*self.carriers(part), *part)
        ends = [(d.link, d.along if isinstance(d, SlidingDrive) else d.relative_to) for d in self.scene.drives]
        return tuple((drive, pace) for drive, pace, pair in zip(self.scene.drives, self.paces, ends, strict=True)
                     if set(pair) & set(part) and set(pair) <= set(known))


def number(x: Number, y: Number) -> complex:
    """A pair of scene numbers as one complex number."""
    return complex(float(x), float(y))


def direction(slide: Slide) -> complex:
    """The guide's direction in the given pose, of length 1."""
    along = number(*slide.direction)
    return along / abs(along)
