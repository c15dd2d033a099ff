"""From the way through a drawing to what is said of it: every step with its deviation, its tolerance and its reason."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from graphplan.kernel.kinds import POINT
from graphplan.marking.judge.explain import explained
from graphplan.marking.judge.matching import Taken, Walk
from graphplan.marking.judge.student_sheet import bound, plain
from graphplan.marking.judge.verdict import MISSING, UNSEEN, WRONG, Ellipse, Verdict


def rests(walk: Walk) -> list[bool]:
    """For each step whether it is seen, or a mark that rests on it is: then it was drawn somehow."""
    found = [taken.place is not None for taken in walk.taken]
    for step in reversed(walk.steps):
        for arg in step.args if found[step.index] else ():
            found[arg] = True
    return found


def verdicts(walk: Walk) -> Iterator[Verdict]:
    """What is said of every step; what is missing, but was drawn somehow, is merely not to be seen."""
    for taken, drawn in zip(walk.taken, rests(walk), strict=True):
        state = UNSEEN if taken.state == MISSING and drawn else taken.state
        if taken.place is not None:
            yield _seen(walk, taken)
        elif taken.slip:
            yield _assumed(walk, taken)
        else:
            yield Verdict(taken.step.index, state, own=plain(taken.expected))


def _seen(walk: Walk, taken: Taken) -> Verdict:
    """The verdict on a trace."""
    assert taken.place is not None
    assert taken.deviation is not None
    step, deviation, chance = taken.step, taken.deviation, walk.rules.chance
    reason = explained(walk, taken) if taken.state == WRONG and not taken.slip else None
    slip = reason.slip if reason else taken.slip
    guilty = reason.source.index if reason else step.index if taken.state == WRONG else None
    return Verdict(
        step.index, taken.state, deviation.size, deviation.tolerance(chance), _astray(walk, taken),
        walk.traces[taken.place], plain(taken.expected), _ellipse(walk, taken),
        slip.told if slip else None, slip.kind if slip else "", guilty)


def _assumed(walk: Walk, taken: Taken) -> Verdict:
    """The verdict on a mark that is not to be seen, but from which all that follows is: only a point is somewhere."""
    assert taken.slip is not None
    step, board = taken.step, walk.board
    off = tolerance = astray = math.inf
    if step.op.gives == POINT:
        made = plain(walk.own[step.index])
        deviation = board.deviation(step, taken.expected, [(made[0], made[1])], walk.own)
        off, tolerance = deviation.size, deviation.tolerance(walk.rules.chance)
        astray = math.dist(made, board.drawing.values[step.index]) * board.mm(board.plan_of_step[step.index])
    return Verdict(step.index, WRONG, off, tolerance, astray, own=plain(taken.expected), mistake=taken.slip.told,
                   kind=taken.slip.kind, guilty=step.index)


def _astray(walk: Walk, taken: Taken) -> float:
    """How far a trace is from the true drawing, in mm."""
    assert taken.place is not None
    board, true = walk.board, walk.board.drawing.values
    spots = board.spots(taken.step.index, walk.traces[taken.place])
    return board.deviation(taken.step, true[taken.step.index], spots, true).size


def _ellipse(walk: Walk, taken: Taken) -> Ellipse | None:
    """The tolerance of a point, if it has any two ways."""
    deviation = taken.deviation
    if deviation is None or taken.step.op.gives != POINT or len(deviation.off) < 2 or taken.step.op.name == "begin":
        return None
    variances, axes = np.linalg.eigh(deviation.covariance)
    most = bound(2, walk.rules.chance)
    minor, major = (math.sqrt(max(variance, 0.0) * most) for variance in variances)
    return Ellipse(major, minor, math.degrees(math.atan2(axes[1, 1], axes[0, 1])))
