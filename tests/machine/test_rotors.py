"""Rotors: two correction planes by polygons, trial runs, and what is refused."""

from __future__ import annotations

import cmath
import json
import math
import random
from pathlib import Path

import numpy as np
import pytest

from graphplan.check.rotors import bearing_reactions, check_rotor, equilibrium
from graphplan.commands import main
from graphplan.errors import Refused, SceneError
from graphplan.machine.rotors.polygons import UnbalanceState
from graphplan.machine.rotors.rotor import parse
from graphplan.machine.rotors.rotor_balance import BalancedRotor, balance_rotor

THREE = """
[rotor]
planes = [0, 600]
masses = [
  { mass = 0.5, radius = 100, angle = 0, at = 200 },
  { mass = 0.8, radius = 80, angle = 120, at = -100 },
  { mass = 0.3, radius = 150, angle = 250, at = 500 },
]
"""
ONE = "[rotor]\nplanes = [0]\n[trial]\n"


def found(text: str) -> BalancedRotor:
    """A rotor, balanced, all its opinions compared."""
    rotor = balance_rotor(parse(text, "rotor.toml"))
    check_rotor(rotor)
    return rotor


def masses(*rows: str, planes: str = "[0, 5]") -> str:
    """A task with these masses."""
    return f"[rotor]\nplanes = {planes}\nmasses = [{', '.join(f'{{ {row} }}' for row in rows)}]\n"


def vectors(rotor: BalancedRotor) -> list[complex]:
    """The corrections as vectors."""
    return [cmath.rect(one.mass_radius, math.radians(one.angle)) for one in rotor.corrections]


def test_numbers_of_three_masses(tmp_path: Path) -> None:
    """The rotor of three masses has the corrections and disbalances that vector algebra gives, in kg m; and no rest."""
    task, file = tmp_path / "rotor.toml", tmp_path / "rotor.json"
    task.write_text(THREE)
    assert main(["balance", str(task), "-q", "-o", str(file)]) == 0
    numbers = json.loads(file.read_text())
    first, second = numbers["corrections"]
    assert (first["plane"], second["plane"]) == (0, 600)
    assert [first["mass_radius"], first["angle"]] == pytest.approx([0.0579884, 276.501], rel=2e-6)
    assert [second["mass_radius"], second["angle"]] == pytest.approx([0.0454124, 101.655], rel=2e-6)
    assert numbers["static_unbalance"] == pytest.approx(0.0133960, rel=3e-6)
    assert numbers["moment"] == pytest.approx(0.0272475, rel=3e-6)
    assert max(numbers["check"].values()) < 1e-14
    errors = [one["drawn_error"] for one in numbers["corrections"]]  # radii are some 30 mm long, edges 0.1 mm off
    assert all(0 < error["mass_radius"] < 0.02 * first["mass_radius"] for error in errors)
    assert all(0 < error["angle"] < 1.5 for error in errors)
    told = [step["sentence"] for step in numbers["steps"]]
    assert any("draw line 6 parallel to OP_2" in sentence for sentence in told)
    assert any("left of plane I" in sentence and "6400 kg·mm² : 250 = 25.6 mm" in sentence for sentence in told)


@pytest.mark.parametrize(("text", "state", "corrections"), [
    (masses("mass = 1, radius = 2, angle = 0, at = 1", "mass = 1, radius = 2, angle = 180, at = 3"),
     UnbalanceState.DYNAMIC,
     [-0.8, 0.8]),
    (masses("mass = 1, radius = 2, angle = 90, at = 0"), UnbalanceState.STATIC, [-2j, 0]),
    (masses("mass = 1, radius = 2, angle = 90, at = 5"), UnbalanceState.STATIC, [0, -2j]),
    (masses("mass = 1, x = 3, y = 4, at = 10", "mass = 2, x = -3, y = -4, at = 5"), UnbalanceState.STATIC, [3 + 4j, 0]),
    (masses(*(f"mass = 1, radius = 2, angle = {angle}, at = 3" for angle in (10, 130, 250))),
     UnbalanceState.BALANCED, [0, 0]),
    (masses("mass = 0, radius = 2, angle = 90, at = 0", "mass = 3, radius = 0, angle = 0, at = 9"),
     UnbalanceState.BALANCED,
     [0, 0]),
    (masses("mass = 1, x = 3, y = 4, at = 2", planes="[0]"), UnbalanceState.STATIC, [-3 - 4j]),
    (masses("mass = 1, x = 3, y = 4", planes="[7]"), UnbalanceState.STATIC, [-3 - 4j]),
    (masses("mass_radius = 3, angle = 0, at = 0", "mass_radius = 5, angle = 0, at = 0.6", planes="[0.05, 0.45]"),
     UnbalanceState.STATIC, [-1.5, -6.5]),
])  # fmt: skip
def test_special_rotors(text: str, state: UnbalanceState, corrections: list[complex]) -> None:
    """Rotors out of balance in force or in moment alone, in one plane, by transfer to others, or not at all."""
    rotor = found(text)
    assert rotor.sums.state is state
    assert vectors(rotor) == pytest.approx(corrections, abs=1e-13)
    assert [one.mass_radius == 0 for one in rotor.corrections] == [not one for one in corrections]
    assert all(0 <= one.angle < 360 for one in rotor.corrections)


