"""Slides that bear on a length, over the cycle: pressed at both edges in some poses, at one in others."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.check.reduction import check_reduction
from graphplan.check.stream import Stream
from graphplan.check.trusted import report
from graphplan.cycle.pose import in_pose
from graphplan.machine.reduced.reduction import Reduction, reduction

MOMENT = "balance moment with friction"
SLIDER_CRANK = """
[points]
O = [0, 0]
A = [32, 24]
B = [150, {y}]
D = [190, {d}]
[links]
1 = "O A"
2 = "A B"
3 = "B D"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
[[drive]]
link = "1"
omega = {omega}
[masses.3]
mass = 2
centre = "D"
[[forces]]
on = "3"
at = "D"
value = [{x}, {f}]
[balance]
link = "1"
[[friction]]
slide = ["3", "frame"]
coefficient = {mu}
length = {length}
[flywheel]
speed = 10
unevenness = 0.05
"""
CYLINDER = """
[points]
O = [0, 0]
B = [-100, 173.20508]
C = [280, 63.50853]
A = [500, 0]
[links]
1 = "O B"
2 = "B C"
3 = "A"
frame = "O A"
[[slides]]
link = "2"
along = "3"
at = "C"
direction = [600, -173.20508]
[[drive]]
link = "1"
omega = -10
[masses.2]
mass = 10
centre = "C"
[[forces]]
on = "2"
at = "B"
value = [900, -40]
[[moments]]
on = "3"
value = 20
[balance]
link = "1"
[[friction]]
slide = ["2", "3"]
coefficient = 0.1
length = 200
"""


def random_sleeve(seed: int) -> str:
    """A slider-crank whose slider bears on a length, with a force beside it."""
    draw = Random(seed).uniform
    return SLIDER_CRANK.format(y=draw(-15, 15), d=draw(-40, 40), x=draw(-900, -300), f=draw(-200, 200),
                               length=draw(25, 90), mu=draw(0.05, 0.2), omega=Random(seed).choice([10, -10]))


def states(of: Reduction) -> set[tuple[int, ...]]:
    """How the slides are pressed where both edges press, in any pose that was drawn."""
    assert of.friction is not None
    return {*of.friction.recordings.by_state}


@pytest.mark.parametrize("text", [*map(random_sleeve, range(6)), CYLINDER], ids=[*map(str, range(6)), "cylinder"])
def test_sleeves_over_the_cycle(text: str) -> None:
    """In every pose the moment of friction is the solver's, which decides by itself which edges press."""
    reduced = reduction(gp.parse(text, "sleeve"))
    gaps = check_reduction(reduced, np.linspace(0.05, 6.2, 24))
    assert gaps["friction"] < 1e-9
    assert states(reduced)


def test_both_states_come_in_one_turn() -> None:
    """In a turn a slide is pressed at both edges on either side and at one edge, too, and the flywheel takes it."""
    scene = gp.parse(SLIDER_CRANK.format(y=0, d=12, x=-500, f=-400, length=60, mu=0.15, omega=10), "sleeve")
    reduced = reduction(scene)
    assert reduced.friction is not None
    with_length = reduced.friction.friction_at(np.linspace(0.05, 6.2, 60)).moment
    point = reduction(gp.parse(scene.text.replace("length = 60\n", ""), "point")).friction
    assert point is not None
    as_point = point.friction_at(np.linspace(0.05, 6.2, 60)).moment
    same = np.isclose(with_length, as_point, rtol=1e-9)
    assert 0 < same.sum() < 60  # where one edge bears it the length does not matter
    assert (with_length <= as_point + 1e-9).all()  # where both press it loses more
    assert "friction" in gp.flywheel(scene).json()["check"]


@pytest.mark.parametrize("start", ["one edge", "dead centre"])
def test_cycle_has_what_each_pose_has(start: str) -> None:
    """Over the cycle each pose is drawn as its slide is pressed there, and rubs where it moves, though it is given as
    pressed at one edge or as standing still: its forces are those of that pose alone."""
    text = SLIDER_CRANK.format(y=0, d=12, x=-500, f=-400, length=60, mu=0.15, omega=10)
    if start == "dead centre":
        text = text.replace("[32, 24]", "[40, 0]").replace("length = 60\n", "")
    scene = gp.parse(text, "sleeve")
    over_cycle = cycle(scene, 13)
    assert not over_cycle.faults
    assert over_cycle.otherwise
    (block,) = Stream(over_cycle.drawing, 13, checked=False).blocks()
    of_block, is_drawn = block.results[MOMENT]["1"], ~np.isin(range(13), [*block.faults])
    assert block.faults.keys() == over_cycle.otherwise.keys(), "unchecked poses that rub otherwise are told, too"
    assert np.array_equal(of_block[is_drawn], over_cycle.results[MOMENT]["1"][is_drawn])
    alone = [report(in_pose(scene, over_cycle.turn, k)).results[MOMENT]["1"] for k in range(13)]
    assert over_cycle.results[MOMENT]["1"] == pytest.approx([*map(float, alone)], rel=1e-9, abs=1e-9)
