"""Where commands write: regular files in one step, links, devices and pipes through, and one line where they cannot."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import stat
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import pytest
from face import ran

ROOT = Path(__file__).parents[2]
CASES = ROOT / "tests" / "cases" / "verify"
WRITERS = {  # what writes a file, without its name: each ends with the option or the argument that takes it
    "draw": ["draw", "four-bar", "--set", "sheet.protocol=none", "-o"],
    "export": ["export", "four-bar", "--format", "svg", "-o"],
    "handout": ["handout", "four-bar", "--only", "task", "-o"],
    "table": ["cycle", "four-bar", "--positions", "4", "-o"],
    "plot": ["cycle", "four-bar", "--positions", "12", "--plot"],
}
QUICK = {name: words for name, words in WRITERS.items() if name != "handout"}
PRINTERS = ["solve four-bar", "check four-bar", "steps four-bar", "list", "schema", "completion bash", "new -",
            "draw four-bar", "--help", "--version", "cycle four-bar --positions 4"]
quick = pytest.mark.parametrize("words", QUICK.values(), ids=QUICK)


def shell(words: str, **how: object) -> subprocess.CompletedProcess[str]:
    """What a shell makes of words in which `graphplan` is the program."""
    words = words.replace("graphplan", f"{sys.executable} -m graphplan", 1)
    return subprocess.run(["bash", "-c", words], cwd=ROOT, text=True, capture_output=True, timeout=600,
                          **how)  # type: ignore[call-overload,no-any-return]


@quick
def test_a_file_has_the_rights_that_others_have(words: list[str], tmp_path: Path) -> None:
    """A new file has the rights of any new file, a file that is there keeps its own, and nothing else is left."""
    new, old, plain = tmp_path / "new", tmp_path / "old", tmp_path / "plain"
    plain.touch()
    old.touch(0o640)
    for path in (new, old):
        assert ran(*words, path).status == 0
    assert new.read_bytes() == old.read_bytes() != b""
    assert new.stat().st_mode == plain.stat().st_mode
    assert stat.S_IMODE(old.stat().st_mode) == 0o640
    assert {*tmp_path.iterdir()} == {new, old, plain}


@quick
def test_a_link_stays_a_link(words: list[str], tmp_path: Path) -> None:
    """What a symbolic link leads to is written, in its own folder, also where there is nothing yet."""
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "there").write_text("old")
    for name in ("there", "missing"):
        link = tmp_path / f"to-{name}"
        link.symlink_to(Path("folder") / name)
        assert ran(*words, link).status == 0
        assert link.is_symlink()
        assert (folder / name).read_bytes() not in (b"", b"old")
    assert {path.name for path in folder.iterdir()} == {"there", "missing"}


@pytest.mark.parametrize("words", WRITERS.values(), ids=WRITERS)
def test_pipes_and_devices_stay_what_they_are(words: list[str], tmp_path: Path) -> None:
    """A named pipe passes on what is written; a device that takes nothing is told in one line, also behind a link."""
    pipe, link, passed = tmp_path / "pipe", tmp_path / "link", list[bytes]()
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: passed.append(pipe.read_bytes()))
    reader.start()
    assert ran(*words, pipe).status == 0
    reader.join()
    assert ran(*words, tmp_path / "file").status == 0
    assert passed == [(tmp_path / "file").read_bytes()]
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    link.symlink_to("/dev/full")
    done = ran(*words, link)
    assert done.status == 2
    assert [line for line in done.err.splitlines() if "No space left on device" in line] == done.err.splitlines()[-1:]
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode)


NEVER_LOUD = "list", "schema", "completion"  # they have no remarks and no progress to leave out


@pytest.mark.parametrize("line", PRINTERS)
def test_a_full_or_closed_standard_output_is_one_line(line: str) -> None:
    """What standard output cannot take is told in one line with status 2, and not tried again when it is closed."""
    words = [*line.split(), *(["-q"] if line[0] != "-" and line.split()[0] not in NEVER_LOUD else [])]
    for sent, why in (("> /dev/full", "No space left on device"), (">&-", "it is closed")):
        if line[0] == "-" and sent == ">&-":
            continue
        done = shell(f"graphplan {' '.join(words)} {sent}")
        assert (done.returncode, done.stderr.count("\n")) == (2, 1), done.stderr
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
        assert shell(f"graphplan solve no-such-scene {gone}").returncode == 2


def test_standard_output_by_another_name_goes_on(tmp_path: Path) -> None:
    """/dev/stdout is standard output also where that is a file: what is in it stays."""
    log = tmp_path / "log"
    log.write_text("before\n")
    assert shell(f"graphplan draw four-bar -o /dev/stdout >> {log}").returncode == 0
    assert log.read_text().startswith("before\n<?xml")


def test_binary_formats_go_to_standard_output(tmp_path: Path) -> None:
    """`-o -` prints a PDF as it would be written."""
    words = "handout four-bar --only task -q -o"
    assert shell(f"graphplan {words} - > {tmp_path}/printed.pdf").returncode == 0
    assert ran(*words.split(), tmp_path / "task.pdf").status == 0
    assert (tmp_path / "printed.pdf").read_bytes() == (tmp_path / "task.pdf").read_bytes() != b""


@pytest.mark.parametrize("words", WRITERS.values(), ids=WRITERS)
def test_what_cannot_be_written_is_told_before_any_work(words: list[str], tmp_path: Path,
                                                        monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder, a name in none, what may not be written and endings that are unknown are refused before the scene is
    read: its own faults are not told."""
    kept, closed, faulty = tmp_path / "kept", tmp_path / "closed", tmp_path / "faulty.toml"
    kept.write_text("mine")
    faulty.write_text("faulty")
    closed.mkdir()
    words = [words[0], str(faulty), *words[2:]]
    refused = [(tmp_path, "this is a directory"), (kept / "x", "Not a directory"), ("x" * 300, "File name too long"),
               ("a\0b", "null byte")]
    if words[0] != "export":
        refused.append((tmp_path / "x.gif", "is written as .gif; a name in ."))
    for path, why in refused:
        done = ran(*words, path)
        assert (done.status, why in done.err, done.err.count("\n")) == (2, True, 1), done.err
    monkeypatch.setattr(os, "access", lambda path, mode: str(path) not in (str(kept), str(closed)))  # root may all
    for path in (kept, closed / "x"):
        done = ran(*words, path)
        assert done.status == 2
        assert "Permission denied" in done.err
    assert kept.read_text() == "mine"
    assert {*tmp_path.iterdir()} == {kept, closed, faulty}


