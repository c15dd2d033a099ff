"""The pose itself as a construction: the mechanism at another travel of its drive, drawn from the lengths of its links.
"""

from __future__ import annotations

import json
import math
from itertools import product
from pathlib import Path

import pytest
from packaged_scenes import those

import graphplan as gp
from graphplan.check.trusted import report
from graphplan.commands import main
from graphplan.errors import GraphplanError, Refused, SingularPose
from graphplan.mechanism.written_pose import MAX_TRAVEL, parse_pose
from graphplan.methods.construction import Construction
from graphplan.sheet.handout import task
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.plates.display import Text

DRIVEN = those(lambda scene: scene.drives and not scene.motions and not (scene.gears or scene.contacts))
TRAINS = ["planetary", "biplanetary", "david", "cardan-circles", "geared-five-bar"]
TRAVELS = 0, 17, 145, -33
DEAD = gp.parse("""
[points]
O = [0, 0]
A = [0, 25]
B = { distances = { A = 60, C = 45 }, side = "left" }
C = [60, 0]
[links]
1 = "O A"
2 = "A B"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 1
[find]
velocity = ["A", "B"]
acceleration = ["A", "B"]
""", "dead")
YOKE = """
[points]
O = [0, 0]
A = [14, 0]
B = [24, 0]
C = [0, 87]
[links]
1 = "O A"
2 = "A"
3 = "B"
4 = "A C"
5 = "C"
frame = "O"
[[slides]]
link = "2"
along = "3"
at = "A"
direction = [0, 1]
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
[[slides]]
link = "5"
along = "frame"
at = "C"
direction = [0, 1]
[[drive]]
link = "1"
omega = -10
[find]
velocity = ["C"]
"""


def displaced(drawing: Construction) -> float:
    """How far a point is at most from where the cycle has it, beside the mechanism."""
    scene = drawing.scene
    return max(math.dist(drawing.truth[step.index], scene.points[step.name]) for step in drawing.program.steps
               if step.name in scene.points) / scene.extent


@pytest.mark.parametrize("name", [*DRIVEN, *TRAINS])
def test_points_are_where_the_cycle_has_them(name: str) -> None:
    """At several travels the constructed points are the followed ones, and all results are the solver's."""
    scene, reached = gp.load(name), 0
    for travel in TRAVELS if not scene.drives[0].slides else (0, 1, -1):
        try:
            posed = gp.at(scene, travel)
        except GraphplanError:
            continue
        found = report(posed)
        reached += 1
        assert displaced(found.drawing) < 1e-12
        assert max(found.check.values()) < 1e-9
    assert reached


@pytest.mark.parametrize("name", ["four-bar", "shaper", "ozols-5-4"])
def test_the_given_pose_comes_out_again(name: str) -> None:
    """No travel at all gives the points and results of the scene itself."""
    scene = gp.load(name)
    drawing, given = gp.construct(gp.at(scene, 0)), gp.construct(scene)
    for point, z in given.velocity.items():
        assert abs(drawing.velocity[point] - z) < 1e-9 * max(map(abs, given.velocity.values()))


def test_drives_go_as_far_as_is_said() -> None:
    """Of several drives each has a travel of its own; with one travel they keep pace."""
    scene = gp.load("five-bar")
    pace = [float(drive.rate) for drive in scene.drives]
    together, apart = gp.at(scene, 20), gp.at(scene, [20, 20 * abs(pace[1] / pace[0])])
    for point, other in product(scene.points, [apart]):
        assert math.dist(together.points[point], other.points[point]) < 1e-9 * scene.extent
    assert gp.at(scene, [10, 0]).points != gp.at(scene, [0, 10]).points
    with pytest.raises(Refused, match="2 drives"):
        gp.at(scene, [1, 2, 3])


def test_beyond_a_limit_is_refused() -> None:
    """A pose that is not reached is bad input that names the limit; at the limit itself the pose is singular."""
    with pytest.raises(Refused, match="limit"):
        gp.at(gp.load("alt-eight-link"), 120)
    assert issubclass(SingularPose, GraphplanError)


def test_a_constructed_pose_moves_no_further() -> None:
    """Its points are no numbers that could be given otherwise."""
    with pytest.raises(Refused, match="constructed"):
        gp.construct(gp.at(gp.load("four-bar"), 60)).evaluate(points={"A": [1j]})


