"""Screws that move slides: moments by the inclined plane, self-locking, and losses in series."""

from __future__ import annotations

import math
from random import Random

import pytest

from graphplan.check import trusted
from graphplan.check.arithmetics import enclosures
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import SceneError
from graphplan.mechanism.checks import questions
from graphplan.mechanism.scene import parse
from graphplan.solver import with_friction

JACK = """[points]
P = [0, 0]
R = [0, 20]
[links]
1 = "P"
frame = "R"
[[slides]]
link = "1"
along = "frame"
at = "P"
direction = [0, 2]
[[drive]]
slide = ["1", "frame"]
speed = {speed}
[[forces]]
on = "1"
at = "P"
value = [0, {load}]
[[friction]]
screw = ["1", "frame"]
lead = {lead}
radius = {radius}
coefficient = 0.1
"""
RUBBING = """[[forces]]
on = "1"
at = "P"
value = [250, 0]
[[friction]]
slide = ["1", "frame"]
coefficient = 0.2
"""
LIFT = {"speed": 7, "load": -1000, "lead": 6, "radius": 14}


@pytest.mark.parametrize("speed", [7, -7, 0])
def test_the_moment_of_a_jack(speed: int) -> None:
    """M = Q r tan(alpha + phi) up, Q r tan(alpha - phi) down (Ozols 1974, (12.25), (12.26)); at rest without friction.
    """
    alpha, phi = math.atan(6 / (2 * math.pi * 14)), math.atan(0.1) * ((speed > 0) - (speed < 0))
    screw = result_data(report(parse(JACK.format(**{**LIFT, "speed": speed}), "jack")))["screws"]["1 along frame"]
    assert screw["moment"] == pytest.approx(1000 * 0.014 * math.tan(alpha + phi))
    assert screw["self_locking"]
    assert screw["efficiency"] == pytest.approx(math.tan(alpha) / math.tan(alpha + math.atan(0.1)))


def test_screws_agree_in_more_digits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Drawn and solved in enclosures of 40 digits, too, along a guide at an angle."""
    monkeypatch.setattr(trusted.Bench, "_ladder", lambda bench: [enclosures(137)])
    text = JACK.format(**LIFT).replace("[0, 2]", "33").replace("[0, -1000]", "[-300, -1000]")
    assert report(parse(text, "jack")).check["force"] < 1e-30


def test_the_best_screw() -> None:
    """With f = 0.1 the efficiency is largest, tan^2(45 - phi/2) = 0.819, at a lead angle of 42 degrees (14-3)."""
    lead = 2 * math.pi * 14 * math.tan(math.radians(45) - math.atan(0.1) / 2)
    screw = result_data(report(parse(JACK.format(**{**LIFT, "lead": lead}), "jack")))["screws"]["1 along frame"]
    assert screw["lead_angle"] == pytest.approx(42.145, abs=5e-4)
    assert screw["efficiency"] == pytest.approx(0.8190, abs=5e-5)
    assert not screw["self_locking"]


@pytest.mark.parametrize("seed", range(13))
def test_losses_in_series(seed: int) -> None:
    """A slide that rubs and is moved by a screw: the efficiency is the product, and the power of the moment what the
    load takes over that."""
    r = Random(seed)
    values = {"speed": r.choice((3, -4)), "load": r.choice((-700, 400)), "lead": r.randint(20, 60), "radius": 14}
    scene = parse(JACK.format(**values) + RUBBING, "jack")
    data = result_data(report(scene))
    screw, slope = data["screws"]["1 along frame"], values["lead"] / (2 * math.pi * 14)
    axial = -values["load"] + math.copysign(50, values["speed"])
    sense = math.copysign(1, axial * values["speed"])
    around = (slope + sense * 0.1) / (1 - sense * slope * 0.1)
    assert data["balance"]["force"] == pytest.approx([0, axial])
    assert screw["moment"] == pytest.approx(axial * 0.014 * around)
    omega = values["speed"] / values["lead"] * 2 * math.pi
    useful, given = -values["load"] * values["speed"], screw["moment"] * 1000 * omega
    share = useful / given if useful > 0 else given / useful
    assert data["friction"]["efficiency"] == pytest.approx(share)
    assert with_friction(scene).efficiency == pytest.approx(share)


def test_an_angular_thread_rubs_more() -> None:
    """Of a thread of 60 degrees f' = f / cos 30 (Ozols 1974, (12.28))."""
    screw = result_data(report(parse(JACK.format(**LIFT) + "thread = 60\n", "jack")))["screws"]["1 along frame"]
    slope, f = 6 / (2 * math.pi * 14), 0.1 / math.cos(math.radians(30))
    assert screw["moment"] == pytest.approx(14 * (slope + f) / (1 - slope * f))


def test_a_balance_from_elsewhere_does_not_turn_the_screw() -> None:
    """It is asked about, as such a record is more often a slip; a balance from the frame acts through it."""
    text = JACK.format(**LIFT)
    balance = '[balance]\non = "1"\nat = "P"\ndirection = [0, 1]\n'
    assert not list(questions(parse(text + balance, "jack")))
    (question,) = questions(parse(text.replace('slide = ["1", "frame"]', 'slide = ["1", "2"]').replace(
        'frame = "R"', '2 = "R"\nframe = "R"').replace("along = \"frame\"", 'along = "2"').replace(
        '["1", "frame"]', '["1", "2"]') + '[[drive]]\nlink = "2"\nomega = 1\n' + "[[balance]]\n" + balance[10:]
        + '[[balance]]\nlink = "2"\n', "jack"))
    assert "no balance acts through the screw of 1 along 2" in str(question)


@pytest.mark.parametrize(("old", "new", "fault"), [
    ('screw = ["1", "frame"]', 'screw = ["frame", "1"]',
     'friction.1.screw: no slide of link frame along link 1; perhaps screw = ["1", "frame"]'),
    ("lead = 6", "lead = 0", "friction.1.lead: the distance 0 is not positive; a distance above 0"),
    ("lead = 6", "lead = 6000", "friction.1.lead: the lead angle and the friction angle are 90 degrees or more: "
     "nothing drives it; a lead that is small beside the radius"),
    ("radius = 14", "radius = 14\nthread = 180",
     "friction.1.lead: the lead angle and the friction angle are 90 degrees or more: "
     "nothing drives it; a lead that is small beside the radius"),
])
def test_screws_are_read(old: str, new: str, fault: str) -> None:
    """A screw has a slide, a lead that its friction lets it drive, and perhaps an angular thread."""
    with pytest.raises(SceneError) as caught:
        parse(JACK.format(**LIFT).replace(old, new), "jack")
    assert str(caught.value) == f"jack: {fault}"
