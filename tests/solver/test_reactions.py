"""Reactions of random mechanisms, with and without friction, against sums taken here and the power equation."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from random import Random
from typing import Any

import pytest
from claims_of_equations import KILOGRAMS, METRES, NEWTONS, left_over, numbers_of
from problems import SCENES, equations
from random_mechanisms import GROUPS, mechanism

import graphplan as gp

Tables = dict[str, Any]


def tables_of(groups: list[str], seed: int) -> Tables:
    """A crank with these groups added in turn, as a scene's tables."""
    scene = mechanism(groups, seed)
    drive = scene.drives[0]
    return {"points": {name: (int(x), int(y)) for name, (x, y) in scene.points.items()},
            "links": {name: " ".join(points) for name, points in scene.links.items()},
            "slides": [{"link": s.link, "along": s.along, "at": s.at, "direction": [*map(int, s.direction)]}
                       for s in scene.slides],
            "drive": [{"link": drive.link, "omega": int(drive.rate), "alpha": int(drive.change)}]}


def loaded(tables: Tables, random: Random, units: dict[str, str] | None = None) -> Tables:
    """The scene in any units with loads of every kind on every link, balanced at the crank."""
    def number() -> float:
        return random.randint(-200, 200) / 4

    links = {name: points.split() for name, points in tables["links"].items() if name != "frame"}
    return tables | {
        "units": units or {"length": random.choice([*METRES]), "force": random.choice([*NEWTONS]),
                           "mass": random.choice([*KILOGRAMS])},
        "gravity": [number(), number()],
        "masses": {link: {"mass": abs(number()) or 1, "inertia": abs(number()), "centre": random.choice(points)}
                   for link, points in links.items() if points},
        "forces": [{"on": link, "at": random.choice(points), "value": [number() or 1, number()]}
                   for link, points in links.items() if points],
        "moments": [{"on": link, "value": number() or 1} for link in links],
        "balance": {"link": tables["drive"][0]["link"]},
    }


@cache
def machine(seed: int, most: int = 4, length: str = "") -> gp.WrittenScene:
    """A random mechanism of a few groups that no group braces twice, loaded, in any units or in N and a length."""
    random = Random(seed)
    while True:
        tables = tables_of(random.choices([*GROUPS], k=random.randint(1, most)), random.randrange(10**6))
        try:
            return gp.scene(loaded(tables, random, {"length": length} if length else None))
        except gp.SceneError as fault:
            assert "overbraced" in str(fault)


@pytest.mark.parametrize("seed", range(40))
def test_links_of_random_mechanisms_are_in_equilibrium(seed: int) -> None:
    """In fractions every link is in equilibrium and the power equation agrees; floats differ by rounding."""
    scene = machine(seed)
    try:
        exact = gp.analytic.reactions(scene, exact=True)
    except gp.SingularPose:
        with pytest.raises(gp.SingularPose):
            gp.analytic.reactions(scene)
        return
    assert {left_over(exact, scene, link) for link in scene.moving} == {(0, 0, 0)}
    assert gp.analytic.power(scene, exact=True) == exact.balances
    rough = gp.analytic.reactions(scene)
    close = 1e-9 * max(1.0, *(abs(float(value)) for value in numbers_of(exact)))
    assert [*numbers_of(rough)] == pytest.approx([*numbers_of(exact)], abs=close)
    assert gp.analytic.power(scene) == pytest.approx(exact.balances, abs=close)


def test_forty_links_are_in_equilibrium_exactly() -> None:
    """The reactions of some forty links with decimal coordinates balance in fractions."""
    tables = tables_of(["rrr", "rrr", "rrr", "triad"] * 4, 1)
    points = {name: (round(x + x * x / 1009, 9), round(y + x / 997, 9)) for name, (x, y) in tables["points"].items()}
    scene = gp.scene(loaded(tables | {"points": points}, Random(1)))
    found = gp.analytic.reactions(scene, exact=True)
    assert {left_over(found, scene, link) for link in scene.moving} == {(0, 0, 0)}


