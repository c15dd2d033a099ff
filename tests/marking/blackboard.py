"""Drawings as a class hands them in, made by textbook vector equations alone: nothing here knows graphplan's writers,
programs or solver.

A drawing has the marks that a textbook names, each from the student's own earlier marks, at scales and places of his
own: right, with one mistake, or with a whole plan reversed, turned or at another scale. A seed gives the same drawing.
"""

from __future__ import annotations

import cmath
import math
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from xml.sax.saxutils import escape

Points = dict[str, complex]
WOBBLE_MM, FLATTEST_DEG, LEAST_MM, HEAD_MM = 0.08, 25.0, 5.0, 3.0


class Unfit(Exception):
    """A drawing that no teacher would set, or in which a mistake would not be seen."""


@dataclass(frozen=True)
class Fault:
    """What a student did: a kind, the mark at which he did it, and by which number."""

    kind: str
    mark: str
    by: complex = 1.0


@dataclass
class Board:
    """A drawing in the making, in mm: its marks by their plan and letter, and the strokes between them."""

    chance: random.Random
    fault: Fault | None = None
    marks: dict[tuple[str, str], complex] = field(default_factory=dict)
    strokes: list[tuple[complex, complex]] = field(default_factory=list)
    arcs: list[tuple[complex, complex, complex]] = field(default_factory=list)  # centre, and ends counterclockwise
    arrows: list[tuple[complex, complex]] = field(default_factory=list)  # the strokes that have a head
    forms: Callable[[Board, str, complex], None] | None = None  # draws the figure in which a vector is found
    done: bool = False  # whether the mistake was made
    off: float = 0.0  # by how much, mm

    def put(self, plan: str, letter: str, at: complex, *, stroke_from: complex | None = None, head: bool = False
            ) -> complex:
        """Mark a point, with the wobble of a hand, and the mistake if it is made here."""
        if self.fault and self.fault.mark == letter and self.fault.kind == "slip":
            at, self.done, self.off = at + self.fault.by, True, abs(self.fault.by)
        at += complex(self.chance.gauss(0, WOBBLE_MM), self.chance.gauss(0, WOBBLE_MM))
        if plan:
            self.marks[plan, letter] = at
        if stroke_from is not None:
            self.strokes.append((stroke_from, at))
            self.arrows += [(stroke_from, at)] * head
        return at

    def vector(self, name: str, right: complex) -> complex:
        """A vector of this name as the student lays it off, found by a figure of its own where he has one."""
        if self.forms:
            self.forms(self, name, right)
        if self.fault and self.fault.mark == name and self.fault.kind in VECTOR_FAULTS:
            wrong = right * self.fault.by
            self.done, self.off = True, abs(wrong - right)
            return wrong
        return right

    def along(self, name: str, right: complex, others: dict[str, complex]) -> complex:
        """The direction of a locus as the student draws it: turned by a right angle, or that of another side."""
        if self.fault and self.fault.mark == name:
            if self.fault.kind == "right angle":
                self.done = True
                return right * 1j
            if self.fault.kind == "wrong side" and others:
                self.done = True
                return others[sorted(others)[int(self.fault.by.real) % len(others)]]
        return right

    def start(self, name: str, right: complex, other: complex) -> complex:
        """Where a vector is laid off from, or a locus is drawn through."""
        if self.fault and self.fault.mark == name and self.fault.kind == "wrong start":
            self.done, self.off = True, abs(other - right)
            return other
        return right

    def ratio(self, name: str, right: complex) -> complex:
        """The place of a third point in the figure of two, seen from the first: mirrored by mistake."""
        if self.fault and self.fault.mark == name and self.fault.kind == "mirrored figure":
            self.done = True
            return right.conjugate()
        return right


VECTOR_FAULTS = {"reversed": (-1,), "omitted": (0,), "quarter turn": (1j, -1j), "halved": (0.5,), "doubled": (2,),
                 "wrong radius": ()}  # the radius is that of another link
NORMAL = re.compile(r"n_([A-Z]\d?)([A-Z])")


def meet(P: complex, u: complex, Q: complex, w: complex) -> complex:
    """Where the line through P along u meets that through Q along w."""
    sine = (u.conjugate() * w).imag
    if abs(sine) < math.sin(math.radians(FLATTEST_DEG)) * abs(u) * abs(w):
        raise Unfit("flat")
    return P + u * ((Q - P).conjugate() * w).imag / sine


def third(P: complex, r: float, Q: complex, s: float, side: int) -> complex:
    """The corner of a triangle over PQ."""
    d = abs(Q - P)
    x = (d * d + r * r - s * s) / (2 * d)
    if r * r - x * x < (0.3 * min(r, s)) ** 2:
        raise Unfit("no triangle")
    return P + (Q - P) / d * complex(x, side * math.sqrt(r * r - x * x))


