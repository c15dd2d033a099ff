"""Polar plans show of what vectors are the sums, head to tail, and the figures that are similar to links."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from itertools import pairwise

import pytest
from sheets import sheet_of

from graphplan.output.svg import svg
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Polyline

NS = "{http://www.w3.org/2000/svg}"
SUMS = {  # of scenes: chains of vectors that begin at the pole, and the whole vector
    "four-bar": [(["normal BC", "tangential BC"], "acceleration B"),
                 (["acceleration A", "normal BA", "tangential BA"], "acceleration B"),
                 (["normal AO"], "acceleration A"), (["velocity A", "relative BA"], "velocity B")],
    "slotted-link": [(["normal A3P", "tangential A3P"], "acceleration A3"),
                     (["acceleration A", "coriolis A3", "sliding A3"], "acceleration A3"),
                     (["velocity A", "relative A3A"], "velocity A3")],
    "triad": [(["acceleration A", "normal EA", "tangential EA"], "acceleration E")],
}
SAME_MM = 0.02


@pytest.mark.parametrize("name", SUMS)
def test_parts_stand_head_to_tail(name: str) -> None:
    """Each begins where the one before it ends, the first at the pole; the last ends where their sum does."""
    groups = ET.fromstring(svg(sheet_of(name, plan="polar")).encode()).iter(f"{NS}g")
    ends = {label: [tuple(map(float, (group.get(key) or "").split())) for key in ("data-from", "data-to")]
            for group in groups if (label := group.get("data-vector"))}
    for chain, whole in SUMS[name]:
        for before, after in pairwise(chain):
            assert math.dist(ends[before][1], ends[after][0]) < SAME_MM, (before, after)
        assert math.dist(ends[chain[0]][0], ends[whole][0]) < SAME_MM, chain
        assert math.dist(ends[chain[-1]][1], ends[whole][1]) < SAME_MM, chain


def test_a_similar_triangle_shows_its_sides() -> None:
    """Of the triangle a'b'm', similar to ABM, the three sides are on the sheet, in the proportions of the link's."""
    sides = [item.spots for item in sheet_of("four-bar", plan="polar").items
             if isinstance(item, Polyline) and item.pen == pens.SIDE]
    assert sorted(round(math.dist(*side) / math.dist(*sides[0]), 2) for side in sides) == sorted(
        round(length / 162.63, 2) for length in (162.63, 174.64, 164.47))
