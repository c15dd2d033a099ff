"""Tables of values in text files (CSV), as spreadsheets and editors of any country write them."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from graphplan.errors import Refused
from graphplan.marking.files.safe import MB, TRACES, Budget, number, on_paper, text

LARGEST = 4 * MB


@dataclass(frozen=True)
class TableRow:
    """One row by its columns, and where it stands."""

    path: Path
    line: int
    cells: dict[str, str]
    comma: bool  # whether decimals have one

    def __getitem__(self, column: str) -> str:
        """What stands in a column; nothing where there is no such column."""
        return self.cells.get(column, "")

    def numbers(self, *columns: str) -> tuple[float, ...] | None:
        """The numbers in these columns; None where all are empty."""
        if not any(self[column] for column in columns):
            return None
        return tuple([self._number(column) for column in columns])

    def lengths(self, *columns: str) -> tuple[float, ...] | None:
        """The same as mm on a sheet."""
        found = self.numbers(*columns)
        if found is not None and not on_paper(*found):
            raise self.fault(f"{columns[0]} is on no sheet of paper", "millimetres as measured")
        return found

    def _number(self, column: str) -> float:
        written = self[column]
        try:
            return number(written.replace(",", ".", 1) if self.comma else written)
        except ValueError as error:
            raise self.fault(f"{column}: {error}", "a decimal number such as 12.5") from None

    def fault(self, why: str, do: str) -> Refused:
        """What is wrong in this row."""
        return Refused(f"{self.path}: line {self.line}", why, do)


def rows(path: Path) -> Iterator[TableRow]:
    """The rows of a table, by the names in its first line; comments begin with #, empty rows are left out."""
    lines = _lines(path)
    separator = next((_separator(line) for line in lines if _said(line)), ",")
    header: list[str] | None = None
    for line, cells in _cells(path, lines, separator):
        if header is None:
            header = [cell.casefold().lstrip("\ufeff") for cell in cells]
            if twice := [name for name in header if name and header.count(name) > 1]:
                raise Refused(f"{path}: line {line}", f"two columns are called {twice[0][:40]!r}", "each name once")
            continue
        if len(cells) > len(header) and any(cells[len(header) :]):
            raise Refused(f"{path}: line {line}", f"it has {len(cells)} columns, the first line {len(header)}",
                          "as many; decimal commas need ; or tabs between columns")
        yield TableRow(path, line, dict(zip(header, cells, strict=False)), separator != ",")


def columns(path: Path) -> Sequence[str]:
    """The names of the columns."""
    lines = _lines(path)
    line = next((line for line in lines if _said(line)), "")
    return [cell.casefold() for _, cells in _cells(path, [line], _separator(line)) for cell in cells]


def _lines(path: Path) -> list[str]:
    """The lines of a table, if they are not too many."""
    lines = text(path, LARGEST).splitlines()
    Budget(path, TRACES, "lines").spend(len(lines))
    return lines


def _said(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("#")


def _separator(line: str) -> str:
    return next((mark for mark in "\t;" if mark in line), ",")


def _cells(path: Path, lines: Sequence[str], separator: str) -> Iterator[tuple[int, list[str]]]:
    """The cells of each row that says something, with its line."""
    for line, written in enumerate(lines, 1):
        if _said(written):
            try:
                cells = next(csv.reader(io.StringIO(written), delimiter=separator, skipinitialspace=True))
            except (csv.Error, StopIteration) as error:
                raise Refused(f"{path}: line {line}", f"this is no row of a table ({error})",
                              "values with , ; or tabs between them") from None
            cells = [cell.strip() for cell in cells]
            if any(cells):
                yield line, cells
