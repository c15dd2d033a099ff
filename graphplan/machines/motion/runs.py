"""The true motion of a machine: its runs by speed and travel, steady cycles, and what drives it.

What is constructed in many poses is taken as polynomials between the breaks of the loads: from then on nothing is
constructed any more. A load over a speed keeps apart what hangs on the travel, its arm and the speed that it measures,
and its law.

What is constructed in many poses, the reduced inertia and the moments, is taken as polynomials between the breaks of
the loads; on them the energy is integrated, E = E_0 + the work of all loads, omega^2 = 2E/I_r, and the time is the
integral of 1/omega. Where the energy is used up the machine stops: beyond that travel nothing is known.

On one stretch energy and time are polynomials that satisfy the energy equation dE/dphi = M(phi, omega) at the nodes of
Gauss: a collocation of as many nodes is a Runge-Kutta method of twice that order, which no steep characteristic of a
motor makes unstable. Where a machine is at rest omega grows with the root of the travel, so that 1/omega has no bound:
there the travel goes with the square of s, and all is smooth in s. A machine that comes to rest passes such a stretch
backwards.

Sources: Ozols 1974, 13-4 and 13-5, (13.16), (13.20), (13.33), (13.34); 15-1 (means of the speed).

Without [flywheel] and [run] the machine starts with the speed that its first drive has, from rest where that is none,
and goes one turn under its loads alone. With [flywheel] it is the steady cycle, with the wheel and with what closes the
cycle. A run, or what is said otherwise, has the first say. The steady cycle is that which repeats itself, near the
speed on which the characteristics of driver and machine agree; the run-up to it is timed.

Sources: Ozols 1974, 13-1 and 13-7 (the nominal speed is where the characteristics intersect, of a driver's only the
part that falls faster than the machine's is stable); 15-1 (the initial speed of the steady cycle is searched for).
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from itertools import pairwise
from typing import NamedTuple, Protocol

import numpy as np
from numpy.polynomial.legendre import legint, legval, legvander

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals, bisect, distinct_values
from graphplan.machines.flywheel.steady_cycle import needed_inertia, steady_cycle, turn_with
from graphplan.machines.integrals import NODES, TAIL_TERMS, Piecewise, fit_piecewise, gauss_rule
from graphplan.machines.reduced.reduction import Reduction, reduction
from graphplan.machines.tolerances import (
    CYCLE_TOL,
    ENERGY_TOL,
    INERTIA_TOL,
    MACHINE_SHARE,
    MIN_STRETCH,
    MOMENT_TOL,
    RATE_STEP,
    SERIES_TOL,
    SIGN_TOL,
    STOP_TOL,
    TRAVEL_TOL,
)
from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import TURN, travel_text, travel_unit

SIZE_SAMPLES = 48  # places of the cycle that show how large moments and inertias are


class SpeedLaw(NamedTuple):
    """A load over a speed: its moment is arm * law(rate * omega), arm and rate changing with the travel."""

    name: str
    arm: Piecewise
    rate: Piecewise
    law: Callable[[Reals], Reals]


@dataclass(frozen=True, eq=False)
class DrivenMachine:
    """A machine of one degree of freedom as its first drive feels it, in SI units.

    `reduced` are inertia, its slope and the moment of all loads that hang on the travel alone, positive where they
    drive; a machine that is `closed` is the same a turn later. `wheel` is the inertia of a flywheel, `closing` a
    constant moment on the drive. Travel is told in a `measure`, degrees or lengths of a drive that slides, of the SI
    size `degree`; `pace` is that of the unit of speeds, 1 rad/s or such a length/s.
    """

    reduced: tuple[Piecewise, Piecewise, Piecewise]
    closed: bool
    laws: tuple[SpeedLaw, ...] = ()
    wheel: float = 0.0
    closing: float = 0.0
    degree: float = math.radians(1.0)
    pace: float = 1.0
    measure: str = "degrees"

    def travel_text(self, travel: float) -> str:
        """A travel in words."""
        return f"{travel / self.degree:.6g} {self.measure}"

    @property
    def begin(self) -> float:
        return float(self.reduced[0].edges[0])

    @property
    def period(self) -> float:
        """The travel of a cycle, or of the whole span."""
        return float(np.ptp(self.reduced[0].edges))

    def inertia(self, travel: Reals) -> Reals:
        return self.wheel + self.curve(self.reduced[0], travel)

    def slope(self, travel: Reals) -> Reals:
        """The derivative of the inertia."""
        return self.curve(self.reduced[1], travel)

    def moment(self, travel: Reals, rate: Reals, side: int = 1) -> Reals:
        """The moment of all loads, at a break that from the right, or from the left with `side` -1."""
        return self.moments(travel, side)(rate)

    def moments(self, travel: Reals, side: int = 1) -> Callable[[Reals], Reals]:
        """The moment of all loads at these travels, as a function of the rates there."""
        fixed = self.closing + self.curve(self.reduced[2], travel, side)
        laws = [(law, self.curve(law.arm, travel, side), self.curve(law.rate, travel, side)) for law in self.laws]
        return lambda rate: sum((arm * law.law(speed * rate) for law, arm, speed in laws), fixed)

    def curve(self, curve: Piecewise, travel: Reals, side: int = 1) -> Reals:
        """A curve of the machine at any travels."""
        if self.closed:
            turns = np.floor if side > 0 else turns_below
            travel = travel - self.period * turns((travel - self.begin) / self.period)
        return curve.at(travel, side)

    def edges(self, start: float, end: float) -> list[float]:
        """The travels between which all is smooth, from one travel to another."""
        inner = self.reduced[0].edges
        first, last = (math.floor((x - self.begin) / self.period) if self.closed else 0 for x in (start, end))
        edges = distinct_values([inner + turn * self.period for turn in range(first, last + 1)])
        return [start, *(float(x) for x in edges if start < x < end), end]


def turns_below(turns: Reals) -> Reals:
    return np.ceil(turns) - 1


def driven_machine(reduction: Reduction, wheel: float = 0.0, closing: float = 0.0) -> DrivenMachine:
    """The machine of a reduction, with a flywheel and a moment on the drive; a sliding drive's travel in metres.

    Fails with `Refused` where a pose is not reached or has no velocities.
    """
    def rows(travel: Reals) -> Reals:
        reduced = reduction.reduce_at(travel)
        speeds = [curve for load in reduced.speed_loads for curve in (load.arm, load.rate)]
        return np.array([reduced.inertia, reduced.slope, reduced.moment, *speeds])

    unit, name = travel_unit(reduction.scene)
    first, last = reduction.ends
    sample = reduction.reduce_at(np.linspace(first, last, SIZE_SAMPLES + 2)[1:-1])
    sizes = np.zeros(3 + 2 * len(sample.speed_loads))
    sizes[1] = abs(sample.inertia).max()
    sizes[2] = max(sum(abs(moment).max() for moment in sample.by.values()),
                   MACHINE_SHARE * reduction.machine_size.moment)
    edges = [first, *(float(x) for x in reduction.breaks if first < x < last), last]
    curves = [replace(curve, edges=curve.edges * reduction.unit) for curve in fit_piecewise(rows, edges, sizes)]
    require_inertia(curves[0], reduction)
    arms = zip(sample.speed_loads, curves[3::2], curves[4::2], strict=True)
    laws = tuple(SpeedLaw(load.name, arm, rate, load.law) for load, arm, rate in arms)
    return DrivenMachine((curves[0], curves[1], curves[2]), reduction.closed, laws, wheel, closing,
                         reduction.unit * unit,
                         reduction.unit, name)


def require_inertia(inertia: Piecewise, reduction: Reduction) -> None:
    """Refuse a machine that has no inertia somewhere: its speed there would have no end."""
    low, high = inertia.edges[:-1, None], inertia.edges[1:, None]
    travel = (low + (high - low) * np.linspace(0, 1, 9)).ravel()
    values = inertia.at(travel)
    least = int(np.argmin(values))
    if not values[least] > INERTIA_TOL * values.max():
        place = travel_text(reduction.scene, float(travel[least] / reduction.unit))
        raise Refused("the machine", f"its reduced inertia is zero at {place}",
                      "[masses] with the inertia of the first drive's link")


MAX_NEWTON_ROUNDS = 30  # of Newton's method: it takes three to six


class MovingMachine(Protocol):
    """A machine: its inertia over the travel, and at travels its moments as a function of the rates there."""

    def inertia(self, travel: Reals) -> Reals: ...

    def moments(self, travel: Reals) -> Callable[[Reals], Reals]: ...


@dataclass(frozen=True, eq=False)
class MotionStretch:
    """Energy and time as Legendre series in s from 0 to 1, where the travel is `start` + `way` s^`power`."""

    start: float
    way: float
    power: int
    energy: Reals
    time: Reals

    def place(self, travel: Reals) -> Reals:
        """Arguments of the series at these travels, from -1 to 1."""
        s = np.clip((travel - self.start) / self.way, 0.0, 1.0)
        return 2 * (np.sqrt(s) if self.power == 2 else s) - 1


def move_stretch(machine: MovingMachine, start: float, way: float, energy: float, elapsed: float,
                 at_rest: bool) -> MotionStretch | None:
    """The motion from a travel on; None where no polynomial follows it to rounding, or it comes to rest.

    Reads the energy and the time elapsed at the start. With `at_rest` there is no energy, and `way` may lead back.
    """
    rule, power = _rule(), 2 if at_rest else 1
    travel, pace = start + way * rule.nodes**power, way * power * rule.nodes**(power - 1)
    inertia, moments, still = machine.inertia(travel), machine.moments(travel), np.zeros(NODES)
    energies = moments(still) * (travel - start) if at_rest else np.full(NODES, energy)
    for _ in range(MAX_NEWTON_ROUNDS):
        if not (energies > 0).all():
            return None
        rate = np.sqrt(2 * energies / inertia)
        moment = moments(rate)
        step = RATE_STEP * rate
        slope = (moments(rate + step) - moment) / step / (inertia * rate)
        miss = energies - energy - rule.integral @ (pace * moment)
        change = np.linalg.solve(np.eye(NODES) - rule.integral * (pace * slope), miss)
        if not np.isfinite(change).all():
            return None
        energies = energies - change
        if abs(change).max() <= ENERGY_TOL * energies.max():
            break
    else:
        return None
    if not (energies > 0).all():
        return None
    grown, hurried = pace * moment, pace / np.sqrt(2 * energies / inertia)
    if not (is_settled(grown, max(energies.max(), energy)) and is_settled(hurried, elapsed + abs(hurried).mean())):
        return None
    return MotionStretch(start, way, power, rule.integral_terms(grown, energy), rule.integral_terms(hurried, elapsed))


def is_settled(values: Reals, size: float) -> bool:
    """Whether the last terms of the series are rounding beside a size, or beside the values."""
    tail = abs(values @ _rule().series[:, -TAIL_TERMS:]).max()
    return bool(tail <= SERIES_TOL * max(size, abs(values).max()))


class _Rule(NamedTuple):
    """The nodes of Gauss from 0 to 1; what makes of the values there the terms of a series, those of its integral, and
    the integral at the nodes."""

    nodes: Reals
    series: Reals
    terms: Reals
    integral: Reals

    def integral_terms(self, values: Reals, first: float) -> Reals:
        """The terms of the integral, which begins at `first`."""
        terms: Reals = values @ self.terms
        terms[0] += first
        return terms


@cache
def _rule() -> _Rule:
    nodes, series = gauss_rule()
    terms = legint(series, lbnd=-1, axis=1) / 2
    return _Rule((nodes + 1) / 2, series, terms, legvander(nodes, NODES) @ terms.T)


STRETCH_SAMPLES = 24  # places in a stretch between which a sign is seen to change


class MotionState(NamedTuple):
    """State of the machine at travels: arrays of shape (n,), nan beyond its stop."""

    energy: Reals
    omega: Reals
    time: Reals
    acceleration: Reals


class Place(NamedTuple):
    """A travel, the speed there and the time until then."""

    travel: float
    omega: float
    time: float


class Means(NamedTuple):
    """Means of the speed: (max + min)/2, over the travel, over the time; and (max - min) over the first of them."""

    arithmetic: float
    planimetric: float
    true: float
    unevenness: float


@dataclass(frozen=True, eq=False)
class TrueMotion:
    """The motion of a machine from one travel to another; `stop` is where it comes to rest before, if it does."""

    machine: DrivenMachine
    start: float
    end: float
    stretches: tuple[MotionStretch, ...]
    stop: Place | None

    @cached_property
    def _starts(self) -> list[float]:
        return [min(stretch.start, stretch.start + stretch.way) for stretch in self.stretches]

    @property
    def last_travel(self) -> float:
        """The last travel that is reached."""
        return self.end if self.stop is None else self.stop.travel

    def state_at(self, travel: Sequence[float] | Reals) -> MotionState:
        """Energy, speed, time and acceleration; where loads jump, the acceleration right of it."""
        x = np.asarray(travel, dtype=float)
        energy, time = np.full(x.shape, np.nan), np.full(x.shape, np.nan)
        inside = (x >= self.start) & (x <= self.last_travel)
        stretch_of = np.array([max(0, bisect_right(self._starts, value) - 1) for value in x], dtype=int)
        for k in distinct_values(stretch_of[inside]):
            is_here, stretch = inside & (stretch_of == k), self.stretches[k]
            place = stretch.place(x[is_here])
            energy[is_here] = np.where((place == -1) & (stretch.power == 2), 0.0, legval(place, stretch.energy))
            time[is_here] = legval(place, stretch.time)
        time[x == self.start] = 0.0
        energy = np.maximum(energy, 0.0)
        inertia = self.machine.inertia(x)
        omega = np.sqrt(2 * energy / inertia)
        moment = self.machine.moment(x, omega)
        return MotionState(energy, omega, time, (moment - self.machine.slope(x) * omega**2 / 2) / inertia)

    @property
    def sample_travels(self) -> Reals:
        """Travels that show the motion: the ends of all stretches, and places between."""
        ends = [*self._starts, self.last_travel]
        samples = [np.linspace(a, b, STRETCH_SAMPLES, endpoint=False) for a, b in pairwise(ends)]
        return np.concatenate([*samples, [self.last_travel]])

    @cached_property
    def extremes(self) -> tuple[Place, Place]:
        """The least and the largest speed: at an end, at a jump of a load, or at zero acceleration."""
        places = distinct_values([*self.sample_travels, *self.roots(lambda x: self.state_at(x).acceleration)])
        state = self.state_at(places)
        close = SIGN_TOL * np.max(state.omega)  # of equals the first
        least, most = (int(np.argmax(sign * state.omega >= np.max(sign * state.omega) - close)) for sign in (-1, 1))
        return (Place(*(float(values[least]) for values in (places, state.omega, state.time))),
                Place(*(float(one[most]) for one in (places, state.omega, state.time))))

    def roots(self, function: Callable[[Reals], Reals]) -> Reals:
        """The travels at which a function of the travel changes its sign."""
        signs = np.sign(function(self.sample_travels))
        changed = np.flatnonzero(signs[:-1] * signs[1:] < 0)
        low, high = bisect(lambda travel: np.sign(function(travel)) == signs[changed], self.sample_travels[changed],
                           self.sample_travels[changed + 1])
        return np.sort(np.concatenate([(low + high) / 2, self.sample_travels[signs == 0]]))

    @property
    def means(self) -> Means:
        """The means of the speed over the whole motion (Ozols (15.1), (15.2), (15.4))."""
        least, most = (place.omega for place in self.extremes)
        nodes, weights = np.polynomial.legendre.leggauss(STRETCH_SAMPLES)
        area = 0.0
        for a, b in pairwise([*self._starts, self.last_travel]):
            area += (b - a) / 2 * float(weights @ self.state_at((a + b) / 2 + (b - a) / 2 * nodes).omega)
        distance, half = self.last_travel - self.start, (least + most) / 2
        elapsed = float(self.state_at([self.last_travel]).time[0])
        return Means(half, area / distance, distance / elapsed, (most - least) / half)


def move(machine: DrivenMachine, omega: float, start: float, end: float) -> TrueMotion:
    """The motion from a travel, with a speed there (0: from rest), to another travel or until the machine stops.

    Fails with `Refused` where it cannot start, or a span that does not close is left.
    """
    require_within_span(machine, start, end)
    energy = float(machine.inertia(np.array([start]))[0]) * omega**2 / 2
    if omega == 0:
        require_start(machine, start)
    waiting, stretches = machine.edges(start, end)[::-1], list[MotionStretch]()
    position, elapsed = waiting.pop(), 0.0
    while waiting:
        distance = waiting[-1] - position
        stretch = move_stretch(machine, position, distance, energy, elapsed, at_rest=energy == 0)
        if stretch is None and (halt := stretch_to_rest(machine, position, waiting[-1], energy, elapsed)) is not None:
            return TrueMotion(machine, start, end, (*stretches, halt), Place(halt.start, 0.0, start_value(halt.time)))
        if stretch is None and distance <= MIN_STRETCH * (end - start):
            return TrueMotion(machine, start, end, tuple(stretches), Place(position, 0.0, math.inf))
        if stretch is None:
            waiting.append(position + distance / 2)
            continue
        stretches.append(stretch)
        position, energy, elapsed = waiting.pop(), float(stretch.energy.sum()), float(stretch.time.sum())
    return TrueMotion(machine, start, end, tuple(stretches), None)


def require_within_span(machine: DrivenMachine, start: float, end: float) -> None:
    """Refuse a travel that leaves the span of a machine that does not turn."""
    last = machine.begin + machine.period
    if not machine.closed and not machine.begin <= start < end <= last + TRAVEL_TOL * machine.period:
        raise Refused("the motion",
                      f"it would go from {machine.travel_text(start)} to {machine.travel_text(end)}, and is known from "
                      f"{machine.travel_text(machine.begin)} to {machine.travel_text(last)}",
                      "a shorter travel")


def require_start(machine: DrivenMachine, start: float) -> None:
    """Refuse to start if no load drives the machine from rest."""
    at, still = np.array([start]), np.zeros(1)
    moment, size = float(machine.moment(at, still)[0]), float(abs(machine.reduced[2].terms[..., 0]).max())
    if not moment > MOMENT_TOL * max(size, abs(machine.closing)):
        why = "holds it" if moment < 0 else "is nothing"
        raise Refused("the motion", f"it does not start: the reduced moment at rest, {moment:.6g}, {why}",
                      "a speed at the beginning (run.speed), or loads that drive it there")


def start_value(terms: Reals) -> float:
    """The value of a series at its beginning."""
    return float(terms @ (-1.0) ** np.arange(len(terms)))


def stretch_to_rest(machine: DrivenMachine, here: float, end: float, energy: float,
                    elapsed: float) -> MotionStretch | None:
    """The stretch on which the machine comes to rest before the end, from where it does back to here, if it does so.

    The farther it goes the more energy it has had here: the travel is found by the rule of false position.
    """
    if energy == 0:
        return None

    def stretch_from(far: float) -> MotionStretch | None:
        return move_stretch(machine, far, here - far, 0.0, 0.0, at_rest=True)

    stretch = stretch_from(end)
    if stretch is None or (over := float(stretch.energy.sum()) - energy) < 0:
        return None
    low, under, high = here, -energy, end
    for _ in range(100):
        far = (low * over - high * under) / (over - under)
        if not low < far < high or (stretch := stretch_from(far)) is None:
            break
        miss = float(stretch.energy.sum()) - energy
        if abs(miss) <= STOP_TOL * energy:
            break
        if miss > 0:
            high, over, under = far, miss, under / 2
        else:
            low, under, over = far, miss, over / 2
    if stretch is None:
        return None
    whole = float(stretch.time.sum())  # below zero: it was passed backwards
    time = stretch.time.copy()
    time[0] += elapsed - whole
    return MotionStretch(stretch.start, stretch.way, stretch.power, stretch.energy, time)


RUN_UP_SHARE = 0.01  # of the steady speed: a machine so near to it has run up
MAX_RUN_UP_TURNS = 100  # that a run-up may take
# how far from a speed the nominal one is looked for, and in how many steps each
SPEED_OCTAVES, SPEEDS_PER_OCTAVE = 12, 8
MAX_CYCLE_ROUNDS = 60  # of the search for the cycle that repeats itself: it takes three to six


@dataclass(frozen=True)
class RunUp:
    """The place where a machine from rest comes within `NEAR` of its steady speed at the same travel, and the number of
    turns."""

    place: Place
    turns: float


def work_over_cycle(machine: DrivenMachine, omega: Reals) -> tuple[Reals, Reals]:
    """The work of all loads over a cycle at constant speeds, shape (k,), and that of their sizes; the moment that
    closes the cycle counts by itself."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    edges = machine.reduced[0].edges
    low, width = edges[:-1, None], np.diff(edges)[:, None]
    travel = (low + width * (nodes + 1) / 2).ravel()
    each = (width / 2 * weights).ravel()
    moment = machine.moment(travel, omega[:, None]) + np.zeros((len(omega), 1))
    return moment @ each, (abs(moment - machine.closing) + abs(machine.closing)) @ each


