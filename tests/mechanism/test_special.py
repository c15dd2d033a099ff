"""Machines that move by special geometry: read, told which pair is redundant, solved, and refused when spoiled."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from random import Random
from typing import Any

import numpy as np
import pytest
from packaged_scenes import those
from special_machines import MACHINES, Machine

from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.cycle import follow
from graphplan.errors import SceneError, SingularPose
from graphplan.mechanism.model import FRAME, Scene, SlidingDrive
from graphplan.mechanism.scene import load, parse
from graphplan.mechanism.structure import general_mobility, mobility, structure
from graphplan.methods.panels import redundancies
from graphplan.solver import power, reactions, solve

every = pytest.mark.parametrize("machine", MACHINES, ids=[machine.name for machine in MACHINES])


@every
def test_it_is_read_and_its_redundant_pair_is_named(machine: Machine) -> None:
    """The count says that it cannot move; it is read, with the pairs that are redundant, and has one freedom."""
    scene = parse(machine.text(), machine.name)
    assert (mobility(scene), scene.redundant_pairs) == (machine.count, machine.redundant)
    assert structure(scene).mobility == 1


@every
def test_what_is_redundant_is_by_the_rank_beside_the_pose(machine: Machine) -> None:
    """By differences of the closure: in the pose one freedom and what repeats; with random points and guides near it
    as many freedoms as the note says."""
    scene, chance = parse(machine.text(), machine.name), Random(15)
    reach = max(abs(complex(*map(float, at))) for at in scene.points.values())
    size = 3 * len(scene.moving)

    def rank(scene: Scene) -> int:
        left = gaps(scene, np.zeros(size), 0, reach)
        slopes = [(gaps(scene, nudge, 0, reach) - left)[:-1] / 1e-7 for nudge in 1e-7 * np.eye(size)]
        return int(np.linalg.matrix_rank(np.array(slopes), tol=1e-5))

    def any_near(at: Any, by: float) -> Any:
        return tuple(float(part) + by * chance.uniform(-1, 1) for part in at)

    beside = scene.with_pose({name: any_near(at, reach / 4) for name, at in scene.points.items()},
                             lambda guide: any_near(guide.direction, float(max(map(abs, guide.direction))) / 4),
                             lambda radius: radius)
    assert size - rank(scene) == 1
    assert size - rank(beside) == general_mobility(scene)
    assert all(f"would be {general_mobility(scene)}, by special geometry it is 1" in str(note)
               for note in redundancies(scene))


@every
def test_the_order_of_writing_means_nothing(machine: Machine) -> None:
    """Points, links and slides in any order give the same redundant conditions and the same rates."""
    scene, chance = parse(machine.text(), machine.name), Random(1909)
    rates = solve(scene, exact=True)
    for _ in range(3):
        mixed = parse(machine.text(shuffled=chance), machine.name)
        assert (mixed.redundant, set(mixed.repeating)) == (scene.redundant, set(scene.repeating))
        again = solve(mixed, exact=True)
        assert (again.velocity, again.acceleration, again.omega) == (rates.velocity, rates.acceleration, rates.omega)


@pytest.mark.parametrize("machine", [machine for machine in MACHINES if machine.free], ids=lambda machine: machine.name)
def test_spoiled_by_a_little_it_is_refused(machine: Machine) -> None:
    """One point shifted by a millionth: it cannot move, and is refused as any other scene of this count."""
    with pytest.raises(SceneError, match=f"mobility {machine.count} but|can shake"):
        parse(machine.spoiled().text(), machine.name)


@every
def test_it_is_constructed_exactly(machine: Machine) -> None:
    """The construction never needs what is redundant, and agrees with the solver as fractions."""
    found = report(parse(machine.text(), machine.name), exact=True)
    assert found.check == {"velocity": 0, "acceleration": 0}
    assert any("redundant" in note for note in found.drawing.notes)


@every
def test_reactions_that_statics_cannot_tell_are_left_out(machine: Machine) -> None:
    """A dyad that hangs on the machine has reactions; of the machine, those that repeat have none, but the balance is
    that of the power, and each reaction that is told is in equilibrium with the others."""
    scene = parse(loaded(machine), machine.name)
    found = reactions(scene, exact=True)
    assert found.balances == power(scene, exact=True)
    told = {f"{link} at {p}" for p, link in found.joints} | set(found.slides)
    pairs = {f"{link} at {p}" for p in scene.joints for link in scene.links_of[p][1:]} | {s.name for s in scene.slides}
    assert set(scene.indeterminate_pairs) == pairs - told
    assert {"Y at Z1", "Y at Z2"} <= told
    floats = reactions(scene)
    size = max(abs(float(part)) for force in found.joints.values() for part in force)
    for name, force in found.joints.items():
        assert tuple(map(float, force)) == pytest.approx(floats.joints[name], abs=1e-9 * size)


def loaded(machine: Machine) -> str:
    """The scene with a dyad that hangs on a moving point of link 1, a load on it, and a balance on the drive."""
    T = next(p for p in machine.links["1"].split() if p not in machine.links["frame"].split())
    (x, y), unit = machine.places[T], max(abs(part) for at in machine.places.values() for part in at)
    points = machine.places | {"Z1": (x + 2 * unit, y + unit), "Z2": (x + 3 * unit, y - unit)}
    links = {**machine.links, "X": f"{T} Z1", "Y": "Z1 Z2", "frame": machine.links["frame"] + " Z2"}
    balance = f'at = "{T}"\non = "1"\ndirection = [1, 0]' if "/" in machine.drive else 'link = "1"'
    load = f'[balance]\n{balance}\n[[forces]]\non = "Y"\nat = "Z1"\nvalue = [-7, 5]'
    return replace(machine, points=points, links=links).text(load)


@every
def test_its_rates_are_those_of_its_closure(machine: Machine) -> None:
    """As the drive goes on all conditions are met, redundant ones too, and the links turn as they are solved to."""
    scene = parse(machine.text(), machine.name)
    omega, step, drive = solve(scene).omega, 1e-4, scene.drives[0]
    sliding = isinstance(drive, SlidingDrive)
    reach = max(abs(complex(*map(float, at))) for at in scene.points.values())
    pace = float(drive.rate) / (reach if sliding else 1)
    ahead, behind = (closed(scene, sign * step, reach) for sign in (1, -1))
    fastest = max(abs(pace), *(abs(float(value)) for value in omega.values()))
    for k, link in enumerate(scene.moving):
        turned = (ahead[3 * k + 2] - behind[3 * k + 2]) / (2 * step) * pace
        assert turned == pytest.approx(float(omega[link]), abs=1e-4 * fastest)


def closed(scene: Scene, travel: float, reach: float) -> Any:
    """The pose after a small travel, of every moving link x, y and turn: found by Newton's method in least squares."""
    pose = np.zeros(3 * len(scene.moving))
    for _ in range(8):
        left = gaps(scene, pose, travel, reach)
        slopes = [(gaps(scene, pose + nudge, travel, reach) - left) / 1e-7 for nudge in 1e-7 * np.eye(len(pose))]
        pose = pose - np.linalg.lstsq(np.array(slopes).T, left, rcond=1e-9)[0]
    assert np.abs(gaps(scene, pose, travel, reach)).max() < 1e-12
    return pose


