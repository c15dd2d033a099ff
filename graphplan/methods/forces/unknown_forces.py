"""The places where forces are unknown, and what is known of them: the force planner's view of a mechanism.

A *site* is where a force is unknown: a pair, or what balances. The force that passes there acts along a line: of a
pencil through a joint, of the parallels across a guide, or one line alone. At a joint each link has a force from the
pin, and those of all its links balance. Lines and points are homogeneous residues of a prime: for points in general
position, where what holds is what the graph says, and for those of the pose, where nothing may vanish that a move
divides by.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache, cached_property
from random import Random
from typing import NamedTuple, TypeGuard

from graphplan.mechanism.equations import PRIME, System, stages
from graphplan.mechanism.model import Balance, Scene, Slide
from graphplan.methods.motion.facts import Triple, cross, quarter, residues
from graphplan.methods.panels import JointForce

MOST_PARTS = 2000  # of a group: no textbook's has so many
FAR: Triple = (0, 0, 1)  # the line on which all slides' pencils have their points: a force along it is a couple

Part = frozenset[str]  # links of a group, seen as one free body
UnknownForce = JointForce | Slide | Balance


def has_line(site: UnknownForce) -> TypeGuard[Balance | Slide]:
    """Whether the line of a force is known beforehand: of a balance, and of a pair with a guide whose links turn."""
    return isinstance(site, Balance) or (isinstance(site, Slide) and not site.turns_alike)


def groups(scene: Scene) -> list[tuple[str, ...]]:
    """The groups of links in the order of force transfer: those that are loaded by no group left come first."""
    order = {link: i for i, link in enumerate(scene.moving)}
    found = [[name for sort, name in stage if sort == "link"] for stage in stages(System(scene, balanced=True))]
    return [tuple(sorted(team, key=order.__getitem__)) for team in reversed(found) if team]


class ForceGroup:
    """The links of one group, with `done`, those whose forces are known, and all others around it."""

    def __init__(self, scene: Scene, links: tuple[str, ...], done: Iterable[str]):
        self.scene, self.links, self.done = scene, links, frozenset(done)
        self.boundary = cache(self._boundary)

    @cached_property
    def points(self) -> tuple[str, ...]:
        """The joints of the group's links."""
        own = {p: None for link in self.links for p in self.scene.links[link]}
        return tuple(p for p in own if len(self.scene.links_of[p]) > 1)

    def remaining_links(self, point: str) -> frozenset[str]:
        """The links at a joint that are neither the group's nor known."""
        return frozenset(self.scene.links_of[point]) - self.done - frozenset(self.links)

    def members(self, point: str) -> tuple[str, ...]:
        """The group's links at a joint."""
        return tuple(link for link in self.links if point in self.scene.links[link])

    def is_outer(self, site: UnknownForce) -> bool:
        """Whether the site is a pair with what is not the group's."""
        if isinstance(site, JointForce):
            return bool(self.remaining_links(site.point))
        return isinstance(site, Slide) and not {site.link, site.along} <= set(self.links)

    def _boundary(self, part: Part) -> list[tuple[UnknownForce, int]]:
        """The sites at which unknown forces act on a part of the group, each with its sign.

        At a joint within the group the force on the part may be told by that on the other links, reversed.
        """
        found: list[tuple[UnknownForce, int]] = []
        for point in self.points:
            here = [link for link in self.members(point) if link in part]
            side, sign = self._side(point, here)
            found += [(JointForce(point, link), sign) for link in side]
        for slide in self.scene.slides:
            ends = {slide.link, slide.along}
            if len(ends & part) == 1 and not ends & self.done:
                found.append((slide, 1 if slide.link in part else -1))
        for balance in _balances(self.scene):
            if len({*balance.links} & part) == 1 and not {*balance.links} & self.done:
                found.append((balance, 1 if balance.link in part else -1))
        return found

    def _side(self, point: str, here: list[str]) -> tuple[list[str], int]:
        """The links by whose forces that on the links `here` is told; fewer are better, then the first."""
        others = [link for link in self.members(point) if link not in here]
        if not here or self.remaining_links(point):
            return here, 1
        first = self.members(point)[0]
        return (here, 1) if (len(here), first not in here) <= (len(others), first in here) else (others, -1)

    def passed_on(self, part: Part) -> list[str]:
        """The joints at which a part has the known forces of solved groups, besides those of its boundary."""
        sides = {point: self._side(point, [link for link in self.members(point) if link in part])
                 for point in self.points if not self.remaining_links(point) and set(self.members(point)) & part}
        return [point for point, (side, sign) in sides.items() if sign < 0 or not side]

    @cached_property
    def connected_parts(self) -> list[Part]:
        """The connected parts of the group, small ones first."""
        near = {link: self._neighbours(link) for link in self.links}
        found: dict[Part, None] = {frozenset({link}): None for link in self.links}
        for part in (waiting := list(found)):
            for other in set().union(*(near[link] for link in part)) - part:
                larger = part | {other}
                if larger not in found and len(found) < MOST_PARTS:
                    found[larger] = None
                    waiting.append(larger)
        whole = frozenset(self.links)
        order = {link: i for i, link in enumerate(self.links)}
        found.setdefault(whole)
        return sorted(found, key=lambda part: (len(part), sorted(order[link] for link in part)))

    def _neighbours(self, link: str) -> set[str]:
        joined = {other for p in self.scene.links[link] if p in self.points for other in self.members(p)}
        pairs = *((s.link, s.along) for s in self.scene.slides), *(one.links for one in _balances(self.scene))
        slid = {other for pair in pairs if link in pair for other in pair}
        return (joined | slid) & set(self.links) - {link}


