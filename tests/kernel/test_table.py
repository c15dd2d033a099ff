"""The table speaks for itself: each record is spoken, claimed and explained, and its claims see whatever is wrong.

Claims hold of all that the rules draw, in any figure; faults are sown in the table, and each is caught by them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from random import Random
from string import Formatter
from typing import Any

import pytest
from each import each
from figures import LENGTHS, NAMES, Place, corners, drawn, extremes, figure
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from graphplan.errors import GraphplanError
from graphplan.kernel import CIRCLE, FAILURES, LINE, OPENING, POINT, TABLE, Board, Primitive
from graphplan.kernel.claims import CLAIMS, broken_claims
from graphplan.kernel.kinds import SCALE, Movement
from graphplan.kernel.numbers import Domain, Floats, Fractions
from graphplan.kernel.passes import freeze

EACH = each("op", [TABLE[name] for name in NAMES], ids=lambda op: op.name)
READING = each("op", [TABLE[name] for name in NAMES if TABLE[name].reads], ids=lambda op: op.name)
ALONG = Fraction(7, 4), Fraction(-11, 2)


# ---- what a record says ----------------------------------------------------------------------------------------------


@EACH
def test_sentence_speaks_of_everything(op: Primitive) -> None:
    """A sentence uses every argument, what is made, and every parameter; sizes are told where there is paper, in mm,
    of a link's figure nothing but its lengths, and of a trial nothing but its line matters."""
    used = {field for _, field, _, _ in Formatter().parse(op.sentence) if field is not None}
    sized = op.root is not None or (op.instrument == SCALE and op.gives != LINE and not op.free)
    needed = {"0"} if op.movement is Movement.PICKED else {*map(str, range(len(op.reads))), *op.params}
    figure = {"dx", "dy", "ux", "uy"} if "ux" in op.params else set()
    assert used == {"out", *needed} - ({*op.params} if sized else figure)
    described = {int(field) for _, field, _, _ in Formatter().parse(op.described) if field is not None}
    assert described <= {*range(len(op.reads))}


@each("name", NAMES)
def test_every_step_is_spoken(name: str) -> None:
    """Each primitive's sentence can be said of a step, in letters and numbers only."""
    program = figure(name, Random(name))
    sentence = program.sentence(len(program) - 1)
    assert sentence.endswith(".")
    assert "{" not in sentence
    assert "Fraction" not in sentence


def test_no_entry_is_left_over() -> None:
    """Every failure code, claim and movement is some primitive's, and is explained; fractions have a code of their own.
    """
    assert {code for op in TABLE.values() for code in op.fails} | {"not-rational"} == {*FAILURES}
    assert all(all(FAILURES[code]) for code in FAILURES)
    assert {claim[0] for op in TABLE.values() for claim in op.claims} == {*CLAIMS}
    assert {op.movement for op in TABLE.values()} == {*Movement}


@EACH
def test_operands_exist(op: Primitive) -> None:
    """Something is claimed, of operands that there are; the operand on whose plan a step is drawn is none of those that
    may be elsewhere, and no operand is in two groups."""
    places = [k for claim in op.claims for part in claim[1:] for k in (part if isinstance(part, tuple) else (part,))]
    assert op.claims
    assert all(-1 <= k < len(op.reads) for k in places)
    assert -1 <= op.where < max(1, len(op.reads))
    assert not op.reads or op.where % len(op.reads) in op.same_plan_operands
    assert sorted([*op.same_plan_operands, *(k for group in op.afar for k in group)]) == [*range(len(op.reads))]


@EACH
def test_what_lays_off_has_a_root(op: Primitive) -> None:
    """A point that is laid off has a point as its root; where its size is given, so is a parameter, and what is worked
    out from measured lengths has none. What is weighed or a method can be drawn in forms; a source names its year."""
    assert op.root is None or (op.gives, op.reads[op.root]) == (POINT, POINT)
    assert not op.has_size or op.params
    assert not op.spans or op.reads == (POINT, POINT)
    assert not op.crossing or {*op.reads} <= {LINE, CIRCLE}
    assert op.compound or not (op.weighed or op.method)
    assert not op.source or re.search(r"\d{4}", op.source)


@cache
def samples(op: Primitive) -> list[tuple[list[Any], dict[str, Any]]]:
    """Some operands and parameters of which a primitive makes something."""
    r, found = Random(op.name), []
    while len(found) < 5:
        program = figure(op.name, r)
        values = drawn(program, Floats())
        if values is not None:
            found.append(([values[arg] for arg in program.steps[-1].args], program.steps[-1].params))
    return found


