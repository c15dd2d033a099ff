"""Tasks for hand drawings, and how each is drawn: four-bars, slider-cranks, inverted ones, six-bars, quick returns,
forces, lever, poles and curvature, after the vector equations of textbooks; velocities and accelerations on orthogonal
or polar plans, or each on another."""

from __future__ import annotations

import cmath
import math
import random
import re
from collections.abc import Callable
from dataclasses import replace

from drawing_board import Board, Places, Points, Task, Unfit, meet, third

FAR_MM = 260.0
Make = Callable[[random.Random, str], Task]
Makers = dict[str, tuple[Make, str]]  # what makes tasks of a kind, and their plan


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
         sides: Points) -> complex:
    """Where two loci meet, each as the student draws it."""
    return meet(one, board.along(names[0], u, sides), other, board.along(names[1], w, sides))


def four_bar_velocities(task: Task, board: Board, where: Places, P: Points,
                        sides: Points) -> tuple[complex, complex, complex]:
    """The pole, a and b of a crank OA and a rocker CB that a coupler AB joins."""
    p = board.put("first", "p", where.first)
    a = board.put("first", "a", p + where.kv * 1j * task.omega * (P["A"] - P["O"]) / where.k, stroke_from=p)
    b = dyad(board, ("b by C", "b by A"), p, 1j * (P["B"] - P["C"]), a, 1j * (P["B"] - P["A"]), sides)
    b = board.put("first", "b", b, stroke_from=p)
    board.strokes.append((a, b))
    return p, a, b


def four_bar_accelerations(task: Task, board: Board, where: Places, P: Points, sides: Points,
                           velocities: tuple[complex, complex, complex]) -> tuple[complex, complex, complex]:
    """The pole, a' and b' of the same."""
    p, a, b = velocities
    pi = board.put("second", "π", where.second)
    a1 = board.put("second", "a'", pi - where.ka * task.omega**2 * (P["A"] - P["O"]) / where.k, stroke_from=pi)
    return pi, a1, dyad_acceleration(board, where, P, "BAC", ("n_2", "n_3"), (abs(b - a), abs(b - p)), (a1, pi), sides)


def dyad_acceleration(board: Board, where: Places, P: Points, letters: str, marks: tuple[str, str],
                      speeds: tuple[float, float], ends: tuple[complex, complex], sides: Points) -> complex:
    """The end b' of the acceleration of the joint B of a dyad between A, of which it is known, and C at rest: from a'
    and from the pole the normal parts by the relative speeds, and perpendicular to them the tangential ones."""
    (B, A, C), (a1, pi) = letters, ends
    b1, parts = f"{B.lower()}'", list[complex]()
    for X, mark, speed, start, other in zip((A, C), marks, speeds, (a1, pi), (pi, a1), strict=True):
        name = f"n_{B}{X}"
        end = board.start(name, start, other) + normal(board, name, speed, P[X] - P[B], where.k, where.kv, where.ka)
        parts.append(board.put("second", mark, end, stroke_from=start))
    n2, n3 = parts
    met = dyad(board, (f"{b1} by {C}", f"{b1} by {A}"), n3, 1j * (P[B] - P[C]), n2, 1j * (P[B] - P[A]), sides)
    met = board.put("second", b1, met, stroke_from=pi)
    board.strokes += [(n2, met), (n3, met)]
    return met


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


