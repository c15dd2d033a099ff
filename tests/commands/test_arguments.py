"""Values that begin with a minus sign are values, and travels may be words of their own."""

from __future__ import annotations

import json

import pytest
from command_line import run

from graphplan.commands.__init__ import with_values_joined

JOINED = {
    "solve five-bar --at -3,1.5": "solve five-bar --at=-3,1.5",
    "solve five-bar --at 60 -30": "solve five-bar --at=60,-30",
    "solve five-bar --at 60, -30": "solve five-bar --at=60,-30",
    "solve --at=60 -1/3 five-bar": "solve --at=60,-1/3 five-bar",
    "solve --at 60 4-bar.toml": "solve --at=60 4-bar.toml",
    "solve four-bar --at \u221230": "solve four-bar --at=-30",
    "cycle four-bar --from -.5e1 --to -inf -o -": "cycle four-bar --from=-.5e1 --to=-inf -o -",
    "solve four-bar --at outer": "solve four-bar --at outer",
    "solve -- --at -3 -4": "solve -- --at -3 -4",
}


@pytest.mark.parametrize("line", JOINED)
def test_numbers_below_zero_go_with_their_option(line: str) -> None:
    """A number below zero belongs to the option before it; the travels of --at are one list; all else stays."""
    assert with_values_joined(line.split()) == JOINED[line].split()


@pytest.mark.parametrize("words", [["--at", "-3,1.5"], ["--at", "-3", "1.5"], ["--at=-3,1.5"]])
def test_a_pose_of_two_drives_is_asked_for_in_any_spelling(words: list[str],
                                                           capsys: pytest.CaptureFixture[str]) -> None:
    """A list of travels that begins with a minus sign, as one word, as two, and with an equals sign."""
    assert run("solve", "five-bar", *words) == 0
    assert json.loads(capsys.readouterr().out)["pose"]["travel"] == [-3, 1.5]


def test_what_is_no_travel_is_one_clear_line(capsys: pytest.CaptureFixture[str]) -> None:
    """A word that is not a number, and more travels than drives, are named."""
    assert run("solve", "four-bar", "--at", "-3", "-x") == 2
    assert run("solve", "four-bar", "--at", "-3", "5") == 2
    option, travels = capsys.readouterr().err.splitlines()
    assert "-x" in option
    assert travels.startswith("--at -3, 5: the scene has 1 drive")
