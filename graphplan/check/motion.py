"""The independent check of a motion and of a flywheel: the equation of motion integrated over time, from the solver.

I omega' + omega^2/2 dI/dphi = M is integrated by the pair of Dormand and Prince, of order five, with the work as a
third unknown; inertia, slope and moments are the solver's at the points of Chebyshev between the breaks. Neither the
scheme nor the variable nor the numbers are those of the motion. With a flywheel it starts at the speed at which the
cycle is said to begin: the extreme speeds have to be those asked for, and the cycle has to close.

Source of the pair: Dormand and Prince 1980, A family of embedded Runge-Kutta formulae.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.reduction import ReferenceReduction, check_reduction
from graphplan.check.tolerances import (
    BREAK_DISTANCE,
    END_TOL,
    INTERPOLATION_TOL,
    MIN_ERROR_RATIO,
    MIN_SPEED,
    MOTION_TOL,
    SPEED_TOL,
    STEP_TOL,
)
from graphplan.errors import Disagreement
from graphplan.kernel.numbers.arrays import Reals, distinct_values
from graphplan.machine.flywheel.result import FlywheelResult
from graphplan.machine.motion.drawing import MotionDrawing
from graphplan.machine.motion.runs import MachineMotion
from graphplan.machine.reduced.reduction import Reduction
from graphplan.mechanism.loads import SPEED, LoadTable
from graphplan.mechanism.model import FRAME, Force
from graphplan.mechanism.units import NEWTONS

CHEBYSHEV_POINTS, MAX_CHEBYSHEV_POINTS = 24, 192  # of Chebyshev, between two breaks
MAX_STEPS = 20_000  # of an integration between two travels
COMPARED_TRAVELS = 13  # travels at which speeds and times are compared
COMPARED_CYCLES = 2.0  # cycles that are integrated anew
FLYWHEEL_POSES = 12  # in which a flywheel's reduction is compared
SPEED_SAMPLES = 6  # between two edges, of which a cycle has eight at least: an extreme speed lies near one
EXTREME_ROUNDS = 3  # each with travels a quarter as far apart

RUNGE_KUTTA_STAGES = ((1 / 5,), (3 / 40, 9 / 40), (44 / 45, -56 / 15, 32 / 9),
                      (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
                      (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
                      (35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84))
ERROR_WEIGHTS = np.array((71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40))


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
    """How far the integrated speeds are from those found, relative to the mean, and how far the cycle is from closed.
    """
    wheel, cycle = result.wheel, result.cycle
    reference = ReferenceMotion(result.reduction.scale_loads(cycle.factor), wheel.inertia, cycle.closing, cycle.speed)
    start = cycle.ends[0]
    places = np.concatenate([[start], *(np.linspace(low, high, SPEED_SAMPLES + 1)[1:]
                                        for low, high in pairwise(reference.edges))])
    end = len(places) - 1
    if result.reduction.closed:  # an extreme speed at the end of the cycle lies between places of two cycles
        places = np.append(places, places[1:3] + places[end] - start)
    speeds = np.array([result.omega(start), *reference.integrate(start, float(result.omega(start)), places[1:])[0]])
    inner = slice(1 if result.reduction.closed else 0, None)
    high, low = (reference.extreme_speed(places[inner], speeds[inner], best) for best in (np.argmax, np.argmin))
    return {"omega_max": abs(high - wheel.omega_max) / cycle.speed,
            "omega_min": abs(low - wheel.omega_min) / cycle.speed,
            "unevenness": abs((high - low) / ((high + low) / 2) - result.unevenness),
            "closing": abs(float(speeds[end] ** 2 - speeds[0] ** 2)) / cycle.speed**2}


def _wrap_to_cycle(reduction: Reduction, travel: Reals) -> Reals:
    """Travels in the first cycle."""
    first, last = reduction.ends
    return first + np.mod(travel - first, last - first) if reduction.closed else travel


class _Law(NamedTuple):
    """A load over a speed, its arm and the speed that it measures being rows of the reference's table."""

    table: LoadTable
    row: int


