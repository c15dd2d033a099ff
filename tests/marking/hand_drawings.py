"""Drawings as a class hands them in: right, with one mistake, or with a whole plan reversed, turned or scaled; of mixed
forms, of results alone, redrawn after the task's own steps, or tables of numbers. A seed gives the same drawing."""

from __future__ import annotations

import csv
import io
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from zlib import crc32

from drawing_board import (
    HEAD_MM,
    LEAST_MM,
    MISTAKES,
    NORMAL,
    NUMBERS,
    ONCE,
    WHOLE,
    Board,
    Fault,
    Places,
    Task,
    Unfit,
    meet,
)
from drawing_tasks import FAR_MM, MAKERS
from face import ran

AUXILIARY = re.compile(r"n_\d|k_A|c|f|R|Q")  # marks of which no result is read
RESULT_END = re.compile(r"[abdem]'?|v_[abdem]")  # marks in which vectors end that are asked for
PANELS = {"mechanism": "mechanism", "second": "N-plan"}
Forms = Callable[[Places], Callable[[Board, str, complex], None]]


@dataclass(frozen=True)
class Drawing:
    """A finished drawing: its task, its marks, and what is wrong with it, if anything; or a table of numbers."""

    task: Task
    board: Board
    fault: Fault | None = None
    numbers: tuple[str, ...] = ()

    @property
    def heads(self) -> list[tuple[complex, complex, complex]]:
        """The heads of its arrows, each by its tip and its two other corners."""
        return [(end, *(end - HEAD_MM * (end - start) / abs(end - start) * (1 + side * 0.25j) for side in (1, -1)))
                for start, end in self.board.arrows if abs(end - start) > 0.5]

    @property
    def letters(self) -> list[tuple[str, complex]]:
        return [(letter, z) for (_, letter), z in self.board.marks.items()]

    @property
    def text(self) -> str:
        """The marks as a student measures them, or his numbers."""
        if self.numbers:
            return "\n".join(["quantity,of,x,y,value", *self.numbers]) + "\n"
        if self.task.plan not in ("orthogonal", "own"):
            return "mark,x,y\n" + "".join(f"{letter},{z.real:.1f},{z.imag:.1f}\n" for letter, z in self.letters)
        rows = ([letter, f"{z.real:.1f}", f"{z.imag:.1f}", PANELS.get(plan, plan)]
                for (plan, letter), z in self.board.marks.items())
        csv.writer(text := io.StringIO(), lineterminator="\n").writerows([("mark", "x", "y", "panel"), *rows])
        return text.getvalue()


def places(chance: random.Random, task: Task) -> Places:
    """Scales and places of the student's own, such that the plans lie beside each other on A3."""
    k = chance.choice((0.43, 0.47, 0.53))  # no scale that is printed: then the others would be those printed, too
    A = task.points["A"]
    turned = chance.choice((0.4, 0.5, 0.6)) * k / abs(task.omega) if task.plan in (
        "orthogonal", "polygons", "lever", "") else 0.0  # a velocity of A so many times OA
    if task.plan == "orthogonal":
        return Places(60 + 90j, 0j, 280 + 150j, k, turned, chance.uniform(1.5, 3.0))
    if turned:
        return Places(110 + 90j, 0j, 330 + 200j, k, turned, chance.choice((0.3, 0.4, 0.5)))
    kv = chance.uniform(30, 60) / (abs(task.omega) * abs(A))
    if task.plan == "both":
        kv = chance.choice((0.4, 0.5, 0.6)) * k / abs(task.omega)
    ka = chance.uniform(40, 70) / (task.omega**2 * abs(A))
    return Places(complex(100, 60), complex(chance.uniform(60, 120), chance.uniform(190, 230)),
                  complex(chance.uniform(280, 320), chance.uniform(120, 180)), k, kv, ka)


