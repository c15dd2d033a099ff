"""Springs: two opposite forces along the line of their ends, as strong as they are stretched, in every pose."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SceneError
from graphplan.machine.reduced.reduction import reduction
from graphplan.mechanism.model import Scene

CRANK = """
title = "spring"
[points]
O = [0, 0]
A = [{x}, {y}]
F = [0, 90]
[links]
1 = "O A"
frame = "O F"
[[drive]]
link = "1"
omega = 2
[[springs]]
ends = {ends}
stiffness = 2.5
free = 20
[balance]
link = "1"
"""
FOUR_BAR = """
title = "spring between moving links"
[points]
O = [0, 0]
C = [80, 0]
A = [24, 18]
B = [60, 80]
M = [25, 70]
[links]
1 = "O A"
2 = "A B M"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 2
[[springs]]
ends = ["M", "C"]
on = ["2", "3"]
stiffness = 1.5
free = 40
[balance]
link = "1"
"""


def crank(x: int = 48, y: int = 26, ends: str = '["A", "F"]') -> Scene:
    """A crank that a spring pulls."""
    return gp.parse(CRANK.format(x=x, y=y, ends=ends), "spring.toml")


@pytest.mark.parametrize("ends", ['["A", "F"]', '["F", "A"]'])
def test_pull_is_stiffness_times_stretch_along_the_line(ends: str) -> None:
    """AF = 80, stretched by 60: 150 N from A towards F, exactly, whichever end is named first."""
    force, = crank(ends=ends).loads.forces
    assert (force.on, force.at, force.value) == ("1", "A", (Fraction(-90), Fraction(120)))


def test_balance_holds_the_pull_exactly() -> None:
    """The moment on the crank is that of the pull about O, the other way: 48·120 + 26·90 = 8100 N mm."""
    assert result_data(report(crank(), exact=True))["balance"]["moment"] == "-81/10"


def test_both_moving_ends_are_pulled_alike() -> None:
    """On each of two moving links acts the opposite of what acts on the other."""
    one, two = gp.parse(FOUR_BAR, "spring.toml").loads.forces
    assert {one.on, two.on} == {"2", "3"}
    assert (one.value[0] + two.value[0], one.value[1] + two.value[1]) == (0, 0)


def test_work_is_the_change_of_the_elastic_energy() -> None:
    """The reduced moment of the springs over the travel adds up to c (l - l_0)^2 / 2, lost on the way."""
    machine = reduction(gp.parse(FOUR_BAR, "spring.toml"))
    travel = np.linspace(0.0, np.pi / 3, 2001)
    moments = machine.reduce_at(travel).moment
    work = float(np.sum((moments[1:] + moments[:-1]) / 2) * (travel[1] - travel[0]))
    points = gp.cycle.follow(gp.parse(FOUR_BAR, "spring.toml"), 2, (0, 60)).points
    M, C = points["M"], points["C"]
    energy = 1.5 * (np.abs(M - C) - 40) ** 2 / 2 / 1000
    assert work == pytest.approx(energy[0] - energy[-1], rel=1e-6)


@pytest.mark.parametrize(("ends", "problem"), [
    ('["A", "A"]', "both ends are one point"),
    ('["A", "O"]', "O is on several links: 1, frame"),
    ('["O", "F"]\non = ["frame", "frame"]', "both ends are on link frame"),
    ('["A", "F"]\non = ["frame", "1"]', "A is not a point of link frame"),
    ('"A F"', "where two points are wanted"),
])
def test_faulty_springs_are_named(ends: str, problem: str) -> None:
    """What is wrong with a spring is one line."""
    with pytest.raises(SceneError, match=problem):
        crank(ends=ends)


def test_ends_that_lie_together_have_no_direction() -> None:
    """A spring of no length pulls no way: that is a fault of the pose."""
    with pytest.raises(SceneError, match="lie together"):
        crank(0, 90)
