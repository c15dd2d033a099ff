"""From the sheet's millimetres to a picture's pixels: a plane seen by a camera, bent a little by lens and paper."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Spots = NDArray[np.float64]  # rows of x and y
STEP = 16  # pixels between the places where a warp is worked out; between them it is as good as straight


@dataclass(frozen=True)
class Warp:
    """Takes spots of the sheet, in mm, to pixels: `bend` are the coefficients of a polynomial of this degree, by which
    the spots are first moved on the sheet, in mm."""

    plane: Spots
    size: tuple[float, float]
    degree: int = 0
    bend: Spots = field(default_factory=lambda: np.zeros((1, 2)))

    def __call__(self, spots: Spots) -> Spots:
        return projected(self.plane, spots + self.moved(spots))

    def moved(self, spots: Spots) -> Spots:
        """By how much paper and lens move spots of the sheet, in mm."""
        return terms(spots, self.size, self.degree) @ self.bend

    def maps(self, scale: float) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Columns and rows in the picture for every pixel of the sheet, at so many pixels per mm, the top first."""
        wide, high = round(self.size[0] * scale), round(self.size[1] * scale)
        columns, rows = np.meshgrid(np.arange(0, wide + STEP, STEP), np.arange(0, high + STEP, STEP))
        spots = np.column_stack([(columns.ravel() + 0.5) / scale, self.size[1] - (rows.ravel() + 0.5) / scale])
        seen = self(spots).reshape(*columns.shape, 2)
        return _between(seen[..., 0], wide, high), _between(seen[..., 1], wide, high)

    def fineness(self) -> float:
        """Pixels per mm in the middle of the sheet."""
        x, y = self.size[0] / 2, self.size[1] / 2
        seen = self(np.array([(x - 5, y), (x + 5, y), (x, y - 5), (x, y + 5)]))
        return float(min(np.hypot(*(seen[1] - seen[0])), np.hypot(*(seen[3] - seen[2]))) / 10)


def projected(plane: Spots, spots: Spots) -> Spots:
    """Spots through a projective map."""
    seen = np.column_stack([spots, np.ones(len(spots))]) @ plane.T
    return np.asarray(seen[:, :2] / seen[:, 2:])


def enclosed(rim: Spots) -> float:
    """The area within a rim, by Gauss's formula: positive in the sense of the clock where rows count down."""
    ahead = np.roll(rim, -1, axis=0)
    return float((rim[:, 0] * ahead[:, 1] - ahead[:, 0] * rim[:, 1]).sum() / 2)


def terms(spots: Spots, size: tuple[float, float], degree: int) -> Spots:
    """The terms of a polynomial at spots, by Chebyshev, from -1 to 1 over the sheet."""
    x, y = (2 * spots[:, i] / size[i] - 1 for i in range(2))
    across, up = (np.polynomial.chebyshev.chebvander(value, degree) for value in (x, y))
    return np.column_stack([across[:, i] * up[:, j] for i, j in powers(degree)])


def powers(degree: int) -> list[tuple[int, int]]:
    """The powers of x and y in each term of a polynomial, up to this degree in all."""
    return [(total - j, j) for total in range(degree + 1) for j in range(total + 1)]


def _between(coarse: Spots, wide: int, high: int) -> NDArray[np.float32]:
    """Values at every pixel from those at every `STEP`th."""
    import cv2

    grow = np.array([[STEP, 0, 0], [0, STEP, 0]], float)
    return np.asarray(cv2.warpAffine(coarse.astype(np.float32), grow, (wide, high), flags=cv2.INTER_LINEAR,
                                     borderMode=cv2.BORDER_REPLICATE), np.float32)
