"""The text of a scene, edited: what is meant changes, and nothing else."""

from __future__ import annotations

import tomllib
from fractions import Fraction
from typing import Any

import pytest

from graphplan.errors import Refused
from graphplan.mechanism.numbers import decimal
from graphplan.mechanism.scene import FOLDER, packaged_names
from graphplan.mechanism.scene_text import decimal_text, edit_text, with_keys, with_numbers, without_table
from graphplan.mechanism.variation import numbers

TEXT = '''\
# A four-bar of 1 and 2.
title = "Four-bar 1: 50 # no comment"   # said once

[points]
O = [0, -0.5]  # at 0
"A 1" = { from = "O", distance = 50.25, angle = +60 }   # at 60
1 = [1_000,
     2e1]

[links]
1 = "O A"  # 1 is a key

[masses.2]
mass = 2

[[forces]]
values = [
    [0, 0],
    [30, -1200]
]
value = [3, 4]

# Other numbers
# for others.
[vary]
"points.O.1" = { from = 1, to = 2, step = 1 }
# between
"masses.2.mass" = [1, 2]

# How it looks.
[sheet]  # here
curves = ["M"]   # the curve
paper = "A4"
'''


def test_numbers_are_written_as_one_writes_them() -> None:
    """Whole numbers have no point, others no digit too many and no power of ten."""
    told = {"2e1": "20", "12.50": "12.5", "1e-7": "0.0000001", "-3": "-3", "1e20": "1" + 20 * "0"}
    for text, expected in told.items():
        assert decimal_text(Fraction(text)) == expected


def test_each_number_can_be_another() -> None:
    """A number is changed at its place alone, whatever keys, strings and comments look like it."""
    for path, _ in numbers(tomllib.loads(TEXT)):
        name = ".".join(f'"{part}"' for part in path)
        found = with_numbers(TEXT, {name: Fraction(777, 100)})
        assert found.count("7.77") == 1
        assert [one for one in numbers(tomllib.loads(found, parse_float=decimal))
                if one[1] == Fraction(777, 100)] == [(path, Fraction(777, 100))]


@pytest.mark.parametrize("name", packaged_names())
def test_all_numbers_of_packaged_scenes_are_found(name: str) -> None:
    """Each packaged scene with its own numbers written anew says what it said."""
    with open(f"{FOLDER}/{name}.toml", encoding="utf-8") as file:
        text = file.read()
    tables = tomllib.loads(text, parse_float=decimal)
    own: dict[str, Any] = {".".join(f'"{part}"' for part in path): Fraction(str(value))
                           for path, value in numbers(tables)}
    assert tomllib.loads(with_numbers(text, own), parse_float=decimal) == tables


def test_places_in_long_lists_are_no_places_in_the_text() -> None:
    """In a long list each number is found at its own place."""
    text = f"1 = 5\na = [{', '.join(map(str, range(200)))}]\n"
    for place in (0, 4, 10, 100, 199):
        assert tomllib.loads(with_numbers(text, {f"a.{place}": Fraction(777)}))["a"][place] == 777


def test_a_number_that_is_not_there_is_refused() -> None:
    """A path that no numeral stands at is told."""
    with pytest.raises(Refused, match=r"vary\.points\.P\.0: its number is not found"):
        with_numbers(TEXT, {"points.P.0": Fraction(1)})


def test_a_table_is_left_out_with_its_comment() -> None:
    """The table goes with the comment right above it; what stands before the next table stays there."""
    found = without_table(TEXT, "vary")
    assert found == TEXT[:TEXT.index("# Other")] + TEXT[TEXT.index("# How"):]
    assert without_table(TEXT.partition("\n# How")[0], "vary") == TEXT[:TEXT.index("\n# Other")]
    assert without_table(TEXT, "find") == TEXT


def test_keys_are_set_in_their_table() -> None:
    """A key that is there has another value, and keeps its comment; a new one stands first in its table."""
    found = with_keys(TEXT, "sheet", {"paper": '"A3"', "k_s": "2.5", "curves": '["A"]'})
    assert found.endswith('[sheet]  # here\nk_s = 2.5\ncurves = ["A"]   # the curve\npaper = "A3"\n')
    assert with_keys(TEXT, "", {"title": '"Other"'}).splitlines()[1] == 'title = "Other"   # said once'
    assert tomllib.loads(with_keys(TEXT, "find", {"links": '"all"'}))["find"] == {"links": "all"}


def test_without_keys_a_text_stays_as_it_is() -> None:
    """No table is begun for nothing."""
    assert with_keys("title = 1\n", "sheet", {}) == "title = 1\n"


def test_an_edit_that_goes_astray_is_refused() -> None:
    """A text that says something else after an edit than is meant is not taken."""
    with pytest.raises(Refused, match="its text cannot be edited"):
        edit_text('vary.x = 1\ntitle = "T"\n', lambda text: without_table(text, "vary"),
                  lambda tables: tables.pop("vary"))


def test_lines_of_another_system_are_edited_alike() -> None:
    """A text with the line ends of Windows is edited as that with plain ones."""
    def edit(text: str) -> str:
        return with_keys(without_table(text, "vary"), "sheet", {"k_s": "2"})

    def meant(tables: dict[str, Any]) -> None:
        del tables["vary"]
        tables["sheet"]["k_s"] = 2

    assert edit_text(TEXT.replace("\n", "\r\n"), edit, meant) == edit_text(TEXT, edit, meant)
