"""Ways through a mechanism whose facts run in rings: which there are, and which of them suits the pose.

The planner looks at the graph alone and leaves open where a relative pole or a trial figure is put in. Each choice is a
construction of its own. They are weighed by how much the small errors of the single steps grow in the results: the
construction is drawn with a shaking hand, and the shaking of the results is measured.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from random import Random
from typing import TYPE_CHECKING, Any

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Program
from graphplan.methods.network import Network
from graphplan.methods.planner import Planner
from graphplan.phrases import joined, said

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction

SHAKE = 1e-9  # of a value; small enough for first order, large enough to stand out from rounding
HANDS = 3  # how often the construction is drawn with another shaking
EQUAL = 10.0  # growths within this factor count as equal: then the fewest steps win


def best_way(network: Network, method: str, draw: Callable[[Planner], Construction]) -> tuple[Construction, Planner]:
    """The construction by the best way on at each ring, one ring after the other, and the planner of that way.

    Fails with `Refused`, naming the links, where no way reaches them.
    """
    taken = _way(network, method, (), draw)
    weighed = 0
    ring = 0
    while ring < len(taken.planner.options):
        before, count = taken.choice[:ring], taken.planner.options[ring]
        others = [_way(network, method, (*before, way), draw) for way in range(count) if way != taken.choice[ring]]
        weighed += len(others)
        taken = min([taken, *others], key=_Way.rank(min(way.growth for way in [taken, *others])))
        ring += 1
    if taken.construction is None:
        raise taken.refusal or Refused("the mechanism", "no construction reaches it", "check the drives")
    if weighed:
        taken.construction.notes.append(
            said("rings of links: {0}; errors of the steps grow {1}-fold, the best of {2} ways",
                 joined(taken.construction.ways or [said("travelling facts")]), f"{taken.growth:.2g}", weighed + 1))
    return taken.construction, taken.planner


@dataclass
class _Way:
    """One way through the rings: the choices made, the planner that made them, and what came of it."""

    choice: tuple[int, ...]
    planner: Planner
    construction: Construction | None
    refusal: Refused | None
    growth: float

    @staticmethod
    def rank(least: float) -> Callable[[_Way], tuple[float, int]]:
        """The shortest of those whose errors grow about as little as the least."""

        def key(way: _Way) -> tuple[float, int]:
            steps = len(way.construction.program) if way.construction else 0
            return (0.0 if way.growth <= EQUAL * least else way.growth), steps

        return key


def _way(network: Network, method: str, choice: tuple[int, ...], draw: Callable[[Planner], Construction]) -> _Way:
    """Plan and draw one way; a refusal is kept, since another way may do."""
    planner = Planner(network, method, choice)
    try:
        planner.plan()
    except Refused as refusal:
        full = (*choice, *[0] * (len(planner.options) - len(choice)))
        return _Way(full, planner, None, refusal, math.inf)
    construction = draw(planner)
    full = (*choice, *[0] * (len(planner.options) - len(choice)))
    return _Way(full, planner, construction, None, growth(construction.program) if full else 1.0)


def growth(program: Program) -> float:
    """How much larger the shaking of the wanted marks is than that of each step; infinite where it cannot be drawn."""
    return _shaking(lambda hand: _drawn(program, hand))


def growth_of_rates(construction: Construction) -> float:
    """The same for the velocities and accelerations that are read, each kind beside its largest: the marks may lie far
    from the origin, and the vectors between them be short."""
    def read(kind: str, hand: Random | None) -> list[Any] | None:
        marks = _drawn(construction.program, hand)
        return marks and list(construction.told(marks, Floats()).get(kind, {}).values())

    kinds = {reading.kind for reading in construction.readings} & {"velocity", "acceleration"}
    return max((_shaking(partial(read, kind)) for kind in kinds), default=1.0)


def _shaking(drawn: Callable[[Random | None], list[Any] | None]) -> float:
    """How far shaking hands draw things from where a steady one does, beside the largest of them."""
    steady = drawn(None)
    if steady is None:
        return math.inf
    size = max((abs(number) for value in steady for number in value), default=1.0) or 1.0
    most = 0.0
    for hand in range(HANDS):
        shaken = drawn(Random(hand))
        if shaken is None:
            return math.inf
        gaps = [abs(p - q) for one, two in zip(shaken, steady, strict=True) for p, q in zip(one, two, strict=True)]
        most = max([most, *gaps])
    return most / size / SHAKE


def _drawn(program: Program, hand: Random | None) -> list[Any] | None:
    """The wanted marks, each step drawn with a shaking hand."""
    values: list[Any] = []
    for step in program.steps:
        try:
            value = step.op.rule(Floats(), *[values[arg] for arg in step.args], **step.params)
        except Undrawable:
            return None
        if hand is not None and step.op.name != "given":
            value = tuple(number * (1 + SHAKE * hand.uniform(-1, 1)) for number in value)
        values.append(value)
    return [values[index] for index in program.wanted]
