"""The rows of the surveys: true values and right choices on small scenes; times are never looked at."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from graphplan.bench import growth, settings
from graphplan.bench.draughtsman import LONG_REASON, Draft, drafts
from graphplan.bench.growth import POSITIONS, STAGES, TRAVEL, chain, stages
from graphplan.bench.machine import FORCES, MOTION, MachineMeasure, measures
from graphplan.bench.problem import ARITHMETICS, COMPILED, FRACTIONS, LAPACK, SOLVERS, Problem, binary, truth
from graphplan.bench.rows import front, read, stairs, table
from graphplan.bench.settings import ANSWER, ROUNDS, STRIPS
from graphplan.cycle import follow
from graphplan.design.decide import construct
from graphplan.design.hand import Pencil
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load, packaged_names
from graphplan.solver import solve


@pytest.fixture(scope="module")
def four_bar() -> Scene:
    """The four-bar, which all methods draw alike."""
    return load("four-bar")


def test_every_arithmetic_is_measured_against_the_truth(four_bar: Scene) -> None:
    """Both plans in every arithmetic, and the solver: fractions are exact, enclosures all but, floats to rounding."""
    rows = list(measures(four_bar, compiled=0))
    assert {(row.plan, row.arithmetic) for row in rows} == {
        *(("", name) for name in SOLVERS), *((plan, name) for plan in ("orthogonal", "polar") for name in ARITHMETICS)}
    for row in rows:
        if row.arithmetic == COMPILED:
            assert row.error is None
            assert "--scenes" in row.why
        elif "fractions" in row.arithmetic:
            assert row.error == 0
        elif "digits" in row.arithmetic and row.error is not None:
            assert row.error < 10.0 ** -int(row.arithmetic.split()[0])
        else:
            assert row.error is not None
            assert 0 < row.error < 1e-14
    assert next(row.time for row in rows if row.arithmetic == LAPACK) == 1


def test_a_root_leaves_fractions_without_a_number() -> None:
    """Where an actuator goes along a direction of irrational length, fractions have a reason and floats a number."""
    pytest.importorskip("flint")
    rows = {(row.plan, row.arithmetic): row for row in measures(load("ozols-5-3"), compiled=0)}
    exact, floats = (rows["polar", name] for name in ("fractions", "one pose"))
    assert exact.error is None
    assert "irrational" in exact.why or "not-rational" in exact.why
    assert floats.error is not None
    assert floats.error < 1e-13


@pytest.mark.costly
def test_forces_are_measured_against_the_truth() -> None:
    """A scene with loads is measured twice, and its reactions and balances come out right in every arithmetic."""
    rows = list(measures(load("jaanimets-11"), compiled=0))
    assert {row.asked for row in rows} == {MOTION, FORCES}
    assert {row.arithmetic for row in rows if row.asked == FORCES} == {*SOLVERS, *ARITHMETICS}
    measured = [row for row in rows if row.error is not None]
    assert all(row.error == 0 for row in measured if "fractions" in row.arithmetic)
    assert all(row.error < 1e-13 for row in measured)
    assert all(row.why or row.error is not None for row in rows)


def test_a_wheel_on_a_rail_keeps_its_radius_in_all_poses() -> None:
    """In fractions its construction has no error: no pose asks for a wheel of another radius."""
    problem = Problem(load("wheel-on-rail"))
    run = ARITHMETICS[FRACTIONS](problem, construct(problem.scene))
    assert problem.error(run, run.call()) == 0


def test_the_truth_is_that_of_the_floats() -> None:
    """A scene placed by compasses becomes one of binary fractions, whose exact rates are those of the solver's floats.
    """
    scene = load("ozols-5-1")
    exact, floats = truth(binary(scene)).rates, solve(scene)
    for name, pair in exact.velocity.items():
        assert all(isinstance(number, Fraction) for number in pair)
        assert complex(*map(float, pair)) == pytest.approx(complex(*floats.velocity[name]), rel=1e-12, abs=1e-9)


def test_the_front_holds_what_nothing_beats() -> None:
    """Of places in operations and error those stay that no other beats in both, equal ones once."""
    places = [(10, 3.0), (10, 2.0), (12, 2.0), (15, 1.0), (15, 1.0), (20, 1.5), (30, 0.5)]
    assert front(places) == [(10, 2.0), (15, 1.0), (30, 0.5)]
    assert stairs(front(places), (30, 3.0)) == [(10, 3.0), (10, 2.0), (15, 2.0), (15, 1.0), (30, 1.0), (30, 0.5)]
    assert stairs([], (1, 1)) == []


@pytest.mark.costly
def test_forms_of_a_four_bar(four_bar: Scene) -> None:
    """Both plans by both sets of tools; the front holds the fewest operations and the smallest error."""
    rows = drafts(four_bar, Pencil())
    assert len({(row.plan, row.tools) for row in rows}) == 4
    assert all(row.operations and row.error for row in rows)
    best = [row for row in rows if row.front]
    assert min(row.operations or 0 for row in rows) in {row.operations for row in best}
    assert min(row.error or 0.0 for row in rows) in {row.error for row in best}


@pytest.mark.costly
def test_the_gallery_has_what_the_command_gives() -> None:
    """The rows of a scene in the gallery's table are those that are measured today, to the last digits."""
    shown = Path(__file__).parents[2] / "gallery" / "charts" / "draughtsman.csv"
    with shown.open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["scene"] == "slider-crank"]
    found = drafts(load("slider-crank"), Pencil())
    assert [(row["plan"], row["tools"], row["operations"]) for row in rows] == [
        (row.plan, row.tools, str(row.operations)) for row in found]
    assert [float(row["error"]) for row in rows] == pytest.approx([row.error for row in found], rel=1e-9)