def gaps(scene: Scene, pose: Any, travel: float, reach: float) -> Any:
    """By how much each pair and the drive are not met."""
    moved = {link: pose[3 * k : 3 * k + 3] for k, link in enumerate(scene.moving)} | {FRAME: np.zeros(3)}

    def turn(link: str) -> complex:
        return complex(np.exp(1j * moved[link][2]))

    def place(link: str, point: str) -> complex:
        return complex(*moved[link][:2]) + turn(link) * complex(*map(float, scene.points[point])) / reach

    joints = [place(link, p) - place(links[0], p) for p, links in scene.links_of.items() for link in links[1:]]
    slips = {(s.link, s.along): (place(s.link, s.at) - place(s.along, s.at)) / complex(*map(float, s.direction))
             / turn(s.along) * abs(complex(*map(float, s.direction))) for s in scene.slides}
    drive = scene.drives[0]
    driven = slips[drive.links].real if isinstance(drive, SlidingDrive) else moved[drive.link][2]
    return np.array([*(part for gap in joints for part in (gap.real, gap.imag)), *(gap.imag for gap in slips.values()),
                     *(moved[s.link][2] - moved[s.along][2] for s in scene.slides), driven - travel])


CONCURRENT = Machine("three bars that meet in one point",
                     {"O": (0, 0), "C": (30, 0), "E": (-60, 0), "A": (0, 10), "B": (15, 15), "D": (-15, "22.5")},
                     {"1": "O A", "2": "A D B", "3": "C B", "4": "E D", "frame": "O C E"})


def test_links_that_can_but_shake_are_told() -> None:
    """A plate on three bars whose lines meet has a velocity, but accelerations contradict: it does not move."""
    with pytest.raises(SceneError, match="links 1 2 3 4 can shake in this pose but not move"):
        parse(CONCURRENT.text(), "shaky")


def test_a_drive_that_special_geometry_forbids_is_singular() -> None:
    """The coupler of a parallelogram does not turn: to turn it is impossible, whatever else is redundant."""
    with pytest.raises(SingularPose, match="the prescribed motion is impossible here"):
        report(parse(replace(MACHINES[0], drive="2").text(), "coupler"))


def test_a_pose_in_which_motions_branch_is_told() -> None:
    """Three cranks in one line with their coupler may go on in several ways."""
    flat = {"O": (0, 0), "E": (20, 0), "C": (40, 0), "A": (13, 0), "D": (33, 0), "B": (53, 0)}
    with pytest.raises(SceneError, match="mobility 2 in this pose alone"):
        parse(replace(MACHINES[0], points=flat).text(), "flat")


