"""The third opinion: the machine's own constraints, closed by Newton at times around now, and differentiated by them.

Three coordinates a link, in the machine's size as unit: where its first point stands, and how far it has turned. The
constraints are what can be seen of a machine: points of two links stay together, a block stays on its guide and does
not turn on it, drives go as they are told. Nothing is derived on paper: the Jacobian is a complex step, and velocities
and accelerations are the Taylor coefficients of the poses on a small circle of complex times (Lyness and Moler 1967),
to which the equations extend as they are, for they are analytic. No difference of near numbers is ever taken.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from machine import Machine, Points

Rates = dict[tuple[str, str], complex]
STEP = 1e-30
RADIUS, TIMES = 0.01, 16  # of the circle, in seconds: drives turn it by about 2 degrees; 16 poses on it


class Closure:
    """A machine that can be moved, from a pose in which its lengths are true."""

    def __init__(self, machine: Machine, at: Points):
        self.machine, self.where = machine, at
        self.size = max(abs(p - q) for p in at.values() for q in at.values())
        self.at = {point: z / self.size for point, z in at.items()}
        self.column = {link: 3 * i for i, link in enumerate(link for link in machine.links if link != "frame")}
        first = (self.at[machine.links[link][0]] for link in self.column)
        self.start = np.array([part for z in first for part in (z.real, z.imag, 0.0)])

    def turned(self, q: Any, link: str) -> Any:
        """How far a link has turned."""
        return q[self.column[link] + 2] if link in self.column else 0 * q[0]

    def vector(self, q: Any, link: str, v: complex) -> Any:
        """A vector that is fixed to a link, as x and y."""
        c, s = np.cos(self.turned(q, link)), np.sin(self.turned(q, link))
        return np.array([c * v.real - s * v.imag, s * v.real + c * v.imag])

    def place(self, q: Any, link: str, z: complex) -> Any:
        """Where the place z of a link has gone to."""
        if link not in self.column:
            return np.array([z.real + 0 * q[0], z.imag + 0 * q[0]])
        k = self.column[link]
        return q[k:k + 2] + self.vector(q, link, z - complex(*self.start[k:k + 2]))

    def slip(self, q: Any, slide: Any) -> Any:
        """How far a block has gone along its guide and across it."""
        z, along = self.at[slide.at], slide.direction(self.at)
        x, y = self.vector(q, slide.along, along / abs(along))
        u, v = self.place(q, slide.link, z) - self.place(q, slide.along, z)
        return x * u + y * v, x * v - y * u

    def residuals(self, q: Any, t: Any) -> Any:
        """What must vanish."""
        rows = []
        for point, z in self.at.items():
            pin, *others = (link for link, own in self.machine.links.items() if point in own)
            for link in others:
                rows += [*(self.place(q, link, z) - self.place(q, pin, z))]
        for slide in self.machine.slides:
            rows += [self.turned(q, slide.link) - self.turned(q, slide.along), self.slip(q, slide)[1]]
        for drive in self.machine.drives:
            told = drive.speed * t + drive.acceleration * t * t / 2
            if drive.slides:
                pair = next(s for s in self.machine.slides if (s.link, s.along) == (drive.link, drive.base))
                rows.append(self.slip(q, pair)[0] - told / self.size)
            else:
                rows.append(self.turned(q, drive.link) - self.turned(q, drive.base) - told)
        return np.array(rows)

    def inverse(self, q: Any, t: float) -> Any:
        """The inverse of the Jacobian of the residuals."""
        return np.linalg.pinv(self.residuals(q[:, None] + STEP * 1j * np.eye(len(q)), t).imag / STEP, rcond=1e-9)

    def moved(self, time: float) -> Points:
        """Where the points are after a time, or a quarter of it where the machine stops before: followed step by
        step."""
        q = self.start
        for t in np.linspace(0, time, 9)[1:]:
            for _ in range(12):
                q = q - self.inverse(q, t) @ self.residuals(q, t)
            if not abs(self.residuals(q, t)).max() < 1e-13:
                return self.moved(time / 4)  # well before its limit, where the poses of a circle of times serve
        return {point: complex(*self.place(q, self.carrier(point), z)) * self.size for point, z in self.at.items()}

    def carrier(self, point: str) -> str:
        """A link that has the point: the frame if that does."""
        links = [link for link, own in self.machine.links.items() if point in own]
        return "frame" if "frame" in links else links[0]

    def rates(self) -> Rates:
        """Velocity and acceleration of every point and of every block on its guide, omega and alpha of each link."""
        circle = np.exp(2j * np.pi * np.arange(TIMES) / TIMES)
        inverse, q = self.inverse(self.start, 0.0), self.start[:, None] + 0 * circle
        for _ in range(60):
            step = inverse @ self.residuals(q, RADIUS * circle)
            q = q - step
            if abs(step).max() < 1e-15:
                break
        assert abs(self.residuals(q, RADIUS * circle)).max() < 1e-13

        def derived(values: Any) -> tuple[Any, Any]:
            return (values / circle).mean(-1).real / RADIUS, 2 * (values / circle**2).mean(-1).real / RADIUS**2

        found: Rates = {}
        for point, z in self.at.items():
            velocity, acceleration = derived(self.place(q, self.carrier(point), z) * self.size)
            found["velocity", point], found["acceleration", point] = complex(*velocity), complex(*acceleration)
        for link in self.column:
            found["omega", link], found["alpha", link] = derived(self.turned(q, link))
        for slide in self.machine.slides:
            name, along = f"{slide.link} along {slide.along}", slide.direction(self.where)
            speed, change = derived(self.slip(q, slide)[0] * self.size / abs(along))
            found["slide velocity", name], found["slide acceleration", name] = speed * along, change * along
        return found
