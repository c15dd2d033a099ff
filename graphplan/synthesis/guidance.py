"""Guidance of a plane through positions, by Burmester's points, and the linkage found.

A position takes the point w = u + iz of the moving plane to m + w e. Its positions lie on a circle about O where, for
each of them after the first, Re(conj(O) (A_k - A_1)) = (|A_k|^2 - |A_1|^2)/2, which is linear in w and in O: of four
positions the determinant of three such rows is 0, a cubic in u and z. It is plotted and not constructed, as in the
book.

Of two and three positions A and B are chosen in the plane, or O and C in the frame, and the others are centres of
circles, by bisectors. Of four positions A and B are points of the circle-point curve, of five Burmester's points: these
are computed and plotted, and their bisectors meet in one centre.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, permutations
from typing import Any

import numpy as np

from graphplan.errors import NoMechanism
from graphplan.kernel.program import Mark
from graphplan.phrases import digits, said
from graphplan.synthesis.driver import DrivingCrank
from graphplan.synthesis.linkage import FoundLinkage, best_first
from graphplan.synthesis.requests import CirclePointChoice
from graphplan.synthesis.sketch import (
    FIRST_THREE,
    Synthesis,
    SynthesisBoard,
    direction,
    largest,
    pair,
    place_of,
    require_circle,
    require_lengths,
)
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import GUESS_TOL, RESIDUAL_TOL, ROOT_TOL, SAME_POINT_TOL, SINE_TOL, STEP_TOL

Position = tuple[complex, complex]  # m and e
Array = Any
RESULTANT_DEGREE, ROTATIONS, NEWTON_ROUNDS = 9, (0.3, 1.1, 2.3), 60
FAR_SIZE = 1e6  # times the size of the task: a circle so far off is a straight line


def pole(one: Position, two: Position) -> complex | None:
    """The point of the moving plane that two positions have in the same place; None for a translation."""
    (m, e), (n, f) = one, two
    return None if abs(f - e) <= SINE_TOL else (m - n) / (f - e)


def poles(positions: Sequence[Position]) -> dict[str, complex | None]:
    """The poles of all pairs, by their numbers, in the moving plane."""
    return {f"{i + 1}{k + 1}": pole(positions[i], positions[k]) for i, k in combinations(range(len(positions)), 2)}


def place(position: Position, w: complex) -> complex:
    """Place of a point of the moving plane in a position."""
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
    """The circle through the poles of three positions: centre and radius; None if one is far or they are in line."""
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


def burmester_points(positions: Sequence[Position]) -> list[tuple[complex, complex]]:
    """The points of the moving plane that have five positions on a circle, each with its centre: zero, two or four."""
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
    """Yield possible crossings of two of the cubics of four positions: the real roots of their resultant, which is
    known by its values on a circle."""
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
    """The circle point of five positions near w with its centre, by Newton's rule; None if it does not converge."""
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


SLIDE = "another point, or guide it by a slide along that line"
WELL_CROSSING = 0.35  # a sine: bisectors that cross at no smaller angle are taken for a pole as they are there
POLE_ANGLES = 15, 165, 15  # degrees: at which pairs of circles give points of the centre-point curve


def synthesize_guidance(task: SynthesisTask) -> Synthesis:
    """All linkages that the task asks for, best first."""
    request = task.request
    positions = [(complex(x, y), direction(angle)) for x, y, angle in request.positions]
    results = pole_results(positions)
    if len(positions) == 5:
        dyads = burmester_points(positions)
        if not dyads:
            raise NoMechanism(f"{task.name}: guidance.positions", "no point of the plane has these five positions on a "
                              "circle", "another position, or four of them")
        results |= {"circle_points": [circle_point(w, O, positions) for w, O in dyads]}
        pairs: list[tuple[complex, ...]] = [*permutations([w for w, _ in dyads], 2)]
    elif len(positions) == 4:
        chosen = [chosen_point(f"{task.name}: guidance.moving.{k}", positions, point)
                  for k, point in enumerate(request.moving, 1)]
        listed = [*(w for u in request.table for w in circle_points(positions, u)), *chosen]
        results |= {"circle_points": [circle_point(w, centre(positions, w), positions)
                                      for w in distinct_points(listed)]}
        pairs = [(chosen[0], chosen[1])] if chosen else []
    else:
        pairs = [tuple(complex(*point) for point in request.moving)] if request.moving else [()]
    sketches = [GuidanceSketch(task, positions, points) for points in pairs or [()]]
    if request.driver:
        for start in sketches:
            start.drive()
    if not pairs:
        return Synthesis(task, (sketches[0].values,), (), results)
    linkages, values = best_first((start.linkage, start.values) for start in sketches)
    return Synthesis(task, values, linkages, results)


