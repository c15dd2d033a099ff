"""The cubic of stationary curvature: its points keep the curvature of their paths, and pins lie on it."""

from __future__ import annotations

import numpy as np
import pytest

import graphplan as gp
from graphplan.cycle.motion_curves import stationary_curvature, traced_motion
from graphplan.cycle.turn import whole_motion
from graphplan.mechanism.scene import parse

SCENE = """
title = "four-bar"
[points]
O = [0, 0]
C = [100, 0]
A = [24, 32]
B = [80, 80]
M = [{x}, {y}]
[links]
1 = "O A"
2 = "A B M"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 10
[sheet]
cubics = ["2"]
"""
SLIDER = SCENE.replace('3 = "B C"', '3 = "B"') + """
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
"""


def cubic(text: str) -> tuple[np.ndarray, np.ndarray]:
    """The circling points and their centres."""
    found = stationary_curvature(whole_motion(parse(text.format(x=50, y=20), "scene")), "2")
    assert found
    return found


def gap(places: np.ndarray, spot: complex) -> float:
    """How near a curve comes to a spot, between its points too."""
    k = int(np.argmin(np.abs(places - spot)))
    one, other = places[k - 1], places[(k + 1) % places.size]
    return abs(((spot - one) * (other - one).conjugate()).imag / abs(other - one))


def test_pins_lie_on_it_and_their_pivots_are_centres() -> None:
    """Points whose paths are circles or straight lines lie on the cubic, their centres on the other curve."""
    circling, centres = cubic(SCENE)
    assert max(gap(circling, 24 + 32j), gap(circling, 80 + 80j)) < 1e-3
    assert max(gap(centres, 0j), gap(centres, 100 + 0j)) < 1e-3
    circling, _ = cubic(SLIDER)
    assert max(gap(circling, 24 + 32j), gap(circling, 80 + 80j)) < 1e-3


@pytest.mark.parametrize("text", [SCENE, SLIDER])
def test_its_points_keep_the_curvature_of_their_paths(text: str) -> None:
    """Over a small travel the curvature hardly changes, beside what it does of a point near the curve."""
    circling, _ = cubic(text)
    near = circling[np.abs(circling - (50 + 50j)) < 60]
    for place in near[:: near.size // 3]:
        on, off = (changed(text, z) for z in (place, place + 3 + 2j))
        assert on < 1e-2 * off


def changed(text: str, place: complex) -> float:
    """By how much the curvature of a point's path changes a little before and after the given pose."""
    step = 0.01
    path = gp.cycle.follow(parse(text.format(x=place.real, y=place.imag), "scene"), 41, (-20 * step, 20 * step))
    z = path.points["M"]
    v, a = (z[2:] - z[:-2]) / 2, z[2:] - 2 * z[1:-1] + z[:-2]
    curvature = (v.conj() * a).imag / np.abs(v) ** 3
    return abs(float(curvature[-1] - curvature[0]))


def test_it_is_drawn_in_its_own_pose_alone() -> None:
    """The sheet has both curves with their names; in another pose they say nothing, and are not drawn."""
    scene = parse(SCENE.format(x=50, y=20), "scene")
    found = traced_motion(scene)
    assert found
    assert [str(one.words) for one in found.centrodes] == ["circling points of 2", "centre points of 2"]
    moved = scene.with_pose(scene.points | {"A": (32, 24)}, lambda one: one.direction)
    assert all([*one.items(lambda spot: spot, scene)] for one in found.centrodes)
    assert not any([*one.items(lambda spot: spot, moved)] for one in found.centrodes)
