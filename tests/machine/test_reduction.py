"""Reduction to the first drive: printed examples, closed forms, tables with their breaks, and what is refused."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.reduction import check_lever, check_reduction
from graphplan.errors import Disagreement, Refused, SceneError
from graphplan.machine.reduced.reduction import Reduction, reduction
from graphplan.mechanism.model import Force, Loads, Mass, Moment, Scene
from graphplan.mechanism.scene import parse

YOKE = """
[units]
length = "m"
[points]
O = [0, 0]
A = [0.2, 0]
B = [0.2, 0]
[links]
1 = "O A"
2 = "A"
3 = "B"
frame = "O"
[[slides]]
link = "2"
along = "3"
at = "A"
direction = [0, 1]
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
[[drive]]
link = "1"
omega = {omega}
[masses.1]
mass = 0
inertia = 10
centre = "O"
[masses.3]
mass = 100
centre = "B"
[[forces]]
on = "3"
at = "B"
{load}
[balance]
link = "1"
"""
STROKES = ('direction = [1, 0]\nover = "3 along frame"\n'
           "values = [[-0.2, -1000], [0.2, -1000], [0.2, 1000], [-0.2, 1000]]")
PEAKS = ('direction = [1, 0]\nover = "3 along frame"\n'
         "values = [[-0.2, -1000], [0.1, -500], [0.2, -1000], [0.2, 1000], [-0.05, 2000], [-0.2, 1000]]")
SLIDER_CRANK = gp.load("ozols-5-1").text
MASSES = """
[masses.1]
mass = 0
inertia = {}
centre = "O"
[masses.2]
mass = {}
inertia = {}
centre = "C"
[masses.3]
mass = {}
centre = "B"
[balance]
link = "1"
"""
HOIST = """
[units]
length = "m"
[points]
A = [0, 0]
B = [1.9, 0]
D = [2.7, 0]
E = [2.9, -1]
P = [3.1, -3]
[links]
1 = "A"
2 = "B"
3 = "D"
4 = "P"
5 = "E"
6 = "P"
frame = "A B D"
[[gears]]
links = ["1", "2"]
centres = ["A", "B"]
teeth = [1, 37]
[[gears]]
links = ["2", "3"]
centres = ["B", "D"]
teeth = [12, 76]
[[gears]]
links = ["3", "5"]
centres = ["D"]
radius = 0.2
direction = [0, 1]
[[gears]]
links = ["4", "5"]
centres = ["P"]
radius = 0.2
direction = [0, -1]
[[gears]]
links = ["4", "frame"]
centres = ["P"]
radius = 0.2
direction = [0, 1]
[[slides]]
link = "5"
along = "frame"
at = "E"
direction = [0, 1]
[[slides]]
link = "6"
along = "frame"
at = "P"
direction = [0, 1]
[[drive]]
link = "1"
omega = 100
[masses.1]
mass = 0
inertia = 0.7
centre = "A"
[masses.2]
mass = 0
inertia = 1.8
centre = "B"
[masses.3]
mass = 0
inertia = 107
centre = "D"
[masses.4]
mass = 80
inertia = 2
centre = "P"
[masses.6]
mass = 44000
centre = "P"
[balance]
link = "1"
"""
GOVERNOR = """
[units]
length = "m"
[points]
O = [0, 0]
A = {{ from = "O", distance = 0.15, angle = {angle} }}
C = {{ from = "O", distance = 0.25, angle = {angle} }}
D = {{ distances = {{ A = 0.18 }}, on = {{ through = [0, 0], direction = [0, 1] }}, pick = "left" }}
[links]
1 = "O A C"
2 = "A D"
3 = "D"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "D"
direction = [0, 1]
[[drive]]
slide = ["3", "frame"]
speed = {speed}
[[forces]]
on = "1"
at = "C"
value = [{force}, 0]
[balance]
on = "3"
at = "D"
direction = [0, 1]
"""


def yoke(load: str, omega: str = "15") -> Scene:
    return parse(YOKE.format(load=load, omega=omega), "yoke")


def slider_crank(more: str) -> Reduction:
    return reduction(parse(SLIDER_CRANK + more, "slider-crank"))


@pytest.mark.parametrize("omega", ["15", "-15", "0"])
def test_closed_forms_of_the_scotch_yoke(omega: str) -> None:
    """Ozols 13-6: I = 10 + 4 sin^2 phi and a resisting moment of 200 |sin phi|, in either sense of the drive and from
    rest; the stroke changes at the dead point alone, and the loads jump there."""
    found = reduction(yoke(STROKES, omega))
    assert found.closed
    assert found.breaks == pytest.approx([math.pi], abs=1e-13)
    phi = np.linspace(0.0, 7.0, 57)
    told = found.reduce_at(phi)
    assert told.inertia == pytest.approx(10 + 4 * np.sin(phi) ** 2, rel=1e-14)
    assert told.slope == pytest.approx(4 * np.sin(2 * phi), abs=1e-13)
    assert told.moment == pytest.approx(-200 * np.abs(np.sin(phi)), abs=1e-11)
    assert max(check_reduction(found, phi).values()) < 1e-14
    assert max(check_lever(found, travel)[1] for travel in (0.0, 1.0, 4.0)) < 1e-14


def test_breaks_over_a_slide_are_where_it_passes_the_places() -> None:
    """Places of a table over a slide's position are travels to the last digits; loads go on from either side."""
    found = reduction(yoke(PEAKS))
    passed = math.acos(0.5), math.acos(-0.25)  # of 0.1 and -0.05 m, on the way there and back
    assert found.breaks == pytest.approx([*passed, math.pi, *(2 * math.pi - phi for phi in passed[::-1])], abs=1e-13)
    assert found.reduce_at(math.pi, -1).by["P_3"] == pytest.approx([0.0], abs=1e-10)
    for travel in found.breaks:
        sides = [found.reduce_at(np.array([travel]), side).moment[0] for side in (-1, 1)]
        near = [found.reduce_at(np.array([travel + side * 1e-7])).moment[0] for side in (-1, 1)]
        assert sides == pytest.approx(near, abs=1e-3)
    assert max(check_reduction(found, np.linspace(0.01, 6.2, 40)).values()) < 1e-13


