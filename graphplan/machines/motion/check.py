"""The independent check of a motion and of a flywheel: the equation of motion integrated over time, from the solver.

I omega' + omega^2/2 dI/dphi = M is integrated by Picard's iteration of Chebyshev series in time, with the work as a
third unknown; inertia, slope and moments are the solver's at the points of Chebyshev between the breaks. Neither the
scheme nor the variable nor the numbers are those of the motion. With a flywheel it starts at the speed at which the
cycle is said to begin: the extreme speeds have to be those asked for, and the cycle has to close.

Source of the scheme: Clenshaw and Norton 1963, The solution of nonlinear ordinary differential equations in Chebyshev
series.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial.chebyshev import chebint, chebpts1, chebval, chebvander

from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.tolerances import (
    BREAK_DISTANCE,
    INTERPOLATION_TOL,
    MIN_SPEED,
    MOTION_TOL,
    PICARD_TOL,
    SPEED_TOL,
    STRETCH_TOL,
)
from graphplan.errors import Disagreement, Refused
from graphplan.kernel.numbers.arrays import Reals, distinct_values
from graphplan.machines.flywheel.result import FlywheelResult
from graphplan.machines.motion.drawing import MotionDrawing
from graphplan.machines.motion.runs import MachineMotion
from graphplan.machines.reduced.check import ReferenceReduction, check_reduction
from graphplan.machines.reduced.reduction import Reduction
from graphplan.mechanism.loads import SPEED, LoadTable
from graphplan.mechanism.model import FRAME, Force
from graphplan.mechanism.units import NEWTONS

CHEBYSHEV_POINTS, MAX_CHEBYSHEV_POINTS = 24, 192  # of Chebyshev, between two breaks
TIME_POINTS = 16  # of Chebyshev, over the time of one stretch
TAIL_TERMS = 3  # terms at the end of a series that tell how far it is from settled
MAX_GROWTH = 10  # of the change of one round by that of the one before
MAX_PICARD_ROUNDS, MAX_HALVINGS = 24, 40  # of one stretch, which is halved where it takes more
COMPARED_TRAVELS = 13  # travels at which speeds and times are compared
COMPARED_CYCLES = 2.0  # cycles that are integrated anew
FLYWHEEL_POSES = 12  # in which a flywheel's reduction is compared
EXTREME_SAMPLES, EXTREME_ROUNDS = 33, 5  # speeds of a stretch, and then between the neighbours of the best


def check_motion(run: MachineMotion, drawing: MotionDrawing | None = None) -> dict[str, float]:
    """The largest relative differences from the solver: of the reduction, and of speed, time and energy.

    Fails with `Disagreement` where the motion differs by more than `MOTION_TOL`, or the reduction by more than
    rounding, and with `BrokenClaim` where a drawn step is not what it should be.
    """
    name, motion, machine = run.scene.name, run.motion, run.machine
    if drawing is not None:
        require_claims(name, drawing.values)
    last = min(motion.last_travel, motion.start + COMPARED_CYCLES * machine.period)
    places = np.linspace(motion.start, last, COMPARED_TRAVELS)
    gaps = check_reduction(run.reduction, _wrap_to_cycle(run.reduction, places[1:-1] / run.reduction.unit))
    reference = ReferenceMotion(run.reduction, machine.wheel, machine.closing)
    state = motion.state_at(places)
    compared = places[1:] if motion.stop is None or last < motion.last_travel else places[1:-1]
    omegas, times, works = reference.integrate(motion.start, float(state.omega[0]), compared)
    count = len(compared) + 1
    energies, speed, time = state.energy[1:count], float(state.omega.max()), float(state.time[count - 1])
    differences = {"omega": float(abs(omegas - state.omega[1:count]).max()) / speed,
                   "time": float(abs(times - state.time[1:count]).max()) / time,
                   "energy": float(abs(works + state.energy[0] - energies).max() / state.energy.max())}
    require_agreement(name, {f"{quantity} of the motion": gap for quantity, gap in differences.items()}, MOTION_TOL,
                      "by the energy", "by the equation of motion")
    return gaps | differences


def check_flywheel(result: FlywheelResult) -> dict[str, float]:
    """By how much the independent results differ, relative to what is compared.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where the integrated motion is
    another one, or methods that neglect nothing find different flywheels.
    """
    name, wheel, cycle = result.scene.name, result.wheel, result.cycle
    require_claims(name, result.drawing.values)
    poses = np.linspace(*cycle.ends, FLYWHEEL_POSES, endpoint=False)
    reduced = {f"reduced {quantity}": gap for quantity, gap in check_reduction(result.reduction, poses).items()}
    gaps = _flywheel_motion_gaps(result)
    if result.reduction.friction:
        gaps["friction"] = result.reduction.losses.relative_gap
    gutjahr = next((method.inertia for method in result.methods if method.name == "gutjahr"), None)
    if gutjahr is not None and not result.given:
        inertia = wheel.inertia + float(abs(cycle.inertia.terms[:, 0]).max())
        gaps["gutjahr"] = abs(gutjahr - wheel.inertia) / inertia
    require_agreement(name, gaps, SPEED_TOL, by="by the integrated equation of motion")
    return reduced | gaps


def _flywheel_motion_gaps(result: FlywheelResult) -> dict[str, float]:
    """Difference of the integrated speeds from the results, relative to the mean, and the closing error of the
    cycle."""
    wheel, cycle = result.wheel, result.cycle
    reference = ReferenceMotion(result.reduction.scale_loads(cycle.factor), wheel.inertia, cycle.closing, cycle.speed)
    first, last = (end * result.reduction.unit for end in cycle.ends)
    start = float(result.omega(cycle.ends[0]))
    stretches = [*reference.stretches(first, start, np.array([last]))]
    high, low = (float(best([stretch.extreme_speed(best) for stretch in stretches])) for best in (np.max, np.min))
    return {"omega_max": abs(high - wheel.omega_max) / cycle.speed,
            "omega_min": abs(low - wheel.omega_min) / cycle.speed,
            "unevenness": abs((high - low) / ((high + low) / 2) - result.unevenness),
            "closing": abs(float(stretches[-1].end[1] ** 2 - start**2)) / cycle.speed**2}


def _wrap_to_cycle(reduction: Reduction, travel: Reals) -> Reals:
    """Travels in the first cycle."""
    first, last = reduction.ends
    return first + np.mod(travel - first, last - first) if reduction.closed else travel


StateRates = Callable[[Reals], Reals]  # how states, which are columns, change with time


class _Law(NamedTuple):
    """A load over a speed, its arm and the speed that it measures being rows of the reference's table."""

    table: LoadTable
    row: int


