"""The examples of O. Ozols, Mehanismu un masinu teorija (Riga 1974), chapter 5, to the digits of the catalogue."""

from __future__ import annotations

import cmath
import math

import pytest
from by_hand import mechanism, push, slide, turn

from graphplan.mechanism.model import Pair, Scene
from graphplan.solver import solve


def xy(z: complex) -> tuple[float, float]:
    """A complex number as a pair."""
    return z.real, z.imag


def size(vector: Pair) -> float:
    """The length of a vector."""
    return math.hypot(*vector)


def ray(degrees: float) -> complex:
    """The unit vector at an angle."""
    return cmath.rect(1, math.radians(degrees))


def digits(expected: float) -> object:
    """Equal to the six decimals or digits that the catalogue gives."""
    return pytest.approx(expected, rel=2e-6, abs=1e-6)


def apex(a: complex, from_a: float, b: complex, from_b: float) -> complex:
    """The point at given distances from a and b, to the left of the ray from a to b."""
    along = (abs(b - a) ** 2 + from_a**2 - from_b**2) / (2 * abs(b - a))
    return a + complex(along, math.sqrt(from_a**2 - along**2)) * (b - a) / abs(b - a)


def slider_crank(omega: float) -> Scene:
    """Example 5-1 in metres: crank 250, connecting rod 730, offset 107 mm, at 20 degrees."""
    o = 0.107j
    a = o + 0.25 * ray(20)
    b = complex(a.real + math.sqrt(0.73**2 - a.imag**2))
    c = a + (b - a) * 0.34 / 0.73
    points = {"O": xy(o), "A": xy(a), "B": xy(b), "C": xy(c)}
    links = {"1": "O A", "2": "A B C", "3": "B", "frame": "O"}
    return mechanism(points, links, [turn("1", omega)], [slide("3", "frame", "B", (1, 0))])


@pytest.mark.parametrize(
    ("omega", "v_b", "v_c", "omega_2", "a_b", "a_c", "alpha_2"),
    [
        (10.0, 1.4973, 1.7051, 3.3362, 29.578, 26.720, 9.1000),
        (95 * 2 * math.pi / 60, 1.4896, 1.6963, 3.3190, 29.2735, 26.445, 9.0063),
    ],
)
def test_offset_slider_crank(
    omega: float, v_b: float, v_c: float, omega_2: float, a_b: float, a_c: float, alpha_2: float
) -> None:
    """The slider-crank of example 5-1 has the exact rates of the table: the rod clockwise, the piston to the left."""
    rates = solve(slider_crank(omega))
    assert rates.velocity["B"] == pytest.approx((-v_b, 0), abs=6e-5)
    assert rates.slide_velocity["3 along frame"] == pytest.approx((-v_b, 0), abs=6e-5)
    assert rates.acceleration["B"] == pytest.approx((-a_b, 0), abs=6e-4)
    assert size(rates.velocity["C"]) == pytest.approx(v_c, abs=6e-5)
    assert size(rates.acceleration["C"]) == pytest.approx(a_c, abs=6e-4)
    assert (rates.omega["2"], rates.alpha["2"]) == pytest.approx((-omega_2, alpha_2), abs=6e-5)


def slotted_link(drive: object) -> tuple[Scene, complex]:
    """Example 5-2 in millimetres: a block on a guide 20 beside its pivot O, on a rocker of 250 about (100, 0)."""
    guide = ray(60)
    foot = -20j * guide
    lead = ((100 - foot) * guide.conjugate()).real
    s = lead + math.sqrt(250**2 - abs(foot + lead * guide - 100) ** 2)
    a = foot + s * guide
    points = {"O": (0, 0), "C": (100, 0), "A": xy(a), "F": xy(a + complex(50, 30) * guide)}
    links = {"1": "O", "2": "A F", "3": "C A", "frame": "O C"}
    return mechanism(points, links, [drive], [slide("2", "1", "A", xy(guide))]), guide


