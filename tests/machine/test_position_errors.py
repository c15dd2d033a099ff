"""Position errors: transformed mechanisms give what positions change by when a dimension does."""

from __future__ import annotations

import cmath
import math
from pathlib import Path
from typing import Any

import pytest

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "machine" / "errors"
SLIDER_CRANK, FOUR_BAR = gp.load(CASES / "slider-crank.toml"), gp.load(CASES / "four-bar.toml")
LENGTHS = {"O A": "points.A.distance", "A B": "points.B.distances.A", "B C": "points.B.distances.C",
           "O C": "points.C.0"}


def coefficients(scene: gp.Scene, position: str) -> dict[str, float]:
    """The coefficients of one position by the dimensions."""
    parts = gp.position_errors(scene).json()["errors"][position]["parts"]
    return {name: part["coefficient"] for name, part in parts.items()}


def places(scene: gp.Scene, names: str) -> list[complex]:
    """Where points of a scene are."""
    return [complex(*map(float, scene.points[name])) for name in names]


@pytest.mark.parametrize(("angle", "crank", "rod"), [
    (40, 0.645952, 1.017303), (90, -0.298142, 1.043498), (150, -0.938194, 1.010363)])
def test_slider_crank_has_the_printed_coefficients(angle: int, crank: float, rod: float) -> None:
    """Ozols (1974), example 18-1: dx = (cos phi - r sin² phi/W) dr + (b/W) db; and an offset of the guide to the left
    moves B along it by the slope of the rod: (B - A) dB = 0."""
    scene = SLIDER_CRANK.replace("points.A.angle", angle)
    found, (A, B) = coefficients(scene, "B along frame"), places(scene, "AB")
    assert found == pytest.approx({"O A": crank, "A B": rod, "3 along frame": found["3 along frame"]}, abs=1e-6)
    assert found["3 along frame"] == pytest.approx(-(B - A).imag / (B - A).real, rel=1e-9)


@pytest.mark.parametrize("length", LENGTHS)
def test_four_bar_changes_as_its_placed_points_do(length: str) -> None:
    """The coefficient of each length is the change of the rocker's angle where the scene is written with another."""
    path, step = LENGTHS[length], 1e-3
    given: Any = {"O A": 40, "A B": 120, "B C": 80, "O C": 100}[length]

    def angle(value: float) -> float:
        C, B = places(FOUR_BAR.replace(path, value), "CB")
        return cmath.phase(B - C)

    slope = (angle(given + step) - angle(given - step)) / (2 * step)
    assert coefficients(FOUR_BAR, "angle 3")[length] == pytest.approx(slope, rel=1e-6)


def test_sum_and_probable_error_are_those_of_the_parts() -> None:
    """Errors are sizes of coefficients times tolerances; they add up, and their squares."""
    errors = gp.position_errors(FOUR_BAR).json()["errors"]["angle 3"]
    parts = [abs(part["coefficient"]) * tolerance
             for part, tolerance in zip(errors["parts"].values(), (0.1, 0.2, 0.3, 0.4), strict=True)]
    assert [part["error"] for part in errors["parts"].values()] == pytest.approx(parts)
    assert (errors["sum"], errors["probable"]) == pytest.approx((sum(parts), math.hypot(*parts)))


def test_an_angle_of_a_link_is_a_dimension() -> None:
    """As the angle BAM grows by a degree, the pin M of the coupler goes round A."""
    scene = gp.load(CASES / "angle.toml")
    A, B, M = places(scene, "ABM")
    sense = 1 if ((B - A).conjugate() * (M - A)).imag > 0 else -1
    assert coefficients(scene, "D along frame")["B A M"] == pytest.approx(sense * math.radians((M - A).real), rel=1e-9)


def test_the_sheets_name_each_dimension(tmp_path: Path) -> None:
    """There is a plate for each dimension, which says of which it is."""
    gp.position_errors(SLIDER_CRANK).save(tmp_path / "e.svg")
    said = "".join(page.read_text("utf-8") for page in tmp_path.glob("e*.svg")).replace("&#160;", " ")
    for dimension in ("O A", "A B", "3 along frame"):
        assert f"Ozols 18-1: error of {dimension}" in said
