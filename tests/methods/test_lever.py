"""Zhukovsky's lever: balances without reactions, at rest too, and single reactions by freeing their pairs."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from random_loads import loaded
from random_mechanisms import GROUPS, mechanism

from graphplan.check.trusted import report
from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.model import Balance, Find, Scene, TurningDrive
from graphplan.mechanism.scene import load, parse
from graphplan.mechanism.structure import bracing
from graphplan.methods.construct import construct
from graphplan.methods.motion.proportion import assumed_tempo
from graphplan.methods.panels import INERTIA

SOME = st.lists(st.sampled_from(sorted(GROUPS)), min_size=1, max_size=2)


def sound(names: list[str], seed: int) -> Scene:
    """A random loaded mechanism whose links are held just once."""
    scene = mechanism(names, seed)
    assume(bracing(scene).sound)
    return loaded(scene, seed)


@settings(max_examples=7, deadline=None)
@given(SOME, st.integers(0, 10**6))
def test_lever_at_rest(names: list[str], seed: int) -> None:
    """A mechanism at rest has a lever, too: its velocities are assumed, of any size."""
    scene = sound(names, seed)
    drive = scene.drives[0]
    assert isinstance(drive, TurningDrive)
    try:
        found = report(scene.with_drives([replace(drive, rate=Fraction(0))]), exact=True)
    except SingularPose:
        assume(False)
        raise
    assert found.check["force"] == 0
    assert found.results["lever moment"] == found.results["balance moment"]


@settings(max_examples=7, deadline=None)
@given(SOME, st.integers(0, 10**6))
def test_single_reaction_by_a_freed_pair(names: list[str], seed: int) -> None:
    """One reaction is found without any other: its pair is freed, and two levers give its components."""
    scene = sound(names, seed)
    joint = scene.joints[seed % len(scene.joints)]
    try:
        found = report(replace(scene, find=Find((), (), (joint,))), exact=True, plan="lever")
    except SingularPose:
        assume(False)
        raise
    assert found.check["force"] == 0
    assert found.results["reaction"]
    assert not [step for step in found.drawing.program.steps if step.panel.startswith("force plan")]


def test_lever_of_two_drives() -> None:
    """A mechanism of two drives has a lever for each balance, the other one held."""
    scene = load("five-bar")
    drives = scene.drives
    assert len(drives) == 2
    balances = tuple(Balance(drive.link) for drive in drives)
    found = report(replace(loaded(scene, 5), loads=replace(loaded(scene, 5).loads, balances=balances)), exact=True)  # type: ignore[type-var]
    assert found.check["force"] == 0
    assert len(found.results["lever moment"]) == 2


def test_any_force_is_held_by_a_support() -> None:
    """With two drives the lever serves a balancing force at any point: what does no work is a support."""
    scene = load("five-bar")
    hinged = {link for link, points in scene.links.items() if set(points) & set(scene.links["frame"])}
    point = next(p for p in scene.joints if not set(scene.links_of[p]) & hinged)
    first = Balance(scene.links_of[point][0], point, (Fraction(3), Fraction(1)))
    forced = loaded(scene, 5)
    assert forced.loads is not None
    loads = replace(forced.loads, balances=(first, Balance(scene.drives[1].link)))
    found = report(replace(forced, loads=loads), plan="lever", exact=True)
    assert found.check["force"] == 0
    assert set(found.results["lever"]) | set(found.results["lever moment"]) == set(loads.named_balances)


@pytest.mark.parametrize("group", ["rrp", "rpr", "prp", "rpp", "sliding_triad"])
def test_slide_reactions_by_freed_pairs(group: str) -> None:
    """A slide's force and moment are found by levers alone, its pair freed across and in turning."""
    tried = 0
    for seed in range(4):
        scene = mechanism([group], seed)
        if not bracing(scene).sound:
            continue
        names = tuple(slide.name for slide in scene.slides)
        try:
            found = report(replace(loaded(scene, seed), find=Find((), (), names)), exact=True, plan="lever")
        except SingularPose:
            continue
        assert found.check["force"] == 0
        assert set(found.results["slide reaction"]) == set(found.results["slide moment"]) == set(names)
        tried += 1
    assert tried > 0


FREED = """title = "freed"
[points]
P0 = [-60, -70]
P1 = [50, 80]
[links]
1 = "P0 P1"
2 = "P1"
frame = "P0"
[[drive]]
link = "2"
omega = 1
[[drive]]
link = "1"
omega = 1
[find]
reactions = ["P0", "P1"]
[[forces]]
on = "1"
at = "P1"
value = [-46, -69]
[[balance]]
link = "2"
[[balance]]
on = "1"
at = "P1"
direction = [2, 3]
"""

