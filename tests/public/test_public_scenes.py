"""Scenes in Python: made from mappings, changed by path, written again, and changed by nobody else."""

from __future__ import annotations

import pickle
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import graphplan as gp

FOUR_BAR: dict[str, Any] = {
    "title": 'A "four-bar"',
    "points": {"O": (0, 0), "A": np.array([20.0, 110.0]), "B": 135 + 225j, "C": [310, 0],
               "Mα": {"from": "A", "distance": np.float64(170.5), "angle": 100}},
    "links": {1: "O A", "2": "A B Mα", "3": "B C", "frame": "O C"},
    "drive": [{"link": "1", "omega": 10}],
    "find": {"velocity": ["B"], "acceleration": ["B"]},
}


def test_a_mapping_is_a_scene() -> None:
    """Vectors may be tuples, arrays or complex numbers, and the scene's file says the same."""
    scene = gp.scene(FOUR_BAR)
    assert scene.points["B"] == (135, 225)
    assert gp.parse(scene.toml()) == scene
    assert gp.solve(scene).velocity["B"] == gp.solve(gp.load("four-bar")).velocity["B"]


@pytest.mark.parametrize("tables", [{}, {"points": {"O": object()}}, {"points": {"O": float("nan")}},
                                    {**FOUR_BAR, "links": {"1": "O Z"}}])
def test_a_faulty_mapping_is_an_error(tables: dict[str, Any]) -> None:
    """What a file could not say, or says wrongly, is one of graphplan's own errors."""
    with pytest.raises(gp.GraphplanError):
        gp.scene(tables)


@pytest.mark.parametrize(("path", "value", "line"), [
    ("points.A.0", 25, "A = [25, 110]"), ("points.A.0", 25.5, "A = [25.5, 110]"),
    ("points.A.0", np.float64(0.1), "A = [0.1, 110]"), ("drive.0.omega", Fraction(1, 4), "omega = 0.25"),
    ("points.A", (1, 2), "A = [1, 2]"), ("points.A", 1 + 2j, "A = [1.0, 2.0]"),
    ("find.velocity", ["M"], 'velocity = ["M"]'), ("title", "Mine", 'title = "Mine"'),
    ("sheet.frame", "gost", 'frame = "gost"'), ("gravity", [0, -9.81], "gravity = [0, -9.81]"),
])
def test_a_value_is_replaced_by_its_path(path: str, value: Any, line: str) -> None:
    """Numbers, vectors, lists and texts, decimals as they are written; the scene itself stays as it was."""
    scene = gp.load("four-bar")
    before = scene.toml()
    assert line in [" ".join(row.split()) for row in scene.replace(path, value).toml().splitlines()]
    assert scene.toml() == before


@pytest.mark.parametrize("path", ["points.Z.0", "points.A.5", "pionts.A.0", "points.A.0.1", ""])
def test_a_path_that_leads_nowhere_is_refused(path: str) -> None:
    """Nothing is made up where no value stands."""
    with pytest.raises(gp.GraphplanError):
        gp.load("four-bar").replace(path, 1)


def test_several_values_are_replaced_at_once() -> None:
    """A mapping of values by paths gives what one after the other gives."""
    scene = gp.load("four-bar")
    values = {"points.A.0": 25, "points.B": (140, 220), "drive.0.omega": 8.5, "title": "Mine"}
    in_turn = scene
    for path, value in values.items():
        in_turn = in_turn.replace(path, value)
    assert scene.replace(values) == in_turn == gp.parse(in_turn.toml(), "four-bar")


def test_comments_stay_where_a_number_is_replaced() -> None:
    """The text is edited in its place, also where a key is new in its table."""
    scene = gp.load("four-bar").replace("points.A.0", 25).replace("sheet.frame", "gost").replace("title", "Mine")
    assert "# the coupler curve" in scene.toml()


def test_nobody_changes_a_scene() -> None:
    """Neither its fields nor its points; a copy in another process is equal."""
    scene = gp.load("four-bar")
    with pytest.raises(TypeError, match="cannot be changed"):
        scene.points["A"] = (0, 0)  # type: ignore[index]
    with pytest.raises(AttributeError):
        scene.title = "Mine"  # type: ignore[misc]
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert len(repr(scene)) < 100
