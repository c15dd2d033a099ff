"""The form that suits the pose: on the sheet, with sharp crossings, in few movements, or as asked for."""

from __future__ import annotations

from collections import Counter

import pytest

from graphplan.errors import ConstructionError
from graphplan.kernel import Board, Mark, Program
from graphplan.kernel.expand import BY_SET_SQUARE, STRICT, Expander
from graphplan.kernel.form_board import FormBoard
from graphplan.kernel.kinds import TABLE, Choice
from graphplan.kernel.numbers import Floats
from graphplan.kernel.panel import Window
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import evaluate


def points(board: Board, **places: tuple[float, float]) -> list[Mark]:
    """Points of the pose by name."""
    return [board.given(x=x, y=y, name=name) for name, (x, y) in places.items()]


def link(tilt: float) -> Program:
    """A link ABC whose ends of A and B have loci: along KA and, turned from it by `tilt`, along LB."""
    board = Board()
    K, A, L, B, C, U, V = points(board, K=(0, 0), A=(0, 4), L=(6 + tilt, 0), B=(6, 4), C=(3, 8), U=(1, 3), V=(8, 1))
    alpha, beta = board.parallel(board.line(K, A), U), board.parallel(board.line(L, B), V)
    letters = {"Q": "Q", "q": "v_q"}
    return freeze(board, [board.carry(A, alpha, B, beta, C, turn="parallel", names=letters, name="gamma")])


def expanded(program: Program, **choices: object) -> Program:
    """The program drawn out."""
    return Expander(program, evaluate(program, Floats()), **choices).run()  # type: ignore[arg-type]


def chosen(program: Program) -> Choice:
    """The form of `carry` that was chosen, and why."""
    return next(step.choice for step in program.steps if step.choice and step.choice.compound.name == "carry")


def form(program: Program) -> str:
    """Which form of `carry` was chosen."""
    return chosen(program).best.form


def test_auxiliary_point_where_it_is_on_the_sheet() -> None:
    """The textbook's auxiliary point is drawn where it can be, with its letters."""
    drawing = expanded(link(4.0), windows={"": Window((4.0, 4.0), 20.0)})
    assert form(drawing) == "auxiliary point"
    assert {"Q", "v_q", "gamma"} <= {step.name for step in drawing.steps}


@pytest.mark.parametrize("tilt", [0.0, 1e-12, 1e-3, 0.5])
def test_trial_figures_where_it_is_off_the_sheet(tilt: float) -> None:
    """Where the auxiliary point is off the sheet, or nowhere, trial figures find the locus; the reason is told."""
    drawing = expanded(link(tilt), windows={"": Window((4.0, 4.0), 20.0)})
    assert "trial" in form(drawing)
    assert not any(step.name == "Q" for step in drawing.steps)


def test_flat_crossings_are_avoided() -> None:
    """On a sheet without edges, a flat crossing is left for a sharper one."""
    drawing = expanded(link(0.5))
    assert "trial" in form(drawing)


def test_preferred_form_is_drawn() -> None:
    """A form that is asked for by name is drawn wherever it can be."""
    sheet = {"": Window((4.0, 4.0), 20.0)}
    assert form(expanded(link(0.5), windows=sheet, prefer="auxiliary point")) == "auxiliary point"
    assert form(expanded(link(4.0), windows=sheet, prefer="two trial figures")).startswith("two trial figures")
    assert "trial" in form(expanded(link(0.0), windows=sheet, prefer="auxiliary point"))