def nominal_speed(machine: DrivenMachine, near: float) -> float:
    """The speed nearest to another at which the loads do no work over a cycle, and are stable; to rounding.

    Fails with `Refused` where the characteristics do not intersect so.
    """
    speeds = near * 2.0 ** (np.arange(-SPEED_OCTAVES * SPEEDS_PER_OCTAVE,
                                      SPEED_OCTAVES * SPEEDS_PER_OCTAVE + 1) / SPEEDS_PER_OCTAVE)
    works = work_over_cycle(machine, speeds)[0]
    falling = np.flatnonzero((works[:-1] > 0) & (works[1:] <= 0))
    if not len(falling):
        raise Refused("the steady motion", "the characteristics of the loads do not intersect: at no speed is their "
                      "work over a cycle zero", "a driver whose moment falls with the speed")
    k = min(falling, key=lambda k: abs(math.log(speeds[k] * speeds[k + 1] / near**2)))
    low, high = bisect(lambda omega: work_over_cycle(machine, omega)[0] > 0, speeds[k:k + 1], speeds[k + 1:k + 2])
    return float((low + high)[0] / 2)


def steady_motion(machine: DrivenMachine, speed: float) -> TrueMotion:
    """The cycle that repeats itself; of a machine whose loads know no speed the one with this mean (max + min)/2.

    Fails with `Refused` where the machine does not turn, or its cycle does not close at any speed.
    """
    if not machine.closed:
        raise Refused("the steady motion", "the mechanism does not return to its pose after a turn",
                      "a first drive that makes full turns")
    if not speed > 0:
        raise Refused("the steady motion", "the speed is missing", "run.speed, or omega of the first [[drive]]")
    if machine.laws:
        return limit_cycle(machine, nominal_speed(machine, speed))
    over, size = (float(work[0]) for work in work_over_cycle(machine, np.array([speed])))
    if abs(over) > CYCLE_TOL * 1e3 * size:
        raise Refused("the steady motion", f"the loads give {over:.6g} J over a cycle, which does not close",
                      "[flywheel], whose closing moment closes it, or a driver's characteristic over the speed")
    return cycle_with_mean(machine, speed)


