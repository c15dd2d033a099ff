"""Constructions as they are asked for: what is drawn for a question, what is not, and what is refused."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from pathlib import Path
from random import Random

import numpy as np
import pytest
from face import got, ran
from higher import TEXTS
from sampling import CORE
from worlds import asking

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases"
WAYS = "", "euler-savary", "bobillier", "hartmann", "accelerations"


def case(name: str, **changes: object) -> gp.Scene:
    """A scene of the cases, with other values at some paths."""
    scene = gp.load(CASES / f"{name}.toml")
    return scene.replace({path.replace("__", "."): value for path, value in changes.items()}) if changes else scene


def steps(scene: gp.Scene, **how: str) -> int:
    """How many steps a construction takes."""
    return len(gp.construct(scene, checked=False, **how).drawn)


def drawn(drawing: gp.WorkingDrawing) -> set[str]:
    """The names of all marks."""
    return {step.name for step in drawing.drawn.steps}


# ---- motion ----------------------------------------------------------------------------------------------------------


def test_the_velocity_of_one_point_draws_no_more_than_it_needs() -> None:
    """Asked for v_C of Rosenauer's basic case: no N-plan, and nothing of A, B, D, E but their lines' directions."""
    drawing = gp.construct(asking(gp.load("rosenauer-basic"), velocity=["C"]))
    assert {step.panel for step in drawing.drawn.steps} == {"mechanism"}
    assert not {"v_a", "v_b", "v_d", "v_e"} & drawn(drawing)
    assert set(drawing.velocity) == {"C"}


def test_a_question_about_one_link_draws_no_other() -> None:
    """Of the crank nothing of coupler and rocker is drawn; of its rates nothing at all; of a coupler with a distant
    point the side is read that is drawn anyway."""
    scene = case("rates/four-bar")
    drawing = gp.construct(asking(scene, velocity=["A"], acceleration=["A"]))
    assert {step.name for step in drawing.drawn.steps if step.op.name == "given"} == {"O", "A"}
    assert steps(asking(scene, links=["1"])) == 0
    assert gp.solve(asking(scene, links=["1"])).json()["links"] == {"1": {"omega": 2.0, "alpha": 3.0}}
    far = gp.parse(scene.text.replace("[links]", "M = [500, 400]\n[links]").replace("A B", "A B M"))
    assert "M" not in drawn(gp.construct(asking(far, links=["2"])))


def test_rates_of_links_cost_no_step_where_all_points_are_asked_for() -> None:
    """What marks say anyway is not drawn, and is the same number; a question of fewer adds no reading."""
    scene = case("rates/four-bar")
    points = {"velocity": ["A", "B"], "acceleration": ["A", "B"]}
    alone, both = asking(scene, **points), asking(scene, **points, links=["1", "2", "3"])
    assert steps(alone) == steps(both)
    part, whole = (gp.solve(one, exact=True).json() for one in (asking(scene, velocity=["B"], links=["3"]), both))
    assert part["points"] == {"B": {"velocity": whole["points"]["B"]["velocity"]}}
    assert part["links"]["3"] == whole["links"]["3"]


def test_results_are_true_vectors_in_scene_units() -> None:
    """Velocities and accelerations are complex numbers, not turned and not scaled; those of fixed points are 0, over
    poses zeros, and those of no point are not made up."""
    drawing = gp.construct(case("rates/four-bar"))
    assert drawing.velocity["A"] == 2j * (20 + 10j)
    assert drawing.acceleration["A"] == pytest.approx((3j - 4) * (20 + 10j))
    poses = drawing.evaluate(points={"B": np.array([70 + 40j, 60 + 45j, 75 + 38j])})
    for one, many in ((drawing.velocity, poses.velocity), (drawing.acceleration, poses.acceleration)):
        assert one["O"] == 0
        assert np.array_equal(many["C"], np.zeros(3, dtype=complex))
        with pytest.raises(KeyError):
            one["Z"]


def test_what_is_given_is_printed_as_it_is_given() -> None:
    """Rates of drives, of actuators and of given motions are no differences of large numbers."""
    fast = gp.solve(case("rates/fast"))
    assert dict(fast.omega) == {"1": 1e7, "2": -3e6}
    assert dict(fast.alpha) == {"1": 1.0, "2": 1.25}
    pushed = gp.solve(case("rates/cylinder", drive__0__speed=2e-9))
    assert pushed.sliding_velocity["rod along barrel"] == pytest.approx(1.2e-9 + 1.6e-9j, rel=1e-15)


@pytest.mark.parametrize("name", CORE)
def test_the_time_scale_is_round_and_cranks_can_be_drawn(name: str) -> None:
    """kappa is 1, 2 or 5 times a power of ten, and a crank's velocity is neither a dot nor beyond the mechanism."""
    drawing, scene = got(name).drawing, got(name).scene
    if not drawing.velocity:
        return
    lead = f"{drawing.kappa:.6e}"
    assert lead[:8] in ("1.000000", "2.000000", "5.000000"), drawing.kappa
    fastest = max(map(abs, drawing.velocity.values()), default=0.0) * drawing.kappa / float(scene.extent)
    assert not fastest or 0.02 <= fastest <= 5


