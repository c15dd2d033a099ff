"""Answers to a rotor's task: each number is judged by the true one, as far as a pencil allows."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from graphplan.commands import main

TASK = """
[rotor]
planes = [0, 600]
masses = [
  { mass = 0.5, radius = 100, angle = 0, at = 200 },
  { mass = 0.8, radius = 80, angle = 120, at = -100 },
  { mass = 0.3, radius = 150, angle = 250, at = 500 },
]
"""
RUNS = "[rotor]\nplanes = [0]\n[trial]\namplitudes = [3, 4.1, 3.5]\nmass = 0.1\nradius = 40\n"
ALL_RIGHT = ("correction,I,58,kg·mm", "angle,I,276.8,°", "correction,II,0.0455,kg·m", "angle,II,-258.5,",
             "static unbalance,,13.3,kg·mm", "moment,,0.0272,kg·m²")


def judge(folder: Path, task: str, *rows: str) -> int:
    """The exit status of the command for these answers."""
    (folder / "task.toml").write_text(task)
    (folder / "answers.csv").write_text("\n".join(["quantity,of,value,unit", *rows, ""]))
    return main(["verify", str(folder / "task.toml"), str(folder / "answers.csv"), "--json"])


@pytest.mark.parametrize(("task", "rows", "wrong"), [
    (TASK, ALL_RIGHT, {}),
    (TASK, ("correction,I,58,g·mm", *ALL_RIGHT[1:]), {"correction I": "0.001 times as large: a unit is mistaken"}),
    (TASK, (ALL_RIGHT[0], "angle,I,96.5,°", *ALL_RIGHT[2:]), {"angle I": "it is opposite"}),
    (TASK, ("correction,I,45.4,kg·mm", *ALL_RIGHT[1:]), {"correction I": "this is that of correction II"}),
    (TASK, (*ALL_RIGHT[:3], "angle,II,258.3,°", *ALL_RIGHT[4:]), {"angle II": "counted clockwise"}),
    (TASK, ("correction,I,70,kg·mm", *ALL_RIGHT[1:]), {"correction I": ""}),
    (RUNS, ("correction,I,5.1,kg·mm", "angle,I,99.3,°", "static unbalance,,5.1,kg·mm"), {}),
    (RUNS, ("correction,I,5.1,kg·mm", "angle,I,-99.3,°", "static unbalance,,5.1,kg·mm"), {}),
])  # fmt: skip
def test_numbers_are_judged(task: str, rows: tuple[str, ...], wrong: dict[str, str], tmp_path: Path,
                            capsys: pytest.CaptureFixture[str]) -> None:
    """What is within three deviations of a pencil is right, whatever its unit; of the rest it says what went wrong."""
    assert judge(tmp_path, task, *rows) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["right"] == found["of"] - len(wrong)
    astray = [one for one in found["answers"] if one["state"] == "wrong"]
    assert {f"{one['quantity']} {one['of']}": one["hint"] for one in astray} == wrong


@pytest.mark.parametrize(("row", "line"), [
    ("speed,I,3,", "'speed' of 'I' is not asked for"),
    ("correction,I,3,mm", "'mm' is not a unit such as"),
    ("correction,I,three,kg·mm", "line 2: value"),
])  # fmt: skip
def test_other_answers_are_refused(row: str, line: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is not asked for, has a wrong unit, or is not a number is one line and exit 2."""
    assert judge(tmp_path, TASK, row) == 2
    told = capsys.readouterr().err
    assert line in told
    assert len(told.splitlines()) == 1
