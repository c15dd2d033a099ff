"""Construction and solver compared, number by number, motions and forces.

A number counts relative to the largest of the terms that it is made of, a vector as a whole. Where these terms vanish,
too, it counts relative to what is next to nothing of all that moves, or of what is drawn as large as the mechanism.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from graphplan.check.arithmetics import Bounds, independent_facts
from graphplan.check.tolerances import PROVEN_TOL, PROVEN_ZERO, ROUNDING_TOL
from graphplan.errors import BrokenClaim, Disagreement
from graphplan.kernel.claims import broken_claims
from graphplan.kernel.passes import Values
from graphplan.mechanism.equations import transpose
from graphplan.mechanism.model import Contact, Force, Gear, Scene, Slide
from graphplan.mechanism.numbers import dot
from graphplan.mechanism.pairs.pair import Statement
from graphplan.mechanism.units import metre
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.panels import JointForce
from graphplan.methods.results import balances, pair_forces
from graphplan.solver.friction import (
    Frictional,
    contact_forces,
    delivered_power,
    efficiency,
    leaning_supports,
    rubbing,
    screw_moments,
    with_friction,
)
from graphplan.solver.linear import Bounded
from graphplan.solver.rates import Equations, Rates, force_equations
from graphplan.solver.statics import Reactions, acting, force, held_at, pushes, repeating, required_loads, resultants
from graphplan.solver.statics import read as read_forces
from graphplan.solver.tolerances import MARGIN

Results = Mapping[str, Mapping[str, Any]]
Readings = dict[str, dict[str, Any]]  # the same, as it is put together: values by kind and name
# Of these nothing is proven: they count relative to the largest of their group.
UNBOUNDED = (kinds.SLIDE_ARM, kinds.POWER, kinds.POWER_MOMENT)


class ComparedNumber(NamedTuple):
    """A printed number and the `truth` that the solver says; `gap` is their difference, `bound` how far the number may
    be off, `scale` what both count relative to. `apart` says that the two are proven to differ, `close` that they
    differ by no more than rounding, `near` that they differ by no more than the rounding of what is drawn as large as
    the mechanism: of a far smaller number that may be all digits."""

    value: Any
    truth: Any
    gap: Any
    bound: Any
    scale: Any
    apart: bool = False
    close: bool = True
    near: bool = False

    @property
    def holds(self) -> bool:
        """Whether nine digits are proven, and the difference is rounding."""
        return self.close and bool(self.bound <= PROVEN_TOL * self.scale)

    def relative(self, part: str) -> Any:
        """The gap or the bound relative to the number's size."""
        number = getattr(self, part)
        return number / self.scale if number else 0


Numbers = dict[str, dict[str, tuple[ComparedNumber, ...]]]


def compare(drawing: Construction, ours: Results, theirs: Results,
            floor: Callable[[str, str], float] = lambda kind, name: 0.0) -> Numbers:
    """All readings that the solver knows, with what it says of them; none counts relative to less than its `floor`."""
    largest = scales(drawing, theirs)
    numbers: Numbers = {}
    for kind, named in ours.items():
        if kind in theirs:
            scale = (drawing.scene.extent if kind == kinds.SLIDE_ARM
                     else largest[kinds.kind_of(kind).group] / weight(drawing, kind))
            least = scale if kind in UNBOUNDED else PROVEN_ZERO * scale
            numbers[kind] = {
                name: tuple(_compare_vector(components(ours[kind][name]), components(theirs[kind][name]),
                                            max(least, floor(kind, name),
                                                sliding_size(drawing.scene, theirs, kind, name)), scale))
                for name in named}
    return numbers


def sliding_size(scene: Scene, theirs: Results, part: str, name: str) -> Any:
    """The size of the vectors whose difference a sliding is, whichever way they point; of any other reading nothing."""
    kind = kinds.kind_of(part)
    if not kind.pair or kind.group == kinds.FORCES:
        return 0.0
    at = next(slide.at for slide in scene.slides if slide.name == name)
    sizes = [abs(plain_number(number)) for number in theirs[kind.group][at]]
    return (sizes[0]**2 + sizes[1]**2) ** 0.5


