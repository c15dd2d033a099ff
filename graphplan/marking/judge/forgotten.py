"""A plan whose scale was forgotten: what is carried over to it is as long there as on the mechanism plan.

All of the plan is then alike, and right by itself; what is measured on it by its stated scale is not. So that is one
mistake, of the first vector that was carried over; the rest is judged by the scale in which it is drawn.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from graphplan.kernel.program import Step
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.student_sheet import plain
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, WRONG, Verdict
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import phrase, said

FORGOTTEN, WORDS = "scale forgotten", phrase("the scale of a plan forgotten")
ALIKE, APART = 0.03, 1.1  # how far, relatively, a scale may be off that of the mechanism; how far the right one is not


def forgotten(verdicts: Iterable[Verdict], matching: Matching, multiples: Mapping[str, Any]) -> Iterator[Verdict]:
    """The verdicts on a drawing, with that on a forgotten scale; `multiples` are those of the plans' right scales."""
    first = {step.index: step for panel in multiples if (step := _carried(matching, panel, float(multiples[panel])))}
    at = min(first, default=len(matching.steps))
    plans = {matching.sheet.plan_of_step[index] for index in first}
    for verdict in verdicts:
        if verdict.step in first:
            yield _told(verdict, first[verdict.step], matching, multiples)
        elif verdict.step > at and verdict.state == RIGHT and matching.sheet.plan_of_step[verdict.step] in plans:
            yield replace(verdict, state=FOLLOWS)
        else:
            yield verdict


def _carried(matching: Matching, panel: str, multiple: float) -> Step | None:
    """The first vector that was carried over to a plan, if that has the scale of the mechanism, and should not."""
    sheet = matching.sheet
    if panel not in sheet.fits or 1 / APART < multiple < APART or panel == MECHANISM:
        return None
    if abs(sheet.mm(panel) / sheet.mm(MECHANISM) - 1) > ALIKE:
        return None
    return next((step for step in matching.steps if sheet.plan_of_step[step.index] == panel
                 and step.root is not None and matching.matches[step.index].place is not None
                 and any(sheet.plan_of_step[arg] == MECHANISM for arg in step.args)), None)


def _told(verdict: Verdict, step: Step, matching: Matching, multiples: Mapping[str, Any]) -> Verdict:
    """The verdict on the first vector: by how much it is too long or too short."""
    home = matching.sheet.plan_of_step[step.index]
    assert step.root is not None
    start, end = (complex(*plain(matching.own[index])[:2]) for index in (step.root, step.index))
    off = abs(end - start) * matching.sheet.mm(home) * abs(float(multiples[home]) - 1)
    place = matching.matches[step.index].place
    return replace(verdict, state=WRONG, off=off, astray=off, kind=FORGOTTEN, guilty=step.index,
                   trace=matching.traces[place] if place is not None else None,
                   mistake=said("the scale of the {0} is forgotten: its vectors are as long as on the {1}",
                                step.panel.words, matching.steps[0].panel.words))
