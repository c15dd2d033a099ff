"""The profile: the envelope of the roller's circles or of the flat face, seen from the cam, and what forbids it.

Where the velocity jumps up the roller stands still in its corner, and the profile has an arc of its radius there, or
under a flat face a straight line; where it jumps down no roller and no face can follow.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.cams.base import (
    CamContact,
    CamPair,
    Flat,
    Rolled,
    least_flat,
    lifts_of,
    pair_with_base,
    smallest_radius,
    steepest_pressure,
)
from graphplan.cams.law import HARD, SOFT, Law, LawPiece
from graphplan.cams.task import CONVEX, POINTED, PRESSURE, Task
from graphplan.cams.tolerances import ANGLE_TOL_DEG, FLAT_ARC, LENGTH_TOL
from graphplan.errors import GraphplanError, SceneError
from graphplan.mechanism.fields import Faults
from graphplan.mechanism.numbers import number_text
from graphplan.phrases import Said, arrange, digits, join, phrase, said

Array = Any
SAMPLES_PER_DEGREE = 4  # samples for a degree where crossings are looked for
HALF_ARC_SAMPLES, SAMPLING_MARGIN = 16, 1.02  # samples of half an arc; by so much more it may be off between them
STRAIGHT_PARTS = 1e12  # of half a chord: an arc whose centre is further away is its chord
MAX_ARC_DEG = 90.0  # degrees: no arc of the outline is longer than this part of the turn
# pressure angles of rise and return, as a rule; by oscillating
USUAL_PRESSURE_DEG = {False: (30.0, 60.0), True: (45.0, 70.0)}
HARD_SHOCK = phrase("at {0} the velocity jumps: a hard shock, the acceleration is infinite")
SOFT_SHOCK = phrase("at {0} the acceleration jumps: a soft shock")


@dataclass(frozen=True)
class ArcOfProfile:
    """A piece of the outline: where it begins, and how far it bulges to the right, as a part of half its chord."""

    start: complex
    bulge: float


@dataclass(frozen=True)
class Cam:
    """A cam that follows its law: its task, and the pair of cam and follower with the base circle known."""

    task: Task
    pair: CamPair

    @property
    def law(self) -> Law:
        return self.task.law

    @property
    def roller(self) -> float:
        """The radius of the roller, or 0."""
        return float(self.task.follower.radius)

    def contact(self, angles: Array) -> CamContact:
        """How they touch at angles in degrees; where pieces of the law meet, as at the beginning of the second."""
        turned = np.asarray(angles, float)
        return self.pair.contact(lambda order: self.law.value_at(turned, order))

    def contact_on(self, one: LawPiece, angles: Array) -> CamContact:
        """The same at angles on one piece of the law."""
        return self.pair.contact(lifts_of(self.law, one, np.asarray(angles, float)))

    def on_cam(self, angles: Array) -> Array:
        """The profile's points at angles, in the plane of the cam as it lies before it turns."""
        return self.pair.to_cam_plane(self.contact(angles).point, np.asarray(angles, float))

    def pitch(self, angles: Array) -> Array:
        """The centre of the roller there."""
        return self.pair.to_cam_plane(self.contact(angles).roller, np.asarray(angles, float))

    @cached_property
    def outline(self) -> Array:
        """Points of the closed profile, some for each degree."""
        return self.closed_curve(lambda touch: touch.point)

    @cached_property
    def pitch_curve(self) -> Array:
        """Points of the closed path of the roller's centre."""
        return self.closed_curve(lambda touch: touch.roller)

    def closed_curve(self, spot: Callable[[CamContact], Array]) -> Array:
        spots = []
        for stretch in self.law.stretches:
            count = max(2, math.ceil(float(stretch.end - stretch.start) * SAMPLES_PER_DEGREE))
            angles = stretch.divide(count)
            spots.append(self.pair.to_cam_plane(spot(self.contact_on(stretch, angles)), angles))
        return np.concatenate(spots)

    # ---- true to size ----------------------------------------------------------------------------------------------

    def arcs(self, tolerance: float) -> list[ArcOfProfile]:
        """The outline as arcs, none further from the profile than the tolerance; one begins where the last ends."""
        arcs, stretches = list[ArcOfProfile](), self.law.stretches
        for stretch, after in zip(stretches, (*stretches[1:], stretches[0]), strict=True):
            steps = max(1, math.ceil(float(stretch.end - stretch.start) / MAX_ARC_DEG))
            for low, high in pairwise(map(float, stretch.divide(steps))):
                arcs += self.fit_arcs(stretch, low, high, tolerance)
            arcs += self._corner(stretch, after)
        return arcs

    def fit_arcs(self, one: LawPiece, low: float, high: float, tolerance: float) -> Iterator[ArcOfProfile]:
        """Arcs through the ends and the middle of parts of a piece, halved until they are close enough."""
        angles = np.linspace(low, high, 2 * HALF_ARC_SAMPLES + 1)
        spots = self.pair.to_cam_plane(self.contact_on(one, angles).point, angles)
        bulge = arc_bulge(*spots[::HALF_ARC_SAMPLES])
        if SAMPLING_MARGIN * arc_deviation(spots, bulge) <= tolerance or high - low < ANGLE_TOL_DEG:
            yield ArcOfProfile(complex(spots[0]), bulge)
            return
        yield from self.fit_arcs(one, low, (low + high) / 2, tolerance)
        yield from self.fit_arcs(one, (low + high) / 2, high, tolerance)

    def _corner(self, one: LawPiece, after: LawPiece) -> list[ArcOfProfile]:
        """What joins two pieces where the velocity jumps: an arc of the roller, or a straight line."""
        angle = np.array([float(one.end)])
        touch = self.contact_on(one, angle)
        start, centre = (complex(self.pair.to_cam_plane(spot, angle)[0]) for spot in (touch.point, touch.roller))
        angle = np.array([float(after.start)])
        end = complex(self.pair.to_cam_plane(self.contact_on(after, angle).point, angle)[0])
        if abs(end - start) < LENGTH_TOL * self.pair.base:
            return []
        if not self.roller:
            return [ArcOfProfile(start, 0.0)]
        out = start + end - 2 * centre
        return [ArcOfProfile(start, arc_bulge(start, centre + self.roller * out / abs(out), end))]

    # ---- what is told ----------------------------------------------------------------------------------------------

    @cached_property
    def steepest(self) -> dict[int, tuple[float, float]]:
        """The angle and size of the largest pressure angle of the rise (1) and of the return (-1), in degrees."""
        return {sense: steepest_pressure(self.law, self.pair, sense) for sense in (1, -1)}

    @cached_property
    def narrowest(self) -> tuple[float, float]:
        """The angle and size of the smallest radius of curvature, of the roller's path where that is convex."""
        return smallest_radius(self.law, self.pair)

    @property
    def reach(self) -> tuple[float, float]:
        """How far the contact wanders along a flat face: from the foot of the path or of the pivot."""
        touch = self.contact(np.linspace(0, 360, 1441))
        along = (touch.point - float(self.task.follower.distance)) / (1j * touch.normal)
        return float(along.real.min()), float(along.real.max())

    @cached_property
    def notes(self) -> tuple[Said, ...]:
        """What is worth knowing, though the cam can be made."""
        return (*self._shocks(), *self._leaning())

    def _shocks(self) -> Iterator[Said]:
        """Where derivatives of the law jump."""
        for order, words in ((HARD, HARD_SHOCK), (SOFT, SOFT_SHOCK)):
            angles = [digits(float(jump.angle)) for jump in self.law.jumps if jump.order == order]
            if angles:
                yield words(join(arrange("{0}°", angle) for angle in angles))

    def _leaning(self) -> Iterator[Said]:
        """Pressure angles beyond those that are usual, where nothing is said of them."""
        if self.task.cam.limits is None:
            names = said("the rise"), said("the return")
            for sense, usual, name in zip((1, -1), USUAL_PRESSURE_DEG[self.task.follower.oscillates], names,
                                          strict=True):
                angle, pressure = self.steepest[sense]
                if pressure > usual + ANGLE_TOL_DEG:
                    yield said("at {0}° the pressure angle of {1} is {2}°; as a rule it is {3}° at most",
                               digits(angle), name, digits(pressure), digits(usual))


