"""Poles that students hand in, as numbers of a table."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphplan.commands import main

SCENE = """
points = { O = [0, 0], A = [90, 80], B = [300, 0] }
links = { 1 = "O A", 2 = "A B", 3 = "B", frame = "O" }
slides = [{ link = "3", along = "frame", at = "B", direction = [1, 0] }]
drive = [{ link = "1", omega = 2 }]
find = { poles = ["2 frame", "1 3", "3 frame"] }
"""
TABLE = """quantity,of,x,y,unit
pole,2 frame,300,266.7,mm
pole,1 3,0,120,mm
heading to a pole,3 frame,0,1,1
"""


def test_poles_are_judged_as_places(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A pole is a place, one at infinity a heading: each is right as far off as a pencil may be, and no further."""
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "table.csv").write_text(TABLE)
    main(["verify", str(tmp_path / "scene.toml"), str(tmp_path / "table.csv")])
    told = capsys.readouterr().out
    assert "Wrong result: pole 1 3" in told
    assert told.count("Wrong result") == 1
    assert "not handed in" not in told
