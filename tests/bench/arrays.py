"""Arrays: rates of all joints of the eight-link chain, for 100,000 poses given by coordinates."""

from __future__ import annotations

import by_lapack
import exact
import numpy as np
from harness import Row, Target, alternate, compared, peer

import graphplan as gp
from graphplan.mechanism.model import Scene

N = 100_000
SPREAD = 3  # mm, within which every moving joint is shifted: rates need no lengths that stay the same


def rows() -> list[Row]:
    """Ours against batches of LAPACK and against a loop written by hand for this mechanism alone."""
    scene = gp.load("alt-eight-link")
    points = shaken(scene)
    drawing = gp.construct(scene)
    motions = {"ours": lambda: ours(drawing, points), "numpy.linalg": lambda: by_lapack.motion(scene, points)}
    if loop := peer("by_hand_numba"):
        motions["numba by hand"] = lambda: by_hand(loop.many_poses(*points.values()), points)
    truth = exact.of_poses(scene, points)
    errors = {name: exact.error(motion(), truth) for name, motion in motions.items()}
    times = alternate(motions)
    return [compared("arrays, a pose", "numpy.linalg", Target("at least", 15), times, over=N, errors=errors),
            compared("arrays, a pose", "numba by hand", Target("at most", 3), times, over=N, errors=errors)]


def shaken(scene: Scene) -> exact.Points:
    """Poses near the scene's, every moving joint shifted at random."""
    random = np.random.default_rng(15)
    moving = {name: complex(*map(float, scene.points[name])) for name in scene.find.velocity}
    return {name: z + random.uniform(-SPREAD, SPREAD, (N, 2)) @ np.array([1, 1j]) for name, z in moving.items()}


def ours(drawing: gp.Construction, points: exact.Points) -> exact.Motion:
    """The steps over all poses."""
    poses = drawing.evaluate(points, only=("velocity", "acceleration"))
    return {"velocity": poses.velocity, "acceleration": poses.acceleration}


def by_hand(found: tuple[np.ndarray, np.ndarray], points: exact.Points) -> exact.Motion:
    """The two arrays of the loop, by point."""
    return {kind: dict(zip(points, values, strict=True))
            for kind, values in zip(("velocity", "acceleration"), found, strict=True)}
