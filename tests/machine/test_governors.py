"""Governors: closed forms, random ones against potential energy, sheets that are executed, and faults."""

from __future__ import annotations

import math
import random
from pathlib import Path
from typing import Any

import pytest

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "machine" / "governor"
PENDULUM, ROD = gp.load(CASES / "pendulum.toml"), gp.load(CASES / "rod.toml")
RUBBING = ROD.replace("gravity", [0, -9.81]).replace("friction", [{"slide": ["1", "frame"], "coefficient": 0.1}])


def behind(scene: gp.Scene, place: float) -> gp.Scene:
    """The ball on its rod with the spring's end at another place of the rod."""
    moved = scene.replace("points.P", [place, 0])
    return moved.replace("springs", [{"ends": ["P", "B"], "on": ["frame", "1"], "stiffness": 2, "free": 0}])


def random_governor(seed: int) -> dict[str, Any]:
    """An arm with a ball, hinged off the axis, that moves a sleeve by a link; every other one is bent as an elbow. With
    a spring on the sleeve, and weights."""
    draw = random.Random(seed).uniform
    arm, link, off, angle = draw(100, 200), draw(180, 260), draw(-15, 30), draw(-70, -45)
    ball, bend = arm * draw(1.0, 1.8), draw(-8, 25) if seed % 2 else 0.0
    A, B = ([off + r * math.cos(math.radians(a)), r * math.sin(math.radians(a))]
            for r, a in ((arm, angle), (ball, angle + bend)))
    D = [0, A[1] - math.sqrt(link**2 - A[0] ** 2)]
    return {
        "gravity": [0, -9.81],
        "points": {"O": [off, 0], "Z": [0, 0], "U": [0, -500], "A": A, "B": B, "D": D},
        "links": {"1": "O A B", "2": "A D", "3": "D", "frame": "O Z U"},
        "slides": [{"link": "3", "along": "frame", "at": "D", "direction": [0, -1]}],
        "drive": [{"link": "1", "omega": 1}],
        "masses": {"1": {"mass": draw(0.5, 3), "centre": "B"}, "2": {"mass": draw(0, 0.5), "centre": "A"},
                   "3": {"mass": draw(0.1, 6), "centre": "D"}},
        "springs": [{"ends": ["Z", "D"], "on": ["frame", "3"], "stiffness": draw(0.1, 2),
                     "free": draw(1.0, 1.3) * -D[1]}],
        "governor": {"balls": ["1"], "axis": ["Z", "U"], "between": [-3, 12]},
    }


def whole_governor(half: dict[str, Any]) -> dict[str, Any]:
    """The governor with the same arm on the other side, too, and a sleeve and a spring twice as heavy and stiff."""
    points, masses, (spring,) = half["points"], half["masses"], half["springs"]
    mirrored = {f"{name}'": [-points[name][0], points[name][1]] for name in "OAB"}
    return half | {
        "points": points | mirrored,
        "links": half["links"] | {"4": "O' A' B'", "5": "A' D", "frame": "O O' Z U"},
        "masses": masses | {"3": masses["3"] | {"mass": 2 * masses["3"]["mass"]}, "4": masses["1"] | {"centre": "B'"},
                            "5": masses["2"] | {"centre": "A'"}},
        "springs": [spring | {"stiffness": 2 * spring["stiffness"]}],
        "governor": half["governor"] | {"balls": ["1", "4"]},
    }


def test_conical_pendulum() -> None:
    """A conical pendulum has omega² = g/h, h being the height of the cone, and is stable; drawn it is the same."""
    data = gp.balance(PENDULUM).json()
    heights = [math.sqrt(0.2**2 - (r / 1000) ** 2) for r in data["r"]]
    assert data["omega"] == pytest.approx([math.sqrt(9.81 / h) for h in heights], rel=1e-12)
    assert data["C"] == pytest.approx([2 * 9.81 * r / 1000 / h for r, h in zip(data["r"], heights, strict=True)])
    assert data["drawn"]["omega"] == pytest.approx(data["omega"], rel=1e-12)
    assert (data["stable"], data["isochronous"]) == (True, False)
    low, high = data["omega"][0], data["omega"][-1]
    assert data["irregularity"] == pytest.approx(2 * (high - low) / (high + low), rel=1e-12)


