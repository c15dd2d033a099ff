"""The order in which a program is told: stage by stage, each in one piece and after what it reads.

Two decisions, each made once: with which stage each step is told, so that no two stages read each other; and which of
the stages that can be drawn comes next.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from typing import NamedTuple

from graphplan.kernel.passes import renumber, steps_behind
from graphplan.kernel.program import Panel, Program, Step
from graphplan.kernel.stages import Stage, Teller, tell_stages


def order_by_reasoning(program: Program, serves: Sequence[int]) -> tuple[Program, list[int]]:
    """Return the same steps in the order of telling, and the old place of each; `serves` numbers the compound that each
    step is drawn for."""
    stage_of = _Telling(program, serves).stage_of
    steps = [step.but(stage=stage) for step, stage in zip(program.steps, stage_of, strict=True)]
    order = [*range(program.givens), *_order_of_stages(program, stage_of)]
    return renumber(steps, program.wanted, order), order


def home_plan(program: Program, steps: Sequence[Step]) -> Panel:
    """The plan on which steps end that belong together: if they use others beside that of the pose, one of these."""
    pose = program.steps[0].panel.whole
    return next((step.panel for step in reversed(steps) if step.panel.whole != pose), steps[-1].panel)


# ---- with which stage each step is told ------------------------------------------------------------------------------


class _Telling:
    """The stage with which each step of a program is told, such that no two stages read each other.

    A step without a stage is told with the step recorded next. Of stages that read each other one is made whole first:
    it takes the steps that it needs, or leaves compounds that cannot be drawn yet to a stage that reads them. It is the
    one by which the fewest stages lose the step that they end in, and then the fewest steps change their stage.
    """

    def __init__(self, program: Program, serves: Sequence[int]):
        self.program, self.serves = program, serves
        self.stage_of = _recorded_stages(program)
        self.finished, ends = set(range(program.givens)), _first_ends(program, self.stage_of)
        self.unfinished = dict[Stage | None, set[int]]()  # the steps of each stage that is not whole yet, as recorded
        for index in range(program.givens, len(program)):
            self.unfinished.setdefault(self.stage_of[index], set()).add(index)
        while self.unfinished:
            if not self._draw_whole_stages():
                moves = [move for stage in self._first_ring() for move in self._ways_to_make_whole(stage)]
                self._retell(min(moves, key=lambda move: (len(ends & move.keys()), len(move))))

    def _draw_whole_stages(self) -> bool:
        """Draw the stages that read only themselves and what is drawn; return whether there are any."""
        whole = [stage for stage, steps in self.unfinished.items() if not self._missing(steps)]
        for stage in whole:
            self.finished |= self.unfinished.pop(stage)
        return bool(whole)

    def _missing(self, steps: Collection[int]) -> set[int]:
        """Return what steps read that is neither drawn nor one of them."""
        return {arg for index in steps for arg in self.program.steps[index].args
                if arg not in self.finished and arg not in steps}

    def _first_ring(self) -> list[Stage | None]:
        """Return the stages that read none but those that read them."""
        reads = {stage: {self.stage_of[arg] for arg in self._missing(steps)}
                 for stage, steps in self.unfinished.items()}
        behind = dict[Stage | None, set[Stage | None]]()
        for stage in self.unfinished:
            waiting, behind[stage] = [stage], set()
            while waiting:
                new = reads[waiting.pop()] - behind[stage]
                behind[stage] |= new
                waiting += new
        return [stage for stage in self.unfinished if all(stage in behind[other] for other in behind[stage])]

    def _ways_to_make_whole(self, stage: Stage | None) -> Iterator[dict[int, Stage | None]]:
        """Yield ways to make a stage whole: for each step that moves to another stage, that stage."""
        steps, waits = self.unfinished[stage], set[int]()
        yield dict.fromkeys(steps_behind(self.program.steps, steps, self.finished) - steps, stage)
        ready = steps | self.finished
        for index in sorted(steps):
            if any(arg in waits or arg not in ready for arg in self.program.steps[index].args):
                waits.add(index)
        if {self.serves[index] for index in waits}.isdisjoint(self.serves[index] for index in steps - waits):
            yield self._given_away(stage, sorted(waits))

    def _given_away(self, stage: Stage | None, steps: Sequence[int]) -> dict[int, Stage | None]:
        """Return for steps of a stage the stage that reads each, or else that it reads: that recorded first."""
        taker = dict[int, Stage | None]()
        readers = {index: [step.index for step in self.program.steps if index in step.args] for index in steps}
        sources = {index: self.program.steps[index].args for index in steps}
        for index, neighbours in (*reversed(readers.items()), *sources.items()):
            stages = {taker.get(step, self.stage_of[step]) for step in neighbours if step not in self.finished}
            if index not in taker and (stages := stages - {stage}):
                taker[index] = next(one for one in self.unfinished if one in stages)
        return taker

    def _retell(self, moves: dict[int, Stage | None]) -> None:
        """Tell steps with other stages."""
        for index, stage in moves.items():
            self.unfinished[self.stage_of[index]].remove(index)
            self.unfinished[stage].add(index)
            self.stage_of[index] = stage


def _recorded_stages(program: Program) -> list[Stage | None]:
    """Return the stage of each step; a step without one has that of the step recorded next."""
    stage_of = [*tell_stages(program.steps)]
    for index in reversed(range(program.givens, len(stage_of) - 1)):
        stage_of[index] = stage_of[index] or stage_of[index + 1]
    return stage_of


def _first_ends(program: Program, stage_of: Sequence[Stage | None]) -> set[int]:
    """Return the last step of each stage as it was recorded first; what is recorded of it later follows others."""
    tellers, ends = dict[Stage | None, Teller](), dict[Stage | None, int]()
    for step, stage in zip(program.steps, stage_of, strict=True):
        if step.stage and step.stage is tellers.setdefault(stage, step.stage):
            ends[stage] = step.index
    return {*ends.values()}


# ---- which stage is next ---------------------------------------------------------------------------------------------


def _order_of_stages(program: Program, stage_of: Sequence[Stage | None]) -> list[int]:
    """Return the steps, by index, stage by stage.

    The plan of the stage recorded first is begun. Of the stages that can be drawn now one of the plan in hand comes
    first, else one for which another waits; of these one on the same part of it, then one like the last, then one like
    others on that plan or that such a one reads; else that which was recorded first.
    """
    stages = _stages_to_draw(program, stage_of)
    plan, part, title, laws = stages[0].plan if stages else "", "", "", dict[str, None]()
    ready = dict[_KindOfStage, list[tuple[int, _StageToDraw]]]()  # of each kind a heap, the first recorded on top
    order = list[int]()

    def enter(stages: Iterable[_StageToDraw]) -> None:
        for stage in stages:
            heappush(ready.setdefault(stage.kind, []), (stage.recorded_at, stage))

    def preference(kind: _KindOfStage) -> tuple[bool | int, ...]:
        alike = kind.law in laws or not kind.laws_of_readers.isdisjoint(laws)
        first, stage = ready[kind][0]
        away = kind.plan != plan
        return (away, away and not stage.opens_another, kind.part != part, kind.law not in [*laws][-1:],
                kind.title != title, not alike, first)

    enter(stage for stage in stages if not stage.reads)
    while ready:
        kind = min(ready, key=preference)
        _, stage = heappop(ready[kind])
        if not ready[kind]:
            del ready[kind]
        plan, part, title, laws = stage.plan, stage.part, stage.title, laws if stage.plan == plan else {}
        laws.pop(stage.law, None)
        laws[stage.law] = None
        order += sorted(stage.steps)
        for reader in stage.readers:
            reader.reads -= stage.steps
        enter(reader for reader in stage.readers if not reader.reads)
    return order


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
    """A stage that is not drawn yet: the plan on which it ends, the words of its law and of its title, its steps, what
    these read of other stages, and which stages read them."""

    plan: str
    part: str
    law: str
    title: str
    steps: set[int]
    reads: set[int]
    readers: list[_StageToDraw] = field(default_factory=list)

    @property
    def kind(self) -> _KindOfStage:
        laws = frozenset(reader.law for reader in self.readers)
        return _KindOfStage(self.plan, self.part, self.law, self.title, laws)

    @property
    def recorded_at(self) -> int:
        """The place of its first step where it was recorded."""
        return min(self.steps)

    @property
    def opens_another(self) -> bool:
        """Whether a stage depends on this one alone, or no stage does."""
        return not self.readers or any(reader.reads <= self.steps for reader in self.readers)


def _stages_to_draw(program: Program, stage_of: Sequence[Stage | None]) -> list[_StageToDraw]:
    """The stages in the order in which they were recorded; what was recorded of one at several times is together."""
    steps_of, stages, owner = dict[Stage | None, list[Step]](), list[_StageToDraw](), dict[int, _StageToDraw]()
    for step in program.steps[program.givens:]:
        steps_of.setdefault(stage_of[step.index], []).append(step)
    for stage, steps in steps_of.items():
        law, title = (stage.law.key, stage.title.key) if stage else ("", "")
        places, part = {step.index for step in steps}, home_plan(program, steps)
        reads = {arg for step in steps for arg in step.args if arg >= program.givens} - places
        stages.append(_StageToDraw(part.whole, part, law, title, places, reads))
        owner.update(dict.fromkeys(places, stages[-1]))
    for reader in stages:
        for earlier in {id(owner[arg]): owner[arg] for arg in reader.reads}.values():
            earlier.readers.append(reader)
    return stages