def finish(task: Task, seed: int, fault: Fault | None = None, forms: Forms | None = None) -> Drawing:
    """A drawing; fails with `Unfit` where it would be none."""
    chance = random.Random(f"hand {seed}")
    where = places(random.Random(f"places {seed}"), task) if task.points else Places(0j, 0j, 0j, 1, 1, 1)
    board = Board(chance, fault, forms=forms and forms(where))
    task.draw(task, board, where)
    if fault and fault.kind in WHOLE:
        inside = {key: z for key, z in board.marks.items() if key[0] == fault.mark}
        pole = next(iter(inside.values()))
        old = {z: pole + fault.by * (z - pole) for z in inside.values()}
        board.marks |= {key: old[z] for key, z in inside.items()}
        board.strokes = [(old.get(one, one), old.get(other, other)) for one, other in board.strokes]
        board.done = True
    if fault and fault.kind == "letters":
        one, other = (next(key for key in board.marks if key[1] == letter) for letter in fault.mark.split("+"))
        board.marks[one], board.marks[other] = board.marks[other], board.marks[one]
        board.done = True
    on_paper = all(-60 < z.real < 480 and -80 < z.imag < 380 for z in board.marks.values())
    if not on_paper or (fault and not board.done):
        raise Unfit("off the paper")
    return Drawing(task, board, fault)


@cache
def task_of(name: str, seed: int) -> Task:
    """A task of a kind."""
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
    return finish(task_of(name, seed), seed, mistake_at(task_of(name, seed), seed))


def mistake_at(task: Task, seed: int) -> Fault:
    """The mistake of a seed, which shows in the drawing."""
    chance = random.Random(f"mistake {seed}")
    faults = [Fault(kind, mark, by) for kind in ONCE for mark in MISTAKES[kind].marks(task)
              if (by := MISTAKES[kind].by(chance, task, mark)) is not None]
    kinds = sorted({fault.kind for fault in faults})
    true = finish(task, seed).board.marks
    for _ in range(300):
        kind = chance.choice(kinds)
        fault = chance.choice([one for one in faults if one.kind == kind])
        try:
            made = finish(task, seed, fault)
        except Unfit:
            continue
        if LEAST_MM < max(abs(z - true[key]) for key, z in made.board.marks.items()) < 150:
            return fault
    raise LookupError("no mistake shows")


def wrong_as_a_whole(name: str, seed: int) -> Drawing:
    """A drawing with a plan that is reversed, turned or at another scale."""
    task, chance = task_of(name, seed), random.Random(f"whole {seed}")
    if not task.whole:
        raise LookupError("no plan of its own")
    for _ in range(50):
        plan, kind = chance.choice(task.whole), chance.choice(WHOLE)
        try:
            return finish(task, seed, Fault(kind, plan, MISTAKES[kind].by(chance, task, plan) or 1.0))
        except Unfit:
            continue
    raise LookupError("no plan fits")


def results_alone(drawing: Drawing) -> Drawing:
    """The same with the marks of results, and their vectors alone."""
    marks = {key: z for key, z in drawing.board.marks.items() if key[0] == "mechanism" or not AUXILIARY.fullmatch(
        key[1])}
    kept = [stroke for stroke in drawing.board.strokes if set(stroke) <= set(marks.values())]
    return replace(drawing, board=replace(drawing.board, marks=marks, strokes=kept, arcs=[]))


def without_result(drawing: Drawing, seed: int) -> Drawing:
    """A drawing without the mark of one vector that is asked for, and without the strokes that end there."""
    ends = [key for key in drawing.board.marks if RESULT_END.fullmatch(key[1]) and key[0] != "mechanism"] or [
        key for key in drawing.board.marks if key[1].startswith("v_")]
    if not ends:
        raise LookupError("no vector")
    key = random.Random(f"removed {seed}").choice(ends)
    board, at = drawing.board, drawing.board.marks[key]
    marks = {other: z for other, z in board.marks.items() if other != key}
    kept, arrows = ([stroke for stroke in strokes if at not in stroke] for strokes in (board.strokes, board.arrows))
    return replace(drawing, board=replace(board, marks=marks, strokes=kept, arrows=arrows))


# ---- other forms -----------------------------------------------------------------------------------------------------


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


def by_mixed_forms(name: str, seed: int, fault: Fault | None = None) -> Drawing:
    """Normal accelerations by the semicircle, by a right angle or computed, velocities by loci or by the instant
    centre, each by a form of its own; of the ends of vectors some have letters."""
    task, chance = task_of(name, seed), random.Random(f"letters {seed}")
    if not any(map(NORMAL.fullmatch, task.vectors)):
        raise LookupError("no normal acceleration")
    drawing = finish(task, seed, fault, lambda where: MixedForms(seed, task, where).draw)
    _by_instant_centre(drawing.board, chance)
    kept = {key: z for key, z in drawing.board.marks.items()
            if key[0] == "mechanism" or not AUXILIARY.fullmatch(key[1]) or chance.random() < 0.5}
    return replace(drawing, board=replace(drawing.board, marks=kept))


