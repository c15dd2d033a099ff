"""The trusted construction: a wrong plan is shown by no command, in the given pose or in another; faults are sown in
the table of primitives."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from face import ran

import graphplan as gp
from graphplan.errors import Undrawable
from graphplan.kernel import TABLE

Rule = Callable[..., Any]
COMMANDS = {
    "draw": ("-o", "sheet.svg"), "steps": ("--json",), "solve": (), "export": ("-o", "chain.ggb"),
    "handout": ("-o", "handout.pdf"), "cost": (), "cycle": ("--positions", "3", "-o", "table.csv"),
    "verify": ("points.csv", "--report", "report.json"),
}
WRONG = ("parallel", "meet", "normal", "transfer", "similar")


def sow(patch: pytest.MonkeyPatch, op: str, fault: Callable[[Rule], Rule]) -> None:
    """Put a faulty rule in the table."""
    patch.setitem(TABLE, op, replace(TABLE[op], rule=fault(TABLE[op].rule)))


def off_by(part: float, beyond: int | None = None) -> Callable[[Rule], Rule]:
    """Of what a rule gives the first number is off by a part; only where it is `beyond` some number."""
    def fault(rule: Rule) -> Rule:
        def off(domain: Any, *values: Any, **params: Any) -> Any:
            first, *others = rule(domain, *values, **params)
            share = domain.lift(Fraction(part))
            if beyond is not None:
                share = share * (domain.lift(1) + domain.sign(first - domain.lift(beyond), domain.lift(1)))
            return first + first * share, *others

        return off

    return fault


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("op", WRONG)
def test_no_command_shows_a_wrong_plan(command: str, op: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """With one rule off by a ten-millionth each command ends with status 1, one line that names the number, no file."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "points.csv").write_text("mark,x,y,panel\nA,32.1,46.0,mechanism\n")
    before = sorted(tmp_path.iterdir())
    sow(monkeypatch, op, off_by(1e-7))
    status, out, err = ran(command, "four-bar", *COMMANDS[command])
    assert (status, out, err.count("\n")) == (1, "", 1)
    assert "the construction and the analytic solver disagree" in err
    assert "as drawn" in err
    assert sorted(tmp_path.iterdir()) == before


def test_check_shows_both_where_they_differ(monkeypatch: pytest.MonkeyPatch) -> None:
    """`check` prints what differs, beside what is right and its own size, and ends with status 1."""
    sow(monkeypatch, "parallel", off_by(1e-7))
    done = ran("check", "four-bar", "--json")
    assert (done.status, done.json["agrees"]) == (1, False)
    results = done.json["results"]
    assert results["velocity"]["B"].keys() == {"construction", "solver", "difference", "size"}
    assert any(entry["difference"] > 1e-9 * entry["size"] for named in results.values() for entry in named.values())
    assert "disagree" in done.err


@pytest.mark.parametrize(("name", "op"), [("four-bar", "parallel"), ("four-bar", "meet"), ("four-bar", "transfer"),
                                          ("rosenauer-basic", "similar"), ("ozols-5-3", "lay_along"),
                                          ("triad-loaded", "lay_off")])
