"""The true motion of a machine: its speed over the travel and over time, under its loads, from rest or at any speed.

What is constructed in many poses, the reduced inertia and the moments, is taken as polynomials between the breaks of
the loads; on them the energy is integrated, E = E_0 + the work of all loads, omega^2 = 2E/I_r, and the time is the
integral of 1/omega. Where the energy is used up the machine stops: beyond that travel nothing is known.

On one stretch energy and time are polynomials that satisfy the energy equation dE/dphi = M(phi, omega) at the nodes of
Gauss: a collocation of as many nodes is a Runge-Kutta method of twice that order, which no steep characteristic of a
motor makes unstable. Where a machine is at rest omega grows with the root of the travel, so that 1/omega has no bound:
there the travel goes with the square of s, and all is smooth in s. A machine that comes to rest passes such a stretch
backwards.

Sources: Ozols 1974, 13-4 and 13-5, (13.16), (13.20), (13.33), (13.34); 15-1 (means of the speed).
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import NamedTuple, Protocol

import numpy as np
from numpy.polynomial.legendre import legval

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals, bisect, distinct_values
from graphplan.machines.motion.driven import DrivenMachine
from graphplan.machines.tolerances import (
    ENERGY_TOL,
    MIN_STRETCH,
    MOMENT_TOL,
    RATE_STEP,
    SERIES_TOL,
    STOP_TOL,
    TRAVEL_TOL,
)

# ---- one stretch ----------------------------------------------------------------------------------------------------


NODES = 16
MAX_NEWTON_ROUNDS = 30  # of Newton's method: it takes three to six
TAIL_TERMS = 3  # terms at the end of a series that tell how far it is from settled


class MovingMachine(Protocol):
    """What moves: its inertia over the travel, and at travels its moments as a function of the rates there."""

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
        """Where in the series these travels are, from -1 to 1."""
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
    from numpy.polynomial.legendre import leggauss, legint, legvander

    nodes, weights = leggauss(NODES)
    series = weights[:, None] * legvander(nodes, NODES - 1) * (np.arange(NODES) + 0.5)
    terms = legint(series, lbnd=-1, axis=1) / 2
    return _Rule((nodes + 1) / 2, series, terms, legvander(nodes, NODES) @ terms.T)


# ---- the whole motion -----------------------------------------------------------------------------------------------


STRETCH_SAMPLES = 24  # places in a stretch between which a sign is seen to change


class MotionState(NamedTuple):
    """How the machine moves at travels: arrays of shape (n,), nan where it does not get."""

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

    @cached_property
    def sample_travels(self) -> Reals:
        """Travels that show the motion: the ends of all stretches, and places between."""
        ends = [*self._starts, self.last_travel]
        samples = [np.linspace(a, b, STRETCH_SAMPLES, endpoint=False) for a, b in pairwise(ends)]
        return np.concatenate([*samples, [self.last_travel]])

    @cached_property
    def extremes(self) -> tuple[Place, Place]:
        """The least and the largest speed: at an end, where a load jumps, or where nothing accelerates."""
        places = distinct_values([*self.sample_travels, *self.roots(lambda x: self.state_at(x).acceleration)])
        state = self.state_at(places)
        least, most = int(np.argmin(state.omega)), int(np.argmax(state.omega))
        return (Place(*(float(values[least]) for values in (places, state.omega, state.time))),
                Place(*(float(one[most]) for one in (places, state.omega, state.time))))

    def roots(self, function: Callable[[Reals], Reals]) -> Reals:
        """The travels at which a function of the travel changes its sign."""
        signs = np.sign(function(self.sample_travels))
        changed = np.flatnonzero(signs[:-1] * signs[1:] < 0)
        low, high = bisect(lambda travel: np.sign(function(travel)) == signs[changed], self.sample_travels[changed],
                           self.sample_travels[changed + 1])
        return np.sort(np.concatenate([(low + high) / 2, self.sample_travels[signs == 0]]))

    @cached_property
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
                      "a travel within (--travel)")


def require_start(machine: DrivenMachine, start: float) -> None:
    """Refuse to start where nothing drives the machine from rest."""
    at, still = np.array([start]), np.zeros(1)
    moment, size = float(machine.moment(at, still)[0]), float(abs(machine.reduced[2].terms[..., 0]).max())
    if not moment > MOMENT_TOL * max(size, abs(machine.closing)):
        why = "holds it" if moment < 0 else "is nothing"
        raise Refused("the motion", f"it does not start: the reduced moment at rest, {moment:.6g}, {why}",
                      "a speed at the beginning (--speed), or loads that drive it there")


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
