"""Errors of position of any linkage: construction, solver and closure give one coefficient for each side of a bar."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from linkages import scenes

from graphplan.check.position_errors import position_errors
from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.model import Find


@pytest.mark.parametrize("seed", range(20))
def test_random_linkages_agree_with_differences_of_their_closure(seed: int) -> None:
    """Every side of every bar: construction, solver and closure give one coefficient, or the pose is singular."""
    scene = next(scenes(seed, 1), None)
    if scene is None or not scene.drives or scene.redundant:
        return
    sides = {f"{own[0]} {own[1]}": Fraction(1, 10) for own in scene.links.values()
             if len(own) == 2 and scene.points[own[0]] != scene.points[own[1]]}
    turning = tuple(link for link in scene.moving if len(scene.links[link]) > 1)
    scene = replace(scene, tolerances=sides, loads=None, find=Find((), (), links=turning or None))
    try:
        found = position_errors(scene)
    except (Refused, SingularPose):
        return
    assert found.parts
