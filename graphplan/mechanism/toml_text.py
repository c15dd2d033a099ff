"""Tables as the text of a TOML file, and a value changed in them by its path."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from numbers import Complex, Integral, Rational, Real
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism.items import suggestion
from graphplan.mechanism.numbers import Unusable
from graphplan.mechanism.scene_text import decimal_text
from graphplan.mechanism.variation import path_parts

BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


def toml_text(tables: Mapping[str, Any]) -> str:
    """A mapping as a TOML file: text, numbers and lists first, then a table for each mapping, and a table in double
    brackets for each mapping of a list.

    Vectors may be tuples, arrays or complex numbers; floats are the decimals that Python shows. Fails with `Refused`
    where a value is none that TOML has.
    """
    plain = {key: value for key, value in tables.items() if not _is_table(value) and not _is_list_of_tables(value)}
    sections = ["".join(_lines(plain))]
    for key, value in tables.items():
        if key in plain:
            continue
        for header, table in ([(f"[{toml_key(key)}]", value)] if _is_table(value) else
                              [(f"[[{toml_key(key)}]]", entry) for entry in value]):
            sections.append("".join([f"{header}\n", *_lines(table)]))
    return "\n".join(filter(None, sections))


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str) and bool(value) and all(map(_is_table, value))


def _lines(table: Mapping[str, Any]) -> Iterator[str]:
    return (f"{toml_key(key)} = {toml_value(value, str(key))}\n" for key, value in table.items())


def toml_key(key: object) -> str:
    """A key as TOML wants it: in quotes unless it is made of ASCII letters, digits, _ and -."""
    return str(key) if BARE_KEY.fullmatch(str(key)) else json.dumps(str(key), ensure_ascii=False)


def toml_value(value: Any, key: str) -> str:
    """A value in TOML; fails with `Refused`, which names the key, where it is none that TOML has."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case Unusable():
            return value.text
        case Integral():
            return str(int(value))
        case Rational() if _is_decimal(Fraction(value)):
            return decimal_text(Fraction(value))
        case Decimal():
            return f"{value:f}"
        case Real() if not isinstance(value, Rational):
            return repr(float(value))
        case Complex() if not isinstance(value, Real):
            return f"[{float(value.real)!r}, {float(value.imag)!r}]"
        case Mapping():
            return "{ " + ", ".join(line.rstrip() for line in _lines(value)) + " }"
    if hasattr(value, "tolist"):  # an array, or a number of numpy's
        return toml_value(value.tolist(), key)
    if isinstance(value, Sequence):
        return f"[{', '.join(toml_value(entry, key) for entry in value)}]"
    raise Refused(key, f"{value!r} cannot be written in a scene", "a text, a number, a list or a mapping of these")


def _is_decimal(number: Fraction) -> bool:
    """Whether a fraction is a decimal of some digits."""
    remainder = number.denominator
    for prime in (2, 5):
        while remainder % prime == 0:
            remainder //= prime
    return remainder == 1


def with_value(tables: Mapping[str, Any], path: str, value: object) -> dict[str, Any]:
    """The tables with another value at a path, such as points.A.angle, links.2 or drive.0.omega.

    The last key may be new, and so may a table of the whole scene; fails with `Refused` where nothing else leads there.
    """
    first, *more = path_parts(path) or ("",)
    if not more:
        return {**tables, first: value}
    return {**tables, first: _changed(tables.get(first, {}), more, value, path)}


def _changed(inner: Any, keys: Sequence[str], value: object, path: str) -> Any:
    """What stands at some place with another value further in."""
    key, more = keys[0], keys[1:]
    if isinstance(inner, list):
        places = [str(place) for place in range(len(inner))]
        if key not in places:
            raise Refused(path, f"there is no place {key} in a list of {len(inner)}", "places count from 0")
        new = value if not more else _changed(inner[int(key)], more, value, path)
        return [new if str(place) == key else entry for place, entry in enumerate(inner)]
    if not isinstance(inner, Mapping) or (more and key not in inner):
        known = [*map(str, inner)] if isinstance(inner, Mapping) else []
        remedy = suggestion(key, known, "key") if known else "a path that leads to a value of the scene"
        raise Refused(path, f"nothing stands at {key}", remedy)
    return {**inner, key: value if not more else _changed(inner[key], more, value, path)}
