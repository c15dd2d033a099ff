"""Lemoine's counts, on elementary constructions."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from graphplan.kernel import Board, Mark
from graphplan.kernel.expand import STRICT, Expander
from graphplan.kernel.kinds import SCALE, TABLE
from graphplan.kernel.lemoine import Counts, counts
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import evaluate

Draw = Callable[[Board, Mark, Mark, Mark], Mark]

ELEMENTARY: list[tuple[str, Draw, str]] = [
    ("the line through two points", lambda b, A, B, C: b.line(A, B), "2 R1 + 1 R2: simplicity 3, exactitude 2"),
    ("a circle about A through B", lambda b, A, B, C: b.circle(A, b.opening(A, B)),
     "2 C1 + 1 C3: simplicity 3, exactitude 2"),
    ("a circle about C as large as AB", lambda b, A, B, C: b.circle(C, b.opening(A, B)),
     "3 C1 + 1 C3: simplicity 4, exactitude 3"),
    ("the bisector of two points", lambda b, A, B, C: b.bisector(A, B),
     "2 R1 + 1 R2 + 3 C1 + 2 C3: simplicity 8, exactitude 5"),
]


@pytest.mark.parametrize(("draw", "told"), [case[1:] for case in ELEMENTARY], ids=[case[0] for case in ELEMENTARY])
def test_elementary_counts(draw: Draw, told: str) -> None:
    """Elementary constructions cost what Lemoine's rules make of them."""
    board = Board()
    A, B, C = (board.given(x=x, y=y) for x, y in ((0, 0), (4, 0), (1, 3)))
    program = freeze(board, [draw(board, A, B, C)])
    strict = Expander(program, evaluate(program, Floats()), STRICT).run()
    assert counts(strict).text == told


def test_compasses_keep_their_opening() -> None:
    """A second circle with the same opening needs only its centre; another opening has to be taken again."""
    board = Board()
    A, B, C = (board.given(x=x, y=y) for x, y in ((0, 0), (4, 0), (1, 3)))
    o, p = board.opening(A, B), board.opening(B, C)
    circles = [board.circle(C, p), board.circle(A, o), board.circle(C, o)]
    assert counts(freeze(board, circles)) == Counts(C1=2 + 2 + 0 + 2 + 0 + 1, C3=3)


def test_undetermined_point_of_a_line_counts_apart() -> None:
    """The compasses set on a point picked anywhere on a line count C2, once."""
    board = Board()
    A, B = (board.given(x=x, y=0) for x in (0, 4))
    X = board.pick(board.line(A, B), A, A, A, B, ratio=2)
    o = board.opening(X, A)
    found = counts(freeze(board, [board.circle(X, o), board.circle(B, o), board.circle(X, board.opening(X, B))]))
    assert (found.C2, found.C3) == (1, 3)


def test_scale_work_is_counted_apart() -> None:
    """Lengths laid off by the scale are outside Lemoine's system."""
    board = Board()
    A, B = (board.given(x=x, y=0) for x in (0, 4))
    found = counts(freeze(board, [board.line(A, board.step_off(A, B, B, ratio=2))]))
    assert found.text == "2 R1 + 1 R2: simplicity 3, exactitude 2, by the scale 1"


def test_set_squares_are_counted_plainly() -> None:
    """With set squares a construction has no simplicity, only a number of operations."""
    board = Board()
    A, B, C = (board.given(x=x, y=y) for x, y in ((0, 0), (4, 0), (1, 3)))
    l = board.line(A, B)
    found = counts(freeze(board, [board.meet(board.parallel(l, C), board.perpendicular(l, B))]))
    assert not found.strict
    assert found.text == "3 operations: lines 1, arcs 0, by set squares 2"


def test_what_no_form_draws_is_counted_by_its_instrument() -> None:
    """A compound that stays one step, as no form of it serves in a pose, is told with its instrument whatever that is.
    """
    for instrument in {op.instrument for op in TABLE.values() if op.compound} - {SCALE}:
        assert str(Counts(others={instrument: 3}).text).endswith(" 3")
