"""Print a JSON Schema: of scene files, or of what a command prints as JSON.

An editor with taplo (Even Better TOML) completes and checks a scene whose first line names the schema:
#:schema ./scene.schema.json

examples:
  graphplan schema > scene.schema.json
  graphplan schema solve
  graphplan schema steps
  graphplan schema verify
"""

from __future__ import annotations

import argparse

from graphplan.commands.output import as_json, write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("of", metavar="OF", nargs="?", default="scene", choices=("scene", "solve", "steps", "verify"),
                         help="scene (default), solve, steps, or verify")


def run(options: argparse.Namespace) -> int:
    from graphplan.commands import result_schemas
    from graphplan.mechanism.schema import scene

    schemas = {"scene": scene, "solve": result_schemas.solve, "steps": result_schemas.steps,
               "verify": result_schemas.verify}
    write(as_json(schemas[options.of](), 2))
    return 0
