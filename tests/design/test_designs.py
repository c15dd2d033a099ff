"""Designs: what is chosen is what costs least, what is asked for stays, and its keys draw the same again."""

from __future__ import annotations

import tomllib
from dataclasses import replace

import pytest
from face import names, ran
from sampling import CORE

import graphplan as gp
from graphplan.design.cost import TERMS
from graphplan.design.decide import MAX_COST, candidates, construct
from graphplan.methods.design import OPEN, Design

NAMES = [term.name for term in TERMS]


def keys(name: str) -> dict[str, object]:
    """The keys of the design that is chosen for a scene."""
    table: dict[str, object] = tomllib.loads(ran("draw", name, "--design").out)["sheet"]
    return table


@pytest.mark.parametrize("name", CORE)
def test_the_keys_of_a_design_draw_the_same_again(name: str) -> None:
    """A scene with the keys that `draw --design` prints has the same steps, operations and errors, and looks no further
    than their design."""
    scene, chosen = gp.load(name), keys(name)
    again = scene.replace({f"sheet.{key}": value for key, value in chosen.items()})
    assert [*map(str, gp.construct(again).sentences())] == [*map(str, gp.construct(scene).sentences())]
    assert keys(name) == chosen


@pytest.mark.parametrize("name", CORE)
def test_the_chosen_design_costs_least_of_all_that_were_looked_at(name: str) -> None:
    """The textbook's is alone where it costs little; else it is looked at beside others, and the cheapest is drawn."""
    looked, chosen = candidates(scene := gp.load(name)), construct(scene).design
    (textbook,) = (one for one in looked if not one.cost.amounts[NAMES.index("departs")])
    (drawn,) = (one for one in looked if one.design == chosen)
    assert (len(looked) == 1) == (textbook.percent <= MAX_COST or bool(scene.sheet.kappa))
    assert all(drawn.percent <= one.percent for one in looked)


@pytest.mark.parametrize("name", CORE)
def test_strict_drawings_have_the_design_of_others(name: str) -> None:
    """Compasses alone draw the same plan by the same ways at the same scales."""
    scene = gp.load(name)
    assert construct(scene, Design(strict=True)).design == replace(construct(scene).design, strict=True)


@pytest.mark.parametrize("name", names())
def test_what_is_asked_for_is_drawn(name: str) -> None:
    """Plans and kappa that are named stay, whatever they cost."""
    scene = gp.load(name)
    if not scene.sheet.kappa:
        chosen = construct(scene, OPEN).design
        assert chosen.kappa is not None
        wishes = Design("polar", kappa=3 * chosen.kappa)
        asked = construct(scene, wishes).design
        assert (asked.motion, asked.kappa) == ("polar", wishes.kappa)
