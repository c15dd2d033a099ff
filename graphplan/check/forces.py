"""Forces beside the second opinion and the third: the solver's reactions and the power balance. For loads alone."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from graphplan.mechanism.model import Balance, Scene, Slide
from graphplan.mechanism.units import metre
from graphplan.methods import kinds
from graphplan.methods.forces.groups import pairs
from graphplan.methods.panels import JointForce
from graphplan.methods.results import balances
from graphplan.solver.efficiency import efficiency
from graphplan.solver.friction import Frictional, with_friction
from graphplan.solver.rates import Rates
from graphplan.solver.statics import Reactions


@dataclass(frozen=True)
class Held:
    """The forces that a construction gives, by kind and name, what the solver says of them, and the power balance."""

    scene: Scene
    results: dict[str, dict[str, Any]]
    reactions: Reactions
    power: tuple[Any, ...]
    rounds: int = 0  # of friction that are drawn
    exact: bool = False
    rough: Reactions | None = None  # what the solver says of the rounds that are drawn, if not to be found in floats

    @cached_property
    def truth(self) -> dict[str, dict[str, Any]]:
        """What the solver says of every force that the construction gives, by the same kinds and names."""
        arms = {s.name: self._arm(s) for s in self.scene.slides if s.name in self.results.get(kinds.SLIDE_ARM, {})}
        joints = {JointForce(p, link).name: force for (p, link), force in self.reactions.joints.items()}
        slides, moments = ({name: both[k] for name, both in self.reactions.slides.items()} for k in (0, 1))
        held, levers = (self._by_kind(self.reactions.balances, way) for way in (kinds.BY_PLANS, kinds.BY_LEVER))
        return {kinds.REACTION: joints, kinds.SLIDE_REACTION: slides, kinds.SLIDE_MOMENT: moments,
                kinds.SLIDE_ARM: arms, **held, **levers, **self._rough}

    def _by_kind(self, values: Iterable[Any], way: str) -> dict[str, dict[str, Any]]:
        """What is said of each balance in the scene's order, by the kind that finds it in this way, and by name."""
        found: dict[str, dict[str, Any]] = {}
        for (name, value), balance in zip(self.named(values).items(), self._balances.values(), strict=True):
            found.setdefault(kinds.balance_kind(way, balance), {})[name] = value
        return found

    def named(self, values: Iterable[Any]) -> dict[str, Any]:
        """What is said of each balance in the scene's order, by its name."""
        return dict(zip(self._balances, values, strict=True))

    @property
    def _balances(self) -> dict[str, Balance]:
        return self.scene.loads.named_balances if self.scene.loads else {}

    @property
    def asked(self) -> list[tuple[str, str, str]]:
        """The pairs whose reactions are found: joint, link, and the link that carries the pin."""
        found = self.results.get(kinds.REACTION, {})
        return [pair for pair in pairs(self.scene) if JointForce(*pair[:2]).name in found]

    @property
    def rubbed(self) -> dict[str, Any]:
        """The balances with friction that are drawn, in the scene's order."""
        return balances(self.scene, self.results, (kinds.RUBBED,))

    @property
    def _rough(self) -> dict[str, dict[str, Any]]:
        """The balances with friction after as many rounds as are drawn."""
        if not self.rounds:
            return {}
        rough = self.rough or with_friction(self.scene, self.rounds, self.exact)
        found = self._by_kind(rough.balances, kinds.RUBBED)
        return {kind: named for kind, named in found.items() if kind in self.results}

    def _arm(self, slide: Slide) -> Any:
        """From a slide's point to where its reaction has no moment, square to it."""
        (x, y), moment = self.reactions.slides[slide.name]
        reach = moment * metre(self.scene.units) / (x * x + y * y)
        return y * reach, -x * reach

    @cached_property
    def standing(self) -> Frictional:
        """What the forces with friction come to, when round follows round."""
        return with_friction(self.scene, exact=self.exact)

    @property
    def efficiency(self) -> Any:
        """The instantaneous efficiency of what is drawn: of the balances' powers without friction and with it."""
        if not self.rubbed:
            return None
        with_, without = (self._delivered(way) for way in (kinds.RUBBED, kinds.BY_PLANS))
        return efficiency(without, with_)

    def _delivered(self, way: str) -> Any:
        """The power that the balances of the construction give, found in this way, in force * length/s."""
        rates, delivered = self.reactions.rates, Fraction(0)
        for name, balance in self._balances.items():
            value = self.results[kinds.balance_kind(way, balance)][name]
            if balance.at:
                velocity = rates.velocity[balance.at]
                delivered += value[0] * velocity[0] + value[1] * velocity[1]
            else:
                delivered += value * metre(self.scene.units) * rates.omega[balance.link]
        return delivered


def force_truth(scene: Scene, results: dict[str, dict[str, Any]], found: Reactions,
                rough: Reactions | None = None) -> dict[str, dict[str, Any]]:
    """What the solver says of the forces that a construction gives, with friction among them, and of the power balance.
    """
    return Held(scene, results, found, (), rounds=rough is not None, rough=rough).truth | powers(found.balances)


def powers(balances: tuple[Any, ...]) -> dict[str, dict[str, Any]]:
    """Balances in their order as readings of the power balance."""
    found: dict[str, dict[str, Any]] = {kinds.POWER: {}, kinds.POWER_MOMENT: {}}
    for number, value in enumerate(balances, 1):
        found[kinds.POWER if isinstance(value, tuple) else kinds.POWER_MOMENT][str(number)] = value
    return found


def plain_reactions(found: Reactions, rates: Rates, plain: Callable[[Any], Any]) -> Reactions:
    """The reactions in plain numbers, with rates in such."""
    def simple(value: Any) -> Any:
        return tuple(map(simple, value)) if isinstance(value, tuple) else plain(value)

    joints = {pair: simple(force) for pair, force in found.joints.items()}
    slides = {slide: simple(both) for slide, both in found.slides.items()}
    return replace(found, joints=joints, slides=slides, balances=simple(found.balances), rates=rates)
