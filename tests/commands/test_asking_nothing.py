"""Scenes that ask nothing: every command draws, tells and checks the bare mechanism instead of failing."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphplan.commands import main

CRANK = """
title = "Crank"
[points]
O = [0, 0]
A = [30, 40]
[links]
1 = "O A"
frame = "O"
[[drive]]
link = "1"
omega = 2.0
"""
NOTHING = "\n[find]\nvelocity = []\nacceleration = []\n"
COMMANDS = [
    ["draw", "-o", "sheet.svg"], ["draw", "--strict", "--plan", "polar", "-o", "sheet.svg"], ["steps"], ["solve"],
    ["solve", "--exact"], ["check"], ["cost"], ["cycle", "--positions", "4"], ["export", "-o", "figure.ggb"],
    ["export", "-o", "figure.tex"], ["live", "-o", "page.html"],
    ["export", "-o", "steps.json"],
]


@pytest.mark.parametrize("asked", ["", NOTHING], ids=["crank alone", "empty lists"])
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_nothing_asked_is_no_fault(command: list[str], asked: str, tmp_path: Path,
                                   monkeypatch: pytest.MonkeyPatch) -> None:
    """A crank without a question, and one with empty lists, is done with exit status 0."""
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text(CRANK + asked)
    assert main([command[0], "scene.toml", *command[1:]]) == 0
