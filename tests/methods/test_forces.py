"""Force plans: every reaction and balance is what the solver says, exactly, whatever the groups are."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from packaged_scenes import read, those
from random_loads import loaded
from random_mechanisms import GROUPS, mechanism
from test_topologies import thrown

import graphplan as gp
from graphplan.check.forces import force_truth
from graphplan.check.report import Report
from graphplan.check.trusted import report
from graphplan.errors import ConstructionError, Refused, SingularPose
from graphplan.mechanism.model import (
    FRAME,
    Balance,
    Find,
    Force,
    Loads,
    Mass,
    Moment,
    Scene,
    Slide,
    TurningDrive,
    Units,
)
from graphplan.mechanism.scene import load
from graphplan.mechanism.structure import bracing
from graphplan.methods.construct import construct
from graphplan.methods.panels import INERTIA

LOADED = those(lambda scene: scene.loads is not None)
SOME = st.lists(st.sampled_from(sorted(GROUPS)), min_size=1, max_size=3)


def checked(scene: Scene, **choices: Any) -> Report:
    """The exact report of a scene that is not singular."""
    try:
        found = report(scene, exact=True, **choices)
    except SingularPose:
        assume(False)
        raise
    return found


def sound(names: list[str], seed: int) -> Scene:
    """A random mechanism whose links are held just once."""
    scene = mechanism(names, seed)
    assume(bracing(scene).sound)
    return scene


def everything(found: Report) -> bool:
    """Whether every force that the solver knows was constructed, and is the same fraction."""
    assert found.forces is not None
    drawn = {kind: truth for kind, truth in force_truth(
        found.scene, found.results, found.forces.reactions).items() if not kind.startswith(("lever", "power"))}
    same = all(found.results.get(kind, {}) == truth for kind, truth in drawn.items())
    return same and found.agrees and found.check["force"] == 0


@pytest.mark.parametrize("group", sorted(GROUPS))
def test_every_group_is_solved_exactly(group: str) -> None:
    """Dyads of all five modifications, triads, class IV and Rosenauer's groups: reactions, moments, balance, lever."""
    tried = 0
    for seed in range(5):
        scene = mechanism([group], seed)
        if bracing(scene).sound:
            try:
                assert everything(report(loaded(scene, seed), exact=True)), seed
            except SingularPose:
                continue
            tried += 1
    assert tried > 0


@settings(max_examples=13, deadline=None)
@given(SOME, st.integers(0, 10**6), st.sampled_from(("both", "polar", "polar,polygons")))
def test_random_loaded_mechanisms(names: list[str], seed: int, plan: str) -> None:
    """On any mechanism of groups added to a crank, force plans, lever, solver and power balance agree exactly."""
    found = checked(loaded(sound(names, seed), seed), plan=plan)
    assert found.check["force"] == 0


@settings(max_examples=8, deadline=None)
@given(SOME, st.integers(0, 10**6), st.sampled_from(INERTIA))
def test_inertia_has_three_forms(names: list[str], seed: int, inertia: str) -> None:
    """At the centre with a couple, shifted, or at two points: the same reactions, or a word why it cannot be."""
    scene = loaded(sound(names, seed), seed)
    try:
        found = checked(scene, inertia=inertia)
    except ConstructionError as error:
        assert inertia == "shifted"
        assert "couple-alone" in str(error)
        return
    assert found.check["force"] == 0


@settings(max_examples=7, deadline=None)
@given(st.sampled_from(("rrp", "prp", "rpp")), st.integers(0, 10**6))
def test_balance_as_a_force(group: str, seed: int) -> None:
    """What balances may be a force on a slider: then the groups are taken in another order."""
    scene = mechanism([group], seed)
    slide = next((s for s in scene.slides if s.along == FRAME), None)
    assume(slide is not None and bracing(scene).sound)
    assert slide is not None
    x, y = slide.direction
    forced = loaded(scene, seed, Balance(slide.link, slide.at, (x, y + 1)))
    assume(bracing(forced, balanced=True).sound)
    assert everything(checked(forced))


