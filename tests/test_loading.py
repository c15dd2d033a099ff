"""What a command loads: no more than it needs, so that it begins at once."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest


def loaded(tmp_path: Path, *arguments: str) -> set[str]:
    """The modules that Python loads for a command, or for `-c` and a line."""
    command = [sys.executable, "-v", *arguments]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    return set(re.findall(r"(?m)^import '([\w.]+)'", done.stderr))


def test_importing_graphplan_loads_no_room(tmp_path: Path) -> None:
    """What is not used is not loaded: a name of the package is looked up when it is first asked for."""
    assert not [name for name in loaded(tmp_path, "-c", "import graphplan") if name.startswith("graphplan.")]


def test_solving_loads_no_sheet(tmp_path: Path) -> None:
    """Solving eight links without loads loads no sheet, no back end, and none of the packages that draw."""
    modules = loaded(tmp_path, "-m", "graphplan", "solve", "alt-eight-link")
    assert "graphplan.app.solve" in modules
    assert not modules & {"matplotlib", "shapely", "svgwrite", "graphplan.app.draw"}
    assert not [name for name in modules if name.startswith(("graphplan.sheet", "graphplan.output"))]


@pytest.mark.parametrize("command", [
    "solve jaanimets-10", "cycle kinytskyi --positions 3 -o x.json",
    "cycle four-bar --positions 12 --plot x.svg --of 3",
    "draw four-bar -o x.svg", "draw four-bar -o x.pdf", "chart --help",
])
def test_only_plain_diagrams_charts_and_pictures_load_matplotlib(tmp_path: Path, command: str) -> None:
    """Numbers, sheets and constructed diagrams begin without it."""
    assert "matplotlib" not in loaded(tmp_path, "-m", "graphplan", *command.split())


def test_a_plain_diagram_is_drawn_by_matplotlib(tmp_path: Path) -> None:
    """A joint's force over the cycle is one."""
    plot = "cycle jaanimets-10 --positions 12 --plot x.svg --of"
    assert "matplotlib" in loaded(tmp_path, "-m", "graphplan", *plot.split(), "reaction B")


def test_a_flywheel_loads_neither_masked_arrays_nor_pools(tmp_path: Path) -> None:
    """A machine's numbers load neither numpy's masked arrays, which take as long as numpy, nor what shares work out."""
    modules = loaded(tmp_path, "-m", "graphplan", "flywheel", "ozols-13-6", "--positions", "12")
    assert not modules & {"numpy.ma", "multiprocessing", "concurrent.futures"}


@pytest.mark.parametrize(("scene", "touched"), [("four-bar", False), ("jaanimets-10", True)])
def test_scenes_without_loads_touch_no_force_code(tmp_path: Path, scene: str, touched: bool) -> None:
    """What forces need is loaded where there are loads, and nowhere else."""
    modules = loaded(tmp_path, "-m", "graphplan", "draw", scene)
    assert {name in modules for name in ("graphplan.methods.forces", "graphplan.solver.statics")} == {touched}
