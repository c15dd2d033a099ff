"""The words of a sheet: the numbered steps, the results, the check and the forms chosen, as rows of a column."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from graphplan.kernel.numbers.floats import Floats
from graphplan.sheet.captions import spoken
from graphplan.sheet.deviations import Deviations
from graphplan.sheet.lettering import SIZE, sentence_runs, wrap
from graphplan.sheet.planes import Drawing, Planes
from graphplan.sheet.rows import Cell, Row
from graphplan.sheet.scales import digits
from graphplan.sheet.tables import ROUNDING, joined_tables, largest_size, rows, scalars, vectors

HEADING, INDENT = 3.0, 8.5


@dataclass(frozen=True, eq=False)
class Words:
    """All that is said beside the plans; `check` is the difference from the analytic solver, by kind.

    A sheet is composed more than once, with other drawing errors: what does not hang on them is set once for a width.
    """

    planes: Planes
    check: Mapping[str, Any] = field(default_factory=dict)
    _set: dict[float, tuple[list[Row], list[Row]]] = field(default_factory=dict)

    @property
    def drawing(self) -> Drawing:
        return self.planes.drawing

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The letters that may stand in a sentence."""
        return tuple(step.name for step in self.drawing.drawn.steps if step.name)

    @cached_property
    def values(self) -> Mapping[str, Mapping[str, Any]]:
        """What the construction reads off, by kind and name."""
        return self.drawing.read(Floats())

    def rows(self, wide: float, pencil: Deviations) -> list[Row]:
        """Everything, for a column of this width; `pencil` are the expected drawing errors where they are told."""
        if wide not in self._set:
            self._set[wide] = [*self._steps(wide)], [*self._check(wide), *self._forms(wide)]
        before, after = self._set[wide]
        return [*before, *self._results(wide, pencil), *self._errors(wide, pencil.told), *after]

    def _said(self, text: str, wide: float, step: int | None = None, number: str = "") -> Iterator[Row]:
        """A paragraph, hanging from its number."""
        indent = INDENT if number else 0.0
        lines = wrap(sentence_runs(text, self.names), SIZE, wide - indent)
        for i, runs in enumerate(lines):
            label = (Cell(indent - 1.6, sentence_runs(number), "end"),) if number and i == 0 else ()
            yield Row((*label, Cell(indent, runs)), step=step, keep=min(3, len(lines) - 1 - i))

    def _steps(self, wide: float) -> Iterator[Row]:
        drawn, told = self.drawing.drawn, set[str]()
        yield heading("Construction")
        given = ", ".join(step.name for step in drawn.steps[: drawn.givens])
        yield from self._said(f"Given, on the mechanism plan: {given}.", wide)
        panel = ""
        for step in drawn.steps[drawn.givens :]:
            if step.panel != panel:
                panel = step.panel
                yield heading(f"On the {spoken(panel)}", SIZE, 1.2)
            why = "" if not step.why or step.why in told else f" ({step.why[0].upper()}{step.why[1:]}.)"
            told.add(step.why)
            yield from self._said(drawn.sentence(step.index) + why, wide, step.index, str(drawn.number(step.index)))

    def _results(self, wide: float, pencil: Deviations) -> Iterator[Row]:
        values, off = self.values, pencil.of
        scene, unit = self.drawing.scene, self.drawing.scene.units.length
        yield heading("Results")
        velocity = vectors("v", f"{unit}/s", values.get("velocity", {}), scene.points, off("velocity"))
        acceleration = vectors("a", f"{unit}/s²", values.get("acceleration", {}), scene.points, off("acceleration"))
        yield from joined_tables(velocity, acceleration, wide)
        omega = scalars("omega", "1/s", values.get("omega", {}), scene.links, off("omega"))
        alpha = scalars("alpha", "1/s²", values.get("alpha", {}), scene.links, off("alpha"))
        yield from joined_tables(omega, alpha, wide)
        if scene.slides:
            yield from self._sliding(wide, pencil)
        if scene.loads:
            yield from self._forces(wide, pencil)

    def _sliding(self, wide: float, pencil: Deviations) -> Iterator[Row]:
        """The motion of slides, beside the fastest and the sharpest of all."""
        unit, slides = self.drawing.scene.units.length, [slide.name for slide in self.drawing.scene.slides]
        values, off = self.values, pencil.of
        fastest, sharpest = (largest_size(values.get(kind, {})) for kind in ("velocity", "acceleration"))
        moving, speeding = (values.get(kind, {}) for kind in ("slide velocity", "slide acceleration"))
        velocity = vectors("v", f"{unit}/s", moving, slides, off("slide velocity"), "slide", fastest)
        acceleration = vectors("a", f"{unit}/s²", speeding, slides, off("slide acceleration"), "slide", sharpest)
        yield from joined_tables(velocity, acceleration, wide)

    def _forces(self, wide: float, pencil: Deviations) -> Iterator[Row]:
        from graphplan.sheet.force_tables import ForceTables  # most scenes have no loads

        tables = ForceTables(self.drawing, self.values, pencil)
        yield from rows(tables.reactions())
        for sentence in tables.seats():
            yield from self._said(sentence, wide)
        yield from rows(tables.balance())

    def _errors(self, wide: float, told: str) -> Iterator[Row]:
        if told:
            yield heading("Drawing errors")
            yield from self._said(told, wide)

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


def _shortened(form: str) -> str:
    """A form and its reason, beside its nearest rival only."""
    head, rather, rivals = form.replace(" degrees", "°").partition(" rather than ")
    return head + rather + (rivals.split("), ")[0].rstrip(")") + ")" if rivals else "")


def heading(text: str, size: float = HEADING, gap: float = 3.0) -> Row:
    return Row((Cell(0.0, sentence_runs(text), bold=True),), size=size, gap=gap, keep=2)


def _within(gap: float) -> str:
    """A difference as it is said on a sheet: rounding is not told in figures, which differ from machine to machine."""
    return "below 10⁻¹²" if gap <= ROUNDING else digits(gap, 2)
