"""Bounds of linear systems hold the exact solution, of small ones and of large ones, however near to singular."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from graphplan.mechanism.equations import Elimination
from graphplan.solver.floating import Floating, dense, equilibrate
from graphplan.solver.linear import MAX_UNKNOWNS, BoundedSystem, Unproven

RELATIVE_BOUND = 1e-12  # of the largest unknown, times the inverse distance from a singular system


def chain(size: int, distance: Fraction, seed: int) -> tuple[list[dict[int, Fraction]], list[Fraction]]:
    """Rows and right-hand side of unknowns that depend on two before; the last two rows are `distance` from parallel.
    """
    draw = Random(seed)

    def number() -> Fraction:
        return Fraction(draw.randrange(-99, 100), draw.randrange(1, 60))

    rows = [{j: number() for j in range(max(0, i - 2), i)} | {i: 3 + abs(number())} for i in range(size)]
    rows[-2][size - 1] = number()
    rows[-1] = {j: 2 * value for j, value in rows[-2].items()}
    rows[-1][size - 1] += distance
    return rows, [number() for _ in range(size)]


@pytest.mark.parametrize("size", [2, 9, MAX_UNKNOWNS, MAX_UNKNOWNS + 1, 120])
@pytest.mark.parametrize("power", [0, 3, 6, 9, 12])
def test_bounds_hold_the_exact_solution(size: int, power: int) -> None:
    """Each unknown lies within its bound, and floats lose digits in proportion to the distance from singular."""
    rows, right = chain(size, Fraction(1, 10**power), 100 * size + power)
    exact = Elimination(rows, size).solve(right)
    assert exact is not None
    largest = float(max(map(abs, exact)))
    solved = BoundedSystem(rows, [1.0] * size).solve(right)
    for number, value in zip(solved, exact, strict=True):
        assert abs(Fraction(number.value) - value) <= Fraction(number.error)
        assert number.error <= 10**power * RELATIVE_BOUND * largest
    floats = Floating(rows, [1.0] * size).solve(right)
    assert floats is not None
    for found, value in zip(floats, exact, strict=True):
        assert abs(found - float(value)) <= 10**power * RELATIVE_BOUND * largest


@pytest.mark.parametrize("size", [2, MAX_UNKNOWNS, 120])
def test_a_singular_system_is_not_solved(size: int) -> None:
    """Nothing is proven of it; floats say the same of what it determines as fractions do."""
    rows, right = chain(size, Fraction(0), size)
    with pytest.raises(Unproven):
        BoundedSystem(rows, [1.0] * size).solve(right)
    exact, floats = Elimination(rows, size), Floating(rows, [1.0] * size)
    assert floats.solve(right) is exact.solve(right) is None
    assert floats.free == exact.free
    assert floats.conflict(right) == exact.conflict(right)


@pytest.mark.parametrize("size", [9, 65, 200])
@pytest.mark.parametrize("power", [0, 3, 6, 9, 12])
def test_condition_is_that_of_the_equilibrated_matrix(size: int, power: int) -> None:
    """Of a large system, which is solved block by block, too, and of its transpose."""
    rows, scales = chain(size, Fraction(1, 10**power), 100 * size + power)[0], [1.0] * size
    exact = np.linalg.cond(dense(equilibrate(rows, scales)[0], size))
    for forces in (False, True):
        assert Floating(rows, scales, forces).condition == pytest.approx(exact, rel=10**power * RELATIVE_BOUND)


def test_condition_of_separate_unknowns() -> None:
    """Rows that each determine one unknown are as good as can be."""
    assert Floating([{k: Fraction(2 + k)} for k in range(100)], [1.0] * 100).condition == pytest.approx(1)
