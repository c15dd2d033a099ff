"""The mistakes that are made on drawing boards: each is a step that is drawn in the place of another.

A mistake of the table says of which operations it can be made, by what their records say, and which slips it is. A slip
is a step like any other: another operation, other marks read, a vector turned or too long; so its rule gives what it
makes, in any domain of numbers. The same table finds the mistake that a drawing shows, and seeds the drawings that the
finding is tested on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from graphplan.kernel.kinds import CIRCLE, DIVIDERS, LINE, OPENING, POINT, Movement, Primitive, made_by
from graphplan.kernel.numbers import Domain
from graphplan.kernel.program import Program, Step
from graphplan.methods.motion.acceleration import CORIOLIS, NORMAL
from graphplan.phrases import Said, said
from graphplan.sheet.layout.scales import digits

FACTORS = (2.0, 0.5, 10.0, 0.1, 1.5)  # the scales that are mistaken for each other


@dataclass(frozen=True)
class Mistake:
    """A step as it is drawn by mistake: its kind, how it is told, and the step; what is laid off, or the radius, is
    multiplied by `factor`; a point is mirrored in the line of two marks."""

    kind: str
    told: Said
    step: Step
    factor: complex = 1.0
    mirror: tuple[int, int] | None = None

    def value(self, domain: Domain, values: Sequence[Any] | Mapping[int, Any]) -> Any:
        """What it makes of these marks; fails as the step's rule does."""
        made = self.step.op.rule(domain, *[values[arg] for arg in self.step.args], **self.step.params)
        if self.mirror:
            return _mirrored(domain, made, *(values[arg] for arg in self.mirror))
        if self.factor == 1.0:
            return made
        if self.step.op.gives == CIRCLE:
            return *made[:2], made[2] * abs(self.factor) ** 2
        assert self.step.root is not None, f"{self.step.op.name} lays nothing off"
        start = values[self.step.root]
        dx, dy, c, s = made[0] - start[0], made[1] - start[1], self.factor.real, self.factor.imag
        return start[0] + c * dx - s * dy, start[1] + s * dx + c * dy


def _mirrored(domain: Domain, point: Any, P: Any, Q: Any) -> Any:
    """A point on the other side of the line PQ."""
    u, w = (Q[0] - P[0], Q[1] - P[1]), (point[0] - P[0], point[1] - P[1])
    size = domain.nonzero(u[0] * u[0] + u[1] * u[1], 1.0, "points-coincide", "the two points coincide")
    along = (u[0] * w[0] + u[1] * w[1]) / size
    return P[0] + 2 * along * u[0] - w[0], P[1] + 2 * along * u[1] - w[1]


@dataclass(frozen=True)
class Occasion:
    """A step of a program, where a mistake can be made; `plan_of_step` is the plan of every step."""

    program: Program
    step: Step
    plan_of_step: Sequence[str]

    def text(self, place: int) -> str:
        """What the step reads at a place, by its letters."""
        return self.program.text(self.step.args[place])

    def instead(self, place: int, kind: str) -> Iterator[tuple[str, Step]]:
        """The step with another mark of the same plan read at a place, by the name of that mark."""
        step, home = self.step, self.plan_of_step[self.step.args[place]]
        for other in self.program.steps[:step.index]:
            if other.op.gives == kind and self.plan_of_step[other.index] == home and other.index not in step.args:
                args = (*step.args[:place], other.index, *step.args[place + 1:])
                yield self.program.text(other.index), replace(step, args=args)


Rule = Callable[[Occasion], Iterator[Mistake]]


@dataclass(frozen=True)
class MistakeKind:
    """One kind of mistake: at which operations it can be made, and as which slips."""

    kind: str
    at: Callable[[Primitive], bool]
    rule: Rule


MISTAKES: dict[str, MistakeKind] = {}


def mistake(kind: str, at: Callable[[Primitive], bool]) -> Callable[[Rule], Rule]:
    """Enter the decorated rule in the table, for the operations at which the mistake can be made."""

    def enter(rule: Rule) -> Rule:
        MISTAKES[kind] = MistakeKind(kind, at, rule)
        return rule

    return enter


def by(*movements: Movement) -> Callable[[Primitive], bool]:
    """The operations of some movements."""
    return lambda op: op.movement in movements


def laid_off(op: Primitive) -> bool:
    """The operations that lay a vector off."""
    return op.root is not None and op.movement is not Movement.DROPPED


def mistakes(program: Program, step: Step, plan_of_step: Sequence[str]) -> Iterator[Mistake]:
    """All the slips of the table that can be made at a step."""
    for entry in MISTAKES.values():
        if entry.at(step.op):
            yield from entry.rule(Occasion(program, step, plan_of_step))


ALIGNED = by(Movement.PARALLEL, Movement.PERPENDICULAR)


@mistake("perpendicular missed", by(Movement.PERPENDICULAR))
def _(occasion: Occasion) -> Iterator[Mistake]:
    yield Mistake("perpendicular missed", said("parallel to {0}, not perpendicular", occasion.text(0)),
               replace(occasion.step, op=made_by(Movement.PARALLEL)))


