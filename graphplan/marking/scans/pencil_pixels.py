"""What a student drew on a straightened sheet: the light evened out, and what is printed left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans.printed_ink import Light, words
from graphplan.marking.scans.warp import Spots
from graphplan.sheet.plates.display import Sheet

COARSE, LIGHTEST, WIDE = 4, 5, 31  # how much coarser light is estimated; of those pixels: lines left out, and its reach
DARK = 0.12  # what is no paper
TINT = 0.75  # what is printed lighter than this is paper, on which pencil is seen
BESIDE, BETWEEN = 0.25, 1.25  # mm beside print, and between two edges of it, in which pencil is not told from it


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
        return np.asarray(self.hidden[cells] | (self.dark[cells] > DARK), bool)

    def cells(self, spots: Spots) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The rows and columns of spots; beside the sheet, those of its edge."""
        high, wide = self.hidden.shape
        at = np.rint(self.pixels(spots)).astype(np.intp)
        np.minimum(np.maximum(at, 0, out=at), (wide - 1, high - 1), out=at)
        return at[:, 1], at[:, 0]


def ink(image: NDArray[np.float32], sheet: Sheet, light: Light, scale: float) -> Ink:
    """The pencil on the straightened picture of a sheet, whose print is `light` in the same pixels; beyond the frame
    nothing is looked for."""
    import cv2

    paper = np.asarray(image / np.maximum(light, TINT), np.float32)
    dark = np.clip(1 - paper / _lit(paper), 0, 1).astype(np.float32)
    inked = ((light < TINT) | words(sheet, scale)).astype(np.uint8)
    wide = cv2.morphologyEx(cv2.dilate(inked, _disc(BESIDE * scale)), cv2.MORPH_CLOSE, _disc(BETWEEN * scale / 2))
    frame, hidden = sheet.frame, np.ones(wide.shape, bool)
    rows = slice(int((sheet.height - frame.top) * scale), int((sheet.height - frame.bottom) * scale))
    columns = slice(int(frame.left * scale), int(frame.right * scale))
    hidden[rows, columns] = wide[rows, columns] > 0
    dark[hidden] = 0.0
    return Ink(dark, hidden, scale, sheet.height)


def _disc(radius: float) -> NDArray[np.uint8]:
    """All that is so many pixels about."""
    import cv2

    size = 2 * round(radius) + 1
    return np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size)), np.uint8)


def _lit(paper: NDArray[np.float32]) -> NDArray[np.float32]:
    """How light the paper would be with nothing on it: the lightest near by, smoothed."""
    import cv2

    high, wide = paper.shape
    small = cv2.resize(paper, (wide // COARSE, high // COARSE), interpolation=cv2.INTER_AREA)
    bare = cv2.morphologyEx(np.clip(small, 0, 255).astype(np.uint8), cv2.MORPH_CLOSE,
                            np.ones((LIGHTEST, LIGHTEST), np.uint8))
    even = cv2.GaussianBlur(cv2.medianBlur(bare, WIDE), (0, 0), WIDE / 4).astype(np.float32)
    return np.asarray(np.maximum(cv2.resize(even, (wide, high)), 1.0), np.float32)
