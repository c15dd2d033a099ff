"""How a point or a line is shifted by a vector, which may lie on another plan."""

from __future__ import annotations

from graphplan.kernel.incidence import incident
from graphplan.kernel.kinds import LINE, POINT, Movement
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
    return lay_vector(board, one, mark, two) if mark.panel == one.panel else lay_vector(board, one, two, mark)


def lay_vector(board: Board, P: Mark, Q: Mark, R: Mark) -> Mark:
    """The vector PQ laid off from R; one that drives prescribe, a_r, -ω²·AX and α·AX, in the scale of R's own plan, as
    a tenth of a millimetre on P's may be many there, and many here a tenth there."""
    normal, turned = P.step, Q.step
    if P.panel == R.panel:
        return board.transfer(P, Q, R)
    if turned.op.movement is Movement.LAID_ALONG and turned.args[1] == normal.index:
        line = board.marks[turned.args[0]]
        return board.lay_along(line, R, length=turned.params["length"], quantity=turned.quantity)
    if not (normal.quantity and normal.op.movement is Movement.LAID_OFF):
        return board.transfer(P, Q, R)
    A, X, base = (board.marks[index] for index in normal.args)
    turns = turned.quantity and turned.op.movement is Movement.TURNED and turned.args[2] == base.step.index
    if not (turns or Q is base):
        return board.transfer(P, Q, R)
    laid = board.step_off(X, A, R, ratio=normal.params["ratio"], quantity=normal.quantity)
    if not turns:
        return laid
    start, end, _ = (board.marks[index] for index in turned.args)
    return board.step_across(start, end, laid, ratio=turned.params["ratio"], quantity=turned.quantity)


def start_on(board: Board, line: Mark, here: Mark) -> Mark:
    """Where the vector is laid off by which a line is shifted: here, if that is on the line's plan, else at a point
    that the line was drawn through, else where its plan begins."""
    if here.panel == line.panel:
        return here
    through = [line.step.args[place] for place in incident(line.step.op)]
    begun = (step.index for step in board.steps if step.panel == line.panel and step.op.gives == POINT)
    return board.marks[through[0] if through else next(begun)]