@pytest.mark.parametrize(("moving", "sliding", "throws"), [(5, 0.0, 200), (5, 0.4, 400), (7, 0.2, 300)])
def test_any_linkage_bears_loads(moving: int, sliding: float, throws: int) -> None:
    """Linkages that nobody has named, thrown at random, with any loads: each reaction exactly."""
    tried = 0
    for seed in range(throws // 4):
        scene = thrown(seed, moving, sliding)
        if scene is None or not all(scene.links[link] for link in scene.moving) or not bracing(scene).sound:
            continue
        try:
            assert everything(report(loaded(scene, seed), exact=True)), seed
        except SingularPose:
            continue
        tried += 1
    assert tried > 0


@pytest.mark.parametrize("seed", [841, 1215, 693, 1097])
def test_groups_of_six_links_with_trials_and_couples(seed: int) -> None:
    """Groups of six links in rings, some of which take false position or give couples before forces."""
    scene = thrown(seed, 7, 0.3)
    assert scene is not None
    assert everything(report(loaded(scene, seed), exact=True))


@pytest.mark.parametrize("name", LOADED)
@pytest.mark.parametrize("plan", ["both", "polar", "lever", "polygons"])
def test_loaded_scenes_agree(name: str, plan: str) -> None:
    """On every packaged scene with loads all three opinions agree to rounding, by every plan."""
    found = report(load(name), plan=plan)
    assert found.agrees
    assert found.check["force"] < 1e-12


@pytest.mark.parametrize("name", [name for name in LOADED if not read(name).irrational])
def test_loaded_scenes_agree_exactly(name: str) -> None:
    """Where a packaged scene is rational they agree exactly."""
    assert report(load(name), exact=True).check["force"] == 0


def hinged(dx: Fraction) -> Scene:
    """A loaded triad, two of whose bars are parallel but for dx."""
    points = {"O": (0, 0), "A": (10, 20), "B": (80, 0), "C": (120, 0), "E": (30, 60), "F": (80 + dx, 50),
              "G": (120, 60), "H": (70, 80)}
    links = {"1": ("O", "A"), "2": ("A", "E"), "3": ("B", "F"), "4": ("C", "G"), "5": ("E", "F", "G", "H"),
             FRAME: ("O", "B", "C")}
    places = {name: (Fraction(x), Fraction(y)) for name, (x, y) in points.items()}
    loads = Loads((Fraction(0), Fraction(-10)), {"2": Mass(Fraction(1), Fraction(1), "E")},
                  (Force("5", "H", (Fraction(5), Fraction(-7))), Force("3", "F", (Fraction(1), Fraction(2)))),
                  (Moment("4", Fraction(1)),), (Balance("1"),))
    drive = TurningDrive("1", FRAME, Fraction(1), Fraction(0))
    return Scene("triad", "", "triad", Units(), places, {}, links, (drive,), {}, Find((), ()), loads=loads)


@pytest.mark.parametrize("dx", [Fraction(5), *(Fraction(1, 10**k) for k in (1, 3, 6, 9, 12, 15)), Fraction(0)])
def test_auxiliary_point_may_be_anywhere(dx: Fraction) -> None:
    """With bars all but parallel, and parallel, the auxiliary point is far or nowhere, and nothing is lost."""
    found = report(hinged(dx))
    assert found.agrees
    assert found.check["force"] < 1e-13
    assert report(hinged(dx), exact=True).check["force"] == 0


def press(weight: Fraction, couple: Fraction) -> Scene:
    """A slider-crank whose slider bears a weight and a couple, its reaction being what they leave."""
    points = {"O": (0, 0), "A": (3, 4), "B": (15, -1), "D": (20, -1)}
    links = {"1": ("O", "A"), "2": ("A", "B"), "3": ("B", "D"), FRAME: ("O",)}
    places = {name: (Fraction(x), Fraction(y)) for name, (x, y) in points.items()}
    slides = (Slide("3", FRAME, "B", (Fraction(1), Fraction(0))),)
    loads = Loads((Fraction(0), Fraction(0)), {}, (Force("3", "B", (Fraction(-12), weight)),), (Moment("3", couple),),
                  (Balance("1"),))
    return Scene("press", "", "press", Units("m"), places, {}, links,
                 (*slides, TurningDrive("1", FRAME, Fraction(1), Fraction(0))), {}, Find((), ()), loads=loads)


def test_small_slide_reaction_is_told() -> None:
    """A slide's reaction that is next to nothing beside its moment is told with its couple; its line is not drawn."""
    for weight, drawn in ((Fraction(3), True), (Fraction(5), False), (Fraction(5) + Fraction(1, 10**9), False)):
        found = report(press(weight, Fraction(7)))
        assert found.agrees
        assert ("slide arm" in found.results) == drawn
        assert any("small compared with its moment" in form for form in found.drawing.forms) != drawn


def test_unloaded_group_is_not_drawn() -> None:
    """A group on which nothing acts gets no polygon: its reactions are nothing."""
    scene = replace(mechanism(["rrr"], 1), loads=Loads((Fraction(0), Fraction(0)), {}, (), (Moment("1", Fraction(3)),),
                                                       (Balance("1"),)), find=Find((), ()))
    found = report(scene, exact=True)
    assert everything(found)
    assert not [step for step in found.drawing.drawn.steps if step.panel == "force plan 2, 3" and step.args]


def test_only_what_is_asked_for_is_drawn() -> None:
    """A scene that asks for no reaction, or for one joint's, is drawn with fewer steps."""
    whole = load("rosenauer-loaded")
    few = replace(whole, find=Find((), (), ("F",)))
    none = replace(whole, find=Find((), (), ()))
    everywhere = replace(whole, find=Find((), ()))
    steps = [len(construct(scene, plan="polygons").program) for scene in (everywhere, few)]
    assert steps[1] < steps[0]
    assert list(report(few).results["reaction"]) == [name for name in report(everywhere).results["reaction"]
                                                     if name.endswith(" at F")]
    assert "reaction" not in report(none).results


def test_scenes_without_loads_have_no_forces() -> None:
    """A scene without loads has no force steps, readings or arrows."""
    found = report(load("four-bar"))
    assert found.forces is None
    assert "force" not in found.check
    assert not [step for step in found.drawing.program.steps if "force" in step.panel or "lever" in step.panel]


def test_words_of_a_plan() -> None:
    """A plan or a form of inertia that does not exist is refused with those that do."""
    scene = load("jaanimets-10")
    with pytest.raises(Refused, match="plan levers: unknown plan; choose one of orthogonal, polar, triangles, lever"):
        construct(scene, plan="polar,levers")
    with pytest.raises(Refused, match="inertia springs: unknown method of inertia; choose one of couple, shifted"):
        construct(scene, inertia="springs")


def test_balance_that_does_no_work() -> None:
    """A balance across the motion of its point holds nothing in this pose: the pose is singular, and says so."""
    scene = press(Fraction(1), Fraction(0))
    across = replace(scene, loads=Loads((Fraction(0), Fraction(0)), {}, scene.loads.forces if scene.loads else (), (),
                                        (Balance("3", "B", (Fraction(0), Fraction(1))),)))
    with pytest.raises(SingularPose, match="balance cannot hold the motion"):
        report(across)


def test_loads_are_not_much_longer_than_the_mechanism() -> None:
    """Also where inertia forces are far larger than the drive lets expect, as near a limit position."""
    scene = gp.scene({
        "points": {"O": [0, 0], "A": [20, 0], "B": [60, 0.4], "C": [70, -40]},
        "links": {"1": "O A", "2": "A B", "3": "B C", "frame": "O C"}, "drive": [{"link": "3", "omega": 1}],
        "masses": {"1": {"mass": 1, "inertia": 0, "centre": "A"}}, "balance": {"link": "3"}})
    drawing = gp.construct(scene)
    ends = [[tuple(map(float, drawing.values[mark][:2])) for mark in (vector.start, vector.end)]
            for vector in drawing.arrows if vector.kind == "load" and vector.panel == "mechanism"]
    assert 0.1 < max(math.dist(*spots) for spots in ends) / scene.extent < 1.5
