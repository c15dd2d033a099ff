"""The reactions against what does not depend on them: each link's equilibrium added up anew, and the power equation."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import pytest
from added_up import left_over, loaded, numbers
from by_hand import force, hold, loads, mass, mechanism, moment, push, slide, turn
from random_mechanisms import GROUPS
from random_mechanisms import mechanism as grown

from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.model import Balance, Force, Loads, Mass, Moment, Pair, Scene, Units
from graphplan.mechanism.scene import parse
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.solver import power, reactions

both = pytest.mark.parametrize("exact", [False, True])
opinions = pytest.mark.parametrize("opinion", [reactions, power])


def random_scene(seed: int) -> Scene:
    """A random mechanism of up to four groups, loaded."""
    random = Random(seed)
    return loaded(grown(random.choices(list(GROUPS), k=random.randint(0, 4)), seed), random)


@pytest.mark.parametrize("seed", range(60))
def test_random_mechanisms(seed: int) -> None:
    """In fractions every link is in equilibrium and the power equation agrees; floats differ by rounding."""
    scene = random_scene(seed)
    try:
        exact = reactions(scene, exact=True)
    except SingularPose:
        with pytest.raises(SingularPose):
            reactions(scene)
        return
    assert {left_over(exact, link) for link in scene.moving} == {(0, 0, 0)}
    assert power(scene, exact=True) == exact.balances
    rough = reactions(scene)
    assert {type(value) for value in numbers(exact)} == {Fraction}
    assert {type(value) for value in numbers(rough)} == {float}
    close = 1e-9 * max(1.0, *(abs(float(value)) for value in numbers(exact)))
    assert list(numbers(rough)) == pytest.approx(list(numbers(exact)), abs=close)
    assert power(scene) == pytest.approx(exact.balances, abs=close)


HANGING = mechanism(
    {"O": (0, 0), "S": (0, -70)},
    {"1": "O S", "frame": "O"},
    [turn("1", 0)],
    loads=loads(masses={"1": mass(2, 3, "S")}, gravity=(0, "-9.81"), balances=[hold("1")]),
)


@both
def test_a_hanging_weight(exact: bool) -> None:
    """A weight that hangs from the frame pulls it downwards and needs no moment."""
    found = reactions(HANGING, exact)
    assert found.joints == {("O", "frame"): pytest.approx((0, -19.62))}
    assert found.balances == power(HANGING, exact) == (0,)


def test_a_turning_arm() -> None:
    """Lengths in mm, masses in kg and forces in N: m (a_S - g) in the bearing, I alpha and the weight in the moment."""
    given = loads(masses={"1": mass(2, 3, "S")}, gravity=(0, -10), balances=[hold("1")])
    arm = mechanism({"O": (0, 0), "S": (300, 400)}, {"frame": "O", "1": "O S"}, [turn("1", 10, 2)], loads=given)
    found = reactions(arm, exact=True)
    a_S = -10 * 10 * Fraction("0.3") - 2 * Fraction("0.4"), -10 * 10 * Fraction("0.4") + 2 * Fraction("0.3")
    assert found.joints == {("O", "1"): (2 * a_S[0], 2 * (a_S[1] + 10))}
    assert found.balances == (2 * (3 + 2 * Fraction("0.25")) + 2 * 10 * Fraction("0.3"),)


def in_pounds(scene: Scene) -> Scene:
    """A scene of mm, kg and N in inches, pounds and pounds of force."""
    inch, pound, pound_force = METRES["in"] / METRES["mm"], KILOGRAMS["lb"], NEWTONS["lbf"]

    def shorter(vector: Pair) -> Pair:
        return vector[0] / inch, vector[1] / inch

    given = scene.loads
    return replace(
        scene,
        units=Units("in", "lbf", "lb"),
        points={p: shorter(at) for p, at in scene.points.items()},
        loads=Loads(
            given.gravity,
            {k: Mass(body.mass / pound, body.inertia / pound, body.centre) for k, body in given.masses.items()},
            tuple(Force(f.on, f.at, (f.value[0] / pound_force, f.value[1] / pound_force)) for f in given.forces),
            tuple(Moment(m.on, m.value / pound_force) for m in given.moments),
            given.balances,
        ),
    )


def test_units_change_numbers_only() -> None:
    """The same machine in inches and pounds has the same forces to the last digit, and the same condition."""
    scene = replace(loaded(grown(["rrr", "sliding_triad", "rpr"], 3), Random(3)), units=Units())
    newtons, pounds = reactions(scene, exact=True), reactions(in_pounds(scene), exact=True)
    assert [value * NEWTONS["lbf"] for value in numbers(pounds)] == list(numbers(newtons))
    assert pounds.condition == pytest.approx(newtons.condition, rel=1e-9)


SLIDER_CRANK = {"1": "O A", "2": "A B", "3": "B", "frame": "O"}


def slider_crank(*given: Force | Moment, balance: Balance, omega: int = 5) -> Scene:
    """A slider-crank with a crank of 5 cm, massive links, and one balance."""
    masses = {"1": mass(3, "0.01", "O"), "2": mass(2, "0.05", "A"), "3": mass(1, 0, "B")}
    return mechanism(
        {"O": (0, 0), "A": (3, 4), "B": (6, 0)},
        SLIDER_CRANK,
        [turn("1", omega)],
        [slide("3", "frame", "B", (7, 0))],
        loads=loads(*given, masses=masses, gravity=(0, "-9.81"), balances=[balance]),
        units=Units(length="cm"),
    )


@both
@pytest.mark.parametrize("direction", [(1, 0), (-20, 0), (3, 4)])
def test_balance_as_a_force_on_the_slider(direction: tuple[int, int], exact: bool) -> None:
    """The force that balances at the slider works as much as the moment that balances at the crank."""
    given = force("3", "B", (-100, 30))
    scene = slider_crank(given, balance=hold("3", "B", direction))
    found = reactions(scene, exact)
    (held,), (at_crank,) = found.balances, reactions(slider_crank(given, balance=hold("1"))).balances
    assert held == pytest.approx(power(scene, exact)[0])
    assert held[0] * direction[1] == pytest.approx(held[1] * direction[0])
    assert held[0] * found.rates.velocity["B"][0] / 100 == pytest.approx(at_crank * 5)


@both
def test_at_rest(exact: bool) -> None:
    """A mechanism at rest needs a moment for its weights, and the power equation finds it by a virtual motion."""
    scene = slider_crank(balance=hold("1"), omega=0)
    crank_pin = (Fraction(-4, 100), Fraction(3, 100))  # its velocity, in m/s, at 1 rad/s
    (held,) = reactions(scene, exact).balances
    assert held == pytest.approx(2 * 9.81 * float(crank_pin[1]))
    assert power(scene, exact) == pytest.approx((held,))


@both
def test_a_joint_of_three_links(exact: bool) -> None:
    """Two bars carry a weight at their common joint: each other link has its force with the one named first."""
    points = {"A": (0, 0), "B": (8, 0), "C": (4, 3), "S": (4, -5)}
    links = {"1": "A C", "2": "B C", "3": "C S", "frame": "A B"}
    given = loads(force("3", "S", (0, -60)), balances=[hold("3")])
    found = reactions(mechanism(points, links, [turn("3", 0)], loads=given), exact)
    assert found.joints == {
        ("A", "frame"): pytest.approx((-40, -30)),
        ("B", "frame"): pytest.approx((40, -30)),
        ("C", "2"): pytest.approx((40, -30)),
        ("C", "3"): pytest.approx((0, 60)),
    }


def two_drives(*balances: Balance) -> Scene:
    """A chain of four links on the frame with a crank at one end and an actuator at the other."""
    points = {"O": (0, 0), "A": (1, 3), "B": (4, 5), "C": (9, 2), "E": (4, 6)}
    return mechanism(
        points,
        {"1": "O A", "2": "A B E", "3": "B C", "4": "C", "frame": "O"},
        [turn("1", 2, 1), push("4", "frame", -3)],
        [slide("4", "frame", "C", (3, 4))],
        loads=loads(
            force("2", "E", (10, 20)), moment("3", 4),
            masses={"3": mass(1, 2, "B"), "4": mass(2, 0, "C")}, gravity=(1, -9), balances=balances,
        ),
        units=Units(length="m"),
    )  # fmt: skip


@pytest.mark.parametrize(
    "balances", [(hold("1"), hold("4", "C", (3, 4))), (hold("4", "C", (0, -2)), hold("1")), (hold("2"), hold("3"))]
)
def test_a_balance_for_each_of_several_drives(balances: tuple[Balance, ...]) -> None:
    """With two drives there are two balances, where and in what order the scene has them."""
    scene = two_drives(*balances)
    found = reactions(scene, exact=True)
    assert {left_over(found, link) for link in scene.moving} == {(0, 0, 0)}
    assert power(scene, exact=True) == found.balances
    for value, rough in zip(found.balances, power(scene), strict=True):
        assert rough == pytest.approx(value, rel=1e-12)


def test_an_actuator_of_its_own() -> None:
    """A drive between two moving links needs a balance that works with it, here a force at the rod's end."""
    points = {"A": (4, 0), "C": (0, 0), "B": (0, 3), "E": (1, 6)}
    links = {"1": "C B E", "2": "A", "3": "B", "frame": "A C"}
    given = loads(force("1", "E", (0, -50)), balances=[hold("3", "B", (-4, 3))])
    scene = mechanism(points, links, [push("3", "2", 2)], [slide("3", "2", "B", (-4, 3))], loads=given)
    found = reactions(scene, exact=True)
    assert {left_over(found, link) for link in scene.moving} == {(0, 0, 0)}
    assert found.balances == power(scene, exact=True) != ((0, 0),)


