"""Equations: which freedoms of links and joints a mechanism has, and what binds them.

Made from the graph alone. Each moving link has three freedoms (the velocity of its point at the origin, and its
turning), each revolute joint of moving links two, so that a joint of many links favours none of them. Where a
coefficient needs coordinates, chance gives them: what holds for points in general position is what the graph says.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property
from random import Random
from typing import Any, NamedTuple

from graphplan.mechanism.model import FRAME, Condition, Drive, Scene, SlidingDrive, TurningDrive

PRIME = 2**61 - 1
"""Coefficients are residues of this prime: exact, of one size, and a chance zero all but impossible."""

Thing = tuple[str, str]
"""What moves: ("link", its name) or ("joint", its point)."""

Unknown = tuple[Thing, str]
"""A freedom of a thing: along x, along y, or its turning."""

Terms = dict[Unknown, Any]
"""Coefficients: whole numbers, that stand for residues, or decimals where the system is of a pose."""


class Equation(NamedTuple):
    """One condition on the freedoms: its terms, the links that it binds, and the drive that makes it, if one does."""

    terms: Terms
    links: tuple[str, ...]
    condition: Condition
    drive: Drive | None = None


class Pose(NamedTuple):
    """Where the points are, in which direction each moving link's joints are held in the way x, and the directions of
    the slides by their two links; in decimals."""

    points: Mapping[str, tuple[Decimal, Decimal]]
    axes: Mapping[str, tuple[Decimal, Decimal]]
    guides: Mapping[tuple[str, str], tuple[Decimal, Decimal]]


@dataclass(frozen=True)
class System:
    """All freedoms of a scene's moving links and all equations, the scene's redundant conditions left out.

    With `balanced`, each balance stands in the place of a drive: it holds the motion on which it does work. Without a
    `pose` points and guides are in general position; in a pose a bar's joints are held across it (x) and along it (y).
    """

    scene: Scene
    balanced: bool = False
    pose: Pose | None = None

    @cached_property
    def known(self) -> frozenset[str]:
        """The points whose motion is given beforehand: those of the frame, and the given motions."""
        return frozenset(self.scene.links.get(FRAME, ())) | frozenset(self.scene.motions)

    @cached_property
    def unknowns(self) -> tuple[Unknown, ...]:
        """All freedoms, in the scene's order."""
        links = [(("link", k), way) for k in self.scene.moving for way in ("x", "y", "turn")]
        joints = [(("joint", p), way) for p in self.scene.joints if p not in self.known for way in ("x", "y")]
        return tuple(links + joints)

    @cached_property
    def equations(self) -> tuple[Equation, ...]:
        """All equations: of the revolute joints, of the slides, of the drives or the balances."""
        return (*self.pairs, *(self._balances() if self.balanced else self.drives))

    @cached_property
    def pairs(self) -> tuple[Equation, ...]:
        """The equations of the revolute joints and of the slides."""
        dropped = frozenset(self.scene.redundant)
        return tuple(e for e in (*self._pins(), *self._slides()) if e.condition not in dropped)

    @cached_property
    def _places(self) -> Mapping[str, tuple[Any, Any]]:
        if self.pose:
            return self.pose.points
        chance = Random(1939)
        return {p: (chance.randrange(1, PRIME), chance.randrange(1, PRIME)) for p in self.scene.points}

    @cached_property
    def _guides(self) -> Mapping[tuple[str, str], tuple[Any, Any]]:
        if self.pose:
            return self.pose.guides
        chance = Random(1966)
        return {(s.link, s.along): (chance.randrange(1, PRIME), chance.randrange(1, PRIME)) for s in self.scene.slides}

    def _pins(self) -> Iterator[Equation]:
        """Each link's point moves as its joint does; a known point's motion stands on the right-hand side."""
        joints = set(self.scene.joints) - self.known
        for link in self.scene.moving:
            for point in self.scene.links[link]:
                if point in joints or point in self.known:
                    ways = self.velocity(link, point)
                    if point in joints:
                        ways = {way: terms | {(("joint", point), way): -1} for way, terms in ways.items()}
                    for way, terms in self._held(link, ways).items():
                        yield Equation(terms, (link,), Condition(link, point, way))

    def _held(self, link: str, ways: dict[str, Terms]) -> dict[str, Terms]:
        """The two equations of a joint along x and y, or in the link's own axes."""
        if not self.pose:
            return ways
        ax, ay = self.pose.axes[link]
        return {"x": _sum((ax, ways["x"]), (ay, ways["y"])), "y": _sum((-ay, ways["x"]), (ax, ways["y"]))}

    def _slides(self) -> Iterator[Equation]:
        """The two links turn alike, and the sliding point does not leave the guide line."""
        for slide in self.scene.slides:
            pair = tuple(link for link in (slide.link, slide.along) if link != FRAME)
            x, y = self._guides[slide.link, slide.along]
            turn, across = (Condition(slide.link, slide.along, way) for way in ("turn", "across"))
            yield Equation(self._turning(slide.link, slide.along), pair, turn)
            yield Equation(self._relative(slide.link, slide.along, slide.at, (-y, x)), pair, across)

    @cached_property
    def drives(self) -> tuple[Equation, ...]:
        """Each drive prescribes a relative turning, or the sliding along a guide."""
        return tuple(self._drives())

    def _drives(self) -> Iterator[Equation]:
        at = {(slide.link, slide.along): slide.at for slide in self.scene.slides}
        for drive in self.scene.drives:
            one, other = ends(drive)
            pair = tuple(link for link in (one, other) if link != FRAME)
            if isinstance(drive, SlidingDrive):
                terms = self._relative(one, other, at[one, other], self._guides[one, other])
                yield Equation(terms, pair, Condition(one, other, "along"), drive)
            else:
                yield Equation(self._turning(one, other), pair, Condition(one, other, "turn"), drive)

    def _balances(self) -> Iterator[Equation]:
        """A moment holds its link's turning, a force its point's motion along it."""
        chance = Random(1952)
        for balance in self.scene.loads.balances if self.scene.loads else ():
            along = chance.randrange(1, PRIME), chance.randrange(1, PRIME)
            held = self._relative(balance.link, FRAME, balance.at, along) if balance.at else {}
            way = Condition(balance.link, FRAME, "along" if balance.at else "turn")
            yield Equation(held or self._turning(balance.link, FRAME), (balance.link,), way)

    def velocity(self, link: str, point: str) -> dict[str, Terms]:
        """The velocity of a link's point, by components; the frame's has no terms."""
        if link == FRAME:
            return {"x": {}, "y": {}}
        body, (x, y) = ("link", link), self._places[point]
        return {"x": {(body, "x"): 1, (body, "turn"): -y}, "y": {(body, "y"): 1, (body, "turn"): x}}

    def _turning(self, link: str, other: str) -> Terms:
        signed = ((link, 1), (other, -1))
        return {(("link", name), "turn"): sign for name, sign in signed if name != FRAME}

    def _relative(self, link: str, other: str, point: str, along: tuple[Any, Any]) -> Terms:
        """The velocity of a point of one link relative to the other, its component along a direction."""
        return _sum(*((sign * factor, terms) for name, sign in ((link, 1), (other, -1))
                      for factor, terms in zip(along, self.velocity(name, point).values(), strict=True)))


def _sum(*parts: tuple[Any, Terms]) -> Terms:
    """The sum of weighted terms."""
    total: Terms = {}
    for weight, terms in parts:
        for unknown, coefficient in terms.items():
            total[unknown] = total.get(unknown, 0) + weight * coefficient
    return total


def ends(drive: Drive) -> tuple[str, str]:
    """The two links between which a drive works."""
    return (drive.link, drive.relative_to) if isinstance(drive, TurningDrive) else (drive.link, drive.along)
