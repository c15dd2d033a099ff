"""The shaking force and the shaking moment: what the inertia of all links does to the frame, pose by pose.

In newtons and newton metres, whatever the scene's units. Source: Ozols 1974, (16.1) to (16.6).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.machine.linkages.mass_centre import MassCentre
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.units import KILOGRAMS, METRES


@dataclass(frozen=True)
class Shaking:
    """The inertia forces -m a_S of the links, complex arrays of shape (n,) in N, by link; and the moment of all of them
    with the couples -I alpha about a point `about`, in N m."""

    about: complex
    parts: dict[str, Any]
    moment: Any

    @cached_property
    def force(self) -> Any:
        """The shaking force, the sum of its parts."""
        return sum(self.parts.values())


def shaking(centre: MassCentre, places: Mapping[str, Any], accelerations: Mapping[str, Any],
            alphas: Mapping[str, Any]) -> Shaking:
    """The shaking force and its moment about the hinge from which the principal vectors are laid off, or where that
    moves, about the scene's origin.

    Reads where the mass centres of the links are, how they are accelerated (complex arrays of shape (n,) by point, in
    scene units), and the angular accelerations of the links.
    """
    scene = centre.scene
    about = complex(*map(float, scene.points[centre.base])) if FRAME in scene.links_of[centre.base] else 0j
    long, heavy, parts, moment = float(METRES[scene.units.length]), float(KILOGRAMS[scene.units.mass]), {}, 0.0
    for link, mass in centre.masses.items():
        force = -heavy * long * float(mass.mass) * accelerations[mass.centre]
        parts[link] = force
        moment = moment + long * ((places[mass.centre] - about).conjugate() * force).imag
        moment = moment - heavy * float(mass.inertia) * alphas[link]
    return Shaking(about, parts, moment)
