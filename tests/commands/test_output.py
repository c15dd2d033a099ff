"""Where commands write: regular files in one step, links, devices and pipes through, and one line where they cannot."""

from __future__ import annotations

import os
import signal
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Iterable
from pathlib import Path

import pytest
from command_line import heeds_ctrl_c, run

from graphplan.commands import cycle, main
from graphplan.public import files, pages
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.plates.display import Rect, Sheet

ROOT = Path(__file__).parent.parent.parent
WRITERS = {  # what writes a file, without its name: each ends with the option or the argument that takes it
    "draw": ["draw", "four-bar", "--set", "sheet.protocol=none", "-o"],
    "export": ["export", "four-bar", "--format", "svg", "-o"],
    "handout": ["handout", "four-bar", "--only", "task", "-o"],
    "table": ["cycle", "four-bar", "--positions", "4", "-o"],
    "plot": ["cycle", "four-bar", "--positions", "12", "--plot"],
}
BLANK = Sheet(297.0, 210.0, Rect(20.0, 10.0, 287.0, 200.0), {}, (), "blank", "", (), Scales(1.0, 1.0, "mm", {}))
PRINTERS = [["solve", "four-bar"], ["check", "four-bar"], ["steps", "four-bar"], ["list"],
            ["schema"], ["completion", "bash"], ["new", "-"], ["draw", "four-bar"], ["--help"], ["--version"],
            ["cycle", "four-bar", "--positions", "4"], ["handout", "four-bar", "--only", "task", "-o", "-"]]


def shell(words: str) -> subprocess.CompletedProcess[str]:
    """What a shell makes of words in which `graphplan` is the program."""
    words = words.replace("graphplan", f"{sys.executable} -m graphplan", 1)
    return subprocess.run(["bash", "-c", words], cwd=ROOT, text=True, capture_output=True, timeout=600)


@pytest.fixture
def blank(monkeypatch: pytest.MonkeyPatch) -> None:
    """Handouts have a blank page: here it matters where they are written, not what is on them."""
    monkeypatch.setattr("graphplan.public.pages._pages", lambda *_: [BLANK])


@pytest.mark.usefixtures("blank")
@pytest.mark.parametrize("arguments", WRITERS.values(), ids=WRITERS)
def test_a_file_has_the_rights_that_others_have(arguments: list[str], tmp_path: Path) -> None:
    """A new file has the rights of any new file, a file that is there keeps its own, and nothing else is left."""
    new, old, plain = tmp_path / "new", tmp_path / "old", tmp_path / "plain"
    plain.touch()
    old.touch(0o640)
    for path in (new, old):
        assert main([*arguments, str(path)]) == 0
    assert new.read_bytes() == old.read_bytes() != b""
    assert new.stat().st_mode == plain.stat().st_mode
    assert stat.S_IMODE(old.stat().st_mode) == 0o640
    assert {*tmp_path.iterdir()} == {new, old, plain}


@pytest.mark.usefixtures("blank")
@pytest.mark.parametrize("arguments", WRITERS.values(), ids=WRITERS)
def test_a_link_stays_a_link(arguments: list[str], tmp_path: Path) -> None:
    """What a symbolic link leads to is written, in its own folder, also where there is nothing yet."""
    folder = tmp_path / "folder"
    folder.mkdir()
    for name in ("there", "missing"):
        link, target = tmp_path / f"to-{name}", folder / name
        if name == "there":
            target.write_text("old")
        link.symlink_to(Path("folder") / name)
        assert main([*arguments, str(link)]) == 0
        assert link.is_symlink()
        assert target.read_bytes() not in (b"", b"old")
    assert {path.name for path in folder.iterdir()} == {"there", "missing"}


@pytest.mark.usefixtures("blank")
@pytest.mark.parametrize("arguments", WRITERS.values(), ids=WRITERS)
def test_a_pipe_stays_a_pipe(arguments: list[str], tmp_path: Path) -> None:
    """A named pipe passes on what is written, and is a pipe after it."""
    pipe, file = tmp_path / "pipe", tmp_path / "file"
    os.mkfifo(pipe)
    passed: list[bytes] = []
    reader = threading.Thread(target=lambda: passed.append(pipe.read_bytes()))
    reader.start()
    assert main([*arguments, str(pipe)]) == 0
    reader.join()
    assert main([*arguments, str(file)]) == 0
    assert passed == [file.read_bytes()]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


