"""Styles: which plans of motion and of forces are drawn, and in which form the inertia forces."""

from __future__ import annotations

from dataclasses import dataclass

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene

METHODS = {"auxiliary": "auxiliary point", "trial": "trial figure", "poles": ""}  # with the form that each prefers
OF_PATHS = {"euler-savary": "Euler-Savary", "bobillier": "Bobillier", "hartmann": "Hartmann", "accelerations": ""}
MOTION_PLANS = ("orthogonal", "polar", "triangles")
PLANS = (*MOTION_PLANS, "lever", "polygons", "both")
INERTIA = ("couple", "shifted", "points")


def motion_plans(scene: Scene) -> tuple[str, ...]:
    """The plans of motion that a scene may have: velocity triangles stand on the lines of centres of its gears."""
    return MOTION_PLANS if scene.gears else MOTION_PLANS[:2]


@dataclass(frozen=True)
class Style:
    """Which plans are drawn: orthogonal or polar ones of the motion, or velocity triangles with the N-plan; the lever,
    force polygons, or both.

    `free` says that the plans of the motion are not asked for by name: then the lengths of the links may decide.
    """

    polar: bool = False
    free: bool = True
    lever: bool = True
    polygons: bool = True
    inertia: str = "couple"
    triangles: bool = False


def style(plan: str, inertia: str) -> Style:
    """The style that `plan` names: one word for the motion, one for the forces, or both with a comma between them."""
    if inertia not in INERTIA:
        raise Refused(f"inertia {inertia}", "unknown method of inertia", f"choose one of {', '.join(INERTIA)}")
    words = plan.split(",") if plan else []
    for word in words:
        if word not in PLANS:
            raise Refused(f"plan {word}", "unknown plan", f"choose one of {', '.join(PLANS)}")
    lever, polygons = "lever" in words, "polygons" in words
    both = "both" in words or not (lever or polygons)
    free = not {*MOTION_PLANS} & {*words}
    return Style("polar" in words, free, lever or both, polygons or both, inertia, "triangles" in words)
