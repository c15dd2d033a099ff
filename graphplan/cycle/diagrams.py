"""Kinematic diagrams: what is given, what graphical differentiation and integration find from it, and how that errs.

Its three diagrams share an abscissa; their scales are round values, which imply the distances of the poles.

The displacement diagram is differentiated twice, by chords and by tangents; the plans' acceleration is integrated
twice. All coordinates are mm of paper, in each diagram from its own origin; abscissas are common to the three.

A diagram is drawn over the axis of time, the diagram of its rate under it over the same abscissas. A ray from the
rate's pole, HO left of the origin, is parallel to a chord of the upper diagram; it cuts off HO times the chord's slope
on the axis of ordinates. Read from the chord to the ordinate this differentiates, from the ordinate to the chord it
integrates, so both give rays of one kind, and with mu the units for one mm: mu_v = mu_s/(mu_t HO).

Sources: Jaanimets 1966, 10-13 (chords, ordinates to the middle of the strip, and back by integration); Ozols 1974,
fig. 15-3 and 20-2 (integration), and (5.33) of 5-6 (tangents: his text of the drawing is lost, so it is reconstructed
from the formula, the tangent being drawn parallel to the chord over the two neighbouring strips).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Generic, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from graphplan.cycle.tolerances import ORDINATE_TOL, RATE_TOL, TIME_TOL
from graphplan.errors import Refused
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, Mark, Panel, Program, evaluate
from graphplan.sheet.diagrams import AxisScale
from graphplan.sheet.layout.scales import round_up

Reals = npt.NDArray[np.float64]
Places = npt.NDArray[np.int_]
QUANTITIES = ("s", "v", "a")


@dataclass(frozen=True, eq=False)
class KinematicCurve:
    """One quantity s with its rates v and a, at n positions of the drive; nan where a position cannot be drawn.

    `travel` is the drive's, in radians or in the lengths that `travel_unit` names; `time` grows. `closed` says that the
    last position is the first one again, a period later. `unit` is that of s: a length, or rad for a link's angle,
    which must then be unwrapped.
    """

    name: str
    unit: str
    travel: Reals
    time: Reals
    s: Reals
    v: Reals
    a: Reals
    closed: bool = False
    travel_unit: str = "rad"

    def __post_init__(self) -> None:
        shapes = {np.shape(array) for array in (self.travel, self.time, self.s, self.v, self.a)}
        if len(shapes) > 1 or len(next(iter(shapes))) != 1:
            raise Refused(self._label, f"its arrays have the shapes {sorted(shapes)}", "give five of one shape (n,)")
        if len(self.time) < 3 or not (np.diff(self.time) > 0).all():
            raise Refused(self._label, "its times do not increase from position to position", "give three or more")
        if not self.is_known.any():
            raise Refused(self._label, "no position of the range can be drawn", "choose another range")

    @property
    def _label(self) -> str:
        return f"diagram of {self.name}"

    @property
    def is_known(self) -> npt.NDArray[np.bool_]:
        """Whether position, velocity and acceleration are all known, at each place."""
        return np.isfinite(self.s) & np.isfinite(self.v) & np.isfinite(self.a)

    @property
    def letters(self) -> dict[str, str]:
        """Letters of s, v and a: psi, omega and alpha if the quantity is an angle."""
        angle = self.unit == "rad"
        return dict(zip(QUANTITIES, ("psi", "omega", "alpha") if angle else QUANTITIES, strict=True))

    @property
    def units(self) -> dict[str, str]:
        """The units of s, v and a."""
        return dict(zip(QUANTITIES, (self.unit, f"{self.unit}/s", f"{self.unit}/s²"), strict=True))

    def values(self, quantity: str) -> Reals:
        """The values of s, v or a; nan where any of them is unknown."""
        array: Reals = {"s": self.s, "v": self.v, "a": self.a}[quantity]
        return np.where(self.is_known, array, np.nan)

    def stretches(self, places: Places) -> list[Places]:
        """The places in stretches of two or more between which no position is unknown: a gap is never bridged."""
        gaps, is_known = np.cumsum(~self.is_known), self.is_known
        known_places = places[is_known[places]]
        stretches = np.split(known_places, np.flatnonzero(np.diff(gaps[known_places])) + 1)
        return [stretch for stretch in stretches if len(stretch) > 1]

    def values_at(self, quantity: str, times: Reals) -> Reals:
        """The values of s, v or a at other times: the cubic through the four positions about each; nan in gaps.

        It errs by the fourth order of the positions' distance, where the graphical methods err by the second.
        """
        values = np.full(np.shape(times), np.nan)
        slack = TIME_TOL * (self.time[-1] - self.time[0])
        for stretch in self.stretches(np.arange(len(self.time))):
            t, y = self.time[stretch], self.values(quantity)[stretch]
            inside = (times >= t[0] - slack) & (times <= t[-1] + slack)
            values[inside] = _interpolate_cubic(t, y, times[inside])
        return values


def curve_over_travel(name: str, unit: str, travel: Reals, rate: float, s: Reals, v: Reals, a: Reals, *,
                      period: float | None = None, travel_unit: str = "rad") -> KinematicCurve:
    """The curve of positions that a drive passes at a constant rate.

    `travel` counts in the sense in which the drive moves; positions that run back are taken in reverse. Where `period`
    is given it closes: the first position, so much travel later, is added at the end. Angles need not be unwrapped.
    """
    arrays = [np.asarray(array, dtype=float) for array in (travel, s, v, a)]
    if arrays[0][0] > arrays[0][-1]:
        arrays = [array[::-1] for array in arrays]
    if period is not None:
        arrays = [np.append(array, array[0] + over) for array, over in zip(arrays, (period, 0, 0, 0), strict=True)]
    travel, s, v, a = arrays
    time = (travel - travel[0]) / abs(rate)
    return KinematicCurve(name, unit, travel, time, _unwrap(s) if unit == "rad" else s, v, a, period is not None,
                          travel_unit)


def _unwrap(angles: Reals) -> Reals:
    """Angles without jumps of a whole turn, also from one side of a gap to the other."""
    finite, unwrapped = np.isfinite(angles), angles.copy()
    unwrapped[finite] = np.unwrap(angles[finite])
    return unwrapped


def _interpolate_cubic(t: Reals, y: Reals, times: Reals) -> Reals:
    """Lagrange's interpolation through the four samples about each time, or through all where there are fewer."""
    count = min(4, len(t))
    first = np.clip(np.searchsorted(t, times, side="right") - 2, 0, len(t) - count)
    nodes = [(t[first + k], y[first + k]) for k in range(count)]
    total = np.zeros(len(times))
    for k, (node, value) in enumerate(nodes):
        other_nodes = [other_node for i, (other_node, _) in enumerate(nodes) if i != k]
        total += value * np.prod([(times - other_node) / (node - other_node) for other_node in other_nodes], axis=0)
    return total