@dataclass(frozen=True)
class Task:
    """A mechanism in lengths of its scene: its file, its points, and how it is drawn in mm, by its plan."""

    kind: str
    scene: str
    points: Points
    omega: float
    draw: Callable[[Task, Board, Places], None]
    plan: str
    vectors: tuple[str, ...]  # the names at which vectors are laid off
    loci: tuple[str, ...]
    figures: tuple[str, ...]
    pairs: tuple[tuple[str, str], ...]  # letters that are exchanged
    slips: tuple[str, ...]
    whole: tuple[str, ...]  # plans that may be wrong as a whole


@dataclass(frozen=True)
class Places:
    """Where the plans lie, and mm for a unit: of lengths, of speeds, of accelerations, of forces."""

    mechanism: complex
    first: complex
    second: complex
    k: float
    kv: float
    ka: float


# ---- mechanisms ------------------------------------------------------------------------------------------------------


def scene(points: Points, links: dict[str, str], omega: float, more: str = "") -> str:
    """A scene's file."""
    rows = ["[points]", *(f"{name} = [{z.real:.1f}, {z.imag:.1f}]" for name, z in points.items()), "[links]",
            *(f'{name} = "{of}"' for name, of in links.items()), "[[drive]]", 'link = "1"', f"omega = {omega}"]
    moving = ", ".join(f'"{name}"' for name in points if name not in links["frame"].split())
    asked = f"[find]\nvelocity = [{moving}]\nacceleration = [{moving}]\n"
    return 'title = "A task"\n' + "\n".join(rows) + "\n" + more + asked


def rounded(points: Points) -> Points:
    return {name: complex(round(z.real, 1), round(z.imag, 1)) for name, z in points.items()}


def four_bar_points(chance: random.Random) -> Points:
    O, r = 0j, chance.uniform(45, 70)
    A = cmath.rect(r, math.radians(chance.uniform(20, 160)))
    C = complex(chance.uniform(130, 190), chance.uniform(-30, 30))
    B = third(A, chance.uniform(110, 170), C, chance.uniform(90, 150), 1)
    M = third(A, chance.uniform(60, 110), B, chance.uniform(60, 110), chance.choice((1, -1)))
    return rounded({"O": O, "A": A, "C": C, "B": B, "M": M})


def four_bar(chance: random.Random, plan: str) -> Task:
    at, omega = four_bar_points(chance), chance.choice((-12, -8, -5, 4, 6, 10))
    text = scene(at, {"1": "O A", "2": "A B M", "3": "B C", "frame": "O C"}, omega)
    if plan == "polar":
        return Task("four-bar", text, at, omega, draw_four_bar_polar, plan, ("n_BA", "n_BC"),
                    ("b by A", "b by C", "b' by A", "b' by C"), ("m", "m'"), (("a", "b"), ("b", "m"), ("a'", "b'")),
                    ("b", "m", "b'", "m'"), ("first", "second"))
    return Task("four-bar", text, at, omega, draw_four_bar_orthogonal, plan, ("n_BA", "n_BC"), ("b by A", "b' by A",
                "b' by C"), ("v_m", "M_1"), (("v_a", "v_b"), ("v_b", "v_m"), ("A_1", "B_1")),
                ("v_b", "v_m", "b", "c", "B_1", "M_1"), ("second",))


def lay_out(task: Task, board: Board, where: Places) -> Points:
    """The mechanism on the sheet, and its links."""
    at = {name: board.put("mechanism", name, where.mechanism + where.k * z) for name, z in task.points.items()}
    for one, other in re.findall(r'= "(\w+) (\w+)', task.scene):
        if one in at and other in at:
            board.strokes.append((at[one], at[other]))
    return at


def normal(board: Board, name: str, speed_mm: float, arm: complex, k: float, kv: float, ka: float) -> complex:
    """v²/r in mm, along an arm (mm) that is directed to the centre."""
    right = ka * (speed_mm / kv) ** 2 / (abs(arm) / k) * arm / abs(arm)
    return board.vector(name, right)


def dyad(board: Board, names: tuple[str, str], one: complex, u: complex, other: complex, w: complex,
         sides: dict[str, complex]) -> complex:
    """Where two loci meet, each as the student draws it."""
    return meet(one, board.along(names[0], u, sides), other, board.along(names[1], w, sides))


def four_bar_velocities(task: Task, board: Board, where: Places, P: dict[str, complex],
                        sides: dict[str, complex]) -> tuple[complex, complex, complex]:
    """The pole, a and b of a crank OA and a rocker CB that a coupler AB joins."""
    p = board.put("first", "p", where.first)
    a = board.put("first", "a", p + where.kv * 1j * task.omega * (P["A"] - P["O"]) / where.k, stroke_from=p)
    b = dyad(board, ("b by C", "b by A"), p, 1j * (P["B"] - P["C"]), a, 1j * (P["B"] - P["A"]), sides)
    b = board.put("first", "b", b, stroke_from=p)
    board.strokes.append((a, b))
    return p, a, b


