"""Systems of few unknowns in plain Python: their bounds hold, and are those that numpy finds for larger ones."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest

from graphplan.solver.bounds import Unproven
from graphplan.solver.proven import Proven
from graphplan.solver.small_systems import MAX_UNKNOWNS, SmallSystem

Rows = list[dict[int, float]]


def sparse_rows(width: int, random: Random) -> Rows:
    """Rows of four whole numbers each, of unlike size."""
    return [{j: float(random.choice((-1, 1)) * random.randint(1, 999) * 2 ** random.randint(0, 9))
             for j in {i, *(random.randrange(width) for _ in range(3))}} for i in range(width)]


@pytest.mark.parametrize("width", [1, 2, 9, MAX_UNKNOWNS])
def test_the_bounds_hold_and_are_as_narrow_as_those_of_large_systems(width: int) -> None:
    """Each unknown lies within its bound of what it is, and that is no wider than numpy's by more than half."""
    random = Random(width)
    for _ in range(20):
        rows, scales = sparse_rows(width, random), [10.0 ** random.randint(-2, 2) for _ in range(width)]
        truth = [random.randint(-999, 999) for _ in rows]
        sides = [sum(value * truth[j] for j, value in row.items()) for row in rows]  # whole numbers: nothing is rounded
        small, large = (system(rows, scales).solve(sides) for system in (SmallSystem, Proven))
        for number, other, true in zip(small, large, truth, strict=True):
            assert abs(Fraction(number.value) - true) <= number.error <= 1.5 * other.error
            assert number.size == pytest.approx(other.size, rel=1e-4)


@pytest.mark.parametrize("rows", [
    [{0: 1.0, 1: 2.0}, {0: 2.0, 1: 4.0}],  # one row twice
    [{0: 0.1, 1: 0.3}, {0: 0.2, 1: 0.6000000000000001}],  # regular, but not by what floats tell
    [{0: 1.0}, {0: 1.0}],
    [{0: 1.0, 1: 1.0}],  # not square
])
def test_what_may_be_singular_is_not_solved(rows: Rows) -> None:
    """A system that floats cannot tell from a singular one is refused."""
    with pytest.raises(Unproven):
        SmallSystem(rows, [1.0, 1.0]).solve([1.0] * len(rows))
