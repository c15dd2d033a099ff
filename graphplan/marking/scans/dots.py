"""The points that a pencil marks: dark dots, which fall off to every side and are darker than lines that cross, and
small rings about a place where lines end or cross.

A ring is what many crests point at the middle of from all around (the vote of D. H. Ballard, 1981). A hand draws it
beside its middle; where lines run into it they tell its middle better."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely import LineString, STRtree, points

from graphplan.kernel.kinds import LINE, POINT
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Spots
from graphplan.marking.scans.pencil_pixels import Ink, Ridges
from graphplan.marking.tolerances import MIN_DIVISOR
from graphplan.marking.traces import Spot, Trace


def dots(ink: Ink, smooth: NDArray[np.float32], usual: float) -> list[Trace]:
    """All dark spots of the blurred pencil, whose lines are usually so dark, at their centres of darkness."""
    size = 2 * round(2 * measures.HALF_DOT_MM * ink.scale) + 1
    top = (smooth >= cv2.dilate(smooth, np.ones((size, size), np.uint8))) & (smooth > measures.MIN_DOT_DARKNESS)
    row, column = np.nonzero(top)
    xx, yy, xy = (cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3)[row, column] for i, j in ((2, 0), (0, 2), (1, 1)))
    middle, spread = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    peaked = (middle + spread < 0) & (np.abs(middle + spread) > measures.MIN_DOT_ROUNDNESS * np.abs(middle - spread))
    peaked |= smooth[row, column] > measures.BLACK_DOT_RATIO * usual
    return [_weighed(ink, int(i), int(j)) for i, j in zip(row[peaked], column[peaked], strict=True)]


def marked(found: Sequence[Trace], drawn: Sequence[Trace], own: Sequence[float], usual: float,
           darkness: Callable[[Spot], float], least: Sequence[float]) -> Iterator[Trace]:
    """The dots that are more than the strokes on which they lie: by `darkness` at a spot they must be darker, `least`
    times for how many strokes, than the darkest of these is by its `own`, or than is `usual`."""
    lines = STRtree([LineString(trace.spots) for trace in drawn])
    at = points(np.array([dot.spots[0] for dot in found]).reshape(-1, 2))
    count, beside = np.zeros(len(found), int), np.zeros(len(found))
    for dot, line in lines.query(at, "dwithin", measures.DOT_STROKE_MM).T:
        count[dot], beside[dot] = count[dot] + 1, max(beside[dot], own[line])
    for dot, crossed, dark in zip(found, count, beside, strict=True):
        if darkness(dot.spots[0]) > least[min(crossed, len(least) - 1)] * (dark or usual):
            yield dot


def _weighed(ink: Ink, row: int, column: int) -> Trace:
    """A dot about a pixel; it is as unsure as a tenth of its own width."""
    reach = round(measures.DOT_REACH_MM * ink.scale)
    rows = slice(max(0, row - reach), row + reach + 1)
    columns = slice(max(0, column - reach), column + reach + 1)
    patch = ink.dark[rows, columns].astype(float)
    y, x = np.mgrid[rows, columns][:, : patch.shape[0], : patch.shape[1]]
    weight = patch / max(patch.sum(), MIN_DIVISOR)
    at = ink.spots(np.array([[(weight * x).sum(), (weight * y).sum()]]))[0]
    wide = math.sqrt((weight * ((x - column) ** 2 + (y - row) ** 2)).sum() / 2) / ink.scale
    return Trace(POINT, ((float(at[0]), float(at[1])),), blur=wide / measures.DOT_BLUR_SHARE)


RADII = np.arange(*measures.RING_RADII_MM)


@dataclass(frozen=True)
class Ring:
    """A small circle about a point: its middle and its radius in mm, and how much more of its rim is drawn than of
    what is beside it."""

    middle: Spots
    radius: float
    clear: float


def rings(found: Ridges, ink: Ink, usual: float) -> list[Ring]:
    """The rings among crests, of a pencil that is usually so dark, the clearest first."""
    looked = [_looked(ink, *candidate, usual) for candidate in _voted(found)]
    kept: list[Ring] = []
    for ring in sorted((ring for ring in looked if ring), key=lambda ring: -ring.clear):
        if all(np.hypot(*(ring.middle - other.middle)) > measures.SAME_RING_SHARE * (ring.radius + other.radius)
               for other in kept):
            kept.append(ring)
    return kept


def _voted(found: Ridges) -> Iterator[tuple[Spots, float]]:
    """Middles that crests point at from most sides of all near by, with the radius at which they do."""
    if not len(found):
        return
    wide, high = ((found.spots.max(axis=0) + 2 * RADII[-1]) / measures.RING_CELL_MM).astype(int) + 2
    heard = np.array([_heard(found, radius, wide, high) for radius in RADII])
    best, which = heard.max(axis=0), heard.argmax(axis=0)
    row, column = np.nonzero((best >= measures.MIN_RING_SIDES) & (best >= cv2.dilate(best, np.ones((3, 3), np.uint8))))
    for i, j in zip(column.tolist(), row.tolist(), strict=True):
        yield np.array([i, j]) * measures.RING_CELL_MM - RADII[-1], float(RADII[which[j, i]])


def _heard(found: Ridges, radius: float, wide: int, high: int) -> NDArray[np.uint8]:
    """From how many sides crests so far away point at each place of a grid, the first of which is beyond the sheet."""
    turn = np.arctan2(found.normals[:, 1], found.normals[:, 0]) / (2 * math.pi)
    heard = np.zeros((measures.RING_SIDES, high, wide), bool)
    for sense, back in ((1.0, 0.0), (-1.0, 0.5)):
        side = np.floor((turn + back) * measures.RING_SIDES).astype(int) % measures.RING_SIDES
        column, row = np.floor((found.spots + sense * radius * found.normals + RADII[-1])
                               / measures.RING_CELL_MM).astype(int).T
        for i in (0, 1):
            for j in (0, 1):
                heard[side, row + j, column + i] = True
    return np.asarray(heard.sum(axis=0, dtype=np.uint8))


def _looked(ink: Ink, middle: Spots, radius: float, usual: float) -> Ring | None:
    """A ring about a middle, moved to where most of its rim is; None where there is none."""
    turns = np.arange(measures.RING_PLACES) * (2 * math.pi / measures.RING_PLACES)
    ways = np.column_stack([np.cos(turns), np.sin(turns)])
    for _ in range(2):
        nearest, step = measures.RING_SEARCH_MM
        reach = np.arange(max(nearest, radius - 2 * measures.RING_OFF_MM),
                          radius + measures.RING_SEARCH_RIMS * measures.RING_OFF_MM, step)
        dark = _dark(ink, middle + np.multiply.outer(reach, ways))
        rim = dark.max(axis=0) > measures.RING_PENCIL_SHARE * usual
        if rim.mean() < measures.MIN_RING_RIM_SHARE * measures.MIN_RING_OPEN_SHARE:
            return None
        design = np.column_stack([ways[rim], np.ones(int(rim.sum()))])
        u, v, radius = np.linalg.lstsq(design, reach[dark.argmax(axis=0)][rim], rcond=None)[0].tolist()
        middle = middle + np.clip([u, v], -measures.RING_CELL_MM, measures.RING_CELL_MM)
    if radius < measures.MIN_RING_RADIUS_MM:
        return None
    rim = _dark(ink, middle + np.multiply.outer(radius + np.array([-measures.RING_OFF_MM, 0.0, measures.RING_OFF_MM]),
                                                ways)).max(axis=0)
    beside = _dark(ink, middle + np.multiply.outer(radius + np.array([-measures.RING_BESIDE_MM,
                                                                      measures.RING_BESIDE_MM]), ways)).max(axis=0)
    seen = rim >= 0
    drawn = seen & (rim > measures.RING_PENCIL_SHARE * usual)
    crest = float((beside[drawn] < measures.RING_LIGHTER_RATIO * rim[drawn]).mean()) if drawn.any() else 0.0
    if (seen.mean() < measures.MIN_RING_OPEN_SHARE or drawn.sum() < measures.MIN_RING_RIM_SHARE * seen.sum()
        or crest < measures.MIN_RING_CREST_SHARE):
        return None
    return Ring(middle, radius, crest)


def _dark(ink: Ink, spots: Spots) -> NDArray[np.float32]:
    """How dark it is at spots; less than nothing where print hides it."""
    cells = ink.cells(spots.reshape(-1, 2))
    return np.where(ink.hidden[cells], np.float32(-1.0), ink.dark[cells]).reshape(spots.shape[:-1])


def ringed(ring: Ring, drawn: Sequence[Trace]) -> Trace:
    """The point that a ring marks: its middle, drawn to the lines that run into it."""
    matrix, right = np.eye(2) / measures.RING_BLUR_MM**2, ring.middle / measures.RING_BLUR_MM**2
    for trace in drawn:
        if trace.kind == LINE:
            start, end = np.array(trace.spots[:2])
            way = (end - start) / (np.hypot(*(end - start)) or 1.0)
            along, normal = (ring.middle - start) @ way, np.array([-way[1], way[0]])
            if -ring.radius < along < np.hypot(*(end - start)) + ring.radius and abs(
                    (ring.middle - start) @ normal) < ring.radius:
                matrix = matrix + np.outer(normal, normal) / measures.RING_LINE_BLUR_MM**2
                right = right + normal * (normal @ start) / measures.RING_LINE_BLUR_MM**2
    (x, y), covariance = np.linalg.solve(matrix, right).tolist(), np.linalg.inv(matrix)
    return Trace(POINT, ((x, y),), blur=math.sqrt(float(np.trace(covariance)) / 2))
