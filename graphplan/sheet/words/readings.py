"""What is measured on the finished sheet, and what it means: mm times the scale of a plan, beside what is computed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

from graphplan.kernel.kinds import LINE
from graphplan.mechanism import units
from graphplan.mechanism.units import Dimension
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ResultKind
from graphplan.methods.recorded import Reading
from graphplan.methods.results import thing_named
from graphplan.phrases import Said, arrange, digits, in_any_case, join, phrase, said, unit
from graphplan.sheet.tolerances import MIN_LENGTH
from graphplan.sheet.words.lengths import Length, Lengths, PaperDistance, in_mm, magnitude
from graphplan.sheet.words.sums import Sum

# Places that are told by how far they are from another mark, and what that length is called.
DISTANCE_NAMES = {kinds.CENTRE: phrase("radius of curvature, {0}"),
                  kinds.INFLECTION: phrase("diameter of the inflection circle, {0}")}
VECTORS = units.SPEED, units.ACCELERATING, units.FORCE, units.LENGTH


class Measured(NamedTuple):
    """A result as it is read off the sheet: of what, how it is measured and what that means, beside what is computed.

    `value` is a size, and with a sign that of a turning or a moment.
    """

    kind: ResultKind
    of: str
    length: Length
    value: float
    computed: float

    @property
    def text(self) -> Said:
        """All of it in a sentence."""
        return self.length.text


@dataclass(frozen=True)
class Readings:
    """What is read off a construction whose lengths on paper are these; `values` are its readings by kind and name."""

    drawing: Construction
    lengths: Lengths
    values: Mapping[str, Mapping[str, Any]]

    def __iter__(self) -> Iterator[Measured]:
        """Every result that is drawn, in the order of the construction; none that is given or nothing."""
        return filter(None, map(self.measure, self.drawn_readings))

    @property
    def drawn_readings(self) -> Iterator[Reading]:
        """The readings of what is drawn and not given."""
        return (reading for reading in self.drawing.readings if reading.given is None and reading.marks
                and (not reading.kind.place or reading.kind in DISTANCE_NAMES))

    def measure(self, reading: Reading) -> Measured | None:
        """A reading with its value; None where it is too short to be measured."""
        if reading.kind.place:
            return self._distance_reading(reading)
        kind, dimension, value = reading.kind, reading.kind.dimension, self.values[reading.kind][reading.of]
        marks = [self.drawing.drawn.wanted[position] for position in reading.marks]
        computed = magnitude(*value) if isinstance(value, tuple) else value
        if dimension in VECTORS:
            start, end = marks[-2:]
            steps = self.lengths.program.steps
            if steps[start].op.gives == LINE or (long := self.lengths.mm(start, end)) < MIN_LENGTH:
                return None
            read = self._vector(dimension, PaperDistance(long, (start, end)), kind.group)
        elif dimension == units.MOMENT:
            marks = self._with_arms(marks)
            if len(marks) == 1:
                return self._no_moment(reading, computed)
            read = self._moment(marks)
        elif self.lengths.mm(*marks[:2]) < MIN_LENGTH:
            return None  # no ruler tells how a link turns that is nothing on paper
        else:
            read = self._turning(reading, marks)
        symbol = unit(dimension.sheet_unit(self.drawing.scene.units))
        return self._read(reading, self._name(kind, reading.of), read, symbol, computed)

    def _distance_reading(self, reading: Reading) -> Measured | None:
        """A radius or a diameter, from where a place is measured."""
        start, end = (self.drawing.drawn.wanted[position] for position in reading.marks)
        if (long := self.lengths.mm(start, end)) < MIN_LENGTH:
            return None
        read = self._vector(units.LENGTH, PaperDistance(long, (start, end)), reading.kind.group)
        (x, y), (u, v) = self.values[reading.kind][reading.of], self.drawing.values[start][:2]
        symbol = unit(units.LENGTH.unit(self.drawing.scene.units))
        return self._read(reading, DISTANCE_NAMES[reading.kind](reading.of), read, symbol, magnitude(x - u, y - v))

    def _read(self, reading: Reading, name: Said, read: ReadSum, symbol: Said, computed: float) -> Measured:
        """A reading beside the computed value."""
        text = said("{0}: {1} = {2}; computed {3}", name, read.text, join((read.total[-1], symbol), " "),
                    digits(computed))
        return Measured(reading.kind, reading.of, Length(text, read.measures), read.total.value, computed)

    def _no_moment(self, reading: Reading, computed: float) -> Measured:
        """The moment of no force."""
        text = said("{0}: no force has an arm about it, so the moment is 0; computed {1}",
                    self._name(reading.kind, reading.of), digits(computed))
        return Measured(reading.kind, reading.of, Length(text, ()), 0.0, computed)

    def _name(self, kind: ResultKind, of: str) -> Said:
        """What a result is called: v_B, omega_3; of pairs and balances in words."""
        if kind.pair or kind.group == kinds.FORCES:
            return said("{0} of {1}", kind.words, thing_named(self.drawing.scene, kind, of))
        return arrange("{0}_{1}", kind.dimension.letter, of)

    def _vector(self, dimension: Dimension, length: PaperDistance, group: str) -> ReadSum:
        """A vector, by the scale of its plan."""
        start, end = length.marks
        group = group if dimension != units.LENGTH else "length"
        per, _ = self.lengths.scale(group, end)
        total, text = Sum("mff", (length.mm, per, length.mm * per)), self.lengths.program.text
        description = said("from {0} to {1}: {2}", text(start), text(end), in_mm(total[0]))
        return ReadSum(arrange("{0} · {1}", description, total[1]), (length,), total)

    def _turning(self, reading: Reading, marks: Sequence[int]) -> ReadSum:
        """How a link turns, by the difference of two points' vectors over their distance.

        Where orthogonal velocities begin at their points, it is the part by which the image is shorter than the link.
        """
        P, R, p0, p1, r0, r1 = marks
        drawing, lengths = self.drawing, self.lengths
        u, side, excess = lengths.vector(P, R), lengths.distance(P, R), float(reading.excess)
        tempo, names, more = float(drawing.tempo.unit), lengths.side(P, R), (excess,) if excess else ()
        tail = "af" if excess else "f"
        if drawing.turned and reading.kind == kinds.OMEGA and (p0, r0) == (P, R):
            image = lengths.distance(p1, r1)
            x, y = lengths.vector(p1, r1)
            sign = 1 if x * u[0] + y * u[1] >= 0 else -1
            rate = (1 - sign * image.mm / side.mm) * tempo + excess
            total = Sum(("-" if sign > 0 else "+") + "mdf" + tail, (image.mm, side.mm, tempo, *more, rate))
            ratio = arrange("(1 − {0}/{1})" if sign > 0 else "(1 + {0}/{1})", total[0], total[1])
            text = said("from {0} to {1}: {2}, {3} = {4}: {5}", lengths.program.text(p1), lengths.program.text(r1),
                        in_mm(total[0]), names, in_mm(total[1]), arrange("{0} · {1}", ratio, total[2]))
            return ReadSum(_add_excess(text, excess, total), (image, side), total)
        first, second = lengths.vector(p0, p1), lengths.vector(r0, r1)
        w = second[0] - first[0], second[1] - first[1]
        across = u[0] * w[1] - u[1] * w[0]
        across = across if not (drawing.turned and reading.kind == kinds.OMEGA) else -(u[0] * w[0] + u[1] * w[1])
        mm = across / magnitude(*u) / lengths.per_mm(r1)
        tangential = PaperDistance(abs(mm), (P, R, p0, p1, r0, r1))
        (per, _), link = lengths.scale(reading.kind.group, r1), lengths.per_mm(R)
        total = Sum("mfdg" + tail, (mm, per, side.mm, link, *more, mm * per / (side.mm * link) + excess))
        text = said("tangential part over {0}: {1}", names, arrange(
            "{0} · {1} : ({2} · {3})", in_mm(total[0]), total[1], in_mm(total[2]), total[3]))
        return ReadSum(_add_excess(text, excess, total), (tangential, side), total)

    def _with_arms(self, marks: Sequence[int]) -> list[int]:
        """The centre of a moment and the marks of the forces that have an arm about it on paper."""
        pole, *force_marks = marks
        triples = zip(*[iter(force_marks)] * 3, strict=True)
        return [pole, *(mark for triple in triples if abs(self.lengths.lever(pole, *triple)) >= MIN_LENGTH
                        for mark in triple)]

    def _moment(self, marks: Sequence[int]) -> ReadSum:
        """The moment of forces about a point, each in mm times its arm."""
        pole, *force_marks = marks
        lengths, metre = self.lengths, float(units.metre(self.drawing.scene.units))
        measures, numbers = list[PaperDistance](), list[float]()
        for C, tail, head in zip(*[iter(force_marks)] * 3, strict=True):
            force, lever = lengths.distance(tail, head), lengths.lever(pole, C, tail, head)
            measures += [force, lengths.arm(pole, C, tail, head)]
            numbers += [force.mm, lever]
        per = lengths.scale(kinds.FORCES, force_marks[-1])[0] * lengths.per_mm(force_marks[-3]) / metre
        whole = sum(numbers[k] * numbers[k + 1] for k in range(0, len(numbers), 2)) * per
        total = Sum("Σ" + "m" * len(numbers) + "ff", (*numbers, per, whole))
        terms = [in_any_case(partial(_term, total, k)) for k in range(0, len(numbers), 2)]
        product = self._arm_products(marks)
        text = arrange("{0} = ({1}) {2} · {3}" if product else "{0} ({1}) {2} · {3}",
                       product or said("forces times arms"), join(terms, " "), unit("mm²"), total[-2])
        return ReadSum(text, tuple(measures), total)

    def _arm_products(self, marks: Sequence[int]) -> Said | None:
        """Forces times their arms by their letters, R_21·h; nothing where one of them bears none."""
        pole, *force_marks = marks
        arrows = self.drawing.arrows
        forces = {(arrow.start, arrow.end): arrow.label for arrow in arrows if arrow.kind not in ("arm", "balance")}
        pairs = {(arrow.start, arrow.end): arrow.label for arrow in arrows if arrow.kind == "balance"}
        if (ends := (force_marks[-2], force_marks[-1])) in pairs:
            return arrange("{0}·{1}", pairs[ends], self.lengths.side(pole, force_marks[0]))
        letters = [forces.get(ends) for ends in zip(force_marks[2::3], force_marks[1::3], strict=True)]
        arms = [arrow.label for arrow in arrows if arrow.kind == "arm" and arrow.start == pole]
        if not all(letters) or len(arms) != len(letters):
            return None
        return join((arrange("{0}·{1}", *pair) for pair in zip(letters, arms, strict=True)), " + ")


class ReadSum(NamedTuple):
    """A reading: its words up to the value, the distances measured, and the sum that gives the value."""

    text: Said
    measures: tuple[PaperDistance, ...]
    total: Sum


def _term(total: Sum, place: int) -> Said:
    """A moment, in mm times mm, with its sign."""
    sign = ("− " if place else "−") if total.numbers[place + 1] < 0 else "+ " if place else ""
    return arrange(f"{sign}{{0}} · {{1}}", total[place], total.unsigned_text(place + 1))


def _add_excess(told: Said, excess: float, total: Sum) -> Said:
    """Add what a drive adds to a turning, if anything."""
    return arrange("{0} + {1}", told, total[-2]) if excess else told
