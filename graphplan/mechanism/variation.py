"""The table [vary]: numbers of a scene that differ from student to student, by their paths.

A path is the keys and the places in lists, counted from 0, that lead to a number, such as points.A.angle, points.B.0
or drive.0.omega; keys are quoted as in TOML where they must be.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import floor

from graphplan.mechanism.fields import Either, Field, Kind, Named, SceneNames, Table, TableRow, Value
from graphplan.mechanism.items import SceneItem, describe, quote_key
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.values import NUMBER

MAX_VALUES = 10_000  # values of one number
SAME_FOR_ALL = ("vary", "sheet", "units")  # tables whose numbers do not vary
RANGE_EXAMPLE = "{ from = 20, to = 160, step = 5 }, or a list such as [8, 10, 12]"

Choices = dict[str, tuple[Fraction, ...]]  # the values that a number may have, by its path


def path_parts(path: str) -> tuple[str, ...]:
    """The keys and places of a path."""
    return tuple(quoted or bare for quoted, bare in re.findall(r'"([^"]*)"|([^."]+)', path))


def numbers(tables: object, above: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], object]]:
    """All numbers in tables and lists, each with the keys and places that lead to it."""
    if isinstance(tables, Mapping | list):
        for name, value in tables.items() if isinstance(tables, Mapping) else enumerate(tables):
            yield from numbers(value, (*above, str(name)))
    elif _is_number(tables):
        yield above, tables


def is_number_at(tables: object, path: str) -> bool:
    """Whether a number stands at a path."""
    return _is_number(_value_at(tables, path_parts(path)))


def _is_number(value: object) -> bool:
    return isinstance(value, Fraction) or type(value) is int


def _value_at(tables: object, path: tuple[str, ...]) -> object:
    """What stands at a path; None where nothing does."""
    for key in path:
        if isinstance(tables, list):
            tables = tables[int(key)] if key.isdecimal() and int(key) < len(tables) else None
        else:
            tables = tables.get(key) if isinstance(tables, Mapping) else None
    return tables


def _path(name: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where there is no such number, or it must be the same for all."""
    path = path_parts(name)
    value = _value_at(names.tables, path)
    if _is_number(value) and path[0] not in SAME_FOR_ALL:
        return
    varying = [".".join(map(quote_key, keys)) for keys, _ in numbers(names.tables) if keys[0] not in SAME_FOR_ALL]
    if path[:1] and path[0] in SAME_FOR_ALL:
        item.fault("this is the same for all variants", "the path of a number of the mechanism or of its motion")
    elif value is None:
        item.faults.unknown(item.where, "number", name, varying)
    elif isinstance(value, Mapping | list) or not any(numbers(value)):
        such = next((candidate for candidate in varying if candidate.startswith(f"{name}.")), "drive.0.omega")
        item.fault(f"{describe(value)} is not a number", f"the path of a number, such as {such}")


def _range(row: TableRow) -> tuple[Fraction, ...] | None:
    """The values from one to another, a step apart."""
    low, high, step = row["from"], row["to"], row["step"]
    count = floor((high - low) / step) + 1
    if high < low:
        return row.items["to"].fault(f"{number_text(high)} is less than from, {number_text(low)}",
                                     f"at least {number_text(low)}")
    if count > MAX_VALUES:
        return row.items["step"].fault(f"{number_text(step)} makes {count} values",
                                       f"a larger step: at most {MAX_VALUES} values")
    return tuple(low + step * place for place in range(count))


def _list(item: SceneItem, names: SceneNames) -> tuple[Fraction, ...] | None:
    """The values one by one."""
    numbers = [item.with_value(value).number() for value in item.value] if isinstance(item.value, list) else []
    if not numbers:
        return item.fault("an empty list", RANGE_EXAMPLE)
    if len(numbers) > MAX_VALUES:
        return item.fault(f"{len(numbers)} values", f"at most {MAX_VALUES}")
    return tuple(dict.fromkeys(value for value in numbers if value is not None))


RANGE = Table("a range", (
    Field("from", "the first value", NUMBER, "the first value, such as from = 20"),
    Field("to", "the last value, if a step leads to it", NUMBER, "the last value, such as to = 160"),
    Field("step", "how far apart the values are", Kind("number above 0", lambda item, names: item.positive("step"),
          {"type": "number", "exclusiveMinimum": 0}), "how far apart the values are, such as step = 5"),
), _range)
LIST = Kind("list of numbers", _list, {"type": "array", "items": NUMBER.schema, "minItems": 1, "maxItems": MAX_VALUES})


def _form(item: SceneItem) -> Value | None:
    if isinstance(item.value, dict | list):
        return RANGE if isinstance(item.value, dict) else LIST
    return item.fault(f"{describe(item.value)} where a range is wanted", RANGE_EXAMPLE)


PATH = Kind("path of a number", lambda item, names: None, {"type": "string", "minLength": 1})
VARY = Named(Either((RANGE, LIST), _form), PATH, _path)