AXIS_LENGTH_MM, ORDINATE_HEIGHT_MM = 150.0, 60.0  # the room for the axis of time, and for ordinates
MIN_POLE_MM, MAX_POLE_MM = 5.0, 40.0  # a pole nearer than this, in mm, tells no slopes apart; a farther one has no room


class DiagramScales(NamedTuple):
    """The scales of time, in s, and of s, v and a, and the distances of the poles of v and a in mm."""

    time: AxisScale
    ordinates: dict[str, AxisScale]
    poles: dict[str, Fraction]


def diagram_scales(curve: KinematicCurve, places: Places) -> DiagramScales:
    """The largest round scales for which each diagram has room, the ordinates of s counted from the first position.

    The ordinates at `places` decide. A rate may grow beyond all bounds between them, where the reach ends, or even at
    them: the pole is then as near as it may be, and the largest ordinates are off the paper.
    """
    datum = float(curve.s[curve.is_known][0])
    mu_t = round_scale(float(curve.time[-1] - curve.time[0]) / AXIS_LENGTH_MM)
    spans = ordinate_spans(curve, places[curve.is_known[places]])
    mu, poles = {"s": round_scale(spans["s"] / ORDINATE_HEIGHT_MM)}, dict[str, Fraction]()
    for quantity, rate in pairwise(QUANTITIES):
        slope = mu[quantity] / mu_t
        least = min(max(spans[rate] / ORDINATE_HEIGHT_MM, float(slope) / MAX_POLE_MM), float(slope) / MIN_POLE_MM)
        mu[rate] = _rate_scale(least, slope)
        poles[rate] = slope / mu[rate]
    ordinates = {quantity: AxisScale(float(unit), datum if quantity == "s" else 0.0) for quantity, unit in mu.items()}
    return DiagramScales(AxisScale(float(mu_t), float(curve.time[0])), ordinates, poles)


