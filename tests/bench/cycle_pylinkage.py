"""A turn of a four-bar in 100,000 poses, positions found too, against pylinkage compiled with numba."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import exact
import numpy as np
from harness import Measured, Row, Target, alternate, compared, peer
from problems import lapack

import graphplan as gp

N = 100_000
SCENE = "four-bar"


def rows() -> list[Row]:
    """Ours against pylinkage: positions, and positions with velocities and accelerations."""
    found, target = measured(), Target("at least", 2)
    return [compared("turn, positions", "pylinkage, positions", target, found.times, ours="our positions", over=N,
                     errors=found.errors),
            compared("turn, positions and rates", "pylinkage", target, found.times, over=N, errors=found.errors)]


@cache
def measured() -> Measured:
    """All runs in turns, LAPACK on the same poses among them."""
    scene, drawing = gp.load(SCENE), gp.construct(gp.load(SCENE))
    runs: dict[str, Callable[[], Any]] = {
        "ours": lambda: motion(drawing),
        "our positions": lambda: {"points": moving(scene)},
    }
    found = {name: run() for name, run in runs.items()}
    runs |= lapack(scene, moving(scene))
    if module := peer("by_pylinkage"):
        linkage = module.Pylinkage(scene, N)
        runs |= {"pylinkage": linkage.motion, "pylinkage, positions": linkage.positions}
        found |= {name: linkage.read(runs[name]()) for name in ("pylinkage", "pylinkage, positions")}
    truth = exact.of_travel(scene, 2 * math.pi / N * np.arange(N), moving(scene))
    return Measured(alternate(runs), {name: exact.error(values, truth) for name, values in found.items()})


def measures() -> Iterator[Any]:
    """Its row for the chart of the machine."""
    return measured().beside(SCENE, {"pylinkage": "pylinkage, with positions"})


def moving(scene: gp.Scene) -> exact.Points:
    """The positions of the points that move, over the turn."""
    points = gp.cycle.follow(scene, N).points
    return {name: points[name] for name in scene.find.velocity}


def motion(drawing: gp.Construction) -> exact.Motion:
    """Positions, and the steps over all of them."""
    points = moving(drawing.scene)
    poses = drawing.evaluate(points, only=("velocity", "acceleration"))
    return {"points": points, "velocity": poses.velocity, "acceleration": poses.acceleration}
