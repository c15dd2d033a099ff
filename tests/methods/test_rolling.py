"""Gears and contacts in constructions: what stands for them, how it is drawn and spoken, and other poses."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from higher import ARC_CAM, ARM_DRIVE, DRIVE, TEXTS, gear, scenes, slide, text

import graphplan as gp
from graphplan.check.poses import PoseBatch, pose_gaps, sound_poses
from graphplan.check.trusted import report
from graphplan.commands import main
from graphplan.mechanism.model import Scene
from graphplan.mechanism.replaced import bars, rolling_guides, with_lower_pairs
from graphplan.mechanism.scene import parse
from graphplan.solver import solve

SCENES = scenes()
LINKAGE = """
[points]
O = [0, 0]
A = [3, 4]
B = [15, 20]
C = [15, 0]
M = [20, 3]
[links]
1 = "O A"
2 = "B"
3 = "C M"
4 = "A B"
5 = "B C"
frame = "O C"
[[gears]]
links = ["1", "2"]
centres = ["A", "B"]
teeth = [30, 50]
[[gears]]
links = ["2", "3"]
centres = ["B", "C"]
teeth = [50, 45]
[[drive]]
link = "1"
omega = 1
[find]
velocity = ["M"]
"""


@pytest.mark.parametrize("name", TEXTS)
def test_each_kind_is_constructed_exactly(name: str) -> None:
    """Each kind of gear and contact is drawn as the solver has it, in fractions, on both kinds of plans."""
    for plan in ("orthogonal", "polar"):
        assert not any(report(SCENES[name], exact=True, plan=plan).check.values())


def moved(scene: Scene, random: Random) -> dict[str, complex]:
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


@pytest.mark.parametrize("name", TEXTS)
def test_other_poses_are_the_solvers(name: str) -> None:
    """The same steps with the points elsewhere give what the solver says there; pitch points follow the centres."""
    scene, random = SCENES[name], Random(name)
    drawing = gp.construct(scene, checked=False)
    poses = [moved(scene, random) for _ in range(3)]
    found = drawing.evaluate(points={point: np.array([pose[point] for pose in poses]) for point in scene.points})
    for number, pose in enumerate(poses):
        there: dict[str, Any] = {point: (z.real, z.imag) for point, z in pose.items()}
        truth = solve(replace(scene, points=there))
        for kind, values in (("velocity", found.velocity), ("acceleration", found.acceleration)):
            for point, z in values.items():
                size = max(abs(complex(*v)) for v in getattr(truth, kind).values())
                assert z[number] == pytest.approx(complex(*getattr(truth, kind)[point]), rel=1e-9, abs=1e-9 * size)


def test_a_gear_linkage_is_drawn_as_in_the_book() -> None:
    """Ozols 7-16: the pitch point's end is common to both wheels, and the next one's lies on a parallel through it."""
    told = gp.construct(parse(LINKAGE, "linkage")).sentences()
    lines = [line for line in told if "P_" in line and "given" not in line]
    assert lines[0].startswith("From A lay off in the direction from A to B: mark P_12. (The relative pole of "
                               "links 1 and 2 divides AB as 30 : 50.)")
    assert not any("guide" in line for line in told)
    assert any(line.startswith("Mark v_p_23 where BC meets") for line in told), told


def test_collinear_trains_need_no_crossing() -> None:
    """Where all centres lie on one line the ends of velocities do, too: they are found in proportion."""
    arm = text({"1": "O", "2": "B", "5": "C M", "3": "O B C", "frame": "O"}, gear("1 2", "O B", "teeth = [30, 20]"),
               gear("2 5", "B C", "teeth = [20, 40]"), DRIVE.format("1"), ARM_DRIVE)
    train = parse(arm.replace("[90, 120]", "[54, 72]") + "[find]\nvelocity = ['M']\n", "train")
    drawing = report(train, exact=True).drawing
    assert not any("trial" in line for line in drawing.sentences())


def test_names_of_stand_ins_are_nobody_elses() -> None:
    """A scene that has a link 0 and a point P_12 keeps both; stand-ins take other names, the same in any order."""
    cam = TEXTS["cam"].replace("'2' = ", "'0' = ").replace("['1', '2']", "['1', '0']")
    assert set(bars(with_lower_pairs(parse(cam, "cam")))) == {"0'"}
    linkage = LINKAGE.replace("M =", "P_12 =").replace("C M", "C P_12").replace('["M"]', '["P_12"]')
    assert [guide.at for guide in rolling_guides(with_lower_pairs(parse(linkage, "linkage")))] == ["P_12'", "P_23"]


def test_planets_that_repeat_each_other_are_drawn_once() -> None:
    """Of two planets between the same wheels one pair is redundant: it is told so, and what is left is drawn."""
    two = TEXTS["ring"].replace("'O B'", "'O B D'\n'4' = 'D'").replace("[points]", "[points]\nD = [-40, 30]")
    two += gear("1 4", "O D", "teeth = [30, 20]") + gear("4 frame", "D O", "teeth = [20, 70]\ninternal = true")
    scene = parse(two, "planets")
    assert len(scene.redundant_pairs) == 1
    found = report(scene, exact=True)
    assert not any(found.check.values())
    assert any("redundant" in note for note in found.drawing.notes)


def test_a_dead_centre_of_the_train_is_singular() -> None:
    """Where the second rod is in line with the first, the wheels have no velocities: what should meet is named."""
    scene = parse(LINKAGE.replace("[15, 0]", "[30, 40]"), "linkage")
    with pytest.raises(gp.SingularPose, match="parallel"):
        report(scene)


def test_a_point_of_contact_that_is_left_behind_is_refused() -> None:
    """On a rail of irrational length the point of contact is given: where the wheel moves it must be told, too."""
    rail = TEXTS["wheel on a rail"].replace("[-4, 3]", "[-4, 4]").replace("K = [12, 16]", "K = [10, 20]")
    drawing = gp.construct(parse(rail, "rail"))
    with pytest.raises(gp.Refused, match="point K"):
        drawing.evaluate(points={"B": np.array([31 + 40j])})


def test_velocity_triangles_end_on_straight_lines() -> None:
    """Ozols 7-2: on the plan of triangles a planet's ends lie on one line, which perpendiculars to its line of centres
    meet; other mechanisms have no such plan, and four-bars are refused."""
    for name in ("planet", "ring", "belt"):
        assert not any(report(SCENES[name], exact=True, plan="triangles").check.values())
    drawing = gp.construct(SCENES["ring"], plan="triangles")
    assert drawing.method["velocity"] == ["velocity triangles"]
    assert not drawing.broken_claim
    assert any(line.startswith("Through B draw ") and "perpendicular to" in line for line in drawing.sentences())
    with pytest.raises(gp.Refused, match="triangles"):
        gp.construct(SCENES["cam"], plan="triangles")


def test_a_rack_at_a_uniform_speed_is_sound_around_the_cycle() -> None:
    """What cancels in the pitch point is no difference: the rack's acceleration is nothing beside the wheel's."""
    rack = parse(TEXTS["rack"].split("[[drive]]")[0].replace("'4' = 'B'\n", "")
                 .replace("'frame' = 'O'", "'frame' = 'B'").replace(slide("4", "B", "[4, 3]"), "")
                 .replace("O = [0, 0]\n", "") + "[[drive]]\nlink = '2'\nomega = 2\n", "rack")
    turn = gp.cycle.follow(rack, 5, (0, 90))
    drawing = gp.construct(rack)
    part = PoseBatch.of_reached(rack, turn.points, turn.guides)
    results = drawing.evaluate(part.points, part.guides).results
    apart = pose_gaps(part, drawing, results)
    assert max(abs(results["acceleration"]["S"])) > 0
    assert sound_poses(part, drawing, results, apart).all()


def test_where_two_arcs_meet_the_acceleration_jumps(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Ozols, fig. 5-33: at the point where the arc about C is followed by one about D velocities agree, accelerations
    do not: both are printed, and the construction says which it draws."""
    scene = tmp_path / "cam.toml"
    scene.write_text(f'{ARC_CAM}[find]\nvelocity = ["A"]\nacceleration = ["A"]\n')
    assert main(["solve", str(scene)]) == 0
    told = json.loads(capsys.readouterr().out)
    before, after = told["points"]["A"], told["beyond"]["points"]["A"]
    assert before["velocity"] == pytest.approx(after["velocity"])
    assert [abs(before["velocity"][1]), before["acceleration"][1], after["acceleration"][1]] == pytest.approx(
        [319.276, -981.278, -5336.199], rel=1e-5)
    assert any("accelerations jump" in note for note in gp.construct(gp.load(scene)).notes)
    with pytest.raises(gp.SceneError, match="arcs that follow"):
        parse(scene.read_text().replace('next = ["D"', 'next = ["C"'), "cam")


@pytest.mark.parametrize("name", ["roller-cam", "planetary"])
def test_no_normal_acceleration_is_laid_off_along_the_line_of_centres(name: str) -> None:
    """The locus of a point of contact runs along the line of centres: from where the figure begins at a wheel's centre
    it is drawn without the point's normal acceleration, and the turning is read without it."""
    drawing = report(gp.load(name)).drawing
    program, wheels = drawing.program, rolling_guides(with_lower_pairs(drawing.scene))
    contacts = {step.index for step in program.steps for guide in wheels if step.name == guide.at}
    normals = [step for step in program.steps if step.op.name == "normal"]
    loci = [step for step in program.steps if step.op.name == "parallel" and "line of centres" in step.why]
    assert loci
    assert not [step for step in normals if step.args[0] in contacts or step.args[1] in contacts]
