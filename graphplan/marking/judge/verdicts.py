"""From the way through a drawing to what is said of it: every step with its deviation, its tolerance and its reason."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from graphplan.kernel.kinds import POINT, Movement
from graphplan.marking.judge.explain import explained
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.student_sheet import bound, plain
from graphplan.marking.judge.verdict import MISSING, UNSEEN, WRONG, Ellipse, Verdict


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
        state = UNSEEN if match.state == MISSING and drawn else match.state
        if match.place is not None:
            yield _seen(matching, match)
        elif match.mistake:
            yield _assumed(matching, match)
        else:
            yield Verdict(match.step.index, state, own=plain(match.expected))


def _seen(matching: Matching, match: Match) -> Verdict:
    """The verdict on a trace."""
    assert match.place is not None
    assert match.residual is not None
    step, residual, chance = match.step, match.residual, matching.rules.chance
    reason = explained(matching, match) if match.state == WRONG and not match.mistake else None
    mistake = reason.mistake if reason else match.mistake
    guilty = reason.source.index if reason else step.index if match.state == WRONG else None
    return Verdict(
        step.index, match.state, residual.size, residual.tolerance(chance), _astray(matching, match),
        matching.traces[match.place], plain(match.expected), _ellipse(matching, match),
        mistake.told if mistake else None, mistake.kind if mistake else "", guilty)


def _assumed(matching: Matching, match: Match) -> Verdict:
    """The verdict on a mark that is not to be seen, but from which all that follows is: only a point is somewhere."""
    assert match.mistake is not None
    step, sheet = match.step, matching.sheet
    off = tolerance = astray = math.inf
    if step.op.gives == POINT:
        made = plain(matching.own[step.index])
        residual = sheet.residual(step, match.expected, [(made[0], made[1])], matching.own)
        off, tolerance = residual.size, residual.tolerance(matching.rules.chance)
        astray = math.dist(made, sheet.drawing.values[step.index]) * sheet.mm(sheet.plan_of_step[step.index])
    return Verdict(step.index, WRONG, off, tolerance, astray, own=plain(match.expected), mistake=match.mistake.told,
                   kind=match.mistake.kind, guilty=step.index)


def _astray(matching: Matching, match: Match) -> float:
    """How far a trace is from the true drawing, in mm."""
    assert match.place is not None
    sheet, true = matching.sheet, matching.sheet.drawing.values
    spots = sheet.spots(match.step.index, matching.traces[match.place])
    return sheet.residual(match.step, true[match.step.index], spots, true).size


def _ellipse(matching: Matching, match: Match) -> Ellipse | None:
    """The tolerance of a point, if it has any two ways."""
    residual = match.residual
    op = match.step.op
    if residual is None or op.gives != POINT or len(residual.off) < 2 or op.movement is Movement.BEGUN:
        return None
    variances, axes = np.linalg.eigh(residual.covariance)
    most = bound(2, matching.rules.chance)
    minor, major = (math.sqrt(max(variance, 0.0) * most) for variance in variances)
    return Ellipse(major, minor, math.degrees(math.atan2(axes[1, 1], axes[0, 1])))
