"""The key of a class: who has which variant, and the results of each, as a table that `graphplan verify` reads of a
student.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from graphplan.kernel.numbers.floats import Floats
from graphplan.mechanism.model import Units
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import KINDS, ResultKind
from graphplan.phrases import said
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import back_to_front, frame_items, layout, title_items
from graphplan.sheet.layout.paper import paginate_tightly, words_page
from graphplan.sheet.plates.display import Sheet
from graphplan.sheet.tolerances import ZERO_TOL
from graphplan.sheet.words.rows import TextRow, largest_size, row_items
from graphplan.sheet.words.texts import SheetWords

KEY = said("Key")
HEAD = "variant", "student", "quantity", "of", "x", "y", "value", "unit"


class Row(NamedTuple):
    """A result: its quantity, what it is of, its components or its value, its unit."""

    quantity: str
    of: str
    x: str
    y: str
    value: str
    unit: str


def key_rows(drawing: Construction) -> Iterator[Row]:
    """The results of a construction in the scene's units; what is only rounding beside the largest of its kind is 0."""
    for name, values in drawing.read(Floats()).items():
        if name not in KINDS:
            continue
        kind: ResultKind = KINDS[name]
        largest = max(map(abs, values.values()), default=0.0) if kind.single else largest_size(values)
        unit = kind.dimension.unit(drawing.scene.units)
        for of, value in values.items():
            x, y, one = ("", "", value) if kind.single else (*value, "")
            yield Row(name, of, _figure(x, largest), _figure(y, largest), _figure(one, largest), unit)


def single_row(kind: ResultKind, at: str, value: float, largest: float, units: Units) -> Row:
    """A single number over the cycle, at a travel if it has one."""
    return Row(f"{kind} at {at}" if at else str(kind), "", "", "", _figure(value, largest), kind.dimension.unit(units))


def _figure(value: float | str, largest: float) -> str:
    """A number in six digits, which no machine rounds in another way; nothing where there is none."""
    return value if isinstance(value, str) else f"{value if abs(value) > ZERO_TOL * largest else 0.0:.6g}"


def key_table(found: Iterable[tuple[int, str, Iterable[Row]]]) -> str:
    """The results of all variants, each by its number, with its student, as CSV."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(HEAD)
    for variant, student, rows in found:
        table.writerows((variant, student, *row) for row in rows)
    return text.getvalue()


def overview(composition: Composition, told: Sequence[tuple[int, str, str]]) -> Iterator[Sheet]:
    """The first pages of the key: each variant with its student and what was drawn for it."""
    plans, scene = composition.plans, composition.plans.drawing.scene
    words, frame = SheetWords(plans), frame_of(scene)
    page = words_page(frame.paper("A4"), frame, frame.block(scene, plans.tongue))

    def rows(wide: float) -> Sequence[TextRow]:
        lines = [(f"{variant}", f"{student}: {values}" if student else values) for variant, student, values in told]
        return [row for number, line in lines for row in words.paragraph(line, wide, number=number)]

    apart, filled = replace(composition, arrangement=page), paginate_tightly(page.set(rows), page)
    first = layout(plans.drawing, composition=composition, document=KEY)
    for number, placed in enumerate(filled, 1):
        items = back_to_front([*frame_items(apart), *row_items(placed), *title_items(apart, KEY, number, len(filled))])
        yield replace(first, width=page.width, height=page.height, frame=page.frame, panels={}, items=tuple(items))
