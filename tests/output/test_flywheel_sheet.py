"""The sheet of a flywheel: its panels, its steps, what stands in its words, and letters apart from each other."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import pytest

from graphplan.commands import main
from graphplan.machine.flywheel.drawing import FLYWHEEL
from graphplan.machine.flywheel.energy_constructions import AREAS, GUTJAHR
from graphplan.machine.flywheel.result import FlywheelResult, flywheel
from graphplan.mechanism.scene import load, parse, source_text
from graphplan.output import panelled
from graphplan.output.subjects.flywheel_sheet import FlywheelSheet
from graphplan.output.subjects.lever_figures import LEVERS
from graphplan.output.svg import svg
from graphplan.phrases import digits
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import EDGE_SLACK_MM, Item, Polyline, Sheet, Text


@pytest.fixture(scope="module")
def result() -> FlywheelResult:
    """The scotch yoke's flywheel."""
    return flywheel(load("ozols-13-6"))


def sheets(result: FlywheelResult, paper: str = "", task: bool = False) -> list[Sheet]:
    """The sheet on a paper, or on the smallest on which its words have room."""
    return panelled.pages(lambda name: FlywheelSheet(name, result, task), paper, ("A2", "A1"))


@pytest.fixture(scope="module")
def pages(result: FlywheelResult) -> list[Sheet]:
    """Its sheet."""
    return sheets(result)


def inside(sheet: Sheet, item: Item) -> bool:
    """Whether a stroke or letters lie in one panel."""
    spots = item.box.corners if isinstance(item, Text) else item.spots if isinstance(item, Polyline) else ()
    return any(all(rect.holds(spot, EDGE_SLACK_MM) for spot in spots) for rect in sheet.panels.values())


def test_panels_hold_what_is_drawn(pages: list[Sheet]) -> None:
    """Mechanism, lever, the other levers and the diagrams have a panel each, and no ink or letter leaves it."""
    first = pages[0]
    assert list(first.panels) == ["mechanism", "lever", LEVERS, FLYWHEEL]
    drawn = [item for item in first.items if item.layer in ("plates", "links", "letters", "ruling")]
    assert [item for item in drawn if not inside(first, item)] == []


def test_only_the_paper_that_is_taken_is_drawn_on(result: FlywheelResult) -> None:
    """The larger papers that a sheet may be on are not drawn on where the smallest has room."""
    tried = {name: FlywheelSheet(name, result) for name in ("A2", "A1")}
    panelled.pages(tried.__getitem__, None, [*tried])
    assert [name for name, sheet in tried.items() if "drawing" in vars(sheet)] == ["A2"]


@pytest.mark.parametrize("paper", ["A3", "A2", "A1"])
def test_no_letters_meet(result: FlywheelResult, paper: str) -> None:
    """No two words or letters stand on each other, on any paper."""
    first, *_ = sheets(result, paper)
    texts = [item for item in first.items if isinstance(item, Text)]
    boxes = [(item, item.box.inset(0.05, 0.05, 0.05, 0.05)) for item in texts]
    assert [(plain(a.runs), plain(b.runs)) for (a, one), (b, two) in combinations(boxes, 2)
            if one.meets(two) and a.at != b.at] == []


def test_every_step_is_drawn_and_told(result: FlywheelResult, pages: list[Sheet]) -> None:
    """The steps of the lever and of the diagrams are numbered one after the other; each has its ink and its sentence,
    lengths of the diagrams being mm of paper."""
    sheet = FlywheelSheet("A2", result)
    lever, diagrams = sheet.levers.drawing.drawn, sheet.drawing.values.drawing.program
    steps = len(lever) - lever.givens + len(diagrams) - diagrams.givens
    assert len(pages[0].sentences) - pages[0].givens == steps
    text = svg(pages[0])
    drawn = sum(f'data-step="{k}"' in text for k in range(1, steps + 1))
    assert drawn > 0.97 * steps  # what is laid off on what is drawn already has no ink of its own
    words = " ".join(plain(item.runs) for page in pages for item in page.items if isinstance(item, Text))
    mean = sheet.drawing.values.values_of_role("mean")[0][1]
    assert f"{abs(mean):.1f} mm" in words


