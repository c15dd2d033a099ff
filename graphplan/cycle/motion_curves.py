"""What of the motion a sheet shows: paths of points, positions, centrodes, and cubics of stationary curvature.

Centrodes are the paths of a link's pole relative to another, on the one and on the other, from the links' rates. The
fixed centrode lies on the link that is moved on, the moving one on the link that moves; the moving one rolls on the
fixed one. Where the two links turn alike the pole is at infinity: a centrode has branches, which no line joins.

The cubic of stationary curvature has the points of a link whose paths keep their curvature to third order. With the
link's angle as the time, the pole P as the origin and A the vector to the inflection pole, the acceleration of the
point z of the link is A - z and its jerk J - i z. That the curvature of its path does not change leaves of each ray
through P, of the direction u, one point (Mueller):

    r = 3 (u x A) (u . A) / (u . J + 3 u x A)

These are the circling points. The centres of curvature of their paths, by Euler and Savary, are the centre points. A
and J follow from how the pole wanders: A = -i P' and J = P' - i P''.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.positions import MovingLink
from graphplan.cycle.tolerances import POLE_TOL, RATE_STEP, TURNING_TOL
from graphplan.cycle.turn import RangeOfMotion, whole_motion
from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.travel import TURN
from graphplan.phrases import said
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.traced_motion import Centrode, PointPath, StationaryCurve, TracedMotion

PATH_SPOTS = 720  # spots of a path, in each turn
CENTRODE_REACH = 4.0  # of the mechanism's half extent: so far from its middle a centrode is drawn


def traced_motion(scene: Scene) -> TracedMotion | None:
    """The part of the motion that the scene's sheet shows, from the given pose as far as the mechanism goes on its
    branch; None if the sheet shows no motion.

    The first drive goes through one turn, the others keep pace; one that slides goes to its limits, or without limits
    as far as the mechanism is large. Positions are at equal travels: of a full turn the given pose is the first,
    between limits both ends are positions.
    """
    curves, count, rolling = scene.sheet.curves, scene.sheet.positions, scene.sheet.centrodes
    if not scene.sheet.shows_motion:
        return None
    try:
        motion = whole_motion(scene)
    except Refused as refused:
        key = "curves" if curves else "centrodes" if rolling else "positions" if count else "cubics"
        raise Refused(f"sheet.{key}", refused.why, "leave it out") from None
    low, high = motion.ends
    turns = 1 if scene.drives[0].slides else max(1, round((high - low) / TURN))
    fine, even = _dense_travels(low, high, turns), np.linspace(low, high, count, endpoint=not motion.goes_round)
    turn = motion.turn(np.concatenate([fine, even]))
    stops = motion.path.lower is not None, motion.path.upper is not None
    paths = [path for name in curves for path in _point_paths(name, turn.points[name][: fine.size], stops)]
    reached = np.flatnonzero(np.all([np.isfinite(z[fine.size :]) for z in turn.points.values()], axis=0)) + fine.size
    positions = tuple({name: _spot(z[k]) for name, z in turn.points.items()} for k in reached)
    centrodes = tuple(curve for links in rolling for curve in _centrodes(motion, links, fine))
    cubics = (curve for link in scene.sheet.cubics for curve in _cubics(motion, link))
    return TracedMotion(tuple(paths), positions, (*centrodes, *cubics))


def _dense_travels(low: float, high: float, turns: int) -> Array:
    """Travels from end to end, nearer to each other at the ends: there a pose changes with the root of the travel."""
    fractions = (1 - np.cos(np.linspace(0, np.pi, PATH_SPOTS * turns))) / 2
    return np.clip(low + (high - low) * fractions, low, high)


def _point_paths(name: str, places: Array, stops: tuple[bool, bool]) -> Iterator[PointPath]:
    """The path of a point, in parts where poses between are not reached."""
    reached = np.flatnonzero(np.isfinite(places))
    for stretch in np.split(reached, np.flatnonzero(np.diff(reached) > 1) + 1):
        if stretch.size > 1:
            ends = bool(stops[0] and stretch[0] == 0), bool(stops[1] and stretch[-1] == places.size - 1)
            yield PointPath(name, tuple(map(_spot, places[stretch])), ends)


def _centrodes(motion: RangeOfMotion, links: str, travel: Array) -> Iterator[Centrode]:
    """The fixed and the moving centrode of a link and one that it moves on."""
    link, on = pair = motion.scene.link_pair(links)
    middle, far = _reach(motion)
    curves = centrode_branches(motion, link, on, travel, middle, far)
    if curves is None:
        why = said("links {0} and {1} turn alike: their pole stays at infinity", link, on)
        raise Refused("sheet.centrodes", why, "leave it out")
    for carrier, stretches in zip((on, link), curves, strict=True):
        spots = tuple(tuple(map(_spot, _reduce_fixed_branch(stretch, far))) for stretch in stretches)
        yield Centrode(pair, carrier == link, spots, carrier, () if carrier == FRAME
                       else tuple(_carriers(motion, carrier)))


def _cubics(motion: RangeOfMotion, link: str) -> Iterator[StationaryCurve]:
    """The points of a link that keep the curvature of their paths in the given pose, and their centres."""
    curves = stationary_curvature(motion, link)
    if curves is None:
        why = said("link {0} does not turn on the frame in this pose, or does not go on to both sides", link)
        raise Refused("sheet.cubics", why, "leave it out")
    middle, far = _reach(motion)
    for moving, places in zip((True, False), curves, strict=True):
        closed = np.append(places, places[0])
        stretches = split_stretches(closed, middle, far / 2, far / 32)
        spots = tuple(tuple(map(_spot, stretch)) for stretch in stretches)
        yield StationaryCurve((link, FRAME), moving, spots, link, tuple(_carriers(motion, link)))


def _reach(motion: RangeOfMotion) -> tuple[complex, float]:
    """The middle of the mechanism as it is given, and how far from there a curve is drawn."""
    places = np.array([*motion.linkage.places.values()])
    middle = complex(np.ptp(places.real) / 2 + places.real.min(), np.ptp(places.imag) / 2 + places.imag.min())
    return middle, CENTRODE_REACH * float(np.abs(places - middle).max())


def _carriers(motion: RangeOfMotion, link: str) -> Iterator[tuple[str, Spot]]:
    """A point of a link, and of it, or of one that turns alike, the two that lie farthest apart; as they are given."""
    places, pin = motion.linkage.places, motion.linkage.points(link)[0]
    bars = (ends for alike in motion.scene.turning_alike(link)
            for ends in combinations(motion.linkage.points(alike), 2))
    bar = max(bars, key=lambda ends: abs(places[ends[1]] - places[ends[0]]), default=())
    yield from ((name, _spot(places[name])) for name in (pin, *bar))


def _reduce_fixed_branch(part: Array, far: float) -> Array:
    """A branch; one spot of it where the pole stays in one place."""
    return part[:1] if np.abs(part - part[0]).max() < POLE_TOL * far else part


def _spot(place: complex) -> Spot:
    return float(place.real), float(place.imag)


# ---- centrodes: the paths of a link's pole on two links --------------------------------------------------------------


MAX_HALVINGS = 12
"""How often the travel between two poles is halved at most."""

CHORDS = 256
"""How many of the longest chords that are drawn reach as far as a centrode is drawn."""


class Centrodes(NamedTuple):
    """The poles of a link relative to another in n poses, both links as they were given: on the other one (`fixed`) and
    on itself (`moving`), complex arrays of shape (n,), nan where there is no pole."""

    fixed: Array
    moving: Array


def centrodes(links: Mapping[str, MovingLink], link: str, on: str) -> Centrodes:
    """The centrodes of a link that moves relative to another."""
    moving, fixed = links[link], links[on]
    turning, slip = moving.spin - fixed.spin, moving.velocity - fixed.velocity_at(moving.base)
    turning = np.where(np.abs(turning) > TURNING_TOL * (np.abs(moving.spin) + np.abs(fixed.spin)), turning, np.nan)
    with np.errstate(all="ignore"):
        pole = moving.base + 1j * slip / turning
    return Centrodes(fixed.carried_back(pole), moving.carried_back(pole))


def sheet_centrodes(motion: RangeOfMotion, travel: Array) -> dict[str, Centrodes]:
    """The centrodes that the scene's sheet asks for at these travels, by the names of the two links."""
    pairs = motion.scene.sheet.centrodes
    links = motion.links_at(travel) if pairs else {}
    return {names: centrodes(links, *motion.scene.link_pair(names)) for names in pairs}


