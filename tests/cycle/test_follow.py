"""The cycle: every pose on the given pose's branch, rigid, and honest about what cannot be reached."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from functools import cache
from importlib.util import find_spec
from typing import Any

import four_bars
import numpy as np
import pytest
from packaged_scenes import read, those
from random_mechanisms import GROUPS, mechanism

import graphplan as gp
from graphplan.cycle import Turn, follow
from graphplan.cycle.dyads import assemble
from graphplan.cycle.groups import ClosureGroup
from graphplan.cycle.linkage import Linkage
from graphplan.errors import Refused, SceneError
from graphplan.mechanism.model import FRAME, Scene, SlidingDrive
from graphplan.mechanism.structure import structure
from graphplan.mechanism.travel import paces

ROUNDING = 2.0**-52
DRIVEN = those(lambda scene: scene.drives and not scene.motions)
DYADS = ["rrr", "rrp", "rpr", "prp", "rpp"]


def four_bar(crank: float, coupler: float, rocker: float, ground: float, angle: float, side: str = "left") -> Scene:
    """A four-bar linkage O A B C with its crank at this angle, in degrees."""
    A = f'{{ from = "O", distance = {crank}, angle = {angle} }}'
    B = f'{{ distances = {{ A = {coupler}, C = {rocker} }}, side = "{side}" }}'
    return gp.parse(four_bars.four_bar("omega = 2", A=A, B=B, C=f"[{ground}, 0]"), "four-bar")


@cache
def around(name: str, positions: int) -> tuple[Scene, Turn]:
    """A packaged scene and its cycle; a sliding drive goes a tenth of the mechanism's extent either way."""
    scene = gp.load(name)
    tenth = extent(scene) / 10
    return scene, follow(scene, positions, (-tenth, tenth) if isinstance(scene.drives[0], SlidingDrive) else None)


@cache
def sound(group: str, count: int) -> list[Scene]:
    """The first random mechanisms with a crank and this group whose drive determines their motion.

    Every moving link has one more point of its own, so that its turning shows.
    """
    found: list[Scene] = []
    for seed in range(10 * count):
        try:
            scene = mechanism([group], seed)
            structure(scene)
        except SceneError:
            continue
        more = {f"X{link}": (Fraction(7 * i), Fraction(50)) for i, link in enumerate(scene.moving)}
        links = {link: (*points, *({f"X{link}"} & more.keys())) for link, points in scene.links.items()}
        found.append(replace(scene, points=scene.points | more, links=links))
    return found[:count]


def place(scene: Scene, point: str) -> complex:
    return complex(*map(float, scene.points[point]))


def extent(scene: Scene) -> float:
    return max(abs(place(scene, p) - place(scene, q)) for p in scene.points for q in scene.points)


def reached(turn: Turn) -> Any:
    """The places of the poses that are reached."""
    return np.flatnonzero(~np.isnan(np.sum(list(turn.points.values()), axis=0)))


def own(scene: Scene, turn: Turn, link: str) -> list[str]:
    """The points of a link that stay on it, not under another link's sliding point."""
    under = {q for s in scene.slides for q in scene.links.get(s.along, ())
             if q != s.at and np.array_equal(turn.points[q], turn.points[s.at], equal_nan=True)}
    under |= {q for c in scene.contacts for q in c.through or ()  # a straight profile's point under the other's centre
              if np.array_equal(turn.points[q], turn.points[c.curved_side[2]], equal_nan=True)}
    return [point for point in scene.links.get(link, ()) if point not in under]


def turned(scene: Scene, turn: Turn, link: str) -> Any:
    """How far a link has turned, as a complex number of size 1: seen on two of its points, or none if it has one."""
    pairs = [(p, q) for p in own(scene, turn, link) for q in own(scene, turn, link) if p != q]
    if link == FRAME or not pairs:
        return np.ones(len(turn.travel)) if link == FRAME else None
    p, q = max(pairs, key=lambda pair: abs(place(scene, pair[0]) - place(scene, pair[1])))
    return (turn.points[p] - turn.points[q]) / (place(scene, p) - place(scene, q))


