"""A cam under load: the force triangle of its follower, what its guide bears, when it jams, and the spring.

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
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np

from graphplan.cams.law import LawPiece
from graphplan.cams.profile import Cam, make_cam
from graphplan.cams.task import Task
from graphplan.cams.tolerances import LEAST_LIFT
from graphplan.errors import SceneError
from graphplan.mechanism.fields import Faults
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.units import METRES

PARTS = 400  # of a piece of the law, for what is integrated


class ContactSpring(NamedTuple):
    """A spring that keeps contact: its stiffness in N a length, its force where the follower is lowest, the least such
    force that keeps contact, and the angle of the cam at which it is needed, where contact is nearest to loss."""

    stiffness: float
    preload: float
    least_preload: float
    nearest_to_loss: float


class FollowerForces(NamedTuple):
    """What acts at some angles, arrays: along the path spring and inertia, the contact force, those of the nearer and
    the further bearing, friction, and the moment on the cam in the sense in which it turns."""

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
        """That of the line through the given preload which touches the curve of what the spring must push, over the
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
        """What a spring must push at least, so that the follower stays on the cam: -(Q + m a)."""
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
        """How much of what drives the follower friction in the guide takes: where it is all, the follower jams."""
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
        """One of the forces at angles on a piece of the law."""
        return getattr(self.forces(angles, one), name)

    @property
    def work_lost(self) -> float:
        """What friction takes of a turn, in J, by integration; so much the moment on the cam gives."""
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
