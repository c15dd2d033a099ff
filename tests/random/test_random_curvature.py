"""Paths of points of any linkage have the centres of curvature that the solver's rates give, to the last digit."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import pytest
from gearings import gearing
from linkages import Linkage, linkage, scenes

from graphplan.check.report import path_truth
from graphplan.check.trusted import report
from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.model import FRAME, Find
from graphplan.mechanism.sections import OF_PATHS
from graphplan.methods.construct import construct
from graphplan.methods.kinds import CENTRE
from graphplan.solver import solve

MECHANISMS, TOGETHER = 6, 3
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


@pytest.mark.parametrize("first", range(0, MECHANISMS, TOGETHER))
def test_curvature_at_rest_is_that_of_pivots_and_guides(first: int) -> None:
    """Where all rests, points about pivots have these as centres, and those of sliding links straight paths; all others
    are left out, each with the reason, and the motion is found."""
    for seed in range(first, first + TOGETHER):
        found = linkage(seed)
        found.drives[:] = [re.sub("(omega|speed) = .*", r"\1 = 0", drive) for drive in found.drives]
        scene, = scenes(seed, 1, lambda _, found=found: found)  # type: ignore[misc]
        try:
            solve(scene, exact=True)
        except SingularPose:
            continue
        fixed = {*scene.links.get(FRAME, ())}
        turning = {link for link, points in scene.links.items() if fixed & {*points}}
        sliding = {link for slide in scene.slides if FRAME in slide.links for link in slide.links}
        at = {f"{point} on {link}": {*scene.links_of[point]} for link in scene.moving for point in scene.links[link]
              if point not in fixed}
        scene = replace(scene, loads=None, find=Find((), tuple(scene.points), curvature=tuple(at)))
        answered = report(scene)
        left_out = answered.missing.get("curvature", {})
        assert {*left_out} == {name for name, links in at.items() if not links & (turning | sliding)}, f"seed {seed}"
        assert all("nothing moves there" in why for why in left_out.values()), f"seed {seed}"
        for name, centre in answered.results.get(CENTRE, {}).items():
            pivots = {scene.points[p] for link in at[name] & turning for p in fixed & {*scene.links[link]}}
            assert centre in pivots, f"seed {seed}"
