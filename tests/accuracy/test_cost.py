"""The cost of drawings and their errors, as the commands and the sheet tell them."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from drawings import drafted_of
from four_bars import four_bar

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import Pencil
from graphplan.check.trusted import report
from graphplan.commands import main
from graphplan.errors import Refused
from graphplan.kernel import Board
from graphplan.kernel.lemoine import counts
from graphplan.kernel.passes import freeze
from graphplan.mechanism.sections import BESIDE_PLANS
from graphplan.sheet.layout.layout import pages
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import Text

SINGULAR = four_bar("omega = 1", A="[1, 0]", B="[3, 0]", C="[5, 0]")  # its bars lie in one line


def test_cost_compares_all_forms(capsys: pytest.CaptureFixture[str]) -> None:
    """`cost` prints a table that is not too wide, with every method on both plans, by set squares and strictly."""
    assert main(["cost", "five-bar", "--hands", "500"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 120
    assert sum(line.startswith("every method") for line in lines) == 2 * 2 * 2
    assert sum(bool(re.search("Orthogonal|Polar", line)) for line in lines) == 4


def test_cost_as_data(capsys: pytest.CaptureFixture[str]) -> None:
    """`cost --json` gives each form's counts, crossings and errors; simplicity where the form is strict."""
    assert main(["cost", "five-bar", "--json", "--pencil", "point=0.2"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["model"] == {"point": 0.2, "edge": 0.1, "angle": 0.05, "opening": 0.1}
    assert [(form["plan"], form["strict"]) for form in data["forms"]] == [
        (plan, strict) for strict in (False, True) for plan in ("orthogonal", "polar")]
    for form in data["forms"]:
        assert (form["cost"]["simplicity"] is not None) == form["strict"]
        assert form["pencil"]["results"]["velocity"]["B"]["mm"] > 0
        assert all(0 < crossing["degrees"] <= 90 for crossing in form["cost"]["crossings"])


def test_a_singular_pose_costs_nothing(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Where no form can be drawn `cost` ends as the drawing itself would."""
    path = tmp_path / "dead.toml"
    path.write_text(SINGULAR)
    assert main(["cost", str(path)]) == 3
    assert capsys.readouterr().out == ""


def test_steps_tell_cost_and_errors(capsys: pytest.CaptureFixture[str]) -> None:
    """`steps --json` gives every result's error in mm and in its unit, and the worst step; the protocol says them."""
    assert main(["steps", "four-bar", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    found = report(gp.load("four-bar"))
    deviation = draft(found.drawing, Pencil(), check=found.check).deviations.results["velocity"]["M"]
    told, worst = data["pencil"]["results"]["velocity"]["M"], data["pencil"]["worst step"]
    assert (told["value"], told["mm"]) == (deviation.value, deviation.mm)
    assert data["cost"]["operations"] == 25
    assert worst["makes"] == next(step["makes"] for step in data["steps"] if step["number"] == worst["number"])
    assert sum(step["share"] for step in data["pencil"]["worst result"]["shares"]) == pytest.approx(1)
    assert main(["steps", "four-bar"]) == 0
    text = capsys.readouterr().out
    assert f"M ±{deviation.text}" in text
    assert f"step {worst['number']}." in text


@pytest.mark.parametrize("name", ["four-bar", "ozols-10-1", "jaanimets-10"])
def test_the_sheet_tells_every_error(name: str) -> None:
    """Every result's error stands on a page of the sheet, whose scales are those that it was found at."""
    drafted = drafted_of(name)
    sheets = pages(drafted.composition)
    assert all(sheet.scales == drafted.composition.scales for sheet in sheets)
    words = [plain(item.runs) for sheet in sheets for item in sheet.items if isinstance(item, Text)]
    for kind, found in drafted.deviations.results.items():
        for deviation in found.values():
            assert any(deviation.text in word for word in words), kind


def test_instruments_are_changed_as_they_are_needed() -> None:
    """An instrument that is in the hand already is not taken again; marking a point needs none."""
    board = Board()
    A, B, C = (board.given(x=x, y=y) for x, y in ((0, 0), (4, 0), (1, 3)))
    k, l = board.line(A, B), board.line(A, C)
    p, q = board.parallel(k, C), board.parallel(l, B)
    arc = board.circle(A, board.opening(A, board.meet(p, q)))
    assert counts(freeze(board, [arc])).changes == 2


@pytest.mark.costly
def test_paper_without_room_for_every_plan_is_refused() -> None:
    """Where words beside them, with their errors, leave some plan no room on the paper named, that is refused in one
    line."""
    drawing = gp.construct(gp.load("walschaerts-loaded"), plan="polar")
    with pytest.raises(Refused, match="words and plans do not fit"):
        draft(drawing, Pencil(), "A2", protocol=BESIDE_PLANS)
