"""The JSON Schemas of what `graphplan solve`, `graphplan steps --json` and `graphplan verify --json` print.

Their tables stand in `results.toml`, which says how they are written; here are the plain kinds of values in them.
"""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

from graphplan.kernel import CIRCLE, LINE, OPENING, POINT, TABLE
from graphplan.kernel.stages import Knowledge
from graphplan.marking.judge.verdict import STATES
from graphplan.mechanism import values
from graphplan.mechanism.fields import Fragment
from graphplan.mechanism.schema import DRAFT, array_of, table, with_description
from graphplan.mechanism.units import BY_QUANTITY

COUNT: Fragment = {"type": "integer", "minimum": 0}
DECIMAL: Fragment = {"type": "string", "pattern": r"^-?\d+(\.\d+)?(e[+-]?\d+)?$"}
VALUE: Fragment = {"anyOf": [
    values.NUMBER.schema, with_description("a fraction p/q, with --exact",
                                           {"type": "string", "pattern": r"^-?\d+(/\d+)?$"}),
    with_description("proven digits, with --digits", DECIMAL)]}
PLAIN: dict[str, Fragment] = {
    "text": values.TEXT.schema, "number": values.NUMBER.schema, "positive": values.AMOUNT.schema,
    "null": {"type": "null"}, "count": COUNT, "decimal": DECIMAL, "value": VALUE,
    "vector": {"type": "array", "items": VALUE, "minItems": 2, "maxItems": 2},
    "percent": {"type": "number", "minimum": 0, "maximum": 100},
    "flag": {"type": "boolean"},
    "confidence": {"type": "number", "minimum": 0, "maximum": 1},
    "step": with_description("the number of the step, 0 for what is given", COUNT),
    "verdict": with_description("follows: right after an earlier mistake; implied: not drawn, but a right mark rests "
                                "on it; unsure: look at it; unseen: of a kind that the drawing does not show",
                                {"enum": [*STATES]}),
    "counts": table(dict.fromkeys(STATES, COUNT)),
    "units": table({quantity: {"enum": [*units]} for quantity, units in BY_QUANTITY.items()}),
    "known": with_description("locus: a line on which it ends", {"enum": [known.value for known in Knowledge]}),
    "mark": {"enum": [POINT, LINE, OPENING, CIRCLE]},
    "operation": {"enum": [*TABLE]},
    "instrument": {"enum": sorted({op.instrument for op in TABLE.values()})},
}
EITHER = {"balance": "moment|force", 
          "reaction": "joint reaction|slide reaction|gear reaction|contact reaction", "each": "positive|positive[]",
          "instant centre": "place|direction", "verify": "one drawing|a class|a stack"}


def result_schema(command: str) -> Fragment:
    """What a command prints."""
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
    return _kind(f"{word[:-1]}|null") if word.endswith("?") else _table(dict(tables()[word]))


def _table(written: dict[str, str]) -> Fragment:
    """The schema of a table of the file."""
    least = {"minProperties": written.pop("at least")} if "at least" in written else {}
    keys: dict[str, Fragment] = {}
    for name, entry in written.items():
        kind, _, words = entry.partition(", ")
        keys[name.removesuffix("?")] = with_description(words, _kind(kind)) if words else _kind(kind)
    return table(keys, [name for name in written if not name.endswith("?")]) | least


@cache
def tables() -> dict[str, dict[str, Any]]:
    """The tables of the file, as they are written."""
    return tomllib.loads(files(__package__).joinpath("results.toml").read_text(encoding="utf-8"))
