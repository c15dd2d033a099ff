"""The time scale of drawn velocities: round, and no vector lost in the mechanism or larger than it."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from sampling import CORE

from graphplan.mechanism.order import turning_drives
from graphplan.mechanism.scene import load
from graphplan.methods.motion.time_scale import round_down, round_number, tempo
from graphplan.sheet.layout.scales import round_up


@pytest.mark.parametrize("name", CORE)
def test_kappa_is_round_and_the_prescribed_velocity_can_be_drawn(name: str) -> None:
    """kappa is 1, 2 or 5 times a power of ten, exactly; a crank's velocity is a tenth to a half of the mechanism."""
    scene = load(name)
    kappa = tempo(scene).kappa
    assert isinstance(kappa, Fraction)
    assert kappa == round_number(float(kappa))
    for drive in turning_drives(scene)[:1]:
        joints = [p for p in scene.links[drive.link] if p in scene.links.get(drive.on, ())]
        ends = [*scene.links[drive.link], *(s.at for s in scene.slides if drive.link in s.links)]
        reach = max((math.dist(tuple(map(float, scene.points[P])), tuple(map(float, scene.points[R])))
                     for P in joints for R in ends), default=0.0)
        assert not reach or 0.1 <= reach * abs(float(drive.rate)) * float(kappa) / scene.extent <= 0.5


@pytest.mark.parametrize(("omega", "times", "kappa"), [
    ("10", "1", "0.1"), ("-10", "1", "0.1"), ("5", "1", "0.2"), ("8", "1", "0.1"), ("31.4", "1", "0.02"),
    ("10", "0.01", "5"), ("10", "10", "0.02")])
def test_velocities_of_a_crank_end_in_its_pivot_where_that_is_round_and_large_enough(omega: str, times: str,
                                                                                     kappa: str) -> None:
    """kappa is one over the crank's angular velocity, but where that is not round, or the crank is short or long."""
    scene = load("four-bar")
    (x, y), drive = scene.points["A"], scene.drives[0]
    crank = {"A": (x * Fraction(times), y * Fraction(times))}
    scene = replace(scene, points=scene.points | crank).with_drives([drive.driven_at(Fraction(omega), Fraction(0))])
    assert tempo(scene).kappa == Fraction(kappa)


def test_what_stands_still_has_a_tempo() -> None:
    """A drive at rest draws no vector: kappa is one."""
    scene = load("four-bar")
    still = scene.drives[0].driven_at(Fraction(0), Fraction(0))
    assert tempo(scene.with_drives([still])).kappa == 1


@pytest.mark.parametrize("number", [1.3, 2.2, 2.7, 4.4, 6.0, 0.09])
def test_scales_of_lengths_and_velocities_are_close_together(number: float) -> None:
    """Of both on one plan, whatever is drawn, four scales at least are round in each power of ten."""
    kappa = round_down(number)
    assert len({round_up(10 ** (k / 40), (1, kappa)) for k in range(1, 41)}) >= 4
