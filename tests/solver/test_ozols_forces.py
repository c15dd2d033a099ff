"""Forces in the groups and examples of O. Ozols, Mehanismu un masinu teorija (Riga 1974), chapters 9 and 10.

The numbers of the groups and the computed values of the examples are those of the catalogue, which solved each group
and each machine by other means. A group hangs on the frame here, as in the book on links whose motion is known.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import pytest
from by_hand import Written, force, hold, loads, mass, mechanism, moment, slide, turn

from graphplan.mechanism.model import Force, Moment, Number, Pair, Scene, Slide, Units
from graphplan.solver import power, reactions, solve
from graphplan.solver.statics import acting

METRES = Units(length="m")
G = 9.81  # the book's kgf in newtons
both = pytest.mark.parametrize("exact", [False, True])


def xy(z: complex) -> tuple[float, float]:
    """A complex number as a pair."""
    return z.real, z.imag


def along(vector: Pair, direction: Sequence[float]) -> float:
    """The component of a vector along a direction of any length."""
    return float(vector[0] * direction[0] + vector[1] * direction[1]) / math.hypot(*direction)


def digits(*values: float) -> object:
    """Equal to the five decimals that the catalogue gives."""
    return pytest.approx(values if len(values) > 1 else values[0], abs=6e-6)


A, B, C = ("0", "0"), ("0.9", "0.1"), ("0.4", "0.5")
DYAD = loads(
    force("i", "P", (300, -420)), moment("i", 25), force("k", "Q", (-180, -260)), moment("k", -14),
)  # fmt: skip


def dyad(i: str, k: str, frame: str, slides: Sequence[Slide] = (), **points: tuple[Written, Written]) -> Scene:
    """A dyad of the links i and k: forces come out on them from the frame, and on i from k."""
    points |= {"P": ("0.15", "0.3"), "Q": ("0.62", "0.22")}
    links = {"frame": frame, "k": f"{k} Q", "i": f"{i} P"}
    return mechanism(points, links, slides=slides, loads=DYAD, units=METRES)


def slid(found: tuple[Pair, Number], direction: Sequence[float]) -> tuple[float, float]:
    """A slide's force across the guide, and how far along the guide from its point the force acts."""
    across = along(found[0], (-direction[1], direction[0]))
    assert along(found[0], direction) == pytest.approx(0, abs=1e-9)
    return across, float(found[1]) / across


@both
def test_dyad_of_three_hinges(exact: bool) -> None:
    """Modification 1: all three forces."""
    found = reactions(dyad("A C", "C B", "A B", A=A, B=B, C=C), exact)
    assert found.joints["A", "i"] == digits(-65.46341, 393.17073)
    assert found.joints["B", "k"] == digits(-54.53659, 286.82927)
    assert found.joints["C", "i"] == digits(-234.53659, 26.82927)


@both
def test_dyad_with_an_outer_slide(exact: bool) -> None:
    """Modification 2: the slide's force and its arm about the joint."""
    found = reactions(dyad("A C", "C", "A", [slide("k", "frame", "C", (1, "0.2"))], A=A, C=C), exact)
    assert found.joints["A", "i"] == digits(-63.2, 396)
    assert found.joints["C", "i"] == digits(-236.8, 24)
    assert slid(found.slides["k along frame"], (1, 0.2)) == digits(289.62431, 0.419854)


@both
def test_dyad_with_an_inner_slide(exact: bool) -> None:
    """Modification 3: the force between the sliding links acts far outside them."""
    found = reactions(dyad("A B1", "B", "A B", [slide("i", "k", "B1", (1, "0.2"))], A=A, B=B, B1=B), exact)
    assert found.joints["A", "i"] == digits(-289.65217, 368.26087)
    assert found.joints["B", "k"] == digits(169.65217, 311.73913)
    assert slid(found.slides["i along k"], (1, 0.2)) == digits(52.76377, 1.523773)


@both
def test_dyad_with_two_outer_slides(exact: bool) -> None:
    """Modification 4: both arms are about the joint."""
    guides = [slide("i", "frame", "C", (1, "0.3")), slide("k", "frame", "C", ("-0.4", 1))]
    found = reactions(dyad("C", "C", "", guides, C=C), exact)
    assert found.joints["C", "i"] == digits(-105, -230)
    assert slid(found.slides["i along frame"], (1, 0.3)) == digits(678.61992, -0.279980)
    assert slid(found.slides["k along frame"], (-0.4, 1)) == digits(-80.77747, -1.505370)


@both
def test_dyad_with_an_outer_and_an_inner_slide(exact: bool) -> None:
    """Modification 5: both arms are about the outer joint."""
    guides = [slide("i", "frame", "B1", (1, "0.3")), slide("i", "k", "B1", ("-0.4", 1))]
    found = reactions(dyad("B1", "B", "B", guides, B=B, B1=B), exact)
    assert found.joints["B", "k"] == digits(24.64286, 197.85714)
    assert slid(found.slides["i along frame"], (1, 0.3)) == digits(503.37192, -0.715972)
    assert slid(found.slides["i along k"], (-0.4, 1)) == digits(167.32476, 0.480503)


