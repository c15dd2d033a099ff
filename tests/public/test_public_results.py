"""Results in Python: numbers by name, the same that the command prints, tables that others take."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import graphplan as gp
from graphplan.commands import main

SCENE = gp.load("four-bar")
DRAWING = gp.construct(SCENE)


@pytest.mark.parametrize("results", [gp.solve(SCENE), DRAWING, DRAWING.evaluate(gp.follow(SCENE, 4))], ids=type)
def test_fixed_points_stand_still_and_others_must_be_asked_for(results: Any) -> None:
    """Of a fixed point the velocity is 0; a point that was not asked for is a KeyError that says which were."""
    assert np.all(results.velocity["O"] == 0)
    assert np.all(results.acceleration["C"] == 0)
    for name in ("Q", "a"):
        with pytest.raises(KeyError, match=f"velocity of {name} was not asked for, but of A, B, M"):
            results.velocity[name]
    with pytest.raises(KeyError, match="angular velocity of 9 was not asked for"):
        results.omega["9"]
    with pytest.raises(TypeError):
        results.velocity["A"] = 0
    assert "\n" not in repr(results)


def test_numbers_are_those_of_the_construction_and_the_solver() -> None:
    """Vectors are complex numbers; three ways agree."""
    results, solved = gp.solve(SCENE), gp.analytic.solve(SCENE)
    assert results.velocity["M"] == DRAWING.velocity["M"]
    assert results.acceleration["M"] == pytest.approx(solved.acceleration["M"])
    assert results.omega["3"] == 2.25


def test_exact_numbers_are_fractions() -> None:
    """With exact=True vectors are pairs of fractions and rates are fractions."""
    results = gp.solve(SCENE, exact=True)
    assert results.velocity["A"] == (Fraction(-1100), Fraction(200))
    assert results.omega["2"] == Fraction(results.json()["links"]["2"]["omega"])


@pytest.mark.parametrize(("name", "options", "words"), [
    ("four-bar", {}, []), ("four-bar", {"exact": True}, ["--exact"]), ("four-bar", {"bounds": True}, ["--bounds"]),
    ("jaanimets-10", {"plan": "lever", "inertia": "shifted"}, ["--plan", "lever", "--inertia", "shifted"]),
    ("alt-eight-link", {"method": "trial"}, ["--method", "trial"]),
])
def test_solve_prints_what_python_has(name: str, options: dict[str, Any], words: list[str], tmp_path: Path,
                                      capsys: pytest.CaptureFixture[str]) -> None:
    """The JSON of the command is that of the results, and saved it is the same text."""
    results = gp.solve(gp.load(name), **options)
    assert main(["solve", name, *words]) == 0
    printed = capsys.readouterr().out
    assert json.loads(printed) == results.json()
    results.save(str(tmp_path / "results.json"))
    assert (tmp_path / "results.json").read_text(encoding="utf-8") == printed


def test_forces_have_names() -> None:
    """A balance is a number, reactions are by link and joint."""
    scene = gp.load("jaanimets-10")
    results, drawing = gp.solve(scene), gp.construct(scene)
    assert results.balance == pytest.approx(drawing.balances[0])
    assert {*results.reactions} >= {"frame at O", "3 at A"}
    for name, force in results.reactions.items():
        assert force == pytest.approx(drawing.reactions[name])


def test_what_does_not_exist_is_nan_with_a_reason() -> None:
    """Where the rest can be had, a pole at infinity and what is singular are nan."""
    scene = gp.load("alt-eight-link").replace("find.poles", "all")
    poles = gp.solve(scene).poles
    assert all(isinstance(place, complex) for place in poles.values())


@pytest.mark.parametrize("wrong", [{"plan": "nonsense"}, {"papper": "A3"}, {"pencil": "nib=2"}])
def test_wrong_options_are_refused(wrong: dict[str, str]) -> None:
    """A misspelt option or value is one of graphplan's own errors."""
    with pytest.raises(gp.Refused):
        gp.solve(SCENE, **wrong)


# ---- over poses ------------------------------------------------------------------------------------------------------


def test_poses_are_in_degrees() -> None:
    """A full turn leaves its end out, a span has both; what was promised before still works."""
    poses = gp.follow(SCENE, 360)
    assert poses.travel.tolist() == list(range(360))
    assert gp.follow(SCENE, 3, (0, 90)).travel.tolist() == [0, 45, 90]
    assert np.array_equal(gp.cycle.follow(SCENE, 4, (0, 360)).points["M"][:1], poses.points["M"][:1])
    with pytest.raises(ValueError, match="read-only"):
        poses.points["M"][0] = 0


@pytest.mark.parametrize("compiled", [False, True])
def test_the_steps_are_replayed_over_poses(compiled: bool) -> None:
    """Each pose gives what the construction of that pose gives."""
    if compiled:
        pytest.importorskip("llvmlite")
    poses = gp.follow(SCENE, 12)
    motion = DRAWING.evaluate(poses, compiled=compiled)
    assert motion.velocity["M"].shape == (12,)
    assert motion.velocity["M"][1] == pytest.approx(gp.construct(gp.at(SCENE, 30)).velocity["M"])
    assert not motion.faults
    assert np.array_equal(DRAWING.evaluate(points=dict(poses.points)).velocity["M"], motion.velocity["M"])
    assert np.array_equal(DRAWING.evaluate(gp.cycle.follow(SCENE, 12).points).velocity["M"], motion.velocity["M"])


def test_poses_that_are_not_reached_say_why() -> None:
    """They are nan in points and results, and their faults are told once."""
    scene = gp.load("plough-lift")
    poses = gp.follow(scene, 12, (0, 2000))
    motion = gp.construct(scene).evaluate(poses)
    lost = sorted(poses.faults)
    assert lost
    assert {*lost} <= motion.faults.keys()
    name = next(iter(motion.velocity))
    assert np.isnan(motion.velocity[name][lost]).all()


def test_a_table_has_columns() -> None:
    """Columns of equal length by name, of one point, one link, or of all that was asked for."""
    motion = DRAWING.evaluate(gp.follow(SCENE, 5))
    assert [*motion.table("M", "2")] == ["travel", "M.x", "M.y", "M.vx", "M.vy", "M.ax", "M.ay", "2.omega", "2.alpha"]
    assert {len(column) for column in motion.table().values()} == {5}
    assert np.array_equal(motion.table("M")["M.vy"], motion.velocity["M"].imag)
    with pytest.raises(KeyError, match="nothing of Q was asked for"):
        motion.table("Q")


def test_omega_is_asked_for_without_alpha() -> None:
    """`[find] omega` needs no plan of accelerations; what was not asked for is a KeyError."""
    scene = gp.load("four-bar").replace("find", {"omega": ["3"]})
    results = gp.solve(scene, exact=True)
    assert results.omega["3"] == Fraction(9, 4)
    assert "acceleration" not in results.check
    assert results.json()["links"] == {"3": {"omega": "9/4"}}
    with pytest.raises(KeyError):
        results.alpha["3"]
