"""The words beside a judged drawing: counts and score, the first wrong step, what the colours mean, what is wrong."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from graphplan.marking.judge.findings import (
    ALLOWED,
    OFF,
    called,
    counted,
    lacking,
    miss,
    opinion,
    quantity,
    remark,
)
from graphplan.marking.judge.score import GROUPS, Score
from graphplan.marking.judge.verdict import FOLLOWS, MISSING, NOT_NEEDED, RIGHT, STATES, UNSEEN, WRONG, Judgement
from graphplan.marking.traces import Number
from graphplan.phrases import arranged, said
from graphplan.sheet.layout.scales import digits
from graphplan.sheet.lettering.lettering import Runs, sentence_runs
from graphplan.sheet.words.rows import Cell, TextRow
from graphplan.sheet.words.tables import rows
from graphplan.sheet.words.texts import HEADING, Words

VERDICT = said("Verdict")
TITLE, KEY = 3.5, 11.0  # mm: the heading's size, and where the words of the legend begin


@dataclass(frozen=True)
class LegendRow(TextRow):
    """A row of the legend, which has a sample of the strokes of a verdict before it; none stands for what is spare."""

    state: str | None = None


class Remarks(Words):
    """All that is said beside a judged drawing."""

    def lines(self, wide: float, judgement: Judgement, score: Score) -> list[TextRow]:
        """Everything, for a column of this width, what matters most first."""
        return [self._heading(VERDICT, TITLE, 0.0), *self._verdict(wide, judgement), *self._legend(wide),
                *self._score(score), *self._numbers(wide, judgement), *self._wrong(wide, judgement)]

    def _heading(self, text: str, size: float = HEADING, gap: float = 3.0, step: int | None = None) -> TextRow:
        """A heading, which may stand over a single row."""
        return replace(super()._heading(text, size, gap, step), keep=1)

    def _verdict(self, wide: float, judgement: Judgement) -> Iterator[TextRow]:
        yield from self._said(judgement.name, wide)
        yield from self._said(opinion(judgement), wide)
        yield from self._said(arranged("{0:capital}.", counted(judgement)), wide)

    def _legend(self, wide: float) -> Iterator[TextRow]:
        yield self._heading(said("Legend"))
        for state in (RIGHT, FOLLOWS, WRONG, None):
            told = NOT_NEEDED() if state is None else STATES[state]()
            yield LegendRow((Cell(KEY, sentence_runs(self.plans.tongue(told))),), gap=0.6, state=state)
        yield from self._said(said("Grey: the true drawing. Ellipses: where a point may be, after the student's own "
                                   "earlier marks. Dashed: where a wrong mark should be."), wide)

    def _score(self, score: Score) -> Iterator[TextRow]:
        if score.total is None:
            return
        yield self._heading(said("Score"))
        told: list[tuple[str, float]] = [(GROUPS[group](), percent) for group, percent in score.groups.items()]
        told.append((said("in all, of 100"), score.total))
        yield from rows([[self._runs(name), self._runs(f"{percent:.0f}")] for name, percent in told])

    def _numbers(self, wide: float, judgement: Judgement) -> Iterator[TextRow]:
        """The numbers of the table beside the true ones, in the scene's units."""
        if not judgement.numbers:
            return
        yield self._heading(said("Results"))
        table = [[self._runs(text) for text in ("", said("handed in"), said("true"), OFF(), ALLOWED())]]
        for one in judgement.numbers:
            cells = written(one.number), figures(one.true), figures((one.off,)), figures((one.tolerance,))
            table.append([self._runs(quantity(one)), *map(self._runs, cells)])
        yield from rows(table)
        for one in judgement.numbers:
            if one.state == WRONG:
                yield from self._said(miss(one), wide)

    def _wrong(self, wide: float, judgement: Judgement) -> Iterator[TextRow]:
        """The wrong steps one by one, and the numbers of those that are missing or not to be seen."""
        drawn = judgement.drawing.drawn
        wrong = [verdict for verdict in judgement.judged if verdict.state == WRONG]
        if wrong:
            yield self._heading(said("Wrong steps"))
        for verdict in wrong:
            sentence = arranged("{0} {1:capital}.", drawn.sentence(verdict.step), remark(judgement, verdict))
            yield from self._said(sentence, wide, verdict.step, called(drawn, verdict.step).short)
        for state in (MISSING, UNSEEN):
            if told := lacking(judgement, state):
                yield from self._said(arranged("{0:capital}: {1}.", STATES[state](), told), wide)

    def _runs(self, text: str) -> Runs:
        return sentence_runs(self.plans.tongue(text), self.names)


def written(number: Number) -> str:
    """A number as it was handed in, with its unit."""
    return f"{figures(number.value)} {number.unit}".strip()


def figures(numbers: Sequence[float]) -> str:
    """A number, or the components of a vector, as they are told."""
    told = [digits(number) for number in numbers]
    return told[0] if len(told) == 1 else f"({', '.join(told)})"
