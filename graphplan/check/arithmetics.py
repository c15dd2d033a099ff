"""The arithmetics in which a scene is reckoned with proven bounds: floats with their errors, and enclosures.

Both take the scene as it is written: a rational one is exact, and what is not is reckoned once more from its
placements, angles and turns a minute.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from graphplan.mechanism.numerals import TO_A_FLOAT, Reckoning


@dataclass(frozen=True)
class Arithmetic:
    """How numbers with bounds are made, and how linear systems are solved in them.

    `solve` reads rows, the scale of each unknown, and gives what solves for a right-hand side; `doubt` is the error
    where the bounds are too wide to tell.
    """

    lift: Callable[[Any], Any]
    pi: Callable[[], Any]
    heading: Callable[[Fraction], tuple[Any, Any]]
    solve: Callable[[Sequence[Mapping[int, Any]], Sequence[float]], Callable[[Sequence[Any]], list[Any]]]
    doubt: type[Exception]

    def root(self, square: Any) -> Any:
        """The square root of a number that is not negative."""
        return self.lift(square).root

    @property
    def reckoning(self) -> Reckoning:
        """How placements take roots and angles: as fractions where they are."""
        return Reckoning(self._root, self._heading)

    def _root(self, square: Any) -> tuple[Any, bool]:
        if isinstance(square, Fraction):
            root, exact = TO_A_FLOAT.root(square)
            if exact:
                return root, True
        return self.root(square), False

    def _heading(self, degrees: Fraction) -> tuple[Any, Any, bool]:
        return TO_A_FLOAT.heading(degrees) if degrees % 90 == 0 else (*self.heading(degrees), False)


def floats() -> Arithmetic:
    """Floats with proven errors."""
    from graphplan.solver.bounded import PI, Unproven, bounded, heading
    from graphplan.solver.bounds import Proven

    return Arithmetic(bounded, lambda: PI, heading, lambda rows, scales: Proven(rows, scales).solve, Unproven)


def enclosures() -> Arithmetic:
    """Enclosures of the working precision."""
    from graphplan.kernel.numbers.enclosures import Enclosure, Undecided, heading, pi, solve

    return Arithmetic(Enclosure, pi, heading, lambda rows, scales: solve(rows), Undecided)