def plain_number(number: Any) -> Any:
    """A number with bounds or sizes as a float, or an array of them; a fraction as it is."""
    if hasattr(number, "middle"):
        return float(number.middle)
    return getattr(number, "value", number)


def scales(drawing: Construction, theirs: Results) -> dict[str, float]:
    """The largest number of each kind, or what is drawn as large as the mechanism if that is larger."""
    largest = drawn_sizes(drawing)
    for kind, named in theirs.items():
        if kind != kinds.SLIDE_ARM:
            sizes = (abs(float(number)) * weight(drawing, kind) for value in named.values()
                     for number in components(value))
            group = kinds.kind_of(kind).group
            largest[group] = max([largest[group], *sizes])
    return largest


def drawn_sizes(drawing: Construction) -> dict[str, float]:
    """The numbers of each kind that are drawn as large as the mechanism."""
    reach, unit = drawing.scene.extent, float(drawing.tempo.unit)
    return {kinds.VELOCITY: reach * unit, kinds.ACCELERATION: reach * unit**2, kinds.POLES: reach, kinds.CURVES: reach,
            kinds.FORCES: reach / float(drawing.phi)}


def weight(drawing: Construction, part: str) -> float:
    """Turnings count with what they make at the mechanism's extent, moments as the force that they are there."""
    return float(kinds.kind_of(part).arm(drawing.scene.extent, drawing.scene.units))


def components(value: Any) -> tuple[Any, ...]:
    """The numbers of a vector, or a number alone."""
    return value if isinstance(value, tuple) else (value,)


def _compare_vector(ours: tuple[Any, ...], theirs: tuple[Any, ...], least: float,
                    scale: float) -> Iterator[ComparedNumber]:
    """The components of a vector relative to the size of the whole."""
    numbers = [_compare_number(*pair, scale) for pair in zip(ours, theirs, strict=True)]
    largest = max([least, *(number.scale for number in numbers)])
    for number in numbers:
        close = number.close or number.gap <= ROUNDING_TOL * largest
        yield number._replace(scale=largest, close=close, near=bool(number.gap <= ROUNDING_TOL * scale))


def _compare_number(ours: Any, theirs: Any, scale: float) -> ComparedNumber:
    """One number, whatever it is made of."""
    if isinstance(theirs, Bounded):
        most = abs(theirs.value) + theirs.error
        if most <= PROVEN_ZERO * scale and abs(ours) <= ROUNDING_TOL * scale:  # proven to be zero, and drawn so
            return ComparedNumber(0.0, 0.0, 0.0, MARGIN * most, theirs.size)
        gap = abs(ours - theirs.value)
        if max(abs(theirs.value), gap) <= theirs.error and abs(ours) <= ROUNDING_TOL * theirs.size:
            gap, ours = abs(theirs.value), 0.0  # no digit of it is known: it may be nothing, and so it is printed
        return ComparedNumber(ours, theirs.value, gap, MARGIN * (gap + theirs.error), max(theirs.size, abs(ours)),
                              close=gap <= theirs.error)
    if isinstance(ours, Fraction | int):
        gap = abs(ours - theirs)
        return ComparedNumber(ours, theirs, gap, gap, max(abs(ours), abs(theirs)), bool(gap), not gap)
    return _compare_enclosures(ours, theirs)


def _compare_enclosures(ours: Any, theirs: Any) -> ComparedNumber:
    """One enclosure against another: the float that is printed of it, and how far that is off."""
    middle, error, truth = ours.middle, ours.error, theirs.middle
    printed = 0.0 if abs(middle) <= error else float(middle)
    bound = upper_float(max(abs(middle - Fraction(printed)), theirs.error) + error)
    magnitude, gap = max(abs(printed), abs(float(truth))), float(abs(middle - truth))
    return ComparedNumber(printed, float(truth), gap, bound, magnitude, apart=not ours.overlaps(theirs))


def upper_float(bound: Fraction) -> float:
    """A bound as a float that is no smaller."""
    return math.nextafter(float(bound), math.inf) if bound else 0.0


