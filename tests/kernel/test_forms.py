"""However a compound is drawn, it is the value of its rule; the form that suits the pose is chosen; operations counted.

A form serves on the sheet, with sharp crossings, in few movements, or as it is asked for; with set squares, or with
compasses and straightedge alone, where Lemoine's counts hold.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache
from itertools import chain
from random import Random
from typing import Any

import pytest
from each import each
from figures import COMPOUNDS, Place, corners, drawn, figure, quarters, size

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel import FAILURES, LINE, TABLE, Board, Mark, Program
from graphplan.kernel.claims import broken_claims
from graphplan.kernel.expand import BY_SET_SQUARE, STRICT, Expander, FormBoard
from graphplan.kernel.images import Attitude, Closure, Hinge, PlacedPin
from graphplan.kernel.kinds import SCALE
from graphplan.kernel.lemoine import Counts, counts
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze, prune
from graphplan.kernel.program import Panel, Window, evaluate

# ---- each form draws the value ---------------------------------------------------------------------------------------


FORMS = [(name, form) for name in COMPOUNDS for form in TABLE[name].forms]
KEEPS = {"all but itself": frozenset(TABLE), "set squares": BY_SET_SQUARE, "strict": STRICT}


@cache
def tried(name: str, place: Place) -> tuple[Random, list[tuple[Program, list[Any] | None]]]:
    """The figures that were asked for, with their values, and the chance that makes more of them."""
    return Random(name), []


def figures(name: str, place: Place, number: int) -> Iterator[tuple[Program, list[Any]]]:
    """Those of so many figures that can be drawn."""
    r, known = tried(name, place)
    for k in range(number):
        if k == len(known):
            known.append((program := figure(name, r, place), drawn(program, Floats())))
        program, values = known[k]
        if values is not None:
            yield program, values


def same(kind: str, one: Any, two: Any, reach: float) -> bool:
    """Whether two values are one thing; a line may run either way."""
    if kind != LINE:
        return all(abs(p - q) < 1e-8 * reach for p, q in zip(one, two, strict=True))
    (a, b, c), (d, e, _) = one, two
    scale = (a * d + b * e) / (d * d + e * e)
    return all(abs(p - scale * q) < 1e-8 * max(reach, abs(c)) for p, q in zip(one, two, strict=True))


def wide(program: Program, values: list[Any]) -> dict[str, Window]:
    """A plan without an edge that is as wide as a figure."""
    return {"": Window((0.0, 0.0), math.inf, size(program, values))}


def laid_out(program: Program, values: list[Any], name: str) -> tuple[Expander, tuple[Mark, ...]]:
    """The operands of the last step, drawn."""
    expander = Expander(program, values, frozenset(TABLE) - {name}, wide(program, values))
    marks: list[Mark] = []
    for step in program.steps[:-1]:
        marks.append(expander.draw(step.op, tuple(marks[arg] for arg in step.args), step.params))
    return expander, tuple(marks[arg] for arg in program.steps[-1].args)


@cache
def drawable(name: str) -> set[str]:
    """The forms that can be drawn of some figure."""
    found = set[str]()
    for program, values in chain(figures(name, quarters, 25), figures(name, corners, 120)):
        expander, marks = laid_out(program, values, name)
        op, params = TABLE[name], program.steps[-1].params
        value = op.rule(Floats(), *map(expander.value, marks), **params)
        found |= {form for form in op.forms if expander.attempt(op, marks, params, value, form)}
        if found >= {*TABLE[name].forms}:
            break
    return found


@each(("name", "form"), FORMS)
def test_form_draws_the_value(name: str, form: str) -> None:
    """Asked for by name, a form gives the rule's value; it is one of those that can be drawn in some pose."""
    for program, values in [*figures(name, quarters, 7), *figures(name, corners, 33)]:
        expander = Expander(program, values, frozenset(TABLE) - {name}, wide(program, values), prefer=everywhere(form))
        expanded = expander.run()
        out = program.wanted[0]
        reach = 50 * size(program, values)
        assert same(program.steps[out].op.gives, values[out], expander.values[expanded.wanted[0]], reach)
    assert form in drawable(name)


