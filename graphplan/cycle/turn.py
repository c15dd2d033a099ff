"""The turn: where every point of a mechanism is in each pose of its cycle, and why some poses cannot be reached."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphplan.cycle.continuation import Continuation, Progress
from graphplan.cycle.linkage import Array, Linkage, number
from graphplan.cycle.positions import Placing
from graphplan.cycle.reachability import Course
from graphplan.cycle.travel import closes, paces, travels
from graphplan.mechanism.model import FRAME, Scene
from graphplan.methods.motion.network import Network


@dataclass(frozen=True)
class Turn:
    """n poses of a mechanism around its cycle.

    `travel`: of the first drive from the given pose, real of shape (n,), radians or scene lengths. `points`: complex
    arrays of shape (n,) in scene units by name, nan where a pose is not reached; a point that only marks the place of a
    guide under the sliding point goes with that point. `guides`: the directions, complex arrays of shape (n,), of the
    slides along moving links that are given by a vector, by the slide's name. `faults`: by the pose's place, why it is
    not reached, or has no velocities at a limit.
    """

    travel: Array
    points: dict[str, Array]
    guides: dict[str, Array]
    faults: dict[int, str]


def follow(scene: Scene, positions: int, span: tuple[float, float] | None = None,
           progress: Progress | None = None) -> Turn:
    """The scene's points in so many poses of its cycle, each followed from the given pose without changing branch.

    Reads a scene with drives, and the span of the first drive's travel, in degrees (in lengths where it slides), both
    ends included; without one it is a full turn from the given pose, whose end is left out. The other drives keep pace.
    Fails with :class:`Refused` where no drive leads, and with :class:`SceneError` where the drives leave links loose.
    """
    travel = travels(scene, positions, span)
    linkage = Linkage(scene, paces(scene))
    placing = Placing(linkage)
    closed = span is None and closes(scene, linkage.paces)
    ends = min(0.0, float(travel.min())), max(0.0, float(travel.max()))
    path = Continuation(linkage, *ends, placing.poses, progress).path(closed)
    course = Course(scene, path, travel, closed)
    slides = [slide for slide in scene.slides if slide.through is None and slide.along != FRAME]
    placed = placing.place(path, course.at, course.reached, course.knots, [slide.along for slide in slides])
    failures = {int(i): failure for failure, at in reversed(placed.failures) for i in at}  # the first one stays
    reached = course.reached.copy()
    reached[list(failures)] = False
    lost = np.flatnonzero(~reached)
    for array in (*placed.points.values(), *(placed.turn[slide.along] for slide in slides)):
        array[lost] = complex(np.nan, np.nan)
    points = {name: placed.points[name] for name in scene.points}
    guides = {slide.name: number(*slide.direction) * placed.turn[slide.along] for slide in slides}
    points |= {name: points[at] for name, at in _under(scene).items()}
    return Turn(travel, points, guides, course.faults(failures))


def _under(scene: Scene) -> dict[str, str]:
    """The points of guides' links that only mark the place under a sliding point, each with that point.

    A point is its link's own where another link has it too, where a load, another slide or its direction needs it.
    """
    loads = scene.loads
    own = {slide.at for slide in scene.slides}
    if loads:
        own |= {*(mass.centre for mass in loads.masses.values()), *(force.at for force in loads.forces),
                *(balance.at for balance in loads.balances)}
    net = Network(scene)
    pairs = {name: at for name, at in net.shared.items() if name not in net.names}
    return {name: at for name, at in pairs.items() if name not in own and len(scene.links_of[name]) == 1
            and all(slide.at == at for slide in scene.slides if slide.through and name in slide.through)}
