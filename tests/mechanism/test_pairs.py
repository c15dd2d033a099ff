"""Each kind of pair by its record: what it states of poses, differentiated, is what it tells of rates and passes on."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from random import Random
from typing import Any

import higher
import numpy as np
import pytest
from packaged_scenes import those

import graphplan as gp
from graphplan.cycle import closure
from graphplan.cycle.groups import ClosureGroup
from graphplan.cycle.linkage import CentreDistance, GearBond, Linkage, RackBond, unit_direction
from graphplan.mechanism.model import FRAME, Contact, Gear, Scene
from graphplan.mechanism.numbers import dot, minus, quarter_turn
from graphplan.mechanism.pairs import KINDS
from graphplan.mechanism.pairs.pair import (
    LINE,
    POINT,
    TURNING,
    Along,
    KinematicPair,
    LinkAttitude,
    PairSide,
    PairSides,
    Rate,
    Rolling,
    Statement,
    Touching,
    Turning,
)
from graphplan.mechanism.scene import packaged_names
from graphplan.mechanism.travel import paces

STEP = 2.0**-12
SCENES = packaged_names()
HIGHER = higher.scenes()


def in_floats(name: str) -> Scene:
    """A scene in floats, its lengths of the order of 1."""
    scene = HIGHER.get(name) or gp.load(name)
    reach = max(abs(float(x)) for at in scene.points.values() for x in at)

    def unit(z: Any) -> Any:
        x, y = map(float, z)
        return x / math.hypot(x, y), y / math.hypot(x, y)

    points = {name: (float(x) / reach, float(y) / reach) for name, (x, y) in scene.points.items()}
    return scene.with_pose(points, lambda one: unit(one.direction), lambda radius: float(radius) / reach)


def stated(scene: Scene) -> Iterator[tuple[KinematicPair, Statement]]:
    """What all pairs state, of the directions in which nothing moves as if they were fixed to the other link."""
    for pair in scene.pairs:
        for fact in pair.states(scene):
            yield pair, replace(fact, to="") if isinstance(fact, Along) else fact


def lying(rate: Rate, change: Rate, t: float) -> LinkAttitude:
    """Where a link is after a time, from the origin, as its rates and their changes have it."""
    x, y, angle = (v * t + a * t * t / 2 for v, a in zip(rate, change, strict=True))
    return LinkAttitude(x, y, math.cos(angle), math.sin(angle))


@pytest.mark.parametrize("name", [*SCENES, *HIGHER])
def test_what_is_stated_of_poses_is_stated_of_rates(name: str) -> None:
    """The residual once and twice derived is the row of the velocities, and what these leave over.

    Twice derived it holds of higher pairs where the links move as they let them: centres held apart, profiles touching.
    """
    scene, chance = in_floats(name), Random(name)
    for _, fact in stated(scene):
        arms: Any = tuple(scene.points[point] if point else (0.0, 0.0) for _, point in fact.ends)
        first, second = ({link: Rate(*(chance.uniform(-1, 1) for _ in range(3))) for link in (fact.link, fact.on)}
                         for _ in range(2))
        weights = dict(zip((fact.link, fact.on), fact.weights(arms, math.sqrt), strict=True))
        once, _ = _derived(fact, first, second, arms)
        assert once == pytest.approx(_weighed(weights, first), abs=1e-6)
        first = _allowed(fact, first, arms)
        _, twice = _derived(fact, first, second, arms)
        left = fact.left_over(PairSides(*(PairSide(arm, first[link]) for (link, _),
                                          arm in zip(fact.ends, arms, strict=True))))
        assert twice == pytest.approx(float(_weighed(weights, second) - left), abs=1e-5)


def _derived(fact: Statement, first: dict[str, Rate], second: dict[str, Rate], arms: Any) -> tuple[float, float]:
    """The derivatives of the residual, which is nothing now."""
    before, now, after = (fact.residual({link: lying(first[link], second[link], t) for link in first}, arms)
                          for t in (-STEP, 0.0, STEP))
    assert now == pytest.approx(0, abs=1e-15)
    return (after - before) / (2 * STEP), (after - 2 * now + before) / STEP**2


def _weighed(weights: dict[str, Rate], rates: dict[str, Rate]) -> float:
    """What a row gives for the rates of both links."""
    return float(sum(a * b for link in rates for a, b in zip(weights[link], rates[link], strict=True)))


def _allowed(fact: Statement, rates: dict[str, Rate], arms: Any) -> dict[str, Rate]:
    """The rates, of a higher pair with the second link shifted so that it is held at its distance from the first."""
    if not isinstance(fact, Touching | Rolling):
        return rates
    normal = fact.line if isinstance(fact, Rolling) else fact.direction
    one, other = (rates[link].velocity_at(arm) for (link, _), arm in zip(fact.ends, arms, strict=True))
    excess = dot(normal, minus(other, one)) / dot(normal, normal)
    x, y, turn = rates[fact.on]
    return rates | {fact.on: Rate(x - excess * normal[0], y - excess * normal[1], turn)}


def passed(pair: KinematicPair, scene: Scene) -> list[list[float]]:
    """What a pair tells the planner, as rows of one link's velocity relative to the other."""
    (x, y), rows = (float(x) for x in scene.points[pair.at]), []
    if POINT in pair.passes:
        rows += [[1, 0, -y], [0, 1, x]]
    if LINE in pair.passes:
        across = quarter_turn(pair.direction)  # type: ignore[attr-defined]
        rows.append([*map(float, across), float(dot(across, (-y, x)))])
    if TURNING in pair.passes:
        rows.append([0, 0, 1])
    return rows