def mistaken_by_mixed_forms(name: str, seed: int) -> Drawing:
    """The same with one mistake, of a kind and at a place that the seed chooses."""
    return by_mixed_forms(name, seed, mistake_at(task_of(name, seed), seed))


# ---- after the task's own steps, and tables --------------------------------------------------------------------------


FOLDER = TemporaryDirectory()  # of the scenes that no file has


def scene_file(task: Task) -> str:
    """The scene of a task, as a file, or the name of a packaged one."""
    if "\n" not in task.scene:
        return task.scene
    path = Path(FOLDER.name) / f"task-{crc32(task.scene.encode()):x}.toml"
    path.write_text(task.scene)
    return str(path)


@cache
def steps_of(scene: str, *options: str) -> list[dict[str, Any]]:
    """The steps of a scene's construction, given as data."""
    return list(ran("steps", scene, "--json", *options).json["steps"])


@cache
def retraced_task(scene: str) -> Task:
    """A packaged scene as a task, drawn after its own sheet; some letter may be put elsewhere, or two exchanged."""
    rows = [(str(step["plan"]), str(step["makes"]).removeprefix("point "), complex(*step["paper"]).conjugate() + 250j,
             step["operation"]) for step in steps_of(scene) if step["kind"] == "point"]
    letters = [letter for _, letter, _, how in rows if how not in ("given", "begin", "pole") and not letter.isdigit()]
    letters = [letter for letter in letters if letters.count(letter) == 1]
    at = {letter: z for _, letter, z, _ in rows}
    pairs = [pair for pair in pairwise(letters) if abs(at[pair[0]] - at[pair[1]]) > LEAST_MM]

    def draw(task: Task, board: Board, where: Places) -> None:
        for plan, letter, z, _ in rows:
            board.put(plan, letter, z)

    return Task("own", scene, {}, 1.0, draw, "own", (), (), (), tuple(pairs), tuple(letters), ())


def retraced(scene: str, seed: int) -> Drawing:
    """All points of a scene's own sheet, measured by another hand."""
    return finish(retraced_task(scene), seed)


def mistaken_retraced(scene: str, seed: int) -> Drawing:
    """The same with a mark beside its place, or the letters of two exchanged."""
    return finish(retraced_task(scene), seed, mistake_at(retraced_task(scene), seed))


def rows_of(results: Any, fault: Fault | None) -> Iterator[str]:
    """The results of a scene as rows of a table, one of its vectors wrong."""
    vectors = {f"{quantity},{of}": value for of, row in results["points"].items() for quantity, value in row.items()}
    vectors |= {f"slide {quantity},{of}": value for of, row in results["slides"].items()
                for quantity, value in row.items()}
    for name, (x, y) in vectors.items():
        if x or y:
            z = complex(x, y) * (fault.by if fault and fault.mark == name.replace(",", " ") else 1.0)
            yield f"{name},{z.real:.5g},{z.imag:.5g},"
    for of, quantities in results["links"].items():
        yield from (f"{quantity},{of},,,{value:.5g}" for quantity, value in quantities.items())


def table(scene: str, seed: int, fault: Fault | None = None) -> Drawing:
    """The results of a scene, read to five digits."""
    return Drawing(replace(retraced_task(scene), plan=""), Board(random.Random(seed)), fault,
                   tuple(rows_of(ran("solve", scene).json, fault)))


def mistaken_table(scene: str, seed: int) -> Drawing:
    """The same with a number of the wrong sign, turned, or ten times too large."""
    chance, whole = random.Random(f"table {seed}"), table(scene, seed)
    vectors = [" ".join(row.split(",")[:2]) for row in whole.numbers if row.split(",")[2]]
    kind, mark = chance.choice(NUMBERS), chance.choice(vectors)
    return table(scene, seed, Fault(kind, mark, MISTAKES[kind].by(chance, whole.task, mark) or 1.0))
