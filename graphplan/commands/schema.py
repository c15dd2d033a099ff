"""Print a JSON Schema: of scene files, or of what a command prints as JSON; or the keys of a scene as a table.

An editor with taplo (Even Better TOML) completes and checks a scene whose first line names the schema:
#:schema ./scene.schema.json

examples:
  graphplan schema > scene.schema.json
  graphplan schema solve
  graphplan schema steps
  graphplan schema verify
  graphplan schema flywheel
  graphplan schema motion
  graphplan schema cam > cam.schema.json  of the tasks of graphplan cam
  graphplan schema synthesize            of the tasks of graphplan synthesize
  graphplan schema rotor                 of the rotors of graphplan balance
  graphplan schema keys > keys.md        the keys of a scene, as a table in Markdown
"""

from __future__ import annotations

import argparse
from importlib import import_module

from graphplan.commands.output import as_json, write

RESULTS = ("solve", "steps", "verify", "flywheel", "motion")
TASKS = {"cam": "graphplan.cams.task", "synthesize": "graphplan.synthesis.task",
         "rotor": "graphplan.machine.rotors.rotor"}  # and where their tables are


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("of", metavar="OF", nargs="?", default="scene",
                         choices=("scene", *TASKS, *RESULTS, "keys", *(f"{task}-keys" for task in TASKS)),
                         help="scene (default), cam, synthesize, rotor, solve, steps, verify, flywheel, or motion; "
                         "keys, cam-keys, synthesize-keys or rotor-keys for the table")


def run(options: argparse.Namespace) -> int:
    from graphplan.commands.result_schemas import result_schema
    from graphplan.mechanism import schema

    task = options.of.removesuffix("-keys")
    if task in TASKS:
        whole = import_module(TASKS[task]).TASK
        keys = task != options.of
        write(schema.reference(whole) if keys else as_json(schema.file_schema(f"graphplan {task} task", whole), 2))
    elif options.of == "keys":
        write(schema.reference())
    else:
        write(as_json(result_schema(options.of) if options.of in RESULTS else schema.scene(), 2))
    return 0
