"""A cam as numbers: base circle, law, profile, pressure angle and curvature over the turn, and what is checked."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from graphplan.cams.base import region
from graphplan.cams.construction import CamDrawing
from graphplan.cams.follower import Rolled, Translating
from graphplan.cams.law import HARD
from graphplan.cams.motions import ORDERS
from graphplan.cams.profile import Cam
from graphplan.cams.task import TURNS

TABLED = ("lift", "velocity", "acceleration", "jerk")


def numbers(drawing: CamDrawing, count: int, tolerance: float, check: Mapping[str, float]) -> dict[str, Any]:
    """All of it, plain data for JSON: lengths in the task's unit, angles in degrees, s; of an oscillating follower
    degrees, rad/s, rad/s^2, rad/s^3. What is infinite is null."""
    cam, program = drawing.cam, drawing.program
    task = cam.task
    turns = next(word for word, sense in TURNS.items() if sense == cam.pair.sense)
    found: dict[str, Any] = {
        "title": task.title, "units": {"length": task.units.length},
        "cam": {"turns": turns, "omega": task.cam.omega, "base_radius": cam.pair.base, **_placed(cam)},
        "pressure_angle": {name: {"at": angle, "largest": size} for name, way in (("rise", 1), ("return", -1))
                           for angle, size in [cam.steepest[way]] if isinstance(cam.pair, Rolled)},
        "least_radius": dict(zip(("at", "radius"), cam.narrowest, strict=True)),
        "shocks": [{"at": float(jump.angle), "of": "velocity" if jump.order == HARD else "acceleration",
                    "before": _rate(cam, jump.before, jump.order), "after": _rate(cam, jump.after, jump.order)}
                   for jump in cam.law.jumps],
        "notes": [str(note) for note in cam.notes],
        "positions": _positions(cam, 360.0 * np.arange(count) / count),
        "outline": {"tolerance": tolerance,
                    "arcs": [[arc.start.real, arc.start.imag, arc.bulge] for arc in cam.arcs(tolerance)]},
        "steps": [{"step": program.number(step.index), "stage": str(stage.title),
                   "sentence": str(program.told(step.index))} for stage, steps in program.stages for step in steps],
        "check": dict(check),
    }
    return found


def _placed(cam: Cam) -> dict[str, Any]:
    """Offset, or the angle of the arm where it is lowest; and the tangents to the curve x(s) where there are such."""
    pair, limits = cam.pair, cam.task.cam.limits
    if not isinstance(pair, Translating):
        angle = getattr(pair, "angle", None)
        return {} if angle is None else {"arm_angle": math.degrees(angle)}
    found: dict[str, Any] = {"offset": pair.offset, "depth": pair.depth}
    if limits is not None:
        where = region(cam.law, limits)
        tangents = {"rise": where.rise, **({"return": where.back} if where.back else {})}
        found["tangents"] = {name: {"at": one.angle, "passes": one.intercept,
                                    "angle": math.degrees(math.atan(one.slope))} for name, one in tangents.items()}
    return found


def _rate(cam: Cam, value: float, order: int) -> float:
    """A derivative of the law by time."""
    return value * cam.task.cam.omega**order


def _positions(cam: Cam, angles: Any) -> list[dict[str, Any]]:
    """Position by position."""
    touch, rates = cam.touch(angles), [cam.law.at(angles, order) * cam.task.cam.omega**order for order in range(ORDERS)]
    if cam.task.follower.oscillates:
        rates[0] = np.degrees(rates[0])
    profile, pitch = (cam.pair.turned(spots, angles) for spots in (touch.point, touch.roller))
    found = []
    for k, angle in enumerate(angles):
        row: dict[str, Any] = {"angle": float(angle)}
        row |= {name: float(values[k]) + 0.0 for name, values in zip(TABLED, rates, strict=True)}
        row |= {"profile": [float(profile[k].real), float(profile[k].imag)]}
        if cam.roller:
            row |= {"roller": [float(pitch[k].real), float(pitch[k].imag)]}
        radius = float(touch.radius[k])
        row |= {"pressure_angle": math.degrees(float(touch.pressure[k])) + 0.0,
                "radius_of_curvature": radius if math.isfinite(radius) else None}
        found.append(row)
    return found
