"""One pose in Python floats: the eight-link chain's rates for poses that come one by one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import exact
import numpy as np
from by_hand_python import one_pose
from harness import Row, Target, alternate, compared
from problems import shaken

import graphplan as gp

POSES = 100
KINDS = "velocity", "acceleration"


def rows() -> list[Row]:
    """Ours against a Python function written by hand for this mechanism alone, and against our own solver."""
    scene = gp.load("alt-eight-link")
    points = shaken(scene, POSES)
    poses = [dict(zip(points, map(complex, pose), strict=True)) for pose in zip(*points.values(), strict=True)]
    scenes = [replace(scene, points=scene.points | {name: (z.real, z.imag) for name, z in pose.items()})
              for pose in poses]
    drawing = gp.construct(scene)
    runs: dict[str, Callable[[], Any]] = {
        "ours": lambda: [drawing.replay(pose, only=KINDS) for pose in poses],
        "Python by hand": lambda: [one_pose(*pose.values()) for pose in poses],
        "the solver": lambda: [gp.analytic.solve(scene) for scene in scenes],
    }
    found, names = {name: run() for name, run in runs.items()}, list(points)
    motions = {"ours": replayed(found["ours"]), "Python by hand": by_hand(found["Python by hand"], names),
               "the solver": solved(found["the solver"], names)}
    truth = exact.of_poses(scene, points)
    errors = {name: exact.error(motion, truth) for name, motion in motions.items()}
    times = alternate(runs)
    return [compared("one pose", "Python by hand", Target("at most", 5), times, over=POSES, errors=errors),
            compared("one pose", "the solver", Target("at most", 1 / 3), times, over=POSES, errors=errors)]


def replayed(found: list[dict[str, dict[str, tuple[float, float]]]]) -> exact.Motion:
    """What the replays gave, as arrays."""
    return {kind: {name: np.array([complex(*pose[kind][name]) for pose in found]) for name in found[0][kind]}
            for kind in ("velocity", "acceleration")}


def by_hand(found: list[tuple[complex, ...]], names: list[str]) -> exact.Motion:
    """What the function gave, as arrays."""
    columns = [np.array(column) for column in zip(*found, strict=True)]
    return {"velocity": dict(zip(names, columns[: len(names)], strict=True)),
            "acceleration": dict(zip(names, columns[len(names) :], strict=True))}


def solved(found: list[gp.analytic.AnalyticResults], names: list[str]) -> exact.Motion:
    """What the solver gave, as arrays."""
    return {"velocity": {name: np.array([pose.velocity[name] for pose in found]) for name in names},
            "acceleration": {name: np.array([pose.acceleration[name] for pose in found]) for name in names}}
