"""The command line at a terminal: help and its bounds, completion by the shells themselves, colour, progress, watching.
"""

from __future__ import annotations

import os
import pty
import queue
import re
import shutil
import signal
import subprocess
import sys
import threading
import tomllib
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest
from face import names, ran

import graphplan as gp

ROOT = Path(__file__).parents[2]
MAX_OPTIONS, MAX_DECLARED, MAX_LINES = 70, 187, 92
PATIENCE = 600.0  # seconds after which it hangs, on any machine
THREADS = "MKL_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"
KINDS = re.findall(r"\{([a-z,-]+)\}", ran("new", "--help").out)[0].split(",")


@cache
def groups() -> dict[str, list[str]]:
    """The commands by their groups, as `graphplan --help` has them."""
    found: dict[str, list[str]] = {}
    for line in ran("--help").out.partition("COMMAND\n")[2].partition("\nexamples:")[0].splitlines():
        if head := re.match(r"  (\w+):$", line):
            found[head[1]] = []
        elif name := re.match(r"    (\w+)\s", line):
            found[[*found][-1]].append(name[1])
    return found


COMMANDS = [name for group in groups().values() for name in group]


@cache
def helped(command: str) -> str:
    """The help of a command."""
    return ran(command, "--help").out


# ---- help ------------------------------------------------------------------------------------------------------------


def test_commands_stand_in_groups() -> None:
    """Each command is in one group, once, and what is commonly done is there."""
    assert len({*COMMANDS}) == len(COMMANDS) > 20
    assert [*groups()] == ["describe", "construct", "move", "machine", "teach", "share"]
    assert {"draw", "steps", "solve", "check"} <= {*groups()["construct"]}


@pytest.mark.parametrize("command", COMMANDS)
def test_help_fits_two_screens_and_has_examples(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The help of a command has at most 80 lines in a terminal of 80 columns, and ends with examples of that command;
    `help COMMAND` prints the same, and an option that is unknown is one line that says where the options stand."""
    monkeypatch.setenv("COLUMNS", "80")
    text = ran(command, "--help").out
    assert len(text.splitlines()) <= MAX_LINES
    assert f"\n  graphplan {command}" in text.partition("\nexamples:\n")[2]
    assert ran("help", command).out == text


def test_there_are_not_too_many_options(monkeypatch: pytest.MonkeyPatch) -> None:
    """All commands together declare at most 187 options besides -h, of 70 meanings: one that means the same in several
    commands is learnt once, and one name with two meanings counts twice."""
    monkeypatch.setenv("COLUMNS", "400")
    declared = [head for command in COMMANDS
                for line in ran(command, "--help").out.partition("\nexamples:")[0].splitlines()
                if re.match(r"\s+-", line) and (head := re.split(r"\s{2,}", line.strip())[0]) != "-h, --help"]
    assert 100 < len(declared) <= MAX_DECLARED
    assert 40 < len({*declared}) <= MAX_OPTIONS


def test_the_help_of_export_tells_every_format() -> None:
    """Each format of the choices has its line, with the ending of its files."""
    text = " ".join(helped("export").split())
    for name in re.findall(r"--format \{([^}]*)\}", text)[0].split(","):
        assert re.search(rf" {re.escape(name)} \.\w+ \w", text), name


# ---- new scenes and the list -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_optional_in_a_new_scene_holds_too(kind: str) -> None:
    """Each optional paragraph holds when its # are taken away, and so do all together; each section is explained."""
    paragraphs = ran("new", "-", "--kind", kind).out.split("\n\n")
    plain = "\n\n".join(paragraphs)
    optional = [place for place, paragraph in enumerate(paragraphs) if re.search(r"(?m)^#(?=\S)", paragraph)]
    assert len(optional) >= 3
    for chosen in [*([place] for place in optional), optional]:
        text = "\n\n".join(re.sub(r"(?m)^#(?=\S)", "", paragraph) if place in chosen else paragraph
                           for place, paragraph in enumerate(paragraphs))
        assert tomllib.loads(text) != tomllib.loads(plain)
        gp.parse(text, kind)
    for name, section in ran("schema", "scene").json["properties"].items():
        told = re.escape(section["description"])
        assert re.search(rf"(?m)^#?{name}\b.* # {told}|^#?\[+{name}\b.* # {told}|^# {name}: {told}", plain), name


@pytest.mark.parametrize("left_out", ["masses", "forces", "moments", "friction", "springs"])
def test_loads_of_a_new_scene_may_be_left_out(left_out: str) -> None:
    """Of the paragraph of loads any table but the balance may be left out."""
    text = re.sub(r"(?m)^#(?=\S)", "", ran("new", "-", "--kind", "four-bar").out)
    shorter = re.sub(rf"(?m)^\[+{left_out}[^\n]*\n(?:\w[^\n]*\n)+", "", text)
    if left_out in ("masses", "forces", "moments", "friction"):
        assert shorter != text
    gp.parse(shorter, "four-bar")


def test_the_list_names_every_scene() -> None:
    """It has a line for every packaged scene, with its title and source in full where no terminal bounds it."""
    lines = {line.split()[0]: line for line in ran("list").out.splitlines() if line}
    for name in names():
        assert gp.load(name).title in lines[name]
        assert gp.load(name).source in lines[name]


# ---- a terminal ------------------------------------------------------------------------------------------------------


def on_terminal(*arguments: str, shown: str = "stderr", **environment: str) -> str:
    """What a command tells on a standard error, or prints, that is a terminal."""
    ours, theirs = pty.openpty()
    plain = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL} | {shown: theirs}
    process = subprocess.Popen([sys.executable, "-m", "graphplan", *arguments], cwd=ROOT, env={**plain, **environment},
                               **streams)
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


