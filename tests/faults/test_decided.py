"""Scenes that were once refused, alarmed at or never done, though regular: each is decided."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from graphplan.commands import main

SCENES = Path(__file__).parent / "decided"


def solved(capsys: pytest.CaptureFixture[str], name: str, *options: str) -> Any:
    """What `solve` prints of a scene; it must be done without complaint."""
    status = main(["solve", str(SCENES / f"{name}.toml"), *options])
    said = capsys.readouterr()
    assert status == 0, said.err
    return json.loads(said.out)


@pytest.mark.parametrize("options", [(), ("--digits", "15"), ("--exact",), ("--plan", "polar")])
def test_a_pose_near_a_dead_centre_has_its_digits(options: tuple[str, ...],
                                                  capsys: pytest.CaptureFixture[str]) -> None:
    """A crank and its coupler 1e-7 off one line: the rates are those of the exact pose, whatever is asked of them."""
    data = solved(capsys, "near-singular-exit1", *options)
    velocity = [Fraction(part) for part in data["points"]["P2"]["velocity"]]
    assert [*map(float, velocity)] == pytest.approx([-15.6, -213.20000013], rel=1e-15)
    assert [float(Fraction(link["omega"])) for link in data["links"].values()] == pytest.approx([-1.3] * 3, rel=1e-15)


@pytest.mark.parametrize("power", [4, 6, 8, 9, 10, 11, 12])
def test_every_distance_from_a_dead_centre_is_regular(power: int, tmp_path: Path,
                                                      capsys: pytest.CaptureFixture[str]) -> None:
    """However near the dead centre, each drawn step keeps its claims and each number is the exact one."""
    text = (SCENES / "near-singular-exit1.toml").read_text().replace("187.0000001", f"187.{'0' * (power - 1)}1")
    scene = tmp_path / "near.toml"
    scene.write_text(text)
    found = {}
    for options in ((), ("--exact",)):
        assert main(["solve", str(scene), *options]) == 0
        found[options] = json.loads(capsys.readouterr().out)["points"]
    for name, exact in found["--exact",].items():
        for kind, vector in exact.items():
            assert found[()][name][kind] == pytest.approx([float(Fraction(part)) for part in vector], rel=1e-9), name
    assert main(["check", str(scene)]) == 0


def test_proven_digits_are_those_of_the_floats(capsys: pytest.CaptureFixture[str]) -> None:
    """What plain `solve` finds `--digits` finds too, by another way where the first never has any bounds."""
    proven, plain = solved(capsys, "digits-exit3", "--digits", "15"), solved(capsys, "digits-exit3")
    for table in ("points", "links"):
        for name, entry in plain[table].items():
            for key, value in entry.items():
                digits = proven[table][name][key]
                digits = [*map(float, digits)] if isinstance(digits, list) else float(digits)
                assert digits == pytest.approx(value, rel=1e-12, abs=1e-12), (name, key)
    assert float(proven["balance"]["moment"]) == pytest.approx(plain["balance"]["moment"], rel=1e-12)


def test_a_rack_joins_no_lines_of_centres(capsys: pytest.CaptureFixture[str]) -> None:
    """Beside a rack, trains that are not in line keep their triangles apart."""
    data = solved(capsys, "triangles-wrong-alpha", "--plan", "triangles")
    assert data["links"]["3"]["alpha"] == pytest.approx(0.1833471205920434, rel=1e-12)


def test_an_arc_without_radius_is_a_point(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The return circle at a cusp is drawn as its pole."""
    sheet = tmp_path / "sheet.svg"
    assert main(["draw", str(SCENES / "draw-traceback.toml"), "-o", str(sheet)]) == 0, capsys.readouterr().err
    assert sheet.read_text().startswith("<")
    solved(capsys, "draw-traceback", "--prefer", "quick")


def test_a_form_of_six_links_is_preferred(capsys: pytest.CaptureFixture[str]) -> None:
    """The accurate form has the numbers of the usual one."""
    usual, accurate = (solved(capsys, "prefer-accurate-slow", *options) for options in ((), ("--prefer", "accurate")))
    for link, rates in usual["links"].items():
        assert accurate["links"][link]["omega"] == pytest.approx(rates["omega"], rel=1e-9)


@pytest.mark.parametrize("options", [(), ("--digits", "15"), ("--exact",)])
def test_what_does_not_exist_sinks_nothing_else(options: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    """Links at rest have no inflection circle, and are told so; their rates, and the poles that pins are, stand."""
    data = solved(capsys, "resting-link", *options)
    assert data["inflection"]["2"] is None
    assert "nothing moves" in data["reasons"]["inflection"]["2"]
    assert data["poles"]["2 frame"] == {"at": None}
    assert "do not move" in data["reasons"]["poles"]["2 frame"]
    assert [*map(Fraction, data["poles"]["1 2"]["at"])] == [30, 40]
    assert math.hypot(*(float(Fraction(part)) for part in data["points"]["B"]["acceleration"])) > 1


@pytest.mark.parametrize("options", [(), ("--digits", "15"), ("--exact",)])
def test_singular_forces_sink_no_rates(options: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    """Where forces of twelve links are singular, the reason is given and their rates are found."""
    data = solved(capsys, "singular-forces", *options)
    assert "cannot hold" in data["reasons"]["balance"]["20"]
    assert data["links"]["3"]["omega"] is not None


def test_a_single_point_has_no_circle_drawn(capsys: pytest.CaptureFixture[str]) -> None:
    """An inflection circle takes two points of a plane: where there is one, its velocity stands alone."""
    data = solved(capsys, "single-point")
    assert data["points"]["P0"]["velocity"] == [-4, 16]
    assert data["inflection"]["1"] is None
    assert "lie in one place" in data["reasons"]["inflection"]["1"]


def test_a_mechanism_at_rest_accelerates_by_its_auxiliary_point(capsys: pytest.CaptureFixture[str]) -> None:
    """An auxiliary point that velocities of nothing need not have is drawn for the accelerations."""
    data = solved(capsys, "resting-auxiliary-point", "--exact")
    assert data["slides"]["2 along 3"]["acceleration"] == ["-9/4", "27/5"]
    assert set(data["check"].values()) == {0}
