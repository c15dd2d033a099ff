"""What stands over each plan: what it is, and its scales."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from graphplan.kernel.program import Panel
from graphplan.phrases import joined
from graphplan.sheet.layout.scales import Scales, times
from graphplan.sheet.lettering.lettering import SIZE, Runs, sentence_runs, wrap
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Rect, Text
from graphplan.sheet.plates.plans import Plans

HEAD = 3.0  # mm: the size of a plan's name
LINES = {2: (4.6, 3.7), 3: (3.4, 3.6)}  # mm: of so many lines the first base line, and from base line to base line


def captions(rect: Rect, panel: Panel, plans: Plans, scales: Scales) -> Iterator[Text]:
    """Over a plan what it is, and its scales."""
    kinds, multiple = plans.kinds(panel), scales.multiples.get(panel, Fraction(1))
    head = panel.caption(kinds)
    head = head if multiple == 1 else joined((head, times(multiple)))
    heads = wrap(sentence_runs(plans.tongue(head)), HEAD, rect.width - 5, bold=True)
    told = plans.tongue(joined(scales.said(panel, kinds), ",  "))
    lines: list[Runs] = [*heads, *wrap(sentence_runs(told), SIZE, rect.width - 5)]
    first, pitch = LINES[min(max(len(lines), 2), 3)]
    for i, runs in enumerate(lines[:3]):
        bold = i < len(heads)
        yield Text(pens.LETTERS, "text", None, (rect.left + 2.5, rect.top - first - pitch * i), runs,
                   HEAD if bold else SIZE, bold=bold)  # fmt: skip
