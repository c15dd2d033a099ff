"""The corner marks of some sheet in a picture, whichever sheet it is and whichever way up it lies.

What looks like a mark by chance is told by where it is: of two marks of one sheet each says, along its own sides, which
way the other should be.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Grey, Spots
from graphplan.marking.scans.straighten import detected, enclosed

PLACES = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)  # of the corners, from the lower left, counter-clockwise


def sheet_marks(image: Grey) -> dict[int, int]:
    """The numbers of the marks of the sheet in a picture, by their corner, as far as they are seen. Of a mirrored
    sheet it finds some too, with other numbers."""
    marks = detected(np.ascontiguousarray(image))
    large_first = sorted(marks, key=lambda mark: -abs(enclosed(mark[1])))
    best: dict[int, int] = {}
    for anchor in large_first:
        found = [anchor]
        for other in large_first:
            if all(_agree(one, other) for one in found):
                found.append(other)
        if len(found) > len(best):
            best = {number >> measures.CORNER_BITS: number for number, _ in found}
    return best


def blank(image: Grey) -> bool:
    """Whether hardly anything on a page is dark, its rim apart."""
    high, wide = (round(measures.PAGE_RIM_SHARE * side) for side in image.shape)
    middle = image[high : image.shape[0] - high : 2, wide : image.shape[1] - wide : 2]
    dark, light = np.percentile(middle, measures.BLANK_PERCENTILES)
    return bool(light - dark < measures.MIN_CONTRAST_SHADES)


Mark = tuple[int, Spots]


def _agree(one: Mark, other: Mark) -> bool:
    """Whether two marks are as large as each other, and each where the other has it."""
    (first, rim), (second, far) = one, other
    small, large = sorted(abs(enclosed(corners)) for corners in (rim, far))
    return (first >> measures.CORNER_BITS != second >> measures.CORNER_BITS
            and large < measures.MARK_SIZE_RATIO**2 * small
            and _faces(rim, far, PLACES[second >> measures.CORNER_BITS] - PLACES[first >> measures.CORNER_BITS])
            and _faces(far, rim, PLACES[first >> measures.CORNER_BITS] - PLACES[second >> measures.CORNER_BITS]))


def _faces(rim: Spots, far: Spots, way: NDArray[np.float64]) -> bool:
    """Whether a mark has another that way, along its own sides to the right and up."""
    out = far.mean(axis=0) - rim.mean(axis=0)
    right, up = rim[1] - rim[0], rim[0] - rim[3]
    along = np.array([out @ right / (right @ right), out @ up / (up @ up)])
    return bool(np.hypot(*along) > measures.MARKS_APART_SIDES and (along * way >= np.abs(way)).all())
