"""Measured points: marks by their coordinates in mm on the student's own sheet, as CSV or TOML."""

from __future__ import annotations

import cmath
import math
import tomllib
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files.curves import SHORT, circle, ring
from graphplan.marking.files.safe import MB, TRACES, Budget, on_paper, text
from graphplan.marking.spelling import spelled
from graphplan.marking.tables.results import entry, turned
from graphplan.marking.tables.table_rows import TableRow, rows
from graphplan.marking.traces import Number, PlanFrame, Spot, Submission, Trace

LARGEST = MB // 2
DOTS = 3000  # in a line, or as many squared: the time that dotted keys take grows so
LONGEST = 40  # characters of a mark's name
COARSEST = 1.0  # mm, to which anybody can measure; with a blur without bounds any mark would pass
TABLES = {"marks": POINT, "lines": LINE, "circles": CIRCLE}
SHAPES = {POINT: "[x, y]", LINE: "[[x1, y1], [x2, y2]]", CIRCLE: "[x, y, r], or points along its rim, three at least"}


def panel_named(written: str, panels: Collection[str]) -> str:
    """The plan that is meant, or nothing where none is named.

    Fails with `ValueError` where there is no such plan.
    """
    if not written.strip():
        return ""
    known = {_short(panel): panel for panel in panels}
    if _short(written) not in known:
        raise ValueError(f"the construction has no plan {written.strip()[:40]!r}, but {', '.join(panels)}")
    return known[_short(written)]


def _short(panel: str) -> str:
    """A plan's name as it is compared: `Mechanism plan`, `mechanism`."""
    return " ".join(panel.casefold().split()).removesuffix(" plan")


def read_table(path: Path, panels: Collection[str]) -> Submission:
    """The marks of a table with the columns mark, x and y, and also x2 and y2, r, panel and precision."""
    traces = [trace for row in rows(path) if (trace := _marked(row, panels))]
    return Submission(path.name, tuple(traces), shows=_shown(traces))


def _marked(row: TableRow, panels: Collection[str]) -> Trace | None:
    """The mark in a row; None where it is not measured."""
    at, end, radius = row.lengths("x", "y"), row.lengths("x2", "y2"), row.lengths("r")
    (blur,) = row.lengths("precision") or (0.0,)
    if at is None:
        return None
    try:
        panel = panel_named(row["panel"], panels)
    except ValueError as error:
        raise row.fault(str(error), "one of them, or nothing") from None
    label = spelled(row["mark"])
    if len(label) > LONGEST or not label.isprintable():
        raise row.fault("this is no name of a mark", "its letters, such as v_b")
    if not 0 <= blur <= COARSEST:
        raise row.fault(f"a precision of {blur:g} mm is none of a ruler", f"0 to {COARSEST:g} mm")
    if (end and radius) or (radius and radius[0] < SHORT) or (end and math.dist(at, end) < SHORT):
        raise row.fault("this is no mark", "x and y, for a line also x2 and y2 elsewhere, for a circle r, in mm that "
                        f"paper shows ({SHORT:g} at least)")
    kind = LINE if end else CIRCLE if radius else POINT
    spots = ring(_spot(at), radius[0]) if radius else tuple([_spot(spot) for spot in (at, end) if spot])
    return Trace(kind, spots, label, panel, blur)


def _spot(numbers: tuple[float, ...]) -> Spot:
    return numbers[0], numbers[1]


