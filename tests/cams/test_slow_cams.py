"""Whether a diagram is zero is asked of the lift, not of the unit or the speed."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_base import BOTH, ROLLER, text

from graphplan.commands import main


@pytest.mark.parametrize("rpm", ["300", "1e-4"])
def test_a_slow_cam_has_its_velocity_acceleration_and_jerk(rpm: str, tmp_path: Path) -> None:
    """However slowly a cam turns, no derivative of its lift is said to be zero."""
    task, sheet = tmp_path / "task.toml", tmp_path / "sheet.svg"
    task.write_text(text(f"{ROLLER}offset = 6\n", BOTH, "sine").replace("rpm = 300", f"rpm = {rpm}"))
    assert main(["cam", str(task), "-q", "-o", str(sheet)]) == 0
    drawn = sheet.read_text()
    assert " = 0<" not in drawn
