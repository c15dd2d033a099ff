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

The base circle: the smallest of which the pressure angle, or the convexity of the profile, allows.

At each lift s the derivative x = ds/dphi is laid off perpendicular to the path, in the scale of the lifts, to the side
to which the velocity points when it is turned a quarter the way the cam turns. The line from the end of x to the cam's
centre O is parallel to the contact normal: so O lies behind the tangents to the curve x(s) that are inclined to the
path by the largest pressure angle, of the rise on the one side, of the return on the other (Ozols 1974, 20-3, fig.
20-6, and for an oscillating follower figs. 20-7 and 20-8). In the coordinates of that figure, A0 being the origin and s
upwards, O is (offset, -depth). With a flat face the radius of curvature is r0 + s + s'': the tangent of 45 degrees to
the curve z(s), z = s'', cuts the path in the centre of the smallest base circle (Geronimus; figs. 20-9 and 20-10).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from graphplan.cams.law import SCAN_ROUNDS, Law, LawPiece
from graphplan.cams.task import CONVEX, PRESSURE, SMALLEST, Limits, Task
from graphplan.cams.tolerances import ARM_ANGLE
from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import bisect
from graphplan.mechanism.numbers import number_text

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
        """Contact by the law's derivatives."""

    def to_cam_plane(self, spots: Array, angles: Array) -> Array:
        """Places of the frame's spots on the cam, which has turned by so many degrees."""
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
    """A flat face perpendicular to its straight path."""

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


TRIED_ANGLES, BISECTIONS = 180, 48  # angles of an arm that are tried, before the best is searched between two of them


@dataclass(frozen=True)
class Tangent:
    """A tangent to the curve x(s): the angle of the cam where it touches, and how far it passes A0, laid off as x."""

    angle: float
    intercept: float
    slope: float  # tan of the pressure angle; of the return it is inclined the other way

    @property
    def depth(self) -> float:
        """Depth under A0 at which it cuts the path."""
        return self.intercept / self.slope


@dataclass(frozen=True)
class Region:
    """Region of the cam's centre: behind the tangent of the rise and, if the return is limited, behind its own."""

    rise: Tangent
    back: Tangent | None

    def depth(self, offset: float) -> float:
        """Least depth of the centre under A0 at an offset."""
        deep = (self.rise.intercept - offset) / self.rise.slope
        return deep if self.back is None else max(deep, (self.back.intercept + offset) / self.back.slope)

    @property
    def corner(self) -> tuple[float, float]:
        """Offset and depth where both tangents meet: of the smallest cam."""
        assert self.back is not None
        deep = (self.rise.intercept + self.back.intercept) / (self.rise.slope + self.back.slope)
        return self.rise.intercept - deep * self.rise.slope, deep


def region(law: Law, limits: Limits) -> Region:
    """The tangents to the curve x(s) at these pressure angles, of a follower on a straight path."""
    return Region(_tangent(law, limits.rise, 1), None if limits.back is None else _tangent(law, limits.back, -1))


def _tangent(law: Law, degrees: Fraction, way: int) -> Tangent:
    """The tangent to the rise (way 1) or to the return (-1)."""
    slope = math.tan(math.radians(degrees))

    def intercepts(angles: Any, one: LawPiece) -> Any:
        s, x = law.times * one.value_at(angles), way * law.times * one.value_at(angles, 1)
        return np.where(x >= 0, x - slope * s, -np.inf)

    return Tangent(*law.extremum(intercepts), slope)


def least_flat(law: Law) -> tuple[float, float]:
    """Angle at which a flat face on a straight path needs the largest radius, and the radius at which the profile has a
    cusp there."""
    return law.extremum(lambda angles, one: -(one.value_at(angles) + one.value_at(angles, 2)))


def pair_with_base(task: Task) -> CamPair:
    """Cam and follower with the base circle that is given, or the smallest that limits allow.

    Fails with `Refused` where no base circle does.
    """
    follower, cam = task.follower, task.cam
    if follower.flat:
        return oscillating_flat(task) if follower.oscillates else translating_flat(task)
    roller = float(follower.radius)
    if follower.oscillates:
        return Oscillating(cam.sense, roller, float(follower.arm), float(follower.distance), _arm_angle(task))
    if cam.base == PRESSURE and cam.limits:
        centre_region = region(task.law, cam.limits)
        offset, depth = centre_region.corner if follower.offset == SMALLEST else (float(follower.offset), 0.0)
        depth = depth or centre_region.depth(offset)
        if depth <= 0:
            raise Refused(f"{task.name}: cam.base", f"at the offset {number_text(offset)} the pressure angle is never "
                          "reached, so there is no smallest base circle", "a smaller offset, or a radius")
    else:
        offset = float(follower.offset)
        depth = math.sqrt(float(cam.base) ** 2 - offset**2)
    return Translating(cam.sense, roller, offset, depth)


