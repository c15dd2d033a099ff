"""The table speaks for itself: every record is documented, spoken and claimed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import fields
from fractions import Fraction
from functools import cache
from random import Random
from string import Formatter
from typing import Any

import pytest
from each import each
from figures import NAMES, drawn, figure

from graphplan.kernel import CIRCLE, FAILURES, LINE, POINT, TABLE, Primitive
from graphplan.kernel.claims import CLAIMS
from graphplan.kernel.kinds import SCALE, Movement
from graphplan.kernel.numbers import Floats

EACH = each("op", [TABLE[name] for name in NAMES], ids=lambda op: op.name)


@EACH
def test_sentence_speaks_of_everything(op: Primitive) -> None:
    """A sentence uses every argument, what is made, and every parameter; sizes are told where there is paper, in mm,
    of a link's figure nothing but its lengths, and of a trial nothing but its line matters."""
    used = {field for _, field, _, _ in Formatter().parse(op.sentence) if field is not None}
    sized = op.root is not None or (op.instrument == SCALE and op.gives != LINE and not op.free)
    needed = {"0"} if op.movement is Movement.PICKED else {*map(str, range(len(op.reads))), *op.params}
    figure = {"dx", "dy", "ux", "uy"} if "ux" in op.params else set()
    assert used == {"out", *needed} - ({*op.params} if sized else figure)


@EACH
def test_doc_is_one_line(op: Primitive) -> None:
    """What a primitive gives is told in one line that ends with a full stop."""
    assert re.fullmatch(r"[A-Z].*\.", (op.rule.__doc__ or "").strip().splitlines()[0])


@EACH
def test_failure_codes_are_explained(op: Primitive) -> None:
    """Every failure code says what it means and what to do."""
    assert all(all(FAILURES[code]) for code in op.fails)


def test_every_failure_code_is_used() -> None:
    """No failure code is left over: each is a primitive's, or the fractions' own."""
    assert set(FAILURES) == {code for op in TABLE.values() for code in op.fails} | {"not-rational"}


@EACH
def test_something_is_claimed(op: Primitive) -> None:
    """Every primitive claims something of what it makes, by claims that can be tested."""
    assert op.claims
    assert {claim[0] for claim in op.claims} <= set(CLAIMS)


def test_every_claim_is_made() -> None:
    """No test of a claim is left over."""
    assert set(CLAIMS) == {claim[0] for op in TABLE.values() for claim in op.claims}


@EACH
def test_methods_name_their_source(op: Primitive) -> None:
    """A source is given as author and year or as the name of the method."""
    assert not op.source or re.search(r"\d{4}", op.source)


@EACH
def test_operands_exist(op: Primitive) -> None:
    """Claims speak of operands that there are, and a step is drawn at one that it reads."""
    places = [k for claim in op.claims for part in claim[1:] for k in (part if isinstance(part, tuple) else (part,))]
    assert all(-1 <= k < len(op.reads) for k in places)
    assert -1 <= op.where < max(1, len(op.reads))


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


def moved(kind: str, value: Any) -> Any:
    """A mark shifted by (3, -2)."""
    if kind in (POINT, CIRCLE):
        return value[0] + 3, value[1] - 2, *value[2:]
    return (*value[:2], value[2] - 3 * value[0] + 2 * value[1]) if kind == LINE else value


def test_every_field_is_documented_once() -> None:
    """The record says of each of its fields what it is, in one row."""
    rows = re.findall(r"(?m)^ *\| (`.*`) \|", Primitive.__doc__ or "")
    assert sorted(re.findall(r"`(\w+)`", " ".join(rows))) == sorted(field.name for field in fields(Primitive))


def test_every_movement_is_made() -> None:
    """No movement is left over."""
    assert set(Movement) == {op.movement for op in TABLE.values()}


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
def test_only_the_direction_and_length_from_afar_count(op: Primitive) -> None:
    """What is read from another plan may be shifted there, all of it together."""
    for operands, params in samples(op):
        shifted = [moved(kind, value) if place in op.afar else value
                   for place, (kind, value) in enumerate(zip(op.reads, operands, strict=True))]
        assert made(op, shifted, params) == pytest.approx(made(op, operands, params))


@EACH
def test_reversal_makes_the_same_again(op: Primitive) -> None:
    """Where the line that it reads runs the other way, or two curves change places, the reversed parameter mends it."""
    if op.reversal:
        for (first, *rest), params in samples(op):
            turned = [tuple(-part for part in first), *rest] if op.reads[0] == LINE else [*rest, first]
            assert made(op, turned, op.reverse_parameters(params)) == pytest.approx(made(op, [first, *rest], params))
            assert op.reverse_parameters(op.reverse_parameters(params)) == params


@EACH
def test_what_lays_off_has_a_root(op: Primitive) -> None:
    """A point that is laid off has a point as its root; where its size is given, so is a parameter."""
    assert op.root is None or (op.gives, op.reads[op.root]) == (POINT, POINT)
    assert not op.has_size or op.params
    assert not op.spans or op.reads == (POINT, POINT)
    assert not op.crossing or set(op.reads) <= {LINE, CIRCLE}


@EACH
def test_lines_that_are_described_speak_of_operands(op: Primitive) -> None:
    """How a line is spoken of away from the sheet uses nothing but what it reads."""
    used = {int(field) for _, field, _, _ in Formatter().parse(op.described) if field is not None}
    assert used <= set(range(len(op.reads)))


@EACH
def test_compounds_that_are_weighed_have_forms(op: Primitive) -> None:
    """Only of what can be drawn in several forms a choice is told; a method is a compound too."""
    assert op.compound or not (op.weighed or op.method)