def centrode_branches(motion: RangeOfMotion, link: str, on: str, travel: Array, middle: complex,
                      far: float) -> tuple[list[Array], list[Array]] | None:
    """The branches of the fixed and of the moving centrode, as far as they are no further from the middle; complex
    arrays. None where the two links turn alike all the way.

    `travel` grows. Between poles that lie too far apart for a chord more are sought; where even the finest travel does
    not bring them together, they lie on two branches.
    """
    longest, poles = far / CHORDS, centrodes(motion.links_at(travel), link, on)
    if np.isnan(poles.fixed).all():
        return None
    for _ in range(MAX_HALVINGS):
        wide = np.any([_near_chords(places, middle, far) & ~(np.abs(np.diff(places)) <= longest) for places in poles],
                      axis=0)
        between = (travel[1:] + travel[:-1])[wide] / 2
        if not between.size:
            break
        order = np.argsort(np.concatenate([travel, between]), kind="stable")
        more = centrodes(motion.links_at(between), link, on)
        travel = np.concatenate([travel, between])[order]
        poles = Centrodes(*(np.concatenate(pair)[order] for pair in zip(poles, more, strict=True)))
    fixed, moving = ([*split_stretches(places, middle, far, longest)] for places in poles)
    return fixed, moving


def _near_chords(places: Array, middle: complex, far: float) -> Array:
    """Between which places a curve may be near enough to be drawn: one of the two is."""
    near = np.abs(places - middle) <= far
    return near[1:] | near[:-1]


