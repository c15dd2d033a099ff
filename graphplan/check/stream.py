"""Many poses: checked in blocks, summed up as they stream.

A worker is told the construction once and then ranges of poses; it gives back results, or what is kept of them.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache, partial
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from graphplan.check.arithmetics import FLOATS
from graphplan.check.compared import Readings, compare, drawn_sizes, plain_number, scales, sliding_size, weight
from graphplan.check.report import rates_by_kind, reference_solution
from graphplan.check.tolerances import EPSILON, PROVEN_ZERO, RESTING_TOL, ROUNDING_TOL
from graphplan.cycle.positions import Progress
from graphplan.cycle.travel import Travels
from graphplan.cycle.turn import RangeOfMotion, Turn, range_for
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import FRAME, Drive, Scene, Slide
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.mechanism.replaced import guides
from graphplan.mechanism.travel import printed_travels
from graphplan.mechanism.units import metre
from graphplan.methods.construction import Construction
from graphplan.methods.executors import worker_pool
from graphplan.methods.kinds import (
    ACCELERATION,
    CONTACT_REACTION,
    FORCES,
    MOTION,
    SLIDE_ARM,
    SLIDE_MOMENT,
    SLIDE_REACTION,
    VELOCITY,
    kind_of,
)
from graphplan.methods.recorded import components
from graphplan.solver import poses, solve
from graphplan.solver.linear import Unproven

POSES_AT_ONCE = 4096  # poses whose systems are solved at once
SAFETY_FACTOR = 100  # times the solver's own bound, or its condition's roundings, that a difference may be


@dataclass(frozen=True)
class PoseBatch:
    """Some poses of a scene: their places among all, where points and guides are in them, and the loads that change."""

    scene: Scene
    places: Any
    points: Mapping[str, Any]
    guides: Mapping[str, Any]
    loads: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of_reached(cls, scene: Scene, points: Mapping[str, Any], guides: Mapping[str, Any],
                   loads: Mapping[str, Any] | None = None) -> PoseBatch:
        """The poses in which every point has its place."""
        reached = np.all([np.isfinite(z) for z in points.values()], axis=0)
        return cls(scene, np.arange(reached.size), points, guides, loads or {}).select(reached)

    def select(self, kept: Any) -> PoseBatch:
        """The poses that a mask or a slice selects."""
        arrays = ({name: z[kept] for name, z in named.items()} for named in (self.points, self.guides, self.loads))
        return PoseBatch(self.scene, self.places[kept], *arrays)

    def of_part(self, scene: Scene) -> PoseBatch:
        """Restrict the poses to a part of the mechanism, with its own points, guides and loads."""
        names_of_part = [*scene.points], [*guides(scene)], [*changing_loads(scene.loads)]
        arrays = ({name: array for name, array in named.items() if name in names}
                  for names, named in zip(names_of_part, (self.points, self.guides, self.loads), strict=True))
        return PoseBatch(scene, self.places, *arrays)

    @property
    def posed_scene(self) -> Scene:
        """The scene in these poses."""
        return poses.scene_in_poses(self.scene, self.points, self.guides, self.loads)


def points_where_sound(drawing: Construction, points: Mapping[str, Any], guides: Mapping[str, Any],
                       loads: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Places of points in the poses in which the construction agrees with the solver; nan in others."""
    batch = PoseBatch.of_reached(drawing.scene, points, guides, loads)
    results = drawing.evaluate(batch.points, batch.guides, loads=batch.loads).results
    is_sound = np.zeros(len(next(iter(points.values()))), dtype=bool)
    is_sound[batch.places] = sound_poses(batch, drawing, results, pose_gaps(batch, drawing, results))
    return {name: np.where(is_sound, z, np.nan) for name, z in points.items()}


def pose_gaps(batch: PoseBatch, drawing: Construction, results: Readings,
              progress: Callable[[int, int], None] = lambda done, of: None) -> dict[str, Any]:
    """For each kind of result the largest difference from the solver relative to the number's own size, in each pose.
    """
    n, blocks = batch.places.size, list[dict[str, Any]]()
    for start in range(0, n, POSES_AT_ONCE):
        block = slice(start, min(start + POSES_AT_ONCE, n))
        ours = {kind: {name: z[block] for name, z in named.items()} for kind, named in results.items()}
        blocks.append(_block_gaps(batch.select(block), drawing, ours))
        progress(block.stop, n)
    return {kind: np.concatenate([apart[kind] for apart in blocks]) for kind in blocks[0]}


