"""What a notebook shows of a construction: its sheet, and no library that draws is loaded before."""

from __future__ import annotations

import subprocess
import sys

import graphplan as gp


def test_a_notebook_shows_the_sheet() -> None:
    """The representation that notebooks ask for is the sheet's SVG."""
    drawing = gp.construct(gp.load("four-bar"))
    assert type(drawing)._repr_svg_(drawing) == gp.sheet.svg(drawing)


def test_nothing_of_the_sheet_is_loaded_before() -> None:
    """Constructing loads nothing that writes pictures; the sheet is drawn when a notebook asks for it."""
    code = """
import sys, graphplan as gp
drawing = gp.construct(gp.load('four-bar'))
assert not {'svgwrite', 'matplotlib', 'shapely', 'fontTools', 'ezdxf'} & {*sys.modules}
assert drawing._repr_svg_().startswith('<?xml')
"""
    subprocess.run([sys.executable, "-c", code], env={"PYTHONPATH": ":".join(sys.path)}, check=True)
