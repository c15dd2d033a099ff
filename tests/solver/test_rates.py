"""Rates of any chain: exact, in floats the rounding of that, alone and in many poses, for four links or sixty."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from claims_of_equations import assert_derivatives, goes_round, stretching, wrong
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "solver"
DYADS = 30  # of a long chain
Tables = dict[str, Any]


# ---- chains of a few dyads, at random --------------------------------------------------------------------------------


def dyads(coordinates: list[tuple[Any, Any]]) -> Tables:
    """A crank O A with dyads built on it one after the other: each pair of points is a new joint and its pivot."""
    points: dict[str, Any] = {"O": (0, 0), "A": coordinates[0]}
    links, last, pivots = {"1": "O A"}, "A", "O"
    for k, (joint, pivot) in enumerate(zip(coordinates[1::2], coordinates[2::2], strict=True)):
        points |= {f"B{k}": joint, f"C{k}": pivot}
        links |= {str(2 * k + 2): f"{last} B{k}", str(2 * k + 3): f"B{k} C{k}"}
        last, pivots = f"B{k}", f"{pivots} C{k}"
    return {"points": points, "links": links | {"frame": pivots}, "drive": [{"link": "1", "omega": 1, "alpha": 2}]}


def read(tables: Tables) -> gp.WrittenScene:
    """The scene of some tables, if there is one: joints of a link lie apart."""
    try:
        return gp.scene(tables)
    except gp.SceneError:
        assume(False)
        raise


places = st.tuples(st.integers(-9, 9), st.integers(-9, 9))
chains = st.integers(0, 4).flatmap(lambda n: st.lists(places, min_size=2 * n + 1, max_size=2 * n + 1)).map(dyads)


@given(chains)
@settings(max_examples=60, deadline=None)
def test_random_chains(tables: Tables) -> None:
    """Any chain of dyads is singular for fractions and floats alike, or rigid exactly and equal but for rounding."""
    scene = read(tables)
    try:
        exact = gp.analytic.solve(scene, exact=True).rates
    except gp.SingularPose as error:
        with pytest.raises(gp.SingularPose, match=re.escape(str(error))):
            gp.analytic.solve(scene)
        return
    assert {*stretching(scene, exact)} == {0}
    rough = gp.analytic.solve(scene).rates
    for kind in ("velocity", "acceleration"):
        right, found = getattr(exact, kind), getattr(rough, kind)
        size = max(abs(complex(*map(float, value))) for value in right.values())
        assert found.keys() == right.keys()
        if size < 1e4:  # larger ones are near a singular pose
            assert all(abs(complex(*found[name]) - complex(*map(float, value))) <= 1e-8 * size
                       for name, value in right.items())


@given(chains, places)
@settings(max_examples=20, deadline=None)
def test_origin_does_not_matter(tables: Tables, offset: tuple[int, int]) -> None:
    """A scene moved bodily has the same rates, even far away, to the last bit where the move is exact."""
    x, y = (2**20 * step for step in offset)
    moved = tables | {"points": {name: (at[0] + x, at[1] + y) for name, at in tables["points"].items()}}
    here, there = read(tables), read(moved)
    try:
        rates = gp.analytic.solve(here).rates
    except gp.SingularPose:
        assume(False)
    assert gp.analytic.solve(there).rates == rates


def test_forty_links_are_rigid_exactly() -> None:
    """Forty links with decimal coordinates are solved in fractions: no bar grows longer."""
    whole = [(3, 4)] + [(10 * k + 7 * (k % 3) + 5, 17 * (k % 2) + k % 5) for k in range(40)]
    scene = gp.scene(dyads([(round(x + x * x / 1009, 9), round(y + x / 997, 9)) for x, y in whole]))
    assert {*stretching(scene, gp.analytic.solve(scene, exact=True).rates)} == {0}


def test_fractions_do_without_numpy() -> None:
    """Solving rates, reactions and powers in fractions does not import numpy."""
    code = """
import sys
import graphplan as gp
scene = gp.load("jaanimets-10")
assert gp.analytic.reactions(scene, exact=True).balances == gp.analytic.power(scene, exact=True)
assert "numpy" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)


