"""What `tests/lint.py` looks for is found where it stands, and nowhere else."""

from __future__ import annotations

from pathlib import Path

import pytest
from lint import OF_A_FILE, PACKAGE, File, is_bare


@pytest.mark.parametrize(("name", "text", "said"), [
    ("a.py", "LONGEST = 3", "LONGEST names no quantity"),
    ("a.py", "LEAST_MM = 3", ""),
    ("a.py", "def near(a, b):\n    return abs(a - b) < 1e-9", "1e-9 stands in tolerances.py"),
    ("a.py", "ms = 1e-3; name = '1e-9'", ""),
    ("kernel/tolerances.py", "# ---- a ----\n\nA = 1e-9\nB_PART = 1e-9  # of the extent: points", "3: A says of"),
    ("kernel/tolerances.py", "# of the extent: points no further apart are one\nA = 1e-9", ""),
    ("marking/judge/measures.py", "LETTER_MM = 3  # how near a letter stands [guessed]", "LETTER_MM says of what"),
    ("marking/judge/measures.py", "LETTER_MM = 3  # how near a letter stands [tuned]", ""),
    ("sheet/a.py", "if step.op.name == 'meet': pass", "is told by its name"),
    ("sheet/a.py", "INK = {'parallel': 1}", "is told by its name"),
    ("sheet/a.py", "print(f'{step.op.name}')", ""),
    ("kernel/a.py", "INK = {'parallel': 1}", ""),
    ("sheet/a.py", "step.panel.startswith('force plan')", "a name is cut"),
    ("sheet/a.py", "'moment' in kind", "a word is looked for"),
    ("sheet/a.py", "step.why == 'a law'", "words are compared"),
    ("sheet/a.py", "import_module('graphplan.' + name)", "which no contract of rooms sees"),
])
def test_faults_of_a_file_are_named(name: str, text: str, said: str) -> None:
    """A line says what is wrong and where; what is right is passed over."""
    faults = [fault for rule in OF_A_FILE for fault in rule(File(PACKAGE / name, text + "\n"))]
    assert [said in fault and fault.startswith(name) for fault in faults] == [True] * bool(said)


@pytest.mark.parametrize(("function", "bare"), [
    ("_told", True), ("joined", True), ("_within", True), ("speed", False), ("joined_links", False), ("read", False),
    ("__init__", False),
])
def test_bare_names_are_seen(function: str, bare: bool) -> None:
    """A participle alone says little; with its noun, or as a verb, it says enough."""
    assert is_bare(function) == bare


def test_files_are_named_by_what_they_hold() -> None:
    """None is a drawer for odds and ends."""
    assert not {"utils", "helpers", "common", "util", "misc"} & {Path(path).stem for path in PACKAGE.rglob("*.py")}
