"""Alternatives: the ways through a network and the lengths of its vectors, and which a pencil draws best.

The prescribed velocities say little where a mechanism multiplies them or makes them small. A drawn velocity longer than
its link takes v²/r off the link, and the semicircle off the paper; of one that is short beside the mechanism a pencil's
slips are a large part, and v²/r is next to nothing.

The planner looks at the graph alone and leaves open where a relative pole or a trial figure is put in. Each choice is a
construction of its own. They are weighed by how much the small errors of the single steps grow in the results: the
construction is drawn with a shaking hand, and the shaking of the results is measured.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from random import Random
from typing import Any, NamedTuple

from graphplan.errors import ConstructionError, Refused, Undrawable
from graphplan.kernel.kinds import LINE, OPENING, POINT, Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Panel, Program, Step
from graphplan.mechanism.model import Number, Scene
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, OMEGA, VELOCITY
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.time_scale import LONGEST, SHORTEST, Tempo, round_down, round_length
from graphplan.methods.panels import MECHANISM
from graphplan.methods.tolerances import EXTENT_TOL, FINE_PERTURBATION, FIRST_ORDER, PERTURBATION
from graphplan.phrases import digits, join, said

SLIP_SHARE = 0.1 / 120  # of the width of a plan: a tenth of a millimetre on a usual panel
TRIAL_SLIPS = 0.01  # slips by which it is drawn off
HANDS_TRIED = 4  # how often it is drawn
MAX_AUXILIARY_RATIO = 2.05  # times as wide a plan may be for auxiliary marks
POOR_SHARE = 0.1  # of a result: it is good or bad as it is drawn better or worse
DOUBLING_PRICE, MAX_DOUBLINGS = 0.1, 3.0  # as bad is a plan that is twice as wide as it may be; so often at most
STEP_PRICE = 0.0005  # as bad is each step


def badness(drawing: Construction) -> float:
    """How bad the results are on the average, from 0 for exact ones to 1 for those that are off by all of themselves
    or that no pencil draws; one that is off by a tenth of itself counts one half."""
    try:
        slips, steady = _slips_of_plans(drawing), _results(drawing, drawing.values)
        hands = [_results(drawing, _draw_with_slips(drawing, slips, Random(seed))) for seed in range(HANDS_TRIED)]
    except (ConstructionError, Undrawable, ZeroDivisionError):
        return 1.0
    largest = dict[str, float]()
    for (kind, _), value in steady.items():
        largest[kind] = max(abs(value), largest.get(kind, 0.0))
    scale = TRIAL_SLIPS * math.sqrt(HANDS_TRIED)
    errors = [math.hypot(*(abs(hand[name] - value) for hand in hands)) / scale / abs(value)
              for name, value in steady.items() if abs(value) > EXTENT_TOL * largest[name[0]]]
    return sum(error / (error + POOR_SHARE) for error in errors) / max(1, len(errors))


def price(drawing: Construction) -> float:
    """What speaks against a construction: bad results, plans that auxiliary marks make so wide that they are drawn
    small or cut off, and steps."""
    bad = badness(drawing)
    plans = _marks_of_plans(drawing) if bad < 1.0 else {}
    ratios = (_width([*core, *further], ()) / _width(core, ()) for core, further in plans.values()
              if core and _width(core, ()))
    doublings = sum(min(MAX_DOUBLINGS, max(0.0, math.log2(ratio / MAX_AUXILIARY_RATIO))) for ratio in ratios)
    return bad + DOUBLING_PRICE * doublings + STEP_PRICE * len(drawing.drawn)


def _slips_of_plans(drawing: Construction) -> dict[Panel, float]:
    """How far a slip is off on each plan, in its lengths: on a plan as wide as its vectors and, on that of the
    mechanism, its points; and as its other marks, where they do not make it too much wider."""
    return {panel: TRIAL_SLIPS * SLIP_SHARE * _width(*marks) for panel, marks in _marks_of_plans(drawing).items()}


def _marks_of_plans(drawing: Construction) -> dict[Panel, tuple[list[Any], list[Any]]]:
    """The ends of each plan's vectors with the points of the pose, and its other marks."""
    program, values, plans = drawing.drawn, drawing.values, dict[Panel, tuple[list[Any], list[Any]]]()
    for vector in drawing.arrows:
        plans.setdefault(vector.panel, ([], []))[0].extend((values[vector.start], values[vector.end]))
    for step in program.steps:
        if step.op.gives == POINT:
            plans.setdefault(step.panel, ([], []))[step.index >= program.givens].append(values[step.index])
    return plans


