"""Belts that friction holds: Euler's ratio, the pull on the shafts, and equal pulleys, solved and drawn."""

from __future__ import annotations

import math
from random import Random

import pytest
from higher import two_wheels

from graphplan.check.cycle import cycle
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SceneError
from graphplan.mechanism.scene import parse
from graphplan.solver import reactions

BELT = two_wheels('radii = [{r1}, {r2}]\nbelt = "{belt}"', "{load}", "[{x}, {y}]") + """[[friction]]
belt = ["1", "2"]
coefficient = {f}
[find]
reactions = "all"
"""
OPEN = {"x": 300, "y": 0, "r1": 40, "r2": 100, "belt": "open", "load": 30, "f": 0.3}


def test_the_strands_pull_as_euler_says() -> None:
    """On the smaller pulley S_1/S_2 = e^(f alpha), and S_1 - S_2 is the moment over the radius."""
    belt = result_data(report(parse(BELT.format(**OPEN), "belt")))["belts"]["1 2"]
    assert belt["arc"] == pytest.approx(180 - 2 * math.degrees(math.asin(60 / 300)))
    assert belt["tight"] / belt["slack"] == pytest.approx(math.exp(0.3 * math.radians(belt["arc"])))
    assert belt["tight"] - belt["slack"] == pytest.approx(300)


def test_a_groove_holds_more() -> None:
    """In a groove of 38 degrees f' = f / sin 19: the slack strand needs less."""
    text = BELT.format(**OPEN).replace("coefficient = 0.3", "coefficient = 0.3\nwedge = 38")
    belt = result_data(report(parse(text, "belt")))["belts"]["1 2"]
    assert belt["ratio"] == pytest.approx(math.exp(0.3 / math.sin(math.radians(19)) * math.radians(belt["arc"])))
    assert belt["slack"] == pytest.approx(300 / (belt["ratio"] - 1))


def test_equal_pulleys_are_pulled_together() -> None:
    """Their strands are parallel: what the shafts bear is S_1 + S_2, and the belt's force is no couple alone."""
    data = result_data(report(parse(BELT.format(**{**OPEN, "r1": 80, "r2": 80}), "belt")))
    belt, shaft = data["belts"]["1 2"], next(r["force"] for r in data["reactions"] if r.get("at") == "O")
    assert belt["arc"] == 180
    assert shaft == pytest.approx([belt["tight"] + belt["slack"], 0])


@pytest.mark.parametrize("seed", range(19))
def test_strands_are_forces_at_the_rims(seed: int) -> None:
    """Each strand pulls along its own tangent: so their moments about both centres are those of balance and load."""
    r = Random(seed)
    x, y, load = r.randint(200, 400), r.randint(-200, 200), r.choice((-30, 25))
    values = {"x": x, "y": y, "r1": r.randint(20, 90), "r2": r.randint(91, 99), "belt": r.choice(("open", "crossed")),
              "load": load, "f": r.choice((0.2, 0.35))}
    if r.random() < 0.5:
        values["r1"], values["r2"] = values["r2"], values["r1"]
    data = result_data(report(parse(BELT.format(**values), "belt")))
    r1, r2, distance = values["r1"], values["r2"], math.hypot(x, y)
    line, crossed = complex(x, y) / distance, values["belt"] == "crossed"
    moments, total = [0.0, 0.0], 0j
    for side, name in ((1, "1 2 left"), (-1, "1 2 right")):
        far = -side if crossed else side
        rise = (far * r2 - side * r1) / distance
        strand = line * complex(math.sqrt(1 - rise * rise), rise)
        pull = next(complex(*entry["force"]) for entry in data["reactions"] if entry.get("strand") == name)
        assert pull / strand == pytest.approx(abs(pull))
        moments = [moments[0] - side * r1 * abs(pull), moments[1] + far * r2 * abs(pull)]
        total += pull
    assert moments == pytest.approx([-1000 * data["balance"]["moment"], -1000 * load])
    shaft = next(complex(*entry["force"]) for entry in data["reactions"] if entry.get("at") == "O")
    assert shaft == pytest.approx(total)


def test_the_pull_rubs_in_the_bearings() -> None:
    """The journals' friction has the pull of the belt: more grip, less loss, drawn and solved alike."""
    journals = "".join(f'[[friction]]\nat = "{at}"\nradius = 10\ncoefficient = 0.2\n' for at in "OC")
    efficiencies = []
    for f in (0.2, 0.4):
        text = BELT.format(**{**OPEN, "load": -30, "f": f}).replace("[find]", journals + "[find]")
        data = result_data(report(parse(text, "belt")))
        assert data["check"]["force"] < 1e-12
        efficiencies.append(data["friction"]["efficiency"])
    assert 0 < efficiencies[0] < efficiencies[1] < 1


@pytest.mark.parametrize(("belt", "r2"), [("open", 100), ("open", 40), ("crossed", 60)])
def test_belts_over_the_cycle(belt: str, r2: int) -> None:
    """In many poses at once the reactions with a belt's pull are those of the drawing."""
    found = cycle(parse(BELT.format(**OPEN | {"belt": belt, "r2": r2}), "belt"), 6)
    assert not found.faults
    assert max(found.gaps.get("force", [0])) < 1e-9


def test_without_its_record_a_belt_has_no_pull() -> None:
    """What scenes without friction of a belt said of it stands."""
    text = BELT.format(**OPEN).replace('[[friction]]\nbelt = ["1", "2"]\ncoefficient = 0.3\n', "")
    assert "belts" not in result_data(report(parse(text, "belt")))
    assert set(reactions(parse(text, "belt"), exact=True).joints.values()) == {(0, -60), (0, 60)}


@pytest.mark.parametrize(("old", "new", "fault"), [
    ('belt = ["1", "2"]', 'belt = ["1", "frame"]',
     'friction.1.belt: no other belt with radii between links 1 and frame; belt = ["1", "2"]'),
    ("radii", "teeth", "friction.1.belt: no other belt with radii between links 1 and 2; one in [[gears]]"),
    ("coefficient = 0.3", "coefficient = 0", "friction.1.coefficient: a belt without friction passes on nothing; a "
     "number above 0, such as 0.3"),
    ("[find]", '[[friction]]\nbelt = ["2", "1"]\ncoefficient = 0.2\n[find]',
     "friction.2.belt: no other belt with radii between links 2 and 1; one in [[gears]]"),
])
def test_friction_of_belts_is_read(old: str, new: str, fault: str) -> None:
    """One record for a belt with radii, and a coefficient that is more than nothing."""
    with pytest.raises(SceneError) as caught:
        parse(BELT.format(**OPEN).replace(old, new), "belt")
    assert str(caught.value) == f"belt: {fault}"
