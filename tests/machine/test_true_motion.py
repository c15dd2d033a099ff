"""True motion: run-up, run-down and steady cycles in closed form, worked examples, any mechanism with a motor."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from face import ran

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "machine" / "motion"
YOKE, WHEEL = gp.load(CASES / "yoke.toml"), gp.load(CASES / "wheel.toml")  # I = 10 + 4 sin² phi; I = 10 kg m²
KGF = 9.80665


def moved(scene: gp.Scene | str, **options: Any) -> dict[str, Any]:
    """The motion of a machine; both opinions agree."""
    data = gp.motion(scene, **options).json()
    assert max(data["check"].values()) < 1e-9
    return data


def driven(moment: dict[str, Any]) -> gp.Scene:
    """The yoke under another moment on its crank."""
    return YOKE.replace("moments", [{"on": "1", **moment}])


def test_run_up_from_rest() -> None:
    """Speed, time and energy of the yoke under 400 N m are those of the energy integral; the drawing is off by no more
    than it says, and less with more strips."""
    found = moved(YOKE, travel=180, positions=18)
    jsonschema.validate(found, ran("schema", "motion").json)
    phi = np.radians(found["travel"])
    energy = 400 * phi - 200 * (1 - np.cos(phi))
    inertia = 10 + 4 * np.sin(phi)**2
    assert found["energy"] == pytest.approx(energy, rel=1e-12, abs=1e-12)
    assert found["inertia"] == pytest.approx(inertia)
    assert found["omega"] == pytest.approx(np.sqrt(2 * energy / inertia), rel=1e-12)
    assert found["omega"][3] == pytest.approx(5.7626, abs=5e-5)
    assert found["time"][3] == pytest.approx(0.16726, abs=5e-6)
    error = found["drawn"]["error"]
    for what in ("energy", "omega", "time"):
        gaps = [abs(one - other) for one, other in zip(found["drawn"][what], found[what], strict=True)]
        assert max(gaps) == pytest.approx(error[what] * max(found[what]), rel=1e-6)
    finer = moved(YOKE, travel=180, positions=36)["drawn"]["error"]
    assert finer["omega"] < 0.3 * error["omega"] < 1e-3
    assert finer["time"] < 0.4 * error["time"] < 0.02


def test_moments_that_speed_the_yoke_up_evenly() -> None:
    """The moment that example 13-6 asks of the drive speeds the yoke up by 35.8 rad/s^2, and has the printed values;
    Baranov's steps come near its speed, those of the energy nearer."""
    fine = np.arange(0, 360.5, 0.5)
    x = np.radians(fine)
    needed = 358 + 143.2 * np.sin(x)**2 + 143.2 * x * np.sin(2 * x) + 200 * abs(np.sin(x))
    assert needed[:361:60] == pytest.approx([358.0, 558.7, 768.5, 701.2, 378.9, 169.1, 358.0], abs=0.06)
    scene = driven({"over": "travel", "values": np.column_stack([fine, needed]).tolist()})
    found = moved(scene, travel=180, positions=180)
    assert found["acceleration"] == pytest.approx([35.8] * 181, abs=0.01)
    assert found["omega"] == pytest.approx(np.sqrt(2 * 35.8 * np.radians(found["travel"])), rel=1e-3)
    assert found["strips"]["baranov"]["omega"] == pytest.approx(15.060, abs=6e-4)
    assert found["strips"]["euler"]["omega"] == pytest.approx(14.998, abs=6e-4)


def test_driving_moments_at_a_steady_speed() -> None:
    """At 15 rad/s the yoke asks 0, 489.7, 562.9, 200, -216.5 and -289.7 N m of its drive, as example 13-6 prints."""
    scene = YOKE.replace("moments", []).replace("drive.0.omega", 15)
    balance = ran("cycle", "-", "--positions", "12", "-q", "-o", "-", given=scene.toml())
    header, *rows = (line.split(",") for line in balance.out.splitlines())
    (column,) = (k for k, head in enumerate(header) if head.startswith("balance") and "size" not in head)
    assert [float(row[column]) for row in rows[:6]] == pytest.approx([0, 489.7, 562.9, 200, -216.5, -289.7], abs=0.06)


