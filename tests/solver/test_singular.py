"""Poses in which the motion is not determined, or is impossible: said, with the links, and never a wrong number."""

from __future__ import annotations

import math

import pytest
from by_hand import mechanism, move, push, slide, turn
from each import each

from graphplan.errors import SingularPose
from graphplan.mechanism.model import Scene, TurningDrive
from graphplan.solver import solve

FOUR_BAR = {"1": "O A", "2": "A B", "3": "C B", "frame": "O C"}
both = pytest.mark.parametrize("exact", [False, True])


def refusal(scene: Scene, exact: bool) -> SingularPose:
    """The error that solving the scene raises."""
    with pytest.raises(SingularPose) as caught:
        solve(scene, exact)
    return caught.value


def dead_centre(*drives: TurningDrive) -> Scene:
    """A four-bar with crank and coupler in one line."""
    return mechanism({"O": (0, 0), "A": (1, 0), "B": (4, 0), "C": (4, 3)}, FOUR_BAR, drives)


@both
def test_rocker_cannot_drive_through_the_dead_centre(exact: bool) -> None:
    """At the dead centre a turning rocker is impossible, and the links that can move are crank and coupler."""
    error = refusal(dead_centre(turn("3", 1)), exact)
    assert error.links == ("1", "2")
    assert "the prescribed motion is impossible here" in error.why


@both
def test_resting_rocker_leaves_the_crank_loose_at_the_dead_centre(exact: bool) -> None:
    """At the dead centre a rocker that stands still does not determine how crank and coupler move."""
    error = refusal(dead_centre(turn("3", 0)), exact)
    assert error.links == ("1", "2")
    assert "the drive does not determine the motion" in error.why


@both
def test_crank_drives_through_the_dead_centre(exact: bool) -> None:
    """Driven by the crank the same pose is regular, and the rocker stands still in it."""
    rates = solve(dead_centre(turn("1", 2)), exact)
    assert rates.omega["3"] == pytest.approx(0, abs=1e-15)


@both
def test_piston_cannot_drive_through_the_dead_centre(exact: bool) -> None:
    """A slider-crank in one line cannot follow a moving piston."""
    links = {"1": "O A", "2": "A B", "3": "B", "frame": "O"}
    points = {"O": (0, 0), "A": (3, 4), "B": (9, 12)}
    scene = mechanism(points, links, [push("3", "frame", 1)], [slide("3", "frame", "B", (3, 4))])
    assert refusal(scene, exact).links == ("1", "2")


@each("degrees", range(0, 360, 7))
def test_dead_centre_is_seen_through_rounding(degrees: int) -> None:
    """Turned by any angle, with every coordinate rounded, the dead centre is still seen."""
    turned = {
        p: (
            math.cos(math.radians(degrees)) * x - math.sin(math.radians(degrees)) * y,
            math.sin(math.radians(degrees)) * x + math.cos(math.radians(degrees)) * y,
        )
        for p, (x, y) in {"O": (0.0, 0.0), "A": (1.1, 0.0), "B": (4.3, 0.0), "C": (4.3, 3.7)}.items()
    }
    assert refusal(mechanism(turned, FOUR_BAR, [turn("3", 1)]), exact=False).links == ("1", "2")


@both
@pytest.mark.parametrize("nearly", ["0.001", "0.000001", "0.000000001"])
def test_near_the_dead_centre_the_pose_is_solved(exact: bool, nearly: str) -> None:
    """Off the dead centre by any decimal that floats can tell the pose is solved, the crank the faster the nearer."""
    scene = mechanism({"O": (0, 0), "A": (1, nearly), "B": (4, 0), "C": (4, 3)}, FOUR_BAR, [turn("3", 1)])
    assert abs(float(solve(scene, exact).omega["1"])) > 1 / float(nearly)


def parallel_guides(pin: tuple[int, int]) -> Scene:
    """A crank pin in a block on a link that slides on the frame, both guides horizontal."""
    links = {"1": "O A", "2": "A", "3": "B", "frame": "O"}
    guides = [slide("2", "3", "A", (1, 0)), slide("3", "frame", "B", (2, 0))]
    return mechanism({"O": (0, 0), "A": pin, "B": (5, 7)}, links, [turn("1", 1)], guides)


@both
@pytest.mark.parametrize(("pin", "why"), [((0, 1), "does not determine"), ((1, 0), "impossible")])
def test_parallel_guides(exact: bool, pin: tuple[int, int], why: str) -> None:
    """Between parallel guides the sliding link is loose, and a crank pin that moves across them is stuck."""
    error = refusal(parallel_guides(pin), exact)
    assert error.links == ("3",)
    assert why in error.why


@both
def test_missing_drive(exact: bool) -> None:
    """A five-bar with one drive leaves all its other links loose."""
    points = {"O": (0, 0), "A": (1, 3), "B": (4, 5), "C": (7, 2), "D": (8, 0)}
    links = {"1": "O A", "2": "A B", "3": "B C", "4": "C D", "frame": "O D"}
    assert refusal(mechanism(points, links, [turn("1", 1)]), exact).links == ("2", "3", "4")


@both
def test_no_drive(exact: bool) -> None:
    """A mechanism that nothing drives is said to be so."""
    error = refusal(mechanism({"O": (0, 0), "A": (1, 2)}, {"1": "O A", "frame": "O"}), exact)
    assert error.links == ("1",)
    assert "nothing drives" in error.why


@both
def test_contradicting_drives(exact: bool) -> None:
    """Two drives of one degree of freedom that disagree are impossible together, and only their loop is named."""
    points = {"O": (0, 0), "A": (1, 2), "B": (5, 4), "C": (6, 0), "T": (9, 9)}
    links = {**FOUR_BAR, "4": "C T"}
    error = refusal(mechanism(points, links, [turn("1", 1), turn("3", 5), turn("4", 1)]), exact)
    assert error.links == ("1", "2", "3")
    assert "two motions at once" in error.why


@both
def test_given_motions_that_stretch_a_link(exact: bool) -> None:
    """Given motions that would stretch a link are impossible."""
    scene = mechanism({"A": (0, 0), "B": (1, 0)}, {"1": "A B"}, motions={"A": move((0, 0)), "B": move((1, 0))})
    assert "impossible" in refusal(scene, exact).why


@both
def test_one_given_motion_leaves_an_open_chain_loose(exact: bool) -> None:
    """An open chain of which only one end is led can turn about it."""
    scene = mechanism({"A": (0, 0), "B": (1, 0), "C": (2, 2)}, {"1": "A B", "2": "B C"}, motions={"A": move((3, 1))})
    error = refusal(scene, exact)
    assert error.links == ("1", "2")
    assert "while the given motions stand still" in error.why


@both
def test_redundant_link_that_fits_is_no_fault(exact: bool) -> None:
    """A third parallel crank on a parallelogram repeats what the others state, and the pose is solved."""
    points = {"O": (0, 0), "C": (40, 0), "E": (20, 0), "A": (7, 11), "B": (47, 11), "D": (27, 11)}
    links = {"1": "O A", "2": "A B D", "3": "C B", "4": "E D", "frame": "O C E"}
    rates = solve(mechanism(points, links, [turn("1", 3, 5)]), exact)
    assert rates.omega == pytest.approx({"1": 3, "2": 0, "3": 3, "4": 3}, abs=1e-14)
    assert rates.alpha == pytest.approx({"1": 5, "2": 0, "3": 5, "4": 5}, abs=1e-13)
