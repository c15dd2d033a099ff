"""The force planner: it finds the textbook's order of moments and polygons from the graph alone."""

from __future__ import annotations

from dataclasses import replace

import pytest
from random_mechanisms import GROUPS, mechanism

from graphplan.mechanism.model import Balance, Loads, Scene
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
from graphplan.methods.panels import JointForce


def balanced(group: str, seed: int = 3) -> Scene:
    """A crank with one group, balanced by a moment on the crank."""
    return replace(mechanism([group], seed), loads=Loads((0, 0), {}, (), (), (Balance("1"),)))


def planned(scene: Scene, order: str = "polygons") -> list[tuple[ForceGroup, list[object]]]:
    """The moves of each group, in the order of force transfer."""
    found, done = [], list[str]()
    for links in groups(scene):
        group = ForceGroup(scene, links, done)
        found.append((group,
                      list[object](Equilibrium(group, (in_general(scene), scene_position(scene)), order).plan())))
        done += links
    return found


def kinds(group: str, order: str = "polygons") -> list[str]:
    """The kinds of moves that solve the group hung on the crank."""
    return [type(move).__name__ for move in planned(balanced(group), order)[0][1]]


def test_forces_pass_against_the_motion() -> None:
    """The group that moves last is solved first, the driving link last."""
    scene = replace(mechanism(["rrr", "rrp", "triad"], 4), loads=Loads((0, 0), {}, (), (), (Balance("1"),)))
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


def test_tangential_parts_come_from_moments_about_the_inner_joint() -> None:
    """In a dyad of revolutes both outer reactions have their tangential parts from moments about the inner joint."""
    scene = balanced("rrr")
    group, moves = planned(scene)[0]
    inner = next(point for point in group.points if not group.remaining_links(point))
    facts = [move for move in moves if isinstance(move, LineFact)]
    assert [fact.about for fact in facts] == [AtPoint(inner)] * 2
    assert all(len(fact.part) == 1 for fact in facts)


def test_an_inner_slide_has_no_part_along_its_guide() -> None:
    """In a dyad with an inner slide the outer reactions are told by forces along the guide, without moments."""
    _, moves = planned(balanced("rpr"))[0]
    assert all(isinstance(move.about, AcrossSlide) for move in moves if isinstance(move, LineFact))


@pytest.mark.parametrize("group", ["triad", "sliding_triad", "class_four", "rosenauer"])
def test_higher_groups_use_auxiliary_points(group: str) -> None:
    """Triads, class IV and Rosenauer's groups take moments about the points where two lines of action meet."""
    _, moves = planned(balanced(group))[0]
    abouts = [move.about for move in moves if isinstance(move, LineFact | ForceFact)]
    assert any(isinstance(about, AtCrossing) for about in abouts)
    assert not any(isinstance(move, Assume) for move in moves)


def test_the_common_joint_of_rosenauers_links_is_found_by_both_auxiliary_points() -> None:
    """As its velocity is where two loci meet, the reaction there is where two lines meet: one from Q, one from R."""
    scene = balanced("rosenauer")
    group, moves = planned(scene)[0]
    at = [move for move in moves if isinstance(move, LineFact | ForceFact) and isinstance(move.about, AtCrossing)]
    assert len(at) == 2
    (site,) = {move.site for move in at}
    assert isinstance(site, JointForce)
    assert not group.remaining_links(site.point)


def test_moments_may_be_preferred_to_polygons() -> None:
    """Where a polygon's lines run all but parallel, moments tell the force instead."""
    assert "ClosePolygon" in kinds("rrr")
    assert kinds("rrr", "moments") == ["LineFact", "LineFact", "ForceFact", "Close", "Close"]


@pytest.mark.parametrize("group", sorted(GROUPS))
@pytest.mark.parametrize("order", ["polygons", "moments"])
def test_every_site_is_found_once(group: str, order: str) -> None:
    """Each reaction and each balance is found by exactly one move."""
    for one, moves in planned(balanced(group), order):
        found: list[object] = []
        for move in moves:
            if isinstance(move, ForceFact | Close):
                found.append(move.site)
            elif isinstance(move, ClosePolygon):
                found += [move.one, move.two]
        sites = {site for part in one.connected_parts for site, _ in one.boundary(part)}
        assert len(found) == len(set(found))
        assert set(found) == sites