def test_the_gallery_has_rows_of_each_scene() -> None:
    """Each packaged scene has rows in the tables of charts that are of all scenes, and nothing else has."""
    for name in ("draughtsman.csv", "machine.csv"):
        with (Path(__file__).parents[2] / "gallery" / "charts" / name).open(encoding="utf-8") as file:
            assert {row["scene"] for row in csv.DictReader(file) if not row.get("program")} == {*packaged_names()}, name


@pytest.mark.costly
def test_forms_that_are_not_drawn_have_a_reason() -> None:
    """Strict forms with loads, left out for their time, are rows that say so."""
    rows = drafts(load("jaanimets-11"), Pencil(), long=False)
    assert [row.why for row in rows if row.operations is None] == [LONG_REASON] * 2


@pytest.mark.costly
def test_steps_grow_by_equal_increments() -> None:
    """Every dyad of a chain adds as many steps as the one before."""
    rows = list(stages((4, 6, 8, 10), rounds=1))
    assert [row.stage for row in rows] == [*STAGES] * 4
    assert all(row.time for row in rows)
    steps = [row.steps for row in rows if row.stage == STAGES[0]]
    assert len(set(np.diff(steps))) == 1
    assert steps[1] > steps[0]


def test_a_stage_that_takes_long_is_not_tried_on_longer_chains(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a stage is too long or refused, it has a reason there and on every longer chain, and no time."""
    monkeypatch.setattr(growth, "MAX_SECONDS", 0.0)
    rows = list(stages((4, 6), rounds=1))
    assert {(row.links, row.stage) for row in rows} == {(links, stage) for links in (4, 6) for stage in STAGES}
    assert all(row.time is None and row.why == "longer than 0 s" for row in rows)


def test_velocities_neither_die_away_nor_grow_along_a_chain() -> None:
    """Every joint of a long chain goes as fast as the crank's; a chain has twice as many links as dyads, and two."""
    scene = chain(20)
    assert len(scene.links) == 42
    assert {x * x + y * y for x, y in (solve(scene, exact=True).velocity[f"P{k}"] for k in range(21))} == {26}


def test_chains_travel() -> None:
    """A long chain reaches every position that the chart follows it to."""
    assert not follow(chain(30), POSITIONS, TRAVEL).faults


def test_a_table_has_a_line_for_each_row() -> None:
    """A heading of the fields, then the rows; what there is not is empty, and numbers come back as they were."""
    row = MachineMeasure("four-bar", MOTION, "trial, poles", "polar", "floats", 0.1, None, 1 / 3, 0.0, "a, b")
    lines = list(csv.DictReader(io.StringIO(table(MachineMeasure, [row, replace(row, time=None)]))))
    assert [line["time"] for line in lines] == ["0.1", ""]
    assert float(lines[0]["high"]) == 1 / 3
    assert (lines[0]["form"], lines[0]["why"]) == ("trial, poles", "a, b")
    assert read(MachineMeasure, table(MachineMeasure, [row])) == [row]
    assert len(list(csv.reader(io.StringIO(table(Draft, []))))) == 1


@pytest.mark.costly
def test_finer_settings_take_more_and_err_less(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of each choice the next value takes more and errs less; strips of a load that hangs on no speed by a quarter.

    Times are left to the chart: each run takes as much as those before it and one more.
    """
    monkeypatch.setattr(settings, "ratios", lambda runs, unit: {name: (k, k, k) for k, name in enumerate(runs, 1)})
    lines: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for row in settings.settings(Pencil()):
        if row.choice != ANSWER and row.case != "by pencil":
            assert row.error is not None
            lines.setdefault((row.choice, row.case), []).append((row.takes, row.error))
    for line in lines.values():
        takes, errors = zip(*line, strict=True)
        assert sorted({*takes}) == [*takes]
        assert sorted({*errors}, reverse=True) == [*errors]
    yoke = [error for _, error in lines[STRIPS, "ozols-13-6"]]
    assert [round(coarse / fine) for coarse, fine in pairwise(yoke)] == [4] * (len(yoke) - 1)
    assert {case: len(line) for (choice, case), line in lines.items() if choice == settings.POSITIONS} == dict.fromkeys(
        settings.FLYWHEELS, len(settings.POSITION_COUNTS))
    assert all(errors[1][1] < 1e-3 * errors[0][1] for case, errors in lines.items() if case[0] == ROUNDS)
