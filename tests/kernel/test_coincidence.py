"""What lies somewhere already is not drawn again: by construction in every pose, else in the pose that is drawn."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from graphplan.kernel.expand import Expander
from graphplan.kernel.numbers import Floats
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, Mark, Panel, Program, evaluate


def points(board: Board, **at: tuple[float, float]) -> list[Mark]:
    """Given points by name."""
    return [board.given(x=x, y=y, name=name) for name, (x, y) in at.items()]


def expanded(board: Board, *wanted: Mark) -> tuple[Expander, Program]:
    """The drawn program of some marks."""
    program = freeze(board, wanted)
    expander = Expander(program, evaluate(program, Floats()))
    return expander, expander.run()


def lines(program: Program) -> int:
    """How many lines are drawn."""
    return sum(step.op.gives == "line" for step in program.steps)


def test_a_parallel_through_a_point_of_a_line_is_that_line() -> None:
    """Whether the line was drawn through the point or the point marked on it, and by whatever line of its direction."""
    board = Board()
    A, B, C, D = points(board, A=(0, 0), B=(4, 1), C=(1, 3), D=(5, 6))
    AB, CD = board.line(A, B), board.line(C, D)
    along = board.parallel(AB, C)
    assert board.parallel(AB, B) is AB
    assert board.parallel(along, A) is AB
    assert board.parallel(AB, board.meet(along, CD)) is along
    assert board.perpendicular(along, A) is board.perpendicular(AB, A)
    assert board.perpendicular(board.perpendicular(AB, C), D) is not board.parallel(AB, D)  # it runs the other way


def test_what_is_taken_back_is_drawn_again() -> None:
    """A line that was taken back with a form lies nowhere any more, nor does what was marked on it."""
    board = Board()
    A, B, C = points(board, A=(0, 0), B=(4, 1), C=(1, 3))
    AB, AC = board.line(A, B), board.line(A, C)
    length = len(board.steps)
    tried = board.parallel(AB, C)
    X = board.meet(tried, board.parallel(AC, B))
    assert board.parallel(AB, X) is tried
    board.rewind(length)
    assert board.parallel(AB, C) is not tried
    assert len(board.steps) == length + 1


def test_a_vector_laid_off_and_back_leads_to_where_it_began() -> None:
    """By the same vector or one that is known to be equal; what is on another plan is another mark."""
    board = Board()
    A, B, C = points(board, A=(0, 0), B=(4, 1), C=(1, 3))
    with board.on(Panel("N-plan")):
        n = board.begin(plan=Panel("N-plan"))
    D = board.transfer(A, B, C)
    assert board.transfer(B, A, D) is C
    assert board.transfer(C, D, A) is B
    assert board.transfer(A, C, B) is D
    E = board.transfer(A, B, n)
    assert E is not D
    assert board.transfer(C, A, board.transfer(A, C, E)) is E


@pytest.mark.parametrize("seed", range(6))
def test_a_line_falls_on_one_that_lies_there(seed: int) -> None:
    """In the drawn pose the line that is there serves, whichever way it runs, and gives what a second one would; in
    other poses the rules know nothing of it."""
    random, board = Random(seed), Board()
    a, u, t = (complex(random.randint(-90, 90), random.randint(-90, 90)) for _ in range(3))
    places = {"A": a, "B": a + u, "C": a + 3 * u, "D": a - 2 * u, "E": a + t * (1 + abs(u) / 7)}
    A, B, C, D, E = points(board, **{name: (z.real, z.imag) for name, z in places.items()})
    AB, AE = board.line(A, B), board.line(A, E)
    arc = board.circle(D, board.opening(A, E))
    one = board.line_meets_circle(AB, arc, way="on")
    two = board.line_meets_circle(board.line(C, D), arc, way="on")  # it runs the other way
    three = board.meet(board.perpendicular(board.perpendicular(AB, E), C), AE)
    expander, drawn = expanded(board, one, two, three)
    assert lines(drawn) == 3  # AB, AE and the perpendicular on AB
    assert one.step.index != two.step.index
    program = freeze(board, [one, two, three])
    truth = evaluate(program, Floats())
    for index, mark in zip(drawn.wanted, program.wanted, strict=True):
        assert expander.values[index] == pytest.approx(truth[mark], rel=1e-9, abs=1e-7)
    c = np.array([7.5 - 40j])
    elsewhere = evaluate(program, Arrays(), {"C": {"x": c.real, "y": c.imag}})[program.wanted[1]]
    d = places["D"]
    found = elsewhere[0] + 1j * elsewhere[1] - d
    assert np.abs(found) == pytest.approx(abs(places["E"] - a), rel=1e-9)
    assert found / np.abs(found) == pytest.approx((d - c) / np.abs(d - c), rel=1e-9)  # further on from C to D


@pytest.mark.parametrize("gap", [Fraction(1, 10**9), Fraction(1, 10**5), 1])
def test_lines_that_are_only_near_are_two(gap: Fraction) -> None:
    """What differs by more than rounding is drawn, however near it lies; on another plan it is drawn anyway."""
    board = Board()
    A, B, C = points(board, A=(0, 0), B=(40, 10), C=(80, 20 + float(gap)))
    _, drawn = expanded(board, board.line(A, B), board.line(A, C))
    assert lines(drawn) == 2


def test_lines_whose_crossing_is_wanted_are_drawn_apart() -> None:
    """A line that falls on another but for what is near rounding is drawn nevertheless, where the two, carried over,
    must cross: far away as that is, it is where the program has it, and again if it is asked for again."""
    board = Board()
    A, B, C, O = points(board, A=(30, 40), B=(130, 90 + 1e-11), C=(230, 140), O=(0, 0))
    BC, AB = board.line(B, C), board.line(A, B)
    expander, drawn = expanded(board, board.meet(BC, board.parallel(AB, O)))
    assert (lines(expanded(board, BC, AB)[1]), lines(drawn)) == (1, 3)
    for program in (drawn, expander.run()):
        assert expander.values[program.wanted[0]] == pytest.approx(expander.truth[-1], rel=1e-6)


def test_plans_do_not_share_lines() -> None:
    """Two plans, or two parts of one, may begin at one place in numbers: on paper they lie apart."""
    board = Board()
    A, B = points(board, A=(0, 0), B=(40, 10))
    AB, plan = board.line(A, B), Panel("N-plan")
    with board.on(plan):
        one, two = board.begin(plan=plan), board.begin(plan=plan.numbered_part(2))
    _, drawn = expanded(board, AB, board.parallel(AB, one), board.parallel(AB, two))
    assert lines(drawn) == 3
