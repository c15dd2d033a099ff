"""The command line where forces are asked for: JSON as in the contract, the protocol, faults, exit statuses."""

from __future__ import annotations

import io
import json
from fractions import Fraction
from typing import Any

import pytest
from four_bars import four_bar

from graphplan.commands import main

PRESS = """
title = "Press"
gravity = [0, -9.81]
[units]
length = "m"
[points]
O = [0, 0]
A = [3, 4]
B = [15, -1]
[links]
1 = "O A"
2 = "A B"
4 = "B"
frame = "O"
[[slides]]
link = "4"
along = "frame"
at = "B"
direction = [1, 0]
[[drive]]
link = "1"
omega = 2
[masses.2]
mass = 2
inertia = 1.5
centre = "B"
[[forces]]
on = "4"
at = "B"
value = [-12, 5]
[[moments]]
on = "2"
value = 7
[balance]
link = "1"
"""

LEVERED = PRESS.replace('4 = "B"', '3 = "B"\n4 = "B"\n5 = "D"').replace("[links]", "D = [27, -1]\n[links]").replace(
    'frame = "O"', 'frame = "O D"').replace(
    "[[drive]]", '[[slides]]\nlink = "3"\nalong = "5"\nat = "B"\ndirection = [3, 4]\n[[drive]]')

REST = four_bar("omega = 0", head='title = "Press"\n', more="""[[forces]]
on = "3"
at = "B"
value = [-12, 5]
[balance]
at = "A"
on = "2"
direction = [-4, 3]
""")


def ran(arguments: list[str], text: str, monkeypatch: pytest.MonkeyPatch) -> int:
    """The exit status of a command that reads this scene."""
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
    return main([arguments[0], "-", *arguments[1:]])


def solved(text: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], *options: str) -> Any:
    """What `graphplan solve` prints for a scene."""
    assert ran(["solve", *options], text, monkeypatch) == 0
    return json.loads(capsys.readouterr().out)


def exactly(pair: list[str]) -> list[Fraction]:
    return [Fraction(number) for number in pair]


def test_reactions_of_a_joint_add_up(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """At a joint of three links the one named first carries the pin; slider, load and reactions are in balance."""
    told = solved(LEVERED, monkeypatch, capsys, "--exact")
    at_pin = [entry for entry in told["reactions"] if entry.get("at") == "B"]
    assert [(entry["on"], entry["from"]) for entry in at_pin] == [("3", "2"), ("4", "2")]
    guide = next(entry for entry in told["reactions"] if entry.get("slide") == "4 along frame")
    slider = next(entry for entry in at_pin if entry["on"] == "4")
    total = [a + b + c for a, b, c in zip(exactly(guide["force"]), exactly(slider["force"]), (-12, 5), strict=True)]
    assert total == [0, 0]
    assert Fraction(guide["moment"]) == 0
    assert told["check"]["force"] == 0


def test_balance_as_a_force_at_rest(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """A mechanism at rest is balanced by a force along its direction, the same by polygons and by the lever."""
    told = [solved(REST, monkeypatch, capsys, "--exact", "--plan", plan)["balance"] for plan in ("polygons", "lever")]
    assert told[0] == told[1]
    x, y = exactly(told[0]["force"])
    assert 3 * x == -4 * y


def test_lever_alone_draws_the_balance_alone(monkeypatch: pytest.MonkeyPatch,
                                             capsys: pytest.CaptureFixture[str]) -> None:
    """With --plan lever reactions are the solver's, and said to be; one that is asked for by name is drawn, its pair
    freed."""
    by_plans = solved(REST, monkeypatch, capsys, "--exact")["reactions"]
    alone = solved(REST, monkeypatch, capsys, "--plan", "lever", "--exact")
    assert alone["reactions"] == by_plans
    assert alone["method"]["force"][-1].startswith("analytic solver alone: frame at O")
    asked = solved(REST + '[find]\nreactions = ["C"]', monkeypatch, capsys, "--plan", "lever", "--exact")
    assert [entry for entry in by_plans if entry["at"] == "C"] == asked["reactions"]
    assert not any(way.startswith("analytic solver") for way in asked["method"]["force"])


def test_several_balances_are_a_list(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Two drives need two balances, which are printed as a list."""
    text = """
[points]
O = [0, 0]
A = [30, 40]
B = [90, 100]
C = [140, 60]
D = [150, 0]
[links]
1 = "O A"
2 = "A B"
3 = "B C"
4 = "C D"
frame = "O D"
[[drive]]
link = "1"
omega = 1
[[drive]]
link = "4"
omega = -2
[[forces]]
on = "2"
at = "B"
value = [3, -8]
[[balance]]
link = "1"
[[balance]]
link = "4"
"""
    told = solved(text, monkeypatch, capsys)
    assert [list(balance) for balance in told["balance"]] == [["moment", "link"], ["moment", "link"]]
    assert [balance["link"] for balance in told["balance"]] == ["1", "4"]
    assert told["check"]["force"] < 1e-12


def test_steps_speak_of_forces(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """The protocol has a part for each force plan and for the lever, and says what every load is."""
    assert ran(["steps"], PRESS, monkeypatch) == 0
    words = " ".join(capsys.readouterr().out.split())
    for said in (
        "On the force plan of links 2 and 4:", "On the force plan of link 1:", "On the lever:",
        ": moments of link 2 about B", "P_4, the given force on link 4 at B", "G_2, the weight of link 2",
        "J_2, the inertia force of link 2", "The inertia couple of link 2",
    ):
        assert said in words


def test_unbalanced_scene_is_refused(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Loads without a balance are a fault of the scene: one line, exit status 2, nothing printed."""
    assert ran(["solve"], REST.split("[balance]")[0], monkeypatch) == 2
    out, err = capsys.readouterr()
    assert not out
    assert err.splitlines() == [
        '-: balance: no balances for 1 drive: nothing keeps the prescribed motion; [balance] with link = "1" for a '
        "moment, or with at, on and direction for a force"]


def test_balance_without_work_is_singular(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """A balance along the crank does no work in this pose: forces are null, and the motion is told; where forces alone
    are asked for it is exit status 3, with the links that they do not hold."""
    text = REST.replace("[-4, 3]", "[3, 4]")
    told = solved(text, monkeypatch, capsys)
    assert told["balance"]["force"] is None
    assert "cannot hold the motion" in told["reasons"]["balance"]["2"]
    assert told["points"]["B"]["velocity"] == [0.0, 0.0]
    assert ran(["solve"], text + "[find]\nreactions = 'all'\n", monkeypatch) == 3
    err = capsys.readouterr().err
    assert "singular pose of links 1, 2, 3" in err
    assert "the balance cannot hold the motion in this pose" in err


def test_unknown_plan_is_refused(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """A plan that does not exist is refused with exit status 2."""
    assert ran(["solve", "--plan", "levers"], REST, monkeypatch) == 2
    known = "orthogonal, polar, triangles, lever, polygons, both"
    assert f"unknown plan; choose one of {known}" in capsys.readouterr().err


def test_check_shows_three_opinions(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """`check` puts force plans and lever beside the solver, and the power balance below."""
    assert ran(["check"], REST, monkeypatch) == 0
    out = capsys.readouterr().out
    for row in ("reaction 2 at A", "balance 2", "lever 2", "power balance 2", "largest difference in force"):
        assert row in out
