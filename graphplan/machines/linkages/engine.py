"""The inertia forces of a slider-crank by their orders, and the counterweights of an engine.

The masses of crank, connecting rod and piston are reduced to the crank pin, where they rotate, and to the piston pin,
where they reciprocate. The piston's path is a series of cosines and sines of multiples of the crank's angle, so that
its inertia force has orders: the first and the second are what engines are balanced against. Angles count from the
direction in which the piston stands from the crank's hinge, forces and moments of mass are in N and kg m.

Source: Ozols 1974, 16-4, (6.47), (16.13) to (16.19), examples 16-1 and 16-2.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.machines.linkages.counterweights import Counterweight
from graphplan.machines.tolerances import ON_LINE_TOL, ORDER_TOL, TERM_TOL
from graphplan.mechanism.model import FRAME, Drive, Scene, Slide
from graphplan.mechanism.units import KILOGRAMS, METRES

MAX_ORDER = 4  # of the inertia forces that are told
SERIES_SAMPLES = 1024  # of a turn of the crank from which the series is found: its terms are exact to rounding


@dataclass(frozen=True)
class Engine:
    """A slider-crank whose crank turns on the frame: its links and joints, lengths in metres, masses in kg.

    `ahead` is the direction of the guide in which the piston stands from the crank's hinge, a complex number of size 1,
    and `offset` by how much the guide passes that hinge on the left of it.
    """

    crank: str
    rod: str
    piston: str
    hinge: str
    radius: float
    rod_length: float
    offset: float
    ahead: complex
    omega: float
    rotating: float
    reciprocating: float

    @property
    def ratio(self) -> float:
        """The crank's radius over the length of the connecting rod, lambda."""
        return self.radius / self.rod_length

    @cached_property
    def series(self) -> Any:
        """The factors c_k of the piston's path: along the guide it is the sum of the real parts of
        l c_k exp(-i k phi); without offset c_2 and c_4 are the book's A_2 and A_4, and c_1 is the ratio."""
        return path_series(self.ratio, self.offset / self.rod_length)

    @property
    def orders(self) -> list[int]:
        """The orders that there are, but for rounding."""
        return [k for k in range(1, len(self.series)) if abs(self.series[k]) > TERM_TOL]

    def order(self, k: int) -> complex:
        """The amplitude of the inertia force of the k-th order of what reciprocates, in N: along the guide it is the
        real part of it times exp(-i k phi)."""
        return complex(self.reciprocating * self.rod_length * (k * self.omega) ** 2 * self.series[k])

    @property
    def centrifugal(self) -> float:
        """The inertia force of what rotates, in N."""
        return self.rotating * self.radius * self.omega**2

    def force(self, angles: Any, orders: Sequence[int] = (1, 2, 4), main: float = 0.0, additional: float = 0.0) -> Any:
        """The inertia force at crank angles in radians, a complex array of shape (n,) in N, real along the guide.

        `main` and `additional` are masses on the crank, opposite its pin and as far from its hinge, in kg.
        """
        import numpy as np

        turning = (self.rotating - main - additional) * self.radius * self.omega**2 * np.exp(1j * np.asarray(angles))
        return turning + sum((self.order(k) * np.exp(-1j * k * np.asarray(angles))).real for k in orders)

    @property
    def counter_rotating(self) -> tuple[tuple[int, float], ...]:
        """Pairs of wheels that turn against each other, at so many times the crank's speed, each with this mass times
        radius in kg m: they balance the first and the second order of what reciprocates."""
        return (1, self.reciprocating * self.radius / 2), (2, self.reciprocating * self.rod_length
                                                           * abs(self.series[2]) / 2)

    def share(self, scene: Scene, share: float, radius: float | None = None) -> Counterweight:
        """The counterweight on the crank that balances what rotates and a share of what reciprocates."""
        unit = float(KILOGRAMS[scene.units.mass] * METRES[scene.units.length])
        hinge, pin = (complex(*map(float, scene.points[name])) for name in (self.hinge, self.pin(scene)))
        moment = -(self.rotating + share * self.reciprocating) * self.radius / unit * (pin - hinge) / abs(pin - hinge)
        return Counterweight(self.crank, self.hinge, moment, radius or abs(pin - hinge))

    def pin(self, scene: Scene) -> str:
        """The crank pin."""
        return next(p for p in scene.links[self.crank] if self.rod in scene.links_of[p])


@dataclass(frozen=True)
class InLine:
    """Resultant of equal cylinders in line, of rotating masses (order 0) and of an order of reciprocating ones: the
    largest force in N, and couple in N m, about the origin of the places if the forces cancel."""

    order: int
    force: float
    couple: float


def cylinders_in_line(one: Engine, angles: Sequence[float], places: Sequence[float]) -> list[InLine]:
    """The resultants of equal cylinders by their orders, up to the fourth.

    Reads a cylinder, the angles of the cranks in degrees and their places along the shaft in metres.
    """
    sizes = {0: one.centrifugal, **{k: abs(one.order(k)) for k in one.orders if k <= MAX_ORDER}}
    reach = max(map(abs, places)) or 1.0
    return [InLine(k, *(size * factor * (factor > ORDER_TOL * len(angles) * unit) for factor, unit in
                        zip(in_line(angles, places, k or 1), (1.0, reach), strict=True))) for k, size in sizes.items()]


