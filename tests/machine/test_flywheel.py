"""The flywheel of a machine whose reduced inertia and moment are closed forms: Ozols' scotch yoke, in SI."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from graphplan.errors import Refused
from graphplan.kernel.claims import broken_claims
from graphplan.machine.flywheel.drawing import draw_flywheel
from graphplan.machine.flywheel.result import methods, rectangles
from graphplan.machine.flywheel.steady_cycle import by_mean_energy, size_flywheel, steady_cycle, turn_with
from graphplan.machine.reduced.reduction import MachineSize

TURN = 2 * math.pi
SPEED, UNEVENNESS = 15.0, 1 / 30


class Yoke:
    """The scotch yoke of Ozols 1974, 13-6: I = 10 + 4 sin^2 phi, a resisting moment of 200 |sin phi|."""

    closed, ends, breaks, unit = True, (0.0, TURN), (math.pi,), 1.0
    machine_size = MachineSize(14.0, 225.0, 14.0)

    def reduce_at(self, travel, side=None):
        resisting = -200 * np.abs(np.sin(travel))
        return SimpleNamespace(inertia=10 + 4 * np.sin(travel) ** 2, slope=4 * np.sin(2 * travel), moment=resisting,
                               by={"F_1": resisting, "M_1": np.full(len(travel), 25.0)}, speed_loads=())


@pytest.fixture(scope="module")
def cycle():
    return steady_cycle(Yoke(), SPEED)


def test_closing_moment_and_energy(cycle):
    """The closing moment is minus the mean of the rest, and the energy returns; its extremes are the closed form's."""
    assert cycle.closing == pytest.approx(400 / math.pi - 25, rel=1e-12)
    phi = np.array([0.3, 1.5, 3.0])
    assert cycle.energy.at(phi) == pytest.approx(400 / math.pi * phi - 200 * (1 - np.cos(phi)), abs=1e-10)
    assert cycle.energy.at(TURN) == pytest.approx(0, abs=1e-10)
    (low, least), (high, most) = cycle.energy.extremes(cycle.closed_moment)
    assert (math.degrees(low) % 180, math.degrees(high) % 180) == pytest.approx((140.46, 39.54), abs=0.005)
    assert most - least == pytest.approx(84.205, abs=5e-4)


def test_loads_that_change_close_the_cycle():
    """With closes = "load" the loads that change get a factor and the drive nothing; without such it is refused."""
    scaled = steady_cycle(Yoke(), SPEED, "load", ["F_1"])
    assert (scaled.closing, scaled.factor) == (0, pytest.approx(25 * TURN / 800))
    assert scaled.energy.at(TURN) == pytest.approx(0, abs=1e-9)
    with pytest.raises(Refused, match="no load changes"):
        steady_cycle(Yoke(), SPEED, "load")


def test_wittenbauer(cycle):
    """Tangents of prescribed slope: intercepts, origin, travels and the flywheel; on a parallel axis the same."""
    wheel = size_flywheel(cycle, UNEVENNESS)
    assert wheel.inertia == pytest.approx(49.379, abs=5e-4)
    assert (wheel.upper.cut, wheel.lower.cut) == pytest.approx((-1155.61, -1525.96), abs=0.005)
    assert wheel.origin == pytest.approx(-6897.5, abs=0.05)
    assert math.degrees(wheel.upper.travel) % 180 == pytest.approx(6.50, abs=0.005)
    assert math.degrees(wheel.lower.travel) % 180 == pytest.approx(94.76, abs=0.005)
    for at in (0.0, 10.0, -3.0):
        assert wheel.intercept(at) / (UNEVENNESS * SPEED**2) - at == pytest.approx(wheel.inertia)
    phi = np.linspace(0, TURN, 100001)
    omega = np.sqrt(2 * (cycle.energy.at(phi) - wheel.origin) / (cycle.inertia.at(phi) + wheel.inertia))
    assert (omega.max(), omega.min()) == pytest.approx((15.25, 14.75), abs=1e-8)


def test_speeds_with_a_given_flywheel(cycle):
    """With the flywheel that is found the unevenness is that asked for; without one, and by (15.7), the source's."""
    wheel = size_flywheel(cycle, UNEVENNESS)
    assert turn_with(cycle, wheel.inertia).unevenness == pytest.approx(UNEVENNESS, rel=1e-12)
    own = turn_with(cycle, 0.0)
    assert (own.omega_max + own.omega_min) / 2 == pytest.approx(SPEED, rel=1e-13)
    printed = by_mean_energy(cycle, 0.0)
    assert (printed.omega_max, printed.omega_min) == pytest.approx((16.470, 13.870), abs=5e-4)
    assert printed.unevenness == pytest.approx(0.1714, abs=5e-5)
    with pytest.raises(Refused, match=r"needs no flywheel.*0\.1716"):
        size_flywheel(cycle, 0.18)


