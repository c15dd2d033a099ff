"""The second opinion over many poses: each as it is alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import graphplan as gp
from graphplan.mechanism.scene import packaged_names
from graphplan.mechanism.units import metre
from graphplan.solver import poses
from graphplan.solver import solve as solve_rates
from graphplan.solver.statics import reactions

TURNS = np.exp(1j * np.array([0.0, 0.7, 4.0]))


@pytest.mark.parametrize("name", packaged_names())
def test_each_pose_is_solved_as_alone(name: str) -> None:
    """A scene turned round as a whole: velocities, accelerations and reactions turn with it, gravity apart."""
    scene = gp.load(name)
    if scene.loads is not None:
        scene = replace(scene, loads=replace(scene.loads, gravity=(0, 0), forces=(), frictions=(),
                                             balances=tuple(b for b in scene.loads.balances if not b.at)))
        if not scene.loads.balances:
            pytest.skip("its balance is a force, which does not turn with it")
    if scene.motions:
        pytest.skip("its given motions do not turn with it")
    alone = solve_rates(scene)
    points = {name: complex(*map(float, at)) * TURNS for name, at in scene.points.items()}
    guides = {pair.name: complex(*map(float, pair.direction)) * TURNS for pair in scene.directed_pairs
              if pair.direction}
    turned = poses.scene_in_poses(scene, points, guides)
    rates = poses.solve(turned, len(TURNS))
    for one, many in (alone.velocity, rates.velocity), (alone.acceleration, rates.acceleration):
        size = max(abs(complex(*value)) for value in one.values())
        for point, value in one.items():
            x, y = many[point]
            assert np.abs((x + 1j * y) / TURNS - complex(*value)).max() < 1e-12 * alone.condition * size
    if scene.loads is not None:
        held, found = reactions(scene), poses.reactions(turned, rates, len(TURNS))
        turning = [abs(float(moment)) / (scene.extent * metre(scene.units)) for moment in held.balances]
        size = max(*turning, *(abs(complex(*force)) for force in held.joints.values()))
        for pair, force in held.joints.items():
            x, y = found.joints[pair]
            assert np.abs((x + 1j * y) / TURNS - complex(*force)).max() <= 1e-12 * held.condition * size


def test_a_singular_pose_among_others_is_no_number() -> None:
    """Where a system has no solution its rates are nan, and the other poses are as they were."""
    scene = gp.load("four-bar")
    (ax, ay), (cx, cy) = scene.points["A"], scene.points["C"]
    B = np.array([complex(*map(float, scene.points["B"])), complex(ax + cx, ay + cy) / 2])
    rates = poses.solve(poses.scene_in_poses(scene, {"B": B}, {}), 2)
    assert rates.velocity["B"][0][0] == pytest.approx(solve_rates(scene).velocity["B"][0])
    assert not np.isfinite(rates.velocity["B"][0][1]) or abs(rates.velocity["B"][0][1]) > 1e12
