"""Drawings of the packaged tasks as students make them, by the textbook alone: on paper of their own, at a scale and
with choices of their own, with a hand that shakes, and where it is asked for with one mistake. Shares nothing with what
writes sheets.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

import graphplan as gp

Line = tuple[complex, complex]
DEGREE = math.pi / 180
PLANES = [(0, 0, 30), (40, 22, 5), (85, 20, -25)]
BURMESTER = [(0, 0, 90), (5.6, 6.4, 0), (13.45, 7.6, -60), (22.25, 2.95, -120)]


def e(degrees: float) -> complex:
    return cmath.rect(1.0, degrees * DEGREE)


@dataclass
class Board:
    """One sheet of a student: `scale` mm a unit, points by their letters in mm; `wrong` is the mistake to make."""

    rng: np.random.Generator
    scale: float
    wrong: str = ""
    sigma: float = 0.12
    points: dict[str, complex] = field(default_factory=dict)
    threes: dict[str, tuple[int, ...]] = field(default_factory=dict)  # by which points of four a centre is to be drawn
    guilty: str = ""  # the letter of the mark at which the mistake was made

    def shake(self, size: float = 1.0) -> complex:
        return complex(*self.rng.normal(0, self.sigma * size, 2))

    def mark(self, name: str, z: complex) -> complex:
        """Prick a point."""
        self.points[name] = z + self.shake()
        return self.points[name]

    def slips(self, mistake: str, name: str = "") -> bool:
        """Whether the mistake is made here, at a mark."""
        if self.wrong == mistake and not self.guilty:
            self.guilty = name
            return True
        return False

    def line(self, P: complex, Q: complex) -> Line:
        """A ruler laid at two points, each a little off."""
        return P + self.shake(0.7), Q + self.shake(0.7)

    def ray(self, P: complex, degrees: float) -> Line:
        return P + self.shake(0.7), P + cmath.rect(120.0, degrees * DEGREE) + self.shake(0.7)

    def bisector(self, P: complex, Q: complex) -> Line:
        """By two arcs that cross on either side."""
        reach = max(abs(Q - P), 60.0) * 0.7
        middle, across = (P + Q) / 2, 1j * (Q - P) / abs(Q - P)
        return self.line(middle + reach * across, middle - reach * across)

    def centre(self, name: str, P: complex, Q: complex, R: complex) -> complex:
        """The centre of the circle through three points, by two of the three bisectors."""
        pairs = [(P, Q), (Q, R), (P, R)]
        first, second = self.rng.permutation(3)[:2]
        lines = [self.bisector(*pairs[first]), self.bisector(*pairs[second])]
        if self.slips("slanting bisector", name):
            a, b = lines[0]
            middle = (a + b) / 2
            lines[0] = middle, middle + (b - a) * e(14)
        return self.mark(name, cross(*lines))


def cross(one: Line, other: Line) -> complex:
    (a, b), (c, d) = one, other
    u, v = b - a, d - c
    return a + u * ((c - a).conjugate() * v).imag / (u.conjugate() * v).imag


def circle_cuts(line: Line, centre: complex, radius: float) -> list[complex]:
    """Where a line cuts a circle, along the line."""
    a, u = line[0], (line[1] - line[0]) / abs(line[1] - line[0])
    foot = a + ((centre - a) * u.conjugate()).real * u
    half = math.sqrt(max(radius**2 - abs(foot - centre) ** 2, 0.0))
    return [foot - half * u, foot + half * u]


def circles_cut(A: complex, a: float, B: complex, b: float) -> list[complex]:
    """Where two circles cross, left and right of the way from A to B."""
    d = abs(B - A)
    x = (a * a - b * b + d * d) / (2 * d)
    return [A + (B - A) / d * complex(x, sign * math.sqrt(max(a * a - x * x, 0.0))) for sign in (1, -1)]


def planes(board: Board, positions: list[tuple[float, float, float]]) -> list[complex]:
    return [board.mark(f"M_{k}", complex(x, y) * board.scale) for k, (x, y, _) in enumerate(positions, 1)]


def carry(board: Board, name: str, M: list[complex], angles: list[float], w: complex) -> list[complex]:
    """A point of the plane in its positions."""
    places, whole = [], board.slips("z reversed", f"{name}_1")
    for k, (m, angle) in enumerate(zip(M, angles, strict=True), 1):
        one = k == 2 and board.slips("one z reversed", f"{name}_2")
        own = w.conjugate() if whole or one else w
        turn = -angle if k == 3 and board.slips("axis clockwise", f"{name}_3") else angle
        places.append(board.mark(f"{name}_{k}", m + own * board.scale * e(turn)))
    return places


def guidance_moving(board: Board) -> None:
    M, angles = planes(board, PLANES), [angle for *_, angle in PLANES]
    for name, letter, w in (("A", "O", -35j), ("B", "C", 55 - 20j)):
        board.centre(letter, *carry(board, name, M, angles, w))


def guidance_fixed(board: Board) -> None:
    M, angles = planes(board, PLANES), [angle for *_, angle in PLANES]
    base = int(board.rng.integers(3))
    for letter, name, z in (("O", "A", 140 - 30j), ("C", "B", 110 - 90j)):
        pivot = board.mark(letter, z * board.scale)
        back = [pivot]
        for k in range(3):
            if k != base:
                mark = f"{letter}_{k + 1}'"
                turn = angles[base] - angles[k]
                turn = -turn if board.slips("turned forwards", mark) else turn
                back.append(board.mark(mark, M[base] + (pivot - M[k]) * e(turn)))
        board.centre(f"{name}_{base + 1}", *back)


def circle_roots(u: float) -> list[float]:
    """The z at which the four places of u + iz lie on a circle, ascending."""
    def off(z: float) -> float:
        a, b, c, d = (complex(x, y) + complex(u, z) * e(angle) for x, y, angle in BURMESTER)
        return ((a - c) * (b - d) / ((b - c) * (a - d))).imag * abs((b - c) * (a - d)) ** 2

    grid = np.linspace(-60, 60, 6001)
    values = [off(z) for z in grid]
    roots = []
    for low, high, first, second in zip(grid, grid[1:], values, values[1:], strict=False):
        if first * second < 0:
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if off(middle) * first > 0 else (low, middle)
            roots.append(float(low))
    return roots


def guidance_four(board: Board) -> None:
    M, angles = planes(board, BURMESTER), [angle for *_, angle in BURMESTER]
    for name, letter, u in (("A", "O", 8.0), ("B", "C", 0.0)):
        z = board.rng.choice(circle_roots(u))
        places = carry(board, name, M, angles, complex(u, z))
        board.centre(letter, *(places[k] for k in board.threes.get(letter, sorted(board.rng.permutation(4)[:3]))))


def function_rocker(board: Board) -> None:
    phi, psi, s = [40, 70, 115], [82.3, 91.9, 116.2], board.scale
    O, C = board.mark("O", 0j), board.mark("C", 100 * s)
    A = []
    for k in range(3):
        angle = 180 - phi[k] if k == 1 and board.slips("supplement", "A_2") else phi[k]
        A.append(board.mark(f"A_{k + 1}", O + 40 * s * e(angle)))
    base = int(board.rng.integers(3))
    back = [A[base]]
    for k in range(3):
        if k != base:
            mark = f"A_{k + 1}'"
            turn = psi[base] - psi[k]
            turn = -turn if board.slips("turned forwards", mark) else turn
            about = O if board.slips("wrong pivot", mark) else C
            back.append(board.mark(mark, about + (A[k] - about) * e(turn)))
    board.centre(f"B_{base + 1}", *back)


def function_slide(board: Board) -> None:
    phi, at, s = [35, 65, 110], [168.7, 141.9, 102.8], board.scale
    O = board.mark("O", 0j)
    B = [board.mark(f"B_{k + 1}", complex(at[k], -15) * s) for k in range(3)]
    base = int(board.rng.integers(3))
    back = [B[base]]
    for k in range(3):
        if k != base:
            mark = f"B_{k + 1}'"
            turn = phi[base] - phi[k]
            turn = -turn if board.slips("turned forwards", mark) else turn
            back.append(board.mark(mark, O + (B[k] - O) * e(turn)))
    board.centre(f"A_{base + 1}", *back)


def dead_positions(board: Board, O: complex, B1: complex, B2: complex) -> None:
    r = (abs(B1 - O) - abs(B2 - O)) / 2
    r = 2 * r if board.slips("not halved", "A_1") else r
    board.mark("A_1", O + r * (B1 - O) / abs(B1 - O))
    way = 1 if board.slips("towards B_2", "A_2") else -1
    board.mark("A_2", O + way * r * (B2 - O) / abs(B2 - O))


ALPHA = 180 * 0.2 / 2.2


def slider_crank(board: Board) -> None:
    s = board.scale
    B1, B2 = board.mark("B_1", 100 * s), board.mark("B_2", 0j)
    angle = 90 - ALPHA if board.slips("complement", "O") else ALPHA
    radius = 50 * s / math.sin(angle * DEGREE)
    F = complex(50 * s, -50 * s / math.tan(angle * DEGREE))
    guide = (-30 * s * 1j, 100 * s - 30 * s * 1j)
    if board.slips("offset doubled", "O"):
        guide = (-60 * s * 1j, 100 * s - 60 * s * 1j)
    O = board.mark("O", min(circle_cuts(board.line(*guide), F, radius + board.shake().real), key=lambda z: abs(z - B2)))
    dead_positions(board, O, B1, B2)


def crank_rocker(board: Board) -> None:
    """O on the arc: where the least transmission angle is the best, or nearly."""
    s = board.scale
    C = board.mark("C", 0j)
    first = board.rng.uniform(0, 360)
    B1, B2 = (board.mark(name, C + 80 * s * e(first + turn)) for name, turn in (("B_1", 0), ("B_2", -60)))
    angle = 2 * ALPHA if board.slips("angle doubled", "O") else ALPHA
    middle, half = (B1 + B2) / 2, abs(B1 - B2) / 2
    F = middle + half / math.tan(angle * DEGREE) * (C - middle) / abs(C - middle)
    ground = (BEST_GROUND + board.rng.uniform(-0.4, 0.4)) * s
    radius = half / math.sin(angle * DEGREE)
    O = board.mark("O", max(circles_cut(F, radius, C, ground), key=lambda z: abs(z - B1) - abs(z - B2)))
    dead_positions(board, O, B1, B2)


BEST_GROUND = 97.7822  # of the largest least transmission angle, as the sheet tells it


def lever(board: Board) -> None:
    s, swing = board.scale, 180 * 0.61 / 2.61
    O, C = board.mark("O", 0j), board.mark("C", 200 * s)
    swing = 2 * swing if board.slips("swing doubled", "A_1") else swing
    for name, turn in (("A_1", -swing / 2), ("A_2", swing / 2)):
        ray = board.ray(C, 180 + turn)
        along = (ray[1] - ray[0]) / abs(ray[1] - ray[0])
        foot = C + ((O - C) * along.conjugate()).real * along
        foot = foot + 9 * along if name == "A_2" and board.slips("not square", "A_2") else foot
        board.mark(name, foot)


def cognates(board: Board) -> None:
    points = gp.load("four-bar").points
    O, A, B, C, M = (board.mark(name, complex(*map(float, points[name])) * board.scale) for name in "OABCM")
    B1 = board.mark("B_1", B + M - C if board.slips("wrong parallelogram", "B_1") else C + M - B)
    shape = (M - A) / (B - A)
    shape = shape.conjugate() if board.slips("mirrored triangle", "A_1") else shape
    A1 = board.mark("A_1", M + shape * (B1 - M))
    D = board.mark("D", C + (O - C) * (A1 - C) / (A - C))
    board.mark("A_2", O + M - A)
    board.mark("B_2", D + M - A1)


@cache
def dwell_path() -> list[complex]:
    """M where the stretch begins, in its middle, and where it ends."""
    path = gp.follow(gp.load("dwell"), 361).points["M"]
    return [complex(path[travel]) for travel in (10, 45, 80)]


def dwell(board: Board) -> None:
    M = [board.mark(f"M_{k}", z * board.scale) for k, z in enumerate(dwell_path(), 1)]
    board.mark("E", (50 + 65j) * board.scale)
    board.centre("D", *M)


def geneva(board: Board) -> None:
    s = board.scale
    O, C = board.mark("O", 0j), board.mark("C", 100 * s)
    half = 60 if board.slips("whole angle", "S") else 30
    for name, turn in (("S", -half), ("T", half)):
        along = e(180 + turn)
        foot = C + ((O - C) * along.conjugate()).real * along
        foot = O + (foot - O) * 0.85 if name == "T" and board.slips("not on the axis", "T") else foot
        board.mark(name, foot)


def conjugate(board: Board) -> None:
    s, count = board.scale, int(board.rng.choice([8, 12, 24]))
    O, _ = board.mark("O_1", 0j), board.mark("O_2", 100 * s)
    for k in range(count + 1):
        phi = -60 + 120 * k / count
        P = board.mark(f"P_{k}", O + 100 / 3 * s * e(-phi))
        psi = 0.5 * phi if board.slips("turned the wrong way", f"K_{k}") else -0.5 * phi
        B = O + (100 - 30 * e(psi)) * s * e(-phi) + board.shake()
        normal = (P - B) / abs(P - B)
        board.mark(f"K_{k}", min((B + 8 * s * normal, B - 8 * s * normal), key=abs))


def gear(board: Board) -> None:
    s, radii, m = board.scale, (52.0, 64.0), 8.0
    O1, O2 = board.mark("O_1", 0j), board.mark("O_2", 116 * s)
    P = board.mark("P", O1 + 52 * s)
    tilt = 70 if not board.slips("complement", "N_1") else 20
    action = board.ray(P, tilt)
    along = (action[1] - action[0]) / abs(action[1] - action[0])
    for name, O in (("N_1", O1), ("N_2", O2)):
        board.mark(name, P + ((O - P) * along.conjugate()).real * along)
    tips = [radius + (1.25 if board.slips("clearance for addendum", "A") else 1) * m for radius in radii[::-1]][::-1]
    cuts = {"A": circle_cuts(action, O2, tips[1] * s)[0], "B": circle_cuts(action, O1, tips[0] * s)[1]}
    for name, z in cuts.items():
        board.mark(name, z)


DRAWERS: dict[str, tuple[Callable[[Board], None], list[str]]] = {
    "guidance-moving": (guidance_moving, ["z reversed", "one z reversed", "axis clockwise", "slanting bisector"]),
    "guidance-fixed": (guidance_fixed, ["turned forwards", "slanting bisector"]),
    "guidance-22-8": (guidance_four, ["one z reversed", "axis clockwise", "slanting bisector"]),
    "function-rocker": (function_rocker, ["supplement", "turned forwards", "wrong pivot", "slanting bisector"]),
    "function-slide": (function_slide, ["turned forwards", "slanting bisector"]),
    "stroke-slider-crank": (slider_crank, ["complement", "offset doubled", "not halved", "towards B_2"]),
    "stroke-crank-rocker": (crank_rocker, ["angle doubled", "not halved", "towards B_2"]),
    "stroke-lever": (lever, ["swing doubled", "not square"]),
    "cognates-four-bar": (cognates, ["wrong parallelogram", "mirrored triangle"]),
    "dwell-output": (dwell, ["slanting bisector"]),
    "geneva-19-1": (geneva, ["whole angle", "not on the axis"]),
    "conjugate-pin": (conjugate, ["turned the wrong way"]),
    "gear-21-1": (gear, ["complement", "clearance for addendum"]),
}
SIZES = dict.fromkeys(DRAWERS, 1.0) | {"guidance-22-8": 6.0, "stroke-lever": 0.8, "cognates-four-bar": 0.25}


def draw(name: str, seed: int, wrong: str = "", **threes: tuple[int, ...]) -> Board:
    """A student's sheet of a task."""
    rng = np.random.default_rng(seed)
    board = Board(rng, SIZES.get(name, 1.0) * float(rng.choice([0.5, 0.8, 1.0])), wrong, threes=threes)
    DRAWERS[name][0](board)
    turn, shift = e(float(rng.choice([0.0, 90.0, rng.uniform(-180, 180)]))), complex(*rng.uniform(100, 200, 2))
    mirrored = DRAWERS[name][0] in (lever, slider_crank, crank_rocker, geneva, gear) and rng.random() < 0.3
    board.points = {letter: shift + turn * (z.conjugate() if mirrored else z) for letter, z in board.points.items()}
    return board


