"""Travel has one sense everywhere: that in which the first drive moves."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import numpy as np
import pytest

import graphplan as gp
from graphplan.commands import main
from graphplan.cycle import follow
from graphplan.mechanism.travel import paces, sense_of_travel
from tests.shared import four_bars

LOADED = """
    [[moments]]
    on = "1"
    over = "travel"
    values = [[0, 0], [90, 90], [180, 0], [270, -90], [360, 0]]
    [masses.1]
    mass = 0
    inertia = 1
    centre = "O"
    [balance]
    link = "1"
    [flywheel]
    speed = 10
    unevenness = 0.05
    """


def four_bar(omega: str, more: str = "") -> gp.Scene:
    return gp.parse(four_bars.four_bar(f"omega = {omega}", A="[12, 16]", B="[60, 40]", C="[50, 0]") + more, "four-bar")


@pytest.mark.parametrize("omega", ["3", "0", "-3"])
def test_travel_counts_as_the_drive_moves(omega: str) -> None:
    """The crank goes by its travel in the sense of its omega, and from rest counter-clockwise."""
    scene = four_bar(omega)
    turn = follow(scene, 9, (-40, 40))
    sense = -1 if omega == "-3" else 1
    assert sense_of_travel(scene) == sense
    assert np.allclose(turn.points["A"], (12 + 16j) * np.exp(1j * sense * np.radians(np.linspace(-40, 40, 9))))
    there = gp.at(scene, 40)
    assert math.dist(there.points["A"], (turn.points["A"][-1].real, turn.points["A"][-1].imag)) < 1e-12
    assert there.assembly is not None
    assert there.assembly.travels == (40,)


def test_each_drive_has_its_own_sense() -> None:
    """Drives that keep pace go on together, each in its own sense; a travel below nothing goes back."""
    scene = gp.load("five-bar")
    together, back = gp.at(scene, 20), gp.at(scene, [-20, 20])
    assert together.assembly is not None
    assert paces(scene) == (1, -1)
    assert [*together.assembly.travels] == [20, 20]
    turned = {name: np.angle(complex(*map(float, posed.points[crank])) - complex(*map(float, scene.points[pivot])))
              - np.angle(complex(*map(float, scene.points[crank])) - complex(*map(float, scene.points[pivot])))
              for name, posed, crank, pivot in (("on", together, "A", "O"), ("with", together, "B", "P"),
                                                ("back", back, "A", "O"))}
    assert np.degrees([turned["on"], turned["with"], turned["back"]]) == pytest.approx([20, -20, -20])


@pytest.mark.parametrize("omega", ["10", "-10"])
def test_every_command_reads_a_table_at_one_travel(omega: str, tmp_path: Path,
                                                   capsys: pytest.CaptureFixture[str]) -> None:
    """At a travel of 30 degrees `solve --at`, `cycle` and `flywheel` have the load of the table's row there."""
    path = tmp_path / "scene.toml"
    path.write_text(four_bars.four_bar(f"omega = {omega}", A="[12, 16]", B="[60, 40]", C="[50, 0]") + LOADED)

    def printed(*words: str) -> str:
        assert main([words[0], str(path), *words[1:]]) == 0
        return capsys.readouterr().out

    balance = json.loads(printed("solve", "--at", "30"))["balance"]["moment"]
    rows = [*csv.DictReader(io.StringIO(printed("cycle", "--positions", "12")))]
    (of_cycle,) = (float(value) for head, value in rows[1].items() if "balance" in head or "moment" in head)
    reduced = dict(json.loads(printed("flywheel", "--positions", "12", "-o", "-"))["reduced_moment"])
    assert float(rows[1]["travel [deg]"]) == pytest.approx(30)
    assert balance == pytest.approx(-30)
    assert of_cycle == pytest.approx(-30)
    assert reduced[30.0] == pytest.approx(30 if omega == "10" else -30)
