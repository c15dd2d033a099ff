"""Reduction to the first drive: printed examples, closed forms, virtual power, and friction over the cycle."""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from face import ran

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "machine"
YOKE = gp.load(CASES / "motion" / "yoke.toml").replace("moments", [])  # at its dead point
SLEEVE = gp.load(CASES / "reduction" / "sleeve.toml")
CRANK = gp.load("ozols-5-1", by_drive=True).replace("balance", {"link": "1"}).replace("vary", {})
WHEEL = {"speed": 10, "unevenness": 0.001}


def reduced(scene: gp.Scene, positions: int = 24) -> tuple[Any, Any, dict[str, Any]]:
    """Inertia and moment of a machine that turns, at its plans, and all that is found; both opinions agree."""
    data = gp.flywheel(scene, **WHEEL, positions=positions).json()  # type: ignore[arg-type]
    assert max(data["check"][f"reduced {what}"] for what in ("inertia", "moment", "slope")) < 1e-13
    return *(np.array(data[f"reduced_{what}"])[:, 1] for what in ("inertia", "moment")), data


def within(scene: gp.Scene, travel: float, speed: float = 1) -> dict[str, Any]:
    """The motion of a machine over a travel, whose reduction both opinions agree on."""
    data = gp.motion(scene, speed=speed, travel=travel, positions=4).json()
    assert max(data["check"].values()) < 1e-10
    return data


# ---- closed forms ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("omega", [15, -15, 0])
def test_closed_forms_of_the_scotch_yoke(omega: int) -> None:
    """Ozols 13-6: I = 10 + 4 sin^2 phi and a resisting moment of 200 |sin phi|, in either sense of the drive and from
    rest; the stroke changes at the dead point alone, and the loads jump there."""
    scene = gp.load(CASES / "reduction" / "yoke.toml").replace("drive.0.omega", omega)
    inertia, moment, data = reduced(scene, 36)
    phi = np.radians(np.arange(0, 361, 10))
    assert inertia == pytest.approx(10 + 4 * np.sin(phi)**2, rel=1e-14)
    assert moment == pytest.approx(-200 * np.abs(np.sin(phi)), abs=1e-11)
    assert data["work"]["P_3"] == pytest.approx(-800, rel=1e-13)


def test_loads_over_a_slide_break_where_it_passes_the_places() -> None:
    """Of a table over a slide's position with corners and jumps the work is the area, and the energy of each plan that
    of the straight pieces between."""
    table = [[0.2, -1000], [0.5, -500], [0.6, -1000], [0.6, 1000], [0.35, 2000], [0.2, 1000]]
    scene = YOKE.replace("forces.0.values", table)
    _, moment, data = reduced(scene, 36)
    phi = np.radians(np.arange(0, 361, 10))
    place, slope = 0.4 + 0.2 * np.cos(phi), -0.2 * np.sin(phi)
    inward = np.interp(place, [0.2, 0.35, 0.6], [1000, 2000, 1000])  # from the outer dead point on
    outward = np.interp(place, [0.2, 0.5, 0.6], [-1000, -500, -1000])
    assert moment == pytest.approx(np.where(phi < math.pi, inward, outward) * slope, abs=1e-9)

    def work(knots: list[float], values: list[float]) -> Any:
        """The work of a force from the outer dead point to each place."""
        at = np.union1d(place, knots)
        force = np.interp(at, knots, values)
        total = np.append(0, np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(at)))
        return np.interp(place, at, total) - total[-1]

    there, back = work([0.2, 0.35, 0.6], [1000, 2000, 1000]), work([0.2, 0.5, 0.6], [-1000, -500, -1000])
    works = np.where(phi <= math.pi, there, there[18] + back - back[18])
    energy = np.array(data["energy"])[:, 1] - data["closing_moment"] * phi
    assert energy == pytest.approx(works, abs=1e-9)
    assert data["work"]["P_3"] == pytest.approx(-900, rel=1e-12)


def test_a_table_over_two_turns_makes_a_cycle_of_two() -> None:
    """A load over 720 degrees of travel, as in a four-stroke engine, is back after two turns, in the drive's sense."""
    load = {"on": "3", "at": "C", "direction": [1, 0], "over": "travel", "values": [[0, -1000], [360, 0], [720, -1000]]}
    _, moment, data = reduced(YOKE.replace("forces", [load]).replace("drive.0.omega", -3), 48)
    rows = dict(data["reduced_moment"])
    assert [*rows][-1] == 720
    assert [rows[90.0], rows[450.0]] == pytest.approx([0.2 * 750, 0.2 * 250])
    assert moment[-1] == pytest.approx(0, abs=1e-11)