def round_fractions(numbers: Numbers) -> Numbers:
    """Fractions as the floats that are printed of them, with what rounding makes them be off."""
    def round_number(number: ComparedNumber) -> ComparedNumber:
        value = float(number.value)
        bound = upper_float(number.gap + abs(number.value - Fraction(value)))
        return ComparedNumber(value, float(number.truth), upper_float(number.gap), bound, float(number.scale),
                              number.apart)

    return {kind: {name: tuple(map(round_number, vector)) for name, vector in named.items()}
            for kind, named in numbers.items()}


def printed_results(results: Results, numbers: Numbers, plain: Callable[[Any], Any]) -> Readings:
    """The results as they are printed: numbers that are compared as they were, others made `plain`."""
    def value(kind: str, name: str, result: Any) -> Any:
        if kind not in numbers:
            return tuple(map(plain, result)) if isinstance(result, tuple) else plain(result)
        values = tuple(number.value for number in numbers[kind][name])
        return values if isinstance(result, tuple) else values[0]

    return {kind: {name: value(kind, name, result) for name, result in named.items()}
            for kind, named in results.items()}


def require_claims(name: str, values: Values) -> None:
    """Fail with `BrokenClaim` where a drawn step breaks one of its claims."""
    if fault := next(broken_claims(values.drawing.program, values.numbers), ""):
        raise BrokenClaim(name, fault)


def require_agreement(name: str, gaps: Mapping[str, float], tolerance: float, one: str = "otherwise",
                      by: str = "by the solver") -> None:
    """Fail with `Disagreement` where independent results differ by more than a tolerance, or cannot be compared."""
    for quantity, gap in gaps.items():
        if not gap <= tolerance:
            raise Disagreement(name, quantity, one, by, gap)


def bounded_reactions(scene: Scene, motion: Rates, by: Bounds) -> Reactions:
    """The reactions and balances of a scene with loads, from its rates."""
    first = _equilibrium(replace(force_equations(scene), root=by.root), motion, by)
    apart = tuple(pushes(first.equations, first.higher))
    return _equilibrium(first.equations, motion, by, apart) if apart else first


def _equilibrium(equations: Equations, motion: Rates, by: Bounds, more: tuple[Force, ...] = ()) -> Reactions:
    """What holds the links by these facts against their loads and `more`."""
    scene = equations.scene
    right = [-value for value in resultants(equations, (*acting(scene, motion), *more))]
    independent = independent_facts(equations)
    facts = [equations.facts[i] for i in independent]
    scales = [_scale(equations, fact) for fact in facts]
    solve = by.solve(transpose([equations.rows[i] for i in independent], equations.width), scales)
    values = dict(zip(independent, solve(right), strict=True))
    holding = (values.get(i, 0) for i in range(len(equations.facts)))
    return read_forces(equations, holding, repeating(equations), motion)


def _scale(equations: Equations, fact: Statement) -> float:
    """The size of the force that is one time what holds a fact; a couple counts as it does at the reach."""
    x, y, turn = map(float, held_at(equations, fact))
    return max(math.hypot(x, y), abs(turn) / equations.reach)


def friction_rounds(smooth: Reactions, rounds: int, by: Bounds) -> Reactions:
    """The reactions and balances after so many rounds of friction from those without."""
    last = smooth
    for _ in range(rounds):
        last = _equilibrium(replace(smooth.equations, facts=tuple(_leaning_facts(last, by))), smooth.rates, by)
    return last


def _leaning_facts(last: Reactions, by: Bounds) -> Iterator[Statement]:
    """What holds the links, each pair's force against its turning or sliding as its last force says."""
    against = rubbing(last.equations.scene, last.rates, lambda rate, _: _sense(rate, by))
    return leaning_supports(last, against, lambda size, along: _sense(size * dot(along, along), by))


def _sense(number: Any, by: Bounds) -> int:
    """1 or -1; 0 where a number cannot be told from nothing: then a pair stands still, or bears no force."""
    lifted = by.lift(number)
    return 0 if lifted.overlaps(by.lift(0)) else 1 if float(lifted) > 0 else -1