def four_bar_accelerations(task: Task, board: Board, where: Places, P: dict[str, complex], sides: dict[str, complex],
                           velocities: tuple[complex, complex, complex]) -> tuple[complex, complex, complex]:
    """The pole, a' and b' of the same."""
    (p, a, b), k, kv, ka = velocities, where.k, where.kv, where.ka
    pi = board.put("second", "π", where.second)
    a1 = board.put("second", "a'", pi - ka * task.omega**2 * (P["A"] - P["O"]) / k, stroke_from=pi)
    n2 = board.start("n_BA", a1, pi) + normal(board, "n_BA", abs(b - a), P["A"] - P["B"], k, kv, ka)
    n2 = board.put("second", "n_2", n2, stroke_from=a1)
    n3 = board.start("n_BC", pi, a1) + normal(board, "n_BC", abs(b - p), P["C"] - P["B"], k, kv, ka)
    n3 = board.put("second", "n_3", n3, stroke_from=pi)
    b1 = dyad(board, ("b' by C", "b' by A"), n3, 1j * (P["B"] - P["C"]), n2, 1j * (P["B"] - P["A"]), sides)
    b1 = board.put("second", "b'", b1, stroke_from=pi)
    board.strokes += [(n2, b1), (n3, b1)]
    return pi, a1, b1


def draw_four_bar_polar(task: Task, board: Board, where: Places) -> None:
    P = lay_out(task, board, where)
    sides = {"AM": 1j * (P["M"] - P["A"]), "OC": 1j * (P["C"] - P["O"])}
    _, a, b = velocities = four_bar_velocities(task, board, where, P, sides)
    r = board.ratio("m", (P["M"] - P["A"]) / (P["B"] - P["A"]))
    m = board.put("first", "m", a + r * (b - a), stroke_from=a)
    board.strokes.append((b, m))
    pi, a1, b1 = four_bar_accelerations(task, board, where, P, sides, velocities)
    r = board.ratio("m'", (P["M"] - P["A"]) / (P["B"] - P["A"]))
    board.put("second", "m'", a1 + r * (b1 - a1), stroke_from=pi)


def turned_normal(board: Board, name: str, speed_mm: float, arm: complex, times: float) -> complex:
    """v²/r of lengths on paper, as the semicircle gives it, so many times as large."""
    return board.vector(name, times * speed_mm**2 / abs(arm) * arm / abs(arm))


def draw_four_bar_orthogonal(task: Task, board: Board, where: Places) -> None:
    P, k, kv = lay_out(task, board, where), where.k, where.kv
    times = where.ka
    sides = {"AM": P["M"] - P["A"], "OA": P["A"] - P["O"]}
    va = board.put("mechanism", "v_a", P["A"] - kv * task.omega * (P["A"] - P["O"]) / k, stroke_from=P["A"])
    vb = meet(P["C"], P["B"] - P["C"], va, board.along("b by A", P["B"] - P["A"], sides))
    vb = board.put("mechanism", "v_b", vb, stroke_from=P["B"])
    board.strokes.append((va, vb))
    r = board.ratio("v_m", (P["M"] - P["A"]) / (P["B"] - P["A"]))
    vm = board.put("mechanism", "v_m", va + r * (vb - va), stroke_from=P["M"])
    board.strokes.append((va, vm))
    a = board.put("second", "a", where.second)
    a1 = board.put("second", "A_1", a + times * (kv * task.omega / k) ** 2 * (P["O"] - P["A"]), stroke_from=a)
    v_ba = abs((va - P["A"]) - (vb - P["B"]))
    b = board.put("second", "b", board.start("n_BA", a, a1) + turned_normal(board, "n_BA", v_ba, P["B"] - P["A"],
                                                                            times), stroke_from=a)
    c = board.put("second", "c", board.start("n_BC", b, a) + turned_normal(board, "n_BC", abs(vb - P["B"]),
                                                                           P["C"] - P["B"], times), stroke_from=b)
    b1 = dyad(board, ("b' by C", "b' by A"), c, 1j * (P["B"] - P["C"]), a1, 1j * (P["B"] - P["A"]), sides)
    b1 = board.put("second", "B_1", b1, stroke_from=c)
    board.strokes.append((a1, b1))
    r = board.ratio("M_1", (P["M"] - P["A"]) / (P["B"] - P["A"]))
    board.put("second", "M_1", a1 + r * (b1 - a1), stroke_from=a1)
    board.put("second", "m", a + (P["M"] - P["A"]) / (P["B"] - P["A"]) * (b - a), stroke_from=a)


