"""Loads over the cycle: tables in scenes and beside them, and what they say in the scene's own pose."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from graphplan.errors import SceneError
from graphplan.mechanism.loads import LoadTable
from graphplan.mechanism.model import Balance, Flywheel, RunRequest
from graphplan.mechanism.scene import load, parse

YOKE = """
[points]
O = [0, 0]
A = [120, 160]
A3 = [120, 160]
B = [300, 0]
[links]
1 = "O A"
2 = "A"
3 = "A3 B"
frame = "O"
[[slides]]
link = "2"
along = "3"
at = "A"
direction = [0, 1]
[[slides]]
link = "3"
along = "frame"
at = "A3"
direction = [2, 0]
[[drive]]
link = "1"
omega = 15
[balance]
link = "1"
[[forces]]
on = "3"
at = "B"
"""
ALONG = 'direction = [0, 2]\nover = "3 along frame"\n'
ROUND = "values = [[200, 50], [-200, 10], [-200, -10], [200, -50]]\n"


def value(text: str) -> tuple[object, ...]:
    """The force on the yoke in its pose."""
    loads = parse(YOKE + text, "yoke").loads
    assert loads is not None
    return loads.forces[0].value


def faults(text: str) -> str:
    """The fault lines of a scene."""
    with pytest.raises(SceneError) as caught:
        parse(text, "yoke")
    return str(caught.value)


def test_the_value_in_the_given_pose_is_exact() -> None:
    """A table says a fraction where the drive or the slide stands, on the stroke on which the slide moves."""
    for text, along in [
        (ALONG + ROUND, Fraction(42)),  # inwards: the crank turns from 53 degrees on
        (ALONG + "values = [[-200, -10], [200, -50], [200, 50], [-200, 10]]\n", Fraction(42)),  # outwards first
        (ALONG.replace("3 along frame", "travel") + "values = [[-60, 0], [60, 7], [300, 0]]\n", Fraction(7, 2)),
        (ALONG.replace("3 along frame", "travel") + "values = [[0, 1], [0, 3], [360, 1]]\n", Fraction(3)),
        (ALONG.replace("3 along frame", "travel") + "values = [[1, 7], [9, 1]]\n", Fraction(7)),  # its end holds
        (ALONG.replace("3 along frame", "travel") + 'values = [[1, 7], [9, 1]]\nbeyond = "zero"\n', Fraction(0)),
        (ALONG + "values = [[90, 5], [-90, 1], [90, 0]]\n", Fraction(5)),
        (ALONG + 'values = [[90, 5], [-90, 1], [90, 0]]\nbeyond = "zero"\n', Fraction(0)),
        (ALONG.replace("3 along frame", "speed") + "values = [[10, 1], [20, 2]]\n", Fraction(3, 2)),
        (ALONG.replace("3 along frame", "speed") + "powers = [1, 2, 1]\n", Fraction(256)),
        (ALONG.replace("3 along frame", "speed of 3 along frame") + "powers = [0, 0.5, 0.001]\n", Fraction(-6960)),
    ]:
        assert value(text) == (0, along), text


def test_a_drive_the_other_way_takes_the_other_stroke() -> None:
    """Turned backwards the slide goes out; at rest it moves as the drive would turn it forwards."""
    closed = ROUND.replace("[200, -50]]", "[200, -50], [200, 50]]")  # the round may say that it is closed
    for omega, along in [("-15", -42), ("0", 42), ("0\nalpha = -2", -42)]:
        for rows in (ROUND, closed):
            text = (YOKE + ALONG + rows).replace("omega = 15", f"omega = {omega}")
            assert parse(text, "yoke").loads.forces[0].value == (0, along)  # type: ignore[union-attr]


def test_what_rounding_leaves_exact() -> None:
    """In a rounded pose a load is exact where its table is level, and known to a float's digits where it is not."""
    polar = (YOKE + ALONG).replace("A = [120, 160]", 'A = { from = "O", distance = 200, angle = 50 }').replace(
        "A3 = [120, 160]", 'A3 = { from = "O", distance = 200, angle = 50 }')
    told = "forces.1: its value in this pose"
    assert told in parse(polar + ROUND, "yoke").irrational
    level = parse(polar + "values = [[200, 50], [-200, 50], [-200, -10], [200, -50]]\n", "yoke")
    assert told not in level.irrational
    assert level.loads is not None
    assert level.loads.forces[0].value == (0, 50)