def test_given_speed_finds_its_position() -> None:
    """The spindle's speed holds the pendulum where h = g/omega²; by more positions the drawing is nearer to it."""
    (place,) = (data := gp.balance(PENDULUM.replace("governor.rpm", 90), positions=31).json())["equilibria"]
    r = math.sqrt(200**2 - (9810 / (math.pi * 3) ** 2) ** 2)
    assert place["r"] == pytest.approx(r, rel=1e-9)
    assert place["stable"]
    assert data["drawn"]["r"] == pytest.approx([r], rel=1e-3)
    beyond = gp.balance(PENDULUM.replace("governor.rpm", 300))
    assert beyond.json()["equilibria"] == []
    assert "in no position" in beyond._repr_svg_()


def test_unstable_stretch() -> None:
    """A spring that is free inside the range makes C/r fall where C = c (r + a) with a > 0: unstable all the way."""
    data = gp.balance(behind(ROD, -20)).json()
    assert (data["unstable"], data["stable"]) == ([[-10.0, 30.0]], False)
    assert not data["equilibria"][0]["stable"]
    assert data["C"] == pytest.approx([2 * (r + 20) for r in data["r"]], rel=1e-12)


def test_edge_of_stability() -> None:
    """With springs to points beside and behind the axis C/r = c (1 - l/s) + c' (1 + a/r), s² = r² + b², is least where
    (r/s)³ = c' a/(c l): inside the governor is unstable, outside it is stable."""
    springs = [{"ends": [end, "B"], "on": ["frame", "1"], "stiffness": stiffness, "free": free}
               for end, stiffness, free in (("Q", 2, 30), ("P", 1.4, 0))]
    ((low, high),) = gp.balance(ROD.replace("springs", springs)).json()["unstable"]
    k = (1.4 * 20 / (2 * 30)) ** (1 / 3)
    assert (low, high) == (-10, pytest.approx(40 * k / math.sqrt(1 - k * k) - 50, abs=1e-4))


@pytest.mark.parametrize("seed", range(5))
def test_random_governors(seed: int) -> None:
    """Of random governors the characteristic agrees with the potential energy, and with the drawing."""
    data = gp.balance(gp.scene(random_governor(seed))).json()
    assert {*data["check"]} == {"motion", "lever", "energy"}
    assert data["check"]["energy"] < 1e-9
    assert data["drawn"]["omega"] == pytest.approx(data["omega"], rel=1e-12)
    for place in data["equilibria"]:
        assert place["omega"] == pytest.approx(data["speed"], rel=1e-9)


def test_shift_of_the_whole_changes_nothing() -> None:
    """A governor whose axis is turned with gravity has the same characteristic, and so has its mirror image."""
    turned = PENDULUM.replace("gravity", [9.81, 0]).replace("points", {"O": [7, 3], "Z": [107, 3], "B": [167, 123]})
    mirrored = PENDULUM.replace("points.B", [-120, -160]).replace("drive.0.omega", -1)
    first = gp.balance(PENDULUM).json()
    for other in (turned, mirrored):
        assert gp.balance(other).json()["C"] == pytest.approx(first["C"], rel=1e-12)


def test_both_arms() -> None:
    """With both arms the force on the balls is twice that of one side, at the same speeds, with friction, too."""
    half = random_governor(0)
    rubbing = [[{"at": f"{joint}{prime}", "radius": 10, "coefficient": 0.1} for joint in "OA" for prime in primes]
               for primes in (("",), ("", "'"))]
    one, both = (gp.balance(gp.scene(tables | {"friction": friction})).json()
                 for tables, friction in zip((half, whole_governor(half)), rubbing, strict=True))
    for force in ("C", "C_out", "C_in"):
        assert both[force] == pytest.approx([2 * C for C in one[force]], rel=1e-9)
    assert both["omega"] == pytest.approx(one["omega"], rel=1e-12)


def test_the_sheet_ends_in_the_position() -> None:
    """The last step of a governor's sheet marks the position of equilibrium."""
    data = gp.balance(PENDULUM).json(steps=True)
    assert data["protocol"]["steps"][-1]["makes"].startswith("R_")


