"""Complex numbers of a tape, so that the compass rules of the cycle can be recorded as they stand."""

from __future__ import annotations

import math
from typing import Any

from graphplan.kernel.tape.record import Symbol


class Planar:
    """A complex number of symbols, as the compass rules compute with it."""

    __slots__ = ("im", "re")

    def __init__(self, re: Any, im: Any = 0.0):
        self.re, self.im = re, im

    @property
    def real(self) -> Planar:
        return Planar(self.re)

    @property
    def imag(self) -> Planar:
        return Planar(self.im)

    def conj(self) -> Planar:
        return Planar(self.re, -self.im)

    def sqrt(self) -> Planar:
        """The square root of a real number: numpy asks for it by this name."""
        return Planar(self.re.tape.sqrt(self.re.place) if isinstance(self.re, Symbol) else math.sqrt(self.re))

    def __add__(self, other: Any) -> Planar:
        other = planar(other)
        return Planar(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Any) -> Planar:
        return self + -planar(other)

    def __rsub__(self, other: Any) -> Planar:
        return planar(other) + -self

    def __neg__(self) -> Planar:
        return Planar(-self.re, -self.im)

    def __mul__(self, other: Any) -> Planar:
        other = planar(other)
        return Planar(_product(self.re, other.re) - _product(self.im, other.im),
                      _product(self.re, other.im) + _product(self.im, other.re))

    def __truediv__(self, other: Any) -> Planar:
        other = planar(other)
        if _nothing(other.im):
            return Planar(self.re / other.re, 0.0 if _nothing(self.im) else self.im / other.re)
        size = other.re * other.re + other.im * other.im
        product = self * other.conj()
        return Planar(product.re / size, product.im / size)

    def __pow__(self, power: int) -> Planar:
        assert power == 2
        return self * self

    def __rtruediv__(self, other: Any) -> Planar:
        return planar(other) / self

    __radd__, __rmul__ = __add__, __mul__


def _nothing(number: Any) -> bool:
    return not isinstance(number, Symbol) and number == 0


def _product(one: Any, two: Any) -> Any:
    return 0.0 if _nothing(one) or _nothing(two) else one * two


def planar(number: Any) -> Planar:
    """Any number, or pair of them, as a complex one."""
    if isinstance(number, Planar):
        return number
    return Planar(*number) if isinstance(number, tuple) else Planar(float(number.real), float(number.imag))
