"""The charts and their command: a row of the table for every mark, text that stays the same, files whole or untouched.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest

from graphplan.bench import draughtsman, growth, machine, methods, stability
from graphplan.bench.charts import draw_chart
from graphplan.bench.draughtsman import SQUARES, STRICT, Draft
from graphplan.bench.picture import Axis, Chart, ChartSeries, SubChart
from graphplan.bench.problem import DEGENERACIES
from graphplan.commands import main
from graphplan.design.hand import Pencil
from graphplan.mechanism.sections import MOTION_PLANS

SVG = "{http://www.w3.org/2000/svg}"
DRAFTS = [
    Draft("triad", "pose's own, auxiliary", "orthogonal", SQUARES, "A1", 40, 0.02, front=True),
    Draft("triad", "trial", "polar", STRICT, "A1", 90, 0.01, front=True),
    Draft("triad", "poles", "polar", STRICT, "A1", 95, 0.03),
    Draft("triad", "poles", "polar", SQUARES, "A1", None, None, why="refused"),
]


def measure(arithmetic: str, time: float | None, error: float | None, scene: str = "shaper") -> machine.MachineMeasure:
    """A made-up measure of a scene."""
    why = "refused" if time is None else ""
    return machine.MachineMeasure(scene, machine.MOTION, "every method", "orthogonal", arithmetic, *[time] * 3, error,
                                  why)


MEASURES = [measure("one pose", 10.0, 1e-15), measure("fractions", 200.0, 0.0),
            measure("20 proven digits", 90.0, 1e-50), measure(machine.COMPILED, None, None)]


def marks(chart: Chart) -> int:
    """How many marks stand on a chart."""
    return sum(len(series.spots) for panel in chart.panels for series in panel.series if series.look.marker)


def test_every_mark_is_a_row_of_its_table() -> None:
    """Each row with numbers is one mark, those without none; of the front there is a line and no mark."""
    chart = draughtsman.details(DRAFTS, str(Pencil()))
    assert marks(chart) == 3
    assert chart.panels[0].series[0].spots == (
        (40.0, 3.0), (40.0, 2.0), (90.0, 2.0), (90.0, 1.0), (95.0, 1.0))
    assert "(1 not drawn)" in chart.panels[0].title
    assert marks(machine.details(MEASURES)) == 3


def test_the_atlas_marks_what_is_drawn_and_what_is_not() -> None:
    """Each way has a mark at each distance, above the numbers where it is not drawn; below stands what serves."""
    rows = list(stability.samples(next(one for one in DEGENERACIES if one.name == "slide locks"),
                                  distances=(1.0, 1e-5, 0.0)))
    chart = stability.picture(rows)
    drawn_or_not = [row for row in rows if row.how == stability.DRAWN and row.way != stability.SHEET]
    computed = [row for row in rows if row.way in (stability.VALUE, stability.SOLVER) and row.error is not None]
    assert marks(chart) == len(drawn_or_not) + len(computed)
    strip = [one for one in chart.panels[0].series if one.look.area and one.spots[0][1] == stability.SOLVE]
    assert [series.label for series in strip][::2] == ["floats", "no"]
    assert all(one.spots[1][0] == two.spots[0][0] for one, two in pairwise(strip[:2]))


def form_at(form: str, operations: float, error: float | None, sheet: str = "A3") -> methods.FormAt:
    """A made-up form at a distance from a special pose."""
    return methods.FormAt("parallel bars", 1.0, form, sheet, operations, error)


def test_the_quickest_form_that_is_accurate_enough_is_chosen() -> None:
    """Else the most accurate one, and none where none can be drawn."""
    quick, slow, wild = form_at("a", 10, 0.09), form_at("b", 20, 0.01), form_at("c", 5, 0.2)
    assert methods.best_form([slow, quick, wild]) is quick
    assert methods.best_form([wild, form_at("d", 1, 0.4)]) is wild
    assert methods.best_form([form_at("d", 1, None)]) is None


def test_which_method_when_names_the_form_that_serves() -> None:
    """Bars far from parallel take the auxiliary point, near it the trial figure on large paper; the nearest none."""
    bars = next(one for one in DEGENERACIES if one.name == "parallel bars")
    rows = list(methods.forms_at(bars, pencil=Pencil(), distances=(1.0, 0.05, 1e-4)))
    best = {distance: methods.best_form([row for row in rows if (row.distance, row.sheet) == (distance, "A1")])
            for distance in (1.0, 0.05, 1e-4)}
    assert [of and of.form.split(",")[0] for of in best.values()] == ["auxiliary points", "trial figures", None]
    stretches = methods.picture(rows, Pencil().description).panels[0].series
    assert {series.spots[0][1] for series in stretches} == {*methods.SHEETS}


def test_exact_errors_stand_on_rails() -> None:
    """No error stands on the exact rail, proven digits on theirs."""
    levels = [series.spots[0][1] for series in machine.details(MEASURES).panels[0].series]
    assert levels == [1e-15, "fractions", "20 proven digits"]


def test_medians_are_over_all_scenes() -> None:
    """The chart of the machine has the median and quartiles of each arithmetic, and the front of the medians."""
    rows = [measure("one pose", time, 1e-15, scene) for scene, time in (("a", 1.0), ("b", 3.0), ("c", 5.0))]
    line, exact, series = machine.picture([measure("fractions", 9.0, 0.0), *rows]).panels[0].series
    assert (series.spots, series.label, exact.label) == (((3.0, 1e-15),), "one pose", "")
    assert series.spreads == (((2.0, 1e-15), (4.0, 1e-15)),)
    assert exact.spots == ((9.0, "fractions"),)
    assert line.spots == ((3.0, 1e-15), (9.0, 1e-15), (9.0, "fractions"))


def test_other_programs_are_named_where_there_are_any() -> None:
    """The key of the machine says which programs are compared, and nothing of them where none is."""
    compared = [*MEASURES, measure("CasADi, C", 2.0, 1e-13), measure("JAX", None, None)]
    for chart in machine.picture, machine.details:
        assert [words for words, _ in chart(compared).key if "programs (CasADi, C)" in words]
        assert "programs" not in " ".join(words for words, _ in chart(MEASURES).key)


def test_the_reference_has_a_reading() -> None:
    """What all numbers of an axis are relative to is read on it, wherever the round numbers lie, and by none of them
    that is near."""
    def readings(axis: Axis) -> list[str]:
        panel = SubChart("", axis, Axis("y"), (ChartSeries(draughtsman.FRONT, ((0.1, 30.0), (9.3, 50.0))),))
        root = ElementTree.fromstring(draw_chart(Chart("", "", (panel,), 1, (90.0, 40.0), ())))
        return ["".join(text.itertext()) for text in root.iter(f"{SVG}text")]

    plain = Axis("x", log=False)
    assert "1" not in readings(plain)
    assert "1" in readings(replace(plain, reference=1.0))
    assert {"7.9", "8"} & {*readings(replace(plain, reference=7.9))} == {"7.9"}


def test_ways_to_draw_are_beside_the_own_form() -> None:
    """The draughtsman's medians are parts of the operations and of the error of the pose's own form in each scene."""
    rows = [replace(draft, scene=scene) for draft in DRAFTS for scene in ("triad", "stephenson")]
    _, *series = draughtsman.picture(rows, str(Pencil())).panels[0].series
    assert {one.label: one.spots[0] for one in series} == {
        "pose's own, auxiliary: orthogonal": (1.0, 1.0), "trial: polar, strict": (2.25, 0.5),
        "poles: polar, strict": (2.375, 1.5)}


def test_the_front_is_that_of_ways_that_all_scenes_have() -> None:
    """A way that few scenes have, as velocity triangles, says how many, and is on no front, good as it may be."""
    own = [replace(DRAFTS[0], scene=scene) for scene in ("triad", "planetary")]
    triangles = replace(DRAFTS[0], scene="planetary", form="every method", plan=MOTION_PLANS[2], operations=30)
    line, *series = draughtsman.picture([*own, triangles], str(Pencil())).panels[0].series
    assert {one.label: one.spots for one in series} == {
        "pose's own, auxiliary: orthogonal": ((1.0, 1.0),), "pose's own: triangles (1)": ((0.75, 1.0),)}
    assert (0.75, 1.0) not in line.spots
    assert {draughtsman.form_look("trial", plan, SQUARES).colour for plan in MOTION_PLANS} == {
        look.colour for words, look in draughtsman.details(own, "").key if look.area}


def test_the_exponent_is_that_of_long_chains() -> None:
    """A time that is the square of the number of links is told as such, whatever short chains take."""
    rows = [growth.StageTime(n, 6 * n - 10, stage, float(n * n) if n > 10 else 1e9, 1.0, 1.0)
            for n in (4, 100, 500, 1000) for stage in growth.STAGES]
    rows.append(growth.StageTime(2000, 11990, growth.DRAW, None, why="sheet: words do not fit; a larger one"))
    assert growth.exponent(rows, growth.SOLVE) == pytest.approx(2)
    chart = growth.picture(rows)
    labels = [series.label for series in chart.panels[0].series]
    assert f"{growth.SOLVE}: n^2.00" in labels
    assert f"{growth.DRAW}: n^2.00 (words do not fit)" in labels
    assert "6 n − 10 steps" in chart.remarks


def test_the_same_picture_is_the_same_text() -> None:
    """Pictures are valid SVG without a date, drawn twice alike."""
    chart = draughtsman.picture(DRAFTS, str(Pencil()))
    text = draw_chart(chart)
    assert text == draw_chart(chart)
    assert "dc:date" not in text
    assert ElementTree.fromstring(text).tag.endswith("svg")


@pytest.mark.costly
def test_chart_writes_picture_and_table(tmp_path: Path) -> None:
    """The named chart of the named scene comes as two files that replace what was there."""
    (tmp_path / "draughtsman.csv").write_text("old")
    assert main(["chart", "draughtsman", str(tmp_path), "--scenes", "five-bar"]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "draughtsman-scenes.svg", "draughtsman.csv", "draughtsman.svg"]
    heading, *rows = (tmp_path / "draughtsman.csv").read_text().splitlines()
    assert heading.startswith("scene,form,plan,tools")
    assert all(row.startswith("five-bar,") for row in rows)
