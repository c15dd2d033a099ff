"""PDF and PNG of a sheet: true size, ink where the display list says, letters that can be searched, the same bytes."""

from __future__ import annotations

import ctypes
import hashlib
import io
import math
import re
import shutil
import struct
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.ft2font import FT2Font, LoadFlags
from matplotlib.image import imread

import graphplan as gp
from graphplan.commands import main
from graphplan.errors import Refused
from graphplan.output.pdf import pdf
from graphplan.output.png import png
from graphplan.output.typeface import font_file, typeface
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout, pages
from graphplan.sheet.lettering.lettering import ADVANCE, CAPS, TextRun, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Sheet, Text

PX = 8  # pixels in a mm
NEAR = 0.2  # mm


@cache
def sheet_of(name: str) -> Sheet:
    return layout(compose(gp.construct(gp.load(name))))


def lettered(*lines: str) -> Sheet:
    """A sheet with nothing but these lines of letters."""
    texts = [Text(pens.LETTERS, "text", None, (30.0, 200.0 - 5 * k), (TextRun(line),), 2.5)
             for k, line in enumerate(lines)]
    return replace(sheet_of("four-bar"), items=tuple(texts))


def pixels(sheet: Sheet) -> Any:
    """How dark the paper is, row by row from its upper edge."""
    return 1.0 - imread(io.BytesIO(png(sheet, dpi=PX * 25.4)))[:, :, 1]


def alone(item: Item, reach: Rect) -> Any:
    """How dark the paper is, with one item on it and none beyond that."""
    return pixels(replace(sheet_of("four-bar"), width=reach.right + 5, height=reach.top + 5, items=(item,)))


def dark(picture: Any, x: float, y: float) -> float:
    """How dark the paper is at a spot in mm."""
    return float(picture[picture.shape[0] - 1 - int(y * PX), int(x * PX)])


def inked(picture: Any) -> Rect:
    """How far the ink reaches, in mm."""
    rows, columns = (np.flatnonzero((picture > 0.1).any(axis=axis)) for axis in (1, 0))
    high = picture.shape[0]
    return Rect(columns[0] / PX, (high - 1 - rows[-1]) / PX, (columns[-1] + 1) / PX, (high - rows[0]) / PX)


def test_a_pdf_has_a_page_of_true_size_for_each_sheet() -> None:
    """Pages are as large as their sheets, in points of which 72 make an inch, with title and language."""
    sheets = [sheet_of("four-bar"), sheet_of("double-butterfly")]
    document = pdf(sheets, title="Two sheets", language="lv")
    sizes = [tuple(map(float, box.split())) for box in re.findall(rb"/MediaBox \[ ?0 0 ([\d. ]+)\]", document)]
    assert sizes == [pytest.approx((s.width * 72 / 25.4, s.height * 72 / 25.4), abs=0.01) for s in sheets]
    assert sheets[0].width != sheets[1].width
    assert b"/Title (Two sheets)" in document
    assert b"/Lang (lv)" in document
    assert b"/FontFile2" in document, "fonts are embedded as outlines"
    table = document[int(re.findall(rb"startxref\s+(\d+)", document)[-1]) :].splitlines()
    root = re.findall(rb"/Root (\d+) 0 R", document)[0]
    assert table[0] == b"xref", "readers find the table where the end says"
    catalogue = document[int(table[2 + int(root)].split()[0]) :].partition(b"endobj")[0]
    assert catalogue.startswith(root + b" 0 obj\n<< /Type /Catalog")
    assert b"/Lang (lv)" in catalogue
    assert b"/DisplayDocTitle true" in catalogue


def test_a_pdf_says_what_it_is_and_what_its_parts_are() -> None:
    """Readers find title, subject and keywords; every word is in a head or a paragraph, all ink of plans in a figure
    that is described, and each part of a page belongs to one tag."""
    pypdfium2 = pytest.importorskip("pypdfium2")
    sheets = [sheet_of("four-bar"), sheet_of("double-butterfly")]
    data = pdf(sheets)
    document = pypdfium2.PdfDocument(data)
    about = document.get_metadata_dict()
    assert (about["Title"], about["Subject"]) == (sheets[0].title, sheets[0].description)
    assert about["Keywords"].startswith("mechanism plan, N-plan")
    assert (about["Author"], about["CreationDate"]) == ("", "")
    assert document.is_tagged()
    for number, sheet in enumerate(sheets):
        whole = (page := document[number]) and pypdfium2.raw.FPDF_StructTree_GetForPage(page)
        (root,) = tagged(pypdfium2.raw, whole)
        figures = [alt for kind, alt, _ in root if kind == "Figure"]
        assert figures == [sheet.description]
        bold = sum(isinstance(item, Text) and item.bold for item in sheet.items)
        assert sum(kind == "H1" for kind, *_ in root) == bold
        assert sum(kind == "P" for kind, *_ in root) > 10
        parts = [part for *_, numbers in root for part in numbers]
        assert sorted(parts) == list(range(len(parts)))


