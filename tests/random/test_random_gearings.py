"""Any mechanism with gears and contacts is constructed as the solver has it, to the last digit, in any order."""

from __future__ import annotations

import pytest
from gearings import gearing
from linkages import scenes

from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Fractions
from graphplan.methods.construct import construct
from graphplan.solver import solve

GEARINGS = 16
TOGETHER = 8  # mechanisms to a test
STYLES = [(method, plan) for plan in ("orthogonal", "polar", "") for method in ("", "trial", "auxiliary", "poles")]


@pytest.mark.parametrize("first", range(0, GEARINGS, TOGETHER))
def test_gearings_are_constructed_exactly(first: int) -> None:
    """Every velocity, acceleration, turning and sliding is the solver's as a fraction, and the same steps are drawn
    whatever the order of writing."""
    for seed in range(first, first + TOGETHER):
        drawn = set()
        for number, scene in enumerate(scenes(seed, 2, gearing)):
            try:
                truth = solve(scene, exact=True)
            except SingularPose:
                break
            method, plan = STYLES[(seed + number) % len(STYLES)]
            for kind, values in construct(scene, method=method, plan=plan).read(Fractions()).items():
                exact = getattr(truth, kind.replace(" ", "_"))
                wrong = {name for name, value in values.items() if value != exact[name]}
                assert not wrong, f"gearing {seed}, order {number}, {method} {plan}: {kind} of {wrong}"
            drawn.add(tuple(construct(scene).sentences()))
        assert len(drawn) <= 1, f"gearing {seed}"


def test_gearings_are_of_every_kind() -> None:
    """Chance makes wheels, rings, belts and racks, curved and straight profiles that slide and that roll."""
    kinds = set.union(*(gearing(seed).kinds for seed in range(GEARINGS)))
    assert kinds >= {"outside", "internal = true", "straight", "curved"}, kinds
