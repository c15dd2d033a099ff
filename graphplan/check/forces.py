"""Forces: what the solver says of them between proven bounds, and a construction's beside that. For loads alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphplan.check.arithmetics import Bounds, independent_facts
from graphplan.check.compared import Results, plain
from graphplan.mechanism.elimination import transpose
from graphplan.mechanism.model import FRAME, Contact, Force, Gear, Number, Pair, Scene, Slide
from graphplan.mechanism.pairs.pair import Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.plane import dot
from graphplan.mechanism.units import metre
from graphplan.methods import kinds
from graphplan.methods.forces.groups import pairs
from graphplan.methods.panels import JointForce
from graphplan.methods.results import balances
from graphplan.solver.equations import Equations, held
from graphplan.solver.friction import (
    Frictional,
    contact_slip,
    delivered,
    efficiency,
    leaning,
    name_in_joint,
    with_friction,
)
from graphplan.solver.higher_pairs import force, held_at, pushes
from graphplan.solver.rates import Rates
from graphplan.solver.statics import Reactions, acting, asked, repeating, resultants
from graphplan.solver.statics import read as read_forces

# ---- the solver between bounds --------------------------------------------------------------------------------------


def bounded_reactions(scene: Scene, motion: Rates, by: Bounds) -> Reactions:
    """The reactions and balances of a scene with loads, from its rates."""
    found = _equilibrium(replace(held(scene), root=by.root), motion, by)
    apart = tuple(pushes(found.equations, found.higher))
    return _equilibrium(found.equations, motion, by, apart) if apart else found


def _equilibrium(equations: Equations, motion: Rates, by: Bounds, more: tuple[Force, ...] = ()) -> Reactions:
    """What holds the links by these facts against their loads and `more`."""
    scene = equations.scene
    right = [-value for value in resultants(equations, (*acting(scene, motion), *more))]
    kept = independent_facts(equations)
    facts = [equations.facts[i] for i in kept]
    scales = [_scale(equations, fact) for fact in facts]
    solve = by.solve(transpose([equations.rows[i] for i in kept], equations.width), scales)
    values = dict(zip(kept, solve(right), strict=True))
    told = (values.get(i, 0) for i in range(len(equations.facts)))
    return read_forces(equations, told, repeating(equations), motion)


def _scale(equations: Equations, fact: Statement) -> float:
    """The size of the force that is one time what holds a fact; a couple counts as it does at the reach."""
    x, y, turn = map(float, held_at(equations, fact))
    return max(math.hypot(x, y), abs(turn) / equations.reach)


def rubbed(smooth: Reactions, rounds: int, by: Bounds) -> Reactions:
    """The reactions and balances after so many rounds of friction from those without."""
    last = smooth
    for _ in range(rounds):
        last = _equilibrium(replace(smooth.equations, facts=tuple(_leaning(last, by))), smooth.rates, by)
    return last


def _leaning(last: Reactions, by: Bounds) -> Iterator[Statement]:
    """What holds the links, each pair's force against its turning or sliding as its last force says."""
    scene, rates = last.equations.scene, last.rates
    omega: dict[str, Any] = rates.omega | {FRAME: by.lift(0)}
    loads = asked(scene)
    journals = {f.at: f.radius * f.coefficient for f in loads.frictions if f.at}
    coefficients = {frozenset(f.links): f.coefficient for f in loads.frictions if f.links}

    def arm(joint: Revolute, link: str, force: Pair) -> Any:
        if joint.at not in journals or name_in_joint(joint.at, link) in loads.resting:
            return 0
        square = by.lift(dot(force, force))
        circle = journals[joint.at] * -_sense(omega[link] - omega[joint.links[0]], by)
        return circle / square.root if circle and _sense(square, by) else 0

    def lean(pair: Slide | Gear | Contact, along: Pair, size: Any) -> Number:
        if isinstance(pair, Gear):
            return pair.tangent * _sense(size, by)
        if pair.name in loads.resting:
            return 0
        slip = (dot(rates.slide_velocity[pair.name], pair.direction) if isinstance(pair, Slide)
                else contact_slip(rates, pair))
        return coefficients.get(frozenset(pair.links), 0) * -_sense(slip, by) * _sense(size, by)

    return leaning(last, arm, lean)