def made(op: Primitive, operands: Sequence[Any], params: dict[str, Any]) -> list[float]:
    """What a primitive makes, as floats; of a line what does not hang on its size."""
    value = [float(number) for number in op.rule(Floats(), *operands, **params)]
    size = (value[0] ** 2 + value[1] ** 2) ** 0.5 if op.gives == LINE else 1.0
    return [number / size for number in value]


@EACH
def test_a_movement_makes_one_thing(op: Primitive) -> None:
    """Of the same operands, all primitives of a movement make the same: what has a ratio makes it at the ratio 1."""
    alike = [other for other in TABLE.values() if other.movement is op.movement]
    if op.movement not in (Movement.OTHER, Movement.MEASURED):
        for other in alike:
            assert (other.reads, other.gives, other.where, other.afar) == (op.reads, op.gives, op.where, op.afar)
            for operands, params in samples(op):
                whole = {name: Fraction(1) if name == "ratio" else value for name, value in params.items()}
                one, two = ({name: whole.get(name, 1) for name in entry.params} for entry in (op, other))
                assert made(op, operands, one) == pytest.approx(made(other, operands, two))


@EACH
def test_reversal_makes_the_same_again(op: Primitive) -> None:
    """Where the line that it reads runs the other way, or two curves change places, the reversed parameter mends it."""
    if op.reversal:
        for (first, *rest), params in samples(op):
            turned = [tuple(-part for part in first), *rest] if op.reads[0] == LINE else [*rest, first]
            assert made(op, turned, op.reverse_parameters(params)) == pytest.approx(made(op, [first, *rest], params))
            assert op.reverse_parameters(op.reverse_parameters(params)) == params


@READING
def test_only_lengths_and_directions_of_what_is_afar_count(op: Primitive) -> None:
    """Where a vector, an opening or a figure lies on its plan changes nothing; with what is near the mark moves."""
    random, told = Random(op.name), 0
    for _ in range(12):
        program = figure(op.name, random)
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


# ---- claims hold of what the rules draw ------------------------------------------------------------------------------


@each("name", NAMES)
@settings(max_examples=22, deadline=None)
@given(r=st.randoms(use_true_random=False))
def test_claims_hold(name: str, r: Random) -> None:
    """What a primitive draws on random operands keeps all its claims."""
    program = figure(name, r)
    values = drawn(program, Floats())
    assume(values is not None)
    assert values is not None
    assert [*broken_claims(program, values)] == []


@each("name", NAMES)
@each("place", [corners, extremes])
def test_claims_hold_in_degenerate_figures(name: str, place: Place) -> None:
    """Points that coincide or lie in line, and lengths 1e-9 and 1e9 apart, are drawn right or not at all."""
    r = Random(name)
    for _ in range(97):
        program = figure(name, r, place)
        values = drawn(program, Floats())
        assert values is None or [*broken_claims(program, values)] == []


@each("name", NAMES)
def test_claims_hold_of_fractions(name: str) -> None:
    """Claims are tested on fractions too."""
    r = Random(name)
    exact = [(program, drawn(program, Fractions())) for program in (figure(name, r) for _ in range(20))]
    assert all([*broken_claims(program, values)] == [] for program, values in exact if values is not None)


def test_a_broken_claim_is_named() -> None:
    """It is told with its step and by how much it is off; a value that is not a number keeps none."""
    b = Board()
    A, B = b.given(x=0, y=0, name="A"), b.given(x=2, y=0, name="B")
    program = freeze(b, [b.midpoint(A, B, name="M")])
    assert [*broken_claims(program, [(0.0, 0.0), (2.0, 0.0), (1.0, 0.0)])] == []
    assert [*broken_claims(program, [(0.0, 0.0), (2.0, 0.0), (1.5, 0.0)])] == [
        "step 1 (M = midpoint(A, B)): M B is not the vector A M; by 5.0e-01 of its size"]
    assert [*broken_claims(program, [(0.0, 0.0), (2.0, 0.0), (float("nan"), 0.0)])]


# ---- faults are caught by the claims ---------------------------------------------------------------------------------

FIGURES = 12
Rule = Callable[..., Any]


def turned(rule: Rule, **swap: dict[str, str]) -> Rule:
    """The rule on the other branch."""
    return lambda d, *args, **params: rule(
        d, *args, **{name: swap[name][value] if name in swap else value for name, value in params.items()})


def ordered(*places: int) -> Callable[[Rule], Rule]:
    """The rule with operands swapped."""
    return lambda rule: lambda d, *args, **params: rule(d, *(args[k] for k in places), **params)


def doubled(k: int) -> Callable[[Rule], Rule]:
    """The step from an operand to the drawn point, twice as long."""
    return lambda rule: lambda d, *args, **params: tuple(
        2 * p - q for p, q in zip(rule(d, *args, **params), args[k], strict=True))


