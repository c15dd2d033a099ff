"""The planners from inside: in which order forces are found from the graph alone, how trials nest, what is laid out."""

from __future__ import annotations

import math

import pytest
from face import got
from henneberg import henneberg_text
from random_mechanisms import GROUPS, mechanism
from sampling import CORE

import graphplan as gp
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import evaluate
from graphplan.methods.forces.statics import (
    AcrossSlide,
    Assume,
    AtCrossing,
    AtPoint,
    Close,
    ClosePolygon,
    Equilibrium,
    ForceFact,
    LineFact,
)
from graphplan.methods.forces.unknown_forces import ForceGroup, groups, in_general, scene_position
from graphplan.methods.motion.moves import FalsePosition, Move
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner
from graphplan.methods.panels import JointForce
from graphplan.methods.placing import layout


def balanced(groups: list[str], seed: int = 3) -> gp.Scene:
    """A crank with some groups, balanced by a moment on the crank."""
    return gp.parse(mechanism(groups, seed).text + '[balance]\nlink = "1"\n')


def planned(scene: gp.Scene, order: str = "polygons") -> list[tuple[ForceGroup, list[object]]]:
    """The moves of each group, in the order of force transfer."""
    found, done = [], list[str]()
    for links in groups(scene):
        group = ForceGroup(scene, links, done)
        moves = Equilibrium(group, (in_general(scene), scene_position(scene)), order).plan()
        found.append((group, list[object](moves)))
        done += links
    return found


def kinds(group: str, order: str = "polygons") -> list[str]:
    """The kinds of moves that solve the group hung on the crank."""
    return [type(move).__name__ for move in planned(balanced([group]), order)[0][1]]


def test_forces_pass_against_the_motion() -> None:
    """The group that moves last is solved first, the driving link last."""
    scene = balanced(["rrr", "rrp", "triad"], 4)
    order = [group.links for group, _ in planned(scene)]
    assert order[-1] == ("1",)
    assert sorted(link for links in order for link in links) == sorted(scene.moving)


@pytest.mark.parametrize(("group", "moves"), [
    ("rrr", ["LineFact", "LineFact", "ClosePolygon", "Close"]),
    ("rrp", ["LineFact", "LineFact", "ClosePolygon", "Close"]),
    ("rpr", ["LineFact", "LineFact", "ForceFact", "Close", "Close"]),
    ("prp", ["LineFact", "LineFact", "ClosePolygon", "Close"]),
    ("rpp", ["LineFact", "LineFact", "Close", "Close", "Close"]),
])
def test_dyads_as_in_the_textbook(group: str, moves: list[str]) -> None:
    """Two facts of the outer pairs, the polygon of both links, the inner reaction: in each modification."""
    assert kinds(group) == moves


def test_parts_of_outer_reactions_come_from_what_leaves_out_the_inner_one() -> None:
    """In a dyad of revolutes tangential parts come from moments about the inner joint; in one with an inner slide from
    forces along its guide, without moments."""
    group, moves = planned(balanced(["rrr"]))[0]
    inner = next(point for point in group.points if not group.remaining_links(point))
    facts = [move for move in moves if isinstance(move, LineFact)]
    assert [fact.about for fact in facts] == [AtPoint(inner)] * 2
    assert all(len(fact.part) == 1 for fact in facts)
    _, moves = planned(balanced(["rpr"]))[0]
    assert all(isinstance(move.about, AcrossSlide) for move in moves if isinstance(move, LineFact))


@pytest.mark.parametrize("group", ["triad", "sliding_triad", "class_four", "rosenauer"])
def test_higher_groups_use_auxiliary_points(group: str) -> None:
    """Triads, class IV and Rosenauer's groups take moments about the points where two lines of action meet; the common
    joint of Rosenauer's links is found by both."""
    force_group, moves = planned(balanced([group]))[0]
    crossing = [move for move in moves if isinstance(move, LineFact | ForceFact) and isinstance(move.about, AtCrossing)]
    assert crossing
    assert not any(isinstance(move, Assume) for move in moves)
    if group == "rosenauer":
        (site,) = {move.site for move in crossing}
        assert len(crossing) == 2
        assert isinstance(site, JointForce)
        assert not force_group.remaining_links(site.point)