def test_units_change_numbers_only() -> None:
    """The same machine in inches, pounds and pounds of force has the same forces to the last digit."""
    tables = loaded(tables_of(["rrr", "sliding_triad", "rpr"], 3), Random(3), {"length": "in", "force": "lbf",
                                                                             "mass": "lb"})
    inch, pound, force = float(METRES["in"] * 1000), float(KILOGRAMS["lb"]), float(NEWTONS["lbf"])
    metric = tables | {
        "units": {"length": "mm"}, "points": {p: (x * inch, y * inch) for p, (x, y) in tables["points"].items()},
        "masses": {link: mass | {"mass": mass["mass"] * pound, "inertia": mass["inertia"] * pound}
                   for link, mass in tables["masses"].items()},
        "forces": [one | {"value": [part * force for part in one["value"]]} for one in tables["forces"]],
        "moments": [one | {"value": one["value"] * force} for one in tables["moments"]]}
    ours, theirs = (gp.analytic.reactions(gp.scene(one)) for one in (tables, metric))
    assert [number * force for number in numbers_of(ours)] == pytest.approx([*numbers_of(theirs)], rel=1e-9)


# ---- friction --------------------------------------------------------------------------------------------------------


def rough(scene: gp.WrittenScene, coefficient: float) -> gp.WrittenScene:
    """The scene with friction in every joint and slide, the journals of different sizes."""
    journals = "".join(f'[[friction]]\nat = "{point}"\nradius = {1 + k % 3}\ncoefficient = {coefficient}\n'
                       for k, point in enumerate(scene.joints))
    guides = "".join(f'[[friction]]\nslide = ["{one.link}", "{one.along}"]\ncoefficient = {coefficient}\n'
                     for one in scene.slides)
    return gp.parse(scene.text + "\n" + journals + guides, "rough")


def losses(found: Any, scene: gp.Scene) -> Iterator[float]:
    """The power of the friction in each pair, in W."""
    omega = {**found.rates.omega, "frame": 0.0}
    for (point, link), couple in found.couples.items():
        yield couple * (omega[link] - omega[scene.links_of[point][0]])
    for name, drag in found.drags.items():
        slip = found.rates.slide_velocity[name]
        yield (drag[0] * slip[0] + drag[1] * slip[1]) / 1000


def sizes(found: Any, scene: gp.Scene) -> Iterator[tuple[float, float]]:
    """For each pair that rubs how large its friction is and should be: coefficient * force, for a journal * radius."""
    arms = {f.at: f.coefficient * f.radius / 1000 for f in scene.loads.frictions if f.at}
    coefficients = {" along ".join(f.slide): f.coefficient for f in scene.loads.frictions if f.slide}
    for (point, link), couple in found.couples.items():
        if couple:
            yield abs(couple), arms[point] * math.hypot(*found.joints[point, link])
    for name, drag in found.drags.items():
        if drag != (0, 0):
            yield math.hypot(*drag), coefficients[name] * math.dist(found.slides[name][0], drag)


@pytest.mark.parametrize("seed", range(30))
def test_random_mechanisms_that_rub(seed: int) -> None:
    """With friction every link is in equilibrium, each friction has its size, and the balance makes up for the loss."""
    scene = machine(seed, 3, "mm")
    try:
        plain = gp.analytic.reactions(scene)
    except gp.SingularPose:
        return
    smooth, rubbing = rough(scene, 0), rough(scene, 0.125)
    none = gp.analytic.with_friction(smooth)
    whole = max(abs(float(value)) for value in numbers_of(plain))
    assert [*numbers_of(none)] == pytest.approx([*numbers_of(plain)], abs=1e-9 * whole)
    try:
        found = gp.analytic.with_friction(rubbing)
    except gp.SingularPose as error:
        assert "self-locking" in str(error)
        return
    close = 1e-8 * max(abs(float(value)) for value in numbers_of(found))
    for link in scene.moving:
        assert left_over(found, rubbing, link) == pytest.approx((0, 0, 0), abs=close)
    for size, expected in sizes(found, rubbing):
        assert size == pytest.approx(expected, abs=close)
    assert max(losses(found, rubbing), default=0) <= 0
    gained = (found.balances[0] - plain.balances[0]) * found.rates.omega[scene.drives[0].link]
    assert gained == pytest.approx(-sum(losses(found, rubbing)), abs=close)


# ---- the equations of the solver, as the bench gives them to other programs ------------------------------------------


@pytest.mark.parametrize("name", SCENES)
def test_the_equations_for_other_numbers_are_those_of_the_scene(name: str) -> None:
    """What CasADi and JAX are given, over floats."""
    scene = gp.load(name)
    places = {point: (float(x), float(y)) for point, (x, y) in scene.points.items()}
    rows = gp.analytic.solve(scene).rates.equations.rows
    for found, row in zip(equations(scene, places, math.sqrt).rows, rows, strict=True):
        assert {at: float(a) for at, a in found.items()} == pytest.approx({at: float(a) for at, a in row.items()})
