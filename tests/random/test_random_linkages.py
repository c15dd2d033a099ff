"""Any linkage that its drives determine is constructed as the solver has it, to the last digit, in any order."""

from __future__ import annotations

from fractions import Fraction

import pytest
from linkages import scenes

from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct
from graphplan.solver import Rates, solve

LINKAGES = 24
TOGETHER = 12  # linkages to a test
MOST_STEPS = 1000  # of a construction: no more can be drawn
STYLES = [(method, plan) for plan in ("orthogonal", "polar", "") for method in ("", "trial", "auxiliary", "poles")]


def rates(scene: Scene) -> Rates | None:
    """The solver's rates, as fractions; None where the pose is singular."""
    try:
        return solve(scene, exact=True)
    except SingularPose:
        return None


@pytest.mark.parametrize("first", range(0, LINKAGES, TOGETHER))
def test_linkages_are_constructed_exactly(first: int) -> None:
    """Every velocity, acceleration, turning and sliding is the solver's as a fraction, whatever the method and plan."""
    for seed in range(first, first + TOGETHER):
        for number, scene in enumerate(scenes(seed)):
            truth = rates(scene)
            if truth is None:
                break
            method, plan = STYLES[(seed + number) % len(STYLES)]
            drawing = construct(scene, method=method, plan=plan)
            assert len(drawing.program) <= MOST_STEPS, f"linkage {seed}, order {number}"
            results = drawing.read(Fractions())
            for kind, values in results.items():
                exact = getattr(truth, kind.replace(" ", "_"))
                wrong = {name for name, value in values.items() if value != exact[name]}
                assert not wrong, f"linkage {seed}, order {number}, {method} {plan}: {kind} of {wrong}"


@pytest.mark.parametrize("first", range(0, LINKAGES // 2, TOGETHER))
def test_the_order_of_writing_draws_nothing_else(first: int) -> None:
    """Links, points, slides and drives in another order give the same steps with the same letters."""
    for seed in range(first, first + TOGETHER):
        found = [scene for scene in scenes(seed) if rates(scene)]
        drawn = {tuple(construct(scene).sentences()) for scene in found}
        assert len(drawn) <= 1, f"linkage {seed}"


def test_most_linkages_are_regular() -> None:
    """Chance makes few poses singular, and links of every number: the other tests are not empty."""
    found = [next(scenes(seed, orders=1)) for seed in range(LINKAGES)]
    assert sum(rates(scene) is not None for scene in found) > 0.8 * len(found)
    assert len({len(scene.moving) for scene in found}) > 5
    assert all(isinstance(x, Fraction) for scene in found for at in scene.points.values() for x in at)