class _Piece(NamedTuple):
    """Values between two breaks, as rows of terms of Chebyshev."""

    low: float
    high: float
    terms: Reals

    def values_at(self, travels: Reals) -> Reals:
        """The values; beyond an end those there, as a round may try how far it comes."""
        middle, half = (self.low + self.high) / 2, (self.high - self.low) / 2
        return np.asarray(chebval(np.clip((travels - middle) / half, -1, 1), self.terms.T))


class _TimedStretch(NamedTuple):
    """The motion over some time from a state on, which is travel, speed and work: the state at its `end`, and the terms
    of the speed beyond that at its `start`."""

    time: float
    end: Reals
    start: float
    speeds: Reals

    def extreme_speed(self, best: Callable[[Any], Any]) -> float:
        """The largest or the least speed: between ever nearer neighbours of the best of some."""
        ends = (-1.0, 1.0)
        for _ in range(EXTREME_ROUNDS):
            times = np.linspace(*ends, EXTREME_SAMPLES)
            speeds = self.start + chebval(times, self.speeds)
            k = int(np.flatnonzero(speeds == best(speeds))[0])
            ends = float(times[max(k - 1, 0)]), float(times[min(k + 1, EXTREME_SAMPLES - 1)])
        return float(speeds[k])


class ReferenceMotion:
    """The machine as the solver has it, with a `wheel` of this inertia and a constant `closing` moment on the drive.

    Loads over a speed are as they are at the `mean_speed`, if one is given, else at that of each moment.
    """

    def __init__(self, reduction: Reduction, wheel: float, closing: float, mean_speed: float | None = None):
        self.reduction, self.wheel, self.closing, self.mean_speed = reduction, wheel, closing, mean_speed
        self.first, self.last = reduction.ends
        least, wide = BREAK_DISTANCE * (self.last - self.first), (self.last - self.first) / 8
        breaks = [x for x, before in zip(reduction.breaks, (self.first, *reduction.breaks), strict=False)
                  if x - before > least and self.last - x > least]
        self.edges = [float(x) for a, b in pairwise([self.first, *breaks, self.last])
                      for x in np.linspace(a, b, max(1, math.ceil((b - a) / wide)), endpoint=False)] + [self.last]
        self.laws = [_Law(table, 3 + 2 * k) for k, (_, table) in enumerate(self._loads_over_speeds())]
        self.pieces: dict[int, _Piece] = {}

    def _loads_over_speeds(self) -> list[tuple[Any, LoadTable]]:
        """The loads over speeds."""
        loads = self.reduction.scene.loads
        assert loads is not None
        every: list[Any] = [*loads.forces, *loads.moments]
        return [(load, load.table) for load in every if load.table and load.table.over_speed and load.on != FRAME]

    # ---- what the solver says --------------------------------------------------------------------------------------

    def _solve_at(self, travel: Reals) -> Reals:
        """Inertia, slope and moment, and of each load over a speed its arm and that speed, as rows."""
        reference = ReferenceReduction(self.reduction, travel)
        truth = reference.truth
        rows = [truth[quantity].value + 0 * travel for quantity in ("inertia", "slope", "moment")]
        rows[2] += reference.friction
        for load, table in self._loads_over_speeds():
            rows += [self._arm(reference, load) + 0 * travel, self._speed(reference, table) + 0 * travel]
        return np.array(rows)

    def _arm(self, reference: ReferenceReduction, load: Any) -> Any:
        """The power of a unit of a load at a unit rate."""
        newton = float(NEWTONS[self.reduction.scene.units.force])
        if not isinstance(load, Force):
            return reference.rates.omega[load.on].value * newton / reference.unit
        x, y, length = reference.line_of_action(load)
        vx, vy = (component.value for component in reference.rates.velocity[load.at])
        return (vx * x + vy * y) / length * newton * reference.metres / reference.unit

    def _speed(self, reference: ReferenceReduction, table: LoadTable) -> Any:
        """The speed that a table is over, at a unit rate."""
        if table.over == SPEED:
            return 1.0 / reference.unit
        return reference.slide_component(reference.slide_of(table), reference.rates.slide_velocity) / reference.unit

    def _add_pieces(self, numbers: Iterable[int]) -> None:
        """Find the values between edges, all together, each at as many points as it takes."""
        unsettled, count = np.array([k for k in numbers if k not in self.pieces], dtype=int), CHEBYSHEV_POINTS
        edges = np.array(self.edges)
        while unsettled.size:
            low, high, rule = edges[unsettled, None], edges[unsettled + 1, None], _rule(count)
            values = self._solve_at(((low + high) / 2 + (high - low) / 2 * rule.points).ravel())
            values = values.reshape(len(values), len(unsettled), count).transpose(1, 0, 2)
            terms, sizes = values @ rule.terms.T, abs(values).max(axis=2)
            sizes[:, 1] = sizes[:, :2].max(axis=1)  # a slope that is nothing relative to the inertia is noise
            settled = (abs(terms[..., -TAIL_TERMS:]).max(axis=2) <= INTERPOLATION_TOL * sizes).all(axis=1)
            settled |= count >= MAX_CHEBYSHEV_POINTS
            for k in np.flatnonzero(settled):
                self.pieces[int(unsettled[k])] = _Piece(float(low[k, 0]), float(high[k, 0]), terms[k])
            unsettled, count = unsettled[~settled], 2 * count

    def equation_of_motion(self, piece: _Piece, shift: float) -> StateRates:
        """Rates of travel, speed and work in time, between two edges; states are columns."""
        unit = self.reduction.unit

        def rates(states: Reals) -> Reals:
            travel, omega, _ = states
            inertia, slope, moment, *_ = values = piece.values_at((travel - shift) / unit)
            speed = omega if self.mean_speed is None else np.full(omega.shape, self.mean_speed)
            moment = moment + self.closing
            for law in self.laws:
                moment = moment + values[law.row] * law.table.values_at(values[law.row + 1] * speed)
            return np.array([omega, (moment - slope * omega**2 / 2) / (inertia + self.wheel), moment * omega])

        return rates

    # ---- integrated ------------------------------------------------------------------------------------------------

    def integrate(self, start: float, omega: float, places: Reals) -> tuple[Reals, Reals, Reals]:
        """Speed, time and work at places, from one travel on."""
        time, rows = 0.0, {}
        for stretch in self.stretches(start, omega, places):
            time += stretch.time
            rows[float(stretch.end[0])] = stretch.end[1], time, stretch.end[2]
        omegas, times, works = np.array([rows[float(place)] for place in places]).T
        return omegas, times, works

    def stretches(self, start: float, omega: float, places: Reals) -> Iterator[_TimedStretch]:
        """The motion from one travel to the last of some places, in stretches that end at each of them."""
        unit, period = self.reduction.unit, (self.last - self.first) * self.reduction.unit
        stops = distinct_values([*places, *(edge * unit + turn * period for edge in self.edges
                                    for turn in range(math.ceil((places[-1] - start) / period) + 1))])
        stops = stops[(stops > start) & (stops <= places[-1])]
        middles = (np.array([start, *stops[:-1]]) + stops) / 2
        turns = np.zeros(len(middles))
        if self.reduction.closed:
            turns = np.floor((middles / unit - self.first) / (self.last - self.first))
        numbers = np.searchsorted(self.edges, (middles - turns * period) / unit) - 1
        self._add_pieces(set(numbers.tolist()))
        state, scale = np.array([start, omega, 0.0]), np.array([places[-1] - start, MIN_SPEED])
        for stop, turn, k in zip(stops.tolist(), turns.tolist(), numbers.tolist(), strict=True):
            rates = self.equation_of_motion(self.pieces[k], turn * period)
            for stretch in _move_to(stop, rates, state, scale):
                yield stretch
                state = stretch.end
                scale = np.maximum(scale, state[:2])


