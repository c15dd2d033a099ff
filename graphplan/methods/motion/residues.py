"""Residues: which directions and lines can coincide whatever the pose, told by numbers in a finite field.

A pose's coordinates become residues; what is zero in the pose is zero here, and chance makes nothing else so.
"""

from __future__ import annotations

from fractions import Fraction

from graphplan.kernel.elementary import incident
from graphplan.kernel.kinds import LINE, POINT, Movement
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.equations import PRIME
from graphplan.mechanism.model import Number, Pair

Two = tuple[int, int]
Triple = tuple[int, int, int]


def residue(number: Number) -> int:
    """A number of the scene; rounded ones as the binary fractions that they are."""
    exact = number if isinstance(number, Fraction) else Fraction(float(number))
    return exact.numerator * pow(exact.denominator, -1, PRIME) % PRIME


def residues(pair: Pair) -> Two:
    """A point or vector of the scene."""
    return residue(pair[0]), residue(pair[1])


def cross(p: Triple, q: Triple) -> Triple:
    """The line through two points, or the point of two lines."""
    return ((p[1] * q[2] - p[2] * q[1]) % PRIME, (p[2] * q[0] - p[0] * q[2]) % PRIME,
            (p[0] * q[1] - p[1] * q[0]) % PRIME)


def dot(p: Triple, q: Triple) -> int:
    """Whether a point lies on a line: then it is nothing."""
    return sum(a * b for a, b in zip(p, q, strict=True)) % PRIME


def difference(p: Two, q: Two) -> Two:
    """The vector from q to p."""
    return (p[0] - q[0]) % PRIME, (p[1] - q[1]) % PRIME


def product(p: Two, q: Two) -> int:
    """The inner product of two vectors."""
    return (p[0] * q[0] + p[1] * q[1]) % PRIME


def quarter(p: Two) -> Two:
    """A vector turned a quarter."""
    return -p[1] % PRIME, p[0]


def parallel(p: Two, q: Two) -> bool:
    """Whether two vectors are parallel, or one is nothing."""
    return not product(p, quarter(q))


def line(normal: Two, at: Two) -> Triple:
    """The line through a point, square to a normal."""
    return *normal, -product(normal, at) % PRIME


def meet(k: Triple, l: Triple) -> Two | None:
    """The point of two lines; None where they are parallel."""
    x, y, w = cross(k, l)
    if not w:
        return None
    inverse = pow(w, -1, PRIME)
    return x * inverse % PRIME, y * inverse % PRIME


class Image:
    """What is known of a body's image X -> t + s X: how many independent conditions on t and s have been entered."""

    def __init__(self) -> None:
        self._rows: list[Triple] = []

    @property
    def rank(self) -> int:
        """The number of independent conditions: three tell the whole image."""
        return len(self._rows)

    def locus(self, normal: Two, at: Two) -> None:
        """The end of a point lies on a line with this normal."""
        self._enter((*normal, product(normal, at)))

    def end(self, at: Two) -> None:
        """The end of a point is known."""
        self._enter((1, 0, at[0]))
        self._enter((0, 1, at[1]))

    def turning(self) -> None:
        """The turning is known."""
        self._enter((0, 0, 1))

    def _enter(self, row: Triple) -> None:
        """Keep a condition that the others do not say."""
        match self._rows:
            case []:
                new = any(row)
            case [one]:
                new = any(cross(one, row))
            case [one, two]:
                new = dot(cross(one, two), row) != 0
            case _:
                new = False
        if new:
            self._rows.append(row)


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
