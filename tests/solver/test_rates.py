"""The analytic solver against what does not depend on it: rigid lengths, differentiated positions, exact fractions."""

from __future__ import annotations

import cmath
import math
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import combinations
from pathlib import Path

import pytest
from by_hand import Written, mechanism, move, push, slide, turn
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.model import Number, Pair, Scene
from graphplan.solver import Rates, solve


def xy(z: complex) -> tuple[float, float]:
    """A complex number as a pair."""
    return z.real, z.imag


def dot(a: Pair, b: Pair) -> Number:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1]


def less(a: Pair, b: Pair) -> Pair:
    """The difference of two vectors."""
    return a[0] - b[0], a[1] - b[1]


def stretching(scene: Scene, rates: Rates) -> Iterator[Number]:
    """Half of the first and of the second derivative of the square of every length within a link: all should vanish."""
    for names in scene.links.values():
        for p, q in combinations(names, 2):
            side, v, a = (less(of[p], of[q]) for of in (scene.points, rates.velocity, rates.acceleration))
            yield dot(side, v)
            yield dot(v, v) + dot(side, a)


def largest(vectors: dict[str, Pair]) -> float:
    """The largest component, or 1."""
    return max((abs(float(x)) for vector in vectors.values() for x in vector), default=0) or 1


BASIC_CASE = mechanism(
    {
        "K": (-4, 0), "L": (-1, -1), "A": ("-3.5", 4), "B": ("-0.5", 5), "C": (2, 7),
        "D": (5, 6), "E": (8, "4.5"), "M": (5, 0), "N": (10, 1),
    },
    {"1": "A K", "2": "B L", "3": "D M", "4": "E N", "5": "A B C", "6": "C D E"},
    motions={
        "K": move((10, 5), (3, -8)), "L": move((2, "-7.5"), (1, 1)),
        "M": move((0, 3), (-20, 4)), "N": move((-6, 1), (5, "0.1")),
    },
)  # fmt: skip

SLOTTED_LINK = mechanism(
    {"O": (0, 0), "A": (3, 4), "E": (3, -8), "F": (1, 0)},
    {"1": "O A", "2": "A", "3": "E F", "frame": "O E"},
    [turn("1", "2.5", -1)],
    [slide("2", "3", "A", (0, 5))],
)

DOUBLE_JOINT = mechanism(
    {"O": (0, 0), "A": (2, 1), "B": (5, 4), "C": (9, 1), "D": (6, 9), "E": (1, 8)},
    {"1": "O A", "2": "A B", "3": "B C", "4": "B D", "5": "D E", "frame": "O C E"},
    [turn("1", 3, 7)],
)

ACTUATOR = mechanism(
    {"A": (4, 0), "C": (0, 0), "B": (0, 3), "E": (1, 6)},
    {"1": "C B E", "2": "A", "3": "B", "frame": "A C"},
    [push("3", "2", 2, "0.5")],
    [slide("3", "2", "B", (-4, 3))],
)

Moving = Callable[[float], tuple[Scene, dict[str, float]]]

rational = pytest.mark.parametrize("scene", [BASIC_CASE, SLOTTED_LINK, DOUBLE_JOINT, ACTUATOR])


@rational
def test_no_link_is_stretched(scene: Scene) -> None:
    """In exact numbers the first and second derivatives of every length within a link are zero."""
    assert set(stretching(scene, solve(scene, exact=True))) == {0}


@rational
def test_fractions_equal_floats(scene: Scene) -> None:
    """Every exact result is a Fraction, every other a float, and they differ by rounding only."""
    exact, rough = solve(scene, exact=True), solve(scene)
    for kind in "omega", "alpha":
        assert {type(value) for value in getattr(exact, kind).values()} == {Fraction}
        assert {type(value) for value in getattr(rough, kind).values()} == {float}
        assert getattr(rough, kind) == pytest.approx(getattr(exact, kind), rel=1e-13, abs=1e-13)
    for kind in "velocity", "acceleration", "slide_velocity", "slide_acceleration":
        vectors, rounded = getattr(exact, kind), getattr(rough, kind)
        assert {type(x) for vector in vectors.values() for x in vector} <= {Fraction}
        assert {type(x) for vector in rounded.values() for x in vector} <= {float}
        assert rounded.keys() == vectors.keys()
        for name in vectors:
            assert rounded[name] == pytest.approx(vectors[name], abs=1e-14 * largest(vectors))


