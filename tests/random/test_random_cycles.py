"""Any linkage is followed as far as it can move, and what its pairs hold together stays together on the way."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest
from linkages import scenes

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.check.poses import points_where_sound
from graphplan.cycle import follow
from graphplan.mechanism.model import Scene

LINKAGES = range(40, 160, 100)  # the last of them has a pose near a limit to which one step does not lead
TOGETHER = 20
TRAVEL = (-90.0, 120.0)  # degrees, or lengths
CLOSE = 1e-10  # of the largest distance between points


def torn(scene: Scene, points: dict[str, np.ndarray]) -> float:
    """The largest change of a distance between two points of a link, beside the largest distance in the given pose."""
    given = {name: complex(*map(float, at)) for name, at in scene.points.items()}
    reach = max(abs(one - other) for one in given.values() for other in given.values()) or 1.0
    pairs = [pair for names in scene.links.values() for pair in combinations(names, 2)]
    changes = (np.abs(points[one] - points[other]) - abs(given[one] - given[other]) for one, other in pairs)
    return max((float(np.nanmax(np.abs(change), initial=0)) for change in changes), default=0.0) / reach


@pytest.mark.parametrize("first", LINKAGES)
def test_linkages_are_followed_up_to_their_limits(first: int) -> None:
    """Links keep their figures in every pose, and only at a limit and beyond it there is none."""
    for seed in range(first, first + TOGETHER):
        scene = next(scenes(seed, orders=1))
        if not scene.drives[0].rate:  # it leads no others
            continue
        turn = follow(scene, 24, TRAVEL)
        assert torn(scene, turn.points) < CLOSE, f"linkage {seed}"
        assert all("limit position" in why or "change point" in why for why in turn.faults.values()), f"linkage {seed}"


@pytest.mark.parametrize("seed", [154])
def test_a_pose_to_which_one_step_does_not_lead_is_walked_to(seed: int) -> None:
    """Near a limit the curve through the knots may not tell a pose well enough: smaller steps from a knot do."""
    turn = follow(next(scenes(seed, orders=1)), 48)
    assert not turn.faults
    assert math.isclose(turn.travel[2], math.radians(15))


@pytest.mark.parametrize("seed", [3, 27])
def test_no_pose_is_drawn_by_points_that_coincide_in_another(seed: int) -> None:
    """A program that relies on two points in one spot gives nothing where they lie apart, and says so: all that it
    gives agrees with the solver."""
    scene = next(scenes(seed, orders=1))
    drawing, turn = gp.construct(scene), follow(scene, 9, (0, 40))
    poses = drawing.evaluate(turn.points, turn.guides)
    given = np.all([np.isfinite(z) for z in poses.velocity.values()], axis=0)
    agreed = np.all([np.isfinite(z) for z in points_where_sound(drawing, turn.points, turn.guides).values()], axis=0)
    assert drawing.relied
    assert given.tolist() == agreed.tolist()
    assert all("coincide in the scene and lie apart here" in why for why in poses.faults.values())


@pytest.mark.parametrize("seed", [11, 13])
def test_what_rounding_leaves_of_nothing_is_not_wrong(seed: int) -> None:
    """Of what stands still rounding alone is left over, beside what moves: no pose of the cycle is wrong for it."""
    assert cycle(next(scenes(seed, orders=1)), 24, TRAVEL).wrong == ()


def test_points_in_one_place_of_a_link_are_one_to_rounding() -> None:
    """Two points of one link in one place, which other links carry, may differ by rounding in other poses."""
    found = cycle(next(scenes(0, orders=1)), 24, TRAVEL)
    assert found.wrong == ()
    assert len(found.faults) < 24
