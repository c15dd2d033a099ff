"""An engine's inertia forces by orders, beside Ozols' printed figures and the shaking force of the linkage."""

from __future__ import annotations

import math

import numpy as np
import pytest
from linkages_with_masses import four_bar, slider_crank

import graphplan as gp
from graphplan.check.balance import balancing
from graphplan.machine.linkages.engine import engine, in_line, path_series
from graphplan.mechanism.scene import load
from graphplan.mechanism.units import METRES

KGF = 9.81


def test_printed_figures() -> None:
    """Ozols, example 16-1: masses, coefficients, amplitudes and largest forces as printed."""
    found = engine(load("ozols-16-1"))
    assert found is not None
    assert (found.rotating, found.reciprocating) == pytest.approx((27.5, 50.5))
    assert (found.series[2].real, found.series[4].real) == pytest.approx((0.01225, -0.00004), abs=5e-6)
    assert found.radius * found.omega**2 == pytest.approx(274, abs=0.5)
    assert found.centrifugal / KGF == pytest.approx(770, abs=5)
    orders = [found.order(k).real / KGF for k in (1, 2, 4)]
    assert orders == pytest.approx([1410, 314, -4], abs=5)
    force = found.force(np.linspace(0, 2 * np.pi, 720)) / KGF
    assert np.abs(force.real).max() == pytest.approx(2490, abs=5)
    assert np.abs(force.imag).max() == pytest.approx(770, abs=5)


TABLE = [  # table 16-2 in kgf: angle; J_x and J_y without counterweights, with the main one, with the additional one
    (0, (2494, 0), (1724, 0), (314, 0)),  # 1744 is printed, which the other figures contradict
    (90, (-314, 770), (-314, 0), (-314, -1410)),
    (180, (-1866, 0), (-1096, 0), (314, 0)),
    (270, (-314, -770), (-314, 0), (-314, 1410))]


@pytest.mark.parametrize(("angle", "none", "main", "both"), TABLE)
def test_printed_table(angle: float, none: tuple[float, float], main: tuple[float, float],
                       both: tuple[float, float]) -> None:
    """Ozols, example 16-2: the main counterweight of 27.5 kg and the additional one of 50.5 kg (50.0 is printed)."""
    found = engine(load("ozols-16-1"))
    assert found is not None
    for weights, (x, y) in zip(((0.0, 0.0), (27.5, 0.0), (27.5, 50.5)), (none, main, both), strict=True):
        force = complex(found.force(math.radians(angle), (1, 2), *weights)) / KGF
        assert (force.real, force.imag) == pytest.approx((x, y), abs=5)


@pytest.mark.parametrize("ratio", [0.2, 0.5])
def test_series(ratio: float) -> None:
    """The coefficients are (6.47)'s: A_2 = r^2/4 + r^4/16 + ..., A_4 = -r^4/64 - ..., and no odd ones but the first."""
    found = path_series(ratio)
    second = [ratio**2 / 4, ratio**4 / 16, 15 * ratio**6 / 512]
    assert found[2].real == pytest.approx(sum(second), abs=ratio**8 / 40)
    assert found[4].real == pytest.approx(-ratio**4 / 64 - 3 * ratio**6 / 256, abs=ratio**8 / 40)
    assert np.abs(found[3::2]).max() < 1e-15


def test_orders_make_up_the_shaking_force() -> None:
    """All orders together are the shaking force of the linkage, with the guide beside the crank's hinge, too."""
    for scene in (slider_crank([(2, 0.06, 0), (3, 0.15, 0), (4, 0, 0)]), load("ozols-16-1")):
        assert balancing(scene, 12, "none").check["orders"] < 1e-12
    long = slider_crank([(2, 0.06, 0), (3, 0.15, 0), (4, 0, 0)], lengths=(0.2499, 0.25), offset=0.0)
    assert "orders" not in balancing(long, 12, "none").check  # of such a crank they have no end
    assert engine(four_bar([(2, 0.06, 0), (3, 0.15, 0), (4, 0.12, 0)])) is None
    assert engine(slider_crank([(2, 0.06, 0), (3, 0.15, 0.02), (4, 0, 0)])) is None


def test_a_share_of_what_reciprocates() -> None:
    """With half of the reciprocating mass on the crank the first order is half as large along the guide, and as large
    across it."""
    found = balancing(load("ozols-16-1"), 360, "share", share=0.5)
    assert found.engine is not None
    assert found.after is not None
    (weight,) = found.weights
    assert weight.mass == pytest.approx(27.5 + 50.5 / 2)
    force, half = found.after.shaking.force, abs(found.engine.order(1)) / 2
    phase = found.before.links.travel + math.radians(60)
    assert 2 * np.array([force.real @ np.cos(phase), force.imag @ np.sin(phase)]) / 360 == pytest.approx([half, -half])


def test_wheels_against_each_other() -> None:
    """Two wheels that turn against each other with the crank balance the first order, two at twice its speed the
    second; Ozols (16.19)."""
    found = engine(load("ozols-16-1"))
    assert found is not None
    for speed, moment in found.counter_rotating:
        assert 2 * moment * (speed * found.omega) ** 2 == pytest.approx(abs(found.order(speed)))


def test_cylinders_in_line() -> None:
    """Of two cylinders the second order is left and a couple of the first; of four the second; of six the sixth, as
    there are no odd orders but the first."""
    two = [in_line((0, 180), (0, 1), k) for k in (1, 2)]
    assert two == [pytest.approx((0, 1)), pytest.approx((2, 0))]
    four = [in_line((0, 180, 180, 0), range(4), k) for k in (1, 2, 4)]
    assert four == [pytest.approx((0, 0), abs=1e-12), pytest.approx((4, 0)), pytest.approx((4, 0))]
    six = {k: in_line((0, 240, 120, 120, 240, 0), range(6), k) for k in (1, 2, 4, 6, 8, 10, 12)}
    assert [k for k, (force, couple) in six.items() if max(force, couple) > 1e-9] == [6, 12]


def test_cylinders_are_told_by_their_orders() -> None:
    """Of four cylinders in line the first order is balanced and the second adds up, of two the first is a couple."""
    scene = gp.load("ozols-16-1")
    one = gp.balance(scene, positions=12).json()["engine"]["orders"]
    sizes = {entry["order"]: abs(complex(entry["cos"], entry["sin"])) for entry in one}
    four = scene.replace("cylinders", {"angles": [0, 180, 180, 0], "places": [0, 100, 200, 300]})
    found = {entry["order"]: entry for entry in gp.balance(four, positions=12).json()["cylinders"]}
    assert found[0]["force"] == pytest.approx(0, abs=1e-9 * sizes[1])
    assert found[1]["force"] == pytest.approx(0, abs=1e-9 * sizes[1])
    assert found[2]["force"] == pytest.approx(4 * sizes[2])
    two = scene.replace("cylinders", {"angles": [0, 180], "places": [0, 0.2]})
    couple = gp.balance(two, positions=12).json()["cylinders"][1]["couple"]
    assert couple == pytest.approx(0.2 * sizes[1] * float(METRES[scene.units.length]))


@pytest.mark.parametrize("cylinders", [{"angles": [0, 180], "places": [0]}, {"angles": [], "places": []},
                                       {"angles": [0, "x"], "places": [0, 1]}])
def test_faulty_cylinders_are_faults(cylinders: dict[str, list[object]]) -> None:
    """A place for each crank, and numbers alone."""
    with pytest.raises(gp.SceneError):
        gp.load("ozols-16-1").replace("cylinders", cylinders)