def test_a_table_over_two_turns_makes_a_cycle_of_two() -> None:
    """A load over 720 degrees of travel, as in a four-stroke engine, is back after two turns, in the drive's sense."""
    found = reduction(yoke('direction = [1, 0]\nover = "travel"\nvalues = [[0, -1000], [360, 0], [720, -1000]]', "-3"))
    assert found.ends == pytest.approx((0, 4 * math.pi))
    assert found.breaks == pytest.approx([2 * math.pi])
    force = np.array([-1000 + 1000 / 360 * 90, -1000 / 360 * 90])
    assert found.reduce_at([math.pi / 2, 5 * math.pi / 2]).moment == pytest.approx(-0.2 * force)


def test_loads_over_speeds_come_apart() -> None:
    """A damper's force by a slide's speed is no part of the moment: arm and rate tell it for any speed of the drive."""
    found = reduction(yoke('direction = [1, 0]\nover = "speed of 3 along frame"\npowers = [0, -100]'))
    phi = np.array([0.4, 2.0, 5.0])
    reduced = found.reduce_at(phi)
    assert not reduced.moment.any()
    (damper,) = reduced.speed_loads
    assert damper.moment(7.0) == pytest.approx(-100 * 7.0 * (0.2 * np.sin(phi)) ** 2)
    assert damper.name == "P_3" == found.changing[0]


COEFFICIENTS = {"I_1": ((1, 0, 0, 0), 1.0), "m_2": ((0, 1, 0, 0), 0.02907), "I_C": ((0, 0, 1, 0), 0.1113),
                "m_3": ((0, 0, 0, 1), 0.02241)}


def test_reduced_inertia_of_a_slider_crank() -> None:
    """Ozols 13-2 with the dimensions of 5-1: I_r = I_1 + 0.02907 m_2 + 0.1113 I_C + 0.02241 m_3."""
    for name, (masses, value) in COEFFICIENTS.items():
        assert slider_crank(MASSES.format(*masses)).reduce_at(0).inertia == pytest.approx([value], rel=5e-4), name


def test_reduced_force_of_a_piston() -> None:
    """Ozols 13-3: the force at the crank pin is P v_B / v_A, 0.5988 P here; the moment is OA times as large."""
    found = slider_crank('[[forces]]\non = "3"\nat = "B"\nvalue = [-1000, 0]\n[balance]\nlink = "1"\n')
    assert found.reduce_at(0).moment == pytest.approx([0.25 * 598.8], rel=5e-4)


def test_reduced_inertia_of_a_hoist() -> None:
    """Ozols 13-1: two pairs of wheels, drum and movable pulley, which rolls between the two strands of its rope.

    The printed 0.7123 is of the ratio of other teeth than those that are given.
    """
    found = reduction(parse(HOIST, "hoist"), (0, 90))
    assert found.reduce_at(0).inertia == pytest.approx([0.7113], abs=5e-5)
    assert max(check_reduction(found, [0.0, 0.7, 1.4]).values()) < 1e-13


def test_reduced_weight_of_an_oscillating_cylinder() -> None:
    """Ozols 13-4 in numbers: 0.11314 kgf m against a clockwise drive, also by the projections of orthogonal velocities,
    and an inertia of 0.304355 kg m^2 beside the crank's own."""
    found = reduction(gp.load("ozols-10-1"))
    assert found.reduce_at(0).inertia == pytest.approx([0.304355], abs=1e-6)
    assert found.reduce_at(0).by["G_2"] == pytest.approx([-9.81 * 0.11314], rel=1e-4)
    phi = np.linspace(0, 6, 13)
    for name, moment in found.projections(phi).items():
        assert moment == pytest.approx(found.reduce_at(phi).by[name], abs=1e-12)


