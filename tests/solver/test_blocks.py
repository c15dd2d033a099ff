"""Mechanisms of many links: solved block by block as fractions have it, between bounds that hold, in any order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest

from graphplan.accuracy.survey.growth import chain
from graphplan.check.arithmetics import FLOATS, bounded_rates
from graphplan.check.forces import bounded_reactions
from graphplan.errors import SingularPose
from graphplan.mechanism.model import FRAME, Balance, Force, Loads, Mass, Scene
from graphplan.solver import blocks as blocks_of
from graphplan.solver import poses, reactions, solve
from graphplan.solver.blocks import MAX_BLOCK, blocks
from graphplan.solver.rates import motion_equations

DYADS = 30  # of a chain that is several blocks


def shuffled(scene: Scene, seed: int = 1) -> Scene:
    """The same scene, its links and points in another order."""
    chance = Random(seed)
    links, points = (chance.sample(list(names), len(names)) for names in (scene.links, scene.points))
    return replace(scene, links={link: scene.links[link] for link in links},
                   points={point: scene.points[point] for point in points})


def wobbling(dyads: int, seed: int) -> Scene:
    """A chain of uneven lengths, along which rates die away and grow again."""
    chance, scene = Random(seed), chain(dyads)
    return replace(scene, points={name: (x + Fraction(chance.randint(-99, 99), 99), y)
                                  for name, (x, y) in scene.points.items()})


def loaded(scene: Scene) -> Scene:
    """The scene with a mass on every rocker and a force on the last coupler, held by its crank."""
    masses = {link: Mass(Fraction(1), Fraction(1, 7), points[1]) for link, points in scene.links.items()
              if link != FRAME and int(link) % 2}
    last = str(len(scene.moving) - 1)
    forces = (Force(last, scene.links[last][1], (Fraction(3), Fraction(-8))),)
    return replace(scene, loads=Loads((Fraction(0), Fraction(-10)), masses, forces, (), (Balance("1"),)))


SCENES: dict[str, Callable[[], Scene]] = {
    "chain": lambda: chain(DYADS), "shuffled": lambda: shuffled(chain(DYADS)),
    "wobbling": lambda: wobbling(DYADS, 3), "wobbling and shuffled": lambda: shuffled(wobbling(DYADS, 4), 2),
}


def components(*named: dict[Any, Any]) -> list[Any]:
    """The numbers of readings, one after the other."""
    return [number for table in named for value in table.values()
            for number in (value if isinstance(value, tuple) else (value,))]


@pytest.mark.parametrize("kind", SCENES)
def test_the_bounds_of_many_blocks_hold(kind: str) -> None:
    """Fractions find every rate and every reaction within its proven bound, nine digits of it."""
    scene = loaded(SCENES[kind]())
    rates, exact = bounded_rates(scene, FLOATS), reactions(scene, exact=True)
    forces, true = bounded_reactions(scene, rates, FLOATS), exact.rates
    found = components(rates.velocity, rates.acceleration, rates.omega, rates.alpha, forces.joints)
    truth = components(true.velocity, true.acceleration, true.omega, true.alpha, exact.joints)
    for one, number in zip(found, truth, strict=True):
        assert abs(Fraction(one.value) - number) <= Fraction(one.error) <= Fraction(1, 10**9) * Fraction(one.size or 1)


def test_the_bounds_grow_no_faster_than_the_chain() -> None:
    """Errors that belong together are handed on as one: forty times the links, at most a hundred times the bound."""
    short, long = (max(number.error for number in components(bounded_rates(chain(dyads), FLOATS).velocity))
                   for dyads in (10, 400))
    assert long <= 100 * short


@pytest.mark.parametrize("kind", SCENES)
def test_no_block_is_larger_than_it_must(kind: str) -> None:
    """A chain of dyads is many blocks in whatever order it is written, and every row stands in just one."""
    equations = motion_equations(SCENES[kind]())
    found = blocks(equations.rows, equations.width)
    assert max(len(block.columns) for block in found) <= MAX_BLOCK
    assert sorted(i for block in found for i in block.rows) == list(range(len(equations.rows)))
    known: set[int] = set()
    for block in found:
        known |= {*block.columns}
        assert all(known.issuperset(equations.rows[i]) for i in block.rows)


@pytest.mark.parametrize("kind", SCENES)
def test_the_condition_is_that_of_the_whole(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Powers of the blocks tell the condition that singular values of the whole system tell, to a few hundredths."""
    rates = solve(SCENES[kind]())
    several = rates.condition
    monkeypatch.setattr(blocks_of.blocks, "__defaults__", (10**6,))
    assert several == pytest.approx(replace(rates).condition, rel=0.1)