def test_basic_case_keeps_the_given_motions() -> None:
    """Rosenauer's open chain, without a frame, takes over the given motions exactly and names only its own links."""
    rates = solve(BASIC_CASE, exact=True)
    for point, motion in BASIC_CASE.motions.items():
        assert (rates.velocity[point], rates.acceleration[point]) == (motion.velocity, motion.acceleration)
    assert list(rates.omega) == ["1", "2", "3", "4", "5", "6"]


def test_frame_rests() -> None:
    """Points of the frame have zero velocity and acceleration, points of no link have none, the frame no omega."""
    rates = solve(replace(SLOTTED_LINK, points=SLOTTED_LINK.points | {"Z": (Fraction(9), Fraction(9))}))
    assert rates.velocity["E"] == rates.acceleration["E"] == rates.velocity["O"] == (0.0, 0.0)
    assert "Z" not in rates.velocity
    assert "frame" not in rates.omega


def test_slide_is_along_its_guide() -> None:
    """A slide's velocity and acceleration lie along the guide; an actuator's are what its drive prescribes."""
    rates = solve(ACTUATOR, exact=True)
    assert rates.slide_velocity["3 along 2"] == (Fraction(-8, 5), Fraction(6, 5))
    assert rates.slide_acceleration["3 along 2"] == (Fraction(-2, 5), Fraction(3, 10))


def crossing(a: complex, from_a: float, b: complex, from_b: float) -> complex:
    """The point at given distances from a and b, to the left of the ray from a to b."""
    along = (abs(b - a) ** 2 + from_a**2 - from_b**2) / (2 * abs(b - a))
    return a + complex(along, math.sqrt(from_a**2 - along**2)) * (b - a) / abs(b - a)


def four_bar(t: float) -> tuple[Scene, dict[str, float]]:
    """A four-bar after t seconds at omega = 2 + 3 t, with its angles."""
    phi = 0.7 + 2 * t + 1.5 * t * t
    a = cmath.rect(2, phi)
    b = crossing(a, 5, 6, 4)
    m = a + (b - a) * (0.4 + 0.7j)
    points = {"O": (0.0, 0.0), "C": (6.0, 0.0), "A": xy(a), "B": xy(b), "M": xy(m)}
    links = {"1": "O A", "2": "A B M", "3": "C B", "frame": "O C"}
    angles = {"1": phi, "2": cmath.phase(b - a), "3": cmath.phase(b - 6)}
    return mechanism(points, links, [turn("1", 2 + 3 * t, 3)]), angles


def swinging_link(t: float) -> tuple[Scene, dict[str, float]]:
    """A slotted link that swings about E, led by a crank pin, with its angles."""
    phi = 0.4 + 5 * t - 2 * t * t
    a, e = cmath.rect(3, phi), -8j
    arm = a - e
    points = {"O": (0.0, 0.0), "E": xy(e), "A": xy(a), "M": xy(e + arm / abs(arm) * (9 + 1j))}
    links = {"1": "O A", "2": "A", "3": "E M", "frame": "O E"}
    angles = {"1": phi, "2": cmath.phase(arm), "3": cmath.phase(arm)}
    return mechanism(points, links, [turn("1", 5 - 4 * t, -4)], [slide("2", "3", "A", xy(arm))]), angles


def two_cranks(t: float) -> tuple[Scene, dict[str, float]]:
    """A five-bar with two drives, with its angles."""
    phi, psi = 1.2 + 3 * t, 0.6 - 2 * t + t * t
    a, c = cmath.rect(2, phi), 7 + cmath.rect(3, psi)
    b = crossing(a, 6, c, 5)
    points = {"O": (0.0, 0.0), "D": (7.0, 0.0), "A": xy(a), "B": xy(b), "C": xy(c)}
    links = {"1": "O A", "2": "A B", "3": "B C", "4": "D C", "frame": "O D"}
    angles = {"1": phi, "2": cmath.phase(b - a), "3": cmath.phase(c - b), "4": psi}
    return mechanism(points, links, [turn("1", 3), turn("4", 2 * t - 2, 2)]), angles


