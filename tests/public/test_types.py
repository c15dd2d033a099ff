"""The types that users' editors and checkers see are those of the values."""

from __future__ import annotations

from pathlib import Path

import pytest

USE = """
import graphplan as gp

scene = gp.at(gp.load("four-bar"), 10)
written: str = scene.toml()
results = gp.solve(scene)
velocity: complex = results.velocity["B"]
rate: float = results.omega["2"]
drawn: complex = gp.construct(scene).velocity["B"]
solved: complex = gp.analytic.solve(scene).velocity["B"]
wrong: float = results.velocity["B"]  # wrong
gp.solev  # wrong
"""


def test_types_are_those_of_the_values(tmp_path: Path) -> None:
    """A vector is a complex number, a name that does not exist is none, a scene that was read can be written."""
    api = pytest.importorskip("mypy.api")
    path = tmp_path / "use.py"
    path.write_text(USE)
    told, _, _ = api.run(["--strict", str(path)])
    wrong = [number for number, line in enumerate(USE.splitlines(), 1) if line.endswith("# wrong")]
    assert [int(line.split(":")[-3]) for line in told.splitlines() if ": error: " in line] == wrong, told