def test_at_a_dead_point_the_stroke_is_that_which_begins() -> None:
    """Where the slide stands still it takes the stroke into which the drive leads, by rounding or not."""
    for places, along in [(("[200, 0]", "[200, 0]"), 50), (("[-200, 0]", "[-200, 0]"), -10),
                          (('{ from = "O", distance = 200, angle = 540 }',) * 2, -10)]:
        text = YOKE.replace("A = [120, 160]", f"A = {places[0]}").replace("A3 = [120, 160]", f"A3 = {places[1]}")
        assert parse(text + ALONG + ROUND, "yoke").loads.forces[0].value == (0, along)  # type: ignore[union-attr]


def test_files_beside_the_scene(tmp_path: Path) -> None:
    """Two columns with a head, comments, and commas or semicolons are the rows; the scene's text has them instead."""
    (tmp_path / "scene.toml").write_text(YOKE + ALONG + 'file = "gas.csv"  # measured\n', encoding="utf-8")
    for text in ("x,F\n200,50\n-200,10\n-200,-10\n200,-50\n",
                 "# indicator\nmm;N\n200,0;50,0\n-200;10\n-200;-10\n200;-50",
                 "200\t50\n\n-200\t10\n-200\t-10 # jump\n200\t-50", "200,0 50\n-200 10\n-200 -10\n200 -50\n"):
        (tmp_path / "gas.csv").write_text(text, encoding="utf-8")
        scene = load(tmp_path / "scene.toml")
        assert scene.loads is not None
        assert scene.loads.forces[0].value == (0, 42), text
        assert "gas.csv" not in scene.text
        assert parse(scene.text, "elsewhere").loads == scene.loads


def test_faults_of_tables(tmp_path: Path) -> None:
    """Each fault is one line that says where, what is wrong, and what would be right."""
    (tmp_path / "words.csv").write_text("1,2\nthree,4\n", encoding="utf-8")
    (tmp_path / "bytes.txt").write_bytes(b"\xff\xfe1")
    for text, fault in [
        (ALONG + "values = [[200, 5], [-200, 1]]", "forces.1.values: the rows do not come back"),
        (ALONG + "values = [[200, 5]]", "forces.1.values: a table of fewer than two places"),
        (ALONG + "values = [[0, 1], [0, 2], [0, 3], [9, 1], [0, 4]]", "forces.1.values: three rows at one place, 0"),
        (ALONG + 'values = [[0, "x"], [1, 2]]', "forces.1.values: the string"),
        (ALONG + "powers = [1]", "forces.1.powers: powers are of a speed"),
        (ALONG, "forces.1: values is missing"),
        (ALONG + "value = [1, 2]\n" + ROUND, "forces.1: value and over are both given"),
        (ALONG + ROUND + "powers = [1]", "forces.1: values and powers are both given"),
        (ALONG.replace("[0, 2]", "[0, 0]") + ROUND, "forces.1.direction: the direction is zero"),
        (ALONG.replace("direction = [0, 2]\n", "") + ROUND, "forces.1: direction is missing"),
        (ALONG.replace("3 along", "4 along") + ROUND, "forces.1.over: there is no slide 4 along frame"),
        (ALONG.replace("3 along frame", "travel") + "values = [[0, 1], [9, 1], [8, 2]]", "row 3 goes back to 8"),
        ("value = [1, 2]\npowers = [1]", "forces.1.powers: powers needs the key over"),
        ('value = [1, 2]\nbeyond = "zero"', "forces.1.beyond: beyond needs the key over"),
        ("value = [1, 2]\ndirection = [1, 0]", "forces.1.direction: a constant force has its direction in its value"),
        (ALONG + "file = 'none.csv'", "forces.1.file: none.csv cannot be read (No such file or directory)"),
        (ALONG + "file = '../x.csv'", "is not the name of a table beside the scene"),
        (ALONG + "file = 'bytes.txt'", "it is no text in UTF-8"),
        (ALONG + "file = 'words.csv'", "words.csv, line 2"),
    ]:
        with pytest.raises(SceneError) as caught:
            parse(YOKE + text, str(tmp_path / "yoke.toml"))
        assert len(caught.value.faults) == 1, text
        assert fault in str(caught.value), text


