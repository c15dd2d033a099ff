"""What goes wrong in a class: mistakes of kinds that a teacher knows, each at a step where it makes a difference."""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Callable, Iterator

import numpy as np

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import CIRCLE, LINE, POINT, TABLE
from graphplan.sheet.plates.display import Rect
from judging.hand import Fault, Hand, Sketch, drawn
from judging.task import Task, Value

LEAST, MOST = 3.0, 90.0  # mm: what is less may be the pencil, what is more is off the paper


def faulty(task: Task, seed: int, *, printed: bool = False) -> Sketch:
    """A drawing with one mistake; what is given, where it is `printed`, is without."""
    chance = random.Random(f"fault {seed}")
    found = list(slips(task, chance))
    by_kind: dict[str, list[Fault]] = {}
    for fault in found:
        if not printed or task.number(fault.index):
            by_kind.setdefault(fault.kind, []).append(fault)
    for _ in range(400):
        if not by_kind:
            break
        kind = chance.choice(sorted(by_kind))
        fault = by_kind[kind].pop(chance.randrange(len(by_kind[kind])))
        if not by_kind[kind]:
            del by_kind[kind]
        try:
            made, right = (drawn(task, seed, one, printed=printed) for one in (fault, None))
        except (Undrawable, ValueError, ZeroDivisionError, OverflowError):
            continue
        if seen(made, right, fault) and not (printed and off_panel(made, right)):
            return made
    raise LookupError(f"{task.scene}: no mistake of these kinds can be made here")


def seen(made: Sketch, right: Sketch, fault: Fault) -> bool:
    """Whether a mistake can be told from a pencil's error, and what it leads to is still near the paper."""
    if fault.letters or fault.hidden:
        return True
    task, width = made.task, max(made.task.size)
    if any(not all(map(math.isfinite, place)) for place in made.places):
        return False
    if any(abs(place[k]) > 2.5 * width for step, place in zip(task.steps, made.places, strict=True)
           if step.op.gives == POINT for k in (0, 1)):
        return False
    if fault.kind == "scale forgotten" and similar(made, right, task.places[fault.index]):
        return False  # all of the plan in another scale: right, too
    return LEAST <= apart(made, right, fault.index) <= MOST


def off_panel(made: Sketch, right: Sketch) -> bool:
    """Whether the mistake drives marks off their plan's panel that should be on it."""
    views = made.task.composition.views
    return any(not grown(views[plan].rect, made.places[at]) and grown(views[plan].rect, right.places[at])
               for at, plan in enumerate(made.task.places) if made.task.steps[at].op.gives == POINT)


def grown(rect: Rect, at: Value) -> bool:
    """Whether a place is on a panel, or hardly off it."""
    return abs(at[0] - rect.centre[0]) <= rect.width / 2 + 4 and abs(at[1] - rect.centre[1]) <= rect.height / 2 + 4


def similar(made: Sketch, right: Sketch, plan: str) -> bool:
    """Whether two drawings of a plan differ by their place and size alone."""
    at = [step.index for step in made.task.steps if step.op.gives == POINT and made.task.places[step.index] == plan]
    one, other = (np.array([complex(*sketch.places[k]) for k in at]) for sketch in (made, right))
    one, other = one - one.mean(), other - other.mean()
    factor = np.vdot(other, one) / np.vdot(other, other)
    return bool(np.abs(one - factor * other).max() < LEAST)


def apart(made: Sketch, right: Sketch, index: int) -> float:
    """How far a mark is from where it should be, mm; a curve, where it is drawn."""
    kind, (one, other) = made.task.steps[index].op.gives, (made.places[index], right.places[index])
    if kind == POINT:
        return math.dist(one, other)
    if kind == LINE:
        points = [right.places[at] for at in right.task.holds(index)] or [other]
        return max(abs((p[0] - one[0]) * one[3] - (p[1] - one[1]) * one[2]) for p in points)
    return math.dist(one[:2], other[:2]) + abs(one[-1] - other[-1]) if kind == CIRCLE else abs(one[0] - other[0])


def slips(task: Task, chance: random.Random) -> Iterator[Fault]:
    """Every mistake that can be thought of at any step."""
    for step in task.steps:
        index, name = step.index, step.op.name
        if name == "given":
            yield from misread(task, index)
        elif name in {"parallel", "perpendicular"}:
            yield from set_square(task, index)
        elif name == "line":
            yield from through_another(task, index)
        elif name in {"circles_meet", "line_meets_circle"}:
            yield Fault(index, "wrong side", r"side|other crossing|crossing|mirrored", other_branch)
        elif name == "meet":
            yield from on_another(task, index)
        elif name in {"transfer", "step_off", "lay_off", "step_across", "quarter"}:
            yield from vectors(task, index)
        elif name == "circle":
            yield from about_another(task, index)
        if step.op.gives == POINT and name not in {"given", "begin", "pole", "pick"}:
            yield slip(index, chance)
            if index in task.asked:
                yield slip(index, chance, "final mark wrong")
    yield from exchanged(task)
    yield from mirrored(task)
    yield from left_out(task)
    yield from scale_forgotten(task)