def test_words_have_the_numbers(result: FlywheelResult, pages: list[Sheet]) -> None:
    """The closing moment, the flywheel by each method, and a row for each plan stand on the sheet."""
    lines = [plain(item.runs) for item in pages[0].items if isinstance(item, Text)]
    words = " ".join(lines)
    assert f"Closing moment: {digits(result.cycle.closing)} N m" in words
    assert all(digits(value) in words for value in (result.wheel.inertia, *(one.inertia for one in result.methods)))
    assert all(str(k) in lines for k in range(result.positions + 1))


def test_curves_are_numbered_as_the_table() -> None:
    """Where a load has corners between plans, the numbers at the curve are still those of the table's rows."""
    load_over = '[[moments]]\non = "1"\nover = "travel"\nvalues = [[0, 50], [40, 50], [40, -50], [360, 50]]\n'
    found = flywheel(parse(source_text("ozols-13-6", "") + load_over, "yoke"), 12)
    assert len(found.drawing.travels) > 13
    labels = [item.label for item in sheets(found)[0].items if isinstance(item, Text)]
    assert sorted(label for label in labels if label.startswith("P ")) == sorted(f"P {k}" for k in range(12))


def test_formats(tmp_path: Path) -> None:
    """The command writes the sheet as TikZ and a table as CSV; words that stand apart are files of their own."""
    assert main(["flywheel", "ozols-13-6", "-q", "-o", str(tmp_path / "sheet.tex")]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["sheet-protocol.tex", "sheet.tex"]
    assert r"\begin{tikzpicture}" in (tmp_path / "sheet.tex").read_text()


def test_tasks_have_what_is_given_alone(result: FlywheelResult, pages: list[Sheet]) -> None:
    """A task has the panels and axes of the solution, boxes for its numbers, and no vector, curve or step."""
    task, = sheets(result, task=True)
    assert task.panels == pages[0].panels
    words = [plain(item.runs) for item in task.items if isinstance(item, Text)]
    assert digits(result.wheel.inertia) not in " ".join(words)
    assert sum(item.layer == "blanks" for item in task.items) >= 4 * (result.positions + 1)
    scales = [word for word in words if "k" in word and "/mm" in word]
    assert scales == [word for page in pages for item in page.items if isinstance(item, Text)
                      for word in (plain(item.runs),) if word in scales]
    assert not any(isinstance(item, Polyline) and item.layer == "links" and len(item.spots) > 20 for item in task.items)


@pytest.mark.parametrize("by", [GUTJAHR, AREAS])
@pytest.mark.parametrize("paper", ["", "A3", "A1"])
def test_other_constructions_have_their_diagrams(result: FlywheelResult, by: str, paper: str) -> None:
    """Their panels hold all ink and letters, and no two words stand on each other."""
    first, *_ = panelled.pages(lambda name: FlywheelSheet(name, result, by=by), paper, ("A2", "A1"))
    drawn = [item for item in first.items if item.layer in ("plates", "links", "letters", "ruling")]
    assert [item for item in drawn if not inside(first, item)] == []
    texts = [item for item in first.items if isinstance(item, Text)]
    boxes = [(item, item.box.inset(0.05, 0.05, 0.05, 0.05)) for item in texts]
    assert [(plain(a.runs), plain(b.runs)) for (a, one), (b, two) in combinations(boxes, 2)
            if one.meets(two) and a.at != b.at] == []


def test_the_command_draws_by_the_construction_that_is_asked_for(tmp_path: Path) -> None:
    """An unknown one is refused; of the others each sheet says which it is."""
    for by, words in (("gutjahr", "Gutjahr's curves"), ("areas", "vectors of areas")):
        assert main(["flywheel", "ozols-13-6", "--by", by, "-o", str(tmp_path / "sheet.svg")]) == 0
        assert words in (tmp_path / "sheet.svg").read_text(encoding="utf-8")
    with pytest.raises(SystemExit, match="2"):
        main(["flywheel", "ozols-13-6", "--by", "guess", "-o", str(tmp_path / "no.svg")])
