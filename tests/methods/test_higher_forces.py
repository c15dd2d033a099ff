"""Forces in gears and contacts against the textbook's formulas: tooth forces, planets, cams, racks, friction."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import pytest
from higher import two_wheels

from graphplan.check.cycle import cycle
from graphplan.check.trusted import report
from graphplan.errors import SceneError
from graphplan.mechanism.scene import parse
from graphplan.methods.construct import construct
from graphplan.solver import power

DRIVE = "[[drive]]\nlink = '1'\nomega = {}\n[balance]\nlink = '1'\n"
SPUR = two_wheels("radii = [40, 60]\npressure_angle = {}", "{}")
PLANET = """[points]
O = [0, 0]
A = [36, 48]
[links]
1 = "O"
2 = "A"
H = "O A"
frame = "O"
[[gears]]
links = ["1", "2"]
centres = ["O", "A"]
radii = [35, 25]
[[gears]]
links = ["2", "frame"]
centres = ["A", "O"]
radii = [25, 85]
internal = true
[masses.2]
mass = 2
centre = "A"
[[moments]]
on = "H"
value = -24
""" + DRIVE.format(20)
CAM = """[points]
O = [0, 0]
C = [18, 24]
A = [-9, 60]
K = [-3, 52]
[links]
1 = "O C"
2 = "A"
frame = "O"
[[contacts]]
links = ["1", "2"]
at = "K"
centres = ["C", "A"]
[[slides]]
link = "2"
along = "frame"
at = "A"
direction = [0, 1]
[[forces]]
on = "2"
at = "A"
value = [0, {}]
""" + DRIVE.format(10)
RACK = """[points]
O = [0, 0]
S = [20, -30]
T = [60, -40]
[links]
1 = "O"
2 = "S T"
frame = "O"
[[gears]]
links = ["1", "2"]
centres = ["O"]
radius = 25
direction = [1, 0]
pressure_angle = { tangent = 0.36 }
[[slides]]
link = "2"
along = "frame"
at = "S"
direction = [1, 0]
[[forces]]
on = "2"
at = "T"
value = [-100, 30]
""" + DRIVE.format(10)


def solved(text: str) -> dict[str, dict[str, Any]]:
    """What is drawn, which the solver has said, too."""
    found = report(parse(text, "forces"))
    assert found.agrees
    return found.results


@pytest.mark.parametrize("moment", [12, -12])
def test_each_wheel_pushes_its_mate_away(moment: int) -> None:
    """F_t = M/r square to the line of centres, and F_t tan(alpha) from the mate, whichever wheel drives."""
    force = solved(SPUR.format(20, moment))["gear reaction"]["1 2"]
    along, apart = (force[0] * x + force[1] * y for x, y in ((-0.8, 0.6), (-0.6, -0.8)))
    assert along == pytest.approx(-math.copysign(200, moment), rel=1e-12)
    assert apart == pytest.approx(200 * math.tan(math.radians(20)), rel=1e-12)


def test_friction_wheels_and_written_tangents_are_exact() -> None:
    """Without a pressure angle, or with its tangent as written, forces are fractions."""
    scene = parse(SPUR.format("{ tangent = 0.25 }", 12), "exact")
    assert report(scene, exact=True).results["gear reaction"]["1 2"] == (130, -160)
    assert report(parse(SPUR.format(0, 12), "wheels"), exact=True).results["gear reaction"]["1 2"] == (160, -120)
    assert power(scene, exact=True) == (8,)
    assert parse(SPUR.format(20, 12), "degrees").irrational == ("gears.1.pressure_angle: pressure angle",)


def test_the_polygon_of_a_planet() -> None:
    """R_12 = M_1/(r_1 cos alpha), R_H2 = (J^2 + (2 R cos alpha)^2)^1/2, M_H = 2 R cos alpha OA (Ozols 11-2)."""
    found = solved(PLANET)
    one, two = found["gear reaction"]["1 2"], found["gear reaction"]["2 frame"]
    moment, cosine = found["balance moment"]["1"], math.cos(math.radians(20))
    assert math.hypot(*one) == pytest.approx(abs(moment) / (0.035 * cosine), rel=1e-12)
    assert math.hypot(*two) == pytest.approx(math.hypot(*one), rel=1e-12)
    inertia, across = 2 * 0.06 * found["omega"]["H"] ** 2, 2 * math.hypot(*one) * cosine
    carried = found["reaction"].get("H at A") or found["reaction"]["2 at A"]
    assert math.hypot(*carried) == pytest.approx(math.hypot(inertia, across), rel=1e-12)
    assert across * 0.06 == pytest.approx(24, rel=1e-12)


def test_the_triangle_of_a_cam() -> None:
    """The force on the follower is along the normal, the guide bears its part across, and M_1 omega = P v (11-1)."""
    found = solved(CAM.format(-100))
    (x, y), guide = found["contact reaction"]["1 2"], found["slide reaction"]["2 along frame"]
    assert (x, y) == pytest.approx((75, -100), rel=1e-12)
    assert guide == pytest.approx((75, 0), abs=1e-12)
    assert found["balance moment"]["1"] * 10 == pytest.approx(100 * found["velocity"]["A"][1] / 1000, rel=1e-12)


def test_a_contact_that_pulls_is_told() -> None:
    """A contact can only push: where the load would part the links, a note says so."""
    notes = {sign: [str(note) for note in construct(parse(CAM.format(100 * sign), "cam")).notes] for sign in (1, -1)}
    assert any("can only push" in note for note in notes[1])
    assert not any("can only push" in note for note in notes[-1])


def test_friction_of_a_contact_is_against_its_sliding() -> None:
    """The force on the follower leans by the friction angle; the balance, and the efficiency, follow by hand."""
    text = CAM.format(-100) + '[[friction]]\ncontact = ["2", "1"]\ncoefficient = 0.1\n'
    found = report(parse(text, "rubbing"), exact=True)
    normal = Fraction(100) / (Fraction(8, 10) - Fraction(6, 100))
    moment = normal * (Fraction(52) * Fraction(68, 100) - 3 * Fraction(74, 100)) / 1000
    assert found.results["balance moment with friction"]["1"] == moment
    assert found.forces is not None
    assert found.forces.efficiency == Fraction(36, 10) / moment


def test_a_rack_leaves_its_guide_force_and_moment() -> None:
    """The guide of a rack bears what the teeth push, at the pitch point."""
    found = report(parse(RACK, "rack"), exact=True).results
    assert found["gear reaction"]["1 2"] == (-100, 36)
    assert found["slide reaction"]["2 along frame"] == (0, 6)
    load, tooth = 40 * 30 - 10 * 100, 20 * 36 - 5 * 100
    assert found["slide moment"]["2 along frame"] == Fraction(-load - tooth, 1000)


def test_levers_leave_out_what_teeth_push() -> None:
    """Reactions with radial components are those of force plans alone, which a note says."""
    scene = parse(SPUR.format(20, 12) + '[find]\nlinks = ["2"]\nreactions = ["O"]\n', "lever")
    drawing = construct(scene, plan="lever")
    assert not drawing.reactions
    assert any("radial components" in str(note) for note in drawing.notes)


FAULTS = [
    (SPUR.format(90, 1), "gears.1.pressure_angle: the pressure angle 90; an angle from 0 to less than 90 degrees"),
    (CAM.format(1) + '[[friction]]\ncontact = ["2", "frame"]\ncoefficient = 0.1\n',
     'friction.1.contact: no contact of links 2 and frame; contact = ["1", "2"]'),
    (CAM.format(1).replace('centres = ["C"', 'rolling = true\ncentres = ["C"').replace('2 = "A"', '2 = "A"\n3 = "A"')
     .replace('links = ["1", "2"]', 'links = ["1", "3"]') + '[[friction]]\ncontact = ["1", "3"]\ncoefficient = 1\n',
     "friction.1.contact: the contact 1 3 rolls: nothing slides in it; rolling = 0.5, the arm of the resistance"),
    (CAM.format(1) + '[find]\nreactions = ["1 3"]\n',
     "find.reactions: there is no joint, slide, gear or contact 1 3; perhaps 1 2"),
]


@pytest.mark.parametrize(("text", "fault"), FAULTS)
def test_faults(text: str, fault: str) -> None:
    """What gears and contacts cannot bear is refused by its place."""
    with pytest.raises(SceneError) as error:
        parse(text, "bad")
    assert fault in [f"{found.where}: {found.what}; {found.instead}" for found in error.value.faults]


@pytest.mark.parametrize("text", [SPUR.format(20, 12), PLANET, CAM.format(-100), RACK])
def test_forces_go_around_the_cycle(text: str) -> None:
    """In other poses, too, what is drawn is what the solver says of them."""
    found = cycle(parse(text, "round"), 4)
    assert not found.faults
    assert not found.wrong
    assert found.check["force"] < 1e-12
