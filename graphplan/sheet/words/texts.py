"""Texts: how steps, readings and their numbers are said in the language of a sheet."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from graphplan.kernel.kinds import LINE
from graphplan.kernel.stages import Equation
from graphplan.mechanism import units
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.units import Dimension
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import (
    ACCELERATION_CENTRE,
    CENTRE,
    INFLECTION,
    MOTION_POLE,
    POLE,
    POLE_HEADING,
    WORDS,
    ResultKind,
)
from graphplan.methods.motion.circle_diagram import DrawnCircle
from graphplan.methods.panels import pole_letter, slide_named
from graphplan.methods.recorded import Reading
from graphplan.methods.results import thing_named
from graphplan.phrases import Said, arrange, digits, in_any_case, join, phrase, said, unit
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import (
    CAPS,
    GREEK,
    HEADING,
    SIZE,
    Runs,
    equation_runs,
    name_runs,
    sentence_runs,
    tie_equations,
    width,
    wrap,
)
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.view import interpolate
from graphplan.sheet.tolerances import MIN_LENGTH, ZERO_TOL
from graphplan.sheet.words.lengths import Length, Lengths, PaperDistance, Sum, in_mm, magnitude
from graphplan.sheet.words.protocol import Entry, Passage, lengths_of, protocol_of
from graphplan.sheet.words.rows import (
    Cell,
    Deviations,
    Table,
    TextRow,
    coordinate_table,
    is_narrow,
    join_tables,
    paragraph_rows,
    scalar_table,
    table_rows,
    vector_table,
    zero_rounding,
)

if TYPE_CHECKING:
    from graphplan.sheet.words.force_tables import ForceTables

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
    """Results read off a construction with these lengths on paper; `values` are its readings by kind and name."""

    drawing: Construction
    lengths: Lengths
    values: Mapping[str, Mapping[str, Any]]

    def __iter__(self) -> Iterator[Measured]:
        """Every drawn result, in the order of the construction, except for given and zero ones."""
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
        """Name of a result: v_B, omega_3; of pairs and balances in words."""
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
        """Turning of a link, by the difference of two points' vectors over their distance.

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
        """Forces times their arms by their letters, R_21·h; None if one of them has no letter."""
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


PLAN_TITLE_SIZE = 1.2  # of the letter size: the name of a plan
UNDERLINED_HEIGHT = 1.75  # of the letter size: a row with room for rules below its letters
RESULTS = "results"  # the layer of what is read when all is drawn


