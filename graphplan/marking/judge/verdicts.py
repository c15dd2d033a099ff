"""From the matching of a drawing to what is said of it: every step with how far it is off, and may be.

Of a wrong step what was probably done there, or at one before it that is not to be seen itself.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphplan.accuracy.hand import Errors
from graphplan.errors import Undrawable
from graphplan.kernel.kinds import POINT, Movement
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Step
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.mistakes import MISTAKES, Mistake, mistakes
from graphplan.marking.judge.student_sheet import Residual, apart, bound, plain
from graphplan.marking.judge.verdict import MISSING, UNSEEN, WRONG, Ellipse, Verdict

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


def rests(matching: Matching) -> list[bool]:
    """For each step whether it is seen, or a mark that rests on it is: then it was drawn somehow."""
    found = [match.place is not None for match in matching.matches]
    for step in reversed(matching.steps):
        for arg in step.args if found[step.index] else ():
            found[arg] = True
    return found


def verdicts(matching: Matching) -> Iterator[Verdict]:
    """What is said of every step; what is missing, but was drawn somehow, is merely not to be seen."""
    for match, drawn in zip(matching.matches, rests(matching), strict=True):
        yield _verdict(matching, match, UNSEEN if match.state == MISSING and drawn else match.state)


def _verdict(matching: Matching, match: Match, state: str) -> Verdict:
    """The verdict on a trace, or on a mark that is not to be seen, but from which all that follows is: of those only a
    point is somewhere."""
    step, sheet, seen, chance = match.step, matching.sheet, match.place is not None, matching.rules.chance
    reason = explained(matching, match) if state == WRONG and seen and not match.mistake else None
    mistake = reason.mistake if reason else match.mistake
    guilty = reason.source.index if reason else step.index if state == WRONG else None
    found = Verdict(step.index, state, own=plain(match.expected), mistake=mistake.told if mistake else None,
                    kind=mistake.kind if mistake else "", guilty=guilty)
    if not seen and (not mistake or step.op.gives != POINT):
        return replace(found, off=math.inf, tolerance=math.inf, astray=math.inf) if mistake else found
    trace, true = None if match.place is None else matching.traces[match.place], sheet.drawing.values
    spots = sheet.spots(step.index, trace) if trace else [(x, y) for x, y in [plain(matching.own[step.index])]]
    residual = match.residual or sheet.residual(step, match.expected, spots, matching.own)
    return replace(found, off=residual.size, tolerance=residual.tolerance(chance), trace=trace,
                   astray=sheet.residual(step, true[step.index], spots, true).size,
                   ellipse=_ellipse(residual, step, chance) if trace else None)


def _ellipse(residual: Residual, step: Step, chance: float) -> Ellipse | None:
    """The tolerance of a point, if it has any two ways."""
    if step.op.gives != POINT or len(residual.off) < 2 or step.op.movement is Movement.BEGUN:
        return None
    variances, axes = np.linalg.eigh(residual.covariance)
    minor, major = (math.sqrt(max(variance, 0.0) * bound(2, chance)) for variance in variances)
    return Ellipse(major, minor, math.degrees(math.atan2(axes[1, 1], axes[0, 1])))
