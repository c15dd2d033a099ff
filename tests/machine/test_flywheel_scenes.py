"""Flywheels of scenes: a printed machine, random loaded linkages, what is refused, and the command."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from fractions import Fraction

import jsonschema
import numpy as np
import pytest
from linkages_with_masses import centres, scene

from graphplan.check.motion import check_flywheel
from graphplan.commands import main
from graphplan.commands.schema import result_schema
from graphplan.errors import Disagreement, Refused
from graphplan.kernel.claims import broken_claims
from graphplan.machine.flywheel.energy_constructions import AREAS, GUTJAHR, draw_by
from graphplan.machine.flywheel.result import FlywheelResult, flywheel
from graphplan.mechanism.model import Flywheel, Moment, Scene
from graphplan.mechanism.scene import load, parse, source_text

YOKE, DRIVE = "ozols-13-6", '[[drive]]\nlink = "1"\nomega = 6\n'


def four_bar(rng: np.random.Generator) -> Scene:
    """A crank-rocker with random masses, a resisting moment over its turn, and a weight."""
    crank, coupler, rocker, ground = 0.1, *rng.uniform((0.35, 0.3, 0.35), (0.45, 0.4, 0.42))
    A, D = crank * complex(math.cos(0.3), math.sin(0.3)), complex(ground)
    far = abs(D - A)
    along = (coupler**2 - rocker**2 + far**2) / (2 * far)
    B = A + (D - A) / far * complex(along, math.sqrt(coupler**2 - along**2))
    masses = [(float(rng.uniform(1, 5)), float(rng.uniform(0, 0.1)), float(rng.uniform(-0.03, 0.03)))
              for _ in range(3)]
    places = {"O": 0j, "D": D, "A": A, "B": B} | centres([(0j, A), (A, B), (B, D)], masses)
    inner = np.column_stack([np.sort(rng.uniform(20, 340, 4)), rng.uniform(-90, 20, 4)]).tolist()
    resisting = f'[[moments]]\non = "3"\nover = "travel"\nvalues = {[[0, 0.0], *inner, [360, 0.0]]}\n'
    links = {"1": "O A S1", "2": "A B S2", "3": "B D S3", "frame": "O D"}
    return scene(places, links, masses, resisting + "[flywheel]\nspeed = 6\nunevenness = 0.02\n", DRIVE)


def asked(name: str = YOKE, **wish: object) -> Scene:
    """A packaged scene that asks for another flywheel."""
    given = load(name)
    assert given.flywheel is not None
    return replace(given, flywheel=replace(given.flywheel, **wish))


def test_the_printed_yoke() -> None:
    """The flywheel of Ozols' scotch yoke through its scene, from a pose at 60 degrees, with all second opinions."""
    result = flywheel(load(YOKE))
    assert result.wheel.inertia == pytest.approx(49.379, abs=5e-4)
    assert result.cycle.closing == pytest.approx(400 / math.pi)
    assert math.degrees(result.wheel.upper.travel) % 180 == pytest.approx(6.503 + 120, abs=0.005)
    assert max(check_flywheel(result).values()) < 1e-13
    assert abs(result.drawn_result - result.wheel.inertia) < result.strip_error


# a ramp, a tangent over the cycle's end, peaks between plans, two peaks that are nearly as high
@pytest.mark.parametrize("seed", [2, 55, 81, 90, 133])
def test_random_linkages(seed: int) -> None:
    """The integrated motion has the unevenness asked for, and the drawn flywheel is as near as its error says."""
    result = flywheel(four_bar(np.random.default_rng(seed)))
    found = check_flywheel(result)
    assert max(found[what] for what in ("omega_max", "omega_min", "unevenness", "closing")) < 1e-9
    assert abs(result.drawn_result - result.wheel.inertia) < result.strip_error
    assert sum(map(result.cycle.work, result.cycle.loads)) == pytest.approx(
        -2 * math.pi * result.cycle.closing, rel=1e-9)


@pytest.mark.parametrize("seed", [None, 2, 55, 81, 90, 133])
def test_other_constructions_find_what_their_methods_do(seed: int | None) -> None:
    """Gutjahr's curves the flywheel itself, as near as their error says, the vectors of areas what these neglect."""
    result = flywheel(load(YOKE) if seed is None else four_bar(np.random.default_rng(seed)))
    methods = {method.name: method for method in result.methods}
    curves, vectors = draw_by(GUTJAHR, result), draw_by(AREAS, result)
    assert abs(curves.inertia - methods["gutjahr"].inertia) < curves.strip_error * curves.change(result.given)
    assert vectors.inertia == pytest.approx(methods["area vectors"].inertia, rel=1e-12)
    assert vectors.intercept == pytest.approx(methods["area vectors"].stored, rel=1e-12)
    for drawing in (curves, vectors):
        assert not list(broken_claims(drawing.values.drawing.program, drawing.values.numbers))


