"""The turn: where every point of a mechanism is in each pose of its cycle, and why some poses cannot be reached.

A pose is reached if the mechanism comes there from its given pose without being taken apart: forwards up to the first
limit and, where the cycle is closed or the span goes there, backwards up to another. What lies between is not reached,
even where the links could be put together again. A pose at a limit is taken where the path ends, a hair before it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from graphplan.cycle.dyads import Failure
from graphplan.cycle.groups import ClosureGroup
from graphplan.cycle.linkage import Array, Linkage, contact_point, number
from graphplan.cycle.loads import loads_at
from graphplan.cycle.positions import Continuation, Limit, MovingLink, Path, PosePlacer, Progress, link_rates
from graphplan.cycle.tolerances import RETURN_TOL
from graphplan.cycle.travel import Travels, check_drives, drives_return, travels
from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import distinct_values
from graphplan.mechanism.model import FRAME, Contact, Scene
from graphplan.mechanism.replaced import guides
from graphplan.mechanism.travel import TURN, paces, travel_text, travel_unit
from graphplan.methods.motion.network import Network
from graphplan.phrases import Said, said


@dataclass(frozen=True)
class Turn:
    """n poses of a mechanism around its cycle.

    `travel`: of the first drive from the given pose in its sense, real of shape (n,), radians or scene lengths.
    `points`: complex arrays of shape (n,) in scene units by name, nan where a pose is not reached; a point that only
    marks the place of a guide under the sliding point goes with that point. `guides`: the directions, complex arrays of
    shape (n,), of the slides along moving links that are given by a vector, by the slide's name. `faults`: by the
    pose's place, why it is not reached, or has no velocities at a limit. `closed`: after a full turn of the first drive
    all is as it was. `motion` is whose poses they are.
    """

    travel: Array
    points: dict[str, Array]
    guides: dict[str, Array]
    faults: dict[int, str]
    closed: bool = False
    motion: RangeOfMotion | None = field(default=None, repr=False, compare=False)

    @property
    def loads(self) -> dict[str, Array]:
        """The loads that change, by their letters: forces as complex arrays of shape (n,), moments as real ones."""
        if self.motion is None:
            return {}
        return loads_at(self.motion.scene, self.travel, self.points, self.guides, self.motion.links_at)


def follow(scene: Scene, positions: int, span: tuple[float, float] | None = None,
           progress: Progress | None = None, compiled: bool = False) -> Turn:
    """The scene's points in so many poses of its cycle, each followed from the given pose without changing branch.

    Reads a scene with drives, and the span of the first drive's travel, in degrees (in lengths where it slides), both
    ends included; without one it is a full turn from the given pose, whose end is left out. The other drives keep pace.
    `compiled`, they are placed by machine code, where numba is installed.
    Fails with :class:`Refused` where no drive leads, and with :class:`SceneError` where the drives leave links loose.
    """
    motion, travel = motion_and_travel(scene, positions, span, progress)
    return motion.turn(travel, compiled)


def turn_of_parts(parts: Sequence[Turn], motion: RangeOfMotion) -> Turn:
    """Turns of neighbouring poses of a motion as one."""
    starts = np.cumsum([0, *(len(part.travel) for part in parts)]).tolist()
    points, guides = ({name: np.concatenate([arrays[name] for arrays in named]) for name in named[0]}
                      for named in ([part.points for part in parts], [part.guides for part in parts]))
    faults = {start + place: why for start, part in zip(starts, parts, strict=False)
              for place, why in part.faults.items()}
    return Turn(np.concatenate([part.travel for part in parts]), points, guides, faults, parts[0].closed, motion)


def motion_and_travel(scene: Scene, positions: int, span: tuple[float, float] | None,
                      progress: Progress | None = None) -> tuple[RangeOfMotion, Array]:
    """The scene's motion as far as these poses ask for, and the travels at which they are; as :func:`follow` has it."""
    travel = travels(scene, positions, span)
    return range_for(scene, Travels(scene, positions, span), progress), travel


def range_for(scene: Scene, poses: Travels, progress: Progress | None) -> RangeOfMotion:
    """The scene's motion as far as these travels ask for; as :func:`follow` has it."""
    closed = poses.span is None and drives_return(scene, paces(scene))
    lower, upper = min(0.0, *poses.ends), TURN if closed else max(0.0, *poses.ends)
    return RangeOfMotion(scene, lower, upper, closed, progress)


