"""A balanced linkage as numbers: mass centre and shaking force over the cycle, principal vectors, and what is checked.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from graphplan.check.balance import MassMotion

HEADINGS = ("S.x", "S.y", "S.vx", "S.vy", "S.ax", "S.ay", "J.x [N]", "J.y [N]", "M [N*m]", "fault")


def numbers(motion: MassMotion) -> dict[str, Any]:
    """All of it, plain data for JSON: points and rates in scene lengths and s, forces in N, moments in N m, angles and
    travels in degrees; null where a pose is not reached."""
    centre, units = motion.centre, motion.centre.scene.units
    about = motion.shaking.about
    return {
        "title": centre.scene.title,
        "units": {"length": units.length, "travel": units.length if centre.scene.drives[0].slides else "deg",
                  "force": "N", "moment": "N m"},
        "mass": float(centre.mass),
        "mass_centre": {"path": rows(motion, motion.path), "velocity": rows(motion, motion.velocity),
                        "acceleration": rows(motion, motion.acceleration)},
        "shaking_force": rows(motion, motion.shaking.force),
        "shaking_forces": {link: rows(motion, part) for link, part in motion.shaking.parts.items()},
        "shaking_moment": rows(motion, motion.shaking.moment),
        "moment_about": [about.real, about.imag],
        "principal_vectors": principal_vectors(motion),
        "faults": {str(pose): str(why) for pose, why in motion.faults.items()},
        "check": {what: float(gap) for what, gap in motion.check.items()},
    }


def principal_vectors(motion: MassMotion) -> dict[str, Any]:
    """The vectors in the given pose by link: which length, from where, and how they are directed; of several hinges
    those to the further ones by the points that they lead from and to."""
    found, points = {}, motion.centre.scene.points
    for vector in motion.centre.vectors:
        start, end = (complex(*map(float, points[name])) for name in (vector.start, vector.end))
        h = complex(vector.along, vector.across) * (end - start)
        found[vector.link or f"{vector.start} {vector.end}"] = {
            "from": vector.start, "line": [vector.start, vector.end], "h": abs((end - start) * float(vector.along)),
            "offset": float(vector.across) * abs(end - start), "vector": [h.real, h.imag],
            "length": abs(h), "angle": math.degrees(math.atan2(h.imag, h.real))}
    return found


def rows(motion: MassMotion, values: Any) -> list[list[float | None]]:
    """The travel of each pose with a number or the two components of a vector."""
    columns = [_travel(motion), *((values.real, values.imag) if np.iscomplexobj(values) else (values,))]
    return [[None if math.isnan(number) else number + 0.0 for number in row] for row in np.stack(columns, 1).tolist()]


def table(motion: MassMotion) -> str:
    """Comma-separated text: a heading, then a line for each pose."""
    units = motion.centre.scene.units
    travel = f"travel [{units.length if motion.centre.scene.drives[0].slides else 'deg'}]"
    own = (f"{units.length}{rate}" for rate in ("", "", "/s", "/s", "/s^2", "/s^2"))
    headings = [travel, *(f"{name} [{unit}]" for name, unit in zip(HEADINGS, own, strict=False)), *HEADINGS[6:]]
    vectors = (motion.path, motion.velocity, motion.acceleration, motion.shaking.force)
    columns = [_travel(motion), *(part for z in vectors for part in (z.real, z.imag)), motion.shaking.moment]
    lines = [",".join(headings)]
    for pose, row in enumerate(np.stack(columns, 1).tolist()):
        told = ("" if math.isnan(number) else repr(number + 0.0) for number in row)
        fault = motion.faults.get(pose, "").replace('"', '""')
        lines.append(",".join((*told, f'"{fault}"' if fault else "")))
    return "\n".join([*lines, ""])


def _travel(motion: MassMotion) -> Any:
    """The travel in degrees, or lengths of a drive that slides."""
    return motion.travel if motion.centre.scene.drives[0].slides else np.degrees(motion.travel)