def assert_holds_together(scene: Scene, turn: Turn) -> None:
    """Links are rigid, and slides neither turn nor leave their guides, in every pose that is reached."""
    on, slack = reached(turn), 200 * ROUNDING * extent(scene)
    at = {point: values[on] for point, values in turn.points.items()}
    for link in scene.links:
        points = own(scene, turn, link)
        for p in points:
            for q in points:
                gap = place(scene, p) - place(scene, q)
                assert np.all(np.abs(np.abs(at[p] - at[q]) - abs(gap)) <= slack), (link, p, q)
    for slide in scene.slides:
        one, other = (turned(scene, turn, link) for link in (slide.link, slide.along))
        if one is not None and other is not None:
            assert np.all(np.abs(one - other)[on] <= 1e4 * ROUNDING)
        if other is not None and own(scene, turn, slide.along):
            base = own(scene, turn, slide.along)[0]
            way = complex(*map(float, slide.direction)) * other[on]
            gap = at[slide.at] - at[base] - other[on] * (place(scene, slide.at) - place(scene, base))
            assert np.all(np.abs((way.conjugate() * gap).imag) <= 1e4 * ROUNDING * abs(way) * extent(scene))
            if slide.through is None and slide.along != FRAME:
                assert np.allclose(turn.guides[slide.name][on], way, rtol=1e4 * ROUNDING, atol=0)