@each(("name", "form"), FORMS)
def test_form_fails_cleanly(name: str, form: str) -> None:
    """Where a form cannot be drawn it gives nothing or a declared code: never another error."""
    for program, values in figures(name, corners, 40):
        expander, marks = laid_out(program, values, name)
        try:
            TABLE[name].forms[form](FormBoard(expander), *marks, **program.steps[-1].params)
        except Undrawable as fault:
            assert fault.code in FAILURES


@pytest.mark.costly
@each("keep", KEEPS)
@each("name", COMPOUNDS)
def test_expansion_keeps_values_and_claims(name: str, keep: str) -> None:
    """Drawn out, in any pose, a compound has its value, and all steps of the drawing keep their claims."""
    left = 0
    for place, number in ((quarters, 4), (corners, 13)):
        for program, values in figures(name, place, number):
            expander = Expander(program, values, KEEPS[keep] - {name} if keep == "all but itself" else KEEPS[keep])
            expanded = expander.run()
            out = program.wanted[0]
            assert same(program.steps[out].op.gives, values[out], expander.values[expanded.wanted[0]],
                        50 * size(program, values))
            assert drawn(expanded, Floats()) == expander.values
            assert list(broken_claims(prune(expanded), drawn(prune(expanded), Floats()) or [], 1e-6)) == []
            left += keep == "strict" and any(step.op.name not in STRICT for step in expanded.steps)
    assert left == 0


# ---- the form that suits the pose ------------------------------------------------------------------------------------


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


def everywhere(form: str) -> Callable[[Panel], str]:
    """The same form wished on all plans."""
    return lambda panel: form


def expanded(program: Program, **choices: Any) -> Program:
    """The program drawn out."""
    return Expander(program, evaluate(program, Floats()), **choices).run()


def form(program: Program) -> str:
    """Which form of the compound was chosen."""
    return next(step.choice for step in program.steps if step.choice).best.form


SHEET = {"": Window((4.0, 4.0), 20.0)}


def test_auxiliary_point_where_it_is_on_the_sheet() -> None:
    """The textbook's auxiliary point is drawn where it can be, with its letters."""
    drawing = expanded(link(4.0), windows=SHEET)
    assert form(drawing) == "auxiliary point"
    assert {"Q", "v_q", "gamma"} <= {step.name for step in drawing.steps}


@pytest.mark.parametrize(("tilt", "windows"), [(0.0, SHEET), (1e-12, SHEET), (1e-3, SHEET), (0.5, SHEET), (0.5, {})])
def test_trial_figures_where_it_is_off_the_sheet(tilt: float, windows: Any) -> None:
    """Where the auxiliary point is off the sheet, or nowhere, trial figures find the locus, and where it is met at a
    flat angle on a sheet without edges."""
    drawing = expanded(link(tilt), windows=windows)
    assert "trial" in form(drawing)
    assert not any(step.name == "Q" for step in drawing.steps)


def test_preferred_form_is_drawn() -> None:
    """A form that is asked for by name is drawn wherever it can be."""
    assert form(expanded(link(0.5), windows=SHEET, prefer=everywhere("auxiliary point"))) == "auxiliary point"
    twice = everywhere("two trial figures")
    assert form(expanded(link(4.0), windows=SHEET, prefer=twice)).startswith("two trial figures")
    assert "trial" in form(expanded(link(0.0), windows=SHEET, prefer=everywhere("auxiliary point")))


