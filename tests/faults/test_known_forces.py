"""Forces that were once wrong, left out or refused: with friction they are those with friction, and none vanishes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from graphplan.check import decided_friction, trusted
from graphplan.commands import main

HERE = Path(__file__).parent / "paper"
PLANS = "", "lever", "polygons", "polar"


def solved(capsys: pytest.CaptureFixture[str], name: str, *options: str) -> Any:
    """What `solve` prints of a scene; it must be done without complaint."""
    status = main(["solve", str(HERE / f"{name}.toml"), *options])
    told = capsys.readouterr()
    assert status == 0, told.err
    return json.loads(told.out)


@pytest.fixture(params=[True, False], ids=["flint", "no flint"])
def certified(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """With python-flint, and as if it were not installed."""
    if not request.param:
        for module in trusted, decided_friction:
            monkeypatch.setattr(module, "has_flint", lambda: False)


@pytest.mark.usefixtures("certified")
@pytest.mark.parametrize("plan", PLANS)
@pytest.mark.parametrize(("name", "smooth", "rough"), [
    ("friction-drawn-wrong", -0.012932, -0.016319895279808486), ("friction-flint-exit1", 0.0, -0.3137254901960785)])
def test_friction_rubs_nothing_that_stands_still(name: str, smooth: float, rough: float, plan: str,
                                                 capsys: pytest.CaptureFixture[str]) -> None:
    """A pair that stands still but for rounding has no friction, whatever is installed and whichever plan is drawn."""
    told = solved(capsys, name, "--plan", plan)
    assert told["balance"]["moment"] == pytest.approx(rough, rel=1e-12)
    assert told["without_friction"]["balance"]["moment"] == pytest.approx(smooth, rel=1e-12, abs=1e-15)
    assert told["friction"]["rounds"] >= 1
    assert told["check"]["force"] < 1e-11


@pytest.mark.parametrize("plan", ["lever", ""])
def test_reactions_of_gears_and_contacts_are_told(plan: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Where the lever alone is drawn the forces between teeth and profiles are there, and what is not drawn is said."""
    told = solved(capsys, "reactions-dropped", "--plan", plan)
    forces = {next(one[sort] for sort in ("gear", "contact", "slide", "at") if sort in one): one["force"]
              for one in told["reactions"]}
    assert set(forces) == {"P1", "P3", "P4", "P5", "P6", "P7", "P12", "4 along frame", "6 along 2", "7 3", "4 6"}
    assert forces["7 3"] == pytest.approx([133.50461744185833, -313.0453098636678], rel=1e-12)
    assert forces["4 6"] == [0.0, 0.0]
    alone, = (text for text in told["method"]["force"] if text.startswith("analytic solver alone: "))
    assert {"7 3", "4 6"} <= set(alone.removeprefix("analytic solver alone: ").split(", "))
    assert "reasons" not in told


def test_velocities_need_no_balance(capsys: pytest.CaptureFixture[str]) -> None:
    """Where velocities alone are asked for, masses need nothing that balances them."""
    told = solved(capsys, "masses-without-balance")
    assert told["points"] == {"A": {"velocity": [0.0, 200.0]}}
    assert "reactions" not in told


def test_reactions_need_a_balance(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Where reactions are asked for, something has to balance the masses."""
    scene = tmp_path / "scene.toml"
    scene.write_text((HERE / "masses-without-balance.toml").read_text() + 'reactions = "all"\n')
    assert main(["solve", str(scene)]) == 2
    assert "balance: no balances for 1 drive" in capsys.readouterr().err


@pytest.mark.parametrize("options", [(), ("--plan", "lever"), ("--digits", "20")])
def test_a_dead_loop_sinks_nothing_else(options: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    """A loop in a singular pose is null, with the reason by name; what the others do and bear is told."""
    told = solved(capsys, "dead-loop-sinks-all", *options)
    assert told["points"]["Q"] == {"velocity": None}
    velocity = [float(part) for part in told["points"]["B"]["velocity"]]
    assert velocity == pytest.approx([-67.741935483871, -13.548387096774])
    assert float(told["balance"]["moment"]) == pytest.approx(-0.336187980257359, rel=1e-12)
    assert float(told["without_friction"]["balance"]["moment"]) == pytest.approx(-21 / 62, rel=1e-12)
    null = {f"{one['on']} at {one['at']}" for one in told["reactions"] if one["force"] is None}
    assert null == {"4 at P", "5 at Q", "5 at R"} == told["reasons"]["reactions"].keys()
    assert told["reasons"]["points"].keys() == {"Q"}
    assert all("links 4 5" in why for named in told["reasons"].values() for why in named.values())


def test_what_is_singular_altogether_is_exit_3(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Where nothing of what is asked exists the pose is singular, and the links are named."""
    scene, text = tmp_path / "scene.toml", (HERE / "dead-loop-sinks-all.toml").read_text()
    scene.write_text(text.partition("[[balance]]")[0] + '[find]\nvelocity = ["Q"]\n')
    assert main(["solve", str(scene)]) == 3
    assert "singular pose of links 4, 5" in capsys.readouterr().err


SLIDING = """
gravity = [0, -9.81]
[points]
P = [0, 0]
R = [5, 0]
[links]
frame = "R"
1 = "P"
[[slides]]
link = "1"
along = "frame"
at = "P"
direction = [1, 0]
[[drive]]
slide = ["1", "frame"]
speed = 1
[[forces]]
on = "1"
at = "P"
value = [-10, 0]
[[balance]]
on = "1"
at = "P"
direction = [1, -1]
[[friction]]
slide = ["1", "frame"]
coefficient = 1
"""


def test_what_locks_itself_is_null_with_the_reason(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A machine that locks itself has its motion, and the forces that it would have without friction."""
    scene = tmp_path / "scene.toml"
    scene.write_text(SLIDING)
    assert main(["solve", str(scene)]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["balance"] == {"force": None, "link": "1", "at": "P"}
    assert told["reactions"][0]["force"] is None
    assert told["without_friction"]["balance"]["force"] == [10.0, -10.0]
    assert "self-locking" in told["reasons"]["balance"]["1"]
    assert "self-locking" in told["reasons"]["reactions"]["1 along frame"]
    assert told["points"]["P"]["velocity"] == [1.0, 0.0]
