"""Whoever executes a protocol on paper finds every mark where it is told, and every spoken number true."""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

import pytest
from protocol_faults import faults
from protocols import printed, protocol, random_scenes
from reader import OPERATIONS, STANDING, Reader
from speech import false_sums, sums

import graphplan as gp
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import Scene

SCENES = sorted(path.stem for path in Path(gp.__file__).parent.glob("scenes/*.toml"))
SMALL = ("four-bar", "shaper", "geared-five-bar", "racks", "roller-cam", "open-chain", "ozols-13-7", "slider-crank")
WAYS: list[dict[str, Any]] = [{}, {"plan": "polar"}, {"plan": "orthogonal"}, {"plan": "triangles"}, {"strict": True},
                              {"method": "trial"}, {"method": "auxiliary"}, {"method": "poles"}]
LOADED: list[dict[str, Any]] = [{"plan": "lever"}, {"plan": "polygons"}, {"plan": "polar,lever"},
                                {"inertia": "shifted"}, {"inertia": "points"}, {"inertia": "percussion"},
                                {"inertia": "static"}]
OPTIONS = [("--plan", "polar"), ("--plan", "orthogonal"), ("--plan", "triangles"), ("--plan", "lever"),
           ("--plan", "polygons"), ("--plan", "polar,lever"), ("--inertia", "shifted"), ("--inertia", "points"),
           ("--method", "trial"), ("--method", "auxiliary"), ("--method", "poles"), ("--strict",), ("--at", "20"),
           ("--at", "outer"), ("--paper", "A2")]  # fmt: skip
# beside the first 60 those in which forces or motions vanish but for rounding, or marks coincide
SEEDS = *range(60), 63, 71, 213, 270, 321
CROSSING = "lies on the"  # what is said of a step that reads a mark of another plan


def ways(scene: Scene) -> list[dict[str, Any]]:
    """The ways in which a scene can be asked to be drawn."""
    return WAYS + (LOADED if scene.loads is not None else [])


def judge(told: dict[str, Any] | None, context: object) -> None:
    """Nothing is wrong in a protocol."""
    assert told is None or faults(told) == [], context


def drawn(scene: Scene, **how: Any) -> dict[str, Any] | None:
    """The protocol of a scene; nothing where it is refused."""
    try:
        return protocol(scene, **how)
    except GraphplanError:
        return None


@pytest.mark.parametrize(("name", "way"), [(name, way) for k, name in enumerate(SCENES) for way in (k, k + 4)])
def test_protocols_of_packaged_scenes_can_be_executed(name: str, way: int) -> None:
    """Marks, lengths, factors, sums and readings of each packaged scene, each in two of its ways."""
    scene = gp.load(name)
    how = ways(scene)[way % len(ways(scene))]
    told = drawn(scene, **how)
    if told is None:
        pytest.skip("refused")
    judge(told, how)


@pytest.mark.parametrize(("name", "options"), [(name, options) for k, name in enumerate(SMALL) for options in (
    (), OPTIONS[2 * k % len(OPTIONS)], OPTIONS[(2 * k + 1) % len(OPTIONS)])])
def test_what_the_command_prints_can_be_executed(name: str, options: tuple[str, ...]) -> None:
    """So it is of the list that is printed, at the scales of the sheet that is drawn."""
    judge(printed(name, *options), options)


@pytest.mark.parametrize("seed", SEEDS)
def test_protocols_of_random_scenes_can_be_executed(seed: int) -> None:
    """So it is of random mechanisms of every kind of pair, loaded or not, drawn in any way."""
    random = Random(seed)
    for scene in random_scenes(seed):
        judge(drawn(scene, **random.choice(ways(scene))), scene.text)


def test_points_that_coincide_give_no_line() -> None:
    """With compasses and straightedge no line is drawn through two points that are apart by rounding alone."""
    scene = next(random_scenes(205))
    judge(protocol(scene, strict=True), scene.text)


# ---- the reader itself -----------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def told() -> dict[str, Any]:
    """The protocol of a four-bar."""
    return protocol(gp.load("four-bar"))


def test_a_mark_elsewhere_is_found(told: dict[str, Any]) -> None:
    """Every mark that is drawn, moved by a tenth of a millimetre, is found by the reader."""
    steps = told["steps"]
    for place, step in enumerate(steps):
        if step["operation"] not in STANDING:
            moved = {**step, "paper": [*step["paper"][:-1], step["paper"][-1] + 0.1]}
            assert Reader.of([*steps[:place], moved, *steps[place + 1 :]]).faults, step["sentence"]


def test_a_wrong_factor_is_found(told: dict[str, Any]) -> None:
    """A vector that is carried over at another factor than is told lies elsewhere."""
    carried = [place for place, step in enumerate(told["steps"]) if step["factor"]]
    assert carried
    for place in carried:
        steps = [*told["steps"]]
        steps[place] = {**steps[place], "factor": 1.1 * steps[place]["factor"]}
        assert Reader.of(steps).faults


def test_a_mark_of_another_plan_is_found(told: dict[str, Any]) -> None:
    """A line through points of two plans cannot be drawn."""
    steps = [*told["steps"]]
    place = next(k for k, step in enumerate(steps) if step["operation"] == "line")
    steps[place] = {**steps[place], "plan": "N-plan"}
    assert any(CROSSING in fault for fault in Reader.of(steps).faults)


def test_a_sum_that_does_not_hold_is_found() -> None:
    """Sums are read with units and powers, and held to the last printed digit."""
    right = ("28.0 mm · 2 = 56.0 mm.", "v²/AB = (21.0 · 2)² : 40.7 = 43.3 mm", "12 N : 2 = 6.0 mm",
             "x: (1 − 66.20/43.66) · 10 = −5.163 rad/s; computed −5", "1.2·10⁻³ m/s : 4·10⁻⁵ = 30.0 mm",
             "forces times arms (2.0 · 3.0 −1.0 · 4.0) mm² · 0.5 = 1 N·m", "AB = 40.7 mm, 12 N : 2 = 6.0 mm")
    wrong = ("28.0 mm · 2 = 55.9 mm.", "168.7 mm · 140.0 : 140.0 = 6.7 mm", "12 N : 2 = 6.1 mm")
    assert [text for text in right if len([*sums(text)]) != 1 or [*false_sums(text)]] == []
    assert [text for text in wrong if not [*false_sums(text)]] == []


def test_the_reader_shares_no_geometry() -> None:
    """It imports nothing of graphplan, so that it cannot repeat its faults."""
    for name in ("reader", "speech", "protocol_faults"):
        assert "graphplan" not in [line.split()[1].split(".")[0] for line in Path(__file__).with_name(
            f"{name}.py").read_text("utf-8").splitlines() if line.startswith(("import ", "from "))]
    assert len(OPERATIONS) > 25
