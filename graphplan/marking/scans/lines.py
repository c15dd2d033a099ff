"""Straight pencil lines: crests in a row, fitted by least squares."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphplan.kernel.kinds import LINE
from graphplan.marking.scans.ridges import Ridges
from graphplan.marking.scans.runs import Stretch
from graphplan.marking.scans.warp import Spots
from graphplan.marking.traces import Trace

REACHES = 0.6, 0.6, 0.3, 0.3  # mm from a line, in which crests are taken, from fit to fit
ASKEW = math.cos(math.radians(18.0))  # how well a crest's normal goes with its line's
FEW = 8  # crests below which there is no line
BENT, BETTER = 0.12, 0.7  # mm by which a line bends, more than wobble does, and how much better a bow fits


@dataclass(frozen=True)
class CrestRow:
    """Crests in a row: a spot amid them, their direction and the normal to its left, and of each crest, how far along
    and off it is."""

    at: Spots
    way: Spots
    normal: Spots
    which: NDArray[np.intp]
    along: NDArray[np.float64]
    off: NDArray[np.float64]

    def spots(self, along: NDArray[np.float64], off: NDArray[np.float64] | float = 0.0) -> Spots:
        """Spots so far along the row and off it."""
        return np.asarray(self.at + np.multiply.outer(along, self.way)
                          + np.multiply.outer(off + np.zeros(len(along)), self.normal))

    def part(self, stretch: Stretch) -> NDArray[np.bool_]:
        """Which of its crests a run has."""
        return (stretch.start <= self.along) & (self.along <= stretch.end)


def row(found: Ridges, left: NDArray[np.intp], angle: float, shift: float) -> CrestRow | None:
    """The crests, of those that are left, near the line whose normal has this angle, so many mm from the origin."""
    normal = np.array([math.cos(angle), math.sin(angle)])
    at, which = normal * shift, left
    for reach in REACHES:
        near = (np.abs((found.spots[which] - at) @ normal) < reach) & (np.abs(found.normals[which] @ normal) > ASKEW)
        if near.sum() < FEW:
            return None
        chosen = which[near]
        if which is left:  # a line turns by no more than a few times its width
            which = left[np.abs((found.spots[left] - at) @ normal) < 4 * reach]
        at = found.spots[chosen].mean(axis=0)
        spread = found.spots[chosen] - at
        normal = np.linalg.eigh(spread.T @ spread)[1][:, 0]
    way = np.array([normal[1], -normal[0]])
    return CrestRow(at, way, normal, chosen, spread @ way, spread @ normal)


def line(crests: CrestRow, stretch: Stretch) -> Trace:
    """A run of a row as its two ends; it is as unsure as its crests are rough, the less the longer it is."""
    on = crests.part(stretch)
    slope, level = _line(crests.along[on], crests.off[on])
    ends = np.array([stretch.start, stretch.end])
    (x, y), (u, v) = crests.spots(ends, slope * ends + level).tolist()
    rough = float(np.std(crests.off[on] - slope * crests.along[on] - level))
    return Trace(LINE, ((x, y), (u, v)), blur=rough / math.sqrt(max(1.0, stretch.long)))


def bends(crests: CrestRow, stretch: Stretch) -> bool:
    """Whether the crests of a run follow a bow rather than a line."""
    on = crests.part(stretch)
    along, off = crests.along[on] - crests.along[on].mean(), crests.off[on]
    bow, (slope, level) = np.polyfit(along, off, 2), _line(along, off)
    sag = abs(bow[0]) * (stretch.long / 2) ** 2
    return bool(sag > BENT and np.std(off - np.polyval(bow, along)) < BETTER * np.std(off - slope * along - level))


def _line(along: NDArray[np.float64], off: NDArray[np.float64]) -> tuple[float, float]:
    """Slope and level by least squares."""
    slope, level = np.polyfit(along, off, 1)
    return float(slope), float(level)
