"""The forces of a rubbing machine by an iteration of the tests' own: equilibrium of each link, friction as known loads.

Nothing of it is the package's but the scene and its velocities, as fractions. Each round takes what friction does from
the last forces, so it goes another way than Newton's method: where it comes to an end the two must be one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction

import numpy as np

from graphplan.mechanism.model import FRAME, Contact, Gear, Scene, Slide
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.solver import solve

Vector = np.ndarray
ROUNDS, CLOSE, DIVERGED = 4000, 1e-13, 1e12


def quarter(v: Vector) -> Vector:
    return np.array([-v[1], v[0]])


def cross(u: Vector, v: Vector) -> float:
    return float(u[0] * v[1] - u[1] * v[0])


class Machine:
    """The equilibrium of a scene's links in one pose: columns of unknown forces, and what friction adds to them."""

    def __init__(self, scene: Scene):
        assert scene.loads is not None
        self.scene, self.loads, self.rates = scene, scene.loads, solve(scene, exact=True)
        self.at = {name: np.array([float(x), float(y)]) for name, (x, y) in scene.points.items()}
        self.row = {link: 3 * k for k, link in enumerate(scene.moving)}
        self.metre = float(METRES[scene.units.length])
        self.size = 3 * len(scene.moving)
        self.columns: list[Vector] = []
        self.names: list[str] = []
        self.rub: list[Callable[[Vector], Vector]] = []
        self._pairs()

    # ---- what acts on links, as sums of forces and of moments about the origin ---------------------------------

    def push(self, link: str, at: Vector, force: Vector, couple: float = 0.0) -> Vector:
        """A force at a place and a couple, in force * length, on a link."""
        sums = np.zeros(self.size)
        if link != FRAME:
            k = self.row[link]
            sums[k : k + 3] = [*force, cross(at, force) + couple]
        return sums

    def between(self, one: str, other: str, at: Vector, force: Vector, couple: float = 0.0) -> Vector:
        """The same on one link from another."""
        return self.push(one, at, force, couple) - self.push(other, at, force, couple)

    def unknown(self, name: str, column: Vector) -> int:
        self.names.append(name)
        self.columns.append(column)
        return len(self.columns) - 1

    # ---- pairs --------------------------------------------------------------------------------------------------

    def _pairs(self) -> None:
        circle = {f.at: float(f.radius * f.coefficient) for f in self.loads.frictions if f.at}
        rough = {frozenset(f.links): float(f.coefficient) for f in self.loads.frictions if not f.at}
        for joint in self.scene.revolutes:
            pin, *others = joint.links
            for link in others:
                self._journal(joint.at, link, pin, circle.get(joint.at, 0.0))
        for slide in self.scene.slides:
            self._slide(slide, rough.get(frozenset(slide.links), 0.0))
        for gear in self.scene.gears:
            self._gear(gear)
        for contact in self.scene.contacts:
            self._contact(contact, rough.get(frozenset(contact.links), 0.0))
        for name, balance in self.loads.named_balances.items():
            if balance.direction is None:
                column = self.between(*balance.links, np.zeros(2), np.zeros(2), 1.0)
            else:
                column = self.between(*balance.links, self.at[balance.at], np.array([*map(float, balance.direction)]))
            self.unknown(f"balance {name}", column)

    def _turning(self, link: str) -> Fraction:
        return Fraction(0) if link == FRAME else Fraction(self.rates.omega[link])

    def _journal(self, point: str, link: str, pin: str, circle: float) -> None:
        at = self.at[point]
        x, y = (self.unknown(f"{link} at {point}", self.between(link, pin, at, way)) for way in np.eye(2))
        turns = self._turning(link) - self._turning(pin)
        if circle and turns:
            one = self.between(link, pin, at, np.zeros(2), -circle if turns > 0 else circle)
            self.rub.append(lambda f: np.hypot(f[x], f[y]) * one)

    def _slide(self, slide: Slide, coefficient: float) -> None:
        at, along = self.at[slide.at], np.array([*map(float, slide.direction)])
        along = along / np.hypot(*along)
        n = self.unknown(f"{slide.name}", self.between(slide.link, slide.along, at, quarter(along)))
        self.unknown(f"moment {slide.name}", self.between(slide.link, slide.along, at, np.zeros(2), 1.0))
        slip = sum(p * q for p, q in zip(self.rates.slide_velocity[slide.name], slide.direction, strict=True))
        if coefficient and slip:
            self._drag(n, slide.link, slide.along, at, -along if slip > 0 else along, coefficient)

    def _drag(self, n: int, link: str, other: str, at: Vector, way: Vector, coefficient: float) -> None:
        one = coefficient * self.between(link, other, at, way)
        self.rub.append(lambda f: abs(f[n]) * one)

    def _gear(self, gear: Gear) -> None:
        one, other = gear.links
        pitch = np.array([*map(float, gear.pitch_point(self.scene.points))])
        off = self.at[gear.centres[0]] - pitch
        off = off / np.hypot(*off)
        n = self.unknown(gear.name, self.between(one, other, pitch, quarter(off)))
        radial = float(gear.tangent) * self.between(one, other, pitch, off)
        self.rub.append(lambda f: abs(f[n]) * radial)

    def _contact(self, contact: Contact, coefficient: float) -> None:
        one, other = contact.links
        at = self.at[contact.at]
        ends = [self.at[centre] for centre in contact.centres if centre]
        normal = (quarter(np.array([*map(float, contact.direction)])) if contact.direction is not None
                  else ends[1] - ends[0])
        normal = normal / np.hypot(*normal)
        n = self.unknown(contact.name, self.between(one, other, at, normal))
        if contact.rolling:
            self.unknown(f"tangent {contact.name}", self.between(one, other, at, quarter(normal)))
            return
        x, y = self.scene.points[contact.at]
        u, v = (p - q for p, q in zip(self._moved(one, x, y), self._moved(other, x, y), strict=True))
        slip = float(-u * Fraction(normal[1]) + v * Fraction(normal[0]))
        if coefficient and abs(slip) > 1e-9:
            tangent = quarter(normal)
            self._drag(n, one, other, at, -tangent if slip > 0 else tangent, coefficient)

    def _moved(self, link: str, x: Fraction, y: Fraction) -> tuple[Fraction, Fraction]:
        """The velocity of a place of a link."""
        if link == FRAME:
            return Fraction(0), Fraction(0)
        base = self.rates.equations.bases[link]
        (bx, by), (vx, vy), omega = self.scene.points[base], self.rates.velocity[base], self.rates.omega[link]
        return vx - omega * (y - by), vy + omega * (x - bx)

    # ---- loads --------------------------------------------------------------------------------------------------

    def burden(self) -> Vector:
        """The loads, weights and inertia forces of all links."""
        total = np.zeros(self.size)
        for load in self.loads.forces:
            total += self.push(load.on, self.at[load.at], np.array([*map(float, load.value)]))
        for moment in self.loads.moments:
            total += self.push(moment.on, np.zeros(2), np.zeros(2), float(moment.value) / self.metre)
        kilogram = float(KILOGRAMS[self.scene.units.mass]) / float(NEWTONS[self.scene.units.force])
        for link, body in self.loads.masses.items():
            a = self.metre * np.array([*map(float, self.rates.acceleration[body.centre])])
            force = kilogram * float(body.mass) * (np.array([*map(float, self.loads.gravity)]) - a)
            couple = -kilogram * float(body.inertia) * float(self.rates.alpha[link]) / self.metre
            total += self.push(link, self.at[body.centre], force, couple)
        return total

    def forces(self) -> Vector | None:
        """The unknowns with friction; None where the rounds come to no end."""
        matrix, burden = np.array(self.columns).T, self.burden()
        if matrix.shape[0] != matrix.shape[1] or np.linalg.cond(matrix) > 1e9:
            return None
        inverse = np.linalg.inv(matrix)
        found, step = inverse @ -burden, 1.0
        for number in range(ROUNDS):
            rubbed = sum((rub(found) for rub in self.rub), np.zeros(self.size))
            new = inverse @ -(burden + rubbed)
            gap, largest = np.abs(new - found).max(initial=0.0), np.abs(new).max(initial=0.0)
            if gap <= CLOSE * largest or not largest:
                return new
            if largest > DIVERGED * np.abs(burden).max():
                return None
            if number == 200:
                step = 0.3  # forces that go to and fro
            found = found + step * (new - found)
        return None

    def results(self) -> dict[str, float] | None:
        """The balances and the sizes of the reactions in journals, by name; moments in force * m."""
        found = self.forces()
        if found is None:
            return None
        return dict(self._named(found))

    def _named(self, found: Vector) -> Iterator[tuple[str, float]]:
        for name in (f"{link} at {joint.at}" for joint in self.scene.revolutes for link in joint.links[1:]):
            k = self.names.index(name)
            yield name, float(np.hypot(found[k], found[k + 1]))
        for name, balance in self.loads.named_balances.items():
            value = float(found[self.names.index(f"balance {name}")])
            yield f"balance {name}", value * (self.metre if balance.direction is None else 1.0)
