"""A point of contact that rounding has off its common normal stands for the one on it."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from graphplan.commands import main

SCENE = """title = "A cam pushes a lever"
[points]
O = [0, 0]
C2 = [12, 9]
K = [{x}, {y}]
C3 = [60, 45]
P = [100, {height}]
[links]
frame = "O P"
1 = "O C2"
2 = "P C3"
[[contacts]]
links = ["1", "2"]
at = "K"
centres = ["C2", "C3"]
[[drive]]
link = "1"
omega = 2
[[moments]]
on = "2"
value = 3
[balance]
link = "1"
[find]
velocity = "all"
reactions = "all"
{friction}
"""
FRICTION = """[[friction]]
contact = ["1", "2"]
coefficient = 0.1
"""


def text(off: float, height: int = -20, friction: str = "") -> str:
    """The scene with its point of contact so far off the normal, which runs like 4 : 3."""
    return SCENE.format(x=24 - 3 * off, y=18 + 4 * off, height=height, friction=friction)


@pytest.mark.parametrize("off", [1e-12, 2e-11, 1e-10])
@pytest.mark.parametrize("how", [{}, {"height": 0}, {"friction": FRICTION}], ids=["loaded", "dead", "rubbing"])
def test_forces_are_those_on_the_normal(how: dict[str, int | str], off: float, tmp_path: Path,
                                        capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever is off, within what is accepted, balance and reactions are those of the point on the normal."""
    found = []
    for distance in (0, off):
        path = tmp_path / "scene.toml"
        path.write_text(text(distance, **how))  # type: ignore[arg-type]
        assert main(["solve", str(path)]) == 0, capsys.readouterr().err
        data = json.loads(capsys.readouterr().out)
        found.append((data["balance"]["moment"], *(one["force"] for one in data["reactions"])))
    for true, near in zip(*found, strict=True):
        assert near == pytest.approx(true, rel=1e-9, abs=1e-9)


def test_the_foot_is_exact(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In fractions both opinions agree to nothing."""
    path = tmp_path / "scene.toml"
    path.write_text(text(2e-11))
    assert main(["solve", "--exact", str(path)]) == 0, capsys.readouterr().err
    assert {Fraction(part) for part in json.loads(capsys.readouterr().out)["check"].values()} == {0}