def ordinate_spans(curve: KinematicCurve, places: Places) -> dict[str, float]:
    """Range of the ordinates of s, v and a, with zero included for the rates; 0 for a rate that is rounding alone, and
    for all if no place is known."""
    if not len(places):
        return dict.fromkeys(QUANTITIES, 0.0)
    period, spans = float(curve.time[-1] - curve.time[0]), {"s": float(np.ptp(curve.s[places]))}
    magnitude = float(np.abs(curve.s[places]).max())
    for rate in QUANTITIES[1:]:
        values = curve.values(rate)[places]
        span = float(max(values.max(), 0) - min(values.min(), 0))
        spans[rate] = span if span * period > RATE_TOL * magnitude else 0.0
        magnitude = max(span, magnitude / period)
    return spans


def _rate_scale(least: float, slope: Fraction) -> Fraction:
    """The first of three round scales whose pole stands on a half of a millimetre, else the first."""
    candidates = [round_scale(least)]
    while len(candidates) < 3:
        candidates.append(round_scale(float(candidates[-1]) * 1.01))
    return next((mu for mu in candidates if (2 * slope / mu).denominator == 1), candidates[0])


def round_scale(least: float) -> Fraction:
    """The smallest round scale that is not below `least`."""
    return round_up(least)


PANELS = {quantity: Panel(f"{quantity} diagram") for quantity in QUANTITIES}
CHORDS, TANGENTS, INTEGRATED = "by chords", "by tangents", "integrated"

T = TypeVar("T")
Spot = tuple[float, float]


class Ray(NamedTuple, Generic[T]):
    """One ray from the pole: the ends of the chord parallel to it, its cut on the axis, and the ordinate there."""

    start: T
    end: T
    cut: T
    ordinate: T


@dataclass(frozen=True)
class Axes:
    """The axes of one rate's diagram and its pole."""

    origin: Mark
    abscissas: Mark
    ordinates: Mark
    pole: Mark


def axes(board: Board, panel: Panel, letter: str, distance: Fraction) -> Axes:
    """The axes of the diagram of `letter`, its pole at the given distance left of the origin."""
    with board.on(panel=panel):
        O = board.begin(plan=panel, name=f"O_{letter}")
    t = board.guide(O, dx=1, dy=0, why="the axis of time")
    y = board.perpendicular(t, O, why=f"the axis of {letter}")
    H = board.lay_off(O, dx=-distance, dy=0, name=f"H_{letter}", why="the pole: its distance sets the scale")
    return Axes(O, t, y, H)


def by_chords(board: Board, points: Sequence[Mark], rate: Axes, names: Sequence[str]) -> list[Ray[Mark]]:
    """The rate in the middle of each strip, from the strip's chord.

    Reads the n points of a diagram, the rate's axes and n - 1 names. The chord's slope is the mean rate of the strip,
    which differs from the rate at its middle by the second order of its width.
    """
    return [_draw_rate(board, P, Q, board.midpoint(P, Q), rate, name)
            for (P, Q), name in zip(pairwise(points), names, strict=True)]


def by_tangents(board: Board, points: Sequence[Mark], rate: Axes, names: Sequence[str]) -> list[Ray[Mark]]:
    """The rate at each inner point, the tangent there drawn parallel to the chord of its two neighbours.

    Reads the n points of a diagram, evenly divided, the rate's axes and n - 2 names.
    """
    return [_draw_rate(board, P, Q, at, rate, name)
            for P, at, Q, name in zip(points, points[1:], points[2:], names, strict=False)]


def _draw_rate(board: Board, P: Mark, Q: Mark, at: Mark, rate: Axes, name: str) -> Ray[Mark]:
    chord = board.line(P, Q, why="its slope is the mean rate")
    ray = board.parallel(chord, rate.pole, why="the ray of this slope")
    cut = board.meet(ray, rate.ordinates, why="HO times the slope")
    level = board.parallel(rate.abscissas, cut, why="carry the ordinate across")
    upright = board.parallel(rate.ordinates, at, why="to the abscissa where the rate is such")
    return Ray(P, Q, cut, board.meet(upright, level, name=name))


