"""Print the construction in words, stage by stage, with lengths in mm of the sheet that the same options draw.

examples:
  graphplan steps alt-eight-link
  graphplan steps alt-eight-link --movements       with the single movements of compound steps
  graphplan steps scene.toml --strict
  graphplan steps scene.toml --json --paper A3     with the position of every mark on that sheet
  graphplan steps scene.toml --prefer balanced
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from graphplan.app.choices import add_choices, add_pencil, add_preference, add_sheet, add_travel, on_paper
from graphplan.app.files import as_json, write

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--movements", action="store_true", help="add the single movements of compound steps")
    command.add_argument("--json", action="store_true", help="as data, with the position of every mark on the sheet")
    add_sheet(command)
    add_choices(command, strict=True, inertia=True)
    add_travel(command)
    add_preference(command)
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    on_sheet = on_paper(options, words=False)
    write(as_json(data(on_sheet)) if options.json else protocol(on_sheet, movements=options.movements))
    return 0


def data(on_sheet: Drafted) -> dict[str, Any]:
    """The steps as data, with where they lie on the sheet, what drawing them costs and how far off the pencil is."""
    from graphplan.mechanism.structure import structure
    from graphplan.output.text import steps

    result = steps(on_sheet.composition, structure(on_sheet.drawing.scene).lines())
    return result | {"cost": on_sheet.cost.data, "pencil": on_sheet.data}


def protocol(on_sheet: Drafted, *, movements: bool = False) -> str:
    """The construction in words; compounds as one step each, or with their `movements` below."""
    from graphplan.mechanism.structure import structure
    from graphplan.output import text

    return text.protocol(on_sheet.composition, structure(on_sheet.drawing.scene).lines(), on_sheet.lines(),
                         movements=movements)
