"""Any number of poses of a cycle, block by block: what is kept is one block, or what a reduction keeps of all.

A worker is told the construction once and then ranges of poses; it gives back results, or what is kept of them.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache, partial
from typing import Any, NamedTuple

import numpy as np

from graphplan.check.poses import PoseBatch, pose_gaps, poses_rubbed_as_drawn, sound_poses
from graphplan.cycle.continuation import Progress
from graphplan.cycle.travel import Travels
from graphplan.cycle.turn import RangeOfMotion, Turn, range_for
from graphplan.errors import Refused
from graphplan.mechanism.travel import printed_travels
from graphplan.methods.construction import Construction
from graphplan.methods.executors import worker_pool

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
        """What all poses come to: extremes, means and the first failure. Reads no more than it keeps."""
        whole = Summary()
        for part in self.shared_out(summary_of_block, workers):
            whole = whole + part
        return whole

    def shared_out(self, keep: Keep, workers: int | str) -> Iterator[Any]:
        """What is kept of each block, one after the other: workers are told ranges, and give back that alone."""
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
        """The block that begins with this pose: of poses that are not reached nothing is reckoned."""
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

    @cached_property
    def _travels(self) -> Travels:
        return Travels(self.drawing.scene, self.positions, self.span)


@lru_cache(maxsize=1)
def _load_stream(pickled: bytes) -> Stream:
    """A stream as a worker is told it: what is made of it in the first range serves in all others."""
    stream: Stream = pickle.loads(pickled)
    return stream


def _work(pickled: bytes, keep: Keep, start: int) -> Any:
    """What is kept of a block, in a worker."""
    return keep(_load_stream(pickled), start)


def _without_motion(of: Stream, start: int) -> PoseBlock:
    """The block as it is sent: whoever asked for it has the motion."""
    block = of.block(start)
    return block._replace(turn=replace(block.turn, motion=None))


# ---- reductions ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Extremes:
    """Of a number, or of the length of a vector, over many poses: the least and the greatest, each with the travel of
    the first drive at which it is, in degrees or lengths, and the mean, over `count` poses; of none they are nan."""

    least: float = np.nan
    least_at: float = np.nan
    greatest: float = np.nan
    greatest_at: float = np.nan
    mean: float = np.nan
    count: int = 0

    def __add__(self, other: Extremes) -> Extremes:
        """Those of both sets of poses."""
        if not (self.count and other.count):
            return self if self.count else other
        low, high = min(self, other, key=lambda one: one.least), max(self, other, key=lambda one: one.greatest)
        count = self.count + other.count
        mean = self.mean + (other.mean - self.mean) * (other.count / count)
        return Extremes(low.least, low.least_at, high.greatest, high.greatest_at, mean, count)


@dataclass(frozen=True)
class Summary:
    """What many poses come to: the extremes of each result by kind and name, how many poses have faults, and the first
    of these with its place."""

    results: Mapping[str, Mapping[str, Extremes]] = field(default_factory=dict)
    count: int = 0
    failures: int = 0
    first_failure: tuple[int, str] | None = None

    def __add__(self, other: Summary) -> Summary:
        """That of both sets of poses, the other's after these."""
        nothing = Extremes()
        results = {kind: {name: self.results.get(kind, {}).get(name, nothing) + extremes
                          for name, extremes in named.items()} for kind, named in other.results.items()}
        return Summary(results or self.results, self.count + other.count, self.failures + other.failures,
                       self.first_failure or other.first_failure)


def summary_of_block(of: Stream, start: int) -> Summary:
    """What the poses of the block that begins there come to."""
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