def motion_over_turn(machine: DrivenMachine, energy: float) -> TrueMotion:
    """The motion over one turn from this kinetic energy, in J, at its beginning."""
    begin = machine.begin
    omega = math.sqrt(2 * energy / float(machine.inertia(np.array([begin]))[0]))
    motion = move(machine, omega, begin, begin + machine.period)
    if motion.stop is not None:
        raise Refused("the steady motion", f"the machine comes to rest at {machine.travel_text(motion.stop.travel)}",
                      "a larger speed, or a flywheel")
    return motion


def limit_cycle(machine: DrivenMachine, omega: float) -> TrueMotion:
    """The cycle at whose end the energy is that of its beginning: by secants, from the nominal speed."""
    energy = float(machine.inertia(np.array([machine.begin]))[0]) * omega**2 / 2
    before = miss = 0.0
    for round_ in range(MAX_CYCLE_ROUNDS):
        motion = motion_over_turn(machine, energy)
        last, miss = miss, float(motion.state_at([motion.end]).energy[0]) - energy
        if abs(miss) <= CYCLE_TOL * energy:
            return motion
        steeper = (miss - last) / (energy - before) if round_ else -1.0
        before, energy = energy, max(energy - miss / (steeper if steeper < 0 else -1.0), energy / 4)
    raise Refused("the steady motion", "no periodic motion was found", "a driver whose moment falls with the speed")


