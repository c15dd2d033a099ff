"""What is measured on the finished sheet, and what it means: mm times the scale of a plan, beside what is computed."""

from __future__ import annotations

import math
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
from graphplan.phrases import Said, arranged, digits, in_any_case, joined, phrase, said, tenths, unit
from graphplan.sheet.words.lengths import NOTHING, Length, Lengths, Measure, size

# Places that are told by how far they are from another mark, and what that length is called.
FROM = {kinds.CENTRE: phrase("radius of curvature, {0}"),
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
    def told(self) -> Said:
        """All of it in a sentence."""
        return self.length.told


@dataclass(frozen=True)
class Readings:
    """What is read off a construction whose lengths on paper are these; `values` are its readings by kind and name."""

    drawing: Construction
    lengths: Lengths
    values: Mapping[str, Mapping[str, Any]]

    def __iter__(self) -> Iterator[Measured]:
        """Every result that is drawn, in the order of the construction; none that is given or nothing."""
        return filter(None, map(self.measured, self.drawn))

    @property
    def drawn(self) -> Iterator[Reading]:
        """The readings of what is drawn and not given."""
        return (reading for reading in self.drawing.readings if reading.given is None and reading.marks
                and (not reading.kind.place or reading.kind in FROM))

    def measured(self, reading: Reading) -> Measured | None:
        """What is read off, unless it is nothing."""
        if reading.kind.place:
            return self._way(reading)
        kind, dimension, value = reading.kind, reading.kind.dimension, self.values[reading.kind][reading.of]
        marks = [self.drawing.drawn.wanted[position] for position in reading.marks]
        if dimension in VECTORS:
            start, end = marks[-2:]
            steps = self.lengths.program.steps
            if steps[start].op.gives == LINE or (long := self.lengths.mm(start, end)) < NOTHING:
                return None
            found = self._vector(dimension, Measure(long, (start, end)), kind.group)
        elif dimension == units.MOMENT:
            found = self._moment(marks)
        elif self.lengths.mm(*marks[:2]) < NOTHING:
            return None  # no ruler tells how a link turns that is nothing on paper
        else:
            found = self._turning(reading, marks)
        computed = size(*value) if isinstance(value, tuple) else value
        length, read = found
        symbol = unit(dimension.unit(self.drawing.scene.units).replace("^2", "²").replace("*", "·"))
        told = said("{0}: {1} = {2}; computed {3}", self._name(kind, reading.of), length.told,
                    joined((digits(read), symbol), " "), digits(computed))
        return Measured(kind, reading.of, length._replace(told=told), read, computed)

    def _way(self, reading: Reading) -> Measured | None:
        """A radius or a diameter, from where a place is measured."""
        start, end = (self.drawing.drawn.wanted[position] for position in reading.marks)
        if (long := self.lengths.mm(start, end)) < NOTHING:
            return None
        length, read = self._vector(units.LENGTH, Measure(long, (start, end)), reading.kind.group)
        (x, y), (u, v) = self.values[reading.kind][reading.of], self.drawing.values[start][:2]
        computed = size(x - u, y - v)
        symbol = unit(units.LENGTH.unit(self.drawing.scene.units))
        told = said("{0}: {1} = {2}; computed {3}", FROM[reading.kind](reading.of), length.told,
                    joined((digits(read), symbol), " "), digits(computed))
        return Measured(reading.kind, reading.of, length._replace(told=told), read, computed)

    def _name(self, kind: ResultKind, of: str) -> Said:
        """What a result is called: v_B, omega_3; of pairs and balances in words."""
        if kind.pair or kind.group == kinds.FORCES:
            return said("{0} of {1}", kind.words, thing_named(self.drawing.scene, kind, of))
        return arranged("{0}_{1}", kind.dimension.letter, of)

    def _vector(self, dimension: Dimension, length: Measure, group: str) -> tuple[Length, float]:
        """A vector, by the scale of its plan."""
        start, end = length.marks
        group = group if dimension != units.LENGTH else "length"
        per, _ = self.lengths.scale(group, end)
        read, text = round(length.mm, 1) * per, self.lengths.program.text
        told = arranged("{0} · {1}", said("from {0} to {1}: {2}", text(start), text(end), length.told), digits(per))
        return Length(told, (length,)), read

    def _turning(self, reading: Reading, marks: Sequence[int]) -> tuple[Length, float]:
        """How a link turns, by the difference of two points' vectors over their distance.

        Where orthogonal velocities begin at their points, it is the part by which the image is shorter than the link.
        """
        P, R, p0, p1, r0, r1 = marks
        drawing, lengths = self.drawing, self.lengths
        u, side, excess = lengths.vector(P, R), lengths.between(P, R), float(reading.excess)
        tempo, names = float(drawing.tempo.unit), lengths.side(P, R)
        if drawing.turned and reading.kind == kinds.OMEGA and (p0, r0) == (P, R):
            image = lengths.between(p1, r1)
            x, y = lengths.vector(p1, r1)
            sign = 1 if x * u[0] + y * u[1] >= 0 else -1
            read = (1 - sign * round(image.mm, 1) / round(side.mm, 1)) * tempo
            ratio = arranged("(1 − {0}/{1})" if sign > 0 else "(1 + {0}/{1})", tenths(image.mm), tenths(side.mm))
            told = said("from {0} to {1}: {2}, {3} = {4}: {5}", lengths.program.text(p1), lengths.program.text(r1),
                        image.told, names, side.told, arranged("{0} · {1}", ratio, digits(tempo)))
            return Length(_more(told, excess), (image, side)), read + excess
        one, two = lengths.vector(p0, p1), lengths.vector(r0, r1)
        w = two[0] - one[0], two[1] - one[1]
        across = u[0] * w[1] - u[1] * w[0]
        across = across if not (drawing.turned and reading.kind == kinds.OMEGA) else -(u[0] * w[0] + u[1] * w[1])
        mm = across / size(*u) / lengths.per_mm(r1)
        part = Measure(abs(mm), (P, R, p0, p1, r0, r1))
        per, symbol = lengths.scale(reading.kind.group, r1)
        rate = round(mm, 1) * per / (round(side.mm, 1) * lengths.per_mm(R))
        whole = joined((digits(round(part.mm, 1) * per), unit(symbol)), " ")
        told = said("tangential part {0} · {1} = {2}, over {3} = {4} · {5}", part.told, digits(per), whole, names,
                    side.told, digits(lengths.per_mm(R)))
        return Length(_more(told, excess), (part, side)), rate + excess

    def _moment(self, marks: Sequence[int]) -> tuple[Length, float]:
        """The moment of forces about a point, each in mm times its arm."""
        pole, *rest = marks
        lengths, total = self.lengths, 0.0
        terms, measures = list[Said](), list[Measure]()
        per = math.nan
        for C, tail, head in zip(*[iter(rest)] * 3, strict=True):
            force, lever = lengths.between(tail, head), lengths.lever(pole, C, tail, head)
            metre = float(units.metre(self.drawing.scene.units))
            per = lengths.scale(kinds.FORCES, head)[0] * lengths.per_mm(C) / metre
            total += round(force.mm, 1) * round(lever, 1) * per
            terms.append(in_any_case(partial(_term, force.mm, lever, "+" if terms else "")))
            measures += [force, lengths.arm(pole, C, tail, head)]
        told = said("forces times arms ({0}) mm² · {1}", joined(terms, " "), digits(per))
        return Length(told, tuple(measures)), total


def _term(force: float, lever: float, plus: str) -> Said:
    """A moment, in mm times mm."""
    return arranged("{0}{1} · {2}", "−" if lever < 0 else plus, tenths(force), tenths(abs(lever)))


def _more(told: Said, excess: float) -> Said:
    """A turning and what a drive adds to it."""
    return arranged("{0} + {1}", told, digits(excess)) if excess else told