@dataclass
class _Piece:
    """Values between two breaks: at the points of Chebyshev, by the barycentric formula anywhere."""

    low: float
    high: float
    points: Reals
    values: Reals

    @cached_property
    def _weights(self) -> Reals:
        """The weight of each point in the barycentric formula, shape (n,)."""
        count = np.arange(len(self.points))
        return np.asarray((-1.0) ** count * np.sin(np.pi * (count + 0.5) / len(count)), dtype=float)

    def values_at(self, travel: float) -> Reals:
        """The values; beyond an end those there, as a step may try how far it comes."""
        travel = min(max(travel, self.low), self.high)
        away = (2 * travel - self.low - self.high) / (self.high - self.low) - self.points
        if not away.all():
            node_values: Reals = self.values[:, int(np.argmin(abs(away)))]
            return node_values
        weights = self._weights / away
        summed: Reals = self.values @ weights / weights.sum()
        return summed


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

    def _piece(self, k: int) -> _Piece:
        """The values between two edges, at as many points as it takes."""
        if k not in self.pieces:
            low, high = self.edges[k:k + 2]
            count = CHEBYSHEV_POINTS
            while True:
                points = np.cos(np.pi * (np.arange(count) + 0.5) / count)
                values = self._solve_at((low + high) / 2 + (high - low) / 2 * points)
                terms = abs(np.cos(np.outer(np.arange(count), np.arccos(points))) @ values.T) * 2 / count
                sizes = abs(values).max(axis=1)
                sizes[1] = max(sizes[:2])  # a slope that is nothing relative to the inertia is noise
                if (terms[-3:].max(axis=0) <= INTERPOLATION_TOL * sizes).all() or count >= MAX_CHEBYSHEV_POINTS:
                    break
                count *= 2
            self.pieces[k] = _Piece(low, high, points, values)
        return self.pieces[k]

    def equation_of_motion(self, piece: _Piece, shift: float) -> Callable[[Reals], Reals]:
        """How travel, speed and work change with time, between two edges."""
        unit = self.reduction.unit

        def rates(state: Reals) -> Reals:
            travel, omega, _ = state
            inertia, slope, moment, *_ = values = piece.values_at((travel - shift) / unit)
            speed = omega if self.mean_speed is None else self.mean_speed
            moment = moment + self.closing
            for law in self.laws:
                moment += values[law.row] * float(law.table.values_at(np.array([values[law.row + 1] * speed]))[0])
            return np.array([omega, (moment - slope * omega**2 / 2) / (inertia + self.wheel), moment * omega])

        return rates

    # ---- integrated ------------------------------------------------------------------------------------------------

    def integrate(self, start: float, omega: float, places: Reals) -> tuple[Reals, Reals, Reals]:
        """Speed, time and work at places, from one travel on."""
        unit, period = self.reduction.unit, (self.last - self.first) * self.reduction.unit
        stops = distinct_values([*places, *(edge * unit + turn * period for edge in self.edges
                                    for turn in range(math.ceil((places[-1] - start) / period) + 1))])
        state, time, rows = np.array([start, omega, 0.0]), 0.0, []
        scale = np.array([places[-1] - start, max(omega, MIN_SPEED), 1.0])
        for stop in stops[(stops > start) & (stops <= places[-1])]:
            middle = (state[0] + stop) / 2
            turn = math.floor((middle / unit - self.first) / (self.last - self.first)) if self.reduction.closed else 0
            k = int(np.searchsorted(self.edges, (middle - turn * period) / unit)) - 1
            state, spent, scale = _integrate_to(self.equation_of_motion(self._piece(k), turn * period), state,
                                                float(stop), scale)
            time += spent
            if stop in places:
                rows.append((state[1], time, state[2]))
        omegas, times, works = np.array(rows).T
        return omegas, times, works

    def extreme_speed(self, places: Reals, speeds: Reals, best: Callable[[Reals], Any]) -> float:
        """The largest or the least speed, near those of some places that are the best of their neighbours: another peak
        may be higher between the places than that of the best one."""
        top = int(best(speeds))
        near = float(abs(np.diff(speeds)).max())  # so far may a peak lie over its places
        peaks = {min(max(top, 1), len(places) - 2), *(k for k in range(1, len(places) - 1)
                 if best(speeds[k - 1:k + 2]) == 1 and abs(speeds[k] - speeds[top]) <= near)}
        extremes = np.array([self._refine_extreme(places[k - 1:k + 2], speeds[k - 1:k + 2], best) for k in peaks])
        return float(extremes[best(extremes)])

    def _refine_extreme(self, places: Reals, speeds: Reals, best: Callable[[Reals], Any]) -> float:
        """The extreme speed about the middle of three places: between ever nearer ones, and at the vertex of the
        parabola through the last three."""
        for _ in range(EXTREME_ROUNDS):
            k = min(max(int(best(speeds)), 1), len(places) - 2)
            low, middle, high = places[k - 1:k + 2]
            places = np.concatenate([np.linspace(low, middle, 5), np.linspace(middle, high, 5)[1:]])
            speeds = np.array([speeds[k - 1], *self.integrate(low, speeds[k - 1], places[1:])[0]])
        k = min(max(int(best(speeds)), 1), len(places) - 2)
        square, slope, _ = np.polyfit(places[k - 1:k + 2] - places[k], speeds[k - 1:k + 2], 2)
        vertex = places[k] - slope / (2 * square) if square else places[k]
        if places[k - 1] < vertex < places[k + 1]:
            speeds = np.append(speeds, self.integrate(places[k - 1], speeds[k - 1], np.array([vertex]))[0])
        return float(speeds[best(speeds)])