def slider_crank(chance: random.Random, plan: str) -> Task:
    A = cmath.rect(chance.uniform(40, 60), math.radians(chance.uniform(25, 155)))
    low = chance.uniform(-20, 20)
    B = complex(A.real + math.sqrt(chance.uniform(130, 170) ** 2 - (A.imag - low) ** 2), low)
    share = chance.choice((0.3, 0.4, 0.5, 0.6))
    at, omega = rounded({"O": 0j, "A": A, "B": B}), chance.choice((-10, -6, 5, 8, 12))
    at["S"] = at["A"] + share * (at["B"] - at["A"])
    slide = '[[slides]]\nlink = "3"\nalong = "frame"\nat = "B"\ndirection = [1, 0]\n'
    text = scene(at, {"1": "O A", "2": "A B S", "3": "B", "frame": "O"}, omega, slide).replace(
        f"S = [{at['S'].real:.1f}, {at['S'].imag:.1f}]",
        f'S = {{ on = "A B", distance = {abs(at["S"] - at["A"]):.6f} }}')
    if plan == "polar":
        return Task("slider-crank", text, at, omega, draw_slider_polar, plan, ("n_BA",), ("b by A", "b by O", "b' by A",
                    "b' by O"), (), (("a", "b"), ("b", "s"), ("a'", "b'")), ("b", "s", "b'", "s'"),
                    ("first", "second"))
    return Task("slider-crank", text, at, omega, draw_slider_orthogonal, plan, ("n_BA",),
                ("b by A", "b by O", "b' by A", "b' by O"), (), (("v_a", "v_b"), ("v_b", "v_s"), ("A_1", "B_1")),
                ("v_b", "v_s", "b", "B_1", "S_1"), ("second",))


def draw_slider_polar(task: Task, board: Board, where: Places) -> None:
    P, k, kv, ka = lay_out(task, board, where), where.k, where.kv, where.ka
    sides = {"OA": 1j * (P["A"] - P["O"])}
    guide = 1 + 0j
    share = (P["S"] - P["A"]) / (P["B"] - P["A"])
    p = board.put("first", "p", where.first)
    a = board.put("first", "a", p + kv * 1j * task.omega * (P["A"] - P["O"]) / k, stroke_from=p)
    b = dyad(board, ("b by O", "b by A"), p, guide, a, 1j * (P["B"] - P["A"]), sides)
    b = board.put("first", "b", b, stroke_from=p)
    board.strokes.append((a, b))
    board.put("first", "s", a + share * (b - a), stroke_from=p)
    pi = board.put("second", "π", where.second)
    a1 = board.put("second", "a'", pi - ka * task.omega**2 * (P["A"] - P["O"]) / k, stroke_from=pi)
    n = board.start("n_BA", a1, pi) + normal(board, "n_BA", abs(b - a), P["A"] - P["B"], k, kv, ka)
    n = board.put("second", "n_2", n, stroke_from=a1)
    b1 = dyad(board, ("b' by O", "b' by A"), pi, guide, n, 1j * (P["B"] - P["A"]), sides)
    b1 = board.put("second", "b'", b1, stroke_from=pi)
    board.strokes.append((n, b1))
    board.put("second", "s'", a1 + share * (b1 - a1), stroke_from=pi)


def draw_slider_orthogonal(task: Task, board: Board, where: Places) -> None:
    P, k, kv, times = lay_out(task, board, where), where.k, where.kv, where.ka
    sides = {"OA": P["A"] - P["O"]}
    share = (P["S"] - P["A"]) / (P["B"] - P["A"])
    va = board.put("mechanism", "v_a", P["A"] - kv * task.omega * (P["A"] - P["O"]) / k, stroke_from=P["A"])
    vb = dyad(board, ("b by O", "b by A"), P["B"], 1j, va, P["B"] - P["A"], sides)
    vb = board.put("mechanism", "v_b", vb, stroke_from=P["B"])
    board.strokes.append((va, vb))
    board.put("mechanism", "v_s", va + share * (vb - va), stroke_from=P["S"])
    a = board.put("second", "a", where.second)
    a1 = board.put("second", "A_1", a + times * (kv * task.omega / k) ** 2 * (P["O"] - P["A"]), stroke_from=a)
    v_ba = abs((va - P["A"]) - (vb - P["B"]))
    b = board.put("second", "b", board.start("n_BA", a, a1) + turned_normal(board, "n_BA", v_ba, P["B"] - P["A"],
                                                                            times), stroke_from=a)
    b1 = dyad(board, ("b' by O", "b' by A"), b, 1 + 0j, a1, 1j * (P["B"] - P["A"]), sides)
    b1 = board.put("second", "B_1", b1, stroke_from=b)
    board.strokes.append((a1, b1))
    board.put("second", "S_1", a1 + share * (b1 - a1))
    board.put("second", "s", a + share * (b - a))