def cycle_with_mean(machine: DrivenMachine, speed: float) -> TrueMotion:
    """The cycle whose mean speed is this: the square of the speed at its beginning grows with that of the mean."""
    energy = float(machine.inertia(np.array([machine.begin]))[0]) * speed**2 / 2
    for _ in range(MAX_CYCLE_ROUNDS):
        motion = motion_over_turn(machine, energy)
        mean = motion.means.arithmetic
        if abs(mean - speed) <= CYCLE_TOL * speed:
            return motion
        energy *= 1 + 2 * (speed / mean - 1)
    raise Refused("the steady motion", f"no cycle has the mean speed {speed:g}", "a larger speed, or a flywheel")


def speed_gap(motion: TrueMotion, cycle: TrueMotion, travel: Reals) -> Reals:
    """Excess of the relative distance from the steady motion over `NEAR`."""
    return abs(motion.state_at(travel).omega / cycle.state_at(travel).omega - 1) - RUN_UP_SHARE


def run_up(machine: DrivenMachine, cycle: TrueMotion, omega: float = 0.0) -> RunUp:
    """Run-up of a machine to its steady cycle, from rest or from another speed.

    Fails with `Refused` where it cannot start, stops, or takes more than `TURNS` turns.
    """
    elapsed, begin, period = 0.0, machine.begin, machine.period
    for turn in range(MAX_RUN_UP_TURNS):
        motion = move(machine, omega, begin, begin + period)
        apart = partial(speed_gap, motion, cycle)
        if motion.stop is not None:
            raise Refused("the run-up", f"the machine stops again in turn {turn + 1}", "more drive, or less load")
        near = motion.sample_travels[apart(motion.sample_travels) <= 0]
        if len(near):
            limit = min(near[0], *motion.roots(apart), near[0])
            at = motion.state_at([limit])
            place = Place(limit + turn * period, float(at.omega[0]), elapsed + float(at.time[0]))
            return RunUp(place, (place.travel - begin) / period)
        last = motion.state_at([begin + period])
        omega, elapsed = float(last.omega[0]), elapsed + float(last.time[0])
    raise Refused("the run-up",
                  f"after {MAX_RUN_UP_TURNS} turns it is not within {RUN_UP_SHARE:.0%} of the steady motion",
                  "a smaller flywheel, or more drive")