FLYWHEEL = """title = "flywheel"
[points]
O = [0, 0]
[links]
1 = "O"
frame = "O"
[[drive]]
link = "1"
omega = 10
alpha = 2
[masses.1]
mass = 5
inertia = 0.2
centre = "O"
[balance]
link = "1"
"""

AT_REST = """title = "at rest"
[points]
P0 = [-10, 80]
P1 = [-20, -90]
P2 = [30, -70]
P3 = [-50, -20]
P4 = [20, 40]
P5 = [-90, -90]
[links]
1 = "P3 P4 P5"
2 = "P0 P1"
3 = "P2 P4"
4 = "P1 P5"
5 = "P1"
frame = "P0 P2"
[[slides]]
link = "1"
along = "5"
at = "P3"
direction = [6, -4]
[[drive]]
link = "4"
omega = 0
[masses.5]
mass = 1
inertia = 2
centre = "P1"
[balance]
link = "4"
"""

THREE_DRIVES = """title = "three drives"
[points]
P0 = [-60, 60]
P1 = [-40, 100]
P2 = [-40, 80]
[links]
1 = "P1 P2"
2 = "P2"
3 = "P0 P1"
frame = "P0"
[[drive]]
link = "3"
omega = 1
[[drive]]
link = "2"
omega = 1
[[drive]]
link = "2"
omega = 1
relative_to = "1"
[[forces]]
on = "3"
at = "P1"
value = [7, -2]
[[moments]]
on = "1"
value = 3
[[balance]]
on = "2"
at = "P2"
direction = [-3, 5]
[[balance]]
link = "2"
[[balance]]
on = "1"
at = "P2"
direction = [-5, 2]
"""

ALL = [(plan, inertia) for plan in ("", "lever", "polygons", "polar,lever", "polar,polygons") for inertia in INERTIA]


@pytest.mark.parametrize("text", [FREED, FLYWHEEL, AT_REST, THREE_DRIVES])
@pytest.mark.parametrize(("plan", "inertia"), ALL)
def test_hard_loads(text: str, plan: str, inertia: str) -> None:
    """A freed pair beside a balancing force, a rotor of one point, rest, three drives: exact by every plan."""
    found = report(parse(text, "hard"), exact=True, plan=plan, inertia=inertia)
    assert not any(found.check.values())


def test_values_of_hard_loads() -> None:
    """The values by hand: a force that balances another at its point frees the pin; I alpha turns the flywheel."""
    freed = report(parse(FREED, "freed"), exact=True, plan="lever")
    assert freed.results["lever"]["1"] == (46, 69)
    assert freed.results["reaction"]["frame at P0"] == (0, 0)
    for plan in ("lever", "polygons"):
        flywheel = report(parse(FLYWHEEL, "flywheel"), exact=True, plan=plan)
        assert [*flywheel.results.get("lever moment", flywheel.results.get("balance moment", {})).values()] == [
            Fraction(2, 5)]


def test_a_force_too_small_to_shift_keeps_its_couple() -> None:
    """Shifted inertia: where the force is nothing beside its couple the two are left apart, and it is said."""
    scene = parse(AT_REST.replace("omega = 0", "omega = 0\nalpha = 1").replace('centre = "P1"', 'centre = "P1"\n')
                  .replace("mass = 1\n", "mass = 0.0001\n"), "shifted")
    found = report(scene, exact=True, inertia="shifted")
    assert found.check["force"] == 0
    assert any("its inertia force is small compared with its couple" in form for form in found.drawing.forms)


def test_what_is_left_out_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the lever cannot serve the polygons are drawn, and where they cannot the lever; it is said why."""
    scene = replace(loaded(mechanism(["rrr"], 1), 1), find=Find((), ()))

    def refused(*_: object) -> None:
        raise Refused("it", "so it is", "nothing")

    for name, note, kinds in (("Levers", "no lever: so it is", {"reaction", "balance moment"}),
                              ("groups.reactions", "no force polygons: so it is", {"reaction", "lever moment"})):
        with monkeypatch.context() as patch:
            patch.setattr(f"graphplan.methods.forces.loaded.{name}", refused)
            for plan in ("both", {"Levers": "lever", "groups.reactions": "polygons"}[name]):
                found = report(scene, exact=True, plan=plan)
                assert note in found.drawing.forms
                assert found.check["force"] == 0
                assert set(found.results) == kinds


@pytest.mark.parametrize("omega", [1e-3, 1.0, 300.0])
def test_velocities_of_an_assumed_motion_are_in_proportion(omega: float) -> None:
    """Whatever their size, they are neither longer than the mechanism nor short beside it."""
    scene = load("slider-crank")
    scene = scene.with_drives([drive.driven_at(omega, 0.0) for drive in scene.drives])
    drawing = construct(scene)
    fastest = max(map(abs, drawing.velocity.values()))
    assert 0.1 <= fastest * float(assumed_tempo(drawing).kappa) / scene.extent <= 0.8
