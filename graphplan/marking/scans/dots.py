"""Points pricked or drawn: dark spots that fall off to every side, and are darker than lines that cross."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from shapely import LineString, STRtree, points

from graphplan.kernel.kinds import POINT
from graphplan.marking.scans.pencil_pixels import Ink
from graphplan.marking.traces import Spot, Trace

WIDE = 0.25  # mm: half a dot, by which the picture is smoothed
OVAL, DARK = 0.25, 0.05  # how much less it falls off to one side than to another, and the least darkness of a dot
ABOUT = 0.45  # mm in which a dot's middle is weighed
CROSSED = 0.5  # mm from a stroke: what is dark there may be its own darkness, or its crossing with another
# How much darker than a line a dot is for sure, or may be, on no stroke, on one, or where more cross; and from where on
# it may be as oval as it likes.
SURE, MAYBE, BLACK = (0.8, 1.5, 1.95, 2.15, 2.5), (0.0, 1.25, 1.7, 1.9, 2.15), 2.0


def smoothed(ink: Ink) -> NDArray[np.float32]:
    """The pencil blurred by half a dot."""
    import cv2

    return np.asarray(cv2.GaussianBlur(ink.dark, (0, 0), WIDE * ink.scale), np.float32)


def dots(ink: Ink, smooth: NDArray[np.float32], usual: float) -> list[Trace]:
    """All dark spots of the blurred pencil, whose lines are usually so dark, at their centres of darkness."""
    import cv2

    size = 2 * round(2 * WIDE * ink.scale) + 1
    top = (smooth >= cv2.dilate(smooth, np.ones((size, size), np.uint8))) & (smooth > DARK)
    row, column = np.nonzero(top)
    xx, yy, xy = (cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3)[row, column] for i, j in ((2, 0), (0, 2), (1, 1)))
    middle, spread = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    peaked = (middle + spread < 0) & (np.abs(middle + spread) > OVAL * np.abs(middle - spread))
    peaked |= smooth[row, column] > BLACK * usual
    return [_weighed(ink, int(i), int(j)) for i, j in zip(row[peaked], column[peaked], strict=True)]


def marked(found: Sequence[Trace], drawn: Sequence[Trace], darkness: Callable[[Spot], float], least: Sequence[float]
           ) -> Iterator[Trace]:
    """The dots that are more than the strokes on which they lie; `darkness` says how much darker it is about a spot
    than along a line, and `least` how much it must be for how many strokes."""
    strokes, at = STRtree([LineString(trace.spots) for trace in drawn]), points([dot.spots[0] for dot in found])
    crossed = np.bincount(strokes.query(at, "dwithin", CROSSED)[0], minlength=len(found))
    for dot, count in zip(found, crossed, strict=True):
        if darkness(dot.spots[0]) > least[min(count, len(least) - 1)]:
            yield dot


def _weighed(ink: Ink, row: int, column: int) -> Trace:
    """A dot about a pixel; it is as unsure as a tenth of its own width."""
    reach = round(ABOUT * ink.scale)
    rows = slice(max(0, row - reach), row + reach + 1)
    columns = slice(max(0, column - reach), column + reach + 1)
    patch = ink.dark[rows, columns].astype(float)
    y, x = np.mgrid[rows, columns][:, : patch.shape[0], : patch.shape[1]]
    weight = patch / max(patch.sum(), 1e-9)
    at = ink.spots(np.array([[(weight * x).sum(), (weight * y).sum()]]))[0]
    wide = math.sqrt((weight * ((x - column) ** 2 + (y - row) ** 2)).sum() / 2) / ink.scale
    spot: Spot = float(at[0]), float(at[1])
    return Trace(POINT, (spot,), blur=wide / 10)