def compared_groups(drawing: Construction) -> list[str]:
    """Groups of results that are compared: velocity and acceleration, kinds of places that are asked for, forces."""
    motion_groups = [group for group, kinds in MOTION.items() if not kinds[0].place or {*kinds} & {*drawing.kinds}]
    return [*motion_groups, *([FORCES] if drawing.scene.loads else [])]


@np.errstate(invalid="ignore")  # what is infinitely far off has no difference, so it is in no pose held for sound
def _block_gaps(batch: PoseBatch, drawing: Construction, ours: Readings) -> dict[str, Any]:
    """The differences in one block of poses."""
    n, scene = batch.places.size, batch.posed_scene
    motion = poses.solve(scene, n, sizes=True)
    truth = rates_by_kind(motion, ours)
    if scene.loads is not None:
        from graphplan.check.forces import force_truth

        truth |= force_truth(scene, ours, poses.reactions(scene, motion, n, sizes=True), sense=poses.sense)
    apart: dict[str, Any] = {kind: np.zeros(n) for kind in compared_groups(drawing)}
    least = {kind: PROVEN_ZERO * scale for kind, scale in drawn_sizes(drawing).items()}
    for kind, named in ours.items():
        for name, value in named.items() if kind in truth else ():
            group, numbers = kind_of(kind).group, components(truth[kind][name])
            true = numbers[0].value if len(numbers) == 1 else numbers[0].value + 1j * numbers[1].value
            besides = _relative_vectors_size(scene, truth, kind, name), sliding_size(scene, truth, kind, name)
            floor = least[group] / weight(drawing, kind)
            sizes = (np.full(n, floor), *(number.size for number in numbers), *besides,
                     _rolling_size(scene, motion, kind), _contact_size(scene, truth, kind, name))
            scale = np.max(np.broadcast_arrays(*sizes), axis=0)
            scale = np.where(scale <= floor, floor / PROVEN_ZERO, scale)  # zero, and so is all that cancels in it
            gap = np.abs(value - true) / scale
            if kind == SLIDE_ARM:  # where no force acts at a slide it has no line of action
                gap = np.where(np.isnan(true), 0.0, gap)
            apart[group] = np.maximum(apart[group], gap)
    return apart


def _relative_vectors_size(scene: Scene, truth: Readings, kind: str, name: str) -> Any:
    """Size of the vectors from which a link's rate is read, relative to its longest side; 0 for any other result."""
    if not kind_of(kind).turning:
        return 0.0
    vectors, points = truth[kind_of(kind).group], scene.links[name]
    ends: Any = combinations([scene.points[point] for point in points], 2)
    longest = max((float(np.max(np.hypot(a[0] - b[0], a[1] - b[1]))) for a, b in ends), default=0.0)
    sizes = [np.abs(plain_number(component)) for point in points for component in vectors[point]]
    return np.max(np.broadcast_arrays(*sizes), axis=0) / longest if longest else 0.0


def _rolling_size(scene: Scene, motion: Any, kind: str) -> Any:
    """The size of what is turned about centres where links roll on each other: it may cancel in the motion of others.

    The pitch point has the velocity omega r about either centre, and the acceleration omega^2 r; nothing where no links
    roll, or of other results.
    """
    if kind_of(kind).group not in (VELOCITY, ACCELERATION):
        return 0.0
    pitch: list[tuple[Any, Any]] = [(gear, gear.pitch_point(scene.points)) for gear in scene.gears]
    pitch += [(contact, scene.points[contact.at]) for contact in scene.contacts if contact.rolling]
    sizes: list[Any] = [0.0]
    for pair, at in pitch:
        for link, centre in zip(pair.links, pair.centres, strict=False):
            if link != FRAME and centre and at:
                rate = np.abs(plain_number(motion.omega[link])) ** (1 if kind_of(kind).group == VELOCITY else 2)
                (x, y), (u, v) = at, scene.points[centre]
                sizes.append(rate if kind_of(kind).turning else rate * np.hypot(x - u, y - v))
    return np.max(np.broadcast_arrays(*sizes), axis=0)


def _contact_size(scene: Scene, truth: Readings, kind: str, name: str) -> Any:
    """Size of the moments of contact forces about a slide's point, which cancel if they pass through it, or of the
    slide's arm by them; 0 for other results."""
    sizes: list[Any] = [0.0]
    if kind in (SLIDE_MOMENT, SLIDE_ARM):
        whole = np.hypot(*(plain_number(component) for component in truth[SLIDE_REACTION][name]))
        of = whole if kind == SLIDE_ARM else float(metre(scene.units))
        slide = next(slide for slide in scene.slides if slide.name == name)
        for contact in (candidate for candidate in scene.contacts if candidate.name in truth[CONTACT_REACTION]):
            if not {*contact.links}.isdisjoint(slide.links):
                (x, y), (u, v) = (np.asarray(scene.points[point], float) for point in (contact.at, slide.at))
                force = np.hypot(*(plain_number(component) for component in truth[CONTACT_REACTION][contact.name]))
                sizes.append(force * np.hypot(x - u, y - v) / of)
    return np.max(np.broadcast_arrays(*sizes), axis=0)


