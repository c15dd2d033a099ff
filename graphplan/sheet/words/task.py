"""The words of a task: what is given, what is to be found, a table to fill; and of its guided version, the steps."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from graphplan.kernel.kinds import COMPASSES, DIVIDERS, SCALE, SET_SQUARES, STRAIGHTEDGE
from graphplan.methods.panels import slide_named
from graphplan.phrases import joined, phrase, said, unit
from graphplan.sheet.frames.title import GUIDED, TASK, TITLE
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.words.answer_boxes import TICKED, answer_rows, fits, ticked
from graphplan.sheet.words.deviations import Deviations
from graphplan.sheet.words.problem_text import data, question
from graphplan.sheet.words.rows import TextRow
from graphplan.sheet.words.tables import Table, joined_tables
from graphplan.sheet.words.texts import Words

INSTRUMENTS = {
    SET_SQUARES: phrase("set squares"), STRAIGHTEDGE: phrase("straightedge"), COMPASSES: phrase("compasses"),
    DIVIDERS: phrase("dividers"), SCALE: phrase("scale"),
}  # fmt: skip


class Task(Words):
    """All that is said on a task sheet, or where it is `guided`, on the sheet of a student who is told the steps."""

    indent = TICKED

    def lines(self, wide: float, guided: bool) -> list[TextRow]:
        """Everything, for a column of this width."""
        return [self._heading(GUIDED if guided else TASK, TITLE, 0.0), *self._given(wide),
                *(self._steps(wide) if guided else ()), *self._answers(wide), *(() if guided else self._hints(wide))]

    def _given(self, wide: float) -> Iterator[TextRow]:
        scene = self.drawing.scene
        yield self._heading(said("Given"))
        for sentence in data(scene):
            yield from self._said(sentence, wide)
        asked = list(question(scene, self.values))
        yield from [self._heading(said("To find"))] if asked else []
        for sentence in asked:
            yield from self._said(sentence, wide)

    def _numbered(self, row: TextRow) -> TextRow:
        """The row with a box to tick before its number."""
        return ticked(row)

    def _hints(self, wide: float) -> Iterator[TextRow]:
        """What is needed: instruments, and how many steps."""
        drawn = self.drawing.drawn
        steps = drawn.steps[drawn.givens:]
        used = {step.op.instrument for step in steps}
        yield self._heading(said("Hints"))
        named = joined(name() for instrument, name in INSTRUMENTS.items() if instrument in used)
        yield from self._said(said("Instruments: {0}.", named), wide)
        yield from self._said(said("Steps of the solution: {0}.", len(steps)), wide)

    # ---- the table to fill -----------------------------------------------------------------------------------------

    def _answers(self, wide: float) -> Iterator[TextRow]:
        """A box for every number that the construction gives, in the order of the solution."""
        pairs = [pair for pair in self._pairs() if any(pair)]
        yield from [self._heading(said("Results"))] if pairs else []
        for one, two in pairs:
            for table in joined_tables(one, two, partial(fits, wide=wide)):
                yield from answer_rows(table, wide)

    def _pairs(self) -> Iterator[tuple[Table, Table]]:
        """The tables of the solution, two by two as they stand side by side."""
        yield from self._motion(Deviations())
        if self.drawing.scene.loads:
            from graphplan.sheet.words.force_tables import ForceTables  # most scenes have no loads

            tables = ForceTables(self.drawing, self.values, Deviations(), self.plans.tongue)
            yield tables.reactions(), self._seats()
            yield tables.balance(), []

    def _seats(self) -> Table:
        """Where the reactions of slides act, as a table."""
        say, slides = self.plans.tongue, {slide.name: slide_named(slide) for slide in self.drawing.scene.slides}
        arms = self.values.get("slide arm", {})
        heads = [sentence_runs(say(text)) for text in (said("line of action of"), "x",
                                                       joined(("y", unit(self.drawing.scene.units.length)), " "))]
        box = sentence_runs("0")  # stands for a number
        return [heads, *([sentence_runs(say(slides[name])), box, box] for name in arms)] if arms else []
