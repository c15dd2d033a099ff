"""What centres of curvature must satisfy: the laws of Euler and Savary, tested on numbers."""

from __future__ import annotations

import math
from collections.abc import Callable

from graphplan.kernel.drawn import Drawn, cross3, dot, unit


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