def test_progress_is_told_on_a_terminal(tmp_path: Path) -> None:
    """Long work tells how far it is, and verify what it judges, unless it is to be quiet."""
    long = "cycle", "four-bar", "--positions", "5000"
    assert re.search(r"\r[a-z]+: \d+ of 5000", on_terminal(*long))
    assert on_terminal(*long, "--quiet") == ""
    drawing = str(ROOT / "tests" / "cases" / "verify" / "good.csv")
    assert [line.strip() for line in on_terminal("verify", "four-bar", drawing).split("\r")] == [
        "", "good.csv", "", "", ""]


@pytest.mark.parametrize("width", [80, 120])
def test_the_list_fits_the_terminal(width: int) -> None:
    """On a terminal no line is longer than it is wide, and what is short is not cut."""
    lines = on_terminal("list", shown="stdout", COLUMNS=str(width)).splitlines()
    assert len(lines) > len(names())
    assert all(len(line) <= width for line in lines)
    assert any(line.startswith("four-bar ") for line in lines)


@pytest.mark.parametrize(("by_user", "then"), [({}, ["1", "1", "1"]), ({"OMP_NUM_THREADS": "3"}, ["", "3", ""])])
def test_a_command_takes_one_thread_unless_told(by_user: dict[str, str], then: list[str]) -> None:
    """The number is in the environment before a command loads numpy, which reads it then; the user's own stands."""
    code = f"""import os, runpy, sys
class AtImport:
    def find_spec(self, name, path=None, target=None):
        if name == "numpy":
            print([os.environ.get(name, "") for name in {THREADS}], file=sys.stderr)
sys.meta_path.insert(0, AtImport())
sys.argv = ["graphplan", "solve", "jaanimets-10"]
runpy.run_module("graphplan", run_name="__main__")
"""
    environment = {name: value for name, value in os.environ.items() if name not in THREADS} | by_user
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    assert done.stderr == f"{then}\n"


# ---- completion ------------------------------------------------------------------------------------------------------

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
def script(tmp_path: Path) -> Callable[[str], Path]:
    """Gives the file with the script for a shell, which a test without that shell does without."""
    def written(shell: str) -> Path:
        if shutil.which(shell) is None:
            pytest.skip(f"{shell} is not installed")
        path = tmp_path / f"completion.{shell}"
        path.write_text(ran("completion", shell).out)
        (tmp_path / "own scene.toml").write_text("")
        (tmp_path / "notes.txt").write_text("")
        (tmp_path / "folder").mkdir()
        return path
    return written