TURN_DEGREES = 360.0  # degrees
MAX_TURNS = 1000  # turns that a motion is followed


@dataclass(frozen=True, eq=False)
class MachineMotion:
    """A motion of a scene's machine. `steady` is its steady cycle, if it has loads over a speed or is asked for it;
    `nominal` the speed of its characteristics, in SI, and `run_up` how the motion comes near the steady cycle.
    """

    reduction: Reduction
    machine: DrivenMachine
    motion: TrueMotion
    steady: TrueMotion | None = None
    nominal: float | None = None
    run_up: RunUp | None = None

    @property
    def scene(self) -> Scene:
        return self.reduction.scene


def motion_of_scene(scene: Scene, speed: float | None = None, travel: float | None = None,
                    in_cycle: bool = False) -> MachineMotion:
    """The motion of a scene: from a speed (rad/s or lengths/s) over a travel (degrees or lengths), or the steady cycle.

    Fails with `Refused` where the machine does not start or get so far, its cycle does not close, or it is to stop and
    does not.
    """
    run = scene.run
    speed = first_number(speed, None if run is None else run.speed)
    travel = first_number(travel, None if run is None else run.travel)
    driven_scene = reduction_of_motion(scene, travel)
    in_cycle = in_cycle or (scene.flywheel is not None and run is None and speed is None and travel is None)
    driven_scene, machine = with_flywheel(scene, driven_scene)
    own_rate = abs(float(scene.drives[0].rate))
    if in_cycle:
        mean = speed if speed is not None else own_rate if scene.flywheel is None else float(scene.flywheel.speed)
        motion = steady_motion(machine, abs(mean) * machine.pace)
        return MachineMotion(driven_scene, machine, motion, motion,
                             nominal_speed(machine, motion.means.planimetric) if machine.laws else None)
    first = own_rate if speed is None else speed
    if first < 0:
        raise Refused("run.speed", f"{first:g} is below 0", "a speed in the sense in which the drive moves, or 0")
    stops = run is not None and run.stops
    end = end_of_travel(machine, travel, stops)
    motion = move(machine, first * machine.pace, machine.begin, end)
    if stops:
        if motion.stop is None:
            raise Refused("run: stops", f"the machine still moves after {machine.travel_text(end)}",
                          "a travel, or more load")
        motion = replace(motion, end=motion.stop.travel)
    return with_steady_cycle(MachineMotion(driven_scene, machine, motion), first)


