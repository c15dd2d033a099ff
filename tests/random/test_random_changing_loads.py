"""Loads that change over the cycle, on any linkage: each pose has its own, and forces are the solver's with them."""

from __future__ import annotations

import re
from fractions import Fraction
from importlib.resources import files
from random import Random
from typing import Any

import numpy as np
import pytest
from loads import loaded_scenes

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.check.forces import force_truth
from graphplan.check.trusted import report
from graphplan.cycle.turn import Turn, follow
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import Force, Scene
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.scene import parse
from graphplan.methods.construct import construct
from graphplan.solver import poses

LINKAGES = range(6)
SPAN, POSES, GIVEN = (-4.0, 6.0), 6, 2  # degrees, or lengths; positions, and which of them is the given pose
LOAD = re.compile(r'\[\[(forces|moments)\]\]\non = "(.+)"\n(?:at = "(.+)"\n)?value = .*')


def changed(scene: Scene, random: Random) -> Scene:
    """The scene with a table in the place of each load, or a spring from its point to another link."""
    slides = [slide.name for slide in scene.slides]
    places = [*{place: point for point, place in scene.points.items()}.values()]

    def table(found: re.Match[str]) -> str:
        over = random.choice(["travel", "speed", *slides, *(f"speed of {slide}" for slide in slides)])
        one, two, three, four = (random.randint(-90, 90) for _ in range(4))
        end = 100_000  # far beyond any place
        rows = f"[[{-end}, {one}], [0, {two}], [0, {three}], [{end}, {four}], [{-end}, {one}]]"
        if over not in slides:
            rows = f"[[{-end}, {one}], [0, {two}], [0, {three}], [{end}, {four}]]"
        said = "powers = [2, 0.5, 0.01]" if over.startswith("speed") and random.random() < 0.5 else f"values = {rows}"
        kind, on, at = found.groups()
        anchors = [(point, link) for link, points in scene.links.items() for point in points
                   if link != on and at and scene.points[point] != scene.points[at]]
        if anchors and random.random() < 0.3:
            point, link = random.choice(anchors)
            return (f'[[springs]]\nends = ["{at}", "{point}"]\non = ["{on}", "{link}"]\n'
                    f"stiffness = {random.choice((0.5, 2))}\nfree = {random.choice((0, 3))}")
        ends = f'"{" ".join(random.sample(places, 2))}"' if len(places) > 1 else "[1, 0]"
        way = random.choice(("[3, -4]", "30", ends))
        point = f'at = "{at}"\ndirection = {way}\n' if at else ""
        return f'[[{kind}]]\non = "{on}"\n{point}over = "{over}"\n{said}'

    return parse(LOAD.sub(table, scene.text), scene.name)


def apart(scene: Scene, turn: Turn) -> float:
    """The largest difference of a force or moment from the solver's beside the largest of its kind in the pose."""
    there = [k for k in range(POSES) if k not in turn.faults]
    points, guides, loads = ({name: z[there] for name, z in own.items()}
                             for own in (turn.points, turn.guides, turn.loads))
    drawn = construct(scene).evaluate(points, guides, loads=loads)
    ours, kept = drawn.results, [k for k in range(len(there)) if k not in drawn.faults]
    posed = poses.scene_in_poses(scene, points, guides, loads)
    right = force_truth(posed, ours, poses.reactions(posed, poses.solve(posed, len(there)), len(there)))
    worst = 0.0
    for kind, named in ours.items():
        if kind in right:
            gaps = [np.abs(z - complex_of(right[kind][name])) for name, z in named.items()]
            sizes = np.max(np.abs([*named.values()]), axis=0)
            worst = max(worst, float(np.max((np.max(gaps, axis=0) / (sizes + 1))[kept], initial=0)))
    return worst


def complex_of(true: Any) -> Any:
    """A vector of the solver as complex numbers, a number as it is."""
    return true[0] + 1j * true[1] if isinstance(true, tuple) else true


