"""The text of a scene, edited: other numbers, a key more, a table less; and the table [vary], by the paths of its keys.

Comments and layout stay as they are.

Numbers are found by reading the text once with the place of each numeral in its stead, so that TOML itself says which
numeral a path leads to. Every edit is read again, and refused where it says something else than it should.

Where a text says a thing a second time, TOML's own words for it name neither the key nor the line where it stood first:
both are found here.

A path is the keys and the places in lists, counted from 0, that lead to a number, such as points.A.angle, points.B.0
or drive.0.omega; keys are quoted as in TOML where they must be.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Context, Decimal
from fractions import Fraction
from functools import lru_cache
from math import floor
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism.fields import (
    NUMBER,
    Either,
    Field,
    Kind,
    Named,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    Value,
    describe,
    quote_key,
)
from graphplan.mechanism.numbers import decimal, number_text

QUOTED = r'"""[\s\S]*?"""|\'\'\'[\s\S]*?\'\'\'|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\'|#[^\n]*'
NUMERAL = r"(?<![\w.+-])[+-]?\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][+-]?\d+)?(?![\w.:-])"
TOKENS = re.compile(rf"{QUOTED}|({NUMERAL})")
HEADER = re.compile(r"[ \t]*\[\[?[^\[\],]+\]\]?[ \t]*")
MAX_DIGITS = 120  # of a decimal; more than any numeral has
PLACE_OFFSET = 10**15  # added to the place of a numeral: no list is so long that it could be a place in it
KEPT_TEXTS = 64  # texts whose numerals are kept: in a loop one text is edited over and over
Tables = dict[str, Any]


def decimal_text(number: Fraction) -> str:
    """A decimal as one writes it: 12, 0.25."""
    if number.denominator == 1:
        return str(number.numerator)
    quotient = Context(prec=MAX_DIGITS).divide(Decimal(number.numerator), Decimal(number.denominator))
    return f"{quotient.normalize():f}"


def with_numbers(text: str, values: Mapping[str, Fraction]) -> str:
    """The text with other numbers at these paths."""
    spans, edits = _numerals(text), {}
    for path, value in values.items():
        span = spans.get(path_parts(path))
        if span is None:
            raise Refused(f"vary.{path}", "its number is not found in the text", "write it as a plain decimal")
        edits[span] = decimal_text(value)
    for (start, end), new in sorted(edits.items(), reverse=True):
        text = text[:start] + new + text[end:]
    return text


@lru_cache(KEPT_TEXTS)
def _numerals(text: str) -> Mapping[tuple[str, ...], tuple[int, int]]:
    """Start and end of each numeral in a text, by the path to its number."""
    places = {str(PLACE_OFFSET + token.start()): token for token in TOKENS.finditer(text) if token[1]}
    numbered = TOKENS.sub(lambda token: str(PLACE_OFFSET + token.start()) if token[1] else token[0], text)
    tokens = {tuple(_key(key, places) for key in path): places.get(str(place))
              for path, place in numbers(tomllib.loads(numbered))}
    return {path: token.span() for path, token in tokens.items() if token is not None}


def _key(part: str, places: Mapping[str, re.Match[str]]) -> str:
    """A key as it was written: a numeral may be one as well, as in [masses.2]."""
    return places[part][0] if part in places else part


def with_rows(text: str, files: Mapping[str, Sequence[tuple[Any, Any]]]) -> str:
    """The text with the rows of files instead of their names: values = [[0, 0], [30, -1200]]."""
    def rows(found: re.Match[str]) -> str:
        name = tomllib.loads(f"file = {found[2]}")["file"]
        if name not in files:
            return found[0]
        return f"{found[1]}values = [{', '.join(f'[{decimal_text(x)}, {decimal_text(y)}]' for x, y in files[name])}]"

    def insert_rows(tables: Tables) -> None:
        for load in (load for table in ("forces", "moments") for load in tables.get(table, ())):
            if load.get("file") in files:
                load["values"] = [[*row] for row in files[load.pop("file")]]

    return edit_text(text, lambda text: re.sub(rf"(?m)(^\s*|[{{,]\s*)file\s*=\s*({QUOTED})", rows, text), insert_rows)


def with_keys(text: str, table: str, keys: Mapping[str, str]) -> str:
    """The text with these keys in a table, each with its value as TOML; `""` are those before all tables.

    A key that is there has another value, any other stands first in its table, or in a new one at the end.
    """
    if not keys:
        return text
    lines = text.splitlines(keepends=True)
    span = _lines_of(text, table)
    if span is None:
        lines, span = [f"{text.rstrip()}\n\n", f"[{table}]\n"], (1, 2)
    first, end = (span[0] + 1, span[1]) if table else span
    for key, value in reversed([*keys.items()]):
        assignment = re.compile(rf"([ \t]*{key}[ \t]*=[ \t]*)(?:\[[^\[\]\n]*\]|\{{[^{{}}\n]*\}}|{QUOTED}|[^\s#]+)")
        line = next((place for place in range(first, end) if assignment.match(lines[place])), None)
        if line is None:
            lines.insert(first, f"{key} = {value}\n")
            end += 1
        else:
            lines[line] = assignment.sub(lambda found, value=value: found[1] + value, lines[line], 1)  # type: ignore[misc]
    return "".join(lines)


def without_table(text: str, table: str) -> str:
    """The text without a table, and without the comment that stands right above it."""
    lines, span = text.splitlines(keepends=True), _lines_of(text, table)
    if span is None:
        return text
    first, end = span
    while first and lines[first - 1].lstrip().startswith("#"):
        first -= 1
    before, after = "".join(lines[:first]).rstrip(), "".join(lines[end:]).strip()
    return before + (f"\n\n{after}\n" if after else "\n")


def _lines_of(text: str, table: str) -> tuple[int, int] | None:
    """The first line of a table, its header, and the line after its last key; None where there is no such table."""
    bare = TOKENS.sub(lambda token: token[1] or re.sub(r"[^\n]", " " if token[0][0] == "#" else "_", token[0]),
                      text).splitlines()
    headers = [place for place, line in enumerate(bare) if HEADER.fullmatch(line)]
    if not table:
        first = 0
    elif (header := next((place for place in headers if bare[place].strip() == f"[{table}]"), None)) is not None:
        first = header
    else:
        return None
    following = next((place for place in headers if place > first or not table), len(bare))
    filled = (place for place in range(following - 1, first - 1, -1) if bare[place].strip())
    return first, next(filled, first - 1) + 1


def edit_text(text: str, edit: Callable[[str], str], meant: Callable[[Tables], None]) -> str:
    """The text after an edit that does to its tables what is `meant`; fails with `Refused` where it does not."""
    tables = tomllib.loads(text, parse_float=decimal)
    meant(tables)
    edited = edit(text.replace("\r\n", "\n"))
    try:
        same = tomllib.loads(edited, parse_float=decimal) == tables
    except ValueError:
        same = False
    if not same:
        raise Refused("scene", "its text cannot be edited", "write [sheet] and [vary] as tables of their own")
    return edited


PART = r"(?:[A-Za-z0-9_-]+|\"[^\"\n]*\"|'[^'\n]*')"
NAME = rf"{PART}(?:[ \t]*\.[ \t]*{PART})*"
KEY = re.compile(rf"[ \t]*({NAME})[ \t]*=")
TABLE_HEADER = re.compile(rf"[ \t]*(\[\[?)[ \t]*({NAME})[ \t]*\]")
INLINE = re.compile(r"Duplicate inline table key '(.*)'", re.DOTALL)
Path = tuple[str, ...]


def doubled_key(text: str, message: str, line: int) -> tuple[str, str, str] | None:
    """The line with a duplicate key, the fault and its correction; None if there is no duplicate.

    TOML refuses the text with this message at this line, where a value may end that began earlier.
    """
    if inline := INLINE.fullmatch(message):
        return f"line {line}", f"the key {quote_key(inline[1])} is given twice in one table", "one of the two"
    earlier: dict[Path, tuple[int, str]] = {}
    for number, sort, path in entry_lines(text):
        if number > line:
            break
        whole = next((path[:end] for end in range(1, len(path)) if earlier.get(path[:end], (0, ""))[1] == "="), path)
        first, before = earlier.get(whole, (0, ""))
        if before and not sort == before == "[[":
            name, wrong = ".".join(map(quote_key, whole)), first if sort == "[[" else number
            return (f"line {number}", f"{name} is given twice, first in line {first}", "each name once") \
                if "[[" not in (sort, before) else \
                (f"line {wrong}", f"{name} is a list of tables, but not here", f"[[{name}]] in each place")
        for end in range(1, len(path) + 1) if sort == "=" else (len(path),):
            earlier.setdefault(path[:end], (number, sort if end == len(path) else "."))
    return None


def entry_lines(text: str) -> Iterator[tuple[int, str, Path]]:
    """Each key and header with its line: whether it is a key (=), a table ([) or an entry of a list ([[), and its path.

    The entries of a list are counted, so that the keys of each are its own.
    """
    table: Path = ()
    entries = dict[Path, int]()
    for number, line in enumerate(TOKENS.sub(_without_text, text).split("\n"), 1):
        if header := TABLE_HEADER.match(line):
            table = _path(header[2])
            yield number, header[1], table
            if header[1] == "[[":
                entries[table] = entries.get(table, 0) + 1
                table = *table, f"{entries[table]}"
        elif key := KEY.match(line):
            yield number, "=", (*table, *_path(key[1]))


def _without_text(token: re.Match[str]) -> str:
    """A token as it stands, but what has several lines, and comments, as empty lines."""
    return re.sub(r"[^\n]", "", token[0]) if token[0][0] == "#" or "\n" in token[0] else token[0]


def _path(name: str) -> Path:
    """The parts of a key: of points.A both."""
    keys: list[str] = []
    try:
        tables: object = tomllib.loads(f"{name} = 0")
    except ValueError:  # strange characters in quotes
        return (name,)
    while isinstance(tables, dict):
        ((key, tables),) = tables.items()
        keys.append(key)
    return tuple(keys)


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
    return _is_number(value_at(tables, path_parts(path)))


def _is_number(value: object) -> bool:
    return isinstance(value, Fraction) or type(value) is int


def value_at(tables: object, path: Sequence[str]) -> object:
    """The value at a path; None if the path does not exist."""
    for key in path:
        if isinstance(tables, list):
            tables = tables[int(key)] if key.isdecimal() and int(key) < len(tables) else None
        else:
            tables = tables.get(key) if isinstance(tables, Mapping) else None
    return tables


def _vary_path(name: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where there is no such number, or it must be the same for all."""
    path = path_parts(name)
    value = value_at(names.tables, path)
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
VARY = Named(Either((RANGE, LIST), _form), PATH, _vary_path)
