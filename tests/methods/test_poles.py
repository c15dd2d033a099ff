"""Instant centres: every pole of a linkage by construction, beside the rates of the solver."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from random import Random

import pytest

import graphplan as gp
from graphplan.check.json_results import data
from graphplan.check.report import Report
from graphplan.check.trusted import report
from graphplan.mechanism.model import FRAME, Find, Scene
from graphplan.mechanism.scene import parse
from graphplan.methods.kinds import POLE, POLE_HEADING

FOUR_BAR = """
points = { O = [0, 0], C = [100, 0], A = [20, 30], B = [90, 60] }
links = { 1 = "O A", 2 = "A B", 3 = "B C", frame = "O C" }
drive = [{ link = "1", omega = 2 }]
find = { poles = %s }
"""


def with_all_poles(scene: Scene) -> Scene:
    """The scene, asked for the poles of all pairs of links, and for nothing else."""
    links = (*scene.moving, FRAME)
    return replace(scene, find=Find((), (), poles=tuple(map(" ".join, combinations(links, 2)))), loads=None)


def poles(found: Report) -> dict[str, tuple[str, Fraction, Fraction]]:
    """Every pole, at infinity or not, by its two links."""
    return {name: (kind, *value) for kind in (POLE, POLE_HEADING)
            for name, value in found.results.get(kind, {}).items()}


def test_poles_of_a_four_bar_lie_where_its_sides_meet() -> None:
    """The pole of the coupler is where crank and rocker meet, that of crank and rocker where coupler and frame do."""
    found = data(report(parse(FOUR_BAR % '["2 frame", "3 1"]', "four-bar"), exact=True))
    assert found["poles"] == {"2 frame": {"at": ["80", "120"]}, "3 1": {"at": ["-50", "0"]}}
    assert found["check"] == {"poles": 0}


@pytest.mark.parametrize("name", ["slider-crank", "slotted-link", "shaper", "five-bar", "open-chain", "triad",
                                  "double-butterfly", "rosenauer-basic", "alt-ten-link"])
def test_all_poles_are_those_of_the_solver(name: str) -> None:
    """Every pole of every pair of links is exactly where the solver's rates have it, however the scene is ordered."""
    scene = with_all_poles(gp.load(name))
    found = report(scene, exact=True)
    assert found.agrees
    assert len(poles(found)) == len(scene.links) * (len(scene.links) - 1) // 2 or FRAME not in scene.links
    chance = Random(1974)
    links, pairs = [*scene.links.items()], [*scene.written]
    chance.shuffle(links)
    chance.shuffle(pairs)
    assert poles(report(replace(scene, links=dict(links), written=tuple(pairs)), exact=True)) == poles(found)


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "stephenson", "triad"])
def test_velocities_are_drawn_by_poles(name: str) -> None:
    """Asked for poles, ends of velocities lie on the lines to the poles of their links; accelerations do not."""
    scene = gp.load(name)
    found = report(scene, exact=True, method="poles")
    assert found.drawing.method["velocity"][-1].startswith("poles of link")
    assert not any(way.startswith("poles") for way in found.drawing.method["acceleration"])
    assert found.results == report(scene, exact=True).results
