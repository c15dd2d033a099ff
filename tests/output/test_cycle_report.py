"""Reports on a machine over its cycle: the pages, their numbers, and that these are those of `cycle` and `draw`."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pypdfium2
import pytest
from face import ran

import graphplan as gp


def reported(file: Path, *words: str) -> list[str]:
    """The text of each page of a report that the command writes."""
    done = ran("report", *words, "-q", "-o", file)
    assert done.status == 0, done.err
    return page_texts(file)


def page_texts(file: Path) -> list[str]:
    """The text of each page of a PDF, its lines as they are."""
    return [page.get_textpage().get_text_bounded().replace("\r\n", "\n") for page in pypdfium2.PdfDocument(file)]


def table_rows(page: str) -> list[list[str]]:
    """The rows of the tables of positions on a page, without the numbers of the frame's fields."""
    rows = [line.replace("−", "-").split() for line in page.splitlines() if re.match(r"\d+ [\d−]", line)]
    return [row for row in rows if row[:3] != ["1", "2", "3"]]


def turn(folder: Path, scene: str, positions: int, *options: str) -> dict[str, Any]:
    """The table of a scene's cycle."""
    assert ran("cycle", scene, "--positions", str(positions), *options, "-q", "-o", folder / "turn.json").status == 0
    data: dict[str, Any] = json.loads((folder / "turn.json").read_text(encoding="utf-8"))
    return data


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """The pages of the report on the shaping machine."""
    return reported(tmp_path_factory.mktemp("report") / "report.pdf", "quick-return")


def test_a_report_has_a_plate_the_construction_diagrams_a_bearing_and_positions(pages: list[str]) -> None:
    """In this order; every page says which it is of how many."""
    heads = "Given", "Mechanism plan with", "Construction", "", "Diagrams over", "Diagrams over", "Polar", "Positions"
    assert [head for head, page in zip(heads, pages, strict=True) if head not in page] == []
    numbers = [re.search(r"\b(\d)/(\d)\b", page) for page in pages]
    assert [number and number.groups() for number in numbers] == [(str(k), "8") for k in range(1, 9)]


def test_the_plate_states_problem_and_answer(pages: list[str], tmp_path: Path) -> None:
    """What is given, with the law of the load; strokes with their time ratio; the largest of each with its place, as
    `cycle` has them in as many poses."""
    plate, data = pages[0], turn(tmp_path, "quick-return", 120)
    assert "on the forward stroke alone" in plate
    assert "stroke 400 mm" in plate
    assert "K = 1.71" in plate
    for name, symbol in (("frame at O4", "R40 at O4"), ("balance 2", "T2")):
        largest = data["largest"][name]
        size = largest.get("size", largest.get("value"))
        row = re.search(rf"^{symbol}, \S+\n?(.*)$", plate, re.MULTILINE)
        assert row, plate
        assert row[1].split() == [f"{size:.4g}", f"{largest['travel']:g}", f"{largest['rms']:.4g}"]


def test_the_construction_sheet_is_that_of_draw(pages: list[str], tmp_path: Path) -> None:
    """Word for word, but for the numbers of its pages."""
    assert ran("draw", "quick-return", "-q", "-o", tmp_path / "sheet.pdf").status == 0
    sheets = page_texts(tmp_path / "sheet.pdf")
    of_report = [re.sub(r"\b\d/8\b", "", page) for page in pages[1 : 1 + len(sheets)]]
    assert of_report == [re.sub(rf"\b\d/{len(sheets)}\b", "", sheet) for sheet in sheets]


def test_the_table_has_the_numbers_of_cycle(pages: list[str], tmp_path: Path) -> None:
    """24 positions, each row with its number, the drive's travel and what `cycle` gives there."""
    data = turn(tmp_path, "quick-return", 24)
    moments = [float(value) for value in data["balance moment"]["2"]]
    rows = table_rows(pages[-1])
    assert len(rows) % 24 == 0
    for k in range(24):
        assert any(row[:2] == [str(k), f"{15 * k:g}"] and f"{moments[k]:.4g}" in row for row in rows)


def test_a_report_is_the_same_bytes_and_that_of_python(tmp_path: Path) -> None:
    """Twice by the command, once by `gp.report`."""
    for name in ("one.pdf", "two.pdf"):
        reported(tmp_path / name, "four-bar", "--positions", "12", "--set", "sheet.plan=polar")
    gp.report(gp.load("four-bar").replace("sheet.plan", "polar"), tmp_path / "three.pdf", n=12)
    assert len({(tmp_path / f"{name}.pdf").read_bytes() for name in ("one", "two", "three")}) == 1


def test_a_report_between_limits_goes_from_one_to_the_other(tmp_path: Path) -> None:
    """Where no turn leads round; over a range from end to end, both of which are positions."""
    whole = table_rows(reported(tmp_path / "whole.pdf", "plough-lift", "--positions", "5")[-1])
    assert float(whole[0][1]) < -340 < 30 < float(whole[4][1])
    short = reported(tmp_path / "part.pdf", "plough-lift", "--positions", "5", "--from", "0", "--to", "30")
    part = table_rows(short[-1])
    assert [float(row[1]) for row in part[:5]] == pytest.approx(np.linspace(0, 30, 5))


def test_what_does_not_move_on_has_no_report(tmp_path: Path) -> None:
    """A pose whose motions are given for one moment is refused as by `cycle`, and nothing is written."""
    done = ran("report", "rosenauer-basic", "-o", tmp_path / "report.pdf")
    assert (done.status, done.err.count("\n")) == (2, 1)
    assert "a [[drive]] for each degree of freedom" in done.err
    assert not [*tmp_path.iterdir()]


def test_a_report_speaks_the_language(tmp_path: Path) -> None:
    """Headings, units' commas and the remark on the efficiency."""
    words = " ".join(reported(tmp_path / "report.pdf", "kinytskyi", "--positions", "6", "--language", "de"))
    for phrase in ("Bericht", "Diagramme über dem Weg des Antriebs", "Lagen", "Der Wirkungsgrad ist negativ"):
        assert phrase in words.replace("\n", " ")
    assert not re.search(r"\b(largest|stroke|efficiency|drive|Positions)\b", words)
