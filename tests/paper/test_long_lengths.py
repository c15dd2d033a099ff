"""Where arcs, velocities or centres of oscillation would leave the paper, a smaller scale or another form is taken."""

from __future__ import annotations

from typing import Any

import pytest
from protocol_faults import faults
from protocols import protocol, random_scenes

import graphplan as gp
from graphplan.mechanism.model import Scene

FAR = [(5014, 3, {"inertia": "shifted"}), (5015, 2, {}), (5031, 0, {"method": "auxiliary"}),
       (5032, 1, {"inertia": "points"})]  # fmt: skip


def random_scene(seed: int, place: int) -> Scene:
    """One of the random scenes of a seed."""
    return list(random_scenes(seed))[place]


@pytest.mark.parametrize(("seed", "place", "how"), FAR)
def test_no_length_is_longer_than_the_paper(seed: int, place: int, how: dict[str, Any]) -> None:
    """What is spoken fits, and all is drawn where it is told."""
    assert faults(protocol(random_scene(seed, place), **how)) == []


def test_a_centre_of_oscillation_far_off_is_not_drawn() -> None:
    """Where no sheet holds it, the link's inertia is a couple beside its force; where one does, it is drawn."""
    far = gp.construct(random_scene(5032, 1), inertia="points")
    assert "K_4" not in {step.name for step in far.drawn.steps}
    near = gp.construct(gp.load("class-four-loaded"), inertia="points")
    assert any(step.name.startswith("K_") for step in near.drawn.steps)