def rubbing_governor(seed: int) -> dict[str, Any]:
    """A random governor whose joints and sleeve rub."""
    draw = random.Random(seed + 100).uniform
    joints = [{"at": at, "radius": draw(5, 15), "coefficient": draw(0.02, 0.2)} for at in "OAD"]
    sleeve: dict[str, Any] = {"slide": ["3", "frame"], "coefficient": draw(0.02, 0.2)}
    return random_governor(seed) | {"friction": [*joints, sleeve]}


def test_friction_of_a_rod() -> None:
    """A ball that its weight presses on a rod across the spindle moves out at C + mu G, in at C - mu G."""
    data, weight = gp.balance(RUBBING).json(), 0.1 * 2 * 9.81
    assert data["C_out"] == pytest.approx([C + weight for C in data["C"]], rel=1e-9)
    assert data["C_in"] == pytest.approx([C - weight for C in data["C"]], rel=1e-9)
    (start, end), = data["held"]
    assert (start["r"], end["r"]) == (40, 80)  # isochronous: friction holds it anywhere about its one speed
    assert "Insensitivity" in gp.balance(RUBBING)._repr_svg_()


def test_where_friction_holds_it() -> None:
    """A spring before it is stretched, C = c (r - a): mu G lets the speed hold it from (c a -+ mu G)/(c - m omega²)."""
    data = gp.balance(behind(RUBBING, 20), positions=21).json()
    (start, end), = data["held"]
    stiffness, weight = 2 - 2 * data["speed"] ** 2 / 1000, 0.1 * 2 * 9.81
    ends = [(2 * 20 - weight) / stiffness, (2 * 20 + weight) / stiffness]
    assert [start["r"], end["r"]] == pytest.approx(ends, rel=1e-9)
    assert data["drawn"]["held"] == pytest.approx(ends, rel=1e-9)  # the characteristics are straight
    middle = data["drawn"]["position"] - 1
    assert data["drawn"]["omega_out_in"] == pytest.approx([data["omega_out"][middle], data["omega_in"][middle]])


@pytest.mark.parametrize("seed", range(3))
def test_random_governors_with_friction(seed: int) -> None:
    """With friction the solver's leaning reactions leave the drive nothing to do, at C'' outwards and at C' inwards;
    they are on either side of C, whichever way the drive moves."""
    tables = rubbing_governor(seed)
    data = gp.balance(gp.scene(tables)).json()
    assert data["check"]["friction"] < 1e-9
    for out, plain, inn in zip(data["omega_out"], data["omega"], data["omega_in"], strict=True):
        assert out > plain > inn
    low, high = tables["governor"]["between"]
    other = gp.balance(gp.scene(tables | {"drive": [{"link": "1", "omega": -1}], "governor": tables["governor"] | {
        "between": [-high, -low]}})).json()
    assert other["C_out"] == pytest.approx(data["C_out"], rel=1e-7)
    assert other["C_in"] == pytest.approx(data["C_in"], rel=1e-7)


def test_insensitivity_adds_to_irregularity() -> None:
    """Small friction adds its degree of insensitivity to that of irregularity, (15.35)."""
    tables = rubbing_governor(1)
    tables["friction"] = [{**row, "coefficient": row["coefficient"] / 100} for row in tables["friction"]]
    data = gp.balance(gp.scene(tables)).json()
    ends = [nu * omega / data["speeds"]["mean"] for nu, omega in zip(data["insensitivity"], data["omega"], strict=True)]
    added = data["irregularity_with_friction"] - data["irregularity"]
    assert added == pytest.approx((ends[0] + ends[-1]) / 2, rel=0.01)  # to their first order, half at either end


def test_sleeve_that_bears_on_a_length() -> None:
    """A sleeve whose weight is beside its column is pressed at both edges: friction holds it over more speeds."""
    tables = rubbing_governor(2)
    *joints, sleeve = tables["friction"]
    x, y = tables["points"]["D"]
    tables |= {"points": tables["points"] | {"S": [x + 60, y]}, "links": tables["links"] | {"3": "D S"},
               "masses": tables["masses"] | {"3": {"mass": 8, "centre": "S"}}}
    point, long = (gp.balance(gp.scene(tables | {"friction": [*joints, row]})).json()
                   for row in (sleeve, sleeve | {"length": 30}))
    assert long["check"]["friction"] < 1e-9
    assert all(wide > narrow for wide, narrow in zip(long["insensitivity"], point["insensitivity"], strict=True))
