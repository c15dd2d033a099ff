"""The score of a drawing out of 100: what its steps and numbers earn beside what they would if all were right."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields

from graphplan.accuracy.pencil import decimal, settings
from graphplan.errors import Refused
from graphplan.kernel.passes import needed
from graphplan.marking.judge.verdict import IMPLIED, UNSEEN, UNSURE, Judgement
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, VELOCITY
from graphplan.phrases import Phrase, Said, arranged, joined, phrase, said

POSE, FORCE, RESULTS = "pose", "force", "results"
MOST = 1000.0  # of a weight
LEAST = {"right": 0.001, "numbers": 0.0}  # what is right earns something; other verdicts may cost something
NOTHING = phrase("nothing to judge")
GROUPS: Mapping[str, Phrase] = {
    POSE: phrase("given points"), VELOCITY: phrase("velocity"), ACCELERATION: phrase("acceleration"),
    FORCE: phrase("force"), RESULTS: phrase("results"),
}  # fmt: skip


@dataclass(frozen=True)
class Weights:
    """What a step earns by its verdict, and how many steps a number counts for."""

    right: float = 1.0
    follows: float = 1.0
    missing: float = 0.0
    wrong: float = 0.0
    numbers: float = 2.0

    def of(self, state: str) -> float:
        """What is implied earns as if it were drawn; what cannot be told earns nothing."""
        return 0.0 if state == UNSURE else float(getattr(self, "right" if state == IMPLIED else state))


def weights(text: str) -> Weights:
    """The weights that a text such as `follows=0.5,numbers=3` speaks of; what it leaves out stays as it is by default.
    """
    known = [field.name for field in fields(Weights)]
    told = Weights(**settings("--weights", text, known, "nothing of this name is weighed", _size))
    if told.right < max(told.follows, told.missing, told.wrong):
        raise Refused(f"--weights {text}", "something earns more than what is right", "no weight above that of right")
    return told


def _size(name: str, text: str) -> float:
    """A weight, within bounds in which sums of many stay what they are."""
    size, least = decimal(text), LEAST.get(name, -MOST)
    if not least <= size <= MOST:
        raise Refused(f"--weights {name}={text}", "this is no weight", f"a number from {least:g} to {MOST:g}")
    return size


def percent(earned: float, most: float) -> float:
    """What was earned out of 100."""
    return 100.0 * min(max(earned / most, 0.0), 1.0)


@dataclass(frozen=True)
class Score:
    """What each group of steps, and the numbers, have earned, and of how much; no group of nothing to earn."""

    shares: Mapping[str, tuple[float, float]]

    @property
    def total(self) -> float | None:
        """Out of 100, of everything together; none where there was nothing to judge."""
        return percent(*map(sum, zip(*self.shares.values(), strict=True))) if self.shares else None

    @property
    def told(self) -> Said:
        """In words, group by group."""
        if self.total is None:
            return arranged("{0:capital}.", NOTHING())
        parts = joined(arranged("{0} {1}", GROUPS[group](), f"{share:.0f}") for group, share in self.groups.items())
        return said("Score: {0} of 100 ({1}).", f"{self.total:.0f}", parts)

    @property
    def groups(self) -> dict[str, float]:
        """Out of 100, group by group."""
        return {group: percent(*share) for group, share in self.shares.items()}


def score(judgement: Judgement, weighed: Weights | None = None) -> Score:
    """The score of a drawing; what cannot be seen in it counts neither way."""
    weighed = weighed or Weights()
    earned: dict[str, list[float]] = {group: [] for group in GROUPS}
    most = dict.fromkeys(GROUPS, 0.0)
    for group, state, count in _counted(judgement, weighed):
        earned[group].append(count * weighed.of(state))
        most[group] += count * weighed.right
    return Score({group: (math.fsum(earned[group]), most[group]) for group in GROUPS if most[group]})


def _counted(judgement: Judgement, weighed: Weights) -> Iterator[tuple[str, str, float]]:
    """Group, state and count of everything that is to be judged."""
    groups = served(judgement.drawing)
    for verdict in judgement.judged:
        if verdict.state != UNSEEN:
            yield groups[verdict.step], verdict.state, 1.0
    for number in judgement.numbers:
        yield RESULTS, number.state, weighed.numbers


def served(drawing: Construction) -> list[str]:
    """For every step the group that it belongs to: the first of its kinds of result that it serves, or the pose.

    All that serves neither velocities nor accelerations serves forces, if there are any.
    """
    drawn = drawing.drawn
    groups = [FORCE if drawing.scene.loads else VELOCITY] * len(drawn)
    for group in (ACCELERATION, VELOCITY):
        kinds = (reading for reading in drawing.readings if reading.kind.group == group)
        for index in needed(drawn.steps, {drawn.wanted[place] for reading in kinds for place in reading.marks}):
            groups[index] = group
    return [POSE] * drawn.givens + groups[drawn.givens:]
