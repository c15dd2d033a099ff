"""How every link moves over the cycle, by one construction compared with the solver: so do all points of the links."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphplan.check.cycle import cycle
from graphplan.cycle.loop import whole_motion
from graphplan.cycle.rates import Moved
from graphplan.cycle.turn import followed
from graphplan.errors import Disagreement, Refused
from graphplan.machine.linkages.spanning import spanning_tree
from graphplan.mechanism.model import FRAME, Find, Scene


@dataclass(frozen=True)
class LinkMotion:
    """The links of a scene in n poses of its cycle; arrays of shape (n,), nan where a pose is not reached.

    `travel` of the first drive, in the sense in which it moves, is in radians or scene lengths. Of each link `moved`
    says how it lies, `at` is the point whose `velocity` and `acceleration` were constructed, complex arrays in scene
    units by point, and `omega` and `alpha` tell its turning. `points` and `guides` are those of the turn.
    """

    travel: Any
    closed: bool
    points: Mapping[str, Any]
    guides: Mapping[str, Any]
    faults: Mapping[int, str]
    moved: Mapping[str, Moved]
    at: Mapping[str, str]
    velocity: Mapping[str, Any]
    acceleration: Mapping[str, Any]
    omega: Mapping[str, Any]
    alpha: Mapping[str, Any]

    def of(self, scene: Scene, names: Iterable[str]) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Places, velocities and accelerations of points of the links, also of such as were added to the scene."""
        places, velocities, accelerations = dict[str, Any](), dict[str, Any](), dict[str, Any]()
        still = np.zeros(self.travel.shape, dtype=complex)
        for name in names:
            given, links = complex(*map(float, scene.points[name])), scene.links_of[name]
            link = FRAME if FRAME in links else links[0]
            if link == FRAME:
                places[name], velocities[name], accelerations[name] = still + given, still, still
                continue
            moved, pin = self.moved[link], self.at[link]
            places[name] = moved.base + moved.turn * (given - moved.origin)
            arm = places[name] - (moved.base + moved.turn * (complex(*map(float, scene.points[pin])) - moved.origin))
            velocities[name] = self.velocity[pin] + 1j * self.omega[link] * arm
            accelerations[name] = self.acceleration[pin] + (1j * self.alpha[link] - self.omega[link] ** 2) * arm
        return places, velocities, accelerations


def link_motion(scene: Scene, positions: int) -> LinkMotion:
    """The motion of all links in so many poses of the cycle.

    Fails with `Refused` where the mechanism does not move, with `Disagreement` where construction and solver differ.
    """
    span, closed = _span(scene, positions)
    at = {hanging.link: hanging.at for hanging in spanning_tree(scene).hangings}
    pins = tuple(dict.fromkeys(at.values()))
    bare = replace(scene, loads=None, find=Find(pins, pins, links=scene.moving))
    found = cycle(bare, positions, span)
    if len(found.faults) == positions:
        raise Refused(f"{scene.name}: the cycle", next(iter(found.faults.values())), "another pose")
    if found.wrong:
        raise Disagreement(scene.name, "motion", f"otherwise in pose {found.wrong[0]}", "by the solver", math.nan)
    motion, travel = followed(bare, positions, span)
    lost = np.isnan(found.gaps["velocity"])
    moved = {link: one._replace(base=np.where(lost, np.nan, one.base)) for link, one in motion.moved(travel).items()}
    still, results = np.zeros(positions, dtype=complex), found.results
    velocity, acceleration = ({name: results[kind].get(name, still) for name in pins}
                              for kind in ("velocity", "acceleration"))
    return LinkMotion(travel, closed, found.turn.points, found.turn.guides, found.faults, moved, at,
                      velocity, acceleration, results["omega"], results["alpha"])


def _span(scene: Scene, positions: int) -> tuple[tuple[float, float], bool]:
    """The span of travel that the mechanism goes through in the sense of its drive, and whether it closes.

    Between limits it keeps half a step off each: at the limit itself there are no velocities.
    """
    motion = whole_motion(scene)
    low, high = (float(motion.path.travel[end]) for end in (0, -1))
    if not scene.drives[0].slides:
        low, high = (round(math.degrees(end), 12) for end in (low, high))
    step = (high - low) / positions
    ends = (low, high - step) if motion.whole else (low + step / 2, high - step / 2)
    return ends, motion.whole
