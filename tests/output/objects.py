"""Objects for tests of the exports: any operation of the table on plans of different scale, and packaged scenes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import islice
from random import Random
from typing import Any

import figures

import graphplan as gp
from graphplan.accuracy.drafted import drafted
from graphplan.accuracy.pencil import pencil
from graphplan.check.report import report
from graphplan.kernel.evaluate import evaluate
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, TABLE
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Program
from graphplan.methods.construction import Construction
from graphplan.output.exports.figure import Figure, Object, Plan, figure
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.display import Rect

NAMES = sorted(TABLE)
TRIES = 2  # random figures for each operation
ONE = Plan("one", "Plan one", 2.0, (110.0, 70.0), Rect(10, 10, 210, 130))
TWO = Plan("two", "Plan two", 0.75, (330.0, 60.0), Rect(220, 10, 430, 130))


def programs(name: str) -> Iterator[tuple[Program, list[Any]]]:
    """Random programs that end with one use of an operation and can be drawn, with their values."""
    tried = (figures.figure(name, Random(seed)) for seed in range(100))
    drawn = ((program, figures.drawn(program, Floats())) for program in tried)
    good = list(islice(((program, values) for program, values in drawn if values is not None), TRIES))
    assert len(good) == TRIES
    yield from good


def objects(program: Program, values: Sequence[Any], apart: bool, called: str = "X") -> tuple[Object, ...]:
    """A program as objects: on one plan, or every third point, and what is drawn there, on another."""
    found: list[Object] = []
    for step, value in zip(program.steps, values, strict=True):
        args = tuple(found[arg] for arg in step.args)
        plan = args[step.op.where].plan if args else TWO if apart and step.index % 3 == 1 else ONE
        found.append(Object(step.index, max(0, program.number(step.index)), f"{called}{step.index}", step, plan, args,
                            tuple(map(float, value)), program.sentence(step.index)))
    return tuple(found)


def loose(program: Program, values: Sequence[Any], apart: bool) -> Figure:
    """A program as a figure without vectors and links."""
    found = objects(program, values, apart)
    return Figure("A figure", "", (ONE, TWO), found, (), (), dict.fromkeys(found, ()))


def all_operations(apart: bool) -> Figure:
    """A program for each operation of the table, all in one figure."""
    found = [object for place, name in enumerate(NAMES)
             for object in objects(*next(programs(name)), apart, f"X{place}n")]
    return Figure("All operations", "", (ONE, TWO), tuple(found), (), (), dict.fromkeys(found, ()))


@lru_cache(maxsize=8)
def drafted_figure(name: str, strict: bool = False) -> tuple[Construction, Figure, Composition]:
    """A packaged scene constructed, as objects, on its sheet."""
    found = report(gp.load(name), strict=strict)
    composition = drafted(found.drawing, pencil(""), None, found.check).composition
    return found.drawing, figure(found.drawing, composition), composition


def moved(drawing: Construction, figure: Figure) -> tuple[Object, tuple[float, float], list[Any]]:
    """The last joint of the pose that steps read, elsewhere: where in mm, and the values of the program there."""
    point = [object for object in figure.objects if not object.number and object.index >= 0][-1]
    x, y = (part + 0.002 * figure.box.width / point.plan.scale for part in point.value)
    return point, point.plan((x, y)), evaluate(drawing.drawn, Floats(), {point.name: {"x": x, "y": y}})


def coordinates(object: Object) -> list[float]:
    """An object by what stands in a formula."""
    if object.kind == OPENING:
        return [object.radius]
    if object.kind == CIRCLE:
        return [*object.at, object.radius]
    if object.kind != LINE:
        return list(object.at)
    a, b, c = object.line
    return [-a * c / (a * a + b * b), -b * c / (a * a + b * b), b, -a]


def gap(object: Object, found: Sequence[float]) -> float:
    """How far coordinates lie from an object's, beside the size of its figure; a line's must run the same way."""
    size = 1.0 + math.hypot(*object.plan.origin) + max(map(abs, coordinates(object)))
    if object.kind != LINE:
        return max(abs(one - two) for one, two in zip(found, coordinates(object), strict=True)) / size
    (a, b, c), (x, y, dx, dy) = object.line, found
    off, turn = abs(a * x + b * y + c) / math.hypot(a, b), math.atan2(a * dx + b * dy, b * dx - a * dy)
    return off / size + abs(turn)


def farthest(figure: Figure, found: Mapping[Object, complex], values: Sequence[Any]) -> float:
    """How far points lie from the program's values, beside the size of the paper."""
    points = [object for object in figure.objects if object in found and object.index >= 0]
    assert points
    spots = {point: complex(*point.plan(values[point.index][:2])) for point in points}
    return max(abs(found[point] - spots[point]) for point in points) / figure.box.width
