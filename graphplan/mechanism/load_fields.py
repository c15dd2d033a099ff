"""Loads that change, as a scene writes them: rows in the scene, or in a file of two columns beside it."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from graphplan.mechanism.directions import GUIDE
from graphplan.mechanism.fields import Field, Kind, Names, Row
from graphplan.mechanism.items import Item, described, perhaps
from graphplan.mechanism.load_tables import SPEED, SPEED_OF, TRAVEL, LoadTable
from graphplan.mechanism.numerals import decimal, shown
from graphplan.mechanism.pairs.drives import Drive
from graphplan.mechanism.pairs.sliding import Slide
from graphplan.mechanism.values import NUMBER, VECTOR

MOST = 100_000  # rows of a table
LARGEST = 8_000_000  # bytes of a file
SUCH = "values = [[0, 0], [30, -1200], [360, 0]]"
EITHER = "value", "over"
COLUMNS = "lines of a place and a value, with a comma, a semicolon, a tab or blanks between them"
Pairs = tuple[tuple[Fraction, Fraction], ...]


def _over(item: Item, names: Names) -> str | None:
    name = item.text("what the load changes with", 'over = "travel", or a slide such as over = "3 along frame"')
    slides = [pair.name for pair in names.pairs if isinstance(pair, Slide)]
    known = [TRAVEL, *slides, SPEED, *(SPEED_OF + slide for slide in slides)]
    if name is None or name in known or not item.faults.none_in("slides"):
        return name
    return item.fault(f"there is no slide {name}", perhaps(name, known, "slide"))


def _values(item: Item, names: Names) -> Pairs | None:
    if not isinstance(item.value, list):
        return item.fault(f"{described(item.value)} where rows are wanted", SUCH)
    if len(item.value) > MOST:
        return item.fault(f"{len(item.value)} rows", f"at most {MOST}")
    rows = [item.instead(row).vector() for row in item.value]
    return None if None in rows else tuple(row for row in rows if row)


def _powers(item: Item, names: Names) -> tuple[Fraction, ...] | None:
    if not isinstance(item.value, list) or not 1 <= len(item.value) <= 3:
        return item.fault(f"{described(item.value)} where up to three numbers are wanted",
                          "powers = [c0, c1, c2] of the load c0 + c1 v + c2 v |v|")
    found = [item.instead(value).number() for value in item.value]
    return None if None in found else tuple(c for c in found if c is not None)


def _file(item: Item, names: Names) -> Pairs | None:
    name = item.text("the name of a file", 'the name of a file beside the scene, such as file = "indicator.csv"')
    if name is None:
        return None
    if os.path.isabs(name) or ".." in name.replace("\\", "/").split("/") or not name.endswith((".csv", ".txt")):
        return item.fault(f"{described(name)} is no table beside the scene", "a file .csv or .txt in its folder")
    try:
        with open(os.path.join(names.folder, name), "rb") as file:
            text = file.read(LARGEST + 1).decode("utf-8-sig")
    except (OSError, ValueError) as error:  # ValueError: no UTF-8, or a path that no file system has
        why = getattr(error, "strerror", None) or "it is no text in UTF-8"
        return item.fault(f"{name} cannot be read ({why})", "a readable file beside the scene")
    if len(text) > LARGEST:
        return item.fault(f"{name} is larger than {LARGEST // 10**6} MB", f"a table of at most {MOST} rows")
    found = _columns(item.instead(name), text)
    if found is not None:
        names.files[name] = found
    return found


def _columns(item: Item, text: str) -> Pairs | None:
    """The two columns of a text; a line of words at its top is its head."""
    lines = [(number, line.partition("#")[0].strip()) for number, line in enumerate(text.splitlines(), 1)]
    lines = [(number, line) for number, line in lines if line]
    split = _split([line for _, line in lines])
    found: list[tuple[Fraction, Fraction]] = []
    for number, line in lines:
        row = [_numeral(cell) for cell in split(line)]
        if len(row) == 2 and row[0] is not None and row[1] is not None:
            found.append((row[0], row[1]))
        elif found or number > lines[0][0] or any(cell is not None for cell in row):
            return item.fault(f"{item.value}, line {number}: {described(line)} is no place and value", COLUMNS)
        if len(found) > MOST:
            return item.fault(f"{item.value} has more than {MOST} rows", f"at most {MOST}")
    return tuple(found)


def _split(lines: list[str]) -> Any:
    """What cuts a line into its cells: a comma may be between them, or in decimals that something else is between."""
    for mark in ";\t":
        if any(mark in line for line in lines):
            return lambda line: line.split(mark)
    if all(line.count(",") == 1 and not re.search(r"\d\s+[\d+-]", line) for line in lines):
        return lambda line: line.split(",")
    return str.split


def _numeral(cell: str) -> Fraction | None:
    number = decimal(cell.strip().replace(",", ".")) if re.search(r"\d", cell) else None
    return number if isinstance(number, Fraction) else None


OVER = Field("over", 'what the load changes with: "travel" (degrees or lengths of the first drive from this pose), a '
             'slide such as "3 along frame" (its position, once around), "speed" (of the first drive), or "speed of '
             '3 along frame"', Kind("travel · slide · speed", _over, {"type": "string"}))
TABLE = (
    OVER,
    Field("values", "the rows of the load: place and value, straight between them; two rows at one place are a jump",
          Kind("list of rows", _values, {"type": "array", "items": VECTOR.schema, "minItems": 2, "maxItems": MOST})),
    Field("file", "the same rows in a file .csv or .txt beside the scene, in two columns",
          Kind("file name", _file, {"type": "string", "pattern": r"\.(csv|txt)$"})),
    Field("powers", "of a load over a speed v instead of rows: [c0, c1, c2] of c0 + c1 v + c2 v |v|",
          Kind("one to three numbers", _powers, {"type": "array", "items": NUMBER.schema, "minItems": 1,
                                                 "maxItems": 3})),
)
DIRECTION = Field("direction", "of a force with over: the direction in which it is positive, fixed in the plane, or by "
                  "two points with which it turns", GUIDE)


def table(row: Row) -> LoadTable | None:
    """The table of a load, checked; None where the load is constant, or the table has a fault."""
    over, given = row.values.get("over"), [key for key in ("values", "file", "powers") if key in row.items]
    if over is None:
        for key in given[:1]:
            row.items[key].fault(f"{key} says nothing without over", 'over = "travel"')
        return None
    if len(given) != 1:
        what = f"{' and '.join(given)} are both given" if given else "values is missing"
        return row.item.fault(what, f"one of values, file or powers, such as {SUCH}")
    if over == "travel" and not any(isinstance(pair, Drive) for pair in row.names.pairs):
        return row.items["over"].fault("no drive leads", "a slide, or a scene with a [[drive]]")
    item, where = row.items[given[0]], row.item.where
    if given == ["powers"]:
        found = LoadTable(over, powers=row["powers"], where=where)
        return found if found.over_speed else item.fault(
            "powers are of a speed, and the load is over a position", 'values, or over = "speed"')
    rows: Pairs = row[given[0]]
    file = str(item.value) if given == ["file"] else ""
    found = LoadTable(over, rows, where=where, scene=row.names.scene, file=file)
    if found.over_position and len(rows) > 3 and rows[0] == rows[-1]:  # it may say that it goes around
        found = replace(found, rows=rows[:-1] if rows[0][0] == rows[-2][0] else rows)
    faults = list(_out_of_order(found))
    for what, instead in faults[:1]:
        item.fault(f"{file}: {what}" if file else what, instead)
    return None if faults else replace(found, period=_period(found, row.names))


def _out_of_order(table: LoadTable) -> Iterator[tuple[str, str]]:
    """What is wrong with the order of a table's rows, and what would be right."""
    places = [place for place, _ in table.rows]
    if len(places) < 2 or len({*places}) < 2:
        yield "a table of fewer than two places", f"at least two rows, such as {SUCH}"
        return
    around = [*places, *places[:2]] if table.over_position else places
    for three in zip(around, around[1:], around[2:], strict=False):
        if len({*three}) == 1:
            yield f"three rows at one place, {shown(three[0])}", "at most two, for a jump"
    steps = [b - a for a, b in pairwise(places)]
    if not table.over_position:
        for i, step in enumerate(steps, 1):
            if step < 0:
                yield f"row {i + 1} goes back to {shown(places[i])}", "rows in the order of their places"
        return
    senses = [step > 0 for step in steps if step]
    turns = sum(a != b for a, b in pairwise(senses))
    if turns != 1:
        what = "the rows do not come back" if not turns else f"the rows turn back {turns} times"
        yield (f"{what}: over a slide's position they go once around",
               "first the outward stroke's rows, then the return's")


def _period(table: LoadTable, names: Names) -> Fraction:
    """The whole turns after which a table over the travel of a turning drive repeats; 0 where it covers none."""
    first = next((pair for pair in names.pairs if isinstance(pair, Drive)), None)
    span = Fraction(table.rows[-1][0]) - Fraction(table.rows[0][0])
    return span if table.over == TRAVEL and first and not first.slides and span % 360 == 0 else Fraction(0)
