"""Points pricked or drawn: dark spots that fall off to every side."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from graphplan.handed.ink import Ink
from graphplan.handed.traces import Spot, Trace
from graphplan.handed.warp import Spots
from graphplan.kernel.kinds import LINE, POINT

WIDE = 0.25  # mm: half a dot, by which the picture is smoothed
ROUND, DARK = 0.5, 0.12  # how much less it falls off to one side than to another, and the least darkness of a dot
ABOUT = 0.45  # mm in which a dot's middle is weighed
CROSSED = 0.5  # mm from two lines: what is dark there may be their crossing


def dots(ink: Ink, darkest: float = DARK, roundest: float = ROUND) -> list[Trace]:
    """All dark spots, at their centres of darkness."""
    import cv2

    smooth = cv2.GaussianBlur(ink.dark, (0, 0), WIDE * ink.scale)
    size = 2 * round(2 * WIDE * ink.scale) + 1
    top = (smooth >= cv2.dilate(smooth, np.ones((size, size), np.uint8))) & (smooth > darkest)
    row, column = np.nonzero(top)
    xx, yy, xy = (cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3)[row, column] for i, j in ((2, 0), (0, 2), (1, 1)))
    middle, spread = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    peaked = (middle + spread < 0) & (np.abs(middle + spread) > roundest * np.abs(middle - spread))
    return [_weighed(ink, int(i), int(j)) for i, j in zip(row[peaked], column[peaked], strict=True)]


def off_crossings(found: Iterable[Trace], drawn: Iterable[Trace]) -> list[Trace]:
    """The dots that are no crossings of two lines."""
    ends = np.array([trace.spots for trace in drawn if trace.kind == LINE], float).reshape(-1, 2, 2)
    return [dot for dot in found if (_distances(np.array(dot.spots[0]), ends) < CROSSED).sum() < 2]


def _distances(spot: Spots, ends: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far a spot is from each of some lines with ends."""
    way = ends[:, 1] - ends[:, 0]
    part = ((spot - ends[:, 0]) * way).sum(axis=1) / np.maximum((way**2).sum(axis=1), 1e-12)
    return np.asarray(np.hypot(*(spot - ends[:, 0] - np.clip(part, 0, 1)[:, None] * way).T))


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
