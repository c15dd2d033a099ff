"""First order: a number with its derivative by every small error of the drawing, through the same rules as floats."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from graphplan.kernel.numbers import Domain, Floats


class Gradient:
    """A value and its partial derivatives; numbers without errors stay plain floats beside it."""

    __slots__ = ("partials", "value")
    __array_ufunc__ = None  # numpy's own numbers leave the arithmetic to this class

    def __init__(self, value: float, partials: Any):
        self.value, self.partials = value, partials

    def __neg__(self) -> Gradient:
        return Gradient(-self.value, -self.partials)

    def __abs__(self) -> Gradient:
        return -self if self.value < 0 else self

    def __add__(self, other: Any) -> Gradient:
        if isinstance(other, Gradient):
            return Gradient(self.value + other.value, self.partials + other.partials)
        return Gradient(self.value + other, self.partials)

    def __sub__(self, other: Any) -> Gradient:
        if isinstance(other, Gradient):
            return Gradient(self.value - other.value, self.partials - other.partials)
        return Gradient(self.value - other, self.partials)

    def __rsub__(self, other: Any) -> Gradient:
        return Gradient(other - self.value, -self.partials)

    def __mul__(self, other: Any) -> Gradient:
        if isinstance(other, Gradient):
            return Gradient(self.value * other.value, other.value * self.partials + self.value * other.partials)
        return Gradient(self.value * other, other * self.partials)

    def __truediv__(self, other: Any) -> Gradient:
        if isinstance(other, Gradient):
            ratio = self.value / other.value
            return Gradient(ratio, (self.partials - ratio * other.partials) / other.value)
        return Gradient(self.value / other, self.partials / other)

    def __rtruediv__(self, other: Any) -> Gradient:
        ratio = other / self.value
        return Gradient(ratio, -ratio / self.value * self.partials)

    __radd__, __rmul__ = __add__, __mul__


class Gradients(Domain):
    """One pose in double precision with `count` errors, each zero and known by its place; what cannot be drawn raises.

    The size of a root that is nothing has no derivative: it counts as steady, which tells too little there.
    """

    def __init__(self, count: int):
        self.count = count
        self._floats = Floats()

    def error(self, place: int, size: float) -> Gradient:
        """An error of this size: zero, and known by its derivative alone."""
        partials = np.zeros(self.count)
        partials[place] = size
        return Gradient(0.0, partials)

    def unsteady(self, value: float, places: Iterable[int]) -> Gradient:
        """A number whose errors at these places have no bound."""
        partials = np.zeros(self.count)
        partials[list(places)] = np.inf
        return Gradient(value, partials)

    def with_errors(self, value: float, errors: Iterable[tuple[int, float]]) -> Any:
        """A number with these errors, each by its place and with its derivative; a plain number if all errors are
        zero."""
        partials = None
        for place, partial in errors:
            if partial:
                partials = np.zeros(self.count) if partials is None else partials
                partials[place] += partial
        return value if partials is None else Gradient(value, partials)

    def partials(self, number: Any) -> Any:
        """The derivatives of a number by all errors."""
        return np.asarray(number.partials, float) if isinstance(number, Gradient) else np.zeros(self.count)

    def sqrt(self, value: Any, code: str, why: str) -> Any:
        root = self._floats.sqrt(_steady(value), code, why)
        if not isinstance(value, Gradient):
            return root
        return Gradient(root, value.partials / (2 * root) if root else 0 * value.partials)

    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        self._floats.nonzero(_steady(value), _steady(scale), code, why)
        return value

    def middle(self, value: Any) -> float:
        return _steady(value)

    def sign(self, value: Any, scale: Any) -> float:
        return self._floats.sign(_steady(value), _steady(scale))


def _steady(number: Any) -> float:
    """A number without its errors."""
    return number.value if isinstance(number, Gradient) else float(number)
