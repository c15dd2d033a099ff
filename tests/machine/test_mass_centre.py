"""The mass centre by principal vectors, over the cycle, beside textbook values and the solver."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from itertools import count
from pathlib import Path

import numpy as np
import pytest
from linkages_with_masses import four_bar, slider_crank

from graphplan.check.balance import balancing, mass_motion
from graphplan.commands import main
from graphplan.errors import Refused
from graphplan.kernel.claims import broken_claims
from graphplan.machine.linkages.mass_centre import mass_centre
from graphplan.mechanism.model import Loads, Mass, Scene
from graphplan.mechanism.scene import load, parse

OFFSET = [(2, 0.06, 0.02), (3, 0.2, -0.03), (4, 0.12, 0.01)]
STRAIGHT = [(m, s, 0) for m, s, _ in OFFSET]


def test_principal_vectors_of_a_four_bar() -> None:
    """Ozols (16.8), (16.9), in numbers: h = 0.0911111, 0.2222222, 0.0533333 m; S where the offsets lead it."""
    found = mass_centre(four_bar(STRAIGHT))
    lengths = [float(v.along) * long for v, long in zip(found.vectors, (0.1, 0.35, 0.3), strict=True)]
    assert lengths == pytest.approx([0.0911111, 0.2222222, 0.0533333], abs=5e-8)
    assert not any(vector.across for vector in found.vectors)
    aside = mass_centre(four_bar(OFFSET))
    assert aside.values.values_of_role("S")[0] == pytest.approx((0.257904, 0.139965), abs=5e-7)


@pytest.mark.parametrize("scene", [four_bar(OFFSET), slider_crank(OFFSET)], ids=["four-bar", "slider-crank"])
def test_steps_keep_their_claims(scene: object) -> None:
    """Each step of the construction is what it says, and each link's principal point is marked on it."""
    found = mass_centre(scene)  # type: ignore[arg-type]
    assert not [*broken_claims(found.drawing.program, found.values.numbers)]
    assert {step.name for step in found.drawing.program.steps} >= {"H_1", "H_2", "H_3", "S"}


@pytest.mark.parametrize("scene", [four_bar(OFFSET), slider_crank(OFFSET)], ids=["four-bar", "slider-crank"])
def test_opinions_agree_over_the_cycle(scene: object) -> None:
    """Path, velocity, acceleration, shaking force and moment are those of the solver, to rounding."""
    found = mass_motion(scene, 24)  # type: ignore[arg-type]
    assert {*found.check} == {"path", "velocity", "acceleration", "shaking force", "shaking moment"}
    assert max(found.check.values()) < 1e-13
    m = float(found.centre.mass)
    assert np.abs(found.shaking.force + m * found.acceleration).max() < 1e-12 * np.abs(found.shaking.force).max()


def test_travel_counts_as_the_drive_moves() -> None:
    """A crank that turns clockwise goes through the same poses the other way round, with the same forces."""
    given = four_bar(OFFSET)
    there, back = (mass_motion(parse(given.text.replace("omega = 10", f"omega = {omega}"), "linkage"), 8)
                   for omega in (10, -10))
    assert there.links.travel == pytest.approx(back.links.travel)
    assert there.links.closes
    assert np.abs(there.path - np.roll(back.path[::-1], 1)).max() < 1e-15
    assert np.abs(there.shaking.force - np.roll(back.shaking.force[::-1], 1)).max() < 1e-11


ARM = """
[points]
O = [0, 0]
A = [60, 80]
T = [100, 100]
[links]
arm = "O A"
0 = "A T"
frame = "O"
[[drive]]
link = "arm"
omega = 3
[[drive]]
link = "0"
omega = -6
relative_to = "arm"
[masses.arm]
mass = 2
centre = "A"
[masses.0]
mass = 1.5
centre = "T"
"""


