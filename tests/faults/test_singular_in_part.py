"""A pose that is singular in part is drawn and told as far as it is regular, with the reason for the rest."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from graphplan.commands import main

SCENE = """title = "A dyad in its dead position at a four-bar"
[points]
O = [0, 0]
A = [0, 100]
B = [200, 120]
C = [250, 0]
D = [450, 120]
E = [600, 120]
[links]
frame = "O C E"
1 = "O A"
2 = "A B"
3 = "B C"
4 = "B D"
5 = "D E"
[[drive]]
link = "1"
omega = 1
"""


@pytest.fixture
def scene(tmp_path: Path) -> str:
    """The scene as a file."""
    path = tmp_path / "part.toml"
    path.write_text(SCENE)
    return str(path)


@pytest.mark.parametrize("options", [(), ("--plan", "polar"), ("--set", "sheet.curves=all"), ("--language", "de")])
def test_the_regular_part_is_drawn(scene: str, options: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    """The sheet has the vectors of the four-bar, and none of the dyad."""
    assert main(["draw", scene, *options]) == 0
    sheet = capsys.readouterr().out
    assert 'data-vector="velocity B"' in sheet
    assert 'data-vector="velocity D"' not in sheet


def test_the_protocol_says_what_is_missing(scene: str, capsys: pytest.CaptureFixture[str]) -> None:
    """What is left out is named with the reason that `solve` gives."""
    assert main(["solve", scene]) == 0
    why = json.loads(capsys.readouterr().out)["reasons"]["links"]["4"]
    assert main(["steps", scene, "--json"]) == 0
    assert f"not drawn: 4, 5, D: {why}" in json.loads(capsys.readouterr().out)["forms"]
