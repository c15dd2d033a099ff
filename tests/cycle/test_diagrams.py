"""Graphical differentiation and integration are exact in fractions, err as theory says, and bridge no gap."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from random import Random
from typing import Any

import numpy as np
import pytest

from graphplan import construct, load
from graphplan.cycle.curves import KinematicCurve, curve_over_travel
from graphplan.cycle.diagrams import FoundCurve, KinematicDiagram, axes, by_chords, by_tangents, diagram, integrate
from graphplan.errors import Refused
from graphplan.kernel import Board, Mark
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import evaluate
from graphplan.output import plots

HO = Fraction(25)
CHORDS, TANGENTS = FoundCurve("v", "by chords"), FoundCurve("v", "by tangents")


def marked(board: Board, spots: list[tuple[Fraction, Fraction]]) -> list[Mark]:
    """Points of a diagram, given."""
    return [board.given(x=x, y=y, name=f"s_{k}") for k, (x, y) in enumerate(spots)]


def exact(board: Board, marks: list[Mark]) -> list[Any]:
    """The values of marks, in fractions."""
    program = freeze(board, marks)
    values = evaluate(program, Fractions())
    return [values[index] for index in program.wanted]


def scattered(r: Random) -> list[tuple[Fraction, Fraction]]:
    """Seven points in strips of uneven width."""
    xs = sorted(r.sample(range(100), 7))
    return [(Fraction(x, 3), Fraction(r.randint(-50, 50), 7)) for x in xs]


def polynomial(power: int, positions: int = 48) -> KinematicCurve:
    """s = t^power over three seconds."""
    t = np.linspace(0, 3, positions + 1)
    return KinematicCurve("x_B", "mm", t, t, t**power, power * t ** (power - 1), power * (power - 1) * t ** (power - 2))


@cache
def crank(positions: int = 96) -> KinematicCurve:
    """The piston of the packaged slider-crank over one turn, its rates from the replayed plans."""
    scene = load("slider-crank")
    O, A, B, S = (complex(*map(float, scene.points[name])) for name in "OABS")
    turn = np.linspace(0, 2 * np.pi, positions + 1)
    a = (A - O) * np.exp(1j * turn)
    b = a.real + np.sqrt(abs(B - A) ** 2 - a.imag**2)
    poses = construct(scene).evaluate(points={"A": a, "B": b + 0j, "S": a + (b - a) * ((S - A) / (B - A))})
    return KinematicCurve("x_B", "mm", turn, turn / 10, b, poses.velocity["B"].real, poses.acceleration["B"].real,
                          closed=True)


@pytest.mark.parametrize("seed", range(5))
def test_chords_are_difference_quotients(seed: int) -> None:
    """By chords the ordinate is HO times the strip's difference quotient, exactly, in the middle of the strip."""
    board, spots = Board(coplanar=True), scattered(Random(seed))
    rays = by_chords(board, marked(board, spots), axes(board, "v", "v", HO), [""] * 6)
    wanted = [((x + u) / 2, HO * (v - y) / (u - x)) for (x, y), (u, v) in pairwise(spots)]
    assert exact(board, [ray.ordinate for ray in rays]) == wanted


def test_tangents_are_central_differences() -> None:
    """By tangents the ordinate at a point is HO times the quotient over the two strips beside it, exactly."""
    board, spots = Board(coplanar=True), [(Fraction(k), Fraction(k**3, 5)) for k in range(6)]
    rays = by_tangents(board, marked(board, spots), axes(board, "v", "v", HO), [""] * 4)
    wanted = [(Fraction(k), HO * (3 * k * k + 1) / 5) for k in range(1, 5)]
    assert exact(board, [ray.ordinate for ray in rays]) == wanted


@pytest.mark.parametrize("seed", range(5))
def test_integrating_the_chords_gives_the_diagram_back(seed: int) -> None:
    """Integration of what differentiation by chords gave ends in the points it began with, exactly."""
    board, spots = Board(coplanar=True), scattered(Random(seed))
    points, rate = marked(board, spots), axes(board, "v", "v", HO)
    found = [ray.ordinate for ray in by_chords(board, points, rate, [""] * 6)]
    back = integrate(board, found, points[0], points, rate, [""] * 6)
    assert exact(board, [ray.end for ray in back]) == spots[1:]


