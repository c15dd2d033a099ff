"""Options by chance: whatever words a command gets, it ends with a status and one line for what is wrong."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from random import Random

import pytest
from fuzzing import complaint, ran

from graphplan.commands import SUBCOMMANDS, parser
from graphplan.commands.choices import count

SCENES = ("four-bar", "four-bar", "slider-crank", "open-chain", "jaanimets-10", "no-such-scene", "", "-", ".", "é",
          "a\0b", "/dev/null")
PARTS, TRIES = 8, 240
LONG = {"chart": ["no-such-chart", "."], "gallery": ["/dev/null/site"], "watch": ["no-such-file"]}  # minutes in earnest
WORDS = ("", "-", "0", "-1", "1", "3", "12", "-0.5", "1.5", "nan", "inf", "-inf", "1e18", "1e400", "1" + "0" * 30, "9"
         * 5000, "1000000000", "x", "é", "\x1b[31m", "a\nb", "a\0b", "a,b", "=", ",", "--", "-x", "--nosuch", "all",
         "2-5", "5-2", "point=1", "point=nan", "point=-1,edge=2", "point=1e308", "right=1e9", "follows=inf",
         "numbers=0", "angle=44", "polar", "lever", "orthogonal,polygons", "polar,polar", "B.x", "3", "A4", "iso",
         "en", "en_US", "auxiliary")
FILES = ("-", "x.svg", "x.pdf", "x.png", "x.dxf", "x.csv", "x.npz", "x.html", "x.json", "x.gif", "x", "no/x.svg",
         "points.csv", "/dev/full", "/dev/null", "scene.toml", "x" * 300 + ".svg", "a\0b.svg", "é.svg", "x.SVG",
         "x.tex", "x.toml")


@cache
def commands() -> dict[str, list[argparse.Action]]:
    """The options and arguments of each command."""
    (found,) = (action.choices for action in parser(SUBCOMMANDS)._actions
                if isinstance(action, argparse._SubParsersAction))
    return {name: [action for action in command._actions if action.dest != "help"] for name, command in found.items()}


def value(action: argparse.Action, chance: Random) -> str:
    """Something for an option or an argument: what it takes, or anything."""
    if action.choices and chance.randrange(4):
        return str(chance.choice([*action.choices]))
    takes = str(action.metavar or action.dest).upper()
    if takes == "SCENE":
        return chance.choice(SCENES)
    if ("FILE" in takes or "." in takes or takes in ("DRAWING", "FOLDER")) and chance.randrange(8):
        return chance.choice(FILES)
    return chance.choice(WORDS)


def words(name: str, chance: Random) -> Iterator[str]:
    """A command with some of its options; what it cannot do without is left out only now and then."""
    yield from (name, *LONG.get(name, ()))
    for action in commands()[name]:
        if name in LONG and not action.option_strings:
            continue
        needed = action.required and chance.randrange(12)
        if not (needed or chance.randrange(6) == 0):
            continue
        if action.option_strings:
            yield chance.choice(action.option_strings)
        if action.nargs != 0 or chance.randrange(20) == 0:
            yield value(action, chance)
    if chance.randrange(10) == 0:
        yield chance.choice(("--nosuch", "-Z", "more", "--output", "-o", "--help-me"))


@pytest.mark.parametrize("part", range(PARTS))
def test_options_by_chance(part: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No words give a traceback, a warning, or another status than 0 to 3."""
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text("mine")
    Path("points.csv").write_text("mark,x,y\nA,32.1,46.0\n")
    found = {}
    for seed in range(part, TRIES, PARTS):
        chance = Random(seed)
        said = [*words(chance.choice([*commands()]), chance)]
        if wrong := complaint(said):
            found[seed] = f"{said}: {wrong}"
        assert Path("scene.toml").read_text() == "mine"
    assert not found, "\n".join(f"--- {seed}: {told}" for seed, told in found.items())


@pytest.mark.parametrize("name", SUBCOMMANDS)
def test_unknown_options_are_one_line(name: str) -> None:
    """Each command tells an option that it does not know in one line with status 2, and where its options stand."""
    needed = LONG.get(name) or [str((action.choices or ["four-bar"])[0]) for action in commands()[name]
                                if action.required and not action.option_strings]
    also = [word for action in commands()[name] if action.required and action.option_strings
            for word in (action.option_strings[0], "3")]
    found = ran([name, *needed, *also, "--zzz"])
    assert (found.status, found.out, found.err.count("\n")) == (2, "", 1)
    assert "--zzz" in found.err
    assert "--help" in found.err


@pytest.mark.parametrize("number", ["nan", "inf", "-1", "1e400", "1.5", "x", "", "9" * 5000])
def test_bad_numbers_are_one_line(number: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every option of every command that takes a number refuses what is none in one line with status 2."""
    monkeypatch.chdir(tmp_path)
    tried = 0
    for name, actions in commands().items():
        for action in actions:
            counts = action.type is int or getattr(action.type, "__qualname__", "").startswith(count.__name__)
            if not counts and (action.type is not float or number in ("-1", "1.5")):
                continue
            given = {option.option_strings[0]: "12" for option in actions if option.required and option.option_strings}
            if "-o" in given:
                given["-o"] = "x.html"
            given["--from"] = given["--to"] = "0"
            given = {option: told for option, told in given.items()
                     if any(option in other.option_strings for other in actions)} | {action.option_strings[0]: number}
            found = ran([name, "four-bar", *(f"{option}={told}" for option, told in given.items())])
            assert (found.status, found.out, found.err.count("\n")) == (2, "", 1), (name, given, found)
            tried += 1
    assert tried >= 4
