"""Where points stand, in closed form over true lengths: complex numbers of the plane."""

from __future__ import annotations

import cmath
from math import radians, sqrt


def turn(degrees: float) -> complex:
    """The unit vector at an angle to the x axis."""
    return cmath.exp(1j * radians(degrees))


def tip(A: complex, a: float, B: complex, b: float) -> complex:
    """The point at the distance a from A and b from B, to the left of the ray from A to B."""
    c = abs(B - A)
    x = (a * a - b * b + c * c) / (2 * c)
    return A + (B - A) / c * complex(x, sqrt(a * a - x * x))


def reach(A: complex, a: float, P: complex, along: complex) -> complex:
    """The point at the distance a from A on the line through P, the one farther on along it."""
    u = along / abs(along)
    foot = P + u * ((A - P) * u.conjugate()).real
    return foot + u * sqrt(a * a - abs(A - foot) ** 2)


def towards(A: complex, a: float, B: complex) -> complex:
    """The point at the distance a from A on the ray to B."""
    return A + a * (B - A) / abs(B - A)


def seat(A: complex, B: complex, at: complex) -> complex:
    """The place `at` of a body whose origin is A and whose x axis goes through B."""
    return A + (B - A) / abs(B - A) * at


def mirror(P: complex, A: complex, B: complex) -> complex:
    """The image of P in the line AB."""
    return A + ((P - A) / (B - A)).conjugate() * (B - A)


def scissors(stages: int, foot: float) -> list[complex]:
    """Bars of 200 with their feet so far apart: the left ends upwards, the right ends, the crossings."""
    height = sqrt(200**2 - foot**2)
    ends = [1j * k * height for k in range(stages + 1)]
    return [*ends, *(foot + z for z in ends), *(foot / 2 + 1j * (k + 0.5) * height for k in range(stages))]
