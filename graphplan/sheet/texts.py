"""The words of a sheet: the numbered steps, the results, the check and the forms chosen, as rows of a column."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from graphplan.kernel.numbers.floats import Floats
from graphplan.sheet.lettering import SIZE, Runs, name_runs, sentence_runs, width, wrap
from graphplan.sheet.planes import MECHANISM, Drawing, Planes
from graphplan.sheet.rows import Cell, Row
from graphplan.sheet.scales import digits

HEADING, INDENT, APART = 3.0, 8.5, 3.0
ROUNDING = 1e-12  # beside the largest number of its kind
Table = list[list[Runs]]


@dataclass(frozen=True)
class Words:
    """All that is said beside the plans; `check` is the difference from the analytic solver, by kind."""

    planes: Planes
    check: Mapping[str, Any] = field(default_factory=dict)

    @property
    def drawing(self) -> Drawing:
        return self.planes.drawing

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The letters that may stand in a sentence."""
        return tuple(step.name for step in self.drawing.drawn.steps if step.name)

    def rows(self, wide: float) -> list[Row]:
        """Everything, for a column of this width."""
        sections = (self._steps(wide), self._results(wide), self._check(wide), self._forms(wide))
        return [row for section in sections for row in section]

    def _said(self, text: str, wide: float, step: int | None = None, number: str = "") -> Iterator[Row]:
        """A paragraph, hanging from its number."""
        indent = INDENT if number else 0.0
        lines = wrap(sentence_runs(text, self.names), SIZE, wide - indent)
        for i, runs in enumerate(lines):
            label = (Cell(indent - 1.6, sentence_runs(number), "end"),) if number and i == 0 else ()
            yield Row((*label, Cell(indent, runs)), step=step, keep=min(3, len(lines) - 1 - i))

    def _steps(self, wide: float) -> Iterator[Row]:
        drawn, spoken = self.drawing.drawn, set[str]()
        yield heading("Construction")
        given = ", ".join(step.name for step in drawn.steps[: drawn.givens])
        yield from self._said(f"Given, on the mechanism plan: {given}.", wide)
        panel = ""
        for step in drawn.steps[drawn.givens :]:
            if step.panel != panel:
                panel = step.panel
                yield heading(f"On the {spoken_panel(panel)}", SIZE, 1.2)
            why = "" if not step.why or step.why in spoken else f" ({step.why[0].upper()}{step.why[1:]}.)"
            spoken.add(step.why)
            yield from self._said(drawn.sentence(step.index) + why, wide, step.index, str(drawn.number(step.index)))

    def _results(self, wide: float) -> Iterator[Row]:
        values = self.drawing.read(Floats())
        unit = self.drawing.scene.units.length
        yield heading("Results")
        velocity = _vectors("v", f"{unit}/s", values.get("velocity", {}), self.drawing.scene.points)
        acceleration = _vectors("a", f"{unit}/s²", values.get("acceleration", {}), self.drawing.scene.points)
        yield from joined_tables(velocity, acceleration, wide)
        omega = _scalars("omega", "1/s", values.get("omega", {}), self.drawing.scene.links)
        alpha = _scalars("alpha", "1/s²", values.get("alpha", {}), self.drawing.scene.links)
        yield from joined_tables(omega, alpha, wide)
        slides = [slide.name for slide in self.drawing.scene.slides]
        fastest, sharpest = (_largest(values.get(kind, {})) for kind in ("velocity", "acceleration"))
        velocity = _vectors("v", f"{unit}/s", values.get("slide velocity", {}), slides, "slide", fastest)
        acceleration = _vectors("a", f"{unit}/s²", values.get("slide acceleration", {}), slides, "slide", sharpest)
        yield from joined_tables(velocity, acceleration, wide)

    def _check(self, wide: float) -> Iterator[Row]:
        if self.check:
            yield heading("Check")
            parts = ", ".join(f"{kind} {_within(float(gap))}" for kind, gap in self.check.items())
            yield from self._said("Largest difference from the analytic solver, beside the largest value of its kind: "
                                  f"{parts}.", wide)  # fmt: skip

    def _forms(self, wide: float) -> Iterator[Row]:
        yield heading("Method and forms")
        for kind, ways in self.drawing.method.items():
            yield from self._said(f"{kind.capitalize()}: {', '.join(ways)}.", wide)
        for form in self.drawing.forms:
            yield from self._said(_shortened(form), wide)


def spoken_panel(panel: str) -> str:
    return "mechanism plan" if panel == MECHANISM else panel


def _shortened(form: str) -> str:
    """A form and its reason, beside its nearest rival only."""
    head, rather, rivals = form.replace(" degrees", "°").partition(" rather than ")
    return head + rather + (rivals.split("), ")[0].rstrip(")") + ")" if rivals else "")


def heading(text: str, size: float = HEADING, gap: float = 3.0) -> Row:
    return Row((Cell(0.0, sentence_runs(text), bold=True),), size=size, gap=gap, keep=2)


def _vectors(letter: str, unit: str, values: Mapping[str, Any], order: Any, what: str = "point",
             beside: float = 0.0) -> Table:
    """Components and magnitudes, each row with its name first; nothing if there are none."""
    head = [sentence_runs(text) for text in (what, f"{letter}_x", f"{letter}_y", f"|{letter}| {unit}")]
    largest = max(_largest(values), beside)
    rows = [[name_runs(n), *(_figure(x, largest) for x in (*values[n], math.hypot(*values[n])))]
            for n in order if n in values]  # fmt: skip
    return [head, *rows] if rows else []


def _largest(values: Mapping[str, Any]) -> float:
    """The size of the largest vector."""
    return max((math.hypot(*value) for value in values.values()), default=0.0)


def _scalars(name: str, unit: str, values: Mapping[str, Any], order: Any) -> Table:
    head = [sentence_runs("link"), (*name_runs(name), *sentence_runs(f" {unit}"))]
    largest = max((abs(value) for value in values.values()), default=0.0)
    rows = [[name_runs(n), _figure(values[n], largest)] for n in order if n in values]
    return [head, *rows] if rows else []


def _figure(value: float, largest: float) -> Runs:
    """A number of a table; what is only rounding beside its largest is zero."""
    return sentence_runs(digits(value if abs(value) > ROUNDING * largest else 0.0))


def joined_tables(one: Table, two: Table, wide: float) -> Iterator[Row]:
    """Two tables side by side where the names are the same and there is room, else one under the other."""
    if one and two and [row[0] for row in one] == [row[0] for row in two]:
        both = [[*left, *right[1:]] for left, right in zip(one, two, strict=True)]
        if sum(_widths(both)) <= wide:
            one, two = both, []
    for table in filter(None, (one, two)):
        yield from _table(table)


def _widths(table: Table) -> list[float]:
    return [max(width(row[i], SIZE) for row in table) + APART for i in range(len(table[0]))]


def _table(table: Table) -> Iterator[Row]:
    """Names to the left, numbers to the right of their columns."""
    edges = [0.0]
    for wide in _widths(table):
        edges.append(edges[-1] + wide)
    for i, row in enumerate(table):
        numbers = [Cell(edge - APART / 2, runs, "end") for edge, runs in zip(edges[2:], row[1:], strict=True)]
        gap, keep = (1.0, min(15, len(table) - 1)) if i == 0 else (0.0, 0)
        yield Row((Cell(0.0, row[0]), *numbers), gap=gap, keep=keep)


def _within(gap: float) -> str:
    """A difference as it is said on a sheet: rounding is not told in figures, which differ from machine to machine."""
    return "below 10⁻¹²" if gap <= ROUNDING else digits(gap, 2)