def _move_to(end: float, rates: StateRates, state: Reals, scale: Reals) -> Iterator[_TimedStretch]:
    """The motion up to a travel, in as many stretches as it takes."""
    ends = [end]
    while ends:
        stretch = _move_at_once(ends[-1], rates, state, scale)
        if stretch is None:
            if len(ends) > MAX_HALVINGS:
                raise Disagreement("motion", "time", "that of the energy", "a series that does not settle", math.inf)
            ends.append((float(state[0]) + ends[-1]) / 2)
            continue
        yield stretch
        state = stretch.end
        ends.pop()


def _move_at_once(end: float, rates: StateRates, state: Reals, scale: Reals) -> _TimedStretch | None:
    """The motion up to a travel by one series; None where that does not settle.

    Each round integrates the rates along the one before, and by Newton's method lets it end where it should.
    """
    rule, first, speed, last = _rule(TIME_POINTS), rates(state[:, None]), float(state[1]), math.inf
    time = 2 * (end - state[0]) / (speed + math.sqrt(max(speed**2 + 2 * first[1, 0] * (end - state[0]), 0.0)))
    elapsed = (rule.points + 1) / 2
    states = state[:, None] + first * time * elapsed
    for _ in range(MAX_PICARD_ROUNDS):
        try:
            slopes = rates(states)
        except Refused:  # a table that does not go so far
            return None
        terms = time / 2 * slopes @ rule.integrals.T
        before, states, after = states, state[:, None] + terms @ rule.series, state + terms.sum(axis=1)
        if not ((states[1] > 0).all() and after[1] > 0):
            return None
        scale = np.maximum(scale, abs(states[:2]).max(axis=1))
        missed, earlier = end - after[0], last
        last = max(abs(missed) / scale[0], float((abs(states - before)[:2].max(axis=1) / scale).max()))
        if last <= PICARD_TOL:
            settled = abs(terms[:2, -TAIL_TERMS:]).max(axis=1) <= STRETCH_TOL * scale
            return _TimedStretch(time, np.array([end, *after[1:]]), speed, terms[1]) if settled.all() else None
        if not last < MAX_GROWTH * earlier:
            return None
        time += float(missed / after[1])
        states += slopes * (missed / after[1]) * elapsed  # where they are at as large a part of the longer time
    return None


class _ChebyshevRule(NamedTuple):
    """The points of Chebyshev from -1 to 1; what makes of the values there the terms of their series, and of its
    integral from -1 on; and what makes of the latter its values at the points."""

    points: Reals
    terms: Reals
    integrals: Reals
    series: Reals


def _rule(count: int) -> _ChebyshevRule:
    points = chebpts1(count)
    series = np.asarray(chebvander(points, count).T, dtype=float)
    terms = series[:-1] * 2 / count
    terms[0] /= 2
    return _ChebyshevRule(points, terms, np.asarray(chebint(terms, lbnd=-1), dtype=float), series)