def _sense(number: Any, by: Bounds) -> int:
    """1 or -1; 0 where a number cannot be told from nothing: then a pair stands still, or bears no force."""
    lifted = by.lift(number)
    return 0 if lifted.overlaps(by.lift(0)) else 1 if float(lifted) > 0 else -1


# ---- by the kinds and names of a construction's results -------------------------------------------------------------


def force_truth(scene: Scene, results: Results, found: Reactions,
                rough: Reactions | None = None) -> dict[str, dict[str, Any]]:
    """What the solver says of the forces that a construction gives, with friction among them, and of the power balance.
    """
    arms = {s.name: _arm(s, scene, found) for s in scene.slides if s.name in results.get(kinds.SLIDE_ARM, {})}
    joints = {JointForce(p, link).name: force for (p, link), force in found.joints.items()}
    slides, moments = ({name: both[k] for name, both in found.slides.items()} for k in (0, 1))
    told: dict[str, Any] = {
        kinds.REACTION: joints, kinds.SLIDE_REACTION: slides, kinds.SLIDE_MOMENT: moments, kinds.SLIDE_ARM: arms}
    solved = found.equations.scene
    for kind, pairs_of in ((kinds.GEAR_REACTION, solved.gears), (kinds.CONTACT_REACTION, solved.contacts)):
        told[kind] = {pair.name: force(found.equations, pair, found.higher[pair.name])
                      for pair in pairs_of if pair.name in found.higher}
    named = asked(scene).named_balances
    for way in kinds.BY_PLANS, kinds.BY_LEVER, kinds.RUBBED:
        last = found if way != kinds.RUBBED else rough
        for (name, balance), value in zip(named.items(), last.balances, strict=True) if last else ():
            told.setdefault(kinds.balance_kind(way, balance), {})[name] = value
    return told | powers(found.balances)


def powers(found: Iterable[Any]) -> dict[str, dict[str, Any]]:
    """Balances in their order as readings of the power balance."""
    told: dict[str, dict[str, Any]] = {kinds.POWER: {}, kinds.POWER_MOMENT: {}}
    for number, value in enumerate(found, 1):
        told[kinds.POWER if isinstance(value, tuple) else kinds.POWER_MOMENT][str(number)] = value
    return told


def _arm(slide: Slide, scene: Scene, found: Reactions) -> Any:
    """From a slide's point to where its reaction has no moment, square to it."""
    (x, y), moment = found.slides[slide.name]
    reach = moment * metre(scene.units) / (x * x + y * y)
    return y * reach, -x * reach


@dataclass(frozen=True)
class Forces:
    """The forces that a construction gives, beside the solver's reactions and the power balance.

    `rounds` are those of friction that are drawn; `bounded` says that the results are numbers with bounds.
    """

    scene: Scene
    results: dict[str, dict[str, Any]]
    reactions: Reactions
    power: tuple[Any, ...] = ()
    rounds: int = 0
    exact: bool = False
    bounded: bool = False

    def named(self, values: Iterable[Any]) -> dict[str, Any]:
        """What is said of each balance in the scene's order, by its name."""
        return dict(zip(asked(self.scene).named_balances, values, strict=True))

    @property
    def asked(self) -> list[tuple[str, str, str]]:
        """The pairs whose reactions are found: joint, link, and the link that carries the pin."""
        found = self.results.get(kinds.REACTION, {})
        return [pair for pair in pairs(self.scene) if JointForce(*pair[:2]).name in found]

    @property
    def rubbed(self) -> dict[str, Any]:
        """The balances with friction that are drawn, in the scene's order."""
        return balances(self.scene, self.results, (kinds.RUBBED,))

    @cached_property
    def standing(self) -> Frictional:
        """What the forces with friction come to, when round follows round."""
        return with_friction(self.scene, exact=self.exact)

    @property
    def efficiency(self) -> Any:
        """The instantaneous efficiency of what is drawn: of the balances' powers without friction and with it."""
        if not self.rubbed:
            return None
        smooth, rough = (delivered(replace(self.reactions, balances=tuple(found.values())))
                         for found in (balances(self.scene, self.results), self.rubbed))
        return efficiency(smooth, rough) if self.bounded else efficiency(plain(smooth), plain(rough))