def inverted(chance: random.Random, plan: str) -> Task:
    A = cmath.rect(chance.uniform(50, 80), math.radians(chance.uniform(20, 160)))
    C = complex(chance.uniform(-110, -60), chance.uniform(-70, -20))
    at = rounded({"O": 0j, "A": A, "A3": A, "C": C, "K": C + (A - C) * chance.uniform(1.3, 1.7)})
    omega = chance.choice((-8, -6, -4, 4, 5, 7))
    slide = '[[slides]]\nlink = "2"\nalong = "3"\nat = "A"\ndirection = "C A3"\n'
    at["K"] = at["C"] + (at["A"] - at["C"]) * 1.5
    text = scene(at, {"1": "O A", "2": "A", "3": "C A3 K", "frame": "O C"}, omega, slide).replace(
        f"K = [{at['K'].real:.1f}, {at['K'].imag:.1f}]",
        f'K = {{ on = "C A3", distance = {abs(at["K"] - at["C"]):.6f} }}')
    return Task("inverted slider-crank", text, at, omega, draw_inverted_polar, "polar", ("n_A3C", "cor"),
                ("a3 by C", "a3 by A", "a3' by C", "a3' by A"), (), (("a", "a3"), ("a3", "k"), ("a'", "a3'")),
                ("a3", "k", "a3'", "k'"), ("first", "second"))


def inverted_velocities(task: Task, board: Board, where: Places, P: dict[str, complex], sides: dict[str, complex]
                        ) -> tuple[complex, complex, complex, complex]:
    """The pole, a, a3 and k of a crank OA whose block slides along CK."""
    guide = P["A3"] - P["C"]
    p = board.put("first", "p", where.first)
    a = board.put("first", "a", p + where.kv * 1j * task.omega * (P["A"] - P["O"]) / where.k, stroke_from=p)
    a3 = dyad(board, ("a3 by C", "a3 by A"), p, 1j * guide, a, guide, sides)
    a3 = board.put("first", "a3", a3, stroke_from=p)
    board.strokes.append((a, a3))
    share = (P["K"] - P["C"]) / (P["A3"] - P["C"])
    return p, a, a3, board.put("first", "k", p + share * (a3 - p), stroke_from=p)


def inverted_accelerations(task: Task, board: Board, where: Places, P: dict[str, complex], sides: dict[str, complex],
                           velocities: tuple[complex, complex, complex, complex]) -> tuple[complex, complex]:
    """The pole and k' of the same."""
    (p, a, a3, _), k, kv, ka = velocities, where.k, where.kv, where.ka
    guide = P["A3"] - P["C"]
    pi = board.put("second", "π", where.second)
    a1 = board.put("second", "a'", pi - ka * task.omega**2 * (P["A"] - P["O"]) / k, stroke_from=pi)
    omega3 = ((a3 - p) / kv / (1j * guide / k)).real
    coriolis = board.vector("cor", ka * 2 * omega3 * 1j * (a3 - a) / kv)  # of A3 relative to A, which is minus A's
    cor = board.put("second", "k_A", board.start("cor", a1, pi) + coriolis, stroke_from=a1)
    n = normal(board, "n_A3C", abs(a3 - p), -guide, k, kv, ka)
    n = board.put("second", "n_3", board.start("n_A3C", pi, a1) + n, stroke_from=pi)
    b1 = dyad(board, ("a3' by C", "a3' by A"), n, 1j * guide, cor, guide, sides)
    b1 = board.put("second", "a3'", b1, stroke_from=pi)
    board.strokes += [(cor, b1), (n, b1)]
    share = (P["K"] - P["C"]) / (P["A3"] - P["C"])
    return pi, board.put("second", "k'", pi + share * (b1 - pi), stroke_from=pi)


def draw_inverted_polar(task: Task, board: Board, where: Places) -> None:
    P = lay_out(task, board, where)
    sides = {"OA": P["A"] - P["O"]}
    inverted_accelerations(task, board, where, P, sides, inverted_velocities(task, board, where, P, sides))


def six_bar(chance: random.Random, plan: str) -> Task:
    at = {name: z * 0.8 for name, z in four_bar_points(chance).items() if name != "M"}
    at["D"] = third(at["C"], chance.uniform(80, 110), at["B"], chance.uniform(35, 60), -1)
    F = at["C"] + complex(chance.uniform(110, 150), chance.uniform(-30, 20))
    at["F"] = F
    at["E"] = third(at["D"], chance.uniform(80, 120), F, chance.uniform(70, 110), 1)
    at, omega = rounded(at), chance.choice((-10, -6, 5, 8))
    text = scene(at, {"1": "O A", "2": "A B", "3": "B C D", "4": "D E", "5": "E F", "frame": "O C F"}, omega)
    return Task("six-bar", text, at, omega, draw_six_bar_polar, "polar", ("n_BA", "n_BC", "n_ED", "n_EF"),
                ("b by A", "b by C", "e by D", "e by F", "b' by A", "b' by C", "e' by D", "e' by F"), ("d", "d'"),
                (("b", "d"), ("d", "e"), ("b'", "e'")), ("b", "d", "e", "b'", "d'", "e'"), ("first", "second"))