def straight(dyad: int) -> Scene:
    """A chain of which one dyad stands in one line."""
    scene = chain(DYADS)
    (x, y), (u, v) = scene.points[f"P{dyad - 1}"], scene.points[f"R{dyad}"]
    return replace(scene, points={**scene.points, f"S{dyad}": ((x + u) / 2, (y + v) / 2)})


@pytest.mark.parametrize("dyad", [1, 17, DYADS])
def test_a_singular_group_is_named_wherever_it_is(dyad: int) -> None:
    """The links that can move are those of the dyad in one line, and of those after it none that the fault spares."""
    said = []
    for exact in (False, True):
        with pytest.raises(SingularPose) as caught:
            solve(straight(dyad), exact)
        said.append((caught.value.why, caught.value.links))
    assert said[0] == said[1]
    assert str(2 * dyad) in said[0][1]
    assert not {str(link) for link in range(1, 2 * dyad)} & {*said[0][1]}


@pytest.mark.parametrize("order", [chain, lambda dyads: shuffled(chain(dyads))], ids=("as written", "shuffled"))
def test_a_rail_held_three_times_is_solved(order: Callable[[int], Scene]) -> None:
    """A third crank of a parallelogram repeats what the two say, at the end of a long chain as alone."""
    scene = order(DYADS)
    (x, y), (u, v) = scene.points[f"R{DYADS}"], scene.points[f"P{DYADS}"]
    places = {"E0": (x + 20, y), "E1": (x + 40, y), "F0": (u + 20, v), "F1": (u + 40, v)}
    rail = {"rail": (f"P{DYADS}", "F0", "F1"), "a": ("E0", "F0"), "b": ("E1", "F1"),
            FRAME: (*scene.links[FRAME], "E0", "E1")}
    held = replace(scene, points=scene.points | places, links=scene.links | rail)
    rates, exact = solve(held), solve(held, exact=True)
    for point, value in exact.velocity.items():
        assert np.allclose(rates.velocity[point], tuple(map(float, value)), rtol=0, atol=1e-9)
    assert exact.velocity["F1"] == exact.velocity[f"P{DYADS}"]
    assert max(number.error for number in components(bounded_rates(held, FLOATS).velocity)) < 1e-9


@pytest.mark.parametrize("sizes", [False, True])
def test_many_poses_of_many_links_are_solved_as_each_alone(sizes: bool) -> None:
    """Turned round as a whole, a chain of many blocks has the rates and the reactions that it has alone, turned."""
    scene = shuffled(loaded(chain(DYADS)))
    assert scene.loads is not None
    scene = replace(scene, loads=replace(scene.loads, gravity=(0, 0), forces=()))
    turns = np.exp(1j * np.array([0.0, 0.7, 4.0]))
    posed = poses.scene_in_poses(scene, {name: complex(*map(float, at)) * turns for name, at in scene.points.items()},
                                 {})
    rates = poses.solve(posed, len(turns), sizes)
    alone, many = reactions(scene), poses.reactions(posed, rates, len(turns), sizes)
    for one, other in ((alone.rates.velocity, rates.velocity), (alone.rates.acceleration, rates.acceleration),
                       (alone.joints, many.joints)):
        size = max(abs(complex(*map(float, value))) for value in one.values())
        for name, value in one.items():
            x, y = (getattr(number, "value", number) for number in other[name])
            assert np.abs((x + 1j * y) / turns - complex(*map(float, value))).max() < 1e-9 * size