def integrate(board: Board, ordinates: Sequence[Mark], start: Mark, divisions: Sequence[Mark], rate: Axes,
              names: Sequence[str]) -> list[Ray[Mark]]:
    """The diagram of which the rate is known: a string of chords from `start`, each parallel to its strip's ray.

    Reads the rate's ordinates at the middle of n strips, the first point, marks at the n + 1 abscissas that bound the
    strips, the rate's axes and n names.
    """
    rays, P = list[Ray[Mark]](), start
    for V, division, name in zip(ordinates, divisions[1:], names, strict=True):
        level = board.parallel(rate.abscissas, V, why="carry the mean ordinate of the strip to the axis")
        cut = board.meet(level, rate.ordinates)
        ray = board.line(rate.pole, cut, why="its slope is the ordinate by HO")
        chord = board.parallel(ray, P, why="on from the end of the chord before")
        upright = board.parallel(rate.ordinates, division, why="to the end of the strip")
        Q = board.meet(upright, chord, name=name)
        rays.append(Ray(P, Q, cut, V))
        P = Q
    return rays


def extend_periodically(board: Board, points: Sequence[Mark], period: tuple[Mark, Mark], shared: int) -> list[Mark]:
    """The points of a periodic diagram with one more at either end, carried over by the vector of the period.

    `period` are the first and last point of one period; `shared` is 1 where they are points of the diagram, else 0.
    """
    first, last = period
    before = board.transfer(last, first, points[-1 - shared], why="the motion is periodic")
    after = board.transfer(first, last, points[shared], why="the motion is periodic")
    return [before, *points, after]


def feet(board: Board, points: Sequence[Mark], rate: Axes) -> list[Mark]:
    """The abscissas of the points, marked on the rate's axis of time."""
    uprights = [board.parallel(rate.ordinates, P, why="down to the axis of time") for P in points]
    return [board.meet(upright, rate.abscissas) for upright in uprights]


class FoundCurve(NamedTuple):
    """A constructed curve: its quantity (s, v or a) and its method (by chords, by tangents or integrated)."""

    quantity: str
    method: str


Traces = dict[FoundCurve, list[list[Ray[Spot]]]]


class _Stretch:
    """A stretch of positions on the board, what the plans give being marked in the three diagrams.

    That are the points of the displacement diagram, the first point of the velocity diagram, and the ordinates of the
    acceleration diagram at the middle of the strips. Positions are numbered by the divisions. Only where the strips are
    `even` is a chord over two of them parallel to the tangent between; `closed` where they close a period.
    """

    def __init__(self, board: Board, curve: KinematicCurve, scales: DiagramScales, places: Places, stretch: Places):
        self.board, self.curve, self.scales = board, curve, scales
        self.numbers, times = [list(places).index(place) for place in stretch], curve.time[stretch]
        self.even = bool(np.ptp(np.diff(times)) <= TIME_TOL * (curve.time[-1] - curve.time[0]))
        self.closed = curve.closed and bool(curve.is_known.all())
        middles = (times[1:] + times[:-1]) / 2
        self.points = self._mark_points("s", self._division_names("s", self.numbers), times, curve.s[stretch])
        (self.start,) = self._mark_points("v", self._division_names("v", self.numbers[:1]), times[:1],
                                          curve.v[stretch[:1]])
        self.middles = self._mark_points("a", self._strip_names("a"), middles, curve.values_at("a", middles))

    def _mark_points(self, quantity: str, names: Sequence[str], times: Reals, values: Reals) -> list[Mark]:
        spots = zip(names, self.scales.time.mm(times), self.scales.ordinates[quantity].mm(values), strict=True)
        with self.board.on(panel=PANELS[quantity]):
            return [self.board.given(x=float(x), y=float(y), name=name) for name, x, y in spots]

    def _division_names(self, quantity: str, numbers: Sequence[int]) -> list[str]:
        """Names for what stands at divisions."""
        return [f"{self.curve.letters[quantity]}_{k}" for k in numbers]

    def _strip_names(self, quantity: str) -> list[str]:
        """Names for what stands in the middle of strips: v_3_4 between the divisions 3 and 4."""
        return [f"{self.curve.letters[quantity]}_{j}_{k}" for j, k in pairwise(self.numbers)]

    def draw_curves(self, v: Axes, a: Axes) -> dict[FoundCurve, list[Ray[Mark]]]:
        """The rates by chords and by tangents, and the integrals, in the order in which they are drawn."""
        figure = self._draw_by_chords(v, a)
        figure |= self._draw_by_tangents(v, a) if self.even else {}
        figure |= self._draw_integrals(v, a)
        return {curve: rays for curve, rays in figure.items() if rays}

    def _draw_by_chords(self, v: Axes, a: Axes) -> dict[FoundCurve, list[Ray[Mark]]]:
        """The velocity in the middle of the strips, and from its chords the acceleration at the divisions between."""
        velocities = by_chords(self.board, self.points, v, self._strip_names("v"))
        middles, inner = [ray.ordinate for ray in velocities], self.numbers[1:-1]
        if self.closed:
            first, last = feet(self.board, (self.points[0], self.points[-1]), v)
            middles, inner = extend_periodically(self.board, middles, (first, last), shared=0), self.numbers
        return {FoundCurve("v", CHORDS): velocities,
                FoundCurve("a", CHORDS): by_chords(self.board, middles, a, self._division_names("a", inner))}

    def _draw_by_tangents(self, v: Axes, a: Axes) -> dict[FoundCurve, list[Ray[Mark]]]:
        """The velocity at the divisions, and from its tangents the acceleration there."""
        at = self.numbers if self.closed else self.numbers[1:-1]
        velocities = by_tangents(self.board, self._periodic(self.points), v, self._division_names("v", at))
        tops = self._periodic([ray.ordinate for ray in velocities])
        accelerations = by_tangents(self.board, tops, a, self._division_names("a", at if self.closed else at[1:-1]))
        return {FoundCurve("v", TANGENTS): velocities, FoundCurve("a", TANGENTS): accelerations}

    def _draw_integrals(self, v: Axes, a: Axes) -> dict[FoundCurve, list[Ray[Mark]]]:
        """The velocity from the plans' acceleration in the middle of the strips, and the displacement from that."""
        points, ends = self.points, self.numbers[1:]
        velocities = integrate(self.board, self.middles, self.start, points, a, self._division_names("v", ends))
        means = [self.board.midpoint(ray.start, ray.end, why="the mean ordinate of the strip") for ray in velocities]
        displacements = integrate(self.board, means, points[0], points, v, self._division_names("s", ends))
        return {FoundCurve("v", INTEGRATED): velocities, FoundCurve("s", INTEGRATED): displacements}

    def _periodic(self, points: list[Mark]) -> list[Mark]:
        """The points, with one more at either end where they close a period."""
        return extend_periodically(self.board, points, (points[0], points[-1]), shared=1) if self.closed else points


