"""Rates of links over the cycle, and centrodes: poles that roll on each other, in branches that no line joins."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from packaged_scenes import those

import graphplan as gp
from graphplan.commands import main
from graphplan.cycle.motion_curves import centrode_branches, centrodes, traced_motion
from graphplan.cycle.turn import RangeOfMotion, whole_motion
from graphplan.errors import Refused
from graphplan.mechanism.model import FRAME, Scene

STEP = 2.0**-16
DRIVEN = those(lambda scene: scene.drives and not scene.motions)
TRAMMEL = """
[points]
A = [30, 0]
A0 = [30, 0]
B = [0, 40]
B0 = [0, 40]
O = [0, 0]
[links]
1 = "A"
2 = "A B"
3 = "B"
frame = "O A0 B0"
[[slides]]
link = "1"
along = "frame"
at = "A"
direction = [1, 0]
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [0, 1]
[[drive]]
link = "2"
omega = 1
"""


def inner(motion: RangeOfMotion, n: int = 90) -> Any:
    """Travels within what is followed, off its ends."""
    return np.linspace(*motion.path.travel[[0, -1]], n + 2)[1:-1]


@pytest.mark.parametrize("name", DRIVEN)
def test_rates_are_those_of_the_poses(name: str) -> None:
    """How links move is how they lie a little later and a little earlier, off the limits."""
    motion = whole_motion(gp.load(name))
    travel, reach = inner(motion), motion.linkage.reach
    rates, before, after = (motion.links_at(travel + step) for step in (0.0, -STEP, STEP))
    for link, moved in rates.items():
        velocity = (after[link].base - before[link].base) / (2 * STEP)
        spin = np.angle(after[link].turn / before[link].turn) / (2 * STEP)
        far = np.maximum(np.abs(velocity) / reach, np.abs(spin))
        apart = np.maximum(np.abs(velocity - moved.velocity) / reach, np.abs(spin - moved.spin))
        assert (apart <= 1e-6 * (1 + far) ** 3).all()  # the third derivative grows towards limits


def test_centrodes_roll_on_each_other() -> None:
    """In every pose both lie in the pole, and go on from there alike: they touch, and do not slip."""
    motion = whole_motion(gp.load("four-bar"))
    travel = inner(motion, 360)
    links = motion.links_at(travel)
    for link, on in (("2", FRAME), ("3", "1"), ("1", "3")):
        found, before, after = (centrodes(motion.links_at(travel + step), link, on) for step in (0.0, -STEP, STEP))
        one, other = links[link], links[on]
        pole = one.base + (found.moving - one.origin) * one.turn
        near = np.abs(pole) < 1e3
        assert near.sum() > 180
        assert np.abs(other.base + (found.fixed - other.origin) * other.turn - pole)[near].max() < 1e-9
        assert np.abs(one.velocity_at(pole) - other.velocity_at(pole))[near].max() < 1e-9
        fixed, moving = ((b - a) / (2 * STEP) for a, b in zip(before, after, strict=True))
        gap = np.abs(fixed * other.turn - moving * one.turn)[near]
        assert (gap <= 1e-5 * (1 + np.abs(fixed)[near])).all()


def test_a_bar_on_two_guides_has_cardan_circles() -> None:
    """A bar whose ends slide on two guides square to each other rolls with a circle over it in one of twice the size.
    """
    motion = RangeOfMotion(gp.parse(TRAMMEL, "trammel"), -0.9, 0.6, closed=False)
    found = centrodes(motion.links_at(np.linspace(-0.9, 0.6, 31)), "2", FRAME)
    assert np.abs(np.abs(found.fixed) - 50).max() < 1e-12 * 50
    assert np.abs(np.abs(found.moving - (15 + 20j)) - 25).max() < 1e-12 * 50


def test_branches_are_not_joined_through_infinity() -> None:
    """A coupler that twice turns as the frame does has centrodes of two branches, whose spots are as near as chords."""
    motion = whole_motion(gp.load("four-bar"))
    travel = np.linspace(0, 2 * math.pi, 721)
    fixed, moving = centrode_branches(motion, "2", FRAME, travel, 0j, 1000.0) or ([], [])
    assert (len(fixed), len(moving)) == (3, 3)  # one of them is cut where the travel begins
    for part in (*fixed, *moving):
        assert np.abs(np.diff(part)).max() <= 1000 / 256
        assert np.abs(part).max() <= 1000


def shown(name: str, *links: str) -> Scene:
    """A packaged scene whose sheet asks for these centrodes."""
    scene = gp.load(name)
    return replace(scene, sheet=replace(scene.sheet, centrodes=links))


def test_links_that_turn_alike_have_no_centrodes() -> None:
    """A block on the frame has its pole at infinity in every pose: that is said, and nothing drawn."""
    with pytest.raises(Refused, match="links 3 and frame turn alike: their pole stays at infinity"):
        traced_motion(shown("slider-crank", "3 frame"))


def test_a_pin_is_a_centrode_of_one_spot() -> None:
    """The pole of two links with a joint stays in it, on either."""
    found = traced_motion(shown("four-bar", "3 2"))
    assert found
    for one in found.centrodes:
        ((spot,),) = one.branches
        assert math.dist(spot, (135, 225)) < 1e-9


def test_a_sheet_asks_for_links_that_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    """In a scene and on the command line, centrodes are of two links of the scene."""
    text = gp.load("four-bar").text.replace("[sheet]", '[sheet]\ncentrodes = ["2 frame", "4 frame"]')
    with pytest.raises(gp.SceneError, match=r"sheet\.centrodes.*there is no pair of links 4 frame"):
        gp.parse(text, "f.toml")
    assert main(["cycle", "four-bar", "--positions", "4", "--centrodes", "2 4"]) == 2
    assert "--centrodes 2 4: there are no two links 2 4" in capsys.readouterr().err


def test_the_table_has_paths_and_centrodes(capsys: pytest.CaptureFixture[str]) -> None:
    """`cycle` prints where asked points are and both centrodes, in JSON as in a table; a pole at infinity is null."""
    assert main(["cycle", "slider-crank", "--positions", "4", "--curves", "S", "--centrodes", "2 frame, 3 frame",
                 "-o", "-"]) == 0
    head = capsys.readouterr().out.splitlines()[0]
    assert "S.x [mm],S.y [mm],fixed centrode 2 frame.x [mm]" in head


def test_json_has_a_list_for_each_name(tmp_path: Any) -> None:
    """JSON has what the table has, a number or a vector for each pose, and null where there is none."""
    file = tmp_path / "found.json"
    assert main(["cycle", "slider-crank", "--positions", "4", "--centrodes", "2 frame,3 frame", "-o", str(file)]) == 0
    found = json.loads(file.read_text("utf-8"))
    assert found["travel"] == pytest.approx([0, 90, 180, 270])
    assert found["points"]["fixed centrode 3 frame"] == [None] * 4
    assert [len(place) for place in found["points"]["moving centrode 2 frame"]] == [2] * 4
    assert found["velocity"].keys() == {"A", "B", "S"}


def test_paths_are_drawn_with_the_mechanism_alone(tmp_path: Any) -> None:
    """`--paths` draws curves and centrodes on a sheet of their own, which needs no positions."""
    file = tmp_path / "curves.svg"
    assert main(["cycle", "four-bar", "--centrodes", "2 frame", "--paths", str(file)]) == 0
    drawn = file.read_text("utf-8")
    assert "fixed centrode of 2" in drawn
    assert "data-step" not in drawn
