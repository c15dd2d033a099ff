"""Drawings in PDF, of graphplan itself or a drawing program: strokes and letters of the first page, in mm.

A page with a picture on it, with corner marks of a printed task there or on a later page, with notes written over it,
without letters or with more pieces of paths than a drawing has, as handwriting in outlines, is not read here, but
looked at. pdfium tells what is on a page; what is hidden under something else counts as drawn.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path as File
from typing import Any, NamedTuple

import pypdfium2 as pdfium
from pypdfium2 import raw
from svgelements import Close, CubicBezier, Line, Matrix, Move, Path

from graphplan.kernel.kinds import POINT
from graphplan.marking.files import measures
from graphplan.marking.files.drawing import LAYERS_NOT_DRAWN, DrawingReader, dot_or_circle, sharp_corners, word_at
from graphplan.marking.files.paths import chains, traces_of_chain
from graphplan.marking.files.safe import Budget, contents, require_readable_pages
from graphplan.marking.files.svg_view import MM_PER_UNIT, spot
from graphplan.marking.traces import Frames, Submission
from graphplan.sheet.plates.display import ENLARGED
from graphplan.sheet.plates.pens import LEADER

PAPER, CORNER_MARKS = "paper", "corner marks"  # layers of graphplan's own sheets
LEADER_LOOK = LEADER.colour, LEADER.width


def read_pdf(path: File, frames: Frames, size: tuple[float, float] | None,
             has_corner_marks: Callable[[], bool]) -> Submission | None:
    """The things drawn on the first page of a PDF; on graphplan's own sheet of this size plans lie where its frames
    are. None if the page is to be read as a picture, or is missing.

    Fails with `Refused` as other drawings do.
    """
    try:
        document = pdfium.PdfDocument(contents(path, measures.MAX_PDF_BYTES))
    except pdfium.PdfiumError:
        return None
    with closing(document):
        require_readable_pages(path, 0, 1)
        try:
            page = document[0]
            reader = _PdfReader(path, page) if not raw.FPDFPage_GetAnnotCount(page) else None
        except (pdfium.PdfiumError, _NoDrawing):
            return None
    if reader is None or not reader.is_drawing or not (reader.own or not has_corner_marks()):
        return None
    return reader.submission(frames, size)


class _NoDrawing(Exception):
    """A page has a picture on it, or handwriting."""


class _Look(NamedTuple):
    """Style of a path: whether it has a stroke, its colour and width in mm, and whether it is filled."""

    stroked: bool
    colour: str
    width: float
    filled: bool


class _PdfReader(DrawingReader):
    """Gathers what is drawn and written on a page."""

    def __init__(self, path: File, page: Any):
        super().__init__(path)
        mm = MM_PER_UNIT["pt"]
        left, bottom, right, top = page.get_mediabox()
        self.size, self.millimetres = ((right - left) * mm, (top - bottom) * mm), measures.STATED_UNIT_ODDS
        self.budget = Budget(path, measures.MAX_ELEMENTS, "elements")
        self.pieces = 0  # of all paths
        self.letters = Budget(path, measures.MAX_LETTERS, "letters")
        self.layers: set[str] = set()
        self.text_page = page.get_textpage()
        objects = (raw.FPDFPage_GetObject(page, k) for k in range(raw.FPDFPage_CountObjects(page)))
        self._read(objects, Matrix(mm, 0, 0, mm, -left * mm, -bottom * mm), 0)
        self.own = PAPER in self.layers

    @property
    def is_drawing(self) -> bool:
        """Whether what it shows is more than a picture of it: lines with letters, and no printed task."""
        named = sum(bool(word.names) for word in self.words)
        return CORNER_MARKS not in self.layers and (self.own or (bool(self.traces)
                                                                 and named >= measures.MIN_PDF_LETTERS))

    def _read(self, objects: Iterator[Any], onto: Matrix, depth: int) -> None:
        """The objects of the page, or of a form on it, which lies so."""
        for item in objects:
            self.budget.spend()
            layer = _layer(item)
            self.layers.add(layer)
            kind, place = raw.FPDFPageObj_GetType(item), _matrix(item) * onto
            if kind == raw.FPDF_PAGEOBJ_IMAGE:
                raise _NoDrawing
            if layer == ENLARGED:
                continue  # what lies on a plan once more
            if kind == raw.FPDF_PAGEOBJ_FORM and depth < measures.MAX_BLOCK_DEPTH:
                count = raw.FPDFFormObj_CountObjects(item)
                self._read((raw.FPDFFormObj_GetObject(item, k) for k in range(count)), place, depth + 1)
            elif kind == raw.FPDF_PAGEOBJ_TEXT:
                self._add_words(item, place)
            elif kind == raw.FPDF_PAGEOBJ_PATH and layer not in LAYERS_NOT_DRAWN:
                self.pieces += raw.FPDFPath_CountSegments(item)
                if self.pieces > measures.MAX_PATH_PIECES:
                    raise _NoDrawing
                self._add_shape(_path(item), _path_look(item, place), place)

    def _add_words(self, item: Any, place: Matrix) -> None:
        """The letters that are set in one go."""
        font_size, count = ctypes.c_float(), raw.FPDFTextObj_GetText(item, self.text_page, None, 0)
        self.letters.spend(count)
        letters = (ctypes.c_ushort * (count // 2 + 1))()
        raw.FPDFTextObj_GetText(item, self.text_page, letters, count)
        raw.FPDFTextObj_GetFontSize(item, font_size)
        text = bytes(letters).decode("utf-16-le", "replace").rstrip("\0").strip()
        if text:
            self.words.append(word_at(text, spot(place, 0j), font_size.value * abs(place.determinant) ** 0.5, 0.0))

    def _add_shape(self, drawn: Path, look: _Look, place: Matrix) -> None:
        """A path's traces; without a stroke it is no more than a dot or the head of an arrow."""
        leads = (look.colour, round(look.width, measures.POSITION_DIGITS)) == LEADER_LOOK
        for smooth, spots in chains(drawn, place):
            if look.filled and not look.stroked and not smooth:
                self.tips += sharp_corners(spots[:-1] if spots[0] == spots[-1] else spots)
            for trace in map(dot_or_circle, traces_of_chain(smooth, spots)):
                if look.stroked or (look.filled and trace.kind == POINT):
                    (self.leaders if leads else self.traces).append(trace)


