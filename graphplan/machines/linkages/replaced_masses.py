"""Masses at points that replace a link: two at its pins, and a third at its mass centre that makes them exact.

With a = AC and b = CB on the line of two pins, m_A = m b/(a + b) and m_B = m a/(a + b) have the link's mass and its
centre: their forces have the link's resultant, but not its moment, as they leave the moment of inertia I' = I - m a b.
Three masses m_A = I/(a (a + b)), m_B = I/(b (a + b)) and the rest at C have that, too; they need neither the centre's
acceleration nor the link's turning.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 9-2 with fig. 9-5, (9.13), example 9-1; methods A14, A15.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.mechanism.model import FRAME, Mass, Scene
from graphplan.mechanism.units import KILOGRAMS, METRES
from graphplan.methods.forces.loading import pins_beside


@dataclass(frozen=True)
class ReplacedMass:
    """A link as masses in kg at points: `static` at two pins, which leave `inertia_left` in kg m^2, and `dynamic` at
    the pins and, between them in order, the mass centre."""

    link: str
    pins: tuple[str, str]
    centre: str
    static: tuple[float, float]
    dynamic: tuple[float, float, float]
    inertia_left: float

    def load(self, accelerations: Mapping[str, Any], places: Mapping[str, Any], about: complex, alpha: Any,
             metre: float) -> Iterator[tuple[Any, Any]]:
        """The inertia force of the masses at two pins with the couple of what they leave, and of those at three points:
        in N, each with its moment about a point, in N m."""
        at_two, at_three = zip(self.pins, self.static, strict=True), zip(
            (self.pins[0], self.centre, self.pins[1]), self.dynamic, strict=True)
        for masses, inertia in ((at_two, self.inertia_left), (at_three, 0.0)):
            forces = [(point, -mass * metre * accelerations[point]) for point, mass in masses]
            moment = sum(metre * ((places[point] - about).conjugate() * force).imag for point, force in forces)
            yield sum(force for _, force in forces), moment - inertia * alpha


def replaced_masses(scene: Scene, masses: Mapping[str, Mass]) -> tuple[ReplacedMass, ...]:
    """The links whose mass centre lies on a line of two of their points, beside both, as masses at points."""
    return tuple(_replace(scene, link, mass, pins) for link, mass in masses.items()
                 if link != FRAME and mass.mass and (pins := pins_beside(scene, link, mass)))


def _replace(scene: Scene, link: str, mass: Mass, pins: tuple[str, str]) -> ReplacedMass:
    metre, kilogram = float(METRES[scene.units.length]), float(KILOGRAMS[scene.units.mass])
    A, C, B = (metre * complex(*map(float, scene.points[name])) for name in (pins[0], mass.centre, pins[1]))
    long = abs(B - A)
    a, b = (float(np.real(part * np.conj(B - A))) / long for part in (C - A, B - C))
    m, inertia = kilogram * float(mass.mass), kilogram * float(mass.inertia)
    m_A, m_B = inertia / (a * long), inertia / (b * long)
    return ReplacedMass(link, pins, mass.centre, (m * b / long, m * a / long), (m_A, m - m_A - m_B, m_B),
                        inertia - m * a * b)
