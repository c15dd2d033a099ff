"""Measured points: one sheet written in every way that spreadsheets and editors write it."""

from __future__ import annotations

import cmath
import math
from pathlib import Path

import pytest

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.submission import read_submission
from graphplan.marking.traces import Submission, mark_name, spell

PANELS = ("mechanism plan", "N-plan", "force plan 2, 3")
MARKS = {"A": (12.5, -3.25), "v_b": (40.0, 7.125), "A_1'": (0.5, 1e2), "12": (7.0, 8.0)}
COMMAS = "mark,x,y\nA,12.5,-3.25\nv_b,40,7.125\nA_1',.5,1e2\n12,7,8\n"
WAYS = {
    "commas": COMMAS,
    "BOM, quotes and blanks": '\ufeff"mark", "x" , y\n"A" , "12.5",-3.25\nv_{b},40,7.125\n A₁′ ,0.5,100\n12,7,8.00',
    "comments and gaps": "# twice\n\nmark,x,y\n#B,1,1\nA,12.5,-3.25\nC,,\n,,\nv_b,40,7.125\nA'_1,.5,100\n12,7,8\n",
    "decimal commas": COMMAS.replace(",", ";").replace(".", ","),
    "tabs": COMMAS.replace(",", "\t").replace(".", ","),
    "Windows": COMMAS.replace("\n", "\r\n").replace("-", "−"),
    "other columns": "X;Mark;Y;Note\n12,5;A;-3,25;by ruler\n40;v_b;7,125;\n0,5;A_1';100\n7;12;8\n",
}


def submission(folder: Path, name: str, text: str, coding: str = "utf-8") -> Submission:
    """The text as a file, read."""
    path = folder / name
    path.write_bytes(text.encode(coding))
    return read_submission(path, PANELS, {})


@pytest.mark.parametrize("way", WAYS)
def test_the_same_marks_however_written(tmp_path: Path, way: str) -> None:
    """Separators, decimal commas, BOM, quotes, comments, missing marks and spellings change nothing."""
    found = submission(tmp_path, "sheet.csv", WAYS[way])
    assert {trace.label: trace.spots[0] for trace in found.traces} == MARKS
    assert found.shows == {POINT}
    assert found.name == "sheet.csv"


def test_as_spreadsheets_save_unicode(tmp_path: Path) -> None:
    """A table in UTF-16 is read as well."""
    found = submission(tmp_path, "sheet.csv", WAYS["tabs"], "utf-16")
    assert len(found.traces) == len(MARKS)


def test_lines_circles_plans_and_precision(tmp_path: Path) -> None:
    """A line has two measured points, a circle a radius; plans are meant by name, whatever the case."""
    text = ("mark;x;y;x2;y2;r;panel;precision\n4;0;0;3;4;;n-plan;0,2\nQ;5;5;;;;Mechanism;\n"
            "9;1;2;;;2,5;Force plan 2, 3;\n")
    line, point, circle = submission(tmp_path, "sheet.csv", text).traces
    assert (line.kind, line.spots, line.panel, line.blur) == (LINE, ((0, 0), (3, 4)), "N-plan", 0.2)
    assert (point.kind, point.panel, point.blur) == (POINT, "mechanism plan", pytest.approx(0.1 / 12**0.5))
    assert (circle.kind, circle.panel) == (CIRCLE, "force plan 2, 3")
    assert [math.dist(spot, (1, 2)) for spot in circle.spots] == pytest.approx([2.5] * 4)


@pytest.mark.parametrize(("spots", "unit"), [
    ([(12.5, 3), (4, 7)], 0.1), ([(12.25, 3), (4, 7)], 0.01), ([(12, 3), (4, 7)], 1.0), ([(1e1, 2.5e-1)], 0.01),
    ([(x + 0.5, x) for x in range(8)], 0.5), ([(x + 0.4, x + 0.2) for x in range(8)], 0.2),
    ([(5 * x, 10 * x) for x in range(8)], 5.0)])
def test_how_finely_marks_were_read_is_seen_in_the_digits(tmp_path: Path, spots: list[tuple[float, float]],
                                                          unit: float) -> None:
    """In a table of either kind: one of the last digit, or where all are multiples of it, the half or the fifth mm."""
    table = "mark,x,y\n" + "".join(f"P{i},{x},{y}\n" for i, (x, y) in enumerate(spots))
    toml = "[marks]\n" + "".join(f"P{i} = [{x}, {y}]\n" for i, (x, y) in enumerate(spots))
    for name, text in (("a.csv", table), ("a.toml", toml)):
        found = submission(tmp_path, name, text)
        assert not found.stated
        assert [trace.blur for trace in found.traces] == pytest.approx([unit / math.sqrt(12)] * len(spots))


TOML = """
precision = 0.1
[marks]
A = [1, 2.5]
[marks."N-plan"]
a = [3, 4]
[lines]
4 = [[0, 0], [10, 0]]
[lines."N-plan"]
"β" = [[0, 1], [10, 1]]
[circles]
5 = [0, 0, 2]
6 = [[1, 0], [0, 1], [-1, 0]]
[results.velocity]
unit = "m/s"
A = [1.5, -2]
B = { size = 2, angle = 90 }
[results.omega]
3 = -4.5
[frames."N-plan"]
origin = [100, 50]
scale = 0.4
turn = 90
"""