@pytest.mark.parametrize(("omega", "times", "kappa"), [
    (10, "1", 0.1), (-10, "1", 0.1), (5, "1", 0.2), (8, "1", 0.1), (31.4, "1", 0.02), (10, "10", 0.02)])
def test_velocities_of_a_crank_end_in_its_pivot_where_that_is_round(omega: float, times: str, kappa: float) -> None:
    """kappa is one over the crank's angular velocity, but where that is not round, or the crank is long."""
    scene = gp.load("four-bar")
    crank = [coordinate * Fraction(times) for coordinate in scene.points["A"]]
    scene = scene.replace({"points.A": crank, "drive.0.omega": omega, "find.velocity": ["A"], "find.acceleration": []})
    assert gp.construct(scene, checked=False).kappa == pytest.approx(kappa)


def test_unknown_methods_plans_and_points_are_refused() -> None:
    """A method or plan that does not exist is refused with those that do, and so are poses of no point, fractions of
    irrational scenes, and names of one place that differ."""
    scene = gp.load("four-bar")
    for how, text in (({"method": "magic"}, "auxiliary, trial, poles"), ({"plan": "square"}, "orthogonal, polar")):
        with pytest.raises(gp.Refused, match=text):
            gp.construct(scene, **how)
    with pytest.raises(gp.Refused, match="no such point"):
        gp.construct(scene).evaluate(points={"Z": [0j]})
    with pytest.raises(gp.Refused, match="rpm"):
        gp.solve(gp.parse(case("rates/four-bar").text.replace("omega = 2.0", "rpm = 95")), exact=True)
    pin = np.array([-120 + 180j])
    with pytest.raises(gp.Refused, match="coincide"):
        gp.construct(gp.load("slotted-link")).evaluate(points={"A": pin, "A3": pin + 1})


def test_one_name_of_a_place_moves_its_mark() -> None:
    """A guide's point named apart moves the pair's one mark."""
    drawing, pin = gp.construct(gp.load("slotted-link")), np.array([-120 + 180j, -110 + 190j])
    by_one, by_both = (drawing.evaluate(points=dict.fromkeys(names, pin)) for names in (["A3"], ["A", "A3"]))
    assert np.array_equal(by_one.velocity["B"], by_both.velocity["B"])
    assert by_one.velocity["B"][0] != by_one.velocity["B"][1]


CONTROLLED = {"rosenauer-basic": {"3", "4"}, "rosenauer-example-1": {"3"}, "rosenauer-example-2": {"6"},
              "stephenson": {"3"}, "four-bar": {"2"}, "shaper": set(), "jaanimets-10": set()}


