"""Poses further on, constructed from the lengths of links: at a travel, in an extreme position; how links swing."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path
from typing import Any

import pytest
from face import ran

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "cycle"
DEAD, ROCKER = gp.load(CASES / "dead.toml"), gp.load(CASES / "rocker.toml")
TYPES = [  # where A is, the coupler, the rocker, the frame
    ((-2, 0), 5, 4, 5, "crank and rocker"), ((0, 4), 2, 5, 5, "double rocker (Grashof)"),
    ((5, 0), 4, 5, 2, "double crank"), ((0, 4), 6, 4, 9, "not of Grashof's kind"),
    ((-math.sqrt(2.75), 2.5), 5, 4, 6, "Grashof's limit"), ((0, 4), 5, 2, 5, "crank and rocker"),
]


def four_bar(at: tuple[float, float], coupler: float, rocker: float, frame: float) -> gp.Scene:
    """A four-bar linkage by where A is and the lengths of its other sides."""
    B = {"distances": {"A": coupler, "C": rocker}, "side": "left"}
    return ROCKER.replace("points", {"O": [0, 0], "A": [*at], "B": B, "C": [frame, 0]})


def cycle(scene: gp.Scene, folder: Path) -> Any:
    """How a mechanism swings, as `graphplan cycle` tells it in JSON."""
    told = ran("cycle", "-", "-q", "--positions", "1", "-o", folder / "cycle.json", given=scene.toml())
    assert told.status == 0 or "limit" in told.err or "change point" in told.err, told.err
    return json.loads((folder / "cycle.json").read_text())


def posed(scene: gp.Scene, travel: Any) -> tuple[Any, dict[str, complex]]:
    """The results in another pose, and where its points are; construction and solver agree."""
    data = gp.solve(gp.at(scene, travel)).json()
    assert data["check"].pop("position") < 1e-12
    assert max(data["check"].values()) < 1e-9
    return data, {name: complex(*at) for name, at in data["pose"]["points"].items()}


def test_drives_go_as_far_as_is_said() -> None:
    """Of several drives each has a travel of its own, in its own sense; with one travel they keep pace."""
    scene = gp.load("five-bar")
    pace = [float(drive.rate) for drive in scene.drives]
    together, apart = gp.at(scene, 20), gp.at(scene, [20, 20 * abs(pace[1] / pace[0])])
    assert all(math.dist(together.points[point], apart.points[point]) < 1e-9 * scene.extent for point in scene.points)
    assert gp.at(scene, [10, 0]).points != gp.at(scene, [0, 10]).points
    with pytest.raises(gp.Refused, match="2 drives"):
        gp.at(scene, [1, 2, 3])
    back = gp.at(scene, [-20, 20])
    turned = [cmath.phase(complex(*map(float, there.points[crank])) - complex(*map(float, scene.points[pivot])))
              - cmath.phase(complex(*map(float, scene.points[crank])) - complex(*map(float, scene.points[pivot])))
              for there, crank, pivot in ((together, "A", "O"), (together, "B", "P"), (back, "A", "O"))]
    assert [math.degrees(angle) for angle in turned] == pytest.approx([20, -20, -20])


def test_a_constructed_pose_moves_no_further() -> None:
    """Its points are no numbers that could be given otherwise."""
    with pytest.raises(gp.Refused, match="constructed"):
        gp.construct(gp.at(gp.load("four-bar"), 60)).evaluate(points={"A": [1j]})


def test_of_another_pose_what_stands_still_is_given() -> None:
    """The points of the frame are given; those of the pose that is asked for are found by steps."""
    steps = {step["makes"]: step["operation"] for step in ran("steps", "four-bar", "-q", "--json", "--at",
                                                              "60").json["steps"]}
    assert {steps["O"], steps["C"]} == {"given"}
    assert "given" not in {steps["A"], steps["B"], steps["M"]}


def test_strict_uses_the_chord() -> None:
    """Without a protractor the crank is laid off by the chord under its angle."""
    plain, strict = ({step["instrument"] for step in ran("steps", "four-bar", "-q", "--json", "--at", "60",
                                                         *more).json["steps"]} for more in ([], ["--strict"]))
    assert {"protractor", "set squares"} <= plain
    assert {"protractor", "set squares"}.isdisjoint(strict)


@pytest.mark.parametrize(("name", "way", "joint"), [
    ("slider-crank", "outer", "B"), ("jaanimets-10", "inner", "B"), ("rosenauer-example-2", "outer 3", ""),
    ("inflection-circle", "outer", "B")])
def test_extreme_positions_are_where_the_cycle_turns_back(name: str, way: str, joint: str) -> None:
    """The joint that the coupler swings comes no further a hair before and after, and the cycle has the same points."""
    scene = gp.load(name)
    data, points = posed(scene, way)
    travel, link = float(data["pose"]["travel"]), data["pose"]["link"]
    turn = gp.cycle.follow(scene, 3, (travel - 1e-3, travel + 1e-3))
    joints = [joint] if joint else [point for point in scene.links[link] if point not in scene.links["frame"]]
    for point in joints:
        before, here, after = turn.points[point]
        assert abs(points[point] - here) < 1e-9 * scene.extent
        assert abs(here - before) + abs(here - after) < 1e-8 * scene.extent
        assert ((after - here) / (before - here)).real > 0.9


def test_the_time_ratio_is_of_the_turns_between() -> None:
    """Between the extreme positions a uniform crank turns through two angles; where the slider's line passes the pivot
    they are alike."""
    ends = [posed(DEAD, way)[0]["pose"] for way in ("outer", "inner")]
    forth = (ends[0]["travel"] - ends[1]["travel"]) % 360
    for end in ends:
        assert end["time_ratio"] == pytest.approx(max(forth, 360 - forth) / min(forth, 360 - forth), rel=1e-9)
    assert posed(gp.load("slider-crank"), "inner")[0]["pose"]["time_ratio"] == pytest.approx(1, rel=1e-12)


def test_gears_turn_by_their_ratio() -> None:
    """A planet turns on its arm as the teeth say, also where a dyad is moved by geared cranks."""
    scene = gp.load("cardan-circles")
    _, points = posed(scene, 30)
    before = complex(*map(float, scene.points["M"])) - complex(*map(float, scene.points["A"]))
    assert abs((points["M"] - points["A"]) / before - cmath.rect(1, -math.pi / 6)) < 1e-12
    posed(gp.load("geared-five-bar"), 30)


# ---- how links swing -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("at", "coupler", "rocker", "frame", "kind"), TYPES)
def test_four_bar_linkages_have_the_type_of_their_lengths(at: tuple[int, int], coupler: int, rocker: int, frame: int,
                                                          kind: str, tmp_path: Path) -> None:
    """By the sum of the shortest and the longest side, and by which is the shortest."""
    assert kind in cycle(four_bar(at, coupler, rocker, frame), tmp_path)["type"]


def test_the_limit_is_the_limit_whatever_the_pose(tmp_path: Path) -> None:
    """Points that are placed by lengths have these to rounding alone; further off it is no limit."""
    for y in (1.0, 2.5, -2.0):
        at = -math.sqrt(9 - y * y), y
        assert "Grashof's limit" in cycle(four_bar(at, 5, 4, 6), tmp_path)["type"]
        assert "crank and rocker" in cycle(four_bar(at, 5, 4, 6 - 1e-9), tmp_path)["type"]


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "dwell", "slotted-link"])
def test_a_swing_is_the_same_from_wherever_it_is_seen(name: str, tmp_path: Path) -> None:
    """Given in one pose or another, a mechanism has the same strokes and time ratios."""
    scene = gp.load(name)
    turn = gp.cycle.follow(scene, 1, (40, 40))
    there = scene.replace("points", {point: [float(z[0].real), float(z[0].imag)] for point, z in turn.points.items()})
    one, other = (cycle(given, tmp_path)["swings"] for given in (scene, there))
    assert one.keys() == other.keys() != set()
    for link, swing in one.items():
        for what in ("stroke", "time_ratio"):
            assert swing[what] == pytest.approx(other[link][what], rel=1e-8)


def test_strokes_and_angles_are_those_of_the_triangles(tmp_path: Path) -> None:
    """Of a crank and rocker stroke and time ratio follow from the triangles of its extreme positions; the transmission
    angle is least where the crank lies in the line of the frame."""
    found = cycle(four_bar((-2, 0), 5, 4, 5), tmp_path)
    dead = [math.acos((reach * reach + 25 - 16) / (10 * reach)) for reach in (3, 7)]  # OB from OC, crank in line
    turned = math.degrees(math.pi + dead[0] - dead[1])
    assert found["swings"]["3"]["time_ratio"] == pytest.approx(max(turned, 360 - turned) / min(turned, 360 - turned))
    ends = [math.acos((16 + 25 - reach * reach) / 40) for reach in (3, 7)]
    assert found["swings"]["3"]["stroke"] == pytest.approx(math.degrees(ends[1] - ends[0]))
    least = min(math.acos(abs(25 + 16 - far * far) / 40) for far in (3, 7))
    assert found["transmission"]["2 3"]["least"] == pytest.approx(math.degrees(least))
    there = gp.cycle.follow(four_bar((-2, 0), 5, 4, 5), 1, (found["transmission"]["2 3"]["travel"],) * 2)
    assert abs(there.points["A"][0].imag) < 1e-6
