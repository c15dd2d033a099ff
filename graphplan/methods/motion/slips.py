"""How far off a pencil draws the results of a construction: about, before it has a sheet.

Each plan is drawn as large as a sheet has room for it, so a slip of the pencil is the same part of the width of any. A
construction is drawn a few times with a small part of such slips, so that all curves still meet, and how each result
scatters is seen beside its own size. What a result is off by on its sheet is computed exactly where that is told
(accuracy/first_order.py).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from random import Random
from typing import Any

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel.kinds import LINE, OPENING, POINT, Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Panel, Step
from graphplan.methods.construction import Construction
from graphplan.methods.tolerances import EXTENT_TOL

SLIP = 0.1 / 120  # of the width of a plan: a tenth of a millimetre on a usual panel
PART = 0.01  # of a slip by which it is drawn
HANDS = 4  # how often it is drawn
COARSER = 2.05  # times as wide a plan may be for auxiliary marks
POOR = 0.1  # of a result: it is good or bad as it is drawn better or worse


def badness(drawing: Construction) -> float:
    """How bad the results are on the average, from 0 for exact ones to 1 for those that are off by all of themselves
    or that no pencil draws; one that is off by a tenth of itself counts one half."""
    try:
        slips, steady = _slips(drawing), _results(drawing, drawing.values)
        hands = [_results(drawing, _draw(drawing, slips, Random(seed))) for seed in range(HANDS)]
    except (ConstructionError, Undrawable):
        return 1.0
    largest = dict[str, float]()
    for (kind, _), value in steady.items():
        largest[kind] = max(abs(value), largest.get(kind, 0.0))
    errors = [math.sqrt(sum(abs(hand[name] - value) ** 2 for hand in hands) / HANDS) / abs(value) / PART
              for name, value in steady.items() if abs(value) > EXTENT_TOL * largest[name[0]]]
    return sum(error / (error + POOR) for error in errors) / max(1, len(errors))


def _slips(drawing: Construction) -> dict[Panel, float]:
    """How far a slip is off on each plan, in its lengths: on a plan as wide as its vectors and, on that of the
    mechanism, its points; and as its other marks, where they do not make it too much wider."""
    program, values, core, further = drawing.drawn, drawing.values, dict[Panel, list[Any]](), dict[Panel, list[Any]]()
    for vector in drawing.arrows:
        core.setdefault(vector.panel, []).extend((values[vector.start], values[vector.end]))
    for step in program.steps:
        if step.op.gives == POINT:
            spots = core if step.index < program.givens else further
            spots.setdefault(step.panel, []).append(values[step.index])
    return {panel: PART * SLIP * _width(core.get(panel, ()), further.get(panel, ())) for panel in {*core, *further}}


def _width(core: Sequence[Any], others: Sequence[Any]) -> float:
    """The larger side of the box of some points, and of the others that make it no more than `COARSER` times as wide.
    """
    points = core or others
    low, high = ([choose(float(point[axis]) for point in points) for axis in (0, 1)] for choose in (min, max))
    most = COARSER * max(high[0] - low[0], high[1] - low[1])
    for point in others:
        least, greatest = ([choose(side[axis], float(point[axis])) for axis in (0, 1)]
                           for side, choose in ((low, min), (high, max)))
        if max(greatest[0] - least[0], greatest[1] - least[1]) <= most:
            low, high = least, greatest
    return max(high[0] - low[0], high[1] - low[1])


def _draw(drawing: Construction, slips: Mapping[Panel, float], hand: Random) -> list[Any]:
    """The drawn marks, each with a slip of the hand; points of the pose that coincide are one."""
    marks, holes = list[Any](), dict[Any, Any]()
    for step in drawing.drawn.steps:
        exact = step.op.rule(Floats(), *[marks[arg] for arg in step.args], **step.params)
        slip = slips.get(step.panel, 0.0) if step.op.movement is not Movement.BEGUN else 0.0
        mark = _off(step, exact, slip, hand)
        marks.append(holes.setdefault(exact, mark) if step.index < drawing.drawn.givens else mark)
    return marks


def _off(step: Step, exact: Any, slip: float, hand: Random) -> Any:
    """A mark that is off by a slip of some size."""
    x, y = hand.gauss(0, slip), hand.gauss(0, slip)
    if step.op.gives == LINE:
        a, b, c = exact
        return a, b, c + math.hypot(a, b) * x
    if step.op.gives == OPENING:
        return ((math.sqrt(exact[0]) + x) ** 2,)
    return exact[0] + x, exact[1] + y, *exact[2:]


def _results(drawing: Construction, marks: Any) -> dict[tuple[str, str], complex]:
    """What is read from drawn marks, by kind and name, but for what is given; vectors as complex numbers."""
    wanted = [marks[index] for index in drawing.drawn.wanted]
    read = {(reading.kind, reading.of): drawing.value(reading, [wanted[k] for k in reading.marks], Floats())
            for reading in drawing.readings if reading.marks}
    return {name: complex(*value) if isinstance(value, tuple) else complex(value) for name, value in read.items()}