def tagged(raw: Any, tree: Any) -> list[list[tuple[str, str, list[int]]]]:
    """The tags of a page below those of the document: kind, description, and numbers of their parts."""

    def told(get: Any, element: Any) -> str:
        size = get(element, None, 0)
        buffer = (ctypes.c_char * max(size, 2))()
        get(element, buffer, size)
        return bytes(buffer)[:size].decode("utf-16-le").rstrip("\0")

    def children(element: Any) -> list[Any]:
        count = raw.FPDF_StructElement_CountChildren(element)
        return [child for k in range(count) if (child := raw.FPDF_StructElement_GetChildAtIndex(element, k))]

    def parts(element: Any) -> list[int]:
        count, get = raw.FPDF_StructElement_GetMarkedContentIdCount(element), \
            raw.FPDF_StructElement_GetMarkedContentIdAtIndex
        return [part for k in range(count) if (part := get(element, k)) >= 0]

    roots = [raw.FPDF_StructTree_GetChildAtIndex(tree, k) for k in range(raw.FPDF_StructTree_CountChildren(tree))]
    return [[(told(raw.FPDF_StructElement_GetType, one), told(raw.FPDF_StructElement_GetAltText, one), parts(one))
             for one in children(root)] for root in roots]


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="pdftotext is not installed")
def test_the_letters_of_a_pdf_can_be_searched() -> None:
    """Whoever extracts the text finds the sentences of the steps, and the letters of many languages."""
    words = "Шарнирный четырёхзвенник", "Čebiševa mehānisms, žņļķģšū", "Mehhanismiõpetus äöü", "α′ − ω²"
    sheets = pages(compose(gp.construct(gp.load("four-bar"))))
    text = " ".join(extracted(pdf([*sheets, lettered(*words)])).split())
    assert all(line in text for line in words)
    told = [item.runs[0].text for sheet in sheets for item in sheet.items
            if isinstance(item, Text) and item.layer == "text" and len(item.runs) == 1]
    assert len([line for line in told if len(line) > 40]) > 10
    assert all(" ".join(line.split()) in text for line in told)


def extracted(document: bytes) -> str:
    run = subprocess.run(["pdftotext", "-layout", "-", "-"], input=document, capture_output=True, check=True)
    assert not run.stderr, run.stderr
    return run.stdout.decode()


def test_every_letter_that_is_measured_can_be_drawn() -> None:
    """The font has all letters whose widths are known; of others it is said that it lacks them."""
    assert pdf([lettered("".join(ADVANCE))])
    for draw in (png, lambda sheet: pdf([sheet])):
        with pytest.raises(Refused, match="DejaVu Sans has no 四 杆; draw it as SVG"):
            draw(lettered("四杆 linkage"))


@pytest.mark.parametrize("bold", [False, True])
def test_a_document_embeds_the_outlines_of_its_letters(bold: bool) -> None:
    """Outlines and advances of the letters are those of the whole font, also of letters put together from others."""
    letters = "Aγžģ⁴"
    whole, face = FT2Font(str(font_file(bold))), typeface(bold)
    part = FT2Font(io.BytesIO(face.subset([0, *map(face.glyph, letters)])))
    for number, char in enumerate(letters, 1):
        told = []
        for font, glyph in ((whole, whole.get_char_index(ord(char))), (part, number)):
            font.set_size(1000, 72)
            drawn = font.load_glyph(glyph, flags=LoadFlags.NO_HINTING)
            told.append((drawn.linearHoriAdvance, *(array.tolist() for array in font.get_path())))
        assert told[0] == told[1]
        assert face.advance(face.glyph(char)) == pytest.approx(told[0][0] / 65536 / 1000, abs=1e-5)


@pytest.mark.costly
def test_the_bytes_are_the_same_every_time(tmp_path: Path) -> None:
    """A second run, in another process with other hashes and settings of matplotlib, gives the same bytes."""
    settings = tmp_path / "matplotlibrc"
    settings.write_text("savefig.bbox: tight\nsavefig.facecolor: red\npdf.fonttype: 3\npdf.compression: 0\n")
    code = ("import sys, graphplan as gp; from graphplan.sheet.layout.composition import compose; "
            "from graphplan.sheet.layout.layout import layout; "
            "from graphplan.output import pdf, png; sheet = layout(compose(gp.construct(gp.load('four-bar')))); "
            "sys.stdout.buffer.write(pdf.pdf([sheet]) + png.png(sheet))")
    env = {"PYTHONHASHSEED": "7", "PYTHONPATH": ":".join(sys.path), "MATPLOTLIBRC": str(settings)}
    run = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, check=True)
    sheet = sheet_of("four-bar")
    assert hashlib.sha256(run.stdout).digest() == hashlib.sha256(pdf([sheet]) + png(sheet)).digest()


def test_a_png_has_the_sheets_size() -> None:
    """Pixels are millimetres over 25.4 times the dots per inch."""
    sheet = sheet_of("four-bar")
    size = struct.unpack(">II", png(sheet, dpi=72)[16:24])
    assert size == (int(sheet.width / 25.4 * 72), int(sheet.height / 25.4 * 72))