def test_loads_over_speeds_follow_the_speed() -> None:
    """A damper's force by a slide's speed takes -100 v of the slide from the moment, at any speed of the drive."""
    damper = {"on": "3", "at": "C", "direction": [1, 0], "over": "speed of 3 along frame", "powers": [0, -100]}
    data = gp.motion(YOKE.replace("forces", [damper]), speed=7, positions=36).json()
    phi, omega = np.radians(data["travel"]), np.array(data["omega"])
    slope = 4 * np.sin(2 * phi)
    net = data["inertia"] * np.array(data["acceleration"]) + slope / 2 * omega**2
    assert net == pytest.approx(-100 * omega * (0.2 * np.sin(phi))**2, abs=1e-9)


@pytest.mark.parametrize(("masses", "value"), [((1, 0, 0, 0), 1.0), ((0, 1, 0, 0), 0.02907), ((0, 0, 1, 0), 0.1113),
                                               ((0, 0, 0, 1), 0.02241)])
def test_reduced_inertia_of_a_slider_crank(masses: tuple[int, ...], value: float) -> None:
    """Ozols 13-2 with the dimensions of 5-1: I_r = I_1 + 0.02907 m_2 + 0.1113 I_C + 0.02241 m_3."""
    scene = CRANK.replace("masses", crank_masses(*masses))
    assert within(scene, 10)["inertia"][0] == pytest.approx(value, rel=5e-4)


def crank_masses(*sizes: int) -> dict[str, Any]:
    """Inertia of the crank, mass and inertia of the rod, mass of the piston."""
    crank, rod, rod_inertia, piston = sizes
    return {"1": {"mass": 0, "inertia": crank, "centre": "O"},
            "2": {"mass": rod, "inertia": rod_inertia, "centre": "C"}, "3": {"mass": piston, "centre": "B"}}


def test_reduced_force_of_a_piston() -> None:
    """Ozols 13-3: the force at the crank pin is P v_B / v_A, 0.5988 P here; the moment is OA times as large."""
    pushed = CRANK.replace("masses", crank_masses(1, 0, 0, 0)).replace(
        "forces", [{"on": "3", "at": "B", "value": [-1000, 0]}])
    assert reduced(pushed, 12)[1][0] == pytest.approx(0.25 * 598.8, rel=5e-4)


@pytest.mark.parametrize(("angle", "force"), [(0.5, 679.38), (0.8, 535.68)])
def test_half_of_a_governor(angle: float, force: float) -> None:
    """Ozols 15-5: the arms' centrifugal forces reduce to a force on the sleeve, which slides, as the lever says."""
    scene = gp.load(CASES / "reduction" / "governor.toml").replace("forces.0.value", [
        2 * 2.29 * 25**2 * (0.02 + 0.25 * math.sin(angle)), 0])
    for point in ("A", "C"):
        scene = scene.replace(f"points.{point}.angle", math.degrees(angle) - 90)
    assert within(scene, 0.01)["moment"][0] == pytest.approx(force, abs=0.01)
    assert gp.construct(scene.replace("drive.0.speed", 0)).balances == pytest.approx([-1j * force], abs=0.01)


def test_a_mass_reduces_to_a_sliding_drive() -> None:
    """The reduced mass of a piston that drives is the crank's reduced inertia by (omega / v_B)^2."""
    scene = CRANK.replace("masses", crank_masses(2, 3, 4, 5))
    piston = scene.replace("drive", [{"slide": ["3", "frame"], "speed": 10}]).replace("balance", {
        "on": "3", "at": "B", "direction": [1, 0]})
    speed = abs(gp.construct(CRANK).velocity["B"]) / 1000 / 10
    assert within(piston, 20)["inertia"][0] == pytest.approx(reduced(scene, 12)[0][0] / speed**2, rel=1e-12)


# ---- virtual power ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["biplanetary", "five-bar", "geared-five-bar", "geneva", "racks", "roller-cam",
                                  "slotted-link", "ozols-16-1", "shaper"])
