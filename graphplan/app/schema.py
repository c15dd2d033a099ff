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
import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

from graphplan import leaves
from graphplan.app.files import as_json, write
from graphplan.kernel import CIRCLE, LINE, OPENING, POINT, TABLE
from graphplan.kernel.stages import Knowledge
from graphplan.mechanism import fields
from graphplan.mechanism.fields import Fragment
from graphplan.mechanism.schema import DRAFT, array_of, table, with_description
from graphplan.mechanism.units import BY_QUANTITY

COUNT: Fragment = {"type": "integer", "minimum": 0}
DECIMAL: Fragment = {"type": "string", "pattern": r"^-?\d+(\.\d+)?(e[+-]?\d+)?$"}
VALUE: Fragment = {"anyOf": [
    fields.NUMBER.schema, with_description("a fraction p/q, with --exact",
                                           {"type": "string", "pattern": r"^-?\d+(/\d+)?$"}),
    with_description("proven digits, with --digits", DECIMAL)]}
PLAIN: dict[str, Fragment] = {
    "text": fields.TEXT.schema, "number": fields.NUMBER.schema, "positive": fields.AMOUNT.schema,
    "null": {"type": "null"}, "count": COUNT, "decimal": DECIMAL, "value": VALUE,
    "vector": {"type": "array", "items": VALUE, "minItems": 2, "maxItems": 2},
    "percent": {"type": "number", "minimum": 0, "maximum": 100},
    "flag": {"type": "boolean"},
    "confidence": {"type": "number", "minimum": 0, "maximum": 1},
    "step": with_description("the number of the step, 0 for what is given", COUNT),
    "units": table({quantity: {"enum": [*units]} for quantity, units in BY_QUANTITY.items()}),
    "known": with_description("locus: a line on which it ends", {"enum": [known.value for known in Knowledge]}),
    "mark": {"enum": [POINT, LINE, OPENING, CIRCLE]},
    "operation": {"enum": [*TABLE]},
    "instrument": {"enum": sorted({op.instrument for op in TABLE.values()})},
}
EITHER = {"balance": "moment|force",
          "reaction": "joint reaction|slide reaction|gear reaction|strand reaction|contact reaction",
          "each": "positive|positive[]", "instant centre": "place|direction"}


def result_schema(command: str) -> Fragment:
    """Schema of a command's JSON."""
    return {"$schema": DRAFT, "title": f"graphplan {command}", **_kind(command)}


def _kind(word: str) -> Fragment:
    """The schema of a kind of value."""
    if word in PLAIN:
        return PLAIN[word]
    if word in EITHER or "|" in word:
        return {"anyOf": [_kind(alternative) for alternative in EITHER.get(word, word).split("|")]}
    if word.endswith("[]"):
        return array_of(_kind(word[:-2]))
    if word.endswith("{}"):
        return {"type": "object", "additionalProperties": _kind(word[:-2])}
    if word.endswith("?"):
        return _kind(f"{word[:-1]}|null")
    written = tables()[word]
    if isinstance(written, dict):
        return _table(dict(written))
    return _kind(written) if isinstance(written, str) else {"enum": written}


def _table(written: dict[str, str]) -> Fragment:
    """The schema of a table of the file."""
    least = {"minProperties": written.pop("at least")} if "at least" in written else {}
    keys: dict[str, Fragment] = {}
    for name, entry in written.items():
        kind, _, words = entry.partition(", ")
        keys[name.removesuffix("?")] = with_description(words, _kind(kind)) if words else _kind(kind)
    return table(keys, [name for name in written if not name.endswith("?")]) | least


@cache
def tables() -> dict[str, Any]:
    """The tables of the files of the core and of its leaves, as they are written."""
    packages = [__package__, *(package for package, leaf in leaves.leaves().items() if leaf.results)]
    read: dict[str, Any] = {}
    for package in packages:
        read |= tomllib.loads(files(package).joinpath("results.toml").read_text(encoding="utf-8"))
    return read


def results() -> tuple[str, ...]:
    """The commands whose JSON is described."""
    return "solve", "steps", *(name for leaf in leaves.leaves().values() for name in leaf.results)


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("of", metavar="OF", nargs="?", default="scene",
                         choices=("scene", *leaves.tasks(), *results(), *(f"{task}-keys" for task in leaves.tasks()),
                                  "keys"),
                         help="scene (default), cam, synthesize, rotor, solve, steps, verify, flywheel, or motion; "
                         "keys, cam-keys, synthesize-keys or rotor-keys for the table")


def run(options: argparse.Namespace) -> int:
    from graphplan.mechanism import schema

    task = options.of.removesuffix("-keys")
    if task in leaves.tasks():
        whole = leaves.module(leaves.tasks()[task].module).TASK
        keys = task != options.of
        write(schema.reference(whole) if keys else as_json(schema.file_schema(f"graphplan {task} task", whole), 2))
    elif options.of == "keys":
        write(schema.reference())
    else:
        write(as_json(result_schema(options.of) if options.of in results() else schema.scene(), 2))
    return 0
