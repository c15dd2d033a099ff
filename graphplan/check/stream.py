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

from graphplan.check.poses import PoseBatch, pose_gaps, sound_poses
from graphplan.cycle.travel import Travels
from graphplan.cycle.turn import RangeOfMotion, Turn, range_for
from graphplan.errors import Refused
from graphplan.mechanism.travel import printed_travels
from graphplan.methods.construction import Construction
from graphplan.methods.executors import crew

BLOCK_POSES = 1 << 16  # poses of a block: some 30 MB with all results of an eight-link chain
Results = Mapping[str, Mapping[str, Any]]
Keep = Callable[["Stream", "PoseBlock"], Any]  # what is kept of a block: a function with a name, which processes send


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
    solver, which takes most of the time; `compiled`, replays run in machine code; `length` is that of a block.
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

    def __post_init__(self) -> None:
        if self.positions < 1:
            raise Refused("the cycle", f"{self.positions} positions", "give at least 1")
        kinds = self.drawing.kinds
        if unknown := [kind for kind in self.only or () if kind not in kinds]:
            raise Refused(f"results {unknown[0]}", "the scene does not ask for them", f"of {', '.join(kinds)}")

    def blocks(self, workers: int | str = 1) -> Iterator[PoseBlock]:
        """All poses, block after block; by so many processes, or a dask scheduler at an address."""
        for block in self.shared_out(_without_motion, workers):
            yield block._replace(turn=replace(block.turn, motion=self._motion[0]))

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
            yield from (keep(self, self.block(start)) for start in starts)
            return
        bare = replace(self, drawing=replace(self.drawing))  # without what was computed of it
        with crew(workers) as shared_out:
            yield from shared_out(partial(_work, pickle.dumps(bare), keep), starts)

    def block(self, start: int) -> PoseBlock:
        """The block that begins with this pose."""
        motion, travels = self._motion
        travel = travels.part(start, start + self.length)
        turn = motion.turn(travel, self.compiled)
        batch = PoseBatch.of_reached(self.drawing.scene, turn.points, turn.guides, turn.loads)
        faults = dict(turn.faults)
        results = self.drawing.empty_arrays(len(travel))
        results = {kind: named for kind, named in results.items() if self.only is None or kind in self.only}
        if batch.places.size:
            self._enter(batch, results, faults)
        at = {start + place: why for place, why in sorted(faults.items())}
        return PoseBlock(start, turn, results, at)

    @cached_property
    def _motion(self) -> tuple[RangeOfMotion, Travels]:
        """The motion, led to its ends, and all travels."""
        travels = Travels(self.drawing.scene, self.positions, self.span)
        return range_for(self.drawing.scene, travels), travels

    def _enter(self, batch: PoseBatch, results: Results, faults: dict[int, str]) -> None:
        """Enter the results of the poses that are reached: of others nothing is reckoned."""
        drawing = self.drawing
        poses = drawing.evaluate(batch.points, batch.guides, loads=batch.loads, only=self.only, compiled=self.compiled)
        faults.update((int(batch.places[place]), why) for place, why in poses.faults.items())
        if self.checked:
            sound = sound_poses(batch, drawing, poses.results, pose_gaps(batch, drawing, poses.results))
            for place in batch.places[~sound].tolist():
                faults.setdefault(place, "the construction and the analytic solver differ")
        drawn = ~np.isin(batch.places, [*faults])
        for kind, named in results.items():
            for name, z in named.items():
                z[batch.places[drawn]] = poses.results[kind][name][drawn]


@lru_cache(maxsize=1)
def _load_stream(pickled: bytes) -> Stream:
    """A stream as a worker is told it: what is made of it in the first range serves in all others."""
    stream: Stream = pickle.loads(pickled)
    return stream


def _work(pickled: bytes, keep: Keep, start: int) -> Any:
    """What is kept of a block, in a worker."""
    of = _load_stream(pickled)
    return keep(of, of.block(start))


def _without_motion(of: Stream, block: PoseBlock) -> PoseBlock:
    """The block as it is sent: whoever asked for it has the motion."""
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


def summary_of_block(of: Stream, block: PoseBlock) -> Summary:
    """What the poses of a block come to."""
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
