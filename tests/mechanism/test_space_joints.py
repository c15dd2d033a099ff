"""Joints in space drawn in the plane: Cardan joints, single and double, and swash plates, against their formulas."""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.cycle import cycle, quantities
from graphplan.check.trusted import report
from graphplan.commands.new import template
from graphplan.errors import SceneError
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.methods.positions import layout

DRIVE = """[[drive]]
link = "1"
omega = {omega}
alpha = {alpha}
"""
CARDAN = """
[points]
O = [3, -2]
A = [{x}, {y}]
[links]
1 = "O"
2 = "O"
frame = "O"
[[joints]]
links = ["1", "2"]
cross = "3"
centre = "O"
arm = "A"
angle = {angle}
trace = {trace}
""" + DRIVE
PLATE = """
[points]
O = [0, 0]
E = [{x}, {y}]
B = [200, 7]
[links]
1 = "O"
2 = "B"
frame = "O"
[[joints]]
links = ["1", "2"]
block = "3"
centre = "O"
arm = "E"
angle = {angle}
radius = 60
[[slides]]
link = "2"
along = "frame"
at = "B"
direction = [1, 0]
""" + DRIVE
FORK = """
[points]
O = [3, 2]
Q = [{qx}, {qy}]
E = [{x}, {y}]
[links]
1 = "O"
2 = "Q"
frame = "O Q"
[[joints]]
links = ["1", "2"]
block = "3"
centre = "O"
arm = "E"
angle = {angle}
pivot = "Q"
""" + DRIVE
DOUBLE = """
[points]
O = [3, -2]
A = [51, 26]
C = [27, 12]
[links]
1 = "O"
2 = "O"
4 = "O"
frame = "O"
[[joints]]
links = ["1", "2"]
cross = "3"
centre = "O"
arm = "A"
angle = { cosine = 0.6 }
[[joints]]
links = ["4", "2"]
cross = "5"
centre = "O"
arm = "C"
angle = { cosine = 0.6 }
[[drive]]
link = "1"
omega = 10
alpha = 3
"""


def cardan(**changed: Any) -> Scene:
    """A Cardan joint."""
    return parse(CARDAN.format(**({"x": 51, "y": 26, "angle": "{ cosine = 0.8 }", "trace": [1, 0], "omega": 10,
                                   "alpha": 0} | changed)), "cardan")


@pytest.mark.parametrize("seed", range(12))
def test_the_driven_shaft_turns_as_the_formulas_say(seed: int) -> None:
    """Ozols (7.11) and its derivative, as fractions, of random joints: construction, solver and formulas are equal."""
    chance = Random(seed)
    u, v, t, s = (Fraction(chance.randrange(10, 60) * chance.choice((1, -1))) for _ in range(4))
    c, w, e = Fraction(chance.randrange(3, 10), 10), chance.randrange(1, 9), chance.randrange(-9, 9)
    scene = cardan(x=3 + u, y=-2 + v, angle=f"{{ cosine = {float(c)} }}", trace=[int(t), int(s)], omega=w, alpha=e)
    found = report(scene, exact=True)
    assert set(found.check.values()) == {0}
    square = (u * u + v * v) * (t * t + s * s)
    cos2, sin2 = (u * t + v * s) ** 2 / square, (v * t - u * s) ** 2 / square
    product = (u * t + v * s) * (v * t - u * s) / square
    below = c * c * cos2 + sin2  # tan phi_2 = tan phi_1 / c
    omega, alpha = c * w / below, c * e / below - c * w * w * 2 * product * (1 - c * c) / below**2
    assert (found.results["omega"]["2"], found.results["alpha"]["2"]) == (omega, alpha)


@pytest.mark.parametrize(("degrees", "printed"), [(5, 0.0076), (10, 0.0306), (15, 0.0693), (20, 0.1245), (30, 0.2887)])
def test_unevenness_by_the_table(degrees: int, printed: float) -> None:
    """Ozols (7.13): (omega_max - omega_min) / omega_1 of the driven shaft, from the speeds in its two extreme poses."""
    fast, slow = (float(report(cardan(x=3 + x, y=-2 + y, angle=degrees)).results["omega"]["2"])
                  for x, y in ((50, 0), (0, 50)))
    assert (fast - slow) / 10 == pytest.approx(printed, abs=1e-4)


def test_its_arms_stay_square_in_space() -> None:
    """All around, the arm OA, raised back into its plane, keeps its length and is square to the other fork's arm."""
    scene, poses = cardan(), gp.follow(cardan(), 48)
    A, M = (poses.points[name] - complex(3, -2) for name in ("A", "M3"))
    phi = np.angle(M)
    raised = np.stack([A.real, A.imag, np.sin(phi) * math.sin(math.acos(0.8)) * abs(M) / 0.9])
    assert np.linalg.norm(raised, axis=0) == pytest.approx(abs(M[0]) / 0.9)
    turned = np.radians(poses.travel) + math.atan2(28, 48)
    arm = np.stack([-np.sin(turned), np.cos(turned), 0 * turned])
    assert (raised * arm).sum(axis=0) == pytest.approx(0, abs=1e-9 * float(scene.extent))
    assert np.ptp(np.unwrap(phi)) > 6


