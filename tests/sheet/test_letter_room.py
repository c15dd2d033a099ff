"""How many letters of plans have no room, about, before any is placed."""

from __future__ import annotations

import pytest
from sheets import composition_of

from graphplan.sheet.layout.letter_room import share_without_room

NEAR = 0.1  # of all letters
SHEETS = "four-bar", "ozols-16-1", "triad-loaded"  # on A4, from roomy to crowded


@pytest.mark.parametrize("name", SHEETS)
def test_about_as_many_letters_have_no_room_as_find_no_good_place(name: str) -> None:
    """Roomy or crowded: the share that is known before letters are placed is near that of poor places after it."""
    composition = composition_of(name, "A4")
    assert share_without_room(composition.plates) == pytest.approx(composition.poor, abs=NEAR)


def test_crowded_sheets_are_told_from_roomy_ones() -> None:
    """The more crowded a sheet is, the more of its letters have no room."""
    shares = [share_without_room(composition_of(name, "A4").plates) for name in SHEETS]
    assert shares == sorted(set(shares))
