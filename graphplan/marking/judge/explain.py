"""What was probably done at a wrong step, or at one before it that is not to be seen itself."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from graphplan.accuracy.hand import Errors
from graphplan.errors import Undrawable
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Step
from graphplan.marking.judge.matching import Taken, Walk
from graphplan.marking.judge.mistakes import MISTAKES, Slip, slips
from graphplan.marking.judge.student_sheet import apart, plain

CLOSEST = 16  # how many slips are looked at closely
FARTHER, RARER = 4.0, 0.5  # what each step back in the drawing, and each place down the table, adds to a sum of squares


@dataclass(frozen=True)
class Suspect:
    """A slip at a step that would lead to a wrong mark, and what it adds to the sum of squares."""

    slip: Slip
    source: Step
    rank: float = 0.0


def explained(walk: Walk, taken: Taken) -> Suspect | None:
    """The slip that explains a wrong trace best, if one does."""
    step = taken.step
    assert taken.place is not None
    spots = walk.board.spots(step.index, walk.traces[taken.place])
    best, least = None, math.inf
    for suspect in _closest(walk, step, [complex(*plain(spot)) for spot in spots]):
        made = _carried(walk, step, walk.own, suspect, walk.board.domain, walk.board.errors)
        if made is None:
            continue
        deviation = walk.board.deviation(step, made, spots, walk.own)
        if deviation.fits(walk.rules.chance) and deviation.square + suspect.rank < least:
            best, least = suspect, deviation.square + suspect.rank
    return best


def _closest(walk: Walk, step: Step, spots: Sequence[complex]) -> list[Suspect]:
    """The slips that lead nearest to what was drawn."""
    floats = [plain(value) for value in walk.own[:step.index]]
    found: list[tuple[float, int, Suspect]] = []
    for suspect in _suspects(walk, step):
        made = _carried(walk, step, floats, suspect, Floats(), lambda index: [0.0] * len(walk.board.hand.slips[index]))
        if made is not None and all(map(math.isfinite, made)):
            found.append((apart(step.op.gives, made, spots), len(found), suspect))
    return [suspect for _, _, suspect in sorted(found)[:CLOSEST]]


def _suspects(walk: Walk, step: Step) -> Iterator[Suspect]:
    """Every slip at the step, and at those before that cannot be seen."""
    order = {kind: place for place, kind in enumerate(MISTAKES)}
    for far, source in enumerate(_unseen(walk, step)):
        for slip in slips(walk.board.drawing.drawn, source, walk.board.plan_of_step):
            yield Suspect(slip, source, FARTHER * far + RARER * order[slip.kind])


def _unseen(walk: Walk, step: Step) -> list[Step]:
    """The step and those before it on whose marks it rests without their being seen, the last first."""
    found, front = {step.index}, [step.index]
    while front:
        for arg in walk.steps[front.pop()].args:
            if arg not in found and walk.taken[arg].place is None and walk.steps[arg].op.name not in (
                    "given", "begin"):
                found.add(arg)
                front.append(arg)
    return [walk.steps[index] for index in sorted(found, reverse=True)]


def _carried(walk: Walk, step: Step, values: Sequence[Any], suspect: Suspect, domain: Domain, errors: Errors) -> Any:
    """What the step becomes where a slip was made, and all that is unseen follows from it; None where nothing does."""
    drawn, source, hand = list(values), suspect.source.index, walk.board.hand
    try:
        wrong = suspect.slip.value(domain, values)
        drawn[source:source + 1] = [hand.slipped(suspect.source, wrong, errors(source))]
        follows = {source}
        for between in walk.steps[source + 1:step.index + 1]:
            unseen = between.index == step.index or walk.taken[between.index].place is None
            if unseen and not follows.isdisjoint(between.args):
                drawn[between.index:between.index + 1] = [hand.made(between, domain, drawn, errors)]
                follows.add(between.index)
    except Undrawable:
        return None
    return drawn[step.index] if step.index in follows else None
