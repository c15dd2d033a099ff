"""List the packaged scenes, with their links and results, and the tasks of `graphplan synthesize`.

examples:
  graphplan list
  graphplan list --json              the scenes
  graphplan list tasks --json        the tasks of synthesize
"""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Iterator, Sequence
from typing import Any

from graphplan import leaves
from graphplan.app.files import as_json, write
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import TASK_FOLDER, load, packaged_names, source_text, tables_of

ASKED = {"velocity": "v", "acceleration": "a", "forces": "F"}
HEAD = ("scene", "links", "asks", "title", "source")
LEGEND = "asks: " + ", ".join(f"{letter} for {what}" for what, letter in ASKED.items())
TASK_HEAD = ("task", "finds", "title", "source")
GAP = "  "


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="as data, with the names of links and points")
    command.add_argument("what", nargs="?", choices=("scenes", "tasks"), help="these alone; of --json the scenes")


def run(options: argparse.Namespace) -> int:
    what = options.what or ("scenes" if options.json else "")
    tasks = [] if what == "scenes" else [_packaged_task(name) for name in packaged_names(TASK_FOLDER)]
    scenes = [] if what == "tasks" else [load(name) for name in packaged_names()]
    rows = [(each.name, each.kind, each.title, each.source) for each in tasks]
    if options.json:
        write(as_json([*map(_data, scenes), *(dict(zip(("name", *TASK_HEAD[1:]), row, strict=True)) for row in rows)]))
        return 0
    width = shutil.get_terminal_size().columns if sys.stdout and sys.stdout.isatty() else None
    blocks = [[*fit_columns([HEAD, *map(_row, scenes)], width), "", LEGEND]] if scenes else []
    blocks += [[*fit_columns([TASK_HEAD, *rows], width)]] if rows else []
    write("\n\n".join("\n".join(block) for block in blocks) + "\n")
    return 0


def _packaged_task(name: str) -> Any:
    """A packaged task, as the module of its kind reads it."""
    kind = leaves.kind_of_task(tables_of(source_text(name, name), name))
    assert kind is not None
    return leaves.module(kind.module).load(name)


def _kinds_of_results(scene: Scene) -> Iterator[str]:
    """Yield the kinds of results that a scene asks for."""
    find = scene.find
    for kind, points in (("velocity", find.velocity), ("acceleration", find.acceleration)):
        if points or find.links or find.slides or (find.omega and kind == "velocity"):
            yield kind
    if scene.loads is not None:
        yield "forces"


def _row(scene: Scene) -> tuple[str, ...]:
    kinds = {*_kinds_of_results(scene)}
    letters = " ".join(letter if kind in kinds else " " for kind, letter in ASKED.items())
    return scene.name, str(len(scene.links)), letters, scene.title, scene.source


def _data(scene: Scene) -> dict[str, Any]:
    return {"name": scene.name, "title": scene.title, "source": scene.source, "links": [*scene.links],
            "asked": [*_kinds_of_results(scene)]}


def fit_columns(rows: Sequence[Sequence[str]], width: int | None) -> Iterator[str]:
    """Rows in columns; on a terminal of this width title and source share what the others leave, and end in dots."""
    *narrow, title, source = (max(map(len, column)) for column in zip(*rows, strict=True))
    if width is not None:
        free = max(0, width - sum(narrow) - len(GAP) * (len(rows[0]) - 1))
        title = min(title, max(free - source, free * 3 // 5))
        source = min(source, free - title)
    for row in rows:
        cells = zip(row, (*narrow, title, source), strict=True)
        yield GAP.join(_cut(cell, wide).ljust(wide) for cell, wide in cells).rstrip()


def _cut(text: str, wide: int) -> str:
    return text if len(text) <= wide else text[: max(0, wide - 1)] + "…" * min(1, wide)
