"""Gears and contacts by the solver: against closed formulas, true finite motions, and themselves in other numbers."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import higher
import numpy as np
import pytest

from graphplan import solver as analytic
from graphplan.check.arithmetics import FLOATS, bounded_rates, enclose_scene, enclosures
from graphplan.mechanism.model import Scene
from graphplan.mechanism.replaced import scene_beyond
from graphplan.mechanism.scene import load, parse
from graphplan.solver import poses

SCENES = higher.scenes()
STEP = 2.0**-10


def derived(path: Callable[[float], complex]) -> tuple[complex, complex]:
    """The first and the second derivative at 0."""
    far, back, now, on, ahead = (path(k * STEP) for k in (-2, -1, 0, 1, 2))
    return ((far - 8 * back + 8 * on - ahead) / (12 * STEP),
            (-far + 16 * back - 30 * now + 16 * on - ahead) / (12 * STEP**2))


def turned(angle: float) -> complex:
    """A unit vector."""
    return complex(math.cos(angle), math.sin(angle))


def at(pair: Any) -> complex:
    """A vector as a number."""
    return complex(*map(float, pair))


# --- trains: the same factors by the textbook's formulas -------------------------------------------------------------

TRAINS = {  # by Willis: (omega_2 - omega_3) z_2 = -(omega_1 - omega_3) z_1
    "planet": ("2", {"1": Fraction(-30, 20), "3": 1 + Fraction(30, 20)}),
    "belt": ("2", {"1": Fraction(7, 20), "3": 1 - Fraction(7, 20)}),
    "crossed belt": ("2", {"1": Fraction(-7, 20), "3": 1 + Fraction(7, 20)}),
    "sun that stands still": ("2", {"3": 1 + Fraction(30, 20)}),
    "ring": ("3", {"1": Fraction(30, 30 + 70)}),
}


@pytest.mark.parametrize("name", TRAINS)
def test_trains_have_their_ratios(name: str) -> None:
    """Velocities and accelerations of a train are those of Willis's formula, exactly."""
    found, (link, shares) = analytic.solve(SCENES[name], exact=True), TRAINS[name]
    for rates in (found.omega, found.alpha):
        assert rates[link] == sum(share * rates[other] for other, share in shares.items())


# --- rolling: points of wheels run on cycloids -----------------------------------------------------------------------


def rolled(scene: Scene) -> Callable[[float], complex]:
    """Where the point M of a wheel about B is, which rolls on a circle about a point of the frame, or on a line."""
    (contact,) = scene.contacts
    (drive,) = scene.drives
    B, M, K = (at(scene.points[name]) for name in "BMK")
    fixed = contact.centres[contact.links.index("frame")]

    def path(t: float) -> complex:
        angle = float(drive.rate) * t + float(drive.change) * t * t / 2
        if fixed is None:
            return B + angle * 1j * (B - K) + turned(angle) * (M - B)
        C = at(scene.points[fixed])
        return C + turned(angle * ((B - K) / (B - C)).real) * (B - C) + turned(angle) * (M - B)

    return path


@pytest.mark.parametrize("name", ["wheel on a wheel", "wheel in a ring", "wheel on a rail"])
def test_points_of_wheels_run_on_cycloids(name: str) -> None:
    """Velocity and acceleration of a point of a rolling wheel are those of its path."""
    scene = SCENES[name]
    velocity, acceleration = derived(rolled(scene))
    found = analytic.solve(scene)
    assert at(found.velocity["M"]) == pytest.approx(velocity, rel=1e-9)
    assert at(found.acceleration["M"]) == pytest.approx(acceleration, rel=1e-7)


@pytest.mark.parametrize("name", ["planet", "sun that stands still", "ring", "belt", "crossed belt"])
def test_points_of_planets_run_on_their_paths(name: str) -> None:
    """The arm carries the planet's centre, the train turns the planet about it."""
    scene, found = SCENES[name], analytic.solve(SCENES[name])
    O, B, M = (at(scene.points[point]) for point in "OBM")

    def path(t: float) -> complex:
        arm, planet = (float(found.omega[link]) * t + float(found.alpha[link]) * t * t / 2 for link in "32")
        return O + turned(arm) * (B - O) + turned(planet) * (M - B)

    velocity, acceleration = derived(path)
    assert at(found.velocity["M"]) == pytest.approx(velocity, rel=1e-8)
    assert at(found.acceleration["M"]) == pytest.approx(acceleration, rel=1e-6)