@pytest.mark.parametrize("words", ["draw four-bar -o", "cycle four-bar --positions 2000 -o", "new"])
def test_a_disk_that_is_full_half_way_leaves_the_old_file(words: str, tmp_path: Path) -> None:
    """Where no more of a file can be written the old one stays, and nothing is left beside it."""
    path = tmp_path / ("new.toml" if words == "new" else "old.csv" if "cycle" in words else "old.svg")
    if words != "new":
        path.write_text("old")
    done = shell(f"graphplan {words} {path}",
                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
    assert done.returncode == 2
    assert "cannot be written (File too large)" in done.stderr
    assert {one.name: one.read_text() for one in tmp_path.iterdir()} == ({} if words == "new" else {path.name: "old"})


def test_a_table_that_is_too_long_for_its_disk_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is refused in one line as the first rows tell its length, and nothing is left; one with room is written."""
    for free, status in ((10_000, 2), (100_000, 0)):
        monkeypatch.setattr(shutil, "disk_usage", lambda folder, free=free: SimpleNamespace(free=free))
        done = ran("cycle", "four-bar", "--positions", "200", "-o", tmp_path / "turn.csv")
        assert (done.status, "are free" in done.err, len([*tmp_path.iterdir()])) == (status, status == 2, status == 0)


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_leaves_the_old_file(number: int, status: int, tmp_path: Path) -> None:
    """A process that is interrupted or terminated while it writes ends without a word, and changes nothing."""
    path = tmp_path / "table.csv"
    path.write_text("old")
    words = [sys.executable, "-m", "graphplan", "cycle", "four-bar", "--positions", "1000000", "-o", str(path)]
    process = subprocess.Popen(words, cwd=ROOT, stderr=subprocess.PIPE,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    while process.poll() is None and not any(part.stat().st_size for part in tmp_path.glob(".graphplan-*")):
        time.sleep(0.05)
    process.send_signal(number)
    assert process.communicate(timeout=600)[1] == b""
    assert process.returncode == status
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_files_that_are_written_are_told(tmp_path: Path) -> None:
    """Each on a line of standard error; none with -q, and none of standard output or a device."""
    sheet = tmp_path / "deep" / "sheet.svg"
    words = ["draw", "slider-crank", "--paper", "A3"]
    told = ran(*words, "-o", sheet).err
    assert sorted(told.splitlines()) == [f"wrote {path}" for path in sorted(sheet.parent.iterdir())]
    for quiet in (["-o", sheet, "-q"], ["-o", os.devnull], []):
        assert ran(*words, *quiet).err == ""


def test_a_page_that_cannot_be_written_leaves_all_as_it_was(tmp_path: Path) -> None:
    """Where the protocol's name is that of a folder neither page is written."""
    (tmp_path / "sheet-protocol.svg").mkdir()
    assert ran("draw", "four-bar", "--set", "sheet.protocol=pages", "-o", tmp_path / "sheet.svg").status == 2
    assert [path.name for path in tmp_path.iterdir()] == ["sheet-protocol.svg"]


def test_a_pdf_has_all_pages(tmp_path: Path) -> None:
    """Plans and words are pages of one PDF, as many as there are files of SVG."""
    for ending in ("pdf", "svg"):
        words = "--set", "sheet.protocol=pages", "-o", tmp_path / ending / f"sheet.{ending}"
        assert ran("draw", "four-bar", *words).status == 0
    (document,) = (tmp_path / "pdf").iterdir()
    assert document.read_bytes().count(b"/MediaBox") == len([*(tmp_path / "svg").iterdir()]) > 1


def test_every_ending_that_is_declared_is_written(tmp_path: Path) -> None:
    """Each command writes all endings of which its refusal speaks, whatever their case."""
    for command, brief in (("draw", ["--set", "sheet.protocol=none"]), ("cycle", ["--positions", "2"]),
                           ("handout", ["--only", "task"])):
        line = ran(command, "four-bar", *brief, "-o", "x.gif").err.rstrip("\n")
        endings = line.partition("a name in ")[2].replace(" or ", ", ").split(", ")
        assert len(endings) > 1, line
        for ending in (*endings, endings[0].upper()):
            path = tmp_path / f"{command}{ending}"
            options = ["--set", "sheet.positions=2"] if ending == ".html" else brief
            assert ran(command, "four-bar", *options, "-o", path).status == 0, ending
            assert path.read_bytes()


def test_a_new_scene_goes_where_it_is_sent(tmp_path: Path) -> None:
    """`new` writes through a link that leads nowhere yet, and never over a scene that is there."""
    target, link = tmp_path / "scene.toml", tmp_path / "link.toml"
    link.symlink_to(target)
    assert ran("new", link).status == 0
    text = target.read_text()
    assert "it is there already; another name" in ran("new", link, "--kind", "blank").err
    assert target.read_text() == text
    assert link.is_symlink()


def test_a_report_is_never_written_over_what_it_is_of(tmp_path: Path) -> None:
    """Neither the student's file nor the scene is overwritten, by whatever path it is named."""
    drawing, scene, link = tmp_path / "drawing.svg", tmp_path / "scene.json", tmp_path / "link.svg"
    drawing.write_text("drawn")
    scene.write_text("[points]")
    link.symlink_to(drawing)
    for report in (drawing, link, scene):
        done = ran("verify", scene, drawing, "--report", report)
        assert done.status == 2
        assert "itself would be overwritten" in done.err
    assert (drawing.read_text(), scene.read_text()) == ("drawn", "[points]")
    assert link.is_symlink()


def test_names_of_drawings_may_be_any_bytes(tmp_path: Path) -> None:
    """What would move the cursor, or is no text, is replaced; what in a class is no file is told."""
    folder, odd = tmp_path / "class", os.fsdecode(b"\xff\x1b[2J.csv")
    shutil.copytree(CASES / "class", folder)
    (folder / "a.csv").rename(folder / odd)
    (folder / "later").mkdir()
    (folder / "lost.csv").symlink_to(folder / "gone.csv")
    data = ran("verify", "four-bar", folder, "--json").json
    assert [row["file"] for row in data["drawings"]] == ["b.csv", "\ufffd\ufffd[2J.csv"]
    told = {one["file"]: one["why"] for one in data["not_judged"]}
    assert told["later"].startswith("this is a folder within the folder")
    assert told["lost.csv"].startswith("the target of this link does not exist")
    assert ran("verify", "four-bar", folder / odd, "--report", tmp_path / "sheet.svg").status == 0
    ElementTree.parse(tmp_path / "sheet.svg")


def test_a_folder_that_may_not_be_read_is_bad_input(monkeypatch: pytest.MonkeyPatch) -> None:
    """One line, status 2."""
    def denied(_: Path) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "iterdir", denied)
    done = ran("verify", "four-bar", CASES / "class")
    assert (done.status, done.err) == (
        2, f"{CASES / 'class'}: it cannot be read (Permission denied); a readable folder\n")
