"""What of the motion a sheet shows: the paths of points, and positions of the mechanism, as far as it goes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.loop import whole_motion
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.traced_motion import PointPath, TracedMotion

FINE = 720  # spots of a path


def traced(scene: Scene) -> TracedMotion | None:
    """What the scene's sheet shows of its motion, from the given pose as far as the mechanism goes on its branch.

    The first drive goes through one turn, the others keep pace; one that slides goes to its limits, or where there are
    none as far as the mechanism is large. Positions are at equal travels: of a full turn the given pose is the first,
    between limits both ends are positions. None where nothing is asked for. Fails with `Refused` where the mechanism
    cannot be followed.
    """
    wanted, count = scene.sheet.curves, scene.sheet.positions
    if not (wanted or count):
        return None
    try:
        motion = whole_motion(scene)
    except Refused as refused:
        raise Refused(f"sheet.{'curves' if wanted else 'positions'}", refused.why, "leave it out") from None
    low, high = (float(motion.path.travel[end]) for end in (0, -1))
    fine, even = _between(low, high), np.linspace(low, high, count, endpoint=not motion.whole)
    turn = motion.turn(np.concatenate([fine, even]))
    stops = motion.path.lower is not None, motion.path.upper is not None
    paths = [path for name in wanted for path in _paths(name, turn.points[name][: fine.size], stops)]
    reached = np.flatnonzero(np.all([np.isfinite(z[fine.size :]) for z in turn.points.values()], axis=0)) + fine.size
    return TracedMotion(tuple(paths), tuple({name: _spot(z[k]) for name, z in turn.points.items()} for k in reached))


def _between(low: float, high: float) -> Array:
    """Travels from end to end, nearer to each other at the ends: there a pose changes with the root of the travel."""
    part = (1 - np.cos(np.linspace(0, np.pi, FINE))) / 2
    return np.clip(low + (high - low) * part, low, high)


def _paths(name: str, places: Array, stops: tuple[bool, bool]) -> Iterator[PointPath]:
    """The path of a point, in parts where poses between are not reached."""
    known = np.flatnonzero(np.isfinite(places))
    for part in np.split(known, np.flatnonzero(np.diff(known) > 1) + 1):
        if part.size > 1:
            ends = bool(stops[0] and part[0] == 0), bool(stops[1] and part[-1] == places.size - 1)
            yield PointPath(name, tuple(map(_spot, places[part])), ends)


def _spot(place: complex) -> Spot:
    return float(place.real), float(place.imag)
