"""Schema: what a scene file may say, as JSON Schema for editors, and as a table for readers; both from its fields.

What only the whole scene tells, such as names that nothing bears or drives that are too many, is left to the loader.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from fractions import Fraction
from typing import NamedTuple

from graphplan.mechanism.fields import Either, Field, Fragment, Kind, Named, Rows, Table, Value
from graphplan.mechanism.scene import SCENE

DRAFT = "https://json-schema.org/draft/2020-12/schema"


def with_description(says: str, fragment: Fragment) -> Fragment:
    """A fragment with its description."""
    return {"description": says, **fragment}


def table(keys: dict[str, Fragment], required: Collection[str] | None = None) -> Fragment:
    """A table of these keys and no others; without `required` all of them must be there."""
    return {"type": "object", "properties": keys, "required": [*(keys if required is None else required)],
            "additionalProperties": False}


def array_of(entry: Fragment) -> Fragment:
    """A list, or an array of tables."""
    return {"type": "array", "items": entry}


def scene() -> Fragment:
    """The JSON Schema of a scene file."""
    return file_schema("graphplan scene", SCENE)


def file_schema(title: str, whole: Table) -> Fragment:
    """The JSON Schema of a whole file."""
    return {"$schema": DRAFT, "title": title, **with_description(f"A{whole.says[1:]}.", schema(whole))}


def _default(field: Field) -> object:
    """The default of a field as JSON has it."""
    return float(field.default) if isinstance(field.default, Fraction) else field.default


def schema(value: Value) -> Fragment:
    """The JSON Schema of a kind of value."""
    match value:
        case Table(fields=fields, either=either):
            keys = {field.name: with_description(field.words, schema(field.kind) | (
                {} if field.default is None else {"default": _default(field)})) for field in fields}
            exclusive = {"oneOf": [{"required": [key]} for key in either]} if either else {}
            return table(keys, [field.name for field in fields if field.wanted]) | exclusive
        case Either(forms=forms):
            return {"anyOf": [with_description(form.says, schema(form)) for form in forms]}
        case Rows(entry=entry, single=single):
            rows = array_of(schema(entry))
            return {"anyOf": [schema(entry), rows]} if single else rows
        case Named(entry=entry, key=key, least=least):
            named = {"type": "object", "propertyNames": key.schema, "additionalProperties": schema(entry)}
            return named | ({"minProperties": least} if least else {})
        case Kind(schema=fragment):
            return fragment


class ReferenceRow(NamedTuple):
    """A row of the reference of keys: a key, the head of a table, or one of the forms that a table may take."""

    level: str
    key: str
    takes: str
    words: str


HEAD, FORM, KEY = "head", "form", "key"


def reference(whole: Table = SCENE) -> str:
    """All keys of a scene, or of another file, as a table in Markdown: each with its kind of value and its meaning."""
    written = {HEAD: "| **`{}`** | {} | {} |", FORM: "| | *{}* | |", KEY: "| `{}` | {} | {} |"}
    rows = (written[row.level].format(row.key, row.takes, row.words.replace("|", r"\|")) for row in keys(whole))
    return "\n".join(["| key | takes | what it says |", "|---|---|---|", *rows, ""])


def keys(whole: Table = SCENE) -> Iterator[ReferenceRow]:
    """All keys of a scene, or of another file, table after table."""
    for field in whole.fields:
        match field.kind:
            case Kind():
                yield from _rows((field,))
                continue
            case Rows(entry=entry, single=single):
                head = f"[[{field.name}]]" if not single else f"[{field.name}]` or `[[{field.name}]]"
            case Named(entry=Table() as entry, key=key):
                head = f"[{field.name}.{key.says.upper()}]"
            case Named(entry=entry) | entry:
                head = f"[{field.name}]"
        yield ReferenceRow(HEAD, head, "required" if field.wanted else "", field.words)
        forms = entry.forms if isinstance(entry, Either) else (entry,)
        for form in forms:
            yield from [ReferenceRow(FORM, form.says, "", "")] if len(forms) > 1 else []
            yield from _rows(form.fields) if isinstance(form, Table) else []


def _rows(fields: Iterable[Field], path: str = "") -> Iterator[ReferenceRow]:
    """The rows of keys, each before those below it."""
    for name, words, kind, required, default in fields:
        default_text = f"default {str(default).lower() if isinstance(default, bool) else default}"
        more = ["required"] if required else [] if default in (None, []) else [default_text]
        yield ReferenceRow(KEY, f"{path}{name}", ", ".join([kind.says, *more]), words)
        if isinstance(kind, Table):
            yield from _rows(kind.fields, f"{path}{name}.")
