"""Losses beyond journals, slides and contacts, in the solver and drawn: values by hand and the balance of powers."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SceneError
from graphplan.mechanism.scene import parse
from graphplan.solver import with_friction

SLEDGE = """title = "A sledge"
[points]
P = [0, 0]
R = [20, 0]
[links]
1 = "P"
frame = "R"
[[slides]]
link = "1"
along = "frame"
at = "P"
direction = [1, 0]
[[drive]]
slide = ["1", "frame"]
speed = 7
[[forces]]
on = "1"
at = "P"
value = [-300, -1000]
[balance]
on = "1"
at = "P"
direction = [1, 0]
[[friction]]
slide = ["1", "frame"]
coefficient = 0.1
"""


def test_a_wedge_rubs_more() -> None:
    """In a V of 40 degrees f' = 0.1 / sin 20: a load of 1000 takes 292.38 beside the useful 300."""
    scene, rubbed = parse(SLEDGE + "wedge = 40\n", "sledge"), 1000 * 0.1 / math.sin(math.radians(20))
    data = result_data(report(scene))
    assert with_friction(scene).balances == (pytest.approx((300 + rubbed, 0)),)
    assert data["balance"]["force"] == pytest.approx([300 + rubbed, 0])
    assert data["friction"]["efficiency"] == pytest.approx(300 / (300 + rubbed))


def test_a_wedge_of_60_degrees_is_rational() -> None:
    """Its f' is twice f, in fractions; that of 40 degrees is none, and is said to be irrational."""
    (balance,) = with_friction(parse(SLEDGE + "wedge = 60\n", "sledge"), exact=True).balances
    assert balance == (Fraction(500), 0)
    assert parse(SLEDGE + "wedge = 40\n", "sledge").irrational == ("friction.1.wedge: the sine of half the angle",)


def test_a_flat_wedge_is_a_slide() -> None:
    """A V of 180 degrees rubs as a slide does."""
    flat, plain = (with_friction(parse(SLEDGE + more, "sledge"), exact=True) for more in ("wedge = 180\n", ""))
    assert flat.balances == plain.balances == ((400, 0),)


@pytest.mark.parametrize("degrees", ["0", "-40", "181"])
def test_a_wedge_has_an_angle(degrees: str) -> None:
    """No V has an angle of nothing or beyond a straight one."""
    with pytest.raises(SceneError, match=rf"friction.1.wedge: a wedge of {degrees} degrees; an angle above 0"):
        parse(SLEDGE + f"wedge = {degrees}\n", "sledge")
