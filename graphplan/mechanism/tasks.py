"""Tasks: files of one question, such as a cam or a rotor, read by a table of fields as scenes are; all faults at once.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, TypeVar

from graphplan.errors import Fault, SceneError
from graphplan.mechanism import sections
from graphplan.mechanism.fields import Field, Names, Table
from graphplan.mechanism.items import Faults, Item
from graphplan.mechanism.presentation import SHEET
from graphplan.mechanism.scene import source_text, tables_of
from graphplan.mechanism.units import Units
from graphplan.mechanism.values import TEXT

T = TypeVar("T")
LOOK = "paper", "frame", "language", "convention", "owner", "number", "date", "drawn_by", "approved_by"


def _only(table: Table, *names: str) -> Table:
    """A table of a scene, of which a task has these keys alone."""
    return table._replace(fields=tuple(field for field in table.fields if field.name in names))


def task_table(says: str, units: tuple[str, ...], *fields: Field) -> Table:
    """The table of a whole task: its own fields, and title, source, these units and the sheet as scenes have them."""
    return Table(says, (
        Field("title", "what it is", TEXT),
        Field("source", "where it comes from: author, title, year, figure", TEXT),
        Field("units", "the units of the task", _only(sections.UNITS, *units)),
        *fields,
        Field("sheet", "how the sheet should look; the command line has the last word", _only(SHEET, *LOOK)),
    ))


def task_text(source: str, command: str) -> str:
    """The text of a file or of standard input (`-`); fails with `SceneError`."""
    if source != "-" and not os.path.exists(source):
        fault = Fault("file", "no such file", f"a task file, as graphplan {command} --help has one")
        raise SceneError(source, (fault,))
    return source_text(source, source)


def read_task(whole: Table, text: str, name: str, made: Callable[[dict[str, Any], Units, Faults], T]) -> T:
    """What is `made` of the values of a TOML text, by key, and of its units, and may have faults of its own.

    Fails with `SceneError`, one line a fault, in which `name` stands for the file.
    """
    faults = Faults()
    item, names = Item(tables_of(text, name), "", faults), Names(())
    items = item.fields(whole.keys, {}) or {}
    read: dict[str, Any] = {}
    for field in sorted(whole.fields, key=lambda field: field.name != "units"):  # the sheet speaks of units
        if field.name in items:
            read[field.name] = field.kind.read(items[field.name], names)
        elif field.wanted:
            faults.add(field.name, f"the task has no {field.name}", field.wanted)
        names.units = read.get("units") or names.units
    task = made(read, names.units, faults) if len(faults) == 0 else None
    if task is None or len(faults):
        raise SceneError(name, tuple(faults))
    return task
