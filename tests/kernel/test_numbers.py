"""One rule serves every number type: floats, arrays of poses, fractions."""

from __future__ import annotations

import math
from random import Random
from typing import Any

import numpy as np
import pytest
from each import each
from figures import LENGTHS, NAMES, Place, corners, drawn, extremes, figure, quarters, size

from graphplan.errors import ConstructionError
from graphplan.kernel import TABLE, Program
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.program import evaluate

PLACES = each("place", [quarters, corners, extremes])


def poses(program: Program, r: Random, place: Place, n: int) -> list[dict[str, dict[str, float]]]:
    """Other points for the same program."""
    points = [step.name for step in program.steps if step.op.name == "given"]
    return [{name: dict(zip("xy", map(float, place(r)), strict=True)) for name in points} for _ in range(n)]


def stacked(given: list[dict[str, dict[str, float]]]) -> dict[str, dict[str, Any]]:
    """Poses as arrays."""
    return {name: {axis: np.array([pose[name][axis] for pose in given]) for axis in "xy"} for name in given[0]}


def last(program: Program, given: dict[str, dict[str, float]]) -> tuple[float, ...]:
    """The value of the last step in floats, or nan where the pose cannot be drawn."""
    values = drawn(program, Floats(), **given)
    return (math.nan,) * LENGTHS[program.steps[-1].op.gives] if values is None else values[-1]


@PLACES
@each("name", NAMES)
def test_batch_equals_floats(name: str, place: Place) -> None:
    """A batch of n poses gives exactly the n floats, one or many; what cannot be drawn is nan, with a code."""
    r = Random(name)
    for n in (1, 40):
        program = figure(name, r, place)
        given = poses(program, r, place, n)
        arrays = Arrays()
        with np.errstate(all="ignore"):
            values = evaluate(program, arrays, stacked(given) if given[0] else None)[-1]
        batch = np.array([np.broadcast_to(number, n) for number in values]).T
        one_by_one = np.array([last(program, pose) for pose in given])
        assert np.array_equal(batch, one_by_one, equal_nan=True)
        noted = np.zeros(n, bool)
        for _, _, bad in arrays.faults:
            noted |= bad
        assert np.array_equal(noted, np.isnan(batch).all(axis=1))


@each("name", NAMES)
def test_fractions_equal_floats(name: str) -> None:
    """Fractions give what floats give, to rounding."""
    r, both = Random(name), 0
    for _ in range(60):
        program = figure(name, r)
        exact, rounded = drawn(program, Fractions()), drawn(program, Floats())
        if exact is None or rounded is None:
            continue
        both += 1
        reach = max(1.0, size(program, rounded), *(abs(float(number)) for value in exact for number in value))
        assert all(abs(float(p) - q) < 1e-12 * reach for p, q in zip(exact[-1], rounded[-1], strict=True))
    assert both or name in ROOTS


ROOTS = {"line_meets_circle", "circles_meet", "set_off", "sight",
         "curve_meets_circle", "curves_meet", "close_on_two", "close_on_three", "close_on_four"}


@PLACES
@each("name", NAMES)
def test_nothing_is_silently_no_number(name: str, place: Place) -> None:
    """Each figure is drawn in finite numbers or raises a code that the primitive declares."""
    r = Random(name)
    for _ in range(65):
        program = figure(name, r, place)
        try:
            values = evaluate(program, Floats())
        except ConstructionError as error:
            assert error.code in {code for step in program.steps for code in step.op.fails}
        else:
            assert all(math.isfinite(number) for value in values for number in value)


CODES = [(name, code) for name in NAMES for code in TABLE[name].fails]


@each(("name", "code"), CODES)
def test_failure_code_is_reached(name: str, code: str) -> None:
    """Every failure that a primitive declares can happen, in floats and in fractions."""
    r = Random(name)
    for domain in (Floats(), Fractions()):
        assert any(failure(figure(name, r, corners), domain) == code for _ in range(2000))


def failure(program: Program, domain: Any) -> str:
    """The code with which the last step fails, if it does."""
    try:
        evaluate(program, domain)
    except ConstructionError as error:
        return error.code if error.step == program.number(len(program) - 1) else ""
    return ""


def test_fractions_refuse_what_is_irrational() -> None:
    """A root that does not come out, and a float, raise `not-rational`."""
    domain = Fractions()
    for ask in (lambda: domain.sqrt(domain.lift(2), "circles-miss", ""), lambda: domain.lift(0.1)):
        with pytest.raises(Exception, match="not-rational"):
            ask()
    assert domain.sqrt(domain.lift("9/4"), "", "") == domain.lift("3/2")