def test_each_pose_has_its_loads() -> None:
    """Reactions and balances agree with the solver in every pose; in the given pose the loads are the scene's own."""
    tried = 0
    for seed in LINKAGES:
        scene = next(loaded_scenes(seed, orders=1), None)
        if scene is None or not scene.drives[0].rate or not LOAD.search(scene.text):
            continue
        scene = changed(scene, Random(seed))
        turn = follow(scene, POSES, SPAN)
        if GIVEN in turn.faults:
            continue
        try:
            gap = apart(scene, turn)
        except GraphplanError as error:
            assert error.status == 3 or "coincide" in str(error), (seed, str(error))
            continue
        assert gap < 1e-9, seed
        for name, load in changing_loads(scene.loads).items():
            value = complex(*map(float, load.value)) if isinstance(load, Force) else float(load.value)
            assert turn.loads[name][GIVEN] == pytest.approx(value, rel=1e-9, abs=1e-9), (seed, name)
        tried += 1
    assert tried > LINKAGES.stop / 4


def test_the_printed_driving_moments() -> None:
    """Ozols 1974, example 13-6: 200 |sin phi| + 450 sin 2 phi N m at 15 rad/s, against the slider on either stroke."""
    found = cycle(gp.load("ozols-13-6"), 12)
    phi = found.turn.travel + np.pi / 3
    assert found.results["balance moment"]["1"] == pytest.approx(
        200 * np.abs(np.sin(phi)) + 450 * np.sin(2 * phi), rel=1e-12, abs=1e-10)
    printed = {0: 0.0, 30: 489.7, 60: 562.9, 90: 200.0, 120: -216.5, 150: -289.7, 180: 0.0}
    told = {round(np.degrees(p)) % 360: moment for p, moment in zip(phi, found.results["balance moment"]["1"],
                                                                    strict=True)}
    for degrees, moment in printed.items():
        assert told[degrees] == pytest.approx(moment, abs=0.05)


def test_a_pose_further_on_has_its_own_load() -> None:
    """The scene at another travel reads its tables there, and its balance is that of the cycle."""
    for travel, force, moment in [(30, 1000, 200.0), (210, -1000, 200.0), (Fraction(-30), 1000, 489.7114317)]:
        scene = gp.at(gp.load("ozols-13-6"), travel)
        assert scene.loads is not None
        assert scene.loads.forces[0].value == pytest.approx((force, 0)), travel
        assert report(scene).results["balance moment"]["1"] == pytest.approx(moment), travel


def test_a_table_that_ends_before_the_cycle() -> None:
    """Where a table does not reach as far as the cycle its end holds, or the load is zero beyond it."""
    text = gp.load("ozols-13-6").text
    part = re.sub(r"over .*\nvalues .*", 'over = "travel"\nvalues = [[0, 1000], [90, 500]]', text)
    covered = np.arange(12) <= 3
    for text, beyond in [(part, 500), (part.replace("[90, 500]]", '[90, 500]]\nbeyond = "zero"'), 0)]:
        found = cycle(parse(text, "part"), 12)
        assert not found.wrong
        assert found.turn.loads["P_3"][~covered] == pytest.approx(beyond)
    found = cycle(parse(part, "part"), 4, (0.0, 90.0))
    assert not found.wrong
    assert found.turn.loads["P_3"] == pytest.approx(np.linspace(1000, 500, 4))


def test_a_load_that_vanishes_leaves_the_balance_told() -> None:
    """Where no force has a line its arm cannot be drawn: the balancing moment is zero, and that is no fault."""
    text = (files("graphplan") / "scenes" / "ozols-13-6.toml").read_text(encoding="utf-8")
    text = text.replace("-1000]", "0]").replace("mass   = 100", "mass   = 0")
    found = cycle(parse(text, "vanishing"), 12)
    moments = np.abs(found.results["balance moment"]["1"])
    assert not found.faults
    assert np.max(moments) > 100
    assert np.count_nonzero(moments < 1e-9) >= 6