def test_other_methods(cycle):
    """Gutjahr with the right pairing finds Wittenbauer's flywheel, the area vectors a far smaller one."""
    found = {method.name: method for method in methods(cycle, UNEVENNESS)}
    assert found["gutjahr"].inertia == pytest.approx(size_flywheel(cycle, UNEVENNESS).inertia, rel=1e-12)
    assert found["gutjahr"].stored == pytest.approx(445.35, abs=0.005)
    assert found["area vectors"].inertia == pytest.approx(11.227, abs=5e-4)
    assert sum(area.work for area in found["area vectors"].figures["areas"]) == pytest.approx(0, abs=1e-9)
    assert found["power"].stored == pytest.approx(84.205, abs=5e-4)


def test_work_and_idling():
    """The mean power of work and idling, and the surplus, of the source's rectangles."""
    assert rectangles(12, 2, 2, 6) == (4.5, 15)


def test_a_motor_that_gives_way(cycle):
    """A motor of constant moment stores the largest surplus; one that falls with the speed less."""
    stiff, soft = (methods(cycle, UNEVENNESS, motor)[-1].stored for motor in (lambda w: 25.0, lambda w: 625 - 40 * w))
    assert stiff == pytest.approx(84.205, abs=5e-4)
    assert soft != pytest.approx(stiff)


def test_cycles_that_do_not_close():
    """A machine that does not come back is refused, and a weight that does work over the cycle."""
    with pytest.raises(Refused, match="does not close"):
        steady_cycle(SimpleNamespace(closed=False, ends=(0.0, 1.0), unit=1.0), SPEED)
    falling, reduce_at = Yoke(), Yoke().reduce_at
    falling.reduce_at = lambda travel: SimpleNamespace(**{**vars(reduce_at(travel)), "by": {"G_2": 1 + np.sin(travel)}})
    with pytest.raises(Refused, match="G_2"):
        steady_cycle(falling, SPEED)


def test_drawn_construction(cycle):
    """Every drawn step is what it claims to be; with more plans the drawn flywheel comes to that of the true curve."""
    wheel, gaps = size_flywheel(cycle, UNEVENNESS), []
    for positions in (12, 24, 48, 96):
        drawing = draw_flywheel(cycle, wheel, positions)
        assert not [*broken_claims(drawing.values.drawing.program, drawing.values.numbers)]
        gaps.append(abs(drawing.inertia / wheel.inertia - 1))
    assert gaps == sorted(gaps, reverse=True)
    assert gaps[1] < 5e-3
    assert gaps[3] < 1e-4
    assert drawing.mean == pytest.approx(-cycle.closing, rel=1e-3)
    assert drawing.touching("upper") % 180 == pytest.approx(math.degrees(wheel.upper.travel), abs=0.05)


def test_drawn_scales(cycle):
    """Moments, energies and inertias stand where the scales have them, and k_E = H k_M k_phi."""
    drawing = draw_flywheel(cycle, size_flywheel(cycle, UNEVENNESS))
    moment, energy, inertia = (drawing.frames[name] for name in ("moment", "energy", "inertia"))
    assert energy.y.unit == pytest.approx(drawing.pole * moment.y.unit * math.radians(moment.x.unit))
    assert np.transpose(moment.position(drawing.travels,
                                        cycle.moment.at(np.radians(drawing.travels)))) == pytest.approx(
        np.array(drawing.values.values_of_role("moments")), abs=1e-6)
    levels = energy.position(drawing.travels, cycle.energy.at(np.radians(drawing.travels)))[1]
    assert np.array(drawing.values.values_of_role("energies"))[:, 1] == pytest.approx(levels, abs=0.5)
    assert np.array(drawing.values.values_of_role("points"))[:, 0] == pytest.approx(
        np.array(drawing.values.values_of_role("inertias"))[:-1, 0])
    assert inertia.x == drawing.frames["energy-mass"].x


@pytest.mark.parametrize("positions", [5, 721])
def test_too_few_or_many_plans(cycle, positions):
    """A drawing through too few plans, or more than can be told apart, is refused."""
    with pytest.raises(Refused, match="positions"):
        draw_flywheel(cycle, size_flywheel(cycle, UNEVENNESS), positions)
