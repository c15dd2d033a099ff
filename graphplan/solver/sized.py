"""Arrays of poses that know the size of what cancels in them: a value, and the size of the terms that it is made of."""

from __future__ import annotations

from typing import Any

import numpy as np


class Sized:
    """Numbers over n poses with the sizes of their terms, which are their own at least."""

    __slots__ = ("size", "value")
    __array_ufunc__ = None  # numpy's own numbers leave the arithmetic to this class

    def __init__(self, value: Any, size: Any = None):
        self.value, self.size = value, np.abs(value) if size is None else size

    def __neg__(self) -> Sized:
        return Sized(-self.value, self.size)

    def __add__(self, other: Any) -> Sized:
        two = sized(other)
        return Sized(self.value + two.value, self.size + two.size)

    def __sub__(self, other: Any) -> Sized:
        return self + -sized(other)

    def __rsub__(self, other: Any) -> Sized:
        return sized(other) + -self

    def __mul__(self, other: Any) -> Sized:
        two = sized(other)
        size = np.maximum(np.abs(self.value) * two.size, np.abs(two.value) * self.size)
        return Sized(self.value * two.value, size)

    def __truediv__(self, other: Any) -> Sized:
        two = sized(other)
        value, least = self.value / two.value, np.abs(two.value)
        return Sized(value, np.maximum(self.size, np.abs(value) * two.size) / least)

    __radd__, __rmul__ = __add__, __mul__


def sized(number: Any) -> Sized:
    """A number, or an array of them, as it is given."""
    return number if isinstance(number, Sized) else Sized(np.asarray(number, dtype=float))