@both
@opinions
def test_a_balance_that_does_no_work(opinion: Callable[..., Any], exact: bool) -> None:
    """At the dead centre a force on the piston cannot hold crank and coupler, and both are named."""
    points = {"O": (0, 0), "A": (1, 0), "B": (4, 0)}
    given = loads(force("2", "A", (0, -1)), balances=[hold("3", "B", (1, 0))])
    guides = [slide("3", "frame", "B", (1, 0))]
    scene = mechanism(points, SLIDER_CRANK, [turn("1", 1)], guides, loads=given)
    with pytest.raises(SingularPose, match="the balance cannot hold the motion in this pose") as caught:
        opinion(scene, exact)
    assert caught.value.links == ("1", "2")


@both
@opinions
def test_balances_that_hold_the_same(opinion: Callable[..., Any], exact: bool) -> None:
    """Two balances on one link, where two drives move two, leave the rest of the chain unheld."""
    balances = hold("1"), hold("1", "A", (-3, 1))
    with pytest.raises(SingularPose, match="the balances cannot hold the motion") as caught:
        opinion(two_drives(*balances), exact)
    assert caught.value.links == ("2", "3", "4")


@both
@opinions
def test_no_forces_where_there_is_no_motion(opinion: Callable[..., Any], exact: bool) -> None:
    """A pose in which the drive does not determine the motion has no inertia forces, so it has no reactions."""
    points = {"O": (0, 0), "A": (1, 0), "B": (4, 0), "C": (4, 3)}
    links = {"1": "O A", "2": "A B", "3": "C B", "frame": "O C"}
    scene = mechanism(points, links, [turn("3", 0)], loads=loads(balances=[hold("1")]))
    with pytest.raises(SingularPose, match="the drive does not determine the motion"):
        opinion(scene, exact)


