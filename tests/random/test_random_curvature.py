"""Paths of points of any linkage have the centres of curvature that the solver's rates give, to the last digit."""

from __future__ import annotations

from dataclasses import replace

import pytest
from linkages import linkage

from graphplan.check.paths import path_truth
from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.scene import parse
from graphplan.methods.construct import construct
from graphplan.methods.styles import OF_PATHS
from graphplan.solver import solve

LINKAGES, TOGETHER = 20, 5


@pytest.mark.parametrize("first", range(0, LINKAGES, TOGETHER))
def test_centres_and_circles_are_constructed_exactly(first: int) -> None:
    """Every centre of curvature, inflection pole and pole is the solver's as a fraction, by whichever way."""
    for seed in range(first, first + TOGETHER):
        find = 'curvature = "all"\ninflection = "all"'
        scene = parse(linkage(seed).text().replace('velocity = "all"\nacceleration = "all"', find), "random")
        try:
            rates = solve(scene, exact=True)
        except SingularPose:
            continue
        asked = scene.find
        moving = tuple(name for name, (point, _) in asked.traced.items() if any(rates.velocity[point]))
        turning = tuple(link for link in asked.inflection if rates.omega[link])
        scene = replace(scene, find=replace(asked, curvature=moving, inflection=turning))
        results = construct(scene, method=("", *OF_PATHS)[seed % 5]).read(Fractions())
        assert results == path_truth(rates, results), f"linkage {seed}"
        assert sum(map(len, results.values())) == len(moving) + 2 * len(turning), f"linkage {seed}"
