"""Cams: laws in closed form, base circles of the textbook, envelopes, arcs, and forces, as `graphplan cam` has them."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from functools import cache
from math import pi
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from face import ran
from inked_sheet import InkedSheet

import graphplan as gp

TASK = Path(__file__).parents[1] / "cases" / "cams" / "roller.toml"
ROLLER = 'moves = "translating", contact = "roller", radius = 4'
ARM = 'moves = "oscillating", contact = "roller", radius = 4, arm = 80, centre_distance = 100'
FLAT = 'moves = "translating", contact = "flat"'
FACE = 'moves = "oscillating", contact = "flat", centre_distance = 100, offset = 3'
POINT = 'moves = "translating", contact = "point"'
BOTH = 'base = "pressure angle", pressure_angle = { rise = 30, return = 30 }'
CONVEX = 'base = "convex", least_radius = 5'
LOAD = "force = {}, mass = {}, overhang = 40, bearing = 60, friction = {}, {}"
OMEGA = 10 * pi
RISE, DWELL, RETURN = 120, 60, 90  # degrees


def settings(follower: str = ROLLER, cam: str = "base = 40", motion: str = "harmonic", stroke: float = 25,
             turns: str = "clockwise", load: str = "") -> list[str]:
    """A rise over 120 and a return over 90 degrees, by what is set in the task."""
    values = [f'law.0.motion="{motion}"', f'law.2.motion="{motion}"', f"law.0.stroke={stroke}",
              f"law.2.stroke={-stroke}", f"follower={{ {follower} }}", f'cam={{ turns = "{turns}", rpm = 300, {cam} }}']
    return [part for value in (*values, *([f"load={{ {load} }}"] if load else [])) for part in ("--set", value)]


@cache
def made(*said: str, positions: int = 360, tolerance: float = 0.001, **more: Any) -> dict[str, Any]:
    """The numbers of a cam; all its opinions agree."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "cam.json"
        told = ran("cam", TASK, "-q", "-o", file, "--positions", str(positions), "--tolerance", str(tolerance),
                   *settings(*said, **more))
        assert told.status == 0, told.err
        data: dict[str, Any] = json.loads(file.read_text())
    check = data["check"]
    assert max(check["points"], check["motion"], check.get("load", 0)) < 1e-11
    assert max(check["curvature"], check["law"]) < 1e-6
    return data


