"""Claims about how mechanisms move: in every pose links are rigid, slides stay on their guides, and nothing jumps."""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
from claim import claim
from face import Got

import graphplan as gp

ROUNDING = 2.0**-52
POSITIONS = 72
TRAVELS = {False: (0, 17, 145, -33), True: (0, 1, -1)}  # degrees; lengths of a drive that slides
STEP = 2.0**-10  # degrees, or of the mechanism's extent what a sliding drive goes


def driven(scene: gp.Scene) -> bool:
    """Whether drives say how a mechanism moves."""
    return bool(scene.drives and not scene.motions)


def posable(scene: gp.Scene) -> bool:
    """Whether other poses of a mechanism can be constructed: of linkages, and of trains that wheels turn by a ratio."""
    return driven(scene) and not scene.contacts and (not scene.gears or len(scene.links) < 6)


@cache
def around(name: str, positions: int = POSITIONS) -> gp.cycle.Turn:
    """The cycle of a packaged scene; a sliding drive goes a tenth of the mechanism's extent either way."""
    scene = gp.load(name)
    tenth = scene.extent / 10
    return gp.cycle.follow(scene, positions, (-tenth, tenth) if scene.drives[0].slides else None)


def place(scene: gp.Scene, point: str) -> complex:
    """Where a point is in the given pose."""
    return complex(*map(float, scene.points[point]))


def reached(turn: gp.cycle.Turn) -> Any:
    """The numbers of the poses that are reached."""
    return np.flatnonzero(~np.isnan(np.sum(list(turn.points.values()), axis=0)))


def own(scene: gp.Scene, turn: gp.cycle.Turn, link: str) -> list[str]:
    """The points of a link that stay on it, not under another link's sliding point."""
    under = {q for s in scene.slides for q in scene.links.get(s.along, ())
             if q != s.at and np.array_equal(turn.points[q], turn.points[s.at], equal_nan=True)}
    under |= {q for c in scene.contacts for q in c.through or ()  # a straight profile's point under the other's centre
              if np.array_equal(turn.points[q], turn.points[c.curved_side[2]], equal_nan=True)}
    return [point for point in scene.links.get(link, ()) if point not in under]


def turned(scene: gp.Scene, turn: gp.cycle.Turn, link: str) -> Any:
    """How far a link has turned, as a complex number of size 1: seen on two of its points, or none if it has one."""
    pairs = [*combinations(own(scene, turn, link), 2)]
    if link == "frame" or not pairs:
        return np.ones(len(turn.travel)) if link == "frame" else None
    p, q = max(pairs, key=lambda pair: abs(place(scene, pair[0]) - place(scene, pair[1])))
    return (turn.points[p] - turn.points[q]) / (place(scene, p) - place(scene, q))


def assert_holds_together(scene: gp.Scene, turn: gp.cycle.Turn) -> None:
    """Links are rigid, and slides neither turn nor leave their guides, in every pose that is reached."""
    on, slack = reached(turn), 200 * ROUNDING * scene.extent
    at = {point: values[on] for point, values in turn.points.items()}
    for link in scene.links:
        for p, q in combinations(own(scene, turn, link), 2):
            gap = abs(place(scene, p) - place(scene, q))
            assert np.all(np.abs(np.abs(at[p] - at[q]) - gap) <= slack), (link, p, q)
    for slide in scene.slides:
        one, other = (turned(scene, turn, link) for link in (slide.link, slide.along))
        if one is not None and other is not None:
            assert np.all(np.abs(one - other)[on] <= 1e4 * ROUNDING)
        if other is not None and own(scene, turn, slide.along):
            base = own(scene, turn, slide.along)[0]
            way = complex(*map(float, slide.direction)) * other[on]
            gap = at[slide.at] - at[base] - other[on] * (place(scene, slide.at) - place(scene, base))
            assert np.all(np.abs((way.conjugate() * gap).imag) <= 1e4 * ROUNDING * abs(way) * scene.extent)
            if slide.through is None and slide.along != "frame":
                assert np.allclose(turn.guides[slide.name][on], way, rtol=1e4 * ROUNDING, atol=0)


def assert_same(one: gp.cycle.Turn, other: gp.cycle.Turn, scene: gp.Scene, every: int = 1) -> None:
    """Every so-manieth pose of the other turn is this one's, and as well reached."""
    assert set(one.faults) == {i // every for i in other.faults if i % every == 0}
    for point, values in one.points.items():
        gap = np.abs(values - other.points[point][::every])
        assert np.array_equal(np.isnan(values), np.isnan(other.points[point][::every]))
        assert np.nanmax(gap) <= 1e-9 * scene.extent, point
    for slide, ways in one.guides.items():
        assert np.nanmax(np.abs(ways - other.guides[slide][::every])) <= 1e-9 * abs(ways[0])


@claim(cheap=True, having=driven)
def mechanisms_hold_together(got: Got) -> None:
    """Around the cycle all lengths and guides hold, and travel 0 is the scene's own pose."""
    scene, turn = got.scene, around(got.name)
    assert_holds_together(scene, turn)
    assert set(turn.faults) | set(map(int, reached(turn))) == set(range(POSITIONS))
    for start in np.flatnonzero(turn.travel == 0):
        assert all(abs(values[start] - place(scene, p)) <= 4 * ROUNDING * scene.extent
                   for p, values in turn.points.items())


@claim(cheap=True, having=lambda scene: driven(scene) and not scene.drives[0].slides)
def poses_do_not_depend_on_how_many_are_asked_for(got: Got) -> None:
    """Twice as many positions contain the same poses, so nothing jumps to another branch between two of them."""
    assert_same(around(got.name), around(got.name, 2 * POSITIONS), got.scene, every=2)


@claim(cheap=True, having=driven)
def points_move_off_as_the_solver_says(got: Got) -> None:
    """A little before and after the given pose points are where their velocities lead them."""
    scene = got.scene
    drive, sense = scene.drives[0], math.copysign(1, scene.drives[0].rate)
    rate = abs(float(drive.rate)) or 1.0
    step = STEP * (1.0 if not drive.slides else scene.extent / 100)
    turn = gp.cycle.follow(scene, 3, (-step, step))
    assert not turn.faults
    gone = 2 * (step if drive.slides else math.radians(step))
    stays = {point for link in scene.links for point in own(scene, turn, link)}
    velocity = gp.analytic.solve(scene).velocity
    size = max(map(abs, velocity.values())) / rate
    for point in stays & velocity.keys():
        moved = (turn.points[point][2] - turn.points[point][0]) / gone
        assert abs(moved - velocity[point] / rate) <= 1e-6 * size, (point, sense)


@claim(having=posable)
def another_pose_is_constructed_where_the_cycle_has_it(got: Got) -> None:
    """At several travels the constructed points are those that are followed, and all results are the solver's."""
    scene, met = got.scene, 0
    for travel in TRAVELS[scene.drives[0].slides]:
        try:
            posed = gp.at(scene, travel)
        except gp.Refused:
            continue
        met += 1
        data, turn = gp.solve(posed).json(), gp.cycle.follow(scene, 1, (travel, travel))
        assert data["pose"]["travel"] == travel
        for point, at in data["pose"]["points"].items():
            assert abs(complex(*at) - turn.points[point][0]) < 1e-9 * scene.extent, point
        assert data["check"].pop("position") < 1e-12
        assert max(data["check"].values(), default=0) < 1e-9
    assert met
