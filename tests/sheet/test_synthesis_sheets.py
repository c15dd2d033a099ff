"""Sheets of packaged syntheses: their letters can be read, and the mechanism uses the paper."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from inked_sheet import InkedSheet

import graphplan as gp
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names


def sheet_of(name: str) -> InkedSheet:
    return InkedSheet.of(gp.synthesize(name)._repr_svg_())


@pytest.mark.parametrize("name", packaged_names(TASK_FOLDER))
def test_letters_can_be_read(name: str) -> None:
    """No letter lies on another or is nearer to another mark, none is too small, and scales are round."""
    sheet = sheet_of(name)
    assert (sheet.labels_on_labels, sheet.labels_nearer_to_others, sheet.odd_scales) == ([], [], [])
    assert sheet.smallest_letters >= 1.8
    assert sheet.ink_of_panels >= 0.2 - 0.02
    assert sheet.lines_through_labels == []
    assert sheet.long_leaders == []


@pytest.mark.parametrize(("name", "joints"), [("cognates-four-bar", 9), ("dwell-output", 7)])
def test_a_path_is_drawn_with_the_linkage_that_has_it(name: str, joints: int) -> None:
    """The sheets of cognates and of a dwell show the joints of the given linkage besides those that are found."""
    circles = sheet_of(name)._circles
    assert len({(round(spot.x, 2), round(spot.y, 2)) for _, spot, radius in circles if radius > 0.7}) == joints


@pytest.mark.parametrize(("name", "circles"), [("stroke-crank-rocker", 3), ("stroke-lever", 0)])
def test_the_circles_of_a_stroke_are_seen(name: str, circles: int) -> None:
    """Those that lie in the panel are whole; of another, such as that of the lever's crank, there is an arc from dead
    position to dead position, on which both pins lie."""
    found = gp.synthesize(name)
    sheet = InkedSheet.of(found._repr_svg_())
    assert sum(radius > 10 for _, _, radius in sheet._circles) == circles
    arcs = [stroke.line for stroke in sheet.strokes if len(stroke.line.coords) >= 72]
    assert len(arcs) == 1
    assert arcs[0].length > 100


def test_the_joints_of_a_given_linkage_have_letters() -> None:
    """O, A, B and C of the linkage that draws the path of a dwell: once more than as letters of the sheet's border."""
    letters = re.findall(r">([OABC])<", gp.synthesize("dwell-output")._repr_svg_())
    assert Counter(letters) == {"O": 1, "A": 3, "B": 3, "C": 3}


@pytest.mark.parametrize("teeth", [(12, 44), (19, 49)])
def test_letters_of_wheels_stand_near(teeth: tuple[int, int], tmp_path: Path) -> None:
    """Of a pinion within its circles, of the mesh in its detail."""
    task = tmp_path / "gears.toml"
    task.write_text(f'title = "Gears"\n[gear]\nmodule = 2\nteeth = {list(teeth)}\nshift = "least"\n', "utf-8")
    sheet = InkedSheet.of(gp.synthesize(task)._repr_svg_())
    assert sheet.long_leaders == sheet.lines_through_labels == []