def test_random_rotors_are_left_without_force_and_moment() -> None:
    """Of any rotor the polygons' corrections leave nothing, in whatever order and distance its planes stand."""
    dice = random.Random(3)
    for _ in range(200):
        rows = [f"mass = {dice.uniform(0, 3)}, radius = {dice.uniform(0, 300)}, angle = {dice.uniform(-720, 720)}, "
                f"at = {dice.uniform(-500, 900)}" for _ in range(dice.randint(1, 9))]
        rotor = found(masses(*rows, planes=f"[{dice.uniform(-300, 100)}, {dice.uniform(101, 800)}]"))
        parts = [*rotor.masses, *rotor.corrections]
        forces = np.array([*(complex(*map(float, one.unbalance)) for one in rotor.masses), *vectors(rotor)])
        places = np.array([float(one.at or 0) for one in parts])
        assert abs(forces.sum()) <= 1e-12 * abs(forces).sum()
        assert abs(places @ forces) <= 1e-12 * abs(places) @ abs(forces)


@pytest.mark.parametrize("fourth", [None, 20.0, 100.0, 290.0])
def test_three_runs(fourth: float | None) -> None:
    """Amplitudes alone give the effect of the trial mass and an angle on either side; a fourth run says on which."""
    own, trial = cmath.rect(3, 0.7), cmath.rect(2, 1.9)
    amplitudes = [abs(own), abs(own + trial), abs(own - trial)]
    text = f"{ONE}amplitudes = {amplitudes}\nmass = 0.1\nradius = 40\nangle = 15\n"
    if fourth is None:
        rotor = found(text)
        first, second = (answer[0] for answer in rotor.answers)
        assert rotor.effects[0].amplitude == pytest.approx(2, abs=1e-12)
        assert [first.angle, second.angle] == pytest.approx([15 + 111.245, 375 - 111.245], abs=2e-4)
        assert first.mass_radius == pytest.approx(4 * 3 / 2)
        return
    for side in (1, -1):
        turn = side * 1.9416  # from the trial mass to the correction
        measured = abs(2 * cmath.rect(1, math.radians(fourth - 15)) - 3 * cmath.rect(1, turn))
        rotor = found(f"{text}fourth = {{ angle = {fourth}, amplitude = {measured} }}\n")
        assert len(rotor.answers) == 1
        assert rotor.corrections[0].angle == pytest.approx((15 + math.degrees(turn)) % 360, abs=0.01)


def test_two_runs_with_marks_find_the_unbalance() -> None:
    """The correction by vectors of two runs leaves nothing of the vibration, at any gain and phase of the machine."""
    dice = random.Random(5)
    for _ in range(20):
        unbalance, gain = (cmath.rect(dice.uniform(1, 5), dice.uniform(0, 7)) for _ in range(2))
        first, second = gain * unbalance, gain * (unbalance + cmath.rect(2, math.radians(40)))
        rows = [f"{{ amplitude = {abs(one)}, angle = {math.degrees(cmath.phase(one))} }}" for one in (first, second)]
        rotor = found(f"{ONE}mass_radius = 2\nangle = 40\nfirst = {rows[0]}\nwith_trial = {rows[1]}\n")
        assert vectors(rotor) == pytest.approx([-unbalance], abs=1e-12)


def test_trial_weights_run_as_a_cosine() -> None:
    """Half the difference of the extreme weights that overcome friction and unbalance is put at the largest."""
    angles = [20 + 45 * k for k in range(8)]
    weights = [60 + 14 * math.cos(math.radians(angle - 75)) for angle in angles]
    rotor = found(f"{ONE}radius = 150\nangle = 20\nweights = {weights}\n")
    assert vectors(rotor) == pytest.approx([cmath.rect(150 * 14, math.radians(75))], rel=1e-12)
    assert found(f"{ONE}radius = 150\nweights = [4, 4, 4, 4]\n").sums.state is UnbalanceState.BALANCED


def test_trials_in_other_planes_are_carried_over() -> None:
    """Trial masses beside the correction planes: what they find is balanced in the planes, for each of the answers."""
    trials = "".join(f"[[trial]]\namplitudes = {row}\nmass_radius = 2\nat = {at}\n"
                     for row, at in (([3, 4.1, 3.5], 50), ([2, 2.5, 2.6], 450)))
    rotor = found(f"[rotor]\nplanes = [0, 600]\n{trials}")
    assert len({tuple(one.angle for one in answer) for answer in rotor.answers}) == 4
    for unbalances, answer in zip(rotor.unbalances, rotor.answers, strict=True):
        assert [cmath.rect(one.mass_radius, math.radians(one.angle)) for one in answer] == pytest.approx(
            equilibrium(rotor.task.rotor, unbalances))