@pytest.mark.parametrize(("v", "keep", "form"), [
    (0.5, BY_SET_SQUARE, "computed"), (4.0, BY_SET_SQUARE, "semicircle"), (12.0, BY_SET_SQUARE, "companion"),
    (16.0, BY_SET_SQUARE, "computed"), (0.5, STRICT, "semicircle"), (16.0, STRICT, "companion"),
])
def test_a_normal_acceleration_that_cannot_be_drawn_is_computed(v: float, keep: frozenset[str], form: str) -> None:
    """Where v²/r is next to nothing beside the plan, or longer than that, it is laid off as it is computed; but with
    compasses and straightedge alone it is constructed."""
    board = Board(coplanar=keep is STRICT)
    K, A, m, w, k = points(board, K=(0, 0), A=(10, 0), m=(3, 3), w=(3, 3 + v), k=(2, 9))
    program = freeze(board, [board.normal(K, A, m, w, k)])
    drawing = expanded(program, keep=keep, windows={"": Window((0.0, 0.0), 100.0, 20.0)})
    assert next(step.choice.best.form for step in drawing.steps if step.choice) == form


def test_reason_weighs_the_forms() -> None:
    """The first step of a form says what it cost, where it lies and how sharp it is, beside the others."""
    drawing = expanded(link(0.5), windows={"": Window((4.0, 4.0), 20.0)})
    reason = chosen(drawing).reason()
    assert "steps, on the sheet, flattest crossing" in reason
    assert " rather than " in reason
    assert "auxiliary point (" in reason
    assert "off the sheet" in reason


def test_law_stands_at_the_last_step() -> None:
    """What a compound is good for is told where it is done."""
    board = Board()
    A, B, C, D = points(board, A=(0, 0), B=(4, 0), C=(1, 3), D=(7, 7))
    program = freeze(board, [board.shift(board.line(A, B), C, D, why="the law", name="l")])
    drawing = expanded(program)
    assert [step.name for step in drawing.steps if step.why == "the law"] == ["l"]


def test_what_is_drawn_already_is_used() -> None:
    """The line of the link that a locus was made from serves for the auxiliary point, drawn out or not."""
    for keep in (BY_SET_SQUARE, STRICT):
        drawing = expanded(link(4.0), keep=keep, prefer="auxiliary point")
        Q = next(step for step in drawing.steps if step.name == "Q")
        assert [drawing.text(arg) for arg in Q.args] == ["KA", "LB"]


@pytest.mark.parametrize("keep", [BY_SET_SQUARE, STRICT], ids=["set squares", "strict"])
def test_trial_on_a_locus_that_runs_backwards(keep: frozenset[str]) -> None:
    """A trial point is picked where the program has it, though the locus drawn out runs the other way."""
    board = Board()
    K, A, L, B, C, U, V = points(board, K=(0, 0), A=(0, 4), L=(10, 0), B=(6, 4), C=(3, 8), U=(1, 3), V=(8, 1))
    alpha, beta = board.parallel(board.line(K, A), U), board.parallel(board.line(L, B), V)
    locus = board.carry(A, alpha, B, beta, C, turn="parallel")
    picked = [board.pick(locus, C, C, C, A, ratio=ratio, name=name) for ratio, name in ((0.3, "T"), (-0.4, "S"))]
    program = freeze(board, picked)
    truth = evaluate(program, Floats())
    for prefer in ("auxiliary point", "trial figure", "two trial figures"):
        expander = Expander(program, truth, keep, prefer=prefer)
        drawing = expander.run()
        for old, new in zip(program.wanted, drawing.wanted, strict=True):
            assert expander.values[new] == pytest.approx(truth[old], abs=1e-12)


def test_rivals_are_weighed_when_they_are_asked_for() -> None:
    """Steps are the same whether all forms are tried to their end or not; who asks for the others gets them all."""
    program = link(2.0)
    weighed, sooner = expanded(program, weigh=True), expanded(program)
    assert [(*step.key, step.name) for step in sooner.steps] == [(*step.key, step.name) for step in weighed.steps]
    assert len(chosen(weighed).rivals) > 2
    assert chosen(sooner).rivals == chosen(weighed).rivals


def test_guide_needs_another_point() -> None:
    """A perpendicular to a guide at its own point is erected over a point picked on it."""
    board = Board()
    A, B = points(board, A=(0, 0), B=(4, 1))
    program = freeze(board, [board.perpendicular(board.guide(A, dx=3, dy=4), A, name="n"), B])
    drawing = expanded(program, keep=STRICT)
    assert {"pick", "circle", "line"} <= {step.op.name for step in drawing.steps}
    assert all(step.op.name in STRICT for step in drawing.steps)


