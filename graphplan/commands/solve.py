"""Print the velocities, accelerations and forces, as JSON.

examples:
  graphplan solve alt-eight-link
  graphplan solve scene.toml --exact
  graphplan solve - --method trial < scene.toml
"""

from __future__ import annotations

import argparse
import json

from graphplan.commands.choices import add_choices, write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--exact", action="store_true", help='fractions, every number a string "p/q"')
    add_choices(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.check.printed import data
    from graphplan.check.report import report
    from graphplan.mechanism.scene import load

    found = report(load(options.scene), exact=options.exact, method=options.method, plan=options.plan,
                   inertia=options.inertia)
    write(json.dumps(data(found), indent=2, ensure_ascii=False) + "\n", None)
    return 0 if found.agrees else 1