def test_bearings_bear_nothing_of_a_balanced_rotor() -> None:
    """The turning reactions before are those of a beam's statics; after balancing they are gone."""
    rotor = found(masses("mass = 2, radius = 50, angle = 90, at = 100", planes="[0, 400]")
                  + "bearings = [-100, 500]\nomega = 100\n")
    assert bearing_reactions(rotor) == pytest.approx([2 * 0.05 * 1e4 * 400 / 600 * 1j, 2 * 0.05 * 1e4 * 200 / 600 * 1j])
    assert max(map(abs, bearing_reactions(rotor, rotor.corrections))) < 1e-9


def test_sheets_show_the_views_and_what_balances(tmp_path: Path) -> None:
    """A sheet has its views and polygons, or the plans of trials, each drawn step a group, whatever is asked of it."""
    task, file = tmp_path / "rotor.toml", tmp_path / "rotor.svg"
    weights = f"{ONE}radius = 150\nweights = [40, 46, 55, 58, 56, 48, 41, 38]\n"
    for text, panels in ((THREE, ("side view", "end view", "moment polygon", "force polygon")),
                         (f"{ONE}amplitudes = [3, 4, 3.5]\nmass_radius = 1\n", ("side view", "end view", "trial I")),
                         (weights, ("side view", "end view", "trial I", "trial weights")),
                         (masses("mass = 0, radius = 1, angle = 0, at = 0"), ("moment polygon", "force polygon"))):
        task.write_text(text)
        assert main(["balance", str(task), "-q", "-o", str(file)]) == 0
        svg = file.read_text()
        assert all(f'data-plan="{panel}"' in svg for panel in panels)
    task.write_text(THREE)
    assert main(["balance", str(task), "-q", "-o", str(file)]) == 0
    svg = file.read_text()
    assert svg.count('class="step"') >= 10
    assert "57.988 ± " in svg
    assert "Steps " not in svg  # each is told


def test_rotors_are_no_linkages(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A rotor is no scene and has no use for the options of a linkage; numbers have none for paper."""
    task = tmp_path / "rotor.toml"
    task.write_text(THREE)
    assert main(["solve", str(task)]) == 2
    assert "rotor: this is a task, not a scene; graphplan balance" in capsys.readouterr().err
    for given in (["--positions", "12"], ["--paper", "A2"], ["-o", "rotor.gif"]):
        assert main(["balance", str(task), *given]) == 2
        assert len(capsys.readouterr().err.splitlines()) == 1


@pytest.mark.parametrize(("text", "line"), [
    (masses("mass = -1, radius = 2, angle = 0, at = 1"), "rotor.masses.1.mass: the mass -1 is negative"),
    (masses("mass = 1, radius = 2, angle = 0"), "rotor.masses.1: at is missing"),
    (masses("mass = 1, radius = 2, angle = 0, at = 1", planes="[3, 3]"), "rotor.planes: both planes stand at 3"),
    (masses(), "rotor.masses: there are no masses"),
    (masses("mass = 1, radius = 2, angle = 0, at = 1", planes="[1, 2, 3]"), "rotor.planes: a list of 3"),
    (masses("mass = 1, radius = 2, angle = 0, at = 1, name = 'a'", "mass_radius = 1, angle = 0, at = 1, name = 'a'"),
     "rotor.masses.2: a second mass a"),
    (masses("mass = 1, radius = 2, angle = 0, at = 1") + "rpm = 30\n", "rotor: bearings and a speed belong together"),
    (masses("mass = 1, radius = 2, angle = 0, at = 1") + "[trial]\nweights = [1, 2, 3, 4]\nradius = 2\n",
     "trial: the masses are given already"),
    (f"{ONE}amplitudes = [1, 2, 3]\nmass = 1\n", "trial: radius is missing"),
    ("[rotor]\nplanes = [0, 2]\n[trial]\namplitudes = [1, 2, 3]\nmass_radius = 1\n", "trial: trials: 1, planes: 2"),
    (f"{ONE}amplitudes = [3, 1, 1]\nmass_radius = 1\n", "trial: the amplitudes 3, 1, 1: A² ="),
    (f"{ONE}amplitudes = [3, 3, 3]\nmass_radius = 1\n",
     "trial: the amplitudes 3, 3, 3: the trial mass has almost no effect"),
    (f"{ONE}amplitudes = [1, 5, 1]\nmass_radius = 1\n", "trial: the amplitudes 1, 5, 1: no parallelogram"),
    (f"{ONE}amplitudes = [3, 4, 3.5]\nmass_radius = 1\nfourth = {{ amplitude = 3.5, angle = 180 }}\n",
     "trial.fourth: both solutions predict the same"),
])  # fmt: skip
def test_what_cannot_be_is_refused(text: str, line: str) -> None:
    """What no rotor is and no measurement gives is one line with the reason."""
    with pytest.raises((SceneError, Refused)) as fault:
        balance_rotor(parse(text, "rotor.toml"))
    assert str(fault.value).startswith(f"rotor.toml: {line}")
    assert fault.value.status == 2
