"""Fillets of involute wheels: what is left of a blank when the rack has rolled over it, by areas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shapely import Point, Polygon, affinity, unary_union

from graphplan.synthesis.gear import GearPair, InvoluteWheel
from graphplan.synthesis.task import parse


def wheel(teeth: int, shift: float = 0.0) -> InvoluteWheel:
    text = f"[gear]\nmodule = 1\nteeth = [{teeth}, 60]\nshift = [{shift}, 0]"
    return GearPair(parse(text, "task").request, "task").wheels[0]


def rack_tooth(shift: float) -> Polygon:
    """A tooth of the standard rack of module 1, rounded at its corners, from its pitch line as x, towards -y."""
    slope, half, radius = math.tan(math.radians(20)), math.pi / 4, 0.25 / (1 - math.sin(math.radians(20)))
    sharp = Polygon([(-half - 2 * slope, 2), (half + 2 * slope, 2), (half - 1.25 * slope, -1.25),
                     (-half + 1.25 * slope, -1.25)])
    return affinity.translate(sharp.buffer(-radius, quad_segs=64).buffer(radius, quad_segs=64), 0, shift)


@pytest.mark.parametrize(("teeth", "shift"), [(8, 0.0), (13, 0.0), (17, 0.5), (30, 0.0), (9, 0.473)])
def test_a_tooth_is_what_the_rack_leaves(teeth: int, shift: float) -> None:
    """The area between two teeth is that of all positions of the rack's tooth, undercut or not."""
    cut, gap = wheel(teeth, shift), rack_tooth(shift)
    r, rolls = cut.pitch, np.linspace(-6, 6, 1201)
    positions = [affinity.rotate(affinity.translate(gap, roll, r), math.degrees(roll / r), (0, 0)) for roll in rolls]
    lower = affinity.rotate(unary_union(positions), -90, (0, 0))  # the middle of the gap lies on +x
    outline = [z * complex(math.cos(math.pi / teeth), math.sin(math.pi / teeth)) for z in cut.tooth()]
    tooth = Polygon([(0, 0), *((z.real, z.imag) for z in outline)])
    sector = Polygon([(0, 0), *((1.5 * r * math.cos(t), 1.5 * r * math.sin(t))
                               for t in np.linspace(0, 2 * math.pi / teeth, 40))])
    blank = Point(0, 0).buffer(cut.tip, quad_segs=400).intersection(sector)
    both = unary_union([lower, affinity.rotate(lower, 360 / teeth, (0, 0))])
    assert blank.difference(both).symmetric_difference(tooth).area < 0.004


def test_only_undercut_teeth_lose_of_their_involute() -> None:
    """Where the shift is the least, the fillet ends where the involute begins; below it, higher on it."""
    least = 1 - 8 * math.sin(math.radians(20)) ** 2 / 2
    assert abs(wheel(8, least + 1e-6).fillet()[-1]) == pytest.approx(wheel(8).base, rel=1e-4)
    assert abs(wheel(8).fillet()[-1]) > 1.01 * wheel(8).base
    assert cut_below(wheel(8)) < wheel(8).half_angle(wheel(8).base)


def cut_below(one: InvoluteWheel) -> float:
    """Half the angle of a tooth where its fillet is narrowest."""
    return min(math.atan2(z.imag, z.real) for z in one.fillet())
