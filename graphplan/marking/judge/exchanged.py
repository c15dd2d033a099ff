"""Letters that two marks of a drawing have of each other: one mistake, and none about mechanics."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np

from graphplan.kernel.kinds import POINT
from graphplan.marking.judge import measures
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.student_sheet import plain_value
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, WRONG, Verdict
from graphplan.marking.traces import Trace
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import phrase, said

EXCHANGED_KIND, EXCHANGED_WORDS = "exchanged letters", phrase("letters of two marks exchanged")
Pair = tuple[int, int]


def exchanged_pairs(matching: Matching) -> Iterator[Pair]:
    """The steps whose marks bear each other's letters: one is wrong, and either is where the other should be."""
    paired = set[int]()
    for match in matching.matches:
        step, labels = match.step.index, matching.labels
        if match.state != WRONG or match.step.op.gives != POINT or labels.get(step) != match.place:
            continue
        for rival in labels:
            if paired.isdisjoint((step, rival)) and rival != step and all(
                    _bears_letters_of(matching, *pair) for pair in ((step, rival), (rival, step))):
                paired |= {step, rival}
                yield min(step, rival), max(step, rival)


def _bears_letters_of(matching: Matching, index: int, other: int) -> bool:
    """Whether the mark that bears the letters of another step, on the same plan, is where one should be."""
    step, homes = matching.steps[index], matching.sheet.plan_of_step
    if matching.steps[other].op.gives != step.op.gives or homes[index] != homes[other]:
        return False
    spots = matching.sheet.spots(index, matching.traces[matching.labels[other]])
    return matching.sheet.residual(step, matching.mended[index], spots, matching.mended).fits(matching.chance)


def with_exchanged(verdicts: Iterable[Verdict], pairs: Iterable[Pair], matching: Matching) -> Iterator[Verdict]:
    """The verdicts on a drawing that was judged with letters put right: the first of each pair is wrong for all that.
    """
    first, second = dict(pairs), {other: one for one, other in pairs}
    for verdict in verdicts:
        index = verdict.step
        if index in first and verdict.trace:
            step, other = matching.steps[index], first[index]
            trace, name = matching.traces[matching.labels[other]], matching.sheet.drawing.drawn.text
            spots = matching.sheet.spots(index, trace)
            off = matching.sheet.residual(step, matching.mended[index], spots, matching.mended)
            yield replace(verdict, state=WRONG, off=off.distance, tolerance=off.tolerance(matching.chance), trace=trace,
                          kind=EXCHANGED_KIND, guilty=index,
                          mistake=said("the letters of {0} and {1} are exchanged", name(index), name(other)))
        elif index in second and verdict.state == RIGHT:
            yield replace(verdict, state=FOLLOWS)
        else:
            yield verdict


# ---- letters that set a plan's scale --------------------------------------------------------------------------------


def exchangeable_pairs(matching: Matching) -> Iterator[Pair]:
    """The steps of which the lettered marks of their plan are as they should be at some scale, in the direction of the
    mechanism, only if two marks have each other's letters: such letters may have told another scale."""
    labels, sheet = matching.labels, matching.sheet
    upright = sheet.fits[MECHANISM].frame.unit
    for panel in [panel for panel in sheet.fits if panel != MECHANISM]:
        steps = [step for step in labels if matching.steps[step].op.gives == POINT
                 and sheet.plan_of_step[step] == panel]
        true = np.array([complex(*plain_value(sheet.drawing.values[step])) for step in steps]) * upright
        spots = [complex(*matching.traces[labels[step]].spots[0]) for step in steps]
        if len(steps) < measures.MIN_EXCHANGE_MARKS or _misfit(true, spots) < measures.EXCHANGE_FIT_MM:
            continue
        for i, j in combinations(range(len(steps)), 2):
            swapped = [*spots]
            swapped[i], swapped[j] = spots[j], spots[i]
            if abs(spots[i] - spots[j]) > measures.EXCHANGE_FIT_MM > _misfit(true, swapped):
                yield min(steps[i], steps[j]), max(steps[i], steps[j])


def _misfit(true: Any, spots: Sequence[complex]) -> float:
    """How far marks are at most from where they should be, at the place and the scale that fit best."""
    figure, marks = true - true.mean(), np.array(spots) - np.mean(spots)
    scale = float((marks * figure.conjugate()).real.sum() / (np.abs(figure) ** 2).sum())
    return float(np.abs(marks - scale * figure).max()) if scale > 0 else math.inf


def with_letters_exchanged(traces: Sequence[Trace], one: int, other: int) -> tuple[Trace, ...]:
    """Traces of which two have each other's letters."""
    labels = {one: traces[other].label, other: traces[one].label}
    return tuple(replace(trace, label=labels.get(place, trace.label)) for place, trace in enumerate(traces))
