"""Sheets as PDF, PNG and DXF: tags that can be heard, letters of many languages, the same bytes, missing libraries."""

from __future__ import annotations

import ctypes
import io
import math
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pypdfium2
import pytest
from claims_of_exports import sheet
from face import ran
from inked_sheet import NS
from PIL import Image

import graphplan as gp

WORDS = "Шарнирный четырёхзвенник, Čebiševa mehānisms žņļķģšū, Mehhanismiõpetus äöü, α − ω²"


def drawn(folder: Path, name: str, *words: str) -> bytes:
    """A sheet as `draw` writes it."""
    file = folder / name
    done = ran("draw", *(words or ("four-bar",)), "-q", "-o", file)
    assert done.status == 0, done.err
    return file.read_bytes()


def test_a_pdf_says_what_it_is_and_what_its_parts_are(tmp_path: Path) -> None:
    """Readers find title, subject and keywords; every word is in a head or a paragraph, all ink of plans in a figure
    that is described, and each part of a page belongs to one tag."""
    data = drawn(tmp_path, "sheet.pdf", "four-bar", "--language", "lv")
    assert b"/Lang (lv)" in data
    assert b"/FontFile2" in data, "fonts are embedded as outlines"
    document, svg = pypdfium2.PdfDocument(data), drawn(tmp_path, "sheet.svg", "four-bar", "--language", "lv").decode()
    about = document.get_metadata_dict()
    assert f"<title>{about['Title']}</title>" in svg
    assert about["Subject"] in svg
    assert about["Keywords"]
    assert document.is_tagged()
    for page in document:
        (root,) = tagged(pypdfium2.raw, pypdfium2.raw.FPDF_StructTree_GetForPage(page))
        kinds = [kind for kind, *_ in root]
        assert {*kinds} <= {"H1", "P", "Figure", "Artifact"}
        assert kinds.count("H1") >= 1
        assert kinds.count("P") > 10
        assert all(alt for kind, alt, _ in root if kind == "Figure")
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


def test_letters_of_many_languages_can_be_read_again(tmp_path: Path) -> None:
    """Whoever extracts the text of a PDF finds the title's words; of letters that the font lacks it is said."""
    document = pypdfium2.PdfDocument(drawn(tmp_path, "sheet.pdf", "four-bar", "--set", f"title={WORDS}"))
    text = " ".join(" ".join(page.get_textpage().get_text_range() for page in document).split())
    assert all(word in text for word in WORDS.split())
    for ending in ("pdf", "png"):
        refused = ran("draw", "four-bar", "--set", "title=四杆 linkage", "-o", tmp_path / f"none.{ending}")
        assert refused.status == 2
        assert "DejaVu Sans has no 四 杆; draw it as SVG" in refused.err
        assert not (tmp_path / f"none.{ending}").exists()


def test_a_png_has_the_sheets_size_and_covers_what_lies_behind(tmp_path: Path) -> None:
    """Pixels are millimetres over 25.4 times the dots per inch; pairs are hollow with dark rims, the margin is bare."""
    data = drawn(tmp_path, "sheet.png", "four-bar", "--dpi", "204")
    assert struct.unpack(">II", data[16:24]) == (round(297 / 25.4 * 204), round(210 / 25.4 * 204))
    picture = 1 - np.asarray(Image.open(io.BytesIO(data)).convert("L")) / 255
    pairs = [one for key, one in sheet("four-bar").elements if key == "layer-pairs" and one.tag == f"{NS}circle"]
    assert pairs
    for pair in pairs:
        x, y, r = (float(pair.get(name, 0)) * 204 / 25.4 for name in ("cx", "cy", "r"))
        rim = [picture[int(y + r * math.sin(turn)), int(x + r * math.cos(turn))] for turn in np.arange(0.0, 6.0, 0.5)]
        assert picture[int(y), int(x)] < 0.05
        assert min(rim) > 0.4
    assert picture[16, 16] == 0


