"""The board records, the program is frozen and checks itself, pruning leaves the marks where they are."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest
from each import each
from figures import NAMES, drawn, figure
from hypothesis import given, settings
from hypothesis import strategies as st

from graphplan.kernel import TABLE, Board, Mark, Program
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze, order_by_reasoning, prune
from graphplan.kernel.program import Panel, evaluate


def triangle() -> tuple[Board, list[Mark]]:
    """A board with three points of the pose."""
    board = Board()
    places = {"A": (0, 0), "B": (4, 0), "C": (1, 3)}
    return board, [board.given(x=x, y=y, name=name) for name, (x, y) in places.items()]


def scribble(r: Random) -> tuple[Board, list[Mark]]:
    """Points, lines and crossings drawn at random, each from what is there."""
    board, points = triangle()
    lines: list[Mark] = []
    for _ in range(12):
        P, Q = r.sample(points, 2)
        lines.append(board.line(P, Q) if not lines or r.random() < 0.6 else board.parallel(r.choice(lines), P))
        points.append(board.quarter(P, Q, r.choice(points)) if r.random() < 0.5 else board.foot(r.choice(lines), Q))
    return board, points + lines


@settings(max_examples=14, deadline=None)
@given(st.randoms(use_true_random=False))
def test_pruning_moves_no_mark(r: Random) -> None:
    """What nothing needs is left out; the wanted marks have the same values, and pruning again changes nothing."""
    board, marks = scribble(r)
    whole = Program(tuple(board.steps), tuple(mark.step.index for mark in r.sample(marks, 3)))
    short = prune(whole)
    all_values, values = drawn(whole, Floats()), drawn(short, Floats())
    if all_values is not None:
        assert values is not None
        assert [all_values[k] for k in whole.wanted] == [values[k] for k in short.wanted]
    assert len(short) <= len(whole)
    assert [step.key for step in prune(short).steps] == [step.key for step in short.steps]


@settings(max_examples=14, deadline=None)
@given(st.randoms(use_true_random=False))
def test_gathering_changes_only_the_order(r: Random) -> None:
    """Steps gathered plan by plan are the same steps, each after what it reads."""
    board, marks = scribble(r)
    program = freeze(board, r.sample(marks, 3))
    ordered, places = order_by_reasoning(program)
    assert sorted(places) == list(range(len(program)))
    assert [program.steps[k].op for k in places] == [step.op for step in ordered.steps]
    assert [places[k] for k in ordered.wanted] == list(program.wanted)


ASKED: list[Callable[[Mark], object]] = [
    bool, float, lambda mark: mark == mark, lambda mark: mark != 0, lambda mark: mark < mark, lambda mark: mark >= 1,
]


@each("ask", ASKED)
def test_mark_refuses_to_be_a_number(ask: Callable[[Mark], object]) -> None:
    """A recipe cannot branch on coordinates: a mark has no truth, no size and no equal."""
    _, (A, *_) = triangle()
    with pytest.raises(TypeError, match="branch on the scene"):
        ask(A)


def test_names_are_unique() -> None:
    """A name that is taken gets a prime, and a mark keeps its first name."""
    board, (A, B, C) = triangle()
    one, two = board.midpoint(A, B, name="M"), board.midpoint(A, C, name="M")
    assert [mark.step.name for mark in (one, two, board.give_name(one, "N"))] == ["M", "M'", "M"]


def test_same_drawing_is_drawn_once() -> None:
    """The same operation on the same marks is one step; it may get its name the second time."""
    board, (A, B, C) = triangle()
    first = board.line(A, B)
    assert board.line(A, B, name="l") is first
    assert first.step.name == "l"
    assert board.line(B, A) is not first
    assert board.side(A, B) is board.side(B, A)
    assert board.step_off(A, B, C, ratio=2) is board.step_off(A, B, C, ratio=Fraction(2))


def test_coincident_points_of_the_pose_stay_apart() -> None:
    """Two points of the pose in one place are two marks."""
    board = Board()
    assert board.given(x=0, y=0, name="A2") is not board.given(x=0, y=0, name="A3")


def test_rewind_takes_back_what_was_tried() -> None:
    """After a rewind the board is as before: steps, names and what counts as drawn."""
    board, (A, B, C) = triangle()
    before = list(board.steps)
    tried = board.midpoint(A, B, name="M")
    board.rewind(3)
    assert board.steps == before
    again = board.midpoint(A, B, name="M")
    assert again is not tried
    assert (again.step.index, again.step.name) == (3, "M")
    assert board.midpoint(B, C, name="M").step.name == "M'"


def test_steps_are_drawn_where_their_operand_is() -> None:
    """A step stands on the plan of the mark that it is drawn at, and speaks of the links in question."""
    board, (A, B, C) = triangle()
    with board.on("N-plan", ("3",)):
        o = board.begin(plan=Panel("N-plan"))
        assert board.transfer(A, B, o).step.panel == "N-plan"
        assert board.midpoint(A, B).step.panel == ""
        assert board.midpoint(A, C).step.links == ("3",)
    assert board.line(A, C).step.links == ()


def _wrong_kind(board: Board, A: Mark, B: Mark) -> Mark:
    return board.meet(A, B)


def _wrong_params(board: Board, A: Mark, B: Mark) -> Mark:
    return board.step_off(A, B, A, factor=2)


def _other_board(board: Board, A: Mark, B: Mark) -> Mark:
    return board.line(A, triangle()[1][0])


def _no_such(board: Board, A: Mark, B: Mark) -> Mark:
    return board.trisect(A, B)


WRONG = [(_wrong_kind, TypeError, "meet reads"), (_wrong_params, TypeError, "step_off takes"),
         (_other_board, ValueError, "another board"), (_no_such, AttributeError, "trisect")]


@each(("use", "error", "words"), WRONG)
def test_misuse_is_refused(use: Callable[[Board, Mark, Mark], Mark], error: type[Exception], words: str) -> None:
    """What the table does not allow is refused at once, and nothing is drawn."""
    board, (A, B, _) = triangle()
    with pytest.raises(error, match=words):
        use(board, A, B)
    assert len(board.steps) == 3


def _frozen() -> Program:
    board, (A, B, C) = triangle()
    return freeze(board, [board.foot(board.line(A, B, name="l"), C, name="F")])


FAULTS: list[tuple[str, Callable[[Program], object]]] = [
    ("stands at place", lambda p: Program((p.steps[1], p.steps[0], *p.steps[2:]), p.wanted)),
    ("not drawn yet", lambda p: Program((*p.steps[:4], replace(p.steps[4], args=(3, 4))), p.wanted)),
    ("not drawn yet", lambda p: Program((*p.steps[:4], replace(p.steps[4], args=(-2, 2))), p.wanted)),
    ("foot reads", lambda p: Program((*p.steps[:4], replace(p.steps[4], args=(2, 2))), p.wanted)),
    ("bound twice", lambda p: Program((*p.steps[:4], replace(p.steps[4], name="A")), p.wanted)),
    ("come first", lambda p: Program((*p.steps, replace(p.steps[0], index=5, name="D")), p.wanted)),
    ("not all drawn", lambda p: Program(p.steps, (5,))),
]


@each(("words", "spoil"), FAULTS)
def test_program_checks_itself(words: str, spoil: Callable[[Program], object]) -> None:
    """A frozen program refuses steps out of order, wrong kinds, and names bound twice."""
    with pytest.raises(ValueError, match=words):
        spoil(_frozen())


def test_steps_are_numbered_without_the_pose() -> None:
    """The pose's points have no printed number; sentences speak in the letters of the sheet."""
    program = _frozen()
    assert [program.number(k) for k in (3, 4)] == [1, 2]
    assert program.sentence(4) == "From C drop the perpendicular on l: mark its foot F."


@each("name", NAMES)
def test_every_step_is_spoken(name: str) -> None:
    """Each primitive's sentence can be said of a step, in letters and numbers only."""
    program = figure(name, Random(name))
    sentence = program.sentence(len(program) - 1)
    assert sentence.endswith(".")
    assert "{" not in sentence
    assert "Fraction" not in sentence


def test_error_names_the_step() -> None:
    """A step that cannot be drawn is told with code, number, drawing, reason and what to do."""
    board, (A, B, C) = triangle()
    l = board.line(A, B)
    program = freeze(board, [board.meet(l, board.parallel(l, C), name="Q")])
    with pytest.raises(Exception, match=r"lines-parallel at step 3, Q, .*AB.* are parallel. Do: "):
        evaluate(program, Floats())


def test_table_is_the_board() -> None:
    """The board's verbs are the table's primitives."""
    assert all(callable(getattr(Board(), name)) for name in TABLE)
