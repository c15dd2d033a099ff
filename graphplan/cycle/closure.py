"""Closure: the equations that hold links together in any pose, and Newton's correction towards them.

Poses are complex arrays of shape (n, 2, links): the base of each link, in reaches of the linkage, and its turn. Each
link has three freedoms: its base along x and y, and the angle of its turn. Lengths are all counted in reaches, so that
they weigh as angles do. The same lines serve one pose and a block of n.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array, Gliding, Linkage, Turning


class Correction(NamedTuple):
    """Newton's correction of n poses, their motion a unit of travel, both (n, freedoms), and the derivatives."""

    step: Array
    motion: Array
    jacobian: Array

    @property
    def size(self) -> Array:
        """The largest part of each pose's correction, in radians and reaches; shape (n,)."""
        return np.max(np.abs(self.step), axis=1)


class Closure:
    """The closure of some parts of a linkage, what is placed before them being known.

    `blocks` says where the equations and the freedoms of each part lie: no part needs those after it.
    """

    def __init__(self, linkage: Linkage, parts: tuple[tuple[str, ...], ...]):
        links = [link for part in parts for link in part]
        self.columns = np.array([linkage.order[link] for link in links])
        ends = np.cumsum([0, *(3 * len(part) for part in parts)])
        self.blocks = [slice(start, end) for start, end in pairwise(ends)]
        bonds = [bond for link in links for bond in linkage.bonds[link]]
        self.drive = np.array([bond.rate / (linkage.reach if isinstance(bond, Gliding) else 1) for bond in bonds])
        freedom = np.full(len(linkage.links), 3 * len(links))  # the columns of known links fall off the end
        freedom[self.columns] = np.arange(0, 3 * len(links), 3)
        self._gliding(linkage, freedom, {i: bond for i, bond in enumerate(bonds) if isinstance(bond, Gliding)})
        self._turning(linkage, freedom, {i: bond for i, bond in enumerate(bonds) if isinstance(bond, Turning)})

    def _gliding(self, linkage: Linkage, freedom: Array, bonds: dict[int, Gliding]) -> None:
        """A point of one link stays on another, or moves along a direction fixed to a third."""
        self.glide = np.array(list(bonds), dtype=int)
        self.link, self.on, self.to = (np.array([linkage.order[end] for end in ends], dtype=int) for ends in (
            [bond.link for bond in bonds.values()], [bond.on for bond in bonds.values()],
            [bond.to for bond in bonds.values()]))
        self.arm, self.arm_on = (np.array(arms, dtype=complex) / linkage.reach for arms in (
            [bond.place - linkage.origins[bond.link] for bond in bonds.values()],
            [bond.place - linkage.origins[bond.on] for bond in bonds.values()]))
        self.direction = np.array([bond.direction for bond in bonds.values()], dtype=complex)
        self.of_link, self.of_on, self.of_to = freedom[self.link], freedom[self.on], freedom[self.to]

    def _turning(self, linkage: Linkage, freedom: Array, bonds: dict[int, Turning]) -> None:
        """One link turns on another as a drive says, or not at all."""
        self.swing = np.array(list(bonds), dtype=int)
        self.one, self.two = (np.array([linkage.order[end] for end in ends], dtype=int) for ends in (
            [bond.link for bond in bonds.values()], [bond.on for bond in bonds.values()]))
        self.of_one, self.of_two = freedom[self.one] + 2, freedom[self.two] + 2

    def equations(self, pose: Array, travel: Array) -> tuple[Array, Array]:
        """What each equation leaves, shape (n, k), and its derivatives by the freedoms, shape (n, k, k)."""
        n, k = len(travel), len(self.drive)
        left, slope = np.empty((n, k)), np.zeros((n, k, k + 3))
        base, turn = pose[:, 0], pose[:, 1]
        ray = (self.direction * turn[:, self.to]).conj()
        arm, arm_on = turn[:, self.link] * self.arm, turn[:, self.on] * self.arm_on
        gap = ray * (base[:, self.link] - base[:, self.on] + arm - arm_on)
        left[:, self.glide] = gap.real - travel[:, None] * self.drive[self.glide]
        for sign, column, lever in ((1, self.of_link, arm), (-1, self.of_on, arm_on)):
            slope[:, self.glide, column] += sign * ray.real
            slope[:, self.glide, column + 1] -= sign * ray.imag
            slope[:, self.glide, column + 2] -= sign * (ray * lever).imag
        slope[:, self.glide, self.of_to + 2] += gap.imag
        excess = turn[:, self.one] * turn[:, self.two].conj() * np.exp(-1j * travel[:, None] * self.drive[self.swing])
        left[:, self.swing] = excess.imag
        slope[:, self.swing, self.of_one] += excess.real
        slope[:, self.swing, self.of_two] -= excess.real
        return left, slope[:, :, :k]

    def correction(self, pose: Array, travel: Array) -> Correction:
        """Newton's correction of these poses, to be taken from them; nan where a derivative is singular."""
        left, slope = self.equations(pose, travel)
        right = np.stack([left, np.broadcast_to(self.drive, left.shape)], axis=-1)
        try:
            found = np.linalg.solve(slope, right)
        except np.linalg.LinAlgError:
            regular = np.linalg.slogdet(slope)[0] != 0
            found = np.full(right.shape, np.nan)
            found[regular] = np.linalg.solve(slope[regular], right[regular])
        return Correction(found[..., 0], found[..., 1], slope)

    def corrected(self, pose: Array, correction: Correction) -> Array:
        """The poses less their corrections."""
        x, y, angle = np.moveaxis(correction.step.reshape(len(pose), len(self.columns), 3), -1, 0)
        pose = pose.copy()
        pose[:, 0, self.columns] -= x + 1j * y
        pose[:, 1, self.columns] *= np.exp(-1j * angle)
        return pose

    def rate(self, pose: Array, correction: Correction) -> Array:
        """How the poses change with the travel, shape (n, 2, links); known links are taken to rest."""
        x, y, angle = np.moveaxis(correction.motion.reshape(len(pose), len(self.columns), 3), -1, 0)
        rate = np.zeros_like(pose)
        rate[:, 0, self.columns] = x + 1j * y
        rate[:, 1, self.columns] = 1j * angle * pose[:, 1, self.columns]
        return rate

    def determinants(self, correction: Correction) -> tuple[Array, Array]:
        """The sign of each part's determinant in n poses, and the logarithm of its size; shape (n, parts)."""
        found = [np.linalg.slogdet(correction.jacobian[:, part, part]) for part in self.blocks]
        return np.stack([sign for sign, _ in found], axis=-1), np.stack([size for _, size in found], axis=-1)


def given(linkage: Linkage) -> Array:
    """The given pose, as a block of one."""
    bases = np.array([linkage.origins[link] for link in linkage.links]) / linkage.reach
    return np.stack([bases, np.ones_like(bases)])[None]