# --- contacts: circles and straight lines that go on touching, by finite motions --------------------------------------


@pytest.mark.parametrize("name", ["cam", "turning flat follower"])
def test_profiles_go_on_touching(name: str) -> None:
    """The follower turns as far as its profile, itself drawn in each pose, stays at the distance of the cam's radius.
    """
    scene, found = SCENES[name], analytic.solve(SCENES[name])
    A, B, K, M = (at(scene.points[point]) for point in "ABKM")
    C = at(scene.points["C"]) if name == "cam" else None

    def distance(cam: float, follower: float) -> float:  # of the cam's centre from the follower's profile
        seen = M + (A + turned(cam) * (B - A) - M) / turned(follower)  # from the follower
        return abs(abs(seen - C) - abs(K - C)) if C else ((seen - K) * (B - K).conjugate()).real / abs(B - K)

    def path(t: float) -> complex:
        cam, follower = 2 * t + 1.5 * t * t, 0.0
        for _ in range(30):
            slope = (distance(cam, follower + 1e-5) - distance(cam, follower - 1e-5)) / 2e-5
            follower -= (distance(cam, follower) - abs(B - K)) / slope
        return complex(follower)

    velocity, acceleration = derived(path)
    assert (found.omega["2"], found.alpha["2"]) == pytest.approx((velocity.real, acceleration.real), rel=1e-6)


# --- contacts: profiles that are no circles --------------------------------------------------------------------------

LONG, SHORT = 50.0, 30.0


def elliptic(at_angle: float, follower: str) -> Scene:
    """An ellipse about O touched by a flat follower above it, with the centre of curvature where it is touched."""
    height = math.sqrt((LONG * math.sin(at_angle)) ** 2 + (SHORT * math.cos(at_angle)) ** 2)
    here = complex(LONG**2 * math.sin(at_angle), SHORT**2 * math.cos(at_angle)) / height  # on the ellipse itself
    normal = complex(here.real / LONG**2, here.imag / SHORT**2)
    centre = here - normal / abs(normal) * (LONG * SHORT) ** 2 / height**3
    K, C = here * turned(at_angle), centre * turned(at_angle)
    return parse(f"[points]\nO = [0, 0]\nC = [{C.real!r}, {C.imag!r}]\nK = [{K.real!r}, {K.imag!r}]\nS = [0, 90]\n"
                 "[links]\n1 = 'O C'\n2 = 'S'\nframe = 'O'\n" + higher.slide("2", "S", "[0, 1]")
                 + higher.contact("1 2", "K", follower) + higher.DRIVE.format("1"), "ellipse")


@pytest.mark.parametrize("angle", [0.3, 1.1, 2.5, -0.7])
def test_an_ellipse_lifts_a_flat_follower(angle: float) -> None:
    """The follower's motion is that of the ellipse's support function, by the centre of curvature of the moment."""
    found = analytic.solve(elliptic(angle, '["C", [1, 0]]'))

    def lift(t: float) -> complex:
        turn = angle + 2 * t + 1.5 * t * t
        return complex(0, math.hypot(LONG * math.sin(turn), SHORT * math.cos(turn)))

    velocity, acceleration = derived(lift)
    assert at(found.velocity["S"]) == pytest.approx(velocity, abs=1e-8)
    assert at(found.acceleration["S"]) == pytest.approx(acceleration, abs=1e-6)


