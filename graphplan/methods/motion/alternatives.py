"""Ways through a mechanism whose facts run in rings: which there are, and which of them suits the pose.

The planner looks at the graph alone and leaves open where a relative pole or a trial figure is put in. Each choice is a
construction of its own. They are weighed by how much the small errors of the single steps grow in the results: the
construction is drawn with a shaking hand, and the shaking of the results is measured.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from random import Random
from typing import TYPE_CHECKING, Any

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.kinds import Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Program
from graphplan.mechanism.model import Scene
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.proportion import MOST_STEPS, TOLERABLE, badness, price
from graphplan.methods.tolerances import FINE_PERTURBATION, FIRST_ORDER, PERTURBATION
from graphplan.phrases import digits, join, said

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction

HANDS = 3  # how often the construction is drawn with another shaking
EQUAL = 10.0  # growths within this factor count as equal: then the fewest steps win
SINGULAR_GROWTH = 1e4  # growth from which on a pose may be a singular one of this way: another is sought
MAX_ALTERNATIVES = 64  # ways that are tried at most
MOST_NUMBERS = 3  # of a mark
MOST_PRICED = 3  # other ways like the best that are drawn with a pencil's slips

Draw = Callable[["Planner"], "Construction"]
Choice = tuple[int, ...]  # at each place of a plan where there are several ways on, which is taken
Made = Callable[[Choice], "_Alternative"]


class NetworkPlans:
    """The plans of a scene by a method, each made once, however often it is drawn."""

    def __init__(self, scene: Scene, method: str):
        self.scene, self.method, self.refused = scene, method, set[Choice]()
        self._planners = dict[Choice, Planner]()

    @cached_property
    def network(self) -> Network:
        """What they go through."""
        return Network(self.scene)

    def planner(self, choice: Choice) -> Planner:
        """The planner that has gone this way, as far as it came."""
        if choice not in self._planners:
            planner = self._planners[choice] = Planner(self.network, self.method, choice)
            try:
                planner.plan()
            except Refused:
                self.refused.add(choice)
        return self._planners[choice]


def alternatives(plans: NetworkPlans, draw: Draw) -> Iterator[tuple[Construction, Planner]]:
    """The constructions by all ways, best first, each with its planner; more are sought as they are asked for.

    First the best way on at each ring, one ring after the other. Where its errors grow out of hand in this pose, all
    other choices are tried, rare ones among them, until one is steady. Fails with `Refused`, naming the links, where no
    way reaches them.
    """
    tried: dict[Choice, _Alternative] = {}

    def alternative(choice: Choice) -> _Alternative:
        if choice not in tried:
            found = _alternative(plans, choice, draw)
            tried[choice] = tried.setdefault(found.choice, found)
        return tried[choice]

    best = _better_drawn(_ring_by_ring(alternative), tried.values())
    if best.growth < SINGULAR_GROWTH:
        yield best.with_count(best.weighed + 1)
    for other in _further_ways(tried, alternative):
        if other is not best and other.growth < SINGULAR_GROWTH:
            yield other.with_count(len({*map(id, tried.values())}))
    found = {id(one): one for one in tried.values()}.values()
    wild = [one for one in found if one.construction and one.growth >= SINGULAR_GROWTH]
    wild.sort(key=_Alternative.rank(min((one.growth for one in wild), default=0.0)))
    yield from (one.with_count(len(found)) for one in wild)
    if all(one.construction is None for one in found):
        # As in other poses: it will say which lines do not meet here.
        planner = Planner(plans.network, plans.method, general=True)
        planner.plan()
        yield draw(planner), planner


def _ring_by_ring(way: Made) -> _Alternative:
    """The best way on at each ring, one ring after the other; rare choices are left alone."""
    taken, ring = way(()), 0
    while ring < len(options := taken.planner.options):
        if not options[ring].rare:
            others = [way((*taken.choice[:ring], other)) for other in range(options[ring].ways)
                      if other != taken.choice[ring]]
            weighed = taken.weighed + len(others)
            taken = min([taken, *others], key=_Alternative.rank(min(one.growth for one in [taken, *others])))
            taken.weighed = weighed
        ring += 1
    return taken


def _better_drawn(best: _Alternative, tried: Collection[_Alternative]) -> _Alternative:
    """The best way or, where a pencil's slips would spoil its results, that of those tried whose errors grow about as
    little of which a sheet has better results on plans that are less wide."""
    others = {id(like): like for like in tried
              if like is not best and like.construction and like.growth <= EQUAL * best.growth < math.inf}
    if (not others or best.construction is None or len(best.construction.program) > MOST_STEPS
            or badness(best.construction) < TOLERABLE):
        return best
    likely = [best, *sorted(others.values(), key=lambda like: like.growth)[:MOST_PRICED]]
    better = min(likely, key=lambda like: price(like.construction) if like.construction else math.inf)
    better.weighed = max(best.weighed, better.weighed)
    return better


def _further_ways(tried: dict[Choice, _Alternative], way: Made) -> Iterator[_Alternative]:
    """Further ways, each that was drawn giving the next one like it in turn; those that were refused come last."""
    known = {id(one): one for one in tried.values()}
    waiting = deque(_neighbours(one) for one in sorted(known.values(), key=lambda one: one.construction is None))
    while waiting and len(known) < MAX_ALTERNATIVES:
        choices = waiting.popleft()
        choice = next((choice for choice in choices if choice not in tried), None)
        if choice is None:
            continue
        waiting.append(choices)
        found = way(choice)
        if id(found) not in known:
            known[id(found)] = found
            (waiting.appendleft if found.construction else waiting.append)(_neighbours(found))
            yield found


def _neighbours(way: _Alternative) -> Iterator[Choice]:
    """The choices that differ from a way's at one place: the next at each place, the last place first, and so on."""
    options = way.planner.options
    for step in range(1, max((option.ways for option in options), default=0)):
        for place in reversed(range(len(options))):
            if step < options[place].ways:
                yield (*way.choice[:place], (way.choice[place] + step) % options[place].ways)


