"""The board records, plans are kept apart, what lies there already is not drawn again; a program checks itself.

The plan is a part of a mark's kind: an operation draws on one plan, and takes only vectors from others. What is drawn
already serves again: by construction in every pose, else in the pose that is drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from each import each
from figures import NAMES, drawn
from hypothesis import given, settings
from hypothesis import strategies as st

from graphplan.kernel import LINE, OPENING, POINT, TABLE, Board, Mark, Program
from graphplan.kernel.expand import Expander
from graphplan.kernel.numbers import Floats
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.passes import freeze, prune
from graphplan.kernel.program import Panel, PlansApart, evaluate
from graphplan.kernel.reasoning import order_by_reasoning

MECHANISM, N_PLAN = Panel("mechanism"), Panel("N-plan")


def points(board: Board, **at: tuple[float, float]) -> list[Mark]:
    """Points of the pose by name."""
    return [board.given(x=x, y=y, name=name) for name, (x, y) in at.items()]


# ---- a board and its program -----------------------------------------------------------------------------------------


def triangle() -> tuple[Board, list[Mark]]:
    """A board with three points of the pose."""
    board = Board()
    return board, points(board, A=(0, 0), B=(4, 0), C=(1, 3))


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
    ordered, places = order_by_reasoning(program, range(len(program)))
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


def test_error_names_the_step() -> None:
    """A step that cannot be drawn is told with code, number, drawing, reason and what to do."""
    board, (A, B, C) = triangle()
    l = board.line(A, B)
    program = freeze(board, [board.meet(l, board.parallel(l, C), name="Q")])
    with pytest.raises(Exception, match=r"lines-parallel at step 3, Q, .*AB.* are parallel. Do: "):
        evaluate(program, Floats())


# ---- plans -----------------------------------------------------------------------------------------------------------


def two_plans() -> tuple[Board, list[Mark], list[Mark]]:
    """A board with three points of the mechanism, and three of the N-plan."""
    board = Board()
    with board.on(MECHANISM):
        there = [board.given(x=x, y=y, name=name) for name, x, y in (("A", 0, 0), ("B", 4, 0), ("C", 1, 3))]
    with board.on(N_PLAN):
        o = board.begin(plan=N_PLAN, name="o")
    here = [o, board.lay_off(o, dx=2, dy=5, name="p"), board.lay_off(o, dx=-1, dy=6, name="q")]
    return board, there, here


def test_a_foot_across_plans_is_not_recorded() -> None:
    """The error names the operation, the marks and their plans, and the board is as it was."""
    board, (A, *_), (o, p, _) = two_plans()
    line = board.line(o, p, name="l")
    before = list(board.steps)
    with pytest.raises(PlansApart, match=r"^foot .*l on N-plan, A on mechanism"):
        board.foot(line, A)
    assert board.steps == before


@each("name", [name for name in NAMES if len(TABLE[name].same_plan_operands) > 1])
def test_what_is_joined_lies_on_one_plan(name: str) -> None:
    """Whatever operation: with one of the operands that it joins on another plan it is not recorded."""
    board, there, here = two_plans()
    op = TABLE[name]
    other = next(place for place in op.same_plan_operands if place != op.where % len(op.reads))
    args = [mark_of(board, kind, there if place == other else here) for place, kind in enumerate(op.reads)]
    params: dict[str, Any] = dict.fromkeys(op.params, 1)
    with pytest.raises(PlansApart, match=f"^{name} "):
        board.draw(op, tuple(args), **params)


@each("name", [name for name in NAMES if any(len(group) > 1 for group in TABLE[name].afar)])
def test_a_vector_has_both_ends_on_one_plan(name: str) -> None:
    """A vector, or a figure of which only lengths and directions count, is not taken from two plans."""
    board, there, here = two_plans()
    op = TABLE[name]
    other = next(group for group in op.afar if len(group) > 1)[-1]
    args = [mark_of(board, kind, there if place == other else here) for place, kind in enumerate(op.reads)]
    params: dict[str, Any] = dict.fromkeys(op.params, 1)
    with pytest.raises(PlansApart, match=f"^{name} "):
        board.draw(op, tuple(args), **params)


def mark_of(board: Board, kind: str, points: Sequence[Mark]) -> Mark:
    """A mark of a kind on the plan of some points."""
    A, B, C = points
    if kind == POINT:
        return C
    if kind == LINE:
        return board.line(A, B)
    opening = board.opening(A, B)
    return opening if kind == OPENING else board.circle(C, opening)


def test_vectors_openings_and_directions_go_over() -> None:
    """What is laid off, struck or drawn parallel lies on the plan of the point where it begins."""
    board, (A, B, C), (o, p, _) = two_plans()
    marks = [board.transfer(A, B, o), board.quarter(A, B, o), board.parallel(board.line(A, B), o),
             board.circle(o, board.opening(A, B)), board.lay_along(board.line(A, B), o, length=3),
             board.similar(A, B, C, o, p, turn="parallel"), board.normal(A, B, A, C, o)]
    assert {str(mark.step.panel) for mark in marks} == {"N-plan"}


def test_parts_of_a_plan_are_plans_of_their_own() -> None:
    """A plan that is begun at two places has two parts, and no line joins them."""
    board, _, (o, *_) = two_plans()
    part = N_PLAN.numbered_part(2)
    with board.on(N_PLAN):
        o2 = board.begin(plan=part, name="o2")
    assert (o2.step.panel, o2.step.panel.whole) == ("N-plan, part 2", "N-plan")
    assert board.transfer(o, o, o2).step.panel == part
    with pytest.raises(PlansApart, match="part 2"):
        board.line(o, o2)


def test_where_all_plans_lie_as_one_any_marks_are_joined() -> None:
    """Compasses and straightedge alone carry no direction over: their plans lie on one another, and are one."""
    board = Board(coplanar=True)
    with board.on(MECHANISM):
        A = board.given(x=3, y=1, name="A")
    o = board.begin(plan=N_PLAN, name="o")
    assert board.line(A, o).step.op is TABLE["line"]


def test_a_line_is_shifted_from_a_point_of_its_own_plan() -> None:
    """By a vector of the mechanism a line of the N-plan is shifted from a point that it was drawn through."""
    board, (_, B, C), (o, p, _) = two_plans()
    moved = board.shift(board.line(o, p), B, C)
    program = freeze(board, [moved])
    expander = Expander(program, evaluate(program, Floats()))
    there = [step.op.name for step in expander.run().steps if step.panel == N_PLAN]
    assert there == ["begin", "lay_off", "line", "transfer", "parallel"]
    assert expander.values[-1] == evaluate(program, Floats())[-1]


def test_a_trial_figure_begins_on_the_plan_of_its_locus() -> None:
    """Its first corner is picked from what is drawn there, not from where the link lies on the mechanism plan."""
    board, (A, B, C), (o, p, q) = two_plans()
    locus = board.carry(A, board.line(o, p), B, board.line(o, q), C, turn="perpendicular")
    program = freeze(board, [locus])
    expander = Expander(program, evaluate(program, Floats()), prefer=lambda panel: "trial figure")
    ordered, _ = order_by_reasoning(expander.run(), expander.serves)
    picks = [step for step in ordered.steps if step.op.name == "pick"]
    assert picks
    assert {ordered.steps[arg].panel for step in picks for arg in step.args} == {N_PLAN}


# ---- what lies there already -----------------------------------------------------------------------------------------


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
