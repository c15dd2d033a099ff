"""What is printed for a class: the booklet of its tasks, and the key: who has which variant, and the results of each,
as a table with a line a student and a column a result, and as one that `graphplan verify` reads of a student.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from graphplan.accuracy.drafted import Drafted
from graphplan.kernel.numbers import Floats
from graphplan.marking.classroom.results import Row
from graphplan.marking.classroom.variants import ClassVariant, Draw
from graphplan.mechanism.model import Scene, Units
from graphplan.mechanism.scene import parse
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ResultKind, kind_of
from graphplan.methods.results import facts
from graphplan.phrases import figures, said
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.handout import code, solution, task
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import back_to_front, frame_items, layout, title_items
from graphplan.sheet.layout.paper import paginate_tightly, words_page
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.plates.display import Sheet
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.sheet.words.facts import SaidFact, drawing_facts
from graphplan.sheet.words.rows import Deviations, TextRow, is_narrow, largest_size, row_items, table_rows
from graphplan.words.tongue import Tongue


@dataclass(frozen=True)
class Exercise:
    """A variant for its student of a group (no student for a spare sheet), in a file of this name."""

    variant: ClassVariant
    student: str
    group: str
    file: str

    def put_on_paper(self, code: int, task: Sequence[Sheet], solution: Sequence[Sheet], results: Iterable[KeyRow],
                     answers: Mapping[str, str], say: Tongue) -> PrintedExercise:
        """Print the exercise, with its line in the key: its student, its values, and its `answers` by their headings.
        """
        student = f"{self.student} ({self.group})" if self.group else self.student
        values = {name: say(figures(value.replace("-", "\N{MINUS SIGN}")))
                  for name, value in self.variant.named_values.items()}
        rows = [(self.variant.number, self.student, *row) for row in results]
        return PrintedExercise(code, tuple(task), tuple(solution), rows,
                               KeyLine(f"{self.variant.number}  {student}", {**values, **answers}))


class KeyLine(NamedTuple):
    """A line of the key: whose it is, and its numbers by the headings of their columns."""

    who: str
    numbers: Mapping[str, str]


@dataclass(frozen=True)
class PrintedExercise:
    """Printed parts of an exercise: its code, the pages of the task and of the solution, the rows of its results in the
    file of the key, and its line in the printed key."""

    code: int
    task: tuple[Sheet, ...]
    solution: tuple[Sheet, ...]
    rows: Sequence[Row]
    line: KeyLine


def print_exercise(exercise: Exercise, draw: Draw, further: Callable[[Scene], Iterable[KeyRow]]) -> PrintedExercise:
    """An exercise on paper; `further` are results of its scene that no drawing of one pose has. Fails as the drawing of
    its scene does."""
    scene = parse(exercise.variant.text, exercise.file)
    sheet = replace(scene.sheet, student=exercise.student, group=exercise.group, variant=str(exercise.variant.number))
    drafted: Drafted = draw(replace(scene, sheet=sheet))
    composition = drafted.composition
    drawing = composition.plans.drawing
    _, answers = drawing_facts(drawing, drawing.read(Floats()), Deviations())
    return exercise.put_on_paper(code(composition), task(composition), solution(composition),
                                 (*key_rows(drawing), *further(scene)),
                                 dict(_key_column(fact, composition.plans.tongue) for fact in answers),
                                 composition.plans.tongue)


# ---- the key --------------------------------------------------------------------------------------------------------


KEY_TITLE = said("Key")
KEY_COLUMNS = "variant", "student", "quantity", "of", "x", "y", "value", "unit"


def _key_column(fact: SaidFact, say: Tongue) -> tuple[str, str]:
    """Heading of a result's column, with its unit, and its value there; of a vector with its direction."""
    measure, angle, direction = say(fact.unit).partition(" ∠ ")
    return f"{say(fact.symbol)}, {measure}" if measure else say(fact.symbol), f"{say(fact.value)}{angle}{direction}"


def key_rows_of_lines(lines: Sequence[KeyLine], wide: float, say: Tongue) -> Iterator[TextRow]:
    """The lines of a key as rows: a column a number, in as many tables as it takes where they are so wide at most."""
    whose = [sentence_runs(text) for text in (say(said("Variant")), *(line.who for line in lines))]
    table = [[runs] for runs in whose]
    for head in dict.fromkeys(head for line in lines for head in line.numbers):
        column = [sentence_runs(head), *(sentence_runs(line.numbers.get(head, "")) for line in lines)]
        longer = [[*row, runs] for row, runs in zip(table, column, strict=True)]
        if len(table[0]) > 1 and not is_narrow(longer, wide):
            yield from table_rows(table)
            longer = [[*row] for row in zip(whose, column, strict=True)]
        table = longer
    yield from table_rows(table)


class KeyRow(NamedTuple):
    """A result: its quantity, what it is of, its components or its value, its unit."""

    quantity: str
    of: str
    x: str
    y: str
    value: str
    unit: str


def key_rows(drawing: Construction) -> Iterator[KeyRow]:
    """The results of a construction in the scene's units; what is only rounding beside the largest of its kind is 0."""
    results = drawing.read(Floats())
    largest = {kind: max(map(abs, named.values())) if kind_of(kind).single else largest_size(named)
               for kind, named in results.items()}
    for fact in facts(results):
        written = {axis: six_digits(number, largest[fact.kind]) for axis, number in fact.axes.items()}
        x, y, single = (written.get(axis, "") for axis in ("x", "y", ""))
        yield KeyRow(fact.kind, fact.of, x, y, single, fact.unit(drawing.scene.units))


def single_row(kind: ResultKind, at: str, value: float, largest: float, units: Units) -> KeyRow:
    """A single number over the cycle, at a travel if it has one."""
    return KeyRow(f"{kind} at {at}" if at else str(kind), "", "", "", six_digits(value, largest),
                  kind.dimension.unit(units))


def six_digits(value: float, largest: float) -> str:
    """A number in six digits, which no machine rounds in another way."""
    return f"{value if abs(value) > ZERO_TOL * largest else 0.0:.6g}"


def overview(composition: Composition, lines: Sequence[KeyLine]) -> Iterator[Sheet]:
    """The first pages of the key: the line of each variant."""
    plans, scene = composition.plans, composition.plans.drawing.scene
    frame = frame_of(scene)
    page = words_page(frame.paper("A4"), frame, frame.block(scene, plans.tongue), in_columns=False)

    def rows(wide: float) -> Sequence[TextRow]:
        return list(key_rows_of_lines(lines, wide, plans.tongue))

    apart, filled = replace(composition, arrangement=page), paginate_tightly(page.set(rows), page)
    first = layout(composition, document=KEY_TITLE)
    for number, page_rows in enumerate(filled, 1):
        items = back_to_front([*frame_items(apart), *row_items(page_rows),
                               *title_items(apart, KEY_TITLE, number, len(filled))])
        yield replace(first, width=page.width, height=page.height, frame=page.frame, panels={}, items=tuple(items))