@dataclass
class _Alternative:
    """One way through the rings: the choices made, the planner that made them, and what came of it."""

    choice: Choice
    planner: Planner
    construction: Construction | None
    growth: float
    weighed: int = 0

    def with_count(self, tried: int) -> tuple[Construction, Planner]:
        """The construction, which says how many ways it was weighed against, and its planner."""
        assert self.construction is not None
        among = max(self.weighed + 1, tried)
        if among > 1:
            self.construction.notes.append(
                said("rings of links: {0}; errors of the steps grow {1}-fold, the best of {2} ways",
                     join(self.construction.ways or [said("joint by joint")]), digits(self.growth, 2), among))
        return self.construction, self.planner

    @staticmethod
    def rank(least: float) -> Callable[[_Alternative], tuple[float, ...]]:
        """The shortest of those whose errors grow about as little as the least; of as short ones the steadiest."""

        def key(way: _Alternative) -> tuple[float, ...]:
            steps = len(way.construction.program) if way.construction else math.inf
            return (0.0 if way.growth <= EQUAL * least else way.growth), steps, way.growth

        return key


def _alternative(plans: NetworkPlans, choice: Choice, draw: Draw) -> _Alternative:
    """Plan and draw one way; where it is refused another may do."""
    planner = plans.planner(choice)
    if choice in plans.refused:
        full = (*choice, *[0] * (len(planner.options) - len(choice)))
        return _Alternative(full, planner, None, math.inf)
    construction = draw(planner)
    if not construction.planned:
        planner.options.clear()  # whatever is chosen, the same is drawn
    full = (*choice, *[0] * (len(planner.options) - len(choice)))
    return _Alternative(full, planner, construction, growth(construction.program) if full else 1.0)


def growth(program: Program) -> float:
    """How much larger the shaking of the wanted marks is than that of each step, by hands that shake a little, or where
    that is too much to be of first order, as near a singular pose, less; infinite where it cannot be drawn."""
    steady = _draw_shakily(program, None, 0.0)
    if steady is None:
        return math.inf
    size = max((abs(number) for value in steady for number in value), default=1.0) or 1.0
    found = _shaking_by(PERTURBATION, program, steady) / size
    return found if found * PERTURBATION < FIRST_ORDER else _shaking_by(FINE_PERTURBATION, program, steady) / size


def _shaking_by(tremor: float, program: Program, steady: list[Any]) -> float:
    """How far hands that shake so much draw marks from where a steady one does, beside what they shake."""
    most = 0.0
    for hand in range(HANDS):
        shaken = _draw_shakily(program, hand, tremor)
        if shaken is None:
            return math.inf
        gaps = [abs(p - q) for one, two in zip(shaken, steady, strict=True) for p, q in zip(one, two, strict=True)]
        most = max([most, *gaps])
    return most / tremor


def _draw_shakily(program: Program, hand: int | None, tremor: float) -> list[Any] | None:
    """The wanted marks, each step drawn with one of the shaking hands, or with a steady one."""
    values, floats = list[Any](), Floats()
    shaking = None if hand is None else iter(_shaking_of(hand, 1 << (MOST_NUMBERS * len(program)).bit_length()))
    for step in program.steps:
        try:
            value = step.op.rule(floats, *[values[arg] for arg in step.args], **step.params)
        except Undrawable:
            return None
        if shaking is not None and step.op.movement is not Movement.GIVEN:
            value = tuple([number * (1 + tremor * off) for number, off in zip(value, shaking, strict=False)])
        values.append(value)
    return [values[index] for index in program.wanted]


@lru_cache(maxsize=64)  # programs by the dozen are drawn with the same few hands
def _shaking_of(hand: int, count: int) -> tuple[float, ...]:
    """How a hand shakes as it draws so many numbers, from -1 to 1."""
    dice = Random(hand)
    return tuple([dice.uniform(-1, 1) for _ in range(count)])
