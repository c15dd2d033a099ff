"""Whoever executes a protocol on paper finds every mark where it is told, and every spoken number true."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import pytest
from face import Got, got, names, ran
from reader import OPERATIONS, STANDING, Reader
from speech import false_sums, faults, sums

import graphplan as gp

WAYS = ["", "--plan polar", "--plan orthogonal", "--plan triangles", "--strict", "--method trial", "--method auxiliary",
        "--method poles", "--at 20", "--at outer"]
LOADED = ["--plan lever", "--plan polygons", "--plan polar,lever", "--inertia shifted", "--inertia points",
          "--inertia percussion", "--inertia static"]
# beside the first 30 those in which forces or motions vanish but for rounding, or marks coincide, and those in which
# arcs, velocities or centres of oscillation would leave the paper
SEEDS = *range(30), 63, 71, 213, 270, 321
FAR = [(205, 0, "--strict"), (5014, 3, "--inertia shifted"), (5015, 2, ""), (5031, 0, "--method auxiliary"),
       (5032, 1, "--inertia points")]
CROSSING = "lies on the"  # what is said of a step that reads a mark of another plan
POLYGONS = {"rotor.toml": ("balance", 5), "governor.toml": ("balance", 25), "cam-roller.toml": ("cam", 50),
            "cam-flat.toml": ("cam", 50), "cam-rocker.toml": ("cam", 50)}


def ways(scene: gp.Scene) -> list[str]:
    """The ways in which a scene can be asked to be drawn."""
    return WAYS + (LOADED if scene.loads is not None else [])


def protocol(scene: gp.Scene, options: str = "") -> dict[str, Any] | None:
    """What `steps --json` prints of a scene; nothing where it refuses, or the pose is singular."""
    done = ran("steps", "-", "--json", "-q", *options.split(), given=scene.text)
    assert done.status in (0, 2, 3), done.err
    return dict(json.loads(done.out)) if done.status == 0 else None


def random_scenes(seed: int) -> Iterator[gp.Scene]:
    """The scenes of one seed: a linkage, one with gears and contacts, and both under load where it can be held."""
    from gearings import gearing
    from linkages import linkage, scenes
    from loads import loaded_scenes

    for made in (linkage, gearing):
        yield next(scenes(seed, 1, made))
        yield from loaded_scenes(seed, 1, made)


@pytest.mark.parametrize(("name", "way"), [(name, way) for k, name in enumerate(names()) for way in (k, k + 4)])
def test_protocols_of_packaged_scenes_can_be_executed(name: str, way: int) -> None:
    """Marks, lengths, factors, sums and readings of each packaged scene, each in two of its ways."""
    options = ways(gp.load(name))[way % len(ways(gp.load(name)))]
    done = ran("steps", name, "--json", "-q", *options.split())
    if done.status:
        pytest.skip("refused")
    assert faults(done.json) == [], options


@pytest.mark.costly
@pytest.mark.parametrize("seed", SEEDS)
def test_protocols_of_random_scenes_can_be_executed(seed: int) -> None:
    """So it is of random mechanisms of every kind of pair, loaded or not, drawn in any way."""
    random = Random(seed)
    for scene in random_scenes(seed):
        options = random.choice(ways(scene))
        told = protocol(scene, options)
        assert told is None or faults(told) == [], (options, scene.text)


@pytest.mark.parametrize(("seed", "place", "options"), FAR)
def test_no_length_is_longer_than_the_paper(seed: int, place: int, options: str) -> None:
    """Where arcs, velocities or centres would leave the paper, a smaller scale or another form is taken."""
    told = protocol([*random_scenes(seed)][place], options)
    assert told is not None
    assert faults(told) == []
    if options == "--inertia points":
        assert "K_4" not in {step["makes"] for step in told["steps"]}


def test_a_centre_of_oscillation_on_the_sheet_is_drawn() -> None:
    """Where the sheet holds it the link's inertia acts there; where none does it is a couple beside its force."""
    near = got("class-four-loaded").data("steps", "--json", "--inertia", "points")
    assert any(step["makes"].startswith("K_") for step in near["steps"])


# ---- diagrams of machines, cams and syntheses ------------------------------------------------------------------------


def executed(folder: Path, *arguments: str | Path) -> tuple[list[str], int]:
    """What is wrong with the steps that a command gives, and how many there are."""
    out = folder / "numbers.json"
    done = ran(*arguments, "--steps", "-q", "-o", out)
    assert done.status == 0, done.err
    told = json.loads(out.read_text("utf-8"))["protocol"]
    return faults({**told, "entries": [], "readings": []}, told["paper"]), len(told["steps"])


