"""The mechanism plan laid out by the scene's own placements."""

from __future__ import annotations

import math

import pytest
from sampling import CORE

import graphplan as gp
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import evaluate
from graphplan.methods.positions import layout

PLACED = """
[points]
O = [0, 0]
C = [60, 5]
A = { from = "O", distance = 25, angle = 50 }
B = { distances = { A = 60, C = 45 }, side = "SIDE" }
M = { on = "A B", distance = ALONG }
S = { distances = { A = 70 }, on = { through = [0, -10], direction = [1, 0.1] }, pick = "PICK" }
[links]
1 = "O A"
2 = "A B M"
3 = "B C"
4 = "A S"
5 = "S"
frame = "O C"
[[slides]]
link = "5"
along = "frame"
at = "S"
direction = [1, 0.1]
[[drive]]
link = "1"
omega = 1
"""


def assert_laid_out(scene: gp.Scene) -> None:
    """The drawn points are the scene's."""
    program = layout(scene)
    values = evaluate(program, Floats())
    for name, index in zip(scene.points, program.wanted, strict=True):
        assert math.dist(values[index], tuple(map(float, scene.points[name]))) <= 1e-9 * 100


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("pick", ["left", "right"])
@pytest.mark.parametrize("along", ["20", "-15"])
def test_every_placement_is_drawn_where_the_scene_puts_it(side: str, pick: str, along: str) -> None:
    """Polar, compass, arc-and-line and on-line placements, on either side, are drawn by instruments."""
    text = PLACED.replace("SIDE", side).replace("PICK", pick).replace("ALONG", along)
    assert_laid_out(gp.parse(text, "placed"))


@pytest.mark.parametrize("name", CORE)
def test_every_packaged_pose_can_be_laid_out(name: str) -> None:
    """The mechanism plan of every packaged scene can be drawn from an empty sheet."""
    assert_laid_out(gp.load(name))