def translating_flat(task: Task) -> CamPair:
    """The base circle for a flat face on a straight path."""
    if task.cam.base != CONVEX:
        return FlatTranslating(task.cam.sense, float(task.cam.base))
    radius = max(0.0, least_flat(task.law)[1]) + float(task.cam.least)
    if radius <= 0:
        raise Refused(f"{task.name}: cam.base", "the profile is convex on any base circle, so there is no smallest",
                      "a least_radius, or a radius")
    return FlatTranslating(task.cam.sense, radius)


def _arm_angle(task: Task) -> float:
    """The angle between the arm and the line of centres where the follower is lowest."""
    follower, cam = task.follower, task.cam
    l, a = float(follower.arm), float(follower.distance)
    if cam.base != PRESSURE:
        return math.acos((a**2 + l**2 - float(cam.base) ** 2) / (2 * a * l))
    limits = cam.limits
    assert limits is not None

    def excess_pressure(angle: float, rounds: int) -> float:
        """By how many degrees the largest pressure angle is too large."""
        return excess(task.law, Oscillating(cam.sense, 0.0, l, a, angle), limits, rounds)

    angle = first_fitting(excess_pressure, math.pi)
    if angle is None:
        raise Refused(f"{task.name}: cam.base", f"no base circle keeps the pressure angle at a centre distance of "
                      f"{number_text(a)} and an arm of {number_text(l)}",
                      "another centre distance or arm, or larger angles")
    if angle < ARM_ANGLE:
        raise Refused(f"{task.name}: cam.base", "the pressure angle is never reached, so there is no smallest base "
                      "circle", "a radius")
    return angle


def oscillating_flat(task: Task) -> CamPair:
    """The base circle for a flat face about a pivot."""
    follower, cam = task.follower, task.cam
    a, f = float(follower.distance), float(follower.offset)

    def pair(angle: float) -> FlatOscillating:
        return FlatOscillating(cam.sense, a, f, angle)

    if cam.base != CONVEX:
        sine = (float(cam.base) + f) / a
        if not 0 < sine < 1:
            raise Refused(f"{task.name}: cam.base", f"no face about a pivot at {number_text(a)} touches a circle of "
                          f"{cam.base}", f"a radius below {number_text(a - f)}")
        return pair(math.asin(sine))

    def radius_shortfall(angle: float, rounds: int) -> float:
        """By how much the smallest radius of curvature is too small."""
        return float(cam.least) - smallest_radius(task.law, pair(angle), rounds)[1]

    angle = first_fitting(radius_shortfall, math.pi / 2)
    if angle is None:
        raise Refused(f"{task.name}: cam.base", "no base circle keeps the profile convex",
                      "a longer centre distance, or a smaller stroke")
    return pair(angle)


def first_fitting(over: Callable[[float, int], float], most: float) -> float | None:
    """The least value up to the `most` from which on a function is not above 0: first roughly, then between the two
    values that bound it; None if there is no such value."""
    tried = [most * k / TRIED_ANGLES for k in range(1, TRIED_ANGLES)]
    good = next((k for k, value in enumerate(tried) if over(value, 0) <= 0), None)
    if good is None:
        return None
    low, high = max(0.0, tried[good] - 2 * most / TRIED_ANGLES), tried[min(good + 1, len(tried) - 1)]
    return float(bisect(lambda value: over(float(value), SCAN_ROUNDS) > 0, low, high, BISECTIONS)[1])


def lifts_of(law: Law, one: LawPiece, angles: Any) -> Lifts:
    """The law's derivatives at angles on one piece."""
    return lambda order: law.times * one.value_at(angles, order)


def excess(law: Law, pair: CamPair, limits: Limits, rounds: int = SCAN_ROUNDS) -> float:
    """By how many degrees the pressure angle is too large where it is most so."""
    excesses = [steepest_pressure(law, pair, 1, rounds)[1] - float(limits.rise)]
    if limits.back is not None:
        excesses.append(steepest_pressure(law, pair, -1, rounds)[1] - float(limits.back))
    return max(excesses)


def steepest_pressure(law: Law, pair: CamPair, way: int, rounds: int = SCAN_ROUNDS) -> tuple[float, float]:
    """The angle of the cam and the size, in degrees, of the largest pressure angle of the rise (1) or return (-1)."""

    def leaning(angles: Any, one: LawPiece) -> Any:
        touch = pair.contact(lifts_of(law, one, angles))
        moving = way * one.value_at(angles, 1) > 0
        return np.where(moving, np.degrees(way * touch.pressure), -np.inf)

    return law.extremum(leaning, rounds)


def smallest_radius(law: Law, pair: CamPair, rounds: int = SCAN_ROUNDS) -> tuple[float, float]:
    """The angle of the cam and the size of the smallest radius of curvature where the profile is convex or hollow.

    Of a roller it is that of its centre's path; of a flat face that of the profile, negative where it is hollow.
    """

    def bend(angles: Any, one: LawPiece) -> Any:
        touch = pair.contact(lifts_of(law, one, angles))
        radius = touch.radius + abs(touch.roller - touch.point)
        if isinstance(pair, FlatOscillating | FlatTranslating):
            return -radius
        return np.where(radius > 0, -radius, -np.inf)

    angle, bend_size = law.extremum(bend, rounds)
    return angle, -bend_size
