"""`graphplan motion` on scenes: what it prints agrees with Ozols and with its schema, or it says why nothing moves."""

from __future__ import annotations

import csv
import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphplan.commands import main
from graphplan.commands.schema import result_schema
from graphplan.machine.motion.driven import driven_machine
from graphplan.machine.reduced.reduction import reduction
from graphplan.mechanism.scene import load, parse, source_text

jsonschema = pytest.importorskip("jsonschema")

YOKE = source_text("ozols-13-6", "ozols-13-6")
DRIVEN = '[[moments]]\non = "1"\nvalue = {}\n[balance]'


def yoke(tmp_path: Path, loads: str, omega: float = 0.0, more: str = "") -> str:
    """Ozols' yoke from its dead point, with more loads, driven at a speed and without a flywheel."""
    head, _, tail = YOKE.partition("[flywheel]")
    text = head + tail[tail.index("[find]"):] + more
    for old, new in (("angle = 60", "angle = 0"), ("[0.5, 0]", "[0.6, 0]"), ("[0.7, 0]", "[0.8, 0]"),
                     ("omega = 15", f"omega = {omega}"), ("[balance]", loads)):
        assert old in text
        text = text.replace(old, new)
    file = tmp_path / "yoke.toml"
    file.write_text(text)
    return str(file)


def motion(tmp_path: Path, scene: str, *options: str) -> dict[str, Any]:
    """What the command writes for a scene, as its schema has it."""
    file = tmp_path / "motion.json"
    assert main(["motion", scene, "-q", "-o", str(file), *options]) == 0
    found: dict[str, Any] = json.loads(file.read_text())
    jsonschema.validate(found, result_schema("motion"))
    assert max(found["check"].values()) < 1e-9
    return found


def test_run_up(tmp_path: Path) -> None:
    """The yoke under 400 N m from rest; the drawing is off by no more than it says, and less with more strips."""
    scene = yoke(tmp_path, DRIVEN.format(400))
    found = motion(tmp_path, scene, "--travel", "180", "--positions", "18")
    assert found["travel"][::9] == pytest.approx([0, 90, 180])
    assert found["omega"][::9] == pytest.approx([0, 7.8223, 13.0892], abs=5e-5)
    assert found["time"][::9] == pytest.approx([0, 0.31914, 0.47720], abs=5e-6)
    assert found["acceleration"][0] == pytest.approx(40)
    assert found["stop"] is None
    for what in ("energy", "omega", "time"):
        gaps = [abs(one - other) for one, other in zip(found["drawn"][what], found[what], strict=True)]
        assert max(gaps) == pytest.approx(found["drawn"]["error"][what] * max(found[what]), rel=1e-6)
    finer = motion(tmp_path, scene, "--travel", "180", "--positions", "36")["drawn"]["error"]
    assert finer["omega"] < 0.3 * found["drawn"]["error"]["omega"] < 1e-3
    assert finer["time"] < 0.4 * found["drawn"]["error"]["time"] < 0.02


@pytest.mark.parametrize("options", [["--speed", "0", "--travel", "90"], []])
def test_sheet(tmp_path: Path, options: list[str]) -> None:
    """The sheet has the diagrams on one panel, and tells how they are drawn; of a steady cycle the origin is far away.
    """
    file = tmp_path / "motion.svg"
    scene = yoke(tmp_path, DRIVEN.format(400)) if options else "ozols-13-6"
    assert main(["motion", scene, "-q", "-o", str(file), "--positions", "12", *options]) == 0
    svg = "".join(page.read_text() for page in tmp_path.glob("motion*.svg"))
    assert 'data-plan="motion"' in svg
    for title in ("Energy-mass diagram", "Speed", "Mean slowness", "Time", *(["First strips"] if options else [])):
        assert f">{title}<" in svg
    assert ("mean proportional" in svg) == bool(options)


def test_steady_cycle_with_its_flywheel(tmp_path: Path) -> None:
    """With [flywheel] it is the steady cycle, as uneven as asked for, also where scaled loads close it."""
    found = motion(tmp_path, "ozols-13-6")
    assert found["steady"]
    assert found["speeds"]["unevenness"] == pytest.approx(1 / 30, rel=1e-9)
    assert found["speeds"]["arithmetic_mean"] == pytest.approx(15, rel=1e-9)
    assert found["flywheel"]["inertia"] == pytest.approx(49.3794, abs=1e-4)
    assert found["closing_moment"] == pytest.approx(400 / math.pi, rel=1e-9)
    table = '[flywheel]\nspeed = 15\nunevenness = 0.03333333333333333\ncloses = "load"\n'
    scaled = motion(tmp_path, yoke(tmp_path, DRIVEN.format(200), 15, table))
    assert scaled["speeds"]["unevenness"] == pytest.approx(0.03333333333333333, rel=1e-9)
    assert "closing_moment" not in scaled
    file = tmp_path / "cycle.csv"
    assert main(["motion", "ozols-13-6", "-o", str(file), "--positions", "6"]) == 0
    rows = list(csv.reader(file.read_text().splitlines()))
    assert rows[0][:3] == ["travel [deg]", "omega [rad/s]", "time [s]"]
    assert [float(row[0]) for row in rows[1:]] == pytest.approx([0, 60, 120, 180, 240, 300, 360])


