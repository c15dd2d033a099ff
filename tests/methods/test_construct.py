"""Constructions: what is drawn, what is not, and what is refused."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from four_bars import SMALL as FOUR_BAR
from random_mechanisms import GROUPS, mechanism

import graphplan as gp
from graphplan.check.trusted import Bench, report
from graphplan.errors import Refused, SceneError
from graphplan.mechanism.model import Find, Scene
from graphplan.mechanism.structure import structure
from graphplan.methods.construct import construct
from graphplan.methods.motion import acceleration, velocity
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.time_scale import Tempo


def asked(scene: Scene, velocity: str = "", acceleration: str = "") -> Scene:
    """The scene with another question."""
    return replace(scene, find=Find(tuple(velocity.split()), tuple(acceleration.split())))


def test_the_velocity_of_one_point_draws_no_more_than_it_needs() -> None:
    """Asked for v_C of the basic case: no N-plan, and nothing of A, B, D, E but their lines' directions."""
    drawing = gp.construct(asked(gp.load("rosenauer-basic"), "C"))
    assert {step.panel for step in drawing.drawn.steps} == {"mechanism"}
    assert not {"v_a", "v_b", "v_d", "v_e"} & {step.name for step in drawing.drawn.steps}
    assert set(drawing.velocity) == {"C"}


def test_a_crank_point_needs_no_other_link() -> None:
    """Asked for a point of the crank, nothing of the coupler and rocker is drawn."""
    scene = gp.parse(FOUR_BAR, "four-bar")
    drawing = gp.construct(asked(scene, "A", "A"))
    assert {step.name for step in drawing.drawn.steps if step.op.name == "given"} == {"O", "A"}


def test_results_are_true_vectors_in_scene_units() -> None:
    """Velocities and accelerations are complex numbers, not turned and not scaled."""
    drawing = gp.construct(gp.parse(FOUR_BAR, "four-bar"))
    assert drawing.velocity["A"] == 2j * (20 + 10j)
    assert drawing.acceleration["A"] == pytest.approx((3j - 4) * (20 + 10j))


def test_arrays_give_what_single_poses_give() -> None:
    """Replayed over n poses the program gives, pose by pose, what it gives for one."""
    scene = gp.parse(FOUR_BAR, "four-bar")
    drawing = gp.construct(scene)
    places = np.array([70 + 40j, 60 + 45j, 75 + 38j])
    poses = drawing.evaluate(points={"B": places})
    for k, place in enumerate(places):
        moved = {**scene.points, "B": (float(place.real), float(place.imag))}
        single = gp.construct(replace(scene, points=moved))
        assert poses.velocity["B"][k] == single.velocity["B"]
        assert poses.acceleration["B"][k] == single.acceleration["B"]


def test_singular_poses_in_an_array_are_nan_and_say_why() -> None:
    """A dead centre among the poses gives nan there and nowhere else, with the reason."""
    drawing = gp.construct(gp.parse(FOUR_BAR, "four-bar"))
    poses = drawing.evaluate(points={"B": np.array([70 + 40j, 50 + 5j]), "C": np.array([80 + 0j, 80 + 0j])})
    assert np.isfinite(poses.velocity["B"][0])
    assert np.isnan(poses.velocity["B"][1])
    assert "parallel" in poses.faults[1]


def test_coincident_points_move_together() -> None:
    """A guide's point named apart moves the pair's one mark; two names for one place that differ are refused."""
    drawing = gp.construct(gp.load("slotted-link"))
    pin = np.array([-120 + 180j, -110 + 190j])
    by_one, by_both = (drawing.evaluate(points=dict.fromkeys(names, pin)) for names in (["A3"], ["A", "A3"]))
    assert np.array_equal(by_one.velocity["B"], by_both.velocity["B"])
    assert by_one.velocity["B"][0] != by_one.velocity["B"][1]
    with pytest.raises(Refused, match="coincide"):
        drawing.evaluate(points={"A": pin, "A3": pin + 1})