class Position(NamedTuple):
    """Places of points, and directions of the forces of slides and balances."""

    points: dict[str, Triple]
    ways: dict[UnknownForce, Triple]

    def pencil(self, site: UnknownForce) -> Triple | None:
        """The point through which all forces of a pair pass; None for a balance."""
        if isinstance(site, JointForce):
            return self.points[site.point]
        return self.ways[site] if isinstance(site, Slide) else None

    def line(self, site: Balance | Slide) -> Triple:
        """The one line of a balance, or of a pair that leaves its links to turn."""
        return cross(self.points[site.at], self.ways[site]) if site.at else FAR

    def finite(self, site: UnknownForce) -> Triple:
        """A finite point on the line of action of an unknown force."""
        name = site.point if isinstance(site, JointForce) else site.at
        return self.points[name or next(iter(self.points))]


def in_general(scene: Scene) -> Position:
    """A position like any other."""
    chance = Random(1952)

    def pair(w: int) -> Triple:
        return chance.randrange(1, PRIME), chance.randrange(1, PRIME), w

    directed: tuple[UnknownForce, ...] = *scene.slides, *_balances(scene)
    return Position({p: pair(1) for p in scene.points}, {site: pair(0) for site in directed})


def scene_position(scene: Scene) -> Position:
    """The position of the scene's pose."""
    ways: dict[UnknownForce, Triple] = {s: (*quarter(residues(s.direction)), 0) for s in scene.slides}
    ways |= {b: (*residues(b.direction), 0) for b in _balances(scene) if b.direction is not None}
    return Position({p: (*residues(at), 1) for p, at in scene.points.items()}, ways)


def _balances(scene: Scene) -> tuple[Balance, ...]:
    return scene.loads.balances if scene.loads else ()


def equation(part: Iterable[str], about: Triple) -> dict[tuple[str, int], int]:
    """The moments about a point of all that acts on a part, as terms of the equilibrium of its links."""
    x, y, w = about
    return {(link, k): c % PRIME for link in part for k, c in enumerate((y, -x, w)) if c % PRIME}


class Span:
    """The equations used so far: a further one is new only if it is linearly independent of them."""

    def __init__(self, rows: Sequence[dict[tuple[str, int], int]] = ()):
        self._rows = list(rows)

    def copy(self) -> Span:
        return Span(self._rows)

    def adds(self, row: dict[tuple[str, int], int]) -> bool:
        """Enter an equation; whether it is new."""
        row = dict(row)
        for known in self._rows:
            pivot = next(iter(known))
            if factor := row.get(pivot, 0):
                for k, c in known.items():
                    row[k] = (row.get(k, 0) - factor * c) % PRIME
        row = {k: c for k, c in row.items() if c}
        if not row:
            return False
        inverse = pow(next(iter(row.values())), -1, PRIME)
        self._rows.append({k: c * inverse % PRIME for k, c in row.items()})
        return True
