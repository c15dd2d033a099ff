"""The command line as users meet it: output, exit statuses, faults in one line each, files whole or untouched."""

from __future__ import annotations

import io
import json
from fractions import Fraction
from pathlib import Path
from xml.etree import ElementTree

import pytest
from command_line import run
from four_bars import four_bar

from graphplan.commands import SUBCOMMANDS
from graphplan.mechanism.scene import packaged_names

FOUR_BAR = four_bar(head='title = "Four-bar"\n')

DEAD_CENTRE = FOUR_BAR.replace('link = "1"', 'link = "3"').replace("B = [130, 90]", "B = [90, 120]")

PARALLEL_GUIDES = """
[points]
O = [0, 0]
A = [20, 10]
B = [60, 30]
[links]
1 = "O A"
2 = "B"
3 = "B"
frame = "O"
[[slides]]
link = "2"
along = "1"
at = "B"
direction = [2, 1]
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [4, 2]
[[drive]]
link = "1"
omega = 2.0
"""

C_ON_QR = """
[points]
K = [0, 0]
A = [40, 40]
L = [120, 0]
B = [80, 40]
C = [70, 80]
D = [100, 80]
M = [120, 60]
E = [140, 100]
N = [180, 100]
[links]
1 = "K A"
2 = "L B"
3 = "A B C"
4 = "C D E"
5 = "M D"
6 = "N E"
[motion]
K = { velocity = [1, 2] }
L = { velocity = [1, -1] }
M = { velocity = [0, 1] }
N = { velocity = [2, 1] }
"""

SINGULAR = {  # scene, the links that are named, what the line says of the lines that miss
    "dead centre": (DEAD_CENTRE, "1, 2", "the parallel to"),
    "parallel guides": (PARALLEL_GUIDES, "2, 3", "the perpendicular to the guide through"),
    "C on the line of Q and R": (C_ON_QR, "1, 2, 3, 4, 5, 6", "the locus of the end of C"),
}

BAD = {  # what replaces what in the four-bar, what the line must say
    "unknown key": ("[[drive]]", "colour = 1\n[[drive]]", "colour"),
    "point that no link has": ("C = [150, 0]", "C = [150, 0]\nZ = [1, 1]", "points.Z"),
    "misspelt point": ('2 = "A B"', '2 = "A BB"', "B"),
    "no drive": ('[[drive]]\nlink = "1"\nomega = 2.0', "", "mobility 1"),
    "coincident joints": ("B = [130, 90]", "B = [30, 40]", "links.2"),
    "not a number": ("B = [130, 90]", 'B = [130, "high"]', "points.B"),
    "nan": ("B = [130, 90]", "B = [130, nan]", "points.B"),
    "wrong unit": ("[points]", '[units]\nlength = "furlong"\n[points]', "units.length"),
    "broken TOML": ("[points]", "[points", "line"),
    "arcs that do not meet": ("B = [130, 90]", 'B = { distances = { A = 10, C = 10 }, side = "left" }', "points.B"),
}


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(FOUR_BAR)
    return path


@pytest.mark.parametrize("fault", sorted(BAD))
@pytest.mark.parametrize("command", ["draw", "steps", "solve", "check"])
def test_bad_input_is_one_line_a_fault_and_status_2(
    fault: str, command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A fault in the scene is told in one line with file and place; nothing is written, and the status is 2."""
    old, new, said = BAD[fault]
    path = tmp_path / "scene.toml"
    path.write_text(FOUR_BAR.replace(old, new))
    output = tmp_path / "sheet.svg"
    output.write_text("kept")
    extra = ["-o", str(output)] if command == "draw" else []
    assert run(command, str(path), *extra) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert output.read_text() == "kept"
    assert said in streams.err
    assert all(line.startswith(f"{path}: ") and "; " in line for line in streams.err.splitlines())


def test_near_names_are_suggested(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A misspelt name is answered with the one that was meant."""
    path = tmp_path / "scene.toml"
    path.write_text(FOUR_BAR.replace('link = "1"', 'lnk = "1"'))
    assert run("solve", str(path)) == 2
    assert "link" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["nosuch.toml", ".", "empty.toml", "binary.toml"])