def test_a_double_joint_runs_evenly() -> None:
    """Ozols (7.14): with equal angles and forks in one plane the third shaft turns as the first, exactly."""
    results = report(parse(DOUBLE, "double"), exact=True).results
    assert (results["omega"]["4"], results["alpha"]["4"]) == (10, 3)
    assert results["omega"]["2"] != 10


def test_the_diagrams_of_a_double_joint_are_of_its_middle_shaft() -> None:
    """A shaft that shows no side, as that along which a joint is seen, has no angle to plot."""
    scene = parse(DOUBLE.replace("alpha = 3", "alpha = 0"), "double")
    assert [quantity.name for quantity in quantities(scene, ())] == ["2"]


@pytest.mark.parametrize("seed", range(6))
def test_a_swash_plate_moves_its_piston(seed: int) -> None:
    """s = R tan alpha cos phi, and its derivatives, as fractions."""
    chance = Random(seed)
    x, y = chance.choice([(30, 40), (-40, 30), (5, -12), (-8, -15), (0, 7)])
    k, w, e = Fraction(chance.randrange(1, 20), 10), chance.randrange(1, 9), chance.randrange(-9, 9)
    scene = parse(PLATE.format(x=x, y=y, angle=f"{{ tangent = {float(k)} }}", omega=w, alpha=e), "plate")
    found = report(scene, exact=True)
    long = math.isqrt(x * x + y * y)
    cosine, sine = Fraction(x, long), Fraction(y, long)
    assert found.results["velocity"]["B"] == (-60 * k * sine * w, 0)
    assert found.results["acceleration"]["B"] == (-60 * k * (cosine * w * w + sine * e), 0)


@pytest.mark.parametrize("seed", range(8))
def test_a_swinging_fork_swings_as_the_formulas_say(seed: int) -> None:
    """Ozols (8.23) to (8.25): tan theta = tan alpha cos phi and its derivatives, as fractions, with any pivot."""
    chance = Random(seed)
    (x, y), (u, v) = (chance.choice([(30, 40), (-40, 30), (5, -12), (-8, -15), (20, 21)]) for _ in range(2))
    k, w, e = Fraction(chance.randrange(1, 20), 10), chance.randrange(1, 9), chance.randrange(-9, 9)
    scene = parse(FORK.format(x=3 + x, y=2 + y, qx=3 + 4 * u, qy=2 + 4 * v, angle=f"{{ tangent = {float(k)} }}",
                              omega=w, alpha=e), "fork")
    found = report(scene, exact=True)
    assert set(found.check.values()) == {0}
    long, far = math.isqrt(x * x + y * y), math.isqrt(u * u + v * v)
    ahead = Fraction(v * x - u * y, long * far)  # cos phi, from where the fork leans most
    aside = Fraction(u * x + v * y, long * far)
    below = 1 + k * k * ahead**2
    theta1, theta2 = -k * aside / below, -k * ahead / below + 2 * k**3 * ahead * aside**2 * -1 / below**2
    assert abs(found.results["omega"]["2"]) == abs(theta1 * w)
    assert abs(found.results["alpha"]["2"]) == abs(theta2 * w * w + theta1 * e)


def test_fork_of_ozols_has_six_extrema_of_acceleration() -> None:
    """(8.25) has two extrema of acceleration a turn to 24 degrees 6 minutes, six beyond."""
    def extrema(degrees: float) -> int:
        scene = parse(FORK.format(x=53, y=2, qx=3, qy=-78, angle=degrees, omega=1, alpha=0), "fork")
        alpha = np.asarray(cycle(scene, 720).results["alpha"]["2"])
        return int(np.count_nonzero(np.diff(np.sign(np.diff(np.append(alpha, alpha[:2]))))))

    assert (extrema(20), extrema(30)) == (2, 6)


def test_the_flywheel_takes_the_joint() -> None:
    """Reduced inertia I (omega_2/omega_1)^2 and reduced moment M omega_2/omega_1 at every plan, by (7.11)."""
    text = CARDAN.format(x=51, y=26, angle="{ cosine = 0.8 }", trace=[1, 0], omega=10, alpha=0)
    text += '[masses.2]\nmass = 5\ninertia = 0.3\ncentre = "O"\n[[moments]]\non = "2"\nvalue = -40\n'
    data = gp.flywheel(parse(text + "[flywheel]\nspeed = 10\nunevenness = 0.02\n", "pump")).json()
    for (travel, inertia), (_, moment) in zip(data["reduced_inertia"], data["reduced_moment"], strict=True):
        phi = math.radians(travel) + math.atan2(28, 48)
        ratio = 0.8 / (0.64 * math.cos(phi) ** 2 + math.sin(phi) ** 2)
        assert inertia == pytest.approx(0.3 * ratio**2)
        assert moment == pytest.approx(-40 * ratio)