def test_flywheel_and_run() -> None:
    """What is asked of the machine over its cycle; the drive then keeps the motion where no balance is written."""
    bare = (YOKE + "value = [1, 2]\n").replace('[balance]\nlink = "1"\n', "")
    scene = parse(bare + '[flywheel]\nspeed = 15\nunevenness = 0.02\n[run]\ntravel = 720\n', "yoke")
    assert scene.flywheel == Flywheel(Fraction(15), Fraction(1, 50))
    assert scene.run == RunRequest(travel=Fraction(720))
    assert scene.loads is not None
    assert scene.loads.balances == (Balance("1"),)
    for table, fault in [
        ("unevenness = 0.1", "flywheel: speed is missing"), ("speed = 1", "flywheel: unevenness is missing"),
        ("speed = 1\nunevenness = 2", "flywheel.unevenness: an unevenness of 2"),
        ("speed = -1\nunevenness = 0.1", "flywheel: a mean speed of -1"),
        ("speed = 1\nunevenness = 0.1\ninertia = 1", "flywheel: unevenness and inertia are both given"),
        ('speed = 1\nunevenness = 0.1\ncloses = "both"', "flywheel.closes:"),
    ]:
        assert fault in faults(f"{bare}[flywheel]\n{table}\n")


def test_many_places_at_once() -> None:
    """Arrays of places have the loads that they have one by one, before and after jumps, over whole turns as well."""
    travel = LoadTable("travel", ((0, 1), (90, 3), (90, -3), (360, 1)), period=360)  # type: ignore[arg-type]
    slide = LoadTable("3 along frame", ((2, 5), (0, 1), (0, -1), (2, -5)))  # type: ignore[arg-type]
    for table, places, senses in [(travel, np.linspace(-400, 800, 97), np.ones(97)),
                                  (travel, np.linspace(-400, 800, 97), -np.ones(97)),
                                  (slide, np.linspace(-1e-10, 2 + 1e-10, 9), np.resize([1, -1], 9))]:
        for after in (True, False):
            alone = [table.value(Fraction(p), int(s), after) for p, s in zip(places, senses, strict=True)]
            assert table.values_at(places, senses, after) == pytest.approx(np.array(alone, float), rel=1e-12), table
    assert travel.value(Fraction(90)) == -3
    assert travel.value(Fraction(90), after=False) == 3
    assert travel.value(Fraction(90), -1) == 3
    assert (travel.value(Fraction(360)), travel.value(Fraction(360), after=False)) == (1, 1)
    jump = LoadTable("travel", ((0, 1), (360, 5)), period=360)  # type: ignore[arg-type]
    for place in (-360, 0, 360, 720 + 1e-8):
        assert jump.values_at([place, place]) == pytest.approx([1, 1])
        assert jump.values_at([place, place], after=False) == pytest.approx([5, 5])
    assert slide.value(Fraction(0), -1) == 1
    assert [*slide.values_at(np.array([1.0, 2.1, -1.0]))] == [-3, -5, -1]
    assert [*replace(slide, beyond="zero").values_at(np.array([1.0, 2.1, -1.0]))] == [-3, 0, 0]
