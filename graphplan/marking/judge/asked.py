"""The results that a task asks for, each with how it was handed in: as a number of a table, or as drawn marks."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from graphplan.marking.judge.verdict import FOLLOWS, MISSING, RIGHT, UNSEEN, UNSURE, WRONG, Judgement
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import CYCLE, ResultKind
from graphplan.methods.recorded import Reading


@dataclass(frozen=True)
class AskedResult:
    """A result that is asked for and its state: that of its number, if there is one, else what its marks show."""

    kind: ResultKind
    of: str
    state: str


def shown_by(drawing: Construction, reading: Reading) -> frozenset[int]:
    """The steps that show a result: points of the pose and beginnings of plans show nothing by themselves."""
    found = (drawing.drawn.wanted[place] for place in reading.marks)
    return frozenset(mark for mark in found if not drawing.drawn.steps[mark].op.free)


def results(judgement: Judgement) -> Iterator[AskedResult]:
    """All of them. What only given points show is asked for in a table alone; what is too small to be drawn, and what
    is prescribed, is not asked for: a wrong number of it counts nevertheless."""
    numbers = {(verdict.number.kind, verdict.number.of): verdict.state for verdict in judgement.numbers}
    states = {verdict.step: verdict.state for verdict in judgement.verdicts}
    for reading in judgement.drawing.readings:
        state = numbers.get((reading.kind, reading.of))
        if state is None:
            shown = {states[mark] for mark in shown_by(judgement.drawing, reading)}
            state = _shown(shown) if judgement.drawn else MISSING
        if state != UNSEEN and (reading.given is None or state == WRONG):
            yield AskedResult(reading.kind, reading.of, state)
    for kind, of in numbers:
        if kind in CYCLE:  # asked for as far as it is handed in
            yield AskedResult(CYCLE[kind], of, numbers[kind, of])


def _shown(states: Collection[str]) -> str:
    """What marks say together; that one of them is wrong was held against it already."""
    worst = next((state for state in (MISSING, UNSURE, UNSEEN) if state in states), None if states else UNSEEN)
    return worst or (RIGHT if {WRONG, FOLLOWS}.isdisjoint(states) else FOLLOWS)
