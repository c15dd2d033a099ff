"""Chart speed against accuracy: each chart as a picture, and as a table beside it.

charts:
  machine        time for a pose against error, of every form in every arithmetic
  draughtsman    drawing operations against pencil error, of every form
  stability      error near the places where methods fail
  forms          which form is best where in the cycle
  growth         time and steps against the number of links

examples:
  graphplan chart charts                                  all of them; this takes minutes
  graphplan chart growth charts                           NAME.svg and NAME.csv into the folder
  graphplan chart machine charts --scenes shaper triad    of these scenes alone, with all that takes long
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_pencil
from graphplan.commands.messages import Messages
from graphplan.commands.output import write
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.accuracy.pencil import Pencil
    from graphplan.accuracy.survey.picture import Chart
    from graphplan.mechanism.model import Scene

Made = tuple["Chart", str]  # a picture and its table


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("names", metavar="NAME", nargs="*", help=f"{', '.join(CHARTS)}; without a name all of them")
    command.add_argument("folder", metavar="FOLDER", type=Path, help="where pictures and tables are written")
    command.add_argument("--scenes", metavar="SCENE", nargs="+", default=[],
                         help="the scenes of machine, draughtsman and forms, with what is left out of all of them as "
                         "it takes long")
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.accuracy.pencil import pencil
    from graphplan.mechanism.scene import load
    from graphplan.output.charts import drawn

    for name in options.names:
        if name not in CHARTS:
            raise Refused(f"chart {name}", "there is no such chart", f"one of {', '.join(CHARTS)}")
    if not options.folder.is_dir():
        raise Refused(f"{options.folder}: folder", "there is no such folder", "make it first")
    scenes, hand, messages = [load(name) for name in options.scenes], pencil(options.pencil), Messages(options.quiet)
    for name in options.names or CHARTS:
        chart, table = CHARTS[name](scenes, hand, messages)
        messages.progress("")
        write(drawn(chart), str(options.folder / f"{name}.svg"))
        write(table, str(options.folder / f"{name}.csv"))
    return 0


def _machine(scenes: Sequence[Scene], hand: Pencil, messages: Messages) -> Made:
    from graphplan.accuracy.survey.machine import Measure, measures
    from graphplan.accuracy.survey.pictures.machine import picture
    from graphplan.accuracy.survey.table import table

    rows = [row for scene in _each("machine", scenes or _packaged(), messages)
            for row in measures(scene, compiled=bool(scenes) or scene.name == BIG)]
    return picture(rows), table(Measure, rows)


def _draughtsman(scenes: Sequence[Scene], hand: Pencil, messages: Messages) -> Made:
    from graphplan.accuracy.survey.draughtsman import Draft, drafts
    from graphplan.accuracy.survey.pictures.draughtsman import picture
    from graphplan.accuracy.survey.table import table

    rows = [row for scene in _each("draughtsman", scenes or _packaged(), messages)
            for row in drafts(scene, hand, long=bool(scenes))]
    return picture(rows, hand.told), table(Draft, rows)


def _stability(scenes: Sequence[Scene], hand: Pencil, messages: Messages) -> Made:
    from graphplan.accuracy.survey.pictures.stability import picture
    from graphplan.accuracy.survey.stability import Sample, everything
    from graphplan.accuracy.survey.table import table

    rows = []
    for row in everything():
        messages.progress(f"stability: {row.degeneracy}")
        rows.append(row)
    return picture(rows), table(Sample, rows)


def _forms(scenes: Sequence[Scene], hand: Pencil, messages: Messages) -> Made:
    from graphplan.accuracy.survey.best_forms import SCENES, Sample, samples
    from graphplan.accuracy.survey.pictures.forms import picture
    from graphplan.accuracy.survey.table import table
    from graphplan.mechanism.scene import load

    rows = [row for scene in _each("forms", scenes or [load(name) for name in SCENES], messages)
            for row in samples(scene, hand)]
    return picture(rows), table(Sample, rows)


def _growth(scenes: Sequence[Scene], hand: Pencil, messages: Messages) -> Made:
    from graphplan.accuracy.survey.growth import Stage, stages
    from graphplan.accuracy.survey.pictures.growth import picture
    from graphplan.accuracy.survey.table import table

    rows = []
    for row in stages():
        messages.progress(f"growth: {row.links} links")
        rows.append(row)
    return picture(rows), table(Stage, rows)


BIG = "alt-eight-link"  # is compiled by numba too; for every scene that would take minutes
CHARTS: dict[str, Callable[[Sequence[Scene], Pencil, Messages], Made]] = {
    "machine": _machine, "draughtsman": _draughtsman, "stability": _stability, "forms": _forms, "growth": _growth,
}


def _packaged() -> list[Scene]:
    from graphplan.mechanism.scene import load, packaged

    return [load(name) for name in packaged()]


def _each(chart: str, scenes: Sequence[Scene], messages: Messages) -> Iterator[Scene]:
    """The scenes one after the other, told to whoever waits."""
    for count, scene in enumerate(scenes, 1):
        messages.progress(f"{chart}: {count}/{len(scenes)} {scene.name}")
        yield scene
