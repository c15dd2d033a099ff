"""Decimal commas and units inside numbers are recognised, wherever a scene has a number, and the right is told."""

from __future__ import annotations

import pytest
from each import each
from four_bars import four_bar

from graphplan.errors import SceneError
from graphplan.mechanism.scene import parse

SCENE = four_bar(
    "omega = 2", head="gravity = [0, -9.81]\n", A='{ from = "O", distance = 50, angle = 20 }',
    B='{ distances = { A = 120, C = 80 }, side = "left" }', more="""[masses.2]
mass = 10
centre = "B"
[[forces]]
on = "3"
at = "B"
value = [-150, 0]
[balance]
at = "A"
on = "1"
direction = 30
""")
PLACES = {  # a number as it stands, and where its faults are told
    "distance = 50": "points.A.distance", "angle = 20": "points.A.angle", "A = 120": "points.B.distances.A",
    "omega = 2": "drive.1.omega", "mass = 10": "masses.2.mass", "direction = 30": "balance.direction",
    "C = [150": "points.C", "value = [-150": "forces.1.value",
}
SLIPS = {  # what is written in the place of a number, what is told of it, and what is right
    "12,5": ("a decimal comma", "12.5"),
    "250 mm": ("a unit in it", '250, with length = "mm" in [units]'),
    "0.25m": ("a unit in it", '0.25, with length = "m" in [units]'),
    "-12,5 kN": ("a decimal comma and a unit in it", '-12.5, with force = "kN" in [units]'),
    "3 kg": ("a unit in it", '3, with mass = "kg" in [units]'),
    "10 mm/s^2": ("a unit in it", '10, with length = "mm" in [units]'),
    "95 rpm": ("a unit in it", "rpm = 95 in the place of omega"),
    "20°": ("a unit in it", "20, as angles are in degrees"),
    "20 deg": ("a unit in it", "20, as angles are in degrees"),
    "0.35 rad": ("a unit in it", "the angle in degrees"),
    "2 rad/s": ("a unit in it", "2 alone"),
}


def told(text: str) -> list[str]:
    """The faults of a scene."""
    with pytest.raises(SceneError) as error:
        parse(text, "scene")
    return list(error.value.lines)


def test_the_scene_is_sound() -> None:
    """Without a slip there is no fault."""
    parse(SCENE, "scene")


@each("place", PLACES)
@each("slip", SLIPS)
def test_slips_in_quotes(slip: str, place: str) -> None:
    """A number in quotes with a comma or a unit is told where it stands, with what to write."""
    what, right = SLIPS[slip]
    key = place.split(" =")[0]
    before, number = place.rsplit("[" if "[" in place else " ", 1)
    written = place.removesuffix(number) + f'"{slip}"'
    assert before
    (line,) = told(SCENE.replace(place, written))
    assert line.startswith(f'scene: {PLACES[place]}: "{slip}" has {what}; {right}'), key


@each("place", PLACES)
@each("slip", SLIPS)
def test_slips_without_quotes(slip: str, place: str) -> None:
    """The same without quotes is no TOML, and told with its line."""
    if "[" in place and slip == "12,5":
        return  # [12,5, 0] is three numbers
    what, right = SLIPS[slip]
    number = place.rsplit("[" if "[" in place else " ", 1)[1]
    (line,) = told(SCENE.replace(place, place.removesuffix(number) + slip))
    number = 1 + SCENE[: SCENE.index(place)].count("\n")
    assert line.startswith(f"scene: line {number}, column ")
    assert line.endswith(f': "{slip}" has {what}; {right}')


def test_a_slip_that_the_key_forgives() -> None:
    """At rpm and at gravity the unit is the one that is meant."""
    (line,) = told(SCENE.replace("omega = 2", 'rpm = "95 rpm"'))
    assert line == 'scene: drive.1.rpm: "95 rpm" has a unit in it; 95 alone'
    (line,) = told(SCENE.replace("[0, -9.81]", '[0, "-9,81 m/s^2"]'))
    assert line == 'scene: gravity: "-9,81 m/s^2" has a decimal comma and a unit in it; -9.81 alone'


@each("vector", ["[12,5, 30]", "[12, 30,5]", "[12,5, 30,5]"])
def test_commas_in_vectors(vector: str) -> None:
    """Three or four numbers where two are wanted may be two with decimal commas."""
    _, line = told(SCENE.replace("C = [150, 0]", f"C = {vector}"))
    right = vector.replace(",5", ".5")
    assert line == f"scene: line 6: {vector} has a decimal comma; {right}"
    assert told(SCENE.replace("C = [150, 0]", "C = [150, 0, 1]"))[1:] == []


@each("text", ["high", "2.5", "12 apples", "1,2,3", "", "mm", "12.5.6"])
def test_other_texts_are_no_slips(text: str) -> None:
    """What is not a number at all is told as before."""
    (line,) = told(SCENE.replace("omega = 2", f'omega = "{text}"'))
    assert line == f'scene: drive.1.omega: the string "{text}" where a number is wanted; a number such as 12.5'
