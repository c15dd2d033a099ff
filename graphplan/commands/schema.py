"""Print a JSON Schema: of scene files, or of what a command prints as JSON; or the keys of a scene as a table.

An editor with taplo (Even Better TOML) completes and checks a scene whose first line names the schema:
#:schema ./scene.schema.json

examples:
  graphplan schema > scene.schema.json
  graphplan schema solve
  graphplan schema steps
  graphplan schema verify
  graphplan schema cam > cam.schema.json  of the tasks of graphplan cam
  graphplan schema keys > keys.md        the keys of a scene, as a table in Markdown
"""

from __future__ import annotations

import argparse

from graphplan.commands.output import as_json, write

RESULTS = ("solve", "steps", "verify")


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("of", metavar="OF", nargs="?", default="scene",
                         choices=("scene", "cam", *RESULTS, "keys", "cam-keys"),
                         help="scene (default), cam, solve, steps, or verify; keys or cam-keys for the table")


def run(options: argparse.Namespace) -> int:
    from graphplan.commands.result_schemas import printed
    from graphplan.mechanism import schema

    if options.of in ("cam", "cam-keys"):
        from graphplan.cams.task import TASK

        write(as_json(schema.titled("graphplan cam task", TASK), 2) if options.of == "cam" else schema.reference(TASK))
    elif options.of == "keys":
        write(schema.reference())
    else:
        write(as_json(printed(options.of) if options.of in RESULTS else schema.scene(), 2))
    return 0