def test_driving_moments_of_the_yoke(tmp_path: Path) -> None:
    """The moments that example 13-6 asks of the drive, running up at 35.8 rad/s^2 and at 15 rad/s; and with the former
    as a table over the travel the yoke runs up so."""
    machine = driven_machine(reduction(load("ozols-13-6")))
    degrees = np.arange(0, 181, 30)
    travel = np.radians((degrees - 60) % 360)  # the scene stands at 60 degrees

    def needed(at: Any, change: float, square: Any) -> Any:
        return machine.inertia(at) * change + machine.slope(at) * square / 2 - machine.moment(at, 0 * at)

    up = needed(travel, 35.8, 2 * 35.8 * np.radians(degrees))
    assert up == pytest.approx([358.0, 558.7, 768.5, 701.2, 378.9, 169.1, 358.0], abs=0.06)
    assert needed(travel, 0, 225) == pytest.approx([0, 489.7, 562.9, 200, -216.5, -289.7, 0], abs=0.06)
    fine = np.arange(0, 361, 5)
    values = needed(np.radians((fine - 60) % 360), 35.8, 2 * 35.8 * np.radians(fine))
    rows = ", ".join(f"[{at}, {value:.9g}]" for at, value in zip(fine, values, strict=True))
    table = f'[[moments]]\non = "1"\nover = "travel"\nvalues = [{rows}]\n[balance]'
    found = motion(tmp_path, yoke(tmp_path, table), "--travel", "180", "--positions", "12")
    assert found["acceleration"] == pytest.approx([35.8] * 13, abs=0.4)
    assert (found["omega"][-1], found["time"][-1]) == pytest.approx((14.998, 0.4190), abs=4e-3)


def test_stopping(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without a drive the yoke stops, and where is told; beyond nothing is known."""
    file = tmp_path / "stop.json"
    assert main(["motion", yoke(tmp_path, "[balance]", 8), "-o", str(file)]) == 0
    found = json.loads(file.read_text())
    stop = found["stop"]["travel"]
    assert 200 * (1 - math.cos(math.radians(stop))) == pytest.approx(320, rel=1e-9)
    assert [at for at, omega in zip(found["travel"], found["omega"], strict=True) if omega is None] == \
        [at for at in found["travel"] if at > stop]
    assert "the machine stops at" in capsys.readouterr().err


def test_characteristic(tmp_path: Path) -> None:
    """A motor over its speed runs the yoke up into a steady cycle, whose nominal speed it tells."""
    motor = '[[moments]]\non = "1"\nover = "speed"\nvalues = [[0, 1000], [20, 0], [40, -1000]]\n[balance]'
    scene = yoke(tmp_path, motor)
    found = motion(tmp_path, scene)
    assert found["nominal_omega"] == pytest.approx(20 - 400 / math.pi / 50, rel=1e-9)
    assert 1 < found["run_up"]["turns"] < 5
    scene = yoke(tmp_path, motor.replace("values = [[0, 1000], [20, 0], [40, -1000]]", "powers = [1000, -50]"))
    cycle = motion(tmp_path, scene, "--steady", "--speed", "10", "--positions", "4")
    assert cycle["omega"][0] == pytest.approx(cycle["omega"][-1], rel=1e-11)


@pytest.mark.parametrize(("name", "travel"), [("four-bar", 200), ("shaper", 200), ("planetary", 200),
                                              ("roller-cam", 200), ("five-bar", 90), ("plough-lift", 20)])
def test_any_mechanism(tmp_path: Path, name: str, travel: float) -> None:
    """Mechanisms of all kinds, with drives that turn clockwise, slide, or are two, with masses, a force and a motor
    over the speed of the first drive: both opinions agree to 1e-9."""
    scene = parse(source_text(name, name), name)
    last = scene.moving[-1]
    text = scene.text + "".join(f'[masses.{link}]\nmass = 2\ninertia = 0.1\ncentre = "{scene.links[link][-1]}"\n'
                                for link in scene.moving)
    drive, sense = scene.drives[0], 1 if scene.drives[0].rate > 0 else -1
    if not drive.slides:
        text += f'[[moments]]\non = "{drive.link}"\nover = "speed"\npowers = [{9 * sense}, {-0.2 * sense}]\n'
    text += f'[[forces]]\non = "{last}"\nat = "{scene.links[last][0]}"\nvalue = [3, -2]\n'
    file = tmp_path / "scene.toml"
    file.write_text(text)
    found = motion(tmp_path, str(file), "--speed", "20", "--travel", f"{travel}", "--positions", "8")
    assert found["stop"] is None
    assert all(b > a for a, b in pairwise(found["time"]))


@pytest.mark.parametrize(("loads", "options", "why"), [
    ("[balance]", [], "does not start"),
    (DRIVEN.format(400), ["--speed", "-3"], "below 0"),
    (DRIVEN.format(400), ["--travel", "0"], "is not greater than 0"),
    (DRIVEN.format(400), ["--steady", "--speed", "9"], "does not close"),
])
def test_refusals(tmp_path: Path, capsys: pytest.CaptureFixture[str], loads: str, options: list[str], why: str) -> None:
    """What does not move as is asked for is refused with the reason."""
    assert main(["motion", yoke(tmp_path, loads), *options]) == 2
    assert why in capsys.readouterr().err
