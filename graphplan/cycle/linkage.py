"""The linkage in complex numbers: what is rigid, what binds it in any pose, and the order in which links are placed.

A link in another pose is its given figure turned and shifted: the point given at z lies at base + turn (z - origin),
where `turn` is a complex number of size 1. In the given pose every base is its origin and every turn is 1.

The closure is the equations that hold links together in any pose. Poses are complex arrays of shape (n, 2, links): the
base of each link, in reaches of the linkage, and its turn. Each link has three freedoms: its base along x and y, and
the angle of its turn. Lengths are all counted in reaches, so that they weigh as angles do. The same lines serve one
pose and a block of n.

A predicted pose is trusted only where the first correction is small beside the step that it predicts, where each
further one is small beside the one before, and where no determinant of a part has changed its sign: it does wherever
two branches meet.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.mechanism.model import FRAME, Drive, Number, Pair, Scene, Slide
from graphplan.mechanism.pairs.pair import Along, KinematicPair, Statement, Turning
from graphplan.mechanism.pairs.revolute import Revolute, across
from graphplan.mechanism.structure import structure

Array = Any
"""A numpy array; its shape and kind stand where it is made."""


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
    def bonds(self) -> dict[str, tuple[Statement, ...]]:
        """For each link what ties it to links placed before it, or with it; a drive with its pace."""
        found: dict[str, list[Statement]] = {link: [] for link in self.links}
        bonds = [bond for pair in self.scene.binding for bond in self._placed(pair).states(self.scene)
                 if bond.condition not in self.scene.redundant]
        bonds += [replace(bond, rate=pace) for drive, pace in zip(self.scene.drives, self.paces, strict=True)
                  for bond in drive.states(self.scene)]
        for bond in bonds:
            found[max(bond.link, bond.on, key=self.order.__getitem__)].append(bond)
        return {link: tuple(bonds) for link, bonds in found.items()}

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
        """The links that are placed before a part."""
        return self.links[: self.order[part[0]]]

    def pairs(self, link: str, others: tuple[str, ...]) -> tuple[KinematicPair, ...]:
        """The pairs of a link with some others, but for drives."""
        return tuple(pair for pair in self.scene.binding if link in pair.links and {*pair.links} & {*others} - {link})

    def drives(self, part: tuple[str, ...]) -> tuple[tuple[Drive, float], ...]:
        """The drives that work on the links of a part, from links placed before it or with it; each with its pace."""
        known = {*self.carriers(part), *part}
        return tuple((drive, pace) for drive, pace in zip(self.scene.drives, self.paces, strict=True)
                     if {*drive.links} & {*part} and {*drive.links} <= known)


def number(x: Number, y: Number) -> complex:
    """A pair of scene numbers as one complex number."""
    return complex(float(x), float(y))


def direction(of: Slide | Along) -> complex:
    """A direction in the given pose, of length 1."""
    along = number(*of.direction)
    return along / abs(along)


# ---- closure: Newton's correction towards what holds the links together ----------------------------------------------


_NEAR = 1 / 16
"""The largest first correction, of the step."""

_SHRINKING = 1 / 4
"""The largest further correction, of the one before."""

SETTLED = 2.0**-13
"""A quarter of the digits: a correction below it, of the step, leaves half of them, and the next one leaves none."""


class Closure:
    """The closure of some parts of a linkage, what is placed before them being known.

    `blocks` says where the equations and the freedoms of each part lie: no part needs those after it. Equations of one
    kind are reckoned together: `rows` brings them into order, and `cells` are the places of their derivatives.
    """

    def __init__(self, linkage: Linkage, parts: tuple[tuple[str, ...], ...]):
        links = [link for part in parts for link in part]
        first = linkage.order[links[0]]
        self.columns = slice(first, first + len(links))  # the parts follow each other
        ends = np.cumsum([0, *(3 * len(part) for part in parts)])
        self.blocks = [slice(start, end) for start, end in pairwise(ends)]
        bonds = [bond for link in links for bond in linkage.bonds[link]]
        self.drive = np.array([bond.rate / (linkage.reach if isinstance(bond, Along) else 1) for bond in bonds])
        freedom = np.full(len(linkage.links), 3 * len(links))  # the columns of known links fall off the end
        freedom[self.columns] = np.arange(0, 3 * len(links), 3)
        self._gliding(linkage, freedom, {i: bond for i, bond in enumerate(bonds) if isinstance(bond, Along)})
        self._turning(linkage, freedom, {i: bond for i, bond in enumerate(bonds) if isinstance(bond, Turning)})
        self.rows = np.argsort([*self.glide, *self.swing])
        self.cells = np.concatenate([self.glide_cells, self.swing_cells])

    def _gliding(self, linkage: Linkage, freedom: Array, bonds: dict[int, Along]) -> None:
        """A point of one link stays on another, or moves along a direction fixed to a third."""
        self.glide = np.array(list(bonds), dtype=int)
        order, glides = linkage.order, bonds.values()
        named = [(glide.link, glide.on, glide.to or glide.on) for glide in glides]
        link, on, to = ends = np.array([[order[end] for end in three] for three in named], dtype=int).reshape(-1, 3).T
        self.base_ends, self.turn_ends = ends[:2], len(linkage.links) + ends
        arms = [[linkage.places[glide.at] - linkage.origins[end] for end in (glide.link, glide.on)] for glide in glides]
        self.arms = np.array(arms, dtype=complex).reshape(-1, 2).T / linkage.reach
        self.direction = np.array([direction(glide) for glide in glides], dtype=complex)
        row = self.glide * (len(self.drive) + 3)
        self.glide_cells = np.concatenate([row + freedom[end] + k for end in (link, on) for k in range(3)])
        self.to_cells = row + freedom[to] + 2

    def _turning(self, linkage: Linkage, freedom: Array, bonds: dict[int, Turning]) -> None:
        """One link turns on another as a drive says, or not at all."""
        self.swing = np.array(list(bonds), dtype=int)
        ends = np.array([[linkage.order[bond.link], linkage.order[bond.on]] for bond in bonds.values()], dtype=int)
        one, two = ends.reshape(-1, 2).T
        self.swing_ends = len(linkage.links) + np.stack([one, two])
        row = self.swing * (len(self.drive) + 3)
        self.swing_cells = np.concatenate([row + freedom[end] + 2 for end in (one, two)])

    def equations(self, pose: Array, travel: Array) -> tuple[Array, Array]:
        """What each equation leaves, shape (n, k), and its derivatives by the freedoms, shape (n, k, k)."""
        n, k = len(travel), len(self.drive)
        flat, slope = pose.reshape(n, 2 * pose.shape[2]), np.zeros((n, k * (k + 3)))
        base, turn, swing = (flat.take(ends, axis=1) for ends in (self.base_ends, self.turn_ends, self.swing_ends))
        ray = (self.direction * turn[:, 2]).conj()
        levers = ray[:, None] * turn[:, :2] * self.arms
        gap = ray * (base[:, 0] - base[:, 1]) + levers[:, 0] - levers[:, 1]
        excess = swing[:, 0] * swing[:, 1].conj() * np.exp(-1j * travel[:, None] * self.drive[self.swing])
        left = np.concatenate([gap.real - travel[:, None] * self.drive[self.glide], excess.imag], axis=1)
        x, y = ray.real, ray.imag
        slope[:, self.cells] = np.concatenate([x, -y, -levers[:, 0].imag, -x, y, levers[:, 1].imag,
                                               excess.real, -excess.real], axis=1)
        slope[:, self.to_cells] += gap.imag
        return left.take(self.rows, axis=1), slope.reshape(n, k, k + 3)[:, :, :k]

    def correction(self, pose: Array, travel: Array) -> tuple[Array, Array]:
        """Newton's correction to be taken from n poses, in radians and reaches, shape (n, freedoms), and the
        derivatives that it rests on; nan where these are singular."""
        left, jacobian = self.equations(pose, travel)
        return _solved(jacobian, left), jacobian

    def corrected(self, pose: Array, correction: Array) -> Array:
        """The poses less their corrections."""
        shift, angle = self._parted(correction)
        pose = pose.copy()
        pose[:, 0, self.columns] -= shift
        pose[:, 1, self.columns] *= np.exp(-1j * angle)
        return pose

    def rate(self, pose: Array, jacobian: Array) -> Array:
        """How the poses change with the travel, shape (n, 2, links); known links are taken to rest."""
        shift, angle = self._parted(_solved(jacobian, np.tile(self.drive, (len(pose), 1))))
        rate = np.zeros_like(pose)
        rate[:, 0, self.columns] = shift
        rate[:, 1, self.columns] = 1j * angle * pose[:, 1, self.columns]
        return rate

    def _parted(self, freedoms: Array) -> tuple[Array, Array]:
        """The changes of n poses in their freedoms, as those of the bases and of the turns' angles, both (n, links)."""
        x, y, angle = freedoms[:, 0::3], freedoms[:, 1::3], freedoms[:, 2::3]
        return x + 1j * y, angle

    def determinants(self, jacobian: Array) -> tuple[Array, Array]:
        """The sign of each part's determinant in n poses, and the logarithm of its size; shape (n, parts)."""
        found = [np.linalg.slogdet(jacobian[:, part, part]) for part in self.blocks]
        return np.stack([sign for sign, _ in found], axis=-1), np.stack([size for _, size in found], axis=-1)


