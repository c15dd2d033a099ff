"""A roller in a corner of the profile, from inside: no cam that turns has one, as the velocity must drop elsewhere."""

from __future__ import annotations

from pathlib import Path

import pytest

import graphplan as gp
from graphplan.cams.base import pair_with_base
from graphplan.cams.profile import Cam, make_cam
from graphplan.cams.task import load

CORNER = Path(__file__).parents[1] / "cases" / "cams" / "corner.toml"


def test_a_roller_in_a_corner_leaves_its_arc() -> None:
    """Where the velocity jumps up the roller rests in a corner of its own radius; where it drops none can follow."""
    task = load(str(CORNER))
    hollow = [arc for arc in Cam(task, pair_with_base(task)).arcs(0.01) if arc.bulge * task.cam.sense > 0]
    assert len(hollow) == 1
    with pytest.raises(gp.SceneError, match="at 90 degrees the velocity drops at once"):
        make_cam(task)