def scatter(name: str, seed: int) -> Board:
    """A sheet on which nothing but letters is as in the task."""
    board, rng = draw(name, seed), np.random.default_rng(seed + 1)
    board.points = {letter: complex(*rng.uniform(20, 180, 2)) for letter in board.points}
    return board


def table(board: Board) -> str:
    """Measured points."""
    return "\n".join(["mark,x,y", *(f'"{name}",{z.real:.1f},{z.imag:.1f}' for name, z in board.points.items())]) + "\n"


def svg(board: Board) -> str:
    """A drawing of a program: dots, with letters beside them."""
    zs = board.points.values()
    left, low = min(z.real for z in zs) - 20, min(z.imag for z in zs) - 20
    wide, high = max(z.real for z in zs) - left + 20, max(z.imag for z in zs) - low + 20
    dots = (f'<circle cx="{z.real - left:.3f}" cy="{high - z.imag + low:.3f}" r="0.6"/>'
            f'<text x="{z.real - left + 1:.3f}" y="{high - z.imag + low - 1:.3f}" font-size="3">{name}</text>'
            for name, z in board.points.items())
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide:.3f}mm" height="{high:.3f}mm" '
            f'viewBox="0 0 {wide:.3f} {high:.3f}">{"".join(dots)}</svg>')


def mistakes() -> Iterator[tuple[str, str]]:
    """Each mistake of each task."""
    for name, (_, slips) in DRAWERS.items():
        yield from product([name], slips)


def judged(name: str, board: Board, file: Path) -> dict[str, Any]:
    """What is said of a sheet that is handed in as a file, .csv or .svg."""
    file.write_text(table(board) if file.suffix == ".csv" else svg(board))
    record: dict[str, Any] = gp.verify(name, file).json()
    return record


def is_right(record: dict[str, Any]) -> bool:
    """Whether nothing is wrong or missing."""
    return record["first_wrong"] is None and record["score"]["total"] == 100


def is_told(record: dict[str, Any], board: Board) -> bool:
    """Whether the first wrong mark is the one at which the mistake was made, and it costs 5 to 35 points."""
    wrong = [step["mark"] for step in record["steps"] if step["verdict"] == "wrong"]
    return wrong[:1] == [board.guilty.replace("'", "′")] and 65 <= record["score"]["total"] <= 95
