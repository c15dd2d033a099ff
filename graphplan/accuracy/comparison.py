"""The forms of a construction side by side: a table of what each costs and how far off it is drawn."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from graphplan.accuracy.drafted import Drafted, percent
from graphplan.accuracy.first_order import sampled
from graphplan.accuracy.preference import Form
from graphplan.kernel.kinds import DIVIDERS, SET_SQUARES
from graphplan.mechanism.model import Scene
from graphplan.phrases import digits
from graphplan.sheet.words.tables import Deviation

WIDTH = 118
COUNTED = "form", "sheet", "steps", "operations", "lines", "arcs"
BY_SQUARES, STRICTLY = ("squares", "dividers"), ("S", "E")
DRAWN = "changes", "flattest", "off"
OFF = "form", "worst result", "beside largest", "in its unit", "mm", "most from"


@dataclass(frozen=True)
class Comparison:
    """All forms on one kind of plan, by set squares or strictly; `hands` is how many hands also draw each."""

    scene: Scene
    plan: str
    strict: bool
    forms: tuple[Form, ...]
    hands: int = 0

    @property
    def drawn(self) -> list[tuple[str, Drafted]]:
        """The forms that can be drawn, with their names."""
        return [(form.name, form.drafted) for form in self.forms if form.drafted is not None]

    def lines(self) -> list[str]:
        """Costs and errors as two tables, and the forms that cannot be drawn with their reasons."""
        tools = "compasses and straightedge" if self.strict else "set squares, compasses and dividers"
        head = (*COUNTED, *(STRICTLY if self.strict else BY_SQUARES), *DRAWN)
        costs = [head, *(self._cost(name, one) for name, one in self.drawn)]
        errors = [(*OFF, *(("hands", "missed") if self.hands else ())),
                  *(self._errors(name, one) for name, one in self.drawn)]
        refused = [form.told for form in self.forms if form.drafted is None]
        return ["", f"{self.plan.capitalize()} plans, with {tools}:", *(aligned(costs) if self.drawn else ()),
                *(["", *aligned(errors)] if self.drawn else ()),
                *(line for reason in refused for line in textwrap.wrap(reason, WIDTH, subsequent_indent="  "))]

    def data(self) -> list[dict[str, Any]]:
        """The same as data: one entry a form."""
        return [{"form": form.name, "plan": self.plan, "strict": self.strict, **self._found(form)}
                for form in self.forms]

    def _found(self, form: Form) -> dict[str, Any]:
        """Cost and errors of a form, or why it cannot be drawn."""
        one = form.drafted
        if one is None:
            return {"refused": str(form.refusal)}
        hands = {"hands": asdict(sampled(one.drawing, one.hand, self.hands))} if self.hands else {}
        return {"cost": one.cost.data, "pencil": one.data, **hands}

    def _cost(self, name: str, one: Drafted) -> tuple[str, ...]:
        """One form's row of counts."""
        cost, found = one.cost, one.cost.counts
        pair = ((found.simplicity, found.exactitude) if self.strict
                else (found.others.get(SET_SQUARES, 0), found.others.get(DIVIDERS, 0)))
        flattest = f"{cost.flattest.degrees:.0f}° at {cost.flattest.number}" if cost.flattest else ""
        numbers = cost.steps, found.operations, found.R2, found.C3, *pair, found.changes
        return name, one.paper, *map(str, numbers), flattest, str(len(cost.off_sheet))

    def _errors(self, name: str, one: Drafted) -> tuple[str, ...]:
        """One form's row of errors: those of its worst result, and how it scatters beside what is expected."""
        worst = one.worst
        if worst is None:
            return name, *[""] * (len(OFF) - 1 + 2 * bool(self.hands))
        own, mm = worst.deviation.value, worst.deviation.mm
        row = (name, worst.named, percent(one.error), f"{Deviation(own).told} {worst.unit(self.scene)}",
               "" if mm is None else Deviation(mm).told, one.named(worst.worst_step))
        if not self.hands:
            return row
        scatter = sampled(one.drawing, one.hand, self.hands)
        off = scatter.results[worst.kind][worst.of].deviation
        ratio = f"×{digits(off / own, 3)}" if 0 < own < math.inf else ""
        return *row, ratio, percent(scatter.missed)


LEGEND = (
    "S, E: Lemoine's simplicity and exactitude. Flattest: the angle of the flattest crossing, and its step. "
    "Off: marks outside the paper of their plans. Beside largest: beside the largest value of its kind.",
    "Hands: the scatter of noisy hands beside what is expected in first order. Missed: those whose lines did not meet.",
)


def legend(hands: int) -> list[str]:
    """What the columns of the tables mean."""
    return ["", *(line for told in LEGEND[: 2 if hands else 1] for line in textwrap.wrap(told, WIDTH))]


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Rows as lines, their columns as wide as they need be: the first to the left, the others to the right."""
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ([cell.rjust(w) if i else cell.ljust(w) for i, (cell, w) in enumerate(zip(row, wide, strict=True))]
             for row in rows)
    return ["  ".join(line).rstrip() for line in lines]
