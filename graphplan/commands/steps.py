"""Print the construction in words, step by step.

examples:
  graphplan steps alt-eight-link
  graphplan steps scene.toml --strict
  graphplan steps scene.toml --json
  graphplan steps scene.toml --prefer balanced
"""

from __future__ import annotations

import argparse
import json

from graphplan.commands.choices import add_choices, add_language, add_preference, chosen, rounded
from graphplan.commands.output import write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="as data")
    add_choices(command, strict=True)
    add_language(command)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.accuracy.drafted import drafted
    from graphplan.accuracy.pencil import pencil
    from graphplan.check.report import report
    from graphplan.mechanism.scene import load
    from graphplan.mechanism.structure import structure
    from graphplan.output import text
    from graphplan.words.tongue import tongue

    scene, hand = rounded(options, load(options.scene)), pencil(options.pencil)
    method, told = chosen(options, scene, strict=options.strict)
    found = report(scene, method=method, plan=options.plan, inertia=options.inertia, strict=options.strict)
    found.drawing.notes.extend(told)
    say = tongue(options.language)
    on_sheet, lines = drafted(found.drawing, hand, check=found.check), structure(scene).lines()
    if options.json:
        data = text.steps(found.drawing, lines, say) | {"cost": on_sheet.cost.data, "pencil": on_sheet.data}
        write(json.dumps(data, indent=1, ensure_ascii=False) + "\n")
    else:
        write(text.protocol(found.drawing, lines, on_sheet.lines(), say))
    return 0