def test_linear_characteristics() -> None:
    """Under M_P0 - K omega the speed grows as Ozols' (13.42) to (13.46) have it, to the speed where both agree."""
    found = moved(WHEEL, travel=2292, positions=50)
    time = np.array(found["time"])
    grown = 1 - np.exp(-2 * time)
    assert found["omega"] == pytest.approx(15 * grown, rel=1e-9, abs=1e-9)
    assert np.degrees(15 * (time - grown / 2)) == pytest.approx(found["travel"], rel=1e-9, abs=1e-9)
    steady = moved(WHEEL)
    assert steady["nominal_omega"] == pytest.approx(15, rel=1e-12)
    assert steady["run_up"]["time"] == pytest.approx(math.log(100) / 2, rel=1e-9)


def test_stopping() -> None:
    """A braked machine stops where its energy is used up, and nothing is known beyond."""
    braked = WHEEL.replace("moments", [{"on": "1", "value": -20}])
    found = moved(braked, speed=13, travel=8 * 360, positions=96)
    assert (found["stop"]["travel"], found["stop"]["time"]) == pytest.approx((math.degrees(42.25), 6.5), rel=1e-11)
    assert [at for at, omega in zip(found["travel"], found["omega"], strict=True) if omega is None] == \
        [at for at in found["travel"] if at > found["stop"]["travel"]]
    damped = braked.replace("moments", [{"on": "1", "value": -20}, {"on": "1", "over": "speed", "powers": [0, -4]}])
    stop, time = moved(damped, speed=13, travel=8 * 360)["stop"], math.log(18 / 5) / 0.4  # omega + 5 falls so
    assert stop["time"] == pytest.approx(time, rel=1e-10)
    assert math.radians(stop["travel"]) == pytest.approx(18 * (1 - 5 / 18) / 0.4 - 5 * time, rel=1e-10)


def test_steady_cycles() -> None:
    """The cycle that closes has the mean speed asked for, also where scaled loads close it, and returns to its speed.
    """
    found = moved("ozols-13-6", positions=48)
    assert [found["speeds"][end]["omega"] for end in ("min", "max")] == pytest.approx([14.75, 15.25], abs=1e-6)
    assert [found["speeds"][end]["travel"] % 180 for end in ("min", "max")] == pytest.approx([34.76, 126.50], abs=0.01)
    inertia, omega, energy = (np.array(found[what]) for what in ("inertia", "omega", "energy"))
    assert inertia * omega**2 / 2 == pytest.approx(energy, rel=1e-12)
    scaled = driven({"value": 200}).replace("drive.0.omega", 15).replace(
        "flywheel", {"speed": 15, "unevenness": 1 / 30, "closes": "load"})
    data = moved(scaled)
    assert data["speeds"]["unevenness"] == pytest.approx(1 / 30, rel=1e-9)
    assert data["omega"][-1] == pytest.approx(data["omega"][0], rel=1e-11)
    assert "closing_moment" not in data
    closed = driven({"value": 400 / math.pi})
    assert moved(closed, steady=True, speed=15)["speeds"]["arithmetic_mean"] == pytest.approx(15, rel=1e-9)


@pytest.mark.parametrize("law", [{"values": [[0, 1000], [20, 0], [40, -1000]]}, {"powers": [1000, -50]}])
def test_a_motor_leads_into_one_cycle(law: dict[str, Any]) -> None:
    """A motor whose moment falls leads any motion into one cycle, which repeats itself; as the moments are linear its
    mean over the travel is the nominal speed."""
    scene = driven({"over": "speed", **law})
    found = moved(scene, speed=10, steady=True)
    nominal = 20 - 400 / math.pi / 50
    assert found["nominal_omega"] == pytest.approx(nominal, rel=1e-9)
    assert found["omega"][-1] == pytest.approx(found["omega"][0], rel=1e-11)
    assert found["speeds"]["mean_over_travel"] == pytest.approx(nominal, rel=1e-9)
    assert moved(scene, speed=24, travel=3600)["omega"][-1] == pytest.approx(found["omega"][0], rel=1e-6)
    assert 1 < moved(scene)["run_up"]["turns"] < 5