def test_check_names_the_first_step_that_breaks_a_claim(name: str, op: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With one rule off, `check` ends with status 1 and one line for the first step that is not what it should be."""
    sow(monkeypatch, op, off_by(1e-3))
    status, _, err = ran("check", name)
    assert status == 1
    drawing = gp.construct(gp.load(name), checked=False)
    drawn = drawing.drawn
    first = next(step.index for step in drawn.steps if step.op.name == op and drawing.values[step.index][0])
    (claim,) = (line for line in err.splitlines() if line.startswith("check: "))
    assert claim.startswith(f"check: step {drawn.number(first)} ({drawn.text(first)} = {op}(")


@pytest.mark.costly
def test_right_numbers_do_not_excuse_a_step_that_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plan that begins elsewhere than where it is put gives the same numbers; no command shows it all the same."""
    sow(monkeypatch, "begin", lambda rule: lambda domain, **at: tuple(
        number + domain.lift(7) for number in rule(domain, **at)))
    status, _, err = ran("check", "ozols-5-1")
    assert (status, err.count("\n"), "not where it is given" in err) == (1, 1, True)
    assert [ran(command, "ozols-5-1").status for command in ("solve", "steps", "cost")] == [1, 1, 1]
    with pytest.raises(gp.Disagreement, match="not where it is given"):
        gp.construct(gp.load("ozols-5-1"))


@pytest.mark.parametrize("part", [1e-3, 1e-7, 1e-11])
def test_the_slightest_fault_is_no_rounding(part: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """A rule that is off by far more than rounding, though by less than nine digits, is proven to be wrong."""
    sow(monkeypatch, "meet", off_by(part))
    with pytest.raises(gp.Disagreement, match="as solved"):
        gp.construct(gp.load("four-bar"))
    assert gp.construct(gp.load("four-bar"), checked=False).program


def test_what_cannot_be_drawn_is_not_told_as_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """In a regular pose in which no way can be drawn, `solve` tells the solver's numbers and says so; sheets are not
    drawn."""
    def never(domain: Any, *values: Any) -> Any:
        raise Undrawable("lines-parallel", "the two lines are parallel")

    drawn = ran("solve", "four-bar").json
    sow(monkeypatch, "meet", lambda rule: never)
    told = ran("solve", "four-bar").json
    assert all("analytic solver alone" in way for ways in told["method"].values() for way in ways)
    assert (told["check"], "steps" in told) == ({}, False)
    for name, entry in drawn["points"].items():
        for kind, vector in entry.items():
            assert told["points"][name][kind] == pytest.approx(vector, rel=1e-12, abs=1e-9)
    assert ran("draw", "four-bar")[:2] == (3, "")


# ---- in other poses than the given one -------------------------------------------------------------------------------


def test_a_pose_that_is_wrong_has_no_numbers(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Where a rule is off in some poses alone, these are named, and the others are as they were."""
    right = gp.construct(gp.load("four-bar")).evaluate(gp.follow(gp.load("four-bar"), 24))
    sow(monkeypatch, "meet", off_by(1e-7, beyond=180))  # v_b is that far to the right in two poses
    drawing = gp.construct(gp.load("four-bar"))
    for compiled in (False, True):
        (series,) = drawing.stream(24, compiled=compiled)
        assert {*series.faults.values()} == {"the construction and the analytic solver differ"}
        assert [*series.faults] == [1, 2]
        for kind in ("velocity", "acceleration"):
            for name, z in getattr(series, kind).items():
                assert np.flatnonzero(np.isnan(z)).tolist() == [1, 2]
                whole = getattr(right, kind)[name]
                assert np.array_equal(np.delete(z, [1, 2]), np.delete(whole, [1, 2]))
    monkeypatch.chdir(tmp_path)
    status, out, err = ran("cycle", "four-bar", "--positions", "24", "-o", "table.csv")
    assert (status, out, [*tmp_path.iterdir()]) == (1, "", [])
    assert [line[:24] for line in err.splitlines() if "disagree" in line] == ["pose 1: the construction",
                                                                            "pose 2: the construction"]
    done = ran("cycle", "four-bar", "--positions", "12", "--animate", "film.svg")
    assert "the mechanism alone, without a construction, in 1 of 12 poses" in done.err


# ---- many poses, block by block --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "ozols-13-6"])
def test_a_stream_is_the_poses_of_a_turn(name: str) -> None:
    """It gives what the construction gives of all poses at once, to the last bit, by machine code or not."""
    drawing = gp.construct(gp.load(name))
    whole = drawing.evaluate(gp.follow(drawing.scene, 500))
    for compiled in (False, True):
        (series,) = drawing.stream(500, compiled=compiled)
        assert series.faults.keys() == whole.faults.keys()
        assert series.results.keys() == whole.results.keys()
        for kind, named in whole.results.items():
            for of, z in named.items():
                assert np.array_equal(series.results[kind][of], z, equal_nan=True), (kind, of)
        for point, z in whole.points.items():
            assert np.array_equal(series.points[point], z, equal_nan=True), point


@pytest.mark.costly
def test_a_summary_is_that_of_all_poses(tmp_path: Path) -> None:
    """Over several blocks extremes, their travels, means and the first failure are those of the arrays; two processes
    find the same, and write the same table."""
    drawing, span, count = gp.construct(gp.load("plough-lift")), (0.0, 40.0), 70_000
    stream = drawing.stream(count, span, checked=False)
    blocks = [*stream]
    assert len(blocks) > 1
    told, faults = stream.summary(), sum(len(block.faults) for block in blocks)
    assert (told.count, told.failures) == (count, faults)
    assert 0 < faults < count
    start = 0
    for block in blocks:
        if block.faults:
            assert told.first_failure[0] == start + min(block.faults)
            break
        start += len(block.poses)
    for kind, named in told.results.items():
        for name, extremes in named.items():
            z = np.concatenate([block.results[kind][name] for block in blocks])
            sizes = np.abs(z) if np.iscomplexobj(z) else z
            travel = np.concatenate([block.poses.travel for block in blocks])
            assert (extremes.least, extremes.greatest) == (np.nanmin(sizes), np.nanmax(sizes))
            assert sizes[travel == extremes.greatest_at] == extremes.greatest
            assert extremes.mean == pytest.approx(np.nanmean(sizes), rel=1e-12)
            assert extremes.count == count - faults
    shared = drawing.stream(count, span, checked=False, workers=2)
    assert shared.summary() == told
    for each, path in ((stream, tmp_path / "one.csv"), (shared, tmp_path / "two.csv")):
        each.save(str(path))
    assert (tmp_path / "one.csv").read_bytes() == (tmp_path / "two.csv").read_bytes()


def test_what_a_stream_has_not_is_refused() -> None:
    """Kinds that the scene has no reading of, and no positions, are told before any work is done."""
    drawing = gp.construct(gp.load("four-bar"))
    with pytest.raises(gp.Refused, match="torque"):
        drawing.stream(10, only=("torque",))
    with pytest.raises(gp.Refused, match="at least 1"):
        drawing.stream(0)


def test_numbers_by_machine_code_are_the_same() -> None:
    """Velocities in all poses of a turn agree to the last bit."""
    pytest.importorskip("numba")
    scene = gp.load("four-bar")
    drawing, poses = gp.construct(scene), gp.follow(scene, 7)
    plain, compiled = (drawing.evaluate(poses, compiled=compiled).velocity["M"] for compiled in (False, True))
    assert plain.tobytes() == compiled.tobytes()


def test_machine_code_without_numba_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """It says what to install."""
    monkeypatch.setitem(sys.modules, "numba", None)
    drawing = gp.construct(gp.load("four-bar"))
    with pytest.raises(gp.Refused, match=r"graphplan\[numba\]"):
        drawing.evaluate(points={"A": np.array([20 + 110j])}, compiled=True)
