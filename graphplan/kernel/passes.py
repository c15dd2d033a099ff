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
from dataclasses import dataclass, field, replace
from heapq import heappop, heappush
from itertools import islice
from typing import Any, NamedTuple, cast

from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.program import Board, Mark, Panel, Program, Step, evaluate
from graphplan.kernel.stages import Stage, Teller, tell_stages
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
    return _renumber(board.steps, places, sorted(steps_behind(board.steps, places)))


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
    return _renumber(program.steps, program.wanted, sorted(steps_behind(program.steps, program.wanted)))


def _renumber(steps: Sequence[Step], wanted: Sequence[int], order: Sequence[int]) -> Program:
    """The program of these steps in this order."""
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


def order_by_reasoning(program: Program) -> tuple[Program, list[int]]:
    """Return the same steps stage by stage, each in one piece and after all that it reads, and the old place of each.

    Where stages read each other, one would be told in pieces. It keeps the piece in which its first compound is drawn,
    or else the last; of the others each step is told with the stage that reads it.
    """
    runs, retold = _order_of_stages(program), dict[int, Teller]()
    while tellers := _tellers_of_pieces(program, runs, retold):
        retold |= tellers
        program = replace(program, steps=tuple([step.but(stage=tellers.get(step.index, step.stage))
                                                for step in program.steps]))
        runs = _order_of_stages(program)
    order = [*range(program.givens), *(index for run in runs for index in run.steps)]
    return _renumber(program.steps, program.wanted, order), order


class _Run(NamedTuple):
    """Steps of a stage, by index, that are drawn one after the other, and the teller of the stage."""

    stage: Stage | None
    teller: Teller | None
    steps: list[int]


def _tellers_of_pieces(program: Program, runs: Sequence[_Run], retold: Collection[int]) -> dict[int, Teller]:
    """Return new tellers for steps, by index, of stages that are told in pieces, but for those `retold`."""
    place_of, readers = {index: k for k, run in enumerate(runs) for index in run.steps}, dict[int, list[int]]()
    goes, places_of = {**place_of}, dict[Stage, list[int]]()
    for step in program.steps:
        for arg in step.args:
            readers.setdefault(arg, []).append(step.index)
    for place, run in enumerate(runs):
        if run.stage and (not place or runs[place - 1].stage != run.stage):
            places_of.setdefault(run.stage, []).append(place)
    for stage, places in places_of.items():
        if len(places) == 1:
            continue
        pieces = [place for place in range(places[0], len(runs)) if runs[place].stage == stage]
        steps = [index for place in pieces for index in runs[place].steps]
        keeper = next((place for place in pieces if any(program.steps[index].choice for index in runs[place].steps)),
                      pieces[-1])
        sides = [arg for index in steps if place_of[index] > keeper for arg in program.steps[index].args
                 if goes.get(arg, 0) > keeper and max(program.steps[arg].args, default=arg) < program.givens]
        goes |= dict.fromkeys(sides, keeper)
        for index in () if sides else reversed(steps):
            readings = [goes[reader] for reader in readers.get(index, ()) if runs[goes[reader]].stage != stage]
            if place_of[index] < keeper:
                goes[index] = min(filter(keeper.__gt__, readings), default=keeper)
            elif place_of[index] > keeper:
                sources = [goes[arg] for arg in program.steps[index].args
                           if arg in goes and runs[goes[arg]].stage != stage]
                goes[index] = min(readings, default=max(sources, default=place_of[index]))
    return {index: teller for index, place in goes.items() if place != place_of[index] and index not in retold
            and (teller := runs[place].teller) and runs[place].stage != runs[place_of[index]].stage}


def _order_of_stages(program: Program) -> list[_Run]:
    """Return what is drawn one after the other.

    The plan of the stage recorded first is begun. Of the stages that can be drawn now one of the plan in hand comes
    first, else one for which another waits; of these one on the same part of it, then one like the last, then one like
    others on that plan or that such a one reads; else that which was recorded first.
    Where stages read each other, one is drawn as far as it goes, before another plan is begun.
    """
    waiting = _stages_to_draw(program)
    drawn, runs = dict.fromkeys(range(program.givens)), list[_Run]()
    plan = min(waiting, key=lambda stage: stage.first).plan if waiting else ""
    part, title, laws = "", "", dict[str, None]()
    ready = dict[_KindOfStage, list[tuple[int, _StageToDraw]]]()  # of each kind a heap, the first recorded on top

    def enter(stages: Iterable[_StageToDraw]) -> None:
        for stage in stages:
            heappush(ready.setdefault(stage.kind, []), (stage.first, stage))

    def preference(kind: _KindOfStage) -> tuple[bool | int, ...]:
        alike = kind.law in laws or not kind.laws_of_readers.isdisjoint(laws)
        first, stage = ready[kind][0]
        away = kind.plan != plan
        return (away, away and not stage.opens_another, kind.part != part, kind.law not in [*laws][-1:],
                kind.title != title, not alike, first)

    enter(stage for stage in waiting if not stage.reads)
    while True:
        kind = min(ready, key=preference, default=None)
        begun = [] if kind and kind.plan == plan else [stage for stage in waiting if stage.can_begin(drawn)
                                                       and (not kind or (stage.plan == plan and stage.is_in_ring))]
        if not kind and not begun:
            break
        if kind and not begun:
            _, stage = heappop(ready[kind])
            if not ready[kind]:
                del ready[kind]
        else:
            stage = min(begun, key=lambda one: (not one.is_awaited, one.first))
        plan, part, title, laws = stage.plan, stage.part, stage.title, laws if stage.plan == plan else {}
        laws.pop(stage.law, None)
        laws[stage.law] = None
        before = len(drawn)
        enter(stage.draw(drawn))
        runs.append(_Run(stage.stage, stage.teller, [*islice(drawn, before, None)]))
    return runs


