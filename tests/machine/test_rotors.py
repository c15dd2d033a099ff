"""Rotors: two correction planes by polygons, and trial runs, as `graphplan balance` has them."""

from __future__ import annotations

import cmath
import math
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from face import ran

CASES = Path(__file__).parents[1] / "cases" / "machine" / "rotor"
THREE, TRIAL = CASES / "three.toml", CASES / "trial.toml"


def inline(value: Any) -> str:
    """A value as TOML has it in one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{name} = {inline(part)}" for name, part in value.items()) + " }"
    return f"[{', '.join(map(inline, value))}]" if isinstance(value, list) else repr(value)


def balanced(task: Path, **tables: Any) -> dict[str, Any]:
    """A rotor, balanced, with other values in its task (`rotor_masses`, `trial`): all its opinions agree."""
    settings = [part for path, value in tables.items() for part in ("--set", f"{path.replace('_', '.', 1)}="
                                                                    f"{inline(value)}")]
    data: dict[str, Any] = ran("balance", task, "-q", *settings).json
    assert max(data["check"].values()) < 1e-9
    return data


def vectors(corrections: list[dict[str, Any]]) -> list[complex]:
    """Corrections as vectors, in kg mm."""
    return [1000 * cmath.rect(one["mass_radius"], math.radians(one["angle"])) for one in corrections]


def test_numbers_of_three_masses() -> None:
    """The rotor of three masses has the corrections and disbalances that vector algebra gives, in kg m; and no rest."""
    numbers = balanced(THREE)
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


def test_random_rotors_are_left_without_force_and_moment() -> None:
    """Of any rotor the polygons' corrections leave nothing, in whatever order and distance its planes stand."""
    dice = random.Random(3)
    for _ in range(40):
        masses = [{"mass": dice.uniform(0, 3), "radius": dice.uniform(0, 300), "angle": dice.uniform(-720, 720),
                   "at": dice.uniform(-500, 900)} for _ in range(dice.randint(1, 9))]
        planes = [dice.uniform(-300, 100), dice.uniform(101, 800)]
        corrections = balanced(THREE, rotor_masses=masses, rotor_planes=planes[::dice.choice((1, -1))])["corrections"]
        assert all(0 <= one["angle"] < 360 for one in corrections)
        forces = np.array([*(cmath.rect(one["mass"] * one["radius"], math.radians(one["angle"])) for one in masses),
                           *vectors(corrections)])
        places = np.array([*(one["at"] for one in masses), *(one["plane"] for one in corrections)])
        assert abs(forces.sum()) <= 1e-12 * abs(forces).sum()
        assert abs(places @ forces) <= 1e-12 * abs(places) @ abs(forces)


@pytest.mark.parametrize("fourth", [None, 20.0, 100.0, 290.0])
def test_three_runs(fourth: float | None) -> None:
    """Amplitudes alone give the effect of the trial mass and an angle on either side; a fourth run says on which."""
    own, trial = cmath.rect(3, 0.7), cmath.rect(2, 1.9)
    runs = {"amplitudes": [abs(own), abs(own + trial), abs(own - trial)], "mass": 0.1, "radius": 40, "angle": 15}
    if fourth is None:
        found = balanced(TRIAL, trial=runs)
        (first,), (second,) = found["answers"]
        assert found["trials"][0]["amplitude"] == pytest.approx(2, abs=1e-12)
        assert [first["angle"], second["angle"]] == pytest.approx([15 + 111.245, 375 - 111.245], abs=2e-4)
        assert first["mass_radius"] == pytest.approx(4 * 3 / 2 / 1000)
        return
    for side in (1, -1):
        turn = side * 1.9416  # from the trial mass to the correction
        measured = abs(2 * cmath.rect(1, math.radians(fourth - 15)) - 3 * cmath.rect(1, turn))
        found = balanced(TRIAL, trial=runs | {"fourth": {"angle": fourth, "amplitude": measured}})
        assert len(found.get("answers", [None])) == 1
        assert found["corrections"][0]["angle"] == pytest.approx((15 + math.degrees(turn)) % 360, abs=0.01)


def test_two_runs_with_marks_find_the_unbalance() -> None:
    """The correction by vectors of two runs leaves nothing of the vibration, at any gain and phase of the machine."""
    dice = random.Random(5)
    for _ in range(20):
        unbalance, gain = (cmath.rect(dice.uniform(1, 5), dice.uniform(0, 7)) for _ in range(2))
        first, second = ({"amplitude": abs(one), "angle": math.degrees(cmath.phase(one))} for one in (
            gain * unbalance, gain * (unbalance + cmath.rect(2, math.radians(40)))))
        found = balanced(TRIAL, trial={"mass_radius": 2, "angle": 40, "first": first, "with_trial": second})
        assert vectors(found["corrections"]) == pytest.approx([-unbalance], abs=1e-12)


def test_trial_weights_run_as_a_cosine() -> None:
    """Half the difference of the extreme weights that overcome friction and unbalance is put at the largest."""
    weights = [60 + 14 * math.cos(math.radians(20 + 45 * k - 75)) for k in range(8)]
    found = balanced(TRIAL, trial={"radius": 150, "angle": 20, "weights": weights})
    assert vectors(found["corrections"]) == pytest.approx([cmath.rect(150 * 14, math.radians(75))], rel=1e-12)
    assert balanced(TRIAL, trial={"radius": 150, "weights": [4, 4, 4, 4]})["state"] == "balanced"


def test_trials_in_other_planes_are_carried_over() -> None:
    """Trial masses beside the correction planes: what they find is balanced in the planes, for each of the answers."""
    trials = [{"amplitudes": amplitudes, "mass_radius": 2, "at": at}
              for amplitudes, at in (([3, 4.1, 3.5], 50), ([2, 2.5, 2.6], 450))]
    found = balanced(TRIAL, rotor_planes=[0, 600], trial=trials)
    assert len({tuple(one["angle"] for one in answer) for answer in found["answers"]}) == 4
    wanted = set()
    for turned in found["trials"][0]["turned"]:
        for other in found["trials"][1]["turned"]:
            near, far = (cmath.rect(2 * one["ratio"], math.radians(angle))  # that balance where the trials were
                         for one, angle in zip(found["trials"], (turned, other), strict=True))
            second = (50 * near + 450 * far) / 600
            wanted |= {tuple(np.round([near + far - second, second], 9))}
    assert {tuple(np.round(vectors(answer), 9)) for answer in found["answers"]} == wanted


def test_bearings_bear_nothing_of_a_balanced_rotor() -> None:
    """The turning reactions before are those of a beam's statics; after balancing they are gone."""
    masses = [{"mass": 2, "radius": 50, "angle": 90, "at": 100}]
    found = balanced(THREE, rotor_masses=masses, rotor_planes=[0, 400], rotor_bearings=[-100, 500], rotor_omega=100)
    before, after = ([cmath.rect(one["force"], math.radians(one["angle"])) for one in found["reactions"][when]]
                     for when in ("before", "after"))
    assert before == pytest.approx([2 * 0.05 * 1e4 * 400 / 600 * 1j, 2 * 0.05 * 1e4 * 200 / 600 * 1j])
    assert max(map(abs, after)) < 1e-9
