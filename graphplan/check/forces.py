"""Forces: what the solver says of them between proven bounds, and a construction's against that. For loads alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphplan.check.arithmetics import Bounds, independent_facts
from graphplan.check.compared import Readings, Results, plain_number
from graphplan.mechanism.equations import transpose
from graphplan.mechanism.model import Contact, Force, Gear, Scene, Slide
from graphplan.mechanism.numbers import dot
from graphplan.mechanism.pairs.pair import Statement
from graphplan.mechanism.units import metre
from graphplan.methods import kinds
from graphplan.methods.panels import JointForce
from graphplan.methods.results import balances, pair_forces
from graphplan.solver.friction import (
    Frictional,
    Sense,
    contact_forces,
    delivered_power,
    efficiency,
    leaning_supports,
    rubbing,
    screw_moments,
    with_friction,
)
from graphplan.solver.rates import Equations, Rates, force_equations
from graphplan.solver.statics import Reactions, acting, force, held_at, pushes, repeating, required_loads, resultants
from graphplan.solver.statics import read as read_forces

# ---- the solver between bounds --------------------------------------------------------------------------------------


def bounded_reactions(scene: Scene, motion: Rates, by: Bounds) -> Reactions:
    """The reactions and balances of a scene with loads, from its rates."""
    first = _equilibrium(replace(force_equations(scene), root=by.root), motion, by)
    apart = tuple(pushes(first.equations, first.higher))
    return _equilibrium(first.equations, motion, by, apart) if apart else first


def _equilibrium(equations: Equations, motion: Rates, by: Bounds, more: tuple[Force, ...] = ()) -> Reactions:
    """Solve for the reactions that hold the links by these facts against their loads and `more`."""
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
    """Yield the statements that hold the links, each pair's force opposed to its turning or sliding by the sense of its
    last force."""
    against = rubbing(last.equations.scene, last.rates, lambda rate, _: _sense(rate, by))
    return leaning_supports(last, against, lambda size, along: _sense(size * dot(along, along), by))


def _sense(number: Any, by: Bounds) -> int:
    """Sign of a number, 1 or -1; 0 if its bounds include zero: then a pair stands still, or bears no force."""
    lifted = by.lift(number)
    return 0 if lifted.overlaps(by.lift(0)) else 1 if float(lifted) > 0 else -1


# ---- by the kinds and names of a construction's results -------------------------------------------------------------


def force_truth(scene: Scene, results: Results, smooth: Reactions, rough: Reactions | None = None,
                sense: Sense | None = None) -> Readings:
    """The solver's values of the forces in a construction, with friction among them, and of the power balance.

    `sense` gives the sense of a rate or a force, as `screw_moments` takes it.
    """
    arms = {s.name: _arm(s, scene, smooth) for s in scene.slides if s.name in results.get(kinds.SLIDE_ARM, {})}
    truth = _reactions(smooth, smooth_forces(smooth))
    truth[kinds.SLIDE_ARM] = arms
    if rough is not None:
        truth |= {kinds.WITH_FRICTION[kind]: named for kind, named in _reactions(rough, contact_forces(rough)).items()}
    if required_loads(scene).screws:
        truth[kinds.SCREW] = screw_moments(smooth if rough is None else rough, sense)
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
    """From a slide's point to where its reaction has no moment, perpendicular to it."""
    (x, y), moment = reactions.slides[slide.name]
    reach = moment * metre(scene.units) / (x * x + y * y)
    return y * reach, -x * reach


def undrawn_forces(scene: Scene, results: Results, truth: Results) -> Readings:
    """Forces that are asked for but not among the results of a construction, as the solver finds them, by kind and
    name."""
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
        """Values by the name of each balance, in the scene's order."""
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
        """The forces with friction after all rounds."""
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
