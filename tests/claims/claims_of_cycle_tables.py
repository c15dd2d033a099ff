"""Claims about the table that `cycle` prints: each pose has its numbers or its reason, and these are derivatives."""

from __future__ import annotations

import csv
import io
from functools import cache
from typing import Any

import numpy as np
from claim import claim
from face import Got, ran

import graphplan as gp

POSES, NEAR = 12, 0.01  # how many poses, and how many degrees to either side


def turns(scene: gp.Scene) -> bool:
    """Whether a drive turns, of an even speed."""
    return bool(scene.drives) and not scene.motions and not any(drive.slides for drive in scene.drives) and (
        scene.drives[0].rate != 0 and not any(drive.change for drive in scene.drives) and len(scene.drives) == 1)


@cache
def table(name: str, *options: str) -> tuple[str, list[dict[str, str]]]:
    """What `cycle` says, and its rows."""
    done = ran("cycle", name, *options)
    assert done.status == 0, done.err
    return done.err, [*csv.DictReader(io.StringIO(done.out))]


@claim(having=turns)
def each_pose_has_its_numbers_or_its_reason(got: Got) -> None:
    """A pose that cannot be reached, or is singular, has a reason; any other has all that is asked for."""
    said, rows = table(got.name, "--positions", str(POSES))
    assert [row["pose"] for row in rows] == [str(place) for place in range(POSES)]
    assert "disagree" not in said
    for row in rows:
        values = {key: text for key, text in row.items() if key not in ("pose", "travel [deg]", "fault")}
        assert all(values.values()) == (not row["fault"]), row


@claim(having=turns)
def the_first_pose_is_that_of_the_scene(got: Got) -> None:
    """Its velocities are those that `solve` prints."""
    _, rows = table(got.name, "--positions", str(POSES))
    for name, point in got.solved["points"].items():
        if point.get("velocity") and not rows[0]["fault"]:
            found = [float(text) for key, text in rows[0].items() if key.startswith((f"{name}.vx [", f"{name}.vy ["))]
            assert np.allclose(found, point["velocity"], rtol=1e-9, atol=1e-9 * float(got.scene.extent))


@claim(having=lambda scene: turns(scene) and not scene.contacts)  # there a name is where they touch, pose by pose
def velocities_are_derivatives_of_places(got: Got) -> None:
    """And accelerations those of velocities, by differences to either side of the pose of the scene."""
    _, rows = table(got.name, "--positions", "3", "--from", f"{-NEAR}", "--to", f"{NEAR}")
    if any(row["fault"] for row in rows):
        return
    unit = got.solved["units"]["length"]
    seconds = 2 * np.radians(NEAR) / abs(float(got.scene.drives[0].rate))
    size: dict[str, float] = {}
    pairs: list[tuple[str, str, Any, Any]] = []
    for below, above, ends in ((unit, f"{unit}/s", ("", "v")), (f"{unit}/s", f"{unit}/s^2", ("v", "a"))):
        for name in got.solved["points"]:
            for axis in "xy":
                one, two = (f"{name}.{end}{axis} [{of}]" for end, of in zip(ends, (below, above), strict=True))
                if one in rows[0] and two in rows[0]:
                    first, middle, last = (float(rows[place][of]) for place, of in enumerate((one, two, one)))
                    pairs.append((name, above, (last - first) / seconds, middle))
                    size[above] = max(size.get(above, 0.0), abs(middle))
    for name, above, slope, value in pairs:
        assert abs(slope - value) <= 1e-4 * size[above], (name, above)