def reflected(k: int) -> Callable[[Rule], Rule]:
    """The step from an operand to the drawn point, the other way."""
    return lambda rule: lambda d, *args, **params: tuple(
        2 * q - p for p, q in zip(rule(d, *args, **params), args[k], strict=True))


def backwards(rule: Rule) -> Rule:
    """The same line, running the other way."""
    return lambda d, *args, **params: tuple(-number for number in rule(d, *args, **params))


def displaced(k: int) -> Callable[[Rule], Rule]:
    """One number of the value a thousandth off."""
    return lambda rule: lambda d, *args, **params: tuple(
        1.001 * p + 0.001 if place == k else p for place, p in enumerate(rule(d, *args, **params)))


OTHER = {"side": {"left": "right", "right": "left"}, "way": {"on": "back", "back": "on"},
         "turn": {"parallel": "perpendicular", "perpendicular": "parallel"}}

FAULTS: list[tuple[str, str, Callable[[Rule], Rule]]] = [
    ("line", "runs from the second point to the first", backwards),
    ("parallel", "runs against the line", backwards),
    ("perpendicular", "turned clockwise", backwards),
    ("bisector", "turned clockwise", backwards),
    ("guide", "direction mirrored", lambda rule: lambda d, P, *, dx, dy: rule(d, P, dx=dx, dy=-dy)),
    ("meet", "sign of x", lambda rule: lambda d, *args: (-rule(d, *args)[0], rule(d, *args)[1])),
    ("opening", "not squared", lambda rule: lambda d, *args: (rule(d, *args)[0] ** 0.5,)),
    ("circle", "opening taken for a diameter", lambda rule: lambda d, C, o: (*C, o[0] / 4)),
    ("circles_meet", "wrong side", lambda rule: turned(rule, side=OTHER["side"])),
    ("circles_meet", "circles swapped", ordered(1, 0)),
    ("line_meets_circle", "wrong way", lambda rule: turned(rule, way=OTHER["way"])),
    ("step_off", "vector reversed", ordered(1, 0, 2)),
    ("step_across", "turned clockwise", reflected(2)),
    ("lay_along", "backwards", reflected(1)),
    ("lay_off", "twice", doubled(0)),
    ("pick", "behind", lambda rule: lambda d, *args, ratio: rule(d, *args, ratio=-ratio)),
    ("midpoint", "laid off whole", doubled(0)),
    ("foot", "mirror image", doubled(1)),
    ("transfer", "vector reversed", ordered(1, 0, 2)),
    ("transfer", "laid off from its own beginning", ordered(0, 1, 0)),
    ("quarter", "turned clockwise", reflected(2)),
    ("shift", "shifted back", ordered(0, 2, 1)),
    ("divide", "from the other end", ordered(0, 1, 2, 4, 3)),
    ("divide", "part and whole swapped", ordered(0, 2, 1, 3, 4)),
    ("similar", "wrong turn", lambda rule: turned(rule, turn=OTHER["turn"])),
    ("similar", "images swapped", ordered(0, 1, 2, 4, 3)),
    ("similar", "mirrored", reflected(3)),
    ("triangle", "images swapped", ordered(0, 1, 2, 4, 3)),
    ("triangle", "mirrored", reflected(3)),
    ("triangle", "another corner", ordered(1, 2, 0, 3, 4)),
    ("carry", "wrong turn", lambda rule: turned(rule, turn=OTHER["turn"])),
    ("carry", "loci swapped", ordered(0, 3, 2, 1, 4)),
    ("carry", "sign of the elimination", lambda rule: lambda d, A, alpha, B, beta, C, *, turn: rule(
        d, A, alpha, (2 * C[0] - B[0], 2 * C[1] - B[1]), beta, C, turn=turn)),
    ("settle", "wrong turn", lambda rule: turned(rule, turn=OTHER["turn"])),
    ("settle", "the other point's image", ordered(0, 1, 4, 5, 2, 3)),
    ("settle", "mirrored", reflected(1)),
    ("normal", "towards k", reflected(4)),
    ("normal", "velocity not squared", lambda rule: lambda d, K, A, m, w, k: tuple(
        q + (p - q) / ((w[0] - m[0]) ** 2 + (w[1] - m[1]) ** 2) ** 0.5
        for p, q in zip(rule(d, K, A, m, w, k), k, strict=True))),
    ("computed_normal", "towards k", reflected(4)),
    ("computed_normal", "velocity not squared", lambda rule: lambda d, K, A, m, w, k: tuple(
        q + (p - q) / ((w[0] - m[0]) ** 2 + (w[1] - m[1]) ** 2) ** 0.5
        for p, q in zip(rule(d, K, A, m, w, k), k, strict=True))),
    ("coriolis", "sign", reflected(4)),
    ("coriolis", "laid off once", lambda rule: lambda d, *args: tuple(
        (p + q) / 2 for p, q in zip(rule(d, *args), args[4], strict=True))),
    ("coriolis", "turning and sliding swapped", ordered(0, 1, 3, 2, 4)),
    ("third", "to the other side", reflected(0)),
    ("third", "from the other end", ordered(1, 0, 2, 3)),
    ("curved", "pole and inflection pole swapped", ordered(2, 1, 0)),
    ("curved", "to the other side", reflected(1)),
    ("conjugate", "point and centre swapped", ordered(0, 2, 1, 3, 4, 5)),
    ("conjugate", "to the other side", reflected(5)),
    ("false_position", "errors added", lambda rule: lambda d, A1, A2, Z1, l1, Z2, l2: rule(
        d, A1, A2, Z1, l1, (2 * Z1[0] - Z2[0], 2 * Z1[1] - Z2[1]), l2)),
    ("false_position", "from the second trial", ordered(1, 0, 2, 3, 4, 5)),
    ("balance", "sign of the moment", reflected(5)),
    ("balance", "about the other point", ordered(1, 0, 2, 3, 4, 5)),
    ("couple", "the wrong way round", reflected(2)),
    ("inertia_pair", "with the turning", reflected(4)),
    ("resultant", "to the other side", reflected(0)),
    ("touch", "with the turning", reflected(0)),
    ("lean", "with the sliding", lambda rule: lambda d, l, B, w, p, q, *, coefficient: rule(
        d, l, B, w, p, q, coefficient=-coefficient)),
    ("pressure_line", "leans to the other wheel", lambda rule: lambda d, P, B, p, q, *, coefficient: rule(
        d, P, B, p, q, coefficient=-coefficient)),
    ("pull_line", "pushes", lambda rule: lambda d, P, B, p, q, *, coefficient: rule(
        d, P, B, p, q, coefficient=-coefficient)),
    ("towards", "parallel to the first line", lambda rule: lambda d, y, z, X: (y[0], y[1], -y[0] * X[0] - y[1] * X[1])),
    ("weigh", "sign of the moment", reflected(6)),
    ("link_length", "not squared", lambda rule: lambda d, **params: (rule(d, **params)[0] ** 0.5,)),
    ("inclined", "runs the other way", backwards),
    ("crank", "twice as long", doubled(0)),
    ("corner", "mirrored", lambda rule: lambda d, P, Q, **given: rule(d, P, Q, **given | {"dy": -given["dy"]})),
    ("corner", "from the other point", ordered(1, 0)),
    ("set_off", "backwards", reflected(1)),
    ("sight", "wrong way", lambda rule: turned(rule, way=OTHER["way"])),
    ("sight", "runs the other way", backwards),
    ("curve_meets_circle", "as the plans come the other way", ordered(3, 2, 1, 0, 4)),
    ("curves_meet", "off it", doubled(0)),
    *((name, "off it", doubled(0)) for name in ("close_on_two", "close_on_three", "close_on_four")),
]