def test_loads_that_jump_have_both_their_values() -> None:
    """Under a moment that jumps inside a strip the energy is that of both parts, and the speed goes on without a jump.
    """
    steps = [[0, 400], [114.5, 400], [114.5, -900], [360, -900]]
    found = moved(WHEEL.replace("moments", [{"on": "1", "over": "travel", "values": steps}]), speed=9, positions=36)
    travel = np.array(found["travel"])
    energy = 405 + np.radians(np.minimum(travel, 114.5) * 400 - np.maximum(travel - 114.5, 0) * 900)
    known = energy > 0
    assert [value is not None for value in found["omega"]] == [*known]
    assert np.array(found["omega"])[known].astype(float) == pytest.approx(np.sqrt(energy[known] / 5), rel=1e-11)


def test_the_hydraulic_loader() -> None:
    """Ozols, example 13-7: weight and arm of the cylinder as printed in table 13-1, the speed by steps of two degrees
    as there (9 percent high at first), and the accurate motion, whose time is 2 percent longer."""
    loader = gp.load("ozols-13-7").replace("moments", [])
    weight = {"on": "1", "at": "C", "value": [0, -187.0503597]}
    push = {"on": "2", "at": "B", "direction": "A B", "over": "travel", "values": [[0, -1], [90, -1]]}
    weights, arms = (np.array(moved(loader.replace("forces", [weight, *more]), travel=81.5, positions=163)["moment"])
                     for more in ([], [push]))
    for degrees, turned, arm in ((2, 357.945, 0.351934), (4, 370.890, 0.365529), (80, 443.373, 0.641063),
                                 (81.5, 436.108, 0.638036)):
        assert weights[round(2 * degrees)] / KGF == pytest.approx(turned, abs=2e-3)
        assert abs(arms - weights)[round(2 * degrees)] / KGF == pytest.approx(arm, abs=6e-6)
    found = moved("ozols-13-7", travel=81.5, positions=163)
    assert [found["omega"][k] for k in (0, 4, 8, 12, 163)] == pytest.approx(
        [0, 0.3161, 0.4241, 0.4933, 0.32778], abs=5e-5)
    assert found["time"][-1] == pytest.approx(3.423, abs=5e-4)
    for degrees, speed in ((6, 0.518945), (80, 0.329017)):  # 0.518986 is printed, by a slip at 4 degrees
        strips = moved("ozols-13-7", travel=degrees, positions=degrees // 2)["strips"]
        assert strips["euler"]["omega"] == pytest.approx(speed, abs=4e-6)


@pytest.mark.parametrize(("name", "travel"), [("four-bar", 200), ("shaper", 200), ("planetary", 200),
                                              ("roller-cam", 200), ("five-bar", 90), ("plough-lift", 20)])
def test_any_mechanism(name: str, travel: float) -> None:
    """Mechanisms of all kinds, with drives that turn clockwise, slide, or are two, with masses, a force and a motor
    over the speed of the first drive: both opinions agree to 1e-9, and the energy is that of the speed."""
    scene = gp.load(name, by_drive=True)
    last, drive = scene.moving[-1], scene.drives[0]
    masses = {link: {"mass": 2, "inertia": 0.1, "centre": scene.links[link][-1]} for link in scene.moving}
    scene = scene.replace("masses", masses).replace(
        "forces", [{"on": last, "at": scene.links[last][0], "value": [3, -2]}])
    if not drive.slides:
        sense = 1 if drive.rate > 0 else -1
        scene = scene.replace("moments", [{"on": drive.link, "over": "speed", "powers": [9 * sense, -0.2 * sense]}])
    found = moved(scene, speed=20, travel=travel, positions=8)
    assert found["stop"] is None
    assert all(b > a for a, b in pairwise(found["time"]))
