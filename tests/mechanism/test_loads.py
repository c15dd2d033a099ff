"""Loads: what is read from their tables, exactly, and what their units are."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from scene_texts import ACTUATOR, FIVE_BAR, LOADED, OPEN, PRESS, changed

from graphplan.mechanism.model import Balance, Force, Friction, Loads, Mass, Moment, Units
from graphplan.mechanism.scene import parse
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS, inertia, metre, weight


def loads(text: str) -> Loads:
    """The loads of a scene that has some."""
    found = parse(text, "loaded").loads
    assert found is not None
    return found


def test_loads_are_read() -> None:
    """Masses, forces, moments, balance and friction come out as written, in order, as fractions."""
    assert loads(LOADED) == Loads(
        gravity=(Fraction(0), Fraction(-981, 100)),
        masses={
            "2": Mass(Fraction(5, 2), Fraction(1, 100), "M"),
            "3": Mass(Fraction(4), Fraction(0), "B"),
        },
        forces=(Force("3", "B", (Fraction(-150), Fraction(1, 2))),),
        moments=(Moment("2", Fraction(3, 10)),),
        balances=(Balance("1"),),
        frictions=(
            Friction("A", None, Fraction(5), Fraction(1, 10)),
            Friction("", ("3", "frame"), Fraction(0), Fraction(2, 25)),
        ),
    )


def test_loads_leave_the_mechanism_alone() -> None:
    """Apart from loads and the question, a loaded scene is the scene without them, and as rational."""
    loaded, bare = parse(LOADED, "x"), parse(PRESS, "x")
    assert (loaded.points, loaded.links, loaded.slides) == (bare.points, bare.links, bare.slides)
    assert (loaded.drives, loaded.irrational) == (bare.drives, ())


def test_a_scene_without_loads_has_none() -> None:
    """Gravity alone loads nothing: without masses, forces, moments, balance and friction there are no loads."""
    for text in (PRESS, OPEN, ACTUATOR, "gravity = [0, -9.81]\n" + PRESS):
        assert parse(text, "x").loads is None


def test_gravity_is_none_unless_written() -> None:
    """Masses weigh nothing where the scene has no gravity."""
    assert loads(changed(LOADED, ("gravity = [0, -9.81]\n", ""))).gravity == (0, 0)


def test_each_table_alone_is_enough() -> None:
    """A balance by itself asks for forces; what the other tables would say is empty."""
    assert loads(PRESS + '[balance]\nlink = "1"') == Loads((Fraction(0), Fraction(0)), {}, (), (), (Balance("1"),))


def test_several_loads_of_one_link() -> None:
    """Forces and moments on the same link stand side by side, in the scene's order; none replaces another."""
    more = '[[forces]]\non = "2"\nat = "M"\nvalue = [1, 2]\n[[forces]]\non = "2"\nat = "M"\nvalue = [1, 2]\n'
    found = loads(LOADED + more + '[[moments]]\non = "1"\nvalue = -7\n[[moments]]\non = "2"\nvalue = 0')
    assert [(force.on, force.at) for force in found.forces] == [("3", "B"), ("2", "M"), ("2", "M")]
    assert found.moments == (Moment("2", Fraction(3, 10)), Moment("1", Fraction(-7)), Moment("2", Fraction(0)))


def test_a_mass_of_nothing() -> None:
    """A mass may be zero: a link with inertia alone, such as a flywheel on its axis."""
    text = changed(LOADED, ("[masses.3]", '[masses.1]\nmass = 0\ninertia = 2\ncentre = "O"\n[masses.3]'))
    assert loads(text).masses["1"] == Mass(Fraction(0), Fraction(2), "O")


def test_a_balancing_force_and_its_direction() -> None:
    """A balancing force has a point and a direction: a vector, an angle, or two points, of any length."""
    for written, direction in [
        ("[0, 2.5]", (Fraction(0), Fraction(5, 2))),
        ("-90", (Fraction(0), Fraction(-1))),
        ("135", (Fraction(-1), Fraction(1))),
        ('"O A"', (Fraction(30), Fraction(40))),
        ('"A O"', (Fraction(-30), Fraction(-40))),
    ]:
        balance = f'[balance]\nat = "A"\non = "1"\ndirection = {written}'
        scene = parse(changed(LOADED, ('[balance]\nlink = "1"', balance)), "x")
        assert scene.loads is not None
        assert scene.loads.balances == (Balance("1", "A", direction),), written
        assert scene.irrational == (), written


def test_a_balancing_force_at_an_irrational_angle() -> None:
    """An angle that fractions cannot hold gives a direction in floats, and the scene says where."""
    text = changed(LOADED, ('[balance]\nlink = "1"', '[balance]\nat = "A"\non = "1"\ndirection = 30'))
    scene = parse(text, "x")
    assert scene.loads is not None
    assert scene.loads.balances[0].direction == pytest.approx((math.sqrt(0.75), 0.5), rel=1e-15)
    assert scene.irrational == ("balance.direction: angle",)


