"""Passes over a program: its drawing in values of any kind, what lies behind a mark, what pruning leaves.

A drawing is a program, the role of each mark and the scale of each plan. Values know their drawing; a drawing knows no
values. They may be those of the given pose, of another one, of n poses at once, fractions, numbers that a page will
know later, or what was measured on paper: what reads them need not know which.

    drawing = record_drawing(board, {"energies": energies, "tangent": [tangent]}, {FLYWHEEL: PlanScale(on_paper=True)})
    values = drawing.mark_values()       # of the recorded pose, in floats
    values.values_of_role("energies")    # the points of that role, in drawing order
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.program import Board, Mark, Panel, Program, Step, evaluate
from graphplan.phrases import Phrase, Said


class PlanScale(NamedTuple):
    """Scale of a plan: `on_paper` in mm of paper, else in the lengths of the scene."""

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
    def variant(self) -> str:
        """The form in which it is drawn, by its own name."""
        return next((step.choice.best.form for step in self.movements if step.choice), "")

    @property
    def sentence(self) -> Said:
        """All of it as one step, in the source's words."""
        return self._form_text(self.step.op.by_form) or self.drawn.step_text(self.step)

    @property
    def sentence_before(self) -> Said | None:
        """Sentence for the part that is drawn first, as on another plan, if its form has words for that."""
        return self._form_text(self.step.op.before)

    @property
    def last_told(self) -> Step:
        """The step whose sentence describes the rest: itself, if its form has words for it, or its last movement."""
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
        """Texts of the marks that its form names."""
        return {name: self.drawn.text(mark) for name, mark in self.inner.items()}

    def _form_text(self, phrases: Mapping[str, Phrase]) -> Said | None:
        words, inner = phrases.get(self.variant, phrases.get(self.form)), self.inner_texts
        if words is None:
            return None
        return self.drawn.step_text(self.step, lambda marks, **named: words(*marks, **named, **inner))


def record_drawing(board: Board, roles: Mapping[str, Iterable[Mark]],
                   plans: Mapping[Panel, PlanScale] | None = None) -> Drawing:
    """Make a drawing of the marks of these roles and all steps that they need; no other step is drawn."""
    marks = {role: [*named] for role, named in roles.items()}
    program = freeze(board, [mark for named in marks.values() for mark in named])
    steps = iter(program.wanted)
    return Drawing(program, roles={role: tuple(next(steps) for _ in named) for role, named in marks.items()},
                   plans=plans or {})


def freeze(board: Board, wanted: Iterable[Mark]) -> Program:
    """The steps that the wanted marks need, renumbered in drawing order; unneeded steps are left out."""
    places = [mark.step.index for mark in wanted]
    return renumber(board.steps, places, sorted(steps_behind(board.steps, places)))


def needed_steps(board: Board, wanted: Iterable[Mark], known: Collection[int] = ()) -> set[int]:
    """The steps, by index, that the wanted marks need, but for known ones and what those need."""
    return steps_behind(board.steps, (mark.step.index for mark in wanted), known)


def steps_behind(steps: Sequence[Step], wanted: Iterable[int], known: Collection[int] = ()) -> set[int]:
    """Indices of the steps that the wanted steps need."""
    needed, waiting = set[int](), [*wanted]
    while waiting:
        index = waiting.pop()
        if index not in needed and index not in known:
            needed.add(index)
            waiting.extend(steps[index].args)
    return needed


def prune(program: Program) -> Program:
    """The program without the steps that no wanted mark needs."""
    return renumber(program.steps, program.wanted, sorted(steps_behind(program.steps, program.wanted)))


def renumber(steps: Sequence[Step], wanted: Sequence[int], order: Sequence[int]) -> Program:
    """Return the program of these steps in this order."""
    place = {index: position for position, index in enumerate(order)}
    renumbered = [step.but(index=place[step.index], args=tuple([place[arg] for arg in step.args]))
                  for step in map(steps.__getitem__, order)]
    return Program(tuple(renumbered), tuple(place[index] for index in wanted))


def put_together(programs: Sequence[Program]) -> tuple[Program, list[list[int]]]:
    """One program of several, drawn one after the other, and the new places of the steps of each.

    What is given in any comes first; letters that are taken get a prime. All marks are wanted that were.
    """
    order = sorted(((k, step.index) for k, program in enumerate(programs) for step in program.steps),
                   key=lambda at: (at[1] >= programs[at[0]].givens, at))
    place, steps, names = {at: position for position, at in enumerate(order)}, list[Step](), set[str]()
    for k, index in order:
        step = programs[k].steps[index]
        name = step.name
        while name and name in names:
            name += "'"
        names.add(name)
        steps.append(step.but(index=len(steps), name=name, args=tuple([place[k, arg] for arg in step.args])))
    places = [[place[k, step.index] for step in program.steps] for k, program in enumerate(programs)]
    wanted_places = tuple(places[k][index] for k, program in enumerate(programs) for index in program.wanted)
    return Program(tuple(steps), wanted_places), places
