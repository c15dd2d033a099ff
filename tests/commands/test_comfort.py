"""The comforts of the command line: new scenes, the list, near names, quiet, data, colour where someone looks on."""

from __future__ import annotations

import json
import os
import pty
import re
import subprocess
import sys
import tomllib
from fractions import Fraction
from pathlib import Path

import pytest

from graphplan import __version__
from graphplan.commands import main
from graphplan.commands.catalogue import fit_columns
from graphplan.commands.new import KINDS, LOADS, template
from graphplan.mechanism.scene import load, packaged_names, parse
from graphplan.mechanism.schema import scene

ROOT = Path(__file__).parent.parent.parent
OPTIONAL = re.compile(r"(?m)^#(?=\S)")


# --- new -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_scene_holds_as_it_stands(kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every kind of new scene is checked and drawn without a fault, and asks for something."""
    path = tmp_path / "scene.toml"
    assert main(["new", str(path), "--kind", kind]) == 0
    assert main(["check", str(path)]) == 0
    assert "velocity" in capsys.readouterr().out
    assert main(["draw", str(path), "-o", str(tmp_path / "sheet.svg")]) == 0


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_optional_holds_too(kind: str) -> None:
    """Each optional paragraph holds when its # are taken away, and so do all together."""
    paragraphs = template(kind).split("\n\n")
    optional = [k for k, paragraph in enumerate(paragraphs) if OPTIONAL.search(paragraph)]
    assert len(optional) >= 3
    for chosen in [*([k] for k in optional), optional]:
        text = "\n\n".join(OPTIONAL.sub("", part) if k in chosen else part for k, part in enumerate(paragraphs))
        assert tomllib.loads(text) != tomllib.loads(template(kind))
        parse(text, kind)


@pytest.mark.parametrize("left_out", [load for load in LOADS if load != "balance"])
def test_loads_may_be_left_out(left_out: str) -> None:
    """Of the paragraph of loads any table but the balance may be left out."""
    text = OPTIONAL.sub("", template("four-bar"))
    shorter = re.sub(rf"(?m)^\[+{left_out}[^\n]*\n(?:\w[^\n]*\n)+", "", text)
    assert shorter != text
    parse(shorter, "four-bar")


@pytest.mark.parametrize("kind", KINDS)
def test_every_section_is_explained(kind: str) -> None:
    """A new scene explains every section that a scene may have, in a line."""
    for name, section in scene()["properties"].items():
        assert re.search(rf"(?m)^#?{name}\b.* # {re.escape(section['description'])}|"
                         rf"^# {name}: {re.escape(section['description'])}", template(kind))


def test_nothing_is_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file that is there stays as it is, which is said in one line with status 2."""
    path = tmp_path / "scene.toml"
    path.write_text("mine")
    assert main(["new", str(path)]) == 2
    assert path.read_text() == "mine"
    assert capsys.readouterr().err.count("\n") == 1
    assert main(["new", str(path / "scene.toml")]) == 2


def test_folders_are_made(tmp_path: Path) -> None:
    """A file in a folder that is not there makes the folder."""
    path = tmp_path / "mine" / "today" / "scene.toml"
    assert main(["new", str(path)]) == 0
    assert main(["solve", str(path)]) == 0


# --- list ----------------------------------------------------------------------------------------------------------


def test_the_list_names_every_scene(capsys: pytest.CaptureFixture[str]) -> None:
    """`list` has a line for every packaged scene, with its title and source in full where no terminal bounds it."""
    assert main(["list"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines() if line}
    for name in packaged_names():
        assert load(name).title in lines[name]
        assert load(name).source in lines[name]


def test_the_list_as_data(capsys: pytest.CaptureFixture[str]) -> None:
    """`list --json` tells what each scene asks for."""
    assert main(["list", "--json"]) == 0
    asked = {entry["name"]: entry["asked"] for entry in json.loads(capsys.readouterr().out)}
    assert asked["four-bar"] == ["velocity", "acceleration"]
    assert "forces" in asked["jaanimets-10"]


@pytest.mark.parametrize("width", [40, 80, 120])
def test_the_list_fits_the_terminal(width: int) -> None:
    """On a terminal no line is longer than it is wide, and what is short is not cut."""
    rows = [("four-bar", "4", "v a", "Four-bar linkage with a coupler point", "A book of some length, page 1" * 3)] * 2
    lines = [*fit_columns(rows, width)]
    assert all(len(line) <= width for line in lines)
    assert all(line.startswith("four-bar  4  v a") for line in lines)
    assert [*fit_columns([("a", "1", "v", "short", "source")], width)] == ["a  1  v  short  source"]


# --- near names, version, help ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("words", "meant"), [(["slove", "four-bar"], "solve"), (["lst"], "list"),
                                              (["solve", "fourbar"], "four-bar"), (["draw", "traid"], "triad")])
def test_the_name_that_was_meant(words: list[str], meant: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A misspelt command or scene is answered with the one that was meant."""
    assert main(words) == 2
    told = capsys.readouterr().err
    assert f"perhaps {meant}" in told
    assert told.count("\n") == 1


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    """`--version` names the program and its version."""
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert not end.value.code
    assert capsys.readouterr().out == f"graphplan {__version__}\n"