def test_a_balance_for_each_drive() -> None:
    """Several balances are an array of tables, moments and forces as one likes; one may also stand alone in it."""
    force = '[[balance]]\nat = "B"\non = "4"\ndirection = [1, 0]\n'
    found = loads(FIVE_BAR + '[[balance]]\nlink = "1"\n' + force)
    assert found.balances == (Balance("1"), Balance("4", "B", (Fraction(1), Fraction(0))))
    assert loads(changed(LOADED, ("[balance]", "[[balance]]"))).balances == (Balance("1"),)


def test_a_balance_need_not_be_where_the_drive_is() -> None:
    """Any link that moves with the drive can be balanced: the coupler, or the piston by a force."""
    for balance, read in [
        ('[balance]\nlink = "2"', Balance("2")),
        ('[balance]\nat = "B"\non = "3"\ndirection = [1, 0]', Balance("3", "B", (Fraction(1), Fraction(0)))),
    ]:
        assert loads(changed(LOADED, ('[balance]\nlink = "1"', balance))).balances == (read,)


REACTIONS: list[tuple[str, tuple[str, ...] | None]] = [
    ('reactions = ["A", "3 along frame"]', ("A", "3 along frame")),
    ('reactions = ["B", "O", "B"]', ("B", "O")),
    ("reactions = []", ()),
    ('reactions = "all"', None),
    ("", None),
]


def test_reactions_asked_for() -> None:
    """Joints and slides by name, each once, in the order of asking; "all", or nothing said, is every one."""
    for written, asked in REACTIONS:
        find = parse(changed(LOADED, ('reactions = ["A", "3 along frame"]', written)), "x").find
        assert (find.velocity, find.reactions) == (("B",), asked), written
    assert parse(PRESS, "x").find.reactions is None
    assert parse(PRESS + "[find]\nreactions = []", "x").find.reactions == ()


DEFINED: list[tuple[dict[str, Fraction], dict[str, str]]] = [
    (METRES, {"mm": "0.001", "cm": "0.01", "m": "1", "in": "0.0254", "ft": "0.3048"}),
    (KILOGRAMS, {"kg": "1", "g": "0.001", "t": "1000", "lb": "0.45359237"}),
    (NEWTONS, {"N": "1", "kN": "1000", "kgf": "9.80665", "lbf": "4.4482216152605"}),
]


def test_units_are_what_they_are_defined_to_be() -> None:
    """Inch, foot and pound are exact by definition, and a kilogram-force is 9.80665 N."""
    for table, decimals in DEFINED:
        assert table == {unit: Fraction(factor) for unit, factor in decimals.items()}


def test_every_unit_of_a_scene_has_its_factor() -> None:
    """Whatever units a scene may name, their factors are known; those left out are mm, N and kg."""
    for table, key in ((METRES, "length"), (NEWTONS, "force"), (KILOGRAMS, "mass")):
        for unit in table:
            assert getattr(parse(f'units = {{ {key} = "{unit}" }}\n{PRESS}', "x").units, key) == unit
    assert parse(LOADED, "x").units == Units("mm", "N", "kg")


FACTORS: list[tuple[Units, str, str, str]] = [
    (Units(), "1000", "1", "1/1000"),  # 1 kg at 1 mm/s^2: a thousandth of a newton
    (Units("m"), "1", "1", "1"),
    (Units("m", "kN", "t"), "1", "1", "1"),
    (Units("cm", "kN", "g"), "100", "1/1000000", "1/100000000"),
    (Units("m", "kgf", "kg"), "1", "1/9.80665", "1/9.80665"),
    (Units("ft", "lbf", "lb"), "1/0.3048", "1/9.80665", "0.3048/9.80665"),
    (Units("in", "N", "lb"), "1/0.0254", "0.45359237", "0.011521246198"),
]


def quotient(text: str) -> Fraction:
    """A fraction of decimals."""
    over, _, under = text.partition("/")
    return Fraction(over) / Fraction(under or 1)


def test_factors_between_units() -> None:
    """A metre in lengths, what 1 m/s^2 and what one length per s^2 asks of a unit of mass: exact in every unit."""
    for units, one_metre, at_one_metre, at_one_length in FACTORS:
        found = (metre(units), weight(units), inertia(units))
        assert found == (quotient(one_metre), quotient(at_one_metre), quotient(at_one_length)), units


def test_a_kilogram_weighs_a_kilogram_force() -> None:
    """At standard gravity a kilogram presses with 1 kgf, a pound with 1 lbf, a tonne with 9.80665 kN."""
    standard = Fraction("9.80665")
    assert weight(Units("m", "kgf", "kg")) * standard == 1
    assert weight(Units("ft", "lbf", "lb")) * standard == 1
    assert weight(Units("mm", "kN", "t")) * standard == standard
