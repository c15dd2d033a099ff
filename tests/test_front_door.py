"""The front door: what a construction shows of itself, and its sheet in every form without a file."""

from __future__ import annotations

import struct

from four_bars import four_bar

import graphplan as gp

DRAWING = gp.construct(gp.load("four-bar"))


def test_a_construction_is_told_in_one_line() -> None:
    """Its representation has the title, the number of steps and the methods, and no more than a line of them."""
    steps = len(DRAWING.drawn) - DRAWING.drawn.givens
    assert repr(DRAWING).startswith(f"<Construction of {DRAWING.scene.title}: {steps} steps; velocity by ")
    assert "\n" not in repr(DRAWING)
    assert len(repr(DRAWING)) < 200


def test_a_singular_construction_is_told_too() -> None:
    """Where the pose cannot be drawn the representation says so instead of failing."""
    text = four_bar("omega = 1.0", head='title = "Dead centre"\n', A="[3, 0]", B="[7, 0]", C="[10, 0]")
    assert repr(gp.construct(gp.parse(text, "dead"))) == "<Construction of Dead centre: lines-parallel>"


def test_the_sheet_is_had_as_pdf_and_png() -> None:
    """The sheet comes as the bytes of a PDF of its true size, and of a picture of so many dots per inch."""
    assert gp.sheet.pdf(DRAWING, "A4").startswith(b"%PDF")
    picture = gp.sheet.png(DRAWING, "A4", dpi=50)
    assert picture.startswith(b"\x89PNG")
    assert struct.unpack(">II", picture[16:24]) == (int(297 / 25.4 * 50), int(210 / 25.4 * 50))