def inverted_velocities(task: Task, board: Board, where: Places, P: Points, sides: Points
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


def inverted_accelerations(task: Task, board: Board, where: Places, P: Points, sides: Points,
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
    P = lay_out(task, board, where)
    sides = {"OC": 1j * (P["C"] - P["O"]), "CF": 1j * (P["F"] - P["C"])}
    p, _, b = velocities = four_bar_velocities(task, board, where, P, sides)
    d = board.put("first", "d", p + board.ratio("d", (P["D"] - P["C"]) / (P["B"] - P["C"])) * (b - p), stroke_from=p)
    e = dyad(board, ("e by F", "e by D"), p, 1j * (P["E"] - P["F"]), d, 1j * (P["E"] - P["D"]), sides)
    e = board.put("first", "e", e, stroke_from=p)
    board.strokes.append((d, e))
    pi, _, b1 = four_bar_accelerations(task, board, where, P, sides, velocities)
    d1 = pi + board.ratio("d'", (P["D"] - P["C"]) / (P["B"] - P["C"])) * (b1 - pi)
    d1 = board.put("second", "d'", d1, stroke_from=pi)
    dyad_acceleration(board, where, P, "EDF", ("n_4", "n_5"), (abs(e - d), abs(e - p)), (d1, pi), sides)


def orthogonal_velocity(board: Board, letter: str, P: Points, where: Places, omega: float) -> complex:
    """The end of the orthogonal velocity of A."""
    return board.put("mechanism", letter, P["A"] - where.kv * omega * (P["A"] - P["O"]) / where.k, stroke_from=P["A"])


def draw_six_bar_orthogonal(task: Task, board: Board, where: Places) -> None:
    P, times = lay_out(task, board, where), where.ka
    sides = {"OC": P["C"] - P["O"], "CF": P["F"] - P["C"]}
    r = (P["D"] - P["C"]) / (P["B"] - P["C"])
    va = orthogonal_velocity(board, "v_a", P, where, task.omega)
    vb = board.put("mechanism", "v_b", meet(P["C"], P["B"] - P["C"], va, board.along("b by A", P["B"] - P["A"], sides)),
                   stroke_from=P["B"])
    board.strokes.append((va, vb))
    vd = board.put("mechanism", "v_d", P["C"] + board.ratio("d", r) * (vb - P["C"]), stroke_from=P["D"])
    ve = board.put("mechanism", "v_e", meet(P["F"], P["E"] - P["F"], vd, board.along("e by D", P["E"] - P["D"], sides)),
                   stroke_from=P["E"])
    board.strokes.append((vd, ve))
    a = board.put("second", "a", where.second)
    a1 = board.put("second", "A_1", a + times * (where.kv * task.omega / where.k) ** 2 * (P["O"] - P["A"]),
                   stroke_from=a)
    v_ba, v_ed = abs(va - P["A"] - vb + P["B"]), abs(ve - P["E"] - vd + P["D"])

    def laid(letter: str, name: str, start: complex, speed: float, arm: complex) -> complex:
        """The next mark of the N-plan: a normal acceleration further on."""
        end = board.start(name, start, a1) + turned_normal(board, name, speed, arm, times)
        return board.put("second", letter, end, stroke_from=start)

    b = laid("b", "n_BA", a, v_ba, P["B"] - P["A"])
    c = laid("c", "n_BC", b, abs(vb - P["B"]), P["C"] - P["B"])
    d = board.put("second", "d", c + r * (b - c), stroke_from=c)
    e = laid("e", "n_ED", d, v_ed, P["E"] - P["D"])
    f = laid("f", "n_EF", e, abs(ve - P["E"]), P["F"] - P["E"])
    b1 = dyad(board, ("b' by C", "b' by A"), c, 1j * (P["B"] - P["C"]), a1, 1j * (P["B"] - P["A"]), sides)
    b1 = board.put("second", "B_1", b1, stroke_from=c)
    d1 = board.put("second", "D_1", c + board.ratio("d'", r) * (b1 - c), stroke_from=c)
    e1 = dyad(board, ("e' by F", "e' by D"), f, 1j * (P["E"] - P["F"]), d1, 1j * (P["E"] - P["D"]), sides)
    e1 = board.put("second", "E_1", e1, stroke_from=f)
    board.strokes += [(a1, b1), (d1, e1)]


def six_bar_orthogonal(chance: random.Random, plan: str) -> Task:
    polar = six_bar(chance, plan)
    return Task(polar.kind, polar.scene, polar.points, polar.omega, draw_six_bar_orthogonal, plan, polar.vectors,
                ("b by A", "e by D", "b' by A", "b' by C", "e' by D", "e' by F"), ("d", "d'"),
                (("v_b", "v_d"), ("A_1", "B_1"), ("D_1", "E_1")), ("v_b", "v_d", "v_e", "b", "e", "B_1", "D_1", "E_1"),
                ("second",))


def draw_inverted_orthogonal(task: Task, board: Board, where: Places) -> None:
    P = lay_out(task, board, where)
    k, kv, ka = where.k, where.kv, where.ka * where.kv**2 / where.k  # mm for a unit of acceleration
    guide = P["A3"] - P["C"]
    sides = {"OA": P["A"] - P["O"]}
    share = (P["K"] - P["C"]) / (P["A3"] - P["C"])
    va = orthogonal_velocity(board, "v_a", P, where, task.omega)
    v3 = board.put("mechanism", "v_a3", meet(P["C"], guide, va, board.along("a3 by A", 1j * guide, sides)),
                   stroke_from=P["A3"])
    board.strokes.append((va, v3))
    board.put("mechanism", "v_k", P["C"] + share * (v3 - P["C"]), stroke_from=P["K"])
    turned = (v3 - P["A3"]) / kv  # i times the velocity
    omega3 = (turned / 1j / (1j * guide / k)).real
    slip = (v3 - va) / kv / 1j  # velocity of A3 relative to A
    a = board.put("second", "a", where.second)
    coriolis = board.vector("cor", ka * 2 * omega3 * 1j * slip)
    a1 = board.put("second", "A_1", a - ka * task.omega**2 * (P["A"] - P["O"]) / k, stroke_from=a)
    a3 = board.put("second", "a3", board.start("cor", a, a1) - coriolis, stroke_from=a)
    n = board.vector("n_A3C", -ka * omega3**2 * guide / k)
    c = board.put("second", "c", board.start("n_A3C", a3, a) + n, stroke_from=a3)
    b1 = dyad(board, ("a3' by C", "a3' by A"), c, 1j * guide, a1, guide, sides)
    b1 = board.put("second", "A3_1", b1, stroke_from=c)
    board.strokes.append((a1, b1))
    board.put("second", "K_1", c + share * (b1 - c), stroke_from=c)
    board.put("second", "k", c + share * (a3 - c), stroke_from=c)


def inverted_orthogonal(chance: random.Random, plan: str) -> Task:
    polar = inverted(chance, plan)
    return Task(polar.kind, polar.scene, polar.points, polar.omega, draw_inverted_orthogonal, plan, ("n_A3C", "cor"),
                ("a3 by A", "a3' by C", "a3' by A"), (), (("v_a", "v_a3"), ("v_a3", "v_k"), ("A_1", "A3_1")),
                ("v_a3", "v_k", "a3", "A3_1", "K_1"), ("second",))


def quick_return(chance: random.Random, plan: str) -> Task:
    """A crank in a swinging guide, whose end moves a dyad: a six-bar with the acceleration of Coriolis."""
    base = inverted(chance, plan)
    at = {name: z * 0.7 for name, z in base.points.items() if name != "K"}
    A = at["A"]
    C = complex(chance.uniform(-20, 20), -chance.uniform(60, 90))
    at |= {"A": A, "A3": A, "C": C}
    at = rounded(at)
    at["K"] = at["C"] + (at["A"] - at["C"]) * 1.5
    F = at["K"] + cmath.rect(chance.uniform(110, 150), math.radians(chance.uniform(-30, 10)))
    at["F"] = complex(round(F.real, 1), round(F.imag, 1))
    E = third(at["K"], chance.uniform(80, 110), at["F"], chance.uniform(60, 90), -1)
    at["E"] = complex(round(E.real, 1), round(E.imag, 1))
    slide = '[[slides]]\nlink = "2"\nalong = "3"\nat = "A"\ndirection = "C A3"\n'
    links = {"1": "O A", "2": "A", "3": "C A3 K", "4": "K E", "5": "E F", "frame": "O C F"}
    text = scene(at, links, base.omega, slide).replace(
        f"K = [{at['K'].real:.1f}, {at['K'].imag:.1f}]",
        f'K = {{ on = "C A3", distance = {abs(at["K"] - at["C"]):.6f} }}')
    return Task("quick return", text, at, base.omega, draw_quick_return, plan, ("n_A3C", "cor", "n_EK", "n_EF"),
                ("a3 by C", "a3 by A", "e by F", "e by K", "a3' by C", "a3' by A", "e' by F", "e' by K"), (),
                (("a", "a3"), ("k", "e"), ("a'", "a3'"), ("k'", "e'")), ("a3", "k", "e", "a3'", "k'", "e'"),
                ("first", "second"))


def draw_quick_return(task: Task, board: Board, where: Places) -> None:
    P = lay_out(task, board, where)
    sides = {"OA": P["A"] - P["O"]}
    other = {"CF": 1j * (P["F"] - P["C"])}
    velocities = p, _, _, kk = inverted_velocities(task, board, where, P, sides)
    e = dyad(board, ("e by F", "e by K"), p, 1j * (P["E"] - P["F"]), kk, 1j * (P["E"] - P["K"]), other)
    e = board.put("first", "e", e, stroke_from=p)
    board.strokes.append((kk, e))
    pi, k1 = inverted_accelerations(task, board, where, P, sides, velocities)
    dyad_acceleration(board, where, P, "EKF", ("n_4", "n_5"), (abs(e - kk), abs(e - p)), (k1, pi), other)


# ---- forces ----------------------------------------------------------------------------------------------------------


def load_of(task: Task) -> complex:
    """The force of a task, as its scene has it."""
    x, y = task.scene.partition("value = [")[2].partition("]")[0].split(",")
    return complex(float(x), float(y))


def loaded(chance: random.Random, plan: str) -> Task:
    at, omega = four_bar_points(chance), chance.choice((-12, -8, -5, 4, 6, 10))
    F = cmath.rect(chance.uniform(90, 150), chance.uniform(0, math.tau))
    text = scene(at, {"1": "O A", "2": "A B M", "3": "B C", "frame": "O C"}, omega).partition("[find]")[0]
    text += (f'[[forces]]\non = "2"\nat = "M"\nvalue = [{F.real:.0f}, {F.imag:.0f}]\n[balance]\nlink = "1"\n'
             '[find]\nreactions = "all"\n')
    if plan == "lever":
        text = text.replace('reactions = "all"', 'velocity = ["B", "M"]')
        return Task("lever", text, at, omega, draw_lever, plan, ("P", "T", "ao", "mo"), ("b by A",), ("v_m",),
                    (("a_o", "m_o"), ("v_b", "v_m")), ("v_b", "v_m", "a_o", "m_o"), ())
    return Task("force polygon", text, at, omega, draw_force_polygon, plan, ("P", "T"), ("III by A", "III by C"), (),
                (("II", "III"),), ("III", "V"), ())


def draw_force_polygon(task: Task, board: Board, where: Places) -> None:
    """Of links 2 and 3, by the moment about B, then that of the crank with the arm of its moment."""
    P, F = lay_out(task, board, where), load_of(task) * where.ka
    sides = {"OC": P["C"] - P["O"], "AM": P["M"] - P["A"]}
    I = board.put("second", "I", where.second)
    II = board.put("second", "II", I + board.vector("P", F), stroke_from=I, head=True)
    link = P["A"] - P["B"]
    T = -((P["M"] - P["B"]).conjugate() * F).imag / abs(link) * 1j * link / abs(link)
    head = board.put("", "", I - board.vector("T", T), stroke_from=I)
    III = dyad(board, ("III by A", "III by C"), head, link, II, P["C"] - P["B"], sides)
    III = board.put("second", "III", III, stroke_from=II)
    board.strokes += [(head, III), (III, I)]
    IV = board.put("second", "IV", where.second + complex(70, -90))
    V = board.put("second", "V", IV + III - I, stroke_from=IV)
    way = (V - IV) / abs(V - IV)
    foot = P["A"] + way * ((P["O"] - P["A"]) * way.conjugate()).real
    board.strokes += [(P["A"], foot), (P["O"], foot)]


def draw_lever(task: Task, board: Board, where: Places) -> None:
    P, F = lay_out(task, board, where), load_of(task) * where.ka
    sides = {"AM": P["M"] - P["A"], "OA": P["A"] - P["O"]}
    va = orthogonal_velocity(board, "v_a", P, where, task.omega)
    vb = board.put("mechanism", "v_b", meet(P["C"], P["B"] - P["C"], va, board.along("b by A", P["B"] - P["A"], sides)),
                   stroke_from=P["B"])
    board.strokes.append((va, vb))
    r = board.ratio("v_m", (P["M"] - P["A"]) / (P["B"] - P["A"]))
    vm = board.put("mechanism", "v_m", va + r * (vb - va), stroke_from=P["M"])
    o = board.put("second", "o", where.second)
    a_o = board.put("second", "a_o", o + board.vector("ao", 1.5 * (va - P["A"])), stroke_from=o)
    m_o = board.put("second", "m_o", o + board.vector("mo", 1.5 * (vm - P["M"])), stroke_from=o)
    head = board.put("", "", m_o + board.vector("P", F), stroke_from=m_o, head=True)
    T = -((m_o - o).conjugate() * F).imag / abs(a_o - o)
    board.put("", "", a_o + board.vector("T", T * 1j * (a_o - o) / abs(a_o - o)), stroke_from=a_o, head=True)
    if min(abs(m_o - o), abs(m_o - a_o)) < 8 or head == m_o:
        raise Unfit("short arms")


# ---- poles and curvature ---------------------------------------------------------------------------------------------


def geometry(chance: random.Random, plan: str) -> Task:
    at, omega = four_bar_points(chance), chance.choice((-8, -5, 4, 6))
    text = scene(at, {"1": "O A", "2": "A B M", "3": "B C", "frame": "O C"}, omega).partition("[find]")[0]
    if plan == "poles":
        return Task("poles", text + '[find]\npoles = "all"\n', at, omega, draw_poles, "", (), ("P_20 by A", "P_20 by C",
                    "P_13 by A", "P_13 by O"), (), (("P_20", "P_13"),), ("P_20", "P_13"), ())
    return Task("curvature", text + '[find]\ncurvature = ["M on 2"]\n', at, omega, draw_curvature, "", (),
                ("P by A", "P by C", "Q by A", "Q by O", "R by P", "C_M by O"), (), (("P", "Q"), ("Q", "R")),
                ("P", "Q", "R", "C_M"), ())


def near(z: complex) -> complex:
    if abs(z) > FAR_MM:
        raise Unfit("far off")
    return z


def crossing(board: Board, letter: str, names: tuple[str, str], one: tuple[complex, complex],
             other: tuple[complex, complex], sides: Points) -> complex:
    """Where two lines through two points each cross, and the lines there."""
    z = near(dyad(board, names, one[0], one[1] - one[0], other[0], other[1] - other[0], sides))
    z = board.put("mechanism", letter, z, stroke_from=one[0])
    board.strokes.append((other[0], z))
    return z


def draw_poles(task: Task, board: Board, where: Places) -> None:
    P = lay_out(task, board, where)
    sides = {"AM": P["M"] - P["A"], "BM": P["M"] - P["B"]}
    crossing(board, "P_20", ("P_20 by A", "P_20 by C"), (P["O"], P["A"]), (P["C"], P["B"]), sides)
    crossing(board, "P_13", ("P_13 by A", "P_13 by O"), (P["B"], P["A"]), (P["C"], P["O"]), sides)


def draw_curvature(task: Task, board: Board, where: Places) -> None:
    """After Bobillier: the axes of two pairs of points make with their rays what the tangent makes."""
    P = lay_out(task, board, where)
    sides = {"BM": P["M"] - P["B"], "OB": P["B"] - P["O"]}
    pole = crossing(board, "P", ("P by A", "P by C"), (P["O"], P["A"]), (P["C"], P["B"]), sides)
    Q = crossing(board, "Q", ("Q by A", "Q by O"), (P["B"], P["A"]), (P["C"], P["O"]), sides)
    board.strokes += [(pole, Q), (pole, P["M"])]
    axis = (P["M"] - pole) / (P["B"] - P["C"]) * (Q - pole)
    R = near(meet(pole, board.along("R by P", axis, {}), P["A"], P["M"] - P["A"]))
    R = board.put("mechanism", "R", R, stroke_from=pole)
    board.strokes.append((P["A"], R))
    centre = near(meet(P["O"], board.along("C_M by O", R - P["O"], sides), pole, P["M"] - pole))
    centre = board.put("mechanism", "C_M", centre, stroke_from=P["O"])
    board.strokes.append((P["M"], centre))


# ---- plans of two kinds ----------------------------------------------------------------------------------------------


def turned(P: Points, ends: Points) -> Points:
    """The true velocities, from a pole at 0, that turned ones show which end here."""
    return {name: (end - P[name]) / 1j for name, end in ends.items()}


def four_bar_on_both(task: Task, board: Board, where: Places) -> None:
    P = lay_out(task, board, where)
    sides = {"AM": P["M"] - P["A"], "OC": P["C"] - P["O"]}
    va = orthogonal_velocity(board, "v_a", P, where, task.omega)
    vb = meet(P["C"], P["B"] - P["C"], va, board.along("b by A", P["B"] - P["A"], sides))
    vb = board.put("mechanism", "v_b", vb, stroke_from=P["B"])
    board.strokes.append((va, vb))
    r = (P["M"] - P["A"]) / (P["B"] - P["A"])
    board.put("mechanism", "v_m", va + board.ratio("v_m", r) * (vb - va), stroke_from=P["M"])
    v = turned(P, {"A": va, "B": vb})
    pi, a1, b1 = four_bar_accelerations(task, board, where, P, {name: 1j * side for name, side in sides.items()},
                                        (0j, v["A"], v["B"]))
    board.put("second", "m'", a1 + board.ratio("m'", r) * (b1 - a1), stroke_from=pi)


def slider_on_both(task: Task, board: Board, where: Places) -> None:
    P, k, kv, ka = lay_out(task, board, where), where.k, where.kv, where.ka
    sides = {"OA": P["A"] - P["O"]}
    share = (P["S"] - P["A"]) / (P["B"] - P["A"])
    va = orthogonal_velocity(board, "v_a", P, where, task.omega)
    vb = dyad(board, ("b by O", "b by A"), P["B"], 1j, va, P["B"] - P["A"], sides)
    vb = board.put("mechanism", "v_b", vb, stroke_from=P["B"])
    board.strokes.append((va, vb))
    board.put("mechanism", "v_s", va + share * (vb - va), stroke_from=P["S"])
    v = turned(P, {"A": va, "B": vb})
    pi = board.put("second", "π", where.second)
    a1 = board.put("second", "a'", pi - ka * task.omega**2 * (P["A"] - P["O"]) / k, stroke_from=pi)
    n = board.start("n_BA", a1, pi) + normal(board, "n_BA", abs(v["B"] - v["A"]), P["A"] - P["B"], k, kv, ka)
    n = board.put("second", "n_2", n, stroke_from=a1)
    b1 = dyad(board, ("b' by O", "b' by A"), pi, 1 + 0j, n, 1j * (P["B"] - P["A"]), {"OA": 1j * sides["OA"]})
    b1 = board.put("second", "b'", b1, stroke_from=pi)
    board.strokes.append((n, b1))
    board.put("second", "s'", a1 + share * (b1 - a1), stroke_from=pi)


def inverted_on_both(task: Task, board: Board, where: Places) -> None:
    P = lay_out(task, board, where)
    guide = P["A3"] - P["C"]
    sides = {"OA": P["A"] - P["O"]}
    va = orthogonal_velocity(board, "v_a", P, where, task.omega)
    v3 = board.put("mechanism", "v_a3", meet(P["C"], guide, va, board.along("a3 by A", 1j * guide, sides)),
                   stroke_from=P["A3"])
    board.strokes.append((va, v3))
    vk = P["C"] + (P["K"] - P["C"]) / guide * (v3 - P["C"])
    vk = board.put("mechanism", "v_k", vk, stroke_from=P["K"])
    v = turned(P, {"A": va, "A3": v3, "K": vk})
    inverted_accelerations(task, board, where, P, {"OA": 1j * sides["OA"]}, (0j, v["A"], v["A3"], v["K"]))


def on_both(make: Callable[[random.Random, str], Task], draw: Callable[[Task, Board, Places], None],
            loci: tuple[str, ...]) -> Callable[[random.Random, str], Task]:
    """The makers of a mechanism's tasks that are drawn so; `loci` are those whose direction may be wrong."""
    def task(chance: random.Random, plan: str) -> Task:
        polar = make(chance, "polar")

        def called(mark: str) -> str:
            return mark if mark.endswith("'") else f"v_{mark}"

        return replace(polar, draw=draw, plan=plan, loci=loci, figures=tuple(map(called, polar.figures)),
                       pairs=tuple((called(one), called(other)) for one, other in polar.pairs),
                       slips=tuple(map(called, polar.slips)), whole=("second",))

    return task


SINGLE: Makers = {
    "four-bar, polar": (four_bar, "polar"), "four-bar, orthogonal": (four_bar, "orthogonal"),
    "slider-crank, polar": (slider_crank, "polar"), "slider-crank, orthogonal": (slider_crank, "orthogonal"),
    "inverted slider-crank": (inverted, "polar"), "six-bar": (six_bar, "polar"),
    "six-bar, orthogonal": (six_bar_orthogonal, "orthogonal"),
    "inverted slider-crank, orthogonal": (inverted_orthogonal, "orthogonal"),
    "quick return": (quick_return, "polar"), "force polygon": (loaded, "polygons"), "lever": (loaded, "lever"),
    "poles": (geometry, "poles"), "curvature": (geometry, "curvature"),
}
BOTH: Makers = {
    "four-bar, both": (on_both(four_bar, four_bar_on_both, ("b by A", "b' by A", "b' by C")), "both"),
    "slider-crank, both": (on_both(slider_crank, slider_on_both, ("b by A", "b by O", "b' by A", "b' by O")), "both"),
    "inverted slider-crank, both": (on_both(inverted, inverted_on_both, ("a3 by A", "a3' by A", "a3' by C")), "both"),
}
MAKERS: Makers = {**SINGLE, **BOTH}
