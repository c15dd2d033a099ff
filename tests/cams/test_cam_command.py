"""`graphplan cam`: a task as a sheet, as a drawing for CAD, as numbers and as a scene."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from test_base import BOTH, ROLLER, text

import graphplan as gp
from graphplan.commands import main
from graphplan.output.panelled import pages
from graphplan.sheet.plates.display import Text

FLAT = Path(__file__).parents[1] / "cases" / "strangers" / "poses" / "F7-cam-convex.toml"


@pytest.fixture(scope="module")
def task(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A task in a file."""
    file = tmp_path_factory.mktemp("cam") / "task.toml"
    file.write_text(text(f"{ROLLER}offset = 6\n", BOTH, "sine"))
    return file


@pytest.fixture(scope="module")
def written(task: Path) -> Callable[..., Path]:
    """What the command writes, by the ending of the file."""

    def write(ending: str, *options: str) -> Path:
        file = task.with_name(f"made.{ending}")
        assert main(["cam", str(task), "-q", "-o", str(file), *options]) == 0
        return file

    return write


def test_sheets_have_steps_and_panels(written: Callable[..., Path]) -> None:
    """The sheet has a group for each drawn step, its panels by name, and the words of the title block."""
    svg = written("svg").read_text()
    assert all(f'data-plan="{plan}"' in svg for plan in ("cam", "law", "centre"))
    assert svg.count('class="step"') > 150
    assert "Cam sheet" in svg
    assert written("svg").read_text() == svg


def test_a_flat_faced_cam_is_drawn_on_the_smallest_paper(tmp_path: Path) -> None:
    """Its steps, for which that has no room beside the figures, stand on pages of their own."""
    file, sheet = tmp_path / "flat.toml", tmp_path / "flat.svg"
    file.write_text(FLAT.read_text(encoding="utf-8").replace('base = "convex"', "base = 2.5"))
    assert main(["cam", str(file), "-q", "-o", str(sheet)]) == 0
    assert 'viewBox="0 0 420 297"' in sheet.read_text()
    assert sheet.with_name("flat-protocol.svg").exists()


def test_numbers_of_a_diagram_stand_apart(tmp_path: Path) -> None:
    """Where a dwell of three degrees ends, its end has a line and no number."""
    stages = (5, "dwell", 0), (100, "sine", 20), (3, "dwell", 0), (120, "sine", -20), (132, "dwell", 0)
    law = "".join(f'[[law]]\nangle = {angle}\nmotion = "{motion}"\n' + (f"stroke = {stroke}\n" if stroke else "")
                  for angle, motion, stroke in stages)
    file = tmp_path / "cam.toml"
    file.write_text(f'{law}[follower]\n{ROLLER}[cam]\nturns = "clockwise"\nrpm = 60\nbase = 60\n')
    sheet = pages(gp.cam(file).sheet)[0]
    boxes = [item.box.inset(0.05, 0.05, 0.05, 0.05) for item in sheet.items if isinstance(item, Text)]
    assert not [box for k, box in enumerate(boxes) if any(map(box.meets, boxes[:k]))]


def test_words_without_room_stand_on_a_page_of_their_own(written: Callable[..., Path]) -> None:
    """On paper that is too small for all words the steps follow on another page, as with other sheets."""
    first = written("svg", "--paper", "A4")
    steps = first.with_name("made-protocol.svg")
    assert "Base circle: radius" in first.read_text()
    assert "Construction" in steps.read_text()
    assert "Construction" not in first.read_text()


def test_numbers_are_those_of_the_law(written: Callable[..., Path]) -> None:
    """JSON has base circle, table, outline and checks; the table follows the law."""
    found = json.loads(written("json", "--positions", "12").read_text())
    assert found["cam"]["turns"] == "clockwise"
    assert math.dist((0, 0), (found["cam"]["offset"], found["cam"]["depth"])) == pytest.approx(
        found["cam"]["base_radius"])
    rows = {row["angle"]: row for row in found["positions"]}
    assert len(rows) == 12
    omega = found["cam"]["omega"]
    assert rows[60.0]["lift"] == pytest.approx(12.5)
    assert rows[60.0]["velocity"] == pytest.approx(2 * 25 / math.radians(120) * omega)
    assert found["pressure_angle"]["return"]["largest"] == pytest.approx(30)
    assert max(found["check"].values()) < 1e-6
    assert [step["step"] for step in found["steps"]] == list(range(1, len(found["steps"]) + 1))


def test_profiles_are_true_to_size(written: Callable[..., Path]) -> None:
    """The DXF has one closed polyline of arcs on the profile's layer, and the base circle."""
    ezdxf = pytest.importorskip("ezdxf")
    space = ezdxf.readfile(written("dxf", "--tolerance", "0.01")).modelspace()
    profile, = space.query('LWPOLYLINE[layer=="MECHANISM 1-1 profile"]')
    assert profile.closed
    low = min(np.hypot(x, y) for x, y, *_ in profile.get_points())
    circle, = space.query("CIRCLE")
    assert low == pytest.approx(circle.dxf.radius - 4, abs=0.01)
    assert written("dxf").read_bytes() == written("dxf").read_bytes()


def test_poses_are_solved(written: Callable[..., Path], capsys: pytest.CaptureFixture[str]) -> None:
    """The scene of a pose gives the law's velocity and acceleration."""
    pose = written("toml", "--at", "75")
    assert main(["solve", str(pose)]) == 0
    found = json.loads(capsys.readouterr().out)["points"]["A"]
    turn, omega = math.radians(120), 10 * math.pi
    part = 75 / 120 * 2 * math.pi
    assert found["velocity"] == pytest.approx([0, 25 / turn * omega * (1 - math.cos(part))], rel=1e-12)
    assert found["acceleration"] == pytest.approx(
        [0, 25 / turn**2 * omega**2 * 2 * math.pi * math.sin(part)], rel=1e-12)


@pytest.mark.parametrize(("options", "line"), [
    (["-o", "made.gif"],
     "-o made.gif: no cam is written as .gif; a name in .svg, .pdf, .png, .tex, .dxf, .json, .toml"),
    (["--at", "30"], "--at 30.0: it does not apply to a .svg; leave it out, or -o FILE.toml"),
    (["-o", "made.dxf", "--tolerance", "0"], "--tolerance: 0; give a length above 0, 1e-9 at least"),
])  # fmt: skip
def test_bad_options_are_refused(task: Path, options: list[str], line: str, capsys: pytest.CaptureFixture[str],
                                 monkeypatch: pytest.MonkeyPatch) -> None:
    """An option that has no use, or a value that is none, is one line and exit 2, and nothing is written."""
    monkeypatch.chdir(task.parent)
    assert main(["cam", str(task), *options]) == 2
    assert capsys.readouterr().err.splitlines() == [line]
    assert not Path("made.gif").exists()


def test_the_task_itself_is_kept(task: Path) -> None:
    """A task is not written over."""
    before = task.read_text()
    assert main(["cam", str(task), "-o", str(task)]) == 2
    assert task.read_text() == before
