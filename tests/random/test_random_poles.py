"""All poles of random linkages by construction, beside the solver's rates, as fractions."""

from __future__ import annotations

import pytest
from henneberg import henneberg
from linkages import linkage
from polar import with_all_poles

from graphplan.check.cycle import cycle
from graphplan.check.trusted import report
from graphplan.errors import SingularPose
from graphplan.kernel.program import Board
from graphplan.mechanism.scene import parse
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.poles import Poles
from graphplan.methods.poses import Pose
from graphplan.solver import solve

TOGETHER = 8  # linkages to a test


@pytest.mark.parametrize("first", range(0, 16, TOGETHER))
def test_poles_are_constructed_exactly(first: int) -> None:
    """However a linkage is driven, and however many of its lines fall in one, every pole is exactly the solver's."""
    agreed = 0
    for seed in range(first, first + TOGETHER):
        scene = with_all_poles(parse(linkage(seed).text(), f"random {seed}"))
        try:
            solve(scene, exact=True)
        except SingularPose:
            continue
        assert report(scene, exact=True).agrees, seed
        agreed += 1
    assert agreed > TOGETHER // 2


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("seed", [2022, 2073, 2084, 2009])
def test_a_singular_pose_is_told_as_such(seed: int) -> None:
    """Where the velocities have no or many solutions, the pose is singular, also around the cycle; numpy is silent."""
    scene = with_all_poles(parse(linkage(seed).text(), f"random {seed}"))
    with pytest.raises(SingularPose):
        report(scene)
    assert len(cycle(scene, 3, (0.0, 1.0)).faults) == 3


def test_hardly_a_pole_is_found_that_is_not_drawn() -> None:
    """Of the poles of a linkage of 40 links little more are found than those relative to the frame rest on."""
    for seed in range(2):
        scene, board = henneberg(40, seed, 0.3), Board()
        poles = Poles(board, scene, Pose(board, Network(scene)))
        poles.draw([f"{link} frame" for link in scene.moving])
        assert 100 < len(poles.drawn) < len(poles.diagram.found) < 1.3 * len(poles.drawn)
