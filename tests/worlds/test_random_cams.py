"""Random cams lift their followers as the law says: their outlines are followed by a contact search of its own."""

from __future__ import annotations

import math
from pathlib import Path
from random import Random

import pytest
from cams import Follower, outline, task_text

import graphplan as gp

SEEDS, TOGETHER = 40, 20
ANGLES = 12  # of each cam
FINE = 1e-6  # of the base circle: how far the outline may be off its arcs
CLOSE = 1e-4  # of it, or radians: a lift is off by more than the outline where the follower leans


def off_law(text: str, path: Path, seed: int) -> float:
    """The largest difference of the lift that a search finds from the law, beside the base circle; of an arm in rad."""
    path.write_text(text)
    base = gp.cam(path).json()["cam"]["base_radius"]
    data = gp.cam(path, tolerance=FINE * base, positions=720).json()
    follower, spots = Follower(text, base), outline(data["outline"]["arcs"])
    unit = math.radians(1) if follower.swings else 1.0
    apart = [abs(follower.lifted(spots, row["angle"]) - row["lift"] * unit)
             for row in Random(seed).sample(data["positions"], ANGLES)]
    return max(apart) / (1 if follower.swings else base)


@pytest.mark.costly
@pytest.mark.parametrize("first", range(0, SEEDS, TOGETHER))
def test_cams_follow_their_laws(first: int, tmp_path: Path) -> None:
    """Each cam that is made lifts its follower by the law; what is refused is not so because it crosses itself."""
    cams = 0
    for seed in range(first, first + TOGETHER):
        try:
            assert off_law(task_text(seed), tmp_path / "cam.toml", seed) <= CLOSE, seed
        except gp.GraphplanError as refused:
            assert "crosses itself" not in str(refused), seed
            continue
        cams += 1
    assert cams > TOGETHER / 3


def test_a_face_that_leans_too_far_is_refused(tmp_path: Path) -> None:
    """A flat face on an arm beyond the pressure angle that is allowed is refused in words."""
    with pytest.raises(gp.SceneError, match="a smaller stroke"):
        off_law(task_text(719), tmp_path / "cam.toml", 719)