def _layer(item: Any) -> str:
    """The layer of graphplan's own sheet: the name of what an item is marked as innermost."""
    count, long = raw.FPDFPageObj_CountMarks(item), ctypes.c_ulong()
    if count <= 0:
        return ""
    letters = (ctypes.c_ushort * measures.MAX_NAME_CHARS)()
    raw.FPDFPageObjMark_GetName(raw.FPDFPageObj_GetMark(item, count - 1), letters, ctypes.sizeof(letters), long)
    return bytes(letters).decode("utf-16-le", "replace").rstrip("\0")


def _matrix(item: Any) -> Matrix:
    """From an item's own units to those of what it lies in."""
    matrix = raw.FS_MATRIX()
    raw.FPDFPageObj_GetMatrix(item, matrix)
    return Matrix(matrix.a, matrix.b, matrix.c, matrix.d, matrix.e, matrix.f)


def _path(item: Any) -> Path:
    """The segments of a path; of a curve three spots follow each other."""
    drawn, start, begin, curve = Path(), 0j, 0j, list[complex]()
    for k in range(raw.FPDFPath_CountSegments(item)):
        segment, x, y = raw.FPDFPath_GetPathSegment(item, k), ctypes.c_float(), ctypes.c_float()
        raw.FPDFPathSegment_GetPoint(segment, x, y)
        end, kind = complex(x.value, y.value), raw.FPDFPathSegment_GetType(segment)
        if kind == raw.FPDF_SEGMENT_BEZIERTO:
            curve.append(end)
            if len(curve) < measures.CUBIC_SPOTS:
                continue
            drawn.append(CubicBezier(start, *curve))
        elif kind == raw.FPDF_SEGMENT_LINETO:
            drawn.append(Line(start, end))
        else:
            drawn.append(Move(start, end))
            begin = end
        start, curve = end, []
        if raw.FPDFPathSegment_GetClose(segment):
            drawn.append(Close(start, begin))
            start = begin
    return drawn


def _path_look(item: Any, place: Matrix) -> _Look:
    """Style of a path."""
    fill, stroked, width = ctypes.c_int(), ctypes.c_int(), ctypes.c_float()
    raw.FPDFPath_GetDrawMode(item, fill, stroked)
    raw.FPDFPageObj_GetStrokeWidth(item, width)
    rgba = [ctypes.c_uint() for _ in "RGBA"]
    raw.FPDFPageObj_GetStrokeColor(item, *rgba)
    colour = "#" + "".join(f"{part.value:02x}" for part in rgba[:3])
    return _Look(bool(stroked.value), colour, width.value * abs(place.determinant) ** 0.5, bool(fill.value))
