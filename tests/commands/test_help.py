"""The command line by its conventions: how much there is of it, what it says of slips of the pen, and what it tells."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

import pytest

from graphplan.commands import GROUPS, SUBCOMMANDS, command_parser, main, overview
from graphplan.mechanism.scene import load

MAX_OPTIONS, MAX_LINES = 80, 80


def option_meaning(action: argparse.Action) -> tuple[object, ...]:
    """What an option is to who learns it: its names, what it takes, and out of what."""
    return *action.option_strings, type(action), action.metavar, *(action.choices or ())


def test_there_are_not_too_many_options() -> None:
    """All commands together have at most 80 options to learn, besides -h: one that means the same in several commands
    is learnt once, and one name with two meanings counts twice."""
    meanings = {option_meaning(action) for name in SUBCOMMANDS for action in command_parser(name)._actions
                if action.option_strings and not isinstance(action, argparse._HelpAction)}
    assert len(meanings) <= MAX_OPTIONS


@pytest.mark.parametrize("name", SUBCOMMANDS)
def test_help_fits_two_screens(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The help of a command has at most 80 lines in a terminal of 80 columns."""
    monkeypatch.setenv("COLUMNS", "80")
    assert len(command_parser(name).format_help().splitlines()) <= MAX_LINES


def test_commands_stand_in_groups() -> None:
    """Each command is in one group; the help has the groups in their order, and every command once."""
    assert sorted(name for names in GROUPS.values() for name in names) == sorted(SUBCOMMANDS)
    text = overview().format_help()
    places = [text.index(f"\n  {group}:\n") for group in GROUPS]
    assert places == sorted(places)
    assert all(text.count(f"\n    {name} ") == 1 for name in SUBCOMMANDS)


@pytest.mark.parametrize(("words", "beginning"), [(["help"], "usage: graphplan [-h]"),
                                                  (["help", "draw"], "usage: graphplan draw")])
def test_help_is_a_command(words: list[str], beginning: str, capsys: pytest.CaptureFixture[str]) -> None:
    """`help` prints what --help prints, of all or of a command."""
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith(beginning)


@pytest.mark.parametrize(("words", "line"), [
    (["draw", "four-bar", "--langauge", "de"], "graphplan draw --langauge: unknown option; perhaps --language"),
    (["solve", "four-bar", "--exakt"], "graphplan solve --exakt: unknown option; perhaps --exact"),
    (["draw", "four-bar", "--frame", "gost"], "--set sheet.frame=VALUE"),
    (["flywheel", "ozols-13-6", "--closes", "load"], "--set flywheel.closes=VALUE"),
    (["draw", "four-bar", "--set", "sheet.frame"], "--set sheet.frame: no value is given"),
    (["draw", "four-bar", "--set", "points.Z.0=3"], "points.Z.0: nothing stands at Z; one of O, A, B, C, M"),
    (["solve", "four-bar", "five-bar"], "one word too many"),
    (["-q", "solve", "four-bar"], "graphplan -q: no command is named before it; graphplan COMMAND ... -q"),
    (["new", "x.toml", "--from", "shapper"], "--from shapper: no packaged scene has this name; perhaps shaper"),
])
def test_slips_are_answered(words: list[str], line: str, capsys: pytest.CaptureFixture[str]) -> None:
    """One line says what is wrong and what is probably meant, or where an option went."""
    assert main(words) == 2
    told = capsys.readouterr().err
    assert line in told
    assert told.count("\n") == 1


def test_files_that_are_written_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each on a line of standard error; none with -q, and none of standard output or a device."""
    sheet = tmp_path / "deep" / "sheet.svg"
    words = ["draw", "slider-crank", "--paper", "A3"]
    assert main([*words, "-o", str(sheet)]) == 0
    written = sorted(str(path) for path in sheet.parent.iterdir())
    assert sorted(capsys.readouterr().err.splitlines()) == [f"{path}: written" for path in written]
    for quiet in (["-o", str(sheet), "-q"], ["-o", os.devnull], []):
        assert main([*words, *quiet]) == 0
        assert capsys.readouterr().err == ""


def test_a_packaged_scene_is_copied(tmp_path: Path) -> None:
    """`new --from` writes a packaged scene as a file of one's own."""
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "--from", "shaper"]) == 0
    assert path.read_text(encoding="utf-8") == load("shaper").text
    assert main(["new", str(path), "--from", "shaper"]) == 2


@pytest.mark.parametrize("at", [["--at", "-3,1.5"], ["--at", "-3", "1.5"], ["--at=-3,1.5"]])
def test_travels_below_zero_are_values(at: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """A list that begins below zero is no option."""
    assert main(["solve", "five-bar", *at]) == 0
    assert json.loads(capsys.readouterr().out)["pose"]["travel"] == [-3.0, 1.5]
