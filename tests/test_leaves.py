"""Leaves: a subject goes with its folder, and leaves the core as it is."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import graphplan as gp

PACKAGE = Path(gp.__file__).parent
LEAVES = sorted(path.parent.name for path in PACKAGE.glob("*/leaf.py"))
SCRIPT = """\
import sys
import graphplan as gp
from graphplan.commands import commands, main
assert gp.__file__.startswith(sys.argv[1])
gp.__all__.sort()
SAID = ["--help"], ["solve", "four-bar"], ["draw", "four-bar", "-o", "sheet.svg"], ["schema"], ["list", "scenes"]
for words in SAID:
    try:
        assert main(words) == 0
    except SystemExit as end:
        assert end.code == 0
sys.stderr.write(" ".join(commands()))
"""


@pytest.fixture
def without(tmp_path: Path) -> Path:
    """The package, to be made poorer."""
    shutil.copytree(PACKAGE, tmp_path / "graphplan", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


@pytest.mark.parametrize("leaf", LEAVES)
def test_a_subject_goes_with_its_folder(leaf: str, without: Path) -> None:
    """Without a leaf its commands are unknown, and those of the core do what they did."""
    own = (PACKAGE / leaf / "leaf.py").read_text(encoding="utf-8")
    shutil.rmtree(without / "graphplan" / leaf)
    done = subprocess.run([sys.executable, "-c", SCRIPT, str(without)], cwd=without, capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": str(without)})
    assert done.returncode == 0, done.stderr
    left = done.stderr.split()
    assert {"solve", "draw"} <= {*left}
    assert not [name for name in left if f'"{name}": Command(' in own]
