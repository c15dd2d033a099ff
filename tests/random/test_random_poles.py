"""All poles of random linkages by construction, beside the solver's rates, as fractions."""

from __future__ import annotations

import pytest
from linkages import linkage
from polar import with_all_poles
from tiers import sample

from graphplan.check.trusted import report
from graphplan.errors import SingularPose
from graphplan.mechanism.scene import parse
from graphplan.solver import solve

TOGETHER = 8  # linkages to a test


@pytest.mark.parametrize("first", range(0, sample(8, 32), TOGETHER))
def test_poles_are_constructed_exactly(first: int) -> None:
    """However a linkage is driven, and however many of its lines fall in one, every pole is exactly the solver's."""
    agreed = 0
    for seed in range(first, first + TOGETHER):
        scene = with_all_poles(parse(linkage(seed).text(), f"random {seed}"))
        try:
            solve(scene, exact=True)
        except SingularPose:
            continue
        assert report(scene, exact=True).agrees, seed
        agreed += 1
    assert agreed > TOGETHER // 2