def path_series(ratio: float, offset: float = 0.0) -> Any:
    """The factors c_k of a piston's path in lengths of the rod, by the crank's angle phi: the path is the sum of the
    real parts of c_k exp(-i k phi), k from 0; complex array.

    Reads the crank's radius and the offset of the guide, in lengths of the rod.
    """
    import numpy as np

    angle = 2 * np.pi * np.arange(SERIES_SAMPLES) / SERIES_SAMPLES
    path = ratio * np.cos(angle) + np.sqrt(1 - (ratio * np.sin(angle) - offset) ** 2)
    series = np.fft.rfft(path).conj() * 2 / SERIES_SAMPLES
    series[0] /= 2
    return series[:SERIES_SAMPLES // 2]


def engine(scene: Scene) -> Engine | None:
    """The scene as an engine; None if it is no slider-crank with a crank that turns, mass centres of crank and rod on
    the lines of their joints, and masses on no further links."""
    masses = scene.loads.masses if scene.loads else {}
    if len(scene.moving) > 3 or not all(isinstance(pair, Slide | Drive) for pair in scene.written):
        return None
    for slide in (slide for slide in scene.slides if slide.along == FRAME):
        for hinge, pin, wrist, crank, rod in _cranks(scene, slide.link):
            places = (complex(*map(float, scene.points[name])) for name in (hinge, pin, wrist))
            reduced = reduce_masses(scene, (crank, rod, slide.link), hinge, [*places], slide)
            if reduced is not None and set(masses) <= {crank, rod, slide.link}:
                return reduced
    return None


def _cranks(scene: Scene, slider: str) -> list[tuple[str, str, str, str, str]]:
    """Ways from a slider over a rod and a crank to the frame: hinge, crank pin and wrist pin, crank and rod."""
    joints = {frozenset((a, b)): joint.at for joint in scene.revolutes for a in joint.links for b in joint.links}
    cranks = []
    for crank in scene.moving:
        for rod in scene.moving:
            needed = [joints.get(frozenset(pair)) for pair in ((FRAME, crank), (crank, rod), (rod, slider))]
            if len({crank, rod, slider}) == 3 and all(needed):
                cranks.append((*map(str, needed), crank, rod))
    return cranks  # type: ignore[return-value]


def reduce_masses(scene: Scene, links: tuple[str, str, str], hinge: str, joints: Sequence[complex],
                  slide: Slide) -> Engine | None:
    """The engine of these links, and joints O, A and B, if its masses may be reduced."""
    (crank, rod, piston), (O, A, B) = links, joints
    direction = complex(*map(float, slide.direction))
    ahead = direction / abs(direction) * (1 if ((B - O) / direction).real > 0 else -1)
    if abs(A - O) >= abs(B - A) - abs(((B - O) / ahead).imag):
        return None
    masses = scene.loads.masses if scene.loads else {}
    mass_and_moment, kg = dict.fromkeys(links, (0.0, 0j)), float(KILOGRAMS[scene.units.mass])
    for link, start, end in ((crank, O, A), (rod, A, B)):
        if link in masses:
            centre = complex(*map(float, scene.points[masses[link].centre]))
            mass_and_moment[link] = kg * float(masses[link].mass), (centre - start) / (end - start)
    if any(abs(moment.imag) > ON_LINE_TOL for _, moment in mass_and_moment.values()):
        return None
    metre = float(METRES[scene.units.length])
    (m_1, s_1), (m_2, s_2) = (mass_and_moment[link] for link in (crank, rod))
    m_3 = kg * float(masses[piston].mass) if piston in masses else 0.0
    omega = next((float(drive.rate) for drive in scene.drives if drive.links == (crank, FRAME)), 0.0)
    return Engine(crank, rod, piston, hinge, metre * abs(A - O), metre * abs(B - A),
                  metre * ((B - O) / ahead).imag, ahead, omega,
                  m_1 * s_1.real + m_2 * (1 - s_2.real), m_3 + m_2 * s_2.real)


def in_line(cranks: Sequence[float], places: Sequence[float], order: int) -> tuple[float, float]:
    """The resultant of the inertia forces of one order of equal cylinders in line, in amplitudes of a cylinder's, and
    its couple, in amplitudes times the unit of the places.

    Reads the angles of the cranks in degrees, and the places of the cylinders along the shaft. The couple is taken
    about the origin of the places where the forces have none, else about where it is least.
    """
    turns = [cmath.exp(1j * math.radians(order * angle)) for angle in cranks]
    total = sum(turns)
    couple = sum(place * turn for place, turn in zip(places, turns, strict=True))
    if abs(total) > ORDER_TOL * len(turns):
        couple -= total * (couple / total).real
    return abs(total), abs(couple)
