"""A piston's two joints are told by their places in the mechanism, in any unit."""

from __future__ import annotations

import pytest

from graphplan.importing.pmks import Joint, _twin


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_a_near_joint_is_no_twin_in_any_unit(scale: float) -> None:
    """The revolute joint in the place of the sliding one is its twin; a link away there is none."""
    def joint(key: str, at: complex, kind: str) -> Joint:
        return Joint(key, key, scale * at, kind, ["2"])

    slide, twin, near, crank = joint("C", 3, "P"), joint("D", 3, "R"), joint("B", 2.9, "R"), joint("A", 0, "R")
    assert _twin(slide, [crank, near, slide, twin]) is twin
    assert _twin(slide, [crank, near, slide]) is None
