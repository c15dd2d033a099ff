"""The rows of a survey as comma-separated text: a heading, then a line for each."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from dataclasses import fields
from typing import Any


def table(kind: type, rows: Iterable[Any]) -> str:
    """Rows of one dataclass; numbers in as many digits as tell them apart, what there is not is left empty."""
    names = [field.name for field in fields(kind)]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(getattr(row, name)) for name in names] for row in rows)
    return file.getvalue()


def _cell(value: Any) -> str:
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)