def test_without_a_command_there_is_help(capsys: pytest.CaptureFixture[str]) -> None:
    """`graphplan` alone tells on standard error what there is, with status 2."""
    assert main([]) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert "examples:" in streams.err


# --- data ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["four-bar", "jaanimets-10", "kinytskyi"])
def test_check_as_data(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """`check --json` sets the construction beside the solver, and says whether they agree."""
    assert main(["check", name, "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["agrees"] is True
    agreeing = {kind: part for kind, part in data["results"].items() if not kind.endswith("with friction")}
    assert len(agreeing) >= 3
    for part in agreeing.values():  # those with friction are one round of many
        for both in part.values():
            assert both["construction"] == pytest.approx(both["solver"], rel=1e-9, abs=1e-9 * _largest(part))
    assert ("power balance" in data) == (name != "four-bar")
    assert ("efficiency" in data) == (name == "kinytskyi")


def _largest(part: dict[str, dict[str, object]]) -> float:
    """The largest number of one kind of result."""
    values = [both["solver"] for both in part.values()]
    return max(abs(n) for value in values for n in (value if isinstance(value, list) else [value]))


def test_check_as_exact_data(capsys: pytest.CaptureFixture[str]) -> None:
    """With --exact both opinions are the same fractions."""
    assert main(["check", "jaanimets-10", "--json", "--exact"]) == 0
    results = json.loads(capsys.readouterr().out)["results"]
    velocity = results["velocity"]["B"]
    assert velocity["construction"] == velocity["solver"]
    assert all(isinstance(number, str) and Fraction(number) for number in velocity["solver"])


# --- what is told on standard error -------------------------------------------------------------------------------


def on_terminal(*arguments: str, **environment: str) -> str:
    """What a command tells on a standard error that is a terminal."""
    ours, theirs = pty.openpty()
    plain = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
    process = subprocess.Popen([sys.executable, "-m", "graphplan", *arguments], cwd=ROOT, stderr=theirs,
                               stdout=subprocess.DEVNULL, env={**plain, **environment})
    os.close(theirs)
    told = b""
    try:
        while part := os.read(ours, 65536):
            told += part
    except OSError:  # so the other end closes
        pass
    process.wait()
    os.close(ours)
    return told.decode()


def test_errors_are_red_on_a_terminal() -> None:
    """An error is red on a terminal, unless NO_COLOR is set."""
    told = on_terminal("solve", "fourbar")
    assert told.startswith("\x1b[31m")
    assert "perhaps four-bar" in told
    assert told.rstrip().endswith("\x1b[0m")
    assert "\x1b" not in on_terminal("solve", "fourbar", NO_COLOR="1")
    assert "\x1b[31m" in on_terminal("solve")


def test_progress_is_told_on_a_terminal() -> None:
    """Long work tells how far it is on a terminal, unless it is to be quiet."""
    long = "cycle", "four-bar", "--positions", "5000"
    assert re.search(r"\r[a-z]+: \d+ of 5000", on_terminal(*long))
    assert on_terminal(*long, "--quiet") == ""


def test_elsewhere_errors_are_plain(capsys: pytest.CaptureFixture[str]) -> None:
    """Where no terminal is there is neither colour nor progress."""
    assert main(["cycle", "four-bar", "--positions", "5000"]) == 0
    assert main(["solve", "fourbar"]) == 2
    told = capsys.readouterr().err
    assert "\r" not in told
    assert "\x1b" not in told
    assert "5000 of 5000 poses" in told


def test_quiet_leaves_errors(capsys: pytest.CaptureFixture[str]) -> None:
    """With --quiet remarks are left out, and errors told."""
    assert main(["cycle", "four-bar", "--positions", "24", "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    assert main(["solve", "fourbar", "--quiet"]) == 2
    assert capsys.readouterr().err != ""


@pytest.mark.parametrize("command", ["check", "solve"])
def test_a_disagreement_is_told_even_so(command: str, capsys: pytest.CaptureFixture[str],
                                        monkeypatch: pytest.MonkeyPatch) -> None:
    """That construction and solver disagree is no remark."""
    monkeypatch.setattr("graphplan.methods.motion.time_scale.Tempo.rate", lambda self, omega: 2 * omega / self.unit)
    assert main([command, "four-bar", "--quiet"]) == 1
    assert "disagree" in capsys.readouterr().err
