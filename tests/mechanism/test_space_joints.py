"""Joints in space drawn in the plane: Cardan joints, single and double, and swash plates, against their formulas."""

from __future__ import annotations

import csv
import io
import math
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from face import ran

import graphplan as gp

JOINTS = Path(__file__).parents[1] / "cases" / "joints"


def joint(name: str, **changed: Any) -> gp.WrittenScene:
    """A scene of a joint with other values at some paths, whose dots are written as two underlines."""
    return gp.load(JOINTS / f"{name}.toml").replace({path.replace("__", "."): value for path, value in changed.items()})


def exactly(scene: gp.WrittenScene) -> Any:
    """What `solve --exact` prints of a scene, on which construction and solver must agree."""
    data = ran("solve", "-", "--exact", given=scene.text).json
    assert {*data["check"].values()} == {0}
    return data


def rates(data: Any, link: str) -> tuple[Fraction, Fraction]:
    """The angular velocity and acceleration of a link."""
    return Fraction(data["links"][link]["omega"]), Fraction(data["links"][link]["alpha"])


@pytest.mark.parametrize("seed", range(8))
def test_the_driven_shaft_turns_as_the_formulas_say(seed: int) -> None:
    """Ozols (7.11) and its derivative, as fractions, of random joints: construction, solver and formulas are equal."""
    chance = Random(seed)
    u, v, t, s = (chance.randrange(10, 60) * chance.choice((1, -1)) for _ in range(4))
    c, w, e = Fraction(chance.randrange(3, 10), 10), chance.randrange(1, 9), chance.randrange(-9, 9)
    scene = joint("cardan", points__A=(3 + u, -2 + v), joints__0__angle={"cosine": float(c)}, joints__0__trace=(t, s),
                  drive__0__omega=w, drive__0__alpha=e)
    square = (u * u + v * v) * (t * t + s * s)
    cos2, sin2 = Fraction((u * t + v * s) ** 2, square), Fraction((v * t - u * s) ** 2, square)
    product = Fraction((u * t + v * s) * (v * t - u * s), square)
    below = c * c * cos2 + sin2  # tan phi_2 = tan phi_1 / c
    omega, alpha = c * w / below, c * e / below - c * w * w * 2 * product * (1 - c * c) / below**2
    assert rates(exactly(scene), "2") == (omega, alpha)


@pytest.mark.parametrize(("degrees", "printed"), [(5, 0.0076), (10, 0.0306), (15, 0.0693), (20, 0.1245), (30, 0.2887)])
def test_unevenness_by_the_table(degrees: int, printed: float) -> None:
    """Ozols (7.13): (omega_max - omega_min) / omega_1 of the driven shaft, from the speeds in its two extreme poses."""
    fast, slow = (gp.solve(joint("cardan", points__A=(3 + x, -2 + y), joints__0__angle=degrees)).omega["2"]
                  for x, y in ((50, 0), (0, 50)))
    assert fast - slow == pytest.approx(printed, abs=1e-4)


def test_its_arms_stay_square_in_space() -> None:
    """All around, the arm OA, raised back into its plane, keeps its length and is perpendicular to the other fork's
    arm."""
    scene = joint("cardan", joints__0__angle={"cosine": 0.8})
    poses = gp.follow(scene, 48)
    A, M = (poses.points[name] - complex(3, -2) for name in ("A", "M3"))
    phi = np.angle(M)
    raised = np.stack([A.real, A.imag, np.sin(phi) * 0.6 * abs(M) / 0.9])
    assert np.linalg.norm(raised, axis=0) == pytest.approx(abs(M[0]) / 0.9)
    turned = np.radians(poses.travel) + math.atan2(28, 48)
    arm = np.stack([-np.sin(turned), np.cos(turned), 0 * turned])
    assert (raised * arm).sum(axis=0) == pytest.approx(0, abs=1e-9 * float(scene.extent))
    assert np.ptp(np.unwrap(phi)) > 6


def test_a_double_joint_runs_evenly() -> None:
    """Ozols (7.14): with equal angles and forks in one plane the third shaft turns as the first, exactly."""
    data = exactly(joint("double"))
    assert rates(data, "4") == (10, 3)
    assert rates(data, "2") != (10, 3)


