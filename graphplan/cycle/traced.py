"""What of the motion a sheet shows: the paths of points, and positions of the mechanism, as far as it goes."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from graphplan.cycle.centrodes import branches, parted
from graphplan.cycle.linkage import Array
from graphplan.cycle.loop import whole_motion
from graphplan.cycle.stationary import stationary
from graphplan.cycle.tolerances import POLE_TOL
from graphplan.cycle.turn import RangeOfMotion
from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.travel import TURN
from graphplan.phrases import said
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.traced_motion import Centrode, PointPath, StationaryCurve, TracedMotion

FINE = 720  # spots of a path, in each turn
AWAY = 4.0  # of the mechanism's half extent: so far from its middle a centrode is drawn


def traced(scene: Scene) -> TracedMotion | None:
    """What the scene's sheet shows of its motion, from the given pose as far as the mechanism goes on its branch.

    The first drive goes through one turn, the others keep pace; one that slides goes to its limits, or where there are
    none as far as the mechanism is large. Positions are at equal travels: of a full turn the given pose is the first,
    between limits both ends are positions. None where nothing is asked for. Fails with `Refused` where the mechanism
    cannot be followed.
    """
    wanted, count, rolling = scene.sheet.curves, scene.sheet.positions, scene.sheet.centrodes
    if not (wanted or count or rolling or scene.sheet.cubics):
        return None
    try:
        motion = whole_motion(scene)
    except Refused as refused:
        key = "curves" if wanted else "centrodes" if rolling else "positions" if count else "cubics"
        raise Refused(f"sheet.{key}", refused.why, "leave it out") from None
    low, high = (float(motion.path.travel[end]) for end in (0, -1))
    turns = 1 if scene.drives[0].slides else max(1, round((high - low) / TURN))
    fine, even = _between(low, high, turns), np.linspace(low, high, count, endpoint=not motion.whole)
    turn = motion.turn(np.concatenate([fine, even]))
    stops = motion.path.lower is not None, motion.path.upper is not None
    paths = [path for name in wanted for path in _paths(name, turn.points[name][: fine.size], stops)]
    reached = np.flatnonzero(np.all([np.isfinite(z[fine.size :]) for z in turn.points.values()], axis=0)) + fine.size
    positions = tuple({name: _spot(z[k]) for name, z in turn.points.items()} for k in reached)
    centrodes = tuple(one for links in rolling for one in _centrodes(motion, links, fine))
    cubics = (one for link in scene.sheet.cubics for one in _cubics(motion, link))
    return TracedMotion(tuple(paths), positions, (*centrodes, *cubics))


def _between(low: float, high: float, turns: int) -> Array:
    """Travels from end to end, nearer to each other at the ends: there a pose changes with the root of the travel."""
    part = (1 - np.cos(np.linspace(0, np.pi, FINE * turns))) / 2
    return np.clip(low + (high - low) * part, low, high)


def _paths(name: str, places: Array, stops: tuple[bool, bool]) -> Iterator[PointPath]:
    """The path of a point, in parts where poses between are not reached."""
    known = np.flatnonzero(np.isfinite(places))
    for part in np.split(known, np.flatnonzero(np.diff(known) > 1) + 1):
        if part.size > 1:
            ends = bool(stops[0] and part[0] == 0), bool(stops[1] and part[-1] == places.size - 1)
            yield PointPath(name, tuple(map(_spot, places[part])), ends)


def _centrodes(motion: RangeOfMotion, links: str, travel: Array) -> Iterator[Centrode]:
    """The fixed and the moving centrode of a link and one that it moves on."""
    link, on = links.split()
    middle, far = _reach(motion)
    found = branches(motion, link, on, travel, middle, far)
    if found is None:
        why = said("links {0} and {1} turn alike: their pole stays at infinity", link, on)
        raise Refused("sheet.centrodes", why, "leave it out")
    for own, parts in zip((on, link), found, strict=True):
        spots = tuple(tuple(map(_spot, _whole(part, far))) for part in parts)
        yield Centrode(links, own == link, spots, own, () if own == FRAME else tuple(_carriers(motion, own)))


def _cubics(motion: RangeOfMotion, link: str) -> Iterator[StationaryCurve]:
    """The points of a link that keep the curvature of their paths in the given pose, and their centres."""
    found = stationary(motion, link)
    if found is None:
        why = said("link {0} does not turn on the frame in this pose, or does not go on to both sides", link)
        raise Refused("sheet.cubics", why, "leave it out")
    middle, far = _reach(motion)
    for moving, places in zip((True, False), found, strict=True):
        closed = np.append(places, places[0])
        parts = parted(closed, middle, far / 2, far / 32)
        spots = tuple(tuple(map(_spot, part)) for part in parts)
        yield StationaryCurve(f"{link} {FRAME}", moving, spots, link, tuple(_carriers(motion, link)))


def _reach(motion: RangeOfMotion) -> tuple[complex, float]:
    """The middle of the mechanism as it is given, and how far from there a curve is drawn."""
    places = np.array([*motion.linkage.places.values()])
    middle = complex(np.ptp(places.real) / 2 + places.real.min(), np.ptp(places.imag) / 2 + places.imag.min())
    return middle, AWAY * float(np.abs(places - middle).max())


def _carriers(motion: RangeOfMotion, link: str) -> Iterator[tuple[str, Spot]]:
    """A point of a link, and of it, or of one that turns alike, the two that lie farthest apart; as they are given."""
    places, pin = motion.linkage.places, motion.linkage.points(link)[0]
    bars = (ends for one in motion.scene.turning_alike(link) for ends in combinations(motion.linkage.points(one), 2))
    bar = max(bars, key=lambda ends: abs(places[ends[1]] - places[ends[0]]), default=())
    yield from ((name, _spot(places[name])) for name in (pin, *bar))


def _whole(part: Array, far: float) -> Array:
    """A branch; one spot of it where the pole stays in one place."""
    return part[:1] if np.abs(part - part[0]).max() < POLE_TOL * far else part


def _spot(place: complex) -> Spot:
    return float(place.real), float(place.imag)