def arc_bulge(start: complex, middle: complex, end: complex) -> float:
    """How far the arc through three points bulges to the right of its chord, as a part of half of it."""
    half = (end - start) / 2
    if abs(half) == 0:
        return 0.0
    x, y = ((middle - start) / half - 1).real, ((middle - start) / half - 1).imag
    # the circle through -1, 1 and x + iy has its centre on the axis of ordinates
    if abs(y) < FLAT_ARC:
        return 0.0
    centre = (x * x + y * y - 1) / (2 * y)
    radius = math.hypot(1, centre)
    return -(centre + math.copysign(radius, y)) if abs(centre) < STRAIGHT_PARTS else 0.0


def arc_deviation(spots: Array, bulge: float) -> float:
    """How far spots lie from the arc between the first and the last of them."""
    start, half = complex(spots[0]), complex(spots[-1] - spots[0]) / 2
    if abs(half) == 0:
        return float(max(abs(spots - start)))
    deviation = (spots - start) / half - 1
    if bulge == 0.0:
        return float(max(abs(deviation.imag)) * abs(half))
    centre = 1j * (1 - bulge**2) / (2 * bulge)
    return float(max(abs(abs(deviation - centre) - abs(1 - centre))) * abs(half))


# ---- what forbids it ------------------------------------------------------------------------------------------------


