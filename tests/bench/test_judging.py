"""The generator of hand drawings makes what it says: faultless ones that are right, and mistakes that are seen."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from judging.faults import apart, faulty
from judging.hand import drawn
from judging.mechanisms import mechanism
from judging.outcome import judged
from judging.table import KINDS, measure, rows
from judging.task import task


@pytest.mark.parametrize("seed", range(4))
def test_a_hand_without_a_mistake_is_near_the_truth(seed: int, tmp_path: Path) -> None:
    """What is given is as the sheet has it, and what follows a few pencil's widths off at most."""
    scene = task(mechanism(seed, tmp_path))
    made = drawn(scene, seed, printed=True)
    for index, place in enumerate(made.places):
        true = scene.paper(index, scene.truth[index])
        assert scene.number(index) or place == true
        assert scene.steps[index].op.gives != "point" or abs(complex(*place[:2]) - complex(*true[:2])) < 8


@pytest.mark.parametrize("seed", range(4))
def test_a_mistake_is_larger_than_the_pencil(seed: int) -> None:
    """The step is off; those before it are where they were without the mistake."""
    made = faulty(task("four-bar"), seed)
    right, fault = drawn(made.task, seed), made.fault
    assert fault is not None
    assert all(made.places[index] == right.places[index] for index in range(fault.index))
    assert fault.letters or fault.hidden or apart(made, right, fault.index) > 3


@pytest.mark.parametrize("kind", KINDS)
def test_every_writer_writes_what_the_judge_reads(kind: str, tmp_path: Path) -> None:
    """A faultless four-bar of each kind is read, and not refused."""
    sketch = drawn(task("four-bar"), 2, printed=True)
    path, shown = KINDS[kind](sketch, 2, tmp_path)
    one = judged(path, sketch, shown)
    assert one.data is not None, one.error


def test_the_table_has_a_row_a_kind() -> None:
    """Two drawings of points, counted."""
    (row,) = rows({"points": measure("points", range(2, 4))})
    assert row.startswith("| points | 1 | ")
