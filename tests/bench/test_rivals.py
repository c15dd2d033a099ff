"""The rivals solve the same problems: each agrees with the exact solution. Run by `pytest tests/bench`."""

from __future__ import annotations

import math

import arrays
import by_hand_python
import exact
import numpy as np
import one_pose
import pytest
from problems import SCENES, problem, shaken

import graphplan as gp

POSES = 40
AGREES = 1e-9  # relative, of the largest of its kind: what kimech itself asks of its residuals


def test_by_hand_in_python() -> None:
    """The function written by hand gives the chain's velocities and accelerations."""
    scene = gp.load("alt-eight-link")
    points = shaken(scene, POSES)
    found = [by_hand_python.one_pose(*pose) for pose in zip(*points.values(), strict=True)]
    assert exact.error(one_pose.by_hand(found, list(points)), exact.of_poses(scene, points)) < AGREES


@pytest.mark.parametrize("name", SCENES)
def test_all_give_the_rates_of_many_poses(name: str) -> None:
    """Ours, LAPACK, and of loops by hand, CasADi in both of its ways and JAX what is installed agree with fractions."""
    of = problem(name, POSES)
    for who, made in arrays.runners(name).items():
        run = made(of)
        assert of.error(run, run.call()) < AGREES, who
    if (casadi := arrays.peer("by_casadi")) is not None:
        for run in (way(of, expanded) for way in (casadi.mapped, casadi.compiled) for expanded in (True, False)):
            assert of.error(run, run.call()) < AGREES


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
