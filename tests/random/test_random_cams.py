"""Random cams lift their followers as the law says: their outlines are followed by a contact search of its own.

More than the quick tier tries: `TESTS=thorough python -m pytest tests/random/test_random_cams.py`.
"""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
from cams import lifted, outline, task_text

from graphplan.cams.base import pair_with_base
from graphplan.cams.profile import Cam, make_cam
from graphplan.cams.task import parse
from graphplan.errors import GraphplanError, SceneError

SEEDS, TOGETHER = 100, 50
ANGLES = 12  # of each cam
FINE = 1e-6  # of the base circle: how far the outline may be off its arcs
CLOSE = 1e-4  # of it, or radians: a lift is off by more than the outline where the follower leans


def off_law(cam: Cam, seed: int) -> float:
    """The largest difference of the lift that a search finds from the law, beside the base circle; of an arm in rad."""
    spots, random = outline(cam.arcs(FINE * cam.pair.base)), Random(seed)
    angles = np.array([random.uniform(0, 360) for _ in range(ANGLES)])
    apart = [abs(lifted(cam, spots, angle) - lift)
             for angle, lift in zip(angles.tolist(), cam.law.value_at(angles).tolist(), strict=True)]
    return max(apart) / (1 if cam.task.follower.oscillates else cam.pair.base)


@pytest.mark.parametrize("first", range(0, SEEDS, TOGETHER))
def test_cams_follow_their_laws(first: int) -> None:
    """Each cam that is made lifts its follower by the law; what is refused is undercut, hollow or too steep."""
    cams = 0
    for seed in range(first, first + TOGETHER):
        try:
            cam = make_cam(parse(task_text(seed), f"cam {seed}"))
        except GraphplanError as refused:
            assert "crosses itself" not in str(refused), seed
            continue
        assert off_law(cam, seed) <= CLOSE, seed
        cams += 1
    assert cams > TOGETHER / 2


def test_a_face_that_leans_too_far_is_refused() -> None:
    """A flat face on an arm beyond the pressure angle that is allowed is refused in words."""
    with pytest.raises(SceneError, match="a smaller stroke"):
        make_cam(parse(task_text(719), "cam 719"))


def test_a_cam_that_crosses_itself_does_not_follow_its_law() -> None:
    """An arm that swings past the line of centres draws a loop: it is refused, and the search misses the law there."""
    stages = (90, "sine", "stroke = 200"), (90, "sine", "stroke = -200"), (180, "dwell", "")
    law = "".join(f'[[law]]\nangle = {angle}\nmotion = "{motion}"\n{stroke}\n' for angle, motion, stroke in stages)
    task = parse(f'{law}[follower]\nmoves = "oscillating"\ncontact = "point"\narm = 60\ncentre_distance = 100\n'
                 "[cam]\nrpm = 60\nbase = 60\n", "cam")
    with pytest.raises(SceneError, match="crosses itself"):
        make_cam(task)
    assert off_law(Cam(task, pair_with_base(task)), 1) > 100 * CLOSE
