"""Schema: what a scene file may say, as JSON Schema for editors, and as a table for readers; both from its fields.

What only the whole scene tells, such as names that nothing bears or drives that are too many, is left to the loader.
"""

from __future__ import annotations

from collections.abc import Collection

from graphplan.mechanism.fields import Either, Field, Fragment, Kind, Named, Rows, Table, Value
from graphplan.mechanism.scene import SCENE

DRAFT = "https://json-schema.org/draft/2020-12/schema"


def described(says: str, fragment: Fragment) -> Fragment:
    """A fragment with its description."""
    return {"description": says, **fragment}


def table(keys: dict[str, Fragment], required: Collection[str] | None = None) -> Fragment:
    """A table of these keys and no others; without `required` all of them must be there."""
    return {"type": "object", "properties": keys, "required": [*(keys if required is None else required)],
            "additionalProperties": False}


def listed(entry: Fragment) -> Fragment:
    """A list, or an array of tables."""
    return {"type": "array", "items": entry}


def scene() -> Fragment:
    """The JSON Schema of a scene file."""
    return {"$schema": DRAFT, "title": "graphplan scene", **described(f"A{SCENE.says[1:]}.", schema(SCENE))}


def schema(value: Value) -> Fragment:
    """The JSON Schema of a kind of value."""
    match value:
        case Table(fields=fields, either=either):
            keys = {field.name: described(field.words, schema(field.kind) | _default(field)) for field in fields}
            one = {"oneOf": [{"required": [key]} for key in either]} if either else {}
            return table(keys, [field.name for field in fields if field.wanted]) | one
        case Either(forms=forms):
            return {"anyOf": [described(form.says, schema(form)) for form in forms]}
        case Rows(entry=entry, single=single):
            rows = listed(schema(entry))
            return {"anyOf": [schema(entry), rows]} if single else rows
        case Named(entry=entry, key=key, least=least):
            named = {"type": "object", "propertyNames": key.schema, "additionalProperties": schema(entry)}
            return named | ({"minProperties": least} if least else {})
        case Kind(schema=fragment):
            return fragment
    raise TypeError(value)


def _default(field: Field) -> Fragment:
    return {} if field.default is None else {"default": field.default}
