"""Completion of the command line, as the shells themselves do it."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from graphplan.commands import SUBCOMMANDS, main
from graphplan.mechanism.scene import packaged_names
from graphplan.mechanism.sections import METHODS, OF_PATHS

Complete = Callable[[str], set[str]]

DRIVER = """
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_graphplan
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture
def script(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Callable[[str], Path]:
    """Gives the file with the script for a shell, which a test without that shell does without."""
    def written(shell: str) -> Path:
        if shutil.which(shell) is None:
            pytest.skip(f"{shell} is not installed")
        assert main(["completion", shell]) == 0
        path = tmp_path / f"completion.{shell}"
        path.write_text(capsys.readouterr().out)
        (tmp_path / "own scene.toml").write_text("")
        (tmp_path / "notes.txt").write_text("")
        (tmp_path / "folder").mkdir()
        return path
    return written


def said(*arguments: str, folder: Path) -> str:
    """What a program prints in a folder, without a word of complaint."""
    done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=True, timeout=600)
    assert done.stderr == ""
    return done.stdout


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_scripts_are_sound(shell: str, script: Callable[[str], Path], tmp_path: Path) -> None:
    """The shell finds no fault with the script."""
    said(shell, "-n", str(script(shell)), folder=tmp_path)


@pytest.fixture(params=["bash", "fish"])
def complete(request: pytest.FixtureRequest, script: Callable[[str], Path], tmp_path: Path) -> Complete:
    """Gives what a shell offers for a line that is typed so far."""
    path = script(request.param)

    def in_bash(line: str) -> set[str]:
        words = line.replace("=", " = ").split(" ")
        return set(said("bash", "-c", DRIVER, "driver", str(path), *words, folder=tmp_path).split("\n")) - {""}

    def in_fish(line: str) -> set[str]:
        offers = said("fish", "-N", "-c", f"source {path}; complete -C '{line}'", folder=tmp_path).splitlines()
        return {offer.split("\t")[0].removeprefix("--prefer=") for offer in offers}

    return in_bash if request.param == "bash" else in_fish


def test_commands_are_offered(complete: Complete) -> None:
    """The first word is a command."""
    assert complete("graphplan ") == set(SUBCOMMANDS)
    assert complete("graphplan sol") == {"solve"}


def test_options_are_offered(complete: Complete) -> None:
    """A dash brings the options of that command alone."""
    assert complete("graphplan cycle --po") == {"--positions"}
    assert {"--hands", "--quiet"} <= complete("graphplan cost --")
    assert "--hands" not in complete("graphplan solve --")


def test_choices_are_offered(complete: Complete) -> None:
    """After an option with choices these are offered, however it is written; so are those of an argument."""
    assert complete("graphplan draw --method ") == {*METHODS, *OF_PATHS}
    assert complete("graphplan steps --prefer=acc") == {"accurate"}
    assert complete("graphplan schema s") == {"scene", "solve", "steps", "synthesize", "synthesize-keys"}


def test_scenes_are_offered(complete: Complete) -> None:
    """Where a scene is wanted there are the packaged ones, the TOML files and the folders, and nothing else."""
    assert complete("graphplan solve four") == {"four-bar"}
    offers = {offer.rstrip("/").replace("\\ ", " ") for offer in complete("graphplan check ")}
    assert offers == {*packaged_names(), "own scene.toml", "folder"}
    assert complete("graphplan synthesize gear") == {"gear-21-1"}


def test_folders_are_offered(complete: Complete) -> None:
    """Where a folder is wanted there are folders alone."""
    assert {offer.rstrip("/") for offer in complete("graphplan gallery ")} == {"folder"}
