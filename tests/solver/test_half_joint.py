"""A pair that no file knows, a pin in a straight slot, is solved, drawn and followed as any: a record of few lines."""

from __future__ import annotations

import cmath
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from by_hand import force, hold, loads, mass, mechanism, turn

import graphplan as gp
from graphplan.check.trusted import report
from graphplan.mechanism.model import Find, Scene, Slide
from graphplan.mechanism.pairs.pair import LINE
from graphplan.mechanism.structure import structure
from graphplan.solver import reactions, solve

POINTS: dict[str, Any] = {"O": (0, 0), "A": (30, 40), "B": (45, 60), "C": (80, -20), "D": (-10, 110)}
LOADS = loads(force("2", "D", (-50, 20)), masses={"2": mass(3, "0.01", "D")}, balances=[hold("1")])


@dataclass(frozen=True)
class HalfJoint(Slide):
    """A pin `at` a point of `link` in a slot of `along`."""

    letter = "RP"
    binds = 1
    passes = (LINE,)


def slotted(links: dict[str, str], pin: HalfJoint) -> Scene:
    """A crank with one link more, and a half joint."""
    found = mechanism(POINTS, links, [turn("1", 2, 1)], [pin], loads=LOADS)
    moving = tuple(p for p, names in found.links_of.items() if names and "frame" not in names)
    return replace(found, points={p: at for p, at in found.points.items() if found.links_of[p]},
                   find=Find(moving, moving, links=found.moving))


def pin(link: str, along: str, at: str, x: int, y: int) -> HalfJoint:
    """A half joint whose slot runs this way."""
    return HalfJoint(link, along, at, (Fraction(x), Fraction(y)))


SCENES = {
    "a crank's pin in a rocker": (slotted({"1": "O A", "2": "C D", "frame": "O C"}, pin("1", "2", "A", 3, 10)), "RPR"),
    "a rocker's pin in a crank": (slotted({"1": "O A", "2": "C B D", "frame": "O C"}, pin("2", "1", "B", 3, 4)), "RRP"),
    "a coupler over a fixed pin": (slotted({"1": "O A", "2": "A D", "frame": "O C"}, pin("frame", "2", "C", 5, -6)),
                                   "RPR"),
    "a coupler's pin in the frame": (slotted({"1": "O A", "2": "A B D", "frame": "O C"},
                                             pin("2", "frame", "B", 2, 1)), "RRP"),
}


@pytest.mark.parametrize("name", SCENES)
def test_construction_is_the_solver_to_the_last_digit(name: str) -> None:
    """Velocities, accelerations, reactions and the balance are drawn as the solver has them, in fractions."""
    found = report(SCENES[name][0], exact=True)
    assert {"velocity", "acceleration", "force"} <= {*found.check}
    assert not any(found.check.values())


@pytest.mark.parametrize("name", SCENES)
def test_a_half_joint_is_a_link_with_two_pairs(name: str) -> None:
    """With the link that it stands for, the other link is a dyad, of the form that its two lower pairs give it."""
    scene, form = SCENES[name]
    (dyad,) = structure(scene).groups
    assert (dyad.links, dyad.kind.split()[1]) == (("2",), form)


@pytest.mark.parametrize("name", SCENES)
def test_the_pin_passes_a_force_across_its_slot(name: str) -> None:
    """A half joint has no moment, and no force along its slot."""
    (joint,) = (scene := SCENES[name][0]).slides
    (x, y), moment = reactions(scene, exact=True).slides[joint.name]
    assert (x * joint.direction[0] + y * joint.direction[1], moment) == (0, 0)


@pytest.mark.parametrize("name", SCENES)
def test_the_pin_stays_in_its_slot_around_the_cycle(name: str) -> None:
    """As far as the crank goes, the pin lies on the slot's line, and moves there as the solver says at first."""
    scene = SCENES[name][0]
    (joint,) = scene.slides
    turned = gp.cycle.follow(scene, 5, (-0.5, 0.5))
    assert not turned.faults
    place = {p: complex(*map(float, at)) for p, at in scene.points.items()}
    slot = [p for p in scene.links[joint.along] if p != joint.at][:2]
    turn = np.ones(5) if joint.along == "frame" else (
        (turned.points[slot[1]] - turned.points[slot[0]]) / (place[slot[1]] - place[slot[0]]))
    along = complex(*map(float, joint.direction))
    base = turned.points[slot[0]]
    off = (turned.points[joint.at] - base) / turn - (place[joint.at] - place[slot[0]])
    assert np.abs((off / cmath.exp(1j * cmath.phase(along))).imag) == pytest.approx(0, abs=1e-9)
    speed = solve(scene).velocity["D"]
    step = turned.travel[3] - turned.travel[1]
    assert (turned.points["D"][3] - turned.points["D"][1]) / step * 2 == pytest.approx(complex(*speed), rel=1e-4)
