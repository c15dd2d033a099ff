"""The rivals solve the same problems: each agrees with the exact solution. Run by `pytest tests/bench`."""

from __future__ import annotations

import math

import arrays
import by_hand_python
import by_lapack
import exact
import numpy as np
import pytest

import graphplan as gp

Shaken = tuple[gp.Scene, exact.Points, dict[int, exact.Truth]]

POSES = 40
AGREES = 1e-9  # relative, of the largest of its kind: what kimech itself asks of its residuals


@pytest.fixture(scope="module")
def shaken() -> Shaken:
    """The eight-link chain, some poses by coordinates, and what is true of them."""
    scene = gp.load("alt-eight-link")
    points = {name: z[:POSES] for name, z in arrays.shaken(scene).items()}
    return scene, points, exact.of_poses(scene, points)


def test_by_hand_in_python(shaken: Shaken) -> None:
    """The function written by hand gives the chain's velocities and accelerations."""
    _, points, truth = shaken
    found = np.array([by_hand_python.one_pose(*pose) for pose in zip(*points.values(), strict=True)]).T
    assert exact.error(arrays.by_hand((found[:7], found[7:]), points), truth) < AGREES


def test_by_hand_in_numba(shaken: Shaken) -> None:
    """The loop written by hand gives the chain's velocities and accelerations."""
    pytest.importorskip("numba")
    from by_hand_numba import many_poses

    _, points, truth = shaken
    assert exact.error(arrays.by_hand(many_poses(*points.values()), points), truth) < AGREES


def test_by_lapack(shaken: Shaken, monkeypatch: pytest.MonkeyPatch) -> None:
    """The batched systems give the chain's velocities and accelerations, over more than one block too."""
    scene, points, truth = shaken
    monkeypatch.setattr(by_lapack, "BLOCK", POSES // 2 + 1)
    assert exact.error(by_lapack.motion(scene, points), truth) < AGREES


def test_by_kimech() -> None:
    """The kimech mechanism is the scene, its crank turned by the angles asked for."""
    pytest.importorskip("kimech")
    from by_kimech import Kimech

    scene, travel = gp.load("alt-eight-link-2"), 2 * math.pi / 90 * np.arange(POSES)
    chain = Kimech(scene)
    solution = chain.motion(travel)
    truth = exact.of_travel(scene, travel, chain.read(solution)["points"])
    assert exact.error(chain.read(solution), truth) < AGREES


def test_by_pylinkage() -> None:
    """The pylinkage linkage is the scene, its crank turned step by step, and starts anew in each run."""
    pytest.importorskip("pylinkage")
    pytest.importorskip("numba")
    from by_pylinkage import Pylinkage

    scene, travel = gp.load("four-bar"), 2 * math.pi / POSES * np.arange(POSES)
    linkage = Pylinkage(scene, POSES)
    linkage.positions()
    found = linkage.read(linkage.motion())
    assert exact.error(found, exact.of_travel(scene, travel, found["points"])) < AGREES