def test_what_cannot_be_drawn_out_stays_one_step() -> None:
    """Alone on the sheet, with nothing to take an opening from, the set square remains."""
    board = Board()
    (A,) = points(board, A=(0, 0))
    program = freeze(board, [board.perpendicular(board.guide(A, dx=3, dy=4), A)])
    assert [step.op.name for step in expanded(program, keep=STRICT).steps] == ["given", "guide", "perpendicular"]


def test_fault_while_drawing_names_the_step() -> None:
    """A program that cannot be drawn in the pose fails with the step's code and letters."""
    board = Board()
    A, B = points(board, A=(1, 1), B=(1, 1))
    program = freeze(board, [board.line(A, B)])
    with pytest.raises(ConstructionError, match="points-coincide at step 1"):
        Expander(program, [(1.0, 1.0), (1.0, 1.0), None]).run()


@pytest.mark.parametrize("gap", [0.0, 1e-13, 1e-9, 1e-7, 1e-4, 1.0])
@pytest.mark.parametrize("verb", ["perpendicular", "parallel"])
def test_point_all_but_on_the_line(verb: str, gap: float) -> None:
    """However close a point is to the line, perpendicular and parallel through it are drawn out well."""
    board = Board()
    A, B, P = points(board, A=(0, 0), B=(8, 2), P=(4, 1 + gap))
    program = freeze(board, [getattr(board, verb)(board.line(A, B), P)])
    truth = evaluate(program, Floats())
    expander = Expander(program, truth, STRICT, windows={"": Window((4.0, 1.0), 8.0)})
    drawing = expander.run()
    one, two = truth[-1], expander.values[drawing.wanted[0]]
    scale = (one[0] * two[0] + one[1] * two[1]) / (two[0] ** 2 + two[1] ** 2)
    assert scale > 0
    assert one == pytest.approx([scale * number for number in two], abs=1e-11)
    assert all(step.op.name in STRICT for step in drawing.steps)


def test_points_are_looked_up_as_they_stand() -> None:
    """The points of a plan and of its lines are those of the steps that stand, though many were taken back."""
    program = link(4.0)
    expander = Expander(program, evaluate(program, Floats()), STRICT, {"": Window((4.0, 4.0), 6.0)})
    expander.run()
    expander._rewind(len(expander.board.steps) * 2 // 3)
    steps, window = expander.board.steps, expander.windows[""]
    drawn = [step.index for step in steps if step.op.gives == "point"]
    for on_sheet in (True, False):
        assert [*expander.points.on_plan("", on_sheet)] == [
            point for point in drawn if window.holds(expander.values[point]) == on_sheet] != []
    on_lines = {step.index: [point for point in drawn if step.index in steps[point].args] for step in steps
                if step.op.gives == "line"}
    assert {line: [*expander.points.on_curve(line)] for line in on_lines} == on_lines
    assert any(on_lines.values())


@pytest.mark.parametrize("height", [3, -3])
@pytest.mark.parametrize("verb", ["parallel", "perpendicular"])
def test_of_two_sides_one_is_tried(verb: str, height: int) -> None:
    """Of forms that differ by a side alone nothing is drawn on that which the point's place rules out."""
    board = Board()
    A, B, P = points(board, A=(0, 0), B=(6, 0), P=(2, height))
    program = freeze(board, [board.line(A, B, name="l"), P])
    drawn = Counter[str]()
    for name, form in TABLE[verb].forms.items():
        if "left" in name or "right" in name:
            expander = Expander(program, evaluate(program, Floats()), STRICT)
            expander.run()
            before, marks = len(expander.board.steps), {mark.step.name: mark for mark in expander.board.marks}
            form(FormBoard(expander), marks["l"], marks["P"])
            drawn["left" if "left" in name else "right"] += len(expander.board.steps) - before
    assert len(drawn) == 2
    assert min(drawn.values()) == 0 < max(drawn.values())