def make_cam(task: Task) -> Cam:
    """The cam of a task; fails with `SceneError`, a line for each reason why it cannot be made."""
    cam, faults = Cam(task, pair_with_base(task)), Faults()
    check_pressure(cam, faults)
    if isinstance(cam.pair, Flat):
        check_convexity(cam, faults)
    else:
        check_undercut(cam, faults)
    if not len(faults):
        check_crossing(cam, faults)
        check_pivot(cam, faults)
    if len(faults):
        raise SceneError(task.name, tuple(faults))
    return cam


def check_pressure(cam: Cam, faults: Faults) -> None:
    """Note pressure angles beyond those that are allowed."""
    limits = cam.task.cam.limits
    if limits is None or (cam.task.follower.flat and not cam.task.follower.oscillates):
        return
    for key, sense, most in (("rise", 1, limits.rise), ("return", -1, limits.back)):
        angle, pressure = cam.steepest[sense]
        if most is not None and pressure > float(most) + ANGLE_TOL_DEG:
            text = f"at {number_text(angle)} degrees it is {number_text(pressure)}, above {number_text(most)}"
            faults.add(f"cam.pressure_angle.{key}", text, larger_base(cam.task))


def larger_base(task: Task) -> str:
    """Which base circle keeps the pressure angles; those of a flat face do not hang on it."""
    if task.follower.flat:
        return "a smaller stroke, or a larger angle"
    try:
        least = pair_with_base(replace(task, cam=replace(task.cam, base=PRESSURE))).base
    except GraphplanError:
        return "a larger angle"
    return f"a base circle of {number_text(math.ceil(least * 1000) / 1000)} or more, or a larger angle"


def check_drops(cam: Cam, what: str, faults: Faults) -> None:
    """Note where the velocity jumps down: only a point follows."""
    for jump in cam.law.jumps:
        if jump.order == HARD and jump.after < jump.before:
            faults.add("law", f"at {number_text(jump.angle)} degrees the velocity drops at once, which no "
                       f"{what} follows", "a motion that comes to rest, or a point that touches")


