"""The turn: where every point of a mechanism is in each pose of its cycle, and why some poses cannot be reached.

A pose is reached if the mechanism comes there from its given pose without being taken apart: forwards up to the first
limit and, where the cycle is closed or the span goes there, backwards up to another. What lies between is not reached,
even where the links could be put together again. A pose at a limit is taken where the path ends, a hair before it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphplan.cycle.continuation import Continuation, Limit, Path, Progress
from graphplan.cycle.linkage import Array, Linkage, number
from graphplan.cycle.positions import Failure, Placing
from graphplan.cycle.travel import TURN, closes, paces, told, travels
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


# ---- which poses the path leads to -----------------------------------------------------------------------------------


class Course:
    """Travels sorted by a path: `at` is the travel by which a pose is placed, `reached` whether the path leads there,
    and `knots` whether it is a knot of the path: the given pose, or one at a limit.

    Where the cycle is closed, a pose beyond the upper limit is reached backwards, a full turn earlier.
    """

    def __init__(self, scene: Scene, path: Path, travel: Array, closed: bool):
        self.scene, self.travel, self.round = scene, travel, TURN if closed else 0.0
        low = path.lower.travel - path.lower.slack if path.lower else path.knots.travel[0]
        high = path.upper.travel + path.upper.slack if path.upper else path.knots.travel[-1]
        self.at, above = travel.copy(), np.flatnonzero(travel > high)
        self.at[above[travel[above] - self.round >= low]] -= self.round
        self.reached = (self.at >= low) & (self.at <= high)
        self.limits = [limit for limit in (path.lower, path.upper) if limit]
        self.stops: dict[int, Limit] = {}
        for limit in self.limits:
            there = np.abs(self.at - limit.travel) <= limit.slack
            self.at[there] = limit.travel
            self.stops |= dict.fromkeys(map(int, np.flatnonzero(there)), limit)
        self.knots = self.at == 0
        self.knots[list(self.stops)] = True

    def faults(self, failures: dict[int, Failure]) -> dict[int, str]:
        """One line for each pose that is not reached, or is a limit, by its place; `failures` could not be placed."""
        beyond = map(int, np.flatnonzero(~self.reached))
        lines = {i: self._stopped(limit) for i, limit in self.stops.items()}
        lines |= {i: f"{_links(failure.part)} cannot be assembled: {failure.why}" for i, failure in failures.items()}
        lines |= {i: self._beyond(i, lines.get(i)) for i in beyond}
        return {i: f"at {told(self.scene, self.travel[i])}: {lines[i]}" for i in sorted(lines)}

    def _stopped(self, limit: Limit) -> str:
        """What is to be said of a pose at a limit."""
        lost = "the drive does not say how they move on" if limit.change else "they have no velocities"
        return f"{_links(limit.part)} {'are' if len(limit.part) > 1 else 'is'} in a {limit.kind}: {lost}"

    def _beyond(self, i: int, reason: str | None) -> str:
        """What is to be said of a pose beyond a limit: the nearer one, if there are two."""
        places = {limit: limit.travel + (self.round if limit.travel < 0 else 0.0) for limit in self.limits}
        limit = min(self.limits, key=lambda one: abs(places[one] - self.travel[i]))
        reason = reason or f"{_links(limit.part)} cannot come there from the given pose"
        return f"{reason} ({limit.kind} near {told(self.scene, places[limit], 4)})"


def _links(names: tuple[str, ...]) -> str:
    """Links in words."""
    *first, last = names
    return f"links {', '.join(first)} and {last}" if first else f"link {last}"
