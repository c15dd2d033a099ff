"""Random machines with gravity any way have a flywheel, a motion and a balance; second opinions and energies agree."""

from __future__ import annotations

import numpy as np
import pytest
from worlds import scenes

import graphplan as gp

# the weights of 0, 9, 13 and 16 move across gravity, 67 runs evenly; balanced, a mass centre of 124 lies in its hinge
SEEDS = (*range(14), 16, 67, 124)
CLOSE = 1e-8  # of the largest: what second opinions may differ by
FINE = 1440  # positions, of which loads change their slopes in some


def machine(seed: int) -> gp.Scene:
    (_, scene), = scenes("machine", range(seed, seed + 1))
    return scene


@pytest.mark.parametrize("seed", SEEDS)
def test_a_machine_runs_as_evenly_as_was_asked_for(seed: int) -> None:
    """Its flywheel is found, and the speeds of its motion; only a machine that is even enough needs no flywheel."""
    scene = machine(seed)
    assert scene.flywheel is not None
    asked = float(scene.flywheel.unevenness or 0)
    motion = gp.motion(scene, steady=True).json()
    assert max(motion["check"].values()) <= CLOSE
    most, least = motion["speeds"]["max"]["omega"], motion["speeds"]["min"]["omega"]
    uneven = (most - least) / ((most + least) / 2)
    try:
        wheel = gp.flywheel(scene).json()
    except gp.Refused as refused:
        assert "needs no flywheel" in str(refused)
        assert uneven <= asked
    else:
        assert max(wheel["check"].values()) <= CLOSE
        assert uneven == pytest.approx(asked, rel=1e-6)


@pytest.mark.parametrize("seed", SEEDS[::3])
def test_work_is_the_change_of_energy(seed: int) -> None:
    """In each position the energy is half the reduced inertia times the square of the speed, and between two of them it
    changes by the work of the reduced moment."""
    scene = machine(seed)
    told = gp.motion(scene, steady=True, positions=FINE).json()
    omega, inertia, moment, energy = (np.array(told[key]) for key in ("omega", "inertia", "moment", "energy"))
    assert energy == pytest.approx(inertia * omega**2 / 2, rel=1e-12)
    step, ends = np.radians(told["travel"][1] - told["travel"][0]), np.arange(0, len(moment) - 2, 2)
    works = step / 3 * (moment[ends] + 4 * moment[ends + 1] + moment[ends + 2])
    assert np.cumsum(works) == pytest.approx(energy[ends + 2] - energy[0], abs=1e-6 * np.abs(works).sum() + 1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_machine_is_balanced(seed: int) -> None:
    """Its mass centre and what shakes its frame are found, and agree with the sums over its links."""
    told = gp.balance(machine(seed), positions=12).json()
    assert max(told["check"].values()) <= CLOSE
    assert np.isfinite(told["mass_centre"]["path"]).all()
    assert len(told["shaking_force"]) == 12
