"""Other places: line ends, code pages, names of files and decimal commas that other systems have."""

from __future__ import annotations

import io
import locale
import os
import sys
from pathlib import Path

import pytest
from face import ran

import graphplan as gp
from graphplan.commands import commands, main

NAME = "Übung 1, Pleuelstange.toml"


def test_line_ends_and_marks_of_windows(tmp_path: Path) -> None:
    """A scene with carriage returns and a byte order mark, in a file with blanks and umlauts, is the same scene."""
    path = tmp_path / NAME
    path.write_bytes(b"\xef\xbb\xbf" + gp.load("four-bar").text.replace("\n", "\r\n").encode())
    scene = gp.load(path)
    assert gp.solve(scene).velocity == gp.solve(gp.load("four-bar")).velocity
    assert scene.replace("points.A.0", 25).points["A"] == (25, 110)
    assert scene.replace("sheet.frame", "gost").sheet.frame == "gost"
    assert ran("draw", path, "-o", path.with_suffix(".svg"), "--set", "title=Ünïcode").status == 0


def test_files_have_line_feeds_everywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The bytes that are written do not hang on the system's line ends."""
    monkeypatch.setattr(os, "linesep", "\r\n")
    gp.solve(gp.load("four-bar")).save(str(tmp_path / "results.json"))
    gp.construct(gp.load("four-bar")).save(tmp_path / "sheet.svg")
    assert ran("new", tmp_path / "scene.toml").status == 0
    assert not any(b"\r" in path.read_bytes() for path in tmp_path.iterdir())


@pytest.mark.parametrize("code_page", ["cp437", "cp1252", "ascii"])
def test_results_are_utf_8_in_every_code_page(code_page: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Standard output has UTF-8 whatever the code page is."""
    written = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding=code_page))
    assert main(["steps", "four-bar", "--language", "lv"]) == 0
    assert "ā" in written.getvalue().decode("utf-8")


@pytest.mark.parametrize("name", [*commands()])
def test_help_is_read_in_every_code_page(name: str) -> None:
    """Help, which Python prints itself, keeps to what old consoles have."""
    assert ran(name, "--help").out.encode("cp437")


def test_a_decimal_comma_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Numbers are written with a point where the locale has a comma."""
    before, kept = gp.solve(gp.load("four-bar")).text, locale.setlocale(locale.LC_ALL)
    for name in ("de_DE.UTF-8", "German_Germany", "lv_LV.UTF-8", "C.UTF-8"):
        try:
            locale.setlocale(locale.LC_ALL, name)
        except locale.Error:
            continue
        try:
            assert gp.solve(gp.load("four-bar")).text == before
        finally:
            locale.setlocale(locale.LC_ALL, kept)
