"""The score of a drawing out of 100: what was asked for, and the steps towards it, beside what all would earn if right.

The first mistake of each kind costs as many points as the teacher gives it, if the step that it spoils earns fewer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from graphplan.design.hand import decimal, read_settings
from graphplan.errors import Refused
from graphplan.kernel.kinds import POINT
from graphplan.kernel.passes import steps_behind
from graphplan.marking.judge import measures
from graphplan.marking.judge.mistakes import MISTAKES
from graphplan.marking.judge.verdict import FOLLOWS, IMPLIED, RIGHT, UNCLEAR, UNSEEN, WRONG, Judgement, asked_results
from graphplan.marking.judge.whole_plans import EXCHANGED_KIND, EXCHANGED_WORDS, KIND_WORDS, RESCALED_PLAN
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, VELOCITY
from graphplan.phrases import Phrase, Said, arrange, digits, join, phrase, said

POSE, FORCE, RESULTS, METHOD = "pose", "force", "results", "method"
UNJUDGED = phrase("nothing to judge")
GROUPS: Mapping[str, Phrase] = {
    POSE: phrase("given points"), VELOCITY: phrase("velocity"), ACCELERATION: phrase("acceleration"),
    FORCE: phrase("force"), RESULTS: phrase("results"),
}  # fmt: skip
OTHER_KIND, OTHER_RESULT_KIND = "other", "another's number"
KINDS: Mapping[str, Callable[[], Said]] = {**{kind: entry.words for kind, entry in MISTAKES.items()},
                                           EXCHANGED_KIND: EXCHANGED_WORDS, **KIND_WORDS,
                                           OTHER_RESULT_KIND: phrase("the number of another result"),
                                           OTHER_KIND: phrase("another mistake")}
SLIPS = frozenset({"wrong side", "wrong scale", "wrong crossing", "wrong opening", "wrong centre",
                   "exchanged coordinates", EXCHANGED_KIND, RESCALED_PLAN, OTHER_RESULT_KIND, OTHER_KIND})


@dataclass(frozen=True)
class Weights:
    """Points of a step by its verdict, the weight of a result in steps, and the points of 100 that the first mistake of
    each kind costs."""

    right: float = 1.0
    follows: float = 1.0
    missing: float = 0.0
    wrong: float = 0.0
    numbers: float = 2.0
    costs: Mapping[str, float] = field(default_factory=lambda: {
        kind: measures.SLIP_POINTS if kind in SLIPS else measures.MECHANICS_POINTS for kind in KINDS})

    def earned_by(self, state: str) -> float:
        """Points by verdict: an implied step counts as drawn, an unclear one 0."""
        return 0.0 if state == UNCLEAR else float(getattr(self, "right" if state == IMPLIED else state))


WEIGHT_NAMES = "right", "follows", "missing", "wrong", "numbers"


def parse_weights(text: str) -> Weights:
    """The weights that a text such as `follows=0.5,numbers=3,reversed=30` speaks of; what it leaves out stays as it is
    by default."""
    settings = read_settings("--weights", text, [*WEIGHT_NAMES, *KINDS], "unknown name",
                             _parse_weight)
    right, follows, missing, wrong, numbers = (settings.get(name, float(getattr(Weights, name)))
                                               for name in WEIGHT_NAMES)
    costs = {kind: settings.get(kind, cost) for kind, cost in Weights().costs.items()}
    weights = Weights(right, follows, missing, wrong, numbers, costs)
    if weights.right < max(weights.follows, weights.missing, weights.wrong):
        raise Refused(f"--weights {text}", "a weight is greater than that of right", "no weight above that of right")
    return weights


def _parse_weight(name: str, text: str) -> float:
    """A weight, within bounds in which sums of many stay what they are; or the points that a mistake costs."""
    weight, least, most = decimal(text), measures.MIN_WEIGHTS.get(name, -measures.MAX_WEIGHT), measures.MAX_WEIGHT
    if name in KINDS:
        least, most = 0.0, measures.FULL_SCORE
    if not least <= weight <= most:
        raise Refused(f"--weights {name}={text}", "not a weight", f"a number from {least:g} to {most:g}")
    return weight


def share_in_percent(earned: float, most: float) -> float:
    """Share in percent."""
    return measures.FULL_SCORE * min(max(earned / most, 0.0), 1.0)


@dataclass(frozen=True)
class Score:
    """What each group of steps, and the results, have earned, and of how much, no group of nothing to earn; and the
    points of 100 that mistakes cost beside that, by kind. `method` is the same of steps and results, out of 100, where
    what follows rightly from an earlier mistake earns as much as it is weighed, be it true or not. The `given` score
    is the teacher's own, with a `note`."""

    shares: Mapping[str, tuple[float, float]]
    method: float | None = None
    costs: Mapping[str, float] = field(default_factory=dict)
    given: float | None = None
    note: str = ""

    @property
    def total(self) -> float | None:
        """Out of 100: the teacher's own score, or else the judge's."""
        return self.judge_score if self.given is None else self.given

    @property
    def judge_score(self) -> float | None:
        """Score out of 100, of all together; None if there was no step to judge."""
        if not self.shares:
            return None
        return max(share_in_percent(*map(sum, zip(*self.shares.values(), strict=True))) - sum(self.costs.values()), 0.0)

    @property
    def text(self) -> Said:
        """In words: the teacher's own, then the judge's group by group, and what mistakes cost."""
        return join((*self.teacher_lines, self._judged_text), " ")

    @property
    def teacher_lines(self) -> list[Said]:
        """Lines of the teacher's score and note."""
        lines = [] if self.given is None else [said("The teacher's score: {0} of 100.", digits(self.given))]
        return [*lines, said("The teacher's note: {0}", self.note)] if self.note else lines

    @property
    def _judged_text(self) -> Said:
        if self.judge_score is None:
            return arrange("{0:capital}.", UNJUDGED())
        phrases = [arrange("{0} {1}", GROUPS[group](), f"{share:.0f}") for group, share in self.groups.items()]
        phrases += [arrange("{0} −{1}", KINDS[kind](), f"{cost:.0f}") for kind, cost in self.costs.items()]
        return said("Score: {0} of 100 ({1}).", f"{self.judge_score:.0f}", join(phrases))

    @property
    def groups(self) -> dict[str, float]:
        """Out of 100, group by group."""
        return {group: share_in_percent(*share) for group, share in self.shares.items()}

    @property
    def record(self) -> dict[str, float | None]:
        """As data: in all, of the method, and group by group."""
        return {"total": self.total, **({} if self.method is None else {METHOD: self.method}), **self.groups}


