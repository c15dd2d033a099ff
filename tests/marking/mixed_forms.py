"""Drawings in which each step is done by a form of its own: normal accelerations by the semicircle, by a right angle or
computed, velocities by loci or by the instant centre, third points by parallels; ends of normals lettered or not."""

from __future__ import annotations

import random
from dataclasses import replace

from advanced_boards import FAR_MM
from blackboard import NORMAL, Board, Drawing, Fault, Places, Task, Unfit, finish, meet, mistake_at, task_of
from formats import AUXILIARY

SEMICIRCLE, RIGHT_ANGLE, COMPUTED = "semicircle", "right angle", "computed"


class MixedForms:
    """Draws on the mechanism the figures of the forms that a seed chooses; `share` is what the figure of a normal
    acceleration has of its length on the plan of accelerations."""

    def __init__(self, seed: int, task: Task, where: Places):
        self.chance = random.Random(f"forms {seed}")
        self.share = (1 / where.ka if task.plan == "orthogonal" else where.kv**2 / where.k / where.ka)

    def draw(self, board: Board, name: str, vector: complex) -> None:
        """The figure in which the normal acceleration of this name is found."""
        found = NORMAL.fullmatch(name)
        form = self.chance.choice((SEMICIRCLE, RIGHT_ANGLE, COMPUTED))
        if not found or not vector or form == COMPUTED:
            return
        P, Q = (board.marks["mechanism", letter] for letter in found.groups())
        arm, foot = Q - P, abs(vector) * self.share
        along, speed = arm / abs(arm), (foot * abs(arm)) ** 0.5
        if form == SEMICIRCLE and speed < 0.95 * abs(arm):
            H = P + along * complex(foot, (speed**2 - foot**2) ** 0.5)
            turn = complex(0.94, 0.34)
            board.arcs += [((P + Q) / 2, Q, P), (P, P + (H - P) / turn, P + (H - P) * turn)]
            board.strokes.append((H, P + along * foot))
        elif speed < FAR_MM:
            V, N = P + 1j * along * speed, P - along * foot
            board.strokes += [(P, V), (V, Q), (V, N), (P, N)]


def _by_instant_centre(board: Board, chance: random.Random) -> None:
    """The rays of A and B to the instant centre of the coupler, half of the time where it is on the paper."""
    try:
        O, A, B, C = (board.marks["mechanism", letter] for letter in "OABC")
        pole = meet(O, A - O, C, B - C)
    except (KeyError, Unfit):
        return
    if chance.random() < 0.5 and abs(pole - A) < FAR_MM:
        board.strokes += [(A, pole), (B, pole)]


def drawing_by_mixed_forms(name: str, seed: int, fault: Fault | None = None) -> Drawing:
    """A drawing whose normal accelerations are found by several forms, of which some of the ends have letters."""
    task, chance = task_of(name, seed), random.Random(f"letters {seed}")
    if not any(map(NORMAL.fullmatch, task.vectors)):
        raise LookupError("no normal acceleration")
    drawing = finish(task, seed, fault, forms=lambda where: MixedForms(seed, task, where).draw)
    _by_instant_centre(drawing.board, chance)
    kept = {key: z for key, z in drawing.board.marks.items()
            if key[0] == "mechanism" or not AUXILIARY.fullmatch(key[1]) or chance.random() < 0.5}
    return replace(drawing, board=replace(drawing.board, marks=kept))


def mistaken_by_mixed_forms(name: str, seed: int) -> Drawing:
    """The same with one mistake, of a kind and at a place that the seed chooses."""
    return drawing_by_mixed_forms(name, seed, mistake_at(name, seed))
