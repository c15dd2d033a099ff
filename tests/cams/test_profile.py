"""Profiles: the envelope, its curvature, what forbids it, its arcs, the drawn inversion, and the cam as a scene."""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest
from test_base import ARM, BOTH, ROLLER, text

from graphplan.cams.base import pair_with_base
from graphplan.cams.construction import draw_cam
from graphplan.cams.exports import scene_text
from graphplan.cams.profile import Cam, make_cam
from graphplan.cams.task import parse
from graphplan.check.cams import check_cam
from graphplan.errors import SceneError
from graphplan.kernel.tolerances import FORM_TOL
from graphplan.mechanism.scene import parse as scene_of

FLAT = 'moves = "translating"\ncontact = "flat"\n'
FACE = 'moves = "oscillating"\ncontact = "flat"\ncentre_distance = 100\noffset = 3\n'
POINT = 'moves = "translating"\ncontact = "point"\n'
CONVEX = 'base = "convex"\nleast_radius = 5\n'
CAMS = {
    "roller": (ROLLER, "base = 40\n", "sine", 25), "offset": (f"{ROLLER}offset = 6\n", BOTH, "harmonic", 25),
    "other side": (f"{ROLLER}offset = -6\n", "base = 40\n", "trapezoid", 25), "flat": (FLAT, CONVEX, "3-4-5", 25),
    "arm": (ARM, "base = 45\n", "sine", 20), "face": (FACE, CONVEX, "parabolic", 12),
    "point": (POINT, "base = 30\n", "uniform", 25),
}  # fmt: skip
SENSES = "clockwise", "counter-clockwise"
EVERYWHERE = [(name, turns) for name in CAMS for turns in SENSES]


@cache
def cam(name: str, turns: str) -> Cam:
    """One of the cams."""
    return make_cam(parse(text(*CAMS[name], turns=turns), "cam.toml"))


@pytest.mark.parametrize(("name", "turns"), EVERYWHERE)
def test_second_opinions_agree(name: str, turns: str) -> None:
    """The drawn inversion, the contact formula, curvature and law by numbers, and the solver agree."""
    found = check_cam(draw_cam(cam(name, turns)))
    assert max(found["points"], found["motion"]) < 1e-12
    assert max(found["curvature"], found["law"]) < 1e-6


@pytest.mark.parametrize(("name", "turns"), EVERYWHERE)
def test_the_follower_nowhere_enters_the_cam(name: str, turns: str) -> None:
    """The roller touches the profile and never cuts it; the flat face never does either."""
    made, angles = cam(name, turns), np.arange(0.5, 360, 3.0)
    touch, outline = made.contact(angles), made.outline
    for k, angle in enumerate(angles):
        own = outline * np.exp(1j * made.pair.sense * np.radians(angle))
        if made.task.follower.flat:
            gap = ((touch.point[k] - own) * touch.normal[k].conjugate()).real.min()
        else:
            gap = abs(own - touch.roller[k]).min() - made.roller
        assert -1e-3 < gap < 2e-2


def away(spots: np.ndarray, start: complex, end: complex, bulge: float) -> np.ndarray:
    """How far spots lie from an arc."""
    half = (end - start) / 2
    own = (spots - start) / half - 1
    if bulge == 0:
        on = abs(own.real) <= 1
        return np.where(on, abs(own.imag), np.minimum(abs(own - 1), abs(own + 1))) * abs(half)
    centre = 1j * (1 - bulge**2) / (2 * bulge)
    turned = np.angle((own - centre) / (-1j * bulge - centre))
    on = abs(turned) <= abs(2 * np.arctan(bulge))
    return np.where(on, abs(abs(own - centre) - abs(1 - centre)), np.minimum(abs(own - 1), abs(own + 1))) * abs(half)


@pytest.mark.parametrize(("name", "turns"), EVERYWHERE)
def test_arcs_keep_their_tolerance(name: str, turns: str) -> None:
    """No point of the profile is further from the arcs than is asked, and none are left out: a corner has its arc."""
    made = cam(name, turns)
    for tolerance in (0.1, 0.001):
        arcs = made.arcs(tolerance)
        gaps = [away(made.outline, arc.start, after.start, arc.bulge)
                for arc, after in zip(arcs, (*arcs[1:], arcs[0]), strict=True)]
        assert np.min(gaps, axis=0).max() < 1.01 * tolerance
    assert len(made.arcs(0.1)) < len(made.arcs(0.001)) < 100


def test_a_roller_in_a_corner_leaves_its_arc() -> None:
    """Where the velocity jumps up the roller rests in a corner of its own radius; where it drops none can follow."""
    law = '[[law]]\nangle = 90\nmotion = "uniform"\nstroke = 6\n[[law]]\nangle = 270\nmotion = "sine"\nstroke = -6\n'
    given = parse(f"{law}[follower]\n{ROLLER}[cam]\nrpm = 60\nbase = 40\n", "cam.toml")
    hollow = [arc for arc in Cam(given, pair_with_base(given)).arcs(0.01) if arc.bulge * given.cam.sense > 0]
    assert len(hollow) == 1
    with pytest.raises(SceneError, match="at 90 degrees the velocity drops at once"):
        make_cam(given)


