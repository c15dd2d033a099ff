"""Loads on the drawing board: weights, given forces, inertia forces and couples of each link as drawn vectors.

A force is drawn `phi` lengths of the mechanism plan long for each unit of force. The inertia force is -m a, from the
acceleration plan; a couple becomes a pair of forces at two points of its link (Ozols 1974, 9-2 and 10-6).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Protocol

from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Loads, Mass, Number, Scene
from graphplan.mechanism.units import inertia, metre, weight
from graphplan.methods.network import Network
from graphplan.methods.poses import Pose
from graphplan.methods.tempo import extent, round_number, tempo


@dataclass(frozen=True)
class Acting:
    """A drawn force: the mark at which it acts, its tail and its head; `name` is how it is spoken of."""

    at: Mark
    tail: Mark
    head: Mark
    name: str = ""

    @property
    def reversed(self) -> Acting:
        """The force that answers it."""
        return Acting(self.at, self.head, self.tail, self.name)


Lay = Callable[[Mark], Acting]


class Motion(Protocol):
    """The acceleration plan, as far as loads need it: of a link's point the mark in its figure, and the end."""

    def figure(self, link: str, point: str) -> Mark: ...
    def end_in(self, link: str, point: str) -> Mark: ...


class Loading:
    """The loads of each link, laid off from any mark of a force plan.

    Reads the plan of accelerations where links have masses, and `phi` and `unit` (of angular velocity), by which forces
    and rates are drawn.
    """

    def __init__(self, board: Board, net: Network, pose: Pose, phi: Number, unit: Number, motion: Motion | None):
        self.board, self.net, self.pose, self.phi, self.unit, self.motion = board, net, pose, phi, unit, motion
        self.scene: Scene = net.scene
        assert self.scene.loads is not None
        self.loads: Loads = self.scene.loads

    def forces(self, link: str, start: Mark) -> Iterator[Acting]:
        """The forces on a link, one after the other from `start`."""
        for _, lay in self.each(link):
            force = lay(start)
            yield force
            start = force.head

    def each(self, link: str) -> Iterator[tuple[str, Lay]]:
        """The forces on a link: the point where each acts, and how it is laid off; one that is nothing is left out."""
        for nth, force in enumerate((f for f in self.loads.forces if f.on == link), 1):
            if any(force.value):
                name = f"P_{link}" + "'" * (nth - 1)
                why = f"{name}, the given force on link {link} at {force.at}"
                yield force.at, partial(self._given, force.at, force.value, name, why)
        mass = self.loads.masses.get(link)
        if mass and mass.mass:
            heaviness = tuple(mass.mass * g * weight(self.scene.units) for g in self.loads.gravity)
            if any(heaviness):
                why = f"G_{link}, the weight of link {link}, at {mass.centre}"
                yield mass.centre, partial(self._given, mass.centre, heaviness, f"G_{link}", why)
            if self._accelerated(link, mass.centre):
                yield mass.centre, partial(self._inertia, link, mass)

    def _given(self, at: str, value: tuple[Number, ...], name: str, why: str, start: Mark) -> Acting:
        x, y = value
        head = self.board.lay_off(start, dx=x * self.phi, dy=y * self.phi, why=why)
        return Acting(self.pose.points[at], start, head, name)

    def _inertia(self, link: str, mass: Mass, start: Mark) -> Acting:
        """The inertia force, against the acceleration of the centre of mass."""
        assert self.motion is not None
        home, end = self.motion.figure(link, mass.centre), self.motion.end_in(link, mass.centre)
        ratio = -mass.mass * inertia(self.scene.units) * self.phi * self.unit * self.unit
        why = f"J_{link}, the inertia force of link {link}, against the acceleration of {mass.centre}"
        head = self.board.step_off(home, end, start, ratio=ratio, why=why)
        return Acting(self.pose.points[mass.centre], start, head, f"J_{link}")

    def _accelerated(self, link: str, point: str) -> bool:
        return self.motion is not None and FRAME not in self.scene.links_of[point]

    def couples(self, link: str, start: Mark) -> Iterator[tuple[Acting, Acting]]:
        """The couples on a link, as pairs of forces laid off from `start`: the force at one point, and its answer."""
        for moment in (m for m in self.loads.moments if m.on == link):
            if moment.value:
                P, R = self.arm(link)
                value = moment.value * self.phi * metre(self.scene.units)
                head = self.board.couple(P, R, start, moment=value, why=f"the given moment on link {link}")
                yield Acting(R, start, head, f"M_{link}"), Acting(P, head, start, f"M_{link}")
        mass = self.loads.masses.get(link)
        if mass and mass.inertia and self.motion is not None and self.turns(link):
            yield self._inertia_pair(link, mass, start)

    def _inertia_pair(self, link: str, mass: Mass, start: Mark) -> tuple[Acting, Acting]:
        assert self.motion is not None
        one, two = self.arm_points(link)
        ends = self.motion.end_in(link, one), self.motion.end_in(link, two)
        P, R = self.pose.points[one], self.pose.points[two]
        ratio = mass.inertia * weight(self.scene.units) * metre(self.scene.units) * self.phi * self.unit * self.unit
        why = f"the inertia couple of link {link}, against its angular acceleration"
        head = self.board.inertia_pair(P, R, *ends, start, ratio=ratio, why=why)
        return Acting(R, start, head, f"W_{link}"), Acting(P, head, start, f"W_{link}")

    def turns(self, link: str) -> bool:
        """Whether a link may have an angular acceleration: not if it turns as the frame does, but for even drives."""
        net = self.net
        if not net.ground or net.classes[net.body[link]] != net.classes[net.ground]:
            return True
        return bool(sum(sign * drive.alpha for sign, drive in net.excess(link, net.ground)))

    def arm_points(self, link: str) -> tuple[str, str]:
        """Two points of a link, far apart, the first one fixed if the link has such; of a block, one of its guide."""
        scene, names = self.scene, list(self.scene.links[link])
        names += [p for s in scene.slides if link in (s.link, s.along) for k in (s.link, s.along) if k != link
                  for p in scene.links[k]]
        names += list(scene.points)
        first = next((p for p in scene.links[link] if FRAME in scene.links_of[p]), names[0])
        own = [p for p in scene.links[link] if self._apart(first, p)]
        return first, max(own, key=lambda p: self._apart(first, p)) if own else next(
            p for p in names if self._apart(first, p))

    def _apart(self, P: str, R: str) -> float:
        one, two = self.scene.points[P], self.scene.points[R]
        return max(abs(float(a - b)) for a, b in zip(one, two, strict=True))

    def arm(self, link: str) -> tuple[Mark, Mark]:
        """The marks of the two points at which a link's couples act as pairs of forces."""
        one, two = self.arm_points(link)
        return self.pose.points[one], self.pose.points[two]

    def loaded(self, link: str) -> bool:
        """Whether anything acts on a link besides its neighbours."""
        mass = self.loads.masses.get(link)
        moved = any(self.loads.gravity) or self.motion is not None
        weighs = mass is not None and (mass.mass or mass.inertia) and moved
        given = any(f.on == link for f in self.loads.forces) or any(m.on == link for m in self.loads.moments)
        return bool(given or weighs or any(b.link == link for b in self.loads.balances))


def force_scale(scene: Scene) -> Number:
    """How long a unit of force is drawn: the largest load about a third of the mechanism, in a round number."""

    loads = scene.loads
    assert loads is not None
    size = extent(scene)
    sizes = [abs(float(v)) for force in loads.forces for v in force.value]
    sizes += [abs(float(moment.value * metre(scene.units))) / size for moment in loads.moments]
    sizes += [abs(float(m.mass * g * weight(scene.units))) for m in loads.masses.values() for g in loads.gravity]
    sizes += _inertia_sizes(scene, size)
    largest = max(sizes, default=0.0)
    return round_number(size / largest / 3) if largest else round_number(size)


def _inertia_sizes(scene: Scene, size: float) -> Iterator[float]:
    """About how large inertia forces are: as if every mass ran round a quarter of the mechanism."""
    assert scene.loads is not None
    rate = float(tempo(scene).unit) ** 2 if scene.drives else 0.0
    for mass in scene.loads.masses.values():
        yield float(mass.mass * inertia(scene.units)) * rate * size / 4
