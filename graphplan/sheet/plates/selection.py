"""What of a sheet is shown: as it stands after a step, some steps in ink over what was drawn before them in grey, or
the number of every step at the mark that it makes."""

from __future__ import annotations

from dataclasses import replace

from graphplan.errors import Refused
from graphplan.kernel.program import Program
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.display import Item, Sheet
from graphplan.sheet.plates.pens import pale
from graphplan.sheet.words.texts import RESULTS


def numbered(drawn: Program, text: str) -> tuple[int, int]:
    """The first and the last step, by index, of a text such as `12` or `5-12`; fails with `Refused`."""
    first, _, last = text.partition("-")
    most = len(drawn) - drawn.givens
    if not (first.isdecimal() and (last or first).isdecimal() and 1 <= int(first) <= int(last or first) <= most):
        raise Refused(f"steps {text}", "there are no such steps", f"numbers from 1 to {most}, such as 1-{most}")
    return int(first) - 1 + drawn.givens, int(last or first) - 1 + drawn.givens


def selected(sheet: Sheet, last: int, first: int = 0) -> Sheet:
    """The sheet as it stands after the step of index `last`, with the steps before `first` in grey.

    The words end there too; results are read when all is drawn.
    """
    complete = last == len(sheet.sentences) - 1
    items = [item for item in sheet.items
             if (complete or item.layer != RESULTS if item.step is None else item.step <= last)]
    return replace(sheet, items=tuple([inked(item, first) for item in items]))


def with_numbers(composition: Composition) -> Composition:
    """The composition with every mark numbered by its step, lettered marks too."""
    return replace(composition, plans=replace(composition.plans, numbered=True))


def inked(item: Item, first: int) -> Item:
    """The item as it is, or in grey if a step before `first` made it."""
    return item if item.step is None or item.step >= first else replace(item, pen=pale(item.pen))