REFUSED = [
    (f"{ROLLER.replace('4', '34')}", "base = 40\n", "sine",
     r"follower.radius: at 203.\d+ degrees the path .* the radius of curvature 32.1\d+: a roller of 34 undercuts .*; "
     r"half of it, 16.0\d+"),
    (f"{ROLLER}offset = -20\n", "base = 25\npressure_angle = { rise = 30 }\n", "sine",
     r"cam.pressure_angle.rise: at 38.\d+ degrees it is 62.\d+, above 30; a base circle of 68.\d+ or more"),
    (FLAT, "base = 20\n", "sine",
     r"cam.base: at 203.\d+ degrees .* is -21.\d+: it is hollow there.*; more than 41.\d+"),
    (FLAT, "base = 60\n", "uniform", r"law: at 120 degrees the velocity drops at once, which no flat face follows"),
    (ROLLER, "base = 40\n", "uniform", r"law: at 120 degrees the velocity drops at once, which no roller follows"),
    (ROLLER, "base = 40\nleast_radius = 30\n", "sine", r"cam.least_radius: at 203.\d+ degrees .* is 28.1\d+, below 30"),
]  # fmt: skip


@pytest.mark.parametrize(("follower", "base", "motion", "line"), REFUSED)
def test_what_cannot_be_made_is_refused(follower: str, base: str, motion: str, line: str) -> None:
    """A cam that cannot be made is refused with the reason, the angle, and what would be right."""
    with pytest.raises(SceneError) as fault:
        make_cam(parse(text(follower, base, motion), "cam.toml"))
    assert re.match(f"cam.toml: {line}", fault.value.lines[0]), fault.value.lines


def test_a_path_that_crosses_itself_is_refused() -> None:
    """An arm that swings past the line of centres draws a path that crosses itself: the place is told."""
    law = "".join(f'[[law]]\nangle = {angle}\nmotion = "{motion}"\n' + (f"stroke = {stroke}\n" if stroke else "")
                  for angle, motion, stroke in ((90, "sine", 200), (90, "sine", -200), (180, "dwell", 0)))
    follower = 'moves = "oscillating"\ncontact = "point"\narm = 60\ncentre_distance = 100\n'
    with pytest.raises(SceneError, match=r"crosses itself at \(-?\d+.*\); a larger base circle"):
        make_cam(parse(f"{law}[follower]\n{follower}[cam]\nrpm = 60\nbase = 60\n", "cam.toml"))


def test_pivots_in_the_way_are_refused() -> None:
    """A cam that would turn into the follower's pivot, or touch the face beyond it, is refused."""
    arm = 'moves = "oscillating"\ncontact = "point"\narm = 60\ncentre_distance = 62\n'
    for (follower, base, motion, stroke), line in (
            ((arm, "base = 40\n", "sine", 40), r"the profile reaches out to 76\.\d+, over the pivot at 62"),
            ((FACE, CONVEX, "parabolic", 20), r"the contact runs to -9\.\d+ along the face, past the pivot")):
        with pytest.raises(SceneError, match=rf"follower\.centre_distance: {line}"):
            make_cam(parse(text(follower, base, motion, stroke, "counter-clockwise"), "cam.toml"))


def test_notes_tell_shocks_and_steep_angles() -> None:
    """Shocks of the law, and pressure angles beyond the usual where no limit is given, are told."""
    notes = list(map(str, cam("point", "clockwise").notes))
    assert notes[0] == "at 0°, 120°, 180°, 270° the velocity jumps: a hard shock, the acceleration is infinite"
    steep = make_cam(parse(text(ROLLER, "base = 25\n", "sine"), "cam.toml"))
    assert [str(note).split(" is ")[1] for note in steep.notes][:1] == ["33.73°; as a rule it"]


def test_drawn_steps_keep_their_claims() -> None:
    """Each step of the inversion is one of the table, and lies where it should."""
    from graphplan.kernel.claims import broken_claims

    for name, turns in EVERYWHERE:
        found = draw_cam(cam(name, turns))
        assert not list(broken_claims(found.values.drawing.program, found.values.numbers, FORM_TOL))


def test_a_pose_is_a_scene_with_a_contact() -> None:
    """The cam in a pose is a scene of two links that touch, also where the profile is round about the cam's centre."""
    for name, turns in EVERYWHERE:
        for angle in (33.0, 150.0):
            scene = scene_of(scene_text(cam(name, turns), angle), "pose.toml")
            assert [contact.name for contact in scene.contacts] == ["1 2"]