def construct_diagram(curve: KinematicCurve, scales: DiagramScales, places: Places) -> tuple[Program, Traces]:
    """The program that finds the rates and integrals of a curve, and the rays that it draws, stretch by stretch.

    Reads the positions, by place, at which the abscissa is divided.
    """
    board = Board(coplanar=True)  # one under the other over the same abscissas: an upright passes through all diagrams
    stretches = [_Stretch(board, curve, scales, places, stretch) for stretch in curve.stretches(places)]
    v, a = (axes(board, PANELS[rate], curve.letters[rate], scales.poles[rate]) for rate in QUANTITIES[1:])
    figures = [stretch.draw_curves(v, a) for stretch in stretches]
    program = freeze(board, [mark for figure in figures for rays in figure.values() for ray in rays for mark in ray])
    values = evaluate(program, Floats())
    spots = iter([values[index] for index in program.wanted])
    traces: Traces = {}
    for figure in figures:
        for curve_drawn, rays in figure.items():
            traces.setdefault(curve_drawn, []).append([Ray(*(next(spots) for _ in ray)) for ray in rays])
    return program, traces


STRIP_LIMIT = 300  # strips of half a millimetre: no ray can be drawn in a narrower one
MAX_STRIPS, MIN_STRIPS = 24, 8  # strips of a division: more rays cannot be told apart, fewer show no curve


@dataclass(frozen=True)
class Error:
    """Error of a graphical curve against the plans: its largest and root mean square error, as parts of the largest
    ordinate of the plans at the same abscissas, and its order in the width of the strips; None if rounding prevails or
    strips cannot be halved."""

    curve: FoundCurve
    largest: float
    rms: float
    order: float | None


@dataclass(frozen=True, eq=False)
class KinematicDiagram:
    """The diagrams of a curve as they are constructed.

    `places` are the positions that divide the abscissa; `traces` are the rays of each curve found, stretch by stretch,
    in mm from the origin of the diagram that a spot stands in; `program` draws them.
    """

    curve: KinematicCurve
    scales: DiagramScales
    places: Places
    program: Program
    traces: Mapping[FoundCurve, list[list[Ray[Spot]]]]
    errors: tuple[Error, ...]

    def points(self, curve_drawn: FoundCurve) -> list[list[Spot]]:
        """The points of a curve that was found, stretch by stretch, in mm; an integral's begins with its given one."""
        starts = [[rays[0].start] if curve_drawn.method == INTEGRATED else [] for rays in self.traces[curve_drawn]]
        return [start + part for start, part in zip(starts, _spots(curve_drawn, self.traces[curve_drawn]), strict=True)]