def draw_six_bar_polar(task: Task, board: Board, where: Places) -> None:
    P, k, kv, ka = lay_out(task, board, where), where.k, where.kv, where.ka
    sides = {"OC": 1j * (P["C"] - P["O"]), "CF": 1j * (P["F"] - P["C"])}
    p, _, b = velocities = four_bar_velocities(task, board, where, P, sides)
    d = board.put("first", "d", p + board.ratio("d", (P["D"] - P["C"]) / (P["B"] - P["C"])) * (b - p), stroke_from=p)
    e = dyad(board, ("e by F", "e by D"), p, 1j * (P["E"] - P["F"]), d, 1j * (P["E"] - P["D"]), sides)
    e = board.put("first", "e", e, stroke_from=p)
    board.strokes.append((d, e))
    pi, _, b1 = four_bar_accelerations(task, board, where, P, sides, velocities)
    d1 = pi + board.ratio("d'", (P["D"] - P["C"]) / (P["B"] - P["C"])) * (b1 - pi)
    d1 = board.put("second", "d'", d1, stroke_from=pi)
    n4 = board.start("n_ED", d1, pi) + normal(board, "n_ED", abs(e - d), P["D"] - P["E"], k, kv, ka)
    n4 = board.put("second", "n_4", n4, stroke_from=d1)
    n5 = board.start("n_EF", pi, d1) + normal(board, "n_EF", abs(e - p), P["F"] - P["E"], k, kv, ka)
    n5 = board.put("second", "n_5", n5, stroke_from=pi)
    e1 = dyad(board, ("e' by F", "e' by D"), n5, 1j * (P["E"] - P["F"]), n4, 1j * (P["E"] - P["D"]), sides)
    e1 = board.put("second", "e'", e1, stroke_from=pi)
    board.strokes += [(n4, e1), (n5, e1)]


# ---- drawings -------------------------------------------------------------------------------------------------------


WHOLE = {"reversed": -1.0, "turned": cmath.rect(1, math.radians(30)), "turned back": cmath.rect(1, math.radians(-50)),
         "another scale": 1.7}
Makers = dict[str, tuple[Callable[[random.Random, str], Task], str]]  # what makes tasks of a kind, and their plan
SIMPLE_MAKERS: Makers = {
    "four-bar, polar": (four_bar, "polar"), "four-bar, orthogonal": (four_bar, "orthogonal"),
    "slider-crank, polar": (slider_crank, "polar"), "slider-crank, orthogonal": (slider_crank, "orthogonal"),
    "inverted slider-crank": (inverted, "polar"), "six-bar": (six_bar, "polar"),
}


@dataclass(frozen=True)
class Drawing:
    """A finished drawing: its task, its marks, and what is wrong with it: empty, a fault, or a whole plan."""

    task: Task
    board: Board
    fault: Fault | None = None
    whole: str = ""

    @property
    def csv(self) -> str:
        """The marks as a student measures them."""
        rows = [f"{letter},{z.real:.1f},{z.imag:.1f}" for (plan, letter), z in self.board.marks.items()
                if not (self.task.plan == "orthogonal" and plan)]
        plans = {"mechanism": "mechanism", "second": "N-plan"}
        if self.task.plan == "orthogonal":
            return "mark,x,y,panel\n" + "".join(f"{letter},{z.real:.1f},{z.imag:.1f},{plans[plan]}\n"
                                                for (plan, letter), z in self.board.marks.items())
        return "\n".join(["mark,x,y", *rows]) + "\n"

    @property
    def heads(self) -> list[tuple[complex, complex, complex]]:
        """The heads of its arrows, each by its tip and its two other corners."""
        return [(end, *(end - HEAD_MM * (end - start) / abs(end - start) * (1 + side * 0.25j) for side in (1, -1)))
                for start, end in self.board.arrows if abs(end - start) > 0.5]

    @property
    def svg(self) -> str:
        """The drawing as a program of geometry draws it, with letters beside its dots."""
        rows = ['<svg xmlns="http://www.w3.org/2000/svg" width="420mm" height="297mm" viewBox="0 0 420 297">']
        for one, other in self.board.strokes:
            if abs(other - one) > 0.5:
                other += 0 if (one, other) in self.board.arrows else (other - one) / abs(other - one) * 3
                rows.append(f'<line x1="{one.real:.2f}" y1="{297 - one.imag:.2f}" x2="{other.real:.2f}" '
                            f'y2="{297 - other.imag:.2f}" stroke="black" stroke-width=".25"/>')
        for corners in self.heads:
            points = " ".join(f"{z.real:.2f},{297 - z.imag:.2f}" for z in corners)
            rows.append(f'<polygon points="{points}" fill="black"/>')
        for (_, letter), z in self.board.marks.items():
            rows.append(f'<circle cx="{z.real:.2f}" cy="{297 - z.imag:.2f}" r=".5"/>'
                        f'<text x="{z.real + 1:.2f}" y="{296 - z.imag:.2f}" font-size="3.5">{escape(letter)}</text>')
        for centre, start, end in self.board.arcs:
            r = abs(start - centre)
            rows.append(f'<path d="M {start.real:.2f} {297 - start.imag:.2f} A {r:.2f} {r:.2f} 0 0 0 {end.real:.2f} '
                        f'{297 - end.imag:.2f}" fill="none" stroke="black" stroke-width=".25"/>')
        return "\n".join([*rows, "</svg>\n"])

    @property
    def answers(self) -> re.Pattern[str]:
        """What a judge may name as the place of the mistake: the mark, or the vector."""
        assert self.fault
        return re.compile("|".join(_places(self.fault)))


