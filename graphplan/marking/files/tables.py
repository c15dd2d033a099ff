"""What a student measured and computed, from tables in text: marks by their coordinates in mm on his own sheet, and
results; as CSV, as spreadsheets and editors of any country write it, or as TOML."""

from __future__ import annotations

import cmath
import csv
import math
import tomllib
from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files import measures
from graphplan.marking.files.drawing import circle_spots, circle_through
from graphplan.marking.files.quantities import (
    WrittenNumber,
    entry_hint,
    last_digit_unit,
    parse_number,
    polar_vector,
    rounding_deviation,
    student_number,
    toml_float,
)
from graphplan.marking.files.safe import Budget, on_paper, text
from graphplan.marking.traces import PlanFrame, Spot, StudentNumber, Submission, Trace, spell

NUMBER_COLUMNS = "value", "size", "angle"  # columns of answers with numbers
OWNER_COLUMNS = "student", "variant"  # columns of a class's table that say whose a row is
KIND_OF_TABLE = {"marks": POINT, "lines": LINE, "circles": CIRCLE}
LARGEST_NUMBER = 1e300  # that a table may have: larger ones are slips
MARK_SHAPES = {POINT: "[x, y]", LINE: "[[x1, y1], [x2, y2]]",
               CIRCLE: "[x, y, r], or points along its rim, three at least"}


def read_csv(path: Path, panels: Collection[str]) -> Submission:
    """Measured points, with the columns mark, x and y, and also x2 and y2, r, panel and precision; or results, with the
    columns quantity, of and unit, and x and y, size and angle, size alone, or value. Comments begin with #."""
    reader = _CsvReader(path, panels)
    return reader.submission(*reader.table())


TableReading = Callable[[Collection[str]], Submission]  # what is read of a table, by the plans that marks may lie on


def read_class_csv(path: Path) -> dict[str, TableReading]:
    """The table of a class, by whose its rows are: the same columns beside one called student or variant; a table
    without these is of the one whom its file is called after."""
    header, rows = (reader := _CsvReader(path, ())).table()
    column = next((name for name in OWNER_COLUMNS if name in header), None)
    rows_of: dict[str, list[tuple[str, Mapping[str, str]]]] = defaultdict(list)
    for where, row in rows:
        rows_of[row[column] if column else path.stem].append((where, row))
    return {owner: partial(_read_rows, path, reader.separator, header, own) for owner, own in rows_of.items()}


def _read_rows(path: Path, separator: str, header: Sequence[str], rows: Iterable[tuple[str, Mapping[str, str]]],
               panels: Collection[str]) -> Submission:
    """Submission of one student from a table."""
    reader = _CsvReader(path, panels)
    reader.separator = separator
    return reader.submission(header, rows)


class TableAnswer(NamedTuple):
    """A single number of a table of answers: what it is, and of what, its unit, the standard deviation of its rounding,
    and where it stands."""

    quantity: str
    of: str
    value: float
    unit: str
    rounding: float
    where: str


def read_answers(path: Path) -> list[TableAnswer]:
    """The answers of a table with the columns quantity, of, value and unit; size and angle are two answers."""
    return [answer for where, row in _CsvReader(path, ()).rows({"quantity"}) for answer in _row_answers(where, row)]


def _row_answers(where: str, row: Mapping[str, str]) -> Iterator[TableAnswer]:
    """Yield the numbers of a row; empty if it is not filled in."""
    for column, quantity, unit in (("value", row["quantity"], row["unit"]), ("size", row["quantity"], row["unit"]),
                                   ("angle", "angle", "")):
        if row[column]:
            try:
                value = parse_number(row[column])
            except ValueError as error:
                raise Refused(f"{where}: {column}", str(error), "a decimal number such as 12.5") from None
            yield TableAnswer(" ".join(quantity.casefold().split()), " ".join(row["of"].split()), float(value), unit,
                              last_digit_unit(value) / measures.UNIFORM_WIDTH_SIGMAS, where)


def read_toml(path: Path, panels: Collection[str]) -> Submission:
    """The marks, lines, circles, frames and results of a TOML file."""
    content = text(path, measures.MAX_TOML_BYTES)
    if sum(line.count(".") ** 2 for line in content.splitlines()) > measures.MAX_DOTS**2:
        raise Refused(f"{path}", "its lines have too many dots", "a line for each mark")
    try:
        tables = tomllib.loads(content, parse_float=toml_float)
    except RecursionError:
        raise Refused(f"{path}", "tables or lists are nested too deeply", "[marks] with A = [x, y]") from None
    except ValueError as error:
        raise Refused(f"{path}", f"not TOML: {error}", "text that follows toml.io") from None
    return _TomlReader(path, panels).read(tables)


def _plan_key(panel: str) -> str:
    """A plan's name as it is compared: `Mechanism plan`, `mechanism`."""
    return " ".join(panel.casefold().split()).removesuffix(" plan")