def test_solve_tells_the_pose(capsys: pytest.CaptureFixture[str]) -> None:
    """`solve --at` prints the travel and the points; what is no travel is one line and exit 2."""
    assert main(["solve", "four-bar", "--at", "60"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["pose"]["travel"] == 60
    assert found["check"]["position"] < 1e-12
    A, O = (complex(*found["pose"]["points"][name]) for name in "AO")
    before = gp.load("four-bar").points["A"]
    assert abs(A - O - complex(*map(float, before)) * complex(0.5, math.sqrt(3) / 2)) < 1e-9
    assert main(["solve", "four-bar", "--at", "sixty"]) == 2
    assert main(["solve", "four-bar", "--at", "1e400"]) == 2


def test_a_travel_to_which_no_steps_are_known_is_refused_with_the_name_of_its_scene(
        tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A yoke whose block is a joint of a rod too is found by no steps in another pose; the line says of which scene."""
    path = tmp_path / "yoke.toml"
    path.write_text(YOKE, encoding="utf-8")
    assert main(["solve", str(path), "--at", "7"]) == 2
    assert capsys.readouterr().err.startswith(f"{path}: link 2: no steps are known")


@pytest.mark.parametrize("travel", ["9999999", "-36000.001", "1e300"])
def test_a_travel_that_would_take_minutes_to_follow_is_refused(travel: str, capsys: pytest.CaptureFixture[str]) -> None:
    """In one line, before anything is drawn; a hundred turns are followed."""
    assert main(["steps", "four-bar", f"--at={travel}"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert main(["cycle", "four-bar", "--positions=3", "--from=0", f"--to={travel}"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert parse_pose(f"{MAX_TRAVEL},-{MAX_TRAVEL}") == [MAX_TRAVEL, -MAX_TRAVEL]


def test_a_task_shows_what_stands_still() -> None:
    """On the sheet of a task the pose that is asked for is not drawn; the travel is told."""
    drawing = gp.construct(gp.at(gp.load("four-bar"), 60))
    labels = {item.label for page in task(compose(drawing)) for item in page.items if isinstance(item, Text)}
    assert {"O", "C"} <= labels
    assert {"A", "B", "M"}.isdisjoint(labels)


def test_strict_uses_the_chord() -> None:
    """Without a protractor the crank is laid off by the chord under its angle."""
    drawing = gp.construct(gp.at(gp.load("four-bar"), 60), strict=True)
    assert {"protractor", "set squares"}.isdisjoint(step.op.instrument for step in drawing.drawn.steps)


def test_crank_and_coupler_lie_in_one_line() -> None:
    """In its extreme positions B is b + r and b - r from the crank's pivot, and the rocker stands (r, b, c, d = 25, 60,
    45, 60)."""
    expected = {"outer": (85, (73.333, 42.979), 72.765), "inner": (35, (23.333, 26.087), 144.569)}
    for way, (far, at, angle) in expected.items():
        found = report(gp.at(DEAD, way))
        B = found.drawing.truth[next(step.index for step in found.drawing.program.steps if step.name == "B")]
        assert math.dist(B, at) < 1e-3
        assert abs(math.hypot(*B) - far) < 1e-12 * far
        assert abs(math.degrees(math.atan2(B[1], B[0] - 60)) - angle) < 1e-3
        assert abs(found.drawing.omega["3"]) < 1e-12
        assert max(found.check.values()) < 1e-12
        assert found.numbers_agree


@pytest.mark.parametrize(("name", "way"), [("slider-crank", "outer"), ("jaanimets-10", "inner"),
                                           ("rosenauer-example-2", "outer 3"), ("inflection-circle", "outer")])
def test_extreme_positions_are_where_the_cycle_turns_back(name: str, way: str) -> None:
    """The joint that the coupler swings comes no further a hair before and after, and the cycle has the same points."""
    scene = gp.load(name)
    posed = gp.at(scene, way)
    found, extreme = report(posed), posed.assembly.extreme
    assert displaced(found.drawing) < 1e-12
    assert max(found.check.values()) < 1e-9
    travel = float(posed.assembly.travels[0])
    before, here, after = (complex(*gp.at(scene, travel + step).points[extreme.joint]) for step in (-1e-3, 0, 1e-3))
    assert abs(here - before) + abs(here - after) < 1e-8 * scene.extent
    assert ((after - here) / (before - here)).real > 0.9


def test_the_time_ratio_is_of_the_turns_between() -> None:
    """Between the extreme positions a uniform crank turns through two angles; where the slider's line passes the pivot
    they are alike."""
    ends = [gp.at(DEAD, way).assembly for way in ("outer", "inner")]
    forth = float(ends[0].travels[0] - ends[1].travels[0]) % 360
    for end in ends:
        assert end.extreme.time_ratio == pytest.approx(max(forth, 360 - forth) / min(forth, 360 - forth), rel=1e-12)
    assert gp.at(gp.load("slider-crank"), "inner").assembly.extreme.time_ratio == pytest.approx(1, rel=1e-12)


@pytest.mark.parametrize(("name", "link"), [("shaper", "3"), ("shaper", "5"), ("slotted-link", "3")])
def test_a_quick_return_turns_back_where_its_rate_is_nothing(name: str, link: str) -> None:
    """A lever that a crank swings in its slot stands still where the crank is square to it; K is of the angles between.
    """
    scene, drawn = gp.load(name), []
    for way in ("outer", "inner"):
        posed = gp.at(scene, f"{way} {link}")
        found = report(posed)
        assert max(found.check.values()) < 1e-9
        assert displaced(found.drawing) < 1e-12
        assert abs(found.drawing.omega["3"]) < 1e-9
        drawn.append(posed.assembly)
    swing = math.degrees(2 * math.asin(120 / 180))  # the crank's radius and the distance of the pivots
    assert [one.extreme.time_ratio for one in drawn] == pytest.approx([(180 + swing) / (180 - swing)] * 2, rel=1e-9)


def test_what_has_no_extreme_position_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """A word that is none, a link not swung, several that are, a crank that stops before, none: one line and exit 2."""
    for name, way, why in (("four-bar", "utmost", "not a position"), ("four-bar", "outer 2", "no extreme position"),
                           ("rosenauer-example-2", "outer", "one of outer 3, outer 10"),
                           ("rosenauer-example-2", "inner 10", "comes to no position"),
                           ("five-bar", "outer", "no link swings")):
        assert main(["solve", name, "--at", way]) == 2
        assert why in capsys.readouterr().err
    assert main(["solve", "four-bar", "--at", "outer"]) == 0
    told = json.loads(capsys.readouterr().out)["pose"]
    assert (told["extreme"], told["link"]) == ("outer", "3")
    assert told["time_ratio"] > 1


def test_gears_turn_by_their_ratio(capsys: pytest.CaptureFixture[str]) -> None:
    """A planet turns on its arm as the teeth say, and is laid off so; what no train alone turns is refused."""
    posed, scene = gp.at(gp.load("cardan-circles"), 30), gp.load("cardan-circles")
    A, M = (complex(*posed.points[name]) for name in "AM")
    before = complex(*map(float, scene.points["M"])) - complex(*map(float, scene.points["A"]))
    assert abs((M - A) / before - complex(math.cos(math.pi / 6), -math.sin(math.pi / 6))) < 1e-12
    assert main(["steps", "cardan-circles", "--at", "30"]) == 0
    assert "the ratio of the gears" in capsys.readouterr().out
    assert report(gp.at(gp.load("geared-five-bar"), 30)).numbers_agree  # read in enclosures, too
    for name in ("gear-linkage", "racks", "roller-cam"):
        with pytest.raises(Refused, match="no construction is known"):
            gp.at(gp.load(name), 10)


def test_supports_of_balances_stand_in_another_pose_too() -> None:
    """Of two drives a force and a moment hold the loads: in another pose each is found while the other supports."""
    scene = gp.parse("""
        [points]
        O = [0, 0]
        A = [20, 110]
        B = [135, 225]
        C = [310, 0]
        D = [350, 60]
        [links]
        1 = "O A"
        2 = "A B"
        3 = "B C"
        4 = "C D"
        frame = "O C"
        [[drive]]
        link = "1"
        omega = 1
        [[drive]]
        link = "4"
        omega = 2
        [[forces]]
        on = "2"
        at = "A"
        value = [30, -40]
        [[balance]]
        link = "4"
        [[balance]]
        on = "3"
        at = "B"
        direction = [1, 0]
        [find]
        velocity = ["B"]
        """, "two drives")
    assert report(gp.at(scene, 7)).agrees