@pytest.mark.parametrize(("v", "keep", "right"), [
    (0.5, BY_SET_SQUARE, "computed"), (4.0, BY_SET_SQUARE, "semicircle"), (12.0, BY_SET_SQUARE, "companion"),
    (16.0, BY_SET_SQUARE, "computed"), (0.5, STRICT, "semicircle"), (16.0, STRICT, "companion"),
])
def test_a_normal_acceleration_that_cannot_be_drawn_is_computed(v: float, keep: frozenset[str], right: str) -> None:
    """Where v²/r is next to nothing beside the plan, or longer than that, it is laid off as it is computed; but with
    compasses and straightedge alone it is constructed."""
    board = Board(coplanar=keep is STRICT)
    K, A, m, w, k = points(board, K=(0, 0), A=(10, 0), m=(3, 3), w=(3, 3 + v), k=(2, 9))
    program = freeze(board, [board.normal(K, A, m, w, k)])
    assert form(expanded(program, keep=keep, windows={"": Window((0.0, 0.0), 100.0, 20.0)})) == right


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
        drawing = expanded(link(4.0), keep=keep, prefer=everywhere("auxiliary point"))
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
        expander = Expander(program, truth, keep, prefer=everywhere(prefer))
        drawing = expander.run()
        for old, new in zip(program.wanted, drawing.wanted, strict=True):
            assert expander.values[new] == pytest.approx(truth[old], abs=1e-12)


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


# ---- the method of loci: a ternary link on three bars, whose lengths leave it two places -----------------------------


PIVOTS = (100.0, 20.0), (150.0, 150.0), (220.0, 40.0)
E, F, G = (0.0, 0.0), (40.0, 0.0), (15.0, 35.0)  # of the ternary link's figure
AE, BG, CF = 44.7214, 58.9981, 70.9483
PLACES = [((120.0, 60.0), (157.575, 73.716)), ((111.633, 63.182), (150.129, 52.318))]  # E and F


def group(E1: tuple[float, float], F1: tuple[float, float]) -> Closure:
    """The group as it lies there, from a drawing: to a tenth of a millimetre."""
    turn = complex(F1[0] - E1[0], F1[1] - E1[1]) / 40
    G1 = complex(*E1) + turn * complex(*G)
    ends = [*zip(PIVOTS, (E1, (G1.real, G1.imag), F1), (AE, BG, CF), strict=True)]
    ways = [complex(end[0] - pin[0], end[1] - pin[1]) for pin, end, _ in ends]
    bars = [Attitude(*pin, way.real / abs(way), way.imag / abs(way))
            for (pin, _, _), way in zip(ends, ways, strict=True)]
    pairs = [PlacedPin(k, (0.0, 0.0), k) for k in range(3)]
    hinges = [Hinge(k, (long, 0.0), 3, place) for k, (long, place) in enumerate([(AE, E), (BG, G), (CF, F)])]
    return Closure("2 to 5", [*pairs, *hinges], [*bars, Attitude(*E1, turn.real, turn.imag)], {"E": (0, (AE, 0.0))})


@pytest.mark.parametrize("place", PLACES, ids=["first", "second"])
def test_the_curve_of_the_freed_link_meets_the_circle_in_either_place(place: tuple[tuple[float, float], ...]) -> None:
    """From about where it is the joint comes out to the digits of the lengths, and four plans draw it."""
    board = Board()
    outer = [board.given(x=x, y=y, name=name) for name, (x, y) in zip("ABC", PIVOTS, strict=True)]
    near = [(x + 0.1, y - 0.1) for x, y in place]
    program = freeze(board, [board.close_on_three(*outer, group=group(near[0], near[1]), joint="E", name="E")])
    values = evaluate(program, Floats())
    assert math.dist(values[-1], place[0]) < 2e-3
    expander = Expander(program, values)
    drawn = expander.run()
    assert drawn.steps[drawn.wanted[0]].op is not program.steps[-1].op
    assert math.dist(expander.values[drawn.wanted[0]], values[-1]) < 1e-9


# ---- Lemoine's counts ------------------------------------------------------------------------------------------------


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
    assert counts(expanded(program, keep=STRICT)).text == told


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
