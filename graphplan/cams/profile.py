"""The profile of a cam by inversion, what presses on it, and its outline in arcs.

Where the velocity jumps up the roller stands still in its corner, and the profile has an arc of its radius there, or
under a flat face a straight line; where it jumps down no roller and no face can follow.

A follower on a straight path has the load Q against the rise, its inertia force -m a and its spring T = T_0 + c s along
the path, the contact force N along the normal, at the pressure angle theta, and the forces of two bearings, `bearing`
apart, of which the nearer is `overhang` off where the follower touches at first. What presses a point or roller across
is R = N sin theta; the bearings bear R'' = R a/b and R' = R + R'', so that friction takes f R (1 + 2 a/b) (Ozols 1974,
11-1, fig. 11-1, and (14.22)). A flat face bears N aside by x = ds/dphi: R' = R'' = N x/b (14.19). The spring keeps
contact where it pushes more than inertia and load pull (20-5, fig. 20-16). Where spring and load would have the contact
pull, the follower leaves the cam. In N, kg and N m.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import Any, NamedTuple

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
from graphplan.cams.tolerances import ANGLE_TOL_DEG, FLAT_ARC, LEAST_LIFT, LENGTH_TOL
from graphplan.errors import GraphplanError, SceneError
from graphplan.mechanism.fields import Faults
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.units import METRES
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
        """Contact at angles in degrees; between pieces of the law that of the second."""
        turned = np.asarray(angles, float)
        return self.pair.contact(lambda order: self.law.value_at(turned, order))

    def contact_on(self, one: LawPiece, angles: Array) -> CamContact:
        """Contact at angles on one piece of the law."""
        return self.pair.contact(lifts_of(self.law, one, np.asarray(angles, float)))

    def on_cam(self, angles: Array) -> Array:
        """The profile's points at angles, in the plane of the cam as it lies before it turns."""
        return self.pair.to_cam_plane(self.contact(angles).point, np.asarray(angles, float))

    def pitch(self, angles: Array) -> Array:
        """The centre of the roller there."""
        return self.pair.to_cam_plane(self.contact(angles).roller, np.asarray(angles, float))

    @property
    def outline(self) -> Array:
        """Points of the closed profile, some for each degree."""
        return self.closed_curve(lambda touch: touch.point)

    @property
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
        """The outline as arcs, each within the tolerance of the profile; one begins where the last ends."""
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
        """Joint of two pieces at a jump of the velocity: an arc of the roller, or a straight line."""
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
        """Range of the contact along a flat face: from the foot of the path or of the pivot."""
        touch = self.contact(np.linspace(0, 360, 1441))
        along = (touch.point - float(self.task.follower.distance)) / (1j * touch.normal)
        return float(along.real.min()), float(along.real.max())

    @property
    def notes(self) -> tuple[Said, ...]:
        """Remarks on a cam that can be made."""
        return (*self._shocks(), *self._leaning())

    def _shocks(self) -> Iterator[Said]:
        """Yield the angles at which derivatives of the law jump."""
        for order, words in ((HARD, HARD_SHOCK), (SOFT, SOFT_SHOCK)):
            angles = [digits(float(jump.angle)) for jump in self.law.jumps if jump.order == order]
            if angles:
                yield words(join(arrange("{0}°", angle) for angle in angles))

    def _leaning(self) -> Iterator[Said]:
        """Yield pressure angles beyond the usual ones, if the task sets no limit."""
        if self.task.cam.limits is None:
            names = said("the rise"), said("the return")
            for sense, usual, name in zip((1, -1), USUAL_PRESSURE_DEG[self.task.follower.oscillates], names,
                                          strict=True):
                angle, pressure = self.steepest[sense]
                if pressure > usual + ANGLE_TOL_DEG:
                    yield said("at {0}° the pressure angle of {1} is {2}°; as a rule it is {3}° at most",
                               digits(angle), name, digits(pressure), digits(usual))


