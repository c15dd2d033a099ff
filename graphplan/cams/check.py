"""The independent checks of a cam: the drawn inversion against the contact formula, curvature and law against numbers
differentiated, and the scene of the cam, solved by the analytic solver, against the law.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from graphplan.cams.construction import CamDrawing
from graphplan.cams.exports import END, FOLLOWER, law_motion, scene_text
from graphplan.cams.law import ORDERS, LawPiece
from graphplan.cams.profile import Cam, LoadedCam
from graphplan.check.compared import require_agreement, require_claims
from graphplan.check.tolerances import CAM_STEP, CAM_TOL
from graphplan.mechanism.scene import parse
from graphplan.solver import solve, with_friction
from graphplan.solver.statics import force

MIN_PIECE_STEPS = 400  # of them at least in a piece of the law
STENCIL = np.array([1, -8, 0, 8, -1]) / 12  # of five neighbours


def check_cam(drawing: CamDrawing) -> dict[str, float]:
    """By how much the independent results differ, relative to what each is compared with.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where they differ by more
    than rounding or numerical differentiation.
    """
    cam = drawing.cam
    require_claims(cam.task.name, drawing.values)
    angles = np.array(drawing.angles)
    gaps = {"points": float(max(abs(np.array(drawing.positions("K")) - cam.on_cam(angles)))) / cam.pair.base,
            "motion": max(_motion_gap(cam, float(angle)) for angle in angles),
            "curvature": _curvature_gap(cam), "law": _law_gap(cam)}
    if cam.task.load:
        gaps["load"] = _load_gap(cam, drawing.angles)
    for quantity, gap in gaps.items():
        require_agreement(cam.task.name, {quantity: gap}, CAM_TOL[quantity], by="by the independent check")
    return gaps


def _motion_gap(cam: Cam, angle: float) -> float:
    """By how much the solver's velocity and acceleration of the follower differ from the law's, relative to those of a
    point of the cam as far out as the base circle, or the cam's turning, or relative to the largest where that is
    larger."""
    rates, by_law = solve(parse(scene_text(cam, angle), cam.task.name)), law_motion(cam, angle)
    omega = cam.task.cam.omega
    if cam.task.follower.oscillates:
        radius, solved = 1.0, (rates.omega[FOLLOWER], rates.alpha[FOLLOWER])
    else:
        radius, solved = cam.pair.base, (rates.velocity[END][1], rates.acceleration[END][1])
    gaps = [abs(float(value) - law) for value, law in zip(solved, by_law, strict=True)]
    sizes = (max(radius, cam.law.largest(order)) * omega**order for order in (1, 2))
    return max(gap / radius for gap, radius in zip(gaps, sizes, strict=True))


def _load_gap(cam: Cam, angles: Iterable[float]) -> float:
    """By how much the moment on the cam and the force of the contact differ from the solver's, in whose scene the guide
    is a sleeve that rubs and the follower a mass, relative to the largest."""
    loaded, worst = LoadedCam(cam), 0.0
    largest_contact, largest_moment = (abs(loaded.largest(name)[1]) or 1.0 for name in ("contact", "moment"))
    for angle in angles:
        solved: Any = with_friction(parse(scene_text(cam, angle), cam.task.name))
        (moment,), (contact,) = solved.balances, solved.equations.scene.contacts
        push = math.hypot(*force(solved.equations, contact, solved.higher[contact.name]))
        forces = loaded.forces_at(angle)
        worst = max(worst, abs(push - abs(forces.contact)) / largest_contact,
                    abs(cam.pair.sense * float(moment) - forces.moment) / largest_moment)
    return worst


def _stencil_angles(piece: LawPiece) -> tuple[Any, float]:
    """Angles inside a piece of the law in rows of five neighbours, in degrees, and their distance in radians."""
    low, high = float(piece.start), float(piece.end)
    step = min(CAM_STEP, np.radians(high - low) / MIN_PIECE_STEPS)
    edge = 3 * np.degrees(step)
    return np.linspace(low + edge, high - edge, 7)[:, None] + np.degrees(step) * np.arange(-2, 3), step


def _curvature_gap(cam: Cam) -> float:
    """The curvature of the profile against the turning of its normal over the way of its points, times the radius of
    the base circle; and how far that way is from being perpendicular to the normal."""
    worst = 0.0
    for stretch in cam.law.stretches:
        angles, step = _stencil_angles(stretch)
        touch = cam.contact_on(stretch, angles)
        spots, normals = (cam.pair.to_cam_plane(vectors, angles) for vectors in (touch.point, touch.normal))
        velocity, turning = spots @ STENCIL / step, normals @ STENCIL / step
        curvature_radius, n = touch.radius[:, 2], normals[:, 2]
        across, along = (velocity / n).real, (velocity / n).imag
        turned = (turning / n).imag
        gap = abs(along / turned - curvature_radius) / (abs(curvature_radius) + cam.pair.base)
        worst = max(worst, float(gap.max()), float(abs(across).max()) / cam.pair.base)
    return worst


def _law_gap(cam: Cam) -> float:
    """Each derivative of the law against the one before it, differentiated, relative to the largest."""
    worst = 0.0
    for order in range(1, ORDERS):
        rows = [(stretch, *_stencil_angles(stretch)) for stretch in cam.law.stretches]
        largest = max(float(abs(stretch.value_at(angles, order)).max()) for stretch, angles, _ in rows) or 1.0
        for stretch, angles, step in rows:
            sloped = stretch.value_at(angles, order - 1) @ STENCIL / step
            worst = max(worst, float(abs(sloped - stretch.value_at(angles[:, 2], order)).max()) / largest)
    return worst
