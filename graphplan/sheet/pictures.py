"""A construction in pictures: which steps each of them shows, and under it their words.

Pictures follow the stages. One of the `stage` cut shows a stage, or short ones that follow each other on one plan; one
of the `mark` cut goes up to the next mark that gets a letter; one of the `step` cut shows a step. What is too much for
a picture, by its movements or by letters that would stand on each other, is parted where the fewest helping marks are
used on both sides.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, pairwise

from graphplan.kernel.program import Program, Step
from graphplan.kernel.stages import Stage
from graphplan.phrases import Said, arranged, said
from graphplan.sheet.layout.layout import stacked
from graphplan.sheet.lettering.letters import picture
from graphplan.sheet.plates.display import Item, Text
from graphplan.sheet.plates.excerpt import Excerpt, excerpt
from graphplan.sheet.plates.plans import Plans

MARK, STEP, STAGE = CUTS = "mark", "step", "stage"
MOST = {MARK: 12, STEP: 1, STAGE: 14}  # movements in a picture
SHORT = 6  # movements of stages that stand together
PARTED = 2.0  # the price of a further picture, in helping marks that are used in both


@dataclass(frozen=True, eq=False)
class Picture:
    """Some steps of one plan, stage by stage, and whether the first of the stages went on before."""

    plans: Plans
    parts: tuple[tuple[Stage, tuple[Step, ...]], ...]
    later: bool
    room: tuple[float, float]

    @cached_property
    def steps(self) -> list[Step]:
        return [step for _, steps in self.parts for step in steps]

    @cached_property
    def excerpt(self) -> Excerpt:
        """What it shows, from its lower left corner."""
        return excerpt(self.plans, [step.index for step in self.steps], *self.room)

    @cached_property
    def items(self) -> list[Item]:
        """The same with its letters, from back to front."""
        return stacked(map(self.excerpt.inked, picture(self.excerpt)))

    @property
    def heading(self) -> Said:
        """What stands over it."""
        (stage, _), *more = self.parts
        if more:
            return arranged("{0:capital}", self.excerpt.panel.words)
        return said("{0}, continued", stage.title) if self.later else stage.title

    @property
    def crowded(self) -> bool:
        """Whether letters stand on each other."""
        return crowded(self.items)

    def halves(self) -> Iterator[Picture]:
        """The same in two pictures."""
        (stage, steps), *more = self.parts
        if more:
            at = len(self.parts) // 2
            yield Picture(self.plans, self.parts[:at], self.later, self.room)
            yield Picture(self.plans, self.parts[at:], False, self.room)
            return
        most = (len(steps) + 1) // 2 + len(steps) // 6
        for i, run in enumerate(parted(self.plans.drawing.drawn, steps, most)):
            yield Picture(self.plans, ((stage, tuple(run)),), self.later or i > 0, self.room)


def pictures(plans: Plans, cut: str, room: tuple[float, float]) -> list[Picture]:
    """The pictures of a construction, so many mm wide and no higher than that."""
    found = (_by_stages if cut == STAGE else _by_runs)(plans, cut, room)
    return [part for one in found for part in _uncrowded(one)]


def _uncrowded(one: Picture) -> Iterator[Picture]:
    """A picture, or as many as it takes for letters to stand apart."""
    if len(one.steps) > 1 and one.crowded:
        for half in one.halves():
            yield from _uncrowded(half)
    else:
        yield one


def _runs(plans: Plans) -> Iterator[tuple[Stage, list[Step]]]:
    """The stages, each with its steps of one plan."""
    for stage, steps in plans.drawing.drawn.stages:
        run: list[Step] = []
        for step in steps:
            if run and plans.plan_of_step[step.index] != plans.plan_of_step[run[-1].index]:
                yield stage, run
                run = []
            run.append(step)
        yield stage, run


def _by_runs(plans: Plans, cut: str, room: tuple[float, float]) -> Iterator[Picture]:
    """A picture for each step, or up to each mark with a letter; with the beginning of a plan what is drawn next."""
    begun = list[tuple[Stage, tuple[Step, ...]]]()
    for stage, steps in _runs(plans):
        group, later = list[Step](), False
        for step in steps:
            group.append(step)
            if cut == MARK and len(steps) == 1 and step.op.free:
                begun.append((stage, (step,)))
            elif cut == STEP or step.name or len(group) == MOST[cut] or step is steps[-1]:
                yield Picture(plans, (*begun, (stage, tuple(group))), later, room)
                begun, group, later = [], [], True


def _by_stages(plans: Plans, cut: str, room: tuple[float, float]) -> Iterator[Picture]:
    """A picture for each stage, or for short ones that follow each other."""
    short: list[tuple[Stage, tuple[Step, ...]]] = []

    def together() -> Iterator[Picture]:
        if short:
            yield Picture(plans, tuple(short), False, room)
            short.clear()

    for stage, steps in _runs(plans):
        count, home = sum(len(run) for _, run in short), plans.plan_of_step[steps[0].index]
        if count + len(steps) > SHORT or (short and plans.plan_of_step[short[-1][1][0].index] != home):
            yield from together()
        if len(steps) > SHORT:
            for i, run in enumerate(parted(plans.drawing.drawn, steps, MOST[cut])):
                yield Picture(plans, ((stage, tuple(run)),), i > 0, room)
        else:
            short.append((stage, tuple(steps)))
    yield from together()


def parted(program: Program, steps: Sequence[Step], most: int) -> list[Sequence[Step]]:
    """Steps that follow each other in runs of at most so many, cut where the fewest marks are used on both sides."""
    last = {arg: step.index for step in steps for arg in step.args}
    alive = [sum(last.get(step.index, -1) >= at.index for step in steps if step.index < at.index) for at in steps]
    cost, came = [0.0], [0]
    for end in range(1, len(steps) + 1):
        price = alive[end] + PARTED if end < len(steps) else 0.0
        came.append(min(range(max(0, end - most), end), key=lambda start: (cost[start], -start)))
        cost.append(cost[came[end]] + price)
    ends = [len(steps)]
    while came[ends[-1]]:
        ends.append(came[ends[-1]])
    ends = [0, *reversed(ends)]
    return [steps[a:b] for a, b in pairwise(ends)]


def crowded(items: Iterable[Item]) -> bool:
    """Whether letters stand on each other."""
    boxes = [item.box for item in items if isinstance(item, Text)]
    return any(one.meets(other) for one, other in combinations(boxes, 2))
