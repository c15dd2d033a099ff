"""The motion that a scene asks for: from which speed, how far, or the steady cycle; with the flywheel that it asks for.

Without [flywheel] and [run] the machine starts with the speed that its first drive has, from rest where that is none,
and goes one turn under its loads alone. With [flywheel] it is the steady cycle, with the wheel and with what closes the
cycle. A run, or what is said otherwise, has the first say. The steady cycle is that which repeats itself, near the
speed on which the characteristics of driver and machine agree; the run-up to it is timed.

Sources: Ozols 1974, 13-1 and 13-7 (the nominal speed is where the characteristics intersect, of a driver's only the
part that falls faster than the machine's is stable); 15-1 (the initial speed of the steady cycle is searched for).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals, bisect
from graphplan.machines.flywheel.steady_cycle import needed_inertia, steady_cycle, turn_with
from graphplan.machines.motion.driven import DrivenMachine, driven_machine
from graphplan.machines.motion.true_motion import Place, TrueMotion, move
from graphplan.machines.reduced.reduction import Reduction, reduction
from graphplan.machines.tolerances import CYCLE_TOL
from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import TURN

# ---- steady motion and run-up ---------------------------------------------------------------------------------------


RUN_UP_SHARE = 0.01  # of the steady speed: a machine so near to it has run up
MAX_RUN_UP_TURNS = 100  # that a run-up may take
# how far from a speed the nominal one is looked for, and in how many steps each
SPEED_OCTAVES, SPEEDS_PER_OCTAVE = 12, 8
MAX_CYCLE_ROUNDS = 60  # of the search for the cycle that repeats itself: it takes three to six


@dataclass(frozen=True)
class RunUp:
    """Where a machine from rest comes within `NEAR` of its steady speed at the same travel, after how many turns."""

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
        raise Refused("the steady motion", "the speed is missing", "--speed, or the omega of the first [[drive]]")
    if machine.laws:
        return limit_cycle(machine, nominal_speed(machine, speed))
    over, size = (float(work[0]) for work in work_over_cycle(machine, np.array([speed])))
    if abs(over) > CYCLE_TOL * 1e3 * size:
        raise Refused("the steady motion", f"the loads give {over:.6g} J over a cycle, which does not close",
                      "[flywheel], whose closing moment closes it, or a driver's characteristic over the speed")
    return cycle_with_mean(machine, speed)


def motion_over_turn(machine: DrivenMachine, energy: float) -> TrueMotion:
    """One turn from its beginning with this energy there."""
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
    """How much farther from the steady motion than `NEAR` another is."""
    return abs(motion.state_at(travel).omega / cycle.state_at(travel).omega - 1) - RUN_UP_SHARE


def run_up(machine: DrivenMachine, cycle: TrueMotion, omega: float = 0.0) -> RunUp:
    """How a machine comes near its steady cycle, from rest or from another speed.

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


# ---- what a scene asks for ------------------------------------------------------------------------------------------


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
        raise Refused("--speed", f"{first:g} is below 0", "a speed in the sense in which the drive moves, or 0")
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
        raise Refused("--travel", f"{travel:g} is not greater than 0", "give degrees (lengths of a sliding drive)")
    if travel is not None and travel > MAX_TURNS * TURN_DEGREES and not (scene.drives and scene.drives[0].slides):
        raise Refused("--travel", f"{travel:g} degrees are more than {MAX_TURNS} turns",
                      "a shorter travel, or --steady")
    if scene.drives and scene.drives[0].slides and travel is None:
        raise Refused("the motion", "the first drive slides, and the travel is missing", "--travel, or travel in [run]")
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
