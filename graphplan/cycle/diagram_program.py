"""The construction of kinematic diagrams: what is given, and what is found from it by differentiating and integrating.

The displacement diagram is differentiated twice, by chords and by tangents; the plans' acceleration is integrated
twice. All coordinates are mm of paper, in each diagram from its own origin; abscissas are common to the three.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphplan.cycle.chords import Axes, Ray, around, axes, by_chords, by_tangents, feet, integrate
from graphplan.cycle.curves import QUANTITIES, ROUNDING, Curve, Places, Reals
from graphplan.cycle.diagram_scales import DiagramScales
from graphplan.kernel.evaluate import evaluate
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, Mark, Panel, Program

PANELS = {quantity: Panel(f"{quantity} diagram") for quantity in QUANTITIES}
CHORDS, TANGENTS, INTEGRATED = "by chords", "by tangents", "integrated"

Spot = tuple[float, float]


class Found(NamedTuple):
    """What was found and how: s, v or a; by chords, by tangents or integrated."""

    quantity: str
    method: str


Traces = dict[Found, list[list[Ray[Spot]]]]


@dataclass(frozen=True)
class _Given:
    """What a stretch of positions gives: their numbers, the points of the displacement diagram, the first point of the
    velocity diagram, and the ordinates of the acceleration diagram at the middle of the strips. Only where the strips
    are `even` is a chord over two of them parallel to the tangent between."""

    numbers: list[int]
    even: bool
    points: list[Mark]
    start: Mark
    middles: list[Mark]


@dataclass(frozen=True)
class _Rates:
    """The axes of the velocity and acceleration diagrams, the letters of all three, and whether they close a period."""

    v: Axes
    a: Axes
    letters: tuple[str, ...]
    closed: bool


def constructed(curve: Curve, scales: DiagramScales, places: Places) -> tuple[Program, Traces]:
    """The program that finds the rates and integrals of a curve, and the rays that it draws, stretch by stretch.

    Reads the positions, by place, at which the abscissa is divided.
    """
    board, stretches = Board(), curve.stretches(places)
    given = [_given(board, curve, scales, places, stretch) for stretch in stretches]
    v, a = (axes(board, PANELS[rate], curve.letters[rate], scales.poles[rate]) for rate in QUANTITIES[1:])
    rates = _Rates(v, a, tuple(curve.letters.values()), curve.closed and bool(curve.known.all()))
    figures = [_found(board, one, rates) for one in given]
    wanted = [mark for figure in figures for rays in figure.values() for ray in rays for mark in ray]
    program = freeze(board, wanted)
    values = evaluate(program, Floats())
    spots = iter([values[index] for index in program.wanted])
    traces: Traces = {}
    for figure in figures:
        for found, rays in figure.items():
            traces.setdefault(found, []).append([Ray(*(next(spots) for _ in ray)) for ray in rays])
    return program, traces


def _given(board: Board, curve: Curve, scales: DiagramScales, places: Places, stretch: Places) -> _Given:
    """The points that the plans give, marked in the three diagrams; positions are numbered by the divisions."""
    numbers, times = [list(places).index(place) for place in stretch], curve.time[stretch]
    middles = (times[1:] + times[:-1]) / 2

    def marked(quantity: str, names: Sequence[str], times: Reals, values: Reals) -> list[Mark]:
        spots = zip(names, scales.x(times), scales.y(quantity, values), strict=True)
        with board.on(panel=PANELS[quantity]):
            return [board.given(x=float(x), y=float(y), name=name) for name, x, y in spots]

    s, v, a = curve.letters.values()
    return _Given(
        numbers,
        bool(np.ptp(np.diff(times)) <= ROUNDING * (curve.time[-1] - curve.time[0])),
        marked("s", _numbered(s, numbers), times, curve.s[stretch]),
        marked("v", [f"{v}_{numbers[0]}"], times[:1], curve.v[stretch[:1]])[0],
        marked("a", _strips(a, numbers), middles, curve.at("a", middles)),
    )


def _found(board: Board, given: _Given, rates: _Rates) -> dict[Found, list[Ray[Mark]]]:
    """The rates by chords and by tangents, and the integrals, in the order in which they are drawn."""
    figure = {**_by_chords(board, given, rates), **(_by_tangents(board, given, rates) if given.even else {}),
              **_integrated(board, given, rates)}
    return {found: rays for found, rays in figure.items() if rays}


def _by_chords(board: Board, given: _Given, rates: _Rates) -> dict[Found, list[Ray[Mark]]]:
    """The velocity in the middle of the strips, and from its chords the acceleration at the divisions between."""
    numbers, points, (_, v, a) = given.numbers, given.points, rates.letters
    velocities = by_chords(board, points, rates.v, _strips(v, numbers))
    middles = [ray.ordinate for ray in velocities]
    if rates.closed:
        first, last = feet(board, (points[0], points[-1]), rates.v)
        middles = around(board, middles, (first, last), shared=0)
    inner = numbers if rates.closed else numbers[1:-1]
    return {Found("v", CHORDS): velocities, Found("a", CHORDS): by_chords(board, middles, rates.a, _numbered(a, inner))}


def _by_tangents(board: Board, given: _Given, rates: _Rates) -> dict[Found, list[Ray[Mark]]]:
    """The velocity at the divisions, and from its tangents the acceleration there."""
    closed, (_, v, a) = rates.closed, rates.letters
    at = given.numbers if closed else given.numbers[1:-1]
    velocities = by_tangents(board, _periodic(board, given.points, closed), rates.v, _numbered(v, at))
    tops = _periodic(board, [ray.ordinate for ray in velocities], closed)
    accelerations = by_tangents(board, tops, rates.a, _numbered(a, at if closed else at[1:-1]))
    return {Found("v", TANGENTS): velocities, Found("a", TANGENTS): accelerations}


def _integrated(board: Board, given: _Given, rates: _Rates) -> dict[Found, list[Ray[Mark]]]:
    """The velocity from the plans' acceleration in the middle of the strips, and the displacement from that."""
    points, ends, (s, v, _) = given.points, given.numbers[1:], rates.letters
    velocities = integrate(board, given.middles, given.start, points, rates.a, _numbered(v, ends))
    means = [board.midpoint(ray.start, ray.end, why="the mean ordinate of the strip") for ray in velocities]
    displacements = integrate(board, means, points[0], points, rates.v, _numbered(s, ends))
    return {Found("v", INTEGRATED): velocities, Found("s", INTEGRATED): displacements}


def _periodic(board: Board, points: list[Mark], closed: bool) -> list[Mark]:
    """The points, with one more at either end where they close a period."""
    return around(board, points, (points[0], points[-1]), shared=1) if closed else points


def _strips(letter: str, numbers: Sequence[int]) -> list[str]:
    """Names for what stands in the middle of strips: v_3_4 between the divisions 3 and 4."""
    return [f"{letter}_{j}_{k}" for j, k in pairwise(numbers)]


def _numbered(letter: str, numbers: Sequence[int]) -> list[str]:
    return [f"{letter}_{k}" for k in numbers]
