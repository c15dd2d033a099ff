"""The base circle: the smallest of which the pressure angle, or the convexity of the profile, allows.

At each lift s the derivative x = ds/dphi is laid off square to the path, in the scale of the lifts, to the side to
which the velocity points when it is turned a quarter the way the cam turns. The line from the end of x to the cam's
centre O is parallel to the contact normal: so O lies behind the tangents to the curve x(s) that are inclined to the
path by the largest pressure angle, of the rise on the one side, of the return on the other (Ozols 1974, 20-3,
fig. 20-6, and for an oscillating follower figs. 20-7 and 20-8). In the coordinates of that figure, A0 being the origin
and s upwards, O is (offset, -depth). With a flat face the radius of curvature is r0 + s + s'': the tangent of 45
degrees to the curve z(s), z = s'', cuts the path in the centre of the smallest base circle (Geronimus; figs. 20-9 and
20-10).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from graphplan.cams.follower import CamPair, FlatOscillating, FlatTranslating, Lifts, Oscillating, Translating
from graphplan.cams.law import SCAN_ROUNDS, Law, LawPiece
from graphplan.cams.task import CONVEX, PRESSURE, SMALLEST, Limits, Task
from graphplan.cams.tolerances import ARM_ANGLE
from graphplan.errors import Refused
from graphplan.mechanism.numbers import number_text

TRIED_ANGLES, BISECTIONS = 180, 48  # angles of an arm that are tried, before the best is searched between two of them


@dataclass(frozen=True)
class Tangent:
    """A tangent to the curve x(s): the angle of the cam where it touches, and how far it passes A0, laid off as x."""

    angle: float
    intercept: float
    slope: float  # tan of the pressure angle; of the return it is inclined the other way

    @property
    def depth(self) -> float:
        """How deep under A0 it cuts the path."""
        return self.intercept / self.slope


@dataclass(frozen=True)
class Region:
    """Where the cam's centre may lie: behind the tangent of the rise and, if the return is limited, behind its own."""

    rise: Tangent
    back: Tangent | None

    def depth(self, offset: float) -> float:
        """How deep under A0 the centre must lie at an offset."""
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
    """Where a flat face on a straight path needs it most, and the radius at which the profile has a point there."""
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
    values that bound it; None where there is none."""
    tried = [most * k / TRIED_ANGLES for k in range(1, TRIED_ANGLES)]
    good = next((k for k, value in enumerate(tried) if over(value, 0) <= 0), None)
    if good is None:
        return None
    low, high = max(0.0, tried[good] - 2 * most / TRIED_ANGLES), tried[min(good + 1, len(tried) - 1)]
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (low, middle) if over(middle, SCAN_ROUNDS) <= 0 else (middle, high)
    return high


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
