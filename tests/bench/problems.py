"""The problems of the bench: mechanisms in many poses, given by the coordinates of their moving joints."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import graphplan as gp
from graphplan.bench.problem import LAPACK, SOLVERS, Problem, TimedRun
from graphplan.solver import poses
from graphplan.solver.rates import Equations, motion_equations

SCENES = ("four-bar", "slider-crank", "alt-eight-link", "rosenauer-example-2")
N = 32_768
SPREAD = 3  # mm, within which every moving joint is shifted: rates need no lengths that stay the same
KINDS = "velocity", "acceleration"

Points = dict[str, NDArray[np.complex128]]


def shaken(scene: gp.Scene, n: int = N) -> Points:
    """Poses near the scene's, every moving joint shifted at random, a block along its guide."""
    random, guides = np.random.default_rng(15), {slide.at: slide.direction for slide in scene.slides}
    points: Points = {}
    for name in scene.find.velocity:
        shifts = random.uniform(-SPREAD, SPREAD, (n, 2)) @ np.array([1, 1j])
        along = shifts.real * complex(*map(float, guides[name])) if name in guides else shifts
        points[name] = complex(*map(float, scene.points[name])) + along
    return points


@cache
def problem(name: str, n: int = N) -> Problem:
    """The motion of a packaged scene in such poses."""
    scene = gp.load(name)
    return Problem(scene, points=shaken(scene, n))


def lapack(scene: gp.Scene, points: Mapping[str, Any]) -> dict[str, Callable[[], Any]]:
    """LAPACK's run of the same poses, by the name that it has in the tables."""
    return {LAPACK: SOLVERS[LAPACK](Problem(scene, points=dict(points))).call}


def equations(scene: gp.Scene, places: Mapping[str, Any], root: Callable[[Any], Any]) -> Equations:
    """The rate equations over any numbers: coordinates (x, y) by point, of those that do not stand still."""
    def direction(one: Any) -> Any:
        if getattr(one, "through", None) is None:
            return one.direction
        (ax, ay), (bx, by) = (everywhere[name] for name in one.through)
        return bx - ax, by - ay

    floats = poses.scene_in_poses(scene, {}, {})
    everywhere = floats.points | dict(places)
    return motion_equations(floats.with_pose(everywhere, direction), root)


def run(problem: Problem, call: Callable[[], Any], pose: Callable[[Any, int], Any]) -> TimedRun:
    """A rival's run; `pose` gives of what was called the velocities and then the accelerations in one pose, complex
    numbers in the order of the points."""
    def read(found: Any, j: int) -> dict[str, dict[str, tuple[float, float]]]:
        numbers = iter(pose(found, problem.places[j]))
        return {kind: {name: (z.real, z.imag) for name, z in zip(problem.points, numbers, strict=False)}
                for kind in KINDS}

    return TimedRun(call, problem.n, read)
