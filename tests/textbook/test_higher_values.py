"""Gears, cams and Geneva wheels by the books' formulas: exactly where these are rational, else to their digits."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import pytest

from graphplan.check.trusted import report
from graphplan.mechanism.scene import load, parse


def exactly(name: str) -> dict[str, Any]:
    """What the construction of a packaged scene gives in fractions."""
    return dict(report(load(name), exact=True).results)




def test_a_flat_follower_goes_as_a_sine() -> None:
    """Ozols 5-6, OC = 20 at 40 degrees and 10 rad/s: 0.153209 m/s and -1.285575 m/s^2."""
    x, y = 20 * math.cos(math.radians(40)), 20 * math.sin(math.radians(40))
    results = report(parse(f"""[points]
O = [0, 0]
C = [{x!r}, {y!r}]
K = [{x!r}, {y + 40!r}]
D = [0, {y + 40!r}]
[links]
1 = "O C"
2 = "D"
frame = "O"
[[contacts]]
links = ["1", "2"]
at = "K"
centres = ["C", [1, 0]]
[[slides]]
link = "2"
along = "frame"
at = "D"
direction = [0, 1]
[[drive]]
link = "1"
omega = 10
[find]
velocity = ["D"]
acceleration = ["D"]
""", "T-5-6")).results
    assert results["velocity"]["D"] == pytest.approx((0, 153.209), abs=5e-4)
    assert results["acceleration"]["D"] == pytest.approx((0, -1285.575), abs=5e-4)


def test_a_slider_cranks_coupler_has_its_poles_and_centres() -> None:
    """Ozols 5-1 on a slider-crank, r = 30, b = 100, slide at y = 10: the pole, and a coupler point's centre."""
    A = complex(30 * math.cos(math.radians(40)), 30 * math.sin(math.radians(40)))
    B = complex(A.real + math.sqrt(100**2 - (A.imag - 10) ** 2), 10)
    M = A + (0.4 + 0.7j) * (B - A)
    results = report(parse(f"""[points]
O = [0, 0]
A = [{A.real!r}, {A.imag!r}]
B = [{B.real!r}, {B.imag!r}]
M = [{M.real!r}, {M.imag!r}]
[links]
1 = "O A"
2 = "A B M"
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
[find]
poles = ["2 frame"]
curvature = ["M on 2"]
""", "T-infl")).results
    assert results["pole"]["2 frame"] == pytest.approx((122.549, 102.831), abs=1e-3)
    assert results["centre of curvature"]["M on 2"] == pytest.approx((65.371, 83.969), abs=1e-3)


def test_a_biplanetary_gear_has_its_ratio() -> None:
    """Ozols 7-2: i_1H = 1 + (1 + r_H/r_1) r_3/r_2, by the velocities of the outer planet's ends."""
    r1, r2, r3, rH = (Fraction(radius) for radius in (10, 20, 30, 15))
    assert exactly("biplanetary")["omega"]["1"] / 4 == 1 + (1 + rH / r1) * r3 / r2


def test_davids_gear_is_ten_thousand_times_slower() -> None:
    """Ozols, example 7-4: the wheel 1 turns once in 10,000 turns of the carrier, the same way."""
    omega, (x, y) = Fraction(100, 10_000), load("david").points["B"]
    assert exactly("david")["velocity"]["B"] == (-omega * y, omega * x)


def test_fergusons_planet_translates_in_a_circle() -> None:
    """Ozols, example 7-3: behind an idler a wheel with as many teeth as the one that stands still does not turn."""
    results = report(parse("""[points]
O = [0, 0]
A = [30, 40]
B = [-10, 70]
M = [-20, 90]
[links]
H = "O A B"
2 = "A"
1 = "B M"
frame = "O"
[[gears]]
links = ["frame", "2"]
centres = ["O", "A"]
teeth = [20, 30]
[[gears]]
links = ["2", "1"]
centres = ["A", "B"]
teeth = [30, 20]
[[drive]]
link = "H"
omega = 4
alpha = 3
[find]
velocity = ["B", "M"]
acceleration = ["B", "M"]
links = ["1"]
""", "Ferguson"), exact=True).results
    assert (results["omega"]["1"], results["alpha"]["1"]) == (0, 0)
    assert results["velocity"]["M"] == results["velocity"]["B"]
    assert results["acceleration"]["M"] == results["acceleration"]["B"]


def test_the_rim_of_cardans_circle_runs_straight() -> None:
    """Points of the rim neither leave their diameters of the ring nor begin to."""
    results = exactly("cardan-circles")
    for kind in ("velocity", "acceleration"):
        assert (results[kind]["M"][1], results[kind]["N"][0]) == (0, 0)
        assert all(any(results[kind][point]) for point in "MN")


@pytest.mark.parametrize("name", ["geneva", "geneva-slide"])
def test_a_geneva_wheel_turns_by_its_formulas(name: str) -> None:
    """Ozols (19.13), (19.14): the wheel's turning from the pin's radius and angle; outside, so the other way round."""
    results, points = exactly(name), load(name).points
    cosine, sine = (part / points["C"][0] for part in points["A"])  # times lambda
    square, far = cosine**2 + sine**2, 1 - 2 * cosine + cosine**2 + sine**2
    assert results["omega"]["2"] == -10 * (cosine - square) / far
    assert results["alpha"]["2"] == 100 * sine * (1 - square) / far**2
