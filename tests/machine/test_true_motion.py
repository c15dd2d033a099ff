"""True motion against closed forms and Ozols' worked examples: run-up, run-down, steady cycle, strips by hand."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals
from graphplan.machine.integrals import fit_piecewise
from graphplan.machine.motion.drawing import draw_motion, moment_curve
from graphplan.machine.motion.driven import DrivenMachine, SpeedLaw
from graphplan.machine.motion.runs import nominal_speed, run_up, steady_motion
from graphplan.machine.motion.strips import baranov, by_energy, parabola, times
from graphplan.machine.motion.true_motion import move

TURN = 2 * math.pi
Curve = Callable[[Reals], Reals]


def yoke(moment: Curve, *laws: Callable[[Reals], Reals], breaks: Sequence[float] = (0, math.pi, TURN)) -> DrivenMachine:
    """Ozols' scotch yoke (example 13-6) under a moment, and under laws over the speed of the crank."""
    inertia, slope = (lambda x: 10 + 4 * np.sin(x) ** 2), (lambda x: 4 * np.sin(2 * x))
    curves = [*fit_piecewise(lambda x: np.array([inertia(x), slope(x), moment(x), 1 + 0 * x]), breaks)]
    return DrivenMachine((curves[0], curves[1], curves[2]), breaks[-1] == TURN,
                         tuple(SpeedLaw(f"M_{k}", curves[3], curves[3], law) for k, law in enumerate(laws, 2)))


def wheel(moment: float, *laws: Callable[[Reals], Reals]) -> DrivenMachine:
    """A wheel of 10 kg m^2 under a constant moment and laws over its speed."""
    curves = [*fit_piecewise(lambda x: np.array([10 + 0 * x, 0 * x, moment + 0 * x, 1 + 0 * x]), (0, TURN))]
    return DrivenMachine((curves[0], curves[1], curves[2]), True,
                         tuple(SpeedLaw("M_2", *curves[3:] * 2, law) for law in laws))


def loaded(x: Reals) -> Reals:
    """The resistance of the yoke's slider."""
    return -200 * abs(np.sin(x))


def test_run_up_from_rest() -> None:
    """Speed, time and energy of the yoke under 400 N m from rest are those of the energy integral."""
    motion = move(yoke(lambda x: 400 + loaded(x)), 0, 0, math.pi)
    found = motion.state_at(np.radians([30, 90, 180]))
    assert found.omega == pytest.approx([5.7626, 7.8223, 13.0892], abs=5e-5)
    assert found.time == pytest.approx([0.16726, 0.31914, 0.47720], abs=5e-6)
    assert found.energy[2] == pytest.approx(400 * math.pi - 400, rel=1e-13)
    assert motion.state_at([0.0]).acceleration == pytest.approx([40], rel=1e-13)


def test_first_strips_by_the_parabola() -> None:
    """Trapezoids under 1/omega after a parabola over two strips err as the strips are wide."""
    motion = move(yoke(lambda x: 400 + loaded(x)), 0, 0, math.pi)
    for width, first, last in ((10, 0.12685, 0.46984), (5, 0.091927, 0.47535), (2, 0.058789, 0.47702)):
        travel = np.radians(np.arange(0, 180 + width / 2, width))
        time = times(travel, motion.state_at(travel).omega)
        assert (time[2], time[-1]) == pytest.approx((first, last), abs=6e-6)
    with pytest.raises(Refused, match="the time has no end"):
        parabola(np.array([0.0, 1, 2]), np.array([0.0, 1, 2]))


def test_uniformly_accelerated_run_up() -> None:
    """The driving moment of example 13-6 speeds the yoke up evenly, 35.8 rad/s^2; Baranov's steps near its speed."""
    machine = yoke(lambda x: 358 + 143.2 * np.sin(x) ** 2 + 143.2 * x * np.sin(2 * x), breaks=(0, math.pi))
    travel = np.radians(np.arange(0, 180.5, 30))
    found = move(machine, 0, 0, math.pi).state_at(travel)
    assert found.omega == pytest.approx(np.sqrt(2 * 35.8 * travel), rel=1e-12)
    assert found.acceleration == pytest.approx(35.8, rel=1e-12)
    assert found.time == pytest.approx(np.sqrt(2 * travel / 35.8), rel=1e-11)
    for width, speed in ((1, 15.060), (0.5, 15.033), (0.1, 15.007)):
        steps = np.radians(np.arange(0, 180 + width / 2, width))
        assert baranov(machine, steps, 0)[-1] == pytest.approx(speed, abs=6e-4)
        assert by_energy(machine, steps, 0)[-1] == pytest.approx(14.998, abs=6e-4)


