"""Friction on the drawing board: rounds of force plans that stand, and the efficiency that comes of them."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from random_loads import loaded
from random_mechanisms import mechanism

from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import ConstructionError, SingularPose
from graphplan.mechanism.model import Friction, Scene, TurningDrive
from graphplan.mechanism.scene import load, parse
from graphplan.mechanism.structure import bracing
from graphplan.mechanism.units import metre
from graphplan.solver import Frictional, with_friction


def rough(scene: Scene, coefficient: Fraction) -> Scene:
    """The scene with friction in every journal and slide."""
    assert scene.loads is not None
    journals = [Friction(point, None, Fraction(2), coefficient) for point in scene.joints]
    slides = [Friction("", (slide.link, slide.along), Fraction(0), coefficient) for slide in scene.slides]
    return replace(scene, loads=replace(scene.loads, frictions=(*journals, *slides)))


def rounds(scene: Scene, number: int) -> Scene:
    """The scene with so many rounds of friction asked for."""
    assert scene.loads is not None
    return replace(scene, loads=replace(scene.loads, rounds=number))


def power_sum(scene: Scene, found: Frictional) -> float:
    """The power that friction takes, from the forces and their coefficients, in force * length/s."""
    assert scene.loads is not None
    rates, lost = found.rates, 0.0
    turning = {**rates.omega, "frame": 0.0}
    for friction in scene.loads.frictions:
        if friction.at:
            pin = scene.links_of[friction.at][0]
            for link in scene.links_of[friction.at][1:]:
                size = math.hypot(*found.joints[friction.at, link])
                lost += float(friction.radius * friction.coefficient) * size * abs(turning[link] - turning[pin])
        else:
            slide = next(s for s in scene.slides if (s.link, s.along) == friction.slide)
            slip = math.hypot(*rates.slide_velocity[slide.name])
            lost += math.hypot(*found.drags[slide.name]) * slip
    return lost


@pytest.mark.parametrize("groups", [["rrr"], ["rrp"], ["rpr"], ["triad"], ["rrr", "rrp"], ["class_four"]])
def test_the_balance_pays_for_what_is_rubbed(groups: list[str]) -> None:
    """The drawn balance exceeds that without friction by the sum of force, radius or coefficient, and sliding."""
    tried = 0
    for seed in range(3):
        scene = mechanism(groups, seed)
        if not bracing(scene).sound:
            continue
        scene = rough(loaded(scene, seed), Fraction(1, 100))
        try:
            found, standing = report(scene), with_friction(scene)
        except (SingularPose, ConstructionError):
            continue
        drawn = found.results["balance moment with friction"]["1"] - found.results["balance moment"]["1"]
        omega = float(standing.rates.omega[scene.drives[0].link])
        paid = float(drawn) * float(metre(scene.units)) * omega
        assert paid == pytest.approx(power_sum(scene, standing), rel=1e-7)
        tried += 1
    assert tried > 0


@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_kinytskyi(plan: str) -> None:
    """The lambda mechanism: two rounds stand; Kinytskyi's power sum of the first forces is a third of a percent off."""
    found = report(load("kinytskyi"), plan=plan)
    printed = result_data(found)
    told = printed["friction"]
    assert told["rounds"] == 2
    assert "friction: the forces no longer change after round 2" in found.drawing.forms
    drawn, stands = printed["balance"]["moment"], told["stands"]["balance"][0]["moment"]
    assert drawn == pytest.approx(stands, rel=1e-12)
    assert drawn == pytest.approx(6.4180678727, rel=1e-10)
    assert printed["without_friction"]["balance"]["moment"] == pytest.approx(5.7291762403, rel=1e-10)
    assert told["efficiency"] == pytest.approx(0.8926637, rel=1e-6)
    assert told["efficiency"] == pytest.approx(0.8950101, rel=1 / 300)


def test_each_round_squares_the_error() -> None:
    """As many rounds are drawn as are asked for; each is nearer to the standing forces by far, and says its number."""
    scene = load("kinytskyi")
    stands, gaps = with_friction(scene).balances[0], []
    assert not isinstance(stands, tuple)
    for number in (1, 2, 3):
        found = report(rounds(scene, number))
        gaps.append(abs(found.results["balance moment with friction"]["1"] / float(stands) - 1))
        assert found.drawing.rounds == result_data(found)["friction"]["rounds"] == number
        assert f"friction: rounds drawn, as asked: {number}" in found.drawing.forms
        assert found.agrees
    assert 1e-7 < gaps[0] < 1e-5
    assert max(gaps[1:]) < 1e-12


def test_one_round_is_true_where_slides_rub() -> None:
    """Where only slides rub the drawn balance is the true one as a fraction, in as many rounds as senses change."""
    counts = []
    for groups in (["rrp"], ["rpr"], ["rpp"], ["prp"], ["rrp", "rpr"]):
        for seed in range(5):
            scene = mechanism(groups, seed)
            if not bracing(scene).sound:
                continue
            scene = rough(loaded(scene, seed), Fraction(1, 10))
            assert scene.loads is not None
            slides = tuple(friction for friction in scene.loads.frictions if friction.slide)
            scene = replace(scene, loads=replace(scene.loads, frictions=slides))
            try:
                found, true = report(scene, exact=True), with_friction(scene, exact=True)
            except SingularPose:
                continue
            assert found.results["balance moment with friction"]["1"] == true.balances[0]
            assert found.check["force"] == 0
            counts.append(found.drawing.rounds)
    assert len(counts) > 5
    assert counts.count(1) > 0.5 * len(counts)


ROTORS = """title = "rotors"
gravity = [0, -9.81]
[points]
P0 = [80, -25]
X1 = [-12, 22]
X2 = [-52, -72]
[links]
1 = "P0 X1"
2 = "P0 X2"
frame = "P0"
[[drive]]
link = "1"
omega = -3
[[drive]]
link = "2"
omega = 1
alpha = 1
[masses.1]
mass = 0
inertia = 2
centre = "P0"
[masses.2]
mass = 0
inertia = 2
centre = "P0"
[[moments]]
on = "1"
value = -13
[[balance]]
link = "1"
[[balance]]
link = "2"
[[friction]]
at = "P0"
radius = 2
coefficient = 0.057
"""


def test_a_bearing_without_force_has_no_friction() -> None:
    """Rotors whose bearings bear nothing are not self-locking: no force has no direction, and rubs nothing."""
    told = result_data(report(parse(ROTORS, "rotors")))
    for found in told, told["friction"]["stands"], told["without_friction"]:
        assert [balance["moment"] for balance in found["balance"]] == pytest.approx([13.0, 2.0], rel=1e-15)


def test_at_rest_there_is_no_friction() -> None:
    """At rest friction has no sense, and nothing is drawn of it."""
    scene = load("kinytskyi")
    drive = scene.drives[0]
    assert isinstance(drive, TurningDrive)
    assert "friction" not in result_data(report(scene.with_drives([replace(drive, rate=Fraction(0))])))


def test_exact_numbers_have_no_friction_of_journals() -> None:
    """The size of a reaction is a root: where journals rub exact numbers are those without friction, and it is said."""
    scene = rough(load("jaanimets-11"), Fraction(1, 10))
    assert "friction" in result_data(report(scene))
    found = report(scene, exact=True)
    told = result_data(found)
    assert told["balance"]["moment"] is None
    assert "root" in told["reasons"]["balance"]["1"]
    assert told["without_friction"]["balance"]["moment"] == str(found.results["balance moment"]["1"])