def _width(core: Sequence[Any], others: Sequence[Any]) -> float:
    """The larger side of the box of some points, and of the others that do not make it too wide for them."""
    points = core or others
    low, high = ([choose(float(point[axis]) for point in points) for axis in (0, 1)] for choose in (min, max))
    most = MAX_AUXILIARY_RATIO * max(high[0] - low[0], high[1] - low[1])
    for point in others:
        least, greatest = ([choose(side[axis], float(point[axis])) for axis in (0, 1)]
                           for side, choose in ((low, min), (high, max)))
        if max(greatest[0] - least[0], greatest[1] - least[1]) <= most:
            low, high = least, greatest
    return max(high[0] - low[0], high[1] - low[1])


def _draw_with_slips(drawing: Construction, slips: Mapping[Panel, float], hand: Random) -> list[Any]:
    """The drawn marks, each with a slip of the hand; points of the pose that coincide are one."""
    marks, holes = list[Any](), dict[Any, Any]()
    for step in drawing.drawn.steps:
        exact = step.op.rule(Floats(), *[marks[arg] for arg in step.args], **step.params)
        slip = slips.get(step.panel, 0.0) if step.op.movement is not Movement.BEGUN else 0.0
        mark = _with_slip(step, exact, slip, hand)
        marks.append(holes.setdefault(exact, mark) if step.index < drawing.drawn.givens else mark)
    return marks


def _with_slip(step: Step, exact: Any, slip: float, hand: Random) -> Any:
    """A mark that is off by a slip of some size."""
    x, y = hand.gauss(0, slip), hand.gauss(0, slip)
    if step.op.gives == LINE:
        a, b, c = exact
        return a, b, c + math.hypot(a, b) * x
    if step.op.gives == OPENING:
        return ((math.sqrt(exact[0]) + x) ** 2,)
    return exact[0] + x, exact[1] + y, *exact[2:]


def _results(drawing: Construction, marks: Any) -> dict[tuple[str, str], complex]:
    """What is read from drawn marks, by kind and name, but for what is given; vectors as complex numbers."""
    wanted = [marks[index] for index in drawing.drawn.wanted]
    read = {(reading.kind, reading.of): drawing.value(reading, [wanted[k] for k in reading.marks], Floats())
            for reading in drawing.readings if reading.marks}
    return {name: complex(*value) if isinstance(value, tuple) else complex(value) for name, value in read.items()}


class Sizes(NamedTuple):
    """How large rates are drawn: the longest velocity and acceleration beside the mechanism's extent, the longest
    relative velocity beside its arm."""

    velocity: float
    acceleration: float
    turning: float

    def are_within(self, limits: Sizes, times: float = 1.0) -> bool:
        """Whether they are no larger than some limits where velocities are so many times as long."""
        return (times * self.velocity <= limits.velocity and times * self.turning <= limits.turning
                and (times**2 * self.acceleration <= limits.acceleration or not self.velocity))


MAX_VELOCITY = 0.8  # of the mechanism's extent: how long the largest velocity may be drawn
MAX_TURNING = 1.5  # times as long as its arm a relative velocity may be drawn, where its square over that is drawn
MAX_TURNING_OF_CRANK = 3.0  # the same where the crank's velocity ends in its pivot, as books draw it
MAX_ACCELERATION, GOOD_ACCELERATION = 10.0, 8.0  # times the extent the largest may be drawn, and is if made shorter
GOOD_TURNING = 1.2  # the same where it is chosen: the less, the smaller accelerations are beside the mechanism
GOOD_VELOCITY, MIN_GAIN = 0.4, 1.6  # of the extent the largest where velocities are made longer, if by so much at least
MAX_LOAD, GOOD_LOAD = 1.5, 0.5  # of the extent: how long the largest load may be drawn, and is if made shorter
OTHER_TEMPOS = 0.5, 2.0, 4.0, 8.0, 16.0  # times as long velocities are tried where results are spoilt
MOST_STEPS = 500  # of a construction whose tempo is tried: no sheet shows more
TOLERABLE = 0.35  # the badness of results from which on others are tried
MIN_STEADYING, MIN_STEADYING_OF_CRANK = 0.75, 0.45  # times as bad as before, at most; where velocities end in pivots
MAX_STEADIER = Sizes(1.2, MAX_ACCELERATION, MAX_TURNING_OF_CRANK)  # as large as rates may be drawn then
LOST = 0.01  # of the extent: what moves less beside its drive is at rest, or nearly so


def _sizes(drawing: Construction) -> Sizes:
    """How large a construction draws rates; fails as that does where it has no numbers."""
    results, kappa, extent = drawing.computed, float(drawing.tempo.kappa), drawing.scene.extent
    longest, largest = (max((abs(complex(*vector)) for vector in results.get(kind, {}).values()), default=0.0)
                        for kind in (VELOCITY, ACCELERATION))
    driven = {drive.link for drive in drawing.scene.drives}
    rates = [abs(rate) for link, rate in results.get(OMEGA, {}).items() if link not in driven]
    turning = kappa * max(rates, default=0.0) if results.get(ACCELERATION) else 0.0
    return Sizes(kappa * longest / extent, kappa**2 * largest / extent, turning)


