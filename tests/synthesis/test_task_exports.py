"""Exports of tasks of synthesis: opened again, every mark lies where the sheet has it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import graphplan as gp
from graphplan.commands import main
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names

TASKS = packaged_names(TASK_FOLDER)


@pytest.mark.parametrize("name", TASKS)
def test_geogebra_has_the_construction(name: str, tmp_path: Path) -> None:
    """Read again as what a student hands in, all that is drawn in GeoGebra is right."""
    file = tmp_path / "task.ggb"
    assert main(["export", name, "-q", "-o", str(file)]) == 0
    findings = gp.verify(name, file).json()
    assert (findings["score"]["total"], findings["first_wrong"]) == (100, None)


@pytest.mark.parametrize("name", TASKS)
def test_given_points_lie_as_on_the_sheet(name: str, tmp_path: Path) -> None:
    """TikZ begins with the given points, at their distances on the sheet."""
    file = tmp_path / "task.tex"
    assert main(["export", name, "-q", "-o", str(file)]) == 0
    number = r"(-?[0-9.]+)"
    written = rf"\\coordinate \((\w+)\) at \({number},\s*{number}\)"
    spots = {letter: complex(float(x), float(y))
             for letter, x, y in re.findall(written, file.read_text("utf-8"), re.MULTILINE)}
    result = gp.synthesize(name).synthesis.values
    program = result.drawing.program
    given = [complex(*result[step.index]) for step in program.steps[:program.givens]]
    places = list(spots.values())[:len(given)]
    scale = {abs(b - a) / abs(w - v) for a, v in zip(places, given, strict=True)
             for b, w in zip(places, given, strict=True) if v != w}
    assert len(places) == len(given)
    assert max(scale, default=1) == pytest.approx(min(scale, default=1), rel=1e-3)


def test_code_and_sheets_are_of_other_commands(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One line says which, and nothing is written."""
    file = tmp_path / "task.c"
    assert main(["export", "gear-21-1", "-o", str(file)]) == 2
    assert "graphplan synthesize" in capsys.readouterr().err
    assert not file.exists()