@pytest.mark.parametrize("name", CONTROLLED)
def test_poles_lie_on_every_line(name: str) -> None:
    """The lines to the ends of a link's orthogonal velocities meet in its pole, exactly in fractions, and on the sheet
    but for rounding; links whose pole is marked, and polar plans, have nothing to control."""
    scene, velocities = gp.load(name), gp.solve(gp.load(name), exact=True).velocity
    drawing = gp.construct(scene)
    assert {control.link for control in drawing.controls} == CONTROLLED[name]
    for control in drawing.controls:
        assert control.true_deviation(scene.points, velocities) == Fraction(0)
        assert control.drawn_deviation(drawing.values) == pytest.approx(0, abs=1e-9 * float(scene.extent)**2)
        x, y = velocities[control.points[0]]
        moved = {**velocities, control.points[0]: (x, y + Fraction(1, 10**30))}
        assert control.true_deviation(scene.points, moved) != 0
    assert not gp.construct(scene, plan="polar").controls


# ---- gears and contacts ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TEXTS)
def test_each_kind_of_gear_and_contact_is_constructed_exactly(name: str) -> None:
    """As the solver has it, in fractions, on both kinds of plans; and the same steps with the points elsewhere give
    what is solved there."""
    scene, random = gp.parse(TEXTS[name]), Random(name)
    for plan in ("orthogonal", "polar"):
        assert not any(gp.solve(scene, exact=True, plan=plan).check.values())
    drawing, poses = gp.construct(scene, checked=False), [moved(scene, random) for _ in range(3)]
    toothed = gp.parse(TEXTS[name].replace("radii", "teeth"))  # its centres may lie anywhere
    found = drawing.evaluate(points={point: np.array([pose[point] for pose in poses]) for point in scene.points})
    for number, pose in enumerate(poses):
        there = gp.solve(toothed.replace({f"points.{point}": z for point, z in pose.items()}))
        for one, true in ((found.velocity, there.velocity), (found.acceleration, there.acceleration)):
            size = max(map(abs, true.values()), default=0.0)
            assert all(z[number] == pytest.approx(true[point], rel=1e-7, abs=1e-7 * size) for point, z in one.items())


def moved(scene: gp.Scene, random: Random) -> dict[str, complex]:
    """The scene's points elsewhere, each where contacts touch as far along the normal as before."""
    at = {name: complex(*map(float, place)) for name, place in scene.points.items()}
    new = {name: z + complex(random.uniform(-2, 2), random.uniform(-2, 2)) for name, z in at.items()}
    for pair in scene.contacts:
        one, two = pair.centres
        if one and two:
            new[pair.at] = new[one] + (new[two] - new[one]) * (at[pair.at] - at[one]) / (at[two] - at[one])
        else:
            centre = one or two or ""
            new[pair.at] = new[centre] + at[pair.at] - at[centre]
    return new


def test_a_gear_linkage_is_drawn_as_in_the_book() -> None:
    """Ozols 7-16: the pitch point's end is common to both wheels, and the next one's lies on a parallel through it;
    where the second rod is in line with the first, wheels have no velocities."""
    scene = case("rates/gear-linkage")
    told = gp.construct(scene).sentences()
    lines = [line for line in told if "P_" in line and "given" not in line]
    assert lines[0].startswith("From A lay off in the direction from A to B: mark P_12. (The relative pole of "
                               "links 1 and 2 divides AB as 30 : 50.)")
    assert not any("guide" in line for line in told)
    assert any(line.startswith("Mark v_p_23 where BC meets") for line in told), told
    with pytest.raises((gp.SingularPose, gp.ConstructionError), match="parallel"):
        gp.construct(gp.parse(scene.text.replace("C = [15, 0]", "C = [30, 40]"))).velocity  # noqa: B018


def test_names_of_stand_ins_are_nobody_elses() -> None:
    """A scene that has a link 0 and a point P_12 keeps both, with the same results."""
    cam = TEXTS["cam"].replace("'2' = ", "'0' = ").replace("['1', '2']", "['1', '0']")
    scene = case("rates/gear-linkage")
    linkage = scene.text.replace("M =", "P_12 =").replace("C M", "C P_12").replace('["M"]', '["P_12"]')
    one, other = gp.solve(gp.parse(TEXTS["cam"]), exact=True), gp.solve(gp.parse(cam), exact=True)
    assert one.omega["2"] == other.omega["0"]
    assert gp.solve(gp.parse(linkage), exact=True).velocity["P_12"] == gp.solve(scene, exact=True).velocity["M"]