def _integrate_to(rates: Callable[[Reals], Reals], state: Reals, end: float,
                  scale: Reals) -> tuple[Reals, float, Reals]:
    """The state at a travel, the time until then, and how large states have been."""
    time, first = 0.0, rates(state)
    step = 0.1 * (end - state[0]) / max(state[1], math.sqrt(abs(first[1]) * (end - state[0])))
    for _ in range(MAX_STEPS):
        scale, remaining = np.maximum(scale, abs(state)), end - state[0]
        step = min(step,
                   1.1 * remaining / max(state[1], math.sqrt(abs(first[1]) * remaining)))  # no farther than is known
        after, apart, last = _runge_kutta_step(rates, state, first, step)
        error = float((apart / scale).max()) / STEP_TOL
        if not error <= 1:
            step *= max(0.2, 0.9 * error**-0.2) if 1 < error < math.inf else 0.5
            continue
        if after[0] >= end:
            step = _step_to_angle(rates, state, first, step, end)
            return _runge_kutta_step(rates, state, first, step)[0], time + step, scale
        state, first, time = after, last, time + step
        step *= min(5.0, 0.9 * max(error, MIN_ERROR_RATIO) ** -0.2)
    raise Disagreement("motion", "time", "that of the energy", f"more than {MAX_STEPS} steps", math.inf)


def _step_to_angle(rates: Callable[[Reals], Reals], state: Reals, first: Reals, step: float, end: float) -> float:
    """The step that ends at a travel, by Newton's method."""
    for _ in range(20):
        after = _runge_kutta_step(rates, state, first, step)[0]
        change = (after[0] - end) / after[1]
        step -= change
        if abs(change) <= END_TOL * step:
            break
    return step


def _runge_kutta_step(rates: Callable[[Reals], Reals], state: Reals, first: Reals,
                      step: float) -> tuple[Reals, Reals, Reals]:
    """The state a step on, the step's error, and the rates there."""
    slopes = [first]
    for row in RUNGE_KUTTA_STAGES:
        slopes.append(rates(state + step * sum(a * k for a, k in zip(row, slopes, strict=True))))
    after = state + step * sum(a * k for a, k in zip(RUNGE_KUTTA_STAGES[-1], slopes, strict=False))
    return after, abs(step * (ERROR_WEIGHTS @ np.array(slopes))), slopes[-1]
