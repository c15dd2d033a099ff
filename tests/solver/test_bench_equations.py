"""The bench gives other programs the very equations of the scenes."""

from __future__ import annotations

import math

import pytest
from problems import SCENES, equations

import graphplan as gp
from graphplan.solver.rates import motion_equations


@pytest.mark.parametrize("name", SCENES)
def test_the_equations_for_other_numbers_are_those_of_the_scene(name: str) -> None:
    """What CasADi and JAX are given, over floats."""
    scene = gp.load(name)
    places = {point: (float(x), float(y)) for point, (x, y) in scene.points.items()}
    for found, row in zip(equations(scene, places, math.sqrt).rows, motion_equations(scene).rows, strict=True):
        assert {at: float(a) for at, a in found.items()} == pytest.approx({at: float(a) for at, a in row.items()})
