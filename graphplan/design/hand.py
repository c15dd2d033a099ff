"""A hand with a pencil: how far off it draws, and what that does to every result, to first order.

Each slip of the hand counts with the square of its standard deviation times the result's derivative by it; so each
step has its share of a result's variance. A vector's error is the root mean square distance of its drawn end. On paper
a turning's is what it makes of the relative vector that it is read off; a moment is not read off one vector. Where
curves cross so flat that floats have no derivatives, the errors of what hangs on them have no bound: they are infinite.

| what is drawn                                        | slips                                                        |
|------------------------------------------------------|--------------------------------------------------------------|
| a point: given, met, laid off by scale or dividers   | in x and in y                                                |
| a line through two points                            | across it at each of the two                                 |
| a line by set squares, or in a given direction       | across it where it passes through its point, and its turning |
| a normal acceleration or a part that is computed     | the same, and along it what its lengths are misread by       |
| an opening                                           | its length                                                   |
| an arc                                               | its needle, in x and in y                                    |
| a trial point, picked on a line                      | across the line: along it any point will do                  |
| the beginning of a plan                              | none: any place will do                                      |

Points of the pose that coincide are one hole in the paper.

The pencil says how far off a careful hand is, in millimetres of paper whatever the scale. A tenth of a millimetre each
way puts nineteen points out of twenty within a quarter of a millimetre: the width of a narrow line (ISO 128-2), and
what surveying counts on as plotting accuracy (measured by N. D. Haasbroek, Investigation of the accuracy of plotting
and scaling-off, Delft 1955). Set squares turn as far as such an edge does that is laid along 160 mm of a line: 0.1 mm
at both ends, times the root of two, over 160 mm is a twentieth of a degree.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, dataclass, fields
from functools import cached_property
from itertools import accumulate
from typing import Any

import numpy as np

from graphplan.design.tolerances import MAX_GROWTH
from graphplan.errors import Refused, Undrawable
from graphplan.kernel import kinds
from graphplan.kernel.kinds import POINT, Movement, Sizing
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.gradients import Gradients
from graphplan.kernel.program import Panel, Program, Step
from graphplan.methods.construction import Construction
from graphplan.methods.recorded import components
from graphplan.phrases import Said, digits, said

UNBOUNDED = np.errstate(all="ignore")  # errors without bound are infinite, and nothing to warn of


@dataclass(frozen=True)
class Pencil:
    """Standard deviations of single movements: `point`, `edge` and `opening` in mm of paper, `angle` in degrees.

    `point` is that of a pricked point in x and in y, or of the compasses' needle; `edge` that of a ruler's edge at each
    point that it is laid at; `angle` that of a direction carried over by set squares; `opening` that of the compasses.
    """

    point: float = 0.1
    edge: float = 0.1
    angle: float = 0.05
    opening: float = 0.1

    @property
    def slope(self) -> float:
        """The angle as the slope that a line gets by it, in first order."""
        return math.radians(self.angle)

    def times(self, factor: float) -> Pencil:
        """A pencil that is so many times as unsteady."""
        return Pencil(*(deviation * factor for deviation in asdict(self).values()))

    @property
    def model(self) -> dict[str, float]:
        """The model as data."""
        return asdict(self)

    @property
    def text(self) -> str:
        """Text of the pencil, as :func:`pencil` reads it."""
        return ",".join(f"{name}={deviation!r}" for name, deviation in self.model.items())

    @property
    def description(self) -> Said:
        """The model in words."""
        sizes = (self.point, self.edge, self.angle, self.opening)
        return said("points ±{0} mm, edges ±{1} mm, set squares ±{2}°, openings ±{3} mm", *map(digits, sizes))


@dataclass(frozen=True)
class SeenPencil:
    """The pencil by which a drawing is judged: so many times as unsteady as the `stated` one; the standard deviation of
    reading its marks, mm, relative to what is stated for each, and the part of that which they show. `marks` is how
    many of them tell it, 0 if it is assumed.
    """

    stated: Pencil
    scale: float
    reading: float
    marks: int = 0
    share_shown: float = 1.0

    @property
    def pencil(self) -> Pencil:
        return self.stated.times(self.scale)

    @property
    def description(self) -> Said:
        """In words."""
        point, reading = digits(self.pencil.point, 2), digits(self.reading, 2)
        return said("{0} mm, marks measured to {1} mm", point, reading) if self.reading else said("{0} mm", point)

    @property
    def record(self) -> dict[str, float]:
        """Standard deviations by name, in mm and degrees, for JSON."""
        return {**self.pencil.model, "reading": self.reading, "marks": self.marks}


COMPUTED = {Sizing.QUOTIENT: (0, 1), Sizing.PROPORTION: (3, 4)}  # the operands between which such a vector runs
Slips = tuple[float, ...]
Errors = Callable[[int], Sequence[Any]]  # the errors of a step, in a number domain


@dataclass(frozen=True)
class Hand:
    """A program as a hand draws it: `values` are what it should be, `slips` the deviations of each step, in plan
    units and, of turnings, as tangents."""

    program: Program
    values: Sequence[Any]
    slips: Sequence[Slips]

    def draw(self, domain: Domain, errors: Errors, beyond: Errors,
             is_lost: Callable[[Step, Any], bool] = lambda step, mark: False) -> list[Any]:
        """Every step in a number domain, each with its errors, which the later ones then read.

        What floats cannot draw, or is lost, lies too near to a singular pose for any pencil: `beyond` gives its mark.
        """
        marks: list[Any] = []
        for step in self.program.steps:
            try:
                mark = self.draw_step(step, domain, marks, errors)
            except Undrawable:
                mark = beyond(step.index)
            marks.append(beyond(step.index) if is_lost(step, mark) else mark)
        return marks

    def draw_step(self, step: Step, domain: Domain, drawn: Sequence[Any], errors: Errors) -> Any:
        """One step, from what it reads as it is drawn; it fails as its rule does."""
        hole = self._holes.get(step.index, step.index)
        if hole < step.index:
            return drawn[hole]
        exact = step.op.rule(domain, *[drawn[arg] for arg in step.args], **step.params)
        return self.add_slips(step, domain.mask_refused(exact), errors(step.index))

    @cached_property
    def _holes(self) -> dict[int, int]:
        """For each point of the pose the first one that lies where it does."""
        first: dict[Any, int] = {}
        return {step.index: first.setdefault(self.values[step.index], step.index)
                for step in self.program.steps[:self.program.givens]}

    def add_slips(self, step: Step, exact: Any, errors: Sequence[Any]) -> Any:
        """Result of a step, displaced by its errors."""
        steady = self.values[step.index]
        match step.op.gives, step.op.movement:
            case _, Movement.BEGUN:
                return exact
            case _, _ if step.op.sizing in COMPUTED:
                start, end = COMPUTED[step.op.sizing]
                cos, sin = _direction(self.values[step.args[start]], self.values[step.args[end]])
                return exact[0] + errors[0] + cos * errors[2], exact[1] + errors[1] + sin * errors[2]
            case _, Movement.PICKED:
                a, b = _unit(self.values[step.args[0]])
                return exact[0] + a * errors[0], exact[1] + b * errors[0]
            case kinds.LINE, _:
                return self._shift_and_turn(step, exact, *errors)
            case kinds.OPENING, _:
                return (exact[0] + 2 * math.sqrt(steady[0]) * errors[0] + errors[0] * errors[0],)
        return exact[0] + errors[0], exact[1] + errors[1], *exact[2:]

    def _shift_and_turn(self, step: Step, exact: Any, offset: Any, other: Any) -> Any:
        """A line moved across by an offset at its first point, and turned by its second error.

        With (a, b) turned to (a - t b, b + t a) about (x, y), c grows by t (b x - a y).
        """
        a, b, c = exact
        (x, y), *second_place = places(self.program, self.values, step)
        line = self.values[step.index]
        turn = (other - offset) / _advance(line, (x, y), second_place[0]) if second_place else other
        return a - turn * b, b + turn * a, c + turn * (b * x - a * y) - _normal_length(exact) * offset


def hand(drawing: Construction, unit: Callable[[Panel], float], pencil: Pencil) -> Hand:
    """The hand that draws a construction with this pencil; `unit` is the length of a millimetre on a plan."""
    plan_of_step = drawing.plan_of_step
    return program_hand(drawing.drawn, drawing.values, lambda step: unit(plan_of_step[step.index]), pencil)


def program_hand(program: Program, values: Sequence[Any], unit: Callable[[Step], float], pencil: Pencil) -> Hand:
    """The hand that draws a program; `unit` is the length of a millimetre where a step is drawn."""
    units = [unit(step) for step in program.steps]
    return Hand(program, values, [_slips(program, values, step, units, pencil) for step in program.steps])


def _slips(program: Program, values: Sequence[Any], step: Step, units: Sequence[float], pencil: Pencil) -> Slips:
    """The standard deviations of one step; `units` are the lengths of a millimetre on the plans of all."""
    unit = units[step.index]
    point, edge = unit * pencil.point, unit * pencil.edge
    match step.op.gives, step.op.movement:
        case _, Movement.BEGUN:
            return ()
        case _, _ if step.op.sizing is Sizing.QUOTIENT:
            K, A, m, w, _ = step.args
            times = math.dist(values[m], values[w]) / math.dist(values[K], values[A])
            return point, point, pencil.opening * math.hypot(2 * times * units[w], times**2 * units[A])
        case _, _ if step.op.sizing is Sizing.PROPORTION:
            A, B, C, P, Q = step.args
            times, other = (math.dist(values[one], values[two]) / math.dist(values[A], values[B])
                            for one, two in ((A, C), (P, Q)))
            return point, point, pencil.opening * math.hypot(
                times * units[Q], other * units[A], times * other * units[A])
        case _, Movement.PICKED:
            return (point,)
        case kinds.LINE, _:
            laid_at_two = len(places(program, values, step)) > 1
            return edge, edge if laid_at_two else pencil.slope
        case kinds.OPENING, _:
            return (unit * pencil.opening,)
    return point, point


def places(program: Program, values: Sequence[Any], step: Step) -> list[Any]:
    """Points at which a line is laid: those that it is drawn through; without such points, beside the middle of its
    operands."""
    points = {arg for arg in step.args if program.steps[arg].op.gives == kinds.POINT}
    on = [step.args[place] for place in step.op.claim_operands("on")]
    through = [values[arg] for arg in on if arg in points]
    return through[:2] or [_abreast(values[step.index], [values[arg] for arg in sorted(points)])]


def _abreast(line: Any, points: Sequence[Any]) -> Any:
    """The foot on a line of the middle of some points."""
    x, y = (sum(point[i] for point in points) / len(points) for i in (0, 1))
    a, b, c = line
    off = (a * x + b * y + c) / (a * a + b * b)
    return x - a * off, y - b * off


def _direction(P: Any, Q: Any) -> tuple[float, float]:
    """The way from one point to another, as a vector of length 1."""
    apart = math.dist(P, Q) or 1.0
    return (Q[0] - P[0]) / apart, (Q[1] - P[1]) / apart


def _unit(line: Any) -> tuple[float, float]:
    """The unit normal of a line."""
    length = math.hypot(line[0], line[1])
    return line[0] / length, line[1] / length


def _normal_length(line: Any) -> Any:
    """The length of a line's normal, without errors of first order."""
    a, b = (getattr(coefficient, "value", coefficient) for coefficient in line[:2])
    return (a * a + b * b) ** 0.5