def complaints(name: str) -> list[str]:
    """What the claims say of a fixed set of figures."""
    r, found = Random(name), []
    for _ in range(FIGURES):
        program = figure(name, r)
        values = drawn(program, Floats())
        if values is not None:
            found += broken_claims(program, values)
    return found


def sow(patch: pytest.MonkeyPatch, name: str, fault: Callable[[Rule], Rule]) -> None:
    """Put the faulty rule in the table."""
    patch.setitem(TABLE, name, replace(TABLE[name], rule=fault(TABLE[name].rule)))


@each(("name", "what", "fault"), FAULTS, ids=lambda fault: f"{fault[0]}: {fault[1]}")
def test_fault_is_caught(name: str, what: str, fault: Callable[[Rule], Rule], monkeypatch: pytest.MonkeyPatch) -> None:
    """A fault sown in a rule is caught by what the primitive claims, on a few figures."""
    sow(monkeypatch, name, fault)
    assert any(f" = {name}(" in complaint for complaint in complaints(name))


@each("name", NAMES)
def test_displacement_is_caught(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever a primitive draws, a little beside it is wrong, where without a fault nothing is: each number matters.
    """
    assert complaints(name) == []
    for place in range(LENGTHS[TABLE[name].gives]):
        with monkeypatch.context() as patch:
            sow(patch, name, displaced(place))
            assert complaints(name), f"number {place}"


def test_every_primitive_is_tried() -> None:
    """Faults are sown in every primitive that has a choice to get wrong."""
    plain = {"given", "begin", "pole", "radius"}
    assert {name for name, _, _ in FAULTS} == {*NAMES} - plain