def check_convexity(cam: Cam, faults: Faults) -> None:
    """Note where a flat face cannot follow: the profile would be hollow or pointed, or the face overtakes the cam."""
    check_drops(cam, "flat face", faults)
    angle, radius = cam.narrowest
    least = float(cam.task.cam.least)
    nothing = LENGTH_TOL * cam.pair.base
    if radius < least - nothing or (radius <= nothing and cam.task.cam.base != CONVEX):
        why = "it is hollow there, so that the face loses it" if radius < -nothing else "it is too narrow"
        text = f"at {number_text(angle)} degrees the profile's radius of curvature is {number_text(radius)}: {why}"
        faults.add("cam.base", text, convex_base(cam))


def convex_base(cam: Cam) -> str:
    """Which base circle keeps the profile convex."""
    if cam.task.follower.oscillates:
        return 'base = "convex"'
    least = least_flat(cam.law)[1] + float(cam.task.cam.least)
    return f'more than {number_text(least)}, or base = "convex"'


def check_undercut(cam: Cam, faults: Faults) -> None:
    """Note where a roller is too large for the path of its centre."""
    follower, least = cam.task.follower, float(cam.task.cam.least)
    if follower.contact != POINTED:
        check_drops(cam, "roller", faults)
    angle, radius = cam.narrowest
    if radius <= cam.roller + LENGTH_TOL * cam.pair.base:
        faults.add("follower.radius", f"at {number_text(angle)} degrees the path of the roller's centre has the "
                   f"radius of curvature {number_text(radius)}: a roller of {number_text(cam.roller)} undercuts the "
                   "profile",
                   f"half of it, {number_text(radius / 2)}, or a larger base circle")
    elif radius - cam.roller < least - LENGTH_TOL * cam.pair.base:
        faults.add("cam.least_radius", f"at {number_text(angle)} degrees the profile's radius of curvature is "
                   f"{number_text(radius - cam.roller)}, below {number_text(least)}",
                   "a smaller roller, or a larger base circle")


def check_pivot(cam: Cam, faults: Faults) -> None:
    """Note where the pivot of a follower is in the way of the cam, or the contact beyond it."""
    follower = cam.task.follower
    if not follower.oscillates:
        return
    far, distance = float(abs(cam.outline).max()), float(follower.distance)
    if far >= distance:
        faults.add("follower.centre_distance", f"the profile reaches out to {number_text(far)}, over the pivot at "
                   f"{number_text(distance)}", "a longer centre distance, or a smaller base circle")
    elif follower.flat and cam.reach[0] <= 0:
        faults.add("follower.centre_distance",
                   f"the contact runs to {number_text(cam.reach[0])} along the face, past the "
                   "pivot", "a longer centre distance, or a smaller stroke")


def check_crossing(cam: Cam, faults: Faults) -> None:
    """Note where the profile, or the path of the roller's centre, crosses itself."""
    curves = [("cam.base", "the path of the roller's centre", cam.pitch_curve)] if isinstance(cam.pair, Rolled) else []
    for place, name, curve in [*curves, ("cam.base", "the profile", cam.outline)]:
        if crossing := _self_crossing(curve):
            faults.add(place, f"{name} crosses itself at ({number_text(crossing.real)}, {number_text(crossing.imag)})",
                       "a larger base circle, or a smaller roller")
            return


def _self_crossing(curve: Array) -> complex | None:
    """Where a closed curve crosses itself; None where no loop of it is larger than rounding of its extent.

    Where pieces of the law meet, the end of one may lie beyond the beginning of the next by rounding.
    """
    import shapely

    ring = shapely.LinearRing(np.column_stack((curve.real, curve.imag)))
    loops = shapely.get_parts(shapely.polygonize([shapely.node(ring)]))
    sizes = [math.dist((low, left), (high, right)) for low, left, high, right in shapely.bounds(loops)]
    least = LENGTH_TOL * float(np.ptp(curve.real) + np.ptp(curve.imag))
    large = sorted((area, k) for k, area in enumerate(sizes) if area > least)
    if len(large) < 2:
        return None
    (_, smallest), *smaller = large
    boundary = shapely.union_all(loops[[k for _, k in smaller]]).boundary
    return complex(*shapely.shortest_line(loops[smallest].boundary, boundary).coords[0])
