"""A scene says how its plans are drawn; whoever draws it has the last word."""

from __future__ import annotations

from pathlib import Path

import pytest

import graphplan as gp
from graphplan.errors import SceneError
from graphplan.mechanism.model import Scene

TEXT = (Path(gp.__file__).parent / "scenes" / "jaanimets-10.toml").read_text()


def scene_with(plan: str) -> Scene:
    """A loaded scene whose sheet names this plan."""
    return gp.parse(f'{TEXT}\n[sheet]\nplan = "{plan}"\n', "a scene")


@pytest.mark.parametrize(("own", "asked", "drawn"), [
    ("polar", "", "polar"), ("polar", "orthogonal", "orthogonal"), ("orthogonal", "", "orthogonal"),
    ("polar", "lever", "polar"), ("polar,lever", "orthogonal", "orthogonal")])
def test_the_scene_chooses_what_is_not_asked_for(own: str, asked: str, drawn: str) -> None:
    """`[sheet] plan` is drawn as `--plan` would have it, word for word, unless that is asked for otherwise."""
    drawing = gp.construct(scene_with(own), plan=asked)
    assert drawing.plan == drawn
    assert any(step.panel.startswith("force plan") for step in drawing.program.steps) == ("lever" not in own + asked)


@pytest.mark.parametrize("wrong", ["pole", "polar,", "polar lever"])
def test_a_plan_that_does_not_exist_is_a_fault(wrong: str) -> None:
    """The fault names it and what is meant."""
    with pytest.raises(SceneError, match="plan"):
        scene_with(wrong)