def sound_poses(batch: PoseBatch, drawing: Construction, results: Readings, apart: Mapping[str, Any]) -> Any:
    """Flags of the poses whose results exist and agree with the solver's within rounding, shape (n,).

    Where that is proven of a pose, `apart` has the differences relative to what is proven to cancel there.
    """
    worst = np.max(list(apart.values()), axis=0)
    worst[np.isnan(worst)] = np.inf
    is_sound = worst <= ROUNDING_TOL
    for k in np.flatnonzero(~is_sound & np.isfinite(worst)):
        ours = {kind: {name: _as_vector(z[k]) for name, z in named.items()} for kind, named in results.items()}
        if proven := _prove_pose(batch.select(k), drawing, ours, worst[k]):
            is_sound[k] = True
            for group, gap in proven.items():
                apart[group][k] = gap
    return is_sound


def poses_rubbed_as_drawn(batch: PoseBatch, drawing: Construction) -> Any:
    """Flags of the poses whose friction acts as drawn, shape (n,): no pair moves that stands still in the drawing, and
    the solver presses slides that bear on a length at the same edges.
    """
    given, drawn = batch.scene.loads, drawing.scene.loads
    if given is None or drawn is None or given.pressed is None or drawn.pressed is None:
        return np.full(batch.places.size, (given and given.pressed) == (drawn and drawn.pressed))
    from graphplan.solver.friction import pressed_slides, resting, with_friction

    def vanishes(speed: Any) -> bool:
        return bool(np.max(np.abs(plain_number(speed))) <= RESTING_TOL * fastest)

    reach = float(batch.scene.extent)
    fastest = max(abs(float(drive.rate)) for drive in batch.scene.drives) * max(1.0, reach, 1 / reach)
    still_throughout = not drawn.resting or drawn.resting <= resting(
        poses.solve(batch.posed_scene, batch.places.size), vanishes)
    rubbed = np.ones(batch.places.size, dtype=bool)
    undecided = replace(batch, scene=replace(batch.scene, loads=replace(given, pressed=None, resting=drawn.resting)))
    for k in range(batch.places.size) if given.bear_on_lengths or not still_throughout else ():
        scene = single_pose(undecided.select(k).posed_scene)
        try:
            rubbed[k] = still_throughout or drawn.resting <= resting(solve(scene), vanishes)
            if rubbed[k] and given.bear_on_lengths:
                rubbed[k] = pressed_slides(with_friction(scene, scene.sheet.rounds)) == drawn.pressed
        except GraphplanError:
            rubbed[k] = False
    return rubbed


def _prove_pose(pose: PoseBatch, drawing: Construction, ours: Readings, worst: float) -> dict[str, float]:
    """The differences of one pose that is sound, by group: relative to the proven bounds, or without proven bounds
    relative to the condition; empty for a pose that is not sound.

    A pose of a cycle is known to rounding of the mechanism, and so are its numbers: differences that are negligible
    relative to the largest of their kind count relative to that one.
    """
    scene = single_pose(pose.posed_scene)
    try:
        reference = reference_solution(scene, FLOATS)
        truth = reference.truth(ours)
    except Unproven:
        try:
            holds = worst <= SAFETY_FACTOR * EPSILON * solve(scene).condition
        except GraphplanError:
            holds = False
        return {kind_of(kind).group: float(worst) for kind in ours} if holds else {}
    numbers = compare(drawing, ours, truth, lambda part, name: max(
        float(_relative_vectors_size(scene, truth, part, name)), float(_rolling_size(scene, reference.rates, part))))
    proven, largest = dict.fromkeys(compared_groups(drawing), 0.0), scales(drawing, truth)
    for kind, named in numbers.items():
        scale = largest[kind_of(kind).group] / weight(drawing, kind)
        for number in (number for vector in named.values() for number in vector):
            if not (number.close or number.near or number.gap <= SAFETY_FACTOR * (number.bound - number.gap)):
                return {}
            gap = number.gap / scale if number.near else number.relative("gap")
            proven[kind_of(kind).group] = max(proven[kind_of(kind).group], float(gap))
    return proven