@pytest.mark.parametrize("angle", [0.4, 1.2, 2.6])
def test_equal_ellipses_turn_about_their_foci(angle: float) -> None:
    """Two equal ellipses that touch turn about foci as their radii have it: the one's and the other's make 2 a."""
    e = math.sqrt(1 - (SHORT / LONG) ** 2)

    def other(t: float) -> complex:  # of the rays from the nearer apexes tan(f/2) tan(g/2) = (1 + e) / (1 - e)
        return complex(-2 * math.atan((1 - e) / (1 + e) * math.tan((angle + 2 * t + 1.5 * t * t) / 2)))

    radius = LONG * (1 - e * e) / (1 + e * math.cos(angle))  # from the focus, at this angle from the nearer apex
    theta = math.atan2(e * math.sin(angle), 1 + e * math.cos(angle))  # of the normal with the ray
    curvature = LONG * (1 - e * e) / math.cos(theta) ** 3  # p / cos^3
    normal = turned(theta)
    K = complex(radius, 0)
    mine, yours = K - normal * curvature, K + normal * curvature
    points = {"O": 0j, "P": complex(2 * LONG, 0), "K": K, "C": mine, "D": yours}
    scene = parse("[points]\n" + "".join(f"{name} = [{z.real!r}, {z.imag!r}]\n" for name, z in points.items())
                  + "[links]\n1 = 'O C'\n2 = 'P D'\nframe = 'O P'\n" + higher.contact("1 2", "K", '["C", "D"]')
                  + higher.DRIVE.format("1"), "ellipses")
    found = analytic.solve(scene)
    velocity, acceleration = derived(other)
    assert found.omega["2"] == pytest.approx(-2 * radius / (2 * LONG - radius), rel=1e-12)
    assert (float(found.omega["2"]), float(found.alpha["2"])) == pytest.approx(
        (velocity.real, acceleration.real), rel=1e-6)


def test_parallel_profiles_touch_alike() -> None:
    """Where on the normal two profiles touch changes no motion, but for what rolls."""
    scene = SCENES["cam"]
    wanted = analytic.solve(scene, exact=True)
    for share in (Fraction(1, 3), Fraction(5, 2), Fraction(-2)):
        (bx, by), (cx, cy) = scene.points["B"], scene.points["C"]
        K = (bx + share * (cx - bx), by + share * (cy - by))
        found = analytic.solve(replace(scene, points=scene.points | {"K": K}), exact=True)
        assert (found.omega, found.alpha) == (wanted.omega, wanted.alpha)


# --- textbook values -------------------------------------------------------------------------------------------------


def test_the_textbooks_values() -> None:
    """Ozols's arc cam, whose acceleration jumps where its arcs meet (fig. 5-33), and his gear-linkage (fig. 7-16)."""
    cam = parse(higher.ARC_CAM, "5-33")
    for scene, wanted in ((cam, -981.278), (scene_beyond(cam), -5336.199)):
        found = analytic.solve(scene)
        assert float(found.velocity["A"][1]) == pytest.approx(319.276, abs=5e-4)
        assert float(found.acceleration["A"][1]) == pytest.approx(wanted, abs=5e-4)
    assert analytic.solve(load("gear-linkage")).omega["3"] == pytest.approx(1.67189, abs=5e-6)


# --- the same in other numbers ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SCENES)
def test_all_numbers_say_the_same(name: str) -> None:
    """Floats, floats with bounds, enclosures and arrays of poses give what fractions give; the condition is sound."""
    scene, exact = SCENES[name], analytic.solve(SCENES[name], exact=True)
    single = analytic.solve(scene)
    many = poses.solve(poses.scene_in_poses(scene, {p: np.full(2, at(z)) for p, z in scene.points.items()}, {}), 2)
    assert single.condition < 100
    for by in (FLOATS, enclosures(200)):
        with by.working():
            proven = bounded_rates(enclose_scene(scene, by), by)
        for part in ("omega", "alpha"):
            for link, value in getattr(exact, part).items():
                assert by.lift(value).overlaps(getattr(proven, part)[link])
    for part in ("omega", "alpha", "velocity", "acceleration"):
        for one, value in getattr(exact, part).items():
            wanted = np.array(value, float)
            assert np.array(getattr(single, part)[one], float) == pytest.approx(wanted, abs=1e-9)
            assert np.array(getattr(many, part)[one], float)[..., 1] == pytest.approx(wanted, abs=1e-9)