def first_number(*values: object) -> float | None:
    """The first number that is said."""
    return next((float(value) for value in values if value is not None), None)  # type: ignore[arg-type]


def reduction_of_motion(scene: Scene, travel: float | None) -> Reduction:
    """The masses and loads of the scene: over a whole cycle where there is one and the travel is a turn or more, or not
    said, or where a flywheel is asked for; else over the travel."""
    if travel is not None and travel <= 0:
        raise Refused("run.travel", f"{travel:g} is not greater than 0", "give degrees (lengths of a sliding drive)")
    if travel is not None and travel > MAX_TURNS * TURN_DEGREES and not (scene.drives and scene.drives[0].slides):
        raise Refused("run.travel", f"{travel:g} degrees are more than {MAX_TURNS} turns",
                      "a shorter travel, or --steady")
    if scene.drives and scene.drives[0].slides and travel is None:
        raise Refused("the motion", "the first drive slides, and the travel is missing", "travel in [run]")
    whole = scene.flywheel is not None or travel is None or travel >= TURN_DEGREES
    if scene.drives and not scene.drives[0].slides and whole:
        try:
            return reduction(scene)
        except Refused:
            if scene.flywheel is not None:
                raise
    return reduction(scene, (0.0, travel or TURN_DEGREES))


def end_of_travel(machine: DrivenMachine, travel: float | None, stops: bool) -> float:
    """The travel at the end, in SI."""
    if travel is not None:
        return machine.begin + travel * machine.degree
    if not machine.closed:
        return machine.begin + machine.period
    return machine.begin + (TURN * MAX_RUN_UP_TURNS if stops else TURN)


