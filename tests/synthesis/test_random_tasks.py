"""Syntheses by chance: found, or missing for a reason that names what would do; defects as a trace in motion has them.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from followed import Trace, traced_defects, traced_type
from tasks import RandomTasks

from graphplan.errors import NoMechanism
from graphplan.synthesis.check import check_synthesis
from graphplan.synthesis.find import find_mechanism
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.sketch import Synthesis
from graphplan.synthesis.stroke import SlottedLever
from graphplan.synthesis.task import parse

SEEDS, TOGETHER = 200, 20
NEAR_CHANGE = 2e-3  # of the sum of all links: so near a change point a trace steps from one circuit to the other


def find(seed: int, folder: Path) -> Synthesis | str:
    """What is found, or why nothing is."""
    try:
        return find_mechanism(parse(RandomTasks(seed, folder).text, "task"))
    except NoMechanism as missing:
        return str(missing)


@pytest.mark.parametrize("first", range(0, SEEDS, TOGETHER))
def test_random_tasks_are_found_or_missing_for_a_reason(first: int, tmp_path: Path) -> None:
    """Each linkage keeps its positions and is followed through them, or the reason says what would do. Type, defects,
    travel and least transmission angle are those of a linkage moved step by step."""
    for seed in range(first, first + TOGETHER):
        synthesis = find(seed, tmp_path)
        if isinstance(synthesis, str):
            assert synthesis.startswith("task: "), seed
            assert synthesis.partition("; ")[2], seed
            continue
        assert check_synthesis(synthesis)["positions"] < 1e-9, seed
        for linkage in synthesis.linkages:
            if not isinstance(linkage, SlottedLever) and abs(linkage.grashof) > NEAR_CHANGE and len(linkage.A) > 1:
                assert traced(linkage) == (linkage.type, {*linkage.defects}), seed


def traced(linkage: FoundLinkage) -> tuple[str, set[str]]:
    """Type and defects by the trace, which has the travel and the angle, too, where these are told."""
    traces = [Trace(linkage, way) for way in (1, -1)]
    defects, motion = traced_defects(traces)
    if motion is not None and not linkage.whole_turn:
        assert linkage.travel is not None
        assert motion[0] == pytest.approx(linkage.travel[-1], abs=0.01)
        assert motion[1] == pytest.approx(linkage.transmission[0], abs=0.01 + motion[2])
    return traced_type(traces[0]), defects
