"""Laws: closed forms, fractions, derivatives, closing over the turn, and shocks."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import pi

import numpy as np
import pytest

from graphplan.cams.law import HARD, MOTIONS, ORDERS, SOFT, Law, LawStage, spline

EXACT = {name for name, pieces in MOTIONS.items() if not any(piece.waves for piece in pieces)}
LARGEST = {  # of velocity and acceleration, in strokes by stages (Ozols 1974, 20-2), and the jerk's where it is finite
    "uniform": (1, 0, None), "parabolic": (2, 4, None), "harmonic": (pi / 2, pi**2 / 2, None),
    "sine": (2, 2 * pi, 4 * pi**2), "trapezoid": (2, 16 / 3, 128 / 3), "3-4-5": (15 / 8, 10 / 3**0.5, 60),
}  # fmt: skip
SHOCKS = {"uniform": {HARD}, "parabolic": {SOFT}, "harmonic": {SOFT}, "sine": set(), "trapezoid": set(), "3-4-5": set(),
          "dwell": set()}


def stage(motion: str, angle: int, stroke: int) -> LawStage:
    """A stage of a motion."""
    return LawStage(Fraction(angle), Fraction(stroke), motion, tuple(piece.times(stroke) for piece in MOTIONS[motion]))


def there_and_back(motion: str, stroke: int = 25) -> Law:
    """A rise over 120 degrees, a dwell, and a return over 90."""
    return Law((stage(motion, 120, stroke), stage("dwell", 60, 0), stage(motion, 90, -stroke), stage("dwell", 90, 0)))


@pytest.mark.parametrize("motion", LARGEST)
def test_motions_go_from_0_to_1(motion: str) -> None:
    """Each motion has its textbook's largest velocity, acceleration and jerk, and its pieces meet."""
    pieces = MOTIONS[motion]
    t = np.linspace(0, 1, 2401)
    values = [np.concatenate([piece.value_at(t[(t >= float(piece.start)) & (t <= float(piece.end))], order)
                              for piece in pieces]) for order in range(ORDERS)]
    assert (values[0][0], values[0][-1]) == pytest.approx((0, 1), abs=1e-15)
    for found, largest in zip(values[1:], LARGEST[motion], strict=True):
        assert largest is None or max(abs(found)) == pytest.approx(largest, rel=1e-5, abs=1e-12)
    for before, after in pairwise(pieces):
        assert before.value_at(before.end) == after.value_at(after.start)


@pytest.mark.parametrize("motion", sorted(EXACT))
def test_powers_are_exact(motion: str) -> None:
    """A law of powers gives fractions of fractions, which floats follow to rounding."""
    rise = stage(motion, 120, 25 * (motion != "dwell"))
    law = Law((rise, stage("uniform", 240, -25 * (motion != "dwell"))))
    for angle in (Fraction(10), Fraction(100, 3), Fraction(111)):
        found = next(piece for piece in reversed(rise.pieces) if 120 * piece.start <= angle).value_at(angle / 120)
        assert isinstance(found, Fraction)
        assert law.value_at(float(angle)) == pytest.approx(float(found), rel=1e-14, abs=1e-14)


@pytest.mark.parametrize("motion", MOTIONS)
def test_derivatives_are_those_of_the_lift(motion: str) -> None:
    """Each derivative of a law is the one before it differentiated numerically."""
    law, h = there_and_back(motion, 25 * (motion != "dwell")), np.degrees(1e-4)
    inside = np.array([7.0, 40.0, 71.0, 111.0, 190.0, 221.0, 233.0, 263.0, 300.0])
    for order in range(1, ORDERS):
        sloped = (law.value_at(inside + h, order - 1) - law.value_at(inside - h, order - 1)) / 2e-4
        assert law.value_at(inside, order) == pytest.approx(sloped, rel=2e-6, abs=2e-5)


@pytest.mark.parametrize("motion", MOTIONS)
def test_shocks_are_told(motion: str) -> None:
    """Uniform motion shocks hard, parabolic and harmonic motion softly, the others not at all."""
    law = there_and_back(motion, 25 * (motion != "dwell"))
    assert {jump.order for jump in law.jumps} == SHOCKS[motion]
    steepest, turn = {"parabolic": 4, "harmonic": pi**2 / 2}.get(motion, 0), 2 * pi / 3
    first = {HARD: 25 / turn, SOFT: steepest * 25 / turn**2}
    for jump in law.jumps[:1]:
        assert (float(jump.angle), jump.before, jump.after) == pytest.approx((0, 0, first[jump.order]))


def test_splines_are_smooth_and_exact() -> None:
    """A spline goes through its pairs, at rest at its ends or around the turn, with one velocity and acceleration."""
    knots, lifts = [Fraction(k, 6) for k in range(7)], [Fraction(k) for k in (0, 1, 5, 9, 6, 2, 0)]
    for closed in (False, True):
        pieces = spline(knots, lifts, closed)
        assert [piece.value_at(piece.start) for piece in pieces] == lifts[:-1]
        for before, after in zip(pieces, (*pieces[1:], pieces[0]), strict=True):
            if after is not pieces[0] or closed:
                assert [before.value_at(before.end, k) for k in (1, 2)] == [after.value_at(after.start, k)
                                                                            for k in (1, 2)]
        assert closed or (pieces[0].value_at(knots[0], 1), pieces[-1].value_at(knots[-1], 1)) == (0, 0)