def distinct_points(points: Sequence[complex]) -> list[complex]:
    """Points without those that are there already."""
    distinct: list[complex] = []
    for w in points:
        if all(abs(w - earlier) > SAME_POINT_TOL * max(1.0, abs(w)) for earlier in distinct):
            distinct.append(w)
    return distinct


def circle_point(w: complex, O: complex, positions: Sequence[Position]) -> dict[str, Any]:
    """A circle point as results have it."""
    return {"u": w.real, "z": w.imag, "centre": pair(O), "radius": abs(place(positions[0], w) - O)}


def pole_results(positions: Sequence[Position]) -> dict[str, Any]:
    """Poles, and of four positions the inflection and return circles with Ball's point and the return point."""
    moving = poles(positions)
    fixed = {key: None if w is None else place(positions[int(key[0]) - 1], w) for key, w in moving.items()}
    results: dict[str, Any] = {"poles": {key: {"fixed": pair(at), "moving": pair(w)} if at is not None and w is not None
                                         else {"fixed": None, "moving": None}
                                         for (key, w), at in zip(moving.items(), fixed.values(), strict=True)}}
    if len(positions) == 4:
        for name, point, table in (("inflection", "ball", moving), ("return", "return_point", fixed)):
            circles = {f"{i}{j}{k}": inflection_circle([table[f"{i}{j}"], table[f"{i}{k}"], table[f"{j}{k}"]])
                       for i, j, k in combinations("1234", 3)}
            results[name] = {key: None if circle is None else {"centre": pair(circle[0]), "radius": circle[1]}
                             for key, circle in circles.items()}
            start, end, common = circles["123"], circles["124"], table["12"]
            if start is None or end is None or common is None:
                results[point] = None
            else:
                results[point] = pair(mirror_point(common, start[0], end[0]))
    return results


