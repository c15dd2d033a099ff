"""README against the package: its tables of commands, folders, scene keys, and of how to add a thing."""

from __future__ import annotations

import re
from pathlib import Path

from graphplan.cams.task import TASK
from graphplan.commands import SUBCOMMANDS
from graphplan.mechanism.schema import reference

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def section(title: str) -> str:
    """A section of README, to the next of its level."""
    return re.split(r"(?m)^## ", README.split(f"\n## {title}\n")[1])[0]


def first_cells(text: str) -> list[str]:
    """What stands in backticks in the first cells of a table's rows."""
    return re.findall(r"(?m)^\| `([^`]+)`", text)


def test_every_command_is_told() -> None:
    """The table of commands has each once."""
    told = [cell.split()[1] for cell in first_cells(section("A scene"))]
    assert sorted(told) == sorted(SUBCOMMANDS)


def test_every_folder_is_told() -> None:
    """The table of folders has each folder of the package."""
    folders = {path.name for path in (ROOT / "graphplan").iterdir() if path.is_dir() and path.name[0] != "_"}
    assert {cell.rstrip("/") for cell in first_cells(section("How it works"))} == folders


def test_every_key_is_told() -> None:
    """The reference of scene keys is what the records say: `graphplan schema keys` prints it anew."""
    assert reference() in section("Keys of a scene")
    assert reference(TASK) in section("Cams")


def test_what_is_to_be_copied_is_there() -> None:
    """Each file that the table of additions names is there, and each kind of addition has one."""
    rows = re.findall(r"(?m)^\| ([a-z ]+) \|(.*)\|$", section("How to add"))
    assert [name for name, _ in rows] == ["to add", "primitive", "compound", "form", "pair", "method", "mistake",
                                          "back end", "language", "scene key", "scene", "command"]
    for name, row in rows[1:]:
        paths = re.findall(r"`([\w/.-]+\.\w+)`", row)
        assert paths, name
        assert [path for path in paths if not (ROOT / path).exists()] == []