def arc_bulge(start: complex, middle: complex, end: complex) -> float:
    """Bulge of the arc through three points to the right of its chord, as a part of half of it."""
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
    """Largest distance of spots from the arc between the first and the last of them."""
    start, half = complex(spots[0]), complex(spots[-1] - spots[0]) / 2
    if abs(half) == 0:
        return float(max(abs(spots - start)))
    deviation = (spots - start) / half - 1
    if bulge == 0.0:
        return float(max(abs(deviation.imag)) * abs(half))
    centre = 1j * (1 - bulge**2) / (2 * bulge)
    return float(max(abs(abs(deviation - centre) - abs(1 - centre))) * abs(half))


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
    """Base circle that keeps the pressure angles; those of a flat face are independent of it."""
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
    """Base circle that keeps the profile convex."""
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
    """Self-intersection of a closed curve; None if no loop of it is larger than rounding of its extent.

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


PARTS = 400  # of a piece of the law, for what is integrated


class ContactSpring(NamedTuple):
    """A spring that keeps contact: its stiffness in N a length, its force where the follower is lowest, the least such
    force that keeps contact, and the angle of the cam at which it is needed, where contact is nearest to loss."""

    stiffness: float
    preload: float
    least_preload: float
    nearest_to_loss: float


class FollowerForces(NamedTuple):
    """Forces at some angles, arrays: along the path spring and inertia, the contact force, those of the nearer and the
    further bearing, friction, and the moment on the cam in the sense in which it turns."""

    spring: Any
    inertia: Any
    contact: Any
    near: Any
    far: Any
    friction: Any
    moment: Any


class LoadedCam:
    """A cam whose task has a load."""

    def __init__(self, cam: Cam):
        assert cam.task.load is not None
        self.cam, self.law, self.metres = cam, cam.law, float(METRES[cam.task.units.length])
        *numbers, self.stiffness, self.preload = cam.task.load
        self.force, self.mass, self.overhang, self.bearing, self.coefficient = map(float, numbers)

    @cached_property
    def spring(self) -> ContactSpring:
        """The spring as it is given; of a preload alone the softest that keeps contact, else that of least preload."""
        c = float(self.stiffness) if self.stiffness is not None else self.least_stiffness
        at, least = self.law.extremum(lambda angles, one: self.lack(angles, one) - c * one.value_at(angles))
        return ContactSpring(c, max(0.0, least) if self.preload is None else float(self.preload), least + 0.0, at)

    @property
    def least_stiffness(self) -> float:
        """Stiffness of the line through the given preload which touches the curve of the needed spring force, over the
        lift; 0 without a preload."""
        if self.preload is None:
            return 0.0
        preload, lowest = float(self.preload), LEAST_LIFT * self.law.largest(0)

        def slope(angles: Any, one: LawPiece) -> Any:
            lift = one.value_at(angles)
            return np.where(lift > lowest, (self.lack(angles, one) - preload) / np.maximum(lift, lowest), 0.0)

        return max(0.0, self.law.extremum(slope)[1])

    @property
    def keeps_contact(self) -> bool:
        """Whether spring and load press the follower to the cam over the whole turn."""
        least = self.spring.least_preload
        return self.spring.preload >= least - LEAST_LIFT * abs(least)

    def lack(self, angles: Any, one: LawPiece) -> Any:
        """Least spring force that keeps the follower on the cam: -(Q + m a)."""
        return -self.force - self.mass * one.value_at(angles, 2) * self.cam.task.cam.omega**2 * self.metres

    def _bearings(self, angles: Any, one: LawPiece) -> tuple[Any, Any, Any]:
        """Of a contact force of 1 the part along the path, and what the nearer bearing and the further one bear."""
        s, x = one.value_at(angles), one.value_at(angles, 1)
        if self.cam.task.follower.flat:
            return 1.0 + 0 * s, x / self.bearing, x / self.bearing
        pressure = self.cam.contact_on(one, angles).pressure
        across, arm = np.sin(pressure), (self.overhang - s) / self.bearing
        return np.cos(pressure), across * (1 + arm), across * arm

    def jamming(self, angles: Any, one: LawPiece) -> Any:
        """Share of the driving force that friction in the guide takes: at 1 the follower jams."""
        along, near, far = self._bearings(angles, one)
        return self.coefficient * (abs(near) + abs(far)) / along * (one.value_at(angles, 1) > 0)

    def jamming_angle(self, angle: float) -> float:
        """The pressure angle in degrees at which a point or roller jams there: cot theta = f (1 + 2 a/b)."""
        overhang = self.overhang - float(self.law.value_at([angle])[0])
        return math.degrees(math.atan2(1, self.coefficient * (1 + 2 * overhang / self.bearing)))

    def forces(self, angles: Any, one: LawPiece) -> FollowerForces:
        """All forces at angles on one piece of the law."""
        c, preload, *_ = self.spring
        v, (along, near, far) = one.value_at(angles, 1), self._bearings(angles, one)
        spring, lack = preload + c * one.value_at(angles), self.lack(angles, one)
        pushed = spring - lack  # where this is negative, the contact would have to pull
        moves = np.sign(v) * (np.abs(v) > LEAST_LIFT * self.law.largest(1))
        rubs = self.coefficient * moves * np.sign(pushed) * (abs(near) + abs(far))
        contact = pushed / (along - rubs)
        return FollowerForces(spring, lack + self.force, contact, contact * near, contact * far, contact * rubs,
                              contact * along * v * self.metres)

    def forces_at(self, angle: float) -> FollowerForces:
        """All forces at one angle in degrees; where two pieces of the law meet, those as the second begins."""
        turned = angle % 360
        piece = next(one for one in self.law.stretches[::-1] if float(one.start) <= turned)
        return FollowerForces(*(float(value[0]) for value in self.forces(np.array([turned]), piece)))

    def largest(self, name: str) -> tuple[float, float]:
        """The angle at which one of the forces is largest, whichever way it acts, and that force."""
        force = partial(self.force_named, name)
        (at, most), (foot, depth) = self.law.extremum(force), self.law.extremum(lambda *where: -force(*where))
        return (at, most) if most >= depth else (foot, -depth)

    def force_named(self, name: str, angles: Any, one: LawPiece) -> Any:
        """The force of this name at angles of the cam on a piece of the law."""
        return getattr(self.forces(angles, one), name)

    @property
    def work_lost(self) -> float:
        """Work of friction in a turn, in J, by integration; equal to that of the moment on the cam."""
        return self.metres * sum(float(np.trapezoid(self.force_named("friction", angles, one) * one.value_at(angles, 1),
                                                    np.radians(angles)))
                                 for one in self.law.stretches for angles in [one.divide(PARTS)])


def make_loaded_cam(task: Task) -> Cam:
    """The cam of a task, as `make_cam` has it; fails with `SceneError` also where its follower jams, or where no spring
    with the preload that is given keeps it on the cam."""
    cam, faults = make_cam(task), Faults()
    if task.load:
        loaded = LoadedCam(cam)
        check_jamming(loaded, faults)
        if loaded.stiffness is None and not loaded.keeps_contact:
            at, least = (number_text(number) for number in loaded.spring[:1:-1])
            faults.add("load.preload", f"at {at} degrees, where the follower is lowest, it leaves the cam",
                       f"a preload of {least} N or more")
    if len(faults):
        raise SceneError(task.name, tuple(faults))
    return cam


def check_jamming(loaded: LoadedCam, faults: Faults) -> None:
    """Note where friction in the guide takes all that drives the follower."""
    at, share = loaded.law.extremum(loaded.jamming)
    if share >= 1:
        limit = "" if loaded.cam.task.follower.flat else (
            f", as from a pressure angle of {number_text(loaded.jamming_angle(at))} degrees on")
        faults.add("load.friction", f"at {number_text(at)} degrees the follower jams in its guide{limit}",
                   "less friction or overhang, a longer guide, or a larger base circle")
