"""Print the construction in words, step by step.

examples:
  graphplan steps alt-eight-link
  graphplan steps scene.toml --strict
  graphplan steps scene.toml --json
"""

from __future__ import annotations

import argparse
import json

from graphplan.commands.choices import add_choices, write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="as data")
    add_choices(command, strict=True)


def run(options: argparse.Namespace) -> int:
    from graphplan.backends import text
    from graphplan.check.report import report
    from graphplan.mechanism.scene import load
    from graphplan.mechanism.structure import structure

    scene = load(options.scene)
    found = report(scene, method=options.method, plan=options.plan, inertia=options.inertia, strict=options.strict)
    lines = structure(scene).lines()
    if options.json:
        write(json.dumps(text.steps(found.drawing, lines), indent=1, ensure_ascii=False) + "\n", None)
    else:
        write(text.protocol(found.drawing, lines), None)
    return 0