# ---- centres ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "slotted-link", "class-four", "planetary", "five-bar"])
def test_centres_are_where_the_rates_have_them(name: str) -> None:
    """In a pole two links are equally fast; an acceleration centre has no acceleration; a point's velocity squared over
    its normal acceleration is its radius; in the inflection pole the acceleration is along the velocity."""
    tables = tomllib.loads(gp.load(name).text)
    rates = gp.analytic.solve(gp.load(name)).rates
    frame = tables["links"]["frame"].split()
    turning = {link: next(point for point in points.split()) for link, points in tables["links"].items()
               if link != "frame" and abs(rates.omega[link]) > 1e-9}
    paths = {f"{point} on {link}": (point, link) for link in turning for point in tables["links"][link].split()
             if point not in frame and "2" not in point and "3" not in point}
    found = gp.solve(gp.scene({key: table for key, table in tables.items() if key not in ("find", "vary", "sheet")} | {
        "find": {"velocity": [], "poles": "all", "inflection": [*turning], "acceleration_centres": [*turning],
                 "curvature": [*paths]}})).json()
    place = {point: complex(*map(float, at)) for point, at in gp.load(name).points.items()}
    v, a = ({point: complex(*value) for point, value in table.items()} for table in (rates.velocity,
                                                                                      rates.acceleration))
    size, most = max(map(abs, v.values())), max(map(abs, a.values()))

    def velocity(link: str, at: complex) -> complex:
        point = (turning | {"frame": frame[0]})[link]
        return v[point] + 1j * rates.omega.get(link, 0.0) * (at - place[point])

    def acceleration(link: str, at: complex) -> complex:
        point = turning[link]
        return a[point] + (1j * rates.alpha[link] - rates.omega[link] ** 2) * (at - place[point])

    for pair, entry in found["poles"].items():
        one, two = pair.split()
        if entry.get("at") and {one, two} <= {*turning, "frame"}:
            at = complex(*entry["at"])
            assert abs(velocity(one, at) - velocity(two, at)) <= 1e-9 * max(size, abs(velocity(one, at))), pair
    for link in turning:
        assert abs(acceleration(link, complex(*found["acceleration_centres"][link]["at"]))) <= 1e-9 * most, link
        pole, other = (complex(*found["inflection"][link][key]) for key in ("pole", "inflection_pole"))
        assert abs(velocity(link, pole)) <= 1e-9 * size, link
        moved, pulled = velocity(link, other), acceleration(link, other)
        assert abs((moved.conjugate() * pulled).imag) <= 1e-9 * size * max(most, abs(pulled)), link
    for path, (point, _) in paths.items():
        if (centre := found["curvature"][path]["centre"]) is not None and abs(v[point]) > 1e-9 * size:
            turn = (v[point].conjugate() * a[point]).imag
            right = place[point] + 1j * v[point] * abs(v[point]) ** 2 / turn
            assert abs(complex(*centre) - right) <= 1e-9 * max(abs(right), abs(place[point]), 1.0), path


# ---- gears and contacts ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("folder", ["gears", "statics", "friction", "digits"])
def test_rates_are_derivatives_of_the_motion(folder: str) -> None:
    """The scenes of cases, wheels that roll and profiles that touch among them, move as their rates say."""
    tried = 0
    for path in sorted((CASES / folder).glob("*.toml")):
        if not path.name.endswith(".case.toml") and path.name != "flat.toml":  # which cannot go on
            scene = gp.load(str(path))
            if goes_round(scene):
                assert_derivatives(scene)
                tried += 1
    assert tried


# ---- long chains -----------------------------------------------------------------------------------------------------


def chain(seed: int = 0) -> Tables:
    """A crank and many dyads, each between a pivot of the frame and the rocker of the dyad before; every other four-bar
    is the one before it, turned by half a turn. With a seed lengths are uneven, and rates die away and grow again."""
    random = Random(seed)
    points, links = dict[str, Any](), dict[str, str]()
    for k in range(DYADS + 1):
        x, y = 10 * k + (random.randint(-99, 99) / 100 if seed else 0), 5 if k % 2 == 0 else -5
        points[f"R{k}"] = x, 0
        if k:
            points[f"S{k}"] = x - 1, -y
            links[f"{2 * k}"] = f"P{k - 1} S{k}"
        points[f"P{k}"] = x + 1, y
        links[f"{2 * k + 1}"] = " ".join(name for name in (f"R{k}", f"S{k}", f"P{k}") if name in points)
    links["frame"] = " ".join(f"R{k}" for k in range(DYADS + 1))
    joints = [name for name in points if name[0] != "R"]
    return {"points": points, "links": links, "drive": [{"link": "1", "omega": 1}],
            "find": {"velocity": joints, "acceleration": joints}}


def loaded(tables: Tables) -> Tables:
    """The same with a mass on every rocker and a force on the last coupler, held by its crank."""
    masses = {link: {"mass": 1, "inertia": 0.125, "centre": names.split()[1]} for link, names in tables["links"].items()
              if link != "frame" and int(link) % 2}
    last = str(2 * DYADS)
    force = {"on": last, "at": tables["links"][last].split()[1], "value": [3, -8]}
    return tables | {"gravity": [0, -10], "masses": masses, "forces": [force], "balance": {"link": "1"}}