class RangeOfMotion:
    """Motion of a scene from its given pose between two travels of its first drive; `path` has the place where it
    stops.

    Where the motion is `closed`, as every drive is back at the end, it goes backwards as far as a turn leaves over,
    unless gears have turned then who knows how far.
    Fails as :func:`follow` does.
    """

    def __init__(self, scene: Scene, lower: float, upper: float, closed: bool, progress: Progress | None = None):
        self.scene, self.closed = scene, closed
        self.linkage = Linkage(scene, paces(scene))
        self.groups = [ClosureGroup(self.linkage, links) for links in self.linkage.parts]
        self._continuation = Continuation(self.linkage, self.groups, lower, upper, progress)
        self._round = closed and not self.linkage.counts_angles
        self.path = self._continuation.path(self._round)

    @property
    def goes_round(self) -> bool:
        """Whether it leads back to its beginning, and no limit stands in the way."""
        free = self.closed and not (self.path.lower or self.path.upper)
        return free and (self._round or self.returns_at(self.ends[1]))

    @property
    def ends(self) -> tuple[float, float]:
        """The travels from which and to which the path leads."""
        return float(self.path.travel[0]), float(self.path.travel[-1])

    def returns_at(self, travel: float) -> bool:
        """Whether every link is back in its place at a travel that the path reaches."""
        nearest = int(np.argmin(np.abs(self.path.travel - travel)))
        at_knot = abs(self.path.travel[nearest] - travel) <= self._continuation.finest
        final_state = self.path.knots[nearest].state if at_knot else self._continuation.state(self.path, travel)
        if final_state is None:
            return False
        state = iter(final_state.tolist())
        apart = [abs(2 * math.sin(value / 2) if i < group.layout.angles else value)
                 for group in self.groups for i, value in zip(range(group.unknowns), state, strict=False)]
        return max(apart, default=0.0) <= RETURN_TOL

    def turn(self, travel: Array, compiled: bool = False) -> Turn:
        """The poses at these travels, an array of shape (n,) in any order."""
        scene = self.scene
        moving = {name: guide for name, guide in guides(scene).items() if guide.along != FRAME}
        course, placing = self._place_poses(travel, {guide.along for guide in moving.values()}, compiled)
        points = {name: placing.points[name] for name in scene.points}
        turns = {name: placing.turns[guide.along] for name, guide in moving.items()}
        directions = {name: number(*guide.direction) * turns[name] for name, guide in moving.items()
                      if guide.through is None}
        points |= {name: points[at] for name, at in points_under_slides(scene).items()}
        points |= {at: contact_point(scene, contact, points, turns.get(contact.name, 1.0))
                   for at, contact in travelling_contacts(scene).items()}
        back = self.closed and self.path.upper is None and self.returns_at(self.ends[1])
        return Turn(travel, points, directions, course.faults(placing.failures), back, self)

    def links_at(self, travel: Array) -> dict[str, MovingLink]:
        """Position and rates of every link at these travels; nan for poses that are not reached."""
        course, placing = self._place_poses(travel, self.scene.moving, compiled=False)
        return link_rates(self.linkage, self.groups, course.at, placing.points, placing.turns)

    def _place_poses(self, travel: Array, turning: Iterable[str], compiled: bool) -> tuple[Reachability, PosePlacer]:
        """The points, and the turns of some links, at these travels."""
        path = self.path
        course = Reachability(self.scene, path, travel, self._round)
        placing = PosePlacer(self.linkage, self.groups, len(travel), turning)
        placing.follow(path, course.at, np.flatnonzero(course.reached & ~course.knots), compiled)
        placing.retry(partial(self._continuation.state, path), course.at)
        knots = np.flatnonzero(course.knots)
        placing.place_states(path.nearest_states(course.at[knots]), course.at, knots)
        placing.explain_failures(course.at, np.flatnonzero(~course.reached))
        lost = ~course.reached
        for _, at in placing.failures:
            lost[at] = True
        for array in (*placing.points.values(), *placing.turns.values()):
            array[lost] = complex(np.nan, np.nan)
        return course, placing


def points_under_slides(scene: Scene) -> dict[str, str]:
    """The points of guides' links that only mark the place under a sliding point, each with that point.

    A point is its link's own where another link has it too, where a load, another slide or its direction needs it.
    """
    own_points = {slide.at for slide in scene.slides} | _loaded_points(scene)
    net = Network(scene)
    pairs = {name: at for name, at in net.shared_marks.items() if name not in net.names}
    return {name: at for name, at in pairs.items() if name not in own_points and len(scene.links_of[name]) == 1
            and all(slide.at == at for slide in scene.slides if slide.through and name in slide.through)}