def test_files_that_hold_no_scene(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Missing, empty and binary files and folders are told in one line with status 2."""
    (tmp_path / "empty.toml").write_text("")
    (tmp_path / "binary.toml").write_bytes(bytes(range(256)))
    assert run("solve", str(tmp_path / name)) == 2
    assert capsys.readouterr().err.count("\n") >= 1


@pytest.mark.parametrize("pose", sorted(SINGULAR))
@pytest.mark.parametrize("exact", [[], ["--exact"]], ids=["floats", "fractions"])
def test_singular_poses_are_named(pose: str, exact: list[str], monkeypatch: pytest.MonkeyPatch,
                                  capsys: pytest.CaptureFixture[str]) -> None:
    """A singular pose gives status 3 and one line with the links and the two lines that should meet."""
    text, links, lines = SINGULAR[pose]
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
    assert run("solve", "-", *exact) == 3
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.count("\n") == 1
    assert f"links {links}:" in streams.err
    assert lines in streams.err
    assert "should meet" in streams.err


@pytest.mark.parametrize("pose", sorted(SINGULAR))
def test_a_singular_pose_is_not_drawn(pose: str, tmp_path: Path) -> None:
    """No sheet is made of a singular pose, and one that is there stays."""
    path, output = tmp_path / "scene.toml", tmp_path / "sheet.svg"
    path.write_text(SINGULAR[pose][0])
    assert run("draw", str(path), "-o", str(output)) == 3
    assert not output.exists()


def test_solve_prints_the_contract(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`solve` prints points, links, method, check and steps as JSON."""
    assert run("solve", str(scene)) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["units"] == {"length": "mm", "force": "N", "mass": "kg"}
    assert data["points"]["A"]["velocity"] == [-80.0, 60.0]
    assert data["links"]["1"]["omega"] == pytest.approx(2.0)
    assert data["check"]["velocity"] <= 1e-12
    assert data["steps"] > 10
    assert set(data["method"]) == {"velocity", "acceleration"}


def test_exact_numbers_are_strings(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With --exact every number is a string p/q, and the check is 0."""
    assert run("solve", str(scene), "--exact") == 0
    data = json.loads(capsys.readouterr().out)
    assert [Fraction(n) for n in data["points"]["A"]["velocity"]] == [-80, 60]
    assert all(isinstance(n, str) for point in data["points"].values() for pair in point.values() for n in pair)
    assert data["check"] == {"velocity": 0, "acceleration": 0}


def test_only_what_was_asked_is_printed(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """[find] narrows the output to what it names."""
    scene.write_text(FOUR_BAR + '[find]\nvelocity = ["B"]\n')
    assert run("solve", str(scene)) == 0
    data = json.loads(capsys.readouterr().out)
    assert set(data["points"]) == {"B"}
    assert set(data["points"]["B"]) == {"velocity"}
    assert set(data["method"]) == set(data["check"]) == {"velocity"}


def test_check_shows_both_and_the_structure(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`check` names the Assur groups and sets construction beside solver."""
    assert run("check", str(scene)) == 0
    text = capsys.readouterr().out
    assert "dyad RRR, modification 1" in text
    assert "analytic solver" in text


def test_a_disagreement_is_status_1(scene: Path, capsys: pytest.CaptureFixture[str],
                                    monkeypatch: pytest.MonkeyPatch) -> None:
    """If construction and solver disagree, `check` says so and its status is 1."""
    monkeypatch.setattr("graphplan.methods.motion.time_scale.Tempo.rate", lambda self, omega: 2 * omega / self.unit)
    assert run("check", str(scene)) == 1
    assert "disagree" in capsys.readouterr().err


def test_steps_are_numbered_sentences(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`steps` numbers its sentences from 1 without a gap, in the letters of the scene."""
    assert run("steps", str(scene)) == 0
    text = capsys.readouterr().out
    numbers = [int(line.split(".")[0]) for line in text.splitlines() if line.strip()[:1].isdigit() and ". " in line[:8]]
    assert numbers == list(range(1, len(numbers) + 1))
    assert "Mark v_b where" in text


def test_steps_as_data_name_what_they_read(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`steps --json` gives each step with what it makes and reads, its instrument and its sentence."""
    assert run("steps", str(scene), "--json") == 0
    data = json.loads(capsys.readouterr().out)
    made = {step["makes"] for step in data["steps"]}
    assert {"A", "v_b", "b", "B_1"} <= made
    assert all(set(step["reads"]) <= made for step in data["steps"])
    assert all(step["instrument"] and step["sentence"] for step in data["steps"])


def test_strict_steps_need_no_set_square(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`--strict` leaves compasses and straightedge, and what lays off given numbers."""
    assert run("steps", str(scene), "--json", "--strict") == 0
    data = json.loads(capsys.readouterr().out)
    assert not {step["instrument"] for step in data["steps"]} & {"set squares"}
    assert "simplicity" in data["cost"]


@pytest.mark.parametrize("plan", ["orthogonal", "polar"])
def test_draw_writes_a_valid_sheet(plan: str, scene: Path, tmp_path: Path) -> None:
    """`draw` writes valid SVG in true millimetres, the same on repetition."""
    sheets = []
    for name in ("one.svg", "two.svg"):
        assert run("draw", str(scene), "--plan", plan, "-o", str(tmp_path / name)) == 0
        sheets.append((tmp_path / name).read_bytes())
    assert sheets[0] == sheets[1]
    root = ElementTree.fromstring(sheets[0])
    assert root.get("width", "").endswith("mm")


def test_an_output_that_cannot_be_written(scene: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file in the place of a folder is said in one line, with status 2."""
    assert run("draw", str(scene), "-o", str(scene / "sheet.svg")) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert run("draw", str(scene), "-o", str(tmp_path)) == 2


def test_every_command_shows_examples(capsys: pytest.CaptureFixture[str]) -> None:
    """`--help` ends with examples, for the whole and for every command."""
    for command in ([], ["draw"], ["steps"], ["solve"], ["check"], ["gallery"]):
        assert run(*command, "--help") == 0
        assert "examples:" in capsys.readouterr().out


def test_help_lists_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    """`--help` names every command, though a call loads but one of them."""
    assert run("--help") == 0
    said = capsys.readouterr().out
    assert all(f"\n    {name} " in said for name in SUBCOMMANDS)


@pytest.mark.parametrize("name", packaged_names())
def test_packaged_scenes_are_named_without_a_path(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Every packaged scene is solved by its bare name."""
    assert run("solve", name) == 0
    capsys.readouterr()
