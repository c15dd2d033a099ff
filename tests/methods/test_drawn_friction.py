"""Friction on the drawing board: one more round of force plans, and the efficiency that comes of it."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from random_loads import loaded
from random_mechanisms import mechanism

from graphplan.check.printed import data
from graphplan.check.report import report
from graphplan.errors import ConstructionError, SingularPose
from graphplan.mechanism.bracing import bracing
from graphplan.mechanism.model import Friction, Scene, TurningDrive
from graphplan.mechanism.scene import load
from graphplan.mechanism.units import metre
from graphplan.solver import Reactions, reactions, with_friction


def rough(scene: Scene, coefficient: Fraction) -> Scene:
    """The scene with friction in every journal and slide."""
    assert scene.loads is not None
    journals = [Friction(point, None, Fraction(2), coefficient) for point in scene.joints]
    slides = [Friction("", (slide.link, slide.along), Fraction(0), coefficient) for slide in scene.slides]
    return replace(scene, loads=replace(scene.loads, frictions=(*journals, *slides)))


def power_sum(scene: Scene, ideal: Reactions) -> float:
    """The power that friction takes from the reactions of the frictionless mechanism, in force * length/s."""
    assert scene.loads is not None
    rates, lost = ideal.rates, 0.0
    turning = {**rates.omega, "frame": 0.0}
    for friction in scene.loads.frictions:
        if friction.at:
            pin = scene.links_of[friction.at][0]
            for link in scene.links_of[friction.at][1:]:
                size = math.hypot(*ideal.joints[friction.at, link])
                lost += float(friction.radius * friction.coefficient) * size * abs(turning[link] - turning[pin])
        else:
            slide = next(s for s in scene.slides if (s.link, s.along) == friction.slide)
            slip = math.hypot(*rates.slide_velocity[slide.name])
            lost += float(friction.coefficient) * math.hypot(*ideal.slides[slide.name][0]) * slip
    return lost


@pytest.mark.parametrize("groups", [["rrr"], ["rrp"], ["rpr"], ["triad"], ["rrr", "rrp"], ["class_four"]])
def test_one_round_costs_what_the_reactions_rub(groups: list[str]) -> None:
    """The balance of the second plan pays for the sum of reaction, friction radius or coefficient, and sliding."""
    tried = 0
    for seed in range(8):
        scene = mechanism(groups, seed)
        if not bracing(scene).sound:
            continue
        scene = rough(loaded(scene, seed), Fraction(1, 100))
        try:
            found, ideal = report(scene), reactions(scene)
        except (SingularPose, ConstructionError):
            continue
        drawn = found.results["balance moment with friction"]["1"] - found.results["balance moment"]["1"]
        omega = float(ideal.rates.omega[scene.drives[0].link])
        paid = float(drawn) * float(metre(scene.units)) * omega
        assert paid == pytest.approx(power_sum(scene, ideal), rel=1e-9)
        tried += 1
    assert tried > 3


@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_kinytskyi(plan: str) -> None:
    """The lambda mechanism: Kinytskyi's power sum in one round; further rounds change a third of a percent."""
    found = report(load("kinytskyi"), plan=plan)
    told = data(found)["friction"]
    assert found.results["balance moment with friction"]["1"] == pytest.approx(6.4012417, rel=1e-7)
    assert told["efficiency"] == pytest.approx(0.8950101, rel=1e-6)
    assert told["stands"]["efficiency"] == pytest.approx(0.8926637, rel=1e-6)
    assert told["efficiency"] == pytest.approx(told["stands"]["efficiency"], rel=1 / 300)


def test_less_friction_less_difference() -> None:
    """The one round that is drawn comes as near to the standing solution as the square of the friction is small."""
    scene = load("kinytskyi")
    assert scene.loads is not None
    gaps = []
    for part in (Fraction(1), Fraction(1, 10), Fraction(1, 100)):
        frictions = tuple(replace(f, coefficient=f.coefficient * part) for f in scene.loads.frictions)
        smoother = replace(scene, loads=replace(scene.loads, frictions=frictions))
        stands = with_friction(smoother).balances[0]
        assert not isinstance(stands, tuple)
        gaps.append(abs(float(report(smoother).results["balance moment with friction"]["1"]) - float(stands)))
    assert gaps[1] == pytest.approx(gaps[0] / 100, rel=0.2)
    assert gaps[2] == pytest.approx(gaps[0] / 10000, rel=0.2)


def test_at_rest_there_is_no_friction() -> None:
    """At rest friction has no sense, and nothing is drawn of it."""
    scene = load("kinytskyi")
    drive = scene.drives[0]
    assert isinstance(drive, TurningDrive)
    assert "friction" not in data(report(replace(scene, drives=(replace(drive, omega=Fraction(0)),))))


def test_exact_leaves_friction_out() -> None:
    """Exact numbers leave friction out, as the size of a reaction is a root."""
    scene = rough(load("jaanimets-11"), Fraction(1, 10))
    assert "friction" in data(report(scene))
    assert "friction" not in data(report(scene, exact=True))
