"""However a compound is drawn, it is the value of its rule; and each way of drawing it is the right one somewhere."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache, partial
from itertools import chain
from random import Random
from typing import Any

import pytest
from each import each
from figures import COMPOUNDS, Place, corners, drawn, figure, quarters, size

from graphplan.errors import Undrawable
from graphplan.kernel import FAILURES, LINE, TABLE, Mark, Program
from graphplan.kernel.claims import broken_claims
from graphplan.kernel.expand import BY_SET_SQUARE, STRICT, Expander
from graphplan.kernel.form_board import FormBoard
from graphplan.kernel.numbers import Floats
from graphplan.kernel.panel import Window
from graphplan.kernel.passes import prune

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
        found |= {one.rating.form for one in expander.attempts(TABLE[name], marks, program.steps[-1].params)}
        if found >= {*TABLE[name].forms}:
            break
    return found


@each(("name", "form"), FORMS)
def test_form_draws_the_value(name: str, form: str) -> None:
    """Asked for by name, a form gives the rule's value; it is one of those that can be drawn in some pose."""
    for program, values in [*figures(name, quarters, 7), *figures(name, corners, 33)]:
        expander = Expander(program, values, frozenset(TABLE) - {name}, wide(program, values), prefer=form)
        expanded = expander.run()
        out = program.wanted[0]
        reach = 50 * size(program, values)
        assert same(program.steps[out].op.gives, values[out], expander.values[expanded.wanted[0]], reach)
    assert form in drawable(name)


@each("name", COMPOUNDS)
def test_leaving_off_finds_the_best(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Inside a form that is tried, forms are left off that cannot win: the best is the same as of all drawn out."""
    for program, values in figures(name, corners, 12):
        expander, marks = laid_out(program, values, name)
        expander.keep = STRICT
        ask = partial(expander.attempts, TABLE[name], marks, program.steps[-1].params)
        monkeypatch.setattr(expander, "_movement_limit", lambda *_: math.inf)
        every = [attempt.rating for attempt in ask()]
        monkeypatch.undo()
        assert [attempt.rating for attempt in ask(tried=True)][:1] == every[:1]


@each(("name", "form"), FORMS)
def test_form_fails_cleanly(name: str, form: str) -> None:
    """Where a form cannot be drawn it gives nothing or a declared code: never another error."""
    for program, values in figures(name, corners, 40):
        expander, marks = laid_out(program, values, name)
        try:
            TABLE[name].forms[form](FormBoard(expander), *marks, **program.steps[-1].params)
        except Undrawable as fault:
            assert fault.code in FAILURES


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
