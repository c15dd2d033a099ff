"""Cams under load: scenes of poses by the formulas of the book, the least spring, jamming."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
from test_base import ARM, ROLLER, text
from tiers import sample

from graphplan.cams.exports import contact_spring, scene_text
from graphplan.cams.profile import Cam, make_cam
from graphplan.cams.task import parse
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SceneError, SingularPose
from graphplan.mechanism.scene import parse as parse_scene
from graphplan.solver import with_friction

LOAD = "[load]\nforce = {}\nmass = {}\noverhang = 40\nbearing = 60\nfriction = {}\n"
FLAT = 'moves = "translating"\ncontact = "flat"\n'


def loaded(load: str, follower: str = f"{ROLLER}offset = 6\n", motion: str = "sine") -> Cam:
    """The cam of a task with this load."""
    return make_cam(parse(text(follower, "base = 40\n", motion) + load, "cam.toml"))


def by_the_book(cam: Cam, angle: float, f: float) -> float:
    """The moment on the cam in the sense of its turning: N (cos theta - f (R' + R'')) = Q + m a + T (11-1, (14.22))."""
    task = cam.task
    s, v, a = (float(cam.law.value_at([angle], order)[0]) for order in range(3))
    c, preload, *_ = contact_spring(cam)
    pushed = float(task.load[0]) + float(task.load[1]) * a * task.cam.omega**2 / 1000 + preload + c * s  # type: ignore[index]
    theta = abs(float(cam.contact(np.array([angle])).pressure[0]))
    arm = (40 - s) / 60
    bearings = 2 * abs(v) / 60 if task.follower.flat else math.sin(theta) * (1 + 2 * arm)
    moves = 0 if abs(v) < 1e-9 else math.copysign(1, v)
    return pushed / (math.cos(theta) - moves * f * bearings) * math.cos(theta) * v / 1000


@pytest.mark.parametrize("seed", range(sample(6, 40)))
def test_poses_have_the_forces_of_the_book(seed: int) -> None:
    """In any pose of the turn, with a roller, offset or not, or a flat face: solved with the guide as a sleeve."""
    r = Random(seed)
    follower = r.choice((ROLLER, f"{ROLLER}offset = {r.randint(-8, 8)}\n", FLAT))
    f, angle = r.choice((0.0, 0.1, 0.15)), r.uniform(0, 360)
    load = LOAD.format(r.randint(0, 200), r.randint(0, 3), f) + f"stiffness = {r.randint(0, 6)}\npreload = 900\n"
    cam = loaded(load, follower, "harmonic" if follower == FLAT else r.choice(("sine", "3-4-5")))
    (moment,) = with_friction(parse_scene(scene_text(cam, angle), "pose")).balances
    assert cam.pair.sense * float(moment) == pytest.approx(by_the_book(cam, angle, f), rel=1e-9, abs=1e-9)  # type: ignore[arg-type]


def test_the_force_triangle_is_drawn() -> None:
    """In the scene of a pose construction and solver agree, and the guide is pressed at both ends."""
    cam = loaded(LOAD.format(100, 2, 0.1) + "stiffness = 5\n")
    data = result_data(report(parse_scene(scene_text(cam, 60), "pose")))
    assert data["balance"]["moment"] == pytest.approx(-4.152729795)
    assert data["friction"]["edges"] == {"2 along frame": pytest.approx(300)}


def test_the_least_preload_keeps_contact() -> None:
    """Where the spring is needed most the contact force vanishes, and by differences of the lift nowhere less is."""
    cam = loaded(LOAD.format(10, 2, 0) + "stiffness = 3\n")
    c, preload, least, at = contact_spring(cam)
    assert preload == least > 0
    assert by_the_book(cam, at, 0) == pytest.approx(0, abs=1e-6)
    for piece in cam.law.stretches:
        angles = piece.divide(2000)
        s = piece.value_at(angles)
        a = np.gradient(np.gradient(s, np.radians(angles)), np.radians(angles))[4:-4] * cam.task.cam.omega**2 / 1000
        assert float((10 + 2 * a + preload + c * s[4:-4]).min()) > -0.01 * preload


def test_a_follower_jams() -> None:
    """Where cot theta = f (1 + 2 a/b), with a little more friction; with a little less it does not."""
    angle, cam = 55.0, loaded(LOAD.format(100, 0, 0.1))
    theta = float(cam.contact(np.array([angle])).pressure[0])
    most = 1 / math.tan(theta) / (1 + 2 * (40 - float(cam.law.value_at([angle])[0])) / 60)
    with_friction(parse_scene(scene_text(loaded(LOAD.format(100, 0, 0.9 * most)), angle), "pose"))
    with pytest.raises(SingularPose, match="self-locking"):
        with_friction(parse_scene(scene_text(loaded(LOAD.format(100, 0, 1.1 * most)), angle), "pose"))


@pytest.mark.parametrize(("follower", "load", "fault"), [
    (ARM, LOAD.format(1, 1, 0), "load: the follower oscillates; a load of a follower on a straight path"),
    (ROLLER, LOAD.format(1, 1, 0).replace("overhang = 40", "overhang = 20"),
     "load.overhang: the follower rises into its guide; an overhang of the stroke or more"),
    (ROLLER, LOAD.format(1, -1, 0), "load.mass: the mass -1 is negative; a number of 0 or more"),
])
def test_loads_are_read(follower: str, load: str, fault: str) -> None:
    """A load is of a follower on a straight path, outside its guide."""
    with pytest.raises(SceneError) as caught:
        loaded(load, follower)
    assert fault in str(caught.value)
