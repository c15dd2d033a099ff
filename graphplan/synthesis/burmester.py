"""Four and five positions of a plane: circle points and their centres as numbers (Burmester; Ozols 1974, 22-7).

A position takes the point w = u + iz of the moving plane to m + w e. Its positions lie on a circle about O where, for
each of them after the first, Re(conj(O) (A_k - A_1)) = (|A_k|^2 - |A_1|^2)/2, which is linear in w and in O: of four
positions the determinant of three such rows is 0, a cubic in u and z. It is plotted and not constructed, as in the
book.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

import numpy as np

from graphplan.errors import NoMechanism
from graphplan.synthesis.requests import CirclePointChoice
from graphplan.synthesis.tolerances import GUESS_TOL, RESIDUAL_TOL, ROOT_TOL, SAME_POINT_TOL, SINE_TOL, STEP_TOL

Position = tuple[complex, complex]  # m and e
Array = Any
RESULTANT_DEGREE, ROTATIONS, NEWTON_ROUNDS = 9, (0.3, 1.1, 2.3), 60
FAR_SIZE = 1e6  # times the size of the task: a circle so far off is a straight line


def pole(one: Position, two: Position) -> complex | None:
    """The point of the moving plane that two positions have in the same place; none where they are only shifted."""
    (m, e), (n, f) = one, two
    return None if abs(f - e) <= SINE_TOL else (m - n) / (f - e)


def poles(positions: Sequence[Position]) -> dict[str, complex | None]:
    """The poles of all pairs, by their numbers, in the moving plane."""
    return {f"{i + 1}{k + 1}": pole(positions[i], positions[k]) for i, k in combinations(range(len(positions)), 2)}


def place(position: Position, w: complex) -> complex:
    """Where a point of the moving plane is in a position."""
    return position[0] + position[1] * w


def rows(positions: Sequence[Position], w: complex) -> Array:
    """A row for each position after the first: x and y of A_k - A_1, and half the difference of the squares."""
    A = [m + e * w for m, e in positions]
    return np.array([[(X - A[0]).real, (X - A[0]).imag, (abs(X) ** 2 - abs(A[0]) ** 2) / 2] for X in A[1:]])


def centre(positions: Sequence[Position], w: complex) -> complex:
    """The centre of a circle point, or the best that there is."""
    table = rows(positions, w)
    (x, y), *_ = np.linalg.lstsq(table[:, :2], table[:, 2], rcond=None)
    return complex(x, y)


def centre_positions(positions: Sequence[Position]) -> tuple[list[Position], complex, float]:
    """The positions about their middle and of size 1, that middle, and their size."""
    middle = sum(m for m, _ in positions) / len(positions)
    size = max(abs(m - middle) for m, _ in positions) or 1.0
    return [((m - middle) / size, e) for m, e in positions], middle, size


def cubic(positions: Sequence[Position], u: complex) -> Array:
    """The coefficients of the cubic in z, from the constant on, of four positions at u, which may be complex."""
    lines, (m, e) = list[Any](), positions[0]
    for n, f in positions[1:]:
        D, slope = n - m, f - e
        c = n.conjugate() * f - m.conjugate() * e  # half of |A_k|^2 - |A_1|^2 grows by the real part of this times w
        lines.append([[D.real + u * slope.real, -slope.imag], [D.imag + u * slope.imag, slope.real],
                      [(abs(n) ** 2 - abs(m) ** 2) / 2 + u * c.real, -c.imag]])
    product, ((a, b, k), (p, q, r), (x, y, z)) = np.convolve, lines
    return (product(a, product(q, z) - product(r, y)) - product(b, product(p, z) - product(r, x))
            + product(k, product(p, y) - product(q, x)))


def real_roots(coefficients: Array) -> list[float]:
    """The real roots of a polynomial from the constant on, rising, each bettered by Newton's rule."""
    largest = abs(coefficients).max()
    leading = np.trim_zeros(np.where(abs(coefficients) > ROOT_TOL**2 * largest, coefficients, 0.0), "b")
    roots = np.roots(leading[::-1])
    slope, rising = np.polyder(leading[::-1]), leading[::-1]
    values = []
    for root in roots:
        if abs(root.imag) <= ROOT_TOL * max(1.0, abs(root)):
            z = float(root.real)
            for _ in range(3):
                steep = np.polyval(slope, z)
                z -= float(np.polyval(rising, z) / steep) if abs(steep) > ROOT_TOL * largest else 0.0
            values.append(z)
    return sorted(values)


def circle_points(positions: Sequence[Position], u: float) -> list[complex]:
    """The points of the circle-point curve at u, by rising z."""
    near, _, size = centre_positions(positions)
    # the moving plane is scaled with the fixed one, its origin stays
    return [size * complex(u / size, z) for z in real_roots(cubic(near, u / size))]


