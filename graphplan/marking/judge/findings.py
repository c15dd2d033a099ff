"""What is found of a drawing, counted and in words."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from graphplan.kernel.kinds import Movement
from graphplan.kernel.program import Program
from graphplan.marking.judge.verdict import MISSING, NOT_NEEDED, STATES, WRONG, Judgement, NumberVerdict, Verdict
from graphplan.methods.kinds import WORDS
from graphplan.phrases import Said, arranged, joined, phrase, said
from graphplan.sheet.layout.scales import digits

FIGURES = 2  # of a distance on paper
OFF, ALLOWED = phrase("off"), phrase("allowed")


def judged(judgement: Judgement) -> Iterator[Verdict]:
    """The verdicts that count: what is given counts only where it is wrong, and a plan may begin anywhere."""
    steps = judgement.drawing.drawn.steps
    for verdict in judgement.verdicts:
        if verdict.state == WRONG or not steps[verdict.step].op.free:
            yield verdict


def measured(judgement: Judgement, verdict: Verdict) -> bool:
    """Whether a step can be seen and has a place of its own: a plan may begin anywhere."""
    step = judgement.drawing.drawn.steps[verdict.step]
    return verdict.trace is not None and step.op.movement is not Movement.BEGUN


def counts(judgement: Judgement) -> dict[str, int]:
    """How many steps there are of each verdict."""
    found = Counter(verdict.state for verdict in judged(judgement))
    return {state: found[state] for state in STATES}


def counted(judgement: Judgement) -> Said:
    """The same in words, with the marks that no step asks for."""
    told = [arranged("{0} {1}", count, STATES[state]()) for state, count in counts(judgement).items() if count]
    if judgement.spare:
        told.append(arranged("{0} {1}", len(judgement.spare), NOT_NEEDED()))
    return joined(told)


@dataclass(frozen=True, order=True)
class Called:
    """What a step is called, in whatever construction: its number as it is printed, 0 for what is given, its mark."""

    number: int
    mark: str

    @property
    def short(self) -> str:
        """The number, or of what is given the letter."""
        return str(self.number) if self.number else self.mark

    @property
    def named(self) -> Said:
        """In words: a step by its number, a point of the pose by its name."""
        return said("step {0}", self.number) if self.number else said("the given point {0}", self.mark)

    @property
    def told(self) -> Said:
        """The same with the mark, as another construction may have another step of this number."""
        return joined((self.named, self.mark)) if self.number else self.named


def called(drawn: Program, index: int) -> Called:
    """What a step of a construction is called."""
    return Called(max(drawn.number(index), 0), drawn.text(index))


def named(drawn: Program, index: int) -> Said:
    """A step of a construction in words."""
    return called(drawn, index).named


def opinion(judgement: Judgement) -> Said:
    """What matters most: the first wrong step, or that there is none."""
    first = judgement.first
    if first is None:
        return said("No step is wrong.")
    return said("First wrong is {0}: {1}.", named(judgement.drawing.drawn, first.step), remark(judgement, first))


def asked(judgement: Judgement) -> list[Said]:
    """What the first wrong step asks for, in its own words; nothing where there is none."""
    drawn, first = judgement.drawing.drawn, judgement.first
    if first is None:
        return []
    return [arranged("{0:capital}: {1}", named(drawn, first.step), drawn.sentence(first.step))]


def complaint(judgement: Judgement, verdict: Verdict) -> Said:
    """What is wrong with a step: where, what was probably done, how far off it is, and how far it may be."""
    return arranged("{0:capital}: {1}", named(judgement.drawing.drawn, verdict.step), remark(judgement, verdict))


def remark(judgement: Judgement, verdict: Verdict) -> Said:
    """The same without the step's own number; a slip of an earlier step that is not to be seen is told with its own,
    and a line that is not to be seen is nowhere."""
    if verdict.mistake is not None and not math.isfinite(verdict.off):
        return verdict.mistake
    sizes = said("{0} mm off, {1} mm allowed", *(digits(size, FIGURES) for size in (verdict.off, verdict.tolerance)))
    if verdict.mistake is None:
        return sizes
    guilty = blamed(verdict)
    if guilty is None:
        return joined((verdict.mistake, sizes))
    return joined((sizes, said("probably {0}: {1}", named(judgement.drawing.drawn, guilty), verdict.mistake)))


def blamed(verdict: Verdict) -> int | None:
    """The earlier step that is probably to blame for a wrong one; None where it is its own slip."""
    return None if verdict.guilty == verdict.step else verdict.guilty


def lacking(judgement: Judgement, state: str = MISSING) -> str:
    """The numbers of the steps of a state, as `3, 7-9`."""
    drawn = judgement.drawing.drawn
    numbers = [drawn.number(verdict.step) for verdict in judged(judgement) if verdict.state == state]
    parts: list[list[int]] = []
    for number in numbers:
        if parts and parts[-1][-1] == number - 1:
            parts[-1].append(number)
        else:
            parts.append([number])
    return ", ".join(str(part[0]) if len(part) == 1 else f"{part[0]}–{part[-1]}" for part in parts)


def quantity(verdict: NumberVerdict) -> Said:
    """What a number of the table is, such as velocity A."""
    number = verdict.number
    return joined((WORDS.get(number.kind, number.kind), number.of), " ")


def miss(verdict: NumberVerdict) -> Said:
    """What is wrong with a number: by how much, in the scene's units, and what was probably done."""
    sizes = digits(verdict.off, FIGURES), digits(verdict.tolerance, FIGURES)
    parts = [quantity(verdict), arranged("{0} {1}", OFF(), sizes[0]), arranged("{0} {1}", ALLOWED(), sizes[1])]
    return said("Wrong result: {0}.", joined(parts if verdict.mistake is None else [*parts, verdict.mistake]))