@mistake("parallel missed", by(Movement.PARALLEL))
def _(occasion: Occasion) -> Iterator[Mistake]:
    yield Mistake("parallel missed", said("perpendicular to {0}, not parallel", occasion.text(0)),
               replace(occasion.step, op=made_by(Movement.PERPENDICULAR)))


@mistake("wrong side", lambda op: op.crossing and bool(op.reversal))
def _(occasion: Occasion) -> Iterator[Mistake]:
    params = occasion.step.op.reversed(occasion.step.params)
    yield Mistake("wrong side", said("the other of the two crossings"), replace(occasion.step, params=params))


@mistake("mirrored figure", by(Movement.MET))
def _(occasion: Occasion) -> Iterator[Mistake]:
    """The third corner of a similar figure, on the other side of the line of two."""
    lines = [occasion.program.steps[arg] for arg in occasion.step.args]
    through = [line.args[-1] for line in lines if ALIGNED(line.op)]
    if len(set(through)) == 2 and lines[0].op is lines[1].op:
        yield Mistake("mirrored figure", said("the figure is mirrored"), occasion.step, mirror=(through[0], through[1]))


@mistake("reversed", laid_off)
def _(occasion: Occasion) -> Iterator[Mistake]:
    why = occasion.step.why
    if NORMAL.says(why):
        told = said("the normal acceleration points away from the centre")
    elif CORIOLIS.says(why):
        told = said("the Coriolis acceleration is reversed")
    else:
        told = said("the vector has the wrong sense")
    yield Mistake("reversed", told, occasion.step, -1.0)


@mistake("turned the wrong way", laid_off)
def _(occasion: Occasion) -> Iterator[Mistake]:
    for factor in (1j, -1j):
        yield Mistake("turned the wrong way", said("the vector is a quarter turn off"), occasion.step, factor)


@mistake("wrong scale", laid_off)
def _(occasion: Occasion) -> Iterator[Mistake]:
    for factor in FACTORS:
        told = said("the vector is {0} times as long as it should be", digits(factor, 2))
        yield Mistake("wrong scale", told, occasion.step, factor)


@mistake("wrong line", ALIGNED)
def _(occasion: Occasion) -> Iterator[Mistake]:
    for other, step in occasion.instead(0, LINE):
        told = (said("parallel to {0} instead of {1}", other, occasion.text(0)) if step.op.movement is Movement.PARALLEL
                else said("perpendicular to {0} instead of {1}", other, occasion.text(0)))
        yield Mistake("wrong line", told, step)


@mistake("wrong point", by(Movement.PARALLEL, Movement.PERPENDICULAR, Movement.RULED, Movement.DROPPED))
def _(occasion: Occasion) -> Iterator[Mistake]:
    for place, kind in enumerate(occasion.step.op.reads):
        for other, step in occasion.instead(place, POINT) if kind == POINT else ():
            yield Mistake("wrong point", said("drawn through {0} instead of {1}", other, occasion.text(place)), step)


@mistake("wrong crossing", lambda op: op.crossing)
def _(occasion: Occasion) -> Iterator[Mistake]:
    for place, kind in enumerate(occasion.step.op.reads):
        for other, step in occasion.instead(place, kind):
            yield Mistake("wrong crossing", said("marked on {0} instead of {1}", other, occasion.text(place)), step)


@mistake("wrong start", laid_off)
def _(occasion: Occasion) -> Iterator[Mistake]:
    place = occasion.step.op.root or 0
    for other, step in occasion.instead(place, POINT):
        yield Mistake("wrong start", said("laid off from {0} instead of {1}", other, occasion.text(place)), step)


@mistake("wrong vector", lambda op: op.movement is Movement.HALVED or (laid_off(op) and op.instrument == DIVIDERS))
def _(occasion: Occasion) -> Iterator[Mistake]:
    for place in (0, 1):
        for other, step in occasion.instead(place, POINT):
            yield Mistake("wrong vector", said("taken from {0} instead of {1}", other, occasion.text(place)), step)


@mistake("wrong centre", by(Movement.STRUCK))
def _(occasion: Occasion) -> Iterator[Mistake]:
    for other, step in occasion.instead(0, POINT):
        yield Mistake("wrong centre", said("struck about {0} instead of {1}", other, occasion.text(0)), step)


@mistake("wrong opening", by(Movement.STRUCK))
def _(occasion: Occasion) -> Iterator[Mistake]:
    for factor in (2.0, 0.5):
        told = said("the radius is {0} times as large as it should be", digits(factor, 2))
        yield Mistake("wrong opening", told, occasion.step, factor)
    for other, step in occasion.instead(1, OPENING):
        yield Mistake("wrong opening", said("struck with {0} instead of {1}", other, occasion.text(1)), step)


@mistake("exchanged coordinates", by(Movement.GIVEN))
def _(occasion: Occasion) -> Iterator[Mistake]:
    x, y = (occasion.step.params[name] for name in "xy")
    for told, (u, v) in ((said("x and y are exchanged"), (y, x)), (said("x has the wrong sign"), (-x, y)),
                         (said("y has the wrong sign"), (x, -y))):
        yield Mistake("exchanged coordinates", told, replace(occasion.step, params={"x": u, "y": v}))
