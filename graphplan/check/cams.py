"""A cam's second opinions: the drawn inversion against the contact formula, curvature and law against numbers
differentiated, and the scene of the cam, solved by the analytic solver, against the law.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from graphplan.cams.construction import CamDrawing
from graphplan.cams.exports import END, FOLLOWER, motion, scene_text
from graphplan.cams.law import ORDERS, Stretch
from graphplan.cams.profile import Cam
from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.tolerances import CAM_STEP, CAM_TOL
from graphplan.mechanism.scene import parse
from graphplan.solver import solve

MIN_PIECE_STEPS = 400  # of them at least in a piece of the law
STENCIL = np.array([1, -8, 0, 8, -1]) / 12  # of five neighbours


def check_cam(drawing: CamDrawing) -> dict[str, float]:
    """By how much the opinions differ, relative to what each is compared with.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where opinions differ by more
    than rounding or numerical differentiation.
    """
    cam = drawing.cam
    require_claims(cam.task.name, drawing)
    angles = np.array([one.angle for one in drawing.divisions])
    found = {"points": float(max(abs(np.array(drawing.at("K")) - cam.on_cam(angles)))) / cam.pair.base,
             "motion": max(_motion_gap(cam, float(angle)) for angle in angles),
             "curvature": _curvature_gap(cam), "law": _law_gap(cam)}
    for quantity, gap in found.items():
        require_agreement(cam.task.name, {quantity: gap}, CAM_TOL[quantity], by="by the second opinion")
    return found


def _motion_gap(cam: Cam, angle: float) -> float:
    """By how much the solver's velocity and acceleration of the follower differ from the law's, beside those of a point
    of the cam as far out as the base circle, or the cam's turning, or beside the largest where that is larger."""
    rates, wanted, omega = solve(parse(scene_text(cam, angle), cam.task.name)), motion(cam, angle), cam.task.cam.omega
    if cam.task.follower.oscillates:
        size, solved = 1.0, (rates.omega[FOLLOWER], rates.alpha[FOLLOWER])
    else:
        size, solved = cam.pair.base, (rates.velocity[END][1], rates.acceleration[END][1])
    gaps = [abs(float(one) - law) for one, law in zip(solved, wanted, strict=True)]
    sizes = (max(size, cam.law.largest(order)) * omega**order for order in (1, 2))
    return max(gap / size for gap, size in zip(gaps, sizes, strict=True))


def _stencil_angles(one: Stretch) -> tuple[Any, float]:
    """Angles inside a piece of the law in rows of five neighbours, in degrees, and their distance in radians."""
    low, high = float(one.start), float(one.end)
    step = min(CAM_STEP, np.radians(high - low) / MIN_PIECE_STEPS)
    edge = 3 * np.degrees(step)
    return np.linspace(low + edge, high - edge, 7)[:, None] + np.degrees(step) * np.arange(-2, 3), step


def _curvature_gap(cam: Cam) -> float:
    """The curvature of the profile against the turning of its normal over the way of its points, times the radius of
    the base circle; and how far that way is from being square to the normal."""
    worst = 0.0
    for one in cam.law.stretches:
        angles, step = _stencil_angles(one)
        touch = cam.touched(one, angles)
        spots, normals = (cam.pair.turned(vectors, angles) for vectors in (touch.point, touch.normal))
        way, turning = spots @ STENCIL / step, normals @ STENCIL / step
        own, n = touch.radius[:, 2], normals[:, 2]
        across, along = (way / n).real, (way / n).imag
        turned = (turning / n).imag
        gap = abs(along / turned - own) / (abs(own) + cam.pair.base)
        worst = max(worst, float(gap.max()), float(abs(across).max()) / cam.pair.base)
    return worst


def _law_gap(cam: Cam) -> float:
    """Each derivative of the law against the one before it, differentiated, beside the largest."""
    worst = 0.0
    for order in range(1, ORDERS):
        rows = [(one, *_stencil_angles(one)) for one in cam.law.stretches]
        size = max(float(abs(one.at(angles, order)).max()) for one, angles, _ in rows) or 1.0
        for one, angles, step in rows:
            sloped = one.at(angles, order - 1) @ STENCIL / step
            worst = max(worst, float(abs(sloped - one.at(angles[:, 2], order)).max()) / size)
    return worst
