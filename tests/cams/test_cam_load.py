"""Cams under load: forces by the formulas of the book and the solver, by differences and by work; the least spring;
jamming."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
from test_base import ARM, ROLLER, text

from graphplan.cams.construction import draw_cam
from graphplan.cams.exports import load_numbers, scene_text
from graphplan.cams.forces import LoadedCam, make_loaded_cam
from graphplan.cams.profile import Cam, make_cam
from graphplan.cams.task import parse
from graphplan.check.cams import check_cam
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SceneError, SingularPose
from graphplan.mechanism.scene import parse as parse_scene
from graphplan.output.subjects.cam_diagrams import LAW_PLAN, SPRING_PLAN
from graphplan.output.subjects.cam_sheet import CamSheet
from graphplan.phrases import digits
from graphplan.sheet.plates.display import Text
from graphplan.solver import with_friction
from graphplan.solver.delivered import efficiency

LOAD = "[load]\nforce = {}\nmass = {}\noverhang = 40\nbearing = 60\nfriction = {}\n"
FLAT = 'moves = "translating"\ncontact = "flat"\n'


def loaded(load: str, follower: str = f"{ROLLER}offset = 6\n", motion: str = "sine") -> Cam:
    """The cam of a task with this load."""
    return make_cam(parse(text(follower, "base = 40\n", motion) + load, "cam.toml"))


def by_the_book(cam: Cam, angle: float, f: float) -> float:
    """The moment on the cam in the sense of its turning: N (cos theta - f (R' + R'')) = Q + m a + T (11-1, (14.22))."""
    task = cam.task
    s, v, a = (float(cam.law.value_at([angle], order)[0]) for order in range(3))
    c, preload, *_ = LoadedCam(cam).spring
    pushed = float(task.load[0]) + float(task.load[1]) * a * task.cam.omega**2 / 1000 + preload + c * s  # type: ignore[index]
    theta = abs(float(cam.contact(np.array([angle])).pressure[0]))
    arm = (40 - s) / 60
    bearings = 2 * abs(v) / 60 if task.follower.flat else math.sin(theta) * (1 + 2 * arm)
    moves = 0 if abs(v) < 1e-9 else math.copysign(1, v)
    return pushed / (math.cos(theta) - moves * f * bearings) * math.cos(theta) * v / 1000


@pytest.mark.parametrize("seed", range(12))
def test_poses_have_the_forces_of_the_book(seed: int) -> None:
    """In any pose of the turn, with a roller, offset or not, or a flat face: solved with the guide as a sleeve."""
    r = Random(seed)
    follower = r.choice((ROLLER, f"{ROLLER}offset = {r.randint(-8, 8)}\n", FLAT))
    f, angle = r.choice((0.0, 0.1, 0.15)), r.uniform(0, 360)
    load = LOAD.format(r.randint(0, 200), r.randint(0, 3), f) + f"stiffness = {r.randint(0, 6)}\npreload = 900\n"
    cam = loaded(load, follower, "harmonic" if follower == FLAT else r.choice(("sine", "3-4-5")))
    (moment,) = with_friction(parse_scene(scene_text(cam, angle), "pose")).balances
    assert cam.pair.sense * float(moment) == pytest.approx(by_the_book(cam, angle, f), rel=1e-9, abs=1e-9)  # type: ignore[arg-type]


@pytest.mark.parametrize(("follower", "spring"), [
    (ROLLER, "stiffness = 5"), (f"{ROLLER}offset = -6\n", "preload = 60"), (FLAT, "stiffness = 1\npreload = 2")])
def test_forces_are_those_of_the_solver(follower: str, spring: str) -> None:
    """At each division, where the follower stays on the cam and where it leaves it."""
    cam = loaded(LOAD.format(20, 2, 0.1) + spring, follower, "harmonic" if follower == FLAT else "sine")
    assert LoadedCam(cam).keeps_contact == (follower != FLAT)
    assert check_cam(draw_cam(cam))["load"] < 1e-11


def test_at_rest_nothing_is_passed_on() -> None:
    """In a dwell the power without friction may be rounding, where that with friction is zero."""
    assert efficiency(7.7e-26, 0.0) is None


def test_the_force_triangle_is_drawn() -> None:
    """In the scene of a pose construction and solver agree, and the guide bears what both bearings do."""
    cam = loaded(LOAD.format(100, 2, 0.1) + "stiffness = 5\n")
    data, forces = result_data(report(parse_scene(scene_text(cam, 60), "pose"))), LoadedCam(cam).forces_at(60)
    assert data["balance"]["moment"] == pytest.approx(-forces.moment)
    slide = next(entry["force"] for entry in data["reactions"] if "slide" in entry)
    assert (abs(slide[0]), slide[1]) == pytest.approx((abs(forces.near - forces.far), -forces.friction))
    assert data["friction"]["edges"] == {"2 along frame": pytest.approx(300)}


@pytest.mark.parametrize("seed", range(8))
def test_the_moment_does_the_work_of_friction(seed: int) -> None:
    """Over a turn, and inertia is that of differences of the lift."""
    r = Random(seed)
    load = LOAD.format(r.randint(0, 200), r.randint(1, 3), r.choice((0.05, 0.15))) + "preload = 900\nstiffness = 4\n"
    cam = loaded(load, r.choice((ROLLER, f"{ROLLER}offset = {r.randint(-8, 8)}\n")), r.choice(("sine", "3-4-5")))
    one, work = LoadedCam(cam), 0.0
    for piece in cam.law.stretches:
        angles = piece.divide(2000)
        forces, turned = one.forces(angles, piece), np.radians(angles)
        work += float(np.trapezoid(forces.moment, turned))
        rates = np.gradient(np.gradient(piece.value_at(angles), turned), turned)[4:-4] * cam.task.cam.omega**2 / 1000
        assert forces.inertia[4:-4] == pytest.approx(-one.mass * rates, abs=1e-4 * np.ptp(rates) + 1e-4)
    assert work == pytest.approx(one.work_lost, rel=1e-5)


@pytest.mark.parametrize("spring", ["stiffness = 3\n", "preload = 20\n"])
def test_the_least_spring_keeps_contact(spring: str) -> None:
    """Where it is needed most the contact force vanishes; with a little less of either the follower leaves the cam."""
    one = LoadedCam(loaded(LOAD.format(10, 2, 0) + spring))
    c, preload, least, at = one.spring
    assert one.keeps_contact
    assert preload == pytest.approx(least)
    assert one.forces_at(at).contact == pytest.approx(0, abs=1e-4)
    for less in (f"stiffness = {0.99 * c}\npreload = {preload}\n", f"stiffness = {c}\npreload = {0.99 * preload}\n"):
        assert not LoadedCam(loaded(LOAD.format(10, 2, 0) + less)).keeps_contact


def test_numbers_have_all_forces() -> None:
    """The spring, what is largest, and each position's."""
    one = LoadedCam(loaded(LOAD.format(10, 2, 0.1) + "stiffness = 3\n"))
    document = load_numbers(one, 12)
    row = document["positions"][2]
    assert (row["angle"], row["contact"]) == (60, one.forces_at(60).contact)
    most = document["largest_contact"]
    assert one.forces_at(most["at"]).contact == pytest.approx(most["value"])
    assert most["value"] >= max(row["contact"] for row in document["positions"])


def test_the_sheet_has_forces_and_the_spring() -> None:
    """Diagrams over the turn with their extremes, the spring's line T, and both in words."""
    cam = loaded(LOAD.format(20, 2, 0.1) + "preload = 60\n")
    sheet = CamSheet("A3", draw_cam(cam), {})
    assert SPRING_PLAN in sheet.panels
    lettered = {panel: ["".join(run.text for run in item.runs) for item in sheet.figure(panel, sheet.room(panel))
                        if isinstance(item, Text)] for panel in (LAW_PLAN, SPRING_PLAN)}
    at, contact = LoadedCam(cam).largest("contact")
    assert {"N, N   (kN = 10 N/mm)", str(digits(contact))} <= {*lettered[LAW_PLAN]}
    assert "T" in lettered[SPRING_PLAN]
    words = [*map(str, sheet.result_words())]
    assert f"Largest contact force: {digits(contact)} N at {digits(at)}°" in words
    assert "The follower leaves the cam." not in words


def test_strokes_of_oscillating_followers_are_degrees() -> None:
    """Their sign stands at the number."""
    arm = draw_cam(make_cam(parse(text(ARM, "base = 40\n", "sine", 22), "cam.toml")))
    assert "0° to 120°: sine, 22°" in [*map(str, CamSheet("A3", arm, {}).given_words())]


def test_a_preload_may_be_too_small() -> None:
    """Where what pulls the follower when it is lowest is more, no stiffness helps."""
    task = parse(text(ROLLER, "base = 40\n", "sine") + LOAD.format(-50, 2, 0) + "preload = 20\n", "cam.toml")
    with pytest.raises(SceneError, match=r"load.preload: at .*, where the follower is lowest, it leaves the cam; a "
                                         "preload of 50 N or more"):
        make_loaded_cam(task)


def test_a_follower_jams() -> None:
    """Where cot theta = f (1 + 2 a/b) (Ozols 1974, (14.22)), with a little more friction; not with a little less.

    The solver finds the pose singular there, and the task is refused.
    """
    at, share = (one := LoadedCam(loaded(LOAD.format(100, 0, 0.1)))).law.extremum(one.jamming)
    theta = abs(float(one.cam.contact(np.array([at])).pressure[0]))
    most = 1 / math.tan(theta) / (1 + 2 * (40 - float(one.law.value_at([at])[0])) / 60)
    assert share == pytest.approx(0.1 / most)
    assert one.jamming_angle(at) > math.degrees(theta)
    less, more = (loaded(LOAD.format(100, 0, times * most)) for times in (0.99, 1.01))
    make_loaded_cam(less.task)
    with_friction(parse_scene(scene_text(less, at), "pose"))
    with pytest.raises(SingularPose, match="self-locking"):
        with_friction(parse_scene(scene_text(more, at), "pose"))
    with pytest.raises(SceneError, match=r"load.friction: at .* degrees the follower jams in its guide, as from a"):
        make_loaded_cam(more.task)


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
