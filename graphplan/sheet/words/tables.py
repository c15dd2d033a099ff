"""Tables of a column: names to the left, numbers in columns, two tables side by side where there is room."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from graphplan.sheet.layout.scales import digits
from graphplan.sheet.lettering.lettering import SIZE, Runs, name_runs, sentence_runs, width
from graphplan.sheet.words.deviations import Deviation
from graphplan.sheet.words.rows import Cell, TextRow

APART = 3.0  # mm between two columns
ROUNDING = 1e-12  # beside the largest number of its kind
TOGETHER = 15  # rows of a table stand in one column
Table = list[list[Runs]]
Off = Mapping[str, Deviation]  # how far off results are drawn, by name; empty where that is not told


def vectors(what: str, letter: str, unit: str, values: Mapping[str, Any], order: Iterable[str], off: Off,
            beside: float = 0.0, spoken: Callable[[str], str] = str) -> Table:
    """Components, magnitudes and deviations, each row with its name first; nothing if there are none.

    The head tells what has them, their letter and their unit; names may be `spoken` in another way.
    """
    head = [sentence_runs(text) for text in (what, f"{letter}_x", f"{letter}_y", f"|{letter}| {unit}")]
    found = {name: (*values[name], math.hypot(*values[name])) for name in order if name in values}
    return _table(head, found, max(largest_size(values), beside), off, spoken)


def scalars(what: str, name: str, unit: str, values: Mapping[str, Any], order: Iterable[str], off: Off) -> Table:
    """Single numbers with their deviations, each row with its name first; nothing if there are none."""
    head = [sentence_runs(what), (*name_runs(name), *sentence_runs(f" {unit}"))]
    found = {name: (values[name],) for name in order if name in values}
    return _table(head, found, max(map(abs, values.values()), default=0.0), off)


def _table(head: list[Runs], values: Mapping[str, tuple[float, ...]], largest: float, off: Off,
           spoken: Callable[[str], str] = str) -> Table:
    """Numbers, of which the largest of their kind is told, under their head."""
    rows = [[name_runs(spoken(name)), *(figure(x, largest) for x in found)] for name, found in values.items()]
    return with_deviations([head, *rows], list(values), off) if rows else []


def with_deviations(table: Table, names: Sequence[str], off: Off) -> Table:
    """A table with a last column for the deviations of its rows, where they are told."""
    told = [off.get(name) for name in names]
    if not any(told):
        return table
    head = "± (mm)" if any(deviation is not None and deviation.mm is not None for deviation in told) else "±"
    column = [head, *("" if deviation is None else str(deviation) for deviation in told)]
    return [[*row, sentence_runs(cell)] for row, cell in zip(table, column, strict=True)]


def largest_size(values: Mapping[Any, Any]) -> float:
    """The size of the largest vector."""
    return max((math.hypot(*value) for value in values.values()), default=0.0)


def figure(value: float, largest: float) -> Runs:
    """A number of a table; what is only rounding beside its largest is zero."""
    return sentence_runs(digits(value if abs(value) > ROUNDING * largest else 0.0))


def joined_tables(one: Table, two: Table, fits: Callable[[Table], bool]) -> list[Table]:
    """Two tables as one where the names are the same and it fits, else those of the two that say anything."""
    if one and two and [row[0] for row in one] == [row[0] for row in two]:
        both = [[*left, *right[1:]] for left, right in zip(one, two, strict=True)]
        if fits(both):
            return [both]
    return [table for table in (one, two) if table]


def narrow(table: Table, wide: float) -> bool:
    """Whether a table is no wider than this."""
    return sum(_widths(table)) <= wide


def _widths(table: Table) -> list[float]:
    return [max(width(row[i], SIZE) for row in table) + APART for i in range(len(table[0]))]


def rows(table: Table) -> Iterator[TextRow]:
    """Names to the left, numbers to the right of their columns."""
    edges = [0.0]
    for wide in _widths(table) if table else ():
        edges.append(edges[-1] + wide)
    for i, row in enumerate(table):
        numbers = [Cell(edge - APART / 2, runs, "end") for edge, runs in zip(edges[2:], row[1:], strict=True)]
        gap, keep = (1.0, min(TOGETHER, len(table) - 1)) if i == 0 else (0.0, 0)
        yield TextRow((Cell(0.0, row[0]), *numbers), gap=gap, keep=keep)