def diagram(curve: KinematicCurve, strips: int | None = None) -> KinematicDiagram:
    """The diagrams of a curve, its abscissa divided in so many strips; without it in 24, 12, or as positions allow."""
    places = _dividing_places(curve, strips)
    scales = diagram_scales(curve, places)
    program, traces = construct_diagram(curve, scales, places)
    misses, halved = _misses(curve, scales, traces), _misses_at_other_width(curve, scales, places)
    errors = tuple(_error(curve_drawn, miss, halved) for curve_drawn, miss in misses.items())
    return KinematicDiagram(curve, scales, places, program, traces, errors)


def _dividing_places(curve: KinematicCurve, strips: int | None) -> Places:
    """The places that divide the abscissa: evenly if some whole number of strips does, else as nearly as can be."""
    positions = len(curve.time) - 1
    if strips is not None and not 2 <= strips <= min(positions, STRIP_LIMIT):
        raise Refused(f"{strips} strips", f"{curve.name} is known at {positions + 1} positions",
                      f"from 2 to {min(positions, STRIP_LIMIT)} strips")
    even = (count for count in (MAX_STRIPS, MAX_STRIPS // 2, *range(MAX_STRIPS - 1, MIN_STRIPS - 1, -1))
            if positions % count == 0)
    count = strips or (positions if positions <= MAX_STRIPS else next(even, MAX_STRIPS))
    return _even_places(positions, count)


def _even_places(positions: int, count: int) -> Places:
    places: Places = np.rint(np.arange(count + 1) * (positions / count)).astype(int)
    return places


def _spots(curve_drawn: FoundCurve, stretches: list[list[Ray[Spot]]]) -> list[list[Spot]]:
    """The result of each ray: the ordinate, or the end of the chord."""
    return [[ray.end if curve_drawn.method == INTEGRATED else ray.ordinate for ray in rays] for rays in stretches]


class _Misses(NamedTuple):
    """Distances of points from the plans, and the largest of the plans' ordinates there, in mm."""

    by: Reals
    largest: float

    @property
    def rms(self) -> float:
        return float(np.sqrt(np.mean(self.by**2)))


def _misses(curve: KinematicCurve, scales: DiagramScales,
            traces: Mapping[FoundCurve, list[list[Ray[Spot]]]]) -> dict[FoundCurve, _Misses]:
    """Errors of each constructed curve against the plans; a constant quantity is left out."""
    misses, spans = dict[FoundCurve, _Misses](), ordinate_spans(curve, np.flatnonzero(curve.is_known))
    for curve_drawn, stretches in traces.items():
        if spans[curve_drawn.quantity]:
            x, y = np.array([spot for spots in _spots(curve_drawn, stretches) for spot in spots]).T
            values = curve.values_at(curve_drawn.quantity, scales.time.value(x))
            plans = scales.ordinates[curve_drawn.quantity].mm(values)
            misses[curve_drawn] = _Misses(y - plans, float(np.abs(plans).max()))
    return misses


def _misses_at_other_width(curve: KinematicCurve, scales: DiagramScales,
                           places: Places) -> tuple[dict[FoundCurve, _Misses], float]:
    """Errors with strips half as wide if the positions allow, else twice as wide, and the ratio of the widths; empty if
    neither divides evenly."""
    positions, count = len(curve.time) - 1, len(places) - 1
    if positions % (2 * count) == 0:
        strips, ratio = 2 * count, 0.5
    elif positions % count == 0 and count % 2 == 0 and count >= MIN_STRIPS:
        strips, ratio = count // 2, 2.0
    else:
        return {}, 1.0
    return _misses(curve, scales, construct_diagram(curve, scales, _even_places(positions, strips))[1]), ratio


def _error(curve_drawn: FoundCurve, miss: _Misses, halved: tuple[dict[FoundCurve, _Misses], float]) -> Error:
    """The error of one curve found; its order is the power of the strips' width with which it goes."""
    (other_misses, ratio), order = halved, None
    if curve_drawn in other_misses and min(miss.rms, other_misses[curve_drawn].rms) > ORDINATE_TOL * miss.largest:
        order = math.log(other_misses[curve_drawn].rms / miss.rms, ratio)
    return Error(curve_drawn, float(np.abs(miss.by).max()) / miss.largest, miss.rms / miss.largest, order)
