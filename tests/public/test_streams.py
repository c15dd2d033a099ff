"""Streams of poses as users have them: series, sums and files, the same as of all poses at once."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.errors import Refused
from graphplan.output.tables import text
from graphplan.public.construction import MotionStream, WorkingDrawing

POSES, SPAN = 90, (0.0, 200.0)  # the plough is not lifted so far


def in_blocks(drawing: WorkingDrawing, workers: int = 1) -> MotionStream:
    """The poses in blocks of forty."""
    whole = drawing.stream(POSES, SPAN, workers=workers)
    return replace(whole, stream=replace(whole.stream, length=40))


@pytest.fixture(scope="module")
def drawing() -> WorkingDrawing:
    return gp.construct(gp.load("plough-lift"))


def test_series_are_the_motion_in_parts(drawing: WorkingDrawing) -> None:
    """Each block is a series: its columns, joined, are those of all poses, and its faults count from its first."""
    poses = gp.follow(drawing.scene, POSES, SPAN)
    whole, series = drawing.evaluate(poses), [*in_blocks(drawing)]
    assert [len(part.poses) for part in series] == [40, 40, 10]
    for name, column in whole.table().items():
        joined = np.concatenate([part.table()[name] for part in series])
        reached = np.isfinite(joined)
        assert np.array_equal(joined[reached], column[reached]), name
    faults = {40 * k + pose for k, part in enumerate(series) for pose in part.faults}
    assert faults >= whole.faults.keys()
    assert all(not np.isfinite(part.omega["4"][[*part.faults]]).any() for part in series)


@pytest.mark.parametrize("workers", [1, 2])
def test_files_are_those_of_the_cycle(drawing: WorkingDrawing, workers: int, tmp_path: Path) -> None:
    """The text is byte for byte that of `graphplan cycle`, whoever computes it."""
    stream, whole = in_blocks(drawing, workers), cycle(drawing.scene, POSES, SPAN)
    stream.save(tmp_path / "lift.csv")
    lines = (tmp_path / "lift.csv").read_text()
    assert lines == text(whole.scene, whole.turn.travel, whole.requested_points, whole.results, whole.faults)
    assert not any([*csv.reader(lines.splitlines())][-1][2:-1]), "of what is not reached there is nothing"


def test_a_table_that_breaks_off_leaves_nothing(drawing: WorkingDrawing, tmp_path: Path,
                                                monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a block cannot be computed the file that is there stays as it was."""
    (tmp_path / "lift.csv").write_text("as it was")
    stream = in_blocks(drawing)
    first = type(stream.stream).block

    def refuse(self: object, start: int) -> object:
        if start:
            raise Refused("a block", "it breaks", "another")
        return first(self, start)  # type: ignore[arg-type]

    monkeypatch.setattr(type(stream.stream), "block", refuse)
    with pytest.raises(Refused, match="breaks"):
        stream.save(tmp_path / "lift.csv")
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("lift.csv", "as it was")]


def test_a_summary_has_results_by_name(drawing: WorkingDrawing) -> None:
    """Extremes are found by kind and name."""
    summary = in_blocks(drawing).summary()
    omega = summary.results["omega"]["4"]
    assert omega.least < omega.mean < omega.greatest
    assert 0 <= omega.least_at <= SPAN[1]
    assert summary.first_failure is not None
