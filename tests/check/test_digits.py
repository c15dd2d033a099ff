"""Nine digits of each printed number hold: wherever a scene lies, however large and fast, whatever is installed."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from claims_of_equations import is_exact, wrong
from face import ran
from sampling import CORE

import graphplan as gp

TESTS = Path(__file__).parents[1]
SCENES = TESTS / "solver" / "scenes"
RATIONAL = [name for name in CORE if is_exact(gp.load(name)) and not gp.load(name).redundant]
MILLION = Fraction(10**6)


# ---- copies ----------------------------------------------------------------------------------------------------------


def times(pair: Any, by: Fraction) -> Any:
    """A vector so many times as long."""
    return pair[0] * by, pair[1] * by


def larger(scene: gp.Scene, factor: Fraction) -> gp.Scene:
    """All lengths so many times as large."""
    drives = [one.driven_at(one.rate * factor, one.change * factor) if one.slides else one for one in scene.drives]
    return replace(scene.with_drives(drives), placements={},
                   points={name: times(at, factor) for name, at in scene.points.items()},
                   motions={name: replace(motion, velocity=times(motion.velocity, factor),
                                          acceleration=times(motion.acceleration, factor))
                            for name, motion in scene.motions.items()})


def faster(scene: gp.Scene, factor: Fraction) -> gp.Scene:
    """All rates so many times as fast."""
    drives = [one.driven_at(one.rate * factor, one.change * factor**2) for one in scene.drives]
    return replace(scene.with_drives(drives),
                   motions={name: replace(motion, velocity=times(motion.velocity, factor),
                                          acceleration=times(motion.acceleration, factor**2))
                            for name, motion in scene.motions.items()})


def elsewhere(scene: gp.Scene) -> gp.Scene:
    """The same far from the origin."""
    return replace(scene, points={name: (x + MILLION, y - MILLION) for name, (x, y) in scene.points.items()},
                   placements={})


COPIES: dict[str, Callable[[gp.Scene], gp.Scene]] = {
    "larger": lambda scene: larger(scene, MILLION), "smaller": lambda scene: larger(scene, 1 / MILLION),
    "faster": lambda scene: faster(scene, MILLION), "slower": lambda scene: faster(scene, 1 / MILLION),
    "elsewhere": elsewhere,
}


@pytest.mark.parametrize("how", COPIES)
@pytest.mark.parametrize("name", RATIONAL)
def test_a_verdict_hangs_on_no_unit_and_no_origin(name: str, how: str) -> None:
    """A millionfold larger, smaller, faster or slower, or far away, the construction agrees and nine digits hold."""
    scene = COPIES[how](gp.load(name))
    found = gp.solve(scene)
    assert wrong(scene, found, 1e-9) == []
    assert max(found.check.values()) <= 1e-12


def test_no_digit_is_lost_far_off() -> None:
    """Far from the origin the construction is the same, and so are its numbers around the cycle."""
    here = gp.load("four-bar")
    there = elsewhere(here)
    assert len(gp.construct(here).drawn) == len(gp.construct(there).drawn)
    home, away = (gp.construct(scene).evaluate(gp.follow(scene, 12)) for scene in (here, there))
    assert not home.faults
    assert not away.faults
    for kind in ("velocity", "acceleration"):
        for name, z in getattr(home, kind).items():
            assert abs(getattr(away, kind)[name] - z).max() <= 1e-11 * abs(z).max()


# ---- where rates all but cancel --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["turntables", "resting", "touching"])
def test_rounding_is_no_alarm_and_a_given_rate_is_kept(name: str) -> None:
    """At rest, touching and all but cancelling: the construction agrees, and every number is right to nine digits, a
    given alpha among them, and to twelve where they are asked for."""
    scene = gp.load(str(SCENES / f"{name}.toml"))
    found = gp.solve(scene)
    assert wrong(scene, found, 1e-9) == []
    assert wrong(scene, gp.solve(scene, digits=12), 5e-12, alone=True) == []
    for drive in scene.drives:
        if not drive.slides and drive.link in found.alpha:
            assert found.alpha[drive.link] == pytest.approx(float(drive.change), rel=1e-9)


def test_slidings_far_from_their_pairs_are_printed_in_better_arithmetic(tmp_path: Path) -> None:
    """Where floats lose the digits of a sliding its bound is a number like any other."""
    text = (TESTS / "cases" / "once-wrong" / "04-wrong.toml").read_text()
    (tmp_path / "far.toml").write_text(text.replace("[-20, 19]", "[1e9, 19]"))
    found = ran("solve", tmp_path / "far.toml").json
    assert found["arithmetic"] != "floats"
    assert 0 < found["bounds"]["acceleration"] < 1e-9


def test_each_number_has_a_bound_of_its_own() -> None:
    """With --bounds each printed number has its own, none larger than that of its kind, and nothing else is changed."""
    told = ran("solve", "jaanimets-10", "--bounds").json
    each = told["bounds"].pop("each")
    assert {*each} >= {"velocity", "omega", "acceleration", "alpha", "reaction", "balance"}
    assert {*each["velocity"]} == {name for name, entry in told["points"].items() if "velocity" in entry}
    numbers = [bound for named in each.values() for vector in named.values()
               for bound in (vector if isinstance(vector, list) else [vector])]
    assert max(numbers) == max(told["bounds"].values()) < 1e-12
    assert told == ran("solve", "jaanimets-10").json


# ---- without python-flint --------------------------------------------------------------------------------------------


def solved_without_flint(*paths: Path) -> list[str]:
    """What `solve` prints of scenes, in a process that has no python-flint."""
    code = """
import sys
sys.modules["flint"] = None
import graphplan as gp
for path in sys.argv[1:]:
    print(gp.solve(gp.load(path)).text, end="\\0")
"""
    done = subprocess.run([sys.executable, "-c", code, *map(str, paths)], check=True, capture_output=True, text=True)
    return done.stdout.split("\0")[:-1]


def test_without_flint_fractions_serve_and_bounds_are_as_large_as_they_are(tmp_path: Path) -> None:
    """Of a rational scene fractions give the digits that floats cannot; of another few digits are left, and it says so:
    what python-flint finds lies within the bound."""
    flat = (SCENES / "flat.toml").read_text()
    (tmp_path / "flat.toml").write_text(flat.replace("90.1", "90.0000000001"))
    (tmp_path / "placed.toml").write_text(flat.replace("90.1", "90.00001").replace(
        "A = [30, 40]", 'A = { from = "O", distance = 50, angle = 53.13010235415598 }'))
    paths = [tmp_path / "flat.toml", *(SCENES / f"{name}.toml" for name in ("turntables", "resting", "touching"))]
    *rational, placed = solved_without_flint(*paths, tmp_path / "placed.toml")
    for path, text in zip(paths, rational, strict=True):
        scene = gp.load(str(path))
        found = gp.Results(scene, text)
        assert found.json()["arithmetic"] in ("floats", "fractions")
        assert wrong(scene, found, 1e-9) == []
    scene = gp.load(str(tmp_path / "placed.toml"))
    rough, sharp = gp.Results(scene, placed), gp.solve(scene)
    assert (rough.json()["arithmetic"], sharp.json()["arithmetic"]) == ("floats", "enclosures of 160 digits")
    assert max(sharp.json()["bounds"].values()) <= 1e-9 < max(rough.json()["bounds"].values())
    for kind in ("velocity", "acceleration"):
        bound, largest = rough.json()["bounds"][kind], max(map(abs, getattr(sharp, kind).values()))
        for name, value in getattr(sharp, kind).items():
            assert abs(getattr(rough, kind)[name] - value) <= bound * largest