def test_open_chains_and_drives_at_rest() -> None:
    """Open chains with a drive in each joint are followed, too, and drives that stand still shake nothing."""
    assert max(mass_motion(parse(ARM, "arm", by_drive=True), 12).check.values()) < 1e-12
    still = mass_motion(parse(four_bar(OFFSET).text.replace("omega = 10", "omega = 0"), "still"), 12)
    assert max(still.check.values()) < 1e-12
    assert np.abs(still.shaking.force).max() < 1e-12


@pytest.mark.parametrize("name", ["walschaerts-loaded", "jaanimets-10", "slotted-link", "wheel-on-rail", "geneva",
                                  "racks", "planetary", "plough-lift", "ozols-5-5", "gear-linkage"])
def test_masses_anywhere(name: str) -> None:
    """Linkages with slides, gears and contacts are followed with masses on all links, and balanced where they can be.
    """
    given, number = load(name), count(1)
    masses = {link: Mass(Fraction(next(number)), Fraction(1, 100), given.links[link][-1]) for link in given.moving}
    loads = replace(given.loads, frictions=()) if given.loads else Loads((0, 0), {}, (), (), ())
    found = balancing(replace(given, loads=replace(loads, masses=masses)), 4)
    assert max(found.check.values()) < 1e-9
    assert found.weights or "cannot be balanced" in found.note


def test_masses_that_replace_the_rod_of_example_9_1() -> None:
    """Ozols, example 9-1: static masses 13.3 and 6.7, dynamic ones 9, 4.5 and 6.5 kg, and a moment 48.1 % off."""
    found = mass_motion(load("ozols-9-1"), 12)
    rod = next(one for one in found.replaced_masses if one.link == "2")
    assert rod.pins == ("A", "B")
    assert rod.static == pytest.approx((40 / 3, 20 / 3))
    assert rod.dynamic == pytest.approx((9, 6.5, 4.5))
    inertia = 0.15 * 0.48**2 * 20
    assert rod.inertia_left / inertia == pytest.approx(-0.160 * 0.320 / (0.15 * 0.48**2) + 1)
    assert found.check["replaced masses"] < 1e-12


@pytest.mark.parametrize("scene", [four_bar(STRAIGHT), slider_crank(STRAIGHT)], ids=["four-bar", "slider-crank"])
def test_replaced_masses(scene: Scene) -> None:
    """Masses at points have each link's force and, with what two leave, its moment; none replace a link whose mass
    centre is beside the line of its pins."""
    masses = scene.loads.masses if scene.loads else {}
    heavy = {link: replace(mass, inertia=Fraction(k, 300)) for k, (link, mass) in enumerate(masses.items(), 1)}
    assert scene.loads
    found = mass_motion(replace(scene, loads=replace(scene.loads, masses=heavy)), 24)
    assert found.replaced_masses
    assert found.check["replaced masses"] < 1e-12
    for one in found.replaced_masses:
        assert sum(one.static) == pytest.approx(sum(one.dynamic)) == pytest.approx(float(masses[one.link].mass))
    assert not mass_motion(four_bar(OFFSET), 3).replaced_masses


def test_no_masses() -> None:
    """Where nothing has a mass there is no mass centre."""
    with pytest.raises(Refused, match="no moving link has a mass"):
        mass_centre(load("four-bar"))


def test_command(tmp_path: Path) -> None:
    """`graphplan balance` writes the numbers as JSON and the table as text."""
    task, out = tmp_path / "scene.toml", tmp_path / "out.json"
    task.write_text(four_bar(OFFSET).text)
    assert main(["balance", str(task), "-q", "--positions", "24", "-o", str(out)]) == 0
    found = json.loads(out.read_text())
    assert [row[0] for row in found["mass_centre"]["path"]] == pytest.approx([15.0 * k for k in range(24)])
    assert found["mass_centre"]["path"][0][1:] == pytest.approx([0.257904, 0.139965], abs=5e-7)
    assert {"shaking_force", "shaking_moment", "principal_vectors", "check"} <= {*found}
    assert main(["balance", str(task), "-q", "--positions", "24", "-o", str(out.with_suffix(".csv"))]) == 0
    assert len(out.with_suffix(".csv").read_text().splitlines()) == 25
    assert main(["balance", "four-bar"]) == 2
