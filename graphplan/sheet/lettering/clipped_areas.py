"""How much of figures lies in boxes: shapely cuts a figure off at a box in seven times the time."""

from __future__ import annotations

import numpy as np
import shapely

from graphplan.sheet.lettering.label_candidates import Array
from graphplan.sheet.tolerances import LEVEL_TOL


class FigureEdges:
    """The edges of polygons of shapely, those of outlines counter-clockwise, those of holes clockwise."""

    def __init__(self, figures: Array):
        rings, figure = shapely.get_rings(figures, return_index=True)
        spots, ring = shapely.get_coordinates(rings, return_index=True)
        inside = ring[1:] == ring[:-1]
        (x, y), (u, v) = spots[:-1][inside].T, spots[1:][inside].T
        ring = ring[:-1][inside]
        doubled = np.bincount(ring, x * v - u * y, len(rings))
        is_hole = np.concatenate([[False], figure[1:] == figure[:-1]])[: len(rings)]
        self.sign = np.where((doubled > 0) != is_hole, 1.0, -1.0)[ring]
        self.x, self.y, self.end = x, y, u
        run = u - x
        self.slope = np.divide(v - y, run, out=np.zeros(len(run)), where=run != 0)
        self.counts = np.bincount(figure[ring], minlength=len(figures))
        self.first = self.counts.cumsum() - self.counts

    def areas(self, boxes: Array, figures: Array) -> Array:
        """The area of each of some figures, told by their numbers, in the box beside it."""
        counts = self.counts[figures]
        pair = np.repeat(np.arange(len(figures)), counts)
        edge = np.arange(len(pair)) + np.repeat(self.first[figures] - (counts.cumsum() - counts), counts)
        lefts, lows, rights, tops = boxes.T[:, pair]
        x, slope = self.x[edge], self.slope[edge]
        start, end = np.clip(x, lefts, rights), np.clip(self.end[edge], lefts, rights)
        foot = self.y[edge] - lows
        under = _mean_between(foot + (start - x) * slope, foot + (end - x) * slope, tops - lows)
        return np.bincount(pair, self.sign[edge] * (start - end) * under, len(figures))


def _mean_between(start: Array, end: Array, most: Array) -> Array:
    """The mean height of what rises evenly from one height to another, where it counts as 0 below 0 and as no more than
    `most` above."""
    from_, to = np.clip(start, 0.0, most), np.clip(end, 0.0, most)
    rise = end - start
    level = np.abs(rise) < LEVEL_TOL
    whole = (to - from_) * (from_ + to) / 2 + to * (end - to) - from_ * (start - from_)
    return np.asarray(np.where(level, (from_ + to) / 2, whole / np.where(level, 1.0, rise)))
