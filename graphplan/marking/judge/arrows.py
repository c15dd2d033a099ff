"""Vectors whose ends have no letters, and whose arrows go the wrong way.

Of a stroke nobody says what it is meant to be. An arrow says it where it begins in the mark at which a vector is laid
off and ends in no other mark, goes as that would reversed or turned by a right angle, and no stroke goes the right way.
Its length is free: forces may have a scale of the student's own.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain, permutations

from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.judge.evidence import ends_at
from graphplan.marking.judge.laid_off import lays_off_vector
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.mistaken_step import Mistake
from graphplan.marking.judge.mistakes import DEEDS, possible_mistakes
from graphplan.marking.judge.student_sheet import plain_value
from graphplan.marking.traces import Submission


@dataclass(frozen=True)
class RightWay:
    """Where a vector should go, in mm of the sheet, and by how much of a radian its direction is unsure."""

    vector: complex
    sigma: float

    def turn_of(self, way: complex, mark_error: float) -> float | None:
        """By how much a stroke is turned from it, in right angles, 0 to 3; None where by none of them."""
        ratio = way / self.vector
        quarters = round(cmath.phase(ratio) / (math.pi / 2))
        allowed = measures.SAME_DIRECTION_SINE + 3 * math.hypot(self.sigma, math.sqrt(2) * mark_error / abs(way))
        return quarters % 4 if abs(cmath.phase(ratio * 1j**-quarters)) < allowed else None


def wrong_arrow(matching: Matching, submission: Submission) -> Mistake | None:
    """The first vector that is nowhere drawn as it should be, but as an arrow that goes the wrong way; None where there
    is none."""
    vectors = [(match.step, list(_right_ways(matching, match))) for match in matching.matches
               if submission.tips and _is_unseen_vector(match)]
    error = matching.sheet.pencil.point
    for step, directions in vectors:
        start = _spot(matching, matching.steps[step.root or 0])
        arrows = [tip - start for tip in _arrow_tips(submission, start)]
        strokes = [*arrows, *(end - start for end in _stroke_ends(submission, start))]
        from_here = chain.from_iterable(right_ways for vector, right_ways in vectors if vector.root == step.root)
        if not directions or any(right.turn_of(stroke, error) == 0 for right in from_here for stroke in strokes):
            continue
        for arrow in arrows:
            if _is_no_mark(matching, start + arrow) and (
                    mistake := _mistake_as(matching, step, directions[0], arrow)):
                return mistake
    return None


def _is_unseen_vector(match: Match) -> bool:
    return (match.place is None and match.mistake is None and match.step.root is not None
            and match.step.op.gives == POINT and lays_off_vector(match.step.op))


def _right_ways(matching: Matching, match: Match) -> Iterator[RightWay]:
    """Where a vector should go by the student's own marks, and by the mended ones, as far as that is sure."""
    step, sheet = match.step, matching.sheet
    if step.root is None or matching.matches[step.root].place is None:
        return
    for basis in (matching.own, matching.mended):
        unit = sheet.frame(step).unit
        vector, sigma = sheet.laid_off(step, step.root, basis) or (0j, 0.0)
        if abs(vector * unit) > measures.MIN_VECTOR_MM and abs(vector) > measures.SURE_VECTOR_SIGMAS * sigma:
            yield RightWay(vector * unit, sigma / abs(vector))


def _mistake_as(matching: Matching, step: Step, right: RightWay, arrow: complex) -> Mistake | None:
    """The vector's being reversed, or turned by a right angle, as an arrow goes, with its length."""
    turn, drawing = right.turn_of(arrow, matching.sheet.pencil.point), matching.sheet.drawing
    label = next((vector.label for vector in drawing.arrows if vector.end == step.index), None)
    for deed in possible_mistakes(drawing.drawn, step, matching.sheet.plan_of_step, ()):
        if turn and deed.factor == 1j**turn:
            words, _ = DEEDS.get(deed.kind, (None, ()))
            return replace(deed, factor=arrow / right.vector, text=words(label) if words and label else deed.text)
    return None


def _arrow_tips(submission: Submission, start: complex) -> Iterator[complex]:
    """The tips of the arrows that begin at a mark."""
    for tip in (complex(*spot) for spot in submission.tips):
        if any(ends_at((start, end), tip) and abs(tip - end) < abs(tip - start)
               for end in _stroke_ends(submission, start)):
            yield tip


def _stroke_ends(submission: Submission, start: complex) -> Iterator[complex]:
    """Where the strokes end that begin at a mark and leave it."""
    for trace in submission.traces:
        if trace.kind == LINE:
            yield from (end for begin, end in permutations(complex(*spot) for spot in trace.spots[:2])
                        if abs(begin - start) < measures.ARROW_TAIL_MM < abs(end - start))


def _is_no_mark(matching: Matching, tip: complex) -> bool:
    """Whether an arrow ends in no mark that was found."""
    return all(abs(tip - _spot(matching, match.step)) > measures.TWIN_MM for match in matching.matches
               if match.place is not None and match.step.op.gives == POINT)


def _spot(matching: Matching, step: Step) -> complex:
    """Where a mark is on the sheet, as it is drawn."""
    return matching.sheet.frame(step).to_sheet(complex(*plain_value(matching.own[step.index])[:2]))