def test_linear_characteristics() -> None:
    """Under M_P0 - K omega the speed grows as Ozols' (13.42) to (13.46) have it; under a brake it stops for good."""
    machine = wheel(-60, lambda v: 360 - 20 * v)
    motion = move(machine, 0, 0, 40)
    found = motion.state_at([1e-3, 0.5, 5, 40])
    grown = 1 - np.exp(-2 * found.time)
    assert found.omega == pytest.approx(15 * grown, rel=1e-11)
    assert 15 * (found.time - grown / 2) == pytest.approx([1e-3, 0.5, 5, 40], rel=1e-10)
    assert nominal_speed(machine, 3.0) == pytest.approx(15, rel=1e-12)
    up = run_up(machine, steady_motion(machine, 3.0))
    assert up.place.time == pytest.approx(math.log(100) / 2, rel=1e-9)
    with pytest.raises(Refused, match="do not intersect"):
        nominal_speed(wheel(-60), 3.0)


def test_stopping() -> None:
    """A braked machine stops where its energy is used up, and nothing is known beyond."""
    motion = move(wheel(-20), 13, 0, 8 * TURN)
    assert motion.stop is not None
    assert motion.stop[:3:2] == pytest.approx((42.25, 6.5), rel=1e-11)
    assert np.isnan(motion.state_at([42.26]).omega).all()
    damped = move(wheel(-20, lambda v: -4 * v), 13, 0, 8 * TURN).stop  # omega + 5 falls as exp(-0.4 t)
    assert damped is not None
    t = math.log(18 / 5) / 0.4
    assert damped[:3:2] == pytest.approx((18 * (1 - 5 / 18) / 0.4 - 5 * t, t), rel=1e-10)
    for held in (wheel(-20), wheel(0)):
        with pytest.raises(Refused, match="does not start"):
            move(held, 0, 0, TURN)


def test_steady_cycle() -> None:
    """The cycle that closes has the mean speed asked for; with Wittenbauer's flywheel its unevenness is 1/30."""
    machine = yoke(lambda x: 400 / math.pi + loaded(x))
    motion = steady_motion(machine, 15)
    assert motion.means.arithmetic == pytest.approx(15, rel=1e-12)
    assert motion.state_at([TURN]).omega == pytest.approx(motion.state_at([0.0]).omega, rel=1e-12)
    even = steady_motion(replace(machine, wheel=49.3793467), 15)
    assert [place.omega for place in even.extremes] == pytest.approx([14.75, 15.25], abs=1e-6)
    assert np.degrees([place.travel % math.pi for place in even.extremes]) == pytest.approx([94.76, 6.50], abs=0.01)
    with pytest.raises(Refused, match="does not close"):
        steady_motion(yoke(loaded), 15)


def test_limit_cycle() -> None:
    """A motor whose moment falls leads any motion into one cycle, which repeats itself."""
    machine = yoke(loaded, lambda speed: 1000 - 50 * speed)
    motion = steady_motion(machine, 10)
    assert motion.state_at([TURN]).omega == pytest.approx(motion.state_at([0.0]).omega, rel=1e-12)
    later = move(machine, 24, 0, 10 * TURN)
    assert later.state_at([10 * TURN]).omega == pytest.approx(motion.state_at([0.0]).omega, rel=1e-6)
    assert motion.means.planimetric == pytest.approx(nominal_speed(machine, 10), rel=1e-9)  # as the moments are linear


def test_moments_that_jump_stay_on_their_diagram() -> None:
    """The frame of moments holds the true curve, on both sides of its jumps, though every strip's middle is less."""
    motion = move(yoke(lambda x: np.where(x < 2, 400.0, -900 + 300 * (x - 2)), breaks=(0, 2, TURN)), 9, 0, TURN)
    travels, moments = moment_curve(motion)
    assert (moments.min(), moments.max()) == pytest.approx((-900, 400))
    assert travels[moments.argmin()] == travels[moments.argmin() - 1] == 2
    drawing = draw_motion(motion, 12)
    assert drawing
    frame = drawing.frames["moment"]
    low, high = (frame.y.value(end) for end in frame.upright)
    assert low <= -900
    assert high >= 400