def slip(index: int, chance: random.Random, kind: str = "slip") -> Fault:
    """A mark set beside its place by 3 to 30 mm."""
    size, angle = 3.0 * 10 ** chance.random(), chance.uniform(0, math.tau)

    def act(hand: Hand, at: int) -> Value:
        x, y = hand.right(at)
        reach = size / hand.task.scale(at)
        return x + reach * math.cos(angle), y + reach * math.sin(angle)

    return Fault(index, kind, "", act)  # a slip has no cause that could be told


def misread(task: Task, index: int) -> Iterator[Fault]:
    """Coordinates taken down wrongly."""
    told = r"(?i)coordinate|exchanged|sign|mirrored|misread"
    def changed(change: Callable[[float, float], Value]) -> Callable[[Hand, int], Value]:
        return lambda hand, at: change(*hand.right(at))
    by = 10 / task.scale(index)
    yield Fault(index, "misread by 10 mm", "", changed(lambda x, y: (x + by, y)))
    yield Fault(index, "misread by 10 mm", "", changed(lambda x, y: (x, y - by)))
    yield Fault(index, "misread", told, changed(lambda x, y: (y, x)))
    yield Fault(index, "misread", told, changed(lambda x, y: (x, -y)))


def others(task: Task, index: int, kind: str, of: int) -> list[int]:
    """Earlier marks of the plan of `of` which might be taken for it, nearest first."""
    return [at for at in range(index) if at != of and task.steps[at].op.gives == kind
            and task.places[at] == task.places[of] and at not in task.steps[index].args][-8:]


def set_square(task: Task, index: int) -> Iterator[Fault]:
    """The set square held the wrong way, to the wrong line or at the wrong point."""
    step = task.steps[index]
    line, point = step.args
    turned = "perpendicular" if step.op.name == "parallel" else "parallel"
    rule = TABLE[turned].rule
    yield Fault(index, f"{turned} for {step.op.name}", rf"{turned} instead of|not {step.op.name}|{turned} to",
                lambda hand, at: hand.by(rule, at, line, point))
    for other in others(task, index, LINE, line)[-3:]:
        yield Fault(index, "wrong line", r"instead of",
                    lambda hand, at, other=other: hand.by(step.op.rule, at, other, point))
    for other in others(task, index, POINT, point)[-3:]:
        yield Fault(index, "wrong point", r"instead of|through",
                    lambda hand, at, other=other: hand.by(step.op.rule, at, line, other))


def through_another(task: Task, index: int) -> Iterator[Fault]:
    """A line through a wrong point."""
    return _with_another(task, index, POINT, 3, r"instead of|through")


def on_another(task: Task, index: int) -> Iterator[Fault]:
    """A mark where a line meets another than it should."""
    return _with_another(task, index, LINE, 4, r"instead of|marked on|on ")


def _with_another(task: Task, index: int, kind: str, most: int, told: str) -> Iterator[Fault]:
    """One of what a step reads is another of its kind."""
    step = task.steps[index]
    for place, arg in enumerate(step.args):
        for other in others(task, index, kind, arg)[-most:]:
            args = tuple(other if k == place else a for k, a in enumerate(step.args))
            yield Fault(index, f"wrong {kind}", told,
                        lambda hand, at, args=args: hand.by(step.op.rule, at, *args))


def about_another(task: Task, index: int) -> Iterator[Fault]:
    """An arc about a wrong centre."""
    step = task.steps[index]
    for other in others(task, index, POINT, step.args[0])[-3:]:
        yield Fault(index, "wrong point", r"instead of|about",
                    lambda hand, at, other=other: hand.by(step.op.rule, at, other, step.args[1]))


def other_branch(hand: Hand, index: int) -> Value:
    """The other of two crossings."""
    step = hand.task.steps[index]
    key, = step.op.params
    turned = {"left": "right", "right": "left", "on": "back", "back": "on"}[step.params[key]]
    return hand.by(step.op.rule, index, *step.args, **{key: turned})


