"""Random linkages at other travels of their drives: what steps place is where the cycle has it; and by which way."""

from __future__ import annotations

import pytest
from linkages import scenes

import graphplan as gp
from graphplan.check.trusted import report
from graphplan.errors import GraphplanError, Refused, SingularPose
from graphplan.methods.construct import construct
from graphplan.methods.motion import alternatives
from graphplan.methods.motion.proportion import badness

TOGETHER, PLACED = 8, 3


@pytest.mark.parametrize("first", [0, 8])
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


def test_of_ways_that_are_as_steady_the_one_with_better_results_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a pencil's slips would spoil results, a way that spoils fewer is worth more steps."""
    scene = next(scenes(100, orders=1))
    better = construct(scene)
    monkeypatch.setattr(alternatives, "TOLERABLE", 1.0)
    shorter = construct(scene)
    assert len(better.program) > len(shorter.program)
    assert badness(better) < 0.6 * badness(shorter)