def _bent(spots: list[Spot]) -> bool:
    """Whether spots show a circle by their first, middle and last, by which it is measured."""
    found = circle(spots[0], spots[len(spots) // 2], spots[-1]) if len(spots) >= 3 else None
    return found is not None and found[1] >= SHORT


def _shown(traces: Iterable[Trace]) -> frozenset[str]:
    """Points, and whatever else was measured."""
    return frozenset({POINT, *(trace.kind for trace in traces)})


def read_toml(path: Path, panels: Collection[str]) -> Submission:
    """The marks, lines, circles, frames and results of a TOML file."""
    written = text(path, LARGEST)
    if sum(line.count(".") ** 2 for line in written.splitlines()) > DOTS**2:
        raise Refused(f"{path}", "its lines have too many dots", "a line for each mark")
    try:
        tables = tomllib.loads(written)
    except RecursionError:
        raise Refused(f"{path}", "tables or lists are nested too deeply", "[marks] with A = [x, y]") from None
    except ValueError as error:
        raise Refused(f"{path}", f"this is no TOML: {error}", "text that follows toml.io") from None
    return _Tables(path, panels).read(tables)


class _Tables:
    """Reads the tables of one file."""

    def __init__(self, path: Path, panels: Collection[str]):
        self.path, self.panels, self.blur = path, panels, 0.0
        self.budget = Budget(path, TRACES, "marks")

    def read(self, tables: Mapping[str, Any]) -> Submission:
        known = [*TABLES, "precision", "results", "frames"]
        if unknown := [key for key in tables if key not in known]:
            raise self._fault(unknown[0], "there is no such entry", f"one of {', '.join(known)}")
        self.blur = self._length("precision", tables.get("precision", 0.0))
        if not 0 <= self.blur <= COARSEST:
            raise self._fault("precision", f"{self.blur:g} mm is none of a ruler", f"0 to {COARSEST:g} mm")
        traces = [trace for key, kind in TABLES.items()
                  for trace in self._traces(key, kind, self._table(key, tables.get(key, {})), "")]
        numbers = [number for kind, table in self._table("results", tables.get("results", {})).items()
                   for number in self._numbers(kind, self._table(f"results.{kind}", table))]
        frames = {self._panel("frames", panel): self._frame(f"frames.{panel}", table)
                  for panel, table in self._table("frames", tables.get("frames", {})).items()}
        shown = _shown(traces) if traces else frozenset()
        return Submission(self.path.name, tuple(traces), tuple(numbers), shown, frames)

    def _traces(self, where: str, kind: str, table: Mapping[str, Any], panel: str) -> Iterable[Trace]:
        """The entries of a table, and of the tables in it that are named after plans."""
        for name, value in table.items():
            self.budget.spend()
            if isinstance(value, dict) and not panel:
                yield from self._traces(f"{where}.{name}", kind, value, self._panel(where, name))
            else:
                spots = self._spots(f"{where}.{name}", kind, value)
                if len(name) > LONGEST or not name.isprintable():
                    raise self._fault(where, "it has an entry that is no name of a mark", "its letters, such as v_b")
                yield Trace(kind, spots, spelled(name), panel, self.blur)

    def _spots(self, where: str, kind: str, value: Any) -> tuple[Spot, ...]:
        """Where an entry lies."""
        fault = self._fault(where, "this is no " + kind, SHAPES[kind])
        if not isinstance(value, list) or not value:
            raise fault
        if not isinstance(value[0], list):
            numbers = [self._length(where, part) for part in value]
            if kind == CIRCLE and len(numbers) == 3 and numbers[2] >= SHORT:
                return ring((numbers[0], numbers[1]), numbers[2])
            value = [numbers] if kind == POINT else []
        spots = [self._pair(where, spot) for spot in value]
        good = {POINT: len(spots) == 1, LINE: len(spots) == 2 and math.dist(*spots) >= SHORT, CIRCLE: _bent(spots)}
        if not good[kind]:
            raise fault
        return tuple(spots)

    def _numbers(self, kind: str, table: Mapping[str, Any]) -> Iterable[Number]:
        """The results of one kind: components, one number, or size and angle; `unit` is that of all."""
        unit = table.get("unit", "")
        for of, value in table.items():
            where = f"results.{kind}.{of}"
            self.budget.spend()
            if of == "unit" and isinstance(value, str):
                continue
            polar = isinstance(value, dict) and set(value) == {"size", "angle"}
            parts = [value["size"], value["angle"]] if polar else value if isinstance(value, list) else [value]
            numbers = [self._number(where, part) for part in parts]
            try:
                yield entry(kind, of, turned(numbers[0], numbers[1]) if polar else numbers, str(unit))
            except ValueError as error:
                raise self._fault(where, str(error), "such as A = [1.5, 2] with unit = \"m/s\"") from None

    def _frame(self, where: str, table: Any) -> PlanFrame:
        """Where a plan lies: its origin in mm, its scale in mm for one of its units, how far it is turned."""
        entries = self._table(where, table)
        if unknown := set(entries) - {"origin", "scale", "turn"}:
            raise self._fault(where, f"there is no {min(unknown)}", "origin, scale and turn")
        origin = self._pair(f"{where}.origin", entries.get("origin"))
        scale = self._length(f"{where}.scale", entries.get("scale", 1.0))
        turn = self._length(f"{where}.turn", entries.get("turn", 0.0))
        if scale <= 0:
            raise self._fault(f"{where}.scale", "a plan has a size", "mm for one unit of the plan")
        return PlanFrame(complex(*origin), cmath.rect(scale, math.radians(turn)))

    def _panel(self, where: str, name: str) -> str:
        try:
            return panel_named(name, self.panels)
        except ValueError as error:
            raise self._fault(where, str(error), "one of them") from None

    def _table(self, where: str, value: Any) -> Mapping[str, Any]:
        if not isinstance(value, dict):
            raise self._fault(where, "this is no table", f"[{where}] with an entry a line")
        return value

    def _pair(self, where: str, value: Any) -> Spot:
        if not isinstance(value, list) or len(value) != 2:
            raise self._fault(where, "this is no point", "[x, y] in mm")
        return self._length(where, value[0]), self._length(where, value[1])

    def _length(self, where: str, value: Any) -> float:
        found = self._number(where, value)
        if not on_paper(found):
            raise self._fault(where, "it is on no sheet of paper", "millimetres as measured")
        return found

    def _number(self, where: str, value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or not -1e300 < value < 1e300:
            raise self._fault(where, "this is no number", "a decimal number such as 12.5")
        return float(value)

    def _fault(self, where: str, why: str, do: str) -> Refused:
        shown = "".join([char if char.isprintable() else " " for char in where[:80]])
        return Refused(f"{self.path}: {shown}", why, do)
