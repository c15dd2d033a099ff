"""Friction against closed formulas, the equilibrium of each link, and what it takes from the power of the balances."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest
from added_up import left_over, loaded, numbers
from by_hand import force, hold, journal, loads, mechanism, push, rough, slide, turn
from random_mechanisms import GROUPS
from random_mechanisms import mechanism as grown

from graphplan.errors import SingularPose
from graphplan.mechanism.model import Friction, Scene, Units
from graphplan.solver import Frictional, reactions, with_friction

FRICTION = 0.13
ANGLE = math.atan(FRICTION)


def lever(omega: int) -> Scene:
    """A lever of 200 mm with a weight of 50 N, in a journal of 10 mm."""
    given = loads(force("1", "S", (0, -50)), balances=[hold("1")], frictions=[journal("O", 10, "0.2")])
    points = {"O": (0, 0), "S": (200, 30)}
    return mechanism(points, {"frame": "O", "1": "O S"}, [turn("1", omega)], loads=given)


@pytest.mark.parametrize(("omega", "couple"), [(3, -0.1), (-3, 0.1), (0, 0.0)])
def test_a_journal(omega: int, couple: float) -> None:
    """Friction in a journal is a couple coefficient * radius * force against the turning; at rest there is none."""
    found = with_friction(lever(omega))
    assert found.joints == {("O", "1"): pytest.approx((0, 50))}
    assert found.couples == {("O", "1"): pytest.approx(couple)}
    assert found.balances == pytest.approx((10 - couple,))


def test_efficiency_of_a_journal() -> None:
    """Lifting, the moment gives more than the weight takes; lowering, it holds back less; at rest nothing is said."""
    assert with_friction(lever(3)).efficiency == pytest.approx(10 / 10.1)
    assert with_friction(lever(-3)).efficiency == pytest.approx(9.9 / 10)
    assert with_friction(lever(0)).efficiency is None


def test_efficiency_of_an_idle_run() -> None:
    """Where the balance has nothing to do but to overcome friction the efficiency is 0, rounding or not."""
    for above in 200, 200 + 1e-13:
        points = {"O": (200, 0), "S": (above, 300)}
        assert with_friction(replace(lever(3), points=mechanism(points, {}).points)).efficiency == 0


def test_efficiency_of_several_balances() -> None:
    """A moment and a force that drive together count with the sum of their powers."""
    given = loads(
        force("1", "S", (0, -50)), force("2", "P", (-40, -100)),
        balances=[hold("1"), hold("2", "P", (1, 0))], frictions=[journal("O", 10, "0.2"), rough("2", "frame", "0.1")],
    )  # fmt: skip
    points = {"O": (0, 0), "S": (200, 30), "P": (500, 0)}
    drives = [turn("1", 3), push("2", "frame", 700)]
    guides = [slide("2", "frame", "P", (1, 0))]
    scene = mechanism(points, {"frame": "O", "1": "O S", "2": "P"}, drives, guides, loads=given)
    assert with_friction(scene).efficiency == pytest.approx((10 * 3 + 40 * 0.7) / (10.1 * 3 + 50 * 0.7))


def incline(slope: float, pull: float, speed: int) -> Scene:
    """A load of 1000 on an incline, pulled at an angle to it, both in degrees."""
    along, pulled = (math.radians(angle) for angle in (slope, slope + pull))
    return mechanism(
        {"P": (0, 0), "R": (7, 7)},
        {"1": "P", "frame": "R"},
        [push("1", "frame", speed)],
        [slide("1", "frame", "P", (3 * math.cos(along), 3 * math.sin(along)))],
        loads=loads(
            force("1", "P", (0, -1000)),
            balances=[hold("1", "P", (math.cos(pulled), math.sin(pulled)))],
            frictions=[rough("1", "frame", FRICTION)],
        ),
    )


@pytest.mark.parametrize(
    ("slope", "pull", "speed", "printed"),
    [(15, 10, 1, 381.573), (15, 10, -1, 138.479), (0, math.degrees(ANGLE), 1, 128.915)],
)
def test_an_incline(slope: float, pull: float, speed: int, printed: float) -> None:
    """The pull up, what holds back on the way down, and the least pull on the level are those of Ozols, 12-3."""
    found = with_friction(incline(slope, pull, speed))
    assert math.hypot(*found.balances[0]) == pytest.approx(printed, abs=0.0005)


def test_friction_is_within_the_force_of_the_slide() -> None:
    """The force of a slide leans by the friction angle against the motion, and `drags` is its part along the guide."""
    found = with_friction(incline(0, 20, 1))
    (along, across), _ = found.slides["1 along frame"]
    assert found.drags == {"1 along frame": pytest.approx((along, 0))}
    assert along == pytest.approx(-FRICTION * across)


def test_efficiency_of_an_incline() -> None:
    """Upwards the efficiency is tan a / tan(a + phi), downwards tan(a - phi) / tan a, for a pull along the level."""
    up, down = (with_friction(incline(15, -15, speed)).efficiency for speed in (1, -1))
    a = math.radians(15)
    assert up == pytest.approx(math.tan(a) / math.tan(a + ANGLE))
    assert down == pytest.approx(math.tan(a - ANGLE) / math.tan(a))


def test_an_incline_that_locks_itself_downwards() -> None:
    """On a slope below the friction angle the load does not go down alone: it is pushed, the efficiency negative."""
    assert with_friction(incline(5, 0, -1)).efficiency == pytest.approx(
        math.sin(math.radians(5) - ANGLE) / math.sin(math.radians(5)) / math.cos(ANGLE)
    )


def test_self_locking() -> None:
    """A push into the incline steeper than the friction cone moves nothing, however strong: that is refused."""
    edge = math.degrees(ANGLE) - 90
    assert math.hypot(*with_friction(incline(15, edge + 0.1, 1)).balances[0]) > 1e5
    with pytest.raises(SingularPose, match="self-locking") as caught:
        with_friction(incline(15, edge - 0.1, 1))
    assert caught.value.links == ("1",)


def test_self_locking_to_the_last_digit() -> None:
    """A push just along the edge of the friction cone is refused as well."""
    given = loads(
        force("1", "P", (-10, 0)), balances=[hold("1", "P", (1, -1))], frictions=[rough("1", "frame", 1)]
    )  # fmt: skip
    guides = [slide("1", "frame", "P", (1, 0))]
    scene = mechanism({"P": (0, 0)}, {"1": "P", "frame": ""}, [push("1", "frame", 1)], guides, loads=given)
    with pytest.raises(SingularPose, match="self-locking"):
        with_friction(scene)


def test_no_friction_is_no_change() -> None:
    """Without frictions, or with coefficients of 0, everything is as without friction, and the efficiency is 1."""
    scene = loaded(grown(["rrr", "rpr", "triad"], 2), Random(2))
    for smooth in scene, replace(scene, loads=replace(scene.loads, frictions=tuple(everywhere(scene, Fraction(0))))):
        found = with_friction(smooth)
        assert list(numbers(found)) == pytest.approx(list(numbers(reactions(scene))), rel=1e-9)
        assert found.efficiency == pytest.approx(1)


def test_pairs_that_do_not_move_do_not_rub() -> None:
    """In a wedge drive nothing turns, whatever rounding says, so a journal in it has no friction."""
    points = {"A": (0.1, 0.3), "B": (5.7, 0.3), "C": (5.7, 9.1), "D": (5.7, 9.1)}
    links = {"frame": "", "1": "A", "2": "B C", "3": "C D"}
    guides = [slide("1", "frame", "A", (1, 0)), slide("2", "frame", "B", (0, 1)), slide("3", "1", "D", (-0.3, 0.7))]
    given = loads(force("2", "C", (-20, -100)), balances=[hold("1", "A", (1, 0))], frictions=[journal("C", 0.5, 0.2)])
    found = with_friction(mechanism(points, links, [push("1", "frame", 1.1)], guides, loads=given))
    assert found.couples == {("C", "3"): 0}
    assert found.efficiency == pytest.approx(1)


def everywhere(scene: Scene, coefficient: Fraction) -> Iterator[Friction]:
    """Friction in every joint and slide, the journals of different sizes."""
    for k, point in enumerate(scene.joints):
        yield journal(point, 1 + k % 3, coefficient)
    for each in scene.slides:
        yield rough(each.link, each.along, coefficient)


def losses(found: Frictional) -> Iterator[float]:
    """The power of the friction in each pair, in W."""
    scene, omega = found.equations.scene, {**found.rates.omega, "frame": 0.0}
    for (point, link), couple in found.couples.items():
        yield couple * (omega[link] - omega[scene.links_of[point][0]])
    for name, drag in found.drags.items():
        slip = found.rates.slide_velocity[name]
        yield (drag[0] * slip[0] + drag[1] * slip[1]) / 1000


def sizes(found: Frictional) -> Iterator[tuple[float, float]]:
    """For each pair that rubs how large its friction is and should be: coefficient * force, for a journal * radius."""
    frictions = found.equations.scene.loads.frictions
    arms = {f.at: f.coefficient * f.radius / 1000 for f in frictions}
    coefficients = {" along ".join(f.slide): f.coefficient for f in frictions if f.slide}
    for (point, link), couple in found.couples.items():
        if couple:
            yield abs(couple), arms[point] * math.hypot(*found.joints[point, link])
    for name, drag in found.drags.items():
        if drag != (0, 0):
            yield math.hypot(*drag), coefficients[name] * math.dist(found.slides[name][0], drag)


@pytest.mark.parametrize("seed", range(40))
def test_random_mechanisms(seed: int) -> None:
    """With friction every link is in equilibrium, each friction has its size, and the balance makes up for the loss."""
    random = Random(seed)
    scene = replace(loaded(grown(random.choices(list(GROUPS), k=random.randint(1, 3)), seed), random), units=Units())
    try:
        plain = reactions(scene)
    except SingularPose:
        with pytest.raises(SingularPose):
            with_friction(scene)
        return
    rubbed = replace(scene, loads=replace(scene.loads, frictions=tuple(everywhere(scene, Fraction(1, 8)))))
    try:
        found = with_friction(rubbed)
    except SingularPose as error:
        assert "self-locking" in str(error)
        return
    close = 1e-10 * found.condition * max(abs(float(value)) for value in numbers(found))
    for link in scene.moving:
        assert left_over(found, link) == pytest.approx((0, 0, 0), abs=close)
    for size, expected in sizes(found):
        assert size == pytest.approx(expected, abs=close)
    assert max(losses(found), default=0) <= 0
    gained = (found.balances[0] - plain.balances[0]) * found.rates.omega["1"]
    assert gained == pytest.approx(-sum(losses(found)), abs=close)


def test_a_slide_whose_normal_force_changes_sides() -> None:
    """Dry friction in two slides presses one of them to the other side of its guide, and the equilibrium is found."""
    scene = mechanism(
        {"O": (0, 0), "A": (31, -20), "B": (11, -48)},
        {"frame": "O", "1": "O A", "2": "A", "3": "B"},
        [turn("1", 1)],
        [slide("2", "3", "A", (9, 1)), slide("3", "frame", "B", (1, 9))],
        loads=loads(
            force("3", "B", (-8, 10)),
            balances=[hold("1")],
            frictions=[rough("2", "3", "0.9"), rough("3", "frame", "0.9")],
        ),
    )
    found, smooth = with_friction(scene), reactions(scene)
    normal = found.slides["3 along frame"][0][0] - found.drags["3 along frame"][0]
    assert smooth.slides["3 along frame"][0][0] > 0 > normal
    for link in scene.moving:
        assert left_over(found, link) == pytest.approx((0, 0, 0), abs=1e-12)
    for size, expected in sizes(found):
        assert size == pytest.approx(expected, rel=1e-13)
    assert sorted(losses(found))[1] < 0


def test_a_joint_of_three_links() -> None:
    """In a joint of several links each of them rubs on the one that carries the pin."""
    points = {"O": (0, 0), "A": (30, 40), "B": (90, 30), "C": (80, -10), "D": (20, 90), "E": (-40, 60)}
    links = {"frame": "O C E", "1": "O A", "2": "A B", "3": "B C", "4": "A D", "5": "D E"}
    given = loads(
        force("3", "B", (-9, 2)), force("5", "D", (4, -7)), balances=[hold("1")], frictions=[journal("A", 5, "0.3")]
    )
    found = with_friction(mechanism(points, links, [turn("1", 2)], loads=given))
    omega = found.rates.omega
    for link in "24":
        couple = 5e-3 * 0.3 * math.hypot(*found.joints["A", link])
        assert found.couples["A", link] == pytest.approx(math.copysign(couple, omega["1"] - omega[link]))
    for link in links.keys() - {"frame"}:
        assert left_over(found, link) == pytest.approx((0, 0, 0), abs=1e-12)
