"""The planner knows no names: a linkage is drawn by the same steps whatever its links and points are called.

More, and longer linkages, with TESTS=thorough.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from henneberg import henneberg, under_other_names

from graphplan.errors import Refused
from graphplan.mechanism.model import Find, Scene
from graphplan.methods.construct import construct
from graphplan.methods.motion.moves import FalsePosition, Move
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner

NAMINGS = 3


def steps(scene: Scene) -> list[tuple[str, tuple[int, ...]]] | str:
    """The operations of a construction, each with the steps that it reads; or that it is refused."""
    try:
        return [(step.op.name, step.args) for step in construct(scene).program.steps]
    except Refused:
        return "refused"


@pytest.mark.parametrize("parted", [0.3, 0.6])
@pytest.mark.parametrize("links", [12, 24, 40])
def test_other_names_give_the_same_steps(links: int, parted: float) -> None:
    """Under all names the same steps read the same marks, or all are refused."""
    for seed in range(2):
        scene = henneberg(links, seed, parted)
        first, *others = (steps(under_other_names(scene, naming)) for naming in range(NAMINGS))
        assert all(other == first for other in others), seed


def asking_for_poles(scene: Scene, seed: int) -> Scene:
    """The linkage under these other names, which asks for the poles relative to the frame alone."""
    renamed = under_other_names(scene, seed)
    return replace(renamed, find=Find((), (), poles=tuple(f"{link} frame" for link in renamed.moving)))


def test_other_names_give_the_same_poles() -> None:
    """Under all names the poles of links relative to the frame are found by the same steps from the same marks."""
    for seed in range(5):
        scene = henneberg(10 + seed % 4, 100 + seed, 0.3)
        first, *others = (steps(asking_for_poles(scene, naming)) for naming in range(NAMINGS))
        assert first != "refused"
        assert all(other == first for other in others), seed


def depth(moves: list[Move] | tuple[Move, ...]) -> int:
    """How deep trials nest in moves."""
    return max((1 + depth(move.moves) for move in moves if isinstance(move, FalsePosition)), default=0)


@pytest.mark.parametrize("links", [40, 80])
def test_random_linkages_are_planned_with_few_trials_in_each_other(links: int) -> None:
    """Of random linkages of so many links most are planned, with trials three deep at most."""
    planned, seeds = 0, range(8)
    for seed in seeds:
        planner = Planner(Network(henneberg(links, seed, 0.4)))
        try:
            assert depth(planner.plan()) <= 3
            planned += 1
        except Refused:
            pass
    assert planned >= 0.8 * len(seeds)
