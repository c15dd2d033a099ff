"""Follow: 10,000 positions around a turn of an eight-link chain, beside one 6 x 6 system a pose solved by LAPACK.

The chain has six unknown angles: a method that finds them by Newton's steps solves one such system at least in each.
"""

from __future__ import annotations

from functools import partial
from importlib.util import find_spec

import exact
import numpy as np
from cycle_kimech import SCENE
from harness import Measured, Row, Target, alternate, compared

import graphplan as gp

POSES, ANGLES = 10_000, 6
SYSTEMS = "LAPACK, 6 x 6"


def rows() -> list[Row]:
    """In numpy, and where it can be compiled by numba."""
    scene, random = gp.load(SCENE), np.random.default_rng(17)
    matrices = random.uniform(-1, 1, (POSES, ANGLES, ANGLES)) + 4 * np.eye(ANGLES)
    sides = random.uniform(-1, 1, (POSES, ANGLES, 1))
    runs = {"ours": lambda: gp.cycle.follow(scene, POSES), SYSTEMS: lambda: np.linalg.solve(matrices, sides)}
    if find_spec("numba") is not None:
        runs["compiled"] = lambda: gp.cycle.follow(scene, POSES, compiled=True)
    errors = {name: _error(scene, name == "compiled") for name in runs if name != SYSTEMS}
    found, most = Measured(alternate(runs), errors), partial(Target, "at most")
    return [compared(f"follow {POSES:,} poses, {how}", SYSTEMS, most(times), found.times, ours=ours, over=POSES,
                     errors=found.errors) for how, ours, times in (("numpy", "ours", 12), ("numba", "compiled", 3))]


def _error(scene: gp.Scene, compiled: bool) -> float:
    """The largest error of the sampled positions, against 50 digits."""
    found = gp.cycle.follow(scene, POSES, compiled=compiled).points
    points = {name: found[name] for name in scene.find.velocity}
    return exact.error({"points": points}, exact.of_travel(scene, 2 * np.pi / POSES * np.arange(POSES), points))