@dataclass(frozen=True, eq=False)
class SheetWords:
    """The words beside the plans; `check` is the difference from the analytic solver, by kind."""

    plans: Plans
    check: Mapping[str, Any] = field(default_factory=dict)
    indent: ClassVar[float] = 11.0  # mm: of what hangs from a number
    unfolded: ClassVar[bool] = False  # whether what takes several movements has them below it

    @property
    def drawing(self) -> Construction:
        return self.plans.drawing

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The names of marks that may occur in a sentence."""
        return tuple(step.name for step in self.drawing.drawn.steps if step.name)

    @cached_property
    def values(self) -> Mapping[str, Mapping[str, Any]]:
        """Results of the construction, by kind and name."""
        return zero_rounding(self.drawing.computed, self.drawing.scene.extent, self.drawing.kappa)

    def rows(self, wide: float, scales: Scales, pencil: Deviations) -> list[TextRow]:
        """Everything, for a column of this width; `pencil` are the expected drawing errors where they are told."""
        results = (*self._readings(wide, scales), *self._results(wide, pencil), *self._errors(wide, pencil.text),
                   *self._check(wide), *self._forms(wide))
        return [*self._steps(wide, scales), *self._circle(wide), *(replace(row, layer=RESULTS) for row in results)]

    def _runs(self, text: str) -> Runs:
        """A text in the tongue of the sheet, with the names of marks as they are set, in which equations are kept
        together."""
        return sentence_runs(tie_equations(self.plans.tongue(text)), self.names)

    def paragraph(self, text: str, wide: float, step: int | None = None, number: str = "") -> Iterator[TextRow]:
        """A paragraph, indented behind its number."""
        return self._hanging_rows(self._runs(text), wide, step, number)

    def _hanging_rows(self, runs: Runs, wide: float, step: int | None = None, number: str = "") -> Iterator[TextRow]:
        for i, row in enumerate(paragraph_rows(runs, wide, self.indent, number, step)):
            yield self._row_with_number(row) if number and i == 0 else row

    def _row_with_number(self, row: TextRow) -> TextRow:
        """A row with a number; subclasses may mark it."""
        return row

    def _heading(self, text: str, size: float = HEADING, gap: float = 3.0, step: int | None = None) -> TextRow:
        runs = sentence_runs(self.plans.tongue(text))
        return TextRow((Cell(0.0, runs, bold=True),), size=size, gap=gap, step=step, keep=2)

    def _steps(self, wide: float, scales: Scales) -> Iterator[TextRow]:
        """The protocol, plan by plan and stage by stage."""
        program = self.drawing.drawn
        yield from [self._heading(said("Construction"))] if program.steps else []
        names = ", ".join(step.name for step in program.steps[: program.givens])
        if self.drawing.scene.points and names:
            yield from self.paragraph(said("Given, on the mechanism plan: {0}.", names), wide)
        plan = ""
        for passage in protocol_of(self.plans, scales).passages:
            first = passage.entries[0].movements[0].index
            if passage.plan != plan:
                plan = passage.plan
                yield from self._title(said("On the {0}", passage.plan.words), wide, first, PLAN_TITLE_SIZE * SIZE, 2.4)
            for idea in passage.idea:
                yield from self.paragraph(arrange("{0:capital}.", idea), wide, first)
            yield from self._stage(passage, wide, first)
            for entry in passage.entries:
                yield from self.entry(entry, wide)
            for control in passage.controls:
                yield from self.paragraph(control, wide, passage.entries[-1].movements[-1].index)

    def _circle(self, wide: float) -> Iterator[TextRow]:
        """The circle diagram of the poles, where any are found by it."""
        if circle := self.drawing.circle:
            yield self._heading(said("Circle diagram"))
            yield circle_diagram_row(circle)
            poles = ", ".join(f"{side.number} {pole_letter(side.links)}" for side in circle.sides if side.number)
            text = said("A side joins two links whose pole is known, thick those of pins, guides and pitch points; 0 "
                        "is the frame. Found in this order: {0}.", poles)
            yield from self.paragraph(text, wide)

    def _stage(self, passage: Passage, wide: float, step: int) -> Iterator[TextRow]:
        """The title of a stage, its equations with what is known in them, and its law where it was not told before."""
        if passage.stage is None or passage.title is None:
            return
        yield from () if passage.likewise else self._title(arrange("{0:capital}", passage.title), wide, step)
        for equation in passage.equations:
            yield from self.equation(equation, wide - self.indent, step)
        if passage.law:
            begins_with_letter = self.plans.tongue(passage.law).partition(" ")[0] in GREEK
            law = arrange("{0}." if begins_with_letter else "{0:capital}.", passage.law)
            yield from (replace(row, keep=row.keep + 1) for row in self._hanging_rows(self._runs(law), wide, step))

    def _title(self, text: Said, wide: float, step: int, size: float = SIZE, gap: float = 1.2) -> Iterator[TextRow]:
        """A title over some entries, wrapped."""
        for i, runs in enumerate(wrap(self._runs(text), size, wide, bold=True)):
            yield TextRow((Cell(0.0, runs, bold=True),), size=size, gap=0.0 if i else gap, step=step, keep=2)

    def equation(self, equation: Equation, wide: float, step: int) -> Iterator[TextRow]:
        """An equation, each vector underlined once per known property; a long one is wrapped without underlines."""
        runs, lettered = equation_runs(equation.text), equation.text
        if width(runs, SIZE) > wide:
            yield from (TextRow((Cell(self.indent, line),), step=step, keep=1) for line in wrap(runs, SIZE, wide))
            return
        rules = tuple((equation_runs(lettered[:start]), equation_runs(lettered[:end]), times)
                      for start, end, times in equation.underlines if times)
        yield TextRow((Cell(self.indent, runs, rules=rules),), gap=0.3, step=step, keep=1,
                      tall=UNDERLINED_HEIGHT * SIZE)

    def entry(self, entry: Entry, wide: float) -> Iterator[TextRow]:
        """One step as in the textbook, with its movements below it where they are `unfolded`."""
        apart = self.unfolded and entry.is_compound
        yield from self._hanging_rows(self._runs(entry.text), wide, entry.movements[0].index, "" if apart
                                      else entry.number)
        for movement in entry.movements if apart else ():
            yield from self._hanging_rows(self._runs(movement.sentence), wide, movement.index, str(movement.number))

    def _readings(self, wide: float, scales: Scales) -> Iterator[TextRow]:
        """Yield the measured lengths on the finished sheet with their meaning."""
        readings = list(Readings(self.drawing, lengths_of(self.plans, scales), self.values))
        yield from [self._heading(said("Measured on the sheet"))] if readings else []
        for reading in readings:
            yield from self.paragraph(reading.text, wide)

    def _results(self, wide: float, pencil: Deviations) -> Iterator[TextRow]:
        if not (self.drawing.scene.points and self.drawing.readings):  # what is drawn of no mechanism has none
            return
        yield self._heading(said("Results"))
        for first, second in self._motion(pencil):
            for table in join_tables(first, second, partial(is_narrow, wide=wide)):
                yield from table_rows(table)
        if self.drawing.scene.loads:
            yield from self._forces(wide, pencil)

    def result_tables(self) -> Iterator[Table]:
        """The tables of what is read when all is drawn, each kind of vector in one of its own."""
        yield from (table for pair in self._motion(Deviations()) for table in pair if table)
        if self.drawing.scene.loads:
            tables = self._force_tables(Deviations())
            yield from filter(None, (*tables.reactions(), tables.balance()))

    def _motion(self, pencil: Deviations) -> Iterator[tuple[Table, Table]]:
        """The tables of points, links and slides: each that of velocities and that of accelerations."""
        values, scene, say = self.values, self.drawing.scene, self.plans.tongue
        point, link, slide, rate = say(said("point")), say(said("link")), say(said("slide")), say(unit("rad/s"))
        yield self._vectors(point, ("velocity", "acceleration"), scene.points, pencil)
        yield (scalar_table(say, link, "omega", rate, values.get("omega", {}), scene.links, pencil.of_kinds("omega")),
               scalar_table(say, link, "alpha", f"{rate}²", values.get("alpha", {}), scene.links,
                            pencil.of_kinds("alpha")))
        slides = {slide.name: say(slide_named(slide)) for slide in scene.slides}
        yield self._vectors(slide, ("slide velocity", "slide acceleration"), slides, pencil, slides.__getitem__)
        yield self._poles(pencil)
        yield from self._curvatures(pencil)

    def _poles(self, pencil: Deviations) -> tuple[Table, Table]:
        """The tables of poles by their letters: where they are, and which way those at infinity lie."""
        say, scene = self.plans.tongue, self.drawing.scene
        long = say(unit(scene.units.length))
        heads = {POLE: (say(said("pole")), "x", f"y {long}"), POLE_HEADING: (say(said("pole at infinity")), "dx", "dy")}
        finite, infinite = (coordinate_table(say, head, self.values.get(kind, {}), pencil.of_kinds(kind),
                                             lambda name: pole_letter(scene.link_pair(name)))
                            for kind, head in heads.items())
        return finite, infinite

    def _curvatures(self, pencil: Deviations) -> Iterator[tuple[Table, Table]]:
        """The tables of centres of curvature, and of inflection circles by their two poles."""
        say, long = self.plans.tongue, self.plans.tongue(unit(self.drawing.scene.units.length))
        heads = {CENTRE: say(said("centre of curvature")), MOTION_POLE: say(said("pole of link")),
                 INFLECTION: say(said("inflection pole of link")),
                 ACCELERATION_CENTRE: say(said("acceleration centre of link"))}
        centres, poles, inflection, accelerations = (
            coordinate_table(say, (head, "x", f"y {long}"), self.values.get(kind, {}), pencil.of_kinds(kind), str)
            for kind, head in heads.items())
        yield centres, []
        yield poles, inflection
        yield accelerations, []

    def _vectors(self, what: str, kinds: tuple[str, str], order: Iterable[str], pencil: Deviations,
                 spoken: Callable[[str], str] = str) -> tuple[Table, Table]:
        """The tables of two kinds of vector, whose numbers are rounded beside the fastest and the sharpest of points.
        """
        speed = self.plans.tongue(unit(f"{self.drawing.scene.units.length}/s"))
        heads = ("v", speed, "velocity"), ("a", f"{speed}²", "acceleration")
        first, second = (vector_table(self.plans.tongue, what, letter, symbol, self.values.get(kind, {}), order,
                                      pencil.of_kinds(kind),
                                      self.values.get(beside, {}), spoken)
                         for kind, (letter, symbol, beside) in zip(kinds, heads, strict=True))
        return first, second

    def _forces(self, wide: float, pencil: Deviations) -> Iterator[TextRow]:
        tables = self._force_tables(pencil)
        yield from (row for table in tables.reactions() for row in table_rows(table))
        for sentence in tables.seats():
            yield from self.paragraph(sentence, wide)
        yield from table_rows(tables.balance())

    def _force_tables(self, pencil: Deviations) -> ForceTables:
        from graphplan.sheet.words.force_tables import ForceTables  # most scenes have no loads

        return ForceTables(self.drawing, self.values, pencil, self.plans.tongue)

    def _errors(self, wide: float, told: str) -> Iterator[TextRow]:
        if told:
            yield self._heading(said("Drawing errors"))
            yield from self.paragraph(told, wide)

    def _check(self, wide: float) -> Iterator[TextRow]:
        if self.check:
            yield self._heading(said("Check"))
            differences = join(join((WORDS[kind], _gap_text(float(gap))), " ") for kind, gap in self.check.items())
            yield from self.paragraph(said("Largest difference from the analytic solver, relative to the number's own "
                                           "size: {0}.", differences), wide)

    def _forms(self, wide: float) -> Iterator[TextRow]:
        if not (self.drawing.scene.points and self.drawing.method):
            return
        yield self._heading(said("Method and forms"))
        for kind, methods in self.drawing.method.items():
            yield from self.paragraph(arrange("{0:capital}: {1}.", WORDS[kind], join(methods)), wide)
        for form in self.drawing.forms:
            yield from self.paragraph(form, wide)


def _gap_text(gap: float) -> str:
    """A difference as text; rounding errors are not given in figures, as these differ between machines."""
    return said("below 10⁻¹²") if gap <= ZERO_TOL else digits(gap, 2)


MIN_RADIUS, PER_LINK = 10.0, 2.2  # mm: the circle's radius, and how much larger it is with each link beyond four
LINK_RADIUS, FIGURE_MARGIN = 2.6, 1.5  # mm: the radius about a link's name, and what is left free around the figure
NUMBER_SIZE = 0.8 * SIZE  # mm: the letters of numbers
NUMBER_AT = 0.38  # of a side: where its number stands, off the middle, in which many sides cross
NUMBER_GROUND = Pen(0.0, pens.PAPER, fill=pens.PAPER)


def circle_diagram_row(circle: DrawnCircle) -> TextRow:
    """The circle diagram of the poles: links on a circle, the first at the upper left and the others the way of the
    clock, and a side for each pole that is known.

    Sides of the outset are thick, those that are found bear the number in whose order they are (Ozols 1974, 5-2).
    """
    links, items = circle.links, list[Item]()
    radius = MIN_RADIUS + PER_LINK * max(0, len(links) - 4)
    middle = radius + LINK_RADIUS + FIGURE_MARGIN
    angles = {link: math.pi * (0.75 - 2 * place / len(links)) for place, link in enumerate(links)}
    spots = {link: (middle + radius * math.cos(angle), middle + radius * math.sin(angle))
             for link, angle in angles.items()}

    def add_name(name: str, size: float, ground: Circle) -> None:
        (x, y), runs = ground.centre, name_runs(name)
        items.extend((ground, Text(pens.LETTERS, "text", None, (x, y - CAPS * size / 2), runs, size, "middle")))

    for side in circle.sides:
        pen = pens.PRODUCED if side.number else pens.NORMAL
        items.append(Polyline(pen, "text", None, tuple(spots[link] for link in side.links)))
    for side in circle.sides:
        if side.number:
            start, end = side.links
            name, spot = str(side.number), interpolate(spots[start], spots[end], NUMBER_AT)
            room = 0.7 * max(width(name_runs(name), NUMBER_SIZE), NUMBER_SIZE)
            add_name(name, NUMBER_SIZE, Circle(NUMBER_GROUND, "text", None, spot, room))
    for link, spot in spots.items():
        add_name("0" if str(link) == FRAME else link, SIZE, Circle(pens.BALLOON, "text", None, spot, LINK_RADIUS))
    return TextRow((), tall=2 * middle, figure=tuple(items), keep=1)
