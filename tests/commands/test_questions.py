"""What is more often a slip of the pen than meant is asked about, and computed all the same."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import run

SLIDER = """[points]
O = [0, 0]
A = [30, 40]
B = [150, 0]
[links]
1 = "O A"
2 = "A B"
3 = "B"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
[[drive]]
link = "1"
omega = 1
[[forces]]
on = "3"
at = "B"
value = [-10, -1]
[balance]
link = "1"
[[friction]]
at = "A"
radius = 1
coefficient = 0.1
[[friction]]
slide = ["3", "frame"]
coefficient = {}
"""


@pytest.mark.parametrize("command", ["solve", "check", "steps"])
def test_a_coefficient_of_friction_in_percent_is_asked_about(command: str, tmp_path: Path,
                                                             capsys: pytest.CaptureFixture[str]) -> None:
    """Above 2 one line says where it stands and what was perhaps meant; below, or if --quiet, nothing is said."""
    path = tmp_path / "scene.toml"
    path.write_text(SLIDER.format("2.5"))
    assert run(command, str(path)) == 0
    assert capsys.readouterr().err == (f"{path}: friction.2.coefficient: 2.5 is more than dry surfaces have; perhaps "
                                       "0.025, if that is in percent\n")
    assert run(command, str(path), "--quiet") == 0
    path.write_text(SLIDER.format("1.9"))
    assert run(command, str(path)) == 0
    assert capsys.readouterr().err == ""
