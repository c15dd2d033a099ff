"""Errors of position: transformed mechanisms give what positions change by when a dimension does."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path

import pytest
from command_line import run

import graphplan as gp
from graphplan.check.position_errors import position_errors
from graphplan.errors import Refused, SceneError
from graphplan.mechanism.model import Scene

SLIDER_CRANK = """
title = "Ozols 18-1"
[units]
length = "m"
[points]
O = [0, 0]
A = {{ from = "O", distance = 0.1, angle = {angle} }}
B = {{ distances = {{ A = 0.35 }}, on = {{ through = [0, 0], direction = [1, 0] }}, pick = "right" }}
[links]
1 = "O A"
2 = "A B"
3 = "B"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
[[drive]]
link = "1"
omega = 1
[tolerances]
"O A" = 0.001
"A B" = 0.002
"""
FOUR_BAR = """
title = "four-bar"
[points]
O = [0, 0]
C = [{frame}, 0]
A = {{ from = "O", distance = {crank}, angle = 50 }}
B = {{ distances = {{ A = {coupler}, C = {rocker} }}, side = "left" }}
[links]
1 = "O A"
2 = "A B"
3 = "B C"
frame = "O C"
[[drive]]
link = "1"
omega = 2
[find]
links = ["3"]
[tolerances]
"O A" = 0.1
"A B" = 0.2
"B C" = 0.3
"O C" = 0.4
"""
LENGTHS = {"crank": 40.0, "coupler": 120.0, "rocker": 80.0, "frame": 100.0}
DIMENSIONS = {"crank": "O A", "coupler": "A B", "rocker": "B C", "frame": "O C"}


def coefficients(scene: Scene, position: str) -> dict[str, float]:
    """The coefficients of one position by the dimensions."""
    parts = position_errors(scene).data["errors"][position]["parts"]
    return {name: part["coefficient"] for name, part in parts.items()}


@pytest.mark.parametrize(("angle", "crank", "rod"), [
    (40, 0.645952, 1.017303), (90, -0.298142, 1.043498), (150, -0.938194, 1.010363)])
def test_slider_crank_has_the_printed_coefficients(angle: int, crank: float, rod: float) -> None:
    """Ozols (1974), example 18-1: dx = (cos phi - r sin² phi/W) dr + (b/W) db."""
    found = coefficients(gp.parse(SLIDER_CRANK.format(angle=angle), "18-1"), "B along frame")
    assert found == pytest.approx({"O A": crank, "A B": rod}, abs=1e-6)


def rocker_angle(**lengths: float) -> float:
    """The angle of the rocker of a four-bar with these lengths, from its placed points."""
    points = gp.parse(FOUR_BAR.format(**lengths), "four-bar").points
    C, B = (complex(*map(float, points[name])) for name in "CB")
    return cmath.phase(B - C)


@pytest.mark.parametrize("length", LENGTHS)
def test_four_bar_changes_as_its_placed_points_do(length: str) -> None:
    """The coefficient of each length is the change of the rocker's angle where the scene is written with another."""
    step = 1e-3
    longer, shorter = ({**LENGTHS, length: LENGTHS[length] + sign * step} for sign in (1, -1))
    slope = (rocker_angle(**longer) - rocker_angle(**shorter)) / (2 * step)
    found = coefficients(gp.parse(FOUR_BAR.format(**LENGTHS), "four-bar"), "angle 3")
    assert found[DIMENSIONS[length]] == pytest.approx(slope, rel=1e-6)


def test_sum_and_probable_error_are_those_of_the_parts() -> None:
    """Errors are sizes of coefficients times tolerances; they add up, and their squares."""
    errors = position_errors(gp.parse(FOUR_BAR.format(**LENGTHS), "four-bar")).data["errors"]["angle 3"]
    parts = [abs(part["coefficient"]) * tolerance
             for part, tolerance in zip(errors["parts"].values(), (0.1, 0.2, 0.3, 0.4), strict=True)]
    assert [part["error"] for part in errors["parts"].values()] == pytest.approx(parts)
    assert (errors["sum"], errors["probable"]) == pytest.approx((sum(parts), math.hypot(*parts)))


def test_the_offset_of_a_guide_is_a_dimension() -> None:
    """An offset to the left moves B along the guide by the slope of the rod: (B - A) dB = 0."""
    text = SLIDER_CRANK.format(angle=40) + '"3 along frame" = 0.001\n'
    scene = gp.parse(text, "18-1")
    A, B = (complex(*map(float, scene.points[name])) for name in "AB")
    slope = -(B - A).imag / (B - A).real
    assert coefficients(scene, "B along frame")["3 along frame"] == pytest.approx(slope, rel=1e-9)


def test_an_angle_of_a_link_is_a_dimension() -> None:
    """As the angle BAM grows by a degree, the pin M of the coupler goes round A."""
    text = FOUR_BAR.format(**LENGTHS).replace(
        "[links]", 'M = [60, 90]\nD = [160, 90]\n[links]\n4 = "M"\n').replace("A B\"", "A B M\"", 1).replace(
        "[[drive]]", '[[slides]]\nlink = "4"\nalong = "5"\nat = "M"\ndirection = [1, 0]\n[[drive]]').replace(
        'frame =', '5 = "D"\nframe =').replace("links = [\"3\"]", 'slides = ["5 along frame"]').replace(
        "[[slides]]", '[[slides]]\nlink = "5"\nalong = "frame"\nat = "D"\ndirection = [0, 1]\n[[slides]]', 1)
    scene = gp.parse(text.partition("[tolerances]")[0] + '[tolerances]\n"B A M" = 0.5\n', "angle")
    A, B, M = (complex(*map(float, scene.points[name])) for name in "ABM")
    sense = 1 if ((B - A).conjugate() * (M - A)).imag > 0 else -1
    assert coefficients(scene, "D along frame")["B A M"] == pytest.approx(
        sense * math.radians((M - A).real), rel=1e-9)


@pytest.mark.parametrize(("tolerances", "problem"), [
    ('"O B" = 1', "O B is no dimension of a link"), ('"O A" = -1', 'tolerances."O A"'), ('"O" = 1', "no dimension")])
def test_faulty_tolerances_are_named(tolerances: str, problem: str) -> None:
    """What is no dimension, or no size, is one line."""
    text = SLIDER_CRANK.format(angle=40).partition("[tolerances]")[0]
    with pytest.raises(SceneError, match=problem):
        gp.parse(f"{text}[tolerances]\n{tolerances}\n", "18-1")


def test_a_scene_without_tolerances_is_refused() -> None:
    """There is no error to be found."""
    with pytest.raises(Refused, match="no dimension has a tolerance"):
        position_errors(gp.load("four-bar"))


def test_command_prints_and_draws(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """JSON on standard output, and a plate and its words for each dimension."""
    scene = tmp_path / "press.toml"
    scene.write_text(SLIDER_CRANK.format(angle=40), encoding="utf-8")
    assert run("errors", str(scene)) == 0
    assert set(json.loads(capsys.readouterr().out)["errors"]) == {"B along frame"}
    assert run("errors", str(scene), "-o", str(tmp_path / "e.svg")) == 0
    assert "Ozols 18-1: error of O A" in (tmp_path / "e.svg").read_text(encoding="utf-8").replace("&#160;", " ")
