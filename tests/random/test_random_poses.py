"""Random linkages at other travels of their drives: what steps place is where the cycle has it."""

from __future__ import annotations

import pytest
from linkages import scenes
from tiers import sample

import graphplan as gp
from graphplan.check.trusted import report
from graphplan.errors import GraphplanError, Refused, SingularPose

TOGETHER, PLACED = 8, 3


@pytest.mark.parametrize("first", sample([8], [0, 8, 16]))
def test_linkages_are_placed_where_they_are_followed_to(first: int) -> None:
    """Each pose that is reached is constructed, with the solver's results, or said not to be; most are constructed."""
    placed = 0
    for seed in range(first, first + TOGETHER):
        scene = next(scenes(seed, 1))
        try:
            posed = gp.at(scene, 3)
        except GraphplanError:
            continue
        try:
            found = report(posed)
        except SingularPose:
            continue
        except Refused as refused:
            assert "no steps are known" in str(refused), f"linkage {seed}"
            continue
        placed += 1
        assert found.check["position"] < 1e-11, f"linkage {seed}"
    assert placed >= PLACED