class _KindOfStage(NamedTuple):
    """The grounds on which the next stage is chosen: its plan and the part of it, its law and title, and the laws of
    those that read it."""

    plan: str
    part: str
    law: str
    title: str
    laws_of_readers: frozenset[str]


@dataclass(eq=False)
class _StageToDraw:
    """A stage that is not drawn yet: the plan on which it ends, the words of its law and of its title, the steps that
    are left of it, what these read of other stages, and which stages read them."""

    plan: str
    part: str
    law: str
    title: str
    steps: list[Step]
    reads: set[int]
    stage: Stage | None
    teller: Teller | None
    readers: list[_StageToDraw] = field(default_factory=list)

    @property
    def kind(self) -> _KindOfStage:
        laws = frozenset(reader.law for reader in self.readers)
        return _KindOfStage(self.plan, self.part, self.law, self.title, laws)

    @property
    def first(self) -> int:
        """The place of its first step where it was recorded."""
        return self.steps[0].index

    @property
    def is_awaited(self) -> bool:
        """Whether a stage reads it that is not drawn yet."""
        return any(reader.steps for reader in self.readers)

    @property
    def opens_another(self) -> bool:
        """Whether a stage depends on this one alone, or no stage does."""
        return not self.readers or any(reader.reads <= {step.index for step in self.steps} for reader in self.readers)

    @property
    def is_in_ring(self) -> bool:
        """Whether it reads what reads it."""
        waiting, seen = [*self.readers], list[_StageToDraw]()
        while waiting:
            reader = waiting.pop()
            if reader not in seen and reader.steps:
                seen.append(reader)
                waiting.extend(reader.readers)
        return self in seen

    def can_begin(self, drawn: Collection[int]) -> bool:
        """Whether any of its steps can be drawn."""
        return any(all(arg in drawn for arg in step.args) for step in self.steps)

    def draw(self, drawn: dict[int, None]) -> list[_StageToDraw]:
        """Enter its steps, all or those that can be drawn; return the stages that need no further step."""
        places = set[int]()
        for step in self.steps:
            if all(arg in drawn for arg in step.args):
                drawn[step.index] = None
                places.add(step.index)
        self.steps = [step for step in self.steps if step.index not in places]
        waiting = [reader for reader in self.readers if reader.reads]
        for reader in waiting:
            reader.reads -= places
        return [reader for reader in waiting if not reader.reads]


def _stages_to_draw(program: Program) -> list[_StageToDraw]:
    """The stages in the order in which they were recorded; steps without a stage belong to the stage that is drawn
    next.

    What was recorded of one stage at several times is drawn in one go, but for what is done again on the plan of the
    pose, as in each round of friction.
    """
    told = {step.stage: stage for step, stage in zip(program.steps, tell_stages(program.steps), strict=True)}
    steps_of, teller = dict[Teller | None, list[Step]](), cast(Teller | None, None)
    for step in reversed(program.steps[program.givens:]):
        teller = step.stage or teller
        steps_of.setdefault(teller, []).append(step)
    together = dict[tuple[Any, Panel], list[Step]]()
    for teller, steps in steps_of.items():
        plan = home_plan(program, steps[::-1]).whole
        together.setdefault((teller if plan == _pose_plan(program) else told.get(teller), plan), []).extend(steps)
    stages, stage_of = list[_StageToDraw](), dict[int, _StageToDraw]()
    for (_, plan), unsorted in together.items():
        steps = sorted(unsorted, key=lambda step: step.index)
        stage, places = told.get(steps[-1].stage), {step.index for step in steps}
        law, title = (stage.law.key, stage.title.key) if stage else ("", "")
        reads = {arg for step in steps for arg in step.args if arg >= program.givens} - places
        part = home_plan(program, steps)
        stages.append(_StageToDraw(plan, part, law, title, steps, reads, stage, steps[-1].stage))
        stage_of.update(dict.fromkeys(places, stages[-1]))
    for reader in stages:
        for earlier in {id(stage_of[arg]): stage_of[arg] for arg in reader.reads}.values():
            earlier.readers.append(reader)
    return sorted(stages, key=lambda one: one.first)


def home_plan(program: Program, steps: Sequence[Step]) -> Panel:
    """The plan on which steps end that belong together: if they use others beside that of the pose, one of these."""
    pose = _pose_plan(program)
    return next((step.panel for step in reversed(steps) if step.panel.whole != pose), steps[-1].panel)


def _pose_plan(program: Program) -> Panel:
    """The plan on which the points of the pose lie."""
    return program.steps[0].panel.whole