PLACED = """
[points]
O = [0, 0]
C = [40, 0]
E = [20, 0]
A = { from = "O", distance = 13, angle = 20 }
B = { distances = { A = 40, C = 13 }, side = "left" }
D = { on = "A B", distance = 20 }
[links]
1 = "O A"
2 = "A D B"
3 = "C B"
4 = "E D"
frame = "O E C"
[[drive]]
link = "1"
rpm = 10
"""


def test_special_geometry_is_seen_in_irrational_poses() -> None:
    """Placed by protractor, compasses and ruler the three cranks are parallel to all digits, though floats round."""
    assert parse(PLACED, "placed").redundant_pairs == ("4 at D",)
    with pytest.raises(SceneError, match="mobility 0 but 1 drive"):
        parse(PLACED.replace("distance = 20 }", "distance = 20.00000000000000001 }"), "nearly")


@every
def test_any_link_may_drive_it(machine: Machine) -> None:
    """Whatever link or slide is driven, the construction is exact, or the pose is singular for that drive."""
    slides = [f"{link}/{along}" for link, along, *_ in machine.slides]
    for drive in [*(link for link in machine.links if link != FRAME), *slides]:
        try:
            scene = parse(replace(machine, drive=drive).text(), machine.name)
        except SceneError:  # its drive says what a slide does: the link does not turn
            assert slides
            assert drive in machine.links
            continue
        try:
            assert not any(report(scene, exact=True).check.values()), drive
        except SingularPose:
            with pytest.raises(SingularPose):
                solve(scene, exact=True)


@every
def test_what_hangs_on_it_has_its_reactions_drawn(machine: Machine) -> None:
    """The reactions in the dyad are drawn, and the balance; those that equilibrium does not tell are noted."""
    scene = parse(loaded(machine), machine.name)
    found, told = report(scene, exact=True), reactions(scene, exact=True)
    assert found.check["force"] == 0
    drawn = {*found.results.get("reaction", {}), *found.results.get("slide reaction", {})}
    assert {"Y at Z1", "Y at Z2"} <= drawn <= {f"{link} at {point}" for point, link in told.joints} | set(told.slides)
    assert {"lever", "lever moment"} & found.results.keys()
    assert any("statically indeterminate" in note for note in found.drawing.notes)


def test_a_reaction_that_statics_cannot_tell_is_null_by_name() -> None:
    """What is asked for and statically indeterminate is null, with the reason; the others at its joint are told."""
    text = loaded(MACHINES[0]) + '\n[find]\nreactions = ["{}"]'
    for point, name in ("D", "4 at D"), ("A", "2 at A"):
        told = result_data(report(parse(text.format(point), "asked")))
        assert told["indeterminate"] == [name]
        assert "statically indeterminate" in told["reasons"]["reactions"][name]
        null = [f"{one['on']} at {one['at']}" for one in told["reactions"] if one["force"] is None]
        assert null == [name]


@pytest.mark.parametrize("name", those(lambda scene: not scene.motions))
def test_a_bar_too_many_changes_nothing(name: str) -> None:
    """A bar between two points of one link is told as redundant or makes another so, and the rates stay the same."""
    text, scene, chance = load(name).text, load(name), Random(name)
    link = chance.choice([link for link in scene.moving if len(scene.links[link]) > 1])
    one, two = chance.sample(scene.links[link], 2)
    doubled = parse(text.replace("[links]", f'[links]\nbar = "{one} {two}"', 1), name)
    assert doubled.redundant
    found = report(doubled, exact=not doubled.irrational)
    assert found.agrees
    assert all(float(found.rates.omega[k]) == pytest.approx(omega, abs=1e-9) for k, omega in solve(scene).omega.items())


@pytest.mark.parametrize("machine", [m for m in MACHINES if "/" not in m.drive], ids=lambda machine: machine.name)
def test_it_is_followed_around_its_cycle(machine: Machine) -> None:
    """From the given pose it goes on, all its lengths kept, and construction and solver agree there."""
    scene = parse(machine.text(), machine.name)
    points = follow(scene, 9, (-4, 4)).points
    for link, named in scene.links.items():
        for one, other in combinations(named, 2):
            lengths = np.abs(points[one] - points[other])
            assert lengths == pytest.approx(np.full(9, lengths[4]), rel=1e-9), link


SPOILED = """
[points]
A = [0, 0]
B = [50, 45]
C = [200, 1e308]
F = [300, 50]
G = [300, 90]
[links]
1 = "A B C"
2 = "F G"
3 = "B G"
frame = "F B G"
[[slides]]
link = "1"
along = "frame"
at = "A"
direction = "A C"
[[drive]]
link = "2"
omega = 1
"""


def test_a_guide_by_a_faulty_point_is_told_by_the_point() -> None:
    """What special geometry would say of a scene with faults does not hide them."""
    with pytest.raises(SceneError, match=r"points\.C: 1e308 is not a usable number"):
        parse(SPOILED, "spoiled")
