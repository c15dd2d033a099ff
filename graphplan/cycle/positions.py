"""Placing: the links and points of many poses, part after part in the order of motion transfer.

Driving links are turned or shifted as their drives say, dyads constructed by their compass rules, all other groups
closed by Newton's method from the knots of the path. Poses are placed in blocks that stay in the cache, and of a link
that carries nothing only its points.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

import numpy as np

from graphplan.cycle.continuation import Path
from graphplan.cycle.dyads import Attitude, Dyad, Vector, dyad
from graphplan.cycle.linkage import Array, Closure, Linkage, direction, settle
from graphplan.errors import ConstructionError
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.tape.blocks import BLOCK, Blocks
from graphplan.kernel.tape.record import Symbols
from graphplan.mechanism.model import FRAME, Slide
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.mechanism.pairs.revolute import Revolute

Placer: TypeAlias = "_Driven | _Constructed | _Taped | _Closed"
"""Places one part of every pose in a block; `needs` are the links placed before whose base and turn it reads."""


class Failure(NamedTuple):
    """A part that could not be placed, and why."""

    part: tuple[str, ...]
    why: str


@dataclass
class Placed:
    """n poses: the travels, which poses are on the path, and places for what is placed, complex arrays of shape (n,).

    `base` and `turn` have the links that carry something. `failures` tells, for each part that could not be placed, in
    which poses; `first` is where the first one stands among all.
    """

    travel: Array
    followed: Array
    base: dict[str, Array]
    turn: dict[str, Array]
    points: dict[str, Array]
    failures: list[tuple[Failure, Array]] = field(default_factory=list)
    first: int = 0

    def blocks(self) -> Iterator[Placed]:
        """The same poses, so many at a time."""
        for start in range(0, len(self.travel), BLOCK):
            part = slice(start, start + BLOCK)
            base, turn, points = ({name: array[part] for name, array in arrays.items()}
                                  for arrays in (self.base, self.turn, self.points))
            yield Placed(self.travel[part], self.followed[part], base, turn, points, self.failures, start)

    def fail(self, part: tuple[str, ...], why: str, mask: Array) -> None:
        """Keeps where a part could not be placed."""
        self.failures.append((Failure(part, why), self.first + np.flatnonzero(mask)))

    def slots(self, points: Mapping[str, Vector], links: Mapping[str, Attitude]) -> Iterator[tuple[Array, Vector]]:
        """The arrays for these points, and for those of the links that carry something, each with what belongs there.
        """
        yield from ((self.points[point], place) for point, place in points.items())
        for link, (base, turn) in links.items():
            if link in self.base:
                yield from ((self.base[link], base), (self.turn[link], turn))


class Placing:
    """How each part of a linkage is placed: those that are drawn, without a path, are made ready once."""

    def __init__(self, linkage: Linkage):
        self.linkage = linkage
        self.drawn = [None if linkage.special(part) else _drawn(linkage, part) for part in linkage.parts]

    def poses(self, travel: Array) -> Array | None:
        """The poses at these travels as :mod:`linkage` has them, nan where one cannot be drawn; none if a part is not.
        """
        placers = [placer for placer in self.drawn if placer]
        if len(placers) < len(self.drawn):
            return None
        placed = self._standing(travel, np.ones(len(travel), dtype=bool), self.linkage.links)
        for placer in placers:
            placer.place(placed)
        return np.stack([[placed.base[link] / self.linkage.reach, placed.turn[link]] for link in self.linkage.links],
                        axis=-1).transpose(1, 0, 2)

    def place(self, path: Path, travel: Array, reached: Array, knots: Array, links: Iterable[str]) -> Placed:
        """All points at these travels, and the base and turn of some links.

        Reads which poses the path reaches, and which of them are knots of it.
        """
        placers = [placer or _Closed(self.linkage, part, path)
                   for part, placer in zip(self.linkage.parts, self.drawn, strict=True)]
        carrying = {*links, *(link for placer in placers for link in placer.needs)}
        if len(travel) > BLOCK:  # for fewer poses a tape is not worth its recording
            placers = [_taped(placer, carrying) for placer in placers]
        placed = self._standing(travel, reached & ~knots, carrying)
        with np.errstate(all="ignore"):
            for block in placed.blocks():
                for placer in placers:
                    placer.place(block)
        self._stand(placed, path, np.flatnonzero(knots))
        return placed

    def _standing(self, travel: Array, followed: Array, carrying: Iterable[str]) -> Placed:
        """Poses in which the frame is placed, and the points that are on no other link.

        All are rows of one array: a large piece of memory is handed out faster than many small ones.
        """
        linkage, links = self.linkage, [link for link in carrying if link != FRAME]
        rows = iter(np.empty((len(linkage.places) + 2 * len(links), len(travel)), dtype=complex))
        points, base, turn = (dict(zip(names, rows, strict=False)) for names in (linkage.places, links, links))
        base[FRAME], turn[FRAME] = (np.broadcast_to(z, travel.shape) for z in (linkage.origins[FRAME], 1 + 0j))
        for point, others in linkage.scene.links_of.items():
            if not others or FRAME in others:
                points[point].fill(linkage.places[point])
        return Placed(travel, followed, base, turn, points)

    def _stand(self, placed: Placed, path: Path, standing: Array) -> None:
        """The given pose and those at limits are taken from the path: where one is singular, it cannot be reckoned."""
        knots, linkage = path.nearest(placed.travel[standing]), self.linkage
        base, turn = linkage.reach * knots[:, 0], knots[:, 1]
        for link in placed.base.keys() - {FRAME}:
            placed.base[link][standing] = base[:, linkage.order[link]]
            placed.turn[link][standing] = turn[:, linkage.order[link]]
        for point, places in placed.points.items():
            link = next(iter(linkage.scene.links_of[point]), FRAME)
            lever, i = linkage.places[point] - linkage.origins[link], linkage.order[link]
            places[standing] = base[:, i] + turn[:, i] * lever
        placed.failures = [(failure, np.setdiff1d(at, standing)) for failure, at in placed.failures]


class _Body:
    """A link as it is written down, one of its points and its turn being known: the points that no link before it has,
    and its base and turn where it carries something. `place` is where the known point was given.
    """

    def __init__(self, linkage: Linkage, link: str, place: complex):
        self.link, self.to_base = link, linkage.origins[link] - place
        self.levers = {point: linkage.places[point] - place for point in linkage.points(link)
                       if link == min(linkage.scene.links_of[point], key=linkage.order.__getitem__)}

    def put(self, placed: Placed, at: Array, turn: Array) -> None:
        """Write it into the poses."""
        if self.link in placed.base:
            placed.base[self.link][:] = at + turn * self.to_base
            placed.turn[self.link][:] = turn
        for point, lever in self.levers.items():
            np.multiply(turn, lever, out=placed.points[point])
            placed.points[point] += at


def _drawn(linkage: Linkage, part: tuple[str, ...]) -> Placer | None:
    """A link driven alone, turned about a joint with what is placed or shifted along a slide on it; or a plain dyad."""
    link = part[0]
    pairs, drives = linkage.pairs(link, linkage.carriers(part)), linkage.drives(part)
    if [len(part), len(drives), len(pairs)] == [1, 1, 1]:
        ((drive, pace),), (pair,) = drives, pairs
        if isinstance(pair, Slide if drive.slides else Revolute):
            (other,) = {*drive.links} - {link}
            return _Driven(linkage, link, pair, other, pace if drive.link == link else -pace)
    plain = dyad(linkage, part)
    return _Constructed(linkage, part, plain) if plain else None


class _Driven:
    """A link turned about a joint, by `pace` a unit of travel from another link, or shifted so along a slide on it."""

    def __init__(self, linkage: Linkage, link: str, pair: KinematicPair, other: str, pace: float):
        self.pair, self.pace, self.needs = pair, pace, (other,)
        place = linkage.places[pair.at] if isinstance(pair, Revolute) else linkage.origins[link]
        self.body, self.lever = _Body(linkage, link, place), place - linkage.origins[other]

    def place(self, placed: Placed) -> None:
        """Turn it, or shift it."""
        travel, (other,) = self.pace * placed.travel, self.needs
        if isinstance(self.pair, Slide):
            turn = placed.turn[other]
            way = self.lever + direction(self.pair) * travel
            self.body.put(placed, placed.base[other] + turn * way, turn)
            return
        turn = np.empty(len(travel), dtype=complex)
        np.cos(travel, out=turn.real)  # much faster than a complex exponential
        np.sin(travel, out=turn.imag)
        if other != FRAME:
            turn *= placed.turn[other]
        self.body.put(placed, placed.points[self.pair.at], turn)


class _Constructed:
    """A dyad by its compass rule: one program, its rules run over the block."""

    def __init__(self, linkage: Linkage, part: tuple[str, ...], plain: Dyad):
        self.part, self.plain = part, plain
        self.joints = [point for point in plain.known_points if FRAME not in linkage.scene.links_of[point]]
        self.needs = tuple(link for link in plain.known_links if link != FRAME)

    def known(self, placed: Placed) -> list[Array]:
        """What moves of that which is known."""
        arrays = [placed.points[point] for point in self.joints]
        return arrays + [of[link] for link in self.needs for of in (placed.base, placed.turn)]

    def read(self, domain: Arrays | Symbols, known: Iterable[Vector]) -> tuple[dict[str, Vector], dict[str, Attitude]]:
        """What the construction gives, from vectors for what is known."""
        rest = iter(known)
        points = {point: next(rest) for point in self.joints}
        return self.plain.read(domain, points, {link: (next(rest), next(rest)) for link in self.needs})

    def place(self, placed: Placed) -> None:
        """Construct it, and tell where it cannot be."""
        known = self.known(placed)
        points, links = self.read(Arrays(), [(array.real, array.imag) for array in known])
        for array, (x, y) in placed.slots(points, links):
            array.real, array.imag = x, y
        missing = np.zeros(len(placed.travel), dtype=bool)
        for x, y in (*points.values(), *(vector for attitude in links.values() for vector in attitude)):
            missing |= np.isnan(x) | np.isnan(y)
        for array in known:
            missing &= ~np.isnan(array)
        placed.fail(self.part, self.plain.failure, missing)


def _taped(placer: Placer, carrying: Iterable[str]) -> Placer:
    """A placer made faster for many poses, if it is a dyad's and its construction not the same in all of them."""
    if isinstance(placer, _Constructed) and (placer.joints or placer.needs):
        try:
            return _Taped(placer, carrying)
        except (ConstructionError, ZeroDivisionError):  # in no pose can it be drawn
            return placer
    return placer