class GuidanceSketch:
    """The construction of one linkage; `points` are A and B in the moving plane, empty for fixed pivots."""

    def __init__(self, task: SynthesisTask, positions: Sequence[Position], points: Sequence[complex]):
        self.task, self.positions, self.points, self.sketch = task, positions, points, SynthesisBoard()
        self.size = largest([m for m, _ in positions] + [*points])
        self.M = [self.sketch.given(m, f"M_{k}", "M") for k, (m, _) in enumerate(positions, 1)]
        self.pivots = [self.sketch.given(complex(*point), name)
                       for point, name in zip(task.request.fixed, ("O", "C"), strict=False)]
        self._draw()
        self.values = self.sketch.values()
        if points or self.pivots:
            self.linkage = self._linkage()

    def _draw(self) -> None:
        """Stage by stage."""
        sketch, request = self.sketch, self.task.request
        with sketch.stage(said("Positions"), said("the origin M and the axis of the plane")):
            self.axes = [sketch.keep("axis", sketch.ray(M, angle)) for M, (_, _, angle) in
                         zip(self.M, request.positions, strict=True)]
        if self.pivots:
            for O, letter, name in zip(self.pivots, "OC", "AB", strict=True):
                self._centre_of_pivot(O, letter, name)
        for w, name, letter, k in zip(self.points, "AB", "OC", (0, 1), strict=False):
            if len(self.positions) == 2:
                self._apex(w, name, letter, request.turns[k])
            else:
                self._centre_of_circle(w, name, letter)
        self._poles()

    # ---- the centre of a moving point ------------------------------------------------------------------------------

    def _places(self, w: complex, name: str) -> list[Mark]:
        """A point of the plane in its positions."""
        return [self.sketch.keep(name, self.carry(w, k, f"{name}_{k + 1}")) for k in range(len(self.positions))]

    def carry(self, w: complex, k: int, name: str = "") -> Mark:
        """A point of the plane in a position."""
        if w == 0:
            return self.M[k]
        return self.sketch.board.set_off(self.axes[k], self.M[k], dx=w.real, dy=w.imag, ux=1, uy=0, name=name, why=said(
            "{0} along the axis, {1} to its left", digits(w.real, 5), digits(w.imag, 5)))

    def _apex(self, w: complex, name: str, letter: str, turn: float) -> None:
        """The apex of the isosceles triangle over both positions of a point."""
        board, sketch = self.sketch.board, self.sketch
        start, end = (place(position, w) for position in self.positions)
        if abs(end - start) <= SAME_POINT_TOL * self.size:
            raise NoMechanism(f"{self.task.name}: guidance.moving", f"{name}_1 and {name}_2 coincide: it is the pole "
                              "P_12", "another point")
        base = 90 - turn / 2
        law = said("the triangle over {0}_1 {0}_2 has the base angle (180° - {1}°)/2", name, digits(abs(turn)))
        with sketch.stage(said("Centre {0}", letter), law):
            A, B = self._places(w, name)
            across = sketch.keep("bisector", board.bisector(A, B))
            if abs(turn) == 180:
                sketch.keep(letter, board.meet(board.line(A, B), across, name=letter))
            else:
                chord = math.degrees(math.atan2((end - start).imag, (end - start).real))
                side = sketch.keep(f"base {name}", sketch.ray(A, chord + base))
                sketch.keep(letter, board.meet(across, side, name=letter))

    def _centre_of_circle(self, w: complex, name: str, letter: str) -> None:
        """The centre of the circle through the first three positions of a point, on all further bisectors too."""
        at = [place(position, w) for position in self.positions]
        names = " ".join(f"{name}_{k}" for k in range(1, 4))
        require_circle(f"{self.task.name}: guidance.moving", names, at[:3], self.size, SLIDE)
        law = said("it lies on the perpendicular bisectors of the positions of {0}", name)
        with self.sketch.stage(said("Centre {0}", letter), law):
            self.sketch.circle_through(self._places(w, name), letter,
                                       three=self.task.centres_by.get(letter, FIRST_THREE))

    def _centre_of_pivot(self, O: Mark, letter: str, name: str) -> None:
        """The moving point of a fixed pivot: the frame is turned back, the plane stands still in position 1."""
        board, sketch = self.sketch.board, self.sketch
        fixed = complex(*self.task.request.fixed["OC".index(letter)])
        turned = [place(self.positions[0], (fixed - m) / e) for m, e in self.positions]
        names = " ".join([letter, f"{letter}_2′", f"{letter}_3′"])
        require_circle(f"{self.task.name}: guidance.fixed", names, turned, self.size,
                       "another pivot, or a slide that turns on it")
        law = said("seen from the plane in position 1 the frame turns back, and {0} runs on a circle about {1}", letter,
                   name)
        with sketch.stage(said("Moving point {0}", name), law):
            E = [sketch.keep("E", board.set_off(axis, M, dx=self.size, dy=0, ux=1, uy=0, name=f"E_{k}"))
                 for k, (axis, M) in enumerate(zip(self.axes, self.M, strict=True), 1)]
            back = [board.triangle(self.M[k], E[k], O, self.M[0], E[0], name=f"{letter}_{k + 1}′") for k in (1, 2)]
            self.sketch.circle_through([O, *back], f"{name}_1", name)

    # ---- poles -----------------------------------------------------------------------------------------------------

    def _poles(self) -> None:
        """The poles, by the bisectors of two points each; of four positions the circles and curves over them."""
        board, sketch = self.sketch.board, self.sketch
        moving = poles(self.positions)
        with sketch.stage(said("Poles"), said("the bisectors of two points of the plane meet in the pole of two "
                                              "positions")):
            marks = {}
            for key, w in moving.items():
                if w is None:
                    continue
                i, k = (int(number) - 1 for number in key)
                start, end = self._far_from(w)
                lines = [board.bisector(*(self.carry(x, n, f"{self._letter(x)}_{n + 1}") for n in (i, k)))
                         for x in (start, end)]
                marks[key] = sketch.keep(f"P{key}", board.meet(*lines, name=f"P_{key}"))
        if len(self.positions) == 4 and len(marks) == 6:
            self._circles(marks, moving)
            self._curve(marks, moving)

    def _letter(self, x: complex) -> str:
        """The letter of a point by which poles are drawn: A and B, or by where it lies from the origin."""
        if x in self.points:
            return "AB"[self.points.index(x)]
        return "U" if x.real > 0 else "W" if x.real < 0 else "V"

    def _far_from(self, w: complex) -> tuple[complex, complex]:
        """Two points of the plane whose bisectors cross well in a pole: A and B, else those that are best seen from it.
        """
        def sine(start: complex, end: complex) -> float:
            across = (end - w) / (start - w)
            return abs(across.imag) / abs(across)

        h = self.size / 4
        distinct = [x for x in self.points if abs(x - w) > h / 8]
        if len(distinct) == 2 and sine(*distinct) >= WELL_CROSSING:
            return distinct[0], distinct[1]
        tried = [x for x in (0j, complex(h), 1j * h, complex(-h)) if abs(x - w) > h / 8]
        return max(combinations(tried, 2), key=lambda ends: sine(*ends))

    def _circles(self, marks: dict[str, Mark], moving: dict[str, complex | None]) -> None:
        """Two inflection circles, through the poles carried into position 1, and Ball's point; two return circles and
        the return point: in each case the crossing that is no pole."""
        board, sketch = self.sketch.board, self.sketch
        circles = [inflection_circle([moving["12"], moving[f"1{k}"], moving[f"2{k}"]]) for k in "34"]
        if None in circles:
            return
        law = said("two of the circles cross in a pole, and in this point")
        with sketch.stage(said("Ball's point"), law):
            back = [sketch.keep("pole back", self.carry(moving[key] or 0j, 0, f"P_{key}′")) for key in ("23", "24")]
            centres = [sketch.circle_through([marks["12"], marks[key], mark], "", "inflection centre")
                       for key, mark in zip(("13", "14"), back, strict=True)]
            for start in centres:
                sketch.keep("inflection circle", board.circle(start, board.opening(start, marks["12"])))
            F = board.foot(board.line(*centres), marks["12"])
            sketch.keep("ball", board.step_off(marks["12"], F, F, ratio=1, name="B_a"))
        with sketch.stage(said("Return point"), law):
            centres = [sketch.circle_through([marks["12"], marks[start], marks[end]], "", "return centre")
                       for start, end in (("13", "23"), ("14", "24"))]
            for start in centres:
                sketch.keep("return circle", board.circle(start, board.opening(start, marks["12"])))
            F = board.foot(board.line(*centres), marks["12"])
            sketch.keep("return point", board.step_off(marks["12"], F, F, ratio=1, name="G"))

    def _curve(self, marks: dict[str, Mark], moving: dict[str, complex | None]) -> None:
        """Points of the centre-point curve: they see opposite sides of the quadrilateral P12 P23 P34 P14 alike."""
        board, sketch = self.sketch.board, self.sketch
        fixed = {key: place(self.positions[int(key[0]) - 1], w) for key, w in moving.items() if w is not None}
        sides = ("12", "23"), ("14", "34")
        law = said("from them opposite sides of the quadrilateral P_12 P_23 P_34 P_14 are seen under one angle: two "
                   "circles over these cross there")
        with sketch.stage(said("Centre-point curve"), law):
            for start, end in (*sides, ("23", "34"), ("12", "14")):
                sketch.keep("quadrilateral", board.line(marks[start], marks[end]))
            middles = [board.midpoint(marks[start], marks[end]) for start, end in sides]
            for angle in range(POLE_ANGLES[0], POLE_ANGLES[1] + 1, POLE_ANGLES[2]):
                ratio = 0.0 if angle == 90 else 0.5 / math.tan(math.radians(angle))
                centres = [(fixed[start] + fixed[end]) / 2 + 1j * ratio * (fixed[end] - fixed[start])
                           for start, end in sides]
                radii = [abs(c - fixed[start]) for c, (start, _) in zip(centres, sides, strict=True)]
                if not 1.001 * abs(radii[0] - radii[1]) < abs(centres[0] - centres[1]) < 0.999 * sum(radii):
                    continue
                about = [board.step_across(marks[start], marks[end], middle, ratio=ratio, why=said(
                    "the side is seen under {0}°", angle)) for (start, end), middle in zip(sides, middles, strict=True)]
                circles = [board.circle(c, board.opening(c, marks[start]))
                           for c, (start, _) in zip(about, sides, strict=True)]
                for side in ("left", "right"):
                    sketch.keep("centre point", board.circles_meet(*circles, side=side))

    # ---- the result ------------------------------------------------------------------------------------------------

    def _linkage(self) -> FoundLinkage:
        """The linkage as it is drawn."""
        values, frame = self.values, self.positions[0]
        O, C = (place_of(values, letter) for letter in "OC")
        A, B = ([complex(*at) for at in values.values_of_role(name)] for name in "AB")
        if self.pivots:
            A, B = ([place(position, (at[0] - frame[0]) / frame[1]) for position in self.positions] for at in (A, B))
        long = abs(B[0] - A[0])
        carried = {"M": tuple(m for m, _ in self.positions), "N": tuple(m + long * e for m, e in self.positions)}
        linkage = FoundLinkage(O, tuple(A), tuple(B), C, carried=carried)
        return require_lengths(linkage, f"{self.task.name}: guidance", self.size, "other points")

    def drive(self) -> None:
        """Add a crank that swings OA from the first position to the last, where the linkage goes through them."""
        if not (self.points or self.pivots):
            return
        if self.linkage.travel is None:
            self.linkage = replace(self.linkage, further={"driver": None})
            return
        crank = DrivingCrank.of_linkage(self.task, self.linkage)
        A = self.sketch.roles["A"]
        ends = (A[0], A[-1]) if len(A) == len(self.positions) else self._ends_of_OA()
        crank.draw(self.sketch, self.sketch.roles["O"][0], *ends)
        self.values = self.sketch.values()
        self.linkage = replace(self.linkage, further={"driver": crank.results})

    def _ends_of_OA(self) -> tuple[Mark, Mark]:  # noqa: N802
        """Of pivots that are given: A in the first position, and carried by the plane into the last."""
        board, M, E = self.sketch.board, self.M, self.sketch.roles["E"]
        A = self.sketch.roles["A"][0]
        with self.sketch.stage(said("Driving crank"), said("the plane carries A into its last position")):
            return A, board.triangle(M[0], E[0], A, M[-1], E[-1], name=f"A_{len(M)}")
