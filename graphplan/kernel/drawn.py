"""One drawn step in numbers, as claims look at it, and what they ask of vectors: complex numbers all of them.

What centres of curvature must satisfy: the laws of Euler and Savary, tested on numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
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


def _third_error(d: Drawn, K: int, A: int, m: int, w: int) -> float:
    """The length mw is the mean proportional of KA and what is laid off."""
    KA, mean, drawn_length = abs(d[A] - d[K]), abs(d[w] - d[m]), abs(d[-1] - d[K])
    return (drawn_length * KA - mean * mean) / KA / (d.size + drawn_length)


def _curvature_error(d: Drawn, P: int, M: int, W: int) -> float:
    """What is left of PM^2 = MW * MC, W being the foot of the inflection pole on the ray."""
    ray = unit(d[P] - d[M])
    mean, foot, radius = abs(d[P] - d[M]), dot(ray, d[W] - d[M]), dot(ray, d[-1] - d[M])
    return (mean * mean - foot * radius) / d.size / (d.size + abs(radius))


def _conjugate_error(d: Drawn, P: int, A: int, A0: int, B: int, B0: int, M: int) -> float:
    """On each ray lay off 1/PX - 1/PX_0 from the pole: the ends lie on one line, the inverse of the inflection circle.
    """
    rows = []
    for X, X0 in ((A, A0), (B, B0)):
        near, ray = abs(d[X] - d[P]), unit(d[X] - d[P])
        gap = dot(ray, d[X0] - d[X])
        row = ray.real * gap, ray.imag * gap, near * (near + gap) / d.size
        rows.append((row[0] / math.hypot(*row), row[1] / math.hypot(*row), row[2] / math.hypot(*row)))
    x, y, w = cross3(*rows)  # of the line through the two ends; the flatter the rays cross, the less it tells
    near, ray = abs(d[M] - d[P]), unit(d[M] - d[P])
    far, across = dot(ray, d[-1] - d[P]), x * ray.real + y * ray.imag
    return (far * (across + w * near / d.size) - near * across) / (d.size + abs(far))


CURVATURE_CLAIMS: dict[str, tuple[Callable[..., float], str]] = {
    "third": (_third_error, "the length from {2} to {3} is no mean proportional"),
    "curved": (_curvature_error, "not the centre of curvature that the inflection pole {2} gives {1}"),
    "conjugate": (_conjugate_error, "no centre of curvature of {5} by Euler and Savary"),
}