@pytest.mark.parametrize("name", SCENES)
def test_what_is_passed_on_is_what_binds(name: str) -> None:
    """A pair tells the planner as much as it binds, no more and no less; others stand there for gears and contacts."""
    scene = in_floats(name)
    for pair in (pair for pair in scene.binding if not isinstance(pair, Gear | Contact)):
        link = pair.links[1] if POINT in pair.passes else pair.links[0]
        facts = [fact for fact in pair.states(scene) if fact.link == link]
        rows = [list(fact.weights((scene.points[fact.at] if fact.at else (0, 0),) * 2, math.sqrt)[0]) for fact in facts]
        both = passed(pair, scene)
        assert len(rows) == len(both) == pair.binds
        assert np.linalg.matrix_rank(rows) == np.linalg.matrix_rank(both) == np.linalg.matrix_rank(rows + both)


@pytest.mark.parametrize("name", [*those(lambda scene: scene.drives and not scene.motions),
                                  *HIGHER])
def test_the_cycle_closes_what_is_stated(name: str) -> None:
    """Anywhere near the pose, what the closure leaves open is what the statements leave, lengths counted in reaches.

    Those that seat a link on another leave nothing, and derivatives are those of what is left.
    """
    scene, chance = HIGHER.get(name) or gp.load(name), Random(name)
    linkage = Linkage(scene, paces(scene))
    groups, bodies = [ClosureGroup(linkage, part) for part in linkage.parts], {FRAME: closure.LinkPose()}
    for group in groups:
        known, state = [bodies[link] for link in (FRAME, *group.carriers)], np.array(
            [chance.uniform(-0.1, 0.1) for _ in range(group.unknowns)])
        rows, links = _left(group, known, state)
        placed = (closure.LinkPose(body.base, body.turn, angle=body.angle) for body in links[len(known):])
        bodies |= zip(group.links, placed, strict=True)
        for i, step in enumerate(np.eye(group.unknowns) * STEP / 16):
            before, after = (_left(group, known, state + sign * step)[0] for sign in (-1, 1))
            for row, one, two in zip(rows, before, after, strict=True):
                slope = (two[closure.RESIDUE] - one[closure.RESIDUE]) / (2 * STEP / 16)
                assert row.get(i, 0.0) == pytest.approx(slope, abs=1e-7)
        closed = sorted(abs(row[closure.RESIDUE]) for row in rows)
        stated = sorted(_stated(linkage, group, bodies))
        assert [0.0] * (len(stated) - len(closed)) + closed == pytest.approx(stated, abs=1e-12)


def _left(group: ClosureGroup, known: list[closure.LinkPose], state: Any) -> tuple[list[closure.Row],
                                                                                   list[closure.LinkPose]]:
    """What a group leaves open in a state, and how its links lie."""
    drives, numbers = group.drives_and_state(0.0, state)
    links = closure.pose_links(group.layout, known, group.arms, drives, numbers)
    return closure.residual_rows(group.layout, links, group.arms, drives), links


def _stated(linkage: Linkage, group: ClosureGroup, bodies: dict[str, closure.LinkPose]) -> Iterator[float]:
    """What each statement on a group's links leaves, without its sign; of gears with 1 for the largest factor."""
    lies = {link: LinkAttitude(*body.base, *(body.turn or (1.0, 0.0))) for link, body in bodies.items()}
    for bond in [bond for link in group.links for bond in linkage.bonds[link]]:
        if isinstance(bond, GearBond):
            turns = [lies[link] for link in (bond.link, bond.on, linkage.lines.carriers[bond.arm])]
            one, other, line = (math.atan2(link.sin, link.cos) for link in turns)
            k1, k2 = bond.factors
            yield abs(k1 * (one - line) + k2 * (other - line)) / max(abs(k1), abs(k2), abs(k1 + k2))
            continue
        arms: Any = None, None
        if isinstance(bond, CentreDistance):
            z = (linkage.places[bond.at] - linkage.places[bond.far_centre]) / linkage.reach
            radius, bond = abs(z), Touching(bond.link, bond.on, bond.at, (z.real, z.imag), bond.condition.way)
        elif not isinstance(bond, Turning):
            z, lever = unit_direction(bond), bond.lever / linkage.reach if isinstance(bond, RackBond) else 0
            bond = Along(bond.link, bond.on, bond.at, (z.real, z.imag), "", to=getattr(bond, "to", ""), lever=lever)
            radius = 1.0
        if not isinstance(bond, Turning):
            ends = ((linkage.places[bond.at] - linkage.origins[end]) / linkage.reach for end in (bond.link, bond.on))
            arms = tuple((arm.real, arm.imag) for arm in ends)
        yield abs(bond.residual(lies, arms)) / (1.0 if isinstance(bond, Turning) else radius)


def test_every_kind_of_pair_is_in_a_scene() -> None:
    """The scenes have every kind of pair among them, so that these tests leave none out."""
    scenes = [*map(gp.load, SCENES), *HIGHER.values()]
    seen = {type(pair).__module__.rsplit(".", 1)[1] for scene in scenes for pair in scene.pairs}
    assert seen == {*KINDS} - {"pair", "space_joint"}  # a joint in space stands for pairs of other kinds
