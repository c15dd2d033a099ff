"""The table [sheet]: what a scene may wish of its sheet, and what is said where it cannot be."""

from __future__ import annotations

from fractions import Fraction

import pytest
from scene_texts import PRESS, changed

from graphplan.errors import SceneError
from graphplan.mechanism.model import Presentation
from graphplan.mechanism.papers import PAPERS
from graphplan.mechanism.scene import parse
from graphplan.mechanism.sections import FRAMES
from graphplan.sheet.frames import frame
from graphplan.sheet.layout.paper import sheet_size
from graphplan.words import LANGUAGES

WHOLE = """
[sheet]
paper = "A4 portrait"
frame = "gost"
owner = "Chair of Mechanisms"
number = "TMM-01"
date = "1939-05-01"
drawn_by = "N. N."
approved_by = "M. M."
language = "lv"
plan = "polar"
method = "trial"
inertia = "shifted"
rounds = 3
strict = true
prefer = "quick"
pencil = "point=0.2"
protocol = "aside"
task = "Find the velocity of M."
convention = "drawn"
k_s = 2.5
k_v = 10
k_a = 40
k_F = 4
curves = ["A", "M"]
centrodes = ["2 frame", "3 2"]
cubics = ["2"]
positions = 12
[sheet.multiples]
N-plan = 2
"force plan 2, 3" = 0.5
"""


def sheet(lines: str) -> Presentation:
    """The sheet of a scene with these lines in its table."""
    return parse(f"{PRESS}\n[sheet]\n{lines}\n", "f.toml").sheet


def test_every_wish_is_read() -> None:
    """All keys of the table arrive, numbers exactly as written."""
    assert parse(PRESS + WHOLE, "f.toml").sheet == Presentation(
        "A4 portrait", "gost", "Chair of Mechanisms", "TMM-01", "1939-05-01", "N. N.", "M. M.", "lv", "polar",
        "trial", "shifted", 3, True, "quick", "point=0.2", "aside",
        "Find the velocity of M.", Fraction(5, 2), Fraction(10), Fraction(40), Fraction(4),
        {"N-plan": Fraction(2), "force plan 2, 3": Fraction(1, 2)}, "drawn",
        ("A", "M"), ("2 frame", "3 2"), ("2",), 12,
    )  # fmt: skip


def test_without_the_table_all_is_left_open() -> None:
    """A scene that says nothing, or leaves a text empty, wishes nothing of its sheet."""
    assert parse(PRESS, "f.toml").sheet == sheet('owner = ""') == Presentation()


@pytest.mark.parametrize(("length", "scale", "k_s"), [
    ("mm", "1:2", Fraction(2)), ("mm", " 2.5 : 1 ", Fraction(2, 5)), ("m", "1:50", Fraction(1, 20)),
    ("in", "1:1", Fraction(5, 127)),
])  # fmt: skip
def test_a_ratio_is_a_scale(length: str, scale: str, k_s: Fraction) -> None:
    """A ratio of paper to scene gives the scene's lengths in a millimetre, whatever their unit."""
    assert parse(f'{PRESS}\n[units]\nlength = "{length}"\n[sheet]\nscale = "{scale}"\n', "f.toml").sheet.k_s == k_s


def test_two_scales_tie_how_long_vectors_are_drawn() -> None:
    """kappa follows from the scale of velocities and one other, phi from that of forces."""
    assert sheet("k_s = 2\nk_v = 8").kappa == sheet("k_v = 8\nk_a = 32").kappa == Fraction(1, 4)
    assert sheet("k_s = 2\nk_F = 8").phi == Fraction(1, 4)
    assert (sheet("k_v = 8").kappa, sheet("k_F = 8").phi) == (None, None)


@pytest.mark.parametrize(("lines", "line"), [
    ('papper = "A3"', "sheet.papper: unknown key; perhaps paper"),
    ('paper = "A4 potrait"', 'sheet.paper: the string "A4 potrait" is not known here; perhaps A4 portrait or A3 '
     "portrait"),
    ('frame = "din"', 'sheet.frame: the string "din" is not known here; one of iso, gost'),
    ('language = "xx"', f'sheet.language: the string "xx" is not known here; one of {", ".join(LANGUAGES)}'),
    ('curves = ["A", "Z"]', "sheet.curves: there is no point Z; one of A, B, M, O"),
    ('curves = ["O"]', "sheet.curves: O does not move; a point of moving links only"),
    ("positions = 2.5", "sheet.positions: 2.5 is not a number of positions; a whole number from 1 to 72"),
    ("positions = 100", "sheet.positions: 100 is not a number of positions; a whole number from 1 to 72"),
    ('convention = "paper"', 'sheet.convention: the string "paper" is not known here; one of real, drawn'),
    ("date = 1939-05-01", "sheet.date: a date or time where a text is wanted; a text in quotes"),
    ('owner = "two\\nlines"', "sheet.owner: a text with line breaks or characters that cannot be printed; a text on "
     "one line"),
    ("k_s = 0", "sheet.k_s: the scale 0 is not positive; a scale above 0"),
    ('k_v = "2"', 'sheet.k_v: the string "2" where a number is wanted; a number such as 12.5'),
    ('scale = "0:2"',
     'sheet.scale: the string "0:2" is not a ratio; a length on paper to a length of the scene, such as "1:2"'),
    ("scale = 2",
     'sheet.scale: the number 2 is not a ratio; a length on paper to a length of the scene, such as "1:2"'),
    ('k_s = 2\nscale = "1:2"', "sheet.scale: k_s and scale are both given; give one of the two"),
    ("k_s = 2\nk_v = 8\nk_a = 30", "sheet.k_a: 30 does not fit k_s and k_v; k_v^2/k_s, which is 32"),
    ("multiples = 2", "sheet.multiples: the number 2 where a table is wanted; a table of keys and values"),
    ("multiples = { N-plan = -1 }", "sheet.multiples.N-plan: the multiple -1 is not positive; a multiple above 0"),
    ("multiples = { n-plan = 1 }", "sheet.multiples.n-plan: unknown plan; perhaps N-plan"),
])  # fmt: skip
def test_faults(lines: str, line: str) -> None:
    """A wish that cannot be fulfilled is one line: where, what is wrong, what would be right."""
    with pytest.raises(SceneError) as error:
        sheet(lines)
    assert error.value.lines == (f"f.toml: {line}",)


def test_a_table_that_is_none_is_told() -> None:
    """Something else under the name of the table is a fault like any other."""
    with pytest.raises(SceneError, match="sheet: the number 3 where a table is wanted"):
        parse(changed(f"sheet = 3\n{PRESS}"), "f.toml")


def test_what_may_be_wished_is_what_there_is() -> None:
    """There is a frame for each that may be wished, and a size for each paper."""
    assert set(FRAMES) == set(frame.FRAMES)
    assert all(sheet_size(paper)[0] > 0 for paper in PAPERS)
