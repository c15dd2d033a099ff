"""Which lines crests lie on: P. Hough's vote, each crest for the lines through it in about its own direction."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans.ridges import Ridges

TURN, SHIFT = math.radians(0.5), 0.25  # the cells of the vote: angle, and mm
UNSURE = 6  # cells by which a crest's own direction may be off, to each side
LEAST, VOICE = 5.0, 36.0  # mm of a line, and the votes of each mm, below which it is not heard
LOUD = 12.0  # no crest counts for more


class Vote:
    """Hough's accumulator: angles of normals by distances from the origin."""

    def __init__(self, found: Ridges):
        self.count = round(math.pi / TURN)
        self.reach = int(np.hypot(*np.abs(found.spots).max(axis=0, initial=1.0)) / SHIFT) + 2
        angle = np.arctan2(found.normals[:, 1], found.normals[:, 0])
        cells = np.rint(angle / TURN).astype(int)[:, None] + np.arange(-UNSURE, UNSURE + 1)
        turn = cells % self.count * TURN
        shift = found.spots[:, :1] * np.cos(turn) + found.spots[:, 1:] * np.sin(turn)
        level = np.rint(shift / SHIFT).astype(int) + self.reach
        self.cells = cells % self.count * (2 * self.reach + 1) + level
        self.weight = np.minimum(found.strength, LOUD)
        self.votes = self._count(np.arange(len(found)))
        self.best = 0

    def peak(self) -> tuple[float, float] | None:
        """The angle and the distance that most crests vote for; None where there are too few."""
        self.best = int(self.votes.argmax())
        if self.votes[self.best] < LEAST * VOICE:
            return None
        turn, level = divmod(self.best, 2 * self.reach + 1)
        return turn * TURN, (level - self.reach) * SHIFT

    def remove(self, which: NDArray[np.intp]) -> None:
        """Take crests away."""
        self.votes -= self._count(which)

    def forget(self) -> None:
        """Do not look here again."""
        turn, level = divmod(self.best, 2 * self.reach + 1)
        for i in (-1, 0, 1):
            cell = (turn + i) % self.count * (2 * self.reach + 1) + level
            self.votes[max(0, cell - 1) : cell + 2] = -1e9

    def _count(self, which: NDArray[np.intp]) -> NDArray[np.float64]:
        cells = self.cells[which]
        weight = np.repeat(self.weight[which], cells.shape[1])
        votes = np.bincount(cells.ravel(), weight, self.count * (2 * self.reach + 1))
        return np.asarray(votes, np.float64)
