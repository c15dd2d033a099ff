"""Where pencil lines run: the crests of darkness, to a part of a pixel, with their directions.

After C. Steger, "An unbiased detector of curvilinear structures" (1998): where the second derivative across a line is
most negative, the first one vanishes at its middle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans.image import deviation
from graphplan.marking.scans.pencil_pixels import Ink
from graphplan.marking.scans.warp import Spots

WIDTH = 0.18  # mm: half a pencil line, by which the picture is smoothed
FAINT, CLEAR = 2.5, 4.5  # strengths, in standard deviations of the paper's own, that may be a line and that are one
ROW = 0.9  # mm of crests without a gap
PART = 0.7  # of a pixel, that a crest's middle is from its pixel's


@dataclass(frozen=True)
class Ridges:
    """Spots on crests, in mm, the unit normals there, and how strong each is beside the paper's grain."""

    spots: Spots
    normals: Spots
    strength: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.spots)

    def only(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Ridges:
        """Some of them."""
        return Ridges(self.spots[which], self.normals[which], self.strength[which])


def clear(found: Ridges, ink: Ink) -> Ridges:
    """Those that make lines for sure: strong, and with neighbours in a row; the paper's grain has none."""
    import cv2

    strong = found.only(found.strength > CLEAR)
    column, row = np.rint(ink.pixels(strong.spots)).astype(int).T
    high, wide = ink.dark.shape
    column, row = np.clip(column, 0, wide - 1), np.clip(row, 0, high - 1)
    marked = np.zeros((high, wide), np.uint8)
    marked[row, column] = 1
    _, which, sizes, _ = cv2.connectedComponentsWithStats(marked, connectivity=8)
    return strong.only(sizes[which[row, column], cv2.CC_STAT_AREA] >= ROW * ink.scale)


def ridges(ink: Ink) -> Ridges:
    """Every crest that may be part of a pencil line."""
    import cv2

    smooth = np.asarray(cv2.GaussianBlur(ink.dark, (0, 0), WIDTH * ink.scale), np.float32)
    xx, yy, xy = (cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3) / 4.0
                  for i, j in ((2, 0), (0, 2), (1, 1)))
    bend = np.sqrt(((xx - yy) / 2) ** 2 + xy**2)
    strength = bend - (xx + yy) / 2  # minus the lesser eigenvalue
    strength[ink.hidden] = 0.0
    open_ = strength[~ink.hidden][::7]
    grain = max(deviation(open_ - np.median(open_)), 1e-6)
    floor = float(np.median(open_)) + FAINT * grain
    row, column = np.nonzero(strength > floor)
    values = [part[row, column].astype(float) for part in (xx, yy, xy)]
    return _crests(ink, smooth, row, column, values, (strength[row, column].astype(float) - np.median(open_)) / grain)


def _crests(ink: Ink, smooth: NDArray[np.float32], row: NDArray[np.intp], column: NDArray[np.intp],
            second: list[NDArray[np.float64]], strength: NDArray[np.float64]) -> Ridges:
    """Of these pixels, those that the middle of a line runs through."""
    import cv2

    xx, yy, xy = second
    gx, gy = (cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3)[row, column].astype(float) / 8 for i, j in ((1, 0), (0, 1)))
    angle = 0.5 * np.arctan2(2 * xy, xx - yy) + np.pi / 2  # of the direction in which it falls off fastest
    nx, ny = np.cos(angle), np.sin(angle)
    across = xx * nx**2 + 2 * xy * nx * ny + yy * ny**2
    off = -(gx * nx + gy * ny) / np.minimum(across, -1e-9)
    crest = (across < 0) & (np.abs(off * nx) < PART) & (np.abs(off * ny) < PART)
    pixels = np.column_stack([column + off * nx, row + off * ny])[crest]
    normals = np.column_stack([nx, -ny])[crest]
    return Ridges(ink.spots(pixels), normals, strength[crest])
