"""Handouts of tasks of synthesis: task, guided version and solution on one paper, at one scale."""

from __future__ import annotations

from pathlib import Path

import pytest

import graphplan as gp
from graphplan.commands import main
from graphplan.output.subjects.synthesis_handout import SynthesisHandout
from graphplan.sheet.frames.frame import MARKS
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import Circle, Sheet, Text


def handout(name: str, **options: str) -> SynthesisHandout:
    return gp.synthesize(name, **options).drawn


def dots(sheet: Sheet) -> set[tuple[float, float]]:
    """Where the marks of points lie."""
    return {item.centre for item in sheet.items if isinstance(item, Circle)}


@pytest.mark.parametrize("name", ["guidance-fixed", "stroke-crank-rocker", "gear-21-1"])
def test_a_drawing_can_be_laid_over_the_solution(name: str) -> None:
    """Task and guided version have the paper, the panel and the given marks of the solution, and coded corners."""
    parts = handout(name)
    solution = parts.pages_of("solution")[0]
    for part in ("task", "guided"):
        page = parts.pages_of(part)[0]
        assert (page.width, page.height, page.panels) == (solution.width, solution.height, solution.panels)
        assert dots(page) <= dots(solution)
        assert any(item.layer == MARKS for item in page.items)
    assert not any(item.layer == MARKS for item in solution.items)


def test_the_guided_version_has_a_box_for_each_step_that_it_tells() -> None:
    """All steps are told, none is drawn, and no result is on the page."""
    parts = handout("guidance-moving")
    guided, task = ("\n".join(str(item) for sheet in parts.pages_of(part) for item in sheet.items)
                    for part in ("guided", "task"))
    assert "the perpendicular bisector of" in guided
    assert "the perpendicular bisector of" not in task
    length = f"{parts.synthesis.linkage.lengths['O A']:.4g}"
    assert length not in guided
    assert any(length in str(item) for sheet in parts.solution for item in sheet.items)


@pytest.mark.parametrize("arguments", [[], ["--only", "guided", "--language", "lv"], ["--paper", "A2"]])
def test_the_command_writes_what_python_writes(arguments: list[str], tmp_path: Path) -> None:
    """`graphplan handout TASK` and `gp.handout` of what is found write the same file, byte for byte."""
    by_command, by_python, by_method = (tmp_path / f"{way}.pdf" for way in ("command", "python", "method"))
    assert main(["handout", "function-slide", "-q", *arguments, "-o", str(by_command)]) == 0
    options = {key.removeprefix("--"): value for key, value in zip(arguments[::2], arguments[1::2], strict=True)}
    gp.handout(gp.synthesize("function-slide"), by_python, **options)
    gp.synthesize("function-slide").handout(by_method, **options)
    assert by_command.read_bytes() == by_python.read_bytes() == by_method.read_bytes()


@pytest.mark.parametrize(("option", "value"), [("--at", "20"), ("--plan", "polar")])
def test_what_a_task_does_not_have_is_refused(option: str, value: str, tmp_path: Path,
                                              capsys: pytest.CaptureFixture[str]) -> None:
    """Options of a scene's pose and plans do not apply to a task: one line, and nothing is written."""
    path = tmp_path / "task.pdf"
    assert main(["handout", "gear-21-1", option, value, "-o", str(path)]) == 2
    assert capsys.readouterr().err.splitlines() == [
        f"{option}: it does not apply to a task of graphplan synthesize; leave it out"]
    assert not path.exists()


def test_a_length_has_its_letters_and_a_unit(tmp_path: Path) -> None:
    """An offset that is found is e, on the solution with its unit, and at the box of the task."""
    task = tmp_path / "task.toml"
    task.write_text("[units]\nlength = 'in'\n[stroke]\nratio = 1.2\nstroke = 4\ncrank = 1.9125\n")
    solution, boxes = ("\n".join(plain(item.runs) for item in page.items if isinstance(item, Text)) for page in (
        handout(str(task)).pages_of(part)[0] for part in ("solution", "task")))
    assert "e = 1.19053 in" in solution
    assert "\ne\n" in boxes
