"""A picture of a sheet made straight: laid on the printed one by its marks or its frame, then by all its print."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphplan.errors import Refused
from graphplan.marking.scans.corners import CornerMarks, find
from graphplan.marking.scans.frame import by_frame
from graphplan.marking.scans.image import Grey
from graphplan.marking.scans.printed_ink import Light, pieces
from graphplan.marking.scans.registration import Registered, registered
from graphplan.marking.scans.warp import Warp
from graphplan.sheet.frames.corner_marks import places
from graphplan.sheet.plates.display import Sheet

LEAST_DPI, INCH = 100.0, 25.4
ENOUGH, ALL = 3, 4  # marks by which a sheet may be laid, and is laid without a doubt
OWN, SURE = 0.5, 0.95  # the share of the print that is found on its own sheet, and by which it is known
MARGIN = 1.0  # mm by which a plan may be off the picture


@dataclass(frozen=True)
class Straight:
    """A sheet seen from straight above: lightness 0..255, the top first; `error` is how far off its print still is,
    as a standard deviation in mm."""

    image: NDArray[np.float32]
    warp: Warp
    error: float


def straighten(image: Grey, sheet: Sheet, light: Light, scale: float, code: int | None, name: str) -> Straight:
    """The picture laid over the printed sheet, of which `light` is the picture at `scale` pixels per mm.

    Fails with `Refused` where the sheet is not found, is another one, is cut off, or too coarse.
    """
    import cv2

    found = find(image, code, name)
    result = _laid(image, sheet, light, scale, found)
    if result is None:
        raise Refused(name, "neither the corner marks nor the frame of this task are found in it",
                      "photograph the whole sheet with its four corner marks, lying flat, in even light")
    if result.share < OWN:
        raise Refused(name, "what is printed on it is not found where this task has it",
                      "verify it against its own scene, plan and paper, and photograph the sheet lying flat")
    _whole(result.warp, image, sheet, name)
    columns, rows = result.warp.maps(scale)
    straight = cv2.remap(image, columns, rows, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    return Straight(straight.astype(np.float32), result.warp, result.error)


def _laid(image: Grey, sheet: Sheet, light: Light, scale: float, found: CornerMarks) -> Registered | None:
    """The sheet laid by its marks, or where some are lost, by its frame, whichever fits the print."""
    best, ink = None, pieces(sheet)
    for start in _starts(image, sheet, light, found):
        result = registered(image, start, light, scale, ink)
        best = result if best is None or result.share > best.share else best
        if best.share > SURE:
            break
    return best


def _starts(image: Grey, sheet: Sheet, light: Light, found: CornerMarks) -> Iterator[Warp]:
    """The ways to lay the sheet, the surest first."""
    if len(found) >= ENOUGH:
        yield _by_marks(found, sheet)
    if len(found) < ALL:
        yield from by_frame(image, sheet, light)


def _by_marks(found: CornerMarks, sheet: Sheet) -> Warp:
    """The plane through the corners of the marks."""
    import cv2

    rects = places(sheet.width, sheet.height, sheet.frame)
    printed = [spot for corner in found.marks for spot in rects[corner].corners[::-1]]
    seen = np.concatenate([found.marks[corner] for corner in found.marks])
    plane, _ = cv2.findHomography(np.array(printed), seen)
    return Warp(np.asarray(plane, float), (sheet.width, sheet.height))


def _whole(warp: Warp, image: Grey, sheet: Sheet, name: str) -> None:
    """Refuse a picture that is too coarse, or that does not show all the plans."""
    dpi = warp.fineness() * INCH
    if dpi < LEAST_DPI:
        raise Refused(name, f"{dpi:.0f} dots per inch are too few to see pencil lines", "scan it at 200 dpi")
    high, wide = image.shape
    for panel, rect in sheet.panels.items():
        seen = warp(np.array(rect.inset(MARGIN, MARGIN, MARGIN, MARGIN).corners))
        if (seen < 0).any() or (seen > [wide - 1, high - 1]).any():
            raise Refused(name, f"the {panel} is cut off", "scan or photograph the whole sheet")
