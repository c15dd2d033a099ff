"""Zhukovsky's lever: balances without reactions, at rest too, and single reactions by freeing their pairs."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from random_loads import loaded
from random_mechanisms import GROUPS, mechanism

from graphplan.check.report import report
from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.bracing import bracing
from graphplan.mechanism.model import Balance, Find, Scene, TurningDrive
from graphplan.mechanism.scene import load

SOME = st.lists(st.sampled_from(sorted(GROUPS)), min_size=1, max_size=2)


def sound(names: list[str], seed: int) -> Scene:
    """A random loaded mechanism whose links are held just once."""
    scene = mechanism(names, seed)
    assume(bracing(scene).sound)
    return loaded(scene, seed)


@settings(max_examples=25, deadline=None)
@given(SOME, st.integers(0, 10**6))
def test_lever_at_rest(names: list[str], seed: int) -> None:
    """A mechanism at rest has a lever, too: its velocities are assumed, of any size."""
    scene = sound(names, seed)
    drive = scene.drives[0]
    assert isinstance(drive, TurningDrive)
    try:
        found = report(replace(scene, drives=(replace(drive, omega=Fraction(0)),)), exact=True)
    except SingularPose:
        assume(False)
        raise
    assert found.check["force"] == 0
    assert found.results["lever moment"] == found.results["balance moment"]


@settings(max_examples=25, deadline=None)
@given(SOME, st.integers(0, 10**6))
def test_single_reaction_by_a_freed_pair(names: list[str], seed: int) -> None:
    """One reaction is found without any other: its pair is freed, and two levers give its components."""
    scene = sound(names, seed)
    joint = scene.joints[seed % len(scene.joints)]
    try:
        found = report(replace(scene, find=Find((), (), (joint,))), exact=True, plan="lever")
    except SingularPose:
        assume(False)
        raise
    assert found.check["force"] == 0
    assert found.results["reaction"]
    assert not [step for step in found.drawing.program.steps if step.panel.startswith("force plan")]


def test_lever_of_two_drives() -> None:
    """A mechanism of two drives has a lever for each balance, the other one held."""
    scene = load("five-bar")
    drives = scene.drives
    assert len(drives) == 2
    balances = tuple(Balance(drive.link) for drive in drives)
    found = report(replace(loaded(scene, 5), loads=replace(loaded(scene, 5).loads, balances=balances)), exact=True)  # type: ignore[type-var]
    assert found.check["force"] == 0
    assert len(found.results["lever moment"]) == 2


def test_lever_needs_something_to_hold() -> None:
    """With two drives, a balance that no drive could stand for is refused by the lever, with the way out."""
    scene = load("five-bar")
    hinged = {link for link, points in scene.links.items() if set(points) & set(scene.links["frame"])}
    point = next(p for p in scene.joints if not set(scene.links_of[p]) & hinged)
    first = Balance(scene.links_of[point][0], point, (Fraction(3), Fraction(1)))
    forced = loaded(scene, 5)
    assert forced.loads is not None
    forced = replace(forced, loads=replace(forced.loads, balances=(first, Balance(scene.drives[1].link))))
    with pytest.raises(Refused, match="--plan polygons"):
        report(forced, plan="lever")
    assert report(forced, plan="polygons", exact=True).check["force"] == 0
