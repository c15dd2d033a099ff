"""What a student drew on a straightened sheet, the light evened out and what is printed left out; and where its lines
run: the crests of darkness, to a part of a pixel, with their directions.

Crests after C. Steger, "An unbiased detector of curvilinear structures" (1998): where the second derivative across a
line is most negative, the first one vanishes at its middle.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Light, Spots, deviation
from graphplan.marking.scans.printed_ink import words
from graphplan.marking.tolerances import MIN_DIVISOR
from graphplan.sheet.plates.display import Sheet


@dataclass(frozen=True)
class Ink:
    """Darkness 0..1 of what was drawn, where it is `hidden` by print, `scale` pixels per mm, and the sheet's height."""

    dark: NDArray[np.float32]
    hidden: NDArray[np.bool_]
    scale: float
    height: float

    def pixels(self, spots: Spots) -> Spots:
        """Where spots in mm are, as columns and rows; whole numbers are the middles of pixels."""
        return np.column_stack([spots[:, 0], self.height - spots[:, 1]]) * self.scale - 0.5

    def spots(self, pixels: Spots) -> Spots:
        """Where pixels are, in mm."""
        at = (pixels + 0.5) / self.scale
        return np.column_stack([at[:, 0], self.height - at[:, 1]])

    def covered(self, spots: Spots) -> NDArray[np.bool_]:
        """Which spots are hidden by print; all beside the sheet are."""
        return np.asarray(self.hidden[self.cells(spots)], bool)

    def crossed(self, spots: Spots) -> NDArray[np.bool_]:
        """Which spots are hidden or dark: a line may go on there, under print or another line."""
        cells = self.cells(spots)
        return np.asarray(self.hidden[cells] | (self.dark[cells] > measures.MIN_INK_DARKNESS), bool)

    def cells(self, spots: Spots) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The rows and columns of spots; beside the sheet, those of its edge."""
        high, wide = self.hidden.shape
        at = np.rint(self.pixels(spots)).astype(np.intp)
        np.minimum(np.maximum(at, 0, out=at), (wide - 1, high - 1), out=at)
        return at[:, 1], at[:, 0]


def pencil_ink(image: NDArray[np.float32], sheet: Sheet, light: Light, scale: float) -> Ink:
    """The pencil on the straightened picture of a sheet, whose print is `light` in the same pixels; beyond its plans
    nothing is looked for."""
    paper = np.asarray(image / np.maximum(light, measures.MAX_PRINT_LIGHTNESS), np.float32)
    dark = np.clip(1 - paper / _lit(paper), 0, 1).astype(np.float32)
    inked = ((light < measures.MAX_PRINT_LIGHTNESS) | words(sheet, scale)).astype(np.uint8)
    wide = cv2.morphologyEx(cv2.dilate(inked, _disc(measures.PRINT_RIM_MM * scale)), cv2.MORPH_CLOSE,
                            _disc(measures.PRINT_GAP_MM * scale / 2))
    hidden = np.ones(wide.shape, bool)
    for panel in sheet.panels.values():
        rows = slice(int((sheet.height - panel.top) * scale), int((sheet.height - panel.bottom) * scale))
        columns = slice(int(panel.left * scale), int(panel.right * scale))
        hidden[rows, columns] = wide[rows, columns] > 0
    dark[hidden] = 0.0
    return Ink(dark, hidden, scale, sheet.height)


def _disc(radius: float) -> NDArray[np.uint8]:
    """All that is so many pixels about."""
    size = 2 * round(radius) + 1
    return np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size)), np.uint8)


def _lit(paper: NDArray[np.float32]) -> NDArray[np.float32]:
    """How light the paper would be with nothing on it: the lightest near by, smoothed."""
    high, wide = paper.shape
    small = cv2.resize(paper, (wide // measures.LIGHT_PX, high // measures.LIGHT_PX), interpolation=cv2.INTER_AREA)
    bare = cv2.morphologyEx(np.clip(small, 0, 255).astype(np.uint8), cv2.MORPH_CLOSE,
                            np.ones((measures.LIGHT_LINE_PX, measures.LIGHT_LINE_PX), np.uint8))
    even = cv2.GaussianBlur(cv2.medianBlur(bare, measures.LIGHT_REACH_PX), (0, 0),
                            measures.LIGHT_REACH_PX / 4).astype(np.float32)
    return np.asarray(np.maximum(cv2.resize(even, (wide, high)), 1.0), np.float32)


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
    strong = found.only(found.strength > measures.CLEAR_SIGMAS)
    cells = ink.cells(strong.spots)
    marked = np.zeros(ink.dark.shape, np.uint8)
    marked[cells] = 1
    _, which, sizes, _ = cv2.connectedComponentsWithStats(marked, connectivity=measures.PIXEL_NEIGHBOURS)
    return strong.only(sizes[which[cells], cv2.CC_STAT_AREA] >= measures.MIN_CREST_ROW_MM * ink.scale)


def ridges(ink: Ink) -> Ridges:
    """Every crest that may be part of a pencil line."""
    smooth = np.asarray(cv2.GaussianBlur(ink.dark, (0, 0), measures.HALF_LINE_MM * ink.scale), np.float32)
    xx, yy, xy = (cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3) / 4.0 for i, j in ((2, 0), (0, 2), (1, 1)))
    bend = np.sqrt(((xx - yy) / 2) ** 2 + xy**2)
    strength = bend - (xx + yy) / 2  # minus the lesser eigenvalue
    strength[ink.hidden] = 0.0
    open_ = strength[~ink.hidden][::measures.GRAIN_STRIDE]
    grain = max(deviation(open_ - np.median(open_)), measures.MIN_PAPER_GRAIN)
    floor = float(np.median(open_)) + measures.FAINT_SIGMAS * grain
    row, column = np.nonzero(strength > floor)
    values = [part[row, column].astype(float) for part in (xx, yy, xy)]
    return _crests(ink, smooth, row, column, values, (strength[row, column].astype(float) - np.median(open_)) / grain)


def _crests(ink: Ink, smooth: NDArray[np.float32], row: NDArray[np.intp], column: NDArray[np.intp],
            second: list[NDArray[np.float64]], strength: NDArray[np.float64]) -> Ridges:
    """Of these pixels, those that the middle of a line runs through."""
    xx, yy, xy = second
    gx, gy = (cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3)[row, column].astype(float) / measures.SOBEL_SUM
              for i, j in ((1, 0), (0, 1)))
    angle = 0.5 * np.arctan2(2 * xy, xx - yy) + np.pi / 2  # of the direction in which it falls off fastest
    nx, ny = np.cos(angle), np.sin(angle)
    across = xx * nx**2 + 2 * xy * nx * ny + yy * ny**2
    off = -(gx * nx + gy * ny) / np.minimum(across, -MIN_DIVISOR)
    crest = (across < 0) & (np.abs(off * nx) < measures.CREST_OFF_PX) & (np.abs(off * ny) < measures.CREST_OFF_PX)
    pixels = np.column_stack([column + off * nx, row + off * ny])[crest]
    normals = np.column_stack([nx, -ny])[crest]
    return Ridges(ink.spots(pixels), normals, strength[crest])