def score(judgement: Judgement, weighed: Weights | None = None) -> Score:
    """The score of a drawing; what cannot be seen in it, but was drawn somehow, counts neither way."""
    weighed = weighed or Weights()
    if not judgement.drawing.readings:
        return _score_of_task(judgement, weighed)
    earned: dict[str, list[float]] = {group: [] for group in GROUPS}
    most, method = dict.fromkeys(GROUPS, 0.0), list[float]()
    for group, state, count in _weighed_states(judgement, weighed):
        method.append(count * weighed.earned_by(state))
        earned[group].append(count * weighed.wrong if (group, state) == (RESULTS, FOLLOWS) else method[-1])
        most[group] += count * weighed.right
    whole = sum(most.values())
    return Score({group: (math.fsum(earned[group]), most[group]) for group in GROUPS if most[group]},
                 share_in_percent(math.fsum(method), whole) if whole else None,
                 dict(_mistake_costs(judgement, weighed, whole)))


def _score_of_task(judgement: Judgement, weighed: Weights) -> Score:
    """The score of a drawing of no mechanism: what is missing counts by its share, a mistake once whatever it spoils,
    and no more than a third of all; several, where no mark is right but those that lay the drawing on the sheet, all.
    """
    states = [verdict.state for verdict in judgement.counting_verdicts if verdict.state != UNSEEN]
    points = [verdict for verdict in judgement.verdicts if verdict.trace and verdict.trace.kind == POINT]
    wrong = [verdict.kind or str(verdict.step) for verdict in points if verdict.state == WRONG]
    share = measures.FULL_SCORE / max(1, len(states))
    cost = min(max(share, measures.SLIP_POINTS), measures.MAX_SHARE_POINTS) * len({*wrong})
    if len({*wrong}) > 1 and len(points) - len(wrong) <= 2:
        cost = measures.FULL_SCORE
    earned = sum(weighed.earned_by(RIGHT if state == WRONG else state) for state in states)
    shares = {RESULTS: (earned, len(states) * weighed.right)} if states else {}
    return Score(shares, costs={OTHER_KIND: cost} if cost else {})


def _weighed_states(judgement: Judgement, weighed: Weights) -> Iterator[tuple[str, str, float]]:
    """Group, state and count of everything that is to be judged: of a table alone its numbers are, each as one."""
    groups = groups_of_steps(judgement.drawing)
    for verdict in judgement.counting_verdicts if judgement.has_drawn or not judgement.numbers else ():
        if verdict.state != UNSEEN:
            yield groups[verdict.step], verdict.state, 1.0
    for result in asked_results(judgement):
        yield RESULTS, result.state, weighed.numbers


def _mistake_costs(judgement: Judgement, weighed: Weights, most: float) -> Iterator[tuple[str, float]]:
    """Yield the cost of the first mistake of each kind besides the share of its step, or of its number."""
    wrong = [(verdict.kind or OTHER_KIND, 1.0) for verdict in judgement.counting_verdicts if verdict.state == WRONG]
    wrong += [(number.kind or OTHER_KIND, weighed.numbers) for number in judgement.numbers if number.state == WRONG]
    firsts = dict[str, float]()
    for kind, count in wrong if most else ():
        firsts.setdefault(kind if kind in weighed.costs else OTHER_KIND, count)
    for kind, count in firsts.items():
        beyond = weighed.costs[kind] - measures.FULL_SCORE * count * (weighed.right - weighed.wrong) / most
        if beyond > 0.0:
            yield kind, beyond


def groups_of_steps(drawing: Construction) -> list[str]:
    """For every step the group that it belongs to: the first of its kinds of result that it serves, or the pose.

    All that serves neither velocities nor accelerations serves forces, if there are any.
    """
    program = drawing.drawn
    groups = [FORCE if drawing.scene.loads else VELOCITY] * len(program)
    for group in (ACCELERATION, VELOCITY):
        kinds = (reading for reading in drawing.readings if reading.kind.group == group)
        for index in steps_behind(program.steps,
                                  {program.wanted[place] for reading in kinds for place in reading.marks}):
            groups[index] = group
    return [POSE] * program.givens + groups[program.givens:]
