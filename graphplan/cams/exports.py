"""A cam for others to read: as numbers over the turn, and in one pose as a scene.

The numbers are base circle, law, profile, pressure angle and curvature over the turn, and what is checked. The scene
has profiles that touch, by their centres of curvature, and the cam as the drive: the velocity and the acceleration of
the follower in that pose exactly; in others it is the mechanism in which the profile goes on as the circle of curvature
that it has here. Where pieces of the law meet it is that of the piece that begins.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from graphplan.cams.base import FlatOscillating, Oscillating, Rolled, Translating, region
from graphplan.cams.construction import CamDrawing
from graphplan.cams.law import HARD, ORDERS
from graphplan.cams.profile import Cam, LoadedCam
from graphplan.cams.task import TURNS
from graphplan.cams.tolerances import ZERO_LENGTH
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.written_scene import new_scene_text

# ---- numbers --------------------------------------------------------------------------------------------------------


LAW_COLUMNS = ("lift", "velocity", "acceleration", "jerk")


def numbers(drawing: CamDrawing, count: int, tolerance: float, check: Mapping[str, float]) -> dict[str, Any]:
    """All of it, plain data for JSON: lengths in the task's unit, angles in degrees, s; of an oscillating follower
    degrees, rad/s, rad/s^2, rad/s^3. What is infinite is null."""
    cam, program = drawing.cam, drawing.values.drawing.program
    task = cam.task
    turns = next(word for word, sense in TURNS.items() if sense == cam.pair.sense)
    document: dict[str, Any] = {
        "title": task.title, "units": {"length": task.units.length},
        "cam": {"turns": turns, "omega": task.cam.omega, "base_radius": cam.pair.base, **placement(cam)},
        "pressure_angle": {name: {"at": angle, "largest": pressure} for name, way in (("rise", 1), ("return", -1))
                           for angle, pressure in [cam.steepest[way]] if isinstance(cam.pair, Rolled)},
        "least_radius": dict(zip(("at", "radius"), cam.narrowest, strict=True)),
        "shocks": [{"at": float(jump.angle), "of": "velocity" if jump.order == HARD else "acceleration",
                    "before": _rate(cam, jump.before, jump.order), "after": _rate(cam, jump.after, jump.order)}
                   for jump in cam.law.jumps],
        "notes": [str(note) for note in cam.notes],
        "positions": _positions(cam, 360.0 * np.arange(count) / count),
        "outline": {"tolerance": tolerance,
                    "arcs": [[arc.start.real, arc.start.imag, arc.bulge] for arc in cam.arcs(tolerance)]},
        "steps": [{"step": program.number(step.index), "stage": str(stage.title),
                   "sentence": str(program.sentence_with_reason(step.index))}
                  for stage, steps in program.stages for step in steps],
        "check": dict(check),
    }
    if task.load:
        document["load"] = load_numbers(LoadedCam(cam), count)
    return document


def load_numbers(loaded: LoadedCam, count: int) -> dict[str, Any]:
    """The spring, largest forces, where the follower is nearest to jamming, and all forces position by position; N,
    N m, J."""
    at, share = loaded.law.extremum(loaded.jamming)
    limit = {} if loaded.cam.task.follower.flat else {"pressure_angle": loaded.jamming_angle(at)}
    angles = 360.0 * np.arange(count) / count
    return {**loaded.spring._asdict(), "keeps_contact": loaded.keeps_contact, "work_lost": loaded.work_lost,
            "jamming": {"at": at, "share": share, **limit},
            **{f"largest_{name}": dict(zip(("at", "value"), loaded.largest(name), strict=True))
               for name in ("contact", "moment")},
            "positions": [{"angle": float(angle), **{name: value + 0.0 for name, value in loaded.forces_at(
                float(angle))._asdict().items()}} for angle in angles]}


def placement(cam: Cam) -> dict[str, Any]:
    """Offset, or the angle of the arm where it is lowest; and the tangents to the curve x(s) where there are such."""
    pair, limits = cam.pair, cam.task.cam.limits
    if not isinstance(pair, Translating):
        angle = getattr(pair, "angle", None)
        return {} if angle is None else {"arm_angle": math.degrees(angle)}
    document: dict[str, Any] = {"offset": pair.offset, "depth": pair.depth}
    if limits is not None:
        centre_region = region(cam.law, limits)
        tangents = {"rise": centre_region.rise, **({"return": centre_region.back} if centre_region.back else {})}
        document["tangents"] = {name: {"at": tangent.angle, "passes": tangent.intercept,
                                       "angle": math.degrees(math.atan(tangent.slope))}
                                for name, tangent in tangents.items()}
    return document


def _rate(cam: Cam, value: float, order: int) -> float:
    """A derivative of the law by time."""
    return value * cam.task.cam.omega**order


def _positions(cam: Cam, angles: Any) -> list[dict[str, Any]]:
    """Position by position."""
    touch, rates = cam.contact(angles), [cam.law.value_at(angles, order) * cam.task.cam.omega**order
                                         for order in range(ORDERS)]
    if cam.task.follower.oscillates:
        rates[0] = np.degrees(rates[0])
    profile, pitch = (cam.pair.to_cam_plane(spots, angles) for spots in (touch.point, touch.roller))
    rows = []
    for k, angle in enumerate(angles):
        row: dict[str, Any] = {"angle": float(angle)}
        row |= {name: float(values[k]) + 0.0 for name, values in zip(LAW_COLUMNS, rates, strict=True)}
        row |= {"profile": [float(profile[k].real), float(profile[k].imag)]}
        if cam.roller:
            row |= {"roller": [float(pitch[k].real), float(pitch[k].imag)]}
        radius = float(touch.radius[k])
        row |= {"pressure_angle": math.degrees(float(touch.pressure[k])) + 0.0,
                "radius_of_curvature": radius if math.isfinite(radius) else None}
        rows.append(row)
    return rows


# ---- one pose as a scene --------------------------------------------------------------------------------------------


CAM, FOLLOWER = "1", "2"
CENTRE, PIVOT, PROFILE, END, TOUCHED, MIDDLE = "O", "B", "C", "A", "K", "M"  # letters of points
STRAIGHT_RADIUS = 1e12  # of the base circle's radius: a profile so little curved is straight


def scene_text(cam: Cam, angle: float) -> str:
    """The scene of a cam that has turned by an angle in degrees, as TOML."""
    task, touch, pair = cam.task, cam.contact([angle]), cam.pair
    point, middle, end = (complex(spot[0]) for spot in (touch.point, touch.centre, touch.roller))
    tangent = 1j * complex(touch.normal[0])
    points, follower = {CENTRE: 0j, TOUCHED: point}, follower_tables(cam, end)
    points |= follower.pop("points")
    profile: str | complex = CENTRE if abs(middle) < ZERO_LENGTH * pair.base else PROFILE
    if not abs(touch.radius[0]) < STRAIGHT_RADIUS * pair.base:
        profile = tangent
    on_cam = PROFILE if profile == PROFILE else f"K{CAM}"
    points[on_cam] = middle if profile == PROFILE else point
    centres = profile, tangent if task.follower.flat else END
    find = {"velocity": [END], "acceleration": [END]} | ({"links": [FOLLOWER]} if task.follower.oscillates else {})
    asked = load_tables(cam, angle) if task.load else {"find": find}
    return new_scene_text(f"{task.title or 'Cam'}: at {number_text(angle)} degrees", task.source, task.units, {
        "points": {name: spot + 0j for name, spot in points.items()},
        "links": {CAM: f"{CENTRE} {on_cam}", **follower.pop("links")}, **follower,
        "contacts": [{"links": [CAM, FOLLOWER], "at": TOUCHED,
                      "centres": [centre if isinstance(centre, str) else centre + 0j for centre in centres]}],
        "drive": [{"link": CAM, "omega": pair.sense * task.cam.omega}], **asked})


def load_tables(cam: Cam, angle: float) -> dict[str, Any]:
    """The load of the follower in one pose: its mass, load and spring along its path, the friction of its guide, which
    bears at both ends as a sleeve does."""
    loaded = LoadedCam(cam)
    pushed = loaded.force + loaded.forces_at(angle).spring
    rubs = {"slide": [FOLLOWER, FRAME], "coefficient": loaded.coefficient, "length": loaded.bearing}
    return {"balance": {"link": CAM}, "forces": [{"on": FOLLOWER, "at": END, "value": [0, -pushed]}],
            "masses": {FOLLOWER: {"mass": loaded.mass, "centre": END}}, "friction": [rubs]}


def follower_tables(cam: Cam, end: complex) -> dict[str, Any]:
    """The points and links of the follower and of what holds it, and its slide."""
    pair = cam.pair
    if isinstance(pair, Oscillating | FlatOscillating):
        return {"points": {PIVOT: complex(pair.distance), END: end},
                "links": {FOLLOWER: f"{PIVOT} {END}", FRAME: f"{CENTRE} {PIVOT}"}}
    across = pair.sense * pair.offset if isinstance(pair, Translating) else 0.0
    points, load = {END: complex(across, end.imag)}, cam.task.load
    if load:  # the guide bears about its middle
        lowest = complex(cam.contact([0.0]).roller[0]).imag
        points[MIDDLE] = complex(across, lowest + float(load.overhang + load.bearing / 2))
    return {"points": points, "links": {FOLLOWER: " ".join(points), FRAME: CENTRE},
            "slides": [{"link": FOLLOWER, "along": FRAME, "at": [*points][-1], "direction": [0, 1]}]}


def law_motion(cam: Cam, angle: float) -> tuple[float, float]:
    """Motion of the follower by the law: velocity and acceleration of its point, or its omega and alpha."""
    rate, change = (float(cam.law.value_at([angle], order)[0]) * cam.task.cam.omega**order for order in (1, 2))
    return (-rate, -change) if cam.task.follower.oscillates else (rate, change)
