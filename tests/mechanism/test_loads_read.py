"""Loads as they are read, and as they act around the cycle: masses, forces, balances, friction, tables and springs."""

from __future__ import annotations

import csv
import io
import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from face import ran
from test_scenes_read import FAULTS, scene

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases"
ROUND = "values = [[200, 50], [-200, 10], [-200, -10], [200, -50]]\n"


def balances(loads: Any) -> list[tuple[object, ...]]:
    """The balances of loads: their links, points and directions."""
    return [(balance.link, balance.at, balance.direction) for balance in loads.balances]


def test_loads_are_read() -> None:
    """Masses, forces, moments, balance and friction come out as written, in order, as fractions."""
    loads = scene("loaded").loads
    assert loads.gravity == (0, Fraction(-981, 100))
    assert {link: (mass.mass, mass.inertia, mass.centre) for link, mass in loads.masses.items()} == {
        "2": (Fraction(5, 2), Fraction(1, 100), "M"), "3": (4, 0, "B")}
    assert [(force.on, force.at, force.value) for force in loads.forces] == [("3", "B", (-150, Fraction(1, 2)))]
    assert [(moment.on, moment.value) for moment in loads.moments] == [("2", Fraction(3, 10))]
    assert [(one.at, one.slide, one.radius, one.coefficient) for one in loads.frictions] == [
        ("A", None, 5, Fraction(1, 10)), ("", ("3", "frame"), 0, Fraction(2, 25))]
    assert len(loads.balances) == 1


def test_loads_leave_the_mechanism_alone() -> None:
    """Apart from loads and the question, a loaded scene is the scene without them, and as rational."""
    loaded, bare = scene("loaded"), scene("press")
    assert (loaded.points, loaded.links, loaded.slides) == (bare.points, bare.links, bare.slides)
    assert (loaded.drives, loaded.irrational) == (bare.drives, ())


def test_gravity_alone_loads_nothing() -> None:
    """Without masses, forces, moments, balance and friction there are no loads; masses weigh nothing without gravity.
    """
    assert scene("press").loads is scene("open").loads is scene("actuator").loads is None
    assert scene("press", ("title", "gravity = [0, -9.81]\ntitle")).loads is None
    assert scene("loaded", ("gravity = [0, -9.81]\n", "")).loads.gravity == (0, 0)
    alone = scene("press", ("omega = 0.1", 'omega = 0.1\n[balance]\nlink = "1"')).loads
    assert (alone.masses, alone.forces, alone.moments, len(alone.balances)) == ({}, (), (), 1)


def test_several_loads_of_one_link_stand_side_by_side() -> None:
    """Forces and moments on the same link are kept in the scene's order; none replaces another."""
    force = '[[forces]]\non = "2"\nat = "M"\nvalue = [1, 2]\n'
    loads = scene("loaded", ("[balance]", f'{force}{force}[[moments]]\non = "1"\nvalue = -7\n[balance]')).loads
    assert [(force.on, force.at) for force in loads.forces] == [("3", "B"), ("2", "M"), ("2", "M")]
    assert [(moment.on, moment.value) for moment in loads.moments] == [("2", Fraction(3, 10)), ("1", -7)]


def test_a_mass_may_be_zero() -> None:
    """A link may have inertia alone, such as a flywheel on its axis."""
    wheel = scene("loaded", ("[masses.3]", '[masses.1]\nmass = 0\ninertia = 2\ncentre = "O"\n[masses.3]')).loads.masses
    assert (wheel["1"].mass, wheel["1"].inertia, wheel["1"].centre) == (0, 2, "O")


@pytest.mark.parametrize(("written", "direction"), [
    ("[0, 2.5]", (0, Fraction(5, 2))), ("-90", (0, -1)), ("135", (-1, 1)), ('"O A"', (30, 40)), ('"A O"', (-30, -40)),
])
def test_a_balancing_force_has_a_direction_of_any_length(written: str, direction: tuple[object, object]) -> None:
    """It is a vector, an angle or two points; other angles are rounded, and named as irrational."""
    balance = '[balance]\nlink = "1"', f'[balance]\nat = "A"\non = "1"\ndirection = {written}'
    forced = scene("loaded", balance)
    assert (balances(forced.loads), forced.irrational) == ([("1", "A", direction)], ())
    turned = scene("loaded", balance, (f"direction = {written}", "direction = 30"))
    assert turned.loads.balances[0].direction == pytest.approx((math.sqrt(0.75), 0.5), rel=1e-15)
    assert turned.irrational == ("balance.direction: angle",)


