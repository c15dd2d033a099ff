"""A scan or a photo of a handout, read: the picture straightened, and the pencil on it as lines, rims and dots."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.traces import Frames, Submission

if TYPE_CHECKING:
    from graphplan.marking.scans.image import Grey
    from graphplan.marking.scans.page import PencilPage
    from graphplan.sheet.plates.display import Sheet

SCALE, PIXELS = 8.0, 4.0e7  # pixels per mm of a straightened page, unless they would be more than these
SHOWS = frozenset({LINE, CIRCLE})  # dots are found too, but not every point of a drawing is a dot


def read_scan(path: Path, printed: Sheet, frames: Frames, code: int | None = None) -> Submission:
    """What was drawn on a printed page, in mm of it.

    `code` is that of its marks, and `frames` says where its plans lie, which is passed on.

    Fails with `Refused` where the file is no picture, not one of this page, or nothing is drawn on it.
    """
    page = read_page(path, printed, code)
    if all(trace.kind == POINT for trace in page.traces):
        raise Refused(f"{path}", "nothing is drawn on the page", "hand in a scan of the drawing, not of the empty task")
    return Submission(path.name, page.traces, shows=SHOWS, frames=frames, page=page)


def read_page(path: Path, printed: Sheet, code: int | None = None) -> PencilPage:
    """The pencil on a printed page, which can be asked for what is expected on it. Fails as `read_scan`."""
    try:
        import cv2  # noqa: F401
    except ImportError as error:
        raise Refused(f"{path}", "pictures are read by OpenCV, which is not installed",
                      "pip install 'graphplan[scan]'") from error
    from graphplan.marking.scans.image import pictures

    refused: Refused | None = None
    for image in pictures(path):
        try:
            return _page(image, printed, code, f"{path}")
        except Refused as this:
            refused = this
    raise refused or Refused(f"{path}", "the document has no pages", "hand in a scan of the sheet")


def _page(image: Grey, printed: Sheet, code: int | None, name: str) -> PencilPage:
    """One picture of a page."""
    from graphplan.marking.scans.image import contrast, smaller
    from graphplan.marking.scans.page import PencilPage
    from graphplan.marking.scans.pencil_pixels import ink
    from graphplan.marking.scans.printed_ink import picture
    from graphplan.marking.scans.ridges import ridges
    from graphplan.marking.scans.straighten import straighten

    contrast(image, name)
    scale = min(SCALE, (PIXELS / (printed.width * printed.height)) ** 0.5)
    light = picture(printed, scale)
    straight, found = straighten(smaller(image, PIXELS), printed, light, scale, code, name)
    pencil = ink(straight, printed, light, scale)
    return PencilPage(pencil, ridges(pencil), found.error)
