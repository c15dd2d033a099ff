"""Handouts at the command line: the parts of a PDF, the page for a browser, and what is refused."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from graphplan.commands import main

A3 = (420 / 25.4 * 72, 297 / 25.4 * 72)  # points


def pages(path: Path) -> list[tuple[float, float]]:
    """Width and height of every page of a PDF, in points."""
    boxes = re.findall(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+) ?\]", path.read_bytes())
    return [(float(wide), float(high)) for wide, high in boxes]


@pytest.mark.costly
def test_a_pdf_has_task_guide_and_solution_in_true_size(tmp_path: Path) -> None:
    """Pages of one size for a slider-crank, the same bytes every time."""
    one, two = tmp_path / "one.pdf", tmp_path / "two.pdf"
    for path in (one, two):
        assert main(["handout", "slider-crank", "-o", str(path)]) == 0
    assert len(pages(one)) >= 3
    assert len(set(pages(one))) == 1
    assert one.read_bytes() == two.read_bytes()


@pytest.mark.parametrize("part", ["task", "guided", "solution"])
def test_one_part_alone(part: str, tmp_path: Path) -> None:
    """--only has the pages of one part, on the paper that is named."""
    path = tmp_path / "part.pdf"
    named = "--paper", "A3", "--set", "sheet.protocol=aside"
    assert main(["handout", "slider-crank", "--only", part, *named, "-o", str(path)]) == 0
    assert pages(path)[0] == pytest.approx(A3, rel=1e-5)
    assert len(pages(path)) == 1 or part == "guided"


def test_a_page_for_a_browser_is_the_live_page_with_the_steps_in_front(tmp_path: Path) -> None:
    """A .html is the live page, opened at the first step."""
    path = tmp_path / "steps.html"
    assert main(["handout", "four-bar", "--plan", "polar", "--choices", "none", "-o", str(path)]) == 0
    assert '"stepsFirst":true' in path.read_text(encoding="utf-8")


@pytest.mark.parametrize(("arguments", "why"), [
    (["-o", "handout.txt"], "no handout is written as .txt"),
    (["-o", "handout.html", "--only", "task"], "has no parts"),
    (["-o", "handout.html", "--at", "20"], "moves to any pose"),
])
def test_what_makes_no_sense_is_refused(arguments: list[str], why: str, tmp_path: Path,
                                        monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """One line says what is wrong; nothing is written."""
    monkeypatch.chdir(tmp_path)
    assert main(["handout", "four-bar", *arguments]) == 2
    assert why in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
