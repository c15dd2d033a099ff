"""More tasks for drawings by another hand: six-bars, Coriolis's acceleration, forces, lever, poles, curvature."""

from __future__ import annotations

import cmath
import math
import random

from blackboard import (
    Board,
    Makers,
    Places,
    Points,
    Task,
    Unfit,
    dyad,
    four_bar_points,
    inverted,
    inverted_accelerations,
    inverted_velocities,
    lay_out,
    meet,
    normal,
    rounded,
    scene,
    six_bar,
    third,
    turned_normal,
)

FAR_MM = 260.0


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
    P, k, kv, ka = lay_out(task, board, where), where.k, where.kv, where.ka
    sides = {"OA": P["A"] - P["O"]}
    other = {"CF": 1j * (P["F"] - P["C"])}
    velocities = p, _, _, kk = inverted_velocities(task, board, where, P, sides)
    e = dyad(board, ("e by F", "e by K"), p, 1j * (P["E"] - P["F"]), kk, 1j * (P["E"] - P["K"]), other)
    e = board.put("first", "e", e, stroke_from=p)
    board.strokes.append((kk, e))
    pi, k1 = inverted_accelerations(task, board, where, P, sides, velocities)
    n4 = board.start("n_EK", k1, pi) + normal(board, "n_EK", abs(e - kk), P["K"] - P["E"], k, kv, ka)
    n4 = board.put("second", "n_4", n4, stroke_from=k1)
    n5 = board.start("n_EF", pi, k1) + normal(board, "n_EF", abs(e - p), P["F"] - P["E"], k, kv, ka)
    n5 = board.put("second", "n_5", n5, stroke_from=pi)
    e1 = dyad(board, ("e' by F", "e' by K"), n5, 1j * (P["E"] - P["F"]), n4, 1j * (P["E"] - P["K"]), other)
    e1 = board.put("second", "e'", e1, stroke_from=pi)
    board.strokes += [(n4, e1), (n5, e1)]


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


ADVANCED_MAKERS: Makers = {
    "six-bar, orthogonal": (six_bar_orthogonal, "orthogonal"),
    "inverted slider-crank, orthogonal": (inverted_orthogonal, "orthogonal"),
    "quick return": (quick_return, "polar"), "force polygon": (loaded, "polygons"), "lever": (loaded, "lever"),
    "poles": (geometry, "poles"), "curvature": (geometry, "curvature"),
}
