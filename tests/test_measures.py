"""The numbers by which students' drawings are read, judged and marked stand in one table a folder, with unit, meaning
and how they were found.
"""

from __future__ import annotations

import ast
import re
from importlib import import_module
from pathlib import Path

import pytest
from sources import FILES, PACKAGE, parsed

FOLDERS = {  # how their numbers are found
    "judge": {"practice", "tuned", "defined", "cost"},
    "scans": {"practice", "measured", "tuned", "defined", "cost"},
    "files": {"assumed", "defined", "cost"}, "classroom": {"assumed", "defined", "cost"},
}  # fmt: skip
OF_CONSTANTS = {"files", "classroom"}  # in whose functions units, powers of ten and lengths of messages stand too
# Numbers that measure nothing: counts of coordinates and corners, halves, decimals, degrees of a turn, 8 bits.
PLAIN = {0, 1, 2, 3, 4, 0.5, 10, 100, 180, 255, 360}
LAYOUT = {"judge/overlay.py", "judge/findings.py"}  # what is drawn of a report stands by its drawing
FORMATS = {"scans/image.py"}  # the places of sizes in the headers of files
NO_MEASURES = {"SENSES", "FROM_POINTS", "UNMARKED", "DEEDS", "SURVIVAL", "STDERR", "PLACES", "REFERENCES",
               "OTHER_SIDES", "MB"}  # signs, formulas, units


def tables() -> list[Path]:
    return [PACKAGE / "marking" / folder / "measures.py" for folder in FOLDERS]


def measured(text: str) -> set[float]:
    """The numbers of a source that are not plain, and those of its constants."""
    return constants(text) | {number for number in numbers(ast.parse(text)) if number not in PLAIN}


def constants(text: str, sort: type | tuple[type, ...] = ast.expr) -> set[float]:
    """The numbers of a source's constants, of those alone that are of a sort of expression."""
    statements = [node for node in ast.parse(text).body if isinstance(node, ast.Assign | ast.AnnAssign)
                  and isinstance(node.value, sort)
                  and not NO_MEASURES.intersection(name.id for name in ast.walk(node) if isinstance(name, ast.Name))]
    return {number for node in statements for number in numbers(node)}


def own_numbers(path: Path) -> set[float]:
    """The numbers of a file that should stand in its folder's table."""
    text = path.read_text(encoding="utf-8")
    if path.parent.name in OF_CONSTANTS:
        return constants(text, (ast.Constant, ast.Tuple, ast.BinOp, ast.UnaryOp))
    return measured(text)


def numbers(tree: ast.AST) -> set[float]:
    return {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)
            and isinstance(node.value, int | float) and not isinstance(node.value, bool)}


def comments(text: str) -> dict[str, str]:
    """The constants of a table with their comments: beside each, or on the lines above it."""
    lines, found = text.splitlines(), {}
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign | ast.AnnAssign):
            above, words = node.lineno - 2, [lines[node.lineno - 1].partition("  # ")[2]]
            while lines[above].startswith("# ") and not lines[above].startswith("# ----"):
                words.insert(0, lines[above].removeprefix("# "))
                above -= 1
            target = node.targets[0] if isinstance(node, ast.Assign) else node.target
            found[ast.unparse(target)] = " ".join(filter(None, words))
    return found


@pytest.mark.parametrize(("text", "found"), [
    ("NEAR_MM = 2", {2}), ("def f(x):\n    return x < 0.7", {0.7}), ("def f(x):\n    return 2 * x", set()),
    ("NAMES = 'a', 'b'", set()),
])
def test_numbers_are_seen(text: str, found: set[float]) -> None:
    """A constant is seen whatever its number is, a number within a function where it is not plain."""
    assert measured(text) == found


@pytest.mark.parametrize("folder", FOLDERS)
def test_numbers_stand_in_tables(folder: str) -> None:
    """Outside its table no file of the folder has a number of its own."""
    files = [path for path in sorted((PACKAGE / "marking" / folder).glob("*.py")) if path.name != "measures.py"]
    assert {path.name: found for path in files if f"{folder}/{path.name}" not in LAYOUT | FORMATS
            and (found := own_numbers(path))} == {}


@pytest.mark.parametrize("path", tables(), ids=lambda path: path.parent.name)
def test_each_number_has_its_meaning(path: Path) -> None:
    """Each number says what it means and how it was found, by a way that the table knows; its name has two words."""
    found, ways = comments(path.read_text(encoding="utf-8")), FOLDERS[path.parent.name]
    table = vars(import_module(f"graphplan.marking.{path.parent.name}.measures"))
    assert set(found) == {name for name, value in table.items()
                          if name.isupper() and not isinstance(value, str)} - NO_MEASURES
    assert [name for name, words in found.items() if not re.fullmatch(rf".{{8,}} \[({'|'.join(ways)})\]", words)] == []
    assert [name for name in found if "_" not in name] == []


@pytest.mark.parametrize("path", tables(), ids=lambda path: path.parent.name)
def test_each_number_is_used(path: Path) -> None:
    """Every number of a table is read."""
    read = {node.attr for other in FILES for node in ast.walk(parsed(other))
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "measures"}
    assert set(comments(path.read_text(encoding="utf-8"))) - read == set()