def place(motion: Moving, point: str, t: float) -> complex:
    """Where a point is after t seconds."""
    x, y = motion(t)[0].points[point]
    return complex(x, y)


def angle(motion: Moving, link: str, t: float) -> complex:
    """The angle of a link after t seconds."""
    return motion(t)[1][link]


def derivatives(at: Callable[[float], complex], h: float = 2e-3) -> tuple[complex, complex]:
    """First and second derivative at 0 by differences of the fourth order."""
    far_back, back, here, ahead, far_ahead = (at(k * h) for k in (-2, -1, 0, 1, 2))
    first = (far_back - 8 * back + 8 * ahead - far_ahead) / (12 * h)
    return first, (-far_back + 16 * back - 30 * here + 16 * ahead - far_ahead) / (12 * h * h)


@pytest.mark.parametrize("motion", [four_bar, swinging_link, two_cranks])
def test_rates_are_derivatives(motion: Moving) -> None:
    """Velocities, accelerations and turnings equal the numerically differentiated positions and angles."""
    scene, angles = motion(0)
    rates = solve(scene)
    for p in scene.points:
        first, second = derivatives(partial(place, motion, p))
        assert complex(*rates.velocity[p]) == pytest.approx(first, rel=1e-7, abs=1e-7)
        assert complex(*rates.acceleration[p]) == pytest.approx(second, rel=1e-6, abs=1e-6)
    for link in angles:
        first, second = derivatives(partial(angle, motion, link))
        assert (rates.omega[link], rates.alpha[link]) == pytest.approx((first.real, second.real), rel=1e-6, abs=1e-6)


def test_slide_rates_are_derivatives() -> None:
    """What the block does along the swinging link is the derivative of its distance from the pivot."""

    def distance(t: float) -> float:
        return abs(place(swinging_link, "A", t) - place(swinging_link, "E", t))

    scene, rates = swinging_link(0)[0], solve(swinging_link(0)[0])
    guide = complex(*scene.slides[0].direction)
    first, second = (value.real * guide / abs(guide) for value in derivatives(distance))
    assert rates.slide_velocity["2 along 3"] == pytest.approx(xy(first), rel=1e-7)
    assert rates.slide_acceleration["2 along 3"] == pytest.approx(xy(second), rel=1e-6)


def chain(coordinates: list[tuple[int, int]]) -> Scene:
    """A crank O A with dyads built on it one after the other: each pair of points is a new joint and its pivot."""
    points: dict[str, tuple[int, int]] = {"O": (0, 0), "A": coordinates[0]}
    links, last, pivots = {"1": "O A"}, "A", "O"
    for k, (joint, pivot) in enumerate(zip(coordinates[1::2], coordinates[2::2], strict=True)):
        points |= {f"B{k}": joint, f"C{k}": pivot}
        links |= {str(2 * k + 2): f"{last} B{k}", str(2 * k + 3): f"B{k} C{k}"}
        last, pivots = f"B{k}", f"{pivots} C{k}"
    return mechanism(points, links | {"frame": pivots}, [turn("1", 1, 2)])


places = st.tuples(st.integers(-9, 9), st.integers(-9, 9))
chains = st.integers(0, 4).flatmap(lambda n: st.lists(places, min_size=2 * n + 1, max_size=2 * n + 1)).map(chain)


@given(chains)
@settings(max_examples=60, deadline=None)
def test_random_chains(scene: Scene) -> None:
    """Any chain of dyads is singular for fractions and floats alike, or rigid exactly and equal up to its condition."""
    try:
        exact = solve(scene, exact=True)
    except SingularPose as error:
        with pytest.raises(SingularPose, match=re.escape(str(error))):
            solve(scene)
        return
    assert set(stretching(scene, exact)) == {0}
    rough = solve(scene)
    assume(rough.condition < 1e6)
    for kind in "velocity", "acceleration":
        vectors, rounded = getattr(exact, kind), getattr(rough, kind)
        for p in vectors:
            assert rounded[p] == pytest.approx(vectors[p], abs=largest(vectors) * rough.condition * 1e-14)


