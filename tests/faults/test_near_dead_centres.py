"""Poses near a dead centre are drawn and told with the right numbers, though no pencil follows their flat crossings."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import graphplan as gp
from graphplan.commands import main

SCENE = Path(__file__).parent / "decided" / "near-singular-exit1.toml"


def text(power: int) -> str:
    """The scene with its coupler 10 to this negative power off the dead centre."""
    return SCENE.read_text("utf-8").replace("187.0000001", f"187.{'0' * (power - 1)}1")


@pytest.mark.parametrize("power", [6, 8, 10, 12])
def test_what_a_construction_gives_is_what_is_solved(power: int) -> None:
    """Its velocities and accelerations are those that `solve` prints, however near the dead centre."""
    drawing = gp.construct(gp.parse(text(power), "near.toml"))
    off = 10.0**-power
    assert drawing.velocity["P2"] == pytest.approx(complex(-15.6, -213.2 - 1.3 * off), rel=1e-15)
    assert drawing.acceleration["P2"] == pytest.approx(complex(-277.16 - 1.69 * off, 20.28), rel=1e-15)


@pytest.mark.parametrize("power", [6, 8, 12])
def test_the_protocol_is_given_with_errors_that_are_not_known(power: int, tmp_path: Path,
                                                              capsys: pytest.CaptureFixture[str]) -> None:
    """Every result is told as computed; the pencil's error is null where lines cross too flat, and known elsewhere."""
    path = tmp_path / "near.toml"
    path.write_text(text(power))
    assert main(["steps", str(path), "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    computed = {(one["kind"], one["of"]): one["computed"] for one in data["readings"]}
    assert computed["acceleration", "P2"] == pytest.approx(abs(complex(-277.16 - 1.69 * 10.0**-power, 20.28)), rel=1e-9)
    errors = data["pencil"]["results"]["acceleration"]
    assert errors["P2"]["value"] is errors["P2"]["mm"] is errors["P2"]["relative"] is None
    assert 0 < errors["P1"]["value"] < 10
    blamed = errors["P2"]["worst step"]["number"]
    assert next(step for step in data["steps"] if step["number"] == blamed)["operation"] == "meet"


def test_the_sheet_says_what_no_pencil_follows(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is drawn, with a dash for the errors that are not known, and the step that is to blame."""
    path, sheet = tmp_path / "near.toml", tmp_path / "near.svg"
    path.write_text(text(10))
    assert main(["draw", str(path), "-o", str(sheet)]) == 0, capsys.readouterr().err
    assert main(["steps", str(path)]) == 0
    words = " ".join(capsys.readouterr().out.split())
    assert "P2 ±–" in words
    assert "No pencil follows what – is told of: curves cross too flat, most of all at step 3." in words