def with_flywheel(scene: Scene, found: Reduction) -> tuple[Reduction, DrivenMachine]:
    """The machine with the flywheel that is asked for, if it needs one, and what closes its cycle: a moment, or its
    loads scaled."""
    flywheel = scene.flywheel
    if flywheel is None:
        return found, driven_machine(found)
    speed = abs(float(flywheel.speed)) * found.unit
    cycle = steady_cycle(found, speed, flywheel.closes, found.changing)
    wheel = (turn_with(cycle, float(flywheel.inertia or 0)).inertia if flywheel.unevenness is None
             else needed_inertia(cycle, float(flywheel.unevenness)))
    found = found.scale_loads(cycle.factor)
    return found, driven_machine(found, wheel, cycle.closing)


def with_steady_cycle(driven: MachineMotion, speed: float) -> MachineMotion:
    """The run with the steady cycle that its machine comes to, if characteristics lead to one."""
    machine = driven.machine
    if not (machine.laws and machine.closed) or driven.motion.stop is not None:
        return driven
    try:
        omega = nominal_speed(machine, driven.motion.extremes[1].omega)
        driven = replace(driven, nominal=omega, steady=(cycle := limit_cycle(machine, omega)))
        return replace(driven, run_up=run_up(machine, cycle, speed * machine.pace))
    except Refused:
        return driven
