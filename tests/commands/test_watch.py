"""`graphplan watch`: the sheet follows the file, whatever an editor does to it."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from command_line import heeds_ctrl_c

from graphplan.commands import main
from graphplan.commands.new import template

ROOT = Path(__file__).parent.parent.parent
SCENE = template("four-bar")
PATIENCE = 600.0  # seconds after which it hangs, on any machine


class Watch:
    """A running `graphplan watch`, and what it tells."""

    def __init__(self, scene: Path):
        self.process = subprocess.Popen([sys.executable, "-m", "graphplan", "watch", str(scene)], text=True,
                                        stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, cwd=ROOT,
                                        preexec_fn=heeds_ctrl_c)
        self.lines: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.lines.put(line)

    def tells(self, words: str) -> None:
        """Wait for the next line, which has these words."""
        assert words in self.lines.get(timeout=PATIENCE)


@pytest.fixture
def scene(tmp_path: Path) -> Path:
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
    sheet = scene.with_suffix(".svg")
    other = tmp_path / "scene.toml~"
    other.write_text(SCENE.replace("angle = 60", "angle = 80"))
    os.replace(other, scene)
    watch.tells("drawn")
    moved = sheet.read_bytes()
    scene.unlink()
    with pytest.raises(queue.Empty):
        watch.lines.get(timeout=1.0)
    scene.write_text(SCENE.replace("angle = 60", "angle = 80"))
    os.utime(scene)
    with pytest.raises(queue.Empty):
        watch.lines.get(timeout=1.0)
    scene.unlink()
    scene.write_text(SCENE)
    watch.tells("drawn")
    assert sheet.read_bytes() != moved


@pytest.mark.parametrize("name", ["nosuch.toml", "-", "four-bar"])
def test_only_files_are_watched(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                capsys: pytest.CaptureFixture[str]) -> None:
    """What is no file is refused in one line with status 2."""
    monkeypatch.chdir(tmp_path)
    assert main(["watch", name]) == 2
    assert capsys.readouterr().err.count("\n") == 1
