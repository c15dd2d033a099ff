"""The protocol of a construction: its stages, in each the entries that a textbook has, in these the single movements.

The one model of what is told of the drawing: text, sheet, handout, strip, live page and data read it. Values in drawing
order, in English that knows its words in other languages:

    protocol = Protocol(plans, scales)      # lengths are those of a sheet at these scales
    for passage in protocol.passages:       # what is drawn in one go on one plan in one stage
        passage.plan, passage.title, passage.stage, passage.law, passage.again
        for entry in passage.entries:       # one movement, or a compound as one step in the source's words
            entry.number                    # "12", or of a compound "34–41": numbers of steps, as marks bear them
            entry.sentence, entry.why
            for movement in entry.movements:
                movement.number, movement.sentence, movement.step

There is one numbering, that of the steps. What takes several movements bears the numbers of the first and the last:
folded, a reader still finds every number that stands on the sheet, and unfolded the same sentences stand below it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import groupby

from graphplan.kernel.drawing import Compound
from graphplan.kernel.program import Panel, Program, Step
from graphplan.kernel.stages import Stage
from graphplan.phrases import Said, arrange, in_any_case, join, said
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.lengths import Length, Lengths

Measuring = Callable[[], tuple[Length, ...]]  # finds how long something is on paper


@dataclass(frozen=True)
class SpokenStep:
    """A drawn step in words: its number, what the hand does and how long it is on paper, and why."""

    step: Step
    number: int
    sentence: Said
    why: str
    measuring: Measuring

    @property
    def lengths(self) -> tuple[Length, ...]:
        """How long it is on paper."""
        return self.measuring()

    @property
    def index(self) -> int:
        return self.step.index


@dataclass(frozen=True)
class Entry:
    """What is written as one step: one movement, or several consecutive ones of a compound."""

    sentence: Said
    why: str
    movements: tuple[SpokenStep, ...]
    measuring: Measuring

    @property
    def lengths(self) -> tuple[Length, ...]:
        """How long it is on paper."""
        return self.measuring()

    @property
    def is_compound(self) -> bool:
        """Whether it is several movements."""
        return len(self.movements) > 1

    @property
    def number(self) -> str:
        """The number of its step, or those of its first and last."""
        first, last = self.movements[0].number, self.movements[-1].number
        return f"{first}–{last}" if self.is_compound else str(first)

    @property
    def text(self) -> Said:
        """Its sentence, with its reason where it has one."""
        return with_reason(self.sentence, self.why)


@dataclass(frozen=True)
class Passage:
    """Entries of one stage, one after the other on one plan; `again` where others of that stage came before.

    `number` is the place of the stage among those of the program, and of one that is told again that of the first;
    `law` is empty where it was told on this plan before; `controls` are what can be seen on the plan when it is drawn.
    """

    plan: Panel
    stage: Stage | None
    number: int | None
    again: bool
    law: str
    entries: tuple[Entry, ...]
    controls: tuple[Said, ...] = ()

    @property
    def title(self) -> Said | None:
        """What stands over it."""
        if self.stage is None:
            return None
        return said("{0}, continued", self.stage.title) if self.again else self.stage.title


@dataclass(frozen=True)
class Protocol:
    """The steps of a construction in words, with lengths on paper where scales are given."""

    plans: Plans
    scales: Scales | None = None

    @property
    def _program(self) -> Program:
        return self.plans.drawing.drawn

    @cached_property
    def steps(self) -> tuple[SpokenStep, ...]:
        """Every step, in drawing order."""
        program, spoken = self._program, list[SpokenStep]()
        for step in program.steps[program.givens :]:
            measuring = partial(self.lengths.for_step, step) if self.lengths else tuple
            sentence = with_lengths(program.sentence(step.index), measuring)
            spoken.append(SpokenStep(step, program.number(step.index), sentence, step.why, measuring))
        return tuple(spoken)

    @property
    def sentences(self) -> Iterator[Said]:
        """Every step of the program in a sentence, with its reason; those that are given first."""
        program = self._program
        yield from (program.sentence_with_reason(index) for index in range(program.givens))
        yield from (with_reason(step.sentence, step.why) for step in self.steps)

    @cached_property
    def lengths(self) -> Lengths | None:
        """The lengths of paper."""
        return lengths_of(self.plans, self.scales) if self.scales else None

    @cached_property
    def stages(self) -> tuple[tuple[Stage, ...], Mapping[int, int]]:
        """The stages, each once, and by step which of them it is a part of."""
        numbers: dict[Stage, int] = {}
        of = {step.index: numbers.setdefault(stage, len(numbers)) for stage, steps in self._program.stages
              for step in steps}
        return tuple(numbers), of

    @cached_property
    def passages(self) -> tuple[Passage, ...]:
        """All that is drawn, in drawing order."""
        (stages, of), passages = self.stages, list[Passage]()
        told_stages, laws, plan = set[int](), set[str](), None
        for (home, number), steps in groupby(self.steps, lambda one: (one.step.panel, of.get(one.index))):
            laws, plan = (laws if home == plan else set()), home
            stage = None if number is None else stages[number]
            law = stage.law if stage and stage.law not in laws else ""
            entries = tuple(self._entries([*steps], stage))
            controls = tuple(control for entry in entries for one in entry.movements
                             for control in self._controls_at(one.index))
            passages.append(Passage(home, stage, number, number in told_stages, law, entries, controls))
            laws.add(law)
            told_stages.update([] if number is None else [number])
        return tuple(passages)

    def _controls_at(self, step: int) -> Iterator[Said]:
        """The controls whose last mark this step draws."""
        for control in self.plans.drawing.controls:
            if step == max(map(max, control.marks)):
                lines = (join(map(self._program.text, line), " ") for line in control.marks)
                yield said("Control: {0} and {1} meet in the pole of link {2}, through which {3} must pass.",
                           next(lines), next(lines), control.link, next(lines))

    @cached_property
    def _compounds(self) -> dict[int, Compound]:
        """The compound of each step that belongs to one."""
        return {step.index: compound for compound in self.plans.drawing.compounds for step in compound.movements}

    def _entries(self, steps: Sequence[SpokenStep], stage: Stage | None) -> Iterator[Entry]:
        """Steps of one stage, those of a compound as one entry where it has words for them."""
        for compound, run in groupby(steps, lambda one: self._compounds.get(one.index)):
            movements = tuple(run)
            folded = self._compound_text(compound, movements) if compound and len(movements) > 1 else None
            if folded:
                yield Entry(with_lengths(*folded), _reason(movements[-1], stage), movements, folded[1])
            else:
                yield from (Entry(one.sentence, _reason(one, stage), (one,), one.measuring) for one in movements)

    def _compound_text(self, compound: Compound, movements: Sequence[SpokenStep]) -> tuple[Said, Measuring] | None:
        """Some movements of a compound in one sentence: the whole compound, or its part that is drawn beforehand."""
        if movements[-1].index == compound.step.index:
            return compound.sentence, partial(self.lengths.for_step, compound.step) if self.lengths else tuple
        measuring = partial(self.lengths.for_earlier_part, compound) if self.lengths else tuple
        return (compound.sentence_on_other_plan, measuring) if compound.sentence_on_other_plan else None


def lengths_of(plans: Plans, scales: Scales) -> Lengths:
    """The lengths of a construction on its plans at some scales."""
    return Lengths(plans.drawing.drawn, plans.drawing.values, plans.plan_of_step.__getitem__, scales)


def with_reason(sentence: Said, why: str) -> Said:
    """A sentence with its reason where it has one."""
    return arrange("{0} ({1:capital}.)", sentence, why) if why else sentence


def with_lengths(sentence: Said, measuring: Measuring) -> Said:
    """A sentence with its lengths behind it."""
    def sentence_with_lengths() -> Said:
        lengths = measuring()
        return arrange("{0} {1}.", sentence, join(length.text for length in lengths)) if lengths else sentence

    return in_any_case(sentence_with_lengths)


def _reason(step: SpokenStep, stage: Stage | None) -> str:
    """The reason of a step; empty where its stage states it already."""
    stage_text = f"{stage.title} {stage.law}".lower() if stage else ""
    return "" if step.why.lower() in stage_text else step.why
