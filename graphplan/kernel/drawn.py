"""One drawn step in numbers, as claims look at it, and what they ask of vectors: complex numbers all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.program import Step
from graphplan.kernel.tolerances import ULP

Vector = tuple[int, int]


class Drawn:
    """One step in numbers: its operands by place, -1 being what it made. Points and vectors are complex numbers.

    Lengths count beside the `size` of what the step was made from, and that as no less than `least`.
    """

    def __init__(self, step: Step, values: Sequence[Any], least: float = 0.0):
        self.kinds = (*step.op.reads, step.op.gives)
        self.numbers = [tuple(map(float, values[index])) for index in (*step.args, step.index)]
        self.params = step.params
        self.size = max(least, *map(_extent, self.kinds, self.numbers)) or 1.0

    def __getitem__(self, k: int) -> complex:
        """The point, or the centre of the circle, at a place."""
        return complex(*self.numbers[k][:2])

    def vector(self, ends: Vector) -> complex:
        return self[ends[1]] - self[ends[0]]

    def direction(self, k: int) -> complex:
        """The unit vector along which a line runs."""
        a, b, _ = self.numbers[k]
        return complex(b, -a) / math.hypot(a, b)

    def distance_off(self, k: int, X: complex) -> float:
        """How far a point lies to the left of a line, or outside a circle."""
        a, b, c = self.numbers[k]
        if self.kinds[k] == CIRCLE:
            return abs(X - complex(a, b)) - math.sqrt(c)
        return (a * X.real + b * X.imag + c) / math.hypot(a, b)

    def radius(self, k: int) -> float:
        """The radius of a circle, or the distance in the compasses."""
        return math.sqrt(self.numbers[k][-1])

    def number(self, name: str) -> float:
        return float(self.params.get(name, 0))

    def turn_to_image(self, u: complex) -> complex:
        """A vector of the link as its image runs."""
        return u if self.params["turn"] == "parallel" else 1j * u


def roundings(kind: str, numbers: tuple[float, ...], extent: float) -> list[float]:
    """What rounding may make the numbers of a thing be off that is drawn in a figure of this extent."""
    if kind == LINE:
        across = math.hypot(*numbers[:2])
        return [ULP * across, ULP * across, ULP * max(abs(numbers[2]), across * extent)]
    far = [ULP * max(abs(number), extent) for number in numbers]
    return far if kind == POINT else [*far[:-1], ULP * max(numbers[-1], extent * extent)]


def _extent(kind: str, numbers: tuple[float, ...]) -> float:
    """How far from the origin a thing reaches, or how large it is."""
    if kind == LINE:
        return abs(numbers[2]) / math.hypot(numbers[0], numbers[1])
    if kind == POINT:
        return math.hypot(*numbers)
    return math.hypot(*numbers[:-1]) + math.sqrt(numbers[-1])


def unit(u: complex) -> complex:
    return u / (abs(u) or 1.0)


def dot(u: complex, v: complex) -> float:
    return (u.conjugate() * v).real


def cross(u: complex, v: complex) -> float:
    return (u.conjugate() * v).imag


def sideways(u: complex, v: complex) -> float:
    """What of u stands square to v: all of it, where v has no direction."""
    return cross(unit(v), u) if v else abs(u)


def component_along(u: complex, v: complex) -> float:
    """What of u runs along v."""
    return dot(unit(v), u)


def short(length: float, ahead: bool) -> float:
    """By how much a length is not ahead, or not back, where it should be."""
    return max(0.0, -length if ahead else length)


def cross3(u: Sequence[float], v: Sequence[float]) -> tuple[float, float, float]:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]
