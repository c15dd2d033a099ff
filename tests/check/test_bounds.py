"""Digits: each printed number has nine of them, proven, wherever the scene lies and however large it is."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from packaged_scenes import those
from proven import lies

from graphplan.accuracy.survey.degeneracies import DEGENERACIES, WAYS, Degeneracy
from graphplan.check import trusted
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.commands import main
from graphplan.errors import ConstructionError, SingularPose
from graphplan.mechanism.model import FRAME, Drive, Scene
from graphplan.mechanism.scene import load, parse

RATIONAL = those(lambda scene: not scene.irrational)
DISTANCES = tuple(10.0**-k for k in range(3, 15))
MILLION = Fraction(10**6)

FLAT = """
[points]
O = [0, 0]
A = [30, 40]
B = [130, 90.{zeros}1]
C = [230, 140]
M = [60, 110]
[links]
1 = "O A"
2 = "A B M"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 2.0
"""

# Two turntables on each other, with a load: their rates all but cancel, and the given alpha is next to nothing.
TURNTABLES = """
gravity = [0, -9.81]
[points]
P0 = [86, -36]
P1 = [-9, 28]
P2 = [42, -64]
X2 = [-8, -44]
Xframe = [42, -27]
[links]
1 = "P0 P1 P2"
2 = "P1 X2"
frame = "P0 Xframe"
[[drive]]
link = "2"
omega = -1.3e7
alpha = 0
[[drive]]
link = "1"
omega = 1e7
alpha = 1
[masses.1]
mass = 1
inertia = 2
centre = "P1"
[[forces]]
on = "1"
at = "P0"
value = [15, 50]
[[moments]]
on = "2"
value = 10
[[balance]]
link = "2"
[[balance]]
link = "1"
"""

RESTING = """
[points]
P0 = [-7, 14]
P1 = [9, 9]
P2 = [-38, 8]
[links]
1 = "P2"
2 = "P1 P2"
3 = "P0 P2"
frame = "P0 P1"
[[drive]]
link = "1"
omega = -3
[find]
acceleration = "all"
"""

TOUCHING = """
[points]
P0 = [0, 0]
P1 = [3, 3]
P3 = [0, 0]
[links]
1 = "P1"
2 = "P0 P1"
frame = "P3"
[[slides]]
link = "2"
along = "frame"
at = "P0"
direction = [0, -2]
[[drive]]
slide = ["2", "frame"]
speed = 1
[[drive]]
link = "1"
omega = 1
"""


@pytest.mark.parametrize("name", RATIONAL)
def test_no_bound_of_a_packaged_scene_lies(name: str) -> None:
    """Fractions find each number of each scene within its proven bound, and nine digits of it."""
    scene = frictionless(load(name))
    assert lies(report(scene), scene) == []


@pytest.mark.parametrize(("degeneracy", "way", "first"),
                         [(one, way, k) for one in DEGENERACIES for k, way in enumerate(("", *one.compared_ways))],
                         ids=lambda case: getattr(case, "name", case) or "chosen")
def test_near_a_special_pose_every_number_is_right_to_its_bound(degeneracy: Degeneracy, way: str, first: int) -> None:
    """Towards each special pose every way gives nine digits that are right, or is told that it cannot be drawn; ways
    take distances in turn."""
    for distance in DISTANCES[first % 2 :: 2]:
        scene = degeneracy.scene_at(distance)
        try:
            found = report(scene, **WAYS.get(way, {}))
        except (SingularPose, ConstructionError):
            continue
        assert lies(found, scene) == []


@pytest.mark.parametrize("zeros", range(2, 15))
def test_a_link_that_is_all_but_straight(zeros: int) -> None:
    """However flat two bars meet, nine digits of all rates hold: of 1e14 of them as of ten."""
    scene = parse(FLAT.format(zeros="0" * zeros), "flat")
    assert lies(report(scene), scene) == []


def test_the_arithmetic_is_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Floats serve a sound pose, enclosures a flat one, and fractions where python-flint is missing."""
    file = tmp_path / "flat.toml"
    file.write_text(FLAT.format(zeros="0" * 9))
    told = [solved(capsys, "four-bar"), solved(capsys, str(file))]
    assert [one["arithmetic"].split()[0] for one in told] == ["floats", "enclosures"]
    assert told[1]["points"]["B"]["velocity"] == [12499999999960.0, -24999999999970.0]