def better_tempo(drawing: Construction) -> Tempo | None:
    """The tempo at which velocities, or from rest accelerations on the mechanism plan, are in proportion, where they
    are drawn too long or too short and the scene gives no scales."""
    if drawing.scene.sheet.kappa:
        return None
    try:
        sizes = _sizes(drawing)
    except ConstructionError:
        return None
    kappa = float(drawing.tempo.kappa)
    longest, larger, turning = sizes
    most = MAX_TURNING_OF_CRANK if drawing.ends_in_pose else MAX_TURNING
    if not longest and larger and _has_one_plan(drawing) and not SHORTEST <= larger <= MAX_VELOCITY:
        return Tempo(1 / round_down(kappa * math.sqrt(GOOD_VELOCITY / larger)))
    if sizes.are_within(Sizes(MAX_VELOCITY, MAX_ACCELERATION, most)):
        if drawing.ends_in_pose or longest < LOST:
            return None
        longer = min(GOOD_VELOCITY / longest, 1.0 / turning if turning else math.inf,
                     math.sqrt(GOOD_ACCELERATION / larger) if larger else math.inf)
        faster = round_down(kappa * longer)
        return Tempo(1 / faster) if faster >= MIN_GAIN * kappa else None
    lengthwise = LONGEST / longest if longest else 1.0
    slower = math.sqrt(GOOD_ACCELERATION / larger) if larger > MAX_ACCELERATION else 1.0
    slower = max(slower, min(1.0, SHORTEST / longest)) if longest else 1.0
    return Tempo(1 / round_down(kappa * min(lengthwise, GOOD_TURNING / turning if turning else 1.0, slower)))


def steadier_tempo(drawing: Construction, redraw: Callable[[Tempo], Construction]) -> Tempo | None:
    """The tempo at which a pencil's slips spoil the results least, where they spoil them and the scene gives no scales:
    by constructions that are drawn once more, with velocities longer or shorter."""
    try:
        if (drawing.scene.sheet.kappa or not drawing.planned  # a program counts before it is drawn out
                or len(drawing.program) > MOST_STEPS or len(drawing.drawn) > MOST_STEPS
                or (spoilt := badness(drawing)) < TOLERABLE):
            return None
        sizes = _sizes(drawing)
    except ConstructionError:
        return None
    kappa = float(drawing.tempo.kappa)
    kappas = {round_down(times * kappa) for times in OTHER_TEMPOS
              if times < 1 or sizes.are_within(MAX_STEADIER, times)}
    tried = {1 / kappa: badness(redraw(Tempo(1 / kappa))) for kappa in sorted(kappas)}
    best = min(tried, key=tried.__getitem__, default=None)
    most = MIN_STEADYING_OF_CRANK if drawing.ends_in_pose else MIN_STEADYING
    return Tempo(best) if best and tried[best] * (1 - spoilt) <= most * spoilt * (1 - tried[best]) else None


def assumed_tempo(drawing: Construction) -> Tempo:
    """Return the tempo at which the velocities of an assumed motion are in proportion: as they are if they are neither
    longer than the mechanism nor short beside it, or if no point moves but for rounding."""
    try:
        velocities = [*drawing.computed.get(VELOCITY, {}).values()]
    except ConstructionError:
        velocities = []
    longest = max((abs(complex(*velocity)) for velocity in velocities), default=0.0) / drawing.scene.extent
    well_drawn = longest <= EXTENT_TOL or SHORTEST <= longest <= MAX_STEADIER.velocity
    return Tempo(Fraction(1) if well_drawn else 1 / round_down(GOOD_VELOCITY / longest))


def better_force_scale(drawing: Construction) -> Number | None:
    """How long a force of one is drawn where loads would be much longer than the mechanism, as inertia forces are near
    a limit position, and the scene gives no scales."""
    if drawing.scene.sheet.phi or not drawing.force_arrows:
        return None
    try:
        spots = [drawing.values[mark][:2] for vector in drawing.arrows
                 if vector.kind == "load" and vector.panel == MECHANISM for mark in (vector.start, vector.end)]
    except ConstructionError:
        return None
    ends = [(float(x), float(y)) for x, y in spots]
    longest = max(map(math.dist, ends[::2], ends[1::2]), default=0.0) / drawing.scene.extent
    return round_length(float(drawing.phi) * GOOD_LOAD / longest, drawing.scene) if longest > MAX_LOAD else None


def _has_one_plan(drawing: Construction) -> bool:
    """Whether accelerations lie on the mechanism plan, at a scale that must be round beside that of velocities."""
    program = drawing.program
    return any(program.steps[program.wanted[reading.marks[-1]]].panel == MECHANISM
               for reading in drawing.readings if reading.kind == ACCELERATION and reading.marks)


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