def single_pose(scene: Scene) -> Scene:
    """A scene in one pose, its floats taken as they are."""
    def plain(pair: KinematicPair) -> KinematicPair:
        if isinstance(pair, Drive):
            return pair.driven_at(*pair.rates)
        return replace(pair, written=None) if isinstance(pair, Slide) else pair

    return replace(scene, irrational=(), placements={}, written=tuple(map(plain, scene.written)))


def _as_vector(number: Any) -> Any:
    return (number.real, number.imag) if isinstance(number, complex | np.complexfloating) else float(number)


OTHERWISE_RUBBED = "other pairs or edges rub here than in the pose that is drawn"
BLOCK_POSES = 1 << 16  # poses of a block: some 30 MB with all results of an eight-link chain
Results = Mapping[str, Mapping[str, Any]]
Keep = Callable[["Stream", int], Any]  # what is kept of the block that begins there: a function that has a name


class ComparedPoses(NamedTuple):
    """A block of the turn, the poses of it that are reached, and in these the drawn results, beside the solver's.

    `gaps` are their differences by kind and `sound` says where these are rounding; both are empty where nothing was
    compared. `faults` are by the place in the block.
    """

    turn: Turn
    reached: PoseBatch
    results: Results
    gaps: Mapping[str, Any]
    sound: Any
    faults: dict[int, str]


class PoseBlock(NamedTuple):
    """Neighbouring poses: the place of the first among all, where all is in them, and results as `Poses` have them.

    Where a pose is not reached, cannot be drawn or, if that was asked for, differs from the solver, its results are
    nan, and `faults` says why, by its place among all.
    """

    start: int
    turn: Turn
    results: Results
    faults: dict[int, str]


@dataclass(frozen=True, eq=False)
class Stream:
    """A construction in so many poses of its drive's turn, or of a span of its travel, both ends included.

    `only` some kinds of results are reckoned, all without it; `checked`, each pose is compared with the analytic
    solver, which takes most of the time; `compiled`, replays run in machine code; `length` is that of a block;
    `progress` is told how much of the way has been followed, before the first block.
    Fails with `Refused` where there are no positions, or results are named that the scene does not ask for, and as
    :func:`graphplan.cycle.follow` does, when the first block is asked for.
    """

    drawing: Construction
    positions: int
    span: tuple[float, float] | None = None
    only: Collection[str] | None = None
    checked: bool = True
    compiled: bool = False
    length: int = BLOCK_POSES
    progress: Progress | None = None

    def __post_init__(self) -> None:
        if self.positions < 1:
            raise Refused("the cycle", f"{self.positions} positions", "give at least 1")
        kinds = self.drawing.kinds
        if unknown := [kind for kind in self.only or () if kind not in kinds]:
            raise Refused(f"results {unknown[0]}", "the scene does not ask for them", f"of {', '.join(kinds)}")

    def blocks(self, workers: int | str = 1) -> Iterator[PoseBlock]:
        """All poses, block after block; by so many processes, or a dask scheduler at an address."""
        for block in self.shared_out(_without_motion, workers):
            yield block._replace(turn=replace(block.turn, motion=self.motion))

    def summary(self, workers: int | str = 1) -> Summary:
        """Summary of all poses: extremes, means and the first failure. Reads no more than it keeps."""
        whole = Summary()
        for part in self.shared_out(summary_of_block, workers):
            whole = whole + part
        return whole

    def shared_out(self, keep: Keep, workers: int | str) -> Iterator[Any]:
        """Yield the reduction of each block, in order; worker processes receive ranges and return reductions alone."""
        starts = range(0, self.positions, self.length)
        if workers == 1:
            yield from (keep(self, start) for start in starts)
            return
        bare = replace(self, drawing=replace(self.drawing), progress=None)  # without what was computed of it
        with worker_pool(workers) as shared_out:
            yield from shared_out(partial(_work, pickle.dumps(bare), keep), starts)

    def block(self, start: int) -> PoseBlock:
        """The block that begins with this pose."""
        poses = self.compare(start)
        turn, places, faults = poses.turn, poses.reached.places, poses.faults
        for place in places[~poses.sound].tolist() if self.checked else ():
            faults.setdefault(place, "the construction and the analytic solver differ")
        results = self.drawing.empty_arrays(len(turn.travel))
        results = {kind: named for kind, named in results.items() if self.only is None or kind in self.only}
        sound = ~np.isin(places, [*faults])
        for kind, named in poses.results.items():
            for name, z in named.items():
                results[kind][name][places[sound]] = z[sound]
        return PoseBlock(start, turn, results, {start + place: why for place, why in sorted(faults.items())})

    def compare(self, start: int) -> ComparedPoses:
        """Compare construction and solver in the block that begins with this pose; unreached poses are left out."""
        drawing, scene = self.drawing, self.drawing.scene
        turn = self.motion.turn(self._travels.part(start, start + self.length), self.compiled)
        batch = PoseBatch.of_reached(scene, turn.points, turn.guides, turn.loads)
        faults = dict(turn.faults)
        if not batch.places.size:
            return ComparedPoses(turn, batch, {}, {}, np.empty(0, bool), faults)
        poses = drawing.evaluate(batch.points, batch.guides, loads=batch.loads, only=self.only, compiled=self.compiled)
        faults.update((int(batch.places[place]), why) for place, why in poses.faults.items())
        rubbed = poses_rubbed_as_drawn(batch, drawing)
        for place in batch.places[~rubbed].tolist():
            faults.setdefault(place, OTHERWISE_RUBBED)
        if not self.checked:
            return ComparedPoses(turn, batch, poses.results, {}, np.empty(0, bool), faults)
        gaps = pose_gaps(batch, drawing, poses.results)
        sound = sound_poses(batch, drawing, poses.results, gaps) & rubbed
        return ComparedPoses(turn, batch, poses.results, gaps, sound, faults)

    @cached_property
    def motion(self) -> RangeOfMotion:
        """The motion, led to its ends."""
        return range_for(self.drawing.scene, self._travels, self.progress)

    @property
    def _travels(self) -> Travels:
        return Travels(self.drawing.scene, self.positions, self.span)


