"""The trusted construction: a wrong plan is shown by no command, and given up for a way that is right."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from four_bars import four_bar

import graphplan as gp
from graphplan.check import trusted as checking
from graphplan.check.poses import points_where_sound
from graphplan.check.trusted import report
from graphplan.commands import main
from graphplan.errors import Undrawable
from graphplan.kernel import TABLE
from graphplan.methods.construct import constructions
from graphplan.methods.construction import Construction

COMMANDS = {
    "draw": ("-o", "sheet.svg"), "steps": ("--json",), "solve": (), "export": ("-o", "chain.ggb"),
    "handout": ("-o", "handout.pdf"), "cost": (), "cycle": ("--positions", "3", "-o", "table.csv"),
    "verify": ("points.csv", "--report", "report.json"),
}
WRONG = ("parallel", "meet", "normal", "transfer", "similar")


def spoilt(monkeypatch: pytest.MonkeyPatch, op: str, part: float) -> None:
    """One rule of the drawing board is off by a part of its first number."""
    rule = TABLE[op].rule

    def off(domain: Any, *values: Any, **params: Any) -> Any:
        first, *others = rule(domain, *values, **params)
        return first + first * domain.lift(Fraction(part)), *others

    monkeypatch.setitem(TABLE, op, replace(TABLE[op], rule=off))


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("op", WRONG)
def test_no_command_shows_a_wrong_plan(command: str, op: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path,
                                       capsys: pytest.CaptureFixture[str]) -> None:
    """With one rule off by a ten-millionth each command ends with status 1, one line that names the number, no file."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "points.csv").write_text("mark,x,y,panel\nA,32.1,46.0,mechanism\n")
    before = sorted(tmp_path.iterdir())
    spoilt(monkeypatch, op, 1e-7)
    assert main([command, "four-bar", *COMMANDS[command]]) == 1
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.count("\n") == 1
    assert "the construction and the analytic solver disagree" in streams.err
    assert "as drawn" in streams.err
    assert sorted(tmp_path.iterdir()) == before


def test_check_shows_both_opinions_where_they_differ(monkeypatch: pytest.MonkeyPatch,
                                                     capsys: pytest.CaptureFixture[str]) -> None:
    """`check` prints what differs, beside what is right and its own size, and ends with status 1."""
    spoilt(monkeypatch, "parallel", 1e-7)
    assert main(["check", "four-bar", "--json"]) == 1
    streams = capsys.readouterr()
    told = json.loads(streams.out)
    assert told["agrees"] is False
    assert told["results"]["velocity"]["B"].keys() == {"construction", "solver", "difference", "size"}
    assert any(entry["difference"] > 1e-9 * entry["size"] for named in told["results"].values()
               for entry in named.values())
    assert "disagree" in streams.err


@pytest.mark.parametrize(("name", "op"), [("four-bar", "parallel"), ("four-bar", "meet"), ("four-bar", "transfer"),
                                          ("rosenauer-basic", "similar"), ("ozols-5-3", "lay_along"),
                                          ("triad-loaded", "lay_off")])
def test_check_names_the_first_step_that_breaks_a_claim(name: str, op: str, monkeypatch: pytest.MonkeyPatch,
                                                        capsys: pytest.CaptureFixture[str]) -> None:
    """With one rule off, `check` ends with status 1 and one line for the first step that is not what it should be."""
    spoilt(monkeypatch, op, 1e-3)
    assert main(["check", name]) == 1
    drawing = gp.construct(gp.load(name), checked=False)
    drawn = drawing.drawn
    first = next(step.index for step in drawn.steps if step.op.name == op and drawing.values[step.index][0])
    (claim,) = (line for line in capsys.readouterr().err.splitlines() if line.startswith("check: "))
    assert claim.startswith(f"check: step {drawn.number(first)} ({drawn.text(first)} = {op}(")


