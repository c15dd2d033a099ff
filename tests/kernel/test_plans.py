"""The plan is a part of a mark's kind: an operation draws on one plan, and takes only vectors from others."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random
from typing import Any

import pytest
from each import each
from figures import NAMES, drawn, figure

from graphplan.errors import GraphplanError
from graphplan.kernel import LINE, OPENING, POINT, TABLE, Board, Mark, Primitive
from graphplan.kernel.expand import Expander
from graphplan.kernel.numbers import Domain, Floats, Fractions
from graphplan.kernel.panel import PlansApart
from graphplan.kernel.passes import freeze, order_by_reasoning
from graphplan.kernel.program import Panel, evaluate

MECHANISM, N_PLAN = Panel("mechanism"), Panel("N-plan")
ALONG = Fraction(7, 4), Fraction(-11, 2)


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
    ordered, _ = order_by_reasoning(Expander(program, evaluate(program, Floats()), prefer="trial figure").run())
    picks = [step for step in ordered.steps if step.op.name == "pick"]
    assert picks
    assert {ordered.steps[arg].panel for step in picks for arg in step.args} == {N_PLAN}


# ---- what a record says of its operands ------------------------------------------------------------------------------


@each("name", [name for name in NAMES if TABLE[name].reads])
def test_it_is_drawn_among_what_is_near(name: str) -> None:
    """The operand on whose plan it is drawn is none of those that may be elsewhere; no operand is in two groups."""
    op = TABLE[name]
    places = [*op.same_plan_operands, *(place for group in op.afar for place in group)]
    assert op.where % len(op.reads) in op.same_plan_operands
    assert sorted(places) == list(range(len(op.reads)))


@each("name", [name for name in NAMES if TABLE[name].reads])
def test_only_lengths_and_directions_of_what_is_afar_count(name: str) -> None:
    """Where a vector, an opening or a figure lies on its plan changes nothing; with what is near the mark moves."""
    op, random, told = TABLE[name], Random(name), 0
    for _ in range(12):
        program = figure(name, random)
        for domain in (Fractions(), Floats()):
            values = drawn(program, domain)
            if values is None:
                continue
            step = program.steps[program.wanted[0]]
            read = [values[arg] for arg in step.args]
            for group in op.afar:
                assert_same(op, again(op, domain, step.params, read, group), values[step.index], (0, 0))
                told += 1
            if "group" not in op.params:  # which is known to close where it was
                assert_same(op, again(op, domain, step.params, read, op.same_plan_operands), values[step.index], ALONG)
                told += 1
            break
    assert told > 3 or "group" in op.params


def again(op: Primitive, domain: Domain, params: dict[str, Any], read: Sequence[Any], places: Sequence[int]) -> Any:
    """What an operation gives with some of its operands moved along."""
    args = [moved(op.reads[k], value, ALONG) if k in places else value for k, value in enumerate(read)]
    try:
        return domain.mask_refused(op.rule(domain, *args, **params))
    except GraphplanError:
        pytest.fail(f"{op.name} cannot be drawn when {places} are moved")


def moved(kind: str, value: Any, along: tuple[Any, Any]) -> Any:
    """A mark moved along, by its value."""
    dx, dy = along
    if kind == OPENING:
        return value
    if kind == LINE:
        a, b, c = value
        return a, b, c - a * dx - b * dy
    return value[0] + dx, value[1] + dy, *value[2:]


def assert_same(op: Primitive, value: Any, before: Any, along: tuple[Any, Any]) -> None:
    """The same mark but moved along: in fractions exactly, a root to nine digits."""
    truth = moved(op.gives, before, along)
    if all(isinstance(part, Fraction) for part in (*value, *truth)):
        assert value == truth
    else:
        assert [float(part) for part in value] == pytest.approx([float(part) for part in truth], rel=1e-9, abs=1e-9)