def split_stretches(places: Array, middle: complex, far: float, longest: float) -> Iterator[Array]:
    """The stretches of a curve that are near and whole."""
    near = np.abs(places - middle) <= far
    joined = near[1:] & near[:-1] & (np.abs(np.diff(places)) <= longest)
    for stretch in np.split(np.arange(places.size), np.flatnonzero(~joined) + 1):
        if stretch.size > 1:
            yield places[stretch]


# ---- the cubic of stationary curvature -------------------------------------------------------------------------------


RAYS = 7200  # of half a turn
FIRST_DIFFERENCE, SECOND_DIFFERENCE = np.array([1, -8, 0, 8, -1]) / 12, np.array([-1, 16, -30, 16, -1]) / 12


def stationary_curvature(motion: RangeOfMotion, link: str) -> tuple[Array, Array] | None:
    """The circling points of a link in the given pose and their centres, ray by ray; complex arrays of shape (n,).

    None where the link does not turn there, or the mechanism does not move on to both sides.
    """
    whole = float(np.ptp(motion.path.travel))
    step = RATE_STEP * whole
    travel = step * np.arange(-2, 3)
    links = motion.links_at(travel % whole if motion.goes_round else travel)
    spin, poles = links[link].spin, centrodes(links, link, FRAME).fixed
    with np.errstate(all="ignore"):
        wander = (FIRST_DIFFERENCE @ poles) / step / spin[2]
        bent = ((SECOND_DIFFERENCE @ poles) / step**2 - wander * (FIRST_DIFFERENCE @ spin) / step) / spin[2] ** 2
        A, J, rays = -1j * wander, wander - 1j * bent, np.exp(1j * np.linspace(0, np.pi, RAYS, endpoint=False))
        along, across, jerk = ((rays.conj() * A).real, (rays.conj() * A).imag, (rays.conj() * J).real)
        far = 3 * across * along / (jerk + 3 * across)
        centres = far * along / (along - far)
    if not (np.isfinite(A) and np.isfinite(J)):
        return None
    return poles[2] + far * rays, poles[2] + centres * rays