@pytest.mark.costly
@pytest.mark.parametrize("ending", ["pdf", "png", "dxf", "ggb", "tex"])
def test_the_bytes_are_the_same_every_time(ending: str, tmp_path: Path) -> None:
    """A second run, in another process with other hashes, gives the same bytes."""
    env = {"PYTHONHASHSEED": "7", "PYTHONPATH": ":".join(sys.path)}
    subprocess.run([sys.executable, "-m", "graphplan", "export", "four-bar", "-q", "-o", tmp_path / f"again.{ending}"],
                   env=env, check=True)
    assert ran("export", "four-bar", "-q", "-o", tmp_path / f"one.{ending}").status == 0
    assert (tmp_path / f"again.{ending}").read_bytes() == (tmp_path / f"one.{ending}").read_bytes()


def test_a_library_that_is_not_there_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without ezdxf a line says what to install, and nothing is written."""
    monkeypatch.delitem(sys.modules, "graphplan.exports.dxf", raising=False)
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    refused = ran("draw", "four-bar", "-o", tmp_path / "sheet.dxf")
    assert refused.status == 2
    assert "ezdxf is not installed; pip install 'graphplan[dxf]'" in refused.err
    assert not [*tmp_path.iterdir()]


def test_a_dxf_hides_what_lies_behind_its_marks(tmp_path: Path) -> None:
    """Each hollow circle of the sheet has a wipeout beneath it, and tints are solid hatches."""
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.read(io.StringIO(drawn(tmp_path, "sheet.dxf").decode()))
    left, bottom = document.header["$LIMMIN"][:2]
    covers = [[*cover.boundary_path_wcs()][:-1] for cover in document.modelspace().query("WIPEOUT")]
    centres = [tuple(sum(spot[axis] for spot in corners) / len(corners) for axis in (0, 1)) for corners in covers]
    hollow = [one for _, one in sheet("four-bar").elements
              if one.tag == f"{NS}circle" and one.get("fill", "").lower() in ("#ffffff", "white")]
    assert hollow
    for one in hollow:
        place = left + float(one.get("cx", 0)), bottom + 210 - float(one.get("cy", 0))
        assert min(math.dist(place, centre) for centre in centres) < 0.01
    assert all(hatch.dxf.solid_fill for hatch in document.modelspace().query("HATCH"))


# ---- Python ----------------------------------------------------------------------------------------------------------


def test_a_construction_is_told_in_one_line() -> None:
    """Its representation has the title, the number of steps and the methods, or why it cannot be drawn."""
    drawing = gp.construct(gp.load("four-bar"))
    assert repr(drawing).startswith(f"<Construction of {drawing.scene.title}: {gp.solve(drawing.scene).json()['steps']}"
                                    " steps; velocity by ")
    assert "\n" not in repr(drawing)
    assert len(repr(drawing)) < 200
    dead = gp.scene({"title": "Dead centre", "points": {"O": (0, 0), "A": (3, 0), "B": (7, 0), "C": (10, 0)},
                     "links": {"1": "O A", "2": "A B", "3": "B C", "frame": "O C"},
                     "drive": [{"link": "1", "omega": 1}]})
    assert repr(gp.construct(dead)) == "<Construction of Dead centre: lines-parallel>"


def test_the_sheet_is_had_as_bytes() -> None:
    """The sheet comes as text of an SVG, which notebooks show, as a PDF and as a picture of so many dots an inch."""
    drawing = gp.construct(gp.load("four-bar"))
    assert gp.sheet.pdf(drawing, "A4").startswith(b"%PDF")
    picture = gp.sheet.png(drawing, "A4", dpi=50)
    assert struct.unpack(">II", picture[16:24]) == (round(297 / 25.4 * 50), round(210 / 25.4 * 50))
    assert type(drawing)._repr_svg_(drawing) == gp.sheet.svg(drawing)


def test_nothing_that_draws_is_loaded_before_it_is_asked_for() -> None:
    """`import graphplan` loads no module of it and not numpy; constructing loads nothing that writes pictures."""
    code = """
import sys, graphplan as gp
assert not [name for name in sys.modules if name.startswith(('graphplan.', 'numpy'))]
drawing = gp.construct(gp.load('four-bar'))
assert not {'svgwrite', 'matplotlib', 'shapely', 'fontTools', 'ezdxf'} & {*sys.modules}
assert drawing._repr_svg_().startswith('<?xml')
"""
    subprocess.run([sys.executable, "-c", code], env={"PYTHONPATH": ":".join(sys.path)}, check=True)