class _Reader:
    """One file; what is checked alike however it is written. `where` is an entry's place in it."""

    def __init__(self, path: Path, panels: Collection[str]):
        self.path, self.panels = path, {_plan_key(panel): panel for panel in panels}
        self.read_off: list[float] = []  # all coordinates and radii, as they were written
        self.left_out: list[str] = []  # arcs that are too small to be seen

    def fault(self, where: str, why: str, do: str) -> Refused:
        place = "".join([char if char.isprintable() else " " for char in where[:80]])
        return Refused(f"{self.path}: {place}", why, do)

    def number(self, where: str, value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or not (
                -LARGEST_NUMBER < value < LARGEST_NUMBER):
            raise self.fault(where, "not a number", "a decimal number such as 12.5")
        return value if isinstance(value, WrittenNumber) else float(value)

    def length(self, where: str, value: Any) -> float:
        length = self.number(where, value)
        if not on_paper(length):
            raise self.fault(where, f"{length:g} mm lies outside any sheet of paper", "millimetres as measured")
        return length

    def pair(self, where: str, value: Any) -> Spot:
        if not isinstance(value, list) or len(value) != 2:
            raise self.fault(where, "not a point", "[x, y] in mm")
        return self.length(where, value[0]), self.length(where, value[1])

    def precision(self, where: str, blur: float, of: str = "") -> float:
        if not 0 <= blur <= measures.MAX_PRECISION_MM:
            raise self.fault(where, f"{of}{blur:g} mm is not the error of a ruler",
                             f"0 to {measures.MAX_PRECISION_MM:g} mm")
        return blur

    def label(self, where: str, name: str, why: str) -> str:
        label = spell(name)
        if len(label) > measures.MAX_NAME_CHARS or not label.isprintable():
            raise self.fault(where, f"{why} no name of a mark", "its letters, such as v_b")
        return label

    def panel(self, where: str, name: str, do: str = "one of them") -> str:
        """The plan that is named; empty if the cell is empty."""
        if name.strip() and _plan_key(name) not in self.panels:
            panel_names = ", ".join(self.panels.values())
            raise self.fault(where, f"the construction has no plan {name.strip()[:40]!r}, but {panel_names}", do)
        return self.panels[_plan_key(name)] if name.strip() else ""

    def spots(self, where: str, kind: str, value: Any, fault: Refused) -> tuple[Spot, ...]:
        """Spots of a mark, by its coordinates, a circle's with the radius, or by those of several spots."""
        if not isinstance(value, list) or not value:
            raise fault
        if not isinstance(value[0], list):
            numbers = [self.length(where, coordinate) for coordinate in value]
            self.read_off += numbers
            if kind == CIRCLE and len(numbers) == 3 and numbers[2] >= measures.MIN_LINE_MM:
                return circle_spots((numbers[0], numbers[1]), numbers[2])
            value = [numbers] if kind == POINT else []
        else:
            self.read_off += [coordinate for spot in value for coordinate in self.pair(where, spot)]
        spots = [(float(x), float(y)) for x, y in (self.pair(where, spot) for spot in value)]
        good = {POINT: len(spots) == 1, LINE: len(spots) == 2 and math.dist(*spots) >= measures.MIN_LINE_MM,
                CIRCLE: _shows_circle(spots)}
        if not good[kind]:
            raise fault
        return tuple(spots)

    def with_precision(self, traces: Sequence[Trace]) -> tuple[Trace, ...]:
        """The marks with the precision that is stated, or else that with which they were written down."""
        blur = rounding_deviation(self.read_off)
        return tuple(trace if trace.blur else replace(trace, blur=blur) for trace in traces)

    def result(self, where: str, quantity: str, of: str, parts: Sequence[float], unit: str, do: str, *,
               polar: bool = False) -> StudentNumber:
        """A result by its components or its only number, or by its size and angle, or its size alone."""
        sized, polar = polar and len(parts) == 1, polar and len(parts) == 2
        last = max(map(last_digit_unit, parts))
        if polar:
            last = max(last_digit_unit(parts[0]), abs(parts[0]) * math.radians(last_digit_unit(parts[1])))
        try:
            value = polar_vector(*parts) if polar else tuple(map(float, parts))
            return student_number(quantity, of, value, unit, last / measures.UNIFORM_WIDTH_SIGMAS, sized=sized)
        except ValueError as error:
            raise self.fault(where, str(error), do) from None


def _shows_circle(spots: list[Spot]) -> bool:
    """Whether spots show a circle by their first, middle and last, by which it is measured."""
    rim = circle_through(spots[0], spots[len(spots) // 2], spots[-1]) if len(spots) >= 3 else None
    return rim is not None and rim[1] >= measures.MIN_LINE_MM


class _CsvReader(_Reader):
    """Reads rows by the names in the first one; empty rows are left out."""

    separator = ","

    def submission(self, header: Sequence[str], rows: Iterable[tuple[str, Mapping[str, str]]]) -> Submission:
        """Submission of a table's rows."""
        if {"mark", "x", "y"} <= set(header):
            traces = [trace for where, row in rows if (trace := self._mark_trace(where, row))]
            stated = any(trace.blur for trace in traces)
            return Submission(self.path.name, self.with_precision(traces), shows=_shown_kinds(traces), measured=True,
                              stated=stated, left_out=tuple(self.left_out))
        if "quantity" in header:
            numbers = [result for where, row in rows if (result := self._result(where, row))]
            return Submission(self.path.name, numbers=tuple(numbers))
        raise Refused(f"{self.path}", "its first line names no known columns",
                      "mark,x,y for measured points or quantity,of,x,y,unit for results")

    def rows(self, wanted: Collection[str]) -> Iterator[tuple[str, Mapping[str, str]]]:
        """The rows of a table that has these columns, with their places."""
        header, rows = self.table()
        if not {*wanted} <= {*header}:
            raise Refused(f"{self.path}", "its first line names no known columns",
                          "quantity,of,value,unit for answers")
        for where, row in rows:
            decimal = row if self.separator == "," else {
                name: cell.replace(",", ".", 1) if name in NUMBER_COLUMNS else cell for name, cell in row.items()}
            yield f"{self.path}: {where}", defaultdict(str, decimal)

    def table(self) -> tuple[list[str], Iterator[tuple[str, Mapping[str, str]]]]:
        """The names of the columns, and the rows that say something."""
        lines = text(self.path, measures.MAX_CSV_BYTES).splitlines()
        Budget(self.path, measures.MAX_TRACES, "lines").spend(len(lines))
        numbered_lines = [(f"line {i}", line)
                          for i, line in enumerate(lines, 1) if line.strip() and line.lstrip()[0] != "#"]
        self.separator = next((mark for mark in "\t;" if numbered_lines and mark in numbered_lines[0][1]), ",")
        cells = self._cells(numbered_lines)
        where, first = next(cells, ("", []))
        header = [cell.casefold() for cell in first]
        if twice := [name for name in header if name and header.count(name) > 1]:
            raise self.fault(where, f"two columns are called {twice[0][:40]!r}", "each name once")
        return header, self._rows(header, cells)

    def _cells(self, lines: Iterable[tuple[str, str]]) -> Iterator[tuple[str, list[str]]]:
        """The cells of each row that says something, with its place."""
        for where, line in lines:
            try:
                row = next(csv.reader([line], delimiter=self.separator, skipinitialspace=True))
            except (csv.Error, StopIteration) as error:
                raise self.fault(where, f"not a row of a table ({error})",
                                 "values with , ; or tabs between them") from None
            if any(cells := [cell.strip() for cell in row]):
                yield where, cells

    def _rows(self, header: Sequence[str], rows: Iterable[tuple[str, list[str]]]
              ) -> Iterator[tuple[str, Mapping[str, str]]]:
        """Yield the cells by their columns; a missing column is empty."""
        for where, cells in rows:
            if any(cells[len(header) :]):
                raise self.fault(where, f"it has {len(cells)} columns, the first line {len(header)}",
                                 "as many; decimal commas need ; or tabs between columns")
            yield where, defaultdict(str, zip(header, cells, strict=False))

    def _numbers(self, where: str, row: Mapping[str, str], *columns: str) -> list[WrittenNumber]:
        """The numbers in these columns; empty if all cells are."""
        numbers = []
        for column in columns if any(row[column] for column in columns) else ():
            try:
                numbers.append(parse_number(row[column] if self.separator == "," else row[column].replace(",", ".", 1)))
            except ValueError as error:
                raise self.fault(f"{where}: {column}", str(error), "a decimal number such as 12.5") from None
        return numbers

    def _mark_trace(self, where: str, row: Mapping[str, str]) -> Trace | None:
        """The mark in a row; None where it is not measured, as is no line between two marks that are one, and no arc
        about one of them through the other."""
        at, end = self._numbers(where, row, "x", "y"), self._numbers(where, row, "x2", "y2")
        radius, blur = self._numbers(where, row, "r"), self._numbers(where, row, "precision")
        if not at or (end and not radius and math.dist(at, end) < measures.MIN_LINE_MM):
            return None
        panel = self.panel(where, row["panel"], "one of them, or nothing")
        label = self.label(where, row["mark"], "this is")
        unsure = self.precision(where, blur[0] if blur else 0.0, "a precision of ")
        kind = LINE if end else CIRCLE if radius else POINT
        if radius and not end and 0 <= radius[0] < measures.MIN_LINE_MM:
            self.left_out.append(label)
            return None
        value = [] if end and radius else [at, end] if end else [*at, *radius]
        fault = self.fault(where, "not a mark", "x and y, for a line also x2 and y2 elsewhere, for a circle r, in "
                           f"mm that paper shows ({measures.MIN_LINE_MM:g} at least)")
        return Trace(kind, self.spots(where, kind, value, fault), label, panel, unsure)

    def _result(self, where: str, row: Mapping[str, str]) -> StudentNumber | None:
        """The result in a row; None where it is not filled in."""
        x, value = self._numbers(where, row, "x", "y"), self._numbers(where, row, "value")
        polar = self._numbers(where, row, "size", *["angle"] * bool(row["angle"] or not row["size"]))
        results = [columns for columns in (x, polar, value) if columns]
        if len(results) > 1:
            raise self.fault(where, "the result is given twice", "x and y, or size and angle, or value")
        quantity, of, unit = row["quantity"], row["of"], row["unit"]
        do = entry_hint(quantity, of)
        return self.result(where, quantity, of, results[0], unit, do, polar=bool(polar)) if results else None


def _shown_kinds(traces: Iterable[Trace]) -> frozenset[str]:
    """Points, and whatever else was measured."""
    return frozenset({POINT, *(trace.kind for trace in traces)})


class _TomlReader(_Reader):
    """Reads tables by their names."""

    def read(self, tables: Mapping[str, Any]) -> Submission:
        known_keys = [*KIND_OF_TABLE, "precision", "results", "frames"]
        if unknown := [key for key in tables if key not in known_keys]:
            raise self.fault(unknown[0], "unknown entry", f"choose one of {', '.join(known_keys)}")
        self.blur = self.precision("precision", self.length("precision", tables.get("precision", 0.0)))
        self.budget = Budget(self.path, measures.MAX_TRACES, "marks")
        traces = [trace for key, kind in KIND_OF_TABLE.items()
                  for trace in self._traces(key, kind, self._table(key, tables.get(key, {})), "")]
        numbers = [number for kind, table in self._table("results", tables.get("results", {})).items()
                   for number in self._results(kind, self._table(f"results.{kind}", table))]
        frames = {self.panel("frames", panel): self._frame(f"frames.{panel}", table)
                  for panel, table in self._table("frames", tables.get("frames", {})).items()}
        kinds = _shown_kinds(traces) if traces else frozenset()
        return Submission(self.path.name, self.with_precision(traces), tuple(numbers), kinds, frames,
                          measured=True, stated="precision" in tables)

    def _table(self, where: str, value: Any) -> Mapping[str, Any]:
        if not isinstance(value, dict):
            raise self.fault(where, "not a table", f"[{where}] with an entry a line")
        return value

    def _traces(self, where: str, kind: str, table: Mapping[str, Any], panel: str) -> Iterable[Trace]:
        """The entries of a table, and of the tables in it that are named after plans."""
        for name, value in table.items():
            self.budget.spend()
            if isinstance(value, dict) and not panel:
                yield from self._traces(f"{where}.{name}", kind, value, self.panel(where, name))
            else:
                at = f"{where}.{name}"
                spots = self.spots(at, kind, value, self.fault(at, f"not a {kind}", MARK_SHAPES[kind]))
                yield Trace(kind, spots, self.label(where, name, "it has an entry that is"), panel, self.blur)

    def _results(self, kind: str, table: Mapping[str, Any]) -> Iterable[StudentNumber]:
        """The results of one kind: components, one number, or size and angle; `unit` is that of all."""
        unit = table.get("unit", "")
        for of, value in table.items():
            where = f"results.{kind}.{of}"
            self.budget.spend()
            if of == "unit" and isinstance(value, str):
                continue
            polar = isinstance(value, dict) and set(value) == {"size", "angle"}
            components = [value["size"], value["angle"]] if polar else value if isinstance(value, list) else [value]
            numbers = [self.number(where, component) for component in components]
            yield self.result(where, kind, of, numbers, str(unit), "such as A = [1.5, 2] with unit = \"m/s\"",
                              polar=polar)

    def _frame(self, where: str, table: Any) -> PlanFrame:
        """Frame of a plan: its origin in mm, its scale in mm for one of its units, its turn."""
        entries = self._table(where, table)
        if unknown := set(entries) - {"origin", "scale", "turn"}:
            raise self.fault(where, f"there is no {min(unknown)}", "origin, scale and turn")
        origin = self.pair(f"{where}.origin", entries.get("origin"))
        scale = self.length(f"{where}.scale", entries.get("scale", 1.0))
        turn = self.length(f"{where}.turn", entries.get("turn", 0.0))
        if scale <= 0:
            raise self.fault(f"{where}.scale", "the scale must be greater than 0", "mm for one unit of the plan")
        return PlanFrame(complex(*origin), cmath.rect(scale, math.radians(turn)))
