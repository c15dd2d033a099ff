"""A drawing judged by the construction that it follows, of all those that lead to what was asked."""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.accuracy.pencil import Pencil
from graphplan.accuracy.preference import Constructing, forms
from graphplan.errors import Refused
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.verdict import MISSING, WRONG, Judgement
from graphplan.marking.traces import Submission
from graphplan.methods.construct import construct as unchecked
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import Composition

STYLES = ("orthogonal", "polar")
WRONGED = 3  # a wrong step speaks against a construction as much as so many that are missing or not asked for


def judge_any_method(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil,
                 plan: str = "", inertia: str = "couple", construct: Constructing = unchecked) -> Judgement:
    """What is said of a drawing by the construction of its task, or by another that it follows better.

    Others are tried only where something is amiss: in the other forms of loci and rings, and unless `plan` names one,
    on the other plans. Fails as :func:`judge` does.
    """
    best = judge(drawing, composition, submission, pencil)
    for other, sheet in _others(drawing, pencil, plan, inertia, construct) if _amiss(best) else ():
        try:
            found = judge(other, sheet, submission, pencil)
        except Refused:
            continue
        best = found if _amiss(found) < _amiss(best) else best
    return best


def _others(drawing: Construction, pencil: Pencil, plan: str, inertia: str, construct: Constructing
            ) -> Iterator[tuple[Construction, Composition]]:
    """All other constructions of a scene, on their sheets."""
    for style in (plan,) if plan else STYLES:
        for form in forms(drawing.scene, pencil, plan=style, strict=drawing.strict, inertia=inertia,
                          construct=construct):
            if form.drafted and form.drafted.drawing.drawn.steps != drawing.drawn.steps:
                yield form.drafted.drawing, form.drafted.composition


def _amiss(judgement: Judgement) -> int:
    """How much speaks against a construction: wrong steps, traces that it does not need, marks that are missing."""
    states = [verdict.state for verdict in judgement.verdicts]
    return WRONGED * states.count(WRONG) + len(judgement.spare) + states.count(MISSING)