def test_planets_that_repeat_each_other_are_drawn_once() -> None:
    """Of two planets between the same wheels one pair is redundant: it is told so, and what is left is drawn."""
    two = TEXTS["ring"].replace("'O B'", "'O B D'\n'4' = 'D'").replace("[points]", "[points]\nD = [-40, 30]")
    for links, centres, sizes in (("1 4", "O D", "teeth = [30, 20]"),
                                  ("4 frame", "D O", "teeth = [20, 70]\ninternal = true")):
        two += f"[[gears]]\nlinks = {links.split()}\ncentres = {centres.split()}\n{sizes}\n"
    scene = gp.parse(two, "planets")
    assert len(gp.solve(scene, exact=True).json()["redundant"]) == 1
    assert any("redundant" in str(note) for note in gp.construct(scene).notes)


def test_velocity_triangles_end_on_straight_lines() -> None:
    """Ozols 7-2: on the plan of triangles a planet's ends lie on one line, which perpendiculars to its line of centres
    meet; other mechanisms have no such plan."""
    for name in ("planet", "ring", "belt"):
        assert not any(gp.solve(gp.parse(TEXTS[name]), exact=True, plan="triangles").check.values())
    drawing = gp.construct(gp.parse(TEXTS["ring"]), plan="triangles")
    assert drawing.method["velocity"] == ["velocity triangles"]
    assert not drawing.broken_claim
    assert any(line.startswith("Through B draw ") and "perpendicular to" in line for line in drawing.sentences())
    with pytest.raises(gp.Refused, match="triangles"):
        gp.construct(gp.parse(TEXTS["cam"]), plan="triangles")


# ---- poles, curvature ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [
    "slider-crank", "slotted-link", "shaper", "five-bar", "open-chain", "triad", "double-butterfly", "rosenauer-basic",
    "alt-ten-link", "planetary", "racks", "wheel-on-rail", "roller-cam"])
def test_all_poles_are_those_of_the_solver(name: str) -> None:
    """Every pole of every pair of links is exactly where the solver's rates have it, wherever links are written."""
    scene = asking(gp.load(name), poles="all")
    found = gp.solve(scene, exact=True).json()
    assert found["check"] == {"poles": 0}
    assert len(found["poles"]) == len(scene.links) * (len(scene.links) - 1) // 2 or "frame" not in scene.links
    body = re.search(r"(?<=\[links\]\n)(?:.+\n)+", scene.text)[0]
    other = gp.parse(scene.text.replace(body, "\n".join(reversed(body.splitlines())) + "\n"), name)
    again = gp.solve(other, exact=True).json()["poles"]
    assert {frozenset(pair.split()): at for pair, at in again.items()} == {
        frozenset(pair.split()): at for pair, at in found["poles"].items()}


@pytest.mark.parametrize(("name", "links"), [("four-bar", 4), ("slider-crank", 4), ("triad", 6),
                                             ("double-butterfly", 8)])
def test_a_circle_diagram_has_a_side_for_each_pole(name: str, links: int) -> None:
    """Of n links there are n(n - 1)/2 poles, numbered in the order in which they are found (Ozols 1974, 5-2)."""
    circle = gp.construct(asking(gp.load(name), poles="all")).circle
    assert circle is not None
    assert (len(circle.links), len(circle.sides)) == (links, links * (links - 1) // 2)
    numbers = [side.number for side in circle.sides if side.number]
    assert numbers == [*range(1, len(numbers) + 1)]


@pytest.mark.parametrize("name", ["slider-crank", "triad"])
def test_poles_are_found_in_other_poses(name: str) -> None:
    """Around the cycle the same steps give the poles of every pose that there is, as the solver has them."""
    done = ran("cycle", "-", "--positions", "8", given=asking(gp.load(name), poles="all").text)
    assert done.status == 0, done.err
    assert re.search("[68] of 8 poses", done.err)


@pytest.mark.parametrize("method", WAYS)
@pytest.mark.parametrize("name", ["slider-crank", "parallelogram", "planet"])
def test_every_way_to_curvature_gives_the_solvers_fractions(name: str, method: str) -> None:
    """All that can be asked, by known centres, rolling or rates, on either plan."""
    scene = asking(case(f"curvature/{name}"), curvature="all", inflection="all")
    for plan in ("orthogonal", "polar"):
        assert gp.solve(scene, exact=True, method=method, plan=plan).check["curvature"] == 0


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "slot", "parallelogram"])
def test_true_paths_have_the_centres_that_are_drawn(name: str) -> None:
    """The circle through three points of the path that the mechanism runs through tends to the one that is drawn."""
    scene, step = asking(case(f"curvature/{name}"), curvature=["M on 2"]), 0.02
    path = gp.follow(scene, 3, (-step, step)).points["M"]
    z, second = (path[2] - path[0]) / 2, path[2] - 2 * path[1] + path[0]
    centre = path[1] + 1j * z * abs(z) ** 2 / (z.conjugate() * second).imag
    told = gp.solve(scene).json()["curvature"]["M on 2"]
    assert complex(*told["centre"]) == pytest.approx(complex(centre), rel=1e-5)
    assert told["radius"] == pytest.approx(abs(centre - path[1]), rel=1e-4)


