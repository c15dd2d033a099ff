"""Functions of travel between their breaks, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphplan.errors import Refused
from graphplan.machine.integrals import fit_piecewise

TURN = 2 * math.pi
KINK = 2.0  # a travel that no break names


@pytest.mark.parametrize(("function", "breaks", "integral"), [
    (lambda x: np.sin(x) ** 2, (0, TURN), lambda x: x / 2 - math.sin(2 * x) / 4),
    (lambda x: np.exp(x), (0, 1, TURN), lambda x: math.exp(x) - 1),
    (lambda x: 1 / (1.01 + np.cos(x - 3)), (0, TURN), None),
    (lambda x: np.abs(x - KINK), (0, TURN), lambda x: KINK**2 / 2 + math.copysign((x - KINK) ** 2 / 2, x - KINK)),
    (lambda x: np.where(x < KINK, -1.0, 3.0), (0, TURN), lambda x: -x if x < KINK else -KINK + 3 * (x - KINK)),
    (lambda x: 0 * x, (-1, TURN), lambda x: 0.0),
], ids=["wave", "growing", "peak", "corner", "jump", "nothing"])
def test_running_integral(function, breaks, integral):
    """A running integral is that of the closed form anywhere, whether breaks name the corners or not."""
    found = fit_piecewise(function, breaks).integral()
    if integral is None:
        assert found.at(TURN) == pytest.approx(TURN / math.sqrt(1.01**2 - 1), rel=1e-11)
        return
    size = max(abs(integral(x)) for x in (1.0, KINK, TURN)) or 1.0
    for x in (0.0, 0.3, 1.0, KINK, 4.4, TURN):
        assert found.at(x) == pytest.approx(integral(x), abs=1e-11 * size)


def test_sides_of_a_jump():
    """At a break a function has two values, one from each side, and its integral has one."""
    found = fit_piecewise(lambda x: np.where(x < 1, x, 5.0), (0, 1, 2))
    assert (found.at(1.0, side=-1), found.at(1.0, side=1)) == pytest.approx((1, 5))
    assert found.integral().at([1.0, 1.0], side=-1) == pytest.approx([0.5, 0.5])
    assert found.total_integral == pytest.approx(5.5)


def test_several_functions_at_once():
    """Functions of the same travels share panels, add up, and are each as they are alone."""
    sine, cosine = fit_piecewise(lambda x: np.array([np.sin(x), np.cos(x)]), (0, TURN))
    assert (sine * 3 + cosine + 2).at(1.0) == pytest.approx(3 * math.sin(1) + math.cos(1) + 2, abs=1e-12)
    assert sine.roots() == pytest.approx([math.pi], abs=1e-14)
    assert cosine.roots() == pytest.approx([math.pi / 2, 3 * math.pi / 2], abs=1e-14)
    (low, least), (high, most) = sine.extremes(cosine)
    assert (low, least, high, most) == pytest.approx((3 * math.pi / 2, -1, math.pi / 2, 1), abs=1e-13)


def test_roots_at_jumps_and_zeros():
    """A sign changes at a jump, and on a stretch where the function is nothing; where it only touches it does not."""
    assert fit_piecewise(lambda x: np.where(x < 1, -1.0, 2.0), (0, 1, 3)).roots() == pytest.approx([1])
    assert fit_piecewise(lambda x: (x - 1) ** 2, (0, 3)).roots() == pytest.approx([])
    flat = fit_piecewise(lambda x: np.where(x < 1, x - 1, np.where(x < 2, 0.0, x - 2)), (0, 1, 2, 3)).roots()
    assert [1 <= root <= 2 for root in flat] == [True]


def test_noise_of_what_cancels():
    """Where large numbers cancel, their rounding is no wave to be followed."""
    noise = fit_piecewise(lambda x: (np.sin(x) + 1e6) - 1e6 - np.sin(x), (0, TURN), size=1e6)
    assert len(noise.edges) < 20


@pytest.mark.parametrize("function", [lambda x: 1 / x, lambda x: np.sqrt(x - 1)], ids=["pole", "unreached"])
def test_no_limit(function):
    """A function that grows beyond all bounds, or is unknown somewhere, is refused with the travel."""
    with np.errstate(invalid="ignore"), pytest.raises(Refused, match="travel"):
        fit_piecewise(function, (0, 1, 3))