def test_rotating_slotted_link() -> None:
    """The slotted link of example 5-2, driven at the guide, slides and turns as differentiated."""
    scene, guide = slotted_link(turn("1", 10))
    rates = solve(scene)
    assert scene.points["A"] == pytest.approx((162.803, 241.983), abs=1e-3)
    assert rates.slide_velocity["2 along 1"] == pytest.approx(xy(-1004.225 * guide), abs=1e-3)
    assert rates.slide_acceleration["2 along 1"] == pytest.approx(xy(-3723.068 * guide), abs=1e-3)
    assert (rates.omega["3"], rates.alpha["3"]) == (digits(12.074991), digits(-34.749832))
    assert (size(rates.velocity["A"]), size(rates.acceleration["A"])) == (digits(3018.748), digits(37472.294))
    assert (size(rates.velocity["F"]), size(rates.acceleration["F"])) == (digits(3583.995), digits(43299.832))


def test_slotted_link_driven_by_its_slide() -> None:
    """The same mechanism, example 5-3, driven by a constant speed of the block along the turning guide."""
    rates = solve(slotted_link(push("2", "1", 500))[0])
    assert (rates.omega["1"], rates.omega["3"]) == (digits(-4.978964), digits(-6.012094))
    assert (rates.alpha["1"], rates.alpha["3"]) == (digits(-9.190684), digits(-19.712253))


def test_six_link_with_swinging_guide() -> None:
    """Example 5-4: a point of a four-bar's coupler drives a swinging guide through a block."""
    a = 25 * ray(50)
    b = apex(a, 60, 60, 45)
    d = a + 40 * (b - a) / abs(b - a) * ray(35)
    e = complex(20, 90)
    points = {"O": (0, 0), "C": (60, 0), "A": xy(a), "B": xy(b), "D": xy(d), "E": xy(e)}
    links = {"1": "O A", "2": "A B D", "3": "C B", "4": "D", "5": "E", "frame": "O C E"}
    rates = solve(mechanism(points, links, [turn("1", 8, 12)], [slide("4", "5", "D", xy(e - d))]))
    assert [b, d] == pytest.approx([70.828 + 43.678j, 36.594 + 53.484j], abs=1e-3)
    assert (rates.omega["2"], rates.omega["3"]) == (digits(-1.860753), digits(2.462812))
    assert (rates.omega["5"], rates.alpha["5"]) == (digits(-1.095350), digits(-62.503040))
    assert size(rates.slide_velocity["4 along 5"]) == pytest.approx(119.225, abs=1e-3)


def test_fan_driven_by_a_relative_rotation() -> None:
    """Example 5-5: a four-bar whose coupler is turned against the crank, as in a fan driven by its own motor."""
    diagonal = math.sqrt(100**2 + 40**2 - 2 * 100 * 40 * math.cos(math.radians(70)))
    b = apex(0, diagonal, 60, 110)
    a = apex(0, 100, b, 40)
    points = {"O": (0, 0), "C": (60, 0), "A": xy(a), "B": xy(b)}
    links = {"1": "O A", "2": "A B", "3": "C B", "frame": "O C"}
    rates = solve(mechanism(points, links, [turn("2", 12, relative_to="1")]))
    assert [a, b] == pytest.approx([-36.951 + 92.923j, 3.032 + 94.099j], abs=1e-3)
    assert rates.omega == {"1": digits(-8.138972), "2": digits(3.861028), "3": digits(-7.988959)}
    assert (rates.alpha["1"], rates.alpha["3"]) == (digits(-15.214981), digits(3.746078))


def test_lift_by_a_cylinder() -> None:
    """Example 6-6: a cylinder that lengthens at a constant speed turns a lever through a sliding drive."""
    gamma = math.acos((0.35**2 + 0.5**2 - 0.4**2) / (2 * 0.35 * 0.5))
    b = cmath.rect(0.35, gamma)
    points = {"A": (0.5, 0), "C": (0, 0), "B": xy(b), "E": xy(b * 0.6 / 0.35)}
    links = {"1": "C B E", "2": "A", "3": "B", "frame": "A C"}
    rates = solve(mechanism(points, links, [push("3", "2", 0.08)], [slide("3", "2", "B", xy(b - 0.5))]))
    assert (rates.omega["1"], rates.alpha["1"]) == (digits(0.230127), digits(0.00556024))
    assert (size(rates.velocity["E"]), size(rates.acceleration["E"])) == (digits(0.138076), digits(0.0319497))