def _solved(jacobian: Array, right: Array) -> Array:
    """The freedoms that answer the right sides of n poses; nan where the derivatives are singular."""
    try:
        return np.linalg.solve(jacobian, right[..., None])[..., 0]
    except np.linalg.LinAlgError:
        regular = np.linalg.slogdet(jacobian)[0] != 0
        found = np.full(right.shape, np.nan)
        found[regular] = np.linalg.solve(jacobian[regular], right[regular][..., None])[..., 0]
        return found


def given(linkage: Linkage) -> Array:
    """The given pose, as a block of one."""
    bases = np.array([linkage.origins[link] for link in linkage.links]) / linkage.reach
    return np.stack([bases, np.ones_like(bases)])[None]


def settle(closure: Closure, predicted: Array, travel: Array, step: Array) -> tuple[Array, Array, Array]:
    """The poses at these travels, the derivatives last used, and the mask of those to be trusted (their senses apart).

    Reads predictions of shape (n, 2, links), travels (n,), and the length (n,) of the step that predicts each.
    """
    pose, trusted = predicted, np.ones(len(travel), dtype=bool)
    allowed, settled = _NEAR * step, np.zeros(len(travel), dtype=bool)
    while True:
        correction, jacobian = closure.correction(pose, travel)
        size = np.abs(correction).max(axis=1)
        trusted = trusted & (size <= allowed)
        pose = np.where(trusted[:, None, None], closure.corrected(pose, correction), predicted)
        if np.all(settled | ~trusted):
            return pose, jacobian, trusted
        settled = size <= SETTLED * step
        allowed = np.where(settled, _NEAR * step, _SHRINKING * size)


def distance(one: Array, other: Array) -> Array:
    """How far n poses lie apart: the largest change of a link's base, in reaches, or of its turn; shape (n,)."""
    return np.max(np.abs(one - other), axis=(1, 2))