def shuffled(tables: Tables) -> Tables:
    """The same, its links and points in another order."""
    random = Random(1)
    return tables | {key: dict(random.sample([*tables[key].items()], len(tables[key]))) for key in ("points", "links")}


@pytest.mark.parametrize("tables", [chain(), shuffled(loaded(chain())), loaded(chain(3)), shuffled(chain(4))],
                         ids=["even", "shuffled and loaded", "uneven and loaded", "uneven and shuffled"])
def test_sixty_links_have_nine_digits(tables: Tables) -> None:
    """In whatever order they are written: what is printed is right, to the bounds that are told, from floats."""
    scene = gp.scene(tables)
    found = gp.solve(scene, bounds=True)
    assert wrong(scene, found, 1e-9) == []
    assert found.json()["arithmetic"] == "floats"
    assert max(found.json()["bounds"][kind] for kind in ("velocity", "acceleration")) < 1e-9


def straight(dyad: int) -> Tables:
    """A chain of which one dyad stands in one line."""
    tables = chain()
    (x, y), (u, v) = tables["points"][f"P{dyad - 1}"], tables["points"][f"R{dyad}"]
    return tables | {"points": tables["points"] | {f"S{dyad}": ((x + u) / 2, (y + v) / 2)}}


@pytest.mark.parametrize("dyad", [1, 17, DYADS])
def test_a_singular_group_is_named_wherever_it_is(dyad: int) -> None:
    """The links that can move are those of the dyad in one line, and of those after it none that the fault spares."""
    said = []
    for exact in (False, True):
        with pytest.raises(gp.SingularPose) as caught:
            gp.analytic.solve(gp.scene(straight(dyad)), exact)
        said.append((caught.value.why, caught.value.links))
    assert said[0] == said[1]
    assert str(2 * dyad) in said[0][1]
    assert not {str(link) for link in range(1, 2 * dyad)} & {*said[0][1]}


@pytest.mark.parametrize("order", [lambda tables: tables, shuffled], ids=["as written", "shuffled"])
def test_a_rail_held_three_times_is_solved(order: Callable[[Tables], Tables]) -> None:
    """A third crank of a parallelogram repeats what the two say, at the end of a long chain as alone."""
    tables = chain()
    (x, y), (u, v) = (tables["points"][f"{letter}{DYADS}"] for letter in "RP")
    places = {"E0": (x + 20, y), "E1": (x + 40, y), "F0": (u + 20, v), "F1": (u + 40, v)}
    held = {"rail": f"P{DYADS} F0 F1", "a": "E0 F0", "b": "E1 F1", "frame": tables["links"]["frame"] + " E0 E1"}
    scene = gp.scene(order(tables | {"points": tables["points"] | places, "links": tables["links"] | held}))
    rates, exact = (gp.analytic.solve(scene, exact).rates for exact in (False, True))
    assert exact.velocity["F1"] == exact.velocity[f"P{DYADS}"]
    for point, value in exact.velocity.items():
        assert np.allclose(rates.velocity[point], tuple(map(float, value)), rtol=0, atol=1e-9)


# ---- many poses ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("compiled", [False, True])
def test_many_poses_of_many_links_are_solved_as_each_alone(compiled: bool) -> None:
    """Turned round as a whole, a loaded chain has the rates and the reactions that it has alone, turned."""
    if compiled:
        pytest.importorskip("numba")
    tables = loaded(chain()) | {"gravity": [0, 0], "forces": []}
    drawing, turns = gp.construct(gp.scene(tables)), np.exp(1j * np.array([0.0, 0.7, 4.0]))
    places = {name: complex(*at) * turns for name, at in tables["points"].items()}
    many, alone = drawing.evaluate(points=places, compiled=compiled), gp.solve(drawing.scene)
    assert not many.faults
    for kind in ("velocity", "acceleration", "reactions"):
        right, found = getattr(alone, kind), getattr(many, kind)
        size = max(map(abs, right.values()))
        assert [*right]
        assert all(np.abs(found[name] / turns - value).max() < 1e-9 * size for name, value in right.items()), kind


def test_a_singular_pose_among_others_is_no_number() -> None:
    """Where a pose is singular all is nan, a fault says why, and the other poses are as they were."""
    scene = gp.load("four-bar")
    A, B, C = (complex(*map(float, scene.points[name])) for name in "ABC")
    drawing = gp.construct(scene)
    many = drawing.evaluate(points={"B": np.array([B, (A + C) / 2])})
    assert many.velocity["B"][0] == drawing.velocity["B"]
    assert np.isnan(many.velocity["B"][1])
    assert [*many.faults] == [1]
    assert "lines-parallel" in many.faults[1]
