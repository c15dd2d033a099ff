"""Sheets of random linkages: what is nothing is not drawn large."""

from __future__ import annotations

import pytest
from linkages import scenes

import graphplan as gp
from graphplan.sheet.plates.plans import Plans

AT_REST = (309, 311, 321)  # no link has a normal acceleration beside another: their plan holds rounding alone


@pytest.mark.parametrize("seed", AT_REST)
def test_a_plan_of_rounding_is_a_spot(seed: int) -> None:
    """Marks that differ by rounding alone are one spot, so that no scale is chosen by them."""
    plans = Plans(gp.construct(next(scenes(seed))))
    sizes = {panel: max(extent.core.width, extent.core.height)
             for panel in plans.panels for extent in [plans.extent(panel)]}
    assert sizes["N-plan"] == 0 < sizes["mechanism"]
    assert all(abs(x) + abs(y) > 1e-6 for x, y in plans.extent("N-plan").extra)
