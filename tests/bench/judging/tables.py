"""Measured points as a student types them in."""

from __future__ import annotations

import cmath
import math
import random

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from judging.hand import Sketch, ends, moved


def own_paper(sketch: Sketch, seed: int, scales: tuple[float, ...] = (1.0, 1.0, 1.0, 0.8, 1.25)) -> Sketch:
    """The drawing on the student's own sheet: elsewhere, turned, sometimes in another size."""
    chance = random.Random(f"paper {seed}")
    turn = cmath.exp(1j * math.radians(chance.choice((0.0, chance.gauss(0, 2), chance.uniform(-180, 180)))))
    shift, scale = complex(chance.uniform(-50, 150), chance.uniform(-50, 150)), chance.choice(scales)
    return moved(sketch, lambda at: shift + scale * turn * at)


def points(sketch: Sketch, seed: int, stated: bool = True) -> tuple[str, set[int]]:
    """A table of measured points, in half of all with lines and arcs; and which steps it shows.

    It is measured with a ruler of 0.1 to 0.5 mm, which is `stated` or left out.
    """
    chance, sketch = random.Random(f"table {seed}"), own_paper(sketch, seed)
    off = chance.choice((0.1, 0.2, 0.3) if not stated else (0.1, 0.2, 0.3, 0.5))
    curves, panels = chance.random() < 0.5, chance.random() < 0.75
    rows, shown = ["mark,x,y,panel,x2,y2,r,precision"], set()

    def read(value: float) -> str:
        return f"{value + chance.uniform(-off, off):.1f}"

    for step, place in zip(sketch.task.steps, sketch.places, strict=True):
        kind, index = step.op.gives, step.index
        if index in sketch.hidden or kind == OPENING or (kind != POINT and not curves):
            continue
        name = sketch.letters[index] or str(sketch.task.number(index))
        if kind == POINT:
            measured = [*place[:2], None, None, None]
        elif kind == LINE:
            start, end = ends(sketch, index, chance.uniform(0, 6))
            measured = [start.real, start.imag, end.real, end.imag, None]
        else:
            assert kind == CIRCLE
            measured = [place[0], place[1], None, None, place[2]]
        x, y, *rest = ("" if one is None else read(one) for one in measured)
        panel = sketch.task.places[index] if panels else ""
        rows.append(",".join([name, x, y, f'"{panel}"' if "," in panel else panel, *rest, f"{off}" if stated else ""]))
        shown.add(index)
    return "\n".join(rows) + "\n", shown
