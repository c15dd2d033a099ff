"""The picture of a scanned sheet, to be drawn on: laid straight, or as it is."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Grey, jpeg, smaller
from graphplan.marking.scans.straighten import Warp
from graphplan.sheet.frames.frame import WHITE
from graphplan.sheet.plates.display import Photograph, Rect

LAYER = "scan"


def straight(image: Grey, warp: Warp) -> Grey:
    """The sheet in a picture, laid straight, at `FINE` pixels per mm."""
    columns, rows = warp.maps(measures.FACSIMILE_PX_PER_MM)
    return np.asarray(cv2.remap(smaller(image, measures.MAX_PAGE_PX), columns, rows, cv2.INTER_AREA, borderValue=255),
                      np.uint8)


def photograph(sheet: Grey) -> Photograph:
    """A straight sheet, or a piece of it, as it lies on paper."""
    high, wide = sheet.shape
    return Photograph(WHITE, LAYER, None,
                      Rect(0.0, 0.0, wide / measures.FACSIMILE_PX_PER_MM, high / measures.FACSIMILE_PX_PER_MM),
                      jpeg(sheet, measures.FACSIMILE_JPEG_QUALITY), (wide, high))


def as_it_is(image: Grey, longest: float = measures.A4_LONG_MM) -> Photograph:
    """A whole picture, on paper whose longer side is so many mm."""
    small = smaller(image, (longest * measures.FACSIMILE_PX_PER_MM) ** 2 * min(image.shape) / max(image.shape))
    shown, (high, wide) = photograph(small), image.shape
    size = Rect(0.0, 0.0, longest * wide / max(image.shape), longest * high / max(image.shape))
    return replace(shown, rect=size)


def cut(sheet: Grey, rect: Rect) -> Photograph:
    """A piece of a straight sheet, at the origin."""
    left, right = (round(side * measures.FACSIMILE_PX_PER_MM) for side in (rect.left, rect.right))
    low, high = (sheet.shape[0] - round(side * measures.FACSIMILE_PX_PER_MM) for side in (rect.bottom, rect.top))
    return photograph(np.ascontiguousarray(sheet[max(0, high) : low, max(0, left) : right]))
