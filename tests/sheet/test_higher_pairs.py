"""Gears and contacts on the sheet: what their symbols are, and what a task says of them."""

from __future__ import annotations

import math

import pytest
from higher import scenes
from sheets import composition_of

from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Polyline, Rect
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.symbols import HATCH, belt, reach, wheels
from graphplan.sheet.plates.view import View
from graphplan.sheet.words.rows import zero_rounding
from graphplan.sheet.words.task import data

EVERYWHERE = Rect(-math.inf, -math.inf, math.inf, math.inf)
SCENES = scenes()


@pytest.mark.parametrize("name", SCENES)
def test_every_pitch_circle_and_profile_is_drawn_once(name: str) -> None:
    """Every wheel has its pitch circle, every contact its two profiles, each ground its hatching; all reach no further
    than is said."""
    scene = SCENES[name]
    items = [*DrawnMechanism(scene, View(EVERYWHERE, 1.0, (0.0, 0.0))).items()]
    circles = [item for item in items if isinstance(item, Arc) and item.pen == pens.WHEEL]
    assert len(circles) == 2 * len(wheels(scene))
    profiles = [item for item in items if item.pen in (pens.LINK, pens.GROUND) and item.layer in ("wheels", "ground")]
    assert len(profiles) >= 2 * len(scene.contacts)
    assert {round(math.dist(*item.spots), 9) for item in items if item.pen == pens.HATCH} <= {HATCH}
    corners = [*reach(scene)]
    for arc in circles:
        assert (arc.centre[0] - arc.radius, arc.centre[1] - arc.radius) in [pytest.approx(one) for one in corners]


@pytest.mark.parametrize("name", ["racks", "roller-cam", "wheel-on-rail", "geared-five-bar"])
def test_a_pitch_point_is_no_vector(name: str) -> None:
    """What is laid off from a centre to a pitch point or a point of contact has no head and no colour of vectors."""
    plate = next(iter(composition_of(name, plan="polar").plates))
    given = [drawn for drawn in plate.steps if plate.given_pen(drawn)]
    assert not given


@pytest.mark.parametrize("name", SCENES)
def test_a_task_names_every_gear_and_contact(name: str) -> None:
    """The sentences of what is given speak of each gear's centres and of each contact's point."""
    scene, told = SCENES[name], " ".join(data(SCENES[name]))
    assert all(f"about {centre}" in told for gear in scene.gears for centre in gear.centres)
    assert all(f"at {contact.at}" in told for contact in scene.contacts)


def test_a_belt_touches_both_pulleys() -> None:
    """The straight parts of a belt are square to the radii where they end."""
    for crossed in (False, True):
        parts = [item for item in belt((0.0, 0.0), 5.0, (30.0, 10.0), 12.0, crossed) if isinstance(item, Polyline)]
        assert len(parts) == 2
        for (x, y), (u, v) in (part.spots for part in parts):
            assert (math.hypot(x, y), math.dist((u, v), (30, 10))) == pytest.approx((5.0, 12.0))
            assert (u - x) * x + (v - y) * y == pytest.approx(0, abs=1e-9)


def test_a_turning_that_is_but_rounding_is_nothing() -> None:
    """An angular acceleration far below what the accelerations make of it is told as 0, and all of a machine at rest.
    """
    values = {"acceleration": {"A": (3.0, 4.0)}, "alpha": {"2": 3e-15, "3": 0.2}, "omega": {"2": 1e-15}}
    assert zero_rounding(values, 10.0, 1.0) == values | {"alpha": {"2": 0.0, "3": 0.2}, "omega": {"2": 0.0}}
    for kind in ("velocity", "slide velocity", "slide acceleration"):
        assert zero_rounding({kind: {"A": (1e-15, 0.0)}}, 10.0, 1.0) == {kind: {"A": (0.0, 0.0)}}
