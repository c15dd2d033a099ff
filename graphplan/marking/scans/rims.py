"""Struck arcs and circles: crests at one distance from a centre, grown from a piece that bends."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphplan.kernel.kinds import CIRCLE
from graphplan.marking.scans.lines import ASKEW
from graphplan.marking.scans.pencil_pixels import Ink
from graphplan.marking.scans.ridges import Ridges
from graphplan.marking.scans.runs import Stretch, stretches
from graphplan.marking.scans.warp import Spots
from graphplan.marking.traces import Trace

NEAR, ROUNDS = 0.35, 8  # mm from a rim in which crests are taken, and how often it may grow
SMALLEST, LARGEST = 1.5, 1000.0  # mm of radius
ROUGH, SEEN = 0.12, 0.55  # mm that a rim's crests are off it, and the share of it that is seen
APART = 20.0  # degrees between the spots that say where a rim is


@dataclass(frozen=True)
class Rim:
    """A circle, and its run, in mm along it from the side `zero`, an angle; with its crests and how rough they are."""

    centre: Spots
    radius: float
    zero: float
    stretch: Stretch
    which: NDArray[np.intp]
    rough: float

    def trace(self) -> Trace:
        """The rim as spots of it, as far as it was drawn."""
        count = max(5, math.ceil(math.degrees(self.stretch.long / self.radius) / APART))
        turns = self.zero + np.linspace(self.stretch.start, self.stretch.end, count) / self.radius
        spots = self.centre + self.radius * np.column_stack([np.cos(turns), np.sin(turns)])
        blur = self.rough / math.sqrt(max(1.0, self.stretch.long))
        return Trace(CIRCLE, tuple((float(x), float(y)) for x, y in spots), blur=blur)


def grown(found: Ridges, left: NDArray[np.intp], seed: NDArray[np.intp], ink: Ink) -> Rim | None:
    """The circle that some crests begin and others, of those that are left, carry on; None where they make none."""
    rim, chosen = None, seed
    for _ in range(ROUNDS):
        centre, radius = through(found.spots[chosen])
        if not SMALLEST < radius < LARGEST:
            return None
        middle = found.spots[seed].mean(axis=0) - centre
        larger = _around(found, left, centre, radius, math.atan2(middle[1], middle[0]), ink)
        if larger is None or (rim is not None and len(larger.which) <= len(rim.which)):
            break
        rim, chosen = larger, larger.which
    return rim if rim and rim.rough < ROUGH and rim.stretch.seen > SEEN else None


def through(spots: Spots) -> tuple[Spots, float]:
    """The centre and the radius of the circle of least squares (I. Kåsa, 1976)."""
    middle = spots.mean(axis=0)
    x, y = (spots - middle).T
    (u, v, w), *_ = np.linalg.lstsq(np.column_stack([2 * x, 2 * y, np.ones(len(x))]), x**2 + y**2, rcond=None)
    return middle + np.array([u, v]), math.sqrt(max(w + u**2 + v**2, 0.0))


def _around(found: Ridges, left: NDArray[np.intp], centre: Spots, radius: float, zero: float, ink: Ink) -> Rim | None:
    """The run of crests on a circle that has this side of it."""
    out = found.spots[left] - centre
    far = np.hypot(out[:, 0], out[:, 1])
    square = np.abs((out * found.normals[left]).sum(axis=1)) > ASKEW * far
    near = (np.abs(far - radius) < NEAR) & square
    if not near.any():
        return None
    turn = (np.arctan2(out[near, 1], out[near, 0]) - zero + math.pi) % (2 * math.pi) - math.pi

    def hidden(along: NDArray[np.float64]) -> NDArray[np.bool_]:
        turns = zero + along / radius
        return ink.crossed(centre + radius * np.column_stack([np.cos(turns), np.sin(turns)]))

    own = [stretch for stretch in stretches(turn * radius, hidden) if stretch.start <= 1.0 and stretch.end >= -1.0]
    if not own:
        return None
    stretch = max(own, key=lambda stretch: stretch.long)
    on = (stretch.start <= turn * radius) & (turn * radius <= stretch.end)
    return Rim(centre, radius, zero, stretch, left[near][on], float(np.std(far[near][on] - radius)))
