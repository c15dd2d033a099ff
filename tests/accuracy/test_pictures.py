"""The charts and their command: a row of the table for every mark, text that stays the same, files whole or untouched.
"""

from __future__ import annotations

from itertools import product
from pathlib import Path
from xml.etree import ElementTree

import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text

from graphplan.bench import draughtsman, growth, machine, methods, stability
from graphplan.bench.draughtsman import SQUARES, STRICT, Draft
from graphplan.bench.problem import DEGENERACIES
from graphplan.commands import main
from graphplan.design.hand import Pencil
from graphplan.output.diagrams import FORMATS, file_of

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


def marks(figure: Figure) -> int:
    """The number of marks that stand on a figure."""
    return sum(len(line.get_xdata()) for axes in figure.axes for line in axes.lines if line.get_marker() != "None")


def curves(axes: Axes) -> dict[str, list[tuple[float, float]]]:
    """The curves of an axes that have names, with their spots."""
    return {line.get_gid(): [*map(tuple, line.get_xydata().tolist())] for line in axes.lines if line.get_gid()}


def words(figure: Figure) -> str:
    """All words of a figure, on one line."""
    root = ElementTree.fromstring(file_of(figure))
    return " ".join("".join(text.itertext()) for text in root.iter("{http://www.w3.org/2000/svg}text"))


def test_every_mark_is_a_row_of_its_table() -> None:
    """Each row with numbers is one mark, those without none; of the front there is a line and no mark."""
    figure = draughtsman.details(DRAFTS, str(Pencil()))
    assert marks(figure) == 3
    assert [*map(tuple, figure.axes[0].lines[0].get_xydata().tolist())] == [
        (40.0, 3.0), (40.0, 2.0), (90.0, 2.0), (90.0, 1.0), (95.0, 1.0)]
    assert "(1 not drawn)" in words(figure)
    assert marks(machine.details(MEASURES)) == 3


def test_the_atlas_marks_what_is_drawn_and_what_is_not() -> None:
    """Each way has a mark at each distance, above the numbers where it is not drawn; below stands what serves, and over
    it what fails and why."""
    sweep = next(one for one in DEGENERACIES if one.name == "slide locks")
    rows = list(stability.samples(sweep, distances=(1.0, 1e-5, 0.0)))
    figure = stability.picture(rows)
    drawn = [row for row in rows if row.how == stability.DRAWN and row.way in sweep.compared_ways]
    lines = curves(figure.axes[0])
    for way in sweep.compared_ways:
        of = [row for row in drawn if row.way == way]
        found = [error for _, error in lines[f"{way}, {stability.DRAWN}"]]
        assert found == [max(row.error, stability.MIN_ERROR) for row in of if row.distance]
        assert len(lines[f"{way}, not drawn"]) == sum(row.error is None for row in of) == 1
    strip = [patch for patch in figure.axes[0].patches if patch.get_gid().startswith(stability.SOLVE)]
    assert [patch.get_gid().partition(": ")[2] for patch in strip][::2] == ["floats", "no"]
    assert strip[0].get_xy()[1][0] == strip[1].get_xy()[0][0]
    assert "become parallel" in words(figure)


def test_every_special_pose_says_what_fails() -> None:
    """One or two sentences stand over each panel of the atlas and of the methods."""
    assert all(one.failure.endswith(".") and len(one.failure) < 200 for one in DEGENERACIES)


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
    """Bars far from parallel take the auxiliary point; nearer ones two trial figures, however near, as the sheet of the
    pose has them."""
    bars = next(one for one in DEGENERACIES if one.name == "parallel bars")
    rows = list(methods.forms_at(bars, pencil=Pencil(), distances=(1.0, 1e-4)))
    best = [methods.best_form([row for row in rows if (row.distance, row.sheet) == (distance, "A1")])
            for distance in (1.0, 1e-4)]
    assert [form and form.drawn.partition(",")[0] for form in best] == ["auxiliary points", "two trial figures"]
    figure = methods.picture(rows, Pencil().description)
    bars_drawn = [patch.get_gid() for patch in figure.axes[0].patches]
    assert {name.partition(": ")[0] for name in bars_drawn} == {*methods.ROWS}
    assert f"{methods.OWN_ROW}: two trial figures, orthogonal" in bars_drawn


def test_exact_errors_stand_on_rails() -> None:
    """No error stands on the exact rail, proven digits on theirs, both below all floats."""
    by_name = curves(machine.picture(MEASURES).axes[0])
    assert by_name["fractions"] == [(200.0, machine.LEVELS["fractions"])]
    assert by_name["20 proven digits"][0][1] == machine.LEVELS["20 proven digits"] < machine.FLOATS_END
    assert by_name["one pose"] == [(10.0, 1e-15)]


