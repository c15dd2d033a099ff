"""Base circles: from the curve x(s) and the pressure angle, by the tangent of 45 degrees, and what tasks say wrong."""

from __future__ import annotations

from fractions import Fraction

import pytest

from graphplan.cams.base import excess, pair_with_base, region, smallest_radius, steepest_pressure
from graphplan.cams.task import Limits, Task, parse
from graphplan.errors import Refused, SceneError

STAGES = ((120, 1), (60, 0), (90, -1), (90, 0))
ROLLER = 'moves = "translating"\ncontact = "roller"\nradius = 4\n'
ARM = 'moves = "oscillating"\ncontact = "roller"\nradius = 4\narm = 80\ncentre_distance = 100\n'
BOTH = 'base = "pressure angle"\npressure_angle = { rise = 30, return = 30 }\n'
SPRING = 'base = "pressure angle"\npressure_angle = { rise = 30 }\n'


def text(follower: str = ROLLER, cam: str = "base = 40\n", motion: str = "harmonic", stroke: float = 25,
         turns: str = "clockwise") -> str:
    """A task with a rise over 120 and a return over 90 degrees."""
    law = "".join(f'[[law]]\nangle = {angle}\nmotion = "{motion if way else "dwell"}"\n'
                  + (f"stroke = {way * stroke}\n" if way else "") for angle, way in STAGES)
    return f'title = "A cam"\n{law}[follower]\n{follower}[cam]\nturns = "{turns}"\nrpm = 300\n{cam}'


def task(*said: str, **more: float) -> Task:
    return parse(text(*said, **more), "cam.toml")  # type: ignore[arg-type]


@pytest.mark.parametrize(("offset", "cam", "radius"), [
    ("0", SPRING, 22.2985), ("0", BOTH, 32.5694), ("6", SPRING, 13.3326), ('"smallest"', BOTH, 27.5937)])
def test_centres_of_the_textbook(offset: str, cam: str, radius: float) -> None:
    """Harmonic rise and return with 30 degrees: O1, O2, O3 and Om of Ozols' figure 20-6."""
    for turns in ("clockwise", "counter-clockwise"):
        given = parse(text(f"{ROLLER}offset = {offset}\n", cam, turns=turns), "cam.toml")
        pair = pair_with_base(given)
        assert pair.base == pytest.approx(radius, abs=5e-5)
        assert given.cam.limits
        assert abs(excess(given.law, pair, given.cam.limits)) < 1e-9


def test_smallest_of_two_tangents() -> None:
    """The two tangents of figure 20-6 meet in (-2.9649, -27.4340), where both pressure angles are used up."""
    given = task(f'{ROLLER}offset = "smallest"\n', BOTH)
    offset, depth = region(given.law, Limits(Fraction(30), Fraction(30))).corner
    assert (offset, -depth) == pytest.approx((-2.9649, -27.4340), abs=5e-5)
    pair = pair_with_base(given)
    assert [steepest_pressure(given.law, pair, way)[1] for way in (1, -1)] == pytest.approx([30.0, 30.0], abs=1e-9)


@pytest.mark.parametrize("turns", ["clockwise", "counter-clockwise"])
def test_arm_uses_up_its_angle(turns: str) -> None:
    """The base circle of an oscillating follower is the least that keeps its pressure angles."""
    given = parse(text(ARM, 'base = "pressure angle"\npressure_angle = { rise = 35, return = 35 }\n', stroke=20,
                       turns=turns), "cam.toml")
    pair = pair_with_base(given)
    assert excess(given.law, pair, Limits(Fraction(35), Fraction(35))) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("follower", ['moves = "translating"\ncontact = "flat"\n',
                                      'moves = "oscillating"\ncontact = "flat"\ncentre_distance = 100\noffset = 3\n'])
def test_flat_faces_keep_the_profile_convex(follower: str) -> None:
    """The tangent of 45 degrees gives the base circle of which the smallest radius of curvature is that asked for."""
    for motion in ("sine", "harmonic", "parabolic"):
        given = task(follower, 'base = "convex"\nleast_radius = 5\n', motion, 20)
        assert smallest_radius(given.law, pair_with_base(given))[1] == pytest.approx(5.0, abs=1e-9)


def test_faults_come_all_at_once() -> None:
    """What is wrong with a task is told line by line, each with its place and what would be right."""
    wrong = text().replace("angle = 60", "angle = 50").replace("stroke = -25", "stroke = -24")
    with pytest.raises(SceneError) as fault:
        parse(wrong, "cam.toml")
    assert list(fault.value.lines) == [
        "cam.toml: law: its stages take 350 degrees; stages of 360 degrees together",
        "cam.toml: law: after one turn the lift is 1; strokes that add up to 0"]


FAULTS = [
    (('motion = "dwell"', 'motion = "swell"'), 'law.2.motion: the string "swell" is not known here; perhaps dwell'),
    (("base = 40", 'base = "convex"'), "cam.base: only a flat face needs a convex profile"),
    (("base = 40", "base = 3"), "follower.radius: 4 is no less than the radius of the base circle"),
    (("radius = 4", "radius = 4\narm = 8"), "follower.arm: it does not apply to a follower that is translating"),
    (("radius = 4\n", ""), "follower: radius is missing"),
    (("rpm = 300\n", ""), "cam: omega is missing; one of them, such as rpm = 300"),
    (("base = 40", 'base = "pressure angle"'), "cam: pressure_angle is missing"),
    (("angle = 120", "table = [[0, 0], [60, 10], [50, 25]]"), "law.1.table: the angle 50 comes after 60"),
    (("stroke = 25\n", ""), "law.1: a harmonic motion without a stroke"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "line"), FAULTS, ids=[line.split(":")[0] for _, line in FAULTS])
def test_each_fault_has_its_place(change: tuple[str, str], line: str) -> None:
    """A fault of a task says where it is, what is wrong, and what would be right."""
    with pytest.raises(SceneError) as fault:
        parse(text().replace(*change), "cam.toml")
    assert any(found.startswith(f"cam.toml: {line}") for found in fault.value.lines), fault.value.lines


def test_a_profile_that_is_always_convex_has_no_smallest_base_circle() -> None:
    """A lift so gentle that no base circle makes the profile hollow needs a least radius."""
    law = '[[law]]\ntable = [[0, 0], [90, 0.5], [180, 1], [270, 0.5], [360, 0]]\n'
    flat = f'{law}[follower]\nmoves = "translating"\ncontact = "flat"\n[cam]\nrpm = 60\nbase = "convex"\n'
    with pytest.raises(Refused, match="convex on any base circle"):
        pair_with_base(parse(flat, "cam.toml"))
    assert pair_with_base(parse(f"{flat}least_radius = 8\n", "cam.toml")).base == pytest.approx(8)


def test_what_no_base_circle_can_do_is_refused() -> None:
    """An arm that is lifted too fast has no base circle within the angles, and says so."""
    with pytest.raises(Refused, match="no base circle keeps the pressure angle at a centre distance of 100"):
        pair_with_base(task(ARM, 'base = "pressure angle"\npressure_angle = { rise = 5, return = 5 }\n', "sine", 60))


def test_sheets_of_tasks_have_no_keys_of_scenes() -> None:
    """What only the sheet of a scene has is no key of a task."""
    with pytest.raises(SceneError, match=r"sheet\.curves: unknown key"):
        parse(text() + '[sheet]\npaper = "A2"\ncurves = "all"\n', "cam.toml")
