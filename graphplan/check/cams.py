"""A cam's second opinions: the drawn inversion against the contact formula, curvature and law against numbers
differentiated, and the scene of the cam, solved by the analytic solver, against the law.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from graphplan.cams.construction import CamDrawing
from graphplan.cams.motions import ORDERS
from graphplan.cams.pose import END, FOLLOWER, motion, scene_text
from graphplan.cams.profile import Cam
from graphplan.errors import BrokenClaim, Disagreement
from graphplan.kernel.claims import broken
from graphplan.mechanism.scene import parse
from graphplan.solver import solve

STEP = 1e-3  # radians of the cam between numbers that are differentiated
CLOSE = {"points": 1e-11, "motion": 1e-11, "curvature": 1e-5, "law": 1e-6}  # by so much opinions may differ
STENCIL = np.array([1, -8, 0, 8, -1]) / 12, np.array([-1, 16, -30, 16, -1]) / 12


def checked(drawing: CamDrawing) -> dict[str, float]:
    """By how much the opinions differ, relative to what each is compared with.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where opinions differ by more
    than rounding or numerical differentiation.
    """
    cam = drawing.cam
    if fault := next(broken(drawing.program, drawing.values), ""):
        raise BrokenClaim(cam.task.name, fault)
    angles = np.array([one.angle for one in drawing.divisions])
    found = {"points": float(max(abs(np.array(drawing.at("K")) - cam.on_cam(angles)))) / cam.pair.base,
             "motion": max(_moved(cam, float(angle)) for angle in angles),
             "curvature": _curvature(cam), "law": _law(cam)}
    for what, size in found.items():
        if not size <= CLOSE[what]:
            raise Disagreement(cam.task.name, what, "otherwise", "by the second opinion", size)
    return found


def _moved(cam: Cam, angle: float) -> float:
    """By how much the solver's velocity and acceleration of the follower differ from the law's, beside those of a point
    of the cam as far out as the base circle, or beside the cam's turning where the follower turns."""
    rates, wanted, omega = solve(parse(scene_text(cam, angle), cam.task.name)), motion(cam, angle), cam.task.cam.omega
    if cam.task.follower.oscillates:
        size, solved = 1.0, (rates.omega[FOLLOWER], rates.alpha[FOLLOWER])
    else:
        size, solved = cam.pair.base, (rates.velocity[END][1], rates.acceleration[END][1])
    gaps = [abs(float(one) - law) for one, law in zip(solved, wanted, strict=True)]
    return max(gap / (size * omega**order) for order, gap in enumerate(gaps, 1))


def _inner(cam: Cam) -> Mapping[Any, Any]:
    """Angles well inside each piece of the law, in degrees, by piece."""
    edge = np.degrees(3 * STEP)
    return {one: np.linspace(float(one.start) + edge, float(one.end) - edge, 7) for one in cam.law.stretches}


def _curvature(cam: Cam) -> float:
    """The curvature of the profile against that of its points, times the radius of the base circle."""
    worst = 0.0
    for one, angles in _inner(cam).items():
        near = angles[:, None] + np.degrees(STEP) * np.arange(-2, 3)
        spots = cam.pair.turned(cam.touched(one, near).point, near)
        first, second = spots @ STENCIL[0] / STEP, spots @ STENCIL[1] / STEP**2
        bend = -cam.pair.sense * (first.conjugate() * second).imag / abs(first) ** 3
        own = 1 / cam.touched(one, angles).radius
        worst = max(worst, float((abs(bend - own) / (abs(own) + 1 / cam.pair.base)).max()))
    return worst


def _law(cam: Cam) -> float:
    """Each derivative of the law against the one before it, differentiated, beside the largest."""
    worst = 0.0
    for order in range(1, ORDERS):
        size = max(float(abs(one.at(angles, order)).max()) for one, angles in _inner(cam).items()) or 1.0
        for one, angles in _inner(cam).items():
            near = angles[:, None] + np.degrees(STEP) * np.arange(-2, 3)
            sloped = one.at(near, order - 1) @ STENCIL[0] / STEP
            worst = max(worst, float(abs(sloped - one.at(angles, order)).max()) / size)
    return worst