def test_each_drive_has_a_balance_of_its_own() -> None:
    """Several balances are a list of tables, moments and forces as one likes, on any link that moves with a drive."""
    force = '[[balance]]\nlink = "1"\n[[balance]]\nat = "B"\non = "4"\ndirection = [1, 0]\n'
    two = scene("five-bar", ("[points]", force + "[points]")).loads
    assert balances(two) == [("1", "", None), ("4", "B", (1, 0))]
    for written, read in [('[[balance]]\nlink = "1"', ("1", "", None)), ('[balance]\nlink = "2"', ("2", "", None)),
                          ('[balance]\nat = "B"\non = "3"\ndirection = [1, 0]', ("3", "B", (1, 0)))]:
        assert balances(scene("loaded", ('[balance]\nlink = "1"', written)).loads) == [read]


@pytest.mark.parametrize(("written", "named"), [
    ('link = "1"\n[[balance]]\nlink = "4"', {"1", "4"}),
    ('link = "2"\n[[balance]]\nat = "C"\non = "2"\ndirection = [1, -2]', {"2", "2 at C"}),
    ('at = "C"\non = "3"\ndirection = [0, 1]\n[[balance]]\nat = "C"\non = "3"\ndirection = [1, -2]',
     {"3 at C along (0, 1)", "3 at C along (1, -2)"}),
])
def test_balances_are_named_by_their_links(written: str, named: set[str]) -> None:
    """Where several act on one link, a force has its point's name too, and its direction where these are the same."""
    text = (FAULTS / "five-bar.toml").read_text(encoding="utf-8") + f"[[balance]]\n{written}\n"
    results = ran("check", "-", "--json", given=text).json["results"]
    assert {name for kind in ("balance", "balance moment") for name in results.get(kind, {})} == named


# ---- tables ----------------------------------------------------------------------------------------------------------


def yoke(load: str, *changes: tuple[str, str]) -> gp.Scene:
    """A Scotch yoke whose guided link bears a force that a table says."""
    text = (CASES / "loads" / "yoke.toml").read_text(encoding="utf-8")
    for old, new in changes:
        text = text.replace(old, new)
    return gp.parse(text + 'direction = [0, 2]\nover = "3 along frame"\n' + load, "yoke")


def test_at_a_dead_point_the_stroke_is_that_which_begins() -> None:
    """Where the slide stands still it takes the stroke into which the drive leads, by rounding or not."""
    for place, along in [("[200, 0]", 50), ("[-200, 0]", -10), ('{ from = "O", distance = 200, angle = 540 }', -10)]:
        assert yoke(ROUND, ("[120, 160]", place)).loads.forces[0].value == (0, along)


def test_what_rounding_leaves_exact_is_exact() -> None:
    """In a rounded pose a load is exact where its table is level, and known to a float's digits where it is not."""
    polar = "[120, 160]", '{ from = "O", distance = 200, angle = 50 }'
    told = "forces.1: its value in this pose"
    assert told in yoke(ROUND, polar).irrational
    level = yoke("values = [[200, 50], [-200, 50], [-200, -10], [200, -50]]\n", polar)
    assert told not in level.irrational
    assert level.loads.forces[0].value == (0, 50)


@pytest.mark.parametrize("rows", [
    "x,F\n200,50\n-200,10\n-200,-10\n200,-50\n", "# indicator\nmm;N\n200,0;50,0\n-200;10\n-200;-10\n200;-50",
    "200\t50\n\n-200\t10\n-200\t-10 # jump\n200\t-50", "200,0 50\n-200 10\n-200 -10\n200 -50\n",
])
def test_a_table_in_a_file_is_that_in_the_scene(rows: str, tmp_path: Path) -> None:
    """Two columns with a head, comments, and commas or semicolons are the rows; the scene's text has them instead."""
    text = yoke(ROUND).text.replace(ROUND, 'file = "gas.csv"  # measured\n')
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    (tmp_path / "gas.csv").write_text(rows, encoding="utf-8")
    read = gp.load(tmp_path / "scene.toml")
    assert read.loads.forces[0].value == (0, 42)
    assert "gas.csv" not in read.text
    assert gp.parse(read.text, "elsewhere").loads == read.loads == yoke(ROUND).loads


TRAVEL = [(0, 1), (90, 3), (90, -3), (360, 1)]