def test_moments_may_be_preferred_to_polygons() -> None:
    """Where a polygon's lines run all but parallel, moments tell the force instead."""
    assert "ClosePolygon" in kinds("rrr")
    assert kinds("rrr", "moments") == ["LineFact", "LineFact", "ForceFact", "Close", "Close"]


@pytest.mark.parametrize("group", sorted(GROUPS))
@pytest.mark.parametrize("order", ["polygons", "moments"])
def test_every_site_is_found_once(group: str, order: str) -> None:
    """Each reaction and each balance is found by exactly one move."""
    for one, moves in planned(balanced([group]), order):
        found: list[object] = []
        for move in moves:
            if isinstance(move, ForceFact | Close):
                found.append(move.site)
            elif isinstance(move, ClosePolygon):
                found += [move.one, move.two]
        assert len(found) == len(set(found))
        assert set(found) == {site for part in one.connected_parts for site, _ in one.boundary(part)}


def depth(moves: list[Move] | tuple[Move, ...]) -> int:
    """How deep trials nest in moves."""
    return max((1 + depth(move.moves) for move in moves if isinstance(move, FalsePosition)), default=0)


@pytest.mark.parametrize("links", [40, 80])
def test_random_linkages_are_planned_with_few_trials_in_each_other(links: int) -> None:
    """Of random linkages of so many links most are planned, with trials three deep at most."""
    planned_linkages, seeds = 0, range(8)
    for seed in seeds:
        planner = Planner(Network(gp.parse(henneberg_text(links, seed, 0.4))))
        try:
            assert depth(planner.plan()) <= 3
            planned_linkages += 1
        except gp.Refused:
            pass
    assert planned_linkages >= 0.8 * len(seeds)


# ---- the mechanism plan, laid out from an empty sheet ----------------------------------------------------------------

PLACED = {
    "points": {"O": [0, 0], "C": [60, 5], "A": {"from": "O", "distance": 25, "angle": 50},
               "B": {"distances": {"A": 60, "C": 45}, "side": "left"}, "M": {"on": "A B", "distance": 20},
               "S": {"distances": {"A": 70}, "on": {"through": [0, -10], "direction": [1, 0.1]}, "pick": "left"}},
    "links": {"1": "O A", "2": "A B M", "3": "B C", "4": "A S", "5": "S", "frame": "O C"},
    "slides": [{"link": "5", "along": "frame", "at": "S", "direction": [1, 0.1]}],
    "drive": [{"link": "1", "omega": 1}],
}


def assert_laid_out(scene: gp.Scene) -> None:
    """The drawn points are the scene's."""
    program = layout(scene)
    values = evaluate(program, Floats())
    for name, index in zip(scene.points, program.wanted, strict=True):
        assert math.dist(values[index], tuple(map(float, scene.points[name]))) <= 1e-9 * 100


@pytest.mark.parametrize(("side", "pick", "along"), [
    ("left", "right", 20), ("right", "left", -15), ("left", "left", 20)])
def test_every_placement_is_drawn_where_the_scene_puts_it(side: str, pick: str, along: int) -> None:
    """Polar, compass, arc-and-line and on-line placements, on either side, are drawn by instruments."""
    assert_laid_out(gp.scene(PLACED).replace({"points.B.side": side, "points.S.pick": pick,
                                              "points.M.distance": along}))


@pytest.mark.parametrize("name", CORE)
def test_every_packaged_pose_can_be_laid_out(name: str) -> None:
    """The mechanism plan of every packaged scene can be drawn from an empty sheet."""
    assert_laid_out(got(name).scene)
