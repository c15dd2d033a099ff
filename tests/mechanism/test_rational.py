"""Which scenes are rational: exact numbers are refused only where results depend on what fractions cannot hold."""

from __future__ import annotations

from fractions import Fraction

import pytest

from graphplan.mechanism.scene import parse
from graphplan.solver import solve

SCENE = """
[points]
O = [0, 0]
A = [3, 4]
B = [9, 4]
C = [12, 0]
{points}
[links]
1 = "O A"
2 = "A B {second}"
3 = "B C"
frame = "O C"
{links}
{more}
[[drive]]
link = "1"
{drive}
[find]
velocity = ["B"{asked}]
"""
SPEED = "omega = 1"
GUIDED = """[[slides]]
link = "4"
along = "3"
at = "S"
direction = {0}"""


def scene(points: str = "", second: str = "", *, links: str = "", more: str = "", drive: str = SPEED,
          asked: str = "") -> str:
    return SCENE.format(points=points, second=second, links=links, more=more, drive=drive, asked=asked)


RATIONAL = {
    "polar along the axes": 'D = { from = "A", distance = 5, angle = -450 }',
    "compasses that meet in fractions": 'D = { distances = { A = 5, B = 5 }, side = "right" }',
    "compasses that touch": 'D = { distances = { A = 2, B = 4 }, side = "right" }',
    "an arc and a line of any length": 'D = { distances = { O = 5 }, on = { through = "O", direction = [6, 8] }, '
                                       'pick = "left" }',
    "an arc and a line at 45 degrees": 'D = { distances = { A = 5 }, on = { through = [7, 7], direction = 45 }, '
                                       'pick = "left" }',
    "a ruler along a Pythagorean line": 'D = { on = "O A", distance = -2.5 }',
    "a ruler that lays off nothing": 'D = { on = "O H", distance = 0 }\nH = [1, 1]',
}


@pytest.mark.parametrize("points", RATIONAL.values(), ids=RATIONAL.keys())
def test_points_that_fractions_hold(points: str) -> None:
    """Whatever places a point, it is rational where its coordinates are."""
    found = parse(scene(points, "D H" if "H =" in points else "D", asked=', "D"'), "rational")
    assert found.irrational == ()
    assert all(isinstance(part, Fraction) for part in solve(found, exact=True).velocity["D"])


def test_what_no_result_depends_on_may_be_irrational() -> None:
    """A point of a link that nothing uses, even the first one, and a point that serves the hand do not matter."""
    found = parse(scene('E = { from = "A", distance = 2, angle = 33 }').replace('"A B "', '"E A B"'), "unused")
    assert found.irrational == ()
    assert solve(found, exact=True).velocity["B"] == solve(parse(scene(), "bare"), exact=True).velocity["B"]
    assert parse(scene('E = { from = "A", distance = 2, angle = 33 }', "E", asked=', "E"'), "asked").irrational == (
        "points.E: polar placement",)


@pytest.mark.parametrize(("direction", "reason"), [
    ("[1, 1]", ()), ("-135", ()), ('"A C"', ()), ("30", ("slides.1.direction: angle",))])
def test_a_direction_has_any_length(direction: str, reason: tuple[str, ...]) -> None:
    """The length of a guide's direction is asked of actuators alone; its angle is rational at multiples of 45."""
    text = scene('S = [8, 3]', links='4 = "S"\n5 = "S O"', more=GUIDED.format(direction))
    assert parse(text, "guided").irrational == reason


def test_rpm_enters_where_anything_turns() -> None:
    """Turns a minute bring pi in, unless there are none."""
    assert parse(scene(drive="rpm = 0\nalpha = 3"), "still").irrational == ()
    assert parse(scene(drive="rpm = 30"), "turning").irrational == ("drive.1.rpm: rpm (2 pi/60)",)