def test_one_program_serves_every_number() -> None:
    """The diagrams' construction gives the same in floats, in arrays of one, and in fractions to rounding."""
    drawn = diagram(crank(), strips=12)
    given = {step.name: step.params for step in drawn.program.steps if step.op.name == "given"}
    arrays = {name: {key: np.array([value]) for key, value in spot.items()} for name, spot in given.items()}
    lifted = {name: {key: Fraction(value) for key, value in spot.items()} for name, spot in given.items()}
    floats = evaluate(drawn.program, Floats(), given)
    fractions = evaluate(drawn.program, Fractions(), lifted)
    for index, many in enumerate(evaluate(drawn.program, Arrays(), arrays)):
        assert [float(np.squeeze(number)) for number in many] == list(floats[index])
    for index in drawn.program.wanted:
        assert floats[index] == pytest.approx([float(number) for number in fractions[index]], rel=1e-12, abs=1e-11)


def test_the_scales_agree() -> None:
    """mu_v = mu_s/(mu_t HO), and so for the acceleration, exactly; the ordinates at the divisions have room."""
    scales = diagram(crank()).scales
    for upper, rate in (("s", "v"), ("v", "a")):
        axes = scales.time, scales.ordinates[upper], scales.ordinates[rate]
        mu_t, mu, mu_rate = (Fraction(repr(axis.unit)) for axis in axes)
        assert mu_rate * mu_t * scales.poles[rate] == mu
        assert 5 <= scales.poles[rate] <= 40
    assert all(30 <= np.ptp(scales.ordinates[quantity].mm(crank().values(quantity))) <= 62 for quantity in "sva")


def error(drawn: KinematicDiagram, found: FoundCurve) -> Any:
    """The error of one curve found."""
    return next(error for error in drawn.errors if error.curve == found)


def test_a_parabola_is_differentiated_without_error() -> None:
    """A parabola's chord is parallel to its tangent over the middle: both ways are exact to rounding, of no order."""
    for found in (CHORDS, TANGENTS):
        of = error(diagram(polynomial(2)), found)
        assert of.largest < 1e-13
        assert of.order is None


def test_the_errors_of_a_cubic_are_known() -> None:
    """For t^3 and strips of width h chords err by h^2/4, tangents by h^2, and in the second order of h."""
    drawn = diagram(polynomial(3))
    h, middle, last = 3 / 24, 3 - 3 / 48, 3 - 3 / 24
    assert error(drawn, CHORDS).largest == pytest.approx(h**2 / 4 / (3 * middle**2), rel=1e-9)
    assert error(drawn, TANGENTS).rms == pytest.approx(h**2 / (3 * last**2), rel=1e-9)
    assert error(drawn, CHORDS).order == pytest.approx(2, rel=1e-9)


def test_all_is_of_the_second_order_around_a_cycle() -> None:
    """On a mechanism's replayed plans every way is of the second order, and chords err least."""
    drawn = diagram(crank())
    assert len(drawn.errors) == 6
    assert all(1.9 < of.order < 2.1 for of in drawn.errors if of.order is not None)
    assert 3.5 < error(drawn, TANGENTS).rms / error(drawn, CHORDS).rms < 4.5
    assert error(drawn, FoundCurve("a", "by chords")).largest < 0.02


