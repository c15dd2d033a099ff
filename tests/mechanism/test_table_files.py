"""A load's table in a file is named by its file wherever it has a fault, as the scene is."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import run

from graphplan.mechanism.scene import load

FAULTS = {
    "0.6,1000\n0.5,900\n0.6,5\n0.2,1\n": "forces.1.file: ind.csv: the rows turn back ",
    "0.6,1\n0.6,2\n": "forces.1.file: ind.csv: a table of fewer than two places; ",
    "0.6,1\n0.2,x\n": "forces.1.file: ind.csv, line 2: ",
}


@pytest.mark.parametrize("rows", FAULTS)
def test_a_faulty_table_is_named_by_scene_and_file(rows: str, tmp_path: Path,
                                                   capsys: pytest.CaptureFixture[str]) -> None:
    """Rows that go wrong are one line with both files."""
    text = load("ozols-13-6").text
    values = next(line for line in text.splitlines() if line.startswith("values"))
    (tmp_path / "ind.csv").write_text(rows)
    path = tmp_path / "yoke.toml"
    path.write_text(text.replace(values, 'file = "ind.csv"'))
    assert run("solve", str(path), "--at", "90") == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"{path}: {FAULTS[rows]}")
