"""Pencil errors, costs and preferences at the command line."""

from __future__ import annotations

import json

import pytest

from graphplan.commands import main


def test_solve_tells_drawing_errors_where_a_pencil_is_given(capsys: pytest.CaptureFixture[str]) -> None:
    """With --pencil each result has its error in mm and in its own unit; a pencil twice as blunt doubles them."""
    found = []
    for sizes in ("point=0.1,edge=0.1,angle=0.05,opening=0.1", "point=0.2,edge=0.2,angle=0.1,opening=0.2"):
        assert main(["solve", "four-bar", "--pencil", sizes]) == 0
        found.append(json.loads(capsys.readouterr().out)["pencil"]["results"]["velocity"]["B"])
    assert found[1]["mm"] == pytest.approx(2 * found[0]["mm"])
    assert found[1]["value"] == pytest.approx(2 * found[0]["value"])
    assert main(["solve", "four-bar"]) == 0
    assert "pencil" not in json.loads(capsys.readouterr().out)


def test_steps_tell_cost_and_errors_as_data(capsys: pytest.CaptureFixture[str]) -> None:
    """`steps --json` has what the drawing costs, and how far off each result is, with the step that most comes from."""
    assert main(["steps", "stephenson", "--json", "--prefer", "balanced"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["cost"]["operations"] > 0
    assert set(data["pencil"]["results"]["velocity"]) == set("DECAB")
    assert data["pencil"]["worst step"]["sentence"]
    assert any("compared" in note for note in data["forms"])


@pytest.mark.costly
def test_cost_lists_every_form_on_every_plan(capsys: pytest.CaptureFixture[str]) -> None:
    """`cost` has orthogonal and polar plans, by set squares and strictly, each with its forms."""
    assert main(["cost", "four-bar"]) == 0
    out = capsys.readouterr().out
    for heading in ("Orthogonal plans, with set squares", "Polar plans, with set squares",
                    "Orthogonal plans, with compasses and straightedge", "Polar plans, with compasses"):
        assert heading in out
    assert max(map(len, out.splitlines())) <= 120


@pytest.mark.parametrize(("arguments", "why"), [
    (["solve", "four-bar", "--pencil", "crayon=1"], "crayon"),
    (["solve", "four-bar", "--pencil", "point=-1"], "point"),
    (["steps", "four-bar", "--prefer", "quick", "--method", "trial"], "--prefer"),
])
def test_bad_choices_get_one_line(arguments: list[str], why: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A pencil that is none, or two choices at once, is one line and exit status 2."""
    assert main(arguments) == 2
    streams = capsys.readouterr()
    assert (streams.out, len(streams.err.splitlines())) == ("", 1)
    assert why in streams.err