def test_the_diagrams_of_a_double_joint_are_of_its_middle_shaft(tmp_path: Path) -> None:
    """A shaft that shows no side, as that along which a joint is seen, has no angle to plot."""
    steady = joint("double", drive__0__alpha=0).text
    for of, status in ((), 0), (("--of", "2"), 0), (("--of", "4"), 2):
        plot = "--plot", tmp_path / f"plot{len(of)}.svg", *of
        assert ran("cycle", "-", "--positions", "12", *plot, given=steady).status == status
        if status == 0:
            assert "link 2" in (tmp_path / f"plot{len(of)}.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize("seed", range(4))
def test_a_swash_plate_moves_its_piston(seed: int) -> None:
    """s = R tan alpha cos phi, and its derivatives, as fractions."""
    chance = Random(seed)
    x, y = chance.choice([(30, 40), (-40, 30), (5, -12), (-8, -15), (0, 7)])
    k, w, e = Fraction(chance.randrange(1, 20), 10), chance.randrange(1, 9), chance.randrange(-9, 9)
    piston = exactly(joint("swash-plate", points__E=(x, y), joints__0__angle={"tangent": float(k)}, drive__0__omega=w,
                           drive__0__alpha=e))["points"]["B"]
    cosine, sine = Fraction(x, math.isqrt(x * x + y * y)), Fraction(y, math.isqrt(x * x + y * y))
    assert [*map(Fraction, piston["velocity"])] == [-60 * k * sine * w, 0]
    assert [*map(Fraction, piston["acceleration"])] == [-60 * k * (cosine * w * w + sine * e), 0]


@pytest.mark.parametrize("seed", range(6))
def test_a_swinging_fork_swings_as_the_formulas_say(seed: int) -> None:
    """Ozols (8.23) to (8.25): tan theta = tan alpha cos phi and its derivatives, as fractions, with any pivot."""
    chance = Random(seed)
    (x, y), (u, v) = (chance.choice([(30, 40), (-40, 30), (5, -12), (-8, -15), (20, 21)]) for _ in range(2))
    k, w, e = Fraction(chance.randrange(1, 20), 10), chance.randrange(1, 9), chance.randrange(-9, 9)
    fork = joint("fork", points__E=(3 + x, 2 + y), points__Q=(3 + 4 * u, 2 + 4 * v), drive__0__alpha=e,
                 joints__0__angle={"tangent": float(k)}, drive__0__omega=w)
    long, far = math.isqrt(x * x + y * y), math.isqrt(u * u + v * v)
    ahead = Fraction(v * x - u * y, long * far)  # cos phi, from where the fork leans most
    aside = Fraction(u * x + v * y, long * far)
    below = 1 + k * k * ahead**2
    theta1, theta2 = -k * aside / below, -k * ahead / below + 2 * k**3 * ahead * aside**2 * -1 / below**2
    omega, alpha = rates(exactly(fork), "2")
    assert (abs(omega), abs(alpha)) == (abs(theta1 * w), abs(theta2 * w * w + theta1 * e))


def test_fork_of_ozols_has_six_extrema_of_acceleration() -> None:
    """(8.25) has two extrema of acceleration a turn to 24 degrees 6 minutes, six beyond."""
    def extrema(degrees: float) -> int:
        fork = joint("fork", points__E=(53, 2), points__Q=(3, -78), joints__0__angle=degrees)
        rows = csv.DictReader(io.StringIO(ran("cycle", "-", "--positions", "720", given=fork.text).out))
        alpha = [float(row["2.alpha [rad/s^2]"]) for row in rows]
        return int(np.count_nonzero(np.diff(np.sign(np.diff([*alpha, *alpha[:2]])))))

    assert (extrema(20), extrema(30)) == (2, 6)


def test_the_flywheel_takes_the_joint() -> None:
    """Reduced inertia I (omega_2/omega_1)^2 and reduced moment M omega_2/omega_1 at every plan, by (7.11)."""
    data = ran("flywheel", JOINTS / "pump.toml").json
    for (travel, inertia), (_, moment) in zip(data["reduced_inertia"], data["reduced_moment"], strict=True):
        phi = math.radians(travel) + math.atan2(28, 48)
        ratio = 0.8 / (0.64 * math.cos(phi) ** 2 + math.sin(phi) ** 2)
        assert inertia == pytest.approx(0.3 * ratio**2)
        assert moment == pytest.approx(-40 * ratio)


def test_the_template_has_all() -> None:
    """Its shaft 2 turns by (7.11), its piston goes by R tan alpha cos phi and its fork swings by (8.24), as fractions;
    the keys that all joints have are not told of one in the words of another."""
    template = ran("new", "-", "--kind", "joints").out
    data = exactly(gp.parse(template))
    ratio = Fraction(4, 5) * (48**2 + 28**2) / (Fraction(16, 25) * 48**2 + 28**2)
    assert rates(data, "2")[0] == 2 * ratio
    assert [*map(Fraction, data["points"]["B"]["velocity"])] == [-24 * 2 * ratio, 0]
    assert abs(rates(data, "6")[0]) == Fraction(42, 58) / (1 + Fraction(20, 58) ** 2)
    cardan, plate, fork = template.split("[[joints]]")[1:]
    assert "the other fork's arm" in cardan
    assert "the plate leans to" not in cardan
    assert "the plate leans to" in plate
    assert "bearing leans to" in fork


@pytest.mark.parametrize("name", ["cardan", "swash-plate", "fork"])
def test_the_plan_is_laid_out_by_turning_down(name: str) -> None:
    """Drawn from what is written, the points that the joint adds are on paper where the scene has them."""
    scene = joint(name)
    steps = [step for step in ran("steps", JOINTS / f"{name}.toml", "--json").json["steps"]
             if step["plan"] == "mechanism" and step["makes"] in scene.points]
    assert {step["makes"] for step in steps} == {*scene.points} - {"E"}  # what the arm points to
    for step in steps:
        assert step["value"] == pytest.approx([*map(float, scene.points[step["makes"]])], abs=1e-9), step