@pytest.mark.costly
def test_right_numbers_do_not_excuse_a_step_that_is_wrong(monkeypatch: pytest.MonkeyPatch,
                                                          capsys: pytest.CaptureFixture[str]) -> None:
    """A plan that begins elsewhere than where it is put gives the same numbers; no command shows it all the same."""
    rule = TABLE["begin"].rule
    monkeypatch.setitem(TABLE, "begin", replace(TABLE["begin"], rule=lambda domain, **at: tuple(
        number + domain.lift(7) for number in rule(domain, **at))))
    assert main(["check", "ozols-5-1"]) == 1
    error = capsys.readouterr().err
    assert (error.count("\n"), "not where it is given" in error) == (1, True)
    assert [main([command, "ozols-5-1"]) for command in ("solve", "steps", "cost")] == [1, 1, 1]
    with pytest.raises(gp.Disagreement, match="not where it is given"):
        gp.construct(gp.load("ozols-5-1"))


@pytest.mark.parametrize("part", [1e-3, 1e-7, 1e-11])
def test_the_slightest_fault_is_no_rounding(part: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """A rule that is off by far more than rounding, though by less than nine digits, is proven to be wrong."""
    spoilt(monkeypatch, "meet", part)
    with pytest.raises(gp.Disagreement, match="as solved"):
        gp.construct(gp.load("four-bar"))
    assert gp.construct(gp.load("four-bar"), checked=False).program


def test_another_way_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """A construction that is wrong is given up for the next that is right; where none is, the first is what is told."""
    scene = gp.load("four-bar")
    right = next(constructions(scene))
    wrong = replace(right, readings=tuple(
        replaced(reading, right) if (reading.kind, reading.of) == ("velocity", "B") else reading
        for reading in right.readings))

    def ways(*found: Construction) -> Any:
        def these(scene: Any, **how: Any) -> Iterator[Construction]:
            yield from found

        return these

    monkeypatch.setattr(checking, "constructions", ways(wrong, wrong, right))
    assert report(scene).drawing is right
    monkeypatch.setattr(checking, "constructions", ways(wrong, wrong))
    with pytest.raises(gp.Disagreement, match="velocity of B"):
        report(scene)


def replaced(reading: Any, drawing: Construction) -> Any:
    """The reading of B's velocity, read from the vector of A."""
    return reading._replace(marks=next(r.marks for r in drawing.readings if (r.kind, r.of) == ("velocity", "A")))


def test_a_singular_pose_has_no_numbers() -> None:
    """Bars in line: nothing is read of the construction, whether it can be drawn for other poses or not."""
    text = four_bar("omega = 1", A="[3, 0]", B="[7, 0]", C="[10, 0]")
    with pytest.raises(gp.GraphplanError):
        _ = gp.construct(gp.parse(text, "dead")).velocity["B"]


def test_what_cannot_be_drawn_is_not_told_as_drawn(monkeypatch: pytest.MonkeyPatch,
                                                   capsys: pytest.CaptureFixture[str]) -> None:
    """In a regular pose in which no way can be drawn, `solve` tells the solver's numbers and says so; sheets are not
    drawn."""
    def never(domain: Any, *values: Any) -> Any:
        raise Undrawable("lines-parallel", "the two lines are parallel")

    assert main(["solve", "four-bar"]) == 0
    drawn = json.loads(capsys.readouterr().out)
    monkeypatch.setitem(TABLE, "meet", replace(TABLE["meet"], rule=never))
    assert main(["solve", "four-bar"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert all("analytic solver alone" in way for ways in told["method"].values() for way in ways)
    assert (told["check"], "steps" in told) == ({}, False)
    for name, entry in drawn["points"].items():
        for kind, vector in entry.items():
            assert told["points"][name][kind] == pytest.approx(vector, rel=1e-12, abs=1e-9)
    assert main(["draw", "four-bar"]) == 3
    assert capsys.readouterr().out == ""


def test_a_page_shows_no_pose_that_the_solver_does_not_confirm(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the poses of a turn those are left out in which the replayed construction differs from the solver."""
    drawing = gp.construct(gp.load("four-bar"))
    turn = gp.cycle.follow(drawing.scene, 12)
    assert all(np.isfinite(z).all() for z in points_where_sound(drawing, turn.points, turn.guides).values())
    real = Construction.evaluate

    def spoilt_in_one_pose(self: Construction, *where: Any, **how: Any) -> Any:
        found = real(self, *where, **how)
        found.results["omega"]["3"][5] *= 1 + 1e-9
        return found

    monkeypatch.setattr(Construction, "evaluate", spoilt_in_one_pose)
    for z in points_where_sound(drawing, turn.points, turn.guides).values():
        assert np.flatnonzero(np.isnan(z)).tolist() == [5]