def solved(capsys: pytest.CaptureFixture[str], *arguments: str) -> Any:
    assert main(["solve", *arguments]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("text", [FLAT.format(zeros="0" * 8), TURNTABLES, RESTING, TOUCHING])
def test_without_flint_fractions_serve_a_rational_scene(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where enclosures are missing, fractions give the digits that floats cannot."""
    scene = parse(text, "scene")
    with_enclosures = report(scene)
    monkeypatch.setattr(trusted, "has_flint", lambda: False)
    found = report(scene)
    assert found.arithmetic in ("floats", "fractions")
    assert lies(found, scene) == lies(with_enclosures, scene) == []
    assert found.results == with_enclosures.results


def test_without_flint_the_bound_of_an_irrational_scene_is_as_large_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """A flat pose placed by an angle keeps few digits in floats, and says so; enclosures find it within the bound."""
    scene = parse(FLAT.format(zeros="0" * 4).replace(
        "A = [30, 40]", 'A = { from = "O", distance = 50, angle = 53.13010235415598 }'), "flat")
    sharp = report(scene)
    monkeypatch.setattr(trusted, "has_flint", lambda: False)
    found = report(scene)
    assert (sharp.arithmetic, found.arithmetic) == ("enclosures of 40 digits", "floats")
    assert max(sharp.bounds.values()) <= 1e-9 < max(found.bounds.values())
    for part, named in found.numbers.items():
        for name, vector in named.items():
            for rough, right in zip(vector, sharp.numbers[part][name], strict=True):
                assert abs(rough.value - right.value) <= rough.bound + right.bound


@pytest.mark.parametrize("text", [TURNTABLES, RESTING, TOUCHING])
def test_rounding_is_no_alarm_and_a_given_rate_is_kept(text: str) -> None:
    """At rest, touching and all but cancelling: the construction agrees, and every number is right to nine digits."""
    scene = parse(text, "scene")
    found = report(scene)
    assert lies(found, scene) == []
    for drive in scene.drives:
        if not drive.slides and drive.on == FRAME and drive.link in found.results["alpha"]:
            assert found.results["alpha"][drive.link] == pytest.approx(float(drive.change), rel=1e-9)


def frictionless(scene: Scene) -> Scene:
    """The scene without friction, whose balances are no rational numbers."""
    return replace(scene, loads=replace(scene.loads, frictions=())) if scene.loads else scene


def larger(scene: Scene, factor: Fraction) -> Scene:
    """All lengths so many times as large."""
    def vector(pair: Any) -> Any:
        return pair[0] * factor, pair[1] * factor

    def drive(one: Drive) -> Drive:
        return one.driven_at(one.rate * factor, one.change * factor) if one.slides else one

    return replace(scene.with_drives(map(drive, scene.drives)), placements={},
                   points={name: vector(at) for name, at in scene.points.items()},
                   motions={name: replace(motion, velocity=vector(motion.velocity),
                                          acceleration=vector(motion.acceleration))
                            for name, motion in scene.motions.items()})


def faster(scene: Scene, factor: Fraction) -> Scene:
    """All rates so many times as fast."""
    def drive(one: Drive) -> Drive:
        return one.driven_at(one.rate * factor, one.change * factor**2)

    def times(pair: Any, by: Fraction) -> Any:
        return pair[0] * by, pair[1] * by

    return replace(scene.with_drives(map(drive, scene.drives)),
                   motions={name: replace(motion, velocity=times(motion.velocity, factor),
                                          acceleration=times(motion.acceleration, factor**2))
                            for name, motion in scene.motions.items()})


def elsewhere(scene: Scene) -> Scene:
    """The same far from the origin."""
    return replace(scene, points={name: (x + MILLION, y - MILLION) for name, (x, y) in scene.points.items()},
                   placements={})


COPIES = {
    "larger": lambda scene: larger(scene, MILLION), "smaller": lambda scene: larger(scene, 1 / MILLION),
    "faster": lambda scene: faster(scene, MILLION), "slower": lambda scene: faster(scene, 1 / MILLION),
    "elsewhere": elsewhere,
}


@pytest.mark.parametrize("how", COPIES)
@pytest.mark.parametrize("name", RATIONAL)
def test_a_verdict_hangs_on_no_unit_and_no_origin(name: str, how: str) -> None:
    """A millionfold larger, smaller, faster or slower, or far away, the construction agrees and nine digits hold."""
    scene = frictionless(COPIES[how](load(name)))
    assert lies(report(scene), scene) == []


def test_a_bound_for_every_number(capsys: pytest.CaptureFixture[str]) -> None:
    """With --bounds each printed number has its own, none larger than that of its kind."""
    told = solved(capsys, "jaanimets-10", "--bounds")
    each = told["bounds"].pop("each")
    assert set(each) >= {"velocity", "omega", "acceleration", "alpha", "reaction", "balance"}
    assert set(each["velocity"]) == {name for name, entry in told["points"].items() if "velocity" in entry}
    numbers = [bound for named in each.values() for vector in named.values()
               for bound in (vector if isinstance(vector, list) else [vector])]
    assert max(numbers) == max(told["bounds"].values()) < 1e-12
    assert told["bounds"] == solved(capsys, "jaanimets-10")["bounds"]


def test_a_singular_pose_is_singular_in_every_arithmetic(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Bars in one line end with status 3 and the links, whether fractions or placements say so."""
    file = tmp_path / "straight.toml"
    for place in ("[130, 90]", '{ on = "A C", distance = 111 }'):
        file.write_text(FLAT.format(zeros="").replace("B = [130, 90.1]", f"B = {place}"))
        assert main(["solve", str(file)]) == 3
        streams = capsys.readouterr()
        assert streams.out == ""
        assert "links 2, 3" in streams.err


def test_slidings_far_from_their_pairs_are_printed_from_enclosures() -> None:
    """Where floats lose the digits of a sliding its bound is a number like any other."""
    text = (Path(__file__).parents[1] / "faults" / "04-wrong.toml").read_text().replace("[-20, 19]", "[1e9, 19]")
    found = json.loads(json.dumps(result_data(report(parse(text, "far")))))
    assert found["arithmetic"] != "floats"
    assert 0 < found["bounds"]["acceleration"] < 1e-9
