"""Lengths on paper: what is measured and in which scale, and the sums that follow from it.

A ruler reads tenths of a millimetre. What is read off is told in tenths, and comes to what these tenths come to. A
length that is worked out is right to a tenth: where tenths do not give it, hundredths or thousandths are told. Given
quantities and scales are told in full. Each number of a sum is of a kind, by a letter:

    m  mm that are multiplied        M  mm that are squared        d  mm by which it is divided
    f  a figure that multiplies      F  one that is squared        g  one that divides      a  one that is added

Before them a sign says what the product of mm is taken from or added to 1, or Σ that mm are multiplied two and two and
added; the kind of the result is the last letter: m of a length that is worked out, f of what is read off.

A given quantity is divided by the scale of its plan; a vector of another plan is carried over by the scales of both; a
moment is a force in mm times its arm in mm over the other arm. Spoken are tenths of a millimetre, and more digits where
what is worked out would else not hold as printed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from graphplan.kernel.kinds import LAID, OPENING, Movement, Quantity, Sizing
from graphplan.kernel.passes import Compound
from graphplan.kernel.program import Panel, Program, Step
from graphplan.phrases import Said, Unknown, arrange, decimals, digits, join, said, tenths, unit
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.tolerances import FIGURE_TOL, LENGTH_TOL, MIN_LENGTH

# By level: decimals of mm, decimals of a result in mm, figures of another result, figures of what is not a length.
LEVELS = ((1, 1, 4, 4), (2, 1, 4, 5), (3, 1, 4, 6), (2, 1, 4, 6), (1, 1, 4, 5))
PRINTED_LEVEL, READ_LEVEL = 3, 4  # from which on a result is what the printed numbers come to; of what is read
MAX_PRINT_ERROR = 0.499  # of the last printed digit: how far off what the printed numbers come to may be
MOST_FIGURES = 6  # all of a figure is printed where so many do
LENGTH_KINDS, FORMS = "mMd", "+-Σ"


@dataclass(frozen=True)
class Sum:
    """The numbers of a sum, the result last, with their kinds."""

    kinds: str
    numbers: tuple[float, ...]

    @cached_property
    def level(self) -> int | Unknown:
        """The first level at which it holds as printed; else the level that prints what its numbers give."""
        unknown = next((number for number in self.numbers if isinstance(number, Unknown)), None)
        if unknown is None:
            return holding(self.kinds, self.numbers)
        level: Unknown = unknown.level(self.kinds, self.numbers)
        return level

    def __getitem__(self, place: int) -> Said:
        """A number as it is printed; -1 is the result."""
        last = place % len(self.numbers) == len(self.numbers) - 1
        return self._number_text(place, self.result if last else self.numbers[place])

    def unsigned_text(self, place: int) -> Said:
        """A number as it is printed, without its sign."""
        return self._number_text(place, abs(self.numbers[place]))

    def _number_text(self, place: int, number: float) -> Said:
        kind, result = self.kinds.lstrip(FORMS)[place], place % len(self.numbers) == len(self.numbers) - 1
        if isinstance(self.level, Unknown):
            return self.level.printed_number(number, ("r" if kind in LENGTH_KINDS else "v") if result else kind)
        _, of_result, _, figures = LEVELS[self.level]
        if kind in LENGTH_KINDS:
            return decimals(number, of_result if result else decimals_of(number, kind, self.level))
        return digits(number, result_figures(number, self.level) if result else figures_of(number, figures))

    @property
    def result(self) -> float:
        """The result that is printed, before it is rounded."""
        if isinstance(self.level, Unknown):
            result: float = self.level.result(self.kinds, self.numbers)
            return result
        return result_at(self.level, self.kinds, self.numbers)

    @property
    def value(self) -> float:
        """The result as printed; an unknown where it is not known yet."""
        number = self.result
        return number if isinstance(self.level, Unknown) else round_as_printed(number, self.kinds[-1], self.level,
                                                                               result=True)


def result_at(level: int, kinds: str, numbers: Sequence[float]) -> float:
    """The result at a level: exact, or evaluated from the printed numbers."""
    if level < PRINTED_LEVEL:
        return numbers[-1]
    form, number_kinds = (kinds[0], kinds[1:]) if kinds[0] in FORMS else ("", kinds)
    value = _value(form, number_kinds,
                   [round_as_printed(number, kind, level)
                    for number, kind in zip(numbers[:-1], number_kinds, strict=False)])
    return value if math.isfinite(value) else numbers[-1]


def holding(kinds: str, numbers: Sequence[float]) -> int:
    """The first level of digits at which a sum holds as printed; else the level that prints what its numbers give."""
    if kinds[-1] not in LENGTH_KINDS:
        return READ_LEVEL
    form, kinds = (kinds[0], kinds[1:]) if kinds[0] in FORMS else ("", kinds)
    for level in range(PRINTED_LEVEL):
        printed = [round_as_printed(number, kind, level) for number, kind in zip(numbers[:-1], kinds[:-1], strict=True)]
        result = round_as_printed(numbers[-1], kinds[-1], level, result=True)
        value = _value(form, kinds, printed)
        if abs(value - result) <= MAX_PRINT_ERROR * 10.0 ** -LEVELS[level][1]:
            return level
    return PRINTED_LEVEL


def _value(form: str, kinds: str, numbers: Sequence[float]) -> float:
    """Evaluate a sum with its printed numbers."""
    lengths = [(number, kind) for number, kind in zip(numbers, kinds, strict=False) if kind in LENGTH_KINDS]
    value = 1.0
    if form == "Σ":
        value = sum(lengths[k][0] * lengths[k + 1][0] for k in range(0, len(lengths), 2))
    else:
        for number, kind in lengths:
            value = _apply(value, number, {"m": "f", "M": "F", "d": "g"}[kind])
    value = {"-": 1.0 - value, "+": 1.0 + value}.get(form, value)
    for number, kind in zip(numbers, kinds, strict=False):
        value = value if kind in LENGTH_KINDS else _apply(value, number, kind)
    return value


def _apply(value: float, number: float, kind: str) -> float:
    """A value multiplied or divided by a number, or with it added."""
    if kind == "g":
        return value / number if number else math.nan
    return value + number if kind == "a" else value * number if kind == "f" else value * number * number


def round_as_printed(number: float, kind: str, level: int, *, result: bool = False) -> float:
    """A number as it is printed at a level."""
    _, of_result, _, figures = LEVELS[level]
    if kind in LENGTH_KINDS:
        return float(f"{number:.{of_result if result else decimals_of(number, kind, level)}f}")
    return float(f"{number:.{result_figures(number, level) if result else figures_of(number, figures)}g}")


def decimals_of(number: float, kind: str, level: int) -> int:
    """Decimals of a number of mm: more where a factor or divisor would be printed as zero."""
    count = LEVELS[level][0]
    keeps_figures = level == PRINTED_LEVEL or (kind == "d" and level == READ_LEVEL)
    return 1 - _power(number) if keeps_figures and 0 < abs(number) < 0.5 * 10.0**-count else count


def result_figures(number: float, level: int) -> int:
    """Significant figures of a result: never fewer than its whole digits, up to seven."""
    power = _power(number)
    return LEVELS[level][2] if power <= 2 else max(4, min(power + 1, 7))


def _power(number: float) -> int:
    """The power of ten of the first figure."""
    return int(f"{number:e}".partition("e")[2])


def figures_of(number: float, figures: int) -> int:
    """Significant figures of a number: `figures`, or more where it is exact in so many."""
    for count in range(figures, MOST_FIGURES + 1):
        if abs(float(f"{number:.{count}g}") - number) <= FIGURE_TOL * abs(number):
            return count
    return figures


MAX_ENLARGEMENT = 10.0  # so many times as large a length may be drawn as it is taken
LENGTH = Quantity("", "length")
COMPONENTS = Movement.LAID_BY_COMPONENTS, Movement.LAID_ALONG


class PaperDistance(NamedTuple):
    """So many mm between two marks, by step, of one more than once if it has a radius; or the arm about the first of
    four marks of a force at the second, as from the third to the fourth."""

    mm: float
    marks: tuple[int, ...]

    @property
    def text(self) -> Said:
        return in_mm(tenths(self.mm))


def carry_overs(step: Step) -> list[tuple[int, int]]:
    """Return marks between whose plans a step carries lengths over, source and target: scales make it a factor."""
    args, out = step.args, step.index
    match step.op.sizing:
        case Sizing.QUOTIENT:
            return [(args[2], args[0]), (args[0], out)]
        case Sizing.MOMENTS:
            return [(args[3], out)]
        case Sizing.SHIFT:
            return [(args[5], args[1])]
    carrying = step.op.movement in (Movement.LAID_OFF, Movement.TURNED, Movement.STRUCK)
    return [(args[step.op.afar[0][0]], out)] if carrying else []


def in_mm(written: Said) -> Said:
    """A number as a length on paper."""
    return join((written, unit("mm")), " ")


class Length(NamedTuple):
    """A length in words, and the distances that they mention; the last one is laid off."""

    text: Said
    measures: tuple[PaperDistance, ...]

    @property
    def mm(self) -> float:
        return self.measures[-1].mm


def magnitude(x: Any, y: Any) -> float:
    """The length of a vector; its components may be unknown numbers."""
    if isinstance(x, Unknown) or isinstance(y, Unknown):
        length: float = x.hypot(y) if isinstance(x, Unknown) else y.hypot(x)
        return length
    return math.hypot(x, y)


@dataclass(frozen=True)
class Lengths:
    """The lengths of a program's steps: its values, and by step the plan that it is drawn on, at these scales."""

    program: Program
    values: Sequence[Any]
    plan: Callable[[int], Panel]
    scales: Scales

    def for_step(self, step: Step) -> tuple[Length, ...]:
        """Return the lengths that a step lays off or opens, of marks of the program: empty if it has no size of its own
        or is too short to be measured, unless its size is given; of a force without a moment its arm."""
        lengths = tuple(length for length in self._step_lengths(step)
                        if step.op.has_size or length.mm >= MIN_LENGTH)
        return lengths if lengths or step.op.sizing is not Sizing.MOMENTS else (self._no_moment(step),)

    def for_earlier_part(self, compound: Compound) -> tuple[Length, ...]:
        """Lengths that a compound's part on another plan determines, to be laid off later."""
        match compound.step.op.sizing, compound.step.args, dict(compound.inner):
            case Sizing.SQUARE, (K, A, m, w, _), {"E": E}:
                speed, arm, laid = self.distance(m, w), self.distance(K, A), self.distance(E, A)
                total, v = self._product("Mdm", w, A, speed.mm, arm.mm, laid.mm)
                v = arrange("({0})", v) if len(total.numbers) > 3 else v
                text = arrange("v²/{0} = {1}² : {2} = {3}", self.side(K, A), v, total[-2], in_mm(total[-1]))
                return (Length(text, (speed, arm, laid)),)
            case Sizing.DOUBLE, (_, B, *_), {"K": K}:
                half = self.distance(K, B)
                return (Length(half.text, (half,)),)
        return ()

    # ---- mm -----------------------------------------------------------------------------------------------------

    def per_mm(self, index: int) -> float:
        """Scene lengths per mm on the plan of a step."""
        return self.scales.lengths_per_mm(self.plan(index))

    def times(self, source: int, own: int) -> float | None:
        """The ratio of the scales of two marks' plans, source to own; None where they are equal."""
        times = self._enlargement(source, own)
        return None if abs(times - 1) <= LENGTH_TOL else times

    def _enlargement(self, source: int, own: int) -> float:
        """Factor of a length of one mark's plan on another's: 1 on the same plan."""
        return 1.0 if self.plan(source) == self.plan(own) else self.per_mm(source) / self.per_mm(own)

    def mm(self, P: int, Q: int) -> float:
        """Distance of two marks of one plan, in mm."""
        return magnitude(*self.vector(P, Q)) / self.per_mm(Q)

    def distance(self, P: int, Q: int) -> PaperDistance:
        return PaperDistance(self.mm(P, Q), (P, Q))

    def arm(self, Y: int, C: int, p: int, q: int) -> PaperDistance:
        """The arm about Y of a force at C, as from p to q, which may be marks of another plan."""
        return PaperDistance(abs(self.lever(Y, C, p, q)), (Y, C, p, q))

    def lever(self, Y: int, C: int, p: int, q: int) -> float:
        """The arm in mm, with the sign of the moment."""
        force, (u, v) = self.vector(p, q), self.vector(Y, C)
        return (u * force[1] - v * force[0]) / (magnitude(*force) or 1.0) / self.per_mm(C)

    def vector(self, P: int, Q: int) -> tuple[float, float]:
        (x, y), (u, v) = self.values[P][:2], self.values[Q][:2]
        return u - x, v - y

    # ---- what a movement lays off or opens ------------------------------------------------------------------------

    def _step_lengths(self, step: Step) -> Iterator[Length]:
        op, args, out = step.op, step.args, step.index
        if op.sizing:
            yield LENGTH_RULES[op.sizing](self, step)
        elif op.movement is Movement.OPENED:
            yield Length((wide := self.distance(*args)).text, (wide,))
        elif op.gives == OPENING:
            wide = PaperDistance(self.values[out][0] ** 0.5 / self.per_mm(out), (out, out))
            yield Length(self._given_quantity(step.quantity or LENGTH, wide, out), (wide,))
        elif op.movement is Movement.STRUCK:
            wide = PaperDistance(self.values[out][2] ** 0.5 / self.per_mm(out), (out, out))
            taken = PaperDistance(self.values[args[1]][0] ** 0.5 / self.per_mm(args[1]), (args[1], args[1]))
            yield from () if self.times(args[1], out) is None else (self._carry_over(taken, wide),)
        elif op.movement is Movement.PICKED:
            away = self.distance(args[1], out)
            yield Length(said("Here {0} from {1}", away.text, self.program.text(args[1])), (away,))
        elif op.root is not None and op.movement in LAID and op.movement is not Movement.DROPPED:
            laid = self.distance(args[op.root], out)
            if op.has_size or laid.mm >= MIN_LENGTH:  # asked first of an unknown length
                yield self._laid_vector(step, laid)

    def _laid_vector(self, step: Step, laid: PaperDistance) -> Length:
        """The length of a vector: given with its components, or carried over from this plan or another."""
        if step.op.movement in COMPONENTS:
            text = self._given_quantity(step.quantity or LENGTH, laid, step.index)
            components = (tenths(component / self.per_mm(step.index)) for component in self.vector(*laid.marks))
            return Length(said("{0} (x {1}, y {2})", text, *components), (laid,))
        ratio = step.params.get("ratio", 1)
        if step.quantity:
            length = Length(self._given_quantity(step.quantity, laid, step.index), (laid,))
        else:
            length = self._carry_over(self.distance(*step.args[:2]), laid, abs(float(ratio)))
        against = ratio < 0
        return length._replace(text=said("{0}, reversed", length.text)) if against else length

    def _carry_over(self, source: PaperDistance, laid: PaperDistance, ratio: float = 1.0) -> Length:
        """A length that is carried over, or so many times as long, with the factor between the two plans where their
        scales differ."""
        enlargement = ratio * self._enlargement(source.marks[-1], laid.marks[-1])
        if abs(enlargement - 1) <= LENGTH_TOL or source.mm < MIN_LENGTH:
            return Length(laid.text, (laid,))
        factors = _factors(enlargement)
        product = Sum(f"m{'f' * len(factors)}m", (source.mm, *factors, laid.mm))
        times = join((product[k + 1] for k in range(len(factors))), " · ")
        text = arrange("{0} · {1} = {2}", in_mm(product[0]), times, in_mm(product[-1]))
        return Length(text, (source, laid))

    def _given_quantity(self, quantity: Quantity, laid: PaperDistance, where: int) -> Said:
        """A quantity with its value, over the scale of its plan."""
        per, symbol = self.scale(quantity.kind, where)
        drawn_per_real = self.scales.convention == "drawn"
        quotient = Sum("ffm" if drawn_per_real else "fgm", (laid.mm * per, 1 / per if drawn_per_real else per, laid.mm))
        value = join((quotient[0], unit(symbol)), " ")
        text = arrange("{0} · {1} = {2}" if drawn_per_real else "{0} : {1} = {2}", value, quotient[1],
                       in_mm(quotient[-1]))
        return arrange("{0}: {1}", quantity.written, text) if quantity.written else text

    def scale(self, kind: str, where: int) -> tuple[float, str]:
        """Value of a mm at a step, for one kind of quantity, and its unit."""
        scales, plan = self.scales, self.plan(where)
        return {"velocity": (scales.speed(plan), f"{scales.length}/s"),
                "acceleration": (scales.acceleration(plan), f"{scales.length}/s²"),
                "force": (scales.force(plan), scales.unit)}.get(kind, (scales.lengths_per_mm(plan), scales.length))

    def side(self, P: int, Q: int) -> Said:
        """The distance of two points by their letters."""
        names = [self.program.steps[index].name for index in (P, Q)]
        return arrange("{0}{1}", *names) if all(names) else arrange("{0}", "r")

    # ---- what is worked out -----------------------------------------------------------------------------------------

    def _moments(self, step: Step) -> Length:
        """A force from the moment of another about a point."""
        Y, X, C, p, q, m = step.args
        force, lever, arm = self.distance(p, q), self.arm(Y, C, p, q), self.distance(Y, X)
        laid = self.distance(m, step.index)
        per, symbol = self.scale("force", step.index)
        total, taken = self._product("mmdm", q, m, force.mm, lever.mm, arm.mm, laid.mm)
        text = arrange("P·h/{0} = {1} · {2} : {3} = {4} ({5})", self.side(Y, X), taken, total[-3], total[-2],
                       in_mm(total[-1]), join((digits(laid.mm * per), unit(symbol)), " "))
        return Length(text, (force, lever, arm, laid))

    def _no_moment(self, step: Step) -> Length:
        """The arm of a force about a point on its line."""
        Y, _, C, p, q, _ = step.args
        arm = self.arm(Y, C, p, q)
        return Length(arrange("h = {0}", arm.text), (arm,))

    def _couple(self, step: Step) -> Length:
        """A force whose pair is a given couple."""
        P, R, m = step.args
        length = self._couple_force(step, P, R, m)
        clockwise = step.params["moment"] < 0
        return length._replace(text=said("{0}, clockwise", length.text) if clockwise else
                               said("{0}, counter-clockwise", length.text))

    def _inertia(self, step: Step) -> Length:
        """A force whose pair is the couple of inertia."""
        P, R, a, b, m = step.args
        u, v = self.vector(P, R), self.vector(a, b)
        tangential = PaperDistance(abs(u[0] * v[1] - u[1] * v[0]) / (magnitude(*u) or 1.0) / self.per_mm(b),
                                   (a, P, R, a, b))
        length = self._couple_force(step, P, R, m)
        return Length(said("Tangential part {0}, {1}", tangential.text, length.text), (tangential, *length.measures))

    def _couple_force(self, step: Step, P: int, R: int, m: int) -> Length:
        """The force of a couple's pair, by the distance of its points."""
        arm, laid, names = self.distance(P, R), self.distance(m, step.index), self.side(P, R)
        force = laid.text if step.quantity is None else self._given_quantity(
            Quantity(arrange("{0}/{1}", step.quantity.written, names), "force"), laid, step.index)
        return Length(arrange("{0} = {1}, {2}", names, arm.text, force), (arm, laid))

    def _friction(self, step: Step) -> Length:
        """The radius of a friction circle."""
        radius = self.distance(step.args[0], step.index)
        return Length(self._given_quantity(Quantity("r", "length"), radius, step.index), (radius,))

    def _force_shift(self, step: Step) -> Length:
        """Shift of a force by a couple."""
        C, p, q, P, R, a, b = step.args
        measures = self.distance(a, b), self.arm(P, R, a, b), self.distance(p, q), self.distance(C, step.index)
        total, taken = self._product("mmdm", b, q, *(measure.mm for measure in measures))
        text = arrange("{0} · {1} : {2} = {3}", taken, total[-3], total[-2], in_mm(total[-1]))
        return Length(text, measures)

    def _product(self, kinds: str, source: int, own: int, first: float, *others: float) -> tuple[Sum, Said]:
        """A sum whose first length is taken where one mark is drawn and serves where another is, and how that length is
        told: as it is, or times how much larger it is there."""
        times = self.times(source, own)
        if times is None:
            total = Sum(kinds, (first, *others))
            return total, total[0]
        factor = "F" if kinds[0] == "M" else "f"
        total = Sum(kinds[0] + factor + kinds[1:], (first, times, *others))
        return total, arrange("{0} · {1}", total[0], total[1])

    def _quotient(self, step: Step) -> Length:
        """A normal acceleration that is computed from a velocity and a distance, and drawn to the scale of its plan."""
        K, A, m, w, k = step.args
        speed, arm, laid = self.distance(m, w), self.distance(K, A), self.distance(k, step.index)
        factors = [factor for factor in (self.times(w, A), self.times(A, k)) if factor is not None]
        of_speed = self.times(w, A) is not None
        total = Sum("M" + "F" * of_speed + "d" + "f" * (len(factors) - of_speed) + "m",
                    (speed.mm, *factors[:of_speed], arm.mm, *factors[of_speed:], laid.mm))
        v = arrange("({0})", arrange("{0} · {1}", total[0], total[1])) if of_speed else total[0]
        quotient = arrange("{0}² : {1}", v, total[1 + of_speed])
        times = arrange("{0} · {1}", quotient, total[-2]) if len(factors) > of_speed else quotient
        return Length(arrange("v²/{0} = {1} = {2}", self.side(K, A), times, in_mm(total[-1])), (speed, arm, laid))

    def _proportion(self, step: Step) -> Length:
        """A part of a vector, or more than all of it, by the ratio of two distances of a link."""
        A, B, C, P, Q = step.args
        measures = self.distance(P, Q), self.distance(A, C), self.distance(A, B), self.distance(P, step.index)
        total = Sum("mmdm", tuple(measure.mm for measure in measures))
        text = arrange("{0} · {1} : {2} = {3}", *(total[k] for k in range(3)), in_mm(total[-1]))
        if all(self.program.steps[arg].name for arg in step.args):
            names = arrange("{0} · {1}/{2}", self.side(P, Q), self.side(A, C), self.side(A, B))
            text = arrange("{0} = {1}", names, text)
        (x, y), (u, v) = self.vector(A, B), self.vector(A, C)
        return Length(said("{0}, reversed", text) if x * u + y * v < 0 else text, measures)

    def _known_length(self, step: Step) -> Length:
        """A length that was found beforehand and is laid off here."""
        whole = self.distance(step.args[4], step.index)
        return Length(whole.text, (whole,))


def _factors(times: float, parts: int = 3) -> tuple[float, ...]:
    """A factor as a product of up to `parts` factors, each within the range of dividers."""
    if parts == 1 or times <= MAX_ENLARGEMENT * (1 + LENGTH_TOL):
        return (times,)
    return (*_factors(times / MAX_ENLARGEMENT, parts - 1), MAX_ENLARGEMENT)


LENGTH_RULES: dict[Sizing, Callable[[Lengths, Step], Length]] = {
    Sizing.MOMENTS: Lengths._moments, Sizing.COUPLE: Lengths._couple, Sizing.INERTIA: Lengths._inertia,
    Sizing.FRICTION: Lengths._friction, Sizing.SHIFT: Lengths._force_shift, Sizing.SQUARE: Lengths._known_length,
    Sizing.DOUBLE: Lengths._known_length, Sizing.QUOTIENT: Lengths._quotient,
    Sizing.PROPORTION: Lengths._proportion,
}  # fmt: skip
