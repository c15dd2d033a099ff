"""The motion that a scene asks for: from which speed, how far, or the steady cycle; with the flywheel that it asks for.

Without [flywheel] and [run] the machine starts with the speed that its first drive has, from rest where that is none,
and goes one turn under its loads alone. With [flywheel] it is the steady cycle, with the wheel and with what closes the
cycle. A run, or what is said otherwise, has the first say.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from graphplan.errors import Refused
from graphplan.machine.flywheel import energy, wittenbauer
from graphplan.machine.motion.characteristics import TURNS, RunUp, limit_cycle, nominal, run_up, steady
from graphplan.machine.motion.driven import Driven, driven
from graphplan.machine.motion.true_motion import TrueMotion, moved
from graphplan.machine.reduced.reduction import Reduction, reduction
from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import TURN

TURN_TOLD = 360.0  # degrees
FARTHEST = 1000  # turns that a motion is followed


@dataclass(frozen=True, eq=False)
class Run:
    """A motion of a scene's machine. `steady` is its steady cycle, if it has loads over a speed or is asked for it;
    `nominal` the speed of its characteristics, in SI, and `run_up` how the motion comes near the steady cycle.
    """

    reduction: Reduction
    machine: Driven
    motion: TrueMotion
    steady: TrueMotion | None = None
    nominal: float | None = None
    run_up: RunUp | None = None

    @property
    def scene(self) -> Scene:
        return self.reduction.scene


def run(scene: Scene, speed: float | None = None, travel: float | None = None, in_cycle: bool = False) -> Run:
    """The motion of a scene: from a speed (rad/s or lengths/s) over a travel (degrees or lengths), or the steady cycle.

    Fails with `Refused` where the machine does not start or get so far, its cycle does not close, or it is to stop and
    does not.
    """
    asked = scene.run
    speed = _told(speed, None if asked is None else asked.speed)
    travel = _told(travel, None if asked is None else asked.travel)
    found = _reduced(scene, travel)
    in_cycle = in_cycle or (scene.flywheel is not None and asked is None and speed is None and travel is None)
    found, machine = _with_wheel(scene, found)
    own = abs(float(scene.drives[0].rate))
    if in_cycle:
        mean = speed if speed is not None else own if scene.flywheel is None else float(scene.flywheel.speed)
        motion = steady(machine, abs(mean) * machine.pace)
        return Run(found, machine, motion, motion, nominal(machine, motion.means.planimetric) if machine.laws else None)
    first = own if speed is None else speed
    if first < 0:
        raise Refused("--speed", f"{first:g} is below 0", "a speed in the sense in which the drive moves, or 0")
    stops = asked is not None and asked.stops
    end = _end(machine, travel, stops)
    motion = moved(machine, first * machine.pace, machine.begin, end)
    if stops:
        if motion.stop is None:
            raise Refused("run: stops", f"the machine still moves after {machine.told(end)}", "a travel, or more load")
        motion = replace(motion, end=motion.stop.travel)
    return _compared(Run(found, machine, motion), first)


def _told(*values: object) -> float | None:
    """The first number that is said."""
    return next((float(value) for value in values if value is not None), None)  # type: ignore[arg-type]


def _reduced(scene: Scene, travel: float | None) -> Reduction:
    """The masses and loads of the scene: over a whole cycle where there is one and the travel is a turn or more, or not
    said, or where a flywheel is asked for; else over the travel."""
    if travel is not None and travel <= 0:
        raise Refused("--travel", f"{travel:g} is not greater than 0", "give degrees (lengths of a sliding drive)")
    if travel is not None and travel > FARTHEST * TURN_TOLD and not (scene.drives and scene.drives[0].slides):
        raise Refused("--travel", f"{travel:g} degrees are more than {FARTHEST} turns", "a shorter travel, or --steady")
    if scene.drives and scene.drives[0].slides and travel is None:
        raise Refused("the motion", "the first drive slides, and the travel is missing", "--travel, or travel in [run]")
    whole = scene.flywheel is not None or travel is None or travel >= TURN_TOLD
    if scene.drives and not scene.drives[0].slides and whole:
        try:
            return reduction(scene)
        except Refused:
            if scene.flywheel is not None:
                raise
    return reduction(scene, (0.0, travel or TURN_TOLD))


def _end(machine: Driven, travel: float | None, stops: bool) -> float:
    """The travel at the end, in SI."""
    if travel is not None:
        return machine.begin + travel * machine.degree
    if not machine.closed:
        return machine.begin + machine.period
    return machine.begin + (TURN * TURNS if stops else TURN)


def _with_wheel(scene: Scene, found: Reduction) -> tuple[Reduction, Driven]:
    """The machine with the flywheel that is asked for, if it needs one, and what closes its cycle: a moment, or its
    loads scaled."""
    wanted = scene.flywheel
    if wanted is None:
        return found, driven(found)
    speed = abs(float(wanted.speed)) * found.unit
    cycle = energy.steady(found, speed, wanted.closes, found.changing)
    wheel = (wittenbauer.turning(cycle, float(wanted.inertia or 0)).inertia if wanted.unevenness is None
             else wittenbauer.needed(cycle, float(wanted.unevenness)))
    found = found.scaled(cycle.factor)
    return found, driven(found, wheel, cycle.closing)


def _compared(found: Run, speed: float) -> Run:
    """The run with the steady cycle that its machine comes to, if characteristics lead to one."""
    machine = found.machine
    if not (machine.laws and machine.closed) or found.motion.stop is not None:
        return found
    try:
        omega = nominal(machine, found.motion.extremes[1].omega)
        found = replace(found, nominal=omega, steady=(cycle := limit_cycle(machine, omega)))
        return replace(found, run_up=run_up(machine, cycle, speed * machine.pace))
    except Refused:
        return found
