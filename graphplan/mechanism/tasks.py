"""Tasks: files of one question, such as a cam or a rotor, each read by a table of fields as scenes are."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from graphplan.errors import Fault, SceneError
from graphplan.mechanism.fields import TEXT, Faults, Field, SceneItem, SceneNames, Table
from graphplan.mechanism.model import Presentation
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names, source_text, tables_of
from graphplan.mechanism.sections import SHEET, UNITS
from graphplan.mechanism.units import Units

LOOK = "paper", "frame", "language", "convention", "owner", "number", "date", "drawn_by", "approved_by"


@dataclass(frozen=True)
class SheetTask:
    """The keys that every task has; `name` is its file as the user wrote it."""

    title: str
    source: str
    name: str
    units: Units
    sheet: Presentation


T = TypeVar("T")


def _keep_fields(table: Table, *names: str) -> Table:
    """A table of a scene, reduced to these keys."""
    return table._replace(fields=tuple(field for field in table.fields if field.name in names))


def task_table(says: str, units: tuple[str, ...], *fields: Field) -> Table:
    """The table of a whole task: its own fields, and title, source, these units and the sheet as scenes have them."""
    return Table(says, (
        Field("title", "what it is", TEXT),
        Field("source", "where it comes from: author, title, year, figure", TEXT),
        Field("units", "the units of the task", _keep_fields(UNITS, *units)),
        *fields,
        Field("sheet", "how the sheet should look; the command line has the last word", _keep_fields(SHEET, *LOOK)),
    ))


def task_text(source: str, command: str) -> str:
    """The text of a file, of standard input (`-`) or of a packaged task; fails with `SceneError`."""
    if source != "-" and not os.path.exists(source) and source not in packaged_names(TASK_FOLDER):
        fault = Fault("file", "no such file", f"a task file, as graphplan {command} --help has one")
        raise SceneError(source, (fault,))
    return source_text(source, source)


def read_task(whole: Table, text: str, name: str,
              made: Callable[[dict[str, Any], dict[str, Any], Faults], T]) -> T:
    """Read the values of a TOML text by key and make a task of them with `made`, which may add faults.

    Fails with `SceneError`, one line a fault, in which `name` stands for the file.
    """
    faults = Faults()
    tables = tables_of(text, name)
    item, names = SceneItem(tables, "", faults), SceneNames((), tables=tables)
    items = item.fields(whole.keys, {}) or {}
    read: dict[str, Any] = {}
    for field in sorted(whole.fields, key=lambda field: field.name != "units"):  # the sheet speaks of units
        if field.name in items:
            read[field.name] = field.kind.read(items[field.name], names)
        elif field.wanted:
            faults.add(field.name, f"the task has no {field.name}", field.wanted)
        names.units = read.get("units") or names.units
    shared = {"title": read.get("title", ""), "source": read.get("source", ""), "name": name, "units": names.units,
              "sheet": read.get("sheet") or Presentation()}
    task = made(read, shared, faults) if len(faults) == 0 else None
    if task is None or len(faults):
        raise SceneError(name, tuple(faults))
    return task