def force_truth(scene: Scene, results: Results, smooth: Reactions,
                rough: Reactions | None = None) -> Readings:
    """What the solver says of the forces that a construction gives, with friction among them, and of the power balance.
    """
    arms = {s.name: _arm(s, scene, smooth) for s in scene.slides if s.name in results.get(kinds.SLIDE_ARM, {})}
    truth = _reactions(smooth, smooth_forces(smooth))
    truth[kinds.SLIDE_ARM] = arms
    if rough is not None:
        truth |= {kinds.WITH_FRICTION[kind]: named for kind, named in _reactions(rough, contact_forces(rough)).items()}
    if required_loads(scene).screws:
        truth[kinds.SCREW] = screw_moments(smooth if rough is None else rough)
    named = required_loads(scene).named_balances
    for kind_of_way in kinds.BY_PLANS, kinds.BY_LEVER, kinds.RUBBED:
        last = smooth if kind_of_way != kinds.RUBBED else rough
        for (name, balance), value in zip(named.items(), last.balances, strict=True) if last else ():
            truth.setdefault(kinds.balance_kind(kind_of_way, balance), {})[name] = value
    return truth | powers(smooth.balances)


def smooth_forces(reactions: Reactions) -> dict[str, Any]:
    """The forces in slides, gears and contacts, each on its first link, without friction."""
    scene = reactions.equations.scene
    pairs: list[Gear | Contact] = [*scene.gears, *scene.contacts]
    higher = {pair.name: force(reactions.equations, pair, reactions.higher[pair.name])
              for pair in pairs if pair.name in reactions.higher}
    return {name: sides[0] for name, sides in reactions.slides.items()} | higher


def _reactions(reactions: Reactions, borne: dict[str, Any]) -> Readings:
    """The reactions by kind and name, those of slides, gears and contacts as they are `borne`."""
    scene = reactions.equations.scene
    pairs: dict[str, tuple[Slide | Gear | Contact, ...]] = {
        kinds.SLIDE_REACTION: scene.slides, kinds.GEAR_REACTION: scene.gears, kinds.CONTACT_REACTION: scene.contacts}
    readings = {kind: {pair.name: borne[pair.name] for pair in pairs_of_kind if pair.name in borne}
                for kind, pairs_of_kind in pairs.items()}
    for belt in (gear for gear in scene.gears if gear.name in borne):
        readings[kinds.GEAR_REACTION] |= belt.tensions(borne[belt.name], scene.points)
    return {kinds.REACTION: {JointForce(point, link).name: force for (point, link), force in reactions.joints.items()},
            kinds.SLIDE_MOMENT: {name: moment for name, (_, moment) in reactions.slides.items()}, **readings}


def powers(balances: Iterable[Any]) -> Readings:
    """Balances in their order as readings of the power balance."""
    readings: Readings = {kinds.POWER: {}, kinds.POWER_MOMENT: {}}
    for number, value in enumerate(balances, 1):
        readings[kinds.POWER if isinstance(value, tuple) else kinds.POWER_MOMENT][str(number)] = value
    return readings


def _arm(slide: Slide, scene: Scene, reactions: Reactions) -> Any:
    """From a slide's point to where its reaction has no moment, square to it."""
    (x, y), moment = reactions.slides[slide.name]
    reach = moment * metre(scene.units) / (x * x + y * y)
    return y * reach, -x * reach


