"""Plans that are wrong as a whole: always told, as one mistake that costs once; a plan at another scale is told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from graphplan.commands import main

FRAMES = Path(__file__).parents[1] / "faults" / "frames"
POLAR = "--plan", "polar"

RIGHT: dict[str, tuple[str, ...]] = {"right.csv": POLAR, "o-right.csv": ()}
WRONG: dict[str, tuple[tuple[str, ...], str, str, str]] = {  # the options, the mistake's kind, its mark, and its words
    "reversed.csv": (POLAR, "reversed", "a", "v_A reversed"),
    "reversed-panel.csv": (POLAR, "reversed", "a", "v_A reversed"),
    "reversed-velocities-only.csv": (POLAR, "reversed", "a", "v_A reversed"),
    "reversed-dots.svg": (POLAR, "reversed", "a", "v_A reversed"),
    "acc-reversed.csv": (POLAR, "plan reversed", "a'", "all of the acceleration plan is reversed"),
    "acc-turned-30.csv": (POLAR, "plan turned", "a'", "all of the acceleration plan is turned by 30°"),
    "vel-turned-30.csv": (POLAR, "plan turned", "a", "all of the velocity plan is turned by 30°"),
    "vel-scaled-1.7.csv": (POLAR, "plan of another scale", "a", "1.7 times as large"),
    "o-N-reversed.csv": ((), "plan reversed", "b", "all of the N-plan is reversed"),
    "o-N-turned30.csv": ((), "plan turned", "b", "all of the N-plan is turned by 30°"),
}
READ: dict[str, str] = {  # where nothing is given, it is no mistake, and told
    "o-N-scaled.csv": "all of the N-plan is drawn 1.7 times as large as on the task's sheet",
    "o-v-reversed.csv": "velocities turned clockwise",
}


def verified(name: str, options: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> dict[str, object]:
    assert main(["verify", str(FRAMES / "reversed.toml"), str(FRAMES / name), "--json", "-q", *options]) == 0
    return json.loads(capsys.readouterr().out)  # type: ignore[no-any-return]


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_drawing_is_right(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """It has all points."""
    found = verified(name, RIGHT[name], capsys)
    assert found["first_wrong"] is None
    assert found["score"]["total"] == 100  # type: ignore[index]


@pytest.mark.parametrize("name", WRONG)
def test_a_plan_that_is_wrong_as_a_whole_is_one_mistake(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """It is told by its kind and at the first mark that shows it; what follows from it is right."""
    options, kind, mark, words = WRONG[name]
    found = verified(name, options, capsys)
    first = found["first_wrong"]
    assert isinstance(first, dict)
    assert (first["kind"], first["mark"]) == (kind, mark)
    assert words in first["mistake"]
    wrong = [step for step in found["steps"] if step["verdict"] == "wrong"]  # type: ignore[attr-defined]
    assert len(wrong) == 1
    if "only" not in name:
        assert 65 <= found["score"]["total"] <= 95  # type: ignore[index]


@pytest.mark.parametrize("name", READ)
def test_what_is_given_nowhere_is_told_and_right(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A scale that the scene does not give, and the one sense in which all velocities are turned."""
    found = verified(name, (), capsys)
    assert found["first_wrong"] is None
    assert READ[name] in str(found["reading"])


def test_a_mistake_is_told_where_the_pole_has_its_letter(capsys: pytest.CaptureFixture[str]) -> None:
    """A plan about a labelled pole is not laid elsewhere so that it fits: the normal acceleration is reversed."""
    assert main(["verify", str(FRAMES / "praised.toml"), str(FRAMES / "praised.svg"), "--json", "-q", *POLAR]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["first_wrong"]["kind"] == "normal acceleration reversed"
    assert "B about A" in found["first_wrong"]["mistake"]
    assert 65 <= found["score"]["total"] <= 95
