"""The key of a class: the results of every variant, as a table that `graphplan verify` reads of a student."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from graphplan.kernel.numbers.floats import Floats
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import KINDS, ResultKind
from graphplan.sheet.words.tables import ROUNDING, largest_size

HEAD = "variant", "student", "quantity", "of", "x", "y", "value", "unit"


class Row(NamedTuple):
    """A result: its quantity, what it is of, its components or its value, its unit."""

    quantity: str
    of: str
    x: str
    y: str
    value: str
    unit: str


def key_rows(drawing: Construction) -> Iterator[Row]:
    """The results of a construction in the scene's units; what is only rounding beside the largest of its kind is 0."""
    for name, values in drawing.read(Floats()).items():
        if name not in KINDS:
            continue
        kind: ResultKind = KINDS[name]
        largest = max(map(abs, values.values()), default=0.0) if kind.single else largest_size(values)
        unit = kind.dimension.unit(drawing.scene.units)
        for of, value in values.items():
            x, y, one = ("", "", value) if kind.single else (*value, "")
            yield Row(name, of, _figure(x, largest), _figure(y, largest), _figure(one, largest), unit)


def _figure(value: float | str, largest: float) -> str:
    """A number in six digits, which no machine rounds in another way; nothing where there is none."""
    return value if isinstance(value, str) else f"{value if abs(value) > ROUNDING * largest else 0.0:.6g}"


def key_table(found: Iterable[tuple[int, str, Iterable[Row]]]) -> str:
    """The results of all variants, each by its number, with its student, as CSV."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(HEAD)
    for variant, student, rows in found:
        table.writerows((variant, student, *row) for row in rows)
    return text.getvalue()
