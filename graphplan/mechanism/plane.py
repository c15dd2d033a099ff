"""Vectors of the plane over any numbers that know + - * : floats, fractions, residues, power series, arrays."""

from __future__ import annotations

from fractions import Fraction

Number = Fraction | float
Pair = tuple[Number, Number]

X: Pair = (1, 0)
Y: Pair = (0, 1)


def plus(a: Pair, b: Pair) -> Pair:
    """The sum of two vectors."""
    return a[0] + b[0], a[1] + b[1]


def less(a: Pair, b: Pair) -> Pair:
    """The vector from b to a."""
    return a[0] - b[0], a[1] - b[1]


def times(factor: Number, a: Pair) -> Pair:
    """The vector a, `factor` times as long."""
    return factor * a[0], factor * a[1]


def turned(a: Pair) -> Pair:
    """The vector a, turned counter-clockwise by a quarter."""
    return -a[1], a[0]


def dot(a: Pair, b: Pair) -> Number:
    """The scalar product of a and b."""
    return a[0] * b[0] + a[1] * b[1]
