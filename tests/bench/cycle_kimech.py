"""A turn of an eight-link chain in 360 poses, against kimech.

kimech finds its own positions and cannot be handed any. So there are four rows: its rates alone, which are what the
whole takes longer than the positions, against ours from given poses; the whole against ours from given poses; the whole
against ours with positions found too; and the same where we find 10,000 poses, each pose of kimech taking as long.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from typing import Any

import exact
import numpy as np
from harness import Measured, Row, Target, alternate, compared, peer
from problems import lapack

import graphplan as gp

POSES, MANY = 360, 10_000
FINE = "ours with many positions, as many of them"
SCENE = "alt-eight-link-2"  # whose crank turns all the way round


def rows() -> list[Row]:
    """Ours against kimech, without and with positions."""
    found = measured()
    given, whole = Target("at least", 2000), Target("at least", 1500)
    return [compared("turn, given poses", "kimech, rates", given, found.times, over=POSES, errors=found.errors),
            compared("turn, poses given to ours", "kimech", given, found.times, over=POSES, errors=found.errors),
            *(compared(f"turn with positions, {count:,} poses", "kimech", whole, found.times, ours=ours, over=POSES,
                       errors=found.errors) for count, ours in ((POSES, "ours with positions"), (MANY, FINE)))]


@cache
def measured() -> Measured:
    """All runs in turns, LAPACK on the same poses among them."""
    scene, drawing = gp.load(SCENE), gp.construct(gp.load(SCENE))
    travel = 2 * math.pi / POSES * np.arange(POSES)
    points = moving(scene)
    runs = {"ours": lambda: motion(drawing, points),
            "ours with positions": lambda: motion(drawing, moving(scene))}
    motions = dict(runs)
    runs[FINE] = lambda: motion(drawing, moving(scene, MANY))
    runs |= lapack(scene, points)
    if module := peer("by_kimech"):
        chain = module.Kimech(scene)
        runs |= {"kimech": lambda: chain.motion(travel), "its positions": lambda: chain.positions(travel)}
        motions["kimech"] = lambda: chain.read(chain.motion(travel))
    truth = exact.of_travel(scene, travel, points)
    errors = {name: exact.error(found(), truth) for name, found in motions.items()}
    times = alternate(runs)
    times[FINE] = [spent * POSES / MANY for spent in times[FINE]]
    if module:
        times["kimech, rates"] = [a - b for a, b in zip(times["kimech"], times["its positions"], strict=True)]
        errors["kimech, rates"] = errors["kimech"]
    return Measured(times, errors)


def measures() -> Iterator[Any]:
    """Its row for the chart of the machine."""
    return measured().beside(SCENE, {"kimech": "kimech, with positions"})


def moving(scene: gp.Scene, poses: int = POSES) -> exact.Points:
    """The positions of the points that move, over the turn."""
    points = gp.cycle.follow(scene, poses).points
    return {name: points[name] for name in scene.find.velocity}


def motion(drawing: gp.Construction, points: exact.Points) -> exact.Motion:
    """The steps over all poses."""
    poses = drawing.evaluate(points, only=("velocity", "acceleration"))
    return {"velocity": poses.velocity, "acceleration": poses.acceleration}