def test_any_mechanism_has_the_power_and_the_energy_of_its_links(name: str, tmp_path: Path) -> None:
    """Gears, racks, contacts, sliding pairs and drives in pace: all round the reduced moment is the power of all loads
    and the inertia twice the kinetic energy, of the velocities of `graphplan cycle`, for one of the first drive."""
    bare = gp.load(name, by_drive=True)
    links, of = [link for link in bare.moving if bare.links[link]], 0 if name == "geneva" else -1
    masses = {link: {"mass": 2, "inertia": 0.1, "centre": bare.links[link][of]} for link in links}
    forces = [{"on": link, "at": bare.links[link][0], "value": [10, -7]} for link in links]
    scene = bare.replace("masses", masses).replace("forces", forces).replace(
        "moments", [{"on": link, "value": 3} for link in bare.moving])
    inertia, moment, data = reduced(scene, 12)
    file, end = tmp_path / "cycle.json", data["reduced_moment"][-1][0]
    asked = gp.load(name).replace("find", {"velocity": "all", "omega": [*bare.moving]})
    told = ran("cycle", "-", "-q", "--positions", "13", "--from", "0", "--to", str(end), "-o", file, given=asked.toml())
    assert told.status == 0, told.err
    poses = json.loads(file.read_text())
    rate, metre = float(scene.drives[0].rate), 1000 if scene.units.length == "mm" else 1
    sense = math.copysign(1, rate)
    power, energy, still = np.zeros(13), np.zeros(13), [[0.0, 0.0]] * 13
    for link in bare.moving:
        omega = np.array(poses["omega"][link])
        power += 3 * omega
        if link in masses:
            force, centre = (np.array(poses["velocity"].get(bare.links[link][k], still)) / metre for k in (0, of))
            power += force @ [10, -7]
            energy += 2 * (centre**2).sum(1) + 0.1 * omega**2
    assert moment == pytest.approx(sense * power / rate, rel=1e-9, abs=1e-9 * np.abs(power / rate).max())
    assert inertia == pytest.approx(energy / rate**2, rel=1e-9)


@pytest.mark.parametrize("omega", [10, -10])
def test_every_command_reads_a_table_at_one_travel(omega: int) -> None:
    """At a travel of 30 degrees `solve --at`, `cycle` and `flywheel` have the load of the table's row there."""
    scene = gp.load(CASES / "reduction" / "table.toml").replace("drive.0.omega", omega)
    assert gp.solve(gp.at(scene, 30)).json()["balance"]["moment"] == pytest.approx(-30)
    header, *rows = (line.split(",") for line in ran("cycle", "-", "-q", "--positions", "12",
                                                     given=scene.toml()).out.splitlines())
    (column,) = (k for k, head in enumerate(header) if head.startswith("balance"))
    assert (float(rows[1][1]), float(rows[1][column])) == (pytest.approx(30), pytest.approx(-30))
    moments = dict(gp.flywheel(scene, positions=12).json()["reduced_moment"])
    assert moments[30.0] == pytest.approx(math.copysign(30, omega))


# ---- friction over the cycle -----------------------------------------------------------------------------------------


def rubbed(scene: gp.Scene, positions: int = 12) -> dict[str, Any]:
    """What friction takes over the cycle; both opinions agree."""
    *_, data = reduced(scene, positions)
    assert data["check"]["reduced friction"] < 1e-9
    assert sum(data["friction"]["pairs"].values()) == pytest.approx(data["friction"]["lost"], rel=1e-9)
    return data["friction"]


def posed_friction(scene: gp.Scene, travel: float) -> float:
    """The moment of friction in one pose, by the solver alone, whose reactions lean of themselves."""
    posed = gp.at(scene, travel)
    (without,), (rubbing,) = gp.analytic.power(posed), gp.analytic.with_friction(posed).balances
    return math.copysign(1, scene.drives[0].rate or 1) * float(without - rubbing)


