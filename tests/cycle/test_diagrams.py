"""Graphical differentiation and integration are exact in fractions, err as theory says, and bridge no gap."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from random import Random
from typing import Any

import numpy as np
import pytest

import graphplan as gp
from graphplan.cycle.diagrams import (
    PANELS,
    FoundCurve,
    KinematicCurve,
    KinematicDiagram,
    axes,
    by_chords,
    by_tangents,
    curve_over_travel,
    diagram,
    integrate,
)
from graphplan.kernel import Board, Mark
from graphplan.kernel.numbers import Fractions
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import evaluate

HO = Fraction(25)
CHORDS, TANGENTS = FoundCurve("v", "by chords"), FoundCurve("v", "by tangents")


def exact(board: Board, marks: list[Mark]) -> list[Any]:
    """The values of marks, in fractions."""
    program = freeze(board, marks)
    values = evaluate(program, Fractions())
    return [values[index] for index in program.wanted]


@pytest.mark.parametrize("seed", range(5))
def test_chords_are_difference_quotients_and_are_integrated_back(seed: int) -> None:
    """By chords the ordinate is HO times the strip's difference quotient, exactly, in the middle of the strip; and
    integration of what they gave ends in the points it began with."""
    board, r = Board(coplanar=True), Random(seed)
    spots = [(Fraction(x, 3), Fraction(r.randint(-50, 50), 7)) for x in sorted(r.sample(range(100), 7))]
    points = [board.given(x=x, y=y, name=f"s_{k}") for k, (x, y) in enumerate(spots)]
    rate = axes(board, PANELS["v"], "v", HO)
    found = [ray.ordinate for ray in by_chords(board, points, rate, [""] * 6)]
    back = integrate(board, found, points[0], points, rate, [""] * 6)
    wanted = [((x + u) / 2, HO * (v - y) / (u - x)) for (x, y), (u, v) in pairwise(spots)]
    assert exact(board, [*found, *(ray.end for ray in back)]) == wanted + spots[1:]


def test_tangents_are_central_differences() -> None:
    """By tangents the ordinate at a point is HO times the quotient over the two strips beside it, exactly."""
    board = Board(coplanar=True)
    points = [board.given(x=Fraction(k), y=Fraction(k**3, 5), name=f"s_{k}") for k in range(6)]
    rays = by_tangents(board, points, axes(board, PANELS["v"], "v", HO), [""] * 4)
    wanted = [(Fraction(k), HO * (3 * k * k + 1) / 5) for k in range(1, 5)]
    assert exact(board, [ray.ordinate for ray in rays]) == wanted


def polynomial(power: int, positions: int = 48) -> KinematicCurve:
    """s = t^power over three seconds."""
    t = np.linspace(0, 3, positions + 1)
    return KinematicCurve("x_B", "mm", t, t, t**power, power * t ** (power - 1), power * (power - 1) * t ** (power - 2))


@cache
def crank(positions: int = 96) -> KinematicCurve:
    """The piston of the packaged slider-crank over one turn, its rates from the replayed plans."""
    scene = gp.load("slider-crank")
    turn = gp.follow(scene, positions + 1, (0, 360))
    poses = gp.construct(scene).evaluate(turn)
    travel = np.radians(turn.travel)
    return KinematicCurve("x_B", "mm", travel, travel / 10, turn.points["B"].real, poses.velocity["B"].real,
                          poses.acceleration["B"].real, closed=True)


def error(drawn: KinematicDiagram, found: FoundCurve) -> Any:
    """The error of one curve found."""
    return next(error for error in drawn.errors if error.curve == found)


def test_errors_are_known() -> None:
    """A parabola is differentiated without error; of t^3 chords err by h^2/4, tangents by h^2, in the second order."""
    for found in (CHORDS, TANGENTS):
        of = error(diagram(polynomial(2)), found)
        assert of.largest < 1e-13
        assert of.order is None
    drawn = diagram(polynomial(3))
    h, middle, last = 3 / 24, 3 - 3 / 48, 3 - 3 / 24
    assert error(drawn, CHORDS).largest == pytest.approx(h**2 / 4 / (3 * middle**2), rel=1e-9)
    assert error(drawn, TANGENTS).rms == pytest.approx(h**2 / (3 * last**2), rel=1e-9)
    assert error(drawn, CHORDS).order == pytest.approx(2, rel=1e-9)


def test_all_is_of_the_second_order_around_a_cycle() -> None:
    """On a mechanism's replayed plans every way is of the second order, and chords err least; mu_v = mu_s/(mu_t HO),
    and so for the acceleration, exactly."""
    drawn = diagram(crank())
    assert len(drawn.errors) == 6
    assert all(1.9 < of.order < 2.1 for of in drawn.errors if of.order is not None)
    assert 3.5 < error(drawn, TANGENTS).rms / error(drawn, CHORDS).rms < 4.5
    assert error(drawn, FoundCurve("a", "by chords")).largest < 0.02
    for upper, rate in (("s", "v"), ("v", "a")):
        scales = drawn.scales.time, drawn.scales.ordinates[upper], drawn.scales.ordinates[rate]
        mu_t, mu, mu_rate = (Fraction(repr(axis.unit)) for axis in scales)
        assert mu_rate * mu_t * drawn.scales.poles[rate] == mu
        assert 5 <= drawn.scales.poles[rate] <= 40


@pytest.mark.parametrize("rate", [2.0, -2.0])
def test_a_followed_turn_is_closed(rate: float) -> None:
    """The end of a turn is added and angles are unwrapped, whichever way the drive turns; rates are found at both ends
    and are equal there."""
    travel, way = np.arange(48) * (2 * np.pi / 48), np.sign(rate)
    psi = np.angle(np.exp(1j * way * (travel + np.sin(travel) / 3)))
    v, a = rate * (1 + np.cos(travel) / 3), -way * rate**2 * np.sin(travel) / 3
    curve = curve_over_travel("psi_2", "rad", travel, rate, psi, v, a, period=2 * np.pi)
    assert curve.closed
    assert len(curve.time) == 49
    assert curve.s[-1] - curve.s[0] == pytest.approx(np.copysign(2 * np.pi, rate))
    drawn = diagram(curve)
    assert {of.curve.quantity for of in drawn.errors} == {"s", "v", "a"}
    assert all(of.largest < 0.03 for of in drawn.errors)
    for found in (TANGENTS, FoundCurve("a", "by chords"), FoundCurve("a", "by tangents")):
        [points] = drawn.points(found)
        assert points[0] == pytest.approx((0, points[-1][1]), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("lost", [range(41, 42), range(40, 52), range(10), range(90, 97)])
def test_gaps_are_never_bridged(lost: range) -> None:
    """No chord spans an unknown position, though it lie inside a strip; beyond the gap integration starts anew."""
    whole, s = crank(), crank().s.copy()
    s[list(lost)] = np.nan
    curve = replace(whole, s=s)
    drawn = diagram(curve)
    for found, parts in drawn.traces.items():
        for ray in (ray for part in parts for ray in part):
            start, end = drawn.scales.time.value([ray.start[0], ray.end[0]])
            between = (whole.time > start) & (whole.time < end)
            assert curve.is_known[between].all(), found
    assert np.isnan(curve.values_at("v", whole.time[list(lost)])).all()
    for (x, y), *_ in drawn.points(FoundCurve("s", "integrated")):
        (s,) = drawn.scales.ordinates["s"].mm(curve.values_at("s", drawn.scales.time.value([x])))
        assert y == pytest.approx(s, rel=1e-12, abs=1e-12)
    assert 20 <= sum(map(len, drawn.traces[CHORDS])) <= 23
