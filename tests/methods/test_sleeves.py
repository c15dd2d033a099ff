"""Slides that bear on a length: pressed at both edges they rub more, and jam; solved, drawn and by the powers."""

from __future__ import annotations

import math
from random import Random

import pytest

import graphplan as gp
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import Refused
from graphplan.mechanism.scene import parse
from graphplan.solver import with_friction
from graphplan.solver.friction import delivered_power, edge_couples

SLEEVE = """[points]
P = [0, 0]
R = [0, 200]
Q = [{arm}, 30]
[links]
1 = "P Q"
frame = "R"
[[slides]]
link = "1"
along = "frame"
at = "P"
direction = [0, 2]
[[drive]]
slide = ["1", "frame"]
speed = {speed}
[[forces]]
on = "1"
at = "P"
value = [{across}, -600]
[balance]
on = "1"
at = "Q"
direction = [0, 1]
[[friction]]
slide = ["1", "frame"]
coefficient = 0.1
length = 40
"""


@pytest.mark.parametrize("exact", [False, True])
@pytest.mark.parametrize(("arm", "speed", "force"), [(100, 7, 1200), (-100, 7, 1200), (100, -7, 400)])
def test_a_sleeve_off_its_column(arm: int, speed: int, force: int, exact: bool) -> None:
    """Lifted 100 off a column, 40 long with f = 0.1, half of the force is lost; let down it holds back less."""
    scene = parse(SLEEVE.format(arm=arm, speed=speed, across=0), "sleeve")
    data = result_data(report(scene, exact=exact))
    assert [float(component) for component in data["balance"]["force"]] == [0, pytest.approx(force)]
    assert data["friction"]["edges"] == {"1 along frame": 200}
    assert data["friction"]["rounds"] == 1


@pytest.mark.parametrize(("arm", "locks"), [(199, False), (201, True)])
def test_it_jams_beyond_l_over_2_f(arm: int, locks: bool) -> None:
    """At 200 = l / 2f from the column no force lifts it (Ozols 1974, (12.18))."""
    forces = report(parse(SLEEVE.format(arm=arm, speed=7, across=0), "sleeve")).forces
    assert forces is not None
    assert forces.locks.startswith("self-locking") == locks


def test_between_its_edges_it_is_a_slide() -> None:
    """Pressed on one side alone it rubs as one without length."""
    text = SLEEVE.format(arm=1, speed=7, across=500)
    data = [result_data(report(parse(scene, "sleeve"))) for scene in (text, text.replace("length = 40\n", ""))]
    assert data[0]["balance"] == data[1]["balance"]
    assert data[0]["balance"]["force"] == pytest.approx([0, 650])
    assert "edges" not in data[0]["friction"]


@pytest.mark.parametrize("seed", range(19))
def test_what_the_edges_take_the_balance_gives(seed: int) -> None:
    """In a crank-slider with a load beside the slider, drawn as solved: friction is f times the sum of the edges'
    forces, and its power what the balance gives more."""
    r = Random(seed)
    angle, f, length = r.uniform(0.3, 2.8), 0.1, r.randint(30, 60)
    A = 40 * math.cos(angle), 40 * math.sin(angle)
    x = A[0] + math.sqrt(110**2 - A[1] ** 2)
    scene = parse(f"""[points]
O = [0, 0]
A = [{A[0]!r}, {A[1]!r}]
B = [{x!r}, 0]
L = [{x + 20!r}, {r.choice((-60, 10, 80))}]
[links]
1 = "O A"
2 = "A B"
3 = "B L"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [3, 0]
[[forces]]
on = "3"
at = "L"
value = [{r.randint(-300, 300)}, {r.randint(-80, 80)}]
[[drive]]
link = "1"
omega = {r.choice((-5, 3))}
[balance]
link = "1"
[[friction]]
slide = ["3", "frame"]
coefficient = {f}
length = {length}
[[friction]]
at = "A"
radius = 4
coefficient = 0.1
""", f"press {seed}")
    answer = report(scene)
    assert answer.forces is not None
    assert not answer.forces.locks
    rubbed = with_friction(scene)
    force, moment = rubbed.slides["3 along frame"]
    normal = abs(force[1])
    edges = max(normal, 2 * abs(moment) * 1000 / length)
    assert (edges > normal) == bool(edge_couples(rubbed))
    assert abs(rubbed.drags["3 along frame"][0]) == pytest.approx(f * edges)
    speed = abs(rubbed.rates.slide_velocity["3 along frame"][0])
    turning = abs(rubbed.rates.omega["2"] - rubbed.rates.omega["1"])
    lost = f * edges * speed + 0.4 * math.hypot(*rubbed.joints["A", "2"]) * turning
    useful = sum(p * v for p, v in zip(scene.loads.forces[0].value, rubbed.rates.velocity["L"], strict=True))  # type: ignore[union-attr]
    assert float(delivered_power(rubbed)) == pytest.approx(lost - float(useful), rel=1e-9)


@pytest.mark.parametrize(("arm", "across"), [(100, 0), (1, 500)], ids=["both edges", "one side"])
def test_over_other_poses_it_is_refused(arm: int, across: int) -> None:
    """Which edges press changes with the pose, whether both do in the given one or not: a live page says so."""
    with pytest.raises(Refused, match="in one pose alone"):
        gp.live(parse(SLEEVE.format(arm=arm, speed=7, across=across), "sleeve"), "never.html")
