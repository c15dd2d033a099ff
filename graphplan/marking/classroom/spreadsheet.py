"""Tables as files for a spreadsheet: .csv, or .xlsx where openpyxl is installed."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from importlib.util import find_spec

from graphplan.errors import Refused

Row = Sequence[str | float | None]


FORMULA = re.compile(r"[=+\-@\t\r](?!\s*[\d.,]+$)..*", re.DOTALL)


def csv_text(rows: Iterable[Row]) -> str:
    """Rows as CSV; what spreadsheets would take for a formula stands behind an apostrophe, as text does there."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(
        [f"'{cell}" if isinstance(cell, str) and FORMULA.match(cell) else cell for cell in row] for row in rows)
    return text.getvalue()


def require_openpyxl(output: str) -> None:
    """Refuse a workbook that cannot be written here, before anything is judged."""
    if not find_spec("openpyxl"):
        raise Refused(output, "writing .xlsx needs openpyxl, which is not installed",
                      "pip install 'graphplan[xlsx]', or a name in .csv, which spreadsheets read")


def workbook(rows: Iterable[Row]) -> bytes:
    """Rows as a workbook; what begins as a formula does stays text."""
    from openpyxl import Workbook

    book, data = Workbook(), io.BytesIO()
    for row in rows:
        book.active.append(row)
    for cell in (cell for cells in book.active for cell in cells if cell.data_type == "f"):
        cell.data_type = "s"
    book.save(data)
    return data.getvalue()
