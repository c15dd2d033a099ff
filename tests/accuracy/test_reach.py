"""Constructions for the reach of drags: together they draw what one form cannot, and what is missed is put right."""

from __future__ import annotations

import numpy as np
import pytest
from drawings import drawing_of

from graphplan.accuracy.reach import (
    best_construction,
    constructions,
    failing_compounds,
    poses_drawn_right,
    reachable_poses,
)

SCENES = ["four-bar", "shaper", "double-butterfly", "kinytskyi", "triad", "walschaerts-loaded"]


@pytest.mark.parametrize("name", SCENES)
def test_the_list_draws_what_is_reached(name: str) -> None:
    """All poses that are reached, but for one in twenty, are drawn by some construction of a short list."""
    drawing = drawing_of(name)
    poses, found = reachable_poses(drawing), constructions(drawing)
    assert poses is not None
    assert found[0] is drawing
    held = np.array([poses_drawn_right(one, poses) for one in found])
    assert held.any(axis=0).mean() >= 0.95
    for k in range(1, len(found)):
        assert (held[k] & ~np.delete(held, k, axis=0).any(axis=0)).any()  # none is there in vain


@pytest.mark.parametrize("name", SCENES)
def test_one_construction_holds_everywhere(name: str) -> None:
    """One construction serves in every pose, where the marks of some compounds are as the rule has them."""
    drawing = drawing_of(name)
    poses, (one, wrong) = reachable_poses(drawing), best_construction(drawing)
    assert poses is not None
    told, held = failing_compounds(one, poses)
    assert held.all()
    assert told.keys() == wrong.keys()
    assert len(wrong) < len(one.compounds)


def test_a_form_that_holds_is_alone() -> None:
    """Where the pose's own forms are good all around, there is no other construction and nothing is put right."""
    drawing = drawing_of("slider-crank")
    assert constructions(drawing) == [drawing]
    assert best_construction(drawing) == (drawing, {})
