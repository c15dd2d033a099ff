"""The rates of links and the sliding of pairs, asked for by name: of every link, drawn no more than they need."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from random import Random

import numpy as np
import pytest
from four_bars import SMALL as FOUR_BAR
from random_mechanisms import GROUPS, mechanism

import graphplan as gp
from graphplan.check.trusted import report
from graphplan.errors import SceneError, SingularPose
from graphplan.mechanism.model import Find, Scene
from graphplan.mechanism.structure import structure

CHOICES: list[dict[str, str]] = [{}, *({"method": method} for method in ("trial", "auxiliary")), {"plan": "polar"}]
RATES = "omega", "alpha", "slide velocity", "slide acceleration"

CYLINDER = """
[points]
E = [100, 0]
O = [0, 0]
A = [60, 80]
[links]
boom = "E A"
barrel = "O"
rod = "A"
frame = "O E"
[[slides]]
link = "rod"
along = "barrel"
at = "A"
direction = "O A"
[[drive]]
slide = ["rod", "barrel"]
speed = 20
acceleration = 3
"""
FAST = """
[points]
O = [86, -36]
A = [-9, 28]
X = [-8, -44]
[links]
1 = "O A"
2 = "A X"
frame = "O"
[[drive]]
link = "1"
omega = 1e7
alpha = 1
[[drive]]
link = "2"
omega = -1.3e7
alpha = 0.25
relative_to = "1"
"""
CRANK = '[points]\nO = [0, 0]\nP = [30, 40]\n[links]\n1 = "O P"\nframe = "O"\n[[drive]]\nlink = "1"\nomega = 2'
ROTOR = '[points]\nO = [0, 0]\n[links]\n1 = "O"\nframe = "O"\n[[drive]]\nlink = "1"\nomega = 10\nalpha = 2'


def rated(scene: Scene) -> Scene:
    """The scene, asking for nothing but the rates of all its links and slides."""
    return replace(scene, find=Find((), (), None, scene.moving, tuple(slide.name for slide in scene.slides)))


@pytest.mark.parametrize("choices", CHOICES, ids=str)
def test_rates_of_every_link_equal_the_solver(choices: dict[str, str]) -> None:
    """Whatever a link is made of, a single point too, its rates and every slide's are the solver's, in fractions."""
    checked = 0
    for seed in range(21):
        random = Random(seed)
        scene = rated(mechanism([random.choice(sorted(GROUPS)) for _ in range(random.randint(1, 4))], seed))
        try:
            structure(scene)
            found = report(scene, exact=True, **choices)
        except (SceneError, SingularPose):
            continue
        assert {*found.results["omega"], *found.results["alpha"]} == {*scene.moving}
        for part in RATES:
            told = found.results.get(part, {})
            assert told == {name: found.truth(part)[name] for name in told}
        checked += 1
    assert checked > 3


def test_rates_of_points_and_links_that_are_asked_for_together() -> None:
    """The question of some points changes no rate, and no other reading is added."""
    for seed in range(10):
        scene = mechanism(["rpr", "rrp"], seed)
        part = replace(scene, find=Find(scene.find.velocity[:1], (), None, scene.moving[-1:], ()))
        try:
            structure(scene)
            found, whole = report(part, exact=True), report(rated(scene), exact=True)
        except (SceneError, SingularPose):
            continue
        assert {kind: [*named] for kind, named in found.results.items()} == {
            "velocity": [*part.find.velocity], "omega": [*scene.moving[-1:]], "alpha": [*scene.moving[-1:]]}
        assert found.results["omega"].items() <= whole.results["omega"].items()


def test_blocks_turn_as_their_guides_do() -> None:
    """A cylinder and its rod of one point each: both turn alike, by what the boom's end does."""
    found = report(rated(gp.parse(CYLINDER, "cylinder")), exact=True).results
    assert found["omega"] == {"boom": Fraction(-1, 4), "barrel": Fraction(-1, 10), "rod": Fraction(-1, 10)}
    assert found["alpha"] == {"boom": Fraction(-9, 160), "barrel": Fraction(-13, 400), "rod": Fraction(-13, 400)}


