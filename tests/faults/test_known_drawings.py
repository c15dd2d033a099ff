"""Drawings that were once judged falsely: each is judged as it is right."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from graphplan.commands import main

DRAWINGS = Path(__file__).parent / "drawings"
RIGHT = (  # of a scene, by other conventions than the sheet's or by the letters of its neighbours
    ("four-bar-a", "final_only.csv"), ("four-bar-a", "polar-plan.svg"), ("four-bar-a", "polar-plan.svg", "polar"),
    ("four-bar-a", "scale0.5.csv"), ("four-bar-a", "scale0.8.csv"), ("four-bar-a", "true_vectors_at_joints.csv"),
    ("four-bar-a", "turned_other_way.csv"), ("watt", "watt-right.svg"),
)  # fmt: skip
WRONG = (
    ("four-bar-a", "normal-omitted.csv", "", "normal acceleration omitted"),
    ("four-bar-a", "polar-plan-wrong.svg", "", "plan turned"),
    ("four-bar-a", "polar-plan-wrong.svg", "polar", "plan turned"),
)


def judged(capsys: pytest.CaptureFixture[str], scene: str, name: str, plan: str = "") -> Any:
    """What `verify` says of a drawing."""
    options = ["--plan", plan] if plan else []
    assert main(["verify", str(DRAWINGS / f"{scene}.toml"), str(DRAWINGS / name), *options, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("case", RIGHT, ids=" ".join)
def test_a_right_drawing_has_no_wrong_step(case: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever its scale, sense and plan, and however near its letters are to other marks."""
    found = judged(capsys, *case)
    assert found["first_wrong"] is None
    assert found["score"]["velocity"] == 100


@pytest.mark.parametrize(("scene", "name", "plan", "kind"), WRONG)
def test_a_wrong_drawing_is_told_its_mistake(scene: str, name: str, plan: str, kind: str,
                                             capsys: pytest.CaptureFixture[str]) -> None:
    """By the kind of it."""
    assert judged(capsys, scene, name, plan)["first_wrong"]["kind"] == kind