def test_a_sheet_in_toml(tmp_path: Path) -> None:
    """Marks, lines, circles, results and frames stand in tables of their own, those of a plan under its name."""
    found = submission(tmp_path, "sheet.toml", TOML)
    assert [(t.label, t.panel, t.kind) for t in found.traces] == [
        ("A", "", POINT), ("a", "N-plan", POINT), ("4", "", LINE), ("beta", "N-plan", LINE), ("5", "", CIRCLE),
        ("6", "", CIRCLE)]
    assert {trace.blur for trace in found.traces} == {0.1}
    assert [(n.kind, n.of, n.unit) for n in found.numbers] == [
        ("velocity", "A", "m/s"), ("velocity", "B", "m/s"), ("omega", "3", "")]
    assert found.numbers[1].value == pytest.approx((0, 2))
    assert found.frames["N-plan"].origin == 100 + 50j
    assert cmath.isclose(found.frames["N-plan"].unit, 0.4j)
    assert found.shows == {POINT, LINE, CIRCLE}


FAULTS = {
    "mark,x,y\nA,1,two": "line 2: y: 'two' is not a number",
    "mark,x,y\nA,1,": "line 2: y: a number is missing",
    "mark,x,y\nA,nan,1": "'nan' is not a number",
    "mark,x,y\nA,1e999,1": "'1e999' is not a number",
    "mark,x,y\nA,1e9,1": "outside any sheet of paper",
    "mark,x,y\nA,1,5,2,5": "line 2: it has 5 columns, the first line 3",
    "mark,x,y,panel\nA,1,2,M-plan": "no plan 'M-plan', but mechanism plan, N-plan",
    "mark,x,y,x2,y2\n4,1,2,1,2": "it contains no mark and no result",
    "mark,x,y,x2,y2\n4,0,0,1e-200,0": "it contains no mark and no result",
    "mark,x,y,x2,y2,r\n4,1,2,3,4,5": "line 2: not a mark",
    "mark,x,y,r\n4,0,0,1e-200": "it contains no mark and no result",
    "mark,x,y,r\n4,0,0,-2": "line 2: not a mark",
    "mark,x,y,precision\nA,1,2,1000": "line 2: a precision of 1000 mm is not the error of a ruler; 0 to 1 mm",
    "mark,x,y,precision\nA,1,2,-0.1": "line 2: a precision of -0.1 mm is not the error of a ruler",
    "mark,x,y,X\nA,1,2,3": "line 1: two columns are called 'x'",
    "mark,x,y\n": "it contains no mark and no result",
    "mark,x,y\nA,,\n": "it contains no mark and no result",
    "quantity,of,value\n": "it contains no mark and no result",
    "name,length\nA,1": "its first line names no known columns",
}


@pytest.mark.parametrize("text", FAULTS, ids=FAULTS.values())
def test_a_fault_is_told_where_it_stands(tmp_path: Path, text: str) -> None:
    """What is wrong in a table is refused with its line and what would be right."""
    with pytest.raises(Refused, match=FAULTS[text].replace("(", r"\(")) as told:
        submission(tmp_path, "sheet.csv", text)
    assert "\n" not in str(told.value)
    assert told.value.status == 2


WRONG = {
    "[marks]\nA = [1]": "marks.A: not a point",
    "[marks]\nA = [1, true]": "marks.A: not a number",
    "[marks]\nA = [1, inf]": "marks.A: not a number",
    "[lines]\n4 = [[0, 0], [0, 0]]": "lines.4: not a line",
    "[lines]\n4 = [[0, 0], [1e-200, 0]]": "lines.4: not a line",
    "[circles]\n4 = [[0, 0], [1, 1], [2, 2]]": "circles.4: not a circle",
    "[circles]\n4 = [[0, 0], [1, 1], [2, 0], [3, 1], [4, 0]]": "circles.4: not a circle",
    "[circles]\n4 = [0, 0, 1e-200]": "circles.4: not a circle",
    "precision = 1000\n[marks]\nA = [1, 2]": "precision: 1000 mm is not the error of a ruler; 0 to 1 mm",
    'precision = 0.1\n[frames."N-plan"]\norigin = [0, 0]': "it contains no mark and no result",
    '[marks."lever 7"]\nA = [1, 2]': "marks: the construction has no plan 'lever 7'",
    "[results.velocity]\nA = 3": "results.velocity.A: velocity is a vector",
    '[results.velocity]\nunit = "m"\nA = [3, 4]': "results.velocity.A: 'm' is not a unit such as mm/s",
    '[frames."N-plan"]\norigin = [0, 0]\nscale = 0': "frames.N-plan.scale",
    "[points]\nA = [1, 2]": "points: unknown entry",
    "marks = 3": "marks: not a table",
    "[marks\n": "not TOML",
}


@pytest.mark.parametrize("text", WRONG, ids=WRONG.values())
def test_a_fault_in_toml(tmp_path: Path, text: str) -> None:
    """What is wrong in a TOML file is refused with the entry's name."""
    with pytest.raises(Refused, match=WRONG[text]):
        submission(tmp_path, "sheet.toml", text)


def test_spellings_of_names() -> None:
    """Braces, Greek letters, low digits and primes are one spelling; words are no names."""
    ways = {"v_b": ["v_{b}", " v_b "], "alpha_3'": ["α_3'", "α₃′", "α′_3"], "A_1''": ["A₁″", "A_{1}''"],
            "v_p25": ["v_p_25"], "P_25,1": ["P_25_1"], "B_1(3)": ["B_1(3)"]}
    for name, others in ways.items():
        assert {spell(other) for other in (name, *others)} == {name}
        assert mark_name(name) == name
    assert [mark_name(word) for word in ("mm", "Draw", "12.5", "1000", "", "A B", "figure")] == ["mm"] + [""] * 6