def test_what_marks_say_anyway_is_not_drawn() -> None:
    """With all points asked for, the rates of all links cost no step; what drives prescribe is never drawn."""
    scene = gp.parse(FOUR_BAR, "four-bar")
    points = replace(scene.find, links=())
    assert len(gp.construct(replace(scene, find=points)).program) == len(gp.construct(scene).program)
    crank = gp.construct(replace(scene, find=Find((), (), links=("1",))))
    assert len(crank.program) == 0
    assert report(crank.scene).results == {"omega": {"1": 2.0}, "alpha": {"1": 3.0}}


def test_a_coupler_alone_needs_one_side() -> None:
    """Of a coupler with a distant point the side is read that is drawn anyway, not the longest."""
    scene = gp.parse(FOUR_BAR.replace("C = [80, 0]", "C = [80, 0]\nM = [500, 400]").replace("A B", "A B M"), "four-bar")
    drawing = gp.construct(replace(scene, find=Find((), (), links=("2",))))
    assert "M" not in {step.name for step in drawing.program.steps}


def test_what_is_given_is_printed_as_it_is_given() -> None:
    """Rates of drives, of actuators and of given motions are no differences of large numbers."""
    fast = report(gp.parse(FAST, "fast")).results
    assert fast["omega"] == {"1": 1e7, "2": -3e6}
    assert fast["alpha"] == {"1": 1.0, "2": 1.25}
    pushed = report(rated(gp.parse(CYLINDER.replace("speed = 20", "speed = 2e-9"), "cylinder"))).results
    assert pushed["slide velocity"]["rod along barrel"] == pytest.approx((1.2e-9, 1.6e-9), rel=1e-15)
    moved = gp.parse('[points]\nK = [1e9, 3]\nA = [2e9, 1]\n[links]\n1 = "K A"\n[motion.K]\nvelocity = [0.1, 0.3]\n'
                     'acceleration = [0.7, 0]\n[[drive]]\nlink = "1"\nomega = 3\n[find]\nvelocity = ["K"]\n'
                     'acceleration = ["K"]', "moved")
    assert report(moved).results == {"velocity": {"K": (0.1, 0.3)}, "acceleration": {"K": (0.7, 0.0)}}


def test_a_lone_crank_answers() -> None:
    """Of a crank its rates and its points; of a rotor of one point the rates."""
    assert report(gp.parse(CRANK, "crank"), exact=True).results == {
        "velocity": {"P": (-80, 60)}, "omega": {"1": 2}, "acceleration": {"P": (-120, -160)}, "alpha": {"1": 0}}
    assert report(gp.parse(ROTOR, "rotor"), exact=True).results == {"omega": {"1": 10}, "alpha": {"1": 2}}


def test_fixed_points_stand_still() -> None:
    """The velocity and acceleration of a point of the frame are 0, over poses zeros; those of others are not made up.
    """
    drawing = gp.construct(gp.parse(FOUR_BAR, "four-bar"))
    poses = drawing.evaluate(points={"B": np.array([70 + 40j, 60 + 45j, 75 + 38j])})
    for one, many in ((drawing.velocity, poses.velocity), (drawing.acceleration, poses.acceleration)):
        assert one["O"] == 0
        assert np.array_equal(many["C"], np.zeros(3, dtype=complex))
        with pytest.raises(KeyError):
            one["Z"]
    assert set(drawing.velocity) == {"A", "B"}


def test_rates_over_many_poses() -> None:
    """Replayed over poses, block by block or one by one, the rates are those of each pose."""
    scene = gp.load("slotted-link")
    drawing = gp.construct(rated(scene))
    pins = {name: np.array([-120 + 180j, -110 + 190j]) for name in ("A", "A3")}
    poses = drawing.evaluate(points=pins)
    for k in range(2):
        moved = {name: (float(z[k].real), float(z[k].imag)) for name, z in pins.items()}
        single = gp.construct(replace(drawing.scene, points={**scene.points, **moved}))
        alone = drawing.replay({name: complex(z[k]) for name, z in pins.items()})
        for kind, named in report(single.scene).results.items():
            for name, value in named.items():
                told = complex(*value) if isinstance(value, tuple) else value
                assert poses.results[kind][name][k] == pytest.approx(told, rel=1e-12)
                assert alone[kind][name] == pytest.approx(value, rel=1e-12)


def test_rates_between_proven_bounds() -> None:
    """In enclosures the rates of every link have their digits, and the solver agrees."""
    pytest.importorskip("flint")
    from graphplan.check.certified import certify

    found = certify(rated(gp.load("slotted-link")), 20)
    assert found.agrees
    assert set(found.data["links"]) == set(found.scene.moving)
