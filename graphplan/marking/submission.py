"""What a student hands in, read by the kind of its file."""

from __future__ import annotations

from collections.abc import Callable, Collection
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.errors import Refused, missing_package
from graphplan.marking.traces import Frames, Submission

if TYPE_CHECKING:
    from graphplan.sheet.plates.display import Sheet

SheetSize = tuple[float, float] | None  # width and height in mm, where they are known
DATA_SUFFIXES, IMAGE_SUFFIXES = (".csv", ".toml", ".svg", ".dxf", ".ggb"), (".png", ".jpg", ".jpeg", ".pdf")
PICTURE_SUFFIXES = (*IMAGE_SUFFIXES, ".heic", ".heif")  # of what is looked at, be it to say why it is not read
# the package that reads a kind, and its extra
READER_PACKAGES = {".svg": ("svgelements", "svg"), ".dxf": ("ezdxf", "dxf")}


def read_submission(path: Path, panels: Collection[str], frames: Frames,
                    printed: Callable[[], Sheet] | None = None, code: int | None = None,
                    size: SheetSize = None) -> Submission:
    """The drawing in a file; `panels` are the plans of the construction, `frames` where they lie on its own sheet.

    A picture is read beside the sheet that was `printed`, laid out when it is asked for, and the `code` of its corner
    marks. `size` is its width and height in mm: on paper of another size plans lie elsewhere.

    Fails with `Refused` where the file is none that can be read, or says nothing, and tells what to do.
    """
    suffix = path.suffix.casefold()
    if suffix == ".pdf" and (drawing := _read_pdf(path, frames, size, code)):
        return drawing
    if suffix in PICTURE_SUFFIXES:
        return _read_image(path, frames, printed, code)
    if suffix not in DATA_SUFFIXES:
        kind = suffix if suffix[1:].isalnum() else "without a suffix that is known"
        raise Refused(f"{path}", f"files of this kind ({kind[:40]}) are not read",
                      f"give one of {' '.join([*DATA_SUFFIXES, *IMAGE_SUFFIXES])}")
    submission = _read_data_file(path, suffix, panels, frames, size)
    if not submission.traces and not submission.numbers:
        raise Refused(f"{path}", "it contains no mark and no result", "fill it in")
    return submission


def _read_pdf(path: Path, frames: Frames, size: SheetSize, code: int | None) -> Submission | None:
    """The strokes and letters of a PDF; None where it is to be looked at, as scans and printed tasks are, or no package
    is there that reads them."""
    if not all(map(find_spec, ("svgelements", "cv2"))):
        return None
    from graphplan.marking.files.pdf import read_pdf
    from graphplan.marking.scans.image import read_pictures, silence_stderr
    from graphplan.marking.scans.printed_ink import shows_task

    def has_corner_marks() -> bool:
        with silence_stderr(), suppress(Refused):
            return any(shows_task(image, code, path.name) for image in read_pictures(path))
        return False  # a page is too large to be looked at

    return read_pdf(path, frames, size, has_corner_marks)


def _read_image(path: Path, frames: Frames, printed: Callable[[], Sheet] | None, code: int | None) -> Submission:
    """A scan or photo of the printed sheet."""
    if printed is None:
        raise Refused(f"{path}", "a picture can be read only with the printed sheet, and none is named",
                      "measured points or a CAD file")
    if not find_spec("cv2"):
        raise missing_package(f"{path}", "OpenCV", "scan")
    from graphplan.marking.scans.image import silence_stderr
    from graphplan.marking.scans.scan import read_scan

    with silence_stderr():
        return read_scan(path, printed(), frames, code)


def _read_data_file(path: Path, suffix: str, panels: Collection[str], frames: Frames, size: SheetSize) -> Submission:
    """A file of numbers or of a drawing program."""
    package, extra = READER_PACKAGES.get(suffix, ("", ""))
    if package and not find_spec(package):
        raise missing_package(f"{path}", package, extra)
    match suffix:
        case ".csv":
            from graphplan.marking.files.tables import read_csv

            return read_csv(path, panels)
        case ".toml":
            from graphplan.marking.files.tables import read_toml

            return read_toml(path, panels)
        case ".svg":
            from graphplan.marking.files.svg import read_svg

            return read_svg(path, frames, size)
        case ".dxf":
            from graphplan.marking.files.dxf import read_dxf

            return read_dxf(path, frames, size)
        case _:
            from graphplan.marking.files.geogebra import read_ggb

            return read_ggb(path)