@pytest.mark.usefixtures("blank")
@pytest.mark.parametrize("arguments", WRITERS.values(), ids=WRITERS)
def test_a_full_device_stays_a_device(arguments: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A device that takes nothing is told in one line with status 2, also behind a link, and is a device after it."""
    link = tmp_path / "link"
    link.symlink_to("/dev/full")
    for path in ("/dev/full", str(link)):
        assert main([*arguments, path]) == 2
        told = capsys.readouterr().err.splitlines()
        assert [line for line in told if "No space left on device" in line] == told[-1:]
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode)
    assert main([*arguments, os.devnull]) == 0
    assert stat.S_ISCHR(os.stat(os.devnull).st_mode)


@pytest.mark.parametrize("arguments", PRINTERS, ids=" ".join)
def test_a_full_standard_output_is_one_line(arguments: list[str], monkeypatch: pytest.MonkeyPatch,
                                            capsys: pytest.CaptureFixture[str]) -> None:
    """What standard output cannot take is told in one line with status 2, and not tried again when it is closed."""
    with open("/dev/full", "w") as full:
        monkeypatch.setattr(sys, "stdout", full)
        assert run(*arguments, *(["-q"] if arguments[0][0] != "-" else [])) == 2
    told = capsys.readouterr().err
    assert told.startswith("standard output: cannot be written (No space left on device)")
    assert told.count("\n") == 1


@pytest.mark.parametrize("arguments", PRINTERS[:-4], ids=" ".join)
def test_a_closed_standard_output_is_one_line(arguments: list[str], monkeypatch: pytest.MonkeyPatch,
                                              capsys: pytest.CaptureFixture[str]) -> None:
    """A standard output that is closed, of which Python makes none, is told in one line with status 2."""
    monkeypatch.setattr(sys, "stdout", None)
    assert run(*arguments) == 2
    told = capsys.readouterr().err
    assert told.startswith("standard output: cannot be written (it is closed)")
    assert told.count("\n") == 1


@pytest.mark.parametrize(("sent", "why"), [("> /dev/full", "No space left on device"), (">&-", "it is closed")])
def test_a_process_says_so_once(sent: str, why: str) -> None:
    """A process whose standard output takes nothing ends with that one line and status 2."""
    for words in ("list", "solve four-bar"):
        done = shell(f"graphplan {words} {sent}")
        assert (done.returncode, done.stderr.count("\n")) == (2, 1)
        assert done.stderr.startswith(f"standard output: cannot be written ({why})")


def test_other_streams_may_be_closed(tmp_path: Path) -> None:
    """With standard output closed a file is written; a closed standard input is told; nobody needs standard error."""
    sheet = tmp_path / "sheet.svg"
    assert shell(f"graphplan draw four-bar -o {sheet} >&-").returncode == 0
    assert sheet.read_bytes()
    done = shell("graphplan solve - <&-")
    assert (done.returncode, done.stderr) == (
        2, "-: file: it cannot be read (standard input is closed); a readable file\n")
    for gone in ("2>&-", "2>/dev/full"):
        done = shell(f"graphplan solve no-such-scene {gone}")
        assert (done.returncode, done.stdout, done.stderr) == (2, "", "")


def test_a_reader_may_have_enough() -> None:
    """A pipe that is closed early is no fault."""
    done = shell("graphplan steps alt-eight-link | head -1; exit ${PIPESTATUS[0]}")
    assert (done.returncode, done.stderr, done.stdout.count("\n")) == (0, "", 1)


def test_standard_output_by_another_name_goes_on(tmp_path: Path) -> None:
    """/dev/stdout is standard output also where that is a file: what is in it stays."""
    log = tmp_path / "log"
    log.write_text("before\n")
    assert shell(f"graphplan draw four-bar -o /dev/stdout >> {log}").returncode == 0
    assert log.read_text().startswith("before\n<?xml")


@pytest.mark.usefixtures("blank")
def test_binary_formats_go_to_standard_output(tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    """`-o -` prints a PDF as it would be written."""
    assert main(["handout", "four-bar", "--only", "task", "-o", "-"]) == 0
    printed = capfdbinary.readouterr().out
    assert main(["handout", "four-bar", "--only", "task", "-o", str(tmp_path / "task.pdf")]) == 0
    assert printed == (tmp_path / "task.pdf").read_bytes()


@pytest.mark.parametrize("name", ["draw", "table", "plot", "handout", "export"])
def test_unknown_endings_are_refused(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A name that ends otherwise than what a command writes is refused, and nothing is written."""
    assert main([*WRITERS[name], str(tmp_path / "x.gif")]) == 2
    told = capsys.readouterr().err
    assert "is written as .gif; a name in ." in told
    assert told.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.costly
def test_every_ending_that_is_declared_is_written(tmp_path: Path) -> None:
    """Each command writes all endings that it declares, whatever their case."""
    for name, endings in {"draw": pages.ENDINGS, "handout": files.HANDOUT_ENDINGS, "cycle": cycle.ENDINGS}.items():
        for ending in (*endings, endings[0].upper()):
            path = tmp_path / f"{name}{ending}"
            brief = ["--positions", "2"] if name == "cycle" else ["--set", "sheet.positions=2"] * (ending == ".html")
            assert main([name, "four-bar", *brief, "-o", str(path)]) == 0
            assert path.read_bytes()


@pytest.mark.parametrize("arguments", WRITERS.values(), ids=WRITERS)
def test_what_cannot_be_written_is_told_before_any_work(arguments: list[str], tmp_path: Path,
                                                        monkeypatch: pytest.MonkeyPatch,
                                                        capsys: pytest.CaptureFixture[str]) -> None:
    """A folder, a name in none, and what may not be written are refused before the scene is read."""
    monkeypatch.setattr("graphplan.mechanism.scene.parse", lambda *_: pytest.fail("work was done"))
    kept, closed = tmp_path / "kept", tmp_path / "closed"
    kept.write_text("mine")
    for path, why in ((tmp_path, "this is a directory"), (kept / "x", "Not a directory"),
                      ("x" * 300, "File name too long"), ("a\0b", "null byte")):
        assert main([*arguments, str(path)]) == 2
        told = capsys.readouterr().err
        assert (why in told, told.count("\n")) == (True, 1)
    monkeypatch.setattr(os, "access", lambda path, mode: str(path) not in (str(kept), str(closed)))  # root may all
    closed.mkdir()
    for path in (kept, closed / "x"):
        assert main([*arguments, str(path)]) == 2
        assert "Permission denied" in capsys.readouterr().err
    assert kept.read_text() == "mine"


def test_an_interrupt_half_way_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the user interrupts, or the disk is full, the old file stays and nothing is left beside it."""
    path = tmp_path / "sheet.svg"
    path.write_text("old")

    faults = {130: KeyboardInterrupt(), 2: OSError(28, "No space left on device")}

    class Half:
        """A file that takes the half of what is written."""

        def __init__(self, *rest: object):
            self.file = open(*rest)  # noqa: SIM115

        def __enter__(self) -> Half:
            return self

        def __exit__(self, *why: object) -> None:
            self.file.close()

        def writelines(self, parts: Iterable[bytes]) -> None:
            data = b"".join(parts)
            self.file.write(data[: len(data) // 2])
            raise faults[status]

    monkeypatch.setattr(files, "open", Half, raising=False)
    for status in faults:
        assert main(["draw", "four-bar", "-o", str(path)]) == status
        assert path.read_text() == "old"
        assert list(tmp_path.iterdir()) == [path]
        assert main(["new", str(tmp_path / "new.toml")]) == status
        assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_leaves_the_old_file(number: int, status: int, tmp_path: Path) -> None:
    """A process that is interrupted or terminated while it writes ends without a word, and changes nothing."""
    path = tmp_path / "table.csv"
    path.write_text("old")
    words = [sys.executable, "-m", "graphplan", "cycle", "four-bar", "--positions", "1000000", "-o", str(path)]
    process = subprocess.Popen(words, cwd=ROOT, stderr=subprocess.PIPE, preexec_fn=heeds_ctrl_c)
    while process.poll() is None and not any(part.stat().st_size for part in tmp_path.glob(".graphplan-*")):
        time.sleep(0.05)
    process.send_signal(number)
    assert process.communicate(timeout=600)[1] == b""
    assert process.returncode == status
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_two_writers_never_mix(tmp_path: Path) -> None:
    """While two write one file again and again, whoever reads it finds what one of them wrote, whole."""
    path = tmp_path / "file"
    texts = [letter * 300_000 for letter in "ab"]
    files.write(texts[0], str(path))

    def write(text: str) -> None:
        for _ in range(100):
            files.write(text, str(path))

    writers = [threading.Thread(target=write, args=(text,)) for text in texts]
    for writer in writers:
        writer.start()
    found = set()
    while any(writer.is_alive() for writer in writers):
        found.add(path.read_text())
    assert found <= {*texts}
    assert list(tmp_path.iterdir()) == [path]


def test_a_new_scene_goes_where_it_is_sent(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`new` writes through a link that leads nowhere yet, and never over a scene that is there."""
    target, link = tmp_path / "scene.toml", tmp_path / "link.toml"
    link.symlink_to(target)
    assert main(["new", str(link)]) == 0
    text = target.read_text()
    assert main(["new", str(link), "--kind", "blank"]) == 2
    assert "it is there already; another name" in capsys.readouterr().err
    assert target.read_text() == text
    assert main(["new", str(tmp_path / "scene.svg")]) == 2
    assert link.is_symlink()
