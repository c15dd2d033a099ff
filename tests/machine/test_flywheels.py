"""Flywheels: Ozols' scotch yoke in closed form, random loaded linkages, and what the sheet draws."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from face import ran
from linkages_with_masses import four_bar

import graphplan as gp

YOKE = gp.load("ozols-13-6")  # I = 10 + 4 sin² phi, a resisting moment of 200 |sin phi|, from phi = 60 degrees
STORED = 100 / 3  # J in the wheel at the given pose, from the dead point on
SPEED, UNEVENNESS = 15.0, 1 / 30
DEAD_POINT = Path(__file__).parents[1] / "cases" / "machine" / "motion" / "yoke.toml"
SEEDS = [2, 55, 81, 90, 133]  # a ramp, a tangent over the cycle's end, peaks between plans, two peaks nearly as high
MOTOR = [{"on": "1", "value": 25}]


@cache
def found() -> dict[str, Any]:
    """The flywheel of the yoke."""
    return gp.flywheel(YOKE).json()


@cache
def loaded(seed: int, closes: str = "drive") -> gp.Scene:
    """A crank-rocker with random masses, and a resisting moment over its turn; driven where this closes the cycle."""
    rng = np.random.default_rng(seed)
    lengths = 0.1, *map(float, rng.uniform((0.35, 0.3, 0.35), (0.45, 0.4, 0.42)))
    masses = [(float(rng.uniform(1, 5)), float(rng.uniform(0, 0.1)), float(rng.uniform(-0.03, 0.03)))
              for _ in range(3)]
    inner = np.column_stack([np.sort(rng.uniform(20, 340, 4)), rng.uniform(-90, 20, 4)]).tolist()
    resisting = {"on": "3", "over": "travel", "values": [[0, 0.0], *inner, [360, 0.0]]}
    driving = [{"on": "1", "value": 3}] if closes == "load" else []
    return four_bar(masses, lengths=lengths, omega=6, moments=[resisting, *driving],
                    flywheel={"speed": 6, "unevenness": 0.02, "closes": closes})


def test_closing_moment_and_energy() -> None:
    """The closing moment is minus the mean of the rest, and the energy is that of the closed form, as its extremes."""
    given = gp.flywheel(YOKE.replace("moments", MOTOR), positions=36).json()
    assert given["closing_moment"] == pytest.approx(400 / math.pi - 25, rel=1e-12)
    phi = np.radians(np.arange(0, 361, 10) + 60)
    assert [row[0] for row in given["energy"]] == pytest.approx(np.arange(0, 361, 10))
    assert [row[1] for row in given["reduced_moment"]] == pytest.approx(25 - 200 * abs(np.sin(phi)), abs=1e-11)
    assert [row[1] for row in given["reduced_inertia"]] == pytest.approx(10 + 4 * np.sin(phi)**2)
    closed = 400 / math.pi * (phi % math.pi) - 200 * (1 - np.cos(phi % math.pi))
    assert [row[1] for row in given["energy"]] == pytest.approx(closed - STORED, abs=1e-10)
    extremes = given["energy_extremes"]
    assert (extremes["least_at"] % 180, extremes["most_at"] % 180) == pytest.approx((80.46, 159.54), abs=0.005)
    assert extremes["range"] == pytest.approx(84.205, abs=5e-4)


def test_loads_that_change_close_the_cycle() -> None:
    """With closes = "load" the loads that change get a factor and the drive gives nothing."""
    scaled = gp.flywheel(YOKE.replace("moments", MOTOR), closes="load").json()
    assert (scaled["closing_moment"], scaled["load_factor"]) == (0, pytest.approx(25 * 2 * math.pi / 800))
    assert scaled["energy"][-1][1] == pytest.approx(0, abs=1e-9)
    drives = gp.flywheel(loaded(3, "load"))
    assert drives.json()["closing_moment"] == 0
    assert drives.json()["check"]["closing"] < 1e-9
    assert any("multiplied" in remark for remark in drives.remarks)


def test_wittenbauer() -> None:
    """Tangents of prescribed slope: intercepts, origin and travels; the speeds are those that the energy gives."""
    wheel = found()["flywheel"]
    assert wheel["inertia"] == pytest.approx(49.379, abs=5e-4)
    assert [cut + STORED for cut in wheel["cuts"]] == pytest.approx([-1155.61, -1525.96], abs=0.005)
    assert wheel["origin"]["energy"] + STORED == pytest.approx(-6897.5, abs=0.05)
    assert wheel["omega_max_at"] % 180 == pytest.approx(126.50, abs=0.005)
    assert wheel["omega_min_at"] % 180 == pytest.approx(34.76, abs=0.005)
    assert wheel["intercept"] / (UNEVENNESS * SPEED**2) == pytest.approx(wheel["inertia"])
    phi = np.linspace(0, math.pi, 100001)
    energy = 400 / math.pi * phi - 200 * (1 - np.cos(phi)) - STORED - wheel["origin"]["energy"]
    omega = np.sqrt(2 * energy / (10 + 4 * np.sin(phi)**2 + wheel["inertia"]))
    assert (omega.max(), omega.min()) == pytest.approx((15.25, 14.75), abs=1e-8)
    assert max(found()["check"].values()) < 1e-13


def test_speeds_with_a_given_flywheel() -> None:
    """With the flywheel that is found the unevenness is that asked for, and is drawn; with none it is the yoke's own.
    """
    given = gp.flywheel(YOKE, inertia=found()["flywheel"]["inertia"]).json()
    assert given["unevenness"] == pytest.approx(UNEVENNESS, rel=1e-9)
    assert given["flywheel"]["drawn_of"] == "unevenness"
    assert abs(given["flywheel"]["drawn"] - given["unevenness"]) < given["flywheel"]["drawn_error"]
    own = found()["without_flywheel"]["exact"]
    assert (own["omega_max"] + own["omega_min"]) / 2 == pytest.approx(SPEED, rel=1e-13)
    even = gp.flywheel(YOKE, unevenness=0.05).json()["flywheel"]
    assert even["unevenness"] == pytest.approx(0.05)
    assert even["inertia"] < 49


def test_other_methods() -> None:
    """Gutjahr with the right pairing finds Wittenbauer's flywheel, the area vectors a far smaller one; of work and
    idling the surplus is that of the stroke over the mean power."""
    methods = found()["methods"]
    assert [*methods] == ["wittenbauer", "gutjahr", "area vectors", "power"]
    assert methods["gutjahr"]["inertia"] == pytest.approx(methods["wittenbauer"]["inertia"], rel=1e-12)
    assert sum(work for _, _, work in methods["area vectors"]["areas"]) == pytest.approx(0, abs=1e-9)
    assert len(methods["area vectors"]["areas"]) == 4
    power = methods["power"]
    assert power["stored"] == pytest.approx(84.205, abs=5e-4)
    turn = power["work_time"] + power["idle_time"]
    assert turn == pytest.approx(2 * math.pi / SPEED)
    works = power["work"] * power["work_time"] + power["idle"] * power["idle_time"]
    assert power["mean"] == pytest.approx(works / turn)
    assert power["stored"] == pytest.approx((power["work"] - power["mean"]) * power["work_time"])


def test_a_motor_that_gives_way() -> None:
    """A motor of constant moment stores the largest surplus; one that falls with the speed less."""
    stiff, soft = (gp.flywheel(YOKE.replace("moments", [{"on": "1", "over": "speed", "powers": powers}])).json()
                   for powers in ([25], [625, -40]))
    assert stiff["closing_moment"] == pytest.approx(soft["closing_moment"])
    assert stiff["methods"]["characteristic"]["stored"] == pytest.approx(84.205, abs=5e-4)
    assert soft["methods"]["characteristic"]["stored"] == pytest.approx(83.555, abs=5e-4)


@pytest.mark.parametrize("start", [0, 60])
def test_the_drawing_nears_the_true_curve(start: int) -> None:
    """With more plans the drawn flywheel comes to that of the true curve, and so do closing moment and tangents, also
    where they touch beside the end of the cycle."""
    scene, gaps = YOKE if start else gp.load(DEAD_POINT).replace("moments", []), []
    for positions in (12, 24, 48, 96):
        drawn = gp.flywheel(scene, speed=SPEED, unevenness=UNEVENNESS, positions=positions).json()
        gaps.append(abs(drawn["flywheel"]["drawn"] / drawn["flywheel"]["inertia"] - 1))
        scales = drawn["drawing"]["scales"]
        assert scales["energy"] == pytest.approx(
            drawn["drawing"]["pole_distance"] * scales["moment"] * math.radians(scales["travel"]))
    assert gaps == sorted(gaps, reverse=True)
    assert gaps[1] < 5e-3
    assert gaps[3] < 1e-4
    assert drawn["drawing"]["closing_moment"] == pytest.approx(400 / math.pi, rel=1e-3)
    assert (drawn["drawing"]["omega_max_at"] + start) % 180 == pytest.approx(6.503, abs=0.05)


@pytest.mark.parametrize("seed", SEEDS)
def test_random_linkages(seed: int) -> None:
    """The integrated motion has the unevenness asked for, the drawn flywheel is as near as its error says, and with it
    the energy of all plans is that of their speeds."""
    result = gp.flywheel(loaded(seed)).json()
    assert max(result["check"][what] for what in ("omega_max", "omega_min", "unevenness", "closing")) < 1e-9
    wheel = result["flywheel"]
    assert abs(wheel["drawn"] - wheel["inertia"]) < wheel["drawn_error"]
    works = dict(result["work"])
    assert sum(works.values()) - works["closing"] == pytest.approx(-2 * math.pi * result["closing_moment"], rel=1e-9)
    inertia, energy, omega = (np.array(result[name])[:, 1] for name in ("reduced_inertia", "energy", "omega"))
    kinetic = (inertia + wheel["inertia"]) * omega**2 / 2
    assert np.ptp(kinetic - energy) < 1e-9 * kinetic.max()


@pytest.mark.parametrize("seed", [None, *SEEDS])
def test_other_constructions_draw_what_their_methods_find(seed: int | None, tmp_path: Path) -> None:
    """Gutjahr's curves draw the flywheel itself, as near as their error says, the vectors of areas what these find."""
    scene = YOKE if seed is None else loaded(seed)
    numbers = gp.flywheel(scene).json()
    drawn = {}
    for by in ("gutjahr", "areas"):
        gp.flywheel(scene, by=by).save(tmp_path / f"{by}.svg")
        text = re.sub("<[^>]*>", "", "".join(page.read_text() for page in tmp_path.glob(f"{by}*.svg")))
        drawn[by] = float(re.findall(r"drawn (−?[\d.]+)", text.replace("\xa0", " "))[0].replace("−", "-"))
    assert abs(drawn["gutjahr"] - numbers["flywheel"]["inertia"]) < numbers["flywheel"]["drawn_error"]
    assert drawn["areas"] == pytest.approx(numbers["methods"]["area vectors"]["inertia"], rel=1e-3)


def test_what_the_command_prints_is_as_its_schema_says() -> None:
    """`schema flywheel` describes what is printed, whatever is asked for."""
    schema = ran("schema", "flywheel").json
    for options in ((), ("--inertia", "20"), ("--by", "areas")):
        jsonschema.validate(ran("flywheel", "ozols-13-6", "-q", *options).json, schema)