SCALE_OF_TWO = {"P": ("II", "III"), "ao": ("a_o", "m_o")}  # who knows no scale cannot tell which of two is too long


def _places(fault: Fault) -> Iterator[str]:
    """The mark at which a mistake was made, and the one that shows it."""
    shows = {"n_BA": (r"b'", "B_1", r"n_b\(2\)", "b", "n_2", r"(B about A|A about B)", "a_BA"),
             "n_BC": (r"b'", "B_1", r"n_c\(3\)", "c", "n_3", r"(B about C|C about B)", r"n_b\(3\)"),
             "n_ED": (r"e'", "n_4", r"(E about D|D about E)", r"n_[ed]\(4\)", "e", "E_1"),
             "n_EF": (r"e'", "n_5", r"(E about F|F about E)", r"n_[ef]\(5\)", "f", "E_1"),
             "n_A3C": (r"a3'", "n_3", r"n_c\(3\)", r"(A3 about C|C about A3)", "c", "A3_1"),
             "cor": (r"a3'", "Coriolis", "k_A", "k_A3A", "a3", "A3_1"),
             "n_EK": (r"e'", "n_4", r"(E about K|K about E)", r"n_[ek]\(4\)"),
             "P": ("II", "P_2", *SCALE_OF_TWO["P"]), "T": ("III", "T_12", "T_1", *SCALE_OF_TWO["P"]),
             "ao": SCALE_OF_TWO["ao"], "mo": SCALE_OF_TWO["ao"]}
    if fault.mark in shows:
        yield from (f"(^|[| ]){one}($|[| ,:])" for one in (fault.mark, *shows[fault.mark]))
    else:
        for mark in fault.mark.partition(" by ")[0].split("+"):
            for form in (mark, f"v_{mark}", f"{mark.rstrip(chr(39)).upper()}_1" if mark.endswith("'") else mark):
                yield rf"(^|[| ]){re.escape(form)}($|[| ,:])"


def places(chance: random.Random, task: Task) -> Places:
    """Scales and places of the student's own, such that the plans lie beside each other on A3."""
    k = chance.choice((0.4, 0.5, 0.5))
    A = task.points["A"]
    if task.plan == "orthogonal":
        kv = chance.choice((0.4, 0.5, 0.6)) * k / abs(task.omega)  # a velocity of A so many times OA
        times = chance.uniform(1.5, 3.0)
        return Places(60 + 90j, 0j, 280 + 150j, k, kv * 1.0, times)
    if task.plan in ("polygons", "lever", ""):
        kv = chance.choice((0.4, 0.5, 0.6)) * k / abs(task.omega)
        return Places(110 + 90j, 0j, 330 + 200j, k, kv, chance.choice((0.3, 0.4, 0.5)))
    kv = chance.uniform(30, 60) / (abs(task.omega) * abs(A))
    if task.plan == "both":
        kv = chance.choice((0.4, 0.5, 0.6)) * k / abs(task.omega)
    ka = chance.uniform(40, 70) / (task.omega**2 * abs(A))
    return Places(complex(100, 60), complex(chance.uniform(60, 120), chance.uniform(190, 230)),
                  complex(chance.uniform(280, 320), chance.uniform(120, 180)), k, kv, ka)


