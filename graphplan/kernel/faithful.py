"""The float value of every step, right to the last digits also where floats lose most of theirs.

Where lines cross flat, or two points all but coincide, what is left of a difference has few digits of its own. Then the
steps are computed once more: between bounds where python-flint is installed, else in fractions; and rounded.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from graphplan.errors import ConstructionError
from graphplan.kernel.kinds import POINT
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.kernel.program import Program, about_origin
from graphplan.kernel.tolerances import DIVISOR_SHARE

PRECISIONS = 256, 1024, 4096  # bits
MAX_DISTANCE = 2.0**60  # times the mechanism: what floats cannot draw and lies further off no pencil can
DIGITS = Fraction(1, 2**60)  # of a number: how far off it may be before it is rounded


class Wary(Floats):
    """Floats that note the smallest share that is left of the terms of any divisor."""

    def __init__(self) -> None:
        self.share = 1.0

    def nonzero(self, value: float, scale: float, code: str, why: str) -> float:
        if scale:
            self.share = min(self.share, abs(value) / scale)
        return super().nonzero(value, scale, code, why)


class Faithful(NamedTuple):
    """The value of every step in floats, about the program's origin; whether `better` numbers than floats gave it, and
    how many times worse than to rounding it may be known."""

    values: list[Any]
    better: bool
    blur: float


def has_flint() -> bool:
    """Whether python-flint is there and can be loaded."""
    try:
        import graphplan.kernel.numbers.enclosures  # noqa: F401
    except ImportError:
        return False
    return True


def faithful(program: Program) -> Faithful:
    """The value of every step; fails as `evaluate` does where the pose cannot be drawn."""
    floats = Wary()
    try:
        values = about_origin(program, floats)
        fault = None
    except ConstructionError as error:
        fault = error
    if fault is None and floats.share >= DIVISOR_SHARE:
        return Faithful(values, False, 1.0)
    better = _enclosed_values(program) if has_flint() else _exact(program)
    if fault is not None and (better is None or _far_off(program, better)):
        raise fault
    return Faithful(values, False, 1 / floats.share) if better is None else Faithful(better, True, 1.0)


def _enclosed_values(program: Program) -> list[Any] | None:
    """The values rounded from between bounds; None if these do not close."""
    from graphplan.kernel.numbers.enclosures import Enclosures, Undecided, precision

    for bits in PRECISIONS:
        domain = Enclosures()
        with precision(bits):
            try:
                values = about_origin(program, domain)
                numbers = [number for value in values for number in value]
                nothing = max(abs(number.middle) for number in numbers) / 2**(bits // 2)
                if all(number.error <= max(DIGITS * abs(number.middle), nothing) for number in numbers):
                    return [tuple(map(_nearest_float, value)) for value in values]
            except ConstructionError:
                if not domain.undecided:
                    return None
            except Undecided:
                continue
    return None


def _far_off(program: Program, values: list[Any]) -> bool:
    """Whether a point lies so far off that no pencil draws it."""
    return _reach(program, values) > MAX_DISTANCE * _reach(program, values[:program.givens])


def _reach(program: Program, values: list[Any]) -> float:
    """The largest coordinate of these points."""
    points = (value for step, value in zip(program.steps, values, strict=False) if step.op.gives == POINT)
    return max((abs(coordinate) for point in points for coordinate in point), default=0.0)


def _nearest_float(number: Any) -> float:
    """The float nearest to a number between bounds: 0 where it may be that."""
    return 0.0 if abs(number.middle) <= number.error else float(number)


def _exact(program: Program) -> list[Any] | None:
    """The values rounded from fractions; None if one is a root, or does not exist."""
    try:
        return [tuple(map(float, value)) for value in about_origin(program, Fractions())]
    except ConstructionError:
        return None
