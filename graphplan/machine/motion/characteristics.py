"""Steady motion: the speed that the characteristics of driver and machine agree on, the cycle that repeats itself, and
how long the run-up to it takes.

Sources: Ozols 1974, 13-1 and 13-7 (the nominal speed is where the characteristics intersect, of a driver's only the
part that falls faster than the machine's is stable); 15-1 (the initial speed of the steady cycle is searched for).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from graphplan.errors import Refused
from graphplan.machine.integrals import Reals
from graphplan.machine.motion.driven import Driven
from graphplan.machine.motion.true_motion import Place, TrueMotion, moved
from graphplan.machine.tolerances import CYCLE_TOL

NEAR = 0.01  # of the steady speed: a machine so near to it has run up
TURNS = 100  # that a run-up may take
OCTAVES, GRID = 12, 8  # how far from a speed the nominal one is looked for, and in how many steps each
ROUNDS = 60  # of the search for the cycle that repeats itself: it takes three to six


@dataclass(frozen=True)
class RunUp:
    """Where a machine from rest comes within `NEAR` of its steady speed at the same travel, after how many turns."""

    place: Place
    turns: float


def work(machine: Driven, omega: Reals) -> tuple[Reals, Reals]:
    """The work of all loads over a cycle at constant speeds, shape (k,), and that of their sizes; the moment that
    closes the cycle counts by itself."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    edges = machine.reduced[0].edges
    low, width = edges[:-1, None], np.diff(edges)[:, None]
    travel = (low + width * (nodes + 1) / 2).ravel()
    each = (width / 2 * weights).ravel()
    moment = machine.moment(travel, omega[:, None]) + np.zeros((len(omega), 1))
    return moment @ each, (abs(moment - machine.closing) + abs(machine.closing)) @ each


def nominal(machine: Driven, near: float) -> float:
    """The speed nearest to another at which the loads do no work over a cycle, and are stable; to rounding.

    Fails with `Refused` where the characteristics do not intersect so.
    """
    speeds = near * 2.0 ** (np.arange(-OCTAVES * GRID, OCTAVES * GRID + 1) / GRID)
    works = work(machine, speeds)[0]
    falling = np.flatnonzero((works[:-1] > 0) & (works[1:] <= 0))
    if not len(falling):
        raise Refused("the steady motion", "the characteristics of the loads do not intersect: at no speed is their "
                      "work over a cycle zero", "a driver whose moment falls with the speed")
    k = min(falling, key=lambda k: abs(math.log(speeds[k] * speeds[k + 1] / near**2)))
    low, high = float(speeds[k]), float(speeds[k + 1])
    for _ in range(52):
        middle = (low + high) / 2
        low, high = (middle, high) if work(machine, np.array([middle]))[0][0] > 0 else (low, middle)
    return (low + high) / 2


def steady(machine: Driven, speed: float) -> TrueMotion:
    """The cycle that repeats itself; of a machine whose loads know no speed the one with this mean (max + min)/2.

    Fails with `Refused` where the machine does not turn, or its cycle does not close at any speed.
    """
    if not machine.closed:
        raise Refused("the steady motion", "the mechanism does not return to its pose after a turn",
                      "a first drive that makes full turns")
    if not speed > 0:
        raise Refused("the steady motion", "the speed is missing", "--speed, or the omega of the first [[drive]]")
    if machine.laws:
        return limit_cycle(machine, nominal(machine, speed))
    over, size = (float(one[0]) for one in work(machine, np.array([speed])))
    if abs(over) > CYCLE_TOL * 1e3 * size:
        raise Refused("the steady motion", f"the loads give {over:.6g} J over a cycle, which does not close",
                      "[flywheel], whose closing moment closes it, or a driver's characteristic over the speed")
    return _with_mean(machine, speed)


def _cycle(machine: Driven, energy: float) -> TrueMotion:
    """One turn from its beginning with this energy there."""
    begin = machine.begin
    omega = math.sqrt(2 * energy / float(machine.inertia(np.array([begin]))[0]))
    motion = moved(machine, omega, begin, begin + machine.period)
    if motion.stop is not None:
        raise Refused("the steady motion", f"the machine comes to rest at {machine.told(motion.stop.travel)}",
                      "a larger speed, or a flywheel")
    return motion


def limit_cycle(machine: Driven, omega: float) -> TrueMotion:
    """The cycle at whose end the energy is that of its beginning: by secants, from the nominal speed."""
    energy = float(machine.inertia(np.array([machine.begin]))[0]) * omega**2 / 2
    before = miss = 0.0
    for round_ in range(ROUNDS):
        motion = _cycle(machine, energy)
        last, miss = miss, float(motion.at([motion.end]).energy[0]) - energy
        if abs(miss) <= CYCLE_TOL * energy:
            return motion
        steeper = (miss - last) / (energy - before) if round_ else -1.0
        before, energy = energy, max(energy - miss / (steeper if steeper < 0 else -1.0), energy / 4)
    raise Refused("the steady motion", "no periodic motion was found", "a driver whose moment falls with the speed")


def _with_mean(machine: Driven, speed: float) -> TrueMotion:
    """The cycle whose mean speed is this: the square of the speed at its beginning grows with that of the mean."""
    energy = float(machine.inertia(np.array([machine.begin]))[0]) * speed**2 / 2
    for _ in range(ROUNDS):
        motion = _cycle(machine, energy)
        mean = motion.means.arithmetic
        if abs(mean - speed) <= CYCLE_TOL * speed:
            return motion
        energy *= 1 + 2 * (speed / mean - 1)
    raise Refused("the steady motion", f"no cycle has the mean speed {speed:g}", "a larger speed, or a flywheel")


def _apart(motion: TrueMotion, cycle: TrueMotion, travel: Reals) -> Reals:
    """How much farther from the steady motion than `NEAR` another is."""
    return abs(motion.at(travel).omega / cycle.at(travel).omega - 1) - NEAR


def run_up(machine: Driven, cycle: TrueMotion, omega: float = 0.0) -> RunUp:
    """How a machine comes near its steady cycle, from rest or from another speed.

    Fails with `Refused` where it cannot start, stops, or takes more than `TURNS` turns.
    """
    elapsed, begin, period = 0.0, machine.begin, machine.period
    for turn in range(TURNS):
        motion = moved(machine, omega, begin, begin + period)
        apart = partial(_apart, motion, cycle)
        if motion.stop is not None:
            raise Refused("the run-up", f"the machine stops again in turn {turn + 1}", "more drive, or less load")
        near = motion.seen[apart(motion.seen) <= 0]
        if len(near):
            there = min(near[0], *motion.roots(apart), near[0])
            at = motion.at([there])
            place = Place(there + turn * period, float(at.omega[0]), elapsed + float(at.time[0]))
            return RunUp(place, (place.travel - begin) / period)
        last = motion.at([begin + period])
        omega, elapsed = float(last.omega[0]), elapsed + float(last.time[0])
    raise Refused("the run-up", f"after {TURNS} turns it is not within {NEAR:.0%} of the steady motion",
                  "a smaller flywheel, or more drive")