REACHES: dict[type, Callable[[Any], Rect]] = {
    Polyline: lambda item: around(item.spots, item.pen.width / 2),
    Polygon: lambda item: around(item.spots, item.pen.width / 2),
    Circle: lambda item: around([item.centre], item.radius + item.pen.width / 2),
    Arc: lambda item: around(item.spots(), item.pen.width / 2),
    Arrow: lambda item: joined(around(item.barbs, 0.0), around([item.start], item.pen.width / 2)),
}


def around(spots: Any, margin: float) -> Rect:
    xs, ys = zip(*spots, strict=True)
    return Rect(min(xs) - margin, min(ys) - margin, max(xs) + margin, max(ys) + margin)


def joined(one: Rect, other: Rect) -> Rect:
    return Rect(min(one.left, other.left), min(one.bottom, other.bottom),
                max(one.right, other.right), max(one.top, other.top))  # fmt: skip


@pytest.mark.parametrize("kind", REACHES, ids=lambda kind: kind.__name__)
def test_strokes_are_where_the_display_list_says(kind: type) -> None:
    """The widest item of each kind, drawn alone, reaches as far as its spots and its pen say; arrows end in a point."""
    dark = [item for item in sheet_of("four-bar").items if item.layer != "paper" and item.pen != pens.PLATE]
    item = max((item for item in dark if isinstance(item, kind)), key=lambda item: REACHES[kind](item).width)
    reach = REACHES[kind](item)
    found = inked(alone(item, reach))
    for ours, theirs in zip(vars(found).values(), vars(reach).values(), strict=True):
        assert abs(ours - theirs) < NEAR


@pytest.mark.parametrize("anchor", ["start", "middle", "end"])
def test_letters_stand_where_they_are_measured_to_stand(anchor: str) -> None:
    """Capitals stand on the base line, are as high as measured, and fill the width that is measured; indices hang."""
    text = Text(pens.LETTERS, "text", None, (100.0, 100.0), (TextRun("HMI EH"), TextRun("HH", -1), TextRun(" IMH")),
                5.0, anchor)
    long = width(text.runs, text.size)
    left = 100.0 - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor] * long
    found = inked(alone(text, Rect(left, 98.0, left + long, 104.0)))
    bearing = 0.1 * text.size  # of an H, on either side
    assert found.left == pytest.approx(left + bearing, abs=NEAR)
    assert found.right == pytest.approx(left + long - bearing, abs=NEAR)
    assert found.top == pytest.approx(100.0 + CAPS * text.size, abs=NEAR)
    assert found.bottom == pytest.approx(100.0 - 0.22 * text.size, abs=NEAR)


def test_what_lies_in_front_covers_what_lies_behind() -> None:
    """Pairs are hollow, though links and vectors end in their middles; their rims are dark, and the margin is bare."""
    sheet = sheet_of("four-bar")
    picture = pixels(sheet)
    pairs = [item for item in sheet.items if isinstance(item, Circle) and item.pen == pens.PAIR]
    assert pairs
    for pair in pairs:
        (x, y), r = pair.centre, pair.radius
        rim = [dark(picture, x + r * math.cos(turn), y + r * math.sin(turn)) for turn in np.arange(0.0, 6.0, 0.5)]
        assert dark(picture, x, y) < 0.05
        assert min(rim) > 0.4
    assert dark(picture, 2.0, 2.0) == 0.0


@pytest.mark.costly
def test_the_suffix_says_what_is_drawn(tmp_path: Path) -> None:
    """`draw -o` writes SVG, PDF, PNG or DXF, in whatever case; a picture is as fine as --dpi says."""
    pytest.importorskip("ezdxf")
    begins = {"sheet.SVG": b"<?xml", "sheet.pdf": b"%PDF-", "sheet.PNG": b"\x89PNG", "sheet.dxf": b"  0\nSECTION"}
    for name, begin in begins.items():
        more = ["--dpi", "50"] if name.endswith("PNG") else []
        assert main(["draw", "four-bar", "-o", str(tmp_path / name), *more]) == 0
        assert (tmp_path / name).read_bytes().startswith(begin)
    assert struct.unpack(">I", (tmp_path / "sheet.PNG").read_bytes()[16:20]) == (int(297 / 25.4 * 50),)


@pytest.mark.parametrize(("name", "more", "said"), [
    ("sheet.jpg", [], "no sheet is written as .jpg; a name in .svg, .pdf, .png, .dxf"),
    ("sheet.svg", ["--dpi", "300"], "only a .png has a resolution"),
    ("sheet.png", ["--dpi", "5000"], "--dpi: 5000; give 20 to 600"),
    ("sheet.dxf", [], "ezdxf is not installed; pip install 'graphplan[dxf]'"),
])  # fmt: skip
def test_what_cannot_be_drawn_is_told_and_nothing_written(
    name: str, more: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """One clear line, exit status 2, and the file that was there is as it was."""
    monkeypatch.delitem(sys.modules, "graphplan.output.dxf", raising=False)
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    output = tmp_path / name
    output.write_text("kept")
    assert main(["draw", "four-bar", "-o", str(output), *more]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert [path.read_text() for path in tmp_path.iterdir()] == ["kept"]
