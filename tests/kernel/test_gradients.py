"""First order is exact: the derivatives that rules give are the limits of their difference quotients."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal, localcontext
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
from each import each
from figures import NAMES, figure

from graphplan.errors import Undrawable
from graphplan.kernel import TABLE, Program
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.gradients import Gradients

STEP = Decimal("1e-25")  # of the quotients: with 90 digits they agree with their limits to some 50
FIGURES = 8
ROUNDING = 1e-9  # beside the largest derivative: what floats lose where a figure's lines cross flat


class Digits(Domain):
    """Decimals of very many digits."""

    def lift(self, value: Any) -> Decimal:
        fraction = Fraction(value)
        return Decimal(fraction.numerator) / fraction.denominator

    def sqrt(self, value: Decimal, code: str, why: str) -> Decimal:
        if value < 0:
            raise Undrawable(code, why)
        return value.sqrt()

    def nonzero(self, value: Decimal, scale: Decimal, code: str, why: str) -> Decimal:
        if abs(value) <= STEP * scale:
            raise Undrawable(code, why)
        return value

    def sign(self, value: Decimal, scale: Decimal) -> int:
        return 0 if abs(value) <= STEP * scale else 1 if value > 0 else -1


def last(program: Program, domain: Domain, points: Sequence[Any]) -> Any:
    """What the last step makes, its given points being these coordinates, one after the other."""
    values: list[Any] = list(zip(points[::2], points[1::2], strict=True))
    for step in program.steps[program.givens :]:
        values.append(step.op.rule(domain, *[values[arg] for arg in step.args], **step.params))
    return values[-1]


def quotients(program: Program, points: Sequence[Fraction]) -> list[list[float]]:
    """The difference quotients of every number that is made, by every coordinate."""
    found = []
    with localcontext(prec=90):
        exact = [Digits().lift(number) for number in points]
        for place, number in enumerate(exact):
            ends = [last(program, Digits(), [*exact[:place], number + step, *exact[place + 1 :]])
                    for step in (-STEP, STEP)]
            found.append([float((after - before) / (2 * STEP)) for before, after in zip(*ends, strict=True)])
    return found


@each("name", [name for name in NAMES if TABLE[name].reads])
def test_derivatives_are_the_limits_of_difference_quotients(name: str) -> None:
    """Every rule of the table, followed with gradients, gives its derivative by each point it rests on."""
    compared = 0
    for seed in range(FIGURES):
        program = figure(name, Random(seed))
        points = [step.params[axis] for step in program.steps[: program.givens] for axis in "xy"]
        domain = Gradients(len(points))
        try:
            made = last(program, domain, [float(p) + domain.error(i, 1.0) for i, p in enumerate(points)])
            expected = np.transpose(quotients(program, points))
        except Undrawable:
            continue
        gap = np.abs([domain.partials(number) for number in made] - expected)
        assert (gap <= ROUNDING * np.abs(expected).max()).all()
        compared += 1
    assert compared
