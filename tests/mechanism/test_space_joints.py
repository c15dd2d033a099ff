"""Joints in space drawn in the plane: Cardan joints, single and double, and swash plates, against their formulas."""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.trusted import report
from graphplan.commands.new import template
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse

DIRECTIONS = [(3, 4), (-4, 3), (12, -5), (-8, -15), (15, 8), (1, 0), (0, -1)]


def cardan(c: Fraction, way: tuple[int, int], omega: int = 10, alpha: int = 0, double: bool = False) -> Scene:
    """A Cardan joint of the cosine c whose arm, turned down, has this direction; the trace is the x-axis.

    A double one leads on to a third shaft 6 at the same angle.
    """
    long = math.isqrt(way[0] ** 2 + way[1] ** 2)
    points, links, tables = ["O = [0, 0]"], {"1": "O", "2": "O", "frame": "O"}, ""
    for shaft, cross, block, size in [("1", "3", "4", 12), *([("6", "7", "8", 6)] if double else [])]:
        x, y = (size * part for part in way)
        A, M = [float(x), float(y * c)], [float(x * (1 + c) / 2), float(y * (1 + c) / 2)]
        radii = [float(long * size * (1 + c) / 2), float(long * size * (1 + c))]
        points += [f"A{cross} = {A}", f"M{cross} = {M}"]
        links |= {shaft: "O", "2": f"{links['2']} M{cross}", cross: f"M{cross} A{cross}", block: f"A{cross}"}
        tables += (f'[[gears]]\nlinks = ["{cross}", "frame"]\ncentres = ["M{cross}", "O"]\ninternal = true\n'
                   f'radii = {radii}\n[[slides]]\nlink = "{block}"\nalong = "{shaft}"\n'
                   f'at = "A{cross}"\ndirection = {A}\n')
    text = "\n".join(["[points]", *points, "[links]", *(f'{name} = "{names}"' for name, names in links.items()), tables,
                      f'[[drive]]\nlink = "1"\nomega = {omega}\nalpha = {alpha}'])
    return parse(text, "cardan")


@pytest.mark.parametrize("seed", range(8))
def test_the_driven_shaft_turns_as_the_formulas_say(seed: int) -> None:
    """Ozols (7.11) and its derivative, as fractions: construction, solver and formulas are equal."""
    chance = Random(seed)
    way, c = chance.choice(DIRECTIONS), Fraction(chance.randrange(3, 10), 10)
    w, e = chance.randrange(1, 9), chance.randrange(-9, 9)
    checked = report(cardan(c, way, w, e), exact=True)
    assert set(checked.check.values()) == {0}
    u, v = Fraction(way[0]), way[1] * c
    square = u * u + v * v
    below = (c * c * u * u + v * v) / square
    slope = 2 * u * v / square * (1 - c * c)
    assert checked.results["omega"]["2"] == c * w / below
    assert checked.results["alpha"]["2"] == c * e / below - c * w * w * slope / below**2


@pytest.mark.parametrize(("degrees", "printed"), [(5, 0.0076), (10, 0.0306), (15, 0.0693), (20, 0.1245), (30, 0.2887)])
def test_unevenness_by_the_table(degrees: int, printed: float) -> None:
    """Ozols (7.13): (omega_max - omega_min) / omega_1 of the driven shaft, from the speeds in its two extreme poses."""
    c = Fraction(f"{math.cos(math.radians(degrees)):.6f}")
    fast, slow = (float(report(cardan(c, way)).results["omega"]["2"]) for way in ((1, 0), (0, 1)))
    assert (fast - slow) / 10 == pytest.approx(printed, abs=1e-4)


def test_its_arms_stay_square_in_space() -> None:
    """All around, the arm OA, raised back into its plane, keeps its length and is square to the other fork's arm."""
    scene = cardan(Fraction(4, 5), (4, 3))
    poses = gp.follow(scene, 48)
    A, phi = poses.points["A3"], np.angle(poses.points["M3"])
    raised = np.stack([A.real, A.imag, 60 * 0.6 * np.sin(phi)])
    assert np.linalg.norm(raised, axis=0) == pytest.approx(60)
    turned = np.radians(poses.travel) + math.atan2(28.8, 48)
    arm = np.stack([-np.sin(turned), np.cos(turned), 0 * turned])
    assert (raised * arm).sum(axis=0) == pytest.approx(0, abs=1e-9 * scene.extent)
    assert np.ptp(np.unwrap(phi)) > 6


def test_a_double_joint_runs_evenly() -> None:
    """Ozols (7.14): with equal angles and forks in one plane the third shaft turns as the first, exactly."""
    results = report(cardan(Fraction(3, 5), (4, 3), 10, 3, double=True), exact=True).results
    assert (results["omega"]["6"], results["alpha"]["6"]) == (10, 3)
    assert results["omega"]["2"] != 10


def test_the_flywheel_takes_the_joint() -> None:
    """Reduced inertia I (omega_2/omega_1)^2 and reduced moment M omega_2/omega_1 at every plan, by (7.11)."""
    loads = ('[masses.2]\nmass = 5\ninertia = 0.3\ncentre = "O"\n[[moments]]\non = "2"\nvalue = -40\n'
             "[flywheel]\nspeed = 10\nunevenness = 0.02\n")
    data: Any = gp.flywheel(parse(f"{cardan(Fraction(4, 5), (4, 3)).text}\n{loads}", "pump")).json()
    for (travel, inertia), (_, moment) in zip(data["reduced_inertia"], data["reduced_moment"], strict=True):
        phi = math.radians(travel) + math.atan2(28.8, 48)
        ratio = 0.8 / (0.64 * math.cos(phi) ** 2 + math.sin(phi) ** 2)
        assert inertia == pytest.approx(0.3 * ratio**2)
        assert moment == pytest.approx(-40 * ratio)


def test_the_template_has_both() -> None:
    """Its shaft 2 turns by (7.11), and its piston goes by R tan alpha cos phi, as fractions."""
    results = report(parse(template("joints"), "joints"), exact=True).results
    ratio = Fraction(4, 5) * (25 + 9) / (Fraction(16, 25) * 25 + 9)
    assert results["omega"]["2"] == 2 * ratio
    assert results["velocity"]["B"] == (-24 * 2 * ratio, 0)
