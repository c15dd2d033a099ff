"""What is drawn, for tests of exports: any operation of the table on plans of different scale, and packaged scenes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from itertools import islice
from random import Random
from types import SimpleNamespace
from typing import Any, cast

import figures
from each import each

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import pencil
from graphplan.check.trusted import report
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, TABLE
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Panel, Program, evaluate
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import said
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.drawn_step import DrawnStep
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.view import View

Place = Callable[[Program, int], Panel]
NAMES = sorted(name for name in TABLE if not name.startswith("close_on"))
"""All operations but those that go on until lengths close: written out they are endless, and no file has them."""
TRIES = 2  # random figures for each operation
TWO = Panel("two", said("plan two"))
VIEWS: dict[str, View] = {MECHANISM: View(Rect(10, 10, 210, 130), 2.0, (110.0, 70.0)),
                          TWO: View(Rect(220, 10, 430, 130), 0.75, (330.0, 60.0))}


def programs(name: str) -> Iterator[tuple[Program, list[Any]]]:
    """Random programs that end with one use of an operation and can be drawn, with their values."""
    tried = (figures.figure(name, Random(seed)) for seed in range(100))
    drawn = ((program, figures.drawn(program, Floats())) for program in tried)
    good = list(islice(((program, values) for program, values in drawn if values is not None), TRIES))
    assert len(good) == TRIES
    yield from good


class Placed(Plans):
    """A program's plans: `place` says where the points that are given lie, and what is drawn there."""

    place: Place

    @cached_property
    def plan_of_step(self) -> list[Panel]:
        found: list[Panel] = []
        for step in self.drawing.drawn.steps:
            found.append(found[step.args[step.op.where]] if step.args else self.place(self.drawing.drawn, step.index))
        return found


def loose(program: Program, values: Sequence[Any], place: Place,
          views: Mapping[str, View] = VIEWS) -> Plates:
    """A program as it is drawn, without vectors and links."""
    scene = SimpleNamespace(title="A figure", source="", text="", points={}, links={}, moving=(), slides=(), drives=(),
                            loads=None, gears=(), contacts=(), joints=(), motions={}, links_of={},
                            sheet=SimpleNamespace(convention="real"), assembly=None,
                            units=SimpleNamespace(length="mm", force="N"))  # fmt: skip
    sentences = [program.sentence(step.index) for step in program.steps]
    drawing = SimpleNamespace(scene=scene, mechanism=scene, drawn=program, values=values, arrows=(), compounds=(),
                              sentences=lambda: sentences, kappa=1.0, phi=1.0)
    plans = Placed(cast(Construction, drawing))
    plans.__dict__["place"] = place
    return Plates(plans, views)


def together(_: Program, __: int) -> Panel:
    """All on one plan."""
    return MECHANISM


def apart(program: Program, index: int) -> Panel:
    """What the last operation may take from another plan is there, with what that is drawn with."""
    steps, near = program.steps, set[int]()
    waiting = [steps[-1].args[place] for place in steps[-1].op.same_plan_operands]
    while waiting:
        near.add(mark := waiting.pop())
        waiting += [steps[mark].args[place] for place in steps[mark].op.same_plan_operands]
    return MECHANISM if index in near or not steps[-1].op.afar else TWO


PLACES = each("place", [together, apart])


@lru_cache(maxsize=64)
def drafted_plates(name: str, strict: bool = False) -> tuple[Construction, Plates, Composition]:
    """A packaged scene constructed, as it is drawn, on its sheet."""
    found = report(gp.load(name), strict=strict)
    composition = draft(found.drawing, pencil(""), None, found.check).composition
    return found.drawing, composition.plates, composition


def moved(drawing: Construction, plates: Plates) -> tuple[DrawnStep, tuple[float, float], list[Any]]:
    """The last joint of the pose that steps read, elsewhere: where in mm, and the values of the program there."""
    point = [mark for mark in plates.all_marks if not mark.number and mark.index >= 0][-1]
    x, y = (part + 0.002 * plates.box.width / point.view.scale for part in point.value)
    return point, point.view((x, y)), evaluate(drawing.drawn, Floats(), {point.name: {"x": x, "y": y}})


def coordinates(mark: DrawnStep) -> list[float]:
    """A mark by what stands in a formula."""
    if mark.kind == OPENING:
        return [mark.radius]
    if mark.kind == CIRCLE:
        return [*mark.spot, mark.radius]
    if mark.kind != LINE:
        return list(mark.spot)
    a, b, c = mark.line
    return [-a * c / (a * a + b * b), -b * c / (a * a + b * b), b, -a]


def gap(mark: DrawnStep, found: Sequence[float]) -> float:
    """How far coordinates lie from a mark's, beside the size of its figure; a line's must run the same way."""
    size = 1.0 + math.hypot(*mark.view.origin) + max(map(abs, coordinates(mark)))
    if mark.kind != LINE:
        return max(abs(one - two) for one, two in zip(found, coordinates(mark), strict=True)) / size
    (a, b, c), (x, y, dx, dy) = mark.line, found
    off, turn = abs(a * x + b * y + c) / math.hypot(a, b), math.atan2(a * dx + b * dy, b * dx - a * dy)
    return off / size + abs(turn)


def farthest(plates: Plates, found: Mapping[DrawnStep, complex], values: Sequence[Any]) -> float:
    """How far points lie from the program's values, beside the size of the paper."""
    points = [mark for mark in plates.all_marks if mark in found and mark.index >= 0]
    assert points
    spots = {point: complex(*point.view(values[point.index][:2])) for point in points}
    return max(abs(found[point] - spots[point]) for point in points) / plates.box.width
