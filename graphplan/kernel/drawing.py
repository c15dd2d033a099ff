"""A drawing and the values of its marks: two records, as another pose is the same drawing with other values.

A drawing is a program, the role of each mark and the scale of each plan. Values know their drawing; a drawing knows no
values. They may be those of the given pose, of another one, of n poses at once, fractions, numbers that a page will
know later, or what was measured on paper: what reads them need not know which.

    drawing = record_drawing(board, {"energies": energies, "tangent": [tangent]}, {FLYWHEEL: PlanScale(on_paper=True)})
    values = drawing.mark_values()       # of the recorded pose, in floats
    values.values_of_role("energies")    # the points of that role, in drawing order
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, Mark, Panel, Program, Step, evaluate
from graphplan.phrases import Phrase, Said


class PlanScale(NamedTuple):
    """How a plan is drawn: `on_paper` in mm of paper, else in the lengths of the scene."""

    on_paper: bool = False


@dataclass(frozen=True, eq=False, repr=False)
class Drawing:
    """A program, the marks of each role by the role's name, as steps of it, and the scales of plans that have one."""

    program: Program
    roles: Mapping[str, tuple[int, ...]] = field(default_factory=dict, kw_only=True)
    plans: Mapping[Panel, PlanScale] = field(default_factory=dict, kw_only=True)

    def on_paper(self, panel: Panel) -> bool:
        """Whether a plan is drawn in mm of paper."""
        return panel in self.plans and self.plans[panel].on_paper

    def mark_values(self, domain: Domain | None = None,
                    given: Mapping[Any, Mapping[str, Any]] | None = None) -> Values:
        """The values of all marks in a number domain, floats by default; see :func:`graphplan.kernel.program.evaluate`.
        """
        domain = domain or Floats()
        return Values(self, evaluate(self.program, domain, given), domain)


@dataclass(frozen=True, eq=False, repr=False)
class Values:
    """The value of each mark of a drawing, by step, in the numbers of a domain."""

    drawing: Drawing
    numbers: Sequence[Any]
    domain: Domain = field(default_factory=Floats)

    def __getitem__(self, step: int) -> Any:
        return self.numbers[step]

    def values_of_role(self, role: str) -> list[Any]:
        """The values of the marks of a role."""
        return [self.numbers[step] for step in self.drawing.roles[role]]


@dataclass(frozen=True)
class Compound:
    """A compound as it is drawn: its step, of drawn marks, its movements, and the marks that its form has names for.
    """

    drawn: Program
    step: Step
    movements: tuple[Step, ...]
    inner: Mapping[str, int]

    @property
    def form(self) -> str:
        """The form in which it is drawn, or of which that is a variant."""
        return next((step.choice.form for step in self.movements if step.choice), "")

    @property
    def sentence(self) -> Said:
        """All of it as one step, in the source's words."""
        return self._form_text(self.step.op.by_form) or self.drawn.step_text(self.step)

    @property
    def sentence_before(self) -> Said | None:
        """What of it is drawn before the rest, as on another plan, where its form has words for that."""
        return self._form_text(self.step.op.before)

    @property
    def last_told(self) -> Step:
        """What the rest is told as: itself, where its form has words for it, or its last movement."""
        return self.step if self.form in self.step.op.by_form else self.movements[-1]

    @property
    def sentence_after(self) -> Said:
        """The rest in words."""
        return self._form_text(self.step.op.by_form) or self.drawn.sentence(self.last_told.index)

    @property
    def marks_in_words(self) -> list[int]:
        """The marks within it that are spoken of where it is told as one step."""
        words = " ".join(phrases[self.form].english for phrases in (self.step.op.by_form, self.step.op.before)
                         if self.form in phrases)
        return [mark for name, mark in self.inner.items() if f"{{{name}}}" in words]

    @property
    def inner_texts(self) -> dict[str, str]:
        """How the marks are spoken of that its form has names for."""
        return {name: self.drawn.text(mark) for name, mark in self.inner.items()}

    def _form_text(self, phrases: Mapping[str, Phrase]) -> Said | None:
        if self.form not in phrases:
            return None
        words, inner = phrases[self.form], self.inner_texts
        return self.drawn.step_text(self.step, lambda marks, **named: words(*marks, **named, **inner))


def record_drawing(board: Board, roles: Mapping[str, Iterable[Mark]],
                   plans: Mapping[Panel, PlanScale] | None = None) -> Drawing:
    """What the marks of these roles need of a board, as a drawing: nothing else is drawn."""
    marks = {role: [*named] for role, named in roles.items()}
    program = freeze(board, [mark for named in marks.values() for mark in named])
    steps = iter(program.wanted)
    return Drawing(program, roles={role: tuple(next(steps) for _ in named) for role, named in marks.items()},
                   plans=plans or {})