@cache
def posed(angle: float, *said: str, **more: Any) -> gp.Scene:
    """The cam in a pose, as a scene with a contact."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "pose.toml"
        told = ran("cam", TASK, "-q", "-o", file, "--at", repr(angle), *settings(*said, **more))
        assert told.status == 0, told.err
        return gp.load(file, by_drive=True)


def column(data: dict[str, Any], name: str) -> Any:
    """A column of the table over the turn; places as complex numbers."""
    values = [row[name] for row in data["positions"]]
    return np.array([complex(*value) if isinstance(value, list) else value for value in values])


# ---- laws ------------------------------------------------------------------------------------------------------------


LAWS: dict[str, tuple[Callable[[Any], Any], ...]] = {  # lift, velocity and acceleration from 0 to 1
    "uniform": (lambda t: t, lambda t: 1 + 0 * t, lambda t: 0 * t),
    "parabolic": (lambda t: np.where(t < 0.5, 2 * t**2, 1 - 2 * (1 - t)**2), lambda t: 2 - abs(2 - 4 * t),
                  lambda t: np.where(t < 0.5, 4.0, -4.0)),
    "harmonic": (lambda t: (1 - np.cos(pi * t)) / 2, lambda t: pi / 2 * np.sin(pi * t),
                 lambda t: pi**2 / 2 * np.cos(pi * t)),
    "sine": (lambda t: t - np.sin(2 * pi * t) / 2 / pi, lambda t: 1 - np.cos(2 * pi * t),
             lambda t: 2 * pi * np.sin(2 * pi * t)),
    "3-4-5": (lambda t: 10 * t**3 - 15 * t**4 + 6 * t**5, lambda t: 30 * t**2 - 60 * t**3 + 30 * t**4,
              lambda t: 60 * t - 180 * t**2 + 120 * t**3),
}
LARGEST = {"uniform": (1, 0), "parabolic": (2, 4), "harmonic": (pi / 2, pi**2 / 2), "sine": (2, 2 * pi),
           "trapezoid": (2, 16 / 3), "3-4-5": (15 / 8, 10 / 3**0.5)}  # Ozols 1974, 20-2
JERKS = {"sine": 4 * pi**2, "trapezoid": 128 / 3, "3-4-5": 60}
SHOCKS = {"uniform": {"velocity"}, "parabolic": {"acceleration"}, "harmonic": {"acceleration"}}


@pytest.mark.parametrize("motion", LARGEST)
def test_laws_are_their_closed_forms(motion: str) -> None:
    """Lift, velocity, acceleration and jerk over the rise are those of the textbook, as are the largest; the return has
    the same with its own angle, and the dwells none."""
    data = made(POINT, motion=motion, positions=720)
    angle, lift = column(data, "angle"), column(data, "lift")
    rise, back = angle < RISE, (angle > RISE + DWELL) & (angle < RISE + DWELL + RETURN)
    rates = [column(data, name) for name in ("velocity", "acceleration", "jerk")]
    for law, found, order in zip(LAWS.get(motion, ()), (lift, *rates), range(3), strict=False):
        inside = rise & (abs(angle - RISE / 2) > 1e-9) & (angle > 0)
        size = 25 * (OMEGA / math.radians(RISE))**order
        assert found[inside] == pytest.approx(size * law(angle[inside] / RISE), rel=1e-12, abs=1e-12 * size)
        size = -25 * (OMEGA / math.radians(RETURN))**order
        share = (angle[back] - RISE - DWELL) / RETURN
        smooth = abs(share - 0.5) > 1e-9
        right = size * law(share[smooth]) + (25 if order == 0 else 0)
        assert found[back][smooth] == pytest.approx(right, rel=1e-12, abs=1e-12 * abs(size))
    for found, largest, order in zip(rates, (*LARGEST[motion], JERKS.get(motion)), (1, 2, 3), strict=True):
        size = 25 * (OMEGA / math.radians(RISE))**order
        assert largest is None or abs(found[rise]).max() == pytest.approx(largest * size, rel=1e-4, abs=1e-9)
    still = (angle > RISE) & (angle < RISE + DWELL)
    assert lift[still] == pytest.approx(25)
    assert np.abs(rates[0][still]).max() < 1e-9
    assert {shock["of"] for shock in data["shocks"]} == SHOCKS.get(motion, set())


def test_shocks_are_told() -> None:
    """A jump of the velocity is a hard shock, one of the acceleration a soft one, each with its angle and sizes; and
    pressure angles beyond the usual are told where no limit is given."""
    turn = math.radians(RISE)
    for motion, after in (("uniform", 25 / turn * OMEGA), ("parabolic", 4 * 25 / turn**2 * OMEGA**2 / 1000),
                          ("harmonic", pi**2 / 2 * 25 / turn**2 * OMEGA**2 / 1000)):
        data = made(POINT, motion=motion, positions=720)
        first = data["shocks"][0]
        assert (first["at"], first["before"]) == (0, 0)
        assert first["after"] == pytest.approx(after * (1 if first["of"] == "velocity" else 1000), rel=1e-9)
    hard = made(POINT, "base = 30", "uniform")["notes"][0]
    assert hard == "at 0°, 120°, 180°, 270° the velocity jumps: a hard shock, the acceleration is infinite"
    assert made(ROLLER, "base = 25", "sine")["notes"][0].split(" is ")[1] == "33.73°; as a rule it"


@pytest.mark.parametrize("closed", [False, True])
def test_splines_are_smooth_and_exact(closed: bool, tmp_path: Path) -> None:
    """A law by pairs goes through them, at rest at its ends or around the turn, without any shock of the velocity."""
    pairs = [[0, 0], [90, 4], [180, 9], [270, 4], [360, 0]] if closed else [
        [0, 0], [60, 1], [120, 5], [180, 9], [240, 6], [300, 2], [360, 0]]
    law = [{"table": pairs}] if closed else [{"table": [[at / 2, lift] for at, lift in pairs]},
                                             {"angle": 180, "motion": "dwell"}]
    text = "[" + ", ".join("{ " + ", ".join(f"{key} = {json.dumps(value)}" for key, value in stage.items()) + " }"
                           for stage in law) + "]"
    file = tmp_path / "cam.json"
    assert ran("cam", TASK, "-q", "--set", f"law={text}", "-o", file, "--positions", "720").status == 0
    data = json.loads(file.read_text())
    lifts = dict(zip(column(data, "angle"), column(data, "lift"), strict=True))
    span = 1 if closed else 0.5
    for at, lift in pairs[:-1]:
        assert lifts[at * span] == pytest.approx(lift, abs=1e-13)
    assert not [shock for shock in data["shocks"] if shock["of"] == "velocity"]
    velocity, acceleration = column(data, "velocity"), column(data, "acceleration")
    step = math.radians(0.5) / OMEGA
    size = abs(acceleration).max()
    assert closed or abs(velocity[0]) < 1e-12 * abs(velocity).max()
    assert np.abs(np.diff(velocity)).max() < 1.01 * size * step
    jumps = [shock["at"] for shock in data["shocks"]]
    assert jumps == ([] if closed else jumps)
    inner = np.abs(np.diff(acceleration[: 720 if closed else 359])).max()
    assert inner < 0.1 * size


# ---- base circles ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("follower", [FLAT, FACE])
@pytest.mark.parametrize("motion", ["sine", "harmonic", "parabolic"])
def test_flat_faces_keep_the_profile_convex(follower: str, motion: str) -> None:
    """The tangent of 45 degrees gives the base circle of which the smallest radius of curvature is that asked for."""
    data = made(follower, CONVEX, motion, 12)
    assert data["least_radius"]["radius"] == pytest.approx(5, abs=1e-9)
    assert column(data, "radius_of_curvature").min() > 5 - 1e-9


# ---- profiles --------------------------------------------------------------------------------------------------------


CAMS: dict[str, tuple[Any, ...]] = {
    "roller": (ROLLER, "base = 40", "sine", 25), "offset": (f"{ROLLER}, offset = 6", BOTH, "harmonic", 25),
    "other side": (f"{ROLLER}, offset = -6", "base = 40", "trapezoid", 25), "flat": (FLAT, CONVEX, "3-4-5", 25),
    "arm": (ARM, "base = 45", "sine", 20), "face": (FACE, CONVEX, "parabolic", 12),
    "point": (POINT, "base = 30", "uniform", 25),
}
SENSES = {"clockwise": -1, "counter-clockwise": 1}


@pytest.mark.parametrize("turns", SENSES)
@pytest.mark.parametrize("name", CAMS)
def test_the_follower_nowhere_enters_the_cam(name: str, turns: str) -> None:
    """In every pose the follower stands where its law has it; the roller touches the profile and never cuts it, and the
    flat face never does either."""
    data = made(*CAMS[name], turns=turns, positions=1440)
    angle, lift, outline = column(data, "angle"), column(data, "lift"), column(data, "profile")
    inverted, cam = np.exp(-1j * SENSES[turns] * np.radians(angle)), data["cam"]
    if name == "flat":
        for k in range(0, 1440, 12):
            gap = cam["base_radius"] + lift[k] - (outline * inverted[k].conjugate()).imag.max()
            assert -1e-3 < gap < 2e-2
        return
    if name == "face":
        assert np.abs(outline).min() > cam["base_radius"] - 1e-6
        return
    centres = outline if name == "point" else column(data, "roller")
    if name == "arm":
        swung = np.radians(cam["arm_angle"] + lift)
        assert np.abs(centres)**2 == pytest.approx(100**2 + 80**2 - 2 * 100 * 80 * np.cos(swung), rel=1e-12)
    else:
        assert cam["offset"]**2 + cam["depth"]**2 == pytest.approx(cam["base_radius"]**2)
        own = SENSES[turns] * cam["offset"] + 1j * (cam["depth"] + lift)
        assert centres == pytest.approx(own * inverted, rel=1e-12)
    if name != "point":
        gaps = [abs(outline - centre).min() - 4 for centre in centres[::12]]
        assert min(gaps) > -1e-3
        assert max(gaps) < 2e-2


def away(spots: Any, start: complex, end: complex, bulge: float) -> Any:
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


@pytest.mark.parametrize("turns", SENSES)
@pytest.mark.parametrize("name", CAMS)
def test_arcs_keep_their_tolerance(name: str, turns: str) -> None:
    """No point of the profile is further from the arcs than is asked; of finer ones there are more, but not many."""
    fine, coarse = (made(*CAMS[name], turns=turns, **more) for more in (
        {"positions": 1440}, {"positions": 12, "tolerance": 0.1}))
    outline, counts = column(fine, "profile"), []
    for data in (coarse, fine):
        tolerance, arcs = data["outline"]["tolerance"], data["outline"]["arcs"]
        gaps = [away(outline, complex(x, y), complex(*after[:2]), bulge)
                for (x, y, bulge), after in zip(arcs, (*arcs[1:], arcs[0]), strict=True)]
        assert np.min(gaps, axis=0).max() < 1.01 * tolerance
        counts.append(len(arcs))
    assert counts[0] < counts[1] < 100


@pytest.mark.parametrize("turns", SENSES)
@pytest.mark.parametrize("name", CAMS)
def test_a_pose_is_a_scene_that_moves_as_the_law(name: str, turns: str) -> None:
    """The cam in a pose is a scene of two links that touch, also where the profile is round about the cam's centre;
    solved it gives the law's velocity and acceleration."""
    table = {row["angle"]: row for row in made(*CAMS[name], turns=turns, positions=1440)["positions"]}
    for angle in (33.0, 150.0):
        scene = posed(angle, *CAMS[name], turns=turns)
        assert [contact.name for contact in scene.contacts] == ["1 2"]
        found = gp.analytic.solve(scene)
        swings = name in ("arm", "face")
        row = table[angle]
        for what, vectors, turning in (("velocity", found.velocity, found.omega), ("acceleration", found.acceleration,
                                                                                   found.alpha)):
            if swings:
                assert abs(turning["2"]) == pytest.approx(abs(row[what]), rel=1e-9, abs=1e-9)
            else:
                assert vectors["A" if "A" in vectors else "K"].imag == pytest.approx(row[what], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("rpm", ["300", "1e-4"])
def test_a_slow_cam_has_its_velocity_acceleration_and_jerk(rpm: str, tmp_path: Path) -> None:
    """However slowly a cam turns, no derivative of its lift is said to be zero."""
    sheet = tmp_path / "sheet.svg"
    assert ran("cam", TASK, "-q", "-o", sheet, *settings(f"{ROLLER}, offset = 6", BOTH, "sine"), "--set",
               f"cam.rpm={rpm}").status == 0
    assert " = 0<" not in sheet.read_text()


def test_numbers_of_a_diagram_stand_apart(tmp_path: Path) -> None:
    """Where a dwell of three degrees ends, its end has a line and no number."""
    sheet = tmp_path / "sheet.svg"
    assert ran("cam", TASK.with_name("narrow.toml"), "-q", "-o", sheet).status == 0
    assert not InkedSheet.of(sheet.read_text()).labels_on_labels


def test_profiles_are_true_to_size(tmp_path: Path) -> None:
    """The DXF has one closed polyline of arcs on the profile's layer, and the base circle; it is the same twice."""
    ezdxf = pytest.importorskip("ezdxf")
    for name in ("one", "two"):
        assert ran("cam", TASK, "-q", "-o", tmp_path / f"{name}.dxf", "--tolerance", "0.01").status == 0
    space = ezdxf.readfile(tmp_path / "one.dxf").modelspace()
    profile, = space.query('LWPOLYLINE[layer=="MECHANISM 1-1 profile"]')
    assert profile.closed
    circle, = space.query("CIRCLE")
    low = min(np.hypot(x, y) for x, y, *_ in profile.get_points())
    assert low == pytest.approx(circle.dxf.radius - 4, abs=0.01)
    assert (tmp_path / "one.dxf").read_bytes() == (tmp_path / "two.dxf").read_bytes()


# ---- forces ----------------------------------------------------------------------------------------------------------


def by_the_book(data: dict[str, Any], angle: float, row: dict[str, Any], load: dict[str, float], flat: bool) -> float:
    """The moment on the cam as it turns, by N (cos theta - f (R' + R'')) = Q + m a + T: Ozols 11-1, (14.22)."""
    s, v = row["lift"], row["velocity"] / OMEGA
    spring = data["load"]["preload"] + data["load"]["stiffness"] * s
    pushed = load["Q"] + load["m"] * row["acceleration"] / 1000 + spring
    theta, arm = math.radians(row["pressure_angle"]), (40 - s) / 60
    bearings = 2 * abs(v) / 60 if flat else math.sin(theta) * (1 + 2 * arm)
    moves = 0 if abs(v) < 1e-9 else math.copysign(1, v)
    return pushed / (math.cos(theta) - moves * load["f"] * bearings) * math.cos(theta) * v / 1000


@pytest.mark.parametrize("seed", range(8))
def test_poses_have_the_forces_of_the_book(seed: int) -> None:
    """In any pose of the turn, with a roller, offset or not, or a flat face: solved with the guide as a sleeve."""
    r = Random(seed)
    follower = r.choice((ROLLER, f"{ROLLER}, offset = {r.randint(-8, 8)}", FLAT))
    load: dict[str, float] = {"f": r.choice((0.0, 0.1, 0.15)), "Q": r.randint(0, 200), "m": r.randint(0, 3)}
    angle, motion = r.randrange(360), "harmonic" if follower == FLAT else r.choice(("sine", "3-4-5"))
    spring = f"stiffness = {r.randint(0, 6)}, preload = 900"
    said = {"motion": motion, "load": LOAD.format(load["Q"], load["m"], load["f"], spring)}
    data = made(follower, **said)
    row = next(row for row in data["positions"] if row["angle"] == angle)
    (moment,) = gp.analytic.with_friction(posed(float(angle), follower, **said)).balances
    right = by_the_book(data, angle, row, load, follower == FLAT)
    assert -float(moment) == pytest.approx(right, rel=1e-9, abs=1e-9)
    told = next(row for row in data["load"]["positions"] if row["angle"] == angle)
    assert told["moment"] == pytest.approx(right, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(("follower", "spring", "keeps"), [
    (ROLLER, "stiffness = 5", True), (f"{ROLLER}, offset = -6", "preload = 60", True),
    (FLAT, "stiffness = 1, preload = 2", False)])
def test_forces_are_those_of_the_solver(follower: str, spring: str, keeps: bool) -> None:
    """At each division, where the follower stays on the cam and where it leaves it; what is largest is told."""
    data = made(follower, motion="harmonic" if follower == FLAT else "sine", load=LOAD.format(20, 2, 0.1, spring))
    assert data["load"]["keeps_contact"] == keeps
    assert data["check"]["load"] < 1e-11
    contacts = [row["contact"] for row in data["load"]["positions"]]
    assert 0.99 * data["load"]["largest_contact"]["value"] < max(contacts) <= data["load"]["largest_contact"]["value"]


def test_the_force_triangle_is_drawn() -> None:
    """In the scene of a pose construction and solver agree, and the guide bears what both bearings do."""
    said: dict[str, Any] = {"motion": "sine", "load": LOAD.format(100, 2, 0.1, "stiffness = 5")}
    follower = f"{ROLLER}, offset = 6"
    data = gp.solve(posed(60.0, follower, **said)).json()
    forces = next(row for row in made(follower, **said)["load"]["positions"] if row["angle"] == 60)
    assert data["balance"]["moment"] == pytest.approx(-forces["moment"])
    slide = next(entry["force"] for entry in data["reactions"] if "slide" in entry)
    assert (abs(slide[0]), slide[1]) == pytest.approx((abs(forces["near"] - forces["far"]), -forces["friction"]))
    assert data["friction"]["edges"] == {"2 along frame": pytest.approx(300)}


@pytest.mark.parametrize("seed", range(4))
def test_the_moment_does_the_work_of_friction(seed: int) -> None:
    """Over a turn the moment does the work that friction takes, and inertia is that of the acceleration."""
    r = Random(seed)
    mass, offset = r.randint(1, 3), r.choice((0, r.randint(-8, 8)))
    spring = "preload = 900, stiffness = 4"
    data = made(f"{ROLLER}, offset = {offset}", motion=r.choice(("sine", "3-4-5")), positions=3600,
                load=LOAD.format(r.randint(0, 200), mass, r.choice((0.05, 0.15)), spring))
    rows = data["load"]["positions"]
    assert [row["inertia"] for row in rows] == pytest.approx(-mass * column(data, "acceleration") / 1000, abs=1e-9)
    work = sum(row["moment"] for row in rows) * 2 * pi / 3600
    assert work == pytest.approx(data["load"]["work_lost"], rel=1e-5)


@pytest.mark.parametrize("spring", ["stiffness = 3", "preload = 20"])
def test_the_least_spring_keeps_contact(spring: str) -> None:
    """Where it is needed most the contact force vanishes; with a little less of either the follower leaves the cam."""
    one = made(motion="sine", positions=3600, load=LOAD.format(10, 2, 0, spring))["load"]
    assert one["keeps_contact"]
    assert one["preload"] == pytest.approx(one["least_preload"])
    least = min(one["positions"], key=lambda row: row["contact"])
    assert least["contact"] == pytest.approx(0, abs=1e-2)
    assert least["angle"] == pytest.approx(one["nearest_to_loss"], abs=0.2)
    for c, preload in ((0.99 * one["stiffness"], one["preload"]), (one["stiffness"], 0.99 * one["preload"])):
        less = made(motion="sine", load=LOAD.format(10, 2, 0, f"stiffness = {c}, preload = {preload}"))
        assert not less["load"]["keeps_contact"]


def test_a_follower_jams() -> None:
    """Where cot theta = f (1 + 2 a/b) (Ozols 1974, (14.22)), with a little more friction; not with a little less."""
    follower = f"{ROLLER}, offset = 6"
    jamming = made(follower, motion="sine", load=LOAD.format(100, 0, 0.1, "preload = 0"))["load"]["jamming"]
    rows = made(follower, motion="sine", positions=3600)["positions"]
    most = min(1 / math.tan(math.radians(abs(row["pressure_angle"]))) / (1 + 2 * (40 - row["lift"]) / 60)
               for row in rows if abs(row["pressure_angle"]) > 1 and row["velocity"] > 1e-6)
    assert jamming["share"] == pytest.approx(0.1 / most, rel=1e-5)
    less, more = (("cam", TASK, "-q", "-o", "-", *settings(
        follower, motion="sine", load=LOAD.format(100, 0, times * most, "preload = 0"))) for times in (0.99, 1.01))
    assert ran(*less).status == 0
    told = ran(*more)
    assert told.status == 2
    assert "load.friction: at" in told.err
    assert "degrees the follower jams in its guide, as from a" in told.err


def test_the_sheet_has_forces_and_the_spring(tmp_path: Path) -> None:
    """Diagrams over the turn with their extremes, the spring's line T, and both in words."""
    said: dict[str, Any] = {"motion": "sine", "load": LOAD.format(20, 2, 0.1, "preload = 60")}
    assert ran("cam", TASK, "-q", "-o", tmp_path / "cam.svg", *settings(f"{ROLLER}, offset = 6", **said)).status == 0
    svg = "".join(page.read_text() for page in tmp_path.glob("cam*.svg"))
    largest = made(f"{ROLLER}, offset = 6", **said)["load"]["largest_contact"]
    assert 'data-plan="spring"' in svg
    assert f"Largest contact force: {largest['value']:.4g} N at {largest['at']:.4g}°" in svg.replace("&#160;", " ")
    assert "The follower leaves the cam." not in svg
