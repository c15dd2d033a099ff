"""Hand drawings of every kind are judged well in the shares that were measured: see `judged_drawings.py`."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, islice
from pathlib import Path

import pytest
from drawing_files import FORMATS
from drawing_tasks import SINGLE
from hand_drawings import wrong_as_a_whole
from judged_drawings import KINDS, Judged, judged, written


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_of_drawings_is_judged_well(kind: str, tmp_path: Path) -> None:
    """Few right ones are called wrong, those that show all have all points, and of the others the place and the kind of
    the mistake are named, so that hardly any has nearly all points."""
    shares = KINDS[kind].shares(KINDS[kind].number, KINDS[kind].seed, tmp_path)
    assert KINDS[kind].misses(shares) == {}, shares


def whole_plans(folder: Path) -> list[Judged]:
    """Twenty drawings of which a plan is reversed, turned or at another scale, in files of all forms."""
    def made() -> Iterator[Judged]:
        for number in count():
            name, seed = [*SINGLE][number % len(SINGLE)], 200 + number // len(SINGLE)
            try:
                drawing = wrong_as_a_whole(name, seed)
            except LookupError:
                continue
            yield judged(drawing, written(drawing, [*FORMATS][number % len(FORMATS)], folder))

    return [*islice(made(), 20)]


def test_a_plan_that_is_wrong_as_a_whole_is_always_told(tmp_path: Path) -> None:
    """As a mistake, or where it is but at another scale as the reading."""
    for one in whole_plans(tmp_path):
        assert one.drawing.fault
        reading = str(one.data and one.data["reading"])
        scaled = one.drawing.fault.kind == "plan of another scale" and ("times as large" in reading or "k_v" in reading)
        assert one.first or scaled, one.drawing.fault
