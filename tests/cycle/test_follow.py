"""The cycle: every pose on the given pose's branch, rigid, and honest about what cannot be reached."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from claims_of_motion import ROUNDING, assert_holds_together, assert_same, place, reached
from random_mechanisms import GROUPS, mechanism

import graphplan as gp

follow = gp.cycle.follow
CASES = Path(__file__).parents[1] / "cases" / "cycle"
ROCKER = gp.load(CASES / "rocker.toml")


def four_bar(crank: float, coupler: float, rocker: float, ground: float, angle: float, side: str = "left") -> gp.Scene:
    """A four-bar linkage O A B C with its crank at this angle, in degrees."""
    scene = ROCKER.replace("points.A", {"from": "O", "distance": crank, "angle": angle}).replace(
        "points.C", [ground, 0])
    return scene.replace("points.B", {"distances": {"A": coupler, "C": rocker}, "side": side})


@cache
def sound(group: str, count: int) -> list[gp.Scene]:
    """The first random mechanisms with a crank and this group whose drive determines their motion.

    Every moving link has one more point of its own, so that its turning shows.
    """
    found: list[gp.Scene] = []
    for seed in range(10 * count):
        scene = mechanism([group], seed)
        more = {f"X{link}": (Fraction(7 * i), Fraction(50)) for i, link in enumerate(scene.moving)}
        links = {link: (*points, *({f"X{link}"} & more.keys())) for link, points in scene.links.items()}
        scene = replace(scene, points=scene.points | more, links=links)
        try:
            follow(scene, 1)
        except gp.GraphplanError:
            continue
        found.append(scene)
    return found[:count]


@pytest.mark.parametrize("group", sorted(GROUPS))
def test_random_cycles_hold_together(group: str) -> None:
    """Whatever is hung on a crank holds together around its cycle, and does not depend on how many poses there are."""
    for scene in sound(group, 2):
        turn = follow(scene, 24)
        assert_holds_together(scene, turn)
        assert_same(turn, follow(scene, 48), scene, every=2)


@pytest.mark.parametrize("scene", [gp.load("alt-eight-link-2"), gp.load("shaper"), ROCKER,
                                   *(scene for group in ("rrp", "rpr", "prp", "rpp") for scene in sound(group, 1))],
                         ids=["turning", "sliding", "rocking", "rrp", "rpr", "prp", "rpp"])
def test_many_poses_are_placed_as_few_are(scene: gp.Scene) -> None:
    """Thousands of poses, block after block and each dyad by its compass rule, hold together as well as a few, and
    contain the same."""
    few = follow(scene, 45)
    for compiled in (False, *([True] if find_spec("numba") and scene is ROCKER else [])):
        many = follow(scene, 4500, compiled=compiled)
        assert_holds_together(scene, many)
        assert_same(few, many, scene, every=100)


@pytest.mark.parametrize("short", [2**-4, 2**-12, 2**-20])
def test_a_gap_between_two_positions_stops_the_motion(short: float) -> None:
    """An arc that cannot be assembled is not leapt, however narrow: nothing behind it is reached that way."""
    crank, ground, angle = 50, 60, 48.75
    scene = four_bar(crank, 50, crank + ground - 50 - short, ground, angle)
    reach = math.acos((crank**2 + ground**2 - (crank + ground - short) ** 2) / (2 * crank * ground))
    turn = follow(scene, 9, (0, 300))
    apart = np.abs(np.degrees(turn.travel) + angle - 180)
    assert np.min(apart) > 180 - math.degrees(reach)  # the gap lies between two positions
    assert set(reached(turn)) == set(np.flatnonzero(np.degrees(turn.travel) + angle < math.degrees(reach)))


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link-2", "alt-ten-link-2", "shaper"])
def test_a_crank_that_turns_all_the_way_comes_back(name: str) -> None:
    """The pose at 360 degrees is the one at 0, none between is at fault, and going back is going round."""
    scene = gp.load(name)
    turn, back = follow(scene, 91, (0, 360)), follow(scene, 91, (-360, 0))
    assert not turn.faults
    for point, values in turn.points.items():
        assert abs(values[-1] - values[0]) <= 1e-11 * scene.extent
        assert np.all(np.abs(values - back.points[point]) <= 1e-11 * scene.extent)


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link-2", "walschaerts-loaded"])
def test_a_place_next_to_the_given_pose_is_reached(name: str) -> None:
    """However short the way is, what rounding does to it is no limit of the motion; one position is the given pose."""
    scene = gp.load(name)
    assert not any(follow(scene, 1, (way * 10.0**-k,) * 2).faults for k in range(6, 16) for way in (1, -1))
    turn = follow(scene, 1)
    assert not turn.faults
    assert all(abs(turn.points[p][0] - place(scene, p)) <= ROUNDING * scene.extent for p in scene.points)


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_rocking_four_bar_tells_its_limits(side: str) -> None:
    """Where coupler and rocker stretch out the crank turns back: just what the cosine rule allows is reached."""
    crank, coupler, rocker, ground, angle = 50, 40, 45, 60, 30
    far = math.acos((crank**2 + ground**2 - (coupler + rocker) ** 2) / (2 * crank * ground))
    turn = follow(four_bar(crank, coupler, rocker, ground, angle, side), 360)
    inside = np.cos(turn.travel + math.radians(angle)) > math.cos(far)
    assert set(turn.faults) == set(map(int, np.flatnonzero(~inside)))
    assert np.array_equal(np.isnan(turn.points["B"]), ~inside)
    up, down = math.degrees(far) - angle, 360 - math.degrees(far) - angle
    for pose, line in turn.faults.items():
        nearest = min(abs(limit - pose) for limit in (up, down))  # halfway between them it may be either
        assert line in [f"at {pose} degrees: links 2 and 3 cannot be assembled: the circles about A and C do not meet "
                        f"(limit position near {limit:.4g} degrees)"
                        for limit in (up, down) if math.isclose(abs(limit - pose), nearest)]


def test_a_limit_has_a_pose_but_no_velocities() -> None:
    """A span that ends in a dead centre ends with a pose, links stretched out, and a fault that says what it lacks."""
    far = math.degrees(math.acos((50**2 + 60**2 - 85**2) / (2 * 50 * 60)))
    turn = follow(ROCKER, 5, (0, far - 30))
    assert list(turn.faults) == [4]
    assert turn.faults[4].endswith("links 2 and 3 are in a limit position: they have no velocities")
    assert abs(turn.points["A"][4]) == pytest.approx(50)
    assert abs(turn.points["A"][4] - 60) == pytest.approx(85, rel=1e-9)
    assert abs(turn.points["B"][4] - 60) == pytest.approx(45)


def test_what_lies_behind_a_limit_is_not_reached() -> None:
    """A crank that can be assembled in two arcs stays in that of its given pose."""
    turn = follow(four_bar(50, 60, 30, 60, 80), 720)
    apart = np.abs(50 * np.exp(1j * (turn.travel + math.radians(80))) - 60)
    drawable = (apart < 90) & (apart > 30)
    arc = (turn.travel + math.radians(80)) % (2 * math.pi) < math.pi
    assert set(reached(turn)) < set(np.flatnonzero(drawable))
    assert set(reached(turn)) == set(np.flatnonzero(drawable & arc))
    assert any("cannot come there from the given pose" in line for line in turn.faults.values())


def test_a_change_point_stops_the_motion() -> None:
    """A parallelogram with its links in line could go on as an antiparallelogram: the lengths do not say how."""
    turn = follow(four_bar(30, 80, 30, 80, 60), 360)
    assert set(reached(turn)) == {*range(121), *range(300, 360)}
    assert "links 2 and 3 are in a change point: the drive does not say how they move on" in turn.faults[120]
    assert turn.faults[200].endswith("(change point near 120 degrees)")
    ends = turn.points["B"][[0, 60, 119, 301]] - turn.points["A"][[0, 60, 119, 301]]
    assert np.allclose(ends, 80, rtol=1e-12, atol=0)


def test_a_given_dead_centre_is_the_only_pose() -> None:
    """From a singular pose nothing leads on, either way; the pose itself stands as it was given."""
    turn = follow(gp.load(CASES / "in-line.toml"), 8)
    assert list(reached(turn)) == [0]
    assert turn.points["B"][0] == 80
    assert set(turn.faults) == set(range(8))


@pytest.mark.parametrize("omega", [3, 0, -3])
def test_travel_counts_as_the_drive_moves(omega: int) -> None:
    """The crank goes by its travel in the sense of its omega, and from rest counter-clockwise."""
    scene = ROCKER.replace("drive.0.omega", omega)
    turn, sense = follow(scene, 9, (-40, 40)), -1 if omega < 0 else 1
    angles = np.radians(30 + sense * np.linspace(-40, 40, 9))
    assert np.allclose(turn.points["A"], 50 * np.exp(1j * angles))
    there = gp.at(scene, 40)
    assert abs(place(there, "A") - turn.points["A"][-1]) < 1e-12


def test_drives_keep_pace() -> None:
    """The second crank of the five-bar turns back as fast as the first turns on; a span has both its ends."""
    scene = gp.load("five-bar")
    turn = follow(scene, 31, (-10, 20))
    assert np.allclose(np.degrees(turn.travel), np.arange(-10, 21))
    A, B = (turn.points[p] - place(scene, q) for p, q in (("A", "O"), ("B", "P")))
    assert np.allclose(A, place(scene, "A") * np.exp(1j * turn.travel))
    assert np.allclose(B, (place(scene, "B") - place(scene, "P")) * np.exp(-1j * turn.travel))
    turn = follow(scene.replace("drive.0.omega", 0).replace("drive.1.omega", 0), 12, (0, 11))
    assert np.all(turn.points["B"] == place(scene, "B"))
    assert np.allclose(turn.points["A"], place(scene, "A") * np.exp(1j * turn.travel))


def test_sliding_drives_travel_in_lengths() -> None:
    """The rod of the plough's cylinder, which its drive draws in, goes in by the travel; a block that is driven back
    goes as far as the travel says, and points on no link stand still."""
    turn = follow(gp.load("plough-lift"), 9, (-8, 8))
    assert np.allclose(np.abs(turn.points["B"] - turn.points["A"]), 104 - turn.travel, rtol=1e-13, atol=0)
    assert not turn.faults
    scene = gp.load(CASES / "ram.toml")
    turn = follow(scene, 9, (-3, 5))
    assert not turn.faults
    assert_holds_together(scene, turn)
    assert np.all(turn.points["Z"] == 4 + 3j)
    assert np.allclose(turn.points["B"], 80 + 60j - turn.travel * (0.8 + 0.6j), rtol=1e-14, atol=0)


@pytest.mark.parametrize(("scene", "closed"), [
    (gp.load("alt-eight-link-2"), True), (ROCKER, False), (gp.load("five-bar"), True),
    (gp.load(CASES / "crank.toml"), True)], ids=["turning", "rocking", "two drives", "crank"])
def test_whether_a_cycle_closes(scene: gp.Scene, closed: bool) -> None:
    """After a full turn all is as it was where every crank turns all the way; a span says nothing of it."""
    assert follow(scene, 12).closed is closed
    assert not follow(scene, 12, (0, 360)).closed


def test_a_block_that_runs_to_infinity_stops_at_its_limit() -> None:
    """A slot turns parallel to the guide of its block: the limit is as near as the determinant tells, 2^-22 of it; and
    where nothing is to be closed the drive alone says where all is."""
    slot = gp.load(CASES / "slot.toml")
    turn = follow(slot, 3, (-45 + 1e-5, 135 - 1e-5))
    assert not turn.faults
    assert np.allclose(turn.points["B"], 1 / np.tan(turn.travel + np.pi / 4) + 1j)
    assert set(follow(slot, 2, (-45 + 9e-6, 135 - 9e-6)).faults) == {0, 1}
    turn = follow(gp.load(CASES / "crank.toml"), 8)
    assert np.allclose(turn.points["A"], 1 + 2j + (3 + 4j) * np.exp(1j * turn.travel), rtol=1e-15, atol=0)


def test_progress_is_told() -> None:
    """Who asks for it hears how far the path is followed, up to the whole."""
    told: list[float] = []
    follow(gp.load("four-bar"), 12, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1
