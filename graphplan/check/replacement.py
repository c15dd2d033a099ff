"""Static replacement of a link by masses at two joints, and what it costs.

Masses in the inverse proportion of their distances keep the link's mass and its centre, so the inertia force has the
right size and direction; but the moment of inertia becomes m a b instead of I, and the couple is wrong by ab/i^2 - 1,
whatever the motion (Ozols 1974, 9-2 and example 9-1).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from graphplan.mechanism.model import Mass, Scene
from graphplan.mechanism.units import metre

STRAIGHT = 1e-9  # of the distance of the joints: the centre lies between them


@dataclass(frozen=True)
class Replacement:
    """A link, the joints that its mass would go to, and the error of the inertia couple as a part of it."""

    link: str
    joints: tuple[str, str]
    error: float

    def __str__(self) -> str:
        A, B = self.joints
        return (f"static replacement: masses at {A} and {B} for link {self.link} would miss its inertia couple by "
                f"{100 * self.error:.3g} %")


def replacements(scene: Scene) -> Iterator[Replacement]:
    """For each link with mass and inertia whose centre lies between two of its joints, what replacing it would cost."""
    masses = scene.loads.masses if scene.loads else {}
    for link, mass in masses.items():
        joints = [point for point in scene.links[link] if point in scene.joints and point != mass.centre]
        if mass.mass and mass.inertia:
            yield from _between(scene, link, mass, joints)


def _between(scene: Scene, link: str, mass: Mass, joints: list[str]) -> Iterator[Replacement]:
    places = {name: (float(x), float(y)) for name, (x, y) in scene.points.items()}
    radius2 = float(mass.inertia / mass.mass * metre(scene.units) ** 2)
    for A, B in combinations(joints, 2):
        a, b = (math.dist(places[mass.centre], places[joint]) for joint in (A, B))
        if a + b <= math.dist(places[A], places[B]) * (1 + STRAIGHT):
            yield Replacement(link, (A, B), a * b / radius2 - 1)
