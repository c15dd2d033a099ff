"""Random machines with gravity any way have a flywheel, a motion and a balance, and second opinions agree.

More than the quick tier tries: `TESTS=thorough python -m pytest tests/random/test_random_machines.py`.
"""

from __future__ import annotations

import numpy as np
import pytest
from machines import Machine

from graphplan.check import motion as of_motions
from graphplan.check.balance import balancing
from graphplan.errors import Refused
from graphplan.machine.flywheel.result import flywheel
from graphplan.machine.motion.runs import motion_of_scene
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse

# the weights of 0, 9, 13 and 16 move across gravity, 67 runs evenly; balanced, a mass centre of 124 lies in its hinge
SEEDS = (*range(14), 16, 67, 124)
CLOSE = 1e-8  # of the largest: what second opinions may differ by


def machine(seed: int) -> Scene:
    return parse(Machine(seed).text(), f"machine {seed}", by_drive=True)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_machine_runs_as_evenly_as_was_asked_for(seed: int) -> None:
    """Its flywheel is found, and the speeds of its motion; only a machine that is even enough needs no flywheel."""
    scene = machine(seed)
    found = motion_of_scene(scene)
    assert max(of_motions.check_motion(found).values()) <= CLOSE
    assert found.steady is not None
    assert scene.flywheel is not None
    uneven = found.steady.means.unevenness
    try:
        wheel = flywheel(scene)
    except Refused as refused:
        assert "needs no flywheel" in str(refused)
        assert uneven <= float(scene.flywheel.unevenness or 0)
    else:
        assert max(of_motions.check_flywheel(wheel).values()) <= CLOSE
        assert uneven == pytest.approx(float(scene.flywheel.unevenness or 0), rel=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_machine_is_balanced(seed: int) -> None:
    """Its mass centre and what shakes its frame are found, and agree with the sums over its links."""
    found = balancing(machine(seed), 12)
    assert np.isfinite(found.before.links.travel).all()