@pytest.mark.parametrize("arguments", [("flywheel", "ozols-13-6"), ("motion", "ozols-13-7"), ("balance", "ozols-16-1")])
def test_diagrams_of_machines_can_be_executed(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    """Every mark of a flywheel's, a motion's and a linkage's sheet lies where a reader draws it."""
    wrong, count = executed(tmp_path, *arguments)
    assert (wrong, count > 5) == ([], True)


@pytest.mark.parametrize("file", POLYGONS)
def test_polygons_and_inversions_can_be_executed(tmp_path: Path, file: str) -> None:
    """So does every mark of a rotor's polygons, of a governor's characteristic, and of a cam, whatever its follower."""
    command, least = POLYGONS[file]
    wrong, count = executed(tmp_path, command, Path(__file__).with_name(file))
    assert (wrong, count > least) == ([], True)


@pytest.mark.parametrize("name", names("tasks"))
def test_syntheses_can_be_executed(tmp_path: Path, name: str) -> None:
    """So does every mark of a packaged synthesis."""
    wrong, count = executed(tmp_path, "synthesize", name)
    assert (wrong, count > 2) == ([], True)


# ---- drawings in proportion ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("file", ["stephenson.toml", "class-iv.toml", "starting.toml"])
def test_vectors_are_in_proportion(file: str) -> None:
    """Of poses that nobody chose velocities are drawn no longer than the mechanism, accelerations are no dots, paper is
    of a usual size, and no result is lost but near a singular pose."""
    one = Got(Path(__file__).with_name(file))
    told = one.steps
    assert told["pencil"]["paper"][:2] in ("A4", "A3")
    lengths = [(vector.name.partition(" ")[0], vector.line.length) for vector in one.sheet.vectors]
    longest = {kind: max((length for of, length in lengths if of == kind), default=0.0)
               for kind in ("velocity", "acceleration")}
    size = float(one.scene.extent) / one.sheet.scale("mechanism", "s")
    assert longest["velocity"] <= size
    assert longest["acceleration"] == 0 or longest["acceleration"] >= 5
    assert told["pencil"]["near singular"] or told["pencil"]["worst result"]["relative"] < 0.5


@pytest.mark.costly
def test_random_mechanisms_have_usual_paper() -> None:
    """Up to eight links on A3, up to twelve on A2, but where a pose is nearly singular: in 85 of 100 scenes."""
    usual = {"A4": 7, "A3": 7, "A2": 12}
    held = [len(scene.moving) <= usual.get(told["pencil"]["paper"][:2], 0) for seed in range(12)
            for scene in random_scenes(seed) if not scene.loads and (told := protocol(scene))]
    assert sum(held) >= 0.85 * len(held)


def test_slow_velocities_are_drawn_longer() -> None:
    """A loader that moves slowly beside its drive has velocities of a fifth of the mechanism at least, half at most."""
    one = got("ozols-13-7")
    longest = max(abs(complex(*point["velocity"])) for point in one.solved["points"].values() if point["velocity"])
    assert 0.2 <= longest * one.steps["kappa"] / float(one.scene.extent) <= 0.5


# ---- the reader itself -----------------------------------------------------------------------------------------------


def test_a_mark_elsewhere_is_found() -> None:
    """Every mark that is drawn, moved by a tenth of a millimetre, is found by the reader."""
    steps = got("four-bar").steps["steps"]
    for place, step in enumerate(steps):
        if step["operation"] not in STANDING:
            moved = {**step, "paper": [*step["paper"][:-1], step["paper"][-1] + 0.1]}
            assert Reader.of([*steps[:place], moved, *steps[place + 1 :]]).faults, step["sentence"]


def test_a_wrong_factor_is_found() -> None:
    """A vector that is carried over at another factor than is told lies elsewhere."""
    told = got("four-bar").steps["steps"]
    carried = [place for place, step in enumerate(told) if step["factor"]]
    assert carried
    for place in carried:
        steps = [*told]
        steps[place] = {**steps[place], "factor": 1.1 * steps[place]["factor"]}
        assert Reader.of(steps).faults


def test_a_mark_of_another_plan_and_a_wrong_length_are_found() -> None:
    """A line through points of two plans cannot be drawn; a length that nothing measures is spoken wrong."""
    told = got("four-bar").steps
    steps = [*told["steps"]]
    place = next(k for k, step in enumerate(steps) if step["operation"] == "line")
    steps[place] = {**steps[place], "plan": "N-plan"}
    assert any(CROSSING in fault for fault in Reader.of(steps).faults)
    wrong = [{**step, "sentence": step["sentence"].replace(" mm.", " mm, 99.9 mm.")} for step in told["steps"]]
    assert len(faults({**told, "steps": wrong})) > 2


def test_a_sum_that_does_not_hold_is_found() -> None:
    """Sums are read with units and powers, and held to the last printed digit."""
    right = ("28.0 mm · 2 = 56.0 mm.", "v²/AB = (21.0 · 2)² : 40.7 = 43.3 mm", "12 N : 2 = 6.0 mm",
             "x: (1 − 66.20/43.66) · 10 = −5.163 rad/s; computed −5", "1.2·10⁻³ m/s : 4·10⁻⁵ = 30.0 mm",
             "forces times arms (2.0 · 3.0 −1.0 · 4.0) mm² · 0.5 = 1 N·m", "AB = 40.7 mm, 12 N : 2 = 6.0 mm")
    wrong = ("28.0 mm · 2 = 55.9 mm.", "168.7 mm · 140.0 : 140.0 = 6.7 mm", "12 N : 2 = 6.1 mm")
    assert [text for text in right if len([*sums(text)]) != 1 or [*false_sums(text)]] == []
    assert [text for text in wrong if not [*false_sums(text)]] == []
    assert len(OPERATIONS) > 25
