"""Placing: the links and points of a block of poses, part after part in the order of motion transfer.

Driving links are turned or shifted as their drives say, dyads constructed by their compass rules, all other groups
closed by Newton's method from the knots of the path.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from graphplan.cycle.closure import Closure
from graphplan.cycle.continuation import Path
from graphplan.cycle.dyads import Dyad, dyad
from graphplan.cycle.linkage import Array, Linkage, direction
from graphplan.cycle.newton import settle
from graphplan.kernel.evaluate import evaluate
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.mechanism.model import FRAME, SlidingDrive


class Failure(NamedTuple):
    """A part that could not be placed, and why."""

    part: tuple[str, ...]
    why: str


@dataclass
class Placed:
    """A block of n poses: the travels, which poses are on the path, and what is placed; complex arrays of shape (n,).

    `failures` has, for each part that could not be placed, the mask of poses.
    """

    travel: Array
    followed: Array
    base: dict[str, Array] = field(default_factory=dict)
    turn: dict[str, Array] = field(default_factory=dict)
    points: dict[str, Array] = field(default_factory=dict)
    failures: list[tuple[Failure, Array]] = field(default_factory=list)


Placer = Callable[[Placed], None]
"""Places one part of every pose in a block."""


class Placing:
    """How each part of a linkage is placed, made ready once for all blocks."""

    def __init__(self, linkage: Linkage, path: Path):
        self.linkage, self.path = linkage, path
        self.placers = [self._placer(part) for part in linkage.parts]

    def place(self, travel: Array, reached: Array, knots: Array) -> Placed:
        """All links and points at these travels; those that are on no link, or on the frame, stand still.

        Reads which poses the path reaches, and which of them are knots of it.
        """
        placed, n = Placed(travel, reached & ~knots), len(travel)
        placed.base[FRAME], placed.turn[FRAME] = np.full(n, self.linkage.origins[FRAME]), np.ones(n, dtype=complex)
        for point, links in self.linkage.scene.links_of.items():
            if not links or FRAME in links:
                placed.points[point] = np.full(n, self.linkage.places[point])
        with np.errstate(all="ignore"):
            for place in self.placers:
                place(placed)
        self._stand(placed, knots)
        return placed

    def _stand(self, placed: Placed, standing: Array) -> None:
        """The given pose and those at limits are taken from the path: where one is singular, it cannot be reckoned."""
        knots = self.path.nearest(placed.travel[standing])
        for link, i in self.linkage.order.items():
            placed.base[link][standing] = self.linkage.reach * knots[:, 0, i]
            placed.turn[link][standing] = knots[:, 1, i]
        for point, places in placed.points.items():
            link = next(iter(self.linkage.scene.links_of[point]), FRAME)
            lever = self.linkage.places[point] - self.linkage.origins[link]
            places[standing] = placed.base[link][standing] + placed.turn[link][standing] * lever
        for _, mask in placed.failures:
            mask &= ~standing

    def _placer(self, part: tuple[str, ...]) -> Placer:
        """The way to place a part."""
        driven = self._driven(part)
        if driven is not None:
            return driven
        plain = dyad(self.linkage, part)
        return self._closed(part) if plain is None else self._constructed(part, plain)

    def _driven(self, part: tuple[str, ...]) -> Placer | None:
        """A link driven alone: turned about a joint with what is placed, or shifted along a slide on it."""
        link, before = part[0], self.linkage.carriers(part)
        joints, slides = self.linkage.joints(link, before), self.linkage.slides(link, before)
        drives = self.linkage.drives(part)
        if len(part) != 1 or len(drives) != 1 or len(joints) + len(slides) != 1:
            return None
        ((drive, pace),) = drives
        if isinstance(drive, SlidingDrive):
            ((slide, carrier),) = slides
            way = direction(slide) * (pace if slide.link == link else -pace)
            return lambda placed: self._shifted(placed, link, carrier, way)
        other = drive.relative_to if drive.link == link else drive.link
        turning = pace if drive.link == link else -pace
        return lambda placed: self._turned(placed, link, joints[0], other, turning)

    def _turned(self, placed: Placed, link: str, joint: str, other: str, pace: float) -> None:
        turn = placed.turn[other] * np.exp(1j * pace * placed.travel)
        lever = self.linkage.places[joint] - self.linkage.origins[link]
        self._put(placed, link, placed.points[joint] - turn * lever, turn)

    def _shifted(self, placed: Placed, link: str, carrier: str, way: complex) -> None:
        lever = self.linkage.origins[link] - self.linkage.origins[carrier]
        turn = placed.turn[carrier]
        self._put(placed, link, placed.base[carrier] + turn * (lever + way * placed.travel), turn)

    def _put(self, placed: Placed, link: str, base: Array, turn: Array) -> None:
        """A link, and its points that are not placed yet."""
        placed.base[link], placed.turn[link] = base, turn
        origin = self.linkage.origins[link]
        for point in self.linkage.points(link):
            placed.points.setdefault(point, base + turn * (self.linkage.places[point] - origin))

    def _constructed(self, part: tuple[str, ...], plain: Dyad) -> Placer:
        """A dyad by its compass rule: one program, replayed over the block."""

        def place(placed: Placed) -> None:
            known = {mark: placed.points[point] for point, mark in plain.known_points.items()}
            for link, marks in plain.known_links.items():
                base, reach = placed.base[link], self.linkage.reach
                known |= dict(zip(marks, (base, base + reach * placed.turn[link]), strict=True))
            given = {mark: {"x": place.real, "y": place.imag} for mark, place in known.items()}
            values = evaluate(plain.program, Arrays(), given)
            found = [x + 1j * y for x, y in (values[index] for index in plain.program.wanted)]
            placed.points |= dict(zip(plain.points, found, strict=False))
            rest = iter(found[len(plain.points):])
            for (link, at, vector), point, tail, head in zip(plain.links, rest, rest, rest, strict=True):
                placed.turn[link] = (head - tail) / vector
                placed.base[link] = point + placed.turn[link] * (self.linkage.origins[link] - at)
            missing = np.logical_or.reduce([np.isnan(placed.base[link]) for link in part])
            reachable = ~np.logical_or.reduce([np.isnan(value) for value in known.values()])
            placed.failures.append((Failure(part, plain.failure), missing & reachable))

        return place

    def _closed(self, part: tuple[str, ...]) -> Placer:
        """Any group by Newton's method, in the poses that are on the path."""
        closure, reach = Closure(self.linkage, (part,)), self.linkage.reach
        before, links = self.linkage.carriers(part), self.linkage.order
        sense = self.path.senses[0, self.linkage.parts.index(part)]

        def place(placed: Placed) -> None:
            on = placed.followed
            pose, step = self.path.predicted(placed.travel[on])
            for link in before:
                pose[:, 0, links[link]] = placed.base[link][on] / reach
                pose[:, 1, links[link]] = placed.turn[link][on]
            pose, correction, trusted = settle(closure, pose, placed.travel[on], step)
            trusted &= closure.determinants(correction)[0][:, 0] == sense
            pose[~trusted] = np.nan
            lost = np.zeros(len(on), dtype=bool)
            lost[on] = ~trusted
            placed.failures.append((Failure(part, "Newton's method does not stay on their branch"), lost))
            for link in part:
                base, turn = (np.full(len(on), np.nan, dtype=complex) for _ in range(2))
                base[on], turn[on] = reach * pose[:, 0, links[link]], pose[:, 1, links[link]]
                self._put(placed, link, base, turn)

        return place