def test_the_template_has_all() -> None:
    """Its shaft 2 turns by (7.11), its piston goes by R tan alpha cos phi and its fork swings by (8.24), as fractions.
    """
    results = report(parse(template("joints"), "joints"), exact=True).results
    ratio = Fraction(4, 5) * (48**2 + 28**2) / (Fraction(16, 25) * 48**2 + 28**2)
    assert results["omega"]["2"] == 2 * ratio
    assert results["velocity"]["B"] == (-24 * 2 * ratio, 0)
    assert abs(results["omega"]["6"]) == Fraction(42, 58) / (1 + Fraction(20, 58) ** 2)


def test_the_template_says_of_each_key_what_it_is_of_that_joint() -> None:
    """The keys that all joints have are not told of one in the words of another."""
    cardan_joint, plate, fork = template("joints").split("[[joints]]")[1:]
    assert "the other fork's arm" in cardan_joint
    assert "the plate leans to" not in cardan_joint
    assert "the plate leans to" in plate
    assert "bearing leans to" in fork


LEANING = PLATE.format(x=30, y=40, angle="{ tangent = 0.5 }", omega=1, alpha=0)


SWINGING = FORK.format(x=43, y=11, qx=3, qy=-78, angle="{ tangent = 0.5 }", omega=1, alpha=0)


@pytest.mark.parametrize("scene", [cardan(), parse(LEANING, "plate"), parse(SWINGING, "fork")],
                         ids=["cardan", "plate", "fork"])
def test_the_plan_is_laid_out_by_turning_down(scene: Scene) -> None:
    """Drawn from what is written, the points that the joint adds are where the scene has them, as fractions."""
    program, values = layout(scene), dict[int, Any]()
    for step in program.steps:
        values[step.index] = step.op.rule(Fractions(), *(values[arg] for arg in step.args), **step.params)
    places = {step.name: values[step.index] for step in program.steps if step.name}
    assert {name: places[name] for name in scene.points} == scene.points


@pytest.mark.parametrize(("text", "fault"), [
    (CARDAN.format(x=51, y=26, angle=90, trace=[1, 0], omega=1, alpha=0),
     "joints.1.angle: no angle of a joint; more than 0 and less than 90 degrees"),
    (CARDAN.format(x=51, y=26, angle="{ cosine = 1 }", trace=[1, 0], omega=1, alpha=0),
     "joints.1.angle.cosine: no angle of a joint; more than 0 and less than 90 degrees"),
    (CARDAN.format(x=3, y=-2, angle=30, trace=[1, 0], omega=1, alpha=0),
     "joints.1.arm: the arm ends in the centre; a point apart from the centre"),
    (CARDAN.format(x=51, y=26, angle=30, trace=[1, 0], omega=1, alpha=0).replace('cross = "3"', 'cross = "2"'),
     "joints.1: there is a link 2 already; a name that no link has"),
    (CARDAN.format(x=51, y=26, angle=30, trace=[1, 0], omega=1, alpha=0).replace('frame = "O"\n', ""),
     "joints.1.centre: O is not a point of link frame; where the shafts are pivoted on the frame"),
    (CARDAN.format(x=51, y=26, angle=30, trace=[1, 0], omega=1, alpha=0).replace('1 = "O"', '1 = "O A"'),
     "joints.1.arm: a link has the point A already; a point that no link in [links] has"),
    (CARDAN.format(x=51, y=26, angle=30, trace=[1, 0], omega=1, alpha=0).replace('"1", "2"', '"1", "frame"'),
     "joints.1.links: they are not two moving links; a shaft, and what it moves"),
    (CARDAN.format(x=51, y=26, angle=30, trace=[1, 0], omega=1, alpha=0).replace('cross = "3"', 'cross = "a b"'),
     "joints.1.cross: a link's name is empty or has blanks or commas; a name without them, such as 3"),
    (CARDAN.format(x=51, y=26, angle=30, trace='"O A"', omega=1, alpha=0),
     "joints.1.trace: its points are not all on the frame; a direction that stands, such as [1, 0]"),
    (LEANING.replace("0.5", "0"),
     "joints.1.angle.tangent: no angle of a joint; more than 0 and less than 90 degrees"),
    (SWINGING.replace('pivot = "Q"', 'pivot = "O"'),
     "joints.1.pivot: O is not a point of link 2; where the fork is pivoted on the frame"),
    (SWINGING.replace("Q = [3, -78]", "Q = [3, 2]"),
     "joints.1.pivot: it is the centre; a point apart from the centre, to the side of the yoke"),
    (DOUBLE.replace('cross = "5"', 'cross = "3"'),
     "joints.2: there is a link 3 already; a name that no link has"),
])
def test_faults_of_joints_are_told(text: str, fault: str) -> None:
    """What is wrong, where, and what would be right, in one line and no other."""
    with pytest.raises(SceneError) as error:
        parse(text, "f.toml")
    assert error.value.lines == (f"f.toml: {fault}",)