def test_a_period_closes() -> None:
    """Around a turn rates are found at both ends and are equal there, also for a link that turns all the way round."""
    turn = np.linspace(0, 2 * np.pi, 49)
    psi = KinematicCurve("psi_2", "rad", turn, turn, turn + np.sin(turn) / 3, 1 + np.cos(turn) / 3, -np.sin(turn) / 3,
                         True)
    drawn = diagram(psi)
    for found in (TANGENTS, FoundCurve("a", "by chords"), FoundCurve("a", "by tangents")):
        [points] = drawn.points(found)
        assert len(points) == 25
        assert points[0] == pytest.approx((0, points[-1][1]), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("rate", [2.0, -2.0])
def test_a_followed_turn_is_closed(rate: float) -> None:
    """The end of a turn is added and angles are unwrapped, whichever way the drive turns: its travel counts so."""
    travel, way = np.arange(48) * (2 * np.pi / 48), np.sign(rate)
    psi = np.angle(np.exp(1j * way * (travel + np.sin(travel) / 3)))
    v, a = rate * (1 + np.cos(travel) / 3), -way * rate**2 * np.sin(travel) / 3
    curve = curve_over_travel("psi_2", "rad", travel, rate, psi, v, a, period=2 * np.pi)
    assert curve.closed
    assert len(curve.time) == 49
    assert curve.s[-1] - curve.s[0] == pytest.approx(np.copysign(2 * np.pi, rate))
    assert {of.curve.quantity for of in diagram(curve).errors} == {"s", "v", "a"}
    assert all(of.largest < 0.03 for of in diagram(curve).errors)


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
    assert all(np.isfinite(spot).all() for found in drawn.traces for part in drawn.points(found) for spot in part)
    assert np.isnan(curve.values_at("v", whole.time[list(lost)])).all()
    for (x, y), *_ in drawn.points(FoundCurve("s", "integrated")):
        (s,) = drawn.scales.ordinates["s"].mm(curve.values_at("s", drawn.scales.time.value([x])))
        assert y == pytest.approx(s, rel=1e-12, abs=1e-12)
    assert 20 <= sum(map(len, drawn.traces[CHORDS])) <= 23


def test_what_stands_still_has_no_errors() -> None:
    """A quantity that does not move is drawn as a straight line, rounding in its rates is not blown up."""
    t = np.linspace(0, 1, 25)
    still = KinematicCurve("y_B", "mm", t, t, 80 + 0 * t, 1e-14 * np.sin(9 * t), 1e-13 * np.cos(9 * t))
    assert diagram(still).errors == ()
    assert np.ptp(diagram(still).scales.ordinates["v"].mm(still.v)) < 1e-9
    assert "y" in plots.diagrams([diagram(still)], "Still")


@pytest.mark.parametrize(("change", "says"), [
    ({"time": np.zeros(49)}, "times do not increase"),
    ({"v": np.zeros(3)}, "shapes"),
    ({"a": np.full(49, np.nan)}, "no position"),
])
def test_curves_that_cannot_be_drawn_are_refused(change: dict[str, Any], says: str) -> None:
    """Arrays of other shapes, time that stands and a range out of reach are refused in one line."""
    with pytest.raises(Refused, match=f"diagram of x_B: .*{says}.*; "):
        replace(polynomial(2), **change)


def test_more_strips_than_positions_are_refused() -> None:
    """The abscissa cannot be divided more finely than the positions are known."""
    with pytest.raises(Refused, match="49 positions"):
        diagram(polynomial(2), strips=49)


def test_the_plot_is_the_same_text_whenever_written() -> None:
    """Scales, poles, division numbers and errors stand on the plot, which is the same text twice."""
    drawn = diagram(crank())
    text = plots.diagrams([drawn, drawn], "Slider-crank")
    assert text == plots.diagrams([diagram(crank()), drawn], "Slider-crank")
    words = re.sub(r"<[^>]*>|\s", "", re.sub(r"<defs>.*?</defs>", "", text, flags=re.DOTALL))
    for quantity, distance in drawn.scales.poles.items():
        assert f"{quantity}inmm/s" in words
        assert f"O{quantity}H{quantity}={float(distance):g}mm" in words
    assert f"{100 * error(drawn, CHORDS).largest:.2g}" in re.findall(r">([\d.]+)<", text)
    assert "360°" in words
    assert "date" not in text


def test_five_quantities_need_two_rows() -> None:
    """Four columns stand side by side; the fifth quantity makes the sheet higher, not wider."""
    drawn = diagram(polynomial(3), strips=4)
    (w1, h1), (w4, h4), (w5, h5) = (
        map(float, re.findall(r'viewBox="0 0 (\S+) (\S+)"', plots.diagrams([drawn] * count, "Columns"))[0])
        for count in (1, 4, 5)
    )
    assert w1 < w4 == w5
    assert h1 == h4 < h5
