"""Paths of points of any linkage have the centres of curvature that the solver's rates give, to the last digit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from gearings import gearing
from linkages import Linkage, linkage, scenes
from tiers import sample

from graphplan.check.report import path_truth
from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.model import FRAME, Find
from graphplan.mechanism.sections import OF_PATHS
from graphplan.methods.construct import construct
from graphplan.solver import solve

MECHANISMS, TOGETHER = sample((3, 3), (20, 5))
MADE = {"linkages": linkage, "gearings": gearing}


@pytest.mark.parametrize("first", range(0, MECHANISMS, TOGETHER))
@pytest.mark.parametrize("made", MADE.values(), ids=MADE)
def test_centres_and_circles_are_constructed_exactly(made: Callable[[int], Linkage], first: int) -> None:
    """Every centre of curvature, inflection pole, pole and acceleration centre is the solver's as a fraction."""
    for seed in range(first, first + TOGETHER):
        scene = next(scenes(seed, 1, made))
        try:
            rates = solve(scene, exact=True)
        except SingularPose:
            continue
        moving = tuple(f"{point} on {link}" for link in scene.moving for point in scene.links[link]
                       if point not in scene.links.get(FRAME, ()) and any(rates.velocity[point]))
        turning = tuple(link for link in scene.moving if rates.omega[link])
        scene = replace(scene, loads=None, find=Find((), (), curvature=moving, inflection=turning,
                                                     acceleration_centres=turning))
        results = construct(scene, method=("", *OF_PATHS)[seed % 5]).read(Fractions())
        assert results == path_truth(solve(scene, exact=True), results), f"seed {seed}"
        assert sum(map(len, results.values())) == len(moving) + 3 * len(turning), f"seed {seed}"
