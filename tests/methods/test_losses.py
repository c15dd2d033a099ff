"""Losses beyond journals, slides and contacts, in the solver and drawn: values by hand and the balance of powers."""

from __future__ import annotations

import math
from fractions import Fraction
from importlib import resources

import pytest
from higher import two_wheels

from graphplan.check import trusted
from graphplan.check.arithmetics import enclosures
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SceneError
from graphplan.mechanism.scene import parse
from graphplan.solver import with_friction

SLEDGE = """title = "A sledge"
[points]
P = [0, 0]
R = [20, 0]
[links]
1 = "P"
frame = "R"
[[slides]]
link = "1"
along = "frame"
at = "P"
direction = [1, 0]
[[drive]]
slide = ["1", "frame"]
speed = 7
[[forces]]
on = "1"
at = "P"
value = [-300, -1000]
[balance]
on = "1"
at = "P"
direction = [1, 0]
[[friction]]
slide = ["1", "frame"]
coefficient = 0.1
"""


def test_a_wedge_rubs_more() -> None:
    """In a V of 40 degrees f' = 0.1 / sin 20: a load of 1000 takes 292.38 beside the useful 300."""
    scene, rubbed = parse(SLEDGE + "wedge = 40\n", "sledge"), 1000 * 0.1 / math.sin(math.radians(20))
    data = result_data(report(scene))
    assert with_friction(scene).balances == (pytest.approx((300 + rubbed, 0)),)
    assert data["balance"]["force"] == pytest.approx([300 + rubbed, 0])
    assert data["friction"]["efficiency"] == pytest.approx(300 / (300 + rubbed))


def test_a_wedge_of_60_degrees_is_rational() -> None:
    """Its f' is twice f, in fractions; that of 40 degrees is none, and is said to be irrational."""
    (balance,) = with_friction(parse(SLEDGE + "wedge = 60\n", "sledge"), exact=True).balances
    assert balance == (Fraction(500), 0)
    assert parse(SLEDGE + "wedge = 40\n", "sledge").irrational == ("friction.1.wedge: the sine of half the angle",)


def test_a_flat_wedge_is_a_slide() -> None:
    """A V of 180 degrees rubs as a slide does."""
    flat, plain = (with_friction(parse(SLEDGE + more, "sledge"), exact=True) for more in ("wedge = 180\n", ""))
    assert flat.balances == plain.balances == ((400, 0),)


@pytest.mark.parametrize("degrees", ["0", "-40", "181"])
def test_a_wedge_has_an_angle(degrees: str) -> None:
    """No V has an angle of nothing or beyond a straight one."""
    with pytest.raises(SceneError, match=rf"friction.1.wedge: a wedge of {degrees} degrees; an angle above 0"):
        parse(SLEDGE + f"wedge = {degrees}\n", "sledge")


SPUR = two_wheels("radii = [40, 60]", "{}") + '[[friction]]\ngear = ["1", "2"]\nefficiency = 0.9\n'


@pytest.mark.parametrize(("load", "balance"), [(27, 20), (-30, -18)])
def test_teeth_pass_on_their_efficiency(load: int, balance: int) -> None:
    """Against a load of 27, the first wheel gives 27 / (1.5 * 0.9); driven by 30, it holds back 30 / 1.5 * 0.9."""
    scene = parse(SPUR.format(load), "spur")
    data = result_data(report(scene))
    assert with_friction(scene).balances == (pytest.approx(balance),)
    assert data["balance"]["moment"] == pytest.approx(balance)
    assert data["friction"]["efficiency"] == pytest.approx(0.9)


