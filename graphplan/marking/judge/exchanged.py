"""Two marks that bear each other's letters: one mistake, and none about mechanics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from graphplan.kernel.kinds import POINT
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, WRONG, Verdict
from graphplan.phrases import phrase, said

EXCHANGED, WORDS = "exchanged letters", phrase("letters of two marks exchanged")
Pair = tuple[int, int]


def exchanged(matching: Matching) -> Iterator[Pair]:
    """The steps whose marks bear each other's letters: one is wrong, and either is where the other should be."""
    told = set[int]()
    for match in matching.matches:
        step, labels = match.step.index, matching.labels
        if match.state != WRONG or match.step.op.gives != POINT or labels.get(step) != match.place:
            continue
        for other in labels:
            if told.isdisjoint((step, other)) and other != step and _of(matching, step, other) and _of(
                    matching, other, step):
                told |= {step, other}
                yield min(step, other), max(step, other)


def _of(matching: Matching, index: int, other: int) -> bool:
    """Whether the mark that bears the letters of another step, on the same plan, is where one should be."""
    step, homes = matching.steps[index], matching.sheet.plan_of_step
    if matching.steps[other].op.gives != step.op.gives or homes[index] != homes[other]:
        return False
    spots = matching.sheet.spots(index, matching.traces[matching.labels[other]])
    return matching.sheet.residual(step, matching.mended[index], spots, matching.mended).fits(matching.chance)


def told(verdicts: Iterable[Verdict], pairs: Iterable[Pair], matching: Matching) -> Iterator[Verdict]:
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
            yield replace(verdict, state=WRONG, off=off.size, tolerance=off.tolerance(matching.chance), trace=trace,
                          kind=EXCHANGED, guilty=index,
                          mistake=said("the letters of {0} and {1} are exchanged", name(index), name(other)))
        elif index in second and verdict.state == RIGHT:
            yield replace(verdict, state=FOLLOWS)
        else:
            yield verdict
