"""Each room has one table of tolerances; each entry says of which size it is a part, or its unit, and why."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from pathlib import Path

import pytest

import graphplan as gp

PACKAGE = Path(gp.__file__).parent
FILES = sorted(PACKAGE.rglob("*.py"))
TABLES = [path for path in FILES if path.name == "tolerances.py"]
# Small numbers that are none of rounding: lines of scales, what was measured, what may be asked for.
REASONED = {
    "accuracy/survey/machine.py": {"1e-12", "1e-16", "1e-20", "1e-40"},  # the ends of an axis, and proven digits
    "accuracy/survey/stability.py": {"1e-4", "1e-8"},  # of 100 mm, at an axis
    "public/subjects.py": {"1e-9"},  # the least tolerance that --tolerance takes
    "marking/scans/measures.py": {"6e-4", "1e-5"},  # the grain of paper, and its stiffness, measured
}


def named(path: Path) -> str:
    return str(path.relative_to(PACKAGE))


def small_numbers(text: str) -> set[str]:
    """The numbers of a source below a thousandth that are written with an exponent."""
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    return {token.string for token in tokens if token.type == tokenize.NUMBER and "e-" in token.string.lower()
            and float(token.string) < 1e-3}


def constants(text: str) -> list[ast.Assign | ast.AnnAssign]:
    """The assignments of a module to names of its own."""
    return [node for node in ast.parse(text).body if isinstance(node, ast.Assign | ast.AnnAssign)]


def uncommented(text: str) -> list[str]:
    """The entries of a table without a comment that says of what, and why: beside it or on the lines above it."""
    lines = text.splitlines()

    def comment(node: ast.Assign | ast.AnnAssign) -> str:
        beside, above = lines[node.lineno - 1].partition("  # ")[2], node.lineno - 2
        words = [beside]
        while lines[above].startswith("# ") and not lines[above].startswith("# ----"):
            words.append(lines[above])
            above -= 1
        return " ".join(words)

    return [ast.unparse(node) for node in constants(text) if not re.search(r"\w+.*:|\w+ \w+ \w+", comment(node))]


@pytest.mark.parametrize(("text", "seen"), [
    ("a = abs(b) < 1e-9", {"1e-9"}), ("LEAST = 5E-4", {"5E-4"}), ("ms = 1e-3", set()), ("'1e-9'", set()),
])
def test_small_numbers_are_seen(text: str, seen: set[str]) -> None:
    """A number below a thousandth is seen in code, not in texts."""
    assert small_numbers(text) == seen


def test_entries_without_a_reason_are_seen() -> None:
    """A comment stands beside an entry or above it; a heading is none."""
    bare = "# ---- heads ----\n\nA = 1e-9\nB = 1e-9  # of the extent: points no further apart are one\n"
    assert uncommented(bare) == ["A = 1e-09"]
    assert uncommented("# of the extent: points no further apart are one\nA = 1e-9\n\nB = 1\n") == ["B = 1"]


@pytest.mark.parametrize("path", [path for path in FILES if path not in TABLES], ids=named)
def test_tolerances_stand_in_tables(path: Path) -> None:
    """Outside the tables stands no small number but the reasoned ones."""
    assert small_numbers(path.read_text(encoding="utf-8")) == REASONED.get(named(path), set())


@pytest.mark.parametrize("path", TABLES, ids=named)
def test_each_tolerance_has_its_reason(path: Path) -> None:
    """Each entry of a table has its comment, and a table is a room's, in that room."""
    assert path.parent.parent == PACKAGE
    assert not uncommented(path.read_text(encoding="utf-8"))


def test_each_room_has_its_table() -> None:
    """The rooms that compute have tables."""
    assert {path.parent.name for path in TABLES} == {
        "accuracy", "cams", "check", "cycle", "importing", "kernel", "machine", "marking", "mechanism", "methods",
        "output", "sheet", "solver", "synthesis"}


@pytest.mark.parametrize("path", TABLES, ids=named)
def test_each_tolerance_is_used(path: Path) -> None:
    """What stands in a table is imported somewhere, or read by its name."""
    names = [target.id for node in constants(path.read_text(encoding="utf-8")) if isinstance(node, ast.Assign)
             for target in node.targets if isinstance(target, ast.Name)]
    users = [other.read_text(encoding="utf-8") for other in FILES if other != path]
    users = [text for text in users if f"graphplan.{path.parent.name}" in text and "tolerances" in text]
    assert [name for name in names if not any(re.search(rf"\b{name}\b", text) for text in users)] == []


def test_no_constant_is_called_nothing() -> None:
    """A constant names the quantity that it bounds."""
    found = [named(path) for path in FILES for node in constants(path.read_text(encoding="utf-8"))
             for name in ast.walk(node) if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store)
             and name.id.strip("_") == "NOTHING"]
    assert not found