def travelling_contacts(scene: Scene) -> dict[str, Contact]:
    """The contacts by the points that travel with them: those of no link, and all where profiles roll.

    Fails with `Refused` where profiles roll at a point that something else needs on its link.
    """
    travelling = {contact.at: contact for contact in scene.contacts
                  if contact.rolling or not scene.links_of[contact.at]}
    for at, contact in travelling.items():
        if len(scene.links_of[at]) > 1 or at in _loaded_points(scene):
            raise Refused(f"contact {contact.name}", f"{at} travels with it, and is a joint or bears a load besides",
                          "another point of the link for these, in the same place")
    return travelling


def _loaded_points(scene: Scene) -> set[str]:
    """The points of links at which masses are centred, and forces act or balance."""
    loads = scene.loads
    return {*(mass.centre for mass in loads.masses.values()), *(force.at for force in loads.forces),
            *(balance.at for balance in loads.balances)} if loads else set()


# ---- which poses the path leads to -----------------------------------------------------------------------------------


class Reachability:
    """Travels sorted by a path: `at` is the travel by which a pose is placed, `reached` whether the path leads there,
    and `knots` whether it is a knot of the path: the given pose, or one at a limit.

    Where the cycle is closed, a pose beyond the upper limit is reached backwards, a full turn earlier.
    """

    def __init__(self, scene: Scene, path: Path, travel: Array, closed: bool):
        self.scene, self.travel, self.round = scene, travel, TURN if closed else 0.0
        low = path.lower.travel - path.lower.slack if path.lower else path.travel[0]
        high = path.upper.travel + path.upper.slack if path.upper else path.travel[-1]
        self.at, above = travel.copy(), np.flatnonzero(travel > high)
        self.at[above[travel[above] - self.round >= low]] -= self.round
        self.reached = (self.at >= low) & (self.at <= high)
        self.limits = [limit for limit in (path.lower, path.upper) if limit]
        self.stops, self.knots = [], self.at == 0
        for limit in self.limits:
            at_limit = np.abs(self.at - limit.travel) <= limit.slack
            self.at[at_limit] = limit.travel
            self.stops.append((limit, at_limit))
            self.knots |= at_limit

    def faults(self, failures: Sequence[tuple[Failure, Array]]) -> dict[int, str]:
        """One line for each pose that is not reached, or is a limit, by its place.

        `failures` could not be placed, each in these poses; of several the first counts.
        """
        reasons, which = [""], np.zeros(len(self.travel), dtype=int)

        def because(reason: str, poses: Array) -> None:
            reasons.append(reason)
            which[poses] = len(reasons) - 1

        for limit, poses in self.stops:
            because(limit_reason(limit.links, limit.change), poses)
        for failure, poses in reversed(failures):
            because(f"{_links_text(failure.links)} cannot be assembled: {failure.why}", poses)
        for limit, beyond in self._unreached_by_limit():
            for k in distinct_values(which[beyond]):
                reason = reasons[k] or f"{_links_text(limit.links)} cannot come there from the given pose"
                because(f"{reason} ({limit.kind} near {travel_text(self.scene, self._travel_round(limit), 4)})",
                        beyond & (which == k))
        unit, name = travel_unit(self.scene)
        poses = np.flatnonzero(which)
        at = zip(poses.tolist(), (self.travel[poses] / unit).tolist(), which[poses].tolist(), strict=True)
        return {i: f"at {travel:.6g} {name}: {reasons[k]}" for i, travel, k in at}

    def _travel_round(self, limit: Limit) -> float:
        """Travel of a limit, counted forward round the cycle."""
        return limit.travel + (self.round if limit.travel < 0 else 0.0)

    def _unreached_by_limit(self) -> Iterator[tuple[Limit, Array]]:
        """Each limit, with the mask of the poses that are not reached and to which it is the nearest."""
        apart = np.abs([self._travel_round(limit) - self.travel for limit in self.limits])
        for i, limit in enumerate(self.limits):
            yield limit, ~self.reached & (np.argmin(apart, axis=0) == i)


