"""Traces that a step may have made by a mistake that no table has: they keep one of the places that it claims."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge.matching import ASTRAY, Matching
from graphplan.marking.judge.student_sheet import apart, plain

KEPT = 4.0  # standard deviations within which a claim is kept


def unmatched(matching: Matching, step: Step) -> Iterator[tuple[int, tuple[float, ...]]]:
    """The traces that no step needs, a line through one of the points that a step names, or a point on one of its
    lines, anywhere if it names none; with what the step would have made. `walk` has gone through."""
    sheet, kind = matching.sheet, step.op.gives
    mm = sheet.mm(sheet.plan_of_step[step.index])
    on = [plain(matching.own[step.args[claim[1]]]) for claim in step.op.claims if claim[0] == "on"]
    for place in matching.unlabelled.of(kind) if kind in (POINT, LINE) else ():
        if place in matching.used or matching.traces[place].panel not in ("", sheet.plan_of_step[step.index]):
            continue
        spots = sheet.spots(step.index, matching.traces[place])
        value = plain(sheet.seen(step, matching.own[step.index], spots, steady=True))
        off = min((_off(kind, value, thing) for thing in on), default=0.0 if kind == POINT else ASTRAY) * mm
        far = apart(POINT, value, [complex(*plain(matching.own[step.index]))]) * mm if kind == POINT else 0.0
        if off < KEPT * max(sheet.pencil.point, sheet.pencil.edge) and far < ASTRAY:
            yield place, value


def _off(kind: str, value: Sequence[float], thing: Sequence[float]) -> float:
    """How far a point and a line, one of which is a step's, are from each other."""
    line, point = (value, thing) if kind == LINE else (thing, value)
    return apart(LINE, line, [complex(*point[:2])])
