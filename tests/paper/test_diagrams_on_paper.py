"""The drawings of flywheels, motions, balances, rotors, governors, cams and syntheses can be executed on paper too."""

from __future__ import annotations

import io
import json
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import pytest
from protocol_faults import faults

from graphplan.commands import main
from graphplan.commands.new import template
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names

ROTOR = """
title = "Rotor"
[rotor]
planes = [0, 600]
masses = [{ mass = 0.5, radius = 100, angle = 0, at = 200 }, { mass = 0.3, radius = 80, angle = 100, at = 400 }]
"""
CAM = """
title = "Cam"
[[law]]
angle = 120
motion = "harmonic"
stroke = {stroke}
[[law]]
angle = 60
motion = "dwell"
[[law]]
angle = 90
motion = "parabolic"
stroke = -{stroke}
[[law]]
angle = 90
motion = "dwell"
[follower]
{follower}
[cam]
turns = "clockwise"
rpm = 300
base = {base}
"""
ROLLER = 'moves = "translating"\ncontact = "roller"\nradius = 8\noffset = 6'
FLAT = 'moves = "translating"\ncontact = "flat"'
ROCKER = 'moves = "oscillating"\ncontact = "roller"\nradius = 6\narm = 80\ncentre_distance = 100'
CAMS = {"roller": CAM.format(stroke=25, follower=ROLLER, base=50), "flat": CAM.format(stroke=8, follower=FLAT, base=60),
        "rocker": CAM.format(stroke=20, follower=ROCKER, base=45)}  # fmt: skip


def executed(path: Path, *arguments: str) -> tuple[list[str], int]:
    """What is wrong with the steps that a command gives, and how many there are."""
    out = path / "numbers.json"
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        assert main([*arguments, "--steps", "-q", "-o", str(out)]) == 0
    told: dict[str, Any] = json.loads(out.read_text("utf-8"))["protocol"]
    return faults({**told, "entries": [], "readings": []}, told["paper"]), len(told["steps"])


@pytest.mark.parametrize("arguments", [("flywheel", "ozols-13-6"), ("motion", "ozols-13-7"), ("balance", "ozols-16-1")])
def test_diagrams_of_machines_can_be_executed(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    """Every mark of a flywheel's, a motion's and a linkage's sheet lies where a reader draws it."""
    wrong, count = executed(tmp_path, *arguments)
    assert (wrong, count > 5) == ([], True)


def test_polygons_of_a_rotor_can_be_executed(tmp_path: Path) -> None:
    """So does every mark of a rotor's polygons."""
    task = tmp_path / "rotor.toml"
    task.write_text(ROTOR, "utf-8")
    wrong, count = executed(tmp_path, "balance", str(task))
    assert (wrong, count > 5) == ([], True)


def test_the_characteristic_of_a_governor_can_be_executed(tmp_path: Path) -> None:
    """So does every mark of a governor's characteristic."""
    scene = tmp_path / "governor.toml"
    scene.write_text(template("governor"), "utf-8")
    wrong, count = executed(tmp_path, "balance", str(scene))
    assert (wrong, count > 25) == ([], True)


@pytest.mark.parametrize("kind", CAMS)
def test_inversions_of_cams_can_be_executed(tmp_path: Path, kind: str) -> None:
    """So does every mark of a cam, whatever its follower."""
    task = tmp_path / "cam.toml"
    task.write_text(CAMS[kind], "utf-8")
    wrong, count = executed(tmp_path, "cam", str(task))
    assert (wrong, count > 50) == ([], True)


@pytest.mark.parametrize("name", packaged_names(TASK_FOLDER))
def test_syntheses_can_be_executed(tmp_path: Path, name: str) -> None:
    """So does every mark of a packaged synthesis."""
    wrong, count = executed(tmp_path, "synthesize", name)
    assert (wrong, count > 2) == ([], True)


def test_steps_are_for_json_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A sheet has its steps in words: the option is refused there, and nothing is written."""
    out = tmp_path / "sheet.svg"
    assert main(["motion", "ozols-13-7", "--steps", "-o", str(out)]) == 2
    assert "--steps" in capsys.readouterr().err
    assert not out.exists()
