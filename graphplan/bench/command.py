"""Chart speed against accuracy: each chart as a picture and as a table, with a second picture scene by scene.

charts:
  machine        time for a pose against error, of every form in every arithmetic
  draughtsman    drawing operations against pencil error, of every form
  stability      where methods fail: errors near special poses, and which method works there
  methods        which method when: the quickest form that is accurate enough, by pose and paper
  settings       what finer settings buy: rounds of friction, strips, a cam's tolerance, checks
  growth         time and steps against the number of links

examples:
  graphplan chart charts                                  all of them; this takes minutes
  graphplan chart growth charts                           NAME.svg and NAME.csv into the folder
  graphplan chart machine charts --scenes shaper triad    of these scenes alone, with all that takes long
  graphplan chart machine charts --beside rivals.csv      with other programs, as tests/bench/run.py measures them
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import fields
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from graphplan.app.choices import Messages
from graphplan.app.files import folder_at, write
from graphplan.design.hand import Pencil
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load, packaged_names


class Survey(NamedTuple):
    """Measurement of a chart, by the module of its name: the content of its rows, and the functions that measure all
    scenes, or one.

    For all it is called with the module, the pencil and the progress, and `progress` names the object of a row; for a
    scene with the module, the scene, the pencil, and whether scenes are named.
    """

    row: str
    rows: Callable[..., Iterable[Any]]
    progress: str = ""


CHARTS = {
    "machine": Survey("MachineMeasure", lambda module, scene, hand, named: module.measures(
        scene, compiled=module.ALL_FORMS if named else 1)),  # compiling takes seconds
    "draughtsman": Survey("Draft", lambda module, scene, hand, named: module.drafts(scene, hand, long=named)),
    "stability": Survey("Sample", lambda module, hand, tell: module.samples(*module.DEGENERACIES, pencil=hand),
                        "{0.degeneracy}, d = {0.distance:.0e}"),
    "methods": Survey("FormAt", lambda module, hand, tell: module.forms_at(*module.DEGENERACIES, pencil=hand),
                      "{0.degeneracy}, d = {0.distance:.0e}"),
    "settings": Survey("Setting", lambda module, hand, tell: module.settings(hand), "{0.choice}, {0.case}"),
    "growth": Survey("StageTime", lambda module, hand, tell: module.stages(tell=tell), "{0.links} links"),
}
PICTURES = {"picture": "", "details": "-scenes"}  # what draws them, and how their files are called


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("names", metavar="NAME", nargs="*", help=f"{', '.join(CHARTS)}; without a name all of them")
    command.add_argument("folder", metavar="FOLDER", type=Path, help="where pictures and tables are written")
    command.add_argument("--scenes", metavar="SCENE", nargs="+", default=[],
                         help="the scenes of machine and draughtsman, with what is left out of all of them as it "
                         "takes long")
    command.add_argument("--beside", metavar="FILE.csv", type=Path,
                         help="rows of machine that were measured elsewhere, beside LAPACK on the same scenes")


def run(options: argparse.Namespace) -> int:
    from graphplan.bench.rows import table
    from graphplan.output.diagrams import file_of

    for name in options.names:
        if name not in CHARTS:
            raise Refused(f"chart {name}", "unknown chart", f"choose one of {', '.join(CHARTS)}")
    folder_at(options.folder)
    beside = _rival_rows(options.beside, options.names or CHARTS) if options.beside else []
    scenes, messages, hand = [load(name) for name in options.scenes], Messages(options.quiet), Pencil()
    for name in options.names or CHARTS:
        module = import_module(f"graphplan.bench.{name}")
        rows = [*_rows(name, module, scenes, hand, messages)]
        messages.progress("")
        if name == "machine":
            measured = {row.scene for row in rows}
            rows += [row for row in beside if row.scene in measured]
        arguments = (hand.description,) if name in ("draughtsman", "stability", "methods", "settings") else ()
        for picture in PICTURES:
            if hasattr(module, picture):
                write(file_of(getattr(module, picture)(rows, *arguments)),
                      str(options.folder / f"{name}{PICTURES[picture]}.svg"))
        write(table(getattr(module, CHARTS[name].row), rows), str(options.folder / f"{name}.csv"))
    return 0


def _rival_rows(file: Path, names: Collection[str]) -> list[Any]:
    """The rows of machine that were measured elsewhere; fails with `Refused` without such rows or chart."""
    from graphplan.bench.machine import MachineMeasure
    from graphplan.bench.rows import read

    if "machine" not in names:
        raise Refused("--beside", "only the chart machine compares other programs", "name machine, or leave it out")
    try:
        return read(MachineMeasure, file.read_text(encoding="utf-8"))
    except OSError as error:
        raise Refused(f"--beside {file}", str(error.strerror), "a file that can be read") from None
    except (KeyError, ValueError):
        columns = ", ".join(field.name for field in fields(MachineMeasure))
        raise Refused(f"--beside {file}", "not a table of the chart machine", f"the columns {columns}") from None


def _rows(name: str, module: Any, scenes: list[Scene], hand: object, messages: Messages) -> Iterator[Any]:
    """The rows of a chart, of these scenes or else of those that it is of; progress names each scene as it begins."""
    survey = CHARTS[name]
    if survey.progress:
        for row in survey.rows(module, hand, lambda said: messages.progress(f"{name}: {said}")):
            messages.progress(f"{name}: {survey.progress.format(row)}")
            yield row
        return
    of = scenes or [load(name) for name in getattr(module, "SCENES", packaged_names())]
    for count, scene in enumerate(of, 1):
        messages.progress(f"{name}: {count}/{len(of)} {scene.name}")
        yield from survey.rows(module, scene, hand, bool(scenes))