def _advance(line: Any, P: Any, Q: Any) -> float:
    """Distance of Q beyond P along a line."""
    a, b = _unit(line)
    return float(b * (Q[0] - P[0]) - a * (Q[1] - P[1]))


def draw_with_slips(hand: Hand) -> tuple[Gradients, list[Any]]:
    """Draw with the hand's errors, with the derivatives by each of them."""
    starts = [0, *accumulate(map(len, hand.slips))]
    domain = Gradients(starts[-1])

    def errors(step: int) -> list[Any]:
        return [domain.error(starts[step] + i, deviation) for i, deviation in enumerate(hand.slips[step])]

    def unsteady_mark(step: int) -> list[Any]:
        return [domain.unsteady(coordinate, range(starts[step], starts[step + 1])) for coordinate in hand.values[step]]

    def is_lost(step: Step, mark: Any) -> bool:
        """Whether a point's error is so much larger than its own slip that first order is meaningless for it."""
        slip = hand.slips[step.index][:1] if step.op.gives == POINT else ()
        off = (partials @ partials for partials in map(domain.partials, mark[:2]))
        return any(slip) and (MAX_GROWTH * slip[0]) ** 2 < sum(off) < math.inf

    return domain, hand.draw(domain, errors, unsteady_mark, is_lost)