def undrawn_forces(scene: Scene, results: Results, truth: Results) -> Readings:
    """What is asked for and not among the results of a construction, as the solver says it, by kind and name."""
    asked_for, missing = scene.find.reactions, Readings()
    pair_of = {force.name: force.pair for force in pair_forces(scene)}
    for kind in (*kinds.WITH_FRICTION, *kinds.WITH_FRICTION.values()):
        for name, value in truth.get(kind, {}).items():
            if (asked_for is None or pair_of.get(name, name) in asked_for) and name not in results.get(kind, {}):
                missing.setdefault(kind, {})[name] = value
    if undrawn := truth.get(kinds.SCREW, {}).keys() - results.get(kinds.SCREW, {}).keys():
        missing[kinds.SCREW] = {name: truth[kinds.SCREW][name] for name in undrawn}
    for kinds_of_way in ((kinds.BY_PLANS, kinds.BY_LEVER), (kinds.RUBBED,)):
        drawn_balances = balances(scene, results, kinds_of_way)
        for name, balance in required_loads(scene).named_balances.items():
            kind = kinds.balance_kind(kinds_of_way[0], balance)
            if name not in drawn_balances and name in truth.get(kind, {}):
                missing.setdefault(kind, {})[name] = truth[kind][name]
    return missing


@dataclass(frozen=True)
class Forces:
    """The forces that a construction gives, against the solver's reactions and the power balance.

    `rough` are the reactions with friction as the solver has them; `locks` says why there are none, where a pair should
    rub. `rounds` are those of friction that are drawn; `bounded` says that the results are numbers with bounds. `alone`
    are the names of results that are not drawn, but the solver's alone.
    """

    scene: Scene
    results: Readings
    reactions: Reactions
    power: tuple[Any, ...] = ()
    rounds: int = 0
    exact: bool = False
    bounded: bool = False
    rough: Reactions | None = None
    locks: str = ""
    alone: tuple[str, ...] = ()

    def by_balance(self, values: Iterable[Any]) -> dict[str, Any]:
        """What is said of each balance in the scene's order, by its name."""
        return dict(zip(required_loads(self.scene).named_balances, values, strict=True))

    @property
    def names(self) -> list[str]:
        """The names of the balances."""
        return [*required_loads(self.scene).named_balances]

    @property
    def has_friction(self) -> bool:
        """Whether results with friction are asked for."""
        return self.rough is not None or bool(self.locks) or self.rounds > 0

    def values(self, rubs: bool) -> dict[str, Any]:
        """The reactions and the balances among the results, with friction or without it, by `labels`."""
        kinds_wanted = {kind: kinds.WITH_FRICTION[kind] if rubs else kind for kind in kinds.WITH_FRICTION}
        kinds_of_balances = (kinds.RUBBED,) if rubs else (kinds.BY_PLANS, kinds.BY_LEVER)
        return labelled_forces({kind: self.results.get(name, {}) for kind, name in kinds_wanted.items()},
                               balances(self.scene, self.results, kinds_of_balances))

    def arm(self, slide: Slide, force: Any, moment: Any) -> Any:
        """From a slide's point along its guide to where a force with a moment about the point acts."""
        (dx, dy), (x, y) = slide.direction, force
        across = dx * y - dy * x
        if not across:
            return None
        reach = moment * metre(self.scene.units) / across
        return dx * reach, dy * reach

    @property
    def friction_balances(self) -> dict[str, Any]:
        """The balances with friction, in the scene's order."""
        return balances(self.scene, self.results, (kinds.RUBBED,))

    @cached_property
    def standing(self) -> Frictional:
        """What the forces with friction come to, when round follows round."""
        return with_friction(self.scene, exact=self.exact)

    @property
    def efficiency(self) -> Any:
        """The instantaneous efficiency of what is drawn: of the balances' powers without friction and with it."""
        if not self.friction_balances:
            return None
        smooth, rough = (delivered_power(replace(self.reactions, balances=tuple(balance_values.values())), rubs)
                         for balance_values, rubs in ((balances(self.scene, self.results), False),
                                                      (self.friction_balances, True)))
        return efficiency(smooth, rough) if self.bounded else efficiency(plain_number(smooth), plain_number(rough))


def labelled_forces(reactions: Results, named: Mapping[str, Any]) -> dict[str, Any]:
    """Reactions by the names of their pairs, and with moments and balances called that in front of their names."""
    labelled = {name: value for kind in kinds.REACTIONS for name, value in reactions[kind].items()}
    labelled |= {f"moment {name}": value for name, value in reactions[kinds.SLIDE_MOMENT].items()}
    return labelled | {f"balance {name}": value for name, value in named.items()}