@both
def test_triad(exact: bool) -> None:
    """A ternary link on three bars, all four links loaded."""
    points = {
        "A": (0, 0), "B": ("1.2", "-0.1"), "C": ("0.7", "1.1"), "E": ("0.35", "0.3"), "F": ("0.85", "0.25"),
        "G": ("0.6", "0.7"), "P": ("0.2", "0.1"), "Q": (1, "0.1"), "R": ("0.65", "0.9"), "S": ("0.6", "0.4"),
    }  # fmt: skip
    given = loads(
        force("1", "P", (100, -50)), force("2", "Q", (-40, -80)), force("3", "R", (20, -60)),
        force("4", "S", (70, -120)), moment("1", 3), moment("2", -2), moment("3", 1), moment("4", 5),
    )  # fmt: skip
    links = {"frame": "A B C", "1": "A E P", "2": "B F Q", "3": "C G R", "4": "E F G S"}
    found = reactions(mechanism(points, links, loads=given, units=METRES), exact)
    printed = {
        ("A", "1"): (-79.5238, 18.9796), ("B", "2"): (-91.1565, 148.2993), ("C", "3"): (20.6803, 142.7211),
        ("E", "4"): (20.4762, -31.0204), ("F", "4"): (-131.1565, 68.2993), ("G", "4"): (40.6803, 82.7211),
    }  # fmt: skip
    assert found.joints == {name: pytest.approx(value, abs=6e-5) for name, value in printed.items()}


def compressor() -> Scene:
    """Example 9-1 in metres: a central slider-crank at 30 degrees, 300 rpm, centres of mass C1, C2 and B."""
    a = cmath.rect(0.2, math.radians(30))
    b = a.real + math.sqrt(0.48**2 - a.imag**2)
    points = {"O": (0, 0), "A": xy(a), "B": (b, 0), "C1": xy(a * 0.3), "C2": xy(a + (b - a) / 3)}
    return mechanism(
        points,
        {"1": "O A C1", "2": "A B C2", "3": "B", "frame": "O"},
        [turn("1", 10 * math.pi)],
        [slide("3", "frame", "B", (1, 0))],
        loads=loads(
            masses={"1": mass(40, 0, "C1"), "2": mass(20, 20 * 0.15 * 0.48**2, "C2"), "3": mass(30, 0, "B")},
            balances=[hold("1")],
        ),
        units=METRES,
    )


def test_inertia_forces_of_a_compressor() -> None:
    """The inertia forces and the rod's couple of example 9-1, in the book's kgf."""
    scene = compressor()
    given = acting(scene, solve(scene))
    found = {load.on: (load.value[0] / G, load.value[1] / G) for load in given if isinstance(load, Force)}
    couples = {load.on: load.value / G for load in given if isinstance(load, Moment)}
    assert math.hypot(*found["1"]) == pytest.approx(241.5, abs=0.05)
    assert found["2"] == pytest.approx((379.0, 134.1), abs=0.05)
    assert found["3"] == pytest.approx((660.1, 0), abs=0.05)
    assert couples["2"] == pytest.approx(-12.80, abs=0.005)


def oscillating_cylinder() -> Scene:
    """Example 10-1 in metres: a piston 2 in a swinging cylinder 3, at 120 degrees, 300 rpm clockwise."""
    b = cmath.rect(0.2, math.radians(120))
    guide = (b - 0.5) / abs(b - 0.5)
    points = {"O": (0, 0), "A": (0.5, 0), "B": xy(b), "C": xy(b - 0.4 * guide)}
    pressure = 150 * G * guide
    return mechanism(
        points,
        {"1": "O B", "2": "B C", "3": "A", "frame": "O A"},
        [turn("1", -10 * math.pi)],
        [slide("2", "3", "C", xy(guide))],
        loads=loads(
            force("2", "C", xy(pressure)),
            force("3", "A", xy(-pressure)),
            masses={"1": mass(50, 0, "O"), "2": mass(10, "0.4", "C"), "3": mass(40, "1.2", "A")},
            gravity=(0, -9.81),
            balances=[hold("1")],
        ),
        units=METRES,
    )


def test_oscillating_cylinder() -> None:
    """The reactions and the balance of example 10-1, in kgf and kgf m; T is along the cylinder, N across it."""
    scene = oscillating_cylinder()
    found, guide = reactions(scene), scene.slides[0].direction
    across = (-guide[1], guide[0])

    def parts(point: str, link: str) -> tuple[float, float]:
        return along(found.joints[point, link], guide) / G, along(found.joints[point, link], across) / G

    assert parts("B", "2") == pytest.approx((-270.79, 60.22), abs=0.005)
    assert parts("A", "frame") == pytest.approx((-161.09, 16.86), abs=0.005)
    assert parts("O", "frame") == pytest.approx((256.92, -12.19), abs=0.006)
    size, from_c = slid(found.slides["2 along 3"], guide)
    assert size / G == pytest.approx(21.57, abs=0.005)
    assert math.dist(scene.points["A"], scene.points["C"]) + from_c == pytest.approx(-0.6693, abs=5e-5)
    for opinion in found.balances, power(scene):
        assert opinion == (pytest.approx(-28.872 * G, abs=0.0005 * G),)
