"""The reference of the manual is what the docstrings say, and every public name stands in it."""

from __future__ import annotations

from pathlib import Path

import graphplan as gp
from graphplan.output.manual.api_reference import GROUPS, api_reference

CHAPTER = Path(gp.__file__).parent / "output" / "manual" / "chapters" / "api.md"


def test_the_chapter_is_what_is_generated() -> None:
    """`python -m graphplan.output.manual.api_reference` writes it."""
    same = CHAPTER.read_text(encoding="utf-8") == api_reference()
    assert same, "run python -m graphplan.output.manual.api_reference"


def test_every_name_is_in_one_group() -> None:
    """Every public name stands in the reference once."""
    grouped = " ".join(GROUPS.values()).split()
    assert sorted(grouped) == sorted(gp.__all__)