@both
def test_statically_indeterminate(exact: bool) -> None:
    """A third parallel crank moves as the others do, but how it shares their load cannot be told."""
    points = {"O": (0, 0), "C": (40, 0), "E": (20, 0), "A": (7, 11), "B": (47, 11), "D": (27, 11)}
    links = {"1": "O A", "2": "A B D", "3": "C B", "4": "E D", "frame": "O C E"}
    scene = mechanism(points, links, [turn("1", 3)], loads=loads(balances=[hold("1")]))
    with pytest.raises(SingularPose, match="statically indeterminate") as caught:
        reactions(scene, exact)
    assert caught.value.links == ("1", "2", "3", "4")


@both
@opinions
def test_more_balances_than_drives(opinion: Callable[..., Any], exact: bool) -> None:
    """Two balances for one drive share its work in ways that cannot be told."""
    given = loads(balances=[hold("1"), hold("1", "S", (1, 0))])
    with pytest.raises(SingularPose, match="statically indeterminate") as caught:
        opinion(replace(HANGING, loads=given), exact)
    assert caught.value.links == ("1",)


@opinions
def test_a_scene_without_loads(opinion: Callable[..., Any]) -> None:
    """Where a scene has no loads its reactions are refused."""
    with pytest.raises(Refused, match="no loads"):
        opinion(replace(HANGING, loads=None))


