"""Cam and follower in touch: where, with which normal, curvature and pressure angle, at any angle of the cam.

The cam turns about O, the origin; the frame stands still. A translating follower moves along +y, its path passing O at
the offset on the side where the cam rises; one that oscillates has its pivot B on the +x axis and stands over it, so
that it is lifted clockwise. Plane vectors are complex numbers, arrays over angles of the cam; `turned` takes them to
the cam's own plane. Lengths are in the task's unit, derivatives by the angle of the cam in radians.

Where a point or the centre of a roller is A, the cam's plane sees it move with t = A' - i sigma A (sigma = 1 where the
cam turns counter-clockwise): the contact normal is a quarter turn from t, and the curvature of its path is
Im(t* q)/|t|^3 with q = A'' - 2 i sigma A' - A. A flat face with the normal n at the distance h from O, n turning in the
cam's plane by the angle a, touches at h n + (dh/da) i n with the radius of curvature h + d2h/da2.

Sources: Ozols 1974, 20-3 and 20-4, (20.14)-(20.16), (20.24)-(20.36), the normal taken from the relative velocity.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = Any
Lifts = Callable[[int], Array]  # the law's derivative of an order, at some angles


@dataclass(frozen=True)
class CamContact:
    """Cam and follower in touch at some angles, in the frame's plane; radii are positive where the cam is convex.

    `roller` is the centre of the roller, or the point; of a flat face, as `point`, where it touches. `centre` is that
    of the profile's curvature, at infinity where the profile is straight, and so is `radius`.
    """

    point: Array
    normal: Array
    centre: Array
    radius: Array
    roller: Array
    pressure: Array


@dataclass(frozen=True)
class CamPair(ABC):
    """A cam and its follower, with the base circle known; the cam turns with `sense`."""

    sense: int

    @property
    @abstractmethod
    def base(self) -> float:
        """The radius of the base circle."""

    @abstractmethod
    def contact(self, lifts: Lifts) -> CamContact:
        """How they touch, by the law's derivatives."""

    def to_cam_plane(self, spots: Array, angles: Array) -> Array:
        """Where spots of the frame lie on the cam, which has turned by so many degrees."""
        return spots * np.exp(-1j * self.sense * np.radians(angles))


@dataclass(frozen=True)
class Rolled(CamPair):
    """A follower that touches with a point or a roller, whose radius is then above 0."""

    roller: float

    @abstractmethod
    def path(self, lifts: Lifts) -> tuple[Array, Array, Array, Array]:
        """The centre of the roller with two derivatives by the angle, and the direction in which it is lifted."""

    def path_curvature(self, lifts: Lifts) -> tuple[Array, Array, Array, Array]:
        """The centre of the roller, the normal, the curvature of its path on the cam, the direction of the lift."""
        A, A1, A2, up = self.path(lifts)
        t = A1 - 1j * self.sense * A
        q = A2 - 2j * self.sense * A1 - A
        return A, 1j * self.sense * t / abs(t), -self.sense * (t.conjugate() * q).imag / abs(t) ** 3, up

    def contact(self, lifts: Lifts) -> CamContact:
        A, n, bend, up = self.path_curvature(lifts)
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = np.where(bend == 0, np.inf, 1 / bend)
            centre = np.where(bend == 0, np.inf, A - n * radius)
        return CamContact(A - self.roller * n, n, centre, radius - self.roller, A, np.angle(n / up) * self.sense)


@dataclass(frozen=True)
class Translating(Rolled):
    """A point or roller on a straight path, which passes the cam's centre at the offset."""

    offset: float
    depth: float  # from the cam's centre up to where the follower is lowest

    @property
    def base(self) -> float:
        return abs(complex(self.offset, self.depth))

    def path(self, lifts: Lifts) -> tuple[Array, Array, Array, Array]:
        s = lifts(0)
        return self.sense * self.offset + 1j * (self.depth + s), 1j * lifts(1), 1j * lifts(2), 1j + 0 * s


@dataclass(frozen=True)
class Oscillating(Rolled):
    """A point or roller on an arm; `angle` is that between the arm and the line of centres where it is lowest."""

    arm: float
    distance: float
    angle: float

    @property
    def base(self) -> float:
        return float(abs(self.distance - self.arm * np.exp(-1j * self.angle)))

    def path(self, lifts: Lifts) -> tuple[Array, Array, Array, Array]:
        out = -self.arm * np.exp(-1j * (self.angle + lifts(0)))
        rate, change = lifts(1), lifts(2)
        return self.distance + out, -1j * rate * out, -(1j * change + rate**2) * out, -1j * out / self.arm


@dataclass(frozen=True)
class Flat(CamPair):
    """A follower that touches with a flat face."""

    @abstractmethod
    def face(self, lifts: Lifts) -> tuple[Array, Array, Array, Array, Array, Array]:
        """The normal n, the distance h with two derivatives, and how fast and with what change n turns on the cam."""

    def leaning(self, point: Array, n: Array) -> Array:
        """The pressure angle where it touches at a point."""
        return 0 * point.real

    def contact(self, lifts: Lifts) -> CamContact:
        n, h, h1, h2, turn, change = self.face(lifts)
        across = h1 / turn
        radius = h + (h2 * turn - h1 * change) / turn**3
        point = n * (h + 1j * across)
        return CamContact(point, n, point - radius * n, radius, point, self.leaning(point, n))


@dataclass(frozen=True)
class FlatTranslating(Flat):
    """A flat face square to its straight path."""

    radius: float

    @property
    def base(self) -> float:
        return self.radius

    def face(self, lifts: Lifts) -> tuple[Array, Array, Array, Array, Array, Array]:
        s = lifts(0)
        return 1j + 0 * s, self.radius + s, lifts(1), lifts(2), -self.sense + 0 * s, 0 * s


@dataclass(frozen=True)
class FlatOscillating(Flat):
    """A flat face about a pivot, which its plane passes at the offset, towards the cam."""

    distance: float
    offset: float
    angle: float

    @property
    def base(self) -> float:
        return float(self.distance * np.sin(self.angle) - self.offset)

    def face(self, lifts: Lifts) -> tuple[Array, Array, Array, Array, Array, Array]:
        turned, rate, change = self.angle + lifts(0), lifts(1), lifts(2)
        a, sine, cosine = self.distance, np.sin(turned), np.cos(turned)
        return (1j * np.exp(-1j * turned), a * sine - self.offset, a * cosine * rate,
                a * (cosine * change - sine * rate**2), -(self.sense + rate), -change)

    def leaning(self, point: Array, n: Array) -> Array:
        return np.angle(1j * n / (point - self.distance)) * self.sense