@pytest.mark.parametrize(("angle", "force"), [(0.5, 679.38), (0.8, 535.68)])
def test_half_of_a_governor(angle: float, force: float) -> None:
    """Ozols 15-5: the arms' centrifugal forces reduce to a force on the sleeve, which slides, as the lever says."""
    centrifugal = 2 * 2.29 * 25**2 * (0.02 + 0.25 * math.sin(angle))
    text = GOVERNOR.format(angle=math.degrees(angle) - 90, speed=1, force=centrifugal)
    found = reduction(parse(text, "governor"), (-0.01, 0.01))
    assert found.reduce_at(0).moment == pytest.approx([force], abs=0.01)
    resting = parse(text.replace("speed = 1", "speed = 0"), "governor")
    assert gp.construct(resting).balances == pytest.approx([-1j * force], abs=0.01)


def test_a_mass_reduces_to_a_sliding_drive() -> None:
    """The reduced mass of a piston that drives is the crank's reduced inertia by (v_B / omega)^2, and has its slope."""
    text = SLIDER_CRANK.replace('link  = "1"\nomega = 10', 'slide = ["3", "frame"]\nspeed = 10').replace(
        '[vary]\n"points.A', "[vary]\n#").split("[vary]")[0]
    masses = MASSES.format(2, 3, 4, 5)
    piston = reduction(parse(text + masses, "piston"), (-20, 20))
    crank = slider_crank(masses)
    speed = math.sqrt(slider_crank(MASSES.format(0, 0, 0, 1)).reduce_at(0).inertia[0])
    assert piston.reduce_at(0).inertia == pytest.approx(crank.reduce_at(0).inertia / speed**2)
    ends = piston.reduce_at([-1e-3, 1e-3]).inertia
    assert piston.reduce_at(0).slope == pytest.approx([(ends[1] - ends[0]) / 2e-6], rel=1e-5)
    assert max(check_reduction(piston, np.linspace(-20, 20, 9)).values()) < 1e-13


def loaded(name: str) -> Scene:
    """A packaged scene with a mass, a force and a moment on every link."""
    scene = gp.load(name)
    moving = [link for link in scene.moving if scene.links[link]]
    masses = {link: Mass(Fraction(2), Fraction(1, 10), scene.links[link][-1]) for link in moving}
    forces = tuple(Force(link, scene.links[link][0], (Fraction(10), Fraction(-7))) for link in moving)
    moments = tuple(Moment(link, Fraction(3)) for link in scene.moving)
    return replace(scene, loads=Loads((Fraction(0), Fraction(-981, 100)), masses, forces, moments, ()))


@pytest.mark.parametrize("name", ["biplanetary", "five-bar", "geared-five-bar", "geneva", "racks", "roller-cam",
                                  "slotted-link"])
def test_any_mechanism_reduces_as_the_solver_says(name: str) -> None:
    """Gears, racks, contacts, sliding pairs and drives in pace: inertia, slope and moment are the solver's all round,
    and so is the drawn lever."""
    found = reduction(loaded(name))
    travel = np.linspace(*found.ends, 11)[:-1] + 0.01
    assert max(check_reduction(found, travel).values()) < 1e-13
    assert check_lever(found, float(travel[3]))[1] < 1e-13


REFUSED = {
    "the scene has neither masses nor loads": (lambda: reduction(gp.load("four-bar")), Refused),
    "nothing drives it": (lambda: reduction(gp.load("four-bar").with_drives(())), Refused),
    "the mechanism stops at a limit position at 63.29784744 degrees": (
        lambda: reduction(gp.load("walschaerts-loaded")), Refused),
    "the mechanism stops at a limit position at": (lambda: reduction(gp.load("walschaerts-loaded"), (0, 90)), Refused),
    "the mass -1 is negative": (lambda: slider_crank(MASSES.format(0, -1, 0, 0)), SceneError),
    "no turn closes its travel": (lambda: reduction(parse(GOVERNOR.format(angle=-60, speed=1, force=1), "")), Refused),
}


@pytest.mark.parametrize("why", REFUSED)
def test_what_cannot_be_reduced_is_refused(why: str) -> None:
    """Nothing to reduce, no drive, no way round: the reason is said."""
    act, error = REFUSED[why]
    with pytest.raises(error, match=why):
        act()


def test_a_wrong_reduction_is_a_disagreement() -> None:
    """The second opinion says which number is wrong, and where."""
    found = reduction(yoke(STROKES))
    found.masses["3"] = found.loads.masses["1"]
    with pytest.raises(Disagreement, match=r"at a travel of 1.*reduced inertia"):
        check_reduction(found, [1.0])
