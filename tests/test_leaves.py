"""Leaves: a subject goes with its folder, and leaves the core as it is."""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from face import ran

import graphplan as gp
from graphplan.marking.judge.verdict import STATES

PACKAGE = Path(gp.__file__).parent
LEAVES = sorted(path.parent.name for path in PACKAGE.glob("*/leaf.py"))
SCRIPT = """\
import sys
import graphplan as gp
from graphplan.commands import commands, main
assert gp.__file__.startswith(sys.argv[1])
assert gp.__all__
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


def test_type_checkers_know_the_public_names() -> None:
    """The stub has each name that `import graphplan` offers, from where it stands."""
    stub = ast.parse((PACKAGE / "__init__.pyi").read_text(encoding="utf-8"))
    homes = {alias.name: node.module for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    listed = next(node.value for node in stub.body if isinstance(node, ast.Assign))
    assert sorted(ast.literal_eval(listed)) == sorted(homes) == sorted(gp.__all__)
    assert not [name for name, home in homes.items()
                if home != "graphplan" and not home.endswith(".app") and getattr(gp, name) is not getattr(
                    sys.modules[home], name)]


def test_the_schema_has_the_verdicts_of_the_judge() -> None:
    """What `schema verify` says a verdict may be is what the judge says of steps."""
    schema = json.loads(ran("schema", "verify").out)
    verdicts, tables = list[list[str]](), [schema]
    while tables:
        table = tables.pop()
        tables += [value for value in (table.values() if isinstance(table, dict) else table)
                   if isinstance(value, dict | list)]
        if isinstance(table, dict) and "right" in table.get("enum", ()):
            verdicts.append(table["enum"])
    assert verdicts
    assert all(one == [*STATES] for one in verdicts)