def test_medians_are_over_all_scenes() -> None:
    """The chart of the machine has the median of each arithmetic, and the front of the medians."""
    rows = [measure("one pose", time, 1e-15, scene) for scene, time in (("a", 1.0), ("b", 3.0), ("c", 5.0))]
    by_name = curves(machine.picture([measure("fractions", 9.0, 0.0), *rows]).axes[0])
    exact = machine.LEVELS["fractions"]
    assert by_name["one pose"] == [(3.0, 1e-15)]
    assert by_name["front"] == [(3.0, 1e-15), (9.0, 1e-15), (9.0, exact)]


def test_other_programs_are_named_where_there_are_any() -> None:
    """The charts of the machine say which programs are compared, and nothing of them where none is."""
    compared = [*MEASURES, measure("CasADi, C", 2.0, 1e-13), measure("JAX", None, None)]
    for chart in machine.picture, machine.details:
        assert "CasADi, C" in words(chart(compared))
        assert "programs" not in words(chart(MEASURES))


def test_only_scenes_that_have_a_choice_are_drawn() -> None:
    """A method counts where it is another drawing than the pose's own, relative to which it is; a scene in which all
    methods are one drawing answers no question of methods, and has plans and tools all the same."""
    trial = Draft("triad", "trial", "orthogonal", SQUARES, "A1", 50, 0.03)
    alike = [Draft("five-bar", "every method", plan, tools, "A1", 20, 0.01 * scale)
             for scale, (plan, tools) in enumerate(product(("orthogonal", "polar"), (SQUARES, STRICT)), 1)]
    method, plan, tools = (curves(axes) for axes in draughtsman.picture(
        [*DRAFTS, trial, *alike], str(Pencil())).axes)
    assert {name: spots for name, spots in method.items() if name.startswith("scenes")} == {
        "scenes: trial": [(1.25, pytest.approx(1.5))]}
    assert plan["polar plans"] == [(1.0, pytest.approx(3.0))]
    assert tools["strict, orthogonal plans"] == [(1.0, pytest.approx(2.0))]
    assert "scenes: auxiliary" not in method


def test_the_exponent_is_that_of_long_chains() -> None:
    """A time that is the square of the number of links is told as such, whatever short chains take."""
    rows = [growth.StageTime(n, 6 * n - 10, stage, float(n * n) if n > 10 else 1e9, 1.0, 1.0)
            for n in (4, 100, 500, 1000) for stage in growth.STAGES]
    rows.append(growth.StageTime(2000, 11990, growth.DRAW, None, why="sheet: words do not fit; a larger one"))
    assert growth.exponent(rows, growth.SOLVE) == pytest.approx(2)
    figure = growth.picture(rows)
    text = words(figure)
    assert f"{growth.DRAW}: n^2.00 (words do not fit)" in text
    assert "6 n − 10 steps" in text
    assert curves(figure.axes[0])[growth.SOLVE][1:] == [(n, float(n * n)) for n in (100, 500, 1000)]


def test_growth_says_how_many_designs_are_weighed() -> None:
    """Where the number of designs changes stands a line, and on each side of it how many are weighed."""
    rows = [growth.StageTime(n, 6 * n, growth.CONSTRUCT, float(n), weighed=count)
            for n, count in ((4, 1), (10, 1), (20, 3), (100, 0))]
    figure = growth.picture(rows)
    assert [word for word in ("1 design", "3 designs", "none weighed") if word not in words(figure)] == []
    edges = [line.get_xdata()[0] for line in figure.axes[0].lines if len({*line.get_xdata()}) == 1]
    assert edges == [pytest.approx(200**0.5), pytest.approx(2000**0.5)]


def test_the_same_picture_is_the_same_bytes() -> None:
    """Pictures are valid SVG without a date, drawn twice alike, in each kind of file."""
    for ending in FORMATS:
        one, two = (file_of(draughtsman.picture(DRAFTS, str(Pencil())), ending) for _ in range(2))
        assert one == two
    text = file_of(draughtsman.picture(DRAFTS, str(Pencil()))).decode()
    assert "dc:date" not in text
    assert ElementTree.fromstring(text).tag.endswith("svg")


def test_words_on_charts_are_large_enough_to_read() -> None:
    """Capitals are 2.5 mm high or more, but those of powers."""
    figure = machine.picture(MEASURES)
    sizes = [text.get_fontsize() for text in figure.findobj(Text) if text.get_text()]
    assert min(sizes) * 0.729 * 25.4 / 72 == pytest.approx(2.5)


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