@opinions
def test_rounded_loads_are_refused_exactly(opinion: Callable[..., Any]) -> None:
    """Exact numbers are refused where a load is a float or the scene is irrational; floats are not."""
    rounded = replace(HANGING, loads=replace(HANGING.loads, gravity=(0.0, -9.81)))
    for scene in rounded, replace(HANGING, irrational=("balance.direction: angle",)):
        with pytest.raises(Refused, match="exact numbers"):
            opinion(scene, exact=True)
        opinion(scene)


PRESS = """
title = "Press"
gravity = [0, -9.81]
[points]
O = [0, 0]
A = [30, 40]
B = [60, 0]
S = [45, 20]
[links]
1 = "O A"
2 = "A S B"
3 = "B"
frame = "O"
[[slides]]
link = "3"
along = "frame"
at = "B"
direction = [1, 0]
[[drive]]
link = "1"
omega = 10
[masses.2]
mass = 4
inertia = 0.001
centre = "S"
[[forces]]
on = "3"
at = "B"
value = [-500, 0]
[balance]
link = "1"
"""


def test_a_scene_from_its_text() -> None:
    """The loads of a scene file are those of the reactions."""
    found = reactions(parse(PRESS, "press"), exact=True)
    assert {left_over(found, link) for link in "123"} == {(0, 0, 0)}
    assert set(found.joints) == {("O", "frame"), ("A", "2"), ("B", "3")}
    assert set(found.slides) == {"3 along frame"}
    assert found.balances == power(parse(PRESS, "press"), exact=True)


def test_forty_links_exactly() -> None:
    """The reactions of some forty links with decimal coordinates balance in fractions."""
    scene = loaded(grown(["rrr", "rrr", "rrr", "triad"] * 4, 1), Random(1))
    scene = replace(scene, points={p: (x + x * x / 1009, y + x / 997) for p, (x, y) in scene.points.items()})
    found = reactions(scene, exact=True)
    assert {left_over(found, link) for link in scene.moving} == {(0, 0, 0)}


def test_exact_path_does_without_numpy() -> None:
    """Reactions and powers in fractions do not import numpy."""
    code = """
import sys
sys.path[:0] = sys.argv[1:]
from by_hand import force, hold, loads, mechanism, turn
from graphplan.solver import power, reactions
given = loads(force("1", "A", (3, 4)), balances=[hold("1")])
arm = mechanism({"O": (0, 0), "A": (1, 2)}, {"1": "O A", "frame": "O"}, [turn("1", 1)], loads=given)
assert reactions(arm, exact=True).balances == power(arm, exact=True)
assert "numpy" not in sys.modules
"""
    here = Path(__file__).parent
    subprocess.run([sys.executable, "-c", code, str(here), str(here.parents[1])], check=True)