def vectors(task: Task, index: int) -> Iterator[Fault]:
    """A vector laid off with a wrong length or sense, or left out."""
    step, stage = task.steps[index], task.stage(index)
    root = step.args[-1] if step.op.name != "lay_off" else step.args[0]
    def laid(factor: float) -> Callable[[Hand, int], Value]:
        def act(hand: Hand, at: int) -> Value:
            (x, y), (u, v) = hand.values[root], hand.right(at)
            return x + factor * (u - x), y + factor * (v - y)
        return act
    law = "normal" if "ormal acc" in stage else "coriolis" if "oriolis" in stage else ""
    if law and task.places[index] != "mechanism":
        word = "normal acceleration" if law == "normal" else "coriolis"
        yield Fault(index, f"{word} omitted", r"(?i)omitted|left out|marked on|0 times|instead of", laid(0.0))
        yield Fault(index, f"{word} halved", r"(?i)halved|half|0\.5 times", laid(0.5))
        yield Fault(index, f"{word} reversed", r"(?i)reversed|other way|opposite|wrong sense|-1", laid(-1.0))
        return
    if step.op.name == "step_off" and "drive" in task.told["steps"][index]["why"]:
        return  # all velocities in another scale, or turned the other way: right, too
    yield Fault(index, "vector twice as long", r"2 times|double|twice|long", laid(2.0))
    yield Fault(index, "vector half as long", r"0\.5 times|half|halved|long", laid(0.5))
    yield Fault(index, "vector reversed", r"(?i)reversed|other way|opposite|sense", laid(-1.0))
    for other in others(task, index, POINT, root)[-3:]:
        args = (*step.args[:-1], other)
        yield Fault(index, "wrong point", r"instead of|from",
                    lambda hand, at, args=args: hand.by(step.op.rule, at, *args))


def exchanged(task: Task) -> Iterator[Fault]:
    """Two marks that bear each other's letters."""
    bear = [step.index for step in task.steps if step.name and step.op.gives == POINT and step.args]
    for one, other in itertools.pairwise(bear):
        apart = math.dist(*(task.paper(at, task.truth[at]) for at in (one, other)))
        if task.places[one] == task.places[other] and LEAST <= apart <= 2 * MOST:
            yield Fault(one, "labels exchanged", r"(?i)exchanged|label", letters={one: other, other: one})


def mirrored(task: Task) -> Iterator[Fault]:
    """A triangle on two marks drawn to the other side of them."""
    for step in task.steps:
        lines = [task.steps[arg] for arg in step.args] if step.op.name == "meet" else []
        if any(line.op.name not in {"parallel", "perpendicular"} for line in lines) or len(lines) != 2:
            continue
        one, other = (line.args[1] for line in lines)
        first, second = sorted(line.index for line in lines)
        if one == other or max(one, other) > first:
            continue

        def turned(hand: Hand, value: Value, one: int = one, other: int = other) -> Value:
            (x, y), (u, v) = hand.values[one], hand.values[other]
            along = math.atan2(v - y, u - x)
            a, b, c = value
            n = math.atan2(b, a)
            size, far = math.hypot(a, b), (a * x + b * y + c)
            a, b = size * math.cos(2 * along - n), size * math.sin(2 * along - n)
            return a, b, far - a * x - b * y

        def later(hand: Hand, index: int, value: Value, second: int = second,
                  turned: Callable[[Hand, Value], Value] = turned) -> Value:
            return turned(hand, value) if index == second else value

        yield Fault(first, "figure mirrored", r"(?i)mirror|instead of|not parallel|not perpendicular",
                    lambda hand, at, turned=turned: turned(hand, hand.right(at)), later)


def left_out(task: Task) -> Iterator[Fault]:
    """A vector that is asked for, and is not drawn."""
    for index in task.asked:
        if task.steps[index].args and not list(task.dependents(index)):
            lines = {arg for arg in task.steps[index].args if list(task.dependents(arg)) == [index]}
            yield Fault(index, "left out", "", hidden=frozenset({index, *lines}))


def scale_forgotten(task: Task) -> Iterator[Fault]:
    """Vectors of the N-plan laid off in the scale of the mechanism plan."""
    bear = [step.index for step in task.steps if step.op.name in {"transfer", "step_off", "quarter", "step_across"}
            and task.places[step.index] == "N-plan" and task.places[step.args[0]] == "mechanism"]
    if not bear:
        return
    factor = task.scale(task.steps[bear[0]].args[0]) / task.scale(bear[0])
    if abs(math.log(factor)) < 0.3:
        return

    def later(hand: Hand, index: int, value: Value) -> Value:
        if index not in bear:
            return value
        (x, y), (u, v) = hand.values[task.steps[index].args[-1]], value
        return x + factor * (u - x), y + factor * (v - y)

    yield Fault(bear[0], "scale forgotten", r"(?i)scale|times as|long|short|halved|doubled",
                lambda hand, at: later(hand, at, hand.right(at)), later)