def variances(domain: Gradients, value: Any) -> Any:
    """The variance of a number or a vector by each slip: infinite where it has no bound, or no derivative."""
    squares = np.sum([domain.partials(component) ** 2 for component in components(value)], axis=0)
    return np.where(np.isfinite(squares), squares, np.inf)


MAX_DEVIATION_MM = 1000.0  # mm: no hand is so far off on any sheet
UNITS = {"point": "mm", "edge": "mm", "angle": "degrees", "opening": "mm"}


def pencil(text: str) -> Pencil:
    """The pencil that a text such as `point=0.2,angle=0.1` speaks of; what it leaves out stays as it is by default."""
    names = [field.name for field in fields(Pencil)]
    return Pencil(**read_settings("--pencil", text, names, "a pencil has no such error", read_deviation))


def read_deviation(name: str, text: str) -> float:
    """A standard deviation: a number of millimetres or degrees, below those of a sheet or of a right angle's half."""
    deviation, limit = decimal(text), 45.0 if name == "angle" else MAX_DEVIATION_MM
    if not 0 <= deviation < limit:
        right = f"a standard deviation in {UNITS[name]}, from 0 to below {limit:g}"
        raise Refused(f"--pencil {name}={text}", "not a size of an error", right)
    return deviation


def read_settings(option: str, text: str, known: Collection[str], unknown: str,
                  size: Callable[[str, str], float]) -> dict[str, float]:
    """Read the `known` settings of a text; `size` reads each from its name and its value.

    Fails with `Refused`, in the words `unknown`, where it names another one, and where it names one twice.
    """
    settings: dict[str, float] = {}
    for entry in filter(None, text.split(",")):
        name, _, value = (word.strip() for word in entry.partition("="))
        if name not in known:
            raise Refused(f"{option} {entry}", unknown, f"one of {', '.join(known)}")
        if name in settings:
            raise Refused(f"{option} {text}", f"{name} is given twice", "give it once")
        settings[name] = size(name, value)
    return settings


def decimal(text: str) -> float:
    """A number, or nan if it is not a number."""
    try:
        return float(text)
    except ValueError:
        return math.nan