def chosen_point(where: str, positions: Sequence[Position], choice: CirclePointChoice) -> complex:
    """The chosen point of the circle-point curve; fails with `NoMechanism` where it has fewer roots there."""
    points = circle_points(positions, choice.u)
    if choice.root > len(points):
        raise NoMechanism(where, f"at u = {choice.u:g} the circle-point curve has {len(points)} real points",
                          "a root up to that number, or another u")
    return points[choice.root - 1]


def inflection_circle(points: Sequence[complex | None]) -> tuple[complex, float] | None:
    """The circle through the poles of three positions: centre and radius; none where one is far or they are in line."""
    if any(point is None for point in points):
        return None
    p, q, r = (point for point in points if point is not None)
    u, v = q - p, r - p
    if not abs(u) or abs((v / u).imag) <= SINE_TOL:
        return None
    middle = p + 1j * (u * abs(v) ** 2 - v * abs(u) ** 2) / (2 * (v * u.conjugate()).imag)
    return middle, abs(middle - p)


def mirror_point(point: complex, one: complex, two: complex) -> complex:
    """A point on the other side of a line through two others."""
    u = (two - one) / abs(two - one)
    return one + u * u * ((point - one).conjugate())


# ---- five positions -------------------------------------------------------------------------------------------------


def burmester_points(positions: Sequence[Position]) -> list[tuple[complex, complex]]:
    """The points of the moving plane that have five positions on a circle, each with its centre: none, two or four."""
    near, middle, size = centre_positions(positions)
    dyads: list[tuple[complex, complex]] = []
    for rotation in ROTATIONS:
        turn = cmath.rect(1.0, rotation)
        for w in _common_points([(m, e * turn) for m, e in near]):
            dyad = _polish(near, w * turn)
            if dyad and all(abs(dyad[0] - other) > SAME_POINT_TOL**0.5 for other, _ in dyads):
                dyads.append(dyad)
    return sorted(((size * w, size * O + middle) for w, O in dyads), key=lambda dyad: (dyad[0].real, dyad[0].imag))


def _common_points(positions: Sequence[Position]) -> Iterator[complex]:
    """Where two of the cubics of four positions may cross: the real roots of their resultant, which is known by its
    values on a circle."""
    count = RESULTANT_DEGREE + 1
    u = np.exp(2j * np.pi * np.arange(count) / count)
    one, two = (np.array([cubic([*positions[:3], positions[k]], place) for place in u]).T for k in (3, 4))
    sylvester = np.zeros((count, 6, 6), complex)
    for k in range(3):
        for power in range(4):
            sylvester[:, k, k + power] = one[power]
            sylvester[:, k + 3, k + power] = two[power]
    coefficients = (np.fft.fft(np.linalg.det(sylvester)) / count).real
    leading = np.trim_zeros(np.where(abs(coefficients) > SINE_TOL * abs(coefficients).max(), coefficients, 0.0), "b")
    for root in np.roots(leading[::-1]):
        if abs(root.imag) <= GUESS_TOL * max(1.0, abs(root)):
            later = np.roots(cubic([*positions[:3], positions[3]], root.real)[::-1])
            yield from (complex(root.real, z.real) for z in later)


def _polish(positions: Sequence[Position], w: complex) -> tuple[complex, complex] | None:
    """The circle point of five positions near w with its centre, by Newton's rule; none where it leads to none."""
    O = centre(positions, w)
    (_, e), later = positions[0], positions[1:]
    for _ in range(NEWTON_ROUNDS):
        if not max(abs(w), abs(O)) < FAR_SIZE:
            return None
        first = place(positions[0], w) - O
        A = [place(position, w) - O for position in later]
        residual = np.array([(abs(X) ** 2 - abs(first) ** 2) / 2 for X in A])
        jacobian = np.array([[c.real, -c.imag, (first - X).real, (first - X).imag]
                             for X, (_, f) in zip(A, later, strict=True)
                             for c in (X.conjugate() * f - first.conjugate() * e,)])
        try:
            step = np.linalg.solve(jacobian, -residual)
        except np.linalg.LinAlgError:
            return None
        w, O = w + complex(*step[:2]), O + complex(*step[2:])
        if abs(step).max() <= STEP_TOL * max(1.0, abs(w), abs(O)):
            break
    A = [place(position, w) for position in positions]
    spread = max(abs(abs(X - O) - abs(A[0] - O)) for X in A)
    apart = min(abs(X - Y) for X, Y in combinations(A, 2))
    return (w, O) if spread <= RESIDUAL_TOL * max(1.0, abs(w), abs(O)) and apart > SAME_POINT_TOL else None
