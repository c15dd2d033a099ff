"""Drawings of tasks of synthesis, judged: own sheets, drawings by hand with choices of their own, and mistakes."""

from __future__ import annotations

from pathlib import Path

import pytest
from tiers import sample

import graphplan as gp
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names

TASKS = packaged_names(TASK_FOLDER)
QUICK = ["cognates-four-bar", "function-rocker", "guidance-fixed", "stroke-lever"]


@pytest.mark.parametrize("name", sample(QUICK, TASKS))
def test_own_sheets_are_right(name: str, tmp_path: Path) -> None:
    """The sheet of a packaged task has a hundred points when it is handed in."""
    gp.synthesize(name).save(tmp_path / "sheet.svg")
    findings = gp.verify(name, tmp_path / "sheet.svg").json()
    assert (findings["score"]["total"], findings["first_wrong"]) == (100, None)
