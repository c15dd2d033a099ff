"""The links of a scene cut free, in the numbers that `solve` prints: what acts on each, and what power that has.

Nothing is asked of the package but the scene and the printed numbers. Lengths are in mm, forces in N, masses in kg;
moments are in N mm here. In fractions sums vanish exactly; friction of journals and of rolling has floats.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

import graphplan as gp

FRAME, METRE = "frame", 1000
Vector = tuple[Any, Any]
ZERO = (0, 0)


class Action(NamedTuple):
    """A force at a place and a couple, on one link from another; `kind` is load, balance or the sort of a pair."""

    kind: str
    on: str
    of: str
    at: Vector
    force: Vector
    couple: Any = 0
    pair: str = ""


@dataclass(frozen=True)
class FreeBodies:
    """A scene that asks for all motions and reactions, and what is printed of it, here in fractions if it is `exact`.
    """

    scene: gp.Scene
    told: dict[str, Any]
    exact: bool

    def number(self, printed: Any) -> Any:
        return Fraction(printed) if self.exact else float(printed)

    def vector(self, printed: Any) -> Vector:
        x, y = map(self.number, printed)
        return x, y

    @cached_property
    def at(self) -> dict[str, Vector]:
        return {name: self.vector(place) for name, place in self.scene.points.items()}

    # ---- motion ------------------------------------------------------------------------------------------------

    def rate(self, link: str, kind: str = "omega") -> Any:
        return self.number(self.told["links"].get(link, {}).get(kind, 0)) if link != FRAME else 0

    def of_point(self, point: str, kind: str) -> Vector:
        """A point's velocity or acceleration; of a fixed one zero."""
        return self.vector(self.told["points"].get(point, {}).get(kind, ZERO))

    def velocity(self, link: str, at: Vector) -> Vector:
        """The velocity of a place of a link."""
        if link == FRAME:
            return ZERO
        base, turning = self.scene.links[link][0], self.rate(link)
        (x, y), (u, v) = self.at[base], self.of_point(base, "velocity")
        return u - turning * (at[1] - y), v + turning * (at[0] - x)

    def slip(self, action: Action) -> Vector:
        """The velocity of one side of a pair relative to the other, where it acts."""
        (u, v), (w, z) = self.velocity(action.on, action.at), self.velocity(action.of, action.at)
        return u - w, v - z

    # ---- what acts ---------------------------------------------------------------------------------------------

    @cached_property
    def actions(self) -> list[Action]:
        """All actions, with what friction adds to them."""
        given = [*self._loads(), *self._balances(), *self._reactions()]
        return [*given, *self._friction(given)]

    def _loads(self) -> Iterator[Action]:
        loads = self.scene.loads
        for load in loads.forces:
            yield Action("load", load.on, FRAME, self.at[load.at], self.vector(load.value))
        for moment in loads.moments:
            yield Action("load", moment.on, FRAME, ZERO, ZERO, METRE * self.number(moment.value))
        for link, body in loads.masses.items():
            mass, (x, y) = self.number(body.mass), self.of_point(body.centre, "acceleration")
            gx, gy = map(self.number, loads.gravity)
            force = mass * (gx - x / METRE), mass * (gy - y / METRE)
            couple = -METRE * self.number(body.inertia) * self.rate(link, "alpha")
            yield Action("load", link, FRAME, self.at[body.centre], force, couple)

    def _balances(self) -> Iterator[Action]:
        printed = self.told["balance"]
        for entry in printed if isinstance(printed, list) else [printed]:
            if "moment" in entry:
                yield Action("balance", entry["link"], FRAME, ZERO, ZERO, METRE * self.number(entry["moment"]))
            else:
                yield Action("balance", entry["link"], FRAME, self.at[entry["at"]], self.vector(entry["force"]))

    def _reactions(self) -> Iterator[Action]:
        gears = {gear.name: gear for gear in self.scene.gears}
        places = {pair.name: self.at[pair.at] for pair in (*self.scene.slides, *self.scene.contacts)}
        for entry in self.told["reactions"]:
            kind = next(kind for kind in ("at", "slide", "gear", "contact") if kind in entry)
            name, couple = entry[kind], METRE * self.number(entry.get("moment", 0))
            at = self.at[name] if kind == "at" else self._pitch_point(gears[name]) if kind == "gear" else places[name]
            yield Action(kind, entry["on"], entry["from"], at, self.vector(entry["force"]), couple, name)

    def _pitch_point(self, gear: Any) -> Vector:
        return self.vector(gear.pitch_point({name: (Fraction(x), Fraction(y))
                                             for name, (x, y) in self.scene.points.items()}))

    def _friction(self, given: list[Action]) -> Iterator[Action]:
        """The couples of journals and of wheels that roll."""
        radii = {rub.at: float(rub.radius * rub.coefficient) for rub in self.scene.loads.frictions if rub.at}
        arms = {frozenset(rub.links): float(rub.coefficient) for rub in self.scene.loads.frictions if rub.rolling}
        for one in given:
            size = radii.get(one.pair, 0.0) * math.hypot(*one.force) if one.kind == "at" else 0.0
            if one.kind == "contact" and {one.on, one.of} in [*arms]:
                size = arms[frozenset((one.on, one.of))] * self._normal_force(one)
            turning = self.rate(one.on) - self.rate(one.of)
            if size and turning:
                yield one._replace(force=ZERO, couple=-math.copysign(size, turning), kind="friction")

    def _normal_force(self, one: Action) -> float:
        contact = next(pair for pair in self.scene.contacts if pair.name == one.pair)
        ends = [complex(*self.at[end]) for end in contact.centres if end]
        way = ends[1] - ends[0] if len(ends) == 2 else 1j * complex(*map(float, contact.direction))
        return abs((complex(*one.force) * way.conjugate()).real) / abs(way)

    # ---- what must vanish --------------------------------------------------------------------------------------

    def unbalanced(self, link: str) -> tuple[Any, Any, Any]:
        """What the forces on a link sum up to, and their moments about the origin."""
        total = [0, 0, 0]
        for one in self.actions:
            for sign in [1] * (one.on == link) + [-1] * (one.of == link):
                (x, y), (u, v) = one.at, one.force
                total = [total[0] + sign * u, total[1] + sign * v, total[2] + sign * (x * v - y * u + one.couple)]
        return tuple(total)

    def power(self, *kinds: str) -> Any:
        """What actions of these kinds give the links, or take: forces by velocities, couples by turnings, in N mm/s."""
        total = 0
        for one in self.actions:
            if one.kind in kinds:
                (u, v), turning = self.slip(one), self.rate(one.on) - self.rate(one.of)
                total += one.force[0] * u + one.force[1] * v + one.couple * turning
        return total

    @property
    def size(self) -> float:
        """The largest force, or moment by the machine's length."""
        reach = max((math.hypot(*map(float, place)) for place in self.at.values()), default=1.0) + 1.0
        return max((max(math.hypot(*map(float, one.force)), abs(float(one.couple)) / reach) for one in self.actions),
                   default=0.0) * reach
