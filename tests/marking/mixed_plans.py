"""Drawings whose velocities and accelerations lie on plans of different kinds: velocities turned, each from its point
on the mechanism, accelerations true, all from one pole."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace

from advanced_boards import orthogonal_velocity
from blackboard import (
    Board,
    Makers,
    Places,
    Points,
    Task,
    dyad,
    four_bar,
    four_bar_accelerations,
    inverted,
    inverted_accelerations,
    lay_out,
    meet,
    normal,
    slider_crank,
)


def turned(P: Points, ends: dict[str, complex]) -> dict[str, complex]:
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


BOTH: Makers = {
    "four-bar, both": (on_both(four_bar, four_bar_on_both, ("b by A", "b' by A", "b' by C")), "both"),
    "slider-crank, both": (on_both(slider_crank, slider_on_both, ("b by A", "b by O", "b' by A", "b' by O")), "both"),
    "inverted slider-crank, both": (on_both(inverted, inverted_on_both, ("a3 by A", "a3' by A", "a3' by C")), "both"),
}
