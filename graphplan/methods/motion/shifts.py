"""How a point or a line is shifted by a vector, which may lie on another plan."""

from __future__ import annotations

from graphplan.kernel.incidence import incident
from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.program import Board, Mark


def shift_mark(board: Board, mark: Mark, one: Mark, two: Mark) -> Mark:
    """A point or line shifted by the vector from one mark to another; nothing is drawn where they are one.

    The other mark may begin another plan: a point that is laid off from the one is laid off from the other.
    """
    if one is two:
        return mark
    if mark.kind == LINE:
        return board.shift(mark, one, two)
    if mark is one:
        return two
    return board.transfer(one, mark, two) if mark.panel == one.panel else board.transfer(one, two, mark)


def start_on(board: Board, line: Mark, here: Mark) -> Mark:
    """Where the vector is laid off by which a line is shifted: here, if that is on the line's plan, else at a point
    that the line was drawn through, else where its plan begins."""
    if here.panel == line.panel:
        return here
    through = [line.step.args[place] for place in incident(line.step.op)]
    begun = (step.index for step in board.steps if step.panel == line.panel and step.op.gives == POINT)
    return board.marks[through[0] if through else next(begun)]
