"""Machines, cams and cycles that were refused or read at two travels: each gives what is right."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import pytest

from graphplan.commands import main
from graphplan.machine.flywheel.result import flywheel
from graphplan.mechanism.scene import parse

HERE = Path(__file__).parent / "paper"


def printed(capsys: pytest.CaptureFixture[str], command: str, name: str, *options: str) -> str:
    """What a command prints of a scene; it must be done without complaint."""
    status = main([command, str(HERE / f"{name}.toml"), *options])
    text = capsys.readouterr()
    assert status == 0, text.err
    return text.out


def test_a_weight_on_a_horizontal_guide_changes_no_flywheel(capsys: pytest.CaptureFixture[str]) -> None:
    """The engine has the flywheel that it has without gravity: the piston's weight does no work."""
    found = json.loads(printed(capsys, "flywheel", "flywheel-horizontal-engine"))
    text = (HERE / "flywheel-horizontal-engine.toml").read_text().replace("gravity = [0, -9.81]", "")
    weightless = flywheel(parse(text, "engine", by_drive=True))
    assert weightless.scene.loads is not None
    assert not any(weightless.scene.loads.gravity)
    assert found["flywheel"]["inertia"] == pytest.approx(weightless.wheel.inertia, rel=1e-12)


@pytest.mark.parametrize("name", ["flywheel-gravity", "flywheel-horizontal-engine"])
def test_machines_with_weights_across_a_guide_run(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Flywheel and motion are found; the speeds are as uneven as was asked for."""
    wheel, motion = (json.loads(printed(capsys, command, name)) for command in ("flywheel", "motion"))
    assert wheel["flywheel"]["inertia"] > 0
    fast, slow = max(motion["omega"]), min(motion["omega"])
    assert 2 * (fast - slow) / (fast + slow) == pytest.approx(wheel["unevenness"], rel=0.02)


@pytest.mark.parametrize("name", ["cam-crosses-itself", "cam-crosses-itself-roller"])
def test_cams_with_dwells_are_made(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A profile whose pieces meet to rounding does not cross itself."""
    printed(capsys, "cam", name, "-o", str(tmp_path / "cam.svg"))
    assert (tmp_path / "cam.svg").stat().st_size > 1000


def test_a_yoke_drawn_at_its_dead_point_goes_round(capsys: pytest.CaptureFixture[str]) -> None:
    """Pin and yoke that coincide in the scene go their own ways: x = r cos phi, v = -omega r sin phi."""
    rows = [*csv.DictReader(io.StringIO(printed(capsys, "cycle", "cycle-coincident-points", "--positions", "12")))]
    assert not any(row["fault"] for row in rows)
    for k, row in enumerate(rows):
        phi = math.radians(30 * k)
        assert float(row["B.x [mm]"]) == pytest.approx(20 * math.cos(phi), abs=1e-12)
        assert float(row["B.vx [mm/s]"]) == pytest.approx(-200 * math.sin(phi), abs=1e-10)
        assert float(row["A.vy [mm/s]"]) == pytest.approx(200 * math.cos(phi), abs=1e-10)


def test_a_table_has_one_row_at_a_travel(capsys: pytest.CaptureFixture[str]) -> None:
    """At 30 degrees of a drive that turns clockwise `solve`, `cycle` and `flywheel` balance the row of 30."""
    name = "travel-two-senses"
    solved = json.loads(printed(capsys, "solve", name, "--at", "30"))
    rows = [*csv.DictReader(io.StringIO(printed(capsys, "cycle", name, "--positions", "12")))]
    reduced = dict(json.loads(printed(capsys, "flywheel", name))["reduced_moment"])
    assert solved["balance"]["moment"] == pytest.approx(-30)
    assert float(rows[1]["balance 1.M [N*m]"]) == pytest.approx(-30)
    assert reduced[30.0] == pytest.approx(-30)  # positive in the sense of motion
    assert solved["pose"]["travel"] == 30
    assert solved["pose"]["points"]["A"] == pytest.approx([0.2 * math.cos(math.pi / 6), -0.1])