class _Taped:
    """A dyad by the tape of its construction; a block in which it may fail is left to the rules."""

    def __init__(self, rules: _Constructed, carrying: Iterable[str]):
        self.rules, self.needs = rules, rules.needs
        symbols, count = Symbols(), len(rules.joints) + 2 * len(rules.needs)
        known = [(symbols.tape.input(f"x{i}"), symbols.tape.input(f"y{i}")) for i in range(count)]
        self.points, links = rules.read(symbols, known)
        self.links = {link: attitude for link, attitude in links.items() if link in carrying}
        told = [*self.points.values(), *(vector for attitude in self.links.values() for vector in attitude)]
        self.blocks = Blocks(symbols.tape, [number.place for vector in known for number in vector],
                             [symbols.tape.place(number) for vector in told for number in vector])

    def place(self, placed: Placed) -> None:
        """Run it over the block."""
        known = [numbers for array in self.rules.known(placed) for numbers in (array.real, array.imag)]
        slots = placed.slots(self.points, self.links)
        if self.blocks.run(known, [numbers for array, _ in slots for numbers in (array.real, array.imag)]).size:
            self.rules.place(placed)


class _Closed:
    """Any group by Newton's method, in the poses that are on the path."""

    def __init__(self, linkage: Linkage, part: tuple[str, ...], path: Path):
        self.linkage, self.part, self.path = linkage, part, path
        self.closure, self.needs = Closure(linkage, (part,)), linkage.carriers(part)
        self.sense = path.senses[linkage.parts.index(part)]
        self.bodies = [_Body(linkage, link, linkage.origins[link]) for link in part]

    def place(self, placed: Placed) -> None:
        """Close it, and tell where that is not certain to stay on the branch."""
        on, order = placed.followed, self.linkage.order
        pose, step = self.path.predicted(placed.travel[on])
        for link in self.needs:
            pose[:, 0, order[link]] = placed.base[link][on] / self.linkage.reach
            pose[:, 1, order[link]] = placed.turn[link][on]
        pose, jacobian, trusted = settle(self.closure, pose, placed.travel[on], step)
        trusted &= self.closure.determinants(jacobian)[0][:, 0] == self.sense
        pose[~trusted] = np.nan
        lost = np.zeros(len(on), dtype=bool)
        lost[on] = ~trusted
        placed.fail(self.part, "Newton's method does not stay on their branch", lost)
        for body in self.bodies:
            base, turn = (np.full(len(on), np.nan, dtype=complex) for _ in range(2))
            base[on], turn[on] = self.linkage.reach * pose[:, 0, order[body.link]], pose[:, 1, order[body.link]]
            body.put(placed, base, turn)
