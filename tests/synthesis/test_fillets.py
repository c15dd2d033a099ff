"""Fillets of involute wheels: what is left of a blank when the rack has rolled over it, by areas."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from face import ran
from shapely import Point, Polygon, affinity, unary_union
from tasks import written


def rack_tooth(shift: float) -> Polygon:
    """A tooth of the standard rack of module 1, rounded at its corners, from its pitch line as x, towards -y."""
    slope, half, radius = math.tan(math.radians(20)), math.pi / 4, 0.25 / (1 - math.sin(math.radians(20)))
    sharp = Polygon([(-half - 2 * slope, 2), (half + 2 * slope, 2), (half - 1.25 * slope, -1.25),
                     (-half + 1.25 * slope, -1.25)])
    return affinity.translate(sharp.buffer(-radius, quad_segs=64).buffer(radius, quad_segs=64), 0, shift)


@pytest.mark.parametrize(("teeth", "shift"), [(8, 0.0), (13, 0.0), (17, 0.5), (30, 0.0), (9, 0.473)])
def test_a_tooth_is_what_the_rack_leaves(teeth: int, shift: float, tmp_path: Path) -> None:
    """The area between two teeth is that of all positions of the rack's tooth, undercut or not, as is told."""
    text = f"[gear]\nmodule = 1\nteeth = [{teeth}, 60]\nshift = [{shift}, 0]\n"
    record = ran("synthesize", written(tmp_path / "gear.toml", text), "-q").json
    cut, gap, r = record["wheels"][0], rack_tooth(shift), teeth / 2
    assert cut["pitch"] == r
    assert cut["undercut"] == (shift < 1 - r * math.sin(math.radians(20)) ** 2)
    rolls = np.linspace(-6, 6, 1201)
    positions = [affinity.rotate(affinity.translate(gap, roll, r), math.degrees(roll / r), (0, 0)) for roll in rolls]
    lower = affinity.rotate(unary_union(positions), -90, (0, 0))  # the middle of the gap lies on +x
    turn = complex(math.cos(math.pi / teeth), math.sin(math.pi / teeth))
    tooth = Polygon([(0, 0), *((z.real, z.imag) for z in (complex(*place) * turn for place in record["profile"][0]))])
    sector = Polygon([(0, 0), *((1.5 * r * math.cos(t), 1.5 * r * math.sin(t))
                               for t in np.linspace(0, 2 * math.pi / teeth, 40))])
    blank = Point(0, 0).buffer(cut["tip"], quad_segs=400).intersection(sector)
    both = unary_union([lower, affinity.rotate(lower, 360 / teeth, (0, 0))])
    assert blank.difference(both).symmetric_difference(tooth).area < 0.004