def test_points_that_the_scene_lacks_are_refused() -> None:
    """Evaluating with an unknown point says so."""
    with pytest.raises(Refused, match="no such point"):
        gp.construct(gp.parse(FOUR_BAR, "four-bar")).evaluate(points={"Z": [0j]})


def test_unknown_methods_and_plans_are_refused() -> None:
    """A method or plan that does not exist is refused with those that do."""
    scene = gp.parse(FOUR_BAR, "four-bar")
    with pytest.raises(Refused, match="auxiliary, trial, poles"):
        gp.construct(scene, method="magic")
    with pytest.raises(Refused, match="orthogonal, polar"):
        gp.construct(scene, plan="square")


def test_solving_imports_no_drawing_package() -> None:
    """`graphplan solve` on one scene does not import matplotlib."""
    code = ("import sys; from graphplan.commands import main; main(['solve', '-']); "
            "print([m for m in ('matplotlib',) if m in sys.modules], file=sys.stderr)")
    done = subprocess.run([sys.executable, "-c", code], input=FOUR_BAR, capture_output=True, text=True, check=True)
    assert done.stderr.strip() == "[]"


def test_exact_numbers_of_an_irrational_scene_are_refused() -> None:
    """Fractions are refused where the scene itself is irrational, with the place."""
    scene = gp.parse(FOUR_BAR.replace("omega = 2.0", "rpm = 95"), "four-bar")
    with pytest.raises(Refused, match="rpm"):
        report(scene, exact=True)


# A fault seeded in the planner or in a plan: what is replaced, by what. Each must show in the numbers or in a refusal.
FAULTS = {
    "turning of a slide's partner is not heard": (Planner, "_like", lambda self, body: ""),
    "the guide is drawn the wrong way": (velocity.Orthogonal, "across", False),
    "figures are drawn with the wrong turn": (acceleration.Normal, "turn", "parallel"),
    "no semicircle: normal accelerations are left out": (
        acceleration.Normal, "_figure_side", lambda self, link, K, X: self.figure(link, K)),
    "no Coriolis vector": (acceleration.Normal, "_less_coriolis",
                           lambda self, slide, known, new, B: self.figure(known, B)),
    "relative poles without their shift": (acceleration.Normal, "pole_shift", lambda self, move: None),
    "shifts between home and figure left out": (
        MotionPlan, "shift_by", lambda self, mark, one, two: two if mark is one else mark),
    "drives turn the wrong way": (Tempo, "rate", lambda self, omega: -omega / self.unit),
}


def verdicts() -> Iterator[str]:
    """Each group in some poses: ok, or what is wrong with it."""
    for group in sorted(GROUPS):
        for seed in range(4):
            scene = mechanism([group] if group == "class_four" else [group, "rpr"], seed)
            try:
                structure(scene)
                first = construct(scene, method="poles")  # the way before any other is taken
                yield "ok" if Bench(scene, {"method": "poles"}, exact=True).judge(first).agrees else "wrong"
            except (SceneError, gp.SingularPose):
                continue
            except Exception as error:  # a fault may show as any refusal or failure
                yield type(error).__name__


def test_without_a_fault_nothing_is_found() -> None:
    """The scenes that the seeded faults are tried on are all constructed exactly."""
    assert set(verdicts()) == {"ok"}


@pytest.mark.parametrize("fault", sorted(FAULTS))
def test_seeded_faults_are_caught(fault: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fault in the planner or in a plan shows in the comparison with the solver."""
    owner, name, value = FAULTS[fault]
    monkeypatch.setattr(owner, name, value)
    assert any(verdict != "ok" for verdict in verdicts())


def test_fractions_stay_fractions() -> None:
    """Exact results are fractions, not floats in disguise."""
    found = report(gp.parse(FOUR_BAR, "four-bar"), exact=True)
    assert all(isinstance(n, Fraction | int) for pair in found.results["velocity"].values() for n in pair)