def assert_same(one: Turn, other: Turn, scene: Scene, every: int = 1) -> None:
    """Every so-manieth pose of the other turn is this one's, and as well reached."""
    assert set(one.faults) == {i // every for i in other.faults if i % every == 0}
    for point, values in one.points.items():
        gap = np.abs(values - other.points[point][::every])
        assert np.array_equal(np.isnan(values), np.isnan(other.points[point][::every]))
        assert np.nanmax(gap) <= 1e-9 * extent(scene), point
    for slide, ways in one.guides.items():
        assert np.nanmax(np.abs(ways - other.guides[slide][::every])) <= 1e-9 * abs(ways[0])


@pytest.mark.parametrize("name", DRIVEN)
def test_packaged_cycles_hold_together(name: str) -> None:
    """Around every packaged scene all lengths and guides hold, and travel 0 is the scene's own pose."""
    scene, turn = around(name, 72)
    assert_holds_together(scene, turn)
    (start,) = np.flatnonzero(turn.travel == 0) if 0 in turn.travel else [None]
    assert start is None or all(
        abs(values[start] - place(scene, p)) <= 4 * ROUNDING * extent(scene) for p, values in turn.points.items())
    assert set(turn.faults) | set(map(int, reached(turn))) == set(range(72))


@pytest.mark.parametrize("name", [name for name in DRIVEN if not isinstance(read(name).drives[0], SlidingDrive)])
def test_poses_do_not_depend_on_how_many_are_asked_for(name: str) -> None:
    """Twice as many positions contain the same poses, so nothing jumps to another branch between two of them."""
    scene, turn = around(name, 72)
    assert_same(turn, around(name, 144)[1], scene, every=2)


@pytest.mark.parametrize("group", sorted(GROUPS))
def test_random_cycles_hold_together(group: str) -> None:
    """Whatever is hung on a crank holds together around its cycle, and does not depend on how many poses there are."""
    for scene in sound(group, 2):
        turn = follow(scene, 24)
        assert_holds_together(scene, turn)
        assert_same(turn, follow(scene, 48), scene, every=2)


@pytest.mark.parametrize("group", DYADS)
def test_compass_rules_place_dyads_as_newton_does(group: str) -> None:
    """Each of the five dyads is assembled by its compass rule where its closure puts it, in every pose of the path."""
    for scene in sound(group, 2):
        turn, linkage = follow(scene, 48), Linkage(scene, paces(scene))
        groups = [ClosureGroup(linkage, part) for part in linkage.parts]
        placed, failures = assemble(linkage, groups, turn.travel)
        assert placed.keys() == set(scene.links)
        on = reached(turn)
        assert not any(missing[on].any() for _, missing in failures)
        for point, links in scene.links_of.items():
            gap = placed[links[0]].point(place(scene, point)) - turn.points[point]
            assert np.all(np.abs(gap[on]) <= 1e-9 * extent(scene)), (group, point)


@pytest.mark.parametrize("scene", [gp.load("alt-eight-link-2"), gp.load("shaper"), four_bar(50, 40, 45, 60, 30)],
                         ids=["turning", "sliding", "rocking"])
def test_many_poses_are_placed_as_few_are(scene: Scene) -> None:
    """Thousands of poses, block after block, hold together as well as a few, and contain the same."""
    few = follow(scene, 45)
    for compiled in (False, *([True] if find_spec("numba") else [])):
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


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link-2", "double-butterfly"])
def test_neighbours_close_with_their_number(name: str) -> None:
    """Twice as many poses lie half as far apart: the motion is continuous."""
    gaps = [max(np.max(np.abs(np.diff(values))) for values in around(name, n)[1].points.values()) for n in (72, 144)]
    assert gaps[1] < 0.6 * gaps[0]


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link-2", "alt-ten-link-2", "shaper"])
def test_a_crank_that_turns_all_the_way_comes_back(name: str) -> None:
    """The pose at 360 degrees is the one at 0, none between is at fault, and going back is going round."""
    scene = gp.load(name)
    turn, back = follow(scene, 91, (0, 360)), follow(scene, 91, (-360, 0))
    assert not turn.faults
    for point, values in turn.points.items():
        assert abs(values[-1] - values[0]) <= 1e-11 * extent(scene)
        assert np.all(np.abs(values - back.points[point]) <= 1e-11 * extent(scene))


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link-2", "walschaerts-loaded"])
def test_a_place_next_to_the_given_pose_is_reached(name: str) -> None:
    """However short the way is, what rounding does to it is no limit of the motion."""
    scene = gp.load(name)
    assert not any(follow(scene, 1, (way * 10.0**-k,) * 2).faults for k in range(6, 16) for way in (1, -1))


@pytest.mark.parametrize("name", ["four-bar", "alt-eight-link-2"])
def test_a_single_position_is_the_given_pose(name: str) -> None:
    """One position alone leads nowhere, and is the scene as it was given."""
    scene = gp.load(name)
    turn = follow(scene, 1)
    assert not turn.faults
    assert all(abs(turn.points[p][0] - place(scene, p)) <= ROUNDING * extent(scene) for p in scene.points)


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
    turn = follow(four_bar(50, 40, 45, 60, 30), 5, (0, far - 30))
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
    in_line = {name: (Fraction(x), Fraction(0)) for name, x in {"O": 0, "A": 30, "B": 80, "C": 140}.items()}
    turn = follow(replace(four_bar(30, 80, 80, 140, 0), points=in_line), 8)
    assert list(reached(turn)) == [0]
    assert turn.points["B"][0] == 80
    assert set(turn.faults) == set(range(8))


def test_drives_keep_pace() -> None:
    """The second crank of the five-bar turns back as fast as the first turns on; a span has both its ends."""
    scene = gp.load("five-bar")
    turn = follow(scene, 31, (-10, 20))
    assert np.allclose(np.degrees(turn.travel), np.arange(-10, 21))
    A, B = (turn.points[p] - place(scene, q) for p, q in (("A", "O"), ("B", "P")))
    assert np.allclose(A, place(scene, "A") * np.exp(1j * turn.travel))
    assert np.allclose(B, (place(scene, "B") - place(scene, "P")) * np.exp(-1j * turn.travel))


def test_a_ram_travels_in_lengths() -> None:
    """The rod of the plough's cylinder, which its drive draws in, goes in by the travel."""
    scene = gp.load("plough-lift")
    turn = follow(scene, 9, (-8, 8))
    assert np.allclose(np.abs(turn.points["B"] - turn.points["A"]), 104 - turn.travel, rtol=1e-13, atol=0)
    assert not turn.faults


def test_a_driven_block_shifts_along_its_guide() -> None:
    """A block that is driven back along the frame goes as far as the travel says; points on no link stand still."""
    text = """
        [points]
        O = [0, 0]
        Z = [4, 3]
        B = [80, 60]
        A = [20, 30]
        [links]
        1 = "O A"
        2 = "A B"
        3 = "B"
        frame = "O"
        [[slides]]
        link = "3"
        along = "frame"
        at = "B"
        direction = "O Z"
        [[drive]]
        slide = ["3", "frame"]
        speed = -2"""
    scene = gp.parse(text, "ram")
    turn = follow(scene, 9, (-3, 5))
    assert not turn.faults
    assert_holds_together(scene, turn)
    assert np.all(turn.points["Z"] == 4 + 3j)
    assert np.allclose(turn.points["B"], 80 + 60j - turn.travel * (0.8 + 0.6j), rtol=1e-14, atol=0)


@pytest.mark.parametrize("name", ["four-bar", "shaper", "slotted-link", "alt-eight-link-2"])
def test_the_construction_can_be_replayed_over_the_cycle(name: str) -> None:
    """Velocities constructed in the poses of the cycle are those with which its points move from pose to pose."""
    scene = gp.load(name)
    turn = follow(scene, 3601, (-18, 18))
    found = gp.construct(scene).evaluate(points=turn.points)
    for point in scene.find.velocity:
        if point in own(scene, turn, next(link for link in scene.links_of[point])):
            by_turning = found.velocity[point] / float(scene.drives[0].rate)
            moved = np.gradient(turn.points[point], turn.travel)
            assert np.allclose(by_turning[1:-1], moved[1:-1], rtol=0, atol=1e-5 * np.max(np.abs(moved)))


@pytest.mark.parametrize(("name", "positions", "span", "why"), [
    ("rosenauer-basic", 12, None, "the motion of points is given"),
    ("plough-lift", 12, None, "the first drive slides"),
    ("four-bar", 0, None, "0 positions"),
    ("four-bar", 12, (0, math.inf), "has no end"),
])
def test_what_has_no_cycle_is_refused(name: str, positions: int, span: tuple[float, float] | None, why: str) -> None:
    """Given point motions, a sliding drive without a span, no positions or an endless span are refused in one line."""
    with pytest.raises(Refused, match=why):
        follow(gp.load(name), positions, span)


def test_a_first_drive_that_stands_still_leads_nothing() -> None:
    """Drives keep pace with the first one, so that it must move if another does."""
    scene = gp.load("five-bar")
    first, second = (drive for drive in scene.drives if not isinstance(drive, SlidingDrive))
    with pytest.raises(Refused, match="stands still"):
        follow(scene.with_drives([replace(first, rate=0), second]), 12)
    turn = follow(scene.with_drives([replace(first, rate=0), replace(second, rate=0)]), 12, (0, 11))
    assert np.all(turn.points["B"] == place(scene, "B"))
    assert np.allclose(turn.points["A"] - place(scene, "O"),
                       (place(scene, "A") - place(scene, "O")) * np.exp(1j * turn.travel))


@pytest.mark.parametrize(("scene", "closed"), [
    (gp.load("alt-eight-link-2"), True), (four_bar(50, 40, 45, 60, 30), False), (gp.load("five-bar"), True)])
def test_whether_a_cycle_closes(scene: Scene, closed: bool) -> None:
    """After a full turn all is as it was where every crank turns all the way; a span says nothing of it."""
    assert follow(scene, 12).closed is closed
    assert not follow(scene, 12, (0, 360)).closed


def test_a_crank_alone_goes_round() -> None:
    """Where nothing is to be closed, the drive alone says where all is."""
    scene = gp.parse("""
        [points]
        O = [1, 2]
        A = [4, 6]
        [links]
        1 = "O A"
        frame = "O"
        [[drive]]
        link = "1"
        omega = 1""", "crank")
    turn = follow(scene, 8)
    assert turn.closed
    assert np.allclose(turn.points["A"], 1 + 2j + (3 + 4j) * np.exp(1j * turn.travel), rtol=1e-15, atol=0)


def test_a_block_that_runs_to_infinity_stops_at_its_limit() -> None:
    """A slot turns parallel to the guide of its block: the limit is as near as the determinant tells, 2^-22 of it."""
    slot = gp.parse("""
title = "a block in a slot"
points = { O = [0, 0], B = [1, 1] }
links = { 1 = "O", 2 = "B", 3 = "B", frame = "O" }
slides = [{ link = "2", along = "1", at = "B", direction = [1, 1] },
          { link = "3", along = "frame", at = "B", direction = [1, 0] }]
drive = [{ link = "1", omega = 1 }]
""", "slot")
    turn = follow(slot, 3, (-45 + 1e-5, 135 - 1e-5))
    assert not turn.faults
    assert np.allclose(turn.points["B"], 1 / np.tan(turn.travel + np.pi / 4) + 1j)
    assert set(follow(slot, 2, (-45 + 9e-6, 135 - 9e-6)).faults) == {0, 1}


def test_progress_is_told() -> None:
    """Who asks for it hears how far the path is followed, up to the whole."""
    told: list[float] = []
    follow(gp.load("four-bar"), 12, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1
