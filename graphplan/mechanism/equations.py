"""Equations: which freedoms of links and joints a mechanism has, and what binds them.

Made from what the pairs state. Each moving link has three freedoms (the velocity of its point at the origin, and its
turning), each revolute joint of moving links two, so that a joint of many links favours none of them. Where a
coefficient needs coordinates, chance gives them: what holds for points in general position is what the graph says.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import cached_property
from random import Random
from typing import Any, NamedTuple

from graphplan.mechanism.model import FRAME, Balance, Scene
from graphplan.mechanism.pairs.drives import DrivenPoint
from graphplan.mechanism.pairs.pair import Condition, KinematicPair, Statement
from graphplan.mechanism.pairs.revolute import Revolute

PRIME = 2**61 - 1
"""Coefficients are residues of this prime: exact, of one size, and a chance zero all but impossible."""

PIN = ""
"""The pin of a joint, apart from all its links."""

Thing = tuple[str, str]
"""What moves: ("link", its name) or ("joint", its point)."""

Unknown = tuple[Thing, str]
"""A freedom of a thing: along x, along y, or its turning."""

WAYS = ("x", "y", "turn")


class Equation(NamedTuple):
    """One condition on the freedoms: its terms, whole numbers that stand for residues or decimals of a pose, and the
    statement that it is."""

    terms: dict[Unknown, Any]
    fact: Statement

    @property
    def condition(self) -> Condition:
        """The condition by its name."""
        return self.fact.condition

    @property
    def links(self) -> tuple[str, ...]:
        """The links that it binds."""
        return tuple(link for link in (self.fact.link, self.fact.on) if link not in (FRAME, PIN))


@dataclass(frozen=True)
class System:
    """All freedoms of a scene's moving links and all equations, the scene's redundant conditions left out.

    With `balanced`, each balance stands in the place of a drive: it holds the motion on which it does work. Without
    `axes` points and guides are in general position; with them the scene is taken in its pose, and a link's joints are
    held along the link's axis (x) and across it (y).
    """

    scene: Scene
    balanced: bool = False
    axes: Mapping[str, tuple[Decimal, Decimal]] | None = None

    @cached_property
    def posed(self) -> Scene:
        """The scene in the numbers of the coefficients."""
        if self.axes is not None:
            return self.scene
        chance = Random(1939)

        def any_way(_: object = None) -> tuple[int, int]:
            return chance.randrange(1, PRIME), chance.randrange(1, PRIME)

        return self.scene.posed({point: any_way() for point in self.scene.points}, any_way)

    @cached_property
    def known(self) -> frozenset[str]:
        """The points whose motion is given beforehand: those of the frame, and the given motions."""
        return frozenset(self.scene.links.get(FRAME, ())) | frozenset(self.scene.motions)

    @cached_property
    def unknowns(self) -> tuple[Unknown, ...]:
        """All freedoms, in the scene's order."""
        links = [(("link", k), way) for k in self.scene.moving for way in WAYS]
        joints = [(("joint", p), way) for p in self.scene.joints if p not in self.known for way in ("x", "y")]
        return tuple(links + joints)

    @cached_property
    def equations(self) -> tuple[Equation, ...]:
        """All equations: of the pairs, of the drives or the balances."""
        loads, scene = self.posed.loads, self.posed
        held = (loads.balances if loads else ()) if self.balanced else scene.drives
        return (*self.pairs, *self._stated(held))

    @cached_property
    def pairs(self) -> tuple[Equation, ...]:
        """The equations of the pairs that drive nothing, and of the points whose motion is given: link by link."""
        scene, dropped = self.posed, frozenset(self.scene.redundant)
        points = [pair for pair in scene.pairs if isinstance(pair, DrivenPoint) and pair.at not in scene.joints]
        pins = self._stated([*map(self._pinned, scene.revolutes), *points])
        others = self._stated(pair for pair in scene.binding if not isinstance(pair, Revolute))
        place = {(link, point): i for i, (link, point) in enumerate(
            (link, point) for link in scene.moving for point in scene.links[link])}
        linked = sorted(pins, key=lambda equation: place[equation.fact.link, equation.fact.at])
        return tuple(equation for equation in (*linked, *others) if equation.condition not in dropped)

    def _pinned(self, joint: Revolute) -> Revolute:
        """A joint with a pin of its own, or where its motion is given one of the frame."""
        links = [link for link in joint.links if link != FRAME]
        pin = FRAME if joint.at in self.known else PIN
        return replace(joint, pinned=(pin, *links), axes=self.axes or {})

    def _stated(self, pairs: Iterable[KinematicPair | Balance]) -> Iterator[Equation]:
        """What these pairs state, as equations."""
        free = frozenset(self.unknowns)
        for pair in pairs:
            for fact in pair.states(self.posed):
                terms: dict[Unknown, Any] = {}
                weights = fact.weights(self.posed.points[fact.at] if fact.at else (0, 0))
                for body, sign in ((fact.link, 1), (fact.on, -1)):
                    thing = ("link", body) if body != PIN else ("joint", fact.at)
                    terms |= {(thing, way): sign * weight for way, weight in zip(WAYS, weights, strict=True)
                              if weight and (thing, way) in free}
                yield Equation(terms, fact)