@pytest.mark.parametrize(("over", "rows", "more"), [
    ("travel", TRAVEL, ""), ("travel", [(60, 2), (200, 5)], ""), ("travel", [(60, 2), (200, 5)], 'beyond = "zero"'),
    ("3 along frame", [(200, 5), (-200, 1), (-200, -1), (200, -5)], ""),
    ("3 along frame", [(150, 5), (-150, 1), (-150, -1), (150, -5)], 'beyond = "zero"'),
])
@pytest.mark.parametrize("omega", [15, -15])
def test_a_table_acts_around_the_cycle(over: str, rows: list[tuple[int, int]], more: str, omega: int) -> None:
    """In each pose the balance holds the force that the table says there, straight between its rows."""
    text = (CASES / "loads" / "yoke-of-one-point.toml").read_text(encoding="utf-8").replace("15", str(omega), 1)
    written = f'direction = [1, 0]\nover = "{over}"\nvalues = {[[*row] for row in rows]}\n{more}\n'
    data = cycled(text + written, "--positions", "16", "--from", "7", "--to", "352")
    for travel, velocity, (x, _), moment in zip(data["travel"], data["velocity"]["B"], data["points"]["B"],
                                                data["balance moment"]["1"], strict=True):
        force = said(rows, travel, x, velocity[0], over, zero="zero" in more)
        assert moment == pytest.approx(-force * velocity[0] / omega / 1000, rel=1e-9, abs=1e-12), travel


def cycled(text: str, *options: str) -> Any:
    """The table of `cycle` by columns, of a scene's text."""
    done = ran("cycle", "-", *options, given=text)
    assert done.status == 0, done.err
    rows = [*csv.DictReader(io.StringIO(done.out))]
    columns: dict[str, list[float]] = {key: [float(row[key]) for row in rows] for key in rows[0] if key != "fault"}

    def pairs(name: str, unit: str, parts: str = "xy") -> list[tuple[float, float]]:
        return [*zip(*(columns[f"{name}.{part} [{unit}]"] for part in parts.split()), strict=True)]

    return {"travel": columns["travel [deg]"], "balance moment": {"1": columns["balance 1.M [N*m]"]},
            "points": {name: pairs(name, "mm", "x y") for name in "BM" if f"{name}.x [mm]" in columns},
            "velocity": {"B": pairs("B", "mm/s", "vx vy")}}


def said(rows: list[tuple[int, int]], travel: float, x: float, speed: float, over: str, *, zero: bool) -> float:
    """What a table says where the drive or the slide stands, on the stroke on which the slide moves."""
    outwards = sorted(rows[:2] if speed < 0 else rows[2:])
    at, table = (travel, rows) if over == "travel" else (x, outwards)
    if zero and not table[0][0] <= at <= table[-1][0]:
        return 0.0
    return float(np.interp(at, *zip(*table, strict=True)))


def test_flywheel_and_run_are_read() -> None:
    """What is asked of the machine over its cycle; the drive then keeps the motion where no balance is written."""
    text = (CASES / "loads" / "yoke.toml").read_text(encoding="utf-8").replace('[balance]\nlink = "1"\n', "")
    machine = gp.parse(text + "value = [1, 2]\n[flywheel]\nspeed = 15\nunevenness = 0.02\n[run]\ntravel = 720\n")
    assert (machine.flywheel.speed, machine.flywheel.unevenness, machine.run.travel) == (15, Fraction(1, 50), 720)
    assert balances(machine.loads) == [("1", "", None)]


# ---- springs ---------------------------------------------------------------------------------------------------------


def test_both_moving_ends_of_a_spring_are_pulled_alike() -> None:
    """On each of two moving links acts the opposite of what acts on the other."""
    one, two = gp.load(CASES / "springs" / "moving.toml").loads.forces
    assert {one.on, two.on} == {"2", "3"}
    assert (one.value[0] + two.value[0], one.value[1] + two.value[1]) == (0, 0)


def test_work_is_the_change_of_the_elastic_energy() -> None:
    """The balance of a spring does, over the travel, the work c (l - l_0)^2 / 2 that is stored on the way."""
    text = gp.load(CASES / "springs" / "moving.toml").replace("find.velocity", ["B", "M"]).text
    data = cycled(text, "--positions", "2001", "--from", "0", "--to", "60")
    moments, travel = np.array(data["balance moment"]["1"]), np.radians(data["travel"])
    work = float(np.sum((moments[1:] + moments[:-1]) / 2 * np.diff(travel)))
    lengths = [math.dist(data["points"]["M"][place], (80, 0)) for place in (0, -1)]
    first, last = (1.5 * (length - 40) ** 2 / 2 / 1000 for length in lengths)
    assert work == pytest.approx(last - first, rel=1e-6)
