"""Rules lose no more digits than their figure does, against exact fractions made from the same floats."""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random
from typing import Any

import pytest

from graphplan.errors import Undrawable
from graphplan.kernel import TABLE
from graphplan.kernel.numbers import Floats, Fractions

EPS = 2.0**-52
TURNS = ("parallel", "perpendicular")
TILTS = (0.0, 1e-14, -1e-14, 1e-10, 1e-6, 1e-2, 1.0)


def both(name: str, *args: Any, **params: Any) -> tuple[Any, Any]:
    """The rule on floats, and on the fractions that these floats are."""
    exact = [tuple(map(Fraction, arg)) for arg in args]
    return TABLE[name].rule(Floats(), *args, **params), TABLE[name].rule(Fractions(), *exact, **params)


def point(r: Random) -> tuple[float, float]:
    return r.uniform(-10, 10), r.uniform(-10, 10)


def line(angle: float, through: tuple[float, float]) -> tuple[float, float, float]:
    """A line with a given direction."""
    a, b = -math.sin(angle), math.cos(angle)
    return a, b, -(a * through[0] + b * through[1])


def off(exact: Any, X: Any) -> float:
    """How far a point lies from where it should."""
    return math.hypot(*(float(p - Fraction(q)) for p, q in zip(exact, X, strict=True)))


def apart(exact: Any, l: Any) -> float:
    """How far two lines of 1-norm one are apart in their numbers."""
    size = abs(exact[0]) + abs(exact[1])
    return max(abs(float(p / size - Fraction(q))) for p, q in zip(exact, l, strict=True))


def strength(turn: str, A: Any, alpha: Any, B: Any, beta: Any, C: Any) -> float:
    """How well two loci determine the third, at most one: small where the pole lies in C."""
    quarter = 1 if turn == "parallel" else 1j
    u, v = (quarter * (complex(*P) - complex(*C)) for P in (A, B))
    n, m = complex(*alpha[:2]), complex(*beta[:2])
    return abs((m.conjugate() * v).real * n - (n.conjugate() * u).real * m) / (abs(u) + abs(v))


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("tilt", TILTS)
def test_carry_is_good_where_the_auxiliary_point_is_far(tilt: float, turn: str) -> None:
    """With loci parallel to within 1e-14, or quite, Q is far away or nowhere: the third locus is as good as ever."""
    r = Random(f"{tilt} {turn}")
    for _ in range(200):
        A, B, C, angle = point(r), point(r), point(r), r.uniform(0, math.tau)
        alpha, beta = line(angle, point(r)), line(angle + tilt, point(r))
        got, exact = both("carry", A, alpha, B, beta, C, turn=turn)
        reach = 1 + abs(alpha[2]) + abs(beta[2]) + abs(got[2])
        assert apart(exact, got) <= 8 * EPS * reach / strength(turn, A, alpha, B, beta, C)


@pytest.mark.parametrize("tilt", TILTS[1:])
def test_meet_is_as_good_as_its_crossing(tilt: float) -> None:
    """Two lines meet to a rounding over the sine of their angle; within a rounding of parallel they do not."""
    r = Random(f"{tilt}")
    for _ in range(200):
        angle = r.uniform(0, math.tau)
        k, l = line(angle, point(r)), line(angle + tilt, point(r))
        sine = float(abs(Fraction(k[0]) * Fraction(l[1]) - Fraction(l[0]) * Fraction(k[1])))
        try:
            got, exact = both("meet", k, l)
        except Undrawable:
            assert sine < 4 * EPS
        else:
            assert off(exact, got) <= 4 * EPS / sine * (20 + math.hypot(*map(float, exact)))


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("tilt", TILTS)
def test_settle_rests_on_the_locus_that_tells_more(tilt: float, turn: str) -> None:
    """Where one locus runs along its own side of the figure, the other one settles it to a few roundings."""
    r = Random(f"{tilt} {turn}")
    for _ in range(200):
        C, c, A, B = point(r), point(r), point(r), point(r)
        quarter, grown = (1 if turn == "parallel" else 1j), r.uniform(0.5, 2)
        CA, CB = (quarter * (complex(*P) - complex(*C)) for P in (A, B))
        a, b = (complex(*c) + grown * side for side in (CA, CB))
        alpha = line(math.atan2(CA.imag, CA.real) + tilt, (a.real, a.imag))
        beta = line(math.atan2(CB.imag, CB.real) + 1.0, (b.real, b.imag))
        got, exact = both("settle", C, c, A, alpha, B, beta, turn=turn)
        assert off(exact, got) <= 100 * EPS * (abs(a) + abs(b)) * max(1.0, abs(CA) / abs(CB))


@pytest.mark.parametrize("tilt", TILTS)
def test_false_position_is_as_good_as_its_trials(tilt: float) -> None:
    """The true position loses digits only as far as the trials miss by the same amount."""
    r = Random(f"{tilt}")
    for _ in range(200):
        A1, A2, Z1, angle = point(r), point(r), point(r), r.uniform(0, math.tau)
        Z2 = Z1[0] + math.cos(angle + tilt), Z1[1] + math.sin(angle + tilt)
        locus = line(angle, point(r))
        errors = [sum(Fraction(p) * Fraction(q) for p, q in zip(locus, (*Z, 1.0), strict=True)) for Z in (Z1, Z2)]
        gap = float(abs(errors[0] - errors[1]))
        try:
            got, exact = both("false_position", A1, A2, Z1, locus, Z2, locus)
        except Undrawable:
            assert gap < 100 * EPS
        else:
            assert off(exact, got) <= 100 * EPS * (20 + math.hypot(*map(float, exact))) / gap


@pytest.mark.parametrize("radius", [1.0, 1e3, 1e6, 1e9])
def test_circles_of_unlike_size_meet_well(radius: float) -> None:
    """A small circle about a point of a large one is crossed to a rounding of the large one."""
    r = Random(f"{radius}")
    for _ in range(100):
        angle = r.uniform(0, math.tau)
        k, m = (0.0, 0.0, radius * radius), (radius * math.cos(angle), radius * math.sin(angle), 0.25)
        x, y = TABLE["circles_meet"].rule(Floats(), k, m, side="left")
        assert abs(math.hypot(x - m[0], y - m[1]) - 0.5) <= 4 * EPS * radius
        assert abs(math.hypot(x, y) - radius) <= 4 * EPS * radius