@lru_cache(maxsize=1)
def _load_stream(pickled: bytes) -> Stream:
    """A stream as a worker is told it: what is made of it in the first range serves in all others."""
    stream: Stream = pickle.loads(pickled)
    return stream


def _work(pickled: bytes, keep: Keep, start: int) -> Any:
    """Reduce a block in a worker process."""
    return keep(_load_stream(pickled), start)


def _without_motion(of: Stream, start: int) -> PoseBlock:
    """The block as it is sent: whoever asked for it has the motion."""
    block = of.block(start)
    return block._replace(turn=replace(block.turn, motion=None))


@dataclass(frozen=True)
class Extremes:
    """Extremes of a number, or of the length of a vector, over many poses: the least and the greatest, each with the
    travel of the first drive at which it is, in degrees or lengths, and the mean, over `count` poses; nan for no
    pose."""

    least: float = np.nan
    least_at: float = np.nan
    greatest: float = np.nan
    greatest_at: float = np.nan
    mean: float = np.nan
    count: int = 0

    def __add__(self, other: Extremes) -> Extremes:
        """Extremes of both sets of poses."""
        if not (self.count and other.count):
            return self if self.count else other
        low, high = min(self, other, key=lambda one: one.least), max(self, other, key=lambda one: one.greatest)
        count = self.count + other.count
        mean = self.mean + (other.mean - self.mean) * (other.count / count)
        return Extremes(low.least, low.least_at, high.greatest, high.greatest_at, mean, count)


@dataclass(frozen=True)
class Summary:
    """Summary of many poses: the extremes of each result by kind and name, the number of poses with faults, and the
    first of these with its place."""

    results: Mapping[str, Mapping[str, Extremes]] = field(default_factory=dict)
    count: int = 0
    failures: int = 0
    first_failure: tuple[int, str] | None = None

    def __add__(self, other: Summary) -> Summary:
        """Summary of both sets of poses, the other's after these."""
        nothing = Extremes()
        results = {kind: {name: self.results.get(kind, {}).get(name, nothing) + extremes
                          for name, extremes in named.items()} for kind, named in other.results.items()}
        return Summary(results or self.results, self.count + other.count, self.failures + other.failures,
                       self.first_failure or other.first_failure)


def summary_of_block(of: Stream, start: int) -> Summary:
    """Summary of the block that begins at `start`."""
    block = of.block(start)
    travel = printed_travels(of.drawing.scene, block.turn.travel)
    results = {kind: {name: extremes_of(np.abs(z) if np.iscomplexobj(z) else z, travel)
                      for name, z in named.items()} for kind, named in block.results.items()}
    return Summary(results, len(travel), len(block.faults), next(iter(block.faults.items()), None))


def extremes_of(numbers: Any, travel: Any) -> Extremes:
    """The extremes of numbers, without those that are nan, at these travels."""
    there = np.flatnonzero(np.isfinite(numbers))
    if not there.size:
        return Extremes()
    low, high = there[np.argmin(numbers[there])], there[np.argmax(numbers[there])]
    return Extremes(float(numbers[low]), float(travel[low]), float(numbers[high]), float(travel[high]),
                    float(np.mean(numbers[there])), int(there.size))