@given(chains, places)
@settings(max_examples=20, deadline=None)
def test_origin_does_not_matter(scene: Scene, offset: tuple[int, int]) -> None:
    """A scene moved bodily has the same rates, even far away, to the last bit where the move is exact."""
    far = tuple(2**20 * step for step in offset)
    moved = replace(scene, points={p: (x + far[0], y + far[1]) for p, (x, y) in scene.points.items()})
    try:
        here = solve(scene)
    except SingularPose:
        assume(False)
    assert solve(moved) == here


def test_condition_has_no_unit() -> None:
    """The condition is the same in metres and in millimetres, and grows towards a singular pose."""
    scene = four_bar(0)[0]
    in_mm = replace(scene, points={p: (1000 * x, 1000 * y) for p, (x, y) in scene.points.items()})
    assert solve(in_mm).condition == pytest.approx(solve(scene).condition, rel=1e-9)
    near = mechanism(
        {"O": (0, 0), "A": (1, "0.0001"), "B": (4, 0), "C": (4, 3)},
        {"1": "O A", "2": "A B", "3": "C B", "frame": "O C"},
        [turn("3", 1)],
    )
    assert 1 < solve(scene).condition < 100 < 1e4 < solve(near, exact=True).condition


def test_irrational_scene_is_refused_exactly() -> None:
    """Exact numbers of an irrational scene are refused with the scene's reasons; floats are not."""
    scene = replace(four_bar(0)[0], irrational=("points.A: placed by an angle",))
    with pytest.raises(Refused, match=r"points\.A: placed by an angle"):
        solve(scene, exact=True)
    assert solve(scene).omega["1"] == pytest.approx(2)


def test_actuator_of_irrational_length_is_refused_exactly() -> None:
    """An actuator along a direction of irrational length cannot be solved in fractions."""
    with pytest.raises(Refused):
        solve(replace(ACTUATOR, written=(slide("3", "2", "B", (-1, 2)), *ACTUATOR.drives)), exact=True)


def test_lengths_far_apart() -> None:
    """A crank a billion times shorter than its coupler is solved as well in floats as in fractions."""
    points: dict[str, tuple[Written, Written]] = {
        "O": (0, 0),
        "A": ("6e-10", "8e-10"),
        "B": (10**9, 5 * 10**8),
        "C": (2 * 10**9, 0),
    }
    scene = mechanism(points, {"1": "O A", "2": "A B", "3": "C B", "frame": "O C"}, [turn("1", 1)])
    exact, rough = solve(scene, exact=True), solve(scene)
    assert rough.omega == pytest.approx(exact.omega, rel=1e-12)
    assert rough.alpha == pytest.approx(exact.alpha, rel=1e-9, abs=1e-30)


def test_forty_links_exactly() -> None:
    """Forty links with decimal coordinates are solved in fractions: no bar grows longer."""
    coordinates = [(3, 4)] + [(10 * k + 7 * (k % 3) + 5, 17 * (k % 2) + k % 5) for k in range(40)]
    scene = chain(coordinates)
    scene = replace(scene, points={p: (x + x * x / 1009, y + x / 997) for p, (x, y) in scene.points.items()})
    assert {*stretching(scene, solve(scene, exact=True))} == {0}


def test_exact_path_does_without_numpy() -> None:
    """Solving in fractions does not import numpy, and neither does importing the solver."""
    code = """
import sys
sys.path[:0] = sys.argv[1:]
from by_hand import mechanism, turn
from graphplan.solver import solve
solve(mechanism({"O": (0, 0), "A": (1, 2)}, {"1": "O A", "frame": "O"}, [turn("1", 1)]), exact=True)
assert "numpy" not in sys.modules
"""
    here = Path(__file__).parent
    subprocess.run([sys.executable, "-c", code, str(here), str(here.parents[1])], check=True)