def test_acceleration_centre_has_no_acceleration() -> None:
    """At Q of a turning link a_A + (i alpha - omega^2) AQ vanishes."""
    scene = asking(case("curvature/four-bar"), acceleration=["A"], links=["2"], acceleration_centres=["1", "2"])
    found = gp.solve(scene)
    centres = found.json()["acceleration_centres"]
    A, turning = complex(*map(float, scene.points["A"])), 1j * found.alpha["2"] - found.omega["2"] ** 2
    a_A = found.acceleration["A"]
    assert abs(a_A + turning * (complex(*centres["2"]["at"]) - A)) < 1e-9 * abs(a_A)
    assert centres["1"]["at"] == [0, 0]


# ---- forces ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dx", [5, *(Fraction(1, 10**k) for k in (1, 3, 6, 9, 12, 15)), 0])
def test_the_auxiliary_point_of_forces_may_be_anywhere(dx: Fraction) -> None:
    """With bars all but parallel, and parallel, the auxiliary point is far or nowhere, and no digit is lost."""
    scene = case("forces/hinged-triad", points__F=[80 + dx, 50])
    assert gp.solve(scene).check["force"] < 1e-13
    assert gp.solve(scene, exact=True).check["force"] == 0


def test_a_slide_reaction_that_is_small_beside_its_moment_is_told_with_its_couple() -> None:
    """Its line of action is not drawn then, which the construction says; else it acts at a place."""
    for weight, told in ((3, True), (5, False), (Fraction(5) + Fraction(1, 10**9), False)):
        scene = case("forces/press", forces__0__value=[-12, weight])
        (entry,) = [entry for entry in gp.solve(scene).json()["reactions"] if "slide" in entry]
        assert ("acts_at" in entry) == told
        assert any("small compared with its moment" in form for form in gp.construct(scene).forms) != told


def test_only_the_reactions_that_are_asked_for_are_drawn() -> None:
    """One joint's reaction takes fewer steps than all; of scenes without loads, and of links that bear none, no force
    is drawn."""
    scene = gp.load("rosenauer-loaded")
    few, every, none = (asking(scene, reactions=asked) for asked in (["F"], "all", []))
    assert steps(few, plan="polygons") < steps(every, plan="polygons")
    assert [*gp.solve(few).reactions] == [name for name in gp.solve(every).reactions if name.endswith(" at F")]
    assert not gp.solve(none).reactions
    free = gp.construct(gp.load("four-bar"))
    assert not [step for step in free.program.steps if "force" in step.panel or "lever" in step.panel]
    unloaded = gp.construct(case("forces/press", forces=[], moments=[{"on": "1", "value": 3}]))
    assert not [step for step in unloaded.drawn.steps if step.panel == "force plan 2, 3" and step.args]


def test_a_balance_that_does_no_work_holds_nothing() -> None:
    """Across the motion of its point a balance holds nothing in this pose: the pose is singular, and says so."""
    scene = case("forces/press", balance={"on": "3", "at": "B", "direction": [0, 1]})
    with pytest.raises(gp.SingularPose, match="balance cannot hold the motion"):
        gp.solve(scene)


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
