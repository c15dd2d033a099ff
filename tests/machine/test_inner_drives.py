"""Friction where drives act between two moving links: an excavator's cylinder, and a motor between boom and stick."""

from __future__ import annotations

import numpy as np
import pytest

from graphplan.check.json_results import result_data
from graphplan.check.reduction import check_reduction, friction_gap
from graphplan.check.trusted import report
from graphplan.machine.reduced.reduction import reduction
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.solver import power, with_friction

EXCAVATOR = """
gravity = [0, -9.81]
[points]
O = [0, 0]
A = [100, 50]
C = [40, -20]
B = [150, 10]
D = [90, -5]
[links]
frame = "O C"
1 = "O A D"
2 = "A B"
3 = "C"
4 = "D"
[[slides]]
link = "4"
along = "3"
at = "D"
direction = [50, 15]
[[drive]]
slide = ["4", "3"]
speed = 20
[[drive]]
link = "2"
relative_to = "1"
omega = 0.5
[masses.1]
mass = 10
inertia = 0.05
centre = "D"
[masses.2]
mass = 5
inertia = 0.02
centre = "B"
[[friction]]
at = "A"
radius = 10
coefficient = 0.1
[[friction]]
at = "O"
radius = 10
coefficient = 0.1
"""


@pytest.fixture(scope="module")
def excavator() -> Scene:
    return parse(EXCAVATOR, "excavator", by_drive=True)


def test_what_drives_do_has_its_counterpart(excavator: Scene) -> None:
    """Without friction the drives do what the power of all loads says, relative to the links that bear them."""
    found = result_data(report(excavator))["without_friction"]["balance"]
    cylinder, motor = power(excavator)
    assert found[0]["force"] == pytest.approx(cylinder, rel=1e-12)
    assert found[1]["moment"] == pytest.approx(motor, rel=1e-12)


@pytest.mark.parametrize("plan", ["", "lever", "polar,polygons"])
def test_friction_is_drawn_with_inner_drives(plan: str, excavator: Scene) -> None:
    """Whichever plan is drawn, the balances with friction are the solver's."""
    told = result_data(report(excavator, plan=plan))
    cylinder, motor = with_friction(excavator).balances
    assert told["balance"][0]["force"] == pytest.approx(cylinder, rel=1e-12)
    assert told["balance"][1]["moment"] == pytest.approx(motor, rel=1e-12)
    assert 0.9 < told["friction"]["efficiency"] < 1


def test_the_motor_bears_its_own_journal_alone(excavator: Scene) -> None:
    """The journal of the stick takes from its motor radius times coefficient times force, as the two turn."""
    told = result_data(report(excavator))
    force = next(one["force"] for one in told["reactions"] if one["at"] == "A")
    lost = told["balance"][1]["moment"] - told["without_friction"]["balance"][1]["moment"]
    assert lost == pytest.approx(0.01 * 0.1 * float(np.hypot(*force)), rel=1e-9)


def test_friction_over_the_cycle_with_inner_drives(excavator: Scene) -> None:
    """Over the travel of the cylinder the moment of friction is the solver's in every pose, and what the pairs take."""
    found = reduction(excavator, (0.0, 20.0))
    travel = np.linspace(*found.ends, 5)
    assert friction_gap(found, travel) < 1e-12
    assert max(check_reduction(found, travel).values()) < 1e-12
    assert found.friction
    rubbed = found.friction.friction_at(travel)
    assert sum(rubbed.losses.values()) == pytest.approx(rubbed.moment, rel=1e-9)
