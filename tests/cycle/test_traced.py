"""What a sheet shows of the motion: paths through the given pose, at rigid distances, as far as the mechanism goes."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations

import four_bars
import numpy as np
import pytest
from packaged_scenes import those

from graphplan import load, parse
from graphplan.cycle import follow
from graphplan.cycle.motion_curves import traced_motion
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.replaced import guides
from graphplan.sheet.plates.traced_motion import TracedMotion

ROUNDING = 1e-12


def shown(scene: Scene, *points: str, positions: int = 0) -> TracedMotion:
    """What is shown of a scene whose sheet asks for these paths, all of them without any, and positions."""
    wanted = points or tuple(scene.points)
    found = traced_motion(replace(scene, sheet=replace(scene.sheet, curves=wanted, positions=positions)))
    assert found
    return found


def complexes(motion: TracedMotion) -> dict[str, np.ndarray]:
    """The paths as complex arrays by point."""
    return {path.point: np.array([complex(*spot) for spot in path.spots]) for path in motion.paths}


def riding(scene: Scene) -> set[str]:
    """The points of guides that mark the place under a sliding point: they go with it."""
    return {point for slide in guides(scene).values() for point in scene.links.get(slide.along, ())
            if scene.points[point] == scene.points[slide.at] and len(scene.links_of[point]) == 1}


DRIVEN = those(lambda scene: scene.drives and not scene.motions)


@pytest.mark.parametrize("name", DRIVEN)
def test_paths_are_those_of_rigid_links_through_the_given_pose(name: str) -> None:
    """All paths have one spot for each pose: points of a link keep their distances, and the given pose is among them.
    """
    scene = load(name)
    given = {point: complex(*map(float, at)) for point, at in scene.points.items()}
    paths, size = complexes(shown(scene)), max(abs(p - q) for p, q in combinations(given.values(), 2))
    together = np.max([np.abs(z - given[point]) for point, z in paths.items()], axis=0)
    steps = np.max([np.abs(np.diff(z)).max() for z in paths.values()])
    assert together.min() <= steps
    for link in scene.links.values():
        for p, q in combinations([point for point in link if point not in riding(scene)], 2):
            apart = np.abs(paths[p] - paths[q]) - abs(given[p] - given[q])
            assert np.abs(apart).max() <= ROUNDING * size * 100, (p, q)


def test_a_path_closes_where_the_crank_goes_round() -> None:
    """After a turn M is back; on the way it is where the cycle has it."""
    scene = load("four-bar")
    path = shown(scene, "M").paths[0]
    assert math.dist(path.spots[0], path.spots[-1]) < 1e-9
    assert path.stops == (False, False)
    spots = np.array([complex(*spot) for spot in path.spots])
    assert all(np.abs(spots - place).min() < 2 for place in follow(scene, 24).points["M"])


def test_a_path_ends_where_the_motion_stops() -> None:
    """Between two dead centres a path has two ends, coupler and rocker in line in both."""
    scene = parse(four_bars.four_bar(A="[30, 40]", B='{ distances = { A = 40, C = 45 }, side = "left" }', C="[60, 0]"),
                  "rocking")
    motion = shown(scene, positions=5)
    ends = {path.point: (path.spots[0], path.spots[-1]) for path in motion.paths}
    assert all(path.stops == (True, True) for path in motion.paths)
    assert [math.dist(ends["A"][end], ends["C"][end]) for end in (0, 1)] == pytest.approx([85, 85])
    assert len(motion.positions) == 5
    assert [math.dist(motion.positions[k]["A"], (60, 0)) for k in (0, -1)] == pytest.approx([85, 85])


def test_a_sliding_drive_goes_to_its_limits() -> None:
    """A cylinder has no turn: its pistons' points go from limit to limit."""
    assert all(path.stops == (True, True) for path in shown(load("plough-lift"), "B", "T").paths)


def test_the_other_drive_keeps_pace() -> None:
    """Of two drives the first goes through one turn: the second, which runs backwards as fast, is back with it."""
    scene = load("five-bar")
    first, second = (float(drive.rate) for drive in scene.drives)
    path = complexes(shown(scene, "C" if "C" in scene.points else "B"))
    turn = follow(scene, 9, (0, 360))
    for point, spots in path.items():
        assert np.abs(turn.points[point][:, None] - spots[None]).min(axis=1).max() < 3
    assert first
    assert second


def test_positions_stand_at_equal_travels() -> None:
    """Twelve positions of a crank that goes round are thirty degrees apart, the given one first."""
    positions = shown(load("four-bar"), "A", positions=12).positions
    angles = np.unwrap([math.atan2(*reversed(position["A"])) for position in positions])
    assert np.diff(angles) == pytest.approx(np.full(11, math.pi / 6))
    assert positions[0]["A"] == pytest.approx((20, 110))


def test_what_is_not_asked_for_is_not_followed() -> None:
    """A sheet without these wishes shows nothing of the motion."""
    assert traced_motion(load("five-bar")) is None


@pytest.mark.parametrize(("scene", "why"), [
    (load("rosenauer-basic"), "the motion of points is given, for this pose alone"),
    (parse(four_bars.four_bar(A="[30, 0]", B="[80, 0]", C="[140, 0]"), "in line"),
     "the mechanism does not move on from the given pose"),
])
def test_what_cannot_be_followed_is_refused(scene: Scene, why: str) -> None:
    """One line says why."""
    with pytest.raises(Refused) as refused:
        shown(scene)
    assert str(refused.value) == f"sheet.curves: {why}; leave it out"