def test_loads_that_close_the_cycle() -> None:
    """Scaled loads are scaled in the second opinion, too, and a note tells by how much."""
    linkage = four_bar(np.random.default_rng(3))
    assert linkage.loads is not None
    driven = replace(linkage.loads, moments=(*linkage.loads.moments, Moment("1", Fraction(3))))
    result = flywheel(replace(linkage, loads=driven, flywheel=Flywheel(Fraction(6), Fraction(1, 50), closes="load")))
    assert result.cycle.closing == 0
    assert "multiplied" in " ".join(map(str, result.notes))
    assert check_flywheel(result)["closing"] < 1e-9


def test_a_wheel_that_is_given() -> None:
    """With a flywheel the unevenness is found, and drawn; with that which is found for it all is as asked."""
    wheel = flywheel(load(YOKE)).wheel.inertia
    result = flywheel(asked(unevenness=None, inertia=Fraction(wheel)))
    assert result.unevenness == pytest.approx(1 / 30, rel=1e-9)
    assert abs(result.drawn_result - result.unevenness) < result.strip_error
    check_flywheel(result)


def test_a_wrong_flywheel_is_a_disagreement() -> None:
    """A flywheel a little heavier than it should be does not run as evenly as it is said to."""
    result = flywheel(load(YOKE))
    wheel = replace(result.wheel, inertia=result.wheel.inertia * (1 + 1e-6))
    with pytest.raises(Disagreement):
        check_flywheel(FlywheelResult(result.reduction, result.cycle, wheel, result.unevenness, False, result.methods,
                                      24))


@pytest.mark.parametrize(("wish", "why"), [
    ({"unevenness": Fraction(1, 2)}, "needs no flywheel"),
    ({"speed": Fraction(1, 100), "unevenness": None, "inertia": Fraction(0)}, "makes no full turn"),
    ({"closes": "load"}, "do no work"),
])
def test_what_is_refused(wish: dict[str, object], why: str) -> None:
    """What cannot be is refused with the reason."""
    with pytest.raises(Refused, match=why):
        flywheel(asked(**wish))


def test_cycles_that_do_not_close() -> None:
    """A drive that cannot go round has no steady cycle."""
    with pytest.raises(Refused, match=r"does not close.*stops at a limit position"):
        flywheel(replace(load("triad-loaded"), flywheel=Flywheel(Fraction(1), Fraction(1, 30))))


def test_a_machine_without_inertia_in_a_pose() -> None:
    """Where the reduced inertia is nothing in a pose a flywheel is found, and no speeds without it."""
    result = flywheel(replace(load("jaanimets-10"), flywheel=Flywheel(Fraction(5), Fraction(1, 30))))
    check_flywheel(result)
    assert result.without_flywheel is None


def test_command(tmp_path, capsys) -> None:
    """The command prints the numbers that the contract names, and takes options before the scene's table."""
    assert main(["flywheel", YOKE, "-q", "--unevenness", "0.05"]) == 0
    found = json.loads(capsys.readouterr().out)
    jsonschema.validate(found, result_schema("flywheel"))
    assert [len(found[key]) for key in ("reduced_inertia", "reduced_moment", "energy")] == [25, 25, 25]
    assert found["reduced_inertia"][4] == [60.0, pytest.approx(13)]
    assert found["closing_moment"] == pytest.approx(400 / math.pi)
    wheel = found["flywheel"]
    assert wheel["unevenness"] == pytest.approx(0.05)
    assert wheel["inertia"] < 49
    assert abs(wheel["drawn"] - wheel["inertia"]) < wheel["drawn_error"]
    assert {"omega_max_at", "omega_min_at"} <= wheel.keys()
    assert [*found["methods"]] == ["wittenbauer", "gutjahr", "area vectors", "power"]
    table = tmp_path / "table.csv"
    assert main(["flywheel", YOKE, "-q", "--inertia", "20", "--positions", "12", "-o", str(table)]) == 0
    assert len(table.read_text().splitlines()) == 14


@pytest.mark.parametrize("options", [["--unevenness", "0.5"], ["--unevenness", "x"], ["--inertia", "1", "--unevenness",
                                     "0.1"], ["--positions", "6"], ["-o", "x.gif"], ["--speed", "-1"]])
def test_command_refuses(options: list[str]) -> None:
    """Bad options and a machine that needs no flywheel end with status 2."""
    assert main(["flywheel", YOKE, *options]) == 2


def test_a_scene_without_the_table() -> None:
    """Without a table the options say what is asked; a scene that says nothing is refused."""
    text = source_text(YOKE, YOKE).split("[flywheel]")[0]
    with pytest.raises(Refused, match="flywheel"):
        flywheel(parse(text, "yoke"))