@pytest.mark.costly
def test_kinytskyi_over_the_cycle() -> None:
    """The polygons' moment of friction is the solver's in every pose; the efficiency does not depend on the size of the
    load, and nearly vanishes in the dwell."""
    scene = gp.load("kinytskyi")
    found = rubbed(scene)
    for travel, moment in found["moment"][:12]:
        if travel not in (60, 240):  # where a link stands still, and the friction of its joints turns round
            assert moment == pytest.approx(posed_friction(scene, travel), rel=1e-9)
    for travel, moment, efficiency in ((0, 6.258, 0.887), (30, None, 0.931), (90, None, 0.91), (120, -7.496, 0.841),
                                       (240, None, 0.017)):
        data = gp.solve(gp.at(scene, travel)).json()
        without = data["without_friction"]["balance"]["moment"]
        assert moment is None or without == pytest.approx(moment, abs=5e-4)
        assert data["friction"]["efficiency"] == pytest.approx(efficiency, abs=1e-3)
    threefold = scene.replace("masses.5.mass", 36).replace("masses.5.inertia", 0.9).replace("moments.0.value", -60)
    assert [row[1] for row in rubbed(threefold)["moment"]] == pytest.approx([3 * row[1] for row in found["moment"]])


def test_losses_over_the_cycle_close_its_energy() -> None:
    """What the drive gives over a turn is what friction takes, as the moment on the rocker does no work there and back;
    the pairs' shares are all of it, each what its reaction takes in every pose."""
    scene = gp.load("kinytskyi")
    found = rubbed(scene)
    assert found["lost"] == pytest.approx(3.103830261007989, rel=1e-10)
    assert found["given"] == pytest.approx(found["lost"], rel=1e-9)
    assert found["efficiency"] == pytest.approx(0, abs=1e-9)
    assert [*found["pairs"]] == ["O 1", "A 2", "B 3", "C 3", "D 4", "E 5", "F 5"]
    mean = np.mean([row[1] for row in rubbed(scene, 120)["moment"][:120]])
    assert found["lost"] == pytest.approx(-2 * math.pi * mean, rel=1e-3)


def piston(omega: int = 10, **more: Any) -> gp.Scene:
    """The piston of Ozols 5-1, pushed by 1000 N against its guide's friction."""
    scene = CRANK.replace("drive.0.omega", omega).replace("forces", [
        {"on": "3", "at": "B", "value": [-1000, 0]}, *more.get("forces", [])])
    return scene.replace("friction", [{"slide": ["3", "frame"], "coefficient": more.get("coefficient", 0.1)}])


@pytest.mark.parametrize("omega", [10, -10, 0])
def test_a_piston_in_closed_form(omega: int) -> None:
    """A piston that is pushed against a force by a rod at the angle beta has the efficiency 1 - f |tan beta|; where the
    force drives the crank the inverse leans the other way."""
    scene = piston(omega)
    data = gp.flywheel(scene, **WHEEL, positions=36).json()  # type: ignore[arg-type]
    turn = gp.cycle.follow(scene, 36)
    rod = turn.points["B"] - turn.points["A"]
    lean = 0.1 * np.abs(rod.imag / rod.real)
    friction = np.array(data["friction"]["moment"])[:36, 1]
    plain = np.array(data["reduced_moment"])[:36, 1] - friction
    balance = np.where(-plain > 0, -plain / (1 - lean), -plain / (1 + lean))
    inside = np.abs(plain) > 1e-6
    assert (-plain - balance)[inside] == pytest.approx(friction[inside], rel=1e-8)
    found = data["friction"]
    assert found["pairs"] == {"3 along frame": pytest.approx(found["lost"], rel=1e-10)}
    assert found["lost"] > 0


def test_loads_by_tables_rub_too() -> None:
    """The moment of friction follows loads that change, jumps with them, and the pairs take all that is lost."""
    table = [[-1000, 0], [1000, 0], [1000, -500], [0, -300], [-1000, -200]]
    found = rubbed(piston(forces=[{"on": "3", "at": "B", "direction": [1, 0], "over": "3 along frame",
                                   "values": table}]))
    assert found["given"] > found["lost"] > 0


def test_a_roller_rubs_on_its_pin() -> None:
    """The pin of a roller that rolls on a cam is a journal like any other, wherever the roller touches."""
    scene = gp.load("roller-cam", by_drive=True).replace("moments", [{"on": "2", "value": 3}]).replace(
        "masses", {"2": {"mass": 3, "centre": "A"}}).replace("balance", {"link": "1"})
    assert rubbed(scene.replace("friction", [{"at": "A", "radius": 2, "coefficient": 0.1}]))["lost"] > 0


def test_friction_is_said_where_there_is_some_and_stops_what_locks() -> None:
    """A scene without friction has no losses; where it is so large that no balance keeps up the motion it is said at
    which travel."""
    assert "friction" not in reduced(gp.load("ozols-10-1"))[2]
    with pytest.raises(gp.Refused, match=r"locks itself at a travel of [\d.]+ degrees"):
        gp.flywheel(piston(coefficient=6), **WHEEL)  # type: ignore[arg-type]


