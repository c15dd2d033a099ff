"""Loops: the mechanism moved so that the end is the beginning, round and round, or there and back between limits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphplan.cycle.travel import check_drives, closes, travels
from graphplan.cycle.turn import RangeOfMotion, Turn
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import TURN, paces
from graphplan.phrases import said

TURNS = 16  # of the first drive, in which gears must be back
BEFORE = 0.002  # of the way: so far before a limit it turns round, as there are no velocities at the limit itself


@dataclass(frozen=True)
class Loop:
    """The poses of a loop, and in which order they are gone through, as places in `turn`; the first is the given pose,
    or of a span without it the nearest."""

    turn: Turn
    order: Sequence[int]


def whole_motion(scene: Scene) -> RangeOfMotion:
    """As far as the mechanism goes from its given pose: one turn of the first drive, or with gears as many as it takes
    until all is back, if not too many; of a drive that slides to its limits, or where there are none as far as the
    mechanism is large.

    Fails with `Refused` where that is nowhere.
    """
    check_drives(scene)
    found = range_of_motion(scene)
    if found.path.travel[0] == found.path.travel[-1]:
        raise Refused("the cycle", said("the mechanism does not move on from the given pose"), "another pose")
    return found


def range_of_motion(scene: Scene) -> RangeOfMotion:
    """The same, be it nowhere."""
    if scene.drives[0].slides:
        places = [complex(*map(float, at)) for at in scene.points.values()]
        far = max(abs(p - q) for p in places for q in places)
        found = RangeOfMotion(scene, -far, far, closed=False)
    else:
        found = RangeOfMotion(scene, 0.0, TURN, closes(scene, paces(scene)))
        if found.closed and found.linkage.counted and not (found.whole or found.path.upper):
            found = _until_back(scene) or found
    return found


def _until_back(scene: Scene) -> RangeOfMotion | None:
    """The motion through the fewest turns after which all is back; none where these are too many, or it stops."""
    most = 1
    while most < TURNS:
        found, most = RangeOfMotion(scene, 0.0, 2 * most * TURN, closed=True), 2 * most
        if found.path.upper:
            return None
        for count in range(most // 2 + 1, most + 1):
            if found.back(count * TURN):
                return found if count == most else RangeOfMotion(scene, 0.0, count * TURN, closed=True)
    return None


def loop(scene: Scene, count: int, span: tuple[float, float] | None = None) -> Loop:
    """The scene moved through so many poses: one full turn, or where it does not close, or a span is given in degrees
    (lengths of a drive that slides), there and back, slower towards the ends.

    Fails as :func:`graphplan.cycle.follow` does.
    """
    if span is None:
        motion, ends = whole_motion(scene), (-math.inf, math.inf)
    else:
        low, high = sorted(travels(scene, 2, span).tolist())
        motion, ends = RangeOfMotion(scene, min(0.0, low), max(0.0, high), closed=False), (low, high)
    if motion.whole:
        return Loop(motion.turn(motion.path.travel[-1] * np.arange(count) / count), range(count))
    low, high = _inside(motion, *ends)
    half = count // 2
    travel = (low + high) / 2 - (high - low) / 2 * np.cos(np.pi * np.arange(half + 1) / max(1, half))
    first = int(np.argmin(np.abs(travel)))
    if low <= 0.0 <= high:
        travel[first] = 0.0
    back = [*range(half + 1), *range(half - 1, 0, -1)]
    return Loop(motion.turn(travel), back[first:] + back[:first])


def _inside(motion: RangeOfMotion, low: float, high: float) -> tuple[float, float]:
    """The travels between which it goes: as far as it can within these ends, and not quite to limits."""
    path = motion.path
    least, most = float(path.travel[0]), float(path.travel[-1])
    spare = BEFORE * (most - least)
    low = max(low, least + spare if path.lower else least)
    high = min(high, most - spare if path.upper else most)
    if low >= high:
        raise Refused("the cycle", said("the mechanism does not come there from the given pose"), "another range")
    return low, high
