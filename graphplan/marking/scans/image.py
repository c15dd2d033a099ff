"""A picture of a sheet from its file, in shades of grey: PNG, JPEG, or a page of a PDF.

What a file says of its size is read before anything is unpacked, so that a small file cannot fill the memory.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import closing, contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pypdfium2 as pdfium
from numpy.typing import NDArray
from PIL.ImageFile import ImageFile
from PIL.JpegImagePlugin import JpegImageFile
from PIL.PngImagePlugin import PngImageFile

from graphplan.errors import Refused
from graphplan.marking.files.safe import contents, require_readable_pages
from graphplan.marking.scans import measures

Grey = NDArray[np.uint8]
Light = NDArray[np.float32]
Spots = NDArray[np.float64]  # rows of x and y
Sizes = NDArray[np.float64]  # a number each
Flags = NDArray[np.bool_]  # which
Places = NDArray[np.intp]  # where in an array
STDERR = 2  # the file in which libraries in other languages write, whatever Python does
PNG, JPEG, PDF = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"%PDF-"
DO = "hand in a scan of 200 dpi or a sharp photo of the whole sheet, as PNG, JPEG or PDF"


def read_pictures(path: Path) -> Iterator[Grey]:
    """The picture in a file, or those of a document's pages, one by one.

    Fails with `Refused` where there is none, or where it is too large to be opened.
    """
    data = contents(path, measures.MAX_FILE_BYTES)
    if data.startswith(PDF):
        yield from _pdf_pages(path, data)
    elif data.startswith((PNG, JPEG)):
        yield _decode(path, data)
    elif data[4:8] == b"ftyp":
        raise Refused(f"{path}", "this is a HEIC photo, as phones take them, which is not read",
                      "send or save it as JPEG (iPhone: Settings, Camera, Formats, Most Compatible)")
    else:
        raise Refused(f"{path}", "not a PNG, JPEG or PDF file", DO)


def _check_size(path: Path, size: tuple[int, int]) -> None:
    """Refuse a picture that is too large or too small."""
    if size[0] * size[1] > measures.MAX_PICTURE_PX:
        raise Refused(f"{path}",
                      f"{size[0]} by {size[1]} pixels are more than {measures.MAX_PICTURE_PX // 10**6} megapixels", DO)
    if min(size) < measures.MIN_SIDE_PX:
        raise Refused(f"{path}", f"{size[0]} by {size[1]} pixels are too few to see pencil lines", DO)


def _header(data: bytes) -> ImageFile | None:
    """What a PNG or a JPEG says of its picture, which is not unpacked; None where it says nothing of use."""
    try:
        return (PngImageFile if data.startswith(PNG) else JpegImageFile)(BytesIO(data))
    except (OSError, SyntaxError, ValueError):
        return None


def _decode(path: Path, data: bytes) -> Grey:
    """The picture itself, upright as the camera was held."""
    header = _header(data)
    if header is None:
        raise Refused(f"{path}", "the picture is damaged: it does not say how large it is", DO)
    _check_size(path, header.size)
    half = header.width * header.height > measures.MAX_WHOLE_PX
    try:
        with silence_stderr():
            image = cv2.imdecode(np.frombuffer(data, np.uint8),
                                 cv2.IMREAD_REDUCED_GRAYSCALE_2 if half else cv2.IMREAD_GRAYSCALE)
    except cv2.error:
        image = None
    if image is None:
        raise Refused(f"{path}", "the picture is damaged", DO)
    return np.asarray(image, np.uint8)


@contextmanager
def silence_stderr() -> Iterator[None]:
    """Silence the error output of libraries: their remarks on a picture are not for the reader."""
    try:
        standard_error = os.dup(STDERR)
    except OSError:  # it is closed
        yield
        return
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), STDERR)
        yield
    finally:
        os.dup2(standard_error, STDERR)
        os.close(standard_error)


def count(path: Path) -> int:
    """Number of pictures in a file: the pages of a document, however large it is, else one.

    Fails with `Refused` where it is a document that cannot be opened.
    """
    if not _is_document(path):
        return 1
    with _open_document(path, path) as document:
        return len(document)


def page_picture(path: Path, number: int) -> Grey:
    """One picture of a file, counted from 1; of a document, which may be large, no other page is drawn. Fails as
    `pictures` does."""
    if not _is_document(path):
        return next(read_pictures(path))
    with _open_document(path, path) as document:
        require_readable_pages(path, number - 1, number)
        return _draw_page(path, document, number - 1)


def _is_document(path: Path) -> bool:
    """Whether a file begins as a PDF does."""
    try:
        with path.open("rb") as file:
            return file.read(len(PDF)) == PDF
    except OSError:
        return False


def _pdf_pages(path: Path, data: bytes) -> Iterator[Grey]:
    """The pages of a document, each drawn in turn."""
    with _open_document(path, data) as document:
        require_readable_pages(path, 0, measures.MAX_PAGES)
        for number in range(min(len(document), measures.MAX_PAGES)):
            yield _draw_page(path, document, number)


@contextmanager
def _open_document(path: Path, source: bytes | Path) -> Iterator[Any]:
    """The document in a file, or in its bytes."""
    try:
        document = pdfium.PdfDocument(source)
    except (pdfium.PdfiumError, OSError) as error:
        raise Refused(f"{path}", "the document is damaged, or locked by a password", DO) from error
    with closing(document):
        yield document


def _draw_page(path: Path, document: Any, number: int) -> Grey:
    """One page of a document, whose pictures are not too large either."""
    try:
        page = document[number]
        scale = measures.PDF_DPI / measures.POINTS_PER_INCH
        _check_size(path, (round(page.get_width() * scale), round(page.get_height() * scale)))
        for picture in page.get_objects(filter=[pdfium.raw.FPDF_PAGEOBJ_IMAGE], max_depth=2):
            wide, high = picture.get_px_size()
            _check_size(path, (max(wide, measures.MIN_SIDE_PX), max(high, measures.MIN_SIDE_PX)))
        return np.array(page.render(scale=scale, grayscale=True).to_numpy(), np.uint8).squeeze()
    except pdfium.PdfiumError as error:
        raise Refused(f"{path}", f"page {number + 1} is broken", DO) from error


def require_contrast(image: Grey, name: str) -> None:
    """Refuse a picture without dark or light parts; noise has neither, from afar."""
    dark, light = np.percentile(shrink(image, measures.CONTRAST_PX), measures.CONTRAST_PERCENTILES)
    if light - dark < measures.MIN_CONTRAST_SHADES:
        raise Refused(name, "the picture is blank", DO)


def median_deviation(off: NDArray[np.floating]) -> float:
    """Standard deviation of distances that are mostly noise: by the median, which strays do not move."""
    return float(np.median(np.abs(off))) / measures.MEDIAN_SIGMAS


def shrink(image: Grey, pixels: float) -> Grey:
    """The picture with no more than so many pixels."""
    return _scale_down(image, (pixels / image.size) ** 0.5)


def shrink_sides(image: Grey, pixels: float) -> tuple[Grey, float]:
    """The picture with sides of no more than so many pixels, and how many of these one of its own is."""
    scale = min(1.0, pixels / max(image.shape))
    return _scale_down(image, scale), scale


def _scale_down(image: Grey, scale: float) -> Grey:
    """The picture at a scale, or itself, if that is no smaller."""
    if scale >= 1:
        return image
    return np.asarray(cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA), np.uint8)


def encode_jpeg(image: Grey, quality: int) -> bytes:
    """A picture as a JPEG file, kept so well, of 100."""
    return bytes(cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])[1])