def finish(task: Task, seed: int, fault: Fault | None = None, whole: tuple[str, str] | None = None,
           forms: Callable[[Places], Callable[[Board, str, complex], None]] | None = None) -> Drawing:
    """A drawing; fails with `Unfit` where it would be none."""
    chance, where = random.Random(f"hand {seed}"), places(random.Random(f"places {seed}"), task)
    board = Board(chance, fault, forms=forms and forms(where))
    task.draw(task, board, where)
    if whole:
        plan, how = whole
        inside = {key: z for key, z in board.marks.items() if key[0] == plan}
        pole = next(iter(inside.values()))
        old = {z: pole + WHOLE[how] * (z - pole) for z in inside.values()}
        board.marks |= {key: old[z] for key, z in inside.items()}
        board.strokes = [(old.get(one, one), old.get(other, other)) for one, other in board.strokes]
    if fault and fault.kind == "letters":
        one, other = fault.mark.split("+")
        keys = [next(key for key in board.marks if key[1] == letter) for letter in (one, other)]
        board.off = abs(board.marks[keys[0]] - board.marks[keys[1]])
        board.marks[keys[0]], board.marks[keys[1]] = board.marks[keys[1]], board.marks[keys[0]]
        board.done = True
    spots = list(board.marks.values())
    if any(not -60 < z.real < 480 or not -80 < z.imag < 380 for z in spots) or (fault and not board.done):
        raise Unfit("off the paper")
    return Drawing(task, board, fault, f"{whole[0]} {whole[1]}" if whole else "")


def task_of(name: str, seed: int) -> Task:
    """A task of a kind."""
    from makers import MAKERS  # which has the tasks of all files, and so reads this one

    make, plan = MAKERS[name]
    for trial in range(200):
        try:
            task = make(random.Random(f"{name} {seed} {trial}"), plan)
            board = finish(task, seed).board
            own = [abs(z - w) for (p, _), z in board.marks.items() for (q, _), w in board.marks.items()
                   if p == q and z is not w and p in ("first", "second")]
            if min(own, default=LEAST_MM) > 2.0:
                return task
        except (Unfit, ValueError):
            continue
    raise LookupError(name)


def right(name: str, seed: int) -> Drawing:
    """A right drawing."""
    return finish(task_of(name, seed), seed)


def mistaken(name: str, seed: int) -> Drawing:
    """A drawing with one mistake, of a kind and at a place that the seed chooses; it shows."""
    return finish(task_of(name, seed), seed, mistake_at(name, seed))


def radius_ratios(task: Task, name: str) -> list[float]:
    """How many times as long a normal acceleration is that is computed with the length of another link."""
    ends = NORMAL.fullmatch(name)
    sides = re.findall(r'= "(\w+) (\w+)', task.scene)
    if not ends:
        return []
    own, *others = (abs(task.points[one] - task.points[other]) for one, other in (ends.groups(), *sides)
                    if one in task.points and other in task.points)
    return [own / side for side in others if abs(math.log(own / side)) > 0.15]


def mistake_at(name: str, seed: int) -> Fault:
    """The mistake of a seed, which shows in the drawing."""
    task, chance = task_of(name, seed), random.Random(f"mistake {seed}")
    faults = [Fault(kind, mark, chance.choice(by)) for kind, by in VECTOR_FAULTS.items() if by
              for mark in task.vectors]
    faults += [Fault("wrong radius", mark, chance.choice(ratios)) for mark in task.vectors
               if (ratios := radius_ratios(task, mark))]
    faults += [Fault("wrong start", mark) for mark in task.vectors]
    faults += [Fault(kind, mark, chance.randrange(2)) for kind in ("right angle", "wrong side") for mark in task.loci]
    faults += [Fault("mirrored figure", mark) for mark in task.figures]
    faults += [Fault("letters", "+".join(pair)) for pair in task.pairs]
    faults += [Fault("slip", mark, cmath.rect(chance.uniform(6, 20), chance.uniform(0, 6.28))) for mark in task.slips]
    kinds = sorted({fault.kind for fault in faults})
    true = finish(task, seed).board.marks
    for _ in range(300):
        kind = chance.choice(kinds)
        fault = chance.choice([one for one in faults if one.kind == kind])
        try:
            made = finish(task, seed, fault)
        except Unfit:
            continue
        moved = [abs(z - true[key]) for key, z in made.board.marks.items()]
        if LEAST_MM < max(moved) < 150:
            return fault
    raise LookupError("no mistake shows")


def wrong_as_a_whole(name: str, seed: int) -> Drawing:
    """A drawing with a plan that is reversed, turned or at another scale."""
    task, chance = task_of(name, seed), random.Random(f"whole {seed}")
    if not task.whole:
        raise LookupError("no plan of its own")
    for _ in range(50):
        try:
            return finish(task, seed, whole=(chance.choice(task.whole), chance.choice(sorted(WHOLE))))
        except Unfit:
            continue
    raise LookupError("no plan fits")


def without_strokes(drawing: Drawing) -> Drawing:
    """The same with dots and letters alone."""
    return replace(drawing, board=replace(drawing.board, strokes=[]))
