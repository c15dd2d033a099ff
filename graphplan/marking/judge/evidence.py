"""How much a mark that is found, or is not, speaks for a way through a drawing.

All weights are natural logarithms of odds: how much likelier what is seen is if the mark was drawn there than if it
was not.
"""

from __future__ import annotations

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.judge.student_sheet import Residual

THERE = {LINE: 5.0, CIRCLE: 2.5, POINT: 8.0}  # a mark of a picture where it should be; not many are there by chance
FAINT = {LINE: 2.5, CIRCLE: 2.0, POINT: 0.4}  # the same where it is seen only by seeking it
FILED = {LINE: 8.0, CIRCLE: 7.0, POINT: 10.0}  # a mark of a file, in which nothing is there by chance
GONE = {LINE: -4.0, CIRCLE: -3.0, POINT: -3.0}  # no mark, where one could be seen
SHARED = 0.0  # a mark that was drawn for another step
ASSUMED = -2.0  # a slip at a mark that is not to be seen itself
HALF, WHOLE = 0.4, 0.8  # the share of a stroke that is hardly there, and that is as good as all


def weighed(most: float, none: float, residual: Residual | None, share: float = 1.0) -> float:
    """The weight, from none to most, of a mark that is so far off, and of whose stroke a share is to be seen."""
    part = min(max((share - HALF) / (WHOLE - HALF), 0.0), 1.0)
    beyond = max(0.0, residual.square - len(residual.off)) / 2 if residual else 0.0
    return max(part * most + (1 - part) * none - beyond, none)