def said(*arguments: str, folder: Path) -> str:
    """What a program prints in a folder, without a word of complaint."""
    done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=True, timeout=PATIENCE)
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


def test_commands_and_options_are_offered(complete: Complete) -> None:
    """The first word is a command; a dash brings the options of that command alone, and then their choices."""
    assert complete("graphplan ") == {*COMMANDS}
    assert complete("graphplan sol") == {"solve"}
    assert complete("graphplan cycle --pos") == {"--positions"}
    assert {"--pencil", "--quiet"} <= complete("graphplan cost --")
    assert "--pencil" not in complete("graphplan check --")
    assert {"auxiliary", "trial", "poles", "auxiliary,trial"} < complete("graphplan draw --method ")
    assert complete("graphplan steps --prefer=acc") == {"accurate"}
    assert complete("graphplan schema s") == {"scene", "solve", "steps", "synthesize", "synthesize-keys"}


def test_scenes_and_folders_are_offered(complete: Complete) -> None:
    """Where a scene is wanted there are the packaged ones, the TOML files and the folders; or folders alone."""
    assert complete("graphplan solve four") == {"four-bar"}
    offers = {offer.rstrip("/").replace("\\ ", " ") for offer in complete("graphplan check ")}
    assert offers == {*names(), "own scene.toml", "folder"}
    assert complete("graphplan synthesize gear") == {"gear-21-1"}
    assert {offer.rstrip("/") for offer in complete("graphplan gallery ")} == {"folder"}


# ---- watching --------------------------------------------------------------------------------------------------------

SCENE = ran("new", "-", "--kind", "four-bar").out


class Watch:
    """A running `graphplan watch`, and what it tells."""

    def __init__(self, scene: Path):
        self.process = subprocess.Popen([sys.executable, "-m", "graphplan", "watch", str(scene)], text=True,
                                        stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, cwd=ROOT,
                                        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        self.lines: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.lines.put(line)

    def tells(self, words: str) -> None:
        """Wait for the next line, which has these words."""
        assert words in self.lines.get(timeout=PATIENCE)

    def is_silent(self) -> None:
        """For a second it tells nothing."""
        with pytest.raises(queue.Empty):
            self.lines.get(timeout=1.0)


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """A file with a scene."""
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture
def watch(scene: Path) -> Iterator[Watch]:
    """A watch that has drawn the scene once."""
    running = Watch(scene)
    running.tells("drawn")
    yield running
    running.process.kill()
    running.process.wait()


def test_the_sheet_follows_the_file(watch: Watch, scene: Path) -> None:
    """A change is drawn; faults are told and leave the sheet; mending draws it again; Ctrl-C ends with 130."""
    sheet = scene.with_suffix(".svg")
    first = sheet.read_bytes()
    scene.write_text(SCENE.replace("angle = 60", "angle = 80"))
    watch.tells("drawn")
    second = sheet.read_bytes()
    assert second != first
    scene.write_text(SCENE.replace("omega", "omga"))
    watch.tells("unknown key; perhaps omega")
    watch.tells("omega is missing")
    assert sheet.read_bytes() == second
    scene.write_text(SCENE)
    watch.tells("drawn")
    assert sheet.read_bytes() == first
    watch.process.send_signal(signal.SIGINT)
    assert watch.process.wait(PATIENCE) == 130


def test_files_that_are_replaced_are_followed(watch: Watch, scene: Path, tmp_path: Path) -> None:
    """A file moved over the scene, or written anew after the scene was deleted, is drawn; a mere touch is not."""
    sheet, other = scene.with_suffix(".svg"), tmp_path / "scene.toml~"
    other.write_text(SCENE.replace("angle = 60", "angle = 80"))
    os.replace(other, scene)
    watch.tells("drawn")
    moved = sheet.read_bytes()
    scene.unlink()
    watch.is_silent()
    scene.write_text(SCENE.replace("angle = 60", "angle = 80"))
    os.utime(scene)
    watch.is_silent()
    scene.unlink()
    scene.write_text(SCENE)
    watch.tells("drawn")
    assert sheet.read_bytes() != moved