def limit_reason(part: tuple[str, ...], change: bool) -> Said:
    """Reason for a limit of a part: a change point or a limit position."""
    first, last = ", ".join(part[:-1]), part[-1]
    if change:
        return (said("links {0} and {1} are in a change point: the drive does not say how they move on", first, last)
                if first else said("link {0} is in a change point: the drive does not say how it moves on", last))
    return (said("links {0} and {1} are in a limit position: they have no velocities", first, last) if first
            else said("link {0} is in a limit position: it has no velocity", last))


def _links_text(names: tuple[str, ...]) -> str:
    """Links in words."""
    *first, last = names
    return f"links {', '.join(first)} and {last}" if first else f"link {last}"


# ---- loops: round and round, or there and back between limits --------------------------------------------------------


MAX_TURNS = 16  # of the first drive, in which gears must be back
LIMIT_MARGIN = 0.002  # of the way: so far before a limit it turns round, as there are no velocities at the limit itself


@dataclass(frozen=True)
class Loop:
    """The poses of a loop, and in which order they are gone through, as places in `turn`; the first is the given pose,
    or of a span without it the nearest."""

    turn: Turn
    order: Sequence[int]


def whole_motion(scene: Scene) -> RangeOfMotion:
    """The whole motion of the mechanism from its given pose: one turn of the first drive, or with gears as many as it
    takes until all is back, if not too many; of a drive that slides to its limits, or without limits as far as the
    mechanism is large.

    Fails with `Refused` if it cannot move.
    """
    check_drives(scene)
    motion = range_of_motion(scene)
    if len({*motion.ends}) == 1:
        raise Refused("the cycle", said("the mechanism does not move on from the given pose"), "another pose")
    return motion


def range_of_motion(scene: Scene) -> RangeOfMotion:
    """The whole motion of the mechanism, even if it cannot move."""
    if scene.drives[0].slides:
        places = [complex(*map(float, at)) for at in scene.points.values()]
        far = max(abs(p - q) for p in places for q in places)
        motion = RangeOfMotion(scene, -far, far, closed=False)
    else:
        motion = RangeOfMotion(scene, 0.0, TURN, drives_return(scene, paces(scene)))
        if motion.closed and motion.linkage.counts_angles and not (motion.goes_round or motion.path.upper):
            motion = _motion_until_return(scene) or motion
    return motion


def _motion_until_return(scene: Scene) -> RangeOfMotion | None:
    """The motion through the fewest turns after which all is back; None if these are too many, or it stops."""
    most = 1
    while most < MAX_TURNS:
        motion, most = RangeOfMotion(scene, 0.0, 2 * most * TURN, closed=True), 2 * most
        if motion.path.upper:
            return None
        for count in range(most // 2 + 1, most + 1):
            if motion.returns_at(count * TURN):
                return motion if count == most else RangeOfMotion(scene, 0.0, count * TURN, closed=True)
    return None


def loop(scene: Scene, count: int, span: tuple[float, float] | None = None) -> Loop:
    """The scene moved through so many poses: one full turn, or where it does not close, or a span is given in degrees
    (lengths of a drive that slides), there and back, slower towards the ends.

    Fails as :func:`graphplan.cycle.follow` does.
    """
    if span is None:
        motion, ends = whole_motion(scene), (-math.inf, math.inf)
    else:
        low, high = sorted(travels(scene, 2, span).tolist())
        motion, ends = RangeOfMotion(scene, min(0.0, low), max(0.0, high), closed=False), (low, high)
    if motion.goes_round:
        return Loop(motion.turn(motion.ends[1] * np.arange(count) / count), range(count))
    low, high = reachable_span(motion, *ends)
    half = count // 2
    travel = (low + high) / 2 - (high - low) / 2 * np.cos(np.pi * np.arange(half + 1) / max(1, half))
    first = int(np.argmin(np.abs(travel)))
    if low <= 0.0 <= high:
        travel[first] = 0.0
    back = [*range(half + 1), *range(half - 1, 0, -1)]
    return Loop(motion.turn(travel), back[first:] + back[:first])


def reachable_span(motion: RangeOfMotion, low: float = -math.inf, high: float = math.inf) -> tuple[float, float]:
    """The travels between which it goes: as far as it can within these ends, and not quite to limits."""
    path = motion.path
    least, most = motion.ends
    spare = LIMIT_MARGIN * (most - least)
    low = max(low, least + spare if path.lower else least)
    high = min(high, most - spare if path.upper else most)
    if low >= high:
        raise Refused("the cycle", said("the mechanism cannot reach it from the given pose"), "another range")
    return low, high
