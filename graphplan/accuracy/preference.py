"""Forms: every form of a construction, drawn, compared in a table, and weighed by operations and by pencil error."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from graphplan.accuracy.drafted import Drafted, draft, percent, shown_motion
from graphplan.check.trusted import construct
from graphplan.design.hand import Pencil
from graphplan.errors import ConstructionError, GraphplanError, Refused
from graphplan.kernel.kinds import DIVIDERS, FAILURES, SET_SQUARES
from graphplan.kernel.program import Program
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import METHODS, PREFERENCES
from graphplan.methods.construction import Construction
from graphplan.methods.design import OPEN, Design
from graphplan.phrases import Phrase, Said, arrange, join, phrase, said
from graphplan.sheet.layout.paper import sheet_size
from graphplan.sheet.plates.traced_motion import TracedMotion
from graphplan.sheet.words.rows import Deviation

Sheets = Callable[[Construction, Pencil, str | None], Drafted]

FORMS = ("", *METHODS)  # first the one that the pose chooses
NAMES = {"": phrase("pose's own"), "auxiliary": phrase("auxiliary"), "trial": phrase("trial"), "poles": phrase("poles")}


def plans_alone(drawing: Construction, pencil: Pencil, paper: str | None = None,
                motion: TracedMotion | None = None) -> Drafted:
    """A construction on its paper without words or letters: forms are weighed by their plans."""
    return draft(drawing, pencil, paper, protocol="none", lettered=False, motion=motion)


def form_name(methods: Sequence[str]) -> Said:
    """Name of the form that these methods give."""
    return said("every method") if tuple(methods) == FORMS else join(NAMES[method]() for method in methods)


def reason(refusal: GraphplanError) -> str:
    """Why a form cannot be drawn, without what to do about it: there are other forms."""
    match refusal:
        case ConstructionError():
            return said("step {0}: {1}", refusal.step, FAILURES[refusal.code][0])
        case Refused():
            return join((refusal.what, refusal.why), ": ")
    return str(refusal)


@dataclass(frozen=True)
class Form:
    """One drawing, by all the methods that lead to it; or a method that does not, and why."""

    methods: tuple[str, ...]
    drafted: Drafted | None
    refusal: GraphplanError | None = None

    @property
    def name(self) -> Said:
        """Name of the form."""
        return form_name(self.methods)

    @property
    def verdict(self) -> Said:
        """Summary of the form, in words."""
        if self.drafted is None:
            assert self.refusal is not None
            return said("{0}: cannot be drawn: {1}", self.name, reason(self.refusal))
        summary = said("{0}: {1} operations, error {2}", self.name, self.drafted.operations,
                       percent(self.drafted.error))
        return arrange("{0} ({1})", summary, self.drafted.worst.label) if self.drafted.worst else summary


@dataclass(frozen=True)
class Preference:
    """The form preferred, by the name of its method, and what is told of the choice: a line each."""

    method: str
    remarks: tuple[Said, ...] = ()


def by_method(draw: Callable[[str], Construction]) -> dict[str, Construction | GraphplanError]:
    """The construction by each method, or the reason why it fails."""
    drawn = dict[str, Construction | GraphplanError]()
    for method in FORMS:
        try:
            drawn[method] = draw(method)
        except GraphplanError as refusal:
            drawn[method] = refusal
    return drawn


def constructions(scene: Scene, wishes: Design = OPEN) -> dict[str, Construction | GraphplanError]:
    """The construction of a scene by each method, or the reason why it fails; strict ones have the same designs."""
    return by_method(lambda method: construct(scene, replace(wishes, method=method)))


def strict_constructions(drawn: Mapping[str, Construction | GraphplanError]
                         ) -> dict[str, Construction | GraphplanError]:
    """The constructions with compasses and straightedge alone."""
    return {method: one if isinstance(one, GraphplanError) else replace(one, design=replace(one.design, strict=True))
            for method, one in drawn.items()}


def forms(drawn: Mapping[str, Construction | GraphplanError], pencil: Pencil, *, paper: str | None = None,
          sheets: Sheets | None = None) -> list[Form]:
    """Every form of the constructions by all methods, each on its sheet; those that cannot be drawn with their reason.
    """
    on_sheet = sheets or draft

    def draft_forms(methods: list[str], one: Construction | GraphplanError) -> list[Form]:
        try:
            if isinstance(one, GraphplanError):
                raise one
            return [Form(tuple(methods), on_sheet(one, pencil, paper))]
        except GraphplanError as refusal:
            return [Form((method,), None, refusal) for method in methods]

    programs = different(drawn, lambda drawing: drawing.drawn)
    return sorted([form for program in programs for form in draft_forms(*program)],
                  key=lambda form: FORMS.index(form.methods[0]))


def different(drawn: Mapping[str, Construction | GraphplanError],
              program: Callable[[Construction], Program]) -> list[tuple[list[str], Construction | GraphplanError]]:
    """The constructions that have different programs, each with the methods that lead to it."""
    by_program: dict[Any, tuple[list[str], Construction | GraphplanError]] = {}
    for method, result in drawn.items():
        try:
            key: Any = str(result) if isinstance(result, GraphplanError) else tuple(
                [step.key for step in program(result).steps])
        except GraphplanError as refusal:
            key, result = str(refusal), refusal  # it cannot be drawn out in this pose
        by_program.setdefault(key, ([], result))[0].append(method)
    return list(by_program.values())


def preferred_form(scene: Scene, prefer: str, pencil: Pencil, wishes: Design = OPEN, *,
                   paper: str | None = None) -> Preference:
    """The form that is quickest, most accurate or, by the product of both relative to the best of each, balanced.

    Fails with `Refused` where a method is named as well, and as the pose's own form does where none can be drawn.
    """
    if prefer not in WEIGHED:
        raise Refused(f"--prefer {prefer}", "unknown preference", f"choose one of {', '.join(WEIGHED)}")
    if wishes.method:
        raise Refused(f"--prefer {prefer}", f"--method {wishes.method} already names the form",
                      "leave out one of the two")
    drawn = constructions(scene, replace(wishes, strict=False))
    all_forms = _on_one_paper(forms(strict_constructions(drawn) if wishes.strict else drawn, pencil, paper=paper,
                                    sheets=partial(plans_alone, motion=shown_motion(scene))))
    if all_forms[0].refusal is not None and all(form.refusal for form in all_forms):
        raise all_forms[0].refusal
    return choose_form(all_forms, prefer)


def choose_form(all_forms: Sequence[Form], prefer: str) -> Preference:
    """The best of some forms, of which one at least is drawn; of equals the first."""
    drawable = [(form, form.drafted) for form in all_forms if form.drafted is not None]
    word, weigh = WEIGHED[prefer]
    best, on = min(drawable, key=lambda pair: weigh(pair[1]))
    head = said("{0} form preferred: {1}; compared on {2}:", word(), best.name, on.paper)
    return Preference(best.methods[0], (head, *(form.verdict for form in all_forms)))


def _on_one_paper(all_forms: list[Form]) -> list[Form]:
    """The forms on the largest of their sheets: a larger one would make any form more accurate."""
    papers = [form.drafted.paper for form in all_forms if form.drafted is not None]
    largest = max(papers, key=lambda paper: sheet_size(paper)[0] * sheet_size(paper)[1], default="")
    return [_redraft_on(form, form.drafted, largest) if form.drafted is not None else form for form in all_forms]


def _redraft_on(form: Form, one: Drafted, paper: str) -> Form:
    """A form drawn on another sheet, or why it cannot be."""
    if one.paper == paper:
        return form
    try:
        return Form(form.methods, plans_alone(one.drawing, one.pencil, paper))
    except Refused as refusal:
        return Form(form.methods, None, refusal)


WEIGHED: dict[str, tuple[Phrase, Callable[[Drafted], tuple[float, ...]]]] = dict(zip(PREFERENCES, (
    (phrase("quick"), lambda one: (one.operations, one.error)),  # fewest operations first
    (phrase("accurate"), lambda one: (one.error, one.operations)),  # smallest pencil error first
    # each relative to the best of its kind
    (phrase("balanced"), lambda one: (one.operations * one.error, one.operations)),
), strict=True))


# ---- the forms in parallel: what each costs, and how far off it is drawn ---------------------------------------------


TABLE_WIDTH = 118
COUNT_COLUMNS = "form", "sheet", "steps", "operations", "lines", "arcs"
SQUARES_COLUMNS, STRICT_COLUMNS = ("squares", "dividers"), ("S", "E")
CROSSING_COLUMNS = "instrument changes", "flattest", "off sheet"
ERROR_COLUMNS = "form", "worst result", "relative error", "absolute error", "mm on paper", "largest source"


@dataclass(frozen=True)
class Comparison:
    """All forms on one kind of plan, by set squares or strictly."""

    scene: Scene
    plan: str
    strict: bool
    forms: tuple[Form, ...]

    @property
    def drawn_forms(self) -> list[tuple[str, Drafted]]:
        """The forms that can be drawn, with their names."""
        return [(form.name, form.drafted) for form in self.forms if form.drafted is not None]

    def lines(self) -> list[str]:
        """Costs and errors as two tables, and the forms that cannot be drawn with their reasons."""
        tools = "compasses and straightedge" if self.strict else "set squares, compasses and dividers"
        head = (*COUNT_COLUMNS, *(STRICT_COLUMNS if self.strict else SQUARES_COLUMNS), *CROSSING_COLUMNS)
        costs = [head, *(self._cost_row(name, draft) for name, draft in self.drawn_forms)]
        errors = [ERROR_COLUMNS, *(self._error_row(name, draft) for name, draft in self.drawn_forms)]
        refused = [form.verdict for form in self.forms if form.drafted is None]
        return ["", f"{self.plan.capitalize()} plans, with {tools}:",
                *(align_columns(costs) if self.drawn_forms else ()),
                *(["", *align_columns(errors)] if self.drawn_forms else ()),
                *(line for reason in refused for line in textwrap.wrap(reason, TABLE_WIDTH, subsequent_indent="  "))]

    def data(self) -> list[dict[str, Any]]:
        """The comparison as data: one entry a form."""
        return [{"form": form.name, "plan": self.plan, "strict": self.strict, **self._form_data(form)}
                for form in self.forms]

    def _form_data(self, form: Form) -> dict[str, Any]:
        """Cost and errors of a form, or why it cannot be drawn."""
        draft = form.drafted
        if draft is None:
            return {"refused": str(form.refusal)}
        return {"cost": draft.cost.data, "pencil": draft.data}

    def _cost_row(self, name: str, draft: Drafted) -> tuple[str, ...]:
        """Return the row of a form in the table of operations."""
        cost, counts = draft.cost, draft.cost.counts
        pair = ((counts.simplicity, counts.exactitude) if self.strict
                else (counts.others.get(SET_SQUARES, 0), counts.others.get(DIVIDERS, 0)))
        flattest = f"{cost.flattest.degrees:.0f}° at {cost.flattest.number}" if cost.flattest else ""
        numbers = cost.steps, counts.operations, counts.R2, counts.C3, *pair, counts.changes
        return name, draft.paper, *map(str, numbers), flattest, str(len(cost.off_sheet))

    def _error_row(self, name: str, draft: Drafted) -> tuple[str, ...]:
        """Return the row of a form in the table of errors: those of its worst result."""
        worst = draft.worst
        if worst is None:
            return name, *[""] * (len(ERROR_COLUMNS) - 1)
        deviation, mm = worst.deviation.value, worst.deviation.mm
        return (name, worst.label, percent(draft.error), f"{Deviation(deviation).text} {worst.unit(self.scene)}",
               "" if mm is None else Deviation(mm).text, draft.step_name(worst.worst_step))


LEGEND = ("S, E: Lemoine's simplicity and exactitude. Instrument changes: how often another instrument is taken. "
          "Flattest: the smallest angle between crossing lines, and its step. Off sheet: marks outside the paper of "
          "their plans. Relative error: relative to the largest value of its kind.")


def align_columns(rows: Sequence[Sequence[str]]) -> list[str]:
    """Rows as lines, their columns as wide as they need be: the first to the left, the others to the right."""
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ([cell.rjust(w) if i else cell.ljust(w) for i, (cell, w) in enumerate(zip(row, wide, strict=True))]
             for row in rows)
    return ["  ".join(line).rstrip() for line in lines]
