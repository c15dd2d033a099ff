"""A reader who executes a protocol on paper: ruler, set squares and compasses in mm, and nothing of graphplan.

It takes the list of steps as `graphplan steps SCENE --json` prints it. What is given or begun lies where its `paper`
says; every other mark is drawn from its operation, the marks drawn before, and what the step tells: `parameters`, and
the `factor` by which lengths of another plan are drawn. Inside, points are complex numbers with y up; a line is a point
and the way it runs; a circle a centre and a radius; an opening a length.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

OFF = 0.01  # mm: how far off a mark may be
TURNED = 1e-4  # of one mm: how far off the way of a line may be over the length of one mm
SHORTEST = 1e-3  # mm: of a shorter vector no way is seen
UNSEEN = 1e-9  # mm, or of two vectors mm²: of what is so small no sense is seen
Step = Mapping[str, Any]


class Line(NamedTuple):
    """A line through a point, running a way of length 1."""

    through: complex
    way: complex


class Circle(NamedTuple):
    """A circle of a radius about a centre."""

    centre: complex
    radius: float


Mark = complex | Line | Circle | float


def cross(u: complex, v: complex) -> float:
    """How much the second vector lies to the left of the first."""
    return (u.conjugate() * v).imag


def dot(u: complex, v: complex) -> float:
    """How much two vectors go together."""
    return (u.conjugate() * v).real


def unit(u: complex) -> complex:
    """The way of a vector; of none nothing."""
    return u / abs(u) if u else 0j


def laid(paper: Sequence[float], kind: str) -> Mark:
    """A mark as it lies on paper, where y runs down."""
    if kind == "line":
        a, b, c = paper
        return Line(complex(-a * c, b * c), complex(b, a))
    if kind == "circle":
        return Circle(complex(paper[0], -paper[1]), paper[2])
    return paper[0] if kind == "opening" else complex(paper[0], -paper[1])


def distance(drawn: Mark, told: Mark) -> float:
    """How far a drawn mark is off where it is told, in mm."""
    if isinstance(drawn, Line) and isinstance(told, Line):
        off = abs(cross(told.way, drawn.through - told.through))
        return off + abs(drawn.way - told.way) * OFF / TURNED
    if isinstance(drawn, Circle) and isinstance(told, Circle):
        return max(abs(drawn.centre - told.centre), abs(drawn.radius - told.radius))
    return abs(drawn - told) if isinstance(drawn, complex | float) and isinstance(told, complex | float) else math.inf


# ---- the operations, each from the marks that it reads, its parameters and the factor

Operation = Callable[[Sequence[Any], Mapping[str, Any], float], Mark]


def foot(line: Line, P: complex) -> complex:
    """The foot of the perpendicular from a point."""
    return line.through + dot(line.way, P - line.through) * line.way


def meet(k: Line, m: Line) -> complex:
    """Where two lines cross."""
    return k.through + cross(m.through - k.through, m.way) / cross(k.way, m.way) * k.way


def cut(line: Line, circle: Circle, on: bool) -> complex:
    """Where a line crosses a circle, further on or further back."""
    middle = foot(line, circle.centre)
    half = math.sqrt(max(circle.radius**2 - abs(middle - circle.centre) ** 2, 0.0))
    return middle + (half if on else -half) * line.way


def arcs(one: Circle, two: Circle, left: bool) -> complex:
    """Where two circles cross, to the left of the way from the first centre to the second or to the right."""
    apart = abs(two.centre - one.centre)
    along = (apart + (one.radius - two.radius) * (one.radius + two.radius) / apart) / 2
    up = math.sqrt(max((one.radius - along) * (one.radius + along), 0.0))
    return one.centre + complex(along, up if left else -up) * unit(two.centre - one.centre)


def balancing(P: Sequence[complex], factor: float) -> complex:
    """A force at X perpendicular to YX that balances another about Y: force times arm over YX."""
    Y, X, C, tail, head, start = P
    arm = X - Y
    return start - 1j * unit(arm) * cross(C - Y, head - tail) / abs(arm) * factor


def touching(P: Sequence[complex], radius: float) -> complex:
    """Where a force touches the friction circle about P so that it turns against the motion of R.

    R's velocity is drawn turned a quarter: it runs with PR where the link turns clockwise.
    """
    centre, R, end, tail, head = P
    return centre - 1j * unit(head - tail) * radius * sense(dot(R - centre, end - R))


def leaning(line: Line, P: Sequence[complex], coefficient: float) -> Line:
    """A guide turned by the friction angle, so that a force perpendicular to it is against the sliding.

    The velocity of sliding is drawn turned a quarter counter-clockwise.
    """
    through, end, tail, head = P
    sliding, force = -1j * (end - through), 1j * line.way * sense(dot(1j * line.way, head - tail))
    against = dot(1j * force, sliding) < 0
    turn = coefficient if against else -coefficient
    rests = sense(abs(sliding)) == 0 or force == 0
    return Line(through, line.way if rests else unit(line.way * complex(1, turn)))


def sense(number: float) -> float:
    """The sign of what is long enough to be seen."""
    return 0.0 if abs(number) < UNSEEN else math.copysign(1.0, number)


def pressing(P: Sequence[complex], coefficient: float) -> Line:
    """The line of a tooth force: perpendicular to the way to the wheel's centre, and leaning from its force towards
    it."""
    pitch, centre, tail, head = P
    arm = centre - pitch
    return Line(pitch, unit(-1j * arm * complex(1, -coefficient * sense(cross(arm, head - tail)))))


def curve_point(plans: Sequence[complex], u: float) -> complex:
    """A place of the smooth curve through four points, which it passes at -1, 0, 1 and 2."""
    P, Q, R, S = plans
    return (-u * (u - 1) * (u - 2) * P + u * (u * u - 1) * S) / 6 + ((u * u - 1) * (u - 2) * Q - u * (u + 1) * (
        u - 2) * R) / 2


def curve_cuts(plans: Sequence[complex], circle: Circle) -> complex:
    """Where the curve through four points crosses a circle, between the second and the third."""
    def outside(u: float) -> float:
        return abs(curve_point(plans, u) - circle.centre) - circle.radius

    inner, outer = 0.0, 1.0
    for _ in range(60):
        middle = (inner + outer) / 2
        inner, outer = (middle, outer) if outside(middle) * outside(0.0) > 0 else (inner, middle)
    return curve_point(plans, inner)


def curves_cross(plans: Sequence[complex], others: Sequence[complex]) -> complex:
    """Where the curves through four points each cross, both between the second and the third."""
    u = w = 0.5
    for _ in range(30):
        gap = curve_point(others, w) - curve_point(plans, u)
        along, across = (curve_point(run, at + 1e-6) - curve_point(run, at - 1e-6) for run, at in ((plans, u),
                                                                                                    (others, w)))
        u += cross(gap, across) / cross(along, across) * 2e-6
        w += cross(gap, along) / cross(along, across) * 2e-6
    return curve_point(plans, u)


def resultant(P: Sequence[complex], factor: float) -> complex:
    """A point of the line of a force shifted by the couple of another."""
    C, p, q, Y, R, a, b = P
    force = q - p
    return C - 1j * unit(force) * cross(R - Y, b - a) / abs(force) * factor


OPERATIONS: dict[str, Operation] = {
    "guide": lambda m, p, f: Line(m[0], complex(p["direction"][0], -p["direction"][1])),
    "line": lambda m, p, f: Line(m[0], unit(m[1] - m[0])),
    "parallel": lambda m, p, f: Line(m[1], m[0].way),
    "perpendicular": lambda m, p, f: Line(m[1], 1j * m[0].way),
    "bisector": lambda m, p, f: Line((m[0] + m[1]) / 2, 1j * unit(m[1] - m[0])),
    "meet": lambda m, p, f: meet(*m),
    "foot": lambda m, p, f: foot(*m),
    "midpoint": lambda m, p, f: (m[0] + m[1]) / 2,
    "opening": lambda m, p, f: abs(m[1] - m[0]),
    "inclined": lambda m, p, f: Line(m[0], cmath.rect(1, math.radians(p["angle"]))),
    "radius": lambda m, p, f: p["length"],
    "link_length": lambda m, p, f: p["length"],
    "circle": lambda m, p, f: Circle(m[0], m[1] * f),
    "line_meets_circle": lambda m, p, f: cut(m[0], m[1], p["way"] == "on"),
    "circles_meet": lambda m, p, f: arcs(m[0], m[1], p["side"] == "left"),
    "curve_meets_circle": lambda m, p, f: curve_cuts(m[:4], m[4]),
    "curves_meet": lambda m, p, f: curves_cross(m[:4], m[4:]),
    "transfer": lambda m, p, f: m[2] + f * (m[1] - m[0]),
    "quarter": lambda m, p, f: m[2] + 1j * f * (m[1] - m[0]),
    "step_off": lambda m, p, f: m[2] + p["ratio"] * f * (m[1] - m[0]),
    "step_across": lambda m, p, f: m[2] + 1j * p["ratio"] * f * (m[1] - m[0]),
    "lay_along": lambda m, p, f: m[1] + p["length"] * m[0].way,
    "lay_off": lambda m, p, f: m[0] + complex(p["vector"][0], -p["vector"][1]),
    "pick": lambda m, p, f: foot(m[0], m[1]) + p["ahead"] * m[0].way,
    "set_off": lambda m, p, f: m[1] + complex(p["along"], p["across"]) * m[0].way,
    "triangle": lambda m, p, f: m[3] + (m[2] - m[0]) / (m[1] - m[0]) * (m[4] - m[3]),
    "divide": lambda m, p, f: m[3] + dot(m[1] - m[0], m[2] - m[0]) / abs(m[1] - m[0]) ** 2 * (m[4] - m[3]),
    "shift": lambda m, p, f: Line(m[0].through + f * (m[2] - m[1]), m[0].way),
    "balance": lambda m, p, f: balancing(m, f),
    "computed_normal": lambda m, p, f: m[4] + unit(m[1] - m[0]) * abs(m[3] - m[2]) ** 2 / abs(m[1] - m[0]) * f,
    "couple": lambda m, p, f: m[2] + 1j * unit(m[1] - m[0]) * p["moment"] / abs(m[1] - m[0]),
    "inertia_pair": lambda m, p, f: m[4] - 1j * unit(m[1] - m[0]) * p["ratio"] * cross(
        unit(m[1] - m[0]), m[3] - m[2]) / abs(m[1] - m[0]) ** 2,
    "touch": lambda m, p, f: touching(m, p["radius"]),
    "lean": lambda m, p, f: leaning(m[0], m[1:], p["coefficient"]),
    "pressure_line": lambda m, p, f: pressing(m, p["coefficient"]),
    "pull_line": lambda m, p, f: pressing(m, p["coefficient"]),
    "resultant": lambda m, p, f: resultant(m, f),
}
STANDING = "given", "begin", "pole"  # what lies where it is put
BY_EYE = "curve_meets_circle", "curves_meet"  # where curves through points lead, as near as a pen draws them
BY_TRIAL = "close_on_two", "close_on_three", "close_on_four"  # what is moved until the lengths fit

# Operands of which only a vector, an opening or a direction is taken: each group lies on one plan, whichever it is.
# What stands in no group lies on the plan of the mark that is made.
TAKEN: dict[str, tuple[tuple[int, ...], ...]] = {
    "transfer": ((0, 1),), "quarter": ((0, 1),), "step_off": ((0, 1),), "step_across": ((0, 1),),
    "parallel": ((0,),), "perpendicular": ((0,),), "lay_along": ((0,),), "circle": ((1,),),
    "set_off": ((0,),), "triangle": ((0, 1, 2),),
    "divide": ((0, 1, 2),), "balance": ((0, 1, 2), (3, 4)), "couple": ((0, 1),), "inertia_pair": ((0, 1), (2, 3)),
    "touch": ((0, 1, 2), (3, 4)), "lean": ((3, 4),), "pressure_line": ((2, 3),), "pull_line": ((2, 3),),
    "resultant": ((1, 2), (3, 4), (5, 6)), "computed_normal": ((0, 1), (2, 3)),
}  # fmt: skip


@dataclass
class Reader:
    """One protocol as it is executed: the marks drawn so far, and what is wrong with it."""

    steps: Sequence[Step]
    marks: list[Mark] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, steps: Sequence[Step]) -> Reader:
        """A protocol, executed."""
        reader = cls(steps)
        for step in steps:
            reader.execute(step)
        return reader

    def execute(self, step: Step) -> None:
        """Draw the mark of a step, and compare it with where it is told."""
        told = laid(step["paper"], step["kind"])
        if step["operation"] in STANDING + BY_TRIAL:
            self.marks.append(told)
            return
        self.faults += [f"{_named(step)}: {fault}" for fault in self._astray(step)]
        if step["operation"] not in OPERATIONS:
            self.faults.append(f"{_named(step)}: no reader knows this operation")
            self.marks.append(told)
            return
        read = [self.marks[place] for place in step["operands"]]
        try:
            mark = OPERATIONS[step["operation"]](read, step["parameters"], step["factor"] or 1.0)
        except (ArithmeticError, ValueError) as fault:
            self.faults.append(f"{_named(step)}: cannot be drawn: {fault}")
            mark = told
        off = distance(mark, told)
        if not off <= OFF:
            self.faults.append(f"{_named(step)}: drawn {off:.3g} mm off where it is told: {step['sentence']}")
        by_itself = step["operation"] in BY_EYE or not off <= OFF  # what follows is then judged from where it is told
        self.marks.append(told if by_itself else mark)

    def _astray(self, step: Step) -> Iterator[str]:
        """What a step reads from another plan, and may not."""
        home, groups = step["plan"], TAKEN.get(step["operation"], ())
        plans = [self.steps[place]["plan"] for place in step["operands"]]
        grouped = {place for group in groups for place in group}
        yield from (f"{step['reads'][place]} lies on the {plan}, not on the {home}" for place, plan in enumerate(plans)
                    if place not in grouped and plan != home)
        yield from (f"a vector between the {' and the '.join(sorted({plans[place] for place in group}))}"
                    for group in groups if len({plans[place] for place in group}) > 1)

    def measure(self, marks: Sequence[int]) -> float:
        """What a ruler measures between marks: a distance, a radius, an arm, or the part of a vector perpendicular to a
        way; no number where the way is too short to be seen."""
        read = [self.marks[mark] for mark in marks]
        if len(read) == 2 and marks[0] == marks[1]:
            return read[0].radius if isinstance(read[0], Circle) else read[0] if isinstance(read[0], float) else 0.0
        spots: list[Any] = [mark.centre if isinstance(mark, Circle) else mark for mark in read]
        if len(spots) == 2:
            return abs(spots[1] - spots[0])
        force = spots[2:4] if len(spots) == 4 else spots[1:3] if len(spots) == 5 else spots[:2]
        if abs(force[1] - force[0]) < SHORTEST:
            return math.nan
        if len(spots) == 4:
            return abs(cross(unit(spots[3] - spots[2]), spots[1] - spots[0]))
        if len(spots) == 5:
            return abs(cross(unit(spots[2] - spots[1]), spots[4] - spots[3]))
        P, R, p, p1, r, r1 = spots
        return abs(cross(unit(R - P), (r1 - r) - (p1 - p)))


def _named(step: Step) -> str:
    return f"step {step['number']} ({step['makes']} = {step['operation']})"


def finite(mark: Mark) -> bool:
    """Whether a mark lies anywhere."""
    parts = mark if isinstance(mark, tuple) else (mark,)
    return all(map(cmath.isfinite, parts))
