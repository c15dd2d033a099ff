"""A pair that no file knows, a pin in a straight slot, is solved, drawn and followed as any: a record of few lines."""

from __future__ import annotations

import cmath
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
import pytest

import graphplan as gp
from graphplan.mechanism.model import Slide
from graphplan.mechanism.pairs.pair import LINE
from graphplan.mechanism.structure import structure

POINTS = {"O": (0, 0), "A": (30, 40), "B": (45, 60), "C": (80, -20), "D": (-10, 110)}


@dataclass(frozen=True)
class HalfJoint(Slide):
    """A pin `at` a point of `link` in a slot of `along`."""

    letter = "RP"
    binds = 1
    passes = (LINE,)


def slotted(second: str, *pin: str, slot: tuple[int, int]) -> gp.Scene:
    """A crank O A with one link more, loaded, and a half joint instead of a second drive and balance."""
    links = {"1": "O A", "2": second, "frame": "O C"}
    used = [name for name in POINTS if any(name in points.split() for points in links.values())]
    moving = [name for name in used if name not in "OC"]
    scene = gp.scene({
        "points": {name: POINTS[name] for name in used}, "links": links,
        "drive": [{"link": "1", "omega": 2, "alpha": 1}, {"link": "2", "omega": 1}],
        "masses": {"2": {"mass": 3, "inertia": 0.01, "centre": "D"}},
        "forces": [{"on": "2", "at": "D", "value": [-50, 20]}],
        "balance": [{"link": "1"}, {"link": "2"}],
        "find": {"velocity": moving, "acceleration": moving, "omega": ["1", "2"]}})
    joint = HalfJoint(*pin, (Fraction(slot[0]), Fraction(slot[1])))
    return replace(scene, written=(joint, scene.drives[0]),
                   loads=replace(scene.loads, balances=scene.loads.balances[:1]))


SCENES = {
    "a crank's pin in a rocker": (slotted("C D", "1", "2", "A", slot=(3, 10)), "RPR"),
    "a rocker's pin in a crank": (slotted("C B D", "2", "1", "B", slot=(3, 4)), "RRP"),
    "a coupler over a fixed pin": (slotted("A D", "frame", "2", "C", slot=(5, -6)), "RPR"),
    "a coupler's pin in the frame": (slotted("A B D", "2", "frame", "B", slot=(2, 1)), "RRP"),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_half_joint_is_drawn_and_solved(name: str) -> None:
    """Construction and solver agree in fractions; the pin passes a force across its slot alone; the other link is a
    dyad of the form that the two lower pairs instead of the joint give it."""
    scene, form = SCENES[name]
    found = gp.solve(scene, exact=True)
    assert {"velocity", "acceleration", "force"} <= {*found.check}
    assert not any(found.check.values())
    (joint,) = scene.slides
    (x, y), moment = gp.analytic.reactions(scene, exact=True).slides[joint.name]
    assert (x * joint.direction[0] + y * joint.direction[1], moment) == (0, 0)
    (dyad,) = structure(scene).groups
    assert (dyad.links, dyad.kind.split()[1]) == (("2",), form)


@pytest.mark.parametrize("name", SCENES)
def test_the_pin_stays_in_its_slot_around_the_cycle(name: str) -> None:
    """As far as the crank goes, the pin lies on the slot's line, and moves there as the solver says at first."""
    scene = SCENES[name][0]
    (joint,) = scene.slides
    turned = gp.follow(scene, 5, (-0.5, 0.5))
    assert not turned.faults
    place = {p: complex(*map(float, at)) for p, at in scene.points.items()}
    slot = [p for p in scene.links[joint.along] if p != joint.at][:2]
    turn = np.ones(5) if joint.along == "frame" else (
        (turned.points[slot[1]] - turned.points[slot[0]]) / (place[slot[1]] - place[slot[0]]))
    off = (turned.points[joint.at] - turned.points[slot[0]]) / turn - (place[joint.at] - place[slot[0]])
    assert np.abs((off / cmath.exp(1j * cmath.phase(complex(*map(float, joint.direction))))).imag) == pytest.approx(
        0, abs=1e-9)
    speed, step = gp.analytic.solve(scene).velocity["D"], np.radians(turned.travel[3] - turned.travel[1])
    assert (turned.points["D"][3] - turned.points["D"][1]) / step * 2 == pytest.approx(speed, rel=1e-4)