@pytest.mark.parametrize("plan", ["", "lever", "polar,polygons"])
def test_inner_drives_bear_what_they_move(plan: str) -> None:
    """Of an excavator the cylinder and the motor between boom and stick do what the power of all loads says, with
    friction what the solver says, whichever plan is drawn; the motor bears its own journal alone."""
    scene = gp.load(CASES / "reduction" / "excavator.toml", by_drive=True)
    found = gp.solve(scene, **({"plan": plan} if plan else {})).json()
    for balances, (cylinder, motor) in ((found["without_friction"]["balance"], gp.analytic.power(scene)),
                                        (found["balance"], gp.analytic.with_friction(scene).balances)):
        assert balances[0]["force"] == pytest.approx(cylinder, rel=1e-12)
        assert balances[1]["moment"] == pytest.approx(motor, rel=1e-12)
    assert 0.9 < found["friction"]["efficiency"] < 1
    force = next(one["force"] for one in found["reactions"] if one["at"] == "A")
    lost = found["balance"][1]["moment"] - found["without_friction"]["balance"][1]["moment"]
    assert lost == pytest.approx(0.01 * 0.1 * math.hypot(*force), rel=1e-9)
    data = gp.motion(scene, speed=20, travel=20, positions=5).json()
    assert data["check"]["friction"] < 1e-12
    assert max(data["check"].values()) < 1e-12


# ---- slides that bear on a length ------------------------------------------------------------------------------------


@cache
def random_sleeve(seed: int) -> gp.Scene:
    """A slider-crank whose slider bears on a length, with a force beside it."""
    draw = Random(seed).uniform
    y, d, x, f, length, mu = (draw(*ends) for ends in ((-15, 15), (-40, 40), (-900, -300), (-200, 200), (25, 90),
                                                       (0.05, 0.2)))
    scene = SLEEVE.replace("points.B", [150, y]).replace("points.D", [190, d]).replace("forces.0.value", [x, f])
    return scene.replace("friction.0.length", length).replace("friction.0.coefficient", mu).replace(
        "drive.0.omega", Random(seed).choice([10, -10]))


@pytest.mark.parametrize("seed", [*range(6), "cylinder"])
def test_sleeves_over_the_cycle(seed: int | str) -> None:
    """In every pose the moment of friction is the solver's, which decides by itself which edges press."""
    scene = gp.load(CASES / "reduction" / "cylinder.toml") if seed == "cylinder" else random_sleeve(int(seed))
    moments = rubbed(scene)["moment"]
    for travel, moment in moments[1:12:2]:
        assert moment == pytest.approx(posed_friction(scene, travel), rel=1e-7)


def test_both_states_come_in_one_turn() -> None:
    """In a turn a slide is pressed at both edges, where it loses more, and at one edge, where its length does not
    matter."""
    point = SLEEVE.replace("friction.0", {"slide": ["3", "frame"], "coefficient": 0.15})
    long, short = (np.array([row[1] for row in rubbed(scene, 60)["moment"]]) for scene in (SLEEVE, point))
    same = np.isclose(long, short, rtol=1e-9)
    assert 0 < same.sum() < 60
    assert (long <= short + 1e-9).all()


@pytest.mark.parametrize("start", ["one edge", "dead centre"])
def test_the_cycle_has_what_each_pose_has(start: str) -> None:
    """Over the cycle each pose is drawn as its slide is pressed there, and rubs where it moves, though it is given as
    pressed at one edge or as standing still: its forces are those of that pose alone."""
    scene = SLEEVE
    if start == "dead centre":
        scene = scene.replace("points.A", [40, 0]).replace("friction.0", {"slide": ["3", "frame"], "coefficient": 0.15})
    told = ran("cycle", "-", "-q", "--positions", "13", given=scene.toml())
    assert told.status == 0
    header, *rows = (line.split(",") for line in told.out.splitlines())
    (column,) = (k for k, head in enumerate(header) if head.startswith("with friction"))
    for row in rows:
        (alone,) = gp.analytic.with_friction(gp.at(scene, float(row[1]))).balances
        assert float(row[column]) == pytest.approx(float(alone), rel=1e-9, abs=1e-9)
