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
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.mistakes import MISTAKES, Mistake, mistakes
from graphplan.marking.judge.student_sheet import apart, plain

CLOSEST = 16  # how many slips are looked at closely
FARTHER, RARER = 4.0, 0.5  # what each step back in the drawing, and each place down the table, adds to a sum of squares


@dataclass(frozen=True)
class Suspect:
    """A slip at a step that would lead to a wrong mark, and what it adds to the sum of squares."""

    mistake: Mistake
    source: Step
    rank: float = 0.0


def explained(matching: Matching, match: Match) -> Suspect | None:
    """The slip that explains a wrong trace best, if one does."""
    step = match.step
    assert match.place is not None
    spots = matching.sheet.spots(step.index, matching.traces[match.place])
    best, least = None, math.inf
    for suspect in _closest(matching, step, [complex(*plain(spot)) for spot in spots]):
        made = _carried(matching, step, matching.own, suspect, matching.sheet.domain, matching.sheet.errors)
        if made is None:
            continue
        residual = matching.sheet.residual(step, made, spots, matching.own)
        if residual.fits(matching.rules.chance) and residual.square + suspect.rank < least:
            best, least = suspect, residual.square + suspect.rank
    return best


def _closest(matching: Matching, step: Step, spots: Sequence[complex]) -> list[Suspect]:
    """The slips that lead nearest to what was drawn."""
    floats, hand = [plain(value) for value in matching.own[:step.index]], matching.sheet.hand
    found: list[tuple[float, int, Suspect]] = []
    for suspect in _suspects(matching, step):
        made = _carried(matching, step, floats, suspect, Floats(), lambda index: [0.0] * len(hand.slips[index]))
        if made is not None and all(map(math.isfinite, made)):
            found.append((apart(step.op.gives, made, spots), len(found), suspect))
    return [suspect for _, _, suspect in sorted(found)[:CLOSEST]]


def _suspects(matching: Matching, step: Step) -> Iterator[Suspect]:
    """Every slip at the step, and at those before that cannot be seen."""
    order = {kind: place for place, kind in enumerate(MISTAKES)}
    for far, source in enumerate(_unseen(matching, step)):
        for mistake in mistakes(matching.sheet.drawing.drawn, source, matching.sheet.plan_of_step):
            yield Suspect(mistake, source, FARTHER * far + RARER * order[mistake.kind])


def _unseen(matching: Matching, step: Step) -> list[Step]:
    """The step and those before it on whose marks it rests without their being seen, the last first."""
    found, front = {step.index}, [step.index]
    while front:
        for arg in matching.steps[front.pop()].args:
            if arg not in found and matching.matches[arg].place is None and not matching.steps[arg].op.free:
                found.add(arg)
                front.append(arg)
    return [matching.steps[index] for index in sorted(found, reverse=True)]


def _carried(matching: Matching, step: Step, values: Sequence[Any], suspect: Suspect, domain: Domain,
             errors: Errors) -> Any:
    """What the step becomes where a slip was made, and all that is unseen follows from it; None where nothing does."""
    drawn, source, hand = list(values), suspect.source.index, matching.sheet.hand
    try:
        wrong = suspect.mistake.value(domain, values)
        drawn[source:source + 1] = [hand.slipped(suspect.source, wrong, errors(source))]
        follows = {source}
        for between in matching.steps[source + 1:step.index + 1]:
            unseen = between.index == step.index or matching.matches[between.index].place is None
            if unseen and not follows.isdisjoint(between.args):
                drawn[between.index:between.index + 1] = [hand.made(between, domain, drawn, errors)]
                follows.add(between.index)
    except Undrawable:
        return None
    return drawn[step.index] if step.index in follows else None
