"""Poses by the block: the same numbers as all at once, in the memory of one block."""

from __future__ import annotations

import pickle
import tracemalloc
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.check.stream import PoseBlock, Stream, Summary
from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.travel import printed_travels
from graphplan.methods.executors import SharedOut
from graphplan.methods.kinds import VELOCITY

POSITIONS, LENGTH = 500, 64
SCENES = "four-bar", "slider-crank", "ozols-13-6"


@pytest.mark.parametrize("name", SCENES)
def test_blocks_are_the_cycle_in_parts(name: str) -> None:
    """Joined, the blocks are what the cycle gives at once: travels, points, results and faults."""
    scene = gp.load(name)
    whole = cycle(scene, POSITIONS)
    blocks = list(Stream(whole.drawing, POSITIONS, length=LENGTH).blocks())

    def chained(part: Callable[[PoseBlock], object]) -> object:
        return np.concatenate([part(block) for block in blocks])

    assert np.array_equal(chained(lambda block: block.turn.travel), whole.turn.travel)
    for point, z in whole.turn.points.items():
        assert np.array_equal(chained(lambda block, point=point: block.turn.points[point]), z, equal_nan=True), point
    for kind, named in whole.results.items():
        for of, z in named.items():
            ours = chained(lambda block, kind=kind, of=of: block.results[kind][of])
            assert np.array_equal(ours, z, equal_nan=True), (kind, of)
    assert {place for block in blocks for place in block.faults} == whole.faults.keys()


def test_a_summary_is_that_of_all_poses() -> None:
    """Extremes, their travels, means and the first failure are those of the arrays; by two processes they are the same.
    """
    drawing = gp.construct(gp.load("plough-lift"))
    span, poses = (0.0, 200.0), POSITIONS
    whole = cycle(drawing.scene, poses, span)
    assert whole.faults
    some = Stream(drawing, poses, span, length=LENGTH)
    told = some.summary()
    assert (told.count, told.failures) == (poses, len(whole.faults))
    assert told.first_failure is not None
    assert told.first_failure[0] == min(whole.faults)
    for kind, named in told.results.items():
        for name, extremes in named.items():
            z = whole.results[kind][name]
            sizes = np.abs(z) if np.iscomplexobj(z) else z
            assert (extremes.least, extremes.greatest) == (np.nanmin(sizes), np.nanmax(sizes))
            assert sizes[printed_travels(drawing.scene, whole.turn.travel) == extremes.greatest_at] == extremes.greatest
            assert extremes.mean == pytest.approx(np.nanmean(sizes), rel=1e-12)
            assert extremes.count == poses - len(whole.faults)
    assert some.summary(workers=2) == told


def test_memory_is_that_of_a_block() -> None:
    """Eight times as many poses take no more memory."""
    drawing = gp.construct(gp.load("four-bar"))

    def peak(count: int) -> int:
        tracemalloc.start()
        told: Summary = Stream(drawing, count, only=(VELOCITY,), checked=False, length=4096).summary()
        assert told.count == count
        highest = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return highest

    peak(4096)  # what is made once
    assert peak(16 * 4096) < 1.2 * peak(2 * 4096)


def test_results_that_are_not_asked_for_are_refused() -> None:
    """Kinds that the scene has no reading of, and no positions, are told before any work is done."""
    drawing = gp.construct(gp.load("four-bar"))
    with pytest.raises(Refused, match="torque"):
        Stream(drawing, 10, only=("torque",))
    with pytest.raises(Refused, match="at least 1"):
        Stream(drawing, 0)


def test_a_cycle_is_shared_out_in_ranges(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two processes, each told the construction and then where its blocks begin, give the cycle that one gives, to the
    poses that another form must draw; what is sent does not grow with the poses."""
    from graphplan.check import stream
    from graphplan.check.cycle import MIN_BLOCK

    sizes = list[int]()

    @contextmanager
    def worker_pool(workers: int) -> Iterator[SharedOut]:
        def shared_out(work: Callable[[object], object], parts: Iterable[object]) -> Iterator[object]:
            for part in parts:
                sizes.append(len(pickle.dumps((work, part))))
                yield pickle.loads(pickle.dumps(work))(part)

        yield shared_out

    scene, count = gp.load("plough-lift"), 2 * MIN_BLOCK
    one = cycle(scene, count, (0.0, 200.0))
    monkeypatch.setattr(stream, "worker_pool", worker_pool)
    two = cycle(scene, count, (0.0, 200.0), workers=2)
    assert one.faults
    assert two.faults == one.faults
    assert two.otherwise == one.otherwise
    for kind, named in one.results.items():
        for name, z in named.items():
            assert np.array_equal(two.results[kind][name], z, equal_nan=True), (kind, name)
    assert len(sizes) == 2
    assert max(sizes) - min(sizes) < 16, "of a range its beginning"
    assert sizes[0] < 16 * count, "less than the place of one point in each pose"


def test_what_a_worker_refuses_is_told() -> None:
    """A fault crosses to whoever asked as it is: its class, its line and what it knows."""
    fault = pickle.loads(pickle.dumps(Refused("the load P", "its table ends at 90", "a table to 360")))
    assert isinstance(fault, Refused)
    assert (str(fault), fault.do) == ("the load P: its table ends at 90; a table to 360", "a table to 360")
    singular = pickle.loads(pickle.dumps(SingularPose("no velocities", ("3", "2"))))
    assert (str(singular), singular.links) == ("singular pose of links 2, 3; no velocities", ("2", "3"))
