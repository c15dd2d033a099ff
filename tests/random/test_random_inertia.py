"""Random loaded linkages: every form of the inertia forces gives the same reactions and balances, in fractions."""

from __future__ import annotations

import pytest
from loads import loaded_scenes

from graphplan.check.trusted import report
from graphplan.errors import GraphplanError
from graphplan.mechanism.sections import INERTIA

SEEDS = range(8)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("form", INERTIA[1:])
def test_forms_of_inertia_agree_exactly(form: str, seed: int) -> None:
    """By centre of percussion, point masses or pins as by the couple: equal to the solver, as fractions."""
    for scene in loaded_scenes(seed, 1):
        for plan in ("polygons", "lever"):
            try:
                checked = report(scene, exact=True, plan=plan, inertia=form)
            except GraphplanError:  # this pose cannot be drawn with this plan at all
                with pytest.raises(GraphplanError):
                    report(scene, exact=True, plan=plan)
                continue
            assert checked.check["force"] == 0
