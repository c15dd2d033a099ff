"""Which sheet is in a picture, and where: by its coded marks, or by its frame, the largest dark rectangle, which way up
by all that is printed."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from shapely import LinearRing

from graphplan.errors import Refused
from graphplan.marking.scans.image import Grey
from graphplan.marking.scans.printed_ink import Light, pieces
from graphplan.marking.scans.warp import Spots, Warp, enclosed
from graphplan.sheet.frames.corner_marks import numbers
from graphplan.sheet.plates.display import Rect, Sheet

CORNERS, BITS = 4, 8  # marks of a sheet, and the bits of the code in each
ALIKE = 2.0  # how much larger one mark of a sheet may look than another
SMALLEST = 48.0  # pixels of a mark's rim, below which its cells are not told apart


def find(image: Grey, code: int | None, name: str) -> dict[int, Spots]:
    """The marks of the sheet with this code, or where none is asked for, those that a sheet has: by their corner, each
    as its own four corners in pixels, upper left, upper right, lower right, lower left as it was printed.

    Fails with `Refused` where the marks are those of another sheet.
    """
    seen = _detected(image)
    if code is None:
        small_first = sorted(seen, key=lambda mark: abs(enclosed(mark[1])))  # what looks like a mark by chance is small
        return {number >> BITS: rim for number, rim in small_first}
    own = {number: corner for corner, number in enumerate(numbers(code))}
    found = {own[number]: corners for number, corners in seen if number in own}
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


SIDE = 2400  # pixels of the picture's longer side, in which a frame is searched
LEAST, MOST = 0.15, 4  # of the picture, that a frame covers; how many rectangles are tried
HALF, OFF = 0.35, 0.02  # of a side: how much of it about its middle tells where it is, and how far off it may be
SAME = 0.002  # of the picture, by which the two rims of one line are apart
COARSE = 1.0  # pixels per mm at which print is compared


def by_frame(image: Grey, sheet: Sheet, light: Light) -> list[Warp]:
    """The planes in which the printed frame may be seen, the largest first, each turned so that the print fits."""
    import cv2

    wide, high = round(sheet.width * COARSE), round(sheet.height * COARSE)
    small = cv2.resize(light, (wide, high), interpolation=cv2.INTER_AREA)
    ideal = np.asarray(cv2.GaussianBlur(small, (0, 0), COARSE), np.float32)
    size = sheet.width, sheet.height
    found = []
    for rim in _rectangles(image):
        tried = [Warp(np.asarray(cv2.findHomography(corners, np.roll(rim, turn, axis=0))[0], float), size)
                 for corners in _outlines(sheet) for turn in range(4)]
        found.append(max(tried, key=lambda warp: _alike(image, warp, ideal)))
    return found


def _outlines(sheet: Sheet) -> list[Spots]:
    """The frame's corners, and those of all straight print, which may go beyond it."""
    ink = pieces(sheet)
    half = ink.along * ink.halves[:, None]
    ends = np.concatenate([ink.middles - half, ink.middles + half])
    (left, bottom), (right, top) = ends.min(axis=0), ends.max(axis=0)
    return [np.array(sheet.frame.corners), np.array(Rect(left, bottom, right, top).corners)]


def _rectangles(image: Grey) -> Iterator[Spots]:
    """The largest four-sided rims in the picture, in pixels, in the sense in which a frame's corners go round."""
    import cv2

    shrink = min(1.0, SIDE / max(image.shape))
    small = cv2.resize(image, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA)
    dark = cv2.adaptiveThreshold(small, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY_INV, 41, 12)
    rims, _ = cv2.findContours(dark, cv2.RETR_LIST, cv2.CHAIN_APPROX_SIMPLE)
    large = sorted((rim for rim in rims if cv2.contourArea(rim) > LEAST * small.size), key=cv2.contourArea)
    known: list[Spots] = []
    for rim in large[::-1]:
        hull = cv2.convexHull(rim)
        four = cv2.approxPolyDP(hull, 0.02 * cv2.arcLength(rim, True), True).reshape(-1, 2).astype(float)
        corners = _sharp(hull.reshape(-1, 2).astype(float), four) if len(four) == 4 else None
        if corners is None or any(np.abs(corners - other).max() < SAME * SIDE for other in known):
            continue
        known.append(corners)
        yield (corners + 0.5) / shrink - 0.5
        if len(known) == MOST:
            return


def _sharp(hull: Spots, four: Spots) -> Spots | None:
    """The corners of a rectangle, in the sense in which a frame's go round, from the middles of its sides: whatever
    its corners themselves have lost."""
    around = four if enclosed(four) < 0 else four[::-1]
    around = np.roll(around, -int(around.sum(axis=1).argmin()), axis=0)
    rim = np.array(LinearRing(hull).segmentize(1.0).coords)
    sides = [_side(rim, one, two) for one, two in zip(around, np.roll(around, -1, axis=0), strict=True)]
    if any(side is None for side in sides):
        return None
    lines = np.array(sides)
    return np.array([np.linalg.solve([one[:2], two[:2]], [one[2], two[2]])
                     for one, two in zip(np.roll(lines, 1, axis=0), lines, strict=True)])


def _side(rim: Spots, one: Spots, two: Spots) -> tuple[float, float, float] | None:
    """The line along the middle of a side: its unit normal, and how far it is from the origin."""
    long = np.hypot(*(two - one))
    ahead = (two - one) / long
    along, off = (rim - one) @ ahead / long, (rim - one) @ np.array([-ahead[1], ahead[0]])
    middle = rim[(np.abs(along - 0.5) < HALF) & (np.abs(off) < OFF * long)]
    if len(middle) < 2:
        return None
    at = middle.mean(axis=0)
    normal = np.linalg.eigh((middle - at).T @ (middle - at))[1][:, 0]
    return float(normal[0]), float(normal[1]), float(normal @ at)


def _alike(image: Grey, warp: Warp, ideal: NDArray[np.float32]) -> float:
    """The correlation of a picture, straightened, with the print."""
    import cv2

    columns, rows = warp.maps(COARSE)
    seen = cv2.GaussianBlur(cv2.remap(image, columns, rows, cv2.INTER_LINEAR), (0, 0), COARSE).astype(np.float32)
    seen -= cv2.GaussianBlur(seen, (0, 0), 20 * COARSE)
    return float(np.corrcoef(seen.ravel(), ideal.ravel())[0, 1])
