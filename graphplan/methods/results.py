"""Results by kind and name, as users ask for them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from graphplan.mechanism.model import FRAME, Scene
from graphplan.methods import kinds
from graphplan.methods.panels import pole_named, reactions_named


class Vectors(dict[str, Any]):
    """Vectors by the points that they are asked of; those of the `fixed` points, which nobody needs to ask, are zero.
    """

    def __init__(self, asked: dict[str, Any], fixed: Collection[str], zero: Any):
        super().__init__(asked)
        self.fixed, self.zero = frozenset(fixed), zero

    def __missing__(self, name: str) -> Any:
        if name in self.fixed:
            return self.zero
        raise KeyError(name)


class NamedResults(ABC):
    """Results of one pose or of many, all in scene units: complex numbers or arrays of them for vectors."""

    scene: Scene

    @abstractmethod
    def named(self, kind: str) -> dict[str, Any]:
        """The results of a kind."""

    @abstractmethod
    def zero(self) -> Any:
        """The vector of a fixed point."""

    @property
    def velocity(self) -> Vectors:
        """The velocities of points, of a fixed point 0."""
        return self._vectors(kinds.VELOCITY)

    @property
    def acceleration(self) -> Vectors:
        """The accelerations of points, of a fixed point 0."""
        return self._vectors(kinds.ACCELERATION)

    def _vectors(self, kind: str) -> Vectors:
        return Vectors(self.named(kind), self.scene.links.get(FRAME, ()), self.zero())

    @property
    def curvature(self) -> dict[str, Any]:
        """The centres of curvature of paths, such as that of `M on 2`, where they are not at infinity."""
        return self.named(kinds.CENTRE)

    @property
    def omega(self) -> dict[str, Any]:
        """The angular velocities of links."""
        return self.named(kinds.OMEGA)

    @property
    def alpha(self) -> dict[str, Any]:
        """The angular accelerations of links."""
        return self.named(kinds.ALPHA)

    @property
    def reactions(self) -> dict[str, Any]:
        """The reactions, on links at joints, such as `2 at B`, of slides, gears and contacts; with friction where they
        are drawn with it."""
        return {name: force for kind in kinds.REACTIONS
                for name, force in (self.named(kind) | self.named(kinds.WITH_FRICTION[kind])).items()}

    @property
    def balances(self) -> list[Any]:
        """The balances in the scene's order, with friction where they are drawn with it, by force plans or else by the
        lever: moments in force * m, forces as complex numbers."""
        found, ways = {kind: self.named(kind) for kind in kinds.KINDS}, (kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER)
        return [*balances(self.scene, found, ways).values()]


def thing_named(scene: Scene, kind: kinds.ResultKind, of: str) -> str:
    """What a reading of a kind is of, in words: a slide, a link at a joint, two links, else a point or link by name."""
    return reactions_named(scene)[of] if kind.pair else pole_named(scene, of) if kind.group == kinds.POLES else of


def balances(scene: Scene, results: Mapping[str, Mapping[str, Any]],
             ways: Sequence[str] = (kinds.BY_PLANS, kinds.BY_LEVER)) -> dict[str, Any]:
    """The balances among results, by name in the scene's order: each in the first of these ways that gives it."""
    found: dict[str, Any] = {}
    for name, balance in scene.loads.named_balances.items() if scene.loads else ():
        values = [results[kind][name] for kind in (kinds.balance_kind(way, balance) for way in ways)
                  if name in results.get(kind, {})]
        found |= {name: values[0]} if values else {}
    return found
