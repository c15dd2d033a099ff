"""How mechanisms swing: where links turn back, the transmission angle, and the type of a four-bar linkage."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path

import pytest

import graphplan as gp
from graphplan.commands import main
from graphplan.cycle.swings import grashof, motion_remarks, swings, transmissions

FOUR_BAR = """
[points]
O = [0, 0]
A = [{x}, {y}]
B = {{ distances = {{ A = {b}, C = {c} }}, side = "left" }}
C = [{d}, 0]
[links]
1 = "O A"
2 = "A B"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 1
"""
TYPES = [  # where A is, the coupler, the rocker, the frame
    ((-2, 0), 5, 4, 5, "crank and rocker"), ((0, 4), 2, 5, 5, "double rocker (Grashof)"),
    ((5, 0), 4, 5, 2, "double crank"), ((0, 4), 6, 4, 9, "not of Grashof's kind"),
    ((-3, 0), 5, 4, 6, "Grashof's limit"),
    ((0, 4), 5, 2, 5, "crank and rocker"),
]


def four_bar(at: tuple[float, float], coupler: float, rocker: float, frame: float) -> gp.Scene:
    """A four-bar linkage by where A is and the lengths of its other sides."""
    return gp.parse(FOUR_BAR.format(x=at[0], y=at[1], b=coupler, c=rocker, d=frame), "four-bar")


@pytest.mark.parametrize(("at", "coupler", "rocker", "frame", "kind"), TYPES)
def test_four_bar_linkages_have_the_type_of_their_lengths(at: tuple[int, int], coupler: int, rocker: int, frame: int,
                                                          kind: str) -> None:
    """By the sum of the shortest and the longest side, and by which is the shortest."""
    assert kind in grashof(four_bar(at, coupler, rocker, frame))


def test_the_limit_is_the_limit_whatever_the_pose() -> None:
    """Points that are placed by lengths have these to rounding alone; further off it is no limit."""
    for y in (1.0, 2.5, -2.0):
        assert "Grashof's limit" in grashof(four_bar((-math.sqrt(9 - y * y), y), 5, 4, 6))
    assert "crank and rocker" in grashof(four_bar((-3, 0), 5, 4, 6 - 1e-9))


def test_a_swing_is_the_same_from_wherever_it_is_seen() -> None:
    """Given in an extreme position or elsewhere, a mechanism has the same strokes and time ratios."""
    for name in ("slotted-link", "slider-crank", "dwell"):
        scene = gp.load(name)
        for one, other in zip(swings(scene), swings(gp.at(scene, "outer 3")), strict=True):
            assert (one.link, one.stroke, one.time_ratio) == (other.link, pytest.approx(other.stroke, rel=1e-9),
                                                              pytest.approx(other.time_ratio, rel=1e-9))


def test_the_least_transmission_angle_is_at_a_dead_line_of_crank_and_frame() -> None:
    """Of a crank and rocker it is where the crank lies in the line of the frame."""
    scene = gp.load("four-bar")
    (angle,) = transmissions(scene)
    posed = gp.at(scene, angle.travel)
    A, B, C = (complex(*map(float, posed.points[name])) for name in "ABC")
    between = abs(math.degrees(cmath.phase((A - B) / (C - B))))
    assert min(between, 180 - between) == pytest.approx(angle.least, abs=1e-6)
    O = complex(*map(float, posed.points["O"]))
    assert abs(((A - O) / (C - O)).imag) < 1e-6


def test_strokes_are_between_the_extreme_positions() -> None:
    """A centric slider's stroke is twice the crank; a slotted lever swings by twice the angle whose sine is r : d."""
    (slider,) = swings(gp.load("slider-crank"))
    crank = math.dist(*(map(float, gp.load("slider-crank").points[name]) for name in "OA"))
    assert slider.stroke == pytest.approx(2 * crank, rel=1e-9)
    assert slider.time_ratio == pytest.approx(1, rel=1e-9)
    (lever,) = swings(gp.load("slotted-link"))
    assert lever.stroke == pytest.approx(2 * math.degrees(math.asin(120 / 180)), rel=1e-9)


def test_a_cycle_tells_how_its_mechanism_swings(capsys: pytest.CaptureFixture[str]) -> None:
    """Type, strokes with their time ratios and transmission angles, on standard error; -q says nothing."""
    assert main(["cycle", "four-bar", "--positions", "3"]) == 0
    told = capsys.readouterr().err
    assert "crank and rocker (Grashof)" in told
    assert "time ratio K = 1.018" in told
    assert "transmission angle of coupler 2 and link 3: at least 40.77°" in told
    assert main(["cycle", "four-bar", "--positions", "3", "-q"]) == 0
    assert capsys.readouterr().err == ""


def test_a_cycle_as_json_says_how_the_mechanism_swings(tmp_path: Path) -> None:
    """Type, strokes with time ratios, and least transmission angles, by the links' names, as numbers."""
    scene, file = tmp_path / "scene.toml", tmp_path / "cycle.json"
    scene.write_text(FOUR_BAR.format(x=-2, y=0, b=5, c=4, d=5), encoding="utf-8")
    assert main(["cycle", str(scene), "--positions", "2", "-q", "-o", str(file)]) == 0
    told = json.loads(file.read_text(encoding="utf-8"))
    assert told["type"] == "crank and rocker (Grashof)"
    dead = [math.acos((reach * reach + 25 - 16) / (10 * reach)) for reach in (3, 7)]  # OB from OC, crank in line
    turned = math.degrees(math.pi + dead[0] - dead[1])
    assert told["swings"]["3"]["time_ratio"] == pytest.approx(max(turned, 360 - turned) / min(turned, 360 - turned))
    least = min(math.acos(abs(25 + 16 - far * far) / 40) for far in (3, 7))
    assert told["transmission"]["2 3"]["least"] == pytest.approx(math.degrees(least))


def test_a_coupler_in_line_with_its_link_has_no_transmission_angle() -> None:
    """The least angle of a linkage that comes to its limit is told as 0."""
    lines = [line for line in motion_remarks(four_bar((0, 4), 6, 4, 9)) if "transmission" in line]
    assert len(lines) == 1
    assert "at least 0°" in lines[0]
