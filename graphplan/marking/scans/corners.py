"""The coded marks of a handout in a picture: which corner of which sheet is where."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphplan.errors import Refused
from graphplan.marking.scans.image import Grey
from graphplan.marking.scans.warp import Spots, enclosed
from graphplan.sheet.frames.corner_marks import numbers

CORNERS, BITS = 4, 8  # marks of a sheet, and the bits of the code in each
ALIKE = 2.0  # how much larger one mark of a sheet may look than another
SMALLEST = 48.0  # pixels of a mark's rim, below which its cells are not told apart


@dataclass(frozen=True)
class CornerMarks:
    """Marks by their corner, each as its own four corners in pixels: upper left, upper right, lower right, lower left
    as it was printed."""

    marks: Mapping[int, Spots]

    def __len__(self) -> int:
        return len(self.marks)


def find(image: Grey, code: int | None, name: str) -> CornerMarks:
    """The marks of the sheet with this code, or where none is asked for, those that a sheet has.

    Fails with `Refused` where the marks are those of another sheet.
    """
    seen = _detected(image)
    if code is None:
        small_first = sorted(seen, key=lambda mark: abs(enclosed(mark[1])))  # what looks like a mark by chance is small
        return CornerMarks({number >> BITS: rim for number, rim in small_first})
    own = {number: corner for corner, number in enumerate(numbers(code))}
    found = CornerMarks({own[number]: corners for number, corners in seen if number in own})
    if not found and _of_one_sheet([(number >> BITS, corners) for number, corners in seen]):
        raise Refused(name, "the marks in its corners are those of another task",
                      "verify it against its own scene, plan and paper")
    return found


def _detected(image: Grey) -> list[tuple[int, Spots]]:
    """Every mark in the picture with its number, its corners to a part of a pixel."""
    import cv2

    settings = cv2.aruco.DetectorParameters()
    settings.minMarkerPerimeterRate = SMALLEST / max(image.shape)
    settings.adaptiveThreshWinSizeMin, settings.adaptiveThreshWinSizeMax = 15, 55
    settings.adaptiveThreshWinSizeStep = 20
    settings.perspectiveRemovePixelPerCell, settings.perspectiveRemoveIgnoredMarginPerCell = 8, 0.3  # blurred cells
    settings.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    settings.relativeCornerRefinmentWinSize = 0.1
    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_ARUCO_ORIGINAL)
    corners, found, _ = cv2.aruco.ArucoDetector(words, settings).detectMarkers(image)
    if found is None:
        return []
    return [(int(number), np.asarray(rim, float).reshape(4, 2)) for number, rim in zip(found.ravel(), corners,
                                                                                    strict=True)]


def _of_one_sheet(marks: list[tuple[int, Spots]]) -> bool:
    """Whether the large ones among marks are those of several corners; print may look like a small mark by chance."""
    sizes = [math.sqrt(abs(enclosed(rim))) for _, rim in marks]
    return len({corner for (corner, _), size in zip(marks, sizes, strict=True) if size * ALIKE > max(sizes)}) > 1
