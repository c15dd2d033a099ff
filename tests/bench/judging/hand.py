"""A hand that draws: each mark follows from the student's own earlier marks, by instruments that are a little off."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from judging.task import FLOATS, Task, Value

Act = Callable[["Hand", int], Value]  # what is drawn at a step in the place of what is right


@dataclass(frozen=True)
class Wobble:
    """How far off a hand is, as standard deviations: a pencil's dot, a ruler's edge and the dividers in mm, a set
    square in degrees."""

    dot: float = 0.1
    edge: float = 0.1
    dividers: float = 0.1
    angle: float = 0.05


@dataclass
class Hand:
    """A drawing in the making: `values` in units of the plans, by step."""

    task: Task
    chance: random.Random
    wobble: Wobble
    values: list[Value]

    def right(self, index: int) -> Value:
        """What a step gives from the student's own marks, without any wobble."""
        step = self.task.steps[index]
        return self.by(step.op.rule, index, *step.args)

    def by(self, rule: Callable[..., Value], index: int, *args: int, **params: object) -> Value:
        """What another rule, or the same on other marks, gives."""
        given = params or self.task.steps[index].params
        made = rule(FLOATS, *(self.values[arg] for arg in args), **given)
        return tuple(map(float, made))

    def off(self, index: int, sigma: float) -> float:
        """An error of so many mm, in units of the step's plan."""
        return self.chance.gauss(0, sigma) / self.task.scale(index)

    def shaken(self, index: int, value: Value) -> Value:
        """The same as the hand brings it about."""
        step, hand = self.task.steps[index], self.wobble
        if step.op.gives == POINT:
            if step.op.name in {"begin", "pole"}:
                return value
            extra = hand.dividers if step.op.instrument in {"dividers", "compasses", "scale"} and step.args else 0.0
            spread = math.hypot(hand.dot, extra)
            return value[0] + self.off(index, spread), value[1] + self.off(index, spread)
        if step.op.gives == LINE:
            return self._laid(index, value)
        (*centre, square) = value
        radius = max(0.0, math.sqrt(square) + self.off(index, hand.dividers))
        if step.op.gives == OPENING:
            return (radius**2,)
        return centre[0] + self.off(index, hand.dot), centre[1] + self.off(index, hand.dot), radius**2

    def _laid(self, index: int, value: Value) -> Value:
        """A line by a ruler at two points, or by a set square through one."""
        step = self.task.steps[index]
        through = [self.values[arg] for arg in step.args if self.task.steps[arg].op.gives == POINT]
        a, b, c = value
        n = math.hypot(a, b)
        if step.op.name == "line" and len(through) == 2:
            (x, y), (u, v) = ((p[0] + self.off(index, self.wobble.edge), p[1] + self.off(index, self.wobble.edge))
                              for p in through)
            return y - v, u - x, (v - y) * x - (u - x) * y
        x, y = through[-1] if through else (-a * c / n**2, -b * c / n**2)
        x, y = x + self.off(index, self.wobble.edge), y + self.off(index, self.wobble.edge)
        turn = math.radians(self.chance.gauss(0, self.wobble.angle))
        a, b = a * math.cos(turn) - b * math.sin(turn), a * math.sin(turn) + b * math.cos(turn)
        return a, b, -(a * x + b * y)


@dataclass(frozen=True)
class Sketch:
    """A finished drawing: where each mark is on the handout's paper (mm, y upward), and under which letter.

    `hidden` are marks that were left out; `fault` is the step at which it first went wrong.
    """

    task: Task
    places: list[Value]
    letters: Mapping[int, str]
    hidden: frozenset[int] = frozenset()
    fault: Fault | None = None
    wobble: Wobble = Wobble()


@dataclass(frozen=True)
class Fault:
    """What a student did wrong: at which step, what a teacher calls it, and in which words a judge may tell it."""

    index: int
    kind: str
    told: str  # a regular expression
    act: Act | None = None
    later: Callable[[Hand, int, Value], Value] | None = None  # what the same misunderstanding does to later steps
    letters: Mapping[int, int] | None = None  # marks that bear another's letter
    hidden: frozenset[int] = frozenset()


def drawn(task: Task, seed: int, fault: Fault | None = None, *, printed: bool = False) -> Sketch:
    """A drawing of this task; what is given is `printed` or drawn. Fails with `Undrawable` where lines no longer
    meet."""
    chance = random.Random(f"hand {seed}")
    rough = chance.uniform(0.5, 1.4)
    wobble = Wobble(0.1 * rough, 0.1 * rough, 0.1 * rough, 0.05 * rough)
    hand = Hand(task, chance, wobble, [])
    for step in task.steps:
        act = fault.act if fault and fault.index == step.index else None
        value = act(hand, step.index) if act else hand.right(step.index)
        if fault and fault.later and step.index > fault.index:
            value = fault.later(hand, step.index, value)
        given = printed and step.op.name in {"given", "begin", "pole"}
        hand.values.append(value if given else hand.shaken(step.index, value))
    letters = {step.index: task.letter(step.index) for step in task.steps}
    if fault and fault.letters:
        letters |= {mark: task.letter(other) for mark, other in fault.letters.items()}
    places = [task.paper(step.index, hand.values[step.index]) for step in task.steps]
    return Sketch(task, places, letters, fault.hidden if fault else frozenset(), fault, wobble)


def moved(sketch: Sketch, change: Callable[[complex], complex]) -> Sketch:
    """The same on a paper of other coordinates; `change` keeps angles, or mirrors them."""
    def place(index: int, value: Value) -> Value:
        kind = sketch.task.steps[index].op.gives
        if kind == OPENING:
            return (value[0] * abs(change(1) - change(0)),)
        at = change(complex(value[0], value[1]))
        if kind == LINE:
            to = change(complex(value[0] + value[2], value[1] + value[3])) - at
            to /= abs(to)
            return at.real, at.imag, to.real, to.imag
        if kind == CIRCLE:
            return at.real, at.imag, value[2] * abs(change(1) - change(0))
        return at.real, at.imag
    return replace(sketch, places=[place(index, value) for index, value in enumerate(sketch.places)])


def ends(sketch: Sketch, curve: int, overshoot: float = 0.0) -> tuple[complex, complex]:
    """From where to where a line is drawn: over the marks that lie on it, and beyond."""
    x, y, dx, dy = sketch.places[curve]
    along = sorted((sketch.places[at][0] - x) * dx + (sketch.places[at][1] - y) * dy
                   for at in sketch.task.holds(curve)) or [0.0]
    low, high = along[0] - overshoot, along[-1] + overshoot
    if high - low < 12:
        low, high = low - 8, high + 8
    foot, to = complex(x, y), complex(dx, dy)
    return foot + low * to, foot + high * to


def swept(sketch: Sketch, curve: int, beyond: float = 0.25) -> tuple[float, float] | None:
    """From which to which angle an arc is struck, radians; none where it is a full circle."""
    x, y, _ = sketch.places[curve]
    at = sorted(math.atan2(sketch.places[mark][1] - y, sketch.places[mark][0] - x)
                for mark in sketch.task.holds(curve))
    if not at:
        return None
    gaps = [((at[(k + 1) % len(at)] - at[k]) % math.tau or math.tau, k) for k in range(len(at))]
    gap, k = max(gaps)
    if gap < 1.2:
        return None
    start = at[(k + 1) % len(at)]
    return start - beyond, start + math.tau - gap + beyond