@pytest.mark.parametrize("centre", ["[120, 30]", "[90, -17]", '{ from = "O", distance = 111, angle = 33 }'])
@pytest.mark.parametrize("digits", [0, 40])
def test_losses_agree_in_every_arithmetic(centre: str, digits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Centres at an irrational distance, pressed aside: M_1 = M_2 z_1/z_2 / 0.9 in floats and in more digits."""
    if digits:
        monkeypatch.setattr(trusted.Bench, "_ladder", lambda bench: [enclosures(digits * 10 // 3 + 4)])
    text = SPUR.format(27).replace("[60, 80]", centre).replace("radii = [40, 60]", "teeth = [20, 41]")
    assert float(report(parse(text, "spur")).results["balance moment with friction"]["1"]) == pytest.approx(
        27 * 20 / 41 / 0.9)


def david(driven: str, balance: str) -> str:
    """David's planetary gear with a load on one end and the balance on the other."""
    text = resources.files("graphplan").joinpath("scenes/david.toml").read_text(encoding="utf-8")
    return text + f'''
[[moments]]
on = "{driven}"
value = -20
[balance]
link = "{balance}"
[[friction]]
gear = ["1", "2"]
efficiency = 0.98
'''


def test_the_efficiency_of_a_planetary_gear() -> None:
    """1/eta = 1 - (1 - i) eta_H over i for i = 1/10000, eta_H = 0.98: 0.005 as printed (Ozols, example 14-3)."""
    ratio, teeth = 1 / 10000, 0.98
    data = result_data(report(parse(david("1", "H"), "david")))
    inverse = (1 - (1 - ratio) * teeth) / ratio
    assert data["friction"]["efficiency"] == pytest.approx(1 / inverse, rel=1e-9)
    assert data["friction"]["efficiency"] == pytest.approx(0.0049756, abs=5e-8)


def test_a_planetary_gear_that_locks_itself() -> None:
    """Driven from the slow wheel it does not move: the carrier would have to be driven, too (Ozols, (14.27))."""
    forces = report(parse(david("H", "1"), "david")).forces
    assert forces is not None
    assert forces.locks.startswith("self-locking")


@pytest.mark.parametrize(("old", "new", "fault"), [
    ("0.9", "1.1", "friction.1.efficiency: an efficiency of 1.1; a number above 0 and up to 1, such as 0.98"),
    ("0.9", "0", "friction.1.efficiency: an efficiency of 0; a number above 0 and up to 1, such as 0.98"),
    ('gear = ["1", "2"]', 'gear = ["1", "frame"]',
     'friction.1.gear: no teeth between links 1 and frame; gear = ["1", "2"]'),
    ("radii = [40, 60]", "radii = [19, 20]\nbelt = \"open\"",
     r"friction.1.gear: no teeth between links 1 and 2; [[gears]] with it"),
    ("radii = [40, 60]", "radii = [900, 1000]\ninternal = true",
     "friction.1.efficiency: no force between a ring and a wheel nearly as large passes on 0.9; an efficiency above "
     "0.9, the ratio of their sizes"),
])
def test_losses_of_teeth_are_read(old: str, new: str, fault: str) -> None:
    """One clear line a fault: a share that is none, links without teeth, a ring in which no force can lose so much."""
    with pytest.raises(SceneError) as caught:
        parse(SPUR.format(27).replace(old, new), "spur")
    assert str(caught.value) == f"spur: {fault}"


WHEEL = """[points]
O = [0, 100]
K = [0, 0]
[links]
1 = "O"
frame = "K"
[[contacts]]
links = ["1", "frame"]
at = "K"
centres = ["O", [1, 0]]
rolling = true
[[forces]]
on = "1"
at = "O"
value = [0, -1000]
[[drive]]
link = "1"
omega = {}
[balance]
at = "O"
on = "1"
direction = [1, 0]
[[friction]]
contact = ["1", "frame"]
rolling = 0.5
"""


@pytest.mark.parametrize(("omega", "force"), [(-2, 5), (2, -5), (0, 0)])
def test_a_wheel_that_rolls_takes_k_n_over_r(omega: int, force: int) -> None:
    """P = k N / r in the sense of its motion, drawn and solved, in fractions too (Ozols 1974, (12.7))."""
    scene = parse(WHEEL.format(omega), "wheel")
    for exact in (False, True):
        data = result_data(report(scene, exact=exact))
        assert [float(component) for component in data["balance"]["force"]] == [force, 0]
    assert with_friction(scene, exact=True).balances == ((force, 0),)


def test_a_wheel_that_rolls_on_an_arc() -> None:
    """On a fixed wheel, too, it takes k N / r: the normal is the line of centres."""
    text = WHEEL.format(-2).replace('["O", [1, 0]]', '["O", "C"]').replace('frame = "K"', 'frame = "C"')
    scene = parse(text.replace("K = [0, 0]", "K = [0, 0]\nC = [0, -300]"), "wheels")
    assert result_data(report(scene))["balance"]["force"] == [pytest.approx(5), 0]
    assert with_friction(scene).balances == ((pytest.approx(5), 0),)


@pytest.mark.parametrize(("old", "new", "fault"), [
    ("rolling = 0.5", "coefficient = 0.1",
     "friction.1.contact: the contact 1 frame rolls: nothing slides in it; rolling = 0.5, the arm of the resistance"),
    ("rolling = true", "rolling = false",
     "friction.1.contact: the contact 1 frame slides: it does not roll; coefficient = 0.1"),
    ("rolling = 0.5", "rolling = -1", "friction.1.rolling: the rolling -1 is negative; a number of 0 or more"),
])
def test_resistance_to_rolling_is_read(old: str, new: str, fault: str) -> None:
    """What slides has a coefficient, and what rolls an arm."""
    with pytest.raises(SceneError) as caught:
        parse(WHEEL.format(-2).replace(old, new), "wheel")
    assert fault in str(caught.value)
