"""Tables of a column: names to the left, numbers in columns, two tables side by side where there is room."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from graphplan.sheet.layout.scales import digits
from graphplan.sheet.lettering.lettering import SIZE, Runs, name_runs, sentence_runs, width
from graphplan.sheet.words.deviations import Deviation
from graphplan.sheet.words.rows import Cell, Row

APART = 3.0  # mm between two columns
ROUNDING = 1e-12  # beside the largest number of its kind
Table = list[list[Runs]]


Off = Mapping[str, Deviation]  # how far off results are drawn, by name; empty where that is not told


def vectors(what: str, letter: str, unit: str, values: Mapping[str, Any], order: Any, off: Off, beside: float = 0.0,
            spoken: Callable[[str], str] = str) -> Table:
    """Components, magnitudes and deviations, each row with its name first; nothing if there are none.

    The head tells what has them, their letter and their unit; names may be `spoken` in another way.
    """
    head = [sentence_runs(text) for text in (what, f"{letter}_x", f"{letter}_y", f"|{letter}| {unit}")]
    largest = max(largest_size(values), beside)
    names = [n for n in order if n in values]
    rows = [[name_runs(spoken(n)), *(figure(x, largest) for x in (*values[n], math.hypot(*values[n])))] for n in names]
    return with_deviations([head, *rows], names, off) if rows else []


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


def scalars(what: str, name: str, unit: str, values: Mapping[str, Any], order: Any, off: Off) -> Table:
    """Single numbers with their deviations, each row with its name first; nothing if there are none."""
    head = [sentence_runs(what), (*name_runs(name), *sentence_runs(f" {unit}"))]
    largest = max((abs(value) for value in values.values()), default=0.0)
    names = [n for n in order if n in values]
    rows = [[name_runs(n), figure(values[n], largest)] for n in names]
    return with_deviations([head, *rows], names, off) if rows else []


def figure(value: float, largest: float) -> Runs:
    """A number of a table; what is only rounding beside its largest is zero."""
    return sentence_runs(digits(value if abs(value) > ROUNDING * largest else 0.0))


def joined_tables(one: Table, two: Table, wide: float) -> Iterator[Row]:
    """Two tables side by side where the names are the same and there is room, else one under the other."""
    if one and two and [row[0] for row in one] == [row[0] for row in two]:
        both = [[*left, *right[1:]] for left, right in zip(one, two, strict=True)]
        if sum(_widths(both)) <= wide:
            one, two = both, []
    for table in filter(None, (one, two)):
        yield from rows(table)


def _widths(table: Table) -> list[float]:
    return [max(width(row[i], SIZE) for row in table) + APART for i in range(len(table[0]))]


def rows(table: Table) -> Iterator[Row]:
    """Names to the left, numbers to the right of their columns."""
    edges = [0.0]
    for wide in _widths(table) if table else ():
        edges.append(edges[-1] + wide)
    for i, row in enumerate(table):
        numbers = [Cell(edge - APART / 2, runs, "end") for edge, runs in zip(edges[2:], row[1:], strict=True)]
        gap, keep = (1.0, min(15, len(table) - 1)) if i == 0 else (0.0, 0)
        yield Row((Cell(0.0, row[0]), *numbers), gap=gap, keep=keep)
